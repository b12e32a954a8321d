"""Tangential forces of a lubricated contact: traction of the film, friction of the asperities, rolling friction of the
inlet.

    film        mu(s) = (A + B s) exp(-C s) - A,  s = |Delta u| / U            four-parameter law of aviation oils; mu(0) = 0
    asperities  mu_b s / sqrt(s^2 + s_0^2)        on their share of the load
    share       f_a = exp(-1.8 Lambda^1.2)                                     Aihara (1987), J. Tribol. 109, 471, eq. 13
    Lambda      film / roughness, h/R_x = 2.69 U^0.67 G^0.53 W^-0.067 (1 - 0.61 exp(-0.73 k))    Hamrock & Dowson (1977), central film
    inlet       F_R = 2.86 E' R_x^2 (R_y/R_x)^0.348 G^0.022 U^0.66 W^0.47      Houpert (1987), as in Balan et al., Lubricants 3 (2015), 222
    heating     by shear in the inlet: of the races F_R is 1/(1 + 1.84e-9 (n d_m)^1.28 nu^0.64) times as large, and
    starvation  exp(-K_rs nu n (d + D) sqrt(K_Z/(2 (D - d)))) times                SKF, Rolling Bearings (catalogue, 2018)
                n d_m [r/min mm] from U = n d_m (1 - gamma^2)/4, D - d = ball diameter/0.3, nu [mm2/s]
    thermal     the race films are 3.94/(3.94 + L^0.62) times as thick, L = eta beta u^2/k    Murch & Wilson (1975), J. Lubr. Technol. 97, 212

with U = eta u/(E' R_x), W = Q/(E' R_x^2), G = alpha E', E' = 2 E_star, u the mean surface speed.  Load and speed have
floors, so that these forces are C1 in approach and speed.
"""

import numpy as np

Q_FLOOR = 1.0  # Load [N] below which inlet friction is linear in the load and the film no longer depends on it.


def traction_ln_film(ln_Lambda_1, ln_U, ln_Q):
    """ln Lambda at mean speed U and load Q; ln_Lambda_1 at U = 1 m/s, Q = 1 N."""
    return ln_Lambda_1 + 0.67 * ln_U - 0.067 * ln_Q


def traction_ln_thermal(ln_thermal, ln_U):
    """ln of the thermal factor on a film; ln_thermal: ln L at U = 1 m/s."""
    return -np.log(1.0 + np.exp(0.62 * (ln_thermal + 2.0 * ln_U)) / 3.94)


def traction_asperity_share(ln_Lambda):
    """Part of the load that asperities carry."""
    return np.exp(-1.8 * np.exp(1.2 * ln_Lambda))


def traction_mu(p, s, f_a, mixed):
    """Traction coefficient with the asperity share f_a (zero where there is only film)."""
    film = (p.oil.A + p.oil.B * s) * np.exp(-p.oil.C * s) - p.oil.A
    if not mixed:
        return film
    boundary = p.oil.mu_b * s / np.sqrt(s * s + p.oil.s_0**2)
    return film + f_a * (boundary - film)


def traction_inlet(rolling, ln_U, Q, ln_Q):
    """Rolling friction F_R [N] of the inlet; rolling: F_R at U = 1 m/s, Q = 1 N.  W^0.47 is taken as W (W +
    W_floor)^-0.53, linear at small loads.
    """
    return rolling * Q * np.exp(0.66 * ln_U - 0.53 * ln_Q)


def traction_race_inlet(d, rolling, U, ln_U, Q, ln_Q):
    """F_R [N] of a race, with shear heating and starvation of its inlet."""
    F_R = rolling * Q * np.exp(0.66 * ln_U - 0.53 * ln_Q - d.starvation * U)
    return F_R / (1.0 + np.exp(d.ln_heating + 1.28 * ln_U))
