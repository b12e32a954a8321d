// The vibration modes of a cage half in a scene.
//
// The half is a ring of Z equal pitches.  An entry of the table is a mode of harmonic n, for 0 < n < Z/2 a pair of the
// same frequency with the coordinates a (cos) and b (sin).  A place whose amplitude on pitch 0 is
// U = U' + i U'' moves by
//
//     u_j = Re[(a - i b) U exp(i nu)]      pocket j, side t > 0:  nu = 2 pi n j/Z;  side t < 0: (U_x, U_r, -U_t) conjugate
//                                          rivet k:  nu = 2 pi n (k + 1/2)/Z;  U real along x, r and about t, else imaginary
//
// bearing_model/cage/elastic/half_modes.py derives this.  The rivet table contains the modes of the lowest frequencies
// and, as the residual, the static flexibility of all other modes.  Here the modes have no dimension and the modal mass is the
// half's, so that coordinates are lengths.  The coordinates are stored in this order: all a, of pairs before
// those of single modes; then all b in the same order.  The displacement of a place by a pair follows from U and two
// combinations of the pair's coordinates:
//
//     u_j = U' a' + U'' b',     a' = a cos nu + b sin nu,  b' = b cos nu - a sin nu
//
// and its coordinates get the forces f_a = F' cos nu - F'' sin nu, f_b = F' sin nu + F'' cos nu of F' = U'.F,
// F'' = U''.F.  A single mode has sin nu = 0.  Mirroring the half in the plane between the first and the last
// rivet turns the sign of each motion of pads by an a or by a b: by mirror symmetry half of the rivets determine all.
#pragma once

#include "cage/common/joint_law.h"
#include "cage/elastic/half_modes.h"
#include "physics/model.h"

static const double ROOT_HALF = 0.7071067811865476;  // of 1/2

enum { MODES = N_MODES };

// Motions of pads against each other out of the plane and in it.
enum { PAD_OUT = 3, PAD_IN = 2 };

static const int OUT_PADS[PAD_OUT] = {PAD_X, PAD_PHI_R, PAD_PHI_T}, IN_PADS[PAD_IN] = {PAD_R, PAD_T};

// Motions of the first pads in one row, motion c of joint k in place c FIRST + k; joint Z - 1 - k is its
// mirror image.  Octets of a row.
enum { FIRST = (Z + 1) / 2, OUT_OCTETS = (PAD_OUT * FIRST + 7) / 8, IN_OCTETS = (PAD_IN * FIRST + 7) / 8 };

enum { ENTRY_OCTETS = ENTRIES / 8 };

enum { WALL_NODES = 16, WALL_RADII = 3 };  // of a wall, at most

struct ElasticHalf {
    int n, count[2];                        // modes; coordinates a and b
    int entry[MODES];                       // of the table, of each coordinate
    double omega_2[MODES], damping[MODES];  // omega^2, 2 zeta omega
    double centrifugal[MODES];              // modal force per (rad/s)^2
    double rim[RIM][MODES];                 // of the rim's shapes at the land (land_bent.h)
    double mobility[RIM];                   // velocity of a shape by an impulse on it [1/kg]
    bool uniform[MODES];                    // moves all joints alike and does not twist them
    int uniforms, uniform_at[MODES];        // the coordinates of these
    bool pair[MODES];                       // one of two modes of the same frequency
    int pairs;                              // these, whose a come first and whose b first among the b
    _Alignas(64) double out[MODES][8 * OUT_OCTETS];  // motions of the pads against each other by S, in rows
    _Alignas(64) double in[MODES][8 * IN_OCTETS];    // and by D
    // the same, a and b by themselves, modes side by side; of a joint that is its own mirror image one half
    _Alignas(64) double out_modes[2 * PAD_OUT][FIRST][ENTRIES];
    double in_modes[2 * PAD_IN][FIRST][ENTRIES];
    double turn[Z][3][ENTRIES];  // at the pockets: cos nu of the a, of the b, sin nu
    // U by node, radius by radius of a ribbon, value and slope, (x, r, t), U' of the a and U'' of the b
    double wall[WALL_RADII * WALL_NODES][2][3][2][ENTRIES];
    // the same of the modes that move all pockets alike, by rows: value and slope, (x, r, t) and 0
    double alike[ENTRIES][WALL_RADII * WALL_NODES][8];
    int nodes;                    // of the walls' angle
    int radii;                    // of the walls' radius: 1 unless the table is a ribbon's
    double radius[WALL_RADII];    // [m]
    double per_gaps[WALL_RADII];  // 1 over the product of the distances to both others [1/m2]
    double chi[WALL_NODES];       // [rad]
    double step[WALL_NODES], inv_step[WALL_NODES];  // from a node to the next one [rad], its inverse
    // how far a wall can move: largest |u|/|q| of each mode, of a pair's a over the amplitude of both
    double widest[MODES];         // of modes that move all pockets alike, else 0
    double widest_others[MODES];  // of the others, else 0
    double wall_mobility;         // of a wall by modes and half, at the widest place, at most [m/s/(N.s)]
    double weak_film;             // damping of a pocket's film that need not follow in the substeps [N.s/m]
    double compliance;            // of a wall along its normal, by the residual, less that in Hertz's [m/N]
    // residual between the pads of a joint out of the plane, beside the modes: compliance and its inverse
    double R[PAD_OUT][PAD_OUT], K[PAD_OUT][PAD_OUT];
    double series;     // part of the friction states' stiffness that is left in series with the residual
    constants k_hole;  // stiffness of the holes in series with the residual [N/m]
    double substep, longest_step;  // of the default method, at most [s]

    // from which all this was derived: the parameters and constants of the body, the largest stiffness of the holes
    double of_body[7], of_k_hole;

    // the joints' law over L_K = L + K delta, which gives L; the fourth number is U, whose slope is delta
    const JointLaw *law;
};

// The half of the rivet table in the scene.  half: zeros, or the half of other parameters, of which the parts are
// kept that follow from the same values: the modes cost 0.6 ms, which a change of a parameter in a run would cost again.
void elastic_half_derive(const Parameters *p, const Derived *d, ElasticHalf *half);

// Coordinates S [MODES] and axial distance of the halves' bodies [m] at which modes and joints rest under the
// centrifugal load of the speed omega [rad/s].
double elastic_half_rest(const Parameters *p, const Derived *d, const ElasticHalf *half, double omega,
                         double *S);

// Where balls meet the walls of a half's pockets: direction (x, t) from the pocket's axis to the ball, side
// of the pocket and of the split, node below the wall's angle, weights of the cubics for the value and the
// slope over the angle.
typedef struct {
    ball_array n_x, n_t, value[4], slope[4];
    bool back[LANES], inside[LANES];
    int node[LANES];
} WallPlaces;

// The walls there.
typedef struct {
    ball_array u_dot[3];  // velocity (x, r, t)
    ball_array tilt;      // slope of n.u across n, u the motion: how much the normal turns
} WallMotion;

// Motions (x, r, t) of one wall by all a' and, times by_b, by all b'.
typedef struct {
    scalar motion[3][2][ENTRIES];
    double by_b;
} WallShape;

// Places of a packet of balls from j on, on the half at side (+1 or -1).
void elastic_wall_places(const ElasticHalf *half, int side, int j, wide n_x, wide n_t, WallPlaces *at);

// Motion of the wall of pocket j along the contact's normal by each mode.
void elastic_wall_shape(const ElasticHalf *half, int side, int j, const WallPlaces *at, mode_array shape);

// Sets velocity and tilt of that wall, and its motion by each mode.  S: distance of the ball from the pocket's axis.
void elastic_wall(const ElasticHalf *half, int side, int j, const WallPlaces *at, const scalar *q,
                  const scalar *q_dot, scalar S, WallMotion *wall, WallShape *shape);

// Adds the modal forces of the force (x, r, t) on the wall of pocket j.
void elastic_wall_force(const ElasticHalf *half, int j, const WallShape *shape, const scalar F[3],
                        mode_array modal);

// Nodes of the walls of a ribbon's pockets around the places of a packet: node below, weights of the cubic over chi and of the parabola
// over the radius, for the value and for the slopes over both; front: 1 on the side t > 0 of a pocket, -1 on the other, mirrored one, between
// them of a ball that sits on both.
typedef struct {
    int node[LANE_WIDTH];
    scalar front[LANE_WIDTH];
    scalar value[4][LANE_WIDTH], slope[4][LANE_WIDTH];
    scalar along[WALL_RADII][LANE_WIDTH], along_slope[WALL_RADII][LANE_WIDTH];
    scalar row[WALL_RADII][4][LANE_WIDTH];  // of the motion itself, by the table's rows
} RibbonNodes;

// The nodes around the angles chi at the radii, of the part `front`.
void ribbon_wall_nodes(const ElasticHalf *half, wide chi, wide radius, wide front, RibbonNodes *nodes);

// Motions at all nodes, radius by radius, value and slope, (x, r, t) and 0, by those coordinates q that move all pockets alike.
typedef scalar ribbon_motions_alike[WALL_RADII * WALL_NODES][2][4];

void ribbon_alike(const ElasticHalf *half, const scalar *q, ribbon_motions_alike alike);

// Motion (x, r, t) by these coordinates at the place of a lane.
void ribbon_wall_alike(const ElasticHalf *half, int side, const RibbonNodes *nodes, int lane,
                       ribbon_motions_alike alike, scalar u[3]);

// Motion there by all coordinates q, in pocket j; shapes for ribbon_wall and elastic_wall_force.
void ribbon_wall_moved(const ElasticHalf *half, int side, int j, const RibbonNodes *nodes, int lane,
                       const scalar *q, scalar u[3], WallShape *shape);

// Velocity there, slopes of the motion along n (x, r, t) over chi, radius and front.
void ribbon_wall(const ElasticHalf *half, int side, int j, const RibbonNodes *nodes, int lane,
                 const WallShape *shape, const scalar n[3], const scalar *q, const scalar *q_dot,
                 scalar u_dot[3], scalar slope[3]);

// Motion along n (x, r, t) by each mode there, and the same bits by the shapes of ribbon_wall_moved.
void ribbon_wall_shape(const ElasticHalf *half, int side, int j, const RibbonNodes *nodes, int lane,
                       const scalar n[3], mode_array shape);
void elastic_wall_along(const ElasticHalf *half, int j, const WallShape *moved, const scalar n[3],
                        mode_array shape);

// Motion of the pad of joint k by coordinate i, of PAD_OUT out of the plane or of PAD_IN in it.
double elastic_half_pad(const ElasticHalf *half, bool out, int i, int motion, int k);

// Motions of the rim's shapes by coordinates x, and by y.
INLINE void elastic_rims(const ElasticHalf *half, const scalar *x, const scalar *y, scalar by_x[RIM],
                         scalar by_y[RIM])
{
    enum { BOTH = 2 * RIM };

    wide part[EIGHTHS][BOTH];
    scalar sum[BOTH];
    for (int n = 0; n < EIGHTHS; n++) {
        for (int c = 0; c < BOTH; c++) part[n][c] = wide_set(0.0);
        for (int i = n * LANE_WIDTH; i < N_MODES; i += 8)
            for (int c = 0; c < RIM; c++) {
                const wide shape = wide_load(&half->rim[c][i]);
                part[n][c] += shape * wide_load(&x[i]);
                part[n][RIM + c] += shape * wide_load(&y[i]);
            }
    }
    wide_column_sums(BOTH, BOTH, part[0], sum);
    memcpy(by_x, sum, RIM * sizeof *sum);
    memcpy(by_y, &sum[RIM], RIM * sizeof *sum);
}

// Sum over the modes in one order for every lane width.
INLINE scalar elastic_sum(const scalar *x, const scalar *y)
{
    wide part[EIGHTHS];
    for (int n = 0; n < EIGHTHS; n++) {
        part[n] = wide_set(0.0);
        for (int i = n * LANE_WIDTH; i < N_MODES; i += 8) part[n] += wide_load(&x[i]) * wide_load(&y[i]);
    }
    return wide_eight_sum(part);
}

// Sum over the modes as elastic_sum, with constants x.
INLINE scalar elastic_dot(const double *x, const scalar *y)
{
    wide part[EIGHTHS];
    for (int n = 0; n < EIGHTHS; n++) {
        part[n] = wide_set(0.0);
        for (int i = n * LANE_WIDTH; i < N_MODES; i += 8) part[n] += wide_load(&x[i]) * wide_load(&y[i]);
    }
    return wide_eight_sum(part);
}
