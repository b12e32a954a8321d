// The table of contents of the physics: one evaluation of dy/dt in named steps.
#include "physics/rhs.h"

#include "cage/common/cage_joint.h"
#include "cage/common/pocket.h"
#include "cage/elastic/cage_elastic.h"
#include "physics/ball.h"
#include "physics/drag.h"
#include "physics/frame.h"
#include "physics/land_film.h"
#include "physics/outer_ring.h"
#include "physics/powers.h"
#include "physics/race_contact.h"
#include "physics/ring.h"
#include "physics/ring_load.h"
#include "physics/rotor.h"

// Pose and velocity of inner ring and cage halves from y.  A half's states are those of its centre of mass.
static void rotor_kinematics(const Model *model, const scalar *y, Work *w)
{
    Rotor *ring = &w->ring;
    const RingLoad *given = model->ring_load;
    const bool prescribed = model->p->ring.motion == RING_MOTION_PRESCRIBED;
    for (int i = 0; i < 3; i++) {
        ring->x[i] = prescribed ? given->x[i] : y[Y_RING_X + i];
        ring->v[i] = prescribed ? given->v[i] : y[Y_RING_V_X + i];
    }
    if (prescribed)
        rotor_axis(ring, given->beta, given->gamma, given->beta_dot, given->gamma_dot, given->omega);
    else
        rotor_axis(ring, y[Y_RING_BETA], y[Y_RING_GAMMA], y[Y_RING_BETA_DOT], y[Y_RING_GAMMA_DOT],
                   given->omega);

    // cosine and sine of the halves' rotations, side by side
    scalar cos_psi[2], sin_psi[2];
    for (int first = 0; first < 2; first += HALVES) {
        wide sine, cosine;
        wide_sincos(wide_pair(y[Y_CAGE_PSI + first], y[Y_CAGE_PSI + first + HALVES - 1]), &sine, &cosine);
        for (int i = 0; i < HALVES; i++)
            cos_psi[first + i] = wide_lane(cosine, i), sin_psi[first + i] = wide_lane(sine, i);
    }

    // halves; the geometric centre is c away from the centre of mass
    for (int h = 0; h < 2; h++) {
        Rotor *half = &w->half[h];
        rotor_axis(half, y[Y_CAGE_BETA + h], y[Y_CAGE_GAMMA + h], y[Y_CAGE_BETA_DOT + h],
                   y[Y_CAGE_GAMMA_DOT + h], y[Y_CAGE_S + h]);
        rotor_body_axes(half, cos_psi[h], sin_psi[h]);
        scalar drift[3];
        for (int i = 0; i < 3; i++)
            half->c[i] = model->d->com_x[h] * half->a[i] + model->d->com_e * half->b_y[i];
        cross3(half->Omega, half->c, drift);
        for (int i = 0; i < 3; i++) {
            half->x[i] = y[Y_CAGE_X + 2 * i + h] - half->c[i];
            half->v[i] = y[Y_CAGE_V_X + 2 * i + h] - drift[i];
            half->F[i] = half->M[i] = 0.0;  // the elements add their forces
        }
    }
}

// Sum of the race contacts on the ring.
static void ring_sum(Work *w)
{
    const scalar *ring[] = {w->ring_F_x, w->ring_F_y, w->ring_F_z, w->ring_M_x, w->ring_M_y, w->ring_M_z};
    for (int i = 0; i < 3; i++) {
        w->ring.F[i] = ball_array_sum(ring[i]);
        w->ring.M[i] = ball_array_sum(ring[3 + i]);
    }
}

// Sets y_dot of half h from the accelerations of its centre of mass (acc), of its axis (a_ddot) and of its
// spin (s_dot).
static void half_rates(const scalar *y, const Rotor *half, int h, const scalar acc[3], const scalar a_ddot[3],
                       scalar s_dot, scalar *y_dot)
{
    for (int i = 0; i < 3; i++) {
        y_dot[Y_CAGE_X + 2 * i + h] = y[Y_CAGE_V_X + 2 * i + h];
        y_dot[Y_CAGE_V_X + 2 * i + h] = acc[i];
    }
    y_dot[Y_CAGE_BETA + h] = y[Y_CAGE_BETA_DOT + h];
    y_dot[Y_CAGE_GAMMA + h] = y[Y_CAGE_GAMMA_DOT + h];
    y_dot[Y_CAGE_PSI + h] = half->s - rotor_roll(half);
    y_dot[Y_CAGE_BETA_DOT + h] = -a_ddot[2];
    y_dot[Y_CAGE_GAMMA_DOT + h] = a_ddot[1];
    y_dot[Y_CAGE_S + h] = s_dot;
}

// Centre of mass of half h: place and velocity.
static void half_place(const scalar *y, int h, scalar s[3], scalar v[3])
{
    for (int i = 0; i < 3; i++) {
        s[i] = y[Y_CAGE_X + 2 * i + h];
        v[i] = y[Y_CAGE_V_X + 2 * i + h];
    }
}

// Both halves under their forces.
static void halves_acceleration(const Model *model, const scalar *y, const Work *w, scalar *y_dot)
{
    const Parameters *p = model->p;
    for (int h = 0; h < 2; h++) {
        const Rotor *half = &w->half[h];
        scalar M[3], lever[3], a_ddot[3], acc[3], s_dot, s[3], v[3], field[3], M_f[3];
        half_place(y, h, s, v);
        frame_acceleration(model->ring_load, s, v, field);
        frame_moment(model->ring_load, half, model->d->J_p, model->d->J_t, M_f);
        cross3(half->c, half->F, lever);
        for (int i = 0; i < 3; i++) {
            M[i] = half->M[i] - lever[i] + M_f[i];
            acc[i] = half->F[i] / p->cage.m + field[i];
        }
        if (model->elastic) {  // what widens takes spin
            const scalar moment = cage_elastic_coriolis(model, w, h);
            for (int i = 0; i < 3; i++) M[i] -= moment * half->a[i];
        }
        rotor_acceleration(half, model->d->J_p, model->d->J_t, M, a_ddot, &s_dot);
        if (model->elastic) s_dot *= model->d->J_p / (model->d->J_p + w->more_J[h]);
        half_rates(y, half, h, acc, a_ddot, s_dot, y_dot);
    }
}

// Power of an outer ring that moves, of gravity and of the frame.
static __attribute__((noinline)) scalar motion_power(const Model *model, const Work *w)
{
    scalar power = 0.0;
    if (outer_ring_moves(model->ring_load)) power += housing_power(model, w);
    if (frame_has_power(model->ring_load)) power += frame_power(model, w);
    return power;
}

// Net power into balls and cage: by the rings' motions and the frame, less what is dissipated.
static scalar net_power(const Model *model, const Work *w)
{
    scalar power =
        shaft_power(w) - ball_array_sum(w->dissipated) - w->cage_dissipated - w->ring_drag_dissipated;
    power -= ball_array_sum(w->joint_dissipated);
    if (model->elastic) power -= w->modes_dissipated;
    const RingLoad *load = model->ring_load;
    if (scalar_value(load->omega_dot) != 0.0 || scalar_value(load->frame_omega_dot) != 0.0)
        power += race_growth_power(model, w);
    if (outer_ring_moves(load) || frame_has_power(load)) power += motion_power(model, w);
    return power;
}

#ifndef DUAL
void rhs_cage_advance(const Model *model, const double *middle, double h, double *y, Work *w)
{
    rotor_kinematics(model, middle, w);
    for (int i = 0; i < 2; i++) y[Y_CAGE_PSI + i] += h * (w->half[i].s - rotor_roll(&w->half[i]));
    cage_joint_kinematics(model, w);
    if (!model->elastic) cage_joint_advance(model, w, h, y);
}
#endif

// One evaluation under the load that is on the ring.
static void evaluate(const Model *model, const scalar *y, scalar *y_dot, Work *w)
{
    for (int i = 0; i < 3; i++) w->outer_x[i] = model->ring_load->outer_x[i];
    w->outer_beta = model->ring_load->outer_beta, w->outer_gamma = model->ring_load->outer_gamma;
    w->frame_omega = model->ring_load->frame_omega;
    ball_kinematics(y, w);
    rotor_kinematics(model, y, w);
    race_contact_force(model, w);
    if (model->elastic) cage_elastic_kinematics(model, y, w);
    pocket_force(model, w);
    drag_mixture(model, w);
    drag_force(model, w);
    ring_sum(w);
    drag_ring(model, w);
    land_film_force(model, w);
    drag_cage(model, w);
    cage_joint_kinematics(model, w);
    if (model->elastic) {
        cage_elastic_pads(model, w);
        cage_elastic_joints(model, w);
    }
    cage_joint_force(model, y, w);
    ball_acceleration(model, w, y_dot);
    halves_acceleration(model, y, w, y_dot);
    ring_acceleration(model, w, y_dot);
    memcpy(&y_dot[Y_JOINT_PLATE_Y], w->plate_y_dot, Z * sizeof *y_dot);
    memcpy(&y_dot[Y_JOINT_PLATE_Z], w->plate_z_dot, Z * sizeof *y_dot);
    memcpy(&y_dot[Y_JOINT_HEAD_Y], w->head_y_dot, Z * sizeof *y_dot);
    memcpy(&y_dot[Y_JOINT_HEAD_Z], w->head_z_dot, Z * sizeof *y_dot);
    if (model->elastic) cage_elastic_acceleration(model, y, w, y_dot);
    y_dot[Y_WORK] = net_power(model, w);
}

void rhs(const Model *model, double t, const scalar *y, scalar *y_dot, Work *w)
{
    RingLoad ring_load;
    const Model now = {model->p, model->d, &ring_load, NULL, model->elastic};
    if (model->trajectory) ring_load_at(model->trajectory, t, &ring_load);
    evaluate(model->trajectory ? &now : model, y, y_dot, w);
}
