// Vibration modes of a free cage half in cyclic form, and the residual, the static flexibility
// that they do not contain.  The head of
// bearing_model/cage/elastic/half_modes.py has the equations; rivet_model/half_modes.py finds the numbers by
// finite elements.
#pragma once

#include "cage/common/joint_law.h"

// Displacements (x, r, t) and rotations about them of a pad, work-conjugate to the loads of the bonded joint, at the
// rivet.
enum { PAD_X, PAD_R, PAD_T, PAD_PHI_X, PAD_PHI_R, PAD_PHI_T, PADS };

// Which of a pad's motions the mirror image in the rivet's plane turns round.
static const bool PAD_ODD[PADS] = {[PAD_T] = true, [PAD_PHI_X] = true, [PAD_PHI_R] = true};

// A pair of modes (coordinates a and b) or a single one, normalised with the mass `half.m`.
typedef struct {
    double omega;     // [rad/s]
    int harmonic;     // n = 0...Z/2
    int parity;       // 0: a and b; 1: a alone; -1: b alone
    double at[PADS];  // amplitudes at the pad
    double spin;      // modal force per (rad/s)^2
    // of the rim's radial displacement at the land: cos p theta of a, sin p theta of b, p = 2 and 3, by 1 and x
    double rim[2][2][2];
} HalfMode;

typedef struct {
    int entries;            // 0: closed forms have none
    int modes;              // pairs counted as two
    const HalfMode *entry;  // [entries], by rising omega
    const double *pocket;   // [entries][chi][value, slope][x, r, t][U', U''] at the pocket's wall, side t > 0
    double pad[PADS][PADS];  // residual: displacements of a pad by unit loads on it, less those of the modes
    const double *wall;      // [chi] of the wall under the contact, along its normal [m/N]
    // over L_K = L + K_0 delta, K_0 the stiffness that the modes leave around a joint: gives L in place of delta,
    // because L_K - K_0 delta is a small difference, and U, whose slope is delta; without neighbours
    JointLaw law;
} HalfModes;
