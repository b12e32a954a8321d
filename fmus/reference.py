"""Reference results by which an importer can check itself: all outputs of the first millisecond from the start values,
as CSV.

    python fmus/reference.py --description modelDescription.xml --binary RivetedBearing.so --out reference.csv

Motions are chaotic with an e-fold of 1.4 to 2.7 ms: beyond a few milliseconds only statistics can be compared.
"""

import argparse
import sys
from pathlib import Path

from fmpy import read_model_description
from fmpy.fmi2 import FMU2Slave
from package import STEP, STEPS, host_platform, platform_and_file


def simulate(description, binary):
    """Names and rows of the outputs at the communication points; raises fmpy's FMICallException if a call fails."""
    model = read_model_description(str(description), validate=False)
    outputs = [
        v for v in model.modelVariables if v.causality == "output" and not v.name.startswith(("solver.", "stat."))
    ]
    references = [v.valueReference for v in outputs]
    place = {"unzipDirectory": str(Path.cwd()), "libraryPath": str(binary.resolve())}
    slave = FMU2Slave(
        guid=model.guid, modelIdentifier=model.coSimulation.modelIdentifier, instanceName="reference", **place
    )
    slave.instantiate()
    slave.setupExperiment(startTime=0.0)
    slave.enterInitializationMode()
    slave.exitInitializationMode()
    rows = [(0.0, *slave.getReal(references))]
    for k in range(STEPS):
        slave.doStep(k * STEP, STEP)
        rows.append(((k + 1) * STEP, *slave.getReal(references)))
    slave.terminate()
    slave.freeInstance()
    return ["time", *(v.name for v in outputs)], rows


def main(arguments=None):
    parser = argparse.ArgumentParser(description="Write reference results.")
    parser.add_argument("--description", type=Path, required=True)
    parser.add_argument(
        "--binary", action="append", required=True, metavar="[PLATFORM=]FILE", help="repeatable; this host's is run"
    )
    parser.add_argument("--out", type=Path, required=True)
    options = parser.parse_args(arguments)
    binaries = dict(map(platform_and_file, options.binary))
    if host_platform() not in binaries:
        sys.exit(f"reference: no binary for {host_platform()}, only for {', '.join(binaries)}")
    names, rows = simulate(options.description, binaries[host_platform()])
    lines = [",".join(f'"{name}"' for name in names), *(",".join(f"{value:.17g}" for value in row) for row in rows)]
    options.out.write_text("\n".join(lines) + "\n")


if __name__ == "__main__":
    main()
