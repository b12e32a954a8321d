// Substeps of elastic halves: the multiple time step method (Tuckerman, Berne and Martyna 1992) with the slow
// forces held over the step.  Closed joints vibrate with the halves at up to 80 kHz, and their loads decide the
// rivets' stress.  An evaluation of the joints' loads costs a fifth of an evaluation of all forces.  So a step of
// length h takes n substeps of velocity Verlet, each of length d = h/n,
//
//     v_m = (v + d/2 (a_f + a_s))/(1 + d c/2),  q += d v_m,  v = v_m (1 - d c/2) + d/2 (a_f + a_s)
//
// q: coordinates of the modes and relative rigid motions of the halves;  c: damping of the modes
// a_f: fast accelerations, by the joints and the modes' own springs, evaluated at each substep
// a_s: slow accelerations, by all other forces, at the step's start; the trapezoidal rule of verlet.c corrects them
//      at the step's end
//
// The last substep is like the others, so that the evaluation of the right-hand side has the velocities of the step's end.
// Without its second half, by the joints and springs there, films, oil and friction would feed vibrations: 3 % of the pocket
// forces in flooded pockets.
//
// The joints' motions are integrated with the velocities, in the frame of half 0 as it is in the middle of
// the step, and computed anew from the positions at each evaluation.  The joints do not move the common centre
// of mass of the halves: each half has one half of a relative motion.  Forces in the plane of the split act at the distance c_x from
// the centres of mass and tilt both halves by the same angle; a joint feels the inverse inertia 2/m + 2 c_x^2/J_t there.  With the
// unbalance e the centres of mass lie c = e b_y from the geometric centres, to which the relative motions belong: v_com =
// v + Omega x c, and the moment about the centres of mass is M - c x F.  The slow accelerations are the whole ones less the fast ones;
// so they contain all terms that the relative motions leave out, gyroscopic terms for example.
//
// Films follow in the substeps, those on bent rims (rim_films.c) and stiff ones in pockets (pocket_films.c).
//
// The loads of balls on walls follow in the substeps and move walls, halves and balls, those of balls that arrive within the step too
// (wall_loads.c); the end corrects them.
//
// The joints turn with the cage, by 1.8 degrees in a step at 72,000 r/min: in the frame of the joints the
// relative velocities turn back, and so does the way since the middle of the step; the joints' accelerations
// turn into the frame of the middle.  Both to first order in the angle.
//
// The gyroscopic moment of the halves' relative tilts belongs to the slow accelerations, but follows in the
// substeps too: sampled at the ends of the steps and held, it would feed vibrations that turn by more than a
// little, by 120/s at 12,000 r/min.  It acts on tilt rates by joints and by loads on walls together: where these loads hold what
// joints pull, the gyroscopic moment of one of them alone would feed vibrations too.
//
// The friction states follow the joints' motion and are mapped back onto those that friction bears under the loads at the
// end of each substep (cage_joint_slide), and under those of the evaluation by halves_slide.  The energy that the slip and the modes' damping
// dissipate is summed over the substeps.  docs/method.md has the measured reasons.
#include "cage/elastic/cage_substeps.h"

#include "cage/common/cage_joint.h"
#include "cage/elastic/cage_elastic.h"
#include "cage/elastic/elastic_half.h"
#include "cage/elastic/wall_loads.h"
#include "physics/rotor.h"

static const double MOST_SUBSTEPS = 1000.0;  // an absurd step ends with a refusal, not with years of substeps
static const double ROUNDING = 1e-9;         // part of a substep by which the last one may be longer

// Adds h times the relative motions to rows of both halves, from row `first` on.
static void to_halves(const Model *model, const Rotor *h0, double h, const double relative[RELATIVE_MOTIONS],
                      int first, double *y)
{
    const Derived *d = model->d;
    const double *b_y = h0->b_y, *b_z = h0->b_z, e = d->com_e;
    const double along = relative[MOTION_X] - e * relative[MOTION_ABOUT_Z],
                 across = relative[MOTION_ACROSS_Z] + e * relative[MOTION_SPIN];
    const double across_y = d->relative_part * relative[MOTION_ACROSS_Y],
                 across_z = d->relative_part * across;
    const double about_y = d->relative_tilt * across, about_z = -d->relative_tilt * relative[MOTION_ACROSS_Y];
    const double change[6] = {along,  // x, y, z, beta, gamma, s
                              b_y[1] * across_y + b_z[1] * across_z,
                              b_y[2] * across_y + b_z[2] * across_z,
                              b_y[1] * relative[MOTION_ABOUT_Y] + b_z[1] * relative[MOTION_ABOUT_Z],
                              b_y[2] * relative[MOTION_ABOUT_Y] + b_z[2] * relative[MOTION_ABOUT_Z],
                              relative[MOTION_SPIN]};
    for (int i = 0; i < 6; i++) {
        y[first + 2 * i] -= 0.5 * h * change[i];
        y[first + 2 * i + 1] += 0.5 * h * change[i];
    }
    const int tilts = first + Y_CAGE_BETA - Y_CAGE_X;
    for (int half = 0; half < 2; half++) {
        y[tilts + half] += h * (b_y[1] * about_y + b_z[1] * about_z);
        y[tilts + 2 + half] += h * (b_y[2] * about_y + b_z[2] * about_z);
    }
}

// The relative motions at the joints by rates f of both halves: the inverse of to_halves.
static void between_halves(const Model *model, const Rotor *h0, const double f[CAGE_MOTIONS],
                           double relative[RELATIVE_MOTIONS])
{
    const double *b_y = h0->b_y, *b_z = h0->b_z, c_x = model->d->com_x[1], e = model->d->com_e;
    double d[6];
    for (int i = 0; i < 6; i++) d[i] = f[2 * i + 1] - f[2 * i];
    const double beta = f[6] + f[7], gamma = f[8] + f[9];
    relative[MOTION_ABOUT_Y] = b_y[1] * d[3] + b_y[2] * d[4];
    relative[MOTION_ABOUT_Z] = b_z[1] * d[3] + b_z[2] * d[4];
    relative[MOTION_X] = d[0] + e * relative[MOTION_ABOUT_Z];
    relative[MOTION_ACROSS_Y] = b_y[1] * d[1] + b_y[2] * d[2] - c_x * (b_z[1] * beta + b_z[2] * gamma);
    relative[MOTION_SPIN] = d[5];
    relative[MOTION_ACROSS_Z] =
        b_z[1] * d[1] + b_z[2] * d[2] + c_x * (b_y[1] * beta + b_y[2] * gamma) - e * relative[MOTION_SPIN];
}

// Accelerations of modes and relative motions by the joints' loads and pulls in w and, at the coordinates in
// y, by the modes' springs.
static void fast_accelerations(const Model *model, const double *y, const ElasticJoints *joints,
                               double modes[2 * N_MODES], double rigid[RELATIVE_MOTIONS])
{
    const ElasticHalf *half = model->modes;
    const Derived *d = model->d;
    const double inv_m = 1.0 / model->p->cage.m, inv_R = d->inv_R;
    for (int i = 0; i < N_MODES; i++) {
        modes[i] = -inv_m * joints->pull_S[i] - half->omega_2[i] * y[Y_MODE_S + i];
        modes[N_MODES + i] = inv_m * joints->pull_D[i] - half->omega_2[i] * y[Y_MODE_D + i];
    }

    ball_array force[RELATIVE_MOTIONS];  // on half 1
    for (int k = 0; k < PACKETS * LANE_WIDTH; k += LANE_WIDTH) {
        const wide r_y = wide_load(&d->rivet_y[k]), r_z = wide_load(&d->rivet_z[k]), c = r_y * inv_R,
                   s = r_z * inv_R;
        const wide N = wide_load(&joints->load[0][k]), M_r = wide_load(&joints->load[1][k]),
                   M_t = wide_load(&joints->load[2][k]);
        const wide F_y = wide_load(&joints->F_y[k]), F_z = wide_load(&joints->F_z[k]);
        wide_store(&force[MOTION_X][k], -N);
        wide_store(&force[MOTION_ABOUT_Y][k], s * M_t - c * M_r - r_z * N);
        wide_store(&force[MOTION_ABOUT_Z][k], r_y * N - s * M_r - c * M_t);
        wide_store(&force[MOTION_ACROSS_Y][k], F_y);
        wide_store(&force[MOTION_ACROSS_Z][k], F_z);
        wide_store(&force[MOTION_SPIN][k], r_y * F_z - r_z * F_y);
    }
    double sum[RELATIVE_MOTIONS];
    for (int i = 0; i < RELATIVE_MOTIONS; i++) sum[i] = ball_array_sum(force[i]);
    sum[MOTION_ABOUT_Z] += d->com_e * sum[MOTION_X];
    sum[MOTION_SPIN] -= d->com_e * sum[MOTION_ACROSS_Z];
    for (int i = 0; i < RELATIVE_MOTIONS; i++) rigid[i] = d->relative_inverse[i] * sum[i];
    rigid[MOTION_X] += d->com_e * rigid[MOTION_ABOUT_Z];
    rigid[MOTION_ACROSS_Z] -= d->com_e * rigid[MOTION_SPIN];
}

void cage_substeps_split(const Model *model, const double *y, const Work *w, double *f, FastState *fast)
{
    const ElasticHalf *half = model->modes;
    const ElasticJoints *joints = &w->cage.elastic.joints;
    fast_accelerations(model, y, joints, fast->modes, fast->rigid);
    fast->touch = w->cage.elastic.touch;
    memcpy(fast->e, joints->e, sizeof fast->e);
    memcpy(fast->u_y, joints->u_y, sizeof fast->u_y);
    memcpy(fast->u_z, joints->u_z, sizeof fast->u_z);
    to_halves(model, &w->half[0], -1.0, fast->rigid, Y_CAGE_V_X, f);
    for (int i = 0; i < N_MODES; i++) {
        f[Y_MODE_S_DOT + i] -= fast->modes[i] - half->damping[i] * y[Y_MODE_S_DOT + i];
        f[Y_MODE_D_DOT + i] -= fast->modes[N_MODES + i] - half->damping[i] * y[Y_MODE_D_DOT + i];
    }
    f[Y_WORK] += w->cage.elastic.dissipated;
}

// Velocities of the joints by the rigid motions of the halves: out of the plane (x, about r, about t), across
// it (y, z); those of the halves against each other, as relative motions.
typedef struct {
    ball_array out[3], y, z;
    double relative[RELATIVE_MOTIONS];
} JointVelocities;

// Sets those in the middle of the step, of which w has the kinematics.
static void rigid_velocities(const Model *model, const Work *w, JointVelocities *v)
{
    const Rotor *h0 = &w->half[0], *h1 = &w->half[1];
    const double inv_R = model->d->inv_R;
    double Omega[3];
    for (int i = 0; i < 3; i++) Omega[i] = h1->Omega[i] - h0->Omega[i];
    const double about_y = dot3(h0->b_y, Omega), about_z = dot3(h0->b_z, Omega);
    for (int k = 0; k < PACKETS * LANE_WIDTH; k += LANE_WIDTH) {
        const wide c = wide_load(&model->d->rivet_y[k]) * inv_R, s = wide_load(&model->d->rivet_z[k]) * inv_R;
        wide_store(&v->out[0][k], wide_load(&w->v_jx[k]));
        wide_store(&v->out[1][k], about_y * c + about_z * s);
        wide_store(&v->out[2][k], about_z * c - about_y * s);
        wide_store(&v->y[k], wide_load(&w->v_jy[k]));
        wide_store(&v->z[k], wide_load(&w->v_jz[k]));
    }
    v->relative[MOTION_ABOUT_Y] = about_y, v->relative[MOTION_ABOUT_Z] = about_z;
    v->relative[MOTION_ACROSS_Y] = v->relative[MOTION_ACROSS_Z] = 0.0;
    for (int k = 0; k < Z; k++) {
        v->relative[MOTION_ACROSS_Y] += w->v_jy[k] / Z;
        v->relative[MOTION_ACROSS_Z] += w->v_jz[k] / Z;
    }
}

// The joints turn with half 0, by the angle phi from the middle of the step on.  Turns accelerations in their
// frame into the frame of the middle.
static void turn_out(double phi, double relative[RELATIVE_MOTIONS])
{
    for (int i = MOTION_ABOUT_Y; i <= MOTION_ACROSS_Y; i += 2) {
        const double y = relative[i], z = relative[i + 1];
        relative[i] = y - phi * z;
        relative[i + 1] = z + phi * y;
    }
}

// Adds the apparent velocity in the rotating joint frame, at the time t after the middle of the step: the velocities rotate
// back at the rate s, and so does the way since the middle.  moved: the part of that way by the fast accelerations.
static void to_joint_frame(double s, double t, const JointVelocities *middle,
                           const double slow[RELATIVE_MOTIONS], const double moved[RELATIVE_MOTIONS],
                           double relative[RELATIVE_MOTIONS])
{
    double back[RELATIVE_MOTIONS];
    for (int i = MOTION_ABOUT_Y; i <= MOTION_ACROSS_Z; i++)
        back[i] = moved[i] + t * (2.0 * middle->relative[i] + relative[i] + 0.5 * t * slow[i]);
    for (int i = MOTION_ABOUT_Y; i <= MOTION_ACROSS_Y; i += 2) {
        relative[i] += s * back[i + 1];
        relative[i + 1] -= s * back[i];
    }
}

// Moves the joints for the time h with velocities of the rigid halves, more by `relative`, and of the modes' pads.
static void move_joints(const Model *model, double h, const JointVelocities *v,
                        const double relative[RELATIVE_MOTIONS], ball_array out[3], ball_array in[2],
                        ElasticJoints *joints)
{
    const double inv_R = model->d->inv_R;
    for (int k = 0; k < PACKETS * LANE_WIDTH; k += LANE_WIDTH) {
        const wide r_y = wide_load(&model->d->rivet_y[k]), r_z = wide_load(&model->d->rivet_z[k]);
        const wide c = r_y * inv_R, s = r_z * inv_R, r = wide_load(&in[0][k]), t = wide_load(&in[1][k]);
        const wide e_dot[3] = {
            wide_load(&v->out[0][k]) +
                (relative[MOTION_X] + (r_z * relative[MOTION_ABOUT_Y] - r_y * relative[MOTION_ABOUT_Z])),
            wide_load(&v->out[1][k]) + (c * relative[MOTION_ABOUT_Y] + s * relative[MOTION_ABOUT_Z]),
            wide_load(&v->out[2][k]) + (c * relative[MOTION_ABOUT_Z] - s * relative[MOTION_ABOUT_Y])};
        for (int i = 0; i < 3; i++)
            wide_store(&joints->e[i][k],
                       wide_load(&joints->e[i][k]) + (0.5 * h) * (e_dot[i] + wide_load(&out[i][k])));
        const wide v_y =
            wide_load(&v->y[k]) + (relative[MOTION_ACROSS_Y] - r_z * relative[MOTION_SPIN]) + (c * r - s * t);
        const wide v_z =
            wide_load(&v->z[k]) + (relative[MOTION_ACROSS_Z] + r_y * relative[MOTION_SPIN]) + (s * r + c * t);
        wide_store(&joints->v_y[k], v_y);
        wide_store(&joints->v_z[k], v_z);
        wide_store(&joints->u_y[k], wide_load(&joints->u_y[k]) + h * v_y);
        wide_store(&joints->u_z[k], wide_load(&joints->u_z[k]) + h * v_z);
    }
}

// Moves the modes by the first half of a substep and the drift: from velocities v to v_m and, after the damping, to v.  damping: over half
// a substep, before its middle and after it.
static void move_modes(double damping[2][N_MODES], double h, const double *fast, const double *slow,
                       double *q, double *v, double *v_m)
{
    for (int first = 0; first < 2 * N_MODES; first += N_MODES)
        for (int i = 0; i < N_MODES; i++) {
            const int k = first + i;
            v_m[k] = (v[k] + 0.5 * h * (fast[k] + slow[k])) * damping[0][i];
            q[k] += h * v_m[k];
            v[k] = v_m[k] * damping[1][i];
        }
}

// Power that the modes' damping takes at the velocities v.
static double modes_lose(const Model *model, const double *v)
{
    const double *c = model->modes->damping, *v_S = v, *v_D = v + N_MODES;
    double part[8] = {0.0};
    for (int i = 0; i < N_MODES; i += 8)
        for (int k = 0; k < 8; k++) part[k] += c[i + k] * (v_S[i + k] * v_S[i + k] + v_D[i + k] * v_D[i + k]);
    return model->p->cage.m *
           (((part[0] + part[1]) + (part[2] + part[3])) + ((part[4] + part[5]) + (part[6] + part[7])));
}

// Turns the relative tilt rates, of which `rates` is the part by the joints and `others` the rest, by the angle of their gyroscopic
// moment, tan of half of which is t: no power.  The joints' part gets the change.
static void turn(double t, const double others[RELATIVE_MOTIONS], double rates[RELATIVE_MOTIONS])
{
    const double y = rates[MOTION_ABOUT_Y] + others[MOTION_ABOUT_Y],
                 z = rates[MOTION_ABOUT_Z] + others[MOTION_ABOUT_Z], part = 2.0 * t / (1.0 + t * t);
    rates[MOTION_ABOUT_Y] -= part * (t * y + z);
    rates[MOTION_ABOUT_Z] -= part * (t * z - y);
}

// Films of bent rims at the time t of the step, where the joints have changed the relative velocities by `speed`.
static void films_follow(const Model *model, double t, const double speed[RELATIVE_MOTIONS],
                         const double pushed[CAGE_MOTIONS], RimFilmsStep *films, double *v, const Work *w)
{
    double halves[2 * RELATIVE_MOTIONS] = {0.0};
    to_halves(model, &w->half[0], 1.0, speed, 0, halves);
    for (int i = 0; i < CAGE_MOTIONS; i++) halves[i] += pushed[i];
    rim_films_follow(model, w, t, halves, v, films);
}

void cage_substeps_advance(const Model *model, double h, const FastState *fast, const double *f,
                           const double *state, double *y, Foreseen *foreseen, JointStep *slip,
                           RimFilmsStep *films, PocketFilmsStep *pockets, const Work *w)
{
    const ElasticHalf *half = model->modes;
    const int steps = (int)fmin(ceil(h / half->substep * (1.0 - ROUNDING)), MOST_SUBSTEPS);
    const double sub = h / steps;
    double *q = &y[Y_MODE_S], *v = &y[Y_MODE_S_DOT];
    double modes[2 * N_MODES], v_m[2 * N_MODES], rigid[RELATIVE_MOTIONS], slow[RELATIVE_MOTIONS];
    double speed[RELATIVE_MOTIONS] = {0.0}, moved[RELATIVE_MOTIONS] = {0.0};  // by the fast accelerations
    double push[CAGE_MOTIONS] = {0.0}, pushed[CAGE_MOTIONS] = {0.0},
           way[CAGE_MOTIONS] = {0.0};  // by changes of the loads on walls
    JointVelocities middle;
    ball_array P;
    const double gyro = model->d->J_p / model->d->J_t * 0.5 * (w->half[0].s + w->half[1].s);
    WallLoads loads;
    double damping[2][N_MODES];

    // the joints at the step's start
    ElasticJoints joints;
    const JointStiffness k_in = cage_elastic_stiffness(model);
    memcpy(joints.e, fast->e, sizeof fast->e);
    memcpy(joints.u_y, fast->u_y, sizeof fast->u_y);
    memcpy(joints.u_z, fast->u_z, sizeof fast->u_z);
    memset(joints.pull_S, 0, sizeof joints.pull_S);  // coordinates beyond the half's modes are not written
    memset(joints.pull_D, 0, sizeof joints.pull_D);
    memcpy(modes, fast->modes, sizeof modes);
    memcpy(rigid, fast->rigid, sizeof rigid);
    const double s = w->half[0].s;
    turn_out(-0.5 * s * h, rigid);
    cage_elastic_preload(model, fast->omega_2, P);
    rigid_velocities(model, w, &middle);
    between_halves(model, &w->half[0], &f[Y_CAGE_V_X], slow);
    for (int i = 0; i < N_MODES; i++) {
        const double damped = 0.5 * sub * half->damping[i];
        damping[0][i] = 1.0 / (1.0 + damped), damping[1][i] = 1.0 - damped;
    }
    wall_loads_find(model, h, fast, f, state, y, w, &loads);
    memcpy(foreseen->modes, &f[Y_MODE_S_DOT], sizeof modes);
    if (films) rim_films_first(model, w, sub, f, v, films);

    double by_loads[RELATIVE_MOTIONS] = {0.0};
    turn(0.25 * gyro * sub, by_loads, speed);
    for (int step = 1; step <= steps; step++) {
        // first half of the accelerations, drift
        double relative[RELATIVE_MOTIONS];
        if (films) rim_push(model, 0.5 * sub, films->now, v);  // of the substep before
        move_modes(damping, sub, modes, foreseen->modes, q, v, v_m);
        for (int i = 0; i < RELATIVE_MOTIONS; i++) speed[i] += 0.5 * sub * rigid[i];
        if (loads.count + pockets->count > 0) {
            for (int i = 0; i < CAGE_MOTIONS; i++) {
                pushed[i] += 0.5 * sub * push[i];
                way[i] += sub * pushed[i];
            }
            between_halves(model, &w->half[0], pushed, by_loads);
        }
        ball_motions_push(0.5 * sub, &loads.balls);
        ball_motions_move(sub, &loads.balls);
        const double time = (step - 0.5) * sub - 0.5 * h;  // after the middle
        double halfway[RELATIVE_MOTIONS];
        for (int i = 0; i < RELATIVE_MOTIONS; i++) {
            halfway[i] = moved[i] + 0.5 * sub * speed[i];
            moved[i] += sub * speed[i];
        }
        for (int i = 0; i < RELATIVE_MOTIONS; i++) relative[i] = by_loads[i] + (speed[i] + time * slow[i]);
        to_joint_frame(s, time, &middle, slow, halfway, relative);
        ball_array out[3], in[2];
        cage_elastic_out(half, v_m, out);
        cage_elastic_in(half, v_m + N_MODES, in);
        move_joints(model, sub, &middle, relative, out, in, &joints);
        memcpy(slip->before, &y[Y_JOINT_PLATE_Y], sizeof slip->before);
        cage_joint_follow(sub, joints.v_y, joints.v_z, y);
        y[Y_WORK] -= sub * modes_lose(model, v_m);
        memcpy(foreseen->modes, &f[Y_MODE_S_DOT], sizeof modes);
        if (loads.count > 0) {
            double halves[CAGE_MOTIONS];
            memcpy(halves, way, sizeof way);
            to_halves(model, &w->half[0], 1.0, moved, 0, halves);
            wall_loads_follow(model, step * sub, sub, q, halves, &loads, foreseen->modes, push);
        }

        // accelerations there, of which the second half
        cage_elastic_loads(model, P, &joints);
        y[Y_WORK] -= cage_joint_slide(model, &k_in, joints.rivet[0], joints.N_plate, y, slip);
        cage_joint_shear(model, y, &k_in, joints.u_y, joints.u_z, joints.F_y, joints.F_z);
        cage_elastic_pull(model, &joints);
        fast_accelerations(model, y, &joints, modes, rigid);
        turn_out(s * (step * sub - 0.5 * h), rigid);
        for (int i = 0; i < 2 * N_MODES; i++) v[i] += 0.5 * sub * (modes[i] + foreseen->modes[i]);
        for (int i = 0; i < RELATIVE_MOTIONS; i++) speed[i] += 0.5 * sub * rigid[i];
        for (int i = 0; i < CAGE_MOTIONS; i++) pushed[i] += 0.5 * sub * push[i];
        ball_motions_push(0.5 * sub, &loads.balls);
        if (loads.count + pockets->count > 0) between_halves(model, &w->half[0], pushed, by_loads);
        turn((step < steps ? 0.5 : 0.25) * gyro * sub, by_loads, speed);
        if (films) films_follow(model, step * sub, speed, pushed, films, v, w);
        if (pockets->count > 0) {
            double halves[CAGE_MOTIONS];
            memcpy(halves, pushed, sizeof pushed);
            to_halves(model, &w->half[0], 1.0, speed, 0, halves);
            pocket_films_follow(model, step * sub, sub, v, halves, pushed, pockets);
        }
    }
    if (loads.count > 0) {
        double moving[CAGE_MOTIONS];
        memcpy(moving, pushed, sizeof pushed);
        to_halves(model, &w->half[0], 1.0, speed, 0, moving);
        memcpy(foreseen->modes, &f[Y_MODE_S_DOT], sizeof modes);
        wall_loads_end(model, v, moving, &loads, foreseen->modes, push);
    }
    pocket_films_foreseen(model, pockets, foreseen->modes, push);
    memcpy(slip->before, &y[Y_JOINT_PLATE_Y], sizeof slip->before);
    for (int k = 0; k < LANES; k++) {
        slip->way_y[k] = joints.u_y[k] - fast->u_y[k];
        slip->way_z[k] = joints.u_z[k] - fast->u_z[k];
    }
    double rates[RELATIVE_MOTIONS];
    between_halves(model, &w->half[0], pushed, rates);
    for (int i = MOTION_ABOUT_Y; i <= MOTION_ABOUT_Z; i++) rates[i] += speed[i];
    const double moment[RELATIVE_MOTIONS] = {[MOTION_ABOUT_Y] = -gyro * rates[MOTION_ABOUT_Z],
                                             [MOTION_ABOUT_Z] = gyro * rates[MOTION_ABOUT_Y]};
    memcpy(foreseen->halves, push, sizeof push);
    to_halves(model, &w->half[0], 1.0, moment, 0, foreseen->halves);
    ball_motions_arrive(&loads.balls, h, y, foreseen->balls);
    to_halves(model, &w->half[0], 1.0, moved, Y_CAGE_X, y);
    to_halves(model, &w->half[0], 1.0, speed, Y_CAGE_V_X, y);
    for (int i = 0; i < CAGE_MOTIONS; i++) {
        y[Y_CAGE_X + i] += way[i];
        y[Y_CAGE_V_X + i] += pushed[i];
    }
}
