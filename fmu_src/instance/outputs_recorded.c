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

static void fill_channel(const StatisticsChannel *channel, double floor, double *mean, double *rms,
                         double *p999, double *max)
{
    *mean = statistics_mean(channel), *rms = statistics_rms(channel);
    *p999 = statistics_quantile(channel, floor, 0.999), *max = channel->max;
}

static void fill_stat(Bearing *b)
{
#define FILL(channel, floor, name, at)                                                    \
    fill_channel(channel, floor, &b->out.stat.name##_mean at, &b->out.stat.name##_rms at, \
                 &b->out.stat.name##_p999 at, &b->out.stat.name##_max at)
    const InstanceState *s = &b->s;
    const double time = s->force.time / Z;  // every ball has added the same time
    b->out.stat.time = time;
    b->out.stat.contact_duty = time > 0.0 ? s->duty_time / (Z * time) : 0.0;
    b->out.stat.cage_omega = time > 0.0 ? s->omega_time / time : 0.0;
    b->out.stat.eccentricity = time > 0.0 ? s->eccentricity_time / time : 0.0;
    b->out.stat.dislocation_max = s->dislocation_max;
    FILL(&s->force, FORCE_FLOOR, Q_c, );
    FILL(&s->head[WORST_RIVET], STRESS_FLOOR, sigma_head, );
    FILL(&s->mid[WORST_RIVET], STRESS_FLOOR, sigma_mid, );
    for (int k = 0; k < Z; k++) {
        FILL(&s->head[k], STRESS_FLOOR, rivet_head, [k]);
        FILL(&s->mid[k], STRESS_FLOOR, rivet_mid, [k]);
    }
#undef FILL
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
#define FILL(kind, member)                               \
    b->out.event.member = b->events[EVENT_##kind].count; \
    b->out.event.member##_onsets = b->s.event.onsets[EVENT_##kind];
    EVENTS(FILL)
#undef FILL
}

void outputs_fill(Bearing *b, OutputGroup group)
{
    const Evaluation now = {&b->model, b->s.integrator.now.y, b->y_dot,
                            &b->w,     b->kernels.cage_loads, b->kernels.rivet_rom_stress};
    const IntegratorState *i = &b->s.integrator;
    const double covered = i->t - i->since;  // by the integrals [s]; 0 before the first communication step
    switch (group) {
    case GROUP_CONSTANT: b->out.bearing.Z = Z; return;
    case GROUP_PEAK: fill_peak(b); return;
    case GROUP_FATIGUE: fill_fatigue(b); return;
    case GROUP_STAT: fill_stat(b); return;
    case GROUP_SOLVER: fill_solver(b); return;
    case GROUP_EVENT: fill_event(b); return;
    default: outputs_evaluate(&now, group, &b->out);
    }
    if (group == GROUP_ENERGY) {
        b->out.bearing.energy_residual -= b->s.energy_start;
        b->out.bearing.energy_residual -= b->s.energy_change;
        b->out.bearing.energy_change = b->s.energy_change;
    }
    if (group == GROUP_ENERGY && covered > 0.0) b->out.shaft.power = i->sum.power / covered;
    if (group == GROUP_RING && covered > 0.0) b->out.bearing.friction_torque = i->sum.torque / covered;
}
