"""C sources for the FMU's folder sources/: the files to compile and every header they include, side by side.

FMI 2.0.4, section 2.3: headers that travel with the FMU are included by "..."; those of FMI itself come from the
importer. With one flat folder, `cc -shared -fPIC -I<FMI headers> sources/*.c -lm` needs no path of its own.
"""

import re

INCLUDE = re.compile(rb'^([ \t]*#[ \t]*include[ \t]*)[<"]([^>"]+)[>"]', re.MULTILINE)


def collect(files, folders):
    """Contents by name of the C files and of all they include from the folders, includes rewritten to names alone; and
    the names of the C files.

    Raises ValueError if two files have the same name, OSError if one cannot be read.
    """
    found = {}  # name -> path
    contents = {}
    waiting = list(files)
    while waiting:
        path = waiting.pop()
        if path.name in found:
            if not found[path.name].samefile(path):
                raise ValueError(f"{found[path.name]} and {path}: two sources of one name")
            continue
        found[path.name] = path
        text = path.read_bytes()
        included = {name: find(name, path.parent, folders) for _, name in INCLUDE.findall(text)}
        waiting += [header for header in included.values() if header]
        contents[path.name] = INCLUDE.sub(lambda match, included=included: rewritten(match, included[match[2]]), text)
    return dict(sorted(contents.items())), sorted(file.name for file in files)


def find(name, neighbours, folders):
    """Path of an included file of ours; None for one of the system's or of FMI."""
    return next((path for folder in (neighbours, *folders) if (path := folder / name.decode()).is_file()), None)


def rewritten(match, path):
    return match[1] + b'"' + path.name.encode() + b'"' if path else match[0]
