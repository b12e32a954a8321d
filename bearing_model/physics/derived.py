"""Constants derived from the parameters at their temperatures (temperature.py), element by element; equations stand in
the elements' files.
"""

import functools
from types import SimpleNamespace
from typing import NamedTuple

import numpy as np

from bearing_model.cage.cage import cage_refusal, cage_scales, cage_vibrates
from bearing_model.cage.common.centrifugal import cage_centrifugal
from bearing_model.cage.common.pocket_spheres_setup import spheres_derive
from bearing_model.cage.common.pocket_squeeze import pocket_squeeze_derive
from bearing_model.cage.common.spheres_squeeze import spheres_squeeze_derive
from bearing_model.generated import variables
from bearing_model.generated.variables import (
    ELASTIC_SCALES,
    N_ALL_STATES,
    N_STATES,
    STATE_SCALES,
    CageGuidance,
    CageShape,
    Drag,
    FitModel,
    Method,
    Switch,
    Z,
)
from bearing_model.physics.hertz import Hertz, hertz_contact
from bearing_model.physics.parameters import follows_mass
from bearing_model.physics.race_surface import (
    RaceSurface,
    Spall,
    ball_spalls_given,
    race_surface_of,
    race_surfaces_given,
    spall_of,
)
from bearing_model.physics.ring_fit import ring_fit_of
from bearing_model.rivet import rivet_table
from bearing_model.rivet.rivet_rom import joint_hole_stiffness, rivet_rom_fit_eff, rivet_rom_fit_flags

AIR_DENSITY = 1.19  # [kg/m3] at 293 K and 10^5 Pa


class Race(NamedTuple):
    """Constants of the contacts with one race."""

    R_g: float  # radius of the circle of groove-curvature centres [m]
    r_g: float  # groove radius f D [m]
    R_m: float  # radius of the deformed contact surface across rolling [m]
    rolling: float  # F_R = rolling U^0.66 Q^0.47 [N]
    horizontal: float  # F_H / F_R = 2 R_x / R of the ball
    ln_Lambda: float  # ln of Lambda at U = 1 m/s, Q = 1 N
    hertz: Hertz
    surface: RaceSurface
    balls: Spall  # of the balls there [Z]


class Derived(SimpleNamespace):
    """Constants of the model, named as in fmu_src/physics/model.h."""


def ln_film(E_prime, R_x, k, p, sigma):
    """ln Lambda at U = 1 m/s, Q = 1 N: of 2.69 G^0.53 (1 - 0.61 exp(-0.73 k)) R_x (eta/(E' R_x))^0.67 (1/(E'
    R_x^2))^-0.067 / sigma.
    """
    G, U, W = p.oil.alpha * E_prime, p.oil.eta / (E_prime * R_x), 1.0 / (E_prime * R_x**2)
    return np.log(2.69 * U**0.67 * G**0.53 * W**-0.067 * (1.0 - 0.61 * np.exp(-0.73 * k)) * R_x / sigma)


def inlet(E_prime, R_x, R_y, p):
    """F_R at U = 1 m/s, Q = 1 N [N]: 2.86 E' R_x^2 (R_y/R_x)^0.348 G^0.022 (eta/(E' R_x))^0.66 (1/(E' R_x^2))^0.47."""
    G, U, W = p.oil.alpha * E_prime, p.oil.eta / (E_prime * R_x), 1.0 / (E_prime * R_x**2)
    return p.oil.rolling * 2.86 * E_prime * R_x**2 * (R_y / R_x) ** 0.348 * G**0.022 * U**0.66 * W**0.47


def ball_elasticity(p):
    """Young's modulus [Pa] and Poisson's ratio of the balls, those of the rings where the parameters leave them open."""
    return p.ball.E or p.bearing.E, p.ball.nu or p.bearing.nu


def race_modulus(p):
    """E_star of ball and race [Pa], 1/E_star = (1 - nu_b^2)/E_b + (1 - nu^2)/E; half of E/(1 - nu^2) to the last bit
    where both are alike.
    """
    E_b, nu_b = ball_elasticity(p)
    ring, ball = p.bearing.E / (1.0 - p.bearing.nu**2), E_b / (1.0 - nu_b**2)
    return ring / (1.0 + ring / ball)


def derive_race(p, f, side, surface):
    """Constants of the contacts with one race; side: -1 for the inner race, +1 for the outer one; surface: p.inner or
    p.outer.
    """
    D, R, gamma = p.bearing.D, 0.5 * p.bearing.D, p.bearing.D / p.bearing.d_m
    E_star = race_modulus(p)
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
        surface=race_surface_of(surface, 0.5 * (p.bearing.d_m + side * D), hertz),
        balls=spall_of(p.ball, 0.5 * (D + p.ball.dD), hertz),
    )


def reference_density(p):
    """Density of the mixture; of the oil, where the flow gives the filling [kg/m3]."""
    return p.oil.rho if p.oil.flow > 0.0 else p.oil.rho_mix


def derive_mixture(p, d):
    """Constants of drag.py."""
    D, d_m, R, gamma, nu = (
        p.bearing.D,
        p.bearing.d_m,
        0.5 * p.bearing.D,
        p.bearing.D / p.bearing.d_m,
        p.oil.eta / p.oil.rho,
    )
    rho, kappa = reference_density(p), 0.5 * (1.0 - gamma)
    # Parker's fraction is 1 at this speed: 10^5 W^0.37/(n d_m^1.7), cm3/min, r/min, mm
    d.flooded_omega = np.pi / 30.0 * 1e5 * (6e7 * p.oil.flow) ** 0.37 / (1e3 * d_m) ** 1.7
    d.air = AIR_DENSITY / p.oil.rho
    # balance of the mixture
    r_m = 0.5 * d_m
    r_i, r_e = r_m - R, r_m + R
    height = D * max(1.0 - p.bearing.h_i - p.bearing.h_e, 0.1)
    width_e = max(p.cage.width - 2.0 * p.cage.land_width, 0.0)
    f_i, f_e = 0.066 * ((1.0 - kappa) * r_i * height / nu) ** -0.25, 0.066 * (kappa * r_e * height / nu) ** -0.25
    d.sigma = 1.0 / kappa
    d.ball_area = Z * p.oil.C_d * np.pi * R**2
    d.inner_wall = f_i * 2.0 * np.pi * r_i * p.cage.width * (r_i / r_m) ** 3
    d.outer_wall = f_e * 2.0 * np.pi * r_e * width_e * (r_e / r_m) ** 3
    d.fresh = 2.0 * p.oil.flow / (kappa * r_m)
    d.ring_drag = 0.5 * rho * d.inner_wall * r_m**3 if p.scene.drag == Drag.ROW else 0.0
    # churning: (1/2) rho R^5 (6.45 sqrt(nu/(R^2 omega)) + 32.1 nu/(R^2 omega)) omega^2
    d.churning_boundary = 0.5 * rho * 6.45 * np.sqrt(nu) * R**4
    d.churning_viscous = 0.5 * rho * 32.1 * nu * R**3


def derive_inlets(p, d):
    """Shear heating and starvation of the race inlets (traction.py)."""
    D, gamma, nu = p.bearing.D, p.bearing.D / p.bearing.d_m, 1e6 * p.oil.eta / p.oil.rho
    heating = p.scene.heating == Switch.ON
    # n d_m [r/min mm] at U = 1 m/s: U = omega d_m (1 - gamma^2)/4; cross-section of the bearing D/0.3
    speed, section = 30.0 / np.pi * 4e3 / (1.0 - gamma**2), 1e3 * D / 0.3
    d.starvation = p.oil.K_rs * nu * 2.0 * speed * np.sqrt(0.5 * p.oil.K_Z / section)
    d.ln_heating = np.log(1.84e-9) + 1.28 * np.log(speed) + 0.64 * np.log(nu) if heating else -np.inf
    d.ln_thermal = np.log(p.oil.eta * p.oil.beta / p.oil.k) if heating and p.oil.beta > 0.0 else -np.inf


def derive_balls(p, d):
    D = p.bearing.D
    d.R = 0.5 * (D + p.ball.dD)
    d.m = p.bearing.rho * np.pi / 6.0 * D**3
    d.J = 0.1 * d.m * D**2
    d.drag = 0.5 * p.oil.C_d * reference_density(p) * 0.25 * np.pi * D**2
    d.inner = derive_race(p, p.bearing.f_i, -1.0, p.inner)
    d.outer = derive_race(p, p.bearing.f_e, 1.0, p.outer)
    d.rough, d.spalled = race_surfaces_given(p), ball_spalls_given(p)
    d.fit = ring_fit_of(p)
    derive_inlets(p, d)
    derive_mixture(p, d)


def derive_pockets(p, d):
    R = 0.5 * p.bearing.D
    d.pocket_radius = R + 0.5 * p.cage.pocket_clearance
    E_b, nu_b = ball_elasticity(p)
    E_star = 1.0 / ((1.0 - nu_b**2) / E_b + (1.0 - p.cage.nu**2) / p.cage.E)
    rho_y = max(1.0 / R - 1.0 / d.pocket_radius, 1e-3 / R)  # a limit of conformity: R_y <= 1000 R
    d.pocket = hertz_contact(1.0 / R, rho_y, E_star)
    d.pocket_rolling = inlet(2.0 * E_star, R, 1.0 / rho_y, p)
    d.R_c = d.pocket_radius + 0.5 * p.pocket.dD
    ribbon = p.cage.shape == CageShape.RIBBON
    d.spheres = spheres_derive(p, E_star, d.R_c - d.R) if ribbon else None
    # film: of a ribbon's spheres the reduced radius is the same both ways
    R_x, k = (1.0 / rho_y, 1.0) if ribbon else (R, d.pocket.k)
    d.ln_pocket_piezo = ln_film(2.0 * E_star, R_x, k, p, p.oil.sigma_pocket)
    # isoviscous-rigid: h/R = 128 alpha_r lambda_b^2 (0.131 atan(alpha_r/2) + 1.683)^2 (U/W)^2, alpha_r = R_y/R_x.
    # Hamrock & Dowson (1979), Brewe
    alpha_r = 1.0 / (rho_y * R_x)
    lambda_b = 1.0 / (1.0 + 0.698 / alpha_r)
    shape = 128.0 * alpha_r * lambda_b**2 * (0.131 * np.arctan(0.5 * alpha_r) + 1.683) ** 2
    d.ln_pocket_rigid = np.log(shape * R_x / p.oil.sigma_pocket) + 2.0 * np.log(p.oil.eta * R_x)
    phi, phi_r = 2.0 * np.pi * np.arange(Z) / Z + p.pocket.dtheta, 2.0 * np.pi * (np.arange(Z) + 0.5) / Z
    d.pocket_cos, d.pocket_sin = np.cos(phi), np.sin(phi)
    (spheres_squeeze_derive if ribbon else pocket_squeeze_derive)(p, d)
    d.rivet_y, d.rivet_z = 0.5 * d.table.joint["d_m"] * np.cos(phi_r), 0.5 * d.table.joint["d_m"] * np.sin(phi_r)


def derive_cage(p, d):
    R, L, nu, r_i = 0.5 * p.cage.D_o, p.cage.land_width, p.oil.eta / p.oil.rho, 0.5 * p.cage.D_i
    d.J_p, d.J_t = (follows_mass(p, name) for name in ("J_p", "J_t"))
    d.com_x = (-p.cage.x_c, p.cage.x_c)
    d.com_e = p.cage.unbalance / (2.0 * p.cage.m)
    d.C_land = 0.5 * p.cage.guide_clearance
    d.growth = cage_centrifugal(p, d.table) * (d.table.half.growth @ [1.0, p.cage.land_x])  # of the radius at the land
    d.guided = p.cage.guidance == CageGuidance.OUTER  # by a land
    d.play = d.C_land if d.guided else 0.5 * p.cage.pocket_clearance
    d.bar = p.bearing.d_m * np.sin(np.pi / Z) - p.bearing.D - p.cage.pocket_clearance
    d.kappa = p.oil.eta * R * L**3 / d.C_land**3
    d.couette = 2.0 * np.pi * p.oil.eta * R**3 * L / d.C_land
    d.nahme = 0.125 * p.oil.beta * p.oil.eta * R**2 / p.oil.k if p.scene.heating == Switch.ON else 0.0
    d.ln_land = np.log(d.C_land / p.oil.sigma_land)
    # end face: (1/2) rho omega^2 (r_o^5 - r_i^5) C_n/2, given per omega (drag_cage multiplies by omega)
    face, Re = 0.25 * reference_density(p) * (R**5 - r_i**5), R * R / nu
    d.disk_laminar = face * 3.87 / np.sqrt(Re)
    d.disk_turbulent = face * 0.146 * Re**-0.2
    # cylinder outside the land, at the same gap
    width, Ta = max(0.5 * p.cage.width - L, 0.0), R * d.C_land / nu * np.sqrt(d.C_land / R)
    d.cylinder_laminar = reference_density(p) * nu * R / d.C_land * (2.0 * np.pi * R * width) * R
    d.cylinder_vortex = d.cylinder_laminar * 1.3 * (Ta / 41.0) ** 0.539


BROKEN_PLAY = 1.0  # of a rivet that is gone [m]


def derive_joint(p, d, table):
    joint, intact = table.joint, p.rivet.intact != 0
    # 1, or 0 for a rivet that is broken: it has no preload and a free fit, its hole bears nothing
    d.intact = intact.astype(float)
    d.P = d.intact * (p.joint.preload * p.rivet.preload_factor)
    d.P_mean = p.joint.preload * (
        np.sum(d.intact * p.rivet.preload_factor) / np.sum(d.intact) if np.any(intact) else 0.0
    )
    fit_a = p.joint.fit + p.rivet.dfit + p.joint.swell
    d.fit_eff = np.where(intact, rivet_rom_fit_eff(table, fit_a, p.rivet.fit_model == FitModel.J2), -BROKEN_PLAY)
    d.fit_flags = np.where(intact, rivet_rom_fit_flags(table, fit_a), 0)
    d.k_rivet = table.half.k_open
    d.k_plate = table.half.k_closed - table.half.k_open
    d.k_plate_t = joint["k_t_plate"]
    d.k_head = joint["k_t_head"]
    d.k_hole = np.where(intact, joint_hole_stiffness(table, fit_a), 0.0)
    d.hole_gap = np.where(intact, np.maximum(0.0, -fit_a), BROKEN_PLAY)
    d.inv_R = 2.0 / joint["d_m"]
    d.centrifugal = cage_centrifugal(p, table) * table.half.spin  # rows of bonded joints (half_path.py), per (rad/s)^2
    d.c_joint = 2.0 * p.joint.zeta * np.sqrt((d.k_rivet + d.k_plate) * 0.5 * p.cage.m / Z)


def derive_scales(p, d):
    """Errors that tolerance 1 allows: lengths and velocities, angles as arcs, friction states as parts of the
    deflection at which the plates slip.

    The default method has scales by consequence (docs/method.md): a ball's velocity along its orbit decides how it
    meets its pocket and is finer, less so where walls give way; verlet.py makes it finer still at lower speeds.  Its
    velocity along the contact normals, where a step's error moves it by nanometres, and the friction states, whose
    error hardly changes a half's velocity within a step, are wider.
    """
    equal = p.solver.method == Method.EXPLICIT
    length, velocity, r = 1e-5, 0.1 if equal else 0.5, 0.5 * p.bearing.d_m
    vibrates, (of_orbit, of_friction) = cage_vibrates(p), cage_scales(p)
    orbit = velocity * of_orbit
    slip = max(p.joint.mu * d.P_mean, 3.0)  # force at which plates slip; of a loose joint the default's
    friction = slip if equal else of_friction * slip
    by_class = {
        "length": length,
        "velocity": velocity,
        "normal": velocity if equal else 1.5 * velocity,
        "rate": velocity / r,
        "orbit": (velocity if equal else orbit) / r,
        "mode": velocity,
        "spin": velocity / (0.5 * p.bearing.D),
        "angle": length / r,
        "tilt": length / r,
        "plate": friction / d.k_plate_t,
        "head": friction / d.k_head,
        "energy": 1e30,
    }
    scales = STATE_SCALES | ELASTIC_SCALES if vibrates else STATE_SCALES
    d.scale = np.empty(N_ALL_STATES if vibrates else N_STATES)
    for name, scale in scales.items():
        d.scale[getattr(variables, name.upper())] = by_class[scale]


@functools.lru_cache
def default_table():
    """The rivet table of the 6207."""
    return rivet_table.read(rivet_table.DEFAULT_TABLE)


def check_table(p, table):
    """ValueError if a rivet_table.RivetTable belongs to another bearing than the Parameters p, or has no such cage."""
    if table.Z != Z:
        raise ValueError(f"the rivet table is for Z = {table.Z}; the model has Z = {Z}")
    if abs(p.bearing.d_m - table.joint["d_m"]) > 1e-3 * table.joint["d_m"]:
        raise ValueError(
            f"bearing.d_m = {p.bearing.d_m} m: the rivet table's load path is for {table.joint['d_m']} m +- 0.1 %"
        )
    x_c = table.half.x_c
    if abs(p.cage.x_c - x_c) > 0.02 * x_c:
        raise ValueError(
            f"cage.x_c = {p.cage.x_c} m: the cage half of the rivet table has its centre of mass at {x_c} m +- 2 %"
        )
    refusal = cage_refusal(p, table)
    if refusal:
        raise ValueError(refusal)


def model_derive(p, table=None):
    """Derived constants of all elements.

    p: Parameters at their present temperatures.  table: rivet_table.RivetTable, default that of the 6207.
    """
    table = table or default_table()
    d = Derived(table=table)
    derive_balls(p, d)
    derive_pockets(p, d)
    derive_cage(p, d)
    derive_joint(p, d, table)
    derive_scales(p, d)
    return d
