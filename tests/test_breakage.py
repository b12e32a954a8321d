"""Rivets that break by their damage in a run, and preload that wear takes from them."""

import re

import numpy as np
import pytest
from library import TWO_HALF
from slave import DISCARD, ERROR, LAST_SUCCESSFUL_TIME, OK, TERMINATED, Slave

from bearing_model import simulate
from bearing_model.generated.variables import CageModel, MeanStress, Stress, Switch, Z
from bearing_model.instance.breakage import BROKEN_HEAD, BROKEN_MIDDLE, Breakage
from bearing_model.instance.fatigue import FatigueChannel, FatigueLaw
from bearing_model.physics.parameters import Parameters
from bearing_model.rivet.rivet_table import RivetTable

H = 1e-4
ON, OFF = int(Switch.ON), int(Switch.OFF)
FATIGUE = {"scene.stress": int(Stress.FATIGUE), "start.settle": 0.0}
WEAK = FATIGUE | {"fatigue.sigma_D": 30e6, "fatigue.k_1": 5.0, "fatigue.k_2": 5.0, "fatigue.acceleration": 3e4}
HEAD, MIDDLE = ([f"rivet[{k}].damage_{place}" for k in range(1, Z + 1)] for place in ("head", "mid"))
BROKEN = [f"rivet[{k}].broken" for k in range(1, Z + 1)]
TIMES = [f"rivet[{k}].break_time" for k in range(1, Z + 1)]
TENSION = [f"rivet[{k}].T" for k in range(1, Z + 1)]
pytestmark = pytest.mark.c_only


def named(values):
    return {name.replace(".", "__"): value for name, value in values.items()}


def started(folder, *parts, logging=False):
    values = {}
    for part in parts:
        values |= part
    return Slave(folder, logging=logging).initialize(**named(values))


def test_it_needs_damage(folder):
    slave = Slave(folder)
    slave.set("scene.breakage", ON)
    slave.check("SetupExperiment", 0, 0.0, 0.0, 0, 0.0)
    slave.check("EnterInitializationMode")
    assert slave.call("ExitInitializationMode") == ERROR
    assert "scene.breakage = 2" in slave.messages[-1][2] and "scene.stress = fatigue" in slave.messages[-1][2]
    with pytest.raises(ValueError, match="scene.breakage = 2"):
        Parameters({"scene.breakage": "on"})


@pytest.mark.parametrize("cage", [int(CageModel.TWO_HALF), int(CageModel.ELASTIC)])
def test_the_first_break_is_where_and_when_its_damage_reaches_one(folder, cage):
    """The same run without breakage, whose damage is read at every communication point: the first place at 1 breaks at that
    point, and up to there the runs have the same bits.
    """
    plain, breaking = (started(folder, WEAK, {"scene.cage": cage, "scene.breakage": on}) for on in (OFF, ON))
    for _ in range(400):
        plain.step(H), breaking.step(H)
        damage = np.array([plain.get(*HEAD), plain.get(*MIDDLE)])
        if np.any(damage >= 1.0):
            break
        assert plain.get(*TENSION).tobytes() == breaking.get(*TENSION).tobytes()
    new = np.flatnonzero(damage.max(axis=0) >= 1.0)
    assert len(new) > 0
    np.testing.assert_array_equal(np.flatnonzero(breaking.get(*BROKEN)), new)
    np.testing.assert_array_equal(breaking.get(*BROKEN)[new], np.where(damage[1] > damage[0], 2.0, 1.0)[new])
    np.testing.assert_allclose(breaking.get(*TIMES)[new], plain.time, rtol=1e-12)
    assert breaking.get("event.rivet_break", "event.rivet_break_onsets").tolist() == [len(new), 1.0]
    assert np.all(breaking.get(*TENSION)[new] == 0.0) and breaking.get("bearing.energy_change")[0] < 0.0
    assert breaking.step(H).get("event.rivet_break")[0] in range(Z)


def test_the_instant_is_that_of_post_processed_damage(folder):
    """Rainflow of the stress read every 2 us, by the reference, after the run: it reaches 1 within one communication step of
    the break, at the same place.
    """
    h, n = 2e-6, 4000
    slave = started(folder, TWO_HALF, WEAK, {"scene.breakage": ON})
    names = [f"rivet[{k}].sigma_{place}" for place in ("head", "mid") for k in range(1, Z + 1)]
    law = FatigueLaw(sigma_D=30e6, k_1=5.0, k_2=5.0, acceleration=3e4)
    channels, found = [FatigueChannel() for _ in names], None
    for channel, sigma in zip(channels, slave.get(*names).tolist(), strict=True):
        channel.push(law, sigma)
    for i in range(n):
        slave.step(h)
        for channel, sigma in zip(channels, slave.get(*names).tolist(), strict=True):
            channel.push(law, sigma)
        if slave.get("event.rivet_break")[0] > 0.0:
            break
        worst = np.array([channel.damage(law) for channel in channels])
        if found is None and worst.max() >= 1.0:
            found = (i, int(np.argmax(worst)))
    k = int(np.flatnonzero(slave.get(*BROKEN))[0])
    place = 0 if slave.get(*BROKEN)[k] == BROKEN_HEAD else 1
    if found is None:  # in the very step
        damage = np.array([channel.damage(law) for channel in channels])
        assert damage[place * Z + k] > 0.8
    else:
        assert abs(found[0] - i) <= 1 and found[1] == place * Z + k


def test_after_a_break_the_loads_are_those_of_a_run_begun_without_the_rivet(folder, record_property):
    """Mean tension of the rivets over 20 ms, from 20 ms after the break: that of a run that begins with the rivet broken, to
    5 %; the neighbours carry more than the others.
    """
    broken = started(folder, TWO_HALF, WEAK, {"scene.breakage": ON})
    for _ in range(400):
        if broken.step(H).get("event.rivet_break")[0]:
            break
    gone = np.flatnonzero(broken.get(*BROKEN))
    broken.set("fatigue.acceleration", 1e-3)
    begun = started(folder, TWO_HALF, WEAK, {"fatigue.acceleration": 1e-3}, {f"rivet[{k + 1}].intact": 0 for k in gone})
    means = []
    for slave in (broken, begun):
        slave.step(H, 200)
        means.append(np.mean([slave.step(H).get(*TENSION) for _ in range(200)], axis=0))
    record_property("tensions", [mean.tolist() for mean in means])
    np.testing.assert_allclose(*means, rtol=0.05, atol=1.0)
    beside = np.setdiff1d(np.concatenate([gone - 1, gone + 1]) % Z, gone)
    others = np.setdiff1d(np.arange(Z), np.concatenate([gone, beside]))
    assert means[0][beside].mean() > 1.05 * means[0][others].mean()


@pytest.mark.parametrize("cage", [int(CageModel.TWO_HALF), int(CageModel.ELASTIC)])
def test_nine_breaks_end_the_run(folder, cage):
    """Rivet after rivet; after the last one the step ends with fmi2Discard, fmi2Terminated and a message, and all outputs are
    numbers.
    """
    slave = started(folder, WEAK, {"scene.breakage": ON, "scene.cage": cage}, logging=True)
    status, steps = OK, 0
    while status == OK and steps < 3000:
        status = slave.call("DoStep", slave.time, H, 1)
        slave.time, steps = slave.time + H, steps + 1
    assert status == DISCARD, steps
    ended, reached = slave.ffi.new("int *"), slave.ffi.new("double *")
    assert slave.call("GetBooleanStatus", TERMINATED, ended) == OK and ended[0]
    assert slave.call("GetRealStatus", LAST_SUCCESSFUL_TIME, reached) == OK
    assert reached[0] == pytest.approx(slave.time, rel=1e-9)
    assert np.isfinite(slave.outputs()).all() and np.all(slave.get(*BROKEN) > 0.0)
    assert "all 9 rivets are broken" in slave.messages[-1][2]
    told = [re.search(r"rivet\[(\d)\] breaks in its (head|middle)", text) for *_, text in slave.messages]
    assert sorted(int(each[1]) for each in told if each) == list(range(1, Z + 1))
    assert slave.get(*TIMES).max() == pytest.approx(slave.time, rel=1e-9)
    slave.check("Reset")
    assert np.all(slave.initialize(**named(TWO_HALF)).step(H).get(*BROKEN) == 0.0)


def test_breaks_go_with_the_saved_state(folder):
    slave = started(folder, TWO_HALF, WEAK, {"scene.breakage": ON})
    before, t_before = slave.save(), slave.time
    while not slave.step(H).get("event.rivet_break")[0]:
        pass
    data, time = slave.bytes(slave.save()), slave.time
    expected = slave.step(H, 3).outputs()
    other = Slave(folder)
    status, state = other.try_load(data)
    assert status == OK and other.restore(state, time).step(H, 3).outputs().tobytes() == expected.tobytes()
    again = slave.restore(before, t_before).step(H, round((time - t_before) / H) + 3)
    assert again.outputs().tobytes() == expected.tobytes()


def test_strength_and_acceleration_scale_the_damage(folder):
    """Below the knee, without a mean stress rule, damage goes with strength^-k_2, and with the factor in any case."""
    law = {"fatigue.mean_stress": int(MeanStress.NONE), "fatigue.sigma_D": 5e9, "rivet[2].strength_factor": 0.5}
    plain = started(folder, TWO_HALF, FATIGUE, law).step(H, 100)
    other = started(folder, TWO_HALF, FATIGUE, law, {"rivet[2].strength_factor": 1.0, "fatigue.acceleration": 10.0})
    ratio = plain.get(*HEAD) / other.step(H, 100).get(*HEAD)
    np.testing.assert_allclose(ratio[[0, 2, 3]], 0.1, rtol=1e-9)
    assert ratio[1] == pytest.approx(0.1 * 2.0**15, rel=1e-9)


def test_the_twin_breaks_the_same_rivets(folder):
    """FMU and reference, 0.1 ms of the start, in which the stress of all rivets rises alike, rivets of different strength:
    the same ones break at the same communication points.
    """
    law = {"fatigue.sigma_D": 1e5, "fatigue.k_1": 1.0, "fatigue.k_2": 1.0}
    strength = {f"rivet[{k}].strength_factor": 1.0 + 0.04 * k for k in range(1, Z + 1)}
    scene, step, n = TWO_HALF | FATIGUE | law | strength, 2.5e-5, 4
    slave = started(folder, scene, {"solver.tol": 1e-7}).step(step, n)
    damage = np.sort(np.maximum(slave.get(*HEAD), slave.get(*MIDDLE)))
    scene |= {"scene.breakage": ON, "fatigue.acceleration": float(1.0 / np.sqrt(damage[-5] * damage[-4]))}
    slave = started(folder, scene, {"solver.tol": 1e-7}).step(step, n)
    twin = simulate(scene, t_end=n * step, step=step, tolerance=1e-7)
    assert np.count_nonzero(slave.get(*BROKEN)) == 4
    np.testing.assert_array_equal(twin["rivet[k].broken"][-1], slave.get(*BROKEN))
    np.testing.assert_allclose(twin["rivet[k].break_time"][-1], slave.get(*TIMES), rtol=1e-9)


def test_the_place_is_the_worse_one():
    p, broken = Parameters({"scene.breakage": "on", "scene.stress": "fatigue", "rivet[4].intact": 0}), Breakage()
    head, mid = np.zeros(Z), np.zeros(Z)
    head[[1, 2, 3]], mid[[2, 3, 5]] = [1.0, 1.2, 9.0], [1.3, 9.0, 0.99]
    assert broken.update(p, 0.5, head, mid) and broken.latest == 2
    assert broken.place.tolist() == [0, BROKEN_HEAD, BROKEN_MIDDLE, 0, 0, 0, 0, 0, 0]
    assert broken.outputs(p)["rivet[k].broken"].tolist() == [0, 1, 2, 3, 0, 0, 0, 0, 0]
    assert not broken.update(p, 0.6, head, mid) and broken.onsets == 1


# ---------------------------------------------------------------------------------------------------------- loosening


def test_wear_is_what_friction_dissipates(folder, core):
    """Archard with the energy: sum of the lost preloads = joint.wear k_stack/A_face (energy lost in the joints)/mu, without
    axial damping and floor.  Observed: within 3 %, because the loss is that of instants, and joints slip for microseconds.
    """
    joint = RivetTable.default().joint if hasattr(RivetTable, "default") else core.lib.rivet_table.joint
    k_stack, seat, A = (joint[n] if isinstance(joint, dict) else getattr(joint, n) for n in ("k_stack", "seat", "A"))
    scene = TWO_HALF | {"joint.wear": 1e-12, "joint.zeta": 0.0, "joint.F_floor": 1e-3, "joint.preload": 10.0}
    slave, lost, h = started(folder, scene), 0.0, 5e-7
    names = [f"rivet[{k}].preload_loss" for k in range(1, Z + 1)]
    slave.step(H, 50)
    begin = slave.get(*names).sum()
    for _ in range(16000):
        lost += slave.step(h).get("loss.joints")[0] * h
    expected = 1e-12 * k_stack / (0.25 * np.pi * seat**2 - A) * lost / 0.15
    assert slave.get(*names).sum() - begin == pytest.approx(expected, rel=0.06)


@pytest.mark.parametrize("cage", [int(CageModel.TWO_HALF), int(CageModel.ELASTIC)])
def test_worn_rivets_lose_their_preload(folder, cage):
    """The preload in force is that of the start less the loss, to 0.1 %, never below 0; no wear, no loss."""
    P, loss = ([f"rivet[{k}].{name}" for k in range(1, Z + 1)] for name in ("P", "preload_loss"))
    slave = started(folder, {"scene.cage": cage, "joint.wear": 1e-6, "scene.stress": 1})
    slave.set("shaft.tilt_y", 0.0087)  # rigid halves rub where the balls tilt them
    slave.step(H, 100)
    left, lost = slave.get(*P), slave.get(*loss)
    assert lost.max() > 0.3  # observed 0.5 and more
    np.testing.assert_allclose(left, np.maximum(20.0 - lost, 0.0), atol=0.1)
    data = slave.bytes(slave.save())
    status, _ = Slave(folder).try_load(data)
    assert status == OK
    assert np.all(started(folder, {"scene.cage": cage}).step(H, 3).get(*loss) == 0.0)
