"""Riveted joint k: plates pressed together by the rivet, friction of plates and heads, the rivet's shank in its holes.

       |  T  |          u    hole of half 1 - hole of half 0 at rivet k, in the body frame of half 0 (turns with the cage), v its rate
    ---+-   -+---       rivet tension   T = max(0, P + k_rivet u_x)
    half 1     | u_x    plate force     N_plate = max(0, P - k_plate u_x), damped by c v_x N_plate/(N_plate + F_floor)
    ===+=====+===       plate friction  S = -k_t z,  z' = v - |v| k_t z/(mu (N_plate + dT) + F_floor)    Dahl (1968): a friction state, no creep
    half 0     |        head friction   H = -k_h z_h, likewise with mu (T + dT) + F_floor
    ---+-   -+---       hole contact    B = -k_hole max(0, |u| - gap) u/|u|,  gap = max(0, -fit_a): the diametral play
       |     |
Under a growing transverse load the plates slip first (at mu (P + dT)), then the heads slip on the rivet (at as much
more), then the halves move freely across the gap, and at last the shank bears against its holes.
dT (cage_joint_prying): the cage's centrifugal load pries at every joint, so that the rivet pulls and the edges of the
pads press with dT more.  Both forces are in one joint and balance: they move no half, but friction has them.
Force and reaction act at the same point, so momentum and energy are exact.  External tension of the joint: N = T -
N_plate. Smoothness: C0 at opening and bearing (a spring of finite stiffness begins), C0 at v = 0.
"""

import numpy as np

from bearing_model.generated.variables import JOINT_HEAD_Y, JOINT_HEAD_Z, JOINT_PLATE_Y, JOINT_PLATE_Z, CageModel
from bearing_model.numbers.lanes import ball_array_sum, maximum
from bearing_model.numbers.vec import vec, vec_cross, vec_dot


def cage_joint_kinematics(model, w):
    """Offset u and velocity v of half 1 against half 0 at the rivets, in the frame of half 0."""
    h0, h1 = w.half
    s_y, s_z = model.d.rivet_y, model.d.rivet_z
    g, omega = h1.x - h0.x, h1.Omega - h0.Omega
    v = h1.v - h0.v - vec_cross(h0.Omega, g)
    spin_y, spin_z = vec_cross(omega, h1.b_y), vec_cross(omega, h1.b_z)

    # u = offset + (A - 1) s with A = axes of half 1 in half 0, s = (0, rivet_y, rivet_z); v likewise with the rates
    axes = (h0.a, h0.b_y, h0.b_z)
    w.u = np.array(
        [
            vec_dot(e, g) + (vec_dot(e, h1.b_y) - (i == 1)) * s_y + (vec_dot(e, h1.b_z) - (i == 2)) * s_z
            for i, e in enumerate(axes)
        ]
    )
    w.v_j = np.array([vec_dot(e, v) + vec_dot(e, spin_y) * s_y + vec_dot(e, spin_z) * s_z for e in axes])


def cage_joint_prying(model, w):
    """Prying force dT [..., 1] in N: what the cage's centrifugal load adds to the rivet's tension and to the plates'
    contact force.

    T_rest - P of joints that are all alike (joint_law.py), at their mean preload.  C1 in the cage's speed: the cubic
    through the states of the table, which are at equal steps of x = c/(c + P), with slopes by central differences.
    """
    d, law = model.d, model.d.table.half.law
    omega_2 = 0.5 * (w.half[0].s ** 2 + w.half[1].s ** 2)
    c = np.abs(d.spin[4]) / law.length * omega_2
    P = maximum(d.P_mean + d.spin[5] * omega_2, 0.0)
    s = c + P
    tension = law.alike.values[:, 3]
    last = len(tension) - 1
    x = c / np.where(np.real(s) > 0.0, s, 1.0) * last
    i = np.minimum(np.real(x), last - 1.0).astype(int)
    slopes = np.gradient(tension)
    start, rise = tension[i], tension[i + 1] - tension[i]
    u = x - i
    v = 1.0 - u
    T = start + u * rise + u * v * (v * (slopes[i] - rise) + u * (rise - slopes[i + 1]))
    return np.where(np.real(c) > 0.0, s * T - d.P_mean * tension[0], 0.0)


def cage_joint_friction(k, capacity, z_y, z_z, v_y, v_z):
    """Dahl's friction with force -k z: rates of z, their decay D, the dissipated power."""
    # |v| has no derivative at v = 0; the complex step of |v| is taken as 0 there
    speed_2 = v_y * v_y + v_z * v_z
    speed = np.sqrt(np.where(np.real(speed_2) > 0.0, speed_2, 0.0))
    rate = speed * k / capacity
    return v_y - rate * z_y, v_z - rate * z_z, rate, k * rate * (z_y * z_y + z_z * z_z)


def cage_joint_advance(model, w, h, y):
    """The friction states in y [N_STATES] over a step h [s] at the offsets and velocities of w: z += h z'/(1 + h D/2),
    D = |v| k/capacity.

    The implicit midpoint rule of z' = v - D z, solved in closed form.  Returns what they dissipate, h k D z_m^2 with
    z_m in the middle [J].
    """
    p, d = model.p, model.d
    u_x, (_, v_y, v_z) = w.u[0], w.v_j
    if p.scene.cage == CageModel.ELASTIC:
        plates, heads = w.N_plate, w.T  # of the law of the joint (cage_elastic.py)
    else:
        dT = cage_joint_prying(model, w)
        T, N_plate = d.intact * maximum(d.P + d.k_rivet * u_x, 0.0), maximum(d.P - d.k_plate * u_x, 0.0)
        plates, heads = (maximum(force + d.intact * dT, 0.0) for force in (N_plate, T))
    k_t, k_h, _ = joint_stiffness(model)
    lost = 0.0
    for k, load, blocks in ((k_t, plates, (JOINT_PLATE_Y, JOINT_PLATE_Z)), (k_h, heads, (JOINT_HEAD_Y, JOINT_HEAD_Z))):
        rate = np.hypot(v_y, v_z) * k / (p.joint.mu * load + p.joint.F_floor)
        for v, z in zip((v_y, v_z), blocks, strict=True):
            change = h * (v - rate * y[z]) / (1.0 + 0.5 * h * rate)
            lost += np.sum(h * k * rate * (y[z] + 0.5 * change) ** 2)
            y[z] += change
    return lost


def cage_joint_shear(model, y, w):
    """Forces (y, z) [2, Z] on half 1 of elastic halves' joints in the plane, by the offsets in w and the friction
    states in y, in the frame of half 0.
    """
    k_t, k_h, k_hole = joint_stiffness(model)
    _, u_y, u_z = w.u
    slip = np.sqrt(u_y * u_y + u_z * u_z + 1e-30)
    bearing = k_hole * maximum(slip - model.d.hole_gap, 0.0) / slip
    return np.array(
        [
            -k_t * y[JOINT_PLATE_Y] - k_h * y[JOINT_HEAD_Y] - bearing * u_y,
            -k_t * y[JOINT_PLATE_Z] - k_h * y[JOINT_HEAD_Z] - bearing * u_z,
        ]
    )


def joint_stiffness(model):
    """Stiffnesses of plates, heads and holes in the plane [N/m]; of elastic halves in series with what their modes
    leave (cage_elastic.py).
    """
    d = model.d
    if model.p.scene.cage != CageModel.ELASTIC:
        return d.k_plate_t, d.k_head, d.k_hole
    return d.elastic.series * d.k_plate_t, d.elastic.series * d.k_head, d.elastic.k_hole


def cage_joint_force(model, y, w):
    """Adds the joints' wrench to both halves; sets the rates of the friction states and the loads of the joints."""
    p, d = model.p, model.d
    u_x, u_y, u_z = w.u
    v_x, v_y, v_z = w.v_j
    zp_y, zp_z, zh_y, zh_z = (y[..., block] for block in (JOINT_PLATE_Y, JOINT_PLATE_Z, JOINT_HEAD_Y, JOINT_HEAD_Z))

    elastic = p.scene.cage == CageModel.ELASTIC
    k_t, k_h, k_hole = joint_stiffness(model)
    damping, dT, f_x = 0.0, 0.0, 0.0
    if elastic:  # the law of the joint (cage_elastic.py) has given T and N_plate
        f_x = -w.joint_load[0]
    else:
        w.T, w.N_plate = d.intact * maximum(d.P + d.k_rivet * u_x, 0.0), maximum(d.P - d.k_plate * u_x, 0.0)
        damping = d.c_joint * w.N_plate / (w.N_plate + p.joint.F_floor)
        dT = cage_joint_prying(model, w)
        f_x = w.N_plate - w.T - damping * v_x
    plates, heads = (p.joint.mu * maximum(force + d.intact * dT, 0.0) + p.joint.F_floor for force in (w.N_plate, w.T))
    w.plate_y_dot, w.plate_z_dot, w.plate_rate, lost_plate = cage_joint_friction(k_t, plates, zp_y, zp_z, v_y, v_z)
    w.head_y_dot, w.head_z_dot, w.head_rate, lost_head = cage_joint_friction(k_h, heads, zh_y, zh_z, v_y, v_z)
    w.joint_dissipated = lost_plate + lost_head + damping * v_x * v_x

    slip = np.sqrt(u_y * u_y + u_z * u_z + 1e-30)
    bearing = k_hole * maximum(slip - d.hole_gap, 0.0) / slip
    w.k_bearing = k_hole * (np.real(slip) > d.hole_gap)
    w.S, w.H, w.B = np.array([-k_t * zp_y, -k_t * zp_z]), np.array([-k_h * zh_y, -k_h * zh_z]), -bearing * w.u[1:]
    axial = 2.0 * w.joint_potential if elastic else w.T**2 / d.k_rivet + w.N_plate**2 / d.k_plate
    w.joint_energy = 0.5 * (
        axial + k_t * (zp_y**2 + zp_z**2) + k_h * (zh_y**2 + zh_z**2) + k_hole * maximum(slip - d.hole_gap, 0.0) ** 2
    )

    # force on half 1 at its hole, which lies at s + u from the centre of half 0; in the frame of half 0
    f = w.joint_force = vec(f_x, *(w.S + w.H + w.B))
    u_x, u_y, u_z = w.u_rigid if elastic else w.u  # modes move no centre of mass
    r = vec(u_x, d.rivet_y + u_y, d.rivet_z + u_z)
    F, M = ball_array_sum(f), ball_array_sum(vec_cross(r, f))

    # wrench in the global frame: half 0 gets -F and -M, half 1 gets F and the moment about its own centre
    h0, h1 = w.half
    force, moment = (h0.a * v[0] + h0.b_y * v[1] + h0.b_z * v[2] for v in (F, M))
    h0.F = h0.F - force
    h0.M = h0.M - moment
    h1.F = h1.F + force
    h1.M = h1.M + moment - vec_cross(h1.x - h0.x, force)
