// Loads of the joints in the plane of the split beside those of the motion: the load path gives the loads of bonded joints
// between halves that bend.
//
// A joint slips, by s along V: of the bonded V the part that friction and hole do not take is relieved through the slip
// stiffness of the halves (joint_slip).  Friction and play are those that the motion leaves over.
#include "cage/common/cage_joint.h"

enum { SLIP_SWEEPS = 3 };

// Slip of joints whose bonded load is V, and the loads of heads and hole that result, all along V.  K: slip stiffness
// of the halves around a joint.  Plates hold up to `plate`, then the heads drag the rivet (k_head) up to `head`,
// then the halves slip freely to `gap`, then the hole bears (k_hole):
//     V - K slip = plate + min(k_head slip, head) + k_hole max(0, slip - gap).
INLINE wide joint_slip(wide V, wide K, wide gap, wide plate, wide head, double k_head, wide k_hole,
                       wide *heads, wide *hole)
{
    // Each of the two branches of the heads is the larger slip where it holds; of two fractions with positive
    // denominators the larger one is chosen before the division.
    const wide zero = wide_set(0.0), beyond = V - plate, past = beyond - head, borne = k_hole * gap;
    const bits slides = wide_above(past * (K + k_head) - beyond * K, 0.0);
    const wide free = wide_select(slides, past, beyond) / wide_select(slides, K, K + k_head);
    const bits bears = wide_above(free - gap, 0.0);
    wide slip = wide_max(free, zero);
    if (wide_any(bears)) {
        const wide held = K + (k_head + k_hole), loose = K + k_hole;
        const bits pushes = wide_above((past + borne) * held - (beyond + borne) * loose, 0.0);
        const wide borne_slip =
            (wide_select(pushes, past, beyond) + borne) / wide_select(pushes, loose, held);
        slip = wide_select(bears, wide_max(borne_slip, zero), slip);
    }
    *heads = wide_min(k_head * slip, head);
    *hole = k_hole * wide_max(slip - gap, zero);
    return slip;
}

static void add_vector(ball_array sum[2], int k, wide r, wide t)
{
    wide_store(&sum[0][k], wide_load(&sum[0][k]) + r);
    wide_store(&sum[1][k], wide_load(&sum[1][k]) + t);
}

// Friction of plates and heads [N] and play [m] that the motion leaves over for more.
typedef struct {
    ball_array plates, heads, gap;
} SlipLimits;

// Adds the loads by the bonded loads V of joints of which some slip.
static void joints_slip(const Model *model, const SlipLimits *left, const ball_array V_r,
                        const ball_array V_t, JointShear *shear)
{
    const JointLaw *law = &rivet_table.half.law;
    const double (*K)[2] = law->K_slip[0];
    scalar slip[2][2 * Z + LANES] = {{0.0}};  // once more behind the last one
    for (int sweep = 0; sweep < SLIP_SWEEPS; sweep++) {
        ball_array next[2];
        wide trial[PACKETS][2];
        for (int p = 0; p < PACKETS; p++) {
            trial[p][0] = wide_load(&V_r[p * LANE_WIDTH]);
            trial[p][1] = wide_load(&V_t[p * LANE_WIDTH]);
        }
        for (int d = 1; sweep > 0 && d < Z; d++)
            for (int m = 0; m < 2; m++)
                for (int i = 0; i < 2; i++) {
                    const wide K_d = wide_set(law->K_slip[d][i][m]);
                    for (int p = 0; p < PACKETS; p++)
                        trial[p][i] =
                            wide_fma(-K_d, wide_load(&slip[m][Z - d + p * LANE_WIDTH]), trial[p][i]);
                }
        for (int p = 0; p < PACKETS; p++) {
            const int k = p * LANE_WIDTH;
            const wide r = trial[p][0], t = trial[p][1];
            const wide V_rt = wide_hypot(r, t), inv_V = wide_ratio(wide_set(1.0), V_rt), e_r = r * inv_V,
                       e_t = t * inv_V;
            const wide along = e_r * (K[0][0] * e_r + (K[0][1] + K[1][0]) * e_t) + K[1][1] * (e_t * e_t);
            const wide stiffness = wide_select(wide_above(V_rt, 0.0), along, wide_set(K[0][0]));
            wide head, hole;
            const wide gap = wide_load(&left->gap[k]), plate = wide_load(&left->plates[k]),
                       rest = wide_load(&left->heads[k]), k_hole = wide_load(&model->d->k_hole[k]);
            const wide moved =
                joint_slip(V_rt, stiffness, gap, plate, rest, model->d->k_head, k_hole, &head, &hole);
            const wide s_r = moved * e_r, s_t = moved * e_t;
            wide_store(&next[0][k], s_r);
            wide_store(&next[1][k], s_t);
            if (sweep < SLIP_SWEEPS - 1) continue;
            const wide left_r = r - (K[0][0] * s_r + K[0][1] * s_t),
                       left_t = t - (K[1][0] * s_r + K[1][1] * s_t), rivet = head + hole;
            add_vector(shear->plates, k, left_r - rivet * e_r, left_t - rivet * e_t);
            add_vector(shear->heads, k, head * e_r, head * e_t);
            add_vector(shear->shank, k, hole * e_r, hole * e_t);
        }
        for (int i = 0; i < 2; i++)
            for (int k = 0; k < Z; k++) slip[i][k] = slip[i][Z + k] = next[i][k];
    }
}

void joint_slip_add(const Model *model, const Work *w, const JointMotion *at, const ball_array V_r,
                    const ball_array V_t, JointShear *shear)
{
    const double mu = model->p->joint.mu;
    const wide zero = wide_set(0.0);
    SlipLimits left;
    bool slips = false;
    for (int k = 0; k < PACKETS * LANE_WIDTH; k += LANE_WIDTH) {
        const wide u = wide_hypot(wide_load(&at->u_y[k]), wide_load(&at->u_z[k]));
        const wide S = wide_hypot(wide_load(&w->S_y[k]), wide_load(&w->S_z[k]));
        const wide H = wide_hypot(wide_load(&w->H_y[k]), wide_load(&w->H_z[k]));
        const wide plates = wide_max(mu * wide_load(&at->N_plate[k]) - S, zero);
        slips |= wide_any(wide_above(wide_hypot(wide_load(&V_r[k]), wide_load(&V_t[k])) - plates, 0.0));
        wide_store(&left.plates[k], plates);
        wide_store(&left.heads[k], wide_max(mu * wide_load(&at->T[k]) - H, zero));
        wide_store(&left.gap[k], wide_max(wide_load(&model->d->hole_gap[k]) - u, zero));
    }
    if (slips)
        joints_slip(model, &left, V_r, V_t, shear);
    else
        for (int k = 0; k < PACKETS * LANE_WIDTH; k += LANE_WIDTH)
            add_vector(shear->plates, k, wide_load(&V_r[k]), wide_load(&V_t[k]));
}
