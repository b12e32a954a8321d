// Rivets that break by their damage (scene.breakage = on): at the end of a communication step in which the damage of a
// rivet's head or middle has reached 1.  The joint then behaves as with rivet[k].intact = 0: from the next
// step on its neighbours carry its load, and no more damage of this rivet is counted.
#pragma once

#include "instance/fatigue.h"
#include "variables.h"

enum { HOLDS, BROKEN_HEAD, BROKEN_MIDDLE, BROKEN_BY_HOST };

// Plain bytes, part of the saved state.  All zeros is a cage whose rivets hold.
typedef struct {
    double time[Z];  // at which the rivet broke [s]
    int place[Z];    // where: HOLDS, BROKEN_HEAD or BROKEN_MIDDLE
    int latest;      // how many broke at the last communication point
} Breakage;

// Takes the broken rivets out of the parameters p.
void breakage_apply(const Breakage *broken, Parameters *p);

// Marks the rivets whose damage has reached 1 at time t; returns whether there are any.  fit_eff: of each rivet [m].
bool breakage_update(const Parameters *p, double t, const double fit_eff[Z], const FatigueChannel head[Z],
                     const FatigueChannel mid[Z], Breakage *broken);

// Whether rivet k holds; by damage or by the host it may not.
bool rivet_holds(const Parameters *p, const Breakage *broken, int k);

// Where rivet k is broken, by damage or by the host.
int rivet_broken(const Parameters *p, const Breakage *broken, int k);

// Whether steps up to time t can have made it.
bool breakage_is_valid(const Breakage *broken, double t_start, double t);
