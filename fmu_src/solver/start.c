// Quasi-static equilibrium, as the minimum of a potential in two nested Newton iterations:
//
//   ball j, ring given               phi_j(x, r) = (2/5)(K_i delta_i^2.5 + K_e delta_e^2.5) - F_c r + k_0 x^2/2 -> min
//                                    F_c = m r_0 omega_m^2 + F_0
//   ring q = (x, y, z, beta, gamma)  Pi = sum phi_j - F.q - M.(beta, gamma) + support + k_0 q^2/2 -> min
//
// Forces and contact results come from race_contact_force at rest, stiffnesses from k = Q' n n^T + (Q/L)(1 -
// n n^T).  Two small forces make the equilibrium unique: F_0 presses unloaded balls outward at standstill,
// and the springs k_0 (0.01 N over 10 um) hold the coordinates on which no load acts, as the axial one
// without axial load.
//
// Then all parts get kinematic speeds without slip.  The cage takes the mean and the first harmonic of the
// balls' axial positions, because the balls of a tilted ring would otherwise start inside its walls, and
// turns with the balls.
#include "solver/start.h"

#include "cage/cage.h"
#include "numbers/elementary.h"
#include "numbers/elimination.h"
#include "physics/hertz.h"
#include "physics/outer_ring.h"
#include "physics/ring_load.h"

enum { DOF = BODY_DOF, TILT = 3 };  // of the ring: x, y, z, then from TILT on beta, gamma

static const double K_0 = 1e3;    // spring on each coordinate [N/m]
static const double F_0 = 1e-3;   // force that presses each ball outward [N]
static const double STEP = 2e-5;  // longest Newton step [m]

typedef struct {
    const Kernels *kernels;
    const Model *model;
    Work *w;
    double F_c;             // centrifugal force on a ball, with F_0 [N]
    double F_x[Z], F_r[Z];  // of the frame's field on each ball [N]
    double x_0[Z];          // axial place of the outer ring at each ball [m]
    bool tilts;             // whether beta, gamma are unknowns
    double F[3];            // load [N]
} Equilibrium;

// A symmetric 2 x 2 matrix in the directions x and r [N/m].
typedef struct {
    double xx, xr, rr;
} Stiffness;

// Stiffness of a contact whose normal is n and whose ball is L from the groove's centre.
static Stiffness contact_stiffness(double K, double delta, double L, double n_x, double n_r)
{
    if (delta <= 0.0) return (Stiffness){0.0, 0.0, 0.0};
    const double root = sqrt(delta), along = 1.5 * K * root, across = K * delta * root / L;
    return (Stiffness){across + (along - across) * n_x * n_x, (along - across) * n_x * n_r,
                       across + (along - across) * n_r * n_r};
}

// Stiffnesses of the contacts of ball j at the inner and the outer race.
static void ball_stiffness(const Equilibrium *eq, int j, Stiffness *inner, Stiffness *outer)
{
    const Derived *d = eq->model->d;
    const Work *w = eq->w;
    const double L_i = w->delta_i[j] + d->inner.r_g - d->R[j], L_e = w->delta_e[j] + d->outer.r_g - d->R[j];
    *inner = contact_stiffness(d->inner.hertz.K, w->delta_i[j], L_i, w->n_ix[j], w->n_ir[j]);
    *outer = contact_stiffness(d->outer.hertz.K, w->delta_e[j], L_e, w->n_ex[j], w->n_er[j]);
}

// phi of ball j.
static double ball_potential(const Equilibrium *eq, int j)
{
    const Derived *d = eq->model->d;
    const Work *w = eq->w;
    const double stored = d->rough ? w->race_stored[j]
                                   : hertz_stored(d->inner.hertz.K, w->delta_i[j]) +
                                         hertz_stored(d->outer.hertz.K, w->delta_e[j]);
    return stored - (eq->F_c + eq->F_r[j]) * w->r[j] - eq->F_x[j] * w->x[j] +
           0.5 * K_0 * (w->x[j] - eq->x_0[j]) * (w->x[j] - eq->x_0[j]);
}

// Minimises the potential of every ball for the ring's present pose; returns the sum.
static double balls_settle(const Equilibrium *eq)
{
    Work *w = eq->w;
    double x[Z], r[Z], dx[Z], dr[Z], phi[Z], part[Z];
    eq->kernels->race_contact_force(eq->model, w);
    for (int j = 0; j < Z; j++) phi[j] = ball_potential(eq, j);
    for (int iteration = 0; iteration < 60; iteration++) {
        // Newton step of every ball, at most STEP long
        double moved = 0.0;
        for (int j = 0; j < Z; j++) {
            Stiffness k_i, k_e;
            ball_stiffness(eq, j, &k_i, &k_e);
            const double xx = k_i.xx + k_e.xx + K_0, xr = k_i.xr + k_e.xr, rr = k_i.rr + k_e.rr + K_0;
            const double det = xx * rr - xr * xr;
            const double F_x = w->F_x[j] + eq->F_x[j] - K_0 * (w->x[j] - eq->x_0[j]);
            const double F_r = w->F_r[j] + (eq->F_c + eq->F_r[j]);
            x[j] = w->x[j], r[j] = w->r[j], part[j] = 1.0;
            dx[j] = (rr * F_x - xr * F_r) / det, dr[j] = (xx * F_r - xr * F_x) / det;
            const double length = sqrt(dx[j] * dx[j] + dr[j] * dr[j]);
            if (length > STEP) dx[j] *= STEP / length, dr[j] *= STEP / length;
            moved = fmax(moved, length);
        }
        if (moved < 1e-16) break;

        // every ball halves its own step until its potential falls
        for (int trial = 0; trial < 30; trial++) {
            bool again = false;
            for (int j = 0; j < Z; j++) {
                w->x[j] = x[j] + part[j] * dx[j];
                w->r[j] = r[j] + part[j] * dr[j];
            }
            eq->kernels->race_contact_force(eq->model, w);
            for (int j = 0; j < Z; j++) {
                if (ball_potential(eq, j) > phi[j] + 1e-14 * fabs(phi[j]) && part[j] > 1e-6) {
                    part[j] *= 0.5;
                    again = true;
                }
            }
            if (!again) break;
        }
        for (int j = 0; j < Z; j++) phi[j] = ball_potential(eq, j);
    }
    double sum = 0.0;
    for (int j = 0; j < Z; j++) sum += phi[j];
    return sum;
}

// Puts the ring into the pose q, at rest.
static void ring_pose(const Equilibrium *eq, const double q[DOF])
{
    for (int i = 0; i < 3; i++) eq->w->ring.x[i] = q[i];
    rotor_axis(&eq->w->ring, q[3], q[4], 0.0, 0.0, 0.0);
}

// Pi without the balls' phi_j; sets `force` to minus its gradient.
static double ring_potential(const Equilibrium *eq, const double q[DOF], double force[DOF])
{
    const Parameters *p = eq->model->p;
    const RingLoad *ring_load = eq->model->ring_load;
    const double target[2] = {ring_load->beta, ring_load->gamma};
    const double k = p->ring.tilt_mode == TILT_MODE_SUPPORTED ? p->ring.k_tilt : 0.0;
    const double r2 = 0.25 * p->bearing.d_m * p->bearing.d_m;  // k_0 acts at the pitch radius
    double Pi = 0.0;
    for (int i = 0; i < 3; i++) {
        const double off = q[i] - ring_load->outer_x[i];
        Pi += 0.5 * K_0 * off * off - eq->F[i] * q[i];
        force[i] = eq->F[i] - K_0 * off;
    }
    for (int i = 0; i < 2; i++) {
        const double angle = q[TILT + i] - target[i];
        force[TILT + i] = eq->tilts ? ring_load->M[i] - k * angle - K_0 * r2 * q[TILT + i] : 0.0;
        if (eq->tilts)
            Pi += 0.5 * k * angle * angle + 0.5 * K_0 * r2 * q[TILT + i] * q[TILT + i] -
                  ring_load->M[i] * q[TILT + i];
    }
    return Pi;
}

// Adds the balls' forces on the ring to `force`, and to H their stiffness with the balls' own displacements
// eliminated: k_i - k_i (k_i + k_e)^-1 k_i.
static void ring_balls(const Equilibrium *eq, double force[DOF], double H[DOF][DOF])
{
    const Derived *d = eq->model->d;
    const Work *w = eq->w;
    const double F[DOF] = {ball_array_sum(w->ring_F_x), ball_array_sum(w->ring_F_y),
                           ball_array_sum(w->ring_F_z), ball_array_sum(w->ring_M_y),
                           ball_array_sum(w->ring_M_z)};
    for (int i = 0; i < DOF; i++)
        if (i < TILT || eq->tilts) force[i] += F[i];

    for (int j = 0; j < Z; j++) {
        Stiffness a, b;
        ball_stiffness(eq, j, &a, &b);
        const double xx = a.xx + b.xx + K_0, xr = a.xr + b.xr, rr = a.rr + b.rr + K_0;
        const double det = xx * rr - xr * xr;
        // k = a - a (a + b)^-1 a, with i the inverse of a + b and m = a (a + b)^-1
        const double i_xx = rr / det, i_xr = -xr / det, i_rr = xx / det;
        const double m_xx = a.xx * i_xx + a.xr * i_xr, m_xr = a.xx * i_xr + a.xr * i_rr;
        const double m_rx = a.xr * i_xx + a.rr * i_xr, m_rr = a.xr * i_xr + a.rr * i_rr;
        const double k_xx = a.xx - m_xx * a.xx - m_xr * a.xr, k_xr = a.xr - m_xx * a.xr - m_xr * a.rr;
        const double k_rr = a.rr - m_rx * a.xr - m_rr * a.rr;
        const double c = w->cos_theta[j], s = w->sin_theta[j], R = d->inner.R_g;
        const double G_x[DOF] = {1.0, 0.0, 0.0, R * s, -R * c}, G_r[DOF] = {0.0, c, s, 0.0, 0.0};
        for (int m = 0; m < DOF; m++)
            for (int n = 0; n < DOF; n++)
                H[m][n] += k_xx * G_x[m] * G_x[n] + k_xr * (G_x[m] * G_r[n] + G_r[m] * G_x[n]) +
                           k_rr * G_r[m] * G_r[n];
    }
}

// Finds the ring's pose q and the balls' positions (in w) by Newton's method; returns the largest residual
// force.
static double equilibrium(const Equilibrium *eq, double q[DOF])
{
    const Parameters *p = eq->model->p;
    const double r = 0.5 * p->bearing.d_m, r2 = r * r;
    double residual = 0.0, force[DOF];
    ring_pose(eq, q);
    double Pi = balls_settle(eq) + ring_potential(eq, q, force);
    for (int iteration = 0; iteration < 100; iteration++) {
        // gradient and stiffness; rows of fixed tilts are the identity
        double H[DOF][DOF] = {{0}};
        ring_balls(eq, force, H);
        residual = 0.0;
        for (int i = 0; i < DOF; i++) {
            residual = fmax(residual, fabs(force[i]) / (i < TILT ? 1.0 : r));
            H[i][i] +=
                i < TILT ? K_0 : K_0 * r2 + (p->ring.tilt_mode == TILT_MODE_SUPPORTED ? p->ring.k_tilt : 0.0);
            if (i >= TILT && !eq->tilts)
                for (int n = 0; n < DOF; n++) H[i][n] = H[n][i] = n == i ? 1.0 : 0.0;
        }
        if (residual < 1e-9) break;

        // Newton step, at most STEP long
        eliminate(H, force);
        double length = 0.0, step[DOF], trial[DOF];
        for (int i = 0; i < DOF; i++) length = fmax(length, fabs(force[i]) * (i < TILT ? 1.0 : r));
        for (int i = 0; i < DOF; i++) step[i] = force[i] * fmin(1.0, STEP / fmax(length, 1e-300));
        if (length < 1e-16) break;

        // the step is halved until the potential does not rise
        double Pi_new = Pi, part = 1.0;
        for (int halving = 0; halving < 30; halving++, part *= 0.5) {
            for (int i = 0; i < DOF; i++) trial[i] = q[i] + part * step[i];
            ring_pose(eq, trial);
            Pi_new = balls_settle(eq) + ring_potential(eq, trial, force);
            if (Pi_new <= Pi + 1e-13 * fabs(Pi)) break;
        }
        Pi = Pi_new;
        memcpy(q, trial, sizeof trial);
    }
    return residual;
}

// Next random number in [0, 1) by splitmix64, which gives the same numbers in both twins.  Steele, Lea &
// Flood (2014).
static double uniform(uint64_t *state)
{
    uint64_t z = (*state += 0x9e3779b97f4a7c15u);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return (double)((z ^ (z >> 31)) >> 11) * 0x1p-53;
}

// Orbital speed without slip at both races: against the outer ring, the balls' centres move half as fast as the inner
// contact points.  Mean over the balls, weighted by their load.
static double orbital_speed(const Model *model, const Work *w)
{
    double weight = 0.0, sum = 0.0;
    for (int j = 0; j < Z; j++) {
        const double cosine = w->Q_i[j] > 0.0 ? fabs(w->n_ir[j]) : 1.0, load = w->Q_i[j] + 1e-9;
        sum += load * 0.5 * (1.0 - 2.0 * model->d->R[j] * cosine / model->p->bearing.d_m);
        weight += load;
    }
    const double outer = model->ring_load->outer_omega;
    return outer + (model->ring_load->omega - outer) * sum / weight;
}

// Sets both halves into the plane x_0 + (beta sin theta - gamma cos theta) r, which fits the balls' axial
// positions, in the middle of the outer ring, turning steadily about its normal.
static void cage_pose(const Model *model, const Work *w, double omega_m, double *y)
{
    const Derived *d = model->d;
    double x_0 = 0.0, beta = 0.0, gamma = 0.0, drift[3];
    for (int j = 0; j < Z; j++) {
        x_0 += w->x[j] / Z;
        beta += 2.0 * w->x[j] * w->sin_theta[j] / (Z * w->r[j]);
        gamma -= 2.0 * w->x[j] * w->cos_theta[j] / (Z * w->r[j]);
    }
    for (int h = 0; h < 2; h++) {
        Rotor half;
        rotor_axis(&half, beta, gamma, 0.0, 0.0, omega_m);
        rotor_body_axes(&half, 1.0, 0.0);
        for (int i = 0; i < 3; i++) half.c[i] = d->com_x[h] * half.a[i] + d->com_e * half.b_y[i];
        cross3(half.Omega, half.c, drift);
        for (int i = 0; i < 3; i++) {
            y[Y_CAGE_X + 2 * i + h] = (i == 0 ? x_0 : model->ring_load->outer_x[i]) + half.c[i];
            y[Y_CAGE_V_X + 2 * i + h] = drift[i];
        }
        y[Y_CAGE_BETA + h] = beta;
        y[Y_CAGE_GAMMA + h] = gamma;
        y[Y_CAGE_S + h] = omega_m;
    }
}

// Azimuth of a ball from the origin, less that from the outer ring's centre (phi), at the radius r.
static double outer_offset(const RingLoad *ring_load, double r, double phi)
{
    const double y = ring_load->outer_x[1], z = ring_load->outer_x[2];
    if (y == 0.0 && z == 0.0) return 0.0;
    const double c = portable_cos(phi), s = portable_sin(phi);
    return scalar_atan2(z * c - y * s, r + y * c + z * s);
}

// The rings at rest where they are.
static RingLoad resting(const RingLoad *ring_load)
{
    RingLoad rest = *ring_load;
    for (int i = 0; i < 3; i++) rest.v[i] = rest.outer_v[i] = 0.0;
    rest.outer_beta_dot = rest.outer_gamma_dot = rest.outer_omega = 0.0;
    return rest;
}

// Forces of the frame's field on ring and balls at rest, and place of the outer ring at each ball.
static void place_in_frame(const Model *model, const Work *w, Equilibrium *eq)
{
    const RingLoad *frame = model->ring_load;
    const double r = 0.5 * model->p->bearing.d_m;
    for (int i = 0; i < 3; i++) eq->F[i] = frame->F[i] + model->p->ring.m * frame->field[i];
    for (int j = 0; j < Z; j++) {
        const double c = w->cos_theta[j], s = w->sin_theta[j];
        eq->F_x[j] = model->d->m * frame->field[0];
        eq->F_r[j] = model->d->m * (frame->field[1] * c + frame->field[2] * s);
        eq->x_0[j] = frame->outer_x[0] + (frame->outer_beta * s - frame->outer_gamma * c) * r;
    }
}

// Balls and cage start with the mean velocity of the rings, the ring with its own or with that of the outer ring.
static void join_motion(const Model *model, const Work *w, double *y)
{
    const RingLoad *given = model->ring_load;
    const bool prescribed = model->p->ring.motion == RING_MOTION_PRESCRIBED;
    double v[3];
    for (int i = 0; i < 3; i++) {
        y[Y_RING_V_X + i] = given->outer_v[i];
        v[i] = prescribed ? 0.5 * (given->v[i] + given->outer_v[i]) : given->outer_v[i];
        for (int h = 0; h < 2; h++) y[Y_CAGE_V_X + 2 * i + h] += v[i];
    }
    for (int j = 0; j < Z; j++) {
        const double c = w->cos_theta[j], s = w->sin_theta[j];
        y[Y_BALL_V_X + j] = v[0];
        y[Y_BALL_V_R + j] = v[1] * c + v[2] * s;
        y[Y_BALL_OMEGA_M + j] += (v[2] * c - v[1] * s) / w->r[j];
    }
    if (prescribed) ring_follow(given, y);
}

// Largest force that is left on a ball.
static double balls_residual(const Equilibrium *eq)
{
    const Work *w = eq->w;
    double residual = 0.0;
    for (int j = 0; j < Z; j++) {
        const double F_x = w->F_x[j] + eq->F_x[j] - K_0 * (w->x[j] - eq->x_0[j]);
        residual = fmax(residual, fmax(fabs(F_x), fabs(w->F_r[j] + eq->F_c + eq->F_r[j])));
    }
    return residual;
}

double start_state(const Kernels *kernels, const Model *model, Work *w, double *y)
{
    const Parameters *p = model->p;
    const Derived *d = model->d;
    const RingLoad *given = model->ring_load, rest = resting(given);
    const Model at_rest = {p, d, &rest, NULL, NULL, NULL, NULL};
    const bool prescribed = p->ring.motion == RING_MOTION_PRESCRIBED;
    Equilibrium eq = {
        .kernels = kernels, .model = &at_rest, .w = w, .tilts = p->ring.tilt_mode != TILT_MODE_PRESCRIBED};
    work_init(d, w);
    const double outer = given->outer_omega;
    const double omega_0 =
        outer + 0.5 * (given->omega - outer) * (1.0 - p->bearing.D / p->bearing.d_m) + given->frame_omega;
    eq.F_c = d->m * 0.5 * p->bearing.d_m * omega_0 * omega_0 + F_0;

    // balls at rest on the pitch circle about the outer ring's centre, equally spaced but for the random part
    uint64_t random = (uint64_t)p->start.seed;
    const double spread = p->start.spacing * p->cage.pocket_clearance / (0.5 * p->bearing.d_m);
    for (int j = 0; j < Z; j++) {
        const double phi = 2.0 * PI * j / Z + p->pocket.dtheta[j] + spread * (2.0 * uniform(&random) - 1.0);
        w->theta[j] = phi + outer_offset(given, 0.5 * p->bearing.d_m, phi);
        w->cos_theta[j] = portable_cos(w->theta[j]);
        w->sin_theta[j] = portable_sin(w->theta[j]);
        w->r[j] = 0.5 * p->bearing.d_m + 0.25 * p->bearing.P_d +
                  (given->outer_x[1] * w->cos_theta[j] + given->outer_x[2] * w->sin_theta[j]);
    }
    place_in_frame(model, w, &eq);
    for (int j = 0; j < Z; j++) w->x[j] = eq.x_0[j];

    // equilibrium of ring and balls, from the ring in the middle of the outer ring with the shaft's tilt; of the balls
    // alone where the ring's place is given
    const double *centre = prescribed ? given->x : given->outer_x;
    double q[DOF] = {centre[0], centre[1], centre[2], given->beta, given->gamma}, residual;
    if (prescribed) {
        ring_pose(&eq, q);
        balls_settle(&eq);
        residual = balls_residual(&eq);
    } else
        residual = equilibrium(&eq, q);

    // kinematic speeds
    memset(y, 0, (size_t)cage_states(model) * sizeof *y);
    const double omega_m = orbital_speed(model, w);
    for (int j = 0; j < Z; j++) {
        y[Y_BALL_X + j] = w->x[j];
        y[Y_BALL_R + j] = w->r[j];
        y[Y_BALL_THETA + j] = w->theta[j];
        y[Y_BALL_OMEGA_M + j] = omega_m;
        // against the outer ring, the ball rolls on its race about the axis across its contact normal:
        // v_t + R (omega_x n_r - omega_r n_x) = 0
        const double rolling = -w->r[j] * (omega_m - outer) / d->R[j];
        y[Y_BALL_OMEGA_X + j] = rolling * w->n_er[j] + outer;
        y[Y_BALL_OMEGA_R + j] = -rolling * w->n_ex[j];
    }

    // cage and ring
    cage_pose(model, w, omega_m, y);
    cage_rest(model, omega_m + given->frame_omega, y);
    for (int i = 0; i < 3; i++) y[Y_RING_X + i] = q[i];
    y[Y_RING_BETA] = q[3];
    y[Y_RING_GAMMA] = q[4];
    if (outer_ring_moves(given) || prescribed) join_motion(model, w, y);
    return residual;
}
