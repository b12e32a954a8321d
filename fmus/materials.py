"""Software bill of materials of an FMU (CycloneDX 1.6, JSON): what is in it, where from, under which licence, with
checksums.

The same members give the same bytes: no date, and a serial number that follows from the content.
"""

import hashlib
import json
import uuid
from importlib.metadata import version
from pathlib import Path

PLACE = "extra/org.cyclonedx/bom.json"
LIBRARIES = {  # name -> description, licence, package URL without its version
    "sundials": (
        "Suite of equation solvers: context, vectors and ARKODE, compiled from source",
        "BSD-3-Clause",
        "github/LLNL/sundials@v",
    ),
    "fmpy": ("Headers of FMI 2.0 by the Modelica Association, as fmpy carries them", "BSD-2-Clause", "pypi/fmpy@"),
}


def bill_of_materials(model, version, author, build, compiler, materials, members):
    """The bill as bytes.

    model: modelDescription's attributes; version, author: of the package; build: digest of all sources; compiler: name
    and version; materials: ("library", name, version) or ("data", name, path); members: content of the FMU's files by
    name.  OSError if data cannot be read.
    """
    parts = [("library", "fmpy", None), *materials]
    components = [component(*part) for part in parts]
    components += [file(name, content) for name, content in members.items() if name.startswith("binaries/")]
    document = {
        "$schema": "http://cyclonedx.org/schema/bom-1.6.schema.json",
        "bomFormat": "CycloneDX",
        "specVersion": "1.6",
        "version": 1,
        "metadata": {
            "tools": {
                "components": [{"type": "application", "name": " ".join(compiler[:-1]), "version": compiler[-1]}]
            },
            "component": {
                "type": "library",
                "bom-ref": "fmu",
                "name": model["modelName"],
                "version": version,
                "authors": [{"name": author}],
                "description": model["description"],
                "licenses": [{"license": {"id": model["license"]}}],
                "properties": [{"name": "fmi:guid", "value": model["guid"]}, {"name": "build", "value": build}],
            },
        },
        "components": components,
        "dependencies": [{"ref": "fmu", "dependsOn": [one["bom-ref"] for one in components]}],
    }
    serial = uuid.uuid5(uuid.NAMESPACE_URL, hashlib.sha256(json.dumps(document, sort_keys=True).encode()).hexdigest())
    return json.dumps(document | {"serialNumber": f"urn:uuid:{serial}"}, indent=1, ensure_ascii=False).encode() + b"\n"


def component(kind, name, origin):
    """A library with its version, or data with a checksum."""
    if kind == "data":
        return file(name, Path(origin).read_bytes()) | {"type": "data"}
    description, licence, package = LIBRARIES[name]
    number = origin or version(name)
    return {
        "type": "library",
        "bom-ref": name,
        "name": name,
        "version": number,
        "description": description,
        "licenses": [{"license": {"id": licence}}],
        "purl": f"pkg:{package}{number}",
    }


def file(name, content):
    return {
        "type": "file",
        "bom-ref": name,
        "name": name,
        "hashes": [{"alg": "SHA-256", "content": hashlib.sha256(content).hexdigest()}],
    }
