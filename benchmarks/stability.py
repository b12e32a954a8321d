"""Random and extreme scenes, each run to its end: outcome, energy balance, and run time relative to the working
point's.

python benchmarks/stability.py                 the whole matrix, then docs/stability.md
python benchmarks/stability.py --elastic       the same with elastic cage halves, for the page's elastic rows
python benchmarks/stability.py --family tilt   one family, printed
python benchmarks/stability.py --long          ten million tiny steps, 100 s of simulated time, angles after a million revolutions (minutes)
python benchmarks/stability.py --page          only the page, from the newest records in benchmarks/results/

A scene is finished, discarded (the solver gives up with a message) or refused (before the run, by name, value and
limit).  A fault is a crash, a hang, a value that is not finite with status OK, a refused scene that is admissible, or
an impossible scene that runs.
"""

import argparse
import math
import multiprocessing
from concurrent.futures import ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from dataclasses import replace
from functools import cache

import numpy as np
from common import BUILD, FMU, ROOT, core_library, cpu, say, write
from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import fmi2Discard
from mechanics import Instance as CoreInstance
from stability_page import write_page
from stability_scenes import WORKING, Scene, matrix

from bearing_model.generated import variables
from rivet_model import closed_form, table
from rivet_model.geometry import Geometry
from riveted_bearing import build
from riveted_bearing.running.fmu import Instance, Model

FOLDER = BUILD / "stability"
HANGS = 600.0  # a scene that takes longer is called hanging [s]
MOST_STEPS = 2_000_000  # work limit of one communication step
DEMO_EVERY = 25  # scenes between two runs of the working point, to which run times are related
OUTPUTS = [
    name.replace("[j]", f"[{j}]").replace("[k]", f"[{j}]")
    for name, v in (variables.OUTPUTS | variables.LOCALS).items()
    for j in range(1, v.count + 1)
]
CAGE = {"cage.D_o": 0.0595, "cage.D_i": 0.0497}
SIZES = {"bearing.D": 0.0111125, "bearing.d_m": 0.0535}  # of the 6207
BEARINGS = {  # changes of the 6207: number of balls, parameters
    "5 balls": (5, {}),
    "16 balls": (16, {"bearing.D": 6.35e-3, "cage.pocket_clearance": 1.5e-4}),
    "32 balls": (
        32,
        {
            "bearing.D": 5.5e-3,
            "bearing.d_m": 0.08,
            "cage.D_o": 0.0836,
            "cage.D_i": 0.0772,
            "cage.pocket_clearance": 1e-4,
        },
    ),
    "soft rivets": (9, {}),
    "stiff rivets": (9, {}),
}
SHANKS = {"soft rivets": 0.8e-3, "stiff rivets": 2.4e-3}  # diameters [m]


def fmu_of(bearing):
    return FMU if bearing == "6207" else FOLDER / f"{bearing.replace(' ', '_')}.fmu"


def build_fmu(bearing):
    """Builds the FMU of a bearing of the matrix."""
    FOLDER.mkdir(parents=True, exist_ok=True)
    Z, changes = BEARINGS[bearing]
    target = fmu_of(bearing)
    source, name = target.with_suffix(".toml"), target.stem
    text = f'designation = "{bearing}"\nZ = {Z}\n[parameters]\n' + "".join(
        f"{key} = {value}\n" for key, value in (SIZES | changes).items()
    )
    source.write_text(text)
    rivet = None
    if bearing in SHANKS:
        shank = SHANKS[bearing]
        rivet = FOLDER / f"{name}.json"
        table.write(closed_form.make_table(Geometry(shank_diameter=shank, head_diameter=1.75 * shank)), rivet)
    build(str(source), rivet, target)


# ------------------------------------------------------------------------------------------------------------ one scene


@cache
def instance_of(bearing):
    """One instance per process and bearing, reset before each scene, so that remains of an earlier scene would show."""
    instance = Instance(Model(fmu_of(bearing)))
    return instance.__enter__()


def history(points, hold):
    """Values of an input at given times."""
    if not isinstance(points, list):
        return lambda t: points
    times, values = np.array(points).T
    if hold:
        return lambda t: values[np.maximum(np.searchsorted(times, t * (1 + 1e-12), side="right") - 1, 0)]
    return lambda t: np.interp(t, times, values)


def set_all(instance, scene, inputs):
    model, fmu = instance.model, instance.fmu
    for name, value in (
        {"solver.max_steps": MOST_STEPS, "solver.clock": variables.Switch.ON} | scene.parameters
    ).items():
        variable = model.parameters[name]
        setter = fmu.setReal if variable.type == "Real" else fmu.setInteger
        setter([variable.valueReference], [value])
    for name, value in inputs.items():
        fmu.setReal([model.inputs[name].valueReference], [float(value(0.0))])
    fmu.setupExperiment(tolerance=scene.tolerance, startTime=0.0)
    fmu.enterInitializationMode()
    fmu.exitInitializationMode()


def energy_scale(instance, scene, loss):
    """Scale of energy errors [J]: energy lost so far + kinetic energy of balls and cage + work of the load over 10 um."""
    p = instance.parameters()
    inputs = {
        name: float(np.max(np.abs(np.array(value)[:, 1]))) if isinstance(value, list) else abs(value)
        for name, value in scene.inputs.items()
    }
    speed = 0.25 * inputs.get("shaft.omega", WORKING) * p["bearing.d_m"]
    mass = (
        math.pi / 6 * p["bearing.rho"] * p["bearing.D"] ** 3 * instance.read(["bearing.Z"])["bearing.Z"]
        + 2 * p["cage.m"]
    )
    load = sum(inputs.get(f"shaft.F_{axis}", 0.0) for axis in "xyz")
    return loss + 0.5 * mass * speed**2 + 1e-5 * (load + 1.0)


def run(scene):
    """Run one scene to its end and return its record."""
    instance = instance_of(scene.bearing)
    instance.log.clear()
    instance.fmu.reset()
    inputs = {name: history(points, scene.hold) for name, points in scene.inputs.items()}
    try:
        set_all(instance, scene, inputs)
    except FMICallException:
        return {"outcome": "refused", "message": instance.complaints(), "t": 0.0}
    names = [name for name in OUTPUTS if name in instance.model.outputs | instance.model.locals]
    read = instance.reader(names)
    at = {name: i for i, name in enumerate(names)}
    references = [instance.model.inputs[name].valueReference for name in inputs]
    before = read()[at["solver.cpu_time"]]  # a reset leaves it as it is
    values, residual, loss, force, t, outcome, message = None, 0.0, 0.0, 0.0, 0.0, "finished", ""
    for k in range(max(1, round(scene.t_end / scene.step))):
        new = [float(value(k * scene.step)) for value in inputs.values()]
        if new != values:
            instance.fmu.setReal(references, new)
            values = new
        try:
            instance.fmu.doStep(k * scene.step, scene.step)
            t = (k + 1) * scene.step
        except FMICallException as failure:
            outcome = "discarded" if failure.status == fmi2Discard else "error"
            message, t = instance.complaints(), instance.last_successful_time(t)
        row = read()
        if not np.isfinite(row).all():
            outcome, message = "not finite", ", ".join(names[i] for i in np.flatnonzero(~np.isfinite(row))[:5])
        if outcome != "finished":
            break
        loss += abs(row[at["bearing.power_loss"]]) * scene.step
        residual = max(residual, abs(row[at["bearing.energy_residual"]]))
        force = max(force, row[at["cage.F_pocket_peak"]])
    cpu_time = row[at["solver.cpu_time"]] - before
    return {
        "outcome": outcome,
        "message": message,
        "t": t,
        "rate": cpu_time / t * 9.0 / row[at["bearing.Z"]] if t > 0 else math.inf,
        "residual": residual,
        "balance": residual / energy_scale(instance, scene, loss),
        "force": force,
        "steps": row[at["solver.steps"]],
        "evaluations": row[at["solver.rhs_evals"]],
        "rejected": row[at["solver.error_tests_failed"]],
        "path": row[at["solver.method_used"]],
        "events": {
            name[6:-7]: row[i] for name, i in at.items() if name.startswith("event.") and name.endswith("_onsets")
        },
        "warnings": [text for level, text in instance.log if level == "warning"],
    }


# ----------------------------------------------------------------------------------------------------------- the matrix

DEMO = Scene("speed", "working point", t_end=0.02)


def run_share(scenes, demo):
    """Records of some scenes in this process, each with the working point's run time of about the same moment."""
    records, reference = [], None
    for n, scene in enumerate(scenes):
        if n % DEMO_EVERY == 0:
            reference = min((run(demo) for _ in range(2)), key=lambda record: record["rate"])
        record = run(scene)
        if "rate" in record:
            record["ratio"] = record["rate"] / reference["rate"]
        records.append(
            {"family": scene.family, "name": scene.name, "admissible": scene.admissible, "expected": scene.expected}
            | record
        )
    return records


def lost(scene, outcome):
    return {
        "family": scene.family,
        "name": scene.name,
        "admissible": scene.admissible,
        "expected": scene.expected,
        "outcome": outcome,
        "message": "",
        "t": 0.0,
    }


def run_all(scenes, demo, workers):
    """All records; a process that dies or hangs costs its share, which is then run scene by scene to find the culprit."""
    shares = [scenes[i : i + DEMO_EVERY] for i in range(0, len(scenes), DEMO_EVERY)]
    records, again = [], []
    with ProcessPoolExecutor(workers, mp_context=multiprocessing.get_context("spawn")) as pool:
        futures = [pool.submit(run_share, share, demo) for share in shares]
        for share, future in zip(shares, futures, strict=True):
            try:
                records += future.result()
                say(f"{len(records)} of {len(scenes)} scenes")
            except BrokenProcessPool:
                again += share
    for scene in again:
        with ProcessPoolExecutor(1, mp_context=multiprocessing.get_context("spawn")) as pool:
            try:
                records += pool.submit(run_share, [scene], demo).result(timeout=HANGS)
            except BrokenProcessPool:
                records.append(lost(scene, "crashed"))
            except TimeoutError:
                records.append(lost(scene, "hung"))
                for process in pool._processes.values():
                    process.kill()
    return records


def problems(records):
    """Faults of the records, as sentences."""
    bad = {"crashed", "hung", "not finite", "error"}
    for r in records:
        where = f"{r['family']}, {r['name']}: "
        if r["outcome"] in bad:
            yield where + f"{r['outcome']} {r['message']}"
        elif r["expected"] == "refused" and r["outcome"] != "refused":
            yield where + f"{r['outcome']}, although impossible"
        elif r["expected"] == "run" and r["outcome"] == "discarded":
            yield where + f"discarded at t = {r['t']:g} s: {r['message']}"
        elif r["admissible"] and r["outcome"] == "finished" and r["ratio"] > 20.0:
            yield where + f"run time {r['ratio']:.0f}"


# ------------------------------------------------------------------------------------------------------------ long runs


def tiny_steps(count=10_000_000, h=1e-9):
    """Ten million communication steps of 1 ns: time, memory of the solver and energy."""
    instance = CoreInstance(core_library(), {"scene.cage": 1, "scene.stress": 1, "scene.statistics": 1})
    step, bearing = instance.lib.part_step, instance.bearing

    def go():
        return max(step(bearing, (k + 1) * h) for k in range(count))

    seconds, worst = cpu(go)
    error = abs(instance.time - count * h)
    residual = instance.output("bearing.energy_residual")
    one = CoreInstance(core_library(), {"scene.cage": 1, "scene.stress": 1, "scene.statistics": 1}).step(1e-3)
    few = CoreInstance(core_library(), {"scene.cage": 1, "scene.stress": 1, "scene.statistics": 1})
    for k in range(1_000_000):
        few.lib.part_step(few.bearing, (k + 1) * h)
    difference = np.max(np.abs(few.y - one.y)[variables.RING_Y])
    return {
        "steps": count,
        "status": int(worst),
        "clock_error": error,
        "residual": residual,
        "cpu_per_step": seconds / count,
        "ring_y_after_1ms_against_one_step": difference,
    }


def long_run(t_end=100.0, h=1e-4):
    """The working point with rigid halves for 100 s: a line every second."""
    instance = CoreInstance(core_library(), {"scene.stress": 4, "scene.statistics": 2})
    psi_0, rows = instance.y[variables.CAGE_PSI][0], []
    names = (
        "bearing.energy_residual",
        "bearing.power_loss",
        "stat.Q_c_rms",
        "stat.time",
        "stat.cage_omega",
        "solver.steps",
        "cage.dislocation",
    )
    seconds, n = 0.0, round(1.0 / h)
    for second in range(round(t_end)):

        def go(second=second):
            for k in range(n):
                instance.step((second * n + k + 1) * h)

        seconds += cpu(go)[0]
        y = instance.y
        friction = max(
            np.max(np.abs(y[getattr(variables, f"JOINT_{part}_{axis}")])) for part in ("PLATE", "HEAD") for axis in "YZ"
        )
        work = y[variables.WORK][0]
        rows.append(
            {"t": second + 1.0, "psi": y[variables.CAGE_PSI][0] - psi_0, "work": work, "friction": friction}
            | {k: instance.output(k) for k in names}
        )
    return {"rows": rows, "cpu": seconds}


def many_turns(turns=1_000_000, t_end=1e-3):
    """All angles ahead by a million turns: the accelerations and 1 ms of motion against those without."""
    core, results = core_library(), []
    angles = np.concatenate([np.arange(variables.N_STATES)[s] for s in (variables.BALL_THETA, variables.CAGE_PSI)])
    for ahead in (0, turns):
        instance = CoreInstance(core, {}, {}, 1e-8)
        y = np.frombuffer(core.ffi.buffer(core.lib.part_state(instance.bearing), 8 * variables.N_STATES))
        y[angles] += 2.0 * np.pi * ahead
        moved = instance.step(t_end).y
        moved[angles] -= 2.0 * np.pi * ahead
        results.append(moved)
    difference = np.abs(results[1] - results[0])
    blocks = {
        "ball azimuth": variables.BALL_THETA,
        "cage rotation": variables.CAGE_PSI,
        "ball radius": variables.BALL_R,
        "ring y": variables.RING_Y,
    }
    differences = {name: float(difference[block].max()) for name, block in blocks.items()}
    return {"turns": turns, "resolution": float(np.spacing(2.0 * np.pi * turns)), "differences": differences}


def main():
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--family", help="only this family of scenes")
    parser.add_argument("--name", help="only scenes whose name contains this")
    parser.add_argument("--workers", type=int, default=2)
    parser.add_argument(
        "--elastic",
        action="store_true",
        help="elastic cage halves in every scene whose rivets have a table with modes, instead of rigid ones",
    )
    parser.add_argument("--long", action="store_true", help="the long runs instead of the matrix")
    parser.add_argument("--page", action="store_true", help="only write the page")
    chosen = parser.parse_args()
    if chosen.long:
        write(
            "stability_long",
            {"tiny_steps": tiny_steps(), "many_turns": many_turns(), "long_run": long_run()},
            short=False,
        )
    elif not chosen.page:
        scenes = [s for s in matrix() if chosen.family in (None, s.family) and (chosen.name or "") in s.name]
        cage = {"scene.cage": (variables.CageModel.ELASTIC if chosen.elastic else variables.CageModel.TWO_HALF).value}
        scenes = [
            replace(s, parameters=cage | s.parameters) for s in scenes if not (chosen.elastic and s.bearing in SHANKS)
        ]
        for bearing in {scene.bearing for scene in scenes} - {"6207"}:
            say(f"building {bearing}")
            build_fmu(bearing)
        demo = replace(DEMO, parameters=cage)
        records = run_all(scenes, demo, chosen.workers) if chosen.workers else run_share(scenes, demo)
        for text in problems(records):
            say(text)
        if chosen.family or chosen.name:
            for r in records:
                figures = (
                    f"run time {r['ratio']:.1f}, energy {r['balance']:.1e}, {r['rejected']:.0f} of {r['steps']:.0f} steps rejected"
                    if r["t"]
                    else ""
                )
                say(f"{r['family']}, {r['name']}: {r['outcome']}; {figures} {r['message']}")
            return
        write("stability_elastic" if chosen.elastic else "stability", {"records": records}, short=False)
    write_page(ROOT / "docs" / "stability.md", problems)


if __name__ == "__main__":
    main()
