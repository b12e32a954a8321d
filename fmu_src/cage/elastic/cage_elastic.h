// Elastic cage halves: vibration modes of both halves and the joints between them.  Equations in cage_elastic.c.
#pragma once

#include "numbers/isa.h"
#include "physics/model.h"

// Coordinates of both halves from y, and the elastic part of the pads' motions against each other.
#define cage_elastic_kinematics FOR_ISA(cage_elastic_kinematics)
void cage_elastic_kinematics(const Model *model, const scalar *y, Work *w);

// Adds the modes to offset and velocity of the joints (cage_joint_kinematics before), sets e.
#define cage_elastic_pads FOR_ISA(cage_elastic_pads)
void cage_elastic_pads(const Model *model, Work *w);

// Motions of all pads against each other: out of the plane (x, about r, about t) by coordinates S, in it (r, t) by D.
#define cage_elastic_out FOR_ISA(cage_elastic_out)
void cage_elastic_out(const ElasticHalf *half, const scalar *S, ball_array to[3]);
#define cage_elastic_in FOR_ISA(cage_elastic_in)
void cage_elastic_in(const ElasticHalf *half, const scalar *D, ball_array to[2]);

// Square of the halves' speed in space, mean of both.
#define cage_elastic_speed_2 FOR_ISA(cage_elastic_speed_2)
scalar cage_elastic_speed_2(const Work *w);

// Preloads [N] with what the centrifugal load of that speed adds.
#define cage_elastic_preload FOR_ISA(cage_elastic_preload)
void cage_elastic_preload(const Model *model, scalar omega_2, ball_array P);

// Loads of the joints out of the plane, T and N_plate, for the motions e in w and preloads P.
#define cage_elastic_loads FOR_ISA(cage_elastic_loads)
void cage_elastic_loads(const Model *model, const ball_array P, Work *w);

// Sets the forces of the joints on the modes, from the joints' loads.
#define cage_elastic_pull FOR_ISA(cage_elastic_pull)
void cage_elastic_pull(const Model *model, Work *w);

// Loads of the joints for the motions by the present state; adds the moments to both halves.
#define cage_elastic_joints FOR_ISA(cage_elastic_joints)
void cage_elastic_joints(const Model *model, Work *w);

// Moment [N.m] about the axis of half h that its widening needs.
#define cage_elastic_coriolis FOR_ISA(cage_elastic_coriolis)
scalar cage_elastic_coriolis(const Model *model, const Work *w, int h);

// Sets the rates of the modal coordinates, their energy and dissipation.
#define cage_elastic_acceleration FOR_ISA(cage_elastic_acceleration)
void cage_elastic_acceleration(const Model *model, const scalar *y, Work *w, scalar *y_dot);
