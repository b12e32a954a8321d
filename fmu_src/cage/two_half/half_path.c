// Loads of bonded joints: see half_path.h for the equations.
#include "cage/two_half/half_path.h"

#include "numbers/octet.h"

enum { TERMS = 6, NODE = TERMS * Z * ROWS };  // of a node: terms, numbers of all terms

_Static_assert(ROWS == 8, "the rows of a joint are an octet");

// Weight of the radius `node` at the place r, Lagrange's polynomial.
static scalar radius_weight(const HalfPath *path, scalar r, int node)
{
    const double *at = path->radius;
    scalar weight = 1.0;
    r = scalar_min(scalar_max(r, at[0]), at[path->radii - 1]);
    for (int i = 0; i < path->radii; i++)
        if (i != node) weight *= (r - at[i]) / (at[node] - at[i]);
    return weight;
}

// Adds the rows of all joints by the touched pocket j: its node in the table and the next one, on one radius.
static void add_touch(const HalfPath *path, int side, const PathForces *on, scalar chi, int j, int radius,
                      octet joint[Z])
{
    const bool back = scalar_value(on->push_t[j]) < 0.0;
    int i = 0;
    if (path->radii > 0 && scalar_value(chi) < path->chi[0]) chi = path->chi[0];
    while (i < path->nodes - 2 && scalar_value(chi) >= path->chi[i + 1]) i++;
    const double h = path->chi[i + 1] - path->chi[i];
    const scalar u = (chi - path->chi[i]) / h, v = 1.0 - u;
    const scalar spline[4] = {v * v * (1.0 + 2.0 * u), h * u * v * v, u * u * (1.0 + 2.0 * v),
                              -h * u * u * v};
    const scalar force[3] = {side * on->F_x[j], on->F_r[j], back ? -on->F_t[j] : on->F_t[j]};
    const float *node = path->rows + ((2 * radius + back) * path->nodes + i) * NODE;
    scalar weight[2 * TERMS];
    for (int n = 0; n < 4; n++)
        for (int f = 0; f < 3; f++) weight[3 * n + f] = spline[n] * force[f];
    if (path->radii > 0) {
        const scalar part = radius_weight(path, on->radius[j], radius);
        for (int n = 0; n < 2 * TERMS; n++) weight[n] *= part;
    }
    for (int k = 0; k < Z; k++) {
        octet rows = joint[(j + k) % Z];
        for (int t = 0; t < 2 * TERMS; t++) octet_add_floats(weight[t], node + (t * Z + k) * ROWS, &rows);
        joint[(j + k) % Z] = rows;
    }
}

bool half_path_rows(const HalfPath *path, const PathForces on[2], ball_array rows[ROWS])
{
    octet joint[Z];
    bool touched = false;
    for (int h = 0; h < 2; h++) {
        for (int p = 0; p < PACKETS; p++) {
            const int first = p * LANE_WIDTH;
            const wide size = wide_abs(wide_load(&on[h].F_x[first])) +
                              wide_abs(wide_load(&on[h].F_r[first])) + wide_abs(wide_load(&on[h].F_t[first]));
            int mask = wide_mask(wide_above(size, 0.0));  // of the touched pockets
            scalar chi[LANE_WIDTH];
            if (mask == 0) continue;
            const wide push_x = wide_abs(wide_load(&on[h].push_x[first])),
                       push_t = wide_abs(wide_load(&on[h].push_t[first]));
            wide_store(chi, wide_atan(push_x / wide_max(push_t, wide_set(1e-30))));
            for (int j = first; mask != 0 && j < Z; mask >>= 1, j++) {
                if (!(mask & 1)) continue;
                if (!touched) memset(joint, 0, sizeof joint);
                touched = true;
                for (int radius = 0; radius < (path->radii > 0 ? path->radii : 1); radius++)
                    add_touch(path, 2 * h - 1, &on[h], chi[j - first], j, radius, joint);
            }
        }
        if (h == 0 && touched)  // of the mirrored forces
            for (int k = 0; k < Z; k++) {
                joint[k].x[ROW_V_R] = -joint[k].x[ROW_V_R];
                joint[k].x[ROW_V_T] = -joint[k].x[ROW_V_T];
            }
    }
    if (!touched) return false;
    for (int i = 0; i < ROWS; i++) {
        for (int k = 0; k < Z; k++) rows[i][k] = joint[k].x[i];
        for (int k = Z; k < LANES; k++) rows[i][k] = 0.0;  // padding
    }
    return true;
}

void half_path_add_lands(const LandPath *path, const scalar *re[2], const scalar *im[2],
                         ball_array rows[ROWS])
{
    octet joint[Z];
    memset(joint, 0, sizeof joint);
    for (int n = 0; n < LAND_WAVES; n++) {
        // amplitudes of cos n theta and of sin n theta
        octet with_cos = {{0.0}}, with_sin = {{0.0}};
        for (int each = 0; each < LAND_EACH; each++) {
            const int p = land_harmonic(n, each), h = p < 0 ? -p : p;
            const double sign = p < 0 ? -1.0 : 1.0, (*row)[ROWS] = path->row[n][each];
            const scalar by_re[2] = {re[1][h] + re[0][h], re[1][h] - re[0][h]};
            const scalar by_im[2] = {sign * (im[1][h] + im[0][h]), sign * (im[1][h] - im[0][h])};
            for (int apart = 0; apart < 2; apart++) {
                octet_add_from(by_re[apart], row[apart], &with_cos);
                octet_add_from(by_im[apart], row[2 + apart], &with_cos);
                octet_add_from(by_im[apart], row[apart], &with_sin);
                octet_add_from(-by_re[apart], row[2 + apart], &with_sin);
            }
        }
        for (int k = 0; k < Z; k++) {
            octet_add(path->wave[n][0][k], &with_cos, &joint[k]);
            octet_add(path->wave[n][1][k], &with_sin, &joint[k]);
        }
    }
    for (int i = 0; i < ROWS; i++)
        for (int k = 0; k < Z; k++) rows[i][k] += joint[k].x[i];
}
