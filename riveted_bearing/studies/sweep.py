"""Sweeps: many runs of the FMU on a Dask cluster, one row each in a Parquet dataset; docs/running.md has an example.

A row holds all parameters and inputs of the run in SI units, its end (status: done, stopped by the FMU, failed), the
FMU's statistics over every internal step, solver counters, run time (cpu_time of the simulation, whole_cpu_time with
its start and end), and of each sampled output KINDS after start.settle, as `mean(ring.y)`.  Rows are kept as they arrive; a
second call does only runs that are missing or failed.
"""

import contextlib
import hashlib
import json
import math
import time
from concurrent.futures import CancelledError
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

import numpy as np

from ..base.errors import UserError
from ..base.files import KEY, write_atomically
from ..base.interrupts import held_interrupts, kept_from_children
from ..base.version import __version__
from ..running.basis import basis
from ..running.fmu import Model
from ..running.runner import closing_names, simulate
from ..running.summary import has_statistics, settled
from .rows import Store, of_keys
from .sweep_file import ROW_VERSION, Sweep

KINDS = {  # of each row
    "mean": lambda x: np.mean(x, axis=1),
    "rms": lambda x: np.sqrt(np.mean(x**2, axis=1)),
    "min": lambda x: np.min(x, axis=1),
    "max": lambda x: np.max(x, axis=1),
    "p001": lambda x: np.quantile(x, 0.001, axis=1),
    "p999": lambda x: np.quantile(x, 0.999, axis=1),
}
CONFIG = {  # of Dask
    "distributed.admin.large-graph-warning-threshold": "64MB",  # the FMU travels inside the graph
    "distributed.worker.profile.enabled": False,  # nobody looks at it, and samples take time from the runs
    "distributed.admin.tick.interval": "1s",
    "distributed.admin.system-monitor.interval": "10s",
}


# What a worker does ---------------------------------------------------------------------------------------------------


def perform(scene, fmu, measure=None):
    """Run a scene through the FMU given as bytes: the measured part of the row, with measure(result)."""
    started, cpu = datetime.now(UTC).isoformat(timespec="milliseconds"), time.thread_time()
    try:
        result = simulate(unpacked(fmu), scene)
    except UserError as problem:
        return {"status": "failed", "message": str(problem), "date": started}
    late = settled(result)
    samples = np.array([result.data[name][late] for name in scene.outputs])
    sampled = {
        f"{kind}({name})": value
        for kind, of in KINDS.items()
        for name, value in zip(scene.outputs, of(samples).tolist(), strict=True)
    }
    about = {"status": "stopped" if result.stopped else "done", "message": result.stopped, "date": started}
    about["whole_cpu_time"] = time.thread_time() - cpu
    summary = result.summary
    if not has_statistics(result):  # those of a single step, at start.settle, would look like some
        summary = {name: math.nan if name.startswith("stat.") else value for name, value in summary.items()}
    return about | summary | sampled | (measure(result) if measure else {})


def unpacked(fmu: bytes) -> Model:
    """The Model of an FMU given as bytes, kept as a file in the worker's own folder; one Model a process."""
    from distributed import get_worker

    place = get_worker().local_directory, fmu
    if place not in MODELS:
        path = Path(place[0]) / f"{hashlib.sha256(fmu).hexdigest()}.fmu"
        if not path.is_file():
            write_atomically(path, lambda temporary: temporary.write_bytes(fmu))
        MODELS[place] = Model(path)
    return MODELS[place]


MODELS = {}  # by folder and bytes


# What the driver does -------------------------------------------------------------------------------------------------


class cluster:
    """A Dask client, a context manager: of a scheduler, or of own processes with one thread each."""

    def __init__(self, address=None, workers=None):
        self.address, self.workers = address, workers

    def __enter__(self):
        import logging

        import dask
        from distributed import Client, LocalCluster

        dask.config.set(CONFIG)
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
        with held_interrupts():
            self.client.close()
            if self.local:
                self.local.close()


def run_sweep(sweep: Sweep, folder: Path, client: Any, progress: Any = None, keys: Any = None) -> dict[str, np.ndarray]:
    """Do the runs that a sweep's folder lacks and return its rows, of the keys in their order if some are given.

    client: of a Dask cluster with this package, or a function that gives it when needed; progress: called with runs done,
    failed, in all.  A lost worker's run counts once; a failed one is a row, and is tried again in the next call.
    """
    with Store(folder) as store:
        try:
            run_missing(sweep, store, client, progress or (lambda *_: None), list(dict.fromkeys(keys or sweep.scenes)))
        finally:
            with held_interrupts():
                rows = store.export(schema_of(sweep), sweep.scenes, sweep.grows)
    return rows if keys is None else of_keys(rows, keys)


def run_missing(sweep, store, client, progress, keys):
    """Do the runs of the keys that a Store lacks."""
    from distributed import as_completed

    finished = store.done() & set(keys)
    done, failed = len(finished), 0
    if not callable(client) or done < len(keys):
        progress(done, failed, len(keys))
    if done == len(keys):
        return
    client = client() if callable(client) else client
    # as a task, so that Dask makes it again if its workers die
    fmu = client.submit(bytes, sweep.model.content, key=f"fmu-{sweep.model.digest}")
    futures = [
        client.submit(sweep.perform or perform, sweep.scenes[key], fmu, *sweep.further[:1], key=f"run-{key}")
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
                    f"the Dask scheduler is gone after {done + failed} of {len(keys)} runs; they are in {store.folder}, the same command does the others"
                )
            key = future.key.removeprefix("run-")
            row = about_run(sweep, key) | found
            future.release()
            store.add(row)
            done, failed = (done + 1, failed) if row["status"] == "done" else (done, failed + 1)
            progress(done, failed, len(keys))
    finally:
        with held_interrupts():
            client.cancel(futures)


def outcome(future):
    """A worker's part of a row, or why there is none; None if the scheduler is gone."""
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
    row |= {name: scene.value(name, model) for name in model.parameters}
    row["solver.tol"] = row["solver.tol"] if scene.tolerance is None else scene.tolerance
    for name in model.inputs:
        varies = name in scene.inputs and len(scene.inputs[name].t) > 1
        row[name] = None if varies else scene.value(name, model)
    return row


def schema_of(sweep: Sweep) -> Any:
    """Columns of the dataset with their units; the design itself in the metadata."""
    import pyarrow as pa

    model = sweep.model
    variables = model.parameters | model.inputs | model.outputs | model.locals
    units = {name: v.unit or "1" for name, v in variables.items()}
    kinds = {"Real": pa.float64(), "Integer": pa.int64(), "Enumeration": pa.string()}
    outputs = dict.fromkeys(name for scene in sweep.scenes.values() for name in scene.outputs)

    def column(name, unit, kind=None):
        return pa.field(name, kind or pa.float64(), metadata={"unit": unit})

    times = ("t_end", "step", "simulated_time", "cpu_time", "whole_cpu_time", "wall_time")
    fields = [pa.field(name, pa.string()) for name in ("key", "scene", "status", "message", "date")]
    fields += [pa.field("run", pa.int64()), *(column(name, "s") for name in times)]
    fields += [column(name, units[name], kinds[v.type]) for name, v in (model.parameters | model.inputs).items()]
    fields += [column(name, units[name]) for name in closing_names(model)]
    fields += [column(f"{kind}({name})", units[name]) for name in outputs for kind in KINDS]
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
