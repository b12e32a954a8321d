// A housing on springs, housing.motion = supported: a rigid body that carries the outer ring.
//
//   m x'' = F - F_0 - k (x - x_b) - c (x' - x_b') + m (field - field_0)      along X, Y and Z
//   J b'' = M - M_0 - k_t (b - b_b) - c_t (b' - b_b')                        tilts about Y and Z, direction cosines beta and gamma
//
// F, M: load of balls, cage and oil on the outer ring about its centre (powers.h); x_b, b_b: motion of the base, the inputs
// housing.*.  F_0, M_0 belong to the start: there the springs carry the load, and the housing rests at its base's place.
// The turn about X is given by housing.omega.
//
// The default method's step takes the housing along as velocity Verlet does:
//   x_{n+1} = x_n + h v_n + h^2 a_n/2,   a_{n+1} = a(x_{n+1}, v_n + h a_n),   v_{n+1} = v_n + h (a_n + a_{n+1})/2
// with the evaluation of the step.  The housing is slow beside the balls, whose errors decide on the steps.
#pragma once

#include "physics/powers.h"

// Places the outer ring where the housing is.
INLINE void housing_place(const Housing *housing, RingLoad *ring_load)
{
    for (int i = 0; i < 3; i++) {
        ring_load->outer_x[i] = housing->x[i];
        ring_load->outer_v[i] = housing->v[i];
        ring_load->outer_a[i] = housing->a[i];
    }
    ring_load->outer_beta = housing->x[3], ring_load->outer_beta_dot = housing->v[3];
    ring_load->outer_gamma = housing->x[4], ring_load->outer_gamma_dot = housing->v[4];
    ring_load->outer_moves = 1.0;
}

#ifndef DUAL
// The housing at its base, at rest against it.
static inline void housing_at_base(const RingLoad *ring_load, Housing *housing)
{
    memset(housing, 0, sizeof *housing);
    for (int i = 0; i < HOUSING_DOF; i++) {
        housing->x[i] = ring_load->base[i];
        housing->v[i] = ring_load->base_dot[i];
    }
}

// Load on the housing without springs, of the evaluation w under the model's ring_load.
static inline void housing_load(const Model *model, const Work *w, const Housing *housing,
                                double load[HOUSING_DOF])
{
    double F[3], M[3], field[3];
    housing_wrench(model, w, F, M);
    frame_acceleration(model->ring_load, housing->x, housing->v, field);
    for (int i = 0; i < 3; i++) load[i] = F[i] + model->p->housing.m * field[i];
    load[3] = M[1], load[4] = M[2];
}

// Acceleration at the position and velocity in `housing`.
static inline void housing_acceleration(const Model *model, const Work *w, Housing *housing)
{
    const Parameters *p = model->p;
    const RingLoad *base = model->ring_load;
    const double k[HOUSING_DOF] = {p->housing.k_x, p->housing.k_y, p->housing.k_z, p->housing.k_tilt_y,
                                   p->housing.k_tilt_z};
    const double c[HOUSING_DOF] = {p->housing.c_x, p->housing.c_y, p->housing.c_z, p->housing.c_tilt_y,
                                   p->housing.c_tilt_z};
    double load[HOUSING_DOF];
    housing_load(model, w, housing, load);
    for (int i = 0; i < HOUSING_DOF; i++) {
        const double springs =
            k[i] * (housing->x[i] - base->base[i]) + c[i] * (housing->v[i] - base->base_dot[i]);
        housing->a[i] = (load[i] - housing->rest[i] - springs) / (i < 3 ? p->housing.m : p->housing.J);
    }
}
#endif
