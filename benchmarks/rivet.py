"""Cost of the rivets' stress from the table, at the loads of settled runs, beside one evaluation of the right-hand
side.

Both are timed in a C loop over many states, so that neither calls from Python nor a table in the cache distort the
times; the least of several repeats counts.
"""

import numpy as np
from common import SCENES, Core, Scene, build_target, cpu, options, say, write
from rhs import settled_states

from bearing_model.generated.variables import Z

REACH = 0.5e-6  # s for the 2 Z channels
CALLS = 20_000  # evaluations of Z rivets in one timing


def rivet_loads(core, model, y):
    """JointLoads of all states, as a C array."""
    loads = core.new("JointLoads", len(y))
    for i, state in enumerate(y):
        model.rhs(0.0, state)
        model.kernel("rivets_load")(model.pointer, model.work, loads + i)
    return loads


def table_time(core, model, loads, count):
    """Time of the peak channels of Z rivets [s]."""
    sigma = core.ffi.new("double[]", core.lib.RIVET_CHANNELS * Z)
    rounds = -(-CALLS // count)

    def evaluate():
        for _ in range(rounds):
            core.lib.test_rivet_rom_stress(count, loads, model.d.fit_eff[0], False, sigma)

    return cpu(evaluate, 9)[0] / (rounds * count)


def rhs_time(core, model, y):
    """Time of one evaluation of the right-hand side [s]."""
    rounds = -(-CALLS // len(y))
    return (
        min(
            getattr(core.lib, f"rhs_time_{model.isa}")(model.pointer, len(y), core.array(y), rounds, model.work)
            for _ in range(9)
        )
        * 1e-9
    )


def main():
    short = options(__doc__).short
    core = Core.load(build_target("bearing_kernels"))
    scenes = {}
    for name in ("demo", "jam") if short else SCENES:
        scene = Scene(name)
        y = settled_states(scene, core, 64 if short else 256)
        model = core.model(scene.parameters, scene.inputs)
        core.ffi.cdef(f"double rhs_time_{model.isa}(const Model *, int, const double *, int, Work *);", override=True)
        table, rhs = table_time(core, model, rivet_loads(core, model, y), len(y)), rhs_time(core, model, y)
        scenes[name] = {"title": scene.title, "isa": model.isa, "table": table, "rhs": rhs}
        verdict = "within" if table <= REACH else "beyond"
        say(
            f"{name}: {2 * Z} channels {1e6 * table:.2f} us, {verdict} {1e6 * REACH:g} us; {table / rhs:.2f} of a right-hand side"
        )
    worst = np.max([scene["table"] for scene in scenes.values()])
    write("rivet", {"reach": REACH, "worst": worst, "scenes": scenes}, short)


if __name__ == "__main__":
    main()
