// Films of oil between balls and both halves within a step: forces F = D u, u > 0 the speed at which a gap closes.
//
// D is up to 1000 N.s/m, and the effective mass of an elastic wall within a step is some grams, so that D over that mass is up to 30 times
// 1/h.  Held over a step, such forces feed the walls' vibrations.  So the forces follow in the substeps, implicit, one by one:
//
//     u = r + b (t - h/2) - U.v - g.V       r, b: rate in the middle of the step and acceleration of the rigid approach by slow
//                                           forces; v, V: velocities of the wall's modes and of the half by all others
//     F = D (u + Y d F_0)/(1 + d Y D)       at the end of a substep of length d, not below 0: the film cavitates; F_0: at the
//                                           step's start, which the slow forces have
//     v += (U/m) d (F - F_0),   V += g d (F - F_0)/inertia,   Y = U.U/m + g.g/inertia
//
// Rigid halves have no substeps, and nothing of the modes: F = F_0 so far.
//
// At the end of the step the evaluation has F = D u of the predicted velocities.  Wall, half and ball get the same impulse there,
// gamma (F_n + F_{n+1}) by the trapezoidal rule, with F_{n+1} implicit in the velocities of all three:
//
//     F_{n+1} = D (u + gamma (Y F_f + Y_b F_n))/(1 + gamma (Y + Y_b) D),   Y_b = 1/m of the ball
//
// F_f: force at the end that with F_n makes the impulses of the substeps.  The excess of F = D u is taken off the evaluation's rates.  D and
// direction are those of the step's start in the substeps.  Films whose D is small for the longest step stay slow forces.
#include "cage/common/pocket_films.h"

#include "cage/common/rigid_approach.h"
#include "cage/elastic/elastic_half.h"
#include "physics/rotor.h"

// Damping below which a film stays a slow force [N.s/m].
static double weak_film(const Model *model)
{
    return model->modes ? model->modes->weak_film : 0.0;
}

void pocket_films_split(const Model *model, const Work *w, PocketFilms *films)
{
    const FilmWork *at = &w->cage.films;
    memset(films->D, 0, sizeof films->D);
    memset(films->F, 0, sizeof films->F);
    films->rate = 0.0;
    if (!model->d->squeeze.filled) return;
    for (int h = 0; h < 2; h++)
        for (int k = 0; k < Z; k++) {
            const double D = at->D[h][k], u = at->u[h][k];
            films->F[h][k] = D * fmax(u, 0.0);
            if (!(D > weak_film(model))) continue;
            films->D[h][k] = D, films->u[h][k] = u;
            films->m_x[h][k] = at->m[0][h][k], films->m_r[h][k] = at->m[1][h][k],
            films->m_t[h][k] = at->m[2][h][k];
            if (model->modes) memcpy(films->shape[h][k], at->shape[h][k], sizeof films->shape[h][k]);
        }
}

// Velocity of the wall along m by an impulse of 1 N.s on it.
static double mobility_of(const Model *model, const PocketFilm *film)
{
    const double *inertia = &model->d->inertia[Y_CAGE_V_X + film->h];
    double by_modes = 0.0, by_half = 0.0;
    for (int i = 0; model->modes && i < N_MODES; i++) by_modes += film->shape[i] * film->shape[i];
    for (int i = 0; i < RELATIVE_MOTIONS; i++) by_half += film->along[i] * film->along[i] / inertia[2 * i];
    return by_modes / model->p->cage.m + by_half;
}

// The films of both halves under the rates f, whose approach is that at the time gamma before the positions y; state: velocities there.
// Returns how many there are.
static int find_films(const Model *model, double gamma, const PocketFilms *films, const double *f,
                      const double *state, const double *y, const Work *w, PocketFilm found[2 * Z])
{
    int count = 0;
    for (int h = 0; h < 2; h++)
        for (int j = 0; j < PACKETS * LANE_WIDTH; j += LANE_WIDTH) {
            const int mask = wide_mask(wide_above(wide_load(&films->D[h][j]), 0.0));
            RigidApproach approach;
            if (mask == 0) continue;
            const double *const m[3] = {films->m_x[h], films->m_r[h], films->m_t[h]};
            rigid_approach(model, gamma, m, f, state, y, w, h, j, &approach);
            for (int lane = 0; lane < LANE_WIDTH && j + lane < Z; lane++) {
                const int k = j + lane;
                if (!(mask >> lane & 1)) continue;
                PocketFilm *film = &found[count++];
                const double F = films->F[h][k];
                *film = (PocketFilm){.h = h, .k = k, .D = films->D[h][k], .F_0 = F, .F = F};
                film->rate = approach.rate[lane], film->acceleration = approach.acceleration[lane];
                for (int i = 0; i < RELATIVE_MOTIONS; i++) film->along[i] = approach.along[i][lane];
                for (int i = 0; i < 3; i++) film->direction[i] = approach.direction[i][lane];
                memcpy(film->shape, films->shape[h][k], sizeof films->shape[h][k]);
                film->mobility = mobility_of(model, film);
            }
        }
    return count;
}

void pocket_films_find(const Model *model, double h, const PocketFilms *films, const double *f,
                       const double *state, const double *y, const Work *w, PocketFilmsStep *step)
{
    step->middle = 0.5 * h;
    step->count =
        model->d->squeeze.filled ? find_films(model, step->middle, films, f, state, y, w, step->film) : 0;
}

// Adds velocities of both halves' modes to those of S and D.
static void add_half_modes(mode_array half[2], double *v)
{
    for (int i = 0; i < N_MODES; i++) {
        v[i] += ROOT_HALF * (half[1][i] + half[0][i]);
        v[N_MODES + i] += ROOT_HALF * (half[1][i] - half[0][i]);
    }
}

// Velocity of a wall by velocities of its half's modes and of the half.
static double wall_speed(const Model *model, const PocketFilm *film, const double *modes, const double *rows)
{
    double sum = model->modes ? elastic_sum(film->shape, modes) : 0.0;
    for (int i = 0; i < RELATIVE_MOTIONS; i++) sum += film->along[i] * rows[2 * i];
    return sum;
}

// Adds an impulse [N.s] on a wall to these velocities.
static void push_wall(const Model *model, const PocketFilm *film, double impulse, double *modes, double *rows)
{
    const double *inertia = &model->d->inertia[Y_CAGE_V_X + film->h], part = impulse / model->p->cage.m;
    for (int i = 0; model->modes && i < N_MODES; i++) modes[i] += part * film->shape[i];
    for (int i = 0; i < RELATIVE_MOTIONS; i++) rows[2 * i] += impulse * film->along[i] / inertia[2 * i];
}

// Force of a film whose gap closes with u less `give` times the force.
static double implicit_force(double D, double u, double give)
{
    return D * fmax(u, 0.0) / (1.0 + give * D);
}

void pocket_films_follow(const Model *model, double t, double d, double *v,
                         double halves[2 * RELATIVE_MOTIONS], double pushed[2 * RELATIVE_MOTIONS],
                         PocketFilmsStep *step)
{
    mode_array modes[2], change[2];
    double rows[2 * RELATIVE_MOTIONS] = {0.0};
    if (step->count == 0) return;
    for (int i = 0; i < N_MODES; i++) {
        modes[0][i] = ROOT_HALF * (v[i] - v[N_MODES + i]);
        modes[1][i] = ROOT_HALF * (v[i] + v[N_MODES + i]);
    }
    memset(change, 0, sizeof change);
    for (PocketFilm *film = step->film; film < step->film + step->count; film++) {
        const int h = film->h;
        double u = film->rate + film->acceleration * (t - step->middle);
        u -= wall_speed(model, film, modes[h], &halves[h]);
        u -= wall_speed(model, film, change[h], &rows[h]);
        film->F = implicit_force(film->D, u + film->mobility * d * film->F_0, d * film->mobility);
        film->impulse += d * film->F;
        push_wall(model, film, d * (film->F - film->F_0), change[h], &rows[h]);
    }
    add_half_modes(change, v);
    for (int i = 0; i < 2 * RELATIVE_MOTIONS; i++) pushed[i] += rows[i];
}

// Force at the step's end that, with that at its start, makes the impulses of the substeps.
static double foreseen_force(const PocketFilmsStep *step, const PocketFilm *film)
{
    return film->impulse / step->middle - film->F_0;
}

void pocket_films_foreseen(const Model *model, const PocketFilmsStep *step, double modes[2 * N_MODES],
                           double halves[2 * RELATIVE_MOTIONS])
{
    mode_array change[2];
    if (step->count == 0) return;
    memset(change, 0, sizeof change);
    for (const PocketFilm *film = step->film; film < step->film + step->count; film++)
        push_wall(model, film, foreseen_force(step, film) - film->F_0, change[film->h], &halves[film->h]);
    add_half_modes(change, modes);
}

// Velocities that the solution adds to those of the evaluation, or rates: of the modes, of the halves, of the balls.
typedef struct {
    mode_array modes[2];
    double halves[2 * RELATIVE_MOTIONS], balls[Z][3];
} FilmChange;

// Adds an impulse on a wall, and another one against it on the ball.
static void push_both(const Model *model, const PocketFilm *film, double on_wall, double on_ball,
                      FilmChange *to)
{
    push_wall(model, film, on_wall, to->modes[film->h], &to->halves[film->h]);
    for (int i = 0; i < 3; i++) to->balls[film->k][i] -= on_ball / model->d->m * film->direction[i];
}

// Solves for the force of one film at a step's end, which both changes get; returns the power that it saves [W].
static double solve_film(const Model *model, double gamma, const PocketFilm *film, double F_0, double F_f,
                         FilmChange *solved, FilmChange *rates, PocketFilms *films, Work *w)
{
    const int h = film->h, k = film->k;
    const double D = film->D, F = film->F_0, of_wall = film->mobility;  // F: of the evaluation
    const double of_ball = dot3(film->direction, film->direction) / model->d->m;
    double u = films->u[h][k] + dot3(film->direction, solved->balls[k]);
    u -= wall_speed(model, film, solved->modes[h], &solved->halves[h]);
    const double push = gamma * (of_wall * F_f + of_ball * F_0);
    const double F_new = implicit_force(D, u + push, gamma * (of_wall + of_ball));
    push_both(model, film, gamma * (F_new - F_f), gamma * (F_new - F_0), solved);
    push_both(model, film, F_new - F, F_new - F, rates);
    pocket_films_add(films, h, k, F_new - F, w);
    u -= gamma * (of_wall * (F_new - F_f) + of_ball * (F_new - F_0));
    films->F[h][k] = F_new;
    if (model->modes)
        films->rate = fmax(films->rate, D * (model->d->guided ? model->modes->wall_mobility : of_wall));
    return F * films->u[h][k] - F_new * u;
}

static void add_rates(const Model *model, FilmChange *rates, const double *y, double *f)
{
    if (model->modes) add_half_modes(rates->modes, &f[Y_MODE_S_DOT]);
    for (int i = 0; i < 2 * RELATIVE_MOTIONS; i++) f[Y_CAGE_V_X + i] += rates->halves[i];
    for (int k = 0; k < Z; k++) {
        f[Y_BALL_V_X + k] += rates->balls[k][0];
        f[Y_BALL_V_R + k] += rates->balls[k][1];
        f[Y_BALL_OMEGA_M + k] += rates->balls[k][2] / y[Y_BALL_R + k];
    }
}

double pocket_films_arrive(const Model *model, double gamma, const PocketFilmsStep *step,
                           const PocketFilms *before, const double *y, Work *w, double *f, PocketFilms *films)
{
    FilmChange solved, rates;
    PocketFilm end[2 * Z];
    double foreseen[2][LANES], saved = 0.0;
    if (!model->d->squeeze.filled) return 0.0;
    memset(&solved, 0, sizeof solved);
    memset(&rates, 0, sizeof rates);
    memcpy(foreseen, before->F, sizeof foreseen);
    for (int i = 0; step && i < step->count; i++)
        foreseen[step->film[i].h][step->film[i].k] = foreseen_force(step, &step->film[i]);
    const int count = find_films(model, 0.0, films, f, y, y, w, end);
    for (const PocketFilm *film = end; film < end + count; film++)
        saved += solve_film(model, gamma, film, before->F[film->h][film->k], foreseen[film->h][film->k],
                            &solved, &rates, films, w);
    add_rates(model, &rates, y, f);
    return saved;
}
