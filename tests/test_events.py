"""Events: each condition just below and just above its limit, onsets counted, messages few."""

import numpy as np
import pytest
from mechanics import Instance
from ribbon import writable

from bearing_model import simulate
from bearing_model.generated import variables
from bearing_model.instance.events import energy_off
from bearing_model.physics.derived import default_table
from bearing_model.physics.hertz import hertz_contact
from bearing_model.physics.model import Model, Work
from bearing_model.physics.rhs import rhs
from bearing_model.solver.escape import escape_find

REST = {"shaft.omega": 0.0, "shaft.F_x": 0.0}  # nothing tilts the balls' plane
TABLE = default_table()
KINDS = (
    "LAND_CONTACT",
    "POCKET_EXIT",
    "ELLIPSE_CUT",
    "OVERPRESSURE",
    "JOINT_OPEN",
    "RIVET_YIELD",
    "CAGE_YIELD",
    "MOTION_LAG",
    "ENERGY_OFF",
    "RIVET_OVERLOAD",
)
NEAR = 1e-6  # relative distance from a limit, far above rounding


@pytest.fixture
def resting(core):
    """Balls at rest on the outer race, the cage about its place: a step of 1 ns leaves all positions to 1e-13 m."""

    def place(changes, parameters=None):
        """changes: state block -> values added to it."""
        instance = Instance(core, parameters or {}, REST).step(1e-9)
        y = np.frombuffer(core.ffi.buffer(core.lib.part_state(instance.bearing), 8 * variables.N_STATES))
        for block, values in changes.items():
            y[getattr(variables, block)] += values
        return instance

    return place


def test_land_touches_where_its_eccentricity_exceeds_the_clearance(resting):
    """Halves displaced by 0.1 mm, the default's radial clearance: each counts by itself."""
    clearance = 0.5 * variables.PARAMETERS["cage.guide_clearance"].start
    for factors, halves in (((1.0 - NEAR, 1.0 - NEAR), 0), ((1.0 + NEAR, 0.5), 1), ((1.0 + NEAR, 1.1), 2)):
        instance = resting({"CAGE_Y": clearance * np.array(factors)})
        assert instance.output("event.land_contact") == halves


def test_ball_leaves_the_cages_section(resting):
    """The outer edge D_o/2 is passed by 1 nm, or not; the balls rest at r = d_m/2 + P_d/4 and nearly there."""
    outer = 0.5 * variables.PARAMETERS["cage.D_o"].start
    evenly = {"start.spacing": 0.0}
    r = resting({}, evenly).y[variables.BALL_R]
    for beyond, balls in ((-1e-9, 0), (1e-9, 3)):
        shift = np.where(np.arange(variables.Z) < 3, outer + beyond - r, 0.0)
        assert resting({"BALL_R": shift}, evenly).output("event.pocket_exit") == balls


def test_joint_opens_where_the_preload_is_used_up(resting):
    """u_x = P/k_plate: 20 N over the plates' stiffness; half 1 alone is moved, so all joints open together."""
    preload = variables.PARAMETERS["joint.preload"].start
    limit = preload / (TABLE.half.k_closed - TABLE.half.k_open)
    for factor, joints in ((1.0 - 1e-4, 0), (1.0 + 1e-4, variables.Z)):
        assert resting({"CAGE_X": [0.0, factor * limit]}).output("event.joint_open") == joints


def test_overpressure_counts_the_contacts_beyond_the_limit(core):
    """Limits between the pressures of the loaded contacts; the warning is given once and names variable, value and
    limit.
    """
    all_ = Instance(core)
    pressures = np.sort(np.concatenate([all_.output("ball.p_i"), all_.output("ball.p_e")]))[::-1]
    for n in range(1, 6):
        limit = 0.5 * (pressures[n - 1] + pressures[n])
        instance = Instance(core, {"bearing.p_limit": limit})
        assert instance.output("event.overpressure") == n
    instance.step(1e-3)
    warnings = [text for text in instance.messages if "p_limit" in text]
    assert len(warnings) == instance.output("event.overpressure_onsets") == 1
    value = float(warnings[0].split(" = ")[2].split()[0])
    assert value == pytest.approx(pressures[0], rel=1e-3)  # printed to four digits
    assert f"bearing.p_limit = {limit:.4g} Pa" in warnings[0]


def test_ellipse_is_cut_where_it_reaches_the_shoulder(core):
    """Axial load: all balls alike at the angle alpha; the ellipse by Hertz' formula from catalogue geometry, the
    shoulder just below and above.
    """
    inputs = {"shaft.omega": 0.0, "shaft.F_y": 0.0, "shaft.F_x": 5000.0}
    instance = Instance(core, {}, inputs)
    D, d_m, f = (variables.PARAMETERS[f"bearing.{name}"].start for name in ("D", "d_m", "f_i"))
    Q, alpha = instance.output("ball.Q_i")[0], instance.output("ball.alpha_i")[0]
    E_star = 0.5 * 207e9 / (1.0 - 0.3**2)
    contact = hertz_contact(2.0 / D / (1.0 - D / d_m), 2.0 / D - 1.0 / (f * D), E_star)
    reach = alpha + contact.a * np.cbrt(Q) * 0.5 * (2.0 / D + 1.0 / (f * D))
    height = f * (1.0 - np.cos(reach))
    for factor, balls in ((1.0 - 1e-4, variables.Z), (1.0 + 1e-4, 0)):
        assert (
            Instance(core, {"bearing.h_i": height * factor, "bearing.h_e": 0.5}, inputs).output("event.ellipse_cut")
            == balls
        )
    assert 0.2 < reach < 1.2


def test_rivets_yield_under_too_much_preload(core):
    """The head stress is proportional to the preload where nothing else acts (rigid halves, balls free): yield stress
    at a preload found from that.
    """
    light = Instance(core, {"joint.preload": 100.0, "scene.cage": 1}, REST | {"shaft.F_y": 0.0})
    at_yield = 100.0 * TABLE.yield_rivet / light.output("rivet.sigma_head_max")
    for factor, rivets in ((0.99, 0), (1.01, variables.Z)):
        instance = Instance(core, {"joint.preload": factor * at_yield, "scene.cage": 1}, REST | {"shaft.F_y": 0.0})
        assert instance.output("event.rivet_yield") == rivets
        assert sum("yields" in text for text in instance.messages) == (rivets > 0)


def test_cage_yields_under_the_force_of_its_table(core):
    """A force just below and just above the largest of a step, put into the table as a ribbon's; the machined half's has
    none, and no event.
    """
    instance = Instance(core).step(5e-3)
    peak, half = instance.output("cage.F_pocket_peak"), core.lib.rivet_table.half
    assert peak > 1.0 and instance.output("event.cage_yield") == 0
    writable(core, core.ffi.addressof(half), core.ffi.sizeof("CageHalfData"))
    try:
        for factor, yields in ((1.0 + NEAR, 0), (1.0 - NEAR, 1)):
            half.yield_force = factor * peak
            instance = Instance(core).step(5e-3)
            assert instance.output("event.cage_yield") == instance.output("event.cage_yield_onsets") == yields
            assert sum("the cage yields" in text for text in instance.messages) == yields
    finally:
        half.yield_force = 0.0


def test_rivets_tear_beyond_their_tensile_strength(core):
    """The middle stress of the start just below and above the strength; the warning is given once."""
    stress = Instance(core).output("rivet.sigma_mid_max")
    for factor, tears in ((1.0 + NEAR, False), (1.0 - NEAR, True)):
        instance = Instance(core, {"fatigue.sigma_m": factor * stress})
        assert (instance.output("event.rivet_overload") > 0) == tears
        assert sum("would tear" in text for text in instance.messages) == tears


@pytest.mark.parametrize(
    ("balance", "limit"),
    [
        ((10.0, 10.0, 100.0), 2.0),  # 2 % of what is lost
        ((100.0, 10.0, 100.0), 2.0),
        ((300.0, 10.0, 100.0), 3.0),  # 1 % of what the bearing holds
        ((10.0, 1000.0, 100.0), 4.0),  # 0.4 % of what the shaft has exchanged
        ((10.0, 10.0, 0.0), 0.1),  # at rest
    ],
)
def test_energy_is_off_beyond_its_limit(core, balance, limit):
    """Energies in J that are held, exchanged and lost; in C and Python."""
    for sign in (-1.0, 1.0):
        for factor, off in ((1.0 - NEAR, 0), (1.0 + NEAR, 1)):
            residual = sign * factor * limit
            found = core.lib.event_of_energy(residual, *balance, 5.0, 0.0)
            assert found.count == energy_off(residual, *balance, 5.0) == off
    found = core.lib.event_of_energy(0.0, *balance, -1e-9, 0.0)
    assert found.count == energy_off(0.0, *balance, -1e-9) == 1


def test_a_run_whose_energy_is_off_says_so(core):
    """Work that is missing in the balance by a little less than 1 % of the energy that the bearing holds, which is more than
    2 % of the loss of a millisecond, and by more; the warning is given once.
    """
    for share, off in ((0.0095, 0), (0.0105, 1)):
        instance = Instance(core).step(1e-3)
        residual = instance.output("bearing.energy_residual")
        assert instance.output("event.energy_off_onsets") == 0.0
        state = np.frombuffer(core.ffi.buffer(core.lib.part_state(instance.bearing), 8 * variables.N_STATES))
        state[variables.WORK] += residual - share * instance.output("bearing.energy")
        instance.step(1e-3 + 1e-9).step(1e-3 + 2e-9)
        assert instance.output("event.energy_off") == instance.output("event.energy_off_onsets") == off
        assert sum("energy_residual" in text for text in instance.messages) == off


@pytest.mark.parametrize("cage", variables.CageModel)
def test_steps_that_are_too_long_are_seen_by_their_energy(core, cage):
    """Fixed steps five times the default's gain 1e4 J within a millisecond."""
    instance = Instance(core, {"scene.cage": cage, "solver.method": 3, "solver.step": 5e-5})
    with pytest.raises(ArithmeticError):
        list(map(instance.step, 1e-4 * np.arange(1, 31)))
    assert any("bearing.energy_residual" in text for text in instance.messages)


REACH = {
    name: variables.PARAMETERS[name].start
    for name in ("cage.D_o", "cage.D_i", "cage.guide_clearance", "cage.pocket_clearance", "bearing.D")
}
ACROSS = 0.5 * REACH["cage.guide_clearance"] + 0.25 * (REACH["cage.D_o"] - REACH["cage.D_i"])


@pytest.mark.parametrize("method", variables.Method)
def test_a_cage_that_leaves_the_bearing_ends_the_run(resting, method):
    """A half a little less far off than its clearance and its section allow, and farther: the run ends with its reason, and
    time and outputs are those of the last good state.
    """
    parameters = {"solver.method": method, "solver.step": 1e-6}
    instance = resting({"CAGE_Y": [0.0, (1.0 - 1e-4) * ACROSS]}, parameters).step(2e-9)
    instance = resting({"CAGE_Y": [0.0, (1.0 + 1e-4) * ACROSS]}, parameters)
    with pytest.raises(ArithmeticError, match="t = 1e-09 s: cage half 2 leaves the bearing: it is 0.00255 m off"):
        instance.step(2e-9)
    assert instance.time == 1e-9 and np.isfinite(instance.output("cage.eccentricity"))


def test_bodies_that_pass_through_each_other(core):
    """Ball against race, pocket and neighbour, just short of the limit and beyond; the twin gives the same reasons."""
    D, clearance = REACH["bearing.D"], REACH["cage.pocket_clearance"]
    parameters = {"scene.cage": 1, "start.spacing": 0.0}
    c, model, w = core.model(parameters, REST), Model.of(parameters, REST), Work()
    start = Instance(core, parameters, REST).y
    c.rhs(0.0, start)
    r = start[variables.BALL_R][3]
    touching = 2.0 * np.arcsin(0.5 * D / r)  # angle between two balls
    cases = [
        (variables.BALL_R, 0.25 * D - c.work.delta_e[3], "ball[4] passes through its outer race"),
        (variables.BALL_THETA, np.arcsin((0.25 * D + 0.5 * clearance) / r), "ball[4] passes through its pocket"),
        (variables.BALL_THETA, 2.0 * np.pi / variables.Z - touching, "ball[4] and ball[5] overlap"),
    ]
    for block, shift, reason in cases:
        for factor in (1.0 - 1e-3, 1.0 + 1e-3):
            y = start.copy()
            y[block][3] += factor * shift
            c.rhs(0.0, y)
            rhs(model, 0.0, y, w)
            escape, text = core.lib.escape_find(c.pointer, c.work), core.ffi.new("char[256]")
            core.lib.escape_text(core.ffi.new("Escape *", escape), text, 256)
            said = core.ffi.string(text).decode()
            assert said == escape_find(model, w)
            assert said.startswith(reason) == (factor > 1.0)


def test_the_twin_ends_a_run_that_leaves_the_bearing():
    y = simulate({"scene.cage": 1}, REST, 1e-9, step=1e-9).y[-1]
    y[variables.CAGE_Y] += 1.01 * ACROSS
    with pytest.raises(RuntimeError, match="cage half 1 leaves the bearing: it is 0.002575 m off"):
        simulate({"scene.cage": 1}, REST, 1e-9, step=1e-9, y=y)


def test_onsets_are_reported_ever_more_rarely(core):
    """1000 onsets: messages at 1, 2, 4 ... 512."""
    state, now = core.new("EventState"), core.new("Event")
    reported = []
    for n in range(2000):
        now.count = n % 2
        if core.lib.event_onset(state, core.lib.EVENT_JOINT_OPEN, now):
            reported.append(int(state.onsets[core.lib.EVENT_JOINT_OPEN]))
    assert reported == [2**i for i in range(10)]
    assert state.onsets[core.lib.EVENT_JOINT_OPEN] == 1000
    assert state.onsets[core.lib.EVENT_LAND_CONTACT] == 0


@pytest.mark.parametrize("kind", KINDS)
def test_every_message_names_value_and_limit(core, kind):
    event, text = core.new("Event"), core.ffi.new("char[256]")
    event.count, event.element, event.value, event.limit = 1, 3, 1.2345, 0.6789
    core.lib.event_text(getattr(core.lib, f"EVENT_{kind}"), event, text, 256)
    message = core.ffi.string(text).decode()
    assert "1.234" in message and "0.6789" in message
    assert len(message) < 200
