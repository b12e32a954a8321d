"""The oil fails for 50 ms: parameters that change in a run, by fmpy alone.

    python examples/oil_off/oil_off.py [--begin 0.1] [--length 0.05] [--out oil_off.png]

fmpy sets columns of its input array that are tunable parameters as it sets inputs.  Without oil the space between the
rings holds air, the inlets of the races starve and the pockets run at the friction of metal on metal: three values, of
which the last two are assumed.
"""

import argparse
import contextlib
import io
from pathlib import Path

import numpy as np
from fmpy import simulate_fmu

FMU = Path(__file__).resolve().parents[2] / "fmus" / "RivetedBearing.fmu"
OIL = {"oil.rho_mix": 35.0, "oil.K_rs": 3e-8, "cage.mu": 0.05}  # the FMU's start values
NONE = {"oil.rho_mix": 1.2, "oil.K_rs": 3e-7, "cage.mu": 0.2}
OUTPUTS = ("loss.ball_drag", "loss.pockets", "bearing.power_loss", "cage.slip_ratio", "rivet.sigma_head_max")
STEP = 1e-4  # communication step [s]


def signals(begin, length):
    """Values of the parameters over time for fmpy: constant between the rows, which jump at two times."""
    rows = [(0.0, OIL), (begin, OIL), (begin, NONE), (begin + length, NONE), (begin + length, OIL)]
    types = [("time", float), *((name, float) for name in OIL)]
    return np.array([(t, *values.values()) for t, values in rows], dtype=types)


def run(begin=0.1, length=0.05, after=0.1, fmu=FMU, **settings):
    """Outputs over time, from the start to `after` [s] behind the failure."""
    with contextlib.redirect_stdout(io.StringIO()):  # fmpy names every input that has no column
        return simulate_fmu(
            str(fmu),
            stop_time=begin + length + after,
            step_size=STEP,
            output_interval=STEP,
            input=signals(begin, length),
            output=OUTPUTS,
            start_values={"scene.statistics": 1} | settings,
        )


def means(result, begin, length):
    """Mean of each output in the last half of the time before, in and after the failure."""
    t, end = result["time"], result["time"][-1]
    spans = {"before": (0.0, begin), "without oil": (begin, begin + length), "after": (begin + length, end)}
    middles = {name: (0.5 * (first + last), last) for name, (first, last) in spans.items()}
    return {
        name: {output: float(result[output][(t > first) & (t <= last)].mean()) for output in OUTPUTS}
        for name, (first, last) in middles.items()
    }


def picture(result, begin, length, path):
    """Three outputs over time with the failure marked."""
    import matplotlib.pyplot as plt

    figure, axes = plt.subplots(3, sharex=True, figsize=(8, 6), layout="constrained")
    shown = (("loss.ball_drag", 1.0, "drag of the balls, W"), ("cage.slip_ratio", 100.0, "slip of the cage, %"))
    for ax, (name, factor, label) in zip(
        axes, (*shown, ("rivet.sigma_head_max", 1e-6, "head stress, MPa")), strict=True
    ):
        ax.plot(1e3 * result["time"], factor * result[name], lw=0.6)
        ax.axvspan(1e3 * begin, 1e3 * (begin + length), color="0.9")
        ax.set_ylabel(label)
    axes[-1].set_xlabel("time, ms")
    figure.savefig(path, dpi=110)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--begin", type=float, default=0.1, help="of the failure [s]")
    parser.add_argument("--length", type=float, default=0.05, help="of the failure [s]")
    parser.add_argument("--out", type=Path, help="picture to write")
    options = parser.parse_args()
    result = run(options.begin, options.length)
    for name, values in means(result, options.begin, options.length).items():
        print(f"{name:12}", "  ".join(f"{output} {value:.4g}" for output, value in values.items()))
    if options.out:
        picture(result, options.begin, options.length, options.out)


if __name__ == "__main__":
    main()
