// Energy of balls, cage halves and everything elastic between them and the rings.
//
//   contacts  (2/5) K delta^2.5, shared between the halves as in pocket.c
//   joint     T^2/(2 k_rivet) + N_plate^2/(2 k_plate) + k z^2/2 + hole contact
//
// The inner ring is outside this balance: its motion puts the power -F.v - M.Omega into balls and cage, with
// F and M of the contacts on the ring, and its growth the power -K delta^1.5 n.e dR_g/dt, (race_contact.c).
// The energy is for outputs only; the integration does not use it.
#include "instance/energy.h"

#include "cage/common/pocket.h"
#include "cage/elastic/elastic_half.h"
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

// Elastic energy of the race contacts and the pockets.
static scalar contact_energy(const Model *model, const Work *w)
{
    const Derived *d = model->d;
    const wide K_i = wide_set(d->inner.hertz.K), K_e = wide_set(d->outer.hertz.K), K = wide_set(d->pocket.K);
    ball_array stored;
    for (int j = 0; j < PACKETS * LANE_WIDTH; j += LANE_WIDTH) {
        wide E = hertz_energy(K_i, wide_load(&w->delta_i[j])) + hertz_energy(K_e, wide_load(&w->delta_e[j]));
        for (int h = 0; h < 2; h++) {
            PocketGap gap = pocket_gap(d, w, &w->half[h], j);
            if (model->elastic) gap.delta = wide_load(&w->delta_c[h][j]);
            const wide whole = hertz_energy(K, gap.delta);
            E += pocket_share(d, h, gap.n_x, gap.delta).energy * whole;
            if (model->elastic) {  // in the wall, beside its modes
                const wide Q = pocket_share(d, h, gap.n_x, gap.delta).load * hertz_load(K, gap.delta);
                E += (0.5 * model->elastic->compliance) * Q * Q;
            }
        }
        wide_store(&stored[j], E);
    }
    return ball_array_sum(stored);
}

// Elastic energy of joint k: rivet, plates, friction states, hole contact.
static scalar joint_energy(const Model *model, const scalar *y, const Work *w, int k)
{
    const Derived *d = model->d;
    const scalar z_y = y[Y_JOINT_PLATE_Y + k], z_z = y[Y_JOINT_PLATE_Z + k], h_y = y[Y_JOINT_HEAD_Y + k];
    const scalar h_z = y[Y_JOINT_HEAD_Z + k];
    const scalar bearing =
        scalar_max(0.0, scalar_sqrt(w->u_y[k] * w->u_y[k] + w->u_z[k] * w->u_z[k]) - d->hole_gap[k]);
    if (model->elastic) {
        const double k_in = model->elastic->series, k_hole = model->elastic->k_hole[k];
        return 0.5 * (k_in * d->k_plate_t * (z_y * z_y + z_z * z_z) +
                      k_in * d->k_head * (h_y * h_y + h_z * h_z) + k_hole * bearing * bearing);
    }
    return 0.5 * (w->T[k] * w->T[k] / d->k_rivet + w->N_plate[k] * w->N_plate[k] / d->k_plate +
                  d->k_plate_t * (z_y * z_y + z_z * z_z) + d->k_head * (h_y * h_y + h_z * h_z) +
                  d->k_hole[k] * bearing * bearing);
}

scalar energy_total(const Model *model, const scalar *y, const Work *w)
{
    const Parameters *p = model->p;
    scalar E = w->land_elastic + contact_energy(model, w);
    if (model->elastic) E += w->modes_energy + elastic_potential(w);
    for (int j = 0; j < Z; j++) {
        E += ball_energy(model, y, j);
        E += joint_energy(model, y, w, j);
    }
    for (int h = 0; h < 2; h++) {
        const Rotor *half = &w->half[h];
        scalar v[3];
        cross3(half->Omega, half->c, v);
        for (int i = 0; i < 3; i++) v[i] += half->v[i];  // of the centre of mass
        E += 0.5 * (p->cage.m * dot3(v, v) + model->d->J_t * dot3(half->a_dot, half->a_dot) +
                    model->d->J_p * half->s * half->s);
    }
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
            if (delta > 0.0) E[i] += 0.4 * d->inner.hertz.K * delta * delta * sqrt(delta);
        }
    }
    return E[1] - E[0];
}
#endif
