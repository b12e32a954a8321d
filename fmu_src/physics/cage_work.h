// Results of one evaluation that the cage has: rigid halves (written by two_half.c), elastic halves.
#pragma once

#include "numbers/lanes.h"
#include "variables.h"

typedef struct ElasticHalf ElasticHalf;  // elastic_half.h

enum { N_MODES = Y_MODE_D - Y_MODE_S };  // room for the modes of a half

enum { ENTRIES = (N_MODES / 2 + 7) / 8 * 8 };  // of one kind (elastic_half.h)

// One number for each mode of a half; eight modes side by side may reach beyond the last one.
typedef scalar mode_array[2 * ENTRIES] __attribute__((aligned(8 * sizeof(scalar))));

// Motion along the normal, by each mode, of a wall that a ball presses or is near.  The substeps behind the evaluation need it again: it
// is theirs if the place is, (x, r, t) of the normal, of a ribbon chi, radius and front, and the mass of the half, from which it follows bit
// for bit.
typedef struct {
    scalar place[7];
    mode_array shape;
} PressedWall;

// Contacts of balls with the walls of each half, and those that may come in the next step: direction (x, t) from the pocket's
// axis to the ball; Hertz's constant by the half's share [N/m1.5], 0 without contact; approach beside the part that the wall's
// residual contributes, negative before the contact [m]; load [N].  Of a ribbon's walls also direction r, the place's angle chi,
// radius [m] and part `front` (elastic_half.h).  Carried to the next step: no member is aligned beyond a scalar.
typedef struct {
    scalar x[2][LANES], t[2][LANES], K[2][LANES], delta[2][LANES], Q[2][LANES];
    scalar r[2][LANES], chi[2][LANES], radius[2][LANES], front[2][LANES];
} WallTouch;

// The joints between both halves, in the frame of half 0.  At an evaluation they are written by cage_elastic.c; in the
// substeps, which have their own, by cage_substeps.c.
typedef struct {
    // half of the pads' motion against each other out of the plane (x, about r, about t); offset and velocity in it
    ball_array e[3], u_y, u_z, v_y, v_z;

    // trial loads L_K, loads (N, M_r, M_t) of the joints and (T, m_r, m_t) of their rivets, energy U of the law, force
    // between the plates
    ball_array trial[3], load[3], rivet[3], U, N_plate;

    // force on half 1 in the plane; forces of the joints on the modes [N]: to be taken off S, on D
    ball_array F_y, F_z;
    mode_array pull_S, pull_D;
} ElasticJoints;

// Of elastic halves.
typedef struct {
    // coordinates of the modes and their rates, by half [m, m/s]; how far a wall can have moved [m], and without the modes that
    // move all pockets alike; moment of inertia that the modes add [kg.m2] and its rate (cage_elastic.c)
    mode_array q[2], q_dot[2];
    scalar reach[2], reach_others[2], more_J[2], more_J_dot[2];

    // elastic part of the pads' motions against each other, out of the plane (x, about r, about t) and in it (r, t)
    // (cage_elastic.c)
    ball_array pad_out[3], pad_in[2], pad_in_dot[2];

    // modal forces on the walls [N] (cleared in cage_elastic.c, added in pocket.c and pocket_spheres.c) and on the rims
    mode_array wall_force[2];

    // contacts with the walls, and elastic energy of contact and wall beside the modes, of a ribbon [J] (pocket.c,
    // pocket_spheres.c)
    WallTouch touch __attribute__((aligned(8 * sizeof(scalar))));
    ball_array wall_energy[2];
    PressedWall pressed[2][Z];

    ElasticJoints joints;
    scalar energy, dissipated;  // energy of the modes [J] and power that they lose [W] (cage_elastic.c)
} ElasticWork;

// Of rigid halves.
typedef struct {
    // of the springs between the halves: pull of the rivet's, push of the plates' [N]
    ball_array pull, push;
    scalar dissipated;  // by their damping [W]

    // loads of bonded joints between halves that bend, in the plane (r, t) [N]
    ball_array bonded_V[2];

    // joints that open: (N, M_r, M_t) of the joint and (T, m_r, m_t) of its rivet, force between the plates
    ball_array load[3], rivet[3], N_plate;
} TwoHalfWork;

// Films of oil between balls and both halves (pocket_squeeze.h): damping, 0 where there is none [N.s/m], speed at which the gap
// closes [m/s], direction (x, r, t), motion of the wall of an elastic half along it by each mode.  Not written in dry pockets.
typedef struct {
    ball_array D[2], u[2], m[3][2];
    mode_array shape[2][Z];
} FilmWork;

// Results of the kind of cage that runs; those of the other kind are not written.
typedef struct {
    FilmWork films;
    TwoHalfWork two_half;
    ElasticWork elastic;
} CageWork;
