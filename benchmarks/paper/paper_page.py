"""paper.md: the page about the paper's study, which study.py makes from the runs.  The text stands in
../pages/paper.md; the functions here return the numbers in it.
"""

import re
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
from claims import MEASURES, all_claims, number_of_claims, numbers
from figures import (
    BESIDE,
    CLEARANCES,
    LOADS,
    PICTURES,
    SCATTER,
    T_S,
    clearance_series,
    draw,
    estimate,
    ratio,
    shipped_studies,
)
from scipy.stats import norm

from riveted_bearing.base.files import write_atomically

sys.path.insert(0, str(Path(__file__).parents[1]))

from pages import page_text

SEEDS = 8  # of each point, from which on half of them have a verdict
MARKS = {"reproduced": "●", "partly": "◐", "not": "○"}


def write_paper(columns, folder, settings=(), command="study.py --report benchmarks/paper"):
    """Write paper.md and its pictures into a folder from the columns {column: {sweep: Runs}}; settings: of the column
    `yours`, for the page; command: of this folder, which the page names as its author.  Returns the file's path.
    """
    folder = Path(folder)
    judged = judge(columns)
    pictures = draw(columns, folder / "paper")
    data = columns.get("paper", {})
    found = {column: numbers(runs) for column, runs in columns.items() if runs}
    of_conflicts = {"rings_speed", "rings_clearance", "speed", "clearance", "tilt"}
    values = introduction(columns, judged, pictures, command) | {
        "settings": settings,
        "columns": list(judged),
        "verdicts": verdicts(judged),
        "by_seeds": by_seeds(columns),
        "flips": flips(judged),
        "number_columns": list(found),
        "numbers": [(*rows[0][:2], *(row[2] for row in rows)) for rows in zip(*found.values(), strict=True)],
        "conflicts": conflicts(data) if of_conflicts <= set(data) else None,
        "fretting": fretting(data["fretting"]) if "fretting" in data else None,
        "pictures": [
            (PICTURES[name][1], path.relative_to(folder).as_posix(), details(name, judged))
            for name, path in pictures.items()
        ],
        "tolerance": tolerance(data["tolerance"]) if "tolerance" in data else None,
        "cost": cost(columns),
    }
    path = folder / "paper.md"
    text = page_text("paper.md", values)
    write_atomically(path, lambda temporary: temporary.write_text(text, encoding="utf-8"))
    return path


def introduction(columns, judged, pictures, command):
    """Values of the page's first part, which says on top how much of the study was run if it was not all of it."""
    return {
        "command": command,
        "part": part(columns, judged),
        "figures": figures_text(pictures),
    }


def part(columns, judged):
    """Claims judged and seeds of a study that has not all of them, None for a whole one."""
    seeds = min((seeds_of(data) for data in columns.values() if set(data) - set(BESIDE)), default=0)
    whole = number_judged(judged) == number_of_claims() and seeds >= SEEDS
    return None if whole else {"claims": of_all(judged), "seeds": seeds}


def number_judged(judged):
    """Number of claims that have a verdict in a column."""
    return max((len(every(claims["mean"])) for claims in judged.values()), default=0)


def of_all(judged):
    """The claims judged of all claims, in words."""
    return f"{number_judged(judged)} of the paper's {number_of_claims()} claims"


def figures_text(pictures):
    """The paper's figures that pictures show: "Figs. 10, 11 and 15", "Figs. 10 to 18" if there is none missing between."""
    found = sorted(int(number) for name in pictures for number in re.findall(r"\d+", PICTURES[name][1].split(":")[0]))
    if len(found) < 2:
        return f"Fig. {found[0]}" if found else "no figure"
    if len(found) > 2 and found == list(range(found[0], found[-1] + 1)):
        return f"Figs. {found[0]} to {found[-1]}"
    return f"Figs. {', '.join(map(str, found[:-1]))} and {found[-1]}"


def judge(columns):
    """Claims by column, measure and picture."""
    return {
        column: {measure: all_claims(data, measure) for measure in MEASURES} for column, data in columns.items() if data
    }


def every(of_picture):
    """All claims of all pictures."""
    return [claim for claims in of_picture.values() for claim in claims]


def count(verdicts):
    """Numbers of claims reproduced, partly, not."""
    verdicts = list(verdicts)
    return tuple(verdicts.count(verdict) for verdict in MARKS)


def counted(columns):
    """The counts as lines of text."""
    return [
        f"{column}, {measure}: {r} reproduced, {p} partly, {n} not"
        for column, of_measure in judge(columns).items()
        for measure, claims in of_measure.items()
        for r, p, n in [count(claim.verdict for claim in every(claims))]
    ]


def verdicts(judged):
    """The counts before and after the repair of the conditions, and the verdicts claim by claim."""
    whole = number_judged(judged) == number_of_claims()
    counts = [(column, count(claim.verdict for claim in every(claims["mean"]))) for column, claims in judged.items()]
    rows = []
    for column, of_measure in judged.items():
        rows.append((column, "before, mixed", *count(claim.verdict_before for claim in every(of_measure["mean"]))))
        rows += [(column, name, *count(c.verdict for c in every(claims))) for name, claims in of_measure.items()]
    claim_rows = []
    for claims in zip(
        *(every(claims) for of_measure in judged.values() for claims in of_measure.values()), strict=True
    ):
        marks = []
        for i, claim in enumerate(claims):
            marks += [MARKS[claim.verdict_before]] if i % len(MEASURES) == 0 else []
            marks += [MARKS[claim.verdict]]
        claim_rows.append((claims[0].where, claims[0].said, *marks))
    return {
        "claims": f"the paper's {number_of_claims()} claims" if whole else of_all(judged),
        "counts": counts,
        "rows": rows,
        "columns": [f"{column}: {name}" for column in judged for name in ("before", *MEASURES)],
        "claim_rows": claim_rows,
    }


def half_of(runs, half):
    """The runs of the first (0) or second (1) half of the seeds; a middle one of an odd number is in neither."""
    seeds = np.unique(runs["seed"])
    size = len(seeds) // 2
    chosen = np.isin(runs["seed"], seeds[:size] if half == 0 else seeds[-size:])
    return replace(runs, columns={name: values[chosen] for name, values in runs.columns.items()})


def seeds_of(data):
    """Number of seeds of each point, in the figure's sweep that has the fewest."""
    return min(len(np.unique(runs["seed"])) for name, runs in data.items() if name not in BESIDE)


def depending_on_seeds(data):
    """Claims of a column whose verdict in mean stress differs between the two halves of the seeds: [(said, verdict of
    the first half, of the second, of all)].
    """
    halves = [every(all_claims({name: half_of(runs, half) for name, runs in data.items()}, "mean")) for half in (0, 1)]
    return [
        (both.said, first.verdict, second.verdict, both.verdict)
        for first, second, both in zip(*halves, every(all_claims(data, "mean")), strict=True)
        if first.verdict != second.verdict
    ]


def by_seeds(columns):
    """Column, seeds and the claims whose verdict depends on them; None for these if there are too few seeds: a half
    needs four to have a verdict.
    """
    return [
        (column, seeds, None if seeds < SEEDS else depending_on_seeds(data))
        for column, data in columns.items()
        if set(data) - set(BESIDE)
        for seeds in [seeds_of(data)]
    ]


def flips(judged):
    """Claims whose verdict in mean stress the repair of the condition changed, each with the reason."""
    return [
        (claims[0].said, *(f"{MARKS[c.verdict_before]} → {MARKS[c.verdict]}" for c in claims), claims[0].reason)
        for claims in zip(*(every(of_measure["mean"]) for of_measure in judged.values()), strict=True)
        if any(claim.verdict != claim.verdict_before for claim in claims)
    ]


def details(name, judged):
    """Each claim of a picture with (column, measure, verdict, figures) of the runs in mean stress, and in the other
    measures where their verdict differs.
    """
    by_column = [zip(*(claims.get(name, ()) for claims in judged[c].values()), strict=True) for c in judged]
    return [
        (
            same[0][0],
            [
                (column, measure, claim.verdict, claim.found)
                for column, claims in zip(judged, same, strict=True)
                for measure, claim in zip(MEASURES, claims, strict=True)
                if measure == "mean" or claim.verdict != claims[0].verdict
            ],
        )
        for same in zip(*by_column, strict=True)
    ]


def spreads(runs, speeds):
    """Difference of the mean head stress between the heavy and the light load over the lesser one, at some speeds."""
    found = []
    for speed in speeds:
        means = [runs.at(speed=speed, F_r=F_r).estimate("head").mean for F_r in (max(LOADS), min(LOADS))]
        found.append(np.ptp(means) / min(means))
    return found


def least_ratio(runs):
    """Clearance ratio at constant sum with the least mean head stress, and the rise toward both ends [MPa]."""
    xs, estimates = clearance_series(runs, next(iter(CLEARANCES))).curve("ratio", "head")
    means = np.array([e.mean for e in estimates])
    return xs[means.argmin()], means[0] - means.min(), means[-1] - means.min()


def conflicts(data):
    """Pairs of claims that no single bearing meets, and a claim that no elastic rivet meets."""
    held = {"stiff ring (2e4 N.m/rad)": "supported", "straight ring": "prescribed"}
    by_speed, by_clearance = data["rings_speed"], data["rings_clearance"]
    rings = {"free ring": data["speed"], "free ring, centrifugal load": by_speed.at(centrifugal="on")}
    rings |= {name: by_speed.at(centrifugal="off", tilt_mode=mode) for name, mode in held.items()}
    speeds = np.unique(by_speed["speed"])
    ratios = {"free ring": data["clearance"]} | {name: by_clearance.at(tilt_mode=mode) for name, mode in held.items()}
    light, heavy = (data["tilt"].at(tilt=tilt) for tilt in (-0.2, -0.5))
    return {
        "speeds": [f"{speed:,.0f} r/min" for speed in speeds],
        "spreads": [
            (name, *(f"{value:.2f}" for value in spreads(runs, speeds)), falls_first(runs, speeds))
            for name, runs in rings.items()
        ],
        "ratios": [
            (name, f"{best:g}", f"{left:.1f}", f"{right:.1f}")
            for name, runs in ratios.items()
            for best, left, right in [least_ratio(runs)]
        ],
        "rest": light.estimate("head_rest").mean,
        "at_02": light.estimate("head").mean,
        "at_05": heavy.estimate("head").mean,
    }


def falls_first(runs, speeds):
    """Whether the mean head stress at the first speed is above that at another one, for the heavy and the light load."""
    means = [[runs.at(F_r=F_r, speed=v).estimate("head").mean for v in speeds] for F_r in (max(LOADS), min(LOADS))]
    return " / ".join("yes" if np.argmin(row) > 0 else "no" for row in means)


def fretting(runs):
    """Damage of head and middle over the fretting strength reduction, and the share of rivets that break in the middle."""
    factors = np.unique(runs["fretting"])
    rivets = sum(name.startswith("mid_damage_") for name in runs.columns)
    decades, rows = [], []
    for factor in factors:
        at = runs.at(fretting=factor)
        apart = np.array([at[f"mid_damage_{k}"] - at[f"head_damage_{k}"] for k in range(1, rivets + 1)])
        share = estimate(norm.cdf(apart / (np.sqrt(2.0) * SCATTER)).mean(axis=0))
        decades.append(apart.mean())
        head, mid = (at.estimate(f"{place}_damage").mean for place in ("head", "mid"))
        rows.append((f"{factor:g}", f"{head:.1f}", f"{mid:.1f}", f"{rivets * share.mean:.1f}"))
    seven = (
        np.sqrt(2.0) * SCATTER * norm.ppf(7.0 / 9.0)
    )  # decades between the places at which seven of nine break in the middle
    usual = runs.at(fretting=1.0)
    return {
        "head": usual.estimate("head_range").mean,
        "mid": usual.estimate("mid_range").mean,
        "rivets": rivets,
        "T_S": T_S,
        "rows": rows,
        "needed": np.interp(seven, decades, factors) if decades[0] < seven < decades[-1] else np.nan,
        "largest": factors[-1],
        "slip": usual.estimate("slip"),
    }


def tolerance(runs):
    """Statistics at each tolerance against those at the tightest one."""
    tight, *looser = np.unique(runs["tolerance"])
    names = {"force": "mean force", "head": "head, mean", "head_peak": "head, 99.9 %", "mid_peak": "middle, 99.9 %"}
    rows = []
    for speed in np.unique(runs["speed"]):
        at = runs.at(speed=speed)
        for loose in looser[::-1]:
            changes = (ratio(at.at(tolerance=tight), at.at(tolerance=loose), name) for name in names)
            rows.append((f"{speed:,.0f}", f"{loose:g}", *map(percent, changes)))
    return {"tight": tight, "columns": list(names.values()), "rows": rows}


def percent(e):
    """An Estimate of a ratio as a change in percent."""
    return f"{100 * (e.mean - 1):+.2f} [{100 * (e.low - 1):+.2f}, {100 * (e.high - 1):+.2f}]"


def cost(columns):
    """Processor time by column and sweep."""
    figures = {
        name: ", ".join(title.split(":")[0] for needed, title, _ in PICTURES.values() if name in needed)
        for name in shipped_studies()
    }
    all_runs = [(column, name, runs) for column, data in columns.items() for name, runs in data.items()]
    total = sum(runs["whole_cpu_time"].sum() for *_, runs in all_runs)
    simulated = sum(runs["simulated"].sum() for *_, runs in all_runs)
    rows = []
    for column, name, runs in all_runs:
        spent = runs["whole_cpu_time"].sum()
        rows.append(
            (
                column,
                name,
                figures[name] or "beside all",
                len(np.unique(runs["seed"])),
                len(runs),
                f"{runs['simulated'].sum():.1f} s",
                f"{spent:.0f} s ({100 * spent / total:.0f} %)",
                f"{estimate(runs['cpu_time'] / runs['simulated']).mean:.2f} s",
            )
        )
    return {"rows": rows, "runs": sum(len(runs) for *_, runs in all_runs), "simulated": simulated, "total": total}
