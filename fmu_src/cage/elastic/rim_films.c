// Films on bent rims within a step.
//
// The end of a step makes the impulses of a film on a rim those of the trapezoidal rule (land_bent.c).  Constant within the step, or at its
// ends alone, the film would feed vibrations of the rim, or leave it free between them.  So it follows in the substeps, linear about the
// step's start,
//
//     F(t) = F_n - D (u(t) - u_n)       u: velocities of the land (along its half's axes) and of the rim's shapes, D: rates
//     P = d F_n - (1 + d D Y)^-1 d D delta     over a substep d: implicit Euler, Y: mobilities, delta: u - u_n with d F_n alone
//
// Half of d F acts before the drift, with the F of the substep before, the rest of P after it, so that positions feel P in the middle.
// The land's velocity is foreseen,
//
//     u_land = u_n + t a_n + by the joints + Y sum (P - d F_n)      a_n: by slow forces, the film's F_n among them
//
// (a_n of the geometric centre: that of the centre of mass less d(Omega x c)/dt), and films leave the halves' own motion to the step's
// end.  Held there, a half would carry its rim along: at 0.5 degrees of tilt the 99.9 % pocket force would err by +3.4 %.  The step's
// end replaces the sum of P by gamma (F_n + F_{n+1}).
#include "cage/elastic/rim_films.h"

#include "cage/common/films.h"
#include "cage/elastic/elastic_half.h"
#include "physics/land_bent.h"

void rim_motions(const Model *model, const double *modes, double rim[2][RIM])
{
    double S[RIM], D[RIM];
    elastic_rims(model->modes, modes, modes + N_MODES, S, D);
    for (int i = 0; i < RIM; i++)
        rim[0][i] = ROOT_HALF * (S[i] - D[i]), rim[1][i] = ROOT_HALF * (S[i] + D[i]);
}

void rim_push(const Model *model, double part, double impulse[2][RIM], double *modes)
{
    const double scale = part * ROOT_HALF / model->p->cage.m;
    double S[RIM], D[RIM], size = 0.0;
    for (int c = 0; c < RIM; c++) {
        S[c] = scale * (impulse[1][c] + impulse[0][c]), D[c] = scale * (impulse[1][c] - impulse[0][c]);
        size += fabs(S[c]) + fabs(D[c]);
    }
    if (size == 0.0) return;
    for (int i = 0; i < N_MODES; i += LANE_WIDTH) {
        wide by_S = wide_load(&modes[i]), by_D = wide_load(&modes[N_MODES + i]);
        for (int c = 0; c < RIM; c++) {
            const wide shape = wide_load(&model->modes->rim[c][i]);
            by_S += S[c] * shape, by_D += D[c] * shape;
        }
        wide_store(&modes[i], by_S);
        wide_store(&modes[N_MODES + i], by_D);
    }
}

// answer = (1 + d D Y)^-1 d D.  D is symmetric and not negative, nor is the diagonal Y: Gauss's pivots are at least 1.
static void find_answer(double d, const double rates[SQUEEZE][SQUEEZE], const double mobility[SQUEEZE],
                        double answer[SQUEEZE][SQUEEZE])
{
    double A[SQUEEZE][SQUEEZE_ROW] = {{0.0}}, B[SQUEEZE][SQUEEZE_ROW] = {{0.0}};
    for (int i = 0; i < SQUEEZE; i++)
        for (int k = 0; k < SQUEEZE; k++) {
            B[i][k] = d * rates[i][k];
            A[i][k] = (i == k ? 1.0 : 0.0) + B[i][k] * mobility[k];
        }
#pragma GCC unroll 6
    for (int i = 0; i < SQUEEZE; i++) {
        const double inv = 1.0 / A[i][i];
        row_scale(inv, A[i]), row_scale(inv, B[i]);
#pragma GCC unroll 6
        for (int j = 0; j < SQUEEZE; j++) {
            if (j == i) continue;
            const double by = -A[j][i];
            row_add(by, A[i], A[j]), row_add(by, B[i], B[j]);
        }
    }
    for (int i = 0; i < SQUEEZE; i++) memcpy(answer[i], B[i], sizeof answer[i]);
}

// Velocity of the land along the half's axes by rates of both halves in the order of the state.
static void land_velocity(const Model *model, const Work *w, int h, const double *rates, double to[2])
{
    const double lever = land_lever(model, h), *b_y = w->half[h].b_y, *b_z = w->half[h].b_z;
    const double *rate = &rates[h];
    const double y = rate[Y_CAGE_V_Y - Y_CAGE_V_X] + rate[Y_CAGE_GAMMA_DOT - Y_CAGE_V_X] * lever;
    const double z = rate[Y_CAGE_V_Z - Y_CAGE_V_X] - rate[Y_CAGE_BETA_DOT - Y_CAGE_V_X] * lever;
    to[0] = b_y[1] * y + b_y[2] * z;
    to[1] = b_z[1] * y + b_z[2] * z;
}

void rim_films_first(const Model *model, const Work *w, double d, const double *f, const double *v,
                     RimFilmsStep *step)
{
    step->substep = d;
    rim_motions(model, v, step->begun);
    memset(step->by_film, 0, sizeof step->by_film);
    memset(step->impulse, 0, sizeof step->impulse);
    memcpy(step->now, step->films->force, sizeof step->now);
    for (int h = 0; h < 2; h++) {
        for (int i = 0; i < SQUEEZE; i++)
            step->mobility[h][i] =
                i < 2 ? land_mobility(model, land_lever(model, h)) : model->modes->mobility[i - 2];
        find_answer(d, step->films->rates[h], step->mobility[h], step->answer[h]);
        land_velocity(model, w, h, &f[Y_CAGE_V_X], step->acceleration[h]);
        step->acceleration[h][0] += model->d->com_e * w->half[h].s * w->half[h].s;
        step->acceleration[h][1] -= model->d->com_e * f[Y_CAGE_S + h];
    }
}

void rim_films_follow(const Model *model, const Work *w, double t, const double halves[2 * RELATIVE_MOTIONS],
                      double *v, RimFilmsStep *step)
{
    const double d = step->substep;
    double rim[2][RIM], more[2][RIM] = {{0.0}};
    rim_motions(model, v, rim);
    for (int h = 0; h < 2; h++) {
        const double *by = step->mobility[h], *force = step->films->force[h];
        double *now = step->now[h], delta[SQUEEZE], change[SQUEEZE] = {0.0}, joints[2];
        land_velocity(model, w, h, halves, joints);
        for (int i = 0; i < 2; i++) delta[i] = t * step->acceleration[h][i] + joints[i] + step->by_film[h][i];
        for (int i = 0; i < RIM; i++)
            delta[2 + i] = rim[h][i] - step->begun[h][i] + by[2 + i] * d * (force[i] - 0.5 * now[i]);
        for (int i = 0; i < SQUEEZE; i++)
            for (int k = 0; k < SQUEEZE; k++) change[i] -= step->answer[h][i][k] * delta[k];
        for (int i = 0; i < 2; i++) step->by_film[h][i] += by[i] * change[i];
        for (int i = 0; i < RIM; i++) {
            const double impulse = d * force[i] + change[2 + i];
            more[h][i] = impulse - 0.5 * d * now[i];
            now[i] = impulse / d;
            step->impulse[h][i] += impulse;
        }
    }
    rim_push(model, 1.0, more, v);
}
