"""Real-time factor through fmpy: default settings, 1e-4 s communication steps, peak stress of all rivets read at each.

The scenes take turns, and the least of several rounds counts, because other users of the machine only add time.
(work_precision.py, which takes the better part of an hour, cannot repeat its rounds.)
"""

from common import SCENES, options, say, write

from riveted_bearing import run

OUTPUTS = ["rivet[*].sigma_head_peak", "rivet[*].sigma_mid_peak", "cage.F_pocket_peak"]
STEP, SPAN, ROUNDS = 1e-4, 0.4, 7  # [s], [s], 1
CAGES = "elastic", "two_half"  # the default first


def measure(name, cage, span):
    """Processor time per simulated time, in all and inside the FMU, and evaluations of the right-hand side."""
    _, shipped, changes = SCENES[name]
    parameters = changes.get("parameters", {}) | {"scene.cage": cage, "solver.clock": "on"}
    summary = run(shipped, **changes | {"parameters": parameters}, t_end=span, step=STEP, outputs=OUTPUTS).summary
    span = summary["simulated_time"]
    return {
        "rtf": summary["real_time_factor"],
        "inside": summary["solver.cpu_time"] / span,
        "evals": summary["solver.rhs_evals"] / span,
    }


def main():
    short = options(__doc__).short
    cases = [(cage, name) for name in SCENES for cage in CAGES]
    rounds = [
        {case: measure(case[1], case[0], 0.1 if short else SPAN) for case in cases}
        for _ in range(3 if short else ROUNDS)
    ]
    best = {case: min((found[case] for found in rounds), key=lambda figures: figures["rtf"]) for case in cases}
    for (cage, name), figures in best.items():
        slowest = max(found[cage, name]["rtf"] for found in rounds)
        say(
            f"{name}, {cage}: RTF {figures['rtf']:.2f} (slowest round {slowest:.2f}), inside the FMU {figures['inside']:.2f}"
        )
    cages = {cage: {name: best[cage, name] for name in SCENES} for cage in CAGES}
    write("rtf", {"rounds": len(rounds), "cages": cages}, short)


if __name__ == "__main__":
    main()
