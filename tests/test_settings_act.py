"""A walk over all parameters and inputs: what a command accepts changes its figures, or the command names it.

Each is set once, otherwise than the FMU has it, in a scene or mission that is short; the command's own figures with and
without it are compared here, and what it names as without effect must be the settings that change none, no others.
"""

import math
import re
from dataclasses import replace

import numpy as np
import pytest

from riveted_bearing import UserError
from riveted_bearing.cli import info_tables as info
from riveted_bearing.duty.cycles import outputs_of
from riveted_bearing.duty.mission import plan_mission
from riveted_bearing.duty.parts import FORCED
from riveted_bearing.duty.raceways import rated
from riveted_bearing.running.effects import all_figures, without_effect
from riveted_bearing.running.fmu import Model, codes
from riveted_bearing.running.runner import simulate
from riveted_bearing.running.scene import ALWAYS, load_scene, own_names
from riveted_bearing.running.scene_case import case_at
from riveted_bearing.show import spectrum
from riveted_bearing.studies.matrices import idle_settings, quasi_static_matrices

SHORT = {"simulation": {"t_end": 0.032}, "parameters": {"start.settle": 0.004}}
WHOLE = {"length": 2e-3, "width": 2e-3, "depth": 2e-5}  # of a spall, whose sizes are refused alone


def names():
    """One of each array, all others."""
    model = Model()
    return [name for name in {**model.parameters, **model.inputs} if not re.search(r"\[(?!1\])\d+\]", name)]


NAMES = names()
FIRST_OF_GROUPS = list({name.partition(".")[0].partition("[")[0]: name for name in reversed(NAMES)}.values())
WALK = [pytest.param(name, marks=[] if name in FIRST_OF_GROUPS else pytest.mark.slow) for name in NAMES]


def others(model, name):
    """Values beside the FMU's own, the next ones first, as far as the variable table has room for them."""
    variable = (model.parameters | model.inputs)[name]
    own = ALWAYS.get(name, model.default(variable))
    if variable.type == "Enumeration":
        return [item for item in codes(variable) if item != own]
    if variable.type != "Real":
        return [own + 1, own - 1]
    size = float(variable.nominal or 1.0)
    low, high = (
        math.inf * sign if end is None else float(end) for sign, end in ((-1.0, variable.min), (1.0, variable.max))
    )
    steps = [1.02 * own, 0.98 * own] if own else [0.1 * size, -0.1 * size, 0.01 * size]
    return [value for value in steps if low <= value <= high]


def settings(name, value):
    """A value with those that it needs."""
    head, dot, kind = name.rpartition("spall_")
    if dot and kind in WHOLE:
        return {f"{head}spall_{other}": size for other, size in WHOLE.items()}
    return {name: value}


RESULTS = {}


def ran(model, scene):
    """The Result of a scene, of equal ones once."""
    key = str(
        (
            sorted(scene.parameters.items()),
            sorted((n, h.value.tolist()) for n, h in scene.inputs.items()),
            scene.outputs,
        )
    )
    if key not in RESULTS:
        RESULTS[key] = simulate(model, scene)
    return RESULTS[key]


def scenes(model, name, outputs=()):
    """The short scene with a setting that can be run, and its Result; skipped where no value can be."""
    for value in others(model, name):
        document = {"parameters": {}, "inputs": {}}
        for one, size in settings(name, value).items():
            document["parameters" if one in model.parameters else "inputs"][one] = size
        try:
            scene = load_scene(None, model, ("short", SHORT), ("the test", document))
            scene = replace(scene, outputs=outputs or scene.outputs)
            return scene, ran(model, scene)
        except UserError as refused:
            reason = str(refused)
    pytest.skip(f"refused: {reason}")
    return None


def plain(scene, name):
    """The scene without the setting of a name, in words of the test: its dictionaries without it."""
    return replace(
        scene,
        parameters=ALWAYS | {n: v for n, v in scene.parameters.items() if n != name},
        inputs={n: v for n, v in scene.inputs.items() if n != name},
    )


def told(result):
    """What a run tells of the bearing, by name: all recorded, statistics, damage."""
    timing = re.compile(r"solver\.|.*_time$|real_time")
    return dict(result.data) | {n: v for n, v in result.summary.items() if not timing.match(n)}


def differ(one, other, name):
    """Whether two sets of figures do, the record of the setting itself apart."""
    return one.keys() != other.keys() or any(
        n != name and not np.array_equal(one[n], other[n], equal_nan=True) for n in one
    )


@pytest.mark.parametrize("name", WALK)
def test_run(model, name):
    scene, result = scenes(model, name)
    try:
        changes = differ(told(result), told(ran(model, plain(scene, name))), name)
    except UserError:
        changes = True
    own = own_names(scene, model)
    idle, until = without_effect(model, scene, own, whole=all_figures(result))
    assert until == math.inf and name in own and (name in idle) == (not changes)


@pytest.mark.parametrize("name", WALK)
def test_life(model, name, tmp_path):
    """Stress, damage and raceways of one point, with the seed and the settings that a life has."""
    if name in FORCED:
        pytest.skip("refused in a mission")
    outputs = outputs_of(model)
    scene, _ = scenes(model, name)
    parameters = {n: v for n, v in scene.parameters.items() if n not in FORCED}
    document = {"simulation": {"t_end": scene.t_end}, "parameters": parameters}
    document["inputs"] = {n: float(history(0.0)) for n, history in scene.inputs.items()}
    try:
        mission = plan_mission("walk", document | {"point": [{"hours": 1}]}, model, tmp_path / "walk.toml")
    except UserError as refused:
        pytest.skip(f"refused: {refused}")

    def figures(one):
        parameters = one.parameters | FORCED | {"start.seed": 1}
        result = ran(model, replace(one, parameters=parameters, outputs=outputs))
        damage = {n: v for n, v in result.summary.items() if ".damage_" in n}
        return dict(result.data) | damage | rated(case_at(one, model)).lives

    try:
        changes = differ(figures(scene), figures(plain(scene, name)), name)
    except UserError:
        changes = True
    assert (name in mission.idle()) == (not changes)


@pytest.mark.parametrize("name", WALK)
def test_spectrum(model, name):
    """Spectrum and envelope of the default channel."""
    scene, result = scenes(model, name)
    if result.stopped:
        pytest.skip(f"stopped: {result.stopped}")
    found = spectrum.spectra(result)
    idle, _ = spectrum.idle_settings(result, found)
    try:
        other = spectrum.spectra(
            simulate(model, replace(plain(scene, name), outputs=scene.outputs)), found.channel, found.band
        )
    except UserError:
        assert name not in idle
        return
    changes = not (np.array_equal(found.amplitude, other.amplitude) and found.lines == other.lines)
    assert (name in idle) == (not changes)


@pytest.mark.parametrize("name", WALK)
def test_matrices(model, name):
    """Place and stiffness of the equilibrium, as of `matrices --static`."""
    scene, _ = scenes(model, name)
    try:
        one, other = (
            quasi_static_matrices(case := case_at(each, model), [case.load.omega])[0]
            for each in (scene, plain(scene, name))
        )
        changes = not (np.array_equal(one.K_static, other.K_static) and np.array_equal(one.q, other.q))
    except UserError:
        changes = True
    assert (name in idle_settings(model, scene, one, False, True)) == (not changes)


@pytest.mark.parametrize("name", WALK)
def test_info(model, name):
    scene, _ = scenes(model, name)
    case, own = case_at(scene, model), model.default((model.parameters | model.inputs)[name])
    other = replace(case, values=case.values | {name: own})
    changes = info.cells(case) != info.cells(other)
    assert (name in info.without_effect(case, {name: own})) == (not changes)


@pytest.mark.parametrize(
    "name", ["shaft.v_y", "oil.sigma_pocket", "joint.preload", "ring.m", "housing.tilt_z", "shaft.x"]
)
def test_shaken_matrices(model, name):
    """The reactions of a held ring feel what its equilibrium does not, such as the preload of the cage's joints; the ring's own
    inertia is not in them.
    """
    scene, _ = scenes(model, name)
    case = case_at(scene, model)
    (point,) = quasi_static_matrices(case, [case.load.omega])
    idle = idle_settings(model, scene, point, False, False)
    assert (name in idle) == (name in ("shaft.v_y", "shaft.x", "oil.sigma_pocket", "ring.m"))
    assert "start.settle" in idle


def test_an_input_that_begins_late_needs_no_whole_run(model, monkeypatch):
    """It acts soon after its first point: runs end there, not at the end of the scene."""
    from riveted_bearing.running import effects

    force = {"t": [0.02, 0.021], "value": [0.0, 500.0]}
    document = {"simulation": {"t_end": 0.3}, "parameters": {"start.settle": 0.004}, "inputs": {"impact.F_r": force}}
    scene, ends = load_scene(None, model, ("late", document)), []
    monkeypatch.setattr(effects, "simulate", lambda m, one: ends.append(one.t_end) or simulate(m, one))
    assert without_effect(model, scene, ["impact.F_r"])[0] == [] and 0.02 < max(ends) < 0.05
