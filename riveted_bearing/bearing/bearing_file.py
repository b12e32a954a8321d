"""Bearings by designation or file: given values, values of the catalogue, values by rule, and results that need no
simulation.

    designation = "6310"  # one of the catalogue's fills in what is not given below
    Z = 8
    oil = "mineral ISO VG 32"  # optional (oil.py)
    [catalogue]           # optional: bore, outside_diameter, width [m], C, C_0, C_u, minimum_load [N]
    [parameters]          # start values of the FMU made from this file
    bearing.D = "19.05 mm"
    [cage]                # optional, like [rings], [balls] and [rivet]: material by name or as a table, single properties (materials.py)
    material = "steel"
    [rivet]               # optional: dimensions by the names of rivet_model.geometry
    shank_diameter = "2 mm"
    head = "DIN 660"      # optional: head diameter and height by a standard (rivet_heads.py)
    [inputs]              # start values too
    shaft.F_y = 6000.0

A number is SI, a text carries its unit.  What is left out comes from the catalogue (catalogue.py) if it knows the
designation, by rule (scaling.py) from the rivet's shank, and from balls and pitch diameter if these differ from the
6207's, else from the variable table; Case.origin says which.
"""

import math
import re
from dataclasses import dataclass, field, fields, replace
from importlib.resources import files
from pathlib import Path

import numpy as np

from bearing_model.generated import variables
from bearing_model.load_ratings import dynamic_rating, reference_viscosity, static_rating
from bearing_model.physics.derived import ball_elasticity, default_table
from bearing_model.physics.parameters import Values
from bearing_model.physics.ring_fit import ring_fit_of
from bearing_model.physics.temperature import temperature_apply
from bearing_model.quasi_static import Bearing, Load, quasi_static
from rivet_model.geometry import Geometry

from ..base.errors import UserError, is_file, unknown
from ..base.file_kinds import OF_BEARINGS, check_keys
from ..base.units import scales_of, suffix, symbol_of, to_si
from ..running.scene import load_scene, positive, read_toml, refusal, section_of, shipped_scenes
from . import catalogue, limits, materials, oil, ribbon, rivet_heads, scaling, seats
from .origin import EXAMPLE, SOURCE

SHIPPED = files("riveted_bearing") / "data" / "bearings"
LARGEST_RIVET = 1.0  # m
KEYS = ("designation", "description", "Z", "oil", "catalogue", "parameters", *materials.PARTS, "inputs")
BOUNDARY = ("bore", "outside_diameter", "width")
CATALOGUE = (*BOUNDARY, "C", "C_0")
OF_MAKERS = ("C_u", "minimum_load")  # further forces of a catalogue, by rule where they are missing
# a bearing's own
CAGE_SIZES = (
    "Z",
    "d_m",
    "ball_diameter",
    "pocket_clearance",
    "cage_outer_diameter",
    "cage_inner_diameter",
    "cage_half_width",
    "shape",
    "pocket_fillet",
)
CAGE_MATERIAL = tuple(materials.PARTS["cage"].geometry.values())
# the rivet's own, with the defaults
RIVET = {f.name: f.default for f in fields(Geometry) if f.name not in (*CAGE_SIZES, *CAGE_MATERIAL)}
RIVET_MATERIAL = ("material", "source", *materials.PARTS["rivet"].properties)
RIVET_SIZES = tuple(name for name in RIVET if name not in materials.PARTS["rivet"].geometry.values())
CAGE_MEANT = (
    "Meant with a machined two-piece riveted cage, guided by the outer ring; for the pressed ribbon cage that many bearings "
    "of this designation carry add --cage ribbon"
)
CAGES = ("machined", "ribbon")
KINDS_OF_CAGE = dict(
    zip(CAGES, ("a machined two-piece riveted cage", "a pressed two-piece riveted ribbon cage"), strict=True)
)
SHAPE = ("bearing.D", "bearing.d_m", "cage.D_o", "cage.D_i", "cage.width")  # what the rules follow from
OF_HEAD = ("rivet.head_diameter", "rivet.head_height")  # what a standard's name decides
# the 6207's in a file that says neither them nor a designation
OF_EXAMPLE = ("Z", "bearing.D", "bearing.d_m", "shaft.F_x", "shaft.F_y", "shaft.omega")


@dataclass(frozen=True)
class Case:
    """A bearing at work: catalogue data, SI values or item names by the FMU's full variable names, dimensions of the
    rivet.

    origin: "catalogue", "rule", "yours" (a file's), "shipped" (a shipped file's) or "6207" (OF_EXAMPLE) by name; what
    is not in it has the variable table's default.
    rivet: dimensions and material of the rivet by the names of rivet_model.geometry, None if not known; materials: the
    Material of each part, of a bearing file's case.
    bare: whether only a designation was given, which says nothing of the cage; alone: what a scene sets of a bearing's
    shape, from which nothing follows; model: the Model of a scene's case; oil: the name of its oil, "" for none;
    cleanliness: of the oil, as of raceways.cleanliness_of, None if nobody gave one.
    """

    designation: str
    description: str
    Z: int
    values: dict
    catalogue: dict = field(default_factory=dict)
    rivet: dict = field(default_factory=dict)
    origin: dict = field(default_factory=dict)
    materials: dict = field(default_factory=dict)
    bare: bool = False
    alone: tuple = ()
    model: object = field(default=None, compare=False)
    oil: str = ""
    cleanliness: object = None

    def __repr__(self):
        return f"<Case {self.designation}: {self.description or 'no description'}; Z = {self.Z}, {len(self.values)} values>"

    @property
    def bearing(self):
        """Geometry and material for the quasi-static model, at the present temperatures and fits."""
        tables = variables.PARAMETERS, variables.INPUTS
        parameters, inputs = ({name: v for name, v in table.items() if v.count == 1} for table in tables)
        p, u = (
            Values(table, {name: self.values[name] for name in table if name in self.values})
            for table in (parameters, inputs)
        )
        hot = temperature_apply(p, u, default_table())
        at_work = {f.name: getattr(hot.bearing, f.name) for f in fields(Bearing) if hasattr(hot.bearing, f.name)}
        return Bearing(
            **at_work,
            ball=ball_elasticity(hot),
            Z=self.Z,
            C=self.catalogue.get("C"),
            C_0=self.catalogue.get("C_0"),
            fit=ring_fit_of(hot),
        )

    def value(self, name):
        """A value, the variable table's start where the case has none."""
        return self.values.get(name, (variables.PARAMETERS | variables.INPUTS)[name].start)

    @property
    def field(self):
        """Gravity and the frame's inertia at the bearing's centre [m/s2] (bearing_model/physics/frame.py)."""
        w, R, w_dot = (self.value(f"frame.{name}") for name in ("omega", "radius", "omega_dot"))
        inertia = 0.0, w * w * R - self.value("frame.a_y"), -w_dot * R - self.value("frame.a_z")
        return (-self.value("frame.a_x"), self.value("gravity.y") + inertia[1], self.value("gravity.z") + inertia[2])

    @property
    def load(self):
        """Loads, speeds and support of the inner ring relative to the outer one for the quasi-static model: gravity and
        the frame's inertia act on ring.m and the balls.
        """
        given = {f.name: self.value(f"shaft.{f.name}") for f in fields(Load) if f"shaft.{f.name}" in variables.INPUTS}
        given |= {name: given.get(name, 0.0) - self.value(f"housing.{name}") for name in ("tilt_y", "tilt_z")}
        given["F_x"] += self.value("impact.F_a")
        F_r, impact = math.hypot(given["F_y"], given["F_z"]), self.value("impact.F_r")
        cos, sin = (given["F_y"] / F_r, given["F_z"] / F_r) if F_r else (1.0, 0.0)
        given |= {"F_y": given["F_y"] + impact * cos, "F_z": given["F_z"] + impact * sin}
        weight = self.value("ring.m") * np.array(self.field)
        given |= {f"F_{a}": given[f"F_{a}"] + float(weight[k]) for k, a in enumerate("xyz")}
        given |= {"omega_e": self.value("housing.omega"), "frame_omega": self.value("frame.omega"), "field": self.field}
        mode = self.values.get("ring.tilt_mode", "prescribed")
        if mode == "prescribed":
            return Load(**given | {"M_y": 0.0, "M_z": 0.0})
        return Load(**given, k_tilt=self.values["ring.k_tilt"] if mode == "supported" else 0.0)

    @property
    def viscosity(self):
        """Viscosity of the oil at its temperature [Pa.s]; ValueError if its two points make no oil."""
        table = {name: v for name, v in variables.PARAMETERS.items() if name.startswith("oil.")}
        start = {n: self.model.default(self.model.parameters[n]) if self.model else v.start for n, v in table.items()}
        return oil.viscosity({name: self.value(name) for name in start}, start, self.value("oil.T"))

    @property
    def oil_density(self):
        """Density of the oil at its temperature [kg/m3]."""
        warmer = self.value("oil.T") - self.value("oil.T_0")
        return self.value("oil.rho") * (1.0 - self.value("oil.expansion") * warmer)

    @property
    def kappa(self):
        """Viscosity ratio nu/nu_1 of ISO 281, nan at rest."""
        omega = self.load.omega - self.load.omega_e
        if not omega:
            return math.nan
        return self.viscosity / self.oil_density / reference_viscosity(omega, self.values["bearing.d_m"])

    @property
    def joint(self):
        """Dimensions of rivet and cage for rivet_model.geometry.Geometry."""
        v = self.values
        return {
            "Z": self.Z,
            "d_m": v["bearing.d_m"],
            "ball_diameter": v["bearing.D"],
            "pocket_clearance": v["cage.pocket_clearance"],
            "cage_outer_diameter": v["cage.D_o"],
            "cage_inner_diameter": v["cage.D_i"],
            "cage_half_width": round(0.5 * v["cage.width"], 12),
            # without the rounding of the difference: the table's digest knows every bit
            "patch_radius": round((v["cage.D_o"] - v["cage.D_i"]) / 4.0, 12),
            **materials.geometry_of("cage", self.materials["cage"]),
            **({"shape": "ribbon", "pocket_fillet": v["cage.pocket_fillet"]} if ribbon.is_ribbon(v) else {}),
        } | self.rivet

    def equilibrium(self):
        """The QuasiStatic of ring and balls; UserError if there is none."""
        return self.solved(self.load, "exact")

    def standard_equilibrium(self):
        """The QuasiStatic as ISO/TS 16281 has it, with linear kinematics and without centrifugal forces at its speeds;
        UserError if there is none.
        """
        at_rest = self.solved(replace(self.load, omega=0.0, omega_e=0.0, frame_omega=0.0), "linear")
        return replace(at_rest, load=self.load)

    def solved(self, load, kinematics):
        """The QuasiStatic under a load; UserError if there is none."""
        try:
            return quasi_static(self.bearing, load, kinematics=kinematics)
        except (ValueError, ArithmeticError) as problem:
            raise UserError(f"{self.designation}: {problem}") from None

    def of_origin(self, origin):
        """Names of the values of one origin."""
        return [name for name, found in self.origin.items() if found == origin]


def shipped_bearings():
    """Designations of the bearings that come as files with the program."""
    return sorted(path.name.removesuffix(".toml") for path in SHIPPED.iterdir() if path.name.endswith(".toml"))


def known_bearings():
    """Designations that need no file: shipped ones and the catalogue's."""
    return [*shipped_bearings(), *(name for name in catalogue.entries() if name not in shipped_bearings())]


def find_bearing(source):
    """The file of a bearing given by path or by designation."""
    if str(source) in shipped_bearings():
        return SHIPPED / f"{source}.toml"
    if is_file(source):
        return Path(source)
    raise unknown_designation("bearing", "name or file", source, known_bearings())


def unknown_designation(where, kind, name, known):
    """The error for a designation that is not among the known ones: one with a suffix leads to the designation without
    it, another number to no other bearing.
    """
    name = str(name)
    number = re.match(r"\d{4,}(?!\d)", name)
    if number and number[0] in known and number[0] != name:
        return UserError(
            f'{where}: unknown {kind} "{name}"; did you mean "{number[0]}"? Suffixes for seals, cage and clearance are not '
            'part of the name: a bearing file has clearance = "C3" in [catalogue]'
        )
    if number:
        return UserError(
            f'{where}: unknown {kind} "{name}"; the catalogue has {len(catalogue.entries())} bearings of the series 60, 62, 63 '
            "and 64 with bores of 10 to 110 mm; a bearing file describes others"
        )
    if Path(name).suffix == ".toml" or Path(name).name != name:
        return UserError(f"{where}: {name}: no such file")
    return unknown(where, kind, name, known)


def is_bearing(source):
    """Whether a name or file means a bearing, not a scene."""
    if str(source) in known_bearings() or str(source) in shipped_scenes():
        return str(source) in known_bearings()
    return is_file(source) and not read_toml(Path(source)).keys().isdisjoint(OF_BEARINGS)


def bearing_case(source, rivet=None, cage=None):
    """The Case of a designation or a bearing file; UserError naming file, key, value and what is allowed.

    rivet: file and keys of another rivet, as in a section [rivet]: a new shank leaves nothing of the bearing's own
    rivet; cage: one of CAGES, None: the file's, else machined.
    """
    if cage is not None and cage not in CAGES:
        raise unknown("--cage", "shape", cage, CAGES)
    designation = str(source)
    if designation in catalogue.entries() and designation not in shipped_bearings():
        description = f"Deep-groove ball bearing {designation} with {KINDS_OF_CAGE[cage or CAGES[0]]}"
        path, own, document = (
            f"catalogue bearing {designation}",
            "yours",
            {"designation": designation, "description": description},
        )
        bare = cage is None
    else:
        path = find_bearing(source)
        bare = designation in shipped_bearings() and cage is None
        own, document = "shipped" if designation in shipped_bearings() else "yours", read_toml(path)
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
        raise refusal(
            path,
            "--cage",
            cage,
            f"the file is of the paper's bearing with its machined cage; name a file or {', '.join(['6205', '6309'])}",
        )
    of_cage = parameters.get("cage") if isinstance(parameters.get("cage"), dict) else {}
    result, usual = document | {"parameters": parameters | {"cage": of_cage | {"shape": "ribbon"}}}, []
    for part, material in (("cage", ribbon.MATERIAL), ("rivet", ribbon.RIVET_MATERIAL)):
        section = section_of(path, document, part)
        if (
            "material" not in section
            and "material" not in of_cage
            and not set(section) & set(materials.PARTS[part].properties)
        ):
            result[part] = {"material": material} | section
            usual.append(part)
    return result, tuple(usual)


def check_designation(path, document):
    """UserError for a designation that the catalogue does not know in a file that leaves the balls to it: those of the
    6207 would take their place.
    """
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


def entry_of(path, designation, data, given):
    """The catalogue's Entry that a file's own [catalogue] stands for, whose balls follow by the rule of designations;
    None where the file gives the balls itself or no catalogue value but the 6207's; UserError where values are missing.
    """
    shape = [name for name in ("Z", *SHAPE[:2]) if given.get(name) is None]
    example = catalogue.entries()[EXAMPLE].data
    if not shape or len(shape) < 3 or all(example[key] == value for key, value in data.items()):
        return None
    if missing := [key for key in CATALOGUE if key not in data]:
        allowed = f"the balls need catalogue.{', catalogue.'.join(missing)} too, or give {', '.join(shape)}"
        raise UserError(f"{path}: catalogue.{next(iter(data))}: {allowed}")
    return catalogue.Entry(designation, **data)


def read_case(path, document, own, bare=False, prefix="rivet.", usual=()):
    """The Case of a document; own: how the origin of its values is called; prefix: of the rivet's keys in messages; usual:
    parts whose material follows from the cage's shape.
    """
    check_keys(path, document, KEYS, "bearing file")
    designation = str(document["designation"])
    entry = catalogue.entries().get(designation) if own != "shipped" else None
    Z = document.get("Z")
    if Z is not None and (isinstance(Z, bool) or not isinstance(Z, int) or not 5 <= Z <= 32):
        raise refusal(path, "Z", Z, "allowed: an integer from 5 to 32")
    numbers = dict(section_of(path, document, "catalogue"))
    play = numbers.pop("clearance", None)
    data = dict(catalogue_values(path, numbers))
    check_boundary(path, document, data, entry)
    tree = with_seats(path, plain_names(section_of(path, document, "parameters")), data, entry)
    given = dict(start_values(path, "parameters", tree, variables.PARAMETERS))
    if play is not None:
        given |= clearance_class(path, play, given, data, entry)
    if entry is None and own != "shipped":
        entry = entry_of(path, designation, data, {"Z": Z} | given)
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
    sizes = rivet_sizes(path, section_of(path, document, "rivet"), prefix)
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
    shape = (
        (given.get("bearing.D", catalogue.balls(entry)[1]), given.get("bearing.d_m", entry.d_m)) if own_balls else ()
    )
    rated = {key: value for key, value in ratings(Z, *shape).items() if key not in data} if own_balls else {}
    data |= by_catalogue | rated
    parts = Z, given, sizes | steel, inputs, data, entry
    all_Z, by_rule, rivet_by_rule, inputs_by_rule = rules(*parts)
    origin |= dict.fromkeys(by_catalogue, "catalogue") | dict.fromkeys(rated, "rule")
    origin |= dict.fromkeys(
        [
            name
            for name in ("Z", *by_rule, *(f"rivet.{name}" for name in rivet_by_rule), *inputs_by_rule)
            if name not in origin
        ],
        "rule",
    )
    if not entry and own != "shipped":
        known = {*([] if Z is None else ["Z"]), *given, *inputs, *inputs_by_rule}
        origin |= dict.fromkeys((name for name in OF_EXAMPLE if name not in known), EXAMPLE)
    values = defaults() | by_rule | inputs_by_rule | given | inputs
    iso = ratings(all_Z, values["bearing.D"], values["bearing.d_m"])
    origin |= dict.fromkeys((name for name in iso if name not in data), "rule")
    data = iso | data
    inside = "" if prefix else in_cage(designation)
    check_limits(path, document, parts, lambda name: called(name, prefix), inside)
    check_guidance(path, values)
    found["cage"] = found["cage"].with_density(values["cage.rho"])
    return Case(
        designation,
        str(document.get("description", "")),
        all_Z,
        values,
        data,
        rivet_by_rule | sizes | steel,
        origin,
        found,
        bare,
        oil=oil_name,
    )


def check_boundary(path, document, data, entry):
    """UserError for a boundary dimension that is another one than the catalogue's of the designation, from which the
    pitch circle follows; load ratings differ between makers.
    """
    for key in BOUNDARY:
        if entry and key in data and not math.isclose(data[key], entry.data[key], rel_tol=1e-6):
            written = document["catalogue"][key]
            allowed = shown(f"catalogue.{key}", entry.data[key], written)
            reason = f"{allowed} is allowed, of the {entry.designation} ({SOURCE}); leave designation or {key} out"
            raise refusal(path, f"catalogue.{key}", written, reason)


def called(name, prefix):
    """What a file calls a value that belongs to the rivet, or to the bearing."""
    return prefix + name.removeprefix("rivet.") if name.startswith("rivet.") else name


def ratings(Z, D, d_m):
    """C and C_0 [N] by ISO 281 and ISO 76 for Z balls [m]: of a bearing without a catalogue's, or with another number of
    balls, for which the catalogue's do not hold.
    """
    return {"C": scaling.rounded(dynamic_rating(Z, D, d_m)), "C_0": scaling.rounded(static_rating(Z, D, d_m))}


def plain_names(tree):
    """Parameters of a bearing file with the cage's material by the name that the FMU has for it."""
    cage = tree.get("cage")
    if not isinstance(cage, dict) or not isinstance(cage.get("material"), str):
        return tree
    return tree | {"cage": cage | {"material": materials.code_of(cage["material"])}}


def material_section(path, document, part):
    """The keys of a part's section that are about its material."""
    return {
        key: value
        for key, value in section_of(path, document, part).items()
        if part != "rivet" or key in RIVET_MATERIAL
    }


def rivet_sizes(path, section, prefix):
    """Dimensions of the rivet that a section [rivet] gives, itself or by a standard's name."""
    for key in section:
        if key not in (*RIVET_SIZES, *RIVET_MATERIAL, "head"):
            raise unknown(path, "rivet key", key, (*RIVET_SIZES, *RIVET_MATERIAL, "head"))
    sizes = dict(rivet_values(path, {key: value for key, value in section.items() if key in RIVET_SIZES}, prefix))
    return rivet_heads.head_of(path, section["head"], sizes) | sizes if "head" in section else sizes


def defaults():
    """Start values of the variable table, by item name where they belong to an enumeration."""
    return {
        name: named(variable, variable.start) for name, variable in (variables.PARAMETERS | variables.INPUTS).items()
    }


def rules(Z, given, rivet, inputs, data, entry):
    """What is not given, by rule: number of balls, parameters, dimensions of the rivet, inputs."""
    shape = {name: given.get(name, scaling.start(name)) for name in SHAPE}
    if entry:
        rule_Z, rule_D = catalogue.balls(entry)
        Z, shape["bearing.D"], shape["bearing.d_m"] = (
            Z or rule_Z,
            given.get("bearing.D", rule_D),
            given.get("bearing.d_m", entry.d_m),
        )
    Z = Z or variables.Z
    D, d_m = shape["bearing.D"], shape["bearing.d_m"]
    own_shape = bool(entry) or ribbon.is_ribbon(given) or any(shape[name] != scaling.start(name) for name in SHAPE)
    designation = entry.designation if entry else ""
    rivet_by_rule = scaling.scaled_rivet(Z, D, d_m, given, rivet, data.get("bore"), designation)
    whole = rivet_by_rule | rivet
    if own_shape:
        parameters = scaling.scaled_parameters(
            Z, D, d_m, given, whole, data.get("bore"), data.get("width"), designation
        )
        if "bore" in data and (P_d := catalogue.clearance(data["bore"])) is not None:
            parameters["bearing.P_d"] = P_d
        seats = {"ring.bore": "bore", "ring.outside": "outside_diameter"}
        parameters |= {name: data[key] for name, key in seats.items() if key in data}
        parameters["cage.material"] = given.get("cage.material", materials.PARTS["cage"].material)
        by_rule = scaling.scaled_inputs(Z, D, d_m, inputs, data.get("C"))
    else:
        known = {name: value for name, value in defaults().items() if name not in ("cage.m", "cage.rho")} | given
        parameters = scaling.scaled_joint(whole) | scaling.half_inertia({"Z": Z} | known, whole)
        parameters = {name: value for name, value in parameters.items() if value != scaling.start(name)}
        rivet_by_rule = {name: value for name, value in rivet_by_rule.items() if value != RIVET[name]}
        by_rule = {}
    parameters |= scaling.scaled_materials(given) | scaling.oil_by_points(given)
    settle = scaling.settling((by_rule | inputs).get("shaft.omega", variables.INPUTS["shaft.omega"].start))
    if settle != scaling.start("start.settle"):
        parameters["start.settle"] = settle
    return (
        Z,
        {name: value for name, value in parameters.items() if name not in given},
        rivet_by_rule,
        {name: value for name, value in (by_rule | scaling.parts_temperatures(inputs)).items() if name not in inputs},
    )


def limited_values(Z, given, rivet, inputs, data, entry):
    """All numbers that limits.LIMITS are about, given or by rule, by the names that it uses."""
    all_Z, by_rule, rivet_by_rule, _ = rules(Z, given, rivet, inputs, data, entry)
    numbers = {name: value for name, value in (defaults() | by_rule | given).items() if is_number(value)} | {"Z": all_Z}
    rivet = RIVET | rivet_by_rule | rivet
    return (
        numbers
        | {"cage.shape": given.get("cage.shape", CAGES[0])}
        | {f"rivet.{name}": value for name, value in rivet.items()}
        | {f"catalogue.{key}": value for key, value in data.items()}
    )


def in_cage(designation):
    """In whose cage a rivet's file does not fit, to stand behind a refusal."""
    return f", in the cage of the {designation}; --bearing names another one"


def check_limits(path, document, parts, names=lambda name: name, inside=""):
    """UserError for a bearing that cannot be built, by the first limit that does not hold and a key that the user gave.

    parts: Z, given parameters, rivet, inputs and catalogue data, and the catalogue's Entry; names: how the file calls
    a value, if otherwise than a bearing file does; inside: in_cage of a rivet's file.
    """
    values = limited_values(*parts)
    broken = next((limit for limit in limits.limits_of(values) if not limits.holds(limit, values)), None)
    if broken is None:
        return
    written = {
        name: value
        for section in ("catalogue", "rivet")
        for name, value in flat(document.get(section, {}), f"{section}.")
    }
    written |= dict(flat(document.get("parameters", {}))) | {key: document[key] for key in ("Z",) if key in document}
    own = [
        name
        for name in written
        if is_number(values.get(name)) and name not in broken.keys and not name.startswith("oil.")
    ]
    keys = [*(key for key in broken.keys if key in written), *own, *(key for key in broken.keys if key not in written)]
    for key in keys:
        allowed = limits.bound(broken, values[key], lambda value, key=key: limited_values(*changed(parts, key, value)))
        if allowed:
            words, number = allowed
            others = ", ".join(
                f"{names(name)} = {shown(name, values[name], written.get(name))}" for name in broken.keys if name != key
            )
            reason = f"{words} {shown(key, number, written.get(key), words)} is allowed for {broken.reason}{f', with {others}' if others else ''}{inside}"
            if key in OF_HEAD and key not in written and "rivet.head" in written:
                size = shown(key, values[key], None)
                raise refusal(
                    path, names("rivet.head"), written["rivet.head"], f"{names(key)} is {size} by it; {reason}"
                )
            raise refusal(path, names(key), written.get(key, values[key]), reason)
    raise refusal(path, names(keys[0]), written.get(keys[0], values[keys[0]]), f"impossible: {broken.reason}{inside}")


def check_guidance(path, values):
    """UserError for a cage that its shape does not let be guided as the values say."""
    by_balls = ribbon.is_guided_by_balls(values)
    if by_balls != ribbon.is_ribbon(values):
        reason = (
            'a machined cage\'s drilled pockets slide along the radius; "outer" is allowed, or cage.shape = "ribbon"'
            if by_balls
            else 'a ribbon cage has no land on the outer ring; "balls" is allowed'
        )
        raise refusal(path, "cage.guidance", values["cage.guidance"], reason)


def changed(parts, key, value):
    """The parts of a bearing file with one value given."""
    Z, given, rivet, inputs, data, entry = parts
    group, _, name = key.partition(".")
    if key == "Z":
        Z = value
    elif group == "rivet":
        rivet = rivet | {name: value}
    elif group == "catalogue":
        data = data | {name: value}
    else:
        given = given | {key: value}
    return Z, given, rivet, inputs, data, entry


def shown(name, value, written, words=""):
    """A value in the unit in which the user wrote it, SI for a bare number, else in the one in which people read it; a
    bound is rounded to the allowed side.
    """
    if name == "Z":
        return f"{value}"
    unit = unit_of(name)
    symbol = (
        (symbol_of(written) or unit) if written is not None else [*variables.UNITS[unit], *variables.UNITS[unit]][1]
    )
    factor, offset = unit_scales(unit).get(symbol, (1.0, 0.0))
    number = factor * value + offset
    if words:
        digits = 3 - math.floor(math.log10(abs(number) or 1.0))
        number = (math.floor if words == "at most" else math.ceil)(
            number * 10.0**digits + (1e-9 if words == "at most" else -1e-9)
        ) / 10.0**digits
    return f"{number:.4g}{suffix(symbol)}"


def unit_of(name):
    """SI unit of a parameter, a rivet's dimension or a catalogue value."""
    if name in variables.PARAMETERS:
        return variables.PARAMETERS[name].unit
    group, _, key = name.partition(".")
    if group == "rivet":
        return rivet_unit(key)
    return "m" if key in BOUNDARY else "N"


def rivet_unit(key):
    """SI unit of a dimension or material constant of the rivet."""
    if key.startswith(("E_", "yield_", "hardening_")):
        return "Pa"
    # alpha: 1/K, without a symbol of its own
    return {"nu": "1", "alpha": "1", "T": "K"}.get(key.partition("_")[0], "m")


def rivet_values(path, section, where):
    """Dimensions of a rivet in SI, each checked; where: in front of the key in messages."""
    for key, value in section.items():
        try:
            number, unit = positive(value, unit_scales(rivet_unit(key))), rivet_unit(key)
            if unit == "m" and number > LARGEST_RIVET:
                raise UserError(f"at most {LARGEST_RIVET:g} m is allowed")
            yield key, number
        except UserError as problem:
            raise refusal(path, f"{where}{key}", value, problem) from None


def clearance_class(path, name, given, data, entry):
    """bearing.P_d by the name of a class, which needs a bore and no clearance in [parameters] beside it."""
    if not isinstance(name, str) or name not in catalogue.CLEARANCE:
        raise refusal(path, "catalogue.clearance", name, f"allowed: {', '.join(catalogue.CLEARANCE)}")
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
        try:
            own = {key: seats.interference(name, value, size)}
        except UserError as problem:
            raise refusal(path, f"parameters.{name}", value, problem) from None
        found = {n: v for n, v in found.items() if n != name} | {group: found.get(group, {}) | own}
    return found


def catalogue_values(path, section):
    """Keys and SI values of the catalogue's data, each checked."""
    for key, value in section.items():
        if key not in (*CATALOGUE, *OF_MAKERS):
            raise unknown(path, "catalogue key", key, (*CATALOGUE, *OF_MAKERS, "clearance"))
        try:
            yield key, positive(value, unit_scales("m" if key in BOUNDARY else "N"))
        except UserError as problem:
            raise refusal(path, f"catalogue.{key}", value, problem) from None


def unit_scales(unit):
    """Symbols that a text may carry for an SI unit, with their (factor, offset)."""
    return scales_of(unit, variables.UNITS[unit])


def start_values(path, section, tree, known):
    """Full names and values of one section of a bearing file, each checked."""
    for name, value in flat(tree):
        if (
            name not in known
            and (
                other := "inputs"
                if name in variables.INPUTS
                else "parameters"
                if name in variables.PARAMETERS
                else section
            )
            != section
        ):
            raise UserError(f"{path}: {section}.{name}: does not belong into [{section}] but into [{other}]")
        if name not in known:
            raise unknown(path, section.removesuffix("s"), name, known)
        variable = known[name]
        items = (
            []
            if variable.type in ("Real", "Integer")
            else [item.name.lower() for item in getattr(variables, variable.type)]
        )
        if items and value not in items:
            raise refusal(path, f"{section}.{name}", value, f"allowed: {', '.join(items)}")
        written = value
        try:
            value = to_si(value, unit_scales(variable.unit)) if isinstance(value, str) and not items else value
        except UserError as problem:
            raise refusal(path, f"{section}.{name}", value, problem) from None
        low, high = (
            (-math.inf if variable.min is None else variable.min),
            (math.inf if variable.max is None else variable.max),
        )
        whole = variable.type == "Integer"
        if not items and not (is_number(value) and low <= value <= high and (isinstance(value, int) or not whole)):
            what, text = ("an integer", "") if whole else ("a number", ", or a text with its unit")
            raise refusal(
                path,
                f"{section}.{name}",
                written,
                f"not {what} in {span(low, high, variable.unit, symbol_of(written))}{text}",
            )
        yield name, value


def span(low, high, unit, symbol):
    """The limits of a value in the unit that the user wrote, else in SI."""
    symbol = symbol or unit
    factor, offset = unit_scales(unit)[symbol]
    return f"{factor * low + offset:.4g} ... {factor * high + offset:.4g}{suffix(symbol)}"


def named(variable, value):
    """A value, by item name if it belongs to an enumeration."""
    return value if variable.type in ("Real", "Integer") else getattr(variables, variable.type)(value).name.lower()


def is_number(value):
    """Whether a TOML value is a finite number."""
    return isinstance(value, (int, float)) and not isinstance(value, bool) and math.isfinite(value)


def case_of(target=None, fmu=None, cage=None):
    """The Case of a bearing (file or designation) or of a scene at its start (file or name); without a target of the
    FMU itself, and without both EXAMPLE.

    fmu: path of the FMU, None for the default one; cage: one of CAGES, of a bearing only.
    """
    target = EXAMPLE if target is None and fmu is None else target
    names = [*known_bearings(), *shipped_scenes()]
    if target is not None and str(target) not in names and not is_file(target):
        raise unknown_designation("info", "bearing, scene or file", target, names)
    if target is not None and is_bearing(target):
        return bearing_case(target, cage=cage)
    if cage is not None:
        raise UserError(f"--cage {cage}: a scene runs in an FMU, whose cage is fixed; name a bearing")
    from ..running.fmu import Model

    return scene_case(target, Model(fmu))


def scene_case(source, model):
    """The Case of a scene at its start, with the FMU's start values for all variables that the scene does not set;
    None: of the FMU itself.

    An FMU holds no dimensions of its rivets.
    """
    return case_at(load_scene(source, model), model)


def case_at(scene, model):
    """The Case of a Scene at its start."""
    values = {name: model.default(variable) for name, variable in (model.parameters | model.inputs).items()}
    values |= scene.parameters | {name: float(history(0.0)) for name, history in scene.inputs.items()}
    Z = sum(name.startswith("ball[") and name.endswith("].Q_i") for name in model.outputs)
    known = [
        case
        for case in map(bearing_case, shipped_bearings())
        if case.Z == Z and all(case.values[f"bearing.{s}"] == values[f"bearing.{s}"] for s in ("D", "d_m"))
    ]
    designation = model.bearing.partition(". ")[0].partition(":")[0]
    entry = catalogue.entries().get(designation) if model.origin.get("C") == "catalogue" else None
    data = model.catalogue or (known[0].catalogue if known else entry.data if entry else {})
    alone = tuple(name for name in SHAPE if name in scene.parameters)
    name = f"{designation}, scene {scene.name}" if scene.source else designation
    origin = {} if scene.source else model.origin
    about = {"origin": origin, "alone": alone, "model": model, "oil": scene.oil or oil.name_of(model.origin)}
    return Case(name, scene.description, Z, values, data, rivet=None, **about)


def flat(tree, prefix=""):
    """Full names and values of nested tables."""
    for key, value in tree.items():
        if isinstance(value, dict):
            yield from flat(value, f"{prefix}{key}.")
        else:
            yield f"{prefix}{key}", value
