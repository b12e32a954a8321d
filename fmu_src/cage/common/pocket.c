// Ball and pocket: a cylinder with a radial axis, cut by the split plane into the two halves.
//
//        x (a)               a     axis of the half;  e_t  its tangent at pocket j
//        |   half 1          p = ball centre - geometric centre of the half
//     .--+--.                (x, t) = (p.a, p.e_t): ball against the pocket's axis
//    (   |n->)---- t (e_t)   S = sqrt(x^2 + t^2),  n = (x, t)/S,  delta = S - (R_c - R)           Cui et al. (2023)
//     '--+--'                V = e(xi) (2/5) K delta^2.5
//        |   half 0          xi = +- n_x R_c/a, at most 1: split plane against the patch, a = a_delta delta^0.5
//                            force on the ball: -dV/d(x, t), damping -(w K delta^1.5) lambda delta_dot n,
//                            Coulomb friction mu Q
//
// A half bears the part of the Hertz pressure on its side of the split plane, which cuts the contact ellipse
// across its long half axis a:
//     w = 1/2 + 3/4 xi - 1/4 xi^3,  e = 1/2 + 15/16 xi - 5/8 xi^3 + 3/16 xi^5
// w is the part of the load: the pressure sqrt(1 - (x/a)^2 - (y/b)^2), summed over y, leaves 1 - (x/a)^2
// along x.  e is the part of the energy: the integral of w K delta^1.5 over delta at the contact's position.
// Therefore dV/d(delta) is w K delta^1.5, and both halves together store and bear as much as one whole
// contact.  The slope of V along the wall is a force across n that pushes the halves apart; without this
// force energy would not be conserved.
//
// Of a close pocket the patch would be longer than R_c and a half would bear beyond the end of its pocket.  Hertz's law ends
// before; assumed: from a = R_c on the patch keeps its length and the halves share the added energy by w(n_x):
// V = e q^5 V_0 + w (1 - q^5) V_0, V_0 = (2/5) K delta^2.5, q = R_c/a.
//
// The friction P_S acts at the contact point p + R n, where the slip is v + omega x R n; in mixed lubrication
// its coefficient goes from that of the film to that of the asperities by Lambda.  P_R and its horizontal
// counterpart are the inlet's rolling friction as in the races, with the mean speed |slip|/2 and R_x = R.
// The half gets the opposite forces at the same points.
//
// Oil between ball and wall adds the force -F m through the ball's centre, where both close in (pocket_squeeze.h).
//
// Smoothness: C1 at touch-down and where the patch leaves a half.  The cylinder has no radial end: a ball
// whose equator leaves the cage's section is reported (events.h), not modelled.
#include "cage/common/pocket.h"

#include "cage/common/pocket_squeeze.h"
#include "cage/elastic/elastic_half.h"
#include "physics/hertz.h"

// Approach of ball and wall less the deflection of the wall by its compliance c, delta_h + c w K delta_h^1.5 = delta, by
// Newton's method.
INLINE wide pocket_approach(const Model *model, int h, wide n_x, wide delta)
{
    const Derived *d = model->d;
    const wide zero = wide_set(0.0), cK = wide_set(model->modes->compliance * d->pocket.K);
    wide own = wide_max(delta, zero);
    for (int i = 0; i < 4; i++) {
        const wide root = wide_sqrt(wide_max(own, wide_set(1e-30)));
        const wide load = wide_max(cK * pocket_share(d, h, n_x, own).load * root, wide_set(-0.3));
        own = wide_max(own - (own + load * own - delta) / (1.0 + 1.5 * load), zero);
    }
    return wide_select(wide_above(delta, 0.0), own, delta);
}

// Forces in a packet of pockets, stored for the half and added to the balls; pressed: of those with contact.  wall: motion of the walls of an elastic
// half, or NULL.
INLINE void pocket_contacts(const Model *model, Work *w, int h, int j, const PocketGap *gap, bits pressed,
                            bool mixed, const WallMotion *wall, ball_array on_wall[3])
{
    const Parameters *p = model->p;
    const Derived *d = model->d;
    const Rotor *half = &w->half[h];
    Pockets *pocket = &w->pocket[h];
    const wide R = wide_load(&d->R[j]);

    // normal
    const PocketAxes *axes = &gap->axes;
    const vec a = axes->a, e_t = axes->e_t;
    const wide n_x = gap->n_x, n_t = gap->n_t;
    const vec n = vec_axpy(n_t, e_t, vec_scale(n_x, a));

    const PocketMotion motion = pocket_motion(w, half, j, axes, wall ? wall->u_dot : NULL);
    const vec v = motion.v;
    const wide delta_dot = vec_dot(n, v);

    // share of the half, contact load, and the energy's gradient across n; walls move the approach alone, so that their modes do
    // not feel the gradient
    const PocketShare share = pocket_share(d, h, n_x, gap->delta);
    const wide Q_0 = share.load * hertz_load(wide_set(d->pocket.K), gap->delta);
    const wide Q =
        wide_select(pressed, hertz_damped(Q_0, wide_set(p->cage.lambda), delta_dot), wide_set(0.0));
    wide F_across = pocket_across(d, gap, share.slope);
    if (wall) F_across -= Q_0 * wide_load(&wall->tilt[j]);
    vec F_n = vec_axpy(-Q, n, vec_axpy(-F_across * n_t, a, vec_scale(F_across * n_x, e_t)));

    // film of oil; `pressed` are from here on those on which any force acts
    SqueezeFilm film = {0};
    if (d->squeeze.filled) {
        film = pocket_squeeze(d, h, j, gap, v);
        F_n = vec_axpy(-film.F, film.m, F_n);
        pressed |= wide_above(film.F, 0.0);
        squeeze_leave(&film, v, axes, h, j, w);
    }

    // friction at the contact point (F_s), film force through the ball's centre (F_c)
    const vec arm = vec_scale(R, n);
    const vec slip = vec_across(vec_add(v, vec_cross(motion.spin, arm)), n);
    const wide slip_2 = vec_dot(slip, slip), U_2 = 0.25 * slip_2 + p->oil.U_0 * p->oil.U_0;
    const wide inv_U = 1.0 / wide_sqrt(U_2);
    wide ln_U, ln_Q;
    wide_log2(U_2 * inv_U, Q + Q_FLOOR, &ln_U, &ln_Q);
    const wide g = pocket_mu(model, ln_U, ln_Q, mixed) * Q / wide_sqrt(slip_2 + p->cage.v_c * p->cage.v_c);
    const wide g_R = 0.5 * traction_inlet(wide_set(d->pocket_rolling), ln_U, Q, ln_Q) * inv_U;
    const vec F_s = vec_scale(-(g + g_R), slip), F_c = vec_scale(2.0 * g_R, slip);

    // A pocket without contact beside others in its packet adds -0, which changes no sum, not even the sign of a zero: the
    // same as in a packet that is left out.
    const vec F = vec_where(pressed, vec_add(F_n, vec_add(F_s, F_c))),
              M = vec_where(pressed, vec_cross(arm, F_s));

    if (wall) {
        const vec drawn = vec_add(F_s, F_c);
        wide_store(&on_wall[0][j], Q * n_x - vec_dot(drawn, a));
        wide_store(&on_wall[1][j], -vec_dot(drawn, axes->b));
        wide_store(&on_wall[2][j], Q * n_t - vec_dot(drawn, e_t));
        if (d->squeeze.filled) {
            wide_store(&on_wall[0][j], wide_fma(film.F, vec_dot(film.m, a), wide_load(&on_wall[0][j])));
            wide_store(&on_wall[2][j], wide_fma(film.F, vec_dot(film.m, e_t), wide_load(&on_wall[2][j])));
        }

        wide_store(&w->cage.elastic.touch.Q[h][j], Q);
    }

    wide_store(&pocket->Q[j], d->squeeze.filled ? Q + film.F : Q);
    wide_store(&pocket->push_x[j], wide_fma(F_across, n_t, Q * n_x));
    wide_store(&pocket->push_t[j], wide_fma(-F_across, n_x, Q * n_t));
    if (d->squeeze.filled) {
        wide_store(&pocket->push_x[j], wide_fma(film.F, vec_dot(film.m, a), wide_load(&pocket->push_x[j])));
        wide_store(&pocket->push_t[j], wide_fma(film.F, vec_dot(film.m, e_t), wide_load(&pocket->push_t[j])));
    }
    pocket_on_half(w, j, axes, pressed, F, M, pocket);
    wide lost = (Q - Q_0) * delta_dot - vec_dot(F_s, slip) - vec_dot(F_c, v);
    if (d->squeeze.filled) lost += film.F * vec_dot(film.m, v);
    pocket_on_balls(model, w, j, pressed, n, F, M, g, lost);
}

// Most pockets are not touched, so that their forces are not computed.
void pocket_rigid(const Model *model, Work *w)
{
    const bool mixed = pocket_is_mixed(model);
    squeeze_clear(model, w);
    for (int h = 0; h < 2; h++) {
        bool touched = false;
        for (int j = 0; j < PACKETS * LANE_WIDTH; j += LANE_WIDTH) {
            const PocketGap gap = pocket_gap(model->d, w, &w->half[h], j);
            wide_store(&w->delta_c[h][j], gap.delta);
            const bits pressed = wide_above(gap.delta, 0.0);
            if (wide_any(pressed) || model->d->squeeze.filled) {
                pocket_contacts(model, w, h, j, &gap, pressed, mixed, NULL, NULL);
                touched = true;
            } else
                pocket_clear(&w->pocket[h], j);
        }
        if (touched) add_pockets(&w->pocket[h], &w->half[h]);
    }
}

// A packet of pockets of an elastic half in which walls are touched.
typedef struct {
    int h, j, touched;  // bits of the balls on which forces act, by contact or by oil
    bits pressed;       // those with contact, as a packet
    PocketGap gap;
    wide ahead;
} TouchedPacket;

// How far the balls of a packet come nearer to the wall in the longest step, both as rigid bodies.
INLINE wide pocket_ahead(const Model *model, const Work *w, int h, int j, const PocketGap *gap)
{
    const vec v = pocket_motion(w, &w->half[h], j, &gap->axes, NULL).v;
    const wide rate = gap->n_x * vec_dot(v, gap->axes.a) + gap->n_t * vec_dot(v, gap->axes.e_t);
    return wide_max(rate, wide_set(0.0)) * model->modes->longest_step;
}

// Leaves the contacts of a packet, and those that may come in the next step, to its substeps (wall_loads.c).
INLINE void leave_to_substeps(const Model *model, Work *w, int h, int j, const PocketGap *gap, wide ahead)
{
    const wide zero = wide_set(0.0), delta = gap->delta, reached = delta + ahead;
    wide K = zero;
    if (wide_any(wide_above(reached, 0.0))) {
        const wide share = pocket_share(model->d, h, gap->n_x, reached).load;
        K = wide_select(wide_above(wide_min(share, reached), 0.0), wide_set(model->d->pocket.K), zero);
    }
    wide_store(&w->cage.elastic.touch.x[h][j], gap->n_x);
    wide_store(&w->cage.elastic.touch.t[h][j], gap->n_t);
    wide_store(&w->cage.elastic.touch.K[h][j], K);
    wide_store(&w->cage.elastic.touch.delta[h][j], delta);
}

// Bits of the balls of a packet that press on a wall or on the oil before it, and takes the motion of the walls off the gap; `near`:
// bits of the balls that can have reached a wall.  The walls' motions by each mode are left to the substeps.
static int find_touched(const Model *model, Work *w, int h, int j, int near, PocketGap *gap,
                        WallPlaces *places, bits *pressed)
{
    ball_array moved;
    elastic_wall_places(model->modes, 2 * h - 1, j, gap->n_x, gap->n_t, places);
    wide_store(&moved[j], wide_set(0.0));
    for (int k = j; k < j + LANE_WIDTH && k < Z; k++) {
        if (!(near >> (k - j) & 1)) continue;
        PressedWall *wall = &w->cage.elastic.pressed[h][k];
        elastic_wall_shape(model->modes, 2 * h - 1, k, places, wall->shape);
        memset(wall->place, 0, sizeof wall->place);
        wall->place[0] = places->n_x[k], wall->place[2] = places->n_t[k], wall->place[6] = model->p->cage.m;
        moved[k] = elastic_sum(wall->shape, w->cage.elastic.q[h]);
    }
    gap->delta -= wide_load(&moved[j]);

    // a ball that touches the other half alone loads nothing here
    *pressed = wide_above(gap->delta, 0.0);
    if (wide_any(*pressed)) {
        const wide load = pocket_share(model->d, h, gap->n_x, gap->delta).load;
        *pressed = wide_above(wide_min(load, gap->delta), 0.0);
    }
    if (!model->d->squeeze.filled) return wide_mask(*pressed);
    return near & wide_mask(*pressed | wide_above(gap->delta, -model->d->squeeze.reach));
}

// Motion of the walls, forces and modal forces of a packet.
static void press_walls(const Model *model, Work *w, const TouchedPacket *at, const WallPlaces *places,
                        bool mixed)
{
    const ElasticHalf *elastic = model->modes;
    const int h = at->h, j = at->j, side = 2 * h - 1;
    ball_array on_wall[3], S;
    WallShape shape[LANE_WIDTH];
    WallMotion wall;
    for (int c = 0; c < 3; c++) wide_store(&wall.u_dot[c][j], wide_set(0.0));
    wide_store(&wall.tilt[j], wide_set(0.0));
    wide_store(&S[j], 1.0 / at->gap.inv_S);
    for (int i = 0; i < LANE_WIDTH && j + i < Z; i++)
        if (at->touched >> i & 1)
            elastic_wall(elastic, side, j + i, places, w->cage.elastic.q[h], w->cage.elastic.q_dot[h],
                         S[j + i], &wall, &shape[i]);
    pocket_contacts(model, w, h, j, &at->gap, at->pressed, mixed, &wall, on_wall);
    for (int i = 0; i < LANE_WIDTH && j + i < Z; i++) {
        if (!(at->touched >> i & 1)) {
            w->cage.films.D[h][j + i] = 0.0;
            continue;
        }
        if (model->d->squeeze.filled) squeeze_wall(model, h, j + i, &shape[i], w);
        const scalar F[3] = {on_wall[0][j + i], on_wall[1][j + i], on_wall[2][j + i]};
        elastic_wall_force(elastic, j + i, &shape[i], F, w->cage.elastic.wall_force[h]);
    }
}

// Stage by stage: the approaches, which take long for a packet, run for several packets at a time.
void pocket_elastic(const Model *model, Work *w)
{
    const bool mixed = pocket_is_mixed(model);
    TouchedPacket packets[2 * PACKETS];
    WallPlaces places[2];
    int count = 0;
    squeeze_clear(model, w);
    for (int h = 0; h < 2; h++)
        for (int j = 0; j < PACKETS * LANE_WIDTH; j += LANE_WIDTH) {
            TouchedPacket *at = &packets[count];
            at->h = h, at->j = j, at->touched = 0, at->gap = pocket_gap(model->d, w, &w->half[h], j);
            at->ahead = pocket_ahead(model, w, h, j, &at->gap);
            const scalar reach = w->cage.elastic.reach[h] + model->d->squeeze.reach;
            const int near = wide_mask(wide_above(at->gap.delta + (at->ahead + reach), 0.0));
            if (near != 0)
                at->touched = find_touched(model, w, h, j, near, &at->gap, &places[h], &at->pressed);
            if (at->touched != 0)
                count++;
            else {
                walls_clear(w, h, j);
                if (near != 0) leave_to_substeps(model, w, h, j, &at->gap, at->ahead);
                wide_store(&w->delta_c[h][j], at->gap.delta);
            }
        }
    for (TouchedPacket *at = packets; at < packets + count; at++) {
        at->gap.delta = wide_select(at->pressed, pocket_approach(model, at->h, at->gap.n_x, at->gap.delta),
                                    at->gap.delta);
        wide_store(&w->delta_c[at->h][at->j], at->gap.delta);
    }
    bool pressed[2] = {false, false};
    for (const TouchedPacket *at = packets; at < packets + count; at++) {
        press_walls(model, w, at, &places[at->h], mixed);
        leave_to_substeps(model, w, at->h, at->j, &at->gap, at->ahead);
        pressed[at->h] = true;
    }
    for (int h = 0; h < 2; h++)
        if (pressed[h]) add_pockets(&w->pocket[h], &w->half[h]);
}
