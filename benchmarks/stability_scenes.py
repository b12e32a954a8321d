"""The scenes of stability.py: conditions at and beyond a bearing's limits, family by family, and random ones.

A scene is plain data: parameters and inputs by full variable name in SI, inputs as a number or as points [(t, value),
...] that are joined by straight lines or, with hold, by steps.
"""

import itertools
import math
from dataclasses import dataclass, field

import numpy as np

RPM = math.pi / 30.0
WORKING = 18238.0 * RPM
F_RADIAL, F_AXIAL = 2994.0, 515.0
MIXED = {"scene.lubrication": 2}
SUPPORTED, FREE = {"ring.tilt_mode": 2}, {"ring.tilt_mode": 3}


@dataclass(frozen=True)
class Scene:
    family: str
    name: str
    parameters: dict = field(default_factory=dict)
    inputs: dict = field(default_factory=dict)
    hold: bool = False  # inputs step at their points
    t_end: float = 0.01  # [s]
    step: float = 1e-4  # communication step [s]
    tolerance: float | None = None
    bearing: str = "6207"
    expected: str = "run"  # or "refused"

    @property
    def admissible(self):
        """Whether the limit of the run time applies: default tolerance, communication steps of at least 10 us."""
        return self.expected == "run" and self.tolerance is None and self.step >= 1e-5


def speeds():
    for rpm, sign, mixed in itertools.product(
        (0, 1e-3, 1, 30, 300, 1500, 4000, 10000, 18238, 30000, 40000), (1, -1), (False, True)
    ):
        if rpm == 0 and sign < 0:
            continue
        yield Scene(
            "speed",
            f"{sign * rpm:g} r/min{', mixed' * mixed}",
            MIXED if mixed else {},
            {"shaft.omega": sign * rpm * RPM},
        )


def ramps():
    ends = {"start": (0, 40000), "stop": (18238, 0), "reversal": (18238, -18238), "overrun": (40000, 18238)}
    for (name, (a, b)), duration, mixed in itertools.product(ends.items(), (1e-3, 5e-3, 2e-2), (False, True)):
        points = [(1e-3, a * RPM), (1e-3 + duration, b * RPM)]
        yield Scene(
            "ramp",
            f"{name} in {duration * 1e3:g} ms{', mixed' * mixed}",
            MIXED if mixed else {},
            {"shaft.omega": points},
            t_end=duration + 4e-3,
        )


def loads():
    directions = {"radial": (1, 0), "axial": (0, 1), "both": (1, 1)}
    for factor, sign, (name, (r, a)) in itertools.product((0, 1e-3, 0.1, 1, 3, 10), (1, -1), directions.items()):
        if factor == 0 and (sign < 0 or name != "both"):
            continue
        yield Scene(
            "load",
            f"{name} {sign * factor:g}x",
            {},
            {"shaft.F_y": sign * factor * r * F_RADIAL, "shaft.F_x": sign * factor * a * F_AXIAL},
        )
    for moment, mode in itertools.product((1, 20, -20, 100), (SUPPORTED, FREE)):
        yield Scene(
            "load", f"moment {moment} N.m, tilt mode {mode['ring.tilt_mode']}", mode, {"shaft.M_z": float(moment)}
        )


def jumps():
    pairs = {
        "start from rest": {"shaft.omega": (0, WORKING)},
        "to 40,000 r/min": {"shaft.omega": (0, 40000 * RPM)},
        "stop": {"shaft.omega": (WORKING, 0)},
        "reversal": {"shaft.omega": (WORKING, -WORKING)},
        "load on": {"shaft.F_y": (0, F_RADIAL), "shaft.F_x": (0, F_AXIAL)},
        "load off": {"shaft.F_y": (F_RADIAL, 0), "shaft.F_x": (F_AXIAL, 0)},
        "load 10x": {"shaft.F_y": (F_RADIAL, 10 * F_RADIAL), "shaft.F_x": (F_AXIAL, 10 * F_AXIAL)},
        "load reversed": {"shaft.F_y": (F_RADIAL, -F_RADIAL), "shaft.F_x": (F_AXIAL, -F_AXIAL)},
        "load turned": {"shaft.F_y": (F_RADIAL, 0), "shaft.F_z": (0, F_RADIAL)},
        "tilt 0.3 deg": {"shaft.tilt_z": (0, math.radians(0.3))},
        "tilt reversed": {"shaft.tilt_y": (math.radians(0.2), -math.radians(0.2))},
        "everything": {
            "shaft.omega": (WORKING, -WORKING),
            "shaft.F_y": (F_RADIAL, -F_RADIAL),
            "shaft.F_x": (F_AXIAL, -3 * F_AXIAL),
            "shaft.tilt_z": (0, 3e-3),
        },
    }
    for (name, changes), mixed in itertools.product(pairs.items(), (False, True)):
        inputs = {key: [(0.0, a), (2e-3, b)] for key, (a, b) in changes.items()}
        yield Scene("jump", name + ", mixed" * mixed, MIXED if mixed else {}, inputs, hold=True)
    for step in (1e-5, 1e-4):
        times = np.arange(0.0, 4e-3, step)
        inputs = {
            "shaft.F_y": [(t, F_RADIAL * (-1) ** i) for i, t in enumerate(times)],
            "shaft.omega": [(t, WORKING * (i % 2)) for i, t in enumerate(times)],
        }
        yield Scene(
            "jump", f"load and speed at every step of {step * 1e6:g} us", {}, inputs, hold=True, step=step, t_end=4e-3
        )


def impacts():
    for force, duration, (name, r, a) in itertools.product(
        (1401.0, 5e3, 2e4), (1e-5, 1e-4, 1e-3), (("radial", 1, 0), ("axial", 0, 1), ("both", 1, 1), ("against", -1, -1))
    ):
        interval = max(10 * duration, 1e-3)
        train = {"pulse.F_r": r * force, "pulse.F_a": a * force, "pulse.duration": duration, "pulse.interval": interval}
        train |= {"pulse.count": 1000, "pulse.t_start": 1e-3}
        yield Scene("impact", f"{name} {force:g} N, {duration * 1e6:g} us every {interval * 1e3:g} ms", train)


def tilts():
    for degrees, axis, mode in itertools.product((0.1, 0.2, 0.35, 0.5, 0.7, 1.0), ("y", "z", "-z"), ({}, SUPPORTED)):
        value = math.radians(degrees) * (-1 if axis[0] == "-" else 1)
        yield Scene(
            "tilt", f"{degrees:g} deg about {axis}{', supported' * bool(mode)}", mode, {f"shaft.tilt_{axis[-1]}": value}
        )
    for degrees, speed in itertools.product((0.3, 0.5, 1.0), (0, 4000, 40000)):
        yield Scene(
            "tilt",
            f"{degrees:g} deg at {speed} r/min, mixed",
            MIXED,
            {"shaft.tilt_z": math.radians(degrees), "shaft.omega": speed * RPM},
        )


def clearances():
    for P_d in (-50e-6, -20e-6, -5e-6, 0.0, 5e-6, 100e-6, 300e-6, 600e-6):
        yield Scene("clearance", f"P_d {P_d * 1e6:g} um", {"bearing.P_d": P_d})
    for pocket, guide in itertools.product((0.0, 1e-6, 5e-5, 5e-4, 2e-3), (1e-5, 2e-5, 5e-4, 3e-3)):
        yield Scene(
            "clearance",
            f"pocket {pocket * 1e3:g} mm, guide {guide * 1e3:g} mm",
            {"cage.pocket_clearance": pocket, "cage.guide_clearance": guide},
        )
    for f_i, f_e in itertools.product((0.5005, 0.505, 0.6), repeat=2):
        yield Scene(
            "clearance", f"conformity {f_i}, {f_e}", {"bearing.f_i": f_i, "bearing.f_e": f_e, "bearing.P_d": 0.0}
        )


def joints():
    for preload, fit in itertools.product(
        (0.0, 1.0, 5.0, 20.0, 50.0, 100.0, 200.0), (-2e-4, -5e-5, -1e-5, 0.0, 5e-5, 1e-4)
    ):
        yield Scene(
            "joint", f"preload {preload:g} N, fit {fit * 1e3:g} mm", {"joint.preload": preload, "joint.fit": fit}
        )
    for mu, zeta in itertools.product((0.0, 1.0), (0.0, 1.0)):
        yield Scene("joint", f"joint.mu {mu:g}, joint.zeta {zeta:g}", {"joint.mu": mu, "joint.zeta": zeta})
    for T in (150.0, 400.0, 700.0):
        yield Scene("joint", f"at {T:g} K", {}, dict.fromkeys(("ring.T_i", "ring.T_e", "ball.T", "cage.T"), T))
    for bearing, preload, speed in itertools.product(
        ("soft rivets", "stiff rivets"), (0.0, 20.0, 200.0), (4000, 18238, 40000)
    ):
        yield Scene(
            "joint",
            f"{bearing}, preload {preload:g} N, {speed} r/min",
            {"joint.preload": preload},
            {"shaft.omega": speed * RPM},
            bearing=bearing,
        )


def oils():
    for eta, rpm, mixed in itertools.product(
        (0.5e-3, 2e-3, 6e-3, 20e-3, 100e-3, 500e-3), (400, 4000, 18238, 40000), (False, True)
    ):
        yield Scene(
            "oil",
            f"{eta * 1e3:g} mPa.s at {rpm} r/min{', mixed' * mixed}",
            {"oil.eta": eta} | (MIXED if mixed else {}),
            {"shaft.omega": rpm * RPM},
        )
    dry = {
        "oil.eta": 1e-5,
        "oil.rolling": 0.0,
        "oil.rho_mix": 0.0,
        "scene.lubrication": 2,
        "oil.mu_b": 0.2,
        "cage.mu": 0.2,
    }
    for rpm, mu in itertools.product((0, 400, 4000, 18238, 40000), (0.1, 0.3)):
        yield Scene(
            "oil", f"dry, mu {mu} at {rpm} r/min", dry | {"oil.mu_b": mu, "cage.mu": mu}, {"shaft.omega": rpm * RPM}
        )
    yield Scene(
        "oil",
        "no friction at all",
        {"oil.A": 0.0, "oil.B": 0.0, "oil.rolling": 0.0, "oil.rho_mix": 0.0, "cage.mu": 0.0},
    )


def balls():
    for dD in (1e-6, 5e-6, 20e-6, 49e-6, -5e-6, -1e-4, -1e-3):
        yield Scene("ball", f"one ball {dD * 1e6:+g} um", {"ball[3].dD": dD})
        yield Scene("ball", f"every other ball {dD * 1e6:+g} um", {f"ball[{j}].dD": dD for j in (1, 3, 5, 7)})
    yield Scene("ball", "no load at all", {}, {"shaft.F_x": 0.0, "shaft.F_y": 0.0})
    for g in (9.81, 1000.0):
        yield Scene("ball", f"gravity {g:g} m/s2 without load", {"gravity.y": -g}, {"shaft.F_x": 0.0, "shaft.F_y": 0.0})
    for unbalance in (1e-6, 1e-4):
        yield Scene("ball", f"unbalance {unbalance * 1e6:g} g.mm", {"cage.unbalance": unbalance})
    for spacing in (0.0, 0.5):
        yield Scene("ball", f"spacing error {spacing:g}", {"start.spacing": spacing})


MODES = {
    "point": {},
    "sliced": {"scene.traction": 2},
    "two_half": {"scene.cage": 1},
    "fatigue": {"scene.stress": 4, "start.settle": 0.0},
    "free ring": FREE,
}


def communication():
    for step, count in (
        (1e-9, 2000),
        (1e-8, 2000),
        (1e-7, 2000),
        (1e-6, 2000),
        (1e-5, 1000),
        (1e-3, 20),
        (1e-2, 3),
        (0.1, 1),
        (1.0, 1),
    ):
        for name in ("point", "two_half") if step < 0.1 else ("two_half",):
            yield Scene("communication step", f"{step:g} s, {name}", MODES[name], step=step, t_end=step * count)
    for h in (3e-8, 3e-6, 1e-5):
        times = np.arange(0.0, 500 * h, h)
        history = [(t, F_RADIAL * (1 + 0.2 * math.sin(1e4 * t))) for t in times]
        yield Scene(
            "communication step",
            f"{h:g} s, load changing at each",
            {},
            {"shaft.F_y": history},
            hold=True,
            step=h,
            t_end=500 * h,
        )


def tolerances():
    cases = {
        "working point": ({}, {}),
        "4,000 r/min mixed": (MIXED, {"shaft.omega": 4000 * RPM}),
        "tilt": ({}, {"shaft.tilt_z": math.radians(0.5)}),
    }
    for (name, (parameters, inputs)), exponent in itertools.product(cases.items(), range(1, 10)):
        yield Scene(
            "tolerance",
            f"1e-{exponent}, {name}",
            parameters,
            inputs,
            tolerance=10.0**-exponent,
            t_end=5e-3 if exponent < 7 else 1e-3,
        )


def numbers_of_balls():
    """Other numbers of balls, with loads and speeds scaled to the bearing by D^2 and 1/d_m."""
    for bearing, size, speed in (("5 balls", 1.0, 1.0), ("16 balls", 0.33, 1.0), ("32 balls", 0.25, 0.67)):
        for mode, parameters in MODES.items():
            for factor, load in ((0.2, 1.0), (1.0, 1.0), (1.0, 5.0), (2.0, 0.1)):
                inputs = {
                    "shaft.omega": speed * factor * WORKING,
                    "shaft.F_y": size * load * F_RADIAL,
                    "shaft.F_x": size * load * F_AXIAL,
                }
                yield Scene(
                    "number of balls",
                    f"{bearing}, {mode}, speed {factor:g}x, load {load:g}x",
                    parameters,
                    inputs,
                    bearing=bearing,
                )


def randoms(count=200):
    """Random values of all variables at once, from distributions that cover what an engineer may enter."""
    rng = np.random.default_rng(7)

    def pick(*values):
        return values[int(rng.integers(len(values)))]

    def log(low, high):
        return float(np.exp(rng.uniform(np.log(low), np.log(high))))

    for n in range(count):
        parameters = {
            "bearing.P_d": float(rng.uniform(-10e-6, 80e-6)),
            "bearing.f_i": float(rng.uniform(0.505, 0.53)),
            "bearing.f_e": float(rng.uniform(0.505, 0.54)),
            "cage.pocket_clearance": log(2e-5, 8e-4),
            "cage.guide_clearance": log(2e-5, 1e-3),
            "cage.mu": float(rng.uniform(0.0, 0.3)),
            "cage.unbalance": pick(0.0, log(1e-8, 1e-5)),
            "joint.preload": pick(0.0, log(1.0, 200.0)),
            "joint.fit": float(rng.uniform(-2e-4, 1e-4)),
            "oil.eta": log(5e-4, 0.5),
            "oil.rho_mix": pick(0.0, 35.0, 500.0),
            "gravity.y": pick(0.0, -9.81),
            "": pick(1, 1, 1, 2),  # of a parameter that is no longer drawn, so that those after it keep their values
            "scene.traction": pick(1, 1, 2),
            "scene.lubrication": pick(1, 2),
            "scene.stress": pick(1, 3, 3, 4),
            "ring.tilt_mode": pick(1, 2, 3),
            "ring.k_tilt": log(3e2, 1e6),
            "ball[2].dD": pick(0.0, float(rng.uniform(-1e-5, 1e-5))),
            "start.seed": n,
        }
        if rng.random() < 0.3:
            parameters |= {
                "pulse.F_r": log(100, 2e4),
                "pulse.F_a": log(10, 3e3),
                "pulse.duration": log(1e-5, 1e-3),
                "pulse.t_start": 2e-3,
            }
        omega = float(rng.choice((-1.0, 1.0))) * log(10, 40000) * RPM
        inputs = {
            "shaft.omega": omega
            if rng.random() < 0.7
            else [(1e-3, omega), (6e-3, float(rng.uniform(-1, 1)) * 30000 * RPM)],
            "shaft.F_y": float(rng.normal(0, 3000)),
            "shaft.F_z": pick(0.0, float(rng.normal(0, 1000))),
            "shaft.F_x": float(rng.normal(0, 1000)),
            "shaft.tilt_y": float(rng.normal(0, math.radians(0.1))),
            "shaft.tilt_z": float(rng.normal(0, math.radians(0.15))),
        }
        del parameters[""]
        yield Scene("random", f"random {n}", parameters, inputs)


def impossible():
    """Input that describes no bearing or no simulation."""
    cases = {
        "balls overlap": {"bearing.d_m": 0.03},
        "pockets overlap": {"cage.pocket_clearance": 5e-3, "bearing.D": 0.0145},
        "conformity 0.5": {"bearing.f_i": 0.5},
        "outer conformity 0.49": {"bearing.f_e": 0.49},
        "interference of 0.1 mm": {"bearing.P_d": -1e-4},
        "interference of 1 % of small balls": {"bearing.D": 3e-3, "bearing.P_d": -40e-6},
        "clearance beyond the grooves": {"bearing.P_d": 9e-4},
        "cage bore outside its rim": {"cage.D_i": 0.0596},
        "cage beside the pitch circle": {"cage.D_i": 0.055},
        "land wider than the cage": {"cage.land_width": 0.01},
        "no guide clearance": {"cage.guide_clearance": 0.0},
        "guide clearance 0.002 mm": {"cage.guide_clearance": 2e-6},
        "ball larger than its pocket": {"cage.pocket_clearance": 1e-5, "ball[1].dD": 2e-5},
        "pitch circle of another rivet table": {"bearing.d_m": 0.0545},
        "pulses overlap": {"pulse.interval": 1e-4, "pulse.duration": 1e-3},
        "S-N curve bends up": {"fatigue.k_2": 3.0},
        "negative preload": {"joint.preload": -1.0},
        "load is not a number": ({}, {"shaft.F_y": math.nan}),
        "infinite speed": ({}, {"shaft.omega": math.inf}),
        "tilt of 10 degrees": ({}, {"shaft.tilt_z": math.radians(10)}),
        "load out of the grooves": ({}, {"shaft.F_x": 1e5, "shaft.tilt_z": math.radians(2)}),
    }
    for name, case in cases.items():
        parameters, inputs = case if isinstance(case, tuple) else (case, {})
        yield Scene("impossible", name, parameters, inputs, expected="refused")


FAMILIES = (
    speeds,
    ramps,
    loads,
    jumps,
    impacts,
    tilts,
    clearances,
    joints,
    oils,
    balls,
    communication,
    tolerances,
    numbers_of_balls,
    randoms,
    impossible,
)


def matrix():
    """All scenes of the matrix."""
    return [scene for family in FAMILIES for scene in family()]
