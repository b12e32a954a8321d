// Functions of cage.h outside an evaluation: whether the kind of cage is possible, its constants, its rest state, the
// longest step, films behind an evaluation, the check of a saved state.
#include "cage/cage.h"

#include "cage/common/pocket_spheres.h"
#include "cage/elastic/elastic_half.h"
#include "numbers/saved_numbers.h"

const char *cage_refusal(const Parameters *p)
{
    if (p->scene.cage == CAGE_MODEL_TWO_HALF) return NULL;
    if (p->scene.cage != CAGE_MODEL_ELASTIC)
        return "scene.cage = 2: " CAGE_MODEL_RIGID_RETIRED "; allowed are two_half (1), elastic (3)";
    if (rivet_table.modes.modes == 0)
        return "scene.cage = elastic: the embedded rivet table has no vibration modes; build an FMU with a "
               "table by "
               "finite elements, or set scene.cage = two_half";
    return NULL;
}

bool cage_vibrates(const Parameters *p)
{
    return p->scene.cage == CAGE_MODEL_ELASTIC;
}

size_t cage_size(const Parameters *p)
{
    return cage_vibrates(p) ? sizeof(ElasticHalf) : 0;
}

const ElasticHalf *cage_derive(const Parameters *p, const Derived *d, void *memory)
{
    if (!cage_vibrates(p)) return NULL;
    elastic_half_derive(p, d, memory);
    return memory;
}

void cage_scales(const Parameters *p, double *orbit, double *friction)
{
    *orbit = cage_vibrates(p) ? 1.0 / 4.5 : 1.0 / 6.0;
    *friction = cage_vibrates(p) ? 300.0 : 130.0;
}

// Elastic halves are as far apart as their bodies are under the centrifugal load.
void cage_rest(const Model *model, double omega, double *y)
{
    if (!model->modes) return;
    const double beta = y[Y_CAGE_BETA], gamma = y[Y_CAGE_GAMMA];
    const double apart = elastic_half_rest(model->p, model->d, model->modes, omega, &y[Y_MODE_S]);
    const double along[3] = {sqrt(1.0 - beta * beta - gamma * gamma), gamma, -beta};
    for (int i = 0; i < 3; i++)
        for (int h = 0; h < 2; h++) y[Y_CAGE_X + 2 * i + h] += (h == 0 ? -0.5 : 0.5) * apart * along[i];
}

// A ball touches its pocket for 70 to 100 us; a tenth of that resolves the pulse.
static const double TENTH_OF_A_PULSE = 1e-5;

// Angles by which the fastest vibration between rigid halves turns at most: in equal steps velocity Verlet is stable up to 2, whatever
// the matrix of the step has of joints that open or slip in it; in others Fox and Goodwin's method is up to the root of 6.
// In longer ones balls that press lightly or jam the cage feed it: below 2,300 r/min stress was up to five times too large.  Slow halves
// have a part of it: without, stress at 50 to 600 r/min was up to 45 times too large.
static const double RIGID_TURN = 2.0, LONGEST_TURN = 2.449;

// Square of that vibration's frequency [1/s2], all joints closed and sticking: along the axis and of the tilts, in the plane
// and about the axis.
static double rigid_fastest(const Parameters *p, const Derived *d)
{
    double k_hole = 0.0;
    for (int k = 0; k < Z; k++) k_hole = fmax(k_hole, d->k_hole[k]);
    const double r = 0.5 * p->bearing.d_m, along = Z * (d->k_rivet + d->k_plate),
                 across = Z * (d->k_plate_t + k_hole);
    return 2.0 * fmax(along * fmax(1.0 / p->cage.m, 0.5 * r * r / d->J_t),
                      across * fmax(1.0 / p->cage.m, r * r / d->J_p));
}

// Slow forces that are constant over a step of elastic halves feed vibrations that turn by much more than pi in it, so that it has five
// substeps at most, of a ribbon 3.5.  Below SLOW a cage's own speed is of the order of the tolerance's scale, so that the tolerance falls in
// proportion to the speed: 99.9 % force of a ribbon at 394 r/min +5.2 % without, +1.4 % with it.  Films leave two substeps, which are always
// stable, or more: films of the rate A that the substeps leave out 1/A; films in pockets 1/A too, without which the RMS force of a ribbon would
// err by 3 to 5 %, the dislocation of a guided cage under pulses by 22 %; films on bent rims STIFF_GAP.
//
// A gap of the stiffness k, 3e8 N/m at 0.3 degrees of tilt and 1e6 at most without, is a slow force: the substeps follow the rim's velocity
// alone.  It feeds a mode of the mobility Y and the frequency omega by k Y/omega^2 (wall_loads.c), less than its damping as long as
// k Y h^2 < STIFF_GAP.
//
// Near the corners of a ribbon's pockets the place and the direction of a contact change over SEAT: k = Q/SEAT across a contact of the load Q,
// at 140 N as much as along it, which does not follow either.  Equal steps were stable up to k h^2/m = 0.06 to 0.12, m the mass of a half.
// LEAST_PART: of the tolerance, of rigid halves of the step too.
static const double SLOW = 60.0, LEAST_PART = 1.0 / 3.0;  // [rad/s], [1]
static const double STIFF_GAP = 0.6, STIFF_CORNER = 0.06;

double cage_part(const CageMemory *memory)
{
    return fmin(fmax(sqrt(memory->elastic.fast.omega_2) / SLOW, LEAST_PART), 1.0);
}

// Step that balls near the corners of a ribbon's pockets bear [s].
static double corners_bear(const Model *model, const WallTouch *touch)
{
    double Q = 0.0;
    for (int h = 0; h < 2; h++)
        for (int k = 0; k < Z; k++) Q = fmax(Q, touch->Q[h][k]);
    return sqrt(STIFF_CORNER * model->p->cage.m * SEAT / Q);
}

double cage_longest_step(const Model *model, const CageMemory *memory)
{
    if (!model->modes) return cage_part(memory) * LONGEST_TURN / sqrt(rigid_fastest(model->p, model->d));
    const double d = model->modes->substep, most = model->modes->longest_step;
    double rate = 0.0;
    for (int h = 0; h < 2; h++) {
        const bool bent = memory->elastic.films.rates[h][0][0] + memory->elastic.films.rates[h][1][1] > 0.0;
        if (!bent) rate = fmax(rate, memory->halves.film[h].yy + memory->halves.film[h].zz);
    }
    const double lands = fmax(2.0 * d, model->p->cage.m / rate);
    const double pockets = fmax(2.0 * d, 1.0 / memory->halves.pockets.rate);
    const double by_gap = memory->elastic.films.stiffness * model->modes->mobility[0];
    const double rims = fmax(2.0 * d, sqrt(STIFF_GAP / by_gap));
    const double loads = model->d->spheres.on ? corners_bear(model, &memory->elastic.fast.touch) : most;
    return fmin(fmin(fmin(most, fmax(d, loads)), rims), fmin(lands, pockets));
}

// Elastic halves have two substeps: in 102 scenes drawn blind, whose trials shorten most steps, equal steps of three saved a sixth of the
// evaluations alone.  Ribbons have one and a half: with two, balls near the corners of pockets, pressed with 400 N and more, ended 3 of 34 runs.
double cage_fixed_step(const Model *model)
{
    const double substeps = model->d->spheres.on ? 1.5 : 2.0;
    const double bears = model->modes ? substeps * model->modes->substep
                                      : RIGID_TURN / sqrt(rigid_fastest(model->p, model->d));
    return fmin(bears, TENTH_OF_A_PULSE);
}

void cage_keep_films(const CageMemory *memory, Work *w)
{
    const PocketFilms *films = &memory->halves.pockets;
    for (int h = 0; h < 2; h++)
        for (int k = 0; k < Z; k++) {
            const double D = films->D[h][k], F = films->F[h][k], at = w->cage.films.D[h][k];
            const double F_now = at * fmax(w->cage.films.u[h][k], 0.0);
            if (!(D > 0.0 && at > 0.0)) continue;
            pocket_films_add(films, h, k, F - F_now, w);
            w->pocket_dissipated[k] += F * F / D - F_now * F_now / at;
        }
}

// Motions and loads of the joints are up to those of anything that holds; of rigid halves there are films alone.  Members that follow each
// other with one bound are one row.
bool cage_memory_is_valid(const CageMemory *memory, const Parameters *p)
{
    const double elastic = cage_vibrates(p) ? 1.0 : 0.0;
    const FastState *fast = &memory->elastic.fast;
    const WallTouch *touch = &fast->touch;
    const RimFilms *rims = &memory->elastic.films;
    const PocketFilms *pockets = &memory->halves.pockets;
    return values_are_within(&memory->halves.film[0].yy, 8, 1e30) &&  // [N.s/m]
           values_are_within(fast->e[0], 5 * LANES, elastic) &&       // e, u_y, u_z
           values_are_within(touch->x[0], 4 * LANES, elastic) &&      // x, t
           values_are_within(touch->K[0], 2 * LANES, 1e15 * elastic) &&
           values_are_within(touch->delta[0], 2 * LANES, elastic) &&
           values_are_within(touch->Q[0], 2 * LANES, 1e9 * elastic) &&
           values_are_within(touch->r[0], 2 * LANES, elastic) &&
           values_are_within(touch->chi[0], 2 * LANES, 2.0 * elastic) &&
           values_are_within(touch->radius[0], 2 * LANES, 10.0 * elastic) &&
           values_are_within(touch->front[0], 2 * LANES, elastic) &&
           values_are_within(&fast->omega_2, 1, 1e18) &&
           values_are_within(fast->modes, 2 * N_MODES + RELATIVE_MOTIONS, 1e15 * elastic) &&  // modes, rigid
           values_are_within(rims->force[0], 2 * RIM, 1e9 * elastic) &&
           values_are_within(rims->rates[0][0], 2 * SQUEEZE * SQUEEZE + 1,
                             1e30 * elastic) &&  // and stiffness
           values_are_within(memory->elastic.squeeze[0], 2 * SQUEEZE, 1e6 * elastic) &&
           values_are_within(memory->elastic.force[0], 2 * SQUEEZE, 1e30 * elastic) &&
           values_are_within(pockets->D[0], 2 * LANES, 1e15) &&
           values_are_within(pockets->u[0], 2 * LANES, 1e6) &&
           values_are_within(pockets->F[0], 2 * LANES, 1e9) &&
           values_are_within(pockets->m_x[0], 6 * LANES, 2.0) &&
           values_are_within(pockets->shape[0][0], 2 * Z * N_MODES, 1e3 * elastic) &&
           values_are_within(&pockets->rate, 1, 1e30 * elastic);
}
