"""Two bearings of a spindle as an SSP at the FMU's own speed and thrust, radial loads wired; run with fmpy.

    python examples/spindle/two_bearings.py [--fmu RivetedBearing.fmu] [--out spindle.ssp]

The small SSP master of fmpy passes zeros in its very first step.  The first milliseconds therefore do not count, and
the speed is not wired here.  The SSP itself is for any tool.
"""

import argparse
import zipfile
from pathlib import Path

from fmpy.ssp.simulation import simulate_ssp

CONNECTORS = ("shaft.F_y", "input"), ("rivet.sigma_head_max", "output")
LOADS = {"F_A": "A", "F_B": "B"}  # input of the system -> bearing
SPACES = {"ssd": "Description", "ssc": "Common"}


def connector(name, kind):
    return f'<ssd:Connector name="{name}" kind="{kind}"><ssc:Real/></ssd:Connector>'


def component(name):
    inside = "".join(connector(*c) for c in CONNECTORS)
    fmu = 'type="application/x-fmu-sharedlibrary" source="resources/RivetedBearing.fmu"'
    return f'<ssd:Component name="{name}" {fmu}><ssd:Connectors>{inside}</ssd:Connectors></ssd:Component>'


def system():
    """SystemStructure.ssd as text."""
    spaces = " ".join(f'xmlns:{k}="http://ssp-standard.org/SSP1/SystemStructure{name}"' for k, name in SPACES.items())
    wire = '<ssd:Connection startConnector="{}" endElement="{}" endConnector="shaft.F_y"/>'
    wires = "".join(wire.format(load, bearing) for load, bearing in LOADS.items())
    inputs = "".join(connector(name, "input") for name in LOADS)
    elements = "".join(component(name) for name in LOADS.values())
    return f"""<?xml version="1.0" encoding="UTF-8"?>
<ssd:SystemStructureDescription version="1.0" name="spindle" {spaces}>
<ssd:System name="spindle"><ssd:Connectors>{inputs}</ssd:Connectors>
<ssd:Elements>{elements}</ssd:Elements><ssd:Connections>{wires}</ssd:Connections></ssd:System>
</ssd:SystemStructureDescription>"""


def write(fmu, path):
    with zipfile.ZipFile(path, "w") as ssp:
        ssp.writestr("SystemStructure.ssd", system())
        ssp.write(fmu, "resources/RivetedBearing.fmu")
    return path


def main(arguments=None):
    parser = argparse.ArgumentParser(description="Two bearings of a spindle as an SSP.")
    parser.add_argument("--fmu", type=Path, default=Path("RivetedBearing.fmu"))
    parser.add_argument("--out", type=Path, default=Path("spindle.ssp"))
    options = parser.parse_args(arguments)
    ssp = write(options.fmu, options.out)
    loads = {"F_A": lambda t: 2994.0, "F_B": lambda t: 1500.0}  # [N]
    result = simulate_ssp(str(ssp), stop_time=0.03, step_size=1e-4, input=loads)
    late = result[result["time"] > 0.01]
    a, b = (late[f"{name}.rivet.sigma_head_max"].max() / 1e6 for name in LOADS.values())
    print(f"A {a:.0f} MPa, B {b:.0f} MPa")


if __name__ == "__main__":
    main()
