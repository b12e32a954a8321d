"""The halves' part of a step, as far as both kinds of halves share it: the readable twin of halves_step.c.

    psi_{n+1} = psi_n + h psi'(q_m, v_m)        midpoint rule: the rates depend on the pose
    v^ = v_n + h a_n - removed                  predictor with its limiter
    residual = gamma (a^ - a_n) + removed       at the prediction; the kind of halves solves for delta
    v_{n+1} = v^ + delta,  a_{n+1}, errors      trapezoidal rule (trapezoid.py)
    u' = (way of the joint)/h                   mean rate of a friction state

Velocities of the halves [12] are in the order of the state.
"""

from dataclasses import dataclass

import numpy as np

from bearing_model.cage.common.cage_joint import JointStep, cage_joint_kinematics, cage_joint_slide
from bearing_model.cage.common.films import N_HALVES, film_matrix, film_rates
from bearing_model.cage.common.halves import halves_kinematics
from bearing_model.generated.variables import CAGE_PSI, CAGE_V_X, JOINT_PLATE_Y, RING_V_X, WORK, Z
from bearing_model.numbers.trapezoid import trapezoid_end, trapezoid_error
from bearing_model.physics.rotor import rotor_roll

HALVES = slice(CAGE_V_X.start, RING_V_X.start)  # rows of the halves' velocities
FRICTION = slice(JOINT_PLATE_Y.start, WORK.start)


@dataclass
class HalvesStep:
    """Between the two halves of a step: its length, half of it [s]; part of the prediction h a_n that the limiter has
    removed [12]; friction.
    """

    h: float
    gamma: float
    removed: np.ndarray = None
    joints: JointStep = None


def halves_move(model, h, start, middle, y, w):
    """Rotations of the halves in y, whose other positions have their values at the end and whose velocities of the halves become
    those of the middle; kinematics of halves and joints in the middle.  Returns the HalvesStep.
    """
    y[HALVES] = middle[HALVES]
    halves_kinematics(model, middle, w)
    y[CAGE_PSI] = start.y[CAGE_PSI] + h * np.concatenate([half.s - rotor_roll(half) for half in w.half])
    cage_joint_kinematics(model, w)
    return HalvesStep(h, 0.5 * h)


def film_matrices(w):
    """-dF/dv [2, 2, 2] of the films of both lands [N.s/m]."""
    return np.array([film_matrix(film) for film in w.film])


def halves_films(model, w):
    """Rates A [12, 12] of the halves by the films of both lands."""
    return film_rates(model, film_matrices(w), [float(film.spin[0]) for film in w.film])


def limit_prediction(model, h, start):
    """The part of the predicted change h a_n of the halves' velocities that is removed [12]: that of its new share which the
    films at the step's start hold back.

    A film holds back a land that closes and hardly one that opens: a land that rests against its film would be thrown
    off by a prediction from a_n alone. The share that a_n and a_{n-1} have in common, minmod(a_n, a_{n-1}), counts as
    steady.
    """
    a, before = start.f[HALVES], (start.f - start.h * start.jerk)[HALVES]
    minmod = np.where(a * before > 0.0, np.where(np.abs(a) < np.abs(before), a, before), 0.0)
    new = h * (a - minmod)
    return new - np.linalg.solve(np.eye(N_HALVES) + h * film_rates(model, start.cage.film), new)


def halves_predict(model, start, y, step):
    """Velocities of the halves at the end as predicted, from those of the middle."""
    step.removed = limit_prediction(model, step.h, start)
    y[HALVES] += step.gamma * start.f[HALVES] - step.removed


def halves_residual(step, start, end):
    """Residual [12] of the trapezoidal rule at the prediction."""
    return step.gamma * (end.f - start.f)[HALVES] + step.removed


def halves_correct(step, delta, y):
    """Velocities at the end by the solution delta [12]; returns v_{n+1} - v_n - h a_n."""
    y[HALVES] += delta
    return delta - step.removed


def halves_slide(model, k, at, y, joints):
    """Maps the friction states in y back under the loads `at`, from joints.before; the work loses the energy that the
    mapping dissipates, which is returned [J].
    """
    lost = cage_joint_slide(model, k, at.rivet[0], at.N_plate, y, joints)
    y[WORK] -= lost
    return lost


def halves_stiff_part(model, w, gamma, v):
    """v - (1 + gamma A)^-1 v of the halves' velocities, A of the films alone."""
    return v - np.linalg.solve(np.eye(N_HALVES) + gamma * halves_films(model, w), v)


def halves_remember(model, w, step, start, change, unforeseen, end, error):
    """Accelerations, mean rates of the friction states, their history and their errors; the films at the end.  change: v_{n+1} - v_n -
    h a_n [12]; unforeseen: without the part that the substeps foresaw.

    The midpoint rule's own leading error is h^3/24 u''', u' the mean rate of a friction state.
    """
    h, span = step.h, step.h + start.h
    second, error[HALVES] = trapezoid_error(h, start.h, unforeseen, start.jerk[HALVES])
    stiff = halves_stiff_part(model, w, step.gamma, second)
    end.f[HALVES], end.jerk[HALVES] = trapezoid_end(h, start.f[HALVES], change, unforeseen, stiff)
    end.f[FRICTION] = np.append(step.joints.way.ravel() / h, np.zeros(2 * Z))
    end.jerk[FRICTION] = 2.0 / span * (end.f - start.f)[FRICTION]
    error[FRICTION] = h / 24.0 * 2.0 * h * h / span * (end.jerk - start.jerk)[FRICTION]
    end.cage.film = film_matrices(w)
