// What happens in the model that its laws do not cover or that a user wants to know at once: each kind is counted now, its onsets since the
// start, and the first onset, the second, the fourth, the eighth ... is reported to the log.
//
//   land contact   land of a half beyond the guide clearance: e > C                                            (land_film.c: dry contact)
//   pocket exit    centre of a ball outside the cage's section D_i/2 ... D_o/2: a real pocket ends there        (pocket.c: the cylinder does not)
//   ellipse cut    |alpha| + a/R_m > arccos(1 - h D/r_g): the contact ellipse reaches over the shoulder          (race_contact.c: Hertz uncut)
//   overpressure   p_max > bearing.p_limit at a race: permanent deformation, which Hertz' law does not know
//   joint open     plates of a joint apart: u_x > P/k_plate
//   rivet yield    sigma_head_peak or sigma_mid_peak beyond the yield stress since the last communication point  (linear elastic stress)
#pragma once

#include "model.h"

typedef enum { EVENT_LAND_CONTACT, EVENT_POCKET_EXIT, EVENT_ELLIPSE_CUT, EVENT_OVERPRESSURE, EVENT_JOINT_OPEN, EVENT_RIVET_YIELD, EVENT_COUNT } EventKind;

// One kind at one instant.
typedef struct {
    int count;            // contacts, balls, joints ... that it concerns
    int element;          // where it is worst
    double value, limit;  // there, in the unit of the message; value/limit is largest
} Event;

// What the future needs of the events: plain bytes, part of the saved state.
typedef struct {
    double onsets[EVENT_COUNT];
    int active[EVENT_COUNT];
} EventState;

// Angle from a groove's bottom to which the contact ellipse of ball j reaches [rad], 0 without contact.
double ellipse_reach(const Model *model, const Work *w, bool outer, int j);

// All kinds at the state that w belongs to.  head_peak, mid_peak: of each rivet [Pa].
void events_now(const Model *model, const Work *w, const double head_peak[Z], const double mid_peak[Z], Event now[EVENT_COUNT]);

// Counts an onset; true if it is one to report.
bool event_onset(EventState *state, EventKind kind, const Event *now);

// Whether counting onsets can have made it.
bool event_state_is_valid(const EventState *state);

// What a message says of an event.
void event_text(EventKind kind, const Event *now, char *text, size_t size);
