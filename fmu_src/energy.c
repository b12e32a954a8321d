// Energy of balls, cage halves and everything elastic between them and the rings.
//
//   contacts (2/5) K delta^2.5, shared between the halves as in pocket.c;  joint T^2/(2 k_rivet) + N_plate^2/(2 k_plate) + k z^2/2 + hole contact
//
// The inner ring is outside: its motion does the work -F.v - M.Omega of the contacts.  Outputs only; never in the integration.
#include "energy.h"

#include "rotor.h"

static scalar contact_energy(double K, scalar delta)
{
    return scalar_value(delta) > 0.0 ? 0.4 * K * delta * delta * scalar_sqrt(delta) : 0.0;
}

static scalar ball_energy(const Model *model, const scalar *y, const Work *w, int j)
{
    const Derived *d = model->d;
    const scalar v_x = y[Y_BALL_V_X + j], v_r = y[Y_BALL_V_R + j], v_t = y[Y_BALL_R + j] * y[Y_BALL_OMEGA_M + j];
    const scalar o_x = y[Y_BALL_OMEGA_X + j], o_r = y[Y_BALL_OMEGA_R + j], o_t = y[Y_BALL_OMEGA_T + j];
    return 0.5 * d->m * (v_x * v_x + v_r * v_r + v_t * v_t) + 0.5 * d->J * (o_x * o_x + o_r * o_r + o_t * o_t) +
           contact_energy(d->inner.hertz.K, w->delta_i[j]) + contact_energy(d->outer.hertz.K, w->delta_e[j]);
}

// Elastic energy of ball j in the pocket of half h: the share of pocket.c times the Hertz energy.
static scalar pocket_energy(const Model *model, const Work *w, int j, int h)
{
    if (scalar_value(w->delta_c[h][j]) <= 0.0) return 0.0;
    const Rotor *half = &w->half[h];
    const scalar ball[3] = {w->x[j], w->r[j] * w->cos_theta[j], w->r[j] * w->sin_theta[j]};
    scalar share = 1.0;
    if (model->p->scene.cage == CAGE_MODEL_TWO_HALF) {
        scalar x = 0.0;
        for (int i = 0; i < 3; i++) x += (ball[i] - half->x[i]) * half->a[i];
        const double width = model->p->cage.share_width;
        const scalar n_x = x / (w->delta_c[h][j] + model->d->pocket_radius - model->d->R[j]);
        share = 0.5 * (1.0 + (h == 0 ? -1.0 : 1.0) * n_x / scalar_sqrt(n_x * n_x + width * width));
    }
    return share * contact_energy(model->d->pocket.K, w->delta_c[h][j]);
}

static scalar joint_energy(const Derived *d, const scalar *y, const Work *w, int k)
{
    const scalar z_y = y[Y_JOINT_PLATE_Y + k], z_z = y[Y_JOINT_PLATE_Z + k], h_y = y[Y_JOINT_HEAD_Y + k], h_z = y[Y_JOINT_HEAD_Z + k];
    const scalar bearing = scalar_max(0.0, scalar_sqrt(w->u_y[k] * w->u_y[k] + w->u_z[k] * w->u_z[k]) - d->hole_gap);
    return 0.5 * (w->T[k] * w->T[k] / d->k_rivet + w->N_plate[k] * w->N_plate[k] / d->k_plate + d->k_plate_t * (z_y * z_y + z_z * z_z) +
                  d->k_head * (h_y * h_y + h_z * h_z) + d->k_hole * bearing * bearing);
}

scalar energy_total(const Model *model, const scalar *y, const Work *w)
{
    const Parameters *p = model->p;
    const bool rigid = p->scene.cage == CAGE_MODEL_RIGID;
    scalar E = w->land_elastic;
    for (int j = 0; j < Z; j++) {
        E += ball_energy(model, y, w, j) + pocket_energy(model, w, j, 0);
        if (!rigid) E += pocket_energy(model, w, j, 1) + joint_energy(model->d, y, w, j);
    }
    for (int h = 0; h < 2; h++) {
        const Rotor *half = &w->half[h];
        scalar v[3];
        cross3(half->Omega, half->c, v);
        for (int i = 0; i < 3; i++) v[i] += half->v[i];  // of the centre of mass
        E += 0.5 * (p->cage.m * dot3(v, v) + p->cage.J_t * dot3(half->a_dot, half->a_dot) + p->cage.J_p * half->s * half->s);
    }
    return E;
}
