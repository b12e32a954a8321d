// Films of oil between balls and the walls of elastic halves within a step: forces F = D u, u > 0 the speed at which a gap closes.
//
// D is up to 1000 N.s/m, and a wall weighs some grams for what happens in a step, so that D over that mass is up to 30 times 1/h.
// Held over a step, such forces feed the walls' vibrations.  So they follow in the substeps, implicit, one by one:
//
//     u = r + b (t - h/2) - U.v - g.V       r, b: rate in the middle of the step and acceleration of the rigid approach by slow
//                                           forces; v, V: velocities of the wall's modes and of the half by all others
//     F = D (u + Y d F_0)/(1 + d Y D)       at the end of a substep of length d, not below 0: the film cavitates; F_0: at the
//                                           step's start, which the slow forces have
//     v += (U/m) d (F - F_0),   V += g d (F - F_0)/inertia,   Y = U.U/m + g.g/inertia
//
// At the end of the step the evaluation has F = D u of the predicted velocities.  What the trapezoidal rule makes of it is implicit too:
//
//     F_{n+1} = D (u + Y gamma F_f)/(1 + gamma Y D),   F_f: force at the end as the substeps foresaw it
//
// The evaluation's rates lose the difference.  D and direction are those of the step's start in the substeps.  The ball's own rate by D is in
// the matrix of implicit.c.
#include "cage/elastic/pocket_films.h"

#include "cage/elastic/elastic_half.h"
#include "cage/elastic/wall_loads.h"

// Films with less than this for h Y D are left as they are: slow forces.
static const double WEAK = 0.05;

static const double ROOT_HALF = 0.70710678118654752;

void pocket_films_split(const Model *model, const Work *w, PocketFilms *films)
{
    memset(films, 0, sizeof *films);
    if (!model->d->squeeze.filled) return;
    for (int h = 0; h < 2; h++)
        for (int k = 0; k < Z; k++) {
            const double D = w->elastic.film_D[h][k], u = w->elastic.film_u[h][k];
            if (!(D > 0.0)) continue;
            films->D[h][k] = D, films->u[h][k] = u, films->F[h][k] = D * fmax(u, 0.0);
            films->m_x[h][k] = w->elastic.film_m[0][h][k];
            films->m_r[h][k] = w->elastic.film_m[1][h][k];
            films->m_t[h][k] = w->elastic.film_m[2][h][k];
            memcpy(films->shape[h][k], w->elastic.film_shape[h][k], sizeof films->shape[h][k]);
        }
}

// Rate and acceleration of one lane's approach, motion along m by velocities of the half.
static void take_lane(const RigidApproach *approach, int lane, double along[RELATIVE_MOTIONS])
{
    for (int i = 0; i < RELATIVE_MOTIONS; i++) along[i] = approach->along[i][lane];
}

// Velocity of the wall along m by an impulse of 1 N.s on it.
static double mobility_of(const Model *model, int h, const double *shape, const double along[RELATIVE_MOTIONS])
{
    const double *inertia = &model->d->inertia[Y_CAGE_V_X + h];
    double by_modes = 0.0, by_half = 0.0;
    for (int i = 0; i < N_MODES; i++) by_modes += shape[i] * shape[i];
    for (int i = 0; i < RELATIVE_MOTIONS; i++) by_half += along[i] * along[i] / inertia[2 * i];
    return by_modes / model->p->cage.m + by_half;
}

void pocket_films_find(const Model *model, double h, const PocketFilms *films, const double *f,
                       const double *state, const double *y, const Work *w, PocketFilmsStep *step)
{
    step->count = 0;
    step->middle = 0.5 * h;
    if (!model->d->squeeze.filled) return;
    for (int half = 0; half < 2; half++)
        for (int j = 0; j < PACKETS * LANE_WIDTH; j += LANE_WIDTH) {
            const int mask = wide_mask(wide_above(wide_load(&films->D[half][j]), 0.0));
            RigidApproach approach;
            if (mask == 0) continue;
            const double *const m[3] = {films->m_x[half], films->m_r[half], films->m_t[half]};
            rigid_approach(model, step->middle, m, f, state, y, w, half, j, &approach);
            for (int lane = 0; lane < LANE_WIDTH && j + lane < Z; lane++) {
                const int k = j + lane, i = step->count;
                if (!(mask >> lane & 1)) continue;
                take_lane(&approach, lane, step->along[i]);
                const double mobility = mobility_of(model, half, films->shape[half][k], step->along[i]);
                if (h * mobility * films->D[half][k] < WEAK) continue;
                step->half[i] = half, step->ball[i] = k, step->mobility[i] = mobility;
                step->D[i] = films->D[half][k], step->F_0[i] = step->F[i] = films->F[half][k];
                step->rate[i] = approach.rate[lane], step->acceleration[i] = approach.acceleration[lane];
                memset(step->shape[i], 0, sizeof step->shape[i]);
                memcpy(step->shape[i], films->shape[half][k], sizeof films->shape[half][k]);
                step->count++;
            }
        }
}

// Velocities of both halves' modes by those of S and D, and back.
static void to_half_modes(const double *v, mode_array half[2])
{
    for (int i = 0; i < N_MODES; i++) {
        half[0][i] = ROOT_HALF * (v[i] - v[N_MODES + i]);
        half[1][i] = ROOT_HALF * (v[i] + v[N_MODES + i]);
    }
}

static void add_half_modes(mode_array half[2], double *v)
{
    for (int i = 0; i < N_MODES; i++) {
        v[i] += ROOT_HALF * (half[1][i] + half[0][i]);
        v[N_MODES + i] += ROOT_HALF * (half[1][i] - half[0][i]);
    }
}

// Velocity of a wall by velocities of its half's modes and of the half.
static double wall_speed(const double *shape, const double *modes, const double along[RELATIVE_MOTIONS],
                         const double *rows)
{
    double sum = elastic_sum(shape, modes);
    for (int i = 0; i < RELATIVE_MOTIONS; i++) sum += along[i] * rows[2 * i];
    return sum;
}

// Adds an impulse [N.s] on a wall to these velocities.
static void push_wall(const Model *model, int h, double impulse, const double *shape,
                      const double along[RELATIVE_MOTIONS], double *modes, double *rows)
{
    const double *inertia = &model->d->inertia[Y_CAGE_V_X + h], part = impulse / model->p->cage.m;
    for (int i = 0; i < N_MODES; i++) modes[i] += part * shape[i];
    for (int i = 0; i < RELATIVE_MOTIONS; i++) rows[2 * i] += impulse * along[i] / inertia[2 * i];
}

// Force of a film whose gap closes with u under the force F_0, over the time d.
static double implicit_force(double D, double u, double mobility, double d, double F_0)
{
    return D * fmax(u + mobility * d * F_0, 0.0) / (1.0 + d * mobility * D);
}

void pocket_films_follow(const Model *model, double t, double d, double *v, double halves[2 * RELATIVE_MOTIONS],
                         double pushed[2 * RELATIVE_MOTIONS], PocketFilmsStep *step)
{
    mode_array modes[2], change[2];
    double rows[2 * RELATIVE_MOTIONS] = {0.0};
    if (step->count == 0) return;
    to_half_modes(v, modes);
    memset(change, 0, sizeof change);
    for (int i = 0; i < step->count; i++) {
        const int h = step->half[i];
        double u = step->rate[i] + step->acceleration[i] * (t - step->middle);
        u -= wall_speed(step->shape[i], modes[h], step->along[i], &halves[h]);
        u -= wall_speed(step->shape[i], change[h], step->along[i], &rows[h]);
        step->F[i] = implicit_force(step->D[i], u, step->mobility[i], d, step->F_0[i]);
        push_wall(model, h, d * (step->F[i] - step->F_0[i]), step->shape[i], step->along[i], change[h], &rows[h]);
    }
    add_half_modes(change, v);
    for (int i = 0; i < 2 * RELATIVE_MOTIONS; i++) pushed[i] += rows[i];
}

void pocket_films_foreseen(const Model *model, const PocketFilmsStep *step, double modes[2 * N_MODES],
                           double halves[2 * RELATIVE_MOTIONS])
{
    mode_array change[2];
    if (step->count == 0) return;
    memset(change, 0, sizeof change);
    for (int i = 0; i < step->count; i++) {
        const int h = step->half[i];
        push_wall(model, h, step->F[i] - step->F_0[i], step->shape[i], step->along[i], change[h], &halves[h]);
    }
    add_half_modes(change, modes);
}

double pocket_films_arrive(const Model *model, double gamma, const PocketFilmsStep *step,
                           const PocketFilms *before, const double *y, const Work *w, double *f,
                           PocketFilms *films)
{
    double foreseen[2][LANES] = {{0.0}}, rows[2 * RELATIVE_MOTIONS] = {0.0}, saved = 0.0;
    double more_rows[2 * RELATIVE_MOTIONS] = {0.0};
    mode_array change[2], more[2];
    if (!model->d->squeeze.filled) return 0.0;
    memset(change, 0, sizeof change);
    memset(more, 0, sizeof more);
    bool follows[2][LANES] = {{false}};
    for (int i = 0; i < step->count; i++) {
        foreseen[step->half[i]][step->ball[i]] = step->F[i];
        follows[step->half[i]][step->ball[i]] = true;
    }
    for (int h = 0; h < 2; h++)
        for (int j = 0; j < PACKETS * LANE_WIDTH; j += LANE_WIDTH) {
            const int mask = wide_mask(wide_above(wide_load(&films->D[h][j]), 0.0));
            RigidApproach approach;
            if (mask == 0) continue;
            const double *const m[3] = {films->m_x[h], films->m_r[h], films->m_t[h]};
            rigid_approach(model, 0.0, m, f, y, y, w, h, j, &approach);
            for (int lane = 0; lane < LANE_WIDTH && j + lane < Z; lane++) {
                const int k = j + lane;
                const double D = films->D[h][k], *shape = films->shape[h][k];
                double along[RELATIVE_MOTIONS];
                if (!(mask >> lane & 1)) continue;
                take_lane(&approach, lane, along);
                const double mobility = mobility_of(model, h, shape, along);
                films->rate = fmax(films->rate, mobility * D);
                if (!follows[h][k] && 2.0 * gamma * mobility * D < WEAK) continue;
                mode_array wall;
                memset(wall, 0, sizeof wall);
                memcpy(wall, shape, sizeof films->shape[h][k]);
                const double u = films->u[h][k] - wall_speed(wall, change[h], along, &rows[h]);
                const double F_0 = follows[h][k] ? foreseen[h][k] : before->F[h][k];
                const double F = implicit_force(D, u, mobility, gamma, F_0), impulse = gamma * (F - F_0);
                push_wall(model, h, impulse, shape, along, change[h], &rows[h]);
                push_wall(model, h, F - films->F[h][k], shape, along, more[h], &more_rows[h]);
                saved += films->F[h][k] * films->u[h][k] - F * (u - mobility * impulse);
                films->F[h][k] = F;
            }
        }
    add_half_modes(more, &f[Y_MODE_S_DOT]);
    for (int i = 0; i < 2 * RELATIVE_MOTIONS; i++) f[Y_CAGE_V_X + i] += more_rows[i];
    return saved;
}
