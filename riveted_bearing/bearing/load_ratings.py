"""Load ratings of a single-row deep groove ball bearing from its balls: dynamic by ISO 281, static by ISO 76; equivalent
load and factor of the modified life.

    C   = b_m f_c Z^(2/3) D^1.8 (D up to 25.4 mm, else 3.647 D^1.4)      f_c, f_0: functions of gamma = D/d_m for the standards' grooves
    C_0 = f_0 Z D^2
    P   = X F_r + Y F_a                                                  X, Y: functions of f_0 F_a/C_0
    a_ISO = 0.1 (1 - g(kappa)^0.83 (e_C C_u/P)^(1/3))^-9.3               kappa = nu/nu_1, e_C: cleanliness of the oil

The standards tabulate f_c and f_0; the formulas behind the tables are used here.
Sources: ISO 281:2007; ISO/TR 1281-1:2008 (f_c); ISO 76:2006 and ISO/TR 10657:1991 (f_0: 4200 MPa under the ball load 5
C_0/Z).
"""

import math

import numpy as np

from bearing_model.physics.hertz_exact import ball_race_contact

B_M = 1.3  # rating factor of contemporary steel
LAMBDA = 0.95  # reduction factor of single-row radial ball bearings
A_1 = 98.0665  # 0.089 times the material constant [N, mm]
F_GROOVE = 0.52  # groove radius / D of both races for which the table of f_c is made
F_STATIC = {"inner": 0.52, "outer": 0.53}  # those for which the table of f_0 is made
P_STATIC = 4.2e9  # contact pressure under the static rating [Pa]
AXIAL = (0.172, 0.345, 0.689, 1.03, 1.38, 2.07, 3.45, 5.17, 6.89)  # f_0 F_a/C_0 of ISO 281:2007, table 3, ...
Y_AXIAL = (2.30, 1.99, 1.71, 1.55, 1.45, 1.31, 1.15, 1.04, 1.00)  # ... its factors Y ...
E_AXIAL = (0.19, 0.22, 0.26, 0.28, 0.30, 0.34, 0.38, 0.42, 0.44)  # ... and the F_a/F_r up to which F_a does not count
X_RADIAL = 0.56
# e_C = a (1 - b/d_m^(1/3)), a = c kappa^0.68 d_m^0.55 <= 1 with d_m in mm: c and b of ISO 281:2007, annex A, by cleanliness
CLEANLINESS = {
    "high": (0.0864, 0.6796),  # sealed and greased for life, or oil filtered through an extremely fine filter
    "normal": (0.0432, 1.141),  # shielded and greased for life, or oil filtered through a fine filter
    "typical": (0.0177, 1.887),  # slight to typical contamination
    "severe": (0.0115, 2.662),
    "very severe": (0.00617, 4.06),
    "-/13/10": (0.0864, 0.6796),  # oil bath, or filtered off line, by its code of ISO 4406
    "-/15/12": (0.0288, 1.141),
    "-/17/14": (0.0133, 1.670),
    "-/19/16": (0.00864, 2.5164),
    "-/21/18": (0.00411, 3.8974),
    "-/13/10 filtered": (0.0864, 0.5663),  # circulating oil, filtered on line
    "-/15/12 filtered": (0.0432, 0.9987),
    "-/17/14 filtered": (0.0288, 1.6329),
    "-/19/16 filtered": (0.0216, 2.3362),
}
KAPPA = (0.1, 4.0)  # range of the modified life
MOST_A_ISO = 50.0
LEAST_A_ISO = 0.1


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


def equivalent_load(F_r, F_a, C_0, gamma):
    """Dynamic equivalent load P = X F_r + Y F_a [N] of a deep groove bearing of usual clearance.  ISO 281:2007, 5.2 and
    table 3.

    >>> print(f"{equivalent_load(4e3, 2e3, 20e3, 0.2):.0f}")  # f_0 F_a/C_0 = 1.40: Y = 1.45
    5134
    """
    axial = rating_factor_0(gamma) * F_a / C_0
    if F_a <= float(np.interp(axial, AXIAL, E_AXIAL)) * F_r:
        return F_r
    return X_RADIAL * F_r + float(np.interp(axial, AXIAL, Y_AXIAL)) * F_a


def fatigue_load_limit(C_0, d_m):
    """Fatigue load limit C_u [N] of a ball bearing with the static rating C_0.  ISO 281:2007, annex B, simplified."""
    return C_0 / 22.0 * min(1.0, (0.1 / d_m) ** 0.5)


def contamination_factor(cleanliness, kappa, d_m):
    """Contamination factor e_C of an oil by its cleanliness, a name of CLEANLINESS.  ISO 281:2007, annex A.

    >>> print(f"{contamination_factor('normal', 1.0, 0.0535):.3f} {contamination_factor('high', 4.0, 0.0535):.3f}")
    0.269 0.820
    """
    c, b = CLEANLINESS[cleanliness]
    mm, kappa = 1e3 * d_m, min(max(kappa, KAPPA[0]), KAPPA[1])
    return max(min(1.0, c * kappa**0.68 * mm**0.55) * (1.0 - b / mm ** (1 / 3)), 0.0)


def life_factor(kappa, load):
    """Factor a_ISO of the modified life of a radial ball bearing; load: e_C C_u/P.  ISO 281:2007, 9.3.3.4, equations (31)
    to (33).

    Beyond kappa = 4 it stays; below 0.1, where the standard ends, it is the least one.  Continuous in kappa to 1e-3.

    >>> print(f"{life_factor(0.4, 0.3):.3f} {life_factor(1.0, 0.3):.3f} {life_factor(4.0, 0.3):.1f}")
    0.541 15.567 50.0
    """
    if kappa < KAPPA[0]:
        return LEAST_A_ISO
    kappa = min(kappa, KAPPA[1])
    c, exponent = (2.2649, 0.054381) if kappa < 0.4 else (1.9987, 0.19087 if kappa < 1.0 else 0.071739)
    left = 1.0 - (2.5671 - c * kappa**-exponent) ** 0.83 * load ** (1 / 3)
    return min(0.1 * left**-9.3, MOST_A_ISO) if left > 0.0 else MOST_A_ISO
