"""Write a rivet table as C constants: python -m rivet_model.embed TABLE OUT.c [--Z 9].  Needs numpy only; the same
table gives the same bytes.
"""

import argparse
import hashlib
import sys
from pathlib import Path

import numpy as np

from bearing_model.cage.common import joint_law
from bearing_model.cage.elastic.half_modes import rim_amplitudes
from bearing_model.cage.two_half import half_path
from bearing_model.rivet import rivet_splines, rivet_table

from . import splines

BINS = 256  # RIVET_BINS in fmu_src/rivet/rivet_rom.h
PSI_CELLS = 10  # of fmu_src/cage/common/joint_law.h


def _array(name, values, kind="double"):
    """C text of a constant array, aligned to lines of the cache."""
    text = [repr(value) + "f" * (kind == "float") for value in np.ravel(values).tolist()]
    lines = [", ".join(text[i : i + 8]) for i in range(0, len(text), 8)]
    return f"static const _Alignas(64) {kind} {name}[{len(text)}] = {{\n    " + ",\n    ".join(lines) + "};\n"


def bin_cells(knots):
    """Cell in which each of BINS equal bins begins; if a knot lies at the start of a bin, the cell below the
    knot counts, because rounding may put a point just below the knot into this bin.

    >>> bin_cells(np.array([0.0, 0.5, 1.0]))[[0, 127, 128, 129, 256]]
    array([0, 0, 0, 1, 1])
    """
    starts = knots[0] + (np.arange(BINS + 1) - 1e-6) * (knots[-1] - knots[0]) / BINS
    return np.searchsorted(knots[1:-1], starts, side="right")


def path_rows(half):
    """The path over the wall's angle as the C reader wants it: [push_t >= 0 and < 0, node, value and slope, 3 forces,
    Z, ROWS], of a ribbon radius by radius.
    """
    # from [..., node, value and slope, Z, ROWS, 3]
    front = np.moveaxis(np.stack([half.path, half.path_slope], axis=-4), -1, -3)
    back = front[..., ::-1, :] * half_path.PATH_MIRROR  # rivet -1 - i for i
    return np.stack([front, back], axis=-6)


def uniform_cells(name, knots):
    """Number of equal cells whose ends hold all knots; ValueError if there are none."""
    step = np.diff(knots).min()
    ends = (knots - knots[0]) / step
    if not np.allclose(ends, np.round(ends), atol=1e-6):
        raise ValueError(
            f"joint's law: knots of axis {name} = {knots.tolist()}: multiples of their smallest step are allowed"
        )
    return round(ends[-1])


def law_cells(law):
    """Cells on the axes tau and q of the law; ValueError if those of psi are not PSI_CELLS."""
    *cells, psi = (uniform_cells(name, law.knots[name]) for name in joint_law.AXES)
    if psi != PSI_CELLS:
        raise ValueError(f"joint's law: {psi} cells of axis psi: {PSI_CELLS} are allowed (joint_law.h)")
    return cells


def law_sheets(law, name):
    """C text of the pointers to the law's first three sheets of tau."""
    sheet = (law_cells(law)[1] + 2) * (PSI_CELLS + 2)
    return "{" + ", ".join(f"{name} + {i * sheet} * LAW_WIDTH" for i in range(3)) + "}"


def uniform_coefficients(law):
    """Coefficients of the law [tau, q, psi, LAW_WIDTH] for uniform splines without clamped ends, on equal cells: the
    same function.
    """
    energy = law.energy if isinstance(law, joint_law.LawOfModes) else np.zeros(law.coefficients.shape[:-1])
    values = np.insert(law.coefficients, 3, energy, axis=-1)
    for axis, name in enumerate(joint_law.AXES):
        knots = law.knots[name]
        cells = uniform_cells(name, knots)
        at = splines.sites(np.arange(cells + 1.0))
        cell = np.minimum(at.astype(int), cells - 1)
        up = at - cell
        uniform = np.zeros((len(at), len(at)))
        for k, weight in enumerate((0.5 * (1 - up) ** 2, 0.5 + up - up**2, 0.5 * up**2)):
            uniform[np.arange(len(at)), cell + k] = weight
        clamped = splines.collocation(knots, knots[0] + (knots[-1] - knots[0]) * at / cells)
        # a product by BLAS would have other last digits with another number of threads
        turned = np.moveaxis(values, axis, 0)
        values = np.moveaxis(np.einsum("ij,j...->i...", np.linalg.solve(uniform, clamped), turned), 0, axis)
    return np.append(values, np.zeros((*values.shape[:-1], 1)), axis=-1)


def uniform_rows(uniform):
    """Rows of fmu_src/cage/common/joint_law.h's UNIFORM_WIDTH."""
    even = [0, 2, 3, 5]  # u, phi_t, T, m_t, over N, M_t, P
    slopes = uniform.slopes[:, even][:, :, [0, 2, 3]].reshape(len(uniform.x), -1)
    return np.column_stack(
        [uniform.load[:, [0, 2]], uniform.values[:, even], slopes, uniform.slopes[:, 1, 1], uniform.slopes[:, 4, 1]]
    )


def _braces(values):
    """Nested C initialiser of an array."""
    if np.ndim(values) == 0:
        return repr(values)
    return (
        "{" + ", ".join(map(_braces, np.asarray(values).tolist() if isinstance(values, np.ndarray) else values)) + "}"
    )


def _half_source(half):
    """C text of the arrays of the cage half, and the initialiser of its CageHalfData."""
    law = half.law
    felt = [k for k in range(1, law.Z) if np.any(law.others[k])]
    radii, size, of_path, spin = len(half.radii), "2", "0, NULL", ""
    if radii:  # a ribbon
        size, of_path = f"2 * {radii}", f"{radii}, path_radius"
        spin = f".spin_steps = {len(half.spin_preload)}, .spin_preload = spin_preload, .yield_force = {float(half.yield_force)!r}, "
    arrays = [
        _array("path_chi", half.chi),
        _array("path_rows", path_rows(half), "float"),
        f'_Static_assert(sizeof path_rows == {size} * sizeof path_chi / sizeof *path_chi * 6 * ROWS * Z * sizeof *path_rows, "the path has another shape");\n',
        _array("land_rows", half.land),
        _array("law_coefficients", uniform_coefficients(law)),
        f"static const int law_neighbour[{len(felt)}] = {_braces(felt)};\n",
        f"static const double law_K[{len(felt)}][3][3] = {_braces(law.others[felt])};\n",
        f"static const double law_K_slip[{law.Z}][2][2] = {_braces(law.slip_stiffness)};\n",
        *([_array("path_radius", half.radii), _array("spin_preload", half.spin_preload)] if radii else []),
        f"static const double law_uniform[{len(law.uniform.x)}][UNIFORM_WIDTH] = {_braces(uniform_rows(law.uniform))};\n",
    ]
    text = f"""{{
        .m = {float(half.m)!r}, .x_c = {float(half.x_c)!r}, .path = {{{len(half.chi)}, path_chi, path_rows, {of_path}}}, .spin = {_braces(half.spin)},
        {spin}.land = land_rows, .growth = {_braces(half.growth)},
        .law = {{.length = {float(law.length)!r}, .cells = {_braces(law_cells(law))}, .sheet = {law_sheets(law, "law_coefficients")},
                .K_0 = {_braces(law.stiffness[0])}, .K_others = {_braces(law.others.sum(axis=0))},
                .neighbours = {len(felt)}, .neighbour = law_neighbour, .K = law_K, .K_slip = law_K_slip,
                .uniform_count = {len(law.uniform.x)}, .uniform = law_uniform}}}}"""
    return arrays, text


def _modes_source(t):
    """C text of the arrays of the half's modes, and the initialiser of its HalfModes."""
    modes = t.modes
    if modes is None:
        return [], "{0}"
    entries = [
        f"{{{omega!r}, {n}, {parity}, {_braces(at)}, {spin!r}, {_braces(rim)}}}"
        for omega, n, parity, at, spin, rim in zip(
            modes.omega.tolist(),
            modes.harmonic.tolist(),
            modes.parity.tolist(),
            modes.pad,
            modes.spin.tolist(),
            rim_amplitudes(modes),
            strict=True,
        )
    ]
    law = modes.law
    arrays = [
        f'_Static_assert({modes.room} <= Y_MODE_D - Y_MODE_S, "the rivet table has {modes.count.sum()} vibration modes");\n',
        f"static const HalfMode mode_entry[{len(entries)}] = {{\n    " + ",\n    ".join(entries) + "};\n",
        _array("mode_pocket", np.stack([modes.pocket, modes.slope], axis=-3)),
        _array("residual_wall", modes.residual.wall),
        _array("behind_coefficients", uniform_coefficients(law)),
    ]
    text = f"""{{
        .entries = {len(entries)}, .modes = {modes.count.sum()}, .entry = mode_entry, .pocket = mode_pocket,
        .pad = {_braces(modes.residual.pad[0])}, .wall = residual_wall,
        .law = {{.length = {float(law.length)!r}, .cells = {_braces(law_cells(law))}, .sheet = {law_sheets(law, "behind_coefficients")},
                 .K_0 = {_braces(law.stiffness)}}}}}"""
    return arrays, text


def c_source(t):
    """The C text of rivet_table.c."""
    parts = [
        f"// The rivet table, kind {t.kind}, geometry {t.geometry_hash}: written by rivet_model/embed.py, not to be edited.\n",
        '#include "rivet/rivet_rom.h"\n\n',
        f'_Static_assert(Z == {t.Z}, "the rivet table was made for Z = {t.Z}");\n\n// clang-format off\n',
    ]
    axes, shank = [], t.shank
    for name in rivet_table.SHANK_AXES:
        knots = shank.knots[name]
        rows = np.column_stack([knots[:-1], knots[1:], *rivet_splines.constants(knots)])
        cells = ",\n".join(f"    {{{', '.join(map(repr, row))}}}" for row in rows.tolist())
        parts.append(f"static const RivetCell {name}_cell[{len(rows)}] = {{\n{cells}}};\n")
        parts.append(_array(f"{name}_bin", bin_cells(knots), "unsigned char"))
        start, end = float(knots[0]), float(knots[-1])
        axes.append(f"{{{len(rows)}, {start!r}, {end!r}, {BINS / (end - start)!r}, {name}_cell, {name}_bin}}")
    channel = rivet_table.CHANNELS.index
    half_arrays, half = _half_source(t.half)
    mode_arrays, modes = _modes_source(t)
    parts += [
        _array("primary", shank.coefficients[..., [channel("head_p1"), channel("mid_vm")]], "float"),
        _array("secondary", shank.coefficients[..., [channel("head_vm"), channel("mid_p1")]], "float"),
        _array("j2_fit_a", t.fit_a),
        _array("j2_fit_eff", t.fit_eff),
        _array("j2_slope", t.fit_slope),
        _array("hole_fit", t.joint["hole_fit"]),
        _array("k_hole", t.joint["k_hole"]),
        *half_arrays,
        *mode_arrays,
    ]
    joint = {key: float(t.joint[key]) for key in rivet_table.JOINT_KEYS} | {
        "k_rivet": t.half.k_open,
        "k_plate": t.half.k_closed - t.half.k_open,
    }
    joint = ", ".join(f".{key} = {float(value)!r}" for key, value in joint.items())
    parts.append(f"""
const RivetTable rivet_table = {{
    .kind = {t.kind_number}, .digest = "@digest@", .Z = {t.Z}, .moment_length = {float(shank.length)!r},
    .axis = {{{", ".join(axes)}}},
    .primary = primary, .secondary = secondary, .head_friction = {float(t.head_friction)!r}, .head_friction_vm = {float(t.head_friction_vm)!r},
    .yield_rivet = {float(t.yield_rivet)!r}, .fit_flange_yield = {float(t.fit_flange_yield)!r},
    .j2 = {{{len(t.fit_a)}, j2_fit_a, j2_fit_eff, j2_slope}},
    .joint = {{{joint},
              .hole_count = {len(t.joint["hole_fit"])}, .hole_fit = hole_fit, .k_hole = k_hole}},
    .half = {half},
    .modes = {modes}}};
// clang-format on
""")
    text = "".join(parts)
    return text.replace("@digest@", hashlib.sha256(text.encode()).hexdigest())


def main(arguments=None):
    """Command line; returns 0, or 2 with a message if the table cannot be used (then nothing is written)."""
    parser = argparse.ArgumentParser(prog="python -m rivet_model.embed", description=__doc__)
    parser.add_argument("table")
    parser.add_argument("out")
    parser.add_argument("--Z", type=int, help="number of rivets that the build needs")
    options = parser.parse_args(arguments)
    try:
        text = c_source(rivet_table.read(options.table, options.Z))
        Path(options.out).write_text(text, encoding="utf-8")
    except (OSError, ValueError) as error:
        print(f"rivet table: {error}", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
