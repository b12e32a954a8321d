// Derivatives: the kernel files and the outputs are compiled once more, with dual numbers for scalars.
#define DUAL
#define ISA dual
#define LANE_WIDTH 1

#include "instance/jacobian.h"

#include "cage/cage.c"
#include "cage/cage_read.c"
#include "cage/common/cage_joint.c"
#include "cage/common/halves.c"
#include "cage/common/joint_slip.c"
#include "cage/common/pocket.c"
#include "cage/common/pocket_spheres.c"
#include "cage/elastic/cage_elastic.c"
#include "cage/elastic/elastic_lands.c"
#include "cage/elastic/elastic_wall.c"
#include "cage/two_half/half_path.c"
#include "cage/two_half/joint_open.c"
#include "cage/two_half/two_half.c"
#include "instance/energy.c"
#include "instance/outputs.c"
#include "physics/ball.c"
#include "physics/drag.c"
#include "physics/housing.h"
#include "physics/land_film.c"
#include "physics/race_contact.c"
#include "physics/rhs.c"
#include "physics/ring.c"
#include "rivet/rivet_rom.c"

enum {
    TRAJECTORY_SCALARS = sizeof(InputTrajectory) / sizeof(scalar),
    OUTPUT_SCALARS = sizeof(Outputs) / sizeof(scalar)
};

// Dual numbers from n values and derivatives (NULL: all derivatives are 0).
static void scalars_join(int n, const double *value, const double *derivative, scalar *x)
{
    for (int i = 0; i < n; i++) x[i] = scalar_dual(value[i], derivative ? derivative[i] : 0.0);
}

static void scalars_derivative(int n, const scalar *x, double *derivative)
{
    for (int i = 0; i < n; i++) derivative[i] = scalar_derivative(x[i]);
}

// The balls' turns where time goes on by dt, of a model of double numbers; NULL if no ball has a spall.
static const BallTurn *turn_drift(const Model *model, double dt, BallTurn *turn)
{
    if (model->turn == NULL) return NULL;
    const double *angle = (const double *)model->turn, *rate = angle + Z;
    for (int j = 0; j < Z; j++) {
        turn->angle[j] = scalar_dual(angle[j], dt * rate[j]);
        turn->rate[j] = scalar_dual(rate[j], 0.0);
    }
    return turn;
}

// The housing's motion where time goes on by dt.
static void housing_drift(const Housing *housing, double dt, RingLoad *ring_load)
{
    for (int i = 0; i < 3; i++) {
        ring_load->outer_x[i] += scalar_dual(0.0, dt * housing->v[i]);
        ring_load->outer_v[i] += scalar_dual(0.0, dt * housing->a[i]);
    }
    ring_load->outer_beta += scalar_dual(0.0, dt * housing->v[3]);
    ring_load->outer_gamma += scalar_dual(0.0, dt * housing->v[4]);
    ring_load->outer_beta_dot += scalar_dual(0.0, dt * housing->a[3]);
    ring_load->outer_gamma_dot += scalar_dual(0.0, dt * housing->a[4]);
}

void jacobian_outputs(const Model *model, const double *trajectory, double t, double dt, const double *du,
                      const double *y, const double *dy, double *d_out)
{
    InputTrajectory inputs;
    RingLoad ring_load;
    BallTurn turn;
    Work work = {0};
    Outputs out = {0};
    scalar state[N_ALL_STATES] = {0.0}, rate[N_ALL_STATES] = {0.0};
    const int states = cage_states(model);
    const Model dual = {
        model->p, model->d, &ring_load, NULL, model->modes, model->housing, turn_drift(model, dt, &turn)};
    scalars_join(TRAJECTORY_SCALARS, trajectory, NULL, (scalar *)&inputs);
    if (du)
        for (int i = 0; i < N_INPUTS; i++) ((scalar *)&inputs.u[0])[i] += scalar_dual(0.0, du[i]);
    ring_load_at(&inputs, scalar_dual(t, dt), &ring_load);
    if (model->housing) {
        housing_place(model->housing, &ring_load);
        housing_drift(model->housing, dt, &ring_load);
    }
    scalars_join(states, y, dy, state);
    rhs(&dual, t, state, rate, &work);
    const Evaluation at = {&dual, state, rate, &work, cage_loads, rivet_rom_stress};
    for (int group = 0; group < GROUP_COUNT; group++) outputs_evaluate(&at, group, &out);
    scalars_derivative(OUTPUT_SCALARS, (const scalar *)&out, d_out);
}
