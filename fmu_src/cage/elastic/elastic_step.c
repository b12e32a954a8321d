// A step of elastic halves.  elastic_begin, before the evaluation at the end:
//
//   halves in the middle; substeps of modes, joints, films and loads on walls (cage_substeps.c) under the slow
//   accelerations a_s of the start; predicted velocities v^, and gamma times the forces of the films on bent rims
//
// elastic_end, after it:
//
//   the rates lose the part that the halves advance by themselves; friction states follow the places of the joints
//   (1 + gamma A) delta = gamma (a^ - a_n - foreseen changes) + removed      A: films of the lands; of bent rims Newton's method
//   v_{n+1} = v^ + delta; the modes' velocities v_{n+1} = v + gamma (a_{s,n+1} - a_s); friction slips; history and errors
#include "cage/elastic/elastic_step.h"

#include "cage/common/films.h"
#include "cage/elastic/cage_elastic.h"
#include "cage/elastic/elastic_half.h"
#include "physics/land_bent.h"

void elastic_split(const Model *model, const double *y, const Work *w, double *f, ElasticMemory *memory)
{
    cage_substeps_split(model, y, w, f, &memory->fast);
    memset(memory->films.rates, 0, sizeof memory->films.rates);
    memory->films.stiffness = fmax(w->pressure[0].stiffness, w->pressure[1].stiffness);
    for (int h = 0; h < 2; h++) {
        memcpy(memory->force[h], w->pressure[h].film, sizeof memory->force[h]);
        for (int i = 0; i < RIM; i++) memory->films.force[h][i] = w->pressure[h].rim_force[i];
    }
    rim_push(model, -1.0, memory->films.force, &f[Y_MODE_S_DOT]);
}

// The evaluation at the end foresees by how much a film's own force changes its squeeze velocities in half a step.
static void foresee_films(const Model *model, double gamma, const ElasticMemory *memory, Work *w)
{
    memcpy(w->squeeze_from, memory->force, sizeof w->squeeze_from);
    for (int i = 0; i < 2; i++) {
        double *by = w->squeeze_by[i];
        by[0] = by[1] = gamma * land_mobility(model, land_lever(model, i));
        for (int k = 0; k < RIM; k++) by[2 + k] = gamma * model->modes->mobility[k];
    }
}

void elastic_begin(const Model *model, double h, const StepFrom *from, const HalvesMemory *at,
                   const ElasticMemory *memory, const double *middle, double *y, HalvesStep *halves,
                   ElasticStep *step, Work *w)
{
    halves_move(model, h, from, middle, y, halves, w);
    const double gamma = halves->gamma;
    memcpy(&y[Y_MODE_S], &from->y[Y_MODE_S], (N_ALL_STATES - Y_MODE_S) * sizeof *y);
    foresee_films(model, gamma, memory, w);

    // Substeps.
    RimFilmsStep films = {.films = &memory->films};
    pocket_films_find(model, h, &at->pockets, from->f, middle, y, w, &step->pockets);
    cage_substeps_advance(model, h, &memory->fast, from->f, middle, y, &step->foreseen, &halves->joints,
                          lands_bend(model) ? &films : NULL, &step->pockets, w);
    for (int i = 0; i < 2; i++)
        for (int k = 0; k < RIM; k++)
            step->rim_before[i][k] = films.impulse[i][k] / gamma - memory->films.force[i][k];

    // Predicted velocities.
    halves_predict(model, from, at->film, y, halves);
}

// Friction states follow the way of the joints' places, not their velocities: these would leave the states behind by 0.1 nm
// a step, which a turning load adds up to micrometres.
static void follow_places(const FastState *before, const FastState *now, JointStep *joints, double *y)
{
    for (int k = 0; k < Z; k++) {
        const double more_y = now->u_y[k] - before->u_y[k] - joints->way_y[k],
                     more_z = now->u_z[k] - before->u_z[k] - joints->way_z[k];
        y[Y_JOINT_PLATE_Y + k] += more_y, y[Y_JOINT_PLATE_Z + k] += more_z;
        joints->way_y[k] += more_y, joints->way_z[k] += more_z;
    }
}

// End minus predicted acceleration of each rim shape [m/s2].
static void rim_lacks(const Model *model, const ElasticStep *step, const double *f, const RimFilms *films,
                      double lack[2][RIM])
{
    double modes[2 * N_MODES];
    for (int i = 0; i < 2 * N_MODES; i++) modes[i] = f[Y_MODE_S_DOT + i] - step->foreseen.modes[i];
    rim_motions(model, modes, lack);
    for (int h = 0; h < 2; h++)
        for (int i = 0; i < RIM; i++)
            lack[h][i] += model->modes->mobility[i] * (films->force[h][i] - step->rim_before[h][i]);
}

// v = (1 + gamma A)^-1 v of a half and its bent rim, by the law at the end of the step (land_bent.c).
static void solve_bent_half(const Work *w, int h, double gamma, const HalfFilm *f, const double lack[RIM],
                            double squeeze[SQUEEZE], BentSolution *bent, double *v)
{
    const double *b_y = w->half[h].b_y, *b_z = w->half[h].b_z;
    const double u_y = v[Y_CAGE_V_Y + h] + v[Y_CAGE_GAMMA_DOT + h] * f->x,
                 u_z = v[Y_CAGE_V_Z + h] - v[Y_CAGE_BETA_DOT + h] * f->x;
    double residual[SQUEEZE] = {b_y[1] * u_y + b_y[2] * u_z, b_z[1] * u_y + b_z[2] * u_z};
    for (int i = 0; i < RIM; i++) residual[2 + i] = gamma * lack[i];
    bent_solve(w, h, gamma, residual, squeeze, bent);
    const double *impulse = bent->impulse;
    half_push_land(f, h, b_y[1] * impulse[0] + b_z[1] * impulse[1], b_y[2] * impulse[0] + b_z[2] * impulse[1],
                   v);
    for (int i = 0; i < SQUEEZE; i++) v[Y_CAGE_S + h] -= impulse[i] * w->pressure[h].by_spin[i] / f->J_p;
    v[Y_CAGE_S + h] /= 1.0 + f->spin;
}

// The velocities of both halves by their films, with those of bent rims.
static void solve_halves(const Model *model, const Work *w, double gamma, double lack[2][RIM],
                         double squeeze[2][SQUEEZE], BentSolution bent[2], double *v)
{
    for (int h = 0; h < 2; h++) {
        const HalfFilm f = half_film(model, &w->film[h], h, gamma);
        if (lands_bend(model))
            solve_bent_half(w, h, gamma, &f, lack[h], squeeze[h], &bent[h], v);
        else
            half_film_solve(&f, h, v);
    }
}

// Velocities of the modes at the end, with the forces on bent rims there.
static void correct_modes(const Model *model, double gamma, const ElasticStep *step,
                          const BentSolution bent[2], const double *f, RimFilms *films, double *y)
{
    double change[2][RIM];
    for (int h = 0; h < 2; h++) {
        for (int i = 0; i < RIM; i++) {
            films->force[h][i] -= bent[h].impulse[2 + i] / gamma;
            change[h][i] = films->force[h][i] - step->rim_before[h][i];
        }
        memcpy(films->rates[h], bent[h].rates, sizeof films->rates[h]);
    }
    for (int i = 0; i < 2 * N_MODES; i++)
        y[Y_MODE_S_DOT + i] += gamma * (f[Y_MODE_S_DOT + i] - step->foreseen.modes[i]);
    rim_push(model, gamma, change, &y[Y_MODE_S_DOT]);
}

// Rates of the modes, their history and their errors, without the films on bent rims.  Their slow accelerations are not smoothed: the
// delay would feed vibrations that turn by 2.3 to 4 in a step.  foreseen: those of the end by the substeps.
static void remember_modes(double h, double h_0, const double *restrict foreseen, const double *restrict jerk,
                           const double *restrict y, double *restrict f_end, double *restrict jerk_end,
                           double *restrict error)
{
    const double inv_h = 1.0 / h, second = h * h * (2.0 / (h + h_0));
    for (int i = Y_MODE_S_DOT; i < N_ALL_STATES; i++) {
        jerk_end[i] = (f_end[i] - foreseen[i - Y_MODE_S_DOT]) * inv_h;
        error[i] = (h / 12.0) * (second * (jerk_end[i] - jerk[i]));
    }
    memcpy(&f_end[Y_MODE_S], &y[Y_MODE_S_DOT], 2 * N_MODES * sizeof *error);
    memset(&jerk_end[Y_MODE_S], 0, 2 * N_MODES * sizeof *error);
    memset(&error[Y_MODE_S], 0, 2 * N_MODES * sizeof *error);
}

double elastic_end(const Model *model, HalvesStep *halves, const ElasticStep *step, const StepFrom *from,
                   const HalvesMemory *at, const ElasticMemory *before, const StepTo *to,
                   HalvesMemory *at_end, ElasticMemory *memory, Work *w)
{
    const double gamma = halves->gamma;
    double *y = to->y, *f = to->f, change[N_STATES], unforeseen[N_STATES], lack[2][RIM], power = 0.0;
    BentSolution bent[2];
    memset(bent, 0, sizeof bent);
    memset(memory->squeeze, 0, sizeof memory->squeeze);

    // The rates of the evaluation without the part of the substeps; films in pockets at the end's velocities.
    elastic_split(model, y, w, f, memory);
    follow_places(&before->fast, &memory->fast, &halves->joints, y);
    f[Y_WORK] += pocket_films_arrive(model, gamma, &step->pockets, &at->pockets, y, w, f, &at_end->pockets);
    if (lands_bend(model)) {
        rim_lacks(model, step, f, &memory->films, lack);
        memcpy(memory->squeeze, before->squeeze, sizeof memory->squeeze);
    }

    memcpy(to->balls, step->foreseen.balls, sizeof step->foreseen.balls);

    // The linear solve, and that of bent rims.
    halves_residual(halves, from, to);
    for (int i = 0; i < CAGE_MOTIONS; i++) to->residual[Y_CAGE_V_X + i] -= gamma * step->foreseen.halves[i];
    memcpy(&to->delta[Y_CAGE_V_X], &to->residual[Y_CAGE_V_X], CAGE_MOTIONS * sizeof *y);
    solve_halves(model, w, gamma, lack, memory->squeeze, bent, to->delta);
    if (lands_bend(model)) power = bent_arrive(model->d, gamma, bent, w);
    for (int h = 0; h < 2; h++) memcpy(memory->force[h], bent[h].film, sizeof memory->force[h]);

    // Velocities of halves and modes; friction.
    halves_correct(halves, to, unforeseen);
    memcpy(change, unforeseen, sizeof change);
    for (int i = 0; i < CAGE_MOTIONS; i++) change[Y_CAGE_V_X + i] += gamma * step->foreseen.halves[i];
    elastic_slide(model, y, &halves->joints, w);
    correct_modes(model, gamma, step, bent, f, &memory->films, y);

    // History and errors.  Where pockets hold oil the foreseen loads count as errors: films in pockets change with the velocities that
    // these loads change, which nothing else in the error shows.  Without them full pockets at 24,144 r/min have a 1.5 % too large RMS
    // force.  The evaluations behind foresee no films.
    memset(w->squeeze_by, 0, sizeof w->squeeze_by);
    memset(w->squeeze_from, 0, sizeof w->squeeze_from);
    halves_remember(model, w, halves, from, change, model->d->squeeze.filled ? change : unforeseen, to,
                    at_end->film);
    remember_modes(halves->h, from->h, step->foreseen.modes, from->jerk, y, f, to->jerk, to->error);
    return power;
}

void elastic_slide(const Model *model, double *y, JointStep *joints, Work *w)
{
    const JointStiffness k = cage_elastic_stiffness(model);
    halves_slide(model, &k, w->cage.elastic.joints.rivet[0], w->cage.elastic.joints.N_plate, y, joints, w);
}
