// Rings as cylinders that rotation and fits press apart or together: Lame's cylinders in plane stress.
//
//   radius r of a cylinder from a to b, pressure p_a in its bore and p_b around it, rotation omega:
//
//     u = (1/E) ((1 - nu)(p_a a^2 - p_b b^2) r + (1 + nu)(p_a - p_b) a^2 b^2/r)/(b^2 - a^2)
//         + rho omega^2 r/(8 E) ((3 + nu)(1 - nu)(a^2 + b^2) + (3 + nu)(1 + nu) a^2 b^2/r^2 - (1 - nu^2) r^2)
//                                                        Timoshenko & Goodier, Theory of Elasticity, sections 28, 32
//
//   seat on the shaft     u_ring - u_shaft = I/2: the pressure is (I/2 - (growth of ring - growth of shaft))/(sum of
//                         both compliances), or 0 with a loose ring; growth of the bores is ~ omega^2
//   groove of the inner   u = growth omega^2 + per_fit max(0, fit - loosening omega^2)              C0 where the fit
//   ring                                                                                             comes loose
//   outer ring            stands in its housing: its groove and its land become smaller by the fit alone
//
// a, b of the inner ring: bore, effective outside diameter; of the outer ring: effective inside, outside diameter.
// At temperature the interference changes by the difference of the expansions (temperature.c).  Neglected: the ring's
// flanks and its curvature across, roughness that the fit flattens, bending by loads.
#pragma once

#include "physics/model.h"

// Speed of the inner ring in the fixed frame, by which it grows.
INLINE scalar ring_fit_speed(const RingLoad *load)
{
    return load->omega + load->frame_omega;
}

// Growth of the inner groove's radius at the speed omega in the fixed frame.
INLINE scalar ring_fit_growth(const RingFit *fit, scalar omega)
{
    const scalar square = omega * omega;
    return fit->growth * square + fit->per_fit * scalar_max(fit->fit - fit->loosening * square, 0.0);
}

// Rate of this growth where the speed changes by omega_dot.
INLINE scalar ring_fit_rate(const RingFit *fit, scalar omega, scalar omega_dot)
{
    const bool tight = scalar_value(fit->fit - fit->loosening * omega * omega) > 0.0;
    return 2.0 * omega * omega_dot * (fit->growth - (tight ? fit->per_fit * fit->loosening : 0.0));
}

// Diameters of the rings, after the rules where parameters leave them open.
double ring_fit_bore(const Parameters *p);
double ring_fit_outside(const Parameters *p);
double ring_fit_effective_i(const Parameters *p);
double ring_fit_effective_e(const Parameters *p);

// Growth and fit of the inner ring.
RingFit ring_fit_of(const Parameters *p);

// How much the housing's fit takes from the radius r of the outer ring [m].
double ring_fit_housing(const Parameters *p, double r);
