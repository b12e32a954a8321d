// Written by fmus/generate.py from {{ source }}: do not edit.
// clang-format off
#include "numbers/variable_table.h"

#include <math.h>

const StateBlock STATE_BLOCKS[N_ALL_BLOCKS] = {
{% for s in table.states + table.elastic_states %}
    {Y_{{ s.name | screaming }}, {{ "Z" if s.of_balls else s.count }}, SCALE_{{ s.scale | screaming }}, "{{ s.name }}"},
{% endfor %}
};

// name, unit, value reference, count, type, causality, group, state, offset, start, min, max, built, fixed, given
const Variable VARIABLES[N_VARIABLES] = {
    {"time", "s", 0, 1, TYPE_REAL, CAUSALITY_INDEPENDENT, GROUP_COUNT, -1, 0, 0.0, -INFINITY, INFINITY, false, NULL, 0},
{% for v in table.variables | sort(attribute="vr") %}
    {"{{ v.name }}", "{{ v.unit }}", {{ v.vr }}, {{ v.size }}, TYPE_{{ v.kind | upper -}}
     , CAUSALITY_{{ v.causality | upper }}, GROUP_{{ v.group | screaming if v.group else "COUNT" }}, {{ "Y_" ~ v.state | screaming if v.state else -1 -}}
     , offsetof({{ "Outputs" if v.causality == "local" else v.causality | capitalize ~ "s" }}, {{ v.path }}), {{ (v.start or 0) | c_number -}}
     , {{ v.limits[0] | c_number }}, {{ v.limits[1] | c_number }}, {{ v.built | lower }}, {{ v.fixed | quoted or "NULL" -}}
     , {{ "offsetof(Parameters, given.%s)" % (v | given_member) if v.derives else 0 }}},
{% endfor %}
};

// min, max
const double INPUT_LIMITS[N_INPUTS][2] = {
{% for v in table.of("input") | sort(attribute="vr") %}
    [offsetof(Inputs, {{ v.path }}) / sizeof(double)] = { {{- v.limits[0] | c_number }}, {{ v.limits[1] | c_number -}} },
{% endfor %}
};
