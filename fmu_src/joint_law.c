// Joints that open and slip: see joint_law.h for the equations.
#include "joint_law.h"

#include "octet.h"

enum { SWEEPS = 6, SLIP_SWEEPS = 3 };
static const double CHANGE = 0.01;

INLINE wide ratio(wide part, wide whole)
{
    return wide_select(wide_above(whole, 0.0), part / wide_max(whole, wide_set(1e-300)), wide_set(0.0));
}

// ---- opening --------------------------------------------------------------------------------------------------------------------------------------
// Joints in the law's table: first coefficient, weights of the splines, s, sign of M_r.
typedef struct {
    ball_array place, w[LAW_AXES][3], s, side;
} LawPoints;

// Cell of u cells from the axis' start, and the weights of its three splines.
INLINE wide axis_weights(wide u, int cells, int k, ball_array w[3])
{
    const wide cell = wide_max(wide_min(wide_floor(u), wide_set(cells - 1.0)), wide_set(0.0)), up = u - cell, down = 1.0 - up;
    const wide w_0 = 0.5 * (down * down), w_2 = 0.5 * (up * up);
    wide_store(&w[0][k], w_0);
    wide_store(&w[1][k], 1.0 - w_0 - w_2);
    wide_store(&w[2][k], w_2);
    return cell;
}

INLINE void find_points(const JointLaw *law, const ball_array load[3], const ball_array P, int k, LawPoints *at)
{
    const double inv_length = 1.0 / law->length, cells[LAW_AXES] = {law->cells[0], law->cells[1], law->cells[2]};
    const wide N = wide_load(&load[0][k]), M_r = wide_load(&load[1][k]), M_t = wide_load(&load[2][k]);
    const wide M = wide_hypot(M_r, M_t) * inv_length, W = wide_hypot(N, M), s = wide_load(&P[k]) + W;
    const wide q = ratio(N, wide_abs(N) + M), psi = ratio(M_t, wide_abs(M_t) + wide_abs(M_r));
    const wide tau_cell = axis_weights(ratio(W, s) * cells[AXIS_TAU], law->cells[AXIS_TAU], k, at->w[AXIS_TAU]);
    const wide q_cell = axis_weights((q + 1.0) * (0.5 * cells[AXIS_Q]), law->cells[AXIS_Q], k, at->w[AXIS_Q]);
    const wide psi_cell = axis_weights((psi + 1.0) * (0.5 * cells[AXIS_PSI]), law->cells[AXIS_PSI], k, at->w[AXIS_PSI]);
    wide_store(&at->place[k], (tau_cell * (cells[AXIS_Q] + 2.0) + q_cell) * (cells[AXIS_PSI] + 2.0) + psi_cell);
    wide_store(&at->s[k], s);
    wide_store(&at->side[k], wide_select(wide_above(-M_r, 0.0), wide_set(-1.0), wide_set(1.0)));
}

// Moves of a joint's pad and loads of its rivet.
INLINE void joint_law(const JointLaw *law, const LawPoints *at, int k, scalar move[3], scalar rivet[3])
{
    const int row = LAW_WIDTH * (law->cells[AXIS_PSI] + 2), sheet = row * (law->cells[AXIS_Q] + 2);
    const double *from = law->coefficients + LAW_WIDTH * (int)scalar_value(at->place[k]);
    octet sum = {{0}};
    for (int a = 0; a < 3; a++) {
        octet by_q = {{0}};
        for (int b = 0; b < 3; b++) {
            octet by_psi = {{0}};
            for (int c = 0; c < 3; c++) octet_add_from(at->w[AXIS_PSI][c][k], from + a * sheet + b * row + c * LAW_WIDTH, &by_psi);
            octet_add(at->w[AXIS_Q][b][k], &by_psi, &by_q);
        }
        octet_add(at->w[AXIS_TAU][a][k], &by_q, &sum);
    }
    const scalar s = at->s[k], across = s * at->side[k];
    move[0] = s * sum.x[0], move[1] = across * sum.x[1], move[2] = s * sum.x[2];
    rivet[0] = s * sum.x[4], rivet[1] = across * sum.x[5], rivet[2] = s * sum.x[6];
}

// Moves of all joints, once more behind the last one, so that those of neighbours lie side by side.
typedef scalar Moves[3][2 * Z + LANES];

// L* of a packet of joints.
INLINE void load_alone(const JointLaw *law, const ball_array bonded[3], Moves moves, int k, wide alone[3])
{
    for (int i = 0; i < 3; i++) alone[i] = wide_load(&bonded[i][k]);
    for (int n = 0; n < law->neighbours; n++) {
        const int j = k + Z - law->neighbour[n];
        for (int m = 0; m < 3; m++) {
            const wide move = wide_load(&moves[m][j]);
            for (int i = 0; i < 3; i++) alone[i] = wide_fma(wide_set(-law->K[n][i][m]), move, alone[i]);
        }
    }
}

// |N| + (|M_r| + |M_t|)/l.
INLINE wide size(const JointLaw *law, wide N, wide M_r, wide M_t)
{
    return wide_abs(N) + (wide_abs(M_r) + wide_abs(M_t)) * (1.0 / law->length);
}

// L* of the first sweep: all joints have moved alike.
static void start_alone(const JointLaw *law, const ball_array bonded[3], scalar spin_M, scalar spin_P, ball_array alone[3])
{
    const scalar c = (scalar_value(spin_M) < 0.0 ? -spin_M : spin_M) / law->length, s = spin_P + c;
    const scalar x = scalar_value(s) > 0.0 ? c / s * (law->starts - 1.0) : 0.0;
    const int i = (int)fmin(fmax(scalar_value(x), 0.0), law->starts - 2.0);
    scalar move[3];
    for (int m = 0; m < 3; m++) move[m] = s * (law->start[i][m] + (x - i) * (law->start[i + 1][m] - law->start[i][m]));
    for (int n = 0; n < 3; n++) {
        const scalar relieved = law->K_others[n][0] * move[0] + law->K_others[n][1] * move[1] + law->K_others[n][2] * move[2];
        for (int k = 0; k < PACKETS * LANE_WIDTH; k += LANE_WIDTH) wide_store(&alone[n][k], wide_load(&bonded[n][k]) - wide_set(relieved));
    }
}

// The joints whose L* has changed by more than CHANGE s; theirs is taken over.
static int find_changed(const JointLaw *law, const ball_array bonded[3], const ball_array P, Moves moves, ball_array alone[3], int joint[Z],
                        bool packet[PACKETS])
{
    int count = 0;
    for (int p = 0; p < PACKETS; p++) {
        const int k = p * LANE_WIDTH;
        wide load[3], before[3];
        load_alone(law, bonded, moves, k, load);
        for (int i = 0; i < 3; i++) before[i] = wide_load(&alone[i][k]);
        const wide limit = CHANGE * (wide_load(&P[k]) + size(law, wide_load(&bonded[0][k]), wide_load(&bonded[1][k]), wide_load(&bonded[2][k])));
        const bits above = wide_above(size(law, load[0] - before[0], load[1] - before[1], load[2] - before[2]) - limit, 0.0);
        packet[p] = wide_any(above);
        if (!packet[p]) continue;
        ball_array flag;
        wide_store(&flag[k], wide_select(above, wide_set(1.0), wide_set(0.0)));
        for (int i = 0; i < 3; i++) wide_store(&alone[i][k], wide_select(above, load[i], before[i]));
        for (int i = k; i < k + LANE_WIDTH && i < Z; i++)
            if (scalar_value(flag[i]) > 0.0) joint[count++] = i;
    }
    return count;
}

void joints_open(const JointLaw *law, const ball_array bonded[3], const ball_array P, scalar spin_M, scalar spin_P, ball_array load[3], ball_array rivet[3])
{
    ball_array alone[3];
    Moves moves;
    LawPoints at;
    int joint[Z], count = Z;
    bool packet[PACKETS];
    for (int k = 0; k < Z; k++) joint[k] = k;
    for (int p = 0; p < PACKETS; p++) packet[p] = true;
    for (int i = 0; i < 3; i++) {  // padding
        for (int k = 2 * Z; k < 2 * Z + LANES; k++) moves[i][k] = 0.0;
        for (int k = Z; k < LANES; k++) rivet[i][k] = 0.0;
    }
    start_alone(law, bonded, spin_M, spin_P, alone);
    for (int sweep = 0; count > 0 && sweep < SWEEPS; sweep++) {
        if (sweep > 0) count = find_changed(law, bonded, P, moves, alone, joint, packet);
        for (int p = 0; p < PACKETS; p++)
            if (packet[p]) find_points(law, alone, P, p * LANE_WIDTH, &at);
        for (int n = 0; n < count; n++) {
            const int k = joint[n];
            scalar move[3], carried[3];
            joint_law(law, &at, k, move, carried);
            for (int i = 0; i < 3; i++) {
                moves[i][k] = moves[i][Z + k] = move[i];
                rivet[i][k] = carried[i];
            }
        }
    }
    for (int k = 0; k < PACKETS * LANE_WIDTH; k += LANE_WIDTH)
        for (int i = 0; i < 3; i++) {
            wide left = wide_load(&alone[i][k]);
            for (int m = 0; m < 3; m++) left = wide_fma(wide_set(-law->K_0[i][m]), wide_load(&moves[m][Z + k]), left);
            wide_store(&load[i][k], left);
        }
}

// ---- slip -----------------------------------------------------------------------------------------------------------------------------------------
// Slip of joints that would carry V bonded, and what heads and hole then carry, all along V.  K: slip stiffness of the halves around a joint.  Plates
// hold up to `plate`, then the heads drag the rivet (k_head) up to `head`, then the halves slip freely to `gap`, then the hole bears (k_hole):
//     V - K slip = plate + min(k_head slip, head) + k_hole max(0, slip - gap).
INLINE wide joint_slip(wide V, wide K, wide gap, wide plate, wide head, double k_head, double k_hole, wide *heads, wide *hole)
{
    const wide zero = wide_set(0.0), beyond = V - plate;
    const wide free = wide_max(beyond / (K + k_head), (beyond - head) / K);
    const wide bears = wide_max((beyond + k_hole * gap) / (K + (k_head + k_hole)), (beyond - head + k_hole * gap) / (K + k_hole));
    const wide slip = wide_max(wide_select(wide_above(free - gap, 0.0), bears, free), zero);
    *heads = wide_min(k_head * slip, head);
    *hole = k_hole * wide_max(slip - gap, zero);
    return slip;
}

static void add_vector(ball_array sum[2], int k, wide r, wide t)
{
    wide_store(&sum[0][k], wide_load(&sum[0][k]) + r);
    wide_store(&sum[1][k], wide_load(&sum[1][k]) + t);
}

void joints_slip(const JointLaw *law, const ball_array V[2], const SlipLimits *limits, ball_array plates[2], ball_array heads[2], ball_array shank[2])
{
    bool slips = false;
    for (int k = 0; k < PACKETS * LANE_WIDTH; k += LANE_WIDTH)
        slips |= wide_any(wide_above(wide_hypot(wide_load(&V[0][k]), wide_load(&V[1][k])) - wide_load(&limits->plates[k]), 0.0));
    if (!slips) {
        for (int k = 0; k < PACKETS * LANE_WIDTH; k += LANE_WIDTH) add_vector(plates, k, wide_load(&V[0][k]), wide_load(&V[1][k]));
        return;
    }
    const double (*K)[2] = law->K_slip[0];
    scalar slip[2][2 * Z + LANES] = {{0.0}};  // once more behind the last one
    for (int sweep = 0; sweep < SLIP_SWEEPS; sweep++) {
        ball_array next[2];
        for (int k = 0; k < PACKETS * LANE_WIDTH; k += LANE_WIDTH) {
            wide r = wide_load(&V[0][k]), t = wide_load(&V[1][k]);
            for (int d = 1; sweep > 0 && d < Z; d++) {
                const wide slip_r = wide_load(&slip[0][k + Z - d]), slip_t = wide_load(&slip[1][k + Z - d]);
                r = wide_fma(wide_set(-law->K_slip[d][0][1]), slip_t, wide_fma(wide_set(-law->K_slip[d][0][0]), slip_r, r));
                t = wide_fma(wide_set(-law->K_slip[d][1][1]), slip_t, wide_fma(wide_set(-law->K_slip[d][1][0]), slip_r, t));
            }
            const wide V_rt = wide_hypot(r, t), e_r = ratio(r, V_rt), e_t = ratio(t, V_rt);
            const wide along = e_r * (K[0][0] * e_r + (K[0][1] + K[1][0]) * e_t) + K[1][1] * (e_t * e_t);
            const wide stiffness = wide_select(wide_above(V_rt, 0.0), along, wide_set(K[0][0]));
            wide head, hole;
            const wide gap = wide_load(&limits->gap[k]), plate = wide_load(&limits->plates[k]), rest = wide_load(&limits->heads[k]);
            const wide moved = joint_slip(V_rt, stiffness, gap, plate, rest, limits->k_head, limits->k_hole, &head, &hole);
            const wide s_r = moved * e_r, s_t = moved * e_t;
            wide_store(&next[0][k], s_r);
            wide_store(&next[1][k], s_t);
            if (sweep < SLIP_SWEEPS - 1) continue;
            const wide left_r = r - (K[0][0] * s_r + K[0][1] * s_t), left_t = t - (K[1][0] * s_r + K[1][1] * s_t), rivet = head + hole;
            add_vector(plates, k, left_r - rivet * e_r, left_t - rivet * e_t);
            add_vector(heads, k, head * e_r, head * e_t);
            add_vector(shank, k, hole * e_r, hole * e_t);
        }
        for (int i = 0; i < 2; i++)
            for (int k = 0; k < Z; k++) slip[i][k] = slip[i][Z + k] = next[i][k];
    }
}
