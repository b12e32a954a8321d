// Written by fmus/generate.py from {{ source }}: do not edit.
// clang-format off
// All variables of the model: what users set (Parameters, Inputs), what they read (Outputs), and the state vector.  SI units.
#pragma once

#include "numbers/scalar.h"

#include <stddef.h>

#define FMI2_FUNCTION_PREFIX {{ table.model_name }}_  // of the functions of a source-code FMU
#define MODEL_IDENTIFIER "{{ table.model_name }}"
#define MODEL_GUID "{{ table.guid }}"  // digest of the table

{% if table.Z %}
enum { Z = {{ table.Z }} };  // number of balls
{% endif %}

{% for name, items in table.enumerations.items() %}
enum {  // {{ name }}
{% for item, entry in items.items() %}
    {{ name | screaming }}_{{ item | upper }} = {{ entry.number }},  // {{ entry.text }}
{% endfor %}
};
{% for item, entry in table.retired_items.get(name, {}).items() %}
#define {{ name | screaming }}_{{ item | upper }}_RETIRED {{ entry[1] | quoted }}
{% endfor %}
{% endfor %}

{% macro struct(name, causalities, real_type) %}
typedef struct {
{% for group, members in table.of(*causalities) | struct_members %}
    struct {{ name }}_{{ group }} {
{% for member, v in members %}
        {{ real_type if v.type == "Real" else "int" }} {{ member }}{{ "[%s]" % v.size if v.is_array }};  // {{ "[%s] " % v.unit if v.type == "Real" -}}
           {{ v.type ~ ": " if v.type in table.enumerations }}{{ v.description }}
{% endfor %}
    } {{ group }};
{% endfor %}
{% if name == "Parameters" and table.variables | selectattr("derives") | list %}
    struct {  // whether the host has given a value to a parameter whose start value stands for one that follows from others
{% for v in table.variables | selectattr("derives") %}
        int {{ v | given_member }};
{% endfor %}
    } given;
{% endif %}
} {{ name }};
{% endmacro %}
{{ struct("Parameters", ["parameter"], "double") }}
{{ struct("Inputs", ["input"], "scalar") }}
{{ struct("Outputs", ["output", "local"], "scalar") }}
// What is evaluated together on first read after a step.
typedef enum {
{% for group, entry in table.groups.items() %}
    GROUP_{{ group | screaming }},  // {{ entry.description }}
{% endfor %}
    GROUP_COUNT
} OutputGroup;

// The state vector y: offsets of its blocks.
enum {
{% for s in table.states %}
    Y_{{ s.name | screaming }} = {{ s.offset }},  // [{{ "Z" if s.of_balls else s.count }}] [{{ s.unit }}] {{ s.description }}
{% endfor %}
    N_STATES = {{ table.states[-1].offset + table.states[-1].count }},
    N_STATE_BLOCKS = {{ table.states | length }},
{% for s in table.elastic_states %}
    Y_{{ s.name | screaming }} = {{ s.offset }},  // [{{ s.count }}] [{{ s.unit }}] {{ s.description }}
{% endfor %}
{% set last = (table.states + table.elastic_states)[-1] %}
    N_ALL_STATES = {{ last.offset + last.count }},  // with those of elastic cage halves
    N_ALL_BLOCKS = {{ (table.states + table.elastic_states) | length }}
};

typedef enum {
{% for scale in scales %}
    SCALE_{{ scale | screaming }},
{% endfor %}
    SCALE_COUNT
} StateScale;

enum { N_INPUTS = {{ table.of("input") | length }} };  // all of them numbers
enum { N_VARIABLES = {{ table.variables | length + 1 }} };  // time is the first
