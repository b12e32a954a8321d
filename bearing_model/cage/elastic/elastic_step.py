"""A step of elastic halves: the readable twin of elastic_step.c.  elastic_begin, before the evaluation at the end:

    halves in the middle; substeps of modes, joints, films and loads on walls (cage_substeps.py) under the slow
    accelerations a_s of the start; predicted velocities v^, and gamma times the forces of the films on bent rims

elastic_end, after it:

    the rates lose the part that the halves advance by themselves; friction states follow the places of the joints
    (1 + gamma A) delta = gamma (a^ - a_n - foreseen changes) + removed     A: films of the lands; of bent rims Newton's method
    v_{n+1} = v^ + delta; the modes' velocities v_{n+1} = v + gamma (a_{s,n+1} - a_s); friction slips; history and errors
"""

from dataclasses import dataclass, replace

import numpy as np

from bearing_model.cage.common.cage_joint import PLATES
from bearing_model.cage.common.films import HALF, N_HALVES
from bearing_model.cage.common.halves_step import (
    halves_correct,
    halves_films,
    halves_move,
    halves_predict,
    halves_remember,
    halves_residual,
    halves_slide,
)
from bearing_model.cage.common.pocket_films import PocketFilmsStep, pocket_films_arrive
from bearing_model.cage.elastic.cage_elastic import cage_elastic_stiffness
from bearing_model.cage.elastic.cage_substeps import add_rates, cage_substeps_advance, cage_substeps_split
from bearing_model.cage.elastic.rim_films import RimFilmsStep, land_lever, mobilities, rim_modes, rim_motions
from bearing_model.generated.variables import MODE_D, MODE_D_DOT, MODE_S, MODE_S_DOT, WORK
from bearing_model.numbers.trapezoid import trapezoid_error
from bearing_model.physics.land_bent import bent_solve

PLACES, RATES = slice(MODE_S.start, MODE_D.stop), slice(MODE_S_DOT.start, MODE_D_DOT.stop)  # of the modes


@dataclass
class ElasticStep:
    """Between the two halves of a step: slow accelerations at the end as the substeps foresee them, of the modes [2, n], changes of those
    of halves [12] and, by loads on walls, of balls [3 Z]; films in pockets; forces on bent rims at the end that with those at the start make their
    impulses so far [2, 4].
    """

    modes: np.ndarray
    halves: np.ndarray
    balls: np.ndarray
    pockets: PocketFilmsStep
    rim_before: np.ndarray


def elastic_split(model, y, w, f, memory):
    """Separates the part that the halves advance by themselves from the rates f at the state y, where w was evaluated."""
    memory.fast = cage_substeps_split(model, y, w, f)
    if w.pressure:
        memory.films.force = np.reshape(w.pressure.rim_force, (4, 2)).T
        memory.films.stiffness = float(np.max(w.pressure.stiffness))
        memory.force = np.array([w.pressure.of(h).film for h in range(2)])
        add_rates(model, -rim_modes(model, memory.films.force), f)


def elastic_begin(model, h, start, middle, y, w):
    """Motion and predicted velocities; returns HalvesStep and ElasticStep."""
    halves, memory = halves_move(model, h, start, middle, y, w), start.cage
    gamma = halves.gamma
    films = RimFilmsStep(model, memory.films)
    pockets = PocketFilmsStep(model, h, memory.pockets, start.f, middle, y, w)
    found = cage_substeps_advance(model, h, memory, start.f, middle, y, films, pockets, w)
    modes, foreseen, balls, halves.joints = found
    halves_predict(model, start, y, halves)
    w.squeeze_by, w.squeeze_from = gamma * mobilities(model), memory.force
    return halves, ElasticStep(modes, foreseen.ravel(), balls, pockets, films.before(gamma))


def follow_places(before, now, joints, y):
    """Friction states follow the way of the joints' places, not their velocities."""
    more = now.u - before.u - joints.way
    for row, change in zip(PLATES, more, strict=True):
        y[row] += change
    joints.way = joints.way + more


def slow_rates(model, f):
    """Slow rates of the modes [2, n]."""
    return np.array([f[MODE_S_DOT][: model.modes.n], f[MODE_D_DOT][: model.modes.n]])


def solve_bent_halves(model, gamma, w, lack, squeeze, residual, delta):
    """The velocities of halves with bent rims in delta [12] by the residual: land and rim together, the law at the step's end.

    lack: end minus predicted acceleration of each rim shape [2, 4]; squeeze: squeeze velocities [2, 6], which become those of the
    end.  The films in w become those of the end.  Returns impulses [2, 6], rates [2, 6, 6] and forces [2, 6] of the films, and the decrease
    of the power that they take, without the part of the second order on the halves' bodies.
    """
    p, d, less, impulses, forces, all_rates = model.p, model.d, 0.0, *np.zeros((2, 2, 6)), np.zeros((2, 6, 6))
    for h in range(2) if w.pressure else ():
        on, half, spin, x = w.pressure.of(h), w.half[h], float(w.film[h].spin[0]), land_lever(model, h)
        B = np.array([[0.0, 1.0, 0.0, 0.0, x, 0.0], [0.0, 0.0, 1.0, -x, 0.0, 0.0]])  # of the half's velocities
        axes = np.array([half.b_y[1:, 0], half.b_z[1:, 0]])
        start = np.concatenate([axes @ B @ residual[HALF[:, h]], gamma * lack[h]])
        solved = bent_solve(p, on, gamma, w.squeeze_by[h], start, squeeze[h])
        inertia = np.array([p.cage.m] * 3 + [d.J_t] * 2 + [d.J_p])
        change = residual[HALF[:, h]] - B.T @ axes.T @ solved.impulse[:2] / inertia
        change[5] -= solved.impulse @ on.by_spin / d.J_p
        change[5] /= 1.0 + gamma * spin / d.J_p
        delta[HALF[:, h]] = change
        squeeze[h], impulses[h], forces[h], all_rates[h] = solved.V, solved.impulse, solved.film, solved.rates
        V = np.concatenate([on.V, on.rim_V])
        less += solved.film @ (V + solved.change) - on.film @ V
        less -= solved.change[:2] @ solved.impulse[:2] / gamma
        rates = axes.T @ solved.rates[:2, :2] @ axes
        w.film[h].yy, w.film[h].yz, w.film[h].zz = (np.array([rates[i]]) for i in ((0, 0), (1, 0), (1, 1)))
    return impulses, all_rates, forces, less


def remember_modes(model, h, foreseen, start, end, error):
    """Rates of the modes, their history and their errors, without the films on bent rims.  foreseen: accelerations at the end [2, n]."""
    change = end.f.copy()
    add_rates(model, -foreseen, change)
    _, error[RATES] = trapezoid_error(h, start.h, 0.5 * h * change[RATES], start.jerk[RATES])
    end.jerk[RATES] = change[RATES] / h
    end.f[PLACES], end.jerk[PLACES] = end.y[RATES], 0.0


def elastic_end(model, halves, step, start, end, error, w):
    """Solution, corrections and history; returns residual and delta [12], changes of the balls' accelerations by loads on walls, whose
    ways the state has [3 Z], and the power of films beyond that of the evaluation [W].
    """
    gamma, y, f, before, memory = halves.gamma, end.y, end.f, start.cage, end.cage

    # The rates of the evaluation without the part of the substeps; films in pockets at the end's velocities.
    elastic_split(model, y, w, f, memory)
    follow_places(before.fast, memory.fast, halves.joints, y)
    f[WORK] += pocket_films_arrive(model, gamma, step.pockets, before.pockets, y, w, f, memory.pockets)
    lack = rim_motions(model, slow_rates(model, f) - step.modes)
    lack += model.modes.mobility * (memory.films.force - step.rim_before)
    memory.squeeze = before.squeeze.copy()

    # The linear solve, and that of bent rims.
    residual = halves_residual(halves, start, end) - gamma * step.halves
    delta = np.linalg.solve(np.eye(N_HALVES) + gamma * halves_films(model, w), residual)
    impulse, rates, memory.force, power = solve_bent_halves(model, gamma, w, lack, memory.squeeze, residual, delta)

    # Velocities of halves and modes; friction.
    unforeseen = halves_correct(halves, delta, y)
    elastic_slide(model, w, y, halves.joints)
    memory.films = replace(memory.films, force=memory.films.force - impulse[:, 2:] / gamma, rates=rates)
    by_films = rim_modes(model, memory.films.force - step.rim_before)
    add_rates(model, gamma * (slow_rates(model, f) - step.modes + by_films), y)

    # History and errors.  Where pockets hold oil the foreseen loads count as errors: films in pockets change with the velocities that
    # these loads change, which nothing else in the error shows.  Without them full pockets at 24,144 r/min have a 1.5 % too large RMS
    # force.
    change = unforeseen + gamma * step.halves
    halves_remember(model, w, halves, start, change, unforeseen if model.d.squeeze is None else change, end, error)
    remember_modes(model, halves.h, step.modes, start, end, error)
    return residual, delta, step.balls, power


def elastic_slide(model, w, y, joints):
    """Maps the friction states in y back under the loads in w."""
    return halves_slide(model, cage_elastic_stiffness(model), w.cage.elastic.joints, y, joints)
