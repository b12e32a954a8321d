"""What pip calls to build this project: scikit-build-core, after a look for a C compiler.

Who has none reads one line before anything is downloaded.  That is why pyproject.toml requires nothing and REQUIRES
stands here.
"""

import os
import shutil
import sys

COMPILERS = ("cc", "gcc", "clang")
REQUIRES = [
    "scikit-build-core>=0.11",
    "cmake>=3.25",
    "ninja>=1.11",
    "fmpy>=0.3.20",  # FMI headers, reference results
    "numpy>=1.26",
    "lxml>=5",
    "jinja2>=3.1",
    "matplotlib>=3.8",  # icons
    "markdown-it-py>=3",  # documentation
    "latex2mathml>=3.77",
]


def get_requires_for_build_wheel(config_settings=None):
    """Packages that a wheel is built with; ends the program if there is no compiler.  On Windows CMake looks for one
    itself, in the registry too.
    """
    compilers = os.environ.get("CC", "").split()[:1] or COMPILERS
    if sys.platform != "win32" and not any(map(shutil.which, compilers)):
        sys.exit(
            f"riveted-bearing from source needs a C compiler, found is none ({', '.join(compilers)}): install one (Debian: apt-get install gcc libc6-dev), "
            "or install a release's wheel, riveted_bearing-*.whl, which compiles nothing"
        )
    return REQUIRES


def get_requires_for_build_sdist(config_settings=None):
    """Packages that the archive of sources is made with."""
    return REQUIRES[:1]


def get_requires_for_build_editable(config_settings=None):
    """Packages that `pip install --editable` needs: it compiles nothing, `make build` does."""
    return REQUIRES[:1]


def __getattr__(hook):
    """All other hooks are scikit-build-core's, imported when they are called: pip asks whether they exist before it has
    installed what they need.
    """
    if not hook.startswith(("build_", "prepare_metadata_for_build_")):
        raise AttributeError(hook)

    def call(*arguments, **settings):
        from scikit_build_core import build

        return getattr(build, hook)(*arguments, **settings)

    return call
