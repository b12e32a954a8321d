"""Loads of balls on the walls of elastic halves within a step: the readable twin of wall_loads.c, which has the equations.

    x(t) = x_0 + r t + b t (t - h)/2 - u(t) - g.d(t),  delta + c Q_0 = x,  Q_0 = K delta^1.5
    Q = Q_0 (1 + lambda (x_dot - Y d/2 (Q - Q_before)))

r, b: rate in the middle of the step and acceleration of the rigid approach by slow forces; u, g.d: motion of the wall by
the modes and by the motions d of the halves and of the ball, which joints and the changes of these loads cause; x_dot: half a
substep d ahead by the accelerations before; Y: mobility of the contact.
"""

from dataclasses import dataclass

import numpy as np

from bearing_model.cage.common.rigid_approach import rigid_approach
from bearing_model.cage.elastic.elastic_half import ROOT
from bearing_model.cage.elastic.elastic_wall import elastic_wall_shape, ribbon_wall_shapes
from bearing_model.generated.variables import BALL_OMEGA_M, BALL_R, BALL_THETA, BALL_V_R, BALL_V_X, BALL_X, Z

# Contacts of each half with its walls as an evaluation leaves them, in the rows of FastState.touch: direction (x, t), of a ribbon also
# r, Hertz's constant, approach, load; of a ribbon place chi, radius and front (ribbon_wall_shapes)
TOUCH = "x", "r", "t", "K", "delta", "Q", "chi", "radius", "front"


@dataclass
class WallLoad:
    """A ball on a wall, or before it: law, approach and load at the step's start, rigid approach, motion of the wall; the load without damping
    and its change since the start.
    """

    half: int
    ball: int
    K: float
    x: float
    Q: float
    rate: float
    acceleration: float
    shape: np.ndarray  # motion along the normal by S and D [2, n]
    start: float  # motion of the wall at the step's start
    along: np.ndarray  # motion along the normal by those of the half: x, y, z, beta, gamma, spin [6]
    normal: np.ndarray  # along x, r, t of the ball [3]
    mobility: float  # of wall, half and ball along the normal, tilts left out [1/kg]
    elastic: float = 0.0
    more: float = 0.0


class WallLoads:
    """The loads on walls of a step of length h [s]; motions of the balls by their changes along x, r, t [3, Z]: accelerations,
    velocities, ways.
    """

    def __init__(self, model, h, fast, f, state, y, q, w):
        self.m, self.c, self.middle, self.loads = model.p.cage.m, model.modes.compliance, 0.5 * h, []
        self.m_ball, self.damping = model.d.m, model.p.cage.lambda_
        self.push, self.speed, self.way = np.zeros((3, 3, Z))
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
                Q_0 = K * max(delta, 0.0) ** 1.5
                if not Q_0 > 0.0 and not delta + h * rate > 0.0:
                    continue
                x = delta + self.c * Q_0
                shift = sum(row[k] for row in along) / ROOT
                both = np.array([shift, (2 * i - 1) * shift])
                mobility = 1.0 / self.m_ball + 1.0 / self.m + 2.0 / self.m * np.sum(shift**2)
                start = np.sum(both * q)
                self.loads.append(
                    WallLoad(i, k, K, x, Q, rate, acceleration, both, start, along_half, normal, mobility)
                )

    def at(self, load, x):
        """K delta^1.5 of the approach x."""
        if not x > 0.0:
            return 0.0
        cK = self.c * load.K
        delta = x / (1.0 + cK * np.sqrt(x))
        for _ in range(2):
            delta = max(delta - (delta + cK * delta**1.5 - x) / (1.0 + 1.5 * cK * np.sqrt(delta)), 0.0)
        return load.K * delta**1.5

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

    def place(self, t, q, moved):
        """Sets the loads without damping at the time t of the step, at the coordinates q [2, n] and motions of the halves [6, 2] by the fast
        accelerations and by changes of these loads.
        """
        for load in self.loads:
            x = load.x + load.rate * t + load.acceleration * t * (0.5 * t - self.middle)
            x = x - (np.sum(load.shape * q) - load.start)
            x = x + load.normal @ self.way[:, load.ball] - load.along @ moved[:, load.half]
            load.elastic = self.at(load, x)

    def accelerations(self, t, ahead, q_dot, moving):
        """Of the modes [2, n] and of the halves [6, 2] by the changes of the loads, damped at the rates q_dot and `moving` of place's q and
        `moved`; sets those of the balls.  ahead: time by which the rates are ahead of the velocities.
        """
        change, force, push = np.zeros_like(q_dot), np.zeros_like(moving), np.zeros((3, Z))
        balls = self.speed + ahead * self.push
        for load in self.loads:
            x_dot = load.rate + load.acceleration * (t - self.middle) - np.sum(load.shape * q_dot)
            x_dot = x_dot + load.normal @ balls[:, load.ball] - load.along @ moving[:, load.half]
            own, c = ahead * load.mobility, self.damping * load.elastic
            Q = (load.elastic + c * (x_dot + own * (load.Q + load.more))) / (1.0 + c * own)
            load.more = more = max(Q, 0.0) - load.Q
            change = change + more / self.m * load.shape
            force[:, load.half] += more * load.along
            push[:, load.ball] -= more / self.m_ball * load.normal
        self.push = push
        return change, force / self.inertia[:, None]
