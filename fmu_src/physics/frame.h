// The frame's own motion: the frame turns at omega_f about an axis parallel to X, frame.radius away on -Y,
// and this axis is accelerated by frame.a.  All motions are relative to the frame; bodies feel, beside the
// forces on them,
//
//   translation  m (field + omega_f^2 (0, y, z) - 2 omega_f e_x x v - omega_f' e_x x s)
//                field = gravity - frame.a + omega_f^2 R e_y - omega_f' R e_z        at the bearing's centre s = 0
//   rotation     with W = omega_f e_x, the angular momentum I (Omega + W) and I = J_t + (J_p - J_t) a a^T
//                M_f = -d(I W)/dt - W x I (Omega + W)
//                d(I W)/dt = (J_p - J_t) (a' (a.W) + a (a'.W)) + I W'
//
// Coriolis forces do no work; the power of the other inertia forces is force times v plus M_f.Omega.  A ball is a
// sphere: M_f = -J (W' + W x omega).
#pragma once

#include "physics/rotor.h"

// Whether the frame turns: only then there is more than the field.
INLINE bool frame_turns(const RingLoad *ring_load)
{
#ifdef DUAL
    (void)ring_load;
    return true;
#else
    return ring_load->frame_turns != 0.0;
#endif
}

// Acceleration by gravity and the frame's inertia forces at the place s with the velocity v.
INLINE void frame_acceleration(const RingLoad *ring_load, const scalar s[3], const scalar v[3], scalar acc[3])
{
    const scalar w = ring_load->frame_omega, w_dot = ring_load->frame_omega_dot;
    for (int i = 0; i < 3; i++) acc[i] = ring_load->field[i];
    if (!frame_turns(ring_load)) return;
    acc[1] += w * w * s[1] + 2.0 * w * v[2] + w_dot * s[2];
    acc[2] += w * w * s[2] - 2.0 * w * v[1] - w_dot * s[1];
}

// Moment M_f on a body with the moments of inertia J_p, J_t about its centre of mass.
INLINE void frame_moment(const RingLoad *ring_load, const Rotor *rotor, double J_p, double J_t, scalar M_f[3])
{
    for (int i = 0; i < 3; i++) M_f[i] = 0.0;
    if (!frame_turns(ring_load)) return;
    const scalar w = ring_load->frame_omega, w_dot = ring_load->frame_omega_dot;
    const scalar *a = rotor->a, *a_dot = rotor->a_dot;
    const double J = J_p - J_t;
    scalar L[3];  // I (Omega + W)
    const scalar along = dot3(a, rotor->Omega) + w * a[0];
    for (int i = 0; i < 3; i++) L[i] = J_t * (rotor->Omega[i] + (i == 0 ? w : 0.0)) + J * along * a[i];
    for (int i = 0; i < 3; i++) {
        const scalar spread = J * (a_dot[i] * a[0] + a[i] * a_dot[0]) * w;
        const scalar rate = (J * a[i] * a[0] + (i == 0 ? J_t : 0.0)) * w_dot;
        M_f[i] = -spread - rate;
    }
    M_f[1] += w * L[2];
    M_f[2] -= w * L[1];
}
