// A shaft that turns in two bearings, driven at one end, loaded by a gear: a part (part.h) to couple with the
// bearing's FMU.
//
//   drive k (omega_d - omega)          Y
//       ->|====A=========[G]=========B  |
//              |<-- x -->|           |  +-- X        mating gear at -Y, Z out of the page
//              |<-------- L -------->|
//
//   M      torque that the mating gear takes             F_t = M cos(alpha) / r_b       tangential, at the pitch radius r = r_b / cos(alpha)
//   alpha  pressure angle, transverse; beta helix        F_r = F_t tan(alpha)           radial, away from the mating gear
//                                                        F_a = F_t tan(beta)            axial              ISO 21771-1; Niemann, Maschinenelemente 2
//
// Loads on the bearings, moments about A (the shaft is statically determinate; A carries F_a):
//   B_y = (x F_r + r F_a) / L,  B_z = x F_t / L,         A = (F_a, F_r - B_y, F_t - B_z)
// A is a bearing with a motion of its own: its housing feels R instead of A.  What the shaft then lays on B
// is F - R, and it costs
//   M_B = mu |F - R| d / 2,                              SKF catalogue, constant coefficient of friction
//   J omega_dot = k (omega_d - omega) - M - M_A - M_B.   M_A: friction torque of bearing A
// C1 in omega: friction passes through rest as omega / sqrt(omega^2 + omega_0^2).
#include "instance/part.h"

#include "numbers/saved_numbers.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct {
    Parameters p;
    Inputs u[INPUT_ORDERS + 1];  // of the next step: at its start, with their derivatives
    Inputs u_now, u_now_dot;     // inputs under which the present state was reached, and their rates
    double t, y[N_STATES];
} State;

struct Part {
    PartHost host;
    State s;
    Outputs out;
};

// Length of a vector across the axis; C's hypot would ask for glibc 2.35, and no square leaves the range of doubles here.
static double length(double y, double z)
{
    return sqrt(y * y + z * z);
}

// ---- equations --------------------------------------------------------------------------------------------
// All that is linear in inputs and state: their derivatives follow from the same lines.
static void linear(const Parameters *p, const Inputs *u, const double *y, Outputs *out)
{
    const double r = p->gear.r_b / cos(p->gear.alpha);
    const double F_t = u->gear.M / r, F_r = F_t * tan(p->gear.alpha), F_a = F_t * tan(p->gear.beta);
    const double B_y = (p->gear.x * F_r + r * F_a) / p->shaft.L, B_z = p->gear.x * F_t / p->shaft.L;
    memset(out, 0, sizeof *out);
    out->gear.F_x = F_a, out->gear.F_y = F_r, out->gear.F_z = F_t;
    out->shaft.F_x = F_a, out->shaft.F_y = F_r - B_y, out->shaft.F_z = F_t - B_z;
    out->support.F_y = F_r - u->bearing.F_y, out->support.F_z = F_t - u->bearing.F_z;
    out->drive.M = p->drive.k * (u->drive.omega - y[Y_OMEGA]);
    out->shaft.phi = y[Y_PHI], out->shaft.omega = y[Y_OMEGA];
    out->work.drive = y[Y_WORK_DRIVE], out->work.gear = y[Y_WORK_GEAR];
    out->work.bearing = y[Y_WORK_BEARING], out->work.support = y[Y_WORK_SUPPORT];
}

// And the balance of torques, once the friction of B is known.
static void accelerate(const Parameters *p, const Inputs *u, double M_B, Outputs *out)
{
    out->support.M = M_B;
    out->shaft.omega_dot = (out->drive.M - u->gear.M - u->bearing.M_x - M_B) / p->shaft.J;
}

static void evaluate(const Parameters *p, const Inputs *u, const double *y, Outputs *out)
{
    linear(p, u, y, out);
    const double full = 0.5 * p->support.mu * p->support.d * length(out->support.F_y, out->support.F_z);
    accelerate(p, u, full * y[Y_OMEGA] / length(y[Y_OMEGA], p->support.omega_0), out);
}

// Derivatives of the outputs along a direction du, dy.
static void differentiate(const Parameters *p, const Inputs *u, const double *y, const Inputs *du,
                          const double *dy, Outputs *d)
{
    Outputs at;
    linear(p, u, y, &at);
    linear(p, du, dy, d);
    const double F = length(at.support.F_y, at.support.F_z), c = 0.5 * p->support.mu * p->support.d;
    const double dF = F > 0.0 ? (at.support.F_y * d->support.F_y + at.support.F_z * d->support.F_z) / F : 0.0;
    const double w = length(y[Y_OMEGA], p->support.omega_0),
                 slope = p->support.omega_0 * p->support.omega_0 / (w * w * w);
    accelerate(p, du, c * (dF * y[Y_OMEGA] / w + F * slope * dy[Y_OMEGA]), d);
}

static void rhs(const Parameters *p, const Inputs *u, const double *y, double *y_dot)
{
    Outputs at;
    evaluate(p, u, y, &at);
    y_dot[Y_PHI] = y[Y_OMEGA];
    y_dot[Y_OMEGA] = at.shaft.omega_dot;
    y_dot[Y_WORK_DRIVE] = at.drive.M * y[Y_OMEGA];
    y_dot[Y_WORK_GEAR] = u->gear.M * y[Y_OMEGA];
    y_dot[Y_WORK_BEARING] = u->bearing.M_x * y[Y_OMEGA];
    y_dot[Y_WORK_SUPPORT] = at.support.M * y[Y_OMEGA];
}

// ---- integration ------------------------------------------------------------------------------------------
// The inputs' polynomials, tau after the start of the step, and their rates.
static void course(const Inputs from[], double tau, Inputs *u, Inputs *u_dot)
{
    const double *u_0 = (const double *)&from[0], *u_1 = (const double *)&from[1],
                 *u_2 = (const double *)&from[2];
    for (int i = 0; i < N_INPUTS; i++) {
        ((double *)u)[i] = u_0[i] + tau * (u_1[i] + 0.5 * tau * u_2[i]);
        ((double *)u_dot)[i] = u_1[i] + tau * u_2[i];
    }
}

// One step of the classical Runge-Kutta method, tau after the start of the communication step.
static void runge_kutta(const State *s, double tau, double h, double *y)
{
    static const double node[4] = {0.0, 0.5, 0.5, 1.0}, weight[4] = {1.0 / 6, 1.0 / 3, 1.0 / 3, 1.0 / 6};
    double stage[N_STATES], slope[N_STATES] = {0.0}, sum[N_STATES] = {0.0};
    for (int k = 0; k < 4; k++) {
        Inputs u, rate;
        course(s->u, tau + node[k] * h, &u, &rate);
        for (int i = 0; i < N_STATES; i++) stage[i] = y[i] + node[k] * h * slope[i];
        rhs(&s->p, &u, stage, slope);
        for (int i = 0; i < N_STATES; i++) sum[i] += weight[k] * slope[i];
    }
    for (int i = 0; i < N_STATES; i++) y[i] += h * sum[i];
}

// Internal steps of a communication step: at most 0.1 ms, and a twentieth of the shortest time constant, that
// of drive and friction: error (1/20)^4 / 120 = 5e-8 for each time constant.
static double steps_needed(const State *s, double h)
{
    Outputs at;
    linear(&s->p, &s->u[0], s->y, &at);
    const double F = length(at.support.F_y, at.support.F_z);
    const double rate =
        (s->p.drive.k + 0.5 * s->p.support.mu * s->p.support.d * F / s->p.support.omega_0) / s->p.shaft.J;
    return ceil(h * fmax(1e4, 20.0 * rate));
}

PartStatus part_step(Part *part, double t_end)
{
    State *s = &part->s;

    enum { MOST_STEPS = 10000000 };

    const double h = t_end - s->t, n = steps_needed(s, h);
    char message[200];
    if (!(n <= MOST_STEPS)) {
        snprintf(message, sizeof message,
                 "t = %.9g s: a step of %g s would take %g internal steps: allowed are %d", s->t, h, n,
                 MOST_STEPS);
        part->host.log(part->host.environment, LOG_ERROR, message);
        return PART_ERROR;
    }
    double y[N_STATES];
    memcpy(y, s->y, sizeof y);
    for (int k = 0; k < (int)n; k++) runge_kutta(s, k * (h / n), h / n, y);
    if (!values_are_sane(y, N_STATES)) {
        snprintf(message, sizeof message, "t = %.9g s: speed and angle leave all bounds in the next %g s",
                 s->t, h);
        part->host.log(part->host.environment, LOG_ERROR, message);
        return PART_DISCARD;
    }
    memcpy(s->y, y, sizeof y);
    s->t = t_end;
    course(s->u, h, &s->u_now, &s->u_now_dot);
    s->u[0] = s->u_now;
    memset(&s->u[1], 0, INPUT_ORDERS * sizeof *s->u);
    return PART_OK;
}

// ---- life cycle -------------------------------------------------------------------------------------------
Part *part_create(const PartHost *host)
{
    Part *part = malloc(sizeof *part);
    if (!part) return NULL;
    part->host = *host;
    part_reset(part);
    return part;
}

void part_destroy(Part *part)
{
    free(part);
}

void part_reset(Part *part)
{
    memset(&part->s, 0, sizeof part->s);
    variables_set_start(&part->s.p, &part->s.u[0]);
}

PartStatus part_initialize(Part *part, double t_start, double tolerance)
{
    (void)tolerance;  // the error is far below any
    part->s.t = t_start;
    part->s.y[Y_OMEGA] = part->s.p.shaft.omega_start;
    part->s.u_now = part->s.u[0];
    part->s.u_now_dot = part->s.u[1];
    return PART_OK;
}

Parameters *part_parameters(Part *part)
{
    return &part->s.p;
}

Inputs *part_inputs(Part *part, int order)
{
    return &part->s.u[order];
}

const Outputs *part_outputs(const Part *part)
{
    return &part->out;
}

double part_time(const Part *part)
{
    return part->s.t;
}

// ---- outputs ----------------------------------------------------------------------------------------------
void part_update(Part *part, OutputGroup group)
{
    (void)group;  // all together: a few multiplications
    evaluate(&part->s.p, &part->s.u_now, part->s.y, &part->out);
}

void part_time_derivatives(Part *part, Outputs *derivatives)
{
    double y_dot[N_STATES];
    rhs(&part->s.p, &part->s.u_now, part->s.y, y_dot);
    differentiate(&part->s.p, &part->s.u_now, part->s.y, &part->s.u_now_dot, y_dot, derivatives);
}

void part_directional_derivatives(Part *part, const Inputs *inputs, const double state[N_ALL_STATES],
                                  Outputs *derivatives)
{
    differentiate(&part->s.p, &part->s.u_now, part->s.y, inputs, state, derivatives);
}

// ---- saved state ------------------------------------------------------------------------------------------
size_t part_saved_size(void)
{
    return sizeof(State);
}

void part_save(Part *part, void *saved)
{
    memcpy(saved, &part->s, sizeof part->s);
}

void part_restore(Part *part, const void *saved)
{
    memcpy(&part->s, saved, sizeof part->s);
}

static void report_error(void *part, const char *message)
{
    const PartHost *host = &((Part *)part)->host;
    host->log(host->environment, LOG_ERROR, message);
}

bool part_restore_unknown(Part *part, const void *saved)
{
    State *s = &part->s;
    memcpy(s, saved, sizeof *s);
    bool fine = values_are_within(&s->t, 1, LARGEST_TIME) && values_are_sane(s->y, N_STATES);
    fine = fine &&
           values_are_within((const double *)&s->u[1], (size_t)INPUT_ORDERS * N_INPUTS, LARGEST_DERIVATIVE) &&
           values_are_sane((const double *)&s->u_now_dot, N_INPUTS);
    if (!fine) report_error(part, "time, states or rates of inputs: not what a run can have left there");
    return fine && variables_allow(CAUSALITY_PARAMETER, &s->p, 0.0, report_error, part) &&
           variables_allow(CAUSALITY_INPUT, &s->u[0], 0.0, report_error, part) &&
           variables_allow(CAUSALITY_INPUT, &s->u_now, 0.0, report_error, part);
}

bool part_is_initialized(const Part *part)
{
    (void)part;  // it can be stepped from any state
    return true;
}

const char *part_data_digest(void)
{
    return "";
}
