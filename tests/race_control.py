"""The running bearing with spin in its traction (scene.traction = sliced) beside the equilibrium with outer race
control, written apart from it.
"""

from dataclasses import dataclass

import numpy as np

from bearing_model.generated.variables import Z
from bearing_model.physics.parameters import Parameters
from bearing_model.physics.ring_fit import ring_fit_of
from bearing_model.quasi_static import Bearing, Load, quasi_static
from riveted_bearing import run
from riveted_bearing.running.summary import settled

RPM = np.pi / 30.0
SPEEDS = (3000.0, 10000.0, 17000.0, 24000.0)  # [r/min]
LOADS = ((515.0, 2994.0), (200.0, 1500.0), (800.0, 800.0), (1500.0, 0.0))  # axial, radial [N]


@dataclass(frozen=True)
class Means:
    """Means over time, angles weighted by the loads: displacements [m], speed of the cage [rad/s], contact angles
    [rad].
    """

    x: float
    y: float
    omega_c: float
    alpha_i: float
    alpha_e: float


def weighted(angle, load):
    return float(np.sum(angle * load) / np.sum(load))


def equilibrium(F_x, F_y, speed, control):
    """Means over the passing of one ball, the inner ring as it grows by rotation.  Raises ArithmeticError if there is
    no equilibrium.
    """
    load = Load(F_x=F_x, F_y=F_y, omega=speed * RPM)
    found = [
        quasi_static(Bearing(fit=ring_fit_of(Parameters())), load, psi=psi, control=control)
        for psi in 2.0 * np.pi / Z / 6 * np.arange(6)
    ]
    Q_i, Q_e, alpha_i, alpha_e = (
        np.array([getattr(at, name) for at in found]) for name in ("Q_i", "Q_e", "alpha_i", "alpha_e")
    )
    x, y, omega_c = (float(np.mean([getattr(at, name) for at in found])) for name in ("x", "y", "omega_m"))
    return Means(x, y, omega_c, weighted(alpha_i, Q_i), weighted(alpha_e, Q_e))


def running(fmu, F_x, F_y, speed, t_end=0.1, **parameters):
    """Means of the second half of a run of the scene demo with sliced traction."""
    inputs = {"shaft.F_x": F_x, "shaft.F_y": F_y, "shaft.omega": speed * RPM}
    result = run(
        "demo",
        fmu=fmu,
        t_end=t_end,
        inputs=inputs,
        parameters={"scene.traction": "sliced", "start.settle": 0.5 * t_end} | parameters,
    )
    late = settled(result)

    def balls(name):
        return np.array([result.data[f"ball[{j}].{name}"][late] for j in range(1, Z + 1)])

    x, y, omega_c = (float(result.data[name][late].mean()) for name in ("ring.x", "ring.y", "cage.omega"))
    return Means(x, y, omega_c, weighted(balls("alpha_i"), balls("Q_i")), weighted(balls("alpha_e"), balls("Q_e")))
