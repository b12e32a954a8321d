// Kinematics and equations of motion of the balls.  Equations in ball.c.
#pragma once

#include "physics/model.h"

// Copies the balls' states into w and computes cosine and sine of their azimuths.
void ball_kinematics(const scalar *y, Work *w);

// Equations of motion under the total forces and moments.
void ball_acceleration(const Model *model, const Work *w, scalar *y_dot);
