// How balls approach a half of the cage along given directions, both as rigid bodies.
#include "cage/common/rigid_approach.h"

#include "numbers/vec.h"

void rigid_approach(const Model *model, double gamma, const double *const direction[3], const double *f,
                    const double *state, const double *y, const Work *w, int h, int j, RigidApproach *to)
{
    const Rotor *half = &w->half[h];
    const wide v_x = wide_load(&state[Y_BALL_V_X + j]), v_r = wide_load(&state[Y_BALL_V_R + j]);
    const wide omega = wide_load(&state[Y_BALL_OMEGA_M + j]), zero = wide_set(0.0);
    const wide x = wide_load(&y[Y_BALL_X + j]) - gamma * v_x, r = wide_load(&y[Y_BALL_R + j]) - gamma * v_r;
    wide cosine, sine;
    wide_sincos(wide_load(&y[Y_BALL_THETA + j]) - gamma * omega, &sine, &cosine);

    // direction
    const vec a = vec_local(half->a, cosine, sine), b_y = vec_local(half->b_y, cosine, sine);
    const vec b_z = vec_local(half->b_z, cosine, sine);
    const wide cos_phi = wide_load(&model->d->pocket_cos[j]), sin_phi = wide_load(&model->d->pocket_sin[j]);
    const vec b = vec_axpy(sin_phi, b_z, vec_scale(cos_phi, b_y)), e_t = vec_cross(a, b);
    const vec along = vec_axpy(wide_load(&direction[1][j]), b, vec_scale(wide_load(&direction[0][j]), a));
    const vec n = vec_axpy(wide_load(&direction[2][j]), e_t, along);

    // the ball's centre from the half's geometric centre, and from its centre of mass
    const vec p = vec_sub((vec){x, r, zero}, vec_local(half->x, cosine, sine));
    const vec from_mass = vec_sub(p, vec_local(half->c, cosine, sine));
    const vec Omega = vec_local(half->Omega, cosine, sine);
    const vec v = vec_add(vec_local(half->v, cosine, sine), vec_cross(Omega, p));
    wide_store(to->rate, vec_dot(n, vec_sub((vec){v_x, v_r, r * omega}, v)));

    const double *move = &f[Y_CAGE_V_X + h];
    const double moved[3] = {move[0], move[2], move[4]};
    const double turned[3] = {f[Y_CAGE_S + h], f[Y_CAGE_BETA_DOT + h], f[Y_CAGE_GAMMA_DOT + h]};
    const vec by_turn = vec_add(vec_cross(vec_local(turned, cosine, sine), from_mass),
                                vec_cross(Omega, vec_cross(Omega, from_mass)));
    const vec ball = {wide_load(&f[Y_BALL_V_X + j]), wide_load(&f[Y_BALL_V_R + j]) - r * omega * omega,
                      r * wide_load(&f[Y_BALL_OMEGA_M + j]) + 2.0 * v_r * omega};
    wide_store(to->acceleration, vec_dot(n, vec_sub(ball, vec_add(vec_local(moved, cosine, sine), by_turn))));
    wide_store(to->direction[0], n.x), wide_store(to->direction[1], n.r), wide_store(to->direction[2], n.t);
    vec_to_global(n, cosine, sine, to->along[0], to->along[1], to->along[2]);
    vec_to_global(vec_cross(from_mass, n), cosine, sine, to->along[5], to->along[3], to->along[4]);
}
