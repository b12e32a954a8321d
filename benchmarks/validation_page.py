"""docs/validation.md and the picture of its skid from the newest record of benchmarks/validation.py in
benchmarks/results/.  The text stands in pages/validation.md; each chapter's function returns the numbers in it.
"""

import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt
import numpy as np
from common import ROOT
from pages import page_text
from records import newest_record
from svg import save_svg

from riveted_bearing.show.style import HEAD, MIDDLE, MUTED, STYLE

PAGE, PICTURES = ROOT / "docs" / "validation.md", ROOT / "docs" / "validation"

# Line on the page -> FILE of tests/test_FILE.py, tests of which the largest value is shown, entries of their record
# (none: the largest)
OBSERVED = {
    "dy/dt of core and reference": ("twin", ("derivatives",), ()),
    "Jacobian, quantiles 50, 90, 99 %": ("twin", ("jacobian",), ()),
    "all outputs": ("twin", ("outputs",), ()),
    "trajectory at 1e-5…1e-8, explicit": ("twin", ("trajectory",), ("EXPLICIT",)),
    "trajectory at 1e-5…1e-8, Verlet": ("twin", ("trajectory",), ("VERLET",)),
    "dE/dt against net power": ("twin", ("power_is_rate_of_energy",), ()),
    "dy/dt turned, mirrored, in other units": (
        "invariance",
        ("turn_by_a_pitch", "mirror_z", "mirror_x", "other_units"),
        (),
    ),
    "1 ms turned, mirrored": ("invariance", ("trajectory_of_the_image",), ()),
    "energy balance of 10 ms": ("energy", ("energy_balance_of_a_run",), ("of what is dissipated",)),
    "moment about the axis [N·m]": ("conservation", ("angular_momentum_about_the_axis",), ("difference",)),
}
STATISTICS = ("cage_omega", "Q_c_mean", "Q_c_p999", "sigma_head_mean", "sigma_head_p999")
HALVES = [  # fit [um], r/min, tilt [deg] that are shown
    *((-10, speed, 0.0) for speed in (4000, 24000)),
    *((fit, 18238, 0.0) for fit in (-40, 40)),
    *((-10, 18238, tilt) for tilt in (0.2, 0.5)),
]
LOADS = {
    (515.0, 2994.0): "515, 2,994",
    (200.0, 1500.0): "200, 1,500",
    (800.0, 800.0): "800, 800",
    (1500.0, 0.0): "1,500, 0",
}


def main():
    data = newest_record("validation")
    PAGE.write_text(page(data), encoding="utf-8")
    picture_of_skid(data)
    print(f"wrote {PAGE.relative_to(ROOT)}")


def page(data):
    """The page of a record, as text."""
    usual = data["working_point"][1]["expected"]
    clearance = [row for row in data["clearance"] if row["expected"] != usual]
    values = {
        "data": data,
        "forms": against(data["contacts"][2:] + data["kinematics"] + data["distribution"]),
        "working_point": against(data["working_point"] + clearance),
        "race_control": race_control(data["race_control"]),
        "halves": halves(data["halves"]),
        "rivets": rivets_over_speed(data["rivets_over_speed"]),
        "tests": tests(data["tests"]),
        "twins": twins(data["twins"]),
        "statistics": statistics(data["statistics"]),
        "ledger": ledger(data["ledger"]),
        "skid": skid(data["skid"]),
        "cage": cage_forces(data["cage_forces"]),
        "heat": heat(data["heat"]),
    }
    return page_text("validation.md", values)


def against(rows):
    """Quantity, source, expected, computed, difference; of core and reference the one farther from the source."""
    shown = []
    for row in rows:
        reached = [row[name] for name in ("core", "reference") if row.get(name) is not None]
        worst = max(reached, key=lambda value: abs(value / row["expected"] - 1.0))
        quantity = row["quantity"] + (f" [{row['unit']}]" if row["unit"] != "1" else "")
        shown.append((quantity, row["source"], *map(five, (row["expected"], worst)), f"{row['difference']:+.2g} %"))
    return shown


def five(number):
    """Five digits of a number."""
    return f"{number:.5g}"


def span(values, form):
    """Least and largest of some numbers."""
    low, high = (format(bound, form) for bound in (min(values), max(values)))
    return low if low == high else f"{low}…{high}"


def race_control(found):
    """Spin in the traction against outer race control: least and largest difference over the speeds."""
    names = {"x_off": "+.2f", "y_off": "+.2g", "cage_off": "+.2f", "alpha_i_off": "+.2f", "alpha_e_off": "+.2f"}
    rows = []
    for load, title in LOADS.items():
        own = [row for row in found if (row["F_x"], row["F_y"]) == load]
        spans = (span([row[key] for row in own], form) if key in own[0] else "–" for key, form in names.items())
        rows.append((title, *spans))
    return rows


def halves(found):
    """Pocket force and stress with rigid and elastic halves, over speed, fit and tilt."""
    off = [100.0 * (row["two_half"][2] / row["elastic"][2] - 1.0) for row in found]
    rows = [
        (
            f"{row['fit']:+d}",
            f"{row['speed']:,}",
            f"{row['tilt']:+.1f}",
            *(f"{a:.0f}/{b:.0f}" for a, b in zip(row["two_half"], row["elastic"], strict=True)),
        )
        for row in found
        if (row["fit"], row["speed"], row["tilt"]) in HALVES
    ]
    return {"least": min(off), "most": max(off), "rows": rows}


def rivets_over_speed(rows):
    """Tension and stress between the impacts, by the table and by direct contact."""
    found = {(row["P"], row["speed"]): row for row in rows}
    preloads, speeds = (sorted({key[i] for key in found}) for i in (0, 1))
    pairs = [(name, P) for name in ("T", "head") for P in preloads]
    shown = [
        (f"{v:,.0f}", *(f"{found[P, v][name]:.1f}/{found[P, v][f'{name}_direct']:.1f}" for name, P in pairs))
        for v in speeds[1::2]  # at the lowest both are equal
    ]
    off = [100.0 * (row["head"] / row["head_direct"] - 1.0) for row in rows]
    columns = [f"{name}, {P:.0f} N" for name, P in pairs]
    return {"least": min(off), "most": max(off), "columns": columns, "rows": shown}


def tests(records):
    """Records of the tests."""
    found = {}
    for record in records:
        names = record["names"] or [record["entry"]] * len(record["values"])
        found.setdefault(record["test"], []).extend(zip(names, record["values"], strict=True))
    rows = []
    for label, (file, names, chosen) in OBSERVED.items():
        pairs = [
            pair for name in names for pair in found[f"test_{file}::test_{name}"] if not chosen or pair[0] in chosen
        ]
        if not chosen and label[:8] != "Jacobian":
            pairs = [max(pairs, key=lambda pair: abs(pair[1]))]
        rows.append((label, f"`test_{file}`", ", ".join(f"{value:.1e}" for _, value in pairs)))
    return rows


def twins(found):
    """The first millisecond."""
    rows = []
    for row in found["rows"]:
        cells = (f"{value:.1e} (`{name}`)" for value, name in zip(row["values"], row["channels"], strict=True))
        rows.append((f"`{row['scene']}`", "motion" if row["motion"] else "loads, stresses, powers", *cells))
    return {"columns": [f"FMU at {tolerance:.0e}" for tolerance in found["tolerances"]], "rows": rows}


def statistics(found):
    """Statistics after the trajectories have parted."""
    return [
        (
            f"`{row['name']}`" + ("" if row["unit"] == "1" else f" [{row['unit']}]"),
            *map(five, (row["reference"], row["mean"])),
            f"{row['scatter']:.2g}",
            f"{row['deviation']:+.1f}",
        )
        for row in found["rows"]
        if row["name"].removeprefix("stat.") in STATISTICS
    ]


def ledger(found):
    """The energy of the reference's run, by kind."""
    return {kind: sum(found[kind].values()) for kind in ("supplied", "stored", "lost")}


def skid(found):
    """NASA TN D-7870."""
    slips = {row["F_x"]: row["slips"] for row in found["rows"]}
    grows = [f"{F_x:,.0f} N" for F_x, row in slips.items() if np.all(np.diff(row) > 0.0)]
    every = [slip for row in slips.values() for slip in row]
    return {"least": min(every), "most": max(every), "grows": grows}


def picture_of_skid(data):
    found = data["skid"]
    with plt.rc_context(STYLE | {"font.size": 10}):
        figure, ax = plt.subplots(figsize=(5.4, 3.4), layout="constrained")
        for row, colour in zip(found["rows"], (HEAD, MIDDLE, MUTED), strict=True):
            ax.plot(found["speeds"], row["slips"], "o-", ms=4, color=colour, label=f"{row['F_x']:,.0f} N")
        ax.axhline(6.0, color="black", lw=0.8, ls="--")
        ax.text(found["speeds"][0], 5.85, "largest of the report", va="top")
        ax.set(title="Skid of the 120-mm bearing under three thrusts, %", xlabel="r/min")
        ax.xaxis.set_major_formatter("{x:,.0f}")
        ax.legend(loc="center", ncols=3, fontsize=10)
        save_svg(figure, PICTURES / "skid.svg")


def cage_forces(found):
    """ASME J. Lubr. Tech. 101(2)."""
    sensors = [name for name in found["sensed"][0] if name.endswith("Hz")]
    sensed = [
        {"ratio": row["ratio"], "F_x": row["F_x"], "forces": [row["force"], *(row[s] for s in sensors)]}
        for row in found["sensed"]
    ]
    thrusts = sorted({row["F_x"] for row in sensed})
    cells = {(row["ratio"], row["F_x"]): "/".join(f"{force:.0f}" for force in row["forces"]) for row in sensed}
    forces = [force for row in sensed for force in row["forces"]]
    return {
        "slow": max(row[cage][2] for row in found["rows"][:2] for cage in ("two_half", "elastic")),
        "sensors": sensors,
        "least": min(forces),
        "most": max(forces),
        "columns": [f"thrust {F_x:,.0f} N" for F_x in thrusts],
        "sensed": [(f"{r:g}", *(cells[r, F_x] for F_x in thrusts)) for r in sorted({key[0] for key in cells})],
    }


PARTS = {
    "races": "races",
    "inlet": "inlets",
    "ball_drag": "balls' drag",
    "cage_drag": "cage's",
    "ring_drag": "ring's",
    "land": "lands",
    "pockets": "pockets",
}


def heat(found):
    """NASA TP-2275."""
    measured, total = (np.array([row[name] for row in found["rows"]]) for name in ("measured", "total"))
    rows = [
        (
            f"{row['speed']:,}",
            f"{row['measured']:.0f}",
            f"{row['total']:.0f}",
            f"{row['total'] / row['measured']:.2f}",
            *(f"{row[name]:.0f}" for name in PARTS),
        )
        for row in found["rows"]
    ]
    first = found["changed"][0]

    def shown(row):
        return row is first or np.abs(np.subtract(row["ratio"], first["ratio"])).max() > 0.15

    return {
        "factor": max((total / measured).max(), (measured / total).max()),
        "own": first["exponent"],
        "exponents": found["exponents"],
        "parts": list(PARTS.values()),
        "rows": rows,
        "ends": [f"{found['rows'][i]['speed']:,}" for i in (0, -1)],
        "varied": [
            (row["change"], *(f"{row['ratio'][i]:.2f}" for i in (0, -1)), f"{row['exponent']:.2f}")
            for row in found["changed"]
            if shown(row)
        ],
    }


if __name__ == "__main__":
    main()
