"""Rainflow and Miner: against the ASTM example, the `rainflow` package, and a history cut into pieces; both twins
alike.
"""

import math
import struct

import numpy as np
import pytest
import rainflow

from bearing_model.generated.variables import MeanStress
from bearing_model.instance import fatigue
from riveted_bearing import run

ASTM = [-2.0, 1.0, -3.0, 5.0, -1.0, 3.0, -4.0, 4.0, -2.0]  # ASTM E1049-85, figure 6
LAWS = {
    "none": fatigue.FatigueLaw(mean_stress=MeanStress.NONE),
    "goodman": fatigue.FatigueLaw(mean_stress=MeanStress.GOODMAN),
    "swt": fatigue.FatigueLaw(mean_stress=MeanStress.SWT),
    "morrow": fatigue.FatigueLaw(mean_stress=MeanStress.MORROW),
    "linear": fatigue.FatigueLaw(sigma_D=1.0, N_D=1e9, k_1=1.0, k_2=1.0, mean_stress=MeanStress.NONE),
}


class CChannel:
    """The C channel with the interface of the Python one."""

    def __init__(self, ffi, lib):
        self.ffi, self.lib, self.state = ffi, lib, ffi.new("FatigueChannel *")

    def law(self, law):
        return self.ffi.new("FatigueLaw *", vars(law))

    def push(self, law, sigma):
        self.lib.fatigue_push(self.state, self.law(law), sigma)

    def push_all(self, law, history):
        law = self.law(law)
        for sigma in history:
            self.lib.fatigue_push(self.state, law, sigma)

    def damage(self, law):
        return self.lib.fatigue_damage(self.state, self.law(law))

    def saved(self):
        return bytes(self.ffi.buffer(self.state))

    def restored(self, saved):
        other = CChannel(self.ffi, self.lib)
        self.ffi.memmove(other.state, saved, len(saved))
        return other


class PythonChannel(fatigue.FatigueChannel):
    def push_all(self, law, history):
        for sigma in history:
            self.push(law, sigma)

    def saved(self):
        return struct.pack("ddiii", self.last, self.closed, self.direction, self.samples, self.dropped), list(
            self.stack
        )

    def restored(self, saved):
        values = struct.unpack("ddiii", saved[0])
        return PythonChannel(list(saved[1]), *values)


@pytest.fixture(params=["C", "Python"])
def new_channel(request, core):
    return (lambda: CChannel(core.ffi, core.lib)) if request.param == "C" else PythonChannel


def miner(law, history):
    """Sum over the cycles of the `rainflow` package, in its order."""
    total = 0.0
    for range_, mean, count, *_ in rainflow.extract_cycles(history):
        total += count * fatigue.fatigue_cycle(law, range_, mean)
    return total


def test_astm_example(new_channel):
    """ASTM E1049-85, 5.4.4.3: ranges 3, 4, 6, 8, 9 counted 0.5, 1.5, 0.5, 1.0, 0.5 times: range x count sums to 23."""
    channel = new_channel()
    channel.push_all(LAWS["linear"], ASTM)
    expected = (3 * 0.5 + 4 * 1.5 + 6 * 0.5 + 8 * 1.0 + 9 * 0.5) / 2 / 1e9
    # decimal 1e9: rounding only, observed 0
    assert channel.damage(LAWS["linear"]) == pytest.approx(expected, rel=1e-14)
    assert miner(LAWS["linear"], ASTM) == channel.damage(LAWS["linear"])


@pytest.mark.parametrize("name", LAWS)
def test_equals_rainflow(new_channel, name):
    """Equal to the package to the last bit on 1e5 random samples, plateaus and repeats among them."""
    rng = np.random.default_rng(3)
    history = np.round(rng.normal(150e6, 120e6, 100_000), -6).tolist()
    channel = new_channel()
    channel.push_all(LAWS[name], history)
    assert channel.damage(LAWS[name]) == miner(LAWS[name], history)


def test_reading_does_not_disturb_and_pieces_join(new_channel):
    """Cut at 40 places by save and restore, read at each: the same as in one go."""
    rng = np.random.default_rng(4)
    history = rng.normal(100e6, 150e6, 5_000).tolist()
    law = LAWS["goodman"]
    channel = new_channel()
    for piece in np.array_split(history, 40):
        channel.push_all(law, piece.tolist())
        channel.damage(law)
        channel = channel.restored(channel.saved())
    assert channel.damage(law) == miner(law, history)


def test_damage_of_every_prefix(new_channel):
    """Read at any instant: what the package counts of the history until then."""
    history = np.random.default_rng(5).integers(-4, 5, 120).astype(float).tolist()
    law, channel = LAWS["linear"], new_channel()
    for n, sigma in enumerate(history, start=1):
        channel.push(law, sigma)
        if n > 2:  # the package counts nothing in a history of two samples
            assert channel.damage(law) == miner(law, history[:n])


def test_stack_is_bounded(new_channel):
    """Shrinking ranges only: the residue outgrows the stack, the oldest ranges are counted as the halves they would end
    as.
    """
    history = [(1.0 - 1e-3 * n) * (-1) ** n for n in range(2 * fatigue.FATIGUE_DEPTH)]
    law, channel = LAWS["linear"], new_channel()
    channel.push_all(law, history)
    assert channel.damage(law) == pytest.approx(miner(law, history), rel=1e-13)  # other order of sums; observed 2e-16


def cycle(core, law, range_, mean):
    ffi, lib = core.ffi, core.lib
    value = lib.fatigue_cycle(ffi.new("FatigueLaw *", vars(law)), range_, mean)
    assert value == fatigue.fatigue_cycle(law, range_, mean)
    return value


def test_laws_against_closed_forms(core):
    """Basquin with knee and the mean-stress rules, by hand (rounding only)."""
    base = {"sigma_D": 200e6, "N_D": 1e6, "k_1": 5.0, "k_2": 9.0, "sigma_m": 800e6, "sigma_f": 1200e6}

    def law(rule):
        return fatigue.FatigueLaw(**base, mean_stress=rule)

    assert cycle(core, law(1), 400e6, 0.0) == pytest.approx(1e-6, rel=1e-15)
    assert cycle(core, law(1), 800e6, 300e6) == pytest.approx(2**5 * 1e-6, rel=1e-14)
    assert cycle(core, law(1), 200e6, 0.0) == pytest.approx(2**-9 * 1e-6, rel=1e-14)
    assert cycle(core, law(2), 400e6, 400e6) == pytest.approx(2**5 * 1e-6, rel=1e-14)  # 200/(1 - 1/2) = 400
    assert cycle(core, law(2), 400e6, -400e6) == pytest.approx(1e-6, rel=1e-14)  # no credit for compression
    assert cycle(core, law(4), 400e6, 600e6) == pytest.approx(2**5 * 1e-6, rel=1e-14)  # 200/(1 - 600/1200)
    assert cycle(core, law(3), 200e6, 300e6) == pytest.approx(1e-6, rel=1e-14)  # sqrt(400 x 100) = 200
    assert cycle(core, law(3), 200e6, -100e6) == 0.0  # never in tension
    assert cycle(core, law(2), 2e6, 800e6) == 1.0  # mean stress at the strength
    assert cycle(core, law(1), 1e12, 0.0) == 1.0  # life below one cycle
    assert math.isfinite(cycle(core, fatigue.FatigueLaw(k_1=40.0), 1e300, 0.0))


@pytest.mark.parametrize("rule", list(MeanStress))
def test_fretting_divides_the_strength(core, rule):
    """A shank in a pressing hole: as much damage as a strength smaller by the factor; (2.4)^k below the knee, without a
    mean.  With play, or at the factor 1: the law itself.
    """
    ffi, lib = core.ffi, core.lib
    law = fatigue.FatigueLaw(fretting=2.4, mean_stress=rule)
    weaker = fatigue.FatigueLaw(sigma_D=250e6 / 2.4, fretting=2.4, mean_stress=rule)

    def in_hole(law, fit):
        c = lib.fatigue_law_in_hole(ffi.new("FatigueLaw *", vars(law)), fit)
        one = fatigue.fatigue_law_in_hole(law, fit)
        assert {name: getattr(c, name) for name in vars(one)} == vars(one)
        return one

    assert in_hole(law, 1e-7) == weaker and in_hole(law, 0.0) == in_hole(law, -1e-6) == law
    assert in_hole(fatigue.FatigueLaw(mean_stress=rule), 1e-7) == fatigue.FatigueLaw(mean_stress=rule)
    small = [cycle(core, one, 100e6, 0.0) for one in (in_hole(law, 1e-7), law)]
    assert small[0] / small[1] == pytest.approx(2.4**law.k_2, rel=1e-12)


@pytest.mark.parametrize(("fit", "factor"), [("-20 um", 1.0), ("20 um", 2.0**15)])
def test_fretting_weakens_the_middle_of_pressed_rivets(fmu, fit, factor):
    """The same motion with and without: damage of the middle is 2^k_2 times larger where the hole presses, the head's
    the same; far below the knee.
    """
    few = {"scene.stress": "fatigue", "scene.cage": "two_half", "start.settle": 1e-3, "joint.fit": fit}
    plain, fretted = (
        run(
            "demo",
            t_end=4e-3,
            parameters=few | {"fatigue.fretting": factor},
            outputs=["rivet[*].damage_head", "rivet[*].damage_mid"],
            fmu=fmu,
        )
        for factor in (1.0, 2.0)
    )
    for k in range(1, 10):
        heads, mids = (
            [r.data[f"rivet[{k}].damage_{place}"][-1] for r in (fretted, plain)] for place in ("head", "mid")
        )
        assert heads[0] == heads[1] > 0.0 and mids[1] > 0.0
        assert mids[0] == pytest.approx(factor * mids[1], rel=1e-9)


def test_constant_history_has_no_damage(new_channel):
    channel = new_channel()
    assert channel.damage(LAWS["none"]) == 0.0
    channel.push_all(LAWS["none"], [5.0] * 10)
    assert channel.damage(LAWS["none"]) == 0.0
