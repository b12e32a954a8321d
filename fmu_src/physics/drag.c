// Drag in the mixture between the rings.
//
//   density    rho = X rho_oil + (1 - X) rho_air, X = 10^5 W^0.37/(n d_m^1.7), at most 1: volume fraction of oil with
//              the flow W [cm3/min] through the bearing, n [r/min], d_m [mm]          Parker, NASA TP-2275 (1984)
//              without a given flow rho = rho_mix
//   ball       F = -(1/2) C_d rho (pi D^2/4) v |v|,  v = v_t - stream r               Schlichting, Boundary-Layer Theory
//   churning   M = -(1/2) rho R^5 C_n omega |omega|, omega of the ball less that of the stream,
//              C_n = 6.45/sqrt(Re) + 32.1/Re, Re = R^2 |omega|/nu    Dennis, Singh & Ingham (1980), J. Fluid Mech. 101, 257
//   end face   T_CDS = (1/2) rho omega^2 (r_o^5 - r_i^5) C_n/2,      Re = omega r_o^2/nu
//              C_n = 3.87/sqrt(Re) laminar, 0.146/Re^0.2 turbulent
//   cylinder   T_CDO = tau A R,  tau = rho nu omega R/c (Couette), with Taylor vortices 1.3 (Ta/41)^0.539 times
//              more, Ta = omega R c/nu sqrt(c/R)
//
// Gupta, Advanced Dynamics of Rolling Elements (1984), churning of balls, rotating cylinders and disks.  The
// mixture has the oil's kinematic viscosity nu.  The larger one of the laminar and the turbulent moment counts,
// which makes the drag continuous.  The film between land and ring is in land_film.c.
//
// A row of balls in a cage carries the mixture along: the mixture turns at `stream` = x omega_cage.  The
// balance of its angular momentum gives x: the balls drive the mixture, the inner ring drives it too, the outer
// ring brakes it, and fresh oil, which comes without swirl, has to be brought to speed,
//
//   B (1 - x)|1 - x| + I (sigma - x)^2 - E x^2 - N x = 0,         sigma = omega/omega_m = 2/(1 - gamma)
//   B = Z C_d pi D^2/4,  I = f_i A_i (r_i/r_m)^3,  E = f_e A_e (r_e/r_m)^3,  N = 2 rho_oil W/(rho omega_m r_m)
//
// per (1/2) rho omega_m^2 r_m^3, with the radii of the pitch circle r_m and the groove bottoms r_i, r_e, the
// walls' areas A beside the lands, and their friction f = 0.066 Re^-0.25, Re = |omega_wall - omega_m| r h/nu
// over the height h between the shoulders (turbulent bulk flow; Hirs (1973), J. Lubr. Technol. 95, 137).  With
// isolated balls the mixture stands.  Neglected: the cage's bore, which holds the mixture too.
//
// A cage that still turns when the rings stop works the mixture too.  The omega of walls and fresh oil is therefore half of
// the speed at which this cage would roll, at the least: the friction factor is infinite at none.  By half, and not the
// whole, the rings decide in any rolling; where they stop the factor is 0.5^-0.25 = 1.19 times that of the whole.
//
// All speeds are against the outer ring (outer_ring.h): oil and air at its walls turn with it.
#include "physics/drag.h"

#include "numbers/vec.h"
#include "physics/outer_ring.h"

static const double TINY_SPEED = 1e-30;  // [rad/s]: keeps roots and quotients finite at standstill

INLINE scalar positive(scalar x)
{
    return scalar_value(x) < 0.0 ? -x : x;
}

// x of the balance at the head of this file.  wall: |omega|^-0.25; fresh: N.
INLINE scalar carried_share(const Derived *d, scalar wall, scalar fresh)
{
    const double sigma = d->sigma;
    const scalar inner = d->inner_wall * wall, outer = d->outer_wall * wall;
    const scalar surplus = inner * ((sigma - 1.0) * (sigma - 1.0)) - outer - fresh;  // the balance at x = 1
    const double B = scalar_value(surplus) > 0.0 ? -d->ball_area : d->ball_area;

    // a x^2 - 2 b x + c = 0
    const scalar a = B + inner - outer, b = B + inner * sigma + 0.5 * fresh, c = B + inner * (sigma * sigma);
    const scalar root = scalar_sqrt(b * b - a * c);
    return scalar_value(b) < 0.0 ? (b - root) / a : c / (b + root);
}

void drag_mixture(const Model *model, Work *w)
{
    const Parameters *p = model->p;
    const Derived *d = model->d;
    const scalar outer = model->ring_load->outer_omega;
    const scalar cage = 0.5 * (w->half[0].Omega[0] + w->half[1].Omega[0]) - outer;
    const scalar rings = positive(model->ring_load->omega - outer);
    const scalar speed = scalar_max(rings, positive(0.5 * d->sigma * cage)) + TINY_SPEED;
    w->filling = 1.0;
    w->stream = w->wall = 0.0;
    if (p->oil.flow > 0.0) {
        const scalar X = scalar_value(rings) > d->flooded_omega ? d->flooded_omega / rings : 1.0;
        w->filling = d->air + (1.0 - d->air) * X;
    }
    if (p->scene.drag == DRAG_ROW) {
        w->wall = 1.0 / scalar_sqrt(scalar_sqrt(speed));
        const scalar x = carried_share(d, w->wall, d->fresh / (w->filling * speed));
        w->stream = x * cage;
    }
    w->stream += outer;
}

// Drag and churning of a packet of balls.  outer: the outer ring's motion, NULL if it is at rest in its place.
INLINE void drag_packet(const Model *model, Work *w, int j, bool churning, const Rotor *outer)
{
    const Derived *d = model->d;
    const wide k = wide_set(d->drag * w->filling);
    const wide stream = wide_set(w->stream - model->ring_load->outer_omega);
    vec turn = {0};  // of the outer ring
    wide v_t = wide_load(&w->v_t[j]);
    if (outer != NULL) {
        const wide cosine = wide_load(&w->cos_theta[j]), sine = wide_load(&w->sin_theta[j]);
        const vec p = {wide_load(&w->x[j]), wide_load(&w->r[j]), wide_set(0.0)};
        turn = vec_local(outer->Omega, cosine, sine);
        v_t -= outer_ring_velocity(outer, p, cosine, sine).t;
    }
    const wide v = v_t - stream * wide_load(&w->r[j]);
    const wide F = -k * v * wide_abs(v);
    wide lost = -(F * v_t);
    wide_store(&w->F_t[j], wide_load(&w->F_t[j]) + F);
    if (churning) {
        const wide viscous = wide_set(d->churning_viscous * w->filling);
        const wide boundary = wide_set(d->churning_boundary * w->filling);
        vec omega = vec_load(&w->omega_x[j], &w->omega_r[j], &w->omega_t[j]);
        if (outer != NULL) omega = vec_sub(omega, turn);
        const vec spin = {omega.x - stream, omega.r, omega.t};
        const wide speed = wide_sqrt(vec_dot(spin, spin) + TINY_SPEED);
        const vec M = vec_scale(-(viscous + boundary * wide_sqrt(speed)), spin);
        const vec sum = vec_add(vec_load(&w->M_x[j], &w->M_r[j], &w->M_t[j]), M);
        vec_store(sum, &w->M_x[j], &w->M_r[j], &w->M_t[j]);
        lost -= vec_dot(M, omega);
    }
    wide_store(&w->dissipated[j], wide_load(&w->dissipated[j]) + lost);
    wide_store(&w->drag_dissipated[j], lost);
}

void drag_force(const Model *model, Work *w)
{
    const bool churning = model->p->scene.churning == SWITCH_ON, moves = outer_ring_moves(model->ring_load);
    Rotor outer;
    if (moves) outer = outer_ring(model->ring_load);
    for (int b = 0; b < PACKETS; b++) drag_packet(model, w, b * LANE_WIDTH, churning, moves ? &outer : NULL);
}

void drag_cage(const Model *model, Work *w)
{
    const Derived *d = model->d;
    const bool moves = outer_ring_moves(model->ring_load);
    const scalar outer = moves ? outer_ring(model->ring_load).Omega[0] : 0.0;
    w->cage_drag_dissipated = 0.0;
    for (int first = 0; first < 2; first += HALVES) {
        Rotor *half = &w->half[first];
        const wide omega = wide_pair(half[0].Omega[0], half[HALVES - 1].Omega[0]) - outer;
        const wide speed = wide_abs(omega) + TINY_SPEED;
        wide disk = d->disk_laminar * wide_sqrt(speed), cylinder = wide_set(d->cylinder_laminar);
        if (wide_any(wide_above(speed, d->disk_laminar_omega)))
            disk = wide_max(disk, d->disk_turbulent * wide_exp(0.8 * wide_log(speed)));
        if (wide_any(wide_above(speed, d->cylinder_laminar_omega)))
            cylinder = wide_max(cylinder, d->cylinder_vortex * wide_exp(0.539 * wide_log(speed)));
        for (int h = 0; h < HALVES; h++) {
            const scalar M =
                -(wide_lane(disk, h) + wide_lane(cylinder, h)) * w->filling * wide_lane(omega, h);
            half[h].M[0] += M;
            w->cage_dissipated -= M * wide_lane(omega, h);
            w->cage_drag_dissipated -= M * wide_lane(omega, h);
        }
    }
}

void drag_ring(const Model *model, Work *w)
{
    const RingLoad *ring_load = model->ring_load;
    scalar s = w->ring.s;
    if (outer_ring_moves(ring_load)) s -= dot3(w->ring.a, outer_ring(ring_load).Omega);
    const scalar slip = s - (w->stream - ring_load->outer_omega);
    const scalar M = -(model->d->ring_drag * w->filling * w->wall) * slip * positive(slip);
    for (int i = 0; i < 3; i++) w->ring.M[i] += M * w->ring.a[i];
    w->ring_drag_dissipated = -M * s;
}
