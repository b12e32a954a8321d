"""Substeps of elastic halves and their joints between two evaluations of the right-hand side: the readable twin of
cage_substeps.c, which has the equations.

    v_m = (v + d/2 (a_f + a_s))/(1 + d c/2),  q += d v_m,  v = v_m (1 - d c/2) + d/2 (a_f + a_s)

a_f: fast accelerations, by the joints and the modes' own springs; a_s: slow ones, held over the step but for the loads
of balls on walls, which follow the walls and move modes, halves and balls.
Coordinates here are those of the modes, S and D side by side [2, n], and relative rigid motions of the halves [6]: x,
about y, about z, y, z, spin.
"""

from dataclasses import dataclass
from types import SimpleNamespace

import numpy as np

from bearing_model.cage.common.cage_joint import (
    STATES,
    JointStep,
    cage_joint_follow,
    cage_joint_shear,
    cage_joint_slide,
)
from bearing_model.cage.elastic.cage_elastic import (
    cage_elastic_loads,
    cage_elastic_preload,
    cage_elastic_pull,
    cage_elastic_stiffness,
)
from bearing_model.cage.elastic.elastic_half import circle, joints_in, joints_out
from bearing_model.cage.elastic.wall_loads import TOUCH, WallLoads
from bearing_model.generated.variables import (
    CAGE_BETA,
    CAGE_BETA_DOT,
    CAGE_GAMMA,
    CAGE_GAMMA_DOT,
    CAGE_PSI,
    CAGE_S,
    CAGE_V_X,
    CAGE_V_Y,
    CAGE_V_Z,
    CAGE_X,
    CAGE_Y,
    CAGE_Z,
    MODE_D,
    MODE_D_DOT,
    MODE_S,
    MODE_S_DOT,
    WORK,
    Z,
)

CAGE_RATES = CAGE_V_X, CAGE_V_Y, CAGE_V_Z, CAGE_BETA_DOT, CAGE_GAMMA_DOT, CAGE_S
CAGE_PLACES = CAGE_X, CAGE_Y, CAGE_Z, CAGE_BETA, CAGE_GAMMA, CAGE_PSI
MOST_SUBSTEPS, ROUNDING = 1000, 1e-9


@dataclass
class FastState:
    """Where the substeps of the next step begin: joints and fast accelerations at an evaluation."""

    e: np.ndarray  # motions of the joints out of the plane [3, Z]
    u: np.ndarray  # their offsets in it [2, Z]
    touch: list  # contacts of each half with its walls: rows of wall_loads.TOUCH [9, Z]
    modes: np.ndarray  # accelerations by joints and springs [2, n]
    rigid: np.ndarray  # accelerations of the relative motions at the joints [6]


def relative_inertia(model):
    """Inverse inertia of the relative motions at the joints [6]; part of y and z that the centres of mass take; common
    tilt by unit of y or z.
    """
    d, m = model.d, 2.0 / model.p.cage.m
    across = m + 2.0 * d.com_x[1] ** 2 / d.J_t
    return np.array([m, 2.0 / d.J_t, 2.0 / d.J_t, across, across, 2.0 / d.J_p]), m / across, d.com_x[1] / d.J_t / across


def about_masses(model, relative, sign):
    """Relative motions [6] of the geometric centres as those of the centres of mass, which the unbalance puts e along b_y from them; sign
    -1: the other way round.
    """
    e, (x, about_y, about_z, y, z, spin) = sign * model.d.com_e, relative
    return np.array([x - e * about_z, about_y, about_z, y, z + e * spin, spin])


def to_halves(model, h0, relative):
    """Motions of both halves by relative motions at the joints [6]: x, y, z, beta, gamma, s [6, 2]."""
    _, part, tilt = relative_inertia(model)
    relative = about_masses(model, relative, 1.0)
    axes = np.array([h0.b_y[1:, 0], h0.b_z[1:, 0]])  # rows: b_y, b_z
    change = np.concatenate([relative[:1], part * relative[3:5] @ axes, relative[1:3] @ axes, relative[5:]])
    rows = change[:, None] * np.array([-0.5, 0.5])
    rows[3:5] += (tilt * np.array([relative[4], -relative[3]]) @ axes)[:, None]
    return rows


def between_halves(model, h0, rows):
    """The relative motions at the joints [6] by such rows [6, 2]."""
    axes, c_x = np.array([h0.b_y[1:, 0], h0.b_z[1:, 0]]), model.d.com_x[1]
    d, common = rows[:, 1] - rows[:, 0], axes @ rows[3:5].sum(axis=1)
    found = np.concatenate([d[:1], axes @ d[3:5], axes @ d[1:3] + c_x * np.array([-common[1], common[0]]), d[5:]])
    return about_masses(model, found, -1.0)


def halves(y, blocks):
    """Rows of both halves [6, 2] of a state."""
    return np.array([y[block] for block in blocks])


def fast_accelerations(model, q, load, shear):
    """Accelerations of modes [2, n] and relative motions [6] at coordinates q [2, n], under loads of the joints out of
    the plane [3, Z] and in it [2, Z].
    """
    half, p, d, (_, c, s), (N, M_r, M_t) = model.modes, model.p, model.d, circle(model.d), load
    force = [
        -N,
        s * M_t - c * M_r - d.rivet_z * N,
        d.rivet_y * N - s * M_r - c * M_t,
        shear[0],
        shear[1],
        d.rivet_y * shear[1] - d.rivet_z * shear[0],
    ]
    modes = np.array(cage_elastic_pull(model, load, shear)) / p.cage.m - half.omega**2 * q
    total = np.sum(force, axis=1)
    total[2] += d.com_e * total[0]  # about the centres of mass
    total[5] -= d.com_e * total[4]
    return modes, about_masses(model, relative_inertia(model)[0] * total, -1.0)


def cage_substeps_split(model, y, w, f):
    """Takes the fast part from the rates f [states] of the state y, at which w was evaluated; returns it as FastState."""
    half, e, j = model.modes, w.cage.elastic, w.cage.elastic.joints
    q, v = (
        np.array([y[block][: half.n] for block in blocks]) for blocks in ((MODE_S, MODE_D), (MODE_S_DOT, MODE_D_DOT))
    )
    modes, rigid = fast_accelerations(model, q, j.load, j.F)
    for block, change in zip(CAGE_RATES, to_halves(model, w.half[0], rigid), strict=True):
        f[block] -= change
    for block, change in zip((MODE_S_DOT, MODE_D_DOT), modes - half.damping * v, strict=True):
        f[block][: half.n] -= change
    f[WORK] += e.dissipated
    touch = [np.array([getattr(e, f"touch_{name}")[h] for name in TOUCH]) for h in range(2)]
    return FastState(j.e.copy(), j.u.copy(), touch, modes, rigid)


def turn(t, others, rates):
    """Turns the relative tilt rates, of which `rates` is the part by the joints and `others` the rest, by the angle of their gyroscopic
    moment, tan of half of which is t: no power.  The joints' part gets the change.
    """
    y, z = rates[1:3] + others[1:3]
    rates[1:3] -= 2.0 * t / (1.0 + t * t) * np.array([t * y + z, t * z - y])


TURNING = np.array([[1, 2], [3, 4]])  # of the relative motions: pairs across the axis


def turn_out(phi, relative):
    """Accelerations [6] in the frame of the joints, which turn with half 0, in the frame that is phi behind."""
    turned = relative.copy()
    for y, z in TURNING:
        turned[y], turned[z] = relative[y] - phi * relative[z], relative[z] + phi * relative[y]
    return turned


def to_joint_frame(spin, t, middle, slow, moved, relative):
    """Velocities [6] in the frame of the middle as the joints see them at the time t after it: both these and the way
    since the middle turn back.
    """
    back, turned = moved + t * (2.0 * middle + relative + 0.5 * t * slow), relative.copy()
    for y, z in TURNING:
        turned[y] += spin * back[z]
        turned[z] -= spin * back[y]
    return turned


def cage_substeps_advance(model, h, memory, f, state, y, films, pockets, w):
    """Substeps of a step of length h from `memory` (CageMemory) under the slow rates f; state, w: state and kinematics in the middle of the
    step; films: RimFilmsStep; pockets: PocketFilmsStep; changes y as cage_substeps.c does.

    Returns the slow accelerations at the step's end as they foresee them (of the modes [2, n], changes of those of the halves
    [6, 2] and, by loads on walls, of those of the balls [3 Z]), and the JointStep.
    """
    half, d, h0, fast = model.modes, model.d, w.half[0], memory.fast
    steps = int(min(np.ceil(h / half.substep * (1.0 - ROUNDING)), MOST_SUBSTEPS))
    sub = h / steps
    q, v, slow_modes = (
        np.array([x[block][: half.n] for block in blocks])
        for x, blocks in ((y, (MODE_S, MODE_D)), (y, (MODE_S_DOT, MODE_D_DOT)), (f, (MODE_S_DOT, MODE_D_DOT)))
    )
    slow, speed, moved = between_halves(model, h0, halves(f, CAGE_RATES)), np.zeros(6), np.zeros(6)
    loads, held, modes = WallLoads(model, h, fast, f, state, y, q, w), slow_modes, fast.modes
    gyro = float(d.J_p / d.J_t * 0.5 * np.sum([half.s for half in w.half]))
    push, pushed, way = np.zeros((3, 6, 2))  # of the halves by changes of the loads on walls
    P, k_in = cage_elastic_preload(model, memory.omega_2), cage_elastic_stiffness(model)

    # the joints at the step's start; their velocities by modes and relative rigid motions, and those by the slow motion
    # of the rigid halves in the middle of the step
    u, joints, slip = fast.u, SimpleNamespace(e=fast.e), JointStep(None)
    w.cage.elastic = SimpleNamespace(joints=joints)
    _, c, s = circle(d)
    out, inside = joints_out(d, half.pad), joints_in(d, half.pad)  # rows: all joints, motion by motion
    Omega = w.half[1].Omega[:, 0] - h0.Omega[:, 0]
    about_y, about_z = h0.b_y[:, 0] @ Omega, h0.b_z[:, 0] @ Omega
    middle_out = np.array([w.v_j[0], about_y * c + about_z * s, about_z * c - about_y * s])
    middle_in, spin = w.v_j[1:], float(np.squeeze(h0.s))
    middle = np.array([0.0, about_y, about_z, *middle_in.mean(axis=-1), 0.0])
    rigid = turn_out(-0.5 * spin * h, fast.rigid)
    films.first(w, sub, f, v)

    turn(0.25 * gyro * sub, np.zeros(6), speed)
    for step in range(1, steps + 1):
        # first half of the accelerations, drift
        v = v + films.kick()
        v_m = (v + 0.5 * sub * (modes + held)) / (1.0 + 0.5 * sub * half.damping)
        q = q + sub * v_m
        v = v_m * (1.0 - 0.5 * sub * half.damping)
        speed = speed + 0.5 * sub * rigid
        halfway, moved, time = moved + 0.5 * sub * speed, moved + sub * speed, (step - 0.5) * sub - 0.5 * h
        pushed = pushed + 0.5 * sub * push
        way = way + sub * pushed
        loads.drift(sub)
        relative = between_halves(model, h0, pushed) + speed + time * slow
        relative = to_joint_frame(spin, time, middle, slow, halfway, relative)
        by_out = (out @ np.append(v_m[0], relative[:3])).reshape(Z, 3).T
        r, t = (inside @ np.append(v_m[1], relative[3:])).reshape(Z, 2).T
        joints.e = joints.e + 0.5 * sub * (middle_out + by_out)
        across = middle_in + np.array([c * r - s * t, s * r + c * t])
        u = u + sub * across
        slip.before = cage_joint_follow(sub, across, y)
        y[WORK] -= sub * model.p.cage.m * np.sum(half.damping * v_m**2)
        more, push = loads.follow(step * sub, sub, q, to_halves(model, h0, moved) + way)
        held = slow_modes + more

        # accelerations there, of which the second half
        cage_elastic_loads(model, P, joints)
        y[WORK] -= cage_joint_slide(model, k_in, joints.rivet[0], joints.N_plate, y, slip)
        modes, rigid = fast_accelerations(model, q, joints.load, cage_joint_shear(model, y, k_in, u))
        rigid = turn_out(spin * (step * sub - 0.5 * h), rigid)
        v = v + 0.5 * sub * (modes + held)
        speed = speed + 0.5 * sub * rigid
        pushed = pushed + 0.5 * sub * push
        loads.speed = loads.speed + 0.5 * sub * loads.push
        turn((0.5 if step < steps else 0.25) * gyro * sub, between_halves(model, h0, pushed), speed)
        v = v + films.follow(step * sub, v, to_halves(model, h0, speed) + pushed)
        by_films = pockets.follow(step * sub, sub, v, to_halves(model, h0, speed) + pushed)
        v, pushed = v + by_films[0], pushed + by_films[1]
    if loads.loads:  # as the evaluation has them, at the predicted velocities
        more, push = loads.end(v, to_halves(model, h0, speed) + pushed)
        held = slow_modes + more
    more, by_films = pockets.accelerations(half.n)
    held, push = held + more, push + by_films
    slip.before = np.array([y[row] for row in STATES])
    for blocks, change, more in ((CAGE_PLACES, moved, way), (CAGE_RATES, speed, pushed)):
        for block, rows in zip(blocks, to_halves(model, h0, change) + more, strict=True):
            y[block] += rows
    for blocks, x in (((MODE_S, MODE_D), q), ((MODE_S_DOT, MODE_D_DOT), v)):
        for block, values in zip(blocks, x, strict=True):
            y[block][: half.n] = values
    slip.way = u - fast.u
    rates = speed + between_halves(model, h0, pushed)
    by_gyro = to_halves(model, h0, gyro * np.array([0.0, -rates[2], rates[1], 0.0, 0.0, 0.0]))
    return held, push + by_gyro, loads.arrive(h, y), slip


def add_rates(model, change, y):
    """Adds to the rates of the modes, S and D [2, n]."""
    for block, more in zip((MODE_S_DOT, MODE_D_DOT), change, strict=True):
        y[block][: model.modes.n] += more
