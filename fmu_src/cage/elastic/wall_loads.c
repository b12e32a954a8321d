// Loads of balls on the walls of elastic halves within a step: a part of the slow forces that follows in the substeps.
//
// A ball that meets a wall moves it in 10 us, the length of a step.  A load held over the step would answer to the wall's
// motion a step late, which is unstable where the contact is stiffer than the wall, and a ball that arrives within the
// step would find a wall that knows nothing of it.  So the approach of ball and wall follows,
//
//     x(t) = x_0 + r t + b t (t - h)/2 - u(t)          r, b: rate in the middle of the step and acceleration of the rigid
//                                                      approach, u: what the modes have moved the wall since the start
//     delta + c Q = x,   Q = K delta^1.5               c: compliance of the wall beside its modes; K: Hertz's, by the half's share
//
// and the modes feel (1 + lambda delta_dot) Q, the damping that of the start.  The rigid bodies move here as velocity
// Verlet moves them: after the step x is where the evaluation finds it.  x_0 < 0 before a contact.  Direction and
// place stay.  The step's end corrects loads and damping by the trapezoidal rule (verlet.c).
#include "cage/elastic/wall_loads.h"

#include "cage/elastic/elastic_half.h"
#include "numbers/elementary.h"
#include "physics/rotor.h"

// Motion of the wall at the coordinates q of S and D.
static double wall_motion(const WallLoad *load, const double *q)
{
    double part[8] = {0.0};
    for (int i = 0; i < N_MODES; i += 8)
        for (int k = 0; k < 8; k++)
            part[k] += load->shape[i + k] * (q[i + k] + load->side * q[N_MODES + i + k]);
    return ((part[0] + part[1]) + (part[2] + part[3])) + ((part[4] + part[5]) + (part[6] + part[7]));
}

// Sets rate and acceleration of ball k against half h along the contact's normal, both as rigid bodies.
static void rigid_approach(const Model *model, double gamma, const FastState *fast, const double *f,
                           const double *state, const double *y, const Work *w, int h, int k, WallLoad *load)
{
    const Rotor *half = &w->half[h];
    const double cos_phi = model->d->pocket_cos[k], sin_phi = model->d->pocket_sin[k];
    const double v_x = state[Y_BALL_V_X + k], v_r = state[Y_BALL_V_R + k], omega = state[Y_BALL_OMEGA_M + k];
    const double r = y[Y_BALL_R + k] - gamma * v_r, theta = y[Y_BALL_THETA + k] - gamma * omega;
    const double e_r[3] = {0.0, portable_cos(theta), portable_sin(theta)}, e_t[3] = {0.0, -e_r[2], e_r[1]};
    const double a_r = f[Y_BALL_V_R + k] - r * omega * omega,
                 a_t = r * f[Y_BALL_OMEGA_M + k] + 2.0 * v_r * omega;
    const double turn[3] = {f[Y_CAGE_S + h], f[Y_CAGE_BETA_DOT + h], f[Y_CAGE_GAMMA_DOT + h]};

    // n, and the ball's centre from the half's geometric centre and from its centre of mass
    double n[3], p[3], from_mass[3], carried[3], by_mass[3], turned[3], inward[3];
    for (int i = 0; i < 3; i++) {
        n[i] = fast->touch_x[h][k] * half->a[i] +
               fast->touch_r[h][k] * (cos_phi * half->b_y[i] + sin_phi * half->b_z[i]) +
               fast->touch_t[h][k] * (cos_phi * half->b_z[i] - sin_phi * half->b_y[i]);
        p[i] = (i == 0 ? y[Y_BALL_X + k] - gamma * v_x : r * e_r[i]) - half->x[i];
        from_mass[i] = p[i] - half->c[i];
    }
    cross3(half->Omega, p, carried);
    cross3(half->Omega, from_mass, by_mass);
    cross3(half->Omega, by_mass, inward);
    cross3(turn, from_mass, turned);
    load->rate = load->acceleration = 0.0;
    for (int i = 0; i < 3; i++) {
        const double v = i == 0 ? v_x : v_r * e_r[i] + r * omega * e_t[i];
        const double a = i == 0 ? f[Y_BALL_V_X + k] : a_r * e_r[i] + a_t * e_t[i];
        load->rate += n[i] * (v - half->v[i] - carried[i]);
        load->acceleration += n[i] * (a - f[Y_CAGE_V_X + 2 * i + h] - turned[i] - inward[i]);
    }
}

// The motion along the normal by each mode of the wall that ball k presses, on a half of a ribbon: that of the evaluation at this place,
// or found again.
static void ribbon_shape(const Model *model, const FastState *fast, const Work *w, int h, int k,
                         mode_array shape)
{
    const double place[6] = {fast->touch_x[h][k],   fast->touch_r[h][k],      fast->touch_t[h][k],
                             fast->touch_chi[h][k], fast->touch_radius[h][k], model->p->cage.m};
    const PressedWall *known = &w->elastic.pressed[h][k];
    if (memcmp(place, known->place, sizeof place) == 0) {
        memcpy(shape, known->shape, sizeof known->shape);
        return;
    }
    RibbonNodes nodes;
    ribbon_wall_nodes(model->modes, wide_set(fabs(place[3])), wide_set(place[4]), &nodes);
    ribbon_wall_shape(model->modes, 2 * h - 1, k, place[3] < 0.0, &nodes, 0, place, shape);
}

// Sets law and start of a contact; returns whether there is one in the step.
static bool find_law(const Model *model, double h, const FastState *fast, int half, int k, WallLoad *load)
{
    const double delta = fast->touch_delta[half][k], K = fast->touch_K[half][k];
    load->K = K, load->c = model->modes->compliance;
    load->side = 2 * half - 1;
    load->Q = fast->touch_Q[half][k];
    if (delta > 0.0) {
        const double Q = K * delta * sqrt(delta);
        load->x = delta + load->c * Q;
        load->damped = load->Q / Q;
        return true;
    }
    load->x = delta;
    load->damped = fmax(1.0 + model->p->cage.lambda * load->rate, 0.0);
    return delta + h * load->rate > 0.0;
}

void wall_loads_find(const Model *model, double h, const FastState *fast, const double *f,
                     const double *state, const double *y, const Work *w, WallLoads *loads)
{
    const double inv_root = 1.0 / 1.4142135623730951;
    const bool ribbon = model->d->spheres.on;
    loads->count = 0;
    loads->middle = 0.5 * h;
    for (int half = 0; half < 2; half++)
        for (int j = 0; j < PACKETS * LANE_WIDTH; j += LANE_WIDTH) {
            const int mask = wide_mask(wide_above(wide_load(&fast->touch_K[half][j]), 0.0));
            WallPlaces places;
            bool placed = false;
            for (int k = j; mask >> (k - j) != 0 && k < Z; k++) {
                if (!(mask >> (k - j) & 1)) continue;
                WallLoad *load = &loads->of[loads->count];
                rigid_approach(model, loads->middle, fast, f, state, y, w, half, k, load);
                if (!find_law(model, h, fast, half, k, load)) continue;
                if (!ribbon && !placed)
                    elastic_wall_places(model->modes, 2 * half - 1, j, wide_load(&fast->touch_x[half][j]),
                                        wide_load(&fast->touch_t[half][j]), &places);
                placed = true;
                if (ribbon)
                    ribbon_shape(model, fast, w, half, k, load->shape);
                else
                    elastic_wall_shape(model->modes, 2 * half - 1, k, &places, load->shape);
                for (int i = 0; i < N_MODES; i++) load->shape[i] *= inv_root;
                load->from = wall_motion(load, &y[Y_MODE_S]);
                loads->count++;
            }
        }
}

// Q of the approach x: delta by Newton's method.  The wall's own compliance takes little.
static double load_at(const WallLoad *load, double x)
{
    const double cK = load->c * load->K;
    double delta = x;
    if (!(x > 0.0)) return 0.0;
    for (int i = 0; i < 2; i++) {
        const double root = sqrt(delta);
        delta = fmax(delta - (delta + cK * delta * root - x) / (1.0 + 1.5 * cK * root), 0.0);
    }
    return load->K * delta * sqrt(delta);
}

void wall_loads_follow(const Model *model, double t, const double *q, const WallLoads *loads,
                       double slow[2 * N_MODES])
{
    const double inv_m = 1.0 / model->p->cage.m, bend = t * (0.5 * t - loads->middle);
    for (const WallLoad *load = loads->of; load < loads->of + loads->count; load++) {
        const double u = wall_motion(load, q) - load->from;
        const double x = load->x + load->rate * t + load->acceleration * bend - u;
        const double change = (load->damped * load_at(load, x) - load->Q) * inv_m;
        for (int i = 0; i < N_MODES; i++) {
            slow[i] += change * load->shape[i];
            slow[N_MODES + i] += (load->side * change) * load->shape[i];
        }
    }
}
