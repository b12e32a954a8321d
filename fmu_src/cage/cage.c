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

// Trial deflections follow the joints, heads the plates' slip alone.
static void friction_rates(const scalar *v_y, const scalar *v_z, scalar *y_dot)
{
    memcpy(&y_dot[Y_JOINT_PLATE_Y], v_y, Z * sizeof *y_dot);
    memcpy(&y_dot[Y_JOINT_PLATE_Z], v_z, Z * sizeof *y_dot);
    for (int k = 0; k < Z; k++) y_dot[Y_JOINT_HEAD_Y + k] = y_dot[Y_JOINT_HEAD_Z + k] = 0.0;
}

void cage_acceleration(const Model *model, const scalar *y, Work *w, scalar *y_dot)
{
    halves_acceleration(model, y, w, y_dot);
    if (model->modes) {
        friction_rates(w->elastic.joints.v_y, w->elastic.joints.v_z, y_dot);
        cage_elastic_acceleration(model, y, w, y_dot);
    } else
        friction_rates(w->v_jy, w->v_jz, y_dot);
}

void cage_loads(const Model *model, const Work *w, JointLoads *load)
{
    (model->modes ? cage_elastic_rivets : two_half_loads)(model, w, load);
}

#ifndef DUAL
void cage_split(const Model *model, const double *y, const Work *w, double *f, CageMemory *memory)
{
    memory->fast.omega_2 = cage_elastic_speed_2(w);
    if (!model->modes) return;
    cage_substeps_split(model, y, w, f, &memory->fast);
    pocket_films_split(model, w, &memory->pockets);
    memset(memory->films.rates, 0, sizeof memory->films.rates);
    for (int h = 0; h < 2; h++)
        for (int i = 0; i < RIM; i++) memory->films.force[h][i] = w->pressure[h].rim_force[i];
    rim_push(model, -1.0, memory->films.force, &f[Y_MODE_S_DOT]);
}

void cage_advance(const Model *model, double h, const double *y_0, const double *f, const CageMemory *memory,
                  const double *middle, double *y, CageStep *step, Work *w)
{
    halves_kinematics(model, middle, w);
    for (int i = 0; i < 2; i++)
        y[Y_CAGE_PSI + i] = y_0[Y_CAGE_PSI + i] + h * (w->half[i].s - rotor_roll(&w->half[i]));
    cage_joint_kinematics(model, w);
    step->gamma = 0.5 * h;
    step->axial = step->shear = 0.0;
    memset(&step->joints, 0, sizeof step->joints);
    memset(step->rim_lack, 0, sizeof step->rim_lack);
    memset(step->bent, 0, sizeof step->bent);
    memset(step->squeeze, 0, sizeof step->squeeze);
    if (!model->modes) {
        for (int k = 0; k < LANES; k++)
            step->joints.way_y[k] = h * w->v_jy[k], step->joints.way_z[k] = h * w->v_jz[k];
        memcpy(step->joints.before, &y[Y_JOINT_PLATE_Y], sizeof step->joints.before);
        cage_joint_follow(h, w->v_jy, w->v_jz, y);
        return;
    }
    memcpy(&y[Y_MODE_S], &y_0[Y_MODE_S], (N_ALL_STATES - Y_MODE_S) * sizeof *y);
    for (int i = 0; i < 2; i++) {
        double *by = w->squeeze_by[i];
        by[0] = by[1] = step->gamma * land_mobility(model, land_lever(model, i));
        for (int k = 0; k < RIM; k++) by[2 + k] = step->gamma * model->modes->mobility[k];
    }
    RimFilmsStep films;
    const bool follow = rim_films_begin(model, h, &memory->films, &films);
    rim_push(model, step->gamma, films.held, &y[Y_MODE_S_DOT]);
    pocket_films_find(model, h, &memory->pockets, f, middle, y, w, &step->pockets);
    cage_substeps_advance(model, h, &memory->fast, f, middle, y, &step->foreseen, &step->joints,
                          follow ? &films : NULL, &step->pockets, w);
    memcpy(step->rim_held, films.held, sizeof step->rim_held);
    for (int i = 0; i < 2; i++)
        for (int k = 0; k < RIM; k++) {
            const double force = memory->films.force[i][k];
            step->rim_before[i][k] = films.follows[i] ? films.impulse[i][k] / step->gamma - force : force;
        }
}

void cage_predict(const Model *model, CageStep *step, double *y)
{
    if (model->modes) rim_push(model, step->gamma, step->rim_held, &y[Y_MODE_S_DOT]);
}

// Friction states follow what the joints' places have moved by, not their velocities: these would leave them behind by 0.1 nm
// a step, which a turning load adds up to micrometres.
static void follow_places(const FastState *before, const FastState *now, JointStep *step, double *y)
{
    for (int k = 0; k < Z; k++) {
        const double more_y = now->u_y[k] - before->u_y[k] - step->way_y[k],
                     more_z = now->u_z[k] - before->u_z[k] - step->way_z[k];
        y[Y_JOINT_PLATE_Y + k] += more_y, y[Y_JOINT_PLATE_Z + k] += more_z;
        step->way_y[k] += more_y, step->way_z[k] += more_z;
    }
}

void cage_arrive(const Model *model, const Work *w, CageStep *step, const CageMemory *before, double *y,
                 double *f, CageMemory *memory)
{
    cage_split(model, y, w, f, memory);
    if (model->modes) {
        follow_places(&before->fast, &memory->fast, &step->joints, y);
        f[Y_WORK] += pocket_films_arrive(model, step->gamma, &step->pockets, &before->pockets, y, w, f,
                                         &memory->pockets);
    }
    if (!lands_bend(model)) return;
    double lack[2 * N_MODES];
    for (int i = 0; i < 2 * N_MODES; i++) lack[i] = f[Y_MODE_S_DOT + i] - step->foreseen.modes[i];
    rim_motions(model, lack, step->rim_lack);
    memcpy(step->squeeze, before->squeeze, sizeof step->squeeze);
    for (int h = 0; h < 2; h++)
        for (int i = 0; i < RIM; i++)
            step->rim_lack[h][i] +=
                model->modes->mobility[i] * (memory->films.force[h][i] - step->rim_before[h][i]);
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

// v = (1 + gamma A)^-1 v of a half and its bent rim, by the law at the end of the step (land_bent.c).
static void solve_bent_half(const Work *w, int h, const HalfFilm *f, CageStep *step, HalfVelocity *half)
{
    const double gamma = step->gamma, *b_y = w->half[h].b_y, *b_z = w->half[h].b_z;
    BentSolution *bent = &step->bent[h];
    const double u_y = half->y + half->gamma * f->x, u_z = half->z - half->beta * f->x;
    double residual[SQUEEZE] = {b_y[1] * u_y + b_y[2] * u_z, b_z[1] * u_y + b_z[2] * u_z};
    for (int i = 0; i < RIM; i++) residual[2 + i] = gamma * step->rim_lack[h][i];
    bent_solve(w, h, gamma, residual, step->squeeze[h], bent);
    const double *impulse = bent->impulse;
    half_push_land(f, b_y[1] * impulse[0] + b_z[1] * impulse[1], b_y[2] * impulse[0] + b_z[2] * impulse[1],
                   half);
    for (int i = 0; i < SQUEEZE; i++) half->s -= impulse[i] * w->pressure[h].by_spin[i] / f->J_p;
    half->s /= 1.0 + f->spin;
}

void cage_solve(const Model *model, const Work *w, double gamma, CageStep *step, double *v)
{
    HalfFilm f[2];
    HalfVelocity half[2];
    for (int h = 0; h < 2; h++) {
        half[h] = half_velocity_load(v, h);
        f[h] = half_film(model, &w->film[h], h, gamma);
        if (lands_bend(model))
            solve_bent_half(w, h, &f[h], step, &half[h]);
        else
            half_film_solve(&f[h], &half[h]);
    }
    if (!model->modes) step->axial = two_half_solve(model, w, gamma, f, half);
    for (int h = 0; h < 2; h++) half_velocity_store(&half[h], v, h);
}

void cage_finish(const Model *model, const CageStep *step, double *y, const double *f_end, CageMemory *memory,
                 Work *w)
{
    if (!model->modes) return;
    memset(w->squeeze_by, 0, sizeof w->squeeze_by);
    memcpy(memory->squeeze, step->squeeze, sizeof memory->squeeze);
    const double gamma = step->gamma;
    double change[2][RIM];
    for (int h = 0; h < 2; h++) {
        for (int i = 0; i < RIM; i++) {
            memory->films.force[h][i] -= step->bent[h].impulse[2 + i] / gamma;
            change[h][i] = memory->films.force[h][i] - step->rim_before[h][i];
        }
        memcpy(memory->films.rates[h], step->bent[h].rates, sizeof memory->films.rates[h]);
    }
    for (int i = 0; i < 2 * N_MODES; i++)
        y[Y_MODE_S_DOT + i] += gamma * (f_end[Y_MODE_S_DOT + i] - step->foreseen.modes[i]);
    rim_push(model, gamma, change, &y[Y_MODE_S_DOT]);
}

// Maps the friction states in y back under the loads in w, from step->before.
static void slide(const Model *model, double *y, JointStep *step, Work *w)
{
    const ElasticJoints *elastic = &w->elastic.joints;
    const TwoHalfWork *rigid = &w->two_half;
    const JointStiffness k_in = model->modes ? cage_elastic_stiffness(model) : two_half_stiffness(model->d);
    if (model->modes)
        y[Y_WORK] -= cage_joint_slide(model, &k_in, elastic->rivet[0], elastic->N_plate, y, step);
    else
        y[Y_WORK] -= cage_joint_slide(model, &k_in, rigid->rivet[0], rigid->N_plate, y, step);
    memcpy(w->joint_rubbed, step->rubbed, sizeof w->joint_rubbed);
}

void cage_correct(const Model *model, double gamma, const double *delta, double *y, CageStep *step, Work *w)
{
    if (!model->modes) two_half_correct(model, w, gamma, step->axial, step->shear, delta, y, &step->joints);
    slide(model, y, &step->joints, w);
}

void cage_slide(const Model *model, const double *before, double *y, Work *w)
{
    JointStep step = {0};
    memcpy(step.before, &before[Y_JOINT_PLATE_Y], sizeof step.before);
    slide(model, y, &step, w);
}

// Part of the second difference of the slow accelerations of D that is taken away.  Joints that stick do not damp the vibrations in
// the plane of the split; one that turns by pi in a step would grow by forces that are held.
static const double SMOOTHING = 0.15;

void cage_remember(const Model *model, double h, double h_0, const double *restrict f,
                   const double *restrict jerk, const double *restrict y, double *restrict f_end,
                   double *restrict jerk_end, double *restrict error)
{
    if (!model->modes) return;
    const double inv_h = 1.0 / h, second = h * h * (2.0 / (h + h_0));
    for (int i = Y_MODE_S_DOT; i < N_ALL_STATES; i++) {
        const double difference = second * ((f_end[i] - f[i]) * inv_h - jerk[i]);
        error[i] = (h / 12.0) * difference;
        if (i >= Y_MODE_D_DOT) f_end[i] -= SMOOTHING * difference;
        jerk_end[i] = (f_end[i] - f[i]) * inv_h;
    }
    memcpy(&f_end[Y_MODE_S], &y[Y_MODE_S_DOT], 2 * N_MODES * sizeof *error);
    memset(&jerk_end[Y_MODE_S], 0, 2 * N_MODES * sizeof *error);
    memset(&error[Y_MODE_S], 0, 2 * N_MODES * sizeof *error);
}
#endif
