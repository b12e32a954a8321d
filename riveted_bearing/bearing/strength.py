"""Strength of the rivets' steel as users have it: S-N curves from a file, scatter and survival, surface and size.

pylife holds curves, rules, scatter and the guideline's constants.
"""

import math
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any

import numpy as np
from pydantic import AfterValidator, Field

from bearing_model.generated.variables import PARAMETERS, MeanStress
from bearing_model.instance.fatigue import FatigueLaw

from ..base.errors import UserError, library, refusal
from ..base.schema import PLAIN, Choice, Number, Section, checked, holds
from ..base.tables import Table, Wanted
from ..base.toml_files import read_toml

PASCAL = {"Pa": (1.0, 0.0), "MPa": (1e-6, 0.0)}
METRE = {"m": (1.0, 0.0), "um": (1e6, 0.0)}
CURVE = ("sigma_D", "N_D", "k_1", "k_2", "sigma_m", "sigma_f")
LEAST = 1e6  # Pa; no steel is weaker: a smaller strength is one in MPa without its unit
LEAST_ALLOWED = "from 1e6 Pa (1 MPa) on is allowed"
RULES = ("knee", "haibach", "elementary", "original")
FKM_STEEL = "Steel"
OF_PAPER = "that of 15CrMn"


IN_PASCAL = f'{LEAST_ALLOWED}; a number without a unit is in Pa, "250 MPa" has its unit'
STRONG = holds(lambda stress: stress >= LEAST, IN_PASCAL, AfterValidator)
Stress = Annotated[float | None, Number(PASCAL, above=0.0), STRONG]
Positive = Annotated[float | None, Number(above=0.0)]


class StrengthFile(Section):
    """Curve of strength of the rivets' steel, [sn] of a mission or its file; the rest is the run's fatigue.*."""

    file: Annotated[str | None, Field(strict=True)] = Field(
        None, description="these keys in a file, or a table with the columns amplitude [Pa, or unit] and cycles"
    )
    unit: Annotated[str, Choice(("", *PASCAL))] = Field("", description="of the table's amplitudes")
    rule: Annotated[str, Choice(RULES)] = Field(
        "knee", description="haibach: k_2 = 2 k_1 - 1; elementary: k_2 = k_1; original: no damage below the knee"
    )
    mean_stress: Annotated[str | None, Choice(tuple(name.lower() for name in MeanStress.__members__))] = Field(
        None, description="its correction, with sigma_m or sigma_f"
    )
    sigma_D: Stress = Field(None, description="amplitude at the knee, R = -1")
    N_D: Positive = Field(None, description="cycles at the knee")
    k_1: Positive = Field(None, description="slope above the knee")
    k_2: Positive = Field(None, description="slope below")
    sigma_m: Stress = None
    sigma_f: Stress = None
    T_S: Annotated[float | None, Number(least=1.0)] = Field(
        None, description="scatter: strength of 90 % over strength of 10 %"
    )
    T_N: Annotated[float | None, Number(least=1.0)] = Field(None, description="or that of the cycles")
    survival: Annotated[float, Number(above=0.0, below=1.0)] = Field(
        0.5, description="the curve that this share survives; the curve as given holds for 0.5"
    )
    R_z: Annotated[float | None, Number(METRE, above=0.0)] = Field(
        None, description="roughness: factor of the FKM guideline"
    )
    A_90: Positive = Field(None, description="mm2 at 90 % of the largest stress or more: statistical size factor")
    A_90_specimen: Positive = Field(None, description="mm2, of the specimens of the curve; default: 500")


@dataclass(frozen=True)
class Strength:
    """law: before scatter and factors; rule: below the knee; T_S: scatter; survival; factor: by surface and size; table:
    (amplitude [Pa], cycles) or None; given: parameters that the section gives; rough: whether sigma_m made the factor.
    """

    law: FatigueLaw
    rule: str = "knee"
    T_S: float = 1.0
    survival: float = 0.5
    factor: float = 1.0
    table: tuple | None = None
    given: frozenset = frozenset()
    rough: bool = False


def read_strength(path: Path, section: Any, law: Any) -> Strength:
    """The Strength of a section [sn], over the FatigueLaw `law`; UserError naming key and value."""
    where = f"{path}: sn"
    section, table = with_file(path, where, dict(section))
    file = checked(StrengthFile, section, where)
    mean_stress = MeanStress(law.mean_stress) if file.mean_stress is None else MeanStress[file.mean_stress.upper()]
    own = {key: getattr(file, key) for key in CURVE if getattr(file, key) is not None}
    law = FatigueLaw(**vars(law) | own | {"mean_stress": int(mean_stress)})
    if file.T_S is not None and file.T_N is not None:
        raise UserError(f"{where}: T_S and T_N: one follows from the other, so give one of them")
    T_S = file.T_S or (file.T_N or 1.0) ** (1.0 / law.k_1)
    factor = surface_factor(file, law.sigma_m) * size_factor(file)
    given = frozenset(f"fatigue.{key}" for key in own)
    return Strength(law, file.rule, T_S, file.survival, factor, table, given, file.R_z is not None)


def in_words(strength: Strength) -> str:
    """The S-N curve with its rule, mean-stress correction, scatter and factors."""
    law = strength.law
    if strength.table is None:
        slopes = f"slope {law.k_1:g} above it, {below(strength)}"
        curve = f"amplitude {1e-6 * law.sigma_D:.4g} MPa (R = -1) at {law.N_D:.3g} cycles, {slopes}"
    else:
        amplitude, cycles = strength.table
        curve = f"table of {len(cycles)} amplitudes from {1e-6 * amplitude[0]:.4g} to {1e-6 * amplitude[-1]:.4g} MPa"
    mean = MeanStress(law.mean_stress).name.lower()
    limit = {
        "goodman": f", sigma_m {1e-6 * law.sigma_m:.4g} MPa",
        "morrow": f", sigma_f {1e-6 * law.sigma_f:.4g} MPa",
    }.get(mean, "")
    scatter = f", T_S {strength.T_S:.3g}, survival {100 * strength.survival:.4g} %" if strength.T_S > 1.0 else ""
    factor = f", factor of surface and size {strength.factor:.3g}" if strength.factor != 1.0 else ""
    return f"{curve}; mean stress: {mean}{limit}{scatter}{factor}"


def below(strength):
    """The S-N curve below its knee in words."""
    law = strength.law
    slopes = {"knee": law.k_2, "haibach": 2.0 * law.k_1 - 1.0, "elementary": law.k_1}
    return "no damage below" if strength.rule == "original" else f"{slopes[strength.rule]:g} below"


def assumed(strength: Strength, given: Any = ()) -> str:
    """What of an S-N curve nobody gave (given: parameters of scene and file), to stand behind its words, "" for nothing."""
    law, mean = strength.law, MeanStress(strength.law.mean_stress)
    used = {  # name: whether it makes a difference
        "sigma_D": strength.table is None,
        "N_D": strength.table is None,
        "k_1": strength.table is None,
        "k_2": strength.table is None and strength.rule == "knee",
        "sigma_m": mean == MeanStress.GOODMAN or strength.rough,
        "sigma_f": mean == MeanStress.MORROW,
    }
    names = [name for name, matters in used.items() if matters]
    missing = [name for name in names if f"fatigue.{name}" not in strength.given | set(given)]
    of_paper = [name for name in missing if getattr(law, name) == PARAMETERS[f"fatigue.{name}"].start]
    by_rule = [name for name in missing if name not in of_paper]
    if of_paper and of_paper == names:
        return f"; assumed, {OF_PAPER}"
    return "".join(
        f"; {', '.join(found)} {why}"
        for found, why in ((of_paper, f"assumed, {OF_PAPER}"), (by_rule, "by rule from the strength"))
        if found
    )


def with_file(path, where, section):
    """The section with the keys of its file below its own, and the table of the file if it is one."""
    name = section.pop("file", None)
    unit = section.get("unit", "")
    if unit not in ("", *PASCAL):
        raise refusal(where, "unit", unit, f"allowed: {', '.join(PASCAL)}")
    if name is None:
        return section, None
    if not isinstance(name, str):
        raise refusal(where, "file", name, "a file's name is needed")
    file = Path(path).parent / name
    if not file.is_file():
        raise UserError(f"{where}: file: {file}: no such file")
    if file.suffix == ".toml":
        return read_toml(file) | section, None
    table, wanted = Table(file), Wanted("amplitude", PASCAL, unit)
    amplitude, cycles = table.columns(wanted, Wanted("cycles", PLAIN))
    order = np.argsort(amplitude)
    amplitude, cycles = amplitude[order], cycles[order]
    if (
        len(amplitude) < 2
        or amplitude[0] <= 0.0
        or cycles.min() <= 0.0
        or np.any(np.diff(amplitude) <= 0.0)
        or np.any(np.diff(cycles) > 0.0)
    ):
        raise UserError(
            f"{file}: at least two positive amplitudes are needed, all different, with cycles that fall while the amplitude grows"
        )
    if amplitude[0] < LEAST:
        raise UserError(
            f"{where}: {file}: amplitude = {amplitude[0]:g} Pa: {LEAST_ALLOWED}; the column is read in {table.unit(wanted) or 'Pa'}: "
            'its unit stands in its head, or in [sn], as in unit = "MPa"'
        )
    return section, (amplitude, cycles)


def fkm():
    """The FKM guideline's constants for steel, and its support factor, from pylife."""
    functions = library("pylife.strength.fkm_linear.fkm_functions", "sn").FkmLinearFunctions()
    return functions, functions.get_material_constants(FKM_STEEL, "normal")[0]


def surface_factor(file, sigma_m):
    """K_R = 1 - a_R lg(R_z/um) lg(2 R_m/R_m_N_min), 1 for smooth surfaces.  FKM guideline (2012), 4.3.1.4."""
    if file.R_z is None:
        return 1.0
    _, steel = fkm()
    return 1.0 - steel["aR_s"] * math.log10(max(1e6 * file.R_z, 1.0)) * math.log10(
        max(2e-6 * sigma_m / steel["RmNmin"], 1.0)
    )


def size_factor(file):
    """n_st = (A_90_specimen/A_90)^(1/k_st), of the weakest place.  FKM guideline (2012), 4.3.1.3.2."""
    if file.A_90 is None:
        return 1.0
    functions, steel = fkm()
    specimen = file.A_90_specimen or functions.A90_0
    return float(
        functions.stat_support_surf(file.A_90, steel["k_st"]) / functions.stat_support_surf(specimen, steel["k_st"])
    )


def curve(strength):
    """pylife's S-N curve of a Strength: rule, survival and factors applied."""
    law = strength.law
    values = {"SD": law.sigma_D * strength.factor, "ND": law.N_D, "k_1": law.k_1, "k_2": law.k_2, "TS": strength.T_S}
    plain = library("pylife.materiallaws", "sn").WoehlerCurve(library("pandas", "sn").Series(values))
    if strength.rule != "knee":
        plain = getattr(plain, f"miner_{strength.rule}")()
    return plain.transform_to_failure_probability(1.0 - strength.survival)


def cycles_to_failure(strength, amplitude):
    """Cycles that each amplitude [Pa] at no mean stress is borne; a table is straight in logarithms."""
    if strength.table is None:
        return curve(strength).cycles(amplitude)
    from scipy.interpolate import make_interp_spline

    knots, cycles = strength.table
    stronger = strength.factor * 10.0 ** (quantile(strength) * math.log10(strength.T_S) / 2.5631)
    return np.exp(make_interp_spline(np.log(knots * stronger), np.log(cycles), k=1)(np.log(amplitude)))


def quantile(strength):
    """Standard deviations by which the curve of the survival asked for lies above that of 50 %."""
    from scipy.stats import norm

    return float(norm.ppf(1.0 - strength.survival))


@np.errstate(over="ignore")
def reversed_amplitudes(law: Any, span: Any, mean: Any) -> np.ndarray:
    """fully_reversed() of many cycles: amplitudes at zero mean stress of arrays of ranges and means [Pa]."""
    half, mean = 0.5 * np.asarray(span, float), np.asarray(mean, float)
    if law.mean_stress == MeanStress.SWT:
        return np.sqrt(np.maximum(mean + half, 0.0) * half)
    room = {
        MeanStress.GOODMAN: 1.0 - np.maximum(mean, 0.0) / law.sigma_m,
        MeanStress.MORROW: 1.0 - mean / law.sigma_f,
    }.get(law.mean_stress, np.ones_like(half))
    return np.where(room > 0.0, half / np.where(room > 0.0, room, 1.0), np.inf)


def damage_of_cycles(strength: Strength, span: Any, mean: Any, count: Any) -> Any:
    """Miner's sum of the cycles of each range and mean [Pa]; a cycle breaks a part at most once."""
    amplitude = reversed_amplitudes(strength.law, span, mean)
    damage = np.where(np.isinf(amplitude), 1.0, 0.0)
    counts = np.isfinite(amplitude) & (amplitude > 0.0)
    damage[counts] = np.minimum(1.0 / cycles_to_failure(strength, amplitude[counts]), 1.0)
    return damage * count


def damage_of_matrix(strength: Strength, matrix: Any, channels: Any) -> Any:
    """Miner's sum of each channel of a run's rainflow matrix."""
    channel, *cycles = matrix
    if not len(channel):
        return np.zeros(channels)
    return np.bincount(channel, damage_of_cycles(strength, *cycles), minlength=channels)
