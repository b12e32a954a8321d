// Drag of balls, cage and inner ring in the mixture of oil and air.  Equations in drag.c.
#pragma once

#include "physics/model.h"

// Sets density and speed of the mixture.
void drag_mixture(const Model *model, Work *w);

// Adds drag and churning of the balls to their forces, moments and dissipation.
void drag_force(const Model *model, Work *w);

// Adds the drag moments of cylinder and end faces to both halves, and their power to the power that the cage dissipates.
void drag_cage(const Model *model, Work *w);

// Adds the mixture's friction on the inner ring to the ring's moment; sets its power.
void drag_ring(const Model *model, Work *w);
