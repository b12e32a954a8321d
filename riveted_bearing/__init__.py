"""Ball bearing with a two-piece riveted cage: build its FMU, run it, and analyse a bearing without a run.

    import riveted_bearing as rb

    case = rb.info("6207")                                       # geometry, quasi-static loads, frequencies: no FMU needed
    case.equilibrium().Q_i                                       # load of each ball on the inner race [N]
    result = rb.run("demo", parameters={"joint.preload": "30 N"}, t_end=0.1)
    result.data["rivet.sigma_head_max"].max()                    # largest stress in a rivet's head [Pa]
    again = rb.read_result("results/demo.parquet")               # a file that `riveted-bearing run demo` has written
    path = rb.build("6310")                                      # an FMU for another bearing: needs a C compiler

Numbers are SI; a text carries its unit ("30 N", "18238 rev/min").  Whatever cannot be used raises UserError with one
message that names it. The command `riveted-bearing` does the same and more; docs/running.md explains both.  The physics
without an FMU is in the package bearing_model, the finite elements of the rivet in rivet_model.
"""

# The functions below import what they need when they are called: NumPy, fmpy, SciPy and matplotlib take a second.  No
# module of this package has
# the name of a function here (runner and run, builder and build), because Python would put the imported module in the
# function's place.

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from .base.errors import UserError

if TYPE_CHECKING:
    from .base.version import __version__
    from .bearing.case import Case
    from .running.results import Result, read_result, write_result

__all__ = ["Result", "UserError", "__version__", "build", "info", "read_result", "run", "write_result"]


def __getattr__(name):
    """The version, Result, read_result and write_result, when they are first asked for."""
    if name == "__version__":
        from .base.version import __version__

        return __version__
    if name in ("Result", "read_result", "write_result"):
        from .running import results

        return getattr(results, name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def __dir__():
    return [*globals(), *__all__]


def run(
    scene: str | Path | None = None,
    *,
    parameters: Mapping | None = None,
    inputs: Mapping | None = None,
    fmu: str | Path | None = None,
    seed: int | None = None,
    t_end: float | str | None = None,
    step: float | str | None = None,
    outputs: Sequence[str] | None = None,
    tolerance: float | None = None,
    accuracy: float | str | None = None,
    within: float = 600.0,
    check: bool = False,
    progress: Callable[[float], None] | None = None,
) -> "Result":
    """Simulate the FMU at its own working point, or a scene, and return the Result.

    scene: name of a shipped scene (demo, R, F, jam) or path of a TOML file, None for the FMU's own parameters and
    inputs; parameters, inputs: changes by full variable name, values as in the file (SI numbers, "30 N", item names;
    inputs also {"t": [...], "value": [...]}); fmu: path of the FMU, None for the default one;
    seed: start.seed; t_end, step: s; outputs: names or patterns; progress: called with the simulated time [s] about
    twenty times a second.  accuracy: "2 %" of stress and pocket force, for which steps and seeds are chosen in several runs of at
    most `within` seconds of processor time; check: the error budgets, for which the FMU is screened once.  Both stand in the Result's
    `about` as "accuracy" and "budget".  Raises UserError (a ValueError) naming what cannot be used.  If the FMU ends a run early, the
    Result holds the run up to that time, and its member `stopped` gives the reason.

        >>> import riveted_bearing as rb
        >>> result = rb.run("demo", parameters={"joint.preload": "30 N"}, t_end=0.01)
        >>> result.data["rivet.sigma_head_max"].max() / 1e6     # MPa
    """
    from .running.fmu import Model
    from .running.runner import simulate
    from .running.scene import load_scene

    model = Model(fmu)
    simulation = {"t_end": t_end, "step": step, "outputs": outputs, "tolerance": tolerance, "accuracy": accuracy}
    changes = {
        "simulation": {key: value for key, value in simulation.items() if value is not None},
        "parameters": dict(parameters or {}) | ({} if seed is None else {"start.seed": seed}),
        "inputs": dict(inputs or {}),
    }
    plan = load_scene(scene, model, ("run()", changes))
    if not check and plan.accuracy is None:
        return simulate(model, plan, progress)
    from .running.budget import known_result
    from .running.screen import screened

    if check:
        screened(model)
    return known_result(model, plan, check, within)


def info(target: str | Path | None = None, fmu: str | Path | None = None, *, cage: str | None = None) -> "Case":
    """Geometry, masses, loads and quasi-static equilibrium of a bearing, or of a scene at its start, without a
    simulation.

    target: designation (6207, 6008, ...), bearing file, name of a shipped scene or scene file, None for the bearing of
    the FMU, and without an FMU for the 6207; fmu: the FMU whose start values a scene begins from, None for the default
    one; cage: "machined" or "ribbon" of a bearing. Returns a Case: .bearing and .load of the quasi-static model, .values by variable name, .equilibrium() with
    loads, contact angles, pressures, stiffness, life and frequencies.  Raises UserError naming what cannot be used.

        >>> import riveted_bearing as rb
        >>> round(rb.info("6207").equilibrium().Q_i.sum())      # N
    """
    from .running.scene_case import case_of

    return case_of(target, fmu, cage)


def build(
    bearing: str | Path | None = None,
    rivet: str | Path | None = None,
    out: str | Path | None = None,
    *,
    platforms: Sequence[str] = (),
    table: str | None = None,
    cage: str | None = None,
    progress: Callable[..., None] | None = None,
) -> Path:
    """Build an FMU for a bearing and return its path: needs a C compiler and takes half a minute, for the
    first bearing with as many balls one to two.

    bearing: bearing file or designation (6008, 6308, ...), None for the 6207; rivet: rivet table (JSON) or geometry of
    the rivet (TOML), None for the bearing's own rivet; out: the FMU to write, None for my.fmu in the working directory
    from my.toml, and RivetedBearing.fmu (in a checkout: in fmus/) from the default; platforms: FMI's names, e.g.
    ["win64"], of the systems to compile for instead of this one (needs ziglang); table: "coarse" finite elements,
    "full" ones in some half an hour, or "closed-form", None for the shipped table if it was made for this rivet, else
    coarse; cage: "machined" or "ribbon", None for the bearing file's, else machined; progress: called with what is
    being done and, if known, the share done. Raises UserError with the reason; `out` is then left as it was.
    """
    from .building.builder import build_fmu, platform_names

    return build_fmu(
        bearing,
        rivet,
        out,
        progress or (lambda text, share=None: None),
        platform_names(",".join(platforms)),
        table,
        cage=cage,
    )
