"""Rings as cylinders that rotation and fits press apart or together: Lame's cylinders in plane stress.

radius r of a cylinder from a to b, pressure p_a in its bore and p_b around it, rotation omega:

  u = (1/E) ((1 - nu)(p_a a^2 - p_b b^2) r + (1 + nu)(p_a - p_b) a^2 b^2/r)/(b^2 - a^2)
      + rho omega^2 r/(8 E) ((3 + nu)(1 - nu)(a^2 + b^2) + (3 + nu)(1 + nu) a^2 b^2/r^2 - (1 - nu^2) r^2)
                                                                Timoshenko & Goodier, Theory of Elasticity, sections 28,
                                                                32

seat on the shaft     u_ring - u_shaft = I/2: the pressure is (I/2 - (growth of ring - growth of shaft))/(sum of both compliances), or 0 with a loose
                      ring; growth of the bores is ~ omega^2
groove of the inner   u = growth omega^2 + per_fit max(0, fit - loosening omega^2)                     C0 where the fit comes loose
ring
outer ring            stands in its housing: its groove and its land become smaller by the fit alone

a, b of the inner ring: bore, effective outside diameter; of the outer ring: effective inside, outside diameter.  At
temperature the interference changes by the difference of the expansions (temperature.py).  Neglected: the ring's flanks
and its curvature across, roughness that the fit flattens, bending by loads.
"""

from dataclasses import dataclass

import numpy as np

from bearing_model.generated.variables import Switch


@dataclass(frozen=True)
class RingFit:
    """Growth of the inner groove's radius by rotation and fit."""

    growth: float  # by rotation with a loose shaft / omega^2 [m.s2]
    per_fit: float  # per radial interference of the tight shaft
    fit: float  # radial interference at standstill [m]
    loosening: float  # its loss by rotation / omega^2 [m.s2]


@dataclass(frozen=True)
class Cylinder:
    """Radii a and b [m], Young's modulus [Pa], Poisson's ratio, density [kg/m3]."""

    a: float
    b: float
    E: float
    nu: float
    rho: float = 0.0

    def by_bore(self, r):
        """Displacement at r [m] per pressure in the bore [m/Pa]."""
        a_2, b_2 = self.a**2, self.b**2
        return ((1.0 - self.nu) * a_2 * r + (1.0 + self.nu) * a_2 * b_2 / r) / (self.E * (b_2 - a_2))

    def by_rim(self, r):
        """Displacement at r [m] per pressure around the cylinder [m/Pa]."""
        a_2, b_2 = self.a**2, self.b**2
        return -((1.0 - self.nu) * b_2 * r + (1.0 + self.nu) * a_2 * b_2 / r) / (self.E * (b_2 - a_2))

    def by_rotation(self, r):
        """Displacement at r [m] / omega^2 [m.s2]."""
        nu, a_2, b_2 = self.nu, self.a**2, self.b**2
        square = (3 + nu) * (1 - nu) * (a_2 + b_2) + (3 + nu) * (1 + nu) * a_2 * b_2 / r**2 - (1 - nu**2) * r**2
        return self.rho * r / (8.0 * self.E) * square


def ring_fit_speed(load):
    """Speed of the inner ring in the fixed frame, by which it grows [rad/s]; load: RingLoad."""
    return load.omega + load.frame_omega


def ring_fit_growth(fit, omega):
    """Growth of the inner groove's radius at the speed omega [m]."""
    left = fit.fit - fit.loosening * omega**2
    return fit.growth * omega**2 + fit.per_fit * np.where(np.real(left) > 0.0, left, 0.0)


def ring_fit_rate(fit, omega, omega_dot):
    """Its rate where the speed changes by omega_dot [m/s]."""
    tight = np.real(fit.fit - fit.loosening * omega**2) > 0.0
    return 2.0 * omega * omega_dot * (fit.growth - np.where(tight, fit.per_fit * fit.loosening, 0.0))


def ring_fit_bore(p):
    """Bore of the inner ring [m], after the rule where the parameter leaves it open; likewise the three below."""
    return p.ring.bore if p.ring.bore > 0.0 else p.bearing.d_m - p.bearing.D / 0.6


def ring_fit_outside(p):
    return p.ring.outside if p.ring.outside > 0.0 else p.bearing.d_m + p.bearing.D / 0.6


def ring_fit_effective_i(p):
    return (
        p.ring.effective_i
        if p.ring.effective_i > 0.0
        else p.bearing.d_m - p.bearing.D + 2.0 * p.bearing.h_i * p.bearing.D
    )


def ring_fit_effective_e(p):
    return (
        p.ring.effective_e
        if p.ring.effective_e > 0.0
        else p.bearing.d_m + p.bearing.D - 2.0 * p.bearing.h_e * p.bearing.D
    )


def ring_fit_of(p):
    """Growth and fit of the inner ring."""
    seat, r = 0.5 * ring_fit_bore(p), 0.5 * (p.bearing.d_m - p.bearing.D)
    ring = Cylinder(seat, 0.5 * ring_fit_effective_i(p), p.bearing.E, p.bearing.nu, p.ring.rho)
    shaft = Cylinder(0.5 * p.shaft.bore, seat, p.shaft.E, p.shaft.nu, p.shaft.rho)
    grows = p.scene.growth == Switch.ON
    return RingFit(
        growth=ring.by_rotation(r) if grows else 0.0,
        per_fit=ring.by_bore(r) / (ring.by_bore(seat) - shaft.by_rim(seat)),
        fit=0.5 * p.shaft.interference,
        loosening=ring.by_rotation(seat) - shaft.by_rotation(seat) if grows else 0.0,
    )


def ring_fit_housing(p, r):
    """How much the housing's fit takes from the radius r of the outer ring [m]."""
    seat = 0.5 * ring_fit_outside(p)
    ring = Cylinder(0.5 * ring_fit_effective_e(p), seat, p.bearing.E, p.bearing.nu)
    housing = Cylinder(
        seat, 0.5 * p.housing.outside if p.housing.outside > 0.0 else 1e3 * seat, p.housing.E, p.housing.nu
    )
    interference = max(0.5 * p.housing.interference, 0.0)
    return -ring.by_rim(r) * interference / (housing.by_bore(seat) - ring.by_rim(seat))
