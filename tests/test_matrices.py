"""riveted-bearing matrices: stiffness by the equilibrium against differences of its loads and against the FMU's
response; what ROSS reads.
"""

import tomllib
from dataclasses import replace

import numpy as np
import pytest
from commands import typed

from bearing_model.quasi_static import Bearing, Load, quasi_static
from riveted_bearing import UserError
from riveted_bearing.running.fmu import Model
from riveted_bearing.running.scene import load_scene
from riveted_bearing.running.scene_case import scene_case
from riveted_bearing.studies.matrices import (
    DIRECTIONS,
    Matrices,
    equilibrium,
    response,
    ross_coefficients,
    write_ross,
    write_table,
)

OMEGA = 1909.9


@pytest.fixture(scope="module")
def case(fmu):
    model = Model(fmu)
    return (
        model,
        scene_case("demo", model),
        load_scene("demo", model, ("the test", {"parameters": {"scene.cage": "two_half"}})),
    )


def test_stiffness_is_the_loads_derivative(case):
    """K of the mean over azimuths inverts the displacement by small changes of load: 1 %, the spread of the balls'
    azimuths.
    """
    _, bearing_case, _ = case
    q, K = equilibrium(bearing_case, 1.0, OMEGA)
    more, _ = equilibrium(bearing_case, 1.01, OMEGA)
    dF = 0.01 * np.array([515.0, 2994.0, 0.0])
    assert K[:3, :3] @ (more - q)[:3] == pytest.approx(dF, abs=0.01 * np.linalg.norm(dF))
    assert pytest.approx(K.T, abs=1e-6 * np.abs(K).max()) == K


def test_response_of_the_fmu(case, record_property):
    """The FMU's dynamics shaken at 300 Hz, column by column: stiffness as by the equilibrium, 5 % of the geometric mean
    of the diagonals; observed 3 %.

    Far below the balls' own frequencies on their races the response is quasi-static; damping is a small part of it.
    Mean of eight seeds: impacts of the cage scatter the noisiest entry of one by 4.5 %.
    """
    model, bearing_case, scene = case
    seeds = [replace(scene, parameters=scene.parameters | {"start.seed": seed}) for seed in range(1, 9)]
    q, K = equilibrium(bearing_case, 1.0, OMEGA)
    w = 2.0 * np.pi * 300.0
    size = np.array([1.0, 1.0, 1.0, 40.0, 40.0]) * 0.5e-6
    H = np.mean(
        [np.array([response(model, scene, OMEGA, q, k, size[k], w) for k in range(5)]).T for scene in seeds], axis=0
    )
    scale = np.sqrt(np.outer(np.diag(K), np.diag(K)))
    record_property("largest", float(np.abs((H.real - K) / scale).max()))
    assert H.real / scale == pytest.approx(K / scale, abs=0.05)
    assert np.abs(H.imag / scale).max() < 0.05


def test_the_response_has_the_scenes_tolerance(case):
    """A response at the FMU's own tolerance and at the scene's of 1e-5 differ by the errors of the steps."""
    model, bearing_case, scene = case
    q, w = equilibrium(bearing_case, 1.0, OMEGA)[0], 2.0 * np.pi * 300.0
    own, finer = (response(model, replace(scene, tolerance=tol), OMEGA, q, 1, 0.5e-6, w) for tol in (None, 1e-5))
    assert not np.array_equal(own, finer) and own[1] == pytest.approx(finer[1], rel=0.1)


def test_files(case, tmp_path):
    """The table has all entries in their order; ROSS' axes (x, y lateral, z axial) are our (Y, Z, X)."""
    K = np.arange(25.0).reshape(5, 5)
    found = [Matrices(omega, 1.0, omega, np.zeros(5), K, K + omega, 0.1 * K) for omega in (100.0, 200.0)]
    basis, header, *rows = write_table(found, tmp_path / "m.csv", [("speed", "6000 rev/min")]).read_text().splitlines()
    assert basis == "# speed: 6000 rev/min"
    columns = header.split(",")
    values = dict(zip(columns, map(float, rows[1].split(",")), strict=True))
    assert values["omega [rad/s]"] == 200.0
    for i, a in enumerate(DIRECTIONS):
        for k, b in enumerate(DIRECTIONS):
            assert values[f"K_static[{a}.{b}]"] == K[i, k]
            assert values[f"C[{a}.{b}]"] == pytest.approx(0.1 * K[i, k])
    table = ross_coefficients(found)
    assert table["kxx"] == [K[1, 1] + 100.0, K[1, 1] + 200.0]
    assert table["kxy"] == [K[1, 2] + 100.0, K[1, 2] + 200.0]
    assert table["czz"] == [0.0, 0.0] == [0.1 * K[0, 0]] * 2
    (name, element), *rest = tomllib.loads(
        write_ross(found, tmp_path / "b.toml", node=3, tag="front").read_text()
    ).items()
    assert (name, element["n"], element["speed"]) == ("BearingElement_front", 3, [100.0, 200.0])
    assert element["kyx"] == table["kyx"]
    assert not rest
    text = write_ross(found, tmp_path / "b2.toml", version=2).read_text()
    assert tomllib.loads(text)["BearingElement_bearing"]["frequency"] == [100.0, 200.0]
    assert "speed" not in text


def test_ross_table_over_speed_and_whirl(tmp_path):
    """ROSS 3's tables are [speed][frequency]; ROSS 2 has none."""
    found = [
        Matrices(w, 1.0, f, np.zeros(5), np.eye(5), (w + 10.0 * f) * np.eye(5), np.eye(5))
        for f in (7.0, 8.0)
        for w in (1.0, 2.0, 3.0)
    ]
    element = tomllib.loads(write_ross(found, tmp_path / "g.toml").read_text())["BearingElement_bearing"]
    assert (element["speed"], element["frequency"]) == ([1.0, 2.0, 3.0], [7.0, 8.0])
    assert element["kxx"] == [[71.0, 81.0], [72.0, 82.0], [73.0, 83.0]]
    with pytest.raises(UserError, match="ROSS 2 has no tables"):
        write_ross(found, tmp_path / "g2.toml", version=2)


def test_the_command(fmu, tmp_path):
    """Speeds with units, load factors, a picture and a file for ROSS; a wrong unit is refused by name."""
    line = 'matrices demo --static --speed "6000 rev/min" --load 0.5 --load 1 --load 1'
    result = typed(line, "--fmu", fmu, "--out", tmp_path)
    assert result.exit_code == 0, result.output
    assert {path.name for path in tmp_path.iterdir()} == {
        "demo_matrices.csv",
        "demo_matrices.png",
        "demo_ross2_0.5.toml",
        "demo_ross2_1.toml",
        "demo_ross_0.5.toml",
        "demo_ross_1.toml",
    }
    assert "F_x 257.5 to 515 N, F_y 1497 to 2994 N" in result.output
    assert (
        "# loads: F_x 257.5 to 515 N, F_y 1497 to 2994 N\n# speed: 6000 rev/min\n"
        in (tmp_path / "demo_matrices.csv").read_text()
    )
    element = tomllib.loads((tmp_path / "demo_ross_1.toml").read_text())["BearingElement_demo"]
    # at one azimuth of the balls; over a pitch it moves by 2 %
    K = quasi_static(Bearing(), Load(F_x=515.0, F_y=2994.0, omega=6000.0 * np.pi / 30.0)).K
    assert element["kxx"][0] == pytest.approx(K[1, 1], rel=0.03)
    refused = typed(f'{line} --speed "3 m"', "--fmu", fmu, "--out", tmp_path)
    assert refused.exit_code == 2
