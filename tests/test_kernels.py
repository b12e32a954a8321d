"""Kernels of different instruction sets give the same bits in all outputs: AVX2's packets of four, AVX-512's of eight.

RIVETED_BEARING_ISA chooses the kernels when an instance is made.  Where the processor has no AVX-512, the library
RivetedBearing_by_fours computes its packets by AVX2 (`cmake --build build --target RivetedBearing_by_fours`: some
minutes; tests skip without it).
"""

import os
import re
import shutil

import fmpy
import numpy as np
import pytest
from library import ROOT
from slave import DISCARD, ERROR, OK, Slave

from bearing_model.generated import variables

H = 1e-4  # communication step [s]
STEPS = 12
LEFT_OUT = {"solver.cpu_time"}
BY_FOURS = ROOT / "build" / f"RivetedBearing_by_fours{fmpy.sharedLibraryExtension}"
TYPES = {"Method": 2, "TiltMode": 3, "RingMotion": 2, "Traction": 2, "Lubrication": 2, "Stress": 4, "Switch": 2}


def kernel_of(folder, name):
    """The kernels that an instance gets: a warning if they are others than asked for."""
    with wanted(name):
        slave = Slave(folder, logging=True)
    messages = [text for *_, text in slave.messages if "RIVETED_BEARING_ISA" in text]
    slave.free()
    return messages


class wanted:
    """Within it instances get the kernels of this name."""

    def __init__(self, name):
        self.name = name

    def __enter__(self):
        self.before = os.environ.get("RIVETED_BEARING_ISA")
        os.environ["RIVETED_BEARING_ISA"] = self.name

    def __exit__(self, *_):
        del os.environ["RIVETED_BEARING_ISA"]
        if self.before is not None:
            os.environ["RIVETED_BEARING_ISA"] = self.before


@pytest.fixture(scope="session")
def eight(folder, tmp_path_factory):
    """Folder of an FMU that has packets of eight on this processor."""
    if not kernel_of(folder, "avx512"):
        return folder
    if not BY_FOURS.is_file():
        pytest.skip("no AVX-512, and no RivetedBearing_by_fours: cmake --build build --target RivetedBearing_by_fours")
    copy = tmp_path_factory.mktemp("by_fours") / "fmu"
    shutil.copytree(folder, copy)
    shutil.copy(BY_FOURS, copy / "binaries" / fmpy.platform / f"RivetedBearing{fmpy.sharedLibraryExtension}")
    if not Slave(copy).component:
        pytest.skip("RivetedBearing_by_fours is of other sources: cmake --build build --target RivetedBearing_by_fours")
    if kernel_of(copy, "avx512"):
        pytest.skip("no fused multiply-add")
    return copy


def draw(variable, random):
    """An allowed value of a variable."""
    if variable.type in TYPES:
        return int(random.integers(1, TYPES[variable.type] + 1))
    if variable.type == "Integer":
        return int(random.integers(variable.min, min(variable.max, 50) + 1))
    if random.random() < 0.6:
        value = random.uniform(0.5, 2.0) * (variable.start or 0.05 * variable.max)
    else:
        value = random.uniform(variable.min, variable.max)
    return float(min(max(value, variable.min), variable.max))


SKIPPED = {
    "solver.max_steps",
    "solver.tol",
    "bearing.d_m",
    "pulse.t_start",
    "start.settle",
    "scene.cage",
    "cage.material",
}


def scene(seed):
    """Parameters, inputs at the start and before two later steps."""
    random = np.random.default_rng([7, seed])
    parameters = {"scene.cage": [1, 3][seed % 2], "start.settle": 0.0, "scene.statistics": 2}
    if seed % 3 == 0:
        parameters["ring.tilt_mode"] = int(random.integers(1, 4))
    for table, into, most in ((variables.PARAMETERS, parameters, 6), (variables.INPUTS, inputs := {}, 2)):
        names = [name for name, v in table.items() if name not in SKIPPED and (v.type in TYPES or v.max is not None)]
        for name in random.choice(names, random.integers(most), replace=False):
            element = f"[{random.integers(1, 10)}]"
            into[re.sub(r"\[\w\]", element, str(name))] = draw(table[name], random)
    names = [name for name in variables.INPUTS if name.split(".")[0] in ("shaft", "housing", "frame", "impact")]
    changes = {
        int(k): {str(n): draw(variables.INPUTS[n], random)}
        for k, n in zip(random.integers(1, STEPS, 2), random.choice(names, 2), strict=True)
    }
    return parameters, inputs, changes


def run(folder, isa, parameters, inputs, changes):
    """All outputs at each communication point and the statuses; None if the start is refused."""
    with wanted(isa):
        slave = Slave(folder)
    slave.check("SetupExperiment", False, 0.0, 0.0, False, 0.0)
    slave.set("solver.max_steps", 2000)
    for name, value in (parameters | inputs).items():
        slave.set(name, value)
    slave.check("EnterInitializationMode")
    if slave.call("ExitInitializationMode") == ERROR:
        return None
    names = [v.name for v in slave.description.modelVariables if v.causality == "output" and v.name not in LEFT_OUT]
    found, status, t = [slave.get(*names)], [], 0.0
    for k in range(STEPS):
        for name, value in changes.get(k, {}).items():
            slave.set(name, value)
        status.append(slave.call("DoStep", t, H, 1))
        if status[-1] == ERROR:
            break
        found.append(slave.get(*names))
        if status[-1] == DISCARD:
            break
        t += H
    slave.free()
    return names, np.array(found), status


def differing(folder, eight, parameters, inputs, changes):
    """Names of the outputs whose bits differ; None where the start is refused."""
    four = run(folder, "avx2", parameters, inputs, changes)
    other = run(eight, "avx512", parameters, inputs, changes)
    assert (four is None) == (other is None)
    if four is None:
        return None
    names, a, status = four
    assert status == other[2] and a.shape == other[1].shape
    return [name for i, name in enumerate(names) if a[:, i].tobytes() != other[1][:, i].tobytes()]


FOUND = [  # what differed once
    ({"scene.cage": 1}, {}, {1: {"housing.tilt_z": -0.035}}),
    ({"scene.cage": 1, "scene.statistics": 2, "start.settle": 0.0}, {}, {8: {"shaft.F_y": 0.0}}),
    ({"scene.cage": 1, "ring.tilt_mode": 2}, {}, {}),
    ({"scene.cage": 1, "ring.tilt_mode": 3}, {}, {}),
    ({"scene.cage": 3, "ring.tilt_mode": 3}, {}, {}),
    ({"scene.cage": 3, "scene.lubrication": 2, "scene.traction": 2}, {"shaft.tilt_z": 0.0087}, {}),
]
X86 = pytest.mark.skipif(fmpy.platform not in ("linux64", "win64"), reason="kernels of x86-64")


@X86
@pytest.mark.parametrize("one", FOUND, ids=str)
def test_scenes_that_differed(folder, eight, one):
    assert differing(folder, eight, *one) == []


SURFACES = {f"{race}.waviness[{n}]": 1e-6 for race in ("inner", "outer") for n in (1, 9, 60)}
SURFACES |= {f"{race}.spall_length": 4e-3 for race in ("inner", "outer")}
SURFACES |= {f"{race}.spall_width": 2e-3 for race in ("inner", "outer")}
SURFACES |= {f"{race}.spall_depth": 5e-5 for race in ("inner", "outer")}
BALL_SPALLS = {
    f"ball[{j}].spall_{name}": value
    for j in (1, 4, 9)
    for name, value in {"length": 2e-3, "width": 3e-3, "depth": 5e-5, "angle": 0.3 * j}.items()
}


@X86
@pytest.mark.parametrize("balls", [{}, BALL_SPALLS], ids=["races", "balls"])
@pytest.mark.parametrize("cage", [1, 3])
def test_surfaces_and_housing(folder, eight, cage, balls):
    """Races that are not perfect and balls with spalls in a housing on springs."""
    parameters = SURFACES | balls | {"scene.cage": cage, "housing.motion": 2, "scene.lubrication": 2}
    assert differing(folder, eight, parameters, {}, {3: {"housing.v_y": 0.01}}) == []


@X86
@pytest.mark.parametrize("seeds", [range(24)], ids=["24 scenes"])
def test_random_scenes(folder, eight, seeds):
    results = {seed: differing(folder, eight, *scene(seed)) for seed in seeds}
    assert not {seed: names[:4] for seed, names in results.items() if names}
    assert sum(names is not None for names in results.values()) > len(seeds) / 3  # others are refused at the start


@X86
@pytest.mark.slow
@pytest.mark.parametrize("first", range(100, 1100, 100))
def test_many_random_scenes(folder, eight, first):
    test_random_scenes(folder, eight, range(first, first + 100))


def test_the_variable_chooses_the_kernels(folder):
    assert not kernel_of(folder, "baseline") and not kernel_of(folder, "")
    assert "avx512, avx2 and baseline are names" in kernel_of(folder, "avx")[0]
    assert len(kernel_of(folder, "neon")) == 1


@X86
def test_kernels_without_fused_multiply_add_differ_in_the_last_bits_only(folder):
    """Baseline and AVX2 round differently: equal to the tolerance, so that the variable is seen to act."""
    a, b = (run(folder, isa, {"scene.cage": 1}, {}, {}) for isa in ("baseline", "avx2"))
    assert a[1].tobytes() != b[1].tobytes()
    y = a[0].index("ring.y")
    assert a[1][:, y] == pytest.approx(b[1][:, y], rel=1e-3)


@X86
@pytest.mark.parametrize("cage", [1, 3])
def test_a_saved_state_goes_on_with_other_kernels(folder, eight, cage):
    """As on another machine: saved by packets of four, continued by packets of eight, and back.  All outputs are compared:
    the states differ in the places of a packet that have no ball.
    """
    with wanted("avx2"):
        four = Slave(folder).initialize(scene__cage=cage, scene__stress=4, start__settle=0.0).step(H, 5)
    with wanted("avx512"):
        other = Slave(eight)
    for giver, taker in ((four, other), (other, four)):
        status, state = taker.try_load(giver.bytes(giver.save()))
        assert status == OK, taker.messages
        taker.restore(state, giver.time)
        for _ in range(5):
            assert np.array_equal(*(slave.step(H).outputs() for slave in (giver, taker)))
