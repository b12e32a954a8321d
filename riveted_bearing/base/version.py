"""Version of the installed package."""

from importlib.metadata import PackageNotFoundError, version

try:
    __version__ = version("riveted-bearing")
except PackageNotFoundError:
    __version__ = "checkout"
