// One step of the default method: a linearly implicit trapezoidal rule with velocity Verlet's positions, one
// evaluation of the right-hand side a step.  Derivation, the reason of every constant and literature:
// docs/method.md.  The same step with dense matrices, to be read beside this file: bearing_model/solver/verlet.py.
//
//   gamma = h/2,  v_m = v_n + gamma a_n
//   q_{n+1} = q_n + h q'(q_m, v_m),  q_m = q_n + gamma v_m         friction states z too, and behind it return mapping
//   v^ = v_n + h a_n - limiter + p                                 predictor; limiter and p, of loads on walls, are the cage's (cage_begin)
//   a^ = a(t_{n+1}, q_{n+1}, v^)                                   the evaluation
//   S (1 + gamma A + gamma^2 K) delta = gamma (a^ - a_n) + limiter    one Newton iteration; S: the cage's (cage_end)
//   v_{n+1} = v^ + delta,  a_{n+1} = (v_{n+1} - v_n)/gamma - a_n   v_{n+1} = v_n + gamma (a_n + a_{n+1})
//   q_{n+1} += gamma (delta - gamma b)                             where K acts, z too: trapezoidal rule; b: changes of a by loads on
//                                                                  walls, which q_{n+1} has
//   chi^ = chi_n + h chi'_n,  chi_{n+1} = chi_n + gamma (chi'_n + chi'(chi^))    turn of balls with spalls (ball_spall.h), beside the error
//                                                                  norm: 1e-2 rad a step, at a rate that changes little
//   a_{n+1} -= SMOOTHING H (a_{n+1} - 2 a_n + a_{n-1})             stiff rates: H = 1 - (1 + gamma A)^-1
//
// cage_begin and cage_end do this for the rows of the cage; here are those of balls and ring.
//
// A = -da/dv and K = -da/dq are blocks of the Jacobian, approximate (implicit.c).  The method is a W-method
// (Steihaug and Wolfbrandt 1979): its order is two whatever A and K are.  Exact A and K make it the
// trapezoidal rule, stable for every h; without K it is velocity Verlet, stable for frequencies up to 2/h
// (Swope et al. 1982).
#include "solver/verlet.h"

#include "cage/cage.h"
#include "numbers/error_norm.h"
#include "numbers/trapezoid.h"
#include "physics/housing.h"
#include "physics/powers.h"
#include "physics/rhs.h"
#include "physics/ring_load.h"
#include "solver/implicit.h"

// Rows of the state: positions from 0 on, friction states from FRICTION on, the work, velocities from
// VELOCITY on.  The velocity of position i < FRICTION is in row VELOCITY + i; the balls' spins come last and
// have no position.
enum { FRICTION = Y_JOINT_PLATE_Y, VELOCITY = Y_BALL_V_X };

// Rows of the velocities of balls and ring: before and behind those of the cage halves.
enum { PARTS = 2 };

static const int FIRST[PARTS] = {VELOCITY, Y_RING_V_X}, END[PARTS] = {Y_CAGE_V_X, N_STATES};

_Static_assert(Y_CAGE_V_X - Y_CAGE_X == VELOCITY && Y_RING_V_X - Y_RING_X == VELOCITY, "order of velocities");
_Static_assert(Y_CAGE_V_X - Y_BALL_V_X == BALL_MOTIONS, "balls come first");
_Static_assert(Y_BALL_OMEGA_X - VELOCITY == FRICTION, "velocities are in the order of their positions");

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

// Writes positions of the end and predicted velocities into y, and the state of cage and ring in the middle of the step.
// The cage then sets its own rows of y.
static void predict(double h, const VerletState *from, double *middle, double *y)
{
    const double gamma = 0.5 * h;
    for (int i = VELOCITY; i < N_STATES; i++) middle[i] = from->y[i] + gamma * from->f[i];
    for (int i = Y_CAGE_X; i < Y_RING_X; i++) middle[i] = from->y[i] + gamma * middle[VELOCITY + i];
    for (int i = Y_RING_X; i < FRICTION; i++) middle[i] = from->y[i];

    // Velocity Verlet: positions move with the velocities of the middle.
    for (int i = 0; i < FRICTION; i++) y[i] = from->y[i] + h * middle[VELOCITY + i];
    for (int i = FRICTION; i < VELOCITY; i++) y[i] = from->y[i];
    for (int i = VELOCITY; i < N_STATES; i++) y[i] = middle[i] + gamma * from->f[i];
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
// prescribed ring; the cage has weights of its own.  balls: changes of their accelerations whose ways y has.
static void correct_positions(const Model *model, double gamma, const double *delta,
                              const double balls[BALL_MOTIONS], double *y)
{
    for (int i = 0; i < 2 * Z; i++)
        y[Y_BALL_X + i] += gamma * (delta[VELOCITY + Y_BALL_X + i] - gamma * balls[i]);
    if (model->p->ring.tilt_mode != TILT_MODE_FREE)
        for (int i = Y_RING_BETA; i <= Y_RING_GAMMA; i++) y[i] += gamma * delta[VELOCITY + i];
}

// The right-hand side with the motions beside the state: a housing on springs, whose acceleration it sets, and the turn of
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
    for (int j = 0; model->turn && j < Z; j++) now->turn.rate[j] = w->turn_rate[j];
}

static void rhs_now(const Model *model, double t, VerletState *now, Work *w)
{
    if (model->housing || model->turn)
        rhs_beside(model, t, now, w);
    else
        rhs(model, t, now->y, now->f, w);
}

// Motions beside the state at the end of the step: place of the housing, with predicted velocities; predicted turn of balls with spalls.
static void predict_beside(const Model *model, double h, const VerletState *from, VerletState *to)
{
    const Housing *housing = &from->housing;
    to->housing = from->housing, to->turn = from->turn;
    for (int i = 0; model->housing && i < HOUSING_DOF; i++) {
        to->housing.x[i] = housing->x[i] + h * (housing->v[i] + 0.5 * h * housing->a[i]);
        to->housing.v[i] = housing->v[i] + h * housing->a[i];
    }
    for (int j = 0; model->turn && j < Z; j++) to->turn.angle[j] += h * from->turn.rate[j];
}

// The same by the trapezoidal rule, with the evaluation at the end.
static void correct_beside(const Model *model, double gamma, const VerletState *from, VerletState *to)
{
    for (int i = 0; model->housing && i < HOUSING_DOF; i++)
        to->housing.v[i] = from->housing.v[i] + gamma * (from->housing.a[i] + to->housing.a[i]);
    for (int j = 0; model->turn && j < Z; j++)
        to->turn.angle[j] = from->turn.angle[j] + gamma * (from->turn.rate[j] + to->turn.rate[j]);
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
    double middle[N_STATES], residual[N_STATES], delta[N_STATES], error[N_ALL_STATES];
    double unforeseen[N_STATES], second_difference[N_STATES], balls[BALL_MOTIONS], *y = to->y;
    const StepFrom start = {from->y, f, from->jerk, from->h};
    const StepTo end = {y, to->f, to->jerk, error, residual, delta, balls};
    CageStep cage;

    // Positions of the step's end; predicted velocities v^ there; the evaluation.
    predict(h, from, middle, y);
    cage_begin(model, h, &start, &from->cage, middle, y, &cage, w);
    predict_beside(model, h, from, to);
    rhs_now(model, t + h, to, w);
    correct_beside(model, gamma, from, to);
    const double film_power = cage_end(model, &cage, &start, &from->cage, &end, &to->cage, w);

    // The residual of the trapezoidal rule at v^, and the linear solve that corrects v^.
    for (int part = 0; part < PARTS; part++)
        for (int i = FIRST[part]; i < END[part]; i++) delta[i] = residual[i] = gamma * (to->f[i] - f[i]);
    implicit_solve(model, w, gamma, delta);
    to->f[Y_WORK] += dissipation_correction(model, w, y, gamma, residual, delta);
    to->f[Y_WORK] += film_power;
    implicit_ring_wrench(model, gamma, delta, w);
    to->exchange = exchange_at(w);

    // Velocities and stiff positions of the end; the work by the trapezoidal rule.
    for (int part = 0; part < PARTS; part++)
        for (int i = FIRST[part]; i < END[part]; i++) y[i] += delta[i];
    correct_positions(model, gamma, delta, balls, y);
    y[Y_WORK] += gamma * (f[Y_WORK] + to->f[Y_WORK]);

    // History for the next step, and the error: positions and the work have none of their own.
    for (int i = 0; i < FRICTION; i++) error[i] = 0.0;
    error[Y_WORK] = 0.0;
    memcpy(unforeseen, delta, sizeof unforeseen);
    if (!model->d->squeeze.filled)  // elastic_end says why
        for (int i = 0; i < BALL_MOTIONS; i++) unforeseen[VELOCITY + i] -= gamma * balls[i];
    for (int part = 0; part < PARTS; part++)
        trapezoid_error(h, from->h, FIRST[part], END[part], unforeseen, from->jerk, second_difference, error);
    implicit_stiff_part(model, w, gamma, second_difference);
    for (int part = 0; part < PARTS; part++)
        trapezoid_end(h, FIRST[part], END[part], f, delta, unforeseen, second_difference, to->f, to->jerk);
    to->h = h;
    return error_norm(model->modes != NULL, error, weight);
}
