// The cage as the rest of the core knows it: all that may be called from outside this folder.
//
// These functions serve two kinds of cage; cage.c, cage_setup.c and cage_read.c choose between them:
//   two_half/   two rigid halves held by springs and friction of their joints; a static load path to the rivets
//   elastic/    two halves that vibrate; their joints follow from the motion of both pads
// common/ has what both share: poses and accelerations of the halves, films, pockets, joints' friction.
//
//              half 0 (-x)   half 1 (+x)
//        ball --> wall | joint k | wall <-- ball        joint k between the pockets k and k + 1
#pragma once

#include "cage/common/films.h"
#include "cage/common/pocket_spheres.h"
#include "cage/elastic/cage_substeps.h"
#include "cage/elastic/rim_films.h"
#include "cage/two_half/two_half.h"
#include "numbers/isa.h"
#include "physics/land_bent.h"
#include "physics/model.h"
#include "rivet/rivet_rom.h"

// Carried from an evaluation to the next step, of the kind of cage that runs; of the other 0.  Part of the saved state: no
// member is aligned beyond a double, so that nothing lies between them.
typedef struct {
    FastState fast;
    RimFilms films;
    double squeeze[2][SQUEEZE];  // squeeze velocities of their lands and shapes [m/s]
    PocketFilms pockets;
} CageMemory;

// ---- what the parameters ask for ----------------------------------------------------------------------------
// The reason why there is no such cage, or NULL.
const char *cage_refusal(const Parameters *p);

// Bytes of memory that the cage needs beside its constants; 0: none.
size_t cage_size(const Parameters *p);

// Derives the cage's own constants into `memory` of cage_size bytes; returns what Model.modes has to be.
const ElasticHalf *cage_derive(const Parameters *p, const Derived *d, void *memory);

// Whether the state has modes.
bool cage_vibrates(const Parameters *p);

// Part of the velocity scale that a ball's velocity along its orbit gets: it decides how the ball meets its pocket,
// less so where walls give way.
double cage_orbit_scale(const Parameters *p);

// Deflections at which the plates slip that the scale of the friction states gets: their errors hardly change the halves'
// velocities, and less so where halves give way.
double cage_friction_scale(const Parameters *p);

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
#define cage_kinematics FOR_ISA(cage_kinematics)
void cage_kinematics(const Model *model, const scalar *y, Work *w);

// Contacts of balls and pockets: adds to balls and halves (race_contact_force before).
#define cage_pockets FOR_ISA(cage_pockets)
void cage_pockets(const Model *model, Work *w);

// Forces of the joints on the halves, rates of their friction, tension of the rivets.
#define cage_joints FOR_ISA(cage_joints)
void cage_joints(const Model *model, const scalar *y, Work *w);

// Rates of all states of the cage under the forces on the halves.
#define cage_acceleration FOR_ISA(cage_acceleration)
void cage_acceleration(const Model *model, const scalar *y, Work *w, scalar *y_dot);

// ---- one step of the default method (verlet.c) --------------------------------------------------------------
// Between the stages of a step: what the halves' own substeps foresee, weights of the position corrections.
typedef struct {
    Foreseen foreseen;  // slow accelerations at the end
    double gamma;       // half of the step [s]
    JointStep joints;   // friction
    double axial, shear;
    // bent rims: what the accelerations foreseen of their shapes lack at the end [m/s2], squeeze velocities, the solution
    double rim_lack[2][RIM], squeeze[2][SQUEEZE];
    // forces on them: held at both ends of the step, and those at its start that their impulses so far amount to
    double rim_held[2][RIM], rim_before[2][RIM];
    BentSolution bent[2];
    PocketFilmsStep pockets;
} CageStep;

// Separates what the cage advances by itself from the rates f at the state y, where w was evaluated.
#define cage_split FOR_ISA(cage_split)
void cage_split(const Model *model, const double *y, const Work *w, double *f, CageMemory *memory);

// Over a step h from the state y_0, its rates f and its memory: rotations, friction states and modes in y, whose other
// rows have their values at the end; middle: the state in the middle.
#define cage_advance FOR_ISA(cage_advance)
void cage_advance(const Model *model, double h, const double *y_0, const double *f, const CageMemory *memory,
                  const double *middle, double *y, CageStep *step, Work *w);

// Predicted velocities in y for the evaluation at the end.
#define cage_predict FOR_ISA(cage_predict)
void cage_predict(const Model *model, CageStep *step, double *y);

// After that evaluation of y, w: separates the cage's part of the rates f, and takes the friction states to the joints' places.
#define cage_arrive FOR_ISA(cage_arrive)
void cage_arrive(const Model *model, const Work *w, CageStep *step, const CageMemory *before, double *y,
                 double *f, CageMemory *memory);

// Adds gamma times what was foreseen of the halves' accelerations to the rows of their velocities, with a sign.
#define cage_foreseen FOR_ISA(cage_foreseen)
void cage_foreseen(const Model *model, const CageStep *step, double gamma, double *v);

// v = (1 + gamma A)^-1 v of the halves' velocities by films of the given rates alone.
#define cage_films FOR_ISA(cage_films)
void cage_films(const Model *model, const LandFilm film[2], double gamma, double *v);

// v = (1 + gamma^2 K)^-1 v with the joints' stiffness across the axis, a factor of the matrix of its own.
#define cage_shear FOR_ISA(cage_shear)
void cage_shear(const Model *model, const Work *w, double gamma, CageStep *step, double *v);

// v = (1 + gamma A + gamma^2 K)^-1 v of both halves with their films and joints.
#define cage_solve FOR_ISA(cage_solve)
void cage_solve(const Model *model, const Work *w, double gamma, CageStep *step, double *v);

// Positions in y follow the corrections delta of the velocities; the friction states slip where friction does not hold them,
// and the work loses what that dissipates.
#define cage_correct FOR_ISA(cage_correct)
void cage_correct(const Model *model, double gamma, const double *delta, double *y, CageStep *step, Work *w);

// The same of a step of another method, which ends at the state y and its evaluation w: `before` is the state at its
// start.
typedef void CageSlide(const Model *model, const double *before, double *y, Work *w);
#define cage_slide FOR_ISA(cage_slide)
CageSlide cage_slide;

// Velocities of the modes at the end, in y, with the forces on bent rims there; the evaluations behind foresee no films.
#define cage_finish FOR_ISA(cage_finish)
void cage_finish(const Model *model, const CageStep *step, double *y, const double *f_end, CageMemory *memory,
                 Work *w);

// Rates of the modes at the end, their history and their error, without the films on bent rims; f, jerk and h_0 are those of the step's start and of
// the step before.
#define cage_remember FOR_ISA(cage_remember)
void cage_remember(const Model *model, double h, double h_0, const double *f, const double *jerk,
                   const double *y, double *f_end, double *jerk_end, double *error);

// Part of the longest step and of the tolerance that the cage is given: 1, less of a slow cage.
double cage_part(const CageMemory *memory);

// The longest step that the cage bears from a state with these films [s]: of all films, or of those that do not follow in the
// substeps of a step from `memory`.
double cage_longest_step(const Model *model, double film[2][3], const CageMemory *memory);

// The longest step of a fixed length [s] that vibrations and pulses allow.
double cage_fixed_step(const Model *model);

// Whether steps can have made the memory.
bool cage_memory_is_valid(const CageMemory *memory, const Parameters *p);

// ---- read from an evaluation --------------------------------------------------------------------------------
// Loads of all joints, of which the stress table takes those of the rivets.
typedef void CageLoads(const Model *model, const Work *w, JointLoads *load);
#define cage_loads FOR_ISA(cage_loads)
CageLoads cage_loads;

// Slip of half 1 against half 0 at each joint, in the plane [m].
void cage_slip(const Model *model, const Work *w, scalar slip[Z]);

// Kinetic energy of the halves, elastic energy of pockets, joints and modes [J], less cage_widened.
scalar cage_energy(const Model *model, const scalar *y, const Work *w);

// What the centrifugal load of a turning frame has done as it widened the halves [J], and its rate [W].  Of the modes'
// powers this one counts as a potential, because modes turn by much more than pi in a step.
INLINE scalar cage_widened(const Work *w)
{
    return 0.5 * (w->elastic.more_J[0] + w->elastic.more_J[1]) * (w->frame_omega * w->frame_omega);
}

INLINE scalar cage_widening(const Work *w, scalar frame_omega_dot)
{
    scalar power = 0.0;
    for (int h = 0; h < 2; h++)
        power += w->frame_omega *
                 (0.5 * w->elastic.more_J_dot[h] * w->frame_omega + w->elastic.more_J[h] * frame_omega_dot);
    return power;
}

// Power that the frame's rate draws from what the widened halves have gained of inertia [W].
INLINE scalar cage_drawn(const Work *w, scalar frame_omega_dot)
{
    scalar power = 0.0;
    for (int h = 0; h < 2; h++)
        power += w->elastic.more_J[h] * frame_omega_dot * (w->half[h].s + w->frame_omega);
    return power;
}

// Power that the halves' vibrations and the damping between rigid halves lose [W].  What friction loses is no function of
// a state: it is the work of a step's slip (cage_correct).
INLINE scalar cage_vibrations_lose(const Work *w)
{
    return w->elastic.dissipated;
}

INLINE scalar cage_joints_damp(const Work *w)
{
    return w->two_half.dissipated;
}

INLINE scalar cage_losses(const Work *w)
{
    return cage_vibrations_lose(w) + cage_joints_damp(w);
}

// Motions of half h at the rivets by its modes, in the rivets' frames [m].
void cage_flex(const Model *model, const Work *w, int h, scalar x[Z], scalar r[Z], scalar t[Z]);
