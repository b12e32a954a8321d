// Fatigue of one stress channel: streaming rainflow counting (ASTM E1049-85, 5.4.4) and Miner's sum.
//
// Turning points go onto a stack.  Whenever the last range is not smaller than the range before it, the range
// before it is counted: as a whole cycle, or as half a cycle if it holds the history's first point.  The
// ranges that remain on the stack count as half cycles when damage is read.
//
//     N(sigma_ar) = N_D (sigma_ar/sigma_D)^-k,   k = k_1 above the knee sigma_D, k_2 below (k_2 = 2 k_1 - 1: Haibach)
//
// sigma_ar is the amplitude at zero mean that does the same damage as the amplitude sigma_a about the mean
// sigma_mean (Dowling, Mechanical Behavior of Materials):
//     none     sigma_a
//     Goodman  sigma_a/(1 - sigma_mean/sigma_m), no credit for compression (sigma_mean < 0 counts as 0)
//     SWT      sqrt(sigma_max sigma_a), 0 if sigma_max <= 0
//     Morrow   sigma_a/(1 - sigma_mean/sigma_f)
// fatigue.acceleration multiplies the damage of every cycle that is counted.
// A cycle whose mean reaches sigma_m or sigma_f, or whose life is below one cycle, breaks the part: its
// damage is 1.
#pragma once

#include "variables.h"

#include <stdbool.h>

// Material: parameters fatigue.* of the variable table.
typedef struct Parameters_fatigue FatigueLaw;

// The law of rivet k, whose strength_factor scales all strengths.
FatigueLaw fatigue_law(const Parameters *p, int k);

// Capacity of the stack.  The ranges on the stack shrink toward its end, so its length grows with the
// logarithm of the signal's resolution: 2e5 random samples took 26 points.
enum { FATIGUE_DEPTH = 128 };

// Plain bytes: a copy of them is a saved channel.  All zeros is a channel without history.
typedef struct {
    double stack[FATIGUE_DEPTH];  // turning points not yet counted [Pa]
    double last;                  // newest sample, not yet known to be a turning point [Pa]
    double damage;                // Miner's sum of the cycles closed so far
    int depth;                    // used part of stack
    int direction;                // sign of the last change, 0 before the first one
    int samples;                  // 0 or 1: whether there is a first sample
    int dropped;                  // first points dropped, counted as half cycles, because the stack was full
} FatigueChannel;

// Law of the shank's middle in a hole with an effective fit [m].  An interference presses the hole on the shank, whose
// surface then slips at the edges of the contact under any alternating load.  Fretting divides the strength:
//     sigma_D / fretting,   fit_eff > 0            DIN 743-2 for shafts in press fits
// There is no pressure in a hole with play, except where a half has slipped through it: that is left out.
FatigueLaw fatigue_law_in_hole(const FatigueLaw *law, double fit_eff);

// Damage of one cycle.
double fatigue_cycle(const FatigueLaw *law, double range, double mean);

// Adds the next sample of the history.
void fatigue_push(FatigueChannel *c, const FatigueLaw *law, double sigma);

// Miner's sum with the ranges that remain on the stack as half cycles; the channel does not change.
double fatigue_damage(const FatigueChannel *c, const FatigueLaw *law);

// Whether pushing samples can have made the channel.
bool fatigue_is_valid(const FatigueChannel *c);
