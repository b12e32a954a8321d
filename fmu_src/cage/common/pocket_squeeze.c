// Constants of the films in the pockets; equations in pocket_squeeze.h.
#include "cage/common/pocket_squeeze.h"

#include "numbers/elementary.h"

// Intervals of Simpson's rule over phi, graded toward the narrowest gap.
enum { INTERVALS = 96 };

// The gap of a pocket: radii, clearance, ends of the section, layer of oil [m].
typedef struct {
    double R, R_c, C, inner, outer, layer;
} Gap;

// I_0, I_1, I_2 from 0 to y at the gap h.
static void strip_integrals(double R, double h, double y, double I[3])
{
    const double d = 2.0 * R, q = h + y * y / d, s = sqrt(d * h), angle = s * portable_atan(y / s);
    I[0] = y / (4.0 * h * q * q) + 3.0 * y / (8.0 * h * h * q) + 3.0 * angle / (8.0 * h * h * h);
    I[1] = 0.25 * d * (1.0 / (h * h) - 1.0 / (q * q));
    I[2] = d * (y / (8.0 * h * q) - y / (4.0 * q * q) + angle / (8.0 * h * h));
}

// D_strip / (12 eta) at the gap h.
static double strip(const Gap *g, double h)
{
    if (h >= g->layer) return 0.0;
    const double wet = sqrt(6.0 * g->R * (g->layer - h));
    double below[3], above[3], I[3];
    strip_integrals(g->R, h, -fmin(g->inner, wet), below);
    strip_integrals(g->R, h, fmin(g->outer, wet), above);
    for (int n = 0; n < 3; n++) I[n] = above[n] - below[n];
    return I[2] - I[1] * I[1] / I[0];
}

// D / (12 eta) of the whole film with the narrowest gap h.
static double whole(const Gap *g, double h)
{
    const double grade = sqrt(0.5 * h / g->C), end = 0.5 * PI / grade;
    const double last = portable_log(end + sqrt(1.0 + end * end));  // arsinh
    double sum = 0.0;
    for (int i = 0; i <= INTERVALS; i++) {
        const double T = last * i / INTERVALS, e = portable_exp(T);
        const double phi = 0.5 * grade * (e - 1.0 / e), dphi = 0.5 * grade * (e + 1.0 / e);
        const double cosine = portable_cos(phi), weight = i == 0 || i == INTERVALS ? 1.0 : i % 2 ? 4.0 : 2.0;
        sum += weight * strip(g, g->C - (g->C - h) * cosine) * cosine * cosine * dphi;
    }
    return 2.0 * g->R_c / (1.0 + g->C / g->R_c) * sum * last / (3.0 * INTERVALS);
}

// c / (12 eta).
static double paraboloid(const Gap *g)
{
    const double R_x = g->R * g->R_c / g->C, product = R_x * g->R;
    return PI * product * sqrt(product) / (R_x + g->R);
}

void squeeze_nodes(double node[SQUEEZE_NODES])
{
    for (int i = 0; i < SQUEEZE_NODES; i++) node[i] = 0.5 - 0.5 * portable_cos(PI * i / (SQUEEZE_NODES - 1));
}

void squeeze_newton(const double node[SQUEEZE_NODES], double value[SQUEEZE_NODES])
{
    for (int order = 1; order < SQUEEZE_NODES; order++)
        for (int i = SQUEEZE_NODES - 1; i >= order; i--)
            value[i] = (value[i] - value[i - 1]) / (node[i] - node[i - order]);
}

// The polynomial through the values of G at the nodes; 1 at z = 0.
static void fit_shape(const Gap *g, double reach, PocketSqueeze *film)
{
    squeeze_nodes(film->node);
    for (int i = 0; i < SQUEEZE_NODES; i++) {
        const double h = film->node[i] * film->node[i] * reach;
        film->newton[i] = i == 0 ? 1.0 : whole(g, h) * h / paraboloid(g);
    }
    squeeze_newton(film->node, film->newton);
}

void pocket_squeeze_derive(const Parameters *p, Derived *d)
{
    PocketSqueeze *film = &d->squeeze;
    const double filling = p->cage.pocket_filling, R = 0.5 * p->bearing.D, R_c = d->pocket_radius;
    if (filling <= 0.0) return;

    // the closest conformity as in the contact; a section around the pitch circle
    const double C = fmax(R_c - R, 1e-3 * R), least = 0.05 * R;
    const double inner = fmax(0.5 * (p->bearing.d_m - p->cage.D_i), least);
    const double outer = fmax(0.5 * (p->cage.D_o - p->bearing.d_m), least), longer = fmax(inner, outer);
    const double layer = filling * (C + longer * longer / (6.0 * R));
    const Gap gap = {R, R_c, C, inner, outer, layer};
    film->filled = true;
    film->reach = fmin(layer, C);
    fit_shape(&gap, film->reach, film);

    const double c = 12.0 * p->oil.eta * paraboloid(&gap);
    film->roughness_2 = p->oil.sigma_pocket * p->oil.sigma_pocket;
    film->elastic = 2.25 * portable_pow(c / d->pocket.K, 0.8);
    for (int j = 0; j < LANES; j++) {
        Gap own = gap;
        own.R_c = d->R_c[j];
        own.C = film->C[j] = fmax(d->R_c[j] - (j < Z ? d->R[j] : R), 1e-3 * R);
        film->c[j] = j < Z ? 12.0 * p->oil.eta * paraboloid(&own) : 0.0;
        film->inv_reach[j] = C / (film->reach * own.C);
    }
}
