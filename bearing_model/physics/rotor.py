"""A rigid axisymmetric body: inner ring or cage half.

axis a = (a_x, gamma, -beta), a unit vector: beta turns +X toward -Z, gamma turns +X toward +Y, exact for any tilt below
90 degrees
angular velocity Omega = a x a_dot + s a,  s spin about the axis
minimal rotation T of e_x to a:  T v = v - (a.v)/(1 + a_x) (a + e_x)  for v across e_x;  T turns about a at the rate
roll,
so the rotation psi about the axis has psi_dot = s - roll,  roll = (a_y' a_z - a_z' a_y)/(1 + a_x)
angular momentum J_t a x a_dot + J_p s a, its rate M:   s_dot = M.a/J_p,   a_ddot = m x a - |a_dot|^2 a,
                                                        m = (M - (M.a) a - J_p s a_dot)/J_t
"""

from types import SimpleNamespace

import numpy as np

from bearing_model.numbers.vec import vec, vec_cross, vec_dot


class Rotor(SimpleNamespace):
    """Pose, velocity and load of a body in the global frame, vectors [3, ..., 1].

    x, v geometric centre; a, a_dot axis and its rate; Omega, s angular velocity and spin; b_y, b_z body axes across, c
    centre of mass - geometric centre (cage halves); F, M force and moment about the geometric centre by all contacts.
    """


def rotor_axis(rotor, beta, gamma, beta_dot, gamma_dot, s):
    """Set the axis, its rate and the angular velocity."""
    a_x = np.sqrt(1.0 - beta * beta - gamma * gamma)
    a, a_dot = vec(a_x, gamma, -beta), vec(-(beta * beta_dot + gamma * gamma_dot) / a_x, gamma_dot, -beta_dot)
    rotor.a, rotor.a_dot = a, a_dot
    rotor.Omega = vec_cross(a, a_dot) + s * a
    rotor.s = s


def rotor_roll(rotor):
    """Rate at which the minimal rotation T turns about the axis: psi_dot = s - roll."""
    return (rotor.a_dot[1] * rotor.a[2] - rotor.a_dot[2] * rotor.a[1]) / (1.0 + rotor.a[0])


def rotor_body_axes(rotor, cos_psi, sin_psi):
    """Body axes b_y, b_z: T (0, cos psi, sin psi) and T (0, -sin psi, cos psi)."""
    a, e_x = rotor.a, np.array([1.0, 0.0, 0.0]).reshape(3, *[1] * np.ndim(cos_psi))

    def tilted(v):
        return v - vec_dot(a, v) / (1.0 + a[0]) * (a + e_x)

    rotor.b_y = tilted(vec(0.0, cos_psi, sin_psi))
    rotor.b_z = tilted(vec(0.0, -sin_psi, cos_psi))


def rotor_acceleration(rotor, J_p, J_t, M):
    """Accelerations of the axis and of the spin under the moment M about the centre of mass."""
    a, a_dot, M_a = rotor.a, rotor.a_dot, vec_dot(M, rotor.a)
    m = (M - M_a * a - J_p * rotor.s * a_dot) / J_t
    a_ddot = vec_cross(m, a) - vec_dot(a_dot, a_dot) * a
    return a_ddot, M_a / J_p
