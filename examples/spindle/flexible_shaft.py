"""A flexible shaft on two bearing FMUs: beam elements of scikit-fem, motion in, force out.

    python examples/spindle/flexible_shaft.py [--load 1000] [--speed 6000] [--length 0.4]

The shaft bends in both planes (Euler beam, Hermite elements; no gyroscopic moments: slender, without discs).  Its ends sit
in two bearings, which springs press against each other along the axis.  The master is that of examples/rotor: the
trapezoidal rule, the FMUs one step ahead by position, velocity and acceleration, and the bearings' linear stiffness in
the master's matrix against the part of the motion that this prediction misses.
"""

import argparse
import math
from pathlib import Path

import numpy as np
from fmpy import extract, read_model_description
from fmpy.fmi2 import FMU2Slave
from skfem import Basis, BilinearForm, ElementLineHermite, MeshLine
from skfem.helpers import dd

FMU = Path(__file__).resolve().parents[2] / "fmus" / "RivetedBearing.fmu"
E, RHO, DIAMETER, ELEMENTS = 211e9, 7810.0, 0.035, 8
H = 5e-6  # communication step [s]
STIFFNESS, AXIAL = 1e8, 1e-4  # N/m of a bearing, and axial place of its inner ring [m]: some 500 N
LOSS = 2e-5  # s, damping of the shaft over its stiffness


def beam(length, elements=ELEMENTS, diameter=DIAMETER):
    """Places of deflection and slope of each node among the unknowns, mass and stiffness matrices."""
    basis = Basis(MeshLine(np.linspace(0.0, length, elements + 1)), ElementLineHermite())
    A, I = math.pi * diameter**2 / 4.0, math.pi * diameter**4 / 64.0

    @BilinearForm
    def bending(u, v, w):
        return E * I * dd(u)[0][0] * dd(v)[0][0]

    @BilinearForm
    def inertia(u, v, w):
        return RHO * A * u * v

    return basis.nodal_dofs, inertia.assemble(basis).toarray(), bending.assemble(basis).toarray()


class Bearing:
    """One FMU; its inner ring goes where the shaft's end goes."""

    def __init__(self, description, folder, omega, x, y, v, stress):
        self.vr = {variable.name: variable.valueReference for variable in description.modelVariables}
        identifier = description.coSimulation.modelIdentifier
        self.fmu = FMU2Slave(
            guid=description.guid, unzipDirectory=folder, modelIdentifier=identifier, instanceName="bearing"
        )
        self.fmu.instantiate()
        # ring.motion = prescribed; scene.stress = off or peak
        self.fmu.setInteger([self.vr["ring.motion"], self.vr["scene.stress"]], [2, 3 if stress else 1])
        self.fmu.setReal([self.vr["shaft.omega"], self.vr["shaft.x"]], [omega, x])
        self.inputs = [self.vr[f"shaft.{name}"] for name in ("y", "z", "v_y", "v_z")]
        self.fmu.setReal(self.inputs, [*y, *v])
        self.fmu.setupExperiment(startTime=0.0)
        self.fmu.enterInitializationMode()
        self.fmu.exitInitializationMode()
        self.stress = 0.0

    def value(self, *names):
        return np.array(self.fmu.getReal([self.vr[name] for name in names]))

    def step(self, t, y, v, a):
        """Reaction on the shaft [N] at the end of a step that begins with place y, velocity v, acceleration a."""
        self.fmu.setReal(self.inputs, [*y, *v])
        self.fmu.setRealInputDerivatives(self.inputs[2:], [1, 1], list(a))
        self.fmu.doStep(currentCommunicationPoint=t, communicationStepSize=H)
        *R, stress = self.value("shaft.R_y", "shaft.R_z", "rivet.sigma_head_max")
        self.stress = max(self.stress, stress)
        return np.array(R)


def simulate(load, speed, length=0.4, duration=0.03, fmu=FMU, stress=True):
    """Deflections of all nodes [times, nodes, 2], reactions of the bearings [times, 2, 2], and the largest head stress
    of each [Pa], under a load [N] along Y in the middle of the shaft that turns at speed [rad/s].
    """
    nodes, M, K = beam(length)
    ends, middle = nodes[0, [0, -1]], nodes[0, ELEMENTS // 2]
    joint = np.zeros_like(K)
    joint[ends, ends] = STIFFNESS
    force = np.zeros((len(K), 2))
    force[middle, 0] = load
    q = np.linalg.solve(K + joint, force)  # start: on linear bearings, at rest
    v, a = np.zeros_like(q), np.zeros_like(q)
    D = LOSS * K
    inverse = np.linalg.inv(M + 0.5 * H * D + 0.25 * H * H * (K + joint))
    description, folder = read_model_description(str(fmu)), extract(str(fmu))
    bearings = [
        Bearing(description, folder, speed, side * AXIAL, q[at], v[at], stress) for side, at in zip((1, -1), ends)
    ]
    places, reactions = [], []
    for n in range(round(duration / H)):
        ahead = q[ends] + H * v[ends] + 0.5 * H * H * a[ends]  # where the FMUs' rings will be
        R = np.array([bearing.step(n * H, q[at], v[at], a[at]) for bearing, at in zip(bearings, ends)])
        q, v = q + H * v + 0.25 * H * H * a, v + 0.5 * H * a
        acting = force.copy()
        acting[ends] += R + STIFFNESS * (ahead - q[ends])
        a = inverse @ (acting - D @ v - K @ q)
        q, v = q + 0.25 * H * H * a, v + 0.5 * H * a
        places.append(q[nodes[0]])
        reactions.append(R)
    stresses = [bearing.stress for bearing in bearings]
    for bearing in bearings:
        bearing.fmu.terminate()
        bearing.fmu.freeInstance()
    return np.array(places), np.array(reactions), stresses


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--load", type=float, default=1000.0, help="N")
    parser.add_argument("--speed", type=float, default=6000.0, help="rev/min")
    parser.add_argument("--length", type=float, default=0.4, help="m")
    given = parser.parse_args()
    places, reactions, stresses = simulate(given.load, given.speed * math.pi / 30.0, given.length)
    late = slice(len(places) // 2, None)
    mean, R = 1e6 * places[late].mean(axis=0), reactions[late].mean(axis=0)
    print(f"shaft's middle {mean[ELEMENTS // 2, 0]:.1f} um, ends {mean[0, 0]:.1f} and {mean[-1, 0]:.1f} um along Y")
    print(f"reactions of the bearings along Y {R[0, 0]:.0f} and {R[1, 0]:.0f} N")
    print(f"largest head stress {1e-6 * stresses[0]:.0f} and {1e-6 * stresses[1]:.0f} MPa")
