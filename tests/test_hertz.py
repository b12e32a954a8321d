"""Hertz' contact: exact elliptic integrals, sphere, tables, load and damping laws."""

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.optimize import brentq
from scipy.special import ellipe, ellipk

from bearing_model.physics.hertz_exact import HertzContact, ball_race_contact, hertz_ellipse

TWINS = True
E_STAR = 0.5 * 207e9 / (1.0 - 0.3**2)


@pytest.mark.c_only
def test_elliptic_integrals(core):
    """scipy's; observed 4e-16."""
    first, second = core.ffi.new("double *"), core.ffi.new("double *")
    for k2 in [0.0, *np.random.default_rng(1).uniform(0.0, 1.0, 500), 1.0 - 1e-6]:
        core.lib.hertz_elliptic(k2, first, second)
        assert first[0] == pytest.approx(ellipk(k2), rel=1e-14)
        assert second[0] == pytest.approx(ellipe(k2), rel=1e-14)


def test_sphere_on_plane(core):
    """a^3 = 3 Q R/(4 E*), Q = (4/3) E* sqrt(R) delta^1.5.  Johnson (1985), section 4.2."""
    R = 0.0111125 / 2
    contact = core.lib.hertz_contact(1.0 / R, 1.0 / R, E_STAR)
    assert contact.K == pytest.approx(4.0 / 3.0 * E_STAR * np.sqrt(R), rel=1e-8)
    assert contact.a == pytest.approx(np.cbrt(0.75 * R / E_STAR), rel=1e-8)
    assert contact.b == pytest.approx(contact.a, rel=1e-8)
    assert contact.k == pytest.approx(1.0, abs=1e-8)


def pressure_solution(rho_x, rho_y, E_star):
    """a, b, K at Q = 1 N from the potential of the ellipsoidal pressure by quadrature: nothing of the elliptic
    integrals' formulae.

    w(0) - A x^2 - B y^2 = 3 Q/(4 pi E*) int_0^inf (1 - x^2/(b^2 + s) - y^2/(a^2 + s)) ds/sqrt((a^2 + s)(b^2 + s) s),  2 A = rho_x, 2 B = rho_y.
    Love (1929); Johnson (1985), section 3.5, 4.2.
    """

    def integral(f, a, b):  # s = t^2 removes the root at 0
        return quad(
            lambda t: 2.0 * f(t * t) / np.sqrt((a * a + t * t) * (b * b + t * t)),
            0.0,
            np.inf,
            epsabs=0.0,
            epsrel=1e-11,
            limit=400,
        )[0]

    def curvature_ratio(ln_k):
        k = np.exp(ln_k)
        return (
            integral(lambda s: 1.0 / (1.0 + s), k, 1.0) / integral(lambda s: 1.0 / (k * k + s), k, 1.0) - rho_x / rho_y
        )

    k = np.exp(brentq(curvature_ratio, 1e-6, 5.0, xtol=1e-13))
    # at b = 1 the curvature is A(1); it falls with 1/b^3
    factor = 3.0 / (4.0 * np.pi * E_star)
    b = np.cbrt(factor * integral(lambda s: 1.0 / (1.0 + s), k, 1.0) / (0.5 * rho_x))
    delta = factor * integral(lambda s: 1.0, k, 1.0) / b
    return k * b, b, delta**-1.5


@pytest.mark.parametrize("rho_y", [0.9, 0.3, 0.05, 0.01])
def test_ellipse_from_the_pressure_itself(core, rho_y):
    """Quadrature to 1e-11; observed 2e-10."""
    contact = core.lib.hertz_contact(200.0, 200.0 * rho_y, E_STAR)
    a, b, K = pressure_solution(200.0, 200.0 * rho_y, E_STAR)
    assert contact.a == pytest.approx(a, rel=1e-8)
    assert contact.b == pytest.approx(b, rel=1e-8)
    assert contact.K == pytest.approx(K, rel=1e-8)
    assert contact.k == pytest.approx(a / b, rel=1e-8)


@pytest.mark.parametrize(
    ("F_rho", "a_star", "b_star", "delta_star"),
    [
        (0.1075, 1.0760, 0.9318, 0.9974),
        (0.3204, 1.2623, 0.8114, 0.9761),
        (0.4795, 1.4556, 0.7278, 0.9429),
        (0.6716, 1.8258, 0.6245, 0.8733),
        (0.87366, 2.800, 0.4863, 0.7169),
        (0.93657, 3.738, 0.4166, 0.6112),
        (0.97290, 5.267, 0.3490, 0.4960),
        (0.990902, 8.062, 0.2814, 0.3745),
    ],
)
def test_harris_table(core, F_rho, a_star, b_star, delta_star):
    """Harris, Rolling Bearing Analysis, table of dimensionless contact parameters, four digits; observed 3.2e-4."""
    total, Q = 300.0, 1.0
    contact = core.lib.hertz_contact(0.5 * total * (1.0 + F_rho), 0.5 * total * (1.0 - F_rho), E_STAR)
    c = np.cbrt(1.5 * Q / (total * E_STAR))
    assert contact.a / c == pytest.approx(a_star, rel=4e-4)
    assert contact.b / c == pytest.approx(b_star, rel=4e-4)
    assert contact.K ** (-2 / 3) / (c**2 * 0.5 * total) == pytest.approx(delta_star, rel=4e-4)


@pytest.mark.parametrize("race", ["inner", "outer"])
def test_derived_races(core, race):
    """The 6207's constants as the independent Python finds them from the same books; observed 1e-13."""
    d = core.model().d
    exact = ball_race_contact(0.0111125, 0.0535, {"inner": 0.515, "outer": 0.52}[race], 0.0, 207e9, 0.3, race)
    hertz = getattr(d, race).hertz
    assert hertz.K == pytest.approx(exact.K, rel=1e-11)
    assert (hertz.a, hertz.b) == pytest.approx(exact.semi_axes(1.0), rel=1e-11)
    assert hertz.a_delta == pytest.approx(exact.semi_axes(exact.K * 1e-9)[0] / np.sqrt(1e-6), rel=1e-11)


def test_groove_geometry(core):
    """At nominal clearance a ball on the outer groove's bottom is P_d/2 away from the inner one's; both radii f D."""
    m = core.model(parameters={"bearing.P_d": 24e-6})
    D, d_m = 0.0111125, 0.0535
    bottom_i = m.d.inner.R_g - m.d.inner.r_g
    bottom_e = m.d.outer.R_g + m.d.outer.r_g
    assert bottom_e - bottom_i == pytest.approx(D + 12e-6, abs=1e-15)
    assert 0.5 * (bottom_i + bottom_e) == pytest.approx(0.5 * d_m, abs=1e-15)
    assert (m.d.inner.r_g, m.d.outer.r_g) == pytest.approx((0.515 * D, 0.52 * D), rel=1e-15)
    assert m.d.m == pytest.approx(7800.0 * np.pi / 6.0 * D**3, rel=1e-14)
    assert m.d.J == pytest.approx(0.4 * m.d.m * (0.5 * D) ** 2, rel=1e-14)


def test_pocket_stiffness(core):
    """Sphere R in a cylinder R + clearance/2 of bronze, by scipy's elliptic integrals; observed 1e-13."""
    R, gap = 0.0111125 / 2, 1e-4
    rho = np.array([1.0 / R, 1.0 / R - 1.0 / (R + gap)])
    E_star = 1.0 / ((1.0 - 0.3**2) / 207e9 + (1.0 - 0.33**2) / 110e9)
    exact = HertzContact(rho.sum(), (rho[0] - rho[1]) / rho.sum(), E_star, hertz_ellipse((rho[0] - rho[1]) / rho.sum()))
    d = core.model().d
    assert d.pocket.K == pytest.approx(exact.K, rel=1e-10)
    assert d.pocket_radius == pytest.approx(R + gap, rel=1e-15)


def test_load_law(core):
    delta = np.array([-1e-5, -1e-12, 0.0, 1e-9, 1e-6, 1.37e-5])
    Q = core.map(core.lib.test_hertz_load, delta, 3.3e10)
    assert Q == pytest.approx(3.3e10 * np.maximum(delta, 0.0) ** 1.5, rel=1e-14)


def test_damping(core):
    """Q (1 + lambda delta_dot), none where it would pull."""
    speed = np.array([-1.0, -20.0001, -20.0, 0.0, 0.1, 3.0])
    damped = core.map(core.lib.test_hertz_damped, speed, 100.0, 0.05)
    assert damped == pytest.approx(100.0 * np.maximum(1.0 + 0.05 * speed, 0.0), abs=1e-12)
