#include "jacobian.h"

#include "tangent.h"

void jacobian_product(const Model *model, double t, const double *y, const double *dy, const RingLoad *d_ring_load, double *dy_dot, Work *dw)
{
    tangent_rhs(model, t, y, dy, (const double *)d_ring_load, dy_dot, (double *)dw);
}

void jacobian_matrix(const Model *model, double t, const double *y, double *J)
{
    for (int j = 0; j < N_STATES; j++) {
        double dy[N_STATES] = {0.0};
        dy[j] = 1.0;
        tangent_rhs(model, t, y, dy, NULL, &J[j * N_STATES], NULL);
    }
}

void jacobian_outputs(const Model *model, const InputTrajectory *trajectory, double t, double dt, const Inputs *du, const double *y, const double *dy,
                      Outputs *d_out)
{
    tangent_outputs(model, (const double *)trajectory, t, dt, (const double *)du, y, dy, (double *)d_out);
}

void jacobian_housing(const Work *w, const Work *dw, double dF[3], double dM[3])
{
    tangent_housing((const double *)w, (const double *)dw, dF, dM);
}
