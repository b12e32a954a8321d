"""Viscosity of an oil at its temperature, from two points: Walther's law as ASTM D341 has it.

lg lg(nu + 0.7) = A - B lg T            nu [mm2/s] from 2 mm2/s up, T [K]
"""

import numpy as np


class Oil:
    """An oil by its kinematic viscosities nu_1 and nu_2 [m2/s] at the temperatures T_1 < T_2 [K].

    ValueError if the viscosity does not fall from T_1 to T_2.

    >>> oil = Oil(25e-6, 313.15, 5e-6, 373.15)               # MIL-PRF-23699
    >>> print(f"{1e6 * oil.nu(353.15):.2f} mm2/s, {oil.beta(353.15):.4f} 1/K")
    7.61 mm2/s, 0.0233 1/K
    """

    def __init__(self, nu_1, T_1, nu_2, T_2):
        if not (0.0 < T_1 < T_2 and nu_1 > nu_2 > 0.0):
            raise ValueError(
                f"nu = {nu_1}, {nu_2} m2/s at {T_1}, {T_2} K: viscosities above 0 that fall with temperature are allowed"
            )
        self.B = (_lg_lg(nu_1) - _lg_lg(nu_2)) / np.log10(T_2 / T_1)
        self.A = _lg_lg(nu_1) + self.B * np.log10(T_1)

    def nu(self, T):
        """Kinematic viscosity [m2/s] at T [K]."""
        return 1e-6 * (10.0**10.0 ** (self.A - self.B * np.log10(T)) - 0.7)

    def beta(self, T):
        """-d ln(nu)/dT [1/K] at T [K]: oil.beta of the FMU."""
        z = 1e6 * self.nu(T) + 0.7
        return np.log(z) * self.B / T * z / (z - 0.7)


def _lg_lg(nu):
    return np.log10(np.log10(1e6 * nu + 0.7))
