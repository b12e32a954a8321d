"""The frame's own motion: the frame turns at omega_f about an axis parallel to X, frame.radius away on -Y, and this
axis is accelerated by frame.a.

All motions are relative to the frame; bodies feel, beside the forces on them,

    translation  m (field + omega_f^2 (0, y, z) - 2 omega_f e_x x v - omega_f' e_x x s)
                 field = gravity - frame.a + omega_f^2 R e_y - omega_f' R e_z        at the bearing's centre s = 0
    rotation     with W = omega_f e_x, the angular momentum I (Omega + W) and I = J_t + (J_p - J_t) a a^T
                 M_f = -d(I W)/dt - W x I (Omega + W),   d(I W)/dt = (J_p - J_t) (a' (a.W) + a (a'.W)) + I W'

Coriolis forces do no work; the power of the others is that on m v and M_f.Omega.  A ball is a sphere: M_f = -J (W' + W
x omega).
"""

from bearing_model.numbers.vec import vec, vec_cross, vec_dot


def frame_acceleration(ring_load, s, v):
    """Acceleration by gravity and the frame's inertia forces at the place s with the velocity v, [3, ...] each."""
    w, w_dot, field = ring_load.frame_omega, ring_load.frame_omega_dot, ring_load.field
    return vec(
        field[0] + 0.0 * s[0],
        field[1] + w * w * s[1] + 2.0 * w * v[2] + w_dot * s[2],
        field[2] + w * w * s[2] - 2.0 * w * v[1] - w_dot * s[1],
    )


def frame_moment(ring_load, rotor, J_p, J_t):
    """Moment M_f on a body with the moments of inertia J_p, J_t about its centre of mass."""
    a, a_dot, J = rotor.a, rotor.a_dot, J_p - J_t
    W, W_dot = (vec(value + 0.0 * a[0], 0.0, 0.0) for value in (ring_load.frame_omega, ring_load.frame_omega_dot))

    def momentum(Omega):
        return J_t * Omega + J * vec_dot(a, Omega) * a

    spread = J * (a_dot * vec_dot(a, W) + a * vec_dot(a_dot, W))
    return -spread - momentum(W_dot) - vec_cross(W, momentum(rotor.Omega + W))
