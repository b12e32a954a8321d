// The preload of a ribbon's joints under the centrifugal load.
//
// The ring's hoop force bends each land of a ribbon and pries at its rivet.  The joint's law has no load for this; so the
// preload that the law gets is not P + w, w = dP omega^2 of the load path, but s S(tau), s = P + w, tau = w/s, with S from
// direct contact of lands that are all alike (rivet_model/land_bending.py), by Catmull-Rom splines.  Machined halves: P + w.
#pragma once

#include "rivet/rivet_rom.h"

// s S(tau) - s: preload that the bending adds to P + w.
INLINE scalar spin_bending(const CageHalfData *half, scalar P, scalar w)
{
    const double last = half->spin_steps - 2.0;
    const scalar s = P + w;
    if (!(scalar_value(s) > 0.0)) return 0.0 * s;
    const scalar x = w / s * (last + 1.0);
    const int i = (int)fmin(fmax(scalar_value(x), 0.0), last), n = half->spin_steps;
    const scalar t = x - i;
    const double *S = half->spin_preload, here = S[i], there = S[i + 1];
    const double before = i > 0 ? S[i - 1] : 2.0 * here - there;
    const double beyond = i + 2 < n ? S[i + 2] : 2.0 * there - here;
    const scalar at = 0.5 * t * (t * (2.0 - t) - 1.0) * before +
                      0.5 * (t * t * (3.0 * t - 5.0) + 2.0) * here +
                      0.5 * t * (t * (4.0 - 3.0 * t) + 1.0) * there + 0.5 * t * t * (t - 1.0) * beyond;
    return s * (at - 1.0);
}
