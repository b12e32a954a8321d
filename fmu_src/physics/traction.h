// Tangential forces of a lubricated contact: traction of the film, friction of the asperities, rolling
// friction of the inlet.
//
//   film        mu(s) = (A + B s) exp(-C s) - A,  s = |Delta u| / U; four-parameter law of aviation oils, mu(0) = 0
//               mu <= 0.048 at any slip: so the law itself limits the shear stress to gamma p, gamma = 0.048;
//               measured limits depend on temperature and pressure too
//               (Wikstrom & Hoglund (1994), J. Tribol. 116, 612: 5.8 to 7 GPa)
//   asperities  mu_b s / sqrt(s^2 + s_0^2)        on their share of the load
//   share       f_a = exp(-1.8 Lambda^1.2);  Aihara (1987), J. Tribol. 109, 471, eq. 13
//   Lambda      film / roughness, h/R_x = 2.69 U^0.67 G^0.53 W^-0.067 (1 - 0.61 exp(-0.73 k));  Hamrock & Dowson
//               (1977), central film
//   inlet       F_R = 2.86 E' R_x^2 (R_y/R_x)^0.348 G^0.022 U^0.66 W^0.47;  Houpert (1987), as in Balan et al.,
//               Lubricants 3 (2015), 222
//   heating     by shear in the inlet, races only: factor 1/(1 + 1.84e-9 (n d_m)^1.28 nu^0.64) of F_R
//   starvation  races only: factor exp(-K_rs nu n (d + D) sqrt(K_Z/(2 (D - d)))) of F_R
//               SKF, Rolling Bearings (catalogue, 2018)
//               n d_m [r/min mm] from U = n d_m (1 - gamma^2)/4, D - d = ball diameter/0.3, nu [mm2/s]
//   thermal     the race films are 3.94/(3.94 + L^0.62) times as thick, L = eta beta u^2/k;
//               Murch & Wilson (1975), J. Lubr. Technol. 97, 212
//
// with U = eta u/(E' R_x), W = Q/(E' R_x^2), G = alpha E', E' = 2 E_star, u the mean surface speed.  Powers
// are computed as exp(p ln), so that all of them share ln U and ln Q.  Load and speed have floors, so that
// these forces are C1 in approach and speed.
#pragma once

#include "numbers/vec.h"

// Load [N] below which inlet friction is linear in the load and the film no longer depends on it.
static const double Q_FLOOR = 1.0;

typedef struct {
    vec F_s, F_c;     // on the ball: at the contact point, through the ball's centre [N]
    vec M;            // moment of F_s about the ball's centre (with spin) [N.m]
    wide g;           // |traction| / |slip|: the stiff rate of the contact [N.s/m]
    wide g_spin;      // moment / spin about the normal, by the slices beside the centre [N.m.s]
    wide U;           // mean surface speed with its floor [m/s]
    wide dissipated;  // all of it, by the inlet's rolling friction, by spin about the normal [W]
    wide inlet_dissipated, spin_dissipated;
} Tangential;

// ln Lambda at mean speed U and load Q; ln_Lambda_1 at U = 1 m/s, Q = 1 N.
INLINE wide traction_ln_film(wide ln_Lambda_1, wide ln_U, wide ln_Q)
{
    return ln_Lambda_1 + 0.67 * ln_U - 0.067 * ln_Q;
}

// ln of the thermal factor on a film; ln_thermal: ln L at U = 1 m/s.
INLINE wide traction_ln_thermal(wide ln_thermal, wide ln_U)
{
    return -wide_log(1.0 + wide_exp(0.62 * (ln_thermal + 2.0 * ln_U)) / 3.94);
}

// Share of the load that asperities carry.
INLINE wide traction_asperity_share(wide ln_Lambda)
{
    return wide_exp(-1.8 * wide_exp(1.2 * ln_Lambda));
}

// Traction coefficients at the slide-roll ratios s of n <= ABREAST packets, with the asperity shares f_a
// (zero where there is only film).
INLINE void traction_mu(const Parameters *p, int n, const wide s[], const wide f_a[], bool mixed, wide mu[])
{
    const double A = p->oil.A, B = p->oil.B, C_log2_e = 1.4426950408889634 * p->oil.C;
    wide power[ABREAST], root_2[ABREAST], inv_root[ABREAST];
    for (int i = 0; i < n; i++) power[i] = s[i] * -C_log2_e;
    wide_power_of_2(n, power, power);
    for (int i = 0; i < n; i++)
        mu[i] = wide_fma(wide_fma(wide_set(B), s[i], wide_set(A)), power[i], wide_set(-A));
    if (!mixed) return;
    for (int i = 0; i < n; i++) root_2[i] = wide_fma(s[i], s[i], wide_set(p->oil.s_0 * p->oil.s_0));
    wide_inv_sqrt(n, root_2, inv_root);
    for (int i = 0; i < n; i++)
        mu[i] = wide_fma(f_a[i], wide_fma(p->oil.mu_b * s[i], inv_root[i], -mu[i]), mu[i]);
}

// Rolling friction F_R of the inlet; rolling: F_R at U = 1 m/s, Q = 1 N.  W^0.47 is taken as W (W +
// W_floor)^-0.53, linear at small loads.
INLINE wide traction_inlet(wide rolling, wide ln_U, wide Q, wide ln_Q)
{
    return rolling * Q * wide_exp(0.66 * ln_U - 0.53 * ln_Q);
}

// F_R of a race, with shear heating and starvation of its inlet.
INLINE wide traction_race_inlet(const Derived *d, wide rolling, wide U, wide ln_U, wide Q, wide ln_Q)
{
    const wide F_R = rolling * Q * wide_exp(0.66 * ln_U - 0.53 * ln_Q - d->starvation * U);
    return F_R / (1.0 + wide_exp(d->ln_heating + 1.28 * ln_U));
}
