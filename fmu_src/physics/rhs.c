// The table of contents of the physics: one evaluation of dy/dt in named steps.
#include "physics/rhs.h"

#include "cage/cage.h"
#include "physics/ball.h"
#include "physics/drag.h"
#include "physics/housing.h"
#include "physics/land_film.h"
#include "physics/outer_ring.h"
#include "physics/powers.h"
#include "physics/race_contact.h"
#include "physics/ring.h"
#include "physics/ring_load.h"

// Sum of the race contacts on the ring.
static void ring_sum(Work *w)
{
    const scalar *ring[] = {w->ring_F_x, w->ring_F_y, w->ring_F_z, w->ring_M_x, w->ring_M_y, w->ring_M_z};
    for (int i = 0; i < 3; i++) {
        w->ring.F[i] = ball_array_sum(ring[i]);
        w->ring.M[i] = ball_array_sum(ring[3 + i]);
    }
}

// Power of an outer ring that moves, of gravity and of the frame.
static __attribute__((noinline)) scalar motion_power(const Model *model, const Work *w)
{
    scalar power = 0.0;
    if (outer_ring_moves(model->ring_load)) power += housing_power(model, w);
    if (frame_has_power(model->ring_load)) power += frame_power(model, w);
    return power;
}

// Net power into balls and cage: by the rings' motions, the frame and growth, less the dissipated power.
static scalar net_power(const Model *model, const Work *w, const scalar *y_dot)
{
    scalar power = shaft_power(w) - power_loss(w);
    power += land_growth_power(model, w, y_dot);
    const RingLoad *load = model->ring_load;
    if (scalar_value(load->omega_dot) != 0.0 || scalar_value(load->frame_omega_dot) != 0.0)
        power += race_growth_power(model, w);
    if (outer_ring_moves(load) || frame_has_power(load)) power += motion_power(model, w);
    return power;
}

// One evaluation under the load that is on the ring.
static void evaluate(const Model *model, const scalar *y, scalar *y_dot, Work *w)
{
    for (int i = 0; i < 3; i++) w->outer_x[i] = model->ring_load->outer_x[i];
    w->outer_beta = model->ring_load->outer_beta, w->outer_gamma = model->ring_load->outer_gamma;
    w->frame_omega = model->ring_load->frame_omega;
    ball_kinematics(y, w);
    ring_kinematics(model, y, w);
    cage_kinematics(model, y, w);
    race_contact_force(model, w);
    cage_pockets(model, w);
    drag_mixture(model, w);
    drag_force(model, w);
    ring_sum(w);
    drag_ring(model, w);
    land_film_force(model, w);
    drag_cage(model, w);
    cage_joints(model, y, w);
    ball_acceleration(model, w, y_dot);
    cage_acceleration(model, y, w, y_dot);
    ring_acceleration(model, w, y_dot);
    y_dot[Y_WORK] = net_power(model, w, y_dot);
}

void rhs(const Model *model, double t, const scalar *y, scalar *y_dot, Work *w)
{
    RingLoad ring_load;
    const Model now = {model->p, model->d, &ring_load, NULL, model->modes, model->housing, model->turn};
    if (model->trajectory)
        ring_load_at(model->trajectory, t, &ring_load);
    else if (model->housing)
        ring_load = *model->ring_load;
    if (model->housing) housing_place(model->housing, &ring_load);
    evaluate(model->trajectory || model->housing ? &now : model, y, y_dot, w);
}
