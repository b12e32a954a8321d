"""Packs a system structure description (SSP 1.0) with its resources.

    python fmus/system.py --description transmission.ssd --resource transmission.ssv --resource Shaft.fmu [...] --out
    Transmission.ssp

The same inputs give the same bytes.
"""

import argparse
import sys
from pathlib import Path

from package import write_archive


def main():
    parser = argparse.ArgumentParser(description="Pack an SSP.")
    parser.add_argument("--description", type=Path, required=True, help="SystemStructure.ssd")
    parser.add_argument("--resource", action="append", type=Path, default=[], help="FMU or parameter set; repeatable")
    parser.add_argument("--out", type=Path, required=True, help="the SSP to write")
    options = parser.parse_args()
    try:
        resources = {f"resources/{file.name}": file.read_bytes() for file in options.resource}
        write_archive({"SystemStructure.ssd": options.description.read_bytes()} | resources, options.out)
    except OSError as error:
        sys.exit(f"system: {error}")


if __name__ == "__main__":
    main()
