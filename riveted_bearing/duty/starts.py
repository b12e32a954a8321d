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
    speed, settle = scene.value(SPEED, model), scene.value("start.settle", model)
    varies = SPEED in scene.inputs and np.any(scene.inputs[SPEED].value != speed)
    if s % 2 == 0 or speed == 0.0 or varies or SETTLED * settle < RUN_UP:
        return replace(scene, parameters=parameters)
    run_up = History(np.array([0.0, RUN_UP]), np.array([FROM, 1.0]) * speed)
    return replace(scene, parameters=parameters, inputs=scene.inputs | {SPEED: run_up})
