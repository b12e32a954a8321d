// Joints that slip under the loads of the load path: see joint_slip.h.
#include "cage/common/joint_slip.h"

#include "rivet/rivet_rom.h"

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

void joints_slip(const JointLaw *law, const ball_array V_r, const ball_array V_t, const SlipLimits *limits,
                 ball_array plates[2], ball_array heads[2], ball_array shank[2])
{
    bool slips = false;
    for (int k = 0; k < PACKETS * LANE_WIDTH; k += LANE_WIDTH)
        slips |= wide_any(wide_above(
            wide_hypot(wide_load(&V_r[k]), wide_load(&V_t[k])) - wide_load(&limits->plates[k]), 0.0));
    if (!slips) {
        for (int k = 0; k < PACKETS * LANE_WIDTH; k += LANE_WIDTH)
            add_vector(plates, k, wide_load(&V_r[k]), wide_load(&V_t[k]));
        return;
    }
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
            const wide gap = wide_load(&limits->gap[k]), plate = wide_load(&limits->plates[k]),
                       rest = wide_load(&limits->heads[k]), k_hole = wide_load(&limits->k_hole[k]);
            const wide moved =
                joint_slip(V_rt, stiffness, gap, plate, rest, limits->k_head, k_hole, &head, &hole);
            const wide s_r = moved * e_r, s_t = moved * e_t;
            wide_store(&next[0][k], s_r);
            wide_store(&next[1][k], s_t);
            if (sweep < SLIP_SWEEPS - 1) continue;
            const wide left_r = r - (K[0][0] * s_r + K[0][1] * s_t),
                       left_t = t - (K[1][0] * s_r + K[1][1] * s_t), rivet = head + hole;
            add_vector(plates, k, left_r - rivet * e_r, left_t - rivet * e_t);
            add_vector(heads, k, head * e_r, head * e_t);
            add_vector(shank, k, hole * e_r, hole * e_t);
        }
        for (int i = 0; i < 2; i++)
            for (int k = 0; k < Z; k++) slip[i][k] = slip[i][Z + k] = next[i][k];
    }
}

void joint_slip_add(const Model *model, const Work *w, const SlipState *at, const ball_array V_r,
                    const ball_array V_t, JointShear *shear)
{
    const Derived *d = model->d;
    const double mu = model->p->joint.mu;
    const wide zero = wide_set(0.0);
    SlipLimits left = {.k_head = d->k_head};  // friction and play that the motion leaves for more
    for (int k = 0; k < PACKETS * LANE_WIDTH; k += LANE_WIDTH) {
        const wide u = wide_hypot(wide_load(&at->u_y[k]), wide_load(&at->u_z[k]));
        const wide S = wide_hypot(wide_load(&w->S_y[k]), wide_load(&w->S_z[k]));
        const wide H = wide_hypot(wide_load(&w->H_y[k]), wide_load(&w->H_z[k]));
        wide_store(&left.plates[k], wide_max(mu * wide_load(&at->N_plate[k]) - S, zero));
        wide_store(&left.heads[k], wide_max(mu * wide_load(&at->T[k]) - H, zero));
        wide_store(&left.gap[k], wide_max(wide_load(&d->hole_gap[k]) - u, zero));
        wide_store(&left.k_hole[k], wide_load(&d->k_hole[k]));
    }
    joints_slip(&rivet_table.half.law, V_r, V_t, &left, shear->plates, shear->heads, shear->shank);
}
