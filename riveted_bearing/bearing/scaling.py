"""What is not known of a bearing, by rule from the 6207 of the paper: the defaults of the variable table, scaled.

Cage and clearances are geometrically similar: lengths grow with the ball's diameter, the cage's diameters keep their
distances from the pitch circle in ball diameters.  The rivet's shank grows with the ball; head, relief, chamfer, fit
and swell grow with the shank, the seat with the head, the preload with the shank's section (equal stress).  A half's
mass, centre of mass and inertia follow from its shape and density (rivet_model/half_shape.py), the inner ring's (with
its share of the shaft) from bore and width; its damping keeps damping per mass and damping ratio.  If no
load is given, the radial one is C/10 and the axial one a sixth of it; if any is given, the others are 0;
speed: n d_m = 480,000 mm/min,
70 % of the usual limit with grease.  Parts whose temperature is not given have that of the oil.
"""

import math
from dataclasses import asdict
from types import SimpleNamespace

from bearing_model.generated import variables
from rivet_model import half_shape
from rivet_model.geometry import Geometry
from riveted_bearing.bearing.load_ratings import dynamic_rating

from ..base.units import rounded
from . import oil, ribbon

BORE, WIDTH = 0.035, 0.017  # of the 6207 [m]
BY_BALL = ("cage.guide_clearance",)
BY_SHANK = ("joint.fit", "joint.swell")
AXIAL = ("cage.width", "cage.land_width", "cage.land_x")  # by the ball too, as far as the bearing is wide enough
WIDEST_CAGE = 0.97  # of the bearing's width
RIVET_BY_BALL = ("shank_diameter", "flange_thickness")
RIVET_BY_SHANK = (
    "head_diameter",
    "head_height",
    "fillet_radius",
    "relief_radius",
    "relief_depth",
    "edge_break",
    "middle_zone",
)
SHAPE = {  # names of half_shape.py by those of a bearing file; half the cage's width apart
    "Z": "Z",
    "d_m": "bearing.d_m",
    "ball_diameter": "bearing.D",
    "pocket_clearance": "cage.pocket_clearance",
    "cage_outer_diameter": "cage.D_o",
    "cage_inner_diameter": "cage.D_i",
    "cage_half_width": "cage.width",
    "rho_flange": "cage.rho",
}
RIBBON = {"shape": "cage.shape", "pocket_fillet": "cage.pocket_fillet", "flange_thickness": "cage.sheet"}
LOADS = ("shaft.F_x", "shaft.F_y", "shaft.F_z", "shaft.M_y", "shaft.M_z")
LAND = ("cage.E", "cage.nu", "bearing.E", "bearing.nu")  # of cage and rings
INERTIA = ("cage.m", "cage.x_c", "cage.J_p", "cage.J_t")  # of one half, in the order of half_shape.Inertia
RIVET = asdict(Geometry())
SPEED = 8.0  # n d_m, 480,000 mm/min [m/s]
SETTLED = 15.0  # revolutions of the shaft before statistics begin, as the 6207's 50 ms at its speed


def start(name):
    """Default of a parameter, the 6207's."""
    return variables.PARAMETERS[name].start


def scaled_parameters(Z, D, d_m, given, rivet, bore=None, width=None, designation=""):
    """Parameters by rule for Z balls D on the pitch diameter d_m [m], beside `given` and what follows from it.

    rivet: by the names of Geometry; bore, width [m]: None for the 6207's in balls; designation: for a ribbon's sheet.
    """
    r = D / start("bearing.D")
    values = {"bearing.D": D, "bearing.d_m": d_m}
    axial = r if width is None else min(r, WIDEST_CAGE * width / start("cage.width"))
    values |= {name: rounded(r * start(name)) for name in BY_BALL} | {
        name: rounded(axial * start(name)) for name in AXIAL
    }
    values |= {name: value for name, value in cage_sizes(D, d_m).items() if name != "cage.width"}
    if ribbon.is_ribbon(given):
        values |= ribbon.cage_sizes(Z, D, d_m, given, rivet, designation)
    values |= scaled_joint(rivet) | given
    values |= half_inertia({"Z": Z} | values, rivet) | given
    bore = (d_m - (start("bearing.d_m") - BORE) * r) if bore is None else bore
    width = WIDTH * r if width is None else width
    return inner_ring(bore / BORE, width / WIDTH) | values


def scaled_joint(rivet):
    """Preload [N] by rule for the shank of a rivet, of the same stress as the 6207's; fit and swell [m]."""
    s = rivet.get("shank_diameter", RIVET["shank_diameter"]) / RIVET["shank_diameter"]
    return {"joint.preload": rounded(s**2 * start("joint.preload"))} | {
        name: rounded(s * start(name)) for name in BY_SHANK
    }


def scaled_materials(given):
    """What follows from given materials: balls of the rings' steel, S-N curve by strength, K_land ~ E* (Hertz)."""
    values = {"bearing.rho": given["ring.rho"]} if "ring.rho" in given else {}
    if given.keys() & {*LAND}:
        values["cage.K_land"] = rounded(compliance({}) / compliance(given) * start("cage.K_land"))
    if "fatigue.sigma_m" in given:
        share = given["fatigue.sigma_m"] / start("fatigue.sigma_m")
        values |= {name: rounded(share * start(name)) for name in ("fatigue.sigma_D", "fatigue.sigma_f")}
    return {name: value for name, value in values.items() if value != start(name)}


def compliance(given):
    """1/E* of land and ring [1/Pa] for given elastic constants, the 6207's for those that are not."""
    E_c, nu_c, E, nu = (given.get(name, start(name)) for name in LAND)
    return (1.0 - nu_c**2) / E_c + (1.0 - nu**2) / E


def oil_by_points(given):
    """oil.eta [Pa.s] and oil.beta [1/K] at oil.T_0 of an oil whose two points are given, from these alone."""
    if not {*oil.POINTS} <= given.keys():
        return {}
    values = {name: given.get(name, v.start) for name, v in variables.PARAMETERS.items() if name.startswith("oil.")}
    return {name: rounded(value) for name, value in oil.of_points(values).items()}


def shape_of(values, rivet):
    """What half_shape.py needs of a cage half: values by names of a bearing file, rivet's by those of Geometry."""
    cage = {name: values[parameter] for name, parameter in SHAPE.items()}
    if ribbon.is_ribbon(values):
        cage |= {name: values[parameter] for name, parameter in RIBBON.items()}
    return SimpleNamespace(**RIVET | rivet | cage | {"cage_half_width": 0.5 * cage["cage_half_width"]})


def half_inertia(values, rivet):
    """INERTIA of a half by shape and density (none of a shape without bars), and the density that a mass alone means; a mass
    beside a density scales the moments.
    """
    shape = shape_of({"cage.rho": start("cage.rho")} | values, rivet)
    if not half_shape.has_bridges(shape):
        return {}
    found = {}
    if "cage.m" in values and "cage.rho" not in values:
        rivets = shape.Z * half_shape.rivet_mass(shape)
        shape.rho_flange *= (values["cage.m"] - rivets) / (half_shape.half_inertia(shape).m - rivets)
        found["cage.rho"] = rounded(shape.rho_flange)
    m, x_c, J_p, J_t = half_shape.half_inertia(shape)
    share = values.get("cage.m", m) / m
    return found | dict(
        zip(INERTIA, (rounded(value) for value in (share * m, x_c, share * J_p, share * J_t)), strict=True)
    )


def inner_ring(bore, width):
    """Inertia, damping and support of the inner ring with its shaft, for bore and width over the 6207's: similar, angular
    stiffness as ring.m, ring.c_tilt as the root of stiffness times inertia.
    """
    mass, inertia = bore**2 * width, bore**4 * width
    values = {name: mass * start(name) for name in ("ring.m", "ring.c", "ring.k_tilt")}
    values |= {name: inertia * start(name) for name in ("ring.J_p", "ring.J_t")}
    values["ring.c_tilt"] = math.sqrt(mass * inertia) * start("ring.c_tilt")
    return {name: rounded(value) for name, value in values.items()}


def cage_sizes(D, d_m):
    """Diameters, width and pocket clearance of a cage by rule [m], its width as far as the bearing's is not known."""
    r = D / start("bearing.D")
    values = {name: rounded(r * start(name)) for name in ("cage.width", "cage.pocket_clearance")}
    return values | {name: rounded(d_m + r * (start(name) - start("bearing.d_m"))) for name in ("cage.D_o", "cage.D_i")}


def scaled_rivet(Z, D, d_m, given, rivet, bore=None, designation=""):
    """Lengths of the rivet and its seat by rule [m], the counterbore with metal around it; bore, designation: for ribbons."""
    r = D / start("bearing.D")
    if ribbon.is_ribbon(given):
        bore = d_m - (start("bearing.d_m") - BORE) * r if bore is None else bore
        values = ribbon.rivet_sizes(D, bore, given, rivet, designation)
    else:
        values = {name: rounded(r * RIVET[name]) for name in RIVET_BY_BALL} | rivet
    s = values["shank_diameter"] / RIVET["shank_diameter"]
    values = {name: rounded(s * RIVET[name]) for name in RIVET_BY_SHANK} | values
    if "seat_diameter" not in values:
        known = {"Z": Z, "bearing.D": D, "bearing.d_m": d_m, "cage.rho": start("cage.rho")} | cage_sizes(D, d_m) | given
        shape = shape_of(known, values)
        sides = d_m - shape.cage_inner_diameter, shape.cage_outer_diameter - d_m
        across = min(*sides, 2.0 * half_shape.narrowest_half_bar(shape)) - 2.0 * half_shape.LEAST_WALL
        usual = values["head_diameter"] * RIVET["seat_diameter"] / RIVET["head_diameter"]
        values["seat_diameter"] = rounded(max(values["head_diameter"], min(usual, across)))
    return {name: value for name, value in values.items() if name not in rivet}


def settling(omega):
    """start.settle [s] for a speed of the shaft [rad/s]: SETTLED revolutions, not below the default."""
    turns = SETTLED * 2.0 * math.pi / abs(omega) if omega else 0.0
    return rounded(min(max(turns, start("start.settle")), variables.PARAMETERS["start.settle"].max))


def scaled_inputs(Z, D, d_m, inputs, C=None):
    """Loads and speed by rule beside the given inputs; without C [N] that of ISO 281."""
    speed = {"shaft.omega": rounded(2.0 * math.pi * SPEED / d_m)}
    if any(name in inputs for name in LOADS):
        return speed | dict.fromkeys(LOADS[:2], 0.0)
    F_y = 0.1 * (C or dynamic_rating(Z, D, d_m))
    return speed | {"shaft.F_y": rounded(F_y, 3), "shaft.F_x": rounded(F_y / 6.0, 3)}
