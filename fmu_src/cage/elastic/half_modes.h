// Vibration modes of a free cage half in cyclic form, and the static flexibility beside them.  The head of
// bearing_model/cage/elastic/half_modes.py has the equations; rivet_model/half_modes.py finds the numbers by
// finite elements.
#pragma once

#include "cage/common/joint_law.h"
#include "numbers/isa.h"

// Displacements (x, r, t) and rotations about them of a pad, work-conjugate to what the bonded joint carries, at the
// rivet; then what its rivet gets because the half gives under its head (rows dP, dm_r, dm_t of half_path.h).
enum {
    PAD_X,
    PAD_R,
    PAD_T,
    PAD_PHI_X,
    PAD_PHI_R,
    PAD_PHI_T,
    PADS,
    RIVET_DP = PADS,
    RIVET_DM_R,
    RIVET_DM_T,
    SEATS
};

// Which of a pad's motions the mirror image in the rivet's plane turns round.
static const bool PAD_ODD[PADS] = {[PAD_T] = true, [PAD_PHI_X] = true, [PAD_PHI_R] = true};

// A pair of modes (coordinates a and b) or a single one, normalised with the mass `half.m`.
typedef struct {
    double omega;      // [rad/s]
    int harmonic;      // n = 0...Z/2
    int parity;        // 0: a and b; 1: a alone; -1: b alone
    int modes;         // 2 of a pair, else 1
    double at[SEATS];  // amplitudes at pad and rivet
    double rim[2];  // amplitude of the mean radial displacement cos(n theta) of the outer and the inner rim
    double spin;    // modal force per (rad/s)^2
} HalfMode;

typedef struct {
    int entries;            // 0: closed forms have none
    int modes;              // pairs counted as two
    const HalfMode *entry;  // [entries], by rising omega
    const double *pocket;   // [entries][chi][value, slope][x, r, t][U', U''] at the pocket's wall, side t > 0
    // residual: displacements by unit loads, less those of the modes
    const double (*pad)[PADS][PADS];            // [Z] at the pad k pitches farther than the loaded pad
    const double (*rivet)[SEATS - PADS][PADS];  // [Z]
    const double *wall_to;  // [chi][value, slope][Z][SEATS][x, r, t] by forces on the wall of pocket 0
    double spin[SEATS];     // per (rad/s)^2, at any rivet
    const double *wall;     // [chi][value, slope] of the wall under the contact, along its normal [m/N]
    // over L^ = L + K_0 delta, K_0 the stiffness that the modes leave around a joint: gives L in place of delta,
    // because L^ - K_0 delta is a small difference, and U, whose slope is delta; without neighbours
    JointLaw law;
} HalfModes;
