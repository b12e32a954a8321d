"""Drag in the mixture between the rings.

    ball       F = -(1/2) C_d rho_mix (pi D^2/4) v_t |v_t|                                        Schlichting, Boundary-Layer Theory
    end face   T_CDS = (1/2) rho_mix omega^2 (r_o^5 - r_i^5) C_n/2,  C_n = 3.87/sqrt(Re) laminar, 0.146/Re^0.2 turbulent, Re = omega r_o^2/nu
    cylinder   T_CDO = tau A R,  tau = rho_mix nu omega R/c (Couette), with Taylor vortices 1.3 (Ta/41)^0.539 times more, Ta = omega R c/nu sqrt(c/R)

Gupta, Advanced Dynamics of Rolling Elements (1984), churning of rotating cylinders and disks.  The mixture has the oil's kinematic
viscosity nu.  The larger one of the laminar and the turbulent moment counts, which makes the drag continuous.  The film between land and ring
is in land_film.py.
"""

import numpy as np

from bearing_model.lanes import absolute, maximum
from bearing_model.vec import vec


def drag_force(model, w):
    """Adds the drag of the balls."""
    F = -model.d.drag * w.v_t * absolute(w.v_t)
    w.F = w.F + vec(0.0, 0.0, F)
    w.drag_dissipated = -F * w.v_t


def drag_cage(model, w):
    """Adds the drag moments of the halves' end faces and cylinders."""
    d, w.cage_drag_dissipated = model.d, 0.0
    for half in w.half:
        omega = half.Omega[0]
        speed = absolute(omega) + 1e-30
        disk = maximum(d.disk_laminar * np.sqrt(speed), d.disk_turbulent * speed**0.8)
        cylinder = maximum(d.cylinder_laminar, d.cylinder_vortex * speed**0.539)
        M = -(disk + cylinder) * omega
        half.M = half.M + vec(M, 0.0, 0.0)
        w.cage_drag_dissipated = w.cage_drag_dissipated - M * omega
