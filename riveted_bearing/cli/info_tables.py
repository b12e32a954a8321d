"""The tables of `riveted-bearing info`: geometry, oil, frequencies, equilibrium and the single balls."""

import math
from dataclasses import replace

import numpy as np
from rich.table import Column, Table

from bearing_model.generated import variables
from bearing_model.kinematics import fault_frequencies
from rivet_model.geometry import Geometry

from ..base.errors import UserError
from ..base.units import placed
from ..bearing.ribbon import is_ribbon
from ..running.summary import DEG, RPM
from .printing import table

BOUNDARY = ("bore", "outside_diameter", "width")
ZERO = 273.15  # K of 0 degC
RIVET = ("shank_diameter", "head_diameter", "head_height", "fillet_radius")
MACHINED = (
    ("cage: outer diameter, bore, width", ("cage.D_o", "cage.D_i", "cage.width")),
    ("pocket, guide clearance (diametral)", ("cage.pocket_clearance", "cage.guide_clearance")),
)
RIBBON = (
    ("ribbon cage: outer diameter, bore, width", MACHINED[0][1]),
    ("sheet, pocket depth, fillet", ("cage.sheet", "cage.pocket_depth", "cage.pocket_fillet")),
    ("pocket clearance (diametral)", ("cage.pocket_clearance",)),
)


def given_values(case, scene, model):
    """What the user set, as name and the value that would stand there otherwise, where the two differ."""
    known = variables.PARAMETERS | variables.INPUTS
    if scene is not None:
        names = {**scene.parameters, **scene.inputs}
        others = {name: model.default((model.parameters | model.inputs)[name]) for name in names}
        others["scene.statistics"] = "on"  # as scene.load_scene has it without the user
    else:
        others = {
            name: known[name].start for name, source in case.origin.items() if source == "yours" and name in known
        }
    return {name: value for name, value in others.items() if case.values.get(name) != value}


def without_effect(case, others):
    """Names of `others` (name: another value) that change no figure of the tables."""
    shown = cells(case)
    return [name for name, value in others.items() if cells(replace(case, values=case.values | {name: value})) == shown]


def cells(case):
    """All figures of the tables as texts, None where there is no equilibrium."""
    try:
        return [(title, *(list(column.cells) for column in shown.columns)) for title, shown in info_tables(case)]
    except UserError:
        return None


def info_tables(case):
    """Tables for the terminal: (title, rich table) for geometry, frequencies, equilibrium and the single balls."""
    from ..bearing.origin import not_given

    state = case.equilibrium()
    return [
        (
            "Geometry and masses",
            pairs([*told(case, geometry(case)), *preload(case), *materials(case), *told(case, masses(case))]),
        ),
        ("Oil and temperatures", pairs(oil(case))),
        *([("Not given", sources(missing))] if (missing := not_given(case.origin)) else []),
        (f"Frequencies at {speeds_text(case.load)}", frequencies(case, state)),
        (f"Quasi-static equilibrium, {load_text(case.load)}", pairs(equilibrium(case, state))),
        ("Balls", balls(state)),
    ]


def told(case, rows):
    """Rows (label, value, unit, names ...) with the origin of the names."""
    return ((label, value, unit, origins(case, *names)) for label, value, unit, *names in rows)


def geometry(case):
    """Label, value, unit and names of the bearing's sizes, at assembly temperature."""
    bearing, values, catalogue = case.bearing, case.values, case.catalogue
    if all(key in catalogue for key in BOUNDARY):
        size = " x ".join(f"{1e3 * catalogue[key]:g}" for key in BOUNDARY)
        yield "bore x outside diameter x width", size, "mm", *BOUNDARY
    if "C" in catalogue and "C_0" in catalogue:
        forces = f"{1e-3 * catalogue['C']:g}, {1e-3 * catalogue['C_0']:g}"
        yield "load ratings C, C_0", forces, "kN", "C", "C_0"
    yield "balls", f"{case.Z} x {1e3 * values['bearing.D']:g}", "mm", "Z", "bearing.D"
    yield "pitch diameter", f"{1e3 * values['bearing.d_m']:g}", "mm", "bearing.d_m"
    ratios = f"{bearing.f_i:g}, {bearing.f_e:g}"
    yield "groove radius / ball diameter, inner, outer", ratios, "", "bearing.f_i", "bearing.f_e"
    yield "diametral clearance", f"{1e6 * values['bearing.P_d']:g}", "um", "bearing.P_d"
    omega = case.load.omega + case.load.frame_omega
    left, angle = bearing.clearance_at(omega), bearing.free_contact_angle(omega)
    yield "what is left of it at speed, temperatures and fits", f"{1e6 * left:.4g}", "um"
    yield "free contact angle at speed, temperatures and fits", f"{DEG * angle:.2f}", "deg"
    for label, names in RIBBON if is_ribbon(values) else MACHINED:
        yield label, ", ".join(f"{1e3 * values[name]:.4g}" for name in names), "mm", *names
    if case.rivet is not None:
        sizes = ", ".join(f"{1e3 * case.rivet.get(name, getattr(Geometry, name)):.3g}" for name in RIVET)
        yield "rivet: shank, head, head height, fillet", sizes, "mm", *(f"rivet.{name}" for name in RIVET)


def materials(case):
    """Label, value, unit and origin of the parts' materials."""
    for part, material in case.materials.items():
        label = f"material of {'the ' + part if part in ('cage', 'rivet') else part}"
        yield label, material.words(), "", "yours" if material.given else "default"


def masses(case):
    """Label, value, unit and names of the bodies' masses."""
    pair = f"{1e3 * case.bearing.ball_mass:.3g}, {1e3 * case.values['cage.m']:.3g}"
    yield "mass of a ball, a cage half", pair, "g", "cage.m"
    yield "mass of the inner ring and its share of shaft", f"{case.values['ring.m']:.3g}", "kg", "ring.m"


def preload(case):
    """Preload of the rivets as given and at the cage's temperature: by rule, exactly by an FMU's own table."""
    from ..running.preload import of_fmu, of_geometry

    given, T = case.values["joint.preload"], case.values["cage.T"]
    thermal = of_fmu(case.model) if case.model else of_geometry(Geometry(**case.joint))
    if thermal is None:
        return
    warm, origin = abs(T - thermal.T_0) > 1e-6, origins(case, "joint.preload")
    reason = origin if warm else ", ".join(filter(None, (origin, "the cage has this temperature")))
    yield f"preload of a rivet at {thermal.T_0 - ZERO:.4g} degC", f"{given:.4g}", "N", reason
    if warm:
        hot = f"{'' if case.model else 'some '}{thermal.at(given, T):.3g}"
        yield f"preload with the cage at {T - ZERO:.4g} degC", hot, "N", thermal.reason


def oil(case):
    """Name, value, unit and origin of oil and temperatures."""
    from ..bearing.oil import POINTS, largest_traction, plain

    own = {name: value for name, value in case.values.items() if name.startswith("oil.")}
    T, it = own.pop("oil.T"), plain(own)
    at, warmer = f"at {T - ZERO:.4g} degC", T - it.T_0
    yield "oil", case.oil or "not named", "", "yours" if case.oil else "what is not given is that of an aviation oil"
    yield f"oil viscosity {at}", f"{1e3 * case.viscosity:.4g}", "mPa.s", origins(case, "oil.eta")
    yield (
        "kinematic viscosity",
        ", ".join(f"{1e6 * own[n]:.4g} at {own[n.replace('nu', 'T')] - ZERO:.4g} degC" for n in POINTS),
        "mm2/s",
        source_of(case, *POINTS),
    )
    alpha = it.alpha * math.exp(-it.alpha_T * warmer)
    yield f"pressure-viscosity coefficient {at}", f"{1e9 * alpha:.3g}", "1/GPa", source_of(case, "oil.alpha")
    traction = f"{largest_traction(it.A, it.B, it.C):.3f}, {-it.A:.3f}"
    yield "traction coefficient: largest, in full sliding", traction, "", source_of(case, "oil.A")
    yield f"oil density {at}", f"{case.oil_density:.4g}", "kg/m3", source_of(case, "oil.rho")
    yield "roughness of ball and race", f"{1e6 * it.sigma_race:.3g}", "um", source_of(case, "oil.sigma_race")
    if omega := case.load.omega - case.load.omega_e:
        speed = f"{RPM * abs(omega):,.0f} rev/min"
        yield f"viscosity ratio kappa at {speed} (ISO 281)", f"{case.kappa:.3g}", "", ""
    names = ("oil.T", "ring.T_i", "ring.T_e", "ball.T", "cage.T")
    yield (
        "oil, inner ring, outer ring, balls, cage",
        ", ".join(f"{case.values[name] - ZERO:.4g}" for name in names),
        "degC",
        origins(case, *names),
    )


def source_of(case, *names):
    """Who gave these values of the oil, or where they come from."""
    from ..bearing.oil import source_of as of_oil

    given = [name for name in names if case.values[name] != variables.PARAMETERS[name].start]
    if case.oil and (source := of_oil(case.oil, names[0])) and case.origin.get(names[0], "oil").endswith("oil"):
        return source
    if given or case.origin.get(names[0]) == "yours":
        return origins(case, *names)
    return variables.PARAMETERS[names[0]].source


def origins(case, *names):
    """Where these values come from, in a word or two."""
    return ", ".join(dict.fromkeys(case.origin.get(name, "default") for name in names)) if case.origin else ""


def sources(missing):
    """Names of what was not given, by what stands for it."""
    others = "default", "all other parameters: docs/parameters.md has each with its source"
    return table(("", ""), [*missing.items(), others], left=2, show_header=False)


def frequencies(case, state):
    """Cage, ball pass and ball spin frequencies, for pure radial contact and in the equilibrium."""
    load, bearing = case.load, case.bearing
    nominal = fault_frequencies(load.omega, bearing.D, bearing.d_m, case.Z, omega_e=load.omega_e)
    loaded = state.frequencies
    rows = (
        ("cage (FTF)", "FTF"),
        ("balls over the outer race (BPFO)", "BPFO"),
        ("balls over the inner race (BPFI)", "BPFI"),
        ("spin of a ball (BSF)", "BSF"),
    )
    cells = ((label, f"{getattr(nominal, name):.1f}", f"{getattr(loaded, name):.1f}", "Hz") for label, name in rows)
    return table(("", "alpha = 0", "as loaded", ""), cells)


def speeds_text(load):
    """The speeds of the shaft and, where it turns, of the housing."""
    shaft = f"{RPM * load.omega:,.0f} rev/min"
    return f"{shaft}, housing {RPM * load.omega_e:,.0f} rev/min" if load.omega_e else shaft


def load_text(load):
    """The loads in words."""
    parts = [f"{name} {getattr(load, name):g} N" for name in ("F_x", "F_y", "F_z") if getattr(load, name)]
    parts += [f"{name} {DEG * getattr(load, name):g} deg" for name in ("tilt_y", "tilt_z") if getattr(load, name)]
    if not math.isinf(load.k_tilt):
        parts.append(f"k_tilt {load.k_tilt:g} N.m/rad")
    return ", ".join(parts) or "no load"


def equilibrium(case, state):
    """Name, value and unit of displacements, loads and life in the equilibrium."""
    loaded = state.Q_i > 0.0
    place = [getattr(state, name) + case.value(f"housing.{name}") for name in ("x", "y", "z", "tilt_y", "tilt_z")]
    yield "ring displacement x, y, z", ", ".join(placed(1e6 * value, -2) for value in place[:3]), "um"
    yield "ring tilt y, z", ", ".join(placed(DEG * value, -4) for value in place[3:]), "deg"
    yield "stiffness x, y, z (tilt held)", ", ".join(f"{1e-6 * value:.3g}" for value in np.diag(state.K)[:3]), "N/um"
    yield "balls carrying on the inner race", f"{loaded.sum()} of {case.Z}", ""
    yield "largest contact load inner, outer", f"{state.Q_i.max():.0f}, {state.Q_e.max():.0f}", "N"
    yield "largest pressure inner, outer", f"{1e-6 * state.p_i.max():.0f}, {1e-6 * state.p_e.max():.0f}", "MPa"
    yield "cage speed", f"{RPM * state.omega_m:,.0f}", "rev/min"
    yield "centrifugal force of a ball", f"{state.F_c.mean():.1f}", "N"
    if case.bearing.C_0 and math.isfinite(state.S_0):
        yield "P_0, static safety S_0 = C_0/P_0 (ISO 76)", f"{state.P_0:.0f} N, {state.S_0:.3g}", ""
    if math.isfinite(state.pressure_safety):
        yield "safety by pressure, (4200 MPa/p_max)^3", f"{state.pressure_safety:.3g}", ""
    if case.bearing.C and math.isfinite(state.L_10r):
        yield from rating_lives(case)
        yield "L_10r, exact kinematics, at speed", *life(state.L_10r, case.load)


def rating_lives(case):
    """Name, value and unit of the raceways' lives by the standards."""
    from ..duty.raceways import KINDS, in_words, rated, why_unrated

    if why_unrated(case) is not None:
        return
    found = rated(case)
    kappa = "" if math.isnan(found.kappa) else f", kappa {found.kappa:.2g}"
    names = {"L_10": "rating life L_10 = (C/P)^3", "L_10r": "reference life L_10r"}
    for kind, standard in KINDS.items():
        name = names.get(kind, f"{kind} with a_ISO, {in_words(case.cleanliness)}{kappa}")
        yield f"{name} ({standard})", *life(found.lives[kind], case.load)


def life(L_10r, load):
    """A life in 10^6 revolutions as text and unit, with its hours if the bearing turns."""
    turns, omega = f"{L_10r:.4g}", load.omega - load.omega_e
    if not omega:
        return turns, "1e6 turns"
    return f"{turns}, {L_10r * 1e6 * 2.0 * math.pi / abs(omega) / 3600.0:.4g}", "1e6 turns, h"


def balls(state):
    """One line per ball."""
    names = ("azimuth", "Q_i", "Q_e", "alpha_i", "alpha_e", "p_i", "p_e", "spin/roll i")
    shown = table(("ball", *names))
    shown.add_row("", "deg", "N", "N", "deg", "deg", "MPa", "MPa", "", style="dim")
    members = ("psi", "Q_i", "Q_e", "alpha_i", "alpha_e", "p_i", "p_e", "spin_i", "omega_R")
    rows = zip(*(getattr(state, name) for name in members), strict=True)
    for j, (psi, Q_i, Q_e, alpha_i, alpha_e, p_i, p_e, spin, roll) in enumerate(rows, 1):
        shown.add_row(
            str(j),
            f"{DEG * psi:.0f}",
            f"{Q_i:.0f}",
            f"{Q_e:.0f}",
            placed(DEG * alpha_i, -2) if Q_i > 0.0 else "-",
            placed(DEG * alpha_e, -2) if Q_e > 0.0 else "-",
            f"{1e-6 * p_i:.0f}",
            f"{1e-6 * p_e:.0f}",
            f"{abs(spin / roll):.3f}" if Q_i > 0.0 and roll else "-",
        )
    return shown


def pairs(rows):
    """A table of names, values and units."""
    shown = Table("", Column(justify="right"), "", Column(style="dim"), box=None, pad_edge=False, show_header=False)
    for row in rows:
        shown.add_row(*row)
    return shown
