"""Riveted joint: pull curve, hysteresis, opening, natural frequency, rigid motions, momentum."""

import itertools
import json

import numpy as np
import pytest
from library import ROOT, TWO_HALF
from mechanics import SLICE, Z, pose, running_state
from scipy.spatial.transform import Rotation

from bearing_model.cage.common.cage_joint import JointStep, JointStiffness, cage_joint_follow, cage_joint_slide
from bearing_model.generated import variables
from bearing_model.physics.model import Model
from rivet_model import half_loads, joint_contact
from rivet_model.geometry import Geometry

MU, PRELOAD = 0.15, 20.0
# the table that is embedded
TABLE = json.loads((ROOT / "rivet_model" / "tables" / "6207.json").read_text(encoding="utf-8"))
JOINT = TABLE["joint"] | {
    "k_rivet": TABLE["half"]["k_open"],
    "k_plate": TABLE["half"]["k_closed"] - TABLE["half"]["k_open"],
}
K_RIVET, K_PLATE, K_T, K_H = (JOINT[name] for name in ("k_rivet", "k_plate", "k_t_plate", "k_t_head"))  # [N/m]
K_SLIP = 1.0 / (1.0 / K_T + 1.0 / K_H)  # of a joint whose plates slip
WORK = SLICE["work"]
ROWS = slice(SLICE["joint_plate_y"].start, SLICE["joint_head_z"].stop)


def numbers(lanes):
    """The Z joints' values."""
    return np.array(list(lanes[0:Z]))


class Joints:
    """The Z joints alone: half 0 at rest (or moving), half 1 where the test puts it; friction states follow and slide."""

    def __init__(self, core, **changes):
        self.model = core.model(parameters={"joint.F_floor": 1e-3, "joint.fit": -10e-6, "joint.swell": 4e-6} | changes)
        self.core, self.w = core, self.model.work
        self.y = np.zeros(variables.N_STATES)
        for half in self.w.half:
            pose(core, half)

    def move(self, place, velocity=(0.0, 0.0, 0.0)):
        """Half 1 shifted against half 0 and moving in its frame; returns the total force on half 1."""
        half = self.w.half[1]
        drift = np.cross(list(self.w.half[0].Omega), place)
        half.x, half.v, half.F, half.M = place, tuple(velocity + drift), (0.0, 0.0, 0.0), (0.0, 0.0, 0.0)
        return self.evaluate()

    def evaluate(self):
        self.model.kernel("cage_joint_kinematics")(self.model.pointer, self.w)
        self.model.kernel("two_half_joints")(self.model.pointer, self.core.array(self.y), self.w)
        return np.array(list(self.w.half[1].F))

    def pull(self, path, u_x=0.0):
        """Moves half 1 along y through the places of `path`; force per joint after each, and the work dissipated at a
        joint.
        """
        force, start = [], self.y[WORK].item()
        for here, there in itertools.pairwise(path):
            before = self.y.copy()
            self.y[SLICE["joint_plate_y"]] += there - here
            force.append(-self.move((u_x, there, 0.0))[1] / Z)
            start_of, end = self.core.array(before), self.core.array(self.y)
            self.model.kernel("cage_slide")(self.model.pointer, start_of, end, self.w)
        return np.array(force), (start - self.y[WORK].item()) / Z


def test_pull_curve(core):
    """The plates stick until they slip at mu P, then drag the heads until these slip at mu P more, 6 N in all; free slip up
    to the gap of 6 um; then the shank bears with k_hole.
    """
    joints = Joints(core)  # fit -10 um + swell 4 um
    u = np.linspace(0.0, 9e-6, 901)
    force, _ = joints.pull(u)
    capacity = MU * PRELOAD + 1e-3
    gap, k_hole = 6e-6, np.interp(-6e-6, JOINT["hole_fit"], JOINT["k_hole"])
    dragged = np.minimum(capacity + K_SLIP * (u[1:] - capacity / K_T), 2.0 * capacity)
    law = np.minimum(K_T * u[1:], dragged) + k_hole * np.maximum(u[1:] - gap, 0.0)
    np.testing.assert_allclose(
        force, law, rtol=1e-4
    )  # observed 3e-5: the plates' force by the table of the joint's law
    at = lambda place: force[np.searchsorted(u[1:], place)]
    assert at(5.9e-6) == pytest.approx(2.0 * capacity, rel=1e-4)
    assert at(8.9e-6) - at(6.5e-6) == pytest.approx(k_hole * 2.4e-6, rel=1e-3)


@pytest.mark.parametrize("fit", [-30e-6, -4e-6, 3e-6])
def test_play_of_the_hole(core, fit):
    """Bearing starts at |u| = -(fit + swell), at once with interference; without friction."""
    joints = Joints(core, **{"joint.fit": fit, "joint.mu": 0.0})
    play = max(0.0, -(fit + 4e-6))
    before, after = (
        -joints.move((0.0, (play + step) * 0.6, -(play + step) * 0.8))[1:] / Z
        for step in (-1e-8 if play else 0.0, 1e-7)
    )
    assert before == pytest.approx([0.0, 0.0], abs=1e-12)
    assert np.hypot(*after) == pytest.approx(joints.model.d.k_hole[0] * 1e-7, rel=1e-8)
    assert after / np.hypot(*after) == pytest.approx([0.6, -0.8], rel=1e-8)


@pytest.mark.parametrize("amplitude", [2e-8, 3e-7, 4e-6])
def test_hysteresis(core, amplitude):
    """Cycle of +-A: the loop encloses four times the slips of plates and heads times their friction F_c, nothing as long as
    nothing slips, and that is what is dissipated.
    """
    joints = Joints(core)
    F_c = MU * PRELOAD + 1e-3
    joints.pull(np.linspace(0.0, amplitude, 401))
    joints.pull(np.linspace(amplitude, -amplitude, 801))  # where the closed loop begins
    there = np.linspace(-amplitude, amplitude, 801)
    force_there, work_there = joints.pull(there)
    force_back, work_back = joints.pull(there[::-1])
    peak = min(K_T * amplitude, F_c + K_SLIP * (amplitude - F_c / K_T), 2.0 * F_c)
    slip = max(amplitude - max(peak, F_c) / K_T, 0.0)
    loop = 4.0 * F_c * (slip + max(slip - F_c / K_H, 0.0))
    ends = np.concatenate([[force_back[-1]], force_there, force_back])  # closes where it began
    enclosed = np.trapezoid(ends, np.concatenate([there, there[-2::-1]]))
    assert work_there + work_back == pytest.approx(loop, rel=1e-4, abs=1e-18)  # observed 3e-5, as above
    assert enclosed == pytest.approx(loop, rel=1e-4, abs=1e-18)


# ------------------------------------------------------------------------------------------------------- the friction law


class ByC:
    """Friction of the joints alone, by the C core: states z [4, Z] that follow motions and slide."""

    def __init__(self, core, floor=1e-3, mu=MU):
        self.core = core
        self.model = core.model(parameters=TWO_HALF | {"joint.F_floor": floor, "joint.mu": mu})
        self.stiffness = core.new("JointStiffness")
        self.stiffness.stick, self.stiffness.head = K_T, K_H
        self.y, self.rubbed = np.zeros(variables.N_STATES), np.zeros(Z)

    @property
    def z(self):
        return self.y[ROWS].reshape(4, Z).copy()

    def move(self, way, T, N_plate):
        """Moves the joints by `way` [2, Z] under the forces T, N_plate [Z]; returns what is dissipated."""
        step, lanes = self.core.new("JointStep"), self.core.lib.LANES
        step.before[0 : 4 * Z] = list(self.z.ravel())
        padded = [np.pad(x, (0, lanes - Z)) for x in (*way, T, N_plate)]
        (by_y, by_z, T, N), y = map(self.core.array, padded), self.core.array(self.y)
        self.model.kernel("cage_joint_follow")(1.0, by_y, by_z, y)
        lost = self.model.kernel("cage_joint_slide")(self.model.pointer, self.stiffness, T, N, y, step)
        self.rubbed += list(step.rubbed)[:Z]
        return lost


class ByPython:
    """The same by the twin."""

    def __init__(self, core, floor=1e-3, mu=MU):
        self.model = Model.of(TWO_HALF | {"joint.F_floor": floor, "joint.mu": mu})
        self.y, self.rubbed, self.stiffness = np.zeros(variables.N_STATES), np.zeros(Z), JointStiffness(K_T, K_H, None)

    @property
    def z(self):
        return self.y[ROWS].reshape(4, Z).copy()

    def move(self, way, T, N_plate):
        step = JointStep(cage_joint_follow(1.0, way, self.y))
        lost = cage_joint_slide(self.model, self.stiffness, T, N_plate, self.y, step)
        self.rubbed += step.rubbed
        return lost


def shear(law):
    """Forces [2, Z] that carry the joints' load."""
    return K_T * law.z[:2]


def carry(law, V, T, N_plate):
    """Moves the joints until they carry the load V [2, Z] [N], below their slip load; returns how far [2, Z].

    The law's force falls short of the elastic one, so that the steps of a Newton iteration with the elastic stiffness
    approach from one side.
    """
    moved = np.zeros((2, Z))
    for _ in range(1000):
        missing = V - shear(law)
        if np.max(np.abs(missing)) < 1e-9:
            return moved
        moved += missing / K_T
        law.move(missing / K_T, T, N_plate)
    raise AssertionError("the load is beyond the slip load")


twins = pytest.mark.parametrize("twin", [ByC, ByPython])
CLAMPED = np.full(Z, PRELOAD), np.full(Z, PRELOAD)
SLIP_LOAD = 2.0 * (MU * PRELOAD + 1e-3)  # of plates and heads


@twins
def test_vibration_does_not_walk_the_joint(core, twin):
    """A constant shear of 50 or 75 % of the slip load and a vibration of 5 to 24 % of it, along it or across it: after the
    first cycle nothing moves in 10,000 cycles (Melan: it shakes down), not even by 1e-9 slip deflections.

    Dahl's law, z' = v - |v| k z/C, would walk by 0.27 slip deflections a cycle at 50 +- 10 %.
    """
    law, angle = twin(core), np.linspace(0.0, np.pi / 2, Z)
    share = np.array([0.05, 0.20, 0.24])[np.arange(Z) % 3]
    constant = np.where(np.arange(Z) < 6, 0.5, 0.75) * SLIP_LOAD * np.array([np.ones(Z), np.zeros(Z)])
    vibration = share * SLIP_LOAD * np.array([np.cos(angle), np.sin(angle)])
    carry(law, constant, *CLAMPED)
    for sign in (1.0, -1.0):
        carry(law, constant + sign * vibration, *CLAMPED)
    carry(law, constant, *CLAMPED)
    begin, way = law.z, vibration / K_T
    law.rubbed[:] = 0.0
    lost = 0.0
    for part in (1.0, -1.0, -1.0, 1.0) * 10_000:  # nothing slips: the load goes with the motion
        lost += law.move(part * way, *CLAMPED)
    assert np.max(np.abs(law.z - begin)) < 1e-9 * SLIP_LOAD / (2.0 * K_T)
    assert lost < 1e-15 and np.max(law.rubbed) < 1e-9
    np.testing.assert_allclose(shear(law), constant, rtol=1e-8, atol=1e-8)


@twins
def test_a_turning_load_shakes_down(core, twin):
    """A load of 20 to 70 % of the slip load that turns: after some turns it moves the joint around a circle and the same one for
    ever.  Where it is less than the plates hold alone, nothing moves but elastically.
    """
    law, size = twin(core), np.linspace(0.2, 0.7, Z) * SLIP_LOAD
    steps, place, turns = 12, np.zeros((2, Z)), []
    for i in range(31 * steps):
        angle = 2.0 * np.pi * i / steps
        place = place + carry(law, size * np.array([[np.cos(angle)], [np.sin(angle)]]), *CLAMPED)
        if i % steps == 0:
            turns.append(place)
    drift = np.hypot(*(turns[-1] - turns[-2])) / (SLIP_LOAD / 2.0 / K_T)
    assert np.max(drift) < 1e-6
    np.testing.assert_allclose(turns[-1][:, size < 0.5 * SLIP_LOAD], turns[0][:, size < 0.5 * SLIP_LOAD], atol=1e-16)


@twins
def test_beyond_the_slip_load_coulombs_law_holds(core, twin):
    """Joints that are moved on slide with mu times the clamping forces against the motion, at any step of it.  When the
    motion turns by a right angle, the force of plates alone follows: z' = v - (v.n) n gives tan(theta/2) =
    tan(theta_0/2) e^(-u/z_c).
    """
    direction = np.array([0.6, -0.8])[:, None]
    for ways in (np.full(1, 1e-5), np.full(100, 1e-7), np.full(20, 5e-7)):
        law = twin(core)
        T, N = np.linspace(5.0, 40.0, Z), np.linspace(30.0, 2.0, Z)
        lost = sum(law.move(way * direction * np.ones(Z), T, N) for way in ways)
        C_plate, C_head = MU * N + 1e-3, MU * T + 1e-3
        np.testing.assert_allclose(shear(law), (C_plate + C_head) * direction, rtol=1e-12)
        if len(ways) > 1:
            plates = np.sum(ways) - (C_plate + C_head) / K_T
            heads = plates - C_head / K_H
            # the mean force of the steps in which slip begins errs by half of what they add at most
            bound = 0.5 * ways[0] * np.sum(C_plate + C_head)
            assert lost == pytest.approx(np.sum(C_plate * plates + C_head * heads), abs=bound)
            np.testing.assert_allclose(law.rubbed, N * plates + T * heads, rtol=1e-12)
    law, loose = twin(core, floor=1e-3), np.zeros(Z)
    law.move(1e-5 * direction * np.ones(Z), loose, N)
    across, z_c = np.array([0.8, 0.6])[:, None], C_plate / K_T
    for _ in range(400):
        law.move(1e-3 * z_c * across, loose, N)
    theta = np.arctan2(*[np.sum(law.z[:2] * e, axis=0) for e in (direction, across)])
    np.testing.assert_allclose(np.tan(0.5 * theta), np.tan(np.pi / 4) * np.exp(-0.4), rtol=2e-2)  # the floor: 1 %


@twins
def test_work_is_stored_or_dissipated(core, twin):
    """Random motions, and between them clamping forces that change, fall away and return: the work of the mean force over
    each motion is what the springs store and what is dissipated, to rounding; nothing is dissipated that is negative.  A
    clamping force that falls while nothing moves dissipates what the springs lose.
    """
    rng, law = np.random.default_rng(4), twin(core)

    def stored():
        return 0.5 * np.sum(K_T * law.z[:2] ** 2 + K_H * law.z[2:] ** 2)

    work = dissipated = 0.0
    for _ in range(300):
        way = rng.normal(0.0, 10 ** rng.uniform(-9, -6), (2, Z))
        T, N = rng.uniform(0.0, 40.0, (2, Z)) * rng.integers(0, 2, (2, Z))
        E = stored()
        fallen = law.move(np.zeros((2, Z)), T, N)
        assert fallen == pytest.approx(E - stored(), rel=1e-10, abs=1e-24) and fallen >= 0.0
        before, E = shear(law), stored()
        lost = law.move(way, T, N)
        done = np.sum(0.5 * (before + shear(law)) * way)
        assert lost >= 0.0
        assert done == pytest.approx(stored() - E + lost, abs=1e-12 * (E + stored() + lost) + 1e-24)
        work, dissipated = work + done, dissipated + lost
        assert np.all(np.hypot(*(K_T * law.z[:2] - K_H * law.z[2:])) <= (MU * N + 1e-3) * (1.0 + 1e-12))
        assert np.all(K_H * np.hypot(*law.z[2:]) <= (MU * T + 1e-3) * (1.0 + 1e-14))
    assert dissipated > 0.5 * work > 0.0
    carry(law, 0.9 * SLIP_LOAD * np.array([np.cos(np.arange(Z)), np.sin(np.arange(Z))]), *CLAMPED)
    E = stored()
    lost = law.move(np.zeros((2, Z)), 0.5 * CLAMPED[0], 0.5 * CLAMPED[1])
    assert lost == pytest.approx(E - stored(), rel=1e-12) and lost > 0.5 * E


def test_the_twins_slide_alike(core):
    """States and losses of both twins over a random path: to rounding."""
    rng, (c, python) = np.random.default_rng(5), (kind(core) for kind in (ByC, ByPython))
    for _ in range(200):
        way, (T, N) = rng.normal(0.0, 3e-7, (2, Z)), rng.uniform(0.0, 40.0, (2, Z))
        lost = [law.move(way, T, N) for law in (c, python)]
        assert lost[0] == pytest.approx(lost[1], rel=1e-12, abs=1e-20)
    np.testing.assert_allclose(c.z, python.z, rtol=1e-12, atol=1e-20)
    np.testing.assert_allclose(c.rubbed, python.rubbed, rtol=1e-12)


def test_axial_law(core):
    """Springs between the halves: rivet P + k u, plates P - k u until they open at P/k; then the rivet alone; pressed
    plates carry more until the rivet goes slack.
    """
    joints = Joints(core)
    opening, slack = PRELOAD / K_PLATE, -PRELOAD / K_RIVET
    for u in (0.3 * opening, 3.0 * opening, 0.8 * slack, 1.7 * slack):
        force = joints.move((u, 0.0, 0.0))
        pull, push = max(PRELOAD + K_RIVET * u, 0.0), max(PRELOAD - K_PLATE * u, 0.0)
        assert (pull == 0.0) == (u < slack) and (push == 0.0) == (u > opening)
        assert numbers(joints.w.cage.two_half.pull) == pytest.approx(np.full(Z, pull), abs=1e-9)
        assert numbers(joints.w.cage.two_half.push) == pytest.approx(np.full(Z, push), abs=1e-9)
        assert force[0] == pytest.approx(Z * (push - pull), abs=1e-8)


@pytest.fixture(scope="module")
def joints_alike():
    """Unilateral contact of joints that are all alike, and the centrifugal load per (rad/s)^2."""
    elastic = half_loads.elastic_half(Geometry())
    return joint_contact.JointContact(elastic, alike=True), half_loads.centrifugal(elastic)


@pytest.mark.parametrize("load", [2.0, 0.3, -0.3])
def test_clamp_force_sets_the_friction(core, load):
    """Friction of joints pulled apart and pressed together by `load` P each: mu of the rivet's tension T at the heads,
    of T - N between the plates.  An open rivet has T = N, a closed one T = P to 2 %: its plates are much stiffer.
    """
    N, joints = load * PRELOAD, Joints(core, **{"joint.F_floor": 0.5})
    low, high = -10.0 * PRELOAD / K_RIVET, 10.0 * PRELOAD / K_RIVET
    for _ in range(60):  # the offset at which the springs have N
        u_x = 0.5 * (low + high)
        joints.move((u_x, 0.0, 0.0))
        low, high = (u_x, high) if joints.w.cage.two_half.pull[0] - joints.w.cage.two_half.push[0] < N else (low, u_x)
    joints.pull([0.0, 2e-6, 4e-6], u_x)  # within the play, 4 times the full deflection of the heads
    joints.move((u_x, 4e-6, 0.0))
    T, pressed = joints.w.cage.two_half.rivet[0][0], joints.w.cage.two_half.N_plate[0]
    assert T - pressed == pytest.approx(N, rel=0.01)
    assert pytest.approx(N if load > 1.0 else PRELOAD, abs=0.02 * PRELOAD) == T
    assert -(joints.w.S_y[0] + joints.w.H_y[0]) == pytest.approx(MU * (T + pressed) + 2 * 0.5, rel=1e-9)


@pytest.mark.parametrize(("omega", "preload"), [(754.0, 20.0), (754.0, 40.0), (1500.0, 20.0), (200.0, 60.0)])
def test_spin_sets_the_friction(core, joints_alike, omega, preload):
    """Breakaway force of a joint in a cage that turns: 2 mu T, T the rivet's tension by direct contact of the halves
    under their centrifugal load.

    The table's law is within 2 % of the contact (tests/test_joint_law.py).  Without the centrifugal load: 2 mu P.
    """
    contact, column = joints_alike
    T = contact.solve(preload, (contact.loads(column=omega**2 * column)[0], np.zeros(1))).rivet[0, 0]
    for switch, expected in ((1, preload), (2, T)):
        joints = Joints(core, **{"joint.preload": preload, "joint.fit": -60e-6, "cage.centrifugal": switch})
        for turning in joints.w.half:
            pose(core, turning, Omega=(omega, 0.0, 0.0))
        force, _ = joints.pull(np.linspace(0.0, 40e-6, 1201))
        print(omega, preload, T, force[-1])
        assert force[-1] == pytest.approx(2.0 * MU * expected, rel=0.02 if switch == 2 else 1e-3)


def test_friction_is_smooth_in_the_speed(core):
    """The slope of the capacity over the cage's speed has no jump: in steps of 0.1 rad/s it changes by less than 0.5 %
    of its largest value.

    The table's states are 7 rad/s apart; joined by straight lines they would give jumps of some 3 %.
    """
    joints = Joints(core, **{"joint.fit": -60e-6})
    joints.y[SLICE["joint_plate_y"]] = 1e-4  # far beyond what friction holds
    capacity = []
    for omega in np.arange(300.0, 600.0, 0.1):
        for turning in joints.w.half:
            pose(core, turning, Omega=(omega, 0.0, 0.0))
        joints.move((0.0, 0.0, 0.0))
        capacity.append(joints.w.S_y[0])
    slope, curvature = np.diff(capacity), np.diff(capacity, n=2)
    print(np.abs(curvature).max() / np.abs(slope).max())
    assert np.abs(curvature).max() < 5e-3 * np.abs(slope).max()


def test_axial_natural_frequency(core):
    """Two halves on Z closed joints: omega^2 = Z (k_rivet + k_plate)/(m/2), damping ratio 0.02.  By differences of
    dy/dt about rest.
    """
    model = core.model(parameters={"joint.F_floor": 1e-3, "oil.eta": 1e-12})
    y = model.start()

    def relative_acceleration(u, v):
        state = y.copy()
        state[SLICE["cage_x"]] += [-0.5 * u, 0.5 * u]
        state[SLICE["cage_v_x"]] += [-0.5 * v, 0.5 * v]
        low, high = model.rhs(0.0, state)[SLICE["cage_v_x"]]
        return high - low

    omega2 = -(relative_acceleration(1e-8, 0.0) - relative_acceleration(-1e-8, 0.0)) / 2e-8
    damping = -(relative_acceleration(0.0, 1e-4) - relative_acceleration(0.0, -1e-4)) / 2e-4
    assert omega2 == pytest.approx(Z * (K_RIVET + K_PLATE) / (0.5 * variables.PARAMETERS["cage.m"].start), rel=1e-6)
    assert damping / (2.0 * np.sqrt(omega2)) == pytest.approx(0.02, rel=1e-3)


def test_common_motion_slips_nowhere(core):
    """Halves offset in their plane that move as one body, turning and tilting: no joint velocity.

    u = 10 um at 757 rad/s would be 8 mm/s without the turn of the frame; observed 1e-17 m/s of 20 m/s.
    """
    rng = np.random.default_rng(1)
    joints = Joints(core)
    for _ in range(10):
        frame = Rotation.from_rotvec(rng.uniform(-1, 1, 3)).as_matrix()
        Omega, v, x = rng.uniform(-800, 800, 3), rng.uniform(-1, 1, 3), rng.uniform(-1e-4, 1e-4, 3)
        offset = frame @ [1e-7, 8e-6, -6e-6]
        pose(core, joints.w.half[0], x=x, v=v, frame=frame, Omega=Omega)
        pose(core, joints.w.half[1], x=x + offset, v=v + np.cross(Omega, offset), frame=frame, Omega=Omega)
        joints.evaluate()
        assert [joints.w.u_x[0], joints.w.u_y[3], joints.w.u_z[5]] == pytest.approx([1e-7, 8e-6, -6e-6], abs=1e-15)
        for v_j in (joints.w.v_jx, joints.w.v_jy, joints.w.v_jz):
            assert np.abs(numbers(v_j)).max() < 1e-12


def test_slip_by_relative_rotation(core):
    """Half 1 turned by 0.1 mrad against half 0: every joint slips 0.1 mrad times the pitch radius, along the
    circumference, at that rate.
    """
    joints = Joints(core, **{"joint.mu": 0.0})
    psi, rate, R = 1e-4, 3.0, 0.5 * 0.0535
    pose(core, joints.w.half[1], frame=Rotation.from_rotvec([psi, 0, 0]).as_matrix(), Omega=(rate, 0.0, 0.0))
    joints.evaluate()
    angle = 2.0 * np.pi * (np.arange(Z) + 0.5) / Z
    assert numbers(joints.w.u_y) == pytest.approx(-R * psi * np.sin(angle), abs=1e-4 * R * psi)
    assert numbers(joints.w.u_z) == pytest.approx(R * psi * np.cos(angle), abs=1e-4 * R * psi)
    assert numbers(joints.w.v_jy) == pytest.approx(-R * rate * np.sin(angle + psi), abs=1e-12)
    assert joints.w.half[1].M[0] == pytest.approx(0.0, abs=1e-9)  # 2.7 um: inside the play


def test_momentum(core):
    """Forces on both halves and their moments about the bearing's centre cancel at random states; observed 1e-15."""
    rng = np.random.default_rng(2)
    model = core.model()
    for _ in range(10):
        y = running_state(model, rng)
        model.rhs(0.0, y)
        w, a_0 = model.work, np.array(list(model.work.half[0].x))
        before = [(np.array(list(h.F)), np.array(list(h.M))) for h in w.half]
        model.kernel("two_half_joints")(model.pointer, core.array(y), w)
        change = [(np.array(list(h.F)) - F, np.array(list(h.M)) - M) for h, (F, M) in zip(w.half, before, strict=True)]
        places = [a_0, np.array(list(w.half[1].x))]
        assert np.abs(change[1][0]).max() > 1.0
        assert change[0][0] + change[1][0] == pytest.approx(np.zeros(3), abs=1e-10)
        total = sum(M + np.cross(x, F) for x, (F, M) in zip(places, change, strict=True))
        assert total == pytest.approx(np.zeros(3), abs=1e-12)
