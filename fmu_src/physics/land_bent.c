// The film of a bent rim in the implicit step.  gamma times the rates of land and rim is a thousand in a stiff gap, so that one linear
// solve at the predicted velocities would leave forces of kilonewtons.  At the places of the step's end, which stay, the film is
// linear in the squeeze velocities V but for its ends, and the gradient of a convex function:
//
//     V = V^ + r + gamma Y (F(V) - F^)     V^, F^: at the evaluation, r: residual with F^, Y: mobilities of land and rim
//
// Newton's method, from the V of the last step, takes one or two iterations.  It ends when its step moves no point of the sums over
// the film's ends, which is exact, or changes V by less than 3 %: what the ends move by then changes F by the square of that.
#include "physics/land_bent.h"

enum {
    BENT_PACKETS = BENT_POINTS / LANE_WIDTH,
    ROW = 8,
    WAVE_SUMS = 16
};  // 13 waves; both in packets of eight

// Points at which the film closes at the squeeze velocities V, a mask a packet.
static void bent_closing(const BentGrid *grid, const double V[SQUEEZE], int closing[BENT_PACKETS])
{
    for (int n = 0; n < BENT_PACKETS; n++) {
        wide b[SQUEEZE];
        for (int i = 0; i < SQUEEZE; i++) b[i] = wide_load(&grid->b[i][n * LANE_WIDTH]);
        closing[n] = wide_mask(wide_above(bent_dot(V, V + 2, b), 0.0));
    }
}

// A law of land and rim, linear about the squeeze velocities: forces along the half's axes, rates in rows of eight for packets.
typedef struct {
    double F[SQUEEZE], rate[SQUEEZE][ROW];
} SqueezeLaw;

INLINE void row_scale(double times, double row[ROW])
{
    for (int k = 0; k < ROW; k += LANE_WIDTH) wide_store(&row[k], times * wide_load(&row[k]));
}

INLINE void row_add(double times, const double row[ROW], double to[ROW])
{
    for (int k = 0; k < ROW; k += LANE_WIDTH)
        wide_store(&to[k], wide_load(&to[k]) + times * wide_load(&row[k]));
}

// The rates times x, subtracted from F.
static void take_rates(const SqueezeLaw *law, const double x[SQUEEZE], double F[SQUEEZE])
{
    double sum[ROW] = {0.0};
    for (int i = 0; i < SQUEEZE; i++) row_add(x[i], law->rate[i], sum);
    for (int i = 0; i < SQUEEZE; i++) F[i] -= sum[i];
}

// Adds a packet's rates times half of 1, cos theta, sin theta ... cos 6 theta, sin 6 theta.
INLINE void add_waves(wide rate, const wide b[SQUEEZE], wide to[WAVE_SUMS])
{
    const wide half = 0.5 * rate, by_c_3 = half * b[4], by_s_3 = half * b[5];
    const wide by_c_2 = half * b[2], by_s_2 = half * b[3];
    to[0] += half;
    for (int i = 0; i < 2; i++) to[1 + i] = wide_fma(half, b[i], to[1 + i]);
    to[3] += by_c_2, to[4] += by_s_2;
    to[5] += by_c_3, to[6] += by_s_3;
    to[7] += by_c_2 * b[2] - by_s_2 * b[3];
    to[8] = wide_fma(2.0 * by_c_2, b[3], to[8]);
    to[9] += by_c_3 * b[2] - by_s_3 * b[3];
    to[10] += by_s_3 * b[2] + by_c_3 * b[3];
    to[11] += by_c_3 * b[4] - by_s_3 * b[5];
    to[12] = wide_fma(2.0 * by_c_3, b[5], to[12]);
}

// Rates of the shapes cos p theta and sin p theta by those cosines C and sines S: 2 cos p cos q = cos (p - q) + cos (p + q) ...
static void rates_of_waves(const double sum[WAVE_SUMS], double rate[SQUEEZE][ROW])
{
    double C[7], S[7] = {0.0};
    C[0] = sum[0];
    for (int m = 1; m <= 6; m++) C[m] = sum[2 * m - 1], S[m] = sum[2 * m];
#pragma GCC unroll 3
    for (int p = 1; p <= 3; p++) {
#pragma GCC unroll 3
        for (int q = 1; q <= p; q++) {
            const int i = 2 * p - 2, k = 2 * q - 2;
            rate[i][k] = rate[k][i] = C[p - q] + C[p + q];
            rate[i + 1][k + 1] = rate[k + 1][i + 1] = C[p - q] - C[p + q];
            rate[i][k + 1] = rate[k + 1][i] = S[p + q] - S[p - q];
            rate[i + 1][k] = rate[k][i + 1] = S[p + q] + S[p - q];
        }
    }
    for (int i = 0; i < SQUEEZE; i++)
        for (int k = SQUEEZE; k < ROW; k++) rate[i][k] = 0.0;
}

// That of the film at the squeeze velocities V, F = -D V, and the points at which the film closes.
static void bent_law(const BentGrid *grid, const double V[SQUEEZE], SqueezeLaw *law, int closes[BENT_PACKETS])
{
    wide sum[EIGHTHS][WAVE_SUMS];
    double total[WAVE_SUMS];
    for (int part = 0; part < EIGHTHS; part++) {
        wide to[WAVE_SUMS];
        for (int i = 0; i < WAVE_SUMS; i++) to[i] = wide_set(0.0);
        for (int n = part; n < BENT_PACKETS; n += EIGHTHS) {
            wide b[SQUEEZE];
            for (int i = 0; i < SQUEEZE; i++) b[i] = wide_load(&grid->b[i][n * LANE_WIDTH]);
            const bits closing = wide_above(bent_dot(V, V + 2, b), 0.0);
            closes[n] = wide_mask(closing);
            if (!closes[n]) continue;
            add_waves(wide_select(closing, wide_load(&grid->stiff[n * LANE_WIDTH]), wide_set(0.0)), b, to);
        }
        memcpy(sum[part], to, sizeof to);
    }
    wide_column_sums(WAVE_SUMS, WAVE_SUMS, sum[0], total);
    rates_of_waves(total, law->rate);
    memset(law->F, 0, sizeof law->F);
    take_rates(law, V, law->F);
}

// The bent film by the part that bends the rim, the round one by the rest: it has forces and rates of the land alone.
static void add_round(const LandPressure *on, const double change[SQUEEZE], SqueezeLaw *law)
{
    const double part = on->part, rest = 1.0 - on->part, *rate = on->round_rate;
    for (int i = 0; i < SQUEEZE; i++) {
        law->F[i] *= part;
        row_scale(part, law->rate[i]);
    }
    for (int i = 0; i < 2; i++) {
        law->F[i] += rest * (on->round_film[i] - (rate[i] * change[0] + rate[i + 1] * change[1]));
        for (int k = 0; k < 2; k++) law->rate[i][k] += rest * rate[i + k];
    }
}

// x of (1 + gamma Y D) x = u, D: the rates.  D is symmetric and not negative, nor is the diagonal Y: Gauss's pivots are at least 1.
static void squeeze_solve(const SqueezeLaw *law, const double by[SQUEEZE], const double u[SQUEEZE],
                          double x[SQUEEZE])
{
    double A[SQUEEZE][ROW];  // and u
    for (int i = 0; i < SQUEEZE; i++) {
        memcpy(A[i], law->rate[i], sizeof A[i]);
        row_scale(by[i], A[i]);
        A[i][i] += 1.0;
        A[i][SQUEEZE] = u[i];
    }
#pragma GCC unroll 6
    for (int i = 0; i < SQUEEZE; i++) {
        row_scale(1.0 / A[i][i], A[i]);
#pragma GCC unroll 6
        for (int j = 0; j < SQUEEZE; j++)
            if (j != i) row_add(-A[j][i], A[i], A[j]);
    }
    for (int i = 0; i < SQUEEZE; i++) x[i] = A[i][SQUEEZE];
}

static const int MOST_ITERATIONS = 8;  // of Newton's method on a film that is linear but for its ends
static const double CONVERGED = 3e-2;  // part of the velocities that its last step may change

void bent_solve(const Work *w, int h, double gamma, const double mobility[SQUEEZE],
                const double residual[SQUEEZE], double V[SQUEEZE], BentSolution *to)
{
    const LandPressure *on = &w->pressure[h];
    const BentGrid *grid = &w->bent[h];
    double start[SQUEEZE], by[SQUEEZE], free[SQUEEZE];
    SqueezeLaw law;
    memcpy(start, on->V, sizeof on->V);
    memcpy(&start[2], on->rim_V, sizeof on->rim_V);
    for (int i = 0; i < SQUEEZE; i++) {
        by[i] = gamma * mobility[i];
        free[i] = start[i] + residual[i] - by[i] * on->film[i];
        to->change[i] = V[i] - start[i];
    }
    for (int iteration = 0; iteration < MOST_ITERATIONS; iteration++) {
        int closed[BENT_PACKETS], closes[BENT_PACKETS];
        double rest[SQUEEZE], step[SQUEEZE], most = 0.0, size = 0.0;
        bent_law(grid, V, &law, closed);
        add_round(on, to->change, &law);
        for (int i = 0; i < SQUEEZE; i++) rest[i] = free[i] + by[i] * law.F[i] - V[i];
        squeeze_solve(&law, by, rest, step);
        take_rates(&law, step, law.F);
        for (int i = 0; i < SQUEEZE; i++) {
            V[i] += step[i];
            to->change[i] += step[i];
            most = scalar_max(most, fabs(step[i]));
            size = scalar_max(size, fabs(V[i]));
        }
        if (most <= CONVERGED * size) break;
        bent_closing(grid, V, closes);
        if (memcmp(closed, closes, sizeof closed) == 0) break;  // as linear as the step
    }
    for (int i = 0; i < SQUEEZE; i++) {
        to->film[i] = law.F[i];
        to->impulse[i] = gamma * (on->film[i] - law.F[i]);
    }
    for (int i = 0; i < 2; i++)
        for (int k = 0; k <= i; k++) to->rate[i + k] = law.rate[i][k];
}

double bent_arrive(double gamma, const BentSolution solved[2], Work *w)
{
    double power = 0.0;
    for (int h = 0; h < 2; h++) {
        if (!land_is_bent(w, h)) continue;
        const Rotor *half = &w->half[h];
        LandPressure *on = &w->pressure[h];
        LandFilm *film = &w->film[h];
        const double *change = solved[h].change;
        double T[2][2] = {{half->b_y[1], half->b_y[2]}, {half->b_z[1], half->b_z[2]}};
        for (int i = 0; i < SQUEEZE; i++) {
            const double v = i < 2 ? on->v[i] : on->rim_v[i - 2];
            power += solved[h].film[i] * (v + change[i]) - on->film[i] * v;
            on->film[i] = solved[h].film[i];
        }
        for (int i = 0; i < 2; i++) {
            power -= change[i] * solved[h].impulse[i] / gamma;
            on->V[i] += change[i];
        }
        for (int i = 0; i < RIM; i++) on->rim_V[i] += change[2 + i];
        double rate[3];
        turn_rates(T, solved[h].rate, rate);
        film->yy = rate[0], film->yz = rate[1], film->zz = rate[2];
    }
    return power;
}
