"""docs/validation.md and the picture of its skid from the newest record of benchmarks/validation.py in
benchmarks/results/.
"""

import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt
import numpy as np
from common import ROOT
from records import newest_record

from riveted_bearing.show.plot import HEAD, MIDDLE, MUTED, STYLE

PAGE, PICTURES = ROOT / "docs" / "validation.md", ROOT / "docs" / "validation"

# Line on the page -> FILE of tests/test_FILE.py, tests of which the largest value is shown, entries of their record
# (none: the largest)
OBSERVED = {
    "dy/dt of core and reference": ("twin", ("derivatives",), ()),
    "Jacobian, quantiles 50, 90, 99 %": ("twin", ("jacobian",), ()),
    "start, two solvers": ("twin", ("start",), ()),
    "all outputs": ("twin", ("outputs",), ()),
    "trajectory at 1e-5…1e-8, explicit": ("twin", ("trajectory",), ("EXPLICIT",)),
    "trajectory at 1e-5…1e-8, Verlet": ("twin", ("trajectory",), ("VERLET",)),
    "dE/dt against net power": ("twin", ("power_is_rate_of_energy",), ()),
    "energy balance, housing and frame moving [J]": ("twin", ("ledger",), ("residual",)),
    "dy/dt turned, mirrored, in other units": (
        "invariance",
        ("turn_by_a_pitch", "mirror_z", "mirror_x", "other_units"),
        (),
    ),
    "the same of elastic halves": ("invariance", ("turn_of_elastic_halves", "mirror_of_elastic_halves"), ()),
    "1 ms turned, mirrored": ("invariance", ("trajectory_of_the_image",), ()),
    "drift of 26.5 J without losses [J]": ("energy", ("lossless_energy_converges",), ("J at 1e-7",)),
    "energy balance of 10 ms": ("energy", ("energy_balance_of_a_run",), ("of what is dissipated",)),
    "moment about the axis [N·m]": ("conservation", ("angular_momentum_about_the_axis",), ("difference",)),
    "drift of 0.4 N·m·s, Runge–Kutta, Verlet": (
        "conservation",
        ("angular_momentum_stays",),
        ("Runge-Kutta", "Verlet at 1e-5"),
    ),
}
STATISTICS = ("contact_duty", "cage_omega", "Q_c_mean", "Q_c_p999")
STATISTICS += tuple(f"sigma_{place}_{name}" for place in ("head", "mid") for name in ("mean", "p999"))
HALVES = [  # fit [um], r/min, tilt [deg] that are shown
    *((-10, speed, 0.0) for speed in (4000, 12000, 24000)),
    *((fit, 18238, 0.0) for fit in (-40, 40)),
    *((-10, 18238, tilt) for tilt in (-0.5, 0.2, 0.5)),
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
    chapters = (
        numbers,
        race_control,
        halves,
        rivets_over_speed,
        tests,
        twins,
        statistics,
        ledger,
        skid,
        cage_forces,
        heat,
    )
    return (
        "\n".join([head(data), *([SHORT_FORM] if data["short"] else []), *(chapter(data) for chapter in chapters)])
        + "\n"
    )


def head(data):
    return f"""# Validation

Numbers from outside the model, each beside its source, the model's value and the difference.
`python benchmarks/validation.py` writes this page; all rows are in `benchmarks/results/*/validation.csv`.
Commit {data["commit"]}, {data["machine"]["processor"]}, Python {data["machine"]["python"]}. *Core*: C code of the FMU; *reference*: independent Python code.
"""


SHORT_FORM = """
**Short form** (`--short`): statistics and energy over 0.01 s instead of 0.1 s, the published experiments over 0.05 s instead of 0.4 s.
"""


def section(title, text, *parts):
    return "\n".join([f"\n## {title}\n", text, *(f"\n{part}" for part in parts)])


def table(columns, rows):
    """A Markdown table; numbers get five digits."""
    lines = ["| " + " | ".join(columns) + " |", "|" + "---|" * len(columns)]
    lines += [
        "| " + " | ".join(cell if isinstance(cell, str) else f"{cell:.5g}" for cell in row) + " |" for row in rows
    ]
    return "\n".join(lines)


def against(rows):
    """Quantity, source, expected, computed, difference; of core and reference the one farther from the source."""
    shown = []
    for row in rows:
        reached = [row[name] for name in ("core", "reference") if row.get(name) is not None]
        worst = max(reached, key=lambda value: abs(value / row["expected"] - 1.0))
        quantity = row["quantity"] + (f" [{row['unit']}]" if row["unit"] != "1" else "")
        shown.append((quantity, row["source"], row["expected"], worst, f"{row['difference']:+.2g} %"))
    return table(("quantity", "source", "expected", "computed", "difference"), shown)


def span(values, form):
    """Least and largest of some numbers."""
    low, high = (format(bound, form) for bound in (min(values), max(values)))
    return low if low == high else f"{low}…{high}"


def numbers(data):
    """Contacts, kinematics, load distribution, working point and clearance."""
    text = (
        "Contacts (f_i 0.515, 207 GPa): core and reference. Fault frequencies of the 6207 at 18,238 r/min and load distribution (`quasi_static`, no\n"
        "clearance): reference. Orbit: core without drag, films and cage contact, traction 45 times as steep."
    )
    forms = section(
        "Closed forms and books", text, against(data["contacts"] + data["kinematics"] + data["distribution"])
    )
    text = (
        "Means of the FMU over 0.2 s of `demo` against the Jones–Harris equilibrium with outer race control; last rows: 0.04 s at other clearances.\n"
        "The equilibrium omits cage and traction, which carries 1.5 % of the axial load."
    )
    usual = data["working_point"][1]["expected"]
    clearance = [row for row in data["clearance"] if row["expected"] != usual]
    return "\n".join([forms, section("Working point and clearance", text, against(data["working_point"] + clearance))])


def race_control(data):
    """Spin in the traction against outer race control over speeds and loads."""
    rows = []
    names = (
        ("x_off", "+.2f"),
        ("y_off", "+.2g"),
        ("cage_off", "+.2f"),
        ("alpha_i_off", "+.2f"),
        ("alpha_e_off", "+.2f"),
    )
    for load, name in LOADS.items():
        found = [row for row in data["race_control"] if (row["F_x"], row["F_y"]) == load]
        rows.append(
            (name, *(span([row[key] for row in found], form) if key in found[0] else "–" for key, form in names))
        )
    text = (
        "`demo` with `scene.traction = sliced` against `quasi_static` with outer race control (Jones): least and largest difference over 3,000, 10,000,\n"
        "17,000 and 24,000 r/min, means of 0.05 s. In the dynamics slip and spin decide which race carries a ball's gyroscopic moment.\n"
        "Under thrust the contact angles lie between those of outer and inner control. Under the larger radial loads y lies up to 0.06 µm outside both\n"
        "at 3,000 and 10,000 r/min, for an unknown reason."
    )
    return section(
        "Spin and race control",
        text,
        table(("thrust, radial load [N]", "x [%]", "y [µm]", "cage speed [%]", "α_i [°]", "α_e [°]"), rows),
    )


def halves(data):
    """Pocket force and stress with rigid and elastic halves, over speed, fit and tilt."""
    off = [100.0 * (row["two_half"][2] / row["elastic"][2] - 1.0) for row in data["halves"]]
    rows = []
    for row in data["halves"]:
        if (row["fit"], row["speed"], row["tilt"]) in HALVES:
            pairs = (f"{a:.0f}/{b:.0f}" for a, b in zip(row["two_half"], row["elastic"], strict=True))
            rows.append((f"{row['fit']:+d}", f"{row['speed']:,}", f"{row['tilt']:+.1f}", *pairs))
    text = (
        "`scene.cage = two_half`/`elastic` in `demo`, means of eight seeds, 0.2 s after 0.2 s. Elastic walls lower impacts: with rigid halves\n"
        f"the 99.9 % quantile of the head stress differs by {min(off):+.0f} to {max(off):+.0f} % from that with elastic ones."
    )
    columns = (
        "fit [µm]",
        "r/min",
        "tilt [°]",
        "pocket force, 99.9 % [N]",
        "head, mean [MPa]",
        "head, 99.9 % [MPa]",
        "middle, 99.9 % [MPa]",
    )
    return section("Rigid and elastic halves", text, table(columns, rows))


def rivets_over_speed(data):
    """Tension and stress between the impacts."""
    found = {(row["P"], row["speed"]): row for row in data["rivets_over_speed"]}
    preloads, speeds = (sorted({key[i] for key in found}) for i in (0, 1))
    rows = []
    for speed in speeds[1::2]:  # at the lowest both are equal
        cells = [
            f"{found[P, speed][name]:.1f}/{found[P, speed][f'{name}_direct']:.1f}"
            for name in ("T", "head")
            for P in preloads
        ]
        rows.append((f"{speed:,.0f}", *cells))
    off = [100.0 * (row["head"] / row["head_direct"] - 1.0) for row in found.values()]
    text = (
        "Tension T [N] and head stress [MPa] of a rivet of 20, 40 and 60 N preload under the centrifugal load: shipped table/direct contact of plates and\n"
        f"rivet on finer finite elements, stress solved anew. Over all speeds the head stress differs by {min(off):+.1f} to {max(off):+.1f} %."
    )
    columns = ("r/min", *(f"T, {P:.0f} N" for P in preloads), *(f"head, {P:.0f} N" for P in preloads))
    return section("Rivets between the impacts", text, table(columns, rows))


def tests(data):
    """Records of the tests."""
    found = {}
    for record in data["tests"]:
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
    text = (
        "Largest values that the tests recorded, relative without a unit. Start and trajectories are in error scales."
    )
    return section("Symmetry, conservation, convergence", text, table(("quantity", "tests", "observed"), rows))


def twins(data):
    """The first millisecond."""
    rows = []
    for row in data["twins"]["rows"]:
        kind = "motion" if row["motion"] else "loads, stresses, powers"
        rows.append(
            (
                f"`{row['scene']}`",
                kind,
                *(f"{value:.1e} (`{name}`)" for value, name in zip(row["values"], row["channels"], strict=True)),
            )
        )
    columns = ("scene", "largest difference", *(f"FMU at {tolerance:.0e}" for tolerance in data["twins"]["tolerances"]))
    text = (
        "FMU and reference (SciPy, DOP853) at the same 20 instants of the first millisecond. Motion: in parts of 10 µm and 0.1 m/s; loads and\n"
        "stresses: of the largest value, at least 1 N and 0.1 MPa. A difference that falls with the tolerance is an integration error."
    )
    return section("FMU against reference", text, table(columns, rows), f"![compare]({PICTURES.name}/compare.png)")


def statistics(data):
    """Statistics after the trajectories have parted."""
    found = data["statistics"]
    text = (
        f"After {found['settle']:g} s the trajectories have parted: statistics to {found['long']:g} s of the reference and of {found['seeds']} seeds of the"
        " FMU."
        "\nBoth sample the ends of their steps, which differ: about 1 % of mean force and head stress."
    )
    rows = []
    for row in found["rows"]:
        if row["name"].removeprefix("stat.") in STATISTICS:
            unit = "" if row["unit"] == "1" else f" [{row['unit']}]"
            rows.append(
                (
                    f"`{row['name']}`{unit}",
                    row["reference"],
                    row["mean"],
                    f"{row['scatter']:.2g}",
                    f"{row['deviation']:+.1f}",
                )
            )
    columns = ("statistic", "reference", "FMU, mean", "standard deviation", "difference / deviation")
    return section("Statistics", text, table(columns, rows))


def ledger(data):
    """The energy of the reference's run."""
    found = data["ledger"]
    rows, zero = [], 0
    for title in ("supplied", "stored", "lost"):
        for name, value in found[title].items():
            zero += abs(value) < 1e-2
            if abs(value) > 1e-2:
                rows.append((f"{title}: {name}", f"{value:.4f}"))
    rows.append(("**supplied − stored − lost**", f"{found['residual']:.4f}"))
    text = (
        f"The reference's run of {data['statistics']['long']:g} s; each term is the integral of its own power. {zero} terms below 0.01 J are left out.\n"
        f"Required: closed to 0.1 % of the shaft's work at every communication point; reached: {100.0 * found['share']:.1g} %."
    )
    return section("Energy balance", text, table(("term", "J"), rows))


def skid(data):
    """NASA TN D-7870."""
    found = data["skid"]
    slips = {row["F_x"]: row["slips"] for row in found["rows"]}
    rows = [
        (f"{F_x:,.0f} N", *(f"{slip:+.2f}" for slip in row), "yes" if np.all(np.diff(row) > 0.0) else "no")
        for F_x, row in slips.items()
    ]
    most, least = max(map(max, slips.values())), min(map(min, slips.values()))
    text = (
        "Source: NASA TN D-7870 (Bamberger, Zaretsky, Signer, 1975), abstract: skid under thrust generally grows with speed, to at most 6 % at 25,000 r/min.\n"
        "Computed: a similar bearing (`benchmarks/bearings/120mm.toml`), slip of the cage in % of the orbit without slip at the running contact angles,\n"
        f"mean after {found['settle']:g} s; the last two quarters differ by {found['drift']:.2f} %. Orbit: `quasi_static` with"
        " outer race control, an assumption.\n"
        f"Largest {most:.1f} %, {'within' if most <= 6.0 else 'beyond'} the report's 6 %; least {least:.1f} %.\n"
        "Balls, curvatures, contact angle and oil are assumed; their cage is one piece."
    )
    columns = ("thrust", *(f"{speed:,} r/min" for speed in found["speeds"]), "grows with speed")
    return section("Skid of a 120-mm bearing", text, table(columns, rows), f"![skid]({PICTURES.name}/skid.svg)")


def picture_of_skid(data):
    found = data["skid"]
    with plt.rc_context(STYLE):
        figure, ax = plt.subplots(figsize=(5.0, 3.0), layout="constrained")
        for row, colour in zip(found["rows"], (HEAD, MIDDLE, MUTED), strict=True):
            ax.plot(found["speeds"], row["slips"], ".-", color=colour, label=f"{row['F_x']:.0f} N")
        ax.axhline(6.0, color="black", lw=0.6, ls="--")
        ax.set(title="Skid, 120-mm bearing; dashed: the report's largest", xlabel="r/min", ylabel="%")
        ax.legend()
    figure.savefig(PICTURES / "skid.svg")
    plt.close(figure)


def cage_forces(data):
    """ASME J. Lubr. Tech. 101(2)."""
    found = data["cage_forces"]
    rows = []
    for row in found["rows"][2:]:  # the slow ones: in the text
        pairs = zip(row["two_half"], row["elastic"], (2, 1, 1), strict=True)
        load = (
            row["load"]
            .replace("thrust 2224 N, radial 1112 N", "with 1,112 N radial")
            .replace("thrust 2224 N", "thrust")
        )
        rows.append((f"{row['speed']:,}", load, *(f"{a:.{digits}f}/{b:.{digits}f}" for a, b, digits in pairs)))
    least = max(row[cage][2] for row in found["rows"][:2] for cage in ("two_half", "elastic"))
    text = (
        "Source: Nypan, ASME J. Lubr. Tech. 101(2) (1979) 180, abstract: 25 N at most to 12,000 r/min, measured by the deflection of a part of the cage.\n"
        f"Computed: `benchmarks/bearings/110mm.toml`, thrust 2,224 N, {found['t_end']:g} s, `two_half`/`elastic`, in N;"
        f" at 4,000 r/min no force exceeds {least:.1f} N.\n"
        "All but bore and speed is assumed, and their cage is guided by the inner ring."
    )
    softest = found["soft"][-1]["12000"][0]
    softness = (
        "Softer cages (modulus divided by 10 and 100, 1,112 N radial): the 99.9 % quantile at 12,000 r/min falls to"
        f" {softest:.0f} N,\n{softest / 25.0:.1f} times the measured force."
    )
    columns = ("r/min", "load", "mean", "99.9 %", "largest")
    sensors = [name for name in found["sensed"][0] if name.endswith("Hz")]
    thrusts = sorted({row["F_x"] for row in found["sensed"]})
    cells = {
        (row["ratio"], row["F_x"]): "/".join(f"{row[name]:.0f}" for name in ("force", *sensors))
        for row in found["sensed"]
    }
    sensed = [(f"{ratio:g}", *(cells[ratio, F_x] for F_x in thrusts)) for ratio in sorted({key[0] for key in cells})]
    least, most = (
        choose(row[name] for row in found["sensed"] for name in ("force", *sensors)) for choose in (min, max)
    )
    assumed = (
        "**The comparison rests on two assumed inputs**: the abstract names neither the radial load nor the sensor's frequency. 99.9 % quantiles at"
        " 12,000 r/min,\n`elastic`, in N: force in a pocket/shown by a part of the cage with a natural frequency of "
        + "/".join(sensors)
        + f" (damping\nratio 0.1, assumed). From {least:.0f} to {most:.0f} N, the measured 25 N are neither confirmed nor contradicted."
    )
    return section(
        "Ball–cage forces of a 110-mm bearing",
        text,
        table(columns, rows),
        assumed,
        table(("F_r/F_a", *(f"thrust {F_x:,.0f} N" for F_x in thrusts)), sensed),
        softness,
    )


def heat(data):
    """NASA TP-2275."""
    found = data["heat"]
    measured, total = (np.array([row[name] for row in found["rows"]]) for name in ("measured", "total"))
    parts = {
        "races": "races",
        "inlet": "inlets",
        "ball_drag": "balls' drag",
        "cage_drag": "cage's",
        "ring_drag": "ring's",
    }
    parts |= {"land": "lands", "pockets": "pockets"}
    rows = [
        (
            f"{row['speed']:,}",
            f"{row['measured']:.0f}",
            f"{row['total']:.0f}",
            f"{row['total'] / row['measured']:.2f}",
            *(f"{row[name]:.0f}" for name in parts),
        )
        for row in found["rows"]
    ]
    exponents, own = found["exponents"], found["changed"][0]["exponent"]
    text = (
        "Source: Parker, NASA TP-2275 (1984): 667 N, oil at 394 K, digitised by others (github.com/YUXinluhk/BallBearing-Dynamics, ± 3 %).\n"
        "Computed: `benchmarks/bearings/35mm.toml`; nothing is fitted to these figures."
        f" Each point is within a factor of {max((total / measured).max(), (measured / total).max()):.2f}.\n"
        f"Exponent over speed: {own:.2f}, measured {exponents['measured']:.2f}; lands {exponents['land']:.2f}, all else {exponents['rest']:.2f}."
        " The lands' loss depends on the assumed guide clearance\n(0.2 % of the diameter). Computed oil has one viscosity; measured outer rings are 19 to 49 K"
        " warmer than the oil supply, and their cage is one\npiece. `inlets` is part of `races`. Changes up to 0.06 are left out."
    )
    first = table(("r/min", "measured [W]", "computed", "ratio", *parts.values()), rows)
    ends, usual = (found["rows"][0], found["rows"][-1]), np.array(found["changed"][0]["ratio"])

    def shown(row):
        return row is found["changed"][0] or np.abs(np.array(row["ratio"]) - usual).max() > 0.0601  # two digits

    varied = [
        (row["change"], *(f"{row['ratio'][i]:.2f}" for i in (0, -1)), f"{row['exponent']:.2f}")
        for row in found["changed"]
        if shown(row)
    ]
    second = table(("ratio, one change at a time", *(f"{row['speed']:,}" for row in ends), "exponent"), varied)
    return section("Heat of a 35-mm bearing", text, first, second)


if __name__ == "__main__":
    main()
