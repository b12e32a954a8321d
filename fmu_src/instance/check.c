// Refusals before a run or a step: values outside their limits, parameters that make no bearing, a rivet
// table that belongs to another bearing.
#include "cage/cage.h"
#include "instance/log.h"
#include "numbers/saved_numbers.h"
#include "physics/race_surface.h"
#include "physics/ring_fit.h"
#include "physics/ring_load.h"
#include "physics/temperature.h"
#include "rivet/rivet_rom.h"

#include <float.h>
#include <stddef.h>
#include <stdio.h>

// Clearance at which a ball on one race reaches the other groove's far side.
static double largest_clearance(const Parameters *p)
{
    return 4.0 * (fmin(p->bearing.f_i, p->bearing.f_e) - 0.5) * p->bearing.D;
}

static void report_error(void *bearing, const char *message)
{
    bearing_log(bearing, LOG_ERROR, "%s", message);
}

// Checks all values of one causality (Parameters or Inputs) against the limits of the variable table.
static bool check_variables(Bearing *b, Causality causality, const void *values)
{
    return variables_allow(causality, values, 0.0, report_error, b);
}

// Whether all inputs lie within their limits; a NaN does not.
static bool inputs_lie_within(const Inputs *u)
{
    const double *value = (const double *)u;
    bool fine = true;
    for (int i = 0; i < N_INPUTS; i++)
        fine &= value[i] >= INPUT_LIMITS[i][0] && value[i] <= INPUT_LIMITS[i][1];
    return fine;
}

// Checks inputs that the caller asks for; the table with its messages is for those beyond a limit.
static bool check_given(Bearing *b, const Inputs *u)
{
    return inputs_lie_within(u) || check_variables(b, CAUSALITY_INPUT, u);
}

// Checks inputs that a trajectory reaches: its polynomial may round a limit that the caller asks for by a few
// units of the last place.
static bool check_reached(Bearing *b, const Inputs *u)
{
    return inputs_lie_within(u) || variables_allow(CAUSALITY_INPUT, u, 1e-12, report_error, b);
}

// Where the motions that are given lead within a step of length h.  A motion that is catching up with the given one
// (motion_trajectory) may be faster.
static bool check_motions(Bearing *b, double h)
{
    if (!(h > 0.0)) return true;
    Inputs u[INPUT_ORDERS + 1], end;
    InputTrajectory trajectory = {.t_0 = 0.0};
    MotionLag lag;
    motion_trajectory(&b->s.p, b->s.u, &b->s.history, &b->s.u[0], h, u, &lag);
    if (memcmp(u, b->s.u, sizeof u) == 0) return true;
    memcpy(trajectory.u, u, sizeof u);
    input_trajectory_at(&trajectory, h, &end);
    return check_reached(b, &end);
}

// Checks that oil and bearing bear the temperatures in u: viscosity within its limits, cage neither on the
// outer ring nor on the balls, no interference beyond what parameters may have.
static bool check_temperatures(Bearing *b, const Inputs *u)
{
    const Variable *eta = variable_named("oil.eta"), *guide = variable_named("cage.guide_clearance");
    Parameters hot;
    temperature_apply(&b->s.p, u, &hot);
    bool fine = true;
    if (!(hot.oil.eta >= eta->min && hot.oil.eta <= eta->max)) {
        bearing_log(b, LOG_ERROR, "oil.T = %g K: the oil's viscosity is %g Pa.s there; %g ... %g is allowed",
                    u->oil.T, hot.oil.eta, eta->min, eta->max);
        fine = false;
    }
    if (!(hot.cage.guide_clearance >= guide->min)) {
        bearing_log(
            b, LOG_ERROR,
            "cage.T = %g K, ring.T_e = %g K: the cage's guide clearance is %g m there; at least %g m is "
            "allowed",
            u->cage.T, u->ring.T_e, hot.cage.guide_clearance, guide->min);
        fine = false;
    }
    if (!(hot.cage.pocket_clearance >= 0.0)) {
        bearing_log(
            b, LOG_ERROR,
            "cage.T = %g K, ball.T = %g K: the pockets' clearance is %g m there; at least 0 m is allowed",
            u->cage.T, u->ball.T, hot.cage.pocket_clearance);
        fine = false;
    }
    if (hot.cage.shape == CAGE_SHAPE_RIBBON && !(hot.cage.pocket_depth > 0.5 * hot.bearing.D)) {
        bearing_log(b, LOG_ERROR,
                    "cage.T = %g K, ball.T = %g K: cage.pocket_depth is %g m there; more than bearing.D/2 = "
                    "%g m is allowed",
                    u->cage.T, u->ball.T, hot.cage.pocket_depth, 0.5 * hot.bearing.D);
        fine = false;
    }
    const double least = -0.01 * hot.bearing.D, most = largest_clearance(&hot);
    if (!(hot.bearing.P_d > least && hot.bearing.P_d < most)) {
        bearing_log(
            b, LOG_ERROR,
            "ring.T_i = %g K, ring.T_e = %g K, ball.T = %g K: the bearing's clearance is %g m there; %g ... "
            "%g m is allowed",
            u->ring.T_i, u->ring.T_e, u->ball.T, hot.bearing.P_d, least, most);
        fine = false;
    }
    return fine;
}

// Inputs are polynomials of second order: their extremes are at the ends of the step or where their slope
// vanishes.
bool check_inputs(Bearing *b, double h)
{
    const double *u_1 = (const double *)&b->s.u[1], *u_2 = (const double *)&b->s.u[2];
    InputTrajectory trajectory = {.t_0 = 0.0, .u = {b->s.u[0], b->s.u[1], b->s.u[2]}};
    Inputs u = b->s.u[0], turning = u;
    if (!check_motions(b, h)) return false;
    if (!input_trajectory_varies(&trajectory))
        return check_given(b, &u) && (temperature_same(&b->s.u_now, &u) || check_temperatures(b, &u));
    input_trajectory_at(&trajectory, h, &u);
    for (int i = 0; i < N_INPUTS; i++) {
        const double tau = -u_1[i] / u_2[i];
        if (tau > 0.0 && tau < h) ((double *)&turning)[i] += 0.5 * tau * u_1[i];
    }
    return check_given(b, &b->s.u[0]) && check_reached(b, &u) && check_reached(b, &turning) &&
           check_temperatures(b, &b->s.u[0]) && check_temperatures(b, &u);
}

// Logs value and limit unless the condition holds.
static bool require(Bearing *b, bool condition, const char *format, double value, double limit)
{
    if (!condition) bearing_log(b, LOG_ERROR, format, value, limit);
    return condition;
}

// Checks that there is such a cage.
static bool check_cage(Bearing *b)
{
    const char *refusal = cage_refusal(&b->s.p);
    if (refusal) bearing_log(b, LOG_ERROR, "%s", refusal);
    return refusal == NULL;
}

// Share by which the moments of inertia may miss their bounds: numbers of three digits are rounded.
static const double ROUNDED = 0.01;

// Mass of the lightest half, as a part of that of a ring which fills its space.
static const double LIGHTEST_HALF = 0.25;

// Triangle rule, J_p = 2 J_t - 2 m <x^2> with <x^2> the mean square of the axial distance from the centre of mass.
static bool check_triangle(Bearing *b, const char *part, double J_p, double J_t)
{
    const double most = (1.0 + ROUNDED) * 2.0 * J_t;
    if (J_p <= most) return true;
    bearing_log(b, LOG_ERROR,
                "%s.J_p = %g kg.m2: no body has this beside %s.J_t = %g kg.m2; at most 2 J_t = %g kg.m2 is "
                "allowed",
                part, J_p, part, J_t, most);
    return false;
}

// Checks that bodies can have the moments of inertia.  A body that is too easy to turn would need very short steps.
//
//   cage half  no heavier than a ring that fills its space, of the largest cage.rho, no lighter than LIGHTEST_HALF of one
//              of the smallest;  J_t at most that of a body of twice the size, m (D_o^2 + width^2);
//              its mass lies between the radii D_i/2 and D_o/2: m D_i^2/4 <= J_p <= m D_o^2/4;  J_p <= 2 J_t.
//              Values left at their start follow the mass (derived.c).
//   ring       with its share of the shaft J_p <= 2 J_t.  Where loads tilt it, J_p is at least that of a solid shaft
//              of half the bore, m (bore/4)^2/2.  A disk on the shaft may have any J_p.
static bool check_bodies(Bearing *b)
{
    const Parameters *p = &b->s.p;
    const double m = p->cage.m, bore = ring_fit_bore(p);
    const double least = (1.0 - ROUNDED) * 0.25 * m * p->cage.D_i * p->cage.D_i;
    const double most = (1.0 + ROUNDED) * 0.25 * m * p->cage.D_o * p->cage.D_o;
    const double shaft = (1.0 - ROUNDED) * p->ring.m * bore * bore / 32.0;
    double J_p, J_t;
    cage_half_inertia(p, &J_p, &J_t);
    const Variable *rho = variable_named("cage.rho");
    const double D_o_2 = p->cage.D_o * p->cage.D_o, widest = m * (D_o_2 + p->cage.width * p->cage.width);
    const double ring = 0.125 * PI * (D_o_2 - p->cage.D_i * p->cage.D_i) * p->cage.width;
    if (!(m >= LIGHTEST_HALF * rho->min * ring && m <= rho->max * ring)) {
        bearing_log(b, LOG_ERROR,
                    "cage.m = %g kg: no half between cage.D_i, cage.D_o and cage.width has this mass; %g ... "
                    "%g kg is allowed",
                    m, LIGHTEST_HALF * rho->min * ring, rho->max * ring);
        return false;
    }
    bool fine = J_p >= least && J_p <= most;
    if (!fine)
        bearing_log(b, LOG_ERROR,
                    "cage.J_p = %g kg.m2: not of a half of cage.m = %g kg between cage.D_i and cage.D_o; "
                    "%g ... %g kg.m2 is allowed",
                    J_p, m, least, most);
    fine = fine && check_triangle(b, "cage", J_p, J_t);
    fine = fine &&
           require(b, J_t <= widest,
                   "cage.J_t = %g kg.m2: at most cage.m (cage.D_o^2 + cage.width^2) = %g kg.m2 is allowed",
                   J_t, widest);
    fine &= check_triangle(b, "ring", p->ring.J_p, p->ring.J_t);
    if (p->ring.motion == RING_MOTION_FREE && p->ring.tilt_mode != TILT_MODE_PRESCRIBED)
        fine &= require(b, p->ring.J_p >= shaft,
                        "ring.J_p = %g kg.m2: at least %g kg.m2 is allowed, ring.m (ring.bore/4)^2/2 of a "
                        "solid shaft of half the bore",
                        p->ring.J_p, shaft);
    return fine;
}

// Checks the sizes of a ribbon half; a machined one has none of them.
static bool check_ribbon(Bearing *b)
{
    const Parameters *p = &b->s.p;
    const bool ribbon = p->cage.shape == CAGE_SHAPE_RIBBON;

    const struct {
        const char *name;
        double value;
        bool needed;
    } sizes[] = {{"cage.sheet", p->cage.sheet, true},
                 {"cage.pocket_depth", p->cage.pocket_depth, true},
                 {"cage.pocket_fillet", p->cage.pocket_fillet, true},
                 {"cage.pocket_radius", p->cage.pocket_radius, false},
                 {"cage.pocket_edge", p->cage.pocket_edge, false}};

    bool fine = true;
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        if (ribbon ? sizes[i].value > 0.0 || !sizes[i].needed : sizes[i].value == 0.0) continue;
        bearing_log(b, LOG_ERROR, "%s = %g m: %s", sizes[i].name, sizes[i].value,
                    ribbon ? "more than 0 is allowed of a ribbon cage (cage.shape)"
                           : "0 is allowed, a machined cage (cage.shape) has no such size");
        fine = false;
    }
    if (!ribbon || !fine) return fine;

    const double radius = 0.5 * (p->bearing.D + p->cage.pocket_clearance), depth = p->cage.pocket_depth;
    const double width = 2.0 * (depth + p->cage.sheet), edge = spheres_edge(p);
    double sin_chi, sin_eta;
    spheres_seams(p, &sin_chi, &sin_eta);
    if (p->cage.guidance != CAGE_GUIDANCE_BALLS) {
        bearing_log(
            b, LOG_ERROR,
            "cage.guidance = outer: a ribbon cage has no land on the outer ring; balls (2) is allowed");
        return false;
    }
    fine &= require(b, p->cage.pocket_radius == 0.0 || fabs(p->cage.pocket_radius - radius) <= 1e-6 * radius,
                    "cage.pocket_radius = %g m: 0 or (bearing.D + cage.pocket_clearance)/2 = %g m is allowed",
                    p->cage.pocket_radius, radius);
    fine &= require(b, depth > 0.5 * p->bearing.D,
                    "cage.pocket_depth = %g m: no room for the ball; more than bearing.D/2 = %g m is allowed",
                    depth, 0.5 * p->bearing.D);
    fine &= require(b, depth <= radius,
                    "cage.pocket_depth = %g m: deeper than a sphere; at most (bearing.D + "
                    "cage.pocket_clearance)/2 = %g m is allowed",
                    depth, radius);
    fine &= require(b, fabs(p->cage.width - width) <= 0.01 * width,
                    "cage.width = %g m: 2 (cage.pocket_depth + cage.sheet) = %g m is allowed, +- 1 %%",
                    p->cage.width, width);
    const double pitch = 0.5 * (p->cage.D_o + p->cage.D_i), off = fabs(pitch - p->bearing.d_m);
    fine &= require(b, off <= p->cage.pocket_clearance,
                    "cage.D_o, cage.D_i: (cage.D_o + cage.D_i)/2 = %g m puts the pockets beside the balls; "
                    "bearing.d_m = %g m is allowed, +- cage.pocket_clearance (change both diameters)",
                    pitch, p->bearing.d_m);
    fine &= require(b, 0.25 * (p->cage.D_o - p->cage.D_i) > 2.0 * edge,
                    "cage.D_o - cage.D_i = %g m: no sphere between the pocket's edges; more than %g m, "
                    "8 radii of the edges, is allowed",
                    p->cage.D_o - p->cage.D_i, 8.0 * edge);
    const double most = 0.95;
    return fine &&
           require(b, sin_chi * sin_chi + sin_eta * sin_eta < most,
                   "cage.pocket_fillet, cage.D_o - cage.D_i: the fillet and the edges leave no sphere; "
                   "the sum of the squares of the sines of their angles is %g, less than %g is allowed",
                   sin_chi * sin_chi + sin_eta * sin_eta, most);
}

// A spall has a length, a width and a depth, or none of them.  It is at most half a turn long and as wide as the ball, and its
// depth is small beside the ball, which rolls over its edges.
static bool check_spall(Bearing *b, const char *body, double length, double width, double depth,
                        double diameter)
{
    static const char *const NAME[] = {"length", "width", "depth"};
    const double D = b->s.p.bearing.D, value[] = {length, width, depth},
                 most[] = {0.5 * PI * diameter, D, 0.05 * D};
    static const char *const LIMIT[] = {"half the circumference", "bearing.D", "bearing.D/20"};
    const bool any = length > 0.0 || width > 0.0 || depth > 0.0;
    bool fine = true;
    for (int i = 0; i < 3; i++) {
        if (value[i] > most[i]) {
            bearing_log(b, LOG_ERROR, "%s.spall_%s = %g m: at most %s, %g m, is allowed", body, NAME[i],
                        value[i], LIMIT[i], most[i]);
            fine = false;
        } else if (any && value[i] == 0.0) {
            bearing_log(b, LOG_ERROR,
                        "%s.spall_%s = 0 m: a spall has %s.spall_length, %s.spall_width and %s.spall_depth; "
                        "more than 0 m is allowed, or 0 m for all three",
                        body, NAME[i], body, body, body);
            fine = false;
        }
    }
    return fine;
}

// The spalls of the balls, whose turn the default method alone carries.
static bool check_ball_spalls(Bearing *b)
{
    const Parameters *p = &b->s.p;
    bool fine = true;
    for (int j = 0; j < Z; j++) {
        const double length = p->ball.spall_length[j], width = p->ball.spall_width[j],
                     depth = p->ball.spall_depth[j];
        char body[24];
        snprintf(body, sizeof body, "ball[%d]", j + 1);
        fine &= check_spall(b, body, length, width, depth, p->bearing.D);
        if (!spall_given(length, width, depth) || p->solver.method != METHOD_EXPLICIT) continue;
        bearing_log(
            b, LOG_ERROR,
            "ball[%d].spall_length = %g m: solver.method = explicit does not follow the turn of a ball; "
            "allowed is 0 m, or solver.method = verlet or fixed",
            j + 1, length);
        fine = false;
    }
    return fine;
}

// Checks parameters against each other.
static bool check_geometry(Bearing *b)
{
    const Parameters *p = &b->s.p;
    const double D = p->bearing.D, d_m = p->bearing.d_m;
    const double chord = d_m * sin(PI / Z), play = largest_clearance(p);
    bool fine = true;
    fine &= require(b, D < chord,
                    "bearing.D = %g m: the balls overlap; less than bearing.d_m sin(pi/Z) = %g m is allowed",
                    D, chord);
    fine &= require(b, D + p->cage.pocket_clearance < chord,
                    "cage.pocket_clearance = %g m: the pockets overlap; less than bearing.d_m sin(pi/Z) - "
                    "bearing.D = %g m is allowed",
                    p->cage.pocket_clearance, chord - D);
    fine &= require(b, p->bearing.P_d < play,
                    "bearing.P_d = %g m: a ball on one race would reach the other groove's far side; less "
                    "than 4 (min(f_i, f_e) - 1/2) D = %g m is allowed",
                    p->bearing.P_d, play);
    fine &=
        require(b, -p->bearing.P_d < 0.01 * D,
                "bearing.P_d = %g m: the interference exceeds 1 %% of bearing.D; at least %g m is allowed",
                p->bearing.P_d, -0.01 * D);
    fine &= require(b, p->ring.bore < d_m - D,
                    "ring.bore = %g m: less than the diameter of the inner groove's bottom, %g m, is allowed",
                    p->ring.bore, d_m - D);
    const double least = 1e-6;     // [m], far below any ring's: squares of bores do not underflow
    const double shortest = 1e-9;  // [s], a ten-thousandth of a pocket's pulse
    fine &= require(b, p->solver.step == 0.0 || p->solver.step >= shortest,
                    "solver.step = %g s: 0, which stands for a derived step, or at least %g s is allowed",
                    p->solver.step, shortest);
    fine &= require(b, p->ring.bore == 0.0 || p->ring.bore >= least,
                    "ring.bore = %g m: 0 or at least %g m is allowed", p->ring.bore, least);
    fine &= require(
        b, ring_fit_effective_i(p) >= d_m - D,
        "ring.effective_i = %g m: at least the diameter of the inner groove's bottom, %g m, is allowed",
        p->ring.effective_i, d_m - D);
    fine &= require(
        b, ring_fit_effective_e(p) <= d_m + D,
        "ring.effective_e = %g m: at most the diameter of the outer groove's bottom, %g m, is allowed",
        p->ring.effective_e, d_m + D);
    fine &=
        require(b, ring_fit_outside(p) > d_m + D,
                "ring.outside = %g m: more than the diameter of the outer groove's bottom, %g m, is allowed",
                p->ring.outside, d_m + D);
    fine &= require(b, p->shaft.bore < ring_fit_bore(p),
                    "shaft.bore = %g m: less than the bore of the inner ring, %g m, is allowed",
                    p->shaft.bore, ring_fit_bore(p));
    fine &= require(b, p->housing.outside == 0.0 || p->housing.outside > ring_fit_outside(p),
                    "housing.outside = %g m: 0 or more than the outside diameter of the outer ring, %g m, is "
                    "allowed",
                    p->housing.outside, ring_fit_outside(p));
    const double softest = variable_named("bearing.E")->min;
    fine &= require(b, p->ball.E == 0.0 || p->ball.E >= softest,
                    "ball.E = %g Pa: 0, which stands for bearing.E, or at least %g Pa is allowed", p->ball.E,
                    softest);
    fine &= require(b, p->cage.D_i < p->cage.D_o, "cage.D_i = %g m: less than cage.D_o = %g m is allowed",
                    p->cage.D_i, p->cage.D_o);
    fine &= require(b, p->cage.D_i < d_m, "cage.D_i = %g m: less than bearing.d_m = %g m is allowed",
                    p->cage.D_i, d_m);
    fine &= require(b, d_m < p->cage.D_o, "cage.D_o = %g m: more than bearing.d_m = %g m is allowed",
                    p->cage.D_o, d_m);
    const double groove = d_m + D + 0.5 * p->bearing.P_d - p->cage.guide_clearance;
    fine &= require(b, p->cage.D_o <= groove,
                    "cage.D_o = %g m: with its guide clearance the cage must fit inside the outer groove's "
                    "bottom; at most bearing.d_m + bearing.D + bearing.P_d/2 - cage.guide_clearance = %g m "
                    "is allowed",
                    p->cage.D_o, groove);
    const bool machined = p->cage.shape == CAGE_SHAPE_MACHINED;
    const double web = 1.05 * 0.5 * (D + p->cage.pocket_clearance);
    fine &= require(b, !machined || 0.5 * p->cage.width >= web,
                    "cage.width = %g m: no web closes the pockets; at least 1.05 (bearing.D + "
                    "cage.pocket_clearance) = %g m is allowed",
                    p->cage.width, 2.0 * web);
    fine &= require(b, p->cage.land_width <= 0.5 * p->cage.width,
                    "cage.land_width = %g m: at most half of cage.width, %g m, is allowed",
                    p->cage.land_width, 0.5 * p->cage.width);
    fine &= require(b, p->cage.guidance == CAGE_GUIDANCE_OUTER || p->cage.pocket_clearance > 0.0,
                    "cage.pocket_clearance = %g m: more than %g m is allowed of a cage that balls guide",
                    p->cage.pocket_clearance, 0.0);
    const double farthest = 2e-4,
                 unbalance = 2.0 * p->cage.m * farthest;  // cages are true to 0.2 mm at worst
    fine &= require(b, p->cage.unbalance <= unbalance,
                    "cage.unbalance = %g kg.m: the cage's centre of mass is more than 0.2 mm off; at most "
                    "2 cage.m 0.2 mm = %g kg.m is allowed",
                    p->cage.unbalance, unbalance);
    fine &= check_ribbon(b);
    fine &= require(b, p->oil.T_1 < p->oil.T_2, "oil.T_1 = %g K: less than oil.T_2 = %g K is allowed",
                    p->oil.T_1, p->oil.T_2);
    fine &=
        require(b, p->oil.nu_1 > p->oil.nu_2,
                "oil.nu_1 = %g m2/s: more than oil.nu_2 = %g m2/s is allowed, for the viscosity falls with "
                "temperature",
                p->oil.nu_1, p->oil.nu_2);
    fine &= require(b, p->fatigue.k_2 >= p->fatigue.k_1,
                    "fatigue.k_2 = %g: at least fatigue.k_1 = %g is allowed", p->fatigue.k_2, p->fatigue.k_1);
    fine &= require(b, p->pulse.count < 2 || p->pulse.interval >= p->pulse.duration,
                    "pulse.interval = %g s: at least pulse.duration = %g s is allowed", p->pulse.interval,
                    p->pulse.duration);
    for (int j = 0; j < Z; j++) {
        const double clearance = p->cage.pocket_clearance + p->pocket.dD[j];
        if (p->pocket.dD[j] < 0.0 && clearance <= 0.0) {
            bearing_log(b, LOG_ERROR,
                        "pocket[%d].dD = %g m: more than -cage.pocket_clearance = %g m is allowed", j + 1,
                        p->pocket.dD[j], -p->cage.pocket_clearance);
            fine = false;
        } else if (p->ball.dD[j] > 0.0 && p->ball.dD[j] >= clearance) {
            bearing_log(
                b, LOG_ERROR,
                "ball[%d].dD = %g m: less than cage.pocket_clearance + pocket[%d].dD = %g m is allowed",
                j + 1, p->ball.dD[j], j + 1, clearance);
            fine = false;
        }
    }
    fine &=
        check_spall(b, "inner", p->inner.spall_length, p->inner.spall_width, p->inner.spall_depth, d_m - D);
    fine &=
        check_spall(b, "outer", p->outer.spall_length, p->outer.spall_width, p->outer.spall_depth, d_m + D);
    fine &= check_ball_spalls(b);
    const bool moved = p->housing.motion != HOUSING_MOTION_SUPPORTED || p->solver.method != METHOD_EXPLICIT;
    if (!moved)
        bearing_log(b, LOG_ERROR,
                    "housing.motion = supported: solver.method = explicit has no housing on springs; allowed "
                    "is given, or "
                    "solver.method = verlet or fixed");
    const bool counted = p->scene.breakage != SWITCH_ON || p->scene.stress == STRESS_FATIGUE;
    if (!counted)
        bearing_log(
            b, LOG_ERROR,
            "scene.breakage = on: rivets break by their damage, which scene.stress = fatigue alone counts; "
            "allowed is off, or on with scene.stress = fatigue");
    return check_cage(b) && fine && counted && moved;
}

// Checks that the halves have room for the seat of the rivet's head: metal inside and outside of it, a
// bridge between the pockets around it.  The least wall is that of rivet_model/half_shape.py.
static bool check_seat(Bearing *b)
{
    const Parameters *p = &b->s.p;
    if (p->cage.shape != CAGE_SHAPE_MACHINED) return true;
    const double wall = 0.2e-3, seat = rivet_table.joint.seat + 2.0 * wall, r = 0.5 * p->cage.D_i;
    const double inside = p->bearing.d_m - seat, outside = p->bearing.d_m + seat;
    const double tolerance = 1e-6 * p->bearing.d_m;
    bool fine =
        require(b, p->cage.D_i <= inside + tolerance,
                "cage.D_i = %g m: no metal inside the seat of the rivet's head; at most %g m is allowed",
                p->cage.D_i, inside);
    fine &=
        require(b, p->cage.D_o >= outside - tolerance,
                "cage.D_o = %g m: no metal outside the seat of the rivet's head; at least %g m is allowed",
                p->cage.D_o, outside);
    const double pocket = 2.0 * r * sin(PI / Z - asin(fmin(0.5 * seat / r, 1.0)));
    fine &=
        require(b, p->bearing.D + p->cage.pocket_clearance <= pocket + tolerance,
                "cage.pocket_clearance = %g m: the bridges between the pockets do not hold the seat of the "
                "rivet's head; at most %g m is allowed",
                p->cage.pocket_clearance, pocket - p->bearing.D);
    return fine;
}

// Checks the parameters that the build fixes: the constants of the cage's material, from which the rivet
// table was made.
static bool check_built(Bearing *b)
{
    bool fine = true;
    for (const Variable *v = VARIABLES; v < VARIABLES + N_VARIABLES; v++) {
        if (!v->built) continue;
        const double value = variable_value(v, 0, &b->s.p);
        if (value == v->start) continue;
        const bool shape = strcmp(v->name, "cage.shape") == 0;
        bearing_log(b, LOG_ERROR,
                    "%s = %g: %g is allowed, of the %s for which this FMU and its rivet table were "
                    "built; for another %s build an FMU from a bearing file with [cage] %s",
                    v->name, value, v->start, shape ? "shape" : "material", shape ? "shape" : "material",
                    shape ? "shape" : "material");
        fine = false;
    }
    return fine;
}

// Checks the embedded rivet table, which belongs to one number of rivets and one pitch circle.
static bool check_table(Bearing *b)
{
    const double d_m = b->s.p.bearing.d_m, table = rivet_table.joint.d_m;
    bool fine = require(
        b, rivet_table.Z == Z,
        "the embedded rivet table is for Z = %g; this FMU has Z = %g: build it with a table for this bearing",
        rivet_table.Z, Z);
    fine &= require(
        b, fabs(d_m - table) <= 1e-3 * table,
        "bearing.d_m = %g m: the embedded load path is for %g m +- 0.1 %%; build an FMU for this bearing",
        d_m, table);
    fine &= require(
        b, fabs(b->s.p.cage.x_c - rivet_table.half.x_c) <= 0.02 * rivet_table.half.x_c,
        "cage.x_c = %g m: allowed is %g m +- 2 %%, the centre of mass of the cage half in the embedded rivet "
        "table; build an FMU for this cage",
        b->s.p.cage.x_c, rivet_table.half.x_c);
    return fine;
}

// Parameters and inputs, but not whether the bearing bears the temperatures.
static bool check_values(Bearing *b)
{
    bool fine = check_variables(b, CAUSALITY_PARAMETER, &b->s.p);
    fine &= check_variables(b, CAUSALITY_INPUT, &b->s.u[0]);
    return fine && check_built(b) && check_geometry(b) && check_table(b) && check_seat(b) && check_bodies(b);
}

bool check_all(Bearing *b)
{
    return check_values(b) && check_temperatures(b, &b->s.u[0]);
}

bool check_change(Bearing *b)
{
    const InstanceState *s = &b->s;
    if (memcmp(&s->p, &s->p_now, sizeof s->p) == 0) return true;
    const double t = s->integrator.t;
    if (memcmp(&s->p.pulse, &s->p_now.pulse, sizeof s->p.pulse) != 0 &&
        (pulse_in_progress(&s->p, t) || pulse_in_progress(&s->p_now, t))) {
        bearing_log(
            b, LOG_ERROR,
            "pulse.t_start = %g s, pulse.interval = %g s, pulse.duration = %g s: an impact has begun before "
            "t = %.9g s and not ended; a change between impacts is allowed",
            s->p.pulse.t_start, s->p.pulse.interval, s->p.pulse.duration, t);
        return false;
    }
    return check_geometry(b) && check_temperatures(b, &s->u[0]);
}

// Inputs that have no effect on a ring whose motion is free, and on one whose motion is prescribed.
typedef struct {
    const char *name;
    size_t offset;
} InputName;

#define INPUT(group, member) {#group "." #member, offsetof(Inputs, group.member)}

static const InputName OF_PRESCRIBED[] = {
    INPUT(shaft, x),   INPUT(shaft, y),   INPUT(shaft, z),          INPUT(shaft, v_x),
    INPUT(shaft, v_y), INPUT(shaft, v_z), INPUT(shaft, tilt_y_dot), INPUT(shaft, tilt_z_dot)};
static const InputName OF_FREE[] = {INPUT(shaft, F_x), INPUT(shaft, F_y), INPUT(shaft, F_z),
                                    INPUT(shaft, M_y), INPUT(shaft, M_z), INPUT(impact, F_r),
                                    INPUT(impact, F_a)};
static const InputName MOMENTS[] = {INPUT(shaft, M_y), INPUT(shaft, M_z)};
static const InputName TILTS[] = {INPUT(shaft, tilt_y), INPUT(shaft, tilt_z)};
static const char *const PARAMETERS_OF_FREE[] = {
    "pulse.F_r",      "pulse.F_a",   "pulse.t_start", "pulse.duration", "pulse.interval",
    "pulse.count",    "ring.m",      "ring.J_p",      "ring.J_t",       "ring.c",
    "ring.tilt_mode", "ring.k_tilt", "ring.c_tilt",   "ring.tilt_time"};

static void add_name(const char *name, char *list, size_t size)
{
    const size_t length = strlen(list);
    snprintf(list + length, size - length, "%s%s", length > 0 ? ", " : "", name);
}

// Adds the inputs whose value is not that of the start.
static void add_changed(const Bearing *b, const InputName *input, size_t count, char *list, size_t size)
{
    const char *now = (const char *)&b->s.u[0], *start = (const char *)&b->start;
    for (size_t i = 0; i < count; i++)
        if (*(const double *)(now + input[i].offset) != *(const double *)(start + input[i].offset))
            add_name(input[i].name, list, size);
}

static void report_names(Bearing *b, const char *what, const char *is, const char *list)
{
    if (!*list) return;
    b->reported = true;
    bearing_log(b, LOG_WARNING, "%s is %s: no effect have %s", what, is, list);
}

// Moments on a ring whose tilt is prescribed, tilts of one that tilts freely.
static void report_tilts(Bearing *b)
{
    char list[512] = "";
    const int mode = b->s.p.ring.tilt_mode;
    if (mode == TILT_MODE_PRESCRIBED) add_changed(b, MOMENTS, 2, list, sizeof list);
    if (mode == TILT_MODE_FREE) add_changed(b, TILTS, 2, list, sizeof list);
    report_names(b, "ring.tilt_mode", mode == TILT_MODE_FREE ? "free" : "prescribed", list);
}

void report_without_effect(Bearing *b)
{
    if (b->reported) return;
    const bool prescribed = b->s.p.ring.motion == RING_MOTION_PRESCRIBED;
    char list[512] = "";
    if (prescribed)
        add_changed(b, OF_FREE, sizeof OF_FREE / sizeof *OF_FREE, list, sizeof list);
    else
        add_changed(b, OF_PRESCRIBED, sizeof OF_PRESCRIBED / sizeof *OF_PRESCRIBED, list, sizeof list);

    // parameters cannot change after the start
    for (size_t i = 0;
         prescribed && !b->s.initialized && i < sizeof PARAMETERS_OF_FREE / sizeof *PARAMETERS_OF_FREE; i++) {
        const Variable *v = variable_named(PARAMETERS_OF_FREE[i]);
        if (variable_value(v, 0, &b->s.p) != v->start) add_name(v->name, list, sizeof list);
    }
    report_names(b, "ring.motion", prescribed ? "prescribed" : "free", list);
    if (!prescribed) report_tilts(b);
}

// Logs that the parts stay at their start temperatures where the oil alone has been given another one.
static void report_parts_left(Bearing *b)
{
    const Inputs *u = &b->s.u[0], *start = &b->start;
    const bool alone = u->ring.T_i == start->ring.T_i && u->ring.T_e == start->ring.T_e &&
                       u->ball.T == start->ball.T && u->cage.T == start->cage.T;
    const double T = u->oil.T, zero = 273.15;  // [K] of 0 degC
    const bool equal = u->ring.T_i == T && u->ring.T_e == T && u->ball.T == T && u->cage.T == T;
    if (!alone || equal || T == start->oil.T) return;
    bearing_log(
        b, LOG_WARNING,
        "oil.T = %g degC is set, the parts' temperatures are not: ring.T_i = %g degC, ring.T_e = %g degC, "
        "ball.T = %g degC, cage.T = %g degC, at which clearances, preload and fit are taken",
        T - zero, u->ring.T_i - zero, u->ring.T_e - zero, u->ball.T - zero, u->cage.T - zero);
}

// Sizes of which the rivet table holds those of the build: it keeps them when the parameters change.
static const char *const SIZES_OF_TABLE[] = {"bearing.D", "cage.D_o", "cage.D_i", "cage.width"};

// Logs sizes by which the dynamics leave the rivet table behind: 1 % moves a half's bending stiffness by some per cent.
static void report_sizes_of_table(Bearing *b)
{
    char list[128] = "";
    for (size_t i = 0; i < sizeof SIZES_OF_TABLE / sizeof *SIZES_OF_TABLE; i++) {
        const Variable *v = variable_named(SIZES_OF_TABLE[i]);
        if (fabs(variable_value(v, 0, &b->s.p) - v->start) > 0.01 * v->start)
            add_name(v->name, list, sizeof list);
    }
    if (*list)
        bearing_log(b, LOG_WARNING,
                    "%s: more than 1 %% off the start value; contacts and films have the new size, the "
                    "embedded rivet "
                    "table (modes, load path, stress) that of the build: build an FMU for this size",
                    list);
}

void report_start(Bearing *b)
{
    report_without_effect(b);
    report_parts_left(b);
    report_sizes_of_table(b);
}

bool check_start(Bearing *b)
{
    const Inputs *u = &b->s.u[0];
    const bool prescribed = b->s.p.ring.motion == RING_MOTION_PRESCRIBED;
    const double load[3] = {u->shaft.F_x, u->shaft.F_y, u->shaft.F_z};
    const double place[3] = {u->shaft.x, u->shaft.y, u->shaft.z};
    const double *drive = prescribed ? place : load;
    const char *name = prescribed ? "shaft." : "shaft.F_", *unit = prescribed ? "m" : "N";
    for (int i = 0; i < 2 * Z; i++) {
        const double reach = ellipse_reach(&b->model, &b->w, i % 2 == 1, i / 2);
        if (reach < 0.5 * PI) continue;
        bearing_log(
            b, LOG_ERROR,
            "ball[%d] is pressed out of the %s race's groove at the start: its contact reaches to %g rad, "
            "less than pi/2 is allowed; %sx = %g %s, %sy = %g %s, %sz = %g %s, shaft.tilt_y = %g rad, "
            "shaft.tilt_z = %g rad are too much",
            i / 2 + 1, i % 2 == 1 ? "outer" : "inner", reach, name, drive[0], unit, name, drive[1], unit,
            name, drive[2], unit, u->shaft.tilt_y, u->shaft.tilt_z);
        return false;
    }
    return true;
}

static bool is_zero(const void *memory, size_t size)
{
    const unsigned char *byte = memory;
    for (size_t i = 0; i < size; i++)
        if (byte[i] != 0) return false;
    return true;
}

static bool saved_is(Bearing *b, bool condition, const char *what)
{
    if (!condition) bearing_log(b, LOG_ERROR, "%s: not what a run can have left there", what);
    return condition;
}

static bool lag_is_valid(const MotionLag *lag)
{
    const double mismatch[] = {lag->x, lag->v};
    return lag->count >= 0 && lag->count <= MOTIONS && lag->motion >= 0 && lag->motion < MOTIONS &&
           values_are_sane(mismatch, 2);
}

static bool step_end_is_valid(const StepEnd *end)
{
    return (end->force_known == 0 || end->force_known == 1) &&
           (end->stress_known == 0 || end->stress_known == 1) && values_are_amounts(end->force, Z) &&
           values_are_sane(end->head, STRESS_CHANNELS) && values_are_sane(end->mid, STRESS_CHANNELS);
}

// Of each rivet and of all balls together, over the time since the start; every ball adds its own time to the
// pocket forces.
static bool check_recorded(Bearing *b, double time)
{
    const InstanceState *s = &b->s;
    const double amounts[] = {s->force_peak, s->dislocation_max, s->duty_time, s->eccentricity_time};
    const double sums[] = {s->energy_start, s->energy_change, s->omega_time};
    bool fine = values_are_amounts(amounts, sizeof amounts / sizeof amounts[0]) &&
                values_are_sane(sums, sizeof sums / sizeof sums[0]);
    fine &= values_are_amounts(s->head_peak, Z) && values_are_amounts(s->mid_peak, Z);
    fine &= step_end_is_valid(&s->end);
    fine = saved_is(b, fine, "peaks and sums") &&
           saved_is(b, event_state_is_valid(&s->event), "counts of events") &&
           saved_is(b, breakage_is_valid(&s->breakage, s->t_start, s->integrator.t), "broken rivets") &&
           saved_is(b, loosening_is_valid(&s->loosening), "lost preloads") &&
           saved_is(b, lag_is_valid(&s->lag), "a motion that catches up");
    fine = fine && saved_is(b, statistics_is_valid(&s->force, Z * time), "statistics of the pocket forces");
    for (int k = 0; fine && k < STRESS_CHANNELS; k++)
        fine = saved_is(b, statistics_is_valid(&s->head[k], time) && statistics_is_valid(&s->mid[k], time),
                        "statistics of the stress");
    for (int k = 0; fine && k < Z; k++)
        fine = saved_is(b, fatigue_is_valid(&s->fatigue_head[k]) && fatigue_is_valid(&s->fatigue_mid[k]),
                        "turning points of the stress");
    return fine;
}

static bool history_is_valid(const MotionHistory *history)
{
    const int steps = history->steps;
    return values_are_sane(history->v, MOTIONS) && values_are_sane(history->a, MOTIONS) &&
           values_are_amounts(&history->h, 1) && steps >= 0 && steps <= 2 && (steps == 0 || history->h > 0.0);
}

// Checks the inputs reached.  A step that stopped halfway leaves a given motion on its way, where its polynomial may be
// beyond the limits that hold at both ends.
static bool check_saved_inputs(Bearing *b, const Inputs *reached)
{
    Inputs u = *reached;
    for (int i = 0; i < MOTIONS; i++)
        ((double *)&u)[MOTION[i].position] = ((double *)&u)[MOTION[i].velocity] = 0.0;
    return check_reached(b, &u) && saved_is(b, values_are_sane((const double *)reached, N_INPUTS), "inputs");
}

// Whether the parameters that cannot change in a run are those in force.
static bool fixed_are_kept(const Parameters *given, const Parameters *in_force)
{
    for (const Variable *v = VARIABLES; v < VARIABLES + N_VARIABLES; v++) {
        if (v->causality != CAUSALITY_PARAMETER || v->fixed == NULL) continue;
        for (int i = 0; i < v->count; i++)
            if (variable_value(v, i, given) != variable_value(v, i, in_force)) return false;
    }
    return true;
}

bool check_saved(Bearing *b)
{
    const InstanceState *s = &b->s;
    const Variable *tolerance = variable_named("solver.tol");
    if (!saved_is(b, s->initialized == 0 || s->initialized == 1, "the mark of a started run")) return false;
    if (!s->initialized) {
        const size_t first = offsetof(InstanceState, u_now), end = offsetof(InstanceState, initialized);
        if (!saved_is(b, is_zero((const char *)s + first, end - first), "a run that has not been started"))
            return false;
        return check_variables(b, CAUSALITY_PARAMETER, &s->p) &&
               check_variables(b, CAUSALITY_INPUT, &s->u[0]) &&
               saved_is(b,
                        values_are_within((const double *)&s->u[1], (size_t)INPUT_ORDERS * N_INPUTS,
                                          LARGEST_DERIVATIVE),
                        "derivatives of inputs");
    }
    char message[256];
    bool fine = check_values(b) && check_variables(b, CAUSALITY_PARAMETER, &s->p_now) &&
                check_saved_inputs(b, &s->u_now) && check_temperatures(b, &s->u_now);
    fine = fine && saved_is(b, fixed_are_kept(&s->p, &s->p_now), "parameters that cannot change in a run");
    fine = fine && saved_is(b,
                            values_are_within((const double *)&s->u[1], (size_t)INPUT_ORDERS * N_INPUTS,
                                              LARGEST_DERIVATIVE),
                            "derivatives of inputs");
    fine = fine && saved_is(b, values_are_sane((const double *)&s->u_now_dot, N_INPUTS), "rates of inputs");
    fine = fine && saved_is(b, values_are_sane(&s->frame_angle, 1), "the frame's angle");
    fine = fine && saved_is(b, values_are_sane(s->ring_angle, 2), "the rings' angles");
    fine = fine && saved_is(b, history_is_valid(&s->history), "the motions given before");
    fine = fine &&
           saved_is(b, variable_allows(tolerance, 0, s->tolerance, message, sizeof message), "the tolerance");
    fine = fine && saved_is(b, integrator_state_is_valid(&s->integrator, &s->p), "states and steps");
    fine = fine && saved_is(b, values_are_sane(&s->t_start, 1) && s->integrator.t >= s->t_start, "time");
    const double rounding =
        s->integrator.steps * DBL_EPSILON *
        fabs(s->integrator.t);  // of the time, not of the lengths of the steps that are summed
    return fine && check_recorded(b, s->integrator.t - s->t_start + rounding);
}
