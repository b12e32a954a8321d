// The block Jacobian of the default step, W = M (1 + gamma A + gamma^2 K) with the inertia M, and its
// solution.
//
// Each contact adds B^T C B to M A or M K, where the matrix B of the contact gives the relative velocity
// that the contact resists:
//
//   contact                 relative velocity B v                        coefficient C
//   race, traction          slip v + omega x R n - u, u of the race      g (1 - n n^T), g = 1.4 |traction|/|slip|
//   race, spin (sliced)     omega.n                                      g_spin = 1.4 moment/spin
//   race, normal            v.n                                          lambda Q; stiffness 3 Q/(2 delta)
//   pocket, friction        each velocity of the ball by itself          D_x ... D_omega_t
//   ring support            each velocity of the ring by itself          c; tilts: c_tilt, k_tilt or filter
//
// C is symmetric and not negative, so every block is symmetric positive definite and needs no pivoting.
// Traction has the secant |traction|/|slip| in place of the tangent for that reason; of a concave law it is
// never below the tangent, and too large a rate is safe where too small a one is not (docs/method.md).  Left
// out: the turning of the normals, Coriolis and gyroscopic terms, the pockets' coupling of ball and cage.  So A and K do
// not couple the halves of the cage with balls and ring: their blocks are the cage's own (cage_end).
//
// Order of elimination: balls, 6 x 6 each; by their Schur complement the ring, 5 x 5.  Rolling couples the velocities of
// a ball as strongly as it resists each one: a diagonal matrix would leave stiff terms outside.
#include "solver/implicit.h"

#include "numbers/elimination.h"
#include "numbers/vec.h"

// ---- balls ------------------------------------------------------------------------------------------------

// gamma A of a ball from which its accelerations are damped: there the trapezoidal rule's amplification
// factor (1 - z)/(1 + z) is -1/3, and overshoot begins to matter.
static const double STIFF_LIMIT = 2.0;

// Traction's rates g in A / the secants |traction|/|slip| of the evaluation.  At a predictor on the flat branch of the law the
// secant is below the slope on the way back, and too small a rate rings (docs/method.md).
static const double TRACTION_MARGIN = 1.4;

// Least approach in the stiffness 3 Q/(2 delta) [m]: no division by 0.
static const double APPROACH_FLOOR = 1e-12;

// A symmetric 6 x 6 matrix of the velocities (v, omega) of a packet's balls is stored as its lower triangle.
// AT: place of row i, column k <= i.
enum { BLOCK = 6, TERMS = BLOCK * (BLOCK + 1) / 2 };

#define AT(i, k) ((i) * ((i) + 1) / 2 + (k))

// Adds B^T (g (1 - n n^T) + normal n n^T) B, where B = (1, -R [n]x) gives the velocity v + omega x R n of the
// ball's surface at its contact.
INLINE void add_contact(wide g, wide normal, wide R, const wide n[3], wide W[TERMS])
{
    const wide g_R = g * R, g_RR = g_R * R;

    // Diagonal blocks: of v all of it, of omega the tangential part times R^2.
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k <= i; k++) {
            const wide nn = n[i] * n[k];
            W[AT(i, k)] = wide_fma(normal - g, nn, W[AT(i, k)]);
            W[AT(3 + i, 3 + k)] = wide_fma(-g_RR, nn, W[AT(3 + i, 3 + k)]);
        }
        W[AT(i, i)] += g;
        W[AT(3 + i, 3 + i)] += g_RR;
    }

    // Block of omega and v: g R [n]x, because n x n = 0.
    W[AT(3, 1)] = wide_fma(-g_R, n[2], W[AT(3, 1)]);
    W[AT(3, 2)] = wide_fma(g_R, n[1], W[AT(3, 2)]);
    W[AT(4, 0)] = wide_fma(g_R, n[2], W[AT(4, 0)]);
    W[AT(4, 2)] = wide_fma(-g_R, n[0], W[AT(4, 2)]);
    W[AT(5, 0)] = wide_fma(-g_R, n[1], W[AT(5, 0)]);
    W[AT(5, 1)] = wide_fma(g_R, n[0], W[AT(5, 1)]);
}

// Adds g_spin n n^T to the block of the angular velocities.
INLINE void add_spin(wide g_spin, const wide n[3], wide W[TERMS])
{
    for (int i = 0; i < 3; i++)
        for (int k = 0; k <= i; k++) W[AT(3 + i, 3 + k)] = wide_fma(g_spin * n[i], n[k], W[AT(3 + i, 3 + k)]);
}

// Factors L D L^T of a symmetric positive definite matrix: L below the diagonal, 1/D.
typedef struct {
    wide L[TERMS], inv_D[BLOCK];
} Factors;

// Factors n matrices; on entry each is in L.  A factorization and a substitution are chains in which each
// number waits for the one before, so that several packets take little longer than one.
INLINE void factor_blocks(int n, Factors f[])
{
    for (int i = 0; i < BLOCK; i++) {
        // Row i of L D, column by column; then of L.
        for (int k = 1; k < i; k++)
            for (int q = 0; q < k; q++)
                for (int p = 0; p < n; p++)
                    f[p].L[AT(i, k)] = wide_fma(-f[p].L[AT(i, q)], f[p].L[AT(k, q)], f[p].L[AT(i, k)]);
        for (int k = 0; k < i; k++)
            for (int p = 0; p < n; p++) {
                wide *L = f[p].L;
                const wide l = L[AT(i, k)] * f[p].inv_D[k];
                L[AT(i, i)] = wide_fma(-l, L[AT(i, k)], L[AT(i, i)]);
                L[AT(i, k)] = l;
            }
        for (int p = 0; p < n; p++) f[p].inv_D[i] = 1.0 / f[p].L[AT(i, i)];
    }
}

// x = W^-1 x of each: forward and backward substitution.
INLINE void solve_blocks(int n, const Factors f[], wide x[][BLOCK])
{
    for (int i = 1; i < BLOCK; i++)
        for (int k = 0; k < i; k++)
            for (int p = 0; p < n; p++) x[p][i] = wide_fma(-f[p].L[AT(i, k)], x[p][k], x[p][i]);
    for (int i = BLOCK - 1; i >= 0; i--) {
        for (int p = 0; p < n; p++) x[p][i] *= f[p].inv_D[i];
        for (int k = i + 1; k < BLOCK; k++)
            for (int p = 0; p < n; p++) x[p][i] = wide_fma(-f[p].L[AT(k, i)], x[p][k], x[p][i]);
    }
}

// Stiffness 3 Q/(2 delta) of a race contact.
INLINE wide normal_stiffness(wide Q, wide delta)
{
    const wide stiffness = 1.5 * Q / wide_max(delta, wide_set(APPROACH_FLOOR));
    return wide_select(wide_above(delta, 0.0), stiffness, wide_set(0.0));
}

// gamma lambda Q + gamma^2 3 Q/(2 delta) of a race contact: damping and stiffness of its normal force.
INLINE wide normal_term(const Model *model, double gamma, wide Q, wide delta)
{
    return gamma * (model->p->bearing.lambda * Q + gamma * normal_stiffness(Q, delta));
}

// W of a packet of balls.  normal_forces: with damping and stiffness of the race contacts' normal forces, or
// friction alone.
INLINE void packet_matrix(const Model *model, const Work *w, int j, double gamma, bool normal_forces,
                          wide W[TERMS])
{
    const Derived *d = model->d;
    const double *pocket[BLOCK] = {w->D_x, w->D_r, w->D_t, w->D_omega_x, w->D_omega_r, w->D_omega_t};
    const wide R = wide_load(&d->R[j]), zero = wide_set(0.0);
    const wide n_i[3] = {wide_load(&w->n_ix[j]), wide_load(&w->n_ir[j]), wide_load(&w->n_it[j])};
    const wide n_e[3] = {wide_load(&w->n_ex[j]), wide_load(&w->n_er[j]), zero};
    for (int i = 0; i < TERMS; i++) W[i] = zero;

    // Race contacts: traction and normal force; spin where traction is resolved over the ellipse.
    wide normal_i = zero, normal_e = zero;
    if (normal_forces) {
        normal_i = normal_term(model, gamma, wide_load(&w->Q_i[j]), wide_load(&w->delta_i[j]));
        normal_e = normal_term(model, gamma, wide_load(&w->Q_e[j]), wide_load(&w->delta_e[j]));
    }
    const double g = gamma * TRACTION_MARGIN;
    add_contact(g * wide_load(&w->g_i[j]), normal_i, R, n_i, W);
    add_contact(g * wide_load(&w->g_e[j]), normal_e, R, n_e, W);
    if (model->p->scene.traction == TRACTION_SLICED) {
        add_spin(g * wide_load(&w->g_spin_i[j]), n_i, W);
        add_spin(g * wide_load(&w->g_spin_e[j]), n_e, W);
    }

    // Inertia, and the diagonal of the pockets' friction.
    for (int i = 0; i < BLOCK; i++) {
        const double inertia = i < 3 ? d->m : d->J;
        W[AT(i, i)] += (gamma * inertia) * wide_load(&pocket[i][j]) + inertia;
    }
}

// gamma A of each ball of a packet as one number: half the trace of A, because each contact acts along two
// tangents.
INLINE wide packet_rate(const Model *model, const Work *w, int j, double gamma)
{
    const Derived *d = model->d;
    const double *pocket[BLOCK] = {w->D_x, w->D_r, w->D_t, w->D_omega_x, w->D_omega_r, w->D_omega_t};
    const wide R = wide_load(&d->R[j]);
    wide sum = (1.0 / d->m + R * R / d->J) * (wide_load(&w->g_i[j]) + wide_load(&w->g_e[j]));
    for (int i = 0; i < BLOCK; i++) sum += 0.5 * wide_load(&pocket[i][j]);
    return gamma * sum;
}

// The balls' velocities out of the rows of the state and back; padding lanes are 0.
static const int BALL_ROW[BLOCK] = {Y_BALL_V_X,     Y_BALL_V_R,     Y_BALL_OMEGA_M,
                                    Y_BALL_OMEGA_X, Y_BALL_OMEGA_R, Y_BALL_OMEGA_T};

static void load_balls(const double *v, ball_array rows[BLOCK])
{
    for (int i = 0; i < BLOCK; i++) {
        memset(&rows[i][LANES - 8], 0, 8 * sizeof(double));
        memcpy(rows[i], &v[BALL_ROW[i]], Z * sizeof *v);
    }
}

static void store_balls(ball_array rows[BLOCK], double *v)
{
    for (int i = 0; i < BLOCK; i++) memcpy(&v[BALL_ROW[i]], rows[i], Z * sizeof *v);
}

// x = W^-1 M v of n packets, of the first balls `at`; v in rows.  On entry W is in f, on return its factors.
// The state's third velocity is the orbital speed, the matrix has v_t = r omega_m.
INLINE void solve_packets(const Model *model, const Work *w, int n, const int at[], Factors f[],
                          ball_array rows[BLOCK], wide x[][BLOCK])
{
    const double m = model->d->m, J = model->d->J;
    for (int p = 0; p < n; p++) {
        for (int i = 0; i < BLOCK; i++) x[p][i] = wide_load(&rows[i][at[p]]) * (i < 3 ? m : J);
        x[p][2] *= wide_load(&w->r[at[p]]);
    }
    factor_blocks(n, f);
    solve_blocks(n, f, x);
    for (int p = 0; p < n; p++) x[p][2] /= wide_load(&w->r[at[p]]);
}

// Schur complement of the balls in the ring's equations.  The coupling of a ball with the velocity u (x, r, t) of
// the race at its inner contact is G = B^T gamma g (1 - n n^T), 6 x 3, and the ball's equations are
// W x - G u = M v.  Eliminated, x = W^-1 M v + W^-1 G u, and the ring feels the impulse schur_rhs - schur u.
typedef struct {
    ball_array dv_du[BLOCK][3];  // W^-1 G
    ball_array schur[3][3];      // gamma g (1 - n n^T) - G^T W^-1 G
    ball_array schur_rhs[3];     // G^T W^-1 M v
} Coupling;

// x: W^-1 M v of the packet.
INLINE void couple_packet(const Model *model, const Work *w, int j, double gamma, const Factors *f,
                          const wide x[BLOCK], Coupling *c)
{
    const wide n[3] = {wide_load(&w->n_ix[j]), wide_load(&w->n_ir[j]), wide_load(&w->n_it[j])};
    const wide g = gamma * TRACTION_MARGIN * wide_load(&w->g_i[j]), g_R = g * wide_load(&model->d->R[j]);
    const wide r = wide_load(&w->r[j]), zero = wide_set(0.0);

    // Columns of G: force gamma g (1 - n n^T) e_k and moment gamma g R n x e_k.
    const wide moment[3][3] = {
        {zero, g_R * n[2], -g_R * n[1]}, {-g_R * n[2], zero, g_R * n[0]}, {g_R * n[1], -g_R * n[0], zero}};
    wide G[3][BLOCK];
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < 3; i++) {
            G[k][i] = (i == k ? g : zero) - g * n[i] * n[k];
            G[k][3 + i] = moment[k][i];
        }

    for (int k = 0; k < 3; k++) {
        // y = W^-1 G e_k.
        wide solved[1][BLOCK], *y = solved[0];
        memcpy(y, G[k], sizeof solved);
        solve_blocks(1, f, solved);

        // G^T W^-1 M v; the third velocity of x is an orbital speed.
        wide schur_rhs = G[k][2] * (r * x[2]);
        for (int i = 0; i < BLOCK; i++)
            if (i != 2) schur_rhs += G[k][i] * x[i];
        wide_store(&c->schur_rhs[k][j], schur_rhs);

        // gamma g (1 - n n^T) - G^T W^-1 G, symmetric.
        for (int q = 0; q <= k; q++) {
            wide schur = G[k][q];
            for (int i = 0; i < 3; i++) {
                schur -= G[q][i] * y[i];
                schur -= G[q][3 + i] * y[3 + i];
            }
            wide_store(&c->schur[q][k][j], schur);
            wide_store(&c->schur[k][q][j], schur);
        }

        // W^-1 G in the state's velocities.
        y[2] /= r;
        for (int i = 0; i < BLOCK; i++) wide_store(&c->dv_du[i][k][j], y[i]);
    }
}

// Solves W x = M v for all balls; rows holds v, then x.  Where the ring is coupled (c is not NULL), c receives
// the Schur complement of the balls in the equations of the ring.
static void solve_balls(const Model *model, const Work *w, double gamma, ball_array rows[BLOCK], Coupling *c)
{
    Factors f[PACKETS];
    wide x[PACKETS][BLOCK];
    int at[PACKETS];
    for (int p = 0; p < PACKETS; p++) {
        at[p] = p * LANE_WIDTH;
        packet_matrix(model, w, at[p], gamma, true, f[p].L);
    }
    solve_packets(model, w, PACKETS, at, f, rows, x);
    for (int p = 0; p < PACKETS; p++) {
        if (c != NULL) couple_packet(model, w, at[p], gamma, &f[p], x[p], c);
        for (int i = 0; i < BLOCK; i++) wide_store(&rows[i][at[p]], x[p][i]);
    }
}

// v - W^-1 M v of the balls that are stiff, friction alone; 0 of the others.
static void stiff_part_of_balls(const Model *model, const Work *w, double gamma, double *v)
{
    ball_array rows[BLOCK];
    load_balls(v, rows);
    for (int j = 0; j < PACKETS * LANE_WIDTH; j += LANE_WIDTH) {
        const bits stiff = wide_above(packet_rate(model, w, j, gamma), STIFF_LIMIT);
        if (!wide_any(stiff)) {
            for (int i = 0; i < BLOCK; i++) wide_store(&rows[i][j], wide_set(0.0));
            continue;
        }
        Factors f;
        wide x[1][BLOCK];
        packet_matrix(model, w, j, gamma, false, f.L);
        solve_packets(model, w, 1, &j, &f, rows, x);
        for (int i = 0; i < BLOCK; i++) {
            const wide taken = wide_load(&rows[i][j]) - x[0][i];
            wide_store(&rows[i][j], wide_select(stiff, taken, wide_set(0.0)));
        }
    }
    store_balls(rows, v);
}

double implicit_spring_power(const Work *w, double gamma, const double *v)
{
    ball_array rows[BLOCK], power;
    load_balls(v, rows);
    for (int j = 0; j < PACKETS * LANE_WIDTH; j += LANE_WIDTH) {
        const wide x = wide_load(&rows[0][j]), r = wide_load(&rows[1][j]);
        const wide t = wide_load(&rows[2][j]) * wide_load(&w->r[j]);
        const wide in = wide_load(&w->n_ix[j]) * x + wide_load(&w->n_ir[j]) * r + wide_load(&w->n_it[j]) * t;
        const wide out = wide_load(&w->n_ex[j]) * x + wide_load(&w->n_er[j]) * r;
        const wide k_i = normal_stiffness(wide_load(&w->Q_i[j]), wide_load(&w->delta_i[j]));
        const wide k_e = normal_stiffness(wide_load(&w->Q_e[j]), wide_load(&w->delta_e[j]));
        wide_store(&power[j], gamma * (k_i * in * in + k_e * out * out));
    }
    return ball_array_sum(power);
}

// ---- ring -------------------------------------------------------------------------------------------------

enum { RING = BODY_DOF };  // velocities of the ring: v_x, v_y, v_z, beta_dot, gamma_dot

// gamma A of the ring by traction from which ring and balls are solved together.  Below, the ring takes the
// traction explicitly, which saves three substitutions a ball and is stable up to gamma A = 1/2; at 0.2 the
// method's spurious root is -0.29 (docs/method.md).
static const double COUPLING_LIMIT = 0.2;

// gamma A + gamma^2 K of each velocity of the ring by its support: damper of the translation; spring and
// damper of the tilts, or the critically damped filter beta'' = (beta_shaft - beta)/tau^2 - 2 beta'/tau that
// prescribes them.
static void ring_support(const Model *model, double gamma, double support[RING])
{
    const Parameters *p = model->p;
    const double rate = gamma / p->ring.tilt_time;
    const double spring = gamma * (p->ring.c_tilt + gamma * p->ring.k_tilt) / p->ring.J_t;
    double tilt = 0.0;
    if (p->ring.tilt_mode == TILT_MODE_PRESCRIBED) tilt = 2.0 * rate + rate * rate;
    if (p->ring.tilt_mode == TILT_MODE_SUPPORTED) tilt = spring;
    for (int i = 0; i < RING; i++) support[i] = i < 3 ? gamma * p->ring.c / p->ring.m : tilt;
}

// Whether the traction of all inner contacts is much for the ring's mass, or for its tilts at the pitch
// radius r.  A ring whose motion is prescribed moves the balls, but no force moves it.
static bool ring_coupled(const Model *model, const Work *w, double gamma)
{
    const Parameters *p = model->p;
    if (p->ring.motion == RING_MOTION_PRESCRIBED) return false;
    const double rate = gamma * ball_array_sum(w->g_i), r = 0.5 * p->bearing.d_m;
    const bool tilts = p->ring.tilt_mode != TILT_MODE_PRESCRIBED;
    return rate > COUPLING_LIMIT * p->ring.m || (tilts && rate * r * r > COUPLING_LIMIT * p->ring.J_t);
}

// D: velocity (x, r, t) of the race at ball j's contact per velocity of the ring, for small tilts of the
// ring.
static void race_motion(const Model *model, const Work *w, int j, double D[3][RING])
{
    const double R = model->d->R[j];
    const double x = w->x[j] + R * w->n_ix[j], r = w->r[j] + R * w->n_ir[j], t = R * w->n_it[j];
    const double c = w->cos_theta[j], s = w->sin_theta[j];
    const double axes[2][3] = {{0.0, c, -s}, {0.0, s, c}};  // Y and Z in the ball's frame
    memset(D, 0, 3 * RING * sizeof(double));
    D[0][0] = 1.0;
    for (int i = 0; i < 2; i++) {
        const double *axis = axes[i];
        for (int k = 0; k < 3; k++) D[k][1 + i] = axis[k];
        D[0][3 + i] = axis[1] * t - axis[2] * r;  // axis x contact
        D[1][3 + i] = axis[2] * x;
        D[2][3 + i] = -axis[1] * x;
    }
}

// Solves the ring's velocities V with the Schur complement of all balls, then gives each ball its part.
static void solve_coupled_ring(const Model *model, const Work *w, const double support[RING],
                               const Coupling *c, ball_array rows[BLOCK], double V[RING])
{
    // A prescribed tilt moves the balls, but no force moves it: its rows keep the support alone.
    const int moved = model->p->ring.tilt_mode == TILT_MODE_PRESCRIBED ? 3 : RING;

    // S V = M V + sum D^T schur_rhs,  S = M (1 + support) + sum D^T schur D.
    double D[Z][3][RING], S[RING][RING] = {0};
    for (int i = 0; i < RING; i++) {
        const double inertia = i < 3 ? model->p->ring.m : model->p->ring.J_t;
        V[i] *= inertia;
        S[i][i] = inertia * (1.0 + support[i]);
    }
    for (int j = 0; j < Z; j++) {
        race_motion(model, w, j, D[j]);
        for (int k = 0; k < 3; k++)
            for (int i = 0; i < moved; i++) {
                V[i] += D[j][k][i] * c->schur_rhs[k][j];
                for (int q = 0; q < 3; q++)
                    for (int e = 0; e < RING; e++) S[i][e] += D[j][k][i] * c->schur[k][q][j] * D[j][q][e];
            }
    }
    eliminate(S, V);

    // Back substitution: the balls' velocities change by W^-1 G u, u = D V.
    for (int j = 0; j < Z; j++)
        for (int k = 0; k < 3; k++) {
            double u = 0.0;
            for (int i = 0; i < RING; i++) u += D[j][k][i] * V[i];
            for (int i = 0; i < BLOCK; i++) rows[i][j] += c->dv_du[i][k][j] * u;
        }
}

// ---- all --------------------------------------------------------------------------------------------------

void implicit_solve(const Model *model, const Work *w, double gamma, double *v)
{
    ball_array rows[BLOCK];
    Coupling coupling;
    double support[RING], *V = &v[Y_RING_V_X];

    // Balls, then the ring with their Schur complement, or by itself where traction hardly holds it back.
    const bool coupled = ring_coupled(model, w, gamma);
    load_balls(v, rows);
    solve_balls(model, w, gamma, rows, coupled ? &coupling : NULL);
    ring_support(model, gamma, support);
    if (coupled)
        solve_coupled_ring(model, w, support, &coupling, rows, V);
    else
        for (int i = 0; i < RING; i++) V[i] /= 1.0 + support[i];
    store_balls(rows, v);
}

void implicit_ring_wrench(const Model *model, double gamma, const double *delta, Work *w)
{
    const bool sliced = model->p->scene.traction == TRACTION_SLICED;
    double v_ring[3] = {0.0},
           turn[3] = {0.0};  // stay 0 where the balls' equations have the ring's predicted velocities
    ball_array rows[BLOCK], change[6];
    if (ring_coupled(model, w, gamma)) {
        const double *V = &delta[Y_RING_V_X];
        memcpy(v_ring, V, sizeof v_ring);
        turn[1] = V[3], turn[2] = V[4];
    }
    load_balls(delta, rows);
    for (int j = 0; j < PACKETS * LANE_WIDTH; j += LANE_WIDTH) {
        const wide c = wide_load(&w->cos_theta[j]), s = wide_load(&w->sin_theta[j]);
        const vec n = vec_load(&w->n_ix[j], &w->n_ir[j], &w->n_it[j]);
        const vec arm = vec_scale(wide_load(&model->d->R[j]), n);
        const vec v = {wide_load(&rows[0][j]), wide_load(&rows[1][j]),
                       wide_load(&rows[2][j]) * wide_load(&w->r[j])};
        const vec omega = vec_load(&rows[3][j], &rows[4][j], &rows[5][j]);
        const vec ball = {wide_load(&w->x[j]), wide_load(&w->r[j]), wide_set(0.0)};
        const vec place = vec_add(vec_sub(ball, vec_local(w->ring.x, c, s)), arm);

        // change of the slip, and the wrench on the ring that resists it
        const vec race =
            vec_add(vec_local(v_ring, c, s), vec_cross(vec_local(turn, c, s), vec_add(ball, arm)));
        const vec slip = vec_across(vec_sub(vec_add(v, vec_cross(omega, arm)), race), n);
        const wide normal = normal_term(model, gamma, wide_load(&w->Q_i[j]), wide_load(&w->delta_i[j]));
        const vec F = vec_axpy(normal * (1.0 / gamma) * vec_dot(v, n), n,
                               vec_scale(TRACTION_MARGIN * wide_load(&w->g_i[j]), slip));
        const wide spin =
            sliced ? TRACTION_MARGIN * wide_load(&w->g_spin_i[j]) * vec_dot(omega, n) : wide_set(0.0);
        const vec M = vec_axpy(spin, n, vec_cross(place, F));
        vec_to_global(F, c, s, &change[0][j], &change[1][j], &change[2][j]);
        vec_to_global(M, c, s, &change[3][j], &change[4][j], &change[5][j]);
    }
    for (int i = 0; i < 3; i++) {
        w->ring.F[i] += ball_array_sum(change[i]);
        w->ring.M[i] += ball_array_sum(change[3 + i]);
    }
}

// The ring's stiff rates are those of its support's dampers.  A prescribed tilt follows its filter, whose
// acceleration is not damped further.
void implicit_stiff_part(const Model *model, const Work *w, double gamma, double *v)
{
    const Parameters *p = model->p;
    const double support = gamma * p->ring.c / p->ring.m;
    const double tilt = p->ring.tilt_mode == TILT_MODE_SUPPORTED ? gamma * p->ring.c_tilt / p->ring.J_t : 0.0;
    stiff_part_of_balls(model, w, gamma, v);
    for (int i = 0; i < 3; i++) v[Y_RING_V_X + i] *= support / (1.0 + support);
    v[Y_RING_BETA_DOT] *= tilt / (1.0 + tilt);
    v[Y_RING_GAMMA_DOT] *= tilt / (1.0 + tilt);
}
