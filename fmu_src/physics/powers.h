// Reactions on the rings, and the powers by which shaft, housing and frame change the energy of balls and cage.
//
// The sum of all forces on balls and cage accelerates them.  So the load on the outer ring is the force of the inner
// ring on balls and cage, less that sum.  Gravity and the frame's inertia forces are not among these
// forces.
#pragma once

#include "cage/cage.h"
#include "physics/frame.h"
#include "physics/outer_ring.h"

// Force and moment about the origin that balls and cage put on the housing (outer ring, oil).
static inline void housing_reaction(const Work *w, scalar F[3], scalar M[3])
{
    const Rotor *bodies[3] = {&w->ring, &w->half[0], &w->half[1]};
    for (int i = 0; i < 3; i++) F[i] = M[i] = 0.0;

    // forces and moments on ring and cage halves
    for (int b = 0; b < 3; b++) {
        scalar lever[3];
        cross3(bodies[b]->x, bodies[b]->F, lever);
        for (int i = 0; i < 3; i++) {
            F[i] -= bodies[b]->F[i];
            M[i] -= bodies[b]->M[i] + lever[i];
        }
    }

    // less the forces and moments on the balls
    for (int j = 0; j < Z; j++) {
        const scalar c = w->cos_theta[j], s = w->sin_theta[j];
        const scalar position[3] = {w->x[j], w->r[j] * c, w->r[j] * s};
        const scalar force[3] = {w->F_x[j], w->F_r[j] * c - w->F_t[j] * s, w->F_r[j] * s + w->F_t[j] * c};
        const scalar moment[3] = {w->M_x[j], w->M_r[j] * c - w->M_t[j] * s, w->M_r[j] * s + w->M_t[j] * c};
        scalar lever[3];
        cross3(position, force, lever);
        for (int i = 0; i < 3; i++) {
            F[i] -= force[i];
            M[i] -= moment[i] + lever[i];
        }
    }
}

// Force and moment on the housing, the moment about the outer ring's centre.
static inline void housing_wrench(const Model *model, const Work *w, scalar F[3], scalar M[3])
{
    const scalar *x = model->ring_load->outer_x;
    housing_reaction(w, F, M);
    if (!outer_ring_moves(model->ring_load)) return;
    scalar lever[3];
    cross3(x, F, lever);
    for (int i = 0; i < 3; i++) M[i] -= lever[i];
}

// Power of the shaft into balls and cage.
static inline scalar shaft_power(const Work *w)
{
    return -dot3(w->ring.F, w->ring.v) - dot3(w->ring.M, w->ring.Omega);
}

// Power dissipated in contacts, films, drag and by damping; the joints' friction is beside it: the work of
// a step's slip (cage_end).
static inline scalar power_loss(const Work *w)
{
    return ball_array_sum(w->dissipated) + w->cage_dissipated + w->ring_drag_dissipated +
           (cage_vibrations_lose(w) + cage_joints_damp(w));
}

// Torque of the shaft about its axis.
static inline scalar friction_torque(const Work *w)
{
    return -dot3(w->ring.M, w->ring.a);
}

#ifndef DUAL
// Exchange with the shaft by the forces on the ring in w.
static inline Exchange exchange_at(const Work *w)
{
    const double power = shaft_power(w), lost = power_loss(w) + ball_array_sum(w->joint_dissipated);
    return (Exchange){friction_torque(w), power, fabs(power), lost, 0.0};
}

// Adds the exchange over a time h [s], by the trapezoidal rule, which is that of the balls' velocities.
static inline void exchange_add(double h, const Exchange *from, const Exchange *to, Exchange *sum)
{
    sum->torque += 0.5 * h * (from->torque + to->torque);
    sum->power += 0.5 * h * (from->power + to->power);
    sum->exchanged += 0.5 * h * (from->exchanged + to->exchanged);
    sum->lost += 0.5 * h * (from->lost + to->lost);
    sum->jump += h * from->jump;
}
#endif

// Power of the housing into balls and cage.
static inline scalar housing_power(const Model *model, const Work *w)
{
    const Rotor outer = outer_ring(model->ring_load);
    scalar F[3], M[3];
    housing_wrench(model, w, F, M);
    return -dot3(F, outer.v) - dot3(M, outer.Omega);
}

// Whether gravity or the frame do work.
static inline bool frame_has_power(const RingLoad *ring_load)
{
    bool field = false;
    for (int i = 0; i < 3; i++) field |= scalar_value(ring_load->field[i]) != 0.0;
    return field || frame_turns(ring_load);
}

// Power of gravity and of the frame's inertia forces into balls and cage, less cage_widening.
static inline scalar frame_power(const Model *model, const Work *w)
{
    const RingLoad *frame = model->ring_load;
    const double m = model->d->m, J = model->d->J;
    scalar power = 0.0;
    for (int j = 0; j < Z; j++) {
        const scalar c = w->cos_theta[j], s = w->sin_theta[j];
        const scalar place[3] = {w->x[j], w->r[j] * c, w->r[j] * s};
        const scalar v[3] = {w->v_x[j], w->v_r[j] * c - w->v_t[j] * s, w->v_r[j] * s + w->v_t[j] * c};
        scalar acc[3];
        frame_acceleration(frame, place, v, acc);
        power += m * dot3(acc, v) - J * frame->frame_omega_dot * w->omega_x[j];
    }
    for (int h = 0; h < 2; h++) {
        const Rotor *half = &w->half[h];
        scalar place[3], v[3], acc[3], M_f[3];
        cross3(half->Omega, half->c, v);
        for (int i = 0; i < 3; i++) {
            place[i] = half->x[i] + half->c[i];
            v[i] += half->v[i];
        }
        frame_acceleration(frame, place, v, acc);
        frame_moment(frame, half, model->d->J_p, model->d->J_t, M_f);
        power += model->p->cage.m * dot3(acc, v) + dot3(M_f, half->Omega);
    }
    return power - cage_drawn(w, frame->frame_omega_dot);
}
