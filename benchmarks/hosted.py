"""What it costs to let ARKStep call the core's own step (hosted.c): microseconds an evaluation beside the core's own
loop.

Interleaved runs of 20 ms in one process, least of 25; evaluations of both, which differ by rounding only until the
motion's chaos shows it.
"""

from common import SCENES, Core, Scene, build_target, core_library, counters, cpu, options, say, write

from bearing_model.generated.variables import CageModel, Stress, Switch

LENGTH, STEP, ROUNDS = 0.02, 1e-4, 25  # [s], [s]


def run(core, scene, cage):
    """Processor time [s] and evaluations of a run with stress and statistics."""
    instance = scene.start(
        core, scene_stress=int(Stress.PEAK), scene_statistics=int(Switch.ON), scene_cage=int(cage)
    ).step(0.01)
    before = counters(instance)["rhs_evals"]

    def steps():
        for k in range(round(LENGTH / STEP)):
            instance.step(0.01 + (k + 1) * STEP)

    seconds, _ = cpu(steps)
    return seconds, counters(instance)["rhs_evals"] - before


def compare(cores, scene, cage):
    """Least microseconds an evaluation and evaluations of each core."""
    found = {name: [] for name in cores}
    for _ in range(ROUNDS):
        for name, core in cores.items():
            found[name].append(run(core, scene, cage))
    best = {name: (min(1e6 * seconds / count for seconds, count in runs), runs[0][1]) for name, runs in found.items()}
    say(
        f"{scene.name:6} {cage.name.lower():8} "
        + ", ".join(f"{name} {us:.2f} us, {count:.0f} evaluations" for name, (us, count) in best.items())
    )
    return {name: {"us": us, "evaluations": count} for name, (us, count) in best.items()}


def main():
    short = options(__doc__).short
    cores = {"own loop": core_library(), "ARKStep": Core.load(build_target("bearing_hosted"))}
    cages = {
        cage.name.lower(): {name: compare(cores, Scene(name), cage) for name in SCENES}
        for cage in (CageModel.ELASTIC, CageModel.TWO_HALF)
    }
    write("hosted", {"cages": cages}, short)


if __name__ == "__main__":
    main()
