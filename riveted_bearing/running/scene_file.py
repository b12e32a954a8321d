"""The file of a scene: its tables and keys."""

from typing import Annotated, Any

from pydantic import ConfigDict, Field

from ..base.schema import Named, Number, Section, Text, holds, is_list_of
from ..base.units import SECONDS

Seconds = Annotated[float | None, Number(SECONDS, above=0.0)]


PATTERNS = holds(lambda value: is_list_of(value, str), 'not a list of names such as ["ring.*", "rivet[*].sigma_head"]')


class Simulation(Section):
    """How long and how finely, [simulation]."""

    t_end: Seconds = Field(None, description="default: 0.4 s")
    step: Seconds = Field(None, description="communication step; default: 0.1 ms")
    output_interval: Seconds = Field(
        None, description="a multiple of step; *_peak channels keep the largest value in between; default: step"
    )
    accuracy: Annotated[float | None, Number({"1": (1.0, 0.0), "%": (100.0, 0.0)}, above=0.0, below=0.5)] = Field(
        None, description="of mean and 99.9 % stress and RMS pocket force: `run` and `life` choose steps and seeds"
    )
    tolerance: Annotated[float | None, Number(above=0.0)] = Field(None, description="default: solver.tol")
    outputs: Annotated[list[str], PATTERNS] = Field([], description="names or patterns; default: all")


class Profile(Section):
    """Measured profile of a race over one turn, as waves of the orders 1 to 60."""

    file: Annotated[str, Field(strict=True)]
    angle: Annotated[str, Field(strict=True)] = Field(description="its column")
    height: Annotated[str, Field(strict=True)] = Field(description="its column")
    angle_unit: Annotated[str, Field(strict=True)] = ""
    unit: Annotated[str, Field(strict=True)] = Field("", description="of the height")


class Surfaces(Section):
    """Measured profiles, [surfaces]."""

    outer: Profile | None = None
    inner: Profile | None = None


class Change(Section):
    """Tunable parameters that change in the run, [[change]]: their names stand beside at."""

    model_config = ConfigDict(extra="allow")

    at: Annotated[float, Number(SECONDS)] = Field(description="the time, from the next communication point on")


class SceneFile(Section):
    """A scene: what to simulate.  A number is SI, a text carries its unit; where oil.T is set, parts whose temperature
    nobody gives have the oil's.
    """

    description: Text = ""
    oil: Any = Field(None, description='kind of oil, such as "mineral ISO VG 32"')
    simulation: Simulation = Simulation()
    parameters: Named = Field({}, description="at the start; dotted keys, nested tables or quoted full names")
    inputs: Named = Field(
        {},
        description="constant, { t, value, unit, interpolation = hold } or { file, column, time, unit, interpolation, "
        "longest_gap }; held over each communication step",
    )
    surfaces: Surfaces = Surfaces()
    change: list[Change] = []
