// A rigid axisymmetric body: inner ring or cage half.
//
//   axis a = (a_x, gamma, -beta), a unit vector: beta turns +X toward -Z, gamma turns +X toward +Y, exact for any tilt
//   below 90 degrees
//   angular velocity Omega = a x a_dot + s a,  s spin about the axis
//   minimal rotation T of e_x to a:  T v = v - (a.v)/(1 + a_x) (a + e_x)  for v across e_x;  T turns about a at the rate
//   roll = (a_y' a_z - a_z' a_y)/(1 + a_x), so that the rotation psi about the axis has psi_dot = s - roll
//   angular momentum J_t a x a_dot + J_p s a, its rate M:   s_dot = M.a/J_p,   a_ddot = -a x m - |a_dot|^2 a,
//                                                           m = (M - (M.a) a - J_p s a_dot)/J_t
#pragma once

#include "physics/model.h"

static inline scalar dot3(const scalar u[3], const scalar v[3])
{
    return u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
}

static inline void cross3(const scalar u[3], const scalar v[3], scalar out[3])
{
    out[0] = u[1] * v[2] - u[2] * v[1];
    out[1] = u[2] * v[0] - u[0] * v[2];
    out[2] = u[0] * v[1] - u[1] * v[0];
}

// Sets the axis, its rate and the angular velocity.
static inline void rotor_axis(Rotor *rotor, scalar beta, scalar gamma, scalar beta_dot, scalar gamma_dot,
                              scalar s)
{
    const scalar a_x = scalar_sqrt(1.0 - beta * beta - gamma * gamma);
    scalar *a = rotor->a, *a_dot = rotor->a_dot;
    a[0] = a_x, a[1] = gamma, a[2] = -beta;
    a_dot[0] = -(beta * beta_dot + gamma * gamma_dot) / a_x, a_dot[1] = gamma_dot, a_dot[2] = -beta_dot;
    cross3(a, a_dot, rotor->Omega);
    for (int i = 0; i < 3; i++) rotor->Omega[i] += s * a[i];
    rotor->s = s;
}

// Rate at which the minimal rotation T turns about the axis: psi_dot = s - roll.
static inline scalar rotor_roll(const Rotor *rotor)
{
    return (rotor->a_dot[1] * rotor->a[2] - rotor->a_dot[2] * rotor->a[1]) / (1.0 + rotor->a[0]);
}

// Sets the body axes b_y, b_z: T (0, cos psi, sin psi) and T (0, -sin psi, cos psi).
static inline void rotor_body_axes(Rotor *rotor, scalar cos_psi, scalar sin_psi)
{
    const scalar *a = rotor->a, k = 1.0 / (1.0 + a[0]);
    const scalar k_y = (a[1] * cos_psi + a[2] * sin_psi) * k, k_z = (a[2] * cos_psi - a[1] * sin_psi) * k;
    rotor->b_y[0] = -k_y * (1.0 + a[0]), rotor->b_y[1] = cos_psi - k_y * a[1],
    rotor->b_y[2] = sin_psi - k_y * a[2];
    rotor->b_z[0] = -k_z * (1.0 + a[0]), rotor->b_z[1] = -sin_psi - k_z * a[1],
    rotor->b_z[2] = cos_psi - k_z * a[2];
}

// Accelerations of the axis and of the spin under the moment M about the centre of mass.
static inline void rotor_acceleration(const Rotor *rotor, double J_p, double J_t, const scalar M[3],
                                      scalar a_ddot[3], scalar *s_dot)
{
    const scalar *a = rotor->a, *a_dot = rotor->a_dot, M_a = dot3(M, a);
    scalar m[3];
    for (int i = 0; i < 3; i++) m[i] = (M[i] - M_a * a[i] - J_p * rotor->s * a_dot[i]) / J_t;
    cross3(m, a, a_ddot);
    const scalar rate_2 = dot3(a_dot, a_dot);
    for (int i = 0; i < 3; i++) a_ddot[i] -= rate_2 * a[i];
    *s_dot = M_a / J_p;
}
