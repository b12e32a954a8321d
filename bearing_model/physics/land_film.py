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
gap. The gap is that of round lands: the bending does not change the film (docs/notes/bent_rims.md).
"""

from dataclasses import dataclass
from types import SimpleNamespace

import numpy as np

from bearing_model.generated.variables import Lubrication, Z
from bearing_model.numbers.lanes import ball_array_sum, maximum, minimum, wide_pair
from bearing_model.numbers.vec import vec_cross, vec_dot
from bearing_model.physics.hertz import hertz_damped, hertz_energy, hertz_load
from bearing_model.physics.outer_ring import outer_ring
from bearing_model.physics.traction import traction_asperity_share

EPS_CAP = 1.2
LEAST_CLEARANCE = 0.1  # part of the clearance at rest below which a half's growth does not narrow it
LAND_HIGHEST = (3 * Z - 1) // 2  # harmonic of the load on a rim
LAND_POINTS = 24  # of its sum over the angle
PSI = 2.0 * np.pi * np.arange(LAND_POINTS) / LAND_POINTS


def land_film_integrals(a, b, q2):
    """The integrals I_c, I_s and I_t that stand at the head of this file."""
    q = np.sqrt(q2)
    q4, q5, c2 = q2 * q2, q2 * q2 * q, q2 + a * a  # c2 = 1 - b^2
    S = 0.5 * np.pi + np.arctan(a / q)
    I_c = 3.0 * a / q4 + S * (q2 + 3.0 * a * a) / q5
    I_s = 2.0 * b / q4 + a * a * b / (q4 * c2) + 3.0 * a * b * S / q5
    I_t = a / (q2 * c2) + 3.0 * a * b * b / (q4 * c2) + 2.0 * a * b * b / (q2 * c2 * c2) + S * (q2 + 3.0 * b * b) / q5
    return I_c, I_s, I_t


@dataclass
class JournalFilm:
    """A film where it is: direction n of V, kappa [N.s/m], integrals over the closing half."""

    n_y: np.ndarray
    n_z: np.ndarray
    kappa: np.ndarray
    over: tuple

    def force(self, V_y, V_z):
        """Along both axes [N]."""
        I_c, I_s, _ = self.over
        return -self.kappa * (I_c * V_y - I_s * V_z), -self.kappa * (I_c * V_z + I_s * V_y)

    def rates(self):
        """-dF/dV: yy, yz, zz [N.s/m]."""
        (I_c, I_s, I_t), n_y, n_z = self.over, self.n_y, self.n_z
        return {
            "yy": self.kappa * (I_c * n_y * n_y - 2.0 * I_s * n_y * n_z + I_t * n_z * n_z),
            "yz": self.kappa * ((I_c - I_t) * n_y * n_z + I_s * (n_y * n_y - n_z * n_z)),
            "zz": self.kappa * (I_c * n_z * n_z + 2.0 * I_s * n_y * n_z + I_t * n_y * n_y),
        }


def journal_film(e, V, cap, q2, kappa):
    """JournalFilm at the eccentricity e with the squeeze velocity V, (y, z) each; cap: limiter of e over the clearance [1/m]."""
    (e_y, e_z), (V_y, V_z) = e, V
    V = np.sqrt(V_y * V_y + V_z * V_z + 1e-30)
    n_y, n_z = V_y / V, V_z / V
    a, b = (e_y * n_y + e_z * n_z) * cap, (e_z * n_y - e_y * n_z) * cap
    return JournalFilm(n_y, n_z, kappa, land_film_integrals(a, b, q2))


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
    """What decides the pressure on the rims, [..., half]."""

    e: np.ndarray  # eccentricity along the half's axes [2, ..., half] [m]
    V: np.ndarray  # pure squeeze velocity likewise [m/s]
    cap: np.ndarray  # limiter of the eccentricity over the clearance [1/m]
    q2: np.ndarray  # gap function
    kappa: np.ndarray  # [N.s/m]
    force: np.ndarray  # size of the film's force [N]
    dry: np.ndarray  # load of the dry contact [N]


def land_film_loads(w):
    """Harmonics of the loads on the rims [N] by the pressure, two [..., half, LAND_HIGHEST + 1]: Re and Im G_p."""
    on = w.pressure
    return land_load(on.e, on.V, on.q2 + 0.0 * on.force, on.force, on.dry)


def no_land(w):
    """Of a cage that balls guide: no film, no contact with the outer ring."""
    none = 0.0 * w.half[0].s
    w.land_elastic = w.land_dissipated = w.land_growth = none
    w.film = [SimpleNamespace(yy=none, yz=none, zz=none, spin=none) for _ in range(2)]
    w.land = w.pressure = None


def land_film_force(model, w):
    """Adds film, friction and dry contact of both lands to the halves; sets their elastic energy and dissipated power.

    film[land]: rates yy, yz, zz of its film, -dF/dv [N.s/m], and spin, -dM/domega [N.m.s], [..., 1] each, for the
    integrator's Jacobian.  pressure: LandPressure.  land: of rigid halves the
    harmonics of the loads on the rims, Re and Im G_p [..., half, p].  land_growth:
    what growth adds to the elastic energy per change of the half's speed [J.s], [..., half].
    """
    p, d = model.p, model.d
    if not d.guided:
        no_land(w)
        return
    h0, h1 = w.half
    x_land = np.array([-p.cage.land_x, p.cage.land_x])

    # position and velocity of the middle of each land, x + a x_land and v + Omega x a x_land = v + a_dot x_land,
    # against the outer ring along its axes
    outer, axis, axis_dot = outer_ring(model.ring_load, h0.s), wide_pair(h0.a, h1.a), wide_pair(h0.a_dot, h1.a_dot)
    arm = wide_pair(h0.x, h1.x) + x_land * axis - outer.x
    velocity = wide_pair(h0.v, h1.v) + x_land * axis_dot - outer.v - vec_cross(outer.Omega, arm)
    e_y, e_z, v_y, v_z = (vec_dot(value, axis_of) for value in (arm, velocity) for axis_of in (outer.b_y, outer.b_z))
    omega = vec_dot(wide_pair(h0.Omega, h1.Omega) - outer.Omega, outer.a)

    # film
    V_y, V_z = v_y + 0.5 * omega * e_z, v_z - 0.5 * omega * e_y
    e = np.sqrt(e_y * e_y + e_z * e_z + 1e-30)
    spin = wide_pair(h0.s, h1.s) + w.frame_omega  # in space
    C = land_clearance(d, spin)
    narrow = d.C_land / C
    eps = e / C
    cap = minimum(1.0, EPS_CAP / eps) / C
    q2 = land_film_gap(eps, p.cage.g_0)
    heated = land_film_heating(d.nahme * omega * omega) if d.nahme > 0.0 else 1.0
    kappa = d.kappa * heated * narrow**3
    film = journal_film((e_y, e_z), (V_y, V_z), cap, q2, kappa)
    F_y, F_z = film.force(V_y, V_z)
    couette = d.couette * heated / np.sqrt(q2) * narrow
    force = np.sqrt(F_y * F_y + F_z * F_z + 1e-30)

    # dry contact and friction where the gap is smallest; with mixed lubrication the asperities carry their share of the
    # film force too
    u_y, u_z = e_y / e, e_z / e
    pen, pen_dot = e - C, v_y * u_y + v_z * u_z
    N_0 = hertz_load(p.cage.K_land, pen)
    N = hertz_damped(N_0, p.cage.lambda_, pen_dot)
    N_mu = N
    if p.scene.lubrication == Lubrication.MIXED:
        ln_Lambda = d.ln_land + np.log(q2 / (narrow * (1.0 + eps)))
        N_mu = N + traction_asperity_share(ln_Lambda) * np.sqrt(F_y * F_y + F_z * F_z)
    R = 0.5 * p.cage.D_o
    slip = v_z * u_y - v_y * u_z + omega * R  # along t = e_x x u
    g = p.cage.mu_land * N_mu / np.sqrt(slip * slip + p.cage.v_c**2)
    F_t = -g * slip
    F_y = F_y - N * u_y - F_t * u_z
    F_z = F_z - N * u_z + F_t * u_y
    M_x = R * F_t - couette * omega

    power = F_y * v_y + F_z * v_z + M_x * omega
    w.land_elastic = ball_array_sum(hertz_energy(p.cage.K_land, pen))
    w.land_growth = N_0 * land_growth_rate(d, spin)
    w.land_dissipated = -ball_array_sum(power + N_0 * pen_dot)

    rates = film.rates() | {"spin": couette + g * R * R}
    w.film = [SimpleNamespace(**{name: rate[..., h : h + 1] for name, rate in rates.items()}) for h in range(2)]

    axes = wide_pair(h0.b_y, h1.b_y), wide_pair(h0.b_z, h1.b_z)
    e_h, V_h = (
        [vec_dot(y * outer.b_y + z * outer.b_z, axis_of) for axis_of in axes] for y, z in ((e_y, e_z), (V_y, V_z))
    )
    w.pressure = LandPressure(np.array(e_h), np.array(V_h), cap, q2, kappa, force, N)
    w.land = None if model.modes else land_load(e_h, V_h, q2 + 0.0 * e, force, N)

    F = F_y * outer.b_y + F_z * outer.b_z
    M = M_x * outer.a + vec_cross(x_land * axis, F)
    for h, half in enumerate(w.half):
        half.F = half.F + F[..., h : h + 1]
        half.M = half.M + M[..., h : h + 1]
