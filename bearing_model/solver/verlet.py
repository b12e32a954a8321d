"""One step of the default method, a linearly implicit trapezoidal rule, with dense matrices: the readable twin of
verlet.c and implicit.c.

    v_m = v_n + gamma a_n,  gamma = h/2
    q_{n+1} = q_n + h q'(q_m, v_m),  q_m = q_n + gamma v_m           velocity Verlet; friction states: implicit midpoint (cage_joint_advance)
    v^ = v_n + h a_n - limiter,  a^ = a(t_{n+1}, q_{n+1}, v^)        predictor; of the cage halves limited by their films (predictor_limiter)
    (1 + gamma A + gamma^2 K) delta = v_n - v^ + gamma (a_n + a^)    one linear solve, A ~ -da/dv, K ~ -da/dq of what is stiff (jacobian_blocks)
    v_{n+1} = v^ + delta = v_n + gamma (a_n + a_{n+1})               the trapezoidal rule; any A and K leave its order two: a W-method
    a_{n+1} -= 0.15 H (a_{n+1} - 2 a_n + a_{n-1}),  H = 1 - (1 + gamma A)^-1    damping of stiff rates

The derivation, the reasons of all constants and the literature are in docs/method.md.  C eliminates balls, ring and
halves one after the other, with Schur complements; here one dense solve does the same.  Vectors v, a, delta and all
matrices have the N_V velocities of the state, in their order.
"""

from dataclasses import dataclass, field

import numpy as np

from bearing_model.cage.common.cage_joint import cage_joint_advance, cage_joint_kinematics
from bearing_model.cage.elastic.cage_substeps import (
    FastState,
    cage_substeps_advance,
    cage_substeps_kick,
    cage_substeps_split,
)
from bearing_model.generated import variables
from bearing_model.generated.variables import (
    BALL_OMEGA_M,
    BALL_R,
    BALL_V_X,
    BALL_X,
    CAGE_BETA,
    CAGE_GAMMA,
    CAGE_PSI,
    CAGE_X,
    CAGE_Y,
    CAGE_Z,
    JOINT_HEAD_Y,
    JOINT_HEAD_Z,
    JOINT_PLATE_Y,
    JOINT_PLATE_Z,
    MODE_D,
    MODE_D_DOT,
    MODE_S,
    MODE_S_DOT,
    N_STATES,
    RING_BETA,
    RING_GAMMA,
    WORK,
    CageModel,
    RingMotion,
    TiltMode,
    Traction,
    Z,
)
from bearing_model.physics.model import Work
from bearing_model.physics.rhs import jacobian, rhs, rotor_kinematics
from bearing_model.physics.rotor import rotor_roll

SMOOTHING = 0.15  # part of the second difference of stiff accelerations that is taken away
STIFF_LIMIT = 2.0  # gamma A of a ball from which its accelerations are smoothed
COUPLING_LIMIT = 0.2  # gamma A of the ring by traction from which ring and balls are solved together
APPROACH_FLOOR = 1e-12  # least approach in the stiffness 3 Q/(2 delta) [m]
SAFETY, MIN_FACTOR, MAX_FACTOR = 0.8, 0.2, 1.5  # of the next step size
LEAST_ERROR = 1e-4  # smaller errors are the same to the next step
# orbital speed from which on the scale of velocities along the orbit holds [m/s]; its least part
FULL_ORBIT, LEAST_ORBIT = 20.0, 0.1
LAST_STEP = 1e-9  # part of a step by which the last one may be longer

POSITIONS, FRICTION, V = (
    slice(0, JOINT_PLATE_Y.start),
    slice(JOINT_PLATE_Y.start, WORK.start),
    slice(BALL_V_X.start, N_STATES),
)
N_V = N_STATES - V.start
# of the modes of elastic halves
PLACES, RATES = slice(MODE_S.start, MODE_D.stop), slice(MODE_S_DOT.start, MODE_D_DOT.stop)


def velocities(*names):
    """Indices of some blocks of the state among the velocities, one row a block."""
    blocks = [getattr(variables, name) for name in names]
    return np.array([np.arange(block.start, block.stop) - V.start for block in blocks])


BALL = velocities("BALL_V_X", "BALL_V_R", "BALL_OMEGA_M", "BALL_OMEGA_X", "BALL_OMEGA_R", "BALL_OMEGA_T")  # [6, Z]
HALF = velocities("CAGE_V_X", "CAGE_V_Y", "CAGE_V_Z", "CAGE_BETA_DOT", "CAGE_GAMMA_DOT", "CAGE_S")  # [6, 2]
RING = velocities("RING_V_X", "RING_V_Y", "RING_V_Z", "RING_BETA_DOT", "RING_GAMMA_DOT")[:, 0]  # [5]


@dataclass
class VerletState:
    """A state and what the method remembers of the way there."""

    y: np.ndarray  # state [N_STATES]
    f: np.ndarray  # its dy/dt; after a step: accelerations, mean rates of the friction states over the step, power
    jerk: np.ndarray = None  # change of f over the last step / its length
    film: np.ndarray = field(default_factory=lambda: np.zeros((2, 2, 2)))  # -dF/dv of each land's film there [N.s/m]
    h: float = 0.0  # length of that step [s], 0: none yet
    fast: FastState = None  # of elastic halves there, whose accelerations f lacks
    ratio: float = 0.0  # length that its error asks of the next step / h, 0: none yet

    def __post_init__(self):
        self.jerk = np.zeros(len(self.y)) if self.jerk is None else self.jerk


@dataclass
class Blocks:
    """The matrices of a step [N_V, N_V]: rates A [1/s], stiffnesses K [1/s2], and the parts of both that damp the
    accelerations.
    """

    A: np.ndarray
    K: np.ndarray
    A_stiff: np.ndarray
    # of the joints across the axis: a factor of its own
    K_shear: np.ndarray = field(default_factory=lambda: np.zeros((N_V, N_V)))
    axial: float = 0.0  # weights of the position correction of one half against the other: along the axis, across it
    shear: float = 0.0

    def matrix(self, gamma):
        return np.eye(N_V) + gamma * self.A + gamma**2 * self.K

    def matrix_stiff(self, gamma):
        return np.eye(N_V) + gamma * self.A_stiff


# ------------------------------------------------------------------------------------------------------------- Jacobian


def inertia(model, w):
    """Mass or moment of inertia of each velocity [N_V]; of orbital speeds m r^2."""
    p, d, M = model.p, model.d, np.empty(N_V)
    M[BALL[:2]], M[BALL[2]], M[BALL[3:]] = d.m, d.m * w.r**2, d.J
    M[HALF[:3]], M[HALF[3:5]], M[HALF[5]] = p.cage.m, d.J_t, d.J_p
    M[RING[:3]], M[RING[3:]] = p.ring.m, p.ring.J_t
    return M


def ball_surface(model, w, j, n):
    """B [3, 6]: the velocity v + omega x R n of ball j's surface at a contact, in the ball's frame, is B times the
    ball's velocities.
    """
    return np.hstack([np.diag([1.0, 1.0, w.r[j]]), np.cross(np.eye(3), model.d.R[j] * n).T])  # v_t = r omega_m


def race_surface(model, w, j, n):
    """B [3, 5] of the inner race there, for small tilts of the ring: its angular velocity is (0, beta_dot, gamma_dot)
    beside the spin.
    """
    c, s = w.cos_theta[j], w.sin_theta[j]
    axes = np.array([[1.0, 0.0, 0.0], [0.0, c, -s], [0.0, s, c]])  # rows: global X, Y, Z in the ball's frame
    point = np.array([w.x[j], w.r[j], 0.0]) + model.d.R[j] * n
    return np.vstack([axes, np.cross(axes[1:], point)]).T


def ring_coupled(model, w, gamma):
    """Whether traction holds back the ring so much that ring and balls are solved together: no force moves a ring whose
    motion is prescribed.
    """
    p, rate, r = model.p, gamma * np.sum(w.g_i), 0.5 * model.p.bearing.d_m
    if p.ring.motion == RingMotion.PRESCRIBED:
        return False
    tilts = p.ring.tilt_mode != TiltMode.PRESCRIBED and rate * r * r > COUPLING_LIMIT * p.ring.J_t
    return rate > COUPLING_LIMIT * p.ring.m or tilts


def ball_blocks(model, w, gamma):
    """Force per velocity, force per position [N_V, N_V] of race contacts and pockets, and the part of the former that
    is friction of stiff balls.

    A contact's traction is -g P u, u the slip, P = 1 - n n^T, with the secant g = |traction|/|slip|: symmetric, and
    never below the tangent of a concave law. Its normal force has the rate lambda Q and the stiffness 3 Q/(2 delta).
    Pockets: the diagonal of their friction.
    """
    d, sliced, coupled = model.d, model.p.scene.traction == Traction.SLICED, ring_coupled(model, w, gamma)
    # half the trace of A: two tangents share it
    rate = (1.0 / d.m + d.R**2 / d.J) * (w.g_i + w.g_e) + 0.5 * np.sum(w.D + w.D_omega, axis=0)
    A, K, A_stiff = np.zeros((3, N_V, N_V))
    for j in range(Z):
        rows = BALL[:, j]
        ball = np.ix_(rows, rows)
        friction = np.diag(np.append(w.D[:, j] * d.m * [1.0, 1.0, w.r[j] ** 2], w.D_omega[:, j] * d.J))
        contacts = (w.n_i, w.g_i, w.g_spin_i, w.Q_i, w.delta_i), (w.n_e, w.g_e, w.g_spin_e, w.Q_e, w.delta_e)
        for n, g, g_spin, Q, delta in ([value[..., j] for value in contact] for contact in contacts):
            B, P = ball_surface(model, w, j, n), np.eye(3) - np.outer(n, n)
            normal = np.outer(n @ B, n @ B)
            friction += g * B.T @ P @ B
            friction[3:, 3:] += sliced * g_spin * np.outer(n, n)
            A[ball] += model.p.bearing.lambda_ * Q * normal
            K[ball] += 1.5 * Q / max(delta, APPROACH_FLOOR) * (delta > 0.0) * normal
        A[ball] += friction
        A_stiff[ball] += friction * (gamma * rate[j] > STIFF_LIMIT)
        if coupled:
            n, g = w.n_i[:, j], w.g_i[j]
            B, B_race, P = ball_surface(model, w, j, n), race_surface(model, w, j, n), np.eye(3) - np.outer(n, n)
            A[np.ix_(rows, RING)] -= g * B.T @ P @ B_race
            A[np.ix_(RING, rows)] -= g * B_race.T @ P @ B
            A[np.ix_(RING, RING)] += g * B_race.T @ P @ B_race
    if model.p.ring.tilt_mode == TiltMode.PRESCRIBED:
        A[RING[3:]] = 0.0  # no force moves a prescribed tilt
    return A, K, A_stiff


def land_rates(model, film, spin):
    """Rates [2, N_V, N_V] by the films of both lands: F = -C (v_y + gamma_dot x, v_z - beta_dot x) at the lever x,
    moment -spin s.

    On a rigid cage both lands hold both halves, each with the inertia of the whole.
    """
    cage, d, rigid = model.p.cage, model.d, model.p.scene.cage == CageModel.RIGID
    m, J_p, J_t = (2.0 * cage.m, 2.0 * d.J_p, 2.0 * (d.J_t + cage.m * cage.x_c**2)) if rigid else (cage.m, d.J_p, d.J_t)
    A = np.zeros((2, N_V, N_V))
    for land in range(2):
        x = (2 * land - 1) * cage.land_x - (0.0 if rigid else model.d.com_x[land])
        B = np.array([[1.0, 0.0, 0.0, x], [0.0, 1.0, -x, 0.0]])  # of v_y, v_z, beta_dot, gamma_dot
        for half in (0, 1) if rigid else (land,):
            rows, spin_row = HALF[1:5, half], HALF[5, half]
            A[land][np.ix_(rows, rows)] = B.T @ film[land] @ B / np.array([[m], [m], [J_t], [J_t]])
            A[land][spin_row, spin_row] = spin[land] / J_p
    return A


def joint_blocks(model, w):
    """Force per axial velocity and per axial offset of half 1 against half 0 [N_V, N_V], of all joints; b = (1, z, -y)
    of v_x, beta_dot, gamma_dot.
    """
    d, h0 = model.d, w.half[0]
    y, z = (d.rivet_y * h0.b_y[i] + d.rivet_z * h0.b_z[i] for i in (1, 2))
    B = np.zeros((Z, N_V))
    B[:, HALF[[0, 3, 4], 1]] = np.array([np.ones(Z), z, -y]).T
    B[:, HALF[[0, 3, 4], 0]] = -B[:, HALF[[0, 3, 4], 1]]
    c, k = (
        d.c_joint * w.N_plate / (w.N_plate + model.p.joint.F_floor),
        d.k_rivet * (w.T > 0.0) + d.k_plate * (w.N_plate > 0.0),
    )
    return B.T * c @ B, B.T * k @ B


def shear_blocks(model, w, gamma):
    """Force per offset [N_V, N_V] of the joints across the axis: of half 1 against half 0 at a rivet, (v_y - s z, v_z +
    s y).

    The lever of the split from the centres of mass is left out.  A friction state that decays with D follows the
    velocity by gamma/(1 + gamma D) within a step.
    """
    d, h0 = model.d, w.half[0]
    y, z = (d.rivet_y * h0.b_y[i] + d.rivet_z * h0.b_z[i] for i in (1, 2))
    k = d.k_plate_t / (1.0 + gamma * w.plate_rate) + d.k_head / (1.0 + gamma * w.head_rate) + w.k_bearing
    B = np.zeros((2, Z, N_V))
    B[0][:, HALF[[1, 2, 5], 1]] = np.array([np.ones(Z), np.zeros(Z), -z]).T
    B[1][:, HALF[[1, 2, 5], 1]] = np.array([np.zeros(Z), np.ones(Z), y]).T
    B[:, :, HALF[:, 0]] = -B[:, :, HALF[:, 1]]
    return sum(b.T * k @ b for b in B)


def ring_support(model):
    """Rates and stiffnesses [N_V] of the ring's own velocities by its support, and the rates that damp its
    accelerations.
    """
    ring, (A, K, A_stiff) = model.p.ring, np.zeros((3, N_V))
    A[RING[:3]] = A_stiff[RING[:3]] = ring.c / ring.m
    if ring.tilt_mode == TiltMode.PRESCRIBED:
        A[RING[3:]], K[RING[3:]] = 2.0 / ring.tilt_time, 1.0 / ring.tilt_time**2
    if ring.tilt_mode == TiltMode.SUPPORTED:
        A[RING[3:]], K[RING[3:]], A_stiff[RING[3:]] = (
            ring.c_tilt / ring.J_t,
            ring.k_tilt / ring.J_t,
            ring.c_tilt / ring.J_t,
        )
    return A, K, A_stiff


def jacobian_blocks(model, t, y, w, gamma):
    """What C keeps of A = -da/dv and K = -da/dq at the evaluation w of (t, y): stiff local terms in closed form,
    traction by its secant.
    """
    M = inertia(model, w)[:, None]
    A, K, A_stiff = (
        force / M + np.diag(support)
        for force, support in zip(ball_blocks(model, w, gamma), ring_support(model), strict=True)
    )
    A_0, A_1 = land_rates(model, land_films(w), w.film_spin)
    K_shear, axial, shear = np.zeros((N_V, N_V)), 0.0, 0.0
    if model.p.scene.cage == CageModel.TWO_HALF:
        (A_joint, K_joint), K_shear = (force / M for force in joint_blocks(model, w)), shear_blocks(model, w, gamma) / M
        weight, axial = vibration_weights(
            8.0 * np.max(np.diag(gamma * A_joint + gamma**2 * K_joint)[HALF[[0, 3, 4], 0]])
        )
        weight_shear, shear = vibration_weights(8.0 * gamma**2 * np.max(np.diag(K_shear)[HALF[[1, 5], 0]]))
        A, K, K_shear = A + weight * A_joint, K + weight * K_joint, weight_shear * K_shear
    return Blocks(A + A_0 + A_1, K, A_stiff + A_0 + A_1, K_shear, axial, shear)


def vibration_weights(x_2):
    """Weights of a vibration between the halves that turns by x = omega h a step, given x^2: of K in the matrix, of the
    position correction.
    """
    part = x_2**2 / (x_2**2 + 1.0)
    return 1.0 / 3.0 + part * (1.5 - 1.0 / 3.0), 1.0 / 3.0 + part * (1.7 - 1.0 / 3.0)


def masked_jacobian(model, t, y, w, gamma):
    """The exact derivatives of the right-hand side by complex steps, masked to the entries that jacobian_blocks keeps:
    another choice of A and K.
    """
    kept, J = jacobian_blocks(model, t, y, w, gamma), jacobian(model, t, y)
    by_position = np.zeros((N_V, N_V))
    by_position[:, POSITIONS] = J[V, POSITIONS]  # velocities are in the order of their positions
    return Blocks(
        np.where(kept.A != 0.0, -J[V, V], 0.0),
        np.where(kept.K != 0.0, -by_position, 0.0),
        kept.A_stiff,
        kept.K_shear,
        kept.axial,
        kept.shear,
    )


# ----------------------------------------------------------------------------------------------------------------- step


def land_films(w):
    """-dF/dv [2, 2, 2] of each land's film."""
    return np.array([[w.film_yy, w.film_yz], [w.film_yz, w.film_zz]]).transpose(2, 0, 1)


def advance_positions(model, h, start):
    """The state with positions and friction states of the next step, which follow from the velocities v_m of the
    middle.

    Elastic halves take substeps, which change the velocities too: their length, and the slow accelerations of the modes
    at the end [2, n]. Last the Work with the kinematics of the middle.
    """
    middle, y, w = start.y.copy(), start.y.copy(), Work()
    middle[V] = y[V] = start.y[V] + 0.5 * h * start.f[V]
    middle[POSITIONS] += 0.5 * h * y[V][POSITIONS]
    y[POSITIONS] += h * y[V][POSITIONS]
    rotor_kinematics(model, middle, w)
    elastic = model.p.scene.cage == CageModel.ELASTIC
    y[CAGE_PSI] = start.y[CAGE_PSI] + h * np.concatenate([half.s - rotor_roll(half) for half in w.half])
    if model.p.scene.cage != CageModel.RIGID:
        cage_joint_kinematics(model, w)
        if not elastic:
            cage_joint_advance(model, w, h, y)
    substeps = (
        cage_substeps_advance(model, h, start.fast, start.f, y, w) if elastic else (0.0, (None, np.zeros((6, 2))))
    )
    return y, *substeps, w


def predictor_limiter(model, h, start):
    """What is taken from the predicted change h a_n of the cage's velocities [N_V]: the part of its new share that the
    films at the step's start hold back.

    A film holds back a land that closes and hardly one that opens: a land that rests against its film would be thrown
    off by a prediction from a_n alone. The share that a_n and a_{n-1} have in common, minmod(a_n, a_{n-1}), counts as
    steady.
    """
    a, before = start.f[V], (start.f - start.h * start.jerk)[V]
    minmod = np.where(a * before > 0.0, np.where(np.abs(a) < np.abs(before), a, before), 0.0)
    new = np.zeros(N_V)
    new[HALF] = h * (a - minmod)[HALF]
    A_0, A_1 = land_rates(model, start.film, np.zeros(2))
    return new - np.linalg.solve(np.eye(N_V) + h * (A_0 + A_1), new)


def dissipation_correction(model, w, gamma, residual, delta):
    """delta.M A delta [W] of balls and cage: the power that v^ dissipates beyond what v_{n+1} does, of one sign, where
    rates are linear.

    The residual gives delta.M (A + gamma K) delta; the part of the races' springs, which dissipate nothing, is taken
    off.
    """
    power = inertia(model, w) * delta * (residual - delta) / gamma
    power[RING] = 0.0  # the ring's energy is not in the balance
    v = delta[BALL[:3]] * np.array([np.ones(Z), np.ones(Z), w.r])
    springs = ((w.n_i, w.Q_i, w.delta_i), (w.n_e, w.Q_e, w.delta_e))
    elastic = sum(
        1.5 * Q / np.maximum(approach, APPROACH_FLOOR) * (approach > 0.0) * np.sum(n * v, axis=0) ** 2
        for n, Q, approach in springs
    )
    return np.sum(power) - gamma * np.sum(elastic)


def correct_positions(model, gamma, delta, b, y):
    """Where a stiffness acts, positions follow the trapezoidal rule too: q_{n+1} += gamma (v_{n+1} - v_n - h a_n), one
    half against the other with weights.
    """
    y[BALL_X] += gamma * delta[BALL[0]]
    y[BALL_R] += gamma * delta[BALL[1]]
    if model.p.ring.tilt_mode != TiltMode.FREE:
        y[RING_BETA.start : RING_GAMMA.stop] += gamma * delta[RING[3:]]
    if model.p.scene.cage == CageModel.TWO_HALF:  # the motion of one half against the other
        weights = (b.axial, b.shear, b.shear, b.axial, b.axial, b.shear)
        for q, rows, c in zip((CAGE_X, CAGE_Y, CAGE_Z, CAGE_BETA, CAGE_GAMMA, CAGE_PSI), HALF, weights, strict=True):
            y[q] += 0.5 * c * gamma * (delta[rows[1]] - delta[rows[0]]) * np.array([-1.0, 1.0])


def correct_friction(model, w, gamma, delta, c, y):
    """The friction states are deflections of springs and follow likewise: z_{n+1} += c gamma u/(1 + gamma D), u the
    change of the joint's velocity.
    """
    if model.p.scene.cage != CageModel.TWO_HALF:
        return
    d, h0 = model.d, w.half[0]
    _, dv_y, dv_z, _, _, ds = delta[HALF[:, 1]] - delta[HALF[:, 0]]
    u_y, u_z = (axis[1] * dv_y + axis[2] * dv_z for axis in (h0.b_y, h0.b_z))
    u = u_y - ds * d.rivet_z, u_z + ds * d.rivet_y
    for rate, blocks in ((w.plate_rate, (JOINT_PLATE_Y, JOINT_PLATE_Z)), (w.head_rate, (JOINT_HEAD_Y, JOINT_HEAD_Z))):
        for u_i, z in zip(u, blocks, strict=True):
            y[z] += c * gamma * u_i / (1.0 + gamma * rate)


def verlet_step(model, t, h, weight, start, blocks=jacobian_blocks):
    """The step of length h [s] from `start` (VerletState) at t [s]: the VerletState reached, and the weighted RMS norm
    of its error.

    weight: 1/(tolerance scale) of each state.  blocks: function of (model, t, y, w, gamma) that gives the Blocks; any A
    and K keep the second order.
    """
    gamma, f, a, w = 0.5 * h, start.f, start.f[V], Work()
    (y, sub, (foreseen, of_halves), middle), held = (
        advance_positions(model, h, start),
        predictor_limiter(model, h, start),
    )
    y[V] += gamma * a - held
    elastic = model.p.scene.cage == CageModel.ELASTIC
    if elastic:
        cage_substeps_kick(model, middle, 0.5 * sub, start.fast.rigid, y)
        add_rates(model, 0.5 * sub * (start.fast.modes + foreseen), y)
    end = VerletState(y, rhs(model, t + h, y, w), h=h)
    end.film = land_films(w)
    if elastic:
        end.fast = cage_substeps_split(model, y, w, end.f)
        add_rates(model, 0.5 * sub * (end.fast.modes - start.fast.modes), y)
        cage_substeps_kick(model, w, 0.5 * sub, end.fast.rigid - start.fast.rigid, y)

    # One linear solve takes the predicted velocities to those of the trapezoidal rule.
    foreseen_rates = np.zeros(N_V)
    foreseen_rates[HALF] = of_halves
    b, residual = blocks(model, t + h, y, w, gamma), held + gamma * (end.f[V] - a - foreseen_rates)
    residual = np.linalg.solve(np.eye(N_V) + gamma**2 * b.K_shear, residual)
    delta = np.linalg.solve(b.matrix(gamma), residual)
    end.f[WORK] += dissipation_correction(model, w, gamma, residual, delta)
    delta -= held  # from here on delta = v_{n+1} - v_n - h a_n
    correct_positions(model, gamma, delta, b, y)
    correct_friction(model, w, gamma, delta, b.shear, y)
    y[V] += held + delta
    delta += gamma * foreseen_rates
    y[WORK] += gamma * (f[WORK] + end.f[WORK])

    # Velocities: error h^3/12 a'' of the trapezoidal rule; stiff accelerations give up a part of their second
    # difference h^2 a''.
    error, second = np.zeros(len(y)), 2.0 * h * h / (h + start.h)
    second_difference = second * (delta / (gamma * h) - start.jerk[V])
    error[V] = h / 12.0 * second_difference
    damped = second_difference - np.linalg.solve(b.matrix_stiff(gamma), second_difference)
    end.f[V] = a + delta / gamma - SMOOTHING * damped
    end.jerk[V] = (end.f[V] - a) / h

    # Friction states: their mean rate over the step, and the error h^3/24 q''' of the midpoint rule.
    end.f[FRICTION] = (y - start.y)[FRICTION] / h
    end.jerk[FRICTION] = 2.0 / (h + start.h) * (end.f - f)[FRICTION]
    error[FRICTION] = h / 24.0 * second * (end.jerk - start.jerk)[FRICTION]
    if elastic:
        correct_modes(model, h, second, foreseen, start, end, error)
    return end, np.sqrt(np.sum((error * weight) ** 2) / N_STATES)  # modes do not make the tolerance of the others wider


def verlet_evaluate(model, t, y):
    """VerletState at y, without a history: f, of elastic halves without the fast part, and that part."""
    w = Work()
    state = VerletState(y, rhs(model, t, y, w))
    if model.p.scene.cage == CageModel.ELASTIC:
        state.fast = cage_substeps_split(model, y, w, state.f)
    return state


def add_rates(model, change, y):
    """Adds to the rates of the modes of elastic halves, S and D [2, n]."""
    for block, more in zip((MODE_S_DOT, MODE_D_DOT), change, strict=True):
        y[block][: model.d.elastic.n] += more


def correct_modes(model, h, second, foreseen, start, end, error):
    """Rates of the modes of elastic halves: the substeps had the slow accelerations `foreseen` [2, n] at the end."""
    n = model.d.elastic.n
    add_rates(model, 0.5 * h * (np.array([end.f[block][:n] for block in (MODE_S_DOT, MODE_D_DOT)]) - foreseen), end.y)
    end.jerk[RATES] = (end.f - start.f)[RATES] / h
    error[RATES] = h / 12.0 * second * (end.jerk - start.jerk)[RATES]
    end.f[PLACES], end.jerk[PLACES] = end.y[RATES], 0.0


def longest_step(model, state):
    """The longest step from a state [s]: of elastic halves three substeps, or what a film of the rate A holds for, 1/A,
    but two substeps at least.
    """
    if model.p.scene.cage != CageModel.ELASTIC:
        return np.inf
    film, d = np.max(np.trace(state.film, axis1=1, axis2=2)), model.d.elastic.substep
    return min(3.0 * d, max(2.0 * d, model.p.cage.m / film if film > 0.0 else np.inf))


def weigh_orbit(model, weight, y):
    """Weights with those of velocities along the orbit by its speed against the outer ring: the speed with which ball
    and pocket meet goes with it.
    """
    speed = 0.5 * model.p.bearing.d_m * np.mean(np.abs(y[BALL_OMEGA_M] - model.ring_load.outer_omega))
    weight = weight.copy()
    weight[BALL_OMEGA_M] /= min(max(speed / FULL_ORBIT, LEAST_ORBIT), 1.0)
    return weight


def ratio_of(error):
    """Length that a step's error asks of the next one / its own length; 0 where the error is not a number."""
    return SAFETY * max(error, LEAST_ERROR) ** (-1.0 / 3.0) if error >= 0.0 else 0.0


def step_factor(h, error, before):
    """Length of the next step / h: after an accepted step of length h by the digital filter H211b of Soderlind (2003),
    b = 4, after a refused one its ratio.

    before: length and ratio of the step before, 0 if there is none.
    """
    ratio, (h_before, ratio_before) = ratio_of(error), before
    filtered = error <= 1.0 and ratio_before > 0.0
    return min(max((ratio * ratio_before * h_before / h) ** 0.25 if filtered else ratio, MIN_FACTOR), MAX_FACTOR)


def verlet_advance(model, t, t_stop, h, weight, state, step=verlet_step):
    """Steps under control of the error from `state` at t to t_stop [s]; h: the step size to begin with.

    Returns the state reached, the step size to go on with, the accepted step lengths and how many steps were refused.
    The estimate is of order h^3; the last two steps are equal.  step: a function like verlet_step.
    """
    taken, refused = [], 0
    weight = weigh_orbit(model, weight, state.y)
    while t < t_stop:
        h, left = min(h, longest_step(model, state)), t_stop - t
        last = h >= left * (1.0 - LAST_STEP)
        length = left if last else 0.5 * left if left < 2.0 * h else h
        end, error = step(model, t, length, weight, state)
        factor = step_factor(length, error, (state.h, state.ratio))
        if not error <= 1.0:
            h, refused = length * factor, refused + 1
            continue
        state, t = end, t_stop if last else t + length
        state.ratio = ratio_of(error)
        taken.append(length)
        if length == h or factor < 1.0:  # a step cut short to meet t_stop says nothing against the step size before it
            h = length * factor
    return state, h, np.array(taken), refused
