"""Loads of balls on the walls of elastic halves within a step: the readable twin of wall_loads.c, which has the equations.

    x(t) = x_0 + r t + b t (t - h)/2 - u(t) - g.d(t),  delta + c Q_0 = x,  Q_0 = w K delta^1.5
    Q = Q_0 (1 + lambda (x_dot - Y d/2 (Q - Q_before)))

r, b: rate in the middle of the step and acceleration of the rigid approach by slow forces; u, g.d: motion of the wall by
the modes and by the motions d of the halves and of the ball, which joints and the changes of these loads cause; x_dot: from
the ways in this substep and in the one before, half a substep d ahead of the mean speed; Y: mobility of the contact.
"""

from dataclasses import dataclass

import numpy as np

from bearing_model.cage.common.pocket import pocket_share
from bearing_model.cage.common.rigid_approach import rigid_approach
from bearing_model.cage.elastic.elastic_half import ROOT
from bearing_model.cage.elastic.elastic_wall import elastic_wall_shape, ribbon_wall_shapes
from bearing_model.generated.variables import BALL_OMEGA_M, BALL_R, BALL_THETA, BALL_V_R, BALL_V_X, BALL_X, Z

# Contacts of each half with its walls as an evaluation leaves them, in the rows of FastState.touch: direction (x, t), of a ribbon also
# r, Hertz's constant, approach, load; of a ribbon place chi, radius and front (ribbon_wall_shapes)
TOUCH = "x", "r", "t", "K", "delta", "Q", "chi", "radius", "front"
LEAST_DAMPING = 1e-6  # from which a speed follows [s/m]


@dataclass
class WallLoad:
    """A ball on a wall, or before it: law, approach and load at the step's start, rigid approach, motion of the wall; the load without damping
    and its change since the start; way of the approach since then and its mean speed in the substep, at first the start's.
    """

    half: int
    ball: int
    K: float
    n_x: float
    x: float
    Q: float
    rate: float
    acceleration: float
    shape: np.ndarray  # motion along the normal by S and D [2, n]
    start: float  # motion of the wall at the step's start
    along: np.ndarray  # motion along the normal by those of the half: x, y, z, beta, gamma, spin [6]
    normal: np.ndarray  # along x, r, t of the ball [3]
    mobility: float  # of wall, half and ball along the normal, tilts left out [1/kg]
    speed: float
    elastic: float = 0.0
    more: float = 0.0
    moved: float = 0.0


class WallLoads:
    """The loads on walls of a step of length h [s]; motions of the balls by their changes along x, r, t [3, Z]: accelerations,
    velocities, ways.
    """

    def __init__(self, model, h, fast, f, state, y, q, w):
        self.m, self.c, self.middle, self.loads = model.p.cage.m, model.modes.compliance, 0.5 * h, []
        self.m_ball, self.damping, self.first, self.d = model.d.m, model.p.cage.lambda_, True, model.d
        self.push, self.speed, self.way, self.still = *np.zeros((3, 3, Z)), np.zeros_like(q)
        self.inertia = np.array(3 * [self.m] + 2 * [model.d.J_t] + [model.d.J_p])
        for i, rows in enumerate(fast.touch):
            touch = dict(zip(TOUCH, rows, strict=True))
            if not np.any(touch["K"] > 0.0):
                continue
            if model.d.spheres:
                place = (touch[name] for name in ("chi", "radius", "front"))
                shape = ribbon_wall_shapes(model.modes, 2 * i - 1, *place)[0]
            else:
                shape = elastic_wall_shape(model.modes, 2 * i - 1, touch["x"], touch["t"])[0]  # [3, Z, n]
            along = [touch[name][:, None] * motion for name, motion in zip("xrt", shape, strict=True)]
            for k in np.flatnonzero(touch["K"] > 0.0):
                n = [touch[name][k] for name in "xrt"]
                rate, acceleration, along_half, normal = rigid_approach(
                    model, self.middle, n, f, state, y, w.half[i], i, k
                )
                K, delta, Q = (touch[name][k] for name in ("K", "delta", "Q"))
                Q_0 = self.law(i, K, n[0], max(delta, 0.0))
                if not Q_0 > 0.0 and not delta + h * rate > 0.0:
                    continue
                x = delta + self.c * Q_0
                pressed, damping = Q_0 > 0.0, max(self.damping, LEAST_DAMPING)
                speed = (Q / Q_0 - 1.0) / damping if pressed else rate - self.middle * acceleration
                shift = sum(row[k] for row in along) / ROOT
                both = np.array([shift, (2 * i - 1) * shift])
                mobility = 1.0 / self.m_ball + 1.0 / self.m + 2.0 / self.m * np.sum(shift**2)
                start = np.sum(both * q)
                self.loads.append(
                    WallLoad(i, k, K, n[0], x, Q, rate, acceleration, both, start, along_half, normal, mobility, speed)
                )

    def law(self, half, K, n_x, delta):
        """w K delta^1.5, w: share of the half in a contact of the approach delta; 1 of a ribbon."""
        return K * delta**1.5 * (1.0 if self.d.spheres else pocket_share(self.d, half, n_x, delta)[0])

    def at(self, load, x):
        """w K delta^1.5 of the approach x."""
        if not x > 0.0:
            return 0.0
        delta = x / (1.0 + self.c * load.K * np.sqrt(x))
        for _ in range(2):
            more = self.c * self.law(load.half, load.K, load.n_x, delta)
            delta = max(delta - (delta + more - x) / (1.0 + 1.5 * more / max(delta, 1e-30)), 0.0)
        return self.law(load.half, load.K, load.n_x, delta)

    def drift(self, sub):
        """Moves the balls over a substep, of whose velocities the second half is still to come."""
        self.speed = self.speed + 0.5 * sub * self.push
        self.way = self.way + sub * self.speed

    def arrive(self, h, y):
        """Adds the balls' ways to the state, and to the predicted velocities the part of the impulses that the trapezoidal rule of the
        changes of their accelerations at the step's end does not have; returns these changes [3 Z].
        """
        part = np.array([np.ones(Z), np.ones(Z), 1.0 / (y[BALL_R] + self.way[1])])  # along the orbit angles
        places, rates = (BALL_X, BALL_R, BALL_THETA), (BALL_V_X, BALL_V_R, BALL_OMEGA_M)
        for blocks, changes in ((places, self.way), (rates, self.speed - 0.5 * h * self.push)):
            for block, more in zip(blocks, part * changes, strict=True):
                y[block] += more
        return (part * self.push).ravel()

    def push_bodies(self):
        """Accelerations of the modes [2, n] and of the halves [6, 2] by the changes of the loads; sets those of the balls."""
        change, force, self.push = self.still, np.zeros((6, 2)), np.zeros((3, Z))
        for load in self.loads:
            change = change + load.more / self.m * load.shape
            force[:, load.half] += load.more * load.along
            self.push[:, load.ball] -= load.more / self.m_ball * load.normal
        return change, force / self.inertia[:, None]

    def follow(self, t, sub, q, moved):
        """Accelerations of the modes [2, n] and of the halves [6, 2] at the time t of the step, the end of a substep of the length sub, at the
        coordinates q and motions of the halves [6, 2] by the fast accelerations and by these; sets those of the balls.
        """
        for load in self.loads:
            moves = load.rate * t + load.acceleration * t * (0.5 * t - self.middle)
            moves = moves - (np.sum(load.shape * q) - load.start)
            moves = moves + load.normal @ self.way[:, load.ball] - load.along @ moved[:, load.half]
            load.elastic = self.at(load, load.x + moves)
            mean = (moves - load.moved) / sub
            speed = mean + (1.0 if self.first else 0.5) * (mean - load.speed)
            own, c = 0.5 * sub * load.mobility, self.damping * load.elastic
            Q = (load.elastic + c * (speed + own * (load.Q + load.more))) / (1.0 + c * own)
            load.moved, load.speed, load.more = moves, mean, max(Q, 0.0) - load.Q
        self.first = False
        return self.push_bodies()

    def end(self, q_dot, moving):
        """As follow, at the velocities at the end of the step: of the modes, and those of the halves beside the slow motion."""
        for load in self.loads:
            speed = load.rate + load.acceleration * self.middle - np.sum(load.shape * q_dot)
            speed = speed + load.normal @ self.speed[:, load.ball] - load.along @ moving[:, load.half]
            load.more = load.elastic * max(1.0 + self.damping * speed, 0.0) - load.Q
        return self.push_bodies()
