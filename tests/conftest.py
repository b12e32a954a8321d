"""What the tests share: the built FMU and the C core."""

import pytest
from library import LIBRARY, ROOT, Core


@pytest.fixture(scope="session")
def fmu():
    """Path of the FMU that `make build` writes."""
    path = ROOT / "fmus" / "RivetedBearing.fmu"
    assert path.is_file(), f"{path} is missing: make build"
    return path


@pytest.fixture(scope="session")
def core():
    """The C core: models of it, and every function by name (see library.py)."""
    assert LIBRARY.is_file(), f"{LIBRARY} is missing: make build"
    return Core.load()
