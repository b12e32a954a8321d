// Parameters at the temperatures of oil, rings, balls and cage, and in their housing.
//
//   steel    d_i (1 + e_i), d_e (1 + e_e), D (1 + e_b)   diameters of groove bottoms and balls, e = expansion (T - T_a)
//            f_i D (1 + e_i), f_e D (1 + e_e)            groove radii
//            d_i = d_m - D - P_d/2, d_e = d_m + D + P_d/2; from these follow d_m, P_d, f_i, f_e at temperature
//   cage     (D + pocket clearance)(1 + e_c), D_o (1 + e_c), D_i (1 + e_c), land diameter of the outer ring (1 + e_e)
//   rivet    preload and fit: the flanges expand more than the rivet (rivet_rom.h)
//   fits     the seats' interference changes by the difference of the expansions; the outer ring in its housing loses
//            groove diameter and land diameter (ring_fit.h)
//   oil      eta = eta_0 rho(T) nu(T)/(rho(T_0) nu(T_0)), nu by Walther's law (viscosity.h), rho = rho_0 (1 - a (T - T_0)),
//            alpha = alpha_0 exp(-c (T - T_0)), beta = beta_0 beta(T)/beta(T_0)
//
// T_a: temperature at which the rivet table gives preload and fit.  If the host has not given eta_0 or beta_0
// (left at the start value before the run, never set in it), the ratio is taken against the variable table's oil, so
// that the oil's two points alone decide.  At the start values of all temperatures no parameter changes, not
// even its last bit.
// Neglected: expansion of the widths and of
// the circle of rivets, growth of ring and cage inertia, elastic constants over temperature.  Masses stay as they are.
#pragma once

#include "physics/model.h"

enum { TEMPERATURES = 5 };

// The i-th temperature of the inputs: oil, inner ring, outer ring, balls, cage.
double *temperature_of(Inputs *u, int i);

// Whether oil and parts have the same temperatures in both.
bool temperature_same(const Inputs *u, const Inputs *v);

// The parameters p at the temperatures in u; hot may be p.
void temperature_apply(const Parameters *p, const Inputs *u, Parameters *hot);
