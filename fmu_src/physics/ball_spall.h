// Spalls on balls: the turn of a ball, and the forces on ball and rings while a spall meets a race.
//
//           ___                     k      rolling axis of the ball, across t and across the mean of the normals
//         /  |  \  spall            chi    angle of the spall's middle from the outer contact about k
//        |   |chi|                  chi_e = chi, chi_i = chi + pi - g: angles from the contacts
//        |   o   |--- t             g      azimuth of the ball about the inner ring less that about the outer ring
//         \     /
//          \___/                    d chi/dt = k.(omega_ball - Omega_e) - (a_e.k) phi_e'
//        inner race                 dg/dt    = (phi_i' + a_i.Omega_i) - (phi_e' + a_e.Omega_e)
//
// phi' = t.(v_ball - v_ring - Omega x p)/r: rate of the ball's azimuth on a ring, r its distance from the ring's axis a.
// With rings in their places d chi/dt is the ball's speed about k against its orbit; a spall meets the outer race once a
// turn and the inner race half a turn later.  The ball has this one angle: a spall stays in the track, for a ball that
// pivots about the normal is not followed.
//
// The drop f(R chi) and the strips are those of race_surface.h, R_x of each race.  With the energy U of a contact and
// P = -dU/dchi = Q_ball df/dchi, Q_ball the load of the strips over the ball's spall:
//
//   ball          moment P k
//   outer race    force -P (a_e.k) t/r on the ball
//   inner race    force -P t/r on the ball, moment on the inner ring -(p x F) - P a_i.  The remainder, P (k - a_i) and
//                 P (1 - a_e.k) t/r_e, which is 0 without contact angle, comes from the outer ring.
//
// Power on the ball and on both rings together is P dchi_i/dt or P dchi_e/dt exactly, so that energy and momentum are
// closed.  Without contact angle a force on a ring passes through its axis, as on any surface of revolution.  Damping
// counts the drop as part of the approach: P grows as Q does.
#pragma once

#include "physics/race_normal.h"
#include "physics/traction.h"

// Turn of a packet of balls: rolling axis, a_e.k; cos and sin of the angles from the contacts with inner and outer race, their rates.
typedef struct {
    vec k;
    wide along, cosine[2], sine[2], rate[2];
} BallRoll;

// angle: chi; turned: angle of the inner ring less that of the outer ring, from where the angles on the races count.
INLINE BallRoll ball_roll(const BallMotion *ball, const SurfacePlace *i, const SurfacePlace *e, wide angle,
                          scalar turned)
{
    const vec across = vec_cross(vec_sub(e->n, i->n), e->t);
    BallRoll out = {.k = vec_scale(1.0 / wide_sqrt(vec_dot(across, across) + 1e-30), across)};
    out.along = vec_dot(e->a, out.k);
    const wide phi_i = vec_dot(i->t, surface_approach(ball, i)) / i->r,
               phi_e = vec_dot(e->t, surface_approach(ball, e)) / e->r;
    out.rate[1] = vec_dot(out.k, vec_sub(ball->omega, e->Omega)) - out.along * phi_e;
    out.rate[0] = out.rate[1] - (phi_i + i->s - (phi_e + e->s));

    // exp(i g), of the angles on the races and of the rings'
    wide sine, cosine;
    wide_sincos(wide_set(turned), &sine, &cosine);
    const wide c = wide_fma(i->cos_phi, e->cos_phi, i->sin_phi * e->sin_phi),
               s = wide_fma(i->sin_phi, e->cos_phi, -(i->cos_phi * e->sin_phi));
    const wide cos_g = wide_fma(c, cosine, -(s * sine)), sin_g = wide_fma(s, cosine, c * sine);
    wide_sincos(angle, &out.sine[1], &out.cosine[1]);
    out.cosine[0] = -wide_fma(out.cosine[1], cos_g, out.sine[1] * sin_g);
    out.sine[0] = -wide_fma(out.sine[1], cos_g, -(out.cosine[1] * sin_g));
    return out;
}

// Adds the moments P on a packet of balls by their spalls, and the forces that go with them, to the tractions T.
INLINE void add_ball_spalls(const BallRoll *roll, const SurfacePlace *i, const SurfacePlace *e, wide P_i,
                            wide P_e, Tangential *T_i, Tangential *T_e)
{
    const wide beside = P_i - (P_i + P_e) * roll->along;
    T_i->F_c = vec_axpy(-P_i / i->r, i->t, T_i->F_c);
    T_e->F_c = vec_axpy(beside / e->r, e->t, T_e->F_c);
    T_i->M = vec_axpy(P_i, i->a, T_i->M);
    T_e->M = vec_axpy(-P_i, i->a, vec_axpy(P_i + P_e, roll->k, T_e->M));
}

// Angles chi of a packet of balls; those of the start where no ball has turned yet.
INLINE wide ball_angles(const Model *model, int j)
{
    ball_array angle = {0};
    for (int i = j; i < j + LANE_WIDTH && i < Z; i++)
        angle[i] = model->turn ? model->turn->angle[i] : model->p->ball.spall_angle[i];
    return wide_load(&angle[j]);
}
