"""Sweeps: many runs of the FMU on a Dask cluster, one row each in a Parquet dataset.

    description = "..."
    scene = "demo"                       # shipped name or file, relative to the sweep's own; default: none, the FMU's own parameters and inputs
    repeats = 8                          # start.seed = 1 ... 8; default: the scene's seed
    [simulation]                         # as in a scene file; outputs are sampled at the communication points
    [parameters]                         # as in a scene file, for all runs
    [inputs]

    [[vary]]                             # each block is an axis of the design, all axes are crossed
    joint.preload = ["0 N", "20 N"]      # a list ...
    [[vary]]
    shaft.omega = { from = "4000 rev/min", to = "24000 rev/min", count = 6 }     # ... or a range, spacing = "linear" or "log"
    [[vary]]                             # entries of one block go together
    shaft.F_y = ["2994 N", "2246 N"]
    shaft.F_x = ["515 N", "386 N"]
    [[vary]]
    scene = ["R", "F"]                   # scenes can vary, and simulation.tolerance, simulation.t_end ...

    [sample]                             # one more axis: points spread over a box
    method = "sobol"                     # or "latin_hypercube"
    count = 64
    seed = 1
    between.joint.mu = [0.05, 0.3]       # lowest and highest value

A row holds all parameters and inputs of the run in SI units, its end (status: done, stopped by the FMU, failed), the
FMU's statistics over every internal step, solver counters, run time (cpu_time of the simulation, whole_cpu_time with
its start and end), and of each sampled output mean, rms, min, max and the quantiles p001 and p999 (0.1 and 99.9 %)
after start.settle, as `mean(ring.y)`. Rows are written as they arrive, a few in a file where they arrive fast, each
file whole or not at all; a second call does only runs that are missing or failed.
"""

import contextlib
import hashlib
import itertools
import json
import math
import time
import uuid
from concurrent.futures import CancelledError
from dataclasses import dataclass, field
from datetime import UTC, datetime
from pathlib import Path

import numpy as np
from filelock import FileLock, Timeout

from .basis import basis
from .errors import UserError, is_file, unknown
from .file_kinds import check_keys
from .fmu import Model
from .interrupts import held_interrupts, ignored_interrupts, kept_from_children
from .results import KEY, make_folder, one_line, read_table, write_atomically, write_table
from .runner import closing_names, simulate
from .scene import SIMULATION, leaves, load_scene, read_toml, refusal, section_of, shipped_scenes
from .summary import has_statistics, settled
from .units import SECONDS, check_alike, to_si
from .version import __version__

SECTIONS = ("description", "scene", "repeats", "simulation", "parameters", "inputs", "vary", "sample")
SAMPLE = ("method", "count", "seed", "between")
RANGE = ("from", "to", "count", "spacing")
SETTINGS = {
    "simulation.t_end": SECONDS,
    "simulation.step": SECONDS,
    "simulation.output_interval": SECONDS,
    "simulation.tolerance": {"1": (1.0, 0.0)},
}
SAMPLED = ("cage.dislocation", "rivet[*].sigma_head", "rivet[*].sigma_mid")  # unless simulation.outputs names others
WORDS = ("description", "source", "replaced", "units", "oil")  # of a scene: no other run
KINDS = {
    "mean": np.mean,
    "rms": lambda x: np.sqrt(np.mean(x**2)),
    "min": np.min,
    "max": np.max,
    "p001": lambda x: np.quantile(x, 0.001),
    "p999": lambda x: np.quantile(x, 0.999),
}
ROW_VERSION = 2
MOST_RUNS = 1_000_000  # of a design, all of which is in memory
RUN_MEMORY = 7e3  # of a run in a design [B], measured
RUN_PLANNING = 0.01  # time to read and check a run's scene [s], measured
WRITING = 0.05  # of the time at most goes into files of rows
ROWS = "runs.parquet"
SUPERSEDED = "_superseded"  # readers of Parquet datasets pass over names that begin so


@dataclass(frozen=True)
class Sweep:
    """A design of experiments checked against its Model: scenes by key, and the names that vary."""

    name: str
    description: str
    model: Model
    fmu: bytes = field(repr=False)  # content of the file when the design was made
    document: dict
    factors: tuple
    scenes: dict = field(repr=False)  # key -> Scene, in the order in which they are run
    # further columns of a row: function of a run's Result that gives them by name, and function that gives their fields
    further: tuple = ()
    grows: bool = False  # whether further runs may join the design: rows that do not belong to it are kept


def load_sweep(path, model):
    """Read a sweep's TOML file; raises UserError naming file, key, value and what is allowed."""
    path = Path(path)
    if not path.is_file():
        raise UserError(f"{path}: no such sweep file")
    return plan_sweep(path.stem, read_toml(path), model, path)


def plan_sweep(name, document, model, path):
    """The Sweep of a document like the file's; path: of the file, for messages and to find the scene files that it
    names.
    """
    check_keys(path, document, SECTIONS, "sweep")
    axes = [
        *vary_axes(path, document.get("vary", []), model),
        *sample_axes(path, section_of(path, document, "sample"), model),
    ]
    if "repeats" in document:
        axes.insert(0, [{"start.seed": seed} for seed in range(1, points_of(path, "repeats", document["repeats"]) + 1)])
    limit_runs(path, "design", math.prod(len(axis) for axis in axes))
    factors = tuple(name for axis in axes for name in axis[0])
    if twice := {name for name in factors if factors.count(name) > 1}:
        raise UserError(f"{path}: {', '.join(sorted(twice))} varies in more than one place")
    common = {section: section_of(path, document, section) for section in ("simulation", "parameters", "inputs")}
    common["simulation"] = {"outputs": list(SAMPLED)} | common["simulation"]
    fmu = model.path.read_bytes()
    fingerprint = hashlib.sha256(fmu).hexdigest()
    scenes = {}
    for point in itertools.product(*axes):
        settings = {name: value for part in point for name, value in part.items()}
        source = settings.pop("scene", document.get("scene"))
        scene = load_scene(beside(path, source), model, (str(path), common), (str(path), sections_of(settings, model)))
        key = key_of(scene, fingerprint)
        if key in scenes:
            raise UserError(f"{path}: the same run occurs twice: {settings}")
        scenes[key] = scene
    return Sweep(name, str(document.get("description", "")), model, fmu, document, factors, scenes)


def vary_axes(path, blocks, model):
    """The axes of [[vary]]: for each block a list of points, {name: value as in a scene file}."""
    if not isinstance(blocks, list) or not all(isinstance(block, dict) and block for block in blocks):
        raise UserError(f"{path}: vary: write [[vary]] with a name and a list below it")
    return [vary_axis(path, block, model) for block in blocks]


def vary_axis(path, block, model):
    """One axis: the entries of its names go together."""
    values = {name: values_of(path, name, value, model) for name, value in leaves(block, known_names(model))}
    lengths = {name: len(value) for name, value in values.items()}
    if len(set(lengths.values())) != 1:
        raise UserError(f"{path}: vary: entries of one block go together, but their numbers differ: {lengths}")
    return [dict(zip(values, point, strict=True)) for point in zip(*values.values(), strict=True)]


def known_names(model):
    """Names of everything that can vary."""
    return ["scene", *(f"simulation.{key}" for key in SIMULATION), *model.parameters, *model.inputs]


def values_of(path, name, value, model):
    """The values of a factor from a list or a range."""
    if name not in known_names(model):
        raise unknown(path, "parameter, input or setting", name, known_names(model))
    if isinstance(value, list) and value:
        variable = (model.parameters | model.inputs).get(name)
        try:
            check_alike(value, SETTINGS.get(name) or model.units[getattr(variable, "unit", None) or "1"])
        except UserError as problem:
            raise refusal(path, f"vary.{name}", value, problem) from None
        return value
    if not isinstance(value, dict) or not {"from", "to", "count"} <= set(value) <= set(RANGE):
        raise refusal(
            path,
            f"vary.{name}",
            value,
            'a list or { from = ..., to = ..., count = ..., spacing = "linear" or "log" } is needed',
        )
    low, high, count = (
        *bounds(path, name, (value["from"], value["to"]), model),
        points_of(path, f"vary.{name}.count", value["count"]),
    )
    spacing = value.get("spacing", "linear")
    if spacing not in ("linear", "log"):
        raise refusal(path, f"vary.{name}.spacing", spacing, "allowed: linear, log")
    if spacing == "log" and low * high <= 0.0:
        raise refusal(path, f"vary.{name}", value, "a logarithmic range needs two ends of one sign, not 0")
    return (np.linspace if spacing == "linear" else np.geomspace)(low, high, count).tolist()


def bounds(path, name, pair, model):
    """Two SI values of a Real parameter, an input or a setting of [simulation]."""
    variable = (model.parameters | model.inputs).get(name)
    if name in SETTINGS:
        scales = SETTINGS[name]
    elif variable is not None and variable.type == "Real":
        scales = model.units[variable.unit]
    else:
        raise refusal(path, name, list(pair), "only real numbers have ranges: list the values instead")
    try:
        check_alike(pair, scales)
        return tuple(to_si(value, scales) for value in pair)
    except UserError as problem:
        raise refusal(path, name, list(pair), problem) from None


def count_of(path, name, value):
    """A whole number of at least 1."""
    if isinstance(value, bool) or not isinstance(value, int) or value < 1:
        raise refusal(path, name, value, "a whole number from 1 on is needed")
    return value


def points_of(path, name, value):
    """A number of points of a design, checked before there is memory for them."""
    limit_runs(path, f"{name} = {value}", count_of(path, name, value))
    return value


def limit_runs(path, what, runs):
    """UserError if a design has more runs than its memory is meant for."""
    if runs > MOST_RUNS:
        memory, hours = 1e-9 * RUN_MEMORY * runs, RUN_PLANNING * runs / 3600.0
        raise UserError(
            f"{path}: {what}: {runs:,} runs would take {memory:,.0f} GB of memory and {hours:,.0f} h before the first one; at most {MOST_RUNS:,} are allowed"
        )


def sample_axes(path, section, model):
    """The axis of [sample], if there is one: points of a Latin hypercube or a Sobol sequence (scrambled) in the box
    `between`.
    """
    if not section:
        return []
    from scipy.stats import qmc

    for key in section:
        if key not in SAMPLE:
            raise unknown(path, "key", f"sample.{key}", [f"sample.{name}" for name in SAMPLE])
    box = dict(leaves(section_of(f"{path}: sample", section, "between"), known_names(model)))
    if not box:
        raise UserError(
            f"{path}: sample.between: name at least one parameter or input with its lowest and highest value"
        )
    for name, pair in box.items():
        if name not in known_names(model):
            raise unknown(path, "parameter or input", name, known_names(model))
        if not isinstance(pair, list) or len(pair) != 2:
            raise refusal(path, f"sample.between.{name}", pair, "[lowest, highest] is needed")
    low, high = np.array([bounds(path, name, pair, model) for name, pair in box.items()]).T
    if not np.all(low < high):
        raise refusal(path, "sample.between", section["between"], "each lowest value must be below its highest")
    methods = {"latin_hypercube": qmc.LatinHypercube, "sobol": qmc.Sobol}
    method, seed = section.get("method"), section.get("seed", 0)
    if not isinstance(method, str) or method not in methods:
        raise refusal(path, "sample.method", method, f"allowed: {', '.join(methods)}")
    if isinstance(seed, bool) or not isinstance(seed, int) or seed < 0:
        raise refusal(path, "sample.seed", seed, "a whole number from 0 on is needed")
    count = points_of(path, "sample.count", section.get("count"))
    if method == "sobol" and count & (count - 1):
        raise refusal(path, "sample.count", count, "a Sobol sequence is balanced only for powers of 2")
    points = methods[method](d=len(box), seed=seed).random(count)
    return [[dict(zip(box, point, strict=True)) for point in qmc.scale(points, low, high).tolist()]]


def beside(path, source):
    """A scene's name or file, looked for beside the sweep's file; None, the FMU's own parameters and inputs, stays
    None.
    """
    if source is not None and not isinstance(source, str):
        raise refusal(path, "scene", source, "a shipped scene's name or a file is needed")
    if source is None or source in shipped_scenes() or Path(source).is_absolute():
        return source
    file = Path(path).parent / source
    if not is_file(file):
        if not file.suffix:
            raise unknown(f"{path}: scene", "name", source, shipped_scenes())
        raise UserError(f"{path}: scene: {file}: no such scene file")
    return file


def sections_of(settings, model):
    """A point of the design as a document like a scene file's."""
    document = {"simulation": {}, "parameters": {}, "inputs": {}}
    for name, value in settings.items():
        if name.startswith("simulation."):
            document["simulation"][name.removeprefix("simulation.")] = value
        else:
            document["inputs" if name in model.inputs else "parameters"][name] = value
    return document


def key_of(scene, fingerprint):
    """Key of a run: a digest of the FMU's content and of everything in the scene."""
    content = {name: value for name, value in vars(scene).items() if name not in WORDS} | {
        "inputs": {
            name: (history.t.tolist(), history.value.tolist(), history.hold) for name, history in scene.inputs.items()
        },
        "fmu": fingerprint,
        "row": ROW_VERSION,
    }
    return hashlib.sha256(json.dumps(content, sort_keys=True).encode()).hexdigest()[:24]


# What a worker does ---------------------------------------------------------------------------------------------------


def perform(scene, fmu, measure=None):
    """Run a scene through the FMU given as bytes; returns the measured part of the row, with what measure(result) finds
    if it is given.
    """
    started, cpu = datetime.now(UTC).isoformat(timespec="milliseconds"), time.thread_time()
    try:
        result = simulate(unpacked(fmu), scene)
    except UserError as problem:
        return {"status": "failed", "message": str(problem), "date": started}
    late = settled(result)
    sampled = {
        f"{kind}({name})": float(of(result.data[name][late])) for name in scene.outputs for kind, of in KINDS.items()
    }
    about = {
        "status": "stopped" if result.stopped else "done",
        "message": result.stopped,
        "date": started,
        "whole_cpu_time": time.thread_time() - cpu,
    }
    summary = result.summary
    if not has_statistics(result):  # those of a single step, at start.settle, would look like some
        summary = {name: math.nan if name.startswith("stat.") else value for name, value in summary.items()}
    return about | summary | sampled | (measure(result) if measure else {})


def unpacked(fmu):
    """The Model of an FMU given as bytes, kept as a file in the worker's own folder; one Model a process."""
    from distributed import get_worker

    path = Path(get_worker().local_directory) / f"{hashlib.sha256(fmu).hexdigest()}.fmu"
    if path not in MODELS:
        if not path.is_file():
            write_atomically(path, lambda temporary: temporary.write_bytes(fmu))
        MODELS[path] = Model(path)
    return MODELS[path]


MODELS = {}  # by path


# What the driver does -------------------------------------------------------------------------------------------------


class cluster:
    """A Dask client, as a context manager: of the scheduler at `address`, or of `workers` processes of its own with one
    thread each.
    """

    def __init__(self, address=None, workers=None):
        self.address, self.workers = address, workers

    def __enter__(self):
        import logging

        import dask
        from distributed import Client, LocalCluster

        dask.config.set({"distributed.admin.large-graph-warning-threshold": "64MB"})  # the FMU travels inside the graph
        # run_sweep says in one line what a lost scheduler means
        logging.getLogger("distributed.client").setLevel(logging.CRITICAL)
        if self.address:
            self.local = None
            try:
                self.client = Client(self.address, timeout="20s")
            except (OSError, ValueError) as problem:
                raise UserError(f"--scheduler {self.address}: {problem}") from None
        else:
            # what matters is in the rows
            here = {"host": "127.0.0.1", "dashboard_address": "127.0.0.1:0", "silence_logs": logging.CRITICAL + 1}
            with kept_from_children() as interrupts:  # a terminal sends Ctrl-C to the workers too
                self.local = LocalCluster(n_workers=self.workers, threads_per_worker=1, processes=True, **here)
                self.client = Client(self.local)
            if interrupts.pending:
                self.__exit__()
                raise KeyboardInterrupt
        return self.client

    def __exit__(self, *_):
        with ignored_interrupts():
            self.client.close()
            if self.local:
                self.local.close()


def run_sweep(sweep, folder, client, progress=None, keys=None):
    """Do the runs that a sweep's folder lacks and return the rows that it then has.

    folder: of the Parquet dataset, made if need be; client: of a Dask cluster whose workers have this package (the FMU
    travels with the runs); progress: called with the numbers of runs done, failed, and in all; keys: of the runs that
    are wanted, None for all. A worker that dies is replaced by another; its run counts once.
    A run that fails is a row with status and message, and is tried again in the next call.
    """
    folder = Path(folder)
    with alone_in(folder):
        return run_missing(sweep, folder, client, progress or (lambda *_: None), keys)


@contextlib.contextmanager
def alone_in(folder):
    """No second sweep writes to the folder meanwhile; UserError if one does already."""
    make_folder(folder)
    try:
        with FileLock(folder / ".lock", timeout=0):
            yield
    except Timeout:
        raise UserError(
            f"{folder}: another sweep is writing to this folder: wait until it has ended, or name another folder with --out"
        ) from None


def run_missing(sweep, folder, client, progress, keys):
    """run_sweep without a second one in the same folder."""
    from distributed import as_completed

    schema, design, keys = schema_of(sweep), list(sweep.scenes), list(keys or sweep.scenes)
    store = RowStore(folder, schema)
    finished = compact(folder, schema, design, sweep.grows) & set(keys)
    done, failed = len(finished), 0
    progress(done, failed, len(keys))
    # as a task, so that Dask makes it again if its workers die
    fmu = client.submit(bytes, sweep.fmu, key=f"fmu-{hashlib.sha256(sweep.fmu).hexdigest()}")
    futures = [
        client.submit(perform, sweep.scenes[key], fmu, *sweep.further[:1], key=f"run-{key}")
        for key in keys
        if key not in finished
    ]
    try:
        completed = as_completed(futures)
        for future in completed:
            # with its worker: the scheduler has it done again
            if future.status == "lost" and client.status == "running":
                completed.add(future)
                continue
            found = outcome(future)
            if found is None:
                raise UserError(
                    f"the Dask scheduler is gone after {done + failed} of {len(keys)} runs; they are in {folder}, the same command does the others"
                )
            key = future.key.removeprefix("run-")
            row = about_run(sweep, key) | found
            future.release()
            store.add(row)
            done, failed = (done + 1, failed) if row["status"] == "done" else (done, failed + 1)
            progress(done, failed, len(keys))
    finally:
        with ignored_interrupts():
            store.write()
            client.cancel(futures)
    compact(folder, schema, design, sweep.grows)
    return columns_of(folder)


def outcome(future):
    """A worker's part of a row, or the reason why there is none; None if the scheduler is gone, be it between the news
    of the run's end and its result.
    """
    from distributed.comm import CommClosedError

    if future.status == "finished":
        with contextlib.suppress(CommClosedError, CancelledError):
            return future.result()
    if future.status in ("finished", "cancelled", "lost"):
        return None
    return {
        "status": "failed",
        "message": f"no result: {future.exception()!r}",
        "date": datetime.now(UTC).isoformat(timespec="milliseconds"),
    }


def about_run(sweep, key):
    """The driver's part of a row: parameters, inputs and settings of the run."""
    scene, model = sweep.scenes[key], sweep.model
    row = {"key": key, "scene": scene.name, "t_end": scene.t_end, "step": scene.step}
    row |= {name: scene.parameters.get(name, model.default(variable)) for name, variable in model.parameters.items()}
    row["solver.tol"] = row["solver.tol"] if scene.tolerance is None else scene.tolerance
    for name, variable in model.inputs.items():
        history = scene.inputs.get(name)
        # None: varies in time
        row[name] = (
            model.default(variable) if history is None else float(history.value[0]) if len(history.t) == 1 else None
        )
    return row


def schema_of(sweep):
    """Columns of the dataset with their units; the design itself in the metadata."""
    import pyarrow as pa

    model = sweep.model
    units = {
        name: v.unit or "1" for name, v in (model.parameters | model.inputs | model.outputs | model.locals).items()
    }
    kinds = {"Real": pa.float64(), "Integer": pa.int64(), "Enumeration": pa.string()}
    outputs = dict.fromkeys(name for scene in sweep.scenes.values() for name in scene.outputs)
    fields = [pa.field(name, pa.string()) for name in ("key", "scene", "status", "message", "date")]
    fields += [pa.field("run", pa.int64())]
    fields += [
        pa.field(name, pa.float64(), metadata={"unit": "s"})
        for name in ("t_end", "step", "simulated_time", "cpu_time", "whole_cpu_time", "wall_time")
    ]
    fields += [
        pa.field(name, kinds[v.type], metadata={"unit": units[name]})
        for name, v in (model.parameters | model.inputs).items()
    ]
    fields += [pa.field(name, pa.float64(), metadata={"unit": units[name]}) for name in closing_names(model)]
    fields += [
        pa.field(f"{kind}({name})", pa.float64(), metadata={"unit": units[name]}) for name in outputs for kind in KINDS
    ]
    fields += [further for give in sweep.further[1:] for further in give()]
    about = {
        "format": ROW_VERSION,
        "sweep": sweep.name,
        "description": sweep.description,
        "document": sweep.document,
        "factors": sweep.factors,
        "basis": dict(basis(model, sweep.scenes.values())),
        "guid": model.description.guid,
        "version": __version__,
    }
    return pa.schema(fields, metadata={KEY: json.dumps(about)})


class RowStore:
    """Writes rows as they arrive: one file a row, or several rows a file where single ones would take more than WRITING
    of the time.

    A process that is killed loses the rows of the last moments, twenty times as long as a file takes: those runs are
    done again.
    """

    def __init__(self, folder, schema, clock=time.monotonic):
        self.folder, self.schema, self.clock, self.rows, self.due = folder, schema, clock, [], 0.0

    def add(self, row):
        """Take a row, which an interrupt leaves in a file; KeyboardInterrupt once it is there."""
        self.rows.append(row)
        if self.clock() < self.due:
            return
        with held_interrupts() as interrupts:
            self.write()
        if interrupts.pending:
            raise KeyboardInterrupt

    def write(self):
        """Write what has been taken."""
        if self.rows:
            begin = self.clock()
            write_rows(self.folder / f"run-{self.rows[0]['key']}.parquet", self.rows, self.schema)
            end = self.clock()
            self.rows, self.due = [], end + (end - begin) / WRITING


def write_rows(path, rows, schema):
    """Write rows as a Parquet file, whole or not at all; columns without a value are null."""
    import pyarrow as pa

    table = pa.Table.from_pylist(rows, schema=schema)
    write_atomically(path, lambda temporary: write_table(table, temporary))


def read_rows(path):
    """The Arrow table of a file of rows; UserError if it is damaged or something else."""
    try:
        table = read_table(path)
        if KEY.encode() not in (table.schema.metadata or {}) or not {"key", "status", "run"} <= set(table.column_names):
            raise ValueError("no table of runs")
        return table
    except Exception as problem:  # pyarrow has many
        raise UserError(
            f"{path}: not a result of a sweep, or damaged: {one_line(problem)}; without this file its runs are done again"
        ) from None


def compact(folder, schema, keys, grows=False):
    """Put all rows into one file, in the order of the design and each run once; returns the keys of the runs that are
    done.

    If the design or the FMU has changed, the rows that no longer belong to the design go to a folder that readers pass
    over, or behind the others if the design grows.  The new file is written before the old ones are removed; a process
    that is killed in between leaves rows twice, until the next call.
    """
    import pyarrow as pa

    whole = folder / ROWS
    # what an earlier call has put together, then what came after
    files = sorted(folder.glob("[!._]*.parquet"), key=lambda path: (path != whole, path))
    if not files:
        return set()
    table = pa.concat_tables([schema.empty_table(), *(read_rows(path) for path in files)], promote_options="default")
    facts = zip(*(table[name].to_pylist() for name in ("key", "status")), strict=True)
    # whatever the clocks say
    latest = {key: i for _, i, key in sorted((status == "done", i, key) for i, (key, status) in enumerate(facts))}
    if grows:
        keys = list(dict.fromkeys([*keys, *latest]))
    wanted = set(keys)
    if foreign := [i for key, i in latest.items() if key not in wanted]:
        path = folder / SUPERSEDED / f"{datetime.now(UTC):%Y%m%d-%H%M%S}-{uuid.uuid4().hex[:8]}.parquet"
        write_atomically(path, lambda temporary: write_table(table.take(foreign), temporary))
    places = {key: place for place, key in enumerate(keys) if key in latest}
    kept = table.take(pa.array([latest[key] for key in places], pa.int64())).select(schema.names).cast(schema)
    kept = kept.set_column(
        schema.get_field_index("run"), schema.field("run"), pa.array(list(places.values()), pa.int64())
    )
    write_atomically(whole, lambda temporary: write_table(kept.replace_schema_metadata(schema.metadata), temporary))
    for path in files:
        if path != whole:
            path.unlink()
    return {
        key for key, status in zip(kept["key"].to_pylist(), kept["status"].to_pylist(), strict=True) if status == "done"
    }


def columns_of(folder):
    """The rows of a sweep's folder by column name, as numpy arrays; raises UserError if there are none."""
    path = Path(folder) / ROWS
    if not path.is_file():
        raise UserError(f"{path}: no such sweep result")
    table = read_rows(path)
    return {name: table[name].to_numpy() for name in table.column_names}
