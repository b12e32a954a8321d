"""Every input of `info` acts, or `info` names it."""

from dataclasses import replace

import numpy as np
import pytest
from commands import typed

from bearing_model.generated import variables
from riveted_bearing.bearing.bearing_file import bearing_case
from riveted_bearing.cli.info_tables import cells, without_effect
from riveted_bearing.show.spectrum import expected_lines

ACTS = dict.fromkeys(("housing.x", "housing.y", "housing.z"), 1e-05)
ACTS |= dict.fromkeys(("housing.tilt_y", "housing.tilt_z", "shaft.tilt_y", "shaft.tilt_z"), 0.001)
ACTS |= dict.fromkeys(("housing.omega", "frame.omega", "shaft.omega"), 200.0)
ACTS |= dict.fromkeys(("frame.a_x", "frame.a_y", "frame.a_z", "gravity.y", "gravity.z"), 900.0)
ACTS |= dict.fromkeys(("impact.F_r", "impact.F_a", "shaft.F_x", "shaft.F_y", "shaft.F_z"), 300.0)
COLD = dict.fromkeys(("ring.T_i", "ring.T_e", "ball.T", "cage.T"), 293.15)
ACTS |= dict.fromkeys(("ring.T_i", "ring.T_e", "ball.T", "cage.T", "oil.T"), 330.0)
ACTS |= {"shaft.interference": 2e-5, "housing.interference": 2e-5}


@pytest.fixture(scope="module")
def case():
    return bearing_case("6205")


@pytest.mark.parametrize("name", ACTS)
def test_input_acts(case, name):
    assert cells(replace(case, values=case.values | {name: ACTS[name]})) != cells(case)


def test_all_other_inputs_are_named(case):
    """A walk over the inputs: each that is not in ACTS is a rate, a moment or a place of a ring that its load moves."""
    others = {
        name: 0.5 * v.max if v.max else 1.0 for name, v in variables.INPUTS.items() if v.count == 1 and name not in ACTS
    }
    idle = without_effect(case, others)
    for name in others:
        assert name in idle or cells(replace(case, values=case.values | {name: others[name]})) != cells(case)
    assert {"shaft.v_y", "housing.v_x", "housing.tilt_y_dot"} <= set(idle)


def test_command_names_what_does_not_act(tmp_path):
    file = tmp_path / "own.toml"
    file.write_text('designation = "6205"\n[inputs]\nshaft.v_y = 0.1\nhousing.omega = "3000 rev/min"\n')
    output = typed("info", file).output
    assert "without effect here: shaft.v_y\n" in output


def test_gravity_loads_ring_and_balls(case):
    """The outer race carries the loads of shaft and ring and the weight of the balls that it holds."""
    heavy = replace(case, values=case.values | {"shaft.omega": 0.0, "gravity.y": 1000.0})
    state = heavy.equilibrium()
    carried = float(state.Q_e @ (np.cos(state.psi) * np.cos(state.alpha_e)))
    loaded = (state.Q_i > 0.0) | (state.Q_e > 0.0)
    ring = case.values["shaft.F_y"] + 1000.0 * case.values["ring.m"]
    assert state.F[1] == pytest.approx(ring, rel=1e-6)
    weight = 1000.0 * case.bearing.ball_mass * float(np.sum(np.cos(state.psi[loaded]) ** 2))
    assert carried == pytest.approx(ring + weight, rel=1e-3)


def test_angle_of_the_mounted_bearing():
    """6311 C3: P_d = 33 um, 2.49 um left by a fit of 40 um, cos(alpha) = 1 - P_d/(2 A); 0 with no clearance left."""
    case, angles = bearing_case("6311"), []
    for fit in (0.0, 20e-6, 40e-6, 60e-6):
        values = case.values | COLD | {"bearing.P_d": 33e-6, "shaft.interference": fit}
        angles.append(np.degrees(replace(case, values=values).bearing.free_contact_angle()))
    assert angles == pytest.approx([12.27, 8.99, 3.36, 0.0], abs=0.01)


def test_file_of_catalogue_values_takes_the_rule(tmp_path):
    """Balls of the 61904 follow from its ratings; without them the file is told what it lacks, not the 6207's sizes."""
    lines = ["[catalogue]", 'bore = "20 mm"', 'outside_diameter = "37 mm"', 'width = "9 mm"', 'C = "6.37 kN"']
    file = tmp_path / "own.toml"
    file.write_text("\n".join([*lines, 'C_0 = "3.65 kN"']))
    assert bearing_case(file).values["bearing.d_m"] == pytest.approx(28.5e-3)
    file.write_text("\n".join(lines))
    refused = typed("info", file).output
    assert "catalogue.C_0" in refused
    assert "53.5" not in refused


def test_no_two_lines_of_one_frequency():
    """Side bands of the ring that turns; a shaft at rest has none."""
    kinematic = {"shaft": 0.0, "housing": 50.0, "FTF": 30.2, "BSF": 116.1, "BPFO": 178.6, "BPFI": 271.4}
    lines = dict(expected_lines(kinematic))
    assert (lines["BPFO - housing"], lines["BPFO + housing"]) == pytest.approx((128.6, 228.6))
    assert not any("shaft" in name for name in lines)
    assert len(set(np.round(list(lines.values()), 6))) == len(lines)
