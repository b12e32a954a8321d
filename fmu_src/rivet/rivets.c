// Loads of the rivets.
//
//   elastic      all loads are those of the dynamics' joints, whose halves bend (cage_elastic.c): nothing is added
//   two halves   N = T - N_plate of the dynamics' joints; plates S, heads H and hole B carry the transverse load
//
// To this rigid share the elastic halves add what bonded joints would carry of pocket forces and of the cage's
// own centrifugal load (half_path.h).  Joints that open and slip relieve it (joint_law.h); in the plane they have
// for it what the rigid share leaves of friction and play.  The work of the added loads is that of the halves'
// elastic deformation, which the dynamics of rigid halves does not have: on rigid halves the centrifugal loads
// of all parts balance, so that they do no work and the energy balance has no term for them.
//
// In a frame that turns, the centrifugal load is that of the speed in the fixed frame; a uniform field of gravity or of
// the frame's acceleration acts on a half as its own acceleration does, and is in the load path's balance of forces.
//
// The tangential inertia load of a cage whose speed changes (Euler's) is to the centrifugal one as omega_dot to
// omega^2: 1.3 % in a run-up to 18,238 r/min within 0.1 s, 0.013 % within 10 s, so it is left out.  What a
// pocket force accelerates is in the load path: its finite elements balance the force by the half's inertia.
//
// All loads are on the +x half, in the frames (x, r, t) of the rivets, at body angles 2 pi (k + 1/2)/Z of half 0.
#include "rivet/rivets.h"

#include "cage/common/cage_joint.h"
#include "cage/common/pocket.h"
#include "physics/rotor.h"

// What rigid halves do to the joints: external tension, transverse loads (r, t) of plates, heads and shank, and
// what these leave for more.
typedef struct {
    ball_array N, plates[2], heads[2], shank[2];
    SlipLimits left;
} RigidShare;

// A vector (y, z) at a packet of rivets, radially and along the circle.
INLINE void store_turned(const Model *model, wide y, wide z, int k, ball_array to[2])
{
    const double inv_R = 2.0 / rivet_table.joint.d_m;
    const wide c = wide_load(&model->d->rivet_y[k]) * inv_R, s = wide_load(&model->d->rivet_z[k]) * inv_R;
    wide_store(&to[0][k], y * c + z * s);
    wide_store(&to[1][k], z * c - y * s);
}

// The dynamics' joints.
static void two_half_share(const Model *model, const Work *w, RigidShare *share)
{
    const Derived *d = model->d;
    const double mu = model->p->joint.mu;
    const wide zero = wide_set(0.0), dT = wide_set(cage_joint_prying(model, w));
    for (int k = 0; k < PACKETS * LANE_WIDTH; k += LANE_WIDTH) {
        const wide T = wide_load(&w->T[k]), N_plate = wide_load(&w->N_plate[k]),
                   u = wide_hypot(wide_load(&w->u_y[k]), wide_load(&w->u_z[k]));
        const wide S_y = wide_load(&w->S_y[k]), S_z = wide_load(&w->S_z[k]), H_y = wide_load(&w->H_y[k]),
                   H_z = wide_load(&w->H_z[k]);
        wide_store(&share->N[k], T - N_plate);
        store_turned(model, -S_y, -S_z, k, share->plates);
        store_turned(model, -H_y, -H_z, k, share->heads);
        store_turned(model, -wide_load(&w->B_y[k]), -wide_load(&w->B_z[k]), k, share->shank);
        const wide intact = wide_load(&d->intact[k]), more = dT * intact;
        wide_store(&share->left.plates[k], wide_max(mu * (N_plate + more) - wide_hypot(S_y, S_z), zero));
        wide_store(&share->left.heads[k], wide_max(mu * (T + more) - wide_hypot(H_y, H_z), zero));
        wide_store(&share->left.gap[k], wide_max(wide_load(&d->hole_gap[k]) - u, zero));
        wide_store(&share->left.k_hole[k], wide_load(&d->k_hole[k]));
    }
}

// The dynamics has all loads of the joints between elastic halves.
static void elastic_loads(const Model *model, const Work *w, JointLoads *load)
{
    ball_array plates[2], heads[2], shank[2];
    for (int k = 0; k < PACKETS * LANE_WIDTH; k += LANE_WIDTH) {
        store_turned(model, -wide_load(&w->S_y[k]), -wide_load(&w->S_z[k]), k, plates);
        store_turned(model, -wide_load(&w->H_y[k]), -wide_load(&w->H_z[k]), k, heads);
        store_turned(model, -wide_load(&w->B_y[k]), -wide_load(&w->B_z[k]), k, shank);
        const wide heads_r = wide_load(&heads[0][k]), heads_t = wide_load(&heads[1][k]);
        const wide V_r = wide_load(&shank[0][k]), V_t = wide_load(&shank[1][k]);
        wide_store(&load->N[k], wide_load(&w->joint_load[0][k]));
        wide_store(&load->M_r[k], wide_load(&w->joint_load[1][k]));
        wide_store(&load->M_t[k], wide_load(&w->joint_load[2][k]));
        wide_store(&load->V[k], wide_hypot(wide_load(&plates[0][k]) + heads_r + V_r,
                                           wide_load(&plates[1][k]) + heads_t + V_t));
        wide_store(&load->T[k], wide_load(&w->T[k]));
        wide_store(&load->m_r[k], wide_load(&w->joint_rivet[1][k]));
        wide_store(&load->m_t[k], wide_load(&w->joint_rivet[2][k]));
        wide_store(&load->V_r[k], V_r);
        wide_store(&load->V_t[k], V_t);
        wide_store(&load->F_head[k], wide_load(&model->d->intact[k]) * wide_hypot(heads_r, heads_t));
    }
}

// Loads of all joints; tangents: of the instant before, or NULL.
static void find_loads(const Model *model, const Work *w, JointTangents *tangents, JointLoads *load)
{
    if (model->elastic) {
        elastic_loads(model, w, load);
        return;
    }
    const Derived *d = model->d;
    const CageHalfData *half = &rivet_table.half;
    RigidShare share;
    share.left.k_head = d->k_head;
    two_half_share(model, w, &share);

    // what bonded joints of elastic halves would carry
    PathRows rows;
    PathForces forces[2];
    for (int h = 0; h < 2; h++)
        forces[h] = (PathForces){w->pocket[h].F_x, w->pocket[h].F_r, w->pocket[h].F_t, w->pocket[h].push_x, w->pocket[h].push_t};
    const bool touched = half_path_rows(&half->path, forces, &rows);
    const scalar s_0 = w->half[0].s + w->frame_omega, s_1 = w->half[1].s + w->frame_omega;
    const scalar omega2 = 0.5 * (s_0 * s_0 + s_1 * s_1);
    for (int i = 0; i < ROWS; i++) {
        const wide spin = wide_set(omega2 * d->spin[i]);
        for (int k = 0; k < PACKETS * LANE_WIDTH; k += LANE_WIDTH)
            wide_store(&rows.row[i][k], touched ? wide_load(&rows.row[i][k]) + spin : spin);
    }

    // joints that open
    ball_array bonded[3], P, open[3], rivet[3];
    for (int k = 0; k < PACKETS * LANE_WIDTH; k += LANE_WIDTH) {
        wide_store(&bonded[0][k], wide_load(&share.N[k]) + wide_load(&rows.row[ROW_N][k]));
        wide_store(&bonded[1][k], wide_load(&rows.row[ROW_M_R][k]));
        wide_store(&bonded[2][k], wide_load(&rows.row[ROW_M_T][k]));
        wide_store(&P[k], wide_load(&d->intact[k]) *
                              wide_max(wide_load(&d->P[k]) + wide_load(&rows.row[ROW_DP][k]), wide_set(0.0)));
    }
    const scalar spin_M = omega2 * d->spin[ROW_M_T],
                 spin_P = scalar_max(d->P_mean + omega2 * d->spin[ROW_DP], 0.0);
    if (tangents == NULL)
        joints_open(&half->law, bonded, P, d->intact, spin_M, spin_P, open, rivet);
    else
        joints_follow(&half->law, bonded, P, d->intact, spin_M, spin_P, tangents, open, rivet);

    // joints that slip: under the centrifugal load alone none does
    if (touched)
        joints_slip(&half->law, rows.row[ROW_V_R], rows.row[ROW_V_T], &share.left, share.plates, share.heads,
                    share.shank);

    for (int k = 0; k < PACKETS * LANE_WIDTH; k += LANE_WIDTH) {
        const wide heads_r = wide_load(&share.heads[0][k]), heads_t = wide_load(&share.heads[1][k]);
        const wide V_r = wide_load(&share.shank[0][k]), V_t = wide_load(&share.shank[1][k]);
        wide_store(&load->N[k], wide_load(&open[0][k]));
        wide_store(&load->M_r[k], wide_load(&open[1][k]));
        wide_store(&load->M_t[k], wide_load(&open[2][k]));
        wide_store(&load->V[k], wide_hypot(wide_load(&share.plates[0][k]) + heads_r + V_r,
                                           wide_load(&share.plates[1][k]) + heads_t + V_t));
        const wide intact = wide_load(&d->intact[k]);
        wide_store(&load->T[k], wide_load(&rivet[0][k]));
        wide_store(&load->m_r[k], intact * (wide_load(&rivet[1][k]) + wide_load(&rows.row[ROW_DM_R][k])));
        wide_store(&load->m_t[k], intact * (wide_load(&rivet[2][k]) + wide_load(&rows.row[ROW_DM_T][k])));
        wide_store(&load->V_r[k], V_r);
        wide_store(&load->V_t[k], V_t);
        wide_store(&load->F_head[k], intact * wide_hypot(heads_r, heads_t));
    }
}

void rivets_load(const Model *model, const Work *w, JointLoads *load)
{
    find_loads(model, w, NULL, load);
}

void rivets_follow(const Model *model, const Work *w, JointTangents *tangents, JointLoads *load)
{
    find_loads(model, w, tangents, load);
}
