"""The FMU's documentation/index.html: one readable page that needs no other file, from modelDescription.xml and the
project's own texts.

python fmus/documentation_page.py --description modelDescription.xml --parameters parameters.md --drawing bearing.svg
--sources --out index.html python fmus/documentation_page.py --description modelDescription.xml --parameters
parameters.md --drawing shaft.svg --text shaft.md --sources --out index.html
"""

import argparse
import re
from pathlib import Path
from xml.etree import ElementTree

import jinja2
from latex2mathml.converter import convert
from markdown_it import MarkdownIt

PROJECT = Path(__file__).resolve().parents[1]
TEMPLATES = PROJECT / "fmus" / "templates"
LICENSES = ("LICENSE", "THIRD_PARTY_NOTICES.md")
FLAGS = {  # capability -> its use for an importer
    "canHandleVariableCommunicationStepSize": "communication steps of any size",
    "canInterpolateInputs": "inputs as polynomials within a step",
    "maxOutputDerivativeOrder": "derivatives of outputs up to this order",
    "canGetAndSetFMUstate": "save and restore the state, continuing bit for bit",
    "canSerializeFMUstate": "the saved state as bytes, for another instance or process",
    "providesDirectionalDerivative": "stiffness and damping matrix at a communication point",
    "canRunAsynchronuously": "asynchronous steps",
}


def html(markdown):
    """Markdown with tables and $LaTeX$ as HTML with MathML."""
    with_math = re.sub(r"\$([^$\n]+)\$", lambda formula: convert(formula[1]), markdown)
    return MarkdownIt("commonmark", {"html": True}).enable("table").render(with_math)


def sections(markdown, *titles):
    """The text of the sections with these titles, without links to files that do not travel with the FMU; ValueError
    for a title that is not there.
    """
    parts = dict(re.findall(r"^## (.*)\n((?:(?!^## ).*\n)*)", markdown + "\n", re.MULTILINE))
    missing = set(titles) - set(parts)
    if missing:
        raise ValueError(f"no section {', '.join(missing)}: there are {', '.join(parts)}")
    return "\n".join(without_links(parts[title]) for title in titles)


def without_links(markdown):
    markdown = re.sub(r"!\[[^]]*\]\([^)]*\)\s*", "", markdown)
    return re.sub(r"\[([^]]*)\]\((?!http)[^)]*\)", r"\1", markdown)


def bearing_texts():
    """What the project's own texts say about the bearing."""
    physics = (PROJECT / "docs" / "physics.md").read_text()
    return {
        "conventions": html(sections(physics, "Frames and signs")),
        "physics": html(sections(physics, "The elements", "Integration", "Symbols")),
        "rivet": html(without_links(re.sub(r"\A# .*\n", "", (PROJECT / "docs" / "rivet.md").read_text()))),
    }


def page(description, parameters, drawing, text, with_sources):
    """The page as text: with the words of the file `text`, or about the bearing if there is none.

    Raises OSError for a file that cannot be read, ValueError for a section that a text no longer has.
    """
    root = ElementTree.parse(description).getroot()
    variables = parameters.read_text()
    loader = jinja2.FileSystemLoader(TEMPLATES)
    environment = jinja2.Environment(
        loader=loader, trim_blocks=True, lstrip_blocks=True, autoescape=True, undefined=jinja2.StrictUndefined
    )
    template = environment.get_template("page.html" if text else "bearing.html")
    texts = {"text": html(text.read_text())} if text else bearing_texts()
    simulation = root.find("CoSimulation")
    return template.render(
        model=root.attrib,
        experiment=root.find("DefaultExperiment").attrib,
        flags=[
            (name, simulation.get(name), meaning)
            for name, meaning in FLAGS.items()
            if simulation.get(name, "false") not in ("false", "0")
        ],
        drawing=re.search(r"<svg.*</svg>", drawing.read_text(), re.DOTALL)[0],
        **texts,
        essentials=html(sections(variables, "Essentials")) if "\n## Essentials\n" in variables else "",
        variables={
            title: html(sections(variables, title))
            for title in ("Inputs", "Parameters", "Outputs", "Locals")
            if f"\n## {title}\n" in variables
        },
        with_sources=with_sources,
        licenses=LICENSES,
    )


def main(arguments=None):
    parser = argparse.ArgumentParser(description="Write the FMU's documentation.")
    parser.add_argument("--description", type=Path, required=True, help="modelDescription.xml")
    parser.add_argument("--parameters", type=Path, required=True, help="parameters.md of the same bearing")
    parser.add_argument("--drawing", type=Path, required=True, help="picture (SVG)")
    parser.add_argument(
        "--text", type=Path, help="Markdown about the model; default: the project's own about the bearing"
    )
    parser.add_argument("--sources", action="store_true", help="the FMU holds its sources")
    parser.add_argument("--out", type=Path, required=True, help="the page to write")
    options = parser.parse_args(arguments)
    options.out.write_text(
        page(options.description, options.parameters, options.drawing, options.text, options.sources)
    )


if __name__ == "__main__":
    main()
