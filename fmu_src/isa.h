// Functions of the kernel files that other files call: each instruction set has its own copy, under a name of
// its own.
#pragma once

#include "lanes.h"

#define ball_kinematics FOR_ISA(ball_kinematics)
#define ball_acceleration FOR_ISA(ball_acceleration)
#define race_contact_force FOR_ISA(race_contact_force)
#define race_growth_power FOR_ISA(race_growth_power)
#define drag_mixture FOR_ISA(drag_mixture)
#define drag_force FOR_ISA(drag_force)
#define drag_cage FOR_ISA(drag_cage)
#define drag_ring FOR_ISA(drag_ring)
#define pocket_force FOR_ISA(pocket_force)
#define pocket_split FOR_ISA(pocket_split)
#define land_film_force FOR_ISA(land_film_force)
#define cage_joint_kinematics FOR_ISA(cage_joint_kinematics)
#define cage_joint_force FOR_ISA(cage_joint_force)
#define ring_acceleration FOR_ISA(ring_acceleration)
#define rhs FOR_ISA(rhs)
#define verlet_step FOR_ISA(verlet_step)
#define implicit_solve FOR_ISA(implicit_solve)
#define cage_joint_advance FOR_ISA(cage_joint_advance)
#define rhs_cage_advance FOR_ISA(rhs_cage_advance)
#define implicit_stiff_part FOR_ISA(implicit_stiff_part)
#define implicit_films FOR_ISA(implicit_films)
#define bolt_group FOR_ISA(bolt_group)
#define half_path_rows FOR_ISA(half_path_rows)
#define joints_open FOR_ISA(joints_open)
#define joints_slip FOR_ISA(joints_slip)
#define rivets_load FOR_ISA(rivets_load)
#define rivet_rom_stress FOR_ISA(rivet_rom_stress)
