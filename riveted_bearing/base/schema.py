"""Files by schema: models of pydantic say which keys a file has, and one function says what is wrong with a document.

    class Sample(Section):
        count: Annotated[int, Count(1)] = Field(description="points")
        step: Annotated[float, Number(SECONDS, above=0.0)] = 1e-4

    sample = checked(Sample, document, "sweep.toml")   # or UserError: sweep.toml: step = 0: must be greater than 0

A number is SI in the model, a number or a text with its unit in the file.
"""

import types
from collections.abc import Callable
from dataclasses import dataclass
from operator import ge, gt, le, lt
from typing import Annotated, Any, TypeVar, get_args

from pydantic import BaseModel, BeforeValidator, ConfigDict, StrictBool, ValidationError
from pydantic_core import core_schema

from .errors import UserError, refusal, unknown
from .units import to_si

PLAIN = {"1": (1.0, 0.0)}
S = TypeVar("S", bound="Section")


class Section(BaseModel):
    """A table of a file, whose keys are the fields; names of variables stand in dicts."""

    model_config = ConfigDict(extra="forbid", frozen=True, arbitrary_types_allowed=True)


class Rule:
    """Part of a field's annotation: read(value) returns what a value in the file stands for, or raises UserError."""

    def __get_pydantic_core_schema__(self, source: Any, handler: Any) -> core_schema.CoreSchema:
        return core_schema.no_info_plain_validator_function(self.read)  # type: ignore[attr-defined]


@dataclass(frozen=True, eq=False)
class Number(Rule):
    """A number within limits, in the file also with one of the units of `scales`; words: what is allowed, if not the limits."""

    scales: Any = None
    least: float | None = None
    above: float | None = None
    most: float | None = None
    below: float | None = None
    words: str = ""

    def read(self, value: Any) -> float:
        """The SI value; UserError for one that is not allowed."""
        number = to_si(value, self.scales or PLAIN)
        limits = (ge, self.least), (gt, self.above), (le, self.most), (lt, self.below)
        if not all(limit is None or holds(number, limit) for holds, limit in limits):
            raise UserError(self.words or self.limits())
        return number

    def limits(self) -> str:
        """The limits in words."""
        if self.most is None and self.below is None:
            if self.above == 0.0:
                return "must be greater than 0"
            return "must not be negative" if self.least == 0.0 else f"from {self.least:g} on is allowed"
        high = f"below {self.below:g}" if self.most is None else f"up to {self.most:g}"
        if self.above is not None:
            return f"above {self.above:g} and {high} is allowed"
        return f"from {self.least or 0.0:g} {'to ' if self.most is None else ''}{high} is allowed"

    def __get_pydantic_json_schema__(self, schema: Any, handler: Any) -> dict[str, Any]:
        limits = {"minimum": self.least, "exclusiveMinimum": self.above}
        limits |= {"maximum": self.most, "exclusiveMaximum": self.below}
        units = [symbol for symbol in self.scales or () if symbol != "1"]
        found: dict[str, Any] = {"type": ["number", "string"] if units else "number"}
        found |= {key: limit for key, limit in limits.items() if limit is not None}
        return found | ({"examples": [f"1 {symbol}" for symbol in units]} if units else {})


@dataclass(frozen=True, eq=False)
class Count(Rule):
    """A whole number of at least `least`, and at most `most` if that is given; words: what is needed."""

    least: int = 1
    words: str = ""
    most: int | None = None

    def read(self, value: Any) -> int:
        """The number; UserError for anything else."""
        whole = isinstance(value, int) and not isinstance(value, bool)
        if not whole or value < self.least or (self.most is not None and value > self.most):
            raise UserError(self.words or f"a whole number from {self.least} on is needed")
        return value

    def __get_pydantic_json_schema__(self, schema: Any, handler: Any) -> dict[str, Any]:
        return {"type": "integer", "minimum": self.least} | ({} if self.most is None else {"maximum": self.most})


@dataclass(frozen=True, eq=False)
class Choice(Rule):
    """One of some texts."""

    names: tuple[str, ...]

    def read(self, value: Any) -> str:
        """The text; UserError naming all."""
        if not isinstance(value, str) or value not in self.names:
            raise UserError(f"allowed: {', '.join(self.names)}")
        return value

    def __get_pydantic_json_schema__(self, schema: Any, handler: Any) -> dict[str, Any]:
        return {"type": "string", "enum": [*self.names]}


def holds(test: Callable[[Any], Any], words: str, when: Any = BeforeValidator) -> Any:
    """Part of a field's annotation: a value that fails the test is refused in these words; when: AfterValidator for a test
    of what the annotation has read.
    """

    def tested(value: Any) -> Any:
        if not test(value):
            raise UserError(words)
        return value

    return when(tested)


def is_list_of(value: Any, kind: type) -> bool:
    """Whether a value of a file is a list whose entries are all of a kind; a truth value is no number."""
    return isinstance(value, list) and all(isinstance(x, kind) and not isinstance(x, bool) for x in value)


Text = Annotated[str, BeforeValidator(str)]  # anything, as a text
Texts = Annotated[list[str], holds(lambda value: is_list_of(value, str) and value, "a list of texts is needed")]
Truth = StrictBool
Named = dict[str, Any]  # variables of the FMU by name, which only the FMU can check
WORDS = {
    "bool_type": "allowed: true, false",
    "string_type": "a text is needed",
    "list_type": "a list is needed",
    "dict_type": "not a table",
    "model_type": "not a table",
}


def checked(kind: type[S], document: Any, path: Any, where: str = "") -> S:
    """A document as a section, `where` in the file ("" for all of it); UserError naming file, key, value and what is allowed."""
    try:
        return kind.model_validate(document)
    except ValidationError as problem:
        faults = problem.errors(include_url=False)
        first = min(faults, key=lambda fault: {"extra_forbidden": 0, "missing": 2}.get(fault["type"], 1))
        raise fault_text(kind, document, path, where, first) from None


def fault_text(kind: type[Section], document: Any, path: Any, where: str, fault: Any) -> UserError:
    """The UserError of a fault that pydantic found: an entry of a list of tables is named by its key `name` or number."""
    *above, key = fault["loc"] or ("",)
    place, prefix, table = f"{path}", where, document
    for i, step in enumerate(above):
        table = table[step]
        if isinstance(step, int) and isinstance(table, dict):
            place, prefix = f"{path}: {above[i - 1]} {table.get('name', step + 1)}", ""
        elif not (i + 1 < len(above) and isinstance(above[i + 1], int)):
            prefix = f"{prefix}.{step}".lstrip(".")
    full = prefix if isinstance(key, int) else f"{prefix}.{key}".lstrip(".")  # an entry of a list is the list's
    if fault["type"] == "extra_forbidden":
        return unknown(place, "key", key, [*fields_at(kind, above)], f"{prefix}." if prefix else "")
    if fault["type"] == "missing":
        about = fields_at(kind, above)[key].description
        return UserError(f"{place}: {full} is needed{f': {about}' if about else ''}")
    if isinstance(key, int) and fault["type"] in ("model_type", "dict_type"):  # not a list of tables
        return UserError(f"{place}: {above[-1]}: write [[{above[-1]}]] with its keys below it")
    if fault["type"] == "list_type":
        annotation = fields_at(kind, above)[key].annotation
        if model_of(annotation) or Named in get_args(annotation):  # of tables
            return UserError(f"{place}: {full}: write [[{full}]] with its keys below it")
    error = fault.get("ctx", {}).get("error")
    return refusal(place, full, fault["input"], error or WORDS.get(fault["type"], fault["msg"]))


def model_of(annotation: Any) -> type[Section] | None:
    """The section that an annotation is of, be it in a list or optional."""
    if isinstance(annotation, type) and not isinstance(annotation, types.GenericAlias):
        return annotation if issubclass(annotation, Section) else None
    return next(filter(None, map(model_of, get_args(annotation))), None)


def fields_at(kind: type[Section], place: list[Any]) -> Any:
    """The fields of a table at a place of a document."""
    for step in place:
        if isinstance(step, str):
            kind = model_of(kind.model_fields[step].annotation) or kind
    return kind.model_fields


def json_schema(kind: type[Section]) -> dict[str, Any]:
    """JSON Schema of a file, without titles that repeat the keys and without null, which TOML does not have."""

    def plain(node: Any) -> Any:
        if isinstance(node, list):
            return [plain(entry) for entry in node]
        if not isinstance(node, dict):
            return node
        found = {
            key: plain(value) for key, value in node.items() if key != "default" or isinstance(value, str | int | float)
        }
        if isinstance(found.get("title"), str):
            del found["title"]
        kinds = [entry for entry in found.get("anyOf", ()) if entry != {"type": "null"}]
        return {key: value for key, value in found.items() if key != "anyOf"} | kinds[0] if len(kinds) == 1 else found

    return {"$schema": "https://json-schema.org/draft/2020-12/schema"} | plain(kind.model_json_schema())


def listed(kind: type[Section]) -> list[tuple[str, str, str]]:
    """Key, default and meaning of each field of a section, those of its own sections behind it."""
    rows: list[tuple[str, str, str]] = []
    for name, field in kind.model_fields.items():
        inner = model_of(field.annotation)
        plain = isinstance(field.default, str | int | float) and field.default not in ("", float("inf"))
        rows.append(
            (name, f"{field.default}" if plain else "", field.description or (inner.__doc__ or "" if inner else ""))
        )
        for key, default, text in listed(inner) if inner else ():
            rows.append((f"{name}.{key}", default, text))
    return rows
