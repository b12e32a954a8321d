// Written by fmus/generate.py from {{ source }}: do not edit.
// clang-format off
// All variables of the model: what users set (Parameters, Inputs), what they read (Outputs), the state vector, and tables of them.  SI units.
#pragma once

#include "number.h"

#include <stddef.h>

#define FMI2_FUNCTION_PREFIX {{ table.model_name }}_  // of the functions of a source-code FMU
#define MODEL_IDENTIFIER "{{ table.model_name }}"
#define MODEL_GUID "{{ table.guid }}"  // digest of the table

{% if table.Z %}
enum { Z = {{ table.Z }} };  // number of balls
{% endif %}

{% for name, items in table.enumerations.items() %}
enum {  // {{ name }}
{% for item, description in items.items() %}
    {{ name | screaming }}_{{ item | upper }} = {{ loop.index }},  // {{ description }}
{% endfor %}
};
{% endfor %}

{% macro struct(name, causality, real) %}
typedef struct {
{% for group, members in table.of(causality) | struct_members %}
    struct {
{% for member, v in members %}
        {{ real if v.type == "Real" else "int" }} {{ member }}{{ "[Z]" if v.is_array }};  // {{ "[%s] " % v.unit if v.type == "Real" -}}
           {{ v.type ~ ": " if v.type in table.enumerations }}{{ v.description }}
{% endfor %}
    } {{ group }};
{% endfor %}
} {{ name }};
{% endmacro %}
{{ struct("Parameters", "parameter", "double") }}
{{ struct("Inputs", "input", "number") }}
{{ struct("Outputs", "output", "number") }}
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
    N_STATE_BLOCKS = {{ table.states | length }}
};

typedef enum {
{% for scale in scales %}
    SCALE_{{ scale | screaming }},
{% endfor %}
    SCALE_COUNT
} StateScale;

typedef struct {
    int offset, count;
    StateScale scale;  // class of its error scale
    const char *name;
} StateBlock;

extern const StateBlock STATE_BLOCKS[N_STATE_BLOCKS];

typedef enum { TYPE_REAL, TYPE_INTEGER, TYPE_ENUMERATION } VariableType;  // double; int; int
typedef enum { CAUSALITY_INDEPENDENT, CAUSALITY_INPUT, CAUSALITY_PARAMETER, CAUSALITY_OUTPUT } Causality;

typedef struct {
    const char *name, *unit;
    unsigned value_reference;  // of the first element
    int count;                 // of elements
    VariableType type;
    Causality causality;
    OutputGroup group;  // of an output
    int state;          // its place in y if it is one, else -1
    size_t offset;      // of the first element in Inputs, Parameters or Outputs
    double start, min, max;
} Variable;

enum { N_INPUTS = {{ table.of("input") | length }} };  // all of them numbers
enum { N_VARIABLES = {{ table.variables | length + 1 }} };  // time is the first

extern const Variable VARIABLES[N_VARIABLES];  // by rising value reference

// The variable of a value reference and the index of its element; NULL if there is none.
const Variable *variable_find(unsigned value_reference, int *element);

// The variable of a name of the table; NULL if there is none.
const Variable *variable_named(const char *name);

// Whether the variable may have this value; if not, a message with its name, value, unit and allowed range.
int variable_allows(const Variable *variable, int element, double value, char *message, size_t size);

// The name of one element, numbered from 1 as FMI does: "ball[3].Q_i".
void variable_element_name(const Variable *variable, int element, char *name, size_t size);

// All start values.
void variables_set_start(Parameters *parameters, Inputs *inputs);
