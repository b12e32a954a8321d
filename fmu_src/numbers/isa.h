// Functions of the kernel files that other files call: each instruction set has its own copy, under a name of
// its own.
#pragma once

#include "numbers/lanes.h"

#define ball_kinematics FOR_ISA(ball_kinematics)
#define ball_acceleration FOR_ISA(ball_acceleration)
#define race_contact_force FOR_ISA(race_contact_force)
#define race_growth_power FOR_ISA(race_growth_power)
#define drag_mixture FOR_ISA(drag_mixture)
#define drag_force FOR_ISA(drag_force)
#define drag_cage FOR_ISA(drag_cage)
#define drag_ring FOR_ISA(drag_ring)
#define land_film_force FOR_ISA(land_film_force)
#define land_film_loads FOR_ISA(land_film_loads)
#define land_growth_power FOR_ISA(land_growth_power)
#define ring_acceleration FOR_ISA(ring_acceleration)
#define rhs FOR_ISA(rhs)
#define verlet_evaluate FOR_ISA(verlet_evaluate)
#define verlet_step FOR_ISA(verlet_step)
#define implicit_spring_power FOR_ISA(implicit_spring_power)
#define implicit_ring_wrench FOR_ISA(implicit_ring_wrench)
#define implicit_solve FOR_ISA(implicit_solve)
#define implicit_stiff_part FOR_ISA(implicit_stiff_part)
#define half_path_rows FOR_ISA(half_path_rows)
#define joints_open FOR_ISA(joints_open)
#define joints_slip FOR_ISA(joints_slip)
#define rivet_rom_stress FOR_ISA(rivet_rom_stress)
