// States that no bearing reaches: bodies have passed through each other, and nothing in the model brings them back.  A run
// ends before such a state.
//
//   balls    two neighbours overlap, their centres closer than R_j + R_k: only the cage holds them apart
//   cage     a half's centre is farther off the outer ring's axis than the clearance of its guidance and half of its
//            section, C + (D_o - D_i)/4, where its pockets end
//   contact  a ball is pressed into a race or a pocket by more than half of its radius
#pragma once

#include "physics/model.h"

#include <stddef.h>

typedef enum { ESCAPE_NONE, ESCAPE_BALLS, ESCAPE_CAGE, ESCAPE_CONTACT } EscapeKind;

// element: of two balls the first, the half, or 4 j + 0 inner race, 1 outer race, 2 pocket of ball j.
typedef struct {
    EscapeKind kind;
    int element;
    double value, limit;  // [m]
} Escape;

// In the evaluation w.
Escape escape_find(const Model *model, const Work *w);

void escape_text(const Escape *escape, char *text, size_t size);
