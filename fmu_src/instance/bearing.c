// One instance of the bearing: life cycle, stepping, peaks and statistics over accepted steps, saved state.
#include "cage/cage.h"
#include "instance/energy.h"
#include "instance/instance.h"
#include "instance/jacobian.h"
#include "instance/outputs.h"
#include "numbers/aligned.h"
#include "numbers/cpu_clock.h"
#include "numbers/error_norm.h"
#include "physics/housing.h"
#include "physics/race_surface.h"
#include "physics/ring_load.h"
#include "physics/temperature.h"
#include "solver/escape.h"
#include "solver/start.h"

#include <stdarg.h>
#include <stdio.h>

void bearing_log(Bearing *b, LogCategory category, const char *format, ...)
{
    if (b->host.log == NULL) return;
    char message[1024];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(message, sizeof message, format, arguments);
    va_end(arguments);
    b->host.log(b->host.environment, category, message);
}

// ---- accepted steps ---------------------------------------------------------------------------------------
static void add_force(InstanceState *s, const Work *w, bool counts, double h)
{
    for (int j = 0; j < Z; j++) {
        const double now = w->pocket[0].Q[j] + w->pocket[1].Q[j];
        const double before = s->end.force_known ? s->end.force[j] : now;
        s->force_peak = scalar_max(s->force_peak, now);
        s->end.force[j] = now;
        if (!counts) continue;
        statistics_add(&s->force, FORCE_FLOOR, h, before, now);
        s->duty_time += 0.5 * h * ((before > 0.0) + (now > 0.0));
    }
    s->end.force_known = true;
}

// Counts stresses of each rivet and of the worst one.
static void count_stress(InstanceState *s, bool counts, double h, const StepEnd *now)
{
    const StepEnd *before = s->end.stress_known ? &s->end : now;
    for (int k = 0; counts && k < STRESS_CHANNELS; k++) {
        statistics_add(&s->head[k], STRESS_FLOOR, h, before->head[k], now->head[k]);
        statistics_add(&s->mid[k], STRESS_FLOOR, h, before->mid[k], now->mid[k]);
    }
    memcpy(s->end.head, now->head, sizeof now->head);
    memcpy(s->end.mid, now->mid, sizeof now->mid);
    s->end.stress_known = true;
}

static void add_stress(Bearing *b, bool counts, double h)
{
    InstanceState *s = &b->s;
    JointLoads load;
    double sigma[RIVET_CHANNELS][Z];
    StepEnd now = {0};
    const bool fatigue = s->p.scene.stress == STRESS_FATIGUE && s->integrator.t >= s->p.start.settle;

    // stress of all rivets
    b->kernels.cage_loads(&b->model, &b->w, &load);
    b->kernels.rivet_rom_stress(&rivet_table, &load, b->d.fit_eff, false, sigma);
    const double *head = sigma[HEAD_P1], *mid = sigma[MID_VM];

    // peaks, fatigue and statistics
    for (int k = 0; k < Z; k++) {
        s->head_peak[k] = scalar_max(s->head_peak[k], head[k]);
        s->mid_peak[k] = scalar_max(s->mid_peak[k], mid[k]);
        now.head[k] = head[k], now.mid[k] = mid[k];
        now.head[WORST_RIVET] = scalar_max(now.head[WORST_RIVET], head[k]);
        now.mid[WORST_RIVET] = scalar_max(now.mid[WORST_RIVET], mid[k]);
        if (fatigue && rivet_holds(&s->p, &s->breakage, k)) {
            const FatigueLaw law = fatigue_law(&s->p, k),
                             in_hole = fatigue_law_in_hole(&law, b->d.fit_eff[k]);
            fatigue_push(&s->fatigue_head[k], &law, head[k]);
            fatigue_push(&s->fatigue_mid[k], &in_hole, mid[k]);
        }
    }
    count_stress(s, counts, h, &now);
}

static void add_cage(Bearing *b, double h)
{
    InstanceState *s = &b->s;
    const Rotor *h0 = &b->w.half[0], *h1 = &b->w.half[1];
    const double y = 0.5 * (h0->x[1] + h1->x[1]) - b->w.outer_x[1];
    const double z = 0.5 * (h0->x[2] + h1->x[2]) - b->w.outer_x[2];
    double slip[Z];
    cage_slip(&b->model, &b->w, slip);
    for (int k = 0; k < Z; k++) s->dislocation_max = scalar_max(s->dislocation_max, slip[k]);
    s->omega_time += h * 0.5 * (h0->s + h1->s);
    s->eccentricity_time += h * sqrt(y * y + z * z) / b->d.play;
}

// Adds the state just reached, after a step of length h, to peaks, statistics and fatigue.
static void accepted_step(void *context, double h, const Work *w)
{
    Bearing *b = context;
    InstanceState *s = &b->s;
    const bool counts = s->p.scene.statistics == SWITCH_ON && s->integrator.t >= s->p.start.settle;
    add_force(s, w, counts, h);
    if (s->p.scene.stress >= STRESS_PEAK)
        add_stress(b, counts, h);
    else
        s->end.stress_known = false;
    if (counts) add_cage(b, h);
    if (s->p.joint.wear > 0.0) loosening_add(&s->p, w->joint_rubbed, &s->loosening);
}

static void solver_message(void *context, const char *message)
{
    bearing_log(context, LOG_SOLVER, "%s", message);
}

static bool is_fixed(const Bearing *b)
{
    return b->s.p.solver.method == METHOD_FIXED;
}

// Evaluates the right-hand side if w and y_dot do not belong to the present state and inputs yet.
static void evaluate(Bearing *b)
{
    if (b->evaluated) return;
    const IntegratorState *i = &b->s.integrator;
    b->kernels.rhs(&b->model, i->t, i->now.y, b->y_dot, &b->w);
    cage_keep_films(&i->now.cage, &b->w);
    b->evaluated = true;
}

static Event energy_event(Bearing *b)
{
    const InstanceState *s = &b->s;
    const IntegratorState *i = &s->integrator;
    const double E = energy_total(&b->model, i->now.y, &b->w);
    const double residual = E - i->now.y[Y_WORK] - s->energy_start - s->energy_change;
    return event_of_energy(residual, E + cage_widened(&b->w), s->exchanged, s->lost, i->sum.lost, s->jumped);
}

// All kinds of events at the state whose results are w.  An energy that predicted velocities put off is no reason to warn.
static void events_here(Bearing *b)
{
    const InstanceState *s = &b->s;
    const IntegratorState *i = &s->integrator;
    Event *now = b->events;
    const double error = b->model.p->solver.method == METHOD_FIXED ? i->error_mean : 0.0;
    events_now(&b->model, &b->w, &s->lag, error, s->force_peak, s->head_peak, s->mid_peak, now);
    now[EVENT_RIVET_BREAK].count = s->breakage.latest;
    now[EVENT_ENERGY_OFF] = energy_event(b);
    if (now[EVENT_ENERGY_OFF].count == 0 || b->evaluated) return;
    evaluate(b);
    now[EVENT_ENERGY_OFF] = energy_event(b);
}

// Reports the events that begin at the state just reached; w holds the results there, of predicted velocities.  Outputs are of
// those at the communication point, by which a count may differ: their events are evaluated again.
static void report_events(Bearing *b)
{
    InstanceState *s = &b->s;
    const Event *now = b->events;
    events_here(b);
    for (EventKind kind = 0; kind < EVENT_COUNT; kind++) {
        if (!event_onset(&s->event, kind, &now[kind]) || kind == EVENT_RIVET_BREAK) continue;
        char text[256];
        event_text(kind, &now[kind], text, sizeof text);
        const bool warned = kind == EVENT_OVERPRESSURE || kind == EVENT_NO_CLEARANCE ||
                            kind == EVENT_MOTION_LAG || kind == EVENT_STEP_TOO_LONG ||
                            kind == EVENT_ENERGY_OFF || kind == EVENT_RIVET_OVERLOAD;
        const bool warning = warned && s->event.onsets[kind] == 1.0;
        bearing_log(b, warning ? LOG_WARNING : LOG_EVENT, "t = %.9g s: %s (onset %.0f)", s->integrator.t,
                    text, s->event.onsets[kind]);
    }
}

// ---- life cycle -------------------------------------------------------------------------------------------
Bearing *part_create(const PartHost *host)
{
    Bearing *b = aligned_new(sizeof *b);
    if (b == NULL) return NULL;
    memset(b, 0, sizeof *b);
    b->host = *host;
    const char *refused;
    b->kernels = kernels_wanted(&refused);
    if (refused)
        bearing_log(b, LOG_WARNING,
                    "RIVETED_BEARING_ISA = %.40s: this processor has no such kernels, %s take their place; "
                    "avx512, avx2 and baseline are names",
                    refused, b->kernels.name);
    b->model = (Model){.p = &b->hot, .d = &b->d, .ring_load = &b->ring_load};
    b->integrator =
        integrator_create(&b->kernels, &b->model, &b->w, &b->s.integrator, accepted_step, solver_message, b);
    if (b->integrator == NULL) {
        aligned_delete(b);
        return NULL;
    }
    part_reset(b);
    return b;
}

void part_destroy(Bearing *b)
{
    if (b == NULL) return;
    integrator_destroy(b->integrator);
    aligned_delete(b->cage);
    aligned_delete(b);
}

void part_reset(Bearing *b)
{
    memset(&b->s, 0, sizeof b->s);
    memset(&b->out, 0, sizeof b->out);
    variables_set_start(&b->s.p, &b->s.u[0]);
    b->reported = false;
    b->current = 0;
    b->evaluated = false;
}

Parameters *part_parameters(Bearing *b)
{
    return &b->s.p;
}

Inputs *part_inputs(Bearing *b, int order)
{
    return &b->s.u[order];
}

const Outputs *part_outputs(const Bearing *b)
{
    return &b->out;
}

// The parameters under which the present state was reached; before the start those that have been set.
static const Parameters *present_parameters(const Bearing *b)
{
    return b->s.initialized ? &b->s.p_now : &b->s.p;
}

double part_time(const Bearing *b)
{
    return b->s.integrator.t;
}

static const double FIRST_STEP = 1e-6;  // [s]

// The present inputs u_now and their rates, as a trajectory that begins at the present time.
static void present_trajectory(const Bearing *b, InputTrajectory *trajectory)
{
    const InstanceState *s = &b->s;
    const Inputs u[INPUT_ORDERS + 1] = {s->u_now, s->u_now_dot};
    input_trajectory_update(present_parameters(b), u, s->integrator.t, s->integrator.t, trajectory);
    memcpy(trajectory->angle, s->angle, sizeof s->angle);
}

// Puts the outer ring where a housing on springs is, and lets the model see how far balls with spalls have turned.
static void place_housing(Bearing *b)
{
    b->model.turn = ball_spalls_given(present_parameters(b)) ? &b->s.integrator.now.turn : NULL;
    const bool supported = present_parameters(b)->housing.motion == HOUSING_MOTION_SUPPORTED;
    b->model.housing = supported ? &b->s.integrator.now.housing : NULL;
    if (supported) housing_place(b->model.housing, &b->ring_load);
}

// Puts loads and motions of the present inputs u_now on the bearing and holds them: there is no trajectory to follow.
static void hold_ring_load(Bearing *b)
{
    InputTrajectory present;
    present_trajectory(b, &present);
    b->model.trajectory = NULL;
    ring_load_at(&present, b->s.integrator.t, &b->ring_load);
    place_housing(b);
}

// The parameters that the model has at the temperatures in u.
static void parameters_at(const Bearing *b, const Inputs *u, Parameters *hot)
{
    temperature_apply(present_parameters(b), u, hot);
    loosening_apply(&b->s.loosening, hot);
    breakage_apply(&b->s.breakage, hot);
}

// Computes all that follows from the parameters at the temperatures in u.
static void derive_at(Bearing *b, const Inputs *u)
{
    parameters_at(b, u, &b->hot);
    model_derive(&b->hot, &b->d);
    b->model.modes = cage_derive(&b->hot, &b->d, b->cage);
    integrator_tolerance(b->integrator, b->s.tolerance);
    b->current = 0;
    b->evaluated = false;
}

// Memory for the cage, taken when a scene first needs it.  Returns whether there is any.
static bool room_for_cage(Bearing *b)
{
    const size_t size = cage_size(present_parameters(b));
    if (size == 0 || b->cage != NULL) return true;
    b->cage = aligned_new(size);
    if (b->cage == NULL)
        bearing_log(b, LOG_ERROR, "no memory for the modes of the cage");
    else
        memset(b->cage, 0, size);
    return b->cage != NULL;
}

// Computes all that follows from parameters and inputs and is therefore not saved.
static void derive(Bearing *b)
{
    derive_at(b, b->s.initialized ? &b->s.u_now : &b->s.u[0]);
    hold_ring_load(b);
    work_init(&b->d, &b->w);
}

static double present_energy(Bearing *b)
{
    evaluate(b);
    return energy_total(&b->model, b->s.integrator.now.y, &b->w);
}

// Changes the temperatures of oil and parts from those in `from` to those in u.  The work of the expansion is no part
// of the energy balance: the energy at the start moves by as much as the elastic energy of the present state.
static void change_temperature(Bearing *b, const Inputs *from, const Inputs *u)
{
    if (temperature_same(from, u)) return;
    const double before = present_energy(b);
    derive_at(b, u);
    b->s.energy_start += present_energy(b) - before;
    b->s.integrator.f_is_current = 0;
}

// Derives all constants again, at the temperatures in u, after the parameters in force or the rivets that hold have
// changed since the energy was `before`.  The energy that the change adds is a term of its own in the balance.
static void rederive(Bearing *b, const Inputs *u, double before)
{
    derive_at(b, u);
    b->s.energy_change += present_energy(b) - before;
    b->s.integrator.f_is_current = 0;
}

// Puts the parameters in force that the host has set since the last step.
static void change_parameters(Bearing *b, const Inputs *u)
{
    InstanceState *s = &b->s;
    if (memcmp(&s->p, &s->p_now, sizeof s->p) == 0) return;
    const double before = present_energy(b);
    if (s->p.solver.tol != s->p_now.solver.tol) s->tolerance = s->p.solver.tol;
    const bool other_laws = memcmp(&s->p.scene, &s->p_now.scene, sizeof s->p.scene) != 0;
    memcpy(&s->p_now, &s->p, sizeof s->p);
    rederive(b, u, before);
    if (!other_laws || is_fixed(b)) return;
    // spins jump from one balance to another, as at the start
    s->integrator.h = fmin(s->integrator.h, FIRST_STEP);
    s->integrator.now.h = s->integrator.now.ratio = 0.0;
}

// Breaks the rivets whose damage has reached 1; returns whether any rivet is left in a cage whose rivets may break.
static bool break_rivets(Bearing *b)
{
    static const char *const PLACE[] = {[BROKEN_HEAD] = "head", [BROKEN_MIDDLE] = "middle"};
    InstanceState *s = &b->s;
    if (s->p.scene.breakage != SWITCH_ON) {
        s->breakage.latest = 0;
        return true;
    }
    const double t = s->integrator.t;
    if (breakage_update(&s->p, t, b->d.fit_eff, s->fatigue_head, s->fatigue_mid, &s->breakage))
        rederive(b, &s->u_now, present_energy(b));
    int left = 0;
    for (int k = 0; k < Z; k++) {
        left += rivet_holds(&s->p, &s->breakage, k);
        if (s->breakage.latest > 0 && s->breakage.place[k] != HOLDS && s->breakage.time[k] == t)
            bearing_log(b, LOG_EVENT, "t = %.9g s: rivet[%d] breaks in its %s", t, k + 1,
                        PLACE[s->breakage.place[k]]);
    }
    return left > 0;
}

PartStatus part_initialize(Bearing *b, double t_start, double tolerance)
{
    InstanceState *s = &b->s;
    variables_mark_given(&s->p);
    if (!check_all(b) || !room_for_cage(b)) return PART_ERROR;
    report_start(b);
    s->t_start = t_start;
    s->tolerance = tolerance > 0.0 ? tolerance : s->p.solver.tol;
    s->u_now = s->u[0];
    s->u_now_dot = s->u[1];
    memcpy(&s->p_now, &s->p, sizeof s->p);
    memset(s->angle, 0, sizeof s->angle);
    s->history = (MotionHistory){.steps = 0};
    s->integrator.t = s->integrator.since = t_start;
    s->integrator.h = FIRST_STEP;
    memset(&s->integrator.now.turn, 0, sizeof s->integrator.now.turn);
    for (int j = 0; ball_spalls_given(&s->p) && j < Z; j++)
        s->integrator.now.turn.angle[j] = s->p.ball.spall_angle[j];
    derive(b);
    if (b->model.housing) {
        housing_at_base(&b->ring_load, &s->integrator.now.housing);
        place_housing(b);
    }

    // quasi-static start
    const double residual = start_state(&b->kernels, &b->model, &b->w, s->integrator.now.y);
    const double load = fabs(b->ring_load.F[0]) + fabs(b->ring_load.F[1]) + fabs(b->ring_load.F[2]);
    PartStatus status = PART_OK;
    if (!(residual < 1e-6 * (load + 1.0))) {
        bearing_log(b, LOG_WARNING,
                    "t = %g s: the start is not in equilibrium, residual %g N of a load of %g N", t_start,
                    residual, load);
        status = PART_WARNING;
    }

    // first evaluation; the start counts as an accepted step of length 0
    if (b->model.housing) {  // its springs carry the load of the start
        b->kernels.rhs(&b->model, t_start, s->integrator.now.y, b->y_dot, &b->w);
        housing_load(&b->model, &b->w, &s->integrator.now.housing, s->integrator.now.housing.rest);
    }
    if (is_fixed(b)) {
        integrator_fix_step(b->integrator);
        work_init(&b->d, &b->w);
    }
    integrator_evaluate(b->integrator);
    if (!check_start(b)) return PART_ERROR;
    s->energy_start = energy_total(&b->model, s->integrator.now.y, &b->w);
    accepted_step(b, 0.0, &b->w);
    report_events(b);
    s->initialized = 1;
    return status;
}

// ---- stepping ---------------------------------------------------------------------------------------------
// Sets the trajectory of the inputs u from the present time to `stop`, the next edge of a pulse or the end of a step of
// a fixed length, in a communication step that began at t_0 with the frame and the rings at these angles.  Where the load on the ring
// jumps, the derivative at the present state is no longer current.
static void begin_trajectory(Bearing *b, const Inputs u[INPUT_ORDERS + 1], double t_0, const double angle[3],
                             double stop)
{
    InstanceState *s = &b->s;
    const RingLoad before = b->ring_load;
    input_trajectory_update(&s->p, u, t_0, s->integrator.t, &b->trajectory);
    if (is_fixed(b)) pulse_average(&s->p, stop, 0.5 * (stop - s->integrator.t), &b->trajectory);
    memcpy(b->trajectory.angle, angle, sizeof b->trajectory.angle);
    b->model.trajectory = input_trajectory_varies(&b->trajectory) ? &b->trajectory : NULL;
    ring_load_at(&b->trajectory, s->integrator.t, &b->ring_load);
    place_housing(b);

    // With fixed steps, the next evaluation is at the end of the next step: the new load grows over that step.
    if (is_fixed(b) || memcmp(&b->ring_load, &before, sizeof before) == 0) return;
    s->integrator.f_is_current = 0;
}

// Ends the trajectory at the present time: the inputs reached are held from there on.
static void end_trajectory(Bearing *b)
{
    InstanceState *s = &b->s;
    input_trajectory_rates_at(&b->trajectory, s->integrator.t, &s->u_now, &s->u_now_dot);
    s->angle[0] = frame_angle_at(&b->trajectory, s->integrator.t);
    if (b->trajectory.angles_matter != 0.0)
        ring_angles_at(&b->trajectory, s->integrator.t, &s->angle[1], &s->angle[2]);
    hold_ring_load(b);
    if (s->p.ring.motion == RING_MOTION_PRESCRIBED) ring_follow(&b->ring_load, s->integrator.now.y);
}

// The values that the inputs' own polynomials have at time t, which the host reads back and which hold from there
// on; motions that are given without derivatives keep the host's values.
static void inputs_reach(const Parameters *p, double t_0, double t, Inputs u[INPUT_ORDERS + 1])
{
    InputTrajectory given;
    Inputs end;
    if (!any_not_zero((const double *)&u[1], INPUT_ORDERS * N_INPUTS)) return;
    input_trajectory_update(p, u, t_0, t, &given);
    input_trajectory_at(&given, t, &end);
    u[0] = end;
    memset(&u[1], 0, INPUT_ORDERS * sizeof *u);
}

// Where the advance that is number `stretch` of a communication step ends.
static double next_stop(const Bearing *b, double t_begin, double t_end, int stretch)
{
    const double edge = pulse_next_edge(&b->s.p, b->s.integrator.t);
    if (!is_fixed(b) || edge == INFINITY) return fmin(edge, t_end);
    const double steps = fixed_steps(b->s.integrator.h, t_end - t_begin);
    return stretch < steps ? t_begin + stretch / steps * (t_end - t_begin) : t_end;
}

// Internal steps that a communication step of length h [s] may take.  Where solver.max_steps leaves it to the core,
// MOST_STEPS for each SPAN [s] of it, and no fewer: at most 0.2 s of processor time, 500 times the usual steps at the
// default tolerance and 6 times those at the smallest.  Fixed steps are the user's: MOST_FIXED take as long.
static double most_steps(const Bearing *b, double h)
{
    const double MOST_STEPS = 6000.0, MOST_FIXED = 2e4, SPAN = 1e-4;
    const double LARGEST = 2e9;  // fits a long everywhere
    const double given = b->s.p.solver.max_steps;
    if (given > 0.0) return given;
    return floor(fmin((is_fixed(b) ? MOST_FIXED : MOST_STEPS) * fmax(h / SPAN, 1.0), LARGEST));
}

// Checks that a communication step of length h [s] has no more fixed steps than it may take.
static bool check_fixed_steps(Bearing *b, double h)
{
    const double most = most_steps(b, h), step = b->s.integrator.h,
                 wanted = is_fixed(b) ? fixed_steps(step, h) : 0.0;
    if (wanted <= most) return true;
    bearing_log(
        b, LOG_ERROR,
        "solver.step = %g s: a communication step of %g s would have %.4g internal steps, %.0f are allowed "
        "(solver.max_steps = %d): set solver.step to %.4g s or more, or communicate more often",
        step, h, wanted, most, b->s.p.solver.max_steps, h / most);
    return false;
}

PartStatus part_step(Bearing *b, double t_end)
{
    InstanceState *s = &b->s;
    const double t_begin = s->integrator.t, steps_before = s->integrator.steps;
    const double angle[3] = {s->angle[0], s->angle[1], s->angle[2]};
    Inputs u[INPUT_ORDERS + 1];
    if (!check_change(b) || !check_inputs(b, t_end - t_begin) || !check_fixed_steps(b, t_end - t_begin))
        return PART_ERROR;
    motion_trajectory(&s->p, s->u, &s->history, &s->u_now, t_end - t_begin, u, &s->lag);
    report_without_effect(b);
    const bool clocked = s->p.solver.clock == SWITCH_ON;
    const double before = clocked ? cpu_clock() : 0.0;
    change_temperature(b, &s->u_now, &s->u[0]);
    change_parameters(b, &s->u[0]);
    const double frame_omega = s->u_now.frame.omega;  // which does not jump
    s->energy_start += energy_of_speed(&b->model, s->integrator.now.y, s->u_now.shaft.omega + frame_omega,
                                       s->u[0].shaft.omega + frame_omega);
    const double most = most_steps(b, t_end - t_begin);
    s->force_peak = 0.0;
    s->integrator.sum = (Exchange){.torque = 0.0}, s->integrator.since = t_begin;
    for (int k = 0; k < Z; k++) s->head_peak[k] = s->mid_peak[k] = 0.0;
    b->current = 0;
    b->evaluated = false;

    // one advance for each stretch between edges of pulses; with fixed steps, in which pulses are averaged, for each step
    int status = 0;
    char reason[256] = "";
    for (int stretch = 1; status == 0 && s->integrator.t < t_end; stretch++) {
        const double stop = next_stop(b, t_begin, t_end, stretch);
        begin_trajectory(b, u, t_begin, angle, stop);
        const long left = (long)fmax(most - (s->integrator.steps - steps_before), 1.0);
        status = integrator_advance(b->integrator, stop, left);
        if (status == ADVANCE_ESCAPED) {
            const Escape escape = escape_find(&b->model, &b->w);
            escape_text(&escape, reason, sizeof reason);
        }
        end_trajectory(b);
    }
    if (is_fixed(b) && status == 0 &&
        s->integrator.f_is_current) {  // outputs are those of the last evaluation
        memcpy(b->y_dot, s->integrator.now.f, sizeof b->y_dot);
        b->evaluated = true;
    }

    // the inputs stay where they are now; temperatures that have moved meanwhile act from here on
    change_temperature(b, &s->u[0], &s->u_now);
    motion_remember(&s->u[0], s->integrator.t - t_begin, &s->history);
    inputs_reach(&s->p, t_begin, s->integrator.t, s->u);
    s->lost += s->integrator.sum.lost, s->exchanged += s->integrator.sum.exchanged;
    s->jumped += s->integrator.sum.jump;
    if (status == 0 && loosening_update(b->hot.joint.preload, b->d.P, &s->loosening))
        rederive(b, &s->u_now, present_energy(b));
    const bool holds = status != 0 || break_rivets(b);
    if (clocked) b->cpu_time += cpu_clock() - before;
    if (status == 0) {
        report_events(b);
        if (holds) return PART_OK;
        bearing_log(b, LOG_ERROR,
                    "t = %.9g s: all %d rivets are broken, the halves of the cage come apart: the run ends",
                    s->integrator.t, Z);
        return PART_DISCARD;
    }
    const double steps = s->integrator.steps - steps_before;
    if (*reason)
        bearing_log(b, LOG_ERROR, "t = %.9g s: %s: the run ends%s", s->integrator.t, reason,
                    is_fixed(b) ? "; solver.method = fixed: a shorter solver.step may hold" : "");
    else if (steps >= most)
        bearing_log(b, LOG_ERROR,
                    "t = %.9g s: the work limit is reached, %.0f steps since %.9g s (solver.max_steps = %d); "
                    "step size %g s",
                    s->integrator.t, most, t_begin, s->p.solver.max_steps, s->integrator.h);
    else if (is_fixed(b))
        bearing_log(b, LOG_ERROR,
                    "t = %.9g s: solver.method = fixed: a step of %g s leads to no state of a bearing, after "
                    "%g steps "
                    "since %.9g s; a smaller solver.step may bear it (code %d)",
                    s->integrator.t, s->integrator.h, steps, t_begin, status);
    else
        bearing_log(
            b, LOG_ERROR,
            "t = %.9g s: the solver cannot go on (code %d) after %g steps since %.9g s; step size %g s",
            s->integrator.t, status, steps, t_begin, s->integrator.h);
    return PART_DISCARD;
}

void part_update(Bearing *b, OutputGroup group)
{
    if (b->current >> group & 1u) return;
    evaluate(b);
    if (group == GROUP_EVENT) events_here(b);
    outputs_fill(b, group);
    b->current |= 1u << group;
}

// ---- derivatives ------------------------------------------------------------------------------------------
// All outputs that follow from one evaluation at the present state, with the inputs u in the place of their
// temperatures.  The constants of the cage are derived in their own memory and restored at the end.
static void outputs_beside(const Bearing *b, const Inputs *u, Outputs *out)
{
    const InstanceState *s = &b->s;
    Parameters hot;
    Derived d;
    Work w;
    double y_dot[N_ALL_STATES];
    parameters_at(b, u, &hot);
    model_derive(&hot, &d);
    work_init(&d, &w);
    const Model model = {
        &hot, &d, &b->ring_load, NULL, cage_derive(&hot, &d, b->cage), b->model.housing, b->model.turn};
    b->kernels.rhs(&model, s->integrator.t, s->integrator.now.y, y_dot, &w);
    const Evaluation at = {&model, s->integrator.now.y,   y_dot,
                           &w,     b->kernels.cage_loads, b->kernels.rivet_rom_stress};
    memset(out, 0, sizeof *out);
    for (int group = 0; group < GROUP_COUNT; group++) outputs_evaluate(&at, group, out);
    out->bearing.energy_residual = 0.0;  // the work of expansion is no part of the balance
    cage_derive(&b->hot, &b->d, b->cage);
}

// Adds the derivatives of all outputs along the temperatures of du: central differences over +-1 mK, because
// the derived constants have no dual numbers.  Their relative error is 1e-7.
static void add_thermal_derivatives(const Bearing *b, const Inputs *du, Outputs *derivatives)
{
    const double step = 1e-3;
    for (int i = 0; i < TEMPERATURES; i++) {
        const double along = *temperature_of((Inputs *)du, i);
        if (along == 0.0) continue;
        Inputs below = b->s.u_now, above = below;
        Outputs from, to;
        *temperature_of(&below, i) -= step;
        *temperature_of(&above, i) += step;
        outputs_beside(b, &below, &from);
        outputs_beside(b, &above, &to);
        const double *x = (const double *)&from, *y = (const double *)&to;
        double *sum = (double *)derivatives;
        for (size_t k = 0; k < sizeof from / sizeof *x; k++) sum[k] += along * ((y[k] - x[k]) / (2.0 * step));
    }
}

// Derivatives of all outputs at the present state along dt of time, du of the inputs and dy of the states.
static void differentiate(Bearing *b, double dt, const Inputs *du, const double *dy, Outputs *derivatives)
{
    const InstanceState *s = &b->s;
    InputTrajectory trajectory;
    present_trajectory(b, &trajectory);
    jacobian_outputs(&b->model, (const double *)&trajectory, s->integrator.t, dt, (const double *)du,
                     s->integrator.now.y, dy, (double *)derivatives);
    add_thermal_derivatives(b, du ? du : &s->u_now_dot, derivatives);
}

void part_time_derivatives(Bearing *b, Outputs *derivatives)
{
    evaluate(b);
    differentiate(b, 1.0, NULL, b->y_dot, derivatives);
}

void part_directional_derivatives(Bearing *b, const Inputs *inputs, const double state[N_ALL_STATES],
                                  Outputs *derivatives)
{
    differentiate(b, 0.0, inputs, state, derivatives);
}

// ---- saved state ------------------------------------------------------------------------------------------
size_t part_saved_size(void)
{
    return sizeof(InstanceState);
}

static bool saves_outputs(const Bearing *b)
{
    return b->s.initialized && is_fixed(b);
}

static void update_all(Bearing *b)
{
    for (int group = 0; group < GROUP_COUNT; group++) part_update(b, (OutputGroup)group);
}

void part_save(Bearing *b, void *saved)
{
    if (saves_outputs(b)) {
        update_all(b);
        b->s.out = b->out;
    }
    memcpy(saved, &b->s, sizeof b->s);
}

static void outputs_of_the_save(Bearing *b)
{
    if (!saves_outputs(b)) return;
    b->out = b->s.out;
    b->current = (1u << GROUP_COUNT) - 1u;
}

void part_restore(Bearing *b, const void *saved)
{
    memcpy(&b->s, saved, sizeof b->s);
    if (!room_for_cage(b)) return;
    derive(b);
    outputs_of_the_save(b);
}

// All outputs at the restored state, and its derivative.
static bool outputs_are_numbers(Bearing *b)
{
    evaluate(b);
    bool fine = all_finite(cage_states(&b->model), b->y_dot);
    update_all(b);
    for (const Variable *v = VARIABLES; v < VARIABLES + N_VARIABLES; v++) {
        if (v->causality != CAUSALITY_OUTPUT) continue;
        const double *value = (const double *)((const char *)&b->out + v->offset);
        for (int i = 0; i < v->count; i++) fine &= isfinite(value[i]) != 0;
    }
    if (!fine) bearing_log(b, LOG_ERROR, "the outputs there are no numbers");
    return fine;
}

bool part_restore_unknown(Bearing *b, const void *saved)
{
    memcpy(&b->s, saved, sizeof b->s);
    if (!check_saved(b) || !room_for_cage(b)) return false;
    derive(b);
    const bool fine = !b->s.initialized || outputs_are_numbers(b);
    outputs_of_the_save(b);
    return fine;
}

bool part_is_initialized(const Bearing *b)
{
    return b->s.initialized;
}

const char *part_data_digest(void)
{
    return rivet_table.digest;
}
