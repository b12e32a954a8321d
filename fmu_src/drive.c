// The inputs as the ring sees them.
//
//   pulses: F_r portable_sin(pi (t - t_n)/duration) along the radial load (+Y without one) and F_a along +X, t_n = t_start + n interval
//
// The vectors of force are in the global frame.  Shaft tilt is a rotation about (0, tilt_y, tilt_z): a = (cos, tilt_z sinc, -tilt_y sinc).
#include "drive.h"

#include "elementary.h"

void ring_cosines(double tilt_y, double tilt_z, double *beta, double *gamma)
{
    const double angle = sqrt(tilt_y * tilt_y + tilt_z * tilt_z);
    const double sinc = angle > 1e-8 ? portable_sin(angle) / angle : 1.0;
    *beta = tilt_y * sinc;
    *gamma = tilt_z * sinc;
}

void ring_tilts(double beta, double gamma, double *tilt_y, double *tilt_z)
{
    const double sine = sqrt(beta * beta + gamma * gamma);
    const double factor = sine > 1e-8 ? portable_asin(sine) / sine : 1.0;
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
