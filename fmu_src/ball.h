// Kinematics and equations of motion of the balls.  Equations in ball.c.
#pragma once

#include "isa.h"
#include "model.h"

void ball_kinematics(const scalar *y, Work *w);                            // copies of the state, azimuth's cosine and sine
void ball_acceleration(const Model *model, const Work *w, scalar *y_dot);  // from the total forces and moments
