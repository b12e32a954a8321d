// Land and outer ring: short journal bearing whose film carries load where the gap closes, and dry
// contact where e exceeds the clearance C.
//
//         outer ring       e    land's centre from the ring's axis, eps = e/C, gap h = C - e.n(phi)
//      .-----------.       V    pure squeeze velocity e_dot - (omega/2) e_x x e: the land turns, the ring stands
//     /   .-----.   \      p = 6 eta (V.n)/h^3 (L^2/4 - z^2) over the width L where V.n > 0, else cavitated
//    |   (   o e |   |     F = -eta R L^3 int n (V.n)/h^3 dphi = -kappa (I_c V + I_s V_perp)
//     \   '-----'   /      kappa = eta R L^3/C^3,  V_perp = e_x x V
//      '-----------'
//   with a = eps.V/|V|, b = eps.V_perp/|V|, q^2 = 1 - eps^2, S = pi/2 + atan(a/q), phi = -pi/2 ... pi/2:
//   I_c = int cos^2 phi/(1 - a cos phi - b sin phi)^3 dphi = 3 a/q^4 + S (q^2 + 3 a^2)/q^5
//   I_s = int sin phi cos phi/(...)^3 dphi = 2 b/q^4 + a^2 b/(q^4 (1 - b^2)) + 3 a b S/q^5
//   I_t = int sin^2 phi/(...)^3 dphi = a/(q^2 (1 - b^2)) + 3 a b^2/(q^4 (1 - b^2)) + 2 a b^2/(q^2 (1 - b^2)^2)
//                                      + S (q^2 + 3 b^2)/q^5
//
// An outer ring that moves (outer_ring.h): e, e_dot and omega are those against its material, and the forces are along
// its axes.  For a ring that turns this is Reynolds' equation for two turning surfaces: squeeze e_dot -
// (omega + omega_e)/2 e_x x e.
//
// Steady rotation gives Ocvirk's force (a = 0), pure squeeze that of the pi-film.  F is the gradient of an
// integral of (V.n)^2/h^3 over the closing half, so that -dF/dV = kappa (I_c, I_s; I_s, I_t) exactly: these
// are the stiff rates.  V contains omega, so that the pressure turns the land by M_x = F.dV/domega = (F_y e_z - F_z e_y)/2, half of
// the pressure's moment about the outer ring's axis, beside Couette's torque; the film's loss is Couette's omega^2 - F.V.
//
// Shear heats the film between walls at the oil's temperature; viscosity exp(-beta (T - T_wall)).  In plane Couette
// flow the shear stress then is asinh(s)/(s sqrt(1 + s^2)) times the isothermal one, s^2 = Na/8, Na = beta eta
// U^2/k, whatever the gap (Nahme (1940), Ing.-Archiv 11, 191); the film's viscosity is lower by this factor.
//
// A half grows by its centrifugal load, so that C = C_0 - g omega^2, omega: its speed in space, g: by the half's
// finite elements with bonded joints (rivet_model/half_lands.py).  The growth is static, and the films do not feel its rate.
// Where the spin changes, growth puts the power 2 g omega omega_dot K_land (e - C)^1.5 into the dry contact.
//
// The force is regular at e = 0, C0 in V (cavitation) and C1 elsewhere.  At the wall the film stays finite:
// q^2 is g_0 at the wall and tends to g_0/2 behind it, and eps is capped at 1.2.  Behind the wall the dry
// contact F = K_land (e - C)^1.5 carries.
//
// A half bends under the pressure on its rim (half_path.h): harmonics G_p = int P exp(i p theta) dtheta of its
// radial load P, outward positive, in the frame of the half.  The pressure's shape over the angle is (V.n)/h^3, its size
// that of the film's force; Sommerfeld's substitution from the narrowest gap,
//
//     cos phi = (eps + cos psi)/(1 + eps cos psi),  dphi/h^3 ~ (1 + eps cos psi)^2 dpsi,   q^2 = 1 - eps^2,
//
// spreads the points of the sum so that it is exact but for the film's ends.  The dry contact loads the rim at the
// narrowest gap of a round land.  Of elastic halves the bending changes the film: land_bent.h.
#include "physics/land_film.h"

#include "physics/hertz.h"
#include "physics/land_bent.h"
#include "physics/outer_ring.h"
#include "physics/traction.h"

static const double EPS_CAP = 1.2;

// q^2: 1 - eps^2 inside, g_0 at the wall, and g_0/2 far behind the wall.
INLINE wide land_film_gap(wide eps, double g_0)
{
    const double floor = 0.5 * g_0;
    const wide above = 1.0 - eps * eps - floor;
    return floor + 0.5 * (above + wide_sqrt(above * above + 8.0 * floor * floor));
}

// A film's force F and its rates -dF/dV.
typedef struct {
    wide F_y, F_z, yy, yz, zz;
} JournalFilm;

// cap: limiter of the eccentricity over the clearance; eta: kappa of the head of this file.
INLINE JournalFilm journal_film(wide e_y, wide e_z, wide V_y, wide V_z, wide cap, wide q2, wide eta)
{
    const wide inv_V = 1.0 / wide_sqrt(V_y * V_y + V_z * V_z + 1e-30);
    const wide inv_q = 1.0 / wide_sqrt(q2), inv_q2 = inv_q * inv_q, kappa = eta * inv_q2 * inv_q2;
    const wide n_y = V_y * inv_V, n_z = V_z * inv_V;
    const wide a = (e_y * n_y + e_z * n_z) * cap, b = (e_z * n_y - e_y * n_z) * cap;

    // the integrals at the head of this file, times q^4
    const wide inv_c2 = 1.0 / (q2 + a * a);                    // c^2 = 1 - b^2
    const wide S = inv_q * (0.5 * PI + wide_atan(a * inv_q));  // S/q
    const wide I_c = 3.0 * a + S * (q2 + 3.0 * a * a);
    const wide I_s = 2.0 * b + a * a * b * inv_c2 + 3.0 * a * b * S;
    const wide I_t = a * inv_c2 * (q2 + b * b * (3.0 + 2.0 * q2 * inv_c2)) + S * (q2 + 3.0 * b * b);

    return (JournalFilm){
        -kappa * (I_c * V_y - I_s * V_z),
        -kappa * (I_c * V_z + I_s * V_y),
        kappa * (I_c * n_y * n_y - 2.0 * I_s * n_y * n_z + I_t * n_z * n_z),
        kappa * ((I_c - I_t) * n_y * n_z + I_s * (n_y * n_y - n_z * n_z)),
        kappa * (I_c * n_z * n_z + 2.0 * I_s * n_y * n_z + I_t * n_y * n_y),
    };
}

// Viscosity of the heated film / eta; s_2: Na/8.
INLINE wide land_film_heating(wide s_2)
{
    const wide s = wide_sqrt(s_2), root = wide_sqrt(1.0 + s_2);
    const wide heated = wide_log(s + root) / (wide_max(s, wide_set(1e-3)) * root);
    return wide_select(wide_above(s, 1e-3), heated, 1.0 - (2.0 / 3.0) * s_2);
}

// A land's middle and its motion against the outer ring, in the plane across the outer ring's axis.
typedef struct {
    wide e_y, e_z, v_y, v_z, omega;
} LandMotion;

// Position and velocity of the lands' middles, x + a x_land and v + Omega x a x_land = v + a_dot x_land; the outer
// ring is at rest in its place.
INLINE LandMotion land_motion(const Rotor *h0, const Rotor *h1, wide x_land)
{
    return (LandMotion){wide_pair(h0->x[1], h1->x[1]) + x_land * wide_pair(h0->a[1], h1->a[1]),
                        wide_pair(h0->x[2], h1->x[2]) + x_land * wide_pair(h0->a[2], h1->a[2]),
                        wide_pair(h0->v[1], h1->v[1]) + x_land * wide_pair(h0->a_dot[1], h1->a_dot[1]),
                        wide_pair(h0->v[2], h1->v[2]) + x_land * wide_pair(h0->a_dot[2], h1->a_dot[2]),
                        wide_pair(h0->Omega[0], h1->Omega[0])};
}

// Position and velocity of the lands' middles against the outer ring's material, along its axes.
INLINE LandMotion land_motion_against(const Rotor *outer, const Rotor *h0, const Rotor *h1, wide x_land)
{
    const Rotor *half[2] = {h0, h1};
    scalar motion[5][2];
    for (int h = 0; h < 2; h++) {
        const scalar x = wide_lane(x_land, h % HALVES);
        scalar p[3], v[3], turn[3], carried[3];
        for (int i = 0; i < 3; i++) {
            p[i] = half[h]->x[i] + x * half[h]->a[i] - outer->x[i];
            turn[i] = half[h]->Omega[i] - outer->Omega[i];
        }
        cross3(outer->Omega, p, carried);
        for (int i = 0; i < 3; i++) v[i] = half[h]->v[i] + x * half[h]->a_dot[i] - outer->v[i] - carried[i];
        motion[0][h] = dot3(p, outer->b_y), motion[1][h] = dot3(p, outer->b_z);
        motion[2][h] = dot3(v, outer->b_y), motion[3][h] = dot3(v, outer->b_z);
        motion[4][h] = dot3(turn, outer->a);
    }
    return (LandMotion){wide_pair(motion[0][0], motion[0][1]), wide_pair(motion[1][0], motion[1][1]),
                        wide_pair(motion[2][0], motion[2][1]), wide_pair(motion[3][0], motion[3][1]),
                        wide_pair(motion[4][0], motion[4][1])};
}

// Adds force (F_y, F_z) and moment M_x along the outer ring's axes, at the land x from the half's centre, to
// its wrench.
INLINE void add_wrench_along(const Rotor *outer, scalar x, scalar F_y, scalar F_z, scalar M_x, Rotor *half)
{
    scalar F[3], arm[3], lever[3];
    for (int i = 0; i < 3; i++) {
        F[i] = F_y * outer->b_y[i] + F_z * outer->b_z[i];
        arm[i] = half->a[i] * x;
    }
    cross3(arm, F, lever);
    for (int i = 0; i < 3; i++) {
        half->F[i] += F[i];
        half->M[i] += M_x * outer->a[i] + lever[i];
    }
}

// Adds weight times cos and sin of p theta for directions (cos, sin) of theta, to sums over the lanes.
INLINE void add_harmonics(wide along, wide across, wide weight, wide re[LAND_HARMONICS],
                          wide im[LAND_HARMONICS])
{
    const wide twice = 2.0 * along;
    wide c_0 = weight, c_1 = weight * along, s_0 = wide_set(0.0), s_1 = weight * across;
    for (int p = 0; p < LAND_HARMONICS; p++) {
        re[p] += c_0;
        im[p] += s_0;
        const wide c_2 = wide_fma(twice, c_1, -c_0), s_2 = wide_fma(twice, s_1, -s_0);
        c_0 = c_1, s_0 = s_1, c_1 = c_2, s_1 = s_2;
    }
}

// Harmonics of sums over eight lanes.
INLINE void sum_load(wide re[EIGHTHS][LAND_HARMONICS], wide im[EIGHTHS][LAND_HARMONICS], LandLoad *load)
{
    wide_column_sums(LAND_HARMONICS, LAND_HARMONICS, re[0], load->re);
    wide_column_sums(LAND_HARMONICS, LAND_HARMONICS, im[0], load->im);
}

// Harmonics of the load on a round rim.  e, V: eccentricity [m] and pure squeeze velocity [m/s] along the half's axes; q2: gap function;
// force, dry: sizes of the film's force and of the dry contact's [N].
INLINE void land_load(const Derived *d, const scalar e[2], const scalar V[2], scalar q2, scalar force,
                      scalar dry, LandLoad *load)
{
    const scalar inv_e = 1.0 / scalar_sqrt(e[0] * e[0] + e[1] * e[1] + 1e-30);
    const scalar inv_V = 1.0 / scalar_sqrt(V[0] * V[0] + V[1] * V[1] + 1e-30);
    const scalar u[2] = {e[0] * inv_e, e[1] * inv_e}, n[2] = {V[0] * inv_V, V[1] * inv_V};
    const scalar inside = scalar_min(q2, 1.0);
    const wide eps = wide_set(scalar_sqrt(scalar_max(1.0 - inside, 1e-30)));
    const wide q = wide_set(scalar_sqrt(scalar_max(inside, 1e-30)));
    const wide u_0 = wide_set(u[0]), u_1 = wide_set(u[1]), n_0 = wide_set(n[0]), n_1 = wide_set(n[1]);
    wide re[EIGHTHS][LAND_HARMONICS], im[EIGHTHS][LAND_HARMONICS];
    for (int i = 0; i < EIGHTHS; i++)
        for (int p = 0; p < LAND_HARMONICS; p++) re[i][p] = im[i][p] = wide_set(0.0);
    for (int first = 0; first < LAND_POINTS; first += 8)
        for (int i = 0; i < EIGHTHS; i++) {
            const int m = first + i * LANE_WIDTH;
            const wide c_psi = wide_load(&d->land_cos[m]), s_psi = wide_load(&d->land_sin[m]);
            const wide one = 1.0 + eps * c_psi, inv = 1.0 / one;
            const wide cosine = (eps + c_psi) * inv, sine = q * s_psi * inv;
            const wide along = cosine * u_0 - sine * u_1, across = cosine * u_1 + sine * u_0;
            const wide closing = wide_max(along * n_0 + across * n_1, wide_set(0.0));
            if (!wide_any(wide_above(closing, 0.0))) continue;
            add_harmonics(along, across, closing * one * one, re[i], im[i]);
        }
    sum_load(re, im, load);
    const scalar size = -force / scalar_sqrt(load->re[1] * load->re[1] + load->im[1] * load->im[1] + 1e-30);
    for (int p = 0; p < LAND_HARMONICS; p++) load->re[p] *= size, load->im[p] *= size;
    if (scalar_value(dry) == 0.0) return;
    const scalar twice = 2.0 * u[0];
    scalar c_0 = -dry, c_1 = -dry * u[0], s_0 = 0.0, s_1 = -dry * u[1];
    for (int p = 0; p < LAND_HARMONICS; p++) {
        load->re[p] += c_0;
        load->im[p] += s_0;
        const scalar c_2 = twice * c_1 - c_0, s_2 = twice * s_1 - s_0;
        c_0 = c_1, s_0 = s_1, c_1 = c_2, s_1 = s_2;
    }
}

// Adds one to the other, times a size.
INLINE void add_load(scalar size, const LandLoad *load, LandLoad *to)
{
    for (int p = 0; p < LAND_HARMONICS; p++) {
        to->re[p] += size * load->re[p];
        to->im[p] += size * load->im[p];
    }
}

// Harmonics of the load on a bent rim: the film's with the size of its force along its direction, the dry contact's by the bedding.
INLINE void bent_load(const BentGrid *grid, const LandPressure *pressure, LandLoad *load)
{
    wide film_re[EIGHTHS][LAND_HARMONICS], film_im[EIGHTHS][LAND_HARMONICS];
    wide dry_re[EIGHTHS][LAND_HARMONICS], dry_im[EIGHTHS][LAND_HARMONICS];
    LandLoad by_film, by_dry;
    const bool dry = scalar_value(pressure->dry) > 0.0;
    memset(load, 0, sizeof *load);
    memset(film_re, 0, sizeof film_re);
    memset(film_im, 0, sizeof film_im);
    if (dry) {
        memset(dry_re, 0, sizeof dry_re);
        memset(dry_im, 0, sizeof dry_im);
    }
    for (int first = 0; first < BENT_POINTS; first += 8)
        for (int i = 0; i < EIGHTHS; i++) {
            const int m = first + i * LANE_WIDTH;
            wide b[SQUEEZE];
            for (int k = 0; k < SQUEEZE; k++) b[k] = wide_load(&grid->b[k][m]);
            const wide W = wide_max(bent_dot(pressure->V, pressure->rim_V, b), wide_set(0.0));
            const wide film = wide_load(&grid->stiff[m]) * W;
            if (wide_any(wide_above(film, 0.0))) add_harmonics(b[0], b[1], film, film_re[i], film_im[i]);
            if (dry) add_harmonics(b[0], b[1], wide_load(&grid->behind[m]), dry_re[i], dry_im[i]);
        }
    sum_load(film_re, film_im, &by_film);
    const scalar F_y = by_film.re[1], F_z = by_film.im[1];
    add_load(-pressure->felt * scalar_max(-(pressure->film[0] * F_y + pressure->film[1] * F_z), 0.0) /
                 (F_y * F_y + F_z * F_z + 1e-30),
             &by_film, load);
    if (!dry) return;
    sum_load(dry_re, dry_im, &by_dry);
    add_load(-pressure->felt * pressure->dry / (by_dry.re[0] + 1e-30), &by_dry, load);
}

// A vector (y, z) across the outer ring's axis along the axes of a half.
INLINE void land_turn(const Rotor *outer, const Rotor *half, scalar y, scalar z, scalar along[2])
{
    const scalar F[3] = {outer ? y * outer->b_y[0] + z * outer->b_z[0] : 0.0 * y,
                         outer ? y * outer->b_y[1] + z * outer->b_z[1] : y,
                         outer ? y * outer->b_y[2] + z * outer->b_z[2] : z};
    along[0] = dot3(F, half->b_y), along[1] = dot3(F, half->b_z);
}

// Action of a land on its half: force along the outer ring's axes, moment about its axis, load of the dry contact without
// damping, rate -dM/domega, energy of the dry contact and its rate.
typedef struct {
    scalar F[2], M_x, N_0, spin, stored, stored_rate;
} LandForce;

// Motion of the land against the outer ring: velocity along its axes, speed.
typedef struct {
    scalar v[2], omega;
} LandRates;

// Friction of dry contact and asperities, in a direction as that of a round land: adds to the force (y, z) and sets the moment
// and its rate.  along: int of the load times n, all: int of the load.
INLINE void bent_friction(const Parameters *p, const LandRates *at, const scalar along[2], scalar all,
                          LandForce *force)
{
    const scalar size = scalar_sqrt(along[0] * along[0] + along[1] * along[1] + 1e-30), R = 0.5 * p->cage.D_o;
    const scalar u[2] = {along[0] / size, along[1] / size};
    const scalar slip = at->v[1] * u[0] - at->v[0] * u[1] + at->omega * R;
    const scalar g = p->cage.mu_land / scalar_sqrt(slip * slip + p->cage.v_c * p->cage.v_c),
                 F_t = -g * slip * size;
    force->F[0] -= F_t * u[1];
    force->F[1] += F_t * u[0];
    force->M_x = -R * g * slip * all;
    force->spin = R * R * g * all;
}

// Sets the variables of the pressure on the bent rim of half h.  e, V: along the outer ring's axes; T: from these to the half's;
// kappa_C3: of its film.
INLINE void bent_motion(Work *w, int h, const LandRates *at, const scalar e[2], const scalar V[2],
                        scalar T[2][2], scalar C, scalar kappa_C3)
{
    LandPressure *pressure = &w->pressure[h];
    for (int i = 0; i < 2; i++) {
        pressure->e[i] = T[i][0] * e[0] + T[i][1] * e[1];
        pressure->V[i] = T[i][0] * V[0] + T[i][1] * V[1];
        pressure->v[i] = T[i][0] * at->v[0] + T[i][1] * at->v[1];
    }
    pressure->C = C, pressure->kappa_C3 = kappa_C3;
    memcpy(pressure->rim, w->rim[h], sizeof pressure->rim);
    memcpy(pressure->rim_v, w->rim_v[h], sizeof pressure->rim_v);
    pressure->by_spin[0] = 0.5 * pressure->e[1], pressure->by_spin[1] = -0.5 * pressure->e[0];
    for (int i = 0; i < RIM; i += 2) {
        const double waves = 0.5 * (2 + i / 2);
        pressure->by_spin[2 + i] = -waves * pressure->rim[i + 1],
                              pressure->by_spin[3 + i] = waves * pressure->rim[i];
    }
    for (int i = 0; i < RIM; i++)
        pressure->rim_V[i] = pressure->rim_v[i] + at->omega * pressure->by_spin[2 + i];
}

// Film and dry contact on the rim of half h, at the velocities that films leave where they are too stiff for predicted ones.
INLINE void bent_pressure(const Model *model, Work *w, int h, scalar sum[BENT_SUMS])
{
    LandPressure *pressure = &w->pressure[h];
    bent_sums(model, pressure, &w->bent[h], sum);
    memcpy(pressure->at, pressure->V, sizeof pressure->V);
    memcpy(&pressure->at[2], pressure->rim_V, sizeof pressure->rim_V);
#ifndef DUAL
    LandPressure seen;
    if (w->squeeze_by[h][0] > 0.0 && bent_foresee(w, h, &sum[BENT_FILM], sum[BENT_ROUGH], &seen)) {
        bent_sums(model, &seen, &w->bent[h], sum);
        memcpy(pressure->at, seen.at, sizeof pressure->at);
    }
#endif
}

// The land of half h whose rim bends.  e, V: along the outer ring's axes; heated: viscosity of the film / eta.
INLINE LandForce bent_land(const Model *model, Work *w, int h, const Rotor *outer, const LandRates *at,
                           const scalar e[2], const scalar V[2], scalar C, scalar heated)
{
    const Derived *d = model->d;
    LandPressure *pressure = &w->pressure[h];
    scalar T[2][2], column[2], sum[BENT_SUMS];  // T: from the outer ring's axes to the half's
    for (int k = 0; k < 2; k++) {
        land_turn(outer, &w->half[h], k == 0 ? 1.0 : 0.0, k == 0 ? 0.0 : 1.0, column);
        T[0][k] = column[0], T[1][k] = column[1];
    }
    bent_motion(w, h, at, e, V, T, C, d->kappa * heated * (d->C_land * d->C_land * d->C_land));
    bent_pressure(model, w, h, sum);

    // forces and friction
    LandForce force = {
        .N_0 = sum[BENT_N_0], .stored = sum[BENT_STORED], .stored_rate = sum[BENT_STORED_RATE]};
    scalar along[2];
    for (int k = 0; k < 2; k++) {
        force.F[k] = along[k] = 0.0;
        for (int i = 0; i < 2; i++) {
            force.F[k] -= T[i][k] * (sum[BENT_FILM + i] + sum[BENT_DRY + i]);
            along[k] += T[i][k] * (sum[BENT_DRY + i] + sum[BENT_ROUGH + 1 + i]);
        }
    }
    bent_friction(model->p, at, along, sum[BENT_N] + sum[BENT_ROUGH], &force);
    const scalar torque = heated * d->couette * (d->C_land / C) * (0.5 / PI) * sum[BENT_COUETTE];
    force.M_x -= torque * at->omega;
    force.spin += torque;
    for (int i = 0; i < SQUEEZE; i++) {
        pressure->film[i] = -sum[BENT_FILM + i];
        force.M_x += pressure->film[i] * pressure->by_spin[i];
    }
    for (int i = 0; i < RIM; i++) pressure->rim_force[i] = pressure->film[2 + i] - sum[BENT_DRY + 2 + i];
    pressure->dry = sum[BENT_N], pressure->stiffness = sum[BENT_STIFFNESS];
    pressure->felt = land_share(d, pressure);
    memcpy(pressure->waves, &sum[BENT_RATES], sizeof pressure->waves);
    const scalar *waves = pressure->waves, D[3] = {waves[0] + waves[3], waves[4], waves[0] - waves[3]};
    scalar rate[3];
    turn_rates(T, D, rate);
    w->film[h] = (LandFilm){rate[0], rate[1], rate[2], force.spin};
    return force;
}

// The lands of HALVES rigid halves side by side, beginning with half `first`.  V: vector (y, z).
INLINE void round_lands(const Model *model, Work *w, int first, const Rotor *outer, const LandMotion *land,
                        const wide V[2], wide C, wide heated, LandForce force[HALVES])
{
    const Parameters *p = model->p;
    const Derived *d = model->d;

    // film
    const wide e_2 = land->e_y * land->e_y + land->e_z * land->e_z + 1e-30, inv_e = 1.0 / wide_sqrt(e_2);
    const wide inv_C = 1.0 / C, e = e_2 * inv_e, eps = e * inv_C, narrow = d->C_land * inv_C;
    const wide u_y = land->e_y * inv_e, u_z = land->e_z * inv_e;
    const wide q2 = land_film_gap(eps, p->cage.g_0), cap = wide_min(inv_C, EPS_CAP * inv_e);
    const JournalFilm film = journal_film(land->e_y, land->e_z, V[0], V[1], cap, q2,
                                          d->kappa * heated * (narrow * narrow * narrow));
    const wide size_2 = film.F_y * film.F_y + film.F_z * film.F_z;
    const wide couette = d->couette * heated * (1.0 / wide_sqrt(q2)) * narrow;  // torque / speed

    // dry contact where the gap is smallest, which stores a part of the power; N_mu: all that rubs, in mixed lubrication asperities too,
    // with their share of the film's force
    const wide K = wide_set(p->cage.K_land), pen = e - C, pen_dot = land->v_y * u_y + land->v_z * u_z;
    const wide N_0 = hertz_load(K, pen), N = hertz_damped(N_0, wide_set(p->cage.lambda), pen_dot);
    wide N_mu = N;
    if (p->scene.lubrication == LUBRICATION_MIXED)
        N_mu +=
            traction_asperity_share(d->ln_land + wide_log(q2 / (narrow * (1.0 + eps)))) * wide_sqrt(size_2);
    const wide stored = hertz_energy(K, pen), stored_rate = N_0 * pen_dot;

    // friction along t = e_x x u
    const wide R = wide_set(0.5 * p->cage.D_o), slip = land->v_z * u_y - land->v_y * u_z + land->omega * R;
    const wide g = p->cage.mu_land * N_mu / wide_sqrt(slip * slip + p->cage.v_c * p->cage.v_c);
    const wide F_t = -g * slip;
    const wide F_y = film.F_y + (-N * u_y - F_t * u_z), F_z = film.F_z + (-N * u_z + F_t * u_y);
    const wide M_x = R * F_t - couette * land->omega + 0.5 * (film.F_y * land->e_z - film.F_z * land->e_y);

    const wide size = wide_sqrt(size_2 + 1e-30), spin = couette + g * R * R;
    for (int i = 0; i < HALVES; i++) {
        const int h = first + i;
        force[i] = (LandForce){{wide_lane(F_y, i), wide_lane(F_z, i)},
                               wide_lane(M_x, i),
                               wide_lane(N_0, i),
                               wide_lane(spin, i),
                               wide_lane(stored, i),
                               wide_lane(stored_rate, i)};
        w->film[h] =
            (LandFilm){wide_lane(film.yy, i), wide_lane(film.yz, i), wide_lane(film.zz, i), force[i].spin};
        scalar e_h[2], V_h[2];
        land_turn(outer, &w->half[h], wide_lane(land->e_y, i), wide_lane(land->e_z, i), e_h);
        land_turn(outer, &w->half[h], wide_lane(V[0], i), wide_lane(V[1], i), V_h);
        land_load(d, e_h, V_h, wide_lane(q2, i), wide_lane(size, i), wide_lane(N, i), &w->land[h]);
    }
}

// Adds force and moment of a land at x from its half's centre to the half, and the land's energy and power.  on_rim: power of the rim's bending.
INLINE void add_land(const Derived *d, Work *w, int h, const Rotor *outer, scalar x, const LandRates *at,
                     const LandForce *force, scalar on_rim)
{
    Rotor *half = &w->half[h];
    const scalar F_y = force->F[0], F_z = force->F[1];
    if (outer == NULL) {
        const scalar arm[3] = {half->a[0] * x, half->a[1] * x, half->a[2] * x};
        half->F[1] += F_y;
        half->F[2] += F_z;
        half->M[0] += force->M_x + arm[1] * F_z - arm[2] * F_y;
        half->M[1] += -arm[0] * F_z;
        half->M[2] += arm[0] * F_y;
    } else
        add_wrench_along(outer, x, F_y, F_z, force->M_x, half);
    w->land_elastic += force->stored;
    w->land_growth[h] = force->N_0 * land_growth_rate(d, half->s + w->frame_omega);
    w->cage_dissipated -=
        F_y * at->v[0] + F_z * at->v[1] + force->M_x * at->omega + on_rim + force->stored_rate;
}

// The lands of HALVES halves side by side, beginning with half `first`.  outer: the outer ring, NULL if it is
// at rest in its place.
INLINE void land_film_packet(const Model *model, Work *w, int first, const Rotor *outer)
{
    const Parameters *p = model->p;
    const Derived *d = model->d;
    Rotor *h0 = &w->half[first], *h1 = &w->half[first + HALVES - 1];
    const wide x_land = wide_pair(first == 0 ? -p->cage.land_x : p->cage.land_x, p->cage.land_x);
    const LandMotion land =
        outer == NULL ? land_motion(h0, h1, x_land) : land_motion_against(outer, h0, h1, x_land);
    const wide omega = land.omega;
    const wide V[2] = {land.v_y + 0.5 * omega * land.e_z, land.v_z - 0.5 * omega * land.e_y};
    const scalar spin[2] = {h0->s + w->frame_omega, h1->s + w->frame_omega};  // in space
    const wide C = wide_pair(land_clearance(d, spin[0]), land_clearance(d, spin[1]));
    const wide heated = d->nahme > 0.0 ? land_film_heating(d->nahme * omega * omega) : wide_set(1.0);
    LandForce force[HALVES];
    if (!model->modes) round_lands(model, w, first, outer, &land, V, C, heated, force);
    for (int i = 0; i < HALVES; i++) {
        const int h = first + i;
        const LandRates at = {{wide_lane(land.v_y, i), wide_lane(land.v_z, i)}, wide_lane(omega, i)};
        scalar on_rim = 0.0;  // power
        if (model->modes) {
            const scalar e[2] = {wide_lane(land.e_y, i), wide_lane(land.e_z, i)};
            const scalar squeeze[2] = {wide_lane(V[0], i), wide_lane(V[1], i)};
            force[i] = bent_land(model, w, h, outer, &at, e, squeeze, wide_lane(C, i), wide_lane(heated, i));
            const LandPressure *pressure = &w->pressure[h];
            for (int n = 0; n < RIM; n++) on_rim += pressure->rim_force[n] * pressure->rim_v[n];
        }
        add_land(d, w, h, outer, wide_lane(x_land, i), &at, &force[i], on_rim);
    }
}

void land_film_loads(const Work *w, LandLoad load[2])
{
    for (int h = 0; h < 2; h++) {
        const LandPressure *pressure = &w->pressure[h];
        if (land_is_felt(w, h))
            bent_load(&w->bent[h], pressure, &load[h]);
        else
            memset(&load[h], 0, sizeof load[h]);
    }
}

scalar land_growth_power(const Model *model, const Work *w, const scalar *y_dot)
{
    const double frame = model->ring_load->frame_omega_dot;
    return w->land_growth[0] * (y_dot[Y_CAGE_S] + frame) + w->land_growth[1] * (y_dot[Y_CAGE_S + 1] + frame);
}

void land_film_force(const Model *model, Work *w)
{
    w->land_elastic = w->cage_dissipated = w->land_dissipated = 0.0;
    if (!model->d->guided) {  // balls guide the cage: no film, no contact with the outer ring
        memset(w->film, 0, sizeof w->film);
        memset(w->land_growth, 0, sizeof w->land_growth);
        memset(w->pressure, 0, sizeof w->pressure);
        memset(w->land, 0, sizeof w->land);
        return;
    }
    const bool moves = outer_ring_moves(model->ring_load);
    Rotor outer;
    if (moves) {
        outer = outer_ring(model->ring_load);
        rotor_body_axes(&outer, 1.0, 0.0);
    }
    for (int first = 0; first < 2; first += HALVES) land_film_packet(model, w, first, moves ? &outer : NULL);
    w->land_dissipated = w->cage_dissipated;  // before drag_cage adds its power
}
