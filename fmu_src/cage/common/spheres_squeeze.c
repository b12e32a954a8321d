// Constants of the films in the pockets of a ribbon cage; equations in spheres_squeeze.h.
//
// Reynolds' equation on the cap by Kantorovich's method (Kantorovich & Krylov (1958), Approximate Methods of Higher Analysis,
// ch. 4), lengths over R and C.  The cap is a strip along chi between both edges.  p = X(chi) f(chi, zeta), f the pressure of the
// strip by itself, whose oil leaves over both edges:
//     d/dzeta (cos zeta gap^3 df/dzeta) = -cos zeta,   cos zeta gap^3 f' = k - sin zeta,   f = 0 at both edges
// X makes the power  integral of gap^3 (p_chi^2/cos zeta + cos zeta p_zeta^2) - 2 cos zeta (n.u) p  least: a tridiagonal
// system over chi, X = 0 at the seams, taken at their chi in the middle of the section.  Within 1 % and 1 degree of the solution in two dimensions,
// 1.5 % beside the corners of seam and edges.
#include "cage/common/spheres_squeeze.h"

#include "cage/common/pocket_spheres.h"
#include "numbers/elementary.h"

#include <math.h>

// Intervals over chi and zeta, close together at the narrowest gap.
enum { ALONG = 96, ACROSS = 32 };

static const double FAR_CHI = 1.3962634015954636;  // of B and R, 80 degrees from the split
static const double FAR_ZETA = 0.6;                // of R: sin zeta / sin eta

// A direction from the sphere's centre.
typedef struct {
    double chi, zeta, x, r, t;
} Direction;

static Direction direction(double chi, double zeta)
{
    const double cosine = portable_cos(zeta);
    return (Direction){chi, zeta, cosine * portable_sin(chi), portable_sin(zeta), cosine * portable_cos(chi)};
}

static double arsinh(double x)
{
    const double size = portable_log(fabs(x) + sqrt(1.0 + x * x));
    return x < 0.0 ? -size : size;
}

// The places x from first to last, close together at `at`, and the widths of their cells.
static void graded(double at, double first, double last, double grade, int count, double x[], double width[])
{
    const double from = arsinh((first - at) / grade), step = (arsinh((last - at) / grade) - from) / count;
    for (int i = 0; i <= count; i++) {
        const double e = portable_exp(from + i * step);
        x[i] = at + grade * 0.5 * (e - 1.0 / e);
        width[i] = 0.0;
    }
    for (int i = 0; i < count; i++) {
        const double half = 0.5 * (x[i + 1] - x[i]);
        width[i] += half;
        width[i + 1] += half;
    }
}

// Solves a symmetric tridiagonal system of the first n unknowns; off[i] couples i and i + 1.
static void tridiagonal(int n, double diagonal[], const double off[], double x[])
{
    for (int i = 1; i < n; i++) {
        const double factor = off[i - 1] / diagonal[i - 1];
        diagonal[i] -= factor * off[i - 1];
        x[i] -= factor * x[i - 1];
    }
    for (int i = n - 1; i >= 0; i--) x[i] = (x[i] - (i < n - 1 ? off[i] * x[i + 1] : 0.0)) / diagonal[i];
}

// Force (x, r, t) of the film at the gap h on a ball that closes in along n, over 12 eta v R_eff^2/C; chi_1, eta: ends of the cap.
static void cap_force(double chi_1, double eta, const Direction *n, double h, double force[3])
{
    const double S = 1.0 - h, grade = sqrt(0.5 * h);
    double chi[ALONG + 1], d_chi[ALONG + 1], zeta[ACROSS + 1], d_zeta[ACROSS + 1];
    graded(n->chi, chi_1, PI - chi_1, grade, ALONG, chi, d_chi);
    graded(n->zeta, -eta, eta, grade, ACROSS, zeta, d_zeta);
    double sine[ACROSS + 1], cosine[ACROSS + 1], middle_sine[ACROSS], middle_cosine[ACROSS];
    for (int j = 0; j <= ACROSS; j++) sine[j] = portable_sin(zeta[j]), cosine[j] = portable_cos(zeta[j]);
    for (int j = 0; j < ACROSS; j++) {
        const double middle = 0.5 * (zeta[j] + zeta[j + 1]);
        middle_sine[j] = portable_sin(middle), middle_cosine[j] = portable_cos(middle);
    }

    double load[3][ALONG + 1], diagonal[ALONG + 1], off[ALONG + 1], X[ALONG + 1], f[2][ACROSS + 1];
    for (int i = 0; i <= ALONG; i++) {
        // strip: flow resistance of each interval, and pressure, which the constant k makes 0 at both ends
        const double s = portable_sin(chi[i]), c = portable_cos(chi[i]), A = S * (n->x * s + n->t * c);
        double flow[ACROSS], sum = 0.0, moment = 0.0, power = 0.0, *own = f[i % 2];
        const double *before = f[(i + 1) % 2];
        for (int j = 0; j < ACROSS; j++) {
            const double gap = 1.0 - A * middle_cosine[j] - S * n->r * middle_sine[j];
            flow[j] = (zeta[j + 1] - zeta[j]) / (middle_cosine[j] * gap * gap * gap);
            sum += flow[j];
            moment += flow[j] * middle_sine[j];
        }
        const double k = moment / sum;
        own[0] = 0.0;
        for (int j = 0; j < ACROSS; j++) {
            const double slope = k - middle_sine[j];
            own[j + 1] = own[j] + slope * flow[j];
            power += slope * slope * flow[j];
        }

        for (int axis = 0; axis < 3; axis++) load[axis][i] = 0.0;
        for (int j = 1; j < ACROSS; j++) {
            const double part = own[j] * cosine[j] * d_zeta[j] * d_chi[i];
            load[0][i] += part * cosine[j] * s;
            load[1][i] += part * sine[j];
            load[2][i] += part * cosine[j] * c;
        }
        X[i] = n->x * load[0][i] + n->r * load[1][i] + n->t * load[2][i];
        diagonal[i] = power * d_chi[i];

        // flow along the cap from the strip before
        if (i == 0) continue;
        const double at = 0.5 * (chi[i - 1] + chi[i]), step = chi[i] - chi[i - 1];
        const double A_at = S * (n->x * portable_sin(at) + n->t * portable_cos(at));
        off[i - 1] = 0.0;
        for (int j = 1; j < ACROSS; j++) {
            const double gap = 1.0 - A_at * cosine[j] - S * n->r * sine[j];
            const double along = gap * gap * gap / cosine[j] * d_zeta[j] / step;
            diagonal[i - 1] += along * before[j] * before[j];
            diagonal[i] += along * own[j] * own[j];
            off[i - 1] -= along * before[j] * own[j];
        }
    }
    tridiagonal(ALONG - 1, &diagonal[1], &off[1], &X[1]);
    for (int axis = 0; axis < 3; axis++) {
        force[axis] = 0.0;
        for (int i = 1; i < ALONG; i++) force[axis] += load[axis][i] * X[i];
    }
}

static double edge(double s_l, double l_2)
{
    return squeeze_edge(wide_set(s_l), wide_set(l_2))[0];
}

// P and the force's direction at the gap h.
static double cap_shape(const SpheresSqueeze *cap, double chi_1, double eta, const Direction *n, double h,
                        double force[3])
{
    const double l_2 = 2.0 * h;
    const double edges = edge((n->x - cap->sin_chi) * cap->inv_cos_chi, l_2) *
                         edge((cap->sin_eta - n->r) * cap->inv_cos_eta, l_2) *
                         edge((cap->sin_eta + n->r) * cap->inv_cos_eta, l_2);
    cap_force(chi_1, eta, n, h, force);
    const double square = force[0] * force[0] + force[1] * force[1] + force[2] * force[2];
    const double along = force[0] * n->x + force[1] * n->r + force[2] * n->t;
    return square / along * h / (0.5 * PI * edges);
}

void spheres_squeeze_derive(const Parameters *p, Derived *d)
{
    PocketSqueeze *film = &d->squeeze;
    SpheresSqueeze *cap = &d->spheres_squeeze;
    const double filling = p->cage.pocket_filling, R = 0.5 * p->bearing.D, least = 1e-3 * R;
    if (filling <= 0.0) return;

    // ends of the cap; the three directions
    spheres_seams(p, &cap->sin_chi, &cap->sin_eta);
    const double chi_1 = portable_asin(cap->sin_chi), eta = portable_asin(cap->sin_eta);
    cap->inv_cos_chi = 1.0 / sqrt(1.0 - cap->sin_chi * cap->sin_chi);
    cap->inv_cos_eta = 1.0 / sqrt(1.0 - cap->sin_eta * cap->sin_eta);
    const double push = d->spheres.e / fmax(d->spheres.radius - R, least);
    const double inside = cap->sin_chi + 0.15 * (1.0 - cap->sin_chi);
    const Direction A = direction(portable_asin(fmin(fmax(push, inside), 0.9)), 0.0),
                    B = direction(FAR_CHI, 0.0);
    const Direction edgeward = direction(FAR_CHI, portable_asin(FAR_ZETA * cap->sin_eta));
    cap->n_xA = A.x;
    cap->inv_n_x = 1.0 / (B.x - A.x);
    cap->inv_n_r2 = 1.0 / (edgeward.r * edgeward.r);
    cap->filling = filling;

    // shapes over the gap
    squeeze_nodes(film->node);
    for (int i = 0; i < SQUEEZE_NODES; i++) {
        const double h = film->node[i] * film->node[i];
        double of_A[3], of_B[3], of_R[3], value[SQUEEZE_SHAPES] = {1.0, 1.0, 0.0, 1.0, 1.0, 1.0};
        if (i > 0) {
            value[P_A] = cap_shape(cap, chi_1, eta, &A, h, of_A);
            value[P_B] = cap_shape(cap, chi_1, eta, &B, h, of_B);
            const double P = cap_shape(cap, chi_1, eta, &edgeward, h, of_R);
            value[P_R] = P - (value[P_A] + (edgeward.x - A.x) * cap->inv_n_x * (value[P_B] - value[P_A]));
            value[K_A] = of_A[2] / of_A[0] * A.x / A.t;
            value[K_B] = of_B[2] / of_B[0] * B.x / B.t;
            value[K_R] = of_R[1] / of_R[0] * edgeward.x / edgeward.r;
        }
        for (int shape = 0; shape < SQUEEZE_SHAPES; shape++) cap->newton[shape][i] = value[shape];
    }
    for (int shape = 0; shape < SQUEEZE_SHAPES; shape++) squeeze_newton(film->node, cap->newton[shape]);

    // closed form of each pocket
    const double C = fmax(d->spheres.radius - R, least), R_eff = R * d->spheres.radius / C;
    film->filled = true;
    film->roughness_2 = p->oil.sigma_pocket * p->oil.sigma_pocket;
    film->elastic = 2.25 * portable_pow(6.0 * PI * p->oil.eta * R_eff * R_eff / d->spheres.K, 0.8);
    for (int j = 0; j < LANES; j++) {
        const double own_R = j < Z ? d->R[j] : R, own_C = fmax(d->R_c[j] - own_R, least);
        const double own = own_R * d->R_c[j] / own_C;
        film->C[j] = own_C;
        film->c[j] = j < Z ? 6.0 * PI * p->oil.eta * own * own : 0.0;
        film->reach = fmax(film->reach, filling * own_C);
    }
}
