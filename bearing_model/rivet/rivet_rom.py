"""Rivet stress from the reduced model: twin of fmu_src/rivet/rivet_rom.c, where the equations stand.

sigma = s (w S_i + (1 - w) S_(i+1))(a, c, xi), sheets i around chi, homogeneous of degree 1 in loads and fit; S: tensor
products of quadratic B-splines. Loads are arrays of one shape; `table` is a bearing_model.rivet.rivet_table.RivetTable
(read one with rivet_table.read).
"""

from dataclasses import dataclass

import numpy as np

from bearing_model.rivet.rivet_splines import cell_weights, constants

HEAD_P1, HEAD_VM, MID_VM, MID_P1 = range(4)
RIVET_YIELDS, FLANGE_YIELDS, RIVET_OUTSIDE = 1, 2, 8  # 4 meant a compressed joint


@dataclass
class RivetLoad:
    """Loads of rivets [N, N.m]: tension, transverse load and bending moment of the shank at the split (on the +x
    half), head friction.
    """

    T: float = 0.0
    V_y: float = 0.0
    V_z: float = 0.0
    m_y: float = 0.0
    m_z: float = 0.0
    F_head: float = 0.0


@dataclass
class JointLoads:
    """Loads of all joints [..., Z] in N and N.m."""

    N: np.ndarray  # external tension of the joint
    M_r: np.ndarray  # moment that the joint transmits
    M_t: np.ndarray
    V: np.ndarray  # modulus of its transverse load
    T: np.ndarray  # tension of the rivet, with preload and prying
    m_r: np.ndarray  # bending moment of its shank at the split
    m_t: np.ndarray
    V_r: np.ndarray  # transverse load of its shank
    V_t: np.ndarray
    F_head: np.ndarray  # modulus of the friction force at its heads

    @property
    def rivet(self):
        """The loads of the rivet alone, which the stress table takes."""
        return RivetLoad(T=self.T, V_y=self.V_r, V_z=self.V_t, m_y=self.m_r, m_z=self.m_t, F_head=self.F_head)


def axis_splines_xi(knots, s, fit):
    """s times the splines of xi = fit/s, without dividing where s may vanish: first coefficient and weights."""
    rise, _ = constants(knots)
    inside = np.clip(np.divide(fit, s, out=np.zeros_like(s), where=s > 0.0), knots[0], knots[-1])
    first, w = cell_weights(knots, inside)
    w = w * s[..., None]
    below, beyond = fit <= s * knots[0], fit - s * knots[-1]
    last = len(knots) - 2
    slope = 2.0 * (knots[-1] - knots[-2]) * rise[-1] * beyond
    zero = np.zeros_like(s)
    first = np.where(below, 0, np.where(beyond >= 0.0, last, first))
    w = np.where(
        below[..., None],
        np.stack([s, zero, zero], -1),
        np.where((beyond >= 0.0)[..., None], np.stack([zero, -slope, s + slope], -1), w),
    )
    return first, w


def load_splines(shank, load, fit_eff):
    """Place of the loads in the table: chi, and for each axis the first coefficient and three weights; those of xi
    carry the factor s.
    """
    T, V, m = np.maximum(load.T, 0.0), np.sqrt(load.V_y**2 + load.V_z**2), np.sqrt(load.m_y**2 + load.m_z**2)
    s, Vm = T + V, V * m

    def ratio(top, bottom):
        return np.divide(top, bottom, out=np.zeros_like(bottom), where=bottom > 1e-300)

    chi = np.minimum(ratio(np.abs(load.V_y * load.m_z - load.V_z * load.m_y), Vm), 1.0)
    values = {"a": ratio(V, s), "c": np.minimum(ratio(m, shank.length * T), 1.0)}
    at = {name: cell_weights(shank.knots[name], value) for name, value in values.items()}
    at["xi"] = axis_splines_xi(shank.knots["xi"], s, fit_eff)
    return chi, at


def rivet_rom_stress(table, load, fit_eff):
    """Stress of all channels [..., 4] in Pa and the load's flags.

    Channels: HEAD_P1 largest principal stress in the head fillet, HEAD_VM von Mises there, MID_VM and MID_P1 in the
    middle of the shank. Flags: sum of RIVET_YIELDS, RIVET_OUTSIDE (a load is not finite).
    """
    arrays = np.broadcast_arrays(*(np.asarray(v, dtype=float) for v in (*vars(load).values(), fit_eff)))
    shape = arrays[0].shape
    flat = [np.atleast_1d(a).ravel() for a in arrays]
    load, fit_eff = RivetLoad(*flat[:-1]), flat[-1]
    chi, at = load_splines(table.shank, load, fit_eff)
    sheet = np.where(chi >= 0.5, 0, 1)  # the first of the two sheets around chi, and its weight in head and middle
    head = 2.0 * chi - (1 - sheet)
    mid = np.where(sheet == 0, head, head * np.sqrt(head))
    first = np.stack([head, head, mid, mid], axis=-1)
    sigma = np.zeros((len(fit_eff), 4))
    (A, wa), (C, wc), (xi, wxi) = (at[name] for name in ("a", "c", "xi"))
    for a in range(3):
        for c in range(3):
            for i in range(3):
                index = A + a, C + c, xi + i
                S, S_next = table.shank.coefficients[*index, sheet], table.shank.coefficients[*index, sheet + 1]
                sigma += (wa[:, a] * wc[:, c] * wxi[:, i])[:, None] * (first * S + (1.0 - first) * S_next)
    sigma[:, HEAD_P1] += table.head_friction * load.F_head
    sigma[:, HEAD_VM] += table.head_friction_vm * load.F_head
    flags = RIVET_YIELDS * (
        np.maximum(sigma[:, HEAD_VM], sigma[:, MID_VM]) > table.yield_rivet
    ) + RIVET_OUTSIDE * ~np.isfinite(sigma[:, HEAD_P1])
    return sigma.reshape(*shape, 4), flags.reshape(shape)


def rivet_rom_fit_flags(table, fit_a):
    """Flags of the fit alone: FLANGE_YIELDS, RIVET_OUTSIDE (beyond the map of effective fits)."""
    return FLANGE_YIELDS * (fit_a > table.fit_flange_yield) + RIVET_OUTSIDE * (fit_a > table.fit_a[-1])


def rivet_rom_fit_eff(table, fit_a, j2):
    """Effective fit [m]: fit_a itself, or with j2 the elastic fit that leaves the pressure of the yielded flange."""
    fit_a = np.asarray(fit_a, dtype=float)
    if not j2:
        return fit_a
    x, y, slope = table.fit_a, table.fit_eff, table.fit_slope
    i = np.clip(np.searchsorted(x, fit_a, side="right") - 1, 0, len(x) - 2)
    h = x[i + 1] - x[i]
    u = (fit_a - x[i]) / h
    v = 1.0 - u
    inside = (
        y[i] * v * v * (1.0 + 2.0 * u)
        + y[i + 1] * u * u * (1.0 + 2.0 * v)
        + h * u * v * (slope[i] * v - slope[i + 1] * u)
    )
    return np.where(fit_a <= x[0], fit_a, np.where(fit_a >= x[-1], y[-1] + slope[-1] * (fit_a - x[-1]), inside))


def joint_preload(table, preload, T):
    """Preload at temperature T [N]: the flanges outgrow the rivet, k_stack (alpha_flange - alpha_rivet) grip per
    kelvin; not below 0.
    """
    j = table.joint
    return np.maximum(0.0, preload + j["k_stack"] * (j["alpha_flange"] - j["alpha_rivet"]) * j["grip"] * (T - j["T_0"]))


def joint_fit(table, fit, T):
    """Fit at temperature T [m]."""
    j = table.joint
    return fit - (j["alpha_flange"] - j["alpha_rivet"]) * j["d"] * (T - j["T_0"])


def joint_hole_stiffness(table, fit_a):
    """Tangent stiffness of the hole contact of both halves in series [N/m], constant outside its table."""
    return np.interp(fit_a, table.joint["hole_fit"], table.joint["k_hole"])
