// Elastic cage halves: vibration modes of both halves and the joints between them.  Equations in cage_elastic.c.
#pragma once

#include "cage/common/cage_joint.h"
#include "cage/elastic/elastic_half.h"
#include "physics/model.h"

// Coordinates of both halves from y, and the elastic part of the pads' motions against each other.
void cage_elastic_kinematics(const Model *model, const scalar *y, Work *w);

// Motions of all pads against each other: out of the plane (x, about r, about t) by coordinates S, in it (r, t) by D.
void cage_elastic_out(const ElasticHalf *half, const scalar *S, ball_array to[3]);
void cage_elastic_in(const ElasticHalf *half, const scalar *D, ball_array to[2]);

// Square of the halves' speed in space, mean of both.
scalar cage_elastic_speed_2(const Work *w);

// Preloads [N] with the preload that the centrifugal load at that speed adds.
void cage_elastic_preload(const Model *model, scalar omega_2, ball_array P);

// Loads of the joints out of the plane and of their rivets for the motions e and preloads P.
void cage_elastic_loads(const Model *model, const ball_array P, ElasticJoints *joints);

// Forces of the joints on the modes, from their loads.
void cage_elastic_pull(const Model *model, ElasticJoints *joints);

// Stiffnesses in the plane, in series with the residual of the modes.
INLINE JointStiffness cage_elastic_stiffness(const Model *model)
{
    const ElasticHalf *half = model->modes;
    return (JointStiffness){half->series * model->d->k_plate_t, model->d->k_head, half->k_hole};
}

// Joints by the present state (cage_joint_kinematics before); adds their forces and moments to both halves.
void cage_elastic_joints(const Model *model, const scalar *y, Work *w);

// Sets the rates of the modal coordinates, their energy and dissipation.
void cage_elastic_acceleration(const Model *model, const scalar *y, Work *w, scalar *y_dot);

// Loads of all joints and their rivets.
void cage_elastic_rivets(const Model *model, const Work *w, JointLoads *load);
