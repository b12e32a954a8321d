"""Curves of one rivet (the paper's Figs. 11 and 12, and over transverse load) and pictures of the finite elements
behind them.
"""

import textwrap
from dataclasses import dataclass, replace

import numpy as np

from bearing_model.cage.common.joint_law import single_joint
from bearing_model.rivet.rivet_rom import HEAD_P1, MID_VM, RivetLoad, rivet_rom_fit_eff, rivet_rom_stress
from rivet_model import half, half_loads, half_modes, plastic_fit
from rivet_model.cage_half import CageHalf, CyclicSolid
from rivet_model.load_cases import GROUPS

SWELL = 4e-6  # m, default of joint.swell, of the 6207's rivets; that of others goes with Geometry.size
FIT = -10e-6  # m, of the default joint
HEAD, MIDDLE = "#c8442b", "#2a6f97"
MAGNIFIED = 60.0  # displacements and gaps of the section as drawn
SHAPES, LARGEST = 8, 2.5e-3  # of a cage half: how many, and as what length their largest displacement is drawn [m]


@dataclass(frozen=True)
class JointLoad:
    """Preload, external tension and transverse load of a single joint [N]; its neighbours stay closed."""

    P: float
    N: float = 0.0
    V: float = 0.0


# P: preload of the paper's section 4.1 (3); N, V: large enough to be seen
REFERENCE = JointLoad(P=20.0, N=10.0, V=10.0)


@dataclass(frozen=True)
class Curve:
    """Stress of head (largest principal) and middle (von Mises) [Pa] over x [SI]."""

    label: str
    unit: str
    scale: float  # x in `unit` / x in SI
    loads: str  # loads that are held, with units
    figure: str  # of the paper that shows the same, "" if none does
    kind: str  # of the material at the bore, "" if it makes no difference
    x: np.ndarray
    head: np.ndarray
    mid: np.ndarray
    row: float  # distance of the printed rows [SI]

    @property
    def title(self):
        """Quantity of the curve, its loads, and its place in the paper."""
        return f"Stress over {self.label}{self.kind and f', {self.kind}'}: {self.loads}{self.source}"

    @property
    def source(self):
        """Where the paper shows the same, behind a title."""
        return self.figure and f" ({self.figure} of the paper)"


def table_response(t):
    """stress(load, fit_eff) -> channels [..., 4] in Pa, fit_eff(fit_a) [m]: of a table; load: JointLoad."""

    def stress(load, fit):
        T, m_r, m_t = single_joint(t.half.law, load.P, load.N)
        return rivet_rom_stress(t, RivetLoad(T=T, V_y=load.V, m_y=m_r, m_z=m_t), fit)[0]

    return stress, lambda fit_a: rivet_rom_fit_eff(t, fit_a, True)


def joint_response(joint):
    """The same two functions by solutions of a Joint and of its pad on coarse elements of the half, without a table."""
    fitted = plastic_fit.plastic_fit(joint.geometry)
    alone = half_loads.JointAlone(CageHalf(joint.geometry, half.COARSE))

    def stress(load, fit):
        P, N, V, fit = np.broadcast_arrays(load.P, load.N, load.V, fit)
        forces = []
        for p, n, v, x in zip(P.flat, N.flat, V.flat, fit.flat, strict=True):
            T, m_r, m_t = alone.solve(np.array([n, 0.0, 0.0]), p)[1] if p + n > 0.0 else np.zeros(3)
            m_r = 0.0 if abs(m_r) < 1e-6 * abs(m_t) else m_r  # symmetry, but for rounding
            forces.append(joint.solve_shank(T, v, m_t, m_r, x)[0])
        return joint.channels(np.stack(forces, axis=1))

    return stress, lambda fit_a: np.where(fit_a > 0.0, np.interp(fit_a, fitted.fit_a, fitted.fit_eff), fit_a)


def curves(stress, fit_eff, size=1.0, paper=True):
    """Curves by name: preload alone at the largest clearance; the reference loads over the fit, elastic and with the
    flange's yield; over the transverse load.

    size: Geometry.size: lengths go with it, forces with its square, so that stresses are alike; paper: whether the
    rivet is the paper's, whose figures show the same.
    """
    newtons, microns, r, swell = whole(10.0 * size**2), whole(10.0 * size), reference(size), size * SWELL
    most, unit = newtons * round(60.0 * size**2 / newtons), 0.1 * microns
    preload, V = np.linspace(0.0, most, 25), np.linspace(0.0, most, 25)
    low, high = (microns * round(end * size / microns) for end in (-90.0, 40.0))
    fit, loose, usual = 1e-6 * np.arange(low, high + unit, 2.0 * unit), 1e-6 * low, size * FIT
    swollen = f"swell {1e6 * swell:.3g} µm"
    alone = f"fit {micrometres(loose)} (clearance), no external load"
    loaded = f"preload {r.P:.4g} N, external tension {r.N:.4g} N, transverse load {r.V:.4g} N, {swollen}"
    preloaded = f"preload {r.P:.4g} N, no external tension, fit {micrometres(usual)} (clearance), {swollen}"

    def curve(label, unit, scale, x, load, fit_a, loads, figure="", kind=""):
        sigma = stress(load, fit_a)
        row = newtons if unit == "N" else 1e-6 * microns
        shown = figure if paper else ""
        return Curve(label, unit, scale, loads, shown, kind, x, sigma[..., HEAD_P1], sigma[..., MID_VM], row)

    return {
        "preload": curve("preload", "N", 1.0, preload, JointLoad(P=preload), loose + swell, alone, "Fig. 11"),
        "fit, elastic": curve("fit", "µm", 1e6, fit, r, fit + swell, loaded, "Fig. 12", "elastic"),
        "fit, with yield": curve(
            "fit", "µm", 1e6, fit, r, fit_eff(fit + swell), loaded, "Fig. 12", "the flange yields"
        ),
        "transverse load": curve("transverse load", "N", 1.0, V, replace(r, N=0.0, V=V), usual + swell, preloaded),
    }


def reference(size):
    """REFERENCE for a joint of another size, with equal stresses."""
    return JointLoad(*(size**2 * load for load in (REFERENCE.P, REFERENCE.N, REFERENCE.V)))


def whole(value):
    """1, 2 or 5 times a power of ten, the next one below."""
    power = 10.0 ** np.floor(np.log10(value) + 1e-9)
    return float(power * max(digit for digit in (1.0, 2.0, 5.0) if digit * power <= value * (1.0 + 1e-9)))


def micrometres(length):
    """A length [m] as text."""
    return f"{1e6 * length:.0f} µm".replace("-", "−")


def blank(width, height):
    """An empty figure [inch]; Matplotlib, which writes a list of fonts, is loaded for a picture only."""
    from matplotlib.figure import Figure

    return Figure(figsize=(width, height), layout="constrained")


def plot_curves(data, title=""):
    """Figure of the curves."""
    figure = blank(13, 4.2)
    axes = figure.subplots(1, 3)
    panel = {"preload": axes[0], "fit": axes[1], "transverse load": axes[2]}
    for c in data.values():
        style, kind = ("--", ", elastic") if c.kind == "elastic" else ("-", "")
        panel[c.label].plot(c.scale * c.x, c.head / 1e6, style, color=HEAD, label="head" + kind)
        panel[c.label].plot(c.scale * c.x, c.mid / 1e6, style, color=MIDDLE, label="middle" + kind)
        panel[c.label].set(xlabel=f"{c.label} [{c.unit}]", ylabel="stress [MPa]", ylim=(0.0, None))
        panel[c.label].set_title(f"Over {c.label}{c.source}\n{textwrap.fill(c.loads, 56)}", fontsize="small")
    yielded = data["fit, with yield"]
    axes[1].set_ylim(0.0, 1.5e-6 * max(yielded.head.max(), yielded.mid.max()))
    axes[1].axvspan(-20.0, 0.0, color="0.93", zorder=0)
    for ax in axes:
        ax.grid(color="0.9")
        ax.set_axisbelow(True)
        ax.spines[["top", "right"]].set_visible(False)
        ax.legend(frameon=False)
    figure.suptitle(title, x=0.01, ha="left")
    return figure


# The drawing ----------------------------------------------------------------------------------------------------------


def plot_geometry(geometry, title="Rivet joint to scale; dimensions in mm"):
    """Figure: the rivet in its two flanges, to scale, with the dimensions by their names in mm."""
    g = {name: 1e3 * getattr(geometry, name) for name in LENGTHS}
    a, top, out = 0.5 * g["shank_diameter"], g["flange_thickness"] + g["head_height"], g["patch_radius"]
    figure = blank(10.5, 8)
    ax = figure.subplots()
    for side in (-1.0, 1.0):
        for up in (-1.0, 1.0):
            r, x = np.array(flange_outline(g)).T
            ax.fill(side * r, up * x, facecolor="#efe2c8", edgecolor="0.35", hatch="//", linewidth=0.8)
    ax.fill(*np.array(rivet_outline(g)).T, facecolor="#d3dbe3", edgecolor="0.15", linewidth=1.0)
    ax.axhline(0.0, color="0.5", linewidth=0.7, linestyle="-.")
    ax.axvline(0.0, color="0.5", linewidth=0.7, linestyle="-.")
    gap = 0.16 * (out + top)
    head, flange = 0.5 * g["head_diameter"], g["flange_thickness"]
    across(ax, (-head, head), top + gap, f"head_diameter {g['head_diameter']:.4g}", flange)
    across(ax, (-a, a), -top - gap, f"shank_diameter {g['shank_diameter']:.4g}", -top)
    across(ax, (0.0, out), -top - 2.2 * gap, f"patch_radius {out:.4g}", -flange)
    along(ax, (flange, top), out + gap, f"head_height {g['head_height']:.4g}", head)
    along(ax, (0.0, flange), out + gap, f"flange_thickness {flange:.4g}", out)
    notes = (
        ("relief_depth", (-a - g["relief_radius"], g["flange_thickness"] - 0.5 * g["relief_depth"]), 0.7),
        ("relief_radius", (-a - 0.5 * g["relief_radius"], g["flange_thickness"] - g["relief_depth"]), 0.45),
        ("edge_break", (-a - 0.5 * g["edge_break"], 0.5 * g["edge_break"]), 0.2),
        ("middle_zone", (-a, -g["middle_zone"]), -0.05),
        ("fillet_radius", (-a - 0.3 * g["fillet_radius"], -g["flange_thickness"] + 0.3 * g["fillet_radius"]), -0.5),
    )
    for name, place, height in notes:
        ax.annotate(
            f"{name} {g[name]:.4g}",
            place,
            (-out - gap, height * (top + gap)),
            ha="right",
            va="center",
            arrowprops={"arrowstyle": "-|>", "color": HEAD, "lw": 0.8},
        )
    ax.set(
        title=title,
        aspect="equal",
        xlim=(-2.3 * out - gap, 2.3 * out + gap),
        ylim=(-top - 3.0 * gap, top + 2.0 * gap),
    )
    ax.set_xlabel(
        f"seat under the head: {1e3 * geometry.seat_width:.3g} mm wide, {100.0 * geometry.seat_share:.0f} % of the shank's section"
    )
    ax.set(xticks=[], yticks=[])
    ax.spines[:].set_visible(False)
    return figure


LENGTHS = (
    *("shank_diameter", "head_diameter", "head_height", "fillet_radius", "relief_radius", "relief_depth", "edge_break"),
    *("flange_thickness", "patch_radius", "middle_zone"),
)


def flange_outline(g):
    """Corners (r, x) of the upper flange's section [mm], from the chamfer at the split plane around."""
    a, t, e, c = 0.5 * g["shank_diameter"], g["flange_thickness"], g["edge_break"], g["relief_radius"]
    return [
        (a + e, 0.0),
        (a, e),
        (a, t - g["relief_depth"]),
        (a + c, t - g["relief_depth"]),
        (a + c, t),
        (g["patch_radius"], t),
        (g["patch_radius"], 0.0),
    ]


def rivet_outline(g):
    """Corners (r, x) of the rivet's section [mm] with rounded fillets."""
    a, h, t, f = 0.5 * g["shank_diameter"], 0.5 * g["head_diameter"], g["flange_thickness"], g["fillet_radius"]
    top = t + g["head_height"]
    turn = np.linspace(0.0, 0.5 * np.pi, 9)
    fillet = [(a + f * (1.0 - np.cos(s)), t - f * (1.0 - np.sin(s))) for s in turn]
    quarter = [*fillet, (h, t), (h, top)]
    right = [*((r, -x) for r, x in reversed(quarter)), *quarter]
    return [*right, *((-r, x) for r, x in reversed(right))]


ARROW = {"arrowstyle": "<|-|>", "color": MIDDLE, "lw": 1.0, "shrinkA": 0, "shrinkB": 0}


def across(ax, ends, height, text, foot):
    """A dimension across the axis between two radii, its lines from `foot` on."""
    ax.annotate("", (ends[0], height), (ends[1], height), arrowprops=ARROW)
    ax.plot((ends, ends), (foot, height), color=MIDDLE, linewidth=0.5)
    look = {"ha": "center", "va": "bottom", "bbox": {"facecolor": "white", "edgecolor": "none", "pad": 1.0}}
    ax.text(0.5 * sum(ends), height + 0.03 * abs(height), text, color=MIDDLE, **look)


def along(ax, ends, radius, text, foot):
    """A dimension along the axis between two places, its lines from `foot` on."""
    ax.annotate("", (radius, ends[0]), (radius, ends[1]), arrowprops=ARROW)
    ax.plot((foot, radius), (ends, ends), color=MIDDLE, linewidth=0.5)
    ax.text(1.04 * radius, 0.5 * sum(ends), text, ha="left", va="center", color=MIDDLE)


# The section ----------------------------------------------------------------------------------------------------------


def plot_section(joint):
    """Figure: meshes; the joint under the reference loads in the plane of V, deformed, with its largest principal
    stress; the fillet that carries most.

    Gaps and displacements are magnified alike, so that bodies touch in the picture where they touch in the solution.
    """
    figure = blank(13, 6.4)
    left, middle, right = figure.subplots(1, 3, width_ratios=[0.75, 1.2, 1.0])
    for mesh in (joint.rivet.mesh, joint.flange.mesh):
        for ax in (left, right):
            ax.plot(*(1e3 * mesh.p[:, np.concatenate([mesh.t, mesh.t[:1]])]), color="0.4", linewidth=0.3)
    left.set(title="mesh (lower flange: mirrored)", xlabel="r [mm]", ylabel="x [mm]", aspect="equal")

    load, fit = reference(joint.geometry.size), joint.geometry.size * (FIT + SWELL)
    forces, q, *_ = joint.solve(load.P, load.N, load.V, 0.0, 0.0, fit)
    parts = [part for theta in (0.0, np.pi) for part in section(joint, forces, q, theta, load.P, fit)]
    limit = max(stress.max() for _, _, _, stress in parts) / 1e6
    shade = {"shading": "gouraud", "cmap": "viridis", "vmin": 0.0, "vmax": limit}
    for moved, _, triangles, stress in parts:
        filled = middle.tripcolor(*(1e3 * moved), triangles, stress / 1e6, **shade)
    middle.set(title=f"displacements and gaps × {MAGNIFIED:g}", xlabel="along V [mm]", aspect="equal")

    g = joint.geometry
    _, place, triangles, stress = max(parts, key=lambda part: part[3].max())
    up = np.sign(place[1, np.argmax(stress)])
    right.tripcolor(1e3 * np.abs(place[0]), 1e3 * up * place[1], triangles, stress / 1e6, **shade)
    centre, size = (1e3 * g.shank_diameter / 2, 1e3 * g.flange_thickness), 3e3 * g.fillet_radius
    right.set(
        xlim=(centre[0] - 1.5 * size, centre[0] + size),
        ylim=(centre[1] - size, centre[1] + 1.5 * size),
        xlabel="r [mm]",
        aspect="equal",
    )
    right.set_title("the fillet with the largest stress")
    figure.colorbar(filled, ax=right, label="largest principal stress [MPa]")
    figure.suptitle(
        f"P {load.P:g} N, N {load.N:g} N, V {load.V:g} N, hole contact at fit {1e6 * fit:g} µm", x=0.01, ha="left"
    )
    return figure


def section(joint, forces, q, theta, P, fit):
    """Rivet, upper and lower flange in the half plane at theta = 0 or pi.

    forces, q: contact forces and rigid motions of a solution under the preload P.  Returns for each body the displaced
    and the original positions of the vertices (along V, x) [2, vertices], triangles, and the largest principal stress
    [vertices] in Pa.
    """
    g, side = joint.geometry, np.cos(theta)
    mirrored = {"LH": joint.upper["UH"], "LB": joint.upper["UB"], "PP": joint.upper["PP"]}
    # fit and preload as strains
    short = np.array([0.5 * fit / (g.shank_diameter / 2), -0.5 * joint.overclosure(P, fit) / g.flange_thickness])
    still = np.zeros(5)
    bodies = (
        (joint.rivet, joint.rivet_loads, joint.ring_slices, 1.0, q[:5], short),
        (joint.flange, joint.flange_loads, joint.upper, 1.0, q[5:], 0.0 * short),
        (joint.flange, joint.flange_loads, mirrored, -1.0, still, 0.0 * short),
    )
    for body, loads, rings, up, motion, shrink in bodies:
        amplitude = joint.amplitudes(forces[:, None], {name: rings[name] for name in GROUPS if name in rings})
        elastic, stress = _response(body, loads, amplitude[0, :, :, 0], theta)
        r, z = body.mesh.p
        place = np.stack([side * r, up * z])
        moved = np.stack([side * elastic[0], up * elastic[1]]) + shrink[:, None] * place
        moved += np.stack([motion[0] + motion[4] * place[1], motion[2] - motion[4] * place[0]])
        quads = body.mesh.t
        triangles = np.concatenate([quads[[0, 1, 2]], quads[[0, 2, 3]]], axis=1).T
        yield place + MAGNIFIED * moved, place, triangles, stress


def _response(body, loads, amplitude, theta):
    """Elastic displacement (r, z) [2, vertices] and largest principal stress [vertices] under the rings' pressures
    [harmonics, rings].
    """
    mesh, (S_0, S_1) = body.mesh, body.centre_stress()
    moved, stress = np.zeros((2, mesh.nvertices)), np.zeros((6, body.basis.nelems))
    for n in range(min(len(amplitude), 13)):  # enough for a picture
        u = -body.solve(n, (loads @ amplitude[n])[:, None])
        moved += np.cos(n * theta) * u[body.basis.nodal_dofs[[0, 2]], 0]
        stress += ((S_0 + n * S_1) @ u).reshape(6, -1) * np.where(
            np.arange(6) < 4, np.cos(n * theta), np.sin(n * theta)
        )[:, None]
    tensor = stress[[0, 4, 3, 4, 1, 5, 3, 5, 2]].T.reshape(-1, 3, 3)
    largest = np.linalg.eigvalsh(tensor)[:, 2]
    count = np.bincount(mesh.t.ravel(), minlength=mesh.nvertices)
    return moved, np.bincount(mesh.t.ravel(), np.tile(largest, 4), minlength=mesh.nvertices) / count


def plot_modes(g):
    """Figure: the first SHAPES in which a free cage half vibrates, one of each pair, by coarse elements without the rivets'
    mass (2 % off in frequency).
    """
    from mpl_toolkits.mplot3d.art3d import Poly3DCollection

    solid = CyclicSolid(half.pitch_mesh(g, half.COARSE), g.Z, g.E_flange, g.nu_flange)
    M = (g.rho_flange * solid.M).tocsc()
    found = []
    for n in range(min(g.Z // 2, SHAPES) + 1):
        square, shapes = half_modes.wave_modes(solid, M, n, 4)
        found += [(np.sqrt(w) / (2.0 * np.pi), n, shape) for w, shape in zip(square, shapes.T, strict=True)]
    found.sort(key=lambda mode: mode[0])
    figure = blank(13, 7)
    for i, (frequency, n, shape) in enumerate(found[:SHAPES]):
        ax = figure.add_subplot(2, SHAPES // 2, i + 1, projection="3d")
        quads, moved = half_surface(solid, n, shape)
        size = np.linalg.norm(moved, axis=-1)
        drawn = 1e3 * (quads + LARGEST / size.max() * moved)[..., [1, 2, 0]]
        skin = Poly3DCollection(drawn, cmap="viridis", edgecolor="0.3", linewidth=0.1)
        skin.set_array(size.mean(axis=1))
        ax.add_collection3d(skin)
        R = 0.62e3 * g.cage_outer_diameter / 1.15
        ax.set(xlim=(-R, R), ylim=(-R, R), zlim=(-0.5 * R, 0.5 * R))
        ax.set_box_aspect((1, 1, 0.5), zoom=1.4)
        ax.set_axis_off()
        ax.view_init(elev=38, azim=-60)
        ax.set_title(f"{frequency / 1e3:.2f} kHz, {n} wave{'s' * (n != 1)}", y=0.96)
    figure.suptitle(f"shapes of a free cage half, displacements drawn up to {1e3 * LARGEST:g} mm", x=0.01, ha="left")
    return figure


def half_surface(solid, n, shape):
    """Corners of all facets of the half's skin [facets, 4, 3] and their displacements by wave n with the amplitudes
    shape [dofs].
    """
    mesh, step = solid.basis.mesh, 2.0 * np.pi / solid.Z
    facets = mesh.boundary_facets()
    theta = np.arctan2(*mesh.p[[2, 1]][:, mesh.facets[:, facets]])
    inner = ~(np.all(np.abs(theta) < 1e-9, axis=0) | np.all(np.abs(theta - step) < 1e-9, axis=0))
    corners = mesh.facets[:, facets[inner]].T
    place, u = mesh.p[:, corners].transpose(1, 2, 0), shape[solid.basis.nodal_dofs[:3][:, corners]].transpose(1, 2, 0)
    u = u * np.exp(-0.5j * np.angle((u**2).sum()))  # the phase in which pitch 0 moves most
    quads, moved = [], []
    for j in range(solid.Z):
        c, s = np.cos(j * step), np.sin(j * step)
        turn = np.array([[1.0, 0.0, 0.0], [0.0, c, -s], [0.0, s, c]])
        quads.append(place @ turn.T)
        moved.append((u * np.exp(1j * n * j * step)).real @ turn.T)
    return np.concatenate(quads), np.concatenate(moved)
