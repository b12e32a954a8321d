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
// The ring gets the opposite forces at the same points: force -F, moment -(p x F) - M about its centre.  Normal contact and its
// motion: race_normal.h; slip that spin and curvature vary: race_spin.h; traction of all contacts: race_traction.h.
//
// Smoothness: C1 at touch-down.  Hertz' ellipse is not cut at the shoulder.
#include "physics/race_contact.h"

#include "physics/ball_spall.h"
#include "physics/outer_ring.h"
#include "physics/race_traction.h"
#include "physics/ring_fit.h"

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

// Forces and moments on a packet of balls, zeros to which the pockets add, wrench on the ring about its centre.
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

// Contacts of all balls with the inner (0) or outer race (1); roll: turns of balls with spalls, else NULL; stored: elastic energies,
// P: moments on the balls by their spalls.
INLINE void surface_contacts(const Model *model, const Work *w, int side, const SurfacePlace at[PACKETS],
                             const BallRoll *roll, Contact c[PACKETS], wide stored[PACKETS], wide P[PACKETS])
{
    const Race *race = side == 0 ? &model->d->inner : &model->d->outer;
    wide cos_phi[PACKETS], sin_phi[PACKETS], height[PACKETS], slope[PACKETS];
    for (int b = 0; b < PACKETS; b++) cos_phi[b] = at[b].cos_phi, sin_phi[b] = at[b].sin_phi;
    race_surface_waves(&race->surface, cos_phi, sin_phi, height, slope);
    for (int b = 0; b < PACKETS; b++) {
        const BallMotion ball = ball_motion(model, w, b * LANE_WIDTH);
        const wide none = wide_set(0.0);
        SpallPlace in = {.f = none, .df = none, .f_ball = none, .df_ball = none, .two = roll != NULL};
        in.race = spall_lanes(&race->surface, &race->surface.spall, b * LANE_WIDTH);
        in.ball = spall_lanes(&race->surface, &race->balls, b * LANE_WIDTH);
        if (race->surface.spalled)
            race_surface_drop(&race->surface, &in.race, cos_phi[b], sin_phi[b], &in.f, &in.df);
        if (roll) {
            spall_drop(&in.ball, roll[b].cosine[side], roll[b].sine[side], &in.f_ball, &in.df_ball);
            in.rate = roll[b].rate[side];
        }
        c[b] = surface_contact(model, race, &ball, &at[b], height[b], slope[b], &in, &stored[b], &P[b]);
    }
}

// Balls between races that are not perfect, or with spalls.
static __attribute__((noinline)) void race_contact_force_rough(const Model *model, Work *w, scalar inner_R_g,
                                                               bool mixed, bool sliced)
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
    BallRoll rolls[PACKETS];
    const BallRoll *const roll = d->spalled ? rolls : NULL;
    for (int b = 0; roll && b < PACKETS; b++) {
        const int j = b * LANE_WIDTH;
        const BallMotion ball = ball_motion(model, w, j);
        rolls[b] = ball_roll(&ball, &at_i[b], &at_e[b], ball_angles(model, j),
                             given->inner_angle - given->outer_angle);
        wide_store(&w->turn_rate[j], rolls[b].rate[1]);
    }

    Contact inner_contact[PACKETS], outer_contact[PACKETS];
    Tangential T_i[PACKETS], T_e[PACKETS];
    wide stored_i[PACKETS], stored_e[PACKETS], P_i[PACKETS], P_e[PACKETS];
    surface_contacts(model, w, 0, at_i, roll, inner_contact, stored_i, P_i);
    surface_contacts(model, w, 1, at_e, roll, outer_contact, stored_e, P_e);
    race_tractions(model, inner_contact, outer_contact, mixed, sliced, T_i, T_e);
    for (int b = 0; b < PACKETS; b++) {
        if (roll) add_ball_spalls(&roll[b], &at_i[b], &at_e[b], P_i[b], P_e[b], &T_i[b], &T_e[b]);
        wide_store(&w->race_stored[b * LANE_WIDTH], stored_i[b] + stored_e[b]);
        store_contacts(w, b * LANE_WIDTH, &inner_contact[b], &outer_contact[b], &T_i[b], &T_e[b]);
        store_forces(w, b * LANE_WIDTH, at_i[b].p, &inner_contact[b], &outer_contact[b], &T_i[b], &T_e[b]);
    }
}

void race_contact_force(const Model *model, Work *w)
{
    const bool mixed = model->p->scene.lubrication == LUBRICATION_MIXED;
    const bool sliced = model->p->scene.traction == TRACTION_SLICED;
    const scalar growth = ring_fit_growth(&model->d->fit, ring_fit_speed(model->ring_load));
    const scalar R_g = model->d->inner.R_g + growth;
    if (model->d->rough)
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
