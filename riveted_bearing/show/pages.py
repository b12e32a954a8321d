"""HTML pages: templates of data/report, which share a frame (frame.html) and parts (parts.html)."""

from pathlib import Path
from typing import Any

import jinja2

from ..base.files import write_text
from ..running.budget import RULE, amounts, told, unsized_lines

PARTS = Path(__file__).parents[1] / "data" / "report"


def page_text(template, style="style.css", **values):
    """A page as text; template: of data/report or a path; style: of data/report; StrictUndefined: a missing value is an error."""
    environment = jinja2.Environment(
        loader=jinja2.FileSystemLoader([PARTS, Path(template).parent]),
        autoescape=True,
        trim_blocks=True,
        lstrip_blocks=True,
        undefined=jinja2.StrictUndefined,
    )
    environment.globals |= {"amounts": amounts, "told_with_error": told, "unsized_lines": unsized_lines, "rule": RULE}
    return environment.get_template(Path(template).name).render(
        style=(PARTS / style).read_text(encoding="utf-8"), **values
    )


def save_page(path: str | Path, template: Any, **values: Any) -> Path:
    """Write a page (page_text), whole or not at all; returns its path."""
    return write_text(path, page_text(template, **values))
