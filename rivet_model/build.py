"""Finite elements to table: python -m rivet_model.build OUT.json [GEOMETRY.toml] [--coarse] [--workers 2]

About 20 minutes on two cores for the shipped fineness, most of it contact solutions; --coarse takes seconds and is for
tests and first looks. The file is written last and in one piece, so that an error leaves no table behind.
"""

import argparse
import os
import sys
import time
from dataclasses import replace
from pathlib import Path

import numpy as np
from threadpoolctl import threadpool_limits

from bearing_model.rivet import rivet_table

from . import (
    half,
    half_loads,
    half_modes,
    half_shape,
    half_strength,
    impacts,
    land_bending,
    plastic_fit,
    reduction,
    stiffness,
    table,
)
from .geometry import Geometry
from .load_cases import COARSE, SHIPPED, TRUTH, Joint
from .section_mesh import Fineness

RULE = "direction of M: linear in chi between the sheets, (2 chi)^1.5 in the middle below 1/2"


def _quiet(stage, done, total):
    pass


@threadpool_limits.wrap(limits=1)
def make_table(geometry, coarse=False, workers=2, progress=_quiet, hold_out=320, modes=None):
    """Table of kind fe, or fe_coarse.

    progress(stage, done, total) is called as the work goes on; hold_out: number of fresh loads for the error in the
    header (0 leaves it out), solved on a finer grid of angles, of a coarse table on its own: there it is the
    interpolation that errs; modes: of a cage half, pairs counted as two, None: as many as half_modes.default_count.
    Raises ValueError for a geometry that cannot be meshed, ArithmeticError if a contact or plasticity solution is not
    found.
    """
    grid, knots = (COARSE, reduction.COARSE) if coarse else (SHIPPED, reduction.FULL)
    knots = reduction.knots_for(geometry, knots)

    def stage(name):
        return lambda done, total: progress(name, done, total)

    half_shape.check_half(geometry)  # before minutes are spent on the rivet
    count = half_modes.default_count(geometry.Z) if modes is None else modes
    half_modes.check_count(count, geometry.Z)
    joint = Joint(geometry, grid, stage("elements"))
    samples = reduction.sample(joint, knots, workers, stage("contacts"))
    fine = Fineness(0.5) if coarse else Fineness()
    fit = plastic_fit.plastic_fit(geometry, fine=fine, progress=stage("interference"))
    elastic = half_loads.elastic_half(geometry, half.COARSE if coarse else None)
    alone = half_loads.JointAlone(elastic)
    cage = made_half(elastic, alone, stage("cage half"))
    vibration, report = made_modes(elastic, alone, cage, count, stage("modes"))
    result = assemble("fe_coarse" if coarse else "fe", joint, knots, samples, fit, cage, vibration)
    if hold_out:
        result.errors |= measured_errors(
            result, joint if coarse else Joint(geometry, TRUTH), hold_out, workers, stage("hold-out")
        )
    result.errors["modes"] = report
    return result


def made_half(elastic, alone, progress=lambda done, total: None):
    """HalfData of a condensed half, of a ribbon with the bending of its lands and its strength."""
    made = half_loads.make_half(elastic, alone, progress)
    if elastic.g.shape != "ribbon":
        return made
    return replace(land_bending.with_bending(made, elastic, alone), yield_force=half_strength.yield_force(elastic))


def made_modes(elastic, alone, cage, count, progress=lambda done, total: None):
    """HalfModes of a condensed half and the header's entries on their error; cage: HalfData."""
    modes, found = half_modes.half_modes(elastic, alone, count, progress)
    inertia = half_shape.Inertia(cage.m, cage.x_c, cage.J_p, cage.J_t)
    return half_modes.with_law(modes, alone), impacts.modes_error(elastic.g, inertia, modes, found)


def other_modes(table, count=None, progress=_quiet):
    """A table of full finite elements with its modes made again, or another number of them."""
    count = half_modes.default_count(table.Z) if count is None else count
    half_modes.check_count(count, table.Z)
    elastic = half_loads.elastic_half(Geometry(**table.geometry))
    modes, report = made_modes(
        elastic, half_loads.JointAlone(elastic), table.half, count, lambda done, total: progress("modes", done, total)
    )
    return replace(table, modes=modes, errors=table.errors | {"modes": report})


def assemble(kind, joint, knots, samples, fit, cage, modes):
    """The table from its parts; cage: HalfData; modes: HalfModes."""
    geometry = joint.geometry
    _, head, head_vm = stiffness.head_friction(joint)
    return table.make(
        geometry,
        kind,
        reduction.bending_length(geometry),
        knots,
        samples / rivet_table.MPA_PER_N,
        (fit.fit_a, fit.fit_eff),
        stiffness.joint_data(joint),
        cage,
        modes=modes,
        head_friction=float(head),
        head_friction_vm=float(head_vm),
        fit_flange_yield=fit.flange_yield,
        note="finite elements: Fourier harmonics, frictionless unilateral contact, interference with J2 plasticity; "
        f"bore angles near contact {joint.grid.step:g} degrees, {joint.grid.n_max} harmonics, mesh factor {joint.grid.fine.factor:g}",
    )


def measured_errors(result, joint, count, workers, progress, seed=2026):
    """Errors of the table against fresh solutions on another, finer grid of angles; as fractions of the channels'
    maxima.
    """
    loads = reduction.random_loads(count, seed, size=joint.geometry.size)
    errors = reduction.hold_out_errors(result, loads, reduction.solve_loads(joint, loads, workers, progress))
    return errors | {"seed": seed, "angles": len(joint.angles["UB"]), "harmonics": joint.grid.n_max, "rule": RULE}


def main(arguments=None):
    """Command line; returns 0, or 2 with a message and no file."""
    parser = argparse.ArgumentParser(prog="python -m rivet_model.build", description=__doc__)
    parser.add_argument("out")
    parser.add_argument("geometry", nargs="?")
    parser.add_argument("--coarse", action="store_true")
    parser.add_argument(
        "--modes", type=int, help="modes of a cage half, a pair counted as two (default: 40 for nine rivets)"
    )
    parser.add_argument("--workers", type=int, default=min(2, os.cpu_count() or 1))
    options = parser.parse_args(arguments)
    if not Path(options.out).resolve().parent.is_dir():
        parser.error(f"{options.out}: no such folder")
    shown = {"at": 0.0}

    def progress(stage, done, total):
        if done == total or time.monotonic() - shown["at"] > 2.0:
            shown["at"] = time.monotonic()
            print(f"\r{stage:>12} {done}/{total}", end="\n" if done == total else "", file=sys.stderr, flush=True)

    try:
        geometry = Geometry.from_toml(options.geometry) if options.geometry else Geometry()
        result = make_table(geometry, options.coarse, options.workers, progress, modes=options.modes)
        partial = Path(f"{options.out}.part")
        table.write(result, partial)
        partial.replace(options.out)
    except (OSError, ValueError, ArithmeticError, np.linalg.LinAlgError) as error:
        print(f"rivet table: {error}", file=sys.stderr)
        return 2
    for region, report in ((k, v) for k, v in result.errors.items() if isinstance(v, dict) and "maximum" in v):
        print(
            region,
            *(
                f"{name} max {100 * report['maximum'][name]:.2f} % rms {100 * report['rms'][name]:.2f} %"
                for name in rivet_table.CHANNELS
            ),
            sep="  ",
        )
    report = result.errors["modes"]
    shares = (
        f"{name} RMS {100 * report['rms'][name]:.2g} % p99.9 {100 * report['p999'][name]:.2g} %"
        for name in report["rms"]
    )
    print(f"{report['modes']} modes", *shares, sep="  ")
    return 0


if __name__ == "__main__":
    sys.exit(main())
