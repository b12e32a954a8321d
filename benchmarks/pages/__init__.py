"""Text of the pages in docs/ that benchmarks write: a template in this folder, parts.md shared."""

from pathlib import Path

import jinja2


def page_text(template, values):
    """A page as text, without white space at the ends of lines; `x | form(".1f")` is Python's format of x."""
    environment = jinja2.Environment(
        loader=jinja2.FileSystemLoader(Path(__file__).parent),
        trim_blocks=True,
        lstrip_blocks=True,
        undefined=jinja2.StrictUndefined,
    )
    environment.filters["form"] = format
    text = environment.get_template(template).render(values)
    return "\n".join(line.rstrip() for line in text.rstrip("\n").splitlines()) + "\n"
