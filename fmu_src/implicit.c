// The blocks of A, from the results of the right-hand side.
//
//   ball   traction of a race contact holds back its slip: F = -g P (v + omega x R n), M = R n x F, P = 1 - n n^T, g = |traction|/|slip|.
//          In (v, omega): A = sum g B^T P B, B = (1, -R [n]x), over mass and inertia; the pockets' friction enters by its diagonal
//   half   the land film holds back the land's velocity: F = -K (v_y + gamma_dot x, v_z - beta_dot x), K symmetric 2 x 2, x the land's lever;
//          Couette drag and dry friction hold back the spin.  A rigid cage feels both lands with both masses
//   joint  friction states: their own rates
//
// Rolling couples the velocities of a ball as strongly as each is damped, so a diagonal alone leaves stiff terms in the explicit part.
// Scaled by the roots of mass and inertia the blocks are symmetric and positive semidefinite: 1 + gamma A has a Cholesky factor.
#include "implicit.h"

#define AT(i, k) ((i) * ((i) + 1) / 2 + (k))  // row i, column k <= i of a triangle
static const int BALL_ROW[BALL_BLOCK] = {Y_BALL_V_X, Y_BALL_V_R, Y_BALL_OMEGA_M, Y_BALL_OMEGA_X, Y_BALL_OMEGA_R, Y_BALL_OMEGA_T};
static const int HALF_ROW[HALF_BLOCK] = {Y_CAGE_V_Y, Y_CAGE_V_Z, Y_CAGE_BETA_DOT, Y_CAGE_GAMMA_DOT, Y_CAGE_S};

// ---- balls --------------------------------------------------------------------------------------------------------------------------------------
// Adds g B^T P B of one contact; P W = W as W omega = omega x R n lies across n.
INLINE void add_contact(const Derived *d, real g, real R, const real n[3], real A[BALL_TERMS])
{
    const real g_m = g * (1.0 / d->m), g_J = g * R * R * (1.0 / d->J), g_mJ = g * R * (1.0 / sqrt(d->m * d->J));
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k <= i; k++) {
            const real P = (i == k ? 1.0 : 0.0) - n[i] * n[k];
            A[AT(i, k)] += g_m * P;
            A[AT(3 + i, 3 + k)] += g_J * P;
        }
    }
    A[AT(3, 1)] -= g_mJ * n[2];  // (omega x n)_r = omega_t n_x - omega_x n_t, and so on
    A[AT(3, 2)] += g_mJ * n[1];
    A[AT(4, 0)] += g_mJ * n[2];
    A[AT(4, 2)] -= g_mJ * n[0];
    A[AT(5, 0)] -= g_mJ * n[1];
    A[AT(5, 1)] += g_mJ * n[0];
}

static void set_balls(const Model *model, const Work *w, Implicit *A)
{
    const Derived *d = model->d;
    const real root_m = real_set(sqrt(d->m)), root_J = real_set(sqrt(d->J));
    const double *pocket[BALL_BLOCK] = {w->D_x, w->D_r, w->D_t, w->D_omega_x, w->D_omega_r, w->D_omega_t};
    for (int b = 0; b < BUNDLES; b++) {
        const int j = b * LANE_WIDTH;
        const real R = real_load(&d->R[j]), zero = real_set(0.0);
        const real n_i[3] = {real_load(&w->n_ix[j]), real_load(&w->n_ir[j]), real_load(&w->n_it[j])};
        const real n_e[3] = {real_load(&w->n_ex[j]), real_load(&w->n_er[j]), zero};
        real a[BALL_TERMS];
        for (int i = 0; i < BALL_TERMS; i++) a[i] = zero;
        add_contact(d, real_load(&w->g_i[j]), R, n_i, a);
        add_contact(d, real_load(&w->g_e[j]), R, n_e, a);
        for (int i = 0; i < BALL_BLOCK; i++) {
            const real scale = i == 2 ? root_m * real_load(&w->r[j]) : i < 3 ? root_m : root_J;  // omega_m stands for v_t/r
            a[AT(i, i)] += real_load(&pocket[i][j]);
            real_store(&A->ball_scale[i][j], scale);
            real_store(&A->ball_per_scale[i][j], 1.0 / scale);
        }
        for (int i = 0; i < BALL_TERMS; i++) real_store(&A->ball[i][j], a[i]);
    }
    for (int j = 0; j < Z; j++) {
        double trace = 0.0;
        for (int i = 0; i < BALL_BLOCK; i++) trace += A->ball[AT(i, i)][j];
        A->largest = fmax(A->largest, 0.5 * trace);  // the two tangents of a contact share it
    }
}

static void factor_balls(Implicit *A, double gamma)
{
    for (int b = 0; b < BUNDLES; b++) {
        const int j = b * LANE_WIDTH;
        real l[BALL_TERMS];
        for (int i = 0; i < BALL_BLOCK; i++) {
            for (int k = 0; k <= i; k++) {
                real sum = gamma * real_load(&A->ball[AT(i, k)][j]);
                if (i == k) sum += 1.0;
                for (int q = 0; q < k; q++) sum -= l[AT(i, q)] * l[AT(k, q)];
                l[AT(i, k)] = i == k ? 1.0 / real_sqrt(sum) : sum * l[AT(k, k)];
            }
        }
        for (int i = 0; i < BALL_TERMS; i++) real_store(&A->ball_factor[i][j], l[i]);
    }
}

static void add_balls(const Implicit *A, const double *y, const double *y_n, double *f)
{
    lanes rows[BALL_BLOCK];
    for (int i = 0; i < BALL_BLOCK; i++)
        for (int j = 0; j < LANES; j++) rows[i][j] = j < Z ? y[BALL_ROW[i] + j] - y_n[BALL_ROW[i] + j] : 0.0;
    for (int b = 0; b < BUNDLES; b++) {
        const int j = b * LANE_WIDTH;
        real v[BALL_BLOCK];
        for (int i = 0; i < BALL_BLOCK; i++) v[i] = real_load(&rows[i][j]) * real_load(&A->ball_scale[i][j]);
        for (int i = 0; i < BALL_BLOCK; i++) {
            real sum = real_set(0.0);
            for (int k = 0; k < BALL_BLOCK; k++) sum += real_load(&A->ball[i >= k ? AT(i, k) : AT(k, i)][j]) * v[k];
            real_store(&rows[i][j], sum * real_load(&A->ball_per_scale[i][j]));
        }
    }
    for (int i = 0; i < BALL_BLOCK; i++)
        for (int j = 0; j < Z; j++) f[BALL_ROW[i] + j] += rows[i][j];
}

static void solve_balls(const Implicit *A, double *x)
{
    lanes rows[BALL_BLOCK];
    for (int i = 0; i < BALL_BLOCK; i++)
        for (int j = 0; j < LANES; j++) rows[i][j] = j < Z ? x[BALL_ROW[i] + j] : 0.0;
    for (int b = 0; b < BUNDLES; b++) {
        const int j = b * LANE_WIDTH;
        real v[BALL_BLOCK];
        for (int i = 0; i < BALL_BLOCK; i++) {
            v[i] = real_load(&rows[i][j]) * real_load(&A->ball_scale[i][j]);
            for (int k = 0; k < i; k++) v[i] -= real_load(&A->ball_factor[AT(i, k)][j]) * v[k];
            v[i] *= real_load(&A->ball_factor[AT(i, i)][j]);
        }
        for (int i = BALL_BLOCK - 1; i >= 0; i--) {
            for (int k = i + 1; k < BALL_BLOCK; k++) v[i] -= real_load(&A->ball_factor[AT(k, i)][j]) * v[k];
            v[i] *= real_load(&A->ball_factor[AT(i, i)][j]);
            real_store(&rows[i][j], v[i] * real_load(&A->ball_per_scale[i][j]));
        }
    }
    for (int i = 0; i < BALL_BLOCK; i++) memcpy(&x[BALL_ROW[i]], rows[i], Z * sizeof *x);
}

// ---- cage halves --------------------------------------------------------------------------------------------------------------------------------
static void set_halves(const Model *model, const Work *w, Implicit *A)
{
    const Parameters *p = model->p;
    const Derived *d = model->d;
    const bool rigid = p->scene.cage == CAGE_MODEL_RIGID;
    const double m = (rigid ? 2.0 : 1.0) * p->cage.m, J_p = (rigid ? 2.0 : 1.0) * p->cage.J_p;
    const double J_t = rigid ? 2.0 * (p->cage.J_t + p->cage.m * p->cage.x_c * p->cage.x_c) : p->cage.J_t;
    const double scale = sqrt(J_t / m);
    for (int i = 0; i < HALF_BLOCK; i++) {
        A->half_scale[i] = i == 2 || i == 3 ? scale : 1.0;
        A->half_per_scale[i] = 1.0 / A->half_scale[i];
    }
    memset(A->half, 0, sizeof A->half);
    for (int h = 0; h < 2; h++) {
        for (int land = 0; land < 2; land++) {
            if (!rigid && land != h) continue;
            const double x = (land == 0 ? -p->cage.land_x : p->cage.land_x) - (rigid ? 0.0 : d->com_x[h]);
            const double B[2][HALF_BLOCK] = {{1.0, 0.0, 0.0, x / scale, 0.0}, {0.0, 1.0, -x / scale, 0.0, 0.0}};
            const double K[2][2] = {{w->film_yy[land] / m, w->film_yz[land] / m}, {w->film_yz[land] / m, w->film_zz[land] / m}};
            for (int i = 0; i < HALF_BLOCK; i++)
                for (int k = 0; k < HALF_BLOCK; k++)
                    for (int u = 0; u < 2; u++)
                        for (int v = 0; v < 2; v++) A->half[h][i][k] += B[u][i] * K[u][v] * B[v][k];
            A->half[h][4][4] += w->film_spin[land] / J_p;
        }
        double trace = 0.0;
        for (int i = 0; i < HALF_BLOCK; i++) trace += A->half[h][i][i];
        A->largest = fmax(A->largest, trace);
    }
}

static void factor_halves(Implicit *A, double gamma)
{
    for (int h = 0; h < 2; h++) {
        double (*l)[HALF_BLOCK] = A->half_factor[h];
        for (int i = 0; i < HALF_BLOCK; i++) {
            for (int k = 0; k <= i; k++) {
                double sum = (i == k) + gamma * A->half[h][i][k];
                for (int q = 0; q < k; q++) sum -= l[i][q] * l[k][q];
                l[i][k] = i == k ? 1.0 / sqrt(sum) : sum * l[k][k];
            }
        }
    }
}

static void add_halves(const Implicit *A, const double *y, const double *y_n, double *f)
{
    for (int h = 0; h < 2; h++) {
        double v[HALF_BLOCK];
        for (int i = 0; i < HALF_BLOCK; i++) v[i] = (y[HALF_ROW[i] + h] - y_n[HALF_ROW[i] + h]) * A->half_scale[i];
        for (int i = 0; i < HALF_BLOCK; i++) {
            double sum = 0.0;
            for (int k = 0; k < HALF_BLOCK; k++) sum += A->half[h][i][k] * v[k];
            f[HALF_ROW[i] + h] += sum * A->half_per_scale[i];
        }
    }
}

static void solve_halves(const Implicit *A, double *x)
{
    for (int h = 0; h < 2; h++) {
        const double (*l)[HALF_BLOCK] = A->half_factor[h];
        double v[HALF_BLOCK];
        for (int i = 0; i < HALF_BLOCK; i++) {
            v[i] = x[HALF_ROW[i] + h] * A->half_scale[i];
            for (int k = 0; k < i; k++) v[i] -= l[i][k] * v[k];
            v[i] *= l[i][i];
        }
        for (int i = HALF_BLOCK - 1; i >= 0; i--) {
            for (int k = i + 1; k < HALF_BLOCK; k++) v[i] -= l[k][i] * v[k];
            v[i] *= l[i][i];
            x[HALF_ROW[i] + h] = v[i] * A->half_per_scale[i];
        }
    }
}

// ---- friction states of the joints ----------------------------------------------------------------------------------------------------------------
static const int JOINT_ROW[4] = {Y_JOINT_PLATE_Y, Y_JOINT_PLATE_Z, Y_JOINT_HEAD_Y, Y_JOINT_HEAD_Z};

static void set_joints(const Model *model, const Work *w, Implicit *A)
{
    memset(A->plate, 0, sizeof A->plate);
    memset(A->head, 0, sizeof A->head);
    if (model->p->scene.cage == CAGE_MODEL_RIGID) return;
    memcpy(A->plate, w->D_plate, sizeof A->plate);
    memcpy(A->head, w->D_head, sizeof A->head);
    for (int k = 0; k < Z; k++) A->largest = fmax(A->largest, fmax(A->plate[k], A->head[k]));
}

static void add_joints(const Implicit *A, const double *y, const double *y_n, double *f)
{
    for (int row = 0; row < 4; row++) {
        const double *rate = row < 2 ? A->plate : A->head;
        const int at = JOINT_ROW[row];
        for (int k = 0; k < Z; k++) f[at + k] += rate[k] * (y[at + k] - y_n[at + k]);
    }
}

static void solve_joints(const Implicit *A, double *x)
{
    for (int row = 0; row < 4; row++) {
        const double *rate = row < 2 ? A->plate : A->head;
        for (int k = 0; k < Z; k++) x[JOINT_ROW[row] + k] /= 1.0 + A->gamma * rate[k];
    }
}

// ---- all --------------------------------------------------------------------------------------------------------------------------------------------
static void set(const Model *model, const Work *w, Implicit *A)
{
    A->gamma = -1.0;
    A->largest = 0.0;
    set_balls(model, w, A);
    set_halves(model, w, A);
    set_joints(model, w, A);
}

static void add(const Implicit *A, const double *y, const double *y_n, double *f)
{
    add_balls(A, y, y_n, f);
    add_halves(A, y, y_n, f);
    add_joints(A, y, y_n, f);
}

static void solve(Implicit *A, double gamma, double *x)
{
    if (gamma != A->gamma) {
        factor_balls(A, gamma);
        factor_halves(A, gamma);
        A->gamma = gamma;
    }
    solve_balls(A, x);
    solve_halves(A, x);
    solve_joints(A, x);
}

const ImplicitOps implicit_ops = {set, add, solve};
