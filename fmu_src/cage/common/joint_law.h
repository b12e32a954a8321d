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

#include "numbers/elimination.h"
#include "numbers/isa.h"
#include "numbers/octet.h"

enum { AXIS_TAU, AXIS_Q, AXIS_PSI, LAW_AXES };

enum { LAW_ENERGY = 3, LAW_WIDTH = 8 };  // u, phi_r, phi_t, energy (elastic_half.h; else 0), T, m_r, m_t, -

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

// A coordinate u of the law in cells from the start of its axis: its cell, and the weights of the three splines.
INLINE int axis_weights(scalar u, int cells, scalar w[3])
{
    const int cell = (int)scalar_min(scalar_max(scalar_value(u), 0.0), cells - 1.0);  // a NaN gives cell 0
    const scalar up = u - cell, down = 1.0 - up;
    w[0] = 0.5 * (down * down);
    w[2] = 0.5 * (up * up);
    w[1] = 1.0 - w[0] - w[2];
    return cell;
}

// part/whole; 0 where whole is so small that 1/whole is not finite.
INLINE scalar share(scalar part, scalar whole)
{
    return scalar_value(whole) > 1e-300 ? part / whole : 0.0;
}

INLINE scalar magnitude(scalar x)
{
    return scalar_value(x) < 0.0 ? -x : x;
}

// The numbers S of the law in the cell `place`, the weights of its splines given.
INLINE void law_sum(const JointLaw *law, int place, scalar w[LAW_AXES][3], octet *S)
{
    const int row = LAW_WIDTH * (law->cells[AXIS_PSI] + 2), sheet = row * (law->cells[AXIS_Q] + 2);
    const double *from = law->coefficients + LAW_WIDTH * place;
    octet sum = {{0}};
    for (int a = 0; a < 3; a++) {
        octet by_q = {{0}};
        for (int b = 0; b < 3; b++) {
            octet by_psi = {{0}};
            for (int c = 0; c < 3; c++)
                octet_add_from(w[AXIS_PSI][c], from + a * sheet + b * row + c * LAW_WIDTH, &by_psi);
            octet_add(w[AXIS_Q][b], &by_psi, &by_q);
        }
        octet_add(w[AXIS_TAU][a], &by_q, &sum);
    }
    *S = sum;
}

// At coordinates in cells.
INLINE void law_octet(const JointLaw *law, const scalar u[LAW_AXES], octet *S)
{
    scalar w[LAW_AXES][3];
    int place = axis_weights(u[AXIS_TAU], law->cells[AXIS_TAU], w[AXIS_TAU]);
    place = place * (law->cells[AXIS_Q] + 2) + axis_weights(u[AXIS_Q], law->cells[AXIS_Q], w[AXIS_Q]);
    place = place * (law->cells[AXIS_PSI] + 2) + axis_weights(u[AXIS_PSI], law->cells[AXIS_PSI], w[AXIS_PSI]);
    law_sum(law, place, w, S);
}

// Moves of a joint's pad and loads of its rivet under L* = (N, M_r, M_t) and P; the energy of elastic_half.h
// if it is asked for.
INLINE void joint_law(const JointLaw *law, const scalar load[3], scalar P, scalar move[3], scalar rivet[3],
                      scalar *energy)
{
    const double inv_length = 1.0 / law->length;
    const scalar N = load[0], M_r = magnitude(load[1]), M_t = load[2];
    const scalar M = scalar_sqrt(M_r * M_r + M_t * M_t) * inv_length, W = scalar_sqrt(N * N + M * M),
                 s = P + W;
    const scalar q = share(N, magnitude(N) + M), psi = share(M_t, magnitude(M_t) + M_r);
    const scalar u[LAW_AXES] = {share(W, s) * law->cells[AXIS_TAU], (q + 1.0) * (0.5 * law->cells[AXIS_Q]),
                                (psi + 1.0) * (0.5 * law->cells[AXIS_PSI])};
    octet sum;
    law_octet(law, u, &sum);
    const scalar across = scalar_value(load[1]) < 0.0 ? -s : s;
    move[0] = s * sum.x[0], move[1] = across * sum.x[1], move[2] = s * sum.x[2];
    rivet[0] = s * sum.x[4], rivet[1] = across * sum.x[5], rivet[2] = s * sum.x[6];
    if (energy) *energy = s * s * sum.x[LAW_ENERGY];
}

// |N| + (|M_r| + |M_t|)/l.
INLINE wide joint_size(const JointLaw *law, wide N, wide M_r, wide M_t)
{
    return wide_abs(N) + (wide_abs(M_r) + wide_abs(M_t)) * (1.0 / law->length);
}

// What all joints have in common, of the table's `alike` for c and P, in newtons.
ONCE void find_alike(const JointLaw *law, scalar c, scalar P, scalar at[ALIKE_WIDTH])
{
    const scalar s = c + P, x = scalar_value(s) > 0.0 ? c / s * (law->alike_count - 1.0) : 0.0;
    const int i = (int)scalar_min(scalar_max(scalar_value(x), 0.0), law->alike_count - 2.0);
    const double *from = law->alike[i], *to = law->alike[i + 1];
    const scalar up = x - i;
    for (int n = 0; n < ALIKE_WIDTH; n++) at[n] = from[n] + up * (to[n] - from[n]);
    for (int n = 0; n < ALIKE_SLOPES; n++) at[n] *= s;
}

// Moves of all joints, once more behind the last one, so that those of neighbours lie side by side.
typedef scalar JointMoves[3][2 * Z + LANES];

// L* of all joints by the moves of their neighbours.
INLINE void find_alone(const JointLaw *law, ball_array bonded[3], JointMoves moves, wide alone[PACKETS][3])
{
    for (int p = 0; p < PACKETS; p++)
        for (int i = 0; i < 3; i++) alone[p][i] = wide_load(&bonded[i][p * LANE_WIDTH]);
    for (int n = 0; n < law->neighbours; n++)
        for (int m = 0; m < 3; m++) {
            const scalar *move = &moves[m][Z - law->neighbour[n]];
            for (int i = 0; i < 3; i++) {
                const wide K = wide_set(-law->K[n][i][m]);
                for (int p = 0; p < PACKETS; p++)
                    alone[p][i] = wide_fma(K, wide_load(move + p * LANE_WIDTH), alone[p][i]);
            }
        }
}

// The move of a joint that carries nothing: K_0 move = L*.
ONCE void joint_free(const double K[3][3], const scalar load[3], scalar move[3])
{
    for (int i = 0; i < 3; i++) move[i] = load[i];
    solve_3(K[0], move);
}

// Loads (N, M_r, M_t) of the joints and (T, m_r, m_t) of the rivets [N, N.m], from bonded loads and preloads
// P >= 0.  intact: 1, or 0 for a joint that carries nothing, whose move takes all of L*; spin_M, spin_P: bonded
// M_t under the centrifugal load alone, and the preload with it.  Returns how often the law was asked.
int joints_open(const JointLaw *law, ball_array bonded[3], const ball_array P, const constants intact,
                scalar spin_M, scalar spin_P, ball_array load[3], ball_array rivet[3]);

// What joints have for the transverse loads: friction of plates and heads [N], play [m]; stiffness of heads
// and hole [N/m].
typedef struct {
    ball_array plates, heads, gap, k_hole;
    double k_head;
} SlipLimits;

// Adds what plates, heads and shanks carry (r, t) of the bonded loads V_r, V_t [N].
void joints_slip(const JointLaw *law, const ball_array V_r, const ball_array V_t, const SlipLimits *limits,
                 ball_array plates[2], ball_array heads[2], ball_array shank[2]);
