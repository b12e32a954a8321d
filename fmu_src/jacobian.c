// Derivatives of the right-hand side, from the rates that the elements leave in Work.
#include "jacobian.h"

void jacobian_diagonal(const Model *model, const Work *w, double *D)
{
    memset(D, 0, N_STATES * sizeof *D);
    const double *ball[] = {w->D_x, w->D_r, w->D_t, w->D_omega_x, w->D_omega_r, w->D_omega_t};
    for (int i = 0; i < 6; i++) memcpy(&D[Y_BALL_V_X + i * Z], ball[i], Z * sizeof *D);
    if (model->p->scene.cage == CAGE_MODEL_TWO_HALF) {
        memcpy(&D[Y_JOINT_PLATE_Y], w->D_plate, Z * sizeof *D);
        memcpy(&D[Y_JOINT_PLATE_Z], w->D_plate, Z * sizeof *D);
        memcpy(&D[Y_JOINT_HEAD_Y], w->D_head, Z * sizeof *D);
        memcpy(&D[Y_JOINT_HEAD_Z], w->D_head, Z * sizeof *D);
    }
    for (int h = 0; h < 2; h++) {
        D[Y_CAGE_V_Y + h] = w->D_cage_y[h];
        D[Y_CAGE_V_Z + h] = w->D_cage_z[h];
        D[Y_CAGE_BETA_DOT + h] = w->D_beta[h];
        D[Y_CAGE_GAMMA_DOT + h] = w->D_gamma[h];
        D[Y_CAGE_S + h] = w->D_spin[h];
    }
}

