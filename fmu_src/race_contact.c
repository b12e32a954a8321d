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
// and curvature let the slip vary along the long axis of the ellipse; `sliced` and `fine` integrate the traction over
// this axis:
//   Delta u(xi) = Delta u + Delta omega x (xi t_2 - xi^2/(2 R_m) n),  pressure (3/4)(1 - xi^2/a^2) per length
// Smoothness: C1 at touch-down.  Hertz' ellipse is not cut at the shoulder.
#include "race_contact.h"

#include "hertz.h"
#include "outer_ring.h"
#include "ring_fit.h"
#include "traction.h"

enum { MOST_SLICES = 21 };

// Gauss-Jacobi points and weights for the weight (3/4)(1 - s^2) on [-1, 1]: exact to degree 2 count - 1.
typedef struct {
    int count;
    double place[MOST_SLICES], share[MOST_SLICES];
} SliceRule;

static const SliceRule SLICED = {
    7,
    {-0.8997579954114603, -0.6771862795107377, -0.36311746382617816, 0.0, 0.36311746382617816,
     0.6771862795107377, 0.8997579954114603},
    {0.02363715011287406, 0.11148030343755763, 0.22556281855841187, 0.27863945578231275, 0.22556281855841187,
     0.11148030343755763, 0.02363715011287406},
};

static const SliceRule FINE = {
    21,
    {-0.9855271558787326,
     -0.9517579557107102,
     -0.899458558040345,
     -0.8296510966512859,
     -0.7436950411720606,
     -0.6432636444601362,
     -0.5303117711368441,
     -0.40703793791447485,
     -0.27584154894579305,
     -0.1392762040406684,
     0.0,
     0.1392762040406684,
     0.27584154894579305,
     0.40703793791447485,
     0.5303117711368441,
     0.6432636444601362,
     0.7436950411720606,
     0.8296510966512859,
     0.899458558040345,
     0.9517579557107102,
     0.9855271558787326},
    {0.000522609936244575, 0.003048976197285311, 0.008773236816095601, 0.018264887456477585,
     0.03133917965857063,  0.047060695089807925, 0.06387929073723633,  0.07987539351053403,
     0.09307267139929828,  0.10176439169366946,  0.10479733500956052,  0.10176439169366946,
     0.09307267139929828,  0.07987539351053403,  0.06387929073723633,  0.047060695089807925,
     0.03133917965857063,  0.018264887456477585, 0.008773236816095601, 0.003048976197285311,
     0.000522609936244575},
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

// What the slices of a contact have in common.
typedef struct {
    vec n, t_1, t_2, slip, bend;
    wide R, a, spin_n, Q, inv_U, f_a;
} SlicedContact;

// What a slice adds: coefficient, force, moment about the ball's centre, power.
typedef struct {
    wide g, g_spin, dissipated;
    vec F, M;
} SliceTraction;

INLINE SliceTraction slice_traction(const Parameters *p, const Race *race, const SlicedContact *c, wide place,
                                    wide part, bool mixed)
{
    const wide xi = c->a * place, sagitta = xi * xi * (0.5 / race->R_m);
    const vec slip = vec_axpy(-sagitta, c->bend, vec_axpy(-xi * c->spin_n, c->t_1, c->slip));
    const wide slip_2 = vec_dot(slip, slip) + p->oil.v_0 * p->oil.v_0;
    const wide inv_slip = 1.0 / wide_sqrt(slip_2);
    const wide g = part * traction_mu(p, slip_2 * inv_slip * c->inv_U, c->f_a, mixed) * c->Q * inv_slip;
    const vec F = vec_scale(-g, slip), arm = vec_axpy(xi, c->t_2, vec_scale(c->R - sagitta, c->n));
    return (SliceTraction){g, g * xi * xi, vec_dot(F, slip), F, vec_cross(arm, F)};
}

enum { SUMS = 9, SUMS_ROOM = 16 };  // of the slices of a contact; whole packets

// Adds the values in the first `count` lanes to the sums of a ball, one lane after the other as they come slice by slice.
static __attribute__((noinline)) void add_lanes(const wide value[SUMS], int count, scalar sum[SUMS_ROOM])
{
    scalar of[LANE_WIDTH][SUMS_ROOM] = {{0.0}};
    for (int n = 0; n < SUMS; n++) {
        scalar lanes[LANE_WIDTH];
        wide_store(lanes, value[n]);
        for (int i = 0; i < LANE_WIDTH; i++) of[i][n] = lanes[i];
    }
    for (int i = 0; i < LANE_WIDTH && i < count; i++)
        for (int n = 0; n < SUMS_ROOM; n += LANE_WIDTH)
            wide_store(&sum[n], wide_load(&sum[n]) + wide_load(&of[i][n]));
}

// Sums over the slices, which lie side by side in a packet, for one ball after the other.  Where a packet has few
// balls this takes fewer packets than slice by slice.
INLINE void ball_by_ball(const Parameters *p, const Race *race, const SlicedContact *all, int balls,
                         bool mixed, const SliceRule *rule, Tangential *out)
{
    enum { MOST = MOST_SLICES + LANE_WIDTH, COMMON = sizeof *all / sizeof(wide) };

    scalar place[MOST] = {0.0}, part[MOST] = {0.0};
    for (int i = 0; i < rule->count; i++) place[i] = rule->place[i], part[i] = rule->share[i];
    scalar common[COMMON][LANE_WIDTH], sum[LANE_WIDTH][SUMS_ROOM] = {{0.0}};
    memcpy(common, all, sizeof common);
    for (int ball = 0; ball < balls; ball++) {
        wide one[COMMON];
        SlicedContact c;
        for (int i = 0; i < COMMON; i++) one[i] = wide_set(common[i][ball]);
        memcpy(&c, one, sizeof c);
        for (int first = 0; first < rule->count; first += LANE_WIDTH) {
            const SliceTraction s =
                slice_traction(p, race, &c, wide_load(&place[first]), wide_load(&part[first]), mixed);
            const wide value[SUMS] = {s.g, s.g_spin, -s.dissipated, s.F.x, s.F.r, s.F.t, s.M.x, s.M.r, s.M.t};
            add_lanes(value, rule->count - first, sum[ball]);
        }
    }
    scalar all_balls[SUMS][LANE_WIDTH];
    for (int n = 0; n < SUMS; n++)
        for (int ball = 0; ball < LANE_WIDTH; ball++) all_balls[n][ball] = sum[ball][n];
    out->g = wide_load(all_balls[0]), out->g_spin = wide_load(all_balls[1]);
    out->dissipated = wide_load(all_balls[2]);
    out->F_s = vec_load(all_balls[3], all_balls[4], all_balls[5]);
    out->M = vec_load(all_balls[6], all_balls[7], all_balls[8]);
}

// Traction over the long axis of the ellipse, of a packet with a number of balls.
INLINE Tangential sliced_traction(const Parameters *p, const Race *race, const Contact *c, int balls,
                                  wide inv_U, wide f_a, bool mixed, const SliceRule *rule)
{
    const wide a = race->hertz.a_delta * c->sqrt_delta, spin_n = vec_dot(c->spin, c->n);
    const vec bend = vec_cross(c->spin, c->n);  // has parts along t_1 and t_2 only
    const SlicedContact common = {c->n, c->t_1, c->t_2, c->slip, bend, c->R, a, spin_n, c->Q, inv_U, f_a};
    Tangential out = {0};
    if (balls * ((rule->count + LANE_WIDTH - 1) / LANE_WIDTH) < rule->count)
        ball_by_ball(p, race, &common, balls, mixed, rule, &out);
    else
        for (int i = 0; i < rule->count; i++) {
            const SliceTraction s =
                slice_traction(p, race, &common, wide_set(rule->place[i]), wide_set(rule->share[i]), mixed);
            out.g += s.g;
            out.g_spin += s.g_spin;
            out.F_s = vec_add(out.F_s, s.F);
            out.M = vec_add(out.M, s.M);
            out.dissipated -= s.dissipated;
        }
    out.spin_dissipated = -(vec_dot(out.M, c->n) * spin_n);
    return out;
}

// Traction and the inlet's rolling friction: -F_R U/|U| at the surface, and the film's horizontal pressure
// force +F_H U/|U| through the ball's centre.
INLINE Tangential race_traction(const Model *model, const Race *race, const Contact *c, int balls, bool mixed,
                                const SliceRule *rule)
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

    Tangential out = rule ? sliced_traction(p, race, c, balls, inv_U, f_a, mixed, rule)
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
INLINE void race_contact_packet(const Model *model, Work *w, int j, scalar inner_R_g, bool mixed,
                                const SliceRule *rule, const Rotor *outer_ring)
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
    const Tangential T_i = race_traction(model, &d->inner, &inner, balls, mixed, rule);
    const Tangential T_e = race_traction(model, &d->outer, &outer, balls, mixed, rule);
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

// Balls of a bearing whose outer ring moves, or whose contacts have many slices.
static __attribute__((noinline)) void race_contact_force_rare(const Model *model, Work *w, scalar inner_R_g,
                                                              bool mixed, const SliceRule *rule)
{
    const bool moves = outer_ring_moves(model->ring_load);
    const Rotor outer = outer_ring(model->ring_load);
    for (int b = 0; b < PACKETS; b++)
        race_contact_packet(model, w, b * LANE_WIDTH, inner_R_g, mixed, rule, moves ? &outer : NULL);
}

void race_contact_force(const Model *model, Work *w)
{
    const bool mixed = model->p->scene.lubrication == LUBRICATION_MIXED;
    const int traction = model->p->scene.traction;
    const SliceRule *rule = traction == TRACTION_POINT ? NULL : traction == TRACTION_SLICED ? &SLICED : &FINE;
    const scalar growth = ring_fit_growth(&model->d->fit, ring_fit_speed(model->ring_load));
    const scalar R_g = model->d->inner.R_g + growth;
    if (outer_ring_moves(model->ring_load) || rule == &FINE) {
        race_contact_force_rare(model, w, R_g, mixed, rule);
        return;
    }
    for (int b = 0; b < PACKETS; b++) {
        const int j = b * LANE_WIDTH;
        if (rule)
            mixed ? race_contact_packet(model, w, j, R_g, true, &SLICED, NULL)
                  : race_contact_packet(model, w, j, R_g, false, &SLICED, NULL);
        else
            mixed ? race_contact_packet(model, w, j, R_g, true, NULL, NULL)
                  : race_contact_packet(model, w, j, R_g, false, NULL, NULL);
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
