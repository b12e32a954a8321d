"""Rings that grow by rotation and fit: against Lame's cylinders solved numerically, closed forms of the textbooks, and
the balance of energy.
"""

import numpy as np
import pytest
from mechanics import Instance
from scipy.integrate import solve_bvp
from slave import ERROR, Slave

from bearing_model.generated.variables import STATE_SLICES, Switch
from bearing_model.physics.model import Model
from bearing_model.physics.ring_fit import RingFit
from bearing_model.quasi_static import Bearing, Load, quasi_static
from bearing_model.solver.integrator import simulate

TWINS = True
OMEGA = 18238.0 * np.pi / 30.0
# of the 6207: diameter, radii [m]
BORE, BOTTOM, SHOULDER = 0.035, 0.5 * (0.0535 - 0.0111125), 0.5 * (0.0535 - 0.0111125) + 0.2 * 0.0111125
STEEL = (207e9, 0.3, 7800.0)
H = 1e-4  # communication step [s]


def growth(core, parameters, omega, inputs=None):
    """Growth of the inner groove's radius [m] by the constants of either twin."""
    model = core.model(parameters={"ring.bore": BORE} | parameters, inputs=inputs or {})
    fit = model.d.fit
    return fit.growth * omega**2 + fit.per_fit * max(fit.fit - fit.loosening * omega**2, 0.0)


def two_cylinders(radii, inner, outer, interference, omega, at):
    """Displacement at the radius `at` of the outer one of two cylinders pressed into each other, by the equilibrium of
    their elements, solved numerically.

    Each: u'' + u'/r - u/r^2 = -(1 - nu^2) rho omega^2 r/E; radial stress E/(1 - nu^2) (u' + nu u/r): none at bore and
    rim, equal at the seat. radii: bore, seat, rim [m].  inner, outer: E, nu, rho.  interference: of the radius [m].
    """
    a, s, b = radii
    scale = 1e-6  # [m] of the displacements
    (E_1, nu_1, rho_1), (E_2, nu_2, rho_2) = inner, outer

    def equations(x, y):
        r_1, r_2 = a + (s - a) * x, s + (b - s) * x
        force_1, force_2 = (
            (1.0 - nu**2) * rho * omega**2 * r / E / scale
            for nu, rho, r, E in ((nu_1, rho_1, r_1, E_1), (nu_2, rho_2, r_2, E_2))
        )
        return np.array(
            [
                (s - a) * y[1],
                (s - a) * (y[0] / r_1**2 - y[1] / r_1 - force_1),
                (b - s) * y[3],
                (b - s) * (y[2] / r_2**2 - y[3] / r_2 - force_2),
            ]
        )

    def stress(E, nu, u, slope, r):
        return E / (1.0 - nu**2) * (slope + nu * u / r) / 1e11

    def ends(p, q):
        seat = stress(E_1, nu_1, q[0], q[1], s) - stress(E_2, nu_2, p[2], p[3], s)
        return np.array(
            [
                stress(E_1, nu_1, p[0], p[1], a),
                seat,
                p[2] - q[0] - interference / scale,
                stress(E_2, nu_2, q[2], q[3], b),
            ]
        )

    x = np.linspace(0.0, 1.0, 60)
    solution = solve_bvp(equations, ends, x, np.full((4, 60), 0.1), tol=1e-8, max_nodes=20000)
    assert solution.success
    return solution.sol((at - s) / (b - s))[2] * scale


# ----------------------------------------------------------------------------------------------------------- inner ring


@pytest.mark.parametrize(
    ("hole", "interference", "omega"), [(0.01, 20e-6, 0.0), (0.01, 20e-6, OMEGA), (0.02, 40e-6, 5000.0)]
)
def test_ring_on_its_shaft(core, hole, interference, omega):
    """Growth of the groove to 0.1 % (observed 1e-6) of the two cylinders solved together: pressed on at rest, at the
    working point and at 5,000 rad/s.
    """
    expected = two_cylinders((0.5 * hole, 0.5 * BORE, SHOULDER), STEEL, STEEL, 0.5 * interference, omega, BOTTOM)
    assert growth(core, {"shaft.bore": hole, "shaft.interference": interference}, omega) == pytest.approx(
        expected, rel=1e-3
    )


def test_light_hollow_shaft(core):
    """A titanium tube in the ring: other elasticity and density, to 0.1 %."""
    tube = {"shaft.bore": 0.028, "shaft.E": 114e9, "shaft.nu": 0.34, "shaft.rho": 4430.0, "shaft.interference": 50e-6}
    expected = two_cylinders((0.014, 0.5 * BORE, SHOULDER), (114e9, 0.34, 4430.0), STEEL, 25e-6, OMEGA, BOTTOM)
    assert growth(core, tube, OMEGA) == pytest.approx(expected, rel=1e-3)


def test_shrink_fit_of_the_textbook(core):
    """Ring and solid shaft of one material at rest: the rim grows by interference x bore/rim diameter."""
    rim = {"ring.effective_i": 2.0 * BOTTOM, "shaft.interference": 12e-6}
    assert growth(core, rim, 0.0) == pytest.approx(0.5 * 12e-6 * 0.5 * BORE / BOTTOM, rel=1e-9)


def test_limits_of_rotation(core):
    """A ring of vanishing thickness grows by rho omega^2 r^3/E."""
    thin = {"ring.bore": 2.0 * BOTTOM * (1.0 - 1e-5), "ring.effective_i": 2.0 * BOTTOM}
    assert growth(core, thin, OMEGA) == pytest.approx(7800.0 * OMEGA**2 * BOTTOM**3 / 207e9, rel=1e-4)


def test_the_ring_comes_loose(core):
    """Up to the speed at which the rotation has taken the interference the shaft holds the ring, beyond it the ring
    grows freely; no jump between.
    """
    parameters = {"shaft.interference": 4e-6}
    fit = core.model(parameters={"ring.bore": BORE} | parameters).d.fit
    loose = np.sqrt(fit.fit / fit.loosening)
    assert 1000.0 < loose < 5000.0
    free, tight = growth(core, {}, 0.9 * loose), growth(core, parameters, 0.9 * loose)
    assert tight > free * 1.001
    assert growth(core, parameters, loose * 1.0001) == pytest.approx(growth(core, {}, loose * 1.0001), rel=1e-9)
    assert growth(core, parameters, loose * 0.9999) == pytest.approx(growth(core, {}, loose * 0.9999), rel=1e-3)
    assert growth(core, {"shaft.interference": -20e-6}, OMEGA) == growth(core, {}, OMEGA)  # clearance is no fit


def test_growth_and_fit_can_be_switched_off_apart(core):
    off = {"scene.growth": Switch.OFF}
    assert growth(core, off, OMEGA) == 0.0
    assert (
        growth(core, off | {"shaft.interference": 10e-6}, OMEGA)
        == growth(core, {"shaft.interference": 10e-6}, 0.0)
        > 0.0
    )


# ----------------------------------------------------------------------------------------------------- outer ring, heat


@pytest.mark.parametrize("housing", [{}, {"housing.outside": 0.1, "housing.E": 71e9, "housing.nu": 0.33}])
def test_ring_in_its_housing(core, housing):
    """Clearance and guide clearance that the housing takes: the ring as inner cylinder in the housing, solved
    numerically, to 0.1 %.
    """
    outer = (housing.get("housing.E", 207e9), housing.get("housing.nu", 0.3), 0.0)
    rim, inside = 0.5 * housing.get("housing.outside", 36.0), 0.5 * (0.0535 + 0.0111125) - 0.2 * 0.0111125
    interference, groove = 30e-6, 0.5 * (0.0535 + 0.0111125)
    seat = two_cylinders((inside, 0.036, min(rim, 3.6)), (207e9, 0.3, 0.0), outer, 0.5 * interference, 0.0, 0.036)
    # of the ring at its seat, which with its inside free of stress tells the pressure
    pressed = 0.5 * interference - seat
    model = core.model(parameters={"ring.outside": 0.072, "housing.interference": interference} | housing)
    taken = 0.5 * (15e-6 - model.p.bearing.P_d)
    shape = [(0.7 * r + 1.3 * inside**2 / r) for r in (groove, 0.036)]  # (1 - nu) r + (1 + nu) c^2/r
    assert taken == pytest.approx(pressed * shape[0] / shape[1], rel=1e-3)
    assert model.p.bearing.d_m == pytest.approx(0.0535 - taken, rel=1e-12)
    land = 0.5 * 0.0597
    assert 0.2e-3 - model.p.cage.guide_clearance == pytest.approx(
        2.0 * pressed * (0.7 * land + 1.3 * inside**2 / land) / shape[1], rel=1e-3
    )


def test_heated_fits(core):
    """By hand: a shaft of aluminium 100 K warmer than at assembly is (23 - 11.7)e-6 x 100 x 35 mm = 39.55 um tighter in
    its ring; an aluminium housing 80 K warmer (23 - 11.7)e-6 x 80 x 72 mm = 65.09 um looser, which frees a ring of 30
    um interference.
    """
    aluminium = {
        "shaft.expansion": 23e-6,
        "shaft.interference": 5e-6,
        "housing.expansion": 23e-6,
        "housing.interference": 30e-6,
    }
    warm = {"ring.T_i": 393.15, "ring.T_e": 373.15}
    model = core.model(parameters=aluminium | {"ring.bore": BORE, "ring.outside": 0.072}, inputs=warm)
    assert model.d.fit.fit == pytest.approx(0.5 * 44.55e-6, rel=1e-9)
    loose = core.model(inputs=warm)
    assert model.p.bearing.P_d == loose.p.bearing.P_d


# ------------------------------------------------------------------------------------------------------- forces, energy


def test_quasi_static_bearing_grows():
    """The balls of the fast bearing under a small axial load: growth of 10 um leaves 20 um less clearance, which is
    another bearing with that clearance.
    """
    fit, load = (
        RingFit(growth=10e-6 / OMEGA**2, per_fit=0.5, fit=0.0, loosening=0.0),
        Load(F_x=500.0, F_y=500.0, omega=OMEGA),
    )
    grown, other = (
        quasi_static(Bearing(P_d=30e-6, fit=fit), load),
        quasi_static(Bearing(P_d=10e-6, d_m=0.0535 + 10e-6), load),
    )
    np.testing.assert_allclose(grown.Q_i, other.Q_i, rtol=2e-3, atol=0.1)
    assert grown.alpha_i.max() < quasi_static(Bearing(P_d=30e-6), load).alpha_i.max() - 0.01


@pytest.mark.c_only
def test_power_of_growth(core):
    """dE/dt = net power at a state whose speed rises by 1e6 rad/s2: the growth puts 10 W into the balls, known to 1e-6
    of it, of 1 um each 10 us.
    """
    bearing = Instance(core, {"scene.cage": 1})
    for i in range(3):
        bearing.step((i + 1) * H)
    y, rise = bearing.y, 1e6
    model, trajectory = core.model(parameters={"scene.cage": 1}), core.new("InputTrajectory")
    u = core.ffi.new("Inputs[3]")
    u[0] = model.u[0]
    powers = []
    for omega_dot in (0.0, rise):
        u[1].shaft.omega = omega_dot
        core.lib.input_trajectory_update(model.p, u, 0.0, 0.0, trajectory)
        model.pointer.trajectory = trajectory

        def at(t, y):
            y_dot = np.empty_like(y)
            y = np.ascontiguousarray(y)
            model.kernel("rhs")(model.pointer, t, core.array(y), core.array(y_dot), model.work)
            return y_dot, model.energy(y)

        rate, h = at(0.0, y)[0], 1e-8
        E = {n: at(n * h, y + n * h * rate)[1] for n in (-2, -1, 1, 2)}
        powers.append(rate[STATE_SLICES["work"].start])
        assert (8.0 * (E[1] - E[-1]) - (E[2] - E[-2])) / (12.0 * h) == pytest.approx(powers[-1], abs=1e-5)
    assert 1.0 < powers[1] - powers[0] < 100.0


@pytest.mark.c_only
def test_a_jump_of_speed_keeps_the_balance(folder):
    """The speed rises by 100 rad/s at every communication point, growth by 0.12 um and elastic energy by 1.5 mJ: the
    residual stays below 1e-3 of the loss.

    FMU and reference alike; the loss of 0.1 ms is 0.11 J.  Observed 1.6e-4 and 4e-9.
    """
    step = 2e-5
    slave = Slave(folder).initialize(tolerance=1e-6)
    residuals, clearances = [], []
    for i in range(5):
        slave.set("shaft.omega", OMEGA + 100.0 * i)
        residual, clearance = slave.step(step).get("bearing.energy_residual", "bearing.clearance")
        residuals.append(residual), clearances.append(clearance)
    twin = simulate(
        {}, lambda t: {"shaft.omega": OMEGA + 100.0 * round(t / step)}, t_end=5 * step, step=step, tolerance=1e-6
    )
    loss = slave.get("bearing.power_loss")[0] * 5 * step
    assert np.abs(residuals).max() < 1e-3 * loss and np.abs(twin["bearing.energy_residual"]).max() < 1e-3 * loss
    np.testing.assert_allclose(clearances, twin["bearing.clearance"][1:], rtol=1e-12)


# ------------------------------------------------------------------------------------------------------ event, refusals


@pytest.mark.c_only
def test_no_clearance_left_is_an_event(folder):
    """1 um of clearance at rest: none is left at the working point, which the log says once as a warning; with a hot
    outer ring it comes back.
    """
    slave = Slave(folder, logging=True).initialize(bearing__P_d=1e-6)
    names = ("event.no_clearance", "event.no_clearance_onsets", "bearing.clearance")
    now, onsets, clearance = slave.get(*names)
    assert (now, onsets) == (1.0, 1.0)
    assert clearance == pytest.approx(1e-6 - 2.0 * 1.1526e-6, rel=1e-3)
    warnings = [text for _, category, text in slave.messages if category == "logStatusWarning"]
    assert len(warnings) == 1 and "no clearance left: bearing.clearance = -1.3" in warnings[0]
    slave.set("ring.T_e", 300.0)
    assert list(slave.step(H).get(*names[:2])) == [0.0, 1.0]
    slave.set("ring.T_e", 293.15)
    assert list(slave.step(H).get(*names[:2])) == [1.0, 2.0]


@pytest.mark.c_only
@pytest.mark.parametrize(
    ("parameters", "reason"),
    [
        ({"shaft.bore": 0.036}, "shaft.bore = 0.036"),
        ({"ring.outside": 0.06}, "ring.outside = 0.06"),
        ({"housing.outside": 0.07}, "housing.outside = 0.07"),
        ({"ring.effective_i": 0.04}, "ring.effective_i = 0.04"),
        ({"ring.effective_e": 0.07}, "ring.effective_e = 0.07"),
        ({"oil.T_1": 380.0}, "oil.T_1 = 380 K: less than oil.T_2 = 373.15 K is allowed"),
        ({"oil.nu_1": 4e-6}, "oil.nu_1 = 4e-06 m2/s: more than oil.nu_2"),
    ],
)
def test_rings_and_points_of_oil_that_are_none(folder, parameters, reason):
    slave = Slave(folder)
    for name, value in parameters.items():
        slave.set(name, value)
    slave.check("SetupExperiment", 0, 0.0, 0.0, 0, 0.0)
    statuses = [slave.call("EnterInitializationMode"), slave.call("ExitInitializationMode")]
    assert ERROR in statuses and any(reason in message for _, _, message in slave.messages), slave.messages
    with pytest.raises(ValueError, match=reason.split(" ")[0]):
        Model.of(parameters)
