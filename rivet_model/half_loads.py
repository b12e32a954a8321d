"""Loads of bonded joints by the elastic half: pocket forces over the wall's angle, centrifugal load; and the numbers
of the joint's law.

Rows of a joint's loads (on the +x half, frame (x, r, t) at the rivet):

    N, V_r, V_t, M_r, M_t   of the joint whose pads do not move: N, M of the supports that hold the pads along x, V of those in the plane
    dP, dm_r, dm_t          of its rivet: the seat's bottom gives under a load nearby, though the pad does not move; dP is the change of preload that
                            would shift the head as much, dm the bending moment of the shank

A force on one half is half a mirrored pair of forces, which gives N, M, dP, dm, and half an opposed pair, which gives
V.
"""

from dataclasses import replace

import numpy as np

from bearing_model.cage.common.joint_law import AXES, CARRIED, NUMBERS, JointLaw, LawOfModes, joint_law, law_load
from bearing_model.rivet.rivet_table import HalfData

from . import half_lands, half_shape, ribbon, splines
from .cage_half import BODY, SPIN, CageHalf
from .joint_contact import JointContact, rivet_compliance
from .lcp import Contact

CHI = np.deg2rad([0.0, 6.0, 12.0, 20.0, 30.0, 42.0, 56.0, 72.0, 90.0])
# equal steps: readers need no search
KNOTS = {"tau": np.linspace(0.0, 1.0, 11), "q": np.linspace(-1.0, 1.0, 11), "psi": np.linspace(-1.0, 1.0, 11)}
# Of the law behind the residual: pads that the modes leave stiff turn about their edges within a tenth of q, and all
# states of open joints lie there.
KNOTS_BEHIND = KNOTS | {"q": np.linspace(-1.0, 1.0, 41)}
LENGTH = 1.5e-3  # l of the law of the 6207's joint: about the distance of the pad's edge from the rivet
NEWTON = 60  # steps at most
RAY = 48  # intervals of Simpson's rule along a ray of loads


class JointAlone:
    """Contact of one pad with its rivet while all other pads are held: exact, from the condensed half."""

    def __init__(self, elastic, rivet=None):
        self.elastic, p = elastic, elastic.patterns
        self.n = p.pad.stop - p.pad.start
        r, t = elastic.pad_place
        self.lever = np.stack([np.ones(self.n), t, -r], axis=1)
        head = slice(p.head.start, p.head.start + 3)
        self.head = head
        stiffness, reactions, held = elastic.mirrored
        self.K_waves = self.lever.T @ stiffness @ self.lever
        own, to_head, clamped = (
            elastic.circulant(wave)[0] for wave in (stiffness, reactions[:, :, head], held[:, head, head])
        )
        B = np.linalg.inv(own)  # of the pad's hats alone
        B = 0.5 * (B + B.T)
        self.B_ph = B @ to_head  # hats by the head: the reaction of the held pad undoes it
        self.rivet = rivet or rivet_compliance(elastic.g)
        c_rivet = np.diag(np.array(self.rivet)[[0, 1, 1]])
        self.clamped = 0.5 * (clamped + clamped.T) + c_rivet  # of the head with its rivet, the pad held
        self.K_0 = self.lever.T @ own @ self.lever
        A = np.linalg.inv(self.clamped + self.B_ph.T @ own @ self.B_ph)
        self.A, self.pull, self.own = A, self.B_ph @ A, own
        C = B - self.pull @ self.B_ph.T
        self.contact = Contact(0.5 * (C + C.T), np.zeros((self.n, 1)), np.ones(1))
        # move of the head per move of the pad's surroundings, the pad held
        self.follows = np.eye(3) - self.B_ph.T @ own @ self.lever
        self.shortening = 1.0
        self.shortening = 1.0 / self.solve(np.zeros(3), 1.0)[1][0]

    def solve(self, load, P, active=None):
        """Move [3], rivet's loads (T, m_r, m_t), active set under L_0 = load and preload P."""
        a = np.linalg.solve(self.K_0, load)
        free_head = a + [self.shortening * P, 0.0, 0.0]
        solution = self.contact.solve(self.lever @ a - self.pull @ free_head, np.zeros(1), active)
        return *self._follow(load, free_head, solution.p), solution.active

    def _follow(self, load, free_head, p):
        rivet = self.A @ (self.B_ph.T @ p + free_head)
        carried = rivet - p @ self.lever
        return np.linalg.solve(self.K_0, load - carried), rivet

    def slope(self, active):
        """Moves [3, 3] by unit loads (columns) while the same points touch."""
        columns = []
        for load in np.eye(3):
            a = np.linalg.solve(self.K_0, load)
            p = self.contact.solve_active(active, self.lever @ a - self.pull @ a, np.zeros(1))[0]
            columns.append(self._follow(load, a, p)[0])
        return np.stack(columns, axis=1)

    def solve_at_modes(self, K, L_K, P, near=None):
        """Loads (N, M_r, M_t) of joint and rivet [6], and L_0, where L_K = L + K delta is given in place of L_0 = L + K_0
        delta, by Newton's method.

        near: L_0 of a similar case, and its active set.  Raises ArithmeticError if no solution is found.
        """
        length = law_length(self.elastic.g)
        more, unit = K - self.K_0, np.array([1.0, length, length])
        load, active = (L_K, None) if near is None else near
        small = 1e-9 * (P + np.sum(np.abs(L_K / unit)))

        def residual(load, active):
            move, rivet, active = self.solve(load, P, active)
            return load + more @ move - L_K, move, rivet, active

        rest, move, rivet, active = residual(load, active)
        for _ in range(NEWTON):
            size = np.sum(np.abs(rest / unit))
            if size <= small:
                return np.concatenate([L_K - K @ move, rivet]), (load, active)
            change = np.linalg.solve(np.eye(3) + more @ self.slope(active), -rest)
            part = 1.0
            while True:  # halved until the residual falls
                found = residual(load + part * change, active)
                if np.sum(np.abs(found[0] / unit)) < size or part < 1e-4:
                    break
                part *= 0.5
            load = load + part * change
            rest, move, rivet, active = found
        raise ArithmeticError(f"joint's law: no load L_0 gives L_K = {L_K} at P = {P}")

    def rivet_rows(self, waves, loads):
        """dP, dm_r, dm_t [waves, 3] for free motions of the heads with all pads held `waves` [waves, 3] and the bonded
        loads [waves, 3].
        """
        shift = waves - loads @ np.linalg.inv(self.K_0).T @ self.follows.T
        moment = np.linalg.solve(self.clamped, shift.T).T
        return np.concatenate([shift[:, :1] / self.shortening, moment[:, 1:]], axis=1)


def bonded_rows(elastic, alone, column):
    """Rows [Z, 8] of all joints under a unit of the patterns `column` [patterns] on both halves (mirrored) and against
    each other (opposed).
    """
    _, reactions, held = elastic.mirrored
    M = (reactions @ column) @ alone.lever  # [waves, 3]
    rivet = alone.rivet_rows((held @ column)[:, alone.head], M)
    V = elastic.opposed[1] @ column
    rows = np.concatenate([M[:, :1], V, M[:, 1:], rivet], axis=1)
    return elastic.circulant(rows)


def rigid_inertia(elastic):
    """Mass matrix [6, 6] per unit density of the whole half for its rigid motions about the centre of the circle in the
    split plane.
    """
    pitch = elastic.resultants[:BODY]
    I = np.zeros((6, 6))
    for k in range(elastic.Z):
        c, s = np.cos(2 * np.pi * k / elastic.Z), np.sin(2 * np.pi * k / elastic.Z)
        turn = np.kron(np.eye(2), np.array([[1.0, 0.0, 0.0], [0.0, c, -s], [0.0, s, c]]))
        I += turn @ pitch @ turn.T
    return I


def bolt_group(d_m, wrench, c, s):
    """Rigid share: N, V_y, V_z at each rivet [N] of the wrench (F_x, F_y, F_z, M_x, M_y, M_z) [N, N.m] on the +x half
    at the circle's centre.

    c, s: cosine and sine of the rivets' angles.  Rigid halves on a circle of equal elastic rivets, whose own bending
    stiffness is neglected.

    >>> bolt_group(2.0, [9.0, 0, 0, 0, 0, 0], np.ones(9), np.zeros(9))[0][0]
    np.float64(1.0)
    """
    c, s, Z, R = np.asarray(c), np.asarray(s), len(c), 0.5 * d_m
    shear = wrench[3] / (Z * R)
    N = wrench[0] / Z + 2.0 * (wrench[4] * s - wrench[5] * c) / (Z * R)
    return N, wrench[1] / Z - shear * s, wrench[2] / Z + shear * c


def rigid_rows(elastic, place):
    """N, V_r, V_t [3, Z, 3] of rigid halves per unit force (x, r, t) at a place (x, r, t) of pocket 0; inertia balances
    the part of the load along motions that joints leave free.
    """
    Z, I = elastic.Z, rigid_inertia(elastic)
    angle = 2 * np.pi * (np.arange(Z) + 0.5) / Z
    c, s = np.cos(angle), np.sin(angle)
    result = []
    for force in np.eye(3):
        load = np.concatenate([force, np.cross(place, force)])
        wrench = np.zeros(6)
        for held, free in (([0, 4, 5], [1, 2, 3]), ([1, 2, 3], [0, 4, 5])):
            wrench[held] = load[held] - I[np.ix_(held, free)] @ np.linalg.solve(I[np.ix_(free, free)], load[free])
        N, V_y, V_z = bolt_group(elastic.g.d_m, 0.5 * wrench, c, s)
        result.append(np.stack([N, c * V_y + s * V_z, c * V_z - s * V_y], axis=1))
    return np.stack(result)


def path_at(elastic, alone, point):
    """Rows [Z, 8, 3] by unit forces (x, r, t) at a point of the half: elastic less the rigid share (N and V)."""
    p, n = elastic.patterns, len(elastic.points)
    rigid = rigid_rows(elastic, elastic.point_places()[point])
    result = np.zeros((elastic.Z, 8, 3))
    for f in range(3):
        column = np.zeros(elastic.loads.shape[1])
        column[p.pocket.start + 3 * point + f] = column[p.pocket.start + 3 * (n + point) + f] = 0.5
        result[:, :, f] = bonded_rows(elastic, alone, column)
        result[:, :3, f] -= rigid[f]
    return result


def centrifugal(elastic):
    """Patterns [patterns] of each pitch per (rad/s)^2: its own body force, and that of half a rivet, which the head's
    friction gives to the seat's bottom.
    """
    column = np.zeros(elastic.loads.shape[1])
    column[SPIN] = elastic.g.rho_flange
    column[elastic.patterns.head.start + 3] = half_shape.rivet_mass(elastic.g) * 0.5 * elastic.g.d_m
    return column


def uniform_rows(elastic, alone, column):
    """Rows [8] of any joint if every pitch has the mirrored patterns `column`."""
    _, reactions, held = elastic.mirrored
    M = (reactions[:1] @ column).real @ alone.lever
    rivet = alone.rivet_rows((held[:1] @ column).real[:, alone.head], M)
    return np.concatenate([M[0, :1], [0.0, 0.0], M[0, 1:], rivet[0]])


def law_length(g):
    """l of the law of a geometry [m]."""
    return LENGTH * g.size


def law_coefficients(knots, width, length, answer):
    """Coefficients [tau, q, psi, width] of splines through answer(load, P, near) = (values, starting point for the
    next tau), per newton.
    """
    sites = [splines.sites(knots[name]) for name in AXES]
    values = np.zeros((*(len(s) for s in sites), width))
    for j, q in enumerate(sites[1]):
        for k, psi in enumerate(sites[2]):
            near = None
            for i, tau in enumerate(sites[0]):
                values[i, j, k], near = answer(*law_load(length, tau, q, psi), near)
    return splines.interpolate([knots[name] for name in AXES], values)


def make_law(elastic, alone):
    """The joint's law of the geometry, from contact solutions of one pad at the sites of KNOTS."""

    def answer(load, P, active):
        move, rivet, active = alone.solve(load, P, active)
        return np.concatenate([move, rivet]), active

    K = elastic.circulant(alone.K_waves)
    slip = 0.5 * elastic.circulant(elastic.opposed[0])
    length = law_length(elastic.g)
    return JointLaw(length, KNOTS, law_coefficients(KNOTS, len(NUMBERS), length, answer), K, slip)


def make_law_of_modes(alone, K):
    """LawOfModes of pads around which the half has the stiffness K [3, 3], from contact solutions at the sites of
    KNOTS_BEHIND.
    """

    def answer(load, P, near):
        return alone.solve_at_modes(K, load, P, near)

    length = law_length(alone.elastic.g)
    carried = law_coefficients(KNOTS_BEHIND, len(CARRIED), length, answer)
    return with_energy(LawOfModes(length, KNOTS_BEHIND, carried, None, K))


def with_energy(law):
    """LawOfModes with the coefficients of U(L_K) = integral of delta dL_K, from 0 along the ray of L_K, where delta = K^-1
    (L_K - L).
    """
    knots = [law.knots[name] for name in AXES]
    places = [splines.sites(k) for k in knots]
    grid = np.array(
        [[[np.append(*law_load(law.length, a, b, c)) for c in places[2]] for b in places[1]] for a in places[0]]
    )
    load, P = grid[..., :3], grid[..., 3]
    ray = np.linspace(0.0, 1.0, RAY + 1)
    simpson = np.tile([2.0, 4.0], RAY // 2 + 1)[: RAY + 1] / (3.0 * RAY)
    simpson[[0, -1]] /= 2.0
    # without the start of the ray, where no load moves a joint
    moves = (t * load - joint_law(law, t * load, P)[0] for t in ray[1:])
    R = np.linalg.inv(law.stiffness)
    U = sum(w * np.sum(move @ R.T * load, axis=-1) for w, move in zip(simpson[1:], moves, strict=True))
    return replace(law, energy=splines.interpolate(knots, U))


def pair_stiffness(contact, P=20.0):
    """Force per separation of the two halves' bodies, all joints alike [N/m for each joint]: closed (N = -P/4...P/4)
    and open (N = 3 P...4 P).

    contact: JointContact of joints that are all alike.  The body of a half is its mean over the mass.
    """
    elastic = contact.half
    column = np.zeros(elastic.loads.shape[1])
    column[0] = 1.0 / elastic.resultants[0, 0]  # a unit force on each pitch, spread like its mass

    def separation(N):
        load = contact.loads(column=N * column)[0], np.array([N])
        return 2.0 * contact.displacement(column, 0, load, contact.solve(P, load))

    return tuple(float((b - a) * P / (separation(b * P) - separation(a * P))) for a, b in ((-0.25, 0.25), (3.0, 4.0)))


def make_half(elastic, alone, progress=lambda done, total: None):
    """HalfData of a condensed half (elastic_half) with its pads (JointAlone); of a ribbon without land_bending.py's part."""
    law = make_law(elastic, alone)
    progress(1, 2)
    spin = uniform_rows(elastic, alone, centrifugal(elastic))
    law.sign = np.sign(spin[4])
    chi, radii = places(elastic.g)
    path = np.stack([path_at(elastic, alone, i) for i in range(len(nodes(elastic.g)))])
    k_closed, k_open = pair_stiffness(JointContact(elastic, alone.rivet, alike=True))
    progress(2, 2)
    return HalfData(
        **half_shape.half_inertia(elastic.g)._asdict(),
        chi=chi,
        radii=radii,
        path=path.reshape(*shape(elastic.g), *path.shape[1:]),
        spin=spin,
        land=half_lands.land_rows(elastic, alone, rigid_rows),
        growth=half_lands.growth(elastic, centrifugal(elastic)),
        law=law,
        k_closed=k_closed,
        k_open=k_open,
    )


def places(g):
    """Nodes of the tables on a pocket's wall: angles [rad], and radii [m], of a machined half none but d_m/2."""
    return ribbon.places(g) if g.shape == "ribbon" else (CHI, np.zeros(0))


def shape(g):
    """Shape of arrays over the nodes of `places`."""
    chi, radii = places(g)
    return (*([len(radii)] if len(radii) else []), len(chi))


def nodes(g):
    """The nodes of `places` as points of CageHalf [radii and angles, 2]."""
    chi, radii = places(g)
    radii = radii if len(radii) else np.array([g.d_m / 2])
    return np.stack([np.tile(chi, len(radii)), np.repeat(radii, len(chi))], axis=1)


def elastic_half(g, size=None, points=()):
    """CageHalf with the nodes of the wall as points, then further ones [n, 2]."""
    return CageHalf(g, size, np.concatenate([nodes(g), np.reshape(points, (-1, 2))]))
