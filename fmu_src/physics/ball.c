// A ball in its cylindrical frame (x, r, t), azimuth theta, orbital speed omega_m = theta_dot, angular
// velocity omega:
//
//   m x''                       = F_x            J omega_x' = M_x
//   m (r'' - r omega_m^2)       = F_r            J omega_r' = M_r + J omega_m omega_t
//   m (r omega_m' + 2 r' omega_m) = F_t          J omega_t' = M_t - J omega_m omega_r
//
// Beside the forces acts the field of gravity and of the frame's acceleration (frame.h).  In a frame that
// turns at omega_f all equations, solved for the accelerations, hold with omega_m + omega_f in place of omega_m,
// and omega_f' is subtracted from omega_m' and omega_x'.
//
// Gupta (1979), J. Lubr. Technol. 101, 293.  The last terms on the right are the gyroscopic moments: they
// arise because the frame turns with the orbit; the sphere itself needs no orientation.
#include "physics/ball.h"

void ball_kinematics(const scalar *y, Work *w)
{
    scalar *positions[] = {w->x, w->r, w->theta}, *velocities[] = {w->v_x, w->v_r, w->omega_m};
    scalar *spins[] = {w->omega_x, w->omega_r, w->omega_t};
    for (int i = 0; i < 3; i++) {
        memcpy(positions[i], &y[Y_BALL_X + i * Z], Z * sizeof *y);
        memcpy(velocities[i], &y[Y_BALL_V_X + i * Z], Z * sizeof *y);
        memcpy(spins[i], &y[Y_BALL_OMEGA_X + i * Z], Z * sizeof *y);
    }
    for (int b = 0; b < PACKETS; b++) {
        const int j = b * LANE_WIDTH;
        wide cosine, sine;
        wide_sincos(wide_load(&w->theta[j]), &sine, &cosine);
        wide_store(&w->cos_theta[j], cosine);
        wide_store(&w->sin_theta[j], sine);
        wide_store(&w->v_t[j], wide_load(&w->r[j]) * wide_load(&w->omega_m[j]));
    }
}

void ball_acceleration(const Model *model, const Work *w, scalar *y_dot)
{
    const double inv_mass = 1.0 / model->d->m, inv_inertia = 1.0 / model->d->J;
    const RingLoad *frame = model->ring_load;
    const wide g_x = wide_set(frame->field[0]), g_y = wide_set(frame->field[1]);
    const wide g_z = wide_set(frame->field[2]), frame_omega = wide_set(frame->frame_omega);
    const wide frame_omega_dot = wide_set(frame->frame_omega_dot);
    ball_array rows[6];
    for (int b = 0; b < PACKETS; b++) {
        const int j = b * LANE_WIDTH;
        const wide r = wide_load(&w->r[j]), v_r = wide_load(&w->v_r[j]);
        const wide omega_m = wide_load(&w->omega_m[j]) + frame_omega;  // in the fixed frame
        const wide cosine = wide_load(&w->cos_theta[j]), sine = wide_load(&w->sin_theta[j]);
        const wide omega_r = wide_load(&w->omega_r[j]), omega_t = wide_load(&w->omega_t[j]);
        wide_store(&rows[0][j], wide_load(&w->F_x[j]) * inv_mass + g_x);
        wide_store(&rows[1][j],
                   wide_load(&w->F_r[j]) * inv_mass + g_y * cosine + g_z * sine + r * omega_m * omega_m);
        wide_store(&rows[2][j],
                   (wide_load(&w->F_t[j]) * inv_mass + g_z * cosine - g_y * sine - 2.0 * v_r * omega_m) / r -
                       frame_omega_dot);
        wide_store(&rows[3][j], wide_load(&w->M_x[j]) * inv_inertia - frame_omega_dot);
        wide_store(&rows[4][j], wide_load(&w->M_r[j]) * inv_inertia + omega_m * omega_t);
        wide_store(&rows[5][j], wide_load(&w->M_t[j]) * inv_inertia - omega_m * omega_r);
    }

    // into the rows of the state vector
    memcpy(&y_dot[Y_BALL_X], w->v_x, Z * sizeof *y_dot);
    memcpy(&y_dot[Y_BALL_R], w->v_r, Z * sizeof *y_dot);
    memcpy(&y_dot[Y_BALL_THETA], w->omega_m, Z * sizeof *y_dot);
    for (int i = 0; i < 3; i++) {
        memcpy(&y_dot[Y_BALL_V_X + i * Z], rows[i], Z * sizeof *y_dot);
        memcpy(&y_dot[Y_BALL_OMEGA_X + i * Z], rows[3 + i], Z * sizeof *y_dot);
    }
}
