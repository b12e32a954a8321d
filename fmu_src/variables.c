// Written by fmus/generate.py from fmus/variables.toml: do not edit.
// clang-format off
#include "variables.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

const StateBlock STATE_BLOCKS[N_STATE_BLOCKS] = {
    {Y_BALL_X, Z, SCALE_LENGTH, "ball_x"},
    {Y_BALL_R, Z, SCALE_LENGTH, "ball_r"},
    {Y_BALL_THETA, Z, SCALE_ANGLE, "ball_theta"},
    {Y_CAGE_X, 2, SCALE_LENGTH, "cage_x"},
    {Y_CAGE_Y, 2, SCALE_LENGTH, "cage_y"},
    {Y_CAGE_Z, 2, SCALE_LENGTH, "cage_z"},
    {Y_CAGE_BETA, 2, SCALE_TILT, "cage_beta"},
    {Y_CAGE_GAMMA, 2, SCALE_TILT, "cage_gamma"},
    {Y_CAGE_PSI, 2, SCALE_ANGLE, "cage_psi"},
    {Y_RING_X, 1, SCALE_LENGTH, "ring_x"},
    {Y_RING_Y, 1, SCALE_LENGTH, "ring_y"},
    {Y_RING_Z, 1, SCALE_LENGTH, "ring_z"},
    {Y_RING_BETA, 1, SCALE_TILT, "ring_beta"},
    {Y_RING_GAMMA, 1, SCALE_TILT, "ring_gamma"},
    {Y_JOINT_PLATE_Y, Z, SCALE_PLATE, "joint_plate_y"},
    {Y_JOINT_PLATE_Z, Z, SCALE_PLATE, "joint_plate_z"},
    {Y_JOINT_HEAD_Y, Z, SCALE_HEAD, "joint_head_y"},
    {Y_JOINT_HEAD_Z, Z, SCALE_HEAD, "joint_head_z"},
    {Y_WORK, 1, SCALE_ENERGY, "work"},
    {Y_BALL_V_X, Z, SCALE_VELOCITY, "ball_v_x"},
    {Y_BALL_V_R, Z, SCALE_VELOCITY, "ball_v_r"},
    {Y_BALL_OMEGA_M, Z, SCALE_RATE, "ball_omega_m"},
    {Y_CAGE_V_X, 2, SCALE_VELOCITY, "cage_v_x"},
    {Y_CAGE_V_Y, 2, SCALE_VELOCITY, "cage_v_y"},
    {Y_CAGE_V_Z, 2, SCALE_VELOCITY, "cage_v_z"},
    {Y_CAGE_BETA_DOT, 2, SCALE_RATE, "cage_beta_dot"},
    {Y_CAGE_GAMMA_DOT, 2, SCALE_RATE, "cage_gamma_dot"},
    {Y_CAGE_S, 2, SCALE_RATE, "cage_s"},
    {Y_RING_V_X, 1, SCALE_VELOCITY, "ring_v_x"},
    {Y_RING_V_Y, 1, SCALE_VELOCITY, "ring_v_y"},
    {Y_RING_V_Z, 1, SCALE_VELOCITY, "ring_v_z"},
    {Y_RING_BETA_DOT, 1, SCALE_RATE, "ring_beta_dot"},
    {Y_RING_GAMMA_DOT, 1, SCALE_RATE, "ring_gamma_dot"},
    {Y_BALL_OMEGA_X, Z, SCALE_SPIN, "ball_omega_x"},
    {Y_BALL_OMEGA_R, Z, SCALE_SPIN, "ball_omega_r"},
    {Y_BALL_OMEGA_T, Z, SCALE_SPIN, "ball_omega_t"},
};

// name, unit, value reference, count, type, causality, group, state, offset, start, min, max
const Variable VARIABLES[N_VARIABLES] = {
    {"time", "s", 0, 1, TYPE_REAL, CAUSALITY_INDEPENDENT, GROUP_COUNT, -1, 0, 0.0, -INFINITY, INFINITY},
    {"shaft.F_x", "N", 1, 1, TYPE_REAL, CAUSALITY_INPUT, GROUP_COUNT, -1, offsetof(Inputs, shaft.F_x), 515.0, -100000.0, 100000.0},
    {"shaft.F_y", "N", 2, 1, TYPE_REAL, CAUSALITY_INPUT, GROUP_COUNT, -1, offsetof(Inputs, shaft.F_y), 2994.0, -100000.0, 100000.0},
    {"shaft.F_z", "N", 3, 1, TYPE_REAL, CAUSALITY_INPUT, GROUP_COUNT, -1, offsetof(Inputs, shaft.F_z), 0.0, -100000.0, 100000.0},
    {"shaft.M_y", "N.m", 4, 1, TYPE_REAL, CAUSALITY_INPUT, GROUP_COUNT, -1, offsetof(Inputs, shaft.M_y), 0.0, -10000.0, 10000.0},
    {"shaft.M_z", "N.m", 5, 1, TYPE_REAL, CAUSALITY_INPUT, GROUP_COUNT, -1, offsetof(Inputs, shaft.M_z), 0.0, -10000.0, 10000.0},
    {"shaft.omega", "rad/s", 6, 1, TYPE_REAL, CAUSALITY_INPUT, GROUP_COUNT, -1, offsetof(Inputs, shaft.omega), 1909.8788938723549, -5000.0, 5000.0},
    {"shaft.tilt_y", "rad", 7, 1, TYPE_REAL, CAUSALITY_INPUT, GROUP_COUNT, -1, offsetof(Inputs, shaft.tilt_y), 0.0, -0.035, 0.035},
    {"shaft.tilt_z", "rad", 8, 1, TYPE_REAL, CAUSALITY_INPUT, GROUP_COUNT, -1, offsetof(Inputs, shaft.tilt_z), 0.0, -0.035, 0.035},
    {"impact.F_r", "N", 9, 1, TYPE_REAL, CAUSALITY_INPUT, GROUP_COUNT, -1, offsetof(Inputs, impact.F_r), 0.0, -100000.0, 100000.0},
    {"impact.F_a", "N", 10, 1, TYPE_REAL, CAUSALITY_INPUT, GROUP_COUNT, -1, offsetof(Inputs, impact.F_a), 0.0, -100000.0, 100000.0},
    {"bearing.D", "m", 1001, 1, TYPE_REAL, CAUSALITY_PARAMETER, GROUP_COUNT, -1, offsetof(Parameters, bearing.D), 0.0111125, 0.001, 0.1},
    {"bearing.d_m", "m", 1002, 1, TYPE_REAL, CAUSALITY_PARAMETER, GROUP_COUNT, -1, offsetof(Parameters, bearing.d_m), 0.0535, 0.005, 1.0},
    {"bearing.f_i", "1", 1003, 1, TYPE_REAL, CAUSALITY_PARAMETER, GROUP_COUNT, -1, offsetof(Parameters, bearing.f_i), 0.515, 0.5005, 0.6},
    {"bearing.f_e", "1", 1004, 1, TYPE_REAL, CAUSALITY_PARAMETER, GROUP_COUNT, -1, offsetof(Parameters, bearing.f_e), 0.52, 0.5005, 0.6},
    {"bearing.P_d", "m", 1005, 1, TYPE_REAL, CAUSALITY_PARAMETER, GROUP_COUNT, -1, offsetof(Parameters, bearing.P_d), 1.5e-05, -5e-05, 0.001},
    {"bearing.E", "Pa", 1006, 1, TYPE_REAL, CAUSALITY_PARAMETER, GROUP_COUNT, -1, offsetof(Parameters, bearing.E), 207000000000.0, 1000000000.0, 1000000000000.0},
    {"bearing.nu", "1", 1007, 1, TYPE_REAL, CAUSALITY_PARAMETER, GROUP_COUNT, -1, offsetof(Parameters, bearing.nu), 0.3, 0.0, 0.49},
    {"bearing.rho", "kg/m3", 1008, 1, TYPE_REAL, CAUSALITY_PARAMETER, GROUP_COUNT, -1, offsetof(Parameters, bearing.rho), 7800.0, 1000.0, 20000.0},
    {"bearing.lambda", "s/m", 1009, 1, TYPE_REAL, CAUSALITY_PARAMETER, GROUP_COUNT, -1, offsetof(Parameters, bearing.lambda), 0.05, 0.0, 10.0},
    {"bearing.h_i", "1", 1010, 1, TYPE_REAL, CAUSALITY_PARAMETER, GROUP_COUNT, -1, offsetof(Parameters, bearing.h_i), 0.2, 0.01, 0.5},
    {"bearing.h_e", "1", 1011, 1, TYPE_REAL, CAUSALITY_PARAMETER, GROUP_COUNT, -1, offsetof(Parameters, bearing.h_e), 0.2, 0.01, 0.5},
    {"bearing.p_limit", "Pa", 1012, 1, TYPE_REAL, CAUSALITY_PARAMETER, GROUP_COUNT, -1, offsetof(Parameters, bearing.p_limit), 4200000000.0, 1000000.0, 1000000000000.0},
    {"ball[j].dD", "m", 1020, Z, TYPE_REAL, CAUSALITY_PARAMETER, GROUP_COUNT, -1, offsetof(Parameters, ball.dD), 0.0, -0.001, 5e-05},
    {"cage.pocket_clearance", "m", 1101, 1, TYPE_REAL, CAUSALITY_PARAMETER, GROUP_COUNT, -1, offsetof(Parameters, cage.pocket_clearance), 0.0002, 0.0, 0.005},
    {"cage.guide_clearance", "m", 1102, 1, TYPE_REAL, CAUSALITY_PARAMETER, GROUP_COUNT, -1, offsetof(Parameters, cage.guide_clearance), 0.0002, 1e-05, 0.005},
    {"cage.D_o", "m", 1103, 1, TYPE_REAL, CAUSALITY_PARAMETER, GROUP_COUNT, -1, offsetof(Parameters, cage.D_o), 0.0595, 0.005, 2.0},
    {"cage.D_i", "m", 1104, 1, TYPE_REAL, CAUSALITY_PARAMETER, GROUP_COUNT, -1, offsetof(Parameters, cage.D_i), 0.0497, 0.005, 2.0},
    {"cage.m", "kg", 1105, 1, TYPE_REAL, CAUSALITY_PARAMETER, GROUP_COUNT, -1, offsetof(Parameters, cage.m), 0.0276, 1e-05, 10.0},
    {"cage.J_p", "kg.m2", 1106, 1, TYPE_REAL, CAUSALITY_PARAMETER, GROUP_COUNT, -1, offsetof(Parameters, cage.J_p), 2.07e-05, 1e-10, 1.0},
    {"cage.J_t", "kg.m2", 1107, 1, TYPE_REAL, CAUSALITY_PARAMETER, GROUP_COUNT, -1, offsetof(Parameters, cage.J_t), 1.06e-05, 1e-10, 1.0},
    {"cage.x_c", "m", 1108, 1, TYPE_REAL, CAUSALITY_PARAMETER, GROUP_COUNT, -1, offsetof(Parameters, cage.x_c), 0.0034, 0.0, 0.1},
    {"cage.land_width", "m", 1109, 1, TYPE_REAL, CAUSALITY_PARAMETER, GROUP_COUNT, -1, offsetof(Parameters, cage.land_width), 0.0025, 1e-05, 0.2},
    {"cage.land_x", "m", 1110, 1, TYPE_REAL, CAUSALITY_PARAMETER, GROUP_COUNT, -1, offsetof(Parameters, cage.land_x), 0.0055, 0.0, 0.2},
    {"cage.E", "Pa", 1111, 1, TYPE_REAL, CAUSALITY_PARAMETER, GROUP_COUNT, -1, offsetof(Parameters, cage.E), 110000000000.0, 100000000.0, 1000000000000.0},
    {"cage.nu", "1", 1112, 1, TYPE_REAL, CAUSALITY_PARAMETER, GROUP_COUNT, -1, offsetof(Parameters, cage.nu), 0.33, 0.0, 0.49},
    {"cage.mu", "1", 1113, 1, TYPE_REAL, CAUSALITY_PARAMETER, GROUP_COUNT, -1, offsetof(Parameters, cage.mu), 0.05, 0.0, 1.0},
    {"cage.v_c", "m/s", 1114, 1, TYPE_REAL, CAUSALITY_PARAMETER, GROUP_COUNT, -1, offsetof(Parameters, cage.v_c), 0.2, 0.0001, 10.0},
    {"cage.lambda", "s/m", 1115, 1, TYPE_REAL, CAUSALITY_PARAMETER, GROUP_COUNT, -1, offsetof(Parameters, cage.lambda), 1.0, 0.0, 20.0},
    {"cage.share_width", "1", 1116, 1, TYPE_REAL, CAUSALITY_PARAMETER, GROUP_COUNT, -1, offsetof(Parameters, cage.share_width), 0.05, 0.001, 1.0},
    {"cage.mu_land", "1", 1117, 1, TYPE_REAL, CAUSALITY_PARAMETER, GROUP_COUNT, -1, offsetof(Parameters, cage.mu_land), 0.08, 0.0, 1.0},
    {"cage.K_land", "N/m1.5", 1118, 1, TYPE_REAL, CAUSALITY_PARAMETER, GROUP_COUNT, -1, offsetof(Parameters, cage.K_land), 2000000000.0, 1000000.0, 1000000000000.0},
    {"cage.g_0", "1", 1119, 1, TYPE_REAL, CAUSALITY_PARAMETER, GROUP_COUNT, -1, offsetof(Parameters, cage.g_0), 0.02, 0.0001, 0.2},
    {"cage.unbalance", "kg.m", 1120, 1, TYPE_REAL, CAUSALITY_PARAMETER, GROUP_COUNT, -1, offsetof(Parameters, cage.unbalance), 0.0, 0.0, 0.01},
    {"cage.width", "m", 1121, 1, TYPE_REAL, CAUSALITY_PARAMETER, GROUP_COUNT, -1, offsetof(Parameters, cage.width), 0.0135, 0.001, 0.5},
    {"joint.preload", "N", 1201, 1, TYPE_REAL, CAUSALITY_PARAMETER, GROUP_COUNT, -1, offsetof(Parameters, joint.preload), 20.0, 0.0, 1000.0},
    {"joint.fit", "m", 1202, 1, TYPE_REAL, CAUSALITY_PARAMETER, GROUP_COUNT, -1, offsetof(Parameters, joint.fit), -1e-05, -0.0005, 0.0001},
    {"joint.swell", "m", 1203, 1, TYPE_REAL, CAUSALITY_PARAMETER, GROUP_COUNT, -1, offsetof(Parameters, joint.swell), 4e-06, 0.0, 5e-05},
    {"joint.mu", "1", 1204, 1, TYPE_REAL, CAUSALITY_PARAMETER, GROUP_COUNT, -1, offsetof(Parameters, joint.mu), 0.15, 0.0, 1.0},
    {"joint.zeta", "1", 1205, 1, TYPE_REAL, CAUSALITY_PARAMETER, GROUP_COUNT, -1, offsetof(Parameters, joint.zeta), 0.02, 0.0, 1.0},
    {"joint.F_floor", "N", 1206, 1, TYPE_REAL, CAUSALITY_PARAMETER, GROUP_COUNT, -1, offsetof(Parameters, joint.F_floor), 0.5, 0.001, 10.0},
    {"rivet.temperature", "K", 1207, 1, TYPE_REAL, CAUSALITY_PARAMETER, GROUP_COUNT, -1, offsetof(Parameters, rivet.temperature), 293.15, 150.0, 700.0},
    {"rivet.fit_model", "1", 1208, 1, TYPE_ENUMERATION, CAUSALITY_PARAMETER, GROUP_COUNT, -1, offsetof(Parameters, rivet.fit_model), 2.0, 1.0, 2.0},
    {"oil.eta", "Pa.s", 1301, 1, TYPE_REAL, CAUSALITY_PARAMETER, GROUP_COUNT, -1, offsetof(Parameters, oil.eta), 0.006, 1e-05, 10.0},
    {"oil.alpha", "1/Pa", 1302, 1, TYPE_REAL, CAUSALITY_PARAMETER, GROUP_COUNT, -1, offsetof(Parameters, oil.alpha), 1.3e-08, 1e-10, 1e-07},
    {"oil.A", "1", 1303, 1, TYPE_REAL, CAUSALITY_PARAMETER, GROUP_COUNT, -1, offsetof(Parameters, oil.A), -0.04, -1.0, 0.0},
    {"oil.B", "1", 1304, 1, TYPE_REAL, CAUSALITY_PARAMETER, GROUP_COUNT, -1, offsetof(Parameters, oil.B), 2.2, 0.0, 100.0},
    {"oil.C", "1", 1305, 1, TYPE_REAL, CAUSALITY_PARAMETER, GROUP_COUNT, -1, offsetof(Parameters, oil.C), 45.0, 0.0, 1000.0},
    {"oil.v_0", "m/s", 1306, 1, TYPE_REAL, CAUSALITY_PARAMETER, GROUP_COUNT, -1, offsetof(Parameters, oil.v_0), 0.0001, 1e-08, 0.1},
    {"oil.U_0", "m/s", 1307, 1, TYPE_REAL, CAUSALITY_PARAMETER, GROUP_COUNT, -1, offsetof(Parameters, oil.U_0), 0.01, 1e-06, 1.0},
    {"oil.rolling", "1", 1308, 1, TYPE_REAL, CAUSALITY_PARAMETER, GROUP_COUNT, -1, offsetof(Parameters, oil.rolling), 1.0, 0.0, 10.0},
    {"oil.rho_mix", "kg/m3", 1309, 1, TYPE_REAL, CAUSALITY_PARAMETER, GROUP_COUNT, -1, offsetof(Parameters, oil.rho_mix), 35.0, 0.0, 1500.0},
    {"oil.C_d", "1", 1310, 1, TYPE_REAL, CAUSALITY_PARAMETER, GROUP_COUNT, -1, offsetof(Parameters, oil.C_d), 0.45, 0.0, 10.0},
    {"oil.mu_b", "1", 1311, 1, TYPE_REAL, CAUSALITY_PARAMETER, GROUP_COUNT, -1, offsetof(Parameters, oil.mu_b), 0.12, 0.0, 1.0},
    {"oil.s_0", "1", 1312, 1, TYPE_REAL, CAUSALITY_PARAMETER, GROUP_COUNT, -1, offsetof(Parameters, oil.s_0), 0.006, 0.0001, 1.0},
    {"oil.sigma_race", "m", 1313, 1, TYPE_REAL, CAUSALITY_PARAMETER, GROUP_COUNT, -1, offsetof(Parameters, oil.sigma_race), 2e-07, 1e-09, 1e-05},
    {"oil.sigma_pocket", "m", 1314, 1, TYPE_REAL, CAUSALITY_PARAMETER, GROUP_COUNT, -1, offsetof(Parameters, oil.sigma_pocket), 6e-07, 1e-09, 1e-05},
    {"oil.sigma_land", "m", 1315, 1, TYPE_REAL, CAUSALITY_PARAMETER, GROUP_COUNT, -1, offsetof(Parameters, oil.sigma_land), 8e-07, 1e-09, 1e-05},
    {"oil.rho", "kg/m3", 1316, 1, TYPE_REAL, CAUSALITY_PARAMETER, GROUP_COUNT, -1, offsetof(Parameters, oil.rho), 900.0, 100.0, 2000.0},
    {"ring.m", "kg", 1401, 1, TYPE_REAL, CAUSALITY_PARAMETER, GROUP_COUNT, -1, offsetof(Parameters, ring.m), 0.6, 0.001, 1000.0},
    {"ring.J_p", "kg.m2", 1402, 1, TYPE_REAL, CAUSALITY_PARAMETER, GROUP_COUNT, -1, offsetof(Parameters, ring.J_p), 0.00018, 1e-09, 100.0},
    {"ring.J_t", "kg.m2", 1403, 1, TYPE_REAL, CAUSALITY_PARAMETER, GROUP_COUNT, -1, offsetof(Parameters, ring.J_t), 0.00012, 1e-09, 100.0},
    {"ring.c", "N.s/m", 1404, 1, TYPE_REAL, CAUSALITY_PARAMETER, GROUP_COUNT, -1, offsetof(Parameters, ring.c), 1500.0, 0.0, 1000000.0},
    {"ring.tilt_mode", "1", 1405, 1, TYPE_ENUMERATION, CAUSALITY_PARAMETER, GROUP_COUNT, -1, offsetof(Parameters, ring.tilt_mode), 1.0, 1.0, 3.0},
    {"ring.tilt_time", "s", 1406, 1, TYPE_REAL, CAUSALITY_PARAMETER, GROUP_COUNT, -1, offsetof(Parameters, ring.tilt_time), 0.0001, 1e-06, 1.0},
    {"ring.k_tilt", "N.m/rad", 1407, 1, TYPE_REAL, CAUSALITY_PARAMETER, GROUP_COUNT, -1, offsetof(Parameters, ring.k_tilt), 20000.0, 0.0, 100000000.0},
    {"ring.c_tilt", "N.m.s/rad", 1408, 1, TYPE_REAL, CAUSALITY_PARAMETER, GROUP_COUNT, -1, offsetof(Parameters, ring.c_tilt), 1.0, 0.0, 10000.0},
    {"gravity.y", "m/s2", 1501, 1, TYPE_REAL, CAUSALITY_PARAMETER, GROUP_COUNT, -1, offsetof(Parameters, gravity.y), 0.0, -1000.0, 1000.0},
    {"gravity.z", "m/s2", 1502, 1, TYPE_REAL, CAUSALITY_PARAMETER, GROUP_COUNT, -1, offsetof(Parameters, gravity.z), 0.0, -1000.0, 1000.0},
    {"pulse.F_r", "N", 1601, 1, TYPE_REAL, CAUSALITY_PARAMETER, GROUP_COUNT, -1, offsetof(Parameters, pulse.F_r), 0.0, -100000.0, 100000.0},
    {"pulse.F_a", "N", 1602, 1, TYPE_REAL, CAUSALITY_PARAMETER, GROUP_COUNT, -1, offsetof(Parameters, pulse.F_a), 0.0, -100000.0, 100000.0},
    {"pulse.t_start", "s", 1603, 1, TYPE_REAL, CAUSALITY_PARAMETER, GROUP_COUNT, -1, offsetof(Parameters, pulse.t_start), 0.1, 0.0, 1000000.0},
    {"pulse.duration", "s", 1604, 1, TYPE_REAL, CAUSALITY_PARAMETER, GROUP_COUNT, -1, offsetof(Parameters, pulse.duration), 0.001, 1e-06, 1000.0},
    {"pulse.interval", "s", 1605, 1, TYPE_REAL, CAUSALITY_PARAMETER, GROUP_COUNT, -1, offsetof(Parameters, pulse.interval), 0.00333333333333333, 1e-06, 1000000.0},
    {"pulse.count", "1", 1606, 1, TYPE_INTEGER, CAUSALITY_PARAMETER, GROUP_COUNT, -1, offsetof(Parameters, pulse.count), 3.0, 0.0, 1000000.0},
    {"fatigue.sigma_D", "Pa", 1701, 1, TYPE_REAL, CAUSALITY_PARAMETER, GROUP_COUNT, -1, offsetof(Parameters, fatigue.sigma_D), 250000000.0, 100000.0, 10000000000.0},
    {"fatigue.N_D", "1", 1702, 1, TYPE_REAL, CAUSALITY_PARAMETER, GROUP_COUNT, -1, offsetof(Parameters, fatigue.N_D), 2000000.0, 100.0, 10000000000.0},
    {"fatigue.k_1", "1", 1703, 1, TYPE_REAL, CAUSALITY_PARAMETER, GROUP_COUNT, -1, offsetof(Parameters, fatigue.k_1), 8.0, 1.0, 40.0},
    {"fatigue.k_2", "1", 1704, 1, TYPE_REAL, CAUSALITY_PARAMETER, GROUP_COUNT, -1, offsetof(Parameters, fatigue.k_2), 15.0, 1.0, 100.0},
    {"fatigue.sigma_m", "Pa", 1705, 1, TYPE_REAL, CAUSALITY_PARAMETER, GROUP_COUNT, -1, offsetof(Parameters, fatigue.sigma_m), 785000000.0, 1000000.0, 10000000000.0},
    {"fatigue.sigma_f", "Pa", 1706, 1, TYPE_REAL, CAUSALITY_PARAMETER, GROUP_COUNT, -1, offsetof(Parameters, fatigue.sigma_f), 1180000000.0, 1000000.0, 10000000000.0},
    {"fatigue.mean_stress", "1", 1707, 1, TYPE_ENUMERATION, CAUSALITY_PARAMETER, GROUP_COUNT, -1, offsetof(Parameters, fatigue.mean_stress), 2.0, 1.0, 4.0},
    {"scene.cage", "1", 1801, 1, TYPE_ENUMERATION, CAUSALITY_PARAMETER, GROUP_COUNT, -1, offsetof(Parameters, scene.cage), 1.0, 1.0, 2.0},
    {"scene.traction", "1", 1802, 1, TYPE_ENUMERATION, CAUSALITY_PARAMETER, GROUP_COUNT, -1, offsetof(Parameters, scene.traction), 1.0, 1.0, 2.0},
    {"scene.lubrication", "1", 1803, 1, TYPE_ENUMERATION, CAUSALITY_PARAMETER, GROUP_COUNT, -1, offsetof(Parameters, scene.lubrication), 1.0, 1.0, 2.0},
    {"scene.stress", "1", 1804, 1, TYPE_ENUMERATION, CAUSALITY_PARAMETER, GROUP_COUNT, -1, offsetof(Parameters, scene.stress), 3.0, 1.0, 4.0},
    {"scene.statistics", "1", 1805, 1, TYPE_ENUMERATION, CAUSALITY_PARAMETER, GROUP_COUNT, -1, offsetof(Parameters, scene.statistics), 1.0, 1.0, 2.0},
    {"solver.tol", "1", 1901, 1, TYPE_REAL, CAUSALITY_PARAMETER, GROUP_COUNT, -1, offsetof(Parameters, solver.tol), 0.001, 1e-10, 0.1},
    {"solver.method", "1", 1902, 1, TYPE_ENUMERATION, CAUSALITY_PARAMETER, GROUP_COUNT, -1, offsetof(Parameters, solver.method), 1.0, 1.0, 2.0},
    {"solver.max_steps", "1", 1903, 1, TYPE_INTEGER, CAUSALITY_PARAMETER, GROUP_COUNT, -1, offsetof(Parameters, solver.max_steps), 10000000.0, 10.0, 2000000000.0},
    {"start.seed", "1", 1951, 1, TYPE_INTEGER, CAUSALITY_PARAMETER, GROUP_COUNT, -1, offsetof(Parameters, start.seed), 1.0, 0.0, 2147483647.0},
    {"start.spacing", "1", 1952, 1, TYPE_REAL, CAUSALITY_PARAMETER, GROUP_COUNT, -1, offsetof(Parameters, start.spacing), 0.1, 0.0, 0.5},
    {"start.settle", "s", 1953, 1, TYPE_REAL, CAUSALITY_PARAMETER, GROUP_COUNT, -1, offsetof(Parameters, start.settle), 0.05, 0.0, 1000000.0},
    {"bearing.Z", "1", 2001, 1, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_CONSTANT, -1, offsetof(Outputs, bearing.Z), 9.0, -INFINITY, INFINITY},
    {"ring.x", "m", 2101, 1, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_STATE, Y_RING_X, offsetof(Outputs, ring.x), 0.0, -INFINITY, INFINITY},
    {"ring.y", "m", 2102, 1, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_STATE, Y_RING_Y, offsetof(Outputs, ring.y), 0.0, -INFINITY, INFINITY},
    {"ring.z", "m", 2103, 1, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_STATE, Y_RING_Z, offsetof(Outputs, ring.z), 0.0, -INFINITY, INFINITY},
    {"ring.v_x", "m/s", 2104, 1, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_STATE, Y_RING_V_X, offsetof(Outputs, ring.v_x), 0.0, -INFINITY, INFINITY},
    {"ring.v_y", "m/s", 2105, 1, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_STATE, Y_RING_V_Y, offsetof(Outputs, ring.v_y), 0.0, -INFINITY, INFINITY},
    {"ring.v_z", "m/s", 2106, 1, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_STATE, Y_RING_V_Z, offsetof(Outputs, ring.v_z), 0.0, -INFINITY, INFINITY},
    {"ring.a_x", "m/s2", 2107, 1, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_RING, -1, offsetof(Outputs, ring.a_x), 0.0, -INFINITY, INFINITY},
    {"ring.a_y", "m/s2", 2108, 1, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_RING, -1, offsetof(Outputs, ring.a_y), 0.0, -INFINITY, INFINITY},
    {"ring.a_z", "m/s2", 2109, 1, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_RING, -1, offsetof(Outputs, ring.a_z), 0.0, -INFINITY, INFINITY},
    {"ring.tilt_y", "rad", 2110, 1, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_RING, -1, offsetof(Outputs, ring.tilt_y), 0.0, -INFINITY, INFINITY},
    {"ring.tilt_z", "rad", 2111, 1, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_RING, -1, offsetof(Outputs, ring.tilt_z), 0.0, -INFINITY, INFINITY},
    {"ring.beta", "1", 2112, 1, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_STATE, Y_RING_BETA, offsetof(Outputs, ring.beta), 0.0, -INFINITY, INFINITY},
    {"ring.gamma", "1", 2113, 1, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_STATE, Y_RING_GAMMA, offsetof(Outputs, ring.gamma), 0.0, -INFINITY, INFINITY},
    {"ring.beta_dot", "1/s", 2114, 1, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_STATE, Y_RING_BETA_DOT, offsetof(Outputs, ring.beta_dot), 0.0, -INFINITY, INFINITY},
    {"ring.gamma_dot", "1/s", 2115, 1, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_STATE, Y_RING_GAMMA_DOT, offsetof(Outputs, ring.gamma_dot), 0.0, -INFINITY, INFINITY},
    {"ring.beta_ddot", "1/s2", 2116, 1, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_RING, -1, offsetof(Outputs, ring.beta_ddot), 0.0, -INFINITY, INFINITY},
    {"ring.gamma_ddot", "1/s2", 2117, 1, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_RING, -1, offsetof(Outputs, ring.gamma_ddot), 0.0, -INFINITY, INFINITY},
    {"housing.F_x", "N", 2151, 1, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_RING, -1, offsetof(Outputs, housing.F_x), 0.0, -INFINITY, INFINITY},
    {"housing.F_y", "N", 2152, 1, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_RING, -1, offsetof(Outputs, housing.F_y), 0.0, -INFINITY, INFINITY},
    {"housing.F_z", "N", 2153, 1, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_RING, -1, offsetof(Outputs, housing.F_z), 0.0, -INFINITY, INFINITY},
    {"housing.M_y", "N.m", 2154, 1, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_RING, -1, offsetof(Outputs, housing.M_y), 0.0, -INFINITY, INFINITY},
    {"housing.M_z", "N.m", 2155, 1, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_RING, -1, offsetof(Outputs, housing.M_z), 0.0, -INFINITY, INFINITY},
    {"ball[j].Q_i", "N", 2200, Z, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_BALL, -1, offsetof(Outputs, ball.Q_i), 0.0, -INFINITY, INFINITY},
    {"ball[j].Q_e", "N", 2240, Z, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_BALL, -1, offsetof(Outputs, ball.Q_e), 0.0, -INFINITY, INFINITY},
    {"ball[j].alpha_i", "rad", 2280, Z, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_BALL, -1, offsetof(Outputs, ball.alpha_i), 0.0, -INFINITY, INFINITY},
    {"ball[j].alpha_e", "rad", 2320, Z, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_BALL, -1, offsetof(Outputs, ball.alpha_e), 0.0, -INFINITY, INFINITY},
    {"ball[j].Q_c", "N", 2360, Z, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_BALL, -1, offsetof(Outputs, ball.Q_c), 0.0, -INFINITY, INFINITY},
    {"ball[j].omega_m", "rad/s", 2400, Z, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_BALL, -1, offsetof(Outputs, ball.omega_m), 0.0, -INFINITY, INFINITY},
    {"ball[j].p_i", "Pa", 2440, Z, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_BALL, -1, offsetof(Outputs, ball.p_i), 0.0, -INFINITY, INFINITY},
    {"ball[j].p_e", "Pa", 2480, Z, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_BALL, -1, offsetof(Outputs, ball.p_e), 0.0, -INFINITY, INFINITY},
    {"ball[j].Lambda_i", "1", 2520, Z, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_BALL, -1, offsetof(Outputs, ball.Lambda_i), 0.0, -INFINITY, INFINITY},
    {"ball[j].Lambda_e", "1", 2560, Z, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_BALL, -1, offsetof(Outputs, ball.Lambda_e), 0.0, -INFINITY, INFINITY},
    {"ball[j].spin_roll", "1", 2600, Z, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_BALL, -1, offsetof(Outputs, ball.spin_roll), 0.0, -INFINITY, INFINITY},
    {"ball[j].Q_cx", "N", 2640, Z, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_BALL, -1, offsetof(Outputs, ball.Q_cx), 0.0, -INFINITY, INFINITY},
    {"cage.dislocation", "m", 2701, 1, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_RIVET, -1, offsetof(Outputs, cage.dislocation), 0.0, -INFINITY, INFINITY},
    {"cage.omega", "rad/s", 2702, 1, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_CAGE, -1, offsetof(Outputs, cage.omega), 0.0, -INFINITY, INFINITY},
    {"cage.slip_ratio", "1", 2703, 1, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_CAGE, -1, offsetof(Outputs, cage.slip_ratio), 0.0, -INFINITY, INFINITY},
    {"cage.y", "m", 2704, 1, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_CAGE, -1, offsetof(Outputs, cage.y), 0.0, -INFINITY, INFINITY},
    {"cage.z", "m", 2705, 1, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_CAGE, -1, offsetof(Outputs, cage.z), 0.0, -INFINITY, INFINITY},
    {"cage.eccentricity", "1", 2706, 1, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_CAGE, -1, offsetof(Outputs, cage.eccentricity), 0.0, -INFINITY, INFINITY},
    {"cage.F_pocket_max", "N", 2707, 1, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_BALL, -1, offsetof(Outputs, cage.F_pocket_max), 0.0, -INFINITY, INFINITY},
    {"cage.F_pocket_peak", "N", 2708, 1, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_PEAK, -1, offsetof(Outputs, cage.F_pocket_peak), 0.0, -INFINITY, INFINITY},
    {"half_0.x", "m", 2721, 1, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_POSE, -1, offsetof(Outputs, half_0.x), 0.0, -INFINITY, INFINITY},
    {"half_0.y", "m", 2722, 1, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_POSE, -1, offsetof(Outputs, half_0.y), 0.0, -INFINITY, INFINITY},
    {"half_0.z", "m", 2723, 1, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_POSE, -1, offsetof(Outputs, half_0.z), 0.0, -INFINITY, INFINITY},
    {"half_0.tilt_y", "rad", 2724, 1, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_POSE, -1, offsetof(Outputs, half_0.tilt_y), 0.0, -INFINITY, INFINITY},
    {"half_0.tilt_z", "rad", 2725, 1, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_POSE, -1, offsetof(Outputs, half_0.tilt_z), 0.0, -INFINITY, INFINITY},
    {"half_0.psi", "rad", 2726, 1, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_POSE, -1, offsetof(Outputs, half_0.psi), 0.0, -INFINITY, INFINITY},
    {"half_1.x", "m", 2741, 1, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_POSE, -1, offsetof(Outputs, half_1.x), 0.0, -INFINITY, INFINITY},
    {"half_1.y", "m", 2742, 1, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_POSE, -1, offsetof(Outputs, half_1.y), 0.0, -INFINITY, INFINITY},
    {"half_1.z", "m", 2743, 1, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_POSE, -1, offsetof(Outputs, half_1.z), 0.0, -INFINITY, INFINITY},
    {"half_1.tilt_y", "rad", 2744, 1, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_POSE, -1, offsetof(Outputs, half_1.tilt_y), 0.0, -INFINITY, INFINITY},
    {"half_1.tilt_z", "rad", 2745, 1, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_POSE, -1, offsetof(Outputs, half_1.tilt_z), 0.0, -INFINITY, INFINITY},
    {"half_1.psi", "rad", 2746, 1, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_POSE, -1, offsetof(Outputs, half_1.psi), 0.0, -INFINITY, INFINITY},
    {"ball[j].x", "m", 2800, Z, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_POSE, -1, offsetof(Outputs, ball.x), 0.0, -INFINITY, INFINITY},
    {"ball[j].r", "m", 2840, Z, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_POSE, -1, offsetof(Outputs, ball.r), 0.0, -INFINITY, INFINITY},
    {"ball[j].psi", "rad", 2880, Z, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_POSE, -1, offsetof(Outputs, ball.psi), 0.0, -INFINITY, INFINITY},
    {"rivet[k].sigma_head", "Pa", 3000, Z, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_STRESS, -1, offsetof(Outputs, rivet.sigma_head), 0.0, -INFINITY, INFINITY},
    {"rivet[k].sigma_mid", "Pa", 3040, Z, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_STRESS, -1, offsetof(Outputs, rivet.sigma_mid), 0.0, -INFINITY, INFINITY},
    {"rivet[k].sigma_head_vm", "Pa", 3080, Z, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_STRESS, -1, offsetof(Outputs, rivet.sigma_head_vm), 0.0, -INFINITY, INFINITY},
    {"rivet[k].sigma_mid_p1", "Pa", 3120, Z, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_STRESS, -1, offsetof(Outputs, rivet.sigma_mid_p1), 0.0, -INFINITY, INFINITY},
    {"rivet[k].sigma_head_peak", "Pa", 3160, Z, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_PEAK, -1, offsetof(Outputs, rivet.sigma_head_peak), 0.0, -INFINITY, INFINITY},
    {"rivet[k].sigma_mid_peak", "Pa", 3200, Z, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_PEAK, -1, offsetof(Outputs, rivet.sigma_mid_peak), 0.0, -INFINITY, INFINITY},
    {"rivet.sigma_head_max", "Pa", 3240, 1, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_PEAK, -1, offsetof(Outputs, rivet.sigma_head_max), 0.0, -INFINITY, INFINITY},
    {"rivet.sigma_mid_max", "Pa", 3241, 1, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_PEAK, -1, offsetof(Outputs, rivet.sigma_mid_max), 0.0, -INFINITY, INFINITY},
    {"rivet[k].damage_head", "1", 3250, Z, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_FATIGUE, -1, offsetof(Outputs, rivet.damage_head), 0.0, -INFINITY, INFINITY},
    {"rivet[k].damage_mid", "1", 3290, Z, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_FATIGUE, -1, offsetof(Outputs, rivet.damage_mid), 0.0, -INFINITY, INFINITY},
    {"rivet[k].N", "N", 3330, Z, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_RIVET, -1, offsetof(Outputs, rivet.N), 0.0, -INFINITY, INFINITY},
    {"rivet[k].V", "N", 3370, Z, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_RIVET, -1, offsetof(Outputs, rivet.V), 0.0, -INFINITY, INFINITY},
    {"rivet[k].T", "N", 3410, Z, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_RIVET, -1, offsetof(Outputs, rivet.T), 0.0, -INFINITY, INFINITY},
    {"rivet[k].M", "N.m", 3450, Z, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_RIVET, -1, offsetof(Outputs, rivet.M), 0.0, -INFINITY, INFINITY},
    {"rivet[k].P", "N", 3490, Z, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_RIVET, -1, offsetof(Outputs, rivet.P), 0.0, -INFINITY, INFINITY},
    {"rivet[k].slip", "m", 3530, Z, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_RIVET, -1, offsetof(Outputs, rivet.slip), 0.0, -INFINITY, INFINITY},
    {"rivet[k].flag", "1", 3570, Z, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_STRESS, -1, offsetof(Outputs, rivet.flag), 0.0, -INFINITY, INFINITY},
    {"rivet[k].V_y", "N", 3610, Z, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_RIVET, -1, offsetof(Outputs, rivet.V_y), 0.0, -INFINITY, INFINITY},
    {"rivet[k].V_z", "N", 3650, Z, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_RIVET, -1, offsetof(Outputs, rivet.V_z), 0.0, -INFINITY, INFINITY},
    {"rivet[k].M_y", "N.m", 3690, Z, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_RIVET, -1, offsetof(Outputs, rivet.M_y), 0.0, -INFINITY, INFINITY},
    {"rivet[k].M_z", "N.m", 3730, Z, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_RIVET, -1, offsetof(Outputs, rivet.M_z), 0.0, -INFINITY, INFINITY},
    {"rivet[k].F_head", "N", 3770, Z, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_RIVET, -1, offsetof(Outputs, rivet.F_head), 0.0, -INFINITY, INFINITY},
    {"bearing.friction_torque", "N.m", 4001, 1, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_RING, -1, offsetof(Outputs, bearing.friction_torque), 0.0, -INFINITY, INFINITY},
    {"bearing.power_loss", "W", 4002, 1, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_ENERGY, -1, offsetof(Outputs, bearing.power_loss), 0.0, -INFINITY, INFINITY},
    {"bearing.energy_residual", "J", 4003, 1, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_ENERGY, -1, offsetof(Outputs, bearing.energy_residual), 0.0, -INFINITY, INFINITY},
    {"bearing.contacts", "1", 4004, 1, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_BALL, -1, offsetof(Outputs, bearing.contacts), 0.0, -INFINITY, INFINITY},
    {"bearing.penetration", "m", 4005, 1, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_BALL, -1, offsetof(Outputs, bearing.penetration), 0.0, -INFINITY, INFINITY},
    {"stat.time", "s", 5001, 1, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_STAT, -1, offsetof(Outputs, stat.time), 0.0, -INFINITY, INFINITY},
    {"stat.Q_c_mean", "N", 5002, 1, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_STAT, -1, offsetof(Outputs, stat.Q_c_mean), 0.0, -INFINITY, INFINITY},
    {"stat.Q_c_rms", "N", 5003, 1, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_STAT, -1, offsetof(Outputs, stat.Q_c_rms), 0.0, -INFINITY, INFINITY},
    {"stat.Q_c_p999", "N", 5004, 1, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_STAT, -1, offsetof(Outputs, stat.Q_c_p999), 0.0, -INFINITY, INFINITY},
    {"stat.Q_c_max", "N", 5005, 1, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_STAT, -1, offsetof(Outputs, stat.Q_c_max), 0.0, -INFINITY, INFINITY},
    {"stat.contact_duty", "1", 5006, 1, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_STAT, -1, offsetof(Outputs, stat.contact_duty), 0.0, -INFINITY, INFINITY},
    {"stat.cage_omega", "rad/s", 5007, 1, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_STAT, -1, offsetof(Outputs, stat.cage_omega), 0.0, -INFINITY, INFINITY},
    {"stat.eccentricity", "1", 5008, 1, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_STAT, -1, offsetof(Outputs, stat.eccentricity), 0.0, -INFINITY, INFINITY},
    {"stat.dislocation_max", "m", 5009, 1, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_STAT, -1, offsetof(Outputs, stat.dislocation_max), 0.0, -INFINITY, INFINITY},
    {"stat.sigma_head_mean", "Pa", 5011, 1, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_STAT, -1, offsetof(Outputs, stat.sigma_head_mean), 0.0, -INFINITY, INFINITY},
    {"stat.sigma_head_rms", "Pa", 5012, 1, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_STAT, -1, offsetof(Outputs, stat.sigma_head_rms), 0.0, -INFINITY, INFINITY},
    {"stat.sigma_head_p999", "Pa", 5013, 1, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_STAT, -1, offsetof(Outputs, stat.sigma_head_p999), 0.0, -INFINITY, INFINITY},
    {"stat.sigma_head_max", "Pa", 5014, 1, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_STAT, -1, offsetof(Outputs, stat.sigma_head_max), 0.0, -INFINITY, INFINITY},
    {"stat.sigma_mid_mean", "Pa", 5021, 1, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_STAT, -1, offsetof(Outputs, stat.sigma_mid_mean), 0.0, -INFINITY, INFINITY},
    {"stat.sigma_mid_rms", "Pa", 5022, 1, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_STAT, -1, offsetof(Outputs, stat.sigma_mid_rms), 0.0, -INFINITY, INFINITY},
    {"stat.sigma_mid_p999", "Pa", 5023, 1, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_STAT, -1, offsetof(Outputs, stat.sigma_mid_p999), 0.0, -INFINITY, INFINITY},
    {"stat.sigma_mid_max", "Pa", 5024, 1, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_STAT, -1, offsetof(Outputs, stat.sigma_mid_max), 0.0, -INFINITY, INFINITY},
    {"stat.rivet_head_mean[k]", "Pa", 5100, Z, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_STAT, -1, offsetof(Outputs, stat.rivet_head_mean), 0.0, -INFINITY, INFINITY},
    {"stat.rivet_head_rms[k]", "Pa", 5140, Z, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_STAT, -1, offsetof(Outputs, stat.rivet_head_rms), 0.0, -INFINITY, INFINITY},
    {"stat.rivet_head_p999[k]", "Pa", 5180, Z, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_STAT, -1, offsetof(Outputs, stat.rivet_head_p999), 0.0, -INFINITY, INFINITY},
    {"stat.rivet_head_max[k]", "Pa", 5220, Z, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_STAT, -1, offsetof(Outputs, stat.rivet_head_max), 0.0, -INFINITY, INFINITY},
    {"stat.rivet_mid_mean[k]", "Pa", 5300, Z, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_STAT, -1, offsetof(Outputs, stat.rivet_mid_mean), 0.0, -INFINITY, INFINITY},
    {"stat.rivet_mid_rms[k]", "Pa", 5340, Z, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_STAT, -1, offsetof(Outputs, stat.rivet_mid_rms), 0.0, -INFINITY, INFINITY},
    {"stat.rivet_mid_p999[k]", "Pa", 5380, Z, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_STAT, -1, offsetof(Outputs, stat.rivet_mid_p999), 0.0, -INFINITY, INFINITY},
    {"stat.rivet_mid_max[k]", "Pa", 5420, Z, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_STAT, -1, offsetof(Outputs, stat.rivet_mid_max), 0.0, -INFINITY, INFINITY},
    {"solver.steps", "1", 6001, 1, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_SOLVER, -1, offsetof(Outputs, solver.steps), 0.0, -INFINITY, INFINITY},
    {"solver.rhs_evals", "1", 6002, 1, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_SOLVER, -1, offsetof(Outputs, solver.rhs_evals), 0.0, -INFINITY, INFINITY},
    {"solver.step_size", "s", 6003, 1, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_SOLVER, -1, offsetof(Outputs, solver.step_size), 0.0, -INFINITY, INFINITY},
    {"solver.error_tests_failed", "1", 6004, 1, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_SOLVER, -1, offsetof(Outputs, solver.error_tests_failed), 0.0, -INFINITY, INFINITY},
    {"solver.cpu_time", "s", 6005, 1, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_SOLVER, -1, offsetof(Outputs, solver.cpu_time), 0.0, -INFINITY, INFINITY},
    {"solver.tolerance", "1", 6006, 1, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_SOLVER, -1, offsetof(Outputs, solver.tolerance), 0.0, -INFINITY, INFINITY},
    {"solver.path", "1", 6007, 1, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_SOLVER, -1, offsetof(Outputs, solver.path), 0.0, -INFINITY, INFINITY},
    {"event.land_contact", "1", 7001, 1, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_EVENT, -1, offsetof(Outputs, event.land_contact), 0.0, -INFINITY, INFINITY},
    {"event.pocket_exit", "1", 7002, 1, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_EVENT, -1, offsetof(Outputs, event.pocket_exit), 0.0, -INFINITY, INFINITY},
    {"event.ellipse_cut", "1", 7003, 1, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_EVENT, -1, offsetof(Outputs, event.ellipse_cut), 0.0, -INFINITY, INFINITY},
    {"event.overpressure", "1", 7004, 1, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_EVENT, -1, offsetof(Outputs, event.overpressure), 0.0, -INFINITY, INFINITY},
    {"event.joint_open", "1", 7005, 1, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_EVENT, -1, offsetof(Outputs, event.joint_open), 0.0, -INFINITY, INFINITY},
    {"event.rivet_yield", "1", 7006, 1, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_EVENT, -1, offsetof(Outputs, event.rivet_yield), 0.0, -INFINITY, INFINITY},
    {"event.land_contact_onsets", "1", 7011, 1, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_EVENT, -1, offsetof(Outputs, event.land_contact_onsets), 0.0, -INFINITY, INFINITY},
    {"event.pocket_exit_onsets", "1", 7012, 1, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_EVENT, -1, offsetof(Outputs, event.pocket_exit_onsets), 0.0, -INFINITY, INFINITY},
    {"event.ellipse_cut_onsets", "1", 7013, 1, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_EVENT, -1, offsetof(Outputs, event.ellipse_cut_onsets), 0.0, -INFINITY, INFINITY},
    {"event.overpressure_onsets", "1", 7014, 1, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_EVENT, -1, offsetof(Outputs, event.overpressure_onsets), 0.0, -INFINITY, INFINITY},
    {"event.joint_open_onsets", "1", 7015, 1, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_EVENT, -1, offsetof(Outputs, event.joint_open_onsets), 0.0, -INFINITY, INFINITY},
    {"event.rivet_yield_onsets", "1", 7016, 1, TYPE_REAL, CAUSALITY_OUTPUT, GROUP_EVENT, -1, offsetof(Outputs, event.rivet_yield_onsets), 0.0, -INFINITY, INFINITY},
};

const Variable *variable_find(unsigned value_reference, int *element)
{
    int low = 0, high = N_VARIABLES;  // VARIABLES[low] starts at or below the reference, VARIABLES[high] above
    while (high - low > 1) {
        const int middle = (low + high) / 2;
        if (VARIABLES[middle].value_reference <= value_reference) low = middle;
        else high = middle;
    }
    const unsigned index = value_reference - VARIABLES[low].value_reference;
    if (index >= (unsigned)VARIABLES[low].count) return NULL;
    *element = (int)index;
    return &VARIABLES[low];
}

const Variable *variable_named(const char *name)
{
    for (int i = 0; i < N_VARIABLES; i++) {
        if (strcmp(VARIABLES[i].name, name) == 0) return &VARIABLES[i];
    }
    return NULL;
}

void variable_element_name(const Variable *variable, int element, char *name, size_t size)
{
    const char *bracket = strchr(variable->name, '[');  // of "ball[j].Q_i"
    if (!bracket) {
        snprintf(name, size, "%s", variable->name);
        return;
    }
    snprintf(name, size, "%.*s[%d]%s", (int)(bracket - variable->name), variable->name, element + 1, bracket + 3);
}

int variable_allows(const Variable *variable, int element, double value, char *message, size_t size)
{
    if (isfinite(value) && value >= variable->min && value <= variable->max) return 1;
    char name[64];
    variable_element_name(variable, element, name, sizeof name);
    const int bare = strcmp(variable->unit, "1") == 0;
    snprintf(message, size, "%s = %.10g%s%s is not allowed: it must lie in [%.10g, %.10g]", name, value, bare ? "" : " ", bare ? "" : variable->unit,
             variable->min, variable->max);
    return 0;
}

void variables_set_start(Parameters *parameters, Inputs *inputs)
{
    for (const Variable *v = VARIABLES; v < VARIABLES + N_VARIABLES; v++) {
        if (v->causality != CAUSALITY_PARAMETER && v->causality != CAUSALITY_INPUT) continue;
        char *place = (v->causality == CAUSALITY_PARAMETER ? (char *)parameters : (char *)inputs) + v->offset;
        for (int element = 0; element < v->count; element++) {
            if (v->type == TYPE_REAL) ((double *)place)[element] = v->start;
            else ((int *)place)[element] = (int)v->start;
        }
    }
}
