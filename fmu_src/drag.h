// Drag of balls and cage in the mixture of oil and air.  Equations in drag.c.
#pragma once

#include "isa.h"
#include "model.h"

// Adds the drag of the balls to their tangential force and dissipation.
void drag_force(const Model *model, Work *w);

// Adds the drag moments of cylinder and end faces to both halves, and their power to what the cage dissipates.
void drag_cage(const Model *model, Work *w);
