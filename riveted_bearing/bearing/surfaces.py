"""Measured profiles of races as waves."""

from typing import Any

import numpy as np

from bearing_model.generated.variables import PARAMETERS

from ..base.errors import UserError

MOST_TURNS = 1.1  # of a profile, whose ends may overlap
ORDERS = PARAMETERS["outer.waviness[n]"].count


def waves_of(angle: Any, height: Any) -> Any:
    """Amplitudes [m] and phases [rad] of the orders 1 ... 60 from heights [m] over angles [rad] of one turn.

    h(phi) = h_0 + sum A_n cos(n phi + phase_n) by least squares, so that the angles need not be even.  UserError unless
    the profile goes once around with at least three points a wave of the highest order.

    >>> phi = np.linspace(0.0, 2.0 * np.pi, 400, endpoint=False)
    >>> amplitude, phase = waves_of(phi, 1e-6 * np.cos(9 * phi + 0.5))
    >>> print(f"{amplitude[8]:.3g} m, {phase[8]:.3g} rad")
    1e-06 m, 0.5 rad
    """
    angle, height = np.asarray(angle, dtype=float), np.asarray(height, dtype=float)
    if not (np.all(np.isfinite(angle)) and np.all(np.isfinite(height))):
        raise UserError("angles and heights must be finite numbers")
    if len(angle) < 3 * ORDERS:
        raise UserError(f"{len(angle)} points; at least {3 * ORDERS} are needed, three a wave of order {ORDERS}")
    if (turns := np.ptp(angle) / (2.0 * np.pi)) > MOST_TURNS:
        raise UserError(f"angles of {turns:.3g} turns; one is allowed: angles without a unit are in rad")
    gaps = np.diff(
        np.sort(np.remainder(angle, 2.0 * np.pi)), append=np.remainder(angle, 2.0 * np.pi).min() + 2.0 * np.pi
    )
    if gaps.max() > np.pi / ORDERS:
        raise UserError(
            f"a gap of {np.degrees(gaps.max()):.3g} deg; the profile must go once around with gaps of at most "
            f"{180.0 / ORDERS:g} deg, half a wave of order {ORDERS}"
        )
    n = np.arange(1, ORDERS + 1)
    columns = np.hstack([np.ones((len(angle), 1)), np.cos(np.outer(angle, n)), np.sin(np.outer(angle, n))])
    found = np.linalg.lstsq(columns, height, rcond=None)[0]
    cosine, sine = found[1 : ORDERS + 1], found[ORDERS + 1 :]
    return np.hypot(cosine, sine), np.arctan2(-sine, cosine)
