"""A bearing at work: values, geometry, loads and the quasi-static results that need no simulation."""

import math
from dataclasses import dataclass, field, fields, replace

import numpy as np

from bearing_model.generated import variables
from bearing_model.physics.derived import ball_elasticity, default_table
from bearing_model.physics.parameters import Values
from bearing_model.physics.ring_fit import ring_fit_of
from bearing_model.physics.temperature import temperature_apply
from bearing_model.quasi_static import Bearing, Load, quasi_static
from riveted_bearing.bearing.load_ratings import reference_viscosity

from ..base.errors import naming
from . import materials, oil, ribbon


@dataclass(frozen=True)
class Case:
    """A bearing at work: catalogue data, SI values or item names by the FMU's full variable names, dimensions of the
    rivet.

    origin: "catalogue", "rule", "yours" (a file's), "shipped" (a shipped file's) or "6207" (OF_EXAMPLE) by name; what
    is not in it has the variable table's default.
    rivet: dimensions and material of the rivet by the names of rivet_model.geometry, None if not known; materials: the
    Material of each part, of a bearing file's case.
    ranges: (lowest, highest) of given values by name, as the drawing allows.
    bare: whether only a designation was given, which says nothing of the cage; alone: what a scene sets of a bearing's
    shape, from which nothing follows; model: the Model of a scene's case; oil: the name of its oil, "" for none;
    cleanliness: of the oil, as of raceways.cleanliness_of, None if nobody gave one.
    """

    designation: str
    description: str
    Z: int
    values: dict
    catalogue: dict = field(default_factory=dict)
    rivet: dict | None = field(default_factory=dict)
    origin: dict = field(default_factory=dict)
    materials: dict = field(default_factory=dict)
    ranges: dict = field(default_factory=dict)
    bare: bool = False
    alone: tuple = ()
    model: object = field(default=None, compare=False)
    oil: str = ""
    cleanliness: object = None

    def __repr__(self):
        return f"<Case {self.designation}: {self.description or 'no description'}; Z = {self.Z}, {len(self.values)} values>"

    @property
    def bearing(self):
        """Geometry and material for the quasi-static model, at the present temperatures and fits."""
        tables = variables.PARAMETERS, variables.INPUTS
        parameters, inputs = ({name: v for name, v in table.items() if v.count == 1} for table in tables)
        p, u = (
            Values(table, {name: self.values[name] for name in table if name in self.values})
            for table in (parameters, inputs)
        )
        hot = temperature_apply(p, u, default_table())
        at_work = {f.name: getattr(hot.bearing, f.name) for f in fields(Bearing) if hasattr(hot.bearing, f.name)}
        return Bearing(
            **at_work,
            ball=ball_elasticity(hot),
            Z=self.Z,
            C=self.catalogue.get("C"),
            C_0=self.catalogue.get("C_0"),
            fit=ring_fit_of(hot),
        )

    def value(self, name):
        """A value, the variable table's start where the case has none."""
        return self.values.get(name, (variables.PARAMETERS | variables.INPUTS)[name].start)

    @property
    def field(self):
        """Gravity and the frame's inertia at the bearing's centre [m/s2] (bearing_model/physics/frame.py)."""
        w, R, w_dot = (self.value(f"frame.{name}") for name in ("omega", "radius", "omega_dot"))
        inertia = 0.0, w * w * R - self.value("frame.a_y"), -w_dot * R - self.value("frame.a_z")
        return (-self.value("frame.a_x"), self.value("gravity.y") + inertia[1], self.value("gravity.z") + inertia[2])

    @property
    def load(self):
        """Loads, speeds and support of the inner ring against the outer one; gravity and inertia act on ring.m and balls."""
        given = {f.name: self.value(f"shaft.{f.name}") for f in fields(Load) if f"shaft.{f.name}" in variables.INPUTS}
        given |= {name: given.get(name, 0.0) - self.value(f"housing.{name}") for name in ("tilt_y", "tilt_z")}
        given["F_x"] += self.value("impact.F_a")
        F_r, impact = math.hypot(given["F_y"], given["F_z"]), self.value("impact.F_r")
        cos, sin = (given["F_y"] / F_r, given["F_z"] / F_r) if F_r else (1.0, 0.0)
        given |= {"F_y": given["F_y"] + impact * cos, "F_z": given["F_z"] + impact * sin}
        weight = self.value("ring.m") * np.array(self.field)
        given |= {f"F_{a}": given[f"F_{a}"] + float(weight[k]) for k, a in enumerate("xyz")}
        given |= {"omega_e": self.value("housing.omega"), "frame_omega": self.value("frame.omega"), "field": self.field}
        mode = self.values.get("ring.tilt_mode", "prescribed")
        if mode == "prescribed":
            return Load(**given | {"M_y": 0.0, "M_z": 0.0})
        return Load(**given, k_tilt=self.values["ring.k_tilt"] if mode == "supported" else 0.0)

    @property
    def viscosity(self):
        """Viscosity of the oil at its temperature [Pa.s]; ValueError if its two points make no oil."""
        table = {name: v for name, v in variables.PARAMETERS.items() if name.startswith("oil.")}
        start = {n: self.model.default(self.model.parameters[n]) if self.model else v.start for n, v in table.items()}
        return oil.viscosity({name: self.value(name) for name in start}, start, self.value("oil.T"))

    @property
    def oil_density(self):
        """Density of the oil at its temperature [kg/m3]."""
        warmer = self.value("oil.T") - self.value("oil.T_0")
        return self.value("oil.rho") * (1.0 - self.value("oil.expansion") * warmer)

    @property
    def kappa(self):
        """Viscosity ratio nu/nu_1 of ISO 281, nan at rest."""
        omega = self.load.omega - self.load.omega_e
        if not omega:
            return math.nan
        return self.viscosity / self.oil_density / reference_viscosity(omega, self.values["bearing.d_m"])

    @property
    def joint(self):
        """Dimensions of rivet and cage for rivet_model.geometry.Geometry."""
        v = self.values
        return {
            "Z": self.Z,
            "d_m": v["bearing.d_m"],
            "ball_diameter": v["bearing.D"],
            "pocket_clearance": v["cage.pocket_clearance"],
            "cage_outer_diameter": v["cage.D_o"],
            "cage_inner_diameter": v["cage.D_i"],
            "cage_half_width": round(0.5 * v["cage.width"], 12),
            # without the rounding of the difference: the table's digest knows every bit
            "patch_radius": round((v["cage.D_o"] - v["cage.D_i"]) / 4.0, 12),
            **materials.geometry_of("cage", self.materials["cage"]),
            **({"shape": "ribbon", "pocket_fillet": v["cage.pocket_fillet"]} if ribbon.is_ribbon(v) else {}),
        } | (self.rivet or {})

    def equilibrium(self):
        """The QuasiStatic of ring and balls; UserError if there is none."""
        return self.solved(self.load, "exact")

    def standard_equilibrium(self):
        """The QuasiStatic of ISO/TS 16281: linear kinematics, no centrifugal forces; UserError if there is none."""
        at_rest = self.solved(replace(self.load, omega=0.0, omega_e=0.0, frame_omega=0.0), "linear")
        return replace(at_rest, load=self.load)

    def solved(self, load, kinematics):
        """The QuasiStatic under a load; UserError if there is none."""
        with naming(self.designation):
            return quasi_static(self.bearing, load, kinematics=kinematics)
