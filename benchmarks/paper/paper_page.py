"""docs/paper.md: the page about the paper's study, which study.py makes from the runs."""

import re
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

INTRODUCTION = """# The paper's study, again

<!-- Written by `python benchmarks/paper/{command}`: do not edit. -->
{part}
Cui et al., *Study on Fatigue Characteristics of Rivets in Bearing Cage for an Aeroengine Transmission System*, Machines 2023, 11, 700: {figures} with
this model, and each claim of the paper's section 4 and of its conclusions, in two scenes.

| scene | is | column |
|---|---|---|
| `paper` | the paper's equations as they read: a free inner ring (3.4), rigid halves without centrifugal load (3.3), mixed lubrication | paper |
| `physical` | the same bearing with the centrifugal load of the halves, which are elastic | physical |

The paper's clearances, conformities, oil, masses and friction are not published. {parameters} gives those of this model with their
sources. Both scenes have one set of them for all figures, and none is fitted to the paper's results: a search over thirteen of them on Figs. 10, 11 and 13
gained nothing on the other claims. Only Fig. 15 prescribes the ring's tilt, because the figure gives the angle. The sweeps are in
`benchmarks/paper/studies/`.

- Curves are means over seeds; bands and brackets are the 95 % confidence interval of the mean (Student's t). A seed sets the initial spacing of the balls,
  and impacts come at twelve phases, one for each seed. Where balls press on their pockets all the time all seeds end on one periodic motion: the band
  closes then, and says nothing about other motions.
- Rivets are elastic here: a figure beyond yield (590 MPa, assumed) tells how far the load exceeds yield, not the stress.
- Head: largest principal stress in the fillet; middle: von Mises stress at the split.

## Which stress

The paper does not say which stress of its 0.4 s it means. Each claim is judged in three measures, one at a time:

| measure | of the worst rivet | what speaks for it, and against |
|---|---|---|
| mean | mean over time of the largest stress at each instant | 10,000 steps in 0.4 s are 40 µs each and hardly resolve impacts of 35 to 100 µs |
| p99.9 | 99.9 % quantile over every internal step | "the maximum stress of the rivet head" (Fig. 11), if impacts are resolved |
| range | 99.9 % minus 0.1 % quantile of a single rivet | fatigue depends on it, but it has no share of preload and fit, which Figs. 11 and 12 are about |

The mean stress is the paper's most likely one, and the counts below are in it unless they name another.
"""
SEEDS = 8  # of each point, from which on half of them have a verdict
MARKS = {"reproduced": "●", "partly": "◐", "not": "○"}


def write_paper(columns, folder, settings=(), command="study.py --report docs"):
    """Write paper.md and its pictures into a folder from the columns {column: {sweep: Runs}}; settings: of the column
    `yours`, for the page; command: of this folder, which the page names as its author.  Returns the file's path.
    """
    folder = Path(folder)
    judged = judge(columns)
    pictures = draw(columns, folder / "paper")
    parts = [
        introduction(columns, judged, pictures, folder, command)
        + (f"\nYours: scene `paper` with {', '.join(f'`{s}`' for s in settings)}.\n" if settings else "")
    ]
    parts += [summary_text(judged), seeds_text(columns), flips_text(judged), numbers_text(columns)]
    data = columns.get("paper", {})
    parts += (
        [conflicts_text(data)] if {"rings_speed", "rings_clearance", "speed", "clearance", "tilt"} <= set(data) else []
    )
    parts += [fretting_text(data["fretting"])] if "fretting" in data else []
    parts += [picture_text(name, path.relative_to(folder), judged) for name, path in pictures.items()]
    parts += [tolerance_text(data["tolerance"])] if "tolerance" in data else []
    parts.append(cost_text(columns))
    path = folder / "paper.md"
    write_atomically(path, lambda temporary: temporary.write_text("\n".join(parts), encoding="utf-8"))
    return path


def introduction(columns, judged, pictures, folder, command):
    """The page's first part, which says on top how much of the study was run if it was not all of it."""
    beside = (folder / "parameters.md").is_file()
    return INTRODUCTION.format(
        command=command,
        part=part_text(columns, judged),
        figures=figures_text(pictures),
        parameters="[parameters.md](parameters.md)" if beside else "The page `docs/parameters.md` of the program",
    )


def part_text(columns, judged):
    """A line on the claims and seeds of a study that has not all of them, "" for a whole one."""
    seeds = [seeds_of(data) for data in columns.values() if set(data) - set(BESIDE)]
    fewest, judged_claims = min(seeds, default=0), number_judged(judged)
    if judged_claims == number_of_claims() and fewest >= SEEDS:
        return ""
    return f"\n**Part of the study: {of_all(judged)}{f', {fewest} seeds' if fewest else ''}.**\n"


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


def verdict_sentence(judged):
    """The counts of all columns in mean stress."""
    first = {
        "paper": "Of {all} its own equations (scene `paper`) reproduce {r}, partly {p}, not {n}.",
        "physical": "Of {all} elastic halves with their centrifugal load (`physical`) reproduce {r}, partly {p}, not {n}.",
        "yours": "Of {all} your parameters reproduce {r}, partly {p}, not {n}.",
    }
    later = {
        "paper": "By its own equations (scene `paper`) the counts are {r}, {p} and {n}.",
        "physical": "With elastic halves and their centrifugal load (`physical`) the counts are {r}, {p} and {n}.",
        "yours": "With your parameters the counts are {r}, {p} and {n}.",
    }
    sentences = []
    whole = number_judged(judged) == number_of_claims()
    claims_judged = f"the paper's {number_of_claims()} claims" if whole else of_all(judged)
    for column, claims in judged.items():
        r, p, n = count(claim.verdict for claim in every(claims["mean"]))
        sentences.append((later if sentences else first)[column].format(all=claims_judged, r=r, p=p, n=n))
    return " ".join(sentences)


def summary_text(judged):
    """The counts before and after the repair of the conditions, and the verdicts claim by claim."""
    lines = [
        "## Verdicts",
        "",
        verdict_sentence(judged),
        "",
        "*Reproduced* (●) if all conditions of a claim hold with their confidence, *partly* (◐) if some do, *not* (○) if none does. The conditions stand "
        'below beside the paper\'s sentences, and for the program in `benchmarks/paper/claims.toml`. "Before" are the conditions of the first study, in '
        "all measures together, on the same runs: some were stricter than the sentence, some more lenient.",
        "",
        "| column | stress | reproduced | partly | not |",
        "|---|---|---|---|---|",
    ]
    for column, of_measure in judged.items():
        rows = {"before, mixed": count(claim.verdict_before for claim in every(of_measure["mean"]))}
        rows |= {measure: count(claim.verdict for claim in every(claims)) for measure, claims in of_measure.items()}
        lines += [f"| {column} | {name} | " + " | ".join(map(str, counts)) + " |" for name, counts in rows.items()]
    heads = [f"{column}: {name}" for column in judged for name in ("before", *MEASURES)]
    lines += ["", "| section | the paper says | " + " | ".join(heads) + " |", "|---" * (2 + len(heads)) + "|"]
    for claims in zip(
        *(every(claims) for of_measure in judged.values() for claims in of_measure.values()), strict=True
    ):
        marks = []
        for i, claim in enumerate(claims):
            marks += [MARKS[claim.verdict_before]] if i % len(MEASURES) == 0 else []
            marks += [MARKS[claim.verdict]]
        lines.append(f"| {claims[0].where} | {claims[0].said} | " + " | ".join(marks) + " |")
    return "\n".join(lines) + "\n"


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


def seeds_text(columns):
    """The claims whose verdict depends on the seeds, a sentence each; a half needs four seeds to have a verdict."""
    lines = [
        "## Which verdicts depend on the seeds",
        "",
        "Each claim is also judged in mean stress by the first and by the second half of its seeds alone, which have wider intervals than all seeds together. "
        "The verdict that counts is that of all seeds.",
        "",
    ]
    words = {verdict: "reproduced" if verdict == "reproduced" else f"{verdict} reproduced" for verdict in MARKS}
    for column, data in columns.items():
        if not set(data) - set(BESIDE):
            continue
        seeds = seeds_of(data)
        if seeds < SEEDS:
            lines.append(f"- `{column}`: not judged, because there are {seeds} seeds a point and each half needs four.")
            continue
        found = depending_on_seeds(data)
        lines += [
            f'- `{column}`: "{said}" depends on the seeds: {words[first]} with the first half, {words[second]} with the second, {words[both]} with all.'
            for said, first, second, both in found
        ]
        lines += [] if found else [f"- `{column}`: no verdict depends on the seeds."]
    return "\n".join(lines) + "\n"


def flips_text(judged):
    """Claims whose verdict in mean stress the repair of the condition changed, each with the reason."""
    lines = [
        "## What the repair of the conditions changed",
        "",
        "Two claims of the first study are out: that a run takes half an hour on forty processors, which is no physics, and a sentence in brackets that "
        "contradicts the paper's own definition of the fit. Verdicts in mean stress, before → after:",
        "",
        "| the paper says | " + " | ".join(judged) + " | reason |",
        "|---" * (2 + len(judged)) + "|",
    ]
    for claims in zip(*(every(of_measure["mean"]) for of_measure in judged.values()), strict=True):
        if any(claim.verdict != claim.verdict_before for claim in claims):
            marks = [f"{MARKS[claim.verdict_before]} → {MARKS[claim.verdict]}" for claim in claims]
            lines.append(f"| {claims[0].said} | " + " | ".join(marks) + f" | {claims[0].reason} |")
    return "\n".join(lines) + "\n"


def numbers_text(columns):
    """The paper's numbers beside those of the columns."""
    found = {column: numbers(data) for column, data in columns.items() if data}
    lines = [
        "## The paper's numbers",
        "",
        "The curves of Figs. 10 to 16 are not in the paper's text; its numbers are. Brackets: 95 % confidence interval.",
        "",
        "| quantity | paper's text | " + " | ".join(found) + " |",
        "|---" * (2 + len(found)) + "|",
    ]
    lines += [
        f"| {rows[0][0]} | {rows[0][1]} | " + " | ".join(value for _, _, value in rows) + " |"
        for rows in zip(*found.values(), strict=True)
    ]
    return "\n".join(lines) + "\n"


def picture_text(name, path, judged):
    """A picture under its heading, and the claims it shows."""
    title = PICTURES[name][1]
    text = details_text({c: {m: claims.get(name, ()) for m, claims in by.items()} for c, by in judged.items()})
    return f"## {title}\n\n![{title}]({path.as_posix()})\n" + ("\n" + text if text else "")


def details_text(judged):
    """Each claim: the paper's sentence, the condition and why it is fair, then for each column the figures of the runs in
    mean stress, and in the other measures where their verdict differs; the reason.
    """
    text = ""
    columns = list(judged)
    for same in zip(*(zip(*judged[column].values(), strict=True) for column in columns), strict=True):
        first = same[0][0]
        text += f'- **{first.said}** ({first.where})\n  - Paper: "{first.sentence}"\n  - Condition: {first.condition}\n'
        text += f"  - Neither stricter nor more lenient: {first.reason}\n"
        for column, claims in zip(columns, same, strict=True):
            for measure, claim in zip(MEASURES, claims, strict=True):
                if measure == "mean" or claim.verdict != claims[0].verdict:
                    text += f"  - {column}, {measure}: {claim.verdict}. {claim.found}\n"
        text += f"  - Why: {first.why}\n"
    return text


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


def conflicts_text(data):
    """Pairs of claims that no single bearing meets, and a claim that no elastic rivet meets."""
    rings = {"free ring": data["speed"], "free ring, centrifugal load": data["rings_speed"].at(centrifugal="on")}
    rings |= {
        name: data["rings_speed"].at(centrifugal="off", tilt_mode=mode)
        for name, mode in (("stiff ring (2e4 N.m/rad)", "supported"), ("straight ring", "prescribed"))
    }
    speeds = np.unique(data["rings_speed"]["speed"])
    table = {name: spreads(runs, speeds) for name, runs in rings.items()}
    ratios = {
        "free ring": least_ratio(data["clearance"]),
        **{
            name: least_ratio(data["rings_clearance"].at(tilt_mode=mode))
            for name, mode in (("stiff ring (2e4 N.m/rad)", "supported"), ("straight ring", "prescribed"))
        },
    }
    falls = {name: falls_first(runs, speeds) for name, runs in rings.items()}
    tilted = data["tilt"]
    rest, at_02, at_05 = (
        tilted.at(tilt=tilt).estimate(name).mean for tilt, name in ((-0.2, "head_rest"), (-0.2, "head"), (-0.5, "head"))
    )
    lines = [
        "## Conflicts",
        "",
        "**Fig. 13 among itself, and with Figs. 10 and 11.** The loads' curves come together at high speed only if a load acts that they do not change: the "
        "cage's centrifugal load. With it the stress falls first under the heavy load at most, and neither dislocation nor stress depend "
        "on preload as in Figs. 10 and 11. Difference of the mean head stress between 2994 and 1994 N over the lesser one:",
        "",
        "| scene `paper` with | "
        + " | ".join(f"{speed:,.0f} r/min" for speed in speeds)
        + " | falls first, 2994 / 1994 N |",
        "|---" * (2 + len(speeds)) + "|",
        *(
            f"| {name} | " + " | ".join(f"{value:.2f}" for value in row) + f" | {falls[name]} |"
            for name, row in table.items()
        ),
        "",
        "**Fig. 16 with Fig. 13.** At a constant sum of the clearances the mean head stress is least at these ratios; the last columns show how far it rises "
        "toward the ratios 0.3 and 3. A ring that is held has no effect of the load on the stress at low speed (table above), which Fig. 13 is about.",
        "",
        "| scene `paper` with | ratio of the least stress | rise to 0.3, MPa | rise to 3, MPa |",
        "|---|---|---|---|",
        *(f"| {name} | {best:g} | {left:.1f} | {right:.1f} |" for name, (best, left, right) in ratios.items()),
        "",
        f"**Twenty times (Fig. 15).** At 0.2° the mean stress is {at_02:.0f} MPa, {rest:.0f} of which are the preload's; at 0.5° it is {at_05:.0f} MPa. Twenty "
        f"times the preload's share alone would be {20 * rest:.0f} MPa, above the tensile strength (785 MPa, assumed). Either the paper's stress does not "
        "contain the preload, or it is that of an elastic rivet beyond its strength.",
    ]
    return "\n".join(lines) + "\n"


def falls_first(runs, speeds):
    """Whether the mean head stress at the first speed is above that at another one, for the heavy and the light load."""
    means = [[runs.at(F_r=F_r, speed=v).estimate("head").mean for v in speeds] for F_r in (max(LOADS), min(LOADS))]
    return " / ".join("yes" if np.argmin(row) > 0 else "no" for row in means)


def fretting_text(runs):
    """Damage of head and middle over the fretting strength reduction, and the share of rivets that break in the middle."""
    factors = np.unique(runs["fretting"])
    rivets = sum(name.startswith("mid_damage_") for name in runs.columns)
    decades, lines = [], []
    for factor in factors:
        at = runs.at(fretting=factor)
        apart = np.array([at[f"mid_damage_{k}"] - at[f"head_damage_{k}"] for k in range(1, rivets + 1)])
        share = estimate(norm.cdf(apart / (np.sqrt(2.0) * SCATTER)).mean(axis=0))
        decades.append(apart.mean())
        head, mid = (at.estimate(f"{place}_damage").mean for place in ("head", "mid"))
        lines.append(f"| {factor:g} | {head:.1f} | {mid:.1f} | {rivets * share.mean:.1f} |")
    wanted = {broken: np.sqrt(2.0) * SCATTER * norm.ppf(broken / 9.0) for broken in (7, 4.5)}
    needed = {
        broken: np.interp(value, decades, factors) if decades[0] < value < decades[-1] else np.nan
        for broken, value in wanted.items()
    }
    seven = f"{needed[7]:.1f}" if np.isfinite(needed[7]) else f"none up to {factors[-1]:g}"
    head_range, mid_range = (runs.at(fretting=1.0).estimate(f"{place}_range").mean for place in ("head", "mid"))
    slip = runs.at(fretting=1.0).estimate("slip")
    within = np.isfinite(needed[7]) and needed[7] <= 2.9
    judgement = (
        "The factor is within that range, so that fretting alone would be a plausible reason of the middle's fractures."
        if within
        else "The factor is beyond that range, so that fretting alone is no plausible reason of the middle's fractures."
    )
    return (
        "\n".join(
            [
                "## Fig. 18: fretting in the hole",
                "",
                "By maximum stress the middle leads under interference, as the paper argues; by damage the head does, because its swing is larger: a dynamic "
                f'range of {head_range:.0f} against {mid_range:.0f} MPa at +0.04 mm. The paper quotes a case of "high-cycle fatigue" with "fretting damage '
                'between the surface of the rivet bar and the wall of the mating hole" (its reference 15). `fatigue.fretting` divides the strength of the '
                "middle of a shank on which its hole presses; it is 1 (off) by default. Scene `paper`, +0.04 mm, damage of the worst rivet per hour as its "
                f"power of ten; broken: expected among {rivets} rivets whose strength scatters (90 % over 10 %: {T_S:g}):",
                "",
                "| `fatigue.fretting` | head | middle | broken in the middle |",
                "|---|---|---|---|",
                *lines,
                "",
                f"Seven of nine broken in the middle take a factor of {seven}. Shafts in press fits have 1.8 to 2.9, and 2.4 at the rivets' assumed strength "
                f"of 785 MPa (DIN 743-2, from memory, not checked). {judgement}",
                "",
                f"The halves move by {slip} µm against each other under this fit, which is little. Wear by fretting grows from slips of 20 to 300 µm (Vingsbo "
                "and Söderberg, Wear 126, 1988, as the abstract of a later paper quotes them). That the life of parts in fretting fatigue is least at some ten "
                "micrometres is from memory, not checked. The residual stress of riveting, which the paper's reference 20 computes, is not in the model.",
            ]
        )
        + "\n"
    )


def tolerance_text(runs):
    """Statistics at each tolerance against those at the tightest one."""
    tight, *looser = np.unique(runs["tolerance"])
    names = {"force": "mean force", "head": "head, mean", "head_peak": "head, 99.9 %", "mid_peak": "middle, 99.9 %"}
    lines = [
        "## Tolerance",
        "",
        f"Change of the statistics, in percent, from the tolerance of the line to {tight:g}, in the scene `paper` under the heavy load, with the confidence "
        "interval over seeds. "
        "The speed study runs at 1e-4, all others at the default of 1e-3.",
        "",
    ]
    lines += ["| r/min | tolerance | " + " | ".join(names.values()) + " |", "|---" * (2 + len(names)) + "|"]
    for speed in np.unique(runs["speed"]):
        at = runs.at(speed=speed)
        for tolerance in looser[::-1]:
            changes = [ratio(at.at(tolerance=tight), at.at(tolerance=tolerance), name) for name in names]
            lines.append(f"| {speed:,.0f} | {tolerance:g} | " + " | ".join(percent(e) for e in changes) + " |")
    return "\n".join(lines) + "\n"


def percent(e):
    """An Estimate of a ratio as a change in percent."""
    return f"{100 * (e.mean - 1):+.2f} [{100 * (e.low - 1):+.2f}, {100 * (e.high - 1):+.2f}]"


def cost_text(columns):
    """Processor time by column and sweep."""
    lines = [
        "## What it costs",
        "",
        "Processor time of all runs with their start, on one core of the machine that made this page; starting the workers, collecting the rows and drawing "
        "come on top.",
        "",
        "| column | sweep | figure | seeds | runs | simulated | processor time | per simulated second |",
        "|---|---|---|---|---|---|---|---|",
    ]
    figures = {
        name: ", ".join(title.split(":")[0] for needed, title, _ in PICTURES.values() if name in needed)
        for name in shipped_studies()
    }
    all_runs = [(column, name, runs) for column, data in columns.items() for name, runs in data.items()]
    total = sum(runs["whole_cpu_time"].sum() for *_, runs in all_runs)
    for column, name, runs in all_runs:
        spent, simulated = runs["whole_cpu_time"].sum(), runs["simulated"].sum()
        per = estimate(runs["cpu_time"] / runs["simulated"]).mean
        lines.append(
            f"| {column} | {name} | {figures[name] or 'beside all'} | {len(np.unique(runs['seed']))} | {len(runs)} | {simulated:.1f} s "
            f"| {spent:.0f} s ({100 * spent / total:.0f} %) | {per:.2f} s |"
        )
    runs, simulated = sum(len(runs) for *_, runs in all_runs), sum(runs["simulated"].sum() for *_, runs in all_runs)
    lines.append(f"| **all** | | | | {runs} | {simulated:.0f} s | **{total:.0f} s** | |")
    lines += ["", f"On two cores that is {total / 120:.1f} min."]
    return "\n".join(lines) + "\n"
