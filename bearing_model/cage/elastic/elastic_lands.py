"""The films of the lands on the rivets of elastic halves: static loads.  They change the reported rivet loads only,
not the motion.

The films press on the rims and so pry at the joints: the load path (half_path.py) gives the loads Delta L, Delta V of
bonded joints and Delta P, dm of their rivets.  The joints' state by the modes is (L, delta), its law over K, the stiffness
of the residual beside the modes; a static load meets the whole half around the joint, K_0 (joint_law.py),

    L_0 = L + K_0 delta,     delta = K^-1 (L_K - L)
    L_0' = L_0 + Delta L - sum over other joints of K_(k-j) (delta' - delta)_j,     (delta', T', m')_k = law_0(L_0', P + Delta P)_k

and the rivet's loads change by law_0(L_0', P + Delta P) - law_0(L_0, P), which is 0 without a film.  One sweep leaves 10 % of the
change, two leave 1.3 %.  A film whose Delta L is less than 0.5 % of the joints' loads has one sweep, from 1 % on two, between them a
smooth part of the second.  In the plane friction and play that the motion leaves over carry Delta V, as between rigid halves
(joint_slip.py).

The second and the third wave of the load bend the rims and so the film's own gap: they act on the modes (land_bent.py), which
carry the bonded loads of the joints to 2 %, and leave only Delta P and dm here.  Films that leave the rims round are left out.
Smoothness: that of the law, C1.
"""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np

from bearing_model.cage.common.joint_law import joint_law
from bearing_model.cage.common.joint_slip import joint_slip_add
from bearing_model.cage.elastic.half_modes import RIM_WAVES
from bearing_model.cage.two_half.half_path import land_harmonics, land_rows
from bearing_model.generated.variables import Z
from bearing_model.numbers.lanes import maximum
from bearing_model.physics.land_bent import smooth_part
from bearing_model.physics.land_film import land_film_loads

LITTLE = 0.005  # Delta L over the loads of the joints, root mean square, that one sweep is for


def answers(law, intact, L_0, P):
    """Moves of the pads and loads of the rivets [..., Z, 3] by L_0; a broken joint carries nothing."""
    move, rivet = joint_law(law, L_0, P)
    free = np.linalg.solve(law.stiffness[0], np.swapaxes(L_0, -1, -2)).swapaxes(-1, -2)
    return np.where(intact, move, free), np.where(intact, rivet, 0.0)


def second_part(length, start, bonded, P):
    """Part of the second sweep [..., 1, 1], by the sizes of the film's loads and of all."""
    per = np.array([1.0, 1.0 / length, 1.0 / length])
    film, load = (np.sum((x * per) ** 2, axis=(-2, -1)) for x in (bonded, start))
    ratio = film / (load + np.sum(P * P, axis=-1) + 1e-30)
    return smooth_part((ratio - LITTLE**2) / (3.0 * LITTLE**2))[..., None, None]


def static_changes(model, trial, load, bonded, P, more_P):
    """Changes of the joints' loads and of their rivets' [..., Z, 3] by loads `bonded` and preloads `more_P` of bonded joints,
    from the trial loads L_K and loads L by the modes.
    """
    law, intact = model.d.table.half.law, np.asarray(model.d.intact)[:, None] > 0.0
    K_0 = law.stiffness[0]
    start = load + (trial - load) @ np.linalg.inv(model.modes.law.stiffness).T @ K_0.T
    first, more_P = start + bonded, maximum(P + more_P, 0.0)
    before, now = answers(law, intact, start, P), answers(law, intact, first, more_P)
    relief = ((now[0] - before[0]).reshape(*start.shape[:-2], -1) @ law.among.T).reshape(start.shape)
    again, part = answers(law, intact, first - relief, more_P), second_part(law.length, start, bonded, P)
    move, rivet = (one + part * (two - one) for one, two in zip(now, again, strict=True))
    return bonded - part * relief - (move - before[0]) @ K_0.T, rivet - before[1]


def beside_modes(land):
    """Rows of half_path.py without those of the joints' loads by the shapes that the modes bend."""
    land = land.copy()
    for n in RIM_WAVES:
        if n < len(land):
            land[n, np.abs(land_harmonics(Z)[n]) == n, :, :5] = 0.0
    return land


def elastic_lands(model, w, P, shear):
    """Loads of the joints and of their rivets [3, ..., Z] with the films; adds the shear loads that they put on plates, heads and
    shanks.  P: preloads with the centrifugal load.
    """
    j, d = w.cage.elastic.joints, model.d
    rows = land_rows(
        replace(d.table.half, land=beside_modes(d.table.half.land)), model.p.cage.land_x, land_film_loads(model, w)
    )
    trial, load = (np.moveaxis(x, 0, -1) for x in (j.trial, j.load))
    P = P + 0.0 * rows[..., 0]
    load, rivet = (
        np.moveaxis(change, -1, 0)
        for change in static_changes(model, trial, load, rows[..., [0, 3, 4]], P, rows[..., 5])
    )
    load = j.load + load
    rivet = j.rivet + (rivet + d.intact * np.moveaxis(rows[..., 5:] * [0.0, 1.0, 1.0], -1, 0))
    rivet[0] = maximum(rivet[0], 0.0)
    N_plate = maximum(rivet[0] - load[0], 0.0)
    joint_slip_add(model, w, j.u, rivet[0], N_plate, np.moveaxis(rows[..., 1:3], -1, 0), shear)
    return SimpleNamespace(load=load, rivet=rivet)
