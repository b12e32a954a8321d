"""Temperatures of a running bearing: a thermal network of five nodes around the FMU.

The FMU says where power becomes heat (loss.*), the network where the heat goes, and the temperatures go back into the
FMU: viscosity, clearances, fits. Motion settles in milliseconds and heat in minutes, so each run takes 40 ms of motion,
whose mean losses hold until the temperatures have moved.

    python examples/heat/network.py          # to the steady state; --march for the way there, hours of motion left out
"""

import sys
from pathlib import Path

import fmpy
import numpy as np

FMU = Path(__file__).resolve().parents[2] / "fmus" / "RivetedBearing.fmu"
# and their inputs
NODES = {"inner ring": "ring.T_i", "outer ring": "ring.T_e", "balls": "ball.T", "cage": "cage.T", "oil": "oil.T"}
SHARES = {  # of each loss, on the nodes: films heat both sides alike
    "races": (0.25, 0.25, 0.5, 0.0, 0.0), "ball_drag": (0, 0, 0, 0, 1.0), "cage_drag": (0, 0, 0, 0, 1.0), "ring_drag": (0, 0, 0, 0, 1.0),
    "land": (0.0, 0.5, 0.0, 0.5, 0.0), "pockets": (0, 0, 0.5, 0.5, 0), "joints": (0, 0, 0, 1.0, 0),
}  # fmt: skip
# conductances between nodes [W/K], assumed
LINKS = {(0, 2): 6.0, (1, 2): 6.0, (0, 4): 4.0, (1, 4): 5.0, (2, 4): 4.0, (3, 4): 5.0, (1, 3): 2.0}
# conductances outward [W/K], oil supply and surroundings [K], assumed
HOUSING, SHAFT, SUPPLY, AROUND = 2.0, 1.0, 353.15, 313.15
FLOW = 8.3e-6 * 900.0 * 2000.0  # heat capacity of half a litre of oil a minute [W/K]
CAPACITY = np.array([45.0, 75.0, 25.0, 25.0, 15.0])  # of the nodes [J/K]

G = np.diag([SHAFT, HOUSING, 0.0, 0.0, FLOW])  # G T = losses + INFLOW in the steady state
for (i, k), conductance in LINKS.items():
    G[[i, k, i, k], [i, k, k, i]] += conductance * np.array([1.0, 1.0, -1.0, -1.0])
INFLOW = np.array([SHAFT * AROUND, HOUSING * AROUND, 0.0, 0.0, FLOW * SUPPLY])


def heat(T, unzipped):
    """Heat into each node [W] at the temperatures T [K]: means over the last 20 ms of a run."""
    # films lie between oil and steel
    start = dict(zip(NODES.values(), T, strict=True)) | {"oil.T": T[[0, 1, 2, 4]].mean(), "oil.flow": 8.3e-6}
    names = [f"loss.{part}" for part in SHARES]
    run = fmpy.simulate_fmu(
        unzipped, stop_time=0.04, step_size=1e-4, output_interval=1e-4, start_values=start, output=names
    )
    return sum(
        run[name][run["time"] > 0.02].mean() * np.array(share)
        for name, share in zip(names, SHARES.values(), strict=True)
    )


def network(unzipped, march=False, T=SUPPLY, step=5.0, end=600.0):
    """Temperatures [K], heat into the nodes [W] and number of runs: to the steady state, or step by step [s] to `end`."""
    T, runs, moved = np.full(5, T), 0, np.inf
    inertia = march * CAPACITY / step
    while runs < round(end / step) if march else moved > 0.1 and runs < 30:
        P = heat(T, unzipped)
        before, T = T, np.linalg.solve(np.diag(inertia) + G, P + INFLOW + inertia * T)
        runs, moved = runs + 1, np.abs(T - before).max()
    return T, P, runs


if __name__ == "__main__":
    T, P, runs = network(fmpy.extract(str(FMU)), "--march" in sys.argv)
    print(
        "\n".join(f"{name:11} {t - 273.15:6.1f} degC {p:6.1f} W" for name, t, p in zip(NODES, T, P, strict=True)),
        f"\n{runs} runs of 40 ms",
    )
