// Drag in the mixture between the rings.
//
//   ball       F = -(1/2) C_d rho_mix (pi D^2/4) v_t |v_t|               Schlichting, Boundary-Layer Theory
//   end face   T_CDS = (1/2) rho_mix omega^2 (r_o^5 - r_i^5) C_n/2,      Re = omega r_o^2/nu
//              C_n = 3.87/sqrt(Re) laminar, 0.146/Re^0.2 turbulent
//   cylinder   T_CDO = tau A R,  tau = rho_mix nu omega R/c (Couette), with Taylor vortices 1.3 (Ta/41)^0.539 times
//              more, Ta = omega R c/nu sqrt(c/R)
//
// Gupta, Advanced Dynamics of Rolling Elements (1984), churning of rotating cylinders and disks.  The mixture
// has the oil's kinematic viscosity nu.  The larger one of the laminar and the turbulent moment counts, which
// makes the drag continuous.  The film between land and ring is in land_film.c.
#include "drag.h"

void drag_force(const Model *model, Work *w)
{
    const wide k = wide_set(model->d->drag);
    for (int b = 0; b < PACKETS; b++) {
        const int j = b * LANE_WIDTH;
        const wide v_t = wide_load(&w->v_t[j]), F = -k * v_t * wide_abs(v_t);
        wide_store(&w->F_t[j], wide_load(&w->F_t[j]) + F);
        wide_store(&w->dissipated[j], wide_load(&w->dissipated[j]) - F * v_t);
        wide_store(&w->drag_dissipated[j], -(F * v_t));
    }
}

void drag_cage(const Model *model, Work *w)
{
    const Derived *d = model->d;
    w->cage_drag_dissipated = 0.0;
    for (int first = 0; first < 2; first += HALVES) {
        Rotor *half = &w->half[first];
        const wide omega = wide_pair(half[0].Omega[0], half[HALVES - 1].Omega[0]);
        const wide speed = wide_abs(omega) + 1e-30;
        wide disk = d->disk_laminar * wide_sqrt(speed), cylinder = wide_set(d->cylinder_laminar);
        if (wide_any(wide_above(speed, d->disk_laminar_omega)))
            disk = wide_max(disk, d->disk_turbulent * wide_exp(0.8 * wide_log(speed)));
        if (wide_any(wide_above(speed, d->cylinder_laminar_omega)))
            cylinder = wide_max(cylinder, d->cylinder_vortex * wide_exp(0.539 * wide_log(speed)));
        for (int h = 0; h < HALVES; h++) {
            const scalar M = -(wide_lane(disk, h) + wide_lane(cylinder, h)) * wide_lane(omega, h);
            half[h].M[0] += M;
            w->cage_dissipated -= M * wide_lane(omega, h);
            w->cage_drag_dissipated -= M * wide_lane(omega, h);
        }
    }
}
