"""Events: each condition just below and just above its limit, onsets counted, messages few."""

import numpy as np
import pytest
from mechanics import Instance
from ribbon import writable

from bearing_model.generated import variables
from bearing_model.physics.derived import default_table
from bearing_model.physics.hertz import hertz_contact

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
