"""Writes docs/stability.md from the newest records; measures nothing; its text stands in
pages/stability.md.  Run: python benchmarks/stability.py --page."""

from collections import Counter

import numpy as np
from pages import page_text
from records import newest_if_any

REASONS = (  # part of a message of refusal, reason
    ("pressed out of", "the load presses a ball out of its groove at the start"),
    ("must lie in", "a value lies outside its range"),
    ("", "two values contradict each other"),
)


def largest(records, key):
    """The admissible finished scene with the largest value; None if no scene has the value."""
    values = [r for r in records if r["admissible"] and r["outcome"] == "finished" and np.isfinite(r.get(key, np.nan))]
    return max(values, key=lambda r: r[key]) if values else None


def family_rows(records):
    for family in dict.fromkeys(r["family"] for r in records):
        own = [r for r in records if r["family"] == family]
        slow, energy = largest(own, "ratio"), largest(own, "balance")
        rejected = sum(r.get("rejected", 0) for r in own) / max(sum(r.get("steps", 0) for r in own), 1)
        yield (
            family,
            len(own),
            f"{energy['balance']:.1e}" if energy else "—",
            f"{100 * rejected:.1f}",
            f"{slow['ratio']:.1f}" if slow else "—",
        )


def refusal_rows(records):
    """Reason of refusal, number of scenes, the first of them."""
    found = {}
    for r in records:
        if r["outcome"] == "refused":
            reason = next(reason for part, reason in REASONS if part in r["message"])
            found.setdefault(reason, []).append(r["name"])
    return [(reason, len(names), names[0]) for reason, names in found.items()]


def outcomes(records):
    """How many scenes ended in which way."""
    count = Counter(r["outcome"] for r in records)
    return [count[name] for name in ("finished", "refused", "discarded", "crashed", "hung", "not finite")]


def write_page(path, problems):
    """Write the page; problems: function from records to sentences about faults."""
    data, elastic, long = map(newest_if_any, ("stability", "stability_elastic", "stability_long"))
    records = data["records"]
    values = {"data": data, "elastic": None, "long": long, "faults": list(problems(records))}
    values["counts"] = [("rigid (`two_half`)", len(records), *outcomes(records))]
    if elastic:
        found = elastic["records"]
        values["faults"] += problems(found)
        values["counts"].append(("elastic", len(found), *outcomes(found)))
        values["elastic"] = {"slow": largest(found, "ratio"), "energy": largest(found, "balance")}
    open_ = [r for r in records if r.get("balance", 0.0) > 0.01 and r["family"] != "tolerance"]
    values |= {"open_": open_, "worst": max(open_, key=lambda r: r["residual"], default=None)}
    values |= {"families": family_rows(records), "refusals": refusal_rows(records)}
    if long:
        values |= long_values(long)
    path.write_text(page_text("stability.md", values), encoding="utf-8")


def long_values(data):
    """Tables of the long runs."""
    rows = data["long_run"]["rows"]
    last = rows[-1]
    drift = np.polyfit([r["t"] for r in rows], [r["bearing.energy_residual"] for r in rows], 1)[0]
    loss = np.mean([r["bearing.power_loss"] for r in rows])
    quantities = (
        ("turns of the cage", f"{last['psi'] / (2 * np.pi):,.0f}"),
        ("steps", f"{last['solver.steps']:,.0f}"),
        ("energy residual", f"{last['bearing.energy_residual']:.2e} J"),
        ("its drift", f"{drift:.1e} W, {100 * abs(drift) / loss:.1g} % of the power lost"),
        ("cage angle against summed mean speed", f"{phase(rows):.1e}"),
        ("largest friction state", f"{1e6 * max(r['friction'] for r in rows):.2f} µm"),
        ("error of `stat.time`", f"{abs(last['stat.time'] - last['t'] + 0.05):.1e} s"),
    )
    differences = {name: f"{value:.1e}" for name, value in data["many_turns"]["differences"].items()}
    return {"last": last, "quantities": quantities, "differences": differences}


def phase(rows):
    """Relative difference of the cage's turns after settling: the integrated angle against mean speed times time."""
    a, b = rows[0], rows[-1]
    turned = b["psi"] - a["psi"]
    return abs(turned - (b["stat.cage_omega"] * b["stat.time"] - a["stat.cage_omega"] * a["stat.time"])) / turned
