// From pocket forces to the rivets: rigid share of the circle of rivets, and what the flexible cage half adds to it.
//
// Seen from +X: rivets at body angles 2 pi (k + 1/2)/Z on the circle d_m, pockets at 2 pi j/Z; e_x axial, e_r outward, e_t toward growing angle
// (right-handed x, r, t).
//
// Rigid share: a wrench between two rigid halves on Z equal elastic rivets (bolt group; rivets' own bending stiffness neglected),
//     N_k = F_x/Z + 2 (M_y r_z,k - M_z r_y,k)/(Z R^2),     V_k = (F_y, F_z)/Z + M_x e_t,k/(Z R),    R = d_m/2.
//
// Flexible share: a pocket force bends the half between its rivets, which pries at the joints although the rigid halves carry nothing there.
// Static reduction by finite elements (rivet_model/cage_half.py): [N, V_r, V_t, M_r, M_t] of rivet k per unit pocket force along (x, r, t)
// on the +x half at pocket j is the matrix of relative index (k - j) mod Z: circulant, as all pockets are alike.  The ball touches the wall
// that it pushes: the matrix holds F_t > 0, and F_t < 0 is its mirror image about the pocket (rivet -1 - i for i; V_t and M_r change sign).
// A force on the -x half acts by mirror: N and M add, V subtracts.
#pragma once

#include "isa.h"

enum { PATH_N, PATH_V_R, PATH_V_T, PATH_M_R, PATH_M_T, PATH_LOADS };
enum { PATH_WIDTH = LANES + Z - 1 };  // one row of the matrix for pocket 0, continued so that those of all pockets are parts of it

// Loads at the rivets beyond the dynamics' own [N, N.m], on the +x half.
typedef struct {
    ball_array sum[PATH_LOADS];
} PathLoads;

// Wrench (F_x, F_y, F_z, M_x, M_y, M_z) that the rivets must carry from outside onto the +x half, taken at the centre of the circle;
// c[k], s[k]: cosine and sine of the rivets' angles in the frame of the wrench.  Returns N, V_y, V_z at each rivet [N].
void load_path_rigid(double d_m, const scalar wrench[6], const double c[Z], const double s[Z], scalar N[Z], scalar V_y[Z], scalar V_z[Z]);

// Adds the flexible share of pocket forces (F_x, F_r, F_t)[j] on one half: side +1 or -1; V_r and V_t only if `transverse`.
// matrix: [F_t > 0, F_t < 0][PATH_LOADS][x, r, |t|][PATH_WIDTH], as the rivet table holds it: rivet k and pocket j at k - j + Z - 1.
void load_path_flexible(const double *matrix, int side, bool transverse, const scalar F_x[Z], const scalar F_r[Z], const scalar F_t[Z], PathLoads *loads);
