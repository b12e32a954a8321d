"""What follows by rule for a bearing of which only the designation is known, and by how much the rivets' stress moves
over what is usual: docs/rules.md.

Each value that scaling.py makes from the 6207's stands once at the lower and once at the upper end of its usual range,
all others by rule, in the 6309 at its loads and speed by rule; the same seeds each time.  Values that the rivet table
is made from take a build each.

python benchmarks/rules.py [--short]     half an hour on two cores; --short takes two seeds and the values alone that need no build
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
from riveted_bearing import scaling
from riveted_bearing.bearings import RIVET, bearing_case
from riveted_bearing.rivet import geometry_of

BEARING, T_END, SEEDS = "6309", 0.25, 8
PAGE = ROOT / "docs" / "rules.md"
INTRO = f"""<!-- Written by benchmarks/rules.py: do not edit. -->
# What follows by rule, and what hangs on it

A bearing file leaves values out; these are scaled from the 6207 of the paper (`riveted_bearing/scaling.py`). The table has each rule, and how far the rivets'
stress moves when one value stands at either end of its usual range while all others stay.

Bearing: the {BEARING} by its designation alone, its loads and speed by rule, elastic cage halves, {{seeds}} seeds of {T_END:g} s.
Stress: 99.9 % quantile of the worst head, {{p999:.0f}} MPa by rule (mean {{mean:.0f}} MPa); changes in per cent, with their standard error.
D is the ball's diameter, d_m the pitch diameter, d the shank's diameter, d_h the head's, B the bearing's width.

| value | by rule | usual range | stress at its low end | at its high end | the range |
|---|---|---|---|---|---|"""
MATERIALS_TABLE = """
The cage's material is bronze where none is named. Another one changes the stress by:

| material | 99.9 % quantile | mean |
|---|---|---|"""
CLOSE = """

Rules without a range: balls and loads ([own_bearing.md](own_bearing.md)), mass and inertia of the half by shape and density, the number of vibration modes by
the number of balls, temperatures of the parts by the oil's. The S–N curve follows the strength of the rivet's steel; damage goes with the 15th power of the
stress.
"""


@dataclass(frozen=True)
class Rule:
    """A value by rule: name in a bearing file; of: the quantity that it follows, low, high: usual range as factors of
    the value by rule; why: of the range.
    """

    name: str
    of: str
    low: float
    high: float
    why: str

    @property
    def formula(self):
        """The rule as a formula of the ball's diameter D, the pitch diameter d_m, the shank's diameter d, the head's
        d_h [m], bore and width.
        """
        start = RIVET[self.name.removeprefix("rivet.")] if self.name.startswith("rivet.") else scaling.start(self.name)
        D, d_m, d = scaling.start("bearing.D"), scaling.start("bearing.d_m"), RIVET["shank_diameter"]
        if self.of == "d_m + D":
            return f"d_m {'+' if start > d_m else '−'} {abs(start - d_m) / D:.3g} D"
        if self.of == "d^2":
            return f"{1e-6 * start / d**2:.3g} N/mm² d²"
        return {
            "class CN": "middle of class CN for the bore (ISO 5753-1)",
            "D": f"{start / D:.3g} D",
            "axial": f"{start / D:.3g} D, at most {scaling.WIDEST_CAGE} B for the cage",
            "d": f"{start / d:.3g} d",
            "head": f"{start / RIVET['head_diameter']:.3g} d_h, less where the bridge is narrow",
            "ring": "the 6207's times (bore/35 mm)² B/17 mm",
            "tilting ring": "the 6207's times (bore/35 mm)⁴ B/17 mm",
            "damping ratio": "the 6207's times the root of (bore/35 mm)⁴ B/17 mm",
        }[self.of]


RULES = (
    Rule("cage.pocket_clearance", "D", 0.5, 2.0, "0.9 to 3.6 % of the ball"),
    Rule("cage.guide_clearance", "D", 0.5, 2.0, "0.17 to 0.7 % of the land"),
    Rule("bearing.P_d", "class CN", 0.45, 1.6, "least and largest of class CN"),
    Rule("cage.D_o", "d_m + D", 0.99, 1.01, "a tenth of the cage's height"),
    Rule("cage.D_i", "d_m + D", 0.99, 1.01, "a tenth of the cage's height"),
    Rule("cage.width", "axial", 0.995, 1.03, "as far as land and bearing have room"),
    Rule("cage.land_width", "axial", 0.7, 1.1, "assumed"),
    Rule("cage.land_x", "axial", 0.8, 1.0, "assumed; by rule at the edge"),
    Rule("rivet.shank_diameter", "D", 0.8, 1.25, "a step of the usual diameters"),
    Rule("rivet.flange_thickness", "D", 0.8, 1.25, "assumed"),
    Rule("rivet.head_diameter", "d", 0.95, 1.05, "round heads of ISO 1051 and of smaller standards"),
    Rule("rivet.head_height", "d", 0.8, 1.2, "the same"),
    Rule("rivet.fillet_radius", "d", 0.6, 1.8, "0.03 to 0.1 d, the largest that standards allow"),
    Rule("rivet.relief_radius", "d", 0.8, 1.1, "assumed"),
    Rule("rivet.relief_depth", "d", 0.7, 1.3, "assumed"),
    Rule("rivet.edge_break", "d", 0.8, 1.3, "assumed"),
    Rule("rivet.seat_diameter", "head", 0.95, 1.05, "assumed"),
    Rule("joint.preload", "d^2", 0.5, 3.0, "the paper's studies: 0 to 60 N"),
    Rule("joint.fit", "d", 0.0, 2.0, "the paper's studies: -0.02 to 0 mm in the middle of their range"),
    Rule("joint.swell", "d", 0.0, 2.0, "assumed"),
    Rule("ring.m", "ring", 0.5, 4.0, "the ring alone to a heavy shaft"),
    Rule("ring.c", "ring", 0.5, 2.0, "assumed"),
    Rule("ring.J_t", "tilting ring", 0.5, 4.0, "the ring alone to a heavy shaft"),
    Rule("ring.c_tilt", "damping ratio", 0.5, 2.0, "assumed"),
)
MATERIALS = ("brass", "steel", "PA66-GF25", "PEEK")  # beside bronze, which stands where none is named


def needs_build(rule):
    """Whether the rivet table is made from the value."""
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
    """The section of a bearing file that gives one value."""
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
    """The record: by rule, its value and the changes at both ends; by material the changes.  only: names of the rules
    that are wanted, all without any.
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
    return f"{row[end]['p999']:+.1f} ± {row[end]['error']:.1f}" if row[end]["error"] else "0"


def page(record):
    """docs/rules.md of a record."""
    lines = [INTRO.format(seeds=record["seeds"], p999=record["p999"] / 1e6, mean=record["mean"] / 1e6)]
    for rule in RULES:
        if rule.name in record["rules"]:
            row = record["rules"][rule.name]
            lines.append(
                f"| `{rule.name}` | {rule.formula} | {rule.low:g} … {rule.high:g} times | {change_text(row, 'low')} | {change_text(row, 'high')} | {rule.why} |"
            )
    lines.append(MATERIALS_TABLE)
    lines += [
        f"| `{name}` | {row['p999']:+.1f} ± {row['error']:.1f} % | {row['mean']:+.1f} % |"
        for name, row in record["materials"].items()
    ]
    return "\n".join(lines) + CLOSE


def main():
    """Command line."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--short", action="store_true")
    parser.add_argument(
        "--only",
        nargs="+",
        default=(),
        metavar="NAME",
        help="measure these rules again; the others stay as the newest record has them",
    )
    parser.add_argument("--page", action="store_true", help="the page again, from the newest record")
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
    PAGE.write_text(page(newest_record("rules")), encoding="utf-8")


if __name__ == "__main__":
    main()
