// Ball and pocket of a ribbon cage: in each half a sphere with a fillet and two edges.
//
//          x (pole)                   Half 1; half 0 is its mirror image.  The sphere's centre lies e = K - R_c beyond the
//       .--+--.    sheet              split, K the depth of the pocket.
//     .'   |   '.                     q = (x, r, t): ball's centre from the sphere's centre, x toward the pole, r along the
//  --'     |     '--  land -- split   pocket's radius, t along its tangent
//     fillet  ball                    g: reach of q in the plane of a rim (below)
//
//     sphere   delta = |q| - (R_c - R)                      Q = K delta^1.5 (1 + 0.7 a/R),  a = sqrt(R_eff delta)
//     fillet   delta = R + rho - |(A - g, H - x)|,    A^2 + H^2 = (R_c + rho)^2,  H = rho + e,     round the pole
//     edges    delta = R + rho - |(A - g, H - |r|)|,  A^2 + H^2 = (R_c + rho)^2,  H = w/2 - rho,   round the pocket's radius
//
// R_eff = R R_c/(R_c - R).  Fillet and edges are rims: rings of the radius rho of their section that touch the sphere
// along a circle, the seam, the fillet's at sin chi_1 = H/(R_c + rho) from the split, the edges' at sin eta = H/(R_c + rho).
// From there on they bend away from the ball, so that a rim's approach is never more than the sphere's and equals it where
// q points to the seam.  Hertz' law with the curvatures 1/R + 1/rho across the rim and 1/R - 1/R_c along it.
//
// A rim ends at the others: the fillet lies between the edges, an edge between the fillets of both sides.  With u toward the
// middle of such an arc, v across and omega half of its opening,  g = sqrt(u^2 + v^2) within it, else
// u cos omega + |v| sin omega: the corner.  A ball that is pushed along r sits on the corners of both sides, whose approaches of some
// micrometres overlap: |v| is a parabola up to SEAT, and the wall moves there with the mean of both sides.
//
// The part of a patch on the sphere's side of a seam is that of the machined pocket's split (pocket.c),
// e = 1/2 + 15/16 xi - 5/8 xi^3 + 3/16 xi^5 of the energy, xi = R_c sin(angle of q above the seam)/a, at most 1, a of the
// rim's approach:
//
//     V = e_f e_e V_sphere + (1 - e_f e_e) (w V_fillet + (1 - w) V_edge),   w = (delta_f/delta_e)^2/2 where delta_f < delta_e,
//                                                                           1 - (delta_e/delta_f)^2/2 elsewhere
//
// Beyond a corner both rims have the same approach; elsewhere the rim that is reached farther has the load.  V decides all: the
// force on the ball is -dV/dq = -Q n through its centre, the friction acts at the contact point p + R n.  Energy and momentum
// are conserved exactly.
//
// A push along the tangent touches both halves at sin chi_0 = e/(R_c - R) if that is more than sin chi_1: each half has
// N = F sin(chi_0 +- beta)/sin 2 chi_0 of a push at the angle beta from the split, beyond chi_0 one half has all.
// 0.7 a/R: independent solution of an elastic ball in a spherical hole (tests/conforming_spheres.py).
//
// Oil between ball and sphere adds the force -F m through the ball's centre, where both close in (spheres_squeeze.h).  The wall
// bears the force at the place nearest to the ball, as that of the contact.
//
// Smoothness: C1 at touch-down, at the seams, where the second half begins to carry and between the corners of both sides: a force that
// jumps there would hold a ball by chatter in steps of 10 ns.  At a corner the force is continuous, its slope is not.
#include "cage/common/pocket_spheres.h"

#include "cage/common/spheres_squeeze.h"
#include "cage/elastic/elastic_half.h"
#include "physics/hertz.h"

static const double LEAST = 1e-12;  // load of a pocket that counts as touched [N]

// The walls of a packet: velocity along the pocket's axes; force on the ball beside the contact's by the place's motion with
// it, per load: slope of the motion along n over the ball's place, toward the pole, r, t.
typedef struct {
    ball_array u_dot[3], slope[3];
} SphereWalls;

// The film of oil of one half in a packet; c: compliance of the wall under the contact.
INLINE SqueezeFilm sphere_film(const Derived *d, int h, int j, const SphereGap *gap, const SphereContact *at,
                               wide c, vec v)
{
    const wide side = wide_set(h == 0 ? -1.0 : 1.0), q[3] = {gap->x, gap->r, gap->t};
    const wide along[3] = {side * vec_dot(v, gap->axes.a), vec_dot(v, gap->axes.b),
                           vec_dot(v, gap->axes.e_t)};
    SqueezeFilm film = spheres_squeeze(d, j, q, c * at->Q, along);
    const vec m = vec_axpy(side * film.m.x, gap->axes.a, vec_scale(film.m.t, gap->axes.e_t));
    film.m = vec_axpy(film.m.r, gap->axes.b, m);
    return film;
}

// Bits of the balls before whose sphere there may be a film when the wall moves by up to `moves`.
INLINE int sphere_wet(const Derived *d, int j, const SphereGap *gap, double moves)
{
    if (!d->squeeze.filled) return 0;
    const wide S = wide_sqrt(gap->x * gap->x + gap->r * gap->r + gap->t * gap->t);
    return wide_mask(wide_above(S - wide_load(&d->spheres.slack[j]) + (d->squeeze.reach + moves), 0.0));
}

// Forces in a packet of pockets, stored for the half and added to the balls; pressed: of those with contact.  walls: of an elastic
// half, or NULL; their forces (x, r, t) are stored in on_wall, the contacts' loads in load.
INLINE void sphere_forces(const Model *model, Work *w, int h, int j, const SphereGap *gap,
                          const SphereContact *at, bits pressed, bool mixed, const SphereWalls *walls,
                          ball_array on_wall[3], wide *load)
{
    const Parameters *p = model->p;
    const Derived *d = model->d;
    const Rotor *half = &w->half[h];
    Pockets *pocket = &w->pocket[h];
    const PocketAxes *axes = &gap->axes;
    const wide R = wide_load(&d->R[j]), n_x = (h == 0 ? -1.0 : 1.0) * at->n_x;
    const vec n = vec_axpy(at->n_t, axes->e_t, vec_axpy(at->n_r, axes->b, vec_scale(n_x, axes->a)));

    const PocketMotion motion = pocket_motion(w, half, j, axes, walls ? walls->u_dot : NULL);
    const vec v = motion.v;
    const wide delta_dot = vec_dot(n, v);
    const wide Q =
        wide_select(pressed, hertz_damped(at->Q, wide_set(p->cage.lambda), delta_dot), wide_set(0.0));

    // friction at the contact point
    const vec arm = vec_scale(R, n);
    const vec slip = vec_across(vec_add(v, vec_cross(motion.spin, arm)), n);
    const wide slip_2 = vec_dot(slip, slip);
    wide ln_U_2, ln_Q;
    wide_log2(0.25 * slip_2 + p->oil.U_0 * p->oil.U_0, Q + Q_FLOOR, &ln_U_2, &ln_Q);
    const wide mu = pocket_mu(model, 0.5 * ln_U_2, ln_Q, mixed);
    const wide g = mu * Q / wide_sqrt(slip_2 + p->cage.v_c * p->cage.v_c);
    const vec F_s = vec_scale(-g, slip);

    // film of oil; `pressed` are from here on those on which any force acts
    SqueezeFilm film = {0};
    vec push = n;  // direction of the place on the wall
    wide lost = (Q - at->Q) * delta_dot - vec_dot(F_s, slip);
    if (d->squeeze.filled) {
        film = sphere_film(d, h, j, gap, at, wide_set(walls ? model->modes->compliance : 0.0), v);
        push = vec_axpy(film.F, film.m, vec_scale(Q, n));
        push = vec_scale(1.0 / wide_sqrt(vec_dot(push, push) + 1e-60), push);
        lost += film.F * vec_dot(film.m, v);
        pressed |= wide_above(film.F, 0.0);
        squeeze_leave(&film, v, axes, h, j, w);
    }

    // A pocket without contact beside others in its packet adds -0, as in pocket.c.
    vec F = vec_axpy(-Q, n, F_s);
    if (d->squeeze.filled) F = vec_axpy(-film.F, film.m, F);
    if (walls) {
        wide tilt[3];
        for (int i = 0; i < 3; i++) tilt[i] = at->Q * wide_load(&walls->slope[i][j]);
        const vec along = vec_axpy((h == 0 ? -1.0 : 1.0) * tilt[0], axes->a, vec_scale(tilt[2], axes->e_t));
        F = vec_add(F, vec_axpy(tilt[1], axes->b, along));
        wide_store(&on_wall[0][j], Q * n_x - vec_dot(F_s, axes->a));
        wide_store(&on_wall[1][j], Q * at->n_r - vec_dot(F_s, axes->b));
        wide_store(&on_wall[2][j], Q * at->n_t - vec_dot(F_s, axes->e_t));
        if (d->squeeze.filled) {
            const vec axis[3] = {axes->a, axes->b, axes->e_t};
            for (int i = 0; i < 3; i++)
                wide_store(&on_wall[i][j],
                           wide_fma(film.F, vec_dot(film.m, axis[i]), wide_load(&on_wall[i][j])));
        }
        *load = Q;
    }
    F = vec_where(pressed, F);
    const vec M = vec_where(pressed, vec_cross(arm, F_s));

    wide_store(&pocket->Q[j], d->squeeze.filled ? Q + film.F : Q);
    // place of the contact on the wall
    wide push_x = n_x, push_r = at->n_r, push_t = at->n_t;
    if (d->squeeze.filled)
        push_x = vec_dot(push, axes->a), push_r = vec_dot(push, axes->b), push_t = vec_dot(push, axes->e_t);
    const wide side = wide_set(h == 0 ? -1.0 : 1.0);
    const wide place_r = gap->r + R * push_r + d->spheres.r, place_t = gap->t + R * push_t;
    wide_store(&pocket->push_x[j], side * (gap->x + R * (side * push_x)));
    wide_store(&pocket->push_t[j], place_t);
    wide_store(&pocket->radius[j], wide_sqrt(place_r * place_r + place_t * place_t));
    pocket_on_half(w, j, axes, pressed, F, M, pocket);
    pocket_on_balls(model, w, j, pressed, n, F, M, g, lost);
}

// Most pockets are not touched, so that their forces are not computed.
void spheres_rigid(const Model *model, Work *w)
{
    const Spheres *s = &model->d->spheres;
    const bool mixed = pocket_is_mixed(model), filled = model->d->squeeze.filled;
    squeeze_clear(model, w);
    for (int h = 0; h < 2; h++) {
        bool touched = false;
        for (int j = 0; j < PACKETS * LANE_WIDTH; j += LANE_WIDTH) {
            const SphereGap gap = sphere_gap(model->d, w, h, j);
            const wide slack = wide_load(&s->slack[j]);
            SphereContact at = {0};
            bits pressed = {0};
            if (sphere_reached(s, slack, &gap, &at.delta)) {
                at = sphere_contact(s, slack, gap.x, gap.r, gap.t);
                pressed = wide_above(at.Q, LEAST);
            }
            wide_store(&w->delta_c[h][j], at.delta);
            if (wide_any(pressed) || filled) {
                sphere_forces(model, w, h, j, &gap, &at, pressed, mixed, NULL, NULL, NULL);
                touched = true;
            } else
                pocket_clear(&w->pocket[h], j);
        }
        if (touched) add_pockets(&w->pocket[h], &w->half[h]);
    }
}

// ---- elastic halves -------------------------------------------------------------------------------------------------

static const double APPROACH_FLOOR = 1e-12;  // least approach in the stiffness 3 Q/(2 delta) [m]

// Largest ratio of a contact's approach to that of the sphere under its load, and the least one's inverse.
static const double CORNER = 4.0;

enum { NEWTON = 5 };  // steps for the wall's compliance, at most

// Last step, whose error is its square over the approach [m].  Derivatives, one step behind, have all steps.
static const double SETTLED = 1e-12;

// The contact with the compliance c of the wall under it in series: the ball is at q - c Q n, by Newton's method with the
// stiffness 3 Q/(2 delta) along n and Q/|q| across it; V with the energy of the wall there.
INLINE SphereContact sphere_approach(const Spheres *s, wide slack, wide c, const SphereGap *gap)
{
    SphereContact at = sphere_contact(s, slack, gap->x, gap->r, gap->t);
    const wide zero = wide_set(0.0);
    wide x = zero, r = zero, t = zero;  // by which the wall gives way
    bits moving = wide_above(at.Q, 0.0);
    for (int i = 0; i < NEWTON; i++) {
        const wide off_x = gap->x - x, off_r = gap->r - r, off_t = gap->t - t, cQ = c * at.Q;
        const wide along = 1.0 / (1.0 + 1.5 * cQ / wide_max(at.delta, wide_set(APPROACH_FLOOR)));
        const wide across =
            1.0 / (1.0 + cQ / wide_sqrt(off_x * off_x + off_r * off_r + off_t * off_t + TIP * TIP));
        const wide e_x = cQ * at.n_x - x, e_r = cQ * at.n_r - r, e_t = cQ * at.n_t - t;
        const wide normal = (along - across) * (at.n_x * e_x + at.n_r * e_r + at.n_t * e_t);
        const wide d_x = across * e_x + normal * at.n_x, d_r = across * e_r + normal * at.n_r,
                   d_t = across * e_t + normal * at.n_t;
        x += wide_select(moving, d_x, zero);
        r += wide_select(moving, d_r, zero);
        t += wide_select(moving, d_t, zero);
        at = sphere_contact(s, slack, gap->x - x, gap->r - r, gap->t - t);
#ifndef DUAL
        moving &= wide_above(d_x * d_x + d_r * d_r + d_t * d_t, SETTLED * SETTLED);
        if (!wide_any(moving)) break;
#endif
    }
    at.V += 0.5 * c * at.Q * at.Q;
    return at;
}

// The places where the balls of a packet touch their walls, and their slopes over q.  chi begins at the table's first node, the seam of
// the fillet, beyond which it has no slope, over BEND on both sides of it.
typedef struct {
    scalar chi[LANE_WIDTH], radius[LANE_WIDTH], chi_slope[3][LANE_WIDTH], radius_slope[3][LANE_WIDTH],
        front_slope[LANE_WIDTH];
    RibbonNodes nodes;
} SpherePlaces;

static void sphere_places(const Spheres *s, const ElasticHalf *half, const SphereGap *gap, SpherePlaces *at)
{
    const wide x = gap->x, r = gap->r, t = gap->t, zero = wide_set(0.0), first = wide_set(half->chi[0]);
    const wide ahead = wide_max(x, zero), aside = wide_sqrt(t * t + SEAT * SEAT);
    const wide inv_rho_2 = 1.0 / (ahead * ahead + aside * aside);
    const wide angle = wide_atan(ahead / aside), past = angle - first;
    const wide bend = wide_min(wide_max(past + BEND, zero), wide_set(2.0 * BEND)),
               follows = bend / (2.0 * BEND);
    const wide chi = first + (0.5 * bend * follows + wide_max(past - BEND, zero));
    const wide one = wide_set(1.0), part = wide_max(wide_min(t / SEAT, one), -one), rest = 1.0 - part * part;
    wide_store(at->front_slope, (1.5 / SEAT) * rest);
    wide_store(at->chi, chi);
    wide_store(at->chi_slope[0], follows * (aside * inv_rho_2));
    wide_store(at->chi_slope[1], zero);
    wide_store(at->chi_slope[2], follows * (-ahead * t / aside * inv_rho_2));
    const wide inv_s_2 = 1.0 / (x * x + r * r + t * t + TIP * TIP), to_wall = s->radius * wide_sqrt(inv_s_2);
    const wide across = s->r + to_wall * r, along = to_wall * t;
    const wide radius = wide_sqrt(across * across + along * along), inv_radius = 1.0 / radius;
    const wide less = to_wall * (across * r + along * t) * (inv_s_2 * inv_radius);
    wide_store(at->radius, radius);
    wide_store(at->radius_slope[0], -less * x);
    wide_store(at->radius_slope[1], to_wall * across * inv_radius - less * r);
    wide_store(at->radius_slope[2], to_wall * along * inv_radius - less * t);
    ribbon_wall_nodes(half, chi, radius, part * (1.0 + 0.5 * rest), &at->nodes);
}

// Takes the motion u of the wall from the place q of ball k.
static void take(ball_array q[3], int k, int side, const scalar u[3])
{
    q[0][k] -= side * u[0];
    q[1][k] -= u[1];
    q[2][k] -= u[2];
}

// Takes the motions of the walls of a packet, of which the bits in `near` may be reached, from the gap.  The modes that move all
// pockets alike cost little and move the walls most: the others are left out where they cannot close the gap.  Returns
// the bits of the others; the approach where there are none.
static int move_walls(const Model *model, const Work *w, int h, int j, int near, wide ahead,
                      ribbon_motions_alike by_alike, SphereGap *gap, SpherePlaces *at,
                      WallShape shape[LANE_WIDTH], wide *delta)
{
    const int side = 2 * h - 1;
    const Spheres *s = &model->d->spheres;
    const wide slack = wide_load(&s->slack[j]);
    ball_array q[3], alike[3];
    wide_store(&q[0][j], gap->x), wide_store(&q[1][j], gap->r), wide_store(&q[2][j], gap->t);
    for (int c = 0; c < 3; c++) wide_store(&alike[c][j], wide_load(&q[c][j]));
    sphere_places(s, model->modes, gap, at);
    for (int lane = 0; lane < LANE_WIDTH && j + lane < Z; lane++) {
        if (!(near >> lane & 1)) continue;
        scalar u[3];
        ribbon_wall_alike(model->modes, side, &at->nodes, lane, by_alike, u);
        take(alike, j + lane, side, u);
    }
    gap->x = wide_load(&alike[0][j]), gap->r = wide_load(&alike[1][j]), gap->t = wide_load(&alike[2][j]);
    sphere_reached(s, slack, gap, delta);
    const double others = w->cage.elastic.reach_others[h];
    near &= wide_mask(wide_above(*delta + (ahead + others), 0.0)) | sphere_wet(model->d, j, gap, others);
    if (near == 0) return 0;
    for (int lane = 0; lane < LANE_WIDTH && j + lane < Z; lane++) {
        const int k = j + lane;
        if (!(near >> lane & 1)) {
            for (int c = 0; c < 3; c++) q[c][k] = alike[c][k];
            continue;
        }
        scalar u[3];
        ribbon_wall_moved(model->modes, side, k, &at->nodes, lane, w->cage.elastic.q[h], u, &shape[lane]);
        take(q, k, side, u);
    }
    gap->x = wide_load(&q[0][j]), gap->r = wide_load(&q[1][j]), gap->t = wide_load(&q[2][j]);
    return near;
}

// Velocities and slopes of the walls of a packet that are pressed, of which the shapes are known.
static void pressed_walls(const Model *model, const Work *w, int h, int j, int mask,
                          const SphereContact *contact, const SpherePlaces *at,
                          const WallShape shape[LANE_WIDTH], SphereWalls *walls)
{
    const int side = 2 * h - 1;
    ball_array n[3];
    wide_store(&n[0][j], contact->n_x), wide_store(&n[1][j], contact->n_r),
        wide_store(&n[2][j], contact->n_t);
    for (int i = 0; i < 3; i++) {
        wide_store(&walls->u_dot[i][j], wide_set(0.0));
        wide_store(&walls->slope[i][j], wide_set(0.0));
    }
    for (int lane = 0; lane < LANE_WIDTH && j + lane < Z; lane++) {
        if (!(mask >> lane & 1)) continue;
        const int k = j + lane;
        const scalar along[3] = {side * n[0][k], n[1][k], n[2][k]};
        scalar u_dot[3], slope[3];  // slopes over chi, radius, front
        ribbon_wall(model->modes, side, k, &at->nodes, lane, &shape[lane], along, w->cage.elastic.q[h],
                    w->cage.elastic.q_dot[h], u_dot, slope);
        for (int i = 0; i < 3; i++) {
            walls->u_dot[i][k] = u_dot[i];
            walls->slope[i][k] = slope[0] * at->chi_slope[i][lane] + slope[1] * at->radius_slope[i][lane];
        }
        walls->slope[2][k] += slope[2] * at->front_slope[lane];
    }
}

// Contacts of a packet with the walls, modal forces on them; wet: bits of the walls before which there may be a film.
static void press_spheres(const Model *model, Work *w, int h, int j, const SphereGap *gap,
                          const SphereContact *contact, bits pressed, int wet, const SpherePlaces *at,
                          const WallShape shape[LANE_WIDTH])
{
    ElasticWork *e = &w->cage.elastic;
    const wide zero = wide_set(0.0), side = wide_set(h == 0 ? -1.0 : 1.0);
    const int mask = wide_mask(pressed) | wet;
    ball_array on_wall[3];
    wide load;
    SphereWalls walls;
    pressed_walls(model, w, h, j, mask, contact, at, shape, &walls);
    sphere_forces(model, w, h, j, gap, contact, pressed, pocket_is_mixed(model), &walls, on_wall, &load);
    const wide n[3] = {side * contact->n_x, contact->n_r, contact->n_t};
    // Hertz's law for the substeps, through load and approach; near a corner the approach is not the load's
    const wide by_sphere = wide_max(contact->Q, wide_set(LEAST)) / model->d->spheres.K;
    const wide least = wide_exp((2.0 / 3.0) * wide_log(by_sphere)) / CORNER;
    const wide own = wide_min(wide_max(contact->delta, least), (CORNER * CORNER) * least);
    wide_store(&e->touch.x[h][j], wide_select(pressed, n[0], zero));
    wide_store(&e->touch.r[h][j], wide_select(pressed, n[1], zero));
    wide_store(&e->touch.t[h][j], wide_select(pressed, n[2], zero));
    wide_store(&e->touch.K[h][j], wide_select(pressed, contact->Q / (own * wide_sqrt(own)), zero));
    wide_store(&e->touch.delta[h][j], wide_select(pressed, own, zero));
    wide_store(&e->touch.Q[h][j], load);
    wide_store(&e->wall_energy[h][j], wide_select(pressed, contact->V, zero));
    wide_store(&e->touch.chi[h][j], zero);
    wide_store(&e->touch.radius[h][j], zero);
    wide_store(&e->touch.front[h][j], zero);
    for (int lane = 0; lane < LANE_WIDTH && j + lane < Z; lane++) {
        const int b = j + lane;
        if (!(mask >> lane & 1)) {
            w->cage.films.D[h][b] = 0.0;
            continue;
        }
        if (model->d->squeeze.filled) squeeze_wall(model, h, b, &shape[lane], w);
        e->touch.chi[h][b] = at->chi[lane], e->touch.radius[h][b] = at->radius[lane];
        e->touch.front[h][b] = at->nodes.front[lane];
        const scalar F[3] = {on_wall[0][b], on_wall[1][b], on_wall[2][b]};
        elastic_wall_force(model->modes, b, &shape[lane], F, e->wall_force[h]);
#ifndef DUAL
        const double along[3] = {e->touch.x[h][b], e->touch.r[h][b], e->touch.t[h][b]};
        PressedWall *wall = &e->pressed[h][b];
        memcpy(wall->place, along, sizeof along);
        wall->place[3] = e->touch.chi[h][b], wall->place[4] = e->touch.radius[h][b];
        wall->place[5] = e->touch.front[h][b], wall->place[6] = model->p->cage.m;
        elastic_wall_along(model->modes, b, &shape[lane], along, wall->shape);
#endif
    }
}

// How far the balls of a packet come nearer to the sphere in the longest step, both as rigid bodies.
INLINE wide sphere_ahead(const Model *model, const Work *w, int h, int j, const SphereGap *gap)
{
    const wide x = gap->x, r = gap->r, t = gap->t, side = wide_set(h == 0 ? -1.0 : 1.0);
    const vec v = pocket_motion(w, &w->half[h], j, &gap->axes, NULL).v;
    const wide along =
        side * x * vec_dot(v, gap->axes.a) + r * vec_dot(v, gap->axes.b) + t * vec_dot(v, gap->axes.e_t);
    const wide rate = along / wide_sqrt(x * x + r * r + t * t + TIP * TIP);
    return wide_max(rate, wide_set(0.0)) * model->modes->longest_step;
}

static const double TOUCHES =
    1e-7;  // approach at which a ball that has not arrived yet has its direction and law [m]

// Leaves balls of a packet that may come to the wall in the longest step to its substeps (wall_loads.c), with the contact that each would have
// on a wall moved up to it.
static void leave_arrivals(const Model *model, Work *w, int h, int j, const SphereGap *gap, wide ahead,
                           const SpherePlaces *at)
{
    const Spheres *s = &model->d->spheres;
    WallTouch *touch = &w->cage.elastic.touch;
    const wide slack = wide_load(&s->slack[j]), side = wide_set(h == 0 ? -1.0 : 1.0);
    wide sphere;
    const wide delta = sphere_nearest(s, slack, gap, &sphere);
    const bits within_reach = wide_above(delta + ahead, 0.0), apart = wide_above(-delta, 0.0),
               comes = within_reach & apart;
    if (!wide_any(comes)) return;
    const SphereContact would = sphere_contact(s, slack + (delta - TOUCHES), gap->x, gap->r, gap->t);
    const double inv_law = 1.0 / (TOUCHES * sqrt(TOUCHES));
    scalar *const to[] = {touch->x[h],     touch->r[h],   touch->t[h],      touch->K[h],
                          touch->delta[h], touch->chi[h], touch->radius[h], touch->front[h]};
    const wide value[] = {side * would.n_x,
                          would.n_r,
                          would.n_t,
                          inv_law * would.Q,
                          delta,
                          wide_load(at->chi),
                          wide_load(at->radius),
                          wide_load(at->nodes.front)};
    for (size_t i = 0; i < sizeof to / sizeof *to; i++)
        wide_store(&to[i][j], wide_select(comes, value[i], wide_load(&to[i][j])));
}

void spheres_elastic(const Model *model, Work *w)
{
    const Spheres *s = &model->d->spheres;
    const wide c = wide_set(model->modes->compliance);
    squeeze_clear(model, w);
    for (int h = 0; h < 2; h++) {
        bool touched = false;
        ribbon_motions_alike alike;
        ribbon_alike(model->modes, w->cage.elastic.q[h], alike);
        for (int j = 0; j < PACKETS * LANE_WIDTH; j += LANE_WIDTH) {
            SphereGap gap = sphere_gap(model->d, w, h, j);
            const wide slack = wide_load(&s->slack[j]);
            SpherePlaces at;
            WallShape shape[LANE_WIDTH];
            SphereContact contact = {0};
            bits pressed = {0};
            sphere_reached(s, slack, &gap, &contact.delta);
            const wide ahead = sphere_ahead(model, w, h, j, &gap);
            int near = wide_mask(wide_above(contact.delta + (ahead + w->cage.elastic.reach[h]), 0.0)) |
                       sphere_wet(model->d, j, &gap, w->cage.elastic.reach[h]);
            if (near != 0)
                near = move_walls(model, w, h, j, near, ahead, alike, &gap, &at, shape, &contact.delta);
            const int wet = near & sphere_wet(model->d, j, &gap, 0.0);
            if (near != 0 && sphere_reached(s, slack, &gap, &contact.delta)) {
                contact = sphere_approach(s, slack, c, &gap);
                pressed = wide_above(contact.Q, LEAST);
            }
            wide_store(&w->delta_c[h][j], contact.delta);
            if (wide_any(pressed) || wet != 0) {
                press_spheres(model, w, h, j, &gap, &contact, pressed, wet, &at, shape);
                touched = true;
            } else {
                walls_clear(w, h, j);
                wide_store(&w->cage.elastic.wall_energy[h][j], wide_set(0.0));
            }
            if (near != 0) leave_arrivals(model, w, h, j, &gap, ahead, &at);
        }
        if (touched) add_pockets(&w->pocket[h], &w->half[h]);
    }
}
