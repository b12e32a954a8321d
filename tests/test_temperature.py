"""Temperatures of oil, rings, balls and cage: viscosity, clearances, preload and fit against hand calculation, and as
inputs that change during a run.
"""

import re
from types import SimpleNamespace

import numpy as np
import pytest
from library import TWO_HALF
from mechanics import Instance
from slave import ERROR, Slave

from bearing_model.generated.variables import INPUTS, PARAMETERS, CageModel, Switch
from bearing_model.instance.outputs import outputs
from bearing_model.physics.derived import default_table
from bearing_model.physics.model import Model, Work
from bearing_model.physics.rhs import rhs
from bearing_model.solver.integrator import simulate

TWINS = True
FREE_OF_GROWTH = {"scene.growth": Switch.OFF}
# 100, 60, 80 and 70 K above assembly temperature
HOT = {"ring.T_i": 393.15, "ring.T_e": 353.15, "ball.T": 373.15, "cage.T": 363.15}
TEMPERATURES = ("oil.T", "ring.T_i", "ring.T_e", "ball.T", "cage.T")
DIFFERENTIATED = (
    "ball[j].Q_i ball[j].Q_e ball[j].p_i ball[j].Lambda_i bearing.friction_torque bearing.clearance".split()
)
DIFFERENTIATED += (
    "loss.inlet loss.land loss.ball_drag rivet[k].P rivet[k].V rivet[k].sigma_head cage.eccentricity".split()
)
H = 1e-4  # communication step [s]


def at(core, inputs=None, parameters=None):
    """Parameters at the temperatures of the inputs; the model lives on with them."""
    model = core.model(parameters=parameters or {}, inputs=inputs or {})
    return SimpleNamespace(model=model, bearing=model.p.bearing, oil=model.p.oil, cage=model.p.cage)


def values_of(struct):
    """All parameters as the model sees them, by name."""

    def value(name):
        group, member = name.replace("[j]", "").replace("[k]", "").replace("[n]", "").split(".")
        found = getattr(
            getattr(struct, group), member + "_" if hasattr(getattr(struct, group), member + "_") else member
        )
        return list(found) if PARAMETERS[name].count > 1 else found

    return {name: value(name) for name in PARAMETERS}


# ----------------------------------------------------------------------------------------------------------- parameters


def test_start_values_change_no_bit(core):
    """At the start values of all temperatures each parameter is the variable table's, not the last bit different."""
    model = core.model(parameters=FREE_OF_GROWTH)
    for name, value in values_of(model.p).items():
        if name not in FREE_OF_GROWTH | TWO_HALF:
            np.testing.assert_array_equal(value, PARAMETERS[name].start, err_msg=name)


def test_heated_rings_and_balls(core):
    """Clearance by hand: 11.7e-6 (64.6200 x 60 - 42.3800 x 100 - 2 x 11.1125 x 80) mm/K = 11.7e-6 (-2138.8) mm: 15.00
    um less 25.024 um.
    """
    p = at(core, HOT)
    assert p.bearing.P_d == pytest.approx(-10.02396e-6, rel=1e-5)
    assert p.bearing.D == pytest.approx(11.1125e-3 + 10.4013e-6, rel=1e-8)
    assert p.bearing.d_m == pytest.approx(53.5e-3 + 0.5 * 11.7e-6 * (3.8772 + 4.238), rel=1e-9)
    # the groove grows with its ring
    assert p.bearing.f_i * p.bearing.D == pytest.approx(0.515 * 11.1125e-3 * (1.0 + 11.7e-4), rel=1e-12)
    assert p.bearing.f_e * p.bearing.D == pytest.approx(0.52 * 11.1125e-3 * (1.0 + 7.02e-4), rel=1e-12)
    assert p.bearing.rho * p.bearing.D**3 == pytest.approx(7800.0 * 11.1125e-3**3, rel=1e-12)  # the ball's mass stays


def test_one_temperature_for_all_steel_scales_the_bearing(core):
    """Rings and balls 100 K warmer together: every length grows by 1.17e-3, clearance included."""
    warm = at(core, dict.fromkeys(("ring.T_i", "ring.T_e", "ball.T"), 393.15))
    for name in ("D", "d_m", "P_d"):
        assert getattr(warm.bearing, name) == pytest.approx(PARAMETERS[f"bearing.{name}"].start * 1.00117, rel=1e-10)
    assert (warm.bearing.f_i, warm.bearing.f_e) == pytest.approx((0.515, 0.52), rel=1e-15)


def test_clearances_of_the_cage(core):
    """By hand: the pocket's 11.3125 mm grow by 17.5e-6 x 70 = 1.225e-3, the ball by 0.936e-3; the land's 59.7 mm by
    0.702e-3, the cage's 59.5 by 1.225e-3.
    """
    p = at(core, HOT)
    assert p.cage.pocket_clearance == pytest.approx((0.2 + 11.3125 * 1.225e-3 - 11.1125 * 0.936e-3) * 1e-3, rel=1e-9)
    assert p.cage.guide_clearance == pytest.approx((0.2 + 59.7 * 0.702e-3 - 59.5 * 1.225e-3) * 1e-3, rel=1e-9)


def test_rivets_get_the_temperature_of_the_cage(core):
    """Fit: a bronze hole grows by 5.5e-6/K x 1.5 mm more than the steel rivet, 0.5775 um in 70 K; preload by k_stack
    5.5e-6/K x 3 mm.
    """
    cold, hot = (core.model(inputs=u) for u in ({}, {"cage.T": 363.15}))
    assert hot.d.hole_gap[0] - cold.d.hole_gap[0] == pytest.approx(0.5775e-6, rel=1e-6)
    assert hot.d.P[0] - cold.d.P[0] == pytest.approx(70.0 * default_table().joint["k_stack"] * 5.5e-6 * 3e-3, rel=1e-9)
    assert core.model(inputs={"cage.T": 250.0}).d.P[0] == 0.0


# ------------------------------------------------------------------------------------------------------------------ oil


def test_viscosity_over_temperature(core):
    """MIL-PRF-23699 at 80 degC: 7.607 mm2/s (test_heat_network.py, by hand) of 900 (1 - 7.5e-4 (353.15 - 359.0006))
    kg/m3; at 40 and 100 degC 25 and 5.
    """
    for T, nu in ((313.15, 25e-6), (353.15, 7.607e-6), (373.15, 5e-6)):
        p, rho = at(core, {"oil.T": T}), 900.0 * (1.0 - 7.5e-4 * (T - 359.0006))
        assert p.oil.rho == pytest.approx(rho, rel=1e-12)
        assert p.oil.eta == pytest.approx(rho * nu, rel=1e-4)


@pytest.mark.parametrize("T", [300.0, 340.0, 420.0])
def test_beta_is_the_slope_of_the_viscosity(core, T):
    """oil.beta at T: its value at the start temperature times the ratio of the law's slopes, by differences of
    ln(eta/rho).
    """

    def slope(T):
        below, above = (at(core, {"oil.T": T + h}) for h in (-0.01, 0.01))
        return -np.log(above.oil.eta / above.oil.rho * below.oil.rho / below.oil.eta) / 0.02

    assert at(core, {"oil.T": T}).oil.beta == pytest.approx(0.022 * slope(T) / slope(359.0006), rel=1e-6)


def test_pressure_coefficient_over_temperature(core):
    """Ester aviation oil of Jones et al. (1975): 12.8, 9.87, 8.51 1/GPa at 38, 99, 149 degC; the first and the last
    give the slope, the one between is a test.

    The law's straight line of ln(alpha) lies 3.6 % above it.
    """
    alpha = [
        at(core, {"oil.T": T}, {"oil.T_0": 311.15, "oil.alpha": 12.8e-9}).oil.alpha for T in (311.15, 372.15, 422.15)
    ]
    assert alpha == pytest.approx([12.8e-9, 9.87e-9, 8.51e-9], rel=0.04)
    assert alpha[2] == pytest.approx(8.51e-9, rel=5e-3)


MEASURED = {  # eta [mPa.s] and alpha [1/GPa] of oils at 30, 60 and 100 degC
    "light machine oil": (45.0, 12.0, 3.9, 28.0, 20.0, 16.0),
    "heavy machine oil": (153.0, 34.0, 9.1, 23.7, 20.5, 15.8),
    "heavy machine oil 2": (250.0, 50.5, 12.6, 25.0, 21.3, 17.6),
    "heavy machine oil 3": (122.0, 26.3, 7.3, 27.0, 21.6, 17.5),
    "cylinder oil": (810.0, 135.0, 26.8, 34.0, 28.0, 22.0),
    "spindle oil": (18.6, 6.3, 2.4, 20.0, 16.0, 13.0),
    "medicinal white oil": (107.0, 23.3, 6.4, 29.6, 22.8, 17.8),
}


@pytest.mark.parametrize("name", MEASURED)
def test_measured_oils(core, name):
    """Cameron, Principles of Lubrication, as in Stachowiak & Batchelor, Engineering Tribology, table 2.3: the values at
    30 and 100 degC give those at 60.

    Observed: viscosity within 2.5 %, pressure coefficient within 6 %, of the light machine oil 10 %.
    """
    eta_1, eta, eta_2, alpha_1, alpha, alpha_2 = MEASURED[name]
    T_1, T, T_2 = 303.15, 333.15, 373.15
    rho = 870.0 * (1.0 - 7.5e-4 * (T_2 - T_1))
    oil = {
        "oil.T_0": T_1,
        "oil.rho": 870.0,
        "oil.nu_1": 1e-3 * eta_1 / 870.0,
        "oil.T_1": T_1,
        "oil.nu_2": 1e-3 * eta_2 / rho,
        "oil.T_2": T_2,
    }
    oil |= {"oil.alpha": 1e-9 * alpha_1, "oil.alpha_T": np.log(alpha_1 / alpha_2) / (T_2 - T_1)}
    p = at(core, {"oil.T": T}, oil)
    assert p.oil.eta == pytest.approx(1e-3 * eta, rel=0.03)
    assert p.oil.alpha == pytest.approx(1e-9 * alpha, rel=0.11)


def test_a_given_viscosity_replaces_the_law_at_its_temperature(core):
    """oil.eta holds at oil.T_0 and follows the law's ratio from there; another oil's points decide alone while oil.eta
    has its start value.
    """

    def eta(T, **parameters):
        return at(core, {"oil.T": T}, {name.replace("__", "."): value for name, value in parameters.items()}).oil.eta

    given = {"oil__eta": 3.24e-3, "oil__T_0": 394.0}
    assert eta(394.0, **given) == 3.24e-3
    assert eta(350.0, **given) == pytest.approx(
        3.24e-3 * eta(350.0, oil__T_0=394.0) / eta(394.0, oil__T_0=394.0), rel=1e-12
    )
    vg_100 = {"oil__nu_1": 100e-6, "oil__nu_2": 11.1e-6}
    assert eta(313.15, **vg_100) == pytest.approx(900.0 * (1.0 + 7.5e-4 * 45.8506) * 100e-6, rel=1e-6)
    assert eta(359.0006, oil__eta=0.02, **vg_100) == 0.02


# --------------------------------------------------------------------------------------------------------------- forces


def test_heat_closes_the_bearing(core):
    """A ball pressed between the races of a centred ring: the sum of both approaches at rest is the diametral
    interference/2 of the hot bearing.
    """
    model = core.model(inputs=HOT | {"shaft.F_x": 0.0, "shaft.F_y": 0.0, "shaft.omega": 0.0})
    model.start()
    delta = np.array(list(model.work.delta_i))[:9] + np.array(list(model.work.delta_e))[:9]
    assert delta == pytest.approx(np.full(9, 5.01198e-6), rel=1e-3)


# ------------------------------------------------------------------------------------------------------------ interface


def started(folder, **changes):
    return Slave(folder).initialize(**{name.replace(".", "__"): value for name, value in changes.items()})


@pytest.mark.c_only
@pytest.mark.parametrize(
    ("inputs", "reason"),
    [
        ({"oil.T": 610.0}, "oil.T = 610 K is not allowed"),
        ({"oil.T": 205.0}, "oil.T = 205 K, .*: there oil.eta = "),
        ({"cage.T": 600.0}, "ring.T_e = 293.15 K, .*, cage.T = 600 K: there cage.guide_clearance = "),
        ({"cage.T": 151.0, "ball.T": 560.0}, "ball.T = 560 K, cage.T = 151 K: there cage.pocket_clearance = "),
        (
            {"ring.T_i": 600.0, "ring.T_e": 250.0, "ball.T": 400.0},
            "ring.T_i = 600 K, ring.T_e = 250 K, ball.T = 400 K, .*: there bearing.P_d = ",
        ),
    ],
)
def test_temperatures_that_the_bearing_does_not_bear(folder, inputs, reason):
    """Refused at the start and in a run, where the step is not begun; the reference names the same input."""
    tight = {"cage.pocket_clearance": 2e-5}
    slave = Slave(folder)
    slave.set("cage.pocket_clearance", 2e-5)
    slave.check("SetupExperiment", 0, 0.0, 0.0, 0, 0.0)
    statuses = [slave.try_set(name, value) for name, value in inputs.items()]
    statuses.append(slave.call("EnterInitializationMode"))
    statuses.append(slave.call("ExitInitializationMode"))
    assert ERROR in statuses and any(re.search(reason, message) for _, _, message in slave.messages), slave.messages
    running = started(folder, **tight)
    statuses = [running.try_set(name, value) for name, value in inputs.items()] + [running.call("DoStep", 0.0, H, 1)]
    assert ERROR in statuses and any(re.search(reason, message) for _, _, message in running.messages)
    with pytest.raises(ValueError, match=reason.split(" ")[0]):
        Model.of(tight, inputs)


# --------------------------------------------------------------------------------------------------------- during a run


def heating(t):
    """Temperatures that jump at 0.2 ms: the inner ring and the balls heat, the cage cools, the oil heats."""
    return {"ring.T_i": 313.15, "ball.T": 303.15, "cage.T": 283.15, "oil.T": 380.0} if t > 1.5e-4 else {}


@pytest.mark.c_only
def test_both_twins_follow_a_jump(folder):
    """FMU and reference over 0.4 ms with temperatures that change at a communication point: forces and clearances
    alike, the balance of energy closed.

    The jump of the clearance by 15 um changes the elastic energy by some 0.1 J; booked as work of the expansion it
    leaves the residual where it was.
    """
    slave = Slave(folder).initialize(tolerance=4e-8, scene__cage=int(CageModel.TWO_HALF))
    names = ["bearing.clearance", "ball[1].Q_i", "ball[2].Q_e", "ring.y", "rivet[1].P", "bearing.energy_residual"]
    rows = []
    for i in range(4):
        for name, value in heating(i * H).items():
            slave.set(name, value)
        rows.append(slave.step(H).get(*names))
    rows, twin = np.array(rows), simulate(TWO_HALF, heating, t_end=4 * H, step=H, tolerance=4e-8)
    expected = np.stack([twin[name][1:] for name in names], axis=1)
    np.testing.assert_allclose(rows[:, :5], expected[:, :5], rtol=2e-4)  # observed 5e-5: the integrators' errors
    # the growth of a warmer ring
    assert rows[0, 0] - rows[2, 0] == pytest.approx(11.7e-6 * (42.38e-3 * 20.0 + 22.225e-3 * 10.0), rel=1e-4)
    loss = slave.get("bearing.power_loss")[0] * H
    assert np.abs(rows[:, 5]).max() < 1e-3 * loss and np.abs(expected[:, 5]).max() < 1e-3 * loss


@pytest.mark.c_only
def test_temperatures_go_with_the_saved_state(folder):
    """A run goes on bit by bit from a state saved between two changes of temperature, in another instance."""
    slave = started(folder).step(H, 3)
    slave.set("ring.T_i", 310.0)
    slave.step(H, 2)
    data, time = slave.bytes(slave.save()), slave.time
    other = Slave(folder)
    status, state = other.try_load(data)
    assert status == 0
    other.restore(state, time)
    for each in (slave, other):
        each.set("cage.T", 300.0)
        each.step(H, 3)
    assert slave.outputs().tobytes() == other.outputs().tobytes()
    assert slave.get("bearing.clearance")[0] < 15e-6


@pytest.mark.c_only
def test_temperatures_that_stay_cost_nothing(folder):
    """The same temperature set again changes no bit; a change costs two evaluations beyond the integrator's own."""
    plain, again = started(folder), started(folder)
    plain.step(H, 5)
    for _ in range(5):
        for name in TEMPERATURES:
            again.set(name, INPUTS[name].start)
        again.step(H)
    assert plain.outputs().tobytes() == again.outputs().tobytes()


@pytest.mark.c_only
def test_a_ramp_acts_from_communication_point_to_communication_point(folder):
    """A temperature with a derivative: the step runs at its first value, the outputs at its end show what it has
    reached.
    """
    slave = started(folder, scene__growth=1)
    slave.check("SetRealInputDerivatives", [slave.vr["ring.T_e"]], 1, [1], [1e4])
    slave.step(H)
    assert slave.get("ring.T_e")[0] == pytest.approx(294.15, rel=1e-12)
    assert slave.get("bearing.clearance")[0] == pytest.approx(15e-6 + 11.7e-6 * 64.62e-3, rel=1e-9)
    stepwise = started(folder, scene__growth=1).step(H)
    stepwise.set("ring.T_e", 294.15)
    for each in (slave, stepwise):
        each.step(H)
    assert slave.get("ring.y")[0] == pytest.approx(stepwise.get("ring.y")[0], rel=1e-9)


@pytest.mark.c_only
@pytest.mark.parametrize("kind", [CageModel.TWO_HALF, CageModel.ELASTIC])
@pytest.mark.parametrize("name", TEMPERATURES)
def test_directional_derivatives(core, name, kind):
    """Derivatives by each temperature against central differences of the reference's outputs over +-0.02 K at the same
    state, to 1e-3 of each output's largest.

    The differences are over a shorter step than those of the core by 20, their own error is (0.02 K 1 um/K/10 um)^2:
    4e-6.  At a fit of 1 um (with the swell) the holes bear, and their stiffness changes with the cage's temperature.
    """
    parameters = {"scene.lubrication": 2, "cage.pocket_clearance": 5e-5, "joint.fit": -3e-6, "scene.cage": int(kind)}
    bearing = Instance(core, parameters, {})
    for i in range(5):
        bearing.step((i + 1) * H)
    direction, state, out = core.new("Inputs"), np.zeros(len(bearing.y)), core.new("Outputs")
    core.set_values(direction, INPUTS, {name: 1.0})
    core.lib.part_directional_derivatives(bearing.bearing, direction, core.array(state), out)

    def beside(change):
        model, w = Model.of(parameters, {name: INPUTS[name].start + change}), Work()
        return outputs(model, w, bearing.y, rhs(model, bearing.time, bearing.y, w), 0.0)

    below, above = beside(-0.02), beside(0.02)
    compared = 0
    for output in DIFFERENTIATED:
        group, member = output.replace("[j]", "").replace("[k]", "").split(".")
        found = getattr(getattr(out, group), member)
        expected = np.atleast_1d((above[output] - below[output]) / 0.04)
        atol = 1e-3 * np.abs(expected).max() + 1e-8 * np.abs(above[output]).max()
        np.testing.assert_allclose(
            np.atleast_1d(list(found) if "[" in output else found), expected, rtol=0.0, atol=atol, err_msg=output
        )
        compared += np.abs(expected).max() > 0.0
    assert compared >= 3
