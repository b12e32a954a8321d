"""Data of the model: constants that are derived once, loads that are held over a step, and the results of one
evaluation of the right-hand side.

Frame: X axial, Y and Z radial.  Ball j has its own cylindrical frame (x, r, t): x along X, r from the axis through the
ball, t = x cross r. Letters: i inner, e outer race, c cage, half h = 0 on the side of -X, h = 1 on +X; alpha contact
angle; n unit normal from race or pocket surface into it, seen from the ball (the ball is pushed along -n).
"""

from dataclasses import dataclass, replace
from types import SimpleNamespace

import numpy as np

from bearing_model.cage.cage import cage_derive
from bearing_model.physics.derived import Derived, check_table, default_table, model_derive
from bearing_model.physics.parameters import InputDerivatives, Inputs, Parameters
from bearing_model.physics.ring_load import (
    InputTrajectory,
    RingLoad,
    check_frame,
    input_trajectory_update,
    input_trajectory_varies,
    ring_load_at,
)
from bearing_model.physics.temperature import check_temperatures, temperature_apply


class Work(SimpleNamespace):
    """Results of one evaluation, named as in fmu_src/physics/model.h; vectors have their components on axis 0, pocket
    results are kept by half.  cage.elastic: of halves that vibrate; rigid ones add no inertia and lose nothing by modes.  squeeze_by,
    squeeze_from: of a step's evaluation (cage_begin).
    """

    def __init__(self, **results):
        still = SimpleNamespace(more_J=(0.0, 0.0), more_J_dot=(0.0, 0.0), energy=0.0, dissipated=0.0)
        super().__init__(cage=SimpleNamespace(elastic=still), squeeze_by=None, squeeze_from=None, **results)


@dataclass
class Model:
    """All that the right-hand side needs beside time and state: parameters, constants derived from them, loads and speed."""

    p: Parameters  # at the present temperatures (temperature.py)
    d: Derived
    ring_load: RingLoad
    trajectory: InputTrajectory | None = None  # where the drive changes with time: takes its place
    modes: object = None  # of the cage's halves where they vibrate (cage.py)
    turn: np.ndarray | None = None  # of balls with spalls (ball_spall.py) [rad]; None: that of the start

    @classmethod
    def of(cls, parameters=None, inputs=None, t=0.0, table=None):
        """The model of some parameters and inputs {name: value} (SI, others at their start values), inputs held from
        time t [s].

        table: a rivet_table.RivetTable; default that of the 6207.  ValueError names a value that is not allowed.

        >>> model = Model.of({"bearing.P_d": 20e-6}, {"shaft.omega": 500.0})
        >>> print(f"{model.d.inner.hertz.K:.4g} N/m^1.5")
        3.331e+10 N/m^1.5
        """
        p, u = Parameters(parameters), Inputs(inputs)
        trajectory = input_trajectory_update(p, (u, InputDerivatives(), InputDerivatives()), t, t)
        varies = trajectory if input_trajectory_varies(trajectory) else None
        return cls.under(p, u, ring_load_at(trajectory, t), varies, table)

    @classmethod
    def under(cls, p, u, ring_load, trajectory=None, table=None):
        """The model of the Parameters p at the temperatures in the Inputs u, under a RingLoad or along an
        InputTrajectory; table: RivetTable, default that of the 6207.

        ValueError names a temperature that oil or bearing do not bear, a frame that is too fast for its arm, a cage that
        there is not, or parameters of another bearing than the table's.
        """
        table = table or default_table()
        check_table(p, table)
        hot = temperature_apply(p, u, table)
        check_temperatures(u, hot)
        check_frame(p, u)
        d = model_derive(hot, table)
        return cls(hot, d, ring_load, trajectory, cage_derive(hot, d, table))

    def at(self, t):
        """The Model whose load and motions are those at time t [s], held; arrays of times [...] give loads [..., 1],
        complex times carry derivatives.
        """
        if self.trajectory is None:
            return self
        return replace(self, ring_load=ring_load_at(self.trajectory, np.expand_dims(t, -1)), trajectory=None)
