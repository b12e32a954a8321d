// Motion of the pockets' walls by the modes of a half: see elastic_half.h for the equations.
#include "cage/elastic/elastic_half.h"

// The cubic over the angle chi: node below, weights of (value, slope, next value, next slope) for the value and for the slope.
INLINE void wall_cubic(const ElasticHalf *half, wide chi, int below[LANE_WIDTH], wide value[4], wide slope[4])
{
    wide node = wide_set(0.0), lower = wide_set(half->chi[0]), step = wide_set(half->step[0]),
         inv_step = wide_set(half->inv_step[0]);
    for (int n = 1; n < half->nodes - 1; n++) {
        const bits beyond = wide_above(chi, half->chi[n]);
        node = wide_select(beyond, wide_set(n), node);
        lower = wide_select(beyond, wide_set(half->chi[n]), lower);
        step = wide_select(beyond, wide_set(half->step[n]), step);
        inv_step = wide_select(beyond, wide_set(half->inv_step[n]), inv_step);
    }
    scalar number[LANE_WIDTH];
    wide_store(number, node);
    for (int i = 0; i < LANE_WIDTH; i++) below[i] = (int)scalar_value(number[i]);
    const wide u = (chi - lower) * inv_step, v = 1.0 - u;
    value[0] = v * v * (1.0 + 2.0 * u), value[1] = step * u * v * v;
    value[2] = u * u * (1.0 + 2.0 * v), value[3] = -step * u * u * v;
    slope[0] = -6.0 * u * v * inv_step, slope[1] = v * (v - 2.0 * u);
    slope[2] = 6.0 * u * v * inv_step, slope[3] = u * (u - 2.0 * v);
}

// Beyond the split the wall moves as at the split.
void elastic_wall_places(const ElasticHalf *half, int side, int j, wide n_x, wide n_t, WallPlaces *at)
{
    const wide along = wide_abs(n_t);
    const wide chi = wide_max(wide_atan(side * n_x / wide_max(along, wide_set(1e-30))), wide_set(0.0));
    int below[LANE_WIDTH];
    wide value[4], slope[4];
    wall_cubic(half, chi, below, value, slope);
    wide_store(&at->n_x[j], n_x);
    wide_store(&at->n_t[j], n_t);
    for (int i = 0, k = j; i < LANE_WIDTH && k < Z; i++, k++) {
        at->node[k] = below[i];
        at->back[k] = scalar_value(at->n_t[k]) < 0.0, at->inside[k] = scalar_value(at->n_x[k]) * side > 0.0;
    }
    for (int t = 0; t < 4; t++) {
        wide_store(&at->value[t][j], value[t]);
        wide_store(&at->slope[t][j], slope[t]);
    }
}

// The coordinates a' and b' in pocket j of the coordinates q from m on: those of a pair turned by nu.
INLINE void wall_turned(const ElasticHalf *half, int j, int m, const scalar *q, wide to[2])
{
    const double (*turn)[ENTRIES] = half->turn[j];
    const wide a = wide_load(&q[m]), b = wide_load(&q[half->count[0] + m]), sin_nu = wide_load(&turn[2][m]);
    to[0] = wide_fma(wide_load(&turn[0][m]), a, sin_nu * b);
    to[1] = wide_fma(wide_load(&turn[1][m]), b, -sin_nu * a);
}

// And back, for forces by a' and b'.
INLINE void wall_turned_back(const ElasticHalf *half, int j, int m, const wide by[2], wide to[2])
{
    const double (*turn)[ENTRIES] = half->turn[j];
    const wide sin_nu = wide_load(&turn[2][m]);
    to[0] = wide_fma(wide_load(&turn[0][m]), by[0], -sin_nu * by[1]);
    to[1] = wide_fma(wide_load(&turn[1][m]), by[1], sin_nu * by[0]);
}

// On the side t < 0 of a pocket the motions along t by the real parts a' have the other sign, and all motions by the imaginary parts b'.
INLINE double wall_sign(bool back)
{
    return back ? -1.0 : 1.0;
}

void elastic_wall_shape(const ElasticHalf *half, int side, int j, const WallPlaces *at, mode_array shape)
{
    const double (*from)[3][2][ENTRIES] = half->wall[at->node[j]], sign = wall_sign(at->back[j]);
    const scalar n_x = side * at->n_x[j], n_t = sign * at->n_t[j];
    scalar b[ENTRIES];
    for (int m = 0; m < ENTRIES; m += LANE_WIDTH) {
        wide by[2], to[2];
        for (int part = 0; part < 2; part++) {
            wide along_x = wide_set(0.0), along_t = wide_set(0.0);
            for (int t = 0; t < 4; t++) {
                along_x = wide_fma(wide_set(n_x * at->value[t][j]), wide_load(&from[t][0][part][m]), along_x);
                along_t = wide_fma(wide_set(n_t * at->value[t][j]), wide_load(&from[t][2][part][m]), along_t);
            }
            by[part] = along_x + along_t;
        }
        by[1] *= sign;
        wall_turned_back(half, j, m, by, to);
        wide_store(&shape[m], to[0]);
        wide_store(&b[m], to[1]);
    }
    memcpy(&shape[half->count[0]], b, ENTRIES * sizeof *b);
}

void elastic_wall(const ElasticHalf *half, int side, int j, const WallPlaces *at, const scalar *q,
                  const scalar *q_dot, scalar S, WallMotion *wall, WallShape *shape)
{
    const double (*from)[3][2][ENTRIES] = half->wall[at->node[j]];
    const double sign = wall_sign(at->back[j]), signs[3] = {side, 1.0, sign};
    const double inward = at->inside[j] ? sign * side : 0.0;

    // motion of a component by the value's weights; the normal's turn n_t u_x - n_x u_t + inward (n_x u_chi,x + n_t u_chi,t)
    const wide n_x = wide_set(at->n_x[j]), n_t = wide_set(at->n_t[j]);
    wide value[3][4], slope[2][4], rates[3][EIGHTHS], tilts[EIGHTHS];
    for (int t = 0; t < 4; t++) {
        const scalar along = inward * at->slope[t][j];
        for (int c = 0; c < 3; c++) value[c][t] = wide_set(signs[c] * at->value[t][j]);
        slope[0][t] = wide_set(side * at->n_x[j] * along);
        slope[1][t] = wide_set(sign * at->n_t[j] * along);
    }
    shape->by_b = sign;
    for (int i = 0; i < EIGHTHS; i++) rates[0][i] = rates[1][i] = rates[2][i] = tilts[i] = wide_set(0.0);
    for (int block = 0; block < ENTRY_OCTETS; block++)
        for (int i = 0; i < EIGHTHS; i++) {
            const int m = 8 * block + i * LANE_WIDTH;
            wide place[2], rate[2];
            wall_turned(half, j, m, q, place);
            wall_turned(half, j, m, q_dot, rate);
            place[1] *= sign, rate[1] *= sign;
            for (int part = 0; part < 2; part++) {
                wide u[3];
                for (int c = 0; c < 3; c++) {
                    u[c] = wide_set(0.0);
                    for (int t = 0; t < 4; t++)
                        u[c] = wide_fma(value[c][t], wide_load(&from[t][c][part][m]), u[c]);
                    wide_store(&shape->motion[c][part][m], u[c]);
                    rates[c][i] = wide_fma(u[c], rate[part], rates[c][i]);
                }
                wide tilt = n_t * u[0] - n_x * u[2];
                if (at->inside[j])
                    for (int t = 0; t < 4; t++) {
                        tilt = wide_fma(slope[0][t], wide_load(&from[t][0][part][m]), tilt);
                        tilt = wide_fma(slope[1][t], wide_load(&from[t][2][part][m]), tilt);
                    }
                tilts[i] = wide_fma(tilt, place[part], tilts[i]);
            }
        }
    for (int c = 0; c < 3; c++) wall->u_dot[c][j] = wide_eight_sum(rates[c]);
    wall->tilt[j] = wide_eight_sum(tilts) / S;
}

void elastic_wall_force(const ElasticHalf *half, int j, const WallShape *shape, const scalar F[3],
                        mode_array modal)
{
    scalar b[ENTRIES], *modal_b = &modal[half->count[0]];
    for (int m = 0; m < ENTRIES; m += LANE_WIDTH) {
        wide by[2], to[2];
        for (int part = 0; part < 2; part++)
            by[part] = F[0] * wide_load(&shape->motion[0][part][m]) +
                       F[1] * wide_load(&shape->motion[1][part][m]) +
                       F[2] * wide_load(&shape->motion[2][part][m]);
        by[1] *= shape->by_b;
        wall_turned_back(half, j, m, by, to);
        wide_store(&modal[m], wide_load(&modal[m]) + to[0]);
        wide_store(&b[m], to[1]);
    }
    for (int m = 0; m < ENTRIES; m += LANE_WIDTH)
        wide_store(&modal_b[m], wide_load(&modal_b[m]) + wide_load(&b[m]));
}

// ---- ribbons --------------------------------------------------------------------------------------------------------
// Factors of the motions (x, r, t) by the real parts a' and the imaginary parts b' at a place of the part `front`; its slopes over this
// part, of x times the side.
#define RIBBON_SIGNS(side, front) {{side, (side) * (front)}, {1.0, front}, {front, 1.0}}

static const double SLOPE[3][2] = {{0.0, 1.0}, {0.0, 1.0}, {1.0, 0.0}};

void ribbon_wall_nodes(const ElasticHalf *half, wide chi, wide radius, wide front, RibbonNodes *nodes)
{
    int below[LANE_WIDTH];
    wide value[4], slope[4];
    wall_cubic(half, chi, below, value, slope);
    wide along[WALL_RADII] = {wide_set(1.0)}, along_slope[WALL_RADII] = {wide_set(0.0)};
    if (half->radii > 1) {
        const double *at = half->radius;
        const wide r = wide_min(wide_max(radius, wide_set(at[0])), wide_set(at[WALL_RADII - 1]));
        const bits within = wide_above(wide_min(radius - at[0], at[WALL_RADII - 1] - radius), 0.0);
        for (int a = 0; a < WALL_RADII; a++) {
            const double b = at[(a + 1) % WALL_RADII], c = at[(a + 2) % WALL_RADII];
            along[a] = (r - b) * (r - c) * half->per_gaps[a];
            along_slope[a] = wide_select(within, (2.0 * r - b - c) * half->per_gaps[a], wide_set(0.0));
        }
    }
    for (int i = 0; i < LANE_WIDTH; i++) nodes->node[i] = below[i];
    wide_store(nodes->front, front);
    for (int t = 0; t < 4; t++) {
        wide_store(nodes->value[t], value[t]);
        wide_store(nodes->slope[t], slope[t]);
    }
    for (int a = 0; a < half->radii; a++) {
        wide_store(nodes->along[a], along[a]);
        wide_store(nodes->along_slope[a], along_slope[a]);
        for (int t = 0; t < 4; t++) wide_store(nodes->row[a][t], along[a] * value[t]);
    }
}

// Motions (x, r, t) by a few a' (part 0) and b' (1) side by side, without their signs.  radii: that of the half, where it is
// written as a constant the loops are unrolled.
INLINE void ribbon_motions(const ElasticHalf *half, int radii, const RibbonNodes *nodes, int lane, int m,
                           wide u[3][2])
{
    for (int c = 0; c < 3; c++) u[c][0] = u[c][1] = wide_set(0.0);
    for (int a = 0; a < radii; a++) {
        const double (*from)[3][2][ENTRIES] = half->wall[a * half->nodes + nodes->node[lane]];
        for (int t = 0; t < 4; t++) {
            const wide part = wide_set(nodes->row[a][t][lane]);
            for (int c = 0; c < 3; c++) {
                u[c][0] = wide_fma(part, wide_load(&from[t][c][0][m]), u[c][0]);
                u[c][1] = wide_fma(part, wide_load(&from[t][c][1][m]), u[c][1]);
            }
        }
    }
}

void ribbon_alike(const ElasticHalf *half, const scalar *q, ribbon_motions_alike alike)
{
    for (int row = 0; row < half->radii * half->nodes; row++)
        for (int part = 0; part < 8; part += LANE_WIDTH) {
            wide sum = wide_set(0.0);
            for (int i = 0; i < half->uniforms; i++)
                sum = wide_fma(wide_set(q[half->uniform_at[i]]), wide_load(&half->alike[i][row][part]), sum);
            wide_store(&alike[row][0][0] + part, sum);
        }
}

void ribbon_wall_alike(const ElasticHalf *half, int side, const RibbonNodes *nodes, int lane,
                       ribbon_motions_alike alike, scalar u[3])
{
    const scalar front = nodes->front[lane], sign[3][2] = RIBBON_SIGNS(side, front);
    u[0] = u[1] = u[2] = 0.0;
    for (int a = 0; a < half->radii; a++) {
        scalar(*from)[4] = alike[a * half->nodes + nodes->node[lane]];
        for (int t = 0; t < 4; t++)
            for (int c = 0; c < 3; c++) u[c] += nodes->row[a][t][lane] * from[t][c];
    }
    for (int c = 0; c < 3; c++) u[c] *= sign[c][0];
}

INLINE void moved_by(const ElasticHalf *half, int radii, int side, int j, const RibbonNodes *nodes, int lane,
                     const scalar *q, scalar u[3], WallShape *shape)
{
    const scalar front = nodes->front[lane], sign[3][2] = RIBBON_SIGNS(side, front);
    wide sums[3][EIGHTHS];
    shape->by_b = 1.0;
    for (int c = 0; c < 3; c++)
        for (int i = 0; i < EIGHTHS; i++) sums[c][i] = wide_set(0.0);
    for (int block = 0; block < ENTRY_OCTETS; block++)
        for (int i = 0; i < EIGHTHS; i++) {
            const int m = 8 * block + i * LANE_WIDTH;
            wide place[2], by[3][2];
            wall_turned(half, j, m, q, place);
            ribbon_motions(half, radii, nodes, lane, m, by);
            for (int c = 0; c < 3; c++)
                for (int part = 0; part < 2; part++) {
                    const wide motion = wide_set(sign[c][part]) * by[c][part];
                    wide_store(&shape->motion[c][part][m], motion);
                    sums[c][i] = wide_fma(motion, place[part], sums[c][i]);
                }
        }
    for (int c = 0; c < 3; c++) u[c] = wide_eight_sum(sums[c]);
}

void ribbon_wall_moved(const ElasticHalf *half, int side, int j, const RibbonNodes *nodes, int lane,
                       const scalar *q, scalar u[3], WallShape *shape)
{
    if (half->radii == WALL_RADII)
        moved_by(half, WALL_RADII, side, j, nodes, lane, q, u, shape);
    else
        moved_by(half, 1, side, j, nodes, lane, q, u, shape);
}

// The slopes by the rows of the table: each row's motion along n, once for both.
INLINE void wall_of_radii(const ElasticHalf *half, int radii, int side, int j, const RibbonNodes *nodes,
                          int lane, const WallShape *shape, const scalar n[3], const scalar *q,
                          const scalar *q_dot, scalar u_dot[3], scalar slope[3])
{
    const scalar front = nodes->front[lane], sign[3][2] = RIBBON_SIGNS(side, front);
    wide rates[3][EIGHTHS], over_chi[EIGHTHS], over_radius[EIGHTHS];
    for (int i = 0; i < EIGHTHS; i++)
        rates[0][i] = rates[1][i] = rates[2][i] = over_chi[i] = over_radius[i] = wide_set(0.0);
    for (int block = 0; block < ENTRY_OCTETS; block++)
        for (int i = 0; i < EIGHTHS; i++) {
            const int m = 8 * block + i * LANE_WIDTH;
            wide place[2], rate[2], along[3][2];
            wall_turned(half, j, m, q, place);
            wall_turned(half, j, m, q_dot, rate);
            for (int c = 0; c < 3; c++)
                for (int part = 0; part < 2; part++) {
                    along[c][part] = (sign[c][part] * n[c]) * place[part];
                    rates[c][i] = wide_fma(wide_load(&shape->motion[c][part][m]), rate[part], rates[c][i]);
                }
            for (int a = 0; a < radii; a++) {
                const double (*from)[3][2][ENTRIES] = half->wall[a * half->nodes + nodes->node[lane]];
                wide by_value = wide_set(0.0), by_slope = wide_set(0.0);
                for (int t = 0; t < 4; t++) {
                    wide row = wide_set(0.0);
                    for (int c = 0; c < 3; c++)
                        for (int part = 0; part < 2; part++)
                            row = wide_fma(along[c][part], wide_load(&from[t][c][part][m]), row);
                    by_value = wide_fma(wide_set(nodes->value[t][lane]), row, by_value);
                    by_slope = wide_fma(wide_set(nodes->slope[t][lane]), row, by_slope);
                }
                over_chi[i] = wide_fma(wide_set(nodes->along[a][lane]), by_slope, over_chi[i]);
                over_radius[i] = wide_fma(wide_set(nodes->along_slope[a][lane]), by_value, over_radius[i]);
            }
        }
    for (int c = 0; c < 3; c++) u_dot[c] = wide_eight_sum(rates[c]);
    slope[0] = wide_eight_sum(over_chi);
    slope[1] = wide_eight_sum(over_radius);
}

// Slope of the motion along n over the part `front`.
INLINE scalar over_front(const ElasticHalf *half, int radii, int side, int j, const RibbonNodes *nodes,
                         int lane, const scalar n[3], const scalar *q)
{
    const scalar along[3] = {side * n[0], n[1], n[2]};
    wide sum[EIGHTHS];
    for (int i = 0; i < EIGHTHS; i++) sum[i] = wide_set(0.0);
    for (int block = 0; block < ENTRY_OCTETS; block++)
        for (int i = 0; i < EIGHTHS; i++) {
            const int m = 8 * block + i * LANE_WIDTH;
            wide place[2], by[3][2];
            wall_turned(half, j, m, q, place);
            ribbon_motions(half, radii, nodes, lane, m, by);
            for (int c = 0; c < 3; c++)
                for (int part = 0; part < 2; part++)
                    sum[i] += SLOPE[c][part] * along[c] * (by[c][part] * place[part]);
        }
    return wide_eight_sum(sum);
}

void ribbon_wall(const ElasticHalf *half, int side, int j, const RibbonNodes *nodes, int lane,
                 const WallShape *shape, const scalar n[3], const scalar *q, const scalar *q_dot,
                 scalar u_dot[3], scalar slope[3])
{
    if (half->radii == WALL_RADII)
        wall_of_radii(half, WALL_RADII, side, j, nodes, lane, shape, n, q, q_dot, u_dot, slope);
    else
        wall_of_radii(half, 1, side, j, nodes, lane, shape, n, q, q_dot, u_dot, slope);
    const bool between = fabs(scalar_value(nodes->front[lane])) < 1.0;
    slope[2] = between ? over_front(half, half->radii, side, j, nodes, lane, n, q) : 0.0 * n[0];
}

// Stores the motion along n by a few a' and b', of which (x, r, t) are given, as that by a and b.
INLINE void store_along(const ElasticHalf *half, int j, int m, wide motion[3][2], double by_b,
                        const scalar n[3], scalar *shape, scalar *b)
{
    wide by[2] = {wide_set(0.0), wide_set(0.0)}, to[2];
    for (int part = 0; part < 2; part++)
        for (int c = 0; c < 3; c++) by[part] = wide_fma(wide_set(n[c]), motion[c][part], by[part]);
    by[1] *= by_b;
    wall_turned_back(half, j, m, by, to);
    wide_store(&shape[m], to[0]);
    wide_store(&b[m], to[1]);
}

void ribbon_wall_shape(const ElasticHalf *half, int side, int j, const RibbonNodes *nodes, int lane,
                       const scalar n[3], mode_array shape)
{
    const scalar front = nodes->front[lane], sign[3][2] = RIBBON_SIGNS(side, front);
    scalar b[ENTRIES];
    for (int m = 0; m < ENTRIES; m += LANE_WIDTH) {
        wide motion[3][2];
        ribbon_motions(half, half->radii, nodes, lane, m, motion);
        for (int c = 0; c < 3; c++)
            for (int part = 0; part < 2; part++) motion[c][part] *= wide_set(sign[c][part]);
        store_along(half, j, m, motion, 1.0, n, shape, b);
    }
    memcpy(&shape[half->count[0]], b, ENTRIES * sizeof *b);
}

void elastic_wall_along(const ElasticHalf *half, int j, const WallShape *moved, const scalar n[3],
                        mode_array shape)
{
    scalar b[ENTRIES];
    for (int m = 0; m < ENTRIES; m += LANE_WIDTH) {
        wide motion[3][2];
        for (int c = 0; c < 3; c++)
            for (int part = 0; part < 2; part++) motion[c][part] = wide_load(&moved->motion[c][part][m]);
        store_along(half, j, m, motion, moved->by_b, n, shape, b);
    }
    memcpy(&shape[half->count[0]], b, ENTRIES * sizeof *b);
}
