// The table of contents of the physics: one evaluation of dy/dt in named steps.
#include "rhs.h"

#include "ball.h"
#include "cage_joint.h"
#include "drag.h"
#include "land_film.h"
#include "pocket.h"
#include "race_contact.h"
#include "ring.h"
#include "ring_load.h"
#include "rotor.h"

// Pose and velocity of inner ring and cage halves from y.  A half's states are those of its centre of mass.
static void rotor_kinematics(const Model *model, const scalar *y, Work *w)
{
    Rotor *ring = &w->ring;
    for (int i = 0; i < 3; i++) {
        ring->x[i] = y[Y_RING_X + i];
        ring->v[i] = y[Y_RING_V_X + i];
    }
    rotor_axis(ring, y[Y_RING_BETA], y[Y_RING_GAMMA], y[Y_RING_BETA_DOT], y[Y_RING_GAMMA_DOT],
               model->ring_load->omega);

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

    // in a rigid cage half 1 moves with half 0
    if (model->p->scene.cage == CAGE_MODEL_RIGID) {
        Rotor *h0 = &w->half[0], *h1 = &w->half[1];
        *h1 = *h0;
        for (int i = 0; i < 3; i++) h1->c[i] = model->d->com_x[1] * h0->a[i] + model->d->com_e * h0->b_y[i];
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

// Both halves under their forces.
static void halves_acceleration(const Model *model, const scalar *y, const Work *w, scalar *y_dot)
{
    const Parameters *p = model->p;
    const double gravity[3] = {0.0, p->gravity.y, p->gravity.z};
    for (int h = 0; h < 2; h++) {
        const Rotor *half = &w->half[h];
        scalar M[3], lever[3], a_ddot[3], acc[3], s_dot;
        cross3(half->c, half->F, lever);
        for (int i = 0; i < 3; i++) {
            M[i] = half->M[i] - lever[i];
            acc[i] = half->F[i] / p->cage.m + gravity[i];
        }
        rotor_acceleration(half, model->d->J_p, model->d->J_t, M, a_ddot, &s_dot);
        half_rates(y, half, h, acc, a_ddot, s_dot, y_dot);
    }
}

// Both halves as one rigid body about their common centre of mass.
static void rigid_cage_acceleration(const Model *model, const scalar *y, const Work *w, scalar *y_dot)
{
    const Parameters *p = model->p;
    const Rotor *cage = &w->half[0];
    const double gravity[3] = {0.0, p->gravity.y, p->gravity.z};
    const double J_t = 2.0 * (model->d->J_t + p->cage.m * model->d->com_x[1] * model->d->com_x[1]);
    scalar M[3], lever[3], a_ddot[3], acc[3], s_dot;
    scalar F[3], c[3], spin_up[3], carried[3], around[3], inward[3];

    // force, and moment about the common centre of mass
    for (int i = 0; i < 3; i++) {
        F[i] = w->half[0].F[i] + w->half[1].F[i];
        c[i] = model->d->com_e * cage->b_y[i];
    }
    cross3(c, F, lever);
    for (int i = 0; i < 3; i++) M[i] = w->half[0].M[i] + w->half[1].M[i] - lever[i];
    rotor_acceleration(cage, 2.0 * model->d->J_p, J_t, M, a_ddot, &s_dot);

    // rate of Omega, which carries each half's centre of mass along
    cross3(cage->a, a_ddot, spin_up);
    for (int i = 0; i < 3; i++) spin_up[i] += s_dot * cage->a[i] + cage->s * cage->a_dot[i];
    for (int h = 0; h < 2; h++) {
        for (int i = 0; i < 3; i++) c[i] = model->d->com_x[h] * cage->a[i];
        cross3(spin_up, c, carried);
        cross3(cage->Omega, c, around);
        cross3(cage->Omega, around, inward);
        for (int i = 0; i < 3; i++) acc[i] = F[i] / (2.0 * p->cage.m) + gravity[i] + carried[i] + inward[i];
        half_rates(y, cage, h, acc, a_ddot, s_dot, y_dot);
    }
    for (int i = 0; i < 4 * Z; i++) y_dot[Y_JOINT_PLATE_Y + i] = 0.0;  // friction states rest
}

// Net power into balls and cage: by the ring's motion and gravity, less what is dissipated.
static scalar net_power(const Model *model, const Work *w)
{
    scalar power = -dot3(w->ring.F, w->ring.v) - dot3(w->ring.M, w->ring.Omega) -
                   ball_array_sum(w->dissipated) - w->cage_dissipated - w->ring_drag_dissipated;
    if (model->p->scene.cage == CAGE_MODEL_TWO_HALF) power -= ball_array_sum(w->joint_dissipated);
    if (scalar_value(model->ring_load->omega_dot) != 0.0) power += race_growth_power(model, w);
    const double g_y = model->p->gravity.y, g_z = model->p->gravity.z;
    if (g_y != 0.0 || g_z != 0.0) {
        for (int j = 0; j < Z; j++) {
            const scalar v_y = w->v_r[j] * w->cos_theta[j] - w->v_t[j] * w->sin_theta[j];
            const scalar v_z = w->v_r[j] * w->sin_theta[j] + w->v_t[j] * w->cos_theta[j];
            power += model->d->m * (g_y * v_y + g_z * v_z);
        }
        for (int h = 0; h < 2; h++) {
            scalar drift[3];
            cross3(w->half[h].Omega, w->half[h].c, drift);
            power +=
                model->p->cage.m * (g_y * (w->half[h].v[1] + drift[1]) + g_z * (w->half[h].v[2] + drift[2]));
        }
    }
    return power;
}

#ifndef DUAL
void rhs_cage_advance(const Model *model, const double *middle, double h, double *y, Work *w)
{
    rotor_kinematics(model, middle, w);
    for (int i = 0; i < 2; i++) y[Y_CAGE_PSI + i] += h * (w->half[i].s - rotor_roll(&w->half[i]));
    if (model->p->scene.cage == CAGE_MODEL_RIGID) return;
    cage_joint_kinematics(model, w);
    cage_joint_advance(model, w, h, y);
}
#endif

// One evaluation under the load that is on the ring.
static void evaluate(const Model *model, const scalar *y, scalar *y_dot, Work *w)
{
    const bool rigid = model->p->scene.cage == CAGE_MODEL_RIGID;
    ball_kinematics(y, w);
    rotor_kinematics(model, y, w);
    race_contact_force(model, w);
    pocket_force(model, w);
    drag_mixture(model, w);
    drag_force(model, w);
    ring_sum(w);
    drag_ring(model, w);
    land_film_force(model, w);
    drag_cage(model, w);
    if (!rigid) {
        cage_joint_kinematics(model, w);
        cage_joint_force(model, y, w);
    }
    ball_acceleration(model, w, y_dot);
    (rigid ? rigid_cage_acceleration : halves_acceleration)(model, y, w, y_dot);
    ring_acceleration(model, w, y_dot);
    if (!rigid) {
        memcpy(&y_dot[Y_JOINT_PLATE_Y], w->plate_y_dot, Z * sizeof *y_dot);
        memcpy(&y_dot[Y_JOINT_PLATE_Z], w->plate_z_dot, Z * sizeof *y_dot);
        memcpy(&y_dot[Y_JOINT_HEAD_Y], w->head_y_dot, Z * sizeof *y_dot);
        memcpy(&y_dot[Y_JOINT_HEAD_Z], w->head_z_dot, Z * sizeof *y_dot);
    }
    y_dot[Y_WORK] = net_power(model, w);
}

void rhs(const Model *model, double t, const scalar *y, scalar *y_dot, Work *w)
{
    RingLoad ring_load;
    const Model now = {model->p, model->d, &ring_load, NULL};
    if (model->trajectory) ring_load_at(model->trajectory, t, &ring_load);
    evaluate(model->trajectory ? &now : model, y, y_dot, w);
}
