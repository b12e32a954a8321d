// Elastic cage halves: vibration modes of both halves and the joints between them.  Equations in cage_elastic.c.
#pragma once

#include "isa.h"
#include "model.h"

// Coordinates of both halves from y, and the elastic part of the pads' motions against each other.
#define cage_elastic_kinematics FOR_ISA(cage_elastic_kinematics)
void cage_elastic_kinematics(const Model *model, const scalar *y, Work *w);

// Adds the modes to the joints' offsets and velocities in the plane (cage_joint_kinematics before), for the friction states.
#define cage_elastic_slip FOR_ISA(cage_elastic_slip)
void cage_elastic_slip(const Model *model, const scalar *y, Work *w);

// Adds the modes to offset and velocity of the joints (cage_joint_kinematics before), sets e.
#define cage_elastic_pads FOR_ISA(cage_elastic_pads)
void cage_elastic_pads(const Model *model, Work *w);

// Loads of the joints out of the plane, T and N_plate; adds the moments to both halves.
#define cage_elastic_joints FOR_ISA(cage_elastic_joints)
void cage_elastic_joints(const Model *model, Work *w);

// Moment [N.m] about the axis of half h that its widening needs.
#define cage_elastic_coriolis FOR_ISA(cage_elastic_coriolis)
scalar cage_elastic_coriolis(const Model *model, const Work *w, int h);

// Sets the rates of the modal coordinates, their energy and dissipation.
#define cage_elastic_acceleration FOR_ISA(cage_elastic_acceleration)
void cage_elastic_acceleration(const Model *model, const scalar *y, Work *w, scalar *y_dot);
