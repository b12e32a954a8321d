// Loads of balls on the walls of elastic halves within a step: a part of the slow forces that follows in the substeps.
//
// A ball that meets a wall moves it in 10 us, the length of a step.  A load held over the step would answer to the wall's
// motion a step late, which is unstable where the contact is stiffer than the wall, and a ball that arrives within the
// step would find a wall that knows nothing of it.  So the approach of ball and wall follows,
//
//     x(t) = x_0 + r t + b t (t - h)/2 - u(t) - g.d(t)   r, b: rate in the middle of the step and acceleration of the rigid
//                                                        approach by slow forces; u, g.d: motion of the wall by the modes and by
//                                                        the motions d of the halves, which joints and these loads cause
//     delta + c Q = x,   Q = w K delta^1.5               c: compliance of the wall beside its modes; K: Hertz's; w: the half's share,
//                                                        which goes to 1/2 as the patch grows over the seam (pocket.h); 1 of a ribbon
//
// and wall, ball and halves feel (1 + lambda x_dot) Q.  The bodies of halves and balls feel the change of the loads since the start too, the
// balls as if free.  So after the step x is where the evaluation finds it.  Where a body does not feel it, its answer comes a step
// late and feeds vibrations: a ball of the mass m_b on a contact of the stiffness k adds k^2/(m_b omega^2) of stiffness to a
// vibration of the frequency omega, which is constant over a step, and a stiffness epsilon omega^2 held over h and corrected at the end
// feeds the amplitude, turning by theta = omega h, in each step by
//
//     epsilon/2 (1 - cos theta - theta/2 sin theta)       largest near 3/2 pi: 1.7 epsilon
//
// Balls that answered late made the 99.9 % pocket force of a quiet bearing 25 % too large in steps of eight substeps.
// Damping lambda Q, 250 N s/m at 250 N, is as strong as the contact is stiff: held over the step it drives vibrations that turn by more
// than pi/2 in it; by the bodies' velocities alone, of which the modes take 3000 m/s2 back, it made the loads 1 to 2 % too small between the
// ends of a step.  So x_dot follows, from the ways in this substep and in the one before, half a substep ahead of the mean speed; what
// a load changes of it by itself follows too, with the mobility Y of the contact: Q = Q_0 (1 + lambda (x_dot - Y d/2 (Q - Q_before))).
// At the end the loads are those at the predicted velocities, as the evaluation has them.  x_0 < 0 before a contact.  Direction and place
// stay.  The step's end corrects loads and damping by the trapezoidal rule (verlet.c).
#include "cage/elastic/wall_loads.h"

#include "cage/common/pocket.h"
#include "cage/elastic/elastic_half.h"
#include "physics/hertz.h"

// Motions of the walls at the coordinates q of S and D.
static void wall_motions(const WallLoads *loads, const double *q, wall_load_array motion)
{
    mode_array half[2];
    if (loads->count == 0) return;
    for (int m = 0; m < N_MODES; m += LANE_WIDTH) {
        const wide S = wide_load(&q[m]), D = wide_load(&q[N_MODES + m]);
        wide_store(&half[0][m], S - D);
        wide_store(&half[1][m], S + D);
    }
    for (int i = 0; i < loads->count; i++) motion[i] = elastic_sum(loads->shape[i], half[i >= loads->of_0]);
}

// Adds the forces on the walls to those on S and D.
static void add_forces(const WallLoads *loads, const wall_load_array force, double *S, double *D)
{
    mode_array half[2];
    if (loads->count == 0) return;
    memset(half, 0, sizeof half);
    for (int i = 0; i < loads->count; i++) {
        double *to = half[i >= loads->of_0];
        for (int m = 0; m < N_MODES; m += LANE_WIDTH)
            wide_store(&to[m],
                       wide_fma(wide_set(force[i]), wide_load(&loads->shape[i][m]), wide_load(&to[m])));
    }
    for (int m = 0; m < N_MODES; m += LANE_WIDTH) {
        const wide of_0 = wide_load(&half[0][m]), of_1 = wide_load(&half[1][m]);
        wide_store(&S[m], wide_load(&S[m]) + (of_1 + of_0));
        wide_store(&D[m], wide_load(&D[m]) + (of_1 - of_0));
    }
}

// The motion along the normal by each mode of the wall that ball k presses: that of the evaluation at this place, or found again.
static void find_shape(const Model *model, const FastState *fast, const Work *w, int h, int k,
                       mode_array shape)
{
    const int side = 2 * h - 1, j = k / LANE_WIDTH * LANE_WIDTH;
    const WallTouch *touch = &fast->touch;
    const double place[7] = {touch->x[h][k],      touch->r[h][k],     touch->t[h][k],  touch->chi[h][k],
                             touch->radius[h][k], touch->front[h][k], model->p->cage.m};
    const PressedWall *known = &w->cage.elastic.pressed[h][k];
    if (memcmp(place, known->place, sizeof place) == 0) {
        memcpy(shape, known->shape, sizeof known->shape);
        return;
    }
    if (model->d->spheres.on) {
        RibbonNodes nodes;
        ribbon_wall_nodes(model->modes, wide_set(place[3]), wide_set(place[4]), wide_set(place[5]), &nodes);
        ribbon_wall_shape(model->modes, side, k, &nodes, 0, place, shape);
    } else {
        WallPlaces places;
        elastic_wall_places(model->modes, side, j, wide_load(&touch->x[h][j]), wide_load(&touch->t[h][j]),
                            &places);
        elastic_wall_shape(model->modes, side, k, &places, shape);
    }
}

static const double LEAST_DAMPING = 1e-6;  // from which a speed follows [s/m]

// Adds the contact of a ball with a half, if there is one in the step; its shape is not known yet.
static bool add_load(double lambda, double h, const FastState *fast, int half, int j, int lane, double Q_0,
                     const RigidApproach *approach, WallLoads *loads)
{
    const int k = j + lane;
    const double rate = approach->rate[lane], delta = fast->touch.delta[half][k];
    if (!(Q_0 > 0.0) && !(delta + h * rate > 0.0)) return false;
    const int i = loads->count++;
    const double Q = fast->touch.Q[half][k], acceleration = approach->acceleration[lane];
    loads->K[i] = fast->touch.K[half][k], loads->Q[i] = Q, loads->x[i] = delta + loads->c * Q_0;
    loads->towards[i] = (2 * half - 1) * fast->touch.x[half][k];
    loads->more[i] = loads->moved[i] = 0.0;
    loads->rate[i] = rate, loads->acceleration[i] = acceleration, loads->ball[i] = k;
    loads->speed[i] =
        Q_0 > 0.0 ? (Q / Q_0 - 1.0) / fmax(lambda, LEAST_DAMPING) : rate - loads->middle * acceleration;
    for (int m = 0; m < 3; m++) loads->normal[m][i] = approach->direction[m][lane];
    for (int m = 0; m < RELATIVE_MOTIONS; m++) {
        loads->along[2 * m + half][i] = approach->along[m][lane];
        loads->along[2 * m + 1 - half][i] = 0.0;
    }
    return true;
}

// Load of a half by the approach delta.
INLINE wide share_load(const Model *model, wide K, wide towards, wide delta)
{
    const wide alone = K * delta * wide_sqrt(delta);
    return model->d->spheres.on ? alone : pocket_share(model->d, 1, towards, delta).load * alone;
}

void wall_loads_find(const Model *model, double h, const FastState *fast, const double *f,
                     const double *state, const double *y, const Work *w, WallLoads *loads)
{
    const double inv_root = 1.0 / 1.4142135623730951, bodies = 1.0 / model->d->m + 1.0 / model->p->cage.m;
    loads->count = 0, loads->first = true;
    memset(&loads->balls, 0, sizeof loads->balls);
    loads->middle = 0.5 * h, loads->c = model->modes->compliance;
    for (int half = 0; half < 2; half++) {
        loads->of_0 = loads->count;
        for (int j = 0; j < PACKETS * LANE_WIDTH; j += LANE_WIDTH) {
            const int mask = wide_mask(wide_above(wide_load(&fast->touch.K[half][j]), 0.0));
            RigidApproach approach;
            if (mask == 0) continue;
            const double *const n[3] = {fast->touch.x[half], fast->touch.r[half], fast->touch.t[half]};
            rigid_approach(model, loads->middle, n, f, state, y, w, half, j, &approach);
            const wide towards = (2.0 * half - 1.0) * wide_load(&fast->touch.x[half][j]);
            double Q_0[LANE_WIDTH];
            wide_store(Q_0, share_load(model, wide_load(&fast->touch.K[half][j]), towards,
                                       wide_max(wide_load(&fast->touch.delta[half][j]), wide_set(0.0))));
            for (int i = 0; i < LANE_WIDTH && j + i < Z; i++) {
                if (!(mask >> i & 1) ||
                    !add_load(model->p->cage.lambda, h, fast, half, j, i, Q_0[i], &approach, loads))
                    continue;
                const int last = loads->count - 1;
                double *shape = loads->shape[last];
                find_shape(model, fast, w, half, j + i, shape);
                for (int m = 0; m < N_MODES; m++) shape[m] *= inv_root;
                loads->mobility[last] = bodies + 2.0 / model->p->cage.m * elastic_sum(shape, shape);
            }
        }
    }
    wall_motions(loads, &y[Y_MODE_S], loads->from);
    for (int i = loads->count; i % LANE_WIDTH != 0; i++) {  // nothing
        loads->K[i] = loads->x[i] = loads->Q[i] = loads->more[i] = loads->mobility[i] = 0.0;
        loads->moved[i] = loads->speed[i] = loads->towards[i] = 0.0;
        loads->rate[i] = loads->acceleration[i] = loads->from[i] = 0.0;
        for (int m = 0; m < CAGE_MOTIONS; m++) loads->along[m][i] = 0.0;
    }
}

// w K delta^1.5 of a packet of approaches x: delta by Newton's method, from x/(1 + c K x^0.5).  Within 0.1 % for c K x^0.5 < 5, 3 % at 50.
INLINE wide loads_at(const Model *model, const WallLoads *loads, int i, wide x)
{
    const wide zero = wide_set(0.0), least = wide_set(1e-30), K = wide_load(&loads->K[i]);
    const wide towards = wide_load(&loads->towards[i]);
    if (!wide_any(wide_above(x, 0.0))) return zero;
    const wide from = wide_max(x, zero);
    wide delta = from / (1.0 + loads->c * K * wide_sqrt(from));
    for (int n = 0; n < 2; n++) {
        const wide load = loads->c * share_load(model, K, towards, delta);
        delta = wide_max(delta - (delta + load - from) / (1.0 + 1.5 * load / wide_max(delta, least)), zero);
    }
    return share_load(model, K, towards, delta);
}

// Motions of the balls along the normals.
static void along_normals(const WallLoads *loads, double motion[3][LANES], wall_load_array to)
{
    for (int i = 0; i < loads->count; i++) {
        const int k = loads->ball[i];
        to[i] = loads->normal[0][i] * motion[0][k] + loads->normal[1][i] * motion[1][k] +
                loads->normal[2][i] * motion[2][k];
    }
    for (int i = loads->count; i % LANE_WIDTH != 0; i++) to[i] = 0.0;
}

// Less the motion by those of the halves.
INLINE wide less_halves(const WallLoads *loads, int i, const double motion[CAGE_MOTIONS], wide of_ball)
{
    for (int m = 0; m < CAGE_MOTIONS; m++)
        of_ball = wide_fma(wide_load(&loads->along[m][i]), wide_set(-motion[m]), of_ball);
    return of_ball;
}

// Adds the accelerations by the changes of the loads to those of the modes, and writes those of halves and balls.
static void push_bodies(const Model *model, WallLoads *loads, double slow[2 * N_MODES],
                        double push[CAGE_MOTIONS])
{
    wall_load_array force;
    memset(loads->balls.push, 0, sizeof loads->balls.push);
    memset(push, 0, CAGE_MOTIONS * sizeof *push);
    bool changed = false;
    for (int i = 0; i < loads->count; i++) changed |= loads->more[i] != 0.0;
    if (!changed) return;
    for (int m = 0; m < CAGE_MOTIONS; m++) {
        double sum = 0.0;
        for (int i = 0; i < loads->count; i++) sum += loads->more[i] * loads->along[m][i];
        push[m] = sum / model->d->inertia[Y_CAGE_V_X + m];
    }
    for (int i = 0; i < loads->count; i++)
        for (int m = 0; m < 3; m++)
            loads->balls.push[m][loads->ball[i]] -= loads->more[i] * loads->normal[m][i] / model->d->m;
    for (int i = 0; i < loads->count; i++) force[i] = loads->more[i] / model->p->cage.m;
    add_forces(loads, force, slow, &slow[N_MODES]);
}

void wall_loads_follow(const Model *model, double t, double sub, const double *q,
                       const double moved[CAGE_MOTIONS], WallLoads *loads, double slow[2 * N_MODES],
                       double push[CAGE_MOTIONS])
{
    const double bend = t * (0.5 * t - loads->middle), part = loads->first ? 1.0 : 0.5, inv_sub = 1.0 / sub;
    const wide lambda = wide_set(model->p->cage.lambda), zero = wide_set(0.0);
    wall_load_array by_modes, by_ball;
    memset(by_modes, 0, sizeof by_modes);
    wall_motions(loads, q, by_modes);
    along_normals(loads, loads->balls.way, by_ball);
    for (int i = 0; i < loads->count; i += LANE_WIDTH) {
        const wide way =
            wide_fma(wide_load(&loads->rate[i]), wide_set(t), bend * wide_load(&loads->acceleration[i]));
        const wide bodies = less_halves(loads, i, moved, wide_load(&by_ball[i]));
        const wide moves = way + bodies - (wide_load(&by_modes[i]) - wide_load(&loads->from[i]));
        const wide Q_0 = loads_at(model, loads, i, wide_load(&loads->x[i]) + moves);

        const wide mean = (moves - wide_load(&loads->moved[i])) * inv_sub;
        const wide speed = mean + part * (mean - wide_load(&loads->speed[i]));
        const wide own = (0.5 * sub) * wide_load(&loads->mobility[i]), c = lambda * Q_0;
        const wide start = wide_load(&loads->Q[i]), before = start + wide_load(&loads->more[i]);
        const wide Q = wide_max((Q_0 + c * (speed + own * before)) / (1.0 + c * own), zero);
        wide_store(&loads->elastic[i], Q_0);
        wide_store(&loads->moved[i], moves);
        wide_store(&loads->speed[i], mean);
        wide_store(&loads->more[i], Q - start);
    }
    loads->first = false;
    push_bodies(model, loads, slow, push);
}

void wall_loads_end(const Model *model, const double *q_dot, const double moving[CAGE_MOTIONS],
                    WallLoads *loads, double slow[2 * N_MODES], double push[CAGE_MOTIONS])
{
    const wide lambda = wide_set(model->p->cage.lambda);
    wall_load_array by_modes, by_ball;
    memset(by_modes, 0, sizeof by_modes);
    wall_motions(loads, q_dot, by_modes);
    along_normals(loads, loads->balls.speed, by_ball);
    for (int i = 0; i < loads->count; i += LANE_WIDTH) {
        const wide bodies =
            less_halves(loads, i, moving, wide_load(&by_ball[i])) +
            wide_fma(wide_set(loads->middle), wide_load(&loads->acceleration[i]), wide_load(&loads->rate[i]));
        const wide Q = hertz_damped(wide_load(&loads->elastic[i]), lambda, bodies - wide_load(&by_modes[i]));
        wide_store(&loads->more[i], Q - wide_load(&loads->Q[i]));
    }
    push_bodies(model, loads, slow, push);
}

void ball_motions_arrive(const BallMotions *balls, double h, double *y, double foreseen[BALL_MOTIONS])
{
    static const int PLACE[3] = {Y_BALL_X, Y_BALL_R, Y_BALL_THETA};
    static const int RATE[3] = {Y_BALL_V_X, Y_BALL_V_R, Y_BALL_OMEGA_M};
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < Z; k++) {
            const double part = i == 2 ? 1.0 / y[Y_BALL_R + k] : 1.0;  // along the orbit angles
            y[PLACE[i] + k] += part * balls->way[i][k];
            y[RATE[i] + k] += part * (balls->speed[i][k] - 0.5 * h * balls->push[i][k]);
            foreseen[i * Z + k] = part * balls->push[i][k];
        }
}
