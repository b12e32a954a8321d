// The inside of the model: constants derived once, what is held over a step, and everything one evaluation of the right-hand side writes.
//
// Frame: X axial, Y and Z radial.  Ball j has its own cylindrical frame (x, r, t): x along X, r from the axis through the ball, t = x cross r.
// Letters: i inner, e outer race, c cage, half h = 0 on the side of -X, h = 1 on +X; alpha contact angle; n unit normal from race or pocket
// surface into it, seen from the ball (the ball is pushed along -n).
#pragma once

#include "lanes.h"
#include "part.h"
#include "rivet_rom.h"

typedef struct {
    wide x, r, t;
} vec;  // one vector per ball of a packet, in the balls' own frames

// ---- constants, written once by model_derive ---------------------------------------------------------------------------------------------
typedef struct {
    double K;        // Q = K delta^1.5 [N/m^1.5]
    double a, b;     // semi-axes of the contact ellipse / Q^(1/3), a >= b [m/N^(1/3)]
    double a_delta;  // a / delta^(1/2) [m^0.5]
    double k;        // a/b
    double R_x;      // reduced radius in the rolling direction [m]
} Hertz;

typedef struct {
    double R_g;         // radius of the circle of groove-curvature centres [m]
    double r_g;         // groove radius f D [m]
    double R_m;         // radius of the deformed contact surface across rolling [m]
    double rolling;     // F_R = rolling U^0.66 Q^0.47 [N]
    double horizontal;  // F_H / F_R = 2 R_x / R of the ball
    double ln_Lambda;   // ln of Lambda at U = 1 m/s, Q = 1 N
    Hertz hertz;
} Race;

typedef struct {
    constants R;  // ball radius [m]
    double m, J;  // ball mass [kg], moment of inertia [kg.m2]
    Race inner, outer;
    double ln_pocket_piezo, ln_pocket_rigid;  // ln Lambda of the pocket film at U = 1 m/s, Q = 1 N: piezoviscous, isoviscous-rigid
    double pocket_rolling;                    // F_R = pocket_rolling U^0.66 Q^0.47
    Hertz pocket;
    double pocket_radius;                               // of the pocket [m]
    constants pocket_cos, pocket_sin;                   // body angle of pocket j: 2 pi j / Z
    constants rivet_y, rivet_z;                         // place of rivet k in a half: angle 2 pi (k + 1/2) / Z on the pitch circle [m]
    double drag;                                        // ball drag / v^2 [N.s2/m2]
    double com_x[2], com_e;                             // centre of mass of a half from its geometric centre: axial, toward pocket 1 [m]
    double C_land, kappa, couette;                      // radial guide clearance [m], eta R L^3 / C^3 [N.s/m], Couette torque / speed [N.m.s]
    double ln_land;                                     // ln Lambda of a land film of thickness C
    double disk_laminar, disk_turbulent;                // end-face drag moment / |omega|^1.5, |omega|^1.8 of one half
    double disk_laminar_omega, cylinder_laminar_omega;  // cage speeds below which both are laminar [rad/s]
    double cylinder_laminar, cylinder_vortex;           // cylinder drag moment / |omega|, |omega|^1.539 of one half
    double P, fit_a, fit_eff, k_hole, hole_gap;         // joint at the present temperature
    unsigned fit_flags;                                 // rivet_rom_fit_flags
    double k_rivet, k_plate, k_plate_t, k_head;         // its stiffnesses [N/m]
    double c_joint;                                     // axial damping of one closed joint [N.s/m]
    double spin[ROWS];                                  // rows of bonded joints (half_path.h) under the cage's centrifugal load, per (rad/s)^2
    double scale[SCALE_COUNT];                          // error that tolerance 1 allows, by class of state
    double inertia[N_STATES];                           // of balls and cage in each velocity, of orbital speeds per r^2; 0 elsewhere
} Derived;

// From here on all members are numbers: jacobian.h gives the derivative of each.

// ---- the inputs over a communication step: polynomials of time, and the half-sine in progress; written by input_trajectory_update ------------------------
typedef struct {
    scalar t_0;                      // communication point [s]
    Inputs u[INPUT_ORDERS + 1];      // the inputs there and their derivatives
    scalar pulse_r, pulse_a;         // amplitude of the half-sine in progress, radial and axial [N]; 0 between pulses
    scalar pulse_start, pulse_rate;  // its start [s] and pi / duration [1/s]
} InputTrajectory;

// ---- what the ring sees of them at one time; written by ring_load_at ---------------------------------------------------------------------------------
typedef struct {
    scalar F[3], M[2];   // load [N], moment about Y, Z [N.m]
    scalar omega;        // speed [rad/s]
    scalar beta, gamma;  // direction cosines of the shaft's tilt
} RingLoad;

// ---- a rigid body with an axis: inner ring or cage half; written by rotor_axis, rotor_body_axes --------------------------------------------------
typedef struct {
    scalar x[3], v[3];      // geometric centre
    scalar a[3], a_dot[3];  // axis: unit vector (a_x, gamma, -beta) and its rate
    scalar Omega[3], s;     // angular velocity a x a_dot + s a, spin s
    scalar b_y[3], b_z[3];  // body axes across (cage halves)
    scalar c[3];            // centre of mass - geometric centre (cage halves)
    scalar F[3], M[3];      // force and moment about the geometric centre, by all contacts
} Rotor;

// ---- the balls in the pockets of one half; written by pocket_force, forces zero where they do not touch ------------------------------------------
typedef struct {
    ball_array Q;                             // contact load [N]
    ball_array F_x, F_r, F_t;                 // force on the half in the pocket's frame [N]
    ball_array push_x, push_t;                // its normal part
    ball_array half_F_x, half_F_y, half_F_z;  // force on the half, global frame
    ball_array half_M_x, half_M_y, half_M_z;  // moment on the half about its geometric centre, global frame
} Pockets;

// ---- one evaluation of the right-hand side, in the order it is written --------------------------------------------------------------------------
typedef struct {
    // position and velocity of the balls: copies of y (ball_kinematics)
    ball_array x, r, theta, v_x, v_r, omega_m, omega_x, omega_r, omega_t;
    ball_array cos_theta, sin_theta, v_t;
    Rotor ring, half[2];
    // contacts: total force and moment on the ball about its centre (race_contact_force sets, pocket_force and drag_force add)
    ball_array F_x, F_r, F_t, M_x, M_r, M_t;
    ball_array g_i, g_e;            // race contacts: |traction|/|slip| [N.s/m] (race_contact_force)
    ball_array g_spin_i, g_spin_e;  // their moment/spin about the normal [N.m.s]
    // stiff rates of the ball's velocities by the pockets, 1/s: -d(acceleration)/d(velocity) (race_contact_force clears, pocket_force adds)
    ball_array D_x, D_r, D_t, D_omega_x, D_omega_r, D_omega_t;
    ball_array dissipated;  // by contacts and drag [W]
    // wrench of the race contacts on the inner ring about its centre, global frame
    ball_array ring_F_x, ring_F_y, ring_F_z, ring_M_x, ring_M_y, ring_M_z;
    // contact results
    ball_array delta_i, delta_e, Q_i, Q_e, n_ix, n_ir, n_it, n_ex, n_er, U_i, U_e;
    ball_array delta_c[2];  // elastic approach of ball and half
    Pockets pocket[2];      // on each half; on a rigid cage all on the first
    // joints, in the frame of half 0 (cage_joint_force)
    ball_array u_x, u_y, u_z, v_jx, v_jy, v_jz;           // half 1 against half 0: offset, velocity
    ball_array T, N_plate, S_y, S_z, H_y, H_z, B_y, B_z;  // rivet tension, plate force, forces on half 1 by plates S, heads H, hole B
    ball_array plate_y_dot, plate_z_dot, head_y_dot, head_z_dot, D_plate, D_head;
    ball_array joint_dissipated;
    // scalars
    scalar land_dissipated, land_elastic, film_yy[2], film_yz[2], film_zz[2], film_spin[2];  // of each land: -dF/dv, -dM/domega
} Work;

typedef struct {
    const Parameters *p;
    const Derived *d;
    const RingLoad *ring_load;          // now
    const InputTrajectory *trajectory;  // where the drive changes with time: takes the place of the drive; NULL where it is held
} Model;

// Derived constants of all elements; the parameters have been checked.
void model_derive(const Parameters *p, Derived *d);

// A Work whose padding lanes are harmless.
void work_init(const Derived *d, Work *w);
