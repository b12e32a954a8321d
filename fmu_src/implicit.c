// What holds back velocities, in blocks:
//
//   ball    traction of a race contact holds back its slip: F = -g P (v + omega x R n), M = R n x F, P = 1 - n n^T, g = |traction|/|slip|;
//           sliced traction the spin about n by its moment; its normal force the approach, with rate lambda Q and stiffness 3 Q/(2 delta) along n; the pockets'
//           friction by its diagonal
//   race    the inner contacts' traction couples the ring to all balls: where that is much for its mass (slow or mixed), through each ball's
//           inverse (race_couple), else each for itself
//   half    the film holds back the land's velocity: F = -C (v_y + gamma_dot x, v_z - beta_dot x), C symmetric 2 x 2, x the land's lever;
//           Couette drag and dry friction hold back the spin; plates and rivets the axial motion of one half against the other
//   ring    its support
//
// Rolling couples the velocities of a ball as strongly as each is damped, so a diagonal alone would leave stiff terms outside.
#include "implicit.h"

#include "elimination.h"
#include "rotor.h"

// ---- balls --------------------------------------------------------------------------------------------------------------------------------------
static const double STIFF_LIMIT = 2.0;  // gamma A of a ball from which trapezoidal steps overshoot: (1 - z)/(1 + z) < -1/3
enum { BLOCK = 6, TERMS = BLOCK * (BLOCK + 1) / 2 };
#define AT(i, k) ((i) * ((i) + 1) / 2 + (k))  // row i, column k <= i of a triangle

// Adds B^T (g P + normal n n^T) B, B = (1, -R [n]x).
INLINE void add_contact(wide g, wide normal, wide R, const wide n[3], wide A[TERMS])
{
    const wide g_R = g * R, g_RR = g_R * R;
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k <= i; k++) {
            const wide nn = n[i] * n[k];
            A[AT(i, k)] = wide_fma(normal - g, nn, A[AT(i, k)]);
            A[AT(3 + i, 3 + k)] = wide_fma(-g_RR, nn, A[AT(3 + i, 3 + k)]);
        }
        A[AT(i, i)] += g;
        A[AT(3 + i, 3 + i)] += g_RR;
    }
    A[AT(3, 1)] = wide_fma(-g_R, n[2], A[AT(3, 1)]);  // (omega x n)_r = omega_t n_x - omega_x n_t, and so on
    A[AT(3, 2)] = wide_fma(g_R, n[1], A[AT(3, 2)]);
    A[AT(4, 0)] = wide_fma(g_R, n[2], A[AT(4, 0)]);
    A[AT(4, 2)] = wide_fma(-g_R, n[0], A[AT(4, 2)]);
    A[AT(5, 0)] = wide_fma(-g_R, n[1], A[AT(5, 0)]);
    A[AT(5, 1)] = wide_fma(g_R, n[0], A[AT(5, 1)]);
}

typedef struct {
    wide A[TERMS], inv_D[BLOCK];  // factors L, D of a symmetric positive definite matrix, 1/D
} Factors;

INLINE void factor_block(Factors *f)
{
    wide *A = f->A;
    for (int i = 0; i < BLOCK; i++) {
        for (int k = 1; k < i; k++)
            for (int q = 0; q < k; q++) A[AT(i, k)] = wide_fma(-A[AT(i, q)], A[AT(k, q)], A[AT(i, k)]);
        for (int k = 0; k < i; k++) {
            const wide l = A[AT(i, k)] * f->inv_D[k];
            A[AT(i, i)] = wide_fma(-l, A[AT(i, k)], A[AT(i, i)]);
            A[AT(i, k)] = l;
        }
        f->inv_D[i] = 1.0 / A[AT(i, i)];
    }
}

// x = A^-1 x.
INLINE void solve_block(const Factors *f, wide x[BLOCK])
{
    for (int i = 1; i < BLOCK; i++)
        for (int k = 0; k < i; k++) x[i] = wide_fma(-f->A[AT(i, k)], x[k], x[i]);
    for (int i = BLOCK - 1; i >= 0; i--) {
        x[i] *= f->inv_D[i];
        for (int k = i + 1; k < BLOCK; k++) x[i] = wide_fma(-f->A[AT(k, i)], x[k], x[i]);
    }
}

// Adds g_spin n n^T to the angular velocities.
INLINE void add_spin(wide g_spin, const wide n[3], wide A[TERMS])
{
    for (int i = 0; i < 3; i++)
        for (int k = 0; k <= i; k++) A[AT(3 + i, 3 + k)] = wide_fma(g_spin * n[i], n[k], A[AT(3 + i, 3 + k)]);
}

// gamma lambda Q + gamma^2 3 Q/(2 delta) of a race contact.
INLINE wide normal_rate(const Model *model, double gamma, wide Q, wide delta)
{
    const wide k = wide_select(wide_above(delta, 0.0), 1.5 * Q / wide_max(delta, wide_set(1e-12)), wide_set(0.0));
    return gamma * (model->p->bearing.lambda * Q + gamma * k);
}

// M (1 + gamma A + gamma^2 K) of one packet, with lambda Q and K of the normal forces only if asked for.
INLINE void packet_matrix(const Model *model, const Work *w, int j, double gamma, bool stiff, wide A[TERMS])
{
    const Derived *d = model->d;
    const double *pocket[BLOCK] = {w->D_x, w->D_r, w->D_t, w->D_omega_x, w->D_omega_r, w->D_omega_t};
    const wide R = wide_load(&d->R[j]), zero = wide_set(0.0);
    const wide n_i[3] = {wide_load(&w->n_ix[j]), wide_load(&w->n_ir[j]), wide_load(&w->n_it[j])};
    const wide n_e[3] = {wide_load(&w->n_ex[j]), wide_load(&w->n_er[j]), zero};
    const wide normal_i = stiff ? normal_rate(model, gamma, wide_load(&w->Q_i[j]), wide_load(&w->delta_i[j])) : zero;
    const wide normal_e = stiff ? normal_rate(model, gamma, wide_load(&w->Q_e[j]), wide_load(&w->delta_e[j])) : zero;
    for (int i = 0; i < TERMS; i++) A[i] = zero;
    add_contact(gamma * wide_load(&w->g_i[j]), normal_i, R, n_i, A);
    add_contact(gamma * wide_load(&w->g_e[j]), normal_e, R, n_e, A);
    if (model->p->scene.traction == TRACTION_SLICED) {
        add_spin(gamma * wide_load(&w->g_spin_i[j]), n_i, A);
        add_spin(gamma * wide_load(&w->g_spin_e[j]), n_e, A);
    }
    for (int i = 0; i < BLOCK; i++) {
        const double inertia = i < 3 ? d->m : d->J;
        A[AT(i, i)] += (gamma * inertia) * wide_load(&pocket[i][j]) + inertia;
    }
}

// gamma A's trace / 2: the two tangents of a contact share it.
INLINE wide packet_rate(const Model *model, const Work *w, int j, double gamma)
{
    const Derived *d = model->d;
    const double *pocket[BLOCK] = {w->D_x, w->D_r, w->D_t, w->D_omega_x, w->D_omega_r, w->D_omega_t};
    const wide R = wide_load(&d->R[j]);
    wide sum = (1.0 / d->m + R * R / d->J) * (wide_load(&w->g_i[j]) + wide_load(&w->g_e[j]));
    for (int i = 0; i < BLOCK; i++) sum += 0.5 * wide_load(&pocket[i][j]);
    return gamma * sum;
}

static const int BALL_ROW[BLOCK] = {Y_BALL_V_X, Y_BALL_V_R, Y_BALL_OMEGA_M, Y_BALL_OMEGA_X, Y_BALL_OMEGA_R, Y_BALL_OMEGA_T};

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

// x = A^-1 M x of one packet of rows.
INLINE void solve_packet(const Model *model, const Work *w, int j, Factors *f, ball_array rows[BLOCK], wide x[BLOCK])
{
    const double m = model->d->m, J = model->d->J;
    const wide r = wide_load(&w->r[j]);
    for (int i = 0; i < BLOCK; i++) x[i] = wide_load(&rows[i][j]) * (i < 3 ? m : J);
    x[2] *= r;  // v_t = r omega_m
    factor_block(f);
    solve_block(f, x);
    x[2] /= r;
}

// A moving race carries the balls with it: at its speed u [m/s] at the inner contact (x, r, t) ball velocities change by dv_du u, and the ring
// feels the impulse schur_rhs - schur u, where schur_rhs is what the balls' own velocities bring.
typedef struct {
    ball_array dv_du[BLOCK][3], schur[3][3], schur_rhs[3];
} Coupling;

INLINE void couple_packet(const Model *model, const Work *w, int j, double gamma, const Factors *f, const wide x[BLOCK], Coupling *c)
{
    const wide g = gamma * wide_load(&w->g_i[j]), r = wide_load(&w->r[j]), n[3] = {wide_load(&w->n_ix[j]), wide_load(&w->n_ir[j]), wide_load(&w->n_it[j])};
    const wide g_R = g * wide_load(&model->d->R[j]), zero = wide_set(0.0);
    const wide turn[3][3] = {{zero, -g_R * n[2], g_R * n[1]}, {g_R * n[2], zero, -g_R * n[0]}, {-g_R * n[1], g_R * n[0], zero}};  // R n x
    for (int k = 0; k < 3; k++) {
        wide column[BLOCK], y[BLOCK];
        for (int i = 0; i < 3; i++) {
            column[i] = (i == k ? g : zero) - g * n[i] * n[k];
            column[3 + i] = turn[i][k];
        }
        memcpy(y, column, sizeof y);
        solve_block(f, y);
        wide schur_rhs = column[2] * (r * x[2]);
        for (int i = 0; i < BLOCK; i++)
            if (i != 2) schur_rhs += column[i] * x[i];
        wide_store(&c->schur_rhs[k][j], schur_rhs);
        for (int q = 0; q <= k; q++) {
            // schur = g P - column_q.A^-1 column_k, symmetric
            wide schur = (q == k ? g : zero) - g * n[q] * n[k];
            for (int i = 0; i < 3; i++) {
                schur -= ((i == q ? g : zero) - g * n[i] * n[q]) * y[i];
                schur -= turn[i][q] * y[3 + i];
            }
            wide_store(&c->schur[q][k][j], schur);
            wide_store(&c->schur[k][q][j], schur);
        }
        y[2] /= r;
        for (int i = 0; i < BLOCK; i++) wide_store(&c->dv_du[i][k][j], y[i]);
    }
}

// c: only where the ring is coupled.
static void solve_balls(const Model *model, const Work *w, double gamma, ball_array rows[BLOCK], Coupling *c)
{
    for (int j = 0; j < PACKETS * LANE_WIDTH; j += LANE_WIDTH) {
        Factors f;
        wide x[BLOCK];
        packet_matrix(model, w, j, gamma, true, f.A);
        solve_packet(model, w, j, &f, rows, x);
        if (c != NULL) couple_packet(model, w, j, gamma, &f, x, c);
        for (int i = 0; i < BLOCK; i++) wide_store(&rows[i][j], x[i]);
    }
}

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
        wide x[BLOCK];
        packet_matrix(model, w, j, gamma, false, f.A);
        solve_packet(model, w, j, &f, rows, x);
        for (int i = 0; i < BLOCK; i++) wide_store(&rows[i][j], wide_select(stiff, wide_load(&rows[i][j]) - x[i], wide_set(0.0)));
    }
    store_balls(rows, v);
}

// ---- cage halves --------------------------------------------------------------------------------------------------------------------------------
typedef struct {
    double x, y, z, beta, gamma, s;
} Half;  // velocities of one half

typedef struct {
    double m, J_p, J_t, x, yy, yz, zz, spin;
} Film;  // body and lever of a land; what it feels is held back by (1/gamma C^-1 + 1/m + x^2/J_t)^-1, its spin by 1/(1 + spin)

static Film film(const Work *w, int land, double m, double J_p, double J_t, double x, double gamma)
{
    const double inv_m = 1.0 / m + x * x / J_t, yy = gamma * w->film_yy[land], yz = gamma * w->film_yz[land], zz = gamma * w->film_zz[land];
    const double a = 1.0 + inv_m * yy, b = inv_m * yz, c = 1.0 + inv_m * zz, inv_det = 1.0 / (a * c - b * b);
    return (Film){m, J_p, J_t, x, (yy * c - yz * b) * inv_det, (yz * a - yy * b) * inv_det, (zz * a - yz * b) * inv_det, gamma * w->film_spin[land] / J_p};
}

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

// Lands that act on half h: one, or both on a rigid cage.  Returns their number.
static int films(const Model *model, const Work *w, int h, double gamma, Film f[2])
{
    const Parameters *p = model->p;
    const double m = p->cage.m, J_p = p->cage.J_p, J_t = p->cage.J_t, x_c = p->cage.x_c;
    if (p->scene.cage == CAGE_MODEL_TWO_HALF) {
        f[0] = film(w, h, m, J_p, J_t, (h == 0 ? -p->cage.land_x : p->cage.land_x) - model->d->com_x[h], gamma);
        return 1;
    }
    for (int land = 0; land < 2; land++)
        f[land] = film(w, land, 2.0 * m, 2.0 * J_p, 2.0 * (J_t + m * x_c * x_c), land == 0 ? -p->cage.land_x : p->cage.land_x, gamma);
    return 2;
}

static Half half_load(const double *v, int h)
{
    return (Half){v[Y_CAGE_V_X + h], v[Y_CAGE_V_Y + h], v[Y_CAGE_V_Z + h], v[Y_CAGE_BETA_DOT + h], v[Y_CAGE_GAMMA_DOT + h], v[Y_CAGE_S + h]};
}

static void half_store(const Half *half, double *v, int h)
{
    v[Y_CAGE_V_X + h] = half->x, v[Y_CAGE_V_Y + h] = half->y, v[Y_CAGE_V_Z + h] = half->z;
    v[Y_CAGE_BETA_DOT + h] = half->beta, v[Y_CAGE_GAMMA_DOT + h] = half->gamma, v[Y_CAGE_S + h] = half->s;
}

// Sum over rivets of (gamma c + gamma^2 k) b b^T, b = (1, z, -y): what holds back v_x, beta_dot, gamma_dot of half 1 against half 0.
static void joint_matrix(const Model *model, const Work *w, double gamma, double A[3][3])
{
    const Derived *d = model->d;
    const Rotor *h0 = &w->half[0];
    ball_array rate, rate_y, rate_z, rate_yy, rate_yz, rate_zz;
    const wide zero = wide_set(0.0);
    for (int k = 0; k < PACKETS * LANE_WIDTH; k += LANE_WIDTH) {
        const wide T = wide_load(&w->T[k]), N_plate = wide_load(&w->N_plate[k]), s_y = wide_load(&d->rivet_y[k]), s_z = wide_load(&d->rivet_z[k]);
        const wide y = s_y * h0->b_y[1] + s_z * h0->b_z[1], z = s_y * h0->b_y[2] + s_z * h0->b_z[2];
        const wide stiffness = wide_select(wide_above(T, 0.0), wide_set(d->k_rivet), zero) + wide_select(wide_above(N_plate, 0.0), wide_set(d->k_plate), zero);
        const wide rate_k = gamma * (d->c_joint * N_plate / (N_plate + model->p->joint.F_floor) + gamma * stiffness);
        wide_store(&rate[k], rate_k);
        wide_store(&rate_y[k], rate_k * y);
        wide_store(&rate_z[k], rate_k * z);
        wide_store(&rate_yy[k], rate_k * y * y);
        wide_store(&rate_yz[k], rate_k * y * z);
        wide_store(&rate_zz[k], rate_k * z * z);
    }
    A[0][0] = ball_array_sum(rate), A[1][0] = A[0][1] = ball_array_sum(rate_z), A[2][0] = A[0][2] = -ball_array_sum(rate_y);
    A[1][1] = ball_array_sum(rate_zz), A[2][1] = A[1][2] = -ball_array_sum(rate_yz), A[2][2] = ball_array_sum(rate_yy);
}

// x = B^-1 x by Cramer's rule.
static void solve_3(double B[3][3], double x[3])
{
    double minor[3][3], out[3];
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++) {
            const int a = (i + 1) % 3, b = (i + 2) % 3, c = (k + 1) % 3, e = (k + 2) % 3;
            minor[i][k] = B[a][c] * B[b][e] - B[a][e] * B[b][c];
        }
    const double inv_det = 1.0 / (B[0][0] * minor[0][0] + B[0][1] * minor[0][1] + B[0][2] * minor[0][2]);
    for (int i = 0; i < 3; i++) out[i] = (minor[0][i] * x[0] + minor[1][i] * x[1] + minor[2][i] * x[2]) * inv_det;
    memcpy(x, out, sizeof out);
}

// Impulses x of the joints: (1 + A G) x = A dv, dv their velocities without, G what they feel of both halves held by their films.
static void solve_joints(const Model *model, const Work *w, double gamma, const Film f[2], Half half[2])
{
    double A[3][3], B[3][3], x[3], G_xx = 0.0, G_bb = 0.0, G_bg = 0.0, G_gg = 0.0;
    joint_matrix(model, w, gamma, A);
    for (int h = 0; h < 2; h++) {
        const double lever = f[h].x / f[h].J_t;
        G_xx += 1.0 / f[h].m;
        G_bb += 1.0 / f[h].J_t - lever * lever * f[h].zz;
        G_bg += lever * lever * f[h].yz;
        G_gg += 1.0 / f[h].J_t - lever * lever * f[h].yy;
    }
    const double dv[3] = {half[1].x - half[0].x, half[1].beta - half[0].beta, half[1].gamma - half[0].gamma};
    for (int i = 0; i < 3; i++) {
        B[i][0] = (i == 0) + A[i][0] * G_xx;
        B[i][1] = (i == 1) + A[i][1] * G_bb + A[i][2] * G_bg;
        B[i][2] = (i == 2) + A[i][1] * G_bg + A[i][2] * G_gg;
        x[i] = A[i][0] * dv[0] + A[i][1] * dv[1] + A[i][2] * dv[2];
    }
    solve_3(B, x);
    for (int h = 0; h < 2; h++) {
        const double sign = h == 0 ? 1.0 : -1.0;
        Half change = {sign * x[0] / f[h].m, 0.0, 0.0, sign * x[1] / f[h].J_t, sign * x[2] / f[h].J_t, 0.0};
        film_solve(&f[h], &change);
        half[h].x += change.x, half[h].y += change.y, half[h].z += change.z, half[h].beta += change.beta, half[h].gamma += change.gamma;
    }
}

static void solve_halves(const Model *model, const Work *w, double gamma, double *v)
{
    Film f[2][2];
    Half half[2];
    for (int h = 0; h < 2; h++) {
        half[h] = half_load(v, h);
        const int count = films(model, w, h, gamma, f[h]);
        for (int land = 0; land < count; land++) film_solve(&f[h][land], &half[h]);
    }
    if (model->p->scene.cage == CAGE_MODEL_TWO_HALF) solve_joints(model, w, gamma, (Film[2]){f[0][0], f[1][0]}, half);
    for (int h = 0; h < 2; h++) half_store(&half[h], v, h);
}

void implicit_films(const Model *model, const Work *w, double gamma, double *v)
{
    for (int h = 0; h < 2; h++) {
        Film f[2];
        Half half = half_load(v, h);
        const int count = films(model, w, h, gamma, f);
        for (int land = 0; land < count; land++) film_solve(&f[land], &half);
        half_store(&half, v, h);
    }
}

static void stiff_part_of_halves(const Model *model, const Work *w, double gamma, double *v)
{
    double left[N_STATES];
    memcpy(&left[Y_CAGE_V_X], &v[Y_CAGE_V_X], (Y_RING_V_X - Y_CAGE_V_X) * sizeof *v);
    implicit_films(model, w, gamma, left);
    for (int i = Y_CAGE_V_X; i < Y_RING_V_X; i++) v[i] -= left[i];
}

// ---- ring -----------------------------------------------------------------------------------------------------------------------------------------
enum { RING = RING_DOF };                  // velocities of the ring: v_x, v_y, v_z, beta_dot, gamma_dot
static const double COUPLING_LIMIT = 0.2;  // gamma A of the ring by traction from which it is coupled to the balls

// What holds back each velocity of the ring by itself: gamma A + gamma^2 K of support and tilt.
static void ring_support(const Model *model, double gamma, double support[RING])
{
    const Parameters *p = model->p;
    const double rate = gamma / p->ring.tilt_time;
    double tilt = 0.0;
    if (p->ring.tilt_mode == TILT_MODE_PRESCRIBED) tilt = 2.0 * rate + rate * rate;
    if (p->ring.tilt_mode == TILT_MODE_SUPPORTED) tilt = gamma * (p->ring.c_tilt + gamma * p->ring.k_tilt) / p->ring.J_t;
    for (int i = 0; i < RING; i++) support[i] = i < 3 ? gamma * p->ring.c / p->ring.m : tilt;
}

static bool ring_coupled(const Model *model, const Work *w, double gamma)
{
    const Parameters *p = model->p;
    const double rate = gamma * ball_array_sum(w->g_i), r = 0.5 * p->bearing.d_m;
    return rate > COUPLING_LIMIT * p->ring.m || (p->ring.tilt_mode != TILT_MODE_PRESCRIBED && rate * r * r > COUPLING_LIMIT * p->ring.J_t);
}

// Velocity (x, r, t) of the race at ball j's contact by each velocity of the ring.
static void race_motion(const Model *model, const Work *w, int j, double D[3][RING])
{
    const double R = model->d->R[j], x = w->x[j] + R * w->n_ix[j], r = w->r[j] + R * w->n_ir[j], t = R * w->n_it[j];
    const double c = w->cos_theta[j], s = w->sin_theta[j];
    const double axes[2][3] = {{0.0, c, -s}, {0.0, s, c}};  // Y and Z
    memset(D, 0, 3 * RING * sizeof(double));
    D[0][0] = 1.0;
    for (int i = 0; i < 2; i++) {
        const double *axis = axes[i];
        for (int k = 0; k < 3; k++) D[k][1 + i] = axis[k];
        D[0][3 + i] = axis[1] * t - axis[2] * r;
        D[1][3 + i] = axis[2] * x;
        D[2][3 + i] = -axis[1] * x;
    }
}

// The ring's velocities V under the balls' schur_rhs and schur, then what V gives the balls.
static void race_couple(const Model *model, const Work *w, const double support[RING], const Coupling *c, ball_array rows[BLOCK], double V[RING])
{
    const int moved = model->p->ring.tilt_mode == TILT_MODE_PRESCRIBED ? 3 : RING;  // velocities that forces change
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
    for (int j = 0; j < Z; j++)
        for (int k = 0; k < 3; k++) {
            double u = 0.0;
            for (int i = 0; i < RING; i++) u += D[j][k][i] * V[i];
            for (int i = 0; i < BLOCK; i++) rows[i][j] += c->dv_du[i][k][j] * u;
        }
}

static void stiff_part_of_ring(const Model *model, double gamma, double *v)
{
    const Parameters *p = model->p;
    const double support = gamma * p->ring.c / p->ring.m, tilt = p->ring.tilt_mode == TILT_MODE_SUPPORTED ? gamma * p->ring.c_tilt / p->ring.J_t : 0.0;
    for (int i = 0; i < 3; i++) v[Y_RING_V_X + i] *= support / (1.0 + support);
    v[Y_RING_BETA_DOT] *= tilt / (1.0 + tilt);
    v[Y_RING_GAMMA_DOT] *= tilt / (1.0 + tilt);
}

// ---- all --------------------------------------------------------------------------------------------------------------------------------------------
void implicit_solve(const Model *model, const Work *w, double gamma, double *v)
{
    ball_array rows[BLOCK];
    Coupling coupling;
    double support[RING], *V = &v[Y_RING_V_X];
    const bool coupled = ring_coupled(model, w, gamma);
    load_balls(v, rows);
    solve_balls(model, w, gamma, rows, coupled ? &coupling : NULL);
    ring_support(model, gamma, support);
    if (coupled)
        race_couple(model, w, support, &coupling, rows, V);
    else
        for (int i = 0; i < RING; i++) V[i] /= 1.0 + support[i];
    store_balls(rows, v);
    solve_halves(model, w, gamma, v);
}

void implicit_stiff_part(const Model *model, const Work *w, double gamma, double *v)
{
    stiff_part_of_balls(model, w, gamma, v);
    stiff_part_of_halves(model, w, gamma, v);
    stiff_part_of_ring(model, gamma, v);
}
