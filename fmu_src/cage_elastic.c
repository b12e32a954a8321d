// Elastic cage halves.  Each half vibrates in the frame that moves with it as a rigid body, by its free modes i with the
// coordinates q_i and the modal mass m of the half:
//
//     m (q_i'' + 2 zeta omega_i q_i' + omega_i^2 q_i) = sum phi_i . F,       u = sum phi_i q_i
//
// F: forces of balls on the pockets' walls (pocket.c), loads of the joints on the pads, centrifugal load.  Half 0 is the
// mirror image of half 1, so that with S = (q_1 + q_0)/sqrt 2 (mirrored) and D = (q_1 - q_0)/sqrt 2 (opposed) the pads of
// one joint move against each other by
//
//     x, phi_r, phi_t:  sqrt 2 sum phi_i S_i    out of the plane: N, M_r, M_t
//     r, t:             sqrt 2 sum phi_i D_i    in the plane: V_r, V_t
//
// Joint, out of the plane: with e half of the relative motion of its pads (rigid and elastic), the static compliance that
// the modes leave between pads and its inverse K, circulant,
//
//     L_k = sum_j K_(k-j) (e_j - delta_j),     (delta, T, m_r, m_t)_k = law(L^_k, P),     L^_k = L_k + K_0 delta_k
//
// with the joint's law (joint_law.h), in which the stiffness of the whole half around a joint is replaced by that which the
// modes leave (elastic_half.c).  The moves of the neighbours in L^ are found by sweeps that begin with those at rest under the
// centrifugal load.  In the plane, friction states and the hole's contact are those of cage_joint.c, in series
// with what the modes leave.  Pads do not hold each other about x.
//
// The centrifugal load widens a half, which takes spin from it: its moment of inertia is J_p + 2 sum spin_i q_i.  Coriolis
// forces on the modes and their softening by spin are left out: 2 omega_c/omega_i and (omega_c/omega_i)^2.
#include "cage_elastic.h"

#include "elastic_half.h"
#include "rivet_rom.h"
#include "rotor.h"

enum { JOINT_SWEEPS = 1 };  // beside the first answer

static const double ROOT = 1.4142135623730951;  // of 2

// The pads' motions against each other in the plane, and their rates, from D and its rates.
static void motion_in_plane(const ElasticHalf *half, const scalar *D, const scalar *D_dot, Work *w)
{
    for (int k = 0; k < PACKETS * LANE_WIDTH; k += LANE_WIDTH) {
        wide sum[PAD_IN], rate[PAD_IN];
        for (int c = 0; c < PAD_IN; c++) sum[c] = rate[c] = wide_set(0.0);
        for (int i = 0; i < half->n; i++) {
            const wide d = wide_set(D[i]), d_dot = wide_set(D_dot[i]);
            for (int c = 0; c < PAD_IN; c++) {
                const wide shape = wide_load(&half->in[i][c][k]);
                sum[c] = wide_fma(shape, d, sum[c]);
                rate[c] = wide_fma(shape, d_dot, rate[c]);
            }
        }
        for (int c = 0; c < PAD_IN; c++) {
            wide_store(&w->pad_in[c][k], ROOT * sum[c]);
            wide_store(&w->pad_in_dot[c][k], ROOT * rate[c]);
        }
    }
}

// Out of the plane, from S.
static void motion_out_of_plane(const ElasticHalf *half, const scalar *S, Work *w)
{
    for (int k = 0; k < PACKETS * LANE_WIDTH; k += LANE_WIDTH) {
        wide sum[PAD_OUT];
        for (int c = 0; c < PAD_OUT; c++) sum[c] = wide_set(0.0);
        for (int i = 0; i < half->n; i++) {
            const wide s = wide_set(S[i]);
            for (int c = 0; c < PAD_OUT; c++) sum[c] = wide_fma(wide_load(&half->out[i][c][k]), s, sum[c]);
        }
        for (int c = 0; c < PAD_OUT; c++) wide_store(&w->pad_out[c][k], ROOT * sum[c]);
    }
}

// Sum over the modes in one order for every lane width.
static scalar elastic_dot(const ElasticHalf *half, const double *x, const scalar *y)
{
    scalar part[8] = {0};
    for (int i = 0; i < 8 * half->blocks; i += 8)
        for (int k = 0; k < 8; k++) part[k] += x[i + k] * y[i + k];
    return ((part[0] + part[1]) + (part[2] + part[3])) + ((part[4] + part[5]) + (part[6] + part[7]));
}

void cage_elastic_kinematics(const Model *model, const scalar *y, Work *w)
{
    const ElasticHalf *half = model->elastic;
    const double inv_root = 1.0 / ROOT;
    const scalar *S = &y[Y_MODE_S], *D = &y[Y_MODE_D], *S_dot = &y[Y_MODE_S_DOT], *D_dot = &y[Y_MODE_D_DOT];
    for (int i = 0; i < 8 * half->blocks; i++) {
        w->q[0][i] = inv_root * (S[i] - D[i]), w->q[1][i] = inv_root * (S[i] + D[i]);
        w->q_dot[0][i] = inv_root * (S_dot[i] - D_dot[i]), w->q_dot[1][i] = inv_root * (S_dot[i] + D_dot[i]);
        w->wall_force[0][i] = w->wall_force[1][i] = 0.0;
    }
    motion_out_of_plane(half, S, w);
    motion_in_plane(half, D, D_dot, w);
    for (int h = 0; h < 2; h++) {
        scalar stored[MODES] = {0.0}, moved[MODES] = {0.0};
        for (int i = 0; i < 8 * half->blocks; i++) {
            stored[i] = half->weight[i] * w->q[h][i];
            moved[i] = fabs(scalar_value(w->q[h][i]));
        }
        w->reach[h] = sqrt(half->reach_2 * scalar_value(elastic_sum(half, stored, w->q[h]))) +
                      elastic_dot(half, half->widest, moved);
        w->more_J[h] = 2.0 * elastic_dot(half, half->spin, w->q[h]);
        w->more_J_dot[h] = 2.0 * elastic_dot(half, half->spin, w->q_dot[h]);
    }
}

void cage_elastic_slip(const Model *model, const scalar *y, Work *w)
{
    motion_in_plane(model->elastic, &y[Y_MODE_D], &y[Y_MODE_D_DOT], w);
    for (int c = 0; c < PAD_OUT; c++) memset(w->pad_out[c], 0, sizeof w->pad_out[c]);
    cage_elastic_pads(model, w);
}

void cage_elastic_pads(const Model *model, Work *w)
{
    const Rotor *h0 = &w->half[0], *h1 = &w->half[1];
    const double inv_R = 2.0 / rivet_table.joint.d_m;
    const scalar turn_y = -dot3(h0->b_z, h1->a),
                 turn_z = dot3(h0->b_y, h1->a);  // small rotation of half 1 against half 0
    for (int k = 0; k < PACKETS * LANE_WIDTH; k += LANE_WIDTH) {
        const wide c = wide_load(&model->d->rivet_y[k]) * inv_R, s = wide_load(&model->d->rivet_z[k]) * inv_R;
        const wide rigid[PAD_OUT] = {wide_load(&w->u_x[k]), turn_y * c + turn_z * s, turn_z * c - turn_y * s};
        for (int i = 0; i < PAD_OUT; i++)
            wide_store(&w->e[i][k], 0.5 * (rigid[i] + wide_load(&w->pad_out[i][k])));
        const wide r = wide_load(&w->pad_in[0][k]), t = wide_load(&w->pad_in[1][k]);
        const wide r_dot = wide_load(&w->pad_in_dot[0][k]), t_dot = wide_load(&w->pad_in_dot[1][k]);
        wide_store(&w->rigid_u_y[k], wide_load(&w->u_y[k]));
        wide_store(&w->rigid_u_z[k], wide_load(&w->u_z[k]));
        wide_store(&w->u_y[k], wide_load(&w->u_y[k]) + (c * r - s * t));
        wide_store(&w->u_z[k], wide_load(&w->u_z[k]) + (s * r + c * t));
        wide_store(&w->v_jy[k], wide_load(&w->v_jy[k]) + (c * r_dot - s * t_dot));
        wide_store(&w->v_jz[k], wide_load(&w->v_jz[k]) + (s * r_dot + c * t_dot));
    }
}

// Sum over the joints j of K_(k-j) x_j for all joints k.
static void stiffness_times(const ElasticHalf *half, ball_array x[PAD_OUT], ball_array out[PAD_OUT])
{
    scalar twice[PAD_OUT]
                [2 * Z + LANES];  // once more behind the last one, so that neighbours lie side by side
    for (int b = 0; b < PAD_OUT; b++)
        for (int k = 0; k < 2 * Z + LANES; k++) twice[b][k] = x[b][k % Z];
    for (int k = 0; k < PACKETS * LANE_WIDTH; k += LANE_WIDTH)
        for (int a = 0; a < PAD_OUT; a++) {
            wide sum = wide_set(0.0);
            for (int d = 0; d < Z; d++)
                for (int b = 0; b < PAD_OUT; b++)
                    sum = wide_fma(wide_set(half->K[d][a][b]), wide_load(&twice[b][(Z - d) % Z + k]), sum);
            wide_store(&out[a][k], sum);
        }
}

// All joints answer to L^; behind: L^ without what a joint's own move relieves.
static void joints_answer(const ElasticHalf *half, scalar P, Work *w)
{
    for (int k = 0; k < Z; k++) {
        const scalar behind[3] = {w->joint_behind[0][k], w->joint_behind[1][k], w->joint_behind[2][k]};
        scalar move[3], rivet[3];
        joint_law(&half->law, behind, P, move, rivet, &w->joint_U[k]);
        for (int a = 0; a < 3; a++) w->joint_move[a][k] = move[a], w->joint_rivet[a][k] = rivet[a];
    }
}

// K_0 times the move of joint k.
INLINE scalar own_relief(const ElasticHalf *half, const Work *w, int a, int k)
{
    const double *K = half->K[0][a];
    return K[0] * w->joint_move[0][k] + K[1] * w->joint_move[1][k] + K[2] * w->joint_move[2][k];
}

void cage_elastic_joints(const Model *model, Work *w)
{
    const ElasticHalf *half = model->elastic;
    const Derived *d = model->d;
    const scalar s_0 = w->half[0].s + w->frame_omega, s_1 = w->half[1].s + w->frame_omega;
    const scalar omega_2 = 0.5 * (s_0 * s_0 + s_1 * s_1),
                 P = scalar_max(d->P_mean + d->spin[ROW_DP] * omega_2, 0.0);
    ball_array bonded[PAD_OUT], relief[PAD_OUT];
    scalar rest[PAD_OUT];
    stiffness_times(half, w->e, bonded);
    elastic_relief(half, P, omega_2, rest);
    for (int a = 0; a < 3; a++)
        for (int k = 0; k < Z; k++) w->joint_behind[a][k] = bonded[a][k] - rest[a];
    joints_answer(half, P, w);
    for (int sweep = 0; sweep < JOINT_SWEEPS; sweep++) {
        stiffness_times(half, w->joint_move, relief);
        for (int a = 0; a < 3; a++)
            for (int k = 0; k < Z; k++)
                w->joint_behind[a][k] = bonded[a][k] - relief[a][k] + own_relief(half, w, a, k);
        joints_answer(half, P, w);
    }

    // loads; what rivets and plates carry
    ball_array M_y, M_z;
    const double inv_R = 2.0 / rivet_table.joint.d_m;
    for (int k = 0; k < Z; k++) {
        for (int a = 0; a < 3; a++) w->joint_load[a][k] = w->joint_behind[a][k] - own_relief(half, w, a, k);
        w->T[k] = scalar_max(w->joint_rivet[0][k], 0.0);
        w->N_plate[k] = scalar_max(w->T[k] - w->joint_load[0][k], 0.0);
        const double c = d->rivet_y[k] * inv_R, s = d->rivet_z[k] * inv_R;
        M_y[k] = w->joint_load[1][k] * c - w->joint_load[2][k] * s;
        M_z[k] = w->joint_load[1][k] * s + w->joint_load[2][k] * c;
    }
    for (int k = Z; k < LANES; k++) {
        w->T[k] = w->N_plate[k] = 0.0;
        for (int a = 0; a < 3; a++) w->joint_load[a][k] = 0.0;
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

scalar cage_elastic_coriolis(const Model *model, const Work *w, int h)
{
    (void)model;
    return w->more_J_dot[h] * (w->half[h].s + w->frame_omega);
}

void cage_elastic_acceleration(const Model *model, const scalar *y, Work *w, scalar *y_dot)
{
    const ElasticHalf *half = model->elastic;
    const double inv_root = 1.0 / ROOT, m = model->p->cage.m, inv_m = 1.0 / m,
                 inv_R = 2.0 / rivet_table.joint.d_m;
    scalar mirrored[MODES] = {0.0}, opposed[MODES] = {0.0}, spin[2];
    for (int h = 0; h < 2; h++) {
        const scalar s = w->half[h].s + w->frame_omega;
        spin[h] = s * s;
    }
    for (int i = 0; i < 8 * half->blocks; i++) {
        const scalar f_0 = w->wall_force[0][i] + spin[0] * half->spin[i];
        const scalar f_1 = w->wall_force[1][i] + spin[1] * half->spin[i];
        mirrored[i] = inv_root * (f_1 + f_0), opposed[i] = inv_root * (f_1 - f_0);
    }

    // loads of the joints, modes side by side
    for (int k = 0; k < Z; k++) {
        const double c = model->d->rivet_y[k] * inv_R, s = model->d->rivet_z[k] * inv_R;
        const scalar F_y = w->joint_F_y[k], F_z = w->joint_F_z[k];
        const scalar out[PAD_OUT] = {-ROOT * w->joint_load[0][k], -ROOT * w->joint_load[1][k],
                                     -ROOT * w->joint_load[2][k]};
        const scalar in[PAD_IN] = {ROOT * (c * F_y + s * F_z), ROOT * (c * F_z - s * F_y)};
        for (int i = 0; i < 8 * half->blocks; i++) {
            mirrored[i] += out[0] * half->out_modes[0][k][i] + out[1] * half->out_modes[1][k][i] +
                           out[2] * half->out_modes[2][k][i];
            opposed[i] += in[0] * half->in_modes[0][k][i] + in[1] * half->in_modes[1][k][i];
        }
    }

    // rates, energy and dissipation
    scalar rates[MODES] = {0.0}, lost[MODES] = {0.0}, one[MODES] = {0.0};
    for (int i = 0; i < 8 * half->blocks; i++) {
        const scalar S = y[Y_MODE_S + i], D = y[Y_MODE_D + i], S_dot = y[Y_MODE_S_DOT + i],
                     D_dot = y[Y_MODE_D_DOT + i];
        y_dot[Y_MODE_S + i] = S_dot;
        y_dot[Y_MODE_D + i] = D_dot;
        y_dot[Y_MODE_S_DOT + i] = inv_m * mirrored[i] - half->damping[i] * S_dot - half->omega_2[i] * S;
        y_dot[Y_MODE_D_DOT + i] = inv_m * opposed[i] - half->damping[i] * D_dot - half->omega_2[i] * D;
        const scalar v_2 = S_dot * S_dot + D_dot * D_dot;
        rates[i] = v_2 + half->omega_2[i] * (S * S + D * D);
        lost[i] = half->damping[i] * v_2;
        one[i] = 1.0;
    }
    for (int i = half->n; i < MODES; i++)
        y_dot[Y_MODE_S + i] = y_dot[Y_MODE_D + i] = y_dot[Y_MODE_S_DOT + i] = y_dot[Y_MODE_D_DOT + i] = 0.0;
    w->modes_energy = 0.5 * m * elastic_sum(half, rates, one);
    w->modes_dissipated = m * elastic_sum(half, lost, one);
    for (int h = 0; h < 2; h++)
        w->modes_energy +=
            0.5 * w->more_J[h] * (w->half[h].s * w->half[h].s - w->frame_omega * w->frame_omega);
}
