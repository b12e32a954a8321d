"""Drag in the mixture between the rings.

    density    rho = X rho_oil + (1 - X) rho_air, X = 10^5 W^0.37/(n d_m^1.7), at most 1: volume fraction of oil with the flow W [cm3/min]
               through the bearing, n [r/min], d_m [mm]; without a given flow rho = rho_mix                        Parker, NASA TP-2275 (1984)
    ball       F = -(1/2) C_d rho (pi D^2/4) v |v|,  v = v_t - stream r                                           Schlichting, Boundary-Layer Theory
    churning   M = -(1/2) rho R^5 C_n omega |omega|, omega of the ball less that of the stream, C_n = 6.45/sqrt(Re) + 32.1/Re,
               Re = R^2 |omega|/nu                                                      Dennis, Singh & Ingham (1980), J. Fluid Mech. 101, 257
    end face   T_CDS = (1/2) rho omega^2 (r_o^5 - r_i^5) C_n/2,  C_n = 3.87/sqrt(Re) laminar, 0.146/Re^0.2 turbulent, Re = omega r_o^2/nu
    cylinder   T_CDO = tau A R,  tau = rho nu omega R/c (Couette), with Taylor vortices 1.3 (Ta/41)^0.539 times more, Ta = omega R c/nu sqrt(c/R)

Gupta, Advanced Dynamics of Rolling Elements (1984), churning of balls, rotating cylinders and disks.  The mixture has
the oil's kinematic viscosity nu.  The larger one of the laminar and the turbulent moment counts, which makes the drag
continuous.  The film between land and ring is in land_film.py.

A row of balls in a cage carries the mixture along: the mixture turns at `stream` = x omega_cage.  The balance of its
angular momentum gives x: the balls drive the mixture, the inner ring drives it too, the outer ring brakes it, and fresh
oil, which comes without swirl, has to be brought to speed,

    B (1 - x)|1 - x| + I (sigma - x)^2 - E x^2 - N x = 0,         sigma = omega/omega_m = 2/(1 - gamma)
    B = Z C_d pi D^2/4,  I = f_i A_i (r_i/r_m)^3,  E = f_e A_e (r_e/r_m)^3,  N = 2 rho_oil W/(rho omega_m r_m)

per (1/2) rho omega_m^2 r_m^3, with the radii of the pitch circle r_m and the groove bottoms r_i, r_e, the walls' areas
A beside the lands, and their friction f = 0.066 Re^-0.25, Re = |omega_wall - omega_m| r h/nu over the height h between
the shoulders (turbulent bulk flow; Hirs (1973), J. Lubr. Technol. 95, 137).  With isolated balls the mixture stands.
Neglected: the cage's bore, which holds the mixture too.

A cage that still turns when the rings stop works the mixture too.  The omega of walls and fresh oil is therefore half of
the speed at which this cage would roll, at the least: the friction factor is infinite at none.  By half, and not the
whole, the rings decide in any rolling; where they stop the factor is 0.5^-0.25 = 1.19 times that of the whole.

All speeds are against the outer ring (outer_ring.py): oil and air at its walls turn with it.
"""

import numpy as np

from bearing_model.generated.variables import Drag, Switch
from bearing_model.numbers.lanes import absolute, maximum
from bearing_model.numbers.vec import vec, vec_dot, vec_local
from bearing_model.physics.outer_ring import outer_ring, outer_ring_velocity

TINY_SPEED = 1e-30  # [rad/s]: keeps roots and quotients finite at standstill


def carried_share(d, wall, fresh):
    """x of the balance at the head of this file.  wall: |omega|^-0.25; fresh: N."""
    sigma = d.sigma
    inner, outer = d.inner_wall * wall, d.outer_wall * wall
    surplus = inner * (sigma - 1.0) ** 2 - outer - fresh  # the balance at x = 1
    B = np.where(np.real(surplus) > 0.0, -d.ball_area, d.ball_area)
    # a x^2 - 2 b x + c = 0
    a, b, c = B + inner - outer, B + inner * sigma + 0.5 * fresh, B + inner * sigma**2
    root = np.sqrt(b * b - a * c)
    late = np.real(b) < 0.0
    return np.where(late, b - root, c) / np.where(late, a, b + root)


def drag_mixture(model, w):
    """Sets density (filling: over that of the derived constants) and angular speed about X [rad/s] (stream) of the
    mixture.
    """
    p, d, outer = model.p, model.d, model.ring_load.outer_omega
    cage = 0.5 * (w.half[0].Omega[0] + w.half[1].Omega[0]) - outer
    rings = absolute(np.asarray(model.ring_load.omega - outer))
    speed = maximum(rings, absolute(0.5 * d.sigma * cage)) + TINY_SPEED
    w.filling, w.stream, w.wall = 1.0, outer, 0.0
    if p.oil.flow > 0.0:
        X = np.where(np.real(rings) > d.flooded_omega, d.flooded_omega / (rings + TINY_SPEED), 1.0)
        w.filling = d.air + (1.0 - d.air) * X
    if p.scene.drag == Drag.ROW:
        w.wall = 1.0 / np.sqrt(np.sqrt(speed))
        x = carried_share(d, w.wall, d.fresh / (w.filling * speed))
        w.stream = outer + x * cage


def drag_force(model, w):
    """Adds drag and churning of the balls."""
    d, outer = model.d, outer_ring(model.ring_load, w.x)
    stream = w.stream - model.ring_load.outer_omega
    v_t = w.v_t - outer_ring_velocity(outer, vec(w.x, w.r, 0.0), w.cos_theta, w.sin_theta)[2]
    v = v_t - stream * w.r
    F = -d.drag * w.filling * v * absolute(v)
    w.F = w.F + vec(0.0, 0.0, F)
    w.drag_dissipated = -F * v_t
    if model.p.scene.churning == Switch.ON:
        omega = vec(w.omega_x, w.omega_r, w.omega_t) - vec_local(outer.Omega, w.cos_theta, w.sin_theta)
        spin = omega - vec(stream + 0.0 * w.omega_x, 0.0, 0.0)
        speed = np.sqrt(vec_dot(spin, spin) + TINY_SPEED)
        M = -w.filling * (d.churning_viscous + d.churning_boundary * np.sqrt(speed)) * spin
        w.M = w.M + M
        w.drag_dissipated = w.drag_dissipated - vec_dot(M, omega)


def drag_cage(model, w):
    """Adds the drag moments of the halves' end faces and cylinders."""
    d, w.cage_drag_dissipated = model.d, 0.0
    for half in w.half:
        omega = half.Omega[0] - outer_ring(model.ring_load, half.s).Omega[0]
        speed = absolute(omega) + TINY_SPEED
        disk = maximum(d.disk_laminar * np.sqrt(speed), d.disk_turbulent * speed**0.8)
        cylinder = maximum(d.cylinder_laminar, d.cylinder_vortex * speed**0.539)
        M = -(disk + cylinder) * w.filling * omega
        half.M = half.M + vec(M, 0.0, 0.0)
        w.cage_drag_dissipated = w.cage_drag_dissipated - M * omega


def drag_ring(model, w):
    """Adds the mixture's friction on the inner ring to the ring's moment; sets its power."""
    ring_load = model.ring_load
    s = w.ring.s - vec_dot(w.ring.a, outer_ring(ring_load, w.ring.x[0]).Omega)
    slip = s - (w.stream - ring_load.outer_omega)
    M = -model.d.ring_drag * w.filling * w.wall * slip * absolute(slip)
    w.ring.M = w.ring.M + M * w.ring.a
    w.ring_drag_dissipated = -M * s
