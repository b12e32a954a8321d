"""docs/paper.md: the page about the paper's study, which `riveted-bearing study` makes from the runs."""

from pathlib import Path

import numpy as np

from ..results import write_atomically
from .claims import all_claims
from .study import PICTURES, draw, estimate, ratio, shipped_studies

INTRODUCTION = """# The paper's study, again

<!-- Written by `riveted-bearing study --report docs`: do not edit. -->

Cui et al., *Study on Fatigue Characteristics of Rivets in Bearing Cage for an Aeroengine Transmission System*, Machines 2023, 11, 700: Figs. 10 to 18 with
this model, and each claim of the paper's section 4 and of its conclusions. The paper's clearances, conformities, oil, masses, friction and support of the
ring are not published; [parameters.md](parameters.md) gives those of this model with their sources, and none leaves its documented range here. The scenes
`demo`, `R` and `F` were chosen once, before this model had its load path and head friction, and have not been changed since. Preload, fit and load are the
paper's; the sweeps are in `riveted_bearing/data/studies/`.

- Curves are means over seeds; bands and brackets are the 95 % confidence interval of the mean (Student's t). A seed sets the initial spacing of the balls,
  and impacts come at twelve phases, one for each seed. Where balls press on their pockets all the time (R and F at low speed) all seeds end
  on one periodic motion: the band closes then, and says nothing about other motions.
- **Stress** is given three ways, because the paper does not say which stress it means: the mean over time of the worst rivet at each instant, its 99.9 %
  quantile over every internal step (total stress), and the dynamic range of a single rivet (its 99.9 % quantile minus the 0.1 % quantile of samples every 0.1
  ms, of the rivet with the largest range), on which fatigue depends and in which the preload has no share. Head: largest principal stress in the fillet;
  middle: von Mises stress at the split.
- These figures depend on conditions that the paper leaves open, each of which is varied below: the direction of a tilt against the loads (Fig. 15), the
  support of the ring (Figs. 13 and 14), the local bending of the cage halves (Fig. 13), the clearances (Fig. 16), and how the two halves share a pocket force
  (beside Fig. 10).
- The cage halves are rigid in their motion (`scene.cage = two_half`), because the paper's equations move each half as a rigid body. What
  elastic halves, the default elsewhere, make of the same sweeps stands [below](#with-elastic-halves).
- Rivets are elastic here: a figure beyond yield (590 MPa, assumed) tells how far the load exceeds yield, not the stress.
- **Verdict**: *reproduced* if all conditions of a claim hold with their confidence, *partly* if some do, *not* if none does. The conditions are in
  `riveted_bearing/data/claims.toml`.
"""


def write_paper(data, folder, elastic=None):
    """Write paper.md and its pictures into a folder from the Runs by name; elastic: those with elastic halves.  Returns
    the file's path.
    """
    folder = Path(folder)
    claims = all_claims(data)
    pictures = draw(data, folder / "paper")
    parts = [INTRODUCTION, summary_text(claims)]
    parts += [picture_text(name, path.relative_to(folder), claims.get(name, ())) for name, path in pictures.items()]
    parts += [elastic_text(claims, elastic)] if elastic else []
    parts += [centrifugal_text(data["centrifugal"])] if "centrifugal" in data else []
    parts += [tolerance_text(data["tolerance"])] if "tolerance" in data else []
    parts.append(cost_text(data, claims.get("cost", ())))
    path = folder / "paper.md"
    write_atomically(path, lambda temporary: temporary.write_text("\n".join(parts), encoding="utf-8"))
    return path


def summary_text(claims):
    """The verdicts, after their count."""
    every = [claim for of_picture in claims.values() for claim in of_picture]
    count = {
        verdict: sum(claim.verdict == verdict for claim in every) for verdict in ("reproduced", "partly", "**not**")
    }
    lines = [
        "## Verdicts",
        "",
        f"Of {len(every)} claims {count['reproduced']} are reproduced, {count['partly']} partly, {count['**not**']} not.",
        "",
    ]
    lines += ["| section | the paper says | verdict |", "|---|---|---|"]
    lines += [f"| {claim.where} | {claim.said} | {claim.verdict} |" for claim in every]
    return "\n".join(lines) + "\n"


def picture_text(name, path, claims):
    """A picture under its heading, and the claims it shows."""
    title = PICTURES[name][1]
    return f"## {title}\n\n![{title}]({path.as_posix()})\n" + ("\n" + details_text(claims) if claims else "")


def details_text(claims):
    """Each claim with its verdict, the figures of the runs, and the reason."""
    text = "".join(
        f"- **{claim.said}** ({claim.where}): {claim.verdict}.\n  - Here: {claim.found}\n  - Why: {claim.why}\n"
        for claim in claims
    )
    return text.replace("Here: \n", "Here:\n")


def elastic_text(claims, data):
    """Verdicts with elastic halves beside those with rigid ones, and the figures wherever the two differ."""
    bent = all_claims(data)
    pairs = [
        (rigid, soft) for name in claims if name in bent for rigid, soft in zip(claims[name], bent[name], strict=True)
    ]
    count = {
        verdict: sum(soft.verdict == verdict for _, soft in pairs) for verdict in ("reproduced", "partly", "**not**")
    }
    lines = [
        "## With elastic halves",
        "",
        "The same sweeps with `scene.cage = elastic`: pockets' walls give way to an impact, joints ring and carry what the motion gives them. "
        f"Of {len(pairs)} claims {count['reproduced']} are reproduced, {count['partly']} partly, {count['**not**']} not. What preload, fit and load do shows "
        "more clearly, because the impacts' share of the 99.9 % quantiles is smaller. Both verdicts, and the figures of elastic halves where they differ:",
        "",
        "| section | the paper says | rigid halves | elastic halves |",
        "|---|---|---|---|",
        *(f"| {rigid.where} | {rigid.said} | {rigid.verdict} | {soft.verdict} |" for rigid, soft in pairs),
        "",
        *(f"- **{soft.said}** ({soft.where}): {soft.found}" for rigid, soft in pairs if rigid.verdict != soft.verdict),
    ]
    return "\n".join(lines) + "\n"


def centrifugal_text(runs):
    """Stress, damage and dislocation with and without the cage's centrifugal load, point by point."""
    names = {
        "head": "head, mean",
        "head_peak": "head, 99.9 %",
        "head_range": "head, dynamic range",
        "mid": "middle, mean",
        "mid_peak": "middle, 99.9 %",
        "dislocation_max": "largest dislocation",
    }
    lines = [
        "## With and without the cage's centrifugal load",
        "",
        "The paper does not say whether its model has the centrifugal load of the cage halves (`cage.centrifugal`). Scene `demo`, stress in MPa, dislocation "
        "in µm, damage of the worst head per hour as its power of ten; each field: with / without. The load bends each half outward between its joints and so "
        "pries at every rivet all the time, in proportion to the speed squared: the mean of the stress has it, and impacts act on joints that it has loaded.",
        "",
        "| preload | fit | r/min | tilt | " + " | ".join(names.values()) + " | damage |",
        "|---" * (5 + len(names)) + "|",
    ]
    points = np.unique(np.array([runs[name] for name in ("preload", "fit", "speed", "tilt")]).T, axis=0)
    for preload, fit, speed, tilt in points:
        at = runs.at(preload=preload, fit=fit, speed=speed, tilt=tilt)
        ways = [at.at(centrifugal=way) for way in ("on", "off")]
        fields = [" / ".join(str(way.estimate(name)) for way in ways) for name in names]
        damage = " / ".join(f"{way.estimate('head_damage').mean:.1f}" for way in ways)
        lines.append(
            f"| {preload:.0f} N | {fit:+.0f} µm | {speed:,.0f} | {tilt:+.1f}° | "
            + " | ".join(fields)
            + f" | {damage} |"
        )
    return "\n".join(lines) + "\n"


def tolerance_text(runs):
    """Statistics at each tolerance against those at the tightest one."""
    tight, *looser = np.unique(runs["tolerance"])
    names = {"force": "mean force", "head": "head, mean", "head_peak": "head, 99.9 %", "mid_peak": "middle, 99.9 %"}
    lines = [
        "## Tolerance",
        "",
        f"Change of the statistics, in percent, from the tolerance of the line to {tight:g}, under the heavy load, with the confidence interval over seeds. "
        "The speed study runs at 1e-4, all others at the default of 1e-3.",
        "",
    ]
    lines += ["| scene | r/min | tolerance | " + " | ".join(names.values()) + " |", "|---" * (3 + len(names)) + "|"]
    for scene in np.unique(runs["scene"]):
        for speed in np.unique(runs["speed"]):
            at = runs.at(scene=scene, speed=speed)
            for tolerance in looser[::-1]:
                changes = [ratio(at.at(tolerance=tight), at.at(tolerance=tolerance), name) for name in names]
                lines.append(
                    f"| {scene} | {speed:,.0f} | {tolerance:g} | " + " | ".join(percent(e) for e in changes) + " |"
                )
    return "\n".join(lines) + "\n"


def percent(e):
    """An Estimate of a ratio as a change in percent."""
    return f"{100 * (e.mean - 1):+.2f} [{100 * (e.low - 1):+.2f}, {100 * (e.high - 1):+.2f}]"


def cost_text(data, claims):
    """Processor time by sweep, and the claim about it."""
    about = (
        "Processor time of all runs with their start, on one core of the machine that made this page; "
        "starting the workers, collecting the rows and drawing come on top."
    )
    lines = ["## What it costs", "", about, ""]
    lines += [
        "| sweep | figure | seeds | runs | simulated | processor time | per simulated second |",
        "|---|---|---|---|---|---|---|",
    ]
    figures = {
        name: ", ".join(title.split(":")[0] for needed, title, _ in PICTURES.values() if name in needed)
        for name in shipped_studies()
    }
    total = sum(runs["whole_cpu_time"].sum() for runs in data.values())
    for name, runs in data.items():
        spent, simulated = runs["whole_cpu_time"].sum(), runs["simulated"].sum()
        per = estimate(runs["cpu_time"] / runs["simulated"]).mean
        lines.append(
            f"| {name} | {figures[name] or 'beside all'} | {len(np.unique(runs['seed']))} | {len(runs)} | {simulated:.1f} s "
            f"| {spent:.0f} s ({100 * spent / total:.0f} %) | {per:.2f} s |"
        )
    lines.append(
        f"| **all** | | | {sum(map(len, data.values()))} | {sum(runs['simulated'].sum() for runs in data.values()):.0f} s | **{total:.0f} s** | |"
    )
    lines += ["", f"On two cores that is {total / 120:.1f} min."]
    return "\n".join(lines) + "\n\n" + details_text(claims)
