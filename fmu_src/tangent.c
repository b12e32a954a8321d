// The kernel files once more, in dual numbers: here numbers carry derivatives.
#define DUAL
#define ISA dual
#define LANE_WIDTH 1

#include "tangent.h"

#include "ball.c"
#include "cage_joint.c"
#include "drag.c"
#include "housing.h"
#include "land_film.c"
#include "pocket.c"
#include "race_contact.c"
#include "rhs.c"
#include "ring.c"

enum { DRIVE_NUMBERS = sizeof(Drive) / sizeof(number), WORK_NUMBERS = sizeof(Work) / sizeof(number) };

static void numbers_join(int n, const double *value, const double *derivative, number *x)
{
    for (int i = 0; i < n; i++) x[i] = number_dual(value[i], derivative ? derivative[i] : 0.0);
}
static void numbers_derivative(int n, const number *x, double *derivative)
{
    for (int i = 0; i < n; i++) derivative[i] = number_derivative(x[i]);
}

void tangent_rhs(const Model *model, double t, const double *y, const double *dy, const double *d_drive, double *dy_dot, double *dw)
{
    Drive drive;
    Work work = {0};
    number state[N_STATES], rate[N_STATES];
    const Model dual = {model->p, model->d, &drive};
    numbers_join(DRIVE_NUMBERS, (const double *)model->drive, d_drive, (number *)&drive);
    numbers_join(N_STATES, y, dy, state);
    rhs(&dual, t, state, rate, &work);
    numbers_derivative(N_STATES, rate, dy_dot);
    if (dw) numbers_derivative(WORK_NUMBERS, (const number *)&work, dw);
}

void tangent_housing(const double *w, const double *dw, double dF[3], double dM[3])
{
    Work work;
    number F[3], M[3];
    numbers_join(WORK_NUMBERS, w, dw, (number *)&work);
    housing_reaction(&work, F, M);
    numbers_derivative(3, F, dF);
    numbers_derivative(3, M, dM);
}
