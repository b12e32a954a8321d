// A second-order one-step method that costs one evaluation: velocity Verlet, linearly implicit in what is stiff.
//
//   v_m = v_n + gamma a_n,  gamma = h/2
//   q_{n+1} = q_n + h q'(q_m, v_m),  q_m = q_n + gamma v_m           friction states: implicit midpoint (cage_joint_advance)
//   v^ = v_n + h a_n,  a^ = a(q_{n+1}, v^)                           of cage halves less what their films hold back (predictor_limiter)
//   (1 + gamma A + gamma^2 K) delta = v_n - v^ + gamma (a_n + a^)    rates A, stiffnesses K of stiff local contacts (implicit.c)
//   v_{n+1} = v^ + delta = v_n + gamma (a_n + a_{n+1})
//   q_{n+1} += gamma (v_{n+1} - v_n - h a_n)                         where K acts: there positions follow the trapezoidal rule too
//
// Any A and K keep the second order; the exact ones make the step stable for every h, K = 0 for frequencies up to 2/h (Swope et al. 1982).
// Rates above 1/h would ring, by the trapezoidal factor (1 - gamma A)/(1 + gamma A): a_{n+1} gives up 0.15 H (a_{n+1} - 2 a_n + a_{n-1}), of
// second order itself, H = gamma A/(1 + gamma A) (implicit_stiff_part).  The factor of a fast rate is then between 0.38 and 0.46 for gamma A > 2.
// Error of a step: h^3/12 a'' of the trapezoidal rule and h^3/24 q''' of the midpoint rule (friction states), from differences of two steps.
#include "verlet.h"

#include "implicit.h"
#include "rhs.h"
#include "vector_ops.h"

enum { PAIRED = Y_JOINT_PLATE_Y, VELOCITY = Y_BALL_V_X, FRICTIONS = Y_WORK };  // rows: positions 0...PAIRED - 1, frictions, work, velocities
_Static_assert(Y_CAGE_V_X - Y_CAGE_X == VELOCITY && Y_RING_V_X - Y_RING_X == VELOCITY && Y_BALL_OMEGA_X - VELOCITY == PAIRED,
               "velocities are in the order of their positions");
static const double SMOOTHING = 0.15;

// y: positions and frictions of the next step, velocities of the middle.
static void advance_positions(const Model *model, double h, const VerletState *from, double *y, Work *w)
{
    const double gamma = 0.5 * h;
    double middle[N_STATES];  // of cage and ring
    for (int i = VELOCITY; i < N_STATES; i++) middle[i] = y[i] = from->y[i] + gamma * from->f[i];
    for (int i = 0; i < PAIRED; i++) y[i] = from->y[i] + h * y[VELOCITY + i];
    for (int i = PAIRED; i < VELOCITY; i++) y[i] = from->y[i];
    for (int i = Y_CAGE_X; i < Y_RING_X; i++) middle[i] = from->y[i] + gamma * y[VELOCITY + i];
    for (int i = Y_RING_X; i < PAIRED; i++) middle[i] = from->y[i];
    memcpy(&y[Y_CAGE_PSI], &from->y[Y_CAGE_PSI], 2 * sizeof *y);
    rhs_cage_advance(model, middle, h, y, w);
}

static void correct_positions(const Model *model, double gamma, const double *delta, double *y)
{
    for (int i = 0; i < 2 * Z; i++) y[Y_BALL_X + i] += gamma * delta[VELOCITY + Y_BALL_X + i];
    if (model->p->ring.tilt_mode != TILT_MODE_FREE)
        for (int i = Y_RING_BETA; i <= Y_RING_GAMMA; i++) y[i] += gamma * delta[VELOCITY + i];
    if (model->p->scene.cage == CAGE_MODEL_RIGID) return;
    static const int axial[3] = {Y_CAGE_X, Y_CAGE_BETA, Y_CAGE_GAMMA};  // the motion of one half against the other
    for (int i = 0; i < 3; i++) {
        const double share = 0.5 * gamma * (delta[VELOCITY + axial[i] + 1] - delta[VELOCITY + axial[i]]);
        y[axial[i]] -= share;
        y[axial[i] + 1] += share;
    }
}

// delta.A delta: power that v^ loses beyond v_{n+1}, of one sign: against the film that holds a cage it would be most of the work.  What is linear in
// delta = gamma (a_{n+1} - a_n) alternates and leaves h^2 a.A a, which is of the method's order.
static double dissipation_correction(const Model *model, const double *y, const double *residual, double gamma, const double *delta)
{
    enum { COUNT = N_STATES - VELOCITY, WHOLE = COUNT / 8 * 8 };
    const double *inertia = &model->d->inertia[VELOCITY], inv_gamma = 1.0 / gamma;
    double power[COUNT], part[8] = {0};
    for (int i = 0; i < COUNT; i++) {
        const double damping = inv_gamma * (residual[VELOCITY + i] - delta[VELOCITY + i]);  // (A + gamma K) delta: where rates are stiff, A delta
        power[i] = inertia[i] * delta[VELOCITY + i] * damping;
    }
    for (int j = 0; j < Z; j++) power[Y_BALL_OMEGA_M - VELOCITY + j] *= y[Y_BALL_R + j] * y[Y_BALL_R + j];
    for (int i = 0; i < WHOLE; i += 8)
        for (int k = 0; k < 8; k++) part[k] += power[i + k];
    for (int i = WHOLE; i < COUNT; i++) part[i - WHOLE] += power[i];
    return ((part[0] + part[1]) + (part[2] + part[3])) + ((part[4] + part[5]) + (part[6] + part[7]));
}

// A land film holds back where it closes and hardly where it opens: a land that rests against it would be thrown off by a prediction from a_n alone.
// Of what is new in h a_n of the cage halves, beyond the part that a_n and a_{n-1} share: what the films at the step's start hold back.
static void predictor_limiter(const Model *model, double h, const VerletState *from, Work *w, double *removed)
{
    double kept[N_STATES];
    for (int i = Y_CAGE_V_X; i < Y_RING_V_X; i++) {
        const double now = from->f[i], before = now - from->h * from->jerk[i];
        const double steady = now * before <= 0.0 ? 0.0 : fabs(now) < fabs(before) ? now : before;
        removed[i] = kept[i] = h * (now - steady);
    }
    for (int land = 0; land < 2; land++) {
        w->film_yy[land] = from->film[land][0], w->film_yz[land] = from->film[land][1], w->film_zz[land] = from->film[land][2];
        w->film_spin[land] = 0.0;
    }
    implicit_films(model, w, h, kept);
    for (int i = Y_CAGE_V_X; i < Y_RING_V_X; i++) removed[i] -= kept[i];
}

static void keep_films(const Work *w, VerletState *to)
{
    for (int land = 0; land < 2; land++) {
        const double film[3] = {w->film_yy[land], w->film_yz[land], w->film_zz[land]};
        memcpy(to->film[land], film, sizeof film);
    }
}

double verlet_step(const Model *model, double t, double h, const double *weight, const VerletState *from, VerletState *to, Work *w)
{
    const double gamma = 0.5 * h, *f = from->f;
    double removed[N_STATES], residual[N_STATES], delta[N_STATES], second_difference[N_STATES], *y = to->y;
    advance_positions(model, h, from, y, w);
    predictor_limiter(model, h, from, w, removed);
    for (int i = VELOCITY; i < N_STATES; i++) y[i] += gamma * f[i];
    for (int i = Y_CAGE_V_X; i < Y_RING_V_X; i++) y[i] -= removed[i];
    rhs(model, t + h, y, to->f, w);
    keep_films(w, to);
    for (int i = VELOCITY; i < N_STATES; i++) residual[i] = gamma * (to->f[i] - f[i]);
    for (int i = Y_CAGE_V_X; i < Y_RING_V_X; i++) residual[i] += removed[i];
    for (int i = VELOCITY; i < N_STATES; i++) delta[i] = residual[i];
    implicit_solve(model, w, gamma, delta);
    to->f[Y_WORK] += dissipation_correction(model, y, residual, gamma, delta);
    for (int i = Y_CAGE_V_X; i < Y_RING_V_X; i++) {  // from here on against v_n + h a_n
        y[i] += removed[i];
        delta[i] -= removed[i];
    }
    correct_positions(model, gamma, delta, y);
    y[Y_WORK] += gamma * (f[Y_WORK] + to->f[Y_WORK]);

    const double inv_gamma = 1.0 / gamma, inv_h = 1.0 / h, inv_span = 2.0 / (h + from->h), second = h * h * inv_span;
    double error[N_STATES];
    for (int i = 0; i < PAIRED; i++) error[i] = 0.0;
    error[Y_WORK] = 0.0;
    for (int i = VELOCITY; i < N_STATES; i++) {
        y[i] += delta[i];
        second_difference[i] = second * (delta[i] * (inv_gamma * inv_h) - from->jerk[i]);  // h^2 a''
        error[i] = (h / 12.0) * second_difference[i];
    }
    implicit_stiff_part(model, w, gamma, second_difference);
    for (int i = VELOCITY; i < N_STATES; i++) {
        to->f[i] = f[i] + delta[i] * inv_gamma - SMOOTHING * second_difference[i];
        to->jerk[i] = (to->f[i] - f[i]) * inv_h;
    }
    for (int i = PAIRED; i < FRICTIONS; i++) {
        to->f[i] = (y[i] - from->y[i]) * inv_h;
        to->jerk[i] = (to->f[i] - f[i]) * inv_span;
        error[i] = (h * second / 24.0) * (to->jerk[i] - from->jerk[i]);
    }
    to->h = h;
    return vector_ops.wrms_norm(error, weight);
}
