"""Quasi-static equilibrium of a single-row groove ball bearing: inner ring and balls at rest in the frame of the cage
(Jones-Harris).

    outer groove centres: the circle |r| = R_e, x = 0                    R_e = d_m/2 + D/2 + P_d/4 - f_e D
    inner groove centres: circle of radius R_i about C, axis a           R_i = d_m/2 - D/2 - P_d/4 + f_i D + growth,   a = (a_x, tilt_z, -tilt_y)
    ball j at (x_j, r_j) in the half-plane of the azimuth psi_j (from Y toward Z), held there by the cage

    delta = |c - ball| - (f - 1/2) D,  c the nearest point of the circle          Q = K delta^1.5
    V = sum 2/5 K delta^2.5 - sum 1/2 m omega_m^2 r_j^2 - F.C - M.tilt + 1/2 k_tilt (tilt - shaft tilt)^2

For given inertia loads the equilibrium is the minimum of the potential energy V over the ring's five coordinates and
the 2 Z of the balls.  This one problem is smooth and nearly convex; loose balls, clearance and preload are no special
cases.  The minimum is the exact rest state of a frictionless bearing whose balls orbit at omega_m.  Gyroscopic moments
(race control "outer" or "inner") need friction forces at the races, which are held as loads during a search and
iterated.

kinematics = "linear" takes the ring's displacements as those of ISO/TS 16281: small tilt, every ball at the pitch
radius, no sideways motion of the ring's groove.  It gives the ball loads and lives that programs for this standard
print; the default "exact" holds for any displacement and tilt.

Sources: Jones, ASME J. Basic Eng. 82 (1960) 309-320; Harris & Kotzalas, Advanced Concepts of Bearing Technology (2006),
ch. 1 and 3; de Mul, Vree & Maas, ASME J. Tribol. 111 (1989) 142-148.  Life: ISO/TS 16281:2008.  Static safety: ISO
76:2006.
"""

import math
from dataclasses import dataclass

import numpy as np

from bearing_model.kinematics import CONTROLS, FaultFrequencies, ball_motion
from bearing_model.physics.hertz_exact import ball_race_contact
from bearing_model.physics.ring_fit import RingFit, ring_fit_growth

RING = 5  # ring coordinates: x, y, z, tilt_y, tilt_z
KINEMATICS = ("exact", "linear")
Y_0_ANGLES = np.radians([5.0, 10.0, 15.0, 20.0, 25.0, 30.0, 35.0, 40.0, 45.0])  # contact angles of ISO 76:2006, table 2
Y_0_VALUES = (0.52, 0.50, 0.46, 0.42, 0.38, 0.33, 0.29, 0.26, 0.22)


@dataclass(frozen=True)
class Bearing:
    """A groove ball bearing; names, units and defaults as the parameters bearing.* of the FMU (fmus/variables.toml).
    Default: 6207.

    D ball diameter [m], d_m pitch diameter [m] (mean of the groove-bottom diameters), Z balls, f_i, f_e groove radius /
    D, P_d diametral clearance [m] (negative: preload), E [Pa], nu of the rings, rho [kg/m3] of the balls; ball: E and
    nu of the balls, None for those of the rings. alpha_0 [rad]: free contact angle of an angular contact bearing; it
    takes the place of P_d, and x = 0 is then where balls and races just touch. C, C_0: dynamic and static load rating
    [N] for the life and the static safety. fit: growth of the inner groove by rotation and fit (ring_fit.py), which
    takes clearance at speed; without it the rings keep their size. Raises ValueError for a value that is not
    admissible.
    """

    D: float = 0.0111125
    d_m: float = 0.0535
    Z: int = 9
    f_i: float = 0.515
    f_e: float = 0.52
    P_d: float | None = None  # 15 um unless alpha_0 is given
    E: float = 207e9
    nu: float = 0.3
    rho: float = 7800.0
    ball: tuple | None = None
    alpha_0: float | None = None
    C: float | None = None
    C_0: float | None = None
    fit: RingFit | None = None

    def __post_init__(self):
        if self.alpha_0 is not None and self.P_d is not None:
            raise ValueError(
                f"bearing.alpha_0 = {self.alpha_0} and bearing.P_d = {self.P_d}: only one of them can be given"
            )
        checks = (
            (("D", "d_m", "E", "rho"), lambda v: v > 0.0, "must be positive"),
            (("f_i", "f_e"), lambda v: 0.5 < v <= 1.0, "must be more than 0.5 and at most 1"),
            (("C", "C_0"), lambda v: v > 0.0, "must be positive"),
            (("nu",), lambda v: 0.0 <= v < 0.5, "must be at least 0 and less than 0.5"),
            (("Z",), lambda v: v >= 3 and v == int(v), "must be a whole number of at least 3"),
        )
        for names, test, allowed in checks:
            for name in names:
                admit("bearing", self, name, test, allowed)
        room, most = f"{self.Z} balls of D = {self.D} m do not fit", 2.0 * self.A
        admit("bearing", self, "d_m", lambda v: v * math.sin(math.pi / self.Z) >= self.D, room)
        angle = "must be at least 0 and less than pi/2"
        admit("bearing", self, "alpha_0", lambda v: 0.0 <= v < 0.5 * math.pi, angle)
        clearance = f"must be within +-2 (f_i + f_e - 1) D = {most:.4g} m"
        admit("bearing", self, "P_d", lambda v: abs(v) < most, clearance)

    @property
    def A(self):
        """Distance of the groove centres of both races with the ball just touching both, (f_i + f_e - 1) D [m]."""
        return (self.f_i + self.f_e - 1.0) * self.D

    @property
    def clearance(self):
        """Diametral clearance P_d [m]: as given, that of alpha_0, or 15 um.  Harris & Kotzalas (2006), ch. 2: P_d = 2 A
        (1 - cos alpha_0).
        """
        if self.alpha_0 is not None:
            return 2.0 * self.A * (1.0 - math.cos(self.alpha_0))
        return 15e-6 if self.P_d is None else self.P_d

    def clearance_at(self, omega):
        """Diametral clearance [m] that growth and fit of the inner ring leave at its speed in the fixed frame [rad/s]."""
        return self.clearance - (2.0 * float(ring_fit_growth(self.fit, omega)) if self.fit else 0.0)

    def free_contact_angle(self, omega=0.0):
        """Contact angle under a vanishing axial load at the speed omega [rad/s], cos(alpha) = 1 - P_d/(2 A) [rad] with
        the clearance that is left; 0 with preload.  Harris & Kotzalas (2006), ch. 2.
        """
        return math.acos(min(1.0, 1.0 - self.clearance_at(omega) / (2.0 * self.A)))

    @property
    def nominal_angle(self):
        """Contact angle for which Hertz constants and load rating are taken: alpha_0, 0 for a deep groove bearing
        [rad].
        """
        return self.alpha_0 or 0.0

    @property
    def static_factors(self):
        """X_0, Y_0 of the static equivalent load X_0 F_r + Y_0 F_a of one row: 0.6, 0.5 for deep groove, else by
        contact angle.  ISO 76:2006, table 2.
        """
        return (
            (0.5, float(np.interp(self.nominal_angle, Y_0_ANGLES, Y_0_VALUES)))
            if self.nominal_angle >= Y_0_ANGLES[0]
            else (0.6, 0.5)
        )

    @property
    def ball_mass(self):
        """Mass of a ball [kg]."""
        return self.rho * math.pi * self.D**3 / 6.0


@dataclass(frozen=True)
class Load:
    """Loads on the inner ring and its speed; names and units as the inputs shaft.* of the FMU.

    F_x, F_y, F_z [N], M_y, M_z [N.m], omega [rad/s].  k_tilt [N.m/rad] ties the ring's tilt to the shaft's tilt_y,
    tilt_z [rad]: inf (default) prescribes it, 0 leaves the ring to the moments alone, else M = k_tilt (shaft tilt -
    ring tilt) + (M_y, M_z).  A tilt is a direction cosine of the axis (its angle to 2e-4 at 2 deg), and M_y, M_z do
    work on it.  omega_e [rad/s]: speed of the outer ring; frame_omega [rad/s] turns the frame, relative to which both
    speeds are; field [m/s2]: gravity and the frame's inertia on the balls, that on the ring belongs to F_x, F_y, F_z.
    Raises ValueError for a value that is not admissible.
    """

    F_x: float = 0.0
    F_y: float = 0.0
    F_z: float = 0.0
    M_y: float = 0.0
    M_z: float = 0.0
    omega: float = 0.0
    tilt_y: float = 0.0
    tilt_z: float = 0.0
    k_tilt: float = math.inf
    omega_e: float = 0.0
    frame_omega: float = 0.0
    field: tuple = (0.0, 0.0, 0.0)

    def __post_init__(self):
        for name in ("F_x", "F_y", "F_z", "M_y", "M_z", "omega", "omega_e", "frame_omega"):
            admit("load", self, name, math.isfinite, "must be finite")
        for name in ("tilt_y", "tilt_z"):
            admit("load", self, name, lambda v: abs(v) <= 0.5, "must be within +-0.5 rad")
        if not self.k_tilt >= 0.0:
            raise ValueError(f"load.k_tilt = {self.k_tilt}: must be at least 0 (0: free, inf: tilt prescribed)")
        if math.isinf(self.k_tilt) and (self.M_y or self.M_z):
            raise ValueError(
                f"load.k_tilt = {self.k_tilt} prescribes the tilt: load.M_y, load.M_z must be 0, not {self.M_y}, {self.M_z}"
            )


@dataclass(frozen=True)
class QuasiStatic:
    """Equilibrium of ring and balls.  Arrays hold one value per ball; a ball without contact at a race has Q = 0 and
    contact angle 0 there.
    """

    bearing: Bearing
    load: Load
    x: float  # displacement of the inner ring [m] ...
    y: float
    z: float
    tilt_y: float  # ... and its tilt [rad]
    tilt_z: float
    psi: np.ndarray  # azimuth of the balls from Y toward Z [rad]
    x_b: np.ndarray  # position of the ball centres [m]
    r_b: np.ndarray
    Q_i: np.ndarray  # contact loads [N]
    Q_e: np.ndarray
    alpha_i: np.ndarray  # contact angles [rad], positive under F_x > 0
    alpha_e: np.ndarray
    delta_i: np.ndarray  # elastic approach, negative: gap [m]
    delta_e: np.ndarray
    a_i: np.ndarray  # semi-axes of the contact ellipses, a across the rolling direction [m]
    b_i: np.ndarray
    a_e: np.ndarray
    b_e: np.ndarray
    p_i: np.ndarray  # largest contact pressures [Pa]
    p_e: np.ndarray
    F: np.ndarray  # load carried by the balls: force on the inner ring, sign reversed (x, y, z) [N] ...
    M: np.ndarray  # ... and its moment about the ring's centre (x, y, z) [N.m]
    K: np.ndarray  # stiffness d(F, M)/d(x, y, z, tilt_y, tilt_z), balls following, inertia loads constant [N, m, rad]
    omega_m: float  # orbital speed of the balls, that is cage speed [rad/s]
    omega_R: np.ndarray  # spin of the balls seen from the cage [rad/s]
    beta: np.ndarray  # pitch angle of the spin axis [rad]
    spin_i: np.ndarray  # spin against the races about the contact normal [rad/s]
    spin_e: np.ndarray
    F_c: np.ndarray  # centrifugal force [N]
    M_g: np.ndarray  # gyroscopic moment carried by friction [N.m]
    kinematics: str  # "exact" or "linear"

    @property
    def omega(self):
        """Speed of the inner ring relative to the outer one [rad/s]."""
        return self.load.omega - self.load.omega_e

    @property
    def frequencies(self):
        """Cage, ball pass and ball spin frequencies at the speeds found (kinematics.FaultFrequencies) [Hz]."""
        turn = 2.0 * np.pi
        loaded = self.Q_i > 0.0
        omega_R = float(np.mean(self.omega_R[loaded] if loaded.any() else self.omega_R))
        Z = self.bearing.Z
        return FaultFrequencies(
            abs(self.omega_m) / turn,
            Z * abs(self.omega_m - self.load.omega_e) / turn,
            Z * abs(self.load.omega - self.omega_m) / turn,
            abs(omega_R) / turn,
        )

    @property
    def L_10r(self):
        """Basic reference rating life [10^6 revolutions], inf without load.  ISO/TS 16281:2008, point contact, one row.

        The load stands still: rings that turn go through it, the others stand in it; of two that stand the inner one is
        taken to turn.

        The standard's own number asks for kinematics = "linear" and omega = 0, for it knows no centrifugal force.
        Q_ci, Q_ce: ball loads that give the rings the rating C.  Raises ValueError without bearing.C.
        """
        b = self.bearing
        if b.C is None:
            raise ValueError("bearing.C = None: the life needs the dynamic load rating [N]")
        gamma = b.D * math.cos(b.nominal_angle) / b.d_m
        ratio = (
            1.044
            * ((1.0 - gamma) / (1.0 + gamma)) ** 1.72
            * (b.f_i / b.f_e * (2.0 * b.f_e - 1.0) / (2.0 * b.f_i - 1.0)) ** 0.41
        )
        Q_ci = b.C / (0.407 * b.Z * math.cos(b.nominal_angle)) * (1.0 + ratio ** (10 / 3)) ** 0.3
        Q_ce = b.C / (0.389 * b.Z * math.cos(b.nominal_angle)) * (1.0 + ratio ** (-10 / 3)) ** 0.3
        p_i, p_e = (3.0 if turns else 10 / 3 for turns in (self.load.omega or not self.load.omega_e, self.load.omega_e))
        Q_ei, Q_ee = np.mean(self.Q_i**p_i) ** (1.0 / p_i), np.mean(self.Q_e**p_e) ** (1.0 / p_e)
        failed = (Q_ei / Q_ci) ** (10 / 3) + (Q_ee / Q_ce) ** (10 / 3)
        return float(failed**-0.9) if failed > 0.0 else math.inf

    @property
    def P_ref(self):
        """Dynamic equivalent reference load C / L_10r^(1/3) [N].  ISO/TS 16281:2008."""
        return self.bearing.C / self.L_10r ** (1 / 3)

    @property
    def P_0(self):
        """Static equivalent load of the shaft's load [N]: X_0 F_r + Y_0 F_a, at least F_r.  ISO 76:2006."""
        F_r, (X_0, Y_0) = math.hypot(self.load.F_y, self.load.F_z), self.bearing.static_factors
        return max(X_0 * F_r + Y_0 * abs(self.load.F_x), F_r)

    @property
    def S_0(self):
        """Static safety C_0/P_0, inf without load.  ISO 76:2006.  Raises ValueError without bearing.C_0."""
        if self.bearing.C_0 is None:
            raise ValueError("bearing.C_0 = None: the static safety needs the static load rating [N]")
        return self.bearing.C_0 / self.P_0 if self.P_0 > 0.0 else math.inf

    @property
    def pressure_safety(self):
        """Static safety by pressure, (4200 MPa/p_max)^3, inf without load: how often the load of the ball most loaded
        fits into the one that defines C_0.
        """
        p_max = max(self.p_i.max(), self.p_e.max())
        return float((4.2e9 / p_max) ** 3) if p_max > 0.0 else math.inf


def admit(owner, obj, name, test, allowed):
    """Raise ValueError that names owner.name, its value and the allowed range, unless it is a finite number that passes
    the test, or None where that is its default.
    """
    value = getattr(obj, name)
    if value is None and getattr(type(obj), name) is None:
        return
    try:
        good = math.isfinite(value) and test(value)
    except TypeError:
        good = False
    if not good:
        raise ValueError(f"{owner}.{name} = {value}: {allowed}")


# ----------------------------------------------------------------------------------------------------------------------
# Potential energy


@dataclass
class InertiaLoads:
    """Loads by the balls' motion, held during the search: centrifugal stiffness m omega_m^2 and friction forces that
    carry gyroscopic moments.
    """

    m_omega2: float  # [N/m]
    ball: np.ndarray  # friction on the balls (x, r), Z x 2 [N]
    ring: np.ndarray  # friction on the ring: force [N] and moment [N.m]

    def distance(self, other, r):
        """Largest change of a force on a ball at the radius r [N]."""
        return max(abs(self.m_omega2 - other.m_omega2) * r, np.abs(self.ball - other.ball).max())

    def halfway(self, other):
        """Mean of two sets of loads."""
        return InertiaLoads(
            0.5 * (self.m_omega2 + other.m_omega2), 0.5 * (self.ball + other.ball), 0.5 * (self.ring + other.ring)
        )


class Potential:
    """Potential energy of ring and balls, its gradient and its Hessian.  Coordinates v: five of the ring, then (x_j,
    r_j) of each ball.
    """

    def __init__(self, bearing, load, psi):
        self.bearing, self.load, self.psi = bearing, load, psi
        D, d_m, f_i, f_e, P_d = bearing.D, bearing.d_m, bearing.f_i, bearing.f_e, bearing.clearance
        self.R_i = (
            0.5 * (d_m - D)
            - 0.25 * P_d
            + f_i * D
            + (ring_fit_growth(bearing.fit, load.omega + load.frame_omega) if bearing.fit else 0.0)
        )
        self.R_e = 0.5 * (d_m + D) + 0.25 * P_d - f_e * D
        self.l_i, self.l_e = (f_i - 0.5) * D, (f_e - 0.5) * D
        self.x_touch = 0.0 if bearing.alpha_0 is None else bearing.A * math.sin(bearing.alpha_0)
        self.inner = ball_race_contact(D, d_m, f_i, bearing.nominal_angle, bearing.E, bearing.nu, "inner", bearing.ball)
        self.outer = ball_race_contact(D, d_m, f_e, bearing.nominal_angle, bearing.E, bearing.nu, "outer", bearing.ball)
        self.e_r = np.column_stack([np.zeros_like(psi), np.cos(psi), np.sin(psi)])
        self.inertia = InertiaLoads(0.0, np.zeros((len(psi), 2)), np.zeros(RING))

    def split(self, v):
        """Ring coordinates and ball positions x_b, r_b."""
        return v[:RING], v[RING::2], v[RING + 1 :: 2]

    def axis(self, q):
        """Axis a = (a_x, tilt_z, -tilt_y) of the ring, nan beyond 90 deg."""
        a_x2 = 1.0 - q[3] ** 2 - q[4] ** 2
        return np.array([math.sqrt(a_x2) if a_x2 > 0.0 else math.nan, q[4], -q[3]])

    def inner_centres(self, v):
        """Ball centres, and the points of the inner groove-centre circle nearest to them (Z x 3 each) [m]."""
        q, x_b, r_b = self.split(v)
        ball = x_b[:, None] * [1.0, 0.0, 0.0] + r_b[:, None] * self.e_r
        a, C = self.axis(q), q[:3] + [self.x_touch, 0.0, 0.0]
        p = ball - C
        in_plane = p - (p @ a)[:, None] * a
        return ball, C + self.R_i * in_plane / np.linalg.norm(in_plane, axis=1)[:, None]

    def levers(self, v):
        """Arms of the contact forces about the ring's centre (Z x 3) [m]."""
        return self.inner_centres(v)[1] - v[:3] - [self.x_touch, 0.0, 0.0]

    def approaches(self, v):
        """Elastic approach delta_i, delta_e of each ball at both races [m]; negative: gap."""
        _, x_b, r_b = self.split(v)
        ball, c = self.inner_centres(v)
        return np.linalg.norm(c - ball, axis=1) - self.l_i, np.hypot(x_b, r_b - self.R_e) - self.l_e

    def value(self, v):
        """Potential energy [J]."""
        q, x_b, r_b = self.split(v)
        if not np.isfinite(self.axis(q)).all():
            return math.inf
        delta_i, delta_e = self.approaches(v)
        contact = 0.4 * (
            self.inner.K * np.maximum(delta_i, 0.0) ** 2.5 + self.outer.K * np.maximum(delta_e, 0.0) ** 2.5
        )
        V = contact.sum() - 0.5 * self.inertia.m_omega2 * (r_b @ r_b) - self.applied() @ q
        V -= self.inertia.ball[:, 0] @ x_b + self.inertia.ball[:, 1] @ r_b
        return V + 0.5 * self.support() * ((q[3] - self.load.tilt_y) ** 2 + (q[4] - self.load.tilt_z) ** 2)

    def rounding(self, v):
        """Bound of the rounding error of value(v) [J]: approaches are differences of lengths R_e, and the centrifugal
        part is one large number.
        """
        _, _, r_b = self.split(v)
        delta_i, delta_e = self.approaches(v)
        loads = self.inner.load(delta_i).sum() + self.outer.load(delta_e).sum()
        return np.finfo(float).eps * (loads * self.R_e + 0.5 * self.inertia.m_omega2 * (r_b @ r_b))

    def applied(self):
        """Loads on the ring's coordinates: shaft and friction [N, N.m]."""
        load = self.load
        return np.array([load.F_x, load.F_y, load.F_z, load.M_y, load.M_z]) + self.inertia.ring

    def support(self):
        """Stiffness of the shaft against tilt [N.m/rad]; a prescribed tilt needs none."""
        return 0.0 if math.isinf(self.load.k_tilt) else self.load.k_tilt

    def contact_derivatives(self, v):
        """Gradient (Z x 7) and Hessian (Z x 7 x 7) of each ball's contact energy in (ring, x_j, r_j)."""
        _, x_b, r_b = self.split(v)
        gradient, hessian = np.zeros((len(r_b), 7)), np.zeros((len(r_b), 7, 7))

        # inner race: distance of ball and groove centre, d^2 = h^2 + w^2
        (h, h_q, h_qq), (w, w_q, w_qq) = self.inner_distance(v)
        delta_i, _ = self.approaches(v)
        d, h, w = (delta_i + self.l_i)[:, None], h[:, None], w[:, None]
        d_q = (h * h_q + w * w_q) / d
        d_qq = (outer(h_q) + h[:, :, None] * h_qq + outer(w_q) + w[:, :, None] * w_qq - outer(d_q)) / d[:, :, None]
        add_contact(gradient, hessian, self.inner.K, delta_i, d_q, d_qq)

        # outer race: plane distance
        d = np.hypot(x_b, r_b - self.R_e)[:, None]
        d_q, d_qq = np.zeros_like(gradient), np.zeros_like(hessian)
        d_q[:, 5], d_q[:, 6] = x_b / d[:, 0], (r_b - self.R_e) / d[:, 0]
        d_qq[:, 5:, 5:] = (np.eye(2) - outer(d_q[:, 5:])) / d[:, :, None]
        add_contact(gradient, hessian, self.outer.K, d[:, 0] - self.l_e, d_q, d_qq)
        return gradient, hessian

    def inner_distance(self, v):
        """Distance of each ball from the inner groove-centre circle: h along the ring's axis, w across it, each with
        gradient and Hessian in (ring, x_j, r_j).

        With p from the ring's centre to the ball: h = p.a, w = R_i - s, s = sqrt(p.p - h^2).
        """
        q, _, r_b = self.split(v)
        a = self.axis(q)
        a_q = np.zeros((3, 7))  # da/dq, and d2a/dq2 (x component only)
        a_q[0, 3:5], a_q[2, 3], a_q[1, 4] = -q[3:5] / a[0], -1.0, 1.0
        a_qq = np.zeros((7, 7))
        a_qq[3:5, 3:5] = -np.eye(2) / a[0] - np.outer(q[3:5], q[3:5]) / a[0] ** 3
        ball, _ = self.inner_centres(v)
        p = ball - (q[:3] + [self.x_touch, 0.0, 0.0])
        p_q = np.zeros((len(r_b), 3, 7))
        p_q[:, :, :3] = -np.eye(3)
        p_q[:, 0, 5] = 1.0
        p_q[:, :, 6] = self.e_r

        h = p @ a
        h_q = np.einsum("jkm,k->jm", p_q, a) + p @ a_q
        cross = np.einsum("jkm,kn->jmn", p_q, a_q)
        h_qq = cross + cross.transpose(0, 2, 1) + p[:, :1, None] * a_qq
        s = np.linalg.norm(p - h[:, None] * a, axis=1)[:, None]
        s_q = (np.einsum("jkm,jk->jm", p_q, p) - h[:, None] * h_q) / s
        s_qq = (np.einsum("jkm,jkn->jmn", p_q, p_q) - outer(h_q) - h[:, None, None] * h_qq - outer(s_q)) / s[:, :, None]
        return (h, h_q, h_qq), (self.R_i - s[:, 0], -s_q, -s_qq)

    def derivatives(self, v):
        """Gradient [N, N.m] and Hessian of the potential energy."""
        contact, contact_qq = self.contact_derivatives(v)
        q, _, r_b = self.split(v)
        g, H = np.zeros(len(v)), np.zeros((len(v), len(v)))
        for j, (g_j, H_j) in enumerate(zip(contact, contact_qq, strict=True)):
            index = np.r_[0:RING, RING + 2 * j, RING + 2 * j + 1]
            g[index] += g_j
            H[np.ix_(index, index)] += H_j
        g[:RING] -= self.applied()
        g[3:RING] += self.support() * (q[3:] - [self.load.tilt_y, self.load.tilt_z])
        H[[3, 4], [3, 4]] += self.support()
        g[RING + 1 :: 2] -= self.inertia.m_omega2 * r_b
        H[np.arange(RING + 1, len(v), 2), np.arange(RING + 1, len(v), 2)] -= self.inertia.m_omega2
        g[RING:] -= self.inertia.ball.ravel()
        return g, H

    def stiffness(self, v):
        """Stiffness of the bearing against the ring's coordinates, balls in equilibrium: K = K_qq - sum K_qb K_bb^-1
        K_bq; loose balls add nothing.
        """
        _, H = self.contact_derivatives(v)
        H[:, 6, 6] -= self.inertia.m_omega2
        return sum(
            H_j[:5, :5] - H_j[:5, 5:] @ np.linalg.pinv(H_j[5:, 5:]) @ H_j[5:, :5] for H_j in H if H_j[:5, :5].any()
        ) + np.zeros((RING, RING))


class LinearPotential(Potential):
    """The potential with the displacements of the inner groove linear in the ring's coordinates.  ISO/TS 16281:2008, 4.2;
    its psi is any tilt here.

    Seen from the ball j in its half-plane the groove centre moves by  x - d_m/2 (tilt_z cos psi_j - tilt_y sin psi_j)  along the bearing's axis and by
    y cos psi_j + z sin psi_j  outward.  Forces act at the pitch radius d_m/2.
    """

    def inner_centres(self, v):
        """Ball centres, and the inner groove centres in the balls' half-planes (Z x 3 each) [m]."""
        q, x_b, r_b = self.split(v)
        motion = self.motion() @ q
        ball = x_b[:, None] * [1.0, 0.0, 0.0] + r_b[:, None] * self.e_r
        return ball, (self.x_touch + motion[:, 0])[:, None] * [1.0, 0.0, 0.0] + (self.R_i + motion[:, 1])[
            :, None
        ] * self.e_r

    def motion(self):
        """Derivatives of the groove centres' displacements (along the axis, outward) by the ring's coordinates, Z x 2 x
        5.
        """
        cos, sin = self.e_r[:, 1], self.e_r[:, 2]
        motion = np.zeros((len(cos), 2, RING))
        motion[:, 0, 0], motion[:, 0, 3], motion[:, 0, 4] = (
            1.0,
            0.5 * self.bearing.d_m * sin,
            -0.5 * self.bearing.d_m * cos,
        )
        motion[:, 1, 1], motion[:, 1, 2] = cos, sin
        return motion

    def levers(self, v):
        """Arms of the contact forces: the pitch radius (Z x 3) [m]."""
        return 0.5 * self.bearing.d_m * self.e_r

    def inner_distance(self, v):
        """As in Potential; h and w are linear, their Hessians zero."""
        ball, c = self.inner_centres(v)
        h_q, w_q = np.zeros((2, len(ball), 7))
        h_q[:, :RING], w_q[:, :RING] = self.motion().transpose(1, 0, 2)
        h_q[:, 5] = w_q[:, 6] = -1.0
        none = np.zeros((len(ball), 7, 7))
        return ((c - ball)[:, 0], h_q, none), (np.einsum("jk,jk->j", c - ball, self.e_r), w_q, none)


def outer(u):
    """Outer products of the rows of u with themselves."""
    return u[:, :, None] * u[:, None, :]


def add_contact(gradient, hessian, K, delta, d_q, d_qq):
    """Add gradient and Hessian of the energy 2/5 K delta^2.5, none in separation."""
    delta = np.maximum(delta, 0.0)[:, None]
    gradient += K * delta**1.5 * d_q
    hessian += (K * delta**1.5)[:, :, None] * d_qq + 1.5 * K * np.sqrt(delta)[:, :, None] * outer(d_q)


# ----------------------------------------------------------------------------------------------------------------------
# Equilibrium


def minimum(potential, v):
    """Coordinates of the stable equilibrium, searched from v.

    Newton's method in the eigenvectors of the Hessian, with a trust region: steps go downhill where the energy is not
    convex, and the decrease of the energy sets the radius.  Where the energy changes by less than its rounding, a step
    has to reduce the largest force instead.  Coordinates without force (loose balls, a loose ring) keep their values.
    From an equilibrium on a ridge (the ring balanced on one ball) the search goes on downhill. Raises ArithmeticError
    if there is no equilibrium: the bearing does not carry the load.
    """
    # scales: an approach of 10 um counts as one
    length = 1e-5
    scale = np.full(len(v), length)
    scale[3:RING] /= 0.5 * potential.bearing.d_m
    free = np.ones(len(v), dtype=bool)
    free[3:RING] = not math.isinf(potential.load.k_tilt)
    unit = potential.inner.K * length**2.5
    loads = (
        np.append(scale[:RING] * potential.applied() * free[:RING], length * potential.inertia.m_omega2 * potential.R_e)
        / unit
    )
    enough = 1e-11 * np.abs(loads).max() + 1e-11  # of 1 kN: the rounding of a contact load

    def local(v):
        g, H = potential.derivatives(v)
        return (
            potential.value(v) / unit,
            scale[free] * g[free] / unit,
            np.outer(scale[free], scale[free]) * H[np.ix_(free, free)] / unit,
        )

    def moved(v, step):
        trial = v.copy()
        trial[free] += scale[free] * step
        return trial

    radius = 1.0
    V, g, H = local(v)
    for _ in range(1000):
        curvature, mode = np.linalg.eigh(H)
        force = -mode.T @ g
        force[np.abs(force) < 0.01 * enough] = 0.0
        if np.abs(g).max() <= enough or radius < 1e-12:
            if curvature[0] >= -1e-9 * curvature[-1]:
                break
            # off the ridge, in the same direction in every run
            step, radius = 0.1 * mode[:, 0] * np.sign(mode[np.abs(mode[:, 0]).argmax(), 0]), 1.0
        else:
            step = mode @ (force / np.maximum(np.abs(curvature), np.abs(force) / radius + 1e-300))
        trial = moved(v, step)
        V_trial = potential.value(trial)
        if not np.isfinite(V_trial):
            radius *= 0.25
            continue
        V_trial, g_trial, H_trial = local(trial)
        fall = V - V_trial
        certain = abs(fall) > potential.rounding(v) / unit
        if fall > 0.0 if certain else np.abs(g_trial).max() < np.abs(g).max():
            radius = min(100.0, 2.0 * radius) if fall > -0.25 * (g @ step) or not certain else radius
            v, V, g, H = trial, V_trial, g_trial, H_trial
        else:
            radius = 0.25 * min(radius, np.abs(step).max())
    residual = np.abs(g).max()
    if residual > 1e3 * enough:
        raise ArithmeticError(
            f"no equilibrium found: the bearing does not carry this load (residual {residual * unit / length:.3g} N)"
        )
    return v


def contact_state(potential, v):
    """Loads and contact angles Q_i, Q_e, alpha_i, alpha_e and the inner contact normals n_i (race on ball, Z x 3)."""
    _, x_b, r_b = potential.split(v)
    delta_i, delta_e = potential.approaches(v)
    ball, c = potential.inner_centres(v)
    Q_i, Q_e = potential.inner.load(delta_i), potential.outer.load(delta_e)
    n_i = (c - ball) / np.linalg.norm(c - ball, axis=1)[:, None]
    alpha_i = np.where(Q_i > 0.0, np.arctan2(n_i[:, 0], np.einsum("jk,jk->j", n_i, potential.e_r)), 0.0)
    alpha_e = np.where(Q_e > 0.0, np.arctan2(x_b, r_b - potential.R_e), 0.0)
    return Q_i, Q_e, alpha_i, alpha_e, n_i


def orbit(bearing, load, Q_i, alpha_i, alpha_e, control):
    """Motion of each ball, and the one orbital speed omega_m [rad/s] that the cage imposes: the mean of the balls'
    speeds, weighted by the inner contact load.

    A ball loose from the inner race rolls on the outer one.  Each ball also counts with 1 N at its speed when loose, so
    that the mean is continuous where contacts open.
    """
    loose = ball_motion(load.omega, bearing.D, bearing.d_m, alpha_e, alpha_e, control, load.omega_e)
    alpha_i = np.where(Q_i > 0.0, alpha_i, alpha_e)
    motion = ball_motion(load.omega, bearing.D, bearing.d_m, alpha_i, alpha_e, control, load.omega_e)
    omega_m = (Q_i @ motion.omega_m + loose.omega_m.sum()) / (Q_i.sum() + bearing.Z)
    return motion, float(omega_m)


def inertia_loads(potential, v, control):
    """Centrifugal and gyroscopic loads for the contact angles at v, with the motion they come from.

    Gyroscopic moment M_g = J omega_m omega_R sin(beta) about the tangent, carried by friction lambda M_g/D at the
    races, lambda_i + lambda_e = 2: outer control (0, 2), inner control (1, 1).  Harris & Kotzalas (2006), ch. 3; a
    loose ball has no such moment, and without race control no ball has.
    """
    bearing, load = potential.bearing, potential.load
    Q_i, Q_e, alpha_i, alpha_e, n_i = contact_state(potential, v)
    motion, omega_m = orbit(bearing, load, Q_i, alpha_i, alpha_e, control)
    J = 0.1 * bearing.ball_mass * bearing.D**2
    turning = (Q_i > 0.0) & (Q_e > 0.0) & (control != "none")
    M_g = np.where(turning, J * omega_m * motion.omega_R * np.sin(motion.beta), 0.0)
    lambda_i, lambda_e = (1.0, 1.0) if control == "inner" else (0.0, 2.0)
    # a force T along e_t x n at the contact -D/2 n has the moment -D/2 T about e_t; n_i = (sin, cos) alpha_i, n_e =
    # -(sin, cos) alpha_e in (x, r)
    T_i, T_e = -lambda_i * M_g / bearing.D, -lambda_e * M_g / bearing.D
    friction_i = T_i[:, None] * np.column_stack([-np.cos(alpha_i), np.sin(alpha_i)])
    friction_e = T_e[:, None] * np.column_stack([np.cos(alpha_e), -np.sin(alpha_e)])
    on_ring = -friction_i[:, :1] * [1.0, 0.0, 0.0] - friction_i[:, 1:] * potential.e_r
    ball, _ = potential.inner_centres(v)
    arm = ball - 0.5 * bearing.D * n_i - v[:3] - [potential.x_touch, 0.0, 0.0]
    ring = np.concatenate([on_ring.sum(axis=0), np.cross(arm, on_ring).sum(axis=0)[1:]])
    field = np.column_stack([np.full(bearing.Z, load.field[0]), potential.e_r @ load.field])
    on_balls = friction_i + friction_e + bearing.ball_mass * field
    return InertiaLoads(bearing.ball_mass * (omega_m + load.frame_omega) ** 2, on_balls, ring), motion, omega_m, M_g


def azimuths(psi, Z):
    """Azimuths of Z balls: evenly spaced from the first one at psi, or the array given [rad]."""
    psi = np.asarray(psi, dtype=float)
    if psi.shape not in ((), (Z,)) or not np.isfinite(psi).all():
        raise ValueError(f"psi = {psi}: must be the finite azimuth of ball 1 or those of all {Z} balls [rad]")
    return psi + 2.0 * np.pi / Z * np.arange(Z) if psi.ndim == 0 else psi


def quasi_static(bearing, load, psi=0.0, control="none", kinematics="exact"):
    """Equilibrium of the inner ring and the balls of a bearing under a load: a QuasiStatic.

    psi: azimuth of ball 1 (balls evenly spaced) or of each ball, from Y toward Z [rad].
    control: "none" - no friction, no gyroscopic moments: the rest state of the frictionless dynamics; "outer", "inner"
    - race control (Jones) with them. kinematics: "exact" for any displacement and tilt; "linear" as ISO/TS 16281 has
      it, without race control (omega = 0 leaves out centrifugal forces too).
    Raises ValueError for inadmissible values, ArithmeticError if the bearing cannot carry the load (no equilibrium, or
    contacts beyond Hertz' theory).

    >>> result = quasi_static(Bearing(C=25.7e3), Load(F_x=515.0, F_y=2994.0, omega=1909.88))
    >>> print(f"{1e6 * result.y:.1f} um, largest ball load {result.Q_i.max():.0f} N, L_10r = {result.L_10r:.0f} million
    revolutions")
    30.2 um, largest ball load 1543 N, L_10r = 555 million revolutions
    """
    if control not in CONTROLS:
        raise ValueError(f"control = {control!r}: must be one of {', '.join(CONTROLS)}")
    if kinematics not in KINEMATICS:
        raise ValueError(f"kinematics = {kinematics!r}: must be one of {', '.join(KINEMATICS)}")
    if kinematics == "linear" and control != "none":
        raise ValueError(
            f'control = {control!r} with kinematics = "linear": must be "none", ISO/TS 16281 has no gyroscopic moments'
        )
    potential = {"exact": Potential, "linear": LinearPotential}[kinematics](bearing, load, azimuths(psi, bearing.Z))
    v = np.zeros(RING + 2 * bearing.Z)
    v[3:RING] = load.tilt_y, load.tilt_z
    alpha = bearing.nominal_angle  # balls touch the outer race
    v[RING::2], v[RING + 1 :: 2] = potential.l_e * math.sin(alpha), potential.R_e + potential.l_e * math.cos(alpha)

    # contact angles set speeds and inertia loads, which in turn set contact angles: the coupling is weak, so a
    # fixed-point iteration settles in a few turns
    potential.inertia, *_ = inertia_loads(potential, v, control)
    for turn in range(80):
        v = minimum(potential, v)
        loads, motion, omega_m, M_g = inertia_loads(potential, v, control)
        change = potential.inertia.distance(loads, potential.R_e)
        if change <= 1e-9 * (1.0 + loads.m_omega2 * potential.R_e):
            check_approach(potential, v)
            return report(potential, v, motion, omega_m, M_g, kinematics)
        potential.inertia = loads if turn < 10 else potential.inertia.halfway(loads)
    raise ArithmeticError(
        f"inertia loads do not settle (last change {change:.3g} N): race control {control!r} does not hold for balls that hardly touch"
    )


def check_approach(potential, v):
    """ArithmeticError where the contacts are pressed beyond Hertz' theory: an approach of 1 % of D, 6.6 GPa in the 6207
    (4.2 GPa: C_0).
    """
    D, delta = potential.bearing.D, max(map(np.max, potential.approaches(v)))
    if delta > 0.01 * D:
        raise ArithmeticError(
            f"a ball is pressed {delta:.3g} m into a race, more than D/100 = {0.01 * D:.3g} m: the bearing does not carry this load"
        )


def report(potential, v, motion, omega_m, M_g, kinematics):
    """The equilibrium at v as a QuasiStatic."""
    q, x_b, r_b = potential.split(v)
    Q_i, Q_e, alpha_i, alpha_e, n_i = contact_state(potential, v)
    delta_i, delta_e = potential.approaches(v)
    carried = Q_i[:, None] * n_i  # on the balls
    a_i, b_i = potential.inner.semi_axes(Q_i)
    a_e, b_e = potential.outer.semi_axes(Q_e)
    F = carried.sum(axis=0) - potential.inertia.ring[:3]
    M = np.cross(potential.levers(v), carried).sum(axis=0) - [0.0, *potential.inertia.ring[3:]]
    return QuasiStatic(
        potential.bearing, potential.load, *map(float, q), potential.psi, x_b, r_b, Q_i, Q_e, alpha_i, alpha_e, delta_i, delta_e,
        a_i, b_i, a_e, b_e, potential.inner.p_max(Q_i), potential.outer.p_max(Q_e), F, M, potential.stiffness(v),
        omega_m, motion.omega_R, motion.beta, motion.spin_i, motion.spin_e, potential.inertia.m_omega2 * r_b, M_g, kinematics,
    )  # fmt: skip
