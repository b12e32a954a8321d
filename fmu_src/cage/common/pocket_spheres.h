// Contact of the balls with the pockets of a ribbon cage.  Equations in pocket_spheres.c.
#pragma once

#include "cage/common/pocket_forces.h"

// Constants of the pockets of a ribbon cage; d->R and d->R_c are known.
void spheres_derive(const Parameters *p, double E_star, Derived *d);

// Radius of the pockets' edges [m]; sine of the angles at which the sphere ends: at the fillet, from the split, and at
// the edges, from the middle of the cage's section.
double spheres_edge(const Parameters *p);
void spheres_seams(const Parameters *p, double *sin_chi, double *sin_eta);

// Contacts of all pockets of two rigid halves, as pocket_rigid of machined ones.
void spheres_rigid(const Model *model, Work *w);

// Contacts of all pockets of two elastic halves, as pocket_elastic of machined ones.
void spheres_elastic(const Model *model, Work *w);

static const double TIP =
    1e-7;  // least distance from an axis; way over which both edges change places under a wide patch [m]
static const double SEAT =
    5e-6;  // way from the middle up to which a ball sits on the corners of both sides [m]
static const double BEND =
    0.05;  // angle on both sides of the fillet's seam over which a place begins to turn with the ball

// Where the ball is in the sphere of a half.
typedef struct {
    PocketAxes axes;
    wide x, r, t;  // q
} SphereGap;

INLINE SphereGap sphere_gap(const Derived *d, const Work *w, int h, int j)
{
    const PocketAxes at = pocket_axes(d, w, &w->half[h], j);
    return (SphereGap){at, (h == 0 ? -1.0 : 1.0) * vec_dot(at.p, at.a) + d->spheres.e,
                       vec_dot(at.p, at.b) - d->spheres.r, vec_dot(at.p, at.e_t)};
}

// A coordinate of q on either side of the middle, its size and the size's slope.  A ball that sits on the corners of both sides presses
// both, within some micrometres of its approach: up to `seat` from the middle the size is a parabola.
typedef struct {
    wide at, size, slope;
} SphereSide;

INLINE SphereSide sphere_side(wide at, double seat)
{
    const wide far = wide_abs(at), near = wide_min(far, wide_set(seat));
    const wide slope = wide_max(wide_min(at / seat, wide_set(1.0)), wide_set(-1.0));
    return (SphereSide){at, (far - near) + 0.5 * (near * near / seat + seat), slope};
}

// Reach of (u, v) along a rim's arc, and its slopes along the coordinates u and v.
typedef struct {
    wide g, u, v;
} ArcReach;

INLINE ArcReach arc_reach(const Rim *rim, SphereSide u, SphereSide v)
{
    const wide g = wide_sqrt(u.at * u.at + v.at * v.at + 1e-30), inv_g = 1.0 / g;
    const bits within = wide_above(u.size * rim->sin_arc - v.size * rim->cos_arc, 0.0);
    return (ArcReach){wide_select(within, g, u.size * rim->cos_arc + v.size * rim->sin_arc),
                      wide_select(within, u.at * inv_g, rim->cos_arc * u.slope),
                      wide_select(within, v.at * inv_g, rim->sin_arc * v.slope)};
}

// Contact with a rim at the reach g in its plane and the height h above it, where q lies above its seam by the angle of the
// sine `inside`.  share: part of the energy that the sphere has, by this seam; slopes of the approach along g and h, of the
// share along `inside` and along the approach.
typedef struct {
    wide delta, energy, load, slope_g, slope_h;
    wide share, by_inside, by_delta;
} RimContact;

INLINE RimContact rim_contact(const Spheres *s, const Rim *rim, wide slack, wide g, wide h, wide inside)
{
    const wide off_g = rim->A - g, off_h = rim->H - h, apart = wide_sqrt(off_g * off_g + off_h * off_h);
    const wide inv_apart = 1.0 / apart;
    RimContact c;
    c.delta = rim->reach - slack - apart;
    c.slope_g = off_g * inv_apart, c.slope_h = off_h * inv_apart;
    const wide own = wide_max(c.delta, wide_set(1e-30)), root = wide_sqrt(own);
    c.load = wide_select(wide_above(c.delta, 0.0), rim->K * own * root, wide_set(0.0));
    c.energy = 0.4 * c.load * own;

    const wide one = wide_set(1.0), width = s->radius / (s->a_delta * root);
    const wide xi = wide_max(wide_min(width * inside, one), -one), xi_2 = xi * xi, rest = 1.0 - xi_2;
    const wide steep = 15.0 / 16.0 * rest * rest;
    c.share = 0.5 + xi * (15.0 / 16.0 - xi_2 * (0.625 - 3.0 / 16.0 * xi_2));
    c.by_inside = steep * width;
    c.by_delta = -0.5 * steep * xi / own;
    return c;
}

// Fillet and edge together: the one that is reached farther has the energy, near a corner both.  fillet: part of the fillet,
// slopes of that part along both approaches.
typedef struct {
    wide energy, fillet, by_f, by_e;
} RimPair;

INLINE RimPair rim_pair(const RimContact *f, const RimContact *e)
{
    const wide zero = wide_set(0.0), own_f = wide_max(f->delta, zero), own_e = wide_max(e->delta, zero);
    const wide inv_most = 1.0 / wide_max(wide_max(own_f, own_e), wide_set(1e-30));
    const wide ratio = wide_min(own_f, own_e) * inv_most, less = 0.5 * ratio * ratio;
    const bits edge_more = wide_above(own_e - own_f, 0.0);
    RimPair pair;
    pair.fillet = wide_select(edge_more, less, 1.0 - less);
    pair.by_f = wide_select(edge_more, ratio, ratio * ratio) * inv_most;
    pair.by_e = -wide_select(edge_more, ratio * ratio, ratio) * inv_most;
    pair.energy = e->energy + pair.fillet * (f->energy - e->energy);
    return pair;
}

// Elastic contact in a packet of pockets: energy, load, direction into the wall along the pocket's axes, approach; of a
// ball within the sphere, the sphere's.
typedef struct {
    wide V, Q, n_x, n_r, n_t, delta;
} SphereContact;

// The approach of the nearest place of sphere and rims, and that of the sphere.
INLINE wide sphere_nearest(const Spheres *s, wide slack, const SphereGap *gap, wide *sphere)
{
    const wide x = gap->x, r = gap->r, t = gap->t, r_2 = r * r, t_2 = t * t;
    const SphereSide X = {x, x, wide_set(1.0)}, R = sphere_side(r, TIP), T = sphere_side(t, SEAT);
    *sphere = wide_sqrt(x * x + r_2 + t_2) - slack;
    const wide above = x * s->fillet.cosine - wide_sqrt(t_2 + r_2) * s->fillet.sine;
    const wide below = wide_sqrt(x * x + t_2) * s->edge.sine - R.size * s->edge.cosine;
    const wide g = arc_reach(&s->fillet, T, R).g, k = arc_reach(&s->edge, X, T).g;
    const wide off_g = s->fillet.A - g, off_x = s->fillet.H - x, off_k = s->edge.A - k;
    const wide off_r = s->edge.H - R.size;
    const wide f = s->fillet.reach - slack - wide_sqrt(off_g * off_g + off_x * off_x);
    const wide e = s->edge.reach - slack - wide_sqrt(off_k * off_k + off_r * off_r);
    return wide_select(wide_above(wide_min(above, below), 0.0), *sphere, wide_max(f, e));
}

// The approach by which no contact is missed: of a ball within the sphere, the sphere's; returns whether a ball of the packet may touch.
INLINE bool sphere_reached(const Spheres *s, wide slack, const SphereGap *gap, wide *delta)
{
    wide sphere;
    const wide nearest = sphere_nearest(s, slack, gap, &sphere);
    *delta = wide_select(wide_above(sphere, 0.0), nearest, sphere);
    return wide_any(wide_above(*delta, -1e-9));
}

INLINE SphereContact sphere_contact(const Spheres *s, wide slack, wide x, wide r, wide t)
{
    const SphereSide X = {x, x, wide_set(1.0)}, R = sphere_side(r, TIP), T = sphere_side(t, SEAT);
    const wide r_2 = r * r, t_2 = t * t;

    // sphere
    const wide distance = wide_sqrt(x * x + r_2 + t_2 + 1e-30), delta = distance - slack;
    const wide own = wide_max(delta, wide_set(0.0)), root = wide_sqrt(wide_max(own, wide_set(1e-30)));
    const wide energy = s->K * own * own * (0.4 * root + s->more / 3.0 * own);
    const wide load = s->K * own * (root + s->more * own) / distance;

    // rims; the sphere lies above the fillet's seam and below the edge's
    const wide inv = 1.0 / distance, round_pole = wide_sqrt(t_2 + r_2 + TIP * TIP),
               round_r = wide_sqrt(x * x + t_2 + TIP * TIP);
    const wide in_f = (x * s->fillet.cosine - round_pole * s->fillet.sine) * inv;
    const wide in_e = (round_r * s->edge.sine - R.size * s->edge.cosine) * inv;
    const ArcReach g = arc_reach(&s->fillet, T, R), k = arc_reach(&s->edge, X, T);
    const RimContact f = rim_contact(s, &s->fillet, slack, g.g, x, in_f);
    const RimContact e = rim_contact(s, &s->edge, slack, k.g, R.size, in_e);
    const RimPair rims = rim_pair(&f, &e);
    const wide share = f.share * e.share, rest = 1.0 - share, over = energy - rims.energy;
    SphereContact c = {.V = rims.energy + share * over};

    // slopes along the approaches of both rims and along both angles; gradient along x, r, t
    const wide between = f.energy - e.energy;
    const wide of_f = rest * (rims.fillet * f.load + between * rims.by_f) + over * e.share * f.by_delta;
    const wide of_e =
        rest * ((1.0 - rims.fillet) * e.load + between * rims.by_e) + over * f.share * e.by_delta;
    const wide turn_f = over * e.share * f.by_inside * inv, turn_e = over * f.share * e.by_inside * inv;
    const wide out = share * load - (turn_f * in_f + turn_e * in_e) * inv;
    const wide along_g = of_f * f.slope_g, along_k = of_e * e.slope_g;
    const wide pole = turn_f * s->fillet.sine / round_pole, across = turn_e * s->edge.sine / round_r;
    const wide V_x = of_f * f.slope_h + turn_f * s->fillet.cosine + along_k * k.u + (out + across) * x;
    const wide V_r =
        (of_e * e.slope_h - turn_e * s->edge.cosine) * R.slope + along_g * g.v + (out - pole) * r;
    const wide V_t = along_g * g.u + along_k * k.v + (out + across - pole) * t;
    c.Q = wide_sqrt(V_x * V_x + V_r * V_r + V_t * V_t + 1e-60);
    const wide inv_Q = 1.0 / c.Q;
    c.n_x = V_x * inv_Q, c.n_r = V_r * inv_Q, c.n_t = V_t * inv_Q;
    const wide nearest = share * delta + rest * wide_max(f.delta, e.delta);
    c.delta = wide_select(wide_above(delta, 0.0), nearest, delta);
    return c;
}
