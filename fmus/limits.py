"""Limits between parameters, as the table of variables has them, in C, in Python and in words.

A limit is one inequality of names of the table, written as Python writes it.
"""

import ast
import re
from dataclasses import dataclass

WORDS = {ast.Lt: "less than ", ast.LtE: "at most ", ast.Gt: "more than ", ast.GtE: "at least ", ast.Eq: ""}
SIGNS = {
    ast.Lt: "<",
    ast.LtE: "<=",
    ast.Gt: ">",
    ast.GtE: ">=",
    ast.Eq: "==",
    ast.NotEq: "!=",
    ast.Add: "+",
    ast.Sub: "-",
}
SIGNS |= {ast.Mult: "*", ast.Div: "/", ast.And: "and", ast.Or: "or"}
RANKS = {ast.Add: 1, ast.Sub: 1, ast.Mult: 2, ast.Div: 2}
OF_C = {"pi": "PI", "min": "fmin", "and": "&&", "or": "||"}
PLACES = ("everywhere", "run", "build")
NOT_IN_TABLE = ("rivet.", "catalogue.", "Z")


@dataclass(frozen=True)
class Limit:
    """One limit: how a value lies to its bound (keep), in which cases (when, None for all), and what keeps it (reason).

    zero: what a value of 0 stands for, which is allowed too; rounding: share of the bound by which the value may miss it;
    at: one of PLACES; variables: those of the table by name.
    """

    keep: ast.Compare
    when: ast.expr | None
    reason: str
    zero: str
    rounding: float
    at: str
    variables: dict

    @property
    def value(self):
        return self.keep.left

    @property
    def bound(self):
        return self.keep.comparators[0]

    @property
    def sign(self):
        return SIGNS[type(self.keep.ops[0])]

    @property
    def keys(self):
        """Names that the inequality is about, the first to blame first."""
        return tuple(dict.fromkeys(names_in(self.keep)))

    @property
    def needs(self):
        """All names, those of the condition too."""
        return tuple(dict.fromkeys((*self.keys, *names_in(self.when))))

    @property
    def is_array(self):
        return "[j]" in text(self.keep)

    @property
    def unit(self):
        unit = self.variables[self.keys[0]].unit if self.keys[0] in self.variables else "m"
        return "" if unit == "1" else f" {unit}"

    @property
    def quantity(self):
        """The value in words."""
        return text(self.value)

    @property
    def right(self):
        """The bound in words."""
        return text(self.bound)

    @property
    def condition(self):
        """The cases in words."""
        return f"`{text(self.when)}`" if self.when else ""

    @property
    def allowed(self):
        """What is allowed and for what, in words."""
        return f"{self.range} is allowed for {self.reason}"

    @property
    def range(self):
        """What is allowed, in words; {bound} stands for the number."""
        if isinstance(self.bound, ast.Name):
            return f"{self.bound.id} ({choice(self.keep, self.variables)})"
        zero = f"0, which stands for {self.zero}, or " if self.zero else ""
        named = "" if isinstance(self.bound, ast.Constant) else f"{text(self.bound)} = "
        share = f" +- {100 * self.rounding:g} %" if self.sign == "==" and self.rounding else ""
        return f"{zero}{WORDS[type(self.keep.ops[0])]}{named}{{bound}}{self.unit}{share}"

    def written(self, part, language):
        """Value, bound or condition ("value", "bound", "when") in "C" or "Python"."""
        if part == "bound" and isinstance(self.bound, ast.Name):
            return str(choice(self.keep, self.variables))
        return formula(getattr(self, part), language == "C", self.variables)

    @property
    def c_format(self):
        """The message as C prints it."""
        said = f"{self.quantity} = %g{self.unit}: {self.allowed.replace('%', '%%')}"
        return said.replace("{bound}", "%g").replace("[j]", "[%d]")

    @property
    def c_arguments(self):
        """Arguments of c_format: the number of each element that it names, value, bound."""
        numbers = iter(("value", "bound"))
        return ", ".join("j + 1" if place == "%d" else next(numbers) for place in re.findall("%d|%g", self.c_format))


def read_limits(entries, variables):
    """All limits of a table, one for each of `each`; ValueError names the one that cannot be read."""
    by_name = {v.name: v for v in variables}
    return tuple(
        read_limit(
            {key: text.replace("@", one) if isinstance(text, str) else text for key, text in entry.items()}, by_name
        )
        for entry in entries
        for one in entry.get("each", ("",))
    )


def read_limit(entry, variables):
    """One limit from its entry."""
    keep = ast.parse(entry["keep"], mode="eval").body
    when = ast.parse(entry["when"], mode="eval").body if "when" in entry else None
    if not isinstance(keep, ast.Compare) or len(keep.ops) != 1 or type(keep.ops[0]) not in WORDS or not names_in(keep):
        raise ValueError(f"limit {entry['keep']!r}: one inequality of a variable is needed")
    rest = entry["reason"], entry.get("zero", ""), entry.get("rounding", 0.0), entry.get("at", PLACES[0]), variables
    limit = Limit(keep, when, *rest)
    unknown = [name for name in limit.needs if name not in variables and not name.startswith(NOT_IN_TABLE)]
    if unknown or limit.at not in PLACES:
        raise ValueError(f"limit {entry['keep']!r}: unknown {', '.join(unknown) or limit.at}")
    return limit


def is_side(node):
    """Whether a node is the least or largest value of a variable: bearing.E.min."""
    return isinstance(node, ast.Attribute) and isinstance(node.value, ast.Attribute)


def names_in(node):
    """Names of variables in a formula, in their order: cage.D_o, ball[j].dD, Z."""
    if node is None or is_side(node):
        return []
    if isinstance(node, ast.Attribute) or (isinstance(node, ast.Name) and node.id == "Z"):
        return [ast.unparse(node)]
    return [name for child in ast.iter_child_nodes(node) for name in names_in(child)]


def choice(comparison, variables):
    """Number of the item that an enumeration is compared with, None for numbers."""
    variable = variables.get(ast.unparse(comparison.left))
    return variable.choices[comparison.comparators[0].id] if variable and variable.choices else None


def formula(node, is_c, variables, outer=0):
    """A formula in C or in Python; outer: rank of the operator around it."""

    def word(name):
        return OF_C.get(name, name) if is_c else name

    def written(part, outer=0):
        return formula(part, is_c, variables, outer)

    match node:
        case ast.Attribute(value=ast.Attribute() as of, attr=side):
            return repr(getattr(variables[ast.unparse(of)], side))
        case ast.Attribute():
            return ("p->" if is_c else "p.") + re.sub(r"\[j\](.*)", r"\1[j]", ast.unparse(node))
        case ast.Name(id=name):
            return word(name)
        case ast.Constant(value=value):
            return repr(float(value))
        case ast.UnaryOp(op=ast.USub(), operand=operand):
            return f"-{written(operand, 3)}"
        case ast.BinOp(left=left, op=ast.Pow(), right=ast.Constant(value=2)):
            return f"{written(left, 3)} * {written(left, 3)}"
        case ast.BinOp(left=left, op=op, right=right):
            rank = RANKS[type(op)]
            inside = f"{written(left, rank)} {SIGNS[type(op)]} {written(right, rank + 1)}"
            return f"({inside})" if rank < outer else inside
        case ast.Call(func=ast.Name(id=name), args=arguments):
            return f"{word(name)}({', '.join(map(written, arguments))})"
        case ast.Compare(left=left, ops=[op], comparators=[right]):
            return f"{written(left)} {SIGNS[type(op)]} {choice(node, variables) or written(right)}"
        case ast.BoolOp(op=op, values=values):
            return f" {word(SIGNS[type(op)])} ".join(map(written, values))
    raise ValueError(f"limit: {ast.unparse(node)!r} is not understood")


def text(node):
    """A formula for readers: bearing.d_m sin(pi/Z)."""
    return ast.unparse(node).replace(" ** ", "^").replace(" / ", "/").replace(" * ", " ")
