// The inputs over a communication step, and the load and motion that they impose on the ring at one time.
//
//   inputs:  u(t) = u_0 + u_0' (t - t_0) + u_0'' (t - t_0)^2/2 from the communication point t_0 on
//   pulses:  F_r sin(pi (t - t_n)/duration) along the radial load (+Y without one) and F_a along +X,
//            t_n = t_start + n interval
//
// Forces and moments are in the global frame.  Shaft tilt is a rotation about (0, tilt_y, tilt_z): a = (cos,
// tilt_z sinc, -tilt_y sinc).
#pragma once

#include "elementary.h"
#include "model.h"

// The trajectory of the inputs u (values and derivatives at t_0) from time t up to the next edge of a pulse.
void input_trajectory_update(const Parameters *p, const Inputs u[INPUT_ORDERS + 1], double t_0, double t,
                             InputTrajectory *trajectory);

// Whether load or motion changes along the trajectory.
bool input_trajectory_varies(const InputTrajectory *trajectory);

// Inputs and their rates at time t.
void input_trajectory_rates_at(const InputTrajectory *trajectory, double t, Inputs *u, Inputs *u_dot);

// The load at time t under inputs u that are held.
void ring_load_update(const Parameters *p, const Inputs *u, double t, RingLoad *ring_load);

// Next start or end of a built-in pulse after t, infinity after the last one.
double pulse_next_edge(const Parameters *p, double t);

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
}

// The load at time t.
INLINE void ring_load_at(const InputTrajectory *trajectory, scalar t, RingLoad *ring_load)
{
    Inputs u;
    input_trajectory_at(trajectory, t, &u);
    if (scalar_value(trajectory->pulse_r) != 0.0 || scalar_value(trajectory->pulse_a) != 0.0) {
        const scalar sine = scalar_sin((t - trajectory->pulse_start) * trajectory->pulse_rate);
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
    ring_load->omega_dot =
        trajectory->u[1].shaft.omega + (t - trajectory->t_0) * trajectory->u[2].shaft.omega;
    const scalar angle = scalar_sqrt(u.shaft.tilt_y * u.shaft.tilt_y + u.shaft.tilt_z * u.shaft.tilt_z);
    const scalar sinc = scalar_value(angle) > 1e-8 ? scalar_sin(angle) / angle : 1.0;
    ring_load->beta = u.shaft.tilt_y * sinc;
    ring_load->gamma = u.shaft.tilt_z * sinc;
}
