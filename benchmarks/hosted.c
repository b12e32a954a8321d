// The core's own step hosted by ARKStep: ARKODE keeps time, state and step size, and asks for each step.
//
//   table        implicit trapezoidal rule: the second stage is the result, its derivative is deduced from the solve
//   nonlinear    SUNNonlinearSolver: one step of verlet.c in place of an iteration; a recoverable failure where its error
//                is above 1, with the factor of the next trial
//   controller   SUNAdaptController: the step sizes of integrator.c
//
// Behind integrator.h like solvers.c.  Steps are those of the core's loop but for rounding: ARKODE multiplies
// the last step by the ratio of both.  All of the difference in time is ARKODE's, and the correction that
// becomes its state.
#define integrator_advance own_advance
#include "solver/integrator.c"
#undef integrator_advance

#include <arkode/arkode_arkstep.h>

typedef struct {
    Integrator *in;
    void *arkode;
    N_Vector y;
    SUNNonlinearSolver solver;
    SUNAdaptController controller;
    VerletState *now, *next;
    double goal, t_stop, proposed;
} Host;

static Host host;  // of one instance at a time

// ARKODE multiplies the controller's step by its safety factor, which must be below 1: without rounding.
static const double HALF = 0.5;

static int known_derivative(sunrealtype t, N_Vector y, N_Vector f, void *user)
{
    (void)t, (void)y, (void)user;
    memcpy(data(f), host.now->f, sizeof(double) * (size_t)states(f));
    return 0;
}

static SUNNonlinearSolver_Type solver_type(SUNNonlinearSolver solver)
{
    (void)solver;
    return SUNNONLINEARSOLVER_FIXEDPOINT;
}

static SUNErrCode no_system(SUNNonlinearSolver solver, SUNNonlinSolSysFn system)
{
    (void)solver, (void)system;
    return SUN_SUCCESS;
}

static int take_step(SUNNonlinearSolver solver, N_Vector predicted, N_Vector correction, N_Vector weight,
                     sunrealtype tolerance, sunbooleantype setup, void *memory)
{
    (void)solver, (void)weight, (void)tolerance, (void)setup, (void)memory;
    Integrator *in = host.in;
    double gamma;
    ARKodeGetCurrentGamma(host.arkode, &gamma);
    const double h = 2.0 * gamma;
    const double error = in->kernels->verlet(in->model, in->s->t, h, in->weight, host.now, host.next, in->w);
    in->s->rhs_evals += 1.0;
    in->from = host.now;
    SUNAdaptController_EstimateStep(in->control, h, ORDER, error, &host.proposed);
    if (!(error <= 1.0)) {
        in->s->error_tests_failed += 1.0;
        host.goal = host.proposed;
        ARKodeSetMaxCFailGrowth(host.arkode, step_length(host.goal, host.t_stop - in->s->t) / h);
        return SUN_NLS_CONV_RECVR;
    }
    host.next->ratio = ratio_of(error);
    in->ops->linear_sum(1.0, host.next->y, -1.0, data(predicted), data(correction));
    return SUN_SUCCESS;
}

static SUNErrCode next_step(SUNAdaptController controller, sunrealtype h, int p, sunrealtype error,
                            sunrealtype *h_next)
{
    (void)controller, (void)p, (void)error;
    if (h >= host.goal * (1.0 - LAST_STEP) || host.proposed < h) host.goal = host.proposed;
    host.goal = fmin(host.goal, cage_longest_step(host.in->model, host.next->film));
    const double left = host.t_stop - (host.in->s->t + h);
    *h_next = (left > 0.0 ? step_length(host.goal, left) : host.goal) / HALF;
    return SUN_SUCCESS;
}

static bool host_create(Integrator *in)
{
    double A[4] = {0.0, 0.0, 0.5, 0.5}, b[2] = {0.5, 0.5}, c[2] = {0.0, 1.0};
    host = (Host){.in = in, .y = vector_new(in->sun, &in->ops)};
    host.arkode = ARKStepCreate(NULL, known_derivative, 0.0, host.y, in->sun);
    host.solver = SUNNonlinSolNewEmpty(in->sun);
    host.solver->ops->gettype = solver_type;
    host.solver->ops->solve = take_step;
    host.solver->ops->setsysfn = no_system;
    host.controller = SUNAdaptController_NewEmpty(in->sun);
    host.controller->ops->gettype = control_type;
    host.controller->ops->estimatestep = next_step;
    ARKodeButcherTable table = ARKodeButcherTable_Create(2, 2, 1, c, A, b, b);
    int status = ARKStepSetTables(host.arkode, 2, 1, table, NULL);
    ARKodeButcherTable_Free(table);
    status |= set_up(host.arkode, in) | ARKodeSetNonlinearSolver(host.arkode, host.solver) |
              ARKodeSetAdaptController(host.arkode, host.controller) |
              ARKodeSetDeduceImplicitRhs(host.arkode, SUNTRUE) | ARKodeSetMaxConvFails(host.arkode, 100) |
              ARKodeSetSafetyFactor(host.arkode, HALF) | ARKodeSetMaxGrowth(host.arkode, 1e10) |
              ARKodeSetMaxFirstGrowth(host.arkode, 1e10) | ARKodeSetMinReduction(host.arkode, 1e-10) |
              ARKodeSetFixedStepBounds(host.arkode, 1.0, 1.0);
    return status == ARK_SUCCESS;
}

int integrator_advance(Integrator *in, double t_stop, long max_steps)
{
    IntegratorState *s = in->s;
    integrator_evaluate(in);
    if (host.in != in && !host_create(in)) return -1;
    weigh_orbit(in);
    host.now = &s->now, host.next = &in->trial;
    host.goal = fmin(s->h, cage_longest_step(in->model, host.now->film)), host.t_stop = t_stop;
    memcpy(data(host.y), s->now.y, sizeof s->now.y);
    const double first = step_length(host.goal, t_stop - s->t);
    if (ARKodeReset(host.arkode, s->t, host.y) != ARK_SUCCESS) return -1;
    if (ARKodeSetInitStep(host.arkode, first) != ARK_SUCCESS) return -1;
    if (ARKodeSetStopTime(host.arkode, t_stop) != ARK_SUCCESS) return -1;
    int status = ARK_SUCCESS;
    double t = s->t;
    while (status >= 0 && s->t < t_stop && max_steps-- > 0) {
        status = ARKodeEvolve(host.arkode, t_stop, host.y, &t, ARK_ONE_STEP);
        if (status < 0) break;
        VerletState *const before = host.now;
        host.now = host.next, host.next = before;
        const double h = host.now->h;
        s->t = t;
        s->steps += 1.0;
        in->hook(in->context, h, in->w);
    }
    if (host.now != &s->now) s->now = *host.now;
    s->h = host.goal;
    return status < 0 ? status : 0;
}
