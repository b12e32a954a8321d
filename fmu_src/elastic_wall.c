// Motion of the pockets' walls by the modes of a half: see elastic_half.h for the equations.
#include "elastic_half.h"

void elastic_wall(const ElasticHalf *half, int side, int j, const scalar *q, const scalar *q_dot, scalar n_x,
                  scalar n_t, scalar S, WallMotion *wall, WallShape *shape)
{
    // angle on the wall, from the split; beyond the split the wall moves as at the split
    const bool back = scalar_value(n_t) < 0.0, inside = scalar_value(n_x) * side > 0.0;
    const wide along = wide_abs(wide_set(n_t));
    const scalar angle = wide_lane(wide_atan(wide_set(side * n_x) / wide_max(along, wide_set(1e-30))), 0);
    const scalar chi = inside ? angle : 0.0;
    int node = 0;
    while (node < half->nodes - 2 && scalar_value(chi) >= half->chi[node + 1]) node++;
    const double h = half->chi[node + 1] - half->chi[node];
    const scalar u = (chi - half->chi[node]) / h, v = 1.0 - u;
    const scalar value[4] = {v * v * (1.0 + 2.0 * u), h * u * v * v, u * u * (1.0 + 2.0 * v), -h * u * u * v};
    const scalar slope[4] = {-6.0 * u * v / h, v * (v - 2.0 * u), 6.0 * u * v / h, u * (u - 2.0 * v)};

    // motions of all modes there, and their slopes over the angle
    const double mirror[3][2] = {
        {1.0, back ? -1.0 : 1.0}, {1.0, back ? -1.0 : 1.0}, {back ? -1.0 : 1.0, 1.0}};
    scalar turned[3][MODES];
    for (int c = 0; c < 3; c++) {
        const double sign = c == 0 ? side : 1.0, re = sign * mirror[c][0], im = sign * mirror[c][1];
        const double *w_re = half->wave[j][0], *w_im = half->wave[j][1];
        const double (*from)[3][2][MODES] = half->wall[node], (*to)[3][2][MODES] = half->wall[node + 1];
        for (int m = 0; m < 8 * half->blocks; m += LANE_WIDTH) {
            wide at[2], more[2];
            for (int part = 0; part < 2; part++) {
                const wide A[4] = {wide_load(&from[0][c][part][m]), wide_load(&from[1][c][part][m]),
                                   wide_load(&to[0][c][part][m]), wide_load(&to[1][c][part][m])};
                at[part] = more[part] = wide_set(0.0);
                for (int t = 0; t < 4; t++) {
                    at[part] = wide_fma(wide_set(value[t]), A[t], at[part]);
                    more[part] = wide_fma(wide_set(slope[t]), A[t], more[part]);
                }
            }
            const wide e = re * wide_load(&w_re[m]), o = im * wide_load(&w_im[m]);
            wide_store(&shape->motion[c][m], wide_fma(at[0], e, at[1] * o));
            wide_store(&turned[c][m], wide_fma(more[0], e, more[1] * o));
        }
    }

    scalar u_chi[3];
    for (int c = 0; c < 3; c++) {
        wall->u[c][j] = elastic_sum(half, shape->motion[c], q);
        wall->u_dot[c][j] = elastic_sum(half, shape->motion[c], q_dot);
        u_chi[c] = elastic_sum(half, turned[c], q);
    }
    const scalar u_x = wall->u[0][j], u_t = wall->u[2][j];
    const double turn = inside ? (back ? -side : side) : 0.0;
    wall->tilt[j] = (n_t * u_x - n_x * u_t + turn * (n_x * u_chi[0] + n_t * u_chi[2])) / S;
}
