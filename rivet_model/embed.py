"""Write a rivet table as C constants: python -m rivet_model.embed TABLE OUT.c [--Z 9].  Needs numpy only; the same table gives the same bytes."""

import argparse
import hashlib
import sys
from pathlib import Path

import numpy as np

from bearing_model import rivet_splines, rivet_table

BINS = 256  # RIVET_BINS in fmu_src/rivet_rom.h


def _array(name, values, kind="double"):
    text = [repr(value) + "f" * (kind == "float") for value in np.ravel(values).tolist()]
    lines = [", ".join(text[i : i + 8]) for i in range(0, len(text), 8)]
    return f"static const {kind} {name}[{len(text)}] = {{\n    " + ",\n    ".join(lines) + "};\n"


def bin_cells(knots):
    """Cell in which each of BINS equal bins begins; if a knot lies at the start of a bin, the cell below the
    knot counts, because rounding may put a point just below the knot into this bin.

    >>> bin_cells(np.array([0.0, 0.5, 1.0]))[[0, 127, 128, 129, 256]]
    array([0, 0, 0, 1, 1])
    """
    starts = knots[0] + (np.arange(BINS + 1) - 1e-6) * (knots[-1] - knots[0]) / BINS
    return np.searchsorted(knots[1:-1], starts, side="right")


def path_columns(load_path):
    """The load path's matrix [Z, 5, 3] as the C reader wants it, [F_t > 0 and < 0, 5, 3, PATH_WIDTH]: F_t < 0 is the mirror image about the pocket."""
    columns = np.moveaxis(load_path, 0, -1)
    back = columns.copy()
    back[:, 2] = columns[:, 2, ::-1] * np.array([1.0, 1.0, -1.0, -1.0, 1.0])[:, None]  # rivet -1 - i for i; V_t and M_r change sign
    Z = columns.shape[-1]
    lanes = -(-Z // 8) * 8  # as in fmu_src/lanes.h
    return np.stack([columns, back])[..., (np.arange(lanes + Z - 1) - (Z - 1)) % Z]


def c_source(t):
    """The C text of rivet_table.c."""
    parts = [
        f"// The rivet table, kind {t.kind}, geometry {t.geometry_hash}: written by rivet_model/embed.py, not to be edited.\n",
        '#include "load_path.h"\n#include "rivet_rom.h"\n\n',
        f'_Static_assert(Z == {t.Z}, "the rivet table was made for Z = {t.Z}");\n\n// clang-format off\n',
    ]
    axes = []
    for name in rivet_table.AXES:
        knots = t.knots[name]
        rows = np.column_stack([knots[:-1], knots[1:], *rivet_splines.constants(knots)])
        cells = ",\n".join(f"    {{{', '.join(map(repr, row))}}}" for row in rows.tolist())
        parts.append(f"static const RivetCell {name}_cell[{len(rows)}] = {{\n{cells}}};\n")
        parts.append(_array(f"{name}_bin", bin_cells(knots), "unsigned char"))
        start, end = float(knots[0]), float(knots[-1])
        axes.append(f"{{{len(rows)}, {start!r}, {end!r}, {BINS / (end - start)!r}, {name}_cell, {name}_bin}}")
    channel = rivet_table.CHANNELS.index
    parts += [
        _array("primary", t.coefficients[..., [channel("head_p1"), channel("mid_vm")]], "float"),
        _array("secondary", t.coefficients[..., [channel("head_vm"), channel("mid_p1")]], "float"),
        _array("j2_fit_a", t.fit_a),
        _array("j2_fit_eff", t.fit_eff),
        _array("j2_slope", t.fit_slope),
        _array("hole_fit", t.joint["hole_fit"]),
        _array("k_hole", t.joint["k_hole"]),
        _array("load_path", path_columns(t.load_path)),
        '_Static_assert(sizeof load_path == 2 * PATH_LOADS * 3 * PATH_WIDTH * sizeof *load_path, "the load path has another width");\n',
    ]
    joint = ", ".join(f".{key} = {float(t.joint[key])!r}" for key in rivet_table.JOINT_KEYS)
    parts.append(f"""
const RivetTable rivet_table = {{
    .kind = {t.kind_number}, .geometry_hash = "{t.geometry_hash}", .digest = "@digest@", .Z = {t.Z}, .moment_length = {float(t.moment_length)!r},
    .axis = {{{", ".join(axes)}}},
    .primary = primary, .secondary = secondary, .head_friction = {float(t.head_friction)!r}, .head_friction_vm = {float(t.head_friction_vm)!r},
    .yield_rivet = {float(t.yield_rivet)!r}, .fit_flange_yield = {float(t.fit_flange_yield)!r},
    .j2 = {{{len(t.fit_a)}, j2_fit_a, j2_fit_eff, j2_slope}},
    .joint = {{{joint},
              .hole_count = {len(t.joint["hole_fit"])}, .hole_fit = hole_fit, .k_hole = k_hole}},
    .load_path = load_path}};
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
