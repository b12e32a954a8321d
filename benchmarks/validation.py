"""Writes docs/validation.md: numbers from outside the model, each with its source, the model's value and the
difference.

Nothing is copied into the page by hand: figures of books and papers are arguments here; all others are computed, or
recorded by the tests, which run once more for this.  Some minutes, most of them for 0.1 s of the working point in the
Python reference; --short takes 0.01 s.
"""

import ast
import importlib
import subprocess
import sys
import tempfile
import tomllib
from pathlib import Path
from xml.etree import ElementTree

import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt
import numpy as np
from common import FMU, ROOT, commit, core_library, machine, options, say
from mechanics import Instance
from race_control import LOADS, SPEEDS
from race_control import equilibrium as control_equilibrium
from race_control import running as running_with_spin

from bearing_model.kinematics import fault_frequencies
from bearing_model.physics.hertz import curvature_difference, hertz_contact
from bearing_model.physics.hertz_exact import ball_race_contact
from bearing_model.physics.parameters import Parameters
from bearing_model.physics.ring_fit import ring_fit_of
from bearing_model.quasi_static import Bearing, Load, quasi_static
from rivet_model.geometry import Geometry
from riveted_bearing import build, run
from riveted_bearing.compare import compare, is_motion
from riveted_bearing.fmu import Model
from riveted_bearing.plot import HEAD, MIDDLE, MUTED, STYLE, plot_comparison
from riveted_bearing.scene import load_scene
from riveted_bearing.summary import settled

PAGE = ROOT / "docs" / "validation.md"
PICTURES = ROOT / "docs" / "validation"
RPM = np.pi / 30.0
MANY = 20  # entries of a test's record; of longer records only the largest entry is shown
WORKING_POINT = Load(F_x=515.0, F_y=2994.0, omega=18238.0 * RPM)
TESTS = {  # file -> tests whose observations are shown
    "tests/test_twin.py": "derivatives or jacobian or start or outputs or power_is_rate or test_ledger or trajectory",
    "tests/test_invariance.py": "turn or mirror or units",
    "tests/test_energy.py": "lossless or balance",
    "tests/test_conservation.py": "momentum",
}


def main():
    short = options(__doc__).short
    PICTURES.mkdir(exist_ok=True)
    core, model = core_library(), Model(FMU)
    say("FMUs of three more bearings")
    fmus = [
        build(ROOT / "benchmarks" / "bearings" / f"{name}.toml", out=ROOT / "build" / f"{name}.fmu")
        for name in ("120mm", "110mm", "35mm")
    ]
    sections = []
    for section in (contacts, kinematics, distribution, working_point, clearance, race_control, load_path):
        say(section.__name__)
        sections.append(section(core, model))
    sections.append(rivets_over_speed())
    say("tests")
    sections.append(observed_by_tests())
    say("FMU and reference")
    sections += twins(model, 0.01 if short else 0.1)
    say("published experiments")
    sections += [skid(fmus[0], short), cage_forces(fmus[1], short), heat(fmus[2], short)]
    PAGE.write_text(
        "\n".join([HEAD_OF_PAGE.format(**machine(), commit=commit()), *([SHORT_FORM] if short else []), *sections])
    )
    say(f"wrote {PAGE.relative_to(ROOT)}")


HEAD_OF_PAGE = """# Validation

Numbers from outside the model: each beside its source, the model's value, and the difference. Written by `python benchmarks/validation.py`;
commit {commit}, {processor}, Python {python}. *Core* is the C code in the FMU, *reference* the Python twin `bearing_model`,
written apart from it; closed forms and books stand above both.
"""

SHORT_FORM = """
**Short form** (`--short`): statistics and ledger over 0.01 s instead of the 0.1 s that is asked for, the two published experiments over 0.05 s instead of
0.4 s, so their cages have not settled. The command without `--short` writes the full page.
"""

# ------------------------------------------------------------------------------------------------------------- the page


def section(title, text, *parts):
    return "\n".join([f"\n## {title}\n", text, *(f"\n{part}" for part in parts)])


def table(columns, rows):
    """A Markdown table; numbers get four digits."""
    lines = ["| " + " | ".join(columns) + " |", "|" + "---|" * len(columns)]
    lines += [
        "| " + " | ".join(cell if isinstance(cell, str) else f"{cell:.5g}" for cell in row) + " |" for row in rows
    ]
    return "\n".join(lines)


def against(rows):
    """A table of (quantity, unit, source, expected, reached by ...): the difference is the largest of those reached,
    relative.
    """
    columns = ("quantity", "unit", "source", "expected", "core", "reference", "difference")
    shown = []
    for quantity, unit, source, expected, core, reference in rows:
        reached = [value for value in (core, reference) if value is not None]
        worst = max((value / expected - 1.0 for value in reached), key=abs)
        shown.append(
            (
                quantity,
                unit,
                source,
                expected,
                *("–" if value is None else value for value in (core, reference)),
                f"{100.0 * worst:+.2g} %",
            )
        )
    return table(columns, shown)


def picture(figure, name):
    """Saves a figure as SVG; its line in the page."""
    path = PICTURES / f"{name}.svg"
    figure.savefig(path)
    plt.close(figure)
    return f"![{name}]({PICTURES.name}/{path.name})"


# ------------------------------------------------------------------------------------------------- contacts, kinematics


def contacts(core, model):
    """Hertz."""
    rows = []
    for F_rho, delta_star, kappa in ((0.95, 0.577, 10.40), (0.7332, 0.8394, 3.4204)):
        total, E_star = 300.0, 1e11
        rho = 0.5 * total * (1.0 + F_rho), 0.5 * total * (1.0 - F_rho)
        pair = core.lib.hertz_contact(*rho, E_star), hertz_contact(*rho, E_star)
        unit = np.cbrt(1.5 / (total * E_star)) ** 2 * 0.5 * total
        rows.append(
            (
                f"δ* at F(ρ) = {F_rho}",
                "1",
                "Harris, table of contact parameters",
                delta_star,
                *(c.K ** (-2 / 3) / unit for c in pair),
            )
        )
        rows.append((f"κ at F(ρ) = {F_rho}", "1", "the same", kappa, *(c.a / c.b for c in pair)))
        assert abs(curvature_difference(pair[1].k) - F_rho) < 1e-9
    derived = core.model().d.inner.hertz
    exact = ball_race_contact(0.0111125, 0.0535, 0.515, 0.0, 207e9, 0.3, "inner")
    rows.append(
        ("6207 inner contact, K", "N/m^1.5", "Harris' formulae, f_i 0.515, 207 GPa", 3.331e10, derived.K, exact.K)
    )
    p = 1.5 * np.cbrt(1000.0) / (np.pi * derived.a * derived.b)
    rows.append(
        (
            "6207 inner contact, largest pressure at 1000 N",
            "MPa",
            "the same",
            1942.0,
            1e-6 * p,
            1e-6 * exact.p_max(1000.0),
        )
    )
    return section(
        "Contacts",
        "Hertz with exact elliptic integrals (`hertz`), required to 1e-3 of the tables' four digits.",
        against(rows),
    )


def kinematics(core, model):
    """Frequencies, and the speeds that the dynamics reaches where nothing but traction acts."""
    found = fault_frequencies(WORKING_POINT.omega, 0.0111125, 0.0535, 9)
    named = (
        ("cage (FTF)", 120.4, found.FTF),
        ("BPFO", 1083.7, found.BPFO),
        ("BPFI", 1652.0, found.BPFI),
        ("ball (BSF)", 700.1, found.BSF),
    )
    rows = [
        (f"6207 at 18,238 r/min, {name}", "Hz", "rigid-body kinematics, given to 0.1 Hz", expected, None, reached)
        for name, expected, reached in named
    ]
    # both contact angles are nearly the same: the speed does not depend on which race controls the spin
    slow = Load(F_x=1000.0, omega=300.0)
    source = "no slip at the loaded contact angles"
    rows.append(
        (
            "balls' orbit, 300 rad/s, 1 kN thrust, strong traction",
            "rad/s",
            source,
            quasi_static(Bearing(), slow).omega_m,
            frictional_limit(core, slow),
            None,
        )
    )
    text = "Fault frequencies; and the frictional limit of the dynamics: traction rises 45 times as steeply, no drag, no films, no contact with the cage."
    return section("Kinematics", text, against(rows))


def frictional_limit(core, load):
    """Mean orbital speed of the balls after 20 ms of pure thrust [rad/s]."""
    free = dict.fromkeys(("oil.rolling", "oil.rho_mix", "cage.mu", "cage.mu_land"), 0.0)
    instance = Instance(
        core,
        free | {"oil.B": 100.0, "oil.eta": 1e-5, "cage.pocket_clearance": 1e-3},
        {"shaft.F_x": load.F_x, "shaft.F_y": 0.0, "shaft.omega": load.omega},
    )
    instance.step(0.02)
    return float(np.mean(instance.output("ball.omega_m")))


def distribution(core, model):
    """Load integral."""
    many = quasi_static(Bearing(Z=200, d_m=1.0, P_d=0.0), Load(F_y=2000.0))
    nine = quasi_static(Bearing(P_d=0.0), Load(F_y=1000.0))
    rows = [
        (
            "Z Q_max/F_r, 200 balls without clearance",
            "1",
            "Stribeck, Sjövall; Harris ch. 7",
            4.37,
            None,
            200 * many.Q_i.max() / 2000.0,
        ),
        ("the same, the 6207's nine balls", "1", "the many-ball limit", 4.37, None, 9 * nine.Q_i.max() / 1000.0),
    ]
    return section("Load distribution", "`quasi_static`, radial load, α = 0.", against(rows))


# ------------------------------------------------------------------------------------------------------ running bearing


def equilibrium(P_d=15e-6):
    """Mean displacements over a ball pass [m] and, at its worst azimuth, the largest ball load [N]; race control by the
    outer race.
    """
    bearing = Bearing(P_d=P_d, fit=ring_fit_of(Parameters()))
    results = [
        quasi_static(bearing, WORKING_POINT, psi=psi, control="outer") for psi in np.arange(12) * 2.0 * np.pi / 9 / 12
    ]
    return np.mean([r.x for r in results]), np.mean([r.y for r in results]), max(r.Q_i.max() for r in results)


def working_point(core, model):
    """The FMU's means against the equilibrium of the books."""
    result = run("demo", fmu=FMU, t_end=0.25)
    late = settled(result)
    x, y, Q_max = equilibrium()
    loads = np.max([result.data[f"ball[{j}].Q_i"] for j in range(1, 10)], axis=0)[late]
    samples = round(2.0 * np.pi / (9 * 756.6) / 1e-4)  # a ball pass
    passes = loads[: len(loads) // samples * samples].reshape(-1, samples).max(axis=1)
    axial = sum(result.data[f"ball[{j}].Q_i"] * np.sin(result.data[f"ball[{j}].alpha_i"]) for j in range(1, 10))[late]
    rows = [
        (
            "ring, axial",
            "µm",
            "Jones–Harris equilibrium, outer race control",
            1e6 * x,
            1e6 * result.data["ring.x"][late].mean(),
            None,
        ),
        ("ring, radial", "µm", "the same", 1e6 * y, 1e6 * result.data["ring.y"][late].mean(), None),
        ("largest ball load of a pass, mean", "N", "the same", Q_max, passes.mean(), None),
        ("sum of Q_i sin α_i", "N", "axial load", 515.0, axial.mean(), None),
        ("housing force, radial", "N", "radial load", 2994.0, result.data["housing.F_y"][late].mean(), None),
        ("cage speed", "rad/s", "epicyclic", 756.6, result.data["cage.omega"][late].mean(), None),
    ]
    text = "Means of 0.2 s of the settled scene `demo` through the FMU. The differences come from traction and cage, which the equilibrium leaves out:"
    text += " traction carries 1.5 % of the axial load, so that the contact loads have less of it than the shaft."
    return section("Working point", text, against(rows))


def clearance(core, model):
    """P_d moves the running ring."""
    rows = []
    for P_d in (5e-6, 15e-6, 25e-6, 40e-6):
        result = run("demo", fmu=FMU, t_end=0.06, parameters={"bearing.P_d": P_d, "start.settle": 0.02})
        reached = 1e6 * result.data["ring.y"][settled(result)].mean()
        rows.append(
            (
                f"ring, radial, P_d = {1e6 * P_d:g} µm",
                "µm",
                "Jones–Harris equilibrium, outer race control",
                1e6 * equilibrium(P_d)[1],
                reached,
                None,
            )
        )
    text = "In another open code the clearance had no effect on the running ring. Here the mean radial displacement follows that of the equilibrium."
    return section("Clearance", text, against(rows))


def race_control(core, model):
    """Spin in the traction against outer race control over speeds and loads."""
    rows = []
    for speed in SPEEDS:
        for F_x, F_y in LOADS:
            found, outer = running_with_spin(FMU, F_x, F_y, speed), control_equilibrium(F_x, F_y, speed, "outer")
            radial = (1e6 * found.y, f"{1e6 * (found.y - outer.y):+.2g}") if F_y else ("–", "–")
            row = (
                1e6 * found.x,
                f"{100.0 * (found.x / outer.x - 1.0):+.2f}",
                *radial,
                f"{100.0 * (found.omega_c / outer.omega_c - 1.0):+.2f}",
            )
            angles = (
                (np.degrees(a), f"{np.degrees(a - b):+.2f}")
                for a, b in ((found.alpha_i, outer.alpha_i), (found.alpha_e, outer.alpha_e))
            )
            rows.append(
                (f"{speed:,.0f}", f"{F_x:.0f}", f"{F_y:.0f}", *row, *(cell for pair in angles for cell in pair))
            )
    columns = ("r/min", "thrust, N", "radial, N", "x, µm", "%", "y, µm", "µm", "cage, %", "α_i, °", "−", "α_e, °", "−")
    text = (
        "`demo` with `scene.traction = sliced`, means of 0.05 s after as much for settling; behind each value its difference from `quasi_static` with outer"
        " race control (Jones). The dynamics knows no race control: slip and spin decide in each contact which race carries the gyroscopic moment of a ball."
        " Under thrust, where every ball presses against both races, the contact angles lie between those of outer and inner control. Under a larger"
        " radial load the ring's y lies by up to 0.06 µm beyond both controls at 3,000 and 10,000 r/min, with no cause found; above it lies between them. The"
        " inner ring of both grows by rotation; the slip of the cage is the bearing's own (`tests/test_race_control.py`)."
    )
    return section("Spin and race control", text, table(columns, rows))


# fit [um], r/min, tilt [deg]: pocket force 99.9 % [N], head mean and 99.9 %, middle 99.9 % [MPa], means of 8 seeds x
# 0.2 s after 0.2 s, `demo`
# bonded joints, quasi-static path at two wall angles, no centrifugal load, traction at a point, balls' drag isolated
FIRST_VERSION = {
    (-10, 4000, 0.0): (13, 50, 63, 12),
    (-10, 8000, 0.0): (27, 51, 80, 17),
    (-10, 12000, 0.0): (45, 53, 107, 25),
    (-10, 16000, 0.0): (68, 56, 136, 33),
    (-10, 20000, 0.0): (83, 58, 153, 38),
    (-10, 24000, 0.0): (103, 60, 182, 46),
    (-90, 18238, 0.0): (76, 57, 146, 36),
    (-40, 18238, 0.0): (76, 57, 146, 36),
    (0, 18238, 0.0): (85, 133, 296, 241),
    (20, 18238, 0.0): (85, 201, 383, 432),
    (40, 18238, 0.0): (85, 218, 405, 475),
    (-10, 18238, -0.5): (343, 375, 666, 164),
    (-10, 18238, -0.2): (56, 56, 97, 23),
    (-10, 18238, 0.2): (233, 80, 374, 101),
    (-10, 18238, 0.5): (416, 553, 651, 170),
}
# [N], [MPa]
SHOWN = (
    ("stat.Q_c_p999", 1.0),
    ("stat.sigma_head_mean", 1e-6),
    ("stat.sigma_head_p999", 1e-6),
    ("stat.sigma_mid_p999", 1e-6),
)


def stress_now(fit, speed, tilt, cage):
    """The same of the present model."""
    inputs, parameters = (
        {"shaft.omega": speed * RPM, "shaft.tilt_z": np.radians(tilt)},
        {"joint.fit": 1e-6 * fit, "scene.cage": cage, "start.settle": 0.2},
    )
    runs = [
        run("demo", fmu=FMU, t_end=0.4, inputs=inputs, parameters=parameters | {"start.seed": seed}).summary
        for seed in range(1, 9)
    ]
    return [scale * np.mean([summary[name] for summary in runs]) for name, scale in SHOWN]


def load_path(core, model):
    """Stress of the first version, of the present default and of elastic halves, over speed, fit and tilt."""
    rows, off = [], []
    for (fit, speed, tilt), before in FIRST_VERSION.items():
        rigid, elastic = (stress_now(fit, speed, tilt, cage) for cage in ("two_half", "elastic"))
        off.append(100.0 * (rigid[2] / elastic[2] - 1.0))
        cells = (f"{a} → {b:.0f}, {c:.0f}" for a, b, c in zip(before, rigid, elastic, strict=True))
        rows.append((f"{fit:+d} µm", f"{speed:,}", f"{tilt:+.1f}°", *cells))
    text = (
        "Scene `demo`, means of eight seeds, 0.2 s after 0.2 s; the first version of this model → the present one with rigid halves (`two_half`), with elastic"
        " ones (`elastic`). The first version had bonded joints, the load path at two wall angles, no centrifugal load of the cage, traction at a point and"
        " balls' drag in a mixture at rest. The pocket force falls with the drag; the stress rises because the centrifugal load pries at every joint and the"
        " impacts act on joints that it has loaded ([with and without it](paper.md#with-and-without-the-cages-centrifugal-load)). Walls that give way take much"
        f" of an impact: by rigid halves the 99.9 % quantile of the head stress is {min(off):+.0f} to {max(off):+.0f} % off that by elastic ones. The median"
        " of the largest dislocation at 40 N preload and the largest clearance falls from 6.5 to 2.0 µm with rigid halves, 3.6 with elastic ones: the contact"
        " patch decides how the halves share a pocket force, pocket forces are smaller, and the centrifugal load adds friction to the joints."
    )
    columns = (
        "fit",
        "r/min",
        "tilt",
        "pocket force, 99.9 %, N",
        "head, mean, MPa",
        "head, 99.9 %, MPa",
        "middle, 99.9 %, MPa",
    )
    return section("What the load path and elastic halves change", text, table(columns, rows))


def rivets_over_speed():
    """Tension and stress between the impacts, as the table gives them and by direct contact on finer elements."""
    rows = []
    for _, _, (P, speed, *pairs) in recorded("tests/test_joint_law.py", "tension_and_stress_over_speed", "slow"):
        both = [
            f"{ours:.{digits}f} / {direct:.{digits}f}"
            for ours, direct, digits in zip(pairs[::2], pairs[1::2], (1, 2, 1), strict=True)
        ]
        rows.append((f"{P:.0f}", f"{speed:,.0f}", *both, f"{100.0 * (pairs[4] / pairs[5] - 1.0):+.1f} %"))
    text = (
        "Between the impacts a rivet has its preload and what the centrifugal load pries: the shipped table / direct contact of plates and rivet on finer "
        "finite elements, with the stress solved afresh on a finer grid of angles."
    )
    return section(
        "Rivets at rest of the impacts, over speed",
        text,
        table(
            ("preload, N", "r/min", "tension, N", "moment of the shank, N·mm", "head, MPa", "head, difference"), rows
        ),
    )


# ----------------------------------------------------------------------------------------------- what the tests observe


def observed_by_tests():
    """Observations of the tests, as they record them, the largest over a test's cases; CalledProcessError if one fails."""
    observed = {}
    for file, chosen in TESTS.items():
        for name, entry, value in recorded(file, chosen):
            observed.setdefault((Path(file).stem, name, entry), []).append(value)
    rows = [
        (first_line(*key[:2]), f"`{key[0]}::{key[1]}`", key[2], largest_of(values)) for key, values in observed.items()
    ]
    text = "Symmetries, conservation, convergence, twins: what the tests observed in this very run. Their bounds and the reasons for them stand in `tests/`."
    return section("Observed by the tests", text, table(("what", "test", "recorded", "largest of all cases"), rows))


def recorded(file, chosen, marker="not slow"):
    """What the chosen tests of a file record, run once more: (test, name, value) of each record; CalledProcessError if
    a test fails.
    """
    with tempfile.TemporaryDirectory() as folder:
        record = Path(folder) / "record.xml"
        command = [
            sys.executable,
            "-m",
            "pytest",
            "-q",
            "-o",
            "junit_family=legacy",
            f"--junitxml={record}",
            file,
            "-k",
            chosen,
            "-m",
            marker,
        ]
        subprocess.run(command, cwd=ROOT, check=True, stdout=subprocess.DEVNULL)
        for case in ElementTree.parse(record).iter("testcase"):
            for entry in case.iter("property"):
                yield case.get("name").partition("[")[0], entry.get("name"), ast.literal_eval(entry.get("value"))


def first_line(file, test):
    """First line of a test's docstring."""
    return getattr(importlib.import_module(file), test).__doc__.strip().partition("\n")[0].replace("|", "\\|")


def largest_of(values):
    """Element by element, the largest in absolute value over a test's cases."""
    if isinstance(values[0], dict):
        names = dict.fromkeys(name for value in values for name in value)
        worst = {name: max((value[name] for value in values if name in value), key=abs) for name in names}
        shown = worst if len(worst) <= MANY else [max(worst, key=lambda name: abs(worst[name]))]
        left = "" if len(worst) <= MANY else f" (largest of {len(worst)})"
        return ", ".join(f"{name} {worst[name]:.1e}" for name in shown) + left
    return ", ".join(f"{number:.1e}" for number in np.max(np.abs([np.ravel(value) for value in values]), axis=0))


# ------------------------------------------------------------------------------------------------ FMU against reference


def twins(model, long):
    """`riveted-bearing compare`: demo over both horizons, R, where balls press on the cage at once, over the short one."""
    found, other = (
        compare(model, load_scene("demo", model), long=long),
        compare(model, load_scene("R", model), long=0.0),
    )
    plot_comparison(other, PICTURES / "compare.png", dpi=80)
    worst = []
    for comparison in (found, other):
        for motion, name in ((True, "positions, angles, speeds"), (False, "loads, stresses, powers")):
            channels = [channel for channel in comparison.channels if is_motion(channel) == motion]
            worst.append(
                (
                    f"`{comparison.scene}`",
                    name,
                    *(f"{value:.1e} (`{channels[i].name}`)" for value, i in largest(channels)),
                )
            )
    columns = ("scene", "largest difference / scale", *(f"FMU at {tolerance:.0e}" for tolerance in found.tolerances))
    text = (
        "The FMU and the reference (SciPy, DOP853) at the same 20 instants of the first millisecond. Differences of motion are in parts of 10 µm and 0.1 m/s,"
        " near the integrator's error scales, so that they compare with the tolerance; those of loads and stresses are relative to the largest value, "
        "at least 1 N and 0.1 MPa."
        " A difference that falls with the tolerance is the integration's error."
    )
    first = section("FMU against reference", text, table(columns, worst), f"![compare]({PICTURES.name}/compare.png)")

    text = f"From {found.settle:g} to {found.long:g} s trajectories have parted; these are statistics of the reference and of {found.seeds} seeds of the FMU."
    text += " Both count the ends of their steps, a few in each pocket pulse; mean force and head stress differ by about 1 % because the steps differ."
    columns = ("statistic", "unit", "reference", "FMU, mean", "standard deviation", "difference in these")
    rows = [
        (f"`{row.name}`", row.unit, row.reference, row.mean, f"{row.scatter:.2g}", f"{row.deviation:+.1f}")
        for row in found.statistics
    ]
    second = section("Statistics", text, table(columns, rows))

    ledger = found.ledger
    accounts = (("supplied", ledger.supplied), ("stored", ledger.stored), ("lost", ledger.lost))
    rows = [(f"{title}: {name}", f"{value[-1]:.6f}") for title, account in accounts for name, value in account.items()]
    rows.append(("**supplied − stored − lost**", f"{ledger.residual[-1]:.6f}"))
    share = np.abs(ledger.residual[1:]).max() / abs(ledger.supplied["shaft torque"][-1])
    text = (
        f"The same {found.long:g} s of the reference, each term integrated on its own from the powers of the elements. Required: closed to 0.1 %;"
        f" reached: {100.0 * share:.1g} % of the work of the shaft, at every communication point."
    )
    third = section("Where the energy goes", text, table(("term", "J"), rows))
    return [first, second, third]


def largest(channels):
    """(value, index of its channel) at each tolerance."""
    table_ = np.array([channel.worst for channel in channels])
    return [(column.max(), int(column.argmax())) for column in table_.T]


# ------------------------------------------------------------------------------------------------ published experiments


def running(fmu, speed_rpm, t_end, cage, **changes):
    """Mean speed of the cage [rad/s], largest, 99.9 % and mean ball–pocket force [N] of a bearing after settling."""
    inputs = {"shaft.omega": speed_rpm * RPM} | {name.replace("__", "."): value for name, value in changes.items()}
    result = run(
        "demo", fmu=fmu, t_end=t_end, inputs=inputs, parameters={"scene.cage": cage, "start.settle": 0.5 * t_end}
    )
    return (
        result.data["cage.omega"][settled(result)].mean(),
        result.summary["stat.Q_c_max"],
        result.summary["stat.Q_c_p999"],
        result.summary["stat.Q_c_mean"],
    )


def skids(fmu, F_x, speed_rpm, t_end):
    """Mean over the second half of the run of 100 (1 - cage speed / orbit without slip at the running contact angles)
    under thrust F_x [N], outer race control; and how much the mean changes from the third quarter of the run to the
    fourth.
    """
    p = load_bearing("120mm")
    orbit = quasi_static(Bearing(**p), Load(F_x=F_x, omega=speed_rpm * RPM), control="outer").omega_m
    inputs = {"shaft.omega": speed_rpm * RPM, "shaft.F_x": F_x, "shaft.F_y": 0.0}
    result = run("demo", fmu=fmu, t_end=t_end, inputs=inputs, parameters={"start.settle": 0.5 * t_end})
    third, fourth = np.split(
        100.0 * (1.0 - result.data["cage.omega"][-2 * (len(result.data["time"]) // 4) :] / orbit), 2
    )
    return 0.5 * (third.mean() + fourth.mean()), abs(fourth.mean() - third.mean())


def load_bearing(name):
    """Arguments of Bearing from a file of benchmarks/bearings; its inner ring grows by rotation as the FMU's."""
    data = tomllib.loads((ROOT / "benchmarks" / "bearings" / f"{name}.toml").read_text(encoding="utf-8"))
    geometry, p = {key: data["parameters"]["bearing"][key] for key in ("D", "d_m", "f_i", "f_e", "P_d")}, Parameters()
    vars(p.bearing).update(geometry)
    return {"Z": data["Z"], "fit": ring_fit_of(p)} | geometry


def skid(fmu, short):
    """NASA TN D-7870."""
    t_end = 0.05 if short else 0.4
    speeds, loads = (12000, 16700, 20800, 25000), (2224.0, 6672.0, 22240.0)
    found = {F_x: [skids(fmu, F_x, speed, t_end) for speed in speeds] for F_x in loads}
    slips = {F_x: [slip for slip, _ in row] for F_x, row in found.items()}
    drift = max(change for row in found.values() for _, change in row)
    rows = [(f"{F_x:.0f}", *(f"{slip:.2f}" for slip in row)) for F_x, row in slips.items()]
    with plt.rc_context(STYLE):
        figure, ax = plt.subplots(figsize=(5.0, 3.0), layout="constrained")
        for (F_x, row), colour in zip(slips.items(), (HEAD, MIDDLE, MUTED), strict=True):
            ax.plot(speeds, row, ".-", color=colour, label=f"{F_x:.0f} N")
        ax.axhline(6.0, color="black", lw=0.6, ls="--")
        ax.set(title="Skid, 120-mm bearing; dashed: the report's largest", xlabel="r/min", ylabel="%")
        ax.legend()
    grows = [f"{F_x:.0f} N {'yes' if np.all(np.diff(row) > 0.0) else 'no'}" for F_x, row in slips.items()]
    most, least = max(map(max, slips.values())), min(map(min, slips.values()))
    text = (
        "NASA TN D-7870 (Bamberger, Zaretsky, Signer, 1975), abstract: a 120-mm angular contact bearing under thrust skids by various amounts, generally"
        " growing with speed at a given load, 6 % at most, at 25,000 r/min. Here: a bearing like theirs (`benchmarks/bearings/120mm.toml`), mean slip of the"
        f" cage after {0.5 * t_end:g} s against the orbit without slip at the running contact angles of the grown ring (`quasi_static`,"
        " outer race control as Jones takes it"
        " for fast, lightly loaded bearings; `cage.slip_ratio` is against the epicyclic speed at zero contact angle and no measure of skid here)."
        f" Settled: no mean changes by more than {drift:.2f} % of the speed from the third quarter of the run to the fourth."
        f" Grows with speed: {', '.join(grows)}. Largest {most:.1f} %, {'within' if most <= 6.0 else 'beyond'} the report's 6 %; least {least:.1f} %"
        " (below zero the balls orbit faster than outer race control lets them: the reference is an assumption too)."
        " What differs: number and size of balls, curvatures, contact angle and oil are assumed; their oil's temperature and flow change with speed, ours do"
        " not; their cage is one piece. A check of the trend and of the order of magnitude, no more."
    )
    columns = ("thrust [N] \\ speed [r/min]", *(f"{speed:,}" for speed in speeds))
    return section("Skid of a 120-mm bearing", text, table(columns, rows), picture(figure, "skid"))


def softer_cage(factor):
    """The FMU of the 110-mm bearing with a cage whose modulus is divided by a factor."""
    text = (ROOT / "benchmarks" / "bearings" / "110mm.toml").read_text(encoding="utf-8")
    path = ROOT / "build" / f"110mm-{factor}-times-softer.toml"
    path.write_text(
        text.replace('material = "bronze"', f'material = "bronze"\nE = {Geometry().E_flange / factor} #'),
        encoding="utf-8",
    )
    return build(path, out=path.with_suffix(".fmu"))


def cage_forces(fmu, short):
    """ASME J. Lubr. Tech. 101(2)."""
    t_end = 0.05 if short else 0.4
    loads = {"thrust 2224 N": (2224.0, 0.0), "thrust 2224 N, radial 1112 N": (2224.0, 1112.0)}
    rows = []
    for speed in (4000, 8000, 12000):
        for name, (F_x, F_y) in loads.items():
            rigid, elastic = (
                running(fmu, speed, t_end, cage, shaft__F_x=F_x, shaft__F_y=F_y)[:0:-1]
                for cage in ("two_half", "elastic")
            )
            rows.append(
                (
                    f"{speed:,}",
                    name,
                    *(
                        f"{a:.{digits}f}, {b:.{digits}f}"
                        for a, b, digits in zip(rigid, elastic, (2, 1, 1), strict=True)
                    ),
                )
            )
    text = (
        "Nypan, ASME J. Lubr. Tech. 101(2) (1979) 180, abstract: forces between balls and cage of a 110-mm bearing to 12,000 r/min, by the deflection of a"
        f" part of the cage, 25 N at most. Here: a bearing like theirs (`benchmarks/bearings/110mm.toml`), {t_end:g} s. What differs: all but bore "
        f"and speed is"
        " assumed; their cage is guided by the inner ring; and a part of the cage soft enough to be seen moving hardly follows pulses of 0.1 ms, so their"
        " largest force compares with sustained forces here rather than with peaks. First rigid halves (`two_half`), then elastic ones."
    )
    columns = ("speed [r/min]", "load", "mean force [N]", "99.9 % [N]", "largest [N]")
    F_x, F_y = loads["thrust 2224 N, radial 1112 N"]
    fmus = {"rigid halves": (fmu, "two_half"), "elastic, bronze": (fmu, "elastic")}
    fmus |= {f"{factor} times softer": (softer_cage(factor), "elastic") for factor in (10, 100)}
    soft = []
    for name, (path, cage) in fmus.items():
        found = (running(path, speed, t_end, cage, shaft__F_x=F_x, shaft__F_y=F_y) for speed in (8000, 12000))
        soft.append((name, *(f"{p999:.1f}, {most:.1f}" for _, most, p999, _ in found)))
    softness = (
        "What it takes to come near 25 N: the modulus of the whole cage divided by 10 and by 100, under thrust and radial load. At 12,000 r/min the impacts'"
        " forces fall with it to a quarter, twice the measured ones; at 8,000 r/min balls hit too rarely for a trend. A part of the cage that bends by itself,"
        " with a natural frequency far below the 10 kHz of the pulses, would not follow what is left; such a part is not in the model."
    )
    head = ("99.9 %, largest [N]", "8,000 r/min", "12,000 r/min")
    return section("Ball–cage forces of a 110-mm bearing", text, table(columns, rows), softness, table(head, soft))


# r/min: heat [W], digitised from NASA TP-2275, +-3 %
MEASURED = {28000: 350.0, 48000: 700.0, 64000: 1100.0, 72000: 1400.0}
LOSSES = {
    "races": "races",
    "inlet": "of it inlets",
    "spin": "of it spin",
    "ball_drag": "balls' drag",
    "cage_drag": "cage's drag",
    "ring_drag": "ring's drag",
    "land": "lands",
    "pockets": "pockets",
}
WITHOUT = {  # one change at a time
    "balls isolated": {"scene.drag": "isolated"},
    "35 kg/m³ at any speed": {"oil.flow": 0.0},
    "no churning": {"scene.churning": "off"},
    "no shear heating": {"scene.heating": "off"},
    "flooded inlets": {"oil.K_rs": 0.0},
    "no inlet friction": {"oil.rolling": 0.0},
    "oil 20 K warmer": {"oil.T": 414.0},
    "outer ring 30 K warmer": {"ring.T_e": 323.15},
    "inner ring does not grow": {"scene.growth": "off"},
    "30 µm interference on the shaft": {"shaft.interference": 30e-6},
    "guide clearance 0.2 mm": {"cage.guide_clearance": 0.2e-3},
    "all of the first five": {
        "scene.drag": "isolated",
        "oil.flow": 0.0,
        "scene.churning": "off",
        "scene.heating": "off",
        "oil.K_rs": 0.0,
    },
}


def heats(fmu, speed_rpm, t_end, **changes):
    """Mean power loss and its parts [W] over the last 40 % of a run under a thrust of 667 N."""
    inputs = {"shaft.omega": speed_rpm * RPM, "shaft.F_x": 667.0, "shaft.F_y": 0.0, "oil.T": 394.0}
    inputs |= {name: changes.pop(name) for name in ("oil.T", "ring.T_e") if name in changes}
    scene = {
        "scene.traction": "sliced",
        "scene.lubrication": "mixed",
        "scene.stress": "off",
        "start.settle": 0.5 * t_end,
    }
    result = run("demo", fmu=fmu, t_end=t_end, inputs=inputs, parameters=scene | changes)
    late = result.data["time"] > 0.6 * t_end
    return {
        name: result.data[name][late].mean() for name in ("bearing.power_loss", *(f"loss.{part}" for part in LOSSES))
    }


def heat(fmu, short):
    """NASA TP-2275."""
    t_end, speeds, measured = 0.02 if short else 0.05, list(MEASURED), np.array(list(MEASURED.values()))
    found = [heats(fmu, speed, t_end) for speed in speeds]
    total = np.array([entry["bearing.power_loss"] for entry in found])
    rows = [
        (f"{speed:,}", f"{W:.0f}", f"{P:.0f}", f"{P / W:.2f}", *(f"{entry[f'loss.{part}']:.0f}" for part in LOSSES))
        for speed, W, P, entry in zip(speeds, measured, total, found, strict=True)
    ]
    ratios = [("as above", total / measured, total)]
    for name, changes in {} if short else WITHOUT.items():
        changed = np.array([heats(fmu, speed, t_end, **changes)["bearing.power_loss"] for speed in speeds])
        ratios.append((name, changed / measured, changed))
    varied = [(name, *(f"{r:.2f}" for r in ratio), f"{exponent(speeds, P):.2f}") for name, ratio, P in ratios]
    land = np.array([entry["loss.land"] for entry in found])
    text = (
        "Parker, NASA TP-2275 (1984): heat of a 35-mm angular-contact bearing under 667 N, oil at 394 K, digitised by others"
        " (github.com/YUXinluhk/BallBearing-Dynamics, ± 3 %). Here: `benchmarks/bearings/35mm.toml`, blind: nothing is fitted to the figures."
        f" Each point within a factor of {max((total / measured).max(), (measured / total).max()):.2f}; exponent over speed {exponent(speeds, total):.2f},"
        f" measured {exponent(speeds, measured):.2f}. What raises the exponent are the lands: alone they go with {exponent(speeds, land):.2f}, all the rest"
        f" with {exponent(speeds, total - land):.2f}. The land's film is flooded here, and the guide clearance decides it, which is assumed (0.2 % of the"
        " diameter). What differs besides: the oil keeps its viscosity, measured outer rings are 19 to 49 K warmer than the oil supply; the cage is one"
        " piece in the test. The growth of the inner ring takes clearance, and with it whirl of the cage and loss of the lands."
    )
    first = table(("speed [r/min]", "measured [W]", "here [W]", "ratio", *LOSSES.values()), rows)
    second = table(
        ("ratio to the measurement, one change at a time", *(f"{speed:,}" for speed in speeds), "exponent"), varied
    )
    return section("Heat of a 35-mm bearing", text, first, second)


def exponent(speeds, power):
    """Slope of ln(power) over ln(speed)."""
    return np.polyfit(np.log(speeds), np.log(power), 1)[0]


if __name__ == "__main__":
    main()
