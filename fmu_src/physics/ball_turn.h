// How far balls with spalls have turned: the trapezoidal rule beside the state, outside the error norm.
//
//   chi^ = chi_n + h chi'_n,   chi_{n+1} = chi_n + h (chi'_n + chi'(chi^))/2
//
// with the evaluation of the step.  chi and its rate: ball_spall.h.  A ball turns by 1e-2 rad a step and changes this rate
// little, so that its errors are far below those of the balls' places.
#pragma once

#include "physics/race_surface.h"

// As the parameters say; 0 if no ball has a spall.
static inline void ball_turn_start(const Parameters *p, BallTurn *turn)
{
    memset(turn, 0, sizeof *turn);
    for (int j = 0; ball_spalls_given(p) && j < Z; j++) turn->angle[j] = p->ball.spall_angle[j];
}

static inline void ball_turn_predict(double h, BallTurn *turn)
{
    for (int j = 0; j < Z; j++) turn->angle[j] += h * turn->rate[j];
}

// Rates of an evaluation.
static inline void ball_turn_rates(const Work *w, BallTurn *turn)
{
    for (int j = 0; j < Z; j++) turn->rate[j] = w->turn_rate[j];
}

static inline void ball_turn_correct(double gamma, const BallTurn *from, BallTurn *to)
{
    for (int j = 0; j < Z; j++) to->angle[j] = from->angle[j] + gamma * (from->rate[j] + to->rate[j]);
}
