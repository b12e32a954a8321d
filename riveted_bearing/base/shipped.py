"""Scenes that come with the program."""

from importlib.resources import files

SHIPPED = files("riveted_bearing") / "data" / "scenes"


def shipped_scenes() -> list[str]:
    """Names of the scenes that come with the program."""
    return sorted(path.name.removesuffix(".toml") for path in SHIPPED.iterdir() if path.name.endswith(".toml"))
