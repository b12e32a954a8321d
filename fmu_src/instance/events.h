// Events: conditions that the model's laws do not cover, or that a user has to know at once.  For each kind the model
// counts the elements concerned at present and the onsets since the start, and reports the first, second,
// fourth, eighth ... onset to the log.
//
//   land contact   land of a half beyond the guide clearance: e > C (land_film.c has a dry contact there)
//   pocket exit    centre of a ball outside the cage's section D_i/2 ... D_o/2: a real pocket ends there, the
//                  cylinder of pocket.c does not
//   ellipse cut    |alpha| + a/R_m > arccos(1 - h D/r_g): the contact ellipse reaches over the shoulder, which
//                  race_contact.c does not cut off
//   overpressure   p_max > bearing.p_limit at a race: permanent deformation, which Hertz' law does not know
//   joint open     plates of a joint apart: u_x > P/k_plate
//   no clearance   speed, temperatures and fits leave a diametral clearance below 0: the bearing is preloaded
//   rivet yield    sigma_head_peak or sigma_mid_peak beyond the yield stress since the last communication point;
//                  the stress is linear elastic
//   rivet overload sigma_mid_peak beyond the tensile strength fatigue.sigma_m: a real rivet tears
//   rivet break    a rivet's damage has reached 1 in the last communication step (breakage.h); each is reported
//   cage yield     the largest pocket force since the last communication point exceeds the one under which a half of a
//                  ribbon cage begins to yield (rivet_model/half_strength.py); displacements are elastic
//   step too long  equal steps have errors in the mean with which statistics were wrong (integrator.c)
//   energy off     the energy's residual passes 2 % of the losses, or energy is gained instead of lost: the integration is wrong.
//                  Errors of the start and of pulses are small beside the energy that moves: 1 % of that in the bearing
//                  and 0.4 % of that which the shaft has exchanged are allowed in any case, beside the error of the
//                  trapezoidal rule for powers that jump with the inputs
//   motion lag     a given motion jumps or contradicts its velocity, and is caught up with over more than the
//                  communication step (motion_trajectory in ring_load.h)
#pragma once

#include "physics/ring_load.h"

// X(KIND, member of Outputs.event)
#define EVENTS(X)                   \
    X(LAND_CONTACT, land_contact)   \
    X(POCKET_EXIT, pocket_exit)     \
    X(ELLIPSE_CUT, ellipse_cut)     \
    X(OVERPRESSURE, overpressure)   \
    X(JOINT_OPEN, joint_open)       \
    X(RIVET_YIELD, rivet_yield)     \
    X(NO_CLEARANCE, no_clearance)   \
    X(RIVET_BREAK, rivet_break)     \
    X(STEP_TOO_LONG, step_too_long) \
    X(MOTION_LAG, motion_lag)       \
    X(CAGE_YIELD, cage_yield)       \
    X(ENERGY_OFF, energy_off)       \
    X(RIVET_OVERLOAD, rivet_overload)
#define EVENT_KIND(kind, member) EVENT_##kind,

typedef enum { EVENTS(EVENT_KIND) EVENT_COUNT } EventKind;

// One kind of event at one instant.
typedef struct {
    int count;            // contacts, balls, joints ... at which the event happens
    int element;          // the worst of them
    double value, limit;  // of this element, in the unit of the message; value/limit is largest there.  Of a
                          // motion: how far its position and velocity are off
} Event;

// Memory of the events: plain bytes, part of the saved state.
typedef struct {
    double onsets[EVENT_COUNT];
    int active[EVENT_COUNT];
} EventState;

// Angle from a groove's bottom to which the contact ellipse of ball j reaches [rad], 0 without contact.
double ellipse_reach(const Model *model, const Work *w, bool outer, int j);

// All kinds of events but rivets that break at the state whose results are w.  lag: motions of the last step; error: mean error of
// equal steps; force_peak: largest pocket force [N]; head_peak, mid_peak: peak stresses of each rivet [Pa].
void events_now(const Model *model, const Work *w, const MotionLag *lag, double error, double force_peak,
                const double head_peak[Z], const double mid_peak[Z], Event now[EVENT_COUNT]);

// Of energies since the start and the one lost in the last communication step [J].
Event event_of_energy(double residual, double held, double exchanged, double lost, double lost_now,
                      double jumped);

// Counts the event's onset if it has one; returns whether this onset is to be reported.
bool event_onset(EventState *state, EventKind kind, const Event *now);

// Whether counting onsets can have made the state.
bool event_state_is_valid(const EventState *state);

// Text of the message on an event.
void event_text(EventKind kind, const Event *now, char *text, size_t size);
