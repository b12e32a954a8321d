// Motion of the pockets' walls by the modes of a half: see elastic_half.h for the equations.
#include "elastic_half.h"

// Beyond the split the wall moves as at the split.
void elastic_wall_places(const ElasticHalf *half, int side, int j, int near, wide n_x, wide n_t,
                         WallPlaces *at)
{
    const wide along = wide_abs(n_t), zero = wide_set(0.0), one = wide_set(1.0);
    const wide chi = wide_max(wide_atan(side * n_x / wide_max(along, wide_set(1e-30))), zero);
    wide_store(&at->n_x[j], n_x);
    wide_store(&at->n_t[j], n_t);
    wide_store(&at->chi[j], chi);
    wide_store(&at->lower[j], zero);
    wide_store(&at->step[j], zero);
    wide_store(&at->inv_step[j], zero);
    for (int k = j; near != 0 && k < Z; near >>= 1, k++) {
        if (!(near & 1)) continue;
        int node = 0;
        while (node < half->nodes - 2 && scalar_value(at->chi[k]) >= half->chi[node + 1]) node++;
        at->node[k] = node;
        at->back[k] = scalar_value(at->n_t[k]) < 0.0, at->inside[k] = scalar_value(at->n_x[k]) * side > 0.0;
        at->lower[k] = half->chi[node], at->step[k] = half->step[node],
        at->inv_step[k] = half->inv_step[node];
    }
    const wide lower = wide_load(&at->lower[j]), step = wide_load(&at->step[j]),
               inv_step = wide_load(&at->inv_step[j]);
    const wide u = (chi - lower) * inv_step, v = one - u;
    const wide value[4] = {v * v * (1.0 + 2.0 * u), step * u * v * v, u * u * (1.0 + 2.0 * v),
                           -step * u * u * v};
    const wide slope[4] = {-6.0 * u * v * inv_step, v * (v - 2.0 * u), 6.0 * u * v * inv_step,
                           u * (u - 2.0 * v)};
    for (int t = 0; t < 4; t++) {
        wide_store(&at->value[t][j], value[t]);
        wide_store(&at->slope[t][j], slope[t]);
    }
}

// Sign of the real (0) and the imaginary part (1) of component c on that side of the pocket and of the split.
INLINE double wall_sign(bool back, int side, int c, int part)
{
    const double mirrored = back && (c == 2) == (part == 0) ? -1.0 : 1.0;
    return c == 0 ? side * mirrored : mirrored;
}

// Eight sums side by side, and all of them together, in one order for every lane width.
enum { PARTS = 8 / LANE_WIDTH };

INLINE scalar all_sums(const wide sums[PARTS])
{
    scalar part[8];
    for (int i = 0; i < PARTS; i++) wide_store(&part[i * LANE_WIDTH], sums[i]);
    return ((part[0] + part[1]) + (part[2] + part[3])) + ((part[4] + part[5]) + (part[6] + part[7]));
}

// Motions of a wall along the contact's normal by a few modes side by side.
typedef struct {
    const double (*from)[3][2][MODES], (*wave)[MODES];
    wide weight[2][2][4];  // [part][x, t][term]
} NormalMotion;

INLINE NormalMotion normal_motion(const ElasticHalf *half, int side, int j, const WallPlaces *at)
{
    NormalMotion n = {half->wall[at->node[j]], half->wave[j], {{{wide_set(0.0)}}}};
    for (int part = 0; part < 2; part++)
        for (int c = 0; c < 2; c++)
            for (int t = 0; t < 4; t++)
                n.weight[part][c][t] = wide_set(wall_sign(at->back[j], side, 2 * c, part) *
                                                (c == 0 ? at->n_x[j] : at->n_t[j]) * at->value[t][j]);
    return n;
}

// By the modes from m on.
INLINE wide normal_motions(const NormalMotion *n, int m)
{
    wide u[2];
    for (int part = 0; part < 2; part++) {
        wide by[2] = {wide_set(0.0), wide_set(0.0)};
        for (int t = 0; t < 4; t++)
            for (int c = 0; c < 2; c++)
                by[c] = wide_fma(n->weight[part][c][t], wide_load(&n->from[t][2 * c][part][m]), by[c]);
        u[part] = by[0] + by[1];
    }
    return wide_fma(u[0], wide_load(&n->wave[0][m]), u[1] * wide_load(&n->wave[1][m]));
}

scalar elastic_wall_normal(const ElasticHalf *half, int side, int j, const WallPlaces *at, const scalar *q)
{
    const NormalMotion normal = normal_motion(half, side, j, at);
    wide sums[PARTS];
    for (int i = 0; i < PARTS; i++) sums[i] = wide_set(0.0);
    for (int block = 0; block < half->blocks; block++)
        for (int i = 0; i < PARTS; i++) {
            const int m = 8 * block + i * LANE_WIDTH;
            sums[i] = wide_fma(normal_motions(&normal, m), wide_load(&q[m]), sums[i]);
        }
    return all_sums(sums);
}

void elastic_wall_shape(const ElasticHalf *half, int side, int j, const WallPlaces *at, scalar *shape)
{
    const NormalMotion normal = normal_motion(half, side, j, at);
    for (int m = 0; m < 8 * half->blocks; m += LANE_WIDTH) wide_store(&shape[m], normal_motions(&normal, m));
}

void elastic_wall(const ElasticHalf *half, int side, int j, const WallPlaces *at, const scalar *q,
                  const scalar *q_dot, scalar S, WallMotion *wall, WallShape *shape)
{
    const double (*from)[3][2][MODES] = half->wall[at->node[j]];
    const double turn = at->inside[j] ? (at->back[j] ? -side : side) : 0.0;

    // motion of a component by the value's weights; the normal's turn n_t u_x - n_x u_t + turn (n_x u_chi,x + n_t u_chi,t)
    wide value[4], tilted[3][4], rates[3][PARTS], tilts[PARTS];
    for (int t = 0; t < 4; t++) {
        const scalar n_x = at->n_x[j], n_t = at->n_t[j], slope = turn * at->slope[t][j];
        value[t] = wide_set(at->value[t][j]);
        tilted[0][t] = wide_set(n_t * at->value[t][j] + n_x * slope);
        tilted[2][t] = wide_set(n_t * slope - n_x * at->value[t][j]);
    }
    for (int i = 0; i < PARTS; i++) rates[0][i] = rates[1][i] = rates[2][i] = tilts[i] = wide_set(0.0);
    for (int block = 0; block < half->blocks; block++)
        for (int i = 0; i < PARTS; i++) {
            const int m = 8 * block + i * LANE_WIDTH;
            const wide wave[2] = {wide_load(&half->wave[j][0][m]), wide_load(&half->wave[j][1][m])};
            wide tilt = wide_set(0.0);
            for (int c = 0; c < 3; c++) {
                wide motion = wide_set(0.0);
                for (int part = 0; part < 2; part++) {
                    const wide signed_wave = wall_sign(at->back[j], side, c, part) * wave[part];
                    wide u = wide_set(0.0), turned = wide_set(0.0);
                    for (int t = 0; t < 4; t++) {
                        const wide A = wide_load(&from[t][c][part][m]);
                        u = wide_fma(value[t], A, u);
                        if (c != 1) turned = wide_fma(tilted[c][t], A, turned);
                    }
                    motion = wide_fma(u, signed_wave, motion);
                    if (c != 1) tilt = wide_fma(turned, signed_wave, tilt);
                }
                wide_store(&shape->motion[c][m], motion);
                rates[c][i] = wide_fma(motion, wide_load(&q_dot[m]), rates[c][i]);
            }
            tilts[i] = wide_fma(tilt, wide_load(&q[m]), tilts[i]);
        }
    for (int c = 0; c < 3; c++) wall->u_dot[c][j] = all_sums(rates[c]);
    wall->tilt[j] = all_sums(tilts) / S;
}
