// Inner ring: translation, two tilts, prescribed speed.
//
//   free         m x'' = F_shaft + F_impact + F_contacts - c (x' - x_e') + m g   (the paper's equation; the load is given on
//                the ring, x_e: outer ring, g: gravity and the frame's inertia forces)
//   prescribed   the motion is given: its states are not integrated
//   tilt: prescribed  beta'' = (beta_shaft - beta)/tau^2 - 2 beta'/tau, gamma likewise: critically damped
//         supported   M = k_tilt (shaft - ring) - c_tilt (rates against the outer ring) + shaft.M
//         free        M = shaft.M only
//         supported and free include the gyroscopic moment of the spin (rotor.h) and the moment of a frame that turns (frame.h)
//
// Forces and moments are in the global frame.
#include "physics/ring.h"

#include "physics/frame.h"
#include "physics/rotor.h"

void ring_kinematics(const Model *model, const scalar *y, Work *w)
{
    Rotor *ring = &w->ring;
    const RingLoad *given = model->ring_load;
    const bool prescribed = model->p->ring.motion == RING_MOTION_PRESCRIBED;
    for (int i = 0; i < 3; i++) {
        ring->x[i] = prescribed ? given->x[i] : y[Y_RING_X + i];
        ring->v[i] = prescribed ? given->v[i] : y[Y_RING_V_X + i];
    }
    if (prescribed)
        rotor_axis(ring, given->beta, given->gamma, given->beta_dot, given->gamma_dot, given->omega);
    else
        rotor_axis(ring, y[Y_RING_BETA], y[Y_RING_GAMMA], y[Y_RING_BETA_DOT], y[Y_RING_GAMMA_DOT],
                   given->omega);
}

void ring_acceleration(const Model *model, const Work *w, scalar *y_dot)
{
    const Parameters *p = model->p;
    const RingLoad *ring_load = model->ring_load;
    const Rotor *ring = &w->ring;
    const scalar beta = -ring->a[2], gamma = ring->a[1];
    const scalar beta_dot = -ring->a_dot[2], gamma_dot = ring->a_dot[1];

    // translation
    scalar field[3];
    frame_acceleration(ring_load, ring->x, ring->v, field);
    for (int i = 0; i < 3; i++) {
        y_dot[Y_RING_X + i] = ring->v[i];
        y_dot[Y_RING_V_X + i] =
            (ring_load->F[i] + ring->F[i] - p->ring.c * (ring->v[i] - ring_load->outer_v[i])) / p->ring.m +
            field[i];
    }

    // tilt
    y_dot[Y_RING_BETA] = beta_dot;
    y_dot[Y_RING_GAMMA] = gamma_dot;
    if (p->ring.motion == RING_MOTION_PRESCRIBED) {
        for (int i = 0; i < 3; i++) y_dot[Y_RING_V_X + i] = 0.0;
        y_dot[Y_RING_BETA_DOT] = y_dot[Y_RING_GAMMA_DOT] = 0.0;
        return;
    }
    if (p->ring.tilt_mode == TILT_MODE_PRESCRIBED) {
        const double rate = 1.0 / p->ring.tilt_time;
        y_dot[Y_RING_BETA_DOT] = ((ring_load->beta - beta) * rate - 2.0 * beta_dot) * rate;
        y_dot[Y_RING_GAMMA_DOT] = ((ring_load->gamma - gamma) * rate - 2.0 * gamma_dot) * rate;
        return;
    }
    scalar M[3] = {ring->M[0], ring->M[1] + ring_load->M[0], ring->M[2] + ring_load->M[1]};
    scalar a_ddot[3], s_dot;  // s_dot is not used: the speed is given
    if (p->ring.tilt_mode == TILT_MODE_SUPPORTED) {
        M[1] += p->ring.k_tilt * (ring_load->beta - beta) -
                p->ring.c_tilt * (beta_dot - ring_load->outer_beta_dot);
        M[2] += p->ring.k_tilt * (ring_load->gamma - gamma) -
                p->ring.c_tilt * (gamma_dot - ring_load->outer_gamma_dot);
    }
    scalar M_f[3];
    frame_moment(ring_load, ring, p->ring.J_p, p->ring.J_t, M_f);
    for (int i = 0; i < 3; i++) M[i] += M_f[i];
    rotor_acceleration(ring, p->ring.J_p, p->ring.J_t, M, a_ddot, &s_dot);
    y_dot[Y_RING_BETA_DOT] = -a_ddot[2];
    y_dot[Y_RING_GAMMA_DOT] = a_ddot[1];
}
