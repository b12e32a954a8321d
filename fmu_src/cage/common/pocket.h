// Contact of the balls with the cage pockets.  Equations in pocket.c.
#pragma once

#include "cage/common/pocket_forces.h"
#include "physics/hertz.h"

// Contacts of all pockets of two rigid or two elastic halves: add to the balls' forces, moments, rates and dissipation, set
// the wrench on both halves.
void pocket_rigid(const Model *model, Work *w);
void pocket_elastic(const Model *model, Work *w);

// Where a packet of balls is in the pockets of a half.
typedef struct {
    PocketAxes axes;
    wide inv_S;     // 1 / distance of the ball from the pocket's axis
    wide n_x, n_t;  // direction from this axis to the ball
    wide delta;     // elastic approach (negative: the pocket is open)
} PocketGap;

INLINE PocketGap pocket_gap(const Derived *d, const Work *w, const Rotor *half, int j)
{
    PocketGap gap = {.axes = pocket_axes(d, w, half, j)};
    const wide x = vec_dot(gap.axes.p, gap.axes.a), t = vec_dot(gap.axes.p, gap.axes.e_t);
    const wide S = wide_sqrt(x * x + t * t + 1e-30);  // 1e-30 gives a centred ball a direction
    gap.inv_S = 1.0 / S, gap.n_x = x * gap.inv_S, gap.n_t = t * gap.inv_S;
    gap.delta = S - (wide_load(&d->R_c[j]) - wide_load(&d->R[j]));
    return gap;
}

// Parts of the load (w) and of the energy (e) of a contact that belong to one half, and de/dn_x.
typedef struct {
    wide load, energy, slope;
} PocketShare;

INLINE PocketShare pocket_share(const Derived *d, int h, wide n_x, wide delta)
{
    const wide one = wide_set(1.0), a = d->pocket.a_delta * wide_sqrt(wide_max(delta, wide_set(1e-30)));
    const wide inv_a = d->pocket_radius / a, q = wide_min(inv_a, one), q_2 = q * q, q_5 = q_2 * q_2 * q;
    const wide xi_n = (h == 0 ? -1.0 : 1.0) * wide_max(inv_a, one);
    const wide xi = wide_max(wide_min(xi_n * n_x, one), -one), xi_2 = xi * xi, rest = 1.0 - xi_2;
    const wide load = 0.5 + xi * (0.75 - 0.25 * xi_2);
    const wide energy = 0.5 + xi * (15.0 / 16.0 - xi_2 * (0.625 - 3.0 / 16.0 * xi_2));
    return (PocketShare){.load = load,
                         .energy = energy * q_5 + load * (1.0 - q_5),
                         .slope =
                             (15.0 / 16.0 * rest * rest * xi_n) * q_5 + (0.75 * rest * xi_n) * (1.0 - q_5)};
}

// Force across n: dV/dn_x grad n_x, grad n_x = (n_t a - n_x e_t) n_t/S.
INLINE wide pocket_across(const Derived *d, const PocketGap *gap, wide slope)
{
    return hertz_energy(wide_set(d->pocket.K), gap->delta) * slope * gap->n_t * gap->inv_S;
}
