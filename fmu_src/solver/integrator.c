// Steps from communication point to communication point, by one of three methods:
//
//   verlet     the default: a linearly implicit trapezoidal rule, order two, one evaluation a step (verlet.c)
//   fixed      the same step in equal lengths without an error test, for hosts with a clock
//   explicit   classical Runge-Kutta 4(3) with the error weights of verlet: for tolerances below 2e-5, and as a check
//
// Order, error estimate and step-size control are derived in docs/method.md; bearing_model/solver/verlet.py has the
// control again.  ARKodeEvolve takes the steps of all methods: by ERKStep those of the explicit method, by a module of its
// own those of the other two (bearing_step.h).  A SUNAdaptController proposes their lengths: SUNDIALS' PID controller those
// of the explicit method, step_estimate below those of the default one.
//
// Determinism: an advance is a function of IntegratorState, model and t_stop alone, bit for bit, so that a
// restored state and another instance go on alike.  For this ARKODE is reset at the start of every advance,
// with the remembered step size.  Error weights are absolute, 1/(tolerance scale): angles are unbounded, so
// that relative ones would fade.
#include "solver/integrator.h"

#include "numbers/aligned.h"
#include "numbers/elementary.h"
#include "numbers/reserved_memory.h"
#include "numbers/saved_numbers.h"
#include "physics/powers.h"
#include "physics/race_surface.h"
#include "solver/bearing_step.h"
#include "solver/escape.h"
#include "solver/stepping.h"

#include <arkode/arkode_erkstep.h>
#include <float.h>
#include <limits.h>
#include <nvector/nvector_serial.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

// Size of the block in which SUNDIALS allocates: its 15 vectors of the states, and a part that does not grow with them.
// A test sees that the block is large enough.
enum { SUNDIALS_MEMORY = 20 * N_ALL_STATES * sizeof(double) + 32768 };

struct Integrator {
    _Alignas(64) unsigned char block[SUNDIALS_MEMORY];
    ReservedMemory memory;
    const Kernels *kernels;
    const Model *model;
    Work *w;
    IntegratorState *s;
    StepHook *hook;
    IntegratorLog *log;
    void *context;
    SUNContext sun;
    N_Vector y;    // the explicit step's result
    void *arkode;  // memory of ERKStep

    // of the default method
    N_Vector none;  // ARKODE keeps its time alone
    void *bearing;  // memory of its module
    BearingStep step;
    SUNAdaptController control;
    VerletState *now, *next;  // the step's start and its end: they change places at every accepted step
    double goal;              // length that the controller wants of the next step [s]
    double tested;            // error of the latest step
    bool steps_are_fixed;     // as ARKODE was told last

    double weight[N_ALL_STATES];
    double orbit_weight;  // of a ball's velocity along its orbit, at a high speed
    double tolerance;     // of these weights
    VerletState trial;
    const double *latest;       // where ARKODE keeps the latest evaluation
    bool starting;              // the next evaluation is at (s->t, s->now.y), where s->now.f is known
    bool warming_up;            // dy/dt = 0, see warm_up
    bool escaped;               // the latest step would have ended at a state of escape.h
    unsigned nonfinite_stages;  // stages of this advance whose derivative is not a number
};

// ---- functions that ARKODE calls --------------------------------------------------------------------------

// dy/dt; at a step's start the one that is already known.
static int explicit_rhs(sunrealtype t, N_Vector y, N_Vector y_dot, void *user)
{
    Integrator *in = user;
    double *f = N_VGetArrayPointer(y_dot);
    if (in->warming_up) {
        memset(f, 0, sizeof in->s->now.f);
    } else if (in->starting) {
        in->starting = false;
        memcpy(f, in->s->now.f, sizeof in->s->now.f);
    } else {
        const int states = cage_states(in->model);
        in->kernels->rhs(in->model, t, N_VGetArrayPointer(y), f, in->w);
        in->s->rhs_evals += 1.0;
        in->latest = f;
        if (!in->kernels->all_finite(states, f))
            stepping_refuse(in->weight, states, in->nonfinite_stages++, f);
    }
    return 0;
}

// At the end of an accepted explicit step: the joints' friction states are mapped back.  The derivative there, which
// is known from the last stage, depends only on the part of the states that friction bears, so that it stays.
static int explicit_accepted(sunrealtype t, N_Vector y, void *user)
{
    (void)t;
    Integrator *in = user;
    if (in->warming_up) return 0;
    in->kernels->cage_slide(in->model, in->s->now.y, N_VGetArrayPointer(y), in->w);
    return 0;
}

static int weights(N_Vector y, N_Vector ewt, void *user)
{
    memcpy(NV_DATA_S(ewt), ((const Integrator *)user)->weight, (size_t)NV_LENGTH_S(y) * sizeof(double));
    return 0;
}

// ARKODE's vectors have rows for the modes of the cage, and the length of the scene's states.
static int same_length(N_Vector v, N_Vector like, void *user)
{
    (void)user;
    NV_LENGTH_S(v) = NV_LENGTH_S(like);
    return 0;
}

// ---- control of the default method's steps ----------------------------------------------------------------

// The estimated error of a step is proportional to h^3 (order two), so the step that would just be accepted is
// error^(-1/3) times as long; SAFETY keeps the next one below it.  A step is at least MIN_FACTOR and at most MAX_FACTOR
// times as long as the one before: contacts open and close, and estimates over a kink of the forces mean little.
// Errors below LEAST_ERROR are the same to the next step.
static const double SAFETY = 0.8, MIN_FACTOR = 0.2, MAX_FACTOR = 1.5, LEAST_ERROR = 1e-4;

enum { ORDER = 2 };

// Length that a step's error asks of the next one / its own length.  A NaN means that the step has left the
// range of the model, and gives 0.
static double ratio_of(double error)
{
    return error >= 0.0 ? SAFETY * approx_inv_cbrt(fmax(error, LEAST_ERROR)) : 0.0;
}

// After a step that is accepted, the digital filter H211b of Soderlind (2003) with b = 4: lengths that change
// smoothly, so that the errors of a contact's rise and fall cancel.  After one that is refused, the ratio itself.
// A step that was cut short to meet the stop time says nothing against the goal before it.
static SUNErrCode step_estimate(SUNAdaptController control, sunrealtype h, int order, sunrealtype error,
                                sunrealtype *h_next)
{
    (void)order;
    Integrator *in = control->content;
    const VerletState *from = in->now;
    const double ratio = ratio_of(error), smooth = ratio * (from->ratio * from->h / h);
    const double factor = error <= 1.0 && from->ratio > 0.0 ? sqrt(sqrt(smooth)) : ratio;
    const double proposed = fmin(h * fmax(factor, MIN_FACTOR), MAX_FACTOR * in->goal);
    in->goal = error <= 1.0 && proposed >= h ? fmax(in->goal, proposed) : proposed;
    *h_next = in->goal;
    return SUN_SUCCESS;
}

static SUNAdaptController_Type control_type(SUNAdaptController control)
{
    (void)control;
    return SUN_ADAPTCONTROLLER_H;
}

// SUNDIALS would free the content, which is the integrator's.
static SUNErrCode control_destroy(SUNAdaptController control)
{
    control->content = NULL;
    SUNAdaptController_DestroyEmpty(control);
    return SUN_SUCCESS;
}

static SUNAdaptController control_new(SUNContext sun, Integrator *in)
{
    SUNAdaptController control = SUNAdaptController_NewEmpty(sun);
    if (control == NULL) return NULL;
    control->content = in;
    control->ops->gettype = control_type;
    control->ops->estimatestep = step_estimate;
    control->ops->destroy = control_destroy;
    return control;
}

// ---- the default method's step ------------------------------------------------------------------------------

static bool is_fixed(const Integrator *in)
{
    return in->model->p->solver.method == METHOD_FIXED;
}

// Part of a step by which the last step before t_stop may be longer than the controller wants: the rounding
// of time must not leave a last step of no length.
static const double LAST_STEP = 1e-9;

// Length of the next step: the goal that the controller wants and the cage bears, or as much less that the steps up to the stop time are
// equal: a pattern of long and short ones that each communication step repeats drives vibrations that turn once in it.
// A fixed length divides each advance; the rounding of thousands of times leaves no last step of its own, 1e-14 s long.
static double verlet_length(void *context, double left)
{
    Integrator *in = context;
    if (in->warming_up) return left;
    if (is_fixed(in)) return left / fmax(round(left / in->goal), 1.0);
    in->goal = fmin(in->goal, cage_longest_step(in->model, &in->now->cage));
    return left / fmax(ceil(left / in->goal * (1.0 - LAST_STEP)), 1.0);
}

// Equal steps are watched by the error that the default method would test, in parts of the error that it accepts at its default
// tolerance [1], whatever the host's tolerance is.  Its mean runs over MEAN_OVER [s].  Of 101 scenes drawn at random the statistics of one
// were off by more than ten per cent below LARGEST_ERROR (events.c), of two beyond it; four beyond it were right (docs/notes/equal_steps.md).
// One step counts MOST_ERROR at most: a load that jumps makes one error.  A step beyond DIVERGED, 5 m/s in the mean of all
// velocities, has left the range of the model.
static const double DEFAULT_TOLERANCE = 1e-3, MEAN_OVER = 0.01, MOST_ERROR = 100.0, DIVERGED = 1e4;

static void mean_error(double h, double error, IntegratorState *s)
{
    s->error_mean += fmin(h / MEAN_OVER, 1.0) * (fmin(error, MOST_ERROR) - s->error_mean);
}

// Takes note of a fixed step's error; returns it, or infinity for a step that the run cannot go on with.
static double watch_error(Integrator *in, double h, double error)
{
    IntegratorState *s = in->s;
    const double part = error * (in->tolerance / DEFAULT_TOLERANCE);
    if (!(error <= 1.0)) s->error_tests_failed += 1.0;
    if (!(part <= DIVERGED)) return INFINITY;
    mean_error(h, part, s);
    return error;
}

// Part of the tolerance that the default method's steps are given: where the longest step and not the error decides most of them, a
// smaller tolerance costs next to nothing, and the few impacts of a quiet bearing are as right as those of a busy one.  So the tolerance
// falls with the third power of the mean error below BUSY, down to QUIET; with it the error rises, so that it falls by the power 3/4 in all.
static const double BUSY = 0.25, QUIET = 0.2;

static double tolerance_part(const IntegratorState *s)
{
    const double part = fmin(s->error_mean / BUSY, 1.0);
    return fmax(part * part * part, QUIET);
}

static double verlet_take(void *context, double t, double h)
{
    Integrator *in = context;
    if (in->warming_up) return 0.0;
    const double norm = in->kernels->verlet(in->model, t, h, in->weight, in->now, in->next, in->w);
    const double part = cage_part(&in->next->cage) * tolerance_part(in->s);
    const double error = in->tested = is_fixed(in) ? norm : norm / part;
    in->next->ratio = ratio_of(error);
    in->s->rhs_evals += 1.0;
    return is_fixed(in) ? watch_error(in, h, error) : error;
}

// Called by ARKODE with the time and the state behind an accepted step.
static int verlet_accepted(sunrealtype t, N_Vector y, void *user)
{
    (void)y;
    Integrator *in = user;
    if (in->warming_up) return 0;
    if (escape_find(in->model, in->w).kind != ESCAPE_NONE) {
        in->escaped = true;
        return -1;
    }
    if (!is_fixed(in)) mean_error(in->next->h, in->tested, in->s);
    VerletState *const before = in->now;
    in->now = in->next, in->next = before;
    exchange_add(in->now->h, &before->exchange, &in->now->exchange, &in->s->sum);
    in->s->t = t;
    in->s->steps += 1.0;
    if (in->hook) in->hook(in->context, in->now->h, in->w);
    return 0;
}

// ---- creation ---------------------------------------------------------------------------------------------

// An error message of SUNDIALS, to the log.
static void report(int line, const char *function, const char *file, const char *message, SUNErrCode code,
                   void *user, SUNContext sun)
{
    (void)file, (void)sun;
    const Integrator *in = user;
    if (in->escaped || in->log == NULL) return;
    stepping_report(in->s->t, function, line, message, (int)code, in->log, in->context);
}

// Settings of both methods: no interpolation (steps end at t_stop), no warnings of small steps (they are legitimate in an
// impact).
static int set_up(void *arkode, Integrator *in)
{
    if (ARKodeSetUserData(arkode, in) != ARK_SUCCESS) return -1;
    if (ARKodeWFtolerances(arkode, weights) != ARK_SUCCESS) return -1;
    if (ARKodeSetInterpolantType(arkode, ARK_INTERP_NONE) != ARK_SUCCESS) return -1;
    if (ARKodeSetMaxErrTestFails(arkode, 30) != ARK_SUCCESS) return -1;
    return ARKodeSetMaxHnilWarns(arkode, -1) == ARK_SUCCESS ? 0 : -1;
}

// Classical Runge-Kutta of order four with an embedded order three.  The fifth stage is the next step's first
// (FSAL); the difference of the two solutions, theta h (k_4 - k_5), estimates the error.  theta scales the
// estimate and nothing else.
static int explicit_table(void *arkode)
{
    enum { STAGES = 5 };

    const double theta = 0.05;
    double c[STAGES] = {0.0, 0.5, 0.5, 1.0, 1.0},
           b[STAGES] = {1.0 / 6.0, 1.0 / 3.0, 1.0 / 3.0, 1.0 / 6.0, 0.0};
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

// Takes one step of dy/dt = 0: ARKODE allocates memory in its first step, which must not happen in
// fmi2DoStep.
static bool warm_up(Integrator *in, void *arkode, N_Vector y)
{
    double t;
    in->warming_up = true;
    const bool fine = ARKodeSetInitStep(arkode, 1.0) == ARK_SUCCESS &&
                      ARKodeSetStopTime(arkode, 1.0) == ARK_SUCCESS &&
                      ARKodeEvolve(arkode, 1.0, y, &t, ARK_ONE_STEP) >= 0;
    in->warming_up = false;
    return fine;
}

static bool create_explicit(Integrator *in)
{
    in->y = N_VNew_Serial(VECTOR_ROWS, in->sun);
    if (in->y == NULL) return false;
    N_VConst(0.0, in->y);
    in->y->ops->nvwrmsnorm = in->kernels->norm;
    in->y->ops->nvlinearcombination = in->kernels->combine;
    in->arkode = ERKStepCreate(explicit_rhs, 0.0, in->y, in->sun);
    return in->arkode != NULL && set_up(in->arkode, in) == 0 && explicit_table(in->arkode) == ARK_SUCCESS &&
           ARKodeSetPostprocessStepFn(in->arkode, explicit_accepted) == ARK_SUCCESS &&
           warm_up(in, in->arkode, in->y);
}

static bool create_bearing(Integrator *in)
{
    in->step = (BearingStep){verlet_length, verlet_take, in};
    in->control = control_new(in->sun, in);
    in->none = N_VNew_Serial(1, in->sun);
    if (in->control == NULL || in->none == NULL) return false;
    N_VConst(0.0, in->none);
    in->bearing = bearing_step_create(in->sun, in->none, &in->step);
    return in->bearing != NULL && set_up(in->bearing, in) == 0 &&
           ARKodeSetAdaptController(in->bearing, in->control) == ARK_SUCCESS &&
           ARKodeSetPostprocessStepFn(in->bearing, verlet_accepted) == ARK_SUCCESS &&
           warm_up(in, in->bearing, in->none);
}

Integrator *integrator_create(const Kernels *kernels, const Model *model, Work *w, IntegratorState *state,
                              StepHook *hook, IntegratorLog *log, void *context)
{
    Integrator *in = aligned_new(sizeof *in);
    if (in == NULL) return NULL;
    memset(in, 0, sizeof *in);
    in->kernels = kernels, in->model = model, in->w = w, in->s = state;
    in->hook = hook, in->log = log, in->context = context;
    in->now = &state->now, in->next = &in->trial;
    in->memory = (ReservedMemory){in->block, sizeof in->block, 0};
    reserved_memory_use(&in->memory);
    for (int i = 0; i < N_ALL_STATES; i++)
        in->weight[i] = 1.0;  // for the warm-up, until integrator_tolerance
    bool fine = SUNContext_Create(SUN_COMM_NULL, &in->sun) == SUN_SUCCESS;
    if (fine) {
        SUNContext_ClearErrHandlers(in->sun);
        fine = SUNContext_PushErrHandler(in->sun, report, in) == SUN_SUCCESS && create_explicit(in) &&
               create_bearing(in);
    }
    reserved_memory_use(NULL);
    if (!fine) {
        integrator_destroy(in);
        return NULL;
    }
    return in;
}

void integrator_destroy(Integrator *in)
{
    if (in == NULL) return;
    reserved_memory_use(&in->memory);
    if (in->arkode != NULL) ARKodeFree(&in->arkode);
    if (in->bearing != NULL) ARKodeFree(&in->bearing);
    if (in->control != NULL) SUNAdaptController_Destroy(in->control);
    if (in->y != NULL) N_VDestroy(in->y);
    if (in->none != NULL) N_VDestroy(in->none);
    if (in->sun != NULL) SUNContext_Free(&in->sun);
    reserved_memory_use(NULL);
    aligned_delete(in);
}

void integrator_tolerance(Integrator *in, double tolerance)
{
    memset(&in->trial, 0, sizeof in->trial);  // no modes of a scene before this one
    in->tolerance = tolerance;
    stepping_weights(in->model->d, tolerance, in->weight);
    in->orbit_weight = in->weight[Y_BALL_OMEGA_M];
}

// ---- stepping ---------------------------------------------------------------------------------------------

void integrator_evaluate(Integrator *in)
{
    IntegratorState *s = in->s;
    if (s->f_is_current) return;
    if (in->model->p->solver.method == METHOD_EXPLICIT) {
        in->kernels->rhs(in->model, s->t, s->now.y, s->now.f, in->w);
        s->now.exchange = exchange_at(in->w);
    } else
        in->kernels->verlet_evaluate(in->model, s->t, &s->now, in->w);
    s->rhs_evals += 1.0;
    s->f_is_current = 1;
}

static int step_underflow(const Integrator *in, const char *method, double h)
{
    char text[128];
    snprintf(text, sizeof text, "t = %.9g s: %s: a step of %g s is lost in the rounding of time", in->s->t,
             method, h);
    if (in->log) in->log(in->context, text);
    return ARK_ERR_FAILURE;
}

// The speed with which ball and pocket meet goes with the orbital speed against the outer ring, and so does
// the error of it that matters: the scale of velocities along the orbit holds from FULL_ORBIT [m/s] on and is
// in proportion below, down to its LEAST_ORBIT part.
static const double FULL_ORBIT = 20.0, LEAST_ORBIT = 0.1;

static void weigh_orbit(Integrator *in)
{
    double sum = 0.0;
    for (int j = 0; j < Z; j++)
        sum += fabs(in->s->now.y[Y_BALL_OMEGA_M + j] - in->model->ring_load->outer_omega);
    const double speed = 0.5 * in->model->p->bearing.d_m * sum / Z;
    const double part = fmin(fmax(speed / FULL_ORBIT, LEAST_ORBIT), 1.0);
    for (int j = 0; j < Z; j++) in->weight[Y_BALL_OMEGA_M + j] = in->orbit_weight / part;
}

// Equal steps, or steps by their errors, as the scene wants.  A first step, which ARKODE must not look for, is always
// given.
static int set_fixed(Integrator *in)
{
    if (!is_fixed(in) && !in->steps_are_fixed) return ARK_SUCCESS;
    in->steps_are_fixed = is_fixed(in);
    const int status = ARKodeSetFixedStep(in->bearing, is_fixed(in) ? in->goal : 0.0);
    return status == ARK_SUCCESS ? ARKodeSetInitStep(in->bearing, in->goal) : status;
}

// The shortest step that ARKODE begins with [s].  It multiplies the time to t_stop by the step size of the run
// before, which it keeps over a reset, and takes a product that underflows for a t_stop in the past; thirty
// failed error tests may shorten a step by 1e-30.
static const double SHORTEST_FIRST = 1e-100;

static int verlet_advance(Integrator *in, double t_stop, long max_steps)
{
    IntegratorState *s = in->s;
    const double h_first = fmin(s->h, t_stop - s->t);
    if (s->t + h_first == s->t || h_first < SHORTEST_FIRST) return step_underflow(in, "Verlet", h_first);
    weigh_orbit(in);
    in->now = &s->now, in->next = &in->trial, in->goal = s->h;
    if (is_fixed(in)) in->goal = (t_stop - s->t) / fixed_steps(s->h, t_stop - s->t);

    // ARKODE forgets the history of the steps before; verlet_length begins with the goal.
    double t;
    int status = ARKodeReset(in->bearing, s->t, in->none);
    if (status == ARK_SUCCESS) status = ARKodeSetStopTime(in->bearing, t_stop);
    if (status == ARK_SUCCESS) status = ARKodeSetMaxNumSteps(in->bearing, max_steps);
    if (status == ARK_SUCCESS) status = set_fixed(in);
    long failed_before = 0, failed = 0;
    ARKodeGetNumErrTestFails(in->bearing, &failed_before);
    if (status == ARK_SUCCESS) status = ARKodeEvolve(in->bearing, t_stop, in->none, &t, ARK_NORMAL);
    ARKodeGetNumErrTestFails(in->bearing, &failed);
    s->error_tests_failed += (double)(failed - failed_before);
    if (in->now != &s->now) s->now = *in->now;
    if (!is_fixed(in)) s->h = in->goal;
    if (status == ARK_ERR_FAILURE && s->t + in->goal == s->t) return step_underflow(in, "Verlet", in->goal);
    return status < 0 ? status : 0;
}

// Rounding of the host's time must not change the number of steps.
double fixed_steps(double step, double length)
{
    return fmax(ceil(length / step * (1.0 - LAST_STEP)), 1.0);
}

// Largest mean error of equal steps of the present length in the time of a trial after its first MEAN_OVER, or infinity
// where the run ends.  The state is moved.
static double try_step(Integrator *in)
{
    const double t = in->s->t;
    double largest = 0.0;
    for (int n = 1; n <= 3; n++) {
        if (integrator_advance(in, t + n * MEAN_OVER, LONG_MAX) != 0) return INFINITY;
        if (n > 1) largest = fmax(largest, in->s->error_mean);
    }
    return largest;
}

// The error goes with the third power of the length.
void integrator_fix_step(Integrator *in)
{
    const double WANTED = 0.1, AT_ONCE = 0.5;  // mean error; shortest length / the one tried before

    enum { TRIALS = 6 };

    IntegratorState *s = in->s;
    s->h = in->model->p->solver.step;
    if (s->h > 0.0) return;

    // trials, from which nothing but the length remains
    s->h = cage_fixed_step(in->model);
    const IntegratorState start = *s;
    double h = s->h;
    StepHook *hook = in->hook;
    IntegratorLog *log = in->log;
    in->hook = NULL, in->log = NULL;
    for (int trial = 0; trial < TRIALS; trial++) {
        s->h = h;
        const double error = try_step(in);
        *s = start;
        if (error <= WANTED) break;
        h *= fmax(AT_ONCE, 0.95 * portable_cbrt(WANTED / error));
    }
    in->hook = hook, in->log = log;
    s->h = h;
}

// Part of the step size before an advance that the next one begins with at least: ARKODE's own proposal is
// too small after a step that was cut short to meet t_stop.
static const double KEPT_STEP = 0.9;

static int explicit_advance(Integrator *in, double t_stop, long max_steps)
{
    IntegratorState *s = in->s;
    const double h_first = fmin(s->h, t_stop - s->t);
    if (s->t + h_first == s->t || h_first < SHORTEST_FIRST) return step_underflow(in, "Runge-Kutta", h_first);

    // ARKODE forgets the history of the steps before and begins at the state with the remembered step size.
    in->nonfinite_stages = 0;
    memcpy(N_VGetArrayPointer(in->y), s->now.y, sizeof s->now.y);
    NV_LENGTH_S(in->y) = cage_states(in->model);
    if (ARKodeResize(in->arkode, in->y, 1.0, s->t, same_length, NULL) != ARK_SUCCESS) return -1;
    if (ARKodeReset(in->arkode, s->t, in->y) != ARK_SUCCESS) return -1;
    if (ARKodeSetInitStep(in->arkode, h_first) != ARK_SUCCESS) return -1;
    if (ARKodeSetStopTime(in->arkode, t_stop) != ARK_SUCCESS) return -1;
    long failed_before = 0, failed = 0;
    ARKodeGetNumErrTestFails(in->arkode, &failed_before);

    // One step at a time: each is counted and shown to the hook.
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
        if (t == s->t) {
            double h_last = 0.0;
            ARKodeGetLastStep(in->arkode, &h_last);
            status = step_underflow(in, "Runge-Kutta", h_last);
            break;
        }
        if (escape_find(in->model, in->w).kind != ESCAPE_NONE) {
            in->escaped = true;
            break;
        }
        const double h = stepping_accept(s, t, N_VGetArrayPointer(in->y));
        const Exchange before = s->now.exchange;
        s->now.exchange = exchange_at(in->w);
        exchange_add(h, &before, &s->now.exchange, &s->sum);
        ARKodeGetCurrentStep(in->arkode, &h_next);
        in->hook(in->context, h, in->w);
    }

    // Values for the next advance.  The last stage was at the new state: its derivative is known.
    in->starting = false;
    ARKodeGetNumErrTestFails(in->arkode, &failed);
    s->error_tests_failed += (double)(failed - failed_before);
    s->h = fmax(h_next, KEPT_STEP * s->h);
    if (status < 0 || in->escaped) return status;
    s->t = t_stop;
    memcpy(s->now.f, in->latest, (size_t)cage_states(in->model) * sizeof *s->now.f);
    s->f_is_current = 1;
    return 0;
}

int integrator_advance(Integrator *in, double t_stop, long max_steps)
{
    // Without a derivative at the start there is no step.
    integrator_evaluate(in);
    if (!in->kernels->all_finite(cage_states(in->model), in->s->now.f)) {
        memset(in->s->now.f, 0, sizeof in->s->now.f);
        in->s->f_is_current = 0;
        return ARK_RHSFUNC_FAIL;
    }
    in->escaped = false;
    if (in->model->p->solver.method != METHOD_EXPLICIT) {
        const int status = verlet_advance(in, t_stop, max_steps);
        return in->escaped ? ADVANCE_ESCAPED : status;
    }

    // SUNDIALS allocates memory for its error messages; in the reserved block.
    reserved_memory_use(&in->memory);
    const int status = explicit_advance(in, t_stop, max_steps);
    reserved_memory_use(NULL);
    return in->escaped ? ADVANCE_ESCAPED : status;
}

// Bound of a state of each class [SI]: far beyond all that a bearing does, and so small that the error of a step
// can still be told from the rounding of the state.
static const double LARGEST[SCALE_COUNT] = {
    [SCALE_LENGTH] = 1e6, [SCALE_NORMAL] = 1e6, [SCALE_MODE] = 1e6,  [SCALE_VELOCITY] = 1e6,
    [SCALE_ANGLE] = 1e15, [SCALE_TILT] = 1.0,   [SCALE_PLATE] = 1.0, [SCALE_HEAD] = 1.0,
    [SCALE_RATE] = 1e9,   [SCALE_ORBIT] = 1e9,  [SCALE_SPIN] = 1e9,  [SCALE_ENERGY] = 1e30,
};

bool integrator_state_is_valid(const IntegratorState *s, const Parameters *p)
{
    // A state crosses its range in no less than a microsecond [1/s].
    const double RATE = 1e6;

    // Time and step sizes.
    bool fine = values_are_within(&s->t, 1, LARGEST_TIME) && values_are_amounts(&s->now.h, 1) &&
                values_are_amounts(&s->now.ratio, 1) && s->now.ratio <= ratio_of(0.0) &&
                values_are_amounts(&s->h, 1) && s->h > 0.0 && values_are_amounts(&s->error_mean, 1) &&
                s->error_mean <= MOST_ERROR;
    const double LARGEST_HOUSING = 1e9;  // of position, velocity, acceleration and load
    const bool supported = p->housing.motion == HOUSING_MOTION_SUPPORTED;
    fine &= values_are_within(s->now.housing.x, 4 * HOUSING_DOF, supported ? LARGEST_HOUSING : 0.0);
    const bool turn = ball_spalls_given(p);
    fine &= values_are_within(s->now.turn.angle, Z, turn ? LARGEST[SCALE_ANGLE] : 0.0) &&
            values_are_within(s->now.turn.rate, Z, turn ? LARGEST[SCALE_SPIN] : 0.0);

    // States, their rates and the differences of their rates.
    for (const StateBlock *b = STATE_BLOCKS; b < STATE_BLOCKS + N_ALL_BLOCKS; b++) {
        const size_t n = (size_t)b->count;
        const double largest = b->offset < N_STATES || cage_vibrates(p) ? LARGEST[b->scale] : 0.0;
        fine &= values_are_within(s->now.y + b->offset, n, largest) &&
                values_are_within(s->now.f + b->offset, n, RATE * largest);
        fine &= values_are_within(s->now.jerk + b->offset, n, RATE * RATE * RATE * largest);
    }

    fine &= cage_memory_is_valid(&s->now.cage, p);

    // Exchange with the shaft; switch and counters.
    const double LARGEST_EXCHANGE = 1e30;
    const size_t amounts = sizeof(Exchange) / sizeof(double);
    fine &= values_are_within(&s->now.exchange.torque, amounts, LARGEST_EXCHANGE) &&
            values_are_within(&s->sum.torque, amounts, LARGEST_EXCHANGE) &&
            values_are_within(&s->since, 1, LARGEST_TIME);
    fine &= s->f_is_current == 0 || s->f_is_current == 1;
    return fine && value_is_count(s->steps) && value_is_count(s->rhs_evals) &&
           value_is_count(s->error_tests_failed);
}
