// Elastic point contact of two smooth bodies.  The stiffness is computed once; the load law is part of the
// right-hand side.
#pragma once

#include "numbers/elementary.h"
#include "physics/model.h"

// Contact of bodies whose principal curvatures add up to rho_x in one direction and rho_y in the other [1/m],
// rho_x > rho_y >= 0.  1/E_star = sum (1 - nu^2)/E.  The ellipse's long axis a lies along y.
Hertz hertz_contact(double rho_x, double rho_y, double E_star);

// Complete elliptic integrals of the first and second kind of the modulus whose square is k2, by the
// arithmetic-geometric mean.
void hertz_elliptic(double k2, double *first, double *second);

// Load Q = K delta^1.5, none in separation.  C1 at touch-down.  Johnson (1985), eq. 4.23.
INLINE wide hertz_load(wide K, wide delta)
{
    delta = wide_max(delta, wide_set(0.0));
    return K * delta * wide_sqrt(delta);
}

// Elastic energy (2/5) K delta^2.5, the integral of the load.
INLINE wide hertz_energy(wide K, wide delta)
{
    return 0.4 * hertz_load(K, delta) * wide_max(delta, wide_set(0.0));
}

// The same energy of one contact, in doubles.
static inline double hertz_stored(double K, double delta)
{
    return delta > 0.0 ? 0.4 * K * delta * delta * sqrt(delta) : 0.0;
}

// Largest pressure p_max = 3 Q/(2 pi a b); the semi-axes grow with the cube root of the load.
static inline scalar hertz_pressure(const Hertz *hertz, scalar Q)
{
    return 1.5 * scalar_cbrt(Q) / (PI * hertz->a * hertz->b);
}

// Hunt-Crossley damping: Q (1 + lambda delta_dot), never pulling.  Hunt & Crossley (1975), J. Appl. Mech. 42,
// 440.
INLINE wide hertz_damped(wide Q, wide lambda, wide delta_dot)
{
    return Q * wide_max(1.0 + lambda * delta_dot, wide_set(0.0));
}
