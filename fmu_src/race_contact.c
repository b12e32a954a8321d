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
// No offset or tilt is taken as small: the geometry is exact, so that the normal forces derive from a
// potential.
//
// Slip and mean speed at the contact point p + R n, seen from the frame that orbits with the ball:
//   u_ball = (omega_ball - omega_m e_x) x R n,   u_race = v_ring + Omega x (p + R n) - v_ball - omega_m e_x x R n
//   Delta u = u_ball - u_race,   U = (u_ball + u_race)/2     (their parts in the tangent plane)
// The ring gets the opposite forces at the same points: force -F, moment -(p x F) - M about its centre.  Spin
// and curvature let the slip vary along the long axis of the ellipse; `sliced` integrates the traction over this axis:
//   Delta u(xi) = Delta u + Delta omega x (xi t_2 - xi^2/(2 R_m) n),  pressure (3/4)(1 - xi^2/a^2) per length
// in slices on both sides of where the slip changes its sign, because the traction is nearly a step there.  With x = xi/a
// the slip along t_1 is s_1 + k x + b_1 x^2; the place is x_0 = -s_1 k/(k^2 + b_1^2), not beyond the ends.  That is the
// root where spin (k) outweighs curvature (b_1); the two roots of curvature lie about the middle, which x_0 tends to.
// Smoothness: C1 at touch-down.  Hertz' ellipse is not cut at the shoulder.
#include "race_contact.h"

#include "hertz.h"
#include "outer_ring.h"
#include "ring_fit.h"
#include "traction.h"

// Slices on both sides of the place x_0 that splits the ellipse, x = xi/a in [-1, 1]: x = x_0 (1 - z) + side z with
// weights (3/4)(1 + side x)(1 - side x_0)^2 w, where z and w are Gauss-Jacobi's points for the weight 1 - z on [0, 1].
// They integrate the pressure (3/4)(1 - x^2) times polynomials up to degree 10 on each side exactly.
enum { SLICES = 12, SLICES_ROOM = 16 };  // whole packets, the last slices without weight

static const struct {
    double side[SLICES_ROOM], z[SLICES_ROOM], w[SLICES_ROOM];
} SLICE = {
    {-1.0, -1.0, -1.0, -1.0, -1.0, -1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0},
    {0.02931642715978494, 0.1480785996684843, 0.3369846902811543, 0.5586715187715502, 0.7692338620300545,
     0.926945671319741, 0.02931642715978494, 0.1480785996684843, 0.3369846902811543, 0.5586715187715502,
     0.7692338620300545, 0.926945671319741},
    {0.0723103307255089, 0.13554249723151868, 0.14079255378819883, 0.0986611508906552, 0.04395516555050896,
     0.008738301813609529, 0.0723103307255089, 0.13554249723151868, 0.14079255378819883, 0.0986611508906552,
     0.04395516555050896, 0.008738301813609529},
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

// One race.  R_g: present radius of the circle of groove centres; p: from the centre of the ring to that of the ball; a, v, Omega: axis, velocity and angular
// velocity of the ring.  All vectors are in the frames of the balls.
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

    // velocities at the contact point against the ball's centre, seen from the orbiting frame
    const vec arm = vec_scale(ball->R, c.n), axis = {ball->omega_m, wide_set(0.0), wide_set(0.0)};
    const vec u_ball = vec_cross(ball->omega, arm), orbit = vec_cross(axis, arm);
    const vec u_race = vec_sub(vec_cross(Omega, arm), c.approach);  // v + Omega x (p + arm) - v_ball
    c.slip = vec_across(vec_sub(u_ball, u_race), c.n);
    c.roll =
        vec_across(vec_axpy(wide_set(-1.0), orbit, vec_scale(wide_set(0.5), vec_add(u_ball, u_race))), c.n);
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

// Traction with the slip at the contact's middle.
INLINE Tangential point_traction(const Parameters *p, const Contact *c, wide inv_U, wide f_a, bool mixed)
{
    const wide slip_2 = vec_dot(c->slip, c->slip) + p->oil.v_0 * p->oil.v_0;
    const wide inv_slip = 1.0 / wide_sqrt(slip_2);
    Tangential out = {0};
    out.g = traction_mu(p, slip_2 * inv_slip * inv_U, f_a, mixed) * c->Q * inv_slip;
    out.F_s = vec_scale(-out.g, c->slip);
    out.M = vec_cross(vec_scale(c->R, c->n), out.F_s);
    out.dissipated = -vec_dot(out.F_s, c->slip);
    return out;
}

// What the slices of a contact have in common.  Slip along t_1 and t_2: s_1 + k x + b_1 x^2, s_2 + b_2 x^2.
typedef struct {
    wide s_1, s_2, k, b_1, b_2, Q, inv_U, f_a;
    wide x_0;  // where the ellipse is split
} SlicedContact;

// What a slice adds, and the sums over the slices: coefficient g and its second moment, power, forces -F_1, -F_2 and their
// moments over x.
typedef struct {
    wide g, g_xx, dissipated, F_1, F_2, F_1x, F_1xx, F_2xx;
} SliceTraction;

enum { SUMS = sizeof(SliceTraction) / sizeof(wide) };

// Place x_0 = -s_1 k/(k^2 + b_1^2) where the slip changes its sign, within the ellipse.
INLINE wide split_place(const SlicedContact *c)
{
    const wide x_0 = -(c->s_1 * c->k) / (c->k * c->k + c->b_1 * c->b_1 + TINY);
    return wide_max(wide_min(x_0, wide_set(1.0)), wide_set(-1.0));
}

INLINE SliceTraction slice_traction(const Parameters *p, const SlicedContact *c, wide side, wide z, wide w,
                                    bool mixed)
{
    const wide x = c->x_0 * (1.0 - z) + side * z, xx = x * x, half = 1.0 - side * c->x_0;
    const wide part = (1.0 + side * x) * (0.75 * (half * half) * w);
    const wide s_1 = c->s_1 + x * c->k + xx * c->b_1, s_2 = c->s_2 + xx * c->b_2;
    const wide slip_2 = s_1 * s_1 + s_2 * s_2 + p->oil.v_0 * p->oil.v_0, inv_slip = 1.0 / wide_sqrt(slip_2);
    const wide g = part * traction_mu(p, slip_2 * inv_slip * c->inv_U, c->f_a, mixed) * c->Q * inv_slip;
    const wide F_1 = g * s_1, F_2 = g * s_2;
    return (SliceTraction){g, g * xx, F_1 * s_1 + F_2 * s_2, F_1, F_2, F_1 * x, F_1 * xx, F_2 * xx};
}

// Adds the values in the lanes to the sums of a ball, one lane after the other as they come slice by slice.
static __attribute__((noinline)) void add_lanes(const SliceTraction *slices, scalar sum[SUMS])
{
    scalar of[LANE_WIDTH][SUMS], lanes[SUMS][LANE_WIDTH];
    memcpy(lanes, slices, sizeof lanes);
    for (int n = 0; n < SUMS; n++)
        for (int i = 0; i < LANE_WIDTH; i++) of[i][n] = lanes[n][i];
    for (int i = 0; i < LANE_WIDTH; i++)
        for (int n = 0; n < SUMS; n += LANE_WIDTH)
            wide_store(&sum[n], wide_load(&sum[n]) + wide_load(&of[i][n]));
}

// Sums over the slices, which lie side by side in a packet, for one ball after the other.  Where a packet has few
// balls this takes fewer packets than slice by slice.
INLINE SliceTraction ball_by_ball(const Parameters *p, const SlicedContact *all, int balls, bool mixed)
{
    enum { COMMON = sizeof *all / sizeof(wide) };

    scalar common[COMMON][LANE_WIDTH], sum[LANE_WIDTH][SUMS] = {{0.0}}, sums[SUMS][LANE_WIDTH];
    memcpy(common, all, sizeof common);
    for (int ball = 0; ball < balls; ball++) {
        wide one[COMMON];
        SlicedContact c;
        for (int i = 0; i < COMMON; i++) one[i] = wide_set(common[i][ball]);
        memcpy(&c, one, sizeof c);
        for (int i = 0; i < SLICES; i += LANE_WIDTH) {
            const SliceTraction s = slice_traction(p, &c, wide_load(&SLICE.side[i]), wide_load(&SLICE.z[i]),
                                                   wide_load(&SLICE.w[i]), mixed);
            add_lanes(&s, sum[ball]);
        }
    }
    for (int n = 0; n < SUMS; n++)
        for (int ball = 0; ball < LANE_WIDTH; ball++) sums[n][ball] = sum[ball][n];
    SliceTraction out;
    memcpy(&out, sums, sizeof out);
    return out;
}

INLINE SliceTraction slice_by_slice(const Parameters *p, const SlicedContact *c, bool mixed)
{
    SliceTraction out = {0};
    for (int i = 0; i < SLICES; i++) {
        const SliceTraction s =
            slice_traction(p, c, wide_set(SLICE.side[i]), wide_set(SLICE.z[i]), wide_set(SLICE.w[i]), mixed);
        out.g += s.g, out.g_xx += s.g_xx, out.dissipated += s.dissipated;
        out.F_1 += s.F_1, out.F_1x += s.F_1x, out.F_1xx += s.F_1xx;
        out.F_2 += s.F_2, out.F_2xx += s.F_2xx;
    }
    return out;
}

// Traction over the long axis of the ellipse, of a packet with a number of balls.
INLINE Tangential sliced_traction(const Parameters *p, const Race *race, const Contact *c, int balls,
                                  wide inv_U, wide f_a, bool mixed)
{
    const wide a = race->hertz.a_delta * c->sqrt_delta, sagitta = a * a * (0.5 / race->R_m);
    const wide spin_n = vec_dot(c->spin, c->n);
    SlicedContact common = {.s_1 = vec_dot(c->slip, c->t_1),
                            .s_2 = vec_dot(c->slip, c->t_2),
                            .k = -(a * spin_n),
                            .b_1 = -(sagitta * vec_dot(c->spin, c->t_2)),
                            .b_2 = sagitta * vec_dot(c->spin, c->t_1),
                            .Q = c->Q,
                            .inv_U = inv_U,
                            .f_a = f_a};
    common.x_0 = split_place(&common);
    const SliceTraction sum = balls * ((SLICES + LANE_WIDTH - 1) / LANE_WIDTH) < SLICES
                                  ? ball_by_ball(p, &common, balls, mixed)
                                  : slice_by_slice(p, &common, mixed);
    // a slice's lever about the ball's centre: (R - sagitta x^2) n + a x t_2
    Tangential out = {.g = sum.g, .g_spin = a * a * sum.g_xx, .dissipated = sum.dissipated};
    const wide spin_M = a * sum.F_1x;
    out.F_s = vec_axpy(-sum.F_1, c->t_1, vec_scale(-sum.F_2, c->t_2));
    out.M = vec_axpy(sagitta * sum.F_1xx - c->R * sum.F_1, c->t_2,
                     vec_axpy(c->R * sum.F_2 - sagitta * sum.F_2xx, c->t_1, vec_scale(spin_M, c->n)));
    out.spin_dissipated = -(spin_M * spin_n);
    return out;
}

// Traction and the inlet's rolling friction: -F_R U/|U| at the surface, and the film's horizontal pressure
// force +F_H U/|U| through the ball's centre.
INLINE Tangential race_traction(const Model *model, const Race *race, const Contact *c, int balls, bool mixed,
                                bool sliced)
{
    const Parameters *p = model->p;
    const wide U_2 = vec_dot(c->roll, c->roll) + p->oil.U_0 * p->oil.U_0, inv_U = 1.0 / wide_sqrt(U_2);
    wide ln_U, ln_Q;
    wide_log2(U_2 * inv_U, c->Q + Q_FLOOR, &ln_U, &ln_Q);
    wide f_a = wide_set(0.0);
    if (mixed)
        f_a = traction_asperity_share(traction_ln_film(wide_set(race->ln_Lambda), ln_U, ln_Q) +
                                      traction_ln_thermal(wide_set(model->d->ln_thermal), ln_U));
    const wide F_R = traction_race_inlet(model->d, wide_set(race->rolling), U_2 * inv_U, ln_U, c->Q, ln_Q);
    const vec rolling = vec_scale(F_R * inv_U, c->roll);

    Tangential out = sliced ? sliced_traction(p, race, c, balls, inv_U, f_a, mixed)
                            : point_traction(p, c, inv_U, f_a, mixed);
    out.F_s = vec_sub(out.F_s, rolling);
    out.M = vec_sub(out.M, vec_cross(vec_scale(c->R, c->n), rolling));
    out.F_c = vec_scale(wide_set(race->horizontal), rolling);
    out.U = U_2 * inv_U;
    out.inlet_dissipated = vec_dot(rolling, c->slip) - vec_dot(out.F_c, c->approach);
    out.dissipated += out.inlet_dissipated;
    return out;
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

// Both race contacts of a packet of balls.  inner_R_g: radius of the inner groove's circle as the ring has grown;
// outer_ring: its motion, NULL for a ring at rest in its place.
INLINE void race_contact_packet(const Model *model, Work *w, int j, scalar inner_R_g, bool mixed, bool sliced,
                                const Rotor *outer_ring)
{
    const Derived *d = model->d;
    const wide cos_theta = wide_load(&w->cos_theta[j]), sin_theta = wide_load(&w->sin_theta[j]);
    const wide minus = wide_set(-1.0);
    const BallMotion ball = {.x = {wide_load(&w->x[j]), wide_load(&w->r[j]), wide_set(0.0)},
                             .v = vec_load(&w->v_x[j], &w->v_r[j], &w->v_t[j]),
                             .omega = vec_load(&w->omega_x[j], &w->omega_r[j], &w->omega_t[j]),
                             .omega_m = wide_load(&w->omega_m[j]),
                             .R = wide_load(&d->R[j])};
    const vec p_i = vec_sub(ball.x, vec_local(w->ring.x, cos_theta, sin_theta));
    const Contact inner = race_contact(
        model, &d->inner, &ball, wide_set(inner_R_g), p_i, vec_local(w->ring.a, cos_theta, sin_theta),
        vec_local(w->ring.v, cos_theta, sin_theta), vec_local(w->ring.Omega, cos_theta, sin_theta));
    const Contact outer = outer_ring == NULL
                              ? outer_contact_at_rest(model, &ball)
                              : race_contact(model, &d->outer, &ball, wide_set(d->outer.R_g),
                                             vec_sub(ball.x, vec_local(outer_ring->x, cos_theta, sin_theta)),
                                             vec_local(outer_ring->a, cos_theta, sin_theta),
                                             vec_local(outer_ring->v, cos_theta, sin_theta),
                                             vec_local(outer_ring->Omega, cos_theta, sin_theta));
    const int balls = Z - j < LANE_WIDTH ? Z - j : LANE_WIDTH;
    const Tangential T_i = race_traction(model, &d->inner, &inner, balls, mixed, sliced);
    const Tangential T_e = race_traction(model, &d->outer, &outer, balls, mixed, sliced);
    store_contacts(w, j, &inner, &outer, &T_i, &T_e);

    // forces and moments on the balls, what the pockets add to, wrench on the ring about its centre
    const vec none = {0};
    const vec F_i = vec_axpy(-inner.Q, inner.n, vec_add(T_i.F_s, T_i.F_c));
    const vec F_e = vec_axpy(-outer.Q, outer.n, vec_add(T_e.F_s, T_e.F_c));
    const vec M_ring = vec_sub(vec_scale(minus, vec_cross(p_i, F_i)), T_i.M);
    vec_store(vec_add(F_i, F_e), &w->F_x[j], &w->F_r[j], &w->F_t[j]);
    vec_store(vec_add(T_i.M, T_e.M), &w->M_x[j], &w->M_r[j], &w->M_t[j]);
    vec_store(none, &w->D_x[j], &w->D_r[j], &w->D_t[j]);
    vec_store(none, &w->D_omega_x[j], &w->D_omega_r[j], &w->D_omega_t[j]);
    wide_store(&w->pocket_dissipated[j], wide_set(0.0));
    vec_to_global(vec_scale(minus, F_i), cos_theta, sin_theta, &w->ring_F_x[j], &w->ring_F_y[j],
                  &w->ring_F_z[j]);
    vec_to_global(M_ring, cos_theta, sin_theta, &w->ring_M_x[j], &w->ring_M_y[j], &w->ring_M_z[j]);
}

// Balls of a bearing whose outer ring moves.
static __attribute__((noinline)) void race_contact_force_moving(const Model *model, Work *w, scalar inner_R_g,
                                                                bool mixed, bool sliced)
{
    const Rotor outer = outer_ring(model->ring_load);
    for (int b = 0; b < PACKETS; b++)
        race_contact_packet(model, w, b * LANE_WIDTH, inner_R_g, mixed, sliced, &outer);
}

void race_contact_force(const Model *model, Work *w)
{
    const bool mixed = model->p->scene.lubrication == LUBRICATION_MIXED;
    const bool sliced = model->p->scene.traction == TRACTION_SLICED;
    const scalar growth = ring_fit_growth(&model->d->fit, ring_fit_speed(model->ring_load));
    const scalar R_g = model->d->inner.R_g + growth;
    if (outer_ring_moves(model->ring_load)) {
        race_contact_force_moving(model, w, R_g, mixed, sliced);
        return;
    }
    for (int b = 0; b < PACKETS; b++) {
        const int j = b * LANE_WIDTH;
        if (sliced)
            mixed ? race_contact_packet(model, w, j, R_g, true, true, NULL)
                  : race_contact_packet(model, w, j, R_g, false, true, NULL);
        else
            mixed ? race_contact_packet(model, w, j, R_g, true, false, NULL)
                  : race_contact_packet(model, w, j, R_g, false, false, NULL);
    }
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
