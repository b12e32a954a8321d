// Loads of the rivets.
//
//   two halves   N = T - N_plate; the shank carries the hole force B, the heads the friction H; plate friction S bypasses the rivet;
//                the flexible cage half adds what a pocket force pries at the joints beside it (load_path.h)
//   rigid cage   the wrench between the halves, (half 1 - half 0)/2 as both have the same inertia, on the circle of rivets; its transverse
//                part loads plates (up to mu P), then heads (mu P), then the shank
//
// The path's transverse part reaches the shank only in a hole without play: elsewhere a slip far below the play relieves it.  Its moment is
// limited where it opens the joint.  Everything is in the body frame of half 0: rivets at angles 2 pi (k + 1/2)/Z.
#include "rivets.h"

#include "load_path.h"
#include "rotor.h"

INLINE real modulus(real y, real z)
{
    return real_sqrt(y * y + z * z);
}

static void two_half_load(const Model *model, const Work *w, RivetLoads *load)
{
    for (int k = 0; k < BUNDLES * LANE_WIDTH; k += LANE_WIDTH) {
        const real H_y = real_load(&w->H_y[k]), H_z = real_load(&w->H_z[k]), B_y = real_load(&w->B_y[k]), B_z = real_load(&w->B_z[k]);
        real_store(&load->P[k], real_set(model->d->P));
        real_store(&load->N[k], real_load(&w->T[k]) - real_load(&w->N_plate[k]));
        real_store(&load->V_y[k], -B_y);
        real_store(&load->V_z[k], -B_z);
        real_store(&load->F_head[k], modulus(H_y, H_z));
        real_store(&load->V[k], modulus(real_load(&w->S_y[k]) + H_y + B_y, real_load(&w->S_z[k]) + H_z + B_z));
    }
}

// Wrench of pockets and land on half 1 less that on half 0, halved, about the cage's centre in its body frame.
static void rigid_wrench(const Model *model, const Work *w, number wrench[6])
{
    const Rotor *cage = &w->half[0];
    const double width = model->p->cage.share_width;
    number global[6];
    for (int i = 0; i < 3; i++) {
        global[i] = 0.5 * (w->half[1].F[i] - w->half[0].F[i]);
        global[3 + i] = 0.5 * (w->half[1].M[i] - w->half[0].M[i]);
    }
    const Pockets *pocket = &w->pocket[0];  // half 0 holds the pocket forces: their share of half 1 less that of half 0 instead
    const number *wrenches[6] = {pocket->half_F_x, pocket->half_F_y, pocket->half_F_z, pocket->half_M_x, pocket->half_M_y, pocket->half_M_z};
    for (int j = 0; j < Z; j++) {
        const number F_x = pocket->F_x[j], F_t = pocket->F_t[j], F_2 = F_x * F_x + F_t * F_t;
        const number share = number_value(F_2) > 0.0 ? F_x / number_sqrt(F_x * F_x + width * width * F_2) : 0.0;
        for (int i = 0; i < 6; i++) global[i] += 0.5 * (1.0 + share) * wrenches[i][j];
    }
    const number *axes[3] = {cage->a, cage->b_y, cage->b_z};
    for (int i = 0; i < 3; i++) {
        wrench[i] = dot3(axes[i], global);
        wrench[3 + i] = dot3(axes[i], global + 3);
    }
}

static void rigid_load(const Model *model, const Work *w, RivetLoads *load)
{
    const double R = 0.5 * model->p->bearing.d_m, friction = model->p->joint.mu * model->d->P;
    double c[Z], s[Z];
    number wrench[6], V_y[Z], V_z[Z];
    rigid_wrench(model, w, wrench);
    for (int k = 0; k < Z; k++) {
        c[k] = model->d->rivet_y[k] / R;
        s[k] = model->d->rivet_z[k] / R;
    }
    load_path_rigid(2.0 * R, wrench, c, s, load->N, V_y, V_z);
    for (int k = 0; k < Z; k++) {
        const number V = number_sqrt(V_y[k] * V_y[k] + V_z[k] * V_z[k]);
        const number shank = number_value(V) > 2.0 * friction ? (V - 2.0 * friction) / V : 0.0;
        load->P[k] = model->d->P;
        load->V_y[k] = shank * V_y[k];
        load->V_z[k] = shank * V_z[k];
        load->F_head[k] = number_min(number_max(V - friction, 0.0), friction);
        load->V[k] = V;
    }
}

// Adds a vector (r, t) at every rivet, given radially and along the circle, to one along y and z.
INLINE void add_turned(const Model *model, const lanes r, const lanes t, number *y, number *z)
{
    const double per_R = 2.0 / model->p->bearing.d_m;
    for (int k = 0; k < BUNDLES * LANE_WIDTH; k += LANE_WIDTH) {
        const real c = real_load(&model->d->rivet_y[k]) * per_R, s = real_load(&model->d->rivet_z[k]) * per_R;
        const real v_r = real_load(&r[k]), v_t = real_load(&t[k]);
        real_store(&y[k], real_load(&y[k]) + v_r * c - v_t * s);
        real_store(&z[k], real_load(&z[k]) + v_r * s + v_t * c);
    }
}

void joint_prying(const JointData *j, RivetLoads *load)
{
    const real zero = real_set(0.0), one = real_set(1.0);
    for (int k = 0; k < BUNDLES * LANE_WIDTH; k += LANE_WIDTH) {
        const real M_y = real_load(&load->M_y[k]), M_z = real_load(&load->M_z[k]), M = modulus(M_y, M_z);
        const real M_0 = j->prying_lever * real_max(real_load(&load->P[k]) - real_max(real_load(&load->N[k]), zero), zero);
        const real part = real_select(real_above(M - M_0, 0.0), (M_0 + j->prying_share * (M - M_0)) / M, one);
        real_store(&load->M_y[k], M_y * part);
        real_store(&load->M_z[k], M_z * part);
    }
}

void rivets_load(const Model *model, const Work *w, RivetLoads *load)
{
    const bool rigid = model->p->scene.cage == CAGE_MODEL_RIGID, transverse = model->d->hole_gap == 0.0;
    *load = (RivetLoads){0};
    if (rigid)
        rigid_load(model, w, load);
    else
        two_half_load(model, w, load);

    PathLoads path = {0};
    for (int h = 0; h < (rigid ? 1 : 2); h++) {
        const Pockets *pocket = &w->pocket[h];
        load_path_flexible(rivet_table.load_path, h == 0 ? -1 : 1, transverse, pocket->F_x, pocket->F_r, pocket->F_t, &path);
    }
    for (int k = 0; k < BUNDLES * LANE_WIDTH; k += LANE_WIDTH) real_store(&load->N[k], real_load(&load->N[k]) + real_load(&path.sum[PATH_N][k]));
    if (transverse) add_turned(model, path.sum[PATH_V_R], path.sum[PATH_V_T], load->V_y, load->V_z);
    add_turned(model, path.sum[PATH_M_R], path.sum[PATH_M_T], load->M_y, load->M_z);
    joint_prying(&rivet_table.joint, load);
}
