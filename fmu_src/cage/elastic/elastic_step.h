// Elastic halves in a step of the default method.  Equations in elastic_step.c.
#pragma once

#include "cage/common/halves_step.h"
#include "cage/elastic/cage_substeps.h"
#include "cage/elastic/rim_films.h"
#include "physics/model.h"

// Carried from an evaluation to the next step.
typedef struct {
    FastState fast;
    RimFilms films;
    double squeeze[2][SQUEEZE],
        force[2]
             [SQUEEZE];  // squeeze velocities of lands and shapes of bent rims [m/s], the films' forces [N]
} ElasticMemory;

// Between the two halves of a step: slow accelerations at the end as the substeps foresee them; forces on bent rims at the
// end that with those at the start make their impulses so far [N]; films in pockets.
typedef struct {
    Foreseen foreseen;
    double rim_before[2][RIM];
    PocketFilmsStep pockets;
} ElasticStep;

// Separates the part that the halves advance by themselves from the rates f at the state y, where w was evaluated.
void elastic_split(const Model *model, const double *y, const Work *w, double *f, ElasticMemory *memory);

// Motion and predicted velocities (cage_begin).
void elastic_begin(const Model *model, double h, const StepFrom *from, const HalvesMemory *at,
                   const ElasticMemory *memory, const double *middle, double *y, HalvesStep *halves,
                   ElasticStep *step, Work *w);

// Solution, corrections and history (cage_end).
double elastic_end(const Model *model, HalvesStep *halves, const ElasticStep *step, const StepFrom *from,
                   const HalvesMemory *at, const ElasticMemory *before, const StepTo *to,
                   HalvesMemory *at_end, ElasticMemory *memory, Work *w);

// Maps the friction states in y back under the loads in w.
void elastic_slide(const Model *model, double *y, JointStep *joints, Work *w);
