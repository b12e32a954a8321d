"""What differs by chance from run to run: the balls' spacing, the phase of a train of pulses, and the start, which the joints remember."""

from dataclasses import replace

import numpy as np

from .fmu import Model
from .inputs import History
from .scene import Scene

SPEED = "shaft.omega"
CAGE_SPEED = 0.4  # of the shaft's, about
PULSES = ("pulse.F_r", "pulse.F_a")
RUN_UP = 0.02  # s; 0.2 s give the same stress
FROM = 0.1  # of the speed
SETTLED = 0.5  # of start.settle: by then a run-up is over


def seeded(scene: Scene, model: Model, first: int, s: int) -> Scene:
    """Run number s (from 0): start.seed is first + s, and pulses begin later by a part of interval or cage turn, whose phase is
    chance: 0, 1/2, 1/4, 3/4 ... (van der Corput).  Inputs over time keep their times.
    """
    parameters = scene.parameters | {"start.seed": first + s}
    if any(scene.value(name, model) for name in PULSES):
        interval, t_start = (scene.value(f"pulse.{name}", model) for name in ("interval", "t_start"))
        parameters["pulse.t_start"] = t_start + van_der_corput(s) * min(interval, turn(scene, model))
    return replace(scene, parameters=parameters)


def speeds(scene, model):
    """The shaft's speed at the points of its history [rad/s]."""
    return scene.inputs[SPEED].value if SPEED in scene.inputs else np.array([scene.value(SPEED, model)])


def turn(scene, model):
    """Shortest time of a turn of the cage [s], infinite at rest."""
    fastest = float(np.max(np.abs(speeds(scene, model))))
    return 2.0 * np.pi / (CAGE_SPEED * fastest) if fastest else np.inf


def van_der_corput(s):
    """The binary digits of s mirrored at the point: 0, 1/2, 1/4, 3/4, 1/8 ..."""
    return sum((s >> bit & 1) / 2.0 ** (bit + 1) for bit in range(s.bit_length()))


def started(scene: Scene, model: Model, first: int, s: int) -> Scene:
    """As seeded(), every second one run up from a tenth of its speed, so that the scatter holds that of the start; all at speed
    where it varies, or where start.settle is too short.
    """
    scene, values = seeded(scene, model, first, s), speeds(scene, model)
    varies, settle = np.any(values != values[0]), scene.value("start.settle", model)
    if s % 2 == 0 or values[0] == 0.0 or varies or SETTLED * settle < RUN_UP:
        return scene
    run_up = History(np.array([0.0, RUN_UP]), np.array([FROM, 1.0]) * values[0])
    return replace(scene, inputs=scene.inputs | {SPEED: run_up})
