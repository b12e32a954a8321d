// One step of the default method: a linearly implicit trapezoidal rule with velocity Verlet's positions, one
// evaluation of the right-hand side a step.  Derivation, the reason of every constant and literature:
// docs/method.md.  The same step with dense matrices, to be read beside this file: bearing_model/solver/verlet.py.
//
//   gamma = h/2,  v_m = v_n + gamma a_n
//   q_{n+1} = q_n + h q'(q_m, v_m),  q_m = q_n + gamma v_m         friction states z too, and behind it return mapping
//   v^ = v_n + h a_n - limiter                                     predictor; the limiter is the cage's
//   a^ = a(t_{n+1}, q_{n+1}, v^)                                   the evaluation
//   S (1 + gamma A + gamma^2 K) delta = v_n - v^ + gamma (a_n + a^)  one Newton iteration; S: cage_shear
//   v_{n+1} = v^ + delta,  a_{n+1} = (v_{n+1} - v_n)/gamma - a_n   v_{n+1} = v_n + gamma (a_n + a_{n+1})
//   q_{n+1} += gamma (v_{n+1} - v_n - h a_n)                       where K acts, z too: trapezoidal rule
//   a_{n+1} -= SMOOTHING H (a_{n+1} - 2 a_n + a_{n-1})             stiff rates: H = 1 - (1 + gamma A)^-1
//
// A = -da/dv and K = -da/dq are blocks of the Jacobian, approximate (implicit.c).  The method is a W-method
// (Steihaug and Wolfbrandt 1979): its order is two whatever A and K are.  Exact A and K make it the
// trapezoidal rule, stable for every h; without K it is velocity Verlet, stable for frequencies up to 2/h
// (Swope et al. 1982).
#include "solver/verlet.h"

#include "physics/ball_turn.h"
#include "physics/housing.h"
#include "physics/land_bent.h"
#include "physics/powers.h"
#include "physics/rhs.h"
#include "physics/ring_load.h"
#include "solver/implicit.h"
#include "solver/vector_ops.h"

// Rows of the state: positions from 0 on, friction states from FRICTION on, the work, velocities from
// VELOCITY on.  The velocity of position i < FRICTION is in row VELOCITY + i; the balls' spins come last and
// have no position.  Rows CAGE to CAGE_END are the velocities of the cage halves.
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

// Writes positions and trial deflections of the step's end and the velocities v_m of its middle into y.
static void advance_positions(const Model *model, double h, const VerletState *from, double *y,
                              CageStep *step, Work *w)
{
    const double gamma = 0.5 * h;
    double middle[N_STATES];  // the state in the middle of the step, of cage and ring

    // Velocity Verlet: positions move with the velocities of the middle.
    for (int i = VELOCITY; i < N_STATES; i++) middle[i] = y[i] = from->y[i] + gamma * from->f[i];
    for (int i = 0; i < FRICTION; i++) y[i] = from->y[i] + h * y[VELOCITY + i];
    for (int i = FRICTION; i < VELOCITY; i++) y[i] = from->y[i];

    // The cage's rotations psi and the joints' motions have rates that depend on the pose: midpoint rule.
    for (int i = Y_CAGE_X; i < Y_RING_X; i++) middle[i] = from->y[i] + gamma * y[VELOCITY + i];
    for (int i = Y_RING_X; i < FRICTION; i++) middle[i] = from->y[i];
    cage_advance(model, h, from->y, from->f, &from->cage, middle, y, step, w);
}

// Limits the predictor of the cage velocities: writes what is taken from h a_n into `removed`.  A land film
// is stiff when closing and almost free when opening, so extrapolating with a_n would throw a half off the
// film on which the half rests.  The part of h a_n that is new since the last step, h (a_n - minmod(a_n, a_{n-1})),
// is therefore damped implicitly with the film matrix at the step's start; the part that both accelerations
// share is steady and stays.
static void predictor_limiter(const Model *model, double h, const VerletState *from, double *removed)
{
    // What is new: minmod is the smaller of two accelerations of the same sign, else 0.
    double kept[N_STATES];
    for (int i = CAGE; i < CAGE_END; i++) {
        const double now = from->f[i], before = now - from->h * from->jerk[i];
        const double minmod = now * before <= 0.0 ? 0.0 : fabs(now) < fabs(before) ? now : before;
        removed[i] = kept[i] = h * (now - minmod);
    }

    // The part that the films leave of it, (1 + h A)^-1 of the films alone, without their spin.
    LandFilm film[2];
    for (int land = 0; land < 2; land++)
        film[land] = (LandFilm){from->film[land][0], from->film[land][1], from->film[land][2], 0.0};
    cage_films(model, film, h, kept);
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
    return sum_of(power, COUNT) - implicit_spring_power(w, gamma, delta);
}

// Where a stiffness acts, positions follow the trapezoidal rule too: q_{n+1} += gamma delta with
// delta = v_{n+1} - v_n - h a_n.  These are the balls' axial and radial positions and the tilts of a supported or
// prescribed ring; the cage has weights of its own (cage_correct).
static void correct_positions(const Model *model, double gamma, const double *delta, double *y)
{
    for (int i = 0; i < 2 * Z; i++) y[Y_BALL_X + i] += gamma * delta[VELOCITY + Y_BALL_X + i];
    if (model->p->ring.tilt_mode != TILT_MODE_FREE)
        for (int i = Y_RING_BETA; i <= Y_RING_GAMMA; i++) y[i] += gamma * delta[VELOCITY + i];
}

// The films at the step's end, for the next step's predictor.
static void remember_films(const Work *w, VerletState *to)
{
    for (int land = 0; land < 2; land++) {
        const double film[3] = {w->film[land].yy, w->film[land].yz, w->film[land].zz};
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

// Mean rates of the joints' motion over the step, which the friction states follow, their changes and errors.  The
// midpoint rule's own leading error is h^3 u'''/24.  The mean rates belong to the middles of the steps, so that their
// differences give u'' and the differences of u'' give u'''.
static void remember_friction(double h, const JointStep *joints, const VerletState *from, VerletState *to,
                              double *error)
{
    const double inv_h = 1.0 / h, inv_span = 2.0 / (h + from->h), second = h * h * inv_span;
    for (int k = 0; k < Z; k++) {
        to->f[Y_JOINT_PLATE_Y + k] = joints->way_y[k] * inv_h;
        to->f[Y_JOINT_PLATE_Z + k] = joints->way_z[k] * inv_h;
    }
    for (int i = FRICTION; i < Y_WORK; i++) {
        to->jerk[i] = (to->f[i] - from->f[i]) * inv_span;
        error[i] = (h * second / 24.0) * (to->jerk[i] - from->jerk[i]);
    }
}

// The right-hand side with what moves beside the state: a housing on springs, whose acceleration it sets, and the turn of
// balls with spalls, whose rates it sets.
static __attribute__((noinline)) void rhs_beside(const Model *model, double t, VerletState *now, Work *w)
{
    RingLoad ring_load;
    Model with = *model;
    if (model->turn) with.turn = &now->turn;
    if (model->housing) {
        ring_load = *model->ring_load;
        if (model->trajectory) ring_load_at(model->trajectory, t, &ring_load);
        housing_place(&now->housing, &ring_load);
        with.ring_load = &ring_load, with.trajectory = NULL, with.housing = &now->housing;
    }
    rhs(&with, t, now->y, now->f, w);
    if (model->housing) housing_acceleration(&with, w, &now->housing);
    if (model->turn) ball_turn_rates(w, &now->turn);
}

static void rhs_now(const Model *model, double t, VerletState *now, Work *w)
{
    if (model->housing || model->turn)
        rhs_beside(model, t, now, w);
    else
        rhs(model, t, now->y, now->f, w);
}

// Where the housing is at the end of the step, with predicted velocities.
static void housing_predict(double h, const Housing *from, Housing *to)
{
    for (int i = 0; i < HOUSING_DOF; i++) {
        to->x[i] = from->x[i] + h * (from->v[i] + 0.5 * h * from->a[i]);
        to->v[i] = from->v[i] + h * from->a[i];
        to->a[i] = from->a[i];
        to->rest[i] = from->rest[i];
    }
}

// Its velocities there: the trapezoidal rule.
static void housing_correct(double gamma, const Housing *from, Housing *to)
{
    for (int i = 0; i < HOUSING_DOF; i++) to->v[i] = from->v[i] + gamma * (from->a[i] + to->a[i]);
}

void verlet_evaluate(const Model *model, double t, VerletState *now, Work *w)
{
    const double power = now->f[Y_WORK];
    rhs_now(model, t, now, w);
    now->exchange = exchange_at(w);
    now->exchange.jump = fabs(now->f[Y_WORK] - power);
    cage_split(model, now->y, w, now->f, &now->cage);
}

double verlet_step(const Model *model, double t, double h, const double *weight, const VerletState *from,
                   VerletState *to, Work *w)
{
    const double gamma = 0.5 * h, *f = from->f;
    CageStep cage;
    double removed[N_STATES], residual[N_STATES], delta[N_STATES], error[N_ALL_STATES], *y = to->y;

    // Positions of the step's end; predicted velocities v^ there; the evaluation.
    advance_positions(model, h, from, y, &cage, w);
    predictor_limiter(model, h, from, removed);
    for (int i = VELOCITY; i < N_STATES; i++) y[i] += gamma * f[i];
    for (int i = CAGE; i < CAGE_END; i++) y[i] -= removed[i];
    cage_predict(model, &cage, y);
    to->housing = from->housing, to->turn = from->turn;
    if (model->housing) housing_predict(h, &from->housing, &to->housing);
    if (model->turn) ball_turn_predict(h, &to->turn);
    rhs_now(model, t + h, to, w);
    if (model->housing) housing_correct(gamma, &from->housing, &to->housing);
    if (model->turn) ball_turn_correct(gamma, &from->turn, &to->turn);
    cage_arrive(model, w, &cage, &from->cage, y, to->f, &to->cage);

    // The residual of the trapezoidal rule at v^, and the linear solve that corrects v^.
    for (int i = VELOCITY; i < N_STATES; i++) residual[i] = gamma * (to->f[i] - f[i]);
    for (int i = CAGE; i < CAGE_END; i++) residual[i] += removed[i];
    cage_foreseen(model, &cage, -gamma, residual);
    cage_shear(model, w, gamma, &cage, residual);
    for (int i = VELOCITY; i < N_STATES; i++) delta[i] = residual[i];
    implicit_solve(model, w, gamma, &cage, delta);
    to->f[Y_WORK] += dissipation_correction(model, w, y, gamma, residual, delta);
    if (lands_bend(model)) to->f[Y_WORK] += bent_arrive(gamma, cage.bent, w);
    implicit_ring_wrench(model, gamma, delta, w);
    to->exchange = exchange_at(w);
    remember_films(w, to);

    // The limiter is given back: from here on delta is v_{n+1} - v_n - h a_n.
    for (int i = CAGE; i < CAGE_END; i++) {
        y[i] += removed[i];
        delta[i] -= removed[i];
    }
    for (int i = VELOCITY; i < N_STATES; i++) y[i] += delta[i];
    cage_foreseen(model, &cage, gamma, delta);
    correct_positions(model, gamma, delta, y);
    cage_correct(model, gamma, delta, y, &cage, w);

    // The work by the trapezoidal rule.
    y[Y_WORK] += gamma * (f[Y_WORK] + to->f[Y_WORK]);

    // History for the next step, and the error: positions and the work have none of their own.
    for (int i = 0; i < FRICTION; i++) error[i] = 0.0;
    error[Y_WORK] = 0.0;
    remember_velocities(model, w, h, from, delta, to, error);
    remember_friction(h, &cage.joints, from, to, error);
    to->h = h;
    cage_finish(model, &cage, y, to->f, &to->cage, w);
    cage_remember(model, h, from->h, f, from->jerk, y, to->f, to->jerk, error);
    const VectorOps *ops = cage_states(model) == N_STATES ? &vector_ops : &vector_ops_all;
    return ops->wrms_norm(error, weight);
}
