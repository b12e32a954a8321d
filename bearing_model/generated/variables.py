"""Every variable of the FMU, the enumerations and the state vector's layout.  Written by fmus/generate.py from fmus/variables.toml: do not edit."""

# fmt: off
# ruff: noqa: E501

from dataclasses import dataclass
from enum import IntEnum

MODEL_IDENTIFIER = "RivetedBearing"
MODEL_GUID = "{4e74854a-0aa4-6ae4-675b-2f8acd089ac6}"
Z = 9


@dataclass(frozen=True)
class Variable:
    """One variable, SI units; an array (count > 1) holds the elements name[1] ... name[count] with value references vr, vr + 1, ..."""

    name: str
    vr: int
    type: str
    unit: str
    display: str | None
    start: float | int | None
    min: float | int | None
    max: float | int | None
    count: int
    group: str | None
    description: str
    source: str | None
    derives: bool  # whether the start value stands for one that follows from others
    fixed: str | None  # why a parameter cannot change once a run has begun; None if it can


# Enumerations by name.
TiltMode = IntEnum("TiltMode", {"PRESCRIBED": 1, "SUPPORTED": 2, "FREE": 3})
RingMotion = IntEnum("RingMotion", {"FREE": 1, "PRESCRIBED": 2})
HousingMotion = IntEnum("HousingMotion", {"GIVEN": 1, "SUPPORTED": 2})
CageMaterial = IntEnum("CageMaterial", {"BRONZE": 1, "BRASS": 2, "STEEL": 3, "PA66_GF25": 4, "PEEK": 5, "OWN": 6, "DC04": 7})
CageShape = IntEnum("CageShape", {"MACHINED": 1, "RIBBON": 2})
CageGuidance = IntEnum("CageGuidance", {"OUTER": 1, "BALLS": 2})
CageModel = IntEnum("CageModel", {"TWO_HALF": 1, "ELASTIC": 3})
Traction = IntEnum("Traction", {"POINT": 1, "SLICED": 2})
Lubrication = IntEnum("Lubrication", {"FILM": 1, "MIXED": 2})
Stress = IntEnum("Stress", {"OFF": 1, "SAMPLED": 2, "PEAK": 3, "FATIGUE": 4})
Switch = IntEnum("Switch", {"OFF": 1, "ON": 2})
FitModel = IntEnum("FitModel", {"ELASTIC": 1, "J2": 2})
MeanStress = IntEnum("MeanStress", {"NONE": 1, "GOODMAN": 2, "SWT": 3, "MORROW": 4})
Drag = IntEnum("Drag", {"ISOLATED": 1, "ROW": 2})
Method = IntEnum("Method", {"VERLET": 1, "EXPLICIT": 2, "FIXED": 3})
ENUMERATIONS = (TiltMode, RingMotion, HousingMotion, CageMaterial, CageShape, CageGuidance, CageModel, Traction, Lubrication, Stress, Switch, FitModel, MeanStress, Drag, Method, )

# Assumed parameters that move the rivets' stress: smallest and largest usual value over the value, and the source.
ASSUMPTIONS = {
    "cage.pocket_clearance": (0.5, 2.0, "0.1 to 0.4 mm are usual in a 6207"),
    "cage.guide_clearance": (0.5, 2.0, "0.1 to 0.4 mm are usual in a 6207"),
    "oil.eta": (0.4, 2.1, "5 mm2/s aviation oils (MIL-PRF-23699) from 150 down to 60 degC"),
    "oil.B": (0.5, 2.0, "traction of other oils than 4109 at small slip"),
    "oil.rho_mix": (0.25, 1.3, "1 to 5 % oil between the rings (Parker, NASA TP-2275, 1984)"),
    "oil.A": (0.75, 1.5, "0.03 to 0.06 in full sliding; SKF: 0.04 synthetic, 0.05 mineral oils"),
    "oil.C": (0.6, 1.5, "traction of other oils than 4109 at large slip"),
    "oil.rho": (0.9, 1.1, "oils from PAO to ester, hot"),
    "oil.alpha": (0.6, 1.6, "oils from ester to mineral oil, hot"),
    "oil.sigma_race": (0.25, 2.0, "fine to usual finish; in full film the film ratio alone moves with it"),
}

# Items of enumerations that are gone: number and reason by type and name.
RETIRED_ITEMS = {
    "CageModel": {"rigid": (2, "one rigid cage is no longer computed: two_half (1) takes the same time and is truer"), },
}

# What to look at first: names by question.
ESSENTIALS = {
    "Loads and speed in": ("shaft.F_x", "shaft.F_y", "shaft.F_z", "shaft.omega", "shaft.tilt_y", "shaft.tilt_z", "impact.F_r", "impact.F_a", ),
    "Settings of the rivets": ("joint.preload", "joint.fit", ),
    "Motion and reaction": ("ring.x", "ring.y", "ring.z", "housing.F_x", "housing.F_y", "housing.F_z", "bearing.friction_torque", "bearing.power_loss", ),
    "Cage": ("cage.omega", "cage.slip_ratio", "cage.eccentricity", "cage.dislocation", "cage.F_pocket_peak", ),
    "Stress of the worst rivet": ("rivet.sigma_head_max", "rivet.sigma_mid_max", "stat.sigma_head_mean", "stat.sigma_head_p999", "stat.sigma_mid_mean", "stat.sigma_mid_p999", ),
    "Stress and damage of each rivet": ("rivet[k].sigma_head_peak", "rivet[k].sigma_mid_peak", "rivet[k].damage_head", "rivet[k].damage_mid", "rivet[k].broken", ),
    "Health of bearing and run": ("rivet.table_kind", "event.overpressure_onsets", "event.joint_open_onsets", "event.rivet_yield_onsets", "bearing.energy_residual", "solver.steps", "solver.error_tests_failed", ),
}

# Scales of each unit: symbol -> (factor, offset), value in that symbol = factor * SI value + offset.
UNITS = {
    "m": {"m": (1.0, 0.0), "mm": (1000.0, 0.0), "um": (1000000.0, 0.0)},
    "m/s": {"m/s": (1.0, 0.0)},
    "m/s2": {"m/s2": (1.0, 0.0)},
    "rad": {"rad": (1.0, 0.0), "deg": (57.29577951308232, 0.0)},
    "rad/s": {"rad/s": (1.0, 0.0), "rev/min": (9.549296585513721, 0.0)},
    "rad/s2": {"rad/s2": (1.0, 0.0)},
    "N": {"N": (1.0, 0.0)},
    "N.m": {"N.m": (1.0, 0.0)},
    "N/m": {"N/m": (1.0, 0.0)},
    "N.m/rad": {"N.m/rad": (1.0, 0.0)},
    "N.m.s/rad": {"N.m.s/rad": (1.0, 0.0)},
    "N.s/m": {"N.s/m": (1.0, 0.0)},
    "N/m1.5": {"N/m1.5": (1.0, 0.0)},
    "s/m": {"s/m": (1.0, 0.0)},
    "Pa": {"Pa": (1.0, 0.0), "MPa": (1e-06, 0.0), "GPa": (1e-09, 0.0)},
    "1/Pa": {"1/Pa": (1.0, 0.0), "1/GPa": (1000000000.0, 0.0)},
    "Pa.s": {"Pa.s": (1.0, 0.0), "mPa.s": (1000.0, 0.0)},
    "kg": {"kg": (1.0, 0.0), "g": (1000.0, 0.0)},
    "kg.m": {"kg.m": (1.0, 0.0), "g.mm": (1000000.0, 0.0)},
    "kg.m2": {"kg.m2": (1.0, 0.0)},
    "kg/m3": {"kg/m3": (1.0, 0.0)},
    "m2/s": {"m2/s": (1.0, 0.0), "mm2/s": (1000000.0, 0.0)},
    "m3/s": {"m3/s": (1.0, 0.0), "L/min": (60000.0, 0.0)},
    "1/K": {"1/K": (1.0, 0.0)},
    "W/m.K": {"W/m.K": (1.0, 0.0)},
    "1/s": {"1/s": (1.0, 0.0)},
    "1/s2": {"1/s2": (1.0, 0.0)},
    "s": {"s": (1.0, 0.0), "ms": (1000.0, 0.0), "us": (1000000.0, 0.0)},
    "K": {"K": (1.0, 0.0), "degC": (1.0, -273.15)},
    "W": {"W": (1.0, 0.0)},
    "J": {"J": (1.0, 0.0)},
    "1": {"1": (1.0, 0.0)},
}

# name, vr, type, unit, display, start, min, max, count, group, description, source, derives, fixed
PARAMETERS = {
    v.name: v
    for v in (
        Variable("bearing.D", 1001, "Real", "m", "mm", 0.0111125, 0.001, 0.1, 1, None, "Ball diameter", "paper Table 1", False, "it is part of the geometry"),
        Variable("bearing.d_m", 1002, "Real", "m", "mm", 0.0535, 0.005, 1.0, 1, None, "Pitch diameter: mean of the groove-bottom diameters", "catalogue 6207: (35 + 72)/2 mm", False, "it is part of the geometry"),
        Variable("bearing.f_i", 1003, "Real", "1", None, 0.515, 0.5005, 0.6, 1, None, "Inner groove radius / ball diameter", "assumed (usual 0.515)", False, "it is part of the geometry"),
        Variable("bearing.f_e", 1004, "Real", "1", None, 0.52, 0.5005, 0.6, 1, None, "Outer groove radius / ball diameter", "assumed (usual 0.52)", False, "it is part of the geometry"),
        Variable("bearing.P_d", 1005, "Real", "m", "um", 1.5e-05, -5e-05, 0.001, 1, None, "Diametral (radial internal) clearance, negative = preload", "assumed (clearance class CN: 6...20 um)", False, "it is part of the geometry"),
        Variable("bearing.E", 1006, "Real", "Pa", "GPa", 207000000000.0, 1000000000.0, 1000000000000.0, 1, None, "Young's modulus of the rings, and of the balls unless ball.E says otherwise", "bearing steel, Harris", False, "it is a property of a body"),
        Variable("bearing.nu", 1007, "Real", "1", None, 0.3, 0.0, 0.49, 1, None, "Poisson's ratio of the rings, and of the balls unless ball.nu says otherwise", "bearing steel, Harris", False, "it is a property of a body"),
        Variable("bearing.rho", 1008, "Real", "kg/m3", None, 7800.0, 1000.0, 20000.0, 1, None, "Density of the balls", "bearing steel, Harris", False, "it is a property of a body"),
        Variable("bearing.lambda", 1009, "Real", "s/m", None, 0.05, 0.0, 10.0, 1, None, "Hunt-Crossley damping of the race contacts: Q = K delta^1.5 (1 + lambda delta_dot)", "assumed: 0.01...0.2 do not change force statistics, 0 rings", False, None),
        Variable("bearing.h_i", 1010, "Real", "1", None, 0.2, 0.01, 0.5, 1, None, "Height of the inner ring's shoulder above the groove's bottom / ball diameter: reported when the contact ellipse reaches over it", "assumed (usual 0.17...0.25)", False, "it is part of the geometry"),
        Variable("bearing.h_e", 1011, "Real", "1", None, 0.2, 0.01, 0.5, 1, None, "Height of the outer ring's shoulder above the groove's bottom / ball diameter: reported when the contact ellipse reaches over it", "assumed (usual 0.17...0.25)", False, "it is part of the geometry"),
        Variable("bearing.p_limit", 1012, "Real", "Pa", "MPa", 4200000000.0, 1000000.0, 1000000000000.0, 1, None, "Contact pressure of the races beyond which a warning is given", "ISO 76: permanent deformation of 1e-4 D", False, None),
        Variable("bearing.expansion", 8231, "Real", "1/K", None, 1.17e-05, 0.0, 0.0001, 1, None, "Thermal expansion of the rings, and of the balls unless ball.expansion is set; dimensions are those at assembly", "bearing steel, Harris", False, "it is a property of a body"),
        Variable("ball.E", 1013, "Real", "Pa", "GPa", 0.0, 0.0, 1000000000000.0, 1, None, "Young's modulus of the balls", "0: bearing.E", False, "it is a property of a body"),
        Variable("ball.nu", 1014, "Real", "1", None, 0.0, 0.0, 0.49, 1, None, "Poisson's ratio of the balls", "0: bearing.nu", False, "it is a property of a body"),
        Variable("ball.expansion", 1015, "Real", "1/K", None, 0.0, 0.0, 0.0001, 1, None, "Thermal expansion of the balls", "0: bearing.expansion", False, "it is a property of a body"),
        Variable("ball[j].dD", 1020, "Real", "m", "um", 0.0, -0.001, 5e-05, Z, None, "Excess of the ball's diameter over bearing.D", "perfect set of balls", False, "it is part of the geometry"),
        Variable("outer.spall_angle", 9100, "Real", "rad", "deg", 0.0, -6.2832, 6.2832, 1, None, "Angle of the spall's middle on the outer ring at the start, from +Y toward +Z; it turns with the ring", "at +Y", False, "it is part of the geometry"),
        Variable("outer.spall_length", 9101, "Real", "m", "mm", 0.0, 0.0, 1.0, 1, None, "Length of the spall along the track", "no spall", False, "it is part of the geometry"),
        Variable("outer.spall_width", 9102, "Real", "m", "mm", 0.0, 0.0, 0.1, 1, None, "Width of the spall across the track, in the middle of the contacts", "no spall", False, "it is part of the geometry"),
        Variable("outer.spall_depth", 9103, "Real", "m", "um", 0.0, 0.0, 0.01, 1, None, "Depth of the spall", "no spall", False, "it is part of the geometry"),
        Variable("outer.spall_edge", 9104, "Real", "m", "mm", 5e-05, 1e-06, 0.01, 1, None, "Length over which the ball's path into the spall is rounded where the ball meets the bottom or the other edge", "regularization: at most a quarter of the length is in force", False, "it is part of the geometry"),
        Variable("inner.spall_angle", 9120, "Real", "rad", "deg", 0.0, -6.2832, 6.2832, 1, None, "Angle of the spall's middle on the inner ring at the start, from +Y toward +Z; it turns with the ring", "at +Y", False, "it is part of the geometry"),
        Variable("inner.spall_length", 9121, "Real", "m", "mm", 0.0, 0.0, 1.0, 1, None, "Length of the spall along the track", "no spall", False, "it is part of the geometry"),
        Variable("inner.spall_width", 9122, "Real", "m", "mm", 0.0, 0.0, 0.1, 1, None, "Width of the spall across the track, in the middle of the contacts", "no spall", False, "it is part of the geometry"),
        Variable("inner.spall_depth", 9123, "Real", "m", "um", 0.0, 0.0, 0.01, 1, None, "Depth of the spall", "no spall", False, "it is part of the geometry"),
        Variable("inner.spall_edge", 9124, "Real", "m", "mm", 5e-05, 1e-06, 0.01, 1, None, "Length over which the ball's path into the spall is rounded where the ball meets the bottom or the other edge", "regularization: at most a quarter of the length is in force", False, "it is part of the geometry"),
        Variable("ball[j].spall_angle", 9700, "Real", "rad", "deg", 0.0, -6.2832, 6.2832, Z, None, "Angle of the middle of the ball's spall at the start, about the rolling axis from the outer contact toward growing azimuth", "at the contact with the outer race", False, "it is a property of a body"),
        Variable("ball[j].spall_length", 9740, "Real", "m", "mm", 0.0, 0.0, 1.0, Z, None, "Length of the spall along the ball's track", "no spall", False, "it is a property of a body"),
        Variable("ball[j].spall_width", 9780, "Real", "m", "mm", 0.0, 0.0, 0.1, Z, None, "Width of the spall across the track, in the middle of the contacts", "no spall", False, "it is a property of a body"),
        Variable("ball[j].spall_depth", 9820, "Real", "m", "um", 0.0, 0.0, 0.01, Z, None, "Depth of the spall", "no spall", False, "it is a property of a body"),
        Variable("ball[j].spall_edge", 9860, "Real", "m", "mm", 5e-05, 1e-06, 0.01, Z, None, "Length over which the path into the spall is rounded where the race meets the bottom or the other edge", "regularization: at most a quarter of the length is in force", False, "it is a property of a body"),
        Variable("outer.waviness[n]", 9200, "Real", "m", "um", 0.0, 0.0, 0.0001, 60, None, "Amplitude of n waves around the outer race, a height into the bearing's clearance: waviness[n] cos(n phi + waviness_phase[n])", "perfect race", False, "it is part of the geometry"),
        Variable("outer.waviness_phase[n]", 9300, "Real", "rad", "deg", 0.0, -6.2832, 6.2832, 60, None, "Phase of n waves around the outer race; phi from +Y toward +Z at the start, turning with the ring", "perfect race", False, "it is part of the geometry"),
        Variable("inner.waviness[n]", 9400, "Real", "m", "um", 0.0, 0.0, 0.0001, 60, None, "Amplitude of n waves around the inner race, a height into the bearing's clearance: waviness[n] cos(n phi + waviness_phase[n])", "perfect race", False, "it is part of the geometry"),
        Variable("inner.waviness_phase[n]", 9500, "Real", "rad", "deg", 0.0, -6.2832, 6.2832, 60, None, "Phase of n waves around the inner race; phi from +Y toward +Z at the start, turning with the ring", "perfect race", False, "it is part of the geometry"),
        Variable("cage.pocket_clearance", 1101, "Real", "m", "mm", 0.0002, 0.0, 0.005, 1, None, "Pocket diameter - ball diameter", "assumed (0.1...0.4 mm usual)", False, "it is part of the geometry"),
        Variable("cage.guide_clearance", 1102, "Real", "m", "mm", 0.0002, 1e-05, 0.005, 1, None, "Outer ring land diameter - cage outer diameter", "assumed (0.1...0.4 mm usual); least: six roughnesses a side, below it the lands brake the cage like plain bearings, with kilowatts", False, "it is part of the geometry"),
        Variable("cage.pocket_filling", 1126, "Real", "1", None, 0.0, 0.0, 1.0, 1, None, "Oil in the pockets, layer of oil / mean gap: 0 dry, 1 flooded; oil.flow does not enter", "assumed: dry; no measured filling of a pocket is known (docs/notes/pocket_oil.md)", False, None),
        Variable("cage.D_o", 1103, "Real", "m", "mm", 0.0595, 0.005, 2.0, 1, None, "Cage outer diameter (guided by the outer ring)", "paper Table 1", False, "it is part of the geometry"),
        Variable("cage.D_i", 1104, "Real", "m", "mm", 0.0497, 0.005, 2.0, 1, None, "Cage bore diameter", "paper Table 1", False, "it is part of the geometry"),
        Variable("cage.m", 1105, "Real", "kg", "g", 0.0279789, 1e-05, 10.0, 1, None, "Mass of one cage half", "rivet_model/half_shape.py: bronze, 8800 kg/m3, with its half of the steel rivets", False, "it is a property of a body"),
        Variable("cage.J_p", 1106, "Real", "kg.m2", None, 2.11933e-05, 1e-10, 1.0, 1, None, "Polar moment of inertia of one cage half", "rivet_model/half_shape.py, with cage.m", False, "it is a property of a body"),
        Variable("cage.J_t", 1107, "Real", "kg.m2", None, 1.07082e-05, 1e-10, 1.0, 1, None, "Transverse moment of inertia of one cage half about its own centre of mass", "rivet_model/half_shape.py, with cage.m", False, "it is a property of a body"),
        Variable("cage.x_c", 1108, "Real", "m", "mm", 0.00401163, 0.0, 0.1, 1, None, "Axial distance of a half's centre of mass from the split plane", "rivet_model/half_shape.py: a web of 1.14 mm, bars from pocket to pocket", False, "it is part of the geometry"),
        Variable("cage.land_width", 1109, "Real", "m", "mm", 0.0025, 1e-05, 0.2, 1, None, "Width of the guiding land of one half", "assumed", False, "it is part of the geometry"),
        Variable("cage.land_x", 1110, "Real", "m", "mm", 0.0055, 0.0, 0.2, 1, None, "Axial distance of the land's middle from the split plane", "assumed", False, "it is part of the geometry"),
        Variable("cage.material", 1125, "CageMaterial", "1", None, 1, None, None, 1, None, "Material of the cage, from which its rivet table was made", "the 6207's", False, "it is a property of a body"),
        Variable("cage.E", 1111, "Real", "Pa", "GPa", 110000000000.0, 100000000.0, 1000000000000.0, 1, None, "Young's modulus of the cage", "cage.material: bronze", False, "it is a property of a body"),
        Variable("cage.nu", 1112, "Real", "1", None, 0.33, 0.0, 0.49, 1, None, "Poisson's ratio of the cage", "cage.material: bronze", False, "it is a property of a body"),
        Variable("cage.rho", 1124, "Real", "kg/m3", None, 8800.0, 500.0, 23000.0, 1, None, "Density of the cage", "cage.material: bronze", False, "it is a property of a body"),
        Variable("cage.mu", 1113, "Real", "1", None, 0.05, 0.0, 1.0, 1, None, "Friction coefficient between ball and pocket with a full film", "assumed (lubricated bronze on steel)", False, None),
        Variable("cage.v_c", 1114, "Real", "m/s", None, 0.2, 0.0001, 10.0, 1, None, "Sliding speed at which pocket and land friction are 71 % of Coulomb's", "regularization of Coulomb's law", False, None),
        Variable("cage.lambda", 1115, "Real", "s/m", None, 1.0, 0.0, 20.0, 1, None, "Hunt-Crossley damping of the pocket contacts", "assumed: moves RMS pocket force by -24 % from 0 to 10", False, None),
        Variable("cage.mu_land", 1117, "Real", "1", None, 0.08, 0.0, 1.0, 1, None, "Dry friction coefficient between land and outer ring", "assumed (boundary lubrication)", False, None),
        Variable("cage.K_land", 1118, "Real", "N/m1.5", None, 2000000000.0, 1000000.0, 1000000000000.0, 1, None, "Dry contact stiffness of the land: F = K_land (e - C)^1.5", "assumed", False, "it is a property of a body"),
        Variable("cage.g_0", 1119, "Real", "1", None, 0.02, 0.0001, 0.2, 1, None, "Floor of 1 - epsilon^2 in the land film", "regularization: 0.005...0.05 change RMS force by less than 2 % at 0.5 deg tilt", False, None),
        Variable("cage.unbalance", 1120, "Real", "kg.m", "g.mm", 0.0, 0.0, 0.01, 1, None, "Static unbalance of the whole cage, in the direction of pocket 1", "balanced cage", False, "it is a property of a body"),
        Variable("cage.width", 1121, "Real", "m", "mm", 0.0136, 0.001, 0.5, 1, None, "Axial width of the whole cage", "assumed: pocket and two webs of 1.14 mm", False, "it is part of the geometry"),
        Variable("cage.shape", 1130, "CageShape", "1", None, 1, None, None, 1, None, "Shape of the cage halves, from which the rivet table was made", "the 6207's", False, "it is part of the geometry"),
        Variable("cage.guidance", 1131, "CageGuidance", "1", None, 1, None, None, 1, None, "Guidance of the cage: outer, by the film between its lands and the outer ring; balls, by the pockets alone (ribbon cages)", "paper", False, "it is part of the geometry"),
        Variable("cage.sheet", 1132, "Real", "m", "mm", 0.0, 0.0, 0.02, 1, None, "Sheet thickness of a ribbon half", "machined cages have none", False, "it is part of the geometry"),
        Variable("cage.pocket_depth", 1133, "Real", "m", "mm", 0.0, 0.0, 0.1, 1, None, "Depth of a ribbon half's pocket, from the plane of the split to the sphere's bottom", "machined cages have none", False, "it is part of the geometry"),
        Variable("cage.pocket_radius", 1134, "Real", "m", "mm", 0.0, 0.0, 0.1, 1, None, "Radius of the sphere of a ribbon half's pocket; 0 stands for (bearing.D + cage.pocket_clearance)/2, another value must agree with it", "0: from the pocket clearance", False, "it is part of the geometry"),
        Variable("cage.pocket_fillet", 1135, "Real", "m", "mm", 0.0, 0.0, 0.1, 1, None, "Radius of the convex fillet between the sphere and the land of a ribbon half, on the balls' side", "machined cages have none", False, "it is part of the geometry"),
        Variable("cage.pocket_edge", 1136, "Real", "m", "mm", 0.0, 0.0, 0.01, 1, None, "Radius of the edges of a ribbon half's pocket, at the cage's outer and inner diameter; 0 stands for cage.sheet/10", "0: assumed, a tenth of the sheet (tumbled edges)", False, "it is part of the geometry"),
        Variable("cage.centrifugal", 1122, "Switch", "1", None, 2, None, None, 1, None, "Centrifugal load of the cage halves: at the rivets, and their growth at the guiding land", "physics; off: for comparison with figures that leave it out", False, None),
        Variable("pocket[j].dtheta", 8420, "Real", "rad", "deg", 0.0, -0.05, 0.05, Z, None, "Angle of the pocket beyond its place 2 pi (j - 1)/Z, in the sense of rotation", "perfect cage", False, "it is part of the geometry"),
        Variable("pocket[j].dD", 8460, "Real", "m", "um", 0.0, -0.001, 0.001, Z, None, "Excess of the pocket's diameter", "perfect cage", False, "it is part of the geometry"),
        Variable("cage.modal_damping", 1123, "Real", "1", None, 0.01, 0.0, 0.2, 1, None, "Damping ratio of each vibration mode of the halves, scene.cage = elastic", "assumed: riveted and machined brass parts lose 0.3 to 3 % (structural damping)", False, None),
        Variable("cage.modal_damping_high", 1127, "Real", "1", None, 0.0, 0.0, 0.2, 1, None, "Damping ratio of the highest mode; from that of the lowest, cage.modal_damping, linear over ln of the frequency", "0: cage.modal_damping for all modes", False, None),
        Variable("joint.preload", 1201, "Real", "N", None, 20.0, 0.0, 1000.0, 1, None, "Preload of each rivet at 293.15 K", "paper section 4.1 (3)", False, None),
        Variable("joint.fit", 1202, "Real", "m", "um", -1e-05, -0.0005, 0.0001, 1, None, "Rivet diameter - hole diameter, negative = clearance", "paper section 4.1 (3)", False, "it is part of the geometry"),
        Variable("joint.swell", 1203, "Real", "m", "um", 4e-06, 0.0, 5e-05, 1, None, "Growth of the rivet's diameter by riveting, added to the fit", "calibrated to the paper's crossover of head and middle stress in -0.02...0 mm", False, "it is part of the geometry"),
        Variable("joint.mu", 1204, "Real", "1", None, 0.15, 0.0, 1.0, 1, None, "Friction coefficient of plates and rivet heads", "assumed (steel and bronze, little oil)", False, None),
        Variable("joint.zeta", 1205, "Real", "1", None, 0.02, 0.0, 1.0, 1, None, "Damping ratio of the closed joints in the axial direction", "assumed (structural damping)", False, None),
        Variable("joint.F_floor", 1206, "Real", "N", None, 0.5, 0.001, 10.0, 1, None, "Friction capacity that remains in an open joint", "regularization of the friction state as the clamp force vanishes", False, None),
        Variable("joint.wear", 1209, "Real", "1/Pa", None, 0.0, 0.0, 1e-06, 1, None, "Wear coefficient of plates and heads, volume / (normal force x slip): preload that the rivets lose", "0: no loosening; leaded brass on tool steel, dry: 6e-13 (Archard and Hirst, 1956: k = 6e-4, H = 950 MPa); well lubricated metals: k = 1e-7...1e-6, 1e-16...1e-15", False, None),
        Variable("rivet[k].preload_factor", 8520, "Real", "1", None, 1.0, 0.0, 5.0, Z, None, "Preload of this rivet / joint.preload", "rivets all alike", False, None),
        Variable("rivet[k].dfit", 8560, "Real", "m", "um", 0.0, -0.0002, 5e-05, Z, None, "Fit of this rivet less joint.fit", "rivets all alike", False, "it is part of the geometry"),
        Variable("rivet[k].intact", 8600, "Integer", "1", None, 1, 0, 1, Z, None, "0: the rivet is broken and carries nothing; the plates still meet under pressure", "whole rivets", False, None),
        Variable("rivet[k].strength_factor", 8640, "Real", "1", None, 1.0, 0.01, 100.0, Z, None, "Strength of this rivet: factor on fatigue.sigma_D, sigma_m and sigma_f", "rivets all alike", False, None),
        Variable("rivet.fit_model", 1208, "FitModel", "1", None, 2, None, None, 1, None, "Interference: elastic, or with yield of the flange", "flange yields between +2 and +5 um of interference", False, "it is part of the geometry"),
        Variable("oil.eta", 1301, "Real", "Pa.s", "mPa.s", 0.006, 1e-05, 10.0, 1, None, "Dynamic viscosity of the oil at oil.T_0; left at its start value it follows from oil.nu_1, oil.nu_2; one set in a run is in force", "assumed (aviation oil, hot)", True, None),
        Variable("oil.alpha", 1302, "Real", "1/Pa", "1/GPa", 1.3e-08, 1e-10, 1e-07, 1, None, "Pressure-viscosity coefficient at the temperature oil.T_0", "assumed (synthetic aviation oil, hot)", False, None),
        Variable("oil.A", 1303, "Real", "1", None, -0.04, -1.0, 0.0, 1, None, "Traction law mu(s) = (A + B s) exp(-C s) - A", "assumed in the range of fits for 4109 aviation oil; D = -A", False, None),
        Variable("oil.B", 1304, "Real", "1", None, 2.2, 0.0, 100.0, 1, None, "Traction law: linear term", "assumed in the range of fits for 4109 aviation oil", False, None),
        Variable("oil.C", 1305, "Real", "1", None, 45.0, 0.0, 1000.0, 1, None, "Traction law: decay", "assumed in the range of fits for 4109 aviation oil", False, None),
        Variable("oil.v_0", 1306, "Real", "m/s", None, 0.0001, 1e-08, 0.1, 1, None, "Slip speed below which traction is linear in any case", "regularization of the slip speed's modulus", False, None),
        Variable("oil.U_0", 1307, "Real", "m/s", None, 0.01, 1e-06, 1.0, 1, None, "Floor of the rolling speed in slide-roll ratio and film", "regularization toward standstill", False, None),
        Variable("oil.rolling", 1308, "Real", "1", None, 1.0, 0.0, 10.0, 1, None, "Factor on the inlet rolling friction F_R and the horizontal film force F_H", "1: Houpert's formula as it stands", False, None),
        Variable("oil.rho_mix", 1309, "Real", "kg/m3", None, 35.0, 0.0, 1500.0, 1, None, "Density of the oil-air mixture between the rings", "assumed: 4 % oil in air", False, None),
        Variable("oil.C_d", 1310, "Real", "1", None, 0.45, 0.0, 10.0, 1, None, "Drag coefficient of a ball in the mixture", "sphere, Schlichting", False, None),
        Variable("oil.mu_b", 1311, "Real", "1", None, 0.12, 0.0, 1.0, 1, None, "Boundary friction coefficient of asperities (mixed lubrication)", "assumed (mild set L)", False, None),
        Variable("oil.s_0", 1312, "Real", "1", None, 0.006, 0.0001, 1.0, 1, None, "Slide-roll ratio at which asperity friction is 71 % of mu_b", "tangential creep of a Hertz contact saturates near 3 mu Q/(G a b C) = 0.5...0.7 %", False, None),
        Variable("oil.sigma_race", 1313, "Real", "m", "um", 2e-07, 1e-09, 1e-05, 1, None, "Composite RMS roughness of ball and race", "assumed (mild set L)", False, "it is part of the geometry"),
        Variable("oil.sigma_pocket", 1314, "Real", "m", "um", 6e-07, 1e-09, 1e-05, 1, None, "Composite RMS roughness of ball and pocket, floor of a film in the pocket", "assumed (mild set L)", False, "it is part of the geometry"),
        Variable("oil.sigma_land", 1315, "Real", "m", "um", 8e-07, 1e-09, 1e-05, 1, None, "Composite RMS roughness of cage and outer ring lands", "assumed (turned and ground lands)", False, "it is part of the geometry"),
        Variable("oil.rho", 1316, "Real", "kg/m3", None, 900.0, 100.0, 2000.0, 1, None, "Density of the oil at the temperature oil.T_0", "aviation oil, hot", False, None),
        Variable("oil.flow", 8201, "Real", "m3/s", "L/min", 0.0, 0.0, 0.1, 1, None, "Flow of oil through the bearing, from which the density of the mixture follows (Parker, NASA TP-2275)", "0: not known, the mixture has the density oil.rho_mix", False, None),
        Variable("oil.beta", 8202, "Real", "1/K", None, 0.022, 0.0, 0.2, 1, None, "Fall of the viscosity's logarithm with temperature at oil.T_0; left at its start value it follows from oil.nu_1, oil.nu_2; one set in a run is in force", "MIL-PRF-23699 oil of 25 and 5 mm2/s at 40 and 100 degC, ASTM D341, at 6 mPa.s", True, None),
        Variable("oil.T_0", 8206, "Real", "K", "degC", 359.0006, 200.0, 600.0, 1, None, "Temperature at which oil.eta, oil.alpha, oil.rho and oil.beta are given", "where MIL-PRF-23699 oil has 6 mPa.s", False, None),
        Variable("oil.nu_1", 8207, "Real", "m2/s", "mm2/s", 2.5e-05, 1e-06, 1.0, 1, None, "Kinematic viscosity of the oil at the lower temperature oil.T_1", "MIL-PRF-23699", False, None),
        Variable("oil.T_1", 8208, "Real", "K", "degC", 313.15, 200.0, 600.0, 1, None, "Lower temperature of the viscosity's two points", "MIL-PRF-23699", False, None),
        Variable("oil.nu_2", 8209, "Real", "m2/s", "mm2/s", 5e-06, 1e-06, 1.0, 1, None, "Kinematic viscosity of the oil at the higher temperature oil.T_2", "MIL-PRF-23699", False, None),
        Variable("oil.T_2", 8215, "Real", "K", "degC", 373.15, 200.0, 600.0, 1, None, "Higher temperature of the viscosity's two points", "MIL-PRF-23699", False, None),
        Variable("oil.expansion", 8216, "Real", "1/K", None, 0.00075, 0.0, 0.0015, 1, None, "Fall of the oil's density with temperature / oil.rho", "assumed (ester and mineral oils: 6.5e-4...8e-4)", False, None),
        Variable("oil.alpha_T", 8217, "Real", "1/K", None, 0.0037, 0.0, 0.05, 1, None, "Fall of the pressure-viscosity coefficient's logarithm with temperature", "ester aviation oil at 38 and 149 degC: 12.8 and 8.51 1/GPa (Jones et al., 1975)", False, None),
        Variable("oil.k", 8203, "Real", "W/m.K", None, 0.14, 0.01, 1.0, 1, None, "Thermal conductivity of the oil", "assumed (ester and mineral oils: 0.12...0.15)", False, None),
        Variable("oil.K_rs", 8204, "Real", "1", None, 3e-08, 0.0, 1e-06, 1, None, "Starvation of the race inlets", "SKF: 3e-8 for oil jet and low oil bath, 6e-8 for grease and oil-air; 0: fully flooded", False, None),
        Variable("oil.K_Z", 8205, "Real", "1", None, 3.1, 0.0, 10.0, 1, None, "Starvation of the race inlets: factor of the bearing type", "SKF: deep-groove ball bearings 3.1, angular-contact ball bearings 4.4", False, None),
        Variable("ring.m", 1401, "Real", "kg", None, 0.6, 0.001, 1000.0, 1, None, "Mass of the inner ring with its share of the shaft", "assumed: inner ring and its share of the shaft", False, "it is a property of a body"),
        Variable("ring.J_p", 1402, "Real", "kg.m2", None, 0.00018, 1e-09, 100.0, 1, None, "Polar moment of inertia of the inner ring", "assumed: inner ring and its share of the shaft", False, "it is a property of a body"),
        Variable("ring.J_t", 1403, "Real", "kg.m2", None, 0.00012, 1e-09, 100.0, 1, None, "Transverse moment of inertia of the inner ring", "assumed: inner ring and its share of the shaft", False, "it is a property of a body"),
        Variable("ring.c", 1404, "Real", "N.s/m", None, 1500.0, 0.0, 1000000.0, 1, None, "Damping of the inner ring's translation against the housing", "assumed: damping by shaft and housing", False, None),
        Variable("ring.tilt_mode", 1405, "TiltMode", "1", None, 1, None, None, 1, None, "How the inner ring tilts", "paper section 4.1 (4): tilt given", False, "it decides on the states and their meaning"),
        Variable("ring.tilt_time", 1406, "Real", "s", None, 0.0001, 1e-06, 1.0, 1, None, "Time constant of the critically damped filter of the prescribed tilt", "assumed: shorter than any pocket period", False, None),
        Variable("ring.k_tilt", 1407, "Real", "N.m/rad", None, 20000.0, 0.0, 100000000.0, 1, None, "Angular stiffness of the ring's support (supported tilt)", "assumed: a second bearing nearby", False, None),
        Variable("ring.c_tilt", 1408, "Real", "N.m.s/rad", None, 1.0, 0.0, 10000.0, 1, None, "Angular damping of the ring's support (supported tilt)", "assumed: damping ratio 0.3 with the default stiffness and inertia", False, None),
        Variable("ring.bore", 8221, "Real", "m", "mm", 0.0, 0.0, 1.0, 1, None, "Bore of the inner ring: its growth by rotation and fit", "0: d_m - D/0.6, as usual cross-sections have it (6207: 35 mm)", False, "it is part of the geometry"),
        Variable("ring.rho", 8222, "Real", "kg/m3", None, 7800.0, 1000.0, 20000.0, 1, None, "Density of the inner ring", "bearing steel, Harris", False, "it is a property of a body"),
        Variable("ring.motion", 1421, "RingMotion", "1", None, 1, None, None, 1, None, "Whether the shaft's loads or its motion are given", "paper: loads given", False, "it decides on the states and their meaning"),
        Variable("ring.outside", 8223, "Real", "m", "mm", 0.0, 0.0, 2.0, 1, None, "Outside diameter of the outer ring: its fit in the housing", "0: d_m + D/0.6, as usual cross-sections have it (6207: 72 mm)", False, "it is part of the geometry"),
        Variable("ring.effective_i", 8224, "Real", "m", "mm", 0.0, 0.0, 2.0, 1, None, "Outside diameter of the cylinder that the inner ring is for growth and fit", "0: over the shoulders", False, "it is part of the geometry"),
        Variable("ring.effective_e", 8225, "Real", "m", "mm", 0.0, 0.0, 2.0, 1, None, "Inside diameter of the cylinder that the outer ring is for its fit", "0: over the shoulders", False, "it is part of the geometry"),
        Variable("shaft.interference", 8226, "Real", "m", "um", 0.0, -0.001, 0.001, 1, None, "Shaft diameter - bore of the inner ring before mounting, at assembly temperature; negative = clearance", "no fit", False, "it is part of the geometry"),
        Variable("shaft.bore", 8227, "Real", "m", "mm", 0.0, 0.0, 1.0, 1, None, "Bore of the shaft", "0: solid shaft", False, "it is part of the geometry"),
        Variable("shaft.E", 8228, "Real", "Pa", "GPa", 207000000000.0, 1000000000.0, 1000000000000.0, 1, None, "Young's modulus of the shaft", "steel", False, "it is a property of a body"),
        Variable("shaft.nu", 8229, "Real", "1", None, 0.3, 0.0, 0.49, 1, None, "Poisson's ratio of the shaft", "steel", False, "it is a property of a body"),
        Variable("shaft.rho", 8230, "Real", "kg/m3", None, 7800.0, 1000.0, 20000.0, 1, None, "Density of the shaft", "steel", False, "it is a property of a body"),
        Variable("shaft.expansion", 8232, "Real", "1/K", None, 1.17e-05, 0.0, 0.0001, 1, None, "Thermal expansion of the shaft, whose seat has the inner ring's temperature", "steel", False, "it is a property of a body"),
        Variable("housing.interference", 8233, "Real", "m", "um", 0.0, -0.001, 0.001, 1, None, "Outside diameter of the outer ring - bore of the housing before mounting, at assembly temperature; negative = clearance", "no fit", False, "it is part of the geometry"),
        Variable("housing.outside", 8234, "Real", "m", "mm", 0.0, 0.0, 10.0, 1, None, "Outside diameter of the housing", "0: much larger than the bearing", False, "it is part of the geometry"),
        Variable("housing.E", 8235, "Real", "Pa", "GPa", 207000000000.0, 1000000000.0, 1000000000000.0, 1, None, "Young's modulus of the housing", "steel", False, "it is a property of a body"),
        Variable("housing.nu", 8236, "Real", "1", None, 0.3, 0.0, 0.49, 1, None, "Poisson's ratio of the housing", "steel", False, "it is a property of a body"),
        Variable("housing.expansion", 8237, "Real", "1/K", None, 1.17e-05, 0.0, 0.0001, 1, None, "Thermal expansion of the housing, whose seat has the outer ring's temperature", "steel", False, "it is a property of a body"),
        Variable("gravity.y", 1501, "Real", "m/s2", None, 0.0, -1000.0, 1000.0, 1, None, "Gravity along Y of the fixed frame, to which the bearing's frame is parallel at the start", "off", False, None),
        Variable("gravity.z", 1502, "Real", "m/s2", None, 0.0, -1000.0, 1000.0, 1, None, "Gravity along Z of the fixed frame", "off", False, None),
        Variable("housing.motion", 9600, "HousingMotion", "1", None, 1, None, None, 1, None, "Whether the housing's motion is given or follows from springs", "outer ring given", False, "it decides on the states and their meaning"),
        Variable("housing.m", 9601, "Real", "kg", None, 5.0, 0.01, 10000.0, 1, None, "Mass of the housing with the outer ring", "assumed: a small pillow block", False, "it is a property of a body"),
        Variable("housing.J", 9602, "Real", "kg.m2", None, 0.01, 1e-06, 1000.0, 1, None, "Moment of inertia of the housing with the outer ring about Y and Z", "assumed: a small pillow block", False, "it is a property of a body"),
        Variable("housing.k_x", 9603, "Real", "N/m", None, 100000000.0, 0.0, 1000000000000.0, 1, None, "Stiffness of the housing's support along X", "assumed: 700 Hz with housing.m", False, "it is a property of a body"),
        Variable("housing.k_y", 9604, "Real", "N/m", None, 100000000.0, 0.0, 1000000000000.0, 1, None, "Stiffness of the housing's support along Y", "assumed: 700 Hz with housing.m", False, "it is a property of a body"),
        Variable("housing.k_z", 9605, "Real", "N/m", None, 100000000.0, 0.0, 1000000000000.0, 1, None, "Stiffness of the housing's support along Z", "assumed: 700 Hz with housing.m", False, "it is a property of a body"),
        Variable("housing.c_x", 9606, "Real", "N.s/m", None, 1000.0, 0.0, 10000000.0, 1, None, "Damping of the housing's support along X", "assumed: 2 % of critical", False, "it is a property of a body"),
        Variable("housing.c_y", 9607, "Real", "N.s/m", None, 1000.0, 0.0, 10000000.0, 1, None, "Damping of the housing's support along Y", "assumed: 2 % of critical", False, "it is a property of a body"),
        Variable("housing.c_z", 9608, "Real", "N.s/m", None, 1000.0, 0.0, 10000000.0, 1, None, "Damping of the housing's support along Z", "assumed: 2 % of critical", False, "it is a property of a body"),
        Variable("housing.k_tilt_y", 9609, "Real", "N.m/rad", None, 100000.0, 0.0, 10000000000.0, 1, None, "Stiffness of the housing's support about Y", "assumed", False, "it is a property of a body"),
        Variable("housing.k_tilt_z", 9610, "Real", "N.m/rad", None, 100000.0, 0.0, 10000000000.0, 1, None, "Stiffness of the housing's support about Z", "assumed", False, "it is a property of a body"),
        Variable("housing.c_tilt_y", 9611, "Real", "N.m.s/rad", None, 1.0, 0.0, 100000.0, 1, None, "Damping of the housing's support about Y", "assumed: 2 % of critical", False, "it is a property of a body"),
        Variable("housing.c_tilt_z", 9612, "Real", "N.m.s/rad", None, 1.0, 0.0, 100000.0, 1, None, "Damping of the housing's support about Z", "assumed: 2 % of critical", False, "it is a property of a body"),
        Variable("frame.radius", 1511, "Real", "m", "mm", 0.0, 0.0, 2.0, 1, None, "Distance of the bearing from the axis of frame.omega, which lies on -Y", "no arm", False, "it is part of the geometry"),
        Variable("pulse.F_r", 1601, "Real", "N", None, 0.0, -100000.0, 100000.0, 1, None, "Amplitude of the built-in half-sine impacts along the radial load", "no impact (paper section 4.1 (3): 1401 N)", False, None),
        Variable("pulse.F_a", 1602, "Real", "N", None, 0.0, -100000.0, 100000.0, 1, None, "Amplitude of the built-in half-sine impacts along +X", "no impact (paper section 4.1 (3): 241 N)", False, None),
        Variable("pulse.t_start", 1603, "Real", "s", None, 0.1, 0.0, 1000000.0, 1, None, "Start of the first impact", "after settling", False, None),
        Variable("pulse.duration", 1604, "Real", "s", "ms", 0.001, 1e-06, 1000.0, 1, None, "Duration of one impact", "assumed", False, None),
        Variable("pulse.interval", 1605, "Real", "s", "ms", 0.00333333333333333, 1e-06, 1000000.0, 1, None, "Time from one impact's start to the next one's (not shorter than the duration)", "paper section 4.1 (3): three in 0.01 s", False, None),
        Variable("pulse.count", 1606, "Integer", "1", None, 3, 0, 1000000, 1, None, "Number of impacts", "paper section 4.1 (3): three in 0.01 s", False, None),
        Variable("fatigue.sigma_D", 1701, "Real", "Pa", "MPa", 250000000.0, 100000.0, 10000000000.0, 1, None, "Stress amplitude at the knee of the S-N curve (R = -1)", "assumed: 0.32 of the strength of quenched and tempered 15CrMn", False, None),
        Variable("fatigue.N_D", 1702, "Real", "1", None, 2000000.0, 100.0, 10000000000.0, 1, None, "Cycles at the knee", "assumed (usual for steel)", False, None),
        Variable("fatigue.k_1", 1703, "Real", "1", None, 8.0, 1.0, 40.0, 1, None, "Slope above the knee: N = N_D (sigma_a/sigma_D)^-k_1", "assumed (mild notch)", False, None),
        Variable("fatigue.k_2", 1704, "Real", "1", None, 15.0, 1.0, 100.0, 1, None, "Slope below the knee", "Haibach: 2 k_1 - 1", False, None),
        Variable("fatigue.sigma_m", 1705, "Real", "Pa", "MPa", 785000000.0, 1000000.0, 10000000000.0, 1, None, "Tensile strength (Goodman)", "assumed (15CrMn, quenched and tempered)", False, None),
        Variable("fatigue.sigma_f", 1706, "Real", "Pa", "MPa", 1180000000.0, 1000000.0, 10000000000.0, 1, None, "Fatigue strength coefficient (Morrow)", "1.5 times the tensile strength (uniform material law)", False, None),
        Variable("fatigue.acceleration", 1708, "Real", "1", None, 1.0, 0.001, 1000000000000000.0, 1, None, "Factor on the damage of every cycle that is counted, by which a life passes in seconds; 1 for results", "1: damage as it is", False, None),
        Variable("fatigue.fretting", 1711, "Real", "1", None, 1.0, 1.0, 10.0, 1, None, "Fretting strength reduction: divides the strength of the middle of a shank on which its hole presses", "off; press fits of steels of 400 to 1200 MPa: 1.8 to 2.9, of 785 MPa: 2.4 (DIN 743-2, 2.7 (sigma_m/1000 MPa)^0.43) (from memory, not checked)", False, None),
        Variable("fatigue.mean_stress", 1707, "MeanStress", "1", None, 2, None, None, 1, None, "Mean-stress correction", "practice", False, None),
        Variable("scene.cage", 1801, "CageModel", "1", None, 3, None, None, 1, None, "Cage of two halves, rigid or elastic ones", "measured: with rigid halves the 99.9 % head stress is 7 to 29 % too large, 62 % at 0.2 deg of tilt, its mean up to 11 % too small", False, "it decides on the states and their meaning"),
        Variable("scene.traction", 1802, "Traction", "1", None, 2, None, None, 1, None, "Traction at a point or over slices of the contact ellipse", "measured: one point for the whole ellipse leaves out spin: 99.9 % head stress +32 % in demo, +13 % in R and F, friction torque -30 % and -11 %", False, None),
        Variable("scene.lubrication", 1803, "Lubrication", "1", None, 1, None, None, 1, None, "Full film or mixed lubrication", "default", False, None),
        Variable("scene.stress", 1804, "Stress", "1", None, 3, None, None, 1, None, "When the rivet stress is computed", "default", False, None),
        Variable("scene.statistics", 1805, "Switch", "1", None, 1, None, None, 1, None, "Running mean, RMS and histogram behind stat.*", "default", False, None),
        Variable("scene.drag", 8211, "Drag", "1", None, 2, None, None, 1, None, "Drag of the balls in the mixture between the rings", "default", False, None),
        Variable("scene.churning", 8212, "Switch", "1", None, 2, None, None, 1, None, "Drag moment of the mixture on the spinning balls", "default", False, None),
        Variable("scene.heating", 8213, "Switch", "1", None, 2, None, None, 1, None, "Shear heating in the inlets of the races, in their films and in the films of the lands", "default", False, None),
        Variable("scene.growth", 8214, "Switch", "1", None, 2, None, None, 1, None, "Growth of the inner ring by its rotation, which takes clearance", "physics; off: for comparison with figures that leave it out", False, None),
        Variable("scene.breakage", 1806, "Switch", "1", None, 1, None, None, 1, None, "Whether a rivet breaks at the end of the communication step in which its damage reaches 1", "default", False, None),
        Variable("solver.tol", 1901, "Real", "1", None, 0.001, 1e-10, 0.1, 1, None, "Tolerance: local error / scale of each state class; a tolerance of fmi2SetupExperiment takes its place", "measured in 102 random scenes against steps of 3 us: half of them within 0.1 % in every statistic; 95 % within 0.8 % (mean stress), 1.9 % (99.9 %), 2.6 % (99.9 % pocket force), 0.4 % (torque), 4.7 % (dislocation)", False, None),
        Variable("solver.method", 1902, "Method", "1", None, 1, None, None, 1, None, "Integration method", "measured: fewest processor seconds at every tolerance down to 2e-5", False, "it decides on the states and their meaning"),
        Variable("solver.step", 1904, "Real", "s", "us", 0.0, 0.0, 0.001, 1, None, "Longest internal step of solver.method = fixed, at least 1 ns (0: derived at the start; solver.step_size shows it)", "0: derived at the start from the cage's fastest vibration and the errors of 30 ms on trial; at most a tenth of a pocket's pulse", False, "it decides on the states and their meaning"),
        Variable("solver.clock", 1905, "Switch", "1", None, 1, None, None, 1, None, "Measure solver.cpu_time", "a reading of the clock costs 1 % of a communication step of 0.1 ms", False, None),
        Variable("solver.max_steps", 1903, "Integer", "1", None, 0, 0, 2000000000, 1, None, "Largest number of internal steps in one communication step; 0: 6000 for each 0.1 ms begun, 20000 with solver.method = fixed", "work limit instead of a hung host: at most 0.2 s of processor time for 0.1 ms", False, None),
        Variable("start.seed", 1951, "Integer", "1", None, 1, 0, 2147483647, 1, None, "Seed of the balls' initial spacing (splitmix64)", "default", False, "it belongs to the start"),
        Variable("start.spacing", 1952, "Real", "1", None, 0.1, 0.0, 0.5, 1, None, "Initial spacing error: uniform within +- this part of the pocket clearance", "assumed", False, "it belongs to the start"),
        Variable("start.settle", 1953, "Real", "s", None, 0.05, 0.0, 1000000.0, 1, None, "Time before which stat.* and damage do not count", "15 revolutions at the working point", False, "it belongs to the start"),
    )
}

INPUTS = {
    v.name: v
    for v in (
        Variable("shaft.F_x", 1, "Real", "N", None, 515.0, -100000.0, 100000.0, 1, None, "Axial load on the inner ring", "paper Table 2", False, None),
        Variable("shaft.F_y", 2, "Real", "N", None, 2994.0, -100000.0, 100000.0, 1, None, "Radial load on the inner ring along Y", "paper Table 2", False, None),
        Variable("shaft.F_z", 3, "Real", "N", None, 0.0, -100000.0, 100000.0, 1, None, "Radial load on the inner ring along Z", "paper Table 2", False, None),
        Variable("shaft.M_y", 4, "Real", "N.m", None, 0.0, -10000.0, 10000.0, 1, None, "Moment about Y on the inner ring (supported or free tilt)", "paper Table 2", False, None),
        Variable("shaft.M_z", 5, "Real", "N.m", None, 0.0, -10000.0, 10000.0, 1, None, "Moment about Z on the inner ring (supported or free tilt)", "paper Table 2", False, None),
        Variable("shaft.omega", 6, "Real", "rad/s", "rev/min", 1909.8788938723549, -15000.0, 15000.0, 1, None, "Speed of the inner ring about X", "paper Table 2 (18238 r/min)", False, None),
        Variable("shaft.tilt_y", 7, "Real", "rad", "deg", 0.0, -0.035, 0.035, 1, None, "Tilt of the shaft about Y (+X turns toward -Z)", "paper section 4.1 (4), base case", False, None),
        Variable("shaft.tilt_z", 8, "Real", "rad", "deg", 0.0, -0.035, 0.035, 1, None, "Tilt of the shaft about Z (+X turns toward +Y)", "paper section 4.1 (4), base case", False, None),
        Variable("shaft.x", 21, "Real", "m", "um", 0.0, -0.002, 0.002, 1, None, "Position of the inner ring along X (prescribed motion)", "at rest in the centre", False, None),
        Variable("shaft.y", 22, "Real", "m", "um", 0.0, -0.002, 0.002, 1, None, "Position of the inner ring along Y (prescribed motion)", "at rest in the centre", False, None),
        Variable("shaft.z", 23, "Real", "m", "um", 0.0, -0.002, 0.002, 1, None, "Position of the inner ring along Z (prescribed motion)", "at rest in the centre", False, None),
        Variable("shaft.v_x", 24, "Real", "m/s", None, 0.0, -10.0, 10.0, 1, None, "Velocity of the inner ring along X (prescribed motion)", "at rest", False, None),
        Variable("shaft.v_y", 25, "Real", "m/s", None, 0.0, -10.0, 10.0, 1, None, "Velocity of the inner ring along Y (prescribed motion)", "at rest", False, None),
        Variable("shaft.v_z", 26, "Real", "m/s", None, 0.0, -10.0, 10.0, 1, None, "Velocity of the inner ring along Z (prescribed motion)", "at rest", False, None),
        Variable("shaft.tilt_y_dot", 29, "Real", "rad/s", None, 0.0, -200.0, 200.0, 1, None, "Rate of shaft.tilt_y (prescribed motion)", "at rest", False, None),
        Variable("shaft.tilt_z_dot", 30, "Real", "rad/s", None, 0.0, -200.0, 200.0, 1, None, "Rate of shaft.tilt_z (prescribed motion)", "at rest", False, None),
        Variable("impact.F_r", 9, "Real", "N", None, 0.0, -100000.0, 100000.0, 1, None, "Impact load added along the present radial load (+Y if there is none)", "no impact", False, None),
        Variable("impact.F_a", 10, "Real", "N", None, 0.0, -100000.0, 100000.0, 1, None, "Impact load added along +X", "no impact", False, None),
        Variable("housing.x", 31, "Real", "m", "um", 0.0, -0.002, 0.002, 1, None, "Position of the outer ring along X", "at rest in the centre", False, None),
        Variable("housing.y", 32, "Real", "m", "um", 0.0, -0.002, 0.002, 1, None, "Position of the outer ring along Y", "at rest in the centre", False, None),
        Variable("housing.z", 33, "Real", "m", "um", 0.0, -0.002, 0.002, 1, None, "Position of the outer ring along Z", "at rest in the centre", False, None),
        Variable("housing.v_x", 34, "Real", "m/s", None, 0.0, -10.0, 10.0, 1, None, "Velocity of the outer ring along X", "at rest", False, None),
        Variable("housing.v_y", 35, "Real", "m/s", None, 0.0, -10.0, 10.0, 1, None, "Velocity of the outer ring along Y", "at rest", False, None),
        Variable("housing.v_z", 36, "Real", "m/s", None, 0.0, -10.0, 10.0, 1, None, "Velocity of the outer ring along Z", "at rest", False, None),
        Variable("housing.tilt_y", 37, "Real", "rad", "deg", 0.0, -0.035, 0.035, 1, None, "Tilt of the outer ring about Y (+X turns toward -Z)", "straight", False, None),
        Variable("housing.tilt_z", 38, "Real", "rad", "deg", 0.0, -0.035, 0.035, 1, None, "Tilt of the outer ring about Z (+X turns toward +Y)", "straight", False, None),
        Variable("housing.tilt_y_dot", 39, "Real", "rad/s", None, 0.0, -200.0, 200.0, 1, None, "Rate of housing.tilt_y", "at rest", False, None),
        Variable("housing.tilt_z_dot", 40, "Real", "rad/s", None, 0.0, -200.0, 200.0, 1, None, "Rate of housing.tilt_z", "at rest", False, None),
        Variable("housing.omega", 41, "Real", "rad/s", "rev/min", 0.0, -15000.0, 15000.0, 1, None, "Speed of the outer ring about X", "outer ring at rest", False, None),
        Variable("frame.a_x", 51, "Real", "m/s2", None, 0.0, -100000.0, 100000.0, 1, None, "Acceleration of the frame's axis of rotation along X of the frame", "frame at rest", False, None),
        Variable("frame.a_y", 52, "Real", "m/s2", None, 0.0, -100000.0, 100000.0, 1, None, "Acceleration of the frame's axis of rotation along Y of the frame", "frame at rest", False, None),
        Variable("frame.a_z", 53, "Real", "m/s2", None, 0.0, -100000.0, 100000.0, 1, None, "Acceleration of the frame's axis of rotation along Z of the frame", "frame at rest", False, None),
        Variable("frame.omega", 54, "Real", "rad/s", "rev/min", 0.0, -5000.0, 5000.0, 1, None, "Speed of the frame about an axis parallel to X, frame.radius away on -Y", "frame at rest", False, None),
        Variable("frame.omega_dot", 55, "Real", "rad/s2", None, 0.0, -10000000.0, 10000000.0, 1, None, "Rate of frame.omega", "frame at rest", False, None),
        Variable("oil.T", 8301, "Real", "K", "degC", 359.0006, 200.0, 600.0, 1, None, "Temperature of the oil", "where MIL-PRF-23699 oil has 6 mPa.s", False, None),
        Variable("ring.T_i", 8302, "Real", "K", "degC", 293.15, 150.0, 700.0, 1, None, "Temperature of the inner ring", "assembly temperature", False, None),
        Variable("ring.T_e", 8303, "Real", "K", "degC", 293.15, 150.0, 700.0, 1, None, "Temperature of the outer ring", "assembly temperature", False, None),
        Variable("ball.T", 8304, "Real", "K", "degC", 293.15, 150.0, 700.0, 1, None, "Temperature of the balls", "assembly temperature", False, None),
        Variable("cage.T", 8305, "Real", "K", "degC", 293.15, 150.0, 700.0, 1, None, "Temperature of cage and rivets", "assembly temperature", False, None),
    )
}

OUTPUTS = {
    v.name: v
    for v in (
        Variable("bearing.Z", 2001, "Real", "1", None, 9, None, None, 1, "constant", "Number of balls (build-time constant)", None, False, None),
        Variable("ring.x", 2101, "Real", "m", "um", None, None, None, 1, "state", "Displacement of the inner ring along X", None, False, None),
        Variable("ring.y", 2102, "Real", "m", "um", None, None, None, 1, "state", "Displacement of the inner ring along Y", None, False, None),
        Variable("ring.z", 2103, "Real", "m", "um", None, None, None, 1, "state", "Displacement of the inner ring along Z", None, False, None),
        Variable("ring.v_x", 2104, "Real", "m/s", None, None, None, None, 1, "state", "Velocity of the inner ring along X", None, False, None),
        Variable("ring.v_y", 2105, "Real", "m/s", None, None, None, None, 1, "state", "Velocity of the inner ring along Y", None, False, None),
        Variable("ring.v_z", 2106, "Real", "m/s", None, None, None, None, 1, "state", "Velocity of the inner ring along Z", None, False, None),
        Variable("ring.a_x", 2107, "Real", "m/s2", None, None, None, None, 1, "ring", "Acceleration of the inner ring along X", None, False, None),
        Variable("ring.a_y", 2108, "Real", "m/s2", None, None, None, None, 1, "ring", "Acceleration of the inner ring along Y", None, False, None),
        Variable("ring.a_z", 2109, "Real", "m/s2", None, None, None, None, 1, "ring", "Acceleration of the inner ring along Z", None, False, None),
        Variable("ring.tilt_y", 2110, "Real", "rad", "deg", None, None, None, 1, "ring", "Tilt of the inner ring about Y", None, False, None),
        Variable("ring.tilt_z", 2111, "Real", "rad", "deg", None, None, None, 1, "ring", "Tilt of the inner ring about Z", None, False, None),
        Variable("ring.beta", 2112, "Real", "1", None, None, None, None, 1, "state", "Axis of the inner ring a = (a_x, gamma, -beta): direction cosine, the sine of a tilt about Y", None, False, None),
        Variable("ring.gamma", 2113, "Real", "1", None, None, None, None, 1, "state", "Axis of the inner ring: direction cosine, the sine of a tilt about Z", None, False, None),
        Variable("ring.beta_dot", 2114, "Real", "1/s", None, None, None, None, 1, "state", "Rate of ring.beta", None, False, None),
        Variable("ring.gamma_dot", 2115, "Real", "1/s", None, None, None, None, 1, "state", "Rate of ring.gamma", None, False, None),
        Variable("ring.beta_ddot", 2116, "Real", "1/s2", None, None, None, None, 1, "ring", "Second derivative of ring.beta", None, False, None),
        Variable("ring.gamma_ddot", 2117, "Real", "1/s2", None, None, None, None, 1, "ring", "Second derivative of ring.gamma", None, False, None),
        Variable("housing.F_x", 2151, "Real", "N", None, None, None, None, 1, "ring", "Force on the housing along X (by balls and cage through the outer ring)", None, False, None),
        Variable("housing.F_y", 2152, "Real", "N", None, None, None, None, 1, "ring", "Force on the housing along Y", None, False, None),
        Variable("housing.F_z", 2153, "Real", "N", None, None, None, None, 1, "ring", "Force on the housing along Z", None, False, None),
        Variable("housing.M_y", 2154, "Real", "N.m", None, None, None, None, 1, "ring", "Moment on the housing about Y, at the outer ring's centre", None, False, None),
        Variable("housing.M_z", 2155, "Real", "N.m", None, None, None, None, 1, "ring", "Moment on the housing about Z, at the outer ring's centre", None, False, None),
        Variable("housing.M_x", 2156, "Real", "N.m", None, None, None, None, 1, "ring", "Moment on the housing about X, at the outer ring's centre", None, False, None),
        Variable("housing.u_x", 9650, "Real", "m", "um", None, None, None, 1, "ring", "Displacement of the outer ring along X; on springs from its place at the start", None, False, None),
        Variable("housing.u_y", 9651, "Real", "m", "um", None, None, None, 1, "ring", "Displacement of the outer ring along Y; on springs from its place at the start", None, False, None),
        Variable("housing.u_z", 9652, "Real", "m", "um", None, None, None, 1, "ring", "Displacement of the outer ring along Z; on springs from its place at the start", None, False, None),
        Variable("housing.u_tilt_y", 9653, "Real", "rad", "deg", None, None, None, 1, "ring", "Tilt of the outer ring about Y", None, False, None),
        Variable("housing.u_tilt_z", 9654, "Real", "rad", "deg", None, None, None, 1, "ring", "Tilt of the outer ring about Z", None, False, None),
        Variable("housing.a_x", 9655, "Real", "m/s2", None, None, None, None, 1, "ring", "Acceleration of the outer ring along X: what an accelerometer on the housing measures; at the last step", None, False, None),
        Variable("housing.a_y", 9656, "Real", "m/s2", None, None, None, None, 1, "ring", "Acceleration of the outer ring along Y: what an accelerometer on the housing measures; at the last step", None, False, None),
        Variable("housing.a_z", 9657, "Real", "m/s2", None, None, None, None, 1, "ring", "Acceleration of the outer ring along Z: what an accelerometer on the housing measures; at the last step", None, False, None),
        Variable("shaft.R_x", 2161, "Real", "N", None, None, None, None, 1, "ring", "Force of the bearing's contacts and films on the shaft along X", None, False, None),
        Variable("shaft.R_y", 2162, "Real", "N", None, None, None, None, 1, "ring", "Force of the bearing's contacts and films on the shaft along Y", None, False, None),
        Variable("shaft.R_z", 2163, "Real", "N", None, None, None, None, 1, "ring", "Force of the bearing's contacts and films on the shaft along Z", None, False, None),
        Variable("shaft.R_My", 2164, "Real", "N.m", None, None, None, None, 1, "ring", "Moment of the bearing's contacts and films on the shaft about Y, at the inner ring's centre", None, False, None),
        Variable("shaft.R_Mz", 2165, "Real", "N.m", None, None, None, None, 1, "ring", "Moment of the bearing's contacts and films on the shaft about Z, at the inner ring's centre", None, False, None),
        Variable("shaft.power", 2171, "Real", "W", None, None, None, None, 1, "energy", "Power of the shaft into balls and cage: by torque, translation and tilting of the inner ring; mean over the communication step", None, False, None),
        Variable("housing.power", 2172, "Real", "W", None, None, None, None, 1, "energy", "Power of the housing into balls and cage", None, False, None),
        Variable("frame.power", 2173, "Real", "W", None, None, None, None, 1, "energy", "Power of gravity and of the frame's inertia forces into balls and cage", None, False, None),
        Variable("bearing.energy", 2174, "Real", "J", None, None, None, None, 1, "energy", "Kinetic energy of balls and cage in the frame, and elastic energy of all contacts", None, False, None),
        Variable("ball[j].Q_i", 2200, "Real", "N", None, None, None, None, Z, "ball", "Contact load on the inner race", None, False, None),
        Variable("ball[j].Q_e", 2240, "Real", "N", None, None, None, None, Z, "ball", "Contact load on the outer race", None, False, None),
        Variable("ball[j].alpha_i", 2280, "Real", "rad", "deg", None, None, None, Z, "ball", "Contact angle at the inner race (0 without contact)", None, False, None),
        Variable("ball[j].alpha_e", 2320, "Real", "rad", "deg", None, None, None, Z, "ball", "Contact angle at the outer race (0 without contact)", None, False, None),
        Variable("ball[j].Q_c", 2360, "Real", "N", None, None, None, None, Z, "ball", "Contact load on the cage pocket, both halves together; at an instant of a chaotic motion: compare stat.*", None, False, None),
        Variable("ball[j].omega_m", 2400, "Real", "rad/s", "rev/min", None, None, None, Z, "ball", "Orbital speed", None, False, None),
        Variable("ball[j].p_i", 2440, "Real", "Pa", "MPa", None, None, None, Z, "ball", "Largest contact pressure on the inner race", None, False, None),
        Variable("ball[j].p_e", 2480, "Real", "Pa", "MPa", None, None, None, Z, "ball", "Largest contact pressure on the outer race", None, False, None),
        Variable("ball[j].Lambda_i", 2520, "Real", "1", None, None, None, None, Z, "ball", "Film thickness / roughness at the inner race (0 without contact)", None, False, None),
        Variable("ball[j].Lambda_e", 2560, "Real", "1", None, None, None, None, Z, "ball", "Film thickness / roughness at the outer race (0 without contact)", None, False, None),
        Variable("ball[j].spin_roll", 2600, "Real", "1", None, None, None, None, Z, "ball", "Spin-to-roll ratio at the inner race", None, False, None),
        Variable("ball[j].Q_cx", 2640, "Real", "N", None, None, None, None, Z, "ball", "Axial part of the ball's force on the cage pocket, both halves together", None, False, None),
        Variable("ball[j].x", 2800, "Real", "m", "um", None, None, None, Z, "pose", "Axial position of the ball's centre", None, False, None),
        Variable("ball[j].r", 2840, "Real", "m", "mm", None, None, None, Z, "pose", "Distance of the ball's centre from the axis", None, False, None),
        Variable("ball[j].psi", 2880, "Real", "rad", "deg", None, None, None, Z, "pose", "Azimuth of the ball from Y toward Z, unbounded", None, False, None),
        Variable("half_0.x", 2721, "Real", "m", "um", None, None, None, 1, "pose", "Displacement of the cage half on the -X side along X", None, False, None),
        Variable("half_0.y", 2722, "Real", "m", "um", None, None, None, 1, "pose", "Displacement of the cage half on the -X side along Y", None, False, None),
        Variable("half_0.z", 2723, "Real", "m", "um", None, None, None, 1, "pose", "Displacement of the cage half on the -X side along Z", None, False, None),
        Variable("half_0.tilt_y", 2724, "Real", "rad", "deg", None, None, None, 1, "pose", "Tilt of the cage half on the -X side about Y", None, False, None),
        Variable("half_0.tilt_z", 2725, "Real", "rad", "deg", None, None, None, 1, "pose", "Tilt of the cage half on the -X side about Z", None, False, None),
        Variable("half_0.psi", 2726, "Real", "rad", "deg", None, None, None, 1, "pose", "Rotation of the cage half on the -X side about its axis, unbounded: 0 has a pocket on Y", None, False, None),
        Variable("half_1.x", 2741, "Real", "m", "um", None, None, None, 1, "pose", "Displacement of the cage half on the +X side along X", None, False, None),
        Variable("half_1.y", 2742, "Real", "m", "um", None, None, None, 1, "pose", "Displacement of the cage half on the +X side along Y", None, False, None),
        Variable("half_1.z", 2743, "Real", "m", "um", None, None, None, 1, "pose", "Displacement of the cage half on the +X side along Z", None, False, None),
        Variable("half_1.tilt_y", 2744, "Real", "rad", "deg", None, None, None, 1, "pose", "Tilt of the cage half on the +X side about Y", None, False, None),
        Variable("half_1.tilt_z", 2745, "Real", "rad", "deg", None, None, None, 1, "pose", "Tilt of the cage half on the +X side about Z", None, False, None),
        Variable("half_1.psi", 2746, "Real", "rad", "deg", None, None, None, 1, "pose", "Rotation of the cage half on the +X side about its axis, unbounded: 0 has a pocket on Y", None, False, None),
        Variable("cage.dislocation", 2701, "Real", "m", "um", None, None, None, 1, "rivet", "Largest slip of one cage half against the other over the joints, in the plane; at an instant of a chaotic motion: compare stat.*", None, False, None),
        Variable("cage.omega", 2702, "Real", "rad/s", "rev/min", None, None, None, 1, "cage", "Speed of the cage (mean of the halves)", None, False, None),
        Variable("cage.slip_ratio", 2703, "Real", "1", None, None, None, None, 1, "cage", "1 - cage speed / epicyclic speed (0 at standstill)", None, False, None),
        Variable("cage.y", 2704, "Real", "m", "um", None, None, None, 1, "cage", "Displacement of the cage's centre along Y (mean of the halves)", None, False, None),
        Variable("cage.z", 2705, "Real", "m", "um", None, None, None, 1, "cage", "Displacement of the cage's centre along Z (mean of the halves)", None, False, None),
        Variable("cage.eccentricity", 2706, "Real", "1", None, None, None, None, 1, "cage", "Displacement of the cage's centre against the outer ring / radial guide clearance at rest (of a cage guided by balls: pocket clearance)", None, False, None),
        Variable("cage.F_pocket_max", 2707, "Real", "N", None, None, None, None, 1, "ball", "Largest pocket contact load of all balls; at an instant of a chaotic motion: compare stat.*", None, False, None),
        Variable("cage.F_pocket_peak", 2708, "Real", "N", None, None, None, None, 1, "peak", "Largest pocket contact load since the last communication point", None, False, None),
        Variable("rivet[k].sigma_head", 3000, "Real", "Pa", "MPa", None, None, None, Z, "stress", "Largest principal stress in the head fillet; at an instant of a chaotic motion: compare stat.*", None, False, None),
        Variable("rivet[k].sigma_mid", 3040, "Real", "Pa", "MPa", None, None, None, Z, "stress", "von Mises stress of the shank at the split (|z| <= 0.1 mm); at an instant of a chaotic motion: compare stat.*", None, False, None),
        Variable("rivet[k].sigma_head_vm", 3080, "Real", "Pa", "MPa", None, None, None, Z, "stress", "von Mises stress in the head fillet", None, False, None),
        Variable("rivet[k].sigma_mid_p1", 3120, "Real", "Pa", "MPa", None, None, None, Z, "stress", "Largest principal stress of the shank at the split", None, False, None),
        Variable("rivet[k].sigma_head_peak", 3160, "Real", "Pa", "MPa", None, None, None, Z, "peak", "Largest sigma_head since the last communication point", None, False, None),
        Variable("rivet[k].sigma_mid_peak", 3200, "Real", "Pa", "MPa", None, None, None, Z, "peak", "Largest sigma_mid since the last communication point", None, False, None),
        Variable("rivet.sigma_head_max", 3240, "Real", "Pa", "MPa", None, None, None, 1, "peak", "Largest sigma_head_peak of all rivets", None, False, None),
        Variable("rivet.sigma_mid_max", 3241, "Real", "Pa", "MPa", None, None, None, 1, "peak", "Largest sigma_mid_peak of all rivets", None, False, None),
        Variable("rivet.table_kind", 3242, "Real", "1", None, None, None, None, 1, "rivet", "What the rivets' stress table rests on: 1 finite elements, 2 coarse finite elements, 3 closed forms", None, False, None),
        Variable("rivet[k].damage_head", 3250, "Real", "1", None, None, None, None, Z, "fatigue", "Miner's sum of sigma_head since start.settle", None, False, None),
        Variable("rivet[k].damage_mid", 3290, "Real", "1", None, None, None, None, Z, "fatigue", "Miner's sum of sigma_mid since start.settle", None, False, None),
        Variable("rivet[k].broken", 8940, "Real", "1", None, None, None, None, Z, "fatigue", "0: the rivet holds; 1 broken in the head, 2 in the middle by its damage, 3 by rivet[k].intact = 0", None, False, None),
        Variable("rivet[k].break_time", 8980, "Real", "s", None, None, None, None, Z, "fatigue", "Time at which the rivet broke by its damage; -1 if it did not", None, False, None),
        Variable("rivet[k].preload_loss", 9020, "Real", "N", None, None, None, None, Z, "fatigue", "Preload lost by wear of plates and heads since the start (joint.wear)", None, False, None),
        Variable("rivet[k].N", 3330, "Real", "N", None, None, None, None, Z, "rivet", "External tension of the joint; at an instant of a chaotic motion: compare stat.*", None, False, None),
        Variable("rivet[k].V", 3370, "Real", "N", None, None, None, None, Z, "rivet", "Transverse load of the joint; at an instant of a chaotic motion: compare stat.*", None, False, None),
        Variable("rivet[k].T", 3410, "Real", "N", None, None, None, None, Z, "rivet", "Tension of the rivet, with preload and prying; at an instant of a chaotic motion: compare stat.*", None, False, None),
        Variable("rivet[k].M", 3450, "Real", "N.m", None, None, None, None, Z, "rivet", "Moment that the joint transmits; at an instant of a chaotic motion: compare stat.*", None, False, None),
        Variable("rivet[k].P", 3490, "Real", "N", None, None, None, None, Z, "rivet", "Preload at the present temperature", None, False, None),
        Variable("rivet[k].slip", 3530, "Real", "m", "um", None, None, None, Z, "rivet", "Slip of one half against the other at the joint, in the plane; at an instant of a chaotic motion: compare stat.*", None, False, None),
        Variable("rivet[k].flag", 3570, "Real", "1", None, None, None, None, Z, "stress", "Sum of 1 rivet yields, 2 flange yields, 8 fit beyond the stress table", None, False, None),
        Variable("rivet[k].V_y", 3610, "Real", "N", None, None, None, None, Z, "rivet", "Transverse load that the shank carries, on the +X half, along y of the cage's frame", None, False, None),
        Variable("rivet[k].V_z", 3650, "Real", "N", None, None, None, None, Z, "rivet", "Transverse load that the shank carries, on the +X half, along z of the cage's frame", None, False, None),
        Variable("rivet[k].M_y", 3690, "Real", "N.m", None, None, None, None, Z, "rivet", "Moment that the joint transmits, on the +X half about y of the cage's frame", None, False, None),
        Variable("rivet[k].M_z", 3730, "Real", "N.m", None, None, None, None, Z, "rivet", "Moment that the joint transmits, on the +X half about z of the cage's frame", None, False, None),
        Variable("rivet[k].F_head", 3770, "Real", "N", None, None, None, None, Z, "rivet", "Friction force at the heads", None, False, None),
        Variable("rivet[k].M_shank", 3810, "Real", "N.m", None, None, None, None, Z, "rivet", "Bending moment of the rivet's shank at the split", None, False, None),
        Variable("rivet[k].M_shank_y", 3850, "Real", "N.m", None, None, None, None, Z, "rivet", "Bending moment of the rivet's shank on the +X half about y of the cage's frame", None, False, None),
        Variable("rivet[k].M_shank_z", 3890, "Real", "N.m", None, None, None, None, Z, "rivet", "Bending moment of the rivet's shank on the +X half about z of the cage's frame", None, False, None),
        Variable("rivet[k].flex_0_x", 8700, "Real", "m", "um", None, None, None, Z, "pose", "Motion of the cage half on the -X side at the rivet along X by its vibration modes, against its rigid motion (0 unless scene.cage = elastic)", None, False, None),
        Variable("rivet[k].flex_0_r", 8740, "Real", "m", "um", None, None, None, Z, "pose", "Motion of the cage half on the -X side at the rivet away from the axis by its vibration modes, against its rigid motion (0 unless scene.cage = elastic)", None, False, None),
        Variable("rivet[k].flex_0_t", 8780, "Real", "m", "um", None, None, None, Z, "pose", "Motion of the cage half on the -X side at the rivet in the sense of psi by its vibration modes, against its rigid motion (0 unless scene.cage = elastic)", None, False, None),
        Variable("rivet[k].flex_1_x", 8820, "Real", "m", "um", None, None, None, Z, "pose", "Motion of the cage half on the +X side at the rivet along X by its vibration modes, against its rigid motion (0 unless scene.cage = elastic)", None, False, None),
        Variable("rivet[k].flex_1_r", 8860, "Real", "m", "um", None, None, None, Z, "pose", "Motion of the cage half on the +X side at the rivet away from the axis by its vibration modes, against its rigid motion (0 unless scene.cage = elastic)", None, False, None),
        Variable("rivet[k].flex_1_t", 8900, "Real", "m", "um", None, None, None, Z, "pose", "Motion of the cage half on the +X side at the rivet in the sense of psi by its vibration modes, against its rigid motion (0 unless scene.cage = elastic)", None, False, None),
        Variable("bearing.friction_torque", 4001, "Real", "N.m", None, None, None, None, 1, "ring", "Torque that the shaft must supply about X; mean over the communication step", None, False, None),
        Variable("bearing.power_loss", 4002, "Real", "W", None, None, None, None, 1, "energy", "Power dissipated in contacts, films, drag and joints", None, False, None),
        Variable("bearing.energy_residual", 4003, "Real", "J", None, None, None, None, 1, "energy", "Energy now - energy at start - bearing.energy_change - net work since: 0 but for the errors of the integration and of the work's own integral", None, False, None),
        Variable("bearing.energy_change", 4006, "Real", "J", None, None, None, None, 1, "energy", "Energy that changes of parameters have added to the bearing since the start; negative: released, as by a rivet that breaks", None, False, None),
        Variable("bearing.contacts", 4004, "Real", "1", None, None, None, None, 1, "ball", "Number of closed contacts (races and pockets)", None, False, None),
        Variable("bearing.penetration", 4005, "Real", "m", "um", None, None, None, 1, "ball", "Largest elastic approach of all contacts", None, False, None),
        Variable("bearing.clearance", 8110, "Real", "m", "um", None, None, None, 1, "ball", "Diametral clearance at the present speed, temperatures and fits", None, False, None),
        Variable("loss.races", 8101, "Real", "W", None, None, None, None, 1, "energy", "Power dissipated in the race contacts", None, False, None),
        Variable("loss.inlet", 8102, "Real", "W", None, None, None, None, 1, "energy", "Part of loss.races: rolling friction of the inlets", None, False, None),
        Variable("loss.spin", 8103, "Real", "W", None, None, None, None, 1, "energy", "Part of loss.races: spin of the balls about the contact normals (sliced traction)", None, False, None),
        Variable("loss.ball_drag", 8104, "Real", "W", None, None, None, None, 1, "energy", "Power dissipated by drag and churning of the balls in the mixture", None, False, None),
        Variable("loss.cage_drag", 8105, "Real", "W", None, None, None, None, 1, "energy", "Power dissipated by the drag of the cage in the mixture", None, False, None),
        Variable("loss.ring_drag", 8109, "Real", "W", None, None, None, None, 1, "energy", "Power that the inner ring dissipates by its friction on the mixture", None, False, None),
        Variable("loss.land", 8106, "Real", "W", None, None, None, None, 1, "energy", "Power dissipated between the lands and the outer ring", None, False, None),
        Variable("loss.pockets", 8107, "Real", "W", None, None, None, None, 1, "energy", "Power dissipated in the pockets", None, False, None),
        Variable("loss.joints", 8108, "Real", "W", None, None, None, None, 1, "energy", "Power dissipated in the joints of the cage", None, False, None),
        Variable("loss.modes", 8118, "Real", "W", None, None, None, None, 1, "energy", "Power dissipated by the vibration of elastic cage halves", None, False, None),
        Variable("stat.time", 5001, "Real", "s", None, None, None, None, 1, "stat", "Time that the statistics cover", None, False, None),
        Variable("stat.Q_c_mean", 5002, "Real", "N", None, None, None, None, 1, "stat", "Pocket force of all balls pooled: mean, zeros included", None, False, None),
        Variable("stat.Q_c_rms", 5003, "Real", "N", None, None, None, None, 1, "stat", "Pocket force of all balls pooled: RMS", None, False, None),
        Variable("stat.Q_c_p999", 5004, "Real", "N", None, None, None, None, 1, "stat", "Pocket force of all balls pooled: 99.9 % quantile", None, False, None),
        Variable("stat.Q_c_max", 5005, "Real", "N", None, None, None, None, 1, "stat", "Pocket force of all balls pooled: largest", None, False, None),
        Variable("stat.contact_duty", 5006, "Real", "1", None, None, None, None, 1, "stat", "Part of the time that a ball presses on its pocket, or on the oil in it", None, False, None),
        Variable("stat.cage_omega", 5007, "Real", "rad/s", "rev/min", None, None, None, 1, "stat", "Mean cage speed", None, False, None),
        Variable("stat.eccentricity", 5008, "Real", "1", None, None, None, None, 1, "stat", "Mean eccentricity of the cage", None, False, None),
        Variable("stat.dislocation_max", 5009, "Real", "m", "um", None, None, None, 1, "stat", "Largest dislocation of the cage halves", None, False, None),
        Variable("stat.sigma_head_mean", 5011, "Real", "Pa", "MPa", None, None, None, 1, "stat", "Head stress of the worst rivet at each instant: mean", None, False, None),
        Variable("stat.sigma_head_rms", 5012, "Real", "Pa", "MPa", None, None, None, 1, "stat", "Head stress of the worst rivet at each instant: RMS", None, False, None),
        Variable("stat.sigma_head_p999", 5013, "Real", "Pa", "MPa", None, None, None, 1, "stat", "Head stress of the worst rivet at each instant: 99.9 % quantile", None, False, None),
        Variable("stat.sigma_head_max", 5014, "Real", "Pa", "MPa", None, None, None, 1, "stat", "Head stress of the worst rivet at each instant: largest", None, False, None),
        Variable("stat.sigma_mid_mean", 5021, "Real", "Pa", "MPa", None, None, None, 1, "stat", "Middle stress of the worst rivet at each instant: mean", None, False, None),
        Variable("stat.sigma_mid_rms", 5022, "Real", "Pa", "MPa", None, None, None, 1, "stat", "Middle stress of the worst rivet at each instant: RMS", None, False, None),
        Variable("stat.sigma_mid_p999", 5023, "Real", "Pa", "MPa", None, None, None, 1, "stat", "Middle stress of the worst rivet at each instant: 99.9 % quantile", None, False, None),
        Variable("stat.sigma_mid_max", 5024, "Real", "Pa", "MPa", None, None, None, 1, "stat", "Middle stress of the worst rivet at each instant: largest", None, False, None),
        Variable("stat.rivet_head_mean[k]", 5100, "Real", "Pa", "MPa", None, None, None, Z, "stat", "Head stress of each rivet: mean", None, False, None),
        Variable("stat.rivet_head_rms[k]", 5140, "Real", "Pa", "MPa", None, None, None, Z, "stat", "Head stress of each rivet: RMS", None, False, None),
        Variable("stat.rivet_head_p999[k]", 5180, "Real", "Pa", "MPa", None, None, None, Z, "stat", "Head stress of each rivet: 99.9 % quantile", None, False, None),
        Variable("stat.rivet_head_max[k]", 5220, "Real", "Pa", "MPa", None, None, None, Z, "stat", "Head stress of each rivet: largest", None, False, None),
        Variable("stat.rivet_mid_mean[k]", 5300, "Real", "Pa", "MPa", None, None, None, Z, "stat", "Middle stress of each rivet: mean", None, False, None),
        Variable("stat.rivet_mid_rms[k]", 5340, "Real", "Pa", "MPa", None, None, None, Z, "stat", "Middle stress of each rivet: RMS", None, False, None),
        Variable("stat.rivet_mid_p999[k]", 5380, "Real", "Pa", "MPa", None, None, None, Z, "stat", "Middle stress of each rivet: 99.9 % quantile", None, False, None),
        Variable("stat.rivet_mid_max[k]", 5420, "Real", "Pa", "MPa", None, None, None, Z, "stat", "Middle stress of each rivet: largest", None, False, None),
        Variable("solver.steps", 6001, "Real", "1", None, None, None, None, 1, "solver", "Accepted internal steps", None, False, None),
        Variable("solver.rhs_evals", 6002, "Real", "1", None, None, None, None, 1, "solver", "Evaluations of the right-hand side", None, False, None),
        Variable("solver.step_size", 6003, "Real", "s", None, None, None, None, 1, "solver", "Internal step size that the next step starts with", None, False, None),
        Variable("solver.error_tests_failed", 6004, "Real", "1", None, None, None, None, 1, "solver", "Internal steps beyond the error test: rejected, or with solver.method = fixed taken nevertheless", None, False, None),
        Variable("solver.tolerance", 6006, "Real", "1", None, None, None, None, 1, "solver", "Tolerance in force", None, False, None),
        Variable("event.land_contact", 7001, "Real", "1", None, None, None, None, 1, "event", "Cage halves whose land touches the outer ring", None, False, None),
        Variable("event.pocket_exit", 7002, "Real", "1", None, None, None, None, 1, "event", "Balls whose centre has left the section of the cage: a real pocket ends there", None, False, None),
        Variable("event.ellipse_cut", 7003, "Real", "1", None, None, None, None, 1, "event", "Race contacts whose ellipse reaches over the shoulder", None, False, None),
        Variable("event.overpressure", 7004, "Real", "1", None, None, None, None, 1, "event", "Race contacts beyond bearing.p_limit", None, False, None),
        Variable("event.joint_open", 7005, "Real", "1", None, None, None, None, 1, "event", "Joints whose plates are apart", None, False, None),
        Variable("event.rivet_yield", 7006, "Real", "1", None, None, None, None, 1, "event", "Rivets whose sigma_head_peak or sigma_mid_peak exceeds the yield stress", None, False, None),
        Variable("event.rivet_overload", 7025, "Real", "1", None, None, None, None, 1, "event", "Rivets whose sigma_mid_peak exceeds fatigue.sigma_m", None, False, None),
        Variable("event.no_clearance", 7007, "Real", "1", None, None, None, None, 1, "event", "1 if speed, temperatures and fits leave the bearing no clearance (bearing.clearance < 0)", None, False, None),
        Variable("event.rivet_break", 7010, "Real", "1", None, None, None, None, 1, "event", "Rivets that broke by their damage in the last communication step", None, False, None),
        Variable("event.step_too_long", 7009, "Real", "1", None, None, None, None, 1, "event", "1 if the errors of the steps of solver.method = fixed are so large over 10 ms that the results may be wrong", None, False, None),
        Variable("event.motion_lag", 7008, "Real", "1", None, None, None, None, 1, "event", "Given motions that jumped or contradicted their velocity and are caught up with over more than the last step", None, False, None),
        Variable("event.cage_yield", 7021, "Real", "1", None, None, None, None, 1, "event", "1 if cage.F_pocket_peak exceeds the force under which a half of a ribbon cage begins to yield", None, False, None),
        Variable("event.energy_off", 7023, "Real", "1", None, None, None, None, 1, "event", "1 if bearing.energy_residual passes 2 % of the energy lost", None, False, None),
        Variable("event.land_contact_onsets", 7011, "Real", "1", None, None, None, None, 1, "event", "Onsets of land contact since the start", None, False, None),
        Variable("event.pocket_exit_onsets", 7012, "Real", "1", None, None, None, None, 1, "event", "Onsets of a ball leaving its pocket since the start", None, False, None),
        Variable("event.ellipse_cut_onsets", 7013, "Real", "1", None, None, None, None, 1, "event", "Onsets of a contact ellipse cut by the shoulder since the start", None, False, None),
        Variable("event.overpressure_onsets", 7014, "Real", "1", None, None, None, None, 1, "event", "Onsets of a contact beyond bearing.p_limit since the start", None, False, None),
        Variable("event.joint_open_onsets", 7015, "Real", "1", None, None, None, None, 1, "event", "Onsets of an open joint since the start", None, False, None),
        Variable("event.rivet_yield_onsets", 7016, "Real", "1", None, None, None, None, 1, "event", "Onsets of yield of a rivet since the start", None, False, None),
        Variable("event.rivet_overload_onsets", 7026, "Real", "1", None, None, None, None, 1, "event", "Onsets of event.rivet_overload since the start", None, False, None),
        Variable("event.step_too_long_onsets", 7019, "Real", "1", None, None, None, None, 1, "event", "Onsets of steps that are too long since the start", None, False, None),
        Variable("event.no_clearance_onsets", 7017, "Real", "1", None, None, None, None, 1, "event", "Onsets of a closed clearance since the start", None, False, None),
        Variable("event.rivet_break_onsets", 7020, "Real", "1", None, None, None, None, 1, "event", "Communication steps since the start in which a rivet broke by its damage", None, False, None),
        Variable("event.motion_lag_onsets", 7018, "Real", "1", None, None, None, None, 1, "event", "Onsets of catching up with a given motion since the start", None, False, None),
        Variable("event.energy_off_onsets", 7024, "Real", "1", None, None, None, None, 1, "event", "Onsets of event.energy_off since the start", None, False, None),
        Variable("event.cage_yield_onsets", 7022, "Real", "1", None, None, None, None, 1, "event", "Onsets of yield of a ribbon cage since the start", None, False, None),
        Variable("solver.method_used", 6007, "Real", "1", None, None, None, None, 1, "solver", "Integration method in use: 1 velocity Verlet, 2 Runge-Kutta, 3 velocity Verlet with fixed steps", None, False, None),
    )
}

LOCALS = {
    v.name: v
    for v in (
        Variable("solver.cpu_time", 6005, "Real", "s", None, None, None, None, 1, "solver", "Processor time of this instance inside fmi2DoStep, from its creation on, with solver.clock = on, else 0 (not part of the saved state)", None, False, None),
    )
}

# The state vector y: slices of its blocks and the class of their error scale.
BALL_X = slice(0, 9)  # m  Axial position of the ball
BALL_R = slice(9, 18)  # m  Radial position
BALL_THETA = slice(18, 27)  # rad  Azimuth from Y toward Z, unbounded
CAGE_X = slice(27, 29)  # m  Position of a half's centre of mass along X
CAGE_Y = slice(29, 31)  # m  along Y
CAGE_Z = slice(31, 33)  # m  along Z
CAGE_BETA = slice(33, 35)  # 1  Axis of the half a = (a_x, gamma, -beta): direction cosine
CAGE_GAMMA = slice(35, 37)  # 1  Axis of the half: direction cosine
CAGE_PSI = slice(37, 39)  # rad  Rotation of the half about its axis, unbounded
RING_X = slice(39, 40)  # m  Inner ring: position along X
RING_Y = slice(40, 41)  # m  along Y
RING_Z = slice(41, 42)  # m  along Z
RING_BETA = slice(42, 43)  # 1  Axis of the ring a = (a_x, gamma, -beta): direction cosine
RING_GAMMA = slice(43, 44)  # 1  Axis of the ring: direction cosine
JOINT_PLATE_Y = slice(44, 53)  # m  Friction state of the plates, y of the cage frame
JOINT_PLATE_Z = slice(53, 62)  # m  Friction state of the plates, z of the cage frame
JOINT_HEAD_Y = slice(62, 71)  # m  Friction state of the rivet heads, y of the cage frame
JOINT_HEAD_Z = slice(71, 80)  # m  Friction state of the rivet heads, z of the cage frame
WORK = slice(80, 81)  # J  Net work done on balls and cage since the start: supplied - dissipated
BALL_V_X = slice(81, 90)  # m/s  Axial velocity
BALL_V_R = slice(90, 99)  # m/s  Radial velocity
BALL_OMEGA_M = slice(99, 108)  # rad/s  Orbital speed
CAGE_V_X = slice(108, 110)  # m/s  Velocity of the half's centre of mass along X
CAGE_V_Y = slice(110, 112)  # m/s  along Y
CAGE_V_Z = slice(112, 114)  # m/s  along Z
CAGE_BETA_DOT = slice(114, 116)  # 1/s  Rate of beta
CAGE_GAMMA_DOT = slice(116, 118)  # 1/s  Rate of gamma
CAGE_S = slice(118, 120)  # rad/s  Spin: angular velocity along the half's axis
RING_V_X = slice(120, 121)  # m/s  Inner ring: velocity along X
RING_V_Y = slice(121, 122)  # m/s  along Y
RING_V_Z = slice(122, 123)  # m/s  along Z
RING_BETA_DOT = slice(123, 124)  # 1/s  Rate of beta
RING_GAMMA_DOT = slice(124, 125)  # 1/s  Rate of gamma
BALL_OMEGA_X = slice(125, 134)  # rad/s  Angular velocity about X
BALL_OMEGA_R = slice(134, 143)  # rad/s  Angular velocity about the radial direction of the ball
BALL_OMEGA_T = slice(143, 152)  # rad/s  Angular velocity about the tangential direction of the ball
MODE_S = slice(152, 192)  # m  Mirrored motion of the halves: modal coordinates
MODE_D = slice(192, 232)  # m  Opposed motion of the halves: modal coordinates
MODE_S_DOT = slice(232, 272)  # m/s  Their rates, mirrored
MODE_D_DOT = slice(272, 312)  # m/s  and opposed
N_STATES = 152
N_ALL_STATES = 312  # with those of elastic cage halves
STATE_SCALES = {
    "ball_x": "length",
    "ball_r": "length",
    "ball_theta": "angle",
    "cage_x": "length",
    "cage_y": "length",
    "cage_z": "length",
    "cage_beta": "tilt",
    "cage_gamma": "tilt",
    "cage_psi": "angle",
    "ring_x": "length",
    "ring_y": "length",
    "ring_z": "length",
    "ring_beta": "tilt",
    "ring_gamma": "tilt",
    "joint_plate_y": "plate",
    "joint_plate_z": "plate",
    "joint_head_y": "head",
    "joint_head_z": "head",
    "work": "energy",
    "ball_v_x": "velocity",
    "ball_v_r": "normal",
    "ball_omega_m": "orbit",
    "cage_v_x": "velocity",
    "cage_v_y": "velocity",
    "cage_v_z": "velocity",
    "cage_beta_dot": "rate",
    "cage_gamma_dot": "rate",
    "cage_s": "rate",
    "ring_v_x": "velocity",
    "ring_v_y": "velocity",
    "ring_v_z": "velocity",
    "ring_beta_dot": "rate",
    "ring_gamma_dot": "rate",
    "ball_omega_x": "spin",
    "ball_omega_r": "spin",
    "ball_omega_t": "spin",
}
STATE_SLICES = {name: globals()[name.upper()] for name in STATE_SCALES}
ELASTIC_SCALES = {
    "mode_s": "length",
    "mode_d": "length",
    "mode_s_dot": "mode",
    "mode_d_dot": "mode",
}
