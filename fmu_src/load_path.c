// Load path of the cage: see load_path.h for the equations.
#include "load_path.h"

void load_path_rigid(double d_m, const scalar wrench[6], const double c[Z], const double s[Z], scalar N[Z],
                     scalar V_y[Z], scalar V_z[Z])
{
    const double R = 0.5 * d_m;
    const scalar shear = wrench[3] / (Z * R);
    for (int k = 0; k < Z; k++) {
        N[k] = wrench[0] / Z + 2.0 * (wrench[4] * s[k] - wrench[5] * c[k]) / (Z * R);
        V_y[k] = wrench[1] / Z - shear * s[k];
        V_z[k] = wrench[2] / Z + shear * c[k];
    }
}

// A touched pocket: its column of the matrix, and its forces as on the +x half with the ball pushing toward
// +t.
typedef struct {
    const double *column;
    scalar F_x, F_r, abs_F_t;
} Touch;

void load_path_flexible(const double *matrix, int side, bool transverse, const scalar F_x[Z],
                        const scalar F_r[Z], const scalar F_t[Z], PathLoads *loads)
{
    // touched pockets
    Touch touch[Z];
    int count = 0;
    for (int j = 0; j < Z; j++) {
        if (F_x[j] == 0.0 && F_r[j] == 0.0 && F_t[j] == 0.0) continue;  // as for most pockets
        const bool back = scalar_value(F_t[j]) < 0.0;
        const double *column = matrix + back * PATH_LOADS * 3 * PATH_WIDTH + Z - 1 - j;
        touch[count++] = (Touch){column, side * F_x[j], F_r[j], back ? -F_t[j] : F_t[j]};
    }

    // loads of all rivets by all touched pockets
    for (int i = 0; i < PATH_LOADS; i++) {
        const bool V = i == PATH_V_R || i == PATH_V_T;
        if (V && !transverse) continue;
        const double sign = V ? side : 1.0;
        for (int k = 0; k < PACKETS * LANE_WIDTH; k += LANE_WIDTH) {
            wide sum = wide_set(0.0);
            for (int n = 0; n < count; n++) {
                const Touch *on = &touch[n];
                const double *row = on->column + i * 3 * PATH_WIDTH + k;
                sum = wide_fma(wide_set(on->F_x), wide_load(row), sum);
                sum = wide_fma(wide_set(on->F_r), wide_load(row + PATH_WIDTH), sum);
                sum = wide_fma(wide_set(on->abs_F_t), wide_load(row + 2 * PATH_WIDTH), sum);
            }
            wide_store(&loads->sum[i][k], wide_load(&loads->sum[i][k]) + sign * sum);
        }
    }
}
