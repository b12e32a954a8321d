"""Coulomb friction in the closed joint, offline: slip of the halves over the transverse load, and the shares of plates
and heads.

python -m rivet_model.friction [GEOMETRY.toml]

Heads and plates stick or slip; the bores do not touch.  At each contact point, with the normal force p and the
tangential slip s of a load step:

    gap >= 0, p >= 0, p gap = 0        |t| <= mu p, t = -mu p s/|s| where it slips

solved for each step by Newton's method on both conditions written with projections (Alart and Curnier 1991).  Load and
solution are symmetric about the plane of V, so half of the circle is enough.
"""

import argparse
import sys
from dataclasses import dataclass

import numpy as np

from .geometry import Geometry
from .load_cases import SPRINGS, Grid, Joint, hat_harmonics, surface_stress
from .section_mesh import Fineness, edge_nodes

GRID = Grid(Fineness(0.6), 11.25, 24, 16)
CONTACTS = ("UH", "LH", "PP")
PLANE = [0, 2, 4, 5, 7, 9]  # rigid motions x, z, rotation y of rivet and upper rim
ITERATIONS = 60
HALVINGS = 4  # of a load step
TOLERANCE = 1e-9  # of the preload
FREE = 1e-3  # m: larger than any elastic slip


@dataclass(frozen=True)
class Slip:
    """Solution for one transverse load V [N]: slip of the halves [m], friction of plates and of each head [N], head's
    largest principal stress [Pa].
    """

    V: float
    slip: float
    plates: float
    heads: float
    head_p1: float


class Friction:
    """Heads and plates of a joint condensed with all three components of their tractions."""

    def __init__(self, joint):
        self.joint, grid = joint, joint.grid
        self.angles = 2 * np.pi * np.arange(grid.uniform) / grid.uniform
        cos, sin = hat_harmonics(self.angles, grid.n_max)
        # amplitudes of cos (sin for t), and of the field turned by a quarter wave
        self.hats = {"n": (cos, sin), "r": (cos, sin), "t": (sin, -cos)}
        self.rings = {name: len(joint.rings[name]) for name in CONTACTS}
        self.slices, start = {}, 0
        for part in "nrt":
            for name in CONTACTS:
                self.slices[part, name] = slice(start, start + self.rings[name] * len(self.angles))
                start = self.slices[part, name].stop
        self.size = start
        self.weight = np.concatenate(
            [np.outer(joint.moments[name][0], cos[:, 0]).ravel() for _ in "nrt" for name in CONTACTS]
        )
        self._condense()
        self._fold()

    # Compliance: forces p on the heads and plates push apart, t drags the first body along and the second one back ----

    def _loads(self, body, surfaces):
        """Load columns of a body [dofs, rings], by (part, contact).  surfaces: contact -> (z, outward normal along z,
        sign of the traction).
        """
        columns = {}
        for name, (z, normal, sign) in surfaces.items():
            positions = self.joint.rings[name]
            nodes = edge_nodes(body.mesh, z=z, between=(positions[0], positions[-1]))
            for part, direction in (("n", (0.0, 0.0, -normal)), ("r", (sign, 0.0, 0.0)), ("t", (0.0, sign, 0.0))):
                columns[part, name] = body.traction_loads(nodes, positions, direction, 0)
        return columns

    def _condense(self):
        joint, t = self.joint, self.joint.geometry.flange_thickness
        upper = self._loads(joint.flange, {"UH": (t, 1.0, -1.0), "PP": (0.0, -1.0, 1.0)})
        # the mirrored flange, which feels the opposite friction of the plates
        lower = {("n", "LH"): upper["n", "UH"], ("n", "PP"): upper["n", "PP"]}
        lower |= {(part, "LH"): upper[part, "UH"] for part in "rt"} | {
            (part, "PP"): -upper[part, "PP"] for part in "rt"
        }
        self.rivet_loads = self._loads(joint.rivet, {"UH": (t, -1.0, 1.0), "LH": (-t, 1.0, 1.0)})
        self.C, self.stress = np.zeros((self.size, self.size)), []
        for n in range(joint.grid.n_max + 1):
            for body, columns in ((joint.rivet, self.rivet_loads), (joint.flange, upper), (joint.flange, lower)):
                u = body.solve(n, np.hstack(list(columns.values())))
                self._add(n, np.hstack(list(columns.values())).T @ u, columns)
                if columns is self.rivet_loads:
                    self.stress.append(joint.surface_response(joint.fillet, n, u))
        self.C /= np.outer(self.weight, self.weight)
        self.D = self._approach()

    def _add(self, n, S, columns):
        ends = np.cumsum([block.shape[1] for block in columns.values()])
        place = {key: slice(end - block.shape[1], end) for end, (key, block) in zip(ends, columns.items(), strict=True)}
        for first in columns:
            for second in columns:
                for a, b in zip(self.hats[first[0]], self.hats[second[0]], strict=True):
                    part = (
                        np.einsum("ij,k,l->ikjl", S[place[first], place[second]], a[:, n], b[:, n])
                        / self.joint.kappa[n]
                    )
                    self.C[self.slices[first], self.slices[second]] += part.reshape(part.shape[0] * part.shape[1], -1)

    def _approach(self):
        """Mean approach (n) and minus the mean slip (r, t) by the rigid motions: the matrix D of the balance D^T (p, t)
        = f [contacts, 6].
        """
        joint, t = self.joint, self.joint.geometry.flange_thickness
        D = np.zeros((self.size, 6))
        for name in CONTACTS:
            D[self.slices["n", name]] = joint.D[joint.slices[name]][:, PLANE]
            area = joint.moments[name][0]
            for part, amplitude in (("r", self.hats["r"][0][:, 1]), ("t", -self.hats["t"][0][:, 1])):
                along = -np.outer(area, amplitude).ravel()  # slip cos theta along r, -sin theta along theta
                rivet, rim, height = {"UH": (1.0, -1.0, t), "LH": (1.0, 0.0, -t), "PP": (0.0, 1.0, 0.0)}[name]
                motion = np.stack(
                    [rivet * along, 0 * along, rivet * height * along, rim * along, 0 * along, rim * height * along],
                    axis=1,
                )
                D[self.slices[part, name]] = motion / self.weight[self.slices[part, name], None]
        return D

    def _fold(self):
        """Symmetry about the plane of V: n and r are even in theta, t is odd."""
        half = len(self.angles) // 2
        even, odd = np.zeros((len(self.angles), half + 1)), np.zeros((len(self.angles), half + 1))
        for k in range(half + 1):
            even[[k, -k], k] = 1.0
            if 0 < k < half:
                odd[k, k], odd[-k, k] = 1.0, -1.0
        rings = sum(self.rings.values())
        E = np.zeros((self.size, 3 * rings * (half + 1)))
        for i, block in enumerate((even, even, odd)):
            for ring in range(rings):
                j = i * rings + ring
                E[j * len(self.angles) : (j + 1) * len(self.angles), j * (half + 1) : (j + 1) * (half + 1)] = block
        self.E, self.count = E, rings * (half + 1)
        self.orbit = np.abs(E).sum(axis=0)[: self.count]
        self.C_half, self.D_half = E.T @ self.C @ E, E.T @ self.D

    # Loading ----------------------------------------------------------------------------------------------------------

    def curve(self, P, loads, mu):
        """Slip of each transverse load [N] of an increasing list, from the preload P [N] on.

        Raises ArithmeticError beyond the friction's capacity, where the joint slips until a bore carries, and if a load
        step does not converge.
        """
        gaps = np.zeros(self.size)
        short = self.joint.overclosure(P, -90e-6)
        for name in ("UH", "LH"):
            gaps[self.slices["n", name]] = -0.5 * short
        self.gap_0 = self.E.T @ gaps
        x, slip = np.zeros(3 * self.count + 6), np.zeros(2 * self.count)
        x[: self.count] = P / self.count
        answers, before = [], 0.0
        for V in (0.0, *loads):
            # no friction (mu = 0) while the preload alone acts
            x, before = self._to(x, slip, before, V, mu if V > 0.0 else 0.0, P), V
            slip = self._displacement(x)[self.count :]
            if V > 0.0:
                answers.append(self._answer(x, V))
                if answers[-1].slip > FREE:
                    raise ArithmeticError(
                        f"V = {V:g} N: heads and plates hold {answers[-1].plates + answers[-1].heads:.4g} N, then they slip freely"
                    )
        return answers

    def _to(self, x, slip, before, V, mu, P, halvings=HALVINGS):
        """Solution at V from the one at the load `before`; a step that Newton's method does not find is taken in two
        halves.
        """
        try:
            return self._step(x, slip, np.array([0.0, 0.0, 0.0, V, 0.0, 0.0]), mu, P)
        except ArithmeticError:
            if halvings == 0:
                raise
        middle = 0.5 * (before + V)
        x = self._to(x, slip, before, middle, mu, P, halvings - 1)
        return self._to(x, self._displacement(x)[self.count :], middle, V, mu, P, halvings - 1)

    def _displacement(self, x):
        """Gaps, then slips, per point of the half circle."""
        return (self.C_half @ x[:-6] - self.D_half @ x[-6:] + self.gap_0) / np.maximum(np.tile(self.orbit, 3), 1.0)

    def _step(self, x, slip_before, f, mu, P):
        m, scale = self.count, np.tile(np.maximum(self.orbit, 1.0), 3)
        jacobian = np.hstack([self.C_half, -self.D_half]) / scale[:, None]
        rho = 1.0 / np.maximum(np.diag(jacobian)[: 3 * m], 1e-12 * np.max(np.diag(jacobian)))
        rho_t = np.minimum(rho[m : 2 * m], np.where(self.movable(), rho[2 * m :], np.inf))
        springs = np.tile(SPRINGS[[0, 2, 4]], 2)
        for _ in range(ITERATIONS):
            d = self._displacement(x)
            p, t = x[:m], x[m : 3 * m].reshape(2, m)
            y_n, y_t = p - rho[:m] * d[:m], t - rho_t * (d[m:] - slip_before).reshape(2, m)
            closed, limit, size = y_n > 0.0, mu * np.maximum(p, 0.0), np.maximum(np.hypot(*y_t), 1e-300)
            sticks = closed & (size <= limit)
            slides = closed & ~sticks
            way = y_t / size
            residual = np.concatenate([
                np.where(closed, rho[:m] * d[:m], p),
                np.where(sticks, rho_t * (d[m:] - slip_before).reshape(2, m), np.where(slides, t - limit * way, t)).ravel(),
                self.D_half.T @ x[: 3 * m] + springs * x[-6:] - f,
            ])  # fmt: skip
            if np.abs(residual).max() < TOLERANCE * P:
                return x
            J = np.zeros((3 * m + 6, 3 * m + 6))
            J[:m] = np.where(closed, rho[:m], 0.0)[:, None] * jacobian[:m]
            J[np.arange(m), np.arange(m)] += np.where(closed, 0.0, 1.0)
            share = np.where(slides, limit / size, 0.0)
            for i in range(2):
                rows = slice(m + i * m, 2 * m + i * m)
                J[rows] = np.where(sticks, rho_t, 0.0)[:, None] * jacobian[rows]
                J[np.arange(m) + m + i * m, np.arange(m) + m + i * m] += np.where(sticks, 0.0, 1.0)
                J[np.arange(m) + m + i * m, np.arange(m)] -= np.where(slides, mu * way[i], 0.0)
                for j in range(2):
                    turn = share * ((i == j) - way[i] * way[j])  # derivative of the direction of y_t = t - rho s
                    J[rows] += (turn * rho_t)[:, None] * jacobian[m + j * m : 2 * m + j * m]
                    J[np.arange(m) + m + i * m, np.arange(m) + m + j * m] -= turn
            J[3 * m :, : 3 * m] = self.D_half.T
            J[3 * m + np.arange(6), 3 * m + np.arange(6)] += springs
            frozen = 2 * m + np.flatnonzero(~self.movable())  # t on the plane of symmetry stays 0
            J[frozen], residual[frozen] = 0.0, 0.0
            J[frozen, frozen] = 1.0
            x = x - np.linalg.solve(J, residual)
        raise ArithmeticError(
            f"friction at V = {f[3]:g} N not found in {ITERATIONS} steps: residual {np.abs(residual).max():g} N"
        )

    def movable(self):
        """Whether a point of the half circle can slip along theta."""
        return self.orbit > 1.5

    def _answer(self, x, V):
        joint, forces = self.joint, self.E @ x[:-6]
        carried = {name: sum(self._drag(forces, part, name) for part in "rt") for name in CONTACTS}
        return Slip(V, float(x[-3]), carried["PP"], -carried["UH"], self._head_stress(forces, joint))

    def _drag(self, forces, part, name):
        """Force along V on the second body."""
        s = self.slices[part, name]
        along = self.hats["r"][0][:, 1] if part == "r" else -self.hats["t"][0][:, 1]
        return -(forces[s].reshape(-1, len(self.angles)) @ (along / self.hats["r"][0][:, 0])).sum()

    def _head_stress(self, forces, joint, count=72):
        phi, total = 2 * np.pi * np.arange(count) / count, 0.0
        traction = forces / self.weight
        for n, response in enumerate(self.stress):
            amplitude = [
                traction[self.slices[key]].reshape(-1, len(self.angles)) @ self.hats[key[0]][0][:, n] / joint.kappa[n]
                for key in self.rivet_loads
            ]
            field = response @ np.concatenate(amplitude)
            total = (
                total + field[:, :, None] * np.stack([np.cos(n * phi), np.cos(n * phi), np.sin(n * phi)])[:, None, :]
            )
        return surface_stress(*total)[0].max()


def main(arguments=None):
    """Print the slip curve of a geometry at P = 20 N, mu = 0.15; returns 0, or 2 with a message."""
    parser = argparse.ArgumentParser(prog="python -m rivet_model.friction", description=__doc__.partition("\n")[0])
    parser.add_argument("geometry", nargs="?")
    options = parser.parse_args(arguments)
    P, mu = 20.0, 0.15
    try:
        friction = Friction(Joint(Geometry.from_toml(options.geometry) if options.geometry else Geometry(), GRID))
    except (OSError, ValueError) as error:
        print(f"rivet friction: {error}", file=sys.stderr)
        return 2
    print("V [N]  slip [um]  plates [N]  heads [N]  head stress [MPa]")
    for a in friction.curve(P, np.arange(0.5, 5.8, 0.5), mu):
        print(f"{a.V:5.1f} {1e6 * a.slip:9.3f} {a.plates:10.2f} {a.heads:10.2f} {a.head_p1 / 1e6:10.1f}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
