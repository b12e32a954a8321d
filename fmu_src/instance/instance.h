// One instance of the bearing: its saved state, and all that is computed from this state.  For the core's own
// files only.
#pragma once

#include "instance/breakage.h"
#include "instance/events.h"
#include "instance/fatigue.h"
#include "instance/loosening.h"
#include "instance/part.h"
#include "instance/statistics.h"
#include "physics/ring_load.h"
#include "solver/integrator.h"

// Floors of the statistics' bins: smaller values are not resolved.
static const double FORCE_FLOOR = 1e-3;  // [N]
static const double STRESS_FLOOR = 1e3;  // [Pa]

// Channels of the stress statistics: each rivet, and the worst rivet at each instant.
enum { WORST_RIVET = Z, STRESS_CHANNELS = Z + 1 };

// Values that the statistics count at the end of a step: pocket forces [N], stresses of each rivet and of the worst one [Pa].
typedef struct {
    int force_known, stress_known;  // else there was no step yet, or none with stress
    double force[Z], head[STRESS_CHANNELS], mid[STRESS_CHANNELS];
} StepEnd;

// The saved state: all that the instance's future depends on, in plain bytes.
typedef struct {
    Parameters p;                // of the next step
    Inputs u[INPUT_ORDERS + 1];  // inputs of the next step: their values at its start and their derivatives
    Inputs u_now, u_now_dot;     // inputs under which the present state was reached, and their rates
    Parameters p_now;            // under which the present state was reached
    MotionHistory history;       // of the motions that the host gave
    MotionLag lag;               // of the motions in the last step
    double angle[3];             // by which frame, inner, outer ring have turned [rad] (InputTrajectory)
    IntegratorState integrator;
    double t_start, tolerance;
    double energy_start;     // total energy at the start [J]
    double energy_change;    // that changes of parameters have added since [J]
    double lost, exchanged;  // lost since, and exchanged with the shaft to and fro [J]
    double jumped;           // of the work, that steps from where the inputs jump may be off [J]
    // since the last communication point: largest pocket force [N], largest stresses of each rivet [Pa]
    double force_peak, head_peak[Z], mid_peak[Z];
    // since start.settle: largest slip of a joint [m]; integrals over time of pocket contact, cage speed,
    // eccentricity
    double dislocation_max;
    double duty_time, omega_time, eccentricity_time;
    StepEnd end;  // of the last step
    StatisticsChannel force, head[STRESS_CHANNELS], mid[STRESS_CHANNELS];
    FatigueChannel fatigue_head[Z], fatigue_mid[Z];
    Breakage breakage;
    Loosening loosening;
    EventState event;
    // of a saved state in equal steps, whose evaluations have other velocities than a new one would
    Outputs out;
    int initialized;
} InstanceState;

typedef struct Part Bearing;  // this FMU's part (part.h)

struct Part {
    PartHost host;
    InstanceState s;
    Parameters hot;  // s.p_now at the temperatures in s.u_now, without broken rivets: those of the model
    Derived d;
    InputTrajectory trajectory;
    RingLoad ring_load;
    Model model;
    void *cage;  // memory that a scene's cage needed, kept for the next one; else NULL
    Work w;
    Event events[EVENT_COUNT];  // from w, where events_here was called last
    Outputs out;
    Kernels kernels;
    Integrator *integrator;
    unsigned current;            // one bit for each output group: set while the group is up to date
    double y_dot[N_ALL_STATES];  // dy/dt at the present state
    bool evaluated;              // w and y_dot belong to the present state and inputs
    bool reported;               // inputs and parameters without effect have been logged
    double cpu_time;             // processor time of all steps [s]
};

// Sends a message to the host, formatted as by printf.
void bearing_log(Bearing *b, LogCategory category, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

// Fills one group of outputs from the last evaluation and the saved state.
void outputs_fill(Bearing *b, OutputGroup group);

// Whether parameters and inputs make a bearing; refusals go to the log.
bool check_all(Bearing *b);

// Logs once which inputs and parameters differ from their start values but have no effect, by ring.motion.
void report_without_effect(Bearing *b);

// Logs the same before the start, and settings that do less than their names promise.
void report_start(Bearing *b);

// Whether all balls lie in their grooves at the start; w holds the results there.
bool check_start(Bearing *b);

// Whether parameters that have changed since the last step make a bearing, at the inputs of the next step.
bool check_change(Bearing *b);

// Whether the inputs stay within their limits over a step of length h; inputs may change at every step.  Temperatures
// must leave the bearing its clearances and the oil a viscosity within its limits.
bool check_inputs(Bearing *b, double h);

// Whether b->s, copied from bytes of unknown origin, is a state that a run can have left there, as far as
// single values tell.
bool check_saved(Bearing *b);
