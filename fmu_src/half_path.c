// Loads of bonded joints: see half_path.h for the equations.
#include "half_path.h"

void bolt_group(double d_m, const scalar wrench[6], const double c[Z], const double s[Z], scalar N[Z],
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

enum { TERMS = 6, ROW = TERMS * PATH_WIDTH, NODE = ROWS * ROW };  // numbers of a joint's row by one node

// A touched pocket: its place in the table, and what multiplies values and slopes along x, r, t at the two nodes around it.
typedef struct {
    const double *column;
    scalar weight[2][TERMS];
} Touch;

static Touch touch(const HalfPath *path, int side, const PathForces *on, int j)
{
    const bool back = scalar_value(on->push_t[j]) < 0.0;
    const wide push_x = wide_abs(wide_set(on->push_x[j])), push_t = wide_abs(wide_set(on->push_t[j]));
    const scalar chi = wide_lane(wide_atan(push_x / wide_max(push_t, wide_set(1e-30))), 0);
    int i = 0;
    while (i < path->nodes - 2 && scalar_value(chi) >= path->chi[i + 1]) i++;
    const double h = path->chi[i + 1] - path->chi[i];
    const scalar u = (chi - path->chi[i]) / h, v = 1.0 - u;
    const scalar value[2] = {v * v * (1.0 + 2.0 * u), u * u * (1.0 + 2.0 * v)},
                 slope[2] = {h * u * v * v, -h * u * u * v};
    const scalar force[3] = {side * on->F_x[j], on->F_r[j], back ? -on->F_t[j] : on->F_t[j]};
    Touch t = {.column = path->rows + (back * path->nodes + i) * NODE + Z - 1 - j};
    for (int n = 0; n < 2; n++)
        for (int f = 0; f < 3; f++) {
            t.weight[n][f] = value[n] * force[f];
            t.weight[n][3 + f] = slope[n] * force[f];
        }
    return t;
}

bool half_path_add(const HalfPath *path, int side, const PathForces *on, PathRows *rows)
{
    Touch touches[Z];
    int count = 0;
    for (int j = 0; j < Z; j++) {
        if (on->F_x[j] == 0.0 && on->F_r[j] == 0.0 && on->F_t[j] == 0.0)
            continue;  // most pockets are not touched
        touches[count++] = touch(path, side, on, j);
    }
    if (count == 0) return false;
    for (int n = 0; n < count; n++) {
        wide weight[2][TERMS];
        for (int m = 0; m < TERMS; m++) {
            weight[0][m] = wide_set(touches[n].weight[0][m]);
            weight[1][m] = wide_set(touches[n].weight[1][m]);
        }
        for (int i = 0; i < ROWS; i++) {
            const double sign = i == ROW_V_R || i == ROW_V_T ? side : 1.0, *row = touches[n].column + i * ROW;
            for (int k = 0; k < PACKETS * LANE_WIDTH; k += LANE_WIDTH) {
                wide near = weight[0][0] * wide_load(row + k), far = weight[1][0] * wide_load(row + NODE + k);
                for (int m = 1; m < TERMS; m++) {
                    near = wide_fma(weight[0][m], wide_load(row + m * PATH_WIDTH + k), near);
                    far = wide_fma(weight[1][m], wide_load(row + NODE + m * PATH_WIDTH + k), far);
                }
                wide_store(&rows->row[i][k], wide_load(&rows->row[i][k]) + sign * (near + far));
            }
        }
    }
    return true;
}
