"""Viscosity over temperature, and the example of a thermal network around the FMU."""

import sys

import fmpy
import numpy as np
import pytest
from library import ROOT

from bearing_model.physics.viscosity import Oil

sys.path.insert(0, str(ROOT / "examples" / "heat"))
import network


def test_two_points_and_a_third():
    """The two points come back, and between them lies the straight line of the ASTM chart, at 80 degC by hand.

    lg lg(25.7) = 0.14920, lg lg(5.7) = -0.12155: B = 3.5563, lg lg(nu + 0.7) at 353.15 K = -0.03646: nu = 7.607 mm2/s.
    """
    oil = Oil(25e-6, 313.15, 5e-6, 373.15)
    assert [oil.nu(313.15), oil.nu(373.15)] == pytest.approx([25e-6, 5e-6], rel=1e-12)
    assert oil.nu(353.15) == pytest.approx(7.607e-6, rel=1e-4)


@pytest.mark.parametrize("T", [290.0, 330.0, 400.0])
def test_slope(T):
    """beta against a central difference of the viscosity."""
    oil, h = Oil(100e-6, 313.15, 11.1e-6, 373.15), 1e-3
    assert oil.beta(T) == pytest.approx(-np.log(oil.nu(T + h) / oil.nu(T - h)) / (2.0 * h), rel=1e-8)


def test_refused():
    with pytest.raises(ValueError, match="fall with temperature"):
        Oil(5e-6, 313.15, 25e-6, 373.15)


def test_network_reaches_its_steady_state(fmu):
    """What the losses bring goes out with the oil, to shaft and housing; ten minutes step by step end there, too,
    within 1 K (observed below).
    """
    unzipped = fmpy.extract(str(fmu))
    T, P, runs = network.network(unzipped)
    out = (
        network.SHAFT * (T[0] - network.AROUND)
        + network.HOUSING * (T[1] - network.AROUND)
        + network.FLOW * (T[4] - network.SUPPLY)
    )
    assert out == pytest.approx(P.sum(), rel=1e-9)
    assert P.sum() > 50.0 and T[2] > T[4] > network.SUPPLY
    marched, _, steps = network.network(unzipped, march=True, step=30.0)
    assert np.abs(marched - T).max() < 1.0
    assert runs < steps
