// Rigid cage halves and the loads of their rivets.
//
// Joint k, along the axis: springs between the halves, u_x the distance of the holes beyond their place under preload,
//
//     pull = max(0, P + k_rivet u_x)     the rivet and the flanges under its heads
//     push = max(0, P - k_plate u_x)     the plates, damped by c v_x push/(push + F_floor)
//
// A rigid half carries the load of a pocket straight to all joints.  A half that bends also pries at the joints beside
// the pocket, and the cage's own centrifugal load pries at all of them.  So the joint's load is the rigid share, pull -
// push, plus the load of bonded joints of halves that bend (half_path.h).  Joints that open and slip relieve this added
// load (joint_open.h); in the plane it is carried by the friction and the play that the rigid share leaves over.  The
// tension T of the rivet and the force between the plates, N_plate = T - N, follow from the whole load; the friction
// law and the outputs use them.  The springs alone move the halves.
//
// The work of the added loads is that of the halves' elastic deformation, which rigid halves do not have: on rigid halves
// the centrifugal loads of all parts balance, so that they do no work and the energy balance has no term for them.
//
// In a frame that turns, the centrifugal load is that of the speed in the fixed frame; a uniform field of gravity or of
// the frame's acceleration acts on a half as its own acceleration does, and is in the load path's balance of forces.
//
// The tangential inertia load of a cage whose speed changes (Euler's) is to the centrifugal one as omega_dot to
// omega^2: 1.3 % in a run-up to 18,238 r/min within 0.1 s, 0.013 % within 10 s, so it is left out.
//
// Loads are on the +x half, in the frames (x, r, t) of the rivets, at body angles 2 pi (k + 1/2)/Z of half 0.
// Smoothness: C0 at opening, where a spring of finite stiffness begins.
#include "cage/two_half/two_half.h"

#include "cage/common/cage_joint.h"
#include "cage/common/films.h"
#include "cage/common/spin_preload.h"
#include "cage/two_half/joint_open.h"
#include "numbers/elimination.h"

// ---- joints -------------------------------------------------------------------------------------------------

// Rows of the loads of bonded joints by pocket forces, films of the lands and centrifugal load.
static void bonded_rows(const Model *model, const Work *w, scalar omega_2, ball_array rows[ROWS])
{
    PathForces forces[2];
    for (int h = 0; h < 2; h++) {
        const Pockets *on = &w->pocket[h];
        forces[h] = (PathForces){on->F_x, on->F_r, on->F_t, on->push_x, on->push_t, on->radius};
    }
    const bool touched = half_path_rows(&rivet_table.half.path, forces, rows);
    if (!touched) memset(rows, 0, ROWS * sizeof *rows);
    if (model->d->guided) {
        const scalar *re[2] = {w->land[0].re, w->land[1].re}, *im[2] = {w->land[0].im, w->land[1].im};
        half_path_add_lands(&model->d->land_path, re, im, rows);
    }
    for (int i = 0; i < ROWS; i++) {
        const wide spin = wide_set(omega_2 * model->d->centrifugal[i]);
        for (int k = 0; k < PACKETS * LANE_WIDTH; k += LANE_WIDTH)
            wide_store(&rows[i][k], wide_load(&rows[i][k]) + spin);
    }
}

// Adds the bending of a ribbon's lands to the rows of the preload; returns its addition to the mean preload.
static scalar bend_lands(const Derived *d, scalar omega_2, ball_array rows[ROWS])
{
    const CageHalfData *half = &rivet_table.half;
    if (half->spin_steps == 0) return 0.0;
    const scalar w = omega_2 * d->centrifugal[ROW_DP];
    for (int k = 0; k < Z; k++) rows[ROW_DP][k] += spin_bending(half, d->P[k], w);
    return spin_bending(half, d->P_mean, w);
}

// Loads of the joints by their springs' forces and the load path.
static void open_joints(const Model *model, Work *w)
{
    const Derived *d = model->d;
    TwoHalfWork *t = &w->cage.two_half;
    ball_array rows[ROWS], bonded[3], P;
    const scalar s_0 = w->half[0].s + w->frame_omega, s_1 = w->half[1].s + w->frame_omega;
    const scalar omega_2 = 0.5 * (s_0 * s_0 + s_1 * s_1);
    bonded_rows(model, w, omega_2, rows);
    const scalar bending = bend_lands(d, omega_2, rows);
    for (int k = 0; k < PACKETS * LANE_WIDTH; k += LANE_WIDTH) {
        const wide rigid = wide_load(&t->pull[k]) - wide_load(&t->push[k]);
        wide_store(&bonded[0][k], rigid + wide_load(&rows[ROW_N][k]));
        wide_store(&bonded[1][k], wide_load(&rows[ROW_M_R][k]));
        wide_store(&bonded[2][k], wide_load(&rows[ROW_M_T][k]));
        wide_store(&P[k], wide_load(&d->intact[k]) *
                              wide_max(wide_load(&d->P[k]) + wide_load(&rows[ROW_DP][k]), wide_set(0.0)));
        wide_store(&t->bonded_V[0][k], wide_load(&rows[ROW_V_R][k]));
        wide_store(&t->bonded_V[1][k], wide_load(&rows[ROW_V_T][k]));
    }
    const scalar spin_M = omega_2 * d->centrifugal[ROW_M_T],
                 spin_P = scalar_max(d->P_mean + omega_2 * d->centrifugal[ROW_DP] + bending, 0.0);
    joints_open(&rivet_table.half.law, bonded, P, d->intact, spin_M, spin_P, t->load, t->rivet);

    // The plates of a joint without a rivet are pressed by the springs alone.
    for (int k = 0; k < PACKETS * LANE_WIDTH; k += LANE_WIDTH) {
        const wide zero = wide_set(0.0), intact = wide_load(&d->intact[k]);
        const wide T = wide_max(wide_load(&t->rivet[0][k]), zero);
        const wide closed = wide_max(T - wide_load(&t->load[0][k]), zero);
        wide_store(&t->rivet[0][k], T);
        wide_store(&t->N_plate[k], wide_select(wide_above(intact, 0.0), closed, wide_load(&t->push[k])));
        for (int i = 1; i < 3; i++) {
            const wide more = wide_load(&rows[ROW_DM_R + i - 1][k]);
            wide_store(&t->rivet[i][k], intact * (wide_load(&t->rivet[i][k]) + more));
        }
    }
}

void two_half_joints(const Model *model, const scalar *y, Work *w)
{
    const Derived *d = model->d;
    TwoHalfWork *t = &w->cage.two_half;
    const wide floor = wide_set(model->p->joint.F_floor);
    ball_array F_x, damped;
    for (int k = 0; k < PACKETS * LANE_WIDTH; k += LANE_WIDTH) {
        const wide u_x = wide_load(&w->u_x[k]), v_x = wide_load(&w->v_jx[k]), P = wide_load(&d->P[k]);
        const wide pull = wide_load(&d->intact[k]) * wide_max(P + d->k_rivet * u_x, wide_set(0.0));
        const wide push = wide_max(P - d->k_plate * u_x, wide_set(0.0));
        const wide damping = d->c_joint * push / (push + floor);
        wide_store(&t->pull[k], pull);
        wide_store(&t->push[k], push);
        wide_store(&F_x[k], push - pull - damping * v_x);
        wide_store(&damped[k], damping * v_x * v_x);
    }
    open_joints(model, w);
    const JointStiffness k_in = two_half_stiffness(d);
    const JointMotion at = {w->u_y, w->u_z, w->v_jy, w->v_jz, t->rivet[0], t->N_plate, F_x};
    cage_joint_force(model, y, &k_in, &at, w);
    t->dissipated = ball_array_sum(damped);
}

// Adds the loads of plates, heads and shanks by the load path.
ONCE void add_slip(const Model *model, const Work *w, JointShear *shear)
{
    const TwoHalfWork *t = &w->cage.two_half;
    const JointMotion at = {.u_y = w->u_y, .u_z = w->u_z, .T = t->rivet[0], .N_plate = t->N_plate};
    joint_slip_add(model, w, &at, t->bonded_V[0], t->bonded_V[1], shear);
}

void two_half_loads(const Model *model, const Work *w, JointLoads *load)
{
    JointShear shear;
    cage_joint_carried(model, w, &shear);
    add_slip(model, w, &shear);
    cage_joint_loads(model, w->cage.two_half.load, w->cage.two_half.rivet, &shear, load);
}

// ---- a step -------------------------------------------------------------------------------------------------
//
//   two_half_begin   halves and joints in the middle; friction states follow; predicted velocities v^
//   two_half_end     films in pockets at the end's velocities (pocket_films.c)
//                    S (1 + gamma A + gamma^2 K) delta = residual     S = 1 + gamma^2 K_shear, across the axis, a factor of
//                    its own (two_half_shear); A, K of films and joints along the axis (two_half_solve)
//                    v_{n+1} = v^ + delta; positions and friction states follow with weights; history and errors
#ifndef DUAL
// Weights of a vibration between the halves that turns by x = omega h a step, given x^2: `matrix` multiplies K in the
// matrix, the return value c the position correction.  Both are 1/3 for small x, which makes the frequency exact to
// order four (Fox and Goodwin); for large x they tend to 1.5 and 1.7, which takes 22 % of the amplitude a step:
// a vibration that the step cannot resolve dies out (docs/method.md).
static double vibration_weights(double x_2, double *matrix)
{
    const double part = x_2 * x_2 / (x_2 * x_2 + 1.0);
    *matrix = 1.0 / 3.0 + part * (1.5 - 1.0 / 3.0);
    return 1.0 / 3.0 + part * (1.7 - 1.0 / 3.0);
}

// C = sum over the rivets of (gamma c + gamma^2 k) b b^T, b = (1, z, -y): resistance of the joints to the axial
// motion of half 1 against half 0, (v_x, beta_dot, gamma_dot).  y, z: place of the rivet, turned with half 0.
static void joint_matrix(const Model *model, const Work *w, double gamma, double C[3][3])
{
    const Derived *d = model->d;
    const Rotor *h0 = &w->half[0];
    const wide zero = wide_set(0.0), k_rivet = wide_set(d->k_rivet), k_plate = wide_set(d->k_plate);
    ball_array rate, rate_y, rate_z, rate_yy, rate_yz, rate_zz;
    for (int k = 0; k < PACKETS * LANE_WIDTH; k += LANE_WIDTH) {
        const wide s_y = wide_load(&d->rivet_y[k]), s_z = wide_load(&d->rivet_z[k]);
        const wide y = s_y * h0->b_y[1] + s_z * h0->b_z[1], z = s_y * h0->b_y[2] + s_z * h0->b_z[2];

        // The rivet is stiff while it is tense, the plates while they are pressed together.
        const wide push = wide_load(&w->cage.two_half.push[k]);
        const wide tense = wide_select(wide_above(wide_load(&w->cage.two_half.pull[k]), 0.0), k_rivet, zero);
        const wide pressed = wide_select(wide_above(push, 0.0), k_plate, zero);
        const wide damping = d->c_joint * push / (push + model->p->joint.F_floor);
        const wide rate_k = gamma * (damping + gamma * (tense + pressed));
        wide_store(&rate[k], rate_k);
        wide_store(&rate_y[k], rate_k * y);
        wide_store(&rate_z[k], rate_k * z);
        wide_store(&rate_yy[k], rate_k * y * y);
        wide_store(&rate_yz[k], rate_k * y * z);
        wide_store(&rate_zz[k], rate_k * z * z);
    }
    C[0][0] = ball_array_sum(rate);
    C[1][0] = C[0][1] = ball_array_sum(rate_z);
    C[2][0] = C[0][2] = -ball_array_sum(rate_y);
    C[1][1] = ball_array_sum(rate_zz);
    C[2][1] = C[1][2] = -ball_array_sum(rate_yz);
    C[2][2] = ball_array_sum(rate_yy);
}

// Holds back the axial motion of half 1 against half 0, both already held back by their films f.  With dv
// their relative velocity (v_x, beta_dot, gamma_dot) and G its change by unit impulses, again under the
// films, the impulses of the joints are x = C (dv - G x): three equations (1 + C G) x = C dv, the form of
// Woodbury again.  C is multiplied by the weight of the fastest of the three vibrations; returns the position
// correction's weight.
static double solve_joints(const Model *model, const Work *w, double gamma, const HalfFilm f[2], double *v)
{
    double C[3][3], B[3][3], x[3], weight, G_xx = 0.0, G_bb = 0.0, G_bg = 0.0, G_gg = 0.0;
    joint_matrix(model, w, gamma, C);
    const double tilt = fmax(C[1][1], C[2][2]) / model->d->J_t;
    const double correction = vibration_weights(8.0 * fmax(C[0][0] / model->p->cage.m, tilt), &weight);
    for (int i = 0; i < 9; i++) C[i / 3][i % 3] *= weight;

    // G of both halves; indices b, g: beta, gamma.  A film knows no axial motion.
    for (int h = 0; h < 2; h++) {
        const double lever = f[h].x / f[h].J_t;
        G_xx += 1.0 / f[h].m;
        G_bb += 1.0 / f[h].J_t - lever * lever * f[h].zz;
        G_bg += lever * lever * f[h].yz;
        G_gg += 1.0 / f[h].J_t - lever * lever * f[h].yy;
    }

    // The impulses.
    const double dv[3] = {v[Y_CAGE_V_X + 1] - v[Y_CAGE_V_X], v[Y_CAGE_BETA_DOT + 1] - v[Y_CAGE_BETA_DOT],
                          v[Y_CAGE_GAMMA_DOT + 1] - v[Y_CAGE_GAMMA_DOT]};
    for (int i = 0; i < 3; i++) {
        B[i][0] = (i == 0) + C[i][0] * G_xx;
        B[i][1] = (i == 1) + C[i][1] * G_bb + C[i][2] * G_bg;
        B[i][2] = (i == 2) + C[i][1] * G_bg + C[i][2] * G_gg;
        x[i] = C[i][0] * dv[0] + C[i][1] * dv[1] + C[i][2] * dv[2];
    }
    solve_3(B[0], x);

    // The impulses change the velocities of each half, which its own film holds back again.
    double change[N_STATES];
    memset(&change[Y_CAGE_V_X], 0, CAGE_MOTIONS * sizeof *change);
    for (int h = 0; h < 2; h++) {
        const double sign = h == 0 ? 1.0 : -1.0;
        change[Y_CAGE_V_X + h] = sign * x[0] / f[h].m;
        change[Y_CAGE_BETA_DOT + h] = sign * x[1] / f[h].J_t;
        change[Y_CAGE_GAMMA_DOT + h] = sign * x[2] / f[h].J_t;
        half_film_solve(&f[h], h, change);
    }
    for (int i = Y_CAGE_V_X; i < Y_CAGE_V_X + CAGE_MOTIONS; i++) v[i] += change[i];
    return correction;
}

double two_half_solve(const Model *model, const Work *w, double gamma, double *v)
{
    HalfFilm f[2];
    for (int h = 0; h < 2; h++) {
        f[h] = half_film(model, &w->film[h], h, gamma);
        half_film_solve(&f[h], h, v);
    }
    return solve_joints(model, w, gamma, f, v);
}

// Stiffness [N/m] across the axis of a packet's joints from k on: between that of plates which stick and that of heads by
// the part of the trial force that friction holds, and holes in which a shank bears.
static wide shear_stiffness(const Model *model, const Work *w, int k)
{
    const double stick = model->d->k_plate_t, heads = 1.0 / (1.0 / stick + 1.0 / model->d->k_head);
    const wide slipping = heads * wide_load(&w->head_held[k]);
    return slipping + (stick - slipping) * wide_load(&w->plate_held[k]) + wide_load(&w->k_bearing[k]);
}

// Holds back the motion of half 1 against half 0 across the axis and about it, (v_y, v_z, s): at a rivet at (y, z) its
// velocity is (v_y - s z, v_z + s y).  Weights and result as along the axis.  The impulses are x = C (dv - G x) again,
// C the sum of gamma^2 k over the joints and G = 2 diag(1/m, 1/m, 1/J_p).  Left out is the lever x_c of the joints
// from the centres of mass, 0.2 % of the halves' response.
double two_half_shear(const Model *model, const Work *w, double gamma, double *v)
{
    const Derived *d = model->d;
    const Rotor *h0 = &w->half[0];

    // C = (c, 0, -c_z; 0, c, c_y; -c_z, c_y, c_rr).
    ball_array rate, rate_y, rate_z, rate_rr;
    for (int k = 0; k < PACKETS * LANE_WIDTH; k += LANE_WIDTH) {
        const wide s_y = wide_load(&d->rivet_y[k]), s_z = wide_load(&d->rivet_z[k]);
        const wide y = s_y * h0->b_y[1] + s_z * h0->b_z[1], z = s_y * h0->b_y[2] + s_z * h0->b_z[2];
        const wide rate_k = gamma * gamma * shear_stiffness(model, w, k);
        wide_store(&rate[k], rate_k);
        wide_store(&rate_y[k], rate_k * y);
        wide_store(&rate_z[k], rate_k * z);
        wide_store(&rate_rr[k], rate_k * (y * y + z * z));
    }
    const double m = model->p->cage.m, J_p = d->J_p, G_m = 2.0 / m, G_J = 2.0 / J_p;
    double c = ball_array_sum(rate), c_y = ball_array_sum(rate_y), c_z = ball_array_sum(rate_z);
    double c_rr = ball_array_sum(rate_rr), weight;
    const double correction = vibration_weights(4.0 * fmax(c * G_m, c_rr * G_J), &weight);
    c *= weight, c_y *= weight, c_z *= weight, c_rr *= weight;

    // (1 + C G) x = C dv.
    const double dv_y = v[Y_CAGE_V_Y + 1] - v[Y_CAGE_V_Y], dv_z = v[Y_CAGE_V_Z + 1] - v[Y_CAGE_V_Z];
    const double ds = v[Y_CAGE_S + 1] - v[Y_CAGE_S];
    double B[3][3] = {{1.0 + c * G_m, 0.0, -c_z * G_J},  //
                      {0.0, 1.0 + c * G_m, c_y * G_J},   //
                      {-c_z * G_m, c_y * G_m, 1.0 + c_rr * G_J}};
    double x[3] = {c * dv_y - c_z * ds, c * dv_z + c_y * ds, c_y * dv_z - c_z * dv_y + c_rr * ds};
    solve_3(B[0], x);
    for (int h = 0; h < 2; h++) {
        const double sign = h == 0 ? 1.0 : -1.0;
        v[Y_CAGE_V_Y + h] += sign * x[0] / m;
        v[Y_CAGE_V_Z + h] += sign * x[1] / m;
        v[Y_CAGE_S + h] += sign * x[2] / J_p;
    }
    return correction;
}

enum { VELOCITY = Y_CAGE_V_X - Y_CAGE_X };  // rows from a position to its velocity

// The friction states are the deflections of springs and follow likewise: z_{n+1} += c gamma u with the change u of the
// velocity of half 1 against half 0 at the joint, in the frame of half 0, and the weight c of the motion across the
// axis.  cage_joint_slide maps them back behind it.
static void correct_friction(const Model *model, const Work *w, double gamma, const double *delta, double c,
                             double *y, JointStep *joints)
{
    const Derived *d = model->d;
    const Rotor *h0 = &w->half[0];
    const double dv_y = delta[Y_CAGE_V_Y + 1] - delta[Y_CAGE_V_Y];
    const double dv_z = delta[Y_CAGE_V_Z + 1] - delta[Y_CAGE_V_Z], ds = delta[Y_CAGE_S + 1] - delta[Y_CAGE_S];
    const double u_0y = h0->b_y[1] * dv_y + h0->b_y[2] * dv_z, u_0z = h0->b_z[1] * dv_y + h0->b_z[2] * dv_z;
    double u_y[Z], u_z[Z];
    for (int k = 0; k < Z; k++) {
        u_y[k] = u_0y - ds * d->rivet_z[k], u_z[k] = u_0z + ds * d->rivet_y[k];
        joints->way_y[k] += c * gamma * u_y[k], joints->way_z[k] += c * gamma * u_z[k];
    }
    cage_joint_follow(c * gamma, u_y, u_z, y);
}

// Positions and trial deflections in y follow the corrections delta of the velocities.
static void correct_halves(const Model *model, const Work *w, double gamma, double axial, double shear,
                           const double *delta, double *y, JointStep *joints)
{
    for (int half_0 = Y_CAGE_X; half_0 < Y_RING_X; half_0 += 2) {
        const int half_1 = half_0 + 1;
        const bool along = half_0 == Y_CAGE_X || half_0 == Y_CAGE_BETA || half_0 == Y_CAGE_GAMMA;
        const double weight = 0.5 * gamma * (along ? axial : shear);
        const double share = weight * (delta[VELOCITY + half_1] - delta[VELOCITY + half_0]);
        y[half_0] -= share;
        y[half_1] += share;
    }
    correct_friction(model, w, gamma, delta, shear, y, joints);
}

void two_half_begin(const Model *model, double h, const StepFrom *from, const HalvesMemory *at,
                    const double *middle, double *y, HalvesStep *step, Work *w)
{
    halves_move(model, h, from, middle, y, step, w);
    for (int k = 0; k < LANES; k++)
        step->joints.way_y[k] = h * w->v_jy[k], step->joints.way_z[k] = h * w->v_jz[k];
    memcpy(step->joints.before, &y[Y_JOINT_PLATE_Y], sizeof step->joints.before);
    cage_joint_follow(h, w->v_jy, w->v_jz, y);
    halves_predict(model, from, at->film, y, step);
}

void two_half_end(const Model *model, HalvesStep *step, const StepFrom *from, const HalvesMemory *at,
                  const StepTo *to, HalvesMemory *at_end, Work *w)
{
    const double gamma = step->gamma;
    double change[N_STATES];
    to->f[Y_WORK] += pocket_films_arrive(model, gamma, NULL, &at->pockets, to->y, w, to->f, &at_end->pockets);
    halves_residual(step, from, to);
    const double shear = two_half_shear(model, w, gamma, to->residual);
    memcpy(&to->delta[Y_CAGE_V_X], &to->residual[Y_CAGE_V_X], (Y_RING_V_X - Y_CAGE_V_X) * sizeof *change);
    const double axial = two_half_solve(model, w, gamma, to->delta);
    halves_correct(step, to, change);
    correct_halves(model, w, gamma, axial, shear, change, to->y, &step->joints);
    two_half_slide(model, to->y, &step->joints, w);
    halves_remember(model, w, step, from, change, change, to, at_end->film);
}

void two_half_slide(const Model *model, double *y, JointStep *joints, Work *w)
{
    const JointStiffness k = two_half_stiffness(model->d);
    halves_slide(model, &k, w->cage.two_half.rivet[0], w->cage.two_half.N_plate, y, joints, w);
}
#endif
