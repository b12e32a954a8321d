"""The packages that `make demo` installs: one version of each for this Python, every file with its hash."""

import re
import tomllib

import pytest
from library import ROOT
from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

LOCKS = {"requirements.txt": ("test", "dev"), "demo.txt": ("build",), "importers.txt": ("importers",)}
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]


def locked(name):
    """{package: version} that a lock gives this Python, and the lines of each package."""
    text = (ROOT / ".ci" / name).read_text()
    blocks = re.split(r"\n(?=\S)", text.strip())
    packages = {}
    for block in blocks:
        requirement = Requirement(block.splitlines()[0].removesuffix("\\"))
        if requirement.marker is None or requirement.marker.evaluate():
            (specifier,) = requirement.specifier
            assert specifier.operator == "==" and canonicalize_name(requirement.name) not in packages
            packages[canonicalize_name(requirement.name)] = specifier.version
    return packages, blocks


def wanted(extras):
    """Requirements of the project with these extras, those of its own extras in their place."""
    optional = PROJECT["optional-dependencies"]
    texts = list(PROJECT["dependencies"]) if {"test", "build"} & set(extras) else []
    for extra in extras:
        texts += optional[extra]
    for text in texts:
        requirement = Requirement(text)
        if requirement.name == PROJECT["name"]:
            yield from wanted(requirement.extras)
        elif requirement.marker is None or requirement.marker.evaluate():
            yield requirement


@pytest.mark.parametrize("name", LOCKS)
def test_every_requirement_is_locked(name):
    """`make lock` makes the files anew."""
    packages, _ = locked(name)
    for requirement in wanted(LOCKS[name]):
        version = packages[canonicalize_name(requirement.name)]
        assert requirement.specifier.contains(version, prereleases=True), requirement


@pytest.mark.parametrize("name", LOCKS)
def test_every_package_has_hashes(name):
    """pip installs nothing else with --require-hashes, which .ci/environment gives it; no address is fixed."""
    _, blocks = locked(name)
    assert len(blocks) > 20
    for block in blocks:
        assert re.fullmatch(r"[\w.-]+==\S+( ; [^\\]+)? \\(\n    --hash=sha256:[0-9a-f]{64}( \\)?)+", block), block[:200]
    script = (ROOT / ".ci" / "environment").read_text()
    assert f"--require-hashes --requirement .ci/{name}" in script


@pytest.mark.parametrize("name", [name for name in LOCKS if name != "requirements.txt"])
def test_locks_agree(name):
    ours, theirs = (locked(one)[0] for one in ("requirements.txt", name))
    assert {one: version for one, version in theirs.items() if one in ours and ours[one] != version} == {}


def test_the_demo_needs_a_part_of_the_tests_packages():
    assert locked("demo.txt")[0].keys() < locked("requirements.txt")[0].keys()
