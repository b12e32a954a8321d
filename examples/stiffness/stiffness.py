"""Stiffness and damping of the inner ring's bearing at a communication point, by directional derivatives of the FMU.

    python examples/stiffness/stiffness.py [--fmu RivetedBearing.fmu] [--steps 10]

The derivatives keep balls and cage where they are.  K is therefore the stiffness against a fast motion of the ring,
that of the inner contacts alone: about twice the quasi-static stiffness of `riveted-bearing info`, in which the balls
move. With ring.tilt_mode = prescribed the rows of the tilt describe the filter of the tilt, not contacts.
"""

import argparse
import shutil
from pathlib import Path

import fmpy
import numpy as np
from fmpy.fmi2 import FMU2Slave

PLACE = ["ring." + name for name in ("x", "y", "z", "beta", "gamma")]
SPEED = ["ring." + name for name in ("v_x", "v_y", "v_z", "beta_dot", "gamma_dot")]
ACCELERATION = ["ring." + name for name in ("a_x", "a_y", "a_z", "beta_ddot", "gamma_ddot")]
STEP = 1e-4  # s
FMU = Path(__file__).resolve().parents[2] / "fmus" / "RivetedBearing.fmu"


def matrices(path, steps):
    """K [N/m, N/rad, ...] and C of the ring after some communication steps from the start values."""
    description, folder = fmpy.read_model_description(path), fmpy.extract(path)
    vr = {v.name: v.valueReference for v in description.modelVariables}
    model = description.coSimulation.modelIdentifier
    fmu = FMU2Slave(guid=description.guid, unzipDirectory=folder, modelIdentifier=model, instanceName="ring")
    fmu.instantiate()
    fmu.setupExperiment(startTime=0.0)
    fmu.enterInitializationMode()
    fmu.exitInitializationMode()
    for k in range(steps):
        fmu.doStep(currentCommunicationPoint=k * STEP, communicationStepSize=STEP)

    m, J_t = fmu.getReal([vr["ring.m"], vr["ring.J_t"]])
    inertia = np.diag([m, m, m, J_t, J_t])

    def gradient(names):
        unknown = [vr[name] for name in ACCELERATION]
        return np.array([fmu.getDirectionalDerivative(unknown, [vr[name]], [1.0]) for name in names]).T

    K, C = -inertia @ gradient(PLACE), -inertia @ gradient(SPEED)
    fmu.terminate()
    fmu.freeInstance()
    shutil.rmtree(folder)
    return K, C


def main(arguments=None):
    parser = argparse.ArgumentParser(description="Stiffness and damping of the ring's bearing.")
    parser.add_argument("--fmu", type=Path, default=FMU)
    parser.add_argument("--steps", type=int, default=10, help="communication steps of 0.1 ms from the start")
    options = parser.parse_args(arguments)
    K, C = matrices(str(options.fmu), options.steps)
    print(f"{K[1, 1]:.3g} N/m along Y, {C[1, 1]:.3g} N.s/m")


if __name__ == "__main__":
    main()
