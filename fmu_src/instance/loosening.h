// Loosening: preload lost by wear of the joint's faces, off while joint.wear = 0.
//
//   V' = K F s'                    Archard (1953): volume worn off per time, F normal force, s slip;  K = k/H = joint.wear
//   P' = -k_stack V'/A             the faces press on A, the rivet's seat about its shank; the rivet loses the worn
//                                  thickness as elongation against the flanges, k_stack [N/m]
//
// F s is summed over plates (F = N_plate) and heads (F = T), over every slip of a step (cage_joint_slide).  The loss grows with every accepted
// step.  The preload changes at a communication point, once the loss not yet applied exceeds PRELOAD_SHARE of joint.preload.
#pragma once

#include "variables.h"

#include <stdbool.h>

// Plain bytes, part of the saved state.
typedef struct {
    double loss[Z];      // preload lost by each rivet since the start [N]
    double in_force[Z];  // the part of it that the constants contain [N]
} Loosening;

// Adds a step in which each joint has rubbed, force times slip [J].
void loosening_add(const Parameters *p, const double *rubbed, Loosening *loose);

// Takes the loss in force from the preloads in p.
void loosening_apply(const Loosening *loose, Parameters *p);

// Puts the loss in force if it has grown enough; returns whether it has.  preload: joint.preload at temperature [N], P: preload of
// each rivet at present [N].
bool loosening_update(double preload, const double P[Z], Loosening *loose);

// Whether steps can have made it.
bool loosening_is_valid(const Loosening *loose);
