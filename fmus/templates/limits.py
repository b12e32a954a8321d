"""Limits between parameters.  Written by fmus/generate.py from {{ source }}: do not edit."""

# fmt: off
# ruff: noqa: E501

from collections.abc import Callable
from dataclasses import dataclass
from math import inf, pi, sin


@dataclass(frozen=True)
class Limit:
    """One limit: value, sign and bound as functions of parameters p, the number Z of balls and the index j of an element.

    allowed: what is allowed, in words, with {bound} for the number; keys: names that it is about, needs: those of its condition too.
    """

    quantity: str
    unit: str
    allowed: str
    reason: str
    at: str  # everywhere, run or build
    is_array: bool
    keys: tuple
    needs: tuple
    sign: str
    zero: bool  # whether a value of 0 is allowed too
    rounding: float  # share of the bound by which the value may miss it
    value: Callable
    bound: Callable
    when: Callable  # whether the limit counts

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
        said = f"{self.quantity} = {self.value(p, Z, j):g}{self.unit}: {self.allowed.format(bound=self.bound(p, Z, j))}"
        return said.replace("[j]", f"[{j + 1}]") if self.is_array else said


LIMITS = (
{% for limit in table.limits %}
    Limit({{ limit.quantity | quoted }}, {{ limit.unit | quoted }}, {{ limit.allowed.replace("{bound}", "{bound:g}") | quoted }},
          {{ limit.reason | quoted }}, {{ limit.at | quoted }}, {{ limit.is_array }}, {{ limit.keys }},
          {{ limit.needs }}, "{{ limit.sign }}", {{ limit.zero != "" }}, {{ limit.rounding }},
          value=lambda p, Z, j: {{ limit.written("value", "Python") }},
          bound=lambda p, Z, j: {{ limit.written("bound", "Python") }},
          when=lambda p, Z, j: {{ limit.written("when", "Python") if limit.when else "True" }}),
{% endfor %}
)
