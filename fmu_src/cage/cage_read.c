// Functions of cage.h that read the results of an evaluation: energy of the cage, slip of its joints,
// motion of the halves by their modes.
#include "cage/cage.h"
#include "cage/common/cage_joint.h"
#include "cage/common/pocket.h"
#include "cage/common/pocket_spheres.h"
#include "cage/elastic/cage_elastic.h"
#include "cage/elastic/elastic_half.h"
#include "physics/rotor.h"

// Kinetic energy of both halves.
static scalar halves_energy(const Model *model, const Work *w)
{
    const Derived *d = model->d;
    scalar E = 0.0;
    for (int h = 0; h < 2; h++) {
        const Rotor *half = &w->half[h];
        scalar v[3];
        cross3(half->Omega, half->c, v);
        for (int i = 0; i < 3; i++) v[i] += half->v[i];  // of the centre of mass
        E += 0.5 * (model->p->cage.m * dot3(v, v) + d->J_t * dot3(half->a_dot, half->a_dot) +
                    d->J_p * half->s * half->s);
    }
    return E;
}

// Elastic energy of all pockets.
static scalar pocket_energy(const Model *model, const Work *w)
{
    const Derived *d = model->d;
    const wide K = wide_set(d->pocket.K);
    ball_array stored;
    for (int j = 0; j < PACKETS * LANE_WIDTH; j += LANE_WIDTH) {
        wide E = wide_set(0.0);
        for (int h = 0; h < 2; h++) {
            const PocketGap gap = pocket_gap(d, w, &w->half[h], j);
            const wide delta = wide_load(&w->delta_c[h][j]);
            const PocketShare share = pocket_share(d, h, gap.n_x, delta);
            E += share.energy * hertz_energy(K, delta);
            if (model->modes) {  // in the wall, beside its modes
                const wide Q = share.load * hertz_load(K, delta);
                E += (0.5 * model->modes->compliance) * Q * Q;
            }
        }
        wide_store(&stored[j], E);
    }
    return ball_array_sum(stored);
}

// Elastic energy in the pockets of a ribbon cage.
static scalar spheres_energy(const Model *model, const Work *w)
{
    const Spheres *s = &model->d->spheres;
    ball_array stored;
    for (int j = 0; j < PACKETS * LANE_WIDTH; j += LANE_WIDTH) {
        wide V = wide_set(0.0);
        for (int h = 0; h < 2; h++) {
            if (model->modes) {
                V += wide_load(&w->cage.elastic.wall_energy[h][j]);
                continue;
            }
            const SphereGap gap = sphere_gap(model->d, w, h, j);
            V += sphere_contact(s, wide_load(&s->slack[j]), gap.x, gap.r, gap.t).V;
        }
        wide_store(&stored[j], V);
    }
    return ball_array_sum(stored);
}

// Elastic energy of the joints in the plane: friction states and holes.
static scalar joints_energy(const Model *model, const scalar *y, const JointStiffness *k_in,
                            const scalar *u_y, const scalar *u_z)
{
    scalar E = 0.0;
    for (int k = 0; k < Z; k++) {
        const scalar z_y = y[Y_JOINT_PLATE_Y + k], z_z = y[Y_JOINT_PLATE_Z + k];
        const scalar h_y = y[Y_JOINT_HEAD_Y + k], h_z = y[Y_JOINT_HEAD_Z + k];
        const scalar slip = scalar_sqrt(u_y[k] * u_y[k] + u_z[k] * u_z[k]);
        const scalar bearing = scalar_max(0.0, slip - model->d->hole_gap[k]);
        E += 0.5 * (k_in->stick * (z_y * z_y + z_z * z_z) + k_in->head * (h_y * h_y + h_z * h_z) +
                    k_in->hole[k] * bearing * bearing);
    }
    return E;
}

static scalar two_half_energy(const Model *model, const scalar *y, const Work *w)
{
    const Derived *d = model->d;
    scalar E = 0.0;
    for (int k = 0; k < Z; k++) {
        const scalar pull = w->cage.two_half.pull[k], push = w->cage.two_half.push[k];
        E += 0.5 * (pull * pull / d->k_rivet + push * push / d->k_plate);
    }
    const JointStiffness k_in = two_half_stiffness(d);
    return E + joints_energy(model, y, &k_in, w->u_y, w->u_z);
}

static scalar elastic_energy(const Model *model, const scalar *y, const Work *w)
{
    const ElasticJoints *joints = &w->cage.elastic.joints;
    const JointStiffness k_in = cage_elastic_stiffness(model);
    scalar V = 0.0;  // of the joints, and of the halves around them beside their modes
    for (int k = 0; k < Z; k++) {
        for (int a = 0; a < PAD_OUT; a++) V += 0.5 * joints->e[a][k] * joints->trial[a][k];
        V -= joints->U[k];
    }
    return w->cage.elastic.energy + 2.0 * V + joints_energy(model, y, &k_in, joints->u_y, joints->u_z);
}

void cage_slip(const Model *model, const Work *w, scalar slip[Z])
{
    const scalar *u_y = model->modes ? w->cage.elastic.joints.u_y : w->u_y;
    const scalar *u_z = model->modes ? w->cage.elastic.joints.u_z : w->u_z;
    for (int k = 0; k < Z; k++) slip[k] = scalar_sqrt(u_y[k] * u_y[k] + u_z[k] * u_z[k]);
}

scalar cage_energy(const Model *model, const scalar *y, const Work *w)
{
    const scalar joints = (model->modes ? elastic_energy : two_half_energy)(model, y, w);
    const scalar pockets = (model->d->spheres.on ? spheres_energy : pocket_energy)(model, w);
    return halves_energy(model, w) + pockets + joints;
}

void cage_flex(const Model *model, const Work *w, int h, scalar x[Z], scalar r[Z], scalar t[Z])
{
    for (int k = 0; k < Z; k++) x[k] = r[k] = t[k] = 0.0;
    if (!model->modes) return;

    // Half 0 is the mirror image of half 1.
    const ElasticHalf *half = model->modes;
    const double inv_root = sqrt(0.5), side = h == 1 ? inv_root : -inv_root;
    const scalar *q = w->cage.elastic.q[h];
    for (int i = 0; i < half->n; i++)
        for (int k = 0; k < Z; k++) {
            x[k] += side * elastic_half_pad(half, true, i, 0, k) * q[i];
            r[k] += inv_root * elastic_half_pad(half, false, i, 0, k) * q[i];
            t[k] += inv_root * elastic_half_pad(half, false, i, 1, k) * q[i];
        }
}
