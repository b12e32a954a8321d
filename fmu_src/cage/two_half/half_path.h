// Loads of bonded joints between halves that bend, by the forces on the pockets and on the guiding lands.  Bonded: the
// joint neither opens nor slips.
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
//     dP, dm_r, dm_t          loads of its rivet beside the joint's law, because the half gives under its head:
//                             change of preload, bending of its shank
//
// On the sphere of a ribbon's pocket chi is the place's angle about the sphere's centre, from the fillet's seam on, and its
// distance r from the bearing's axis is a second coordinate: Lagrange's parabola through the rows of three radii.  Places
// beyond the nodes are on the first or the last one.
//
// Over chi they are cubic Hermite splines, C1.  All pockets are alike, so the rows of rivet k by a force on
// pocket j depend on (k - j) mod Z only.  push_t < 0 acts as the mirror image about the pocket does (rivet
// -1 - i for i; V_t, M_r and dm_r change sign), a force on the -x half as its mirror image on the +x half does
// (V changes sign).
//
// A film on the guiding land loads the outer rim by a radial line load P(theta), outward, in its harmonics
// G_p = int P exp(i p theta) dtheta.  Those of wave n = 0...Z/2 are p = n, n - Z, n + Z, below 3 Z/2, and each gives
// rows r_p, which go straight over the place x of the land (rivet_model/half_lands.py):
//
//     a_n = sum over p r_p Re G_p,  b_n = sum over p r_p Im G_p
//     rows of rivet k: sum over n of a_n cos n theta_k + b_n sin n theta_k   even: N, V_r, M_t, dP, dm_t
//                                    b_n cos n theta_k - a_n sin n theta_k   odd: V_t, M_r, dm_r
#pragma once

#include "numbers/lanes.h"
#include "physics/land_path.h"

typedef struct {
    int nodes;
    const double *chi;  // [nodes] from 0 to pi/2 [rad]
    // [radius of a ribbon][push_t >= 0, < 0][nodes][value, slope][force x, r, |t|][k - j mod Z][ROWS]
    const float *rows;
    int radii;             // of a ribbon 3, else 0
    const double *radius;  // [m]
} HalfPath;

// Forces on the pockets of one half and their normal parts, in the pockets' frames [N]; on a ribbon, places (x, t) from the
// sphere's centre instead of these parts, and radii [m].
typedef struct {
    const scalar *F_x, *F_r, *F_t, *push_x, *push_t, *radius;
} PathForces;

// Adds to the rows of all joints [N, N.m] those by the loads on the rims of the halves 0 and 1, Re and Im G_p.
void half_path_add_lands(const LandPath *path, const scalar *re[2], const scalar *im[2],
                         ball_array rows[ROWS]);

// Sets the rows of all joints by the forces on the halves 0 (-x) and 1 (+x).  Returns false and sets nothing if no
// pocket is touched.
bool half_path_rows(const HalfPath *path, const PathForces on[2], ball_array rows[ROWS]);
