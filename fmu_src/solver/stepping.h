// Functions that the steps of all methods share: error weights, acceptance of a state, trial states without a
// derivative, messages.
#pragma once

#include "solver/integrator.h"

#include <stdio.h>

// Error weights 1/(tolerance scale).  They are absolute, because angles are unbounded.
static inline void stepping_weights(const Derived *d, double tolerance, double weight[N_ALL_STATES])
{
    for (int b = 0; b < N_ALL_BLOCKS; b++)
        for (int i = 0; i < STATE_BLOCKS[b].count; i++)
            weight[STATE_BLOCKS[b].offset + i] = 1.0 / (tolerance * d->scale[STATE_BLOCKS[b].scale]);
}

// Makes y at time t the present state, whose derivative is not known yet; returns the length of the step.
static inline double stepping_accept(IntegratorState *s, double t, const double *y)
{
    const double h = t - s->t;
    memcpy(s->now.y, y, sizeof s->now.y);
    s->t = t;
    s->steps += 1.0;
    s->f_is_current = 0;
    return h;
}

// Sets a huge derivative for a trial state whose own derivative is not finite.  ERKStep has no recoverable
// failure for such a stage; the huge derivative makes the error test fail, and the step is repeated with a
// smaller size.  The sign alternates with the count of such stages, so that two of them do not cancel.
static inline void stepping_refuse(const double *weight, int states, unsigned count, double *f)
{
    // [1/s] in units of the tolerance.  Times any step it is far above 1, and its square does not overflow.
    const double huge = count % 2 == 0 ? 1e150 : -1e150;
    for (int i = 0; i < states; i++) f[i] = huge / weight[i];
}

// Sends a message of SUNDIALS to the log, as one line.
static inline void stepping_report(double t, const char *function, int line, const char *message, int code,
                                   IntegratorLog *log, void *context)
{
    char text[512];
    snprintf(text, sizeof text, "t = %.9g s: SUNDIALS %s, line %d: %s (code %d)", t, function, line, message,
             code);
    log(context, text);
}
