// One instance of the model: what is saved, and what can be computed from it.  Inside the core only.
#pragma once

#include "events.h"
#include "fatigue.h"
#include "integrator.h"
#include "statistics.h"

// Floors of the statistics' bins: the smallest value told apart.
static const double FORCE_FLOOR = 1e-3;  // [N]
static const double STRESS_FLOOR = 1e3;  // [Pa]

enum { WORST_RIVET = Z, STRESS_CHANNELS = Z + 1 };  // channels of stress statistics: each rivet, the worst one at each instant

// Everything that the future depends on: plain bytes.
typedef struct {
    Parameters p;
    Inputs u[INPUT_ORDERS + 1];  // of the next step: at its start, with their derivatives
    Inputs u_now, u_now_dot;     // that the present state has seen last, and their rates
    IntegratorState integrator;
    double t_start, tolerance;
    double energy_start;
    double force_peak;  // since the last communication point
    double head_peak[Z], mid_peak[Z];
    double dislocation_max, duty_time, omega_time, eccentricity_time;  // integrals over time since settle
    StatisticsChannel force, head[STRESS_CHANNELS], mid[STRESS_CHANNELS];
    FatigueChannel fatigue_head[Z], fatigue_mid[Z];
    EventState event;
    int initialized;
} InstanceState;

typedef struct Part Bearing;  // the part that this FMU is

struct Part {
    PartHost host;
    InstanceState s;
    Derived d;
    InputTrajectory trajectory;
    RingLoad ring_load;
    Model model;
    Work w;
    Outputs out;
    Kernels kernels;
    Integrator *integrator;
    unsigned current;        // bit per output group: up to date
    double y_dot[N_STATES];  // dy/dt at the present state
    bool evaluated;          // w and y_dot belong to it
    double cpu_time;
};

// Fills one group of outputs from w and the saved state.
void outputs_fill(Bearing *b, OutputGroup group);

// Whether parameters and inputs make a bearing; messages go to the log.
bool check_all(Bearing *b);

// Whether the balls of the start, which w belongs to, lie in their grooves.
bool check_start(Bearing *b);

// Whether inputs stay within their limits over a step of length h (they may change at every step).
bool check_inputs(Bearing *b, double h);

void bearing_log(Bearing *b, LogCategory category, const char *format, ...) __attribute__((format(printf, 3, 4)));
