"""Stiffness and damping of the bearing, shaft against housing, over speed and load.

    R = R_0 - K q - C q_dot,   q = (x, y, z, tilt_y, tilt_z) of the inner ring,   R = (F_x, F_y, F_z, M_y, M_z) on the shaft

K by the quasi-static equilibrium: balls follow, their inertia loads stay; mean over the azimuths that the balls pass.
K and C by the FMU: the inner ring is prescribed at the equilibrium and shaken
along one direction after the other, q_i = A sin(w t); the first harmonic of R over whole periods gives column i of K +
i w C.  Each shake runs with +A and with -A: half the difference of the two runs no longer contains the
forces by which passing balls alone change R.
"""

import math
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
from fmpy.fmi1 import FMICallException

from bearing_model.quasi_static import quasi_static

from ..base.errors import UserError, naming
from ..base.files import write_text
from ..bearing.case import Case
from ..running.effects import acts, all_figures, without_effect
from ..running.fmu import Instance, Model
from ..running.inputs import History
from ..running.scene import Scene, own_names
from ..running.scene_case import case_at
from ..running.summary import RPM
from ..show.style import FORCE, HEAD, MIDDLE, picture

DIRECTIONS = ("x", "y", "z", "tilt_y", "tilt_z")
RATES = ("v_x", "v_y", "v_z", "tilt_y_dot", "tilt_z_dot")
LOADS = ("F_x", "F_y", "F_z", "M_y", "M_z")
REACTIONS = ("shaft.R_x", "shaft.R_y", "shaft.R_z", "shaft.R_My", "shaft.R_Mz")
AMPLITUDE = 0.5e-6  # of the shake at the pitch radius [m]
AZIMUTHS = 8  # of the balls within a pitch, over which the equilibrium is averaged
LONGEST_STEP = 1e-5  # between the points of a shake [s]
SETTLE, LENGTH = 0.006, 0.02  # of a shake [s]; its periods are whole
FORCED = {"ring.motion": "prescribed", "scene.stress": "off", "scene.statistics": "off"}  # by a shake
ROSS = {"x": "y", "y": "z", "z": "x"}  # its axes, z axial, by ours, x axial


@dataclass(frozen=True)
class Matrices:
    """omega [rad/s], factor of the loads, frequency of the shake [rad/s], place q [5], K_static and the FMU's K and C [5, 5] or
    None; m, rad, N, N.m, s.
    """

    omega: float
    load: float
    frequency: float
    q: np.ndarray
    K_static: np.ndarray
    K: np.ndarray | None = None
    C: np.ndarray | None = None


def quasi_static_matrices(case: Case, speeds: Any, loads: Any = (1.0,)) -> Any:
    """Matrices without K and C of the FMU at each load factor and speed [rad/s]; else UserError."""
    return [Matrices(omega, load, abs(omega), *equilibrium(case, load, omega)) for load in loads for omega in speeds]


def dynamic_matrices(
    model: Model,
    case: Case,
    scene: Scene,
    points: Any,
    frequency: Any = None,
    progress: Any = lambda share: None,
) -> Any:
    """The points with the FMU's K and C; frequency [rad/s]: None for the speed, at standstill 100 Hz; else UserError."""
    found = []
    for i, point in enumerate(points):
        w = frequency or point.frequency or 2.0 * math.pi * 100.0
        size = np.array([1.0, 1.0, 1.0, *[2.0 / case.bearing.d_m] * 2]) * AMPLITUDE
        H = np.array([response(model, scene, point.omega, point.q, k, size[k], w) for k in range(5)]).T
        found.append(replace(point, frequency=w, K=H.real, C=H.imag / w))
        progress((i + 1) / len(points))
    return found


def scene_at(model: Model, scene: Scene, point: Any) -> Any:
    """The scene at the speed and the load factor of a point."""
    inputs = {f"shaft.{name}": point.load * scene.value(f"shaft.{name}", model) for name in LOADS}
    inputs["shaft.omega"] = point.omega
    return replace(
        scene,
        replaced=tuple(text for text in scene.replaced if not text.startswith("shaft.omega ")),
        inputs=scene.inputs | {name: History(np.zeros(1), np.array([value])) for name, value in inputs.items()},
    )


def idle_settings(model: Model, scene: Scene, point: Any, speeds_given: Any, static: Any) -> Any:
    """Names set without effect at the highest speed on the stiffness and, unless static, the reactions."""

    def held(one):
        one = scene_at(model, one, point)
        place = dict.fromkeys((f"shaft.{name}" for name in RATES), 0.0)
        place |= {f"shaft.{name}": value for name, value in zip(DIRECTIONS, point.q, strict=True)}
        histories = {name: History(np.zeros(1), np.array([value])) for name, value in place.items()}
        return replace(one, outputs=REACTIONS, parameters=one.parameters | FORCED, inputs=one.inputs | histories)

    def stiffness(one):
        case = case_at(one, model)
        omega = point.omega if speeds_given else case.load.omega
        return dict(zip(("place", "K"), equilibrium(case, point.load, omega), strict=True))

    short = replace(scene, t_end=min(scene.t_end, SETTLE + LENGTH))
    idle = own_names(scene, model)
    if not static:
        idle, _ = without_effect(model, short, idle, all_figures, held)
    reference = stiffness(scene) if idle else None
    return [name for name in idle if not acts(name, scene, stiffness, reference)]


def equilibrium(case, load, omega):
    """Place of the ring [5] and stiffness [5, 5] under the case's loads times a factor at a speed [rad/s]."""
    given = case.load
    scaled = {name: load * getattr(given, name) for name in LOADS}
    with naming(f"{case.designation} at {omega:g} rad/s, load factor {load:g}"):
        azimuths = 2.0 * math.pi / case.bearing.Z * np.arange(AZIMUTHS) / AZIMUTHS
        states = [quasi_static(case.bearing, replace(given, omega=omega, **scaled), psi) for psi in azimuths]
    housing = np.array([case.value(f"housing.{name}") for name in DIRECTIONS])  # the equilibrium is relative to it
    places = [[state.x, state.y, state.z, state.tilt_y, state.tilt_z] for state in states]
    return np.mean(places, axis=0) + housing, np.mean([state.K for state in states], axis=0)


def response(model, scene, omega, q, direction, amplitude, w):
    """-dR/dq_i at w [rad/s], complex [5]: half the difference of the responses to both signs."""
    there, back = (shaken(model, scene, omega, q, direction, sign * amplitude, w) for sign in (1.0, -1.0))
    return -(there - back) / (2.0 * amplitude)


def shaken(model, scene, omega, q, direction, amplitude, w):
    """First harmonic of the reactions [5] to amplitude sin(w t): of sin(w t) + i times that of cos(w t)."""
    period = 2.0 * math.pi / w
    count = math.ceil(period / LONGEST_STEP)
    h, settle, periods = period / count, math.ceil(SETTLE / period), math.ceil(LENGTH / period)
    names = [f"shaft.{name}" for name in (*DIRECTIONS, *RATES)]
    references = [model.inputs[name].valueReference for name in names]
    rates = references[5:]

    def motion(t):
        place, velocity = q.copy(), np.zeros(5)
        place[direction] += amplitude * math.sin(w * t)
        velocity[direction] = amplitude * w * math.cos(w * t)
        return [*place, *velocity]

    first = {
        name: History([0.0], [value])
        for name, value in zip((*names, "shaft.omega"), (*motion(0.0), omega), strict=True)
    }
    t_end = (settle + periods + 1) * period
    begun = replace(scene, t_end=t_end, parameters=scene.parameters | FORCED, inputs=scene.inputs | first)
    with Instance(model) as instance:
        instance.initialize(begun)
        fmu = instance.fmu
        try:
            read, sums = instance.reader(REACTIONS), np.zeros(5, complex)
            for n in range((settle + periods) * count):
                fmu.setReal(references, motion(n * h))
                acceleration = [0.0] * 5
                acceleration[direction] = -amplitude * w * w * math.sin(w * n * h)
                fmu.setRealInputDerivatives(rates, [1] * 5, acceleration)
                fmu.doStep(currentCommunicationPoint=n * h, communicationStepSize=h)
                if n >= settle * count:
                    angle = w * (n + 1) * h
                    sums += read() * complex(math.sin(angle), math.cos(angle))
        except FMICallException:
            raise UserError(f"{scene.name} at {omega:g} rad/s: the FMU refuses: {instance.complaints()}") from None
    return sums * 2.0 / (periods * count)


# ---------------------------------------------------------------------------------------------------------------- files


def write_table(found: Any, path: Path, basis: Any = ()) -> Path:
    """A CSV row for each Matrices: speed, load factor, frequency, place, matrices, SI; before it the basis."""
    entries = [f"{a}.{b}" for a in DIRECTIONS for b in DIRECTIONS]
    kinds = ["K_static", *(("K", "C") if found[0].K is not None else ())]
    places = [f"{name} [{'rad' if 'tilt' in name else 'm'}]" for name in DIRECTIONS]
    header = ["omega [rad/s]", "load", "frequency [rad/s]", *places]
    header += [f"{kind}[{entry}]" for kind in kinds for entry in entries]
    lines = [*comments(basis), ",".join(header)]
    for p in found:
        entries = np.concatenate([getattr(p, kind).ravel() for kind in kinds])
        lines.append(",".join(f"{value:.9g}" for value in (p.omega, p.load, p.frequency, *p.q, *entries)))
    return write_text(path, "\n".join(lines) + "\n")


def comments(basis):
    """Lines of what the figures rest on, for files."""
    return [f"# {name}: {text}" for name, text in basis]


def ross_coefficients(found):
    """Coefficients of ROSS 3's BearingElement by name over speed, with several whirls [speed][frequency] [rad/s], in its axes (x,
    y lateral, z axial); quasi-static K and no damping where the FMU's are not known.
    """
    speeds, whirls = sorted({p.omega for p in found}), sorted({p.frequency for p in found})
    places = {(p.omega, p.frequency): p for p in found}
    grid = len(whirls) > 1 and len(places) == len(speeds) * len(whirls)
    rows = [[places[w, f] for f in whirls] for w in speeds] if grid else [[p] for p in found]
    table = {"speed": speeds, "frequency": whirls} if grid else {"speed": [p.omega for p in found]}
    for kind in "KC":
        for a, ours_a in ROSS.items():
            for b, ours_b in ROSS.items():
                if "z" in (a, b) and a != b:
                    continue  # ROSS couples no axial motion
                i, k = DIRECTIONS.index(ours_a), DIRECTIONS.index(ours_b)
                values = [[float(entry(p, kind)[i, k]) for p in row] for row in rows]
                table[f"{kind.lower()}{a}{b}"] = values if grid else [row[0] for row in values]
    return table


def entry(point, kind):
    if kind == "K":
        return point.K_static if point.K is None else point.K
    return np.zeros((5, 5)) if point.C is None else point.C


def write_ross(found: Any, path: Path, node: int = 0, tag: str = "bearing", basis: Any = (), version: int = 3) -> Path:
    """A TOML file for ross.BearingElement.load; in version 2 of ROSS the axis is called frequency, without tables over both."""
    coefficients = ross_coefficients(found)
    if version < 3:
        if "frequency" in coefficients:
            raise UserError("ROSS 2 has no tables over speed and whirl: name one --frequency")
        coefficients = {"frequency": coefficients.pop("speed")} | coefficients
    lines = [*comments(basis), f"[BearingElement_{tag}]", f"n = {node}", f'tag = "{tag}"']
    lines += [f"{name} = {np.asarray(values, float).tolist()}" for name, values in coefficients.items()]
    return write_text(path, "\n".join(lines) + "\n")


def plot_matrices(found: Any, path: Path) -> Path:
    """Stiffness and damping of the translations over speed as PNG, one line style for each load factor."""
    loads = list(dict.fromkeys(p.load for p in found))
    with picture(path, (11, 4.2)) as figure:
        left, right = figure.subplots(1, 2)
        for load, dash in zip(loads, ("-", "--", ":", "-.") * len(loads), strict=False):
            points = [p for p in found if p.load == load]
            speed = RPM * np.array([p.omega for p in points])
            for i, (name, colour) in enumerate(zip("xyz", (FORCE, HEAD, MIDDLE), strict=True)):
                suffix = "" if len(loads) == 1 else f", load x {load:g}"
                left.plot(speed, [1e-6 * p.K_static[i, i] for p in points], dash, color=colour, alpha=0.45)
                if points[0].K is not None:
                    look = {"color": colour, "markersize": 4}
                    left.plot(speed, [1e-6 * p.K[i, i] for p in points], "o", label=f"K {name}{name}{suffix}", **look)
                    right.plot(speed, [p.C[i, i] for p in points], f"o{dash}", label=f"C {name}{name}{suffix}", **look)
        left.set(xlabel="speed [rev/min]", ylabel="stiffness [N/um]", title="Stiffness: lines quasi-static, points FMU")
        right.set(xlabel="speed [rev/min]", ylabel="damping [N s/m]", title="Damping, FMU")
        for ax in (left, right):
            if ax.has_data() and ax.get_legend_handles_labels()[0]:
                ax.legend()
    return path
