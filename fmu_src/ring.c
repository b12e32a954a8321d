// Inner ring: translation, two tilts, prescribed speed.
//
//   m x'' = F_shaft + F_impact + F_contacts - c x' + m g       (the paper's equation; the load is given on the ring)
//   tilt: prescribed  beta'' = (beta_shaft - beta)/tau^2 - 2 beta'/tau, gamma likewise: critically damped
//         supported   M = k_tilt (shaft - ring) - c_tilt rates + shaft.M
//         free        M = shaft.M only
//         both with the gyroscopic moment of the spin (rotor.h)
//   pulses: F_r sin(pi (t - t_n)/duration) along the radial load (+Y without one) and F_a along +X, t_n = t_start + n interval
//
// The vectors of force are in the global frame.  Shaft tilt is a rotation about (0, tilt_y, tilt_z): a = (cos, tilt_z sinc, -tilt_y sinc).
#include "ring.h"

void ring_cosines(double tilt_y, double tilt_z, double *beta, double *gamma)
{
    const double angle = sqrt(tilt_y * tilt_y + tilt_z * tilt_z);
    const double sinc = angle > 1e-8 ? sin(angle) / angle : 1.0;
    *beta = tilt_y * sinc;
    *gamma = tilt_z * sinc;
}

void ring_tilts(double beta, double gamma, double *tilt_y, double *tilt_z)
{
    const double sine = sqrt(beta * beta + gamma * gamma);
    const double factor = sine > 1e-8 ? asin(sine) / sine : 1.0;
    *tilt_y = beta * factor;
    *tilt_z = gamma * factor;
}

static const double PI = 3.14159265358979323846;

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
    while (i + 1 < p->pulse.count && pulse_start(p, i + 1) <= t) i++;  // the division may round either way
    while (i > 0 && pulse_start(p, i) > t) i--;
    return i;
}

double drive_next_edge(const Parameters *p, double t)
{
    if (p->pulse.F_r == 0.0 && p->pulse.F_a == 0.0) return INFINITY;
    const int i = pulse_index(p, t);
    if (i >= 0 && pulse_start(p, i) + p->pulse.duration > t) return pulse_start(p, i) + p->pulse.duration;
    return i + 1 < p->pulse.count ? pulse_start(p, i + 1) : INFINITY;
}

void drive_update(const Parameters *p, const Inputs *u, double t, Drive *drive)
{
    const double radial = sqrt(u->shaft.F_y * u->shaft.F_y + u->shaft.F_z * u->shaft.F_z);
    const double y = radial > 0.0 ? u->shaft.F_y / radial : 1.0, z = radial > 0.0 ? u->shaft.F_z / radial : 0.0;
    drive->F[0] = u->shaft.F_x + u->impact.F_a;
    drive->F[1] = u->shaft.F_y + u->impact.F_r * y;
    drive->F[2] = u->shaft.F_z + u->impact.F_r * z;
    drive->M[0] = u->shaft.M_y;
    drive->M[1] = u->shaft.M_z;
    drive->omega = u->shaft.omega;
    ring_cosines(u->shaft.tilt_y, u->shaft.tilt_z, &drive->beta, &drive->gamma);

    const int i = pulse_index(p, t);
    const bool active = i >= 0 && t < pulse_start(p, i) + p->pulse.duration;
    drive->pulse[0] = active ? p->pulse.F_a : 0.0;
    drive->pulse[1] = active ? p->pulse.F_r * y : 0.0;
    drive->pulse[2] = active ? p->pulse.F_r * z : 0.0;
    drive->pulse_start = active ? pulse_start(p, i) : 0.0;
    drive->pulse_rate = PI / p->pulse.duration;
}

void drive_load(const Drive *drive, double t, double F[3])
{
    real sine = real_set(0.0), cosine;
    if (drive->pulse[0] != 0.0 || drive->pulse[1] != 0.0 || drive->pulse[2] != 0.0)
        real_sincos(real_set((t - drive->pulse_start) * drive->pulse_rate), &sine, &cosine);
    for (int i = 0; i < 3; i++) F[i] = drive->F[i] + drive->pulse[i] * sine[0];
}

void ring_acceleration(const Model *model, double t, Work *w, double *y_dot)
{
    const Parameters *p = model->p;
    const Drive *drive = model->drive;
    const Rotor *ring = &w->ring;
    const double gravity[3] = {0.0, p->gravity.y, p->gravity.z};
    const double beta = -ring->a[2], gamma = ring->a[1], beta_dot = -ring->a_dot[2], gamma_dot = ring->a_dot[1];
    double F[3];
    drive_load(drive, t, F);
    for (int i = 0; i < 3; i++) {
        y_dot[Y_RING_X + i] = ring->v[i];
        y_dot[Y_RING_V_X + i] = (F[i] + ring->F[i] - p->ring.c * ring->v[i]) / p->ring.m + gravity[i];
    }
    y_dot[Y_RING_BETA] = beta_dot;
    y_dot[Y_RING_GAMMA] = gamma_dot;
    if (p->ring.tilt_mode == TILT_MODE_PRESCRIBED) {
        const double rate = 1.0 / p->ring.tilt_time;
        y_dot[Y_RING_BETA_DOT] = ((drive->beta - beta) * rate - 2.0 * beta_dot) * rate;
        y_dot[Y_RING_GAMMA_DOT] = ((drive->gamma - gamma) * rate - 2.0 * gamma_dot) * rate;
        return;
    }
    double M[3] = {ring->M[0], ring->M[1] + drive->M[0], ring->M[2] + drive->M[1]}, a_ddot[3], s_dot;
    if (p->ring.tilt_mode == TILT_MODE_SUPPORTED) {
        M[1] += p->ring.k_tilt * (drive->beta - beta) - p->ring.c_tilt * beta_dot;
        M[2] += p->ring.k_tilt * (drive->gamma - gamma) - p->ring.c_tilt * gamma_dot;
    }
    rotor_acceleration(ring, p->ring.J_p, p->ring.J_t, M, a_ddot, &s_dot);  // s_dot: the drive holds the speed
    y_dot[Y_RING_BETA_DOT] = -a_ddot[2];
    y_dot[Y_RING_GAMMA_DOT] = a_ddot[1];
}
