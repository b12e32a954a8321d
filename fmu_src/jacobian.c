#include "jacobian.h"

#include "tangent.h"

void jacobian_product(const Model *model, double t, const double *y, const double *dy, const Drive *d_drive, double *dy_dot, Work *dw)
{
    tangent_rhs(model, t, y, dy, (const double *)d_drive, dy_dot, (double *)dw);
}

void jacobian_matrix(const Model *model, double t, const double *y, double *J)
{
    for (int j = 0; j < N_STATES; j++) {
        double dy[N_STATES] = {0.0};
        dy[j] = 1.0;
        tangent_rhs(model, t, y, dy, NULL, &J[j * N_STATES], NULL);
    }
}

void jacobian_outputs(const Model *model, const Course *course, double t, double dt, const Inputs *du, const double *y, const double *dy, Outputs *d_out)
{
    tangent_outputs(model, (const double *)course, t, dt, (const double *)du, y, dy, (double *)d_out);
}

void jacobian_housing(const Work *w, const Work *dw, double dF[3], double dM[3])
{
    tangent_housing((const double *)w, (const double *)dw, dF, dM);
}
