"""Packs description, binaries and documentation into the FMU.

    python -m bearing_model.app.package --binary RivetedBearing.so --description modelDescription.xml --out RivetedBearing.fmu

The same inputs give the same bytes.
"""

import argparse
import os
import platform
import sys
import tempfile
import zipfile
from html import escape
from pathlib import Path
from xml.etree import ElementTree

PROJECT = Path(__file__).resolve().parents[2]
LICENSES = ("LICENSE", "THIRD_PARTY_NOTICES.md")
PLATFORMS = {  # (system, machine) -> folder and file suffix of FMI 2.0; aarch64 as FMI 3.0 and the tools name it
    ("Linux", "x86_64"): ("linux64", ".so"),
    ("Linux", "aarch64"): ("aarch64-linux", ".so"),
    ("Darwin", "x86_64"): ("darwin64", ".dylib"),
    ("Darwin", "arm64"): ("aarch64-darwin", ".dylib"),
    ("Windows", "AMD64"): ("win64", ".dll"),
}


def package(binary, description, out):
    """Write the FMU `out` from the host's binary and modelDescription.xml; either it is complete or it is left as it was.

    Raises OSError for a file that cannot be read or written, ValueError for a host that FMI has no name for.
    """
    host = platform.system(), platform.machine()
    if host not in PLATFORMS:
        raise ValueError(f"host {' '.join(host)}: allowed are {', '.join(' '.join(known) for known in PLATFORMS)}")
    folder, suffix = PLATFORMS[host]
    xml = Path(description).read_bytes()
    root = ElementTree.fromstring(xml)
    identifier = root.find("CoSimulation").get("modelIdentifier")
    members = {
        "modelDescription.xml": xml,
        f"binaries/{folder}/{identifier}{suffix}": Path(binary).read_bytes(),
        "documentation/index.html": index_page(root).encode(),
    }
    members |= {f"documentation/licenses/{name}": (PROJECT / name).read_bytes() for name in LICENSES}
    write_archive(members, Path(out))


def write_archive(members, out):
    """A zip archive that depends on its members alone: fixed times and modes."""
    out.parent.mkdir(parents=True, exist_ok=True)
    with tempfile.NamedTemporaryFile(dir=out.parent, suffix=".fmu", delete=False) as file:
        try:
            with zipfile.ZipFile(file, "w", zipfile.ZIP_DEFLATED, compresslevel=9) as archive:
                for name, content in members.items():
                    info = zipfile.ZipInfo(name)  # 1980-01-01
                    info.compress_type = zipfile.ZIP_DEFLATED
                    info.create_system = 3  # Unix
                    info.external_attr = (0o755 if name.startswith("binaries/") else 0o644) << 16
                    archive.writestr(info, content)
            file.close()
            os.chmod(file.name, 0o644)
            os.replace(file.name, out)
        except BaseException:
            file.close()
            os.unlink(file.name)
            raise


def index_page(root):
    """documentation/index.html: what the FMU is, and its variables."""
    title = escape(root.get("modelName"))
    tables = "".join(
        f"<h2>{heading}</h2>\n<table>\n<tr><th>name</th><th>unit</th><th>start</th><th>description</th></tr>\n{rows(root, causality)}</table>\n"
        for heading, causality in (("Inputs", "input"), ("Parameters", "parameter"), ("Outputs", "output"))
    )
    links = "".join(f'<li><a href="licenses/{name}">{name}</a></li>\n' for name in LICENSES)
    return f"""<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<title>{title}</title>
<style>
body {{ font-family: sans-serif; margin: 2em auto; max-width: 70em; }}
td, th {{ text-align: left; padding: 0.1em 1em 0.1em 0; vertical-align: top; }}
td:first-child {{ font-family: monospace; }}
</style>
</head>
<body>
<h1>{title}</h1>
<p>{escape(root.get("description"))}.</p>
<p>FMI 2.0 for co-simulation. All values are in SI units. X is the axis of rotation, Y and Z are radial, right-handed; i is the inner, e the outer
(fixed) race. Array elements are numbered from 1.</p>
{tables}<h2>Licenses</h2>
<ul>
{links}</ul>
</body>
</html>
"""


def rows(root, causality):
    """The variables of one causality as table rows."""
    text = ""
    for variable in root.find("ModelVariables"):
        if variable.get("causality") == causality:
            kind = variable[0]
            cells = variable.get("name"), kind.get("unit") or kind.get("declaredType") or "", kind.get("start") or "", variable.get("description")
            text += "<tr>" + "".join(f"<td>{escape(cell)}</td>" for cell in cells) + "</tr>\n"
    return text


def main(arguments=None):
    parser = argparse.ArgumentParser(description="Pack description, binary and documentation into an FMU.")
    parser.add_argument("--binary", type=Path, required=True, help="the host's shared library")
    parser.add_argument("--description", type=Path, required=True, help="its modelDescription.xml")
    parser.add_argument("--out", type=Path, required=True, help="the FMU to write")
    options = parser.parse_args(arguments)
    try:
        package(options.binary, options.description, options.out)
    except (OSError, ValueError) as error:
        sys.exit(f"package: {error}")


if __name__ == "__main__":
    main()
