// The default step as a time-stepping module of ARKODE: see bearing_step.h.
#include "solver/bearing_step.h"

#include <arkode_impl.h>
#include <float.h>
#include <math.h>

// Called once before the first step and after each reset.
static int step_init(ARKodeMem ark, int init_type)
{
    (void)ark, (void)init_type;
    return ARK_SUCCESS;
}

// One attempt.  ARKODE's own proposal of its length is replaced: after a step that was cut short to meet the stop time the
// length goes on from where it was (integrator.c).
static int step_take(ARKodeMem ark, sunrealtype *error, int *flag)
{
    const BearingStep *step = ark->step_mem;
    ark->h = step->length(step->context, ark->tstop - ark->tn);
    if (ark->tn + ark->h == ark->tn || ark->h < DBL_MIN)
        return ARK_ERR_FAILURE;  // 1/h of a subnormal h overflows
    *error = step->take(step->context, ark->tn, ark->h);
    if (ark->fixedstep && !(*error < INFINITY))
        return ARK_RHSFUNC_FAIL;  // a step that cannot be repeated shorter
    ark->tcur = ark->tn + ark->h;
    *flag = ARK_SUCCESS;
    return ARK_SUCCESS;
}

// The step belongs to the integrator.
static void step_free(ARKodeMem ark)
{
    ark->step_mem = NULL;
}

void *bearing_step_create(SUNContext sun, N_Vector y, const BearingStep *step)
{
    ARKodeMem ark = arkCreate(sun);
    if (ark == NULL) return NULL;
    ark->step_init = step_init;
    ark->step = step_take;
    ark->step_free = step_free;
    ark->step_mem = (void *)step;
    ark->step_supports_adaptive = SUNTRUE;
    if (ARKodeSetInterpolantType(ark, ARK_INTERP_NONE) == ARK_SUCCESS &&
        arkInit(ark, 0.0, y, FIRST_INIT) == ARK_SUCCESS)
        return ark;
    void *memory = ark;
    ARKodeFree(&memory);
    return NULL;
}
