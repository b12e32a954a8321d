"""Both halves of a cage under impacts in their pockets by all finite elements, nothing left out: what modes are held
against.

At each complex frequency s one pitch with the stiffness (1 + b s) K + s^2 M is condensed to its loads and its cuts, the
waves of the ring follow from them, and the pads are held: transfer functions from the pockets to the joints, as
rivet_model/impacts.py has them from modes.
"""

from functools import cached_property
from itertools import pairwise

import numpy as np
from mechanics import Instance, view
from scipy.linalg import expm
from scipy.sparse.linalg import splu

from bearing_model.cage.common.joint_law import joint_law, relief
from bearing_model.cage.elastic import half_modes as modes_of
from bearing_model.cage.two_half.joint_open import joints_open
from bearing_model.generated import variables
from rivet_model import half_loads, half_modes, half_shape
from rivet_model.cage_half import BODY, SYMMETRIC
from rivet_model.impacts import (
    ANGLES,
    DAMPING,
    SAMPLES,
    TIME,
    S,
    Transfer,
    at_angles,
    mass_motions,
)


class FullHalf:
    """Condensed half whose waves answer at any complex frequency."""

    def __init__(self, g, size):
        self.elastic = half_loads.elastic_half(g, size, np.stack([ANGLES, np.full(len(ANGLES), g.d_m / 2)], axis=1))
        self.alone, e = half_loads.JointAlone(self.elastic), self.elastic
        self.massive = half_modes.MassiveHalf(e)
        p, n, first = e.patterns, len(e.points), len(e.points) - len(ANGLES)
        normal = np.stack([np.sin(ANGLES), 0.0 * ANGLES, np.cos(ANGLES)], axis=1)
        near = p.pocket.start + 3 * (first + np.arange(len(ANGLES)))[:, None] + np.arange(3)
        wall = [np.einsum("daf,af->da", e.loads[:, near + part], normal) for part in (0, 3 * n)]
        head = slice(p.head.start, p.head.start + 3)
        groups = (e.loads[:, p.pad], e.loads[:, p.plane], e.loads[:, head], *wall)
        self.columns = np.column_stack(groups)
        ends = np.cumsum([0] + [group.shape[1] for group in groups])
        self.pad, self.plane, self.head, self.near, self.far = (slice(a, b) for a, b in pairwise(ends))
        self.edge = np.concatenate([e.near, e.far])
        self.inside = np.setdiff1d(np.arange(e.basis.N), self.edge)

    @cached_property
    def parts(self):
        """Stiffness and mass [inside and edge]: II, IB, BB; loads of inside and edge."""
        order = np.concatenate([self.inside, self.edge])
        n = len(self.inside)
        both = [A[order][:, order].tocsc() for A in (self.elastic.K, self.massive.M)]
        return (
            [(A[:n, :n].tocsc(), A[:n, n:].toarray(), A[n:, n:].toarray()) for A in both],
            self.columns[self.inside],
            self.columns[self.edge],
        )

    def waves(self, s, damping=DAMPING):
        """Flexibility [waves 0...Z-1, columns, columns] at the frequency s; the far parts of the wall count with the
        near ones.
        """
        e, ((K, M), F_I, F_B) = self.elastic, self.parts
        II, IB, BB = ((1.0 + damping * s) * k + s * s * m for k, m in zip(K, M, strict=True))
        X = splu(II.tocsc(), **SYMMETRIC).solve(np.column_stack([F_I.astype(complex), IB]))
        X_F, X_B = X[:, : F_I.shape[1]], X[:, F_I.shape[1] :]
        A_FF, A_FB, stiff = F_I.T @ X_F, F_B.T - F_I.T @ X_B, BB - IB.T @ X_B
        n, angle = len(e.near), 2.0 * np.pi / e.Z
        turn = np.kron(
            np.eye(n // 3), np.array([[1, 0, 0], [0, np.cos(angle), -np.sin(angle)], [0, np.sin(angle), np.cos(angle)]])
        )
        result = np.zeros((e.Z, self.near.stop, self.near.stop), dtype=complex)
        for m in range(e.Z // 2 + 1):
            T = np.vstack([np.eye(n), np.exp(1j * m * angle) * turn])
            H = A_FF + A_FB @ T @ np.linalg.solve(T.conj().T @ stiff @ T, T.conj().T @ A_FB.T)
            gather = np.eye(H.shape[0], self.near.stop, dtype=complex)
            # they stand one pitch back
            gather[self.far, self.near] = np.exp(2j * np.pi * m / e.Z) * np.eye(len(ANGLES))
            result[m] = gather.conj().T @ H @ gather
            result[-m] = result[m].T
        return result

    def bonded(self, s):
        """One frequency of Transfer: (pocket [Z, 8, ANGLES], pad [Z, 3, 3])."""
        a = self.alone
        C = self.waves(s)
        pocket, pads = np.zeros((len(C), 8, len(ANGLES)), dtype=complex), np.zeros((len(C), 3, 3), dtype=complex)
        gain = np.linalg.inv(a.clamped)
        for m, H in enumerate(C):
            pressure = np.linalg.solve(H[self.pad, self.pad], np.column_stack([H[self.pad, self.near], a.lever]))
            held, pads[m] = pressure[:, : len(ANGLES)], a.lever.T @ pressure[:, len(ANGLES) :]
            M = a.lever.T @ held
            head = H[self.head, self.near] - H[self.head, self.pad] @ held
            shift = head - a.follows @ np.linalg.solve(a.K_0, M)
            V = np.linalg.solve(H[self.plane, self.plane], H[self.plane, self.near])
            pocket[m] = np.concatenate([M[:1], V, M[1:], shift[:1] / a.shortening, (gain @ shift)[1:]])
        return np.fft.ifft(pocket, axis=0), np.fft.ifft(pads, axis=0)

    def transfer(self, at_s=S):
        """Transfer by full finite elements at the frequencies at_s [1/s]: 2 s of one core each."""
        found = [self.bonded(s) for s in at_s]
        return Transfer(*(np.stack(part) for part in zip(*found, strict=True)))

    def inertia(self):
        """half_shape.Inertia of the elements with the rivets' masses at their seats, and the radius at which the pads'
        friction acts along t [m].
        """
        e, m = self.elastic, self.massive
        pitch = m.density * e.resultants[:BODY] + m.rivet * e.resultants[m.seat].T @ e.resultants[m.seat]
        total = np.zeros((BODY, BODY))
        for k in range(e.Z):
            c, s = np.cos(2 * np.pi * k / e.Z), np.sin(2 * np.pi * k / e.Z)
            turn = np.kron(np.eye(2), np.array([[1.0, 0.0, 0.0], [0.0, c, -s], [0.0, s, c]]))
            total += turn @ pitch @ turn.T
        mass, x_c = total[0, 0], total[1, 5] / total[0, 0]
        return half_shape.Inertia(mass, x_c, total[3, 3], total[4, 4] - mass * x_c**2), float(
            e.resultants[e.patterns.plane][1, 3]
        )


# Impacts of a run -----------------------------------------------------------------------------------------------------


def on_angles(angle):
    """Weights [ANGLES] of the two angles around one, as linear interpolation has them."""
    return np.array([np.interp(angle, ANGLES, row) for row in np.eye(len(ANGLES))])


def recorded(core, parameters, inputs, count, settle=0.05, apart=3e-3):
    """What the balls of a run with elastic halves do to the pockets: `count` windows of forces [half, Z, ANGLES,
    SAMPLES] over TIME, 3 ms apart.

    The forces begin within 30 us, because a window may open in the middle of an impact.  Windows without a force above
    15 N are passed over.
    """
    parameters = parameters | {"scene.cage": variables.CageModel.ELASTIC}
    bearing, model = Instance(core, parameters, inputs).step(settle), core.model(parameters, inputs)
    begin, windows = np.clip(TIME / 30e-6, 0.0, 1.0), []
    while len(windows) < count:
        t, force = bearing.time, np.zeros((2, variables.Z, len(ANGLES), SAMPLES))
        for i in range(SAMPLES):
            bearing.step(t + (i + 1) * TIME[1])
            model.rhs(bearing.time, bearing.y)
            for h, pockets in enumerate(model.work.pocket):
                push_x, push_t = view(core, pockets.push_x)[: variables.Z], view(core, pockets.push_t)[: variables.Z]
                for j in np.flatnonzero(view(core, pockets.Q)[: variables.Z]):  # the push of others is their last one
                    force[h, j, :, i] = np.hypot(push_x[j], push_t[j]) * on_angles(
                        np.arctan2(abs(push_x[j]), push_t[j])
                    )
        if force.sum(axis=2).max() > 15.0:
            windows.append(force * begin**2 * (3.0 - 2.0 * begin))
        bearing.step(bearing.time + apart)
    return windows


# Joints that open -----------------------------------------------------------------------------------------------------


def first_order_hold(omega, h):
    """Exact step of q'' + DAMPING omega^2 q' + omega^2 q = f for f linear in time: (q, v) by (q, v) [2, 2, n], and by f
    before and after it [2, 2, n].
    """
    A = np.zeros((len(omega), 4, 4))  # of q, v, f, h f'
    A[:, 0, 1] = A[:, 1, 2] = h
    A[:, 1, 0], A[:, 1, 1], A[:, 2, 3] = -h * omega**2, -h * DAMPING * omega**2, 1.0
    E = np.moveaxis(expm(A), 0, -1)
    return E[:2, :2], np.stack([E[:2, 2] - E[:2, 3], E[:2, 3]], axis=1)


def opened(g, inertia, modes, force, law, P, spin, lever):
    """Loads (N, M_r, M_t) of joints and (T, m_r, m_t) of rivets, each [Z, 3, SAMPLES], over time, of mirrored halves
    whose joints open by `law`.

    force [half, Z, ANGLES, SAMPLES]; spin: (M_t, dP) of bonded joints under the centrifugal load; P: preload without it
    [N], or None: bonded. Modes go exactly from step to step, what damps the residual by the implicit Euler method; in
    each step, Newton's iteration finds moves = law(L + K_0 moves) of all joints at once.
    """
    Z, h, omega = g.Z, TIME[1], np.concatenate([modes_of.frequencies(modes), np.zeros(6)])
    pads, at = mass_motions(g, inertia, lever)[0], modes_of.rivet_shapes(modes)
    A = np.concatenate([at[:, :, :6], np.moveaxis(pads, 2, 0)])[:, :, [0, 4, 5]].reshape(len(omega), -1)
    free, forced = first_order_hold(omega, h)
    relative = (np.arange(Z)[:, None] - np.arange(Z)) % Z
    R = modes.residual.pad[relative][..., [0, 4, 5], :][..., [0, 4, 5]].transpose(0, 2, 1, 3).reshape(3 * Z, -1)
    lag = DAMPING / h / (1.0 + DAMPING / h)  # d + DAMPING d' = R L for the residual's move d
    K, K_0, angle = (
        np.linalg.inv((1.0 - lag) * R + A.T @ (forced[0, 1][:, None] * A)),
        law.stiffness[0],
        np.tile([1.0, 1.0 / law.length, 1.0 / law.length], Z),
    )
    mirrored = 0.5 * (force[0] + force[1])
    modal, shift = np.zeros((len(omega), SAMPLES)), np.zeros((Z * 3, SAMPLES))
    for j in range(Z):
        wall, rows = at_angles(modes, j)
        rigid = mass_motions(g, inertia, lever, j)[1]
        modal += np.concatenate([wall, rigid.T]) @ mirrored[j]
        shift += rows[:, [0, 4, 5]].reshape(3 * Z, -1) @ mirrored[j]
    rest, preload = np.zeros((Z, 3)), np.full(Z, 0.0 if P is None else P + spin[1])
    rest[:, 2] = spin[0]
    moves_0 = np.zeros((Z, 3)) if P is None else joints_open(law, rest, preload, spin[0], P + spin[1], sweeps=400)[2]
    alone_0 = rest - relief(law.others, moves_0)
    q, v, before = np.zeros(len(omega)), np.zeros(len(omega)), np.zeros(len(omega))
    delta, lagging, loads, rivets = (
        np.zeros(3 * Z),
        np.zeros(3 * Z),
        np.zeros((Z, 3, SAMPLES)),
        np.zeros((Z, 3, SAMPLES)),
    )

    def tried(delta, at_pads):
        """Load that a joint would carry alone, its moves by the law, the rivet's loads, what is wrong with the moves,
        and how much load that is [N].
        """
        alone = alone_0 + (K @ (at_pads - delta)).reshape(Z, 3) + delta.reshape(Z, 3) @ K_0.T
        moves, rivet = joint_law(law, alone, preload)
        wrong = delta - (moves - moves_0).ravel()
        return alone, moves, rivet, wrong, np.abs(K @ wrong * angle).max()

    def newton(delta, at_pads, time):
        """Moves [3 Z] and loads of the rivets [Z, 3]: Newton's iteration with halved steps where a joint closes or
        opens.
        """
        now = tried(delta, at_pads)
        for _ in range(60):
            alone, moves, rivet, wrong, size = now
            if size < 1e-3:
                return delta, rivet
            D = np.zeros((3 * Z, 3 * Z))
            for i in range(3):
                changed = joint_law(law, alone + 1e-3 / angle[i] * np.eye(3)[i], preload)[0] - moves
                D[np.arange(3 * Z), np.repeat(3 * np.arange(Z) + i, 3)] = changed.ravel() * 1e3 * angle[i]
            step = np.linalg.solve(np.eye(3 * Z) + D @ (K - np.kron(np.eye(Z), K_0)), wrong)
            for share in 0.5 ** np.arange(6):
                now = tried(delta - share * step, at_pads)
                if now[4] < size:
                    break
            delta = delta - share * step
        if now[4] < 0.05:
            return delta, now[2]
        raise ArithmeticError(f"joints at {time:g} s: no moves found, {now[4]:g} N are left")

    for step in range(SAMPLES):
        q_free = free[0, 0] * q + free[0, 1] * v + forced[0, 0] * before + forced[0, 1] * modal[:, step]
        at_pads = A.T @ q_free + (1.0 - lag) * shift[:, step] - lag * lagging
        if P is not None:
            delta, rivets[..., step] = newton(delta, at_pads, TIME[step])
        change = K @ (at_pads - delta)
        after = modal[:, step] - A @ change
        q_new = q_free - forced[0, 1] * (A @ change)
        v = free[1, 0] * q + free[1, 1] * v + forced[1, 0] * before + forced[1, 1] * after
        q, before, lagging = q_new, after, A.T @ q_new - delta
        loads[..., step] = change.reshape(Z, 3) + (rest - relief(law.stiffness, moves_0) if P is not None else 0.0)
    return loads, rivets
