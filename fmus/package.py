"""Packs description, binaries, sources, documentation, terminals, pictures, reference results and the cage's
frequencies into the FMU.

    python fmus/package.py --description modelDescription.xml --binary RivetedBearing.so --out RivetedBearing.fmu [...]
    python fmus/package.py @arguments.txt                    one argument a line, as the build writes them

The same inputs give the same bytes.
"""

import argparse
import contextlib
import json
import os
import platform
import re
import sys
import tempfile
import zipfile
from pathlib import Path

import numpy as np
from lxml import etree
from materials import PLACE, bill_of_materials
from sources import collect

from bearing_model.rivet.rivet_table import read

PROJECT = Path(__file__).resolve().parents[1]
LICENSES = ("LICENSE", "THIRD_PARTY_NOTICES.md")
SUFFIXES = {"linux64": ".so", "aarch64-linux": ".so", "darwin64": ".dylib", "aarch64-darwin": ".dylib", "win64": ".dll"}
HOSTS = {  # (system, machine) -> platform as FMI 2.0 names its folder; others as FMI 3.0 does
    ("Linux", "x86_64"): "linux64",
    ("Linux", "aarch64"): "aarch64-linux",
    ("Darwin", "x86_64"): "darwin64",
    ("Darwin", "arm64"): "aarch64-darwin",
    ("Windows", "AMD64"): "win64",
}
REFERENCE = "extra/org.fmi-standard.fmi-ls-ref"
STEP, STEPS = 1e-4, 10  # of the reference results [s]
CAGE_MODES = "extra/riveted-bearing/cage_modes.json"  # riveted_bearing/running/fmu.py reads it
MANIFEST = """<?xml version="1.0" encoding="UTF-8"?>
<fmiReferences xmlns:fmi-ls="http://fmi-standard.org/fmi-ls-manifest"
    fmi-ls:fmi-ls-name="org.fmi-standard.fmi-ls-ref"
    fmi-ls:fmi-ls-version="1.0.0-beta.1"
    fmi-ls:fmi-ls-description="Layered Standard providing information on related files included in an FMU.">
  <Related type="application/x-ma-hs-experiments" source="smoke_test.xml" role="experiment/smoke-test"
      description="The first millisecond from the start values, in the format of MA-HS-Experiments"/>
  <Related type="text/csv" source="{name}" role="result"
      description="Outputs from the start values at communication points of 1e-4 s; binaries agree to 1e-9 of each column's largest magnitude"/>
  <Related type="application/x-srmd-meta-data" source="validity.srmd" role="meta-data" description="Where the results hold"/>
</fmiReferences>
"""
VALIDITY = {  # keyword of an entry of the meta-data -> where the results hold
    "object": "deep-groove ball bearing with a two-piece riveted cage; number of balls, cage and rivet table are fixed by the build",
    "range": "min and max of each variable in modelDescription.xml; a value outside is refused",
    "measured range": "50 r/min to a speed times pitch diameter of 1.34e6 mm/min (machined cage) or 686,000 mm/min (ribbon)",
    "numerical error": "of statistics at solver.tol 1e-3: 2 % of means, 3 % of 99.9 % quantiles, 5 % of torque, land loss and dislocation, "
    "but for the scenes that docs/performance.md counts",
    "horizon": "trajectories over 1 ms, beyond it statistics alone: the motion is chaotic",
    "flags": "event.* and rivet[k].flag are not 0 where a result leaves the model",
    "left out": "flexible rings, heat balance, wear of pockets and lands, stress of the cage's bars, crack growth",
    "validation": "books, closed forms and published experiments on bearings; no test of rivets on a rig",
}
META_DATA = """<?xml version="1.0" encoding="UTF-8"?>
<srmd:SimulationResourceMetaData xmlns:srmd="http://ssp-standard.org/SSPTraceability1/SimulationResourceMetaData"
    xmlns:stc="http://ssp-standard.org/SSPTraceability1/SSPTraceabilityCommon" version="1.0.0" name="{model}, validity"
    data="../../modelDescription.xml">
  <stc:Classification type="riveted-bearing.validity">
{entries}
  </stc:Classification>
</srmd:SimulationResourceMetaData>
"""
EXPERIMENT = """<?xml version="1.0" encoding="UTF-8"?>
<Experiments name="Smoke tests">
  <Experiment name="First millisecond" description="From the start values, without inputs" tolerance="{tolerance}">
    <TransientSimulation startTime="0" stopTime="{stop:g}" stepSize="{step:g}"/>
    <References source="{name}"/>
  </Experiment>
</Experiments>
"""


def host_platform():
    """FMI's name of this machine; ValueError if it has none."""
    host = platform.system(), platform.machine()
    if host not in HOSTS:
        raise ValueError(f"host {' '.join(host)}: allowed are {', '.join(' '.join(known) for known in HOSTS)}")
    return HOSTS[host]


def platform_and_file(text):
    """PLATFORM=FILE, or FILE for the host."""
    name, equals, file = text.rpartition("=")
    name = name if equals else host_platform()
    if name not in SUFFIXES:
        raise ValueError(f"--binary {text}: platform {name}: allowed are {', '.join(SUFFIXES)}")
    return name, Path(file)


def package(options):
    """Write the FMU `options.out`: the file is complete or stays as it was.

    Raises OSError for a file that cannot be read or written, ValueError for a platform that FMI has no name for and for
    two sources of one name.
    """
    description = etree.parse(str(options.description), etree.XMLParser(remove_blank_text=True))
    root = description.getroot()
    simulation = root.find("CoSimulation")
    identifier = simulation.get("modelIdentifier")
    binaries = dict(map(platform_and_file, options.binary))
    sources, units = collect(options.source, options.include)
    if units:
        files = etree.Element("SourceFiles")
        for name in units:
            etree.SubElement(files, "File", name=name)
        simulation.insert(0, files)
    build = re.search(r'BUILD_DIGEST\[\] = "([0-9a-f]{64})"', options.build_info.read_text())[1]
    root.set("version", options.version)
    root.set("author", options.author)
    root.set("generationTool", f"riveted-bearing {options.version}, build {build[:12]}")
    members = {
        "modelDescription.xml": etree.tostring(description, encoding="UTF-8", xml_declaration=True, pretty_print=True)
    }
    members |= {f"binaries/{name}/{identifier}{SUFFIXES[name]}": file.read_bytes() for name, file in binaries.items()}
    members |= {f"sources/{name}": content for name, content in sources.items()}
    members |= {f"documentation/licenses/{name}": (PROJECT / name).read_bytes() for name in LICENSES}
    members |= {"documentation/index.html": options.page.read_bytes()} if options.page else {}
    members |= icons(options.pictures, options.terminals) if options.pictures else {}
    if options.reference:
        name = f"{identifier}_out.csv"
        tolerance = next(
            (v[0].get("start") for v in root.iter("ScalarVariable") if v.get("name") == "solver.tol"), "1e-3"
        )
        experiment = EXPERIMENT.format(name=name, tolerance=tolerance, step=STEP, stop=STEP * STEPS)
        members |= {
            f"{REFERENCE}/fmi-ls-manifest.xml": MANIFEST.format(name=name).encode(),
            f"{REFERENCE}/smoke_test.xml": experiment.encode(),
            f"{REFERENCE}/validity.srmd": meta_data(identifier).encode(),
            f"{REFERENCE}/{name}": options.reference.read_bytes(),
        }
    members |= {CAGE_MODES: cage_modes(options.rivet_table)} if options.rivet_table else {}
    materials = [material.split(maxsplit=2) for material in options.material]
    members[PLACE] = bill_of_materials(
        root.attrib, options.version, options.author, build, options.compiler.split(), materials, members
    )
    write_archive(members, options.out)


def meta_data(model):
    """Where the results hold, in the format of SSP Traceability's SRMD."""
    entry = '    <stc:ClassificationEntry keyword="{}">{}</stc:ClassificationEntry>'.format
    return META_DATA.format(model=model, entries="\n".join(map(entry, VALIDITY, VALIDITY.values())))


def cage_modes(rivet_table):
    """Frequencies [Hz] of a free cage half in a rivet table, how many modes have each (2 of a pair), and the half's
    mass [kg], as JSON.
    """
    table = read(rivet_table)
    omega, count = (table.modes.omega, table.modes.count) if table.modes else (np.zeros(0), np.zeros(0, int))
    content = {"mass": table.half.m, "frequency": (omega / (2.0 * np.pi)).tolist(), "modes": count.tolist()}
    return json.dumps(content, indent=1).encode() + b"\n"


def icons(folder, terminals):
    """The picture of the FMU; its terminals, if there are any, and their pictures."""
    members = {"model.png": (folder / "icon.png").read_bytes()}
    if terminals:
        members |= {f"terminalsAndIcons/{file.name}": file.read_bytes() for file in sorted(folder.glob("*.png"))}
        members["terminalsAndIcons/terminalsAndIcons.xml"] = terminals.read_bytes()
    return members


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
            with contextlib.suppress(OSError):  # a full disk refuses the rest of the buffer again
                file.close()
            os.unlink(file.name)
            raise


def main(arguments=None):
    parser = argparse.ArgumentParser(description="Pack an FMU.", fromfile_prefix_chars="@")
    parser.add_argument(
        "--description", type=Path, required=True, help="modelDescription.xml, without the list of sources"
    )
    parser.add_argument("--out", type=Path, required=True, help="the FMU to write")
    parser.add_argument(
        "--binary", action="append", default=[], metavar="[PLATFORM=]FILE", help="a shared library; repeatable"
    )
    parser.add_argument("--source", action="append", type=Path, default=[], help="a C file to compile; repeatable")
    parser.add_argument(
        "--include",
        action="append",
        type=Path,
        default=[],
        help="a folder of headers that go with the sources; repeatable",
    )
    parser.add_argument("--version", required=True, help="of the package")
    parser.add_argument("--author", required=True)
    parser.add_argument(
        "--build-info", type=Path, required=True, help="C file with the digest of the sources (build_info.py)"
    )
    parser.add_argument("--compiler", required=True, help="name and version of what compiled the binaries")
    parser.add_argument(
        "--material",
        action="append",
        default=[],
        metavar="KIND NAME ORIGIN",
        help="library NAME VERSION or data NAME FILE; repeatable",
    )
    parser.add_argument("--page", type=Path, help="documentation (page.py)")
    parser.add_argument("--pictures", type=Path, help="folder of the icons (picture.py)")
    parser.add_argument("--terminals", type=Path, help="terminalsAndIcons.xml")
    parser.add_argument("--rivet-table", type=Path, help="rivet table whose vibration modes are listed")
    parser.add_argument("--reference", type=Path, help="reference results (reference.py)")
    try:
        package(parser.parse_args(arguments))
    except (OSError, ValueError) as error:
        sys.exit(f"package: {error}")


if __name__ == "__main__":
    main()
