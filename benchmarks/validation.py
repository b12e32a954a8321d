"""Measures the numbers of docs/validation.md: values of books, papers and closed forms beside those of the model.

The record goes to benchmarks/results/; benchmarks/validation_page.py writes the page from the newest record.  Figures
of books and papers are arguments here.  All others are computed, or recorded by the tests, which run once more for
this. The program takes some minutes, most of them for 0.1 s of the working point in the Python reference; --short takes
0.01 s.
"""

import ast
import subprocess
import sys
import tempfile
import tomllib
from contextlib import suppress
from pathlib import Path
from xml.etree import ElementTree

import matplotlib

matplotlib.use("Agg")

import numpy as np
import validation_page
from common import FMU, ROOT, core_library, options, say, write
from mechanics import Instance
from PIL import Image
from race_control import LOADS, SPEEDS
from race_control import equilibrium as control_equilibrium
from race_control import running as running_with_spin
from scipy import signal

from bearing_model.kinematics import fault_frequencies
from bearing_model.physics.hertz import curvature_difference, hertz_contact
from bearing_model.physics.hertz_exact import ball_race_contact
from bearing_model.physics.parameters import Parameters
from bearing_model.physics.ring_fit import ring_fit_of
from bearing_model.quasi_static import Bearing, Load, quasi_static
from rivet_model.geometry import Geometry
from riveted_bearing import build, run
from riveted_bearing.building.compare import compare, is_motion
from riveted_bearing.running.fmu import Model
from riveted_bearing.running.scene import load_scene
from riveted_bearing.running.summary import settled
from riveted_bearing.show.plot import plot_comparison

PICTURES = validation_page.PICTURES
RPM = np.pi / 30.0
WORKING_POINT = Load(F_x=515.0, F_y=2994.0, omega=18238.0 * RPM)
TESTS = {  # file -> tests whose observations are shown
    "tests/test_twin.py": "derivatives or jacobian or start or outputs or power_is_rate or test_ledger or trajectory",
    "tests/test_invariance.py": "turn or mirror or units",
    "tests/test_energy.py": "balance",
    "tests/test_conservation.py": "momentum",
}
SLOW_TESTS = {"tests/test_energy.py": "lossless_energy_converges"}


def main():
    short = options(__doc__).short
    PICTURES.mkdir(exist_ok=True)
    core, model = core_library(), Model(FMU)
    say("FMUs of three more bearings")
    fmus = [
        build(ROOT / "benchmarks" / "bearings" / f"{name}.toml", out=ROOT / "build" / f"{name}.fmu")
        for name in ("120mm", "110mm", "35mm")
    ]
    data = {}
    for measure in (contacts, kinematics, distribution, working_point, clearance, race_control, halves):
        say(measure.__name__)
        data[measure.__name__] = measure(core, model)
    data["rivets_over_speed"] = rivets_over_speed()
    say("tests")
    data["tests"] = observed_by_tests()
    say("FMU and reference")
    data |= twins(model, 0.01 if short else 0.1)
    say("published experiments")
    data |= {"skid": skid(fmus[0], short), "cage_forces": cage_forces(fmus[1], short), "heat": heat(fmus[2], short)}
    write("validation", data, short)
    validation_page.main()


def against(*row):
    """A number from outside the model beside that of the C core and that of the Python reference (None: has none), and
    the larger difference [%].
    """
    entry = dict(zip(("quantity", "unit", "source", "expected", "core", "reference"), row, strict=True))
    off = (100.0 * (entry[name] / entry["expected"] - 1.0) for name in ("core", "reference") if entry[name] is not None)
    return entry | {"difference": max(off, key=abs)}


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
            against(f"δ* at F(ρ) = {F_rho}", "1", "Harris, table", delta_star, *(c.K ** (-2 / 3) / unit for c in pair))
        )
        rows.append(against(f"κ at F(ρ) = {F_rho}", "1", "Harris, table", kappa, *(c.a / c.b for c in pair)))
        assert abs(curvature_difference(pair[1].k) - F_rho) < 1e-9
    derived = core.model().d.inner.hertz
    exact = ball_race_contact(0.0111125, 0.0535, 0.515, 0.0, 207e9, 0.3, "inner")
    source = "Harris, formulae"  # f_i 0.515, 207 GPa
    rows.append(against("6207 inner contact, K", "N/m^1.5", source, 3.331e10, derived.K, exact.K))
    p = 1.5 * np.cbrt(1000.0) / (np.pi * derived.a * derived.b)
    rows.append(
        against("6207 inner contact, pressure at 1,000 N", "MPa", source, 1942.0, 1e-6 * p, 1e-6 * exact.p_max(1000.0))
    )
    return rows


def kinematics(core, model):
    """Frequencies, and the speeds that the dynamics reaches where nothing but traction acts."""
    found = fault_frequencies(WORKING_POINT.omega, 0.0111125, 0.0535, 9)
    named = (
        ("cage (FTF)", 120.4, found.FTF),
        ("BPFO", 1083.7, found.BPFO),
        ("BPFI", 1652.0, found.BPFI),
        ("ball (BSF)", 700.1, found.BSF),
    )
    source = "kinematics"
    rows = [against(name, "Hz", source, expected, None, reached) for name, expected, reached in named]
    slow = Load(
        F_x=1000.0, omega=300.0
    )  # both contact angles are nearly the same: the speed does not depend on which race controls the spin
    orbit = quasi_static(Bearing(), slow).omega_m
    return [
        *rows,
        against(
            "balls' orbit, 300 rad/s, 1 kN thrust",
            "rad/s",
            "no slip at the loaded contact angles",
            orbit,
            frictional_limit(core, slow),
            None,
        ),
    ]


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
    return [
        against(
            "Z Q_max/F_r, 200 balls", "1", "Stribeck, Sjövall; Harris ch. 7", 4.37, None, 200 * many.Q_i.max() / 2000.0
        ),
        against("Z Q_max/F_r, nine balls", "1", "the many-ball limit", 4.37, None, 9 * nine.Q_i.max() / 1000.0),
    ]


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
    source, mean = "equilibrium", lambda name: result.data[name][late].mean()
    return [
        against("ring, axial", "µm", source, 1e6 * x, 1e6 * mean("ring.x"), None),
        against("ring, radial", "µm", source, 1e6 * y, 1e6 * mean("ring.y"), None),
        against("largest ball load of a pass, mean", "N", source, Q_max, passes.mean(), None),
        against("sum of Q_i sin α_i", "N", "axial load", 515.0, axial.mean(), None),
        against("housing force, radial", "N", "radial load", 2994.0, mean("housing.F_y"), None),
        against("cage speed", "rad/s", "epicyclic", 756.6, mean("cage.omega"), None),
    ]


def clearance(core, model):
    """P_d moves the running ring."""
    rows = []
    for P_d in (5e-6, 15e-6, 25e-6, 40e-6):
        result = run("demo", fmu=FMU, t_end=0.06, parameters={"bearing.P_d": P_d, "start.settle": 0.02})
        reached = 1e6 * result.data["ring.y"][settled(result)].mean()
        source = "equilibrium"
        rows.append(
            against(f"ring, radial, P_d = {1e6 * P_d:g} µm", "µm", source, 1e6 * equilibrium(P_d)[1], reached, None)
        )
    return rows


def race_control(core, model):
    """Spin in the traction against outer race control over speeds and loads."""
    rows = []
    for speed in SPEEDS:
        for F_x, F_y in LOADS:
            found, outer = running_with_spin(FMU, F_x, F_y, speed), control_equilibrium(F_x, F_y, speed, "outer")
            row = {
                "speed": speed,
                "F_x": F_x,
                "F_y": F_y,
                "x": 1e6 * found.x,
                "x_off": 100.0 * (found.x / outer.x - 1.0),
            }
            if F_y:
                row |= {"y": 1e6 * found.y, "y_off": 1e6 * (found.y - outer.y)}
            row["cage_off"] = 100.0 * (found.omega_c / outer.omega_c - 1.0)
            for name in ("alpha_i", "alpha_e"):
                row |= {
                    name: np.degrees(getattr(found, name)),
                    f"{name}_off": np.degrees(getattr(found, name) - getattr(outer, name)),
                }
            rows.append(row)
    return rows


HALVES = [  # fit [um], r/min, tilt [deg]
    *((-10, speed, 0.0) for speed in (4000, 8000, 12000, 16000, 20000, 24000)),
    *((fit, 18238, 0.0) for fit in (-90, -40, 0, 20, 40)),
    *((-10, 18238, tilt) for tilt in (-0.5, -0.2, 0.2, 0.5)),
]
SHOWN = (
    ("stat.Q_c_p999", 1.0),
    ("stat.sigma_head_mean", 1e-6),
    ("stat.sigma_head_p999", 1e-6),
    ("stat.sigma_mid_p999", 1e-6),
)  # [N], [MPa]


def loads_of(fit, speed, tilt, cage):
    """SHOWN of `demo`, means of 8 seeds x 0.2 s after 0.2 s."""
    inputs, parameters = (
        {"shaft.omega": speed * RPM, "shaft.tilt_z": np.radians(tilt)},
        {"joint.fit": 1e-6 * fit, "scene.cage": cage, "start.settle": 0.2},
    )
    runs = [
        run("demo", fmu=FMU, t_end=0.4, inputs=inputs, parameters=parameters | {"start.seed": seed}).summary
        for seed in range(1, 9)
    ]
    return [scale * np.mean([summary[name] for summary in runs]) for name, scale in SHOWN]


def halves(core, model):
    """Pocket force and stress with rigid and with elastic halves, over speed, fit and tilt."""
    cages = ("two_half", "elastic")
    return [
        {"fit": fit, "speed": speed, "tilt": tilt} | {cage: loads_of(fit, speed, tilt, cage) for cage in cages}
        for fit, speed, tilt in HALVES
    ]


def rivets_over_speed():
    """Tension [N], moment of the shank [N.mm] and head stress [MPa] between the impacts: by the table, and by direct
    contact on finer elements.
    """
    names = ("P", "speed", "T", "T_direct", "M", "M_direct", "head", "head_direct")
    rows = recorded("tests/test_joint_law.py", "tension_and_stress_over_speed", "slow")
    return [dict(zip(names, row, strict=True)) for _, _, row in rows]


# ----------------------------------------------------------------------------------------------- what the tests observe


def observed_by_tests():
    """Observations of the tests, as they record them, the largest over a test's cases; CalledProcessError if one fails."""
    observed = {}
    every = [(*test, "not slow") for test in TESTS.items()] + [(*test, "slow") for test in SLOW_TESTS.items()]
    for file, chosen, marker in every:
        for name, entry, value in recorded(file, chosen, marker):
            observed.setdefault((Path(file).stem, name, entry), []).append(value)
    return [
        {"test": f"{file}::{test}", "entry": entry} | largest_of(values)
        for (file, test, entry), values in observed.items()
    ]


def recorded(file, chosen, marker="not slow"):
    """Records of the chosen tests of a file, run once more: (test, name, value) of each record in numbers, not of those in words;
    CalledProcessError if a test fails.
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
                with suppress(SyntaxError, ValueError):
                    yield case.get("name").partition("[")[0], entry.get("name"), ast.literal_eval(entry.get("value"))


def largest_of(values):
    """Element by element, the largest in absolute value over a test's cases: names and values."""
    if isinstance(values[0], dict):
        names = list(dict.fromkeys(name for value in values for name in value))
        return {
            "names": names,
            "values": [max((value[name] for value in values if name in value), key=abs) for name in names],
        }
    return {"names": [], "values": np.max(np.abs([np.ravel(value) for value in values]), axis=0).tolist()}


# ------------------------------------------------------------------------------------------------ FMU against reference


def twins(model, long):
    """`riveted-bearing compare`: demo over both horizons, R, where balls press on the cage at once, over the short one."""
    found, other = (
        compare(model, load_scene("demo", model), long=long),
        compare(model, load_scene("R", model), long=0.0),
    )
    drawn = plot_comparison(other, PICTURES / "compare.png")
    Image.open(drawn).convert("RGB").quantize(64, dither=Image.Dither.NONE).save(
        drawn, optimize=True
    )  # a third of the bytes
    worst = []
    for comparison in (found, other):
        for motion in (True, False):
            channels = [channel for channel in comparison.channels if is_motion(channel) == motion]
            values, names = zip(*((value, channels[i].name) for value, i in largest(channels)), strict=True)
            worst.append({"scene": comparison.scene, "motion": motion, "values": values, "channels": names})
    members = ("name", "unit", "reference", "mean", "scatter", "deviation")
    statistics = [{member: getattr(row, member) for member in members} for row in found.statistics]
    ledger = found.ledger
    accounts = {
        title: {name: value[-1] for name, value in getattr(ledger, title).items()}
        for title in ("supplied", "stored", "lost")
    }
    share = np.abs(ledger.residual[1:]).max() / abs(ledger.supplied["shaft torque"][-1])
    return {
        "twins": {"tolerances": found.tolerances, "rows": worst},
        "statistics": {"settle": found.settle, "long": found.long, "seeds": found.seeds, "rows": statistics},
        "ledger": accounts | {"residual": ledger.residual[-1], "share": share},
    }


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
    drift = max(change for row in found.values() for _, change in row)
    rows = [{"F_x": F_x, "slips": [slip for slip, _ in row]} for F_x, row in found.items()]
    return {"settle": 0.5 * t_end, "drift": drift, "speeds": speeds, "rows": rows}


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
            found = {
                cage: running(fmu, speed, t_end, cage, shaft__F_x=F_x, shaft__F_y=F_y)[:0:-1]
                for cage in ("two_half", "elastic")
            }
            rows.append({"speed": speed, "load": name} | found)
    F_x, F_y = loads["thrust 2224 N, radial 1112 N"]
    fmus = {"rigid halves": (fmu, "two_half"), "elastic, bronze": (fmu, "elastic")}
    fmus |= {f"{factor} times softer": (softer_cage(factor), "elastic") for factor in (10, 100)}
    soft = [
        {"cage": name}
        | {
            str(speed): running(path, speed, t_end, cage, shaft__F_x=F_x, shaft__F_y=F_y)[2:0:-1]
            for speed in (8000, 12000)
        }
        for name, (path, cage) in fmus.items()
    ]
    return {"t_end": t_end, "rows": rows, "soft": soft} | sensed_forces(fmu, t_end)


SENSORS = (1000.0, 300.0)  # natural frequencies of the part of the cage that feels a ball [Hz]
SENSOR_DAMPING = 0.1  # assumed


def sensed(force, step, frequency):
    """What a part of the cage with one natural frequency [Hz] shows of a force, each ball's in a column: k x of
    m x'' + c x' + k x = F, F joined by straight lines.
    """
    omega = 2.0 * np.pi * frequency
    part = signal.lti([omega**2], [1.0, 2.0 * SENSOR_DAMPING * omega, omega**2])
    times = step * np.arange(len(force))
    return np.column_stack([signal.lsim(part, column, times)[1] for column in force.T])


def sensed_forces(fmu, t_end, speed=12000, step=2e-5):
    """99.9 % quantiles of the forces in the pockets and of what sensors show of them, over F_r/F_a: the abstract does not give
    the radial load.
    """
    rows = []
    for F_x in (2224.0, 4448.0):
        for ratio in (0.0, 0.05, 0.1, 0.2, 0.5):
            inputs = {"shaft.omega": speed * RPM, "shaft.F_x": F_x, "shaft.F_y": ratio * F_x, "shaft.F_z": 0.0}
            parameters = {"scene.cage": "elastic", "start.settle": 0.5 * t_end}
            found = run(
                "demo", fmu=fmu, t_end=t_end, step=step, inputs=inputs, parameters=parameters, outputs=["ball[*].Q_c"]
            )
            force = np.column_stack([values for name, values in found.data.items() if name.endswith("Q_c")])
            late = found.data["time"] > 0.5 * t_end
            shown = {f"{f:g} Hz": np.quantile(np.abs(sensed(force, step, f)[late]), 0.999) for f in SENSORS}
            rows.append({"F_x": F_x, "ratio": ratio, "force": found.summary["stat.Q_c_p999"]} | shown)
            say(f"  {rows[-1]}")
    return {"sensed": rows}


MEASURED = {
    28000: 350.0,
    48000: 700.0,
    64000: 1100.0,
    72000: 1400.0,
}  # r/min: heat [W], digitised from NASA TP-2275, +-3 %
LOSSES = ("races", "inlet", "spin", "ball_drag", "cage_drag", "ring_drag", "land", "pockets")
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
    "balls isolated, 35 kg/m³, no churning, no shear heating, flooded inlets": {
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
        {"speed": speed, "measured": W, "total": P} | {part: entry[f"loss.{part}"] for part in LOSSES}
        for speed, W, P, entry in zip(speeds, measured, total, found, strict=True)
    ]
    changed = [{"change": "as above", "ratio": (total / measured).tolist(), "exponent": exponent(speeds, total)}]
    for name, changes in {} if short else WITHOUT.items():
        power = np.array([heats(fmu, speed, t_end, **changes)["bearing.power_loss"] for speed in speeds])
        changed.append({"change": name, "ratio": (power / measured).tolist(), "exponent": exponent(speeds, power)})
    land = np.array([entry["loss.land"] for entry in found])
    exponents = {
        "measured": exponent(speeds, measured),
        "land": exponent(speeds, land),
        "rest": exponent(speeds, total - land),
    }
    return {"rows": rows, "exponents": exponents, "changed": changed}


def exponent(speeds, power):
    """Slope of ln(power) over ln(speed)."""
    return np.polyfit(np.log(speeds), np.log(power), 1)[0]


if __name__ == "__main__":
    main()
