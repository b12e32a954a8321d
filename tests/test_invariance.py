"""Symmetries: a turn by one pitch, mirror images, other units."""

import numpy as np
import pytest
from library import TWO_HALF
from mechanics import SLICE, Instance, Z, pocket_loads, running_state, view

from bearing_model.cage.elastic.elastic_half import mode_order
from bearing_model.generated import variables
from bearing_model.generated.variables import (
    MODE_D,
    MODE_D_DOT,
    MODE_S,
    MODE_S_DOT,
    N_STATES,
    CageModel,
    Lubrication,
    Switch,
    TiltMode,
    Traction,
)
from bearing_model.physics.derived import default_table
from bearing_model.physics.model import Model

TWINS = True
POLAR = ("F_y", "F_z"), ("M_y", "M_z"), ("tilt_y", "tilt_z")
INPUTS = {
    "shaft.F_x": 515.0,
    "shaft.F_y": 2994.0,
    "shaft.F_z": -400.0,
    "shaft.M_y": 3.0,
    "shaft.M_z": -2.0,
    "shaft.tilt_y": 1e-3,
    "shaft.tilt_z": 2e-3,
}
INPUTS |= {"shaft.omega": 1909.8788938, "impact.F_r": 70.0, "impact.F_a": -30.0}
SCENES = [
    {"scene.cage": CageModel.TWO_HALF, "scene.traction": Traction.POINT, "scene.lubrication": Lubrication.FILM},
    {"scene.cage": CageModel.TWO_HALF, "scene.traction": Traction.SLICED, "scene.lubrication": Lubrication.MIXED},
    {"scene.cage": CageModel.TWO_HALF, "scene.traction": Traction.POINT, "scene.lubrication": Lubrication.MIXED},
]
SUPPORTED = {"ring.tilt_mode": TiltMode.SUPPORTED, "gravity.y": -9.81, "gravity.z": 3.0}
SPALLS = {  # of some balls, some at the outer contact and some at the inner one
    "ball[j].spall_angle": np.array([0.15 * (j - 4) + (0.0, np.pi)[j % 2] for j in range(Z)]),
    "ball[j].spall_length": np.where(np.arange(Z) % 4 == 3, 0.0, np.linspace(4e-3, 7e-3, Z)),
    "ball[j].spall_width": np.where(np.arange(Z) % 4 == 3, 0.0, np.linspace(5e-4, 6e-3, Z)),
    "ball[j].spall_depth": np.where(np.arange(Z) % 4 == 3, 0.0, np.linspace(1e-5, 1e-4, Z)),
}


def spalls_of(image):
    """Parameters of the spalls of balls that have changed places."""
    return {name: image(name, value).tolist() for name, value in SPALLS.items()}


def difference(a, b):
    """Largest difference of each block of the state over the block's largest member, all blocks."""
    worst = 0.0
    for place in SLICE.values():
        scale = max(np.abs(a[place]).max(), np.abs(b[place]).max())
        worst = max(worst, np.abs(a[place] - b[place]).max() / scale if scale > 0.0 else 0.0)
    return worst


def blocks(y):
    return {name: y[place].copy() for name, place in SLICE.items()}


def joined(part):
    y = np.empty(variables.N_STATES)
    for name, place in SLICE.items():
        y[place] = part[name]
    return y


# ----------------------------------------------------------------------------------------------------------------- turn


def rotated(part, names, angle):
    c, s = np.cos(angle), np.sin(angle)
    y, z = part[names[0]], part[names[1]]
    part[names[0]], part[names[1]] = c * y - s * z, s * y + c * z


def turned(y, n, rate=False):
    """The state turned about X by n pitches: ball j becomes ball j + n, rivet k rivet k + n; the halves' rotation psi
    stays.
    """
    angle = 2.0 * np.pi * n / Z
    part = blocks(y)
    for name in part:
        if name.startswith(("ball", "joint")):
            part[name] = np.roll(part[name], n)
    if not rate:
        part["ball_theta"] += angle
    for body in ("cage", "ring"):
        rotated(part, (f"{body}_y", f"{body}_z"), angle)
        rotated(part, (f"{body}_v_y", f"{body}_v_z"), angle)
        rotated(part, (f"{body}_beta", f"{body}_gamma"), angle)  # the tilt (0, beta, gamma) is a vector
        rotated(part, (f"{body}_beta_dot", f"{body}_gamma_dot"), angle)
    for kind in ("plate", "head"):
        rotated(part, (f"joint_{kind}_y", f"joint_{kind}_z"), angle)
    return joined(part)


@pytest.mark.parametrize("scene", SCENES, ids=["film", "sliced mixed", "mixed"])
@pytest.mark.parametrize("n", [1, 4])
def test_turn_by_a_pitch(core, scene, n, record_property):
    """Loads, gravity, tilts and all states turned: dy/dt turns with them; observed 1e-11 (rounding of places over
    approaches).
    """
    angle = 2.0 * np.pi * n / Z
    outer = dict(INPUTS)
    for pair in POLAR:
        names = [f"shaft.{name}" for name in pair]
        rotated(outer, names, angle)
    gravity = {"gravity.y": -9.81, "gravity.z": 3.0}
    rotated(gravity, ("gravity.y", "gravity.z"), angle)
    spalls = spalls_of(lambda _, value: value), spalls_of(lambda _, value: np.roll(value, n))
    here = core.model(parameters=scene | SUPPORTED | spalls[0], inputs=INPUTS)
    there = core.model(parameters=scene | SUPPORTED | gravity | spalls[1], inputs=outer)
    for j in range(Z):
        here.p.ball.dD[j] = there.p.ball.dD[(j + n) % Z] = 1e-7 * (j - 4)
    for model in (here, there):
        core.lib.model_derive(model.p, model.d)
    rng, worst = np.random.default_rng(1), 0.0
    for _ in range(10):
        y = running_state(here, rng)
        rate, image = here.rhs(0.0, y), there.rhs(0.0, turned(y, n))
        assert pocket_loads(here).max() > 0.0
        worst = max(worst, difference(turned(rate, n, rate=True), image))
    record_property("difference", float(worst))
    assert worst < 1e-8


# --------------------------------------------------------------------------------------------------------------- mirror


def mirrored_z(y):
    """The mirror image in the plane z = 0: rotation about X is reversed, ball j becomes ball -j, rivet k rivet -1 - k."""
    part = blocks(y)
    for name in part:
        if name.startswith("ball"):
            part[name] = np.roll(part[name][::-1], 1)
        elif name.startswith("joint"):
            part[name] = part[name][::-1]
    odd = "ball_theta ball_omega_m ball_omega_x ball_omega_r joint_plate_z joint_head_z cage_z cage_v_z cage_beta cage_beta_dot cage_psi cage_s".split()
    odd += "ring_z ring_v_z ring_beta ring_beta_dot".split()
    for name in odd:
        part[name] = -part[name]
    return joined(part)


@pytest.mark.parametrize("scene", SCENES, ids=["film", "sliced mixed", "mixed"])
def test_mirror_z(core, scene, record_property):
    """The image in z = 0, rotation reversed: dy/dt is mirrored; observed 1e-11."""
    odd = ("shaft.F_z", "shaft.M_y", "shaft.tilt_y", "shaft.omega")
    image_inputs = {name: -value if name in odd else value for name, value in INPUTS.items()}

    def image(name, value):  # the other way round
        return np.roll((-value if name.endswith("angle") else value)[::-1], 1)

    spalls = spalls_of(lambda _, value: value), spalls_of(image)
    here = core.model(parameters=scene | SUPPORTED | spalls[0], inputs=INPUTS)
    there = core.model(parameters=scene | SUPPORTED | {"gravity.z": -3.0} | spalls[1], inputs=image_inputs)
    rng, worst = np.random.default_rng(2), 0.0
    for _ in range(10):
        y = running_state(here, rng)
        worst = max(worst, difference(mirrored_z(here.rhs(0.0, y)), there.rhs(0.0, mirrored_z(y))))
    record_property("difference", float(worst))
    assert worst < 1e-8


def mirrored_x(y):
    """The mirror image in the plane x = 0: the halves change places."""
    part = blocks(y)
    for name in part:
        if name.startswith("cage"):
            part[name] = part[name][::-1]
    odd = "ball_x ball_v_x ball_omega_r ball_omega_t cage_x cage_v_x ring_x ring_v_x".split()
    odd += [f"{body}_{name}" for body in ("cage", "ring") for name in ("beta", "gamma", "beta_dot", "gamma_dot")]
    for name in odd:
        part[name] = -part[name]
    return joined(part)


@pytest.mark.parametrize("scene", SCENES, ids=["film", "sliced mixed", "mixed"])
def test_mirror_x(core, scene, record_property):
    """The image in x = 0, the halves change places, stuck to each other (joint offsets are described in the frame of
    half 0); observed 1e-11.
    """
    odd = ("shaft.F_x", "shaft.M_y", "shaft.M_z", "shaft.tilt_y", "shaft.tilt_z", "impact.F_a")
    image_inputs = {name: -value if name in odd else value for name, value in INPUTS.items()}
    spalls = spalls_of(lambda _, value: value)
    here = core.model(parameters=scene | SUPPORTED | spalls, inputs=INPUTS)
    there = core.model(parameters=scene | SUPPORTED | spalls, inputs=image_inputs)
    rng, worst = np.random.default_rng(3), 0.0
    for _ in range(10):
        y = running_state(here, rng, stuck=True)
        for name in ("plate_y", "plate_z", "head_y", "head_z"):
            y[SLICE[f"joint_{name}"]] = 0.0
        rate, image = here.rhs(0.0, y), there.rhs(0.0, mirrored_x(y))
        for part in (rate, image):  # rates of friction: rounding of velocities that cancel
            assert (
                max(np.abs(part[SLICE[f"joint_{name}"]]).max() for name in ("plate_y", "plate_z", "head_y", "head_z"))
                < 1e-12
            )
            for name in ("plate_y", "plate_z", "head_y", "head_z"):
                part[SLICE[f"joint_{name}"]] = 0.0
        worst = max(worst, difference(mirrored_x(rate), image))
    record_property("difference", float(worst))
    assert worst < 1e-8


# ------------------------------------------------------------------------------------------------- both, elastic halves

MODE_BLOCKS = MODE_S, MODE_D, MODE_S_DOT, MODE_D_DOT


def modal_image(y, image, act):
    """The state whose rigid part is `image` and whose modes are act(a - i b, harmonic): a mode of a pair or alone has
    the coordinates a (cos) and b (sin).
    """
    modes = default_table().modes
    _, entry, part = mode_order(modes)
    n, is_b, alone = modes.harmonic[entry], part > 0.0, modes.parity[entry] != 0
    z = np.concatenate([image, np.zeros(len(y) - N_STATES)])
    for block in MODE_BLOCKS:
        q = y[block][: len(n)]
        u = act(np.where(is_b, -1j * q, q), n)
        of_a, of_b = u.real, -u.imag  # what a coordinate gives to a and b of its pair
        first, second = np.flatnonzero(~alone & ~is_b), np.flatnonzero(~alone & is_b)
        new = np.where(is_b, of_b, of_a)
        new[first] += of_a[second]
        new[second] += of_b[first]
        z[block][: len(n)] = new
    return z


def modal_difference(a, b):
    """As `difference`, modes included."""
    worst = difference(a[:N_STATES], b[:N_STATES])
    return max(worst, *(np.abs(a[rows] - b[rows]).max() / np.abs(b[rows]).max() for rows in MODE_BLOCKS))


@pytest.mark.parametrize("n", [1, 4])
def test_turn_of_elastic_halves(core, n, record_property):
    """As test_turn_by_a_pitch; waves go on by n pitches: (a - i b) exp(-i m n alpha), m the harmonic; observed 3e-11."""
    angle, elastic = 2.0 * np.pi * n / Z, {"scene.cage": CageModel.ELASTIC} | SUPPORTED
    outer, gravity = dict(INPUTS), {"gravity.y": -9.81, "gravity.z": 3.0}
    for pair in POLAR:
        rotated(outer, [f"shaft.{name}" for name in pair], angle)
    rotated(gravity, ("gravity.y", "gravity.z"), angle)
    here, there = core.model(parameters=elastic, inputs=INPUTS), core.model(parameters=elastic | gravity, inputs=outer)
    rng, worst = np.random.default_rng(4), 0.0

    def image(y, rate):
        return modal_image(y, turned(y[:N_STATES], n, rate), lambda u, m: u * np.exp(-1j * m * angle))

    for _ in range(5):
        y = running_state(here, rng)
        rate, there_rate = here.rhs(0.0, y), there.rhs(0.0, image(y, False))
        assert pocket_loads(here).max() > 0.0
        worst = max(worst, modal_difference(image(rate, True), there_rate))
    record_property("difference", float(worst))
    assert worst < 1e-8


def test_mirror_of_elastic_halves(core, record_property):
    """As test_mirror_z; a wave's cosine stays, its sine changes sign: (a - i b) becomes a + i b; observed 2e-10."""
    odd = ("shaft.F_z", "shaft.M_y", "shaft.tilt_y", "shaft.omega")
    image_inputs = {name: -value if name in odd else value for name, value in INPUTS.items()}
    elastic = {"scene.cage": CageModel.ELASTIC} | SUPPORTED
    here, there = (
        core.model(parameters=elastic, inputs=INPUTS),
        core.model(parameters=elastic | {"gravity.z": -3.0}, inputs=image_inputs),
    )
    rng, worst = np.random.default_rng(5), 0.0

    def image(y):
        return modal_image(y, mirrored_z(y[:N_STATES]), lambda u, m: np.conj(u))

    for _ in range(5):
        y = running_state(here, rng)
        worst = max(worst, modal_difference(image(here.rhs(0.0, y)), there.rhs(0.0, image(y))))
    record_property("difference", float(worst))
    assert worst < 1e-8


# ---------------------------------------------------------------------------------------------------------------- units

LENGTH, TIME = 1.7, 0.6  # the new units; the unit of force stays, as one load of 1 N is a constant of the model
DIMENSION = {"m": (1, 0, 0), "kg": (0, 1, 0), "s": (0, 0, 1), "N": (1, 1, -2), "Pa": (-1, 1, -2), "W": (2, 1, -3)}
DIMENSION |= dict.fromkeys(("rad", "1", "K"), (0, 0, 0))
STATE_UNITS = {
    "length": "m",
    "angle": "rad",
    "velocity": "m/s",
    "normal": "m/s",
    "orbit": "rad/s",
    "rate": "rad/s",
    "spin": "rad/s",
}
STATE_UNITS |= {"plate": "m", "head": "m", "tilt": "1", "energy": "N.m"}


def factor(unit):
    """Number by which a value grows in the new units, from the unit's name such as N.s/m or kg/m3."""
    above, _, below = unit.partition("/")
    powers = np.zeros(3)
    for text, sign in ((above, 1.0), (below, -1.0)):
        for symbol in filter(None, text.split(".")) if "1.5" not in text else [text]:
            name = symbol.rstrip("0123456789.-")
            if symbol == "1":
                continue
            exponent = float(symbol[len(name) :] or 1.0)
            powers += sign * exponent * np.array(DIMENSION[name], float)
    mass = TIME**2 / LENGTH
    return LENGTH ** powers[0] * mass ** powers[1] * TIME ** powers[2]


def test_reading_units():
    assert factor("m") == LENGTH
    assert factor("N") == pytest.approx(1.0, rel=1e-15)
    assert factor("kg/m3") == pytest.approx(TIME**2 / LENGTH**4, rel=1e-15)
    assert factor("N/m1.5") == pytest.approx(LENGTH**-1.5, rel=1e-15)
    assert factor("N.s/m") == pytest.approx(TIME / LENGTH, rel=1e-15)


@pytest.mark.c_only
@pytest.mark.parametrize("scene", SCENES, ids=["film", "sliced mixed", "mixed"])
def test_other_units(core, scene, record_property):
    """Every parameter, input and state in other units of length, time and mass: dy/dt follows.  No hidden constant has
    a dimension but Q_FLOOR = 1 N.

    Heating and starvation of the inlets are off: SKF's formulas hold in r/min, mm and mm2/s.  The cage's centrifugal
    load is off: it stands in the rivet table.

    The joint's stiffnesses come from the rivet table in SI and are converted here; loads by the lands' films are the
    table's at the land's place.  Observed 1e-11.
    """
    parameters = scene | SUPPORTED | {"scene.heating": Switch.OFF, "oil.K_rs": 0.0, "cage.centrifugal": Switch.OFF}
    here = core.model(parameters=parameters, inputs=INPUTS)
    scaled = {}
    for name, variable in variables.PARAMETERS.items():
        if variable.type == "Real" and variable.count == 1 and variable.unit != "K":
            scaled[name] = parameters.get(name, variable.start) * factor(variable.unit)
    inputs = {
        name: INPUTS.get(name, variable.start) * factor(variable.unit) for name, variable in variables.INPUTS.items()
    }
    there = core.model(parameters=parameters | scaled, inputs=inputs)
    for name in ("k_rivet", "k_plate", "k_plate_t", "k_head"):
        setattr(there.d, name, getattr(here.d, name) * factor("N/m"))
    there.d.c_joint = here.d.c_joint * factor("N.s/m")
    there.d.land_path = here.d.land_path
    for name, unit in (("k_hole", "N/m"), ("hole_gap", "m")):
        view(core, getattr(there.d, name))[:] = view(core, getattr(here.d, name)) * factor(unit)
    for name in ("rivet_y", "rivet_z"):
        view(core, getattr(there.d, name))[:] *= factor("m")
    units = np.empty(variables.N_STATES)
    for name, place in SLICE.items():
        units[place] = factor(STATE_UNITS[variables.STATE_SCALES[name]])
        if name.endswith(("beta_dot", "gamma_dot")):
            units[place] = factor("1/s")
    rng, worst = np.random.default_rng(4), 0.0
    for _ in range(10):
        y = running_state(here, rng)
        rate, image = here.rhs(0.0, y), there.rhs(0.0, y * units)
        worst = max(worst, difference(rate, image / units * TIME))
    record_property("difference", float(worst))
    assert worst < 1e-8


# --------------------------------------------------------------------------------------------------------- trajectories


def image_of(kind):
    """Inputs of a run and of its image, and the image of its state."""
    load = {"shaft.F_x": 515.0, "shaft.F_y": 2994.0, "shaft.F_z": 700.0, "shaft.tilt_y": 1e-3, "shaft.tilt_z": 2e-3}
    if kind == "mirror":
        odd = ("shaft.F_z", "shaft.tilt_y", "shaft.omega")
        return (
            load,
            {
                name: -value if name in odd else value
                for name, value in (load | {"shaft.omega": 18238.0 * np.pi / 30.0}).items()
            },
            mirrored_z,
        )
    other = dict(load)
    rotated(other, ("shaft.F_y", "shaft.F_z"), 2.0 * np.pi / Z)
    rotated(other, ("shaft.tilt_y", "shaft.tilt_z"), 2.0 * np.pi / Z)
    return load, other, lambda y: turned(y, 1)


@pytest.mark.c_only
@pytest.mark.parametrize("kind", ["turn", "mirror"])
def test_trajectory_of_the_image(core, kind, record_property):
    """1 ms from the start in a tight cage: the turned or mirrored loads give the turned or mirrored motion.

    Rounding (1e-12 of the places' scale) grows by contacts and chaos; observed 5e-6 of the error scales.
    """
    here, there, image = image_of(kind)
    parameters = {"start.spacing": 0.0, "cage.pocket_clearance": 5e-5, "ring.tilt_mode": TiltMode.SUPPORTED}
    y, y_image = (Instance(core, parameters, inputs, tolerance=1e-6).step(1e-3).y for inputs in (here, there))
    scale = Model.of(TWO_HALF | parameters).d.scale
    apart = image(y) - y_image
    apart[SLICE["ball_theta"]] -= 2.0 * np.pi * np.round(apart[SLICE["ball_theta"]] / (2.0 * np.pi))
    error = np.max(np.abs(apart) / scale)
    record_property("difference", float(error))
    assert error < 1e-4  # 100 tolerances: the integration's own error (test_twin.py)
    assert np.abs(image(y) - y).max() > 1.0  # the image is another motion
