"""Writes the C file that tells one build of an FMU from another: a digest of all sources, headers included, wherever
they lie and whatever compiles them.

    python fmus/build_info.py --source fmi2_wrapper.c [...] --include FOLDER [...] --out build_info.c
    python fmus/build_info.py @arguments.txt --out build_info.c

Saved states pass between binaries with the same digest.
"""

import argparse
import hashlib
import sys
from pathlib import Path

from sources import collect

TEXT = """// Written by fmus/build_info.py: do not edit.
#include "host/build_info.h"

const char BUILD_DIGEST[] = "{digest}";
"""


def digest_of(files, folders):
    """SHA-256 of names and contents, in hexadecimal digits.  Raises OSError and ValueError as sources.collect."""
    contents, _ = collect(files, folders)
    digest = hashlib.sha256()
    for name, content in contents.items():
        digest.update(f"{name} {len(content)}\n".encode() + content)
    return digest.hexdigest()


def main(arguments=None):
    parser = argparse.ArgumentParser(description="Write the digest of the sources.", fromfile_prefix_chars="@")
    parser.add_argument("--source", action="append", type=Path, required=True, help="a C file of the FMU; repeatable")
    parser.add_argument("--include", action="append", type=Path, default=[], help="a folder of headers; repeatable")
    parser.add_argument("--out", type=Path, required=True, help="the C file to write")
    options = parser.parse_args(arguments)
    try:
        text = TEXT.format(digest=digest_of(options.source, options.include))
        if not options.out.is_file() or options.out.read_text() != text:
            options.out.write_text(text)
    except (OSError, ValueError) as error:
        sys.exit(f"build_info: {error}")


if __name__ == "__main__":
    main()
