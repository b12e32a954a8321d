"""The file of a mission: its tables and keys."""

from typing import Annotated, Any

from pydantic import BeforeValidator, ConfigDict, Field

from ..base.schema import Choice, Count, Named, Number, Section, Text, Truth
from ..studies.sweep_file import Settings
from .raceways import cleanliness_of

HOURS = {"h": (1.0, 0.0), "min": (60.0, 0.0), "s": (3600.0, 0.0)}
SHARES = {"1": (1.0, 0.0), "%": (100.0, 0.0)}
FEWEST = 3  # seeds
RIVETS = ("each", "alike")
Hours = Annotated[float, Number(HOURS, least=0.0)]
Share = Annotated[float, Number(SHARES, least=0.0)]


class Block(Section):
    """What an operating point and an event have in common."""

    name: Text | None = Field(None, description="default: its number")
    preload_factor: Share = Field(1.0, description="of joint.preload")
    scene: Any = Field(None, description="another scene than the mission's")
    simulation: Named = Field({}, description="as in a scene file, over the mission's; so are the two below")
    parameters: Named = {}
    inputs: Named = {}


class Point(Block):
    """An operating point, [[point]]."""

    hours: Hours | None = Field(None, description="in a pass of the mission; or in every point")
    share: Share | None = Field(None, description="of the whole time")
    interpolate: Truth = Field(False, description="not simulated: from the points around it")


class Event(Block):
    """An event such as a shock or a landing, [[event]]; the damage of its run after start.settle counts."""

    count: Annotated[float, Number(least=0.0)] = Field(description="how often it happens in one pass of the mission")
    after_settle: Truth = Field(False, description="whether the times of its inputs count from start.settle")


class Change(Section):
    """Tunable parameters that change at a time of the points, in every pass, [[change]]: their names stand beside at."""

    model_config = ConfigDict(extra="allow")

    at: Hours = Field(description="the time at which its parameters change")


class Columns(Section):
    """Columns of a file by variable: { column = "n", unit = "rev/min" }, of a record also bins."""

    file: Annotated[str, Field(strict=True)] = Field(description="CSV, Parquet or Excel, beside the mission's")
    inputs: Named = {}
    parameters: Named = {}


class Table(Columns):
    """Further points from a table, [table]."""

    hours: Annotated[str, Field(strict=True)] = Field(description="its column")


class History(Columns):
    """Further points from a measured record, binned, [history]."""

    time: Annotated[str, Field(strict=True)] = Field(description="its column")
    hours: Hours | None = Field(None, description="what the record stands for; default: its own length")
    longest_gap: Hours | None = Field(None, description="between samples; default: ten usual intervals")


class Loss(Section):
    """Loss of preload, [preload_loss]: straight lines between, constant after the last hour."""

    hours: list[Hours] = Field(description="from 0 on")
    factor: list[Share] = Field(description="of joint.preload")


class Life(Section):
    """How sure the life is to be, [life]."""

    confidence: Annotated[float, Number(SHARES, least=0.5, below=1.0)] = Field(0.9, description="of the interval")
    half_width: Annotated[float, Number(SHARES, least=1e-3, below=100.0)] = Field(
        0.25, description="of life: simulate until the interval is at most life/1.25 ... 1.25 life wide"
    )
    min_seeds: Annotated[int, Count()] = 6
    max_seeds: Annotated[int, Count(FEWEST, f"at least {FEWEST} is allowed: fewer show no scatter")] = 32
    seed: Annotated[int, Count()] = Field(1, description="first start.seed, common to all points")
    skip: Annotated[float, Number(SHARES, least=0.0, below=0.5)] = Field(
        0.01, description="share of the damage that rare points may have and yet be left out by a bound"
    )
    rivets: Annotated[str, Choice(RIVETS)] = Field(
        "each", description="alike: every rivet takes every place in turn, so that rates are means over the rivets"
    )
    cleanliness: Annotated[Any, BeforeValidator(cleanliness_of)] = Field(
        None, description="of the oil, for the raceways' life; default: normal, assumed"
    )


class Tolerance(Section):
    """Bearings that are drawn from tolerances, [tolerance]."""

    bearings: Annotated[int, Count(3, "from 3, which show scatter")] = Field(30, description="how many are drawn")
    seeds: Annotated[int, Count()] = Field(2, description="runs of each bearing at each point")
    share: Annotated[float, Number(SHARES, above=0.0, most=1.0)] = Field(
        0.95, description="simulate the points and events that have this share of the damage"
    )
    parameters: Named = Field({}, description='{ distribution = "normal", mean = "20 N", sd = "2 N" } by name')


class MissionFile(Settings):
    """A mission: operating points with their hours and events with their counts."""

    point: list[Point] = []
    event: list[Event] = []
    change: list[Change] = []
    table: Table | None = None
    history: History | None = None
    preload_loss: Loss | None = None
    life: Life = Life()
    sn: Named = Field({}, description="curve of strength of the rivets' steel, as schema sn; default: the FMU's law")
    tolerance: Tolerance | None = None
