// Energy of balls, cage halves and everything elastic between them and the rings.
//
//   contacts  (2/5) K delta^2.5, shared between the halves as in pocket.c
//   cage      halves, pockets, joints and modes (cage/cage.h)
//
// The inner ring is outside this balance: its motion puts the power -F.v - M.Omega into balls and cage, with
// F and M of the contacts on the ring, and its growth the power -K delta^1.5 n.e dR_g/dt, (race_contact.c).
// The energy is for outputs only; the integration does not use it.
#include "instance/energy.h"

#include "cage/cage.h"
#include "physics/hertz.h"
#include "physics/ring_fit.h"
#include "physics/rotor.h"

// Kinetic energy of ball j.
static scalar ball_energy(const Model *model, const scalar *y, int j)
{
    const Derived *d = model->d;
    const scalar v_x = y[Y_BALL_V_X + j], v_r = y[Y_BALL_V_R + j];
    const scalar v_t = y[Y_BALL_R + j] * y[Y_BALL_OMEGA_M + j];
    const scalar o_x = y[Y_BALL_OMEGA_X + j], o_r = y[Y_BALL_OMEGA_R + j], o_t = y[Y_BALL_OMEGA_T + j];
    return 0.5 * d->m * (v_x * v_x + v_r * v_r + v_t * v_t) +
           0.5 * d->J * (o_x * o_x + o_r * o_r + o_t * o_t);
}

// Elastic energy of the race contacts.
static scalar race_energy(const Model *model, const Work *w)
{
    if (model->d->rough) return ball_array_sum(w->race_stored);
    const wide K_i = wide_set(model->d->inner.hertz.K), K_e = wide_set(model->d->outer.hertz.K);
    ball_array stored;
    for (int j = 0; j < PACKETS * LANE_WIDTH; j += LANE_WIDTH)
        wide_store(&stored[j], hertz_energy(K_i, wide_load(&w->delta_i[j])) +
                                   hertz_energy(K_e, wide_load(&w->delta_e[j])));
    return ball_array_sum(stored);
}

scalar energy_total(const Model *model, const scalar *y, const Work *w)
{
    scalar E = w->land_elastic + race_energy(model, w) + cage_energy(model, y, w);
    for (int j = 0; j < Z; j++) E += ball_energy(model, y, j);
    return E;
}

#ifndef DUAL
double energy_of_speed(const Model *model, const double *y, double before, double after)
{
    const Derived *d = model->d;
    const double growth[2] = {ring_fit_growth(&d->fit, before), ring_fit_growth(&d->fit, after)};
    if (growth[0] == growth[1]) return 0.0;
    Rotor ring;
    rotor_axis(&ring, y[Y_RING_BETA], y[Y_RING_GAMMA], 0.0, 0.0, 0.0);
    double E[2] = {0.0, 0.0};
    for (int j = 0; j < Z; j++) {
        const double r = y[Y_BALL_R + j], theta = y[Y_BALL_THETA + j];
        const double p[3] = {y[Y_BALL_X + j] - y[Y_RING_X], r * portable_cos(theta) - y[Y_RING_Y],
                             r * portable_sin(theta) - y[Y_RING_Z]};
        const double along = dot3(p, ring.a), radius = sqrt(dot3(p, p) - along * along);
        for (int i = 0; i < 2; i++) {
            const double across = radius - (d->inner.R_g + growth[i]);
            const double delta = sqrt(along * along + across * across) - (d->inner.r_g - d->R[j]);
            E[i] += hertz_stored(d->inner.hertz.K, delta);
        }
    }
    return E[1] - E[0];
}
#endif
