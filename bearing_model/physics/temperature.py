"""Parameters at the temperatures of oil, rings, balls and cage, and in their housing.

steel    d_i (1 + e_i), d_e (1 + e_e), D (1 + e_b)   diameters of groove bottoms and balls, e = expansion (T - T_a)
         f_i D (1 + e_i), f_e D (1 + e_e)            groove radii
         d_i = d_m - D - P_d/2, d_e = d_m + D + P_d/2; from these follow d_m, P_d, f_i, f_e at temperature
cage     (D + pocket clearance)(1 + e_c), D_o (1 + e_c), D_i (1 + e_c), land diameter of the outer ring (1 + e_e)
rivet    preload and fit: the flanges expand more than the rivet (rivet_rom.py)
fits     the seats' interference changes by the difference of the expansions; the outer ring in its housing loses groove diameter and land diameter
         (ring_fit.py)
oil      eta = eta_0 rho(T) nu(T)/(rho(T_0) nu(T_0)), nu by Walther's law (viscosity.py), rho = rho_0 (1 - a (T - T_0)),
         alpha = alpha_0 exp(-c (T - T_0)), beta = beta_0 beta(T)/beta(T_0)

T_a: temperature at which the rivet table gives preload and fit.  eta_0 and beta_0 that are not given (left at their
start values before the run, never set in it) are those of the variable table's oil, so that the two points alone
decide.  At the start values of all temperatures no parameter changes, not even its last bit.  Neglected: expansion of
the widths and of the circle of rivets, growth of ring and cage inertia, elastic constants over temperature.  Masses
stay as they are.
"""

import copy
from types import SimpleNamespace

import numpy as np

from bearing_model.generated.limits import LIMITS
from bearing_model.generated.variables import PARAMETERS
from bearing_model.physics.parameters import check_limits, require, value_of
from bearing_model.physics.ring_fit import ring_fit_bore, ring_fit_housing, ring_fit_outside
from bearing_model.physics.viscosity import Oil
from bearing_model.rivet.rivet_rom import joint_fit, joint_preload

TEMPERATURES = (("oil", "T"), ("ring", "T_i"), ("ring", "T_e"), ("ball", "T"), ("cage", "T"))
START_OIL = SimpleNamespace(
    **{name.removeprefix("oil."): variable.start for name, variable in PARAMETERS.items() if name.startswith("oil.")}
)


def temperature_same(u, v):
    """Whether oil and parts have the same temperatures in both Inputs."""
    return all(getattr(getattr(u, group), name) == getattr(getattr(v, group), name) for group, name in TEMPERATURES)


def oil_density(oil, T):
    """Density of the oil [kg/m3] at T [K]."""
    return oil.rho - oil.rho * oil.expansion * (T - oil.T_0)


def oil_ratios(oil, T, other):
    """Viscosity and beta of the oil's two points at T [K], relative to those of the other oil at its T_0."""
    here, there = (Oil(o.nu_1, o.T_1, o.nu_2, o.T_2) for o in (oil, other))
    eta = oil_density(oil, T) * here.nu(T) / (oil_density(other, other.T_0) * there.nu(other.T_0))
    return eta, here.beta(T) / there.beta(other.T_0)


def heat_oil(p, T, hot):
    given_eta, given_beta = oil_ratios(p.oil, T, p.oil)
    eta, beta = oil_ratios(p.oil, T, START_OIL)
    hot.oil.eta = p.oil.eta * (given_eta if p.given.oil_eta else eta)
    hot.oil.beta = p.oil.beta * (given_beta if p.given.oil_beta else beta)
    hot.oil.rho = oil_density(p.oil, T)
    hot.oil.alpha = p.oil.alpha * np.exp(-p.oil.alpha_T * (T - p.oil.T_0))


def heat_steel(p, e_i, e_e, e_b, hot):
    D, d_m, P_d = p.bearing.D, p.bearing.d_m, p.bearing.P_d
    d_i, d_e = d_m - D - 0.5 * P_d, d_m + D + 0.5 * P_d
    hot.bearing.D = D + e_b * D
    hot.bearing.d_m = d_m + 0.5 * (e_i * d_i + e_e * d_e)
    hot.bearing.P_d = P_d + (e_e * d_e - e_i * d_i - 2.0 * e_b * D)
    hot.bearing.f_i = p.bearing.f_i * ((1.0 + e_i) / (1.0 + e_b))
    hot.bearing.f_e = p.bearing.f_e * ((1.0 + e_e) / (1.0 + e_b))
    hot.bearing.rho = p.bearing.rho / (1.0 + e_b) ** 3


def heat_cage(p, e_c, e_e, e_b, hot):
    D, pocket, guide = p.bearing.D, p.cage.pocket_clearance, p.cage.guide_clearance
    hot.cage.pocket_clearance = pocket + (e_c * (D + pocket) - e_b * D)
    hot.cage.guide_clearance = guide + (e_e * (p.cage.D_o + guide) - e_c * p.cage.D_o)
    hot.cage.D_o = p.cage.D_o + e_c * p.cage.D_o
    hot.cage.D_i = p.cage.D_i + e_c * p.cage.D_i
    for size in ("sheet", "pocket_depth", "pocket_fillet", "pocket_edge"):
        cold = getattr(p.cage, size)
        setattr(hot.cage, size, cold + e_c * cold)


def heat_fits(p, u, T_a, hot):
    """Fits at temperature; contraction of groove and land of the outer ring by the housing."""
    expansion = p.bearing.expansion
    hot.shaft.interference = p.shaft.interference + (p.shaft.expansion - expansion) * (
        u.ring.T_i - T_a
    ) * ring_fit_bore(p)
    hot.housing.interference = p.housing.interference + (expansion - p.housing.expansion) * (
        u.ring.T_e - T_a
    ) * ring_fit_outside(p)
    groove = ring_fit_housing(hot, 0.5 * (p.bearing.d_m + p.bearing.D))
    land = ring_fit_housing(hot, 0.5 * (p.cage.D_o + p.cage.guide_clearance))
    hot.bearing.P_d -= 2.0 * groove
    hot.bearing.d_m -= groove
    hot.cage.guide_clearance -= 2.0 * land


def temperature_apply(p, u, table):
    """The Parameters p at the temperatures in the Inputs u, with the joint of a RivetTable."""
    hot, T_a, expansion = copy.deepcopy(p), table.joint["T_0"], p.bearing.expansion
    e_i, e_e = expansion * (u.ring.T_i - T_a), expansion * (u.ring.T_e - T_a)
    e_b, e_c = (p.ball.expansion or expansion) * (u.ball.T - T_a), table.joint["alpha_flange"] * (u.cage.T - T_a)
    heat_oil(p, u.oil.T, hot)
    heat_steel(p, e_i, e_e, e_b, hot)
    heat_cage(p, e_c, e_e, e_b, hot)
    heat_fits(p, u, T_a, hot)
    hot.joint.preload = joint_preload(table, p.joint.preload, u.cage.T)
    hot.joint.fit = joint_fit(table, p.joint.fit, u.cage.T)
    return hot


def check_temperatures(u, hot):
    """ValueError unless oil and bearing bear the temperatures in the Inputs u, at which the Parameters are `hot`.

    Viscosity within its limits, cage neither on the outer ring nor on the balls, no interference beyond the limits of
    the parameters.
    """
    names = ("oil.T", "ring.T_i", "ring.T_e", "ball.T", "cage.T")
    there = ", ".join(f"{name} = {value_of(u, name):g} K" for name in names) + ": there "
    for name in ("oil.eta", "cage.guide_clearance", "cage.pocket_clearance"):
        v, value = PARAMETERS[name], value_of(hot, name)
        limits = f"it must lie in [{v.min:.10g}, {v.max:.10g}]"
        require(v.min <= value <= v.max, f"{there}{name} = {value:.10g} {v.unit} is not allowed: {limits}")
    check_limits(hot, [limit for limit in LIMITS if limit.quantity in ("cage.pocket_depth", "bearing.P_d")], there)
