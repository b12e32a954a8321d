"""Constants derived once from the parameters, element by element; equations stand in the elements' files."""

import functools
from types import SimpleNamespace
from typing import NamedTuple

import numpy as np

from bearing_model import rivet_table
from bearing_model.hertz import Hertz, hertz_contact
from bearing_model.rivet_rom import joint_fit, joint_hole_stiffness, joint_preload, rivet_rom_fit_eff, rivet_rom_fit_flags
from bearing_model.variables import N_STATES, PARAMETERS, STATE_SCALES, STATE_SLICES, FitModel, Switch, Z


class Race(NamedTuple):
    """Constants of the contacts with one race."""

    R_g: float  # radius of the circle of groove-curvature centres [m]
    r_g: float  # groove radius f D [m]
    R_m: float  # radius of the deformed contact surface across rolling [m]
    rolling: float  # F_R = rolling U^0.66 Q^0.47 [N]
    horizontal: float  # F_H / F_R = 2 R_x / R of the ball
    ln_Lambda: float  # ln of Lambda at U = 1 m/s, Q = 1 N
    hertz: Hertz


class Derived(SimpleNamespace):
    """Constants of the model, named as in fmu_src/model.h."""


def ln_film(E_prime, R_x, k, p, sigma):
    """ln Lambda at U = 1 m/s, Q = 1 N: of 2.69 G^0.53 (1 - 0.61 exp(-0.73 k)) R_x (eta/(E' R_x))^0.67 (1/(E' R_x^2))^-0.067 / sigma."""
    G, U, W = p.oil.alpha * E_prime, p.oil.eta / (E_prime * R_x), 1.0 / (E_prime * R_x**2)
    return np.log(2.69 * U**0.67 * G**0.53 * W**-0.067 * (1.0 - 0.61 * np.exp(-0.73 * k)) * R_x / sigma)


def inlet(E_prime, R_x, R_y, p):
    """F_R at U = 1 m/s, Q = 1 N [N]: 2.86 E' R_x^2 (R_y/R_x)^0.348 G^0.022 (eta/(E' R_x))^0.66 (1/(E' R_x^2))^0.47."""
    G, U, W = p.oil.alpha * E_prime, p.oil.eta / (E_prime * R_x), 1.0 / (E_prime * R_x**2)
    return p.oil.rolling * 2.86 * E_prime * R_x**2 * (R_y / R_x) ** 0.348 * G**0.022 * U**0.66 * W**0.47


def derive_race(p, f, side):
    """Constants of the contacts with one race; side: -1 for the inner race, +1 for the outer one."""
    D, R, gamma = p.bearing.D, 0.5 * p.bearing.D, p.bearing.D / p.bearing.d_m
    E_star = 0.5 * p.bearing.E / (1.0 - p.bearing.nu**2)
    rho_x, rho_y = 1.0 / (R * (1.0 + side * gamma)), 1.0 / R - 1.0 / (f * D)
    hertz = hertz_contact(rho_x, rho_y, E_star)
    return Race(
        R_g=0.5 * p.bearing.d_m - side * ((f - 0.5) * D - 0.25 * p.bearing.P_d),
        r_g=f * D,
        R_m=2.0 * f * D * R / (f * D + R),
        rolling=inlet(2.0 * E_star, 1.0 / rho_x, 1.0 / rho_y, p),
        horizontal=2.0 / (rho_x * R),
        ln_Lambda=ln_film(2.0 * E_star, 1.0 / rho_x, hertz.k, p, p.oil.sigma_race),
        hertz=hertz,
    )


def derive_balls(p, d):
    D = p.bearing.D
    d.R = 0.5 * (D + p.ball.dD)
    d.m = p.bearing.rho * np.pi / 6.0 * D**3
    d.J = 0.1 * d.m * D**2
    d.drag = 0.5 * p.oil.C_d * p.oil.rho_mix * 0.25 * np.pi * D**2
    d.inner = derive_race(p, p.bearing.f_i, -1.0)
    d.outer = derive_race(p, p.bearing.f_e, 1.0)


def derive_pockets(p, d):
    R = 0.5 * p.bearing.D
    d.pocket_radius = R + 0.5 * p.cage.pocket_clearance
    E_star = 1.0 / ((1.0 - p.bearing.nu**2) / p.bearing.E + (1.0 - p.cage.nu**2) / p.cage.E)
    rho_y = max(1.0 / R - 1.0 / d.pocket_radius, 1e-3 / R)  # a limit of conformity: R_y <= 1000 R
    d.pocket = hertz_contact(1.0 / R, rho_y, E_star)
    d.pocket_rolling = inlet(2.0 * E_star, R, 1.0 / rho_y, p)
    d.ln_pocket_piezo = ln_film(2.0 * E_star, R, d.pocket.k, p, p.oil.sigma_pocket)
    # isoviscous-rigid: h/R = 128 alpha_r lambda_b^2 (0.131 atan(alpha_r/2) + 1.683)^2 (U/W)^2, alpha_r = R_y/R.  Hamrock & Dowson (1979), Brewe
    alpha_r = 1.0 / (rho_y * R)
    lambda_b = 1.0 / (1.0 + 0.698 / alpha_r)
    shape = 128.0 * alpha_r * lambda_b**2 * (0.131 * np.arctan(0.5 * alpha_r) + 1.683) ** 2
    d.ln_pocket_rigid = np.log(shape * R / p.oil.sigma_pocket) + 2.0 * np.log(p.oil.eta * R)
    phi, phi_r = 2.0 * np.pi * np.arange(Z) / Z, 2.0 * np.pi * (np.arange(Z) + 0.5) / Z
    d.pocket_cos, d.pocket_sin = np.cos(phi), np.sin(phi)
    d.rivet_y, d.rivet_z = 0.5 * p.bearing.d_m * np.cos(phi_r), 0.5 * p.bearing.d_m * np.sin(phi_r)


def follows_mass(p, name):
    """A moment of inertia of the half: left at its start value it follows the mass, which scales the density."""
    J, mass_ratio = getattr(p.cage, name), p.cage.m / PARAMETERS["cage.m"].start
    return mass_ratio * J if PARAMETERS[f"cage.{name}"].start == J else J


def derive_cage(p, d):
    R, L, nu, r_i = 0.5 * p.cage.D_o, p.cage.land_width, p.oil.eta / p.oil.rho, 0.5 * p.cage.D_i
    d.J_p, d.J_t = (follows_mass(p, name) for name in ("J_p", "J_t"))
    d.com_x = (-p.cage.x_c, p.cage.x_c)
    d.com_e = p.cage.unbalance / (2.0 * p.cage.m)
    d.C_land = 0.5 * p.cage.guide_clearance
    d.kappa = p.oil.eta * R * L**3 / d.C_land**3
    d.couette = 2.0 * np.pi * p.oil.eta * R**3 * L / d.C_land
    d.ln_land = np.log(d.C_land / p.oil.sigma_land)
    # end face: (1/2) rho omega^2 (r_o^5 - r_i^5) C_n/2, given per omega (drag_cage multiplies by omega)
    face, Re = 0.25 * p.oil.rho_mix * (R**5 - r_i**5), R * R / nu
    d.disk_laminar = face * 3.87 / np.sqrt(Re)
    d.disk_turbulent = face * 0.146 * Re**-0.2
    # cylinder outside the land, at the same gap
    width, Ta = max(0.5 * p.cage.width - L, 0.0), R * d.C_land / nu * np.sqrt(d.C_land / R)
    d.cylinder_laminar = p.oil.rho_mix * nu * R / d.C_land * (2.0 * np.pi * R * width) * R
    d.cylinder_vortex = d.cylinder_laminar * 1.3 * (Ta / 41.0) ** 0.539


def derive_joint(p, d, table):
    joint = table.joint
    d.P = joint_preload(table, p.joint.preload, p.rivet.temperature)
    d.fit_a = joint_fit(table, p.joint.fit + p.joint.swell, p.rivet.temperature)
    d.fit_eff = rivet_rom_fit_eff(table, d.fit_a, p.rivet.fit_model == FitModel.J2)
    d.fit_flags = rivet_rom_fit_flags(table, d.fit_a)
    d.k_rivet = table.half.k_open
    d.k_plate = table.half.k_closed - table.half.k_open
    d.k_plate_t = joint["k_t_plate"]
    d.k_head = joint["k_t_head"]
    d.k_hole = joint_hole_stiffness(table, d.fit_a)
    d.hole_gap = max(0.0, -d.fit_a)
    d.spin = (p.cage.centrifugal == Switch.ON) * (p.cage.m / table.half.m) * table.half.spin
    d.c_joint = 2.0 * p.joint.zeta * np.sqrt((d.k_rivet + d.k_plate) * 0.5 * p.cage.m / Z)


def derive_scales(p, d):
    length, velocity, r = 1e-5, 0.1, 0.5 * p.bearing.d_m
    friction = max(p.joint.mu * d.P, 3.0)  # the error scale of a loose joint is no finer than that of the default joint
    by_class = {
        "length": length,
        "velocity": velocity,
        "angle": length / r,
        "tilt": length / r,
        "rate": velocity / r,
        "spin": velocity / (0.5 * p.bearing.D),
        "plate": friction / d.k_plate_t,
        "head": friction / d.k_head,
        "energy": 1e30,
    }
    d.scale = np.empty(N_STATES)
    for name, rows in STATE_SLICES.items():
        d.scale[rows] = by_class[STATE_SCALES[name]]


@functools.lru_cache
def default_table():
    """The rivet table of the 6207."""
    return rivet_table.read(rivet_table.DEFAULT_TABLE)


def model_derive(p, table=None):
    """Derived constants of all elements.

    p: Parameters.  table: rivet_table.RivetTable, default that of the 6207.  ValueError if it belongs to another bearing.
    """
    table = table or default_table()
    if table.Z != Z:
        raise ValueError(f"the rivet table is for Z = {table.Z}; the model has Z = {Z}")
    if abs(p.bearing.d_m - table.joint["d_m"]) > 1e-3 * table.joint["d_m"]:
        raise ValueError(f"bearing.d_m = {p.bearing.d_m} m: the rivet table's load path is for {table.joint['d_m']} m +- 0.1 %")
    x_c = table.half.x_c
    if abs(p.cage.x_c - x_c) > 0.02 * x_c:
        raise ValueError(f"cage.x_c = {p.cage.x_c} m: the cage half of the rivet table has its centre of mass at {x_c} m +- 2 %")
    d = Derived(table=table)
    derive_balls(p, d)
    derive_pockets(p, d)
    derive_cage(p, d)
    derive_joint(p, d, table)
    derive_scales(p, d)
    return d
