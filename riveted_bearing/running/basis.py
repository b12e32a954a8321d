"""What figures rest on: bearing, FMU, scene, loads, speed, oil, temperatures, S-N curve, in lines for all outputs."""

import itertools
from typing import Any

import numpy as np

from ..base.errors import naming, shortlist
from ..base.units import rounded
from ..bearing import oil as oils
from ..bearing.plausible import fast
from . import preload as preloads
from .fmu import Model
from .inputs import History
from .scene import in_words

LOADS = (
    *(f"shaft.{name}" for name in ("F_x", "F_y", "F_z", "M_y", "M_z", "tilt_y", "tilt_z")),
    *("impact.F_r", "impact.F_a", "pulse.F_r", "pulse.F_a"),
)
SPEEDS = ("shaft.omega", "housing.omega", "frame.omega")
LIQUID = (3e-4, 3.0)  # Pa.s: kerosene hot, ISO VG 460 near its pour point
PARTS = {"inner ring": "ring.T_i", "outer ring": "ring.T_e", "balls": "ball.T", "cage": "cage.T"}


def basis(model: Model, scenes: Any, curve: str = "") -> Any:
    """Name and text of each line: values that differ as their range; curve: the S-N curve in words."""
    scenes = list(scenes)
    names = dict.fromkeys(s.name if s.source else "none: the FMU's own parameters and inputs" for s in scenes)
    replaced = dict.fromkeys(text for scene in scenes for text in scene.replaced)
    lines = {
        "bearing": model.bearing,
        "FMU": f"{model.path}, SHA-256 {model.digest[:12]}",
        "scene": ", ".join(names),
        "replaced": f"the scene has {shortlist(replaced)}" if replaced else "",
        "loads": loads(model, scenes),
        "speed": speeds(model, scenes),
        "not reached": "; ".join(dict.fromkeys(text for scene in scenes for text in scene.outside())),
        "oil": oil(model, scenes),
        "temperatures": temperatures(model, scenes),
        "preload": preload(model, scenes),
        "S-N curve": curve,
        "damage": accelerated(model, scenes),
    }
    return [(name, text) for name, text in lines.items() if text]


def accelerated(model, scenes):
    """Words on damage that is not counted as it is, "" where it is."""
    name = "fatigue.acceleration"
    if name not in model.parameters or np.all(values(model, scenes, name) == 1.0):
        return ""
    return f"accelerated {text(model, scenes, name)} times ({name})"


def values(model, scenes, name):
    """All values that a parameter or an input has in the runs of the scenes, SI."""
    own = model.default((model.parameters | model.inputs)[name])
    given = ((scene.parameters | scene.inputs).get(name, own) for scene in scenes)
    pairs = zip(scenes, given, strict=True)
    return np.concatenate([v.reached(s.t_end) if isinstance(v, History) else np.atleast_1d(v) for s, v in pairs])


def text(model, scenes, name):
    """The range of a variable in the unit that all scenes were written in, else in the one in which people read it."""
    symbols = {scene.units.get(name) for scene in scenes}
    return in_words(model, name, values(model, scenes, name), symbols.pop() if len(symbols) == 1 else None)


def loads(model: Model, scenes: Any) -> Any:
    """Loads, tilts and impacts that are not zero; none where all scenes prescribe the motion of the inner ring."""
    if set(values(model, scenes, "ring.motion")) == {"prescribed"}:
        return "none: the motion of the inner ring is prescribed"
    acting = [name for name in LOADS if np.any(values(model, scenes, name))]
    return ", ".join(f"{name.removeprefix('shaft.')} {text(model, scenes, name)}" for name in acting) or "none"


def speeds(model: Model, scenes: Any) -> Any:
    """Speed of the inner ring, and those of the outer ring and the frame unless they are zero."""
    first, *others = SPEEDS
    turning = (f"{name} {text(model, scenes, name)}" for name in others if np.any(values(model, scenes, name)))
    return ", ".join([text(model, scenes, first), *turning])


def fast_speeds(model: Model, scenes: Any) -> tuple[str, ...]:
    """A sentence on the largest speed of the scenes if few ball bearings reach it."""
    extreme = [
        abs(one - other)
        for scene in scenes
        for one in extremes(values(model, [scene], "shaft.omega"))
        for other in extremes(values(model, [scene], "housing.omega"))
    ]
    return tuple(fast(max(extreme, default=0.0), model.default(model.parameters["bearing.d_m"])))


def oil(model, scenes):
    """Viscosity of the oil at its temperature, and a point of it that nobody gave beside one that is given."""
    found = {viscosity(model, scene, T) for scene in scenes for T in extremes(values(model, [scene], "oil.T"))}
    alone = dict.fromkeys(text for scene in scenes for text in point_assumed(model, scene))
    names = ", ".join(dict.fromkeys(filter(None, (scene.oil or oils.name_of(model.origin) for scene in scenes))))
    words = f"{in_words(model, 'oil.eta', [rounded(eta, 3) for eta in found])} at {text(model, scenes, 'oil.T')}"
    if not LIQUID[0] <= min(found) <= max(found) <= LIQUID[1]:
        words += f" (few oils in bearings have less than {1e3 * LIQUID[0]:g} or more than {1e3 * LIQUID[1]:g} mPa.s)"
    return "; ".join([f"{names}, {words}" if names else words, *alone])


def point_assumed(model, scene):
    """The point of the oil that stands beside a given one, in words."""
    given = {*scene.parameters, *(name for name, origin in model.origin.items() if origin == "yours")}
    for name, other in (oils.POINTS, oils.POINTS[::-1]):
        if name in given and other not in given:
            at = text(model, [scene], other.replace("nu", "T"))
            yield f"{other} {text(model, [scene], other)} at {at} is assumed"


def extremes(numbers):
    """Smallest and largest number."""
    return numbers.min(), numbers.max()


def viscosity(model, scene, T):
    """Viscosity of a scene's oil [Pa.s] at T [K]; UserError if its two points make no oil."""
    start = {name: model.default(v) for name, v in model.parameters.items() if name.startswith("oil.")}
    with naming(f"{scene.source or model.path}: oil.nu_1, oil.nu_2"):
        return oils.viscosity(start | {name: scene.parameters.get(name, v) for name, v in start.items()}, start, T)


def preload(model, scenes):
    """Preload of the rivets as given and at the cage's temperature."""
    names, pairs = (preloads.PRELOAD, preloads.TEMPERATURE), {}
    for scene in scenes:
        pairs |= dict.fromkeys(itertools.product(*(extremes(values(model, [scene], name)) for name in names)))
    words = (lambda numbers, name=name: in_words(model, name, numbers) for name in names)
    return preloads.in_words(preloads.of_fmu(model), list(pairs), *words)


def temperatures(model, scenes):
    """Temperatures of the parts; equal ones once."""
    found = {part: text(model, scenes, name) for part, name in PARTS.items()}
    if len(set(found.values())) == 1:
        return f"{', '.join(PARTS)} {found['cage']}"
    return ", ".join(f"{part} {value}" for part, value in found.items())
