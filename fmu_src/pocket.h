// Contact of the balls with the cage pockets.  Equations in pocket.c.
#pragma once

#include "isa.h"
#include "model.h"

// Share w of one half in the energy of a contact, by the axial part n_x of the contact's normal.
// side: -1 for half 0, +1 for half 1.
INLINE wide pocket_share(double side, wide n_x, double width)
{
    return 0.5 * (1.0 + side * n_x * (1.0 / wide_sqrt(n_x * n_x + width * width)));
}

// dw/dn_x.
INLINE wide pocket_share_slope(double side, wide n_x, double width)
{
    const wide inv_root = 1.0 / wide_sqrt(n_x * n_x + width * width);
    return 0.5 * side * (width * width) * (inv_root * inv_root * inv_root);
}

// Adds to the balls' forces, moments, rates and dissipation; sets the wrench on both halves.
void pocket_force(const Model *model, Work *w);
