// Constants of the pockets of a ribbon cage.  Equations in pocket_spheres.c.
#include "cage/common/pocket_spheres.h"
#include "physics/hertz.h"

#include <math.h>

static const double CONFORMING = 0.7;  // of a/R in the load of ball and sphere

double spheres_edge(const Parameters *p)
{
    return p->cage.pocket_edge > 0.0 ? p->cage.pocket_edge : 0.1 * p->cage.sheet;
}

static double sphere_radius(const Parameters *p)
{
    return 0.5 * (p->bearing.D + p->cage.pocket_clearance);
}

void spheres_seams(const Parameters *p, double *sin_chi, double *sin_eta)
{
    const double radius = sphere_radius(p), fillet = p->cage.pocket_fillet, edge = spheres_edge(p);
    *sin_chi = (fillet + (radius - p->cage.pocket_depth)) / (radius + fillet);
    *sin_eta = (0.25 * (p->cage.D_o - p->cage.D_i) - edge) / (radius + edge);
}

// Difference of the curvatures of ball and sphere [1/m], at least a thousandth of the ball's.
static double difference(double R, double radius)
{
    return fmax(1.0 / R - 1.0 / radius, 1e-3 / R);
}

// A rim of the radius rho whose seam is at the angle of this sine; middle, across: of its arc's end, in its plane.
static Rim derive_rim(double E_star, double R, double radius, double rho, double sine, double middle,
                      double across)
{
    const double reach = radius + rho, cosine = sqrt(1.0 - sine * sine);
    const double end = sqrt(middle * middle + across * across);
    return (Rim){.K = hertz_contact(1.0 / R + 1.0 / rho, difference(R, radius), E_star).K,
                 .reach = reach,
                 .A = reach * cosine,
                 .H = reach * sine,
                 .sine = sine,
                 .cosine = cosine,
                 .sin_arc = across / end,
                 .cos_arc = middle / end};
}

void spheres_derive(const Parameters *p, double E_star, Derived *d)
{
    Spheres *s = &d->spheres;
    const double R = 0.5 * p->bearing.D, radius = sphere_radius(p), R_eff = 1.0 / difference(R, radius);
    double sin_chi, sin_eta;
    spheres_seams(p, &sin_chi, &sin_eta);
    const double along = sqrt(1.0 - sin_chi * sin_chi - sin_eta * sin_eta);  // of the corner
    s->on = true;
    s->e = radius - p->cage.pocket_depth;
    s->r = 0.25 * (p->cage.D_o + p->cage.D_i);
    s->radius = radius;
    s->a_delta = sqrt(R_eff);
    s->K = 4.0 / 3.0 * E_star * s->a_delta;
    s->more = CONFORMING * s->a_delta / R;
    s->fillet = derive_rim(E_star, R, radius, p->cage.pocket_fillet, sin_chi, along, sin_eta);
    s->edge = derive_rim(E_star, R, radius, spheres_edge(p), sin_eta, sin_chi, along);
    for (int j = 0; j < LANES; j++)
        s->slack[j] = j < Z ? d->R_c[j] - d->R[j] : 1.0;  // padding touches nothing
}
