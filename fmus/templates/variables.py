"""Every variable of the FMU, the enumerations and the state vector's layout.  Written by fmus/generate.py from {{ source }}: do not edit."""

# fmt: off
# ruff: noqa: E501

from dataclasses import dataclass
from enum import IntEnum

MODEL_IDENTIFIER = {{ table.model_name | quoted }}
MODEL_GUID = {{ table.guid | quoted }}
Z = {{ table.Z }}


@dataclass(frozen=True)
class Variable:
    """One variable, SI units; an array (count > 1) holds the elements name[1] ... name[count] with value references vr, vr + 1, ..."""

    name: str
    vr: int
    type: str
    unit: str
    display: str | None
    start: float | int | None
    min: float | int | None
    max: float | int | None
    count: int
    group: str | None
    description: str
    source: str | None
    derives: bool  # whether the start value stands for one that follows from others
    fixed: str | None  # why a parameter cannot change once a run has begun; None if it can


# Enumerations by name.
{% for name, items in table.enumerations.items() %}
{{ name }} = IntEnum({{ name | quoted }}, { {%- for item, entry in items.items() %}"{{ item | upper }}": {{ entry.number }}{{ ", " if not loop.last }}{% endfor -%} })
{% endfor %}
ENUMERATIONS = ({% for name in table.enumerations %}{{ name }}, {% endfor %})

# Assumed parameters that move the rivets' stress: smallest and largest usual value over the value, and the source.
ASSUMPTIONS = {
{% for name, entry in table.assumptions.items() %}
    {{ name | quoted }}: ({{ entry.low }}, {{ entry.high }}, {{ entry.source | quoted }}),
{% endfor %}
}

# Items of enumerations that are gone: number and reason by type and name.
RETIRED_ITEMS = {
{% for name, items in table.retired_items.items() %}
    {{ name | quoted }}: { {%- for item, entry in items.items() %}{{ item | quoted }}: ({{ entry[0] }}, {{ entry[1] | quoted }}), {% endfor -%} },
{% endfor %}
}

# What to look at first: names by question.
ESSENTIALS = {
{% for question, names in table.essentials.items() %}
    {{ question | quoted }}: ({% for name in names %}{{ name | quoted }}, {% endfor %}),
{% endfor %}
}

# Scales of each unit: symbol -> (factor, offset), value in that symbol = factor * SI value + offset.
UNITS = {
{% for unit, entry in table.units.items() %}
    {{ unit | quoted }}: { {{- unit | quoted }}: (1.0, 0.0)
{%- for symbol, scale in entry.get("display", {}).items() %}, {{ symbol | quoted }}: ({{ scale | join(", ") if scale is sequence else "%r, 0.0" % scale }}){% endfor %}},
{% endfor %}
}

# name, vr, type, unit, display, start, min, max, count, group, description, source, derives, fixed
{% for causality, title in (("parameter", "PARAMETERS"), ("input", "INPUTS"), ("output", "OUTPUTS"), ("local", "LOCALS")) %}
{{ title }} = {
    v.name: v
    for v in (
{% for v in table.of(causality) %}
        Variable({{ v.name | quoted }}, {{ v.vr }}, {{ v.type | quoted }}, {{ v.unit | quoted }}, {{ v.display | quoted }}, {{ v.start }}, {{ v.min }}, {{ v.max -}}
                 , {{ v.size }}, {{ v.group | quoted }}, {{ v.description | quoted }}, {{ v.source | quoted }}, {{ v.derives }}, {{ v.fixed | quoted }}),
{% endfor %}
    )
}

{% endfor %}
# The state vector y: slices of its blocks and the class of their error scale.
{% for s in table.states + table.elastic_states %}
{{ s.name | upper }} = {{ "slice(%d, %d)" % (s.offset, s.offset + s.count) }}  # {{ s.unit }}  {{ s.description }}
{% endfor %}
N_STATES = {{ table.states[-1].offset + table.states[-1].count }}
{% set last = (table.states + table.elastic_states)[-1] %}
N_ALL_STATES = {{ last.offset + last.count }}  # with those of elastic cage halves
STATE_SCALES = {
{% for s in table.states %}
    {{ s.name | quoted }}: {{ s.scale | quoted }},
{% endfor %}
}
STATE_SLICES = {name: globals()[name.upper()] for name in STATE_SCALES}
ELASTIC_SCALES = {
{% for s in table.elastic_states %}
    {{ s.name | quoted }}: {{ s.scale | quoted }},
{% endfor %}
}
