// From pocket forces to the loads that bonded joints of halves that bend would carry.
//
// Seen from +X, the rivets are at the body angles 2 pi (k + 1/2)/Z on the circle of diameter d_m, the pockets
// at 2 pi j/Z; e_x is axial, e_r points outward, e_t toward growing angle (right-handed x, r, t).
//
//     x ^    ____          chi   place on the pocket's wall that the ball pushes: 0 at the split, pi/2 at the
//       |  .'    '.              pocket's bottom
//       | /  chi ( \.      push  normal part (x, t) of its force on the half: chi = atan(|push_x|/|push_t|)
//       +-----o-----+--> t
//
// A pocket force bends the half between its rivets and so pries the joints open, also where rigid halves carry
// nothing.  A static reduction by finite elements (rivet_model/half_loads.py) gives the rows of each joint for
// a unit force along x, r or t on pocket 0 of the +x half:
//
//     N, V_r, V_t, M_r, M_t   loads of the joint (N and V: beyond the rigid share)
//     dP, dm_r, dm_t          what its rivet gets beside the joint's law, because the half gives under its head:
//                             change of preload, bending of its shank
//
// Over chi they are cubic Hermite splines, C1.  All pockets are alike, so the rows of rivet k by a force on
// pocket j depend on (k - j) mod Z only.  push_t < 0 acts as the mirror image about the pocket does (rivet
// -1 - i for i; V_t, M_r and dm_r change sign), a force on the -x half as its mirror image on the +x half does
// (V changes sign).
#pragma once

#include "numbers/isa.h"

enum { ROW_N, ROW_V_R, ROW_V_T, ROW_M_R, ROW_M_T, ROW_DP, ROW_DM_R, ROW_DM_T, ROWS };

typedef struct {
    int nodes;
    const double *chi;  // [nodes] from 0 to pi/2 [rad]
    const float *rows;  // [push_t >= 0, < 0][nodes][value, slope][force x, r, |t|][k - j mod Z][ROWS]
} HalfPath;

// Rows of all joints [N, N.m].
typedef struct {
    ball_array row[ROWS];
} PathRows;

// Forces on the pockets of one half and their normal parts, in the pockets' frames [N].
typedef struct {
    const scalar *F_x, *F_r, *F_t, *push_x, *push_t;
} PathForces;

// Sets the rows of all joints by the forces on the halves 0 (-x) and 1 (+x).  Returns false and sets nothing if no
// pocket is touched.
bool half_path_rows(const HalfPath *path, const PathForces on[2], PathRows *rows);
