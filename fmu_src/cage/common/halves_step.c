// The halves' part of a step, as far as both kinds of halves share it:
//
//   psi_{n+1} = psi_n + h psi'(q_m, v_m)        midpoint rule: the rates depend on the pose
//   v^ = v_n + h a_n - removed                  predictor with its limiter
//   residual = gamma (a^ - a_n) + removed       at the prediction; the kind of halves solves for delta
//   v_{n+1} = v^ + delta,  a_{n+1}, errors      trapezoidal rule (trapezoid.h)
//   u' = (way of the joint)/h                   mean rate of a friction state
#include "cage/common/halves_step.h"

#include "cage/common/films.h"
#include "cage/common/halves.h"
#include "numbers/trapezoid.h"
#include "physics/rotor.h"

#ifndef DUAL
enum { FIRST = Y_CAGE_V_X, END = Y_RING_V_X };  // rows of the halves' velocities

void halves_move(const Model *model, double h, const StepFrom *from, const double *middle, double *y,
                 HalvesStep *step, Work *w)
{
    step->h = h, step->gamma = 0.5 * h;
    memset(&step->joints, 0, sizeof step->joints);
    memcpy(&y[FIRST], &middle[FIRST], (END - FIRST) * sizeof *y);
    halves_kinematics(model, middle, w);
    for (int i = 0; i < 2; i++)
        y[Y_CAGE_PSI + i] = from->y[Y_CAGE_PSI + i] + h * (w->half[i].s - rotor_roll(&w->half[i]));
    cage_joint_kinematics(model, w);
}

// v = (1 + gamma A)^-1 v of the halves' velocities by films of the given rates alone.
static void films_solve(const Model *model, const LandFilm film[2], double gamma, double *v)
{
    for (int h = 0; h < 2; h++) {
        const HalfFilm f = half_film(model, &film[h], h, gamma);
        half_film_solve(&f, h, v);
    }
}

// A land film is stiff when closing and almost free when opening, so extrapolating with a_n would throw a half off the
// film on which the half rests.  The part of h a_n that is new since the last step, h (a_n - minmod(a_n, a_{n-1})),
// is therefore damped implicitly with the film matrix at the step's start; the part that both accelerations
// share is steady and stays.
static void limit_prediction(const Model *model, const StepFrom *from, const LandFilm film[2],
                             HalvesStep *step)
{
    // The new part: minmod is the smaller of two accelerations of the same sign, else 0.
    double kept[N_STATES];
    for (int i = FIRST; i < END; i++) {
        const double now = from->f[i], before = now - from->h * from->jerk[i];
        const double minmod = now * before <= 0.0 ? 0.0 : fabs(now) < fabs(before) ? now : before;
        step->removed[i] = kept[i] = step->h * (now - minmod);
    }

    // The part that the films leave of it, (1 + h A)^-1 of the films alone, without their spin.
    films_solve(model, film, step->h, kept);
    for (int i = FIRST; i < END; i++) step->removed[i] -= kept[i];
}

void halves_predict(const Model *model, const StepFrom *from, const LandFilm film[2], double *y,
                    HalvesStep *step)
{
    limit_prediction(model, from, film, step);
    for (int i = FIRST; i < END; i++) {
        y[i] += step->gamma * from->f[i];
        y[i] -= step->removed[i];
    }
}

void halves_residual(const HalvesStep *step, const StepFrom *from, const StepTo *to)
{
    for (int i = FIRST; i < END; i++)
        to->residual[i] = step->gamma * (to->f[i] - from->f[i]) + step->removed[i];
}

// The part that the limiter removed is added again before the solution.
void halves_correct(const HalvesStep *step, const StepTo *to, double change[N_STATES])
{
    for (int i = FIRST; i < END; i++) {
        to->y[i] += step->removed[i];
        change[i] = to->delta[i] - step->removed[i];
        to->y[i] += change[i];
    }
}

void halves_stiff_part(const Model *model, const Work *w, double gamma, double *v)
{
    double kept[N_STATES];
    memcpy(&kept[FIRST], &v[FIRST], (END - FIRST) * sizeof *v);
    films_solve(model, w->film, gamma, kept);
    for (int i = FIRST; i < END; i++) v[i] -= kept[i];
}

void halves_slide(const Model *model, const JointStiffness *k, const double *T, const double *N_plate,
                  double *y, JointStep *joints, Work *w)
{
    y[Y_WORK] -= cage_joint_slide(model, k, T, N_plate, y, joints);
    memcpy(w->joint_rubbed, joints->rubbed, sizeof w->joint_rubbed);
}

// Mean rates of the joints' motion over the step, which the friction states follow, their changes and errors.  The
// midpoint rule's own leading error is h^3 u'''/24.  The mean rates belong to the middles of the steps, so that their
// differences give u'' and the differences of u'' give u'''.
static void remember_friction(const HalvesStep *step, const StepFrom *from, const StepTo *to)
{
    const double h = step->h, inv_h = 1.0 / h, inv_span = 2.0 / (h + from->h), second = h * h * inv_span;
    for (int k = 0; k < Z; k++) {
        to->f[Y_JOINT_PLATE_Y + k] = step->joints.way_y[k] * inv_h;
        to->f[Y_JOINT_PLATE_Z + k] = step->joints.way_z[k] * inv_h;
    }
    for (int i = Y_JOINT_PLATE_Y; i < Y_WORK; i++) {
        to->jerk[i] = (to->f[i] - from->f[i]) * inv_span;
        to->error[i] = (h * second / 24.0) * (to->jerk[i] - from->jerk[i]);
    }
}

void halves_remember(const Model *model, const Work *w, const HalvesStep *step, const StepFrom *from,
                     const double change[N_STATES], const double unforeseen[N_STATES], const StepTo *to,
                     LandFilm film[2])
{
    double second_difference[N_STATES];
    trapezoid_error(step->h, from->h, FIRST, END, unforeseen, from->jerk, second_difference, to->error);
    halves_stiff_part(model, w, step->gamma, second_difference);
    trapezoid_end(step->h, FIRST, END, from->f, change, unforeseen, second_difference, to->f, to->jerk);
    remember_friction(step, from, to);
    for (int h = 0; h < 2; h++) film[h] = (LandFilm){w->film[h].yy, w->film[h].yz, w->film[h].zz, 0.0};
}
#endif
