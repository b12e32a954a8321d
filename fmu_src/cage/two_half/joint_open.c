// Joints that open: see joint_open.h for the equations.
#include "cage/two_half/joint_open.h"

enum { SWEEPS = 6 };

static const double NEAR = 0.05, CHANGE = 0.01;

// |N| + (|M_r| + |M_t|)/l.
INLINE wide joint_size(const JointLaw *law, wide N, wide M_r, wide M_t)
{
    return wide_abs(N) + (wide_abs(M_r) + wide_abs(M_t)) * (1.0 / law->length);
}

// State of joints that are all alike, from the table's `uniform` for c and P, in newtons: by Catmull-Rom splines, because the
// tension decides the friction of the joints, and a kink at every knot would be a kink of the friction over the speed.
ONCE void find_uniform(const JointLaw *law, scalar c, scalar P, scalar at[UNIFORM_WIDTH])
{
    const int last = law->uniform_count - 2;
    const scalar s = c + P, x = scalar_value(s) > 0.0 ? c / s * (last + 1.0) : 0.0;
    const int i = (int)scalar_min(scalar_max(scalar_value(x), 0.0), last);
    const scalar t = x - i;
    scalar weight[4] = {0.5 * t * (t * (2.0 - t) - 1.0), 0.5 * (t * t * (3.0 * t - 5.0) + 2.0),
                        0.5 * t * (t * (4.0 - 3.0 * t) + 1.0), 0.5 * t * t * (t - 1.0)};
    const double *row[4] = {law->uniform[i - (i > 0)], law->uniform[i], law->uniform[i + 1],
                            law->uniform[i + 1 + (i < last)]};
    // beyond both ends the table goes on straight
    if (i == 0) weight[1] += weight[0], weight[2] -= weight[0];
    if (i == last) weight[2] += weight[3], weight[1] -= weight[3];
    for (int n = 0; n < UNIFORM_WIDTH; n++)
        at[n] = weight[0] * row[0][n] + weight[1] * row[1][n] + weight[2] * row[2][n] + weight[3] * row[3][n];
    for (int n = 0; n < UNIFORM_SLOPES; n++) at[n] *= s;
}

// Unknowns: moves of all joints, L_0 that the joints have answered to, loads of the rivets.
typedef struct {
    JointMoves move;
    ball_array trial[3], *rivet;
} Opening;

// Adds the joints k, k + 1, ... whose bit of the mask is set to those to be found by the law; returns how many these are.
INLINE int want(int count, int k, int mask, int wanted[Z])
{
    for (; mask != 0; mask >>= 1, k++)
        if (mask & 1 && k < Z) wanted[count++] = k;
    return count;
}

// Loads L_0 where all joints move alike: the bonded loads less those that the moves of the other joints relieve.
static void find_trial_uniform(const JointLaw *law, ball_array bonded[3], const scalar at[UNIFORM_WIDTH],
                               wide trial[PACKETS][3])
{
    for (int i = 0; i < 3; i++) {
        const scalar relieved = law->K_others[i][0] * at[UNIFORM_U] + law->K_others[i][2] * at[UNIFORM_PHI_T];
        for (int p = 0; p < PACKETS; p++)
            trial[p][i] = wide_load(&bonded[i][p * LANE_WIDTH]) - wide_set(relieved);
    }
}

// Joints near the state where all are alike answer to L_0 by their tangent there, unless they are broken.  The
// others keep their last answer, and those of them are wanted whose L_0 has changed since; in the first sweep
// all others are.  Returns how many are wanted.
static int answer_near(const JointLaw *law, ball_array bonded[3], const ball_array P, const constants intact,
                       scalar spin_P, const scalar at[UNIFORM_WIDTH], bool first, wide trial[PACKETS][3],
                       Opening *o, int wanted[Z])
{
    wide move[PACKETS][3];
    int count = 0;
    for (int p = 0; p < PACKETS; p++) {
        const int k = p * LANE_WIDTH;
        const wide *L = trial[p];
        const wide N = L[0] - at[UNIFORM_N], M_r = L[1], M_t = L[2] - at[UNIFORM_M_T],
                   more_P = wide_load(&P[k]) - spin_P;
        wide value[4];  // u, phi_t, T, m_t
        for (int n = 0; n < 4; n++) {
            const scalar *slope = &at[UNIFORM_SLOPES + 3 * n];
            value[n] = wide_fma(wide_set(slope[2]), more_P,
                                wide_fma(wide_set(slope[1]), M_t,
                                         wide_fma(wide_set(slope[0]), N, wide_set(at[UNIFORM_U + n]))));
        }
        wide near[9] = {value[0],
                        at[UNIFORM_PHI_R] * M_r,
                        value[1],
                        value[2],
                        at[UNIFORM_M_R_RIVET] * M_r,
                        value[3],
                        L[0],
                        L[1],
                        L[2]};  // moves, rivet, L*
        const wide s = wide_load(&P[k]) + joint_size(law, wide_load(&bonded[0][k]), wide_load(&bonded[1][k]),
                                                     wide_load(&bonded[2][k]));
        const wide beyond = joint_size(law, N, M_r, M_t) + wide_abs(more_P) - NEAR * s;
        const bits far = wide_above(wide_max(beyond, 0.5 - wide_load(&intact[k])), 0.0);
        if (first)
            count = want(count, k, wide_mask(far), wanted);
        else if (wide_any(far)) {
            wide before[9];
            for (int i = 0; i < 3; i++) {
                before[i] = wide_load(&o->move[i][k]);
                before[3 + i] = wide_load(&o->rivet[i][k]);
                before[6 + i] = wide_load(&o->trial[i][k]);
            }
            const bits changed = wide_above(
                joint_size(law, L[0] - before[6], L[1] - before[7], L[2] - before[8]) - CHANGE * s, 0.0);
            count = want(count, k, wide_mask(far & changed), wanted);
            for (int i = 0; i < 6; i++) near[i] = wide_select(far, before[i], near[i]);
            for (int i = 6; i < 9; i++)
                near[i] = wide_select(far, wide_select(changed, near[i], before[i]), near[i]);
        }
        for (int i = 0; i < 3; i++) {
            move[p][i] = near[i];
            wide_store(&o->rivet[i][k], near[3 + i]);
            wide_store(&o->trial[i][k], near[6 + i]);
        }
    }
    for (int turn = 0; turn < 2; turn++)
        for (int p = 0; p < PACKETS; p++)
            for (int i = 0; i < 3; i++) wide_store(&o->move[i][turn * Z + p * LANE_WIDTH], move[p][i]);
    return count;
}

// Asks the law for the joints that are wanted.
static void ask_law(const JointLaw *law, const ball_array P, const constants intact, int count,
                    const int wanted[Z], Opening *o)
{
    LawPlaces at;
    int placed = 0;  // packets whose places are found
    for (int n = 0; n < count; n++) {
        const int k = wanted[n];
        scalar move[3], carried[3] = {0.0, 0.0, 0.0}, energy;
        if (intact[k] > 0.0) {
            for (; placed <= k; placed += LANE_WIDTH) {
                if (placed + LANE_WIDTH <= k) continue;
                const wide L[3] = {wide_load(&o->trial[0][placed]), wide_load(&o->trial[1][placed]),
                                   wide_load(&o->trial[2][placed])};
                law_places(law, L, wide_load(&P[placed]), placed, &at);
            }
            law_answer(law, &at, k, o->trial[1][k], move, carried, &energy);
        } else {
            const scalar load[3] = {o->trial[0][k], o->trial[1][k], o->trial[2][k]};
            law_free(law->K_0, load, move);
        }
        for (int i = 0; i < 3; i++) {
            o->move[i][k] = o->move[i][Z + k] = move[i];
            o->rivet[i][k] = carried[i];
        }
    }
}

void joints_open(const JointLaw *law, ball_array bonded[3], const ball_array P, const constants intact,
                 scalar spin_M, scalar spin_P, ball_array load[3], ball_array rivet[3])
{
    scalar at[UNIFORM_WIDTH];
    wide L[PACKETS][3];
    Opening o;
    int wanted[Z];
    o.rivet = rivet;
    find_uniform(law, (scalar_value(spin_M) < 0.0 ? -spin_M : spin_M) / law->length, spin_P, at);
    find_trial_uniform(law, bonded, at, L);
    int count = answer_near(law, bonded, P, intact, spin_P, at, true, L, &o, wanted);
    for (int sweep = 0; sweep < SWEEPS && count > 0; sweep++) {
        if (sweep > 0) {
            law_trials(law, bonded, o.move, L);
            count = answer_near(law, bonded, P, intact, spin_P, at, false, L, &o, wanted);
        }
        ask_law(law, P, intact, count, wanted, &o);
    }
    for (int i = 0; i < 3; i++) {
        const wide K[3] = {wide_set(-law->K_0[i][0]), wide_set(-law->K_0[i][1]), wide_set(-law->K_0[i][2])};
        for (int k = 0; k < PACKETS * LANE_WIDTH; k += LANE_WIDTH) {
            wide left = wide_load(&o.trial[i][k]);
            for (int m = 0; m < 3; m++) left = wide_fma(K[m], wide_load(&o.move[m][Z + k]), left);
            wide_store(&load[i][k], left);
        }
    }
}
