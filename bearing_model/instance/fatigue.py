"""Streaming rainflow counting and Miner's sum: twin of fmu_src/instance/fatigue.c, equations and sources in fatigue.h."""

import copy
import math
from dataclasses import dataclass, field, replace

from bearing_model.generated.variables import MeanStress

FATIGUE_DEPTH = 128


@dataclass(frozen=True)
class FatigueLaw:
    """S-N curve with knee and mean-stress rule: Pa and cycles, defaults of fmus/variables.toml."""

    sigma_D: float = 250e6
    N_D: float = 2e6
    k_1: float = 8.0
    k_2: float = 15.0
    sigma_m: float = 785e6
    sigma_f: float = 1180e6
    acceleration: float = 1.0  # factor on the damage of each cycle that is counted
    fretting: float = 1.0
    mean_stress: int = MeanStress.GOODMAN


def fatigue_law(p, k):
    """The law of rivet k (from 0), whose strength_factor scales all strengths."""
    return strengthened(FatigueLaw(**vars(p.fatigue)), p.rivet.strength_factor[k])


def strengthened(law, factor):
    """The law with all strengths times a factor."""
    return replace(law, **{name: factor * getattr(law, name) for name in ("sigma_D", "sigma_m", "sigma_f")})


def fully_reversed(law, sigma_a, sigma_mean):
    """Amplitude [Pa] that does the same damage at zero mean stress; infinite where the mean stress alone breaks the
    part.
    """
    if law.mean_stress == MeanStress.SWT:
        return math.sqrt(max(sigma_mean + sigma_a, 0.0) * sigma_a)
    if law.mean_stress == MeanStress.GOODMAN:
        room = 1.0 - max(sigma_mean, 0.0) / law.sigma_m
    elif law.mean_stress == MeanStress.MORROW:
        room = 1.0 - sigma_mean / law.sigma_f
    else:
        room = 1.0
    return sigma_a / room if room > 0.0 else math.inf


def fatigue_law_in_hole(law, fit_eff):
    """Law of the shank's middle in a hole with an effective fit [m]: sigma_D/fretting under the pressure of an
    interference.  DIN 743-2 for shafts in press fits.
    """
    return replace(law, sigma_D=law.sigma_D / law.fretting) if fit_eff > 0.0 else law


def fatigue_cycle(law, range_, mean):
    """Damage of one cycle of stress range and mean [Pa]: Basquin with knee, at most 1."""
    sigma_ar = fully_reversed(law, 0.5 * range_, mean)
    k = law.k_1 if sigma_ar > law.sigma_D else law.k_2
    try:
        return min((sigma_ar / law.sigma_D) ** k / law.N_D, 1.0)
    except OverflowError:
        return 1.0


@dataclass
class FatigueChannel:
    """History of one stress channel.

    >>> law, channel = FatigueLaw(k_2=8.0, sigma_D=1.0, N_D=1.0, mean_stress=MeanStress.NONE), FatigueChannel()
    >>> for sigma in (0.0, 1.0, 0.0): channel.push(law, sigma)
    >>> channel.damage(law) == 0.5**8
    True
    """

    stack: list = field(default_factory=list)
    last: float = 0.0
    closed: float = 0.0
    direction: int = 0
    samples: int = 0
    dropped: int = 0

    def push(self, law, sigma):
        """Next sample of the history [Pa]."""
        direction = int(sigma > self.last) - int(sigma < self.last)
        if self.samples == 0:
            self.samples = 1
            self._turning_point(law, sigma)
        elif direction != 0:
            if direction == -self.direction:
                self._turning_point(law, self.last)
            self.direction = direction
        self.last = sigma

    def damage(self, law):
        """Miner's sum, in which the ranges of the residue count as half cycles; the channel itself is not changed."""
        rest = copy.deepcopy(self)
        if rest.direction != 0:
            rest._turning_point(law, rest.last)
        for start, end in zip(rest.stack[:-1], rest.stack[1:], strict=True):
            rest._count(law, 0.5, start, end)
        return rest.closed

    def _count(self, law, cycles, start, end):
        self.closed += law.acceleration * cycles * fatigue_cycle(law, abs(start - end), 0.5 * (start + end))

    def _drop_first(self, law):
        self._count(law, 0.5, self.stack[0], self.stack[1])
        del self.stack[0]

    def _turning_point(self, law, sigma):
        if len(self.stack) == FATIGUE_DEPTH:
            self._drop_first(law)
            self.dropped += 1
        self.stack.append(sigma)
        while len(self.stack) >= 3:
            first, second, third = self.stack[-3:]
            if abs(third - second) < abs(second - first):
                return
            if len(self.stack) == 3:
                self._drop_first(law)
            else:
                self._count(law, 1.0, first, second)
                del self.stack[-3:-1]
