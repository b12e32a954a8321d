"""Makes the site of the same Markdown that the repository shows: formulas as MathML, pages from outside docs/, links to
files that the site does not hold.
"""

import os
import re
import tomllib
from pathlib import Path

from latex2mathml.converter import convert
from mkdocs.structure.files import File

ROOT = Path(__file__).resolve().parents[2]
# file of the repository -> page
OUTSIDE = {"README.md": "index.md", "CONTRIBUTING.md": "CONTRIBUTING.md", "VERSIONING.md": "VERSIONING.md"}
STYLE = Path(__file__).with_name("site.css")
BEARING = ROOT / "build" / "browser" / "bearing.html"  # written by `make browser`
CELL = re.compile(r"<t[dh].*?</t[dh]>", re.DOTALL)
NAME = re.compile(r"([._/\]])(?=[A-Za-z][^<]*</code>)")
CODE = re.compile(r"(^```.*?^```|`[^`\n]+`)", re.MULTILINE | re.DOTALL)


def on_config(config):
    """The link to the repository, from the one place of its address."""
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    config["repo_url"], config["repo_name"] = project["urls"]["Repository"], project["name"]
    return config


def on_files(files, config):
    """Add the style, the pages that stand outside docs/, and the bearing in the browser if it has been built."""
    files.append(File.generated(config, STYLE.name, abs_src_path=str(STYLE)))
    for name, page in OUTSIDE.items():
        files.append(File.generated(config, page, content=(ROOT / name).read_text(encoding="utf-8")))
    if BEARING.is_file():
        files.append(File.generated(config, BEARING.name, abs_src_path=str(BEARING)))
    return files


def on_page_markdown(markdown, page, config, files):
    """Formulas and links of one page, its code left as it is."""
    here = Path(page.file.src_uri).parent
    folder = Path() if page.file.src_uri in OUTSIDE.values() else "docs" / here
    parts = CODE.split(markdown)
    parts[::2] = [links(formulas(text), folder, here, files) for text in parts[::2]]
    if page.file.src_uri == "browser.md" and files.get_file_from_path(BEARING.name):
        parts.append(f"\n[Open the bearing]({BEARING.name}){{ .md-button }}\n")
    return "".join(parts)


def on_page_content(html, page, config, files):
    """Code breaks its lines before an option, not within; a name in a table also after a dot or underscore (site.css)."""
    html = CELL.sub(lambda cell: NAME.sub(r"\1<wbr>", cell[0]), html)
    return re.sub(r"(?<![\w-])--[a-z][\w-]*(?=[^<]*</code>)", r'<span class="option">\g<0></span>', html)


def formulas(text):
    """$LaTeX$ and $$LaTeX$$ as MathML."""
    display = '<div style="overflow-x: auto">{}</div>'.format  # a telephone scrolls the formula, not the page
    text = re.sub(
        r"\$\$(.+?)\$\$",
        lambda formula: display(convert(formula[1].replace("\n", " "), display="block")),
        text,
        flags=re.DOTALL,
    )
    # a bare <math> at a line's start would end the paragraph
    return re.sub(r"\$([^$\n]+)\$", lambda formula: f"<span>{convert(formula[1])}</span>", text)


def links(text, folder, here, files):
    """Links from a file of `folder` in the repository as links from a page in `here`; a file that the site does not
    hold becomes its name.
    """

    def rewritten(link):
        label, target = link[1], link[2]
        path, _, anchor = target.partition("#")
        if target.startswith(("http", "#", "mailto:")):
            return link[0]
        place = (ROOT / folder / path).resolve().relative_to(ROOT).as_posix()
        page = OUTSIDE.get(place, place.removeprefix("docs/"))
        if files.get_file_from_path(page) is None:
            return f"`{place}`" if place.endswith(label.strip("`")) else f"{label} (`{place}`)"
        return f"[{label}]({os.path.relpath(page, here)}{'#' + anchor if anchor else ''})"

    text = text if folder.parts else re.sub(r"!\[([^]]*)\]\(docs/", r"![\1](", text)
    return re.sub(r"(?<!!)\[([^]]*)\]\(([^)]+)\)", rewritten, text)
