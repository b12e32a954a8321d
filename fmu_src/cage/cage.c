// Functions of cage.h for an evaluation and for a step of the default method: each calls the code of rigid or of
// elastic halves (cage_setup.c and cage_read.c have the other functions of cage.h).
#include "cage/cage.h"

#include "cage/common/cage_joint.h"
#include "cage/common/halves.h"
#include "cage/common/pocket.h"
#include "cage/common/pocket_spheres.h"
#include "cage/elastic/cage_elastic.h"
#include "cage/elastic/elastic_half.h"

void cage_kinematics(const Model *model, const scalar *y, Work *w)
{
    halves_kinematics(model, y, w);
    if (model->modes) cage_elastic_kinematics(model, y, w);
}

void cage_pockets(const Model *model, Work *w)
{
    if (model->d->spheres.on)
        (model->modes ? spheres_elastic : spheres_rigid)(model, w);
    else
        (model->modes ? pocket_elastic : pocket_rigid)(model, w);
}

void cage_joints(const Model *model, const scalar *y, Work *w)
{
    cage_joint_kinematics(model, w);
    (model->modes ? cage_elastic_joints : two_half_joints)(model, y, w);
}

void cage_acceleration(const Model *model, const scalar *y, Work *w, scalar *y_dot)
{
    halves_acceleration(model, y, w, y_dot);
    memcpy(&y_dot[Y_JOINT_PLATE_Y], w->plate_y_dot, Z * sizeof *y_dot);
    memcpy(&y_dot[Y_JOINT_PLATE_Z], w->plate_z_dot, Z * sizeof *y_dot);
    memcpy(&y_dot[Y_JOINT_HEAD_Y], w->head_y_dot, Z * sizeof *y_dot);
    memcpy(&y_dot[Y_JOINT_HEAD_Z], w->head_z_dot, Z * sizeof *y_dot);
    if (model->modes) cage_elastic_acceleration(model, y, w, y_dot);
}

void cage_loads(const Model *model, const Work *w, JointLoads *load)
{
    (model->modes ? cage_elastic_rivets : two_half_loads)(model, w, load);
}

#ifndef DUAL
void cage_split(const Model *model, const double *y, const Work *w, double *f, CageMemory *memory)
{
    if (model->modes)
        cage_substeps_split(model, y, w, f, &memory->fast);
    else
        two_half_remember(w, &memory->path);
}

void cage_advance(const Model *model, double h, const double *y_0, const double *f, const CageMemory *memory,
                  const double *middle, double *y, CageStep *step, Work *w)
{
    halves_kinematics(model, middle, w);
    for (int i = 0; i < 2; i++)
        y[Y_CAGE_PSI + i] = y_0[Y_CAGE_PSI + i] + h * (w->half[i].s - rotor_roll(&w->half[i]));
    cage_joint_kinematics(model, w);
    step->substep = step->axial = step->shear = 0.0;
    if (!model->modes) {
        two_half_advance(model, h, &memory->path, w, y);
        return;
    }
    memcpy(&y[Y_MODE_S], &y_0[Y_MODE_S], (N_ALL_STATES - Y_MODE_S) * sizeof *y);
    step->substep = cage_substeps_advance(model, h, &memory->fast, f, y, &step->foreseen, w);
}

void cage_predict(const Model *model, const Work *w, const CageStep *step, const CageMemory *memory,
                  double *y)
{
    if (!model->modes) return;
    for (int i = 0; i < 2 * N_MODES; i++)
        y[Y_MODE_S_DOT + i] += 0.5 * step->substep * step->foreseen.modes[i];
    cage_substeps_finish(model, w, step->substep, &memory->fast, NULL, y);
}

void cage_arrive(const Model *model, const Work *w, const CageStep *step, const CageMemory *before, double *y,
                 double *f, CageMemory *memory)
{
    cage_split(model, y, w, f, memory);
    if (model->modes) cage_substeps_finish(model, w, step->substep, &memory->fast, &before->fast, y);
}

void cage_foreseen(const Model *model, const CageStep *step, double gamma, double *v)
{
    if (!model->modes) return;
    for (int i = 0; i < 2 * RELATIVE_MOTIONS; i++) v[Y_CAGE_V_X + i] += gamma * step->foreseen.halves[i];
}

void cage_films(const Model *model, const LandFilm film[2], double gamma, double *v)
{
    for (int h = 0; h < 2; h++) {
        HalfVelocity half = half_velocity_load(v, h);
        const HalfFilm f = half_film(model, &film[h], h, gamma);
        half_film_solve(&f, &half);
        half_velocity_store(&half, v, h);
    }
}

void cage_shear(const Model *model, const Work *w, double gamma, CageStep *step, double *v)
{
    if (!model->modes) step->shear = two_half_shear(model, w, gamma, v);
}

void cage_solve(const Model *model, const Work *w, double gamma, CageStep *step, double *v)
{
    HalfFilm f[2];
    HalfVelocity half[2];
    for (int h = 0; h < 2; h++) {
        half[h] = half_velocity_load(v, h);
        f[h] = half_film(model, &w->film[h], h, gamma);
        half_film_solve(&f[h], &half[h]);
    }
    if (!model->modes) step->axial = two_half_solve(model, w, gamma, f, half);
    for (int h = 0; h < 2; h++) half_velocity_store(&half[h], v, h);
}

void cage_correct(const Model *model, const Work *w, double gamma, const CageStep *step, const double *delta,
                  double *y)
{
    if (!model->modes) two_half_correct(model, w, gamma, step->axial, step->shear, delta, y);
}

void cage_remember(const Model *model, const CageStep *step, double h, double h_0, const double *restrict f,
                   const double *restrict jerk, double *restrict y, double *restrict f_end,
                   double *restrict jerk_end, double *restrict error)
{
    if (!model->modes) return;
    const double gamma = 0.5 * h, inv_h = 1.0 / h, second = h * h * (2.0 / (h + h_0));
    for (int i = Y_MODE_S_DOT; i < N_ALL_STATES; i++) {
        const double change = f_end[i] - f[i];
        y[i] += gamma * (f_end[i] - step->foreseen.modes[i - Y_MODE_S_DOT]);
        jerk_end[i] = change * inv_h;
        error[i] = (h / 12.0) * (second * (jerk_end[i] - jerk[i]));
    }
    memcpy(&f_end[Y_MODE_S], &y[Y_MODE_S_DOT], 2 * N_MODES * sizeof *error);
    memset(&jerk_end[Y_MODE_S], 0, 2 * N_MODES * sizeof *error);
    memset(&error[Y_MODE_S], 0, 2 * N_MODES * sizeof *error);
}
#endif
