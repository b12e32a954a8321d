"""Quasi-static start: the equilibrium of ring and balls at rest in the frame of the cage.

    ball j      F_x - k_0 x = 0,   F_r + F_c = 0,   F_c = m r_0 omega_m^2 + F_0
    ring        F_contacts + F - k_0 x = 0,   M_contacts + M + support - k_0 r^2 (beta, gamma) = 0
    these are minus the gradient of
    Pi = sum_j (2/5)(K_i delta_i^2.5 + K_e delta_e^2.5) - F_c r_j + k_0 x_j^2/2  - F.x - M.(beta, gamma) + support energy + k_0 (x^2 + ...)/2

Forces come from race_contact_force at rest.  Two small forces make the equilibrium unique: F_0 presses unloaded balls
outward at standstill, and the springs k_0 (0.01 N over 10 um) hold the coordinates on which no load acts, as the axial
one without axial load.  Then all parts get kinematic speeds without slip.  The cage takes the mean and the first
harmonic of the balls' axial positions, because the balls of a tilted ring would otherwise start inside its walls, and
turns with the balls.
"""

from dataclasses import replace

import numpy as np
from scipy.optimize import minimize

from bearing_model.cage.cage import cage_rest
from bearing_model.generated import variables as Y
from bearing_model.generated.variables import RingMotion, TiltMode, Z
from bearing_model.instance.events import ellipse_reach
from bearing_model.numbers.vec import vec_cross
from bearing_model.physics.hertz import hertz_energy
from bearing_model.physics.model import Work
from bearing_model.physics.race_contact import race_contact_force
from bearing_model.physics.rotor import Rotor, rotor_axis, rotor_body_axes

K_0 = 1e3  # [N/m]
F_0 = 1e-3  # [N]
STEP = 2e-5  # first trust radius of the minimisation [m]


class Equilibrium:
    """Forces and potential as functions of the unknowns z = (x, y, z, r beta, r gamma of the ring, x of the balls, r of
    the balls) [m], r = d_m/2.
    """

    def __init__(self, model, theta):
        p, ring_load = model.p, model.ring_load
        self.model, self.r = replace(model, ring_load=resting(ring_load)), 0.5 * p.bearing.d_m
        self.cos_theta, self.sin_theta = np.cos(theta), np.sin(theta)
        outer, prescribed = ring_load.outer_omega, p.ring.motion == RingMotion.PRESCRIBED
        omega_0 = outer + 0.5 * (ring_load.omega - outer) * (1.0 - p.bearing.D / p.bearing.d_m) + ring_load.frame_omega
        self.F_c = model.d.m * self.r * omega_0**2 + F_0
        # forces of the frame's field on ring and balls at rest, and place of the outer ring at each ball
        (f_x, f_y, f_z), (x_e, y_e, z_e) = ring_load.field, ring_load.outer_x
        self.F = np.array(ring_load.F) + p.ring.m * np.array(ring_load.field)
        self.F_x, self.F_r = model.d.m * f_x, model.d.m * (f_y * self.cos_theta + f_z * self.sin_theta)
        self.x_0 = x_e + (ring_load.outer_beta * self.sin_theta - ring_load.outer_gamma * self.cos_theta) * self.r
        self.k = p.ring.k_tilt if p.ring.tilt_mode == TiltMode.SUPPORTED else 0.0
        self.start = np.concatenate(
            [
                ring_load.x if prescribed else ring_load.outer_x,
                [ring_load.beta * self.r, ring_load.gamma * self.r],
                self.x_0,
                self.r + 0.25 * p.bearing.P_d + y_e * self.cos_theta + z_e * self.sin_theta,
            ]
        )
        self.centre = np.concatenate([ring_load.outer_x, [0.0, 0.0]])
        self.free = np.arange(len(self.start))
        if prescribed:
            self.free = self.free[5:]
        elif p.ring.tilt_mode == TiltMode.PRESCRIBED:
            self.free = np.delete(self.free, [3, 4])

    def contacts(self, z):
        """Results of race_contact_force with everything at rest."""
        rest = 0.0 * z[..., 5 : 5 + Z]
        w = Work(
            x=z[..., 5 : 5 + Z], r=z[..., 5 + Z :], cos_theta=self.cos_theta, sin_theta=self.sin_theta, ring=Rotor()
        )
        w.v_x = w.v_r = w.v_t = w.omega_m = w.omega_x = w.omega_r = w.omega_t = rest
        w.ring.x = np.array([z[..., i : i + 1] for i in range(3)])
        w.ring.v = 0.0 * w.ring.x
        rotor_axis(w.ring, z[..., 3:4] / self.r, z[..., 4:5] / self.r, 0.0, 0.0, 0.0)
        race_contact_force(self.model, w)
        return w

    def unknowns(self, free):
        """All unknowns from the free ones; prescribed tilts keep their values."""
        z = np.zeros((*free.shape[:-1], len(self.start)), dtype=free.dtype) + self.start
        z[..., self.free] = free
        return z

    def force(self, free):
        """Forces on the free unknowns [N]; zero in equilibrium."""
        z, ring_load, r = self.unknowns(free), self.model.ring_load, self.r
        w, target = self.contacts(z), np.array([ring_load.beta, ring_load.gamma]) * r
        ring = np.moveaxis(w.ring.F[..., 0], 0, -1) + self.F - K_0 * (z[..., :3] - self.centre[:3])
        moment = np.moveaxis(w.ring.M[1:, ..., 0], 0, -1) + ring_load.M
        tilt = (moment - self.k * (z[..., 3:5] - target) / r) / r - K_0 * z[..., 3:5]
        return np.concatenate(
            [ring, tilt, w.F[0] + self.F_x - K_0 * (w.x - self.x_0), w.F[1] + self.F_c + self.F_r], axis=-1
        )[..., self.free]

    def stiffness(self, free):
        """-d force/d free [N/m] by complex steps."""
        step = 1e-30
        return -np.imag(self.force(free + 1j * step * np.eye(len(free)))).T / step

    def potential(self, free):
        """Pi [J]."""
        z, d, ring_load = self.unknowns(free), self.model.d, self.model.ring_load
        w, tilt = self.contacts(z), z[3:5] / self.r
        perfect = hertz_energy(d.inner.hertz.K, w.delta_i) + hertz_energy(d.outer.hertz.K, w.delta_e)
        balls = w.race_stored if d.rough else perfect
        balls = balls - (self.F_c + self.F_r) * w.r - self.F_x * w.x + 0.5 * K_0 * (w.x - self.x_0) ** 2
        off = z[:5] - self.centre
        support = 0.5 * self.k * np.sum((tilt - [ring_load.beta, ring_load.gamma]) ** 2)
        return np.sum(balls) + support + 0.5 * K_0 * off @ off - np.dot(self.F, z[:3]) - np.dot(ring_load.M, tilt)


def resting(ring_load):
    """The rings at rest where they are."""
    still = (0.0, 0.0, 0.0)
    return replace(ring_load, v=still, outer_v=still, outer_beta_dot=0.0, outer_gamma_dot=0.0, outer_omega=0.0)


def equilibrium(eq):
    """All unknowns in equilibrium, and the largest residual force [N]."""
    options = {"gtol": 0.1 * F_0, "initial_trust_radius": STEP, "max_trust_radius": 20.0 * STEP, "maxiter": 300}
    z = minimize(
        eq.potential,
        eq.start[eq.free],
        method="trust-exact",
        jac=lambda z: -eq.force(z),
        hess=eq.stiffness,
        options=options,
    ).x
    residual = np.max(np.abs(eq.force(z)))
    for _ in range(50):  # Newton's method, as long as the residual falls
        # 1 N/m more: a ball loose between the races has no stiffness
        trial = z + np.linalg.solve(eq.stiffness(z) + np.eye(len(z)), eq.force(z))
        left = np.max(np.abs(eq.force(trial)))
        if not left < residual:
            break
        z, residual = trial, left
    return eq.unknowns(z), residual


def uniform(state):
    """Next number in [0, 1) and state of splitmix64: the same numbers in both twins.  Steele, Lea & Flood (2014)."""
    mask = (1 << 64) - 1
    state = (state + 0x9E3779B97F4A7C15) & mask
    z = state
    z = ((z ^ (z >> 30)) * 0xBF58476D1CE4E5B9) & mask
    z = ((z ^ (z >> 27)) * 0x94D049BB133111EB) & mask
    return ((z ^ (z >> 31)) >> 11) * 2.0**-53, state


def spacing(p, ring_load):
    """Azimuths of the balls [rad]: equal about the outer ring's centre but for the part start.spacing of the pocket
    clearance.
    """
    random, theta = p.start.seed, np.empty(Z)
    spread = p.start.spacing * p.cage.pocket_clearance / (0.5 * p.bearing.d_m)
    for j in range(Z):
        number, random = uniform(random)
        theta[j] = 2.0 * np.pi * j / Z + p.pocket.dtheta[j] + spread * (2.0 * number - 1.0)
    (_, y, z), c, s = ring_load.outer_x, np.cos(theta), np.sin(theta)
    return theta + np.arctan2(z * c - y * s, 0.5 * p.bearing.d_m + y * c + z * s)


def orbital_speed(model, w):
    """Orbital speed without slip at both races [rad/s]: against the outer ring, the balls' centres move half as fast as
    the inner contact points; mean by load.
    """
    cosine, load = np.where(w.Q_i > 0.0, np.abs(w.n_i[1]), 1.0), w.Q_i + 1e-9
    outer = model.ring_load.outer_omega
    return outer + (model.ring_load.omega - outer) * np.average(
        0.5 * (1.0 - 2.0 * model.d.R * cosine / model.p.bearing.d_m), weights=load
    )


def cage_pose(model, w, omega_m, y):
    """Set both halves into the plane x_0 + (beta sin theta - gamma cos theta) r, which fits the balls' axial positions,
    in the middle of the outer ring, turning
    steadily about its normal.
    """
    x_0 = np.mean(w.x)
    beta, gamma = 2.0 * np.mean(w.x / w.r * w.sin_theta), -2.0 * np.mean(w.x / w.r * w.cos_theta)
    half = Rotor()
    rotor_axis(half, beta, gamma, 0.0, 0.0, omega_m)
    rotor_body_axes(half, 1.0, 0.0)
    c = np.multiply.outer(half.a, model.d.com_x) + model.d.com_e * half.b_y[:, None]
    y[Y.CAGE_X], y[Y.CAGE_Y], y[Y.CAGE_Z] = c
    y[Y.CAGE_X] += x_0
    y[Y.CAGE_Y] += model.ring_load.outer_x[1]
    y[Y.CAGE_Z] += model.ring_load.outer_x[2]
    y[Y.CAGE_V_X], y[Y.CAGE_V_Y], y[Y.CAGE_V_Z] = vec_cross(half.Omega, c)
    y[Y.CAGE_BETA] = beta
    y[Y.CAGE_GAMMA] = gamma
    y[Y.CAGE_S] = omega_m


def check_grooves(model, w):
    """ValueError if a ball's contact reaches beyond its groove's half circle."""
    reach = ellipse_reach(model, w)
    race, j = np.unravel_index(np.argmax(reach), reach.shape)
    if reach[race, j] >= 0.5 * np.pi:
        ring_load = model.ring_load
        prescribed = model.p.ring.motion == RingMotion.PRESCRIBED
        drive = ring_load.x if prescribed else ring_load.F
        given = f"the {'position' if prescribed else 'loads'}", "m" if prescribed else "N"
        F, tilt = (", ".join(f"{value:g}" for value in values) for values in (drive, (ring_load.beta, ring_load.gamma)))
        raise ValueError(
            f"ball[{j + 1}] is pressed out of the {('inner', 'outer')[race]} race's groove at the start: its contact reaches to {reach[race, j]:g} rad, "
            f"less than pi/2 is allowed; {given[0]} ({F}) {given[1]} of the ring and the shaft's tilt ({tilt}) rad are too much"
        )


def ring_follow(ring_load, y):
    """The state y with the motion of the ring that is given."""
    y = y.copy()
    blocks = (
        Y.RING_X,
        Y.RING_Y,
        Y.RING_Z,
        Y.RING_V_X,
        Y.RING_V_Y,
        Y.RING_V_Z,
        Y.RING_BETA,
        Y.RING_GAMMA,
        Y.RING_BETA_DOT,
        Y.RING_GAMMA_DOT,
    )
    given = (*ring_load.x, *ring_load.v, ring_load.beta, ring_load.gamma, ring_load.beta_dot, ring_load.gamma_dot)
    for block, value in zip(blocks, given, strict=True):
        y[block] = value
    return y


def join_motion(model, w, y):
    """Balls and cage start with the mean velocity of the rings, the ring with its own or with that of the outer ring."""
    given, prescribed = model.ring_load, model.p.ring.motion == RingMotion.PRESCRIBED
    v = 0.5 * (np.array(given.v) + given.outer_v) if prescribed else np.array(given.outer_v)
    for i, (ring, cage) in enumerate(((Y.RING_V_X, Y.CAGE_V_X), (Y.RING_V_Y, Y.CAGE_V_Y), (Y.RING_V_Z, Y.CAGE_V_Z))):
        y[ring] = given.outer_v[i]
        y[cage] += v[i]
    y[Y.BALL_V_X] = v[0]
    y[Y.BALL_V_R] = v[1] * w.cos_theta + v[2] * w.sin_theta
    y[Y.BALL_OMEGA_M] += (v[2] * w.cos_theta - v[1] * w.sin_theta) / w.r
    return ring_follow(given, y) if prescribed else y


def start_state(model):
    """The start state [states] and the largest residual force of the equilibrium [N]; ValueError if a ball is pressed
    out of its groove.
    """
    d, theta = model.d, spacing(model.p, model.ring_load)
    eq = Equilibrium(model, theta)
    z, residual = equilibrium(eq)
    w = eq.contacts(z)
    check_grooves(model, w)

    y = np.zeros(len(model.d.scale))
    omega_m = orbital_speed(model, w)
    y[Y.BALL_X] = w.x
    y[Y.BALL_R] = w.r
    y[Y.BALL_THETA] = theta
    y[Y.BALL_OMEGA_M] = omega_m
    # against the outer ring, each ball rolls on its race about an axis across its contact normal: v_t + R (omega_x n_r
    # - omega_r n_x) = 0
    outer = model.ring_load.outer_omega
    rolling = -w.r * (omega_m - outer) / d.R
    y[Y.BALL_OMEGA_X] = rolling * w.n_e[1] + outer
    y[Y.BALL_OMEGA_R] = -rolling * w.n_e[0]
    cage_pose(model, w, omega_m, y)
    cage_rest(model, omega_m + model.ring_load.frame_omega, y)
    y[Y.RING_X], y[Y.RING_Y], y[Y.RING_Z] = z[:3]
    y[Y.RING_BETA], y[Y.RING_GAMMA] = z[3:5] / eq.r
    return join_motion(model, w, y), residual
