"""One rivet joint of a two-piece cage: dimensions and materials, from a TOML file or the defaults, with a hash.

      head_diameter
    ________________                     All lengths in m, in one meridian plane; the lower half mirrors the upper one.
   |                | head_height
   |__            __|  <- fillet_radius between head and shank
      |          |        relief: the hole is wider by relief_radius (radial) under the head, relief_depth deep
    __|          |__
flange  shank_diameter   flange_thickness, out to patch_radius: the rim moves as a rigid ring with its cage half
      |          |        edge_break: 45 degree chamfer of the hole at the split plane
- - - - split plane - - -
"""

import hashlib
import json
import math
import tomllib
from dataclasses import asdict, dataclass, fields
from pathlib import Path

SHAPES = ("machined", "ribbon")
OF_RIBBON = ("shape", "pocket_fillet")  # a machined half has none of these
REFERENCE_SHANK = 1.5e-3  # m, of the 6207's rivets, for which the ranges of the tables were chosen


@dataclass(frozen=True)
class Geometry:
    """Rivet joint and cage half; SI units.  Each line names its source; "assumed" is an estimate, "calibrated" names
    the figure that was fitted.
    """

    shank_diameter: float = 1.5e-3  # paper Table 1
    head_diameter: float = 2.6e-3  # assumed
    head_height: float = 0.9e-3  # assumed
    fillet_radius: float = 0.08e-3  # calibrated: head stress 140-150 MPa at 60 N preload
    relief_radius: float = 0.25e-3  # assumed, radial widening of the hole under the head
    relief_depth: float = 0.50e-3  # calibrated: head and middle stress cross in -0.02...0 mm
    edge_break: float = 0.15e-3  # assumed, chamfer of the hole at the split
    flange_thickness: float = 1.5e-3  # assumed, each half
    patch_radius: float = 2.45e-3  # (59.5 - 49.7)/4 mm, paper Table 1
    middle_zone: float = 0.1e-3  # half the length of the shank's middle, over which the largest stress counts
    E_rivet: float = 192e9  # paper Table 1
    nu_rivet: float = 0.30  # assumed
    yield_rivet: float = 590e6  # 15CrMn quenched and tempered, from memory of GB/T 3077: unverified
    hardening_rivet: float = 2e9  # assumed
    alpha_rivet: float = 12e-6  # 1/K, steel
    rho_rivet: float = 7850.0  # kg/m3, steel
    E_flange: float = 110e9  # bronze
    nu_flange: float = 0.33  # bronze
    yield_flange: float = 250e6  # bronze, assumed
    hardening_flange: float = 1.5e9  # assumed
    alpha_flange: float = 17.5e-6  # 1/K, bronze
    rho_flange: float = 8800.0  # kg/m3, bronze CuSn8 (UNS C52100: 8.80 g/cm3)
    T_0: float = 293.15  # K, assembly
    Z: int = 9  # rivets on the circle d_m
    d_m: float = 53.5e-3  # catalogue 6207
    cage_outer_diameter: float = 59.5e-3  # paper Table 1
    cage_inner_diameter: float = 49.7e-3  # paper Table 1
    ball_diameter: float = 11.1125e-3  # paper Table 1
    pocket_clearance: float = 0.2e-3  # assumed, diametral
    seat_diameter: float = 3.0e-3  # assumed: counterbore in the bar, room for the riveting tool around the head
    cage_half_width: float = 6.8e-3  # assumed: pocket radius and a web of 1.14 mm
    shape: str = "machined"  # of the half: half.py, or "ribbon": ribbon_shape.py
    pocket_fillet: float = 0.0  # of a ribbon: radius of the convex fillet between land and sphere, on the ball's side

    def __post_init__(self):
        if self.shape not in SHAPES:
            raise ValueError(f"geometry: shape = {self.shape!r}: one of {', '.join(SHAPES)} is needed")
        if self.shape != "ribbon" and self.pocket_fillet != 0.0:
            raise ValueError(f"geometry: pocket_fillet = {self.pocket_fillet!r}: only a ribbon has one")
        for field in fields(self):
            if field.name not in self.named:
                continue
            value = getattr(self, field.name)
            if (
                isinstance(value, bool)
                or not isinstance(value, (int, float))
                or not math.isfinite(value)
                or value <= 0.0
            ):
                raise ValueError(
                    f"geometry: {field.name} = {value!r}: a positive number is needed, in SI units without their symbol"
                )
        for name in ("nu_rivet", "nu_flange"):
            if getattr(self, name) >= 0.5:
                raise ValueError(f"geometry: {name} = {getattr(self, name)!r}: Poisson's ratio must be below 0.5")
        if not isinstance(self.Z, int) or not 5 <= self.Z <= 32:
            raise ValueError(f"geometry: Z = {self.Z!r}: a whole number from 5 to 32 is needed")
        radius = self.shank_diameter / 2
        limits = [
            ("head_diameter", self.head_diameter / 2, ">", "the relieved hole's radius", radius + self.relief_radius),
            ("patch_radius", self.patch_radius, ">", "the head's radius", self.head_diameter / 2),
            ("head_height", self.head_height, ">", "fillet_radius", self.fillet_radius),
            ("fillet_radius", self.fillet_radius, "<", "relief_radius", self.relief_radius),
            ("fillet_radius", self.fillet_radius, "<", "relief_depth", self.relief_depth),
            (
                "relief_depth + edge_break",
                self.relief_depth + self.edge_break,
                "<",
                "flange_thickness",
                self.flange_thickness,
            ),
            ("middle_zone", self.middle_zone, "<", "edge_break", self.edge_break),
            ("edge_break", self.edge_break, "<", "relief_radius", self.relief_radius),
            ("cage_inner_diameter", self.cage_inner_diameter, "<", "d_m", self.d_m),
            ("d_m", self.d_m, "<", "cage_outer_diameter", self.cage_outer_diameter),
            (
                "Z (ball_diameter + pocket_clearance)",
                self.Z * (self.ball_diameter + self.pocket_clearance),
                "<",
                "pi d_m",
                math.pi * self.d_m,
            ),
        ]
        for name, value, sign, other, limit in limits:
            if not (value > limit if sign == ">" else value < limit):
                raise ValueError(
                    f"geometry: {name} = {value:g} must be {'above' if sign == '>' else 'below'} {other} = {limit:g}"
                )

    @property
    def named(self):
        """Names of the numbers that must be positive: those of the shape."""
        return [
            f.name for f in fields(self) if f.name != "shape" and (self.shape == "ribbon" or f.name not in OF_RIBBON)
        ]

    @property
    def values(self):
        """All values by name, without those that only the other shape has."""
        return {k: v for k, v in asdict(self).items() if self.shape == "ribbon" or k not in OF_RIBBON}

    @property
    def size(self):
        """The joint's size over the 6207's, by the shank: ranges of lengths that a table covers go with it."""
        return self.shank_diameter / REFERENCE_SHANK

    @property
    def shank_area(self):
        """Section of the shank [m2]."""
        return math.pi / 4 * self.shank_diameter**2

    @property
    def joint(self):
        """Sizes and expansion of the joint by their names in a rivet table."""
        return {
            "A": self.shank_area,
            "d_m": self.d_m,
            "d": self.shank_diameter,
            "grip": 2 * self.flange_thickness,
            "seat": self.seat_diameter,
        } | {name: getattr(self, name) for name in ("alpha_rivet", "alpha_flange", "T_0")}

    @property
    def seat_width(self):
        """Radial width of the ring on which the head sits [m]: outside the relieved hole."""
        return 0.5 * (self.head_diameter - self.shank_diameter) - self.relief_radius

    @property
    def seat_share(self):
        """Area on which the head sits over the shank's section: the head presses on its seat with the shank's tension
        stress divided by this.
        """
        hole = self.shank_diameter + 2.0 * self.relief_radius
        return (self.head_diameter**2 - hole**2) / self.shank_diameter**2

    @property
    def digest(self):
        """First 16 digits of the SHA-256 of all values: tells whether a table was made for this geometry."""
        return hashlib.sha256(json.dumps(self.values, sort_keys=True).encode()).hexdigest()[:16]

    @classmethod
    def from_toml(cls, path, cage=None):
        """Read a TOML file; values that the file leaves out keep their defaults.

        cage: values that a bearing gives (name: value); the file may repeat but not change them, except patch_radius,
        which is the joint's own.

        >>> Geometry().digest == Geometry(**asdict(Geometry())).digest
        True

        Raises ValueError for an unknown key or an impossible size, OSError if the file cannot be read.
        """
        try:
            data = tomllib.loads(Path(path).read_text(encoding="utf-8-sig"))
        except (ValueError, RecursionError) as error:  # of the text, of int() or of nested lists
            raise ValueError(f"{path}: not valid TOML: {error}") from error
        known = {field.name for field in fields(cls)}
        unknown = sorted(set(data) - known)
        if unknown:
            raise ValueError(f"{path}: unknown key {unknown[0]!r}; allowed are {', '.join(sorted(known))}")
        for name, value in (cage or {}).items():
            if name != "patch_radius" and data.get(name, value) != value:
                raise ValueError(f"{path}: {name} = {data[name]!r}: the bearing has {value!r}")
        try:
            return cls(**((cage or {}) | data))
        except ValueError as error:
            raise ValueError(f"{path}: {error}") from error
