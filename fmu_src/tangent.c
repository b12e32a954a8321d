// The kernel files and the outputs once more, in dual numbers: here numbers carry derivatives.
#define DUAL
#define ISA dual
#define LANE_WIDTH 1

#include "tangent.h"

#include "ball.c"
#include "cage_joint.c"
#include "drag.c"
#include "energy.c"
#include "housing.h"
#include "land_film.c"
#include "load_path.c"
#include "outputs.c"
#include "pocket.c"
#include "race_contact.c"
#include "rhs.c"
#include "ring.c"
#include "rivet_rom.c"
#include "rivets.c"

enum {
    DRIVE_NUMBERS = sizeof(Drive) / sizeof(number),
    COURSE_NUMBERS = sizeof(Course) / sizeof(number),
    WORK_NUMBERS = sizeof(Work) / sizeof(number),
    OUTPUT_NUMBERS = sizeof(Outputs) / sizeof(number)
};

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
    Course course;
    Work work = {0};
    number state[N_STATES], rate[N_STATES];
    const Model dual = {model->p, model->d, &drive, NULL};
    numbers_join(DRIVE_NUMBERS, (const double *)model->drive, NULL, (number *)&drive);
    if (model->course) {
        numbers_join(COURSE_NUMBERS, (const double *)model->course, NULL, (number *)&course);
        drive_at(&course, t, &drive);
    }
    if (d_drive)
        for (int i = 0; i < DRIVE_NUMBERS; i++) ((number *)&drive)[i] += number_dual(0.0, d_drive[i]);
    numbers_join(N_STATES, y, dy, state);
    rhs(&dual, t, state, rate, &work);
    numbers_derivative(N_STATES, rate, dy_dot);
    if (dw) numbers_derivative(WORK_NUMBERS, (const number *)&work, dw);
}

void tangent_outputs(const Model *model, const double *course, double t, double dt, const double *du, const double *y, const double *dy, double *d_out)
{
    Course inputs;
    Drive drive;
    Work work = {0};
    Outputs out = {0};
    number state[N_STATES], rate[N_STATES];
    const Model dual = {model->p, model->d, &drive, NULL};
    numbers_join(COURSE_NUMBERS, course, NULL, (number *)&inputs);
    if (du)
        for (int i = 0; i < N_INPUTS; i++) ((number *)&inputs.u[0])[i] += number_dual(0.0, du[i]);
    drive_at(&inputs, number_dual(t, dt), &drive);
    numbers_join(N_STATES, y, dy, state);
    rhs(&dual, t, state, rate, &work);
    const Evaluation at = {&dual, state, rate, &work, rivets_load};
    for (int group = 0; group < GROUP_COUNT; group++) outputs_evaluate(&at, group, &out);
    numbers_derivative(OUTPUT_NUMBERS, (const number *)&out, d_out);
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
