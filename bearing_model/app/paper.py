"""docs/paper.md: what comes of the paper's study, made from the runs by `riveted-bearing study`."""

from pathlib import Path

import numpy as np

from .claims import all_claims
from .results import write_atomically
from .study import PICTURES, draw, estimate, ratio, shipped_studies

INTRODUCTION = """# The paper's study, again

<!-- Written by `riveted-bearing study --report docs`: do not edit. -->

Cui et al., *Study on Fatigue Characteristics of Rivets in Bearing Cage for an Aeroengine Transmission System*, Machines 2023, 11, 700: Figs. 10 to 18 with this
model, and each claim of the paper's section 4 and of its conclusions. The paper's clearances, conformities, oil, masses, friction and support of the ring are
not published; ours are in [parameters.md](parameters.md), each with its source, and none leaves its documented range here. The scenes `demo`, `R` and `F` were
chosen once, before this model had its load path and head friction, and not again. Preload, fit and load are the paper's; the sweeps stand in
`bearing_model/data/studies/`.

- Curves are means over seeds, bands and brackets the 95 % confidence interval of the mean (Student's t). A seed changes the balls' first spacing; the impacts
  come at twelve phases besides. Where balls press on their pockets all the time (R and F at low speed) all seeds end on one periodic motion: the band closes,
  and says nothing about other motions.
- **Stress** is given three ways, because the paper does not say which it means: the mean over time of the worst rivet at each instant, its 99.9 % quantile over
  every internal step (total stress), and the dynamic range of a single rivet (its 99.9 % quantile minus the 0.1 % quantile of samples every 0.1 ms, of the
  rivet where that is largest): what fatigue sees, without the preload's share. Head: largest principal stress in the fillet; middle: von Mises at the split.
- **Verdict**: *reproduced* if all conditions of a claim hold with their confidence, *partly* if some do, *not* if none does. The conditions are in
  `bearing_model/app/claims.py`.
"""


def write_paper(data, folder):
    """Write paper.md and its pictures into a folder from the Runs by name; returns the file's path."""
    folder = Path(folder)
    pictures = draw(data, folder / "paper")
    parts = [INTRODUCTION, claims_text(all_claims(data)), *(picture_text(name, path, folder) for name, path in pictures.items())]
    parts += [tolerance_text(data["tolerance"])] if "tolerance" in data else []
    parts.append(cost_text(data))
    path = folder / "paper.md"
    write_atomically(path, lambda temporary: temporary.write_text("\n".join(parts), encoding="utf-8"))
    return path


def claims_text(claims):
    """The table of claims, after their count."""
    count = {verdict: sum(claim.verdict == verdict for claim in claims) for verdict in ("reproduced", "partly", "**not**")}
    lines = ["## Claim by claim", "", f"Of {len(claims)} claims {count['reproduced']} are reproduced, {count['partly']} partly, {count['**not**']} not.", ""]
    lines += ["| section | the paper says | here | verdict | why |", "|---|---|---|---|---|"]
    lines += [f"| {claim.where} | {claim.said} | {claim.found} | {claim.verdict} | {claim.why} |" for claim in claims]
    return "\n".join(lines) + "\n"


def picture_text(name, path, folder):
    """A picture under its heading."""
    return f"## {PICTURES[name][1]}\n\n![{PICTURES[name][1]}]({path.relative_to(folder).as_posix()})\n"


def tolerance_text(runs):
    """Statistics at the tolerance in use against those at a tenth of it."""
    tight, used = np.unique(runs["tolerance"])
    names = {"force": "mean force", "head": "head, mean", "head_peak": "head, 99.9 %", "mid_peak": "middle, 99.9 %"}
    lines = [
        "## Tolerance",
        "",
        f"Change from tolerance {used:g}, the one in use, to {tight:g}, in percent, for the heavy load, with the confidence interval over seeds.",
        "",
    ]
    lines += ["| scene | r/min | " + " | ".join(names.values()) + " |", "|---" * (2 + len(names)) + "|"]
    for scene in np.unique(runs["scene"]):
        for speed in np.unique(runs["speed"]):
            at = runs.at(scene=scene, speed=speed)
            changes = [ratio(at.at(tolerance=tight), at.at(tolerance=used), name) for name in names]
            lines.append(
                f"| {scene} | {speed:,.0f} | "
                + " | ".join(f"{100 * (e.mean - 1):+.2f} [{100 * (e.low - 1):+.2f}, {100 * (e.high - 1):+.2f}]" for e in changes)
                + " |"
            )
    return "\n".join(lines) + "\n"


def cost_text(data):
    """Processor time by sweep."""
    lines = ["## What it costs", "", "Processor time of all runs with their start, on one core of the machine that made this page.", ""]
    lines += ["| sweep | figure | seeds | runs | simulated | processor time | per simulated second |", "|---|---|---|---|---|---|---|"]
    figures = {name: ", ".join(title.split(":")[0] for needed, title, _ in PICTURES.values() if name in needed) for name in shipped_studies()}
    total = sum(runs["whole_cpu_time"].sum() for runs in data.values())
    for name, runs in data.items():
        spent, simulated = runs["whole_cpu_time"].sum(), runs["simulated"].sum()
        per = estimate(runs["cpu_time"] / runs["simulated"]).mean
        lines.append(
            f"| {name} | {figures[name] or 'beside Fig. 13'} | {len(np.unique(runs['seed']))} | {len(runs)} | {simulated:.1f} s "
            f"| {spent:.0f} s ({100 * spent / total:.0f} %) | {per:.2f} s |"
        )
    lines.append(f"| **all** | | | {sum(map(len, data.values()))} | {sum(runs['simulated'].sum() for runs in data.values()):.0f} s | **{total:.0f} s** | |")
    lines += ["", f"On two cores that is {total / 120:.1f} min."]
    return "\n".join(lines) + "\n"
