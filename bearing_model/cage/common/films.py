"""The films of the lands in the implicit step: rates at which they slow the halves, as dense matrices.

A land's film slows the velocity u of the land at the lever x, u_y = v_y + gamma_dot x and u_z = v_z - beta_dot x.
Vectors here are the velocities of both halves [12], in the order of the state.
"""

import numpy as np

from bearing_model.generated.variables import CAGE_V_X, RING_V_X

N_HALVES = RING_V_X.start - CAGE_V_X.start
# places of v_x, v_y, v_z, beta_dot, gamma_dot, s of half 0 and of half 1 [6, 2]
HALF = np.arange(N_HALVES).reshape(6, 2)


def film_matrix(film):
    """-dF/dv [2, 2] of a land's film [N.s/m] (LandFilm)."""
    return np.array([[float(film.yy[0]), float(film.yz[0])], [float(film.yz[0]), float(film.zz[0])]])


def film_rates(model, film, spin=(0.0, 0.0)):
    """Rates [12, 12] of both halves by the matrices of the films of both lands [2, 2, 2] and their moments per spin [2]."""
    p, d = model.p, model.d
    m, J_p, J_t = p.cage.m, d.J_p, d.J_t
    A = np.zeros((N_HALVES, N_HALVES))
    for h in range(2):
        x = (2 * h - 1) * p.cage.land_x - d.com_x[h]
        B = np.array([[1.0, 0.0, 0.0, x], [0.0, 1.0, -x, 0.0]])  # of v_y, v_z, beta_dot, gamma_dot
        A[np.ix_(HALF[1:5, h], HALF[1:5, h])] = B.T @ film[h] @ B / np.array([[m], [m], [J_t], [J_t]])
        A[HALF[5, h], HALF[5, h]] = spin[h] / J_p
    return A
