// Load path of the cage: see load_path.h for the equations.
#include "load_path.h"

void load_path_rigid(double d_m, const number wrench[6], const double c[Z], const double s[Z], number N[Z], number V_y[Z], number V_z[Z])
{
    const double R = 0.5 * d_m;
    const number shear = wrench[3] / (Z * R);
    for (int k = 0; k < Z; k++) {
        N[k] = wrench[0] / Z + 2.0 * (wrench[4] * s[k] - wrench[5] * c[k]) / (Z * R);
        V_y[k] = wrench[1] / Z - shear * s[k];
        V_z[k] = wrench[2] / Z + shear * c[k];
    }
}

// Adds what the forces on one pocket give the rivets beside it and beyond.
static void add_pocket(const double *column, number outward, number along, number push, number *sum)
{
    for (int k = 0; k < PATH_WIDTH; k++) sum[k] += column[k] * outward + column[PATH_WIDTH + k] * along + column[2 * PATH_WIDTH + k] * push;
}

void load_path_flexible(const double *matrix, int side, const number F_x[Z], const number F_r[Z], const number F_t[Z], PathLoads *loads)
{
    number sum[PATH_LOADS][2 * Z] = {0};  // of rivets k and k + Z
    for (int j = 0; j < Z; j++) {
        if (F_x[j] == 0.0 && F_r[j] == 0.0 && F_t[j] == 0.0) continue;  // most pockets are not touched
        const bool back = number_value(F_t[j]) < 0.0;
        const number outward = side * F_x[j], along = F_r[j], push = back ? -F_t[j] : F_t[j];  // on the +x half
        const double *column = matrix + back * PATH_LOADS * 3 * PATH_WIDTH;
        for (int i = 0; i < PATH_LOADS; i++, column += 3 * PATH_WIDTH) add_pocket(column, outward, along, push, &sum[i][j]);
    }
    for (int k = 0; k < Z; k++) {
        loads->N[k] += sum[PATH_N][k] + sum[PATH_N][Z + k];
        loads->V_r[k] += side * (sum[PATH_V_R][k] + sum[PATH_V_R][Z + k]);
        loads->V_t[k] += side * (sum[PATH_V_T][k] + sum[PATH_V_T][Z + k]);
        loads->M_r[k] += sum[PATH_M_R][k] + sum[PATH_M_R][Z + k];
        loads->M_t[k] += sum[PATH_M_T][k] + sum[PATH_M_T][Z + k];
    }
}
