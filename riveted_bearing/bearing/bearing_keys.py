"""The keys of a bearing's file and of its rivet."""

from typing import Annotated, Any

from pydantic import AfterValidator, Field, create_model

from ..base.schema import Choice, Count, Named, Number, Section, Text, holds
from . import catalogue, materials
from .file_values import rivet_unit, unit_scales
from .rules import RIVET

LARGEST_RIVET = 1.0  # m
RIVET_MATERIAL = ("material", "source", *materials.PARTS["rivet"].properties)
RIVET_SIZES = tuple(name for name in RIVET if name not in materials.PARTS["rivet"].geometry.values())
Metres = Annotated[float | None, Number(unit_scales("m"), above=0.0)]
BALLS = Count(5, "allowed: an integer from 5 to 32", 32)  # that an FMU can have
Newtons = Annotated[float | None, Number(unit_scales("N"), above=0.0)]


SMALL = holds(lambda size: size <= LARGEST_RIVET, f"at most {LARGEST_RIVET:g} m is allowed", AfterValidator)


def dimension(name: str) -> Any:
    """The type of a rivet's dimension or constant."""
    number = Number(unit_scales(rivet_unit(name)), above=0.0)
    return Annotated[float | None, number, SMALL] if rivet_unit(name) == "m" else Annotated[float | None, number]


class Catalogue(Section):
    """What a maker's catalogue gives, [catalogue]."""

    bore: Metres = None
    outside_diameter: Metres = None
    width: Metres = None
    C: Newtons = None
    C_0: Newtons = None
    C_u: Newtons = None
    minimum_load: Newtons = None
    clearance: Annotated[str | None, Choice(tuple(catalogue.CLEARANCE))] = Field(
        None, description="class, in the place of bearing.P_d"
    )


RIVET_FIELDS: dict[str, Any] = {
    **{name: (dimension(name), Field(None)) for name in RIVET_SIZES},
    "head": (Any, Field(None, description="head diameter and height by a standard, such as DIN 660")),
    **{name: (Any, Field(None)) for name in RIVET_MATERIAL},
}
RivetFile: Any = create_model("RivetFile", __base__=Section, **RIVET_FIELDS)
RivetFile.__doc__ = (
    "A rivet, [rivet] of a bearing's file: dimensions by the names of rivet_model.geometry, and its steel."
)


class BearingFile(Section):
    """A bearing: what is left out comes from the catalogue if it knows the designation, else by rule."""

    designation: Any = Field(None, description="one of the catalogue's fills in what is not given")
    description: Text = ""
    Z: Annotated[int | None, BALLS] = Field(None, description="balls, 5 to 32")
    oil: Any = Field(None, description='kind of oil, such as "mineral ISO VG 32"')
    catalogue: Catalogue = Catalogue()
    parameters: Named = Field({}, description="start values of the FMU made from this file; inputs too")
    inputs: Named = {}
    cage: Named = Field({}, description="material by name or as a table, single properties; so are rings and balls")
    rings: Named = {}
    balls: Named = {}
    rivet: Named = Field({}, description="its keys as schema rivet")
    between: Named = Field({}, description="[lowest, highest] of a given value by name, as the drawing allows")
