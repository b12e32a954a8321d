// What the inputs mean for the ring.  Equations in drive.c.
#pragma once

#include "model.h"

// What the inputs mean for the ring at time t: loads, speed, direction cosines of the shaft's tilt, the half-sine pulse in progress.
void drive_update(const Parameters *p, const Inputs *u, double t, Drive *drive);

// First edge of the built-in pulses later than t (infinite if none).
double drive_next_edge(const Parameters *p, double t);

// Direction cosines (beta, gamma) of the tilt about the vector (0, tilt_y, tilt_z), and back.
void ring_cosines(double tilt_y, double tilt_z, double *beta, double *gamma);
void ring_tilts(double beta, double gamma, double *tilt_y, double *tilt_z);
