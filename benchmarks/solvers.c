// The core with another integrator: explicit Runge-Kutta methods of ARKODE, Adams and BDF of CVODE behind the
// core's integrator.h, so that model, inputs, edges of pulses, statistics and error weights are those of the
// FMU and only the stepping differs.
//
// Vectors are SUNDIALS' own serial ones.  BDF solves its Newton systems (1 - gamma J) x = b in one of two ways:
//
//   dense      SUNDIALS' dense matrix and its own difference quotients: what a general multibody solver does
//   diagonal   J = -D, the damping rates that the core computes, each state for itself: no factorization
//
// The friction states of joints that slip are mapped back behind each step.  Multistep methods, whose history does not know it, begin anew
// where a joint has slipped.
//
// A statistics hook needs the right-hand side at accepted states.  Multistep methods do not evaluate there:
// those evaluations are made only where a scene wants stress or statistics.
#include "solvers.h"

#include "cage/common/cage_joint.h"
#include "instance/instance.h"
#include "solver/stepping.h"

#include <arkode/arkode_erkstep.h>
#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <stdlib.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

typedef struct {
    SolverMethod method;
    const char *table;
    SolverJacobian jacobian;
    double output_interval;
} Choice;

static Choice chosen = {.method = SOLVER_ERK, .table = "ARKODE_DORMAND_PRINCE_7_4_5"};
static double jacobian_evals_made, outputs_made;

void solver_choose(SolverMethod method, const char *table, SolverJacobian jacobian, double output_interval)
{
    chosen = (Choice){method, table, jacobian, output_interval};
    jacobian_evals_made = outputs_made = 0.0;
}

void solver_counts(double *jacobian_evals, double *outputs)
{
    *jacobian_evals = jacobian_evals_made;
    *outputs = outputs_made;
}

struct Integrator {
    Choice choice;
    const Kernels *kernels;
    const Model *model;
    Work *w;
    IntegratorState *s;
    StepHook *hook;
    IntegratorLog *log;
    void *context;
    SUNContext sun;
    N_Vector y, between;
    void *solver;
    SUNMatrix matrix;
    SUNLinearSolver linear;
    SUNNonlinearSolver nonlinear;
    double weight[N_ALL_STATES];
    double t_latest, y_latest[N_STATES], f_latest[N_STATES];  // the evaluation that w belongs to
    double rates[N_STATES];                                   // D of the diagonal Jacobian
    bool rates_known;
    unsigned nonfinite_stages;
    double t_output;
};

// ---- right-hand side --------------------------------------------------------------------------------------
// f(t, y); nothing is computed if w belongs to (t, y) already.
static const double *evaluate(Integrator *in, double t, const double *y, double *counter)
{
    if (t != in->t_latest || memcmp(y, in->y_latest, sizeof in->y_latest) != 0) {
        in->kernels->rhs(in->model, t, y, in->f_latest, in->w);
        in->t_latest = t;
        memcpy(in->y_latest, y, sizeof in->y_latest);
        *counter += 1.0;
    }
    return in->f_latest;
}

static int right_hand_side(sunrealtype t, N_Vector y, N_Vector f, void *user)
{
    Integrator *in = user;
    memcpy(N_VGetArrayPointer(f), evaluate(in, t, N_VGetArrayPointer(y), &in->s->rhs_evals),
           sizeof in->f_latest);
    if (in->kernels->all_finite(N_STATES, in->f_latest)) return 0;
    if (in->choice.method != SOLVER_ERK)
        return 1;  // CVODE tries a smaller step; ERKStep cannot, so its error test is made to fail
    stepping_refuse(in->weight, N_STATES, in->nonfinite_stages++, N_VGetArrayPointer(f));
    return 0;
}

// Maps friction states at the end y of a step back; whether any has slipped.  The derivative there depends only on the part of the states
// that friction bears, so that it stays.
static bool slide(Integrator *in, double t, double *y)
{
    evaluate(in, t, y, &in->s->rhs_evals);
    in->kernels->cage_slide(in->model, in->s->now.y, y, in->w);
    const bool slipped = memcmp(&y[Y_JOINT_PLATE_Y], &in->y_latest[Y_JOINT_PLATE_Y],
                                (Y_WORK - Y_JOINT_PLATE_Y) * sizeof *y) != 0;
    memcpy(in->y_latest, y, sizeof in->y_latest);
    return slipped;
}

static int accepted(sunrealtype t, N_Vector y, void *user)
{
    slide(user, t, N_VGetArrayPointer(y));
    return 0;
}

static int weights(N_Vector y, N_Vector ewt, void *user)
{
    (void)y;
    memcpy(N_VGetArrayPointer(ewt), ((const Integrator *)user)->weight, sizeof(double) * N_STATES);
    return 0;
}

// ---- diagonal Jacobian ------------------------------------------------------------------------------------
// By traction, pockets, land films and bristles, each state for itself.
static void diagonal_rates(Integrator *in)
{
    enum { AXES = 3 };

    static const int V[AXES] = {Y_BALL_V_X, Y_BALL_V_R, Y_BALL_OMEGA_M};
    static const int OMEGA[AXES] = {Y_BALL_OMEGA_X, Y_BALL_OMEGA_R, Y_BALL_OMEGA_T};
    const Work *w = in->w;
    const Derived *d = in->model->d;
    const Parameters *p = in->model->p;
    const double *v_pocket[AXES] = {w->D_x, w->D_r, w->D_t};
    const double *omega_pocket[AXES] = {w->D_omega_x, w->D_omega_r, w->D_omega_t};
    memset(in->rates, 0, sizeof in->rates);
    for (int j = 0; j < Z; j++) {
        const double n_i[AXES] = {w->n_ix[j], w->n_ir[j], w->n_it[j]};
        const double n_e[AXES] = {w->n_ex[j], w->n_er[j], 0.0};
        for (int i = 0; i < AXES; i++) {
            const double g = w->g_i[j] * (1.0 - n_i[i] * n_i[i]) + w->g_e[j] * (1.0 - n_e[i] * n_e[i]);
            in->rates[V[i] + j] = v_pocket[i][j] + g / d->m;
            in->rates[OMEGA[i] + j] = omega_pocket[i][j] + g * d->R[j] * d->R[j] / d->J;
        }
    }
    for (int h = 0; h < 2; h++) {
        const double x = (h == 0 ? -p->cage.land_x : p->cage.land_x) - d->com_x[h], xx = x * x;
        in->rates[Y_CAGE_V_Y + h] = w->film[h].yy / p->cage.m;
        in->rates[Y_CAGE_V_Z + h] = w->film[h].zz / p->cage.m;
        in->rates[Y_CAGE_BETA_DOT + h] = xx * w->film[h].zz / p->cage.J_t;
        in->rates[Y_CAGE_GAMMA_DOT + h] = xx * w->film[h].yy / p->cage.J_t;
        in->rates[Y_CAGE_S + h] = w->film[h].spin / p->cage.J_p;
    }
    for (int k = 0; k < Z; k++) {
        const double speed = sqrt(w->v_jy[k] * w->v_jy[k] + w->v_jz[k] * w->v_jz[k]), mu = p->joint.mu;
        const double floor = p->joint.F_floor;
        in->rates[Y_JOINT_PLATE_Y + k] = in->rates[Y_JOINT_PLATE_Z + k] =
            speed * d->k_plate_t / (mu * w->cage.two_half.N_plate[k] + floor);
        in->rates[Y_JOINT_HEAD_Y + k] = in->rates[Y_JOINT_HEAD_Z + k] =
            speed * d->k_head / (mu * w->cage.two_half.rivet[0][k] + floor);
    }
}

static SUNLinearSolver_Type embedded(SUNLinearSolver solver)
{
    (void)solver;
    return SUNLINEARSOLVER_MATRIX_EMBEDDED;
}

static int diagonal_solve(SUNLinearSolver solver, SUNMatrix none, N_Vector x, N_Vector b,
                          sunrealtype tolerance)
{
    (void)none, (void)tolerance;
    Integrator *in = solver->content;
    double gamma;
    if (CVodeGetCurrentGamma(in->solver, &gamma) != CV_SUCCESS) return -1;
    if (!in->rates_known) diagonal_rates(in);
    in->rates_known = true;
    for (int i = 0; i < N_STATES; i++)
        N_VGetArrayPointer(x)[i] = N_VGetArrayPointer(b)[i] / (1.0 + gamma * in->rates[i]);
    return 0;
}

static SUNErrCode linear_free(SUNLinearSolver solver)
{
    SUNLinSolFreeEmpty(solver);
    return SUN_SUCCESS;
}

// ---- creation ---------------------------------------------------------------------------------------------
static void report(int line, const char *function, const char *file, const char *message, SUNErrCode code,
                   void *user, SUNContext sun)
{
    (void)file, (void)sun;
    const Integrator *in = user;
    stepping_report(in->s->t, function, line, message, (int)code, in->log, in->context);
}

static bool set_up_erk(Integrator *in)
{
    in->solver = ERKStepCreate(right_hand_side, 0.0, in->y, in->sun);
    return in->solver != NULL && ARKodeSetUserData(in->solver, in) == ARK_SUCCESS &&
           ARKodeWFtolerances(in->solver, weights) == ARK_SUCCESS &&
           ERKStepSetTableName(in->solver, in->choice.table) == ARK_SUCCESS &&
           ARKodeSetPostprocessStepFn(in->solver, accepted) == ARK_SUCCESS &&
           ARKodeSetMaxErrTestFails(in->solver, 30) == ARK_SUCCESS &&
           ARKodeSetMaxHnilWarns(in->solver, -1) == ARK_SUCCESS &&
           (in->choice.output_interval > 0.0 ||
            ARKodeSetInterpolantType(in->solver, ARK_INTERP_NONE) == ARK_SUCCESS);
}

static bool set_up_dense(Integrator *in)
{
    in->matrix = SUNDenseMatrix(N_STATES, N_STATES, in->sun);
    in->linear = in->matrix != NULL ? SUNLinSol_Dense(in->y, in->matrix, in->sun) : NULL;
    return in->linear != NULL && CVodeSetLinearSolver(in->solver, in->linear, in->matrix) == CV_SUCCESS;
}

static bool set_up_diagonal(Integrator *in)
{
    in->linear = SUNLinSolNewEmpty(in->sun);
    if (in->linear == NULL) return false;
    in->linear->content = in;
    in->linear->ops->gettype = embedded;
    in->linear->ops->solve = diagonal_solve;
    in->linear->ops->free = linear_free;
    return CVodeSetLinearSolver(in->solver, in->linear, NULL) == CV_SUCCESS;
}

static bool set_up_cvode(Integrator *in)
{
    in->solver = CVodeCreate(in->choice.method == SOLVER_ADAMS ? CV_ADAMS : CV_BDF, in->sun);
    if (in->solver == NULL || CVodeInit(in->solver, right_hand_side, 0.0, in->y) != CV_SUCCESS ||
        CVodeSetUserData(in->solver, in) != CV_SUCCESS ||
        CVodeWFtolerances(in->solver, weights) != CV_SUCCESS ||
        CVodeSetMaxErrTestFails(in->solver, 30) != CV_SUCCESS ||
        CVodeSetMaxConvFails(in->solver, 30) != CV_SUCCESS ||
        CVodeSetMaxHnilWarns(in->solver, -1) != CV_SUCCESS)
        return false;
    if (in->choice.method == SOLVER_ADAMS) {
        in->nonlinear = SUNNonlinSol_FixedPoint(in->y, 0, in->sun);
        return in->nonlinear != NULL && CVodeSetNonlinearSolver(in->solver, in->nonlinear) == CV_SUCCESS;
    }
    return in->choice.jacobian == JACOBIAN_DENSE ? set_up_dense(in) : set_up_diagonal(in);
}

Integrator *integrator_create(const Kernels *kernels, const Model *model, Work *w, IntegratorState *state,
                              StepHook *hook, IntegratorLog *log, void *context)
{
    Integrator *in = calloc(1, sizeof *in);
    if (in == NULL) return NULL;
    *in = (Integrator){.choice = chosen,
                       .kernels = kernels,
                       .model = model,
                       .w = w,
                       .s = state,
                       .hook = hook,
                       .log = log,
                       .context = context,
                       .t_latest = NAN};
    bool fine = SUNContext_Create(SUN_COMM_NULL, &in->sun) == SUN_SUCCESS;
    if (fine) {
        SUNContext_ClearErrHandlers(in->sun);
        fine = SUNContext_PushErrHandler(in->sun, report, in) == SUN_SUCCESS;
        in->y = N_VNew_Serial(N_STATES, in->sun);
        in->between = N_VNew_Serial(N_STATES, in->sun);
    }
    fine = fine && in->y != NULL && in->between != NULL &&
           (in->choice.method == SOLVER_ERK ? set_up_erk(in) : set_up_cvode(in));
    if (fine) return in;
    integrator_destroy(in);
    return NULL;
}

void integrator_destroy(Integrator *in)
{
    if (in == NULL) return;
    if (in->solver != NULL && in->choice.method == SOLVER_ERK) ARKodeFree(&in->solver);
    if (in->solver != NULL && in->choice.method != SOLVER_ERK) CVodeFree(&in->solver);
    if (in->nonlinear != NULL) SUNNonlinSolFree(in->nonlinear);
    if (in->linear != NULL) SUNLinSolFree(in->linear);
    if (in->matrix != NULL) SUNMatDestroy(in->matrix);
    if (in->between != NULL) N_VDestroy(in->between);
    if (in->y != NULL) N_VDestroy(in->y);
    if (in->sun != NULL) SUNContext_Free(&in->sun);
    free(in);
}

// States are not saved here.
bool integrator_state_is_valid(const IntegratorState *state, const Parameters *p)
{
    (void)state, (void)p;
    return false;
}

void integrator_tolerance(Integrator *in, double tolerance)
{
    stepping_weights(in->model->d, tolerance, in->weight);
}

// None of these solvers has steps of a fixed length.
void integrator_fix_step(Integrator *in)
{
    (void)in;
}

double fixed_steps(double step, double length)
{
    (void)step, (void)length;
    return 1.0;
}

// ---- stepping ---------------------------------------------------------------------------------------------
void integrator_evaluate(Integrator *in)
{
    if (in->s->f_is_current) return;
    in->t_latest = NAN;  // the drive may have changed
    memcpy(in->s->now.f, evaluate(in, in->s->t, in->s->now.y, &in->s->rhs_evals), sizeof in->y_latest);
    in->s->f_is_current = 1;
}

static int start(Integrator *in, double t_stop)
{
    const double h = fmin(in->s->h, t_stop - in->s->t);
    memcpy(N_VGetArrayPointer(in->y), in->s->now.y, sizeof in->y_latest);
    in->rates_known = false;
    if (in->choice.method == SOLVER_ERK)
        return ARKodeReset(in->solver, in->s->t, in->y) | ARKodeSetInitStep(in->solver, h) |
               ARKodeSetStopTime(in->solver, t_stop);
    return CVodeReInit(in->solver, in->s->t, in->y) | CVodeSetInitStep(in->solver, h) |
           CVodeSetStopTime(in->solver, t_stop);
}

// Counters of CVODE start anew with CVodeReInit.
static void count(Integrator *in)
{
    long failed = 0, dense_evals = 0;
    CVodeGetNumErrTestFails(in->solver, &failed);
    if (in->choice.method == SOLVER_BDF && in->choice.jacobian == JACOBIAN_DENSE)
        CVodeGetNumLinRhsEvals(in->solver, &dense_evals);
    jacobian_evals_made += (double)dense_evals;
    in->s->error_tests_failed += (double)failed;
}

static int one_step(Integrator *in, double t_stop, double *t)
{
    if (in->choice.method == SOLVER_ERK) return ARKodeEvolve(in->solver, t_stop, in->y, t, ARK_ONE_STEP);
    return CVode(in->solver, t_stop, in->y, t, CV_ONE_STEP);
}

// Maps the friction states behind a step of CVODE, up to t, back.
static int slide_and_begin_anew(Integrator *in, double t, double t_stop)
{
    double h = 0.0;
    if (!slide(in, t, N_VGetArrayPointer(in->y)) || t >= t_stop) return 0;
    CVodeGetCurrentStep(in->solver, &h);
    count(in);
    return CVodeReInit(in->solver, t, in->y) | CVodeSetInitStep(in->solver, fmin(h, t_stop - t)) |
           CVodeSetStopTime(in->solver, t_stop);
}

// Values at the output times that the last step went past.
static void interpolate(Integrator *in, double t)
{
    if (in->choice.output_interval <= 0.0) return;
    for (; in->t_output <= t; in->t_output += in->choice.output_interval) {
        if (in->t_output <= in->s->t) continue;
        if (in->choice.method == SOLVER_ERK)
            ARKodeGetDky(in->solver, in->t_output, 0, in->between);
        else
            CVodeGetDky(in->solver, in->t_output, 0, in->between);
        outputs_made += 1.0;
    }
}

int integrator_advance(Integrator *in, double t_stop, long max_steps)
{
    IntegratorState *s = in->s;
    const bool observed =
        in->model->p->scene.stress >= STRESS_PEAK || in->model->p->scene.statistics == SWITCH_ON;
    long failed_before = 0, failed = 0;
    double t = s->t;
    integrator_evaluate(in);
    int status = start(in, t_stop);
    if (in->choice.method == SOLVER_ERK) ARKodeGetNumErrTestFails(in->solver, &failed_before);
    if (status != 0) return -1;
    for (long step = 0; status >= 0 && s->t < t_stop; step++) {
        if (step >= max_steps) return CV_TOO_MUCH_WORK;
        if ((status = one_step(in, t_stop, &t)) < 0) break;
        interpolate(in, t);
        if (in->choice.method != SOLVER_ERK && (status = slide_and_begin_anew(in, t, t_stop)) != 0) break;
        const double h = stepping_accept(s, t, N_VGetArrayPointer(in->y));
        in->rates_known = false;
        if (observed) evaluate(in, s->t, s->now.y, &s->rhs_evals);
        in->hook(in->context, h, in->w);
    }
    if (in->choice.method == SOLVER_ERK) {
        ARKodeGetNumErrTestFails(in->solver, &failed);
        ARKodeGetLastStep(in->solver, &s->h);
    } else {
        count(in);
        CVodeGetLastStep(in->solver, &s->h);
    }
    s->error_tests_failed += (double)(failed - failed_before);
    if (status < 0) return status;
    s->t = t_stop;
    return 0;
}
