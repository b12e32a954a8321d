"""Traction of a contact, at its middle or over slices, with its film and the inlet's rolling friction.  Equations in race_contact.py."""

from types import SimpleNamespace

import numpy as np

from bearing_model.generated.variables import Traction
from bearing_model.numbers.vec import vec_cross, vec_dot
from bearing_model.physics.race_spin import slices, split_place
from bearing_model.physics.traction import (
    Q_FLOOR,
    traction_asperity_share,
    traction_ln_film,
    traction_ln_thermal,
    traction_mu,
    traction_race_inlet,
)


def race_traction(model, race, c, mixed):
    """Forces on the ball by traction at a point or over the slices and by the inlet's rolling friction.

    c: the contact, normal n, rolling direction t_1, long axis t_2, slip Delta u, mean speed roll = U, spin = omega_ball
    - Omega of the race, approach = velocity of the ball's centre against the race there, load Q, sqrt_delta, ball
      radius R.
    Returns U with its floor [m/s], F_s at the contact point, F_c through the ball's centre [N], M of F_s about the
    ball's centre with spin [N.m], dissipated power, of it by the inlet and by spin about the normal [W]; for the
    integrator's Jacobian (verlet.py) the secant coefficients g = |traction|/|slip| [N.s/m] and g_spin = moment/spin
    [N.m.s].
    """
    p = model.p
    U = np.sqrt(vec_dot(c.roll, c.roll) + p.oil.U_0**2)
    ln_U, ln_Q = np.log(U), np.log(c.Q + Q_FLOOR)
    f_a = (
        traction_asperity_share(
            traction_ln_film(race.ln_Lambda, ln_U, ln_Q) + traction_ln_thermal(model.d.ln_thermal, ln_U)
        )
        if mixed
        else 0.0
    )
    F_R = traction_race_inlet(model.d, race.rolling, U, ln_U, c.Q, ln_Q)

    # slip along t_1 and t_2 at x = xi/a: s_1 + k x + b_1 x^2, s_2 + b_2 x^2
    sliced = p.scene.traction == Traction.SLICED
    a = race.hertz.a_delta * c.sqrt_delta
    sagitta = a * a * (0.5 / race.R_m)
    spin_n = vec_dot(c.spin, c.n)
    s_1, s_2, k = vec_dot(c.slip, c.t_1), vec_dot(c.slip, c.t_2), -a * spin_n
    b_1, b_2 = -sagitta * vec_dot(c.spin, c.t_2), sagitta * vec_dot(c.spin, c.t_1)
    x, share = slices(split_place(s_1, k, b_1)) if sliced else (np.zeros((1, *a.shape)), 1.0)
    slip_1, slip_2 = s_1 + k * x + b_1 * x * x, s_2 + b_2 * x * x
    squared = slip_1 * slip_1 + slip_2 * slip_2
    slip = np.sqrt(squared + p.oil.v_0**2)
    g = share * traction_mu(p, slip / U, f_a, mixed) * c.Q / slip
    F = -g * (slip_1 * c.t_1[:, None] + slip_2 * c.t_2[:, None])
    lever = (c.R - sagitta * x * x) * c.n[:, None] + a * x * c.t_2[:, None]
    out = SimpleNamespace(U=U, F_s=F.sum(axis=1), M=vec_cross(lever, F).sum(axis=1))
    out.g, out.g_spin, out.dissipated = (part.sum(axis=0) for part in (g, g * (a * x) ** 2, g * squared))
    out.spin_dissipated = -vec_dot(out.M, c.n) * spin_n if sliced else 0.0
    # Inlet: -F_R U/|U| at the surface, the film's horizontal pressure force +F_H U/|U| through the ball's centre.
    rolling = F_R / U * c.roll
    out.F_s = out.F_s - rolling
    out.M = out.M - vec_cross(c.R * c.n, rolling)
    out.F_c = race.horizontal * rolling
    out.inlet_dissipated = vec_dot(rolling, c.slip) - vec_dot(out.F_c, c.approach)
    out.dissipated = out.dissipated + out.inlet_dissipated
    return out
