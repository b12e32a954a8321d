// Outputs that follow from one evaluation of the right-hand side, group by group.  The file is compiled for
// values and, with dual numbers, for derivatives.
#include "instance/outputs.h"

#include "cage/cage.h"
#include "instance/energy.h"
#include "physics/hertz.h"
#include "physics/powers.h"
#include "physics/ring_fit.h"
#include "physics/ring_load.h"
#include "physics/traction.h"

// Speed [rad/s] up to which no slip ratio is formed: a bearing at standstill has none.
static const double STANDSTILL = 1e-9;

static void put(const scalar from[3], scalar *x, scalar *y, scalar *z)
{
    *x = from[0], *y = from[1], *z = from[2];
}

// States that are outputs themselves.
static void fill_state(const Evaluation *at, Outputs *out)
{
    const Rotor *ring = &at->w->ring;
    put(ring->x, &out->ring.x, &out->ring.y, &out->ring.z);
    out->ring.beta = -ring->a[2];
    out->ring.gamma = ring->a[1];
    put(ring->v, &out->ring.v_x, &out->ring.v_y, &out->ring.v_z);
    out->ring.beta_dot = -ring->a_dot[2];
    out->ring.gamma_dot = ring->a_dot[1];
}

static void fill_acceleration(const Evaluation *at, Outputs *out)
{
    const RingLoad *given = at->model->ring_load;
    const bool prescribed = at->model->p->ring.motion == RING_MOTION_PRESCRIBED;
    const scalar *y_dot = at->y_dot;
    put(prescribed ? given->a : &y_dot[Y_RING_V_X], &out->ring.a_x, &out->ring.a_y, &out->ring.a_z);
    out->ring.beta_ddot = prescribed ? given->beta_ddot : y_dot[Y_RING_BETA_DOT];
    out->ring.gamma_ddot = prescribed ? given->gamma_ddot : y_dot[Y_RING_GAMMA_DOT];
}

static void fill_ring(const Evaluation *at, Outputs *out)
{
    const Work *w = at->w;
    scalar F[3], M[3];
    fill_acceleration(at, out);
    ring_tilts(-w->ring.a[2], w->ring.a[1], &out->ring.tilt_y, &out->ring.tilt_z);
    put(w->ring.F, &out->shaft.R_x, &out->shaft.R_y, &out->shaft.R_z);
    out->shaft.R_My = w->ring.M[1];
    out->shaft.R_Mz = w->ring.M[2];
    housing_wrench(at->model, w, F, M);
    put(F, &out->housing.F_x, &out->housing.F_y, &out->housing.F_z);
    put(M, &out->housing.M_x, &out->housing.M_y, &out->housing.M_z);
    const RingLoad *outer = at->model->ring_load;
    put(outer->outer_x, &out->housing.u_x, &out->housing.u_y, &out->housing.u_z);
    put(outer->outer_a, &out->housing.a_x, &out->housing.a_y, &out->housing.a_z);
    ring_tilts(outer->outer_beta, outer->outer_gamma, &out->housing.u_tilt_y, &out->housing.u_tilt_z);
    out->bearing.friction_torque = friction_torque(w);
}

// Film thickness / roughness at mean speed U and load Q, 0 without contact.
static scalar film_ratio(const Derived *d, const Race *race, scalar U, scalar Q)
{
    if (scalar_value(Q) <= 0.0) return 0.0;
    const scalar ln_U = scalar_log(U);
    const scalar thermal = 1.0 + scalar_exp(0.62 * (d->ln_thermal + 2.0 * ln_U)) / 3.94;
    return scalar_exp(race->ln_Lambda + 0.67 * ln_U - 0.067 * scalar_log(Q + Q_FLOOR) - scalar_log(thermal));
}

// Spin of the ball against the inner ring about the contact normal / rolling speed across it.
static scalar spin_roll(const Work *w, int j)
{
    const scalar *Omega = w->ring.Omega, c = w->cos_theta[j], s = w->sin_theta[j];
    const scalar rel[3] = {w->omega_x[j] - Omega[0], w->omega_r[j] - (Omega[1] * c + Omega[2] * s),
                           w->omega_t[j] - (Omega[2] * c - Omega[1] * s)};
    const scalar n[3] = {w->n_ix[j], w->n_ir[j], w->n_it[j]}, spin = dot3(rel, n);
    const scalar across = dot3(rel, rel) - spin * spin;
    return scalar_value(w->Q_i[j]) > 0.0 && scalar_value(across) > 0.0 ? spin / scalar_sqrt(across) : 0.0;
}

static void fill_ball(const Evaluation *at, Outputs *out)
{
    const Work *w = at->w;
    const Derived *d = at->model->d;
    double contacts = 0.0;
    scalar penetration = 0.0, force_max = 0.0;
    for (int j = 0; j < Z; j++) {
        const scalar Q_i = w->Q_i[j], Q_e = w->Q_e[j], Q_c = w->pocket[0].Q[j] + w->pocket[1].Q[j];
        const scalar delta[3] = {w->delta_i[j], w->delta_e[j],
                                 scalar_max(w->delta_c[0][j], w->delta_c[1][j])};
        out->ball.Q_i[j] = Q_i;
        out->ball.Q_e[j] = Q_e;
        out->ball.Q_c[j] = Q_c;
        out->ball.Q_cx[j] = w->pocket[0].F_x[j] + w->pocket[1].F_x[j];
        out->ball.omega_m[j] = w->omega_m[j];

        // angles, pressures, films, spin
        out->ball.alpha_i[j] = scalar_value(Q_i) > 0.0 ? scalar_atan2(-w->n_ix[j], -w->n_ir[j]) : 0.0;
        out->ball.alpha_e[j] = scalar_value(Q_e) > 0.0 ? scalar_atan2(w->n_ex[j], w->n_er[j]) : 0.0;
        out->ball.p_i[j] = hertz_pressure(&d->inner.hertz, Q_i);
        out->ball.p_e[j] = hertz_pressure(&d->outer.hertz, Q_e);
        out->ball.Lambda_i[j] = film_ratio(d, &d->inner, w->U_i[j], Q_i);
        out->ball.Lambda_e[j] = film_ratio(d, &d->outer, w->U_e[j], Q_e);
        out->ball.spin_roll[j] = spin_roll(w, j);

        // over all balls
        for (int i = 0; i < 3; i++) {
            contacts += scalar_value(delta[i]) > 0.0;
            penetration = scalar_max(penetration, delta[i]);
        }
        force_max = scalar_max(force_max, Q_c);
    }
    const scalar growth = ring_fit_growth(&d->fit, ring_fit_speed(at->model->ring_load));
    out->bearing.clearance = at->model->p->bearing.P_d - 2.0 * growth;
    out->bearing.contacts = contacts;
    out->bearing.penetration = penetration;
    out->cage.F_pocket_max = force_max;
}

static void fill_pose(const Evaluation *at, Outputs *out)
{
    const Work *w = at->w;
    for (int j = 0; j < Z; j++) {
        out->ball.x[j] = w->x[j];
        out->ball.r[j] = w->r[j];
        out->ball.psi[j] = at->y[Y_BALL_THETA + j];
    }
    const Rotor *h0 = &w->half[0], *h1 = &w->half[1];
    put(h0->x, &out->half_0.x, &out->half_0.y, &out->half_0.z);
    put(h1->x, &out->half_1.x, &out->half_1.y, &out->half_1.z);
    out->half_0.psi = at->y[Y_CAGE_PSI], out->half_1.psi = at->y[Y_CAGE_PSI + 1];
    ring_tilts(-h0->a[2], h0->a[1], &out->half_0.tilt_y, &out->half_0.tilt_z);
    ring_tilts(-h1->a[2], h1->a[1], &out->half_1.tilt_y, &out->half_1.tilt_z);
    cage_flex(at->model, at->w, 0, out->rivet.flex_0_x, out->rivet.flex_0_r, out->rivet.flex_0_t);
    cage_flex(at->model, at->w, 1, out->rivet.flex_1_x, out->rivet.flex_1_r, out->rivet.flex_1_t);
}

static void fill_cage(const Evaluation *at, Outputs *out)
{
    const Rotor *h0 = &at->w->half[0], *h1 = &at->w->half[1];
    const Parameters *p = at->model->p;
    const scalar outer = at->model->ring_load->outer_omega;
    const scalar epicyclic =
        outer + 0.5 * (at->model->ring_load->omega - outer) * (1.0 - p->bearing.D / p->bearing.d_m);
    const scalar e_y = 0.5 * (h0->x[1] + h1->x[1]) - at->model->ring_load->outer_x[1];
    const scalar e_z = 0.5 * (h0->x[2] + h1->x[2]) - at->model->ring_load->outer_x[2];
    out->cage.omega = 0.5 * (h0->s + h1->s);
    out->cage.slip_ratio =
        fabs(scalar_value(epicyclic)) > STANDSTILL ? 1.0 - out->cage.omega / epicyclic : 0.0;
    out->cage.y = 0.5 * (h0->x[1] + h1->x[1]);
    out->cage.z = 0.5 * (h0->x[2] + h1->x[2]);
    out->cage.eccentricity = scalar_sqrt(e_y * e_y + e_z * e_z) / at->model->d->play;
}

// Components of vectors (r, t) at the rivets along y and z of the cage's body frame.
static void fill_vectors(const Derived *d, const scalar *r, const scalar *t, scalar y[Z], scalar z[Z])
{
    for (int k = 0; k < Z; k++) {
        const double R = sqrt(d->rivet_y[k] * d->rivet_y[k] + d->rivet_z[k] * d->rivet_z[k]),
                     c = d->rivet_y[k] / R, s = d->rivet_z[k] / R;
        y[k] = r[k] * c - t[k] * s;
        z[k] = r[k] * s + t[k] * c;
    }
}

static void fill_rivet(const Evaluation *at, Outputs *out)
{
    const Derived *d = at->model->d;
    JointLoads load;
    scalar slip[Z], max = 0.0;
    at->loads(at->model, at->w, &load);
    cage_slip(at->model, at->w, slip);
    for (int k = 0; k < Z; k++) {
        out->rivet.N[k] = load.N[k];
        out->rivet.T[k] = load.T[k];
        out->rivet.M[k] = scalar_sqrt(load.M_r[k] * load.M_r[k] + load.M_t[k] * load.M_t[k]);
        out->rivet.M_shank[k] = scalar_sqrt(load.m_r[k] * load.m_r[k] + load.m_t[k] * load.m_t[k]);
        out->rivet.V[k] = load.V[k];
        out->rivet.P[k] = d->P[k];
        out->rivet.F_head[k] = load.F_head[k];
        out->rivet.slip[k] = slip[k];
        max = scalar_max(max, slip[k]);
    }
    fill_vectors(d, load.V_r, load.V_t, out->rivet.V_y, out->rivet.V_z);
    fill_vectors(d, load.M_r, load.M_t, out->rivet.M_y, out->rivet.M_z);
    fill_vectors(d, load.m_r, load.m_t, out->rivet.M_shank_y, out->rivet.M_shank_z);
    out->cage.dislocation = max;
    out->rivet.table_kind = rivet_table.kind;
}

static void fill_stress(const Evaluation *at, Outputs *out)
{
    JointLoads load;
    scalar sigma[RIVET_CHANNELS][Z] = {{0.0}};
    const bool off = at->model->p->scene.stress == STRESS_OFF;
    if (!off) {
        at->loads(at->model, at->w, &load);
        at->stress(&rivet_table, &load, at->model->d->fit_eff, true, sigma);
    }
    for (int k = 0; k < Z; k++) {
        out->rivet.sigma_head[k] = sigma[HEAD_P1][k];
        out->rivet.sigma_head_vm[k] = sigma[HEAD_VM][k];
        out->rivet.sigma_mid[k] = sigma[MID_VM][k];
        out->rivet.sigma_mid_p1[k] = sigma[MID_P1][k];
        out->rivet.flag[k] =
            off ? 0.0 : at->model->d->fit_flags[k] | rivet_rom_load_flags(&rivet_table, sigma, k);
    }
}

// The energy at the start is not known here: outputs_fill subtracts it from the residual.
static void fill_energy(const Evaluation *at, Outputs *out)
{
    const Work *w = at->w;
    out->loss.modes = cage_vibrations_lose(w);
    out->loss.joints = ball_array_sum(w->joint_dissipated) + cage_joints_damp(w);
    out->bearing.power_loss = power_loss(w) + ball_array_sum(w->joint_dissipated);
    out->loss.races = ball_array_sum(w->race_dissipated);
    out->loss.inlet = ball_array_sum(w->inlet_dissipated);
    out->loss.spin = ball_array_sum(w->spin_dissipated);
    out->loss.ball_drag = ball_array_sum(w->drag_dissipated);
    out->loss.cage_drag = w->cage_drag_dissipated;
    out->loss.ring_drag = w->ring_drag_dissipated;
    out->loss.land = w->land_dissipated;
    out->loss.pockets = ball_array_sum(w->pocket_dissipated);
    out->shaft.power = shaft_power(w);
    out->housing.power = housing_power(at->model, w);
    const scalar energy = energy_total(at->model, at->y, w);
    out->frame.power = frame_power(at->model, w) + cage_widening(w, at->model->ring_load->frame_omega_dot);
    out->bearing.energy = energy + cage_widened(w);
    out->bearing.energy_residual = energy - at->y[Y_WORK];
}

void outputs_evaluate(const Evaluation *at, OutputGroup group, Outputs *out)
{
    switch (group) {
    case GROUP_STATE: fill_state(at, out); return;
    case GROUP_RING: fill_ring(at, out); return;
    case GROUP_POSE: fill_pose(at, out); return;
    case GROUP_BALL: fill_ball(at, out); return;
    case GROUP_CAGE: fill_cage(at, out); return;
    case GROUP_RIVET: fill_rivet(at, out); return;
    case GROUP_STRESS: fill_stress(at, out); return;
    case GROUP_ENERGY: fill_energy(at, out); return;
    case GROUP_CONSTANT:
    case GROUP_PEAK:
    case GROUP_FATIGUE:
    case GROUP_STAT:
    case GROUP_SOLVER:
    case GROUP_EVENT:
    case GROUP_COUNT: return;  // outputs_recorded.c
    }
}
