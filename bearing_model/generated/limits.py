"""Limits between parameters.  Written by fmus/generate.py from fmus/variables.toml: do not edit."""

# fmt: off
# ruff: noqa: E501

from collections.abc import Callable
from dataclasses import dataclass
from math import inf, pi, sin


@dataclass(frozen=True)
class Limit:
    """One limit: value, sign and bound as functions of parameters p, the number Z of balls and the index j of an element.

    allowed: in words, with {bound} for the number; keys: names that it is about, more: those of its condition alone.
    """

    quantity: str
    unit: str
    allowed: str
    reason: str
    keys: tuple
    sign: str
    value: Callable
    bound: Callable
    at: str = "everywhere"  # or run or build
    more: tuple = ()
    when: Callable = lambda p, Z, j: True  # whether the limit counts
    zero: bool = False  # whether a value of 0 is allowed too
    rounding: float = 0.0  # share of the bound by which the value may miss it

    @property
    def needs(self):
        """Names that the limit and its condition are about."""
        return self.keys + self.more

    @property
    def is_array(self):
        return any("[j]" in key for key in self.keys)

    def margin(self, p, Z, j=None):
        """How far the value is inside the bound; negative if the limit does not hold, infinite if it does not count."""
        value, bound = self.value(p, Z, j), self.bound(p, Z, j)
        if not self.when(p, Z, j) or (self.zero and value == 0.0):
            return inf
        inside = -abs(value - bound) if self.sign == "==" else bound - value if "<" in self.sign else value - bound
        return inside + self.rounding * abs(bound)

    def holds(self, p, Z, j=None):
        """Whether the limit holds; one with a margin that is not a number does not."""
        margin = self.margin(p, Z, j)
        return margin > 0.0 if self.sign in "<>" else margin >= 0.0

    def message(self, p, Z, j=None):
        """Name, value and what is allowed."""
        allowed = self.allowed.format(bound=self.bound(p, Z, j))
        said = f"{self.quantity} = {self.value(p, Z, j):g}{self.unit}: {allowed} is allowed for {self.reason}"
        return said.replace("[j]", f"[{j + 1}]") if self.is_array else said


LIMITS = (
    Limit("bearing.D", " m", "less than bearing.d_m sin(pi/Z) = {bound:g} m", "balls that do not overlap", ('bearing.D', 'bearing.d_m', 'Z'),
          "<", lambda p, Z, j: p.bearing.D, lambda p, Z, j: p.bearing.d_m * sin(pi / Z)),
    Limit("bearing.P_d", " m", "less than 4 bearing.D (min(bearing.f_i, bearing.f_e) - 0.5) = {bound:g} m", "balls that stay on their side of the grooves", ('bearing.P_d', 'bearing.D', 'bearing.f_i', 'bearing.f_e'),
          "<", lambda p, Z, j: p.bearing.P_d, lambda p, Z, j: 4.0 * p.bearing.D * (min(p.bearing.f_i, p.bearing.f_e) - 0.5)),
    Limit("bearing.P_d", " m", "at least -0.01 bearing.D = {bound:g} m", "an interference of at most 1 % of the ball", ('bearing.P_d', 'bearing.D'),
          ">=", lambda p, Z, j: p.bearing.P_d, lambda p, Z, j: -0.01 * p.bearing.D),
    Limit("cage.D_i", " m", "less than cage.D_o = {bound:g} m", "a cage with a wall", ('cage.D_i', 'cage.D_o'),
          "<", lambda p, Z, j: p.cage.D_i, lambda p, Z, j: p.cage.D_o),
    Limit("cage.D_o", " m", "at most bearing.d_m + bearing.D + bearing.P_d/2 - cage.guide_clearance = {bound:g} m", "a cage that, with its guide clearance, fits inside the outer groove's bottom", ('cage.D_o', 'bearing.d_m', 'bearing.D', 'bearing.P_d', 'cage.guide_clearance'),
          "<=", lambda p, Z, j: p.cage.D_o, lambda p, Z, j: p.bearing.d_m + p.bearing.D + p.bearing.P_d / 2.0 - p.cage.guide_clearance, at="run",
          more=('cage.shape',), when=lambda p, Z, j: p.cage.shape == 1),
    Limit("cage.D_i", " m", "at least bearing.d_m - bearing.D - bearing.P_d/2 + 2 bearing.h_i bearing.D = {bound:g} m", "a cage that passes over the inner ring's shoulder", ('cage.D_i', 'bearing.d_m', 'bearing.D', 'bearing.P_d', 'bearing.h_i'),
          ">=", lambda p, Z, j: p.cage.D_i, lambda p, Z, j: p.bearing.d_m - p.bearing.D - p.bearing.P_d / 2.0 + 2.0 * p.bearing.h_i * p.bearing.D, at="build",
          more=('cage.shape',), when=lambda p, Z, j: p.cage.shape == 1),
    Limit("cage.land_width", " m", "at most cage.width/2 = {bound:g} m", "a land on its half of the cage", ('cage.land_width', 'cage.width'),
          "<=", lambda p, Z, j: p.cage.land_width, lambda p, Z, j: p.cage.width / 2.0),
    Limit("cage.land_x", " m", "at most (cage.width - cage.land_width)/2 = {bound:g} m", "a land that does not reach over the cage's edge", ('cage.land_x', 'cage.width', 'cage.land_width'),
          "<=", lambda p, Z, j: p.cage.land_x, lambda p, Z, j: (p.cage.width - p.cage.land_width) / 2.0, at="build", rounding=0.001,
          more=('cage.shape',), when=lambda p, Z, j: p.cage.shape == 1),
    Limit("cage.m", " kg", "at most cage.rho.max pi/8 (cage.D_o^2 - cage.D_i^2) cage.width = {bound:g} kg", "a half lighter than a full ring of the heaviest metal", ('cage.m', 'cage.D_o', 'cage.D_i', 'cage.width'),
          "<=", lambda p, Z, j: p.cage.m, lambda p, Z, j: 23000.0 * pi / 8.0 * (p.cage.D_o * p.cage.D_o - p.cage.D_i * p.cage.D_i) * p.cage.width, at="run"),
    Limit("cage.m", " kg", "at least cage.rho.min pi/32 (cage.D_o^2 - cage.D_i^2) cage.width = {bound:g} kg", "a half heavier than a quarter of a full ring of the lightest material", ('cage.m', 'cage.D_o', 'cage.D_i', 'cage.width'),
          ">=", lambda p, Z, j: p.cage.m, lambda p, Z, j: 500.0 * pi / 32.0 * (p.cage.D_o * p.cage.D_o - p.cage.D_i * p.cage.D_i) * p.cage.width, at="run"),
    Limit("cage.J_p", " kg.m2", "at most cage.m cage.D_o^2/4 = {bound:g} kg.m2", "a half with its mass inside cage.D_o", ('cage.J_p', 'cage.m', 'cage.D_o'),
          "<=", lambda p, Z, j: p.cage.J_p, lambda p, Z, j: p.cage.m * p.cage.D_o * p.cage.D_o / 4.0, at="run", rounding=0.01),
    Limit("cage.J_p", " kg.m2", "at least cage.m cage.D_i^2/4 = {bound:g} kg.m2", "a half with its mass outside cage.D_i", ('cage.J_p', 'cage.m', 'cage.D_i'),
          ">=", lambda p, Z, j: p.cage.J_p, lambda p, Z, j: p.cage.m * p.cage.D_i * p.cage.D_i / 4.0, at="run", rounding=0.01),
    Limit("cage.J_p", " kg.m2", "at most 2 cage.J_t = {bound:g} kg.m2", "moments of inertia of a body", ('cage.J_p', 'cage.J_t'),
          "<=", lambda p, Z, j: p.cage.J_p, lambda p, Z, j: 2.0 * p.cage.J_t, at="run", rounding=0.01),
    Limit("cage.J_t", " kg.m2", "at most cage.m (cage.D_o^2 + cage.width^2) = {bound:g} kg.m2", "a body of at most twice the size of the half", ('cage.J_t', 'cage.m', 'cage.D_o', 'cage.width'),
          "<=", lambda p, Z, j: p.cage.J_t, lambda p, Z, j: p.cage.m * (p.cage.D_o * p.cage.D_o + p.cage.width * p.cage.width), at="run"),
    Limit("ring.J_p", " kg.m2", "at most 2 ring.J_t = {bound:g} kg.m2", "moments of inertia of a body", ('ring.J_p', 'ring.J_t'),
          "<=", lambda p, Z, j: p.ring.J_p, lambda p, Z, j: 2.0 * p.ring.J_t, at="run", rounding=0.01),
    Limit("ring.J_p", " kg.m2", "at least ring.m ring.bore^2/32 = {bound:g} kg.m2", "a ring with a solid shaft of half the bore at least, which needs no shorter steps", ('ring.J_p', 'ring.m', 'ring.bore'),
          ">=", lambda p, Z, j: p.ring.J_p, lambda p, Z, j: p.ring.m * p.ring.bore * p.ring.bore / 32.0, at="run", rounding=0.01,
          more=('ring.motion', 'ring.tilt_mode'), when=lambda p, Z, j: p.ring.motion == 1 and p.ring.tilt_mode != 1),
    Limit("rivet.head_diameter", " m", "at least rivet.shank_diameter + 2 rivet.relief_radius = {bound:g} m", "a head wider than the relieved hole", ('rivet.head_diameter', 'rivet.shank_diameter', 'rivet.relief_radius'),
          ">=", lambda p, Z, j: p.rivet.head_diameter, lambda p, Z, j: p.rivet.shank_diameter + 2.0 * p.rivet.relief_radius, at="build"),
    Limit("joint.preload", " N", "at most rivet.yield_rivet pi/4 rivet.shank_diameter^2 = {bound:g} N", "a shank that does not yield by its preload", ('joint.preload', 'rivet.yield_rivet', 'rivet.shank_diameter'),
          "<=", lambda p, Z, j: p.joint.preload, lambda p, Z, j: p.rivet.yield_rivet * pi / 4.0 * p.rivet.shank_diameter * p.rivet.shank_diameter, at="build"),
    Limit("rivet.head_height", " m", "at least rivet.fillet_radius = {bound:g} m", "a fillet below the head", ('rivet.head_height', 'rivet.fillet_radius'),
          ">=", lambda p, Z, j: p.rivet.head_height, lambda p, Z, j: p.rivet.fillet_radius, at="build"),
    Limit("rivet.fillet_radius", " m", "at most rivet.relief_radius = {bound:g} m", "a fillet inside the relief", ('rivet.fillet_radius', 'rivet.relief_radius'),
          "<=", lambda p, Z, j: p.rivet.fillet_radius, lambda p, Z, j: p.rivet.relief_radius, at="build"),
    Limit("rivet.fillet_radius", " m", "at most rivet.relief_depth = {bound:g} m", "a fillet inside the relief", ('rivet.fillet_radius', 'rivet.relief_depth'),
          "<=", lambda p, Z, j: p.rivet.fillet_radius, lambda p, Z, j: p.rivet.relief_depth, at="build"),
    Limit("rivet.flange_thickness", " m", "at least rivet.relief_depth + rivet.edge_break = {bound:g} m", "a flange that bears the shank", ('rivet.flange_thickness', 'rivet.relief_depth', 'rivet.edge_break'),
          ">=", lambda p, Z, j: p.rivet.flange_thickness, lambda p, Z, j: p.rivet.relief_depth + p.rivet.edge_break, at="build"),
    Limit("rivet.edge_break", " m", "at most rivet.relief_radius = {bound:g} m", "a chamfer smaller than the relief", ('rivet.edge_break', 'rivet.relief_radius'),
          "<=", lambda p, Z, j: p.rivet.edge_break, lambda p, Z, j: p.rivet.relief_radius, at="build"),
    Limit("rivet.middle_zone", " m", "at most rivet.edge_break = {bound:g} m", "a middle zone inside the chamfer", ('rivet.middle_zone', 'rivet.edge_break'),
          "<=", lambda p, Z, j: p.rivet.middle_zone, lambda p, Z, j: p.rivet.edge_break, at="build"),
    Limit("catalogue.bore", " m", "at most bearing.d_m - bearing.D - bearing.P_d/2 - 0.0004 = {bound:g} m", "an inner ring below its groove", ('catalogue.bore', 'bearing.d_m', 'bearing.D', 'bearing.P_d'),
          "<=", lambda p, Z, j: p.catalogue.bore, lambda p, Z, j: p.bearing.d_m - p.bearing.D - p.bearing.P_d / 2.0 - 0.0004, at="build"),
    Limit("catalogue.outside_diameter", " m", "at least bearing.d_m + bearing.D + bearing.P_d/2 + 0.0004 = {bound:g} m", "an outer ring above its groove", ('catalogue.outside_diameter', 'bearing.d_m', 'bearing.D', 'bearing.P_d'),
          ">=", lambda p, Z, j: p.catalogue.outside_diameter, lambda p, Z, j: p.bearing.d_m + p.bearing.D + p.bearing.P_d / 2.0 + 0.0004, at="build"),
    Limit("catalogue.width", " m", "at least cage.width = {bound:g} m", "a cage inside the bearing's width", ('catalogue.width', 'cage.width'),
          ">=", lambda p, Z, j: p.catalogue.width, lambda p, Z, j: p.cage.width, at="build"),
    Limit("catalogue.width", " m", "at least bearing.D = {bound:g} m", "balls inside the bearing's width", ('catalogue.width', 'bearing.D'),
          ">=", lambda p, Z, j: p.catalogue.width, lambda p, Z, j: p.bearing.D, at="build"),
    Limit("cage.D_i", " m", "less than bearing.d_m = {bound:g} m", "a cage around the pitch circle", ('cage.D_i', 'bearing.d_m'),
          "<", lambda p, Z, j: p.cage.D_i, lambda p, Z, j: p.bearing.d_m),
    Limit("cage.D_o", " m", "more than bearing.d_m = {bound:g} m", "a cage around the pitch circle", ('cage.D_o', 'bearing.d_m'),
          ">", lambda p, Z, j: p.cage.D_o, lambda p, Z, j: p.bearing.d_m),
    Limit("cage.pocket_clearance", " m", "less than bearing.d_m sin(pi/Z) - bearing.D = {bound:g} m", "pockets that do not overlap", ('cage.pocket_clearance', 'bearing.d_m', 'Z', 'bearing.D'),
          "<", lambda p, Z, j: p.cage.pocket_clearance, lambda p, Z, j: p.bearing.d_m * sin(pi / Z) - p.bearing.D),
    Limit("cage.pocket_clearance", " m", "more than {bound:g} m", "a cage that balls guide", ('cage.pocket_clearance',),
          ">", lambda p, Z, j: p.cage.pocket_clearance, lambda p, Z, j: 0.0,
          more=('cage.guidance',), when=lambda p, Z, j: p.cage.guidance == 2),
    Limit("cage.unbalance", " kg.m", "at most 0.0004 cage.m = {bound:g} kg.m", "a cage whose centre of mass is at most 0.2 mm off", ('cage.unbalance', 'cage.m'),
          "<=", lambda p, Z, j: p.cage.unbalance, lambda p, Z, j: 0.0004 * p.cage.m),
    Limit("cage.width", " m", "at least 1.05 (bearing.D + cage.pocket_clearance) = {bound:g} m", "webs that close the pockets", ('cage.width', 'bearing.D', 'cage.pocket_clearance'),
          ">=", lambda p, Z, j: p.cage.width, lambda p, Z, j: 1.05 * (p.bearing.D + p.cage.pocket_clearance), at="run",
          more=('cage.shape',), when=lambda p, Z, j: p.cage.shape == 1),
    Limit("cage.guidance", "", "balls (2)", "a ribbon cage (cage.shape), which has no land on the outer ring", ('cage.guidance',),
          "==", lambda p, Z, j: p.cage.guidance, lambda p, Z, j: 2,
          more=('cage.shape',), when=lambda p, Z, j: p.cage.shape == 2),
    Limit("cage.guidance", "", "outer (1)", "a machined cage (cage.shape), whose drilled pockets slide along the radius", ('cage.guidance',),
          "==", lambda p, Z, j: p.cage.guidance, lambda p, Z, j: 1, at="run",
          more=('cage.shape',), when=lambda p, Z, j: p.cage.shape == 1),
    Limit("cage.sheet", " m", "{bound:g} m", "a machined cage (cage.shape), which has no such size", ('cage.sheet',),
          "==", lambda p, Z, j: p.cage.sheet, lambda p, Z, j: 0.0,
          more=('cage.shape',), when=lambda p, Z, j: p.cage.shape == 1),
    Limit("cage.pocket_depth", " m", "{bound:g} m", "a machined cage (cage.shape), which has no such size", ('cage.pocket_depth',),
          "==", lambda p, Z, j: p.cage.pocket_depth, lambda p, Z, j: 0.0,
          more=('cage.shape',), when=lambda p, Z, j: p.cage.shape == 1),
    Limit("cage.pocket_fillet", " m", "{bound:g} m", "a machined cage (cage.shape), which has no such size", ('cage.pocket_fillet',),
          "==", lambda p, Z, j: p.cage.pocket_fillet, lambda p, Z, j: 0.0,
          more=('cage.shape',), when=lambda p, Z, j: p.cage.shape == 1),
    Limit("cage.pocket_radius", " m", "{bound:g} m", "a machined cage (cage.shape), which has no such size", ('cage.pocket_radius',),
          "==", lambda p, Z, j: p.cage.pocket_radius, lambda p, Z, j: 0.0,
          more=('cage.shape',), when=lambda p, Z, j: p.cage.shape == 1),
    Limit("cage.pocket_edge", " m", "{bound:g} m", "a machined cage (cage.shape), which has no such size", ('cage.pocket_edge',),
          "==", lambda p, Z, j: p.cage.pocket_edge, lambda p, Z, j: 0.0,
          more=('cage.shape',), when=lambda p, Z, j: p.cage.shape == 1),
    Limit("cage.sheet", " m", "more than {bound:g} m", "a ribbon cage (cage.shape)", ('cage.sheet',),
          ">", lambda p, Z, j: p.cage.sheet, lambda p, Z, j: 0.0,
          more=('cage.shape',), when=lambda p, Z, j: p.cage.shape == 2),
    Limit("cage.pocket_depth", " m", "more than {bound:g} m", "a ribbon cage (cage.shape)", ('cage.pocket_depth',),
          ">", lambda p, Z, j: p.cage.pocket_depth, lambda p, Z, j: 0.0,
          more=('cage.shape',), when=lambda p, Z, j: p.cage.shape == 2),
    Limit("cage.pocket_fillet", " m", "more than {bound:g} m", "a ribbon cage (cage.shape)", ('cage.pocket_fillet',),
          ">", lambda p, Z, j: p.cage.pocket_fillet, lambda p, Z, j: 0.0,
          more=('cage.shape',), when=lambda p, Z, j: p.cage.shape == 2),
    Limit("cage.width", " m", "2 (cage.pocket_depth + cage.sheet) = {bound:g} m +- 1 %", "a ribbon as wide as pockets and sheets of both halves", ('cage.width', 'cage.pocket_depth', 'cage.sheet'),
          "==", lambda p, Z, j: p.cage.width, lambda p, Z, j: 2.0 * (p.cage.pocket_depth + p.cage.sheet), rounding=0.01,
          more=('cage.shape',), when=lambda p, Z, j: p.cage.shape == 2),
    Limit("cage.pocket_radius", " m", "0, which stands for the sphere that follows, or (bearing.D + cage.pocket_clearance)/2 = {bound:g} m +- 0.0001 %", "a sphere around the ball", ('cage.pocket_radius', 'bearing.D', 'cage.pocket_clearance'),
          "==", lambda p, Z, j: p.cage.pocket_radius, lambda p, Z, j: (p.bearing.D + p.cage.pocket_clearance) / 2.0, zero=True, rounding=1e-06,
          more=('cage.shape',), when=lambda p, Z, j: p.cage.shape == 2),
    Limit("cage.pocket_depth", " m", "more than bearing.D/2 = {bound:g} m", "a pocket with room for the ball", ('cage.pocket_depth', 'bearing.D'),
          ">", lambda p, Z, j: p.cage.pocket_depth, lambda p, Z, j: p.bearing.D / 2.0,
          more=('cage.shape',), when=lambda p, Z, j: p.cage.shape == 2),
    Limit("cage.pocket_depth", " m", "at most (bearing.D + cage.pocket_clearance)/2 = {bound:g} m", "a pocket no deeper than a sphere", ('cage.pocket_depth', 'bearing.D', 'cage.pocket_clearance'),
          "<=", lambda p, Z, j: p.cage.pocket_depth, lambda p, Z, j: (p.bearing.D + p.cage.pocket_clearance) / 2.0,
          more=('cage.shape',), when=lambda p, Z, j: p.cage.shape == 2),
    Limit("cage.D_o + cage.D_i", " m", "at most 2 (bearing.d_m + cage.pocket_clearance) = {bound:g} m", "pockets around the balls (change both diameters)", ('cage.D_o', 'cage.D_i', 'bearing.d_m', 'cage.pocket_clearance'),
          "<=", lambda p, Z, j: p.cage.D_o + p.cage.D_i, lambda p, Z, j: 2.0 * (p.bearing.d_m + p.cage.pocket_clearance),
          more=('cage.shape',), when=lambda p, Z, j: p.cage.shape == 2),
    Limit("cage.D_o + cage.D_i", " m", "at least 2 (bearing.d_m - cage.pocket_clearance) = {bound:g} m", "pockets around the balls (change both diameters)", ('cage.D_o', 'cage.D_i', 'bearing.d_m', 'cage.pocket_clearance'),
          ">=", lambda p, Z, j: p.cage.D_o + p.cage.D_i, lambda p, Z, j: 2.0 * (p.bearing.d_m - p.cage.pocket_clearance),
          more=('cage.shape',), when=lambda p, Z, j: p.cage.shape == 2),
    Limit("cage.D_o - cage.D_i", " m", "more than 8 cage.pocket_edge = {bound:g} m", "a sphere between the pocket's edges", ('cage.D_o', 'cage.D_i', 'cage.pocket_edge'),
          ">", lambda p, Z, j: p.cage.D_o - p.cage.D_i, lambda p, Z, j: 8.0 * p.cage.pocket_edge,
          more=('cage.shape',), when=lambda p, Z, j: p.cage.shape == 2),
    Limit("ring.bore", " m", "less than bearing.d_m - bearing.D = {bound:g} m", "an inner ring below its groove", ('ring.bore', 'bearing.d_m', 'bearing.D'),
          "<", lambda p, Z, j: p.ring.bore, lambda p, Z, j: p.bearing.d_m - p.bearing.D),
    Limit("ring.bore", " m", "at least {bound:g} m", "a ring, whose bore's square does not underflow", ('ring.bore',),
          ">=", lambda p, Z, j: p.ring.bore, lambda p, Z, j: 1e-06),
    Limit("ring.effective_i", " m", "at least bearing.d_m - bearing.D = {bound:g} m", "an inner ring up to its groove's bottom at least", ('ring.effective_i', 'bearing.d_m', 'bearing.D'),
          ">=", lambda p, Z, j: p.ring.effective_i, lambda p, Z, j: p.bearing.d_m - p.bearing.D),
    Limit("ring.effective_e", " m", "at most bearing.d_m + bearing.D = {bound:g} m", "an outer ring down to its groove's bottom at least", ('ring.effective_e', 'bearing.d_m', 'bearing.D'),
          "<=", lambda p, Z, j: p.ring.effective_e, lambda p, Z, j: p.bearing.d_m + p.bearing.D),
    Limit("ring.outside", " m", "more than bearing.d_m + bearing.D = {bound:g} m", "an outer ring above its groove", ('ring.outside', 'bearing.d_m', 'bearing.D'),
          ">", lambda p, Z, j: p.ring.outside, lambda p, Z, j: p.bearing.d_m + p.bearing.D),
    Limit("shaft.bore", " m", "less than ring.bore = {bound:g} m", "a shaft inside the inner ring", ('shaft.bore', 'ring.bore'),
          "<", lambda p, Z, j: p.shaft.bore, lambda p, Z, j: p.ring.bore),
    Limit("housing.outside", " m", "0, which stands for a thick wall, or more than ring.outside = {bound:g} m", "a housing around the outer ring", ('housing.outside', 'ring.outside'),
          ">", lambda p, Z, j: p.housing.outside, lambda p, Z, j: p.ring.outside, zero=True),
    Limit("ball.E", " Pa", "0, which stands for bearing.E, or at least bearing.E.min = {bound:g} Pa", "balls of a solid", ('ball.E',),
          ">=", lambda p, Z, j: p.ball.E, lambda p, Z, j: 1000000000.0, zero=True),
    Limit("oil.T_1", " K", "less than oil.T_2 = {bound:g} K", "the two points of the oil's viscosity", ('oil.T_1', 'oil.T_2'),
          "<", lambda p, Z, j: p.oil.T_1, lambda p, Z, j: p.oil.T_2),
    Limit("oil.nu_1", " m2/s", "more than oil.nu_2 = {bound:g} m2/s", "a viscosity that falls with temperature", ('oil.nu_1', 'oil.nu_2'),
          ">", lambda p, Z, j: p.oil.nu_1, lambda p, Z, j: p.oil.nu_2),
    Limit("fatigue.k_2", "", "at least fatigue.k_1 = {bound:g}", "an S-N line that does not become steeper", ('fatigue.k_2', 'fatigue.k_1'),
          ">=", lambda p, Z, j: p.fatigue.k_2, lambda p, Z, j: p.fatigue.k_1),
    Limit("pulse.interval", " s", "at least pulse.duration = {bound:g} s", "impacts one after the other", ('pulse.interval', 'pulse.duration'),
          ">=", lambda p, Z, j: p.pulse.interval, lambda p, Z, j: p.pulse.duration,
          more=('pulse.count',), when=lambda p, Z, j: p.pulse.count >= 2.0),
    Limit("pocket[j].dD", " m", "more than -cage.pocket_clearance = {bound:g} m", "a pocket larger than the ball", ('pocket[j].dD', 'cage.pocket_clearance'),
          ">", lambda p, Z, j: p.pocket.dD[j], lambda p, Z, j: -p.cage.pocket_clearance,
          more=(), when=lambda p, Z, j: p.pocket.dD[j] < 0.0),
    Limit("ball[j].dD", " m", "less than cage.pocket_clearance + pocket[j].dD = {bound:g} m", "a ball smaller than its pocket", ('ball[j].dD', 'cage.pocket_clearance', 'pocket[j].dD'),
          "<", lambda p, Z, j: p.ball.dD[j], lambda p, Z, j: p.cage.pocket_clearance + p.pocket.dD[j],
          more=(), when=lambda p, Z, j: p.ball.dD[j] > 0.0 and p.cage.pocket_clearance + p.pocket.dD[j] > 0.0),
    Limit("inner.spall_length", " m", "at most pi/2 (bearing.d_m - bearing.D) = {bound:g} m", "a spall along half the circumference at most", ('inner.spall_length', 'bearing.d_m', 'bearing.D'),
          "<=", lambda p, Z, j: p.inner.spall_length, lambda p, Z, j: pi / 2.0 * (p.bearing.d_m - p.bearing.D)),
    Limit("outer.spall_length", " m", "at most pi/2 (bearing.d_m + bearing.D) = {bound:g} m", "a spall along half the circumference at most", ('outer.spall_length', 'bearing.d_m', 'bearing.D'),
          "<=", lambda p, Z, j: p.outer.spall_length, lambda p, Z, j: pi / 2.0 * (p.bearing.d_m + p.bearing.D)),
    Limit("ball[j].spall_length", " m", "at most pi/2 bearing.D = {bound:g} m", "a spall along half the circumference at most", ('ball[j].spall_length', 'bearing.D'),
          "<=", lambda p, Z, j: p.ball.spall_length[j], lambda p, Z, j: pi / 2.0 * p.bearing.D),
    Limit("inner.spall_width", " m", "at most bearing.D = {bound:g} m", "a spall no wider than the ball", ('inner.spall_width', 'bearing.D'),
          "<=", lambda p, Z, j: p.inner.spall_width, lambda p, Z, j: p.bearing.D),
    Limit("outer.spall_width", " m", "at most bearing.D = {bound:g} m", "a spall no wider than the ball", ('outer.spall_width', 'bearing.D'),
          "<=", lambda p, Z, j: p.outer.spall_width, lambda p, Z, j: p.bearing.D),
    Limit("ball[j].spall_width", " m", "at most bearing.D = {bound:g} m", "a spall no wider than the ball", ('ball[j].spall_width', 'bearing.D'),
          "<=", lambda p, Z, j: p.ball.spall_width[j], lambda p, Z, j: p.bearing.D),
    Limit("inner.spall_depth", " m", "at most bearing.D/20 = {bound:g} m", "a spall over whose edges the ball rolls", ('inner.spall_depth', 'bearing.D'),
          "<=", lambda p, Z, j: p.inner.spall_depth, lambda p, Z, j: p.bearing.D / 20.0),
    Limit("outer.spall_depth", " m", "at most bearing.D/20 = {bound:g} m", "a spall over whose edges the ball rolls", ('outer.spall_depth', 'bearing.D'),
          "<=", lambda p, Z, j: p.outer.spall_depth, lambda p, Z, j: p.bearing.D / 20.0),
    Limit("ball[j].spall_depth", " m", "at most bearing.D/20 = {bound:g} m", "a spall over whose edges the ball rolls", ('ball[j].spall_depth', 'bearing.D'),
          "<=", lambda p, Z, j: p.ball.spall_depth[j], lambda p, Z, j: p.bearing.D / 20.0),
    Limit("inner.spall_length", " m", "more than {bound:g} m", "a spall, which has inner.spall_length, inner.spall_width and inner.spall_depth, or 0 for all three", ('inner.spall_length',),
          ">", lambda p, Z, j: p.inner.spall_length, lambda p, Z, j: 0.0,
          more=('inner.spall_width', 'inner.spall_depth'), when=lambda p, Z, j: p.inner.spall_width > 0.0 or p.inner.spall_depth > 0.0),
    Limit("outer.spall_length", " m", "more than {bound:g} m", "a spall, which has outer.spall_length, outer.spall_width and outer.spall_depth, or 0 for all three", ('outer.spall_length',),
          ">", lambda p, Z, j: p.outer.spall_length, lambda p, Z, j: 0.0,
          more=('outer.spall_width', 'outer.spall_depth'), when=lambda p, Z, j: p.outer.spall_width > 0.0 or p.outer.spall_depth > 0.0),
    Limit("ball[j].spall_length", " m", "more than {bound:g} m", "a spall, which has ball[j].spall_length, ball[j].spall_width and ball[j].spall_depth, or 0 for all three", ('ball[j].spall_length',),
          ">", lambda p, Z, j: p.ball.spall_length[j], lambda p, Z, j: 0.0,
          more=('ball[j].spall_width', 'ball[j].spall_depth'), when=lambda p, Z, j: p.ball.spall_width[j] > 0.0 or p.ball.spall_depth[j] > 0.0),
    Limit("inner.spall_width", " m", "more than {bound:g} m", "a spall, which has inner.spall_length, inner.spall_width and inner.spall_depth, or 0 for all three", ('inner.spall_width',),
          ">", lambda p, Z, j: p.inner.spall_width, lambda p, Z, j: 0.0,
          more=('inner.spall_length', 'inner.spall_depth'), when=lambda p, Z, j: p.inner.spall_length > 0.0 or p.inner.spall_depth > 0.0),
    Limit("outer.spall_width", " m", "more than {bound:g} m", "a spall, which has outer.spall_length, outer.spall_width and outer.spall_depth, or 0 for all three", ('outer.spall_width',),
          ">", lambda p, Z, j: p.outer.spall_width, lambda p, Z, j: 0.0,
          more=('outer.spall_length', 'outer.spall_depth'), when=lambda p, Z, j: p.outer.spall_length > 0.0 or p.outer.spall_depth > 0.0),
    Limit("ball[j].spall_width", " m", "more than {bound:g} m", "a spall, which has ball[j].spall_length, ball[j].spall_width and ball[j].spall_depth, or 0 for all three", ('ball[j].spall_width',),
          ">", lambda p, Z, j: p.ball.spall_width[j], lambda p, Z, j: 0.0,
          more=('ball[j].spall_length', 'ball[j].spall_depth'), when=lambda p, Z, j: p.ball.spall_length[j] > 0.0 or p.ball.spall_depth[j] > 0.0),
    Limit("inner.spall_depth", " m", "more than {bound:g} m", "a spall, which has inner.spall_length, inner.spall_width and inner.spall_depth, or 0 for all three", ('inner.spall_depth',),
          ">", lambda p, Z, j: p.inner.spall_depth, lambda p, Z, j: 0.0,
          more=('inner.spall_length', 'inner.spall_width'), when=lambda p, Z, j: p.inner.spall_length > 0.0 or p.inner.spall_width > 0.0),
    Limit("outer.spall_depth", " m", "more than {bound:g} m", "a spall, which has outer.spall_length, outer.spall_width and outer.spall_depth, or 0 for all three", ('outer.spall_depth',),
          ">", lambda p, Z, j: p.outer.spall_depth, lambda p, Z, j: 0.0,
          more=('outer.spall_length', 'outer.spall_width'), when=lambda p, Z, j: p.outer.spall_length > 0.0 or p.outer.spall_width > 0.0),
    Limit("ball[j].spall_depth", " m", "more than {bound:g} m", "a spall, which has ball[j].spall_length, ball[j].spall_width and ball[j].spall_depth, or 0 for all three", ('ball[j].spall_depth',),
          ">", lambda p, Z, j: p.ball.spall_depth[j], lambda p, Z, j: 0.0,
          more=('ball[j].spall_length', 'ball[j].spall_width'), when=lambda p, Z, j: p.ball.spall_length[j] > 0.0 or p.ball.spall_width[j] > 0.0),
    Limit("ball[j].spall_length", " m", "{bound:g} m", "solver.method = explicit, which does not follow the turn of a ball; verlet and fixed do", ('ball[j].spall_length',),
          "==", lambda p, Z, j: p.ball.spall_length[j], lambda p, Z, j: 0.0, at="run",
          more=('solver.method', 'ball[j].spall_width', 'ball[j].spall_depth'), when=lambda p, Z, j: p.solver.method == 2 and p.ball.spall_width[j] > 0.0 and p.ball.spall_depth[j] > 0.0),
    Limit("housing.motion", "", "given (1)", "solver.method = explicit, which has no housing on springs; verlet and fixed have", ('housing.motion',),
          "==", lambda p, Z, j: p.housing.motion, lambda p, Z, j: 1, at="run",
          more=('solver.method',), when=lambda p, Z, j: p.solver.method == 2),
    Limit("solver.step", " s", "0, which stands for a derived step, or at least {bound:g} s", "a run that ends", ('solver.step',),
          ">=", lambda p, Z, j: p.solver.step, lambda p, Z, j: 1e-09, zero=True),
    Limit("scene.breakage", "", "off (1)", "a run that counts no damage; scene.stress = fatigue does", ('scene.breakage',),
          "==", lambda p, Z, j: p.scene.breakage, lambda p, Z, j: 1,
          more=('scene.stress',), when=lambda p, Z, j: p.scene.stress != 4),
)
