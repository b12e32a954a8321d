"""A shaft's end on a stiff sleeve on the bearing's inner ring, the sleeve as a delay line (transmission line): stable
at every communication step.

    python examples/delay_line/delay_line.py [--stiffness 5e8] [--steps 1e-4 5e-5 2e-5 1e-5 5e-6]

A line of delay T and impedance Z = K T stands for the sleeve's stiffness K.  Each end feels the wave that left the
other end a delay ago:

    force on the shaft  F_s = w_s - Z v_s,   w_s(t) = -F_r(t - T) + Z v_r(t - T)
    force on the ring   F_r = w_r - Z v_r,   w_r(t) = -F_s(t - T) + Z v_s(t - T)

Z v_r is the parameter ring.c of the FMU, w_r its load: both sides integrate for themselves over T, and the line returns
no more energy than it got.  Its price is the line's own mass K T^2.  Beside it the sleeve as a spring whose force is
held over the step, which adds energy.
"""

import argparse
from pathlib import Path

import numpy as np
from fmpy import extract, read_model_description
from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import FMU2Slave

FMU = Path(__file__).resolve().parents[2] / "fmus" / "RivetedBearing.fmu"
MASS, LENGTH = 2.0, 1e-3  # of the shaft's end [kg]; duration [s]
# on the shaft's end [N]: carried from the start; added at t = 0
LOAD, JUMP = np.array([515.0, 2994.0, 0.0]), np.array([0.0, 300.0, 0.0])


def march(h, K, line, fmu=FMU):
    """Displacements of the shaft's end [times, 3] in m at communication points h [s] apart; line: sleeve as a delay
    line, else as a held spring.
    """
    description, Z = read_model_description(str(fmu)), K * h if line else 0.0
    vr = {variable.name: variable.valueReference for variable in description.modelVariables}
    loads, ring = ([vr[f"{name}{axis}"] for axis in "xyz"] for name in ("shaft.F_", "ring."))
    bearing = FMU2Slave(
        guid=description.guid,
        unzipDirectory=extract(str(fmu)),
        modelIdentifier=description.coSimulation.modelIdentifier,
        instanceName="b",
    )
    bearing.instantiate()
    bearing.setReal([vr["ring.c"], *loads], [Z, *LOAD])
    bearing.setInteger([vr["scene.stress"]], [1])
    bearing.setupExperiment(startTime=0.0)
    bearing.enterInitializationMode()
    bearing.exitInitializationMode()
    x_r = begin = np.array(bearing.getReal(ring))
    x, v, v_s, v_r, F_s, F_r, places = *np.zeros((4, 3)), -LOAD, LOAD, np.full((round(LENGTH / h), 3), np.nan)
    try:
        for n in range(len(places)):
            stretch = x - (x_r - begin)
            w_s, w_r = (-F_r + Z * v_r, -F_s + Z * v_s) if line else (-LOAD - K * stretch, LOAD + K * stretch)
            bearing.setReal(loads, list(w_r))
            bearing.doStep(currentCommunicationPoint=n * h, communicationStepSize=h)
            v_end = (v * (MASS / h - 0.5 * Z) + LOAD + JUMP + w_s) / (MASS / h + 0.5 * Z)  # trapezoidal rule
            v_s, v, x_before, x_r = 0.5 * (v + v_end), v_end, x_r, np.array(bearing.getReal(ring))
            x, v_r = x + h * v_s, (x_r - x_before) / h
            # means over the step, so that the line's stretch stays the ends' distance
            F_s, F_r = w_s - Z * v_s, w_r - Z * v_r
            places[n] = x
    except FMICallException:
        pass  # the ring left the bearing
    bearing.freeInstance()
    return places


def errors(steps, K=5e8, finest=5e-7, fmu=FMU):
    """Largest errors along Y [m] of line and held spring at each communication step against the spring at the finest
    one, and the largest displacement.
    """
    exact, t = march(finest, K, False, fmu)[:, 1], finest * np.arange(1, round(LENGTH / finest) + 1)
    rows = []
    for h in steps:
        at = np.interp(h * np.arange(1, round(LENGTH / h) + 1), t, exact)
        rows.append([float(np.max(np.abs(march(h, K, line, fmu)[:, 1] - at))) for line in (True, False)])
    return rows, float(np.max(np.abs(exact)))


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--stiffness", type=float, default=5e8, help="of the sleeve [N/m]")
    parser.add_argument("--steps", type=float, nargs="+", default=[1e-4, 5e-5, 2e-5, 1e-5, 5e-6])
    options = parser.parse_args()
    rows, size = errors(options.steps, options.stiffness)
    for h, (line, spring) in zip(options.steps, rows, strict=True):
        print(
            f"{h:.0e} s: delay line {1e6 * line:7.3f} um, held spring {1e6 * spring:10.3f} um, of {1e6 * size:.2f} um"
        )
