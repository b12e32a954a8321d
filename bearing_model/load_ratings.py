"""Load ratings of a single-row deep groove ball bearing from its balls: dynamic by ISO 281, static by ISO 76; its reference
viscosity.

    C   = b_m f_c Z^(2/3) D^1.8 (D up to 25.4 mm, else 3.647 D^1.4)      f_c, f_0: functions of gamma = D/d_m for the standards' grooves
    C_0 = f_0 Z D^2

The standards tabulate f_c and f_0; the formulas behind the tables are used here.
Sources: ISO 281:2007; ISO/TR 1281-1:2008 (f_c); ISO 76:2006 and ISO/TR 10657:1991 (f_0: 4200 MPa under the ball load 5
C_0/Z).
"""

import math

from bearing_model.physics.hertz_exact import ball_race_contact

B_M = 1.3  # rating factor of contemporary steel
LAMBDA = 0.95  # reduction factor of single-row radial ball bearings
A_1 = 98.0665  # 0.089 times the material constant [N, mm]
F_GROOVE = 0.52  # groove radius / D of both races for which the table of f_c is made
F_STATIC = {"inner": 0.52, "outer": 0.53}  # those for which the table of f_0 is made
P_STATIC = 4.2e9  # contact pressure under the static rating [Pa]


def rating_factor_c(gamma):
    """f_c [N, mm] for gamma = D/d_m.

    >>> print(f"{rating_factor_c(0.2):.1f}")  # ISO 281, table 2: 59.9
    59.9
    """
    groove = (2.0 * F_GROOVE / (2.0 * F_GROOVE - 1.0)) ** 0.41
    outer = 1.04 * ((1.0 - gamma) / (1.0 + gamma)) ** 1.72
    shape = gamma**0.3 * (1.0 - gamma) ** 1.39 / (1.0 + gamma) ** (1 / 3)
    return 0.41 * LAMBDA * A_1 * groove * shape * (1.0 + outer ** (10 / 3)) ** -0.3


def rating_factor_0(gamma):
    """f_0 [N/mm2] for gamma = D/d_m: the ball load that presses 4200 MPa into a race, over 5 D^2; of both races the
    smaller one.  The outer race decides below gamma = 0.09.

    >>> print(f"{rating_factor_0(0.05):.1f} {rating_factor_0(0.2):.1f}")  # ISO 76, table 1: 15.7, 14.0
    15.7 14.0
    """
    D = 1e-3
    contacts = (ball_race_contact(D, D / gamma, f, 0.0, 207e9, 0.3, race) for race, f in F_STATIC.items())
    return min((P_STATIC / contact.p_max(1.0)) ** 3 / 5.0 for contact in contacts)


def dynamic_rating(Z, D, d_m):
    """Basic dynamic radial load rating C [N]; D, d_m [m].  ISO 281:2007, 5.1."""
    size = (1e3 * D) ** 1.8 if D <= 25.4e-3 else 3.647 * (1e3 * D) ** 1.4
    return B_M * rating_factor_c(D / d_m) * Z ** (2 / 3) * size


def static_rating(Z, D, d_m):
    """Basic static radial load rating C_0 [N]; D, d_m [m].  ISO 76:2006, 5.1."""
    return rating_factor_0(D / d_m) * Z * (1e3 * D) ** 2


def reference_viscosity(omega, d_m):
    """Kinematic viscosity nu_1 [m2/s] that separates the surfaces enough at this speed [rad/s]; the ratio kappa = nu/nu_1
    enters ISO 281's modified life.  ISO 281:2007, 9.3.3.2, equations (28) and (29), in r/min, mm and mm2/s.

    >>> print(f"{1e6 * reference_viscosity(2e3 * math.pi / 30, 0.1):.1f}")
    10.1
    """
    n = abs(omega) * 30.0 / math.pi
    factor, exponent = (45000.0, -0.83) if n < 1000.0 else (4500.0, -0.5)
    return 1e-6 * factor * n**exponent * (1e3 * d_m) ** -0.5
