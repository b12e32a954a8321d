// Outputs, group by group, from the results of the right-hand side at the present state.
#include "drive.h"
#include "elementary.h"
#include "energy.h"
#include "hertz.h"
#include "housing.h"
#include "instance.h"
#include "rivets.h"
#include "traction.h"

static const double PI = 3.14159265358979323846;

// The states that are outputs as they are: copied by name.
static void fill_state(Bearing *b)
{
    const double *y = b->s.integrator.y;
    b->out.ring.x = y[Y_RING_X];
    b->out.ring.y = y[Y_RING_Y];
    b->out.ring.z = y[Y_RING_Z];
    b->out.ring.v_x = y[Y_RING_V_X];
    b->out.ring.v_y = y[Y_RING_V_Y];
    b->out.ring.v_z = y[Y_RING_V_Z];
}

static void fill_ring(Bearing *b)
{
    const Work *w = &b->w;
    const double *y_dot = b->y_dot, *y = b->s.integrator.y;
    double F[3], M[3];
    b->out.ring.a_x = y_dot[Y_RING_V_X];
    b->out.ring.a_y = y_dot[Y_RING_V_Y];
    b->out.ring.a_z = y_dot[Y_RING_V_Z];
    ring_tilts(y[Y_RING_BETA], y[Y_RING_GAMMA], &b->out.ring.tilt_y, &b->out.ring.tilt_z);
    housing_reaction(w, F, M);
    b->out.housing.F_x = F[0];
    b->out.housing.F_y = F[1];
    b->out.housing.F_z = F[2];
    b->out.housing.M_y = M[1];
    b->out.housing.M_z = M[2];
    b->out.bearing.friction_torque = -dot3(w->ring.M, w->ring.a);
}

// p_max = 3 Q/(2 pi a b).
static double pressure(const Hertz *hertz, double Q)
{
    const double root = portable_cbrt(Q);
    return Q > 0.0 ? 1.5 * root / (PI * hertz->a * hertz->b) : 0.0;
}

static double film_ratio(const Race *race, double U, double Q)
{
    return Q > 0.0 ? portable_exp(race->ln_Lambda + 0.67 * portable_log(U) - 0.067 * portable_log(Q + Q_FLOOR)) : 0.0;
}

// Spin of the ball against the inner ring about the contact normal / rolling speed across it.
static double spin_roll(const Work *w, int j)
{
    const double *Omega = w->ring.Omega, c = w->cos_theta[j], s = w->sin_theta[j];
    const double rel[3] = {w->omega_x[j] - Omega[0], w->omega_r[j] - (Omega[1] * c + Omega[2] * s), w->omega_t[j] - (Omega[2] * c - Omega[1] * s)};
    const double n[3] = {w->n_ix[j], w->n_ir[j], w->n_it[j]}, spin = dot3(rel, n), all = dot3(rel, rel);
    return w->Q_i[j] > 0.0 && all > spin * spin ? spin / sqrt(all - spin * spin) : 0.0;
}

static void fill_ball(Bearing *b)
{
    const Work *w = &b->w;
    const Parameters *p = &b->s.p;
    const Derived *d = &b->d;
    const bool rigid = p->scene.cage == CAGE_MODEL_RIGID;
    double contacts = 0.0, penetration = 0.0, force_most = 0.0;
    for (int j = 0; j < Z; j++) {
        const double Q_i = w->Q_i[j], Q_e = w->Q_e[j], Q_c = w->pocket[0][j].Q + w->pocket[1][j].Q;
        const double delta_c = rigid ? w->delta_c[0][j] : fmax(w->delta_c[0][j], w->delta_c[1][j]);
        b->out.ball.Q_i[j] = Q_i;
        b->out.ball.Q_e[j] = Q_e;
        b->out.ball.Q_c[j] = Q_c;
        b->out.ball.Q_cx[j] = w->pocket[0][j].F_x + w->pocket[1][j].F_x;
        b->out.ball.omega_m[j] = w->omega_m[j];
        b->out.ball.alpha_i[j] = Q_i > 0.0 ? atan2(-w->n_ix[j], -w->n_ir[j]) : 0.0;
        b->out.ball.alpha_e[j] = Q_e > 0.0 ? atan2(w->n_ex[j], w->n_er[j]) : 0.0;
        b->out.ball.p_i[j] = pressure(&d->inner.hertz, Q_i);
        b->out.ball.p_e[j] = pressure(&d->outer.hertz, Q_e);
        b->out.ball.Lambda_i[j] = film_ratio(&d->inner, w->U_i[j], Q_i);
        b->out.ball.Lambda_e[j] = film_ratio(&d->outer, w->U_e[j], Q_e);
        b->out.ball.spin_roll[j] = spin_roll(w, j);
        contacts += (w->delta_i[j] > 0.0) + (w->delta_e[j] > 0.0) + (delta_c > 0.0);
        penetration = fmax(penetration, fmax(fmax(w->delta_i[j], w->delta_e[j]), delta_c));
        force_most = fmax(force_most, Q_c);
    }
    b->out.bearing.contacts = contacts;
    b->out.bearing.penetration = penetration;
    b->out.cage.F_pocket_max = force_most;
}

static void fill_pose(Bearing *b)
{
    const Work *w = &b->w;
    const double *y = b->s.integrator.y;
    for (int j = 0; j < Z; j++) {
        b->out.ball.x[j] = w->x[j];
        b->out.ball.r[j] = w->r[j];
        b->out.ball.psi[j] = y[Y_BALL_THETA + j];
    }
    const Rotor *h0 = &w->half[0], *h1 = &w->half[1];
    b->out.half_0.x = h0->x[0], b->out.half_0.y = h0->x[1], b->out.half_0.z = h0->x[2], b->out.half_0.psi = y[Y_CAGE_PSI];
    b->out.half_1.x = h1->x[0], b->out.half_1.y = h1->x[1], b->out.half_1.z = h1->x[2], b->out.half_1.psi = y[Y_CAGE_PSI + 1];
    ring_tilts(-h0->a[2], h0->a[1], &b->out.half_0.tilt_y, &b->out.half_0.tilt_z);
    ring_tilts(-h1->a[2], h1->a[1], &b->out.half_1.tilt_y, &b->out.half_1.tilt_z);
}

static void fill_cage(Bearing *b)
{
    const Rotor *h0 = &b->w.half[0], *h1 = &b->w.half[1];
    const double epicyclic = 0.5 * b->drive.omega * (1.0 - b->s.p.bearing.D / b->s.p.bearing.d_m);
    b->out.cage.omega = 0.5 * (h0->s + h1->s);
    b->out.cage.slip_ratio = epicyclic != 0.0 ? 1.0 - b->out.cage.omega / epicyclic : 0.0;
    b->out.cage.y = 0.5 * (h0->x[1] + h1->x[1]);
    b->out.cage.z = 0.5 * (h0->x[2] + h1->x[2]);
    b->out.cage.eccentricity = sqrt(b->out.cage.y * b->out.cage.y + b->out.cage.z * b->out.cage.z) / b->d.C_land;
}

static void fill_rivet(Bearing *b)
{
    RivetLoad load[Z];
    double slip[Z], most = 0.0;
    rivets_load(&b->model, &b->w, load, b->out.rivet.V);
    rivets_slip(&b->model, &b->w, slip);
    for (int k = 0; k < Z; k++) {
        b->out.rivet.N[k] = load[k].N;
        b->out.rivet.T[k] = b->s.p.scene.cage == CAGE_MODEL_RIGID ? b->d.P : b->w.T[k];
        b->out.rivet.M[k] = sqrt(load[k].M_y * load[k].M_y + load[k].M_z * load[k].M_z);
        b->out.rivet.P[k] = b->d.P;
        b->out.rivet.slip[k] = slip[k];
        most = fmax(most, slip[k]);
    }
    b->out.cage.dislocation = most;
}

static void fill_stress(Bearing *b)
{
    RivetLoad load[Z];
    double V[Z], sigma[RIVET_CHANNELS];
    const bool off = b->s.p.scene.stress == STRESS_OFF;
    if (!off) rivets_load(&b->model, &b->w, load, V);
    for (int k = 0; k < Z; k++) {
        unsigned flags = 0;
        memset(sigma, 0, sizeof sigma);
        if (!off) flags = rivet_rom_stress(&rivet_table, &load[k], b->d.fit_eff, sigma);
        b->out.rivet.sigma_head[k] = sigma[HEAD_P1];
        b->out.rivet.sigma_head_vm[k] = sigma[HEAD_VM];
        b->out.rivet.sigma_mid[k] = sigma[MID_VM];
        b->out.rivet.sigma_mid_p1[k] = sigma[MID_P1];
        b->out.rivet.flag[k] = flags;
    }
}

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
    FatigueLaw law;
    memcpy(&law, &b->s.p.fatigue, sizeof law);
    for (int k = 0; k < Z; k++) {
        b->out.rivet.damage_head[k] = fatigue_damage(&b->s.fatigue_head[k], &law);
        b->out.rivet.damage_mid[k] = fatigue_damage(&b->s.fatigue_mid[k], &law);
    }
}

static void fill_energy(Bearing *b)
{
    const Work *w = &b->w;
    b->out.bearing.power_loss = lanes_sum(w->dissipated) + w->land_dissipated;
    if (b->s.p.scene.cage == CAGE_MODEL_TWO_HALF) b->out.bearing.power_loss += lanes_sum(w->joint_dissipated);
    b->out.bearing.energy_residual = energy_total(&b->model, b->s.integrator.y, w) - b->s.energy_start - b->s.integrator.y[Y_WORK];
}

static void fill_stat(Bearing *b)
{
    const Saved *s = &b->s;
    const double time = s->force.time / Z, p = 0.999;  // every ball adds its own time
    const StatisticsChannel *head = &s->head[WORST_RIVET], *mid = &s->mid[WORST_RIVET];
    b->out.stat.time = time;
    b->out.stat.Q_c_mean = statistics_mean(&s->force);
    b->out.stat.Q_c_rms = statistics_rms(&s->force);
    b->out.stat.Q_c_p999 = statistics_quantile(&s->force, FORCE_FLOOR, p);
    b->out.stat.Q_c_max = s->force.most;
    b->out.stat.contact_duty = time > 0.0 ? s->duty_time / (Z * time) : 0.0;
    b->out.stat.cage_omega = time > 0.0 ? s->omega_time / time : 0.0;
    b->out.stat.eccentricity = time > 0.0 ? s->eccentricity_time / time : 0.0;
    b->out.stat.dislocation_max = s->dislocation_most;
    b->out.stat.sigma_head_mean = statistics_mean(head);
    b->out.stat.sigma_head_rms = statistics_rms(head);
    b->out.stat.sigma_head_p999 = statistics_quantile(head, STRESS_FLOOR, p);
    b->out.stat.sigma_head_max = head->most;
    b->out.stat.sigma_mid_mean = statistics_mean(mid);
    b->out.stat.sigma_mid_rms = statistics_rms(mid);
    b->out.stat.sigma_mid_p999 = statistics_quantile(mid, STRESS_FLOOR, p);
    b->out.stat.sigma_mid_max = mid->most;
    for (int k = 0; k < Z; k++) {
        b->out.stat.rivet_head_mean[k] = statistics_mean(&s->head[k]);
        b->out.stat.rivet_head_rms[k] = statistics_rms(&s->head[k]);
        b->out.stat.rivet_head_p999[k] = statistics_quantile(&s->head[k], STRESS_FLOOR, p);
        b->out.stat.rivet_head_max[k] = s->head[k].most;
        b->out.stat.rivet_mid_mean[k] = statistics_mean(&s->mid[k]);
        b->out.stat.rivet_mid_rms[k] = statistics_rms(&s->mid[k]);
        b->out.stat.rivet_mid_p999[k] = statistics_quantile(&s->mid[k], STRESS_FLOOR, p);
        b->out.stat.rivet_mid_max[k] = s->mid[k].most;
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
    b->out.solver.path = i->path;
}

static void fill_event(Bearing *b)
{
    Event now[EVENT_COUNT];
    const double *onsets = b->s.event.onsets;
    events_now(&b->model, &b->w, b->s.head_peak, b->s.mid_peak, now);
    b->out.event.land_contact = now[EVENT_LAND_CONTACT].count;
    b->out.event.pocket_exit = now[EVENT_POCKET_EXIT].count;
    b->out.event.ellipse_cut = now[EVENT_ELLIPSE_CUT].count;
    b->out.event.overpressure = now[EVENT_OVERPRESSURE].count;
    b->out.event.joint_open = now[EVENT_JOINT_OPEN].count;
    b->out.event.rivet_yield = now[EVENT_RIVET_YIELD].count;
    b->out.event.land_contact_onsets = onsets[EVENT_LAND_CONTACT];
    b->out.event.pocket_exit_onsets = onsets[EVENT_POCKET_EXIT];
    b->out.event.ellipse_cut_onsets = onsets[EVENT_ELLIPSE_CUT];
    b->out.event.overpressure_onsets = onsets[EVENT_OVERPRESSURE];
    b->out.event.joint_open_onsets = onsets[EVENT_JOINT_OPEN];
    b->out.event.rivet_yield_onsets = onsets[EVENT_RIVET_YIELD];
}

static void fill_constant(Bearing *b)
{
    b->out.bearing.Z = Z;
}

void outputs_fill(Bearing *b, OutputGroup group)
{
    static void (*const fill[GROUP_COUNT])(Bearing *) = {
        [GROUP_CONSTANT] = fill_constant, [GROUP_STATE] = fill_state, [GROUP_RING] = fill_ring,     [GROUP_POSE] = fill_pose,  [GROUP_BALL] = fill_ball,
        [GROUP_CAGE] = fill_cage,         [GROUP_RIVET] = fill_rivet, [GROUP_STRESS] = fill_stress, [GROUP_PEAK] = fill_peak,  [GROUP_FATIGUE] = fill_fatigue,
        [GROUP_ENERGY] = fill_energy,     [GROUP_STAT] = fill_stat,   [GROUP_SOLVER] = fill_solver, [GROUP_EVENT] = fill_event};
    fill[group](b);
}
