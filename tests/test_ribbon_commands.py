"""What ribbon cages change in the commands: refusals by key, ranges, words; slow: each command on a 6309 of the catalogue."""

import json
import os
import subprocess
import sys
from pathlib import Path
from types import SimpleNamespace

import pytest
from commands import command

import riveted_bearing as rb
from riveted_bearing import UserError
from riveted_bearing.bearing.assumed import assumed_ranges
from riveted_bearing.duty.notes import oil_in_pockets
from riveted_bearing.running.fmu import Model

ROOT = Path(__file__).resolve().parents[1]


class Ribbon:
    """A Model whose cage is a ribbon: the 6207's FMU with other start values."""

    def __init__(self, changes):
        self.model, self.changes = Model(), {"cage.shape": "ribbon"} | changes

    def __getattr__(self, name):
        return getattr(self.model, name)

    def default(self, variable):
        return self.changes.get(variable.name, self.model.default(variable))


def test_oil_in_the_pockets_is_told():
    """The note of a life: a ribbon's pockets have a film as those of a machined cage."""
    assert "is assumed" in oil_in_pockets(SimpleNamespace(cases=()), Ribbon({}))


def test_range_of_the_clearance_leaves_room_for_the_sphere():
    """D/2 = 8.73125 mm and a depth of 8.80125 mm: below a clearance of 0.14 mm the pocket is deeper than its sphere.

    Half of 0.28 mm would be that; the range begins 5 % above it.
    """
    sizes = {"bearing.D": 17.4625e-3, "cage.pocket_depth": 8.80125e-3, "cage.pocket_clearance": 0.28e-3}
    ranges = assumed_ranges(Ribbon(sizes | {"cage.guidance": "balls"}))
    assert ranges["cage.pocket_clearance"] == pytest.approx((0.147e-3, 0.56e-3), rel=1e-9)
    assert "cage.guide_clearance" not in ranges
    assert assumed_ranges(Model())["cage.pocket_clearance"][0] == pytest.approx(0.1e-3, rel=1e-9)


def test_python_interface_knows_the_cage():
    """rb.info of both cages; a scene has none of its own."""
    assert rb.info("6309", cage="ribbon").values["cage.guidance"] == "balls"
    assert rb.info("6309").values["cage.guidance"] == "outer"
    with pytest.raises(UserError, match="cage is fixed"):
        rb.info("demo", cage="ribbon")


# ---- every command on a ribbon of the catalogue -------------------------------------------------------------------------

COMMON = 'simulation.t_end = "0.2 s"\n'
POINTS = '[[point]]\nname = "a"\nhours = 30\ninputs.shaft.omega = "9460 rev/min"\n'
FILES = {
    "sweep.toml": 'repeats = 2\n[simulation]\nt_end = 0.2\n[[vary]]\nscene.cage = ["elastic", "two_half"]\n'
    '[[vary]]\nshaft.tilt_z = ["0 deg", "0.2 deg"]\n',
    "mission.toml": COMMON + POINTS + "[life]\nmax_seeds = 3\nmin_seeds = 3\n",
    "decides.toml": 'seeds = 1\nresponses = ["stress"]\n'
    + COMMON
    + "[morris]\ntrajectories = 2\n[sobol]\nfactors = 0\n",
    "choose.toml": 'seeds = 1\nobjectives = ["stress", "dislocation"]\ntrials = 4\nbatch = 2\ncheck_seeds = 2\n'
    "candidates = 1\n" + COMMON + '[between]\njoint.preload = ["5 N", "60 N"]\n',
    "rivets.toml": 'seeds = 1\nbreaks = 2\ninputs.shaft.omega = "15000 rev/min"\n' + COMMON,
    "rig.toml": 'seeds = 1\ncheck_seeds = 2\nsimulation.t_end = "0.16 s"\n[parameter]\noil.eta = ["2 mPa.s", "20 mPa.s"]\n'
    '[screen]\ncount = 8\n[search]\nrounds = 1\npoints = 2\n[[target]]\nmeasure = "friction"\nvalue = "140 N.mm"\n'
    'uncertainty = "5 %"\n',
    "spalls.toml": '[parameters]\nouter.spall_length = "2 mm"\nouter.spall_width = "3 mm"\nouter.spall_depth = "50 um"\n'
    'housing.motion = "supported"\n"ball[1].spall_length" = "2 mm"\n"ball[1].spall_width" = "3 mm"\n'
    '"ball[1].spall_depth" = "50 um"\n"inner.waviness[9]" = "1 um"\n',
}
RUNS = {  # what is asked for -> arguments, and a file that it leaves
    "spalls and waves": ("run spalls.toml --t-end 0.2 --out results/spalls.parquet", "results/spalls.parquet"),
    "rigid halves": ("run --set scene.cage=two_half --t-end 0.2 --out results/two.parquet", "results/two.parquet"),
    "sweep": ("sweep sweep.toml --report", "results/sweep/sweep.html"),
    "life": ("life mission.toml", "results/mission/life.html"),
    "flooded": ("run --set cage.pocket_filling=1 --t-end 0.2 --out results/flooded.parquet", "results/flooded.parquet"),
    "summary": ("summary mission.toml", "results/mission/summary.html"),
    "sensitivity": ("sensitivity decides.toml", "results/decides/sensitivity.json"),
    "optimize": ("optimize choose.toml", "results/choose/optimize.json"),
    "causes": ("causes rivets.toml --order", "results/rivets/causes.json"),
    "identify": ("identify rig.toml", "results/rig/identify.html"),
    "compare": ("compare --long 0 --out results/compare.png", None),
}


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """A folder with the FMU of a 6309 with a ribbon cage, built as a user builds it, and the files of the studies."""
    where = tmp_path_factory.mktemp("ribbon")
    done = command("build", "--bearing", "6309", "--cage", "ribbon", folder=where)
    assert done.returncode == 0, done.stderr
    for name, text in FILES.items():
        (where / name).write_text(text, encoding="utf-8")
    return where


def ask(folder, what):
    """Runs a command, which ends well."""
    done = command(*RUNS[what][0].split(), "--fmu", "6309-ribbon.fmu", folder=folder)
    assert done.returncode == 0, done.stdout + done.stderr
    return done


def left_by(folder, what):
    """The file that a command leaves, which is run if no test of this worker has run it."""
    file = folder / RUNS[what][1]
    if not file.is_file():
        ask(folder, what)
    return file


@pytest.mark.slow
@pytest.mark.parametrize("what", RUNS)
def test_commands(folder, what):
    """Each command ends well and leaves its file."""
    file = RUNS[what][1]
    done = ask(folder, what)
    assert file is None or (folder / file).is_file()
    assert "nan" not in done.stdout.lower()


@pytest.mark.slow
def test_report_and_spectrum(folder):
    """Page and spectrum of a run with spalls; the page has the ribbon's sizes."""
    run = left_by(folder, "spalls and waves").relative_to(folder)
    for word in ("report", "spectrum"):
        done = command(word, str(run), folder=folder)
        assert done.returncode == 0, done.stderr
    assert "cage.sheet" in (folder / "results" / "spalls.html").read_text(encoding="utf-8")


@pytest.mark.slow
def test_rivets_break_one_after_the_other(folder):
    """The order names two rivets of eight."""
    found = json.loads(left_by(folder, "causes").read_text(encoding="utf-8"))["order"]
    first, second = [state["rivet"] for state in found][:2]
    assert 1 <= first <= 8 and 1 <= second <= 8 and first != second


@pytest.mark.slow
@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ("run --set cage.guidance=outer", "cage.guidance"),
        ("run --set cage.shape=machined", "cage.shape"),
        ("run R", "cage.pocket_clearance"),
    ],
)
def test_refusals(folder, arguments, words):
    """What a ribbon cannot have is refused by its key, with exit code 2."""
    done = command(*arguments.split(), "--fmu", "6309-ribbon.fmu", folder=folder)
    assert done.returncode == 2 and words in done.stderr + done.stdout, done.stdout + done.stderr


@pytest.mark.slow
def test_narrow_pockets_keep_their_forces(folder):
    """With a clearance of 0.2 mm in place of 0.28 mm balls reach the corners of fillet and edge.

    Forces stay within ten times their 99.9 % quantile; a law with steps of the energy there gave 1e4 times.
    """
    for cage in ("elastic", "two_half"):
        found = rb.run(
            fmu=folder / "6309-ribbon.fmu",
            parameters={"scene.cage": cage, "cage.pocket_clearance": "0.2 mm"},
            t_end=0.3,
            outputs=["cage.F_pocket_peak"],
        )
        assert found.summary["stat.Q_c_max"] < 10.0 * found.summary["stat.Q_c_p999"]


@pytest.mark.slow
def test_twins_on_the_ribbons_own_table(folder):
    """Rates, steps and derivatives of both twins on the table of a ribbon, whose walls have three radii (the other tests of both twins have
    the machined cage's).
    """
    build = ROOT / "build" / "bearings" / "6309-ribbon"
    subprocess.run(
        ["cmake", "--build", str(build), "--target", "bearing_test"], check=True, capture_output=True, timeout=1800
    )
    names = ["twins_are_equal[0", "dense_step[0", "dense_step[2", "derivatives[machined", "energy_of_a_run[machined"]
    file = str(ROOT / "tests" / "test_cage_elastic.py")
    tests = [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", file, "-k", " or ".join(names)]
    done = subprocess.run(
        tests, env=os.environ | {"BEARING_BUILD": str(build)}, capture_output=True, text=True, timeout=1800, check=False
    )
    assert done.returncode == 0 and "passed" in done.stdout, done.stdout[-3000:]
