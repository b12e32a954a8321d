// The outer ring's motion: a rigid body that moves as the inputs housing.* say.
//
// Laws between a body and the outer ring are those of a ring at rest in the frame that moves with the ring: velocities
// are taken against v + Omega x (P - x), forces and powers follow.
#pragma once

#include "numbers/vec.h"
#include "physics/rotor.h"

// Whether the outer ring moves or is out of its place: only then the elements take its motion into account.
// Derivatives always do, because they include those by the motion, also where it is 0.
INLINE bool outer_ring_moves(const RingLoad *ring_load)
{
#ifdef DUAL
    (void)ring_load;
    return true;
#else
    return ring_load->outer_moves != 0.0;
#endif
}

// Place, axis and motion of the outer ring.
INLINE Rotor outer_ring(const RingLoad *ring_load)
{
    Rotor ring = {0};
    for (int i = 0; i < 3; i++) {
        ring.x[i] = ring_load->outer_x[i];
        ring.v[i] = ring_load->outer_v[i];
    }
    rotor_axis(&ring, ring_load->outer_beta, ring_load->outer_gamma, ring_load->outer_beta_dot,
               ring_load->outer_gamma_dot, ring_load->outer_omega);
    return ring;
}

// Velocity of the outer ring's material at the points p, seen from the balls' frames.
INLINE vec outer_ring_velocity(const Rotor *ring, vec p, wide cos_theta, wide sin_theta)
{
    const vec arm = vec_sub(p, vec_local(ring->x, cos_theta, sin_theta));
    return vec_add(vec_local(ring->v, cos_theta, sin_theta),
                   vec_cross(vec_local(ring->Omega, cos_theta, sin_theta), arm));
}
