"""The preload of a ribbon's joints under the centrifugal load.

The ring's hoop force bends each land of a ribbon and pries at its rivet.  The joint's law has no load for this; so the preload that the law
gets is not P + w, w = dP omega^2 of the load path, but s S(tau), s = P + w, tau = w/s, with S from direct contact of lands that are all
alike (rivet_model/land_bending.py), by Catmull-Rom splines.  Machined halves: P + w.
"""

import numpy as np


def spin_bending(half, P, w):
    """s S(tau) - s [N], the addition of the bending to P + w [N]; 0 of a machined half (rivet_table.HalfData)."""
    S = half.spin_preload
    if len(S) == 0:
        return 0.0
    s, last = P + w, len(S) - 1
    turning = np.real(s) > 0.0
    x = np.where(turning, w / np.where(turning, s, 1.0), 0.0) * last
    i = np.clip(np.real(x), 0.0, last - 1.0).astype(int)
    t = x - i
    values = np.concatenate([[2.0 * S[0] - S[1]], S, [2.0 * S[-1] - S[-2]]])
    before, here, there, beyond = (values[i + n] for n in range(4))
    at = (
        0.5 * t * (t * (2.0 - t) - 1.0) * before
        + 0.5 * (t * t * (3.0 * t - 5.0) + 2.0) * here
        + 0.5 * t * (t * (4.0 - 3.0 * t) + 1.0) * there
        + 0.5 * t * t * (t - 1.0) * beyond
    )
    return np.where(turning, s * (at - 1.0), 0.0)
