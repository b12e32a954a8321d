// Loads of the rivets.
//
//   two halves   N = T - N_plate; the shank carries the hole force B, the heads the friction H; plate friction S
//                bypasses the rivet; the flexible cage half adds the loads by which a pocket force pries the joints
//                beside it open (load_path.h)
//   rigid cage   the wrench between the halves, (half 1 - half 0)/2 as both have the same inertia, on the circle of
//                rivets; its transverse part loads plates (up to mu P), then heads (mu P), then the shank
//
// The transverse part of the load path reaches the shank only in a hole without play: in a hole with play the
// joint relieves this part by slipping, by much less than the play.  The prying moment is limited where it
// opens the joint.  All loads are in the body frame of half 0; the rivets are at angles 2 pi (k + 1/2)/Z.
#include "rivets.h"

#include "load_path.h"
#include "pocket.h"
#include "rotor.h"

// Length of the vector (y, z).
INLINE wide modulus(wide y, wide z)
{
    return wide_sqrt(y * y + z * z);
}

// Loads of the joints between two halves, without the flexible share.
static void two_half_load(const Model *model, const Work *w, RivetLoads *load)
{
    for (int k = 0; k < PACKETS * LANE_WIDTH; k += LANE_WIDTH) {
        const wide H_y = wide_load(&w->H_y[k]), H_z = wide_load(&w->H_z[k]), B_y = wide_load(&w->B_y[k]);
        const wide B_z = wide_load(&w->B_z[k]);
        wide_store(&load->P[k], wide_set(model->d->P));
        wide_store(&load->N[k], wide_load(&w->T[k]) - wide_load(&w->N_plate[k]));
        wide_store(&load->V_y[k], -B_y);
        wide_store(&load->V_z[k], -B_z);
        wide_store(&load->F_head[k], modulus(H_y, H_z));
        wide_store(&load->V[k],
                   modulus(wide_load(&w->S_y[k]) + H_y + B_y, wide_load(&w->S_z[k]) + H_z + B_z));
    }
}

// Wrench of pockets and land on half 1 less that on half 0, halved, about the cage's centre in its body
// frame.
static void rigid_wrench(const Work *w, const Pockets *on_1, scalar wrench[6])
{
    const Rotor *cage = &w->half[0];
    scalar global[6];
    for (int i = 0; i < 3; i++) {
        global[i] = 0.5 * (w->half[1].F[i] - w->half[0].F[i]);
        global[3 + i] = 0.5 * (w->half[1].M[i] - w->half[0].M[i]);
    }

    // half 0 holds all pocket forces: those of half 1 go over to it
    const scalar *pockets[6] = {on_1->half_F_x, on_1->half_F_y, on_1->half_F_z,
                                on_1->half_M_x, on_1->half_M_y, on_1->half_M_z};
    for (int i = 0; i < 6; i++) global[i] += ball_array_sum(pockets[i]);

    // into the body frame
    const scalar *axes[3] = {cage->a, cage->b_y, cage->b_z};
    for (int i = 0; i < 3; i++) {
        wrench[i] = dot3(axes[i], global);
        wrench[3 + i] = dot3(axes[i], global + 3);
    }
}

// Loads of the joints of a rigid cage, without the flexible share.
static void rigid_load(const Model *model, const Work *w, const Pockets *on_1, RivetLoads *load)
{
    const double R = 0.5 * model->p->bearing.d_m, friction = model->p->joint.mu * model->d->P;
    double c[Z], s[Z];
    scalar wrench[6], V_y[Z], V_z[Z];
    rigid_wrench(w, on_1, wrench);
    for (int k = 0; k < Z; k++) {
        c[k] = model->d->rivet_y[k] / R;
        s[k] = model->d->rivet_z[k] / R;
    }
    load_path_rigid(2.0 * R, wrench, c, s, load->N, V_y, V_z);
    for (int k = 0; k < Z; k++) {
        const scalar V = scalar_sqrt(V_y[k] * V_y[k] + V_z[k] * V_z[k]);
        const scalar shank = scalar_value(V) > 2.0 * friction ? (V - 2.0 * friction) / V : 0.0;
        load->P[k] = model->d->P;
        load->V_y[k] = shank * V_y[k];
        load->V_z[k] = shank * V_z[k];
        load->F_head[k] = scalar_min(scalar_max(V - friction, 0.0), friction);
        load->V[k] = V;
    }
}

// Adds a vector at every rivet, given by its radial and tangential parts (r, t), to a vector given along y
// and z.
INLINE void add_turned(const Model *model, const ball_array r, const ball_array t, scalar *y, scalar *z)
{
    const double inv_R = 2.0 / model->p->bearing.d_m;
    for (int k = 0; k < PACKETS * LANE_WIDTH; k += LANE_WIDTH) {
        const wide c = wide_load(&model->d->rivet_y[k]) * inv_R, s = wide_load(&model->d->rivet_z[k]) * inv_R;
        const wide v_r = wide_load(&r[k]), v_t = wide_load(&t[k]);
        wide_store(&y[k], wide_load(&y[k]) + v_r * c - v_t * s);
        wide_store(&z[k], wide_load(&z[k]) + v_r * s + v_t * c);
    }
}

void joint_prying(const JointData *j, RivetLoads *load)
{
    const wide zero = wide_set(0.0), one = wide_set(1.0);
    for (int k = 0; k < PACKETS * LANE_WIDTH; k += LANE_WIDTH) {
        const wide M_y = wide_load(&load->M_y[k]), M_z = wide_load(&load->M_z[k]), M = modulus(M_y, M_z);
        const wide M_0 =
            j->prying_lever * wide_max(wide_load(&load->P[k]) - wide_max(wide_load(&load->N[k]), zero), zero);
        const wide part = wide_select(wide_above(M - M_0, 0.0), (M_0 + j->prying_share * (M - M_0)) / M, one);
        wide_store(&load->M_y[k], M_y * part);
        wide_store(&load->M_z[k], M_z * part);
    }
}

void rivets_load(const Model *model, const Work *w, RivetLoads *load)
{
    const bool rigid = model->p->scene.cage == CAGE_MODEL_RIGID, transverse = model->d->hole_gap == 0.0;
    const Pockets *on = w->pocket;
    Pockets split[2];
    *load = (RivetLoads){0};
    if (rigid) {
        pocket_split(model, w, split);
        on = split;
        rigid_load(model, w, &split[1], load);
    } else
        two_half_load(model, w, load);

    // flexible share
    PathLoads path = {0};
    for (int h = 0; h < 2; h++)
        load_path_flexible(rivet_table.load_path, h == 0 ? -1 : 1, transverse, on[h].F_x, on[h].F_r,
                           on[h].F_t, &path);
    for (int k = 0; k < PACKETS * LANE_WIDTH; k += LANE_WIDTH)
        wide_store(&load->N[k], wide_load(&load->N[k]) + wide_load(&path.sum[PATH_N][k]));
    if (transverse) add_turned(model, path.sum[PATH_V_R], path.sum[PATH_V_T], load->V_y, load->V_z);
    add_turned(model, path.sum[PATH_M_R], path.sum[PATH_M_T], load->M_y, load->M_z);
    joint_prying(&rivet_table.joint, load);
}
