// From pocket forces to the loads that bonded joints of elastic halves would carry, and the rigid share of the circle of rivets.
//
// Seen from +X: rivets at body angles 2 pi (k + 1/2)/Z on the circle d_m, pockets at 2 pi j/Z; e_x axial, e_r outward, e_t toward growing angle
// (right-handed x, r, t).
//
//     x ^    ____          chi   angle of the place on the pocket's wall that the ball pushes: 0 at the split, pi/2 at the pocket's bottom
//       |  .'    '.        push  normal part of its force (x, t) on the half: chi = atan(|push_x|/|push_t|)
//       | /  chi ( \.
//       +-----o-----+--> t
//
// A pocket force bends the half between its rivets, which pries at joints although rigid halves carry nothing there.  Static reduction by finite
// elements (rivet_model/half_loads.py): rows of a joint by the force (x, r, t) on pocket 0 of the +x half,
//     N, V_r, V_t, M_r, M_t   of the joint (N, V: beyond what rigid halves carry)
//     dP, dm_r, dm_t          of its rivet beside it, as the half gives under its head: as a change of preload, and bending of its shank
// over chi by cubic Hermite splines, C1; circulant in k - j, as all pockets are alike.  push_t < 0 acts as the mirror image about the pocket does
// (rivet -1 - i for i; V_t, M_r and dm_r change sign), a force on the -x half as its mirror image on the +x half does (V changes sign).
//
// Rigid share: a wrench between two rigid halves on Z equal elastic rivets (bolt group; rivets' own bending stiffness neglected),
//     N_k = F_x/Z + 2 (M_y r_z,k - M_z r_y,k)/(Z R^2),     V_k = (F_y, F_z)/Z + M_x e_t,k/(Z R),    R = d_m/2.
#pragma once

#include "isa.h"

enum { ROW_N, ROW_V_R, ROW_V_T, ROW_M_R, ROW_M_T, ROW_DP, ROW_DM_R, ROW_DM_T, ROWS };

enum {
    PATH_WIDTH = LANES + Z - 1
};  // one row for pocket 0, continued so that those of all pockets are parts of it: rivet k and pocket j at k - j + Z - 1

typedef struct {
    int nodes;
    const double *chi;   // rising from 0 to pi/2 [rad]
    const double *rows;  // [push_t >= 0, < 0][node][ROWS][value, slope][x, r, |t|][PATH_WIDTH]
} HalfPath;

// Rows at all joints [N, N.m].
typedef struct {
    ball_array row[ROWS];
} PathRows;

// Forces on the pockets of one half, in the pockets' frames.
typedef struct {
    const scalar *F_x, *F_r, *F_t, *push_x, *push_t;
} PathForces;

// Adds the rows of the forces on the half at `side`, +1 or -1; returns whether there are any.
bool half_path_add(const HalfPath *path, int side, const PathForces *on, PathRows *rows);

// Wrench (F_x, F_y, F_z, M_x, M_y, M_z) that the rivets must carry from outside onto the +x half, taken at the centre of the circle;
// c[k], s[k]: cosine and sine of the rivets' angles in the frame of the wrench.  Returns N, V_y, V_z at each rivet [N].
void bolt_group(double d_m, const scalar wrench[6], const double c[Z], const double s[Z], scalar N[Z],
                scalar V_y[Z], scalar V_z[Z]);
