// What joints that open and slip leave of the loads that bonded joints would carry.
//
// Bonded, the joints of the halves carry L_b = (N, M_r, M_t)_k (half_path.h).  A joint that opens moves, by
// delta = (u, phi_r, phi_t) of one pad against its bonded place, and so relieves all joints through the half's
// stiffness K, a circulant matrix:
//
//     L_k = L_b,k - sum_j K_(k-j) delta_j
//     L*_k = L_k + K_0 delta_k = L_b,k - sum_(j != k) K_(k-j) delta_j,      (delta, T, m_r, m_t)_k = law(L*_k, P_k)
//
// L* is the load that the joint would carry if it too were bonded.  The law is the unilateral contact of one pad
// with its rivet while the neighbours are held (rivet_model/half_loads.py): the compliance of the half around
// the joint is in the law, that of the rest in K, and nothing is in both.  Rigid motions of the half relieve
// nothing, so that a load which equilibrium imposes, as the centrifugal moment, remains.
//
// The law is positively homogeneous of degree 1 in (L*, P), so that with a length l
//
//     M = |(M_r, M_t)|/l,   W = |(N, M)|,   s = P + W
//     (u, |phi_r|, phi_t, T, |m_r|, m_t) = s S(tau, q, psi)
//     tau = W/s,   q = N/(|N| + M),   psi = M_t/(|M_t| + |M_r|);      phi_r and m_r have the sign of M_r
//
// S is a tensor product of uniform quadratic B-splines, C1 in each argument.
//
// The equations of all joints are solved by sweeps (Jacobi's iteration).
//   Start    all joints move as they do under the same load, the centrifugal one: there L* and the moves depend on
//            one ratio only, c/(P + c) with c = |bonded M_t|/l, and are tabulated (`alike`).
//   A sweep  finds L* by the neighbours' moves.  A joint whose L* and P differ from the start by less than NEAR s
//            answers by its tangent there; another one by the law if its L* has changed by more than CHANGE s since
//            its last answer.  The iteration ends when the law is not asked any more.
// Most joints are near the centrifugal state at most instants, so that this takes a few evaluations of the law
// instead of several for each joint.  The results are within 2.5 % of the converged ones (tests/test_rivets.py),
// and jump by less where a joint enters or leaves a sweep.
//
// In the plane a joint slips, by s along V: of the bonded V the part that friction and hole do not take is
// relieved through the slip stiffness (joint_slip).
#pragma once

#include "isa.h"

enum { AXIS_TAU, AXIS_Q, AXIS_PSI, LAW_AXES };

enum { LAW_WIDTH = 8 };  // u, phi_r, phi_t, -, T, m_r, m_t, -

// Joints that are all alike: L* and what pad and rivet do, per newton of s = P + c; then how one of them answers
// to a change of its N, M_t, P (rows u, phi_t, T, m_t) and of its M_r.
enum {
    ALIKE_N,
    ALIKE_M_T,
    ALIKE_U,
    ALIKE_PHI_T,
    ALIKE_T,
    ALIKE_M_T_RIVET,
    ALIKE_SLOPES,
    ALIKE_PHI_R = ALIKE_SLOPES + 12,
    ALIKE_M_R_RIVET,
    ALIKE_WIDTH
};

typedef struct {
    double length;        // l [m]
    int cells[LAW_AXES];  // equal cells over 0...1, -1...1, -1...1
    const double
        *coefficients;      // [tau][q][psi][LAW_WIDTH] of uniform splines, cells + 2 on each axis, per newton
    double K_0[3][3];       // N/m, N/rad, N.m/rad
    double K_others[3][3];  // sum of the blocks below
    int neighbours;
    const int *neighbour;          // k - j mod Z of the other joints that are felt
    const double (*K)[3][3];       // their blocks
    const double (*K_slip)[2][2];  // load (V_r, V_t) relieved by slip, by k - j mod Z [N/m]
    int alike_count;
    const double (*alike)[ALIKE_WIDTH];  // joints under the same load, at equal steps of |c|/s from 0 to 1
} JointLaw;

// Loads (N, M_r, M_t) of the joints and (T, m_r, m_t) of the rivets [N, N.m], from bonded loads and preloads
// P >= 0.  spin_M, spin_P: bonded M_t under the centrifugal load alone, and the preload with it.
void joints_open(const JointLaw *law, ball_array bonded[3], const ball_array P, scalar spin_M, scalar spin_P,
                 ball_array load[3], ball_array rivet[3]);

// What joints have for the transverse loads: friction of plates and heads [N], play [m]; stiffness of heads and hole [N/m].
typedef struct {
    ball_array plates, heads, gap;
    double k_head, k_hole;
} SlipLimits;

// Adds what plates, heads and shanks carry (r, t) of the bonded loads V_r, V_t [N].
void joints_slip(const JointLaw *law, const ball_array V_r, const ball_array V_t, const SlipLimits *limits,
                 ball_array plates[2], ball_array heads[2], ball_array shank[2]);
