// The film of oil that a ball presses out of the gap to the sphere of a ribbon cage's half.  Both are rigid here, as in
// pocket_squeeze.h.
//
//         pole x                     q = S n: ball's centre from the sphere's centre (pocket_spheres.c), C = R_c - R, h = C - S
//       .--+--.    sheet, R_c        gap(u) = C - q.u = h + S (1 - cos phi)      phi: angle of the place u off n
//     .'  _|_  '.                    div (gap^3 grad p) = -12 eta v cos phi      on a sphere of the radius sqrt(R R_c)
//   -' . ( | ) . '-  seam            p = 0 at the fillet's seam, chi = chi_1 from the split, and at both edges, zeta = +- eta
//  split     n -> u                  (chi, zeta): angles round the pocket's radius and toward it, n = (cos zeta sin chi, sin zeta,
//                                    cos zeta cos chi) = (n_x, n_r, n_t)
//
// On a cap round n that ends at the gap h_m the oil leaves alike on all sides, dp/dphi = -6 eta v R R_c sin phi/gap^3, so that
// p = (3 eta v R R_c/S) (1/gap^2 - 1/h_m^2) and, where the film is narrow beside the ball,
//     F = (c v/h) (1 - h/h_m)^2,   c = 6 pi eta R_eff^2,   R_eff = R R_c/C                         one cap, closed form
// h_m -> infinity is the squeeze film of two nearly equal spheres, Taylor's limit with the reduced radius R_eff (Davis,
// Serayssol & Hinch (1986), J. Fluid Mech. 163, 479; any curvatures: Cox (1974), Int. J. Multiphase Flow 1, 343).
//
// Free edges.  The film is l = sqrt(2 h/C) wide, 3 to 7 degrees of gaps of a few micrometres, and the seam is 15 degrees from where a
// pushed ball touches: its edges count at any gap.  A paraboloid's film that ends at a straight edge, s l from its middle, has
//     E(s) = (w + w^2 + w^3)/3,   w = (1 + s/sqrt(s^2 + 1.2))/2
// of the force, s < 0 where the middle lies beyond the edge: fitted to Reynolds' equation on the half plane, within 0.5 % for
// s > 0, 2 % for s > -3; 1 - 0.6/s^2 and 0.1/s^2 far off.  Three edges count: the seam and both edges of the sheet,
//     s_f l = (n_x - sin chi_1)/cos chi_1,   s_e l = (sin eta -+ n_r)/cos eta
// D = P E_f E_e E_e c/h.  P is 1 at h = 0 and takes in that the edges meet, that opposite edges are one film's, and that the gap is
// no paraboloid.  P comes, as the direction m, from Reynolds' equation by Kantorovich's method (spheres_squeeze.c) at SQUEEZE_NODES gaps
// in each of three directions: where a push along the circle touches both halves (A), 80 degrees from the split (B), and there at
// 0.6 sin eta toward an edge (R).  Between them it is linear in n_x and in n_r^2, over the gap a polynomial of z = sqrt(h/C):
//     P = P_A + a (P_B - P_A) + b P_R,   a = (n_x - n_xA)/(n_xB - n_xA) >= 0,   b = (n_r/n_rR)^2 up to the edge
// The resultant leans toward the pole, as the film has more room there:  m ~ (n_x, k_r n_r, k_t n_t), k_t = k_A + a (k_B - k_A).
// Force on the ball -F m, F = D v.m, none where v.m < 0: the film cavitates.  F v.m >= 0 is lost, nothing is stored.
//
// Range.  Against Reynolds' equation on the whole cap (tests/test_spheres_squeeze.py) the force of a ball that closes in straight is
// within 3 % and 3 degrees for 0.003 C < h < 0.7 C and directions n that a push along the circle has, chi > chi_0 and |zeta| < 0.9 eta,
// with chi_0 17 degrees off the seam as in a 6205 or 6309; within 8 % and 5 degrees with chi_0 8 degrees off the seam.  Elsewhere it is
// within 20 % and 20 degrees down to the seam.  For n beyond an edge, where no force grows without limit, it is within 15 % and 17 degrees
// up to 5 degrees off.
//
// Filling.  The oil is a layer of the thickness t = filling C, the mean gap of a full pocket.  Where gap < t the layers meet, and
// the oil is pushed aside on a disc of the mean gap t, which ends at h_m = 2 t - h.  The closed form of the cap gives the disc, over
// that of a full pocket,  G_l = ((t - h)(2 C - h)/((2 t - h)(C - h)))^2,  1 for t = C and 0 from h = t on.  Of disc and edges the nearer
// end decides: with G = D h/c and G_e = P E_f E_e E_e,
//     (1/G - 1)^3 = (1/G_e - 1)^3 + (1/G_l - 1)^3
// Within 12 % of Reynolds' equation with p = 0 from h_m on for h < 0.6 t; each of both alone is exact.
//
// Floor by roughness and elasticity, Q = K delta^1.5 of ball and sphere: h_eff^2 = h^2 + sigma^2 + h_e^2 in E and c/h as in
// pocket_squeeze.h.  In contact |h| is the approach less the deflection of the wall by its own compliance.
//
// Smoothness: C1 but for v.m = 0, a = 0 and b = 1, where it is C0.  Left out: the force of a ball that moves along the wall, by
// symmetry without a force along n; the film in the fillet; the film's shear, which is in the friction of pocket_spheres.c.
#pragma once

#include "cage/common/pocket_squeeze.h"

// Constants of the films; called where those of the pockets are known.
void spheres_squeeze_derive(const Parameters *p, Derived *d);

// E of an edge at s l from the film's middle.
INLINE wide squeeze_edge(wide s_l, wide l_2)
{
    const wide w = 0.5 + 0.5 * s_l / wide_sqrt(s_l * s_l + 1.2 * l_2);
    return w * (1.0 + w * (1.0 + w)) * (1.0 / 3.0);
}

// G of a film that ends at the edges, or where a layer t fills the gap; C: mean gap of a full pocket.
INLINE wide squeeze_layer(wide G_e, wide h, wide t, wide C)
{
    const wide least = wide_set(1e-9), left = t - h;
    const wide root = wide_max(left * (2.0 * C - h) / ((2.0 * t - h) * (C - h)), least);
    const wide of_edges = wide_max(1.0 / wide_max(G_e, least) - 1.0, least),
               of_layer = 1.0 / (root * root) - 1.0;
    const wide cubes = of_edges * of_edges * of_edges + of_layer * of_layer * of_layer;
    const wide G = 1.0 / (1.0 + wide_exp(wide_log(cubes) * (1.0 / 3.0)));
    return wide_select(wide_above(left, 0.0), G, wide_set(0.0));
}

// q (x, r, t): ball's centre from the sphere's; taken: part of the approach by the wall's own compliance; v: velocity of the ball's centre against the
// wall along the same axes.
INLINE SqueezeFilm spheres_squeeze(const Derived *d, int j, const wide q[3], wide taken, const wide v[3])
{
    const PocketSqueeze *film = &d->squeeze;
    const SpheresSqueeze *cap = &d->spheres_squeeze;
    const wide zero = wide_set(0.0), one = wide_set(1.0), C = wide_load(&film->C[j]);
    const wide S = wide_sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + 1e-30), inv_S = 1.0 / S;
    const wide n_x = q[0] * inv_S, n_r = q[1] * inv_S, n_t = q[2] * inv_S;

    // gap with its floor; below 1 nm/s the film is linear in the speed
    const wide delta = S - wide_load(&d->spheres.slack[j]) - taken;
    const wide closing = wide_max(n_x * v[0] + n_r * v[1] + n_t * v[2], wide_set(1e-9));
    const wide h_e2 = film->elastic * wide_exp(0.8 * wide_log(closing));
    const wide h_eff = wide_sqrt(delta * delta + (h_e2 + film->roughness_2)), l_2 = 2.0 * h_eff / C;
    const wide h = wide_max(-delta, zero);

    // edges
    const wide E_f = squeeze_edge((n_x - cap->sin_chi) * cap->inv_cos_chi, l_2);
    const wide E_out = squeeze_edge((cap->sin_eta - n_r) * cap->inv_cos_eta, l_2);
    const wide E_in = squeeze_edge((cap->sin_eta + n_r) * cap->inv_cos_eta, l_2);

    // P and the resultant's direction by gap and direction
    const wide z = wide_sqrt(wide_min(h / C, one) + 1e-30);
    wide by[SQUEEZE_SHAPES];
    for (int i = 0; i < SQUEEZE_SHAPES; i++) by[i] = squeeze_polynomial(film->node, cap->newton[i], z);
    const wide a = wide_max((n_x - cap->n_xA) * cap->inv_n_x, zero);
    const wide b = wide_min(n_r * n_r, wide_set(cap->sin_eta * cap->sin_eta)) * cap->inv_n_r2;
    const wide P = wide_fma(a, by[P_B] - by[P_A], by[P_A]) + b * by[P_R];
    const wide k_t = wide_fma(a, by[K_B] - by[K_A], by[K_A]);
    const wide m_x = wide_max(n_x, zero), m_r = by[K_R] * n_r, m_t = k_t * n_t;
    const wide inv_m = 1.0 / wide_sqrt(m_x * m_x + m_r * m_r + m_t * m_t + 1e-30);

    wide G = wide_max(P, zero) * E_f * E_out * E_in;
    if (cap->filling < 1.0) G = squeeze_layer(G, h, cap->filling * C, C);

    SqueezeFilm at = {.D = G * wide_load(&film->c[j]) / h_eff, .m = {m_x * inv_m, m_r * inv_m, m_t * inv_m}};
    at.F = at.D * wide_max(at.m.x * v[0] + at.m.r * v[1] + at.m.t * v[2], zero);
    return at;
}
