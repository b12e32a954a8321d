"""Bearings by designation or file (docs/own_bearing.md, bearing_keys.py).  A number is SI, a text carries its unit.

What is left out comes from the catalogue (catalogue.py) if it knows the designation, by rule (scaling.py) from the rivet's
shank, and from balls and pitch diameter if these differ from the 6207's, else from the variable table; Case.origin says which.
"""

import math
from dataclasses import replace
from typing import Any

from bearing_model.generated import variables
from riveted_bearing.bearing.load_ratings import dynamic_rating, static_rating

from ..base.errors import UserError, refusal, refusing, unknown
from ..base.file_kinds import check_keys
from ..base.schema import checked
from ..base.toml_files import read_toml, section_of
from ..base.units import check_alike, rounded, to_si
from . import catalogue, materials, oil, ribbon, rivet_heads, seats
from .bearing_keys import RIVET_MATERIAL, RIVET_SIZES, BearingFile, RivetFile
from .case import Case
from .designations import find_bearing, shipped_bearings, unknown_designation
from .file_values import BOUNDARY, CATALOGUE, defaults, flat, shown, start_values, unit_of, unit_scales
from .origin import EXAMPLE, SOURCE
from .rules import CAGES, SHAPE, check_guidance, check_limits, in_cage, rules

CAGE_MEANT = (
    "Meant with a machined two-piece riveted cage, guided by the outer ring; for the pressed ribbon cage that many bearings "
    "of this designation carry add --cage ribbon"
)
KINDS_OF_CAGE = dict(
    zip(CAGES, ("a machined two-piece riveted cage", "a pressed two-piece riveted ribbon cage"), strict=True)
)
# the 6207's in a file that says neither them nor a designation
OF_EXAMPLE = ("Z", "bearing.D", "bearing.d_m", "shaft.F_x", "shaft.F_y", "shaft.omega")


def bearing_case(source: Any, rivet: Any = None, cage: Any = None) -> Case:
    """The Case of a designation or a bearing file; UserError naming file, key, value and what is allowed.

    rivet: (file, keys) of another rivet, whose new shank leaves nothing of the bearing's own; cage: one of CAGES or None.
    """
    if cage is not None and cage not in CAGES:
        raise unknown("--cage", "shape", cage, CAGES)
    designation = str(source)
    if designation in catalogue.entries() and designation not in shipped_bearings():
        description = f"Deep-groove ball bearing {designation} with {KINDS_OF_CAGE[cage or CAGES[0]]}"
        path, own, bare = f"catalogue bearing {designation}", "yours", cage is None
        document = {"designation": designation, "description": description}
    else:
        path, shipped = find_bearing(source), designation in shipped_bearings()
        own, bare, document = "shipped" if shipped else "yours", shipped and cage is None, read_toml(path)
        check_designation(path, document)
        document = {"designation": path.name.removesuffix(".toml")} | document
    prefix = "rivet."
    if rivet:
        (path, keys), prefix = rivet, ""
        kept = {} if "shank_diameter" in keys else section_of(path, document, "rivet")
        document["rivet"] = kept | keys
    document, usual = with_cage(path, document, cage)
    return read_case(path, document, own, bare, prefix, usual)


def with_cage(path, document, cage):
    """The document with the cage's shape in its parameters, and of a ribbon with its usual materials; parts that have them."""
    parameters = section_of(path, document, "parameters")
    written = dict(flat(parameters)).get("cage.shape")
    if cage is not None and written not in (None, cage):
        raise refusal(path, "parameters.cage.shape", written, f"--cage {cage} asks for another one")
    if (cage is None and written != "ribbon") or cage == CAGES[0]:
        return document, ()
    if document.get("designation") == EXAMPLE and "bearing.D" in dict(flat(parameters)) and cage is not None:
        reason = "the file is of the paper's bearing with its machined cage; name a file or 6205, 6309"
        raise refusal(path, "--cage", cage, reason)
    of_cage = parameters.get("cage") if isinstance(parameters.get("cage"), dict) else {}
    result, usual = document | {"parameters": parameters | {"cage": of_cage | {"shape": "ribbon"}}}, []
    for part, material in (("cage", ribbon.MATERIAL), ("rivet", ribbon.RIVET_MATERIAL)):
        section = section_of(path, document, part)
        named = "material" in section or "material" in of_cage
        if not named and not set(section) & set(materials.PARTS[part].properties):
            result[part] = {"material": material} | section
            usual.append(part)
    return result, tuple(usual)


def check_designation(path, document):
    """UserError for an unknown designation in a file that leaves the balls to it: they would be the 6207's."""
    designation = document.get("designation", "")
    if isinstance(designation, bool) or not isinstance(designation, str | int):
        raise refusal(path, "designation", designation, 'a text such as "6210" is needed')
    if "designation" not in document or str(designation) in catalogue.entries():
        return
    parameters = dict(flat(section_of(path, document, "parameters")))
    missing = [
        name for name, given in (("Z", document), *((name, parameters) for name in SHAPE[:2])) if name not in given
    ]
    if missing and not set(section_of(path, document, "catalogue")) >= set(CATALOGUE):
        problem = unknown_designation(path, "designation", document["designation"], catalogue.entries())
        raise UserError(f"{problem}; one that the catalogue does not have needs {', '.join(missing)} too")


def entry_of(path, designation, data, given, written):
    """The Entry that a file's own [catalogue] stands for; None where the file gives balls or only the 6207's values.

    data: its values in SI, written: as the file has them.
    """
    shape = [name for name in ("Z", *SHAPE[:2]) if given.get(name) is None]
    example = catalogue.entries()[EXAMPLE].data
    if not shape or len(shape) < 3 or all(example[key] == value for key, value in data.items()):
        return None
    if missing := [key for key in CATALOGUE if key not in data]:
        allowed = f"the balls need catalogue.{', catalogue.'.join(missing)} too, or give {', '.join(shape)}"
        raise UserError(f"{path}: catalogue.{next(iter(data))}: {allowed}")
    entry = catalogue.Entry(designation, **data)
    with refusing(path, "catalogue.outside_diameter", written["outside_diameter"]):
        catalogue.balls(entry)
    return entry


def read_case(path, document, own, bare=False, prefix="rivet.", usual=()):
    """The Case of a document; own: name of its origin; prefix: of the rivet's keys; usual: parts of usual material."""
    check_keys(path, document, BearingFile.model_fields, "bearing file")
    file = checked(BearingFile, document | {"rivet": {}}, path)
    rivet = checked(RivetFile, section_of(path, document, "rivet"), path, prefix.removesuffix("."))
    designation = str(document["designation"])
    entry = catalogue.entries().get(designation) if own != "shipped" else None
    Z, play = file.Z, file.catalogue.clearance
    data = {key: value for key, value in file.catalogue if key != "clearance" and value is not None}
    check_boundary(path, document, data, entry)
    tree = with_seats(path, plain_names(section_of(path, document, "parameters")), data, entry)
    given = dict(start_values(path, "parameters", tree, variables.PARAMETERS))
    if play is not None:
        given |= clearance_class(path, play, given, data, entry)
    if entry is None and own != "shipped":
        entry = entry_of(path, designation, data, {"Z": Z} | given, section_of(path, document, "catalogue"))
    inputs = dict(start_values(path, "inputs", section_of(path, document, "inputs"), variables.INPUTS))
    written = dict(flat(plain_names(section_of(path, document, "parameters"))))
    start = {name: v.start for name, v in variables.PARAMETERS.items() if name.startswith("oil.")}
    oil_name, of_oil = oil.named(path, document.get("oil"), given, start)
    given |= of_oil
    oil.check_pair(path, given, written)
    oil.check_given(path, given, written, start | given)
    found = {
        part: materials.material_of(path, part, material_section(path, document, part), given, written)
        for part in materials.PARTS
    }
    for part, material in found.items():
        given |= materials.parameters_of(part, material)
    sizes = rivet_sizes(path, rivet)
    steel = materials.geometry_of("rivet", found["rivet"])
    origin = dict.fromkeys([*(["Z"] if Z else []), *data, *given, *(f"rivet.{name}" for name in sizes), *inputs], own)

    origin |= dict.fromkeys(of_oil, oil.origin_of(oil_name))
    for part in usual:
        where = materials.PARTS[part]
        origin |= dict.fromkeys((name for name in (where.named, *where.parameters.values()) if name in given), "rule")
        found[part] = replace(found[part], given=())
    for part, material in found.items():  # a named material's, scaled to a strength of the file
        names = (materials.PARTS[part].parameters[key] for key in material.by_rule)
        origin |= dict.fromkeys((name for name in names if name in given), "rule")

    by_catalogue = {key: value for key, value in (entry.data if entry else {}).items() if key not in data}
    own_balls = entry is not None and Z not in (None, catalogue.balls(entry)[0])
    rated = {}
    if own_balls:
        shape = given.get("bearing.D", catalogue.balls(entry)[1]), given.get("bearing.d_m", entry.d_m)
        rated = {key: value for key, value in ratings(Z, *shape).items() if key not in data}
    data |= by_catalogue | rated
    parts = Z, given, sizes | steel, inputs, data, entry
    all_Z, by_rule, rivet_by_rule, inputs_by_rule = rules(*parts)
    origin |= dict.fromkeys(by_catalogue, "catalogue") | dict.fromkeys(rated, "rule")
    for name in ("Z", *by_rule, *(f"rivet.{name}" for name in rivet_by_rule), *inputs_by_rule):
        origin.setdefault(name, "rule")
    if not entry and own != "shipped":
        known = {*([] if Z is None else ["Z"]), *given, *inputs, *inputs_by_rule}
        origin |= dict.fromkeys((name for name in OF_EXAMPLE if name not in known), EXAMPLE)
    values = defaults() | by_rule | inputs_by_rule | given | inputs
    iso = ratings(all_Z, values["bearing.D"], values["bearing.d_m"])
    origin |= dict.fromkeys((name for name in iso if name not in data), "rule")
    data = iso | data
    inside = "" if prefix else in_cage(designation)
    called = lambda name: prefix + name.removeprefix("rivet.") if name.startswith("rivet.") else name
    check_limits(path, document, parts, called, inside)
    check_guidance(path, values)
    cage = found["cage"]  # of another density, if that is what a given mass means
    found["cage"] = replace(cage, values=cage.values | {"density": values["cage.rho"]})
    rivet = rivet_by_rule | sizes | steel
    given_values = values | {f"rivet.{name}": size for name, size in sizes.items()}
    allowed = drawing_ranges(path, file.between, given_values, origin, own)
    return Case(designation, file.description, all_Z, values, data, rivet, origin, found, allowed, bare, oil=oil_name)


def drawing_ranges(path, tree, values, origin, own):
    """(lowest, highest) by name of what the drawing allows of a file's own values [SI]."""
    found = {}
    for name, pair in flat(tree):
        unit = unit_with_range(path, name)
        if origin.get(name) != own:
            raise refusal(path, f"between.{name}", pair, "the file has to give its value too")
        if not isinstance(pair, list) or len(pair) != 2:
            raise refusal(path, f"between.{name}", pair, "[lowest, highest] is needed")
        with refusing(path, f"between.{name}", pair):
            check_alike(pair, unit_scales(unit))
            low, high = (to_si(end, unit_scales(unit)) for end in pair)
        if not (low < high and low <= values[name] <= high):
            own_value = shown(name, values[name], pair[0])
            reason = f"the lowest value must be below the highest, and {own_value} between them"
            raise refusal(path, f"between.{name}", pair, reason)
        found[name] = (low, high)
    return found


def unit_with_range(path, name):
    """SI unit of a value that a drawing or an operation may have between two ends: a number of the bearing, or a temperature."""
    if name.startswith("rivet.") and name.removeprefix("rivet.") in RIVET_SIZES:
        return unit_of(name)
    known = variables.PARAMETERS | {name: variables.INPUTS[name] for name in oil.ALL_TEMPERATURES}
    if name not in known:
        raise unknown(path, "value with a range", name, [*known, *(f"rivet.{size}" for size in RIVET_SIZES)])
    if known[name].type != "Real":
        raise UserError(f"{path}: between.{name}: only real numbers have ranges")
    return known[name].unit


def check_boundary(path, document, data, entry):
    """UserError for another boundary dimension than the designation's, from which the pitch circle follows."""
    for key in BOUNDARY:
        if entry and key in data and not math.isclose(data[key], entry.data[key], rel_tol=1e-6):
            written = document["catalogue"][key]
            allowed = shown(f"catalogue.{key}", entry.data[key], written)
            reason = f"{allowed} is allowed, of the {entry.designation} ({SOURCE}); leave designation or {key} out"
            raise refusal(path, f"catalogue.{key}", written, reason)


def ratings(Z, D, d_m):
    """C and C_0 [N] by ISO 281 and ISO 76 for Z balls [m], where no catalogue's hold."""
    return {"C": rounded(dynamic_rating(Z, D, d_m)), "C_0": rounded(static_rating(Z, D, d_m))}


def plain_names(tree):
    """Parameters of a bearing file with the cage's material by the name that the FMU has for it."""
    cage = tree.get("cage")
    if not isinstance(cage, dict) or not isinstance(cage.get("material"), str):
        return tree
    return tree | {"cage": cage | {"material": materials.code_of(cage["material"])}}


def material_section(path, document, part):
    """The keys of a part's section that are about its material."""
    section = section_of(path, document, part).items()
    return {key: value for key, value in section if part != "rivet" or key in RIVET_MATERIAL}


def rivet_sizes(path, rivet):
    """Dimensions of a RivetFile, given or by a standard's name."""
    sizes = {name: getattr(rivet, name) for name in RIVET_SIZES if getattr(rivet, name) is not None}
    return sizes if rivet.head is None else rivet_heads.head_of(path, rivet.head, sizes) | sizes


def clearance_class(path, name, given, data, entry):
    """bearing.P_d by the name of a class, which needs a bore and no clearance in [parameters] beside it."""
    if "bearing.P_d" in given:
        raise refusal(path, "catalogue.clearance", name, "allowed without bearing.P_d, which is given too")
    bore = data.get("bore", entry.bore if entry else None)
    if bore is None:
        raise refusal(path, "catalogue.clearance", name, "it needs catalogue.bore")
    P_d = catalogue.clearance(bore, name)
    if P_d is None:
        limit = f"the classes are of bores up to {catalogue.UP_TO[-1]} mm; give bearing.P_d"
        raise refusal(path, "catalogue.clearance", name, limit)
    return {"bearing.P_d": P_d}


def with_seats(path, tree, data, entry):
    """Parameters of a bearing file with the seats that it gives by tolerance classes as numbers [m]."""
    found = dict(tree)
    for name, value in flat(tree):
        if not seats.is_class(name, value):
            continue
        which, (group, _, key) = seats.SEATS[name][0], name.partition(".")
        size = data.get(which, getattr(entry, which, None))
        if size is None:
            raise refusal(path, f"parameters.{name}", value, f"it needs catalogue.{which}")
        with refusing(path, f"parameters.{name}", value):
            own = {key: seats.interference(name, value, size)}
        found = {n: v for n, v in found.items() if n != name} | {group: found.get(group, {}) | own}
    return found
