// Oil film between the lands of the cage halves and the outer ring.  Equations in land_film.c.
#pragma once

#include "physics/model.h"

// Part of the clearance at rest below which a half's growth does not narrow it: a half that would fill its clearance is
// beyond this law.
static const double LEAST_CLEARANCE = 0.1;

// Radial guide clearance of a half that turns at the speed omega in space.
INLINE scalar land_clearance(const Derived *d, scalar omega)
{
    return scalar_max(d->C_land - d->growth * (omega * omega), LEAST_CLEARANCE * d->C_land);
}

// Change of a half's radius there per change of that speed.
INLINE scalar land_growth_rate(const Derived *d, scalar omega)
{
    const scalar grown = d->growth * (omega * omega);
    return scalar_value(grown) < (1.0 - LEAST_CLEARANCE) * d->C_land ? 2.0 * d->growth * omega : 0.0 * omega;
}

// Power that the growth of halves whose speed changes puts into the lands' dry contacts.
scalar land_growth_power(const Model *model, const Work *w, const scalar *y_dot);

// Harmonics of the loads on bent rims by the pressure in Work, 0 of faint films.
void land_film_loads(const Work *w, LandLoad load[2]);

// Adds force and moment to both halves (Rotor F, M); sets their film rates, the pressures and loads on their rims, the dissipated power
// and the elastic energy.
void land_film_force(const Model *model, Work *w);
