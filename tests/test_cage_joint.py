"""Riveted joint: pull curve, hysteresis, opening, natural frequency, rigid motions, momentum."""

import itertools
import json

import numpy as np
import pytest
from library import ROOT
from mechanics import SLICE, Z, pose, running_state
from scipy.spatial.transform import Rotation

from bearing_model.generated import variables
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

NAMES = ("plate_y", "plate_z", "head_y", "head_z")


def numbers(lanes):
    """The Z joints' values."""
    return np.array(list(lanes[0:Z]))


class Joints:
    """The Z joints alone: half 0 at rest (or moving), half 1 where the test puts it; friction states integrated here."""

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

    def advance(self, dt, start=None):
        """One explicit step of the friction states (from `start`, else from now) with the rates just evaluated."""
        start = self.y if start is None else start
        self.y = start + 0.0
        for name in NAMES:
            self.y[SLICE[f"joint_{name}"]] += dt * numbers(getattr(self.w, f"{name}_dot"))

    def pull(self, path, speed=1e-3):
        """Moves half 1 along y through the places of `path`; friction force per joint after each, and the dissipated
        work.
        """
        force, work = [], 0.0
        for here, there in itertools.pairwise(path):
            step, middle = there - here, 0.5 * (here + there)
            dt = abs(step) / speed
            before, v = self.y, (0.0, np.sign(step) * speed, 0.0)
            self.move((0.0, here, 0.0), v)  # midpoint rule
            self.advance(0.5 * dt)
            self.move((0.0, middle, 0.0), v)
            work += dt * numbers(self.w.joint_dissipated).sum() / Z
            self.advance(dt, before)
            force.append(-self.move((0.0, there, 0.0))[1] / Z)
        return np.array(force), work


def test_pull_curve(core):
    """Plates then heads hold mu P each, 2 mu P = 6 N in all; free slip up to the gap of 6 um; then the shank bears with
    k_hole.

    Dahl's law pulled one way: mu P (1 - exp(-k u/(mu P))) for each of the two.  Midpoint steps of 6 nm: observed 1e-4
    of 6 N.
    """
    joints = Joints(core)  # fit -10 um + swell 4 um
    u = np.linspace(0.0, 9e-6, 1501)
    force, _ = joints.pull(u)
    capacity = MU * PRELOAD
    gap, k_hole = 6e-6, np.interp(-6e-6, JOINT["hole_fit"], JOINT["k_hole"])
    law = sum(
        (capacity + 1e-3) * (1.0 - np.exp(-k * u[1:] / (capacity + 1e-3))) for k in (K_T, K_H)
    ) + k_hole * np.maximum(u[1:] - gap, 0.0)
    assert np.abs(force - law).max() < 1e-3
    at = lambda place: force[np.searchsorted(u[1:], place)]
    assert at(5.9e-6) == pytest.approx(2.0 * capacity, rel=1e-3)
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


@pytest.mark.parametrize("amplitude", [1e-7, 5e-7, 4e-6])
def test_hysteresis(core, amplitude):
    """Cycle of +-A: Dahl's loop encloses 4 F_c (A - (F_c/k) tanh(k A/F_c)) for plates and heads, and that is what is
    dissipated.

    From z(u) = z_c - (z_c + z_m) exp(-(u + A)/z_c), z_c = F_c/k, z_m = z_c tanh(A/z_c).  Observed 2e-6.
    """
    joints = Joints(core)
    F_c = MU * PRELOAD + 1e-3
    for name, k in (("plate_y", K_T), ("head_y", K_H)):  # where the closed loop turns
        joints.y[SLICE[f"joint_{name}"]] = -F_c / k * np.tanh(k * amplitude / F_c)
    there = np.linspace(-amplitude, amplitude, 801)
    force_there, work_there = joints.pull(there)
    force_back, work_back = joints.pull(there[::-1])
    loop = sum(4.0 * F_c * (amplitude - F_c / k * np.tanh(k * amplitude / F_c)) for k in (K_T, K_H))
    ends = np.concatenate([[force_back[-1]], force_there, force_back])  # closes where it began
    enclosed = np.trapezoid(ends, np.concatenate([there, there[-2::-1]]))
    assert work_there + work_back == pytest.approx(loop, rel=1e-4)
    assert enclosed == pytest.approx(loop, rel=1e-4)


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
        assert numbers(joints.w.two_half.pull) == pytest.approx(np.full(Z, pull), abs=1e-9)
        assert numbers(joints.w.two_half.push) == pytest.approx(np.full(Z, push), abs=1e-9)
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
        low, high = (u_x, high) if joints.w.two_half.pull[0] - joints.w.two_half.push[0] < N else (low, u_x)
    for _ in range(8000):  # 16 um: 12 times the full deflection of the heads
        joints.move((u_x, 1e-6, 0.0), (0.0, 1e-3, 0.0))
        joints.advance(2e-6)
    joints.move((u_x, 1e-6, 0.0))
    T, pressed = joints.w.two_half.rivet[0][0], joints.w.two_half.N_plate[0]
    assert T - pressed == pytest.approx(N, rel=0.01)
    assert pytest.approx(N if load > 1.0 else PRELOAD, abs=0.02 * PRELOAD) == T
    assert -(joints.w.S_y[0] + joints.w.H_y[0]) == pytest.approx(MU * (T + pressed) + 2 * 0.5, abs=3e-3)


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
    joints.y[SLICE["joint_plate_y"]] = 1e-7
    rate = []
    for omega in np.arange(300.0, 600.0, 0.1):
        for turning in joints.w.half:
            pose(core, turning, Omega=(omega, 0.0, 0.0))
        joints.move((0.0, 0.0, 0.0), (0.0, 1e-3, 0.0))
        rate.append(1.0 / (1e-3 - joints.w.plate_y_dot[0]))  # in proportion to the capacity
    slope, curvature = np.diff(rate), np.diff(rate, n=2)
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
    """Halves offset in their plane that move as one body, turning and tilting: no joint velocity, no rate of friction.

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
        assert np.abs([numbers(getattr(joints.w, f"{name}_dot")) for name in NAMES]).max() < 1e-12


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
