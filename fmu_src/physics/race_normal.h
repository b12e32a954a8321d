// Ball and race without traction: Hertz' contact of one packet of balls, its motion, and that of races and balls that are not
// perfect.  Sketch and equations in race_contact.c.
#pragma once

#include "numbers/vec.h"
#include "physics/hertz.h"
#include "physics/race_surface.h"

static const double TINY = 1e-30;  // keeps padding lanes and balls at a groove's centre from dividing by 0

// One ball, in its own frame (x, r, t).
typedef struct {
    vec x, v, omega;  // centre, velocity, angular velocity
    wide omega_m, R;
} BallMotion;

// One contact.
typedef struct {
    vec n, t_1, t_2;  // normal, rolling direction, long axis of the ellipse
    vec slip, roll;   // Delta u, U
    vec spin;         // omega_ball - Omega of the race
    vec approach;     // velocity of the ball's centre against the race there
    wide R, delta, sqrt_delta, Q, dissipated;
} Contact;

// Load of a contact with approach delta, which grows at the rate delta_dot, and the power that its damping
// dissipates.
INLINE void load_contact(const Model *model, const Race *race, wide delta, wide delta_dot, Contact *c)
{
    const wide Q_0 = hertz_load(wide_set(race->hertz.K), delta);
    c->delta = delta;
    c->sqrt_delta = wide_sqrt(wide_max(delta, wide_set(0.0)));
    c->Q = hertz_damped(Q_0, wide_set(model->p->bearing.lambda), delta_dot);
    c->dissipated = (c->Q - Q_0) * delta_dot;
}

// Slip and mean speed of a contact whose normal and approach are known, from the velocities at the contact point against
// the ball's centre, seen from the orbiting frame.
INLINE void contact_motion(const BallMotion *ball, vec Omega, Contact *c)
{
    const vec arm = vec_scale(ball->R, c->n), axis = {ball->omega_m, wide_set(0.0), wide_set(0.0)};
    const vec u_ball = vec_cross(ball->omega, arm), orbit = vec_cross(axis, arm);
    const vec u_race = vec_sub(vec_cross(Omega, arm), c->approach);  // v + Omega x (p + arm) - v_ball
    c->slip = vec_across(vec_sub(u_ball, u_race), c->n);
    c->roll =
        vec_across(vec_axpy(wide_set(-1.0), orbit, vec_scale(wide_set(0.5), vec_add(u_ball, u_race))), c->n);
}

// Place of a ball p from the centre of a ring with the axis a: distance r from it along e, L from the groove's centre along n.
typedef struct {
    vec e, n;
    wide r, L;
} GroovePlace;

INLINE GroovePlace groove_place(wide R_g, vec p, vec a)
{
    const wide along = vec_dot(p, a), tiny = wide_set(TINY);
    const vec radial = vec_axpy(-along, a, p);
    GroovePlace at = {.r = wide_sqrt(vec_dot(radial, radial) + tiny)};
    at.e = vec_scale(1.0 / at.r, radial);
    const wide across = at.r - R_g;
    at.L = wide_sqrt(along * along + across * across + tiny);
    const wide inv_L = 1.0 / at.L;
    at.n = vec_axpy(across * inv_L, at.e, vec_scale(along * inv_L, a));
    return at;
}

// One race.  R_g: present radius of the circle of groove centres; p: from the centre of the ring to that of
// the ball; a, v, Omega: axis, velocity and angular velocity of the ring.  All vectors are in the frames of the balls.
INLINE Contact race_contact(const Model *model, const Race *race, const BallMotion *ball, wide R_g, vec p,
                            vec a, vec v, vec Omega)
{
    const GroovePlace at = groove_place(R_g, p, a);
    Contact c = {.R = ball->R, .n = at.n, .t_1 = vec_cross(a, at.e)};
    c.t_2 = vec_cross(c.n, c.t_1);
    c.approach = vec_sub(vec_sub(ball->v, v), vec_cross(Omega, p));
    c.spin = vec_sub(ball->omega, Omega);
    load_contact(model, race, at.L - (race->r_g - ball->R), vec_dot(c.n, c.approach), &c);
    contact_motion(ball, Omega, &c);
    return c;
}

// Outer race of a ring at rest in its place: the same, without the terms that vanish there.
INLINE Contact outer_contact_at_rest(const Model *model, const BallMotion *ball)
{
    const Race *race = &model->d->outer;
    const vec v = ball->v, omega = ball->omega;
    const wide R = ball->R, across = ball->x.r - race->R_g;
    const wide L = wide_sqrt(ball->x.x * ball->x.x + across * across + wide_set(TINY)), inv_L = 1.0 / L;
    Contact c = {.R = R,
                 .n = {ball->x.x * inv_L, across * inv_L, wide_set(0.0)},
                 .t_1 = {wide_set(0.0), wide_set(0.0), wide_set(1.0)}};
    c.t_2 = (vec){c.n.r, -c.n.x, wide_set(0.0)};
    c.approach = v;
    c.spin = omega;
    load_contact(model, race, L - (race->r_g - R), c.n.x * v.x + c.n.r * v.r, &c);

    // velocities at the contact point, likewise; orbit is along t
    const vec u_ball = {-omega.t * R * c.n.r, omega.t * R * c.n.x, R * (omega.x * c.n.r - omega.r * c.n.x)};
    const wide orbit = ball->omega_m * R * c.n.r;
    c.slip = vec_across(vec_add(u_ball, v), c.n);
    c.roll = vec_across((vec){0.5 * (u_ball.x - v.x), 0.5 * (u_ball.r - v.r), 0.5 * (u_ball.t - v.t) - orbit},
                        c.n);
    return c;
}

// Place of a packet of balls on a race that is not perfect, as in race_contact, with the rolling direction t and cos and sin
// of the angle on the race, of ring->b_y and b_z, which turn with it.
typedef struct {
    vec p, v, Omega, a, n, t;
    wide r, L, cos_phi, sin_phi, s;
} SurfacePlace;

INLINE SurfacePlace surface_place(const BallMotion *ball, wide R_g, const Rotor *ring, wide cos_theta,
                                  wide sin_theta)
{
    const vec a = vec_local(ring->a, cos_theta, sin_theta);
    const vec p = vec_sub(ball->x, vec_local(ring->x, cos_theta, sin_theta));
    const GroovePlace in = groove_place(R_g, p, a);
    SurfacePlace at = {.p = p,
                       .n = in.n,
                       .r = in.r,
                       .L = in.L,
                       .v = vec_local(ring->v, cos_theta, sin_theta),
                       .Omega = vec_local(ring->Omega, cos_theta, sin_theta),
                       .a = a,
                       .s = wide_set(ring->s)};
    at.t = vec_cross(a, in.e);
    at.cos_phi = vec_dot(in.e, vec_local(ring->b_y, cos_theta, sin_theta));
    at.sin_phi = vec_dot(in.e, vec_local(ring->b_z, cos_theta, sin_theta));
    return at;
}

// Velocity of the balls' centres against the race there.
INLINE vec surface_approach(const BallMotion *ball, const SurfacePlace *at)
{
    return vec_sub(vec_sub(ball->v, at->v), vec_cross(at->Omega, at->p));
}

// Spalls in a contact: drops of the path in the race's and in the ball's spalls, their derivatives by the angles on
// race and ball, rate of the latter.
typedef struct {
    SpallLanes race, ball;
    wide f, df, f_ball, df_ball, rate;
    bool two;  // whether balls have spalls
} SpallPlace;

// Contact there, under waves of the height w with the derivative dw.  stored: elastic energy of the contact; P: moment on
// the balls by their spalls.
INLINE Contact surface_contact(const Model *model, const Race *race, const BallMotion *ball,
                               const SurfacePlace *at, wide w, wide dw, const SpallPlace *in, wide *stored,
                               wide *P)
{
    const wide delta = at->L - (race->r_g - ball->R) + w;
    SurfaceLoad load;
    if (race->surface.spalled || in->two)
        load = race_surface_load(&race->hertz, delta, &in->race, in->f, &in->ball, in->f_ball, in->two);
    else
        load = race_whole_load(&race->hertz, delta);

    // minus the gradient of the energy, Q (n + q t), whose direction is the normal, and the moment Q m on the ball
    const wide q = (dw - load.Q_race / (load.Q + LEAST_LOAD) * in->df) / at->r,
               length = wide_sqrt(1.0 + q * q);
    const wide inv_length = 1.0 / length;
    const wide m = in->two ? load.Q_ball / (load.Q + LEAST_LOAD) * in->df_ball : wide_set(0.0);
    Contact c = {.R = ball->R,
                 .n = vec_scale(inv_length, vec_axpy(q, at->t, at->n)),
                 .t_1 = vec_scale(inv_length, vec_axpy(-q, at->n, at->t))};
    c.t_2 = vec_cross(c.n, c.t_1);
    c.approach = surface_approach(ball, at);
    c.spin = vec_sub(ball->omega, at->Omega);
    c.delta = load.delta;
    c.sqrt_delta = wide_sqrt(wide_max(load.delta, wide_set(0.0)));
    wide rate = length * vec_dot(c.n, c.approach);
    if (in->two) rate = rate - m * in->rate;
    const wide Q = hertz_damped(load.Q, wide_set(model->p->bearing.lambda), rate);
    c.dissipated = (Q - load.Q) * rate;
    c.Q = Q * length;
    *stored = load.U, *P = Q * m;
    contact_motion(ball, at->Omega, &c);
    return c;
}
