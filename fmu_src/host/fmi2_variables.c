// Values of variables by their references (FMI 2.0.4, section 2.1.7).
#include "host/fmi2_instance.h"

#include <math.h>
#include <string.h>

const Variable *find_variable(Instance *m, fmi2ValueReference reference, bool real, int *element)
{
    const Variable *v = variable_find(reference, element);
    if (v && (v->type == TYPE_REAL) == real) return v;
    refuse(m, "value reference %u belongs to no %s variable", reference,
           real ? "Real" : "Integer or Enumeration");
    return NULL;
}

static void *storage(Instance *m, const Variable *v)
{
    char *base =
        v->causality == CAUSALITY_INPUT ? (char *)part_inputs(m->part, 0) : (char *)part_parameters(m->part);
    return base + v->offset;
}

// An output, evaluated with its group on first read after a step.
static fmi2Status output_value(Instance *m, const Variable *v, int element, double *value)
{
    fmi2Status status = fmi2OK;
    *value = NAN;
    if (m->session.phase == INITIALIZING) status = instance_initialize(m);
    if (m->session.phase == ERRONEOUS) return status > fmi2OK ? status : fmi2Warning;
    part_update(m->part, v->group);
    *value = ((const double *)((const char *)part_outputs(m->part) + v->offset))[element];
    return status;
}

static fmi2Status real_value(Instance *m, const Variable *v, int element, double *value)
{
    switch (v->causality) {
    case CAUSALITY_INDEPENDENT:
        *value = m->session.phase == INITIALIZING ? m->session.start_time : part_time(m->part);
        return fmi2OK;
    case CAUSALITY_INPUT:
    case CAUSALITY_PARAMETER: *value = ((const double *)storage(m, v))[element]; return fmi2OK;
    case CAUSALITY_OUTPUT:
    case CAUSALITY_LOCAL: break;
    }
    return output_value(m, v, element, value);
}

fmi2Status slave_GetReal(fmi2Component c, const fmi2ValueReference vr[], size_t n, fmi2Real value[])
{
    Instance *m = c;
    if (n > 0 && (!vr || !value)) return refuse(m, "a null pointer for %zu values", n);
    fmi2Status status = fmi2OK;
    for (size_t i = 0; i < n && status <= fmi2Warning; i++) {
        int element;
        const Variable *v = find_variable(m, vr[i], true, &element);
        const fmi2Status one = v ? real_value(m, v, element, &value[i]) : fmi2Error;
        if (one > status) status = one;
    }
    return status;
}

fmi2Status slave_GetInteger(fmi2Component c, const fmi2ValueReference vr[], size_t n, fmi2Integer value[])
{
    Instance *m = c;
    if (n > 0 && (!vr || !value)) return refuse(m, "a null pointer for %zu values", n);
    for (size_t i = 0; i < n; i++) {
        int element;
        const Variable *v = find_variable(m, vr[i], false, &element);
        if (!v) return fmi2Error;
        value[i] = ((const int *)storage(m, v))[element];
    }
    return fmi2OK;
}

// Whether this value may be set now.
static bool settable(Instance *m, fmi2ValueReference reference, bool real, double value)
{
    int element;
    const Variable *v = find_variable(m, reference, real, &element);
    if (!v) return false;
    char message[256];
    if (v->causality != CAUSALITY_INPUT && v->causality != CAUSALITY_PARAMETER) {
        variable_element_name(v, element, message, sizeof message);
        refuse(m, "%s = %.10g is not allowed: only inputs and parameters can be set", message, value);
        return false;
    }
    if (v->causality == CAUSALITY_PARAMETER && v->fixed && m->session.phase == STEPPING) {
        variable_element_name(v, element, message, sizeof message);
        refuse(m, "%s = %.10g is not allowed: it is fixed after initialization, for %s", message, value,
               v->fixed);
        return false;
    }
    if (!variable_allows(v, element, value, message, sizeof message)) {
        refuse(m, "%s", message);
        return false;
    }
    return true;
}

// Notes that the host has given a value to a parameter whose start value stands for one that follows from others.
// Before the run a value that is the start value notes nothing: importers set all start values.
static void note_given(Instance *m, const Variable *v)
{
    if (v->given > 0 && m->session.phase == STEPPING)
        *(int *)((char *)part_parameters(m->part) + v->given) = 1;
}

// Sets Real or Integer and Enumeration variables; all values are checked before the first is set.
static fmi2Status set_values(Instance *m, const fmi2ValueReference vr[], size_t n, bool real,
                             const void *values)
{
    const fmi2Real *reals = values;
    const fmi2Integer *integers = values;
    if (n > 0 && (!vr || !values)) return refuse(m, "a null pointer for %zu values", n);
    for (size_t i = 0; i < n; i++)
        if (!settable(m, vr[i], real, real ? reals[i] : integers[i])) return fmi2Error;
    for (size_t i = 0; i < n; i++) {
        int element;
        const Variable *v = variable_find(vr[i], &element);
        if (real)
            ((double *)storage(m, v))[element] = reals[i];
        else
            ((int *)storage(m, v))[element] = integers[i];
        note_given(m, v);
    }
    if (n > 0) forget_start(m);
    return fmi2OK;
}

fmi2Status slave_SetReal(fmi2Component c, const fmi2ValueReference vr[], size_t n, const fmi2Real value[])
{
    return set_values(c, vr, n, true, value);
}

fmi2Status slave_SetInteger(fmi2Component c, const fmi2ValueReference vr[], size_t n,
                            const fmi2Integer value[])
{
    return set_values(c, vr, n, false, value);
}

// There are no Boolean and no String variables.
#define NO_VARIABLES(name, what, Type)                                                              \
    fmi2Status slave_##name(fmi2Component c, const fmi2ValueReference vr[], size_t n, Type value[]) \
    {                                                                                               \
        (void)vr, (void)value;                                                                      \
        return n == 0 ? fmi2OK : refuse(c, "this FMU has no %s variables", what);                   \
    }

NO_VARIABLES(GetBoolean, "Boolean", fmi2Boolean)
NO_VARIABLES(SetBoolean, "Boolean", const fmi2Boolean)
NO_VARIABLES(GetString, "String", fmi2String)
NO_VARIABLES(SetString, "String", const fmi2String)
