"""Ball and pocket: a cylinder with a radial axis, cut by the split plane into the two halves.

         x (a)                      a     axis of the half         p = ball centre - geometric centre of the half
         |   half 1                 e_t   its tangent at pocket j  (x, t) = (p.a, p.e_t): ball against the pocket's axis
      .--+--.                       S = sqrt(x^2 + t^2),  n = (x, t)/S
     (   |n->)---- t (e_t)          delta = S - (R_c - R)                                                  Cui et al. (2023)
      '--+--'                       V = e(xi) (2/5) K delta^2.5,  xi = +- n_x R_c/a, at most 1: split plane against the patch, a = a_delta delta^0.5
         |   half 0                 force on the ball: -dV/d(x, t), damping -(w K delta^1.5) lambda delta_dot n, Coulomb friction mu Q

A half bears the part of the Hertz pressure on its side of the split plane, which cuts the contact ellipse across its
long half axis a:
    w = 1/2 + 3/4 xi - 1/4 xi^3,  e = 1/2 + 15/16 xi - 5/8 xi^3 + 3/16 xi^5
w: the pressure sqrt(1 - (x/a)^2 - (y/b)^2) summed over y leaves 1 - (x/a)^2 along x.  e: the integral
of w K delta^1.5 over delta at the contact's position, as part of the energy of a whole contact.  So dV/d(delta) is
w K delta^1.5, and both halves together store and bear as much as one whole contact.  The slope of V along the wall is a
force across n that pushes the halves apart; without this force energy would
not be conserved.  From a = R_c on, where Hertz's law has ended, the patch is assumed to keep its length: V = e q^5 V_0 + w (1 - q^5) V_0,
V_0 = (2/5) K delta^2.5, q = R_c/a.
Friction P_S at the contact point p + R n with the slip v + omega x R n; the
coefficient goes from that of the film to that of the asperities by Lambda (mixed lubrication); P_R and its horizontal
counterpart are the inlet's rolling friction as in the races, with the mean speed |slip|/2 and R_x = R.  The half gets
the opposite forces at the same points.  Oil between ball and wall adds the force -F m through the ball's centre, where both
close in (pocket_squeeze.py).  Smoothness: C1 at touch-down and where the patch leaves a half.  The cylinder
has no radial end: a ball whose equator leaves the cage's section is reported, not modelled.
"""

from types import SimpleNamespace

import numpy as np

from bearing_model.cage.common.pocket_films import RIGID, film_before_wall
from bearing_model.cage.common.pocket_squeeze import pocket_squeeze
from bearing_model.cage.elastic.elastic_wall import elastic_wall
from bearing_model.generated.variables import Lubrication
from bearing_model.numbers.lanes import ball_array_sum, maximum, minimum
from bearing_model.numbers.vec import vec, vec_across, vec_cross, vec_dot, vec_local, vec_to_global
from bearing_model.physics.hertz import hertz_damped, hertz_energy, hertz_load
from bearing_model.physics.traction import Q_FLOOR, traction_asperity_share, traction_inlet, traction_ln_film


def pocket_mu(model, ln_U, ln_Q, mixed):
    """Friction coefficient at mean speed U and load Q.  Film: the thicker one of piezoviscous and isoviscous-rigid
    lubrication.
    """
    film = model.p.cage.mu
    if not mixed:
        return film
    ln_piezo = traction_ln_film(model.d.ln_pocket_piezo, ln_U, ln_Q)
    ln_rigid = model.d.ln_pocket_rigid + 2.0 * (ln_U - ln_Q)
    return film + traction_asperity_share(maximum(ln_piezo, ln_rigid)) * (model.p.oil.mu_b - film)


def pocket_share(d, h, n_x, delta):
    """Parts w of the load and e of the energy that half h has of a contact at n_x, and de/dn_x."""
    inv_a = d.pocket_radius / (d.pocket.a_delta * np.sqrt(maximum(delta, 1e-30)))
    q, xi_n = minimum(inv_a, 1.0), (2 * h - 1) * maximum(inv_a, 1.0)
    xi = maximum(minimum(xi_n * n_x, 1.0), -1.0)
    xi_2, q_5 = xi * xi, q**5
    w = 0.5 + xi * (0.75 - 0.25 * xi_2)
    e = 0.5 + xi * (15.0 / 16.0 - xi_2 * (0.625 - 3.0 / 16.0 * xi_2))
    slope, later = 15.0 / 16.0 * (1.0 - xi_2) * (1.0 - xi_2) * xi_n, 0.75 * (1.0 - xi_2) * xi_n
    return w, e * q_5 + w * (1.0 - q_5), slope * q_5 + later * (1.0 - q_5)


def pocket_gap(model, w, h):
    """Where the balls are in the pockets of half h, in the frames of the balls: axes a, b, e_t of the pockets, ball centre less
    geometric centre of the half p, distance S from the pocket's axis, direction n_x, n_t from there, elastic approach delta.
    """
    d, half = model.d, w.half[h]
    # direction of pocket j: body angle phi_j turned by the half, b = b_y cos phi + b_z sin phi, e_t = a x b
    a, b_y, b_z, x_h = (vec_local(v, w.cos_theta, w.sin_theta) for v in (half.a, half.b_y, half.b_z, half.x))
    b = d.pocket_cos * b_y + d.pocket_sin * b_z
    e_t = vec_cross(a, b)
    p = vec(w.x, w.r, 0.0) - x_h
    x, t = vec_dot(p, a), vec_dot(p, e_t)
    S = np.sqrt(x * x + t * t + 1e-30)  # 1e-30 gives a centred ball a direction
    return SimpleNamespace(a=a, b=b, e_t=e_t, p=p, S=S, n_x=x / S, n_t=t / S, delta=S - (d.R_c - d.R))


def pocket_velocity(w, h, gap):
    """Velocity of the balls' centres against half h there."""
    v_h, Omega = (vec_local(v, w.cos_theta, w.sin_theta) for v in (w.half[h].v, w.half[h].Omega))
    return vec(w.v_x, w.v_r, w.v_t) - v_h - vec_cross(Omega, gap.p)


def pocket_approach(model, h, n_x, delta):
    """Approach [..., Z] of ball and wall without that of the wall's compliance c: delta_h + c w K delta_h^1.5 = delta, by
    Newton's method.
    """
    c = model.modes.compliance * model.d.pocket.K
    own = maximum(delta, 0.0)
    for _ in range(4):
        root = np.sqrt(np.where(np.real(own) > 0.0, own, 1e-30))
        load = maximum(c * pocket_share(model.d, h, n_x, own)[0] * root, -0.3)
        own = maximum(own - (own + load * own - delta) / (1.0 + 1.5 * load), 0.0)
    return np.where(np.real(delta) > 0.0, own, delta)


def pocket_contacts(model, w, h, gap, wall=None):
    """Forces in the pockets of half h: sets w.pocket[h] and adds to the balls.  wall: velocity u_dot (x, r, t) and tilt of the
    walls of an elastic half.  Returns the forces (x, r, t) on the walls and contact loads.
    """
    p, d, half = model.p, model.d, w.half[h]
    a, b, e_t, n_x, n_t, delta = gap.a, gap.b, gap.e_t, gap.n_x, gap.n_t, gap.delta
    omega_b, Omega = vec(w.omega_x, w.omega_r, w.omega_t), vec_local(half.Omega, w.cos_theta, w.sin_theta)
    v = pocket_velocity(w, h, gap)
    if wall:
        v = v - (wall.u_dot[0] * a + wall.u_dot[1] * b + wall.u_dot[2] * e_t)
    n = n_x * a + n_t * e_t
    delta_dot = vec_dot(n, v)

    # share of the half, contact load, and the energy's gradient across n: dV/dn_x grad n_x,
    # grad n_x = (n_t a - n_x e_t) n_t/S
    share, _, slope = pocket_share(d, h, n_x, delta)
    Q_0 = share * hertz_load(d.pocket.K, delta)
    Q = hertz_damped(Q_0, p.cage.lambda_, delta_dot)
    F_across = hertz_energy(d.pocket.K, delta) * slope * n_t / gap.S
    if wall:
        F_across = F_across - Q_0 * wall.tilt
    F_n = -Q * n - F_across * (n_t * a - n_x * e_t)
    film, by_film = d.squeeze and pocket_squeeze(d, h, gap, v), (0.0, 0.0)
    if film:
        F_n = F_n - film.F * film.m
        by_film = film.F * vec_dot(film.m, a), film.F * vec_dot(film.m, e_t)

    # friction at the contact point (F_s), film force through the ball's centre (F_c)
    arm = d.R * n
    slip = vec_across(v + vec_cross(omega_b - Omega, arm), n)
    slip_2 = vec_dot(slip, slip)
    U = np.sqrt(0.25 * slip_2 + p.oil.U_0**2)
    ln_U, ln_Q = np.log(U), np.log(Q + Q_FLOOR)
    mixed = p.scene.lubrication == Lubrication.MIXED
    g = pocket_mu(model, ln_U, ln_Q, mixed) * Q / np.sqrt(slip_2 + p.cage.v_c**2)
    g_R = 0.5 * traction_inlet(d.pocket_rolling, ln_U, Q, ln_Q) / U
    F_s = -(g + g_R) * slip
    F_c = 2.0 * g_R * slip
    F, M = F_n + F_s + F_c, vec_cross(arm, F_s)

    w.pocket[h] = SimpleNamespace(
        Q=Q + film.F if film else Q,
        F=np.array([-vec_dot(F, a), -vec_dot(F, b), -vec_dot(F, e_t)]),
        radius=None,
        push=np.array([Q * n_x + F_across * n_t + by_film[0], Q * n_t - F_across * n_x + by_film[1]]),
        half_F=vec_to_global(-F, w.cos_theta, w.sin_theta),
        half_M=vec_to_global(-vec_cross(gap.p, F) - M, w.cos_theta, w.sin_theta),
    )
    half.F, half.M = half.F + ball_array_sum(w.pocket[h].half_F), half.M + ball_array_sum(w.pocket[h].half_M)

    # on the balls
    w.F = w.F + F
    w.M = w.M + M
    w.D = w.D + g / d.m * (1.0 - n * n)
    w.D_omega = w.D_omega + g * d.R**2 / d.J * (1.0 - n * n)
    w.pocket_dissipated = w.pocket_dissipated + (Q - Q_0) * delta_dot - vec_dot(F_s, slip) - vec_dot(F_c, v)
    if film:
        w.pocket_dissipated = w.pocket_dissipated + film.F * vec_dot(film.m, v)
    drawn = F_s + F_c
    on_wall = Q * n_x - vec_dot(drawn, a) + by_film[0], -vec_dot(drawn, b), Q * n_t - vec_dot(drawn, e_t) + by_film[1]
    return on_wall, Q, (film, v)


def pocket_clear(w):
    """No contacts yet."""
    w.pocket, w.delta_c, w.pocket_dissipated = [None, None], [None, None], 0.0
    w.D, w.D_omega = 0.0 * w.F, 0.0 * w.F
    w.films = [None, None]


def elastic_clear(e):
    """No contacts with elastic walls yet."""
    touch = ("x", "r", "t", "K", "delta", "Q", "chi", "radius", "front")
    for name in ("wall_force", *(f"touch_{part}" for part in touch)):
        setattr(e, name, [None, None])


def pocket_rigid(model, w):
    """Contacts of all pockets of two rigid halves: add to the balls' forces, moments, rates and dissipation, and to the wrench
    on both halves.

    pocket[h]: load Q, force F on the half in the pocket's frame (x, r, t) and its normal part push (x, t); half_F, half_M:
    force and moment about the half's centre, global.
    D, D_omega: rates at which friction slows each velocity of a ball by itself, -d(acceleration)/d(velocity) [1/s], for
    the integrator's Jacobian.  films: those of each half (film_before_wall).
    """
    pocket_clear(w)
    for h in range(2):
        gap = pocket_gap(model, w, h)
        w.delta_c[h] = gap.delta
        _, _, (film, v) = pocket_contacts(model, w, h, gap)
        if film:
            w.films[h] = film_before_wall(film, v, (gap.a, gap.b, gap.e_t), RIGID, True)


def pocket_elastic(model, w):
    """Contacts of all pockets of two elastic halves, whose walls move; sets, beside the results of pocket_rigid, the modal
    forces on the walls [..., n] of each half and the contacts with the walls, with those that may come in the longest step: direction,
    Hertz's constant by the half's share, approach, load (wall_loads.py).
    """
    pocket_clear(w)
    e = w.cage.elastic
    elastic_clear(e)
    for h in range(2):
        gap = pocket_gap(model, w, h)
        # how far balls come nearer in the longest step; a wall moves where its ball, or the film before it, may be reached
        rate = vec_dot(gap.n_x * gap.a + gap.n_t * gap.e_t, pocket_velocity(w, h, gap))
        ahead = maximum(rate, 0.0) * model.modes.longest_step
        within = gap.delta + (ahead + (model.d.squeeze.reach if model.d.squeeze else 0.0))
        u, u_dot, tilt, shape = elastic_wall(model, w, h, gap.n_x, gap.n_t, gap.S, within)
        gap.delta = pocket_approach(model, h, gap.n_x, gap.delta - gap.n_x * u[0] - gap.n_t * u[2])
        w.delta_c[h] = gap.delta
        wall = SimpleNamespace(u_dot=u_dot, tilt=tilt)
        on_wall, e.touch_Q[h], (film, v) = pocket_contacts(model, w, h, gap, wall)
        if film:
            near = np.real(gap.delta) > -model.d.squeeze.reach
            w.films[h] = film_before_wall(film, v, (gap.a, gap.b, gap.e_t), shape, near)
        e.wall_force[h] = sum(
            np.sum(force[..., None] * motion, axis=-2) for force, motion in zip(on_wall, shape, strict=True)
        )
        reached = gap.delta + ahead
        share = pocket_share(model.d, h, gap.n_x, reached)[0]
        e.touch_x[h], e.touch_t[h] = gap.n_x, gap.n_t
        e.touch_r[h] = e.touch_chi[h] = e.touch_radius[h] = e.touch_front[h] = 0.0 * gap.n_x
        e.touch_K[h] = np.where((np.real(share) > 0.0) & (np.real(reached) > 0.0), model.d.pocket.K, 0.0)
        e.touch_delta[h] = gap.delta
