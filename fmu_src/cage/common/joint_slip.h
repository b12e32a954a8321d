// Loads of the joints in the plane of the split beside those of the motion: the load path gives the loads of bonded joints
// between halves that bend.
//
// A joint slips, by s along V: of the bonded V the part that friction and hole do not take is relieved through the slip
// stiffness of the halves (joint_slip).  Friction and play are those that the motion leaves over.
#pragma once

#include "cage/common/cage_joint.h"
#include "cage/common/joint_law.h"
#include "physics/model.h"

// Capacity of joints for transverse loads: friction of plates and heads [N], play [m]; stiffness of heads
// and hole [N/m].
typedef struct {
    ball_array plates, heads, gap, k_hole;
    double k_head;
} SlipLimits;

// Adds the loads (r, t) of plates, heads and shanks by the bonded loads V_r, V_t [N].
void joints_slip(const JointLaw *law, const ball_array V_r, const ball_array V_t, const SlipLimits *limits,
                 ball_array plates[2], ball_array heads[2], ball_array shank[2]);

// Joints in the plane as the motion has them: offset (y, z) of the pads [m], tension of the rivets, force between the plates
// [N].
typedef struct {
    const scalar *u_y, *u_z, *T, *N_plate;
} SlipState;

// Adds to shear the loads of plates, heads and shanks by the bonded loads V_r, V_t.
void joint_slip_add(const Model *model, const Work *w, const SlipState *at, const ball_array V_r,
                    const ball_array V_t, JointShear *shear);
