// Limits between parameters.  Written by fmus/generate.py from fmus/variables.toml: do not edit.
// clang-format off
#include "numbers/variable_table.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

// Reports the message of a limit that does not hold.
static bool broken(Report report, void *context, const char *format, ...)
{
    char message[512];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(message, sizeof message, format, arguments);
    va_end(arguments);
    report(context, message);
    return false;
}

// A margin that is not a number does not hold either.
bool limits_hold(const Parameters *p, const char *quantity, Report report, void *context)
{
    static const double PI = 3.14159265358979323846;
    bool fine = true;
    double value, bound;
    if ((!quantity || strcmp(quantity, "bearing.D") == 0))
    {
        value = p->bearing.D;
        bound = p->bearing.d_m * sin(PI / Z);
        if (!(value < bound))
            fine = broken(report, context, "bearing.D = %g m: less than bearing.d_m sin(pi/Z) = %g m is allowed for balls that do not overlap", value, bound);
    }
    if ((!quantity || strcmp(quantity, "bearing.P_d") == 0))
    {
        value = p->bearing.P_d;
        bound = 4.0 * p->bearing.D * (fmin(p->bearing.f_i, p->bearing.f_e) - 0.5);
        if (!(value < bound))
            fine = broken(report, context, "bearing.P_d = %g m: less than 4 bearing.D (min(bearing.f_i, bearing.f_e) - 0.5) = %g m is allowed for balls that stay on their side of the grooves", value, bound);
    }
    if ((!quantity || strcmp(quantity, "bearing.P_d") == 0))
    {
        value = p->bearing.P_d;
        bound = -0.01 * p->bearing.D;
        if (!(value >= bound))
            fine = broken(report, context, "bearing.P_d = %g m: at least -0.01 bearing.D = %g m is allowed for an interference of at most 1 %% of the ball", value, bound);
    }
    if ((!quantity || strcmp(quantity, "cage.D_i") == 0))
    {
        value = p->cage.D_i;
        bound = p->cage.D_o;
        if (!(value < bound))
            fine = broken(report, context, "cage.D_i = %g m: less than cage.D_o = %g m is allowed for a cage with a wall", value, bound);
    }
    if ((!quantity || strcmp(quantity, "cage.D_o") == 0) && (p->cage.shape == 1))
    {
        value = p->cage.D_o;
        bound = p->bearing.d_m + p->bearing.D + p->bearing.P_d / 2.0 - p->cage.guide_clearance;
        if (!(value <= bound))
            fine = broken(report, context, "cage.D_o = %g m: at most bearing.d_m + bearing.D + bearing.P_d/2 - cage.guide_clearance = %g m is allowed for a cage that, with its guide clearance, fits inside the outer groove's bottom", value, bound);
    }
    if ((!quantity || strcmp(quantity, "cage.land_width") == 0))
    {
        value = p->cage.land_width;
        bound = p->cage.width / 2.0;
        if (!(value <= bound))
            fine = broken(report, context, "cage.land_width = %g m: at most cage.width/2 = %g m is allowed for a land on its half of the cage", value, bound);
    }
    if ((!quantity || strcmp(quantity, "cage.m") == 0))
    {
        value = p->cage.m;
        bound = 23000.0 * PI / 8.0 * (p->cage.D_o * p->cage.D_o - p->cage.D_i * p->cage.D_i) * p->cage.width;
        if (!(value <= bound))
            fine = broken(report, context, "cage.m = %g kg: at most cage.rho.max pi/8 (cage.D_o^2 - cage.D_i^2) cage.width = %g kg is allowed for a half lighter than a full ring of the heaviest metal", value, bound);
    }
    if ((!quantity || strcmp(quantity, "cage.m") == 0))
    {
        value = p->cage.m;
        bound = 500.0 * PI / 32.0 * (p->cage.D_o * p->cage.D_o - p->cage.D_i * p->cage.D_i) * p->cage.width;
        if (!(value >= bound))
            fine = broken(report, context, "cage.m = %g kg: at least cage.rho.min pi/32 (cage.D_o^2 - cage.D_i^2) cage.width = %g kg is allowed for a half heavier than a quarter of a full ring of the lightest material", value, bound);
    }
    if ((!quantity || strcmp(quantity, "cage.J_p") == 0))
    {
        value = p->cage.J_p;
        bound = p->cage.m * p->cage.D_o * p->cage.D_o / 4.0;
        if (!(value <= bound + 0.01 * fabs(bound)))
            fine = broken(report, context, "cage.J_p = %g kg.m2: at most cage.m cage.D_o^2/4 = %g kg.m2 is allowed for a half with its mass inside cage.D_o", value, bound);
    }
    if ((!quantity || strcmp(quantity, "cage.J_p") == 0))
    {
        value = p->cage.J_p;
        bound = p->cage.m * p->cage.D_i * p->cage.D_i / 4.0;
        if (!(value >= bound - 0.01 * fabs(bound)))
            fine = broken(report, context, "cage.J_p = %g kg.m2: at least cage.m cage.D_i^2/4 = %g kg.m2 is allowed for a half with its mass outside cage.D_i", value, bound);
    }
    if ((!quantity || strcmp(quantity, "cage.J_p") == 0))
    {
        value = p->cage.J_p;
        bound = 2.0 * p->cage.J_t;
        if (!(value <= bound + 0.01 * fabs(bound)))
            fine = broken(report, context, "cage.J_p = %g kg.m2: at most 2 cage.J_t = %g kg.m2 is allowed for moments of inertia of a body", value, bound);
    }
    if ((!quantity || strcmp(quantity, "cage.J_t") == 0))
    {
        value = p->cage.J_t;
        bound = p->cage.m * (p->cage.D_o * p->cage.D_o + p->cage.width * p->cage.width);
        if (!(value <= bound))
            fine = broken(report, context, "cage.J_t = %g kg.m2: at most cage.m (cage.D_o^2 + cage.width^2) = %g kg.m2 is allowed for a body of at most twice the size of the half", value, bound);
    }
    if ((!quantity || strcmp(quantity, "ring.J_p") == 0))
    {
        value = p->ring.J_p;
        bound = 2.0 * p->ring.J_t;
        if (!(value <= bound + 0.01 * fabs(bound)))
            fine = broken(report, context, "ring.J_p = %g kg.m2: at most 2 ring.J_t = %g kg.m2 is allowed for moments of inertia of a body", value, bound);
    }
    if ((!quantity || strcmp(quantity, "ring.J_p") == 0) && (p->ring.motion == 1 && p->ring.tilt_mode != 1))
    {
        value = p->ring.J_p;
        bound = p->ring.m * p->ring.bore * p->ring.bore / 32.0;
        if (!(value >= bound - 0.01 * fabs(bound)))
            fine = broken(report, context, "ring.J_p = %g kg.m2: at least ring.m ring.bore^2/32 = %g kg.m2 is allowed for a ring with a solid shaft of half the bore at least, which needs no shorter steps", value, bound);
    }
    if ((!quantity || strcmp(quantity, "cage.D_i") == 0))
    {
        value = p->cage.D_i;
        bound = p->bearing.d_m;
        if (!(value < bound))
            fine = broken(report, context, "cage.D_i = %g m: less than bearing.d_m = %g m is allowed for a cage around the pitch circle", value, bound);
    }
    if ((!quantity || strcmp(quantity, "cage.D_o") == 0))
    {
        value = p->cage.D_o;
        bound = p->bearing.d_m;
        if (!(value > bound))
            fine = broken(report, context, "cage.D_o = %g m: more than bearing.d_m = %g m is allowed for a cage around the pitch circle", value, bound);
    }
    if ((!quantity || strcmp(quantity, "cage.pocket_clearance") == 0))
    {
        value = p->cage.pocket_clearance;
        bound = p->bearing.d_m * sin(PI / Z) - p->bearing.D;
        if (!(value < bound))
            fine = broken(report, context, "cage.pocket_clearance = %g m: less than bearing.d_m sin(pi/Z) - bearing.D = %g m is allowed for pockets that do not overlap", value, bound);
    }
    if ((!quantity || strcmp(quantity, "cage.pocket_clearance") == 0) && (p->cage.guidance == 2))
    {
        value = p->cage.pocket_clearance;
        bound = 0.0;
        if (!(value > bound))
            fine = broken(report, context, "cage.pocket_clearance = %g m: more than %g m is allowed for a cage that balls guide", value, bound);
    }
    if ((!quantity || strcmp(quantity, "cage.unbalance") == 0))
    {
        value = p->cage.unbalance;
        bound = 0.0004 * p->cage.m;
        if (!(value <= bound))
            fine = broken(report, context, "cage.unbalance = %g kg.m: at most 0.0004 cage.m = %g kg.m is allowed for a cage whose centre of mass is at most 0.2 mm off", value, bound);
    }
    if ((!quantity || strcmp(quantity, "cage.width") == 0) && (p->cage.shape == 1))
    {
        value = p->cage.width;
        bound = 1.05 * (p->bearing.D + p->cage.pocket_clearance);
        if (!(value >= bound))
            fine = broken(report, context, "cage.width = %g m: at least 1.05 (bearing.D + cage.pocket_clearance) = %g m is allowed for webs that close the pockets", value, bound);
    }
    if ((!quantity || strcmp(quantity, "cage.guidance") == 0) && (p->cage.shape == 2))
    {
        value = p->cage.guidance;
        bound = 2;
        if (!(fabs(value - bound) <= 0.0 * fabs(bound)))
            fine = broken(report, context, "cage.guidance = %g: balls (2) is allowed for a ribbon cage (cage.shape), which has no land on the outer ring", value);
    }
    if ((!quantity || strcmp(quantity, "cage.guidance") == 0) && (p->cage.shape == 1))
    {
        value = p->cage.guidance;
        bound = 1;
        if (!(fabs(value - bound) <= 0.0 * fabs(bound)))
            fine = broken(report, context, "cage.guidance = %g: outer (1) is allowed for a machined cage (cage.shape), whose drilled pockets slide along the radius", value);
    }
    if ((!quantity || strcmp(quantity, "cage.sheet") == 0) && (p->cage.shape == 1))
    {
        value = p->cage.sheet;
        bound = 0.0;
        if (!(fabs(value - bound) <= 0.0 * fabs(bound)))
            fine = broken(report, context, "cage.sheet = %g m: %g m is allowed for a machined cage (cage.shape), which has no such size", value, bound);
    }
    if ((!quantity || strcmp(quantity, "cage.pocket_depth") == 0) && (p->cage.shape == 1))
    {
        value = p->cage.pocket_depth;
        bound = 0.0;
        if (!(fabs(value - bound) <= 0.0 * fabs(bound)))
            fine = broken(report, context, "cage.pocket_depth = %g m: %g m is allowed for a machined cage (cage.shape), which has no such size", value, bound);
    }
    if ((!quantity || strcmp(quantity, "cage.pocket_fillet") == 0) && (p->cage.shape == 1))
    {
        value = p->cage.pocket_fillet;
        bound = 0.0;
        if (!(fabs(value - bound) <= 0.0 * fabs(bound)))
            fine = broken(report, context, "cage.pocket_fillet = %g m: %g m is allowed for a machined cage (cage.shape), which has no such size", value, bound);
    }
    if ((!quantity || strcmp(quantity, "cage.pocket_radius") == 0) && (p->cage.shape == 1))
    {
        value = p->cage.pocket_radius;
        bound = 0.0;
        if (!(fabs(value - bound) <= 0.0 * fabs(bound)))
            fine = broken(report, context, "cage.pocket_radius = %g m: %g m is allowed for a machined cage (cage.shape), which has no such size", value, bound);
    }
    if ((!quantity || strcmp(quantity, "cage.pocket_edge") == 0) && (p->cage.shape == 1))
    {
        value = p->cage.pocket_edge;
        bound = 0.0;
        if (!(fabs(value - bound) <= 0.0 * fabs(bound)))
            fine = broken(report, context, "cage.pocket_edge = %g m: %g m is allowed for a machined cage (cage.shape), which has no such size", value, bound);
    }
    if ((!quantity || strcmp(quantity, "cage.sheet") == 0) && (p->cage.shape == 2))
    {
        value = p->cage.sheet;
        bound = 0.0;
        if (!(value > bound))
            fine = broken(report, context, "cage.sheet = %g m: more than %g m is allowed for a ribbon cage (cage.shape)", value, bound);
    }
    if ((!quantity || strcmp(quantity, "cage.pocket_depth") == 0) && (p->cage.shape == 2))
    {
        value = p->cage.pocket_depth;
        bound = 0.0;
        if (!(value > bound))
            fine = broken(report, context, "cage.pocket_depth = %g m: more than %g m is allowed for a ribbon cage (cage.shape)", value, bound);
    }
    if ((!quantity || strcmp(quantity, "cage.pocket_fillet") == 0) && (p->cage.shape == 2))
    {
        value = p->cage.pocket_fillet;
        bound = 0.0;
        if (!(value > bound))
            fine = broken(report, context, "cage.pocket_fillet = %g m: more than %g m is allowed for a ribbon cage (cage.shape)", value, bound);
    }
    if ((!quantity || strcmp(quantity, "cage.width") == 0) && (p->cage.shape == 2))
    {
        value = p->cage.width;
        bound = 2.0 * (p->cage.pocket_depth + p->cage.sheet);
        if (!(fabs(value - bound) <= 0.01 * fabs(bound)))
            fine = broken(report, context, "cage.width = %g m: 2 (cage.pocket_depth + cage.sheet) = %g m +- 1 %% is allowed for a ribbon as wide as pockets and sheets of both halves", value, bound);
    }
    if ((!quantity || strcmp(quantity, "cage.pocket_radius") == 0) && (p->cage.shape == 2))
    {
        value = p->cage.pocket_radius;
        bound = (p->bearing.D + p->cage.pocket_clearance) / 2.0;
        if (value != 0.0 && !(fabs(value - bound) <= 1e-06 * fabs(bound)))
            fine = broken(report, context, "cage.pocket_radius = %g m: 0, which stands for the sphere that follows, or (bearing.D + cage.pocket_clearance)/2 = %g m +- 0.0001 %% is allowed for a sphere around the ball", value, bound);
    }
    if ((!quantity || strcmp(quantity, "cage.pocket_depth") == 0) && (p->cage.shape == 2))
    {
        value = p->cage.pocket_depth;
        bound = p->bearing.D / 2.0;
        if (!(value > bound))
            fine = broken(report, context, "cage.pocket_depth = %g m: more than bearing.D/2 = %g m is allowed for a pocket with room for the ball", value, bound);
    }
    if ((!quantity || strcmp(quantity, "cage.pocket_depth") == 0) && (p->cage.shape == 2))
    {
        value = p->cage.pocket_depth;
        bound = (p->bearing.D + p->cage.pocket_clearance) / 2.0;
        if (!(value <= bound))
            fine = broken(report, context, "cage.pocket_depth = %g m: at most (bearing.D + cage.pocket_clearance)/2 = %g m is allowed for a pocket no deeper than a sphere", value, bound);
    }
    if ((!quantity || strcmp(quantity, "cage.D_o + cage.D_i") == 0) && (p->cage.shape == 2))
    {
        value = p->cage.D_o + p->cage.D_i;
        bound = 2.0 * (p->bearing.d_m + p->cage.pocket_clearance);
        if (!(value <= bound))
            fine = broken(report, context, "cage.D_o + cage.D_i = %g m: at most 2 (bearing.d_m + cage.pocket_clearance) = %g m is allowed for pockets around the balls (change both diameters)", value, bound);
    }
    if ((!quantity || strcmp(quantity, "cage.D_o + cage.D_i") == 0) && (p->cage.shape == 2))
    {
        value = p->cage.D_o + p->cage.D_i;
        bound = 2.0 * (p->bearing.d_m - p->cage.pocket_clearance);
        if (!(value >= bound))
            fine = broken(report, context, "cage.D_o + cage.D_i = %g m: at least 2 (bearing.d_m - cage.pocket_clearance) = %g m is allowed for pockets around the balls (change both diameters)", value, bound);
    }
    if ((!quantity || strcmp(quantity, "cage.D_o - cage.D_i") == 0) && (p->cage.shape == 2))
    {
        value = p->cage.D_o - p->cage.D_i;
        bound = 8.0 * p->cage.pocket_edge;
        if (!(value > bound))
            fine = broken(report, context, "cage.D_o - cage.D_i = %g m: more than 8 cage.pocket_edge = %g m is allowed for a sphere between the pocket's edges", value, bound);
    }
    if ((!quantity || strcmp(quantity, "ring.bore") == 0))
    {
        value = p->ring.bore;
        bound = p->bearing.d_m - p->bearing.D;
        if (!(value < bound))
            fine = broken(report, context, "ring.bore = %g m: less than bearing.d_m - bearing.D = %g m is allowed for an inner ring below its groove", value, bound);
    }
    if ((!quantity || strcmp(quantity, "ring.bore") == 0))
    {
        value = p->ring.bore;
        bound = 1e-06;
        if (!(value >= bound))
            fine = broken(report, context, "ring.bore = %g m: at least %g m is allowed for a ring, whose bore's square does not underflow", value, bound);
    }
    if ((!quantity || strcmp(quantity, "ring.effective_i") == 0))
    {
        value = p->ring.effective_i;
        bound = p->bearing.d_m - p->bearing.D;
        if (!(value >= bound))
            fine = broken(report, context, "ring.effective_i = %g m: at least bearing.d_m - bearing.D = %g m is allowed for an inner ring up to its groove's bottom at least", value, bound);
    }
    if ((!quantity || strcmp(quantity, "ring.effective_e") == 0))
    {
        value = p->ring.effective_e;
        bound = p->bearing.d_m + p->bearing.D;
        if (!(value <= bound))
            fine = broken(report, context, "ring.effective_e = %g m: at most bearing.d_m + bearing.D = %g m is allowed for an outer ring down to its groove's bottom at least", value, bound);
    }
    if ((!quantity || strcmp(quantity, "ring.outside") == 0))
    {
        value = p->ring.outside;
        bound = p->bearing.d_m + p->bearing.D;
        if (!(value > bound))
            fine = broken(report, context, "ring.outside = %g m: more than bearing.d_m + bearing.D = %g m is allowed for an outer ring above its groove", value, bound);
    }
    if ((!quantity || strcmp(quantity, "shaft.bore") == 0))
    {
        value = p->shaft.bore;
        bound = p->ring.bore;
        if (!(value < bound))
            fine = broken(report, context, "shaft.bore = %g m: less than ring.bore = %g m is allowed for a shaft inside the inner ring", value, bound);
    }
    if ((!quantity || strcmp(quantity, "housing.outside") == 0))
    {
        value = p->housing.outside;
        bound = p->ring.outside;
        if (value != 0.0 && !(value > bound))
            fine = broken(report, context, "housing.outside = %g m: 0, which stands for a thick wall, or more than ring.outside = %g m is allowed for a housing around the outer ring", value, bound);
    }
    if ((!quantity || strcmp(quantity, "ball.E") == 0))
    {
        value = p->ball.E;
        bound = 1000000000.0;
        if (value != 0.0 && !(value >= bound))
            fine = broken(report, context, "ball.E = %g Pa: 0, which stands for bearing.E, or at least bearing.E.min = %g Pa is allowed for balls of a solid", value, bound);
    }
    if ((!quantity || strcmp(quantity, "oil.T_1") == 0))
    {
        value = p->oil.T_1;
        bound = p->oil.T_2;
        if (!(value < bound))
            fine = broken(report, context, "oil.T_1 = %g K: less than oil.T_2 = %g K is allowed for the two points of the oil's viscosity", value, bound);
    }
    if ((!quantity || strcmp(quantity, "oil.nu_1") == 0))
    {
        value = p->oil.nu_1;
        bound = p->oil.nu_2;
        if (!(value > bound))
            fine = broken(report, context, "oil.nu_1 = %g m2/s: more than oil.nu_2 = %g m2/s is allowed for a viscosity that falls with temperature", value, bound);
    }
    if ((!quantity || strcmp(quantity, "fatigue.k_2") == 0))
    {
        value = p->fatigue.k_2;
        bound = p->fatigue.k_1;
        if (!(value >= bound))
            fine = broken(report, context, "fatigue.k_2 = %g: at least fatigue.k_1 = %g is allowed for an S-N line that does not become steeper", value, bound);
    }
    if ((!quantity || strcmp(quantity, "pulse.interval") == 0) && (p->pulse.count >= 2.0))
    {
        value = p->pulse.interval;
        bound = p->pulse.duration;
        if (!(value >= bound))
            fine = broken(report, context, "pulse.interval = %g s: at least pulse.duration = %g s is allowed for impacts one after the other", value, bound);
    }
    if ((!quantity || strcmp(quantity, "pocket[j].dD") == 0))
    for (int j = 0; j < Z; j++)
    {
        value = p->pocket.dD[j];
        bound = -p->cage.pocket_clearance;
        if ((p->pocket.dD[j] < 0.0) && !(value > bound))
            fine = broken(report, context, "pocket[%d].dD = %g m: more than -cage.pocket_clearance = %g m is allowed for a pocket larger than the ball", j + 1, value, bound);
    }
    if ((!quantity || strcmp(quantity, "ball[j].dD") == 0))
    for (int j = 0; j < Z; j++)
    {
        value = p->ball.dD[j];
        bound = p->cage.pocket_clearance + p->pocket.dD[j];
        if ((p->ball.dD[j] > 0.0 && p->cage.pocket_clearance + p->pocket.dD[j] > 0.0) && !(value < bound))
            fine = broken(report, context, "ball[%d].dD = %g m: less than cage.pocket_clearance + pocket[%d].dD = %g m is allowed for a ball smaller than its pocket", j + 1, value, j + 1, bound);
    }
    if ((!quantity || strcmp(quantity, "inner.spall_length") == 0))
    {
        value = p->inner.spall_length;
        bound = PI / 2.0 * (p->bearing.d_m - p->bearing.D);
        if (!(value <= bound))
            fine = broken(report, context, "inner.spall_length = %g m: at most pi/2 (bearing.d_m - bearing.D) = %g m is allowed for a spall along half the circumference at most", value, bound);
    }
    if ((!quantity || strcmp(quantity, "outer.spall_length") == 0))
    {
        value = p->outer.spall_length;
        bound = PI / 2.0 * (p->bearing.d_m + p->bearing.D);
        if (!(value <= bound))
            fine = broken(report, context, "outer.spall_length = %g m: at most pi/2 (bearing.d_m + bearing.D) = %g m is allowed for a spall along half the circumference at most", value, bound);
    }
    if ((!quantity || strcmp(quantity, "ball[j].spall_length") == 0))
    for (int j = 0; j < Z; j++)
    {
        value = p->ball.spall_length[j];
        bound = PI / 2.0 * p->bearing.D;
        if (!(value <= bound))
            fine = broken(report, context, "ball[%d].spall_length = %g m: at most pi/2 bearing.D = %g m is allowed for a spall along half the circumference at most", j + 1, value, bound);
    }
    if ((!quantity || strcmp(quantity, "inner.spall_width") == 0))
    {
        value = p->inner.spall_width;
        bound = p->bearing.D;
        if (!(value <= bound))
            fine = broken(report, context, "inner.spall_width = %g m: at most bearing.D = %g m is allowed for a spall no wider than the ball", value, bound);
    }
    if ((!quantity || strcmp(quantity, "outer.spall_width") == 0))
    {
        value = p->outer.spall_width;
        bound = p->bearing.D;
        if (!(value <= bound))
            fine = broken(report, context, "outer.spall_width = %g m: at most bearing.D = %g m is allowed for a spall no wider than the ball", value, bound);
    }
    if ((!quantity || strcmp(quantity, "ball[j].spall_width") == 0))
    for (int j = 0; j < Z; j++)
    {
        value = p->ball.spall_width[j];
        bound = p->bearing.D;
        if (!(value <= bound))
            fine = broken(report, context, "ball[%d].spall_width = %g m: at most bearing.D = %g m is allowed for a spall no wider than the ball", j + 1, value, bound);
    }
    if ((!quantity || strcmp(quantity, "inner.spall_depth") == 0))
    {
        value = p->inner.spall_depth;
        bound = p->bearing.D / 20.0;
        if (!(value <= bound))
            fine = broken(report, context, "inner.spall_depth = %g m: at most bearing.D/20 = %g m is allowed for a spall over whose edges the ball rolls", value, bound);
    }
    if ((!quantity || strcmp(quantity, "outer.spall_depth") == 0))
    {
        value = p->outer.spall_depth;
        bound = p->bearing.D / 20.0;
        if (!(value <= bound))
            fine = broken(report, context, "outer.spall_depth = %g m: at most bearing.D/20 = %g m is allowed for a spall over whose edges the ball rolls", value, bound);
    }
    if ((!quantity || strcmp(quantity, "ball[j].spall_depth") == 0))
    for (int j = 0; j < Z; j++)
    {
        value = p->ball.spall_depth[j];
        bound = p->bearing.D / 20.0;
        if (!(value <= bound))
            fine = broken(report, context, "ball[%d].spall_depth = %g m: at most bearing.D/20 = %g m is allowed for a spall over whose edges the ball rolls", j + 1, value, bound);
    }
    if ((!quantity || strcmp(quantity, "inner.spall_length") == 0) && (p->inner.spall_width > 0.0 || p->inner.spall_depth > 0.0))
    {
        value = p->inner.spall_length;
        bound = 0.0;
        if (!(value > bound))
            fine = broken(report, context, "inner.spall_length = %g m: more than %g m is allowed for a spall, which has inner.spall_length, inner.spall_width and inner.spall_depth, or 0 for all three", value, bound);
    }
    if ((!quantity || strcmp(quantity, "outer.spall_length") == 0) && (p->outer.spall_width > 0.0 || p->outer.spall_depth > 0.0))
    {
        value = p->outer.spall_length;
        bound = 0.0;
        if (!(value > bound))
            fine = broken(report, context, "outer.spall_length = %g m: more than %g m is allowed for a spall, which has outer.spall_length, outer.spall_width and outer.spall_depth, or 0 for all three", value, bound);
    }
    if ((!quantity || strcmp(quantity, "ball[j].spall_length") == 0))
    for (int j = 0; j < Z; j++)
    {
        value = p->ball.spall_length[j];
        bound = 0.0;
        if ((p->ball.spall_width[j] > 0.0 || p->ball.spall_depth[j] > 0.0) && !(value > bound))
            fine = broken(report, context, "ball[%d].spall_length = %g m: more than %g m is allowed for a spall, which has ball[%d].spall_length, ball[%d].spall_width and ball[%d].spall_depth, or 0 for all three", j + 1, value, bound, j + 1, j + 1, j + 1);
    }
    if ((!quantity || strcmp(quantity, "inner.spall_width") == 0) && (p->inner.spall_length > 0.0 || p->inner.spall_depth > 0.0))
    {
        value = p->inner.spall_width;
        bound = 0.0;
        if (!(value > bound))
            fine = broken(report, context, "inner.spall_width = %g m: more than %g m is allowed for a spall, which has inner.spall_length, inner.spall_width and inner.spall_depth, or 0 for all three", value, bound);
    }
    if ((!quantity || strcmp(quantity, "outer.spall_width") == 0) && (p->outer.spall_length > 0.0 || p->outer.spall_depth > 0.0))
    {
        value = p->outer.spall_width;
        bound = 0.0;
        if (!(value > bound))
            fine = broken(report, context, "outer.spall_width = %g m: more than %g m is allowed for a spall, which has outer.spall_length, outer.spall_width and outer.spall_depth, or 0 for all three", value, bound);
    }
    if ((!quantity || strcmp(quantity, "ball[j].spall_width") == 0))
    for (int j = 0; j < Z; j++)
    {
        value = p->ball.spall_width[j];
        bound = 0.0;
        if ((p->ball.spall_length[j] > 0.0 || p->ball.spall_depth[j] > 0.0) && !(value > bound))
            fine = broken(report, context, "ball[%d].spall_width = %g m: more than %g m is allowed for a spall, which has ball[%d].spall_length, ball[%d].spall_width and ball[%d].spall_depth, or 0 for all three", j + 1, value, bound, j + 1, j + 1, j + 1);
    }
    if ((!quantity || strcmp(quantity, "inner.spall_depth") == 0) && (p->inner.spall_length > 0.0 || p->inner.spall_width > 0.0))
    {
        value = p->inner.spall_depth;
        bound = 0.0;
        if (!(value > bound))
            fine = broken(report, context, "inner.spall_depth = %g m: more than %g m is allowed for a spall, which has inner.spall_length, inner.spall_width and inner.spall_depth, or 0 for all three", value, bound);
    }
    if ((!quantity || strcmp(quantity, "outer.spall_depth") == 0) && (p->outer.spall_length > 0.0 || p->outer.spall_width > 0.0))
    {
        value = p->outer.spall_depth;
        bound = 0.0;
        if (!(value > bound))
            fine = broken(report, context, "outer.spall_depth = %g m: more than %g m is allowed for a spall, which has outer.spall_length, outer.spall_width and outer.spall_depth, or 0 for all three", value, bound);
    }
    if ((!quantity || strcmp(quantity, "ball[j].spall_depth") == 0))
    for (int j = 0; j < Z; j++)
    {
        value = p->ball.spall_depth[j];
        bound = 0.0;
        if ((p->ball.spall_length[j] > 0.0 || p->ball.spall_width[j] > 0.0) && !(value > bound))
            fine = broken(report, context, "ball[%d].spall_depth = %g m: more than %g m is allowed for a spall, which has ball[%d].spall_length, ball[%d].spall_width and ball[%d].spall_depth, or 0 for all three", j + 1, value, bound, j + 1, j + 1, j + 1);
    }
    if ((!quantity || strcmp(quantity, "ball[j].spall_length") == 0))
    for (int j = 0; j < Z; j++)
    {
        value = p->ball.spall_length[j];
        bound = 0.0;
        if ((p->solver.method == 2 && p->ball.spall_width[j] > 0.0 && p->ball.spall_depth[j] > 0.0) && !(fabs(value - bound) <= 0.0 * fabs(bound)))
            fine = broken(report, context, "ball[%d].spall_length = %g m: %g m is allowed for solver.method = explicit, which does not follow the turn of a ball; verlet and fixed do", j + 1, value, bound);
    }
    if ((!quantity || strcmp(quantity, "housing.motion") == 0) && (p->solver.method == 2))
    {
        value = p->housing.motion;
        bound = 1;
        if (!(fabs(value - bound) <= 0.0 * fabs(bound)))
            fine = broken(report, context, "housing.motion = %g: given (1) is allowed for solver.method = explicit, which has no housing on springs; verlet and fixed have", value);
    }
    if ((!quantity || strcmp(quantity, "solver.step") == 0))
    {
        value = p->solver.step;
        bound = 1e-09;
        if (value != 0.0 && !(value >= bound))
            fine = broken(report, context, "solver.step = %g s: 0, which stands for a derived step, or at least %g s is allowed for a run that ends", value, bound);
    }
    if ((!quantity || strcmp(quantity, "scene.breakage") == 0) && (p->scene.stress != 4))
    {
        value = p->scene.breakage;
        bound = 1;
        if (!(fabs(value - bound) <= 0.0 * fabs(bound)))
            fine = broken(report, context, "scene.breakage = %g: off (1) is allowed for a run that counts no damage; scene.stress = fatigue does", value);
    }
    return fine;
}
