// Vectors of ARKODE over the states of a scene: fixed length, operations of this processor's instruction set.
#include "solver/state_vector.h"

#include "numbers/reserved_memory.h"

#include <math.h>
#include <stdint.h>
#include <string.h>

enum { LINE = 8 };  // numbers in a cache line

typedef struct {
    const VectorOps *const *ops;  // where the integrator keeps them
    double *value;                // the first whole cache line of `block`
    double block[N_ALL_STATES + LINE - 1];
} Content;

double *state_vector_data(N_Vector v)
{
    return ((Content *)v->content)->value;
}

void state_vector_show(N_Vector v, double *y)
{
    ((Content *)v->content)->value = y;
}

static const VectorOps *ops(N_Vector v)
{
    return *((const Content *)v->content)->ops;
}

int state_vector_length(N_Vector v)
{
    return ops(v)->states;
}

static N_Vector_ID vector_id(N_Vector v)
{
    (void)v;
    return SUNDIALS_NVEC_CUSTOM;
}

static sunindextype vector_length(N_Vector v)
{
    return state_vector_length(v);
}

static Content *content_new(const VectorOps *const *vector_operations)
{
    Content *content = malloc(sizeof *content);
    if (content == NULL) return NULL;
    const uintptr_t line = LINE * sizeof(double), at = (uintptr_t)content->block;
    content->ops = vector_operations;
    content->value = (double *)((at + line - 1) / line * line);
    return content;
}

static N_Vector vector_clone(N_Vector like)
{
    N_Vector v = N_VNewEmpty(like->sunctx);
    if (v == NULL) return NULL;
    N_VCopyOps(like, v);
    v->content = content_new(((const Content *)like->content)->ops);
    if (v->content == NULL) {
        N_VFreeEmpty(v);
        return NULL;
    }
    return v;
}

static void vector_destroy(N_Vector v)
{
    if (v == NULL) return;
    free(v->content);
    N_VFreeEmpty(v);
}

static void vector_linear_sum(sunrealtype a, N_Vector x, sunrealtype b, N_Vector y, N_Vector z)
{
    ops(z)->linear_sum(a, state_vector_data(x), b, state_vector_data(y), state_vector_data(z));
}

static SUNErrCode vector_linear_combination(int n, sunrealtype *c, N_Vector *x, N_Vector z)
{
    enum { MAX_VECTORS = 8 };  // more than the stages and the state

    double *values[MAX_VECTORS];
    if (n > MAX_VECTORS) return SUN_ERR_ARG_OUTOFRANGE;
    for (int i = 0; i < n; i++) values[i] = state_vector_data(x[i]);
    ops(z)->linear_combination(n, c, values, state_vector_data(z));
    return SUN_SUCCESS;
}

static double vector_wrms_norm(N_Vector x, N_Vector w)
{
    return ops(x)->wrms_norm(state_vector_data(x), state_vector_data(w));
}

static void vector_scale(sunrealtype c, N_Vector x, N_Vector z)
{
    if (c == 1.0) {
        if (state_vector_data(x) != state_vector_data(z))  // vectors may show the same state
            memcpy(state_vector_data(z), state_vector_data(x),
                   sizeof(double) * (size_t)state_vector_length(z));
    } else {
        for (int i = 0; i < state_vector_length(z); i++)
            state_vector_data(z)[i] = c * state_vector_data(x)[i];
    }
}

static void vector_const(sunrealtype c, N_Vector z)
{
    if (c == 0.0)
        memset(state_vector_data(z), 0, sizeof(double) * (size_t)state_vector_length(z));
    else
        for (int i = 0; i < state_vector_length(z); i++) state_vector_data(z)[i] = c;
}

// ARKODE checks that these operations exist.  It calls them only to choose a first step, which is always
// given.
static void vector_div(N_Vector x, N_Vector y, N_Vector z)
{
    for (int i = 0; i < state_vector_length(z); i++)
        state_vector_data(z)[i] = state_vector_data(x)[i] / state_vector_data(y)[i];
}

static void vector_abs(N_Vector x, N_Vector z)
{
    for (int i = 0; i < state_vector_length(z); i++) state_vector_data(z)[i] = fabs(state_vector_data(x)[i]);
}

static void vector_inv(N_Vector x, N_Vector z)
{
    for (int i = 0; i < state_vector_length(z); i++) state_vector_data(z)[i] = 1.0 / state_vector_data(x)[i];
}

static void vector_add_const(N_Vector x, sunrealtype b, N_Vector z)
{
    for (int i = 0; i < state_vector_length(z); i++) state_vector_data(z)[i] = state_vector_data(x)[i] + b;
}

static double vector_max_norm(N_Vector x)
{
    double max = 0.0;
    for (int i = 0; i < state_vector_length(x); i++) max = fmax(max, fabs(state_vector_data(x)[i]));
    return max;
}

N_Vector state_vector_new(SUNContext sun, const VectorOps *const *vector_operations)
{
    N_Vector v = N_VNewEmpty(sun);
    if (v == NULL) return NULL;
    *v->ops = (struct _generic_N_Vector_Ops){0};
    v->ops->nvgetvectorid = vector_id;
    v->ops->nvclone = vector_clone;
    v->ops->nvdestroy = vector_destroy;
    v->ops->nvgetlength = vector_length;
    v->ops->nvlinearsum = vector_linear_sum;
    v->ops->nvlinearcombination = vector_linear_combination;
    v->ops->nvwrmsnorm = vector_wrms_norm;
    v->ops->nvscale = vector_scale;
    v->ops->nvconst = vector_const;
    v->ops->nvdiv = vector_div;
    v->ops->nvabs = vector_abs;
    v->ops->nvinv = vector_inv;
    v->ops->nvaddconst = vector_add_const;
    v->ops->nvmaxnorm = vector_max_norm;
    v->content = content_new(vector_operations);
    if (v->content == NULL) {
        N_VFreeEmpty(v);
        return NULL;
    }
    vector_const(0.0, v);
    return v;
}
