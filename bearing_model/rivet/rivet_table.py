"""The rivet table: its file format and its reader.  rivet_model writes the file; the FMU's build and the Python
reference read it here.

The file is JSON text.  Sections: `header` {format, kind (one of KINDS), note, geometry, geometry_hash, Z, units,
errors, digest}, `shank` (knots and spline coefficients of the stress over the loads of the shank, see
fmu_src/rivet/rivet_rom.h; constants of head friction and yield), `fit_eff` (interference with plasticity), `joint`
(stiffnesses for the dynamics), `half` (the cage half: masses, load path and law of its joints, see half_path.py and
joint_law.py), `modes` (its vibration, see half_modes.py; closed forms have none). Units in the file are SI except
stress per force, which is in MPa/N = 1/mm2 to keep it readable.
"""

import hashlib
import json
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from bearing_model.cage.common import joint_law
from bearing_model.cage.elastic.half_modes import PAD, RIVET, HalfModes, Residual
from bearing_model.cage.two_half import half_path

DEFAULT_TABLE = Path(__file__).resolve().parents[2] / "rivet_model" / "tables" / "6207.json"
FORMAT = "rivet-table-8"
# numbered from 1: the output rivet.table_kind
KINDS = {"fe": "finite elements", "fe_coarse": "coarse finite elements", "closed_form": "closed forms"}
SHAPES = ("machined", "ribbon")
SECTIONS = ("header", "shank", "fit_eff", "joint", "half", "modes")
CHANNELS = ("head_p1", "head_vm", "mid_vm", "mid_p1")
SHANK_AXES = ("a", "c", "xi")
SHEETS = ("plane", "oblique", "across")  # chi, |cos| of the direction of M, is 1, 1/2, 0
MPA_PER_N = 1e6  # 1/mm2 in 1/m2
JOINT_KEYS = ("A", "d_m", "d", "grip", "seat", "k_t_plate", "k_t_head", "k_stack", "alpha_rivet", "alpha_flange", "T_0")


@dataclass
class ShankTable:
    """Stress of the rivet over the loads of its shank: sigma = s T(a, c, xi), s = tension + V, a = V/s, c = |m|/(length
    tension), xi = fit_eff/s.
    """

    length: float  # of c = 1: largest moment of the shank per tension [m]
    knots: dict  # SHANK_AXES -> knots
    coefficients: np.ndarray  # [a, c, xi, sheet, channel] [1/m2]


@dataclass
class HalfData:
    """Data of the elastic cage half in the table: see half_path.py and joint_law.py."""

    m: float  # mass of one half with its half of the rivets [kg]
    x_c: float  # place of its centre of mass [m]
    J_p: float  # moments of inertia about it [kg m2]
    J_t: float
    chi: np.ndarray  # nodes of the wall's angle [rad]
    path: np.ndarray  # [chi, Z, 8, 3]; of a ribbon [radii, chi, Z, 8, 3]
    spin: np.ndarray  # [8] per (rad/s)^2 at mass m
    # [waves, harmonic, 1 and x, 8] rows by a radial line load at the land: half_path.land_path_rows
    land: np.ndarray
    growth: np.ndarray  # [2] of its radius at the land x per (rad/s)^2 at mass m: by 1 [m.s2] and by x [s2]
    law: joint_law.JointLaw
    k_closed: float  # force per separation of the halves' bodies, for each joint: plates closed, plates open [N/m]
    k_open: float
    radii: np.ndarray = field(default_factory=lambda: np.zeros(0))  # nodes of the wall's radius [m], of a ribbon's only
    # of a ribbon's only: preload under spin over s = P + w, w = spin[5] omega^2, at equal steps of w/s (rivet_model/land_bending.py)
    spin_preload: np.ndarray = field(default_factory=lambda: np.zeros(0))
    yield_force: float = 0.0  # of a ribbon's only: of a ball on its pocket, under which the half begins to yield [N]

    def __post_init__(self):
        self.path = single(self.path)
        every = self.path if len(self.radii) else self.path[None]
        slope = single(np.stack([half_path.path_slopes(self.chi, one) for one in every]))
        self.path_slope = slope if len(self.radii) else slope[0]


@dataclass
class RivetTable:
    """Everything the FMU knows of one rivet joint and its cage half.  Arrays are those of the file; coefficients in
    1/m2, rounded to five digits.
    """

    kind: str  # one of KINDS
    geometry: dict
    geometry_hash: str
    Z: int
    head_friction: float  # [1/m2]
    head_friction_vm: float  # [1/m2]
    yield_rivet: float  # [Pa]
    fit_flange_yield: float  # [m]
    fit_a: np.ndarray
    fit_eff: np.ndarray
    fit_slope: np.ndarray
    joint: dict  # JOINT_KEYS and hole_fit, k_hole
    shank: ShankTable
    half: HalfData
    modes: HalfModes | None = None  # None: closed forms have none
    note: str = ""
    errors: dict = field(default_factory=dict)

    @property
    def shape(self):
        """Shape of the half: machined or ribbon."""
        return self.geometry.get("shape", SHAPES[0])

    @property
    def kind_number(self):
        """1 finite elements, 2 coarse, 3 closed forms."""
        return list(KINDS).index(self.kind) + 1


def single(numbers):
    """Numbers in the precision in which both readers use them."""
    return numbers.astype(np.float32).astype(float)


def as_embedded(coefficients):
    """Stress coefficients of the file in 1/m2, as both readers use them."""
    return single(MPA_PER_N * coefficients)


def digest_of(sections):
    """Digest of the sections behind the header: it tells a damaged file."""
    return hashlib.sha256(json.dumps(sections, sort_keys=True, separators=(",", ":")).encode()).hexdigest()


def _need(condition, path, message):
    if not condition:
        raise ValueError(f"{path}: {message}")


def _numbers(path, where, values):
    """An array of finite numbers."""
    try:
        array = np.array(values, dtype=float)
    except (TypeError, ValueError, OverflowError) as error:
        raise ValueError(f"{path}: {where} is not made of numbers: {error}") from None
    _need(np.all(np.isfinite(array)), path, f"{where} contains a number that is not finite")
    return array


class _Section:
    """One section of a file: its members by name, each checked."""

    def __init__(self, path, name, members):
        _need(isinstance(members, dict), path, f"{name} is no table of names and values")
        self.path, self.name, self.members = path, name, members

    def member(self, key, kind):
        _need(key in self.members, self.path, f"{self.name} lacks {key!r}")
        value = self.members[key]
        right = isinstance(value, kind) and not isinstance(value, bool)
        _need(right, self.path, f"{self.name}.{key} is of type {type(value).__name__}, not {kind.__name__}")
        return value

    def number(self, key):
        _need(key in self.members, self.path, f"{self.name} lacks {key!r}")
        array = _numbers(self.path, f"{self.name}.{key}", self.members[key])
        _need(array.ndim == 0, self.path, f"{self.name}.{key} is not one number")
        return float(array)

    def numbers(self, key):
        array = _numbers(self.path, f"{self.name}.{key}", self.member(key, list))
        _need(array.ndim == 1 and len(array) > 1, self.path, f"{self.name}.{key} is not a list of numbers")
        return array

    def array(self, key, shape):
        array = _numbers(self.path, f"{self.name}.{key}", self.member(key, list))
        _need(array.shape == shape, self.path, f"{self.name}.{key} has shape {array.shape}; {shape} is needed")
        return array


def _sections(path):
    """Header and sections of a file whose format and digest are right."""
    try:
        data = json.loads(Path(path).read_text(encoding="utf-8"))
        known_format, digest = data["header"]["format"], data["header"]["digest"]
        sections = {name: data[name] for name in SECTIONS}
    except (json.JSONDecodeError, UnicodeDecodeError, RecursionError) as error:
        raise ValueError(f"{path}: not a rivet table (JSON text): {error}") from error
    except (KeyError, TypeError) as error:
        raise ValueError(f"{path}: not a rivet table: {error} is missing") from error
    again = "make the table again: `riveted-bearing build` does so for a bearing or a geometry of its rivet"
    _need(known_format == FORMAT, path, f"format is {known_format!r}; {FORMAT!r} is needed: {again}")
    _need(
        digest_of({k: data[k] for k in data if k != "header"}) == digest,
        path,
        "damaged: the digest in the header does not fit its sections",
    )
    return (_Section(path, name, members) for name, members in sections.items())


def _spline(path, section, axes, shape):
    """Knots by axis and coefficients [axes ..., *shape] of a tensor product of splines."""
    at = _Section(path, f"{section.name}.knots", section.member("knots", dict))
    knots = {name: at.numbers(name) for name in axes}
    for name, values in knots.items():
        _need(np.all(np.diff(values) > 0), path, f"{section.name}: knots of axis {name} do not increase")
    shape = (*(len(knots[name]) + 1 for name in axes), *shape)
    coefficients = section.numbers("coefficients")
    _need(
        len(coefficients) == np.prod(shape),
        path,
        f"{section.name}: {len(coefficients)} coefficients; {np.prod(shape)} are needed",
    )
    return knots, coefficients.reshape(shape)


def _read_shank(path, section):
    knots, coefficients = _spline(path, section, SHANK_AXES, (len(SHEETS), len(CHANNELS)))
    length = section.number("length")
    _need(length > 0.0, path, f"shank.length = {length} m: more than 0 is needed")
    return ShankTable(length, knots, as_embedded(coefficients))


def _read_law(path, section, numbers):
    """Section, knots and coefficients of the joints' law in a section."""
    law = _Section(path, f"{section.name}.law", section.member("law", dict))
    return law, *_spline(path, law, joint_law.AXES, (len(numbers),))


def _ribbon_arrays(path, section, ribbon):
    """Nodes of the radius and preload under spin of a ribbon's half; a machined one has none."""
    if not ribbon:
        return {}
    radii, preload = section.numbers("radii"), section.numbers("spin_preload")
    _need(
        len(radii) == 3 and np.all(np.diff(radii) > 0) and radii[0] > 0,
        path,
        "half.radii: three rising radii are needed",
    )
    _need(np.all(preload > 0), path, "half.spin_preload: positive numbers are needed")
    force = section.number("yield_force")
    _need(force > 0.0, path, f"half.yield_force = {force} N: more than 0 is needed")
    return {"radii": radii, "spin_preload": preload, "yield_force": force}


def _read_half(path, section, Z, ribbon):
    """The section of the cage half, its arrays checked for their shapes."""
    more = _ribbon_arrays(path, section, ribbon)
    law, knots, coefficients = _read_law(path, section, joint_law.NUMBERS)
    chi, spin = section.numbers("chi"), section.array("spin", (8,))
    for key in ("m", "J_p", "J_t", "k_open"):
        _need(section.number(key) > 0.0, path, f"half.{key} = {section.number(key)}: more than 0 is needed")
    _need(
        section.number("k_closed") > section.number("k_open"),
        path,
        f"half.k_closed = {section.number('k_closed')}: more than k_open is needed",
    )
    stiffness, slip_stiffness = section.array("stiffness", (Z, 3, 3)), section.array("slip_stiffness", (Z, 2, 2))
    return HalfData(
        **{key: section.number(key) for key in ("m", "x_c", "J_p", "J_t", "k_closed", "k_open")},
        chi=chi,
        **more,
        path=section.array("path", (*([3] if ribbon else []), len(chi), Z, 8, 3)),
        spin=spin,
        land=section.array("land", (Z // 2 + 1, 3, 2, 8)),
        growth=section.array("growth", (2,)),
        law=joint_law.JointLaw(law.number("length"), knots, coefficients, stiffness, slip_stiffness, np.sign(spin[4])),
    )


def _read_modes(path, section, Z, chi, radii):
    """The section of the half's modes, checked; None if it is empty."""
    nodes = (*([len(radii)] if len(radii) else []), len(chi))
    if not section.members:
        return None
    omega = section.numbers("omega")
    _need(
        np.all(np.diff(omega) >= 0.0) and omega[0] > 0.0,
        path,
        "modes.omega: positive numbers that do not decrease are needed",
    )
    harmonic, parity = (section.array(key, omega.shape) for key in ("harmonic", "parity"))
    _need(
        np.all(np.isin(harmonic, np.arange(Z // 2 + 1))),
        path,
        f"modes.harmonic: whole numbers from 0 to {Z // 2} are needed",
    )
    single = np.isin(2 * harmonic, (0, Z))
    _need(
        np.all(np.isin(parity, (-1, 0, 1)) & ((parity == 0) != single)),
        path,
        "modes.parity: 1 or -1 of harmonics 0 and Z/2, 0 of the others is needed",
    )
    at = _Section(path, "modes.residual", section.member("residual", dict))
    both = len(PAD) + len(RIVET)
    residual = Residual(
        pad=at.array("pad", (Z, len(PAD), len(PAD))),
        rivet=at.array("rivet", (Z, len(RIVET), len(PAD))),
        pocket=at.array("pocket", (*nodes, Z, both, 3)),
        spin=at.array("spin", (both,)),
        wall=at.array("wall", nodes),
    )
    unit = np.array([1.0, 1.0, 1.0, 1e3, 1e3, 1e3])  # of moments 1 N.mm
    waves = np.fft.fft(residual.pad, axis=0) / np.outer(unit, unit)
    least = np.linalg.eigvalsh(0.5 * (waves + waves.conj().swapaxes(1, 2))).min()
    _need(least > 0.0, path, f"modes.residual.pad is no flexibility: a load does work {least:g} m/N")
    law, knots, coefficients = _read_law(path, section, joint_law.CARRIED)
    stiffness = law.array("stiffness", (3, 3))
    lengths = np.array([1.0, 1e3, 1e3])  # of rotations 1 mrad
    least = np.linalg.eigvalsh(np.outer(lengths, lengths) * 0.5 * (stiffness + stiffness.T)).min()
    _need(least > 0.0, path, f"modes.law.stiffness is none: a motion takes work of {least:g} N/m")
    energy = law.numbers("energy")
    _need(
        energy.size * len(joint_law.CARRIED) == coefficients.size,
        path,
        f"modes.law: {energy.size} coefficients of the energy; {coefficients.size // len(joint_law.CARRIED)} are needed",
    )
    energy = energy.reshape(coefficients.shape[:-1])
    law = joint_law.LawOfModes(law.number("length"), knots, coefficients, energy, stiffness)
    shapes = {
        "pocket": (*nodes, 3, 2),
        "pad": (len(PAD),),
        "rivet": (len(RIVET),),
        "rim": (2,),
        "land": (3, 2),
        "spin": (),
    }
    arrays = {key: section.array(key, (len(omega), *shape)) for key, shape in shapes.items()}
    return HalfModes(
        Z=Z,
        chi=chi,
        radii=radii,
        omega=omega,
        harmonic=harmonic.astype(int),
        parity=parity.astype(int),
        residual=residual,
        law=law,
        land_residual=section.array("land_residual", (Z // 2 + 1, 3, 2, 3)),
        **arrays,
    )


def _check_joint(path, joint):
    """Stiffnesses and lengths are positive numbers, the hole's stiffness belongs to rising fits."""
    for key in JOINT_KEYS:
        joint.number(key)
    for key in (key for key in JOINT_KEYS if key.startswith("k_")):
        _need(joint.number(key) > 0.0, path, f"joint.{key} = {joint.number(key)}: more than 0 is needed")
    fit, k_hole = joint.numbers("hole_fit"), joint.numbers("k_hole")
    _need(
        len(fit) == len(k_hole) and np.all(np.diff(fit) > 0),
        path,
        "joint.hole_fit does not increase, or has not as many values as joint.k_hole",
    )
    _need(np.all(k_hole > 0.0), path, "joint.k_hole: more than 0 is needed")


def read(path, Z=None):
    """Read and check a table.

    Z: number of rivets that is needed, if given.  Raises ValueError naming file and fault (not JSON, another format, a
    damaged section, a wrong type or size, a number that is not finite, a table for another Z), OSError if it cannot be
    read.
    """
    header, shank, fit, joint, half, modes = _sections(path)
    made_for = header.member("Z", int)
    _need(Z is None or made_for == Z, path, f"made for Z = {made_for} rivets; Z = {Z} is needed")
    kind = header.member("kind", str)
    _need(kind in KINDS, path, f"kind is {kind!r}; one of {', '.join(KINDS)} is needed")
    _check_joint(path, joint)
    fits = {name: fit.numbers(name) for name in ("fit_a", "j2", "slope")}
    _need(
        len({len(values) for values in fits.values()}) == 1, path, "fit_eff: fit_a, j2 and slope have different lengths"
    )
    _need(np.all(np.diff(fits["fit_a"]) > 0), path, "fit_eff.fit_a does not increase")
    geometry, shape = header.member("geometry", dict), header.members.get("shape", SHAPES[0])
    _need(
        shape in SHAPES and geometry.get("shape", SHAPES[0]) == shape,
        path,
        f"header.shape = {shape!r}: one of {', '.join(SHAPES)}, that of the geometry, is needed",
    )
    cage_half = _read_half(path, half, made_for, shape == "ribbon")
    return RivetTable(
        kind=kind,
        geometry=geometry,
        geometry_hash=header.member("geometry_hash", str),
        Z=made_for,
        head_friction=shank.number("head_friction") * MPA_PER_N,
        head_friction_vm=shank.number("head_friction_vm") * MPA_PER_N,
        yield_rivet=shank.number("yield_rivet"),
        fit_flange_yield=fit.number("fit_flange_yield"),
        fit_a=fits["fit_a"],
        fit_eff=fits["j2"],
        fit_slope=fits["slope"],
        joint=joint.members,
        shank=_read_shank(path, shank),
        half=cage_half,
        modes=_read_modes(path, modes, made_for, cage_half.chi, cage_half.radii),
        note=header.member("note", str),
        errors=header.member("errors", dict),
    )
