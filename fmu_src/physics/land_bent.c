// The film of a bent rim in the implicit step.  gamma times the rates of land and rim is a thousand in a stiff gap, so that one linear
// solve at the predicted velocities would leave forces of kilonewtons.  At the places of the step's end, which stay, the film is
// linear in the squeeze velocities V but for its ends, and the gradient of a convex function:
//
//     V = V^ + r + gamma Y (F(V) - F^)     V^, F^: at the evaluation, r: residual with F^, Y: mobilities of land and rim
//
// Newton's method, from the V of the last step, takes one or two iterations.  It ends when its step moves no point of the sums over
// the film's ends, which is exact, or changes V by less than 3 %: what the ends move by then changes F by the square of that.
#include "physics/land_bent.h"

enum { BENT_PACKETS = BENT_POINTS / LANE_WIDTH };

// Points at which the film closes at the squeeze velocities V, a mask a packet.
static void bent_closing(const BentGrid *grid, const double V[SQUEEZE], int closing[BENT_PACKETS])
{
    for (int n = 0; n < BENT_PACKETS; n++) {
        wide b[SQUEEZE];
        for (int i = 0; i < SQUEEZE; i++) b[i] = wide_load(&grid->b[i][n * LANE_WIDTH]);
        closing[n] = wide_mask(wide_above(bent_dot(V, V + 2, b), 0.0));
    }
}

// Forces and rates of the film at the squeeze velocities V, along the half's axes, and the points at which it closes.
static void bent_law(const BentGrid *grid, const double V[SQUEEZE], double F[SQUEEZE],
                     double D[SQUEEZE_TERMS], int closes[BENT_PACKETS])
{
    enum { FORCES = 0, RATES = SQUEEZE, ALL = SQUEEZE + SQUEEZE_TERMS };

    wide sum[EIGHTHS][ALL];
    double total[ALL];
    for (int part = 0; part < EIGHTHS; part++) {
        wide to[ALL];
        for (int n = 0; n < ALL; n++) to[n] = wide_set(0.0);
        for (int n = part; n < BENT_PACKETS; n += EIGHTHS) {
            wide b[SQUEEZE];
            for (int i = 0; i < SQUEEZE; i++) b[i] = wide_load(&grid->b[i][n * LANE_WIDTH]);
            const wide W = bent_dot(V, V + 2, b);
            const bits closing = wide_above(W, 0.0);
            closes[n] = wide_mask(closing);
            if (!closes[n]) continue;
            const wide stiff = wide_load(&grid->stiff[n * LANE_WIDTH]);
            const wide rate = wide_select(closing, stiff, wide_set(0.0)), load = rate * W;
#pragma GCC unroll 6
            for (int i = 0; i < SQUEEZE; i++) {
                const wide by = rate * b[i];
                to[FORCES + i] += load * b[i];
#pragma GCC unroll 6
                for (int k = 0; k <= i; k++)
                    to[RATES + SQUEEZE_AT(i, k)] = wide_fma(by, b[k], to[RATES + SQUEEZE_AT(i, k)]);
            }
        }
        memcpy(sum[part], to, sizeof to);
    }
    wide_column_sums(ALL, ALL, sum[0], total);
    for (int i = 0; i < SQUEEZE; i++) F[i] = -total[FORCES + i];
    memcpy(D, &total[RATES], SQUEEZE_TERMS * sizeof *D);
}

// y = D x of a symmetric matrix.
INLINE void squeeze_times(const double D[SQUEEZE_TERMS], const double x[SQUEEZE], double y[SQUEEZE])
{
    for (int i = 0; i < SQUEEZE; i++) {
        y[i] = 0.0;
        for (int k = 0; k < SQUEEZE; k++) y[i] += D[i < k ? SQUEEZE_AT(k, i) : SQUEEZE_AT(i, k)] * x[k];
    }
}

// Impulse gamma C S (1 + gamma S C S)^-1 S^-1 u of a film of the rates C on land and rim, S^2 their mobilities.
static void squeeze_impulse(const double rate[SQUEEZE_TERMS], double gamma, const double root[SQUEEZE],
                            const double u[SQUEEZE], double impulse[SQUEEZE])
{
    double A[SQUEEZE_TERMS], x[SQUEEZE], inv_D[SQUEEZE];
    for (int i = 0; i < SQUEEZE; i++) {
        x[i] = root[i] > 0.0 ? u[i] / root[i] : 0.0;
        for (int k = 0; k <= i; k++)
            A[SQUEEZE_AT(i, k)] = gamma * root[i] * root[k] * rate[SQUEEZE_AT(i, k)] + (i == k);
    }

    // A = L D L^T, x = A^-1 x
    for (int i = 0; i < SQUEEZE; i++) {
        for (int k = 1; k < i; k++)
            for (int q = 0; q < k; q++) A[SQUEEZE_AT(i, k)] -= A[SQUEEZE_AT(i, q)] * A[SQUEEZE_AT(k, q)];
        for (int k = 0; k < i; k++) {
            const double l = A[SQUEEZE_AT(i, k)] * inv_D[k];
            A[SQUEEZE_AT(i, i)] -= l * A[SQUEEZE_AT(i, k)];
            A[SQUEEZE_AT(i, k)] = l;
            x[i] -= l * x[k];
        }
        inv_D[i] = 1.0 / A[SQUEEZE_AT(i, i)];
    }
    for (int i = SQUEEZE - 1; i >= 0; i--) {
        x[i] *= inv_D[i];
        for (int k = i + 1; k < SQUEEZE; k++) x[i] -= A[SQUEEZE_AT(k, i)] * x[k];
    }
    for (int i = 0; i < SQUEEZE; i++) {
        impulse[i] = 0.0;
        for (int k = 0; k < SQUEEZE; k++)
            impulse[i] += gamma * rate[i < k ? SQUEEZE_AT(k, i) : SQUEEZE_AT(i, k)] * root[k] * x[k];
    }
}

static const int MOST_ITERATIONS = 8;  // of Newton's method on a film that is linear but for its ends
static const double CONVERGED = 3e-2;  // part of the velocities that its last step may change

void bent_solve(const Work *w, int h, double gamma, const double root[SQUEEZE],
                const double residual[SQUEEZE], double V[SQUEEZE], BentSolution *to)
{
    const LandPressure *on = &w->pressure[h];
    const BentGrid *grid = &w->bent[h];
    double start[SQUEEZE], D[SQUEEZE_TERMS], F[SQUEEZE], free[SQUEEZE], round[SQUEEZE_TERMS] = {0.0};
    memcpy(start, on->V, sizeof on->V);
    memcpy(&start[2], on->rim_V, sizeof on->rim_V);
    for (int i = 0; i < 3; i++) round[i] = (1.0 - on->part) * on->round_rate[i];
    for (int i = 0; i < SQUEEZE; i++)
        free[i] = start[i] + residual[i] - gamma * root[i] * root[i] * on->film[i];
    for (int iteration = 0; iteration < MOST_ITERATIONS; iteration++) {
        // the law at the velocities V
        double by_round[SQUEEZE];
        int closed[BENT_PACKETS], closes[BENT_PACKETS];
        bent_law(grid, V, F, D, closed);
        for (int i = 0; i < SQUEEZE; i++) to->change[i] = V[i] - start[i];
        squeeze_times(round, to->change, by_round);
        for (int i = 0; i < SQUEEZE; i++)
            F[i] = on->part * F[i] + (1.0 - on->part) * (i < 2 ? on->round_film[i] : 0.0) - by_round[i];
        for (int i = 0; i < SQUEEZE_TERMS; i++) to->rate[i] = on->part * D[i] + round[i];

        // Newton's step
        double rest[SQUEEZE], impulse[SQUEEZE], step[SQUEEZE], resisted[SQUEEZE], most = 0.0, size = 0.0;
        for (int i = 0; i < SQUEEZE; i++) rest[i] = free[i] + gamma * root[i] * root[i] * F[i] - V[i];
        squeeze_impulse(to->rate, gamma, root, rest, impulse);
        for (int i = 0; i < SQUEEZE; i++) step[i] = rest[i] - root[i] * root[i] * impulse[i];
        squeeze_times(to->rate, step, resisted);
        for (int i = 0; i < SQUEEZE; i++) {
            V[i] += step[i];
            to->change[i] += step[i];
            to->film[i] = F[i] - resisted[i];
            most = fmax(most, fabs(step[i]));
            size = fmax(size, fabs(V[i]));
        }
        if (most <= CONVERGED * size) break;
        bent_closing(grid, V, closes);
        if (memcmp(closed, closes, sizeof closed) == 0) break;  // as linear as the step
    }
    for (int i = 0; i < SQUEEZE; i++) to->impulse[i] = gamma * (on->film[i] - to->film[i]);
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
