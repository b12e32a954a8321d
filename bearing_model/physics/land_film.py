"""Land and outer ring: short journal bearing whose film carries where the gap closes, dry contact behind it.

           outer ring          e    land's centre from the ring's axis, eps = e/C, gap h = C - e.n(phi)
        .-----------.          V    pure squeeze velocity e_dot - (omega/2) e_x x e: the land turns, the ring stands
       /   .-----.   \\         film pressure over the width L: p = 6 eta (V.n)/h^3 (L^2/4 - z^2) where V.n > 0, else cavitated
      |   (   o e |   |        F = -eta R L^3 int n (V.n)/h^3 dphi = -kappa (I_c V + I_s V_perp),  kappa = eta R L^3/C^3
       \\   '-----'   /
        '-----------'          with a = eps.V/|V|, b = eps.V_perp/|V|, V_perp = e_x x V, q^2 = 1 - eps^2, S = pi/2 + atan(a/q):
    I_c = int cos^2 phi/(1 - a cos phi - b sin phi)^3 dphi = 3 a/q^4 + S (q^2 + 3 a^2)/q^5                    phi = -pi/2 ... pi/2
    I_s = int sin phi cos phi/(...)^3 dphi               = 2 b/q^4 + a^2 b/(q^4 (1 - b^2)) + 3 a b S/q^5
    I_t = int sin^2 phi/(...)^3 dphi                     = a/(q^2 (1 - b^2)) + 3 a b^2/(q^4 (1 - b^2)) + 2 a b^2/(q^2 (1 - b^2)^2) + S (q^2 + 3 b^2)/q^5

Shear heats the film between walls at the oil's temperature; viscosity exp(-beta (T - T_wall)).  In plane Couette flow
the shear stress then is asinh(s)/(s sqrt(1 + s^2)) times the isothermal one, s^2 = Na/8, Na = beta eta U^2/k, whatever
the gap (Nahme (1940), Ing.-Archiv 11, 191); the film's viscosity is lower by this factor.

An outer ring that moves (outer_ring.py): e, e_dot and omega are those against its material, and the forces are along
its axes.  For a ring that turns this is Reynolds' equation for two turning surfaces: squeeze e_dot - (omega +
omega_e)/2 e_x x e.

A half grows by its centrifugal load, so that C = C_0 - g omega^2, omega: its speed in space, g: by the half's finite
elements with bonded joints (rivet_model/half_lands.py).  The growth is static, and the films do not feel its rate.  Where
the spin changes, growth puts the power 2 g omega omega_dot K_land (e - C)^1.5 into the dry contact.

Steady rotation gives Ocvirk's force (a = 0), pure squeeze that of the pi-film.  The force derives from int (V.n)^2/h^3
over the closing half, so that -dF/dV = kappa (I_c, I_s; I_s, I_t) exactly: these are the stiff rates of the film.  The
force is regular at e = 0, C0 in V (cavitation) and C1 elsewhere. At the wall the film stays finite: q^2 is g_0 at the
wall and tends to g_0/2 behind it, and eps is capped at 1.2.  Behind the wall the dry contact F = K_land (e - C)^1.5
carries.

A half bends under the pressure on its rim (half_path.py): harmonics G_p = int P exp(i p theta) dtheta of its
radial load P, outward positive, in the frame of the half.  The pressure's shape over the angle is (V.n)/h^3, its size that of
the film's force; Sommerfeld's substitution from the narrowest gap,

    cos phi = (eps + cos psi)/(1 + eps cos psi),  dphi/h^3 ~ (1 + eps cos psi)^2 dpsi,   q^2 = 1 - eps^2,

spreads the points of the sum so that it is exact but for the film's ends.  The dry contact loads the rim at the narrowest
gap of a round land.  Of elastic halves the bending changes the film: land_bent.py.
"""

from dataclasses import dataclass, replace
from types import SimpleNamespace
from typing import NamedTuple

import numpy as np

from bearing_model.generated.variables import Lubrication, Z
from bearing_model.numbers.lanes import ball_array_sum, maximum, minimum, wide_pair
from bearing_model.numbers.vec import vec_cross, vec_dot
from bearing_model.physics.hertz import hertz_damped, hertz_energy, hertz_load
from bearing_model.physics.land_bent import (
    bent_dot,
    bent_foresee,
    bent_grid,
    bent_sums,
    film_share,
)
from bearing_model.physics.outer_ring import outer_ring
from bearing_model.physics.traction import traction_asperity_share

EPS_CAP = 1.2
LEAST_CLEARANCE = 0.1  # part of the clearance at rest below which a half's growth does not narrow it
LAND_HIGHEST = (3 * Z - 1) // 2  # harmonic of the load on a rim
LAND_POINTS = 24  # of its sum over the angle
PSI = 2.0 * np.pi * np.arange(LAND_POINTS) / LAND_POINTS


class JournalFilm(NamedTuple):
    """A film's force F [N] and its rates -dF/dV [N.s/m]."""

    F_y: np.ndarray
    F_z: np.ndarray
    yy: np.ndarray
    yz: np.ndarray
    zz: np.ndarray


def journal_film(e, V, cap, q2, kappa):
    """JournalFilm at the eccentricity e with the squeeze velocity V, (y, z) each; cap: limiter of e over the clearance [1/m];
    kappa [N.s/m].
    """
    (e_y, e_z), (V_y, V_z) = e, V
    V = np.sqrt(V_y * V_y + V_z * V_z + 1e-30)
    n_y, n_z = V_y / V, V_z / V
    a, b = (e_y * n_y + e_z * n_z) * cap, (e_z * n_y - e_y * n_z) * cap

    # the integrals at the head of this file
    q = np.sqrt(q2)
    q4, q5, c2 = q2 * q2, q2 * q2 * q, q2 + a * a  # c2 = 1 - b^2
    S = 0.5 * np.pi + np.arctan(a / q)
    I_c = 3.0 * a / q4 + S * (q2 + 3.0 * a * a) / q5
    I_s = 2.0 * b / q4 + a * a * b / (q4 * c2) + 3.0 * a * b * S / q5
    I_t = a / (q2 * c2) + 3.0 * a * b * b / (q4 * c2) + 2.0 * a * b * b / (q2 * c2 * c2) + S * (q2 + 3.0 * b * b) / q5

    return JournalFilm(
        -kappa * (I_c * V_y - I_s * V_z),
        -kappa * (I_c * V_z + I_s * V_y),
        kappa * (I_c * n_y * n_y - 2.0 * I_s * n_y * n_z + I_t * n_z * n_z),
        kappa * ((I_c - I_t) * n_y * n_z + I_s * (n_y * n_y - n_z * n_z)),
        kappa * (I_c * n_z * n_z + 2.0 * I_s * n_y * n_z + I_t * n_y * n_y),
    )


def land_film_gap(eps, g_0):
    """q^2: 1 - eps^2 inside, g_0 at the wall, and g_0/2 far behind the wall."""
    above = 1.0 - eps * eps - 0.5 * g_0
    return 0.5 * g_0 + 0.5 * (above + np.sqrt(above * above + 2.0 * g_0 * g_0))


def land_clearance(d, omega):
    """Radial guide clearance [m] of a half that turns at the speed omega [rad/s] in space."""
    return maximum(d.C_land - d.growth * (omega * omega), LEAST_CLEARANCE * d.C_land)


def land_growth_rate(d, omega):
    """Change of a half's radius there per change of that speed [m.s]."""
    small = np.real(d.growth * omega * omega) < (1.0 - LEAST_CLEARANCE) * d.C_land
    return np.where(small, 2.0 * d.growth * omega, 0.0)


def land_growth_power(w):
    """Power that the growth of halves whose speed changes puts into the lands' dry contacts [W], [..., 1]."""
    return ball_array_sum(w.land_growth * w.cage_spin_dot)


def land_film_heating(s_2):
    """Viscosity of the heated film / eta; s_2: Na/8."""
    s, root = np.sqrt(s_2), np.sqrt(1.0 + s_2)
    return np.where(np.real(s) > 1e-3, np.log(s + root) / (maximum(s, 1e-3) * root), 1.0 - 2.0 / 3.0 * s_2)


def harmonics_at(along, across):
    """cos and sin of p theta, p = 0...LAND_HIGHEST, for directions (cos, sin) of theta [..., points]: two [..., points, p]."""
    cosine, sine = [1.0 + 0.0 * along, along], [0.0 * across, across]
    while len(cosine) <= LAND_HIGHEST:
        cosine.append(2.0 * along * cosine[-1] - cosine[-2])
        sine.append(2.0 * along * sine[-1] - sine[-2])
    return np.stack(cosine, axis=-1), np.stack(sine, axis=-1)


def land_load(e, V, q2, force, dry):
    """Harmonics of the radial load on a rim [N], two [..., LAND_HIGHEST + 1]: Re and Im G_p.

    e, V: eccentricity and squeeze velocity along the half's axes [2, ...]; force: of the film; dry: of the contact.
    """
    u, n = ([x / np.sqrt(v[0] * v[0] + v[1] * v[1] + 1e-30) for x in v] for v in (e, V))
    q2 = minimum(q2, 1.0)
    eps, q = (np.sqrt(maximum(x, 1e-30))[..., None] for x in (1.0 - q2, q2))
    one = 1.0 + eps * np.cos(PSI)
    cosine, sine = (eps + np.cos(PSI)) / one, q * np.sin(PSI) / one
    along, across = cosine * u[0][..., None] - sine * u[1][..., None], cosine * u[1][..., None] + sine * u[0][..., None]
    weight = maximum(along * n[0][..., None] + across * n[1][..., None], 0.0) * one * one
    by_cos, by_sin = harmonics_at(along, across)
    G = [np.sum(weight[..., None] * wave, axis=-2) for wave in (by_cos, by_sin)]
    size = force / np.sqrt(G[0][..., 1] ** 2 + G[1][..., 1] ** 2 + 1e-30)
    at = harmonics_at(u[0][..., None], u[1][..., None])
    return tuple(-size[..., None] * x - dry[..., None] * y[..., 0, :] for x, y in zip(G, at, strict=True))


@dataclass
class LandPressure:
    """Variables of the pressure on the rims of elastic halves, along their axes, [..., half]; vectors [i, ..., half]."""

    e: np.ndarray  # eccentricity [m]
    V: np.ndarray  # pure squeeze velocity [m/s]
    v: np.ndarray  # velocity of the land [m/s]
    C: np.ndarray  # clearance [m]
    kappa_C3: np.ndarray  # kappa C^3 [N.s.m2]
    rim: np.ndarray  # motion of the rim's shapes [m]
    rim_v: np.ndarray  # its velocity [m/s]
    rim_V: np.ndarray  # its squeeze velocity [m/s]
    by_spin: np.ndarray  # change of the squeeze velocities of land and rim per spin [6, ..., half] [m]
    at: np.ndarray = None  # squeeze velocities to which film and rates belong [6, ..., half] [m/s]
    film: np.ndarray = None  # force of the film on land and rim [6, ..., half] [N]
    rim_force: np.ndarray = None  # all force on the rim's shapes [N]
    dry: np.ndarray = None  # load of the dry contact [N]
    stiffness: np.ndarray = None  # change of the load by the gap [N/m]
    felt: np.ndarray = None  # share of the pressure that bends the rim and loads the rivets

    def of(self, h):
        """That of one half, of one state."""
        values = {name: None if x is None else np.squeeze(np.asarray(x)[..., h]) for name, x in vars(self).items()}
        return LandPressure(**values)


def land_film_loads(model, w):
    """Harmonics of the loads on bent rims that are not faint [N], two [..., half, LAND_HIGHEST + 1]: Re and Im G_p."""
    pressure = w.pressure
    b, weight, x, gap = bent_grid(model.p, pressure)
    film = weight * maximum(bent_dot(np.concatenate([pressure.V, pressure.rim_V]), b), 0.0) / gap**3
    dry, waves = weight * maximum(-x, 0.0), harmonics_at(b[0], b[1])
    G, B = ([np.sum(load[..., None] * wave, axis=-2) for wave in waves] for load in (film, dry))
    F_y, F_z = G[0][..., 1], G[1][..., 1]
    size = (
        -pressure.felt
        * maximum(-(pressure.film[0] * F_y + pressure.film[1] * F_z), 0.0)
        / (F_y * F_y + F_z * F_z + 1e-30)
    )
    bed = -pressure.felt * pressure.dry / (B[0][..., 0] + 1e-30)
    return tuple(size[..., None] * by_film + bed[..., None] * by_dry for by_film, by_dry in zip(G, B, strict=True))


def turn_rates(T, D):
    """Rates yy, yz, zz along other axes: T^T D T."""
    return np.einsum("ik...,ij...,jl...->kl...", T, D, T)


def foreseen(p, w, pressure, film, rough):
    """The pressure with the velocities of the step's end, where films have to be foreseen; None where no film has."""
    seen = None
    for h in range(2) if w.squeeze_by is not None else ():
        half = pressure.of(h)
        if not bent_foresee(
            p, half, w.squeeze_by[h], w.squeeze_from[h], np.squeeze(film[..., h]), np.squeeze(rough[..., h])
        ):
            continue
        seen = seen or replace(pressure, V=pressure.V.copy(), rim_V=pressure.rim_V.copy())
        seen.V[..., h], seen.rim_V[..., h] = (
            x.reshape(of.shape) for x, of in ((half.V, pressure.V[..., h]), (half.rim_V, pressure.rim_V[..., h]))
        )
    return seen


def bent_lands(model, w, pressure, back, motion, heated):
    """Forces of lands whose rims bend on their halves.  back: from the halves' axes to the outer ring's [2, 2, ..., half]; motion: velocities
    (y, z) and speed of the lands against the outer ring; heated: viscosity of the film / eta.
    """
    p, d, (v_y, v_z, omega) = model.p, model.d, motion
    sums = bent_sums(model, pressure)
    seen = foreseen(p, w, pressure, sums.film, sums.rough) or pressure
    if seen is not pressure:
        sums = bent_sums(model, seen)
    pressure.at = np.concatenate([seen.V, seen.rim_V])

    # friction of dry contact and asperities, in a direction as that of a round land
    R = 0.5 * p.cage.D_o
    along = np.einsum("ki...,i...->k...", back, sums.along)
    size = np.sqrt(along[0] ** 2 + along[1] ** 2 + 1e-30)
    u_y, u_z = along / size
    slip = v_z * u_y - v_y * u_z + omega * R
    g = p.cage.mu_land / np.sqrt(slip * slip + p.cage.v_c**2)
    torque = heated * d.couette * d.C_land / pressure.C * (0.5 / np.pi) * sums.couette
    F = np.einsum("ki...,i...->k...", back, sums.film[:2] + sums.dry[:2]) + g * slip * size * np.array([u_z, -u_y])
    pressure.stiffness = sums.stiffness
    pressure.film, pressure.dry, pressure.rim_force = sums.film, sums.N, sums.film[2:] + sums.dry[2:]
    pressure.felt = film_share(d, np.sqrt(sums.film[0] ** 2 + sums.film[1] ** 2 + 1e-30) + sums.N)
    return SimpleNamespace(
        F_y=F[0],
        F_z=F[1],
        M_x=-R * g * slip * sums.rubbing - torque * omega + np.sum(sums.film * pressure.by_spin, axis=0),
        N_0=sums.N_0,
        spin=R * R * g * sums.rubbing + torque,
        stored=sums.stored,
        stored_rate=sums.stored_rate,
        rates=turn_rates(np.swapaxes(back, 0, 1), sums.rates[:2, :2]),
        on_rim=np.sum(pressure.rim_force * pressure.rim_v, axis=0),
    )


def rim_squeeze(model, w, e, omega):
    """Motion of both rims' shapes, its velocity and their squeeze velocities [4, ..., half]; change of those of land and rim per spin."""
    rim, rim_v = (
        np.moveaxis(np.concatenate([q @ model.modes.rim for q in both], axis=-2), -1, 0)
        for both in (w.cage.elastic.q, w.cage.elastic.q_dot)
    )
    by_spin = np.concatenate([0.5 * np.array([e[1], -e[0]]), np.empty((4, *omega.shape), dtype=rim.dtype)])
    waves = 0.5 * np.array([2.0, 3.0]).reshape(2, *[1] * omega.ndim)
    by_spin[2::2], by_spin[3::2] = -waves * rim[1::2], waves * rim[0::2]
    return rim, rim_v, rim_v + omega * by_spin[2:], by_spin


def round_lands(model, e, V, motion, C, heated):
    """Forces of lands whose rims are round on their halves; for the loads on the rims gap function and size of the film's force."""
    p, d, (e_y, e_z), (v_y, v_z, omega) = model.p, model.d, e, motion

    # film
    e = np.sqrt(e_y * e_y + e_z * e_z + 1e-30)
    narrow, eps, u_y, u_z = d.C_land / C, e / C, e_y / e, e_z / e
    cap = minimum(1.0, EPS_CAP / eps) / C
    q2 = land_film_gap(eps, p.cage.g_0)
    film = journal_film((e_y, e_z), V, cap, q2, d.kappa * heated * narrow**3)
    couette = d.couette * heated / np.sqrt(q2) * narrow  # torque / speed

    # dry contact where the gap is smallest; N_mu: all that rubs, with mixed lubrication asperities too, with their share of the film's force
    pen, pen_dot = e - C, v_y * u_y + v_z * u_z
    N_0 = hertz_load(p.cage.K_land, pen)
    N = N_mu = hertz_damped(N_0, p.cage.lambda_, pen_dot)
    if p.scene.lubrication == Lubrication.MIXED:
        ln_Lambda = d.ln_land + np.log(q2 / (narrow * (1.0 + eps)))
        by_film = np.sqrt(film.F_y * film.F_y + film.F_z * film.F_z)
        N_mu = N + traction_asperity_share(ln_Lambda) * by_film

    # friction along t = e_x x u
    R = 0.5 * p.cage.D_o
    slip = v_z * u_y - v_y * u_z + omega * R
    g = p.cage.mu_land * N_mu / np.sqrt(slip * slip + p.cage.v_c**2)
    F_t = -g * slip
    yy, yz, zz = (rate + 0.0 * e for rate in (film.yy, film.yz, film.zz))
    return SimpleNamespace(
        F_y=film.F_y - N * u_y - F_t * u_z,
        F_z=film.F_z - N * u_z + F_t * u_y,
        M_x=R * F_t - couette * omega + 0.5 * (film.F_y * e_z - film.F_z * e_y),
        N_0=N_0,
        spin=couette + g * R * R,
        stored=hertz_energy(p.cage.K_land, pen),
        stored_rate=N_0 * pen_dot,
        rates=np.array([[yy, yz], [yz, zz]]),
        on_rim=0.0,
        q2=q2 + 0.0 * e,
        size=np.sqrt(film.F_y * film.F_y + film.F_z * film.F_z + 1e-30),
        dry=N,
    )


def no_land(w):
    """Of a cage that balls guide: no film, no contact with the outer ring."""
    none = 0.0 * w.half[0].s
    w.land_elastic = w.land_dissipated = w.land_growth = none
    w.film = [SimpleNamespace(yy=none, yz=none, zz=none, spin=none) for _ in range(2)]
    w.land = w.pressure = None


def land_motion(outer, h0, h1, x_land):
    """Position and velocity of the middle of each land, x + a x_land and v + Omega x a x_land = v + a_dot x_land, and its speed, against
    the outer ring along its axes.
    """
    axis, axis_dot = wide_pair(h0.a, h1.a), wide_pair(h0.a_dot, h1.a_dot)
    arm = wide_pair(h0.x, h1.x) + x_land * axis - outer.x
    velocity = wide_pair(h0.v, h1.v) + x_land * axis_dot - outer.v - vec_cross(outer.Omega, arm)
    along = (vec_dot(value, axis_of) for value in (arm, velocity) for axis_of in (outer.b_y, outer.b_z))
    return (*along, vec_dot(wide_pair(h0.Omega, h1.Omega) - outer.Omega, outer.a))


def land_film_force(model, w):
    """Adds film, friction and dry contact of both lands to the halves; sets their elastic energy and dissipated power.

    film[land]: rates yy, yz, zz of its film, -dF/dv [N.s/m], and spin, -dM/domega [N.m.s], [..., 1] each, for the
    integrator's Jacobian.  pressure: LandPressure.  land: of rigid halves the
    harmonics of the loads on the rims, Re and Im G_p [..., half, p].  land_growth:
    elastic energy that growth adds per change of the half's speed [J.s], [..., half].
    """
    p, d = model.p, model.d
    if not d.guided:
        no_land(w)
        return
    h0, h1 = w.half
    x_land = np.array([-p.cage.land_x, p.cage.land_x])

    outer = outer_ring(model.ring_load, h0.s)
    e_y, e_z, v_y, v_z, omega = land_motion(outer, h0, h1, x_land)
    V_y, V_z = v_y + 0.5 * omega * e_z, v_z - 0.5 * omega * e_y
    spin = wide_pair(h0.s, h1.s) + w.frame_omega  # in space
    C, none = land_clearance(d, spin), 0.0 * (e_y + V_y)
    heated = land_film_heating(d.nahme * omega * omega) if d.nahme > 0.0 else 1.0

    axes = wide_pair(h0.b_y, h1.b_y), wide_pair(h0.b_z, h1.b_z)
    T = np.array([[vec_dot(outer_axis, axis_of) for outer_axis in (outer.b_y, outer.b_z)] for axis_of in axes])
    e_h, V_h, v_h = (
        np.einsum("ik...,k...->i...", T, np.array([y + none, z + none]))
        for y, z in ((e_y, e_z), (V_y, V_z), (v_y, v_z))
    )
    motion, w.land, w.pressure = (v_y, v_z, omega), None, None
    if model.modes:
        kappa_C3 = d.kappa * heated * d.C_land**3
        w.pressure = LandPressure(e_h, V_h, v_h, C + none, kappa_C3 + none, *rim_squeeze(model, w, e_h, omega + none))
        force = bent_lands(model, w, w.pressure, np.swapaxes(T, 0, 1), motion, heated)
    else:
        force = round_lands(model, (e_y, e_z), (V_y, V_z), motion, C, heated)
        w.land = land_load(e_h, V_h, force.q2, force.size, force.dry)

    power = force.F_y * v_y + force.F_z * v_z + force.M_x * omega + force.on_rim
    w.land_elastic = ball_array_sum(force.stored)
    w.land_growth = force.N_0 * land_growth_rate(d, spin)
    w.land_dissipated = -ball_array_sum(power + force.stored_rate)
    rates = {"yy": force.rates[0, 0], "yz": force.rates[0, 1], "zz": force.rates[1, 1], "spin": force.spin}
    w.film = [SimpleNamespace(**{name: rate[..., h : h + 1] for name, rate in rates.items()}) for h in range(2)]

    F = force.F_y * outer.b_y + force.F_z * outer.b_z
    M = force.M_x * outer.a + vec_cross(x_land * wide_pair(h0.a, h1.a), F)
    for h, half in enumerate(w.half):
        half.F = half.F + F[..., h : h + 1]
        half.M = half.M + M[..., h : h + 1]
