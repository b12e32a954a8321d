"""Curves of a rivet table (the paper's Figs. 11 and 12, and over transverse load) and pictures of the finite elements behind it.

python -m rivet_model.pictures OUT.png [TABLE.json]            curves
python -m rivet_model.pictures OUT.png --section [GEOMETRY]    mesh, deformed section and stress under preload, tension and transverse load
"""

import sys
from pathlib import Path

import numpy as np

from bearing_model.rivet_rom import HEAD_P1, MID_VM, RivetLoad, rivet_rom_fit_eff, rivet_rom_stress

from . import table
from .geometry import Geometry
from .load_cases import Joint

DEFAULT_TABLE = Path(__file__).parent / "tables" / "6207.json"
SWELL = 4e-6  # m, default of joint.swell
REFERENCE = {"P": 20.0, "N": 10.0, "V_y": 10.0}  # N: preload of the paper's section 4.1 (3), loads of the study


def curves(t, swell=SWELL):
    """Data of three curves: name -> (x, head [Pa], middle [Pa]), x in N or m.  Fig. 11 over preload at the largest clearance, Fig. 12 over the fit."""
    preload, fit, V = np.linspace(0.0, 60.0, 61), np.linspace(-90e-6, 40e-6, 131), np.linspace(0.0, 60.0, 61)

    def stress(load, fit_a):
        sigma, _ = rivet_rom_stress(t, load, fit_a)
        return sigma[..., HEAD_P1], sigma[..., MID_VM]

    yielded = rivet_rom_fit_eff(t, fit + swell, True)
    return {
        "preload": (preload, *stress(RivetLoad(P=preload), -90e-6)),
        "fit, elastic": (fit, *stress(RivetLoad(**REFERENCE), fit + swell)),
        "fit, with yield": (fit, *stress(RivetLoad(**REFERENCE), yielded)),
        "transverse load": (V, *stress(RivetLoad(P=20.0, V_y=V), -6e-6)),
    }


def text(data):
    """The curves as a table to print."""
    lines = []
    for name, (x, head, mid) in data.items():
        scale, unit = (1e6, "um") if name.startswith("fit") else (1.0, "N")
        lines.append(f"{name} [{unit}]: head, middle [MPa]")
        chosen = np.linspace(0, len(x) - 1, 11).astype(int)
        lines += [f"{scale * x[i]:8.1f} {head[i] / 1e6:8.1f} {mid[i] / 1e6:8.1f}" for i in chosen]
    return "\n".join(lines)


def plot_curves(data):
    """Figure of the curves."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(13, 4), layout="constrained")
    axes = figure.subplots(1, 3)
    for name, (x, head, mid) in data.items():
        ax = axes[0 if name == "preload" else 2 if name == "transverse load" else 1]
        style, label = ("--", ", elastic") if name.endswith("elastic") else ("-", "")
        x = 1e6 * x if name.startswith("fit") else x
        ax.plot(x, head / 1e6, style, color="C0", label="head" + label)
        ax.plot(x, mid / 1e6, style, color="C1", label="middle" + label)
    for ax, label in zip(axes, ("preload [N]", "fit [µm]", "transverse load [N]"), strict=True):
        ax.set(xlabel=label, ylabel="stress [MPa]")
        ax.legend()
    axes[1].set_ylim(0, 700)
    return figure


def plot_section(joint, P=20.0, N=10.0, V=20.0, fit=-6e-6, magnified=200.0):
    """Figure: meshes; the section in the plane of the load, deformed, with its largest principal stress."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(12, 7), layout="constrained")
    left, right = figure.subplots(1, 2)
    for mesh in (joint.rivet.mesh, joint.flange.mesh):
        _draw_mesh(left, mesh.p, mesh.t)
    left.set(title="mesh (the lower flange mirrors the upper one)", xlabel="r [mm]", ylabel="x [mm]", aspect="equal")
    forces = joint.solve(P, N, V, 0.0, 0.0, fit)[0]
    for theta in (0.0, np.pi):
        moved, stress = joint_displacement(joint, forces, theta)
        mesh = joint.rivet.mesh
        side = np.cos(theta)
        p = np.stack([side * (mesh.p[0] + magnified * moved[0]), mesh.p[1] + magnified * moved[1]])
        filled = right.tripcolor(1e3 * p[0], 1e3 * p[1], _triangles(mesh.t), stress / 1e6, shading="gouraud", cmap="viridis", vmin=0, vmax=150)
    figure.colorbar(filled, ax=right, label="largest principal stress [MPa]")
    right.set(title=f"P {P:g} N, N {N:g} N, V {V:g} N, fit {1e6 * fit:g} µm; displacements × {magnified:g}", xlabel="r [mm]", aspect="equal")
    return figure


def joint_displacement(joint, forces, theta, harmonics=8):
    """Elastic displacement (r, z) [2, vertices] and largest principal stress [vertices] of the rivet in the half plane at `theta`.

    forces: contact forces of a solution.  The first harmonics only: enough for a picture.
    """
    rivet, mesh = joint.rivet, joint.rivet.mesh
    amplitude = joint.amplitudes(forces[:, None], joint.ring_slices)
    moved, stress = np.zeros((2, mesh.nvertices)), np.zeros((6, rivet.basis.nelems))
    S_0, S_1 = rivet.centre_stress()
    for n in range(harmonics + 1):
        u = -rivet.solve(n, joint.rivet_loads @ amplitude[0, n])
        moved += np.cos(n * theta) * u[rivet.basis.nodal_dofs[[0, 2]], 0]
        stress += ((S_0 + n * S_1) @ u).reshape(6, -1) * np.where(np.arange(6) < 4, np.cos(n * theta), np.sin(n * theta))[:, None]
    tensor = stress[[0, 4, 3, 4, 1, 5, 3, 5, 2]].T.reshape(-1, 3, 3)
    largest = np.linalg.eigvalsh(tensor)[:, 2]
    count = np.bincount(mesh.t.ravel(), minlength=mesh.nvertices)
    return moved, np.bincount(mesh.t.ravel(), np.tile(largest, 4), minlength=mesh.nvertices) / count


def _triangles(quads):
    return np.concatenate([quads[[0, 1, 2]], quads[[0, 2, 3]]], axis=1).T


def _draw_mesh(ax, p, quads):
    loop = np.concatenate([quads, quads[:1]])
    x, y = 1e3 * p[0][loop], 1e3 * p[1][loop]
    ax.plot(x, y, color="0.4", linewidth=0.3)


def main(arguments):
    """Command line."""
    if not arguments:
        print(__doc__)
        return 2
    if "--section" in arguments:
        rest = [a for a in arguments[1:] if a != "--section"]
        figure = plot_section(Joint(Geometry.from_toml(rest[0]) if rest else Geometry()))
    else:
        data = curves(table.read(arguments[1] if len(arguments) > 1 else DEFAULT_TABLE))
        print(text(data))
        figure = plot_curves(data)
    figure.savefig(arguments[0], dpi=120)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
