// What is refused before a run: values outside their limits, parameters that make no bearing, a rivet table for another one.
#include "instance.h"
#include "ring_load.h"

#include <stdarg.h>
#include <stdio.h>

void bearing_log(Bearing *b, LogCategory category, const char *format, ...)
{
    if (b->host.log == NULL) return;
    char message[1024];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(message, sizeof message, format, arguments);
    va_end(arguments);
    b->host.log(b->host.environment, category, message);
}

static bool check_variables(Bearing *b, Causality causality, const void *values)
{
    bool fine = true;
    for (int v = 0; v < N_VARIABLES && VARIABLES[v].causality <= causality; v++) {  // they are in the order of causality
        if (VARIABLES[v].causality != causality) continue;
        for (int i = 0; i < VARIABLES[v].count; i++) {
            const char *at = (const char *)values + VARIABLES[v].offset;
            const double value = VARIABLES[v].type == TYPE_REAL ? ((const double *)at)[i] : ((const int *)at)[i];
            char message[512];
            if (variable_allows(&VARIABLES[v], i, value, message, sizeof message)) continue;
            bearing_log(b, LOG_ERROR, "%s", message);
            fine = false;
        }
    }
    return fine;
}

// Polynomials of second order are extreme at the ends or where their slope vanishes.
bool check_inputs(Bearing *b, double h)
{
    const double *u_1 = (const double *)&b->s.u[1], *u_2 = (const double *)&b->s.u[2];
    InputTrajectory trajectory = {.t_0 = 0.0, .u = {b->s.u[0], b->s.u[1], b->s.u[2]}};
    Inputs u = b->s.u[0], turning = u;
    if (!input_trajectory_varies(&trajectory)) return check_variables(b, CAUSALITY_INPUT, &u);
    input_trajectory_at(&trajectory, h, &u);
    for (int i = 0; i < N_INPUTS; i++) {
        const double tau = -u_1[i] / u_2[i];
        if (tau > 0.0 && tau < h) ((double *)&turning)[i] += 0.5 * tau * u_1[i];
    }
    return check_variables(b, CAUSALITY_INPUT, &b->s.u[0]) && check_variables(b, CAUSALITY_INPUT, &u) && check_variables(b, CAUSALITY_INPUT, &turning);
}

static bool require(Bearing *b, bool condition, const char *format, double value, double limit)
{
    if (!condition) bearing_log(b, LOG_ERROR, format, value, limit);
    return condition;
}

// Parameters against each other.
static bool check_geometry(Bearing *b)
{
    const Parameters *p = &b->s.p;
    const double PI = 3.14159265358979323846, D = p->bearing.D, d_m = p->bearing.d_m;
    const double chord = d_m * sin(PI / Z), play = 4.0 * (fmin(p->bearing.f_i, p->bearing.f_e) - 0.5) * D;
    bool fine = true;
    fine &= require(b, D < chord, "bearing.D = %g m: the balls overlap; less than bearing.d_m sin(pi/Z) = %g m is allowed", D, chord);
    fine &= require(b, D + p->cage.pocket_clearance < chord,
                    "cage.pocket_clearance = %g m: the pockets overlap; less than bearing.d_m sin(pi/Z) - bearing.D = %g m is allowed",
                    p->cage.pocket_clearance, chord - D);
    fine &= require(b, p->bearing.P_d < play,
                    "bearing.P_d = %g m: a ball on one race would reach the other groove's far side; less than 4 (min(f_i, f_e) - 1/2) D = %g m is allowed",
                    p->bearing.P_d, play);
    fine &= require(b, -p->bearing.P_d < 0.01 * D, "bearing.P_d = %g m: the interference exceeds 1 %% of bearing.D; at least %g m is allowed", p->bearing.P_d,
                    -0.01 * D);
    fine &= require(b, p->cage.D_i < p->cage.D_o, "cage.D_i = %g m: less than cage.D_o = %g m is allowed", p->cage.D_i, p->cage.D_o);
    fine &= require(b, p->cage.D_i < d_m, "cage.D_i = %g m: less than bearing.d_m = %g m is allowed", p->cage.D_i, d_m);
    fine &= require(b, d_m < p->cage.D_o, "cage.D_o = %g m: more than bearing.d_m = %g m is allowed", p->cage.D_o, d_m);
    fine &= require(b, p->cage.land_width <= 0.5 * p->cage.width, "cage.land_width = %g m: at most half of cage.width, %g m, is allowed", p->cage.land_width,
                    0.5 * p->cage.width);
    fine &= require(b, p->fatigue.k_2 >= p->fatigue.k_1, "fatigue.k_2 = %g: at least fatigue.k_1 = %g is allowed", p->fatigue.k_2, p->fatigue.k_1);
    fine &= require(b, p->pulse.count < 2 || p->pulse.interval >= p->pulse.duration, "pulse.interval = %g s: at least pulse.duration = %g s is allowed",
                    p->pulse.interval, p->pulse.duration);
    for (int j = 0; j < Z; j++) {
        if (p->ball.dD[j] < p->cage.pocket_clearance || p->ball.dD[j] <= 0.0) continue;
        bearing_log(b, LOG_ERROR, "ball[%d].dD = %g m: less than cage.pocket_clearance = %g m is allowed", j + 1, p->ball.dD[j], p->cage.pocket_clearance);
        fine = false;
    }
    return fine;
}

// The embedded rivet table belongs to one number of rivets and one pitch circle.
static bool check_table(Bearing *b)
{
    const double d_m = b->s.p.bearing.d_m, table = rivet_table.joint.d_m;
    bool fine =
        require(b, rivet_table.Z == Z, "the embedded rivet table is for Z = %g; this FMU has Z = %g: build it with a table for this bearing", rivet_table.Z, Z);
    fine &= require(b, fabs(d_m - table) <= 1e-3 * table, "bearing.d_m = %g m: the embedded load path is for %g m +- 0.1 %%; build an FMU for this bearing",
                    d_m, table);
    return fine;
}

bool check_all(Bearing *b)
{
    bool fine = check_variables(b, CAUSALITY_PARAMETER, &b->s.p);
    fine &= check_inputs(b, 0.0);
    return fine && check_geometry(b) && check_table(b);
}

bool check_start(Bearing *b)
{
    const double HALF_PI = 1.57079632679489662;
    for (int i = 0; i < 2 * Z; i++) {
        const double reach = ellipse_reach(&b->model, &b->w, i % 2 == 1, i / 2);
        if (reach < HALF_PI) continue;
        bearing_log(b, LOG_ERROR,
                    "ball[%d] is pressed out of the %s race's groove at the start: its contact reaches to %g rad, less than pi/2 is allowed; shaft.F_x = %g N, "
                    "shaft.F_y = %g N, shaft.F_z = %g N, shaft.tilt_y = %g rad, shaft.tilt_z = %g rad are too much",
                    i / 2 + 1, i % 2 == 1 ? "outer" : "inner", reach, b->s.u[0].shaft.F_x, b->s.u[0].shaft.F_y, b->s.u[0].shaft.F_z, b->s.u[0].shaft.tilt_y,
                    b->s.u[0].shaft.tilt_z);
        return false;
    }
    return true;
}
