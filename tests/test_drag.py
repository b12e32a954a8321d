"""Drag in the mixture of oil and air: balls, cage ends and cylinder, by hand."""

import numpy as np
import pytest
from mechanics import Z, clear_balls, on_ball, place_balls, pose

TWINS = True
RHO_MIX, NU = 35.0, 6e-3 / 900.0  # [kg/m3], [m2/s]: mixture's density, oil's kinematic viscosity
R_O, R_I, C = 0.02975, 0.02485, 1e-4  # cage radii, radial guide clearance [m]
WIDTH = 0.5 * 13.5e-3 - 2.5e-3  # of the cylinder beside the land of one half [m]


def test_balls(core):
    """(1/2) 0.45 * 35 kg/m3 * 96.985 mm2 * (20 m/s)^2 = 0.30550 N against the motion; power F v."""
    m = core.model()
    v_t = np.linspace(-20.0, 20.0, Z)
    w = place_balls(m, np.zeros(Z), np.full(Z, 0.02675), np.zeros(Z), np.stack([np.full(Z, 5.0), np.full(Z, -3.0), v_t], -1))
    clear_balls(w)
    m.kernel("drag_force")(m.pointer, m.work)
    F, M = on_ball(w)
    assert F[[0, -1], 2] == pytest.approx([0.30550, -0.30550], rel=1e-4)
    assert F[:, 2] == pytest.approx(-0.30550 * (v_t / 20.0) * np.abs(v_t / 20.0), rel=1e-4)
    assert not F[:, :2].any() and not M.any()
    assert w.dissipated[:Z] == pytest.approx(-F[:, 2] * v_t, rel=1e-14)


def cage_moments(core, omega):
    m = core.model()
    for half, speed in zip(m.work.half, omega, strict=True):
        pose(core, half, Omega=(speed, 0.0, 0.0))
    m.kernel("drag_cage")(m.pointer, m.work)
    M = np.array([half.M[0] for half in m.work.half])
    assert m.work.cage_drag_dissipated == pytest.approx(-float(M @ omega), rel=1e-13)
    assert all(half.M[1] == half.M[2] == 0.0 for half in m.work.half)
    return M


def end_face(omega):
    """One face: C_n = 3.87/sqrt(Re) laminar, 0.146/Re^0.2 turbulent."""
    Re = omega * R_O**2 / NU
    C_n = max(3.87 / np.sqrt(Re), 0.146 / Re**0.2)
    return 0.5 * RHO_MIX * omega**2 * (R_O**5 - R_I**5) * C_n / 2.0


def cylinder(omega):
    """Couette flow in the gap, with Taylor vortices beyond."""
    Ta = omega * R_O * C / NU * np.sqrt(C / R_O)
    tau = RHO_MIX * NU * omega * R_O / C * max(1.0, 1.3 * (Ta / 41.0) ** 0.539)
    return tau * 2.0 * np.pi * R_O * WIDTH * R_O


@pytest.mark.parametrize(
    ("omega", "reynolds", "taylor", "hand"),
    [  # laminar both; turbulent face; turbulent face and vortices.  Moments of face and cylinder by hand [N.m]
        (100.0, 13276.0, 2.59, 4.064e-5 + 1.6406e-4),
        (757.0, 100500.0, 19.6, 1.0113e-3 + 1.2420e-3),
        (3000.0, 398300.0, 77.6, 1.2059e-2 + 9.0245e-3),
    ],
)
def test_cage(core, omega, reynolds, taylor, hand):
    assert omega * R_O**2 / NU == pytest.approx(reynolds, rel=1e-3)
    assert omega * R_O * C / NU * np.sqrt(C / R_O) == pytest.approx(taylor, rel=2e-3)
    M = cage_moments(core, np.array([omega, -omega]))
    assert M == pytest.approx(np.array([-1.0, 1.0]) * (end_face(omega) + cylinder(omega)), rel=1e-11)
    assert -M[0] == pytest.approx(hand, rel=1e-3)


def test_cage_at_rest(core):
    assert cage_moments(core, np.zeros(2)).tolist() == [0.0, 0.0]
