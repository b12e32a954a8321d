// Riveted joint k: plates pressed together by the rivet, friction of plates and heads, the rivet's shank in
// its holes.
//
//      |  T  |          u    hole of half 1 - hole of half 0 at rivet k, in the body frame of half 0, v its rate
//   ---+-   -+---       T    tension of the rivet, N_plate force between the plates: two_half.c, cage_elastic.c
//   half 1     | u_x    plate friction  S, |S| <= C_p = mu N_plate + F_floor
//   ===+=====+===       head friction   H = -k_h z_h, |H| <= C_h = mu T + F_floor
//   half 0     |        hole contact    B = -k_hole max(0, |u| - gap) u/|u|,  gap = max(0, -fit_a): the diametral play
//   ---+-   -+---
//      |     |
//
//   u --[ k_t, z_p ]--+--[ plates: C_p ]--------------+--      S + H = -k_t z_p: the sticking joint's own deflection
//                     +--[ k_h, z_h ]--[ heads: C_h ]-+        z_h: deflection of the heads, which the plates' slip drags
//
// Under a growing transverse load the plates slip first (at C_p), then the heads slip on the rivet (at C_h more), then the
// halves move freely across the gap, and at last the shank bears against its holes.  Finite elements of the joint with
// Coulomb's friction show the same (tests/test_joint_backbone.py): plates that stick leave the heads alone, and the
// heads are one spring with one slider.
//
// Both frictions are elastic and perfectly plastic: a deflection follows the motion as long as Coulomb's law allows its
// force, and slips where it does not (Moreau 1977: the slip is normal to the disc |S| <= C_p).  Below the slip
// load nothing slips, so that a joint that carries a constant load under vibration shakes down (Melan's theorem)
// instead of creeping.  Between two moments the law is integrated by return mapping (Simo and Hughes 1998, chapter 2): z_p
// first follows the whole motion, trial deflections,
//
//     X = k_t z_p - k_h z_h                               trial force of the plates
//     z_h += max(|X| - C_p, 0)/(k_t + k_h) X/|X|          their slip drags the heads (linear kinematic hardening)
//     z_h *= min(1, C_h/(k_h |z_h|))                      which slip on the rivet
//     k_t z_p = k_h z_h + min(1, C_p/|X'|) X'             X' = k_t z_p - k_h z_h
//
// for any motion and for capacities that change.  An evaluation has the trial deflections among its states and the forces of
// the mapped ones; the end of a step or substep maps the states (cage_joint_slide).  The dissipation is the work of the
// mean force over the motion less the change of (k_t z_p^2 + k_h z_h^2)/2: the balance of energy is closed in every step.
//
// Force and reaction act at the same point, so momentum and energy are exact.
// Smoothness: C0 at bearing (a spring of finite stiffness begins) and where slip begins.
#include "cage/common/cage_joint.h"

#include "physics/rotor.h"

void cage_joint_kinematics(const Model *model, Work *w)
{
    const Rotor *h0 = &w->half[0], *h1 = &w->half[1];
    const scalar *axes_0[3] = {h0->a, h0->b_y, h0->b_z}, *axes_1[2] = {h1->b_y, h1->b_z};

    // offset and velocity of the centre of half 1 in the turning frame of half 0
    scalar g[3], v[3], omega[3], drift[3];
    for (int i = 0; i < 3; i++) {
        g[i] = h1->x[i] - h0->x[i];
        v[i] = h1->v[i] - h0->v[i];
        omega[i] = h1->Omega[i] - h0->Omega[i];
    }
    cross3(h0->Omega, g, drift);
    for (int i = 0; i < 3; i++) v[i] -= drift[i];
    scalar spin[2][3];
    for (int c = 0; c < 2; c++) cross3(omega, axes_1[c], spin[c]);

    // u = offset + (A - 1) s, with A the axes of half 1 in half 0 and s = (0, rivet_y, rivet_z); v likewise
    // with the rates of these axes
    scalar *u_out[3] = {w->u_x, w->u_y, w->u_z}, *v_out[3] = {w->v_jx, w->v_jy, w->v_jz};
    for (int i = 0; i < 3; i++) {
        const scalar u_0 = dot3(axes_0[i], g), v_0 = dot3(axes_0[i], v);
        const scalar A_y = dot3(axes_0[i], axes_1[0]) - (i == 1), A_z = dot3(axes_0[i], axes_1[1]) - (i == 2);
        const scalar B_y = dot3(axes_0[i], spin[0]), B_z = dot3(axes_0[i], spin[1]);
        for (int b = 0; b < PACKETS; b++) {
            const int k = b * LANE_WIDTH;
            const wide s_y = wide_load(&model->d->rivet_y[k]), s_z = wide_load(&model->d->rivet_z[k]);
            wide_store(&u_out[i][k], u_0 + A_y * s_y + A_z * s_z);
            wide_store(&v_out[i][k], v_0 + B_y * s_y + B_z * s_z);
        }
    }
}

static const double NOTHING = 1e-30;  // [N2]: forces without a direction

INLINE wide length_of(wide y, wide z)
{
    return wide_sqrt(y * y + z * z + NOTHING);
}

// Friction of a packet's joints mapped back: deflections (y, z) of joints and heads, forces of the plates [N], parts of
// the trial forces that plates and heads hold.
typedef struct {
    wide joint[2], head[2], plates[2], held_plates, held_heads;
} Held;

// Part of the square of a capacity up to which friction sticks, so that mapping changes nothing: less than 1, for rounding.
static const double STICKS = 1.0 - 1e-9;

enum { JOINT, HEAD = 2, STATES = 4 };  // blocks of the friction states, of each y and z

_Static_assert(Y_JOINT_HEAD_Y == Y_JOINT_PLATE_Y + HEAD * Z && Y_JOINT_HEAD_Z == Y_JOINT_PLATE_Y + 3 * Z,
               "the friction states stand in a row");

// z: friction states, padded; of the packet from joint j on.
INLINE Held hold(const JointStiffness *k_in, wide C_plates, wide C_heads, ball_array z[STATES], int j)
{
    Held on;
    const wide joint[2] = {wide_load(&z[JOINT][j]), wide_load(&z[JOINT + 1][j])};
    const wide head[2] = {wide_load(&z[HEAD][j]), wide_load(&z[HEAD + 1][j])};
    const double k = k_in->stick, k_h = k_in->head;
    const wide zero = wide_set(0.0), H_y = k_h * head[0], H_z = k_h * head[1];
    const wide X_y = k * joint[0] - H_y, X_z = k * joint[1] - H_z;
    const wide size_2 = X_y * X_y + X_z * X_z + NOTHING, heads_2 = H_y * H_y + H_z * H_z + NOTHING;
    const wide beyond =
        wide_max(size_2 - STICKS * (C_plates * C_plates), heads_2 - STICKS * (C_heads * C_heads));
    if (!wide_any(wide_above(beyond, 0.0))) {
        on.held_heads = on.held_plates = wide_set(1.0);
        for (int i = 0; i < 2; i++) on.head[i] = head[i];
        on.plates[0] = X_y, on.plates[1] = X_z;
        on.joint[0] = (H_y + X_y) * (1.0 / k), on.joint[1] = (H_z + X_z) * (1.0 / k);
        return on;
    }
    const wide size = wide_sqrt(size_2);
    const wide dragged = wide_max(size - C_plates, zero) / ((k + k_h) * size);
    const wide h_y = head[0] + dragged * X_y, h_z = head[1] + dragged * X_z;
    on.held_heads = C_heads / wide_max(length_of(k_h * h_y, k_h * h_z), C_heads);
    on.head[0] = on.held_heads * h_y, on.head[1] = on.held_heads * h_z;

    const wide R_y = k * joint[0] - k_h * on.head[0], R_z = k * joint[1] - k_h * on.head[1];
    on.held_plates = C_plates / wide_max(length_of(R_y, R_z), C_plates);
    on.plates[0] = on.held_plates * R_y, on.plates[1] = on.held_plates * R_z;
    for (int i = 0; i < 2; i++) on.joint[i] = (k_h * on.head[i] + on.plates[i]) * (1.0 / k);
    return on;
}

// Part of its capacity from which friction that is driven outward counts as sliding: states that a step has mapped lie
// on their discs, apart from the change of the forces after the mapping.
static const double SLIDES = 0.999;

// Power of friction of the force F that slides with the velocity v.
INLINE wide sliding_power(wide C, wide F_y, wide F_z, wide v_y, wide v_z)
{
    const wide zero = wide_set(0.0), size = length_of(F_y, F_z);
    return wide_select(wide_above(size - SLIDES * C, 0.0), wide_max(v_y * F_y + v_z * F_z, zero), zero);
}

// Force of a shank that bears against its holes, per offset.
INLINE wide bearing_of(wide slip, wide gap, wide k_hole)
{
    return k_hole * wide_max(slip - gap, wide_set(0.0)) / slip;
}

INLINE void load_friction(const scalar *rows, ball_array z[STATES])
{
    for (int i = 0; i < STATES; i++) {
        for (int k = Z; k < LANES; k++) z[i][k] = 0.0;
        memcpy(z[i], &rows[i * Z], Z * sizeof *rows);
    }
}

#ifndef DUAL
void cage_joint_follow(double h, const double *v_y, const double *v_z, double *y)
{
    for (int k = 0; k < Z; k++) {
        y[Y_JOINT_PLATE_Y + k] += h * v_y[k];
        y[Y_JOINT_PLATE_Z + k] += h * v_z[k];
    }
}

double cage_joint_slide(const Model *model, const JointStiffness *k_in, const double *T,
                        const double *N_plate, double *y, JointStep *step)
{
    const double mu = model->p->joint.mu, floor = model->p->joint.F_floor;
    ball_array z[STATES], z_0[STATES], lost;
    load_friction(&y[Y_JOINT_PLATE_Y], z);
    load_friction(step->before, z_0);
    for (int k = 0; k < PACKETS * LANE_WIDTH; k += LANE_WIDTH) {
        const wide N = wide_load(&N_plate[k]), tension = wide_load(&T[k]);
        const Held on = hold(k_in, mu * N + floor, mu * tension + floor, z, k);

        // slips of plates and heads, and the work of the mean forces over them
        wide plates[2], heads[2], work = wide_set(0.0);
        for (int i = 0; i < 2; i++) {
            const wide head_0 = wide_load(&z_0[HEAD + i][k]), joint_0 = wide_load(&z_0[JOINT + i][k]);
            plates[i] = wide_load(&z[JOINT + i][k]) - on.joint[i];
            heads[i] = plates[i] - (on.head[i] - head_0);
            work += 0.5 * (k_in->stick * (joint_0 + on.joint[i]) * plates[i] -
                           k_in->head * (head_0 + on.head[i]) * (on.head[i] - head_0));
            wide_store(&z[JOINT + i][k], on.joint[i]);
            wide_store(&z[HEAD + i][k], on.head[i]);
        }
        wide_store(&lost[k], wide_max(work, wide_set(0.0)));
        wide_store(&step->rubbed[k], wide_load(&step->rubbed[k]) + N * wide_hypot(plates[0], plates[1]) +
                                         tension * wide_hypot(heads[0], heads[1]));
    }
    for (int i = 0; i < STATES; i++) memcpy(&y[Y_JOINT_PLATE_Y + i * Z], z[i], Z * sizeof *y);
    return ball_array_sum(lost);
}

void cage_joint_shear(const Model *model, const double *y, const JointStiffness *k_in, const ball_array u_y,
                      const ball_array u_z, ball_array F_y, ball_array F_z)
{
    for (int k = 0; k < PACKETS * LANE_WIDTH; k += LANE_WIDTH) {  // padding lanes read the rows behind
        const wide x = wide_load(&u_y[k]), z = wide_load(&u_z[k]), slip = length_of(x, z);
        const wide bearing = bearing_of(slip, wide_load(&model->d->hole_gap[k]), wide_load(&k_in->hole[k]));
        wide_store(&F_y[k], -k_in->stick * wide_load(&y[Y_JOINT_PLATE_Y + k]) - bearing * x);
        wide_store(&F_z[k], -k_in->stick * wide_load(&y[Y_JOINT_PLATE_Z + k]) - bearing * z);
    }
}
#endif

// Adds the joints' wrench (F, M) on half 1, taken about the centre of half 0 in its frame, to half 1 about
// its own centre, and the opposite to half 0.
static void add_wrench(Work *w, const scalar F[3], const scalar M[3])
{
    Rotor *h0 = &w->half[0], *h1 = &w->half[1];
    scalar force[3], moment[3], shift[3], arm[3];
    for (int i = 0; i < 3; i++) {
        force[i] = h0->a[i] * F[0] + h0->b_y[i] * F[1] + h0->b_z[i] * F[2];
        moment[i] = h0->a[i] * M[0] + h0->b_y[i] * M[1] + h0->b_z[i] * M[2];
        arm[i] = h1->x[i] - h0->x[i];
    }
    cross3(arm, force, shift);
    for (int i = 0; i < 3; i++) {
        h0->F[i] -= force[i];
        h0->M[i] -= moment[i];
        h1->F[i] += force[i];
        h1->M[i] += moment[i] - shift[i];
    }
}

void cage_joint_force(const Model *model, const scalar *y, const JointStiffness *k_in, const JointMotion *at,
                      Work *w)
{
    const Parameters *p = model->p;
    const Derived *d = model->d;
    ball_array z[STATES], F_x, M_x, M_y, M_z;
    load_friction(&y[Y_JOINT_PLATE_Y], z);
    const wide zero = wide_set(0.0), floor = wide_set(p->joint.F_floor), mu = wide_set(p->joint.mu);
    const double k_h = k_in->head, part = k_in->stick / (k_in->stick + k_h);
    for (int k = 0; k < PACKETS * LANE_WIDTH; k += LANE_WIDTH) {
        const wide u_y = wide_load(&at->u_y[k]), u_z = wide_load(&at->u_z[k]);
        const wide v_y = wide_load(&at->v_y[k]), v_z = wide_load(&at->v_z[k]);

        // friction; plates whose heads still stick slip with a part of the motion
        const wide C_plates = mu * wide_load(&at->N_plate[k]) + floor;
        const wide C_heads = mu * wide_load(&at->T[k]) + floor;
        const Held on = hold(k_in, C_plates, C_heads, z, k);
        const wide H_y = k_h * on.head[0], H_z = k_h * on.head[1];
        const wide by_heads = sliding_power(C_heads, H_y, H_z, v_y, v_z);
        const wide by_plates = sliding_power(C_plates, on.plates[0], on.plates[1], v_y, v_z);
        const wide heads_slide = wide_select(wide_above(by_heads, 0.0), wide_set(1.0), wide_set(part));
        wide_store(&w->joint_dissipated[k],
                   wide_select(wide_above(by_plates, 0.0), by_heads, zero) + heads_slide * by_plates);
        wide_store(&w->plate_held[k], on.held_plates);
        wide_store(&w->head_held[k], on.held_heads);

        // hole contact
        const wide slip = length_of(u_y, u_z);
        const wide gap = wide_load(&d->hole_gap[k]), k_hole = wide_load(&k_in->hole[k]);
        const wide bearing = bearing_of(slip, gap, k_hole);
        wide_store(&w->k_bearing[k], wide_select(wide_above(slip - gap, 0.0), k_hole, zero));

        wide_store(&w->S_y[k], -on.plates[0]);
        wide_store(&w->S_z[k], -on.plates[1]);
        wide_store(&w->H_y[k], -H_y);
        wide_store(&w->H_z[k], -H_z);
        wide_store(&w->B_y[k], -bearing * u_y);
        wide_store(&w->B_z[k], -bearing * u_z);

        // wrench on half 1 at its hole, which is at s + u from the centre of half 0, in the frame of half 0
        const wide f_x = wide_load(&at->F_x[k]);
        const wide f_y = -(on.plates[0] + H_y + bearing * u_y), f_z = -(on.plates[1] + H_z + bearing * u_z);
        const wide r_x = wide_load(&w->u_x[k]), r_y = wide_load(&d->rivet_y[k]) + wide_load(&w->u_y[k]);
        const wide r_z = wide_load(&d->rivet_z[k]) + wide_load(&w->u_z[k]);
        wide_store(&F_x[k], f_x);
        wide_store(&w->joint_F_y[k], f_y);
        wide_store(&w->joint_F_z[k], f_z);
        wide_store(&M_x[k], r_y * f_z - r_z * f_y);
        wide_store(&M_y[k], r_z * f_x - r_x * f_z);
        wide_store(&M_z[k], r_x * f_y - r_y * f_x);
    }
    const scalar F[3] = {ball_array_sum(F_x), ball_array_sum(w->joint_F_y), ball_array_sum(w->joint_F_z)};
    const scalar M[3] = {ball_array_sum(M_x), ball_array_sum(M_y), ball_array_sum(M_z)};
    add_wrench(w, F, M);
}

// ---- loads of joints and rivets ---------------------------------------------------------------------------
// A vector (y, z) at a packet of rivets from k on, radially and along the circle.
INLINE void polar(const Model *model, wide y, wide z, int k, ball_array to[2])
{
    const double inv_R = model->d->inv_R;
    const wide c = wide_load(&model->d->rivet_y[k]) * inv_R, s = wide_load(&model->d->rivet_z[k]) * inv_R;
    wide_store(&to[0][k], y * c + z * s);
    wide_store(&to[1][k], z * c - y * s);
}

void cage_joint_carried(const Model *model, const Work *w, JointShear *shear)
{
    for (int k = 0; k < PACKETS * LANE_WIDTH; k += LANE_WIDTH) {
        polar(model, -wide_load(&w->S_y[k]), -wide_load(&w->S_z[k]), k, shear->plates);
        polar(model, -wide_load(&w->H_y[k]), -wide_load(&w->H_z[k]), k, shear->heads);
        polar(model, -wide_load(&w->B_y[k]), -wide_load(&w->B_z[k]), k, shear->shank);
    }
}

void cage_joint_loads(const Model *model, const ball_array joint[3], const ball_array rivet[3],
                      const JointShear *shear, JointLoads *load)
{
    for (int k = 0; k < PACKETS * LANE_WIDTH; k += LANE_WIDTH) {
        const wide heads_r = wide_load(&shear->heads[0][k]), heads_t = wide_load(&shear->heads[1][k]);
        const wide V_r = wide_load(&shear->shank[0][k]), V_t = wide_load(&shear->shank[1][k]);
        wide_store(&load->N[k], wide_load(&joint[0][k]));
        wide_store(&load->M_r[k], wide_load(&joint[1][k]));
        wide_store(&load->M_t[k], wide_load(&joint[2][k]));
        wide_store(&load->V[k], wide_hypot(wide_load(&shear->plates[0][k]) + heads_r + V_r,
                                           wide_load(&shear->plates[1][k]) + heads_t + V_t));
        wide_store(&load->T[k], wide_load(&rivet[0][k]));
        wide_store(&load->m_r[k], wide_load(&rivet[1][k]));
        wide_store(&load->m_t[k], wide_load(&rivet[2][k]));
        wide_store(&load->V_r[k], V_r);
        wide_store(&load->V_t[k], V_t);
        wide_store(&load->F_head[k], wide_load(&model->d->intact[k]) * wide_hypot(heads_r, heads_t));
    }
}
