// One step of the default method: a linearly implicit trapezoidal rule with velocity Verlet's positions, one
// evaluation of the right-hand side a step.  Derivation, the reason of every constant and literature:
// docs/method.md.  The same step with dense matrices, to be read beside this file: bearing_model/solver/verlet.py.
//
//   gamma = h/2,  v_m = v_n + gamma a_n
//   q_{n+1} = q_n + h q'(q_m, v_m),  q_m = q_n + gamma v_m         friction states z: implicit midpoint rule
//   v^ = v_n + h a_n - limiter                                     predictor; the limiter is the cage's
//   a^ = a(t_{n+1}, q_{n+1}, v^)                                   the evaluation
//   S (1 + gamma A + gamma^2 K) delta = v_n - v^ + gamma (a_n + a^)  one Newton iteration; S: implicit_shear
//   v_{n+1} = v^ + delta,  a_{n+1} = (v_{n+1} - v_n)/gamma - a_n   v_{n+1} = v_n + gamma (a_n + a_{n+1})
//   q_{n+1} += gamma (v_{n+1} - v_n - h a_n)                       where K acts, z too: trapezoidal rule
//   a_{n+1} -= SMOOTHING H (a_{n+1} - 2 a_n + a_{n-1})             stiff rates: H = 1 - (1 + gamma A)^-1
//
// A = -da/dv and K = -da/dq are blocks of the Jacobian, approximate (implicit.c).  The method is a W-method
// (Steihaug and Wolfbrandt 1979): its order is two whatever A and K are.  Exact A and K make it the
// trapezoidal rule, stable for every h; without K it is velocity Verlet, stable for frequencies up to 2/h
// (Swope et al. 1982).
#include "solver/verlet.h"

#include "cage/elastic/elastic_half.h"
#include "physics/rhs.h"
#include "solver/implicit.h"
#include "solver/vector_ops.h"

// Rows of the state: positions from 0 on, friction states from FRICTION on, the work, velocities from
// VELOCITY on.  The velocity of position i < FRICTION is in row VELOCITY + i; the balls' spins come last and
// have no position.  Rows CAGE to CAGE_END are the velocities of the cage halves.
// Modal coordinates of elastic halves are in the rows PLACES to RATES, their rates MODE_RATES rows farther.
enum { PLACES = Y_MODE_S, RATES = Y_MODE_S_DOT, MODE_RATES = RATES - PLACES };

enum { FRICTION = Y_JOINT_PLATE_Y, VELOCITY = Y_BALL_V_X, CAGE = Y_CAGE_V_X, CAGE_END = Y_RING_V_X };

_Static_assert(Y_CAGE_V_X - Y_CAGE_X == VELOCITY && Y_RING_V_X - Y_RING_X == VELOCITY, "order of velocities");
_Static_assert(Y_BALL_OMEGA_X - VELOCITY == FRICTION, "velocities are in the order of their positions");

// Part of the second difference of stiff accelerations that is taken away.  The amplification factor of a
// rate A, which for the trapezoidal rule tends to -1, then has a modulus below 0.46 for gamma A > 2; A may be
// 13 % too small (docs/method.md).
static const double SMOOTHING = 0.15;

// Adds up eight partial sums, so that every instruction set rounds alike.
static double sum_of(const double *x, int count)
{
    const int whole = count / 8 * 8;
    double part[8] = {0};
    for (int i = 0; i < whole; i += 8)
        for (int k = 0; k < 8; k++) part[k] += x[i + k];
    for (int i = whole; i < count; i++) part[i - whole] += x[i];
    return ((part[0] + part[1]) + (part[2] + part[3])) + ((part[4] + part[5]) + (part[6] + part[7]));
}

// Writes positions and friction states of the step's end and the velocities v_m of its middle into y.
// Elastic halves take substeps, whose length is returned.
static double advance_positions(const Model *model, double h, const VerletState *from, double *y,
                                Foreseen *foreseen, Work *w)
{
    const double gamma = 0.5 * h;
    double middle[N_ALL_STATES];  // the state in the middle of the step, of cage and ring

    // Velocity Verlet: positions move with the velocities of the middle.
    for (int i = VELOCITY; i < N_STATES; i++) middle[i] = y[i] = from->y[i] + gamma * from->f[i];
    for (int i = 0; i < FRICTION; i++) y[i] = from->y[i] + h * y[VELOCITY + i];
    for (int i = FRICTION; i < VELOCITY; i++) y[i] = from->y[i];

    // The cage's rotations psi and the friction states have rates that depend on the pose: midpoint rule.
    for (int i = Y_CAGE_X; i < Y_RING_X; i++) middle[i] = from->y[i] + gamma * y[VELOCITY + i];
    for (int i = Y_RING_X; i < FRICTION; i++) middle[i] = from->y[i];
    memcpy(&y[Y_CAGE_PSI], &from->y[Y_CAGE_PSI], 2 * sizeof *y);
    rhs_cage_advance(model, middle, h, y, w);
    if (!model->elastic) return 0.0;
    memcpy(&y[PLACES], &from->y[PLACES], (N_ALL_STATES - PLACES) * sizeof *y);
    return cage_substeps_advance(model, h, &from->fast, from->f, y, foreseen, w);
}

// Limits the predictor of the cage velocities: writes what is taken from h a_n into `removed`.  A land film
// is stiff when closing and almost free when opening, so extrapolating with a_n would throw a half off the
// film on which the half rests.  The part of h a_n that is new since the last step, h (a_n - minmod(a_n, a_{n-1})),
// is therefore damped implicitly with the film matrix at the step's start; the part that both accelerations
// share is steady and stays.
static void predictor_limiter(const Model *model, double h, const VerletState *from, Work *w, double *removed)
{
    // What is new: minmod is the smaller of two accelerations of the same sign, else 0.
    double kept[N_STATES];
    for (int i = CAGE; i < CAGE_END; i++) {
        const double now = from->f[i], before = now - from->h * from->jerk[i];
        const double minmod = now * before <= 0.0 ? 0.0 : fabs(now) < fabs(before) ? now : before;
        removed[i] = kept[i] = h * (now - minmod);
    }

    // What the films leave of it, (1 + h A)^-1 of the films alone, without their spin.
    for (int land = 0; land < 2; land++) {
        const double *film = from->film[land];
        w->film_yy[land] = film[0], w->film_yz[land] = film[1], w->film_zz[land] = film[2];
        w->film_spin[land] = 0.0;
    }
    implicit_films(model, w, h, kept);
    for (int i = CAGE; i < CAGE_END; i++) removed[i] -= kept[i];
}

// Power that the right-hand side dissipates because it was evaluated at v^ and not at v_{n+1}, as far as it
// has one sign: delta.M A delta of balls and cage, M their inertia.  Against a film that holds the cage this
// term would be most of the work.  The terms linear in delta = O(h^2) change sign from step to step and are of the
// method's order.  Springs dissipate nothing: the races' part of delta.M K delta is left out again.
static double dissipation_correction(const Model *model, const Work *w, const double *y, double gamma,
                                     const double *residual, const double *delta)
{
    enum { COUNT = N_STATES - VELOCITY };

    const double *inertia = &model->d->inertia[VELOCITY], inv_gamma = 1.0 / gamma;
    double power[COUNT];
    for (int i = 0; i < COUNT; i++) {
        const double change = delta[VELOCITY + i];
        const double force = inv_gamma * (residual[VELOCITY + i] - change);  // (A + gamma K) delta
        power[i] = inertia[i] * change * force;
    }
    for (int j = 0; j < Z; j++) power[Y_BALL_OMEGA_M - VELOCITY + j] *= y[Y_BALL_R + j] * y[Y_BALL_R + j];
    return sum_of(power, COUNT) - implicit_elastic(w, gamma, delta);
}

// Where a stiffness acts, positions follow the trapezoidal rule too: q_{n+1} += gamma delta with
// delta = v_{n+1} - v_n - h a_n.  These are the balls' axial and radial positions and the tilts of a supported or
// prescribed ring.  The motion of one cage half against the other has weights of its own (implicit.c).
static void correct_positions(const Model *model, double gamma, const double *delta, double axial,
                              double shear, double *y)
{
    for (int i = 0; i < 2 * Z; i++) y[Y_BALL_X + i] += gamma * delta[VELOCITY + Y_BALL_X + i];
    if (model->p->ring.tilt_mode != TILT_MODE_FREE)
        for (int i = Y_RING_BETA; i <= Y_RING_GAMMA; i++) y[i] += gamma * delta[VELOCITY + i];
    if (model->p->scene.cage != CAGE_MODEL_TWO_HALF) return;
    for (int half_0 = Y_CAGE_X; half_0 < Y_RING_X; half_0 += 2) {
        const int half_1 = half_0 + 1;
        const bool along = half_0 == Y_CAGE_X || half_0 == Y_CAGE_BETA || half_0 == Y_CAGE_GAMMA;
        const double weight = 0.5 * gamma * (along ? axial : shear);
        const double share = weight * (delta[VELOCITY + half_1] - delta[VELOCITY + half_0]);
        y[half_0] -= share;
        y[half_1] += share;
    }
}

// The friction states are the deflections of springs and follow likewise: z_{n+1} += c gamma u/(1 + gamma D) with the
// change u of the velocity of half 1 against half 0 at the joint, in the frame of half 0, the decay D of z and the
// weight c of the motion across the axis.
static void correct_friction(const Model *model, const Work *w, double gamma, const double *delta, double c,
                             double *y)
{
    if (model->p->scene.cage != CAGE_MODEL_TWO_HALF) return;
    const Derived *d = model->d;
    const Rotor *h0 = &w->half[0];
    const double dv_y = delta[Y_CAGE_V_Y + 1] - delta[Y_CAGE_V_Y];
    const double dv_z = delta[Y_CAGE_V_Z + 1] - delta[Y_CAGE_V_Z], ds = delta[Y_CAGE_S + 1] - delta[Y_CAGE_S];
    const double u_0y = h0->b_y[1] * dv_y + h0->b_y[2] * dv_z, u_0z = h0->b_z[1] * dv_y + h0->b_z[2] * dv_z;
    for (int k = 0; k < Z; k++) {
        const double u_y = u_0y - ds * d->rivet_z[k], u_z = u_0z + ds * d->rivet_y[k];
        const double plate = c * gamma / (1.0 + gamma * w->plate_rate[k]);
        const double head = c * gamma / (1.0 + gamma * w->head_rate[k]);
        y[Y_JOINT_PLATE_Y + k] += plate * u_y;
        y[Y_JOINT_PLATE_Z + k] += plate * u_z;
        y[Y_JOINT_HEAD_Y + k] += head * u_y;
        y[Y_JOINT_HEAD_Z + k] += head * u_z;
    }
}

// The films at the step's end, for the next step's predictor.
static void remember_films(const Work *w, VerletState *to)
{
    for (int land = 0; land < 2; land++) {
        const double film[3] = {w->film_yy[land], w->film_yz[land], w->film_zz[land]};
        memcpy(to->film[land], film, sizeof film);
    }
}

// Accelerations, jerks and errors of the velocities.  The trapezoidal rule's own leading error is h^3 a''/12,
// and h^2 a'' is the second difference of the accelerations over this step and the last.
static void remember_velocities(const Model *model, const Work *w, double h, const VerletState *from,
                                const double *delta, VerletState *to, double *error)
{
    const double gamma = 0.5 * h, inv_gamma = 1.0 / gamma, inv_h = 1.0 / h, inv_span = 2.0 / (h + from->h);
    const double second = h * h * inv_span, *f = from->f;
    double second_difference[N_STATES];

    // h^2 a'' over two steps that may differ in length, and the error.
    for (int i = VELOCITY; i < N_STATES; i++) {
        second_difference[i] = second * (delta[i] * (inv_gamma * inv_h) - from->jerk[i]);
        error[i] = (h / 12.0) * second_difference[i];
    }

    // Stiff accelerations give up a part of their second difference, which is of the order of the method's
    // own error.
    implicit_stiff_part(model, w, gamma, second_difference);
    for (int i = VELOCITY; i < N_STATES; i++) {
        to->f[i] = f[i] + delta[i] * inv_gamma - SMOOTHING * second_difference[i];
        to->jerk[i] = (to->f[i] - f[i]) * inv_h;
    }
}

// Mean rates of the friction states over the step, their changes and errors.  The midpoint rule's own leading
// error is h^3 z'''/24.  The mean rates belong to the middles of the steps, so that their differences give
// z'' and the differences of z'' give z'''.
static void remember_friction(double h, const VerletState *from, VerletState *to, double *error)
{
    const double inv_h = 1.0 / h, inv_span = 2.0 / (h + from->h), second = h * h * inv_span;
    for (int i = FRICTION; i < Y_WORK; i++) {
        to->f[i] = (to->y[i] - from->y[i]) * inv_h;
        to->jerk[i] = (to->f[i] - from->f[i]) * inv_span;
        error[i] = (h * second / 24.0) * (to->jerk[i] - from->jerk[i]);
    }
}

void verlet_evaluate(const Model *model, double t, VerletState *now, Work *w)
{
    rhs(model, t, now->y, now->f, w);
    if (model->elastic) cage_substeps_split(model, now->y, w, now->f, &now->fast);
}

// The second half of the last substep, of length `sub`, for the rates of the modes and the halves in y: with the fast
// accelerations at `fast`, less those at `before`.
static void kick(const Model *model, const Work *w, double sub, const FastState *fast,
                 const FastState *before, double *y)
{
    double rigid[RELATIVE_MOTIONS];
    for (int i = 0; i < 2 * N_MODES; i++)
        y[RATES + i] += 0.5 * sub * (fast->modes[i] - (before ? before->modes[i] : 0.0));
    for (int i = 0; i < RELATIVE_MOTIONS; i++) rigid[i] = fast->rigid[i] - (before ? before->rigid[i] : 0.0);
    cage_substeps_kick(model, w, 0.5 * sub, rigid, y);
}

// Rates of the modes of elastic halves: the substeps had the slow accelerations `foreseen` at the end.
static void correct_modes(double h, const Foreseen *foreseen, const VerletState *from, VerletState *to,
                          double *error)
{
    const double gamma = 0.5 * h, inv_h = 1.0 / h, second = h * h * (2.0 / (h + from->h));
    for (int i = RATES; i < N_ALL_STATES; i++) {
        const double change = to->f[i] - from->f[i];
        to->y[i] += gamma * (to->f[i] - foreseen->modes[i - RATES]);
        to->jerk[i] = change * inv_h;
        error[i] = (h / 12.0) * (second * (to->jerk[i] - from->jerk[i]));
    }
    memcpy(&to->f[PLACES], &to->y[RATES], MODE_RATES * sizeof *error);
    memset(&to->jerk[PLACES], 0, MODE_RATES * sizeof *error);
    memset(&error[PLACES], 0, MODE_RATES * sizeof *error);
}

double verlet_step(const Model *model, double t, double h, const double *weight, const VerletState *from,
                   VerletState *to, Work *w)
{
    const double gamma = 0.5 * h, *f = from->f;
    Foreseen foreseen;
    double removed[N_STATES], residual[N_STATES], delta[N_STATES], error[N_ALL_STATES], *y = to->y;

    // Positions of the step's end; predicted velocities v^ there; the evaluation.
    const double sub = advance_positions(model, h, from, y, &foreseen, w);
    predictor_limiter(model, h, from, w, removed);
    for (int i = VELOCITY; i < N_STATES; i++) y[i] += gamma * f[i];
    for (int i = CAGE; i < CAGE_END; i++) y[i] -= removed[i];
    if (model->elastic) {
        for (int i = RATES; i < N_ALL_STATES; i++) y[i] += 0.5 * sub * foreseen.modes[i - RATES];
        kick(model, w, sub, &from->fast, NULL, y);
    }
    rhs(model, t + h, y, to->f, w);
    remember_films(w, to);
    if (model->elastic) {
        cage_substeps_split(model, y, w, to->f, &to->fast);
        kick(model, w, sub, &to->fast, &from->fast, y);
    }

    // The residual of the trapezoidal rule at v^, and the linear solve that corrects v^.
    for (int i = VELOCITY; i < N_STATES; i++) residual[i] = gamma * (to->f[i] - f[i]);
    for (int i = CAGE; i < CAGE_END; i++) residual[i] += removed[i];
    if (model->elastic)
        for (int i = CAGE; i < CAGE_END; i++) residual[i] -= gamma * foreseen.halves[i - CAGE];
    const double shear = implicit_shear(model, w, gamma, residual);
    for (int i = VELOCITY; i < N_STATES; i++) delta[i] = residual[i];
    const double axial = implicit_solve(model, w, gamma, delta);
    to->f[Y_WORK] += dissipation_correction(model, w, y, gamma, residual, delta);

    // The limiter is given back: from here on delta is v_{n+1} - v_n - h a_n.
    for (int i = CAGE; i < CAGE_END; i++) {
        y[i] += removed[i];
        delta[i] -= removed[i];
    }
    for (int i = VELOCITY; i < N_STATES; i++) y[i] += delta[i];
    if (model->elastic)
        for (int i = CAGE; i < CAGE_END; i++) delta[i] += gamma * foreseen.halves[i - CAGE];
    correct_positions(model, gamma, delta, axial, shear, y);
    correct_friction(model, w, gamma, delta, shear, y);

    // The work by the trapezoidal rule.
    y[Y_WORK] += gamma * (f[Y_WORK] + to->f[Y_WORK]);

    // History for the next step, and the error: positions and the work have none of their own.
    for (int i = 0; i < FRICTION; i++) error[i] = 0.0;
    error[Y_WORK] = 0.0;
    remember_velocities(model, w, h, from, delta, to, error);
    remember_friction(h, from, to, error);
    to->h = h;
    if (model->elastic) {
        correct_modes(h, &foreseen, from, to, error);
        return vector_ops_elastic.wrms_norm(error, weight);
    }
    return vector_ops.wrms_norm(error, weight);
}
