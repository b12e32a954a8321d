// Outputs that follow from the records of accepted steps and from the integrator.
#include "instance/instance.h"
#include "instance/outputs.h"

static void fill_peak(Bearing *b)
{
    b->out.cage.F_pocket_peak = b->s.force_peak;
    b->out.rivet.sigma_head_max = b->out.rivet.sigma_mid_max = 0.0;
    for (int k = 0; k < Z; k++) {
        b->out.rivet.sigma_head_peak[k] = b->s.head_peak[k];
        b->out.rivet.sigma_mid_peak[k] = b->s.mid_peak[k];
        b->out.rivet.sigma_head_max = fmax(b->out.rivet.sigma_head_max, b->s.head_peak[k]);
        b->out.rivet.sigma_mid_max = fmax(b->out.rivet.sigma_mid_max, b->s.mid_peak[k]);
    }
}

static void fill_fatigue(Bearing *b)
{
    const InstanceState *s = &b->s;
    for (int k = 0; k < Z; k++) {
        const FatigueLaw law = fatigue_law(&s->p_now, k);
        const bool worn_out = s->breakage.place[k] != HOLDS;
        b->out.rivet.preload_loss[k] = s->loosening.loss[k];
        b->out.rivet.broken[k] = rivet_broken(&s->p_now, &s->breakage, k);
        b->out.rivet.break_time[k] = worn_out ? s->breakage.time[k] : -1.0;
        b->out.rivet.damage_head[k] = fatigue_damage(&b->s.fatigue_head[k], &law);
        const FatigueLaw in_hole = fatigue_law_in_hole(&law, b->d.fit_eff[k]);
        b->out.rivet.damage_mid[k] = fatigue_damage(&b->s.fatigue_mid[k], &in_hole);
    }
}

static void fill_stat(Bearing *b)
{
    const InstanceState *s = &b->s;
    const double time = s->force.time / Z, p = 0.999;  // every ball has added the same time
    const StatisticsChannel *head = &s->head[WORST_RIVET], *mid = &s->mid[WORST_RIVET];

    // pocket force and cage
    b->out.stat.time = time;
    b->out.stat.Q_c_mean = statistics_mean(&s->force);
    b->out.stat.Q_c_rms = statistics_rms(&s->force);
    b->out.stat.Q_c_p999 = statistics_quantile(&s->force, FORCE_FLOOR, p);
    b->out.stat.Q_c_max = s->force.max;
    b->out.stat.contact_duty = time > 0.0 ? s->duty_time / (Z * time) : 0.0;
    b->out.stat.cage_omega = time > 0.0 ? s->omega_time / time : 0.0;
    b->out.stat.eccentricity = time > 0.0 ? s->eccentricity_time / time : 0.0;
    b->out.stat.dislocation_max = s->dislocation_max;

    // worst rivet at each instant
    b->out.stat.sigma_head_mean = statistics_mean(head);
    b->out.stat.sigma_head_rms = statistics_rms(head);
    b->out.stat.sigma_head_p999 = statistics_quantile(head, STRESS_FLOOR, p);
    b->out.stat.sigma_head_max = head->max;
    b->out.stat.sigma_mid_mean = statistics_mean(mid);
    b->out.stat.sigma_mid_rms = statistics_rms(mid);
    b->out.stat.sigma_mid_p999 = statistics_quantile(mid, STRESS_FLOOR, p);
    b->out.stat.sigma_mid_max = mid->max;

    // each rivet
    for (int k = 0; k < Z; k++) {
        b->out.stat.rivet_head_mean[k] = statistics_mean(&s->head[k]);
        b->out.stat.rivet_head_rms[k] = statistics_rms(&s->head[k]);
        b->out.stat.rivet_head_p999[k] = statistics_quantile(&s->head[k], STRESS_FLOOR, p);
        b->out.stat.rivet_head_max[k] = s->head[k].max;
        b->out.stat.rivet_mid_mean[k] = statistics_mean(&s->mid[k]);
        b->out.stat.rivet_mid_rms[k] = statistics_rms(&s->mid[k]);
        b->out.stat.rivet_mid_p999[k] = statistics_quantile(&s->mid[k], STRESS_FLOOR, p);
        b->out.stat.rivet_mid_max[k] = s->mid[k].max;
    }
}

static void fill_solver(Bearing *b)
{
    const IntegratorState *i = &b->s.integrator;
    b->out.solver.steps = i->steps;
    b->out.solver.rhs_evals = i->rhs_evals;
    b->out.solver.step_size = i->h;
    b->out.solver.error_tests_failed = i->error_tests_failed;
    b->out.solver.cpu_time = b->cpu_time;
    b->out.solver.tolerance = b->s.tolerance;
    b->out.solver.method_used = b->s.p_now.solver.method;
}

static void fill_event(Bearing *b)
{
    const double *onsets = b->s.event.onsets;
    b->out.event.land_contact = b->events[EVENT_LAND_CONTACT].count;
    b->out.event.pocket_exit = b->events[EVENT_POCKET_EXIT].count;
    b->out.event.ellipse_cut = b->events[EVENT_ELLIPSE_CUT].count;
    b->out.event.overpressure = b->events[EVENT_OVERPRESSURE].count;
    b->out.event.joint_open = b->events[EVENT_JOINT_OPEN].count;
    b->out.event.rivet_yield = b->events[EVENT_RIVET_YIELD].count;
    b->out.event.no_clearance = b->events[EVENT_NO_CLEARANCE].count;
    b->out.event.rivet_break = b->events[EVENT_RIVET_BREAK].count;
    b->out.event.step_too_long = b->events[EVENT_STEP_TOO_LONG].count;
    b->out.event.motion_lag = b->events[EVENT_MOTION_LAG].count;
    b->out.event.cage_yield = b->events[EVENT_CAGE_YIELD].count;
    b->out.event.rivet_overload = b->events[EVENT_RIVET_OVERLOAD].count;
    b->out.event.energy_off = b->events[EVENT_ENERGY_OFF].count;
    b->out.event.land_contact_onsets = onsets[EVENT_LAND_CONTACT];
    b->out.event.pocket_exit_onsets = onsets[EVENT_POCKET_EXIT];
    b->out.event.ellipse_cut_onsets = onsets[EVENT_ELLIPSE_CUT];
    b->out.event.overpressure_onsets = onsets[EVENT_OVERPRESSURE];
    b->out.event.joint_open_onsets = onsets[EVENT_JOINT_OPEN];
    b->out.event.rivet_yield_onsets = onsets[EVENT_RIVET_YIELD];
    b->out.event.no_clearance_onsets = onsets[EVENT_NO_CLEARANCE];
    b->out.event.rivet_break_onsets = onsets[EVENT_RIVET_BREAK];
    b->out.event.step_too_long_onsets = onsets[EVENT_STEP_TOO_LONG];
    b->out.event.motion_lag_onsets = onsets[EVENT_MOTION_LAG];
    b->out.event.cage_yield_onsets = onsets[EVENT_CAGE_YIELD];
    b->out.event.rivet_overload_onsets = onsets[EVENT_RIVET_OVERLOAD];
    b->out.event.energy_off_onsets = onsets[EVENT_ENERGY_OFF];
}

static void fill_constant(Bearing *b)
{
    b->out.bearing.Z = Z;
}

// Time that the integrals over the communication step cover [s]; 0 before the first one, where outputs are those of the
// start.
static double covered(const IntegratorState *i)
{
    return fmax(i->t - i->since, 0.0);
}

void outputs_fill(Bearing *b, OutputGroup group)
{
    const Evaluation now = {&b->model, b->s.integrator.now.y, b->y_dot,
                            &b->w,     b->kernels.cage_loads, b->kernels.rivet_rom_stress};
    const IntegratorState *i = &b->s.integrator;
    switch (group) {
    case GROUP_CONSTANT: fill_constant(b); return;
    case GROUP_PEAK: fill_peak(b); return;
    case GROUP_FATIGUE: fill_fatigue(b); return;
    case GROUP_STAT: fill_stat(b); return;
    case GROUP_SOLVER: fill_solver(b); return;
    case GROUP_EVENT: fill_event(b); return;
    case GROUP_ENERGY:
        outputs_evaluate(&now, group, &b->out);
        b->out.bearing.energy_residual -= b->s.energy_start;
        b->out.bearing.energy_residual -= b->s.energy_change;
        b->out.bearing.energy_change = b->s.energy_change;
        if (covered(i) > 0.0) b->out.shaft.power = i->sum.power / covered(i);
        return;
    case GROUP_RING:
        outputs_evaluate(&now, group, &b->out);
        if (covered(i) > 0.0) b->out.bearing.friction_torque = i->sum.torque / covered(i);
        return;
    case GROUP_STATE:
    case GROUP_POSE:
    case GROUP_BALL:
    case GROUP_CAGE:
    case GROUP_RIVET:
    case GROUP_STRESS: outputs_evaluate(&now, group, &b->out); return;
    case GROUP_COUNT: return;
    }
}
