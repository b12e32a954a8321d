// From pocket forces to the rivets: the share of a rigid circle of rivets, and the loads that the flexible
// cage half adds.
//
// Seen from +X, the rivets are at the body angles 2 pi (k + 1/2)/Z on the circle of diameter d_m, the pockets
// at 2 pi j/Z; e_x is axial, e_r points outward, e_t toward growing angle (right-handed x, r, t).
//
// Rigid share: a wrench between two rigid halves acts on Z equal elastic rivets (bolt group; the rivets' own
// bending stiffness is neglected),
//     N_k = F_x/Z + 2 (M_y r_z,k - M_z r_y,k)/(Z R^2),     V_k = (F_y, F_z)/Z + M_x e_t,k/(Z R),    R = d_m/2.
//
// Flexible share: a pocket force bends the half between its rivets and so pries the joints open, also where
// the rigid share is zero.  A static reduction by finite elements (rivet_model/cage_half.py) gives the loads
// [N, V_r, V_t, M_r, M_t] of rivet k for a unit pocket force along (x, r, t) on the +x half at pocket j.  All
// pockets are alike, so the matrix of these loads is circulant: it depends on (k - j) mod Z only.  The ball
// touches the wall that it pushes: the matrix is that of F_t > 0, and F_t < 0 gives its mirror image about
// the pocket (rivet -1 - i for i; V_t and M_r change sign).  A force on the -x half acts by mirror: N and M
// add, V subtracts.
#pragma once

#include "isa.h"

enum { PATH_N, PATH_V_R, PATH_V_T, PATH_M_R, PATH_M_T, PATH_LOADS };

// Length of one row of the matrix: the row for pocket 0, continued so that the rows for all pockets are parts
// of it.
enum { PATH_WIDTH = LANES + Z - 1 };

// Loads of the rivets by the flexible share [N, N.m], on the +x half.
typedef struct {
    ball_array sum[PATH_LOADS];
} PathLoads;

// Rigid share.  wrench: (F_x, F_y, F_z, M_x, M_y, M_z) that acts on the +x half and that the rivets must
// carry, taken at the centre of the circle.  c[k], s[k]: cosine and sine of the rivets' angles in the frame
// of the wrench.  Sets N, V_y, V_z at each rivet [N].
void load_path_rigid(double d_m, const scalar wrench[6], const double c[Z], const double s[Z], scalar N[Z],
                     scalar V_y[Z], scalar V_z[Z]);

// Adds the flexible share of pocket forces (F_x, F_r, F_t)[j] on one half: side +1 or -1; V_r and V_t only if
// `transverse`.  matrix: [F_t > 0, F_t < 0][PATH_LOADS][x, r, |t|][PATH_WIDTH] of the rivet table; rivet k
// and pocket j are at k - j + Z - 1.
void load_path_flexible(const double *matrix, int side, bool transverse, const scalar F_x[Z],
                        const scalar F_r[Z], const scalar F_t[Z], PathLoads *loads);
