// The inputs as the ring sees them.
//
//   inputs:  u(t) = u_0 + u_0' (t - t_0) + u_0'' (t - t_0)^2/2 from the communication point t_0 on
//   pulses:  F_r sin(pi (t - t_n)/duration) along the radial load (+Y without one) and F_a along +X, t_n = t_start + n interval
//
// The vectors of force are in the global frame.  Shaft tilt is a rotation about (0, tilt_y, tilt_z): a = (cos, tilt_z sinc, -tilt_y sinc).
#pragma once

#include "elementary.h"
#include "model.h"

// The course of the inputs u (value and derivatives at t_0) from time t up to the next edge of a pulse.
void course_update(const Parameters *p, const Inputs u[INPUT_ORDERS + 1], double t_0, double t, Course *course);

// Whether the drive changes along it.
bool course_varies(const Course *course);

// Inputs and their rates at time t.
void course_inputs(const Course *course, double t, Inputs *u, Inputs *u_dot);

// The drive at time t, inputs u held.
void drive_update(const Parameters *p, const Inputs *u, double t, Drive *drive);

// First edge of the built-in pulses later than t (infinite if none).
double drive_next_edge(const Parameters *p, double t);

// Angles of the rotation with the direction cosines beta, gamma.
INLINE void ring_tilts(number beta, number gamma, number *tilt_y, number *tilt_z)
{
    const number sine = number_sqrt(beta * beta + gamma * gamma);
    const number factor = number_value(sine) > 1e-8 ? number_asin(sine) / sine : 1.0;
    *tilt_y = beta * factor;
    *tilt_z = gamma * factor;
}

INLINE number drive_sine(number x)
{
    real sine, cosine;
    real_sincos(real_set(x), &sine, &cosine);
    return real_lane(sine, 0);
}

// Taylor's polynomial of every input.
INLINE void drive_inputs(const Course *course, number t, Inputs *u)
{
    const number tau = t - course->t_0;
    const number *u_0 = (const number *)&course->u[0], *u_1 = (const number *)&course->u[1], *u_2 = (const number *)&course->u[2];
    for (int i = 0; i < N_INPUTS; i++) ((number *)u)[i] = u_0[i] + tau * (u_1[i] + 0.5 * tau * u_2[i]);
}

// The drive at time t.
INLINE void drive_at(const Course *course, number t, Drive *drive)
{
    Inputs u;
    drive_inputs(course, t, &u);
    if (number_value(course->pulse_r) != 0.0 || number_value(course->pulse_a) != 0.0) {
        const number sine = drive_sine((t - course->pulse_start) * course->pulse_rate);
        u.impact.F_r += course->pulse_r * sine;
        u.impact.F_a += course->pulse_a * sine;
    }
    const number radial = number_sqrt(u.shaft.F_y * u.shaft.F_y + u.shaft.F_z * u.shaft.F_z);
    const bool loaded = number_value(radial) > 0.0;
    drive->F[0] = u.shaft.F_x + u.impact.F_a;
    drive->F[1] = u.shaft.F_y + u.impact.F_r * (loaded ? u.shaft.F_y / radial : 1.0);
    drive->F[2] = u.shaft.F_z + u.impact.F_r * (loaded ? u.shaft.F_z / radial : 0.0);
    drive->M[0] = u.shaft.M_y;
    drive->M[1] = u.shaft.M_z;
    drive->omega = u.shaft.omega;
    const number angle = number_sqrt(u.shaft.tilt_y * u.shaft.tilt_y + u.shaft.tilt_z * u.shaft.tilt_z);
    const number sinc = number_value(angle) > 1e-8 ? drive_sine(angle) / angle : 1.0;
    drive->beta = u.shaft.tilt_y * sinc;
    drive->gamma = u.shaft.tilt_z * sinc;
}
