"""A ribbon cage beside a machined one in motion, the tables of docs/cages.md:

    riveted-bearing build --bearing 6309 --cage ribbon --out FOLDER/6309-ribbon.fmu      and machined, 6205, 6316
    python benchmarks/cages.py FOLDER                        all three at the limit of speed and at twice it
    python benchmarks/cages.py FOLDER --over                 the 6309 over speed and tilt
    python benchmarks/cages.py FOLDER --oil                  the 6309 with oil in its pockets

Loads are the rule's, C/10 and a sixth of it along the axis; both cages of a row take turns, so that other users of the
machine slow both.  Means over the seeds, and half of what lies between the least and the largest seed.
"""

import argparse
from pathlib import Path

import numpy as np

from riveted_bearing import run

LIMIT = 480_000 / 0.7  # n d_m [mm/min], the usual limit with grease of which scaling.py takes 70 %
PITCH = {"6205": 38.5, "6309": 72.5, "6316": 125.0}  # d_m by rule [mm]
CAGES = "ribbon", "machined"
OVER = (3000, 6620, 9460, 18920)  # r/min
TILTS = (0.0, 0.1, 0.2)  # deg
OIL = [(rpm, tilt) for rpm in (6620, 9460) for tilt in (0.0, 0.2)]  # r/min, deg
FILLINGS = 0.0, 0.1, 1.0
TURNS = 40.0  # of the shaft after the start has settled
LEAST = 0.1  # s


def measure(folder, bearing, cage, rpm, tilt, seed, settle, filling=0.0):
    """Figures of one run: stress [MPa], force [N], damage of the worst place [1/h], real-time factor, whether it ended."""
    span = max(60.0 * TURNS / rpm, LEAST)
    found = run(
        fmu=folder / f"{bearing}-{cage}.fmu",
        parameters={"scene.stress": "fatigue", "start.settle": settle, "cage.pocket_filling": filling},
        inputs={"shaft.omega": f"{rpm} rev/min", "shaft.tilt_z": f"{tilt} deg"},
        seed=seed,
        t_end=settle + span,
        outputs=["rivet[*].damage_head", "rivet[*].damage_mid", "event.cage_yield", "event.rivet_yield"],
    )
    s = found.summary
    damage = max(values[-1] for name, values in found.data.items() if ".damage_" in name)
    return {
        "mean": 1e-6 * s["stat.sigma_head_mean"],
        "p999": 1e-6 * s["stat.sigma_head_p999"],
        "rms": s["stat.Q_c_rms"],
        "force": s["stat.Q_c_p999"],
        "largest": s["stat.Q_c_max"],
        "damage": 3600.0 * damage / span,
        "rtf": s["real_time_factor"],
        "ended": not found.stopped,
        "yields": bool(np.max(found.data["event.cage_yield"]) > 0.0),
    }


def line(rows):
    """One line of Markdown: means with their half-ranges; of the damage the decades between which its seeds lie."""

    def cell(name):
        values = np.array([row[name] for row in rows])
        return f"{values.mean():.3g} ± {0.5 * np.ptp(values):.1g}"

    damage = np.log10(np.maximum([row["damage"] for row in rows], 1e-99))
    ended = "" if all(row["ended"] for row in rows) else " stopped"
    yields = " cage yields" if any(row["yields"] for row in rows) else ""
    cells = [cell("mean"), cell("p999"), cell("rms"), cell("force"), f"{max(row['largest'] for row in rows):.3g}"]
    return " | ".join([*cells, f"{damage.min():.1f} to {damage.max():.1f}"]) + ended + yields


def settling(bearing, rpm):
    """15 turns at the rule's speed, and at this one [s]."""
    return max(900.0 * PITCH[bearing] / 480_000.0, 900.0 / rpm)


def with_oil(options):
    """Both cages of the 6309 over the filling of their pockets."""
    for rpm, tilt in OIL:
        for cage in CAGES:
            for filling in FILLINGS:
                rows = [
                    measure(options.folder, "6309", cage, rpm, tilt, seed, settling("6309", rpm), filling)
                    for seed in range(1, options.seeds + 1)
                ]
                print(f"| {filling:g} | {rpm:g} | {tilt:g} | {cage} | {line(rows)} |", flush=True)


def side_by_side(options, cases):
    """Both cages of each bearing, speed and tilt in turns."""
    for bearing, rpm, tilt in cases:
        settle, found = settling(bearing, rpm), {cage: [] for cage in CAGES}
        for seed in range(1, options.seeds + 1):
            for cage in CAGES:
                found[cage].append(measure(options.folder, bearing, cage, rpm, tilt, seed, settle))
        for cage in CAGES:
            print(f"| {bearing} | {rpm:g} | {tilt:g} | {cage} | {line(found[cage])} |", flush=True)
        ratios = [a["rtf"] / b["rtf"] for a, b in zip(*(found[cage] for cage in CAGES), strict=True)]
        means = [np.mean([row["rtf"] for row in found[cage]]) for cage in CAGES]
        print(
            f"  RTF {means[0]:.2f} and {means[1]:.2f}, ratio {np.median(ratios):.2f} ({min(ratios):.2f} to {max(ratios):.2f})"
        )


def main():
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("folder", type=Path)
    kind = parser.add_mutually_exclusive_group()
    kind.add_argument("--over", action="store_true", help="the 6309 over speed and tilt")
    kind.add_argument("--oil", action="store_true", help="the 6309 with oil in its pockets")
    parser.add_argument("--seeds", type=int, default=4)
    options = parser.parse_args()
    first = "filling" if options.oil else "bearing"
    print(
        f"| {first} | r/min | tilt | cage | head mean | head p99.9 | force RMS | force p99.9 | largest | log10 damage/h |"
    )
    if options.oil:
        with_oil(options)
    elif options.over:
        side_by_side(options, [("6309", rpm, tilt) for tilt in TILTS for rpm in OVER])
    else:
        limits = {bearing: round(LIMIT / d_m, -1) for bearing, d_m in PITCH.items()}
        side_by_side(options, [(b, factor * limit, 0.0) for b, limit in limits.items() for factor in (1, 2)])


if __name__ == "__main__":
    main()
