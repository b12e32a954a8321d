"""Limits between parameters.  Written by fmus/generate.py from {{ source }}: do not edit."""

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
{% for limit in table.limits %}
    Limit({{ limit.quantity | quoted }}, {{ limit.unit | quoted }}, {{ limit.range.replace("{bound}", "{bound:g}") | quoted }}, {{ limit.reason | quoted }}, {{ limit.keys }},
          "{{ limit.sign }}", lambda p, Z, j: {{ limit.written("value", "Python") }}, lambda p, Z, j: {{ limit.written("bound", "Python") }}
{%- if limit.at != "everywhere" %}, at={{ limit.at | quoted }}{% endif %}
{%- if limit.zero %}, zero=True{% endif %}
{%- if limit.rounding %}, rounding={{ limit.rounding }}{% endif %}
{%- if limit.when %},
          more={{ limit.needs[limit.keys | length:] }}, when=lambda p, Z, j: {{ limit.written("when", "Python") }}{% endif %}),
{% endfor %}
)
