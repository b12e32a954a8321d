// The table of all variables, whose rows fmus/generate.py writes into variables.c, and the functions on it.
#pragma once

#include "variables.h"

#include <stdbool.h>
#include <stddef.h>

enum { INPUT_ORDERS = 2 };  // inside a step inputs are polynomials of time of up to this order

typedef struct {
    int offset, count;
    StateScale scale;  // class of its error scale
    const char *name;
} StateBlock;

extern const StateBlock STATE_BLOCKS[N_ALL_BLOCKS];

typedef enum { TYPE_REAL, TYPE_INTEGER, TYPE_ENUMERATION } VariableType;  // stored as double, int, int

typedef enum {
    CAUSALITY_INDEPENDENT,
    CAUSALITY_INPUT,
    CAUSALITY_PARAMETER,
    CAUSALITY_OUTPUT,
    CAUSALITY_LOCAL
} Causality;

typedef struct {
    const char *name, *unit;
    unsigned value_reference;  // that of the first element
    int count;                 // number of elements
    VariableType type;
    Causality causality;
    OutputGroup group;  // group of an output
    int state;          // index in y of an output that is a state, else -1
    size_t offset;      // offset of the first element in Inputs, Parameters or Outputs
    double start, min, max;
    bool built;         // fixed by the build: no value but the start value is allowed
    const char *fixed;  // why a parameter cannot change once a run has begun; NULL if it can
    size_t given;       // offset in Parameters of the mark that the host has given it; 0 if it has none
} Variable;

extern const Variable VARIABLES[N_VARIABLES];  // in the order of value references

extern const double INPUT_LIMITS[N_INPUTS][2];  // least and largest value of each number in Inputs

typedef void (*Report)(void *context, const char *message);

// The variable of a value reference and the index of its element; NULL if there is none.
const Variable *variable_find(unsigned value_reference, int *element);

// The variable of a name of the table; NULL if there is none.
const Variable *variable_named(const char *name);

// Whether the variable may have this value; if not, sets a message with name, value, unit and allowed range.
int variable_allows(const Variable *variable, int element, double value, char *message, size_t size);

// Whether all variables of one causality may have the values in a Parameters or an Inputs; each that may not
// is reported with its message. rounding: the relative share of a limit by which a value may lie beyond the limit.
bool variables_allow(Causality causality, const void *values, double rounding, Report report, void *context);

// Whether parameters keep the limits between them (generated/limits.c), or those of one quantity if it is not NULL; each
// that is broken is reported.  Sizes with a rule must be those in force.
bool limits_hold(const Parameters *p, const char *quantity, Report report, void *context);

// The name of one element, numbered from 1 as FMI does: "ball[3].Q_i".
void variable_element_name(const Variable *variable, int element, char *name, size_t size);

// Value of an element in the Parameters, Inputs or Outputs that hold it.
double variable_value(const Variable *variable, int element, const void *values);

// Marks the parameters whose start value stands for one that follows from others, where they differ from it.
void variables_mark_given(Parameters *parameters);

// Sets all start values.
void variables_set_start(Parameters *parameters, Inputs *inputs);
