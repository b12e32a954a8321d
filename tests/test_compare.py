"""`riveted-bearing compare`: the same scene through FMU and reference, and that a difference between them would be
seen.
"""

import zipfile
from dataclasses import replace

import numpy as np
import pytest
from commands import typed

from bearing_model.generated.variables import OUTPUTS
from riveted_bearing.base.errors import UserError
from riveted_bearing.base.variable_list import variable_of
from riveted_bearing.building.compare import Statistic, compare, is_motion, through_reference
from riveted_bearing.running.fmu import Model
from riveted_bearing.running.scene import load_scene
from riveted_bearing.show.plot import plot_comparison


@pytest.fixture(scope="module")
def found(model):
    """A scene in which balls press on the cage from the start and a load jumps."""
    inputs = {"shaft.F_y": {"t": [0, 5e-5], "value": [2994.0, 2500.0], "interpolation": "hold"}}
    parameters = {"scene.cage": "two_half", "solver.tol": 4e-4, "start.spacing": 0.5, "cage.pocket_clearance": 2e-5}
    return compare(
        model,
        load_scene(None, model, ("the test", {"inputs": inputs, "parameters": parameters})),
        short=1e-4,
        long=0.0,
    )


def test_difference_falls_with_the_tolerance(found):
    """Motion stays within 100 tolerances (observed 0.07), loads and stresses within 1000 (observed 19: a contact of 1e8
    N/m tells 10 um x tolerance by newtons), and both fall by 50 when the tolerance falls by 1e4 (observed 68: contacts
    have kinks, which two trajectories do not meet at one time): what is left belongs to the integration, not to the
    models.  5e-5 is nothing.
    """
    for channel in found.channels:
        assert channel.worst[0] < (100.0 if is_motion(channel) else 1000.0) * found.tolerances[0], channel.name
        assert channel.worst[-1] < max(2e-2 * channel.worst[0], 5e-5), channel.name
    assert max(channel.worst[0] for channel in found.channels) > 1e-6
    assert np.max(np.abs({channel.name: channel for channel in found.channels}["ball[j].Q_c"].reference)) > 1.0


def test_all_outputs_but_peaks_are_compared(found):
    """Every output of the variable table that belongs to an instant."""
    missing = {
        name
        for name, variable in OUTPUTS.items()
        if variable.group not in ("peak", "event", "stat", "solver", "fatigue")
    }
    missing -= {channel.name for channel in found.channels}
    assert missing == {"rivet[k].flag", "bearing.contacts", "bearing.energy_residual"}
    for channel in found.channels:
        assert channel.reference.shape[0] == len(found.t) == channel.error.shape[1] == 21
        assert channel.scale > 0.0


def test_a_wrong_coefficient_shows(model, monkeypatch):
    """A reference with one per mille more stiffness: the difference no longer falls with the tolerance."""
    import riveted_bearing.building.compare as module

    monkeypatch.setattr(
        module,
        "through_reference",
        lambda parameters, *rest: through_reference(parameters | {"bearing.E": 1.001 * 207e9}, *rest),
    )
    wrong = compare(model, load_scene("demo", model), short=2e-5, long=0.0)
    ring = next(channel for channel in wrong.channels if channel.name == "ring.y")
    assert ring.worst[-1] == pytest.approx(ring.worst[0], rel=0.1)
    assert ring.worst[-1] > 1e-4


def test_statistics_and_ledger(model, tmp_path):
    """Over a long horizon, here as short as can be: each of stat.* beside the FMU's scatter, where the energy went, and
    a picture of it all.
    """
    seen = []
    scene = replace(load_scene("demo", model, ("the test", {"parameters": {"scene.cage": "two_half"}})), step=5e-4)
    full = compare(model, scene, short=2e-5, long=1e-3, seeds=2, progress=lambda what, share: seen.append(what))
    assert {"stat.Q_c_mean", "stat.sigma_head_p999", "stat.cage_omega"} <= {row.name for row in full.statistics}
    omega = next(row for row in full.statistics if row.name == "stat.cage_omega")
    assert omega.reference == pytest.approx(omega.mean, rel=1e-3)
    assert full.settle == pytest.approx(2e-4)
    assert abs(full.ledger.residual[-1]) < 1e-3 * full.ledger.supplied["shaft torque"][-1]
    assert len(set(seen)) == 3
    path = plot_comparison(full, tmp_path / "compare.png")
    assert path.stat().st_size > 20_000


def test_deviation_in_scatters():
    row = Statistic("stat.x", "N", 1.2, 1.0, 0.1)
    assert (row.difference, row.deviation) == pytest.approx((0.2, 2.0))
    assert np.isnan(Statistic("stat.x", "N", 1.0, 1.0, 0.0).deviation)


def test_names():
    assert [variable_of(name).name for name in ("ball[12].Q_i", "rivet[3].N", "rivet.sigma_head_max", "ring.x")] == [
        "ball[j].Q_i", "rivet[k].N", "rivet.sigma_head_max", "ring.x",
    ]  # fmt: skip


def test_the_tolerance_is_the_scenes(model):
    """A tolerance of the simulation takes the place of solver.tol, as in the FMU; each is that of the first of three
    runs.
    """
    settings = {"parameters": {"scene.cage": "two_half", "solver.tol": 3e-4}}
    assert compare(model, load_scene("demo", model, ("test", settings)), short=1e-5, long=0.0).tolerances[0] == 3e-4
    settings["simulation"] = {"tolerance": 2e-3}
    assert compare(model, load_scene("demo", model, ("test", settings)), short=1e-5, long=0.0).tolerances[0] == 2e-3


def test_refusals(model, monkeypatch):
    """What cannot be compared is said by name."""
    scene = load_scene("demo", model)
    with pytest.raises(UserError, match="seeds = 1"):
        compare(model, scene, seeds=1)
    with pytest.raises(UserError, match="reference: method = 'Euler'"):
        compare(model, scene, short=1e-5, long=0.0, method="Euler")
    monkeypatch.setattr("riveted_bearing.building.compare.variables.Z", 8)
    with pytest.raises(UserError, match=r"bearing.Z = 9: .* Z = 8"):
        compare(model, scene)


def test_an_fmu_of_another_bearing_needs_its_own_reference(model, tmp_path):
    """Nine balls alone do not make it the 6207; without its build folder the way to one is said."""
    path = tmp_path / "mine.fmu"
    with zipfile.ZipFile(model.path) as old, zipfile.ZipFile(path, "w") as new:
        for member in old.infolist():
            data = old.read(member)
            if member.filename == "modelDescription.xml":
                data = data.replace(model.description.guid.encode(), b"{0000}")
            new.writestr(member, data)
    other = Model(path)
    with pytest.raises(UserError, match="takes this FMU's own one"):
        compare(other, load_scene("demo", other))
    refused = typed("compare --fmu", path)
    assert refused.exit_code == 2 and f"riveted-bearing build --bearing FILE --out {path}" in refused.stderr


def test_command(tmp_path):
    """As a user starts it."""
    for scene, name in (("demo", "demo"), ("", "RivetedBearing")):
        done = typed(f'compare {scene} --short "20 us" --long 0 --out', tmp_path)
        assert done.exit_code == 0, done.output
        assert "ball[j].Q_i" in done.stdout and "F_x 515 N, F_y 2994 N" in done.stdout
        assert (tmp_path / f"{name}_compare.png").is_file()
    refused = typed("compare demo --short fast")
    assert refused.exit_code == 2
    assert "--short = 'fast'" in refused.stderr
