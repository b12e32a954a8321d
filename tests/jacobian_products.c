// Derivatives of the right-hand side by states and load, of which the core itself needs those of the outputs alone
// (instance/jacobian.h), whose kernels in dual numbers these are.
#define DUAL
#define ISA dual
#define LANE_WIDTH 1

#include "physics/powers.h"
#include "physics/rhs.h"
#include "physics/ring_load.h"

// Structs of dual numbers are given as arrays of doubles, in the order of the members; derivatives NULL: all are 0.
static void join(size_t n, const double *value, const double *derivative, void *to)
{
    for (size_t i = 0; i < n; i++)
        ((scalar *)to)[i] = scalar_dual(value[i], derivative ? derivative[i] : 0.0);
}

static void split(size_t n, const void *from, double *derivative)
{
    for (size_t i = 0; i < n; i++) derivative[i] = scalar_derivative(((const scalar *)from)[i]);
}

enum { WORK_SCALARS = sizeof(Work) / sizeof(scalar), LOAD_SCALARS = sizeof(RingLoad) / sizeof(scalar) };

void jacobian_product(const Model *model, double t, const double *y, const double *dy,
                      const double *d_ring_load, double *dy_dot, double *dw);
void jacobian_housing(const double *w, const double *dw, double dF[3], double dM[3]);

// Derivative of y_dot(t, y, ring load) along the direction (dy, d_ring_load):
//     dy_dot = J dy + d(y_dot)/d(ring load) d_ring_load
// d_ring_load: a RingLoad, or NULL for 0.  dw: a Work for the derivatives of all results, or NULL.
void jacobian_product(const Model *model, double t, const double *y, const double *dy,
                      const double *d_ring_load, double *dy_dot, double *dw)
{
    RingLoad ring_load;
    InputTrajectory trajectory;
    BallTurn turn;
    Work work = {0};
    scalar state[N_ALL_STATES] = {0.0}, rate[N_ALL_STATES] = {0.0};
    const size_t states = (size_t)cage_states(model);
    Model dual = *model;
    dual.ring_load = &ring_load, dual.trajectory = NULL;
    join(LOAD_SCALARS, (const double *)model->ring_load, NULL, &ring_load);
    if (model->turn) {
        join(sizeof turn / sizeof(scalar), (const double *)model->turn, NULL, &turn);
        dual.turn = &turn;
    }
    if (model->trajectory) {
        join(sizeof trajectory / sizeof(scalar), (const double *)model->trajectory, NULL, &trajectory);
        ring_load_at(&trajectory, t, &ring_load);
    }
    if (d_ring_load)
        for (int i = 0; i < LOAD_SCALARS; i++) ((scalar *)&ring_load)[i] += scalar_dual(0.0, d_ring_load[i]);
    join(states, y, dy, state);
    rhs(&dual, t, state, rate, &work);
    split(states, rate, dy_dot);
    if (dw) split(WORK_SCALARS, &work, dw);
}

// Derivative of the housing's reaction (powers.h) from results and their derivative (Work).
void jacobian_housing(const double *w, const double *dw, double dF[3], double dM[3])
{
    Work work;
    scalar F[3], M[3];
    join(WORK_SCALARS, w, dw, &work);
    housing_reaction(&work, F, M);
    split(3, F, dF);
    split(3, M, dM);
}
