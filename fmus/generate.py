"""Writes every file that is derived from a table of variables; the bearing's table is fmus/variables.toml.

python fmus/generate.py                                  write the tracked files
python fmus/generate.py --check                          compare them byte for byte, exit 1 on a difference
python fmus/generate.py --bearing FILE --out DIR         another bearing (balls, start values, description), all files into one folder
python fmus/generate.py --table FILE --out DIR           another part of a machine behind the same wrapper, all files into one folder
"""

import argparse
import fnmatch
import hashlib
import json
import math
import re
import sys
import tomllib
from dataclasses import asdict, dataclass, field, replace
from pathlib import Path
from typing import NamedTuple

import jinja2
from limits import read_limits
from lxml import etree

ROOT = Path(__file__).resolve().parent.parent
TABLE = ROOT / "fmus" / "variables.toml"
OUTPUTS = (
    "fmu_src/generated/variables.h",
    "fmu_src/generated/variables.c",
    "fmu_src/generated/limits.c",
    "fmu_src/generated/kernel_names.h",
    "fmus/modelDescription.xml",
    "bearing_model/generated/variables.py",
    "bearing_model/generated/limits.py",
    "docs/parameters.md",
)
TEMPLATES = ROOT / "fmus" / "templates"
Z_MIN, Z_MAX = 5, 32
CAUSALITIES = {"inputs": "input", "parameters": "parameter", "outputs": "output", "locals": "local"}
CALCULATED = ("output", "local")
BASE_UNITS = ("kg", "m", "s", "A", "K", "mol", "cd", "rad")
LABELS = {
    "m": "m",
    "um": "µm",
    "m/s2": "m/s²",
    "rad/s2": "rad/s²",
    "N/m1.5": "N/m^1.5",
    "kg.m2": "kg.m²",
    "kg/m3": "kg/m³",
    "degC": "°C",
}
LOG_CATEGORIES = {  # in the order of LogCategory in part.h
    "logStatusError": "Refused calls and values, failed steps: always sent",
    "logStatusWarning": "Done, but worth a look",
    "logEvents": "Course of the simulation",
    "logSolver": "Messages of the integrator",
    "logAll": "All of these",
}


@dataclass(frozen=True)
class Variable:
    """One entry of the table: a scalar, or the array of its elements."""

    name: str
    vr: int
    causality: str
    description: str
    type: str = "Real"
    unit: str = "1"
    display: str | None = None
    start: float | None = None
    min: float | None = None
    max: float | None = None
    nominal: float | None = None
    count: int = 1
    of_balls: bool = False  # whether count is the number of balls
    group: str | None = None
    source: str | None = None
    state: str | None = None
    derivative_of: str | None = None
    depends: tuple | None = None  # patterns of names; default: the group's
    choices: dict = field(default_factory=dict)  # numbers of an enumeration's items, by name
    built: bool = False  # whether the build fixes the value, for rivet table and run alike
    table: bool = False  # whether the build makes the rivet table from the value, which a run may change
    needs: dict = field(default_factory=dict)  # other values without which a run does not feel this one
    derives: bool = False  # whether the start value of a parameter stands for one that follows from others
    fixed: str | None = None  # why a parameter cannot change once a run has begun; None if it can

    @property
    def kind(self):
        """Real, Integer or Enumeration, as FMI calls the types."""
        return "Enumeration" if self.choices else self.type

    @property
    def limits(self):
        """Smallest and largest allowed value, infinite where none is given."""
        if self.choices:
            return min(self.choices.values()), max(self.choices.values())
        return -math.inf if self.min is None else self.min, math.inf if self.max is None else self.max

    def allows(self, value):
        """Whether a number lies within the limits, and is that of an item."""
        return value in self.choices.values() if self.choices else self.limits[0] <= value <= self.limits[1]

    @property
    def is_array(self):
        return "[" in self.name

    @property
    def size(self):
        """The count as text of the generated files: Z, which another build may change, or a number."""
        return "Z" if self.of_balls else str(self.count)

    @property
    def path(self):
        """Path in the C structs: ball[j].Q_i is ball.Q_i, an array."""
        return re.sub(r"\[\w\]", "", self.name)

    @property
    def elements(self):
        """Names and value references as FMI sees them, numbered from 1."""
        if not self.is_array:
            return [(self.name, self.vr)]
        return [(re.sub(r"\[\w\]", f"[{j + 1}]", self.name), self.vr + j) for j in range(self.count)]


@dataclass(frozen=True)
class StateBlock:
    name: str
    count: int
    scale: str
    unit: str
    description: str
    offset: int
    of_balls: bool


@dataclass(frozen=True)
class Table:
    Z: int | None  # number of balls; None if the part has none
    model_name: str
    description: str
    units: dict
    enumerations: dict
    groups: dict
    variables: tuple
    states: tuple
    # by parameter: usual range as factors of its value, share of the stress that goes with it, and the source
    assumptions: dict
    origin: dict  # where the values of another bearing come from, by name
    numbers: dict  # its boundary dimensions, load ratings and rivet, which are no variables
    ranges: dict  # what the drawing allows of its values, by name
    essentials: dict  # names by question
    retired_items: dict  # of enumerations: number and reason, by name
    elastic_states: tuple = ()  # behind the states, of elastic cage halves only
    limits: tuple = ()  # between parameters

    def named(self, name):
        """The variable of this name."""
        return next(v for v in self.variables if v.name == name)

    def of(self, *causalities):
        return [v for v in self.variables if v.causality in causalities]

    @property
    def guid(self):
        """Digest of all that description and binary must agree on."""
        content = {
            n: value for n, value in asdict(replace(self, limits=())).items() if n not in ("numbers", "ranges") or value
        }
        del content["limits"]
        digest = hashlib.sha256(json.dumps(content, sort_keys=True).encode()).hexdigest()
        return "{" + "-".join((digest[:8], digest[8:12], digest[12:16], digest[16:20], digest[20:32])) + "}"


def load_table(bearing=None, path=None):
    """The table, with Z and start values of a bearing file; ValueError names file, key, value and what is allowed."""
    path = path or TABLE
    raw = tomllib.loads(Path(path).read_text())
    changes = tomllib.loads(Path(bearing).read_text()) if bearing else {}
    Z, modes = (changes.get(name, raw.get(name)) for name in ("Z", "modes"))
    if "Z" in raw and (type(Z) is not int or not Z_MIN <= Z <= Z_MAX):
        raise ValueError(f"{bearing or path}: Z = {Z!r}: allowed is an integer from {Z_MIN} to {Z_MAX}")
    enumerations = {name: numbered(items) for name, items in raw["enumerations"].items()}
    variables = []
    for section, causality in CAUSALITIES.items():
        for entry in raw.get(section, {}).get("list", ()):
            count = {"count": Z, "of_balls": True} if entry.get("count") == "Z" else {}
            v = Variable(causality=causality, **entry | count)
            v = replace(v, choices={name: item.number for name, item in enumerations.get(v.type, {}).items()})
            if causality == "parameter":
                v = replace(v, fixed=why_fixed(raw.get("fixed", {}), v.path))
            variables.append(replace(v, start=Z) if v.group == "constant" else v)
    for section in ("parameters", "inputs"):
        for name, value in flatten(changes.get(section, {})):
            set_start(variables, CAUSALITIES[section], name, value, bearing)
    states, offset = [], 0
    for entry in (*raw["states"]["list"], *raw["states"].get("elastic", ())):
        count = {"Z": Z, "modes": modes}.get(entry["count"], entry["count"])
        states.append(StateBlock(**entry | {"count": count}, offset=offset, of_balls=entry["count"] == "Z"))
        offset += count
    n_plain = len(raw["states"]["list"])
    description = ". ".join(filter(None, (raw["description"], changes.get("description", raw.get("case")))))
    layout = raw["units"], enumerations, raw["groups"], tuple(variables), tuple(states[:n_plain])
    table = Table(
        Z,
        raw["model_name"],
        description,
        *layout,
        raw.get("assumptions", {}),
        changes.get("origin", {}),
        changes.get("numbers", {}),
        changes.get("ranges", {}),
        raw.get("essentials", {}),
        raw.get("retired_items", {}),
        tuple(states[n_plain:]),
        read_limits(raw.get("limits", {}).get("list", ()), variables),
    )
    check_table(table, path, raw.get("retired", ()))
    return table


class Item(NamedTuple):
    """One item of an enumeration: its number, and its meaning for readers."""

    number: int
    text: str


def numbered(items):
    """Items by name: each has the number after the one before it, or one of its own, because a retired number is not
    used again.
    """
    found, number = {}, 0
    for name, entry in items.items():
        own = isinstance(entry, dict)
        number = entry["number"] if own else number + 1
        found[name] = Item(number, entry["text"] if own else entry)
    return found


def flatten(nested, prefix=""):
    """Nested TOML tables as pairs of dotted name and value."""
    for key, value in nested.items():
        if isinstance(value, dict):
            yield from flatten(value, f"{prefix}{key}.")
        else:
            yield prefix + key, value


def why_fixed(reasons, path):
    """The reason for which the parameter of this path is fixed in a run; None if it is tunable."""
    return next((why for why, names in reasons.items() if any(fnmatch.fnmatchcase(path, n) for n in names)), None)


def set_start(variables, causality, name, value, source):
    """Another start value for one variable of the list; an enumeration's may be given by the name of its item."""
    places = {v.name: index for index, v in enumerate(variables) if v.causality == causality}
    if name not in places:
        raise ValueError(f"{source}: {name} = {value!r}: unknown {causality}, allowed are {', '.join(places)}")
    v = variables[places[name]]
    start = v.choices.get(value, value) if isinstance(value, str) else value
    right_type = type(start) in ((int, float) if v.kind == "Real" else (int,))
    if not right_type or not v.allows(start):
        what = (
            "one of " + ", ".join(v.choices)
            if v.choices
            else f"{v.limits[0]!r} ... {v.limits[1]!r} {v.unit} ({v.type})"
        )
        raise ValueError(f"{source}: {name} = {value!r}: allowed is {what}")
    variables[places[name]] = replace(v, start=float(start) if v.kind == "Real" else start)


def check_table(table, path, retired=()):
    """Every variable complete and consistent, every name and value reference given once and none that is retired; else
    ValueError.
    """
    names, references = {"time"}, {0: "time"} | dict.fromkeys(retired, "a variable that is gone")
    for v in table.variables:
        last = v.vr + (Z_MAX if v.of_balls else v.count)
        shared = {references[r] for r in range(v.vr, last) if r in references}
        references |= dict.fromkeys(range(v.vr, last), v.name)
        problems = {
            "given twice": v.name in names,
            f"shares value references with {', '.join(shared)}": shared,
            f"type {v.type!r} is not Real, Integer or an enumeration": v.type
            not in ("Real", "Integer", *table.enumerations),
            f"unknown unit {v.unit!r}": v.unit not in table.units,
            f"unknown display unit {v.display!r}": v.display
            and v.display not in table.units.get(v.unit, {}).get("display", {}),
            f"unknown group {v.group!r}": v.causality in CALCULATED and v.group not in table.groups,
            "no source": v.causality not in CALCULATED and not v.source,
            f"start {v.start!r} outside {v.limits}": v.causality not in CALCULATED
            and (v.start is None or not v.allows(v.start)),
        }
        names.add(v.name)
        for problem, found in problems.items():
            if found:
                raise ValueError(f"{path}: {v.name}: {problem}")
    for name, items in table.retired_items.items():
        used = {item.number for item in table.enumerations[name].values()}
        for item, (number, _) in items.items():
            if number in used or item in table.enumerations[name]:
                raise ValueError(f"{path}: {name}: {item} = {number} is retired")
    for name in (name for group in table.essentials.values() for name in group):
        if name not in names:
            raise ValueError(f"{path}: essentials: unknown variable {name}")
    for s in (*table.states, *table.elastic_states):
        if s.unit not in table.units:
            raise ValueError(f"{path}: {s.name}: unknown unit {s.unit!r}")


# ----------------------------------------------------------------------------------------------------------- text files


def screaming(name):
    """TiltMode, ball_x -> TILT_MODE, BALL_X."""
    return re.sub(r"(?<=[a-z])(?=[A-Z])", "_", name).upper()


def struct_members(variables):
    """The variables by C struct: [(struct, [(member, variable), ...]), ...]."""
    structs = {}
    for v in variables:
        struct, member = v.path.split(".")
        structs.setdefault(struct, []).append((member, v))
    return list(structs.items())


def given_member(v):
    """Member of Parameters.given: whether the host has given the parameter a value."""
    return v.path.replace(".", "_")


def c_number(value):
    return {math.inf: "INFINITY", -math.inf: "-INFINITY"}.get(value, repr(float(value)))


def quoted(value):
    """A string literal of C and Python; None stays None."""
    return None if value is None else json.dumps(value, ensure_ascii=False)


def named_in(name, table):
    return table.named(name)


def label(unit):
    return LABELS.get(unit, unit)


def display_unit(table, unit, display):
    """Factor and offset: value in the display unit = factor * value + offset."""
    factor = table.units[unit]["display"][display] if display else 1.0
    return factor if isinstance(factor, list) else (factor, 0.0)


def shown(value, v, table):
    """A value in its display unit, for readers."""
    if v.choices:
        return next(name for name, number in v.choices.items() if number == value)
    factor, offset = display_unit(table, v.unit, v.display)
    digits = f"{value}" if v.type == "Integer" else f"{value * factor + offset:.6g}"
    return digits.replace("-", "−") + ("" if v.unit == "1" else f" {label(v.display or v.unit)}")


def allowed(v, table):
    """Allowed values, for readers."""
    if v.choices:
        return ", ".join(f"{name} ({number})" for name, number in v.choices.items())
    limits = " … ".join(shown(value, v, table) for value in v.limits)
    return f"{limits}, an Integer" if v.type == "Integer" else limits


def feeds(v):
    """What a parameter feeds, for readers."""
    needs = " and ".join(
        f"a changing `{name}`" if isinstance(value, dict) else f"`{name}` = {value}" for name, value in v.needs.items()
    )
    return ("rivet table, run" if v.built or v.table else "run") + (f", there with {needs}" if needs else "")


def kernel_functions():
    """Functions of the kernel files that other files call: those that are not static."""
    files = re.search(r"set\(kernel_files(.*?)\)", (ROOT / "cmake" / "core.cmake").read_text(), re.DOTALL)[1].split()
    function = re.compile(r"^(?!static |INLINE |ONCE |typedef |extern )[a-z][\w ]*[ *](\w+)\(", re.MULTILINE)
    return sorted({name for file in files for name in function.findall((ROOT / "fmu_src" / file).read_text())})


def render(template, table, source):
    """A template of fmus/templates filled in."""
    environment = jinja2.Environment(
        trim_blocks=True, lstrip_blocks=True, keep_trailing_newline=True, undefined=jinja2.StrictUndefined
    )
    environment.filters |= {
        f.__name__: f for f in (given_member, screaming, struct_members, c_number, quoted, label, named_in)
    }
    scales = list(dict.fromkeys(s.scale for s in (*table.states, *table.elastic_states)))
    words = {"shown": shown, "allowed": allowed, "feeds": feeds, "kernel_functions": kernel_functions()}
    return environment.from_string((TEMPLATES / template).read_text()).render(
        table=table, source=source, scales=scales, **words
    )


# ------------------------------------------------------------------------------------------------- modelDescription.xml


def write_description(table):
    """modelDescription.xml of FMI 2.0 for co-simulation."""
    root = etree.Element(
        "fmiModelDescription",
        fmiVersion="2.0",
        modelName=table.model_name,
        guid=table.guid,
        description=table.description,
        license="BSD-2-Clause",
        generationTool="fmus/generate.py",
        variableNamingConvention="structured",
        numberOfEventIndicators="0",
    )
    etree.SubElement(
        root,
        "CoSimulation",
        modelIdentifier=table.model_name,
        canHandleVariableCommunicationStepSize="true",
        canInterpolateInputs="true",
        maxOutputDerivativeOrder="1",
        canNotUseMemoryManagementFunctions="true",
        canGetAndSetFMUstate="true",
        canSerializeFMUstate="true",
        providesDirectionalDerivative="true",
    )
    add_units(root, table)
    if table.enumerations:
        add_types(root, table)
    add_log_categories(root)
    settle = next((v.start for v in table.variables if v.name == "start.settle"), 0.0)
    # a tolerance here would overrule solver.tol
    etree.SubElement(root, "DefaultExperiment", startTime="0", stopTime=f"{max(0.4, 2.0 * settle):g}", stepSize="1e-4")
    if table.origin:
        add_origin(root, table)
    indices = add_variables(root, table)
    add_structure(root, table, indices)
    return etree.tostring(root, encoding="UTF-8", xml_declaration=True, pretty_print=True).decode()


def add_units(root, table):
    definitions = etree.SubElement(root, "UnitDefinitions")
    for name, entry in table.units.items():
        unit = etree.SubElement(definitions, "Unit", name=name)
        if entry.get("dimension") != "open":
            etree.SubElement(unit, "BaseUnit", {base: str(entry[base]) for base in BASE_UNITS if base in entry})
        for display in entry.get("display", {}):
            factor, offset = display_unit(table, name, display)
            etree.SubElement(
                unit, "DisplayUnit", name=display, factor=repr(factor), **({"offset": repr(offset)} if offset else {})
            )


def add_types(root, table):
    definitions = etree.SubElement(root, "TypeDefinitions")
    for name, items in table.enumerations.items():
        enumeration = etree.SubElement(etree.SubElement(definitions, "SimpleType", name=name), "Enumeration")
        for name_of_item, item in items.items():
            etree.SubElement(enumeration, "Item", name=name_of_item, value=str(item.number), description=item.text)


def add_log_categories(root):
    categories = etree.SubElement(root, "LogCategories")
    for name, description in LOG_CATEGORIES.items():
        etree.SubElement(categories, "Category", name=name, description=description)


def add_origin(root, table):
    """Where start values come from, for `riveted-bearing run`: an annotation that other tools pass over.  FMI 2.0
    allows one element in a tool's.
    """
    tool = etree.SubElement(etree.SubElement(root, "VendorAnnotations"), "Tool", name="riveted-bearing")
    values = etree.SubElement(tool, "Origin")
    for name, origin in table.origin.items():
        value = {"value": repr(table.numbers[name])} if name in table.numbers else {}
        ends = zip(("low", "high"), map(repr, table.ranges.get(name, ())), strict=False)
        etree.SubElement(values, "Value", name=name, origin=origin, **value, **dict(ends))


def add_variables(root, table):
    """ModelVariables; returns the index of each scalar variable, from 1."""
    variables = etree.SubElement(root, "ModelVariables")
    time = etree.SubElement(
        variables,
        "ScalarVariable",
        name="time",
        valueReference="0",
        description="Simulation time",
        causality="independent",
        variability="continuous",
    )
    etree.SubElement(time, "Real", unit="s")
    indices = {"time": 1}
    for v in table.variables:
        indices |= {name: len(indices) + i for i, (name, _) in enumerate(v.elements, start=1)}
    for v in table.variables:
        for name, vr in v.elements:
            scalar = etree.SubElement(
                variables,
                "ScalarVariable",
                name=name,
                valueReference=str(vr),
                description=v.description,
                causality=v.causality,
                **variability(v),
            )
            etree.SubElement(scalar, v.kind, value_attributes(v, indices))
    return indices


def variability(v):
    if v.causality == "parameter":
        return {"variability": "fixed" if v.fixed else "tunable", "initial": "exact"}
    if v.group == "constant":
        return {"variability": "constant", "initial": "exact"}
    return {"variability": "continuous"} | ({"initial": "calculated"} if v.causality in CALCULATED else {})


def value_attributes(v, indices):
    """Attributes of Real, Integer or Enumeration."""
    attributes = {"declaredType": v.type} if v.choices else {}
    if v.type == "Real":
        attributes |= {
            "unit": v.unit,
            "displayUnit": v.display,
            "derivative": v.derivative_of and indices[v.derivative_of],
        }
        attributes |= {"min": v.min, "max": v.max, "nominal": v.nominal}
    elif v.type == "Integer":
        attributes |= {"min": v.min, "max": v.max}
    attributes["start"] = v.start
    return {key: str(value) for key, value in attributes.items() if value is not None}


def add_structure(root, table, indices):
    """Outputs and derivatives with their dependencies, and the unknowns of initialization (FMI 2.0.4, section 2.2.8)."""
    structure = etree.SubElement(root, "ModelStructure")
    outputs = etree.SubElement(structure, "Outputs")
    for v in table.of("output"):
        for name, _ in v.elements:
            etree.SubElement(outputs, "Unknown", index=str(indices[name]), dependencies=dependencies(v, table, indices))
    derivatives = etree.SubElement(structure, "Derivatives")
    for v in table.of("output"):
        if v.derivative_of:
            etree.SubElement(
                derivatives, "Unknown", index=str(indices[v.name]), dependencies=dependencies(v, table, indices)
            )
    unknowns = etree.SubElement(structure, "InitialUnknowns")
    for v in table.of("output"):
        if v.group != "constant":
            for name, _ in v.elements:
                etree.SubElement(unknowns, "Unknown", index=str(indices[name]))


def dependencies(v, table, indices):
    """Indices of the inputs and states that an output depends on directly."""
    patterns = (
        [v.name, *(v.depends or ())]
        if v.state
        else table.groups[v.group]["depends"]
        if v.depends is None
        else v.depends
    )
    known = [k.name for k in table.variables if k.causality == "input" or k.state]
    return " ".join(
        str(indices[name]) for name in known if any(fnmatch.fnmatchcase(name, pattern) for pattern in patterns)
    )


# -------------------------------------------------------------------------------------------------------------- command


def generate(bearing=None, path=None):
    """Contents of all files by their place in the project; ValueError if the table or the bearing file is wrong."""
    table = load_table(bearing, path)
    source = Path(path).name if path else TABLE.relative_to(ROOT).as_posix()
    return {
        place: write_description(table) if place.endswith(".xml") else render(Path(place).name, table, source)
        for place in OUTPUTS
    }


def main(arguments=None):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument(
        "--bearing", type=Path, help="bearing file (riveted_bearing/data/bearings) with Z and start values"
    )
    parser.add_argument("--table", type=Path, help="another part's table of variables")
    parser.add_argument("--out", type=Path, help="one folder for all files, instead of their places in the project")
    parser.add_argument("--check", action="store_true", help="write nothing, compare")
    options = parser.parse_args(arguments)
    if (options.bearing or options.table) and not options.out and not options.check:
        parser.error("--bearing and --table need --out: the tracked files are those of the bearing's own table")
    try:
        files = generate(options.bearing, options.table)
    except (OSError, ValueError) as error:
        sys.exit(f"generate: {error}")
    places = {
        (options.out / Path(name).name if options.out else ROOT / name): content for name, content in files.items()
    }
    if options.check:
        stale = [
            str(path) for path, content in places.items() if not path.is_file() or path.read_bytes() != content.encode()
        ]
        sys.exit(f"generate: not what {(options.table or TABLE).name} says: {', '.join(stale)}" if stale else 0)
    for path, content in places.items():
        path.parent.mkdir(parents=True, exist_ok=True)
        # unchanged files keep their time stamps, so that nothing is recompiled
        if not path.is_file() or path.read_bytes() != content.encode():
            path.write_bytes(content.encode())


if __name__ == "__main__":
    main()
