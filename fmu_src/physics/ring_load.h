// The inputs over a communication step, and the load and motion that they impose on the ring at one time.
//
//   inputs:  u(t) = u_0 + u_0' (t - t_0) + u_0'' (t - t_0)^2/2 from the communication point t_0 on
//   motions: position and velocity are one polynomial of third order, u(t) = u_0 + ... + v_0'' (t - t_0)^3/6
//            (motion_trajectory)
//   pulses:  F_r sin(pi (t - t_n)/duration) along the radial load (+Y without one) and F_a along +X,
//            t_n = t_start + n interval
//
// Forces and moments are in the bearing's frame.  Tilt is a rotation about (0, tilt_y, tilt_z): a = (cos,
// tilt_z sinc, -tilt_y sinc).  The frame's angle is the integral of frame.omega; gravity keeps its direction in
// the fixed frame.
#pragma once

#include "numbers/elementary.h"
#include "physics/model.h"

// The trajectory of the inputs u (values and derivatives at t_0) from time t up to the next edge of a pulse.
void input_trajectory_update(const Parameters *p, const Inputs u[INPUT_ORDERS + 1], double t_0, double t,
                             InputTrajectory *trajectory);

// Inputs that are a position and its velocity, by their places in Inputs.
typedef struct {
    int position, velocity;
} MotionInput;

enum { SHAFT_MOTIONS = 5, MOTIONS = 11 };  // the shaft's come first

static const double SHORTEST_MOTION = 1e-12;  // step whose rates of motion are known [s]

// A motion that misses the given one by much is led back to it within a time of its own, however short the step is: no
// shaft and no housing follows within less than the period of 10 kHz, and with 20 m/s, twice the largest velocity
// allowed, to make up in that time, the acceleration is 8e5 m/s2.
static const double CATCH_UP_TIME = 1e-4;         // at least [s]
static const double CATCH_UP_ACCELERATION = 1e6;  // at most [m/s2]

extern const MotionInput MOTION[MOTIONS];

// Motions that the host has given so far: velocities at the begin of the last communication step, their mean rates over the
// step before, the length of the last step, and how many steps there were (up to 2).
typedef struct {
    double v[MOTIONS], a[MOTIONS], h;
    int steps;
} MotionHistory;

// The motions that catch up with the given ones over more than the communication step.
typedef struct {
    int count, motion;  // how many, and the first of them by its index in MOTION
    double x, v;        // the given position and velocity of this one less those that it has
} MotionLag;

// The polynomials of a communication step of length h from the inputs that the host has given at its begin.
//
//   position and velocity at the end    X = x + v h + a h^2/2 + a' h^3/6,  V = v + a h + a' h^2/2
//                                       with the given derivatives a, a' of the velocity, or if they are 0 with
//                                       a = minmod of the velocity's mean rates over the last two steps: V has an error
//                                       of order two, and a velocity that jumps is not extrapolated
//   inside the step                     Hermite's polynomial from where the motion is (`now`, at the end of the
//                                       last step) to X, V: continuous in position and velocity
//   catching up                         where making up the mismatch x - x_now = d, v - v_now = d' within h would need
//                                       more than A = CATCH_UP_ACCELERATION, 6 |d|/h^2 + 4 |d'|/h > A, the given
//                                       polynomial plus Hermite's polynomial from -d, -d' to 0 within
//                                       T = max(CATCH_UP_TIME, (2 |d'| + (4 d'^2 + 6 A |d|)^(1/2))/A) > h
//
// A is for lengths.  Angles have A/(d_m/2); the frame's speed, whose rate makes the forces, has A/CATCH_UP_TIME over the
// frame's radius and d_m/2.  Rates estimated from the velocities are within the same limits.
//
// In steps shorter than SHORTEST_MOTION the motion goes on with the velocity that it has, because the rates above
// could overflow.  Where the motion is not given (the shaft's in free motion) it has no derivatives; where it
// is, there are no loads.  lag: the motions that are catching up.
void motion_trajectory(const Parameters *p, const Inputs given[INPUT_ORDERS + 1],
                       const MotionHistory *history, const Inputs *now, double h, Inputs u[INPUT_ORDERS + 1],
                       MotionLag *lag);

// Adds the motions that were given at the begin of a step of length h.
void motion_remember(const Inputs *given, double h, MotionHistory *history);

// Whether load or motion changes along the trajectory.
bool input_trajectory_varies(const InputTrajectory *trajectory);

// Inputs and their rates at time t.
void input_trajectory_rates_at(const InputTrajectory *trajectory, double t, Inputs *u, Inputs *u_dot);

// Angle of the frame at time t.
INLINE scalar frame_angle_at(const InputTrajectory *trajectory, scalar t)
{
    const scalar tau = t - trajectory->t_0, w = trajectory->u[0].frame.omega;
    const scalar w_1 = trajectory->u[1].frame.omega, w_2 = trajectory->u[2].frame.omega;
    const scalar w_3 = trajectory->u[2].frame.omega_dot;
    return trajectory->angle[0] + tau * (w + tau * (w_1 / 2.0 + tau * (w_2 / 6.0 + tau * w_3 / 24.0)));
}

// Angle by which a ring has turned at time t: `angle` at t_0, its speed a polynomial with the values and derivatives w there.
INLINE scalar ring_angle_at(scalar tau, scalar angle, const scalar w[3])
{
    return angle + tau * (w[0] + tau * (w[1] / 2.0 + tau * w[2] / 6.0));
}

// Angles of the inner and the outer ring at time t.
INLINE void ring_angles_at(const InputTrajectory *trajectory, scalar t, scalar *inner, scalar *outer)
{
    const Inputs *u = trajectory->u;
    const scalar shaft[3] = {u[0].shaft.omega, u[1].shaft.omega, u[2].shaft.omega};
    const scalar housing[3] = {u[0].housing.omega, u[1].housing.omega, u[2].housing.omega};
    *inner = ring_angle_at(t - trajectory->t_0, trajectory->angle[1], shaft);
    *outer = ring_angle_at(t - trajectory->t_0, trajectory->angle[2], housing);
}

// Whether a built-in pulse has begun and not ended at time t.
bool pulse_in_progress(const Parameters *p, double t);

// Next start or end of a built-in pulse after t, infinity after the last one.
double pulse_next_edge(const Parameters *p, double t);

// Replaces the pulses in the trajectory by their mean within +-half [s] of the time t: steps of a fixed length, whose
// evaluations are `2 half` apart, then have the impulse of the pulses exactly.
void pulse_average(const Parameters *p, double t, double half, InputTrajectory *trajectory);

// Angles of the rotation with the direction cosines beta, gamma.
INLINE void ring_tilts(scalar beta, scalar gamma, scalar *tilt_y, scalar *tilt_z)
{
    const scalar sine = scalar_sqrt(beta * beta + gamma * gamma);
    const scalar factor = scalar_value(sine) > 1e-8 ? scalar_asin(sine) / sine : 1.0;
    *tilt_y = beta * factor;
    *tilt_z = gamma * factor;
}

INLINE scalar scalar_sin(scalar x)
{
    wide sine, cosine;
    wide_sincos(wide_set(x), &sine, &cosine);
    return wide_lane(sine, 0);
}

// The inputs at time t: Taylor's polynomial of each.
INLINE void input_trajectory_at(const InputTrajectory *trajectory, scalar t, Inputs *u)
{
    const scalar tau = t - trajectory->t_0;
    const scalar *u_0 = (const scalar *)&trajectory->u[0], *u_1 = (const scalar *)&trajectory->u[1];
    const scalar *u_2 = (const scalar *)&trajectory->u[2];
    for (int i = 0; i < N_INPUTS; i++) ((scalar *)u)[i] = u_0[i] + tau * (u_1[i] + 0.5 * tau * u_2[i]);
    for (int i = 0; i < MOTIONS; i++)
        ((scalar *)u)[MOTION[i].position] += tau * tau * tau / 6.0 * u_2[MOTION[i].velocity];
}

// Derivative of an input at time t; u_1, u_2: its derivatives at t_0.
INLINE scalar input_rate(scalar tau, scalar u_1, scalar u_2)
{
    return u_1 + tau * u_2;
}

// Direction cosines of a tilt, their rates, and their second derivatives for small tilts.
INLINE void ring_cosines(scalar tilt_y, scalar tilt_z, scalar tilt_y_dot, scalar tilt_z_dot, scalar *beta,
                         scalar *gamma, scalar *beta_dot, scalar *gamma_dot)
{
    const scalar angle_2 = tilt_y * tilt_y + tilt_z * tilt_z, angle = scalar_sqrt(angle_2);
    const scalar sinc = scalar_value(angle) > 1e-8 ? scalar_sin(angle) / angle : 1.0;
    *beta = tilt_y * sinc;
    *gamma = tilt_z * sinc;

    // sinc' = (cos - sinc)/angle^2 (tilt . tilt_dot), the factor as a series: 3e-13 at 0.05 rad
    const scalar factor = -1.0 / 3.0 + angle_2 * (1.0 / 30.0 - angle_2 * (1.0 / 840.0 - angle_2 / 45360.0));
    const scalar change = factor * (tilt_y * tilt_y_dot + tilt_z * tilt_z_dot);
    *beta_dot = tilt_y_dot * sinc + tilt_y * change;
    *gamma_dot = tilt_z_dot * sinc + tilt_z * change;
}

// The outer ring's motion.
INLINE void outer_motion(const Inputs *u, RingLoad *ring_load)
{
    ring_load->outer_x[0] = u->housing.x, ring_load->outer_v[0] = u->housing.v_x;
    ring_load->outer_x[1] = u->housing.y, ring_load->outer_v[1] = u->housing.v_y;
    ring_load->outer_x[2] = u->housing.z, ring_load->outer_v[2] = u->housing.v_z;
    ring_load->outer_omega = u->housing.omega;
    ring_cosines(u->housing.tilt_y, u->housing.tilt_z, u->housing.tilt_y_dot, u->housing.tilt_z_dot,
                 &ring_load->outer_beta, &ring_load->outer_gamma, &ring_load->outer_beta_dot,
                 &ring_load->outer_gamma_dot);
    for (int i = 0; i < 3; i++) {
        ring_load->base[i] = ring_load->outer_x[i];
        ring_load->base_dot[i] = ring_load->outer_v[i];
    }
    ring_load->base[3] = ring_load->outer_beta, ring_load->base_dot[3] = ring_load->outer_beta_dot;
    ring_load->base[4] = ring_load->outer_gamma, ring_load->base_dot[4] = ring_load->outer_gamma_dot;
    bool moves = false;
    for (const scalar *value = ring_load->outer_x; value <= &ring_load->outer_omega; value++)
        moves |= scalar_value(*value) != 0.0;
    ring_load->outer_moves = moves ? 1.0 : 0.0;
}

// The frame: gravity in the turned frame less the acceleration of the bearing's centre.
INLINE void frame_motion(const InputTrajectory *trajectory, scalar t, const Inputs *u, RingLoad *ring_load)
{
    const scalar w = u->frame.omega, w_dot = u->frame.omega_dot, R = trajectory->radius;
    const scalar angle = frame_angle_at(trajectory, t);
    const scalar g_y = trajectory->gravity[0], g_z = trajectory->gravity[1];
    scalar down[2] = {g_y, g_z};
    if (scalar_value(angle) != 0.0 || scalar_value(w) != 0.0) {
        wide sine, cosine;
        wide_sincos(wide_set(angle), &sine, &cosine);
        const scalar s = wide_lane(sine, 0), c = wide_lane(cosine, 0);
        down[0] = c * g_y + s * g_z;
        down[1] = c * g_z - s * g_y;
    }
    ring_load->field[0] = -u->frame.a_x;
    ring_load->field[1] = down[0] - u->frame.a_y + w * w * R;
    ring_load->field[2] = down[1] - u->frame.a_z - w_dot * R;
    ring_load->frame_omega = w;
    ring_load->frame_omega_dot = w_dot;
    ring_load->frame_turns = scalar_value(w) != 0.0 || scalar_value(w_dot) != 0.0 ? 1.0 : 0.0;
}

// The load at time t.
INLINE void ring_load_at(const InputTrajectory *trajectory, scalar t, RingLoad *ring_load)
{
    Inputs u;
    input_trajectory_at(trajectory, t, &u);
    if (scalar_value(trajectory->pulse_r) != 0.0 || scalar_value(trajectory->pulse_a) != 0.0) {
        const bool averaged = scalar_value(trajectory->pulse_rate) == 0.0;
        const scalar sine =
            averaged ? 1.0 : scalar_sin((t - trajectory->pulse_start) * trajectory->pulse_rate);
        u.impact.F_r += trajectory->pulse_r * sine;
        u.impact.F_a += trajectory->pulse_a * sine;
    }
    const scalar radial = scalar_sqrt(u.shaft.F_y * u.shaft.F_y + u.shaft.F_z * u.shaft.F_z);
    const bool loaded = scalar_value(radial) > 0.0;
    ring_load->F[0] = u.shaft.F_x + u.impact.F_a;
    ring_load->F[1] = u.shaft.F_y + u.impact.F_r * (loaded ? u.shaft.F_y / radial : 1.0);
    ring_load->F[2] = u.shaft.F_z + u.impact.F_r * (loaded ? u.shaft.F_z / radial : 0.0);
    ring_load->M[0] = u.shaft.M_y;
    ring_load->M[1] = u.shaft.M_z;
    ring_load->omega = u.shaft.omega;

    // motion of the inner ring; accelerations of the cosines as for small tilts: they are outputs only
    const scalar tau = t - trajectory->t_0;
    const Inputs *u_1 = &trajectory->u[1], *u_2 = &trajectory->u[2];
    ring_load->omega_dot = input_rate(tau, u_1->shaft.omega, u_2->shaft.omega);
    ring_load->x[0] = u.shaft.x, ring_load->x[1] = u.shaft.y, ring_load->x[2] = u.shaft.z;
    ring_load->v[0] = u.shaft.v_x, ring_load->v[1] = u.shaft.v_y, ring_load->v[2] = u.shaft.v_z;
    ring_load->a[0] = input_rate(tau, u_1->shaft.v_x, u_2->shaft.v_x);
    ring_load->a[1] = input_rate(tau, u_1->shaft.v_y, u_2->shaft.v_y);
    ring_load->a[2] = input_rate(tau, u_1->shaft.v_z, u_2->shaft.v_z);
    ring_cosines(u.shaft.tilt_y, u.shaft.tilt_z, u.shaft.tilt_y_dot, u.shaft.tilt_z_dot, &ring_load->beta,
                 &ring_load->gamma, &ring_load->beta_dot, &ring_load->gamma_dot);
    ring_load->beta_ddot = input_rate(tau, u_1->shaft.tilt_y_dot, u_2->shaft.tilt_y_dot);
    ring_load->gamma_ddot = input_rate(tau, u_1->shaft.tilt_z_dot, u_2->shaft.tilt_z_dot);
    outer_motion(&u, ring_load);
    ring_load->outer_a[0] = input_rate(tau, u_1->housing.v_x, u_2->housing.v_x);
    ring_load->outer_a[1] = input_rate(tau, u_1->housing.v_y, u_2->housing.v_y);
    ring_load->outer_a[2] = input_rate(tau, u_1->housing.v_z, u_2->housing.v_z);
    frame_motion(trajectory, t, &u, ring_load);
    ring_load->inner_angle = ring_load->outer_angle = 0.0;
    if (scalar_value(trajectory->angles_matter) != 0.0)
        ring_angles_at(trajectory, t, &ring_load->inner_angle, &ring_load->outer_angle);
}

// Writes the motion that is given into the ring's states.
static inline void ring_follow(const RingLoad *ring_load, scalar *y)
{
    for (int i = 0; i < 3; i++) {
        y[Y_RING_X + i] = ring_load->x[i];
        y[Y_RING_V_X + i] = ring_load->v[i];
    }
    y[Y_RING_BETA] = ring_load->beta, y[Y_RING_BETA_DOT] = ring_load->beta_dot;
    y[Y_RING_GAMMA] = ring_load->gamma, y[Y_RING_GAMMA_DOT] = ring_load->gamma_dot;
}
