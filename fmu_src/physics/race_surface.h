// A race that is not perfect: waves around it and a spall at the bottom of its groove.
//
//   phi      angle of the ball on its race, from +Y toward +Z at the start; the race turns with its ring
//   w(phi)   sum of A_n cos(n phi + phase_n), n = 1...60: height of the race into the bearing's clearance
//   f(s)     drop of the ball's path in the spall, s = R_t (phi - phi_0) along the track of radius R_t
//
// A ball that enters a spall turns about the spall's edge, because it has a finite size: Ahmadi, Petersen & Howard (2015),
// Mech. Syst. Signal Process. 52-53, 309.  With the distance u = length/2 - |s| to the nearer edge and the reduced
// radius R_x of ball and race:
//
//   f = u^2/(2 R_x)                                up to u_1; then the slope u_1/R_x falls to 0 over the length c:
//   f = (u^2 - (1 + u_1/c)(u - u_1)^2)/(2 R_x)     up to u_2 = u_1 + c; beyond, f stays u_1 u_2/(2 R_x)
//
// The largest drop is the depth where the ball reaches the bottom, else u_2 = length/2.  c = spall_edge, at most
// length/4.  c -> 0 is the rigid ball on two sharp edges, with the drop length^2/(8 R_x) in the middle.
//
// Across the track the contact is an elastic foundation of strips, each with a load k (delta - xi^2/(2 R_y))_+ (Johnson
// 1985, section 4.3): their sum is Hertz' load K delta^1.5 with its pressure (3/4)(1 - x^2), x = xi/a.  The strips over
// the spall, |xi| < b = width/2, are lower by f:
//
//   Q = K delta^1.5 (1 - S(b/a)) + K (delta - f)_+^1.5 S(b/a'),   a, a' at delta, delta - f    S(X) = (3 X - X^3)/2, X <= 1
//   U = (2/5) K (delta^2.5 (1 - E(b/a)) + (delta - f)_+^2.5 E(b/a'))                           E(X) = (15 X - 10 X^3 + 3 X^5)/8
//
// with delta = |L| - (r_g - R) + w.  A narrow spall thus leaves the ball on its flanks.  The force is minus the gradient
// of U: Q n plus a part along the track, as if the normal were tilted.  This part turns the ring, and the ring's rotation
// does the work of the moving profile.  Smoothness: C1.  The small roll of a ring whose tilt turns (rotor.h) is left out.
#pragma once

#include "physics/hertz.h"

// Whether any of this race's waves has an amplitude.
static inline bool race_waves_given(const double amplitude[WAVES])
{
    bool any = false;
    for (int i = 0; i < WAVES; i++) any |= amplitude[i] != 0.0;
    return any;
}

// Whether a race is not perfect.
static inline bool race_surfaces_given(const Parameters *p)
{
    const bool inner =
        p->inner.spall_length > 0.0 && p->inner.spall_width > 0.0 && p->inner.spall_depth > 0.0;
    const bool outer =
        p->outer.spall_length > 0.0 && p->outer.spall_width > 0.0 && p->outer.spall_depth > 0.0;
    return inner || outer || race_waves_given(p->inner.waviness) || race_waves_given(p->outer.waviness);
}

static const double LEAST_LOAD = 1e-30;  // keeps shares of no load from dividing by 0 [N]

// Height w of the waves and its derivative by phi, of all packets, which go through each order together.
INLINE void race_surface_waves(const RaceSurface *s, const wide cos_phi[PACKETS], const wide sin_phi[PACKETS],
                               wide w[PACKETS], wide dw[PACKETS])
{
    // Horner's scheme in z = exp(i phi): w = Re sum c_k z^k, dw/dphi = -Im sum k c_k z^k
    wide re[PACKETS], im[PACKETS], k_re[PACKETS], k_im[PACKETS];
    for (int i = 0; i < PACKETS; i++) re[i] = im[i] = k_re[i] = k_im[i] = wide_set(0.0);
    for (int k = s->waves; k > 0; k--) {
        const double re_k = s->re[k - 1], im_k = s->im[k - 1];
        for (int i = 0; i < PACKETS; i++) {
            const wide a = re[i] + re_k, b = im[i] + im_k, c = k_re[i] + k * re_k, d = k_im[i] + k * im_k;
            re[i] = wide_fma(a, cos_phi[i], -(b * sin_phi[i]));
            im[i] = wide_fma(a, sin_phi[i], b * cos_phi[i]);
            k_re[i] = wide_fma(c, cos_phi[i], -(d * sin_phi[i]));
            k_im[i] = wide_fma(c, sin_phi[i], d * cos_phi[i]);
        }
    }
    for (int i = 0; i < PACKETS; i++) w[i] = re[i], dw[i] = -k_im[i];
}

// Drop f of the ball's path in the spall and its derivative by phi.
INLINE void race_surface_drop(const RaceSurface *s, wide cos_phi, wide sin_phi, wide *f, wide *df)
{
    const wide c = wide_fma(cos_phi, wide_set(s->middle_cos), sin_phi * s->middle_sin);
    const wide sine = wide_fma(sin_phi, wide_set(s->middle_cos), -(cos_phi * s->middle_sin));
    const wide along = 2.0 * s->track * wide_atan(sine / wide_max(1.0 + c, wide_set(1e-9)));
    const wide u = wide_min(wide_max(s->half_length - wide_abs(along), wide_set(0.0)), wide_set(s->u_2));
    const wide over = wide_max(u - s->u_1, wide_set(0.0)),
               slope = s->track * s->curvature * (u - s->bend * over);
    *f = 0.5 * s->curvature * (u * u - s->bend * (over * over));
    *df = wide_select(wide_above(along, 0.0), -slope, slope);
}

// Load and energy of a contact with the approach delta outside the spall and delta - f in it.
typedef struct {
    wide Q, Q_spall;  // all of it, that of the spall's strips
    wide U;
    wide delta;  // approach with which a perfect race has the load Q; without contact the negative gap
} SurfaceLoad;

// Part of a perfect contact's load (*S) and of its energy (*E) within the spall's width.
INLINE void race_surface_shares(const RaceSurface *s, const Hertz *hertz, wide delta, wide *S, wide *E)
{
    const wide a = hertz->a_delta * wide_sqrt(delta) + 1e-12, X = wide_min(s->half_width / a, wide_set(1.0)),
               X_2 = X * X;
    *S = 0.5 * X * (3.0 - X_2);
    *E = 0.125 * X * wide_fma(X_2, wide_fma(wide_set(3.0), X_2, wide_set(-10.0)), wide_set(15.0));
}

INLINE SurfaceLoad race_surface_load(const RaceSurface *s, const Hertz *hertz, wide delta, wide f)
{
    const wide zero = wide_set(0.0), K = wide_set(hertz->K), in = delta - f;
    SurfaceLoad out;
    if (!s->spalled) {
        out.Q = hertz_load(K, delta), out.Q_spall = zero;
        out.U = hertz_energy(K, delta), out.delta = delta;
        return out;
    }
    wide S, E, S_spall, E_spall;
    race_surface_shares(s, hertz, wide_max(delta, zero), &S, &E);
    race_surface_shares(s, hertz, wide_max(in, zero), &S_spall, &E_spall);
    out.Q_spall = hertz_load(K, in) * S_spall;
    out.Q = hertz_load(K, delta) * (1.0 - S) + out.Q_spall;
    out.U = hertz_energy(K, delta) * (1.0 - E) + hertz_energy(K, in) * E_spall;

    // delta = (Q/K)^(2/3); the ball rests on the flanks before it reaches the bottom where b^2/a_delta^2 < f
    const wide part = out.Q / hertz->K, flank = wide_set(s->flank);
    const wide equal = wide_exp(wide_log(wide_max(part, wide_set(1e-300))) * (2.0 / 3.0));
    const wide gap = wide_min(delta - wide_min(f, flank), zero);
    out.delta = wide_select(wide_above(part, 1e-290), equal, gap);
    return out;
}
