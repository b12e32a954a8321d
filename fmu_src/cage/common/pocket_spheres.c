// Ball and pocket of a ribbon cage: in each half a sphere with a fillet and two edges.
//
//          x (pole)                   Half 1; half 0 is its mirror image.  The sphere's centre lies e = K - R_c beyond the
//       .--+--.    sheet              split, K the depth of the pocket.
//     .'   |   '.                     q = (x, r, t): ball's centre from the sphere's centre, x toward the pole, r along the
//  --'     |     '--  land -- split   pocket's radius, t along its tangent
//     fillet  ball                    g: reach of q in the plane of a rim (below)
//
//     sphere   delta = |q| - (R_c - R)                      Q = K delta^1.5 (1 + 0.7 a/R),  a = sqrt(R_eff delta)
//     fillet   delta = R + rho - |(A - g, H - x)|,    A^2 + H^2 = (R_c + rho)^2,  H = rho + e,     round the pole
//     edges    delta = R + rho - |(A - g, H - |r|)|,  A^2 + H^2 = (R_c + rho)^2,  H = w/2 - rho,   round the pocket's radius
//
// R_eff = R R_c/(R_c - R).  Fillet and edges are rims: rings of the radius rho of their section that touch the sphere
// along a circle, the seam, the fillet's at sin chi_1 = H/(R_c + rho) from the split, the edges' at sin eta = H/(R_c + rho).
// From there on they bend away from the ball, so that a rim's approach is never more than the sphere's and equals it where
// q points to the seam.  Hertz' law with the curvatures 1/R + 1/rho across the rim and 1/R - 1/R_c along it.
//
// A rim ends at the others: the fillet lies between the edges, an edge between the fillets of both sides.  With u toward the
// middle of such an arc, v across and omega half of its opening,  g = sqrt(u^2 + v^2) within it, else
// u cos omega + v sin omega: the corner.
//
// The part of a patch on the sphere's side of a seam is that of the machined pocket's split (pocket.c),
// e = 1/2 + 15/16 xi - 5/8 xi^3 + 3/16 xi^5 of the energy, xi = R_c sin(angle of q above the seam)/a, at most 1, a of the
// rim's approach:  V = (1 - e_f) V_fillet + e_f ((1 - e_e) V_edge + e_e V_sphere).  V decides all: the force on the ball is
// -dV/dq = -Q n through its centre, the friction acts at the contact point p + R n.  Energy and momentum are conserved
// exactly.
//
// A push along the tangent touches both halves at sin chi_0 = e/(R_c - R) if that is more than sin chi_1: each half has
// N = F sin(chi_0 +- beta)/sin 2 chi_0 of a push at the angle beta from the split, beyond chi_0 one half has all.
// 0.7 a/R: independent solution of an elastic ball in a spherical hole (tests/conforming_spheres.py).
//
// Smoothness: C1 at touch-down, at the seams and where the second half begins to carry.  At a corner the force is
// continuous, its slope is not.
#include "cage/common/pocket_spheres.h"

#include "cage/common/pocket_forces.h"
#include "physics/hertz.h"

static const double LEAST = 1e-12;  // load of a pocket that counts as touched [N]

// Forces in a packet of pockets, stored for the half and added to the balls.
INLINE void sphere_forces(const Model *model, Work *w, int h, int j, const SphereGap *gap,
                          const SphereContact *at, bits pressed, bool mixed)
{
    const Parameters *p = model->p;
    const Derived *d = model->d;
    const Rotor *half = &w->half[h];
    Pockets *pocket = &w->pocket[h];
    const wide cos_theta = wide_load(&w->cos_theta[j]), sin_theta = wide_load(&w->sin_theta[j]);
    const wide R = wide_load(&d->R[j]), zero = wide_set(0.0), n_x = (h == 0 ? -1.0 : 1.0) * at->n_x;
    const vec n = vec_axpy(at->n_t, gap->e_t, vec_axpy(at->n_r, gap->b, vec_scale(n_x, gap->a)));

    // velocity of the ball's centre against the half there
    const vec omega_b = vec_load(&w->omega_x[j], &w->omega_r[j], &w->omega_t[j]);
    const vec v_b = vec_load(&w->v_x[j], &w->v_r[j], &w->v_t[j]);
    const vec Omega = vec_local(half->Omega, cos_theta, sin_theta);
    const vec v = vec_sub(vec_sub(v_b, vec_local(half->v, cos_theta, sin_theta)), vec_cross(Omega, gap->p));
    const wide delta_dot = vec_dot(n, v);
    const wide Q = wide_select(pressed, hertz_damped(at->Q, wide_set(p->cage.lambda), delta_dot), zero);

    // friction at the contact point
    const vec arm = vec_scale(R, n);
    const vec slip = vec_across(vec_add(v, vec_cross(vec_sub(omega_b, Omega), arm)), n);
    const wide slip_2 = vec_dot(slip, slip);
    wide ln_U_2, ln_Q;
    wide_log2(0.25 * slip_2 + p->oil.U_0 * p->oil.U_0, Q + Q_FLOOR, &ln_U_2, &ln_Q);
    const wide mu = pocket_mu(model, 0.5 * ln_U_2, ln_Q, mixed);
    const wide g = mu * Q / wide_sqrt(slip_2 + p->cage.v_c * p->cage.v_c);
    const vec F_s = vec_scale(-g, slip);

    // A pocket without contact beside others in its packet adds -0, as in pocket.c.
    const vec F = vec_where(pressed, vec_axpy(-Q, n, F_s)), M = vec_where(pressed, vec_cross(arm, F_s));
    const vec F_half = vec_scale(wide_set(-1.0), F), M_half = vec_sub(vec_cross(gap->p, F_half), M);

    wide_store(&pocket->Q[j], Q);
    wide_store(&pocket->F_x[j], wide_select(pressed, vec_dot(F_half, gap->a), zero));
    wide_store(&pocket->F_r[j], wide_select(pressed, vec_dot(F_half, gap->b), zero));
    wide_store(&pocket->F_t[j], wide_select(pressed, vec_dot(F_half, gap->e_t), zero));
    // place of the contact on the wall
    const wide place_r = gap->r + R * at->n_r + d->spheres.r, place_t = gap->t + R * at->n_t;
    wide_store(&pocket->push_x[j], (h == 0 ? -1.0 : 1.0) * (gap->x + R * at->n_x));
    wide_store(&pocket->push_t[j], place_t);
    wide_store(&pocket->radius[j], wide_sqrt(place_r * place_r + place_t * place_t));
    scalar *const global[6] = {pocket->half_F_x, pocket->half_F_y, pocket->half_F_z,
                               pocket->half_M_x, pocket->half_M_y, pocket->half_M_z};
    vec_to_global(F_half, cos_theta, sin_theta, &global[0][j], &global[1][j], &global[2][j]);
    vec_to_global(M_half, cos_theta, sin_theta, &global[3][j], &global[4][j], &global[5][j]);
    for (int i = 0; i < 6; i++)
        wide_store(&global[i][j], wide_select(pressed, wide_load(&global[i][j]), zero));

    // on the balls: forces, stiff rates of friction in the tangent plane, dissipated power
    const vec tangent = {1.0 - n.x * n.x, 1.0 - n.r * n.r, 1.0 - n.t * n.t};
    add_vec(F, &w->F_x[j], &w->F_r[j], &w->F_t[j]);
    add_vec(M, &w->M_x[j], &w->M_r[j], &w->M_t[j]);
    add_vec(vec_where(pressed, vec_scale(g / d->m, tangent)), &w->D_x[j], &w->D_r[j], &w->D_t[j]);
    add_vec(vec_where(pressed, vec_scale(g * (R * R / d->J), tangent)), &w->D_omega_x[j], &w->D_omega_r[j],
            &w->D_omega_t[j]);
    const wide lost = (Q - at->Q) * delta_dot - vec_dot(F_s, slip);
    const wide dissipated = wide_select(pressed, lost, wide_set(-0.0));
    wide_store(&w->dissipated[j], wide_load(&w->dissipated[j]) + dissipated);
    wide_store(&w->pocket_dissipated[j], wide_load(&w->pocket_dissipated[j]) + dissipated);
}

// Most pockets are not touched, so that their forces are not computed.
void spheres_rigid(const Model *model, Work *w)
{
    const Spheres *s = &model->d->spheres;
    const bool mixed = pocket_is_mixed(model);
    for (int h = 0; h < 2; h++) {
        bool touched = false;
        for (int j = 0; j < PACKETS * LANE_WIDTH; j += LANE_WIDTH) {
            const SphereGap gap = sphere_gap(model->d, w, h, j);
            const wide slack = wide_load(&s->slack[j]);
            SphereContact at;
            bits pressed = {0};
            if (sphere_reached(slack, &gap, &at.delta)) {
                at = sphere_contact(s, slack, gap.x, gap.r, gap.t);
                pressed = wide_above(at.Q, LEAST);
            }
            wide_store(&w->delta_c[h][j], at.delta);
            if (wide_any(pressed)) {
                sphere_forces(model, w, h, j, &gap, &at, pressed, mixed);
                touched = true;
            } else
                pocket_clear(&w->pocket[h], j);
        }
        if (touched) add_pockets(&w->pocket[h], &w->half[h]);
    }
}
