// Viscosity of an oil at its temperature, from two points: Walther's law as ASTM D341 has it.
//
//   lg lg(nu + 0.7) = A - B lg T            nu [mm2/s] from 2 mm2/s up, T [K]
#pragma once

#include "numbers/elementary.h"

typedef struct {
    double A, B;
} Oil;

static inline double lg(double x)
{
    return portable_log(x) / 2.302585092994046;
}

// An oil by its kinematic viscosities nu_1 > nu_2 [m2/s] at the temperatures T_1 < T_2 [K].
static inline Oil oil_of(double nu_1, double T_1, double nu_2, double T_2)
{
    const double y_1 = lg(lg(1e6 * nu_1 + 0.7)), y_2 = lg(lg(1e6 * nu_2 + 0.7));
    const double B = (y_1 - y_2) / lg(T_2 / T_1);
    return (Oil){.A = y_1 + B * lg(T_1), .B = B};
}

// Kinematic viscosity [m2/s] at T [K].
static inline double oil_nu(const Oil *oil, double T)
{
    return 1e-6 * (portable_pow(10.0, portable_pow(10.0, oil->A - oil->B * lg(T))) - 0.7);
}

// -d ln(nu)/dT [1/K] at T [K].
static inline double oil_beta(const Oil *oil, double T)
{
    const double z = 1e6 * oil_nu(oil, T) + 0.7;
    return portable_log(z) * oil->B / T * z / (z - 0.7);
}
