// Rings as cylinders that rotation and fits press apart or together: equations in ring_fit.h.
#include "physics/ring_fit.h"

// A cylinder, radii a and b [m].
typedef struct {
    double a, b, E, nu, rho;
} Cylinder;

// Displacement at r per pressure in the bore.
static double by_bore(const Cylinder *c, double r)
{
    const double a_2 = c->a * c->a, b_2 = c->b * c->b;
    return ((1.0 - c->nu) * a_2 * r + (1.0 + c->nu) * a_2 * b_2 / r) / (c->E * (b_2 - a_2));
}

// Displacement at r per pressure around the cylinder.
static double by_rim(const Cylinder *c, double r)
{
    const double a_2 = c->a * c->a, b_2 = c->b * c->b;
    return -((1.0 - c->nu) * b_2 * r + (1.0 + c->nu) * a_2 * b_2 / r) / (c->E * (b_2 - a_2));
}

// Displacement at r / omega^2.
static double by_rotation(const Cylinder *c, double r)
{
    const double nu = c->nu, a_2 = c->a * c->a, b_2 = c->b * c->b;
    return c->rho * r / (8.0 * c->E) *
           ((3.0 + nu) * (1.0 - nu) * (a_2 + b_2) + (3.0 + nu) * (1.0 + nu) * a_2 * b_2 / (r * r) -
            (1.0 - nu * nu) * r * r);
}

double ring_fit_bore(const Parameters *p)
{
    return p->ring.bore > 0.0 ? p->ring.bore : p->bearing.d_m - p->bearing.D / 0.6;
}

double ring_fit_outside(const Parameters *p)
{
    return p->ring.outside > 0.0 ? p->ring.outside : p->bearing.d_m + p->bearing.D / 0.6;
}

double ring_fit_effective_i(const Parameters *p)
{
    const double shoulder = p->bearing.d_m - p->bearing.D + 2.0 * p->bearing.h_i * p->bearing.D;
    return p->ring.effective_i > 0.0 ? p->ring.effective_i : shoulder;
}

double ring_fit_effective_e(const Parameters *p)
{
    const double shoulder = p->bearing.d_m + p->bearing.D - 2.0 * p->bearing.h_e * p->bearing.D;
    return p->ring.effective_e > 0.0 ? p->ring.effective_e : shoulder;
}

RingFit ring_fit_of(const Parameters *p)
{
    const double seat = 0.5 * ring_fit_bore(p), r = 0.5 * (p->bearing.d_m - p->bearing.D);
    const Cylinder ring = {seat, 0.5 * ring_fit_effective_i(p), p->bearing.E, p->bearing.nu, p->ring.rho};
    const Cylinder shaft = {0.5 * p->shaft.bore, seat, p->shaft.E, p->shaft.nu, p->shaft.rho};
    const bool grows = p->scene.growth == SWITCH_ON;
    return (RingFit){
        .growth = grows ? by_rotation(&ring, r) : 0.0,
        .per_fit = by_bore(&ring, r) / (by_bore(&ring, seat) - by_rim(&shaft, seat)),
        .fit = 0.5 * p->shaft.interference,
        .loosening = grows ? by_rotation(&ring, seat) - by_rotation(&shaft, seat) : 0.0,
    };
}

double ring_fit_housing(const Parameters *p, double r)
{
    const double seat = 0.5 * ring_fit_outside(p), far = 1e3 * seat;
    const double outside = p->housing.outside > 0.0 ? 0.5 * p->housing.outside : far;
    const Cylinder ring = {0.5 * ring_fit_effective_e(p), seat, p->bearing.E, p->bearing.nu, 0.0};
    const Cylinder housing = {seat, outside, p->housing.E, p->housing.nu, 0.0};
    const double interference = fmax(0.5 * p->housing.interference, 0.0);
    return -by_rim(&ring, r) * interference / (by_bore(&housing, seat) - by_rim(&ring, seat));
}
