// Law of one riveted joint that opens, and the loads of a ring of joints.
//
// Bonded, the joints of the halves carry L_b = (N, M_r, M_t)_k (half_path.h).  A joint that opens moves, by
// delta = (u, phi_r, phi_t) of one pad against its bonded place, and so relieves all joints through the half's
// stiffness K, a circulant matrix:
//
//     L_k = L_b,k - sum_j K_(k-j) delta_j
//     L_0,k = L_k + K_0 delta_k = L_b,k - sum_(j != k) K_(k-j) delta_j,      (delta, T, m_r, m_t)_k = law(L_0,k, P_k)
//
// L_0 is the load that the joint would carry if it too were bonded.  The law is the unilateral contact of one pad
// with its rivet while the neighbours are held (rivet_model/half_loads.py): the law contains the
// compliance of the half around the joint, K that of the rest of the half, and no compliance is counted twice.  Rigid
// motions of the half relieve no load, so a load that equilibrium imposes remains, for example the centrifugal moment.
//
// The law is positively homogeneous of degree 1 in (L_0, P), so that with a length l
//
//     M = |(M_r, M_t)|/l,   W = |(N, M)|,   s = P + W
//     (u, |phi_r|, phi_t, T, |m_r|, m_t) = s S(tau, q, psi)
//     tau = W/s,   q = N/(|N| + M),   psi = M_t/(|M_t| + |M_r|);      phi_r and m_r have the sign of M_r
//
// S is a tensor product of uniform quadratic B-splines, C1 in each argument.
#pragma once

#include "numbers/elimination.h"
#include "numbers/octet.h"

enum { AXIS_TAU, AXIS_Q, AXIS_PSI, LAW_AXES };

enum { PSI_CELLS = 10 };  // of every law (embed.py): a known distance between the rows of q

enum { LAW_ENERGY = 3, LAW_WIDTH = 8 };  // u, phi_r, phi_t, energy (elastic_half.h; else 0), T, m_r, m_t, -

// Joints that are all alike: L_0, motion of the pad, load of the rivet, per newton of s = P + c; then the answer of a single
// joint to a change of its N, M_t, P (rows u, phi_t, T, m_t) and of its M_r.
enum {
    UNIFORM_N,
    UNIFORM_M_T,
    UNIFORM_U,
    UNIFORM_PHI_T,
    UNIFORM_T,
    UNIFORM_M_T_RIVET,
    UNIFORM_SLOPES,
    UNIFORM_PHI_R = UNIFORM_SLOPES + 12,
    UNIFORM_M_R_RIVET,
    UNIFORM_WIDTH
};

typedef struct {
    double length;        // l [m]
    int cells[AXIS_PSI];  // equal cells over 0...1, -1...1; PSI_CELLS over -1...1 of psi
    // coefficients [tau][q][psi][LAW_WIDTH] of uniform splines, cells + 2 on each axis, per newton, from the first three tau on
    const double *sheet[3];
    double K_0[3][3];       // N/m, N/rad, N.m/rad
    double K_others[3][3];  // sum of the blocks below
    int neighbours;
    const int *neighbour;          // k - j mod Z of the other joints that are felt
    const double (*K)[3][3];       // their blocks
    const double (*K_slip)[2][2];  // load (V_r, V_t) relieved by slip, by k - j mod Z [N/m]
    int uniform_count;
    const double (
        *uniform)[UNIFORM_WIDTH];  // joints under the same load, at equal steps of |c|/s from 0 to 1
} JointLaw;

// The numbers S of the law in the cell `place`, the weights of its splines given.
INLINE void law_sum(const JointLaw *law, int place, scalar w[LAW_AXES][3], octet *S)
{
    enum { ROW = LAW_WIDTH * (PSI_CELLS + 2) };

    octet sum = {{0}};
    for (int a = 0; a < 3; a++) {
        const double *from = law->sheet[a] + LAW_WIDTH * place;
        octet by_q = {{0}};
        for (int b = 0; b < 3; b++) {
            octet by_psi = {{0}};
            for (int c = 0; c < 3; c++)
                octet_add_from(w[AXIS_PSI][c], from + b * ROW + c * LAW_WIDTH, &by_psi);
            octet_add(w[AXIS_Q][b], &by_psi, &by_q);
        }
        octet_add(w[AXIS_TAU][a], &by_q, &sum);
    }
    *S = sum;
}

// A packet of joints in the law: their cells, s, and the weights of the splines [axis][3].
typedef struct {
    ball_array cell, size, weight[LAW_AXES][3];
} LawPlaces;

// Cells and weights of a packet at the coordinate u in cells from the start of an axis.  A NaN gives cell 0.
INLINE wide law_weights(int cells, wide u, int k, ball_array weight[3])
{
    const wide cell = wide_floor(wide_min(wide_max(u, wide_set(0.0)), wide_set(cells - 1.0)));
    const wide up = u - cell, down = 1.0 - up, first = 0.5 * (down * down), last = 0.5 * (up * up);
    wide_store(&weight[0][k], first);
    wide_store(&weight[1][k], 1.0 - first - last);
    wide_store(&weight[2][k], last);
    return cell;
}

// Places of the packet from k on under loads (N, M_r, M_t) and preloads.
INLINE void law_places(const JointLaw *law, const wide L[3], wide P, int k, LawPlaces *at)
{
    const int *cells = law->cells;
    const double inv_length = 1.0 / law->length;
    const wide N = L[0], M_r = wide_abs(L[1]), M_t = L[2];
    const wide M = wide_hypot(M_r, M_t) * inv_length, W = wide_hypot(N, M), s = P + W;
    const wide tau = wide_ratio(W, s) * cells[AXIS_TAU];
    const wide q = (wide_ratio(N, wide_abs(N) + M) + 1.0) * (0.5 * cells[AXIS_Q]);
    const wide psi = (wide_ratio(M_t, wide_abs(M_t) + M_r) + 1.0) * (0.5 * PSI_CELLS);
    wide cell = law_weights(cells[AXIS_TAU], tau, k, at->weight[AXIS_TAU]);
    cell = cell * (cells[AXIS_Q] + 2.0) + law_weights(cells[AXIS_Q], q, k, at->weight[AXIS_Q]);
    cell = cell * (PSI_CELLS + 2.0) + law_weights(PSI_CELLS, psi, k, at->weight[AXIS_PSI]);
    wide_store(&at->cell[k], cell);
    wide_store(&at->size[k], s);
}

// The law of joint k at its place, M_r its moment about r: moves of the pad (of elastic halves: loads of the joint),
// loads (T, m_r, m_t) of the rivet and the energy.
INLINE void law_answer(const JointLaw *law, const LawPlaces *at, int k, scalar M_r, scalar move[3],
                       scalar rivet[3], scalar *energy)
{
    octet S;
    scalar weight[LAW_AXES][3];
    for (int a = 0; a < LAW_AXES; a++)
        for (int i = 0; i < 3; i++) weight[a][i] = at->weight[a][i][k];
    law_sum(law, (int)scalar_value(at->cell[k]), weight, &S);
    const scalar s = at->size[k], across = scalar_value(M_r) < 0.0 ? -s : s;
    move[0] = s * S.x[0], rivet[0] = s * S.x[4];
    move[1] = across * S.x[1], rivet[1] = across * S.x[5];
    move[2] = s * S.x[2], rivet[2] = s * S.x[6];
    *energy = s * s * S.x[LAW_ENERGY];
}

// Moves of all joints, once more behind the last one, so that those of neighbours lie side by side.
typedef scalar JointMoves[3][2 * Z + LANES];

// L_0 of all joints by the moves of their neighbours.
INLINE void law_trials(const JointLaw *law, ball_array bonded[3], JointMoves moves, wide trial[PACKETS][3])
{
    for (int p = 0; p < PACKETS; p++)
        for (int i = 0; i < 3; i++) trial[p][i] = wide_load(&bonded[i][p * LANE_WIDTH]);
    for (int n = 0; n < law->neighbours; n++)
        for (int m = 0; m < 3; m++) {
            const scalar *move = &moves[m][Z - law->neighbour[n]];
            for (int i = 0; i < 3; i++) {
                const wide K = wide_set(-law->K[n][i][m]);
                for (int p = 0; p < PACKETS; p++)
                    trial[p][i] = wide_fma(K, wide_load(move + p * LANE_WIDTH), trial[p][i]);
            }
        }
}

// The move of a joint that carries nothing: K_0 move = L_0.
ONCE void law_free(const double K[3][3], const scalar load[3], scalar move[3])
{
    for (int i = 0; i < 3; i++) move[i] = load[i];
    solve_3(K[0], move);
}
