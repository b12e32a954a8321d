// Ball and race: Hertz' contact under a groove that may be displaced and tilted, with traction.
//
//         circle of groove centres,              p = ball centre - ring centre
//         radius R_g about the ring's axis a     e   unit vector from the axis to the ball: radial part of p
//               o ________                       L = (p.a) a + (|p - (p.a) a| - R_g) e
//              /  L       \                      n = L/|L|: from the groove's centre through the ball's to the contact
//             /            \                     delta = |L| - (r_g - R)
//     race   (    ball      )                    delta_dot = n.(v_ball - v_ring - Omega x p)
//             \            /                     Q = K delta^1.5 max(0, 1 + lambda delta_dot)
//              \__________/                      force on the ball -Q n
//
// The outer race is the same with the outer ring's centre, axis and motion (outer_ring.h).
//
// The inner ring grows by its rotation in the fixed frame and its fit: R_g + ring_fit_growth (ring_fit.h).
//
// Races that are not perfect have approaches and normals of their own (race_surface.h), balls with spalls moments too
// (ball_spall.h).
//
// No offset or tilt is taken as small: the geometry is exact, so that the normal forces derive from a
// potential.
//
// Slip and mean speed at the contact point p + R n, seen from the frame that orbits with the ball:
//   u_ball = (omega_ball - omega_m e_x) x R n,   u_race = v_ring + Omega x (p + R n) - v_ball - omega_m e_x x R n
//   Delta u = u_ball - u_race,   U = (u_ball + u_race)/2     (their parts in the tangent plane)
// The ring gets the opposite forces at the same points: force -F, moment -(p x F) - M about its centre.  Spin
// and curvature let the slip vary along the long axis of the ellipse; `sliced` integrates the traction over this axis:
//   Delta u(xi) = Delta u + Delta omega x (xi t_2 - xi^2/(2 R_m) n),  pressure (3/4)(1 - xi^2/a^2) per length
// in slices on both sides of where the slip changes its sign, because the traction is nearly a step there.
// With x = xi/a the slip along t_1 is s_1 + k x + b_1 x^2; the place is x_0 = -s_1 k/(k^2 + b_1^2), not
// beyond the ends.  That is the root where spin (k) outweighs curvature (b_1); the two roots of curvature lie
// about the middle, which x_0 tends to. Smoothness: C1 at touch-down.  Hertz' ellipse is not cut at the shoulder.
#include "physics/race_contact.h"

#include "physics/ball_spall.h"
#include "physics/hertz.h"
#include "physics/outer_ring.h"
#include "physics/race_surface.h"
#include "physics/ring_fit.h"
#include "physics/traction.h"

// Slices on both sides of the place x_0 that splits the ellipse, x = xi/a in [-1, 1]: x = x_0 (1 - z) + side z with
// weights (3/4)(1 + side x)(1 - side x_0)^2 w, where z and w are Gauss-Jacobi's points for the weight 1 - z on [0, 1].
// They integrate the pressure (3/4)(1 - x^2) times polynomials up to degree 10 on each side exactly.
// Slices 3 l to 3 l + 2 are the threes l = 0...3, two on each side: THIRDS rows with a slice of each.  Rows
// are repeated, so that a packet may hold one row for each of two contacts.
enum { SIDES = 2, ONE_SIDE = 6, THREES = 4, THIRDS = 3, ROW = 8 };

static const struct {
    double near[THIRDS][ROW];    // 1 - z, what x takes of x_0
    double far[THIRDS][ROW];     // side z, what it takes of the ellipse's end
    double w[THIRDS][ROW];       // w
    double side_w[THIRDS][ROW];  // side w
} SLICE = {
    {{0.9706835728402151, 0.4413284812284498, 0.9706835728402151, 0.4413284812284498, 0.9706835728402151,
      0.4413284812284498, 0.9706835728402151, 0.4413284812284498},
     {0.8519214003315158, 0.2307661379699455, 0.8519214003315158, 0.2307661379699455, 0.8519214003315158,
      0.2307661379699455, 0.8519214003315158, 0.2307661379699455},
     {0.6630153097188457, 0.073054328680259, 0.6630153097188457, 0.073054328680259, 0.6630153097188457,
      0.073054328680259, 0.6630153097188457, 0.073054328680259}},
    {{-0.02931642715978494, -0.5586715187715502, 0.02931642715978494, 0.5586715187715502,
      -0.02931642715978494, -0.5586715187715502, 0.02931642715978494, 0.5586715187715502},
     {-0.1480785996684843, -0.7692338620300545, 0.1480785996684843, 0.7692338620300545, -0.1480785996684843,
      -0.7692338620300545, 0.1480785996684843, 0.7692338620300545},
     {-0.3369846902811543, -0.926945671319741, 0.3369846902811543, 0.926945671319741, -0.3369846902811543,
      -0.926945671319741, 0.3369846902811543, 0.926945671319741}},
    {{0.0723103307255089, 0.0986611508906552, 0.0723103307255089, 0.0986611508906552, 0.0723103307255089,
      0.0986611508906552, 0.0723103307255089, 0.0986611508906552},
     {0.13554249723151868, 0.04395516555050896, 0.13554249723151868, 0.04395516555050896, 0.13554249723151868,
      0.04395516555050896, 0.13554249723151868, 0.04395516555050896},
     {0.14079255378819883, 0.008738301813609529, 0.14079255378819883, 0.008738301813609529,
      0.14079255378819883, 0.008738301813609529, 0.14079255378819883, 0.008738301813609529}},
    {{-0.0723103307255089, -0.0986611508906552, 0.0723103307255089, 0.0986611508906552, -0.0723103307255089,
      -0.0986611508906552, 0.0723103307255089, 0.0986611508906552},
     {-0.13554249723151868, -0.04395516555050896, 0.13554249723151868, 0.04395516555050896,
      -0.13554249723151868, -0.04395516555050896, 0.13554249723151868, 0.04395516555050896},
     {-0.14079255378819883, -0.008738301813609529, 0.14079255378819883, 0.008738301813609529,
      -0.14079255378819883, -0.008738301813609529, 0.14079255378819883, 0.008738301813609529}},
};

// Packets of balls without padding, balls in the last one, and packets of contacts (race_tractions).
enum {
    WHOLE = Z / LANE_WIDTH,
    REST = Z % LANE_WIDTH,
    JOINED = REST > 0 && 2 * REST <= LANE_WIDTH,
    CONTACT_PACKETS = 2 * PACKETS - JOINED
};

static const double TINY = 1e-30;  // keeps padding lanes and balls at a groove's centre from dividing by 0

// One ball, in its own frame (x, r, t).
typedef struct {
    vec x, v, omega;  // centre, velocity, angular velocity
    wide omega_m, R;
} BallMotion;

// One contact.
typedef struct {
    vec n, t_1, t_2;  // normal, rolling direction, long axis of the ellipse
    vec slip, roll;   // Delta u, U
    vec spin;         // omega_ball - Omega of the race
    vec approach;     // velocity of the ball's centre against the race there
    wide R, delta, sqrt_delta, Q, dissipated;
} Contact;

// A race's constants at the contacts of a packet.
typedef struct {
    wide a_delta;         // a/sqrt(delta)
    wide half_curvature;  // 1/(2 R_m)
    wide ln_Lambda, rolling, horizontal;
} RaceConstants;

// Film of a contact: mean surface speed with its floor, 1/U, asperities' share of the load, rolling friction
// of the inlet.
typedef struct {
    wide U, inv_U, f_a, F_R;
} Film;

// Load of a contact with approach delta, which grows at the rate delta_dot, and the power that its damping
// dissipates.
INLINE void load_contact(const Model *model, const Race *race, wide delta, wide delta_dot, Contact *c)
{
    const wide Q_0 = hertz_load(wide_set(race->hertz.K), delta);
    c->delta = delta;
    c->sqrt_delta = wide_sqrt(wide_max(delta, wide_set(0.0)));
    c->Q = hertz_damped(Q_0, wide_set(model->p->bearing.lambda), delta_dot);
    c->dissipated = (c->Q - Q_0) * delta_dot;
}

// Slip and mean speed of a contact whose normal and approach are known, from the velocities at the contact point against
// the ball's centre, seen from the orbiting frame.
INLINE void contact_motion(const BallMotion *ball, vec Omega, Contact *c)
{
    const vec arm = vec_scale(ball->R, c->n), axis = {ball->omega_m, wide_set(0.0), wide_set(0.0)};
    const vec u_ball = vec_cross(ball->omega, arm), orbit = vec_cross(axis, arm);
    const vec u_race = vec_sub(vec_cross(Omega, arm), c->approach);  // v + Omega x (p + arm) - v_ball
    c->slip = vec_across(vec_sub(u_ball, u_race), c->n);
    c->roll =
        vec_across(vec_axpy(wide_set(-1.0), orbit, vec_scale(wide_set(0.5), vec_add(u_ball, u_race))), c->n);
}

// One race.  R_g: present radius of the circle of groove centres; p: from the centre of the ring to that of
// the ball; a, v, Omega: axis, velocity and angular velocity of the ring.  All vectors are in the frames of the balls.
INLINE Contact race_contact(const Model *model, const Race *race, const BallMotion *ball, wide R_g, vec p,
                            vec a, vec v, vec Omega)
{
    const wide along = vec_dot(p, a), tiny = wide_set(TINY);
    const vec radial = vec_axpy(-along, a, p);
    const wide r = wide_sqrt(vec_dot(radial, radial) + tiny);
    const vec e = vec_scale(1.0 / r, radial);
    const wide across = r - R_g, L = wide_sqrt(along * along + across * across + tiny), inv_L = 1.0 / L;
    Contact c = {
        .R = ball->R, .n = vec_axpy(across * inv_L, e, vec_scale(along * inv_L, a)), .t_1 = vec_cross(a, e)};
    c.t_2 = vec_cross(c.n, c.t_1);
    c.approach = vec_sub(vec_sub(ball->v, v), vec_cross(Omega, p));
    c.spin = vec_sub(ball->omega, Omega);
    load_contact(model, race, L - (race->r_g - ball->R), vec_dot(c.n, c.approach), &c);
    contact_motion(ball, Omega, &c);
    return c;
}

// Outer race of a ring at rest in its place: the same, without the terms that vanish there.
INLINE Contact outer_contact_at_rest(const Model *model, const BallMotion *ball)
{
    const Race *race = &model->d->outer;
    const vec v = ball->v, omega = ball->omega;
    const wide R = ball->R, across = ball->x.r - race->R_g;
    const wide L = wide_sqrt(ball->x.x * ball->x.x + across * across + wide_set(TINY)), inv_L = 1.0 / L;
    Contact c = {.R = R,
                 .n = {ball->x.x * inv_L, across * inv_L, wide_set(0.0)},
                 .t_1 = {wide_set(0.0), wide_set(0.0), wide_set(1.0)}};
    c.t_2 = (vec){c.n.r, -c.n.x, wide_set(0.0)};
    c.approach = v;
    c.spin = omega;
    load_contact(model, race, L - (race->r_g - R), c.n.x * v.x + c.n.r * v.r, &c);

    // velocities at the contact point, likewise; orbit is along t
    const vec u_ball = {-omega.t * R * c.n.r, omega.t * R * c.n.x, R * (omega.x * c.n.r - omega.r * c.n.x)};
    const wide orbit = ball->omega_m * R * c.n.r;
    c.slip = vec_across(vec_add(u_ball, v), c.n);
    c.roll = vec_across((vec){0.5 * (u_ball.x - v.x), 0.5 * (u_ball.r - v.r), 0.5 * (u_ball.t - v.t) - orbit},
                        c.n);
    return c;
}

// Place of a packet of balls on a race that is not perfect, as in race_contact, with the rolling direction t and cos and sin
// of the angle on the race, of ring->b_y and b_z, which turn with it.
typedef struct {
    vec p, v, Omega, a, n, t;
    wide r, L, cos_phi, sin_phi, s;
} SurfacePlace;

INLINE SurfacePlace surface_place(const BallMotion *ball, wide R_g, const Rotor *ring, wide cos_theta,
                                  wide sin_theta)
{
    const wide tiny = wide_set(TINY);
    const vec a = vec_local(ring->a, cos_theta, sin_theta);
    SurfacePlace at = {.p = vec_sub(ball->x, vec_local(ring->x, cos_theta, sin_theta)),
                       .v = vec_local(ring->v, cos_theta, sin_theta),
                       .Omega = vec_local(ring->Omega, cos_theta, sin_theta),
                       .a = a,
                       .s = wide_set(ring->s)};
    const wide along = vec_dot(at.p, a);
    const vec radial = vec_axpy(-along, a, at.p);
    at.r = wide_sqrt(vec_dot(radial, radial) + tiny);
    const vec e = vec_scale(1.0 / at.r, radial);
    const wide across = at.r - R_g;
    at.L = wide_sqrt(along * along + across * across + tiny);
    const wide inv_L = 1.0 / at.L;
    at.n = vec_axpy(across * inv_L, e, vec_scale(along * inv_L, a));
    at.t = vec_cross(a, e);
    at.cos_phi = vec_dot(e, vec_local(ring->b_y, cos_theta, sin_theta));
    at.sin_phi = vec_dot(e, vec_local(ring->b_z, cos_theta, sin_theta));
    return at;
}

// What a contact has of spalls: drops of the path in the race's and in the ball's, their derivatives by the angles on
// race and ball, rate of the latter.
typedef struct {
    SpallLanes race, ball;
    wide f, df, f_ball, df_ball, rate;
    bool two;  // whether balls have spalls
} SpallPlace;

// Contact there, under waves of the height w with the derivative dw.  stored: elastic energy of the contact; P: moment on
// the balls by their spalls.
INLINE Contact surface_contact(const Model *model, const Race *race, const BallMotion *ball,
                               const SurfacePlace *at, wide w, wide dw, const SpallPlace *in, wide *stored,
                               wide *P)
{
    const wide delta = at->L - (race->r_g - ball->R) + w;
    SurfaceLoad load;
    if (race->surface.spalled || in->two) {
        const SpallStrips strips = spall_strips(&in->race, in->f, &in->ball, in->f_ball);
        load = race_surface_load(&race->hertz, delta, &strips, in->two);
    } else {
        load = race_whole_load(&race->hertz, delta);
    }

    // minus the gradient of the energy, Q (n + q t), whose direction is the normal, and the moment Q m on the ball
    const wide q = (dw - load.Q_race / (load.Q + LEAST_LOAD) * in->df) / at->r,
               length = wide_sqrt(1.0 + q * q);
    const wide inv_length = 1.0 / length;
    const wide m = in->two ? load.Q_ball / (load.Q + LEAST_LOAD) * in->df_ball : wide_set(0.0);
    Contact c = {.R = ball->R,
                 .n = vec_scale(inv_length, vec_axpy(q, at->t, at->n)),
                 .t_1 = vec_scale(inv_length, vec_axpy(-q, at->n, at->t))};
    c.t_2 = vec_cross(c.n, c.t_1);
    c.approach = vec_sub(vec_sub(ball->v, at->v), vec_cross(at->Omega, at->p));
    c.spin = vec_sub(ball->omega, at->Omega);
    c.delta = load.delta;
    c.sqrt_delta = wide_sqrt(wide_max(load.delta, wide_set(0.0)));
    wide rate = length * vec_dot(c.n, c.approach);
    if (in->two) rate = rate - m * in->rate;
    const wide Q = hertz_damped(load.Q, wide_set(model->p->bearing.lambda), rate);
    c.dissipated = (Q - load.Q) * rate;
    c.Q = Q * length;
    *stored = load.U, *P = Q * m;
    contact_motion(ball, at->Omega, &c);
    return c;
}

// Traction with the slip at the contact's middle.
INLINE Tangential point_traction(const Parameters *p, const Contact *c, const Film *film, bool mixed)
{
    const wide slip_2 = vec_dot(c->slip, c->slip) + p->oil.v_0 * p->oil.v_0;
    const wide inv_slip = 1.0 / wide_sqrt(slip_2), s = slip_2 * inv_slip * film->inv_U;
    wide mu;
    traction_mu(p, 1, &s, &film->f_a, mixed, &mu);
    Tangential out;
    out.g = mu * c->Q * inv_slip;
    out.F_s = vec_scale(-out.g, c->slip);
    out.M = vec_cross(vec_scale(c->R, c->n), out.F_s);
    out.dissipated = -vec_dot(out.F_s, c->slip);
    out.g_spin = out.spin_dissipated = wide_set(0.0);
    return out;
}

// What the slices of a contact have in common.  Slip along t_1 and t_2: s_1 + k x + b_1 x^2, s_2 + b_2 x^2.
typedef struct {
    wide s_1, s_2, k, b_1, b_2, inv_U, f_a;
    wide x_0;  // where the ellipse is split
    wide Q;
} SlicedContact;

// A slice: its side, -1 or 1, and coefficients of SLICE.
typedef struct {
    wide side, near, far, w, side_w;
} Slice;

// Sums over the slices of g x^n, g = |traction| / |slip|.  The traction is -g times the slip, and the slip a
// polynomial in x: forces, moments and power follow from these sums.
enum { MOMENTS = 5 };

typedef struct {
    wide of[MOMENTS];
} SliceMoments;

// Place x_0 = -s_1 k/(k^2 + b_1^2) where the slip s_1 + k x + b_1 x^2 changes its sign, within the ellipse.
INLINE wide split_place(wide s_1, wide k, wide b_1)
{
    const wide x_0 = -(s_1 * k) / (k * k + b_1 * b_1 + TINY);
    return wide_max(wide_min(x_0, wide_set(1.0)), wide_set(-1.0));
}

// g x^m of n <= ABREAST packets of slices, slice[i] of contact c[i].
INLINE void slice_tractions(const Parameters *p, int n, const SlicedContact *const c[], const Slice slice[],
                            bool mixed, SliceMoments g[])
{
    wide x[ABREAST], slip_2[ABREAST], inv_slip[ABREAST], s[ABREAST], f_a[ABREAST], mu[ABREAST];
    for (int i = 0; i < n; i++) {
        x[i] = wide_fma(c[i]->x_0, slice[i].near, slice[i].far);
        const wide s_1 = wide_fma(x[i], wide_fma(x[i], c[i]->b_1, c[i]->k), c[i]->s_1);
        const wide s_2 = wide_fma(x[i] * x[i], c[i]->b_2, c[i]->s_2);
        slip_2[i] = wide_fma(s_1, s_1, wide_fma(s_2, s_2, wide_set(p->oil.v_0 * p->oil.v_0)));
    }
    wide_inv_sqrt(n, slip_2, inv_slip);
    for (int i = 0; i < n; i++) s[i] = slip_2[i] * inv_slip[i] * c[i]->inv_U, f_a[i] = c[i]->f_a;
    traction_mu(p, n, s, f_a, mixed, mu);
    for (int i = 0; i < n; i++) {
        const wide half = 1.0 - slice[i].side * c[i]->x_0, load = 0.75 * c[i]->Q * (half * half);
        g[i].of[0] = wide_fma(slice[i].side_w, x[i], slice[i].w) * load * (mu[i] * inv_slip[i]);
        for (int m = 1; m < MOMENTS; m++) g[i].of[m] = g[i].of[m - 1] * x[i];
    }
}

INLINE wide sum_of_three(const SliceMoments g[THIRDS], int m)
{
    return g[0].of[m] + g[1].of[m] + g[2].of[m];
}

// Sums slice by slice, all slices of one side together.
INLINE SliceMoments slice_by_slice(const Parameters *p, const SlicedContact *c, bool mixed)
{
    SliceMoments part[SIDES], out;
    for (int side = 0; side < SIDES; side++) {
        const wide sign = wide_set(side == 0 ? -1.0 : 1.0);
        const SlicedContact *same[ONE_SIDE];
        Slice slice[ONE_SIDE];
        SliceMoments g[ONE_SIDE];
        for (int i = 0; i < ONE_SIDE; i++) {
            const int third = i % THIRDS, three = THREES / SIDES * side + i / THIRDS;
            same[i] = c;
            slice[i] = (Slice){sign, wide_set(SLICE.near[third][three]), wide_set(SLICE.far[third][three]),
                               wide_set(SLICE.w[third][three]), wide_set(SLICE.side_w[third][three])};
        }
        slice_tractions(p, ONE_SIDE, same, slice, mixed, g);
        for (int m = 0; m < MOMENTS; m++)
            part[side].of[m] = sum_of_three(&g[0], m) + sum_of_three(&g[THIRDS], m);
    }
    for (int m = 0; m < MOMENTS; m++) out.of[m] = part[0].of[m] + part[1].of[m];
    return out;
}

// The same sums, in the same order, where a quarter of a packet with four lanes, or half of one with eight,
// has the slices of one contact: THIRDS packets for each lane with a contact among the first four.
INLINE SliceMoments contact_by_contact(const Parameters *p, const SlicedContact *all, int lanes, int balls,
                                       bool mixed)
{
    static const double LANE[ROW] = {0.0, 1.0, 2.0, 3.0, 0.0, 1.0, 2.0, 3.0};
    static const double SIDE[ROW] = {-1.0, -1.0, 1.0, 1.0, -1.0, -1.0, 1.0, 1.0};

    SliceMoments out;
    for (int m = 0; m < MOMENTS; m++) out.of[m] = wide_set(0.0);
    for (int k = 0; k < lanes; k++) {
        const int lane = k % balls + k / balls * (LANE_WIDTH / 2);
        const SlicedContact c = {.s_1 = wide_fill(all->s_1, lane),
                                 .s_2 = wide_fill(all->s_2, lane),
                                 .k = wide_fill(all->k, lane),
                                 .b_1 = wide_fill(all->b_1, lane),
                                 .b_2 = wide_fill(all->b_2, lane),
                                 .inv_U = wide_fill(all->inv_U, lane),
                                 .f_a = wide_fill(all->f_a, lane),
                                 .x_0 = wide_fill(all->x_0, lane),
                                 .Q = wide_fill(all->Q, lane)};
        const SlicedContact *same[THIRDS];
        Slice slice[THIRDS];
        SliceMoments g[THIRDS];
        for (int i = 0; i < THIRDS; i++) {
            same[i] = &c;
            slice[i] = (Slice){wide_load(SIDE), wide_load(SLICE.near[i]), wide_load(SLICE.far[i]),
                               wide_load(SLICE.w[i]), wide_load(SLICE.side_w[i])};
        }
        slice_tractions(p, THIRDS, same, slice, mixed, g);
        const bits here = wide_above(0.5 - wide_abs(wide_load(LANE) - (double)lane), 0.0);
        for (int m = 0; m < MOMENTS; m++)
            out.of[m] = wide_select(here, wide_sum_fours(sum_of_three(g, m)), out.of[m]);
    }
    return out;
}

// Traction over the long axis of the ellipse, of a packet's contacts: `balls` at one race or at each of both.
INLINE Tangential sliced_traction(const Parameters *p, const RaceConstants *race, const Contact *c,
                                  const Film *film, int contacts, int balls, bool mixed)
{
    const wide a = race->a_delta * c->sqrt_delta, sagitta = a * a * race->half_curvature;
    const wide spin_n = vec_dot(c->spin, c->n), k = -(a * spin_n);
    const wide s_1 = vec_dot(c->slip, c->t_1), b_1 = -(sagitta * vec_dot(c->spin, c->t_2));
    const wide s_2 = vec_dot(c->slip, c->t_2), b_2 = sagitta * vec_dot(c->spin, c->t_1);
    const SlicedContact common = {.s_1 = s_1,
                                  .s_2 = s_2,
                                  .k = k,
                                  .b_1 = b_1,
                                  .b_2 = b_2,
                                  .inv_U = film->inv_U,
                                  .f_a = film->f_a,
                                  .x_0 = split_place(s_1, k, b_1),
                                  .Q = c->Q};
    // lanes with contacts among the first four: with fewer than four, contact by contact takes fewer packets
    const int lanes = LANE_WIDTH == 8 ? balls : LANE_WIDTH == 4 ? contacts : THREES;
    const SliceMoments g = lanes < THREES ? contact_by_contact(p, &common, lanes, balls, mixed)
                                          : slice_by_slice(p, &common, mixed);
    // sums of -F_1 x^n and -F_2 x^n, F = -g slip
    wide F_1[3], F_2[3];
    for (int n = 0; n < 3; n++) {
        F_1[n] = wide_fma(b_1, g.of[n + 2], wide_fma(k, g.of[n + 1], s_1 * g.of[n]));
        F_2[n] = wide_fma(b_2, g.of[n + 2], s_2 * g.of[n]);
    }
    // a slice's lever about the ball's centre: (R - sagitta x^2) n + a x t_2
    Tangential out;
    out.g = g.of[0], out.g_spin = a * a * g.of[2];
    out.dissipated =
        wide_fma(s_1, F_1[0], k * F_1[1]) + wide_fma(b_1, F_1[2], wide_fma(s_2, F_2[0], b_2 * F_2[2]));
    const wide spin_M = a * F_1[1];
    out.F_s = vec_axpy(-F_1[0], c->t_1, vec_scale(-F_2[0], c->t_2));
    out.M = vec_axpy(sagitta * F_1[2] - c->R * F_1[0], c->t_2,
                     vec_axpy(c->R * F_2[0] - sagitta * F_2[2], c->t_1, vec_scale(spin_M, c->n)));
    out.spin_dissipated = -(spin_M * spin_n);
    return out;
}

// Films of all packets of contacts, which go through each stage together.
INLINE void race_films(const Model *model, const RaceConstants *const race[CONTACT_PACKETS],
                       const Contact *const c[CONTACT_PACKETS], bool mixed, Film film[CONTACT_PACKETS])
{
    const double U_0 = model->p->oil.U_0;
    wide ln_U[CONTACT_PACKETS], ln_Q[CONTACT_PACKETS];
    for (int i = 0; i < CONTACT_PACKETS; i++) {
        const wide U_2 = vec_dot(c[i]->roll, c[i]->roll) + U_0 * U_0;
        film[i].inv_U = 1.0 / wide_sqrt(U_2);
        film[i].U = U_2 * film[i].inv_U;
    }
    for (int i = 0; i < CONTACT_PACKETS; i++) wide_log2(film[i].U, c[i]->Q + Q_FLOOR, &ln_U[i], &ln_Q[i]);
    for (int i = 0; i < CONTACT_PACKETS; i++)
        film[i].F_R = traction_race_inlet(model->d, race[i]->rolling, film[i].U, ln_U[i], c[i]->Q, ln_Q[i]);
    for (int i = 0; i < CONTACT_PACKETS; i++)
        film[i].f_a =
            mixed ? traction_asperity_share(traction_ln_film(race[i]->ln_Lambda, ln_U[i], ln_Q[i]) +
                                            traction_ln_thermal(wide_set(model->d->ln_thermal), ln_U[i]))
                  : wide_set(0.0);
}

// Traction and the inlet's rolling friction: -F_R U/|U| at the surface, and the film's horizontal pressure
// force +F_H U/|U| through the ball's centre.
INLINE Tangential race_traction(const Model *model, const RaceConstants *race, const Contact *c,
                                const Film *film, int contacts, int balls, bool mixed, bool sliced)
{
    const vec rolling = vec_scale(film->F_R * film->inv_U, c->roll);
    Tangential out = sliced ? sliced_traction(model->p, race, c, film, contacts, balls, mixed)
                            : point_traction(model->p, c, film, mixed);
    out.F_s = vec_sub(out.F_s, rolling);
    out.M = vec_sub(out.M, vec_cross(vec_scale(c->R, c->n), rolling));
    out.F_c = vec_scale(race->horizontal, rolling);
    out.U = film->U;
    out.inlet_dissipated = vec_dot(rolling, c->slip) - vec_dot(out.F_c, c->approach);
    out.dissipated += out.inlet_dissipated;
    return out;
}

INLINE RaceConstants race_constants(const Race *race)
{
    return (RaceConstants){wide_set(race->hertz.a_delta), wide_set(0.5 / race->R_m),
                           wide_set(race->ln_Lambda), wide_set(race->rolling), wide_set(race->horizontal)};
}

INLINE RaceConstants join_races(const RaceConstants *i, const RaceConstants *e)
{
    return (RaceConstants){wide_join(i->a_delta, e->a_delta), wide_join(i->half_curvature, e->half_curvature),
                           wide_join(i->ln_Lambda, e->ln_Lambda), wide_join(i->rolling, e->rolling),
                           wide_join(i->horizontal, e->horizontal)};
}

// What the tractions need of the contacts.
INLINE Contact join_contacts(const Contact *inner, const Contact *outer)
{
    return (Contact){.n = vec_join(inner->n, outer->n),
                     .t_1 = vec_join(inner->t_1, outer->t_1),
                     .t_2 = vec_join(inner->t_2, outer->t_2),
                     .slip = vec_join(inner->slip, outer->slip),
                     .roll = vec_join(inner->roll, outer->roll),
                     .spin = vec_join(inner->spin, outer->spin),
                     .approach = vec_join(inner->approach, outer->approach),
                     .R = wide_join(inner->R, outer->R),
                     .sqrt_delta = wide_join(inner->sqrt_delta, outer->sqrt_delta),
                     .Q = wide_join(inner->Q, outer->Q)};
}

INLINE Tangential last_half(const Tangential *T)
{
    return (Tangential){.F_s = vec_last_half(T->F_s),
                        .F_c = vec_last_half(T->F_c),
                        .M = vec_last_half(T->M),
                        .g = wide_last_half(T->g),
                        .g_spin = wide_last_half(T->g_spin),
                        .U = wide_last_half(T->U),
                        .dissipated = wide_last_half(T->dissipated),
                        .inlet_dissipated = wide_last_half(T->inlet_dissipated),
                        .spin_dissipated = wide_last_half(T->spin_dissipated)};
}

// Tractions of all balls at both races.  If the last packet is at most half full, its contacts at both races share one.
INLINE void race_tractions(const Model *model, const Contact inner[PACKETS], const Contact outer[PACKETS],
                           bool mixed, bool sliced, Tangential T_i[PACKETS], Tangential T_e[PACKETS])
{
    const RaceConstants inner_race = race_constants(&model->d->inner),
                        outer_race = race_constants(&model->d->outer);
    RaceConstants both_races;
    Contact both;
    const RaceConstants *race[CONTACT_PACKETS];
    const Contact *c[CONTACT_PACKETS];
    Film film[CONTACT_PACKETS];
    for (int b = 0; b < CONTACT_PACKETS / 2; b++) {
        race[2 * b] = &inner_race, c[2 * b] = &inner[b];
        race[2 * b + 1] = &outer_race, c[2 * b + 1] = &outer[b];
    }
    if (JOINED) {
        both_races = join_races(&inner_race, &outer_race), both = join_contacts(&inner[WHOLE], &outer[WHOLE]);
        race[2 * WHOLE] = &both_races, c[2 * WHOLE] = &both;
    }
    race_films(model, race, c, mixed, film);
    for (int b = 0; b < WHOLE; b++) {
        T_i[b] =
            race_traction(model, &inner_race, &inner[b], &film[2 * b], LANE_WIDTH, LANE_WIDTH, mixed, sliced);
        T_e[b] = race_traction(model, &outer_race, &outer[b], &film[2 * b + 1], LANE_WIDTH, LANE_WIDTH, mixed,
                               sliced);
    }
    if (JOINED) {
        T_i[WHOLE] =
            race_traction(model, &both_races, &both, &film[2 * WHOLE], 2 * REST, REST, mixed, sliced);
        T_e[WHOLE] = last_half(&T_i[WHOLE]);
    } else if (REST > 0) {
        T_i[WHOLE] =
            race_traction(model, &inner_race, &inner[WHOLE], &film[2 * WHOLE], REST, REST, mixed, sliced);
        T_e[WHOLE] =
            race_traction(model, &outer_race, &outer[WHOLE], &film[2 * WHOLE + 1], REST, REST, mixed, sliced);
    }
}

// Contact results that other elements and outputs read.
INLINE void store_contacts(Work *w, int j, const Contact *inner, const Contact *outer, const Tangential *T_i,
                           const Tangential *T_e)
{
    wide_store(&w->delta_i[j], inner->delta);
    wide_store(&w->delta_e[j], outer->delta);
    wide_store(&w->Q_i[j], inner->Q);
    wide_store(&w->Q_e[j], outer->Q);
    vec_store(inner->n, &w->n_ix[j], &w->n_ir[j], &w->n_it[j]);
    wide_store(&w->n_ex[j], outer->n.x);
    wide_store(&w->n_er[j], outer->n.r);
    wide_store(&w->U_i[j], T_i->U);
    wide_store(&w->U_e[j], T_e->U);
    wide_store(&w->g_i[j], T_i->g);
    wide_store(&w->g_e[j], T_e->g);
    wide_store(&w->g_spin_i[j], T_i->g_spin);
    wide_store(&w->g_spin_e[j], T_e->g_spin);
    const wide dissipated = T_i->dissipated + T_e->dissipated + inner->dissipated + outer->dissipated;
    wide_store(&w->dissipated[j], dissipated);
    wide_store(&w->race_dissipated[j], dissipated);
    wide_store(&w->inlet_dissipated[j], T_i->inlet_dissipated + T_e->inlet_dissipated);
    wide_store(&w->spin_dissipated[j], T_i->spin_dissipated + T_e->spin_dissipated);
}

INLINE BallMotion ball_motion(const Model *model, const Work *w, int j)
{
    return (BallMotion){.x = {wide_load(&w->x[j]), wide_load(&w->r[j]), wide_set(0.0)},
                        .v = vec_load(&w->v_x[j], &w->v_r[j], &w->v_t[j]),
                        .omega = vec_load(&w->omega_x[j], &w->omega_r[j], &w->omega_t[j]),
                        .omega_m = wide_load(&w->omega_m[j]),
                        .R = wide_load(&model->d->R[j])};
}

// Normal contact and motion of a packet of balls at both races.  inner_R_g: radius of the inner groove's
// circle as the ring has grown; outer_ring: its motion, NULL for a ring at rest in its place.
INLINE void race_contacts(const Model *model, const Work *w, int j, scalar inner_R_g, const Rotor *outer_ring,
                          vec *p_i, Contact *inner, Contact *outer)
{
    const Derived *d = model->d;
    const wide cos_theta = wide_load(&w->cos_theta[j]), sin_theta = wide_load(&w->sin_theta[j]);
    const BallMotion ball = ball_motion(model, w, j);
    *p_i = vec_sub(ball.x, vec_local(w->ring.x, cos_theta, sin_theta));
    *inner = race_contact(
        model, &d->inner, &ball, wide_set(inner_R_g), *p_i, vec_local(w->ring.a, cos_theta, sin_theta),
        vec_local(w->ring.v, cos_theta, sin_theta), vec_local(w->ring.Omega, cos_theta, sin_theta));
    *outer = outer_ring == NULL
                 ? outer_contact_at_rest(model, &ball)
                 : race_contact(model, &d->outer, &ball, wide_set(d->outer.R_g),
                                vec_sub(ball.x, vec_local(outer_ring->x, cos_theta, sin_theta)),
                                vec_local(outer_ring->a, cos_theta, sin_theta),
                                vec_local(outer_ring->v, cos_theta, sin_theta),
                                vec_local(outer_ring->Omega, cos_theta, sin_theta));
}

// Forces and moments on a packet of balls, what the pockets add to, wrench on the ring about its centre.
INLINE void store_forces(Work *w, int j, vec p_i, const Contact *inner, const Contact *outer,
                         const Tangential *T_i, const Tangential *T_e)
{
    const wide cos_theta = wide_load(&w->cos_theta[j]), sin_theta = wide_load(&w->sin_theta[j]),
               minus = wide_set(-1.0);
    const vec none = {0};
    const vec F_i = vec_axpy(-inner->Q, inner->n, vec_add(T_i->F_s, T_i->F_c));
    const vec F_e = vec_axpy(-outer->Q, outer->n, vec_add(T_e->F_s, T_e->F_c));
    const vec M_ring = vec_sub(vec_scale(minus, vec_cross(p_i, F_i)), T_i->M);
    vec_store(vec_add(F_i, F_e), &w->F_x[j], &w->F_r[j], &w->F_t[j]);
    vec_store(vec_add(T_i->M, T_e->M), &w->M_x[j], &w->M_r[j], &w->M_t[j]);
    vec_store(none, &w->D_x[j], &w->D_r[j], &w->D_t[j]);
    vec_store(none, &w->D_omega_x[j], &w->D_omega_r[j], &w->D_omega_t[j]);
    wide_store(&w->pocket_dissipated[j], wide_set(0.0));
    vec_to_global(vec_scale(minus, F_i), cos_theta, sin_theta, &w->ring_F_x[j], &w->ring_F_y[j],
                  &w->ring_F_z[j]);
    vec_to_global(M_ring, cos_theta, sin_theta, &w->ring_M_x[j], &w->ring_M_y[j], &w->ring_M_z[j]);
}

INLINE void race_contact_balls(const Model *model, Work *w, scalar inner_R_g, bool mixed, bool sliced,
                               const Rotor *outer_ring)
{
    vec p_i[PACKETS];
    Contact inner[PACKETS], outer[PACKETS];
    Tangential T_i[PACKETS], T_e[PACKETS];
    for (int b = 0; b < PACKETS; b++)
        race_contacts(model, w, b * LANE_WIDTH, inner_R_g, outer_ring, &p_i[b], &inner[b], &outer[b]);
    race_tractions(model, inner, outer, mixed, sliced, T_i, T_e);
    for (int b = 0; b < PACKETS; b++) {
        store_contacts(w, b * LANE_WIDTH, &inner[b], &outer[b], &T_i[b], &T_e[b]);
        store_forces(w, b * LANE_WIDTH, p_i[b], &inner[b], &outer[b], &T_i[b], &T_e[b]);
    }
}

// Balls of a bearing whose outer ring moves.
static __attribute__((noinline)) void race_contact_force_moving(const Model *model, Work *w, scalar inner_R_g,
                                                                bool mixed, bool sliced)
{
    const Rotor outer = outer_ring(model->ring_load);
    race_contact_balls(model, w, inner_R_g, mixed, sliced, &outer);
}

// The ring, with body axes that have turned by the angle.
static Rotor turned(const Rotor *ring, scalar angle)
{
    Rotor out = *ring;
    wide sine, cosine;
    wide_sincos(wide_set(angle), &sine, &cosine);
    rotor_body_axes(&out, wide_lane(cosine, 0), wide_lane(sine, 0));
    return out;
}

// Places of all balls on a race whose ring has body axes that turn with it.
INLINE void surface_places(const Model *model, const Work *w, wide R_g, const Rotor *ring,
                           SurfacePlace at[PACKETS])
{
    for (int b = 0; b < PACKETS; b++) {
        const int j = b * LANE_WIDTH;
        const BallMotion ball = ball_motion(model, w, j);
        at[b] = surface_place(&ball, R_g, ring, wide_load(&w->cos_theta[j]), wide_load(&w->sin_theta[j]));
    }
}

// Contacts of all balls with a race; cosine, sine, rate: of their spalls' angles from the contact, two: whether there are
// any; stored: elastic energies, P: moments on the balls by their spalls.
INLINE void surface_contacts(const Model *model, const Work *w, const Race *race,
                             const SurfacePlace at[PACKETS], bool two, const wide cosine[PACKETS],
                             const wide sine[PACKETS], const wide rate[PACKETS], Contact c[PACKETS],
                             wide stored[PACKETS], wide P[PACKETS])
{
    wide cos_phi[PACKETS], sin_phi[PACKETS], height[PACKETS], slope[PACKETS];
    for (int b = 0; b < PACKETS; b++) cos_phi[b] = at[b].cos_phi, sin_phi[b] = at[b].sin_phi;
    race_surface_waves(&race->surface, cos_phi, sin_phi, height, slope);
    for (int b = 0; b < PACKETS; b++) {
        const BallMotion ball = ball_motion(model, w, b * LANE_WIDTH);
        const wide none = wide_set(0.0);
        SpallPlace in = {.f = none, .df = none, .f_ball = none, .df_ball = none, .two = two};
        in.race = race_spall(&race->surface);
        in.ball = (SpallLanes){none, none, none, none, none, none, none, none};
        if (race->surface.spalled) race_surface_drop(&race->surface, cos_phi[b], sin_phi[b], &in.f, &in.df);
        if (two) {
            in.ball = ball_spall(race, ball.R, b * LANE_WIDTH);
            spall_drop(&in.ball, cosine[b], sine[b], &in.f_ball, &in.df_ball);
            in.rate = rate[b];
        }
        c[b] = surface_contact(model, race, &ball, &at[b], height[b], slope[b], &in, &stored[b], &P[b]);
    }
}

// What the turn of a ball needs of its place on a race.
INLINE RollingPlace rolling_place(const SurfacePlace *at, const BallMotion *ball)
{
    return (RollingPlace){.n = at->n,
                          .t = at->t,
                          .a = at->a,
                          .approach = vec_sub(vec_sub(ball->v, at->v), vec_cross(at->Omega, at->p)),
                          .spin = vec_sub(ball->omega, at->Omega),
                          .r = at->r,
                          .cos_phi = at->cos_phi,
                          .sin_phi = at->sin_phi,
                          .s = at->s};
}

// Balls between races that are not perfect, or with spalls (two).
INLINE void rough_balls(const Model *model, Work *w, scalar inner_R_g, bool mixed, bool sliced, bool two)
{
    const RingLoad *given = model->ring_load;
    const Derived *d = model->d;
    const Rotor at_rest = outer_ring(given);
    const Rotor inner_ring = turned(&w->ring, given->inner_angle),
                outer = turned(&at_rest, given->outer_angle);
    SurfacePlace at_i[PACKETS], at_e[PACKETS];
    surface_places(model, w, wide_set(inner_R_g), &inner_ring, at_i);
    surface_places(model, w, wide_set(d->outer.R_g), &outer, at_e);

    // turns of the balls
    RollingPlace i[PACKETS], e[PACKETS];
    BallRoll roll[PACKETS];
    wide cos_i[PACKETS], sin_i[PACKETS], rate_i[PACKETS], cos_e[PACKETS], sin_e[PACKETS], rate_e[PACKETS];
    for (int b = 0; two && b < PACKETS; b++) {
        const int j = b * LANE_WIDTH;
        const BallMotion ball = ball_motion(model, w, j);
        i[b] = rolling_place(&at_i[b], &ball), e[b] = rolling_place(&at_e[b], &ball);
        roll[b] = ball_roll(&i[b], &e[b], ball_angles(model, j), given->inner_angle - given->outer_angle);
        cos_i[b] = roll[b].cos_i, sin_i[b] = roll[b].sin_i, rate_i[b] = roll[b].rate_i;
        cos_e[b] = roll[b].cos_e, sin_e[b] = roll[b].sin_e, rate_e[b] = roll[b].rate_e;
        wide_store(&w->turn_rate[j], rate_e[b]);
    }

    Contact inner_contact[PACKETS], outer_contact[PACKETS];
    Tangential T_i[PACKETS], T_e[PACKETS];
    wide stored_i[PACKETS], stored_e[PACKETS], P_i[PACKETS], P_e[PACKETS];
    surface_contacts(model, w, &d->inner, at_i, two, cos_i, sin_i, rate_i, inner_contact, stored_i, P_i);
    surface_contacts(model, w, &d->outer, at_e, two, cos_e, sin_e, rate_e, outer_contact, stored_e, P_e);
    race_tractions(model, inner_contact, outer_contact, mixed, sliced, T_i, T_e);
    for (int b = 0; b < PACKETS; b++) {
        if (two) add_ball_spalls(&roll[b], &i[b], &e[b], P_i[b], P_e[b], &T_i[b], &T_e[b]);
        wide_store(&w->race_stored[b * LANE_WIDTH], stored_i[b] + stored_e[b]);
        store_contacts(w, b * LANE_WIDTH, &inner_contact[b], &outer_contact[b], &T_i[b], &T_e[b]);
        store_forces(w, b * LANE_WIDTH, at_i[b].p, &inner_contact[b], &outer_contact[b], &T_i[b], &T_e[b]);
    }
}

static __attribute__((noinline)) void race_contact_force_rough(const Model *model, Work *w, scalar inner_R_g,
                                                               bool mixed, bool sliced)
{
    rough_balls(model, w, inner_R_g, mixed, sliced, false);
}

static __attribute__((noinline)) void race_contact_force_spalled(const Model *model, Work *w,
                                                                 scalar inner_R_g, bool mixed, bool sliced)
{
    rough_balls(model, w, inner_R_g, mixed, sliced, true);
}

void race_contact_force(const Model *model, Work *w)
{
    const bool mixed = model->p->scene.lubrication == LUBRICATION_MIXED;
    const bool sliced = model->p->scene.traction == TRACTION_SLICED;
    const scalar growth = ring_fit_growth(&model->d->fit, ring_fit_speed(model->ring_load));
    const scalar R_g = model->d->inner.R_g + growth;
    if (model->d->spalled)
        race_contact_force_spalled(model, w, R_g, mixed, sliced);
    else if (model->d->rough)
        race_contact_force_rough(model, w, R_g, mixed, sliced);
    else if (outer_ring_moves(model->ring_load))
        race_contact_force_moving(model, w, R_g, mixed, sliced);
    else if (sliced)
        mixed ? race_contact_balls(model, w, R_g, true, true, NULL)
              : race_contact_balls(model, w, R_g, false, true, NULL);
    else
        mixed ? race_contact_balls(model, w, R_g, true, false, NULL)
              : race_contact_balls(model, w, R_g, false, false, NULL);
}

scalar race_growth_power(const Model *model, const Work *w)
{
    const RingLoad *load = model->ring_load;
    const Rotor *ring = &w->ring;
    const double K = model->d->inner.hertz.K;
    scalar force = 0.0;  // of the balls against the growing groove, elastic
    for (int j = 0; j < Z; j++) {
        const scalar c = w->cos_theta[j], s = w->sin_theta[j];
        const scalar p[3] = {w->x[j] - ring->x[0], w->r[j] * c - ring->x[1], w->r[j] * s - ring->x[2]};
        const scalar n[3] = {w->n_ix[j], w->n_ir[j] * c - w->n_it[j] * s, w->n_ir[j] * s + w->n_it[j] * c};
        const scalar along = dot3(p, ring->a), radius = scalar_sqrt(dot3(p, p) - along * along);
        if (!(scalar_value(w->delta_i[j]) > 0.0)) continue;
        const scalar Q = K * w->delta_i[j] * scalar_sqrt(w->delta_i[j]);
        force -= Q * ((dot3(n, p) - along * dot3(n, ring->a)) / radius);
    }
    return force *
           ring_fit_rate(&model->d->fit, ring_fit_speed(load), load->omega_dot + load->frame_omega_dot);
}
