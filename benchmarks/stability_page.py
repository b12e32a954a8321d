"""docs/stability.md from the newest records of stability.py."""

from collections import Counter

import numpy as np
from records import newest_record


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


def largest(records, key, among=lambda r: True):
    values = [r for r in records if key in r and among(r) and np.isfinite(r[key])]
    return max(values, key=lambda r: r[key]) if values else None


def family_rows(records):
    for family in dict.fromkeys(r["family"] for r in records):
        own = [r for r in records if r["family"] == family]
        count = Counter(r["outcome"] for r in own)
        slow = largest(own, "ratio", lambda r: r["admissible"] and r["outcome"] == "finished")
        energy = largest(own, "balance", lambda r: r["outcome"] == "finished" and r["admissible"])
        rejected = sum(r.get("rejected", 0) for r in own) / max(sum(r.get("steps", 0) for r in own), 1)
        yield (
            family,
            len(own),
            count["finished"],
            count["discarded"],
            count["refused"],
            f"{energy['balance']:.1e}" if energy else "",
            f"{100 * rejected:.1f} %",
            f"{slow['ratio']:.1f} ({slow['name']})" if slow else "",
        )


def event_rows(records):
    kinds = Counter()
    for r in records:
        kinds.update({kind: 1 for kind, onsets in r.get("events", {}).items() if onsets})
    return [(kind.replace("_", " "), count) for kind, count in kinds.most_common()]


def write_page(path, problems):
    """Write the page; problems: function from records to sentences about faults."""
    data = load("stability")
    records = data["records"]
    count = Counter(r["outcome"] for r in records)
    bad = list(problems(records))
    slow = sorted((r for r in records if r["admissible"] and r["outcome"] == "finished"), key=lambda r: -r["ratio"])
    text = f"""# Stability

{len(records)} scenes, random and extreme, with rigid cage halves (`scene.cage = two_half`; elastic ones: [below](#the-same-with-elastic-cage-halves)), each run
to its end by `benchmarks/stability.py`: {count["finished"]} finished, {count["discarded"]} discarded,
{count["refused"]} refused, {count["crashed"]} crashed, {count["hung"]} hung, {count["not finite"]} with a value that is not finite.
Measured {data["date"][:10]} at commit {data["commit"]} on {data["machine"]["processor"]}, processor times of one core.

*Energy*: largest `bearing.energy_residual`, relative to the sum of the energy lost so far, the kinetic energy of balls and cage, and the work of the load
over 10 µm, at the default tolerance and communication steps of 10 µs and more.  *Rejected*: steps that failed the error test, of all steps.
*Run time*: processor time per simulated second, times 9/Z, relative to the working point in the same process; of the slowest scene of the family.

"""
    head = ("family", "scenes", "finished", "discarded", "refused", "energy", "rejected", "run time")
    text += table(head, family_rows(records))
    text += energy_text(records)
    text += (
        "## What must not happen\n\n"
        + ("".join(f"- {line}\n" for line in bad) if bad else "None of these happened.\n")
        + "\n"
    )
    text += f"## The slowest admissible scenes\n\nThe limit is 20 times the working point; the worst has {slow[0]['ratio']:.1f}.\n\n"
    text += table(("scene", "run time", "evaluations per ms", "path"), [slow_row(r) for r in slow[:10]])
    text += "## What happened in the model\n\nScenes with at least one onset, as reported by the logger and by `event.*`:\n\n"
    text += table(("event", "scenes"), event_rows(records))
    text += "## What was refused\n\n" + table(
        ("scene", "reason"), [(r["name"], r["message"]) for r in records if r["outcome"] == "refused"]
    )
    elastic = load("stability_elastic")
    text += elastic_text(elastic["records"], list(problems(elastic["records"]))) if elastic else ""
    long = load("stability_long")
    path.write_text(text + (long_text(long) if long else ""))


def elastic_text(records, bad):
    """The scenes again with elastic cage halves."""
    count = Counter(r["outcome"] for r in records)
    slow = largest(records, "ratio", lambda r: r["admissible"] and r["outcome"] == "finished")
    energy = largest(records, "balance", lambda r: r["outcome"] == "finished" and r["admissible"])
    return f"""## The same with elastic cage halves

{len(records)} of the scenes with `scene.cage = elastic`, those of rivets by closed forms left out, which have no modes: {count["finished"]} finished,
{count["discarded"]} discarded, {count["refused"]} refused, {count["crashed"]} crashed, {count["hung"]} hung, {count["not finite"]} with a value that is not
finite. Run time relative to the working point with elastic halves: at most {slow["ratio"]:.1f} ({slow["family"]}: {slow["name"]}); energy: at most
{energy["balance"]:.1e} ({energy["family"]}: {energy["name"]}). {"What must not happen: " + "; ".join(bad) if bad else "Nothing that must not happen."}

"""


def energy_text(records):
    """Paragraph about the scenes whose energy balance does not close."""
    open_ = sorted(
        (r for r in records if r.get("balance", 0.0) > 0.01 and r["family"] != "tolerance"),
        key=lambda r: -r["residual"],
    )
    if not open_:
        return ""
    worst = ", ".join(f"{r['family']}: {r['name']} ({r['residual']:.1g} J)" for r in open_[:4])
    return f"""The balance does not close to 1 % in {len(open_)} scenes, most of them at or near standstill, where all energies are microjoules.
The largest residuals: {worst}.
The work integral takes the power at predicted velocities and subtracts their excess dissipation by linear rates (`verlet.c`); the rest of the difference
between predicted and corrected velocities remains.

"""


def slow_row(r):
    path = {1: "Verlet", 2: "Runge-Kutta"}.get(r["path"], r["path"])
    return f"{r['family']}: {r['name']}", f"{r['ratio']:.1f}", f"{r['evaluations'] / r['t'] / 1e3:.0f}", path


def long_text(data):
    tiny, turns, rows = data["tiny_steps"], data["many_turns"], data["long_run"]["rows"]
    last = rows[-1]
    drift = np.polyfit([r["t"] for r in rows], [r["bearing.energy_residual"] for r in rows], 1)[0]
    loss = np.mean([r["bearing.power_loss"] for r in rows])
    differences = ", ".join(f"{name} {value:.1e}" for name, value in turns["differences"].items())
    text = f"""## Long runs

**{tiny["steps"]:,} communication steps of 1 ns**: no status but OK, clock off by {tiny["clock_error"]:.1e} s, energy residual {tiny["residual"]:.1e} J,
{1e6 * tiny["cpu_per_step"]:.1f} µs of processor time each.

**{last["t"]:g} s of the working point** with rigid halves ({last["psi"] / (2 * np.pi):,.0f} turns of the cage, {last["solver.steps"]:,.0f} steps): the energy
residual is
{last["bearing.energy_residual"]:.2e} J, its mean drift {drift:.1e} W: {100 * abs(drift) / loss:.1g} % of the power lost, the work integral's bias at the
default tolerance.
The cage's angle and its mean speed, summed apart, differ by {phase(rows):.1e}; friction states stay within {1e6 * max(r["friction"] for r in rows):.2f} µm,
`stat.time` is off by {abs(last["stat.time"] - last["t"] + 0.05):.1e} s.

**{turns["turns"]:,} turns ahead**: all angles shifted by as many turns (their resolution is then {turns["resolution"]:.1e} rad) and 1 ms run
at tolerance 1e-8, against no shift: {differences} (SI units).

| t [s] | energy residual [J] | RMS pocket force [N] | cage speed [rad/s] | slip of a joint [µm] |
| --- | --- | --- | --- | --- |
"""
    for r in rows[:: max(len(rows) // 10, 1)]:
        cage = f"{r['stat.cage_omega']:.4f}", f"{1e6 * r['cage.dislocation']:.2f}"
        text += row(f"{r['t']:g}", f"{r['bearing.energy_residual']:.2e}", f"{r['stat.Q_c_rms']:.4f}", *cage)
    return text


def phase(rows):
    """Relative difference of the cage's turns after settling: the integrated angle against mean speed times time."""
    a, b = rows[0], rows[-1]
    turned = b["psi"] - a["psi"]
    return abs(turned - (b["stat.cage_omega"] * b["stat.time"] - a["stat.cage_omega"] * a["stat.time"])) / turned
