// The block Jacobian of the default step, W = M (1 + gamma A + gamma^2 K) with the inertia M, and its
// solution.
//
// Each contact adds B^T C B to M A or M K, where B takes the velocities to the relative velocity that it
// holds back:
//
//   contact                 relative velocity B v                        coefficient C
//   race, traction          slip v + omega x R n - u, u of the race      g (1 - n n^T), g = |traction|/|slip|
//   race, spin (sliced)     omega.n                                      g_spin = moment/spin
//   race, normal            v.n                                          lambda Q; stiffness 3 Q/(2 delta)
//   pocket, friction        each velocity of the ball by itself          D_x ... D_omega_t
//   land, film              v_y + gamma_dot x, v_z - beta_dot x          2 x 2; x: lever of the land
//   land, Couette and dry   spin s                                       film_spin
//   rivets and plates       v_x + z beta_dot - y gamma_dot, half 1 - 0   c; stiffness of what is in touch
//   sticking, hole contact  v_y - s z, v_z + s y, half 1 - 0             stiffness k/(1 + gamma D), k_hole
//   ring support            each velocity of the ring by itself          c; tilts: c_tilt, k_tilt or filter
//
// C is symmetric and not negative, so every block is symmetric positive definite and needs no pivoting.
// Traction has the secant |traction|/|slip| in place of the tangent for that reason; of a concave law it is
// never below the tangent, and too large a rate is safe where too small a one is not (docs/method.md).  Left
// out: the turning of the normals, the films' stiffness, Coriolis and gyroscopic terms, the pockets' coupling
// of ball and cage.
//
// Order of elimination: balls, 6 x 6 each; by their Schur complement the ring, 5 x 5; the halves by
// themselves, their films first, then the joints between them.  The joints' stiffness across the axis is a
// factor of its own, solved before (implicit_shear).  Rolling couples the velocities of a ball as
// strongly as it holds each one back: a diagonal matrix would leave stiff terms outside.
#include "solver/implicit.h"

#include "cage/elastic/elastic_half.h"
#include "numbers/elimination.h"
#include "numbers/octet.h"
#include "physics/rotor.h"

// ---- balls ------------------------------------------------------------------------------------------------

// gamma A of a ball from which its accelerations are damped: there the trapezoidal rule's amplification
// factor (1 - z)/(1 + z) is -1/3, and overshoot begins to matter.
static const double STIFF_LIMIT = 2.0;

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
    add_contact(gamma * wide_load(&w->g_i[j]), normal_i, R, n_i, W);
    add_contact(gamma * wide_load(&w->g_e[j]), normal_e, R, n_e, W);
    if (model->p->scene.traction == TRACTION_SLICED) {
        add_spin(gamma * wide_load(&w->g_spin_i[j]), n_i, W);
        add_spin(gamma * wide_load(&w->g_spin_e[j]), n_e, W);
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

// What remains of the balls in the ring's equations.  The coupling of a ball with the velocity u (x, r, t) of
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
    const wide g = gamma * wide_load(&w->g_i[j]), g_R = g * wide_load(&model->d->R[j]);
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
// what the equations of the ring need of the balls.
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

double implicit_elastic(const Work *w, double gamma, const double *v)
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

// ---- cage halves ------------------------------------------------------------------------------------------

// Velocities of one half.
typedef struct {
    double x, y, z, beta, gamma, s;
} Half;

// A land's film ready to be solved for one body.  The film holds back the velocity u of the land at the lever
// x, u_y = v_y + gamma_dot x and u_z = v_z - beta_dot x.  Because u has two components, the inverse of the
// body's 4 x 4 block needs a 2 x 2 inverse only (Woodbury): with the film matrix C the impulse is
// (C^-1/gamma + 1/m + x^2/J_t)^-1 u = (yy, yz; yz, zz) u.
typedef struct {
    double m, J_p, J_t;  // inertia of the body
    double x;            // lever of the land from the body's centre of mass
    double yy, yz, zz;   // impulse of the film per velocity u that the land would have without it
    double spin;         // gamma A of the spin
} Film;

static Film film(const Work *w, int land, double m, double J_p, double J_t, double x, double gamma)
{
    const double inv_m = 1.0 / m + x * x / J_t;  // of the land against a force there
    const double yy = gamma * w->film_yy[land], yz = gamma * w->film_yz[land], zz = gamma * w->film_zz[land];

    // (1 + gamma C inv_m)^-1 gamma C, by Cramer's rule; it is symmetric.
    const double a = 1.0 + inv_m * yy, b = inv_m * yz, c = 1.0 + inv_m * zz, inv_det = 1.0 / (a * c - b * b);
    const double impulse_yy = (yy * c - yz * b) * inv_det;
    const double impulse_yz = (yz * a - yy * b) * inv_det;
    const double impulse_zz = (zz * a - yz * b) * inv_det;
    return (Film){m, J_p, J_t, x, impulse_yy, impulse_yz, impulse_zz, gamma * w->film_spin[land] / J_p};
}

// v = (1 + gamma A)^-1 v, A of this film.
static void film_solve(const Film *f, Half *v)
{
    const double u_y = v->y + v->gamma * f->x, u_z = v->z - v->beta * f->x;
    const double I_y = f->yy * u_y + f->yz * u_z, I_z = f->yz * u_y + f->zz * u_z;
    v->y -= I_y / f->m;
    v->z -= I_z / f->m;
    v->gamma -= f->x * I_y / f->J_t;
    v->beta += f->x * I_z / f->J_t;
    v->s /= 1.0 + f->spin;
}

static Film film_of_half(const Model *model, const Work *w, int h, double gamma)
{
    const Parameters *p = model->p;
    const double x_land = h == 0 ? -p->cage.land_x : p->cage.land_x;
    return film(w, h, p->cage.m, model->d->J_p, model->d->J_t, x_land - model->d->com_x[h], gamma);
}

static Half half_load(const double *v, int h)
{
    return (Half){.x = v[Y_CAGE_V_X + h],
                  .y = v[Y_CAGE_V_Y + h],
                  .z = v[Y_CAGE_V_Z + h],
                  .beta = v[Y_CAGE_BETA_DOT + h],
                  .gamma = v[Y_CAGE_GAMMA_DOT + h],
                  .s = v[Y_CAGE_S + h]};
}

static void half_store(const Half *half, double *v, int h)
{
    v[Y_CAGE_V_X + h] = half->x, v[Y_CAGE_V_Y + h] = half->y, v[Y_CAGE_V_Z + h] = half->z;
    v[Y_CAGE_BETA_DOT + h] = half->beta, v[Y_CAGE_GAMMA_DOT + h] = half->gamma, v[Y_CAGE_S + h] = half->s;
}

// Weights of a vibration between the halves that turns by x = omega h a step, given x^2: `matrix` multiplies K in the
// matrix, the return value c the position correction.  Both are 1/3 for small x, which makes the frequency exact to
// order four (Fox and Goodwin); for large x they tend to 1.5 and 1.7, which takes 22 % of the amplitude a step:
// what the step cannot resolve dies out (docs/method.md).
static double vibration_weights(double x_2, double *matrix)
{
    const double part = x_2 * x_2 / (x_2 * x_2 + 1.0);
    *matrix = 1.0 / 3.0 + part * (1.5 - 1.0 / 3.0);
    return 1.0 / 3.0 + part * (1.7 - 1.0 / 3.0);
}

// C = sum over the rivets of (gamma c + gamma^2 k) b b^T, b = (1, z, -y): what holds back the axial motion of
// half 1 against half 0, (v_x, beta_dot, gamma_dot).  y, z: place of the rivet, turned with half 0.
static void joint_matrix(const Model *model, const Work *w, double gamma, double C[3][3])
{
    const Derived *d = model->d;
    const Rotor *h0 = &w->half[0];
    const wide zero = wide_set(0.0), k_rivet = wide_set(d->k_rivet), k_plate = wide_set(d->k_plate);
    ball_array rate, rate_y, rate_z, rate_yy, rate_yz, rate_zz;
    for (int k = 0; k < PACKETS * LANE_WIDTH; k += LANE_WIDTH) {
        const wide s_y = wide_load(&d->rivet_y[k]), s_z = wide_load(&d->rivet_z[k]);
        const wide y = s_y * h0->b_y[1] + s_z * h0->b_z[1], z = s_y * h0->b_y[2] + s_z * h0->b_z[2];

        // The rivet is stiff while it is tense, the plates while they are pressed together.
        const wide T = wide_load(&w->T[k]), N_plate = wide_load(&w->N_plate[k]);
        const wide tense = wide_select(wide_above(T, 0.0), k_rivet, zero);
        const wide pressed = wide_select(wide_above(N_plate, 0.0), k_plate, zero);
        const wide damping = d->c_joint * N_plate / (N_plate + model->p->joint.F_floor);
        const wide rate_k = gamma * (damping + gamma * (tense + pressed));
        wide_store(&rate[k], rate_k);
        wide_store(&rate_y[k], rate_k * y);
        wide_store(&rate_z[k], rate_k * z);
        wide_store(&rate_yy[k], rate_k * y * y);
        wide_store(&rate_yz[k], rate_k * y * z);
        wide_store(&rate_zz[k], rate_k * z * z);
    }
    C[0][0] = ball_array_sum(rate);
    C[1][0] = C[0][1] = ball_array_sum(rate_z);
    C[2][0] = C[0][2] = -ball_array_sum(rate_y);
    C[1][1] = ball_array_sum(rate_zz);
    C[2][1] = C[1][2] = -ball_array_sum(rate_yz);
    C[2][2] = ball_array_sum(rate_yy);
}

// Holds back the axial motion of half 1 against half 0, both already held back by their films f.  With dv
// their relative velocity (v_x, beta_dot, gamma_dot) and G its change by unit impulses, again under the
// films, the impulses of the joints are x = C (dv - G x): three equations (1 + C G) x = C dv, the form of
// Woodbury again.  C is multiplied by the weight of the fastest of the three vibrations; returns the position
// correction's weight.
static double solve_joints(const Model *model, const Work *w, double gamma, const Film f[2], Half half[2])
{
    double C[3][3], B[3][3], x[3], weight, G_xx = 0.0, G_bb = 0.0, G_bg = 0.0, G_gg = 0.0;
    joint_matrix(model, w, gamma, C);
    const double tilt = fmax(C[1][1], C[2][2]) / model->d->J_t;
    const double correction = vibration_weights(8.0 * fmax(C[0][0] / model->p->cage.m, tilt), &weight);
    for (int i = 0; i < 9; i++) C[i / 3][i % 3] *= weight;

    // G of both halves; indices b, g: beta, gamma.  A film knows no axial motion.
    for (int h = 0; h < 2; h++) {
        const double lever = f[h].x / f[h].J_t;
        G_xx += 1.0 / f[h].m;
        G_bb += 1.0 / f[h].J_t - lever * lever * f[h].zz;
        G_bg += lever * lever * f[h].yz;
        G_gg += 1.0 / f[h].J_t - lever * lever * f[h].yy;
    }

    // The impulses.
    const double dv[3] = {half[1].x - half[0].x, half[1].beta - half[0].beta, half[1].gamma - half[0].gamma};
    for (int i = 0; i < 3; i++) {
        B[i][0] = (i == 0) + C[i][0] * G_xx;
        B[i][1] = (i == 1) + C[i][1] * G_bb + C[i][2] * G_bg;
        B[i][2] = (i == 2) + C[i][1] * G_bg + C[i][2] * G_gg;
        x[i] = C[i][0] * dv[0] + C[i][1] * dv[1] + C[i][2] * dv[2];
    }
    solve_3(B[0], x);

    // The impulses change the velocities of each half, which its own film holds back again.
    for (int h = 0; h < 2; h++) {
        const double sign = h == 0 ? 1.0 : -1.0;
        const double dx = sign * x[0] / f[h].m;
        const double dbeta = sign * x[1] / f[h].J_t, dgamma = sign * x[2] / f[h].J_t;
        Half change = {.x = dx, .beta = dbeta, .gamma = dgamma};
        film_solve(&f[h], &change);
        half[h].x += change.x, half[h].y += change.y, half[h].z += change.z;
        half[h].beta += change.beta, half[h].gamma += change.gamma;
    }
    return correction;
}

// Stiffness [N/m] across the axis of a packet's joints from k on, as a step of length 2 gamma meets it: sticking plates
// and heads, d(z)/d(v) = gamma/(1 + gamma D) of friction states that decay with D, and holes in which a shank bears.
static wide shear_stiffness(const Model *model, const Work *w, double gamma, int k)
{
    const wide plate = model->d->k_plate_t / (1.0 + gamma * wide_load(&w->plate_rate[k]));
    const wide head = model->d->k_head / (1.0 + gamma * wide_load(&w->head_rate[k]));
    return plate + head + wide_load(&w->k_bearing[k]);
}

// Holds back the motion of half 1 against half 0 across the axis and about it, (v_y, v_z, s): at a rivet at (y, z) its
// velocity is (v_y - s z, v_z + s y).  Weights and result as along the axis.  The impulses are x = C (dv - G x) again,
// C the sum of gamma^2 k over the joints and G = 2 diag(1/m, 1/m, 1/J_p).  Left out is the lever x_c of the joints
// from the centres of mass, 0.2 % of the halves' response.
double implicit_shear(const Model *model, const Work *w, double gamma, double *v)
{
    if (model->p->scene.cage != CAGE_MODEL_TWO_HALF) return 0.0;
    const Derived *d = model->d;
    const Rotor *h0 = &w->half[0];

    // C = (c, 0, -c_z; 0, c, c_y; -c_z, c_y, c_rr).
    ball_array rate, rate_y, rate_z, rate_rr;
    for (int k = 0; k < PACKETS * LANE_WIDTH; k += LANE_WIDTH) {
        const wide s_y = wide_load(&d->rivet_y[k]), s_z = wide_load(&d->rivet_z[k]);
        const wide y = s_y * h0->b_y[1] + s_z * h0->b_z[1], z = s_y * h0->b_y[2] + s_z * h0->b_z[2];
        const wide rate_k = gamma * gamma * shear_stiffness(model, w, gamma, k);
        wide_store(&rate[k], rate_k);
        wide_store(&rate_y[k], rate_k * y);
        wide_store(&rate_z[k], rate_k * z);
        wide_store(&rate_rr[k], rate_k * (y * y + z * z));
    }
    const double m = model->p->cage.m, J_p = d->J_p, G_m = 2.0 / m, G_J = 2.0 / J_p;
    double c = ball_array_sum(rate), c_y = ball_array_sum(rate_y), c_z = ball_array_sum(rate_z);
    double c_rr = ball_array_sum(rate_rr), weight;
    const double correction = vibration_weights(4.0 * fmax(c * G_m, c_rr * G_J), &weight);
    c *= weight, c_y *= weight, c_z *= weight, c_rr *= weight;

    // (1 + C G) x = C dv.
    const double dv_y = v[Y_CAGE_V_Y + 1] - v[Y_CAGE_V_Y], dv_z = v[Y_CAGE_V_Z + 1] - v[Y_CAGE_V_Z];
    const double ds = v[Y_CAGE_S + 1] - v[Y_CAGE_S];
    double B[3][3] = {{1.0 + c * G_m, 0.0, -c_z * G_J},  //
                      {0.0, 1.0 + c * G_m, c_y * G_J},   //
                      {-c_z * G_m, c_y * G_m, 1.0 + c_rr * G_J}};
    double x[3] = {c * dv_y - c_z * ds, c * dv_z + c_y * ds, c_y * dv_z - c_z * dv_y + c_rr * ds};
    solve_3(B[0], x);
    for (int h = 0; h < 2; h++) {
        const double sign = h == 0 ? 1.0 : -1.0;
        v[Y_CAGE_V_Y + h] += sign * x[0] / m;
        v[Y_CAGE_V_Z + h] += sign * x[1] / m;
        v[Y_CAGE_S + h] += sign * x[2] / J_p;
    }
    return correction;
}

// (1 + gamma A + gamma^2 K)^-1 of both halves.  Returns what solve_joints does.
static double solve_halves(const Model *model, const Work *w, double gamma, double *v)
{
    Film f[2];
    Half half[2];
    for (int h = 0; h < 2; h++) {
        half[h] = half_load(v, h);
        f[h] = film_of_half(model, w, h, gamma);
        film_solve(&f[h], &half[h]);
    }
    double correction = 0.0;
    if (model->p->scene.cage == CAGE_MODEL_TWO_HALF) correction = solve_joints(model, w, gamma, f, half);
    for (int h = 0; h < 2; h++) half_store(&half[h], v, h);
    return correction;
}

void implicit_films(const Model *model, const Work *w, double gamma, double *v)
{
    for (int h = 0; h < 2; h++) {
        Half half = half_load(v, h);
        const Film f = film_of_half(model, w, h, gamma);
        film_solve(&f, &half);
        half_store(&half, v, h);
    }
}

static void stiff_part_of_halves(const Model *model, const Work *w, double gamma, double *v)
{
    double kept[N_STATES];
    memcpy(&kept[Y_CAGE_V_X], &v[Y_CAGE_V_X], (Y_RING_V_X - Y_CAGE_V_X) * sizeof *v);
    implicit_films(model, w, gamma, kept);
    for (int i = Y_CAGE_V_X; i < Y_RING_V_X; i++) v[i] -= kept[i];
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

// The ring's stiff rates are those of its support's dampers.  A prescribed tilt follows its filter, whose
// acceleration is not damped further.
static void stiff_part_of_ring(const Model *model, double gamma, double *v)
{
    const Parameters *p = model->p;
    const double support = gamma * p->ring.c / p->ring.m;
    const double tilt = p->ring.tilt_mode == TILT_MODE_SUPPORTED ? gamma * p->ring.c_tilt / p->ring.J_t : 0.0;
    for (int i = 0; i < 3; i++) v[Y_RING_V_X + i] *= support / (1.0 + support);
    v[Y_RING_BETA_DOT] *= tilt / (1.0 + tilt);
    v[Y_RING_GAMMA_DOT] *= tilt / (1.0 + tilt);
}

// ---- all --------------------------------------------------------------------------------------------------

double implicit_solve(const Model *model, const Work *w, double gamma, double *v)
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

    // The cage, which A and K do not couple with the rest.
    return solve_halves(model, w, gamma, v);
}

void implicit_stiff_part(const Model *model, const Work *w, double gamma, double *v)
{
    stiff_part_of_balls(model, w, gamma, v);
    stiff_part_of_halves(model, w, gamma, v);
    stiff_part_of_ring(model, gamma, v);
}
