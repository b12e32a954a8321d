// The cage as the rest of the core knows it: all that may be called from outside this folder.
//
// These functions serve two kinds of cage; cage.c, cage_setup.c and cage_read.c choose between them:
//   two_half/   two rigid halves held by springs and friction of their joints; a static load path to the rivets
//   elastic/    two halves that vibrate; their joints follow from the motion of both pads
// common/ has the parts of both kinds: poses and accelerations of the halves, films, pockets, joints' friction.
//
//              half 0 (-x)   half 1 (+x)
//        ball --> wall | joint k | wall <-- ball        joint k between the pockets k and k + 1
#pragma once

#include "cage/common/pocket_spheres.h"
#include "cage/elastic/elastic_step.h"
#include "cage/two_half/two_half.h"
#include "physics/model.h"
#include "rivet/rivet_rom.h"

// Carried from an evaluation to the next step; of rigid halves the elastic members are 0.  Part of the saved state: no member of any of
// its structs is aligned beyond a double, so that there is no padding between them.
typedef struct {
    HalvesMemory halves;
    ElasticMemory elastic;
} CageMemory;

// Carried from cage_begin to cage_end.
typedef struct {
    HalvesStep halves;
    ElasticStep elastic;
} CageStep;

// ---- the cage of the parameters ------------------------------------------------------------------------------
// The reason why there is no such cage, or NULL.
const char *cage_refusal(const Parameters *p);

// Bytes of memory that the cage needs beside its constants; 0: none.
size_t cage_size(const Parameters *p);

// Derives the cage's own constants into `memory` of cage_size bytes; returns the value for Model.modes.
const ElasticHalf *cage_derive(const Parameters *p, const Derived *d, void *memory);

// Whether the state has modes.
bool cage_vibrates(const Parameters *p);

// Error scales: of a ball's velocity along its orbit, in parts of that of velocities, because it decides how the ball meets
// its pocket, less so where walls give way; of the friction states, in deflections at which the plates slip.
void cage_scales(const Parameters *p, double *orbit, double *friction);

// Number of states of the scene.
static inline int cage_states(const Model *model)
{
    return model->modes ? N_ALL_STATES : N_STATES;
}

// ---- start --------------------------------------------------------------------------------------------------
// Puts the cage, which turns steadily with the speed omega [rad/s], into its rest under the centrifugal load.
void cage_rest(const Model *model, double omega, double *y);

// ---- one evaluation, in this order --------------------------------------------------------------------------
// Poses and velocities of the halves; coordinates of the modes.
void cage_kinematics(const Model *model, const scalar *y, Work *w);

// Contacts of balls and pockets: adds to balls and halves (race_contact_force before).
void cage_pockets(const Model *model, Work *w);

// Forces of the joints on the halves, rates of their friction, tension of the rivets.
void cage_joints(const Model *model, const scalar *y, Work *w);

// Rates of all states of the cage under the forces on the halves.
void cage_acceleration(const Model *model, const scalar *y, Work *w, scalar *y_dot);

// ---- one step of the default method (verlet.c) --------------------------------------------------------------
// Separates the part that the cage advances by itself from the rates f at the state y, where w was evaluated.
void cage_split(const Model *model, const double *y, const Work *w, double *f, CageMemory *memory);

// Before the evaluation at the end of a step of length h: sets the cage's rows of y, which has all other positions of the
// end and friction states and work of the start, to positions of the end and predicted velocities.  middle: the state in the middle.
void cage_begin(const Model *model, double h, const StepFrom *from, const CageMemory *memory,
                const double *middle, double *y, CageStep *step, Work *w);

// After it: solves for the cage's velocities, sets the cage's rows of `to` and its memory, and takes from the other rates
// of the evaluation the share of films that are implicit.  Returns the power of films beyond that of residual and delta [W].
double cage_end(const Model *model, CageStep *step, const StepFrom *from, const CageMemory *before,
                const StepTo *to, CageMemory *memory, Work *w);

// Maps the friction states back at the end of a step of another method, which ends at the state y and its evaluation w:
// `before` is the state at its start.
typedef void CageSlide(const Model *model, const double *before, double *y, Work *w);
CageSlide cage_slide;

// Part of the longest step and of the tolerance that the cage is given: 1, less of a slow cage.
double cage_part(const CageMemory *memory);

// The longest step that the cage bears from its memory [s].
double cage_longest_step(const Model *model, const CageMemory *memory);

// The longest step of a fixed length [s] that vibrations and pulses allow.
double cage_fixed_step(const Model *model);

// Whether steps can have made the memory.
bool cage_memory_is_valid(const CageMemory *memory, const Parameters *p);

// ---- read from an evaluation --------------------------------------------------------------------------------
// Loads of all joints, of which the stress table takes those of the rivets.
typedef void CageLoads(const Model *model, const Work *w, JointLoads *load);
CageLoads cage_loads;

// Loads and losses of the pockets at a state that a step has reached, of which w is another evaluation: those of the films that the step solved for.
void cage_keep_films(const CageMemory *memory, Work *w);

// Slip of half 1 against half 0 at each joint, in the plane [m].
void cage_slip(const Model *model, const Work *w, scalar slip[Z]);

// Kinetic energy of the halves, elastic energy of pockets, joints and modes [J], less cage_widened.
scalar cage_energy(const Model *model, const scalar *y, const Work *w);

// Work of a turning frame's centrifugal load, which has widened the halves [J], and its rate [W].  Of the modes'
// powers this one counts as a potential, because modes turn by much more than pi in a step.
INLINE scalar cage_widened(const Work *w)
{
    return 0.5 * (w->cage.elastic.more_J[0] + w->cage.elastic.more_J[1]) * (w->frame_omega * w->frame_omega);
}

INLINE scalar cage_widening(const Work *w, scalar frame_omega_dot)
{
    scalar power = 0.0;
    for (int h = 0; h < 2; h++)
        power += w->frame_omega * (0.5 * w->cage.elastic.more_J_dot[h] * w->frame_omega +
                                   w->cage.elastic.more_J[h] * frame_omega_dot);
    return power;
}

// Power that the frame's angular acceleration draws from the moment of inertia that the halves have gained by widening [W].
INLINE scalar cage_drawn(const Work *w, scalar frame_omega_dot)
{
    scalar power = 0.0;
    for (int h = 0; h < 2; h++)
        power += w->cage.elastic.more_J[h] * frame_omega_dot * (w->half[h].s + w->frame_omega);
    return power;
}

// Power that the halves' vibrations and the damping between rigid halves lose [W].  The loss by friction is no function of
// a state: it is the work of a step's slip (cage_end).
INLINE scalar cage_vibrations_lose(const Work *w)
{
    return w->cage.elastic.dissipated;
}

INLINE scalar cage_joints_damp(const Work *w)
{
    return w->cage.two_half.dissipated;
}

// Motions of half h at the rivets by its modes, in the rivets' frames [m].
void cage_flex(const Model *model, const Work *w, int h, scalar x[Z], scalar r[Z], scalar t[Z]);
