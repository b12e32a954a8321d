"""Rules for the missing values of a bearing file, and the change of the rivets' stress over each value's usual range.

Each value that scaling.py derives from the 6207's is set once to the lower and once to the upper end of its usual
range, all others by rule, in the 6309 at its loads and speed by rule, with the same seeds each time.  Values of the
rivet table need a build each.

python benchmarks/rules.py [--short]   half an hour on two cores; --short: two seeds, no builds
python benchmarks/rules.py --page      writes a part of docs/own_bearing.md and riveted_bearing/data/rules.csv from the newest record
"""

import argparse
import tempfile
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from common import ROOT, say, write
from records import newest_record

import riveted_bearing as rb
from rivet_model import table
from rivet_model.build import make_table
from riveted_bearing.bearing import scaling
from riveted_bearing.bearing.assumed import OF_RULES
from riveted_bearing.bearing.assumed import RULES as RULES_TABLE
from riveted_bearing.bearing.bearing_file import bearing_case
from riveted_bearing.bearing.rules import RIVET
from riveted_bearing.building.rivet import geometry_of

BEARING, T_END, SEEDS = OF_RULES, 0.25, 8
PAGE = ROOT / "docs" / "own_bearing.md"
MARKS = "<!-- Written by benchmarks/rules.py, do not edit: -->\n", "<!-- end of what benchmarks/rules.py writes -->\n"
LETTERS = {  # of the dimensions in the page's first picture
    "cage.D_o": "A",
    "cage.D_i": "C",
    "cage.width": "E",
    "cage.land_width": "F",
    "cage.land_x": "G",
    "cage.pocket_clearance": "H",
    "cage.guide_clearance": "J",
    "rivet.shank_diameter": "K",
    "rivet.flange_thickness": "L",
    "rivet.head_diameter": "M",
    "rivet.head_height": "N",
    "rivet.fillet_radius": "P",
    "rivet.relief_radius": "Q",
    "rivet.relief_depth": "R",
    "rivet.edge_break": "S",
    "rivet.seat_diameter": "T",
    "joint.fit": "U",
}
INTRO = f"""## Numbers to take from the drawing

A value that the file leaves out is scaled from the paper's 6207. The table shows how the stress changes if the value is at either end of its
usual range: first take those from the drawing that move the stress most. Stress is the 99.9 % quantile of the worst head of the
{BEARING}, {{p999:.0f}} MPa by rule (mean {{mean:.0f}} MPa), with elastic halves and the standard error of {{seeds}} seeds of {T_END:g} s.
`riveted-bearing sensitivity` measures the same in your bearing.

D is the ball diameter, d_m the pitch diameter, B the bearing's width. Ranges are multiples of the rule's value, with sources in
`riveted_bearing/data/rules.csv`. *: less if the cage were wider than {scaling.WIDEST_CAGE} B.

| | value | by rule | range | at its low end, % | high end, % |
|---|---|---|---|---|---|"""
MATERIALS_TABLE = """
The cage is of bronze by default. Other materials change the stress, with the preload at 86 °C, in %:

| material | 99.9 % quantile | mean |
|---|---|---|"""
CLOSE = """
Mass, inertia and damping of the ring (`ring.*`) move the stress by less than 2 %. The land's contact `cage.K_land` scales as E* of cage and ring.
"""


@dataclass(frozen=True)
class Rule:
    """A rule: name in a bearing file, quantity it scales with, usual range as factors, source of the range."""

    name: str
    of: str
    low: float
    high: float
    source: str

    @property
    def formula(self):
        """The rule as a formula."""
        start = RIVET[self.name.removeprefix("rivet.")] if self.name.startswith("rivet.") else scaling.start(self.name)
        D, d_m, d = scaling.start("bearing.D"), scaling.start("bearing.d_m"), RIVET["shank_diameter"]
        if self.of == "d_m + D":
            return f"d_m {'+' if start > d_m else '−'} {abs(start - d_m) / D:.3g} D"
        if self.of == "d^2":
            return f"{1e-6 * start / d**2:.3g} N/mm² K²"
        return {
            "class CN": "middle of class CN (ISO 5753-1)",
            "D": f"{start / D:.3g} D",
            "axial": f"{start / D:.3g} D*",
            "d": f"{start / d:.3g} K",
            "head": f"{start / RIVET['head_diameter']:.3g} M, less at narrow bridges",
            "ring": "6207's × (bore/35 mm)² B/17 mm",
            "tilting ring": "6207's × (bore/35 mm)⁴ B/17 mm",
            "damping ratio": "6207's × (bore/35 mm)³ B/17 mm",
        }[self.of]


RULES = (
    Rule("cage.pocket_clearance", "D", 0.5, 2.0, "0.9–3.6 % of the ball"),
    Rule("cage.guide_clearance", "D", 0.5, 2.0, "0.17–0.7 % of the land"),
    Rule("bearing.P_d", "class CN", 0.45, 1.6, "class CN"),
    Rule("cage.D_o", "d_m + D", 0.99, 1.01, "10 % of the cage's height"),
    Rule("cage.D_i", "d_m + D", 0.99, 1.01, "10 % of the cage's height"),
    Rule("cage.width", "axial", 0.995, 1.03, "room of land and bearing"),
    Rule("cage.land_width", "axial", 0.7, 1.1, "assumed"),
    Rule("cage.land_x", "axial", 0.8, 1.0, "assumed; rule: at the edge"),
    Rule("rivet.shank_diameter", "D", 0.8, 1.25, "next diameters"),
    Rule("rivet.flange_thickness", "D", 0.8, 1.25, "assumed"),
    Rule("rivet.head_diameter", "d", 0.95, 1.05, "ISO 1051 and smaller"),
    Rule("rivet.head_height", "d", 0.8, 1.2, "ISO 1051 and smaller"),
    Rule("rivet.fillet_radius", "d", 0.6, 1.8, "standards, 0.03 to 0.1 d"),
    Rule("rivet.relief_radius", "d", 0.8, 1.1, "assumed"),
    Rule("rivet.relief_depth", "d", 0.7, 1.3, "assumed"),
    Rule("rivet.edge_break", "d", 0.8, 1.3, "assumed"),
    Rule("rivet.seat_diameter", "head", 0.95, 1.05, "assumed"),
    Rule("joint.preload", "d^2", 0.5, 3.0, "the paper: 0 to 60 N"),
    Rule("joint.fit", "d", 0.0, 2.0, "the paper: −0.02 to 0 mm"),
    Rule("joint.swell", "d", 0.0, 2.0, "assumed"),
    Rule("ring.m", "ring", 0.5, 4.0, "bare ring to heavy shaft"),
    Rule("ring.c", "ring", 0.5, 2.0, "assumed"),
    Rule("ring.J_t", "tilting ring", 0.75, 4.0, "bare ring to heavy shaft"),
    Rule("ring.c_tilt", "damping ratio", 0.5, 2.0, "assumed"),
)
MATERIALS = ("brass", "steel", "PA66-GF25", "PEEK")  # beside bronze, which stands where none is named


def needs_build(rule):
    """Whether the rivet table depends on the value."""
    return rule.name.startswith("rivet.") or rule.name in scaling.SHAPE.values()


def stress(fmu, parameters, seeds):
    """99.9 % quantile and mean of the worst head [seeds, 2] in Pa."""
    found = [
        rb.run(None, fmu=fmu, seed=seed, t_end=T_END, parameters=parameters, outputs=["ring.y"]).summary
        for seed in seeds
    ]
    return np.array([[summary["stat.sigma_head_p999"], summary["stat.sigma_head_mean"]] for summary in found])


def built(folder, stem, section):
    """An FMU of the bearing with a section of its file."""
    path = folder / f"{stem}.toml"
    path.write_text(f'designation = "{BEARING}"\n{section}', encoding="utf-8")
    json = folder / f"{stem}.json"
    table.write(make_table(geometry_of(bearing_case(path)), coarse=True, hold_out=0), json)
    return rb.build(path, json, out=folder / f"{stem}.fmu")


def section_of(name, value):
    """The section of a bearing file with one value."""
    return (
        f"[rivet]\n{name.removeprefix('rivet.')} = {value!r}\n"
        if name.startswith("rivet.")
        else f"[parameters]\n{name} = {value!r}\n"
    )


def changes(values, base):
    """Mean change of quantile and mean in per cent, and the standard error of the first."""
    ratio = 100.0 * (values / base - 1.0)
    return {
        "p999": float(ratio[:, 0].mean()),
        "mean": float(ratio[:, 1].mean()),
        "error": float(ratio[:, 0].std(ddof=1) / np.sqrt(len(ratio))),
    }


def measure(short, only=()):
    """The record: of each rule its value and the changes at both ends, of each material the changes.

    only: names of the rules to measure; all if empty.
    """
    seeds, case = range(1, 3 if short else 1 + SEEDS), bearing_case(BEARING)
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        plain = built(folder, "plain", "")
        base = stress(plain, {}, seeds)
        rules, cages = {}, {}
        for rule in RULES:
            if (short and needs_build(rule)) or (only and rule.name not in only):
                continue
            value = (
                case.joint[rule.name.removeprefix("rivet.")]
                if rule.name.startswith("rivet.")
                else case.values[rule.name]
            )
            row = {"value": value}
            for end, factor in (("low", rule.low), ("high", rule.high)):
                try:
                    if needs_build(rule):
                        found = stress(built(folder, "other", section_of(rule.name, factor * value)), {}, seeds)
                    else:
                        found = stress(plain, {rule.name: factor * value}, seeds)
                except rb.UserError as refusal:
                    say(f"{rule.name} = {factor * value:g}: {refusal}")
                    continue
                row[end] = changes(found, base)
            rules[rule.name] = row
            say(f"{rule.name}: {row}")
        for cage in () if short or only else MATERIALS:
            cages[cage] = changes(stress(built(folder, "other", f'[cage]\nmaterial = "{cage}"\n'), {}, seeds), base)
            say(f"{cage}: {cages[cage]}")
    return {
        "seeds": len(seeds),
        "p999": float(base[:, 0].mean()),
        "mean": float(base[:, 1].mean()),
        "rules": rules,
        "materials": cages,
    }


def change_text(row, end):
    """A change in per cent with its standard error."""
    if end not in row:
        return "cannot be built"
    return f"{row[end]['p999']:+.1f}±{row[end]['error']:.1f}" if row[end]["error"] else "0"


def page(record):
    """What docs/own_bearing.md has of a record."""
    lines = [INTRO.format(seeds=record["seeds"], p999=record["p999"] / 1e6, mean=record["mean"] / 1e6)]
    for rule in sorted(RULES, key=lambda rule: LETTERS.get(rule.name, "Z")):
        if rule.name in record["rules"] and not rule.name.startswith("ring."):
            row = record["rules"][rule.name]
            ends = f"{rule.low:g}–{rule.high:g}", change_text(row, "low"), change_text(row, "high")
            lines.append(f"| {LETTERS.get(rule.name, '')} | `{rule.name}` | {rule.formula} | {' | '.join(ends)} |")
    lines.append(MATERIALS_TABLE)
    for name, row in record["materials"].items():
        lines.append(f"| `{name}` | {row['p999']:+.1f}±{row['error']:.1f} | {row['mean']:+.1f} |")
    return "\n".join(lines) + "\n" + CLOSE


def written(text, part):
    """A page with the part between its marks replaced."""
    (head, rest), mark = text.split(MARKS[0]), MARKS[1]
    return head + MARKS[0] + part + mark + rest.split(mark)[1]


def effects(record):
    """riveted_bearing/data/rules.csv of a record: the larger change of the two ends, over the stress."""
    lines = ["# Written by benchmarks/rules.py: do not edit.", "name,low,high,stress,source"]
    for rule in RULES:
        if rule.name in record["rules"]:
            row = record["rules"][rule.name]
            stress = max(abs(row[end]["p999"]) for end in ("low", "high") if end in row)
            lines.append(f'{rule.name},{rule.low:g},{rule.high:g},{0.01 * stress:.3g},"{rule.source}"')
    return "\n".join(lines) + "\n"


def main():
    """Command line."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--short", action="store_true")
    parser.add_argument(
        "--only",
        nargs="+",
        default=(),
        metavar="NAME",
        help="measure these rules; keep the others of the newest record",
    )
    parser.add_argument("--page", action="store_true", help="only write page and table, from the newest record")
    options = parser.parse_args()
    if not options.page:
        found = measure(options.short, options.only)
        if options.only:
            old = newest_record("rules")
            assert (old["seeds"], old["p999"]) == (found["seeds"], found["p999"]), (
                "another build or other seeds: measure all"
            )
            found |= {"rules": old["rules"] | found["rules"], "materials": old["materials"]}
        write("rules", found, options.short)
    record = newest_record("rules")
    PAGE.write_text(written(PAGE.read_text(encoding="utf-8"), page(record)), encoding="utf-8")
    Path(str(RULES_TABLE)).write_text(effects(record), encoding="utf-8")


if __name__ == "__main__":
    main()
