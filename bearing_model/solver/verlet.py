"""One step of the default method, a linearly implicit trapezoidal rule, with dense matrices: the readable twin of
verlet.c and implicit.c.

    v_m = v_n + gamma a_n,  gamma = h/2
    q_{n+1} = q_n + h q'(q_m, v_m),  q_m = q_n + gamma v_m           velocity Verlet; friction states likewise, then return mapping (cage_joint_slide)
    v^ = v_n + h a_n - limiter + p,  a^ = a(t_{n+1}, q_{n+1}, v^)    predictor; limiter of the halves by films, p of the balls (cage_begin)
    (1 + gamma A + gamma^2 K) delta = gamma (a^ - a_n) + limiter     one linear solve, A ~ -da/dv, K ~ -da/dq of the stiff parts (jacobian_blocks)
    v_{n+1} = v^ + delta = v_n + gamma (a_n + a_{n+1})               the trapezoidal rule; any A and K leave its order two: a W-method
    a_{n+1} -= 0.15 H (a_{n+1} - 2 a_n + a_{n-1}),  H = 1 - (1 + gamma A)^-1    damping of stiff rates

cage_begin and cage_end do this for the rows of the cage; here are those of balls and ring.  p: impulses on the balls by changes of the
loads on walls, which follow in the cage's substeps, beyond those of the trapezoidal rule.
The derivation, the reasons of all constants and the literature are in docs/method.md.  C eliminates balls and ring
one after the other, with Schur complements; here one dense solve does the same.  Vectors v, a, delta and all
matrices have the N_V velocities of the state, in their order.
"""

from dataclasses import dataclass

import numpy as np

from bearing_model.cage.cage import CageMemory, cage_begin, cage_end, cage_longest_step, cage_part, cage_split
from bearing_model.generated import variables
from bearing_model.generated import variables as Y
from bearing_model.generated.variables import RingMotion, TiltMode, Traction, Z
from bearing_model.numbers.trapezoid import trapezoid_end, trapezoid_error
from bearing_model.physics.model import Work
from bearing_model.physics.powers import friction_torque, shaft_power
from bearing_model.physics.rhs import rhs

STIFF_LIMIT = 2.0  # gamma A of a ball from which its accelerations are smoothed
BUSY, QUIET = 0.25, 0.2  # mean error of a busy bearing, least part of the tolerance
MEAN_OVER = 0.01  # time of that mean [s]
COUPLING_LIMIT = 0.2  # gamma A of the ring by traction from which ring and balls are solved together
TRACTION_MARGIN = 1.4  # traction's rates in A / the secants |traction|/|slip| of the evaluation
APPROACH_FLOOR = 1e-12  # least approach in the stiffness 3 Q/(2 delta) [m]
SAFETY, MIN_FACTOR, MAX_FACTOR = 0.8, 0.2, 1.5  # of the next step size
LEAST_ERROR = 1e-4  # smaller errors are the same to the next step
# orbital speed from which on the scale of velocities along the orbit holds [m/s]; its least part
FULL_ORBIT, LEAST_ORBIT = 20.0, 0.1
LAST_STEP = 1e-9  # part of a step by which the last one may be longer

POSITIONS, FRICTION, V = (
    slice(0, Y.JOINT_PLATE_Y.start),
    slice(Y.JOINT_PLATE_Y.start, Y.WORK.start),
    slice(Y.BALL_V_X.start, Y.N_STATES),
)
N_V = Y.N_STATES - V.start
CAGE = slice(Y.CAGE_V_X.start - V.start, Y.RING_V_X.start - V.start)  # velocities of the cage's halves
OTHERS = np.delete(np.arange(N_V), CAGE)  # those of balls and ring


def velocities(*names):
    """Indices of some blocks of the state among the velocities, one row a block."""
    blocks = [getattr(variables, name) for name in names]
    return np.array([np.arange(block.start, block.stop) - V.start for block in blocks])


BALL = velocities("BALL_V_X", "BALL_V_R", "BALL_OMEGA_M", "BALL_OMEGA_X", "BALL_OMEGA_R", "BALL_OMEGA_T")  # [6, Z]
HALF = velocities("CAGE_V_X", "CAGE_V_Y", "CAGE_V_Z", "CAGE_BETA_DOT", "CAGE_GAMMA_DOT", "CAGE_S")  # [6, 2]
RING = velocities("RING_V_X", "RING_V_Y", "RING_V_Z", "RING_BETA_DOT", "RING_GAMMA_DOT")[:, 0]  # [5]


@dataclass
class VerletState:
    """A state and the method's memory of the way there."""

    y: np.ndarray  # state [N_STATES]
    f: np.ndarray  # its dy/dt; after a step: accelerations, mean rates of the friction states over the step, power
    jerk: np.ndarray = None  # change of f over the last step that its substeps did not foresee / its length
    h: float = 0.0  # length of that step [s], 0: none yet
    cage: CageMemory = None  # of the cage there; f lacks the accelerations that it advances by itself
    ratio: float = 0.0  # length that its error asks of the next step / h, 0: none yet
    error_mean: float = 0.0  # of the steps of the last 10 ms / error that is accepted
    # exchange with the shaft there, by the forces that move the balls: torque about its axis [N.m], power [W]
    exchange: np.ndarray = None

    def __post_init__(self):
        self.jerk = np.zeros(len(self.y)) if self.jerk is None else self.jerk


@dataclass
class Blocks:
    """The matrices of a step [N_V, N_V]: rates A [1/s], stiffnesses K [1/s2], and the parts of both that damp the
    accelerations.  Rows of the cage are 0: it has its own (cage_end).
    """

    A: np.ndarray
    K: np.ndarray
    A_stiff: np.ndarray

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

    A contact's traction is -g P u, u the slip, P = 1 - n n^T, with g = TRACTION_MARGIN times the secant |traction|/|slip|:
    symmetric, and never below the tangent of a concave law. Its normal force has the rate lambda Q and the stiffness 3 Q/(2 delta).
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
            g, g_spin = TRACTION_MARGIN * g, TRACTION_MARGIN * g_spin
            B, P = ball_surface(model, w, j, n), np.eye(3) - np.outer(n, n)
            normal = np.outer(n @ B, n @ B)
            friction += g * B.T @ P @ B
            friction[3:, 3:] += sliced * g_spin * np.outer(n, n)
            A[ball] += model.p.bearing.lambda_ * Q * normal
            K[ball] += 1.5 * Q / max(delta, APPROACH_FLOOR) * (delta > 0.0) * normal
        A[ball] += friction
        A_stiff[ball] += friction * (gamma * rate[j] > STIFF_LIMIT)
        if coupled:
            n, g = w.n_i[:, j], TRACTION_MARGIN * w.g_i[j]
            B, B_race, P = ball_surface(model, w, j, n), race_surface(model, w, j, n), np.eye(3) - np.outer(n, n)
            A[np.ix_(rows, RING)] -= g * B.T @ P @ B_race
            A[np.ix_(RING, rows)] -= g * B_race.T @ P @ B
            A[np.ix_(RING, RING)] += g * B_race.T @ P @ B_race
    if model.p.ring.tilt_mode == TiltMode.PRESCRIBED:
        A[RING[3:]] = 0.0  # no force moves a prescribed tilt
    return A, K, A_stiff


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
    """The entries of A = -da/dv and K = -da/dq that C has too, at the evaluation w of (t, y): stiff local terms in closed
    form, traction by its secant.
    """
    M = inertia(model, w)[:, None]
    A, K, A_stiff = (
        force / M + np.diag(support)
        for force, support in zip(ball_blocks(model, w, gamma), ring_support(model), strict=True)
    )
    return Blocks(A, K, A_stiff)


def ring_wrench(model, w, gamma, delta):
    """Adds to the wrench of the race contacts on the ring in w the part by the forces that the solve's result delta adds on
    the balls: it becomes the wrench that moved them.
    """
    sliced, V = model.p.scene.traction == Traction.SLICED, delta[RING] * ring_coupled(model, w, gamma)
    for j in range(Z):
        n, v, axes = w.n_i[:, j], delta[BALL[:, j]], race_surface(model, w, j, w.n_i[:, j])[:, :3].T
        slip = ball_surface(model, w, j, n) @ v - race_surface(model, w, j, n) @ V
        approach = n @ (v[:3] * [1.0, 1.0, w.r[j]])
        stiffness = 1.5 * w.Q_i[j] / max(w.delta_i[j], APPROACH_FLOOR) * (w.delta_i[j] > 0.0)
        rate = model.p.bearing.lambda_ * w.Q_i[j] + gamma * stiffness
        force = TRACTION_MARGIN * w.g_i[j] * (slip - n * (n @ slip)) + rate * approach * n
        moment = sliced * TRACTION_MARGIN * w.g_spin_i[j] * (n @ v[3:]) * n
        place = np.array([w.x[j], w.r[j], 0.0]) + model.d.R[j] * n - axes.T @ w.ring.x[:, 0]
        w.ring.F = w.ring.F + (axes @ force)[:, None]
        w.ring.M = w.ring.M + (axes @ (moment + np.cross(place, force)))[:, None]


def exchange_at(w):
    """Exchange with the shaft by the forces on the ring in w: torque [N.m], power [W]."""
    return np.array([friction_torque(w)[0], shaft_power(w)[0]])


# ----------------------------------------------------------------------------------------------------------------- step


def predict(h, start):
    """The state in the middle of the step; that at its end with positions by the velocities v_m of the middle and predicted
    velocities.  The cage then sets its own rows.
    """
    middle, y = start.y.copy(), start.y.copy()
    middle[V] += 0.5 * h * start.f[V]
    middle[POSITIONS] += 0.5 * h * middle[V][POSITIONS]
    y[POSITIONS] += h * middle[V][POSITIONS]
    y[V] = middle[V] + 0.5 * h * start.f[V]
    return middle, y


def dissipation_correction(model, w, gamma, residual, delta):
    """delta.M A delta [W] of balls and cage: the power that v^ dissipates beyond that of v_{n+1}, of one sign, where
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


def correct_positions(model, gamma, delta, balls, y):
    """Where a stiffness acts, positions follow the trapezoidal rule too: q_{n+1} += gamma (v_{n+1} - v_n - h a_n); the
    cage has weights of its own.  balls: changes of their accelerations whose ways y has [3 Z].
    """
    y[Y.BALL_X] += gamma * (delta[BALL[0]] - gamma * balls[:Z])
    y[Y.BALL_R] += gamma * (delta[BALL[1]] - gamma * balls[Z : 2 * Z])
    if model.p.ring.tilt_mode != TiltMode.FREE:
        y[Y.RING_BETA.start : Y.RING_GAMMA.stop] += gamma * delta[RING[3:]]


def verlet_step(model, t, h, weight, start, blocks=jacobian_blocks):
    """The step of length h [s] from `start` (VerletState) at t [s]: the VerletState reached, and the weighted RMS norm
    of its error.

    weight: 1/(tolerance scale) of each state.  blocks: function of (model, t, y, w, gamma) that gives the Blocks; any A
    and K keep the second order.
    """
    gamma, f, a, w = 0.5 * h, start.f, start.f[V], Work()
    middle, y = predict(h, start)
    cage = cage_begin(model, h, start, middle, y, w)
    end, error = VerletState(y, rhs(model, t + h, y, w), h=h), np.zeros(len(y))
    cage_residual, cage_delta, balls, film_power = cage_end(model, cage, start, end, error, w)

    # One linear solve takes the predicted velocities to those of the trapezoidal rule.
    b, residual = blocks(model, t + h, y, w, gamma), gamma * (end.f[V] - a)
    delta = np.linalg.solve(b.matrix(gamma), residual)
    residual[CAGE], delta[CAGE] = cage_residual, cage_delta
    end.f[Y.WORK] += dissipation_correction(model, w, gamma, residual, delta) + film_power
    ring_wrench(model, w, gamma, delta)
    end.exchange = exchange_at(w)
    y[V][OTHERS] += delta[OTHERS]  # delta = v_{n+1} - v_n - h a_n
    correct_positions(model, gamma, delta, balls, y)
    y[Y.WORK] += gamma * (f[Y.WORK] + end.f[Y.WORK])

    # Error and history of the velocities; stiff accelerations give up a part of their second difference.
    unforeseen = delta.copy()
    if model.d.squeeze is None:  # elastic_end says why
        unforeseen[BALL[:3].ravel()] -= gamma * balls
    second, errors = trapezoid_error(h, start.h, unforeseen, start.jerk[V])
    stiff = second - np.linalg.solve(b.matrix_stiff(gamma), second)
    for rows, values in zip((end.f, end.jerk), trapezoid_end(h, a, delta, unforeseen, stiff), strict=True):
        rows[V][OTHERS] = values[OTHERS]
    error[V][OTHERS] = errors[OTHERS]
    return end, np.sqrt(
        np.sum((error * weight) ** 2) / Y.N_STATES
    )  # modes do not make the tolerance of the others wider


def verlet_evaluate(model, t, y):
    """VerletState at y, without a history: f without the part that the cage advances by itself, and that part."""
    w = Work()
    state = VerletState(y, rhs(model, t, y, w))
    state.cage, state.exchange = cage_split(model, y, w, state.f), exchange_at(w)
    return state


def weigh_orbit(model, weight, y):
    """Weights with those of velocities along the orbit by its speed against the outer ring: the speed with which ball
    and pocket meet goes with it.
    """
    speed = 0.5 * model.p.bearing.d_m * np.mean(np.abs(y[Y.BALL_OMEGA_M] - model.ring_load.outer_omega))
    weight = weight.copy()
    weight[Y.BALL_OMEGA_M] /= min(max(speed / FULL_ORBIT, LEAST_ORBIT), 1.0)
    return weight


def ratio_of(error):
    """Length that a step's error asks of the next one / its own length; 0 where the error is not a number."""
    return SAFETY * max(error, LEAST_ERROR) ** (-1.0 / 3.0) if error >= 0.0 else 0.0


def tolerance_part(state):
    """Part of the tolerance that steps are given: less where the longest step and not the error decides most of them."""
    return max(min(state.error_mean / BUSY, 1.0) ** 3, QUIET)


def next_goal(goal, h, error, before):
    """Length wanted of the next step after one of length h that had the goal: after an accepted step by the digital filter H211b of
    Soderlind (2003), b = 4, after a refused one by its ratio.  A step cut short to meet t_stop says nothing against its goal.

    before: length and ratio of the step before, 0 if there is none.
    """
    ratio, (h_before, ratio_before) = ratio_of(error), before
    filtered = error <= 1.0 and ratio_before > 0.0
    factor = (ratio * ratio_before * h_before / h) ** 0.25 if filtered else ratio
    proposed = min(h * max(factor, MIN_FACTOR), MAX_FACTOR * goal)
    return max(goal, proposed) if error <= 1.0 and proposed >= h else proposed


def verlet_advance(model, t, t_stop, h, weight, state, step=verlet_step):
    """Steps under control of the error from `state` at t to t_stop [s]; h: the step size to begin with.

    Returns the state reached, the step size to go on with, the accepted step lengths and how many steps were refused.
    The estimate is of order h^3; the steps up to t_stop are equal as far as h stays.  step: a function like verlet_step.
    """
    taken, refused = [], 0
    weight = weigh_orbit(model, weight, state.y)
    while t < t_stop:
        left, h = t_stop - t, min(h, cage_longest_step(model, state.cage))
        length = left / max(np.ceil(left / h * (1.0 - LAST_STEP)), 1.0)
        last = length == left
        end, error = step(model, t, length, weight, state)
        error /= cage_part(end.cage) * tolerance_part(state)
        h = next_goal(h, length, error, (state.h, state.ratio))
        if not error <= 1.0:
            refused += 1
            continue
        end.error_mean = state.error_mean + min(length / MEAN_OVER, 1.0) * (error - state.error_mean)
        state, t = end, t_stop if last else t + length
        state.ratio = ratio_of(error)
        taken.append(length)
    return state, h, np.array(taken), refused
