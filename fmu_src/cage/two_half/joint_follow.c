// Joints that open, from instant to instant.
//
// From one step to the next the loads of a joint change by a few per cent.  Each joint therefore answers by the
// tangent of its law at loads (L*, P)_0 of an instant before,
//
//     (u, phi_r, phi_t, T, m_r, m_t) = law_0 + slope (L* - L*_0, P - P_0)
//
// and the law is asked, value and slope, where L* and P are farther than REACH s from there.  Between the joints the
// equations are linear then: sweeps over all joints, side by side, without the law (joint_law.h: a sweep leaves a
// fifth to a half of the error).  The first tangent of all joints is the one where they are alike.  While
// joints_open asks the law FEW times at an instant it costs less than the sweeps, and finds the loads by itself.
// A joint that carries nothing has K_0^-1 as its slope, everywhere.
#include "cage/two_half/joint_follow.h"

// Sweeps at most, and how often the law may be asked at one instant.
enum { FOLLOW_SWEEPS = 4, ROUNDS = 3, FEW = 6 };

// Parts of s: how far tangents reach; change of L* by a sweep below which there is no other one.
static const double REACH = 0.05, SETTLED = 0.002;

// Weights of the three splines of an axis at a coordinate u in cells, and their derivatives.  Returns the cell.
INLINE int axis_slopes(scalar u, int cells, scalar w[3], scalar dw[3])
{
    const int cell = axis_weights(u, cells, w);
    dw[0] = u - cell - 1.0;
    dw[2] = u - cell;
    dw[1] = -dw[0] - dw[2];
    return cell;
}

// S and its derivatives over tau, q and psi.
INLINE void law_octets(const JointLaw *law, scalar tau, scalar q, scalar psi, octet sum[1 + LAW_AXES])
{
    const int *cells = law->cells;
    scalar w[LAW_AXES][3], dw[LAW_AXES][3];
    int place = axis_slopes(tau * cells[AXIS_TAU], cells[AXIS_TAU], w[AXIS_TAU], dw[AXIS_TAU]);
    place = place * (cells[AXIS_Q] + 2) +
            axis_slopes((q + 1.0) * (0.5 * cells[AXIS_Q]), cells[AXIS_Q], w[AXIS_Q], dw[AXIS_Q]);
    place = place * (cells[AXIS_PSI] + 2) +
            axis_slopes((psi + 1.0) * (0.5 * cells[AXIS_PSI]), cells[AXIS_PSI], w[AXIS_PSI], dw[AXIS_PSI]);

    const int row = LAW_WIDTH * (cells[AXIS_PSI] + 2), sheet = row * (cells[AXIS_Q] + 2);
    const double *from = law->coefficients + LAW_WIDTH * place;
    octet S = {{0}}, S_tau = {{0}}, S_q = {{0}}, S_psi = {{0}};
    for (int a = 0; a < 3; a++) {
        octet by_q = {{0}}, by_dq = {{0}}, by_dpsi = {{0}};
        for (int b = 0; b < 3; b++) {
            octet along = {{0}}, d_along = {{0}};
            for (int c = 0; c < 3; c++) {
                octet_add_from(w[AXIS_PSI][c], from + a * sheet + b * row + c * LAW_WIDTH, &along);
                octet_add_from(dw[AXIS_PSI][c], from + a * sheet + b * row + c * LAW_WIDTH, &d_along);
            }
            octet_add(w[AXIS_Q][b], &along, &by_q);
            octet_add(dw[AXIS_Q][b], &along, &by_dq);
            octet_add(w[AXIS_Q][b], &d_along, &by_dpsi);
        }
        octet_add(w[AXIS_TAU][a], &by_q, &S);
        octet_add(dw[AXIS_TAU][a], &by_q, &S_tau);
        octet_add(w[AXIS_TAU][a], &by_dq, &S_q);
        octet_add(w[AXIS_TAU][a], &by_dpsi, &S_psi);
    }
    sum[0] = S, sum[1] = S_tau, sum[2] = S_q, sum[3] = S_psi;
}

// The law at (L*, P) and its slopes: column k of the tangents.
static void ask_law(const JointLaw *law, const scalar load[3], scalar P, int k, JointTangents *t)
{
    const double inv_length = 1.0 / law->length;
    const scalar side = scalar_value(load[1]) < 0.0 ? -1.0 : 1.0;
    const scalar N = load[0], M_r = magnitude(load[1]), M_t = load[2];
    const scalar M = scalar_sqrt(M_r * M_r + M_t * M_t) * inv_length, W = scalar_sqrt(N * N + M * M),
                 s = P + W, inv_s = share(1.0, s);
    const scalar by_q = share(1.0, magnitude(N) + M), by_psi = share(1.0, magnitude(M_t) + M_r);

    // derivatives of M, s and of s times those of the coordinates in cells, over N, M_r, M_t and P
    const scalar inv_M = share(inv_length * inv_length, M), inv_W = share(1.0, W);
    const scalar dM[FOLLOW_GIVEN] = {0.0, M_r * inv_M, M_t * inv_M, 0.0};
    const scalar dq[2] = {s * (0.5 * law->cells[AXIS_Q]) * by_q * by_q * M,
                          -s * (0.5 * law->cells[AXIS_Q]) * by_q * by_q * N};  // over N, M
    const scalar dpsi = s * (0.5 * law->cells[AXIS_PSI]) * by_psi * by_psi;
    scalar along[FOLLOW_GIVEN][1 + LAW_AXES];
    for (int x = 0; x < FOLLOW_GIVEN; x++) {
        const scalar dW = (x == 0 ? N * inv_W : 0.0) + M * inv_W * dM[x];
        along[x][0] = x == 3 ? 1.0 : dW;
        along[x][1] = (x == 3 ? -W : P * dW) * inv_s * law->cells[AXIS_TAU];
        along[x][2] = (x == 0 ? dq[0] : 0.0) + dq[1] * dM[x];
        along[x][3] = x == 1 ? -M_t * dpsi : x == 2 ? M_r * dpsi : 0.0;
    }

    octet S[1 + LAW_AXES];
    law_octets(law, W * inv_s, N * by_q, M_t * by_psi, S);
    static const int PLACE[FOLLOW_VALUES] = {0, 1, 2, 4, 5, 6};  // of the values in an octet
    for (int i = 0; i < FOLLOW_VALUES; i++) t->value[i][k] = s * S[0].x[PLACE[i]];
    for (int x = 0; x < FOLLOW_GIVEN; x++) {
        octet slope = {{0}};
        for (int n = 0; n < 1 + LAW_AXES; n++) octet_add(along[x][n], &S[n], &slope);
        for (int i = 0; i < FOLLOW_VALUES; i++)
            t->slope[i][x][k] = x == 1 ? side * slope.x[PLACE[i]] : slope.x[PLACE[i]];
    }
    for (int i = 1; i < FOLLOW_VALUES; i += 3) {  // phi_r and m_r have the sign of M_r
        t->value[i][k] *= side;
        for (int x = 0; x < FOLLOW_GIVEN; x++) t->slope[i][x][k] *= side;
    }
    for (int i = 0; i < 3; i++) t->at[i][k] = load[i];
    t->at[3][k] = P;
}

// One number at all joints.
INLINE void fill(ball_array to, scalar value)
{
    for (int k = 0; k < PACKETS * LANE_WIDTH; k += LANE_WIDTH) wide_store(&to[k], wide_set(value));
}

// The tangent where all joints are alike, and their moves there.
static void begin_alike(const JointLaw *law, const constants intact, scalar spin_M, scalar spin_P,
                        JointTangents *t)
{
    static const int IN_PLANE[4] = {0, 2, 3, 5};  // u, phi_t, T, m_t
    scalar at[ALIKE_WIDTH];
    memset(t, 0, sizeof *t);
    t->known = true;
    find_alike(law, magnitude(spin_M) / law->length, spin_P, at);
    fill(t->at[0], at[ALIKE_N]);
    fill(t->at[2], at[ALIKE_M_T]);
    fill(t->at[3], spin_P);
    for (int n = 0; n < 4; n++) {
        const int i = IN_PLANE[n];
        const scalar *slope = &at[ALIKE_SLOPES + 3 * n];
        fill(t->value[i], at[ALIKE_U + n]);
        fill(t->slope[i][0], slope[0]);
        fill(t->slope[i][2], slope[1]);
        fill(t->slope[i][3], slope[2]);
    }
    fill(t->slope[1][1], at[ALIKE_PHI_R]);
    fill(t->slope[4][1], at[ALIKE_M_R_RIVET]);
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 2 * Z; k++) t->move[i][k] = t->value[i][0];

    for (int k = 0; k < Z; k++) {
        if (intact[k] > 0.0) continue;
        for (int i = 0; i < FOLLOW_VALUES; i++) {
            t->value[i][k] = 0.0;
            for (int x = 0; x < FOLLOW_GIVEN; x++) t->slope[i][x][k] = 0.0;
        }
        for (int x = 0; x < 3; x++) {
            const scalar unit[3] = {x == 0, x == 1, x == 2};
            scalar move[3];
            joint_free(law->K_0, unit, move);
            for (int i = 0; i < 3; i++) t->slope[i][x][k] = move[i];
            t->at[x][k] = 0.0;
        }
    }
}

// Value i of a packet of joints by their tangents.
INLINE wide answer(const JointTangents *t, int i, int k, const wide change[FOLLOW_GIVEN])
{
    wide value = wide_load(&t->value[i][k]);
    for (int x = 0; x < FOLLOW_GIVEN; x++) value = wide_fma(wide_load(&t->slope[i][x][k]), change[x], value);
    return value;
}

// What L* and P of a packet of joints are beyond their tangents' places.
INLINE void find_change(const JointTangents *t, const wide alone[3], const ball_array P, int k,
                        wide change[FOLLOW_GIVEN])
{
    for (int x = 0; x < 3; x++) change[x] = alone[x] - wide_load(&t->at[x][k]);
    change[3] = wide_load(&P[k]) - wide_load(&t->at[3][k]);
}

// Moves of all joints under L*.
INLINE void move_joints(const ball_array P, wide alone[PACKETS][3], JointTangents *t)
{
    wide move[PACKETS][3];
    for (int p = 0; p < PACKETS; p++) {
        wide change[FOLLOW_GIVEN];
        find_change(t, alone[p], P, p * LANE_WIDTH, change);
        for (int i = 0; i < 3; i++) move[p][i] = answer(t, i, p * LANE_WIDTH, change);
    }
    for (int turn = 0; turn < 2; turn++)
        for (int p = 0; p < PACKETS; p++)
            for (int i = 0; i < 3; i++) wide_store(&t->move[i][turn * Z + p * LANE_WIDTH], move[p][i]);
}

// Sweeps until L* changes no more; what is left are the moves under it.
static void settle(const JointLaw *law, ball_array bonded[3], const ball_array P, const wide s[PACKETS],
                   JointTangents *t, wide alone[PACKETS][3])
{
    find_alone(law, bonded, t->move, alone);
    for (int sweep = 1; sweep < FOLLOW_SWEEPS; sweep++) {
        wide next[PACKETS][3], most = wide_set(0.0);
        move_joints(P, alone, t);
        find_alone(law, bonded, t->move, next);
        for (int p = 0; p < PACKETS; p++) {
            const wide change =
                joint_size(law, next[p][0] - alone[p][0], next[p][1] - alone[p][1], next[p][2] - alone[p][2]);
            most = wide_max(most, change - SETTLED * s[p]);
            for (int i = 0; i < 3; i++) alone[p][i] = next[p][i];
        }
        if (!wide_any(wide_above(most, 0.0))) break;
    }
}

// Asks the law for the joints that are beyond the reach of their tangents; whether there are any.
static bool renew(const JointLaw *law, const ball_array P, const constants intact, const wide s[PACKETS],
                  wide alone[PACKETS][3], JointTangents *t)
{
    ball_array L[3];
    bool any = false;
    for (int p = 0; p < PACKETS; p++) {
        const int k = p * LANE_WIDTH;
        wide change[FOLLOW_GIVEN];
        find_change(t, alone[p], P, k, change);
        const wide beyond =
            joint_size(law, change[0], change[1], change[2]) + wide_abs(change[3]) - REACH * s[p];
        int mask = wide_mask(wide_above(wide_min(beyond, wide_load(&intact[k]) - 0.5), 0.0));
        if (mask == 0) continue;
        for (int i = 0; i < 3; i++) wide_store(&L[i][k], alone[p][i]);
        for (int j = k; mask != 0 && j < Z; mask >>= 1, j++) {
            if (!(mask & 1)) continue;
            ask_law(law, (const scalar[3]){L[0][j], L[1][j], L[2][j]}, P[j], j, t);
            any = true;
        }
    }
    return any;
}

void joints_follow(const JointLaw *law, ball_array bonded[3], const ball_array P, const constants intact,
                   scalar spin_M, scalar spin_P, JointTangents *t, ball_array load[3], ball_array rivet[3])
{
    wide alone[PACKETS][3], s[PACKETS];
    if (!t->known) {
        if (joints_open(law, bonded, P, intact, spin_M, spin_P, load, rivet) > FEW)
            begin_alike(law, intact, spin_M, spin_P, t);
        return;
    }
    for (int p = 0; p < PACKETS; p++) {
        const int k = p * LANE_WIDTH;
        s[p] = wide_load(&P[k]) +
               joint_size(law, wide_load(&bonded[0][k]), wide_load(&bonded[1][k]), wide_load(&bonded[2][k]));
    }
    settle(law, bonded, P, s, t, alone);
    for (int round = 0; round < ROUNDS && renew(law, P, intact, s, alone, t); round++) {
        move_joints(P, alone, t);
        settle(law, bonded, P, s, t, alone);
    }
    move_joints(P, alone, t);
    for (int p = 0; p < PACKETS; p++) {
        const int k = p * LANE_WIDTH;
        wide change[FOLLOW_GIVEN];
        find_change(t, alone[p], P, k, change);
        for (int i = 0; i < 3; i++) {
            wide left = alone[p][i];
            for (int m = 0; m < 3; m++)
                left = wide_fma(wide_set(-law->K_0[i][m]), wide_load(&t->move[m][Z + k]), left);
            wide_store(&load[i][k], left);
            wide_store(&rivet[i][k], answer(t, 3 + i, k, change));
        }
    }
}
