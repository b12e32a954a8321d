"""Ball and pocket of a ribbon cage: in each half a sphere with a fillet and two edges.

         x (pole)                      Half 1; half 0 is its mirror image.  The sphere's centre lies e = K - R_c beyond the split, K the
      .--+--.    sheet                 depth of the pocket.
    .'   |   '.                        q = (x, r, t): ball's centre from the sphere's centre, x toward the pole, r along the pocket's
 --'     |     '--  land  -- split     radius, t along its tangent
    fillet  ball                       g: reach of q in the plane of a rim (below)

    sphere   delta = |q| - (R_c - R)                                 Q = K delta^1.5 (1 + 0.7 a/R),  a = sqrt(R_eff delta)
    fillet   delta = R + rho - |(A - g, H - x)|,    A^2 + H^2 = (R_c + rho)^2,  H = rho + e,     round the pole
    edges    delta = R + rho - |(A - g, H - |r|)|,  A^2 + H^2 = (R_c + rho)^2,  H = w/2 - rho,   round the pocket's radius

R_eff = R R_c/(R_c - R).  Fillet and edges are rims: rings of the radius rho of their section that touch the sphere along a circle, the
seam, the fillet's at sin chi_1 = H/(R_c + rho) from the split, the edges' at sin eta = H/(R_c + rho).  From there on they bend away from
the ball, so that a rim's approach is never more than the sphere's and equals it where q points to the seam.  Hertz' law with the curvatures
1/R + 1/rho across the rim and 1/R - 1/R_c along it.

A rim ends at the others: the fillet lies between the edges, an edge between the fillets of both sides.  With u toward the middle of such an
arc, v across and omega half of its opening,  g = sqrt(u^2 + v^2) within it, else u cos omega + v sin omega: the corner.

The part of a patch on the sphere's side of a seam is that of the machined pocket's split (pocket.py), e = 1/2 + 15/16 xi - 5/8 xi^3 + 3/16 xi^5
of the energy, xi = R_c sin(angle of q above the seam)/a, at most 1, a of the rim's approach:

    V = e_f e_e V_sphere + (1 - e_f e_e) (w V_fillet + (1 - w) V_edge),   w = (delta_f/delta_e)^2/2 where delta_f < delta_e,
                                                                          1 - (delta_e/delta_f)^2/2 elsewhere

Beyond a corner both rims have the same approach; elsewhere the rim that is reached farther has the load.  V decides all: the force on the ball
is -dV/dq = -Q n through its centre, the friction acts at the contact point p + R n.  Energy and momentum are conserved exactly.

A push along the tangent touches both halves at sin chi_0 = e/(R_c - R) if that is more than sin chi_1: each half has N = F sin(chi_0 +- beta)
/sin 2 chi_0 of a push at the angle beta from the split, beyond chi_0 one half has all.  0.7 a/R: independent solution of an elastic ball in a
spherical hole (tests/conforming_spheres.py).  Oil between ball and sphere adds the force -F m through the ball's centre, where both close in
(spheres_squeeze.py); the wall bears the force at the place nearest to the ball, as that of the contact.  Smoothness: C1 at touch-down, at the
seams and where the second half begins to carry.  At a corner the force is continuous, its slope is not.
"""

from types import SimpleNamespace

import numpy as np

from bearing_model.cage.common.pocket import elastic_clear, pocket_clear, pocket_mu
from bearing_model.cage.common.pocket_films import RIGID, film_before_wall
from bearing_model.cage.common.spheres_squeeze import spheres_squeeze
from bearing_model.cage.elastic.elastic_wall import ribbon_wall_shapes
from bearing_model.generated.variables import Lubrication
from bearing_model.numbers.lanes import absolute, ball_array_sum, maximum, minimum
from bearing_model.numbers.vec import vec, vec_across, vec_cross, vec_dot, vec_local, vec_to_global
from bearing_model.physics.hertz import hertz_damped
from bearing_model.physics.traction import Q_FLOOR

TIP = 1e-7  # least distance from an axis; way over which both edges change places under a wide patch [m]
SEAT = 5e-6  # way from the middle up to which a ball sits on the corners of both sides [m]
BEND = 0.05  # angle on both sides of the fillet's seam over which a place begins to turn with the ball
LEAST = 1e-12  # load of a pocket that counts as touched [N]
APPROACH_FLOOR = 1e-12  # least approach in the stiffness 3 Q/(2 delta) [m]
NEWTON = 5  # steps for the wall's compliance, at most
# last step, whose error is its square over the approach [m]; derivatives, one step behind, have all steps
SETTLED = 1e-12
TOUCHES = 1e-7  # approach at which a ball that has not arrived yet has its direction and law [m]
CORNER = 4.0  # largest ratio of a contact's approach to that of the sphere under its load, and the least one's inverse


def sphere_side(at, seat):
    """A coordinate of q on either side of the middle, its size, a parabola up to `seat`, and the size's slope."""
    far, slope = absolute(at), maximum(minimum(at / seat, 1.0), -1.0)
    near = minimum(far, seat)
    return at, far - near + 0.5 * (near * near / seat + seat), slope


def arc_reach(rim, u, v):
    """Reach g of (u, v) along the rim's arc, and its slopes along the coordinates u and v; both as sphere_side gives them."""
    (u, u_size, u_slope), (v, v_size, v_slope) = u, v
    g = np.sqrt(u * u + v * v + 1e-30)
    within = np.real(u_size * rim.sin_arc - v_size * rim.cos_arc) > 0.0
    corner = u_size * rim.cos_arc + v_size * rim.sin_arc
    along_u, along_v = np.where(within, u / g, rim.cos_arc * u_slope), np.where(within, v / g, rim.sin_arc * v_slope)
    return np.where(within, g, corner), along_u, along_v


def rim_contact(d, rim, g, h, inside):
    """Contact with a rim at the reach g in its plane and the height h above it, where q lies above its seam by the angle of the sine `inside`:
    approach, energy, load, slope of the approach (along g, along h); part of the energy that the sphere has by this seam, and its slopes along
    `inside` and along the approach.
    """
    off_g, off_h = rim.A - g, rim.H - h
    apart = np.sqrt(off_g * off_g + off_h * off_h)
    delta = rim.reach - d.slack - apart
    own = maximum(delta, 1e-30)
    root = np.sqrt(own)
    load = np.where(np.real(delta) > 0.0, rim.K * own * root, 0.0)

    wide = d.radius / (d.a_delta * root)
    xi = maximum(minimum(wide * inside, 1.0), -1.0)
    xi_2 = xi * xi
    steep = 15.0 / 16.0 * (1.0 - xi_2) * (1.0 - xi_2)
    return SimpleNamespace(
        delta=delta,
        energy=0.4 * load * own,
        load=load,
        slope=(off_g / apart, off_h / apart),
        share=0.5 + xi * (15.0 / 16.0 - xi_2 * (0.625 - 3.0 / 16.0 * xi_2)),
        by_inside=steep * wide,
        by_delta=-0.5 * steep * xi / own,  # 0 where xi is at its bounds
    )


def rim_pair(f, edge):
    """Fillet and edge together: the one that is reached farther has the energy, near a corner both.  Energy, part of the fillet, and slopes of
    that part along both approaches.
    """
    own_f, own_e = maximum(f.delta, 0.0), maximum(edge.delta, 0.0)
    most = maximum(maximum(own_f, own_e), 1e-30)
    ratio = minimum(own_f, own_e) / most
    less, edge_more = 0.5 * ratio * ratio, np.real(own_e - own_f) > 0.0
    fillet = np.where(edge_more, less, 1.0 - less)
    by_f = np.where(edge_more, ratio, ratio * ratio) / most
    by_e = -np.where(edge_more, ratio * ratio, ratio) / most
    return edge.energy + fillet * (f.energy - edge.energy), fillet, by_f, by_e


def spheres_nearest(d, x, r, t):
    """Approach of the nearest place of sphere and rims [m], and that by which no contact is missed: of a ball within the sphere, the sphere's."""
    sides, R_r = sphere_side(t, SEAT), sphere_side(r, TIP)
    sphere = np.sqrt(x * x + r * r + t * t) - d.slack
    above = x * d.fillet.cos - np.sqrt(t * t + r * r) * d.fillet.sin
    below = np.sqrt(x * x + t * t) * d.edge.sin - R_r[1] * d.edge.cos
    g, k = arc_reach(d.fillet, sides, R_r)[0], arc_reach(d.edge, (x, x, 1.0), sides)[0]
    f = d.fillet.reach - d.slack - np.sqrt((d.fillet.A - g) ** 2 + (d.fillet.H - x) ** 2)
    e = d.edge.reach - d.slack - np.sqrt((d.edge.A - k) ** 2 + (d.edge.H - R_r[1]) ** 2)
    nearest = np.where(np.real(minimum(above, below)) > 0.0, sphere, maximum(f, e))
    return nearest, np.where(np.real(sphere) > 0.0, nearest, sphere)


def spheres_contact(d, x, r, t):
    """Elastic contact of a ball whose centre is at q = (x, r, t) from the sphere's: energy V [J], load Q [N], direction n (x, r, t) into the
    wall, approach [m]; of a ball within the sphere, the sphere's.
    """
    sides, (_, R_r, r_slope) = sphere_side(t, SEAT), sphere_side(r, TIP)

    # sphere
    s = np.sqrt(x * x + r * r + t * t + 1e-30)
    delta = s - d.slack
    own = maximum(delta, 0.0)
    root = np.sqrt(maximum(own, 1e-30))
    energy = d.K * own * own * (0.4 * root + d.more / 3.0 * own)
    load = d.K * own * (root + d.more * own) / s

    # rims; the sphere lies above the fillet's seam and below the edge's
    round_pole, round_r = np.sqrt(t * t + r * r + TIP**2), np.sqrt(x * x + t * t + TIP**2)
    in_f = (x * d.fillet.cos - round_pole * d.fillet.sin) / s
    in_e = (round_r * d.edge.sin - R_r * d.edge.cos) / s
    g, g_t, g_r = arc_reach(d.fillet, sides, sphere_side(r, TIP))
    k, k_x, k_t = arc_reach(d.edge, (x, x, 1.0), sides)
    f, edge = rim_contact(d, d.fillet, g, x, in_f), rim_contact(d, d.edge, k, R_r, in_e)
    rims, fillet, by_f, by_e = rim_pair(f, edge)
    share = f.share * edge.share
    rest, over = 1.0 - share, energy - rims
    V = rims + share * over

    # slopes along the approaches of both rims and along both angles; gradient along x, r, t
    between = f.energy - edge.energy
    of_f = rest * (fillet * f.load + between * by_f) + over * edge.share * f.by_delta
    of_e = rest * ((1.0 - fillet) * edge.load + between * by_e) + over * f.share * edge.by_delta
    turn_f, turn_e = over * edge.share * f.by_inside / s, over * f.share * edge.by_inside / s
    out = share * load - (turn_f * in_f + turn_e * in_e) / s
    along_g, along_k = of_f * f.slope[0], of_e * edge.slope[0]
    pole, across = turn_f * d.fillet.sin / round_pole, turn_e * d.edge.sin / round_r
    V_x = of_f * f.slope[1] + turn_f * d.fillet.cos + along_k * k_x + (out + across) * x
    V_r = (of_e * edge.slope[1] - turn_e * d.edge.cos) * r_slope + along_g * g_r + (out - pole) * r
    V_t = along_g * g_t + along_k * k_t + (out + across - pole) * t
    Q = np.sqrt(V_x * V_x + V_r * V_r + V_t * V_t + 1e-60)
    nearest = share * delta + rest * maximum(f.delta, edge.delta)
    return V, Q, (V_x / Q, V_r / Q, V_t / Q), np.where(np.real(delta) > 0.0, nearest, delta)


def spheres_gap(model, w, h):
    """Where the balls are in the spheres of half h: axes a, b, e_t of the pockets, ball centre less geometric centre of the half p, and q
    (x, r, t), x toward the pole.
    """
    d, half, side = model.d, w.half[h], 2 * h - 1
    a, b_y, b_z, x_h = (vec_local(v, w.cos_theta, w.sin_theta) for v in (half.a, half.b_y, half.b_z, half.x))
    b = d.pocket_cos * b_y + d.pocket_sin * b_z
    e_t = vec_cross(a, b)
    p = vec(w.x, w.r, 0.0) - x_h
    q = side * vec_dot(p, a) + d.spheres.e, vec_dot(p, b) - d.spheres.r, vec_dot(p, e_t)
    return SimpleNamespace(a=a, b=b, e_t=e_t, p=p, q=q, side=side)


def spheres_approach(d, c, q):
    """spheres_contact at q with the compliance c of the wall under the contact in series [m/N]: the ball is at q - c Q n, by Newton's method
    with the stiffness 3 Q/(2 delta) along n and Q/|q| across it; V with the energy of the wall there.
    """
    V, Q, n, delta = spheres_contact(d, *q)
    give, moving, exact = [0.0 * x for x in q], np.real(Q) > 0.0, any(np.iscomplexobj(x) for x in q)
    for _ in range(NEWTON):
        along = 1.0 / (1.0 + 1.5 * c * Q / maximum(delta, APPROACH_FLOOR))
        across = 1.0 / (1.0 + c * Q / np.sqrt(sum((x - s) ** 2 for x, s in zip(q, give, strict=True)) + TIP**2))
        off = [c * Q * n_i - s for n_i, s in zip(n, give, strict=True)]
        normal = (along - across) * sum(n_i * o for n_i, o in zip(n, off, strict=True))
        step = [np.where(moving, across * o + normal * n_i, 0.0) for o, n_i in zip(off, n, strict=True)]
        give = [s + d_s for s, d_s in zip(give, step, strict=True)]
        V, Q, n, delta = spheres_contact(d, *(x - s for x, s in zip(q, give, strict=True)))
        moving = moving & (exact | (np.real(sum(s * s for s in step)) > SETTLED**2))
    return V + 0.5 * c * Q * Q, Q, n, delta


def spheres_place(d, half, q):
    """Place where a ball at q touches the wall of an elastic half: chi about the sphere's centre, seen along r, radius from the bearing's axis,
    front (ribbon_wall_shapes); slopes of chi and radius along q, of front along t.

    chi begins at the table's first node, the seam of the fillet, beyond which it has no slope.
    """
    x, r, t = q
    ahead, aside = maximum(x, 0.0), np.sqrt(t * t + SEAT**2)
    rho_2 = ahead * ahead + aside * aside
    past = np.arctan(ahead / aside) - half.chi[0]
    bend = minimum(maximum(past + BEND, 0.0), 2.0 * BEND)
    chi, follows = half.chi[0] + bend * bend / (4.0 * BEND) + maximum(past - BEND, 0.0), bend / (2.0 * BEND)
    chi_slope = follows * aside / rho_2, 0.0 * x, -follows * ahead * t / aside / rho_2
    part = maximum(minimum(t / SEAT, 1.0), -1.0)
    front, front_slope = part * (1.5 - 0.5 * part * part), 1.5 / SEAT * (1.0 - part * part)
    s_2 = x * x + r * r + t * t + TIP**2
    to_wall = d.radius / np.sqrt(s_2)
    across, along = d.r + to_wall * r, to_wall * t
    radius = np.sqrt(across * across + along * along)
    pull = (across * r + along * t) / s_2
    by_r, by_t = to_wall * across / radius, to_wall * along / radius
    less = to_wall * pull / radius
    radius_slope = -less * x, by_r - less * r, by_t - less * t
    return chi, radius, front, chi_slope, radius_slope, front_slope


def sphere_film(d, gap, Q, c, v):
    """The film of oil of one half; Q: load of the contact, c: compliance of the wall under the contact."""
    along = gap.side * vec_dot(v, gap.a), vec_dot(v, gap.b), vec_dot(v, gap.e_t)
    film = spheres_squeeze(d, gap.q, c * Q, along)
    film.m = gap.side * film.m[0] * gap.a + film.m[1] * gap.b + film.m[2] * gap.e_t
    return film


def sphere_wet(d, q, moves):
    """Balls before whose sphere there may be a film when the wall moves by up to `moves`."""
    if not d.squeeze:
        return False
    S = np.sqrt(np.real(q[0]) ** 2 + np.real(q[1]) ** 2 + np.real(q[2]) ** 2)
    return S - d.spheres.slack + (d.squeeze.reach + moves) > 0.0


def spheres_wall(model, w, h, gap):
    """Motion of the walls of elastic half h where balls may touch: takes it from gap.q; velocity u_dot along the pocket's axes and shapes of the
    modes [3, ..., Z, n]; slopes of the motion along q.
    """
    half, e = model.modes, w.cage.elastic
    chi, radius, front, chi_slope, radius_slope, front_slope = spheres_place(model.d.spheres, half, gap.q)
    shape, by_chi, by_r, by_front = ribbon_wall_shapes(half, gap.side, chi, radius, front)
    q, q_dot = e.q[h], e.q_dot[h]
    poleward = np.array([gap.side, 1.0, 1.0]).reshape(-1, *[1] * (shape.ndim - 2))

    # walls that cannot be reached: by how far they can move, and by that without the modes that move all pockets alike
    near = np.real(spheres_nearest(model.d.spheres, *gap.q)[1]) + (gap.ahead + e.reach[h]) > 0.0
    near = near | sphere_wet(model.d, gap.q, e.reach[h])
    alike = near * np.sum(np.where(half.uniform, shape * q, 0.0), axis=-1)
    there = tuple(x - u_i for x, u_i in zip(gap.q, poleward * alike, strict=True))
    touched = np.real(spheres_nearest(model.d.spheres, *there)[1]) + (gap.ahead + e.reach_others[h]) > 0.0
    near = near & (touched | sphere_wet(model.d, there, e.reach_others[h]))

    u = np.where(near, np.sum(shape * q, axis=-1), alike)
    u_dot, u_chi, u_r, u_front = (
        np.sum(a * b, axis=-1) * near for a, b in ((shape, q_dot), (by_chi, q), (by_r, q), (by_front, q))
    )
    gap.q = tuple(x - u_i for x, u_i in zip(gap.q, poleward * u, strict=True))
    u_chi, u_r, u_front = poleward * u_chi, poleward * u_r, poleward * u_front
    slopes = [u_chi * a + u_r * b for a, b in zip(chi_slope, radius_slope, strict=True)]  # of u, along x, r, t
    slopes[2] = slopes[2] + u_front * front_slope
    return SimpleNamespace(u_dot=u_dot, shape=shape, slopes=slopes, chi=chi, radius=radius, front=front, near=near)


def spheres_forces(model, w, h, gap, wall=None):
    """Forces in the pockets of half h: sets w.pocket[h] and w.delta_c[h], adds to the balls.  wall: of an elastic half (spheres_wall).  Returns
    energy, direction n, loads and rate of approach, and the forces (x, r, t) on the walls.
    """
    p, d, half = model.p, model.d, w.half[h]
    v_h, Omega = (vec_local(v, w.cos_theta, w.sin_theta) for v in (half.v, half.Omega))
    omega_b, v_b = vec(w.omega_x, w.omega_r, w.omega_t), vec(w.v_x, w.v_r, w.v_t)
    v = v_b - v_h - vec_cross(Omega, gap.p)
    if wall:
        v = v - (wall.u_dot[0] * gap.a + wall.u_dot[1] * gap.b + wall.u_dot[2] * gap.e_t)

    # normal force
    compliance = model.modes.compliance if wall else 0.0
    V, Q_0, n_q, w.delta_c[h] = (
        spheres_approach(d.spheres, compliance, gap.q) if wall else spheres_contact(d.spheres, *gap.q)
    )
    film = d.squeeze and sphere_film(d, gap, Q_0, compliance, v)
    pressed = np.real(Q_0) > LEAST
    Q_0 = np.where(pressed, Q_0, 0.0)
    n_x, n_r, n_t = gap.side * n_q[0], n_q[1], n_q[2]
    n = n_x * gap.a + n_r * gap.b + n_t * gap.e_t
    delta_dot = vec_dot(n, v)
    Q = hertz_damped(Q_0, p.cage.lambda_, delta_dot)

    # friction at the contact point
    arm = d.R * n
    slip = vec_across(v + vec_cross(omega_b - Omega, arm), n)
    slip_2 = vec_dot(slip, slip)
    ln_U, ln_Q = 0.5 * np.log(0.25 * slip_2 + p.oil.U_0**2), np.log(Q + Q_FLOOR)
    mixed = p.scene.lubrication == Lubrication.MIXED
    g = pocket_mu(model, ln_U, ln_Q, mixed) * Q / np.sqrt(slip_2 + p.cage.v_c**2)
    F_s = -g * slip
    F, M = F_s - Q * n, vec_cross(arm, F_s)
    push, by_film = (n_x, n_r, n_t), (0.0, 0.0, 0.0)
    if film:
        F = F - film.F * film.m
        by_film = [film.F * vec_dot(film.m, axis) for axis in (gap.a, gap.b, gap.e_t)]
        push = [Q * n_i + f_i for n_i, f_i in zip(push, by_film, strict=True)]
        size = np.sqrt(sum(x * x for x in push) + 1e-60)
        push = [x / size for x in push]
        wet = pressed | (wall.near & sphere_wet(d, gap.q, 0.0)) if wall else True
        w.films[h] = film_before_wall(film, v, (gap.a, gap.b, gap.e_t), wall.shape if wall else RIGID, wet)
    if wall:  # the wall's place moves with the ball
        tilt = [Q_0 * sum(n_i * u_i for n_i, u_i in zip(n_q, slope, strict=True)) for slope in wall.slopes]
        F = F + (gap.side * tilt[0] * gap.a + tilt[1] * gap.b + tilt[2] * gap.e_t)

    w.pocket[h] = SimpleNamespace(
        Q=Q + film.F if film else Q,
        F=np.array([-vec_dot(F, gap.a), -vec_dot(F, gap.b), -vec_dot(F, gap.e_t)]),
        # place of the contact on the wall
        push=np.array([gap.side * gap.q[0] + d.R * push[0], gap.q[2] + d.R * push[2]]),
        radius=np.sqrt((gap.q[1] + d.R * push[1] + d.spheres.r) ** 2 + (gap.q[2] + d.R * push[2]) ** 2),
        half_F=vec_to_global(-F, w.cos_theta, w.sin_theta),
        half_M=vec_to_global(-vec_cross(gap.p, F) - M, w.cos_theta, w.sin_theta),
    )
    half.F, half.M = half.F + ball_array_sum(w.pocket[h].half_F), half.M + ball_array_sum(w.pocket[h].half_M)

    # on the balls
    w.F, w.M = w.F + F, w.M + M
    w.D = w.D + g / d.m * (1.0 - n * n)
    w.D_omega = w.D_omega + g * d.R**2 / d.J * (1.0 - n * n)
    w.pocket_dissipated = w.pocket_dissipated + (Q - Q_0) * delta_dot - vec_dot(F_s, slip)
    if film:
        w.pocket_dissipated = w.pocket_dissipated + film.F * vec_dot(film.m, v)
    axes = zip((n_x, n_r, n_t), (gap.a, gap.b, gap.e_t), by_film, strict=True)
    on_wall = [Q * n_i - vec_dot(F_s, axis) + f_i for n_i, axis, f_i in axes]
    return SimpleNamespace(V=V, Q=Q, Q_0=Q_0, n=(n_x, n_r, n_t), delta_dot=delta_dot, on_wall=on_wall)


def spheres_rigid(model, w):
    """Contacts of all pockets of two rigid ribbon halves, as pocket_rigid of machined ones."""
    pocket_clear(w)
    for h in range(2):
        spheres_forces(model, w, h, spheres_gap(model, w, h))


def spheres_ahead(model, w, h, gap):
    """How far the balls come nearer to the spheres of half h in the longest step, both as rigid bodies [m]."""
    half, (x, r, t) = w.half[h], gap.q
    v_h, Omega = (vec_local(v, w.cos_theta, w.sin_theta) for v in (half.v, half.Omega))
    v = vec(w.v_x, w.v_r, w.v_t) - v_h - vec_cross(Omega, gap.p)
    along = gap.side * x * vec_dot(v, gap.a) + r * vec_dot(v, gap.b) + t * vec_dot(v, gap.e_t)
    rate = along / np.sqrt(x * x + r * r + t * t + TIP**2)
    return np.real(maximum(rate, 0.0) * model.modes.longest_step)


def leave_arrivals(model, e, h, gap, wall):
    """Leaves balls that may come to a wall of half h in the longest step to its substeps, with the contact that each would have on a wall
    moved up to it.
    """
    d = model.d.spheres
    delta = spheres_nearest(d, *gap.q)[0]
    comes = wall.near & (np.real(delta) + gap.ahead > 0.0) & (np.real(delta) < 0.0)
    _, Q, n, _ = spheres_contact(d._replace(slack=d.slack + (delta - TOUCHES)), *gap.q)
    rows = dict(zip(("x", "r", "t"), (gap.side * n[0], n[1], n[2]), strict=True))
    rows |= {"K": Q / TOUCHES**1.5, "delta": delta, "chi": wall.chi, "radius": wall.radius, "front": wall.front}
    for name, value in rows.items():
        row = getattr(e, f"touch_{name}")
        row[h] = np.where(comes, value, row[h])


def spheres_elastic(model, w):
    """Contacts of all pockets of two elastic ribbon halves, as pocket_elastic of machined ones."""
    pocket_clear(w)
    e = w.cage.elastic
    elastic_clear(e)
    e.wall_energy = [None, None]
    for h in range(2):
        gap = spheres_gap(model, w, h)
        gap.ahead = spheres_ahead(model, w, h, gap)
        wall = spheres_wall(model, w, h, gap)
        at = spheres_forces(model, w, h, gap, wall)
        e.wall_force[h] = sum(
            np.sum(force[..., None] * motion, axis=-2) for force, motion in zip(at.on_wall, wall.shape, strict=True)
        )
        # Hertz's law for the substeps, through load and approach; near a corner the approach is not the load's
        pressed, sphere = np.real(at.Q_0) > LEAST, (maximum(at.Q_0, LEAST) / model.d.spheres.K) ** (2.0 / 3.0)
        own = minimum(maximum(w.delta_c[h], sphere / CORNER), sphere * CORNER)
        e.touch_x[h], e.touch_r[h], e.touch_t[h] = at.n
        e.touch_K[h], e.touch_delta[h] = np.where(pressed, at.Q_0 / own**1.5, 0.0), np.where(pressed, own, 0.0)
        e.touch_Q[h], e.touch_chi[h], e.touch_radius[h], e.touch_front[h] = at.Q, wall.chi, wall.radius, wall.front
        e.wall_energy[h] = at.V
        leave_arrivals(model, e, h, gap, wall)


def spheres_energy(model, w):
    """Elastic energy of all pockets [J], [..., Z]; of elastic walls also that in their compliance, beside their modes."""
    if model.modes:
        return w.cage.elastic.wall_energy[0] + w.cage.elastic.wall_energy[1]
    return sum(spheres_contact(model.d.spheres, *spheres_gap(model, w, h).q)[0] for h in range(2))
