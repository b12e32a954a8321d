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

static void two_half_load(const Model *model, const Work *w, RivetLoad load[Z], number V[Z])
{
    for (int k = 0; k < Z; k++) {
        const number V_y = w->S_y[k] + w->H_y[k] + w->B_y[k], V_z = w->S_z[k] + w->H_z[k] + w->B_z[k];
        load[k] = (RivetLoad){.P = model->d->P,
                              .N = w->T[k] - w->N_plate[k],
                              .V_y = -w->B_y[k],
                              .V_z = -w->B_z[k],
                              .F_head = number_sqrt(w->H_y[k] * w->H_y[k] + w->H_z[k] * w->H_z[k])};
        V[k] = number_sqrt(V_y * V_y + V_z * V_z);
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
    for (int j = 0; j < Z; j++) {  // half 0 holds the pocket forces: their share of half 1 less that of half 0 instead
        const Pocket *pocket = &w->pocket[0][j];
        const number F_2 = pocket->F_x * pocket->F_x + pocket->F_t * pocket->F_t;
        const number share = number_value(F_2) > 0.0 ? pocket->F_x / number_sqrt(pocket->F_x * pocket->F_x + width * width * F_2) : 0.0;
        for (int i = 0; i < 3; i++) {
            global[i] += 0.5 * (1.0 + share) * pocket->F[i];
            global[3 + i] += 0.5 * (1.0 + share) * pocket->M[i];
        }
    }
    const number *axes[3] = {cage->a, cage->b_y, cage->b_z};
    for (int i = 0; i < 3; i++) {
        wrench[i] = dot3(axes[i], global);
        wrench[3 + i] = dot3(axes[i], global + 3);
    }
}

static void rigid_load(const Model *model, const Work *w, RivetLoad load[Z], number V[Z])
{
    const double R = 0.5 * model->p->bearing.d_m, friction = model->p->joint.mu * model->d->P;
    double c[Z], s[Z];
    number wrench[6], N[Z], V_y[Z], V_z[Z];
    rigid_wrench(model, w, wrench);
    for (int k = 0; k < Z; k++) {
        c[k] = model->d->rivet_y[k] / R;
        s[k] = model->d->rivet_z[k] / R;
    }
    load_path_rigid(2.0 * R, wrench, c, s, N, V_y, V_z);
    for (int k = 0; k < Z; k++) {
        V[k] = number_sqrt(V_y[k] * V_y[k] + V_z[k] * V_z[k]);
        const number shank = number_value(V[k]) > 2.0 * friction ? (V[k] - 2.0 * friction) / V[k] : 0.0;
        load[k] = (RivetLoad){
            .P = model->d->P, .N = N[k], .V_y = shank * V_y[k], .V_z = shank * V_z[k], .F_head = number_min(number_max(V[k] - friction, 0.0), friction)};
    }
}

// What the forces on the pockets of one half pry at the rivets.
static void pocket_path(const Pocket pocket[Z], int side, PathLoads *path)
{
    number F_x[Z], F_r[Z], F_t[Z];
    for (int j = 0; j < Z; j++) F_x[j] = pocket[j].F_x, F_r[j] = pocket[j].F_r, F_t[j] = pocket[j].F_t;
    load_path_flexible(rivet_table.load_path, side, F_x, F_r, F_t, path);
}

void rivets_load(const Model *model, const Work *w, RivetLoad load[Z], number V[Z])
{
    const bool rigid = model->p->scene.cage == CAGE_MODEL_RIGID;
    if (rigid)
        rigid_load(model, w, load, V);
    else
        two_half_load(model, w, load, V);

    PathLoads path = {0};
    for (int h = 0; h < (rigid ? 1 : 2); h++) pocket_path(w->pocket[h], h == 0 ? -1 : 1, &path);
    const double per_R = 2.0 / model->p->bearing.d_m;
    for (int k = 0; k < Z; k++) {
        const double c = model->d->rivet_y[k] * per_R, s = model->d->rivet_z[k] * per_R;
        load[k].N += path.N[k];
        if (model->d->hole_gap == 0.0) {
            load[k].V_y += path.V_r[k] * c - path.V_t[k] * s;
            load[k].V_z += path.V_r[k] * s + path.V_t[k] * c;
        }
        load[k].M_y += path.M_r[k] * c - path.M_t[k] * s;
        load[k].M_z += path.M_r[k] * s + path.M_t[k] * c;
        joint_prying(&rivet_table.joint, &load[k]);
    }
}
