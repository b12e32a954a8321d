// The two halves of the cage as rigid bodies.  The states of a half are those of its centre of mass, which lies c away
// from its geometric centre; contacts act about the geometric centre.
#include "cage/common/halves.h"

#include "physics/frame.h"

void halves_kinematics(const Model *model, const scalar *y, Work *w)
{
    // cosine and sine of the halves' rotations, side by side
    scalar cos_psi[2], sin_psi[2];
    for (int first = 0; first < 2; first += HALVES) {
        wide sine, cosine;
        wide_sincos(wide_pair(y[Y_CAGE_PSI + first], y[Y_CAGE_PSI + first + HALVES - 1]), &sine, &cosine);
        for (int i = 0; i < HALVES; i++)
            cos_psi[first + i] = wide_lane(cosine, i), sin_psi[first + i] = wide_lane(sine, i);
    }

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

void halves_acceleration(const Model *model, const scalar *y, const Work *w, scalar *y_dot)
{
    const Parameters *p = model->p;
    const Derived *d = model->d;
    for (int h = 0; h < 2; h++) {
        const Rotor *half = &w->half[h];
        scalar M[3], lever[3], a_ddot[3], acc[3], s_dot, s[3], v[3], field[3], M_f[3];
        for (int i = 0; i < 3; i++) s[i] = y[Y_CAGE_X + 2 * i + h], v[i] = y[Y_CAGE_V_X + 2 * i + h];
        frame_acceleration(model->ring_load, s, v, field);
        frame_moment(model->ring_load, half, d->J_p, d->J_t, M_f);
        cross3(half->c, half->F, lever);
        for (int i = 0; i < 3; i++) {
            M[i] = half->M[i] - lever[i] + M_f[i];
            acc[i] = half->F[i] / p->cage.m + field[i];
        }

        // A half that expands gains inertia and slows down; the gained inertia resists the frame's angular acceleration too.
        const scalar moment = w->cage.elastic.more_J_dot[h] * (half->s + w->frame_omega) +
                              w->cage.elastic.more_J[h] * model->ring_load->frame_omega_dot;
        for (int i = 0; i < 3; i++) M[i] -= moment * half->a[i];
        rotor_acceleration(half, d->J_p, d->J_t, M, a_ddot, &s_dot);
        s_dot *= d->J_p / (d->J_p + w->cage.elastic.more_J[h]);
        half_rates(y, half, h, acc, a_ddot, s_dot, y_dot);
    }
}
