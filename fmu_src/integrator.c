// Two one-step methods of ARKODE on the same state:
//
//   explicit   classical Runge-Kutta 4(3); its last stage is the next step's first.  Per evaluation its stability reaches furthest along the
//              imaginary axis (2.83/4; Bogacki-Shampine 1.73/3, Dormand-Prince 1.0/6): contacts and riveted joints ring at 2.5e5...4e5 rad/s
//   IMEX       ARK324L2SA: f = (f + A (y - y_n)) + (-A (y - y_n)) with the stiff blocks A (implicit.h) frozen at the start of each step: a stage's
//              equation  z - y_n = s - gamma A (z - y_n)  is solved block by block, without iteration
//
// Each advance resets ARKODE with the remembered step size and a stop time, so that it is a pure function of IntegratorState: rollback and a
// fresh instance continue bit for bit.  Error weights are absolute, 1/(tolerance scale): angles are unbounded.
#include "integrator.h"

#include "aligned.h"

#include <arkode/arkode_arkstep.h>
#include <arkode/arkode_erkstep.h>
#include <stdio.h>
#include <stdlib.h>
#include <sundials/sundials_nonlinearsolver.h>
#include <sundials/sundials_nvector.h>

struct Integrator {
    const Kernels *kernels;
    const Model *model;
    Work *w;
    IntegratorState *s;
    StepHook *hook;
    IntegratorLog *log;
    void *context;
    SUNContext sun;
    N_Vector y;        // the step's result
    void *stepper[2];  // by Path - 1
    SUNNonlinearSolver stage;
    double weight[N_STATES];
    Implicit A;            // frozen over a step of the IMEX path
    bool frozen;           // A belongs to the present state
    const double *latest;  // where ARKODE keeps the latest evaluation
    bool starting;         // the next evaluation is the one at (s->t, s->y)
    bool rehearsing;       // dy/dt = 0
    unsigned spoiled;      // trial states without a derivative in this advance
};

// ---- vectors of fixed length with the operations of this processor ---------------------------------------------------------------------------
typedef struct {
    const VectorOps *ops;
    double value[N_STATES];
} Content;

static double *data(N_Vector v)
{
    return ((Content *)v->content)->value;
}
static const VectorOps *ops(N_Vector v)
{
    return ((const Content *)v->content)->ops;
}
static N_Vector_ID vector_id(N_Vector v)
{
    (void)v;
    return SUNDIALS_NVEC_CUSTOM;
}
static sunindextype vector_length(N_Vector v)
{
    (void)v;
    return N_STATES;
}
static N_Vector vector_clone(N_Vector like)
{
    N_Vector v = N_VNewEmpty(like->sunctx);
    if (v == NULL) return NULL;
    N_VCopyOps(like, v);
    v->content = malloc(sizeof(Content));
    if (v->content == NULL) {
        N_VFreeEmpty(v);
        return NULL;
    }
    ((Content *)v->content)->ops = ops(like);
    return v;
}
static void vector_destroy(N_Vector v)
{
    if (v == NULL) return;
    free(v->content);
    N_VFreeEmpty(v);
}
static void vector_linear_sum(sunrealtype a, N_Vector x, sunrealtype b, N_Vector y, N_Vector z)
{
    ops(z)->linear_sum(a, data(x), b, data(y), data(z));
}
static SUNErrCode vector_linear_combination(int n, sunrealtype *c, N_Vector *x, N_Vector z)
{
    enum { MOST = 16 };  // more than twice the stages
    double *values[MOST];
    if (n > MOST) return SUN_ERR_ARG_OUTOFRANGE;
    for (int i = 0; i < n; i++) values[i] = data(x[i]);
    ops(z)->linear_combination(n, c, values, data(z));
    return SUN_SUCCESS;
}
static double vector_wrms_norm(N_Vector x, N_Vector w)
{
    return ops(x)->wrms_norm(data(x), data(w));
}
static void vector_scale(sunrealtype c, N_Vector x, N_Vector z)
{
    if (c == 1.0) {
        if (x != z) memcpy(data(z), data(x), sizeof(double) * N_STATES);
    } else {
        for (int i = 0; i < N_STATES; i++) data(z)[i] = c * data(x)[i];
    }
}
static void vector_const(sunrealtype c, N_Vector z)
{
    for (int i = 0; i < N_STATES; i++) data(z)[i] = c;
}
// ARKODE wants these to exist; it calls them only to choose a first step, which is always given.
static void vector_div(N_Vector x, N_Vector y, N_Vector z)
{
    for (int i = 0; i < N_STATES; i++) data(z)[i] = data(x)[i] / data(y)[i];
}
static void vector_abs(N_Vector x, N_Vector z)
{
    for (int i = 0; i < N_STATES; i++) data(z)[i] = fabs(data(x)[i]);
}
static void vector_inv(N_Vector x, N_Vector z)
{
    for (int i = 0; i < N_STATES; i++) data(z)[i] = 1.0 / data(x)[i];
}
static void vector_add_const(N_Vector x, sunrealtype b, N_Vector z)
{
    for (int i = 0; i < N_STATES; i++) data(z)[i] = data(x)[i] + b;
}
static double vector_max_norm(N_Vector x)
{
    double most = 0.0;
    for (int i = 0; i < N_STATES; i++) most = fmax(most, fabs(data(x)[i]));
    return most;
}

static N_Vector vector_new(SUNContext sun, const VectorOps *vector_operations)
{
    N_Vector v = N_VNewEmpty(sun);
    if (v == NULL) return NULL;
    *v->ops = (struct _generic_N_Vector_Ops){0};
    v->ops->nvgetvectorid = vector_id;
    v->ops->nvclone = vector_clone;
    v->ops->nvdestroy = vector_destroy;
    v->ops->nvgetlength = vector_length;
    v->ops->nvlinearsum = vector_linear_sum;
    v->ops->nvlinearcombination = vector_linear_combination;
    v->ops->nvwrmsnorm = vector_wrms_norm;
    v->ops->nvscale = vector_scale;
    v->ops->nvconst = vector_const;
    v->ops->nvdiv = vector_div;
    v->ops->nvabs = vector_abs;
    v->ops->nvinv = vector_inv;
    v->ops->nvaddconst = vector_add_const;
    v->ops->nvmaxnorm = vector_max_norm;
    v->content = malloc(sizeof(Content));
    if (v->content == NULL) {
        N_VFreeEmpty(v);
        return NULL;
    }
    ((Content *)v->content)->ops = vector_operations;
    vector_const(0.0, v);
    return v;
}

// ---- what ARKODE calls ---------------------------------------------------------------------------------------------------------------------
// dy/dt; at a step's start the known one.  ERKStep has no retry for a trial state without a derivative, so such a state gets an enormous one,
// of alternating sign: the error test fails and the step is tried again with a smaller size.
static void evaluate(Integrator *in, double t, const double *y, double *f)
{
    if (in->rehearsing) {
        memset(f, 0, sizeof in->s->f);
        return;
    }
    if (in->starting) {
        in->starting = false;
        memcpy(f, in->s->f, sizeof in->s->f);
        return;
    }
    in->kernels->rhs(in->model, t, y, f, in->w);
    in->s->rhs_evals += 1.0;
    in->latest = f;
    if (in->kernels->ops->finite(f)) return;
    const double enormous = in->spoiled++ % 2 == 0 ? 1e15 : -1e15;  // [1/s] in units of the tolerance
    for (int i = 0; i < N_STATES; i++) f[i] = enormous / in->weight[i];
}

static int explicit_rhs(sunrealtype t, N_Vector y, N_Vector f, void *user)
{
    evaluate(user, t, data(y), data(f));
    return 0;
}

static int imex_explicit(sunrealtype t, N_Vector y, N_Vector f, void *user)
{
    Integrator *in = user;
    evaluate(in, t, data(y), data(f));
    in->kernels->implicit->add(&in->A, data(y), in->s->y, data(f));
    return 0;
}

// -A (y - y_n): 0 at the step's start.  In the stages ARKODE takes it from the solved equation instead.
static int imex_implicit(sunrealtype t, N_Vector y, N_Vector f, void *user)
{
    (void)t;
    const Integrator *in = user;
    memset(data(f), 0, sizeof(double) * N_STATES);
    in->kernels->implicit->add(&in->A, in->s->y, data(y), data(f));
    return 0;
}

static int weights(N_Vector y, N_Vector ewt, void *user)
{
    (void)y;
    memcpy(data(ewt), ((const Integrator *)user)->weight, sizeof(double) * N_STATES);
    return 0;
}

// ---- the linear implicit stage as ARKODE's nonlinear solver --------------------------------------------------------------------------------
static SUNNonlinearSolver_Type stage_type(SUNNonlinearSolver solver)
{
    (void)solver;
    return SUNNONLINEARSOLVER_ROOTFIND;
}

static int stage_set_system(SUNNonlinearSolver solver, SUNNonlinSolSysFn system)
{
    (void)solver, (void)system;
    return SUN_SUCCESS;
}

static int stage_solve(SUNNonlinearSolver solver, N_Vector start, N_Vector correction, N_Vector weight, sunrealtype tolerance, sunbooleantype setup,
                       void *arkode)
{
    (void)start, (void)weight, (void)tolerance, (void)setup;
    Integrator *in = solver->content;
    double t, gamma;
    N_Vector predicted, z, implicit, known;
    void *user;
    if (ARKodeGetNonlinearSystemData(arkode, &t, &predicted, &z, &implicit, &gamma, &known, &user) != ARK_SUCCESS) return SUN_ERR_GENERIC;
    memcpy(data(correction), data(known), sizeof(double) * N_STATES);  // the predictor is y_n, where the implicit part is 0
    in->kernels->implicit->solve(&in->A, gamma, data(correction));
    return SUN_SUCCESS;
}

static int stage_free(SUNNonlinearSolver solver)
{
    SUNNonlinSolFreeEmpty(solver);
    return SUN_SUCCESS;
}

static SUNNonlinearSolver stage_new(Integrator *in)
{
    SUNNonlinearSolver solver = SUNNonlinSolNewEmpty(in->sun);
    if (solver == NULL) return NULL;
    solver->content = in;
    solver->ops->gettype = stage_type;
    solver->ops->setsysfn = stage_set_system;
    solver->ops->solve = stage_solve;
    solver->ops->free = stage_free;
    return solver;
}

// ---- creation ---------------------------------------------------------------------------------------------------------------------------------
static void report(int line, const char *function, const char *file, const char *message, SUNErrCode code, void *user, SUNContext sun)
{
    (void)file, (void)sun;
    const Integrator *in = user;
    char text[512];
    snprintf(text, sizeof text, "t = %.9g s: SUNDIALS %s, line %d: %s (code %d)", in->s->t, function, line, message, (int)code);
    in->log(in->context, text);
}

static int set_up(Integrator *in, void *stepper)
{
    if (ARKodeSetUserData(stepper, in) != ARK_SUCCESS) return -1;
    if (ARKodeWFtolerances(stepper, weights) != ARK_SUCCESS) return -1;
    if (ARKodeSetInterpolantType(stepper, ARK_INTERP_NONE) != ARK_SUCCESS) return -1;
    if (ARKodeSetMaxErrTestFails(stepper, 30) != ARK_SUCCESS) return -1;
    return ARKodeSetMaxHnilWarns(stepper, -1) == ARK_SUCCESS ? 0 : -1;
}

// Classical fourth order; theta h (k_5 - k_4) with k_5 the next step's first stage is the difference to an embedded third order.
static int explicit_table(void *stepper)
{
    enum { STAGES = 5 };
    const double theta = 0.05;
    double c[STAGES] = {0.0, 0.5, 0.5, 1.0, 1.0}, b[STAGES] = {1.0 / 6.0, 1.0 / 3.0, 1.0 / 3.0, 1.0 / 6.0, 0.0};
    double d[STAGES] = {1.0 / 6.0, 1.0 / 3.0, 1.0 / 3.0, 1.0 / 6.0 - theta, theta};
    double A[STAGES * STAGES] = {0.0,       0.0,       0.0,       0.0,       0.0,  //
                                 0.5,       0.0,       0.0,       0.0,       0.0,  //
                                 0.0,       0.5,       0.0,       0.0,       0.0,  //
                                 0.0,       0.0,       1.0,       0.0,       0.0,  //
                                 1.0 / 6.0, 1.0 / 3.0, 1.0 / 3.0, 1.0 / 6.0, 0.0};
    ARKodeButcherTable table = ARKodeButcherTable_Create(STAGES, 4, 3, c, A, b, d);
    const int status = table != NULL ? ERKStepSetTable(stepper, table) : ARK_MEM_FAIL;
    ARKodeButcherTable_Free(table);
    return status;
}

// One step of dy/dt = 0: ARKODE allocates in its first step, which is to happen here and not in fmi2DoStep.
static bool rehearse(Integrator *in, void *stepper)
{
    double t;
    in->rehearsing = true;
    const bool fine = ARKodeSetInitStep(stepper, 1.0) == ARK_SUCCESS && ARKodeSetStopTime(stepper, 1.0) == ARK_SUCCESS &&
                      ARKodeEvolve(stepper, 1.0, in->y, &t, ARK_ONE_STEP) >= 0;
    in->rehearsing = false;
    return fine;
}

Integrator *integrator_create(const Kernels *kernels, const Model *model, Work *w, IntegratorState *state, StepHook *hook, IntegratorLog *log, void *context)
{
    Integrator *in = aligned_new(sizeof *in);
    if (in == NULL) return NULL;
    *in = (Integrator){.kernels = kernels, .model = model, .w = w, .s = state, .hook = hook, .log = log, .context = context};
    bool fine = SUNContext_Create(SUN_COMM_NULL, &in->sun) == SUN_SUCCESS;
    if (fine) {
        SUNContext_ClearErrHandlers(in->sun);
        fine = SUNContext_PushErrHandler(in->sun, report, in) == SUN_SUCCESS && (in->y = vector_new(in->sun, kernels->ops)) != NULL;
    }
    if (fine) {
        in->stepper[PATH_EXPLICIT - 1] = ERKStepCreate(explicit_rhs, 0.0, in->y, in->sun);
        in->stepper[PATH_IMEX - 1] = ARKStepCreate(imex_explicit, imex_implicit, 0.0, in->y, in->sun);
        in->stage = stage_new(in);
        void *explicit_ = in->stepper[0], *imex = in->stepper[1];
        fine = explicit_ != NULL && imex != NULL && in->stage != NULL && set_up(in, explicit_) == 0 && set_up(in, imex) == 0 &&
               explicit_table(explicit_) == ARK_SUCCESS && ARKStepSetTableNum(imex, ARKODE_ARK324L2SA_DIRK_4_2_3, ARKODE_ARK324L2SA_ERK_4_2_3) == ARK_SUCCESS &&
               ARKodeSetNonlinearSolver(imex, in->stage) == ARK_SUCCESS && ARKodeSetLinear(imex, 0) == ARK_SUCCESS &&
               ARKodeSetDeduceImplicitRhs(imex, SUNTRUE) == ARK_SUCCESS;
        for (int i = 0; i < N_STATES; i++) in->weight[i] = 1.0;
        fine = fine && rehearse(in, explicit_) && rehearse(in, imex);
    }
    if (!fine) {
        integrator_destroy(in);
        return NULL;
    }
    return in;
}

void integrator_destroy(Integrator *in)
{
    if (in == NULL) return;
    for (int i = 0; i < 2; i++)
        if (in->stepper[i] != NULL) ARKodeFree(&in->stepper[i]);
    if (in->stage != NULL) SUNNonlinSolFree(in->stage);
    if (in->y != NULL) N_VDestroy(in->y);
    if (in->sun != NULL) SUNContext_Free(&in->sun);
    aligned_delete(in);
}

void integrator_tolerance(Integrator *in, double tolerance)
{
    for (int b = 0; b < N_STATE_BLOCKS; b++)
        for (int i = 0; i < STATE_BLOCKS[b].count; i++) in->weight[STATE_BLOCKS[b].offset + i] = 1.0 / (tolerance * in->model->d->scale[STATE_BLOCKS[b].scale]);
}

// ---- stepping -----------------------------------------------------------------------------------------------------------------------------------
void integrator_evaluate(Integrator *in)
{
    IntegratorState *s = in->s;
    if (s->known) return;
    in->kernels->rhs(in->model, s->t, s->y, s->f, in->w);
    s->rhs_evals += 1.0;
    s->known = 1;
    in->kernels->implicit->set(in->model, in->w, &in->A);
    in->frozen = true;
    s->stiffness = in->A.largest;
}

// A at the present state, the same bits whether the state was reached or restored.
static void freeze(Integrator *in)
{
    double f[N_STATES];
    if (in->frozen) return;
    in->kernels->rhs(in->model, in->s->t, in->s->y, f, in->w);
    in->kernels->implicit->set(in->model, in->w, &in->A);
    in->frozen = true;
}

void integrator_restored(Integrator *in)
{
    in->frozen = false;
}

int integrator_advance(Integrator *in, double t_stop, long max_steps)
{
    IntegratorState *s = in->s;
    void *stepper = in->stepper[s->path - 1];
    integrator_evaluate(in);
    if (!in->kernels->ops->finite(s->f)) return -1;
    if (s->path == PATH_IMEX) freeze(in);
    in->spoiled = 0;
    memcpy(data(in->y), s->y, sizeof s->y);
    if (ARKodeReset(stepper, s->t, in->y) != ARK_SUCCESS) return -1;
    if (ARKodeSetInitStep(stepper, fmin(s->h, t_stop - s->t)) != ARK_SUCCESS) return -1;
    if (ARKodeSetStopTime(stepper, t_stop) != ARK_SUCCESS) return -1;
    long steps_before = 0, failed_before = 0, failed = 0;
    ARKodeGetNumErrTestFails(stepper, &failed_before);

    double h_next = 0.0, t = s->t;
    int status = ARK_SUCCESS;
    while (status >= 0 && status != ARK_TSTOP_RETURN) {
        if (steps_before++ >= max_steps) {
            status = ARK_TOO_MUCH_WORK;
            break;
        }
        in->starting = s->known;
        status = ARKodeEvolve(stepper, t_stop, in->y, &t, ARK_ONE_STEP);
        if (status < 0) break;
        const double h = t - s->t;
        memcpy(s->y, data(in->y), sizeof s->y);
        s->t = t;
        s->steps += 1.0;
        ARKodeGetCurrentStep(stepper, &h_next);
        s->known = 0;
        in->frozen = false;
        if (s->path == PATH_IMEX) integrator_evaluate(in);  // the next step's start: f and A
        in->hook(in->context, h, in->w);
    }
    in->starting = false;
    ARKodeGetNumErrTestFails(stepper, &failed);
    s->error_tests_failed += (double)(failed - failed_before);
    s->h = fmax(h_next, 0.9 * s->h);
    if (status < 0) {
        s->known = 0;
        return status;
    }
    s->t = t_stop;
    if (s->path == PATH_EXPLICIT) {  // the last stage was at the new state
        memcpy(s->f, in->latest, sizeof s->f);
        in->kernels->implicit->set(in->model, in->w, &in->A);
        s->stiffness = in->A.largest;
        s->known = 1;
    }
    return 0;
}
