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

void load_path_flexible(const double *matrix, int side, const number F_x[Z], const number F_r[Z], const number F_t[Z], PathLoads *loads)
{
    for (int j = 0; j < Z; j++) {
        if (F_x[j] == 0.0 && F_r[j] == 0.0 && F_t[j] == 0.0) continue;  // most pockets are not touched
        const bool back = number_value(F_t[j]) < 0.0;
        const double turn = back ? -1.0 : 1.0;
        const number outward = side * F_x[j], push = turn * F_t[j];  // mirrored to the +x half
        for (int i = 0; i < Z; i++) {
            const double *m = matrix + 3 * PATH_LOADS * i, *t = back ? matrix + 3 * PATH_LOADS * (Z - 1 - i) : m;
            int k = i + j < Z ? i + j : i + j - Z;
            loads->N[k] += m[0] * outward + m[1] * F_r[j] + t[2] * push;
            loads->V_r[k] += side * (m[3] * outward + m[4] * F_r[j] + t[5] * push);
            loads->V_t[k] += side * (m[6] * outward + m[7] * F_r[j] + turn * t[8] * push);
            loads->M_r[k] += m[9] * outward + m[10] * F_r[j] + turn * t[11] * push;
            loads->M_t[k] += m[12] * outward + m[13] * F_r[j] + t[14] * push;
        }
    }
}
