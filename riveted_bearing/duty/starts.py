"""The start of a run, which its joints remember: without creep the shear of the first revolutions stays in them."""

from dataclasses import replace

import numpy as np

from ..running.inputs import History

SPEED = "shaft.omega"
RUN_UP = 0.02  # s; 0.2 s give the same stress
FROM = 0.1  # of the speed
SETTLED = 0.5  # of start.settle: by then a run-up is over


def started(scene, model, first, s):
    """The Scene of run number s (from 0), whose start.seed is first + s.  Every second run is run up from a tenth of its speed, the others start at
    speed with joints that carry no shear, so that the scatter of the runs holds that of the start.  All start at speed where it varies, or where
    start.settle leaves no time for a run-up.
    """
    parameters = scene.parameters | {"start.seed": first + s}
    speed = scene.inputs.get(SPEED)
    values = np.array([model.default(model.inputs[SPEED])]) if speed is None else speed.value
    settle = parameters.get("start.settle", model.default(model.parameters["start.settle"]))
    if s % 2 == 0 or values[0] == 0.0 or np.any(values != values[0]) or SETTLED * settle < RUN_UP:
        return replace(scene, parameters=parameters)
    run_up = History(np.array([0.0, RUN_UP]), np.array([FROM, 1.0]) * values[0])
    return replace(scene, parameters=parameters, inputs=scene.inputs | {SPEED: run_up})
