// The film of a bent rim in the implicit step.  gamma times the rates of land and rim is a thousand in a stiff gap, so that one linear
// solve at the predicted velocities would leave forces of kilonewtons.  At the places of the step's end, which stay, the film is
// linear in the squeeze velocities V but for its ends, and F the gradient of a concave function -Psi:
//
//     V = V^ + r + gamma Y (F(V) - F^)     V^, F^: at the evaluation, r: residual with F^, Y: mobilities of land and rim
//
// V minimizes the convex sum of (V - free)^2/(2 gamma Y) and Psi(V), free = V^ + r - gamma Y F^.  Newton's method takes one or two
// iterations: from the evaluation, whose law is known, or, if the film's ends move, from the V of the last step.  The
// iteration ends when the points of the sums that its step moves over the film's ends carry less than 1 % of F.  Where a closed gap
// makes gamma Y D a million, steps would run to and fro over the ends: from the third on they are as long as the sum falls.
//
// In a closed gap F(V^) would be a thousand kilonewtons too.  Y omits second-order tilt terms (1e-5 of F), which would remain as an error.
// And asperities bear a part of F, whose friction is no part of the solution: with that of F(V^), land losses of slow cages in mixed
// lubrication erred by up to 35 %.  In both cases the evaluation has therefore the film at the V of the end, as far as the film alone
// decides V: V = V^ + gamma Y (F(V) - F_n), because V^ has felt the force F_n of the step's start twice as long.
#include "physics/land_bent.h"

enum { BENT_PACKETS = BENT_POINTS / LANE_WIDTH };

// A law of land and rim, linear about the squeeze velocities: forces along the half's axes, rates in rows of eight for packets.
typedef struct {
    double F[SQUEEZE], rate[SQUEEZE][SQUEEZE_ROW];
} SqueezeLaw;

// The rates times x, subtracted from F.
static void take_rates(const SqueezeLaw *law, const double x[SQUEEZE], double F[SQUEEZE])
{
    double sum[SQUEEZE_ROW] = {0.0};
    for (int i = 0; i < SQUEEZE; i++) row_add(x[i], law->rate[i], sum);
    for (int i = 0; i < SQUEEZE; i++) F[i] -= sum[i];
}

// Rates of the shapes cos p theta and sin p theta by those cosines C and sines S: 2 cos p cos q = cos (p - q) + cos (p + q) ...
static void rates_of_waves(const double sum[BENT_WAVES], double rate[SQUEEZE][SQUEEZE_ROW])
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
        for (int k = SQUEEZE; k < SQUEEZE_ROW; k++) rate[i][k] = 0.0;
}

// Law of the film at the squeeze velocities V, F = -D V.
static void bent_law(const BentGrid *grid, const double V[SQUEEZE], SqueezeLaw *law)
{
    enum { OCTETS = (BENT_WAVES + 7) / 8 * 8 };

    wide sum[EIGHTHS][OCTETS];
    double total[OCTETS];
    for (int part = 0; part < EIGHTHS; part++) {
        wide to[OCTETS];
        for (int i = 0; i < OCTETS; i++) to[i] = wide_set(0.0);
        for (int n = part; n < BENT_PACKETS; n += EIGHTHS) {
            wide b[SQUEEZE];
            for (int i = 0; i < SQUEEZE; i++) b[i] = wide_load(&grid->b[i][n * LANE_WIDTH]);
            const bits closing = wide_above(bent_dot(V, V + 2, b), 0.0);
            if (!wide_any(closing)) continue;
            add_waves(wide_select(closing, wide_load(&grid->stiff[n * LANE_WIDTH]), wide_set(0.0)), b, to);
        }
        memcpy(sum[part], to, sizeof to);
    }
    wide_column_sums(OCTETS, OCTETS, sum[0], total);
    rates_of_waves(total, law->rate);
    memset(law->F, 0, sizeof law->F);
    take_rates(law, V, law->F);
}

// x of (1 + gamma Y D) x = u, D: the rates.  D is symmetric and not negative, nor is the diagonal Y: Gauss's pivots are at least 1.
static void squeeze_solve(const SqueezeLaw *law, const double by[SQUEEZE], const double u[SQUEEZE],
                          double x[SQUEEZE])
{
    double A[SQUEEZE][SQUEEZE_ROW];  // and u
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

// V = free + by F(V): by = gamma Y; start: V at the evaluation.
typedef struct {
    const BentGrid *grid;
    const double *by;
    double start[SQUEEZE], free[SQUEEZE];
} Squeeze;

static Squeeze squeeze_of(const Work *w, int h)
{
    const LandPressure *pressure = &w->pressure[h];
    Squeeze of = {.grid = &w->bent[h], .by = w->squeeze_by[h]};
    memcpy(of.start, pressure->V, sizeof pressure->V);
    memcpy(&of.start[2], pressure->rim_V, sizeof pressure->rim_V);
    return of;
}

// The convex sum along V + s x: velocities of the points, its slope without the bent film at s = 0 and the derivative of that slope by s.
typedef struct {
    wide W[BENT_PACKETS], w[BENT_PACKETS];
    double slope, rise;
} SqueezeLine;

static void squeeze_line(const Squeeze *of, const double V[SQUEEZE], const double x[SQUEEZE],
                         SqueezeLine *line)
{
    for (int n = 0; n < BENT_PACKETS; n++) {
        wide b[SQUEEZE];
        for (int i = 0; i < SQUEEZE; i++) b[i] = wide_load(&of->grid->b[i][n * LANE_WIDTH]);
        line->W[n] = bent_dot(V, V + 2, b);
        line->w[n] = bent_dot(x, x + 2, b);
    }
    line->slope = line->rise = 0.0;
    for (int i = 0; i < SQUEEZE; i++) {
        if (of->by[i] == 0.0) continue;  // of a shape that no mode has
        line->slope += x[i] * (V[i] - of->free[i]) / of->by[i];
        line->rise += x[i] * x[i] / of->by[i];
    }
}

// Slope at s and its derivative by s.
static void slope_at(const Squeeze *of, const SqueezeLine *line, double s, double slope[2])
{
    wide sum[EIGHTHS][2];
    for (int part = 0; part < EIGHTHS; part++) {
        sum[part][0] = sum[part][1] = wide_set(0.0);
        for (int n = part; n < BENT_PACKETS; n += EIGHTHS) {
            const wide W = line->W[n] + s * line->w[n], stiff = wide_load(&of->grid->stiff[n * LANE_WIDTH]);
            const wide rate = wide_select(wide_above(W, 0.0), stiff * line->w[n], wide_set(0.0));
            sum[part][0] += rate * W;
            sum[part][1] += rate * line->w[n];
        }
    }
    wide_column_sums(2, 2, sum[0], slope);
    slope[0] += line->slope + s * line->rise;
    slope[1] += line->rise;
}

static const int MOST_HALVINGS = 50;
static const double LEVEL = 0.1;  // slope of an end / slope of the start

// Part of a step x, 1 or less, at whose end the sum falls no more: Newton's method on its slope, between bounds that it narrows.
static double squeeze_part(const Squeeze *of, const double V[SQUEEZE], const double x[SQUEEZE])
{
    SqueezeLine line;
    double at[2], low = 0.0, high = 1.0, s = 1.0;
    squeeze_line(of, V, x, &line);
    slope_at(of, &line, 0.0, at);
    const double level = LEVEL * fabs(at[0]);
    for (int i = 0; i < MOST_HALVINGS; i++) {
        slope_at(of, &line, s, at);
        if (fabs(at[0]) <= level || (s == 1.0 && at[0] < 0.0)) break;
        if (at[0] < 0.0)
            low = s;
        else
            high = s;
        const double next = s - at[0] / at[1];
        s = low < next && next < high ? next : 0.5 * (low + high);
    }
    return s;
}

static const int MOST_ITERATIONS = 100;  // of Newton's method on a film that is linear but for its ends
static const int WHOLE = 2;              // of them that are not shortened
static const double MISSED = 1e-2;       // load that a linear law may miss / its largest force

// Load at the velocities V of the points that close there and did not before, or the other way round.
static double load_missed(const BentGrid *grid, const double V[SQUEEZE], const double before[SQUEEZE])
{
    wide sum[EIGHTHS];
    for (int part = 0; part < EIGHTHS; part++) {
        sum[part] = wide_set(0.0);
        for (int n = part; n < BENT_PACKETS; n += EIGHTHS) {
            wide b[SQUEEZE];
            for (int i = 0; i < SQUEEZE; i++) b[i] = wide_load(&grid->b[i][n * LANE_WIDTH]);
            const wide W = bent_dot(V, V + 2, b);
            const bits missed = wide_above(W, 0.0) ^ wide_above(bent_dot(before, before + 2, b), 0.0);
            if (!wide_any(missed)) continue;
            const wide load = wide_load(&grid->stiff[n * LANE_WIDTH]) * wide_abs(W);
            sum[part] += wide_select(missed, load, wide_set(0.0));
        }
    }
    return wide_eight_sum(sum);
}

// Outcome of a step of Newton's method.
typedef enum { GOES_ON, DONE, LOST } SqueezeEnd;  // LOST: the step has left the model's range

// One step from V by the law there, whose force it takes along; `shorten`: as long as the sum falls.
static SqueezeEnd squeeze_step(const Squeeze *of, bool shorten, double V[SQUEEZE], SqueezeLaw *law)
{
    double rest[SQUEEZE], step[SQUEEZE], before[SQUEEZE], most = 0.0, all = 0.0;
    for (int i = 0; i < SQUEEZE; i++) rest[i] = of->free[i] + of->by[i] * law->F[i] - V[i];
    squeeze_solve(law, of->by, rest, step);
    for (int i = 0; i < SQUEEZE; i++) all += fabs(step[i]);
    const bool fine = all < INFINITY;
    const double part = shorten && fine ? squeeze_part(of, V, step) : 1.0;
    if (part < 1.0)
        for (int i = 0; i < SQUEEZE; i++) step[i] *= part;
    take_rates(law, step, law->F);
    for (int i = 0; i < SQUEEZE; i++) {
        before[i] = V[i];
        V[i] += step[i];
        most = scalar_max(most, fabs(law->F[i]));
    }
    if (!fine) return LOST;
    return part == 1.0 && load_missed(of->grid, V, before) <= MISSED * most ? DONE : GOES_ON;
}

// Solves for V, which it takes from a guess; law: film and rates there.
static void squeeze_find(const Squeeze *of, double V[SQUEEZE], SqueezeLaw *law)
{
    SqueezeEnd end = GOES_ON;
    for (int iteration = 0; iteration < MOST_ITERATIONS && end == GOES_ON; iteration++) {
        bent_law(of->grid, V, law);
        end = squeeze_step(of, iteration >= WHOLE, V, law);
    }
}

static const double STIFF = 100.0;  // change of the velocities by the film / velocities
static const double ROUGH = 1e-3;   // part of the film's load on asperities whose friction counts

bool bent_foresee(const Work *w, int h, const scalar film[SQUEEZE], scalar rough, LandPressure *seen)
{
    Squeeze of = squeeze_of(w, h);
    SqueezeLaw law;
    double V[SQUEEZE], most = 0.0, size = 0.0, load = 0.0;
    for (int i = 0; i < SQUEEZE; i++) {
        most = scalar_max(most, fabs(of.by[i] * film[i]));
        size = scalar_max(size, fabs(of.start[i]));
        load = scalar_max(load, fabs(film[i]));
    }
    if (most <= STIFF * size && rough <= ROUGH * load) return false;
    for (int i = 0; i < SQUEEZE; i++) of.free[i] = of.start[i] - of.by[i] * w->squeeze_from[h][i];
    memcpy(V, of.start, sizeof V);
    squeeze_find(&of, V, &law);
    *seen = w->pressure[h];
    memcpy(seen->at, V, sizeof seen->at);
    memcpy(seen->V, V, sizeof seen->V);
    memcpy(seen->rim_V, &V[2], sizeof seen->rim_V);
    return true;
}

void bent_solve(const Work *w, int h, double gamma, const double residual[SQUEEZE], double V[SQUEEZE],
                BentSolution *to)
{
    const LandPressure *pressure = &w->pressure[h];
    Squeeze of = squeeze_of(w, h);
    SqueezeLaw law;
    for (int i = 0; i < SQUEEZE; i++) of.free[i] = of.start[i] + residual[i] - of.by[i] * pressure->film[i];
    double known[SQUEEZE];
    memcpy(known, pressure->at, sizeof known);
    memcpy(law.F, pressure->film, sizeof law.F);
    rates_of_waves(pressure->waves, law.rate);
    if (squeeze_step(&of, false, known, &law) == DONE)
        memcpy(V, known, sizeof known);
    else
        squeeze_find(&of, V, &law);
    for (int i = 0; i < SQUEEZE; i++) {
        to->change[i] = V[i] - of.start[i];
        to->film[i] = law.F[i];
        to->impulse[i] = gamma * (pressure->film[i] - law.F[i]);
    }
    for (int i = 0; i < SQUEEZE; i++) memcpy(to->rates[i], law.rate[i], sizeof to->rates[i]);
}

double bent_arrive(const Derived *d, double gamma, const BentSolution solved[2], Work *w)
{
    double power = 0.0;
    for (int h = 0; h < 2; h++) {
        const Rotor *half = &w->half[h];
        LandPressure *pressure = &w->pressure[h];
        LandFilm *film = &w->film[h];
        const double *change = solved[h].change;
        double T[2][2] = {{half->b_y[1], half->b_y[2]}, {half->b_z[1], half->b_z[2]}};
        for (int i = 0; i < SQUEEZE; i++) {
            const double V = i < 2 ? pressure->V[i] : pressure->rim_V[i - 2];
            power += solved[h].film[i] * (V + change[i]) - pressure->film[i] * V;
            pressure->film[i] = solved[h].film[i];
        }
        for (int i = 0; i < 2; i++) {
            power -= change[i] * solved[h].impulse[i] / gamma;
            pressure->V[i] += change[i];
        }
        for (int i = 0; i < RIM; i++) pressure->rim_V[i] += change[2 + i];
        pressure->felt = land_share(d, pressure);
        const double (*rates)[SQUEEZE] = solved[h].rates;
        double rate[3];
        turn_rates(T, (double[3]){rates[0][0], rates[1][0], rates[1][1]}, rate);
        film->yy = rate[0], film->yz = rate[1], film->zz = rate[2];
    }
    return power;
}
