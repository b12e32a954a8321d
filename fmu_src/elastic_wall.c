// Motion of the pockets' walls by the modes of a half: see elastic_half.h for the equations.
#include "elastic_half.h"

// A place on a wall: its side, the node below it, weights of the cubics for the value and the slope over the angle.
typedef struct {
    bool back, inside;
    int node;
    scalar value[4], slope[4];
} WallPlace;

// Beyond the split the wall moves as at the split.
INLINE WallPlace wall_place(const ElasticHalf *half, int side, scalar n_x, scalar n_t)
{
    WallPlace at = {.back = scalar_value(n_t) < 0.0, .inside = scalar_value(n_x) * side > 0.0};
    const wide along = wide_abs(wide_set(n_t));
    const scalar angle = wide_lane(wide_atan(wide_set(side * n_x) / wide_max(along, wide_set(1e-30))), 0);
    const scalar chi = at.inside ? angle : 0.0;
    while (at.node < half->nodes - 2 && scalar_value(chi) >= half->chi[at.node + 1]) at.node++;
    const double h = half->chi[at.node + 1] - half->chi[at.node];
    const scalar u = (chi - half->chi[at.node]) / h, v = 1.0 - u;
    at.value[0] = v * v * (1.0 + 2.0 * u), at.value[1] = h * u * v * v;
    at.value[2] = u * u * (1.0 + 2.0 * v), at.value[3] = -h * u * u * v;
    at.slope[0] = -6.0 * u * v / h, at.slope[1] = v * (v - 2.0 * u);
    at.slope[2] = 6.0 * u * v / h, at.slope[3] = u * (u - 2.0 * v);
    return at;
}

// Sign of the real (0) and the imaginary part (1) of component c on that side of the pocket and of the split.
INLINE double wall_sign(const WallPlace *at, int side, int c, int part)
{
    const double mirrored = at->back && (c == 2) == (part == 0) ? -1.0 : 1.0;
    return c == 0 ? side * mirrored : mirrored;
}

scalar elastic_wall_normal(const ElasticHalf *half, int side, int j, const scalar *q, scalar n_x, scalar n_t)
{
    const WallPlace at = wall_place(half, side, n_x, n_t);
    const double (*from)[3][2][MODES] = half->wall[at.node];
    wide weight[2][2][4];  // [part][x, t][term]
    for (int part = 0; part < 2; part++)
        for (int c = 0; c < 2; c++)
            for (int t = 0; t < 4; t++)
                weight[part][c][t] =
                    wide_set(wall_sign(&at, side, 2 * c, part) * (c == 0 ? n_x : n_t) * at.value[t]);
    scalar along[MODES];
    for (int m = 0; m < 8 * half->blocks; m += LANE_WIDTH) {
        wide sum[2];
        for (int part = 0; part < 2; part++) {
            sum[part] = wide_set(0.0);
            for (int t = 0; t < 4; t++)
                for (int c = 0; c < 2; c++)
                    sum[part] = wide_fma(weight[part][c][t], wide_load(&from[t][2 * c][part][m]), sum[part]);
        }
        wide_store(&along[m], wide_fma(sum[0], wide_load(&half->wave[j][0][m]),
                                       sum[1] * wide_load(&half->wave[j][1][m])));
    }
    return elastic_sum(half, along, q);
}

void elastic_wall(const ElasticHalf *half, int side, int j, const scalar *q, const scalar *q_dot, scalar n_x,
                  scalar n_t, scalar S, WallMotion *wall, WallShape *shape)
{
    // motions of all modes there, and their slopes over the angle
    const WallPlace place = wall_place(half, side, n_x, n_t);
    const double (*from)[3][2][MODES] = half->wall[place.node];
    scalar turned[3][MODES];
    for (int c = 0; c < 3; c++) {
        const double re = wall_sign(&place, side, c, 0), im = wall_sign(&place, side, c, 1);
        for (int m = 0; m < 8 * half->blocks; m += LANE_WIDTH) {
            wide at[2], more[2];
            for (int part = 0; part < 2; part++) {
                at[part] = more[part] = wide_set(0.0);
                for (int t = 0; t < 4; t++) {
                    const wide A = wide_load(&from[t][c][part][m]);
                    at[part] = wide_fma(wide_set(place.value[t]), A, at[part]);
                    more[part] = wide_fma(wide_set(place.slope[t]), A, more[part]);
                }
            }
            const wide e = re * wide_load(&half->wave[j][0][m]), o = im * wide_load(&half->wave[j][1][m]);
            wide_store(&shape->motion[c][m], wide_fma(at[0], e, at[1] * o));
            wide_store(&turned[c][m], wide_fma(more[0], e, more[1] * o));
        }
    }

    scalar u_chi[3];
    for (int c = 0; c < 3; c++) {
        wall->u_dot[c][j] = elastic_sum(half, shape->motion[c], q_dot);
        u_chi[c] = elastic_sum(half, turned[c], q);
    }
    const scalar u_x = elastic_sum(half, shape->motion[0], q), u_t = elastic_sum(half, shape->motion[2], q);
    const double turn = place.inside ? (place.back ? -side : side) : 0.0;
    wall->tilt[j] = (n_t * u_x - n_x * u_t + turn * (n_x * u_chi[0] + n_t * u_chi[2])) / S;
}
