"""What is not known of a bearing, by rule from the 6207 of the paper: the defaults of the variable table, scaled.

Cage, clearances and rivets are geometrically similar: lengths grow with the ball's diameter, the cage's diameters keep their distances from the pitch circle
in ball diameters, the rivets' preload grows with the section (equal stress).  A half's mass and inertia follow from its diameters and width, the inner ring's
(with its share of the shaft) from bore and width; its damping keeps damping per mass and damping ratio.  Loads: a tenth of C radially, a sixth of that
axially; speed: n d_m = 480,000 mm/min, 70 % of the usual limit with grease.
"""

import math

from bearing_model import variables
from bearing_model.load_ratings import dynamic_rating
from rivet_model.geometry import Geometry

BORE, WIDTH = 0.035, 0.017  # of the 6207 [m]
BY_BALL = ("cage.pocket_clearance", "cage.guide_clearance", "joint.fit", "joint.swell")
AXIAL = ("cage.x_c", "cage.width", "cage.land_width", "cage.land_x")  # by the ball too, as far as the bearing is wide enough
WIDEST_CAGE = 0.97  # of the bearing's width
RIVET_LENGTHS = (
    "shank_diameter",
    "head_diameter",
    "head_height",
    "fillet_radius",
    "relief_radius",
    "relief_depth",
    "edge_break",
    "flange_thickness",
    "middle_zone",
)
DENSITY = 8800.0  # bronze [kg/m3]
FILL = 0.55  # part of the full ring that pockets leave
SPEED = 8.0  # n d_m, 480,000 mm/min [m/s]


def start(name):
    """Default of a parameter, the 6207's."""
    return variables.PARAMETERS[name].start


def rounded(value):
    """Six digits: enough for an assumption."""
    return float(f"{value:.6g}")


def scaled_parameters(D, d_m, given, bore=None, width=None):
    """Parameters by rule for balls of the diameter D on the pitch diameter d_m [m]; what `given` holds stands, and others that follow from it do.

    bore, width [m]: the 6207's in ball diameters, if not known.
    """
    r = D / start("bearing.D")
    values = {"bearing.D": D, "bearing.d_m": d_m}
    axial = r if width is None else min(r, WIDEST_CAGE * width / start("cage.width"))
    values |= {name: rounded(r * start(name)) for name in BY_BALL} | {name: rounded(axial * start(name)) for name in AXIAL}
    values |= {name: rounded(d_m + r * (start(name) - start("bearing.d_m"))) for name in ("cage.D_o", "cage.D_i")}
    values["joint.preload"] = rounded(r**2 * start("joint.preload"))
    values |= given
    m, J_p, J_t = half_of_ring(values["cage.D_o"], values["cage.D_i"], 2.0 * values["cage.x_c"])
    share = values.get("cage.m", m) / m  # a given mass scales the density
    values |= {"cage.m": rounded(share * m), "cage.J_p": rounded(share * J_p), "cage.J_t": rounded(share * J_t)} | given
    bore = (d_m - (start("bearing.d_m") - BORE) * r) if bore is None else bore
    width = WIDTH * r if width is None else width
    return inner_ring(bore / BORE, width / WIDTH) | values


def half_of_ring(D_o, D_i, width):
    """Mass and moments of inertia of a cage half: a bronze ring without its pockets [kg, kg m2]."""
    m = FILL * DENSITY * 0.25 * math.pi * (D_o**2 - D_i**2) * width
    J_p = m * (D_o**2 + D_i**2) / 8.0
    return m, J_p, 0.5 * J_p + m * width**2 / 12.0


def inner_ring(bore, width):
    """Inertia and damping of the inner ring with its share of the shaft, for bore and width over those of the 6207."""
    mass, inertia = bore**2 * width, bore**4 * width
    values = {"ring.m": mass * start("ring.m"), "ring.c": mass * start("ring.c")}
    values |= {name: inertia * start(name) for name in ("ring.J_p", "ring.J_t")}
    values["ring.c_tilt"] = math.sqrt(inertia) * start("ring.c_tilt")
    return {name: rounded(value) for name, value in values.items()}


def scaled_rivet(D):
    """Lengths of the rivet and its seat by rule [m]."""
    r = D / start("bearing.D")
    return {name: rounded(r * getattr(Geometry, name)) for name in RIVET_LENGTHS}


def scaled_inputs(Z, D, d_m, C=None):
    """Loads and speed by rule; without C [N] that of ISO 281."""
    F_y = 0.1 * (C or dynamic_rating(Z, D, d_m))
    return {"shaft.F_y": float(f"{F_y:.3g}"), "shaft.F_x": float(f"{F_y / 6.0:.3g}"), "shaft.omega": rounded(2.0 * math.pi * SPEED / d_m)}
