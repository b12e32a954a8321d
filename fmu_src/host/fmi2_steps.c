// Communication steps and their status (FMI 2.0.4, sections 4.2.2 and 4.2.3).
#include "host/fmi2_instance.h"

#include <float.h>
#include <math.h>
#include <stdio.h>

// Distance that a host's clock may have from the FMU's: single precision (6e-8 of the time, a few of them) and
// times that a host rounds for itself, never less than a thousandth of the step, nor more than half of it: a point
// a whole step away is another one.
static double clock_slack(double time, double step)
{
    return fmax(fmin(1e-6 * fabs(time), 0.5 * step), 1e-3 * step);
}

// Distance that double precision alone explains: t += h, start + k h, whole nanoseconds.
double clock_rounding(const Session *s, double time, double step)
{
    return 2.0 * DBL_EPSILON * (fmax(fabs(s->start_time), fabs(time)) + step);
}

static void warn_of_clock(Instance *m, double point, double time)
{
    if (m->warned_of_clock) return;
    m->warned_of_clock = true;
    char message[256];
    snprintf(message, sizeof message,
             "currentCommunicationPoint = %.17g s, but the last step ended at %.17g s: the FMU goes on from "
             "its own time "
             "to the end of each step (said once)",
             point, time);
    instance_log(m, LOG_WARNING, message);
}

// A step that was refused before it began: the state is untouched, and the host may go on with a right clock.
static fmi2Status untouched(Instance *m, fmi2Status status)
{
    m->session.phase = STEPPING;
    return status;
}

// The step from the FMU's own time to the end that the host means.
static fmi2Status do_step(Instance *m, double point, double step)
{
    const Session *s = &m->session;
    const double time = part_time(m->part), end = point + step;
    if (!(isfinite(step) && step > 0.0)) {
        return refuse(m, "communicationStepSize = %g s is not allowed: it must be positive and finite", step);
    }
    const double slack = clock_slack(time, step), rounding = clock_rounding(s, time, step);
    if (!(fabs(point - time) <= slack + rounding)) {
        return untouched(
            m, refuse(m,
                      "currentCommunicationPoint = %.17g s is not allowed: the last step ended at %.17g s; "
                      "at most %.3g s off is allowed",
                      point, time, slack));
    }
    if (!(end > time)) {
        return untouched(
            m,
            refuse(m,
                   "communicationStepSize = %g s is not allowed: currentCommunicationPoint = %.17g s and the "
                   "step end at or before %.17g s, where the last step ended",
                   step, point, time));
    }
    if (end > s->stop_time + fmin(slack, 0.5 * step) + rounding) {
        return refuse(m,
                      "communicationStepSize = %g s is not allowed: the step goes beyond stopTime = %.17g s",
                      step, s->stop_time);
    }
    if (fabs(point - time) > rounding) warn_of_clock(m, point, time);
    return conclude(m, part_step(m->part, end));
}

fmi2Status slave_DoStep(fmi2Component c, fmi2Real point, fmi2Real step, fmi2Boolean no_earlier_state)
{
    (void)no_earlier_state;  // nothing is kept for it
    Instance *m = c;
    const fmi2Status status = do_step(m, point, step);
    m->session.step_status = status;
    return status;
}

// Each status function answers for one kind: fmi2Discard for the others (FMI 2.0.4, section 4.2.3).
#define STATUS(name, Type, wanted, answer)                                           \
    fmi2Status slave_##name(fmi2Component c, const fmi2StatusKind kind, Type *value) \
    {                                                                                \
        Instance *m = c;                                                             \
        if (!value) return refuse(m, "a null pointer");                              \
        if (kind != (wanted)) return fmi2Discard;                                    \
        *value = (answer);                                                           \
        return fmi2OK;                                                               \
    }

STATUS(GetStatus, fmi2Status, fmi2DoStepStatus, (fmi2Status)m->session.step_status)
STATUS(GetRealStatus, fmi2Real, fmi2LastSuccessfulTime, part_time(m->part))
STATUS(GetBooleanStatus, fmi2Boolean, fmi2Terminated, m->session.phase == FAILED)
STATUS(GetStringStatus, fmi2String, fmi2PendingStatus, m->message)  // the last error or warning

fmi2Status slave_GetIntegerStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Integer *value)
{
    (void)kind;
    return value ? fmi2Discard : refuse(c, "a null pointer");
}
