// Two one-step methods on the same state, with the same control of the error:
//
//   verlet     velocity Verlet, linearly implicit in what is stiff (verlet.c): second order, one evaluation a step, the default
//   explicit   classical Runge-Kutta 4(3), stepped by ARKODE; its last stage is the next step's first.  For tolerances below about 2e-5, and as a check
//
// Each advance is a pure function of IntegratorState: rollback and a fresh instance continue bit for bit (ARKODE is reset with the remembered
// step size).  Error weights are absolute, 1/(tolerance scale): angles are unbounded.
#include "integrator.h"

#include "aligned.h"
#include "elementary.h"

#include <arkode/arkode_erkstep.h>
#include <stdio.h>
#include <stdlib.h>
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
    N_Vector y;  // the step's result
    void *arkode;
    double weight[N_STATES];
    VerletState trial;
    const double *latest;       // where ARKODE keeps the latest evaluation
    bool starting;              // the next evaluation is the one at (s->t, s->y)
    bool warming_up;            // dy/dt = 0
    unsigned nonfinite_stages;  // trial states without a derivative in this advance
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
    enum { MAX_VECTORS = 8 };  // more than the stages and the state
    double *values[MAX_VECTORS];
    if (n > MAX_VECTORS) return SUN_ERR_ARG_OUTOFRANGE;
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
    double max = 0.0;
    for (int i = 0; i < N_STATES; i++) max = fmax(max, fabs(data(x)[i]));
    return max;
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
    if (in->warming_up) {
        memset(f, 0, sizeof in->s->now.f);
        return;
    }
    if (in->starting) {
        in->starting = false;
        memcpy(f, in->s->now.f, sizeof in->s->now.f);
        return;
    }
    in->kernels->rhs(in->model, t, y, f, in->w);
    in->s->rhs_evals += 1.0;
    in->latest = f;
    if (in->kernels->ops->finite(f)) return;
    const double enormous = in->nonfinite_stages++ % 2 == 0 ? 1e15 : -1e15;  // [1/s] in units of the tolerance
    for (int i = 0; i < N_STATES; i++) f[i] = enormous / in->weight[i];
}

static int explicit_rhs(sunrealtype t, N_Vector y, N_Vector f, void *user)
{
    evaluate(user, t, data(y), data(f));
    return 0;
}

static int weights(N_Vector y, N_Vector ewt, void *user)
{
    (void)y;
    memcpy(data(ewt), ((const Integrator *)user)->weight, sizeof(double) * N_STATES);
    return 0;
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

static int set_up(void *arkode, Integrator *in)
{
    if (ARKodeSetUserData(arkode, in) != ARK_SUCCESS) return -1;
    if (ARKodeWFtolerances(arkode, weights) != ARK_SUCCESS) return -1;
    if (ARKodeSetInterpolantType(arkode, ARK_INTERP_NONE) != ARK_SUCCESS) return -1;
    if (ARKodeSetMaxErrTestFails(arkode, 30) != ARK_SUCCESS) return -1;
    return ARKodeSetMaxHnilWarns(arkode, -1) == ARK_SUCCESS ? 0 : -1;
}

// Classical fourth order; theta h (k_5 - k_4) with k_5 the next step's first stage is the difference to an embedded third order.
static int explicit_table(void *arkode)
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
    const int status = table != NULL ? ERKStepSetTable(arkode, table) : ARK_MEM_FAIL;
    ARKodeButcherTable_Free(table);
    return status;
}

// One step of dy/dt = 0: ARKODE allocates in its first step, which is to happen here and not in fmi2DoStep.
static bool warm_up(Integrator *in)
{
    double t;
    in->warming_up = true;
    const bool fine = ARKodeSetInitStep(in->arkode, 1.0) == ARK_SUCCESS && ARKodeSetStopTime(in->arkode, 1.0) == ARK_SUCCESS &&
                      ARKodeEvolve(in->arkode, 1.0, in->y, &t, ARK_ONE_STEP) >= 0;
    in->warming_up = false;
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
        in->arkode = ERKStepCreate(explicit_rhs, 0.0, in->y, in->sun);
        fine = in->arkode != NULL && set_up(in->arkode, in) == 0 && explicit_table(in->arkode) == ARK_SUCCESS;
        for (int i = 0; i < N_STATES; i++) in->weight[i] = 1.0;
        fine = fine && warm_up(in);
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
    if (in->arkode != NULL) ARKodeFree(&in->arkode);
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
    if (s->f_is_current) return;
    in->kernels->rhs(in->model, s->t, s->now.y, s->now.f, in->w);
    s->rhs_evals += 1.0;
    s->f_is_current = 1;
}

static int step_underflow(const Integrator *in, double h)
{
    char text[128];
    snprintf(text, sizeof text, "t = %.9g s: Verlet: the error test fails with the smallest step, %g s", in->s->t, h);
    in->log(in->context, text);
    return ARK_ERR_FAILURE;
}

// Step sizes follow the error estimate, an h^3 of a step; the last two steps before t_stop are equal.  States take turns in two places.
static int verlet_advance(Integrator *in, double t_stop, long max_steps)
{
    IntegratorState *s = in->s;
    VerletState *now = &s->now, *next = &in->trial;
    double h_goal = s->h;
    int status = 0;
    while (status == 0 && s->t < t_stop) {
        if (max_steps-- <= 0) {
            status = ARK_TOO_MUCH_WORK;
            break;
        }
        const double left = t_stop - s->t;
        const bool last = h_goal >= left * (1.0 - 1e-9);
        const double h = last ? left : left < 2.0 * h_goal ? 0.5 * left : h_goal;
        const double error = in->kernels->verlet(in->model, s->t, h, in->weight, now, next, in->w);
        const double factor = error > 0.0 ? 0.8 * approx_inv_cbrt(error) : error == 0.0 ? 2.0 : 0.0;  // NaN: the least
        s->rhs_evals += 1.0;
        if (!(error <= 1.0)) {  // NaN fails too
            s->error_tests_failed += 1.0;
            h_goal = h * fmax(factor, 0.2);
            if (s->t + h_goal == s->t) status = step_underflow(in, h);
            continue;
        }
        VerletState *const before = now;
        now = next, next = before;
        s->t = last ? t_stop : s->t + h;
        s->steps += 1.0;
        if (h == h_goal || factor < 1.0) h_goal = h * fmin(factor, 1.5);
        in->hook(in->context, h, in->w);
    }
    if (now != &s->now) s->now = *now;
    s->h = h_goal;
    return status;
}

static int explicit_advance(Integrator *in, double t_stop, long max_steps)
{
    IntegratorState *s = in->s;
    in->nonfinite_stages = 0;
    memcpy(data(in->y), s->now.y, sizeof s->now.y);
    if (ARKodeReset(in->arkode, s->t, in->y) != ARK_SUCCESS) return -1;
    if (ARKodeSetInitStep(in->arkode, fmin(s->h, t_stop - s->t)) != ARK_SUCCESS) return -1;
    if (ARKodeSetStopTime(in->arkode, t_stop) != ARK_SUCCESS) return -1;
    long failed_before = 0, failed = 0;
    ARKodeGetNumErrTestFails(in->arkode, &failed_before);

    double h_next = 0.0, t = s->t;
    int status = ARK_SUCCESS;
    while (status >= 0 && status != ARK_TSTOP_RETURN) {
        if (max_steps-- <= 0) {
            status = ARK_TOO_MUCH_WORK;
            break;
        }
        in->starting = s->f_is_current;
        status = ARKodeEvolve(in->arkode, t_stop, in->y, &t, ARK_ONE_STEP);
        if (status < 0) break;
        const double h = t - s->t;
        memcpy(s->now.y, data(in->y), sizeof s->now.y);
        s->t = t;
        s->steps += 1.0;
        s->f_is_current = 0;
        ARKodeGetCurrentStep(in->arkode, &h_next);
        in->hook(in->context, h, in->w);
    }
    in->starting = false;
    ARKodeGetNumErrTestFails(in->arkode, &failed);
    s->error_tests_failed += (double)(failed - failed_before);
    s->h = fmax(h_next, 0.9 * s->h);
    if (status < 0) return status;
    s->t = t_stop;
    memcpy(s->now.f, in->latest, sizeof s->now.f);  // the last stage was at the new state
    s->f_is_current = 1;
    return 0;
}

int integrator_advance(Integrator *in, double t_stop, long max_steps)
{
    integrator_evaluate(in);
    if (!in->kernels->ops->finite(in->s->now.f)) return ARK_RHSFUNC_FAIL;
    return in->model->p->solver.method == METHOD_EXPLICIT ? explicit_advance(in, t_stop, max_steps) : verlet_advance(in, t_stop, max_steps);
}
