"""Miner's sum over a mission.

A mission repeats a set of parts, operating points and events.  Part i adds in each hour of the mission the damage

    w_i r_i        w_i = share of the hours, r_i damage per hour         operating point
                   w_i = events per hour,    r_i damage per event        event

and the mission lasts until the sum is 1 at the first place of a rivet.  Rates are simulated for *cases*; the rate of a
part follows from them logarithmically, ln r_i = sum over c of b_ic ln r_c, with b = 1 for a part that is simulated
itself and the weights of an interpolation for one that is not. If the preload falls over the hours, there is one such
blend for each hour at which the law of its loss is given, and ln r_i is linear in between.

A class of a measured record is simulated at its mean values.  Damage goes with a high power of load and speed, so that
the mean of the rate over the class is larger than the rate at the mean.  With ln r linear over the class, slope g along
an axis and standard deviation s of the record's values in the class,

    mean of r over the class = r(mean) exp(g^2 s^2/2)

(exact for a normal distribution; 1 % too large for a uniform one at g s = 1).  g is the difference quotient between the
neighbouring classes.
"""

from dataclasses import dataclass

import numpy as np
from scipy.special import exprel

# of a class: a larger factor says that the classes are too wide, and a class without damage next to one with damage has
# no slope
MOST = 3.0
NO_DAMAGE = 1e-300  # per hour; a smaller rate counts as none
FOR_EVER = 1e290  # h; a longer life counts as without end
BISECTIONS = 60  # halve the interval to the last digit


@dataclass(frozen=True)
class Duty:
    """weights: of the parts [I]; blends: of the logarithms of the cases' rates [J, I, C] at hours [J], the first 0; slopes: g s
    of classes of a record along each axis [A, J, I, C], zero for other parts, or None.
    """

    weights: np.ndarray
    blends: np.ndarray
    hours: np.ndarray
    slopes: np.ndarray | None = None


def part_rates(duty, rates):
    """Rates of the parts at the hours of the duty [..., J, I, K] from those of the cases [..., C, K] at K places."""
    logs = np.log(np.maximum(rates, NO_DAMAGE))
    return np.exp(np.einsum("jic,...ck->...jik", duty.blends, logs)) * class_factors(duty, logs)


def class_factors(duty, logs):
    """Mean rate over a class over that at its mean values [..., J, I, K], MOST at most; logs: of the cases."""
    if duty.slopes is None:
        return 1.0
    across = np.einsum("ajic,...ck->...ajik", duty.slopes, logs)
    return np.minimum(np.exp(np.minimum(0.5 * np.sum(across**2, axis=-4), 100.0)), MOST)


def lives(duty, rates):
    """Life at each place [h] (inf without damage) [..., K], and each part's damage by then [..., J, I, K]."""
    parts = duty.weights[:, None] * part_rates(duty, rates)
    if len(duty.hours) == 1:
        total = parts.sum(axis=-2)[..., 0, :]
        return endless(1.0 / np.maximum(total, NO_DAMAGE)), parts / np.maximum(total, NO_DAMAGE)[..., None, None, :]
    return changing_lives(duty.hours, parts)


def changing_lives(hours, parts):
    """lives() where the rates change over the hours; after the last hour they stay."""
    stretches = np.diff(hours)
    done = np.zeros(parts.shape[:-3] + parts.shape[-1:])
    life, damage = np.full_like(done, np.inf), np.zeros_like(parts)
    for j in range(len(hours)):
        first, last = parts[..., j, :, :], parts[..., min(j + 1, len(hours) - 1), :, :]
        length = stretches[j] if j < len(stretches) else 1.0 / np.maximum(first.sum(axis=-2), NO_DAMAGE)
        grows = np.log(np.maximum(last, NO_DAMAGE) / np.maximum(first, NO_DAMAGE))
        share = reached(first, grows, length, 1.0 - done)
        alive = np.isinf(life)
        ends = alive & (share < 1.0) if j < len(stretches) else alive
        share = np.where(ends, share, 1.0)
        added = np.where(alive[..., None, :], stretch_damage(first, grows, length, share[..., None, :]), 0.0)
        damage[..., j, :, :] += 0.5 * added
        damage[..., min(j + 1, len(hours) - 1), :, :] += 0.5 * added
        life = np.where(ends, hours[j] + share * length, life)
        done += added.sum(axis=-2)
    return endless(life), damage


def endless(life):
    """The life [h], inf if it is that of no damage."""
    return np.where(life < FOR_EVER, life, np.inf)


def stretch_damage(first, grows, length, share):
    """Damage over a share of a stretch: integral of first exp(grows x) length dx."""
    length = np.broadcast_to(length, first.shape[:-2] + first.shape[-1:])[..., None, :]
    return first * length * share * exprel(grows * share)


def reached(first, grows, length, missing):
    """Share of the stretch after which its damage is what is missing, by bisection; 1 if it is not reached."""
    low, high = np.zeros_like(missing), np.ones_like(missing)
    for _ in range(BISECTIONS):
        middle = 0.5 * (low + high)
        below = stretch_damage(first, grows, length, middle[..., None, :]).sum(axis=-2) < missing
        low, high = np.where(below, middle, low), np.where(below, high, middle)
    return high
