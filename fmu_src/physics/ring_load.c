// Trajectory of the inputs over a communication step, and the built-in pulses.  Equations in ring_load.h.
#include "physics/ring_load.h"

#include "physics/race_surface.h"

#define PLACE(group, member) (int)(offsetof(Inputs, group.member) / sizeof(double))

const MotionInput MOTION[MOTIONS] = {
    {PLACE(shaft, x), PLACE(shaft, v_x)},
    {PLACE(shaft, y), PLACE(shaft, v_y)},
    {PLACE(shaft, z), PLACE(shaft, v_z)},
    {PLACE(shaft, tilt_y), PLACE(shaft, tilt_y_dot)},
    {PLACE(shaft, tilt_z), PLACE(shaft, tilt_z_dot)},
    {PLACE(housing, x), PLACE(housing, v_x)},
    {PLACE(housing, y), PLACE(housing, v_y)},
    {PLACE(housing, z), PLACE(housing, v_z)},
    {PLACE(housing, tilt_y), PLACE(housing, tilt_y_dot)},
    {PLACE(housing, tilt_z), PLACE(housing, tilt_z_dot)},
    {PLACE(frame, omega), PLACE(frame, omega_dot)},
};

// Loads do nothing to a ring whose motion is prescribed.
static void clear_loads(Inputs *u)
{
    u->shaft.F_x = u->shaft.F_y = u->shaft.F_z = u->shaft.M_y = u->shaft.M_z = 0.0;
    u->impact.F_r = u->impact.F_a = 0.0;
}

// Rate of velocity i over the last step; 0 before there was one.
static double mean_rate(const MotionHistory *history, const Inputs *given, int i)
{
    const double change = ((const double *)given)[MOTION[i].velocity] - history->v[i];
    return history->steps > 0 && change != 0.0 ? change / history->h : 0.0;
}

static double minmod(double x, double y)
{
    return x * y <= 0.0 ? 0.0 : fabs(x) < fabs(y) ? x : y;
}

void motion_remember(const Inputs *given, double h, MotionHistory *history)
{
    for (int i = 0; i < MOTIONS; i++) {
        history->a[i] = mean_rate(history, given, i);
        history->v[i] = ((const double *)given)[MOTION[i].velocity];
    }
    history->h = fmax(h, SHORTEST_MOTION);
    if (history->steps < 2) history->steps++;
}

// Largest acceleration of motion i while it catches up.
static double catch_up_limit(const Parameters *p, int i)
{
    const double r = 0.5 * p->bearing.d_m;
    if (MOTION[i].position == PLACE(frame, omega))
        return CATCH_UP_ACCELERATION / (CATCH_UP_TIME * (r + p->frame.radius));
    const bool length = i % SHAFT_MOTIONS < 3;
    return length ? CATCH_UP_ACCELERATION : CATCH_UP_ACCELERATION / r;
}

// Time within which position and velocity, behind by d_x and d_v, catch up: that of the step unless this needs more than
// the acceleration `limit`.
static double catch_up_time(double d_x, double d_v, double h, double limit)
{
    const double x = fabs(d_x), v = fabs(d_v);
    if (6.0 * x / (h * h) + 4.0 * v / h <= limit) return h;
    return fmax(CATCH_UP_TIME, (2.0 * v + sqrt(4.0 * v * v + 6.0 * limit * x)) / limit);
}

void motion_trajectory(const Parameters *p, const Inputs given[INPUT_ORDERS + 1],
                       const MotionHistory *history, const Inputs *now, double h, Inputs u[INPUT_ORDERS + 1],
                       MotionLag *lag)
{
    *lag = (MotionLag){0};
    const bool prescribed = p->ring.motion == RING_MOTION_PRESCRIBED;
    const double *in[INPUT_ORDERS + 1], *at = (const double *)now;
    double *out[INPUT_ORDERS + 1];
    memcpy(u, given, (INPUT_ORDERS + 1) * sizeof *u);
    for (int order = 0; order <= INPUT_ORDERS; order++) {
        in[order] = (const double *)&given[order];
        out[order] = (double *)&u[order];
        if (prescribed) clear_loads(&u[order]);
    }
    for (int i = 0; i < MOTIONS; i++) {
        const int q = MOTION[i].position, v = MOTION[i].velocity;
        if (i < SHAFT_MOTIONS && !prescribed) {
            out[1][v] = out[2][v] = 0.0;
            continue;
        }

        // the motion reached so far, and that at the end of the step
        const double x_0 = at[q], v_0 = at[v], jerk = in[2][v];
        out[0][q] = x_0, out[0][v] = out[1][q] = v_0;
        out[1][v] = out[2][q] = out[2][v] = 0.0;
        if (h < SHORTEST_MOTION) continue;
        double a = in[1][v];
        const double limit = catch_up_limit(p, i);
        if (a == 0.0 && jerk == 0.0 && history->steps == 2)
            a = fmax(-limit, fmin(limit, minmod(mean_rate(history, given, i), history->a[i])));

        const double d_x = in[0][q] - x_0, d_v = in[0][v] - v_0;
        if (d_x == 0.0 && d_v == 0.0 && v_0 == 0.0 && a == 0.0 && jerk == 0.0) continue;  // at rest

        // a motion that is far behind the given one catches up over more than this step
        const double T = catch_up_time(d_x, d_v, h, limit);
        if (T > h) {
            out[1][v] = out[2][q] = a + (6.0 * d_x / T + 4.0 * d_v) / T;
            out[2][v] = jerk - (12.0 * d_x / T + 6.0 * d_v) / (T * T);
            if (lag->count++ == 0) lag->motion = i, lag->x = d_x, lag->v = d_v;
            continue;
        }
        const double x_1 = in[0][q] + h * (in[0][v] + 0.5 * h * (a + h / 3.0 * jerk));
        const double v_1 = in[0][v] + h * (a + 0.5 * h * jerk);
        const double mean = (x_1 - x_0) / h;
        out[1][v] = out[2][q] = (6.0 * mean - 4.0 * v_0 - 2.0 * v_1) / h;
        out[2][v] = (6.0 * (v_0 + v_1) - 12.0 * mean) / (h * h);
    }
}

static double pulse_start(const Parameters *p, int n)
{
    return p->pulse.t_start + n * p->pulse.interval;
}

// Index of the last pulse that started at or before t, -1 before the first one.
static int pulse_index(const Parameters *p, double t)
{
    if (p->pulse.count == 0 || t < p->pulse.t_start) return -1;
    const double n = floor((t - p->pulse.t_start) / p->pulse.interval);
    int i = n < p->pulse.count ? (int)n : p->pulse.count - 1;
    while (i + 1 < p->pulse.count && pulse_start(p, i + 1) <= t) i++;  // the division may round up or down
    while (i > 0 && pulse_start(p, i) > t) i--;
    return i;
}

static bool has_pulses(const Parameters *p)
{
    return (p->pulse.F_r != 0.0 || p->pulse.F_a != 0.0) && p->ring.motion == RING_MOTION_FREE;
}

bool pulse_in_progress(const Parameters *p, double t)
{
    const int i = pulse_index(p, t);
    return has_pulses(p) && i >= 0 && pulse_start(p, i) < t && t < pulse_start(p, i) + p->pulse.duration;
}

double pulse_next_edge(const Parameters *p, double t)
{
    if (!has_pulses(p)) return INFINITY;
    const int i = pulse_index(p, t);
    if (i >= 0 && pulse_start(p, i) + p->pulse.duration > t) return pulse_start(p, i) + p->pulse.duration;
    return i + 1 < p->pulse.count ? pulse_start(p, i + 1) : INFINITY;
}

// Integral of a half-sine of amplitude 1 that begins at 0, up to the time t.
static double pulse_integral(const Parameters *p, double t)
{
    const double within = fmin(fmax(t / p->pulse.duration, 0.0), 1.0);
    return p->pulse.duration / PI * (1.0 - portable_cos(PI * within));
}

void pulse_average(const Parameters *p, double t, double half, InputTrajectory *trajectory)
{
    if (!has_pulses(p) || half <= 0.0) return;
    double mean = 0.0;
    const int last = pulse_index(p, t + half);
    for (int i = last; i >= 0 && pulse_start(p, i) + p->pulse.duration > t - half; i--)
        mean +=
            pulse_integral(p, t + half - pulse_start(p, i)) - pulse_integral(p, t - half - pulse_start(p, i));
    mean /= 2.0 * half;
    trajectory->pulse_r = p->pulse.F_r * mean;
    trajectory->pulse_a = p->pulse.F_a * mean;
    trajectory->pulse_start = trajectory->pulse_rate = 0.0;
}

void input_trajectory_update(const Parameters *p, const Inputs u[INPUT_ORDERS + 1], double t_0, double t,
                             InputTrajectory *trajectory)
{
    const int i = has_pulses(p) ? pulse_index(p, t) : -1;
    const bool active = i >= 0 && t < pulse_start(p, i) + p->pulse.duration;
    trajectory->t_0 = t_0;
    memcpy(trajectory->u, u, sizeof trajectory->u);
    trajectory->pulse_r = active ? p->pulse.F_r : 0.0;
    trajectory->pulse_a = active ? p->pulse.F_a : 0.0;
    trajectory->pulse_start = active ? pulse_start(p, i) : 0.0;
    trajectory->pulse_rate = PI / p->pulse.duration;
    trajectory->gravity[0] = p->gravity.y;
    trajectory->gravity[1] = p->gravity.z;
    trajectory->radius = p->frame.radius;
    memset(trajectory->angle, 0, sizeof trajectory->angle);
    trajectory->angles_matter = race_surfaces_given(p) ? 1.0 : 0.0;
}

bool input_trajectory_varies(const InputTrajectory *trajectory)
{
    const bool gravity = trajectory->gravity[0] != 0.0 || trajectory->gravity[1] != 0.0;
    bool varies = trajectory->pulse_r != 0.0 || trajectory->pulse_a != 0.0;
    varies |= gravity && trajectory->u[0].frame.omega != 0.0;  // gravity turns in the frame
    if (trajectory->angles_matter != 0.0)  // races that are not perfect turn with their rings
        varies |= trajectory->u[0].shaft.omega != 0.0 || trajectory->u[0].housing.omega != 0.0;
    return varies || any_not_zero((const double *)&trajectory->u[1], INPUT_ORDERS * N_INPUTS);
}

void input_trajectory_rates_at(const InputTrajectory *trajectory, double t, Inputs *u, Inputs *u_dot)
{
    const double *u_1 = (const double *)&trajectory->u[1], *u_2 = (const double *)&trajectory->u[2];
    input_trajectory_at(trajectory, t, u);
    for (int i = 0; i < N_INPUTS; i++) ((double *)u_dot)[i] = u_1[i] + (t - trajectory->t_0) * u_2[i];
}
