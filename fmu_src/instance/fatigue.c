// Streaming rainflow and Miner's sum: see fatigue.h.
#include "instance/fatigue.h"

#include "numbers/saved_numbers.h"

#include <limits.h>
#include <math.h>
#include <string.h>

FatigueLaw fatigue_law(const Parameters *p, int k)
{
    FatigueLaw law = p->fatigue;
    law.sigma_D *= p->rivet.strength_factor[k];
    law.sigma_m *= p->rivet.strength_factor[k];
    law.sigma_f *= p->rivet.strength_factor[k];
    return law;
}

// Amplitude that does the same damage at zero mean; infinite where the mean alone breaks the part.
static double fully_reversed(const FatigueLaw *law, double sigma_a, double sigma_mean)
{
    double room;
    switch (law->mean_stress) {
    case MEAN_STRESS_GOODMAN:
        room = 1.0 - fmax(sigma_mean, 0.0) / law->sigma_m;
        return room > 0.0 ? sigma_a / room : INFINITY;
    case MEAN_STRESS_MORROW:
        room = 1.0 - sigma_mean / law->sigma_f;
        return room > 0.0 ? sigma_a / room : INFINITY;
    case MEAN_STRESS_SWT: return sqrt(fmax(sigma_mean + sigma_a, 0.0) * sigma_a);
    default: return sigma_a;
    }
}

FatigueLaw fatigue_law_in_hole(const FatigueLaw *law, double fit_eff)
{
    FatigueLaw in_hole = *law;
    if (fit_eff > 0.0) in_hole.sigma_D /= law->fretting;
    return in_hole;
}

double fatigue_cycle(const FatigueLaw *law, double range, double mean)
{
    double sigma_ar = fully_reversed(law, 0.5 * range, mean);
    double k = sigma_ar > law->sigma_D ? law->k_1 : law->k_2;
    return fmin(pow(sigma_ar / law->sigma_D, k) / law->N_D, 1.0);
}

// Damage of a number of cycles between two stresses.
static double count(const FatigueLaw *law, double cycles, double from, double to)
{
    return law->acceleration * cycles * fatigue_cycle(law, fabs(from - to), 0.5 * (from + to));
}

// Counts the first range of the stack as half a cycle and takes its first point off.
static void drop_first(FatigueChannel *c, const FatigueLaw *law)
{
    c->damage += count(law, 0.5, c->stack[0], c->stack[1]);
    memmove(c->stack, c->stack + 1, (size_t)(--c->depth) * sizeof c->stack[0]);
}

// Puts a turning point on the stack and counts the cycles that it closes.
static void turning_point(FatigueChannel *c, const FatigueLaw *law, double sigma)
{
    if (c->depth == FATIGUE_DEPTH) {
        drop_first(c, law);
        if (c->dropped < INT_MAX) c->dropped++;
    }
    c->stack[c->depth++] = sigma;
    while (c->depth >= 3) {
        double *p = c->stack + c->depth;
        if (fabs(p[-1] - p[-2]) < fabs(p[-2] - p[-3])) return;
        if (c->depth == 3) {
            drop_first(c, law);
        } else {
            c->damage += count(law, 1.0, p[-3], p[-2]);
            p[-3] = p[-1];
            c->depth -= 2;
        }
    }
}

void fatigue_push(FatigueChannel *c, const FatigueLaw *law, double sigma)
{
    int direction = (sigma > c->last) - (sigma < c->last);
    if (c->samples == 0) {
        c->samples = 1;
        turning_point(c, law, sigma);
    } else if (direction != 0) {
        if (direction == -c->direction) turning_point(c, law, c->last);
        c->direction = direction;
    }
    c->last = sigma;
}

double fatigue_damage(const FatigueChannel *c, const FatigueLaw *law)
{
    FatigueChannel rest = *c;
    if (rest.direction != 0) turning_point(&rest, law, rest.last);  // the newest sample ends the history
    for (int i = 1; i < rest.depth; i++) rest.damage += count(law, 0.5, rest.stack[i - 1], rest.stack[i]);
    return rest.damage;
}

bool fatigue_is_valid(const FatigueChannel *c)
{
    const bool counts = c->depth >= 0 && c->depth <= FATIGUE_DEPTH && c->direction >= -1 &&
                        c->direction <= 1 && c->dropped >= 0;
    const bool begun = c->samples == 1 && c->depth > 0,
               empty = c->samples == 0 && c->depth == 0 && c->direction == 0 && c->dropped == 0;
    return counts && (begun || empty) && values_are_sane(c->stack, FATIGUE_DEPTH) &&
           values_are_sane(&c->last, 1) && values_are_amounts(&c->damage, 1);
}
