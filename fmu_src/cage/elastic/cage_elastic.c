// Elastic cage halves.  Each half vibrates in the frame that moves with it as a rigid body, by its free modes
// i with the coordinates q_i and the modal mass m of the half:
//
//     m (q_i'' + 2 zeta omega_i q_i' + omega_i^2 q_i) = sum phi_i . F,       u = sum phi_i q_i
//
// F: forces of balls on the pockets' walls (pocket.c), loads of the joints on the pads, centrifugal load.
// Half 0 is the mirror image of half 1, so that with S = (q_1 + q_0)/sqrt 2 (mirrored) and D = (q_1 -
// q_0)/sqrt 2 (opposed) the pads of one joint move against each other by
//
//     x, phi_r, phi_t:  sqrt 2 sum phi_i S_i    out of the plane: N, M_r, M_t
//     r, t:             sqrt 2 sum phi_i D_i    in the plane: V_r, V_t
//
// Joint, out of the plane: e is half of the relative motion (rigid and elastic) of its pads, the faces of
// both halves in the split around the rivet.  K is the inverse of the residual between the pads of one joint, the static compliance
// that the modes do not contain,
//
//     L_K = K e,     (L, T, m_r, m_t) = law(L_K, P)
//
// with the rivet table's law over K: its pads move by delta, L = K (e - delta).  So each joint
// follows from its own pads; the motion of its pads by the loads of other joints beside the modes is left out: with
// 4.4 modes a pitch it is 7 % of the motion by the joint's own load.  In the plane, friction states and the hole's
// contact are those of cage_joint.c, in series with the residual.  Pads do not hold each other about x.
// The films of the lands bend the rims (land_bent.h) and load the rivets statically by other waves (elastic_lands.c).
//
// The centrifugal load widens a half, which takes spin from it: its moment of inertia is J_p + 2 sum c_i
// q_i.  Coriolis forces on the modes and their softening by spin are left out: 2 omega_c/omega_i and
// (omega_c/omega_i)^2.
#include "cage/elastic/cage_elastic.h"

#include "cage/common/cage_joint.h"
#include "cage/common/spin_preload.h"
#include "cage/elastic/elastic_half.h"
#include "cage/elastic/elastic_lands.h"
#include "physics/rotor.h"
#include "rivet/rivet_rom.h"

static const double ROOT = 1.4142135623730951;  // of 2

// Motions of the pads against each other by modal coordinates: motions of the first pads, in rows of a number
// of octets.  The mirror image turns the sign of odd motions by a and of the others by b.
INLINE void pads_follow(const ElasticHalf *half, const scalar *q, int motions, int octets, const double *rows,
                        const int *pads, ball_array *to)
{
    scalar row[2][8 * OUT_OCTETS];
    for (int kind = 0; kind < 2; kind++) {
        const int first = kind * half->count[0];
        octet sum[OUT_OCTETS] = {{{0.0}}}, odd[OUT_OCTETS] = {{{0.0}}};
        octets_add_rows(half->count[kind], q + first, octets, rows + first * 8 * octets, sum, odd);
        octets_store_sum(octets, sum, odd, row[kind]);
    }
    for (int c = 0; c < motions; c++)
        for (int k = 0; k < FIRST; k++) {
            const scalar by_a = row[0][c * FIRST + k], by_b = row[1][c * FIRST + k];
            to[c][Z - 1 - k] = PAD_ODD[pads[c]] ? by_b - by_a : by_a - by_b;
            to[c][k] = by_a + by_b;
        }
}

void cage_elastic_out(const ElasticHalf *half, const scalar *S, ball_array to[PAD_OUT])
{
    pads_follow(half, S, PAD_OUT, OUT_OCTETS, half->out[0], OUT_PADS, to);
}

void cage_elastic_in(const ElasticHalf *half, const scalar *D, ball_array to[PAD_IN])
{
    pads_follow(half, D, PAD_IN, IN_OCTETS, half->in[0], IN_PADS, to);
}

void cage_elastic_kinematics(const Model *model, const scalar *y, Work *w)
{
    const ElasticHalf *half = model->modes;
    ElasticWork *e = &w->cage.elastic;
    const double inv_root = 1.0 / ROOT;
    const scalar *S = &y[Y_MODE_S], *D = &y[Y_MODE_D], *S_dot = &y[Y_MODE_S_DOT], *D_dot = &y[Y_MODE_D_DOT];
    for (int i = 0; i < MODES; i++) {
        e->q[0][i] = inv_root * (S[i] - D[i]), e->q[1][i] = inv_root * (S[i] + D[i]);
        e->q_dot[0][i] = inv_root * (S_dot[i] - D_dot[i]), e->q_dot[1][i] = inv_root * (S_dot[i] + D_dot[i]);
        e->wall_force[0][i] = e->wall_force[1][i] = 0.0;
    }
    cage_elastic_out(half, S, e->pad_out);
    cage_elastic_in(half, D, e->pad_in);
    cage_elastic_in(half, D_dot, e->pad_in_dot);
    for (int h = 0; h < 2; h++) {
        const scalar *q = e->q[h], *q_b = &q[half->count[0]];
        mode_array moved;
        for (int i = 0; i < MODES; i++) moved[i] = fabs(scalar_value(q[i]));
        for (int m = 0; m < half->pairs; m++) {
            const double a = scalar_value(q[m]), b = scalar_value(q_b[m]);
            moved[m] = sqrt(a * a + b * b);
        }
        e->reach_others[h] = elastic_dot(half->widest_others, moved);
        e->reach[h] = e->reach_others[h] + elastic_dot(half->widest, moved);
        e->more_J[h] = 2.0 * elastic_dot(half->centrifugal, q);
        e->more_J_dot[h] = 2.0 * elastic_dot(half->centrifugal, e->q_dot[h]);
        elastic_rims(half, q, e->q_dot[h], w->rim[h], w->rim_v[h]);
    }
}

// Sum of vectors (y, z) and the motions (r, t) of a packet of pads, in the frame of half 0.
INLINE void add_turned(const Model *model, int k, const scalar *from_y, const scalar *from_z,
                       ball_array motion[PAD_IN], scalar *y, scalar *z)
{
    const double inv_R = model->d->inv_R;
    const wide c = wide_load(&model->d->rivet_y[k]) * inv_R, s = wide_load(&model->d->rivet_z[k]) * inv_R;
    const wide r = wide_load(&motion[0][k]), t = wide_load(&motion[1][k]);
    wide_store(&y[k], wide_load(&from_y[k]) + (c * r - s * t));
    wide_store(&z[k], wide_load(&from_z[k]) + (s * r + c * t));
}

// Motions of the pads against each other: those of the halves as rigid bodies and of their modes.
static void move_pads(const Model *model, Work *w)
{
    const Rotor *h0 = &w->half[0], *h1 = &w->half[1];
    const double inv_R = model->d->inv_R;
    ElasticWork *elastic = &w->cage.elastic;
    ElasticJoints *joints = &elastic->joints;
    const scalar turn_y = -dot3(h0->b_z, h1->a),
                 turn_z = dot3(h0->b_y, h1->a);  // small rotation of half 1 against half 0
    for (int k = 0; k < PACKETS * LANE_WIDTH; k += LANE_WIDTH) {
        const wide c = wide_load(&model->d->rivet_y[k]) * inv_R, s = wide_load(&model->d->rivet_z[k]) * inv_R;
        const wide rigid[PAD_OUT] = {wide_load(&w->u_x[k]), turn_y * c + turn_z * s, turn_z * c - turn_y * s};
        for (int i = 0; i < PAD_OUT; i++)
            wide_store(&joints->e[i][k], 0.5 * (rigid[i] + wide_load(&elastic->pad_out[i][k])));
        add_turned(model, k, w->u_y, w->u_z, elastic->pad_in, joints->u_y, joints->u_z);
        add_turned(model, k, w->v_jy, w->v_jz, elastic->pad_in_dot, joints->v_y, joints->v_z);
    }
}

// Joint k without its rivet: the pads press on each other in their middles or carry nothing.
static void broken_answers(const ElasticHalf *half, ElasticJoints *j, int k)
{
    const double (*K)[PAD_OUT] = half->K, det = K[1][1] * K[2][2] - K[1][2] * K[2][1];
    const double r = (K[0][1] * K[2][2] - K[0][2] * K[2][1]) / det,
                 t = (K[0][2] * K[1][1] - K[0][1] * K[1][2]) / det;
    const scalar N = scalar_min(j->trial[0][k] - r * j->trial[1][k] - t * j->trial[2][k], 0.0);
    j->load[0][k] = N;
    j->load[1][k] = j->load[2][k] = 0.0;
    j->U[k] = -0.5 * half->R[0][0] * N * N;
    for (int a = 0; a < PAD_OUT; a++) {
        j->rivet[a][k] = 0.0;
        j->U[k] += 0.5 * j->e[a][k] * j->trial[a][k];
    }
}

void cage_elastic_loads(const Model *model, const ball_array P, ElasticJoints *joints)
{
    const ElasticHalf *half = model->modes;
    LawPlaces at;
    for (int k = 0; k < PACKETS * LANE_WIDTH; k += LANE_WIDTH) {
        wide L[PAD_OUT];
        for (int a = 0; a < PAD_OUT; a++) {
            const double *K = half->K[a];
            L[a] = K[0] * wide_load(&joints->e[0][k]) + K[1] * wide_load(&joints->e[1][k]) +
                   K[2] * wide_load(&joints->e[2][k]);
            wide_store(&joints->trial[a][k], L[a]);
        }
        law_places(half->law, L, wide_load(&P[k]), k, &at);
    }
    for (int k = 0; k < Z; k++) {
        scalar load[PAD_OUT], rivet[PAD_OUT];
        law_answer(half->law, &at, k, joints->trial[1][k], load, rivet, &joints->U[k]);
        for (int a = 0; a < PAD_OUT; a++) joints->load[a][k] = load[a], joints->rivet[a][k] = rivet[a];
        if (model->d->intact[k] == 0.0) broken_answers(half, joints, k);
    }
    for (int k = Z; k < LANES; k++)
        for (int a = 0; a < PAD_OUT; a++) joints->load[a][k] = joints->rivet[a][k] = 0.0;
    for (int k = 0; k < PACKETS * LANE_WIDTH; k += LANE_WIDTH) {
        const wide zero = wide_set(0.0), T = wide_max(wide_load(&joints->rivet[0][k]), zero);
        wide_store(&joints->rivet[0][k], T);
        wide_store(&joints->N_plate[k], wide_max(T - wide_load(&joints->load[0][k]), zero));
    }
}

scalar cage_elastic_speed_2(const Work *w)
{
    const scalar s_0 = w->half[0].s + w->frame_omega, s_1 = w->half[1].s + w->frame_omega;
    return 0.5 * (s_0 * s_0 + s_1 * s_1);
}

void cage_elastic_preload(const Model *model, scalar omega_2, ball_array P)
{
    const Derived *d = model->d;
    const scalar more_P = d->centrifugal[ROW_DP] * omega_2;
    for (int k = 0; k < LANES; k++) P[k] = scalar_max(d->P[k] + more_P, 0.0);
    if (rivet_table.half.spin_steps > 0)
        for (int k = 0; k < Z; k++)
            P[k] = scalar_max(P[k] + spin_bending(&rivet_table.half, d->P[k], more_P), 0.0);
}

// Adds the moments of the joints to both halves.
static void add_moments(const Model *model, Work *w)
{
    const Derived *d = model->d;
    const ElasticJoints *joints = &w->cage.elastic.joints;
    ball_array M_y, M_z;
    for (int k = 0; k < Z; k++) {
        const double c = d->rivet_y[k] * d->inv_R, s = d->rivet_z[k] * d->inv_R;
        M_y[k] = joints->load[1][k] * c - joints->load[2][k] * s;
        M_z[k] = joints->load[1][k] * s + joints->load[2][k] * c;
    }

    // moments on half 1, whose power is that of the rates of turn_y and turn_z
    Rotor *h0 = &w->half[0], *h1 = &w->half[1];
    const scalar sum_y = ball_array_sum(M_y), sum_z = ball_array_sum(M_z);
    scalar about_y[3], about_z[3];
    cross3(h1->a, h0->b_z, about_y);
    cross3(h1->a, h0->b_y, about_z);
    for (int i = 0; i < 3; i++) {
        const scalar moment = sum_y * about_y[i] - sum_z * about_z[i];
        h0->M[i] -= moment;
        h1->M[i] += moment;
    }
}

void cage_elastic_joints(const Model *model, const scalar *y, Work *w)
{
    ElasticJoints *joints = &w->cage.elastic.joints;
    ball_array P, F_x;
    move_pads(model, w);
    cage_elastic_preload(model, cage_elastic_speed_2(w), P);
    cage_elastic_loads(model, P, joints);
    add_moments(model, w);
    for (int k = 0; k < PACKETS * LANE_WIDTH; k += LANE_WIDTH)
        wide_store(&F_x[k], -wide_load(&joints->load[0][k]));
    const JointStiffness k_in = cage_elastic_stiffness(model);
    const JointMotion at = {joints->u_y,      joints->u_z,     joints->v_y, joints->v_z,
                            joints->rivet[0], joints->N_plate, F_x};
    cage_joint_force(model, y, &k_in, &at, w);
    memcpy(joints->F_y, w->joint_F_y, sizeof joints->F_y);
    memcpy(joints->F_z, w->joint_F_z, sizeof joints->F_z);
}

// Forces of the joints' loads on the modes: of the first joints, each with its mirror image.
INLINE void pads_pull(const ElasticHalf *half, int motions, ball_array *load, const double *modes,
                      const int *pads, mode_array to)
{
    scalar weight[2][FIRST];
    octet sum[2][ENTRY_OCTETS] = {{{{0.0}}}}, odd[2][ENTRY_OCTETS] = {{{{0.0}}}};
    for (int c = 0; c < motions; c++) {
        const bool turned = PAD_ODD[pads[c]];
        for (int k = 0; k < FIRST; k++) {
            const scalar here = load[c][k], there = load[c][Z - 1 - k];
            weight[turned][k] = here + there;
            weight[!turned][k] = here - there;
        }
        for (int kind = 0; kind < 2; kind++)
            octets_add_rows(FIRST, weight[kind], ENTRY_OCTETS, modes + (kind * motions + c) * FIRST * ENTRIES,
                            sum[kind], odd[kind]);
    }
    octets_store_sum(ENTRY_OCTETS, sum[0], odd[0], to);
    octets_store_sum(ENTRY_OCTETS, sum[1], odd[1], to + half->count[0]);
}

void cage_elastic_pull(const Model *model, ElasticJoints *joints)
{
    const ElasticHalf *half = model->modes;
    const double inv_R = model->d->inv_R;
    ball_array across[PAD_IN];
    for (int k = 0; k < Z; k++) {
        const double c = model->d->rivet_y[k] * inv_R, s = model->d->rivet_z[k] * inv_R;
        across[0][k] = c * joints->F_y[k] + s * joints->F_z[k];
        across[1][k] = c * joints->F_z[k] - s * joints->F_y[k];
    }
    pads_pull(half, PAD_OUT, joints->load, half->out_modes[0][0], OUT_PADS, joints->pull_S);
    pads_pull(half, PAD_IN, across, half->in_modes[0][0], IN_PADS, joints->pull_D);
}

void cage_elastic_acceleration(const Model *model, const scalar *y, Work *w, scalar *y_dot)
{
    const ElasticHalf *half = model->modes;
    ElasticWork *e = &w->cage.elastic;
    const double inv_root = 1.0 / ROOT, m = model->p->cage.m, inv_m = 1.0 / m;
    mode_array mirrored, opposed, rates, lost, one;
    scalar spin[2];
    for (int h = 0; h < 2; h++) {
        const scalar s = w->half[h].s + w->frame_omega, *force = w->pressure[h].rim_force;
        spin[h] = s * s;
        for (int c = 0; model->d->guided && c < RIM; c++)
            for (int i = 0; i < MODES; i++) e->wall_force[h][i] += half->rim[c][i] * force[c];
    }
    for (int i = 0; i < MODES; i++) {
        const scalar f_0 = e->wall_force[0][i] + spin[0] * half->centrifugal[i];
        const scalar f_1 = e->wall_force[1][i] + spin[1] * half->centrifugal[i];
        mirrored[i] = inv_root * (f_1 + f_0), opposed[i] = inv_root * (f_1 - f_0);
    }

    ElasticJoints *joints = &e->joints;
    cage_elastic_pull(model, joints);

    // rates, energy and dissipation
    for (int i = 0; i < MODES; i++) {
        const scalar S = y[Y_MODE_S + i], D = y[Y_MODE_D + i], S_dot = y[Y_MODE_S_DOT + i],
                     D_dot = y[Y_MODE_D_DOT + i];
        y_dot[Y_MODE_S + i] = S_dot;
        y_dot[Y_MODE_D + i] = D_dot;
        y_dot[Y_MODE_S_DOT + i] =
            inv_m * (mirrored[i] - joints->pull_S[i]) - half->damping[i] * S_dot - half->omega_2[i] * S;
        y_dot[Y_MODE_D_DOT + i] =
            inv_m * (opposed[i] + joints->pull_D[i]) - half->damping[i] * D_dot - half->omega_2[i] * D;
        const scalar v_2 = S_dot * S_dot + D_dot * D_dot;
        rates[i] = v_2 + half->omega_2[i] * (S * S + D * D);
        lost[i] = half->damping[i] * v_2;
        one[i] = 1.0;
    }
    for (int i = half->n; i < MODES; i++)
        y_dot[Y_MODE_S + i] = y_dot[Y_MODE_D + i] = y_dot[Y_MODE_S_DOT + i] = y_dot[Y_MODE_D_DOT + i] = 0.0;
    e->energy = 0.5 * m * elastic_sum(rates, one);
    e->dissipated = m * elastic_sum(lost, one);
    for (int h = 0; h < 2; h++)
        e->energy += 0.5 * e->more_J[h] * (w->half[h].s * w->half[h].s - w->frame_omega * w->frame_omega);
}

void cage_elastic_rivets(const Model *model, const Work *w, JointLoads *load)
{
    const ElasticJoints *joints = &w->cage.elastic.joints;
    JointShear shear;
    ball_array P;
    LandedJoints landed;
    const LandedJoints *found = &landed;
    cage_joint_carried(model, w, &shear);
    cage_elastic_preload(model, cage_elastic_speed_2(w), P);
    if (model->d->guided && elastic_lands(model, w, P, &landed, &shear))
        cage_joint_loads(model, found->load, found->rivet, &shear, load);
    else
        cage_joint_loads(model, joints->load, joints->rivet, &shear, load);
}
