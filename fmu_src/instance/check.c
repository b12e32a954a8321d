// Refusals before a run or a step: values outside their limits, parameters that make no bearing, a rivet
// table that belongs to another bearing.
#include "cage/cage.h"
#include "instance/instance.h"
#include "numbers/saved_numbers.h"
#include "physics/race_surface.h"
#include "physics/ring_fit.h"
#include "physics/ring_load.h"
#include "physics/temperature.h"
#include "rivet/rivet_rom.h"

#include <float.h>
#include <stddef.h>
#include <stdio.h>

static void report_error(void *bearing, const char *message)
{
    bearing_log(bearing, LOG_ERROR, "%s", message);
}

// Checks all values of one causality (Parameters or Inputs) against the limits of the variable table.
static bool check_variables(Bearing *b, Causality causality, const void *values)
{
    return variables_allow(causality, values, 0.0, report_error, b);
}

// Whether all inputs lie within their limits; a NaN does not.
static bool inputs_lie_within(const Inputs *u)
{
    const double *value = (const double *)u;
    bool fine = true;
    for (int i = 0; i < N_INPUTS; i++)
        fine &= value[i] >= INPUT_LIMITS[i][0] && value[i] <= INPUT_LIMITS[i][1];
    return fine;
}

// Part of a limit by which the polynomial of a trajectory may round a limit that the caller asks for.
static const double REACHED = 1e-12;

// Checks inputs; the table with its messages is for those beyond a limit.  rounding: 0 of inputs that the caller asks for, REACHED of
// those that a trajectory reaches.
static bool check_within(Bearing *b, const Inputs *u, double rounding)
{
    return inputs_lie_within(u) || variables_allow(CAUSALITY_INPUT, u, rounding, report_error, b);
}

// Checks the acceleration of the bearing's centre, which the frame's arm makes of its rotation: at most the limit of frame.a_*.
static bool check_frame(Bearing *b, const Inputs *u)
{
    const double most = INPUT_LIMITS[offsetof(Inputs, frame.a_y) / sizeof(double)][1],
                 R = b->s.p.frame.radius;
    const double inward = u->frame.omega * u->frame.omega * R, along = fabs(u->frame.omega_dot) * R;
    if (inward <= most && along <= most) return true;
    const bool fast = inward > most;
    bearing_log(
        b, LOG_ERROR,
        "frame.%s = %g %s, frame.radius = %g m: the bearing's centre is accelerated by %g m/s2; at most "
        "%g m/s2 is allowed, as of frame.a_y",
        fast ? "omega" : "omega_dot", fast ? u->frame.omega : u->frame.omega_dot, fast ? "rad/s" : "rad/s2",
        R, fast ? inward : along, most);
    return false;
}

// Where the motions that are given lead within a step of length h.  A motion that is catching up with the given one
// (motion_trajectory) may be faster.
static bool check_motions(Bearing *b, double h)
{
    if (!(h > 0.0)) return true;
    Inputs u[INPUT_ORDERS + 1], end;
    InputTrajectory trajectory = {.t_0 = 0.0};
    MotionLag lag;
    motion_trajectory(&b->s.p, b->s.u, &b->s.history, &b->s.u[0], h, u, &lag);
    if (memcmp(u, b->s.u, sizeof u) == 0) return true;
    memcpy(trajectory.u, u, sizeof u);
    input_trajectory_at(&trajectory, h, &end);
    return check_within(b, &end, REACHED);
}

// Parameters at temperatures: for their refusals.
typedef struct {
    Bearing *b;
    const Inputs *u;
} Hot;

static void report_hot(void *context, const char *message)
{
    const Hot *hot = context;
    const Inputs *u = hot->u;
    bearing_log(hot->b, LOG_ERROR,
                "oil.T = %g K, ring.T_i = %g K, ring.T_e = %g K, ball.T = %g K, cage.T = %g K: there %s",
                u->oil.T, u->ring.T_i, u->ring.T_e, u->ball.T, u->cage.T, message);
}

// Checks that oil and bearing bear the temperatures in u: viscosity within its limits, cage neither on the
// outer ring nor on the balls, no interference beyond the limits of the parameters.
static bool check_temperatures(Bearing *b, const Inputs *u)
{
    static const char *const VALUES[] = {"oil.eta", "cage.guide_clearance", "cage.pocket_clearance"};
    Parameters hot;
    Hot context = {b, u};
    temperature_apply(&b->s.p, u, &hot);
    bool fine = true;
    for (size_t i = 0; i < sizeof VALUES / sizeof *VALUES; i++) {
        char message[512];
        const Variable *v = variable_named(VALUES[i]);
        if (variable_allows(v, 0, variable_value(v, 0, &hot), message, sizeof message)) continue;
        report_hot(&context, message);
        fine = false;
    }
    fine &= limits_hold(&hot, "cage.pocket_depth", report_hot, &context);
    return limits_hold(&hot, "bearing.P_d", report_hot, &context) && fine;
}

// Inputs are polynomials of second order: their extremes are at the ends of the step or where their slope
// vanishes.
bool check_inputs(Bearing *b, double h)
{
    const double *u_1 = (const double *)&b->s.u[1], *u_2 = (const double *)&b->s.u[2];
    InputTrajectory trajectory = {.t_0 = 0.0, .u = {b->s.u[0], b->s.u[1], b->s.u[2]}};
    Inputs u = b->s.u[0], turning = u;
    if (!check_motions(b, h)) return false;
    if (!input_trajectory_varies(&trajectory))
        return check_within(b, &u, 0.0) && check_frame(b, &u) &&
               (temperature_same(&b->s.u_now, &u) || check_temperatures(b, &u));
    input_trajectory_at(&trajectory, h, &u);
    for (int i = 0; i < N_INPUTS; i++) {
        const double tau = -u_1[i] / u_2[i];
        if (tau > 0.0 && tau < h) ((double *)&turning)[i] += 0.5 * tau * u_1[i];
    }
    return check_within(b, &b->s.u[0], 0.0) && check_within(b, &u, REACHED) &&
           check_within(b, &turning, REACHED) && check_frame(b, &b->s.u[0]) && check_frame(b, &u) &&
           check_temperatures(b, &b->s.u[0]) && check_temperatures(b, &u);
}

// Logs value and limit unless the condition holds.
static bool require(Bearing *b, bool condition, const char *format, double value, double limit)
{
    if (!condition) bearing_log(b, LOG_ERROR, format, value, limit);
    return condition;
}

// Checks that there is such a cage.
static bool check_cage(Bearing *b)
{
    const char *refusal = cage_refusal(&b->s.p);
    if (refusal) bearing_log(b, LOG_ERROR, "%s", refusal);
    return refusal == NULL;
}

// Fills in the sizes that 0 leaves to a rule and the moments of inertia that follow the mass.
static Parameters in_force(const Parameters *given)
{
    Parameters p = *given;
    cage_half_inertia(given, &p.cage.J_p, &p.cage.J_t);
    p.ring.bore = ring_fit_bore(given);
    p.ring.outside = ring_fit_outside(given);
    p.ring.effective_i = ring_fit_effective_i(given);
    p.ring.effective_e = ring_fit_effective_e(given);
    if (p.cage.shape == CAGE_SHAPE_RIBBON) p.cage.pocket_edge = spheres_edge(given);
    return p;
}

// Checks that the rims of a ribbon's pocket leave a sphere between them; the angles of the seams follow from the pocket's law.
static bool check_seams(Bearing *b)
{
    if (b->s.p.cage.shape != CAGE_SHAPE_RIBBON) return true;
    const double most = 0.95;
    double sin_chi, sin_eta;
    spheres_seams(&b->s.p, &sin_chi, &sin_eta);
    const double squares = sin_chi * sin_chi + sin_eta * sin_eta;
    return require(b, squares < most,
                   "cage.pocket_fillet, cage.D_o - cage.D_i: the sum of the squares of the sines of the "
                   "angles of fillet and "
                   "edges is %g; less than %g is allowed for a sphere between them",
                   squares, most);
}

// Checks parameters against each other.
static bool check_geometry(Bearing *b)
{
    const Parameters p = in_force(&b->s.p);
    return limits_hold(&p, NULL, report_error, b) && check_seams(b) && check_cage(b);
}

// Checks that the halves have room for the seat of the rivet's head: metal inside and outside of it, a
// bridge between the pockets around it.  The least wall is that of rivet_model/half_shape.py.
static bool check_seat(Bearing *b)
{
    const Parameters *p = &b->s.p;
    if (p->cage.shape != CAGE_SHAPE_MACHINED) return true;
    const double wall = 0.2e-3, seat = rivet_table.joint.seat + 2.0 * wall, r = 0.5 * p->cage.D_i;
    const double inside = p->bearing.d_m - seat, outside = p->bearing.d_m + seat;
    const double tolerance = 1e-6 * p->bearing.d_m;
    bool fine =
        require(b, p->cage.D_i <= inside + tolerance,
                "cage.D_i = %g m: no metal inside the seat of the rivet's head; at most %g m is allowed",
                p->cage.D_i, inside);
    fine &=
        require(b, p->cage.D_o >= outside - tolerance,
                "cage.D_o = %g m: no metal outside the seat of the rivet's head; at least %g m is allowed",
                p->cage.D_o, outside);
    const double pocket = 2.0 * r * sin(PI / Z - asin(fmin(0.5 * seat / r, 1.0)));
    fine &=
        require(b, p->bearing.D + p->cage.pocket_clearance <= pocket + tolerance,
                "cage.pocket_clearance = %g m: the bridges between the pockets do not hold the seat of the "
                "rivet's head; at most %g m is allowed",
                p->cage.pocket_clearance, pocket - p->bearing.D);
    return fine;
}

// Checks the parameters that the build fixes: the constants of the cage's material, from which the rivet
// table was made.
static bool check_built(Bearing *b)
{
    bool fine = true;
    for (const Variable *v = VARIABLES; v < VARIABLES + N_VARIABLES; v++) {
        if (!v->built) continue;
        const double value = variable_value(v, 0, &b->s.p);
        if (value == v->start) continue;
        const bool shape = strcmp(v->name, "cage.shape") == 0;
        bearing_log(b, LOG_ERROR,
                    "%s = %g: %g is allowed, of the %s for which this FMU and its rivet table were "
                    "built; for another %s build an FMU from a bearing file with [cage] %s",
                    v->name, value, v->start, shape ? "shape" : "material", shape ? "shape" : "material",
                    shape ? "shape" : "material");
        fine = false;
    }
    return fine;
}

// Checks the embedded rivet table, which belongs to one number of rivets and one pitch circle.
static bool check_table(Bearing *b)
{
    const double d_m = b->s.p.bearing.d_m, table = rivet_table.joint.d_m;
    bool fine = require(
        b, rivet_table.Z == Z,
        "the embedded rivet table is for Z = %g; this FMU has Z = %g: build it with a table for this bearing",
        rivet_table.Z, Z);
    fine &= require(
        b, fabs(d_m - table) <= 1e-3 * table,
        "bearing.d_m = %g m: the embedded load path is for %g m +- 0.1 %%; build an FMU for this bearing",
        d_m, table);
    fine &= require(
        b, fabs(b->s.p.cage.x_c - rivet_table.half.x_c) <= 0.02 * rivet_table.half.x_c,
        "cage.x_c = %g m: allowed is %g m +- 2 %%, the centre of mass of the cage half in the embedded rivet "
        "table; build an FMU for this cage",
        b->s.p.cage.x_c, rivet_table.half.x_c);
    return fine;
}

// Parameters and inputs, but not whether the bearing bears the temperatures.
static bool check_values(Bearing *b)
{
    bool fine = check_variables(b, CAUSALITY_PARAMETER, &b->s.p);
    fine &= check_variables(b, CAUSALITY_INPUT, &b->s.u[0]);
    return fine && check_built(b) && check_geometry(b) && check_table(b) && check_seat(b);
}

bool check_all(Bearing *b)
{
    return check_values(b) && check_frame(b, &b->s.u[0]) && check_temperatures(b, &b->s.u[0]);
}

bool check_change(Bearing *b)
{
    const InstanceState *s = &b->s;
    if (memcmp(&s->p, &s->p_now, sizeof s->p) == 0) return true;
    const double t = s->integrator.t;
    if (memcmp(&s->p.pulse, &s->p_now.pulse, sizeof s->p.pulse) != 0 &&
        (pulse_in_progress(&s->p, t) || pulse_in_progress(&s->p_now, t))) {
        bearing_log(
            b, LOG_ERROR,
            "pulse.t_start = %g s, pulse.interval = %g s, pulse.duration = %g s: an impact has begun before "
            "t = %.9g s and not ended; a change between impacts is allowed",
            s->p.pulse.t_start, s->p.pulse.interval, s->p.pulse.duration, t);
        return false;
    }
    return check_geometry(b) && check_temperatures(b, &s->u[0]);
}

// Variables that have no effect on a ring whose motion is free, on one whose motion is prescribed, on one whose tilt is given, on
// one that tilts freely; parameters cannot change after the start.
static const char *const OF_PRESCRIBED[] = {"shaft.x",          "shaft.y",          "shaft.z",
                                            "shaft.v_x",        "shaft.v_y",        "shaft.v_z",
                                            "shaft.tilt_y_dot", "shaft.tilt_z_dot", NULL};
static const char *const OF_FREE[] = {"shaft.F_x",      "shaft.F_y",
                                      "shaft.F_z",      "shaft.M_y",
                                      "shaft.M_z",      "impact.F_r",
                                      "impact.F_a",     "pulse.F_r",
                                      "pulse.F_a",      "pulse.t_start",
                                      "pulse.duration", "pulse.interval",
                                      "pulse.count",    "ring.m",
                                      "ring.J_p",       "ring.J_t",
                                      "ring.c",         "ring.tilt_mode",
                                      "ring.k_tilt",    "ring.c_tilt",
                                      "ring.tilt_time", NULL};
static const char *const MOMENTS[] = {"shaft.M_y", "shaft.M_z", NULL};
static const char *const TILTS[] = {"shaft.tilt_y", "shaft.tilt_z", NULL};

// Sizes of which the rivet table holds those of the build: it keeps them when the parameters change.  Not among them is the pockets'
// clearance, which runs vary: a table for twice as much moves the 6207's head stress by 2 %, no more than four seeds scatter.
static const char *const SIZES_OF_TABLE[] = {"bearing.D",          "cage.D_o",   "cage.D_i",
                                             "cage.width",         "cage.sheet", "cage.pocket_depth",
                                             "cage.pocket_fillet", NULL};

// Adds the variables whose value is off that of the start by more than a part of it to a list of names.
static void add_changed(const Bearing *b, const char *const names[], double part, char *list, size_t size)
{
    for (; *names; names++) {
        const Variable *v = variable_named(*names);
        const bool input = v->causality == CAUSALITY_INPUT;
        const double value = variable_value(v, 0, input ? (const void *)&b->s.u[0] : &b->s.p);
        const size_t length = strlen(list);
        if (fabs(value - v->start) > part * fabs(v->start) && (input || !b->s.initialized))
            snprintf(list + length, size - length, "%s%s", length > 0 ? ", " : "", v->name);
    }
}

static void report_changed(Bearing *b, const char *what, const char *is, const char *const names[])
{
    char list[512] = "";
    add_changed(b, names, 0.0, list, sizeof list);
    if (!*list) return;
    b->reported = true;
    bearing_log(b, LOG_WARNING, "%s is %s: no effect have %s", what, is, list);
}

void report_without_effect(Bearing *b)
{
    if (b->reported) return;
    const bool prescribed = b->s.p.ring.motion == RING_MOTION_PRESCRIBED;
    const int mode = b->s.p.ring.tilt_mode;
    report_changed(b, "ring.motion", prescribed ? "prescribed" : "free",
                   prescribed ? OF_FREE : OF_PRESCRIBED);
    if (prescribed) return;
    if (mode == TILT_MODE_PRESCRIBED) report_changed(b, "ring.tilt_mode", "prescribed", MOMENTS);
    if (mode == TILT_MODE_FREE) report_changed(b, "ring.tilt_mode", "free", TILTS);
}

// Logs that the parts stay at their start temperatures where the oil alone has been given another one.
static void report_parts_left(Bearing *b)
{
    static const char *const PARTS[] = {"ring.T_i", "ring.T_e", "ball.T", "cage.T", NULL};
    static const char *const OIL[] = {"oil.T", NULL};

    const Inputs *u = &b->s.u[0];
    const double T = u->oil.T, zero = 273.15;  // [K] of 0 degC
    const bool equal = u->ring.T_i == T && u->ring.T_e == T && u->ball.T == T && u->cage.T == T;
    char parts[128] = "", oil[128] = "";
    add_changed(b, PARTS, 0.0, parts, sizeof parts);
    add_changed(b, OIL, 0.0, oil, sizeof oil);
    if (*parts || equal || !*oil) return;
    bearing_log(
        b, LOG_WARNING,
        "oil.T = %g degC is set, the parts' temperatures are not: ring.T_i = %g degC, ring.T_e = %g degC, "
        "ball.T = %g degC, cage.T = %g degC, at which clearances, preload and fit are taken",
        T - zero, u->ring.T_i - zero, u->ring.T_e - zero, u->ball.T - zero, u->cage.T - zero);
}

// Logs sizes by which the dynamics leave the rivet table behind: 1 % moves a half's bending stiffness by some per cent.
static void report_sizes_of_table(Bearing *b)
{
    char list[128] = "";
    add_changed(b, SIZES_OF_TABLE, 0.01, list, sizeof list);
    if (*list)
        bearing_log(
            b, LOG_WARNING,
            "%s: more than 1 %% off the start value; contacts and films have the new size, the embedded "
            "rivet table (modes, load path, stress) that of the build: build an FMU for this size",
            list);
}

void report_start(Bearing *b)
{
    report_without_effect(b);
    report_parts_left(b);
    report_sizes_of_table(b);
}

bool check_start(Bearing *b)
{
    const Inputs *u = &b->s.u[0];
    const bool prescribed = b->s.p.ring.motion == RING_MOTION_PRESCRIBED;
    const double load[3] = {u->shaft.F_x, u->shaft.F_y, u->shaft.F_z};
    const double place[3] = {u->shaft.x, u->shaft.y, u->shaft.z};
    const double *drive = prescribed ? place : load;
    const char *name = prescribed ? "shaft." : "shaft.F_", *unit = prescribed ? "m" : "N";
    for (int i = 0; i < 2 * Z; i++) {
        const double reach = ellipse_reach(&b->model, &b->w, i % 2 == 1, i / 2);
        if (reach < 0.5 * PI) continue;
        bearing_log(
            b, LOG_ERROR,
            "ball[%d] is pressed out of the %s race's groove at the start: its contact reaches to %g rad, "
            "less than pi/2 is allowed; %sx = %g %s, %sy = %g %s, %sz = %g %s, shaft.tilt_y = %g rad, "
            "shaft.tilt_z = %g rad are too much",
            i / 2 + 1, i % 2 == 1 ? "outer" : "inner", reach, name, drive[0], unit, name, drive[1], unit,
            name, drive[2], unit, u->shaft.tilt_y, u->shaft.tilt_z);
        return false;
    }
    return true;
}

static bool is_zero(const void *memory, size_t size)
{
    const unsigned char *byte = memory;
    for (size_t i = 0; i < size; i++)
        if (byte[i] != 0) return false;
    return true;
}

static bool saved_is(Bearing *b, bool condition, const char *what)
{
    if (!condition) bearing_log(b, LOG_ERROR, "%s: not what a run can have left there", what);
    return condition;
}

static bool lag_is_valid(const MotionLag *lag)
{
    const double mismatch[] = {lag->x, lag->v};
    return lag->count >= 0 && lag->count <= MOTIONS && lag->motion >= 0 && lag->motion < MOTIONS &&
           values_are_sane(mismatch, 2);
}

static bool step_end_is_valid(const StepEnd *end)
{
    return (end->force_known == 0 || end->force_known == 1) &&
           (end->stress_known == 0 || end->stress_known == 1) && values_are_amounts(end->force, Z) &&
           values_are_sane(end->head, STRESS_CHANNELS) && values_are_sane(end->mid, STRESS_CHANNELS);
}

// Of each rivet and of all balls together, over the time since the start; every ball adds its own time to the
// pocket forces.
static bool check_recorded(Bearing *b, double time)
{
    const InstanceState *s = &b->s;
    const double amounts[] = {s->force_peak, s->dislocation_max, s->duty_time, s->eccentricity_time};
    const double sums[] = {s->energy_start, s->energy_change, s->omega_time,
                           s->lost,         s->exchanged,     s->jumped};
    bool stress = true, turning = true;
    for (int k = 0; k < STRESS_CHANNELS; k++)
        stress &= statistics_is_valid(&s->head[k], time) && statistics_is_valid(&s->mid[k], time);
    for (int k = 0; k < Z; k++)
        turning &= fatigue_is_valid(&s->fatigue_head[k]) && fatigue_is_valid(&s->fatigue_mid[k]);
    const bool peaks = values_are_amounts(amounts, sizeof amounts / sizeof amounts[0]) &&
                       values_are_sane(sums, sizeof sums / sizeof sums[0]) &&
                       values_are_amounts(s->head_peak, Z) && values_are_amounts(s->mid_peak, Z);
    return saved_is(b, peaks && step_end_is_valid(&s->end), "peaks and sums") &&
           saved_is(b, event_state_is_valid(&s->event), "counts of events") &&
           saved_is(b, breakage_is_valid(&s->breakage, s->t_start, s->integrator.t), "broken rivets") &&
           saved_is(b, loosening_is_valid(&s->loosening), "lost preloads") &&
           saved_is(b, lag_is_valid(&s->lag), "a motion that catches up") &&
           saved_is(b, statistics_is_valid(&s->force, Z * time), "statistics of the pocket forces") &&
           saved_is(b, stress, "statistics of the stress") &&
           saved_is(b, values_are_sane((const double *)&s->out, sizeof s->out / sizeof(double)), "outputs") &&
           saved_is(b, turning, "turning points of the stress");
}

static bool history_is_valid(const MotionHistory *history)
{
    const int steps = history->steps;
    return values_are_sane(history->v, MOTIONS) && values_are_sane(history->a, MOTIONS) &&
           values_are_amounts(&history->h, 1) && steps >= 0 && steps <= 2 && (steps == 0 || history->h > 0.0);
}

// Checks the inputs reached.  A step that stopped halfway leaves a given motion on its way, where its polynomial may be
// beyond the limits that hold at both ends.
static bool check_saved_inputs(Bearing *b, const Inputs *reached)
{
    Inputs u = *reached;
    for (int i = 0; i < MOTIONS; i++)
        ((double *)&u)[MOTION[i].position] = ((double *)&u)[MOTION[i].velocity] = 0.0;
    return check_within(b, &u, REACHED) &&
           saved_is(b, values_are_sane((const double *)reached, N_INPUTS), "inputs");
}

// Whether the parameters that cannot change in a run are those in force.
static bool fixed_are_kept(const Parameters *given, const Parameters *in_force)
{
    for (const Variable *v = VARIABLES; v < VARIABLES + N_VARIABLES; v++) {
        if (v->causality != CAUSALITY_PARAMETER || v->fixed == NULL) continue;
        for (int i = 0; i < v->count; i++)
            if (variable_value(v, i, given) != variable_value(v, i, in_force)) return false;
    }
    return true;
}

// Checks a state before the start: parameters and inputs, and nothing else.
static bool check_unstarted(Bearing *b)
{
    const InstanceState *s = &b->s;
    const size_t first = offsetof(InstanceState, u_now), end = offsetof(InstanceState, initialized);
    return saved_is(b, is_zero((const char *)s + first, end - first), "a run that has not been started") &&
           check_variables(b, CAUSALITY_PARAMETER, &s->p) && check_variables(b, CAUSALITY_INPUT, &s->u[0]);
}

// Checks a state in a run but for its records.
static bool check_running(Bearing *b)
{
    const InstanceState *s = &b->s;
    char message[256];
    return check_values(b) && check_variables(b, CAUSALITY_PARAMETER, &s->p_now) &&
           check_saved_inputs(b, &s->u_now) && check_temperatures(b, &s->u_now) &&
           saved_is(b, fixed_are_kept(&s->p, &s->p_now), "parameters that cannot change in a run") &&
           saved_is(b, values_are_sane((const double *)&s->u_now_dot, N_INPUTS), "rates of inputs") &&
           saved_is(b, values_are_sane(s->angle, 3), "the frame's and the rings' angles") &&
           saved_is(b, history_is_valid(&s->history), "the motions given before") &&
           saved_is(b,
                    variable_allows(variable_named("solver.tol"), 0, s->tolerance, message, sizeof message),
                    "the tolerance") &&
           saved_is(b, integrator_state_is_valid(&s->integrator, &s->p), "states and steps") &&
           saved_is(b, values_are_sane(&s->t_start, 1) && s->integrator.t >= s->t_start, "time");
}

bool check_saved(Bearing *b)
{
    const InstanceState *s = &b->s;
    const IntegratorState *i = &s->integrator;
    const double *rates = (const double *)&s->u[1];
    if (!saved_is(b, s->initialized == 0 || s->initialized == 1, "the mark of a started run")) return false;
    if (!(s->initialized ? check_running : check_unstarted)(b)) return false;
    const bool within = values_are_within(rates, (size_t)INPUT_ORDERS * N_INPUTS, LARGEST_DERIVATIVE);
    if (!saved_is(b, within, "derivatives of inputs")) return false;
    const double rounding = i->steps * DBL_EPSILON * fabs(i->t);  // of the time, not of the steps' lengths
    return !s->initialized || check_recorded(b, i->t - s->t_start + rounding);
}
