// Riveted joint k: plates pressed together by the rivet, friction of plates and heads, the rivet's shank in
// its holes.
//
//      |  T  |          u    hole of half 1 - hole of half 0 at rivet k, in the body frame of half 0, v its rate
//   ---+-   -+---       T    tension of the rivet, N_plate force between the plates: two_half.c, cage_elastic.c
//   half 1     | u_x    plate friction  S = -k_t z,  |S| <= C = mu N_plate + F_floor
//   ===+=====+===       head friction   H = -k_h z_h, likewise with mu T + F_floor
//   half 0     |        hole contact    B = -k_hole max(0, |u| - gap) u/|u|,  gap = max(0, -fit_a): the diametral play
//   ---+-   -+---
//      |     |
//
// Friction is elastic and perfectly plastic: the deflection z of a spring follows the motion, z' = v, as long as
// Coulomb's law allows its force, and slips where it does not (Moreau 1977: z' - v is normal to the disc k |z| <= C).
// Below the slip load nothing slips, so that a joint that carries a constant load under vibration shakes down
// (Melan's theorem) instead of creeping.  Between two moments the law is integrated by return mapping (Simo and
// Hughes 1998, section 1.4): z first follows the whole motion; its part beyond the disc, taken off along z, is slip,
//
//     z = f z_trial,  z_trial = z_0 + h v,  f = min(1, C/(k |z_trial|)),  dissipated: k (z_0 + z)/2 . (1 - f) z_trial
//
// for any h and for a capacity C that changes.  An evaluation has the trial deflections among its states and the forces
// of f z_trial; the end of a step or substep maps the states back (cage_joint_slide).  The dissipation is the work of the
// mean force over the motion less the change of k z^2/2: the balance of energy is closed in every step.
//
// Under a growing transverse load the plates slip first (at mu N_plate), then the heads slip on the rivet (at mu T
// more), then the halves move freely across the gap, and at last the shank bears against its holes.
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

// Part f of a trial deflection that friction of the capacity C holds.
INLINE wide held_part(wide k, wide C, wide z_y, wide z_z)
{
    return C / wide_max(k * wide_sqrt(z_y * z_y + z_z * z_z + 1e-30), C);
}

// Part of its capacity from which friction that is driven outward counts as sliding: states that a step has mapped back
// lie on their disc but for what forces change behind the mapping.
static const double SLIDES = 0.999;

// Power of sliding friction: the capacity times the speed along the force.
INLINE wide sliding_power(wide k, wide C, wide z_y, wide z_z, wide v_y, wide v_z)
{
    const wide zero = wide_set(0.0), size = wide_sqrt(z_y * z_y + z_z * z_z + 1e-30);
    const wide power = C * wide_max(v_y * z_y + v_z * z_z, zero) / size;
    return wide_select(wide_above(k * size - SLIDES * C, 0.0), power, zero);
}

// Force of a shank that bears against its holes, per offset.
INLINE wide bearing_of(wide slip, wide gap, wide k_hole)
{
    return k_hole * wide_max(slip - gap, wide_set(0.0)) / slip;
}

// Friction states of plates and heads, padded.
typedef struct {
    ball_array plate_y, plate_z, head_y, head_z;
} FrictionStates;

INLINE void load_friction(const scalar *y, FrictionStates *z)
{
    for (int k = Z; k < LANES; k++) z->plate_y[k] = z->plate_z[k] = z->head_y[k] = z->head_z[k] = 0.0;
    memcpy(z->plate_y, &y[Y_JOINT_PLATE_Y], Z * sizeof *y);
    memcpy(z->plate_z, &y[Y_JOINT_PLATE_Z], Z * sizeof *y);
    memcpy(z->head_y, &y[Y_JOINT_HEAD_Y], Z * sizeof *y);
    memcpy(z->head_z, &y[Y_JOINT_HEAD_Z], Z * sizeof *y);
}

#ifndef DUAL
void cage_joint_follow(double h, const double *v_y, const double *v_z, double *y)
{
    for (int k = 0; k < Z; k++) {
        y[Y_JOINT_PLATE_Y + k] += h * v_y[k];
        y[Y_JOINT_PLATE_Z + k] += h * v_z[k];
        y[Y_JOINT_HEAD_Y + k] += h * v_y[k];
        y[Y_JOINT_HEAD_Z + k] += h * v_z[k];
    }
}

// Maps the friction states at rows row_y, row_z of y back onto k |z| <= mu N + F_floor; N: normal force.
static double slide(const Model *model, double k, const double *N, int row_y, int row_z, double *y,
                    JointStep *step)
{
    const double mu = model->p->joint.mu, floor = model->p->joint.F_floor;
    ball_array z_y = {0}, z_z = {0}, y_0 = {0}, z_0 = {0}, lost;
    memcpy(z_y, &y[row_y], Z * sizeof *y);
    memcpy(z_z, &y[row_z], Z * sizeof *y);
    memcpy(y_0, &step->before[row_y - Y_JOINT_PLATE_Y], Z * sizeof *y);
    memcpy(z_0, &step->before[row_z - Y_JOINT_PLATE_Y], Z * sizeof *y);
    for (int b = 0; b < PACKETS; b++) {
        const int i = b * LANE_WIDTH;
        const wide normal = wide_load(&N[i]), C = mu * normal + floor;
        const wide a = wide_load(&z_y[i]), c = wide_load(&z_z[i]), f = held_part(wide_set(k), C, a, c);
        const wide slip_y = (1.0 - f) * a, slip_z = (1.0 - f) * c;
        const wide mean_y = 0.5 * (wide_load(&y_0[i]) + f * a), mean_z = 0.5 * (wide_load(&z_0[i]) + f * c);
        wide_store(&z_y[i], f * a);
        wide_store(&z_z[i], f * c);
        const wide slip = (1.0 - f) * wide_sqrt(a * a + c * c);
        wide_store(&step->rubbed[i], wide_load(&step->rubbed[i]) + normal * slip);
        wide_store(&lost[i], wide_max(k * (mean_y * slip_y + mean_z * slip_z), wide_set(0.0)));
    }
    memcpy(&y[row_y], z_y, Z * sizeof *y);
    memcpy(&y[row_z], z_z, Z * sizeof *y);
    return ball_array_sum(lost);
}

double cage_joint_slide(const Model *model, const JointStiffness *k_in, const double *T, const double *N_plate,
                        double *y, JointStep *step)
{
    const double by_plates = slide(model, k_in->plate, N_plate, Y_JOINT_PLATE_Y, Y_JOINT_PLATE_Z, y, step);
    return by_plates + slide(model, k_in->head, T, Y_JOINT_HEAD_Y, Y_JOINT_HEAD_Z, y, step);
}

void cage_joint_shear(const Model *model, const double *y, const JointStiffness *k_in, const ball_array u_y,
                      const ball_array u_z, ball_array F_y, ball_array F_z)
{
    FrictionStates z;
    load_friction(y, &z);
    for (int k = 0; k < PACKETS * LANE_WIDTH; k += LANE_WIDTH) {
        const wide along = wide_load(&u_y[k]), across = wide_load(&u_z[k]);
        const wide slip = wide_sqrt(along * along + across * across + 1e-30);
        const wide bearing = bearing_of(slip, wide_load(&model->d->hole_gap[k]), wide_load(&k_in->hole[k]));
        wide_store(&F_y[k], -k_in->plate * wide_load(&z.plate_y[k]) - k_in->head * wide_load(&z.head_y[k]) -
                                bearing * along);
        wide_store(&F_z[k], -k_in->plate * wide_load(&z.plate_z[k]) - k_in->head * wide_load(&z.head_z[k]) -
                                bearing * across);
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
    FrictionStates z;
    ball_array F_x, M_x, M_y, M_z;
    load_friction(y, &z);
    const wide zero = wide_set(0.0), floor = wide_set(p->joint.F_floor), mu = wide_set(p->joint.mu);
    const wide k_t = wide_set(k_in->plate), k_h = wide_set(k_in->head);
    for (int k = 0; k < PACKETS * LANE_WIDTH; k += LANE_WIDTH) {
        const wide u_y = wide_load(&at->u_y[k]), u_z = wide_load(&at->u_z[k]);
        const wide v_y = wide_load(&at->v_y[k]), v_z = wide_load(&at->v_z[k]);

        // friction
        const wide zp_y = wide_load(&z.plate_y[k]), zp_z = wide_load(&z.plate_z[k]);
        const wide zh_y = wide_load(&z.head_y[k]), zh_z = wide_load(&z.head_z[k]);
        const wide plates = mu * wide_load(&at->N_plate[k]) + floor, heads = mu * wide_load(&at->T[k]) + floor;
        const wide held_p = held_part(k_t, plates, zp_y, zp_z), held_h = held_part(k_h, heads, zh_y, zh_z);
        const wide S_y = -k_t * held_p * zp_y, S_z = -k_t * held_p * zp_z;
        const wide H_y = -k_h * held_h * zh_y, H_z = -k_h * held_h * zh_z;
        wide_store(&w->plate_held[k], held_p);
        wide_store(&w->head_held[k], held_h);

        // hole contact
        const wide slip = wide_sqrt(u_y * u_y + u_z * u_z + 1e-30);
        const wide gap = wide_load(&d->hole_gap[k]), k_hole = wide_load(&k_in->hole[k]);
        const wide bearing = bearing_of(slip, gap, k_hole);
        wide_store(&w->k_bearing[k], wide_select(wide_above(slip - gap, 0.0), k_hole, zero));

        wide_store(&w->S_y[k], S_y);
        wide_store(&w->S_z[k], S_z);
        wide_store(&w->H_y[k], H_y);
        wide_store(&w->H_z[k], H_z);
        wide_store(&w->B_y[k], -bearing * u_y);
        wide_store(&w->B_z[k], -bearing * u_z);
        wide_store(&w->joint_dissipated[k], sliding_power(k_t, plates, zp_y, zp_z, v_y, v_z) +
                                                sliding_power(k_h, heads, zh_y, zh_z, v_y, v_z));

        // wrench on half 1 at its hole, which is at s + u from the centre of half 0, in the frame of half 0
        const wide f_x = wide_load(&at->F_x[k]);
        const wide f_y = S_y + H_y - bearing * u_y, f_z = S_z + H_z - bearing * u_z;
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
