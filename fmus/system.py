"""Packs a system structure description (SSP) with its resources.

    python fmus/system.py --description transmission.ssd --resource transmission.ssv --resource Shaft.fmu [...] --out
    Transmission.ssp [--version 2.0]

The same inputs give the same bytes.  The files are written for SSP 1.0, which fmpy 0.3 reads alone; what they use stayed as it is in 2.0, so
that another version is another attribute.
"""

import argparse
import re
import sys
from pathlib import Path

from package import write_archive

ROOT = re.compile(rb'(<ss[dv]:\w+ [^>]*\bversion=")[\d.]+')


def content(file, version):
    """A file's bytes, a description's or parameter set's root with the version of SSP."""
    data = file.read_bytes()
    return ROOT.sub(rb"\g<1>" + version.encode(), data, count=1) if file.suffix in (".ssd", ".ssv") else data


def main():
    parser = argparse.ArgumentParser(description="Pack an SSP.")
    parser.add_argument("--description", type=Path, required=True, help="SystemStructure.ssd")
    parser.add_argument("--resource", action="append", type=Path, default=[], help="FMU or parameter set; repeatable")
    parser.add_argument("--version", choices=("1.0", "2.0"), default="1.0", help="of SSP")
    parser.add_argument("--out", type=Path, required=True, help="the SSP to write")
    options = parser.parse_args()
    try:
        files = {"SystemStructure.ssd": options.description} | {
            f"resources/{file.name}": file for file in options.resource
        }
        write_archive({name: content(file, options.version) for name, file in files.items()}, options.out)
    except OSError as error:
        sys.exit(f"system: {error}")


if __name__ == "__main__":
    main()
