"""Writes docs/stability.md from the newest records; measures nothing.  Run: python benchmarks/stability.py --page."""

from collections import Counter

import numpy as np
from records import newest_record

REASONS = (  # part of a message of refusal, reason
    ("pressed out of", "the load presses a ball out of its groove at the start"),
    ("must lie in", "a value lies outside its range"),
    ("", "two values contradict each other"),
)


def load(name):
    """The newest record of a benchmark, None if there is none."""
    try:
        return newest_record(name)
    except FileNotFoundError:
        return None


def row(*cells):
    return "| " + " | ".join(str(cell) for cell in cells) + " |\n"


def table(head, rows):
    return row(*head) + row(*("---" for _ in head)) + "".join(row(*cells) for cells in rows) + "\n"


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
            f"{slow['ratio']:.1f} ({slow['name']})" if slow else "—",
        )


def event_rows(records):
    kinds = Counter()
    for r in records:
        kinds.update({kind: 1 for kind, onsets in r.get("events", {}).items() if onsets})
    return [(kind.replace("_", " "), count) for kind, count in kinds.most_common()]


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
    data = load("stability")
    elastic, long = load("stability_elastic"), load("stability_long")
    records = data["records"]
    bad = list(problems(records)) + (list(problems(elastic["records"])) if elastic else [])
    counts = [("rigid (`two_half`)", len(records), *outcomes(records))]
    if elastic:
        counts.append(("elastic", len(elastic["records"]), *outcomes(elastic["records"])))
    text = f"""# Stability

`benchmarks/stability.py` runs random and extreme scenes to their ends.
Measured {data["date"][:10]} at commit {data["commit"]} on {data["machine"]["processor"]}.
Scenes whose rivets have closed forms run with rigid halves only.

"""
    text += table(
        ("cage halves", "scenes", "finished", "refused", "discarded", "crashed", "hung", "not finite"), counts
    )
    text += "Faults are also an admissible scene refused, an impossible one that runs and a run time above 20.\n"
    text += ("Faults:\n\n" + "".join(f"- {line}\n" for line in bad) if bad else "No fault occurred.\n") + "\n"
    text += FAMILIES
    text += table(("family", "scenes", "energy", "rejected, %", "run time"), family_rows(records))
    text += energy_text(records)
    text += elastic_text(elastic["records"]) if elastic else ""
    text += "## Events\n\nScenes with at least one onset:\n\n"
    kinds = event_rows(records)
    text += table([kind for kind, _ in kinds], [[count for _, count in kinds]])
    text += "## Refusals\n\nEvery refusal names the value and its limit.\n\n"
    text += table(("reason", "scenes", "for example"), refusal_rows(records))
    path.write_text(text + (long_text(long) if long else ""))


FAMILIES = """## Families of scenes

| column | meaning |
| --- | --- |
| energy | largest `bearing.energy_residual` over energy lost + kinetic energy + work of the load over 10 µm |
| rejected | steps that failed the error test |
| run time | of the slowest scene, processor time per simulated second times 9/Z, over the working point's |

Rigid halves; energy and run time at the default tolerance and communication steps of 10 µs and more:

"""


def elastic_text(records):
    """The scenes again with elastic cage halves."""
    slow, energy = largest(records, "ratio"), largest(records, "balance")
    return f"""With elastic halves the largest run time is {slow["ratio"]:.1f} ({slow["name"]}), the largest energy
{energy["balance"]:.1e} ({energy["family"]}: {energy["name"]}).

"""


def energy_text(records):
    """Paragraph about the scenes whose energy balance does not close."""
    open_ = [r for r in records if r.get("balance", 0.0) > 0.01 and r["family"] != "tolerance"]
    if not open_:
        return ""
    worst = max(open_, key=lambda r: r["residual"])
    return f"""The balance does not close to 1 % in {len(open_)} scenes, most of them near standstill, where energies
are microjoules. The largest residual is {worst["residual"]:.1g} J ({worst["name"]}).
The correction of the work holds for linear rates only ([method.md](method.md#energy)).

"""


def long_text(data):
    tiny, turns, rows = data["tiny_steps"], data["many_turns"], data["long_run"]["rows"]
    last = rows[-1]
    drift = np.polyfit([r["t"] for r in rows], [r["bearing.energy_residual"] for r in rows], 1)[0]
    loss = np.mean([r["bearing.power_loss"] for r in rows])
    text = f"""## Long runs

{tiny["steps"]:,} communication steps of 1 ns: clock error {tiny["clock_error"]:.1e} s, energy residual
{tiny["residual"]:.1e} J, {1e6 * tiny["cpu_per_step"]:.1f} µs of processor time each.

All angles shifted by {turns["turns"]:,} turns (resolution {turns["resolution"]:.1e} rad): differences from the
unshifted run after 1 ms at tolerance 1e-8, SI units:

"""
    differences = turns["differences"]
    text += table(tuple(differences), [[f"{value:.1e}" for value in differences.values()]])
    text += f"""{last["t"]:g} s of the working point, rigid halves:

"""
    text += table(
        ("quantity", "value"),
        (
            ("turns of the cage", f"{last['psi'] / (2 * np.pi):,.0f}"),
            ("steps", f"{last['solver.steps']:,.0f}"),
            ("energy residual", f"{last['bearing.energy_residual']:.2e} J"),
            ("its drift", f"{drift:.1e} W, {100 * abs(drift) / loss:.1g} % of the power lost"),
            ("cage angle against summed mean speed", f"{phase(rows):.1e}"),
            ("largest friction state", f"{1e6 * max(r['friction'] for r in rows):.2f} µm"),
            ("error of `stat.time`", f"{abs(last['stat.time'] - last['t'] + 0.05):.1e} s"),
        ),
    )
    head = ("t, s", "energy residual, J", "RMS pocket force, N", "cage speed, rad/s", "slip of a joint, µm")
    shown = rows[0], rows[len(rows) // 2], last
    text += table(
        head,
        (
            (
                f"{r['t']:g}",
                f"{r['bearing.energy_residual']:.2e}",
                f"{r['stat.Q_c_rms']:.4f}",
                f"{r['stat.cage_omega']:.4f}",
                f"{1e6 * r['cage.dislocation']:.2f}",
            )
            for r in shown
        ),
    )
    return text.rstrip("\n") + "\n"


def phase(rows):
    """Relative difference of the cage's turns after settling: the integrated angle against mean speed times time."""
    a, b = rows[0], rows[-1]
    turned = b["psi"] - a["psi"]
    return abs(turned - (b["stat.cage_omega"] * b["stat.time"] - a["stat.cage_omega"] * a["stat.time"])) / turned
