// A race that is not perfect: waves around it and a spall at the bottom of its groove.
//
//   phi      angle of the ball on its race, from +Y toward +Z at the start; the race turns with its ring
//   w(phi)   sum of A_n cos(n phi + phase_n), n = 1...60: height of the race into the bearing's clearance.  A table of
//            512 cells with cubic Hermite polynomials: C1, and with cells of the width h off by (n h)^4/384 A_n, 8e-4 of
//            A_60 and 4e-7 of A_9.  The law is that of the polynomials, dw/dphi their derivative.
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
//
// A spall on a ball (ball_spall.h) has the same laws, with s along the ball's great circle.  Where it meets a spall of the
// race, both drops add up over the width that both have.
#pragma once

#include "physics/hertz.h"

// Whether any of this race's waves has an amplitude.
static inline bool race_waves_given(const double amplitude[WAVES])
{
    return any_not_zero(amplitude, WAVES);
}

// Whether these are the sizes of a spall.
static inline bool spall_given(double length, double width, double depth)
{
    return length > 0.0 && width > 0.0 && depth > 0.0;
}

// Whether a ball has a spall.
static inline bool ball_spalls_given(const Parameters *p)
{
    bool any = false;
    for (int j = 0; j < Z; j++)
        any |= spall_given(p->ball.spall_length[j], p->ball.spall_width[j], p->ball.spall_depth[j]);
    return any;
}

// Whether a race is not perfect, or a ball has a spall.
static inline bool race_surfaces_given(const Parameters *p)
{
    const bool inner = spall_given(p->inner.spall_length, p->inner.spall_width, p->inner.spall_depth);
    const bool outer = spall_given(p->outer.spall_length, p->outer.spall_width, p->outer.spall_depth);
    return inner || outer || race_waves_given(p->inner.waviness) || race_waves_given(p->outer.waviness) ||
           ball_spalls_given(p);
}

static const double LEAST_LOAD = 1e-30;  // keeps shares of no load from dividing by 0 [N]

// Angle of the point (cosine, sine), -pi...pi.
INLINE wide angle_of(wide cosine, wide sine)
{
    const wide acute = 2.0 * wide_atan(sine / (1.0 + wide_abs(cosine)));
    const wide half = wide_select(wide_above(sine, 0.0), wide_set(PI), wide_set(-PI));
    return wide_select(wide_above(-cosine, 0.0), half - acute, acute);
}

// Height w of the waves and its derivative by phi, of all packets: cubic Hermite polynomials between the table's points.
INLINE void race_surface_waves(const RaceSurface *s, const wide cos_phi[PACKETS], const wide sin_phi[PACKETS],
                               wide w[PACKETS], wide dw[PACKETS])
{
    for (int i = 0; i < PACKETS; i++) w[i] = dw[i] = wide_set(0.0);
    if (!s->wavy) return;

    // cell and place in it, 0...1; a NaN gives cell 0
    const double per_angle = WAVE_CELLS / (2.0 * PI);
    ball_array cell, value[2], slope[2];
    wide place[PACKETS];
    for (int i = 0; i < PACKETS; i++) {
        const wide u = angle_of(cos_phi[i], sin_phi[i]) * per_angle + 0.5 * WAVE_CELLS;
        const wide whole = wide_floor(wide_min(wide_max(u, wide_set(0.0)), wide_set(WAVE_CELLS - 1.0)));
        wide_store(&cell[i * LANE_WIDTH], whole);
        place[i] = u - whole;
    }
    for (int j = 0; j < PACKETS * LANE_WIDTH; j++) {
        const double (*node)[2] = &s->wave[(int)scalar_value(cell[j])];
        for (int i = 0; i < 2; i++) value[i][j] = node[i][0], slope[i][j] = node[i][1];
    }

    // w = w_0 + x (s_0 + x (c_2 + x c_3)), c_2 and c_3 from the other end
    for (int i = 0; i < PACKETS; i++) {
        const int j = i * LANE_WIDTH;
        const wide x = place[i], w_0 = wide_load(&value[0][j]), s_0 = wide_load(&slope[0][j]);
        const wide rise = wide_load(&value[1][j]) - w_0, bend = wide_load(&slope[1][j]) + s_0;
        const wide c_2 = 3.0 * rise - bend - s_0, c_3 = bend - 2.0 * rise;
        w[i] = wide_fma(x, wide_fma(x, wide_fma(x, c_3, c_2), s_0), w_0);
        dw[i] = per_angle * wide_fma(x, wide_fma(3.0 * x, c_3, 2.0 * c_2), s_0);
    }
}

// Spalls at the contacts of a packet, of the race or of the balls.
typedef struct {
    wide track, curvature;  // radius of the path [m], 1/R_x [1/m]
    wide half_length, half_width, u_1, u_2, bend, flank;
} SpallLanes;

// From ball j on, of a race with this surface or of the balls.
INLINE SpallLanes spall_lanes(const RaceSurface *surface, const Spalls *s, int j)
{
    return (SpallLanes){wide_load(&s->track[j]),       wide_set(surface->curvature),
                        wide_load(&s->half_length[j]), wide_load(&s->half_width[j]),
                        wide_load(&s->u_1[j]),         wide_load(&s->u_2[j]),
                        wide_load(&s->bend[j]),        wide_load(&s->flank[j])};
}

// Drop f of the ball's path in a spall and its derivative by the angle from the spall's middle.
INLINE void spall_drop(const SpallLanes *s, wide cosine, wide sine, wide *f, wide *df)
{
    const wide along = 2.0 * s->track * wide_atan(sine / wide_max(1.0 + cosine, wide_set(1e-9)));
    const wide u = wide_min(wide_max(s->half_length - wide_abs(along), wide_set(0.0)), s->u_2);
    const wide over = wide_max(u - s->u_1, wide_set(0.0)),
               slope = s->track * s->curvature * (u - s->bend * over);
    *f = 0.5 * s->curvature * (u * u - s->bend * (over * over));
    *df = wide_select(wide_above(along, 0.0), -slope, slope);
}

// Drop f and its derivative in the spall of a race, at the angle phi on the race.
INLINE void race_surface_drop(const RaceSurface *s, const SpallLanes *spall, wide cos_phi, wide sin_phi,
                              wide *f, wide *df)
{
    const wide cosine = wide_fma(cos_phi, wide_set(s->middle_cos), sin_phi * s->middle_sin);
    const wide sine = wide_fma(sin_phi, wide_set(s->middle_cos), -(cos_phi * s->middle_sin));
    spall_drop(spall, cosine, sine, f, df);
}

// Load and energy of a contact with the approach delta outside the spall and delta - f in it.
typedef struct {
    wide Q, Q_race, Q_ball;  // all of it, that of the strips over the race's spall, over the ball's
    wide U;
    wide delta;  // approach with which a perfect race has the load Q; without contact the negative gap
} SurfaceLoad;

// Part of a perfect contact's load (*S) and of its energy (*E) within half a width.
INLINE void race_surface_shares(wide half_width, const Hertz *hertz, wide delta, wide *S, wide *E)
{
    const wide a = hertz->a_delta * wide_sqrt(delta) + 1e-12, X = wide_min(half_width / a, wide_set(1.0)),
               X_2 = X * X;
    *S = 0.5 * X * (3.0 - X_2);
    *E = 0.125 * X * wide_fma(X_2, wide_fma(wide_set(3.0), X_2, wide_set(-10.0)), wide_set(15.0));
}

// Load without a spall.
INLINE SurfaceLoad race_whole_load(const Hertz *hertz, wide delta)
{
    const wide K = wide_set(hertz->K), none = wide_set(0.0);
    return (SurfaceLoad){hertz_load(K, delta), none, none, hertz_energy(K, delta), delta};
}

// Load with a spall of the race; two: with spalls of balls too.  Strips of two widths: the ball's spall lies over the race's.  Of both, the
// narrower one's strips drop by both.
INLINE SurfaceLoad race_surface_load(const Hertz *hertz, wide delta, const SpallLanes *race, wide f_race,
                                     const SpallLanes *ball, wide f_ball, bool two)
{
    const bits race_wider = wide_above(race->half_width - ball->half_width, 0.0);
    const wide half_width[2] = {wide_select(race_wider, race->half_width, ball->half_width),
                                wide_select(race_wider, ball->half_width, race->half_width)};
    const wide f[2] = {wide_select(race_wider, f_race, f_ball), wide_select(race_wider, f_ball, f_race)};
    const wide flank[2] = {wide_select(race_wider, race->flank, ball->flank),
                           wide_select(race_wider, ball->flank, race->flank)};
    const wide zero = wide_set(0.0), K = wide_set(hertz->K), in = delta - f[0];
    wide S, E, S_in, E_in;
    race_surface_shares(half_width[0], hertz, wide_max(delta, zero), &S, &E);
    race_surface_shares(half_width[0], hertz, wide_max(in, zero), &S_in, &E_in);
    wide Q_narrow = zero, U_narrow = zero, fall = f[0];
    if (two) {
        const wide both = in - f[1];
        wide S_out, E_out, S_both, E_both;
        race_surface_shares(half_width[1], hertz, wide_max(in, zero), &S_out, &E_out);
        race_surface_shares(half_width[1], hertz, wide_max(both, zero), &S_both, &E_both);
        Q_narrow = hertz_load(K, both) * S_both;
        U_narrow = hertz_energy(K, both) * E_both;
        S_in = S_in - S_out, E_in = E_in - E_out;
        fall = fall + wide_min(f[1], flank[1]);
    }
    const wide Q_wide = hertz_load(K, in) * S_in + Q_narrow;
    SurfaceLoad out = {.Q = hertz_load(K, delta) * (1.0 - S) + Q_wide,
                       .Q_race = wide_select(race_wider, Q_wide, Q_narrow),
                       .Q_ball = wide_select(race_wider, Q_narrow, Q_wide),
                       .U = hertz_energy(K, delta) * (1.0 - E) + (hertz_energy(K, in) * E_in + U_narrow)};

    // delta = (Q/K)^(2/3); the ball rests on the flanks before it reaches the bottom where b^2/a_delta^2 < f
    const wide part = out.Q / hertz->K;
    const wide equal = wide_exp(wide_log(wide_max(part, wide_set(1e-300))) * (2.0 / 3.0));
    const wide gap = wide_min(delta - wide_min(fall, flank[0]), zero);
    out.delta = wide_select(wide_above(part, 1e-290), equal, gap);
    return out;
}
