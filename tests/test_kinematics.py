"""Speeds of balls and cage against rigid-body kinematics, the closed forms' limits and the figures of the 6207 at
18,238 r/min.
"""

import numpy as np
import pytest

from bearing_model.kinematics import CONTROLS, ball_motion, ball_spin, cage_speed, fault_frequencies

D, d_m, Z = 0.0111125, 0.0535, 9
OMEGA = 18238.0 * 2.0 * np.pi / 60.0


def test_6207_at_the_working_point():
    """Figures of the project's requirements, given to 0.1 Hz; observed within 0.05 Hz."""
    f = fault_frequencies(OMEGA, D, d_m, Z)
    assert (f.FTF, f.BPFO, f.BPFI, f.BSF) == pytest.approx((120.4, 1083.7, 1652.0, 700.1), abs=0.051)


def test_published_frequencies_of_the_6205():
    """SKF 6205 (Case Western Reserve University bearing data centre): multiples of the shaft speed, given to 5 digits.

    The ball frequency there, 4.7135, counts both hits of a turn.  The drive-end bearing has 9 balls, D 0.3126 in, d_m
    1.537 in; observed 3e-4.
    """
    f = fault_frequencies(2.0 * np.pi, 0.3126, 1.537, 9)
    assert (f.BPFI, f.BPFO, f.FTF, 2.0 * f.BSF) == pytest.approx((5.4152, 3.5848, 0.39828, 4.7135), rel=5e-4)


@pytest.mark.parametrize("control", CONTROLS)
def test_no_slip_at_both_races(control):
    """Velocities of ball and races at the contacts, by cross products in the plane (x, r, t); observed 1e-15."""
    rng = np.random.default_rng(1)
    for _ in range(50):
        alpha_i, alpha_e = rng.uniform(-0.7, 0.7, 2)
        omega_i, omega_e = rng.uniform(-2000.0, 2000.0, 2)
        m = ball_motion(omega_i, D, d_m, alpha_i, alpha_e, control, omega_e)
        x = np.array([1.0, 0.0, 0.0])
        centre = np.array([0.0, 0.5 * d_m, 0.0])
        ball = m.omega_R * np.array([-np.cos(m.beta), np.sin(m.beta), 0.0]) + m.omega_m * x
        for race, alpha, side, spin in ((omega_i, alpha_i, -1.0, m.spin_i), (omega_e, alpha_e, 1.0, m.spin_e)):
            normal = np.array([np.sin(alpha), np.cos(alpha), 0.0])
            arm = side * 0.5 * D * normal
            v_ball = m.omega_m * np.cross(x, centre) + np.cross(ball, arm)
            v_race = race * np.cross(x, centre + arm)
            assert np.abs(v_ball - v_race).max() < 1e-12 * d_m * 2000.0
            assert spin == pytest.approx((ball - race * x) @ normal, abs=1e-9)


def test_race_control_means_no_spin_there():
    """Jones's hypotheses; without control the spin is shared."""
    angles = 0.45, 0.30
    assert ball_motion(OMEGA, D, d_m, *angles, "outer").spin_e == pytest.approx(0.0, abs=1e-9)
    assert ball_motion(OMEGA, D, d_m, *angles, "inner").spin_i == pytest.approx(0.0, abs=1e-9)
    spin_i = [abs(ball_motion(OMEGA, D, d_m, *angles, control).spin_i) for control in ("inner", "none", "outer")]
    assert spin_i == sorted(spin_i)


def test_orbital_speed_of_race_control():
    """Harris & Kotzalas (2006), ch. 2, for a resting outer race; observed 1e-15."""
    alpha_i, alpha_e, g = 0.45, 0.30, D / d_m
    outer = (1.0 - g * np.cos(alpha_i)) / (1.0 + np.cos(alpha_i - alpha_e))
    inner = (np.cos(alpha_i - alpha_e) - g * np.cos(alpha_e)) / (1.0 + np.cos(alpha_i - alpha_e))
    assert ball_motion(OMEGA, D, d_m, alpha_i, alpha_e, "outer").omega_m == pytest.approx(outer * OMEGA, rel=1e-13)
    assert ball_motion(OMEGA, D, d_m, alpha_i, alpha_e, "inner").omega_m == pytest.approx(inner * OMEGA, rel=1e-13)


@pytest.mark.parametrize("control", ["none", "outer", "inner"])
@pytest.mark.parametrize("alpha", [0.0, 0.6])
def test_equal_angles_give_the_epicyclic_speed(control, alpha):
    """Orbit by all hypotheses; spin by the one whose axis is perpendicular to the contact normal."""
    m = ball_motion(OMEGA, D, d_m, alpha, alpha, control, -100.0)
    assert m.omega_m == pytest.approx(cage_speed(OMEGA, D, d_m, alpha, -100.0), rel=1e-13)
    if control == "none":
        assert m.omega_R == pytest.approx(ball_spin(OMEGA, D, d_m, alpha, -100.0), rel=1e-13)


def test_rings_turning_together_carry_everything_along():
    """No ball spins and nothing passes."""
    m = ball_motion(50.0, D, d_m, 0.3, 0.2, "none", 50.0)
    assert (m.omega_m, m.omega_R) == pytest.approx((50.0, 0.0))
    assert fault_frequencies(50.0, D, d_m, Z, 0.3, 50.0).BPFI == pytest.approx(0.0, abs=1e-12)


def test_passes_add_up():
    """BPFO + BPFI = Z times the relative speed of the rings."""
    f = fault_frequencies(OMEGA, D, d_m, Z, 0.4, -300.0)
    assert f.BPFO + f.BPFI == pytest.approx(Z * (OMEGA + 300.0) / (2.0 * np.pi), rel=1e-13)


def test_outer_ring_that_turns():
    """6205 with its shaft at rest and its housing at 3,000 rev/min: the multiples 0.6031, 3.572, 5.428 and 2.322 of the
    speed that makers print.
    """
    f = fault_frequencies(0.0, 7.9375e-3, 38.5e-3, 9, omega_e=100.0 * np.pi)
    assert (f.FTF, f.BPFO, f.BPFI, f.BSF) == pytest.approx((30.2, 178.6, 271.4, 116.1), abs=0.06)


def test_bad_values_are_named():
    with pytest.raises(ValueError, match=r"D = 0.*positive"):
        cage_speed(1.0, 0, d_m)
    with pytest.raises(ValueError, match=r"d_m = 0.01.*larger than the ball diameter"):
        ball_spin(1.0, D, 0.01)
    with pytest.raises(ValueError, match=r"Z = 0"):
        fault_frequencies(1.0, D, d_m, 0)
    with pytest.raises(ValueError, match=r"control = 'race'.*none, outer, inner"):
        ball_motion(1.0, D, d_m, 0.0, 0.0, "race")
