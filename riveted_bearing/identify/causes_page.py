"""What `causes` leaves: causes.json, and the page causes.html for the report of a laboratory."""

from pathlib import Path
from typing import Any

import numpy as np

from ..base.files import write_json
from ..base.units import hours_text
from ..base.version import __version__
from ..running.responses import display_of
from ..show import charts
from ..show.pages import save_page
from ..show.plot import FORCE, HEAD, MIDDLE, MUTED
from .findings import NONE, Study
from .order import State, plain
from .pool import RESPONSES
from .posterior import Answer, Predicted, heavy, sound_medians

STRONG = 2.0  # a finding that changes the odds by this speaks for or against a cause
FEW = 4.0  # designs: below it the Monte Carlo interval itself is a guess
LEAST = 0.01  # probability below which a cause is named without words
RANKED = ("cause", "probability", "Monte Carlo interval", "90 % set", "for it", "against it")
PREDICTED = ("cause", "hours, median", "80 %", "broke within", "middles", "beside a gap", "loose", *RESPONSES)


def ranked_rows(said: Answer) -> Any:
    """Cause, probability with interval, place in the set, findings for and against, the most probable first."""
    rows = []
    for k in said.ranked:
        low, high = said.interval(k)
        ratios = sorted(((values[k], name) for name, values in said.single.items()), reverse=True)
        speaks = [f"{name} (x {ratio:.2g})" for ratio, name in ratios if ratio >= STRONG]
        denies = [f"{name} (x {ratio:.2g})" for ratio, name in reversed(ratios) if ratio <= 1.0 / STRONG]
        known = said.posterior[k] >= LEAST
        inside = "yes" if k in said.credible else ""
        share = f"{100 * said.posterior[k]:.0f} %" if known else "< 1 %"
        shares = share, f"{100 * low:.0f} ... {100 * high:.0f} %", inside
        rows.append((said.names[k], *shares, ", ".join(speaks[:4]), ", ".join(denies[:4])))
    return rows


def verdict(said: Answer) -> str:
    """The answer in a sentence."""
    first = said.ranked[0]
    if not said.posterior.sum() > 0.0:
        return "No cause in the list can produce the findings, and none of these has the prior 0."
    low, high = said.interval(first)
    share = f"{100 * said.posterior[first]:.0f} % ({100 * low:.0f} to {100 * high:.0f} % by the Monte Carlo error)"
    if said.decided and said.names[first] == NONE:
        return f"None of the causes explains the findings: {share}. Name further causes in the file."
    inside = ", ".join(said.names[k] for k in said.credible)
    known = said.names[first] == NONE or said.effective[first] >= FEW
    more = "" if known else f" Only {said.effective[first]:.0f} designs bear it: raise samples."
    if said.decided:
        return f"Most probable cause: {said.names[first]}, {share}.{more}"
    return f"Not decided. 90 % of the probability is shared by: {inside}. First is {said.names[first]}, {share}.{more}"


def inspection_rows(said: Answer) -> Any:
    """What to inspect next and the information that it is expected to give."""
    P = said.posterior[said.posterior > 0.0]
    entropy = float(-(P * np.log2(P)).sum())
    return [
        (name, text, f"{bits:.2f}", f"{100 * bits / max(entropy, 1e-9):.0f} %") for name, text, bits in said.inspections
    ]


def predicted_rows(study: Study, pool: list[Predicted], said: Answer) -> Any:
    """What each cause predicts for each finding."""
    n, rows, sound = max(study.findings.broken, 1), [], sound_medians(study, pool)
    for k in said.ranked:
        if k == len(study.causes):
            continue
        of = [one for one in pool if one.cause == k]
        low, half, high = np.quantile([one.at(n) for one in of], [0.1, 0.5, 0.9], method="inverted_cdf")
        within = mean_of([one.at(n) <= np.log10(study.findings.within) for one in of])
        marks = [mean_of(heavy([one.responses[name] for one in of], sound[name]).tolist()) for name in RESPONSES]
        middles = mean_of([np.mean(one.middle[:n]) for one in of if len(one.middle)])
        near = mean_of([np.nanmean(one.beside) for one in of if np.isfinite(one.beside).any()])
        shares = (within, middles, near, mean_of([one.loose for one in of]), *marks)
        hours = (hours_text(10.0**half), f"{hours_text(10.0**low)} ... {hours_text(10.0**high)}")
        rows.append((study.causes[k].name, *hours, *("" if np.isnan(x) else f"{100 * x:.0f} %" for x in shares)))
    return rows


def mean_of(values: list[Any]) -> float:
    """Mean, not a number if there is none."""
    return float(np.mean(values)) if values else float("nan")


def finding_rows(study: Study) -> Any:
    """What was found, in words."""
    found, rows = study.findings, []
    for name in ("head", "middle", "unknown"):
        if found.counts[name]:
            rows.append((f"broken, {name}", places_text(found, name)))
    for name in ("formed", "set"):
        if found.counts[name]:
            rows.append((f"{name} heads among them", places_text(found, name)))
    if found.order:
        rows.append(("order", ", ".join(map(str, found.order))))
    for name in sorted(found.looked):
        rows.append((name, places_text(found, name)))
    if found.hours is not None:
        rows.append(("hours", hours_text(10.0 ** found.hours[0]) + (", about" if found.hours[1] else "")))
    rows += [(f"mark: {name}", "heavy" if is_heavy else "none") for name, is_heavy in found.marks.items()]
    for name, (value, sd) in found.measured.items():
        unit, factor, _ = display_of(study.quantities[name].quantity.replace("[*]", "[1]"))
        rows.append((f"measured: {name}", f"{factor * value:.4g} ± {factor * sd:.2g} {unit or ''}".strip()))
    return rows


def places_text(found, name):
    """Rivets of a kind: their numbers, or how many."""
    places = found.places[name]
    return f"{found.counts[name]} rivets" if places is None else ", ".join(map(str, places)) or "none"


def write_answer(study: Study, said: Answer | None, pool: Any, states: Any, basis: Any, path: Path) -> Path:
    """Write the answer as JSON, whole or not at all; returns the path."""
    document: dict[str, Any] = {"version": __version__, "description": study.file.description, "basis": dict(basis)}
    document["findings"] = dict(finding_rows(study))
    if said is not None:
        document |= {
            "verdict": verdict(said),
            "decided": said.decided,
            "causes": [
                {
                    "name": said.names[k],
                    "prior": float(study.prior[k]),
                    "probability": float(said.posterior[k]),
                    "interval": said.interval(k),
                    "in the set": k in said.credible,
                    "effective designs": float(said.effective[k]) if k < len(study.causes) else None,
                    "ratios": {name: float(values[k]) for name, values in said.single.items()},
                }
                for k in said.ranked
            ],
            "predicted": [dict(zip(PREDICTED, row, strict=True)) for row in predicted_rows(study, pool, said)],
            "inspections": [{"name": name, "what": text, "bits": bits} for name, text, bits in said.inspections],
            "designs": len(pool),
        }
    if states:
        document["order"] = [plain(state) for state in states]
    return write_json(path, document)


def write_page(study: Study, said: Answer | None, pool: Any, states: Any, basis: Any, path: Path) -> Path:
    """Write the page, whole or not at all; returns the path."""
    pictures = []

    def add(title, draw, about, size, label):
        pictures.append((title, charts.svg(lambda fig: draw(fig, about), size, label)))

    add("What was found", cage, study, (4.2, 4.2), "rivets on the table")
    if said is not None:
        add("Causes", bars, said, (4.6, 0.8 + 0.19 * len(said.names)), "probability of each cause")
        add("What to inspect next", gains, said, (4.6, 0.8 + 0.19 * len(said.inspections)), "expected information")
    if states:
        add("What breaks next", cascade, states, (2.3 * len(states), 2.7), "rivets in order of breakage")
    return save_page(
        path,
        "causes.html",
        study=study,
        basis=list(basis),
        verdict=verdict(said) if said else "",
        findings=finding_rows(study),
        ranked_heads=RANKED,
        ranked=ranked_rows(said) if said else [],
        predicted_heads=PREDICTED,
        predicted=predicted_rows(study, pool, said) if said else [],
        inspections=inspection_rows(said) if said else [],
        order=order_rows(states),
        order_heads=ORDER,
        end=states[-1].end if states else "",
        designs=len(pool or ()),
        within=hours_text(study.file.within),
        charts=pictures,
    )


ORDER = ("gone", "breaks", "place", "after", "sure", "largest head stress, MPa", "dislocation, um")


def order_rows(states: list[State] | None) -> Any:
    """States in order: what is gone, what breaks next."""
    rows = []
    for state in states or ():
        next_one = ("none", "", "", "")
        if state.rivet is not None:
            sure = f"{100 * (state.sure or 0.0):.0f} %"
            next_one = str(state.rivet), str(state.place), hours_text(state.hours), sure
        gone = ", ".join(map(str, state.gone)) or "none"
        rows.append((gone, *next_one, f"{state.stress.max() / 1e6:.0f}", f"{1e6 * state.dislocation:.1f}"))
    return rows


def ring(ax, Z):
    """The cage's circle seen along the shaft, with the balls between the rivets; returns the rivets' places."""
    angle = np.pi / 2.0 - 2.0 * np.pi * np.arange(Z) / Z
    turn = np.linspace(0.0, 2.0 * np.pi, 200)
    for radius in (0.82, 1.18):
        ax.plot(radius * np.cos(turn), radius * np.sin(turn), color=MUTED, lw=0.8, zorder=0)
    between = angle - np.pi / Z
    ax.scatter(
        np.cos(between), np.sin(between), s=3200.0 / Z, color="#f3f4f6", edgecolor=MUTED, linewidth=0.6, zorder=1
    )
    ax.set(xlim=(-1.45, 1.45), ylim=(-1.45, 1.45), aspect="equal", xticks=[], yticks=[])
    ax.spines[:].set_visible(False)
    ax.grid(False)
    return np.cos(angle), np.sin(angle)


KINDS = {  # of rivets: colour, marker, in words
    "head": (HEAD, "o", "head"),
    "middle": (MIDDLE, "o", "middle"),
    "unknown": (FORCE, "o", "broken, place unknown"),
    "loose": ("none", "o", "loose"),
    "missing": (MUTED, "x", "never set"),
}


def cage(fig, study):
    """The rivets as they lie on the table, by number; counts alone have no places."""
    ax = fig.subplots()
    found, Z = study.findings, study.Z
    x, y = ring(ax, Z)
    kind_of = {k: name for name in KINDS for k in found.places[name] or ()}
    for k in range(1, Z + 1):
        kind = kind_of.get(k)
        colour, marker, _ = KINDS[kind] if kind else (MUTED, ".", "")
        plain_edge = {} if marker == "x" else {"edgecolor": FORCE if kind else "none"}
        ax.scatter(x[k - 1], y[k - 1], s=150 if kind else 60, color=colour, marker=marker, zorder=3, **plain_edge)
        first = f" ({found.order.index(k) + 1}.)" if k in found.order else ""
        ax.text(1.33 * x[k - 1], 1.33 * y[k - 1], f"{k}{first}", ha="center", va="center", fontsize=9)
    said = [(name, f"{found.counts[name]} {text}") for name, (*_, text) in KINDS.items() if found.counts[name]]
    for i, (name, text) in enumerate(said):
        height = 0.12 * (len(said) - 1) - 0.24 * i
        colour = KINDS[name][0] if KINDS[name][0] != "none" else FORCE
        ax.text(0.0, height, text, ha="center", va="center", fontsize=10, color=colour)


def bars(fig, said):
    """Probability of each cause with its Monte Carlo interval."""
    ax = fig.subplots()
    order = said.ranked
    y, p = np.arange(len(order)), 100.0 * said.posterior[order]
    ends = 100.0 * np.array([said.interval(k) for k in order])
    ax.barh(y, p, color=[HEAD if k in said.credible else MUTED for k in order], height=0.65)
    ax.hlines(y, ends[:, 0], ends[:, 1], color=FORCE, lw=1.2)
    ax.set_yticks(y, [said.names[k] for k in order])
    ax.invert_yaxis()
    ax.set(xlabel="%; line: Monte Carlo interval; red: 90 % set", xlim=(0.0, 100.0))


def gains(fig, said):
    """Expected information of each inspection."""
    ax = fig.subplots()
    y = np.arange(len(said.inspections))
    ax.barh(y, [bits for *_, bits in said.inspections], color=MIDDLE, height=0.65)
    ax.set_yticks(y, [name for name, *_ in said.inspections])
    ax.invert_yaxis()
    ax.set_xlabel("bits")


def cascade(fig, states):
    """A circle of rivets for each state: area is the logarithm of the damage rate of the worse place, crosses are gone."""
    axes = fig.subplots(1, len(states), squeeze=False)[0]
    rates = np.concatenate([state.rates.max(axis=1) for state in states])
    positive = np.log10(rates[rates > 0.0]) if np.any(rates > 0.0) else np.array([-1.0, 0.0])
    low, span = positive.min(), max(float(np.ptp(positive)), 1e-9)
    for ax, state in zip(axes, states, strict=True):
        x, y = ring(ax, len(state.rates))
        for k, rate in enumerate(state.rates.max(axis=1)):
            if k + 1 in state.gone:
                ax.plot(x[k], y[k], "x", color=MUTED, ms=9, zorder=3)
                continue
            size = 20.0 + 120.0 * np.clip((np.log10(max(rate, 1e-300)) - low) / span, 0.0, 1.0)
            colour = MIDDLE if state.rates[k, 1] > state.rates[k, 0] else HEAD
            edge = FORCE if k + 1 == state.rivet else "none"
            ax.scatter(x[k], y[k], s=size, color=colour, edgecolor=edge, linewidth=2.0, zorder=3)
            ax.text(1.33 * x[k], 1.33 * y[k], str(k + 1), ha="center", va="center", fontsize=7)
        text = "end" if state.rivet is None else f"{state.place} of {state.rivet}\nafter {hours_text(state.hours)}"
        ax.text(0.0, 0.0, text, ha="center", va="center", fontsize=8)
