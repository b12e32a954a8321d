// The riveted joints between the cage halves: the part that both kinds of halves share.  Equations in cage_joint.c.
#pragma once

#include "physics/model.h"
#include "rivet/rivet_rom.h"

// Stiffnesses in the plane of the split [N/m]: of the joint as long as its plates stick, of the heads that the plates' slip
// drags, of holes in which a shank bears.
typedef struct {
    double stick, head;
    const double *hole;  // [LANES]
} JointStiffness;

// One joint's arrays: offset and velocity of half 1 against half 0 at the holes, in the plane; tension of the rivet;
// force between the plates; axial force on half 1.
typedef struct {
    const scalar *u_y, *u_z, *v_y, *v_z, *T, *N_plate, *F_x;
} JointMotion;

// Offset and velocity of half 1 against half 0 as rigid bodies at each rivet, in the frame of half 0.
void cage_joint_kinematics(const Model *model, Work *w);

// Friction and hole contact of all joints: sets S, H, B, F; adds the joints' wrench to both halves, as forces at the holes of
// the halves as rigid bodies.
void cage_joint_force(const Model *model, const scalar *y, const JointStiffness *k, const JointMotion *at,
                      Work *w);

// Forces on half 1 in the plane, for offsets and the friction states in y.
void cage_joint_shear(const Model *model, const double *y, const JointStiffness *k, const ball_array u_y,
                      const ball_array u_z, ball_array F_y, ball_array F_z);

// Friction over a step: the states, row by row, from which the present ones followed the motion since the last mapping;
// motion of each joint over the step [m]; normal force times slip [J].
typedef struct {
    double before[4 * Z], way_y[LANES], way_z[LANES], rubbed[LANES];
} JointStep;

// The friction states in y follow the motion with the velocities v for the time h: trial deflections.
void cage_joint_follow(double h, const double *v_y, const double *v_z, double *y);

// Maps the trial deflections in y back onto those that friction bears under the tension T of the rivets and the force
// N_plate between the plates; adds to step->rubbed.  Returns the energy that the slip dissipates [J].
double cage_joint_slide(const Model *model, const JointStiffness *k, const double *T, const double *N_plate,
                        double *y, JointStep *step);

// Loads (r, t) of half 1 that plates, heads and shanks carry in the plane.
typedef struct {
    ball_array plates[2], heads[2], shank[2];
} JointShear;

void cage_joint_carried(const Model *model, const Work *w, JointShear *shear);

// Adds the loads by the bonded loads V_r, V_t of joints between halves that bend (joint_slip.c).  at: offset, tension, force
// between the plates.
void joint_slip_add(const Model *model, const Work *w, const JointMotion *at, const ball_array V_r,
                    const ball_array V_t, JointShear *shear);

// Loads of all joints from (N, M_r, M_t) of the joints, (T, m_r, m_t) of their rivets and their loads in the plane.
void cage_joint_loads(const Model *model, const ball_array joint[3], const ball_array rivet[3],
                      const JointShear *shear, JointLoads *load);
