// Joint loads after opening, from the bonded loads: joints between rigid halves.
//
// The equations of all joints are solved by sweeps (Jacobi's iteration).
//   Start    the state in which all joints carry the same load, the centrifugal one.  In it L_0 and the moves depend
//            on the ratio c/(P + c) alone, c = |bonded M_t|/l, and are tabulated (`uniform` of JointLaw).
//   A sweep  finds L_0 by the neighbours' moves.  If L_0 and P of a joint differ from the start state by less than
//            NEAR s, the tangent of the start state gives its move.  Otherwise the law is evaluated again for this
//            joint if its L_0 has changed by more than CHANGE s since the last evaluation.  The iteration ends when
//            no joint needs the law, or after SWEEPS sweeps.
// Most joints are near the centrifugal state at most instants, so that this takes a few evaluations of the law
// instead of several for each joint.  The results are within 2.5 % of the converged ones (tests/test_rivets.py),
// and jump by less where a joint enters or leaves a sweep.
#pragma once

#include "cage/common/joint_law.h"

// Loads (N, M_r, M_t) of the joints and (T, m_r, m_t) of the rivets [N, N.m], from bonded loads and preloads
// P >= 0.  intact: 1, or 0 for a joint that carries nothing, whose move takes all of L_0; spin_M, spin_P: bonded
// M_t under the centrifugal load alone, and the preload with it.
void joints_open(const JointLaw *law, ball_array bonded[3], const ball_array P, const constants intact,
                 scalar spin_M, scalar spin_P, ball_array load[3], ball_array rivet[3]);
