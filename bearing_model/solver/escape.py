"""States that no bearing reaches: bodies have passed through each other, and nothing in the model brings them back.  A run
ends before such a state.

    balls    two neighbours overlap, their centres closer than R_j + R_k: only the cage holds them apart
    cage     a half's centre is farther off the outer ring's axis than the clearance of its guidance and half of its
             section, C + (D_o - D_i)/4, where its pockets end
    contact  a ball is pressed into a race or a pocket by more than half of its radius
"""

import numpy as np

from bearing_model.generated.variables import Z
from bearing_model.numbers.vec import vec, vec_to_global


def contact_find(model, w):
    limit, where = 0.25 * model.p.bearing.D, ("inner race", "outer race", "pocket", "pocket")
    for delta, name in zip((w.delta_i, w.delta_e, *w.delta_c), where, strict=True):
        j = np.argmax(delta)
        if delta[j] > limit:
            deep = f"it is {delta[j]:.4g} m deep in it; bearing.D/4 = {limit:.4g} m is possible"
            return f"ball[{j + 1}] passes through its {name}: {deep}"
    return ""


def cage_find(model, w):
    across = model.d.play + 0.25 * (model.p.cage.D_o - model.p.cage.D_i)
    for h, half in enumerate(w.half, 1):
        at, y, z = (half.x - w.outer_x)[..., 0]
        e = np.hypot(y - at * w.outer_gamma, z + at * w.outer_beta).item()
        if e > across:
            allowed = f"its clearance and (cage.D_o - cage.D_i)/4 allow {across:.4g} m"
            return f"cage half {h} leaves the bearing: it is {e:.4g} m off the outer ring's axis; {allowed}"
    return ""


def balls_find(model, w):
    position = vec_to_global(vec(w.x, w.r, 0.0), w.cos_theta, w.sin_theta)
    distance = np.sqrt(np.sum((position - np.roll(position, -1, axis=-1)) ** 2, axis=0))
    limit = model.d.R + np.roll(model.d.R, -1)
    j = np.argmax(distance < limit)
    if distance[j] < limit[j]:
        apart = f"their centres are {distance[j]:.4g} m apart, at least {limit[j]:.4g} m is possible"
        return f"ball[{j + 1}] and ball[{(j + 1) % Z + 1}] overlap: {apart}"
    return ""


def escape_find(model, w):
    """Why no bearing reaches the state of the evaluation w, "" if one does.  Neighbours overlap only where a ball is deep in
    the bar between two pockets.
    """
    reason = cage_find(model, w)
    if not reason and np.max(w.delta_c) > 0.125 * model.d.bar:
        reason = balls_find(model, w)
    return reason or contact_find(model, w)
