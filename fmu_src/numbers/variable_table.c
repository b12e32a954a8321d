// Look-up, limits and start values: one loop over the table instead of a case per variable.
#include "numbers/variable_table.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

const Variable *variable_find(unsigned value_reference, int *element)
{
    int low = 0;
    int high = N_VARIABLES;  // VARIABLES[low] starts at or below the reference, VARIABLES[high] above
    while (high - low > 1) {
        const int middle = (low + high) / 2;
        if (VARIABLES[middle].value_reference <= value_reference)
            low = middle;
        else
            high = middle;
    }
    const unsigned index = value_reference - VARIABLES[low].value_reference;
    if (index >= (unsigned)VARIABLES[low].count) return NULL;
    *element = (int)index;
    return &VARIABLES[low];
}

const Variable *variable_named(const char *name)
{
    for (int i = 0; i < N_VARIABLES; i++) {
        if (strcmp(VARIABLES[i].name, name) == 0) return &VARIABLES[i];
    }
    return NULL;
}

void variable_element_name(const Variable *variable, int element, char *name, size_t size)
{
    const char *bracket = strchr(variable->name, '[');  // of "ball[j].Q_i"
    if (!bracket) {
        snprintf(name, size, "%s", variable->name);
        return;
    }
    snprintf(name, size, "%.*s[%d]%s", (int)(bracket - variable->name), variable->name, element + 1,
             bracket + 3);
}

int variable_allows(const Variable *variable, int element, double value, char *message, size_t size)
{
    if (isfinite(value) && value >= variable->min && value <= variable->max) return 1;
    char name[64];
    variable_element_name(variable, element, name, sizeof name);
    const int bare = strcmp(variable->unit, "1") == 0;
    snprintf(message, size, "%s = %.10g%s%s is not allowed: it must lie in [%.10g, %.10g]", name, value,
             bare ? "" : " ", bare ? "" : variable->unit, variable->min, variable->max);
    return 0;
}

double variable_value(const Variable *variable, int element, const void *values)
{
    const char *at = (const char *)values + variable->offset;
    return variable->type == TYPE_REAL ? ((const double *)at)[element] : ((const int *)at)[element];
}

// A value that rounding alone has taken beyond a limit counts as the limit.
static double without_rounding(const Variable *variable, double value, double rounding)
{
    const double nearest = fmax(variable->min, fmin(variable->max, value));
    return fabs(value - nearest) <= rounding * fabs(nearest) ? nearest : value;
}

bool variables_allow(Causality causality, const void *values, double rounding, Report report, void *context)
{
    bool fine = true;
    for (int v = 0; v < N_VARIABLES; v++) {
        if (VARIABLES[v].causality != causality) continue;
        for (int i = 0; i < VARIABLES[v].count; i++) {
            const double exact = variable_value(&VARIABLES[v], i, values);
            const double value = without_rounding(&VARIABLES[v], exact, rounding);
            char message[512];
            if (variable_allows(&VARIABLES[v], i, value, message, sizeof message)) continue;
            report(context, message);
            fine = false;
        }
    }
    return fine;
}

void variables_mark_given(Parameters *parameters)
{
    for (const Variable *v = VARIABLES; v < VARIABLES + N_VARIABLES; v++) {
        if (v->given > 0)
            *(int *)((char *)parameters + v->given) = variable_value(v, 0, parameters) != v->start;
    }
}

void variables_set_start(Parameters *parameters, Inputs *inputs)
{
    for (const Variable *v = VARIABLES; v < VARIABLES + N_VARIABLES; v++) {
        if (v->causality != CAUSALITY_PARAMETER && v->causality != CAUSALITY_INPUT) continue;
        char *storage =
            (v->causality == CAUSALITY_PARAMETER ? (char *)parameters : (char *)inputs) + v->offset;
        for (int element = 0; element < v->count; element++) {
            if (v->type == TYPE_REAL)
                ((double *)storage)[element] = v->start;
            else
                ((int *)storage)[element] = (int)v->start;
        }
    }
}
