// The table of all variables (rows are written by fmus/generate.py into variables.c) and what can be asked of it.
#pragma once

#include "variables.h"

#include <stddef.h>

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
