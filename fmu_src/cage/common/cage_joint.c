// Riveted joint k: plates pressed together by the rivet, friction of plates and heads, the rivet's shank in
// its holes.
//
//      |  T  |          u    hole of half 1 - hole of half 0 at rivet k, in the body frame of half 0, v its rate
//   ---+-   -+---       T    tension of the rivet, N_plate force between the plates: two_half.c, cage_elastic.c
//   half 1     | u_x    plate friction  S = -k_t z,  z' = v - |v| k_t z/(mu N_plate + F_floor)
//   ===+=====+===       head friction   H = -k_h z_h, likewise with mu T + F_floor
//   half 0     |        hole contact    B = -k_hole max(0, |u| - gap) u/|u|,  gap = max(0, -fit_a): the diametral play
//   ---+-   -+---
//      |     |
//
// The friction law is that of Dahl (1968): its force is a state, so that a closed joint does not creep.  Under
// a growing transverse load the plates slip first (at mu N_plate), then the heads slip on the rivet (at mu T
// more), then the halves move freely across the gap, and at last the shank bears against its holes.
//
// Force and reaction act at the same point, so momentum and energy are exact.
// Smoothness: C0 at bearing (a spring of finite stiffness begins), C0 at v = 0.
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

// Dahl's friction with force -k z: sets the rate of z and its decay D, returns the dissipated power.
INLINE wide cage_joint_friction(wide k, wide capacity, wide z_y, wide z_z, wide v_y, wide v_z, wide speed,
                                scalar *dot_y, scalar *dot_z, scalar *D)
{
    const wide rate = speed * k / capacity;
    wide_store(D, rate);
    wide_store(dot_y, v_y - rate * z_y);
    wide_store(dot_z, v_z - rate * z_z);
    return k * rate * (z_y * z_y + z_z * z_z);
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
// Friction states z at rows row_y, row_z of y over a step h by the implicit midpoint rule:
// z += h z'/(1 + h D/2), D = speed k/capacity.  Returns the work h k D z_m^2 that they dissipate, z_m in the middle.
static double advance(const JointMotion *at, double h, double k, const double *capacity, int row_y, int row_z,
                      double *y)
{
    ball_array z_y = {0}, z_z = {0}, lost;
    memcpy(z_y, &y[row_y], Z * sizeof *y);
    memcpy(z_z, &y[row_z], Z * sizeof *y);
    for (int b = 0; b < PACKETS; b++) {
        const int i = b * LANE_WIDTH;
        const wide v_y = wide_load(&at->v_y[i]), v_z = wide_load(&at->v_z[i]);
        const wide rate = wide_sqrt(v_y * v_y + v_z * v_z) * k / wide_load(&capacity[i]);
        const wide inv = h / (1.0 + (0.5 * h) * rate);
        const wide a = wide_load(&z_y[i]), c = wide_load(&z_z[i]);
        const wide change_y = (v_y - rate * a) * inv, change_z = (v_z - rate * c) * inv;
        const wide middle_y = a + 0.5 * change_y, middle_z = c + 0.5 * change_z;
        wide_store(&z_y[i], a + change_y);
        wide_store(&z_z[i], c + change_z);
        wide_store(&lost[i], (h * k) * rate * (middle_y * middle_y + middle_z * middle_z));
    }
    memcpy(&y[row_y], z_y, Z * sizeof *y);
    memcpy(&y[row_z], z_z, Z * sizeof *y);
    return ball_array_sum(lost);
}

double cage_joint_advance(const Model *model, double h, const JointStiffness *k_in, const JointMotion *at,
                          double *y)
{
    const double mu = model->p->joint.mu, floor = model->p->joint.F_floor;
    ball_array plates, heads;
    for (int k = 0; k < PACKETS * LANE_WIDTH; k += LANE_WIDTH) {
        wide_store(&plates[k], mu * wide_load(&at->N_plate[k]) + floor);
        wide_store(&heads[k], mu * wide_load(&at->T[k]) + floor);
    }
    const double by_plates = advance(at, h, k_in->plate, plates, Y_JOINT_PLATE_Y, Y_JOINT_PLATE_Z, y);
    return by_plates + advance(at, h, k_in->head, heads, Y_JOINT_HEAD_Y, Y_JOINT_HEAD_Z, y);
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
        const wide speed = wide_sqrt(v_y * v_y + v_z * v_z);
        const wide zp_y = wide_load(&z.plate_y[k]), zp_z = wide_load(&z.plate_z[k]);
        const wide zh_y = wide_load(&z.head_y[k]), zh_z = wide_load(&z.head_z[k]);
        wide lost = cage_joint_friction(k_t, mu * wide_load(&at->N_plate[k]) + floor, zp_y, zp_z, v_y, v_z,
                                        speed, &w->plate_y_dot[k], &w->plate_z_dot[k], &w->plate_rate[k]);
        lost += cage_joint_friction(k_h, mu * wide_load(&at->T[k]) + floor, zh_y, zh_z, v_y, v_z, speed,
                                    &w->head_y_dot[k], &w->head_z_dot[k], &w->head_rate[k]);

        // hole contact
        const wide slip = wide_sqrt(u_y * u_y + u_z * u_z + 1e-30);
        const wide gap = wide_load(&d->hole_gap[k]), k_hole = wide_load(&k_in->hole[k]);
        const wide bearing = bearing_of(slip, gap, k_hole);
        wide_store(&w->k_bearing[k], wide_select(wide_above(slip - gap, 0.0), k_hole, zero));

        wide_store(&w->S_y[k], -k_t * zp_y);
        wide_store(&w->S_z[k], -k_t * zp_z);
        wide_store(&w->H_y[k], -k_h * zh_y);
        wide_store(&w->H_z[k], -k_h * zh_z);
        wide_store(&w->B_y[k], -bearing * u_y);
        wide_store(&w->B_z[k], -bearing * u_z);
        wide_store(&w->joint_dissipated[k], lost);

        // wrench on half 1 at its hole, which is at s + u from the centre of half 0, in the frame of half 0
        const wide f_x = wide_load(&at->F_x[k]);
        const wide f_y = -k_t * zp_y - k_h * zh_y - bearing * u_y,
                   f_z = -k_t * zp_z - k_h * zh_z - bearing * u_z;
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
