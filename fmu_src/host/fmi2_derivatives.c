// Derivatives of inputs and outputs, directional derivatives (FMI 2.0.4, sections 2.1.9 and 4.2.1).
#include "host/fmi2_instance.h"
#include "numbers/saved_numbers.h"

#include <math.h>
#include <string.h>

// The input of a value reference, if it may have this derivative.
static const Variable *differentiable_input(Instance *m, fmi2ValueReference reference, int order,
                                            double value, int *element)
{
    const Variable *v = find_variable(m, reference, true, element);
    if (!v) return NULL;
    if (v->causality != CAUSALITY_INPUT) {
        refuse(m, "%s: only inputs have derivatives that can be set", v->name);
    } else if (order < 1 || order > INPUT_ORDERS) {
        refuse(m, "order = %d of %s is not allowed: it must lie in [1, %d]", order, v->name, INPUT_ORDERS);
    } else if (!values_are_within(&value, 1, LARGEST_DERIVATIVE)) {
        refuse(m, "%s: derivative of order %d = %g is not allowed: it must lie within +-%g", v->name, order,
               value, LARGEST_DERIVATIVE);
    } else {
        return v;
    }
    return NULL;
}

// The derivatives hold for the next step, from its beginning on; an input without derivatives keeps its value.
fmi2Status slave_SetRealInputDerivatives(fmi2Component c, const fmi2ValueReference vr[], size_t n,
                                         const fmi2Integer order[], const fmi2Real value[])
{
    Instance *m = c;
    if (n > 0 && (!vr || !order || !value)) return refuse(m, "a null pointer for %zu values", n);
    int element;
    for (size_t i = 0; i < n; i++) {
        if (!differentiable_input(m, vr[i], order[i], value[i], &element)) return fmi2Error;
    }
    for (size_t i = 0; i < n; i++) {
        const Variable *v = variable_find(vr[i], &element);
        ((double *)((char *)part_inputs(m->part, order[i]) + v->offset))[element] = value[i];
    }
    if (n > 0) forget_start(m);
    return fmi2OK;
}

// Derivatives of the variables vr, all outputs, from those of all outputs; NaN after an error, as the outputs
// themselves: a start that failed has no state to differentiate at.
static fmi2Status output_derivatives(Instance *m, const Outputs *derivatives, const fmi2ValueReference vr[],
                                     size_t n, fmi2Real value[])
{
    const bool erroneous = m->session.phase == ERRONEOUS;
    for (size_t i = 0; i < n; i++) {
        int element;
        const Variable *v = find_variable(m, vr[i], true, &element);
        if (!v) return fmi2Error;
        if (v->causality != CAUSALITY_OUTPUT)
            return refuse(m, "%s is no output: it has no derivative that could be asked for", v->name);
        value[i] = erroneous ? NAN : ((const double *)((const char *)derivatives + v->offset))[element];
    }
    return fmi2OK;
}

fmi2Status slave_GetRealOutputDerivatives(fmi2Component c, const fmi2ValueReference vr[], size_t n,
                                          const fmi2Integer order[], fmi2Real value[])
{
    Instance *m = c;
    if (n > 0 && (!vr || !order || !value)) return refuse(m, "a null pointer for %zu values", n);
    for (size_t i = 0; i < n; i++) {
        if (order[i] != 1) return refuse(m, "order = %d is not allowed: it must be 1", order[i]);
    }
    Outputs derivatives = {0};
    if (m->session.phase != ERRONEOUS) part_time_derivatives(m->part, &derivatives);
    return output_derivatives(m, &derivatives, vr, n, value);
}

// Known are inputs and the states of the ring, all other states kept.
fmi2Status slave_GetDirectionalDerivative(fmi2Component c, const fmi2ValueReference unknown[],
                                          size_t n_unknown, const fmi2ValueReference known[], size_t n_known,
                                          const fmi2Real d_known[], fmi2Real d_unknown[])
{
    Instance *m = c;
    if ((n_unknown > 0 && (!unknown || !d_unknown)) || (n_known > 0 && (!known || !d_known)))
        return refuse(m, "a null pointer");
    Inputs inputs;
    double state[N_ALL_STATES] = {0.0};
    memset(&inputs, 0, sizeof inputs);
    for (size_t i = 0; i < n_known; i++) {
        int element;
        const Variable *v = find_variable(m, known[i], true, &element);
        if (!v) return fmi2Error;
        if (!isfinite(d_known[i]))
            return refuse(m, "%s: %g is not allowed in a direction: it must be finite", v->name, d_known[i]);
        if (v->causality == CAUSALITY_INPUT)
            ((double *)((char *)&inputs + v->offset))[element] += d_known[i];
        else if (v->state >= 0)
            state[v->state] += d_known[i];
        else
            return refuse(m, "%s is neither an input nor a state: there is no derivative by it", v->name);
    }
    Outputs derivatives = {0};
    if (m->session.phase != ERRONEOUS) part_directional_derivatives(m->part, &inputs, state, &derivatives);
    return output_derivatives(m, &derivatives, unknown, n_unknown, d_unknown);
}
