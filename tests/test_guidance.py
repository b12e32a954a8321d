"""A cage that balls guide: no film, no contact and no event at the outer ring, in equations, solver and outputs; it rides on its pockets."""

import numpy as np
import pytest
from mechanics import Instance, Z, running_state
from ribbon import RIBBON

from bearing_model import simulate
from bearing_model.generated.variables import CAGE_V_X, N_STATES, RING_V_X

BALLS = {"cage.guidance": 2}
G = 9.81


def test_no_land(core):
    """Evaluation and linear solve: the halves feel the drag alone, whose moment is about the axis; the films' matrix is none."""
    m = core.model(parameters=BALLS)
    y = running_state(m, np.random.default_rng(1))
    m.rhs(0.0, y)
    w = m.work
    assert w.land_dissipated == 0.0 and w.land_elastic == 0.0
    assert all(getattr(film, name) == 0.0 for film in w.film for name in ("yy", "yz", "zz", "spin"))
    v = np.random.default_rng(2).normal(size=N_STATES)
    cage = slice(CAGE_V_X.start, RING_V_X.start)
    guided = core.model()
    guided.rhs(0.0, y)
    assert np.array_equal(m.implicit("implicit_stiff_part", 1e-5, v)[cage], np.zeros(12))
    assert np.abs(guided.implicit("implicit_stiff_part", 1e-5, v)[cage]).max() > 1e-3


def test_drilled_pockets_do_not_guide(core):
    """A run of a machined cage that balls should guide is refused, in C and Python."""
    with pytest.raises(ValueError, match="cage.guidance = 2: outer .1. is allowed for a machined cage"):
        Instance(core, BALLS)
    with pytest.raises(ValueError, match="cage.guidance = 2: outer .1. is allowed for a machined cage"):
        simulate(BALLS, t_end=1e-6)


def test_outputs(core):
    """No loss, no contact event, eccentricity of the pockets' clearance, with the cage beyond the guide clearance."""
    instance = Instance(core, RIBBON | {"cage.guide_clearance": 1e-5, "gravity.y": -300.0})
    instance.step(0.02)
    assert instance.output("loss.land") == 0.0 and instance.output("event.land_contact") == 0.0
    y, z = instance.output("cage.y"), instance.output("cage.z")
    assert np.hypot(y, z) > 2e-5
    assert instance.output("cage.eccentricity") == pytest.approx(np.hypot(y, z) / 1e-4, rel=1e-6)


def test_a_cage_at_standstill_hangs_on_its_balls(core):
    """Weight of both halves = mean vertical force of the pockets, over the second half of 0.1 s in which the cage comes to rest."""
    parameters = RIBBON | {"gravity.y": -G, "start.settle": 0.0}
    instance = Instance(core, parameters, {"shaft.omega": 0.0})
    model = core.model(parameters, {"shaft.omega": 0.0})
    force = []
    for i in range(2000):
        y = instance.step((i + 1) * 5e-5).y
        if i >= 1000:
            model.rhs(0.0, y)
            force.append(sum(sum(list(model.work.pocket[h].half_F_y)[:Z]) for h in range(2)))
    weight = 2.0 * model.p.cage.m * G
    # impacts that ring down, with a standard deviation of 1.3 weights: samples every 0.5 ms would scatter by 16 %
    assert np.mean(force) == pytest.approx(weight, rel=0.1)
    assert 0.1 < instance.output("cage.eccentricity") < 1.5


def test_a_run_at_speed_stays_in_its_pockets(core):
    """20 ms at the working point, under unbalance and tilt: finite, within its clearances, energy closed to 1 % of the dissipated work."""
    for inputs, more in (({}, {}), ({}, {"cage.unbalance": 1e-5}), ({"shaft.tilt_z": 2e-3}, {})):
        instance = Instance(core, RIBBON | more | {"start.settle": 0.0}, inputs)
        for i in range(200):
            instance.step((i + 1) * 1e-4)
        assert instance.output("cage.eccentricity") < 2.0
        assert np.all(np.isfinite(instance.y))
