// Data of the model: constants that are derived once, loads that are held over a step, and the results of one
// evaluation of the right-hand side.
//
// Frame: X axial, Y and Z radial.  Ball j has its own cylindrical frame (x, r, t): x along X, r from the axis
// through the ball, t = x cross r.
//
// Letters: i inner, e outer race, c cage, half h = 0 on the side of -X, h = 1 on +X; alpha contact angle;
// n unit normal from race or pocket surface into it, seen from the ball (the ball is pushed along -n).
#pragma once

#include "numbers/lanes.h"
#include "numbers/variable_table.h"
#include "physics/cage_work.h"
#include "physics/land_path.h"

enum { LAND_POINTS = 24, BENT_POINTS = 48 };  // of the sums over a land's film, over that of a bent rim

// Motions that a land's film resists: of the land along y and z, and of its rim by cos 2, sin 2, cos 3 and sin 3 theta of the
// modes that bend it (land_bent.h).
enum { RIM = 4, SQUEEZE = 2 + RIM, BENT_WAVES = 13 };

// ---- constants, written by model_derive at the start and where a temperature changes ----------------------
typedef struct {
    double K;        // Q = K delta^1.5 [N/m^1.5]
    double a, b;     // semi-axes of the contact ellipse / Q^(1/3), a >= b [m/N^(1/3)]
    double a_delta;  // a / delta^(1/2) [m^0.5]
    double k;        // a/b
    double R_x;      // reduced radius in the rolling direction [m]
} Hertz;

enum { WAVES = 60, WAVE_CELLS = 512 };  // orders of a race's waviness, cells of its table over a turn

// Spalls at the contacts of each ball with one race (race_surface.h): the race's own, or those of the balls; sizes are 0 where there is none.
typedef struct {
    constants track, half_length, half_width;  // radius of the ball's path through it; sizes [m]
    constants u_1, u_2;  // distances from its edge to the end of the circle, to the largest drop [m]
    constants bend;      // 1 + u_1/(u_2 - u_1)
    constants flank;     // drop at which the ball rests on the spall's flanks [m]
} Spalls;

// Waves and spall of a race (race_surface.h); all is 0 of a perfect one.
typedef struct {
    bool wavy;                       // whether there are waves
    double wave[WAVE_CELLS + 1][2];  // their height w, slope dw/dphi x width of a cell at its ends [m]
    bool spalled;                    // whether there is a spall
    double middle_cos, middle_sin;   // of the angle of its middle
    double curvature;                // 1/R_x [1/m]
    Spalls spall;
} RaceSurface;

typedef struct {
    double R_g;         // radius of the circle of groove-curvature centres [m]
    double r_g;         // groove radius f D [m]
    double R_m;         // radius of the deformed contact surface across rolling [m]
    double rolling;     // F_R = rolling U^0.66 Q^0.47 [N]
    double horizontal;  // F_H / F_R = 2 R_x / R of the ball
    double ln_Lambda;   // ln of Lambda at U = 1 m/s, Q = 1 N
    Hertz hertz;
    RaceSurface surface;
    Spalls balls;
} Race;

// A ring of the radius rho of its section that touches a pocket's sphere along a circle, the seam.
typedef struct {
    double K;                 // Q = K delta^1.5 [N/m^1.5]
    double reach;             // R_c + rho [m]
    double A, H;              // radius of the ring, distance of its plane from the sphere's centre [m]
    double sine, cosine;      // of the seam's angle: H/reach, A/reach
    double sin_arc, cos_arc;  // of half the opening of the ring's arc
} Rim;

// Pockets of a ribbon cage.
typedef struct {
    bool on;         // the cage is a ribbon
    double e;        // of a sphere's centre beyond the split [m]
    double r;        // of the pockets' middle from the axis [m]
    double radius;   // R_c [m]
    double K, more;  // Q = K delta^1.5 (1 + more delta^0.5) of the sphere
    double a_delta;  // a / delta^(1/2) [m^0.5]
    Rim fillet, edge;
    constants slack;  // R_c - R of each pocket [m]
} Spheres;

// Growth of the inner groove's radius by rotation and fit (ring_fit.h).
typedef struct {
    double growth;   // by rotation with a loose shaft / omega^2 [m.s2]
    double per_fit;  // per radial interference of the tight shaft
    double fit,
        loosening;  // radial interference at standstill [m], its loss by rotation / omega^2 [m.s2]
} RingFit;

// Relative rigid motions of half 1 against half 0, in the frame of half 0: x, about y, about z, y, z, spin.  Rigid motions of both
// halves, in the order of their velocities in the state.
enum { RELATIVE_MOTIONS = 6, CAGE_MOTIONS = 2 * RELATIVE_MOTIONS, BALL_MOTIONS = 3 * Z };

enum { SQUEEZE_NODES = 9 };  // of the polynomials of a pocket's film

// Films of oil in the pockets (pocket_squeeze.h).
typedef struct {
    bool filled;                                        // false: dry pockets, nothing else is written
    double node[SQUEEZE_NODES], newton[SQUEEZE_NODES];  // G(z) in Newton's form
    double reach;                                       // largest gap that has a film [m]
    double roughness_2, elastic;                        // sigma^2 [m2], h_e^2 / v^0.8
    constants c, C, inv_reach;  // c [N.s], radial clearance [m], 1/reach of each pocket
} PocketSqueeze;

// Polynomials of z of a ribbon's films: P and k_t at A and B, P and k_r at R.
enum { P_A, P_B, P_R, K_A, K_B, K_R, SQUEEZE_SHAPES };

// Films in the spheres of a ribbon cage, beside PocketSqueeze without newton and inv_reach (spheres_squeeze.h).
typedef struct {
    double sin_chi, inv_cos_chi, sin_eta, inv_cos_eta;  // ends of the cap: seam of the fillet, edges
    double n_xA, inv_n_x, inv_n_r2;                     // n_x of A, 1/(n_xB - n_xA), 1/n_rR^2
    double newton[SQUEEZE_SHAPES][SQUEEZE_NODES];
    double filling;  // layer of oil / C
} SpheresSqueeze;

typedef struct {
    // balls and races
    constants R;  // ball radius [m]
    double m, J;  // ball mass [kg], moment of inertia [kg.m2]
    Race inner, outer;
    bool rough;    // whether a race is not perfect or a ball has a spall
    bool spalled;  // whether a ball has a spall
    RingFit fit;
    double starvation, ln_heating;  // of the inlets: exponent / U [s/m], ln of the heating term at U = 1 m/s
    double ln_thermal;              // ln of the thermal loading L of the race films at U = 1 m/s

    // mixture; densities in proportion to that of the mixture, or of the oil where the flow gives the filling
    double flooded_omega, air;  // shaft speed up to which oil fills the space [rad/s], density air / oil
    double sigma;               // shaft speed / orbital speed without slip
    double ball_area, inner_wall, outer_wall, fresh;   // B [m2], I and E / |omega|^-0.25, N |omega|
    double drag, churning_viscous, churning_boundary;  // of a ball / v^2 [N.s2/m2], / omega, / omega^1.5
    double ring_drag;  // moment on the ring / (omega - stream)^2 |omega|^-0.25

    // pockets
    double ln_pocket_piezo;  // ln Lambda of the pocket film at U = 1 m/s, Q = 1 N: piezoviscous,
    double ln_pocket_rigid;  // isoviscous-rigid
    double pocket_rolling;   // F_R = pocket_rolling U^0.66 Q^0.47
    Hertz pocket;
    double pocket_radius;              // [m]
    constants R_c;                     // radius of each pocket [m]
    Spheres spheres;                   // of a ribbon cage (pocket_spheres.c)
    constants pocket_cos, pocket_sin;  // of the body angle 2 pi j / Z + dtheta of pocket j
    PocketSqueeze squeeze;             // their films of oil
    SpheresSqueeze spheres_squeeze;    // those of a ribbon cage

    // cage half
    double J_p, J_t;         // moments of inertia: polar, transverse about the centre of mass [kg.m2]
    double com_x[2], com_e;  // centre of mass from the geometric centre: axial, toward pocket 1 [m]
    double C_land;           // radial guide clearance at rest [m]
    double growth;           // of a half's radius at the land / square of its speed in space [m.s2]
    bool guided;             // by lands on the outer ring, not by the balls
    double play;             // radial clearance of the guidance: C_land, or that of the pockets [m]
    double bar;              // width of the bars between the pockets, on the pitch circle [m]
    double kappa;            // eta R L^3 / C^3 [N.s/m]
    double couette;          // Couette torque / speed of a land [N.m.s]
    double nahme;            // (Na/8) / omega^2 of a land's film, 0 without heating [s2]
    double ln_land;          // ln Lambda of a land film of thickness C
    // points of the sum over a film: cos and sin of their angle psi (land_film.c)
    double land_cos[LAND_POINTS], land_sin[LAND_POINTS];
    double bent_cos[BENT_POINTS], bent_sin[BENT_POINTS];
    LandPath land_path;                                 // rows by the load on a rim, at the land's place
    double disk_laminar, disk_turbulent;                // end-face drag moment / |omega|^1.5, |omega|^1.8
    double cylinder_laminar, cylinder_vortex;           // cylinder drag moment / |omega|, |omega|^1.539
    double disk_laminar_omega, cylinder_laminar_omega;  // cage speeds below which each is laminar [rad/s]

    // joint
    constants rivet_y, rivet_z;  // position of rivet k in a half [m]: angle 2 pi (k + 1/2) / Z, pitch circle
    double inv_R;                // 1 / radius of that circle [1/m]
    constants intact;            // 1, or 0 for a rivet that is broken
    constants P;                 // preload [N], 0 of a broken rivet
    double P_mean;               // preload of the rivets that are not broken, mean [N]
    constants fit_eff;           // elastic fit of the same pressure [m]
    unsigned fit_flags[Z];       // rivet_rom_fit_flags
    // stiffnesses [N/m]; k_plate_t: of a joint in the plane as long as its plates stick, k_head: of heads that their slip drags
    double k_rivet, k_plate, k_plate_t, k_head;
    constants k_hole, hole_gap;  // stiffness of the hole [N/m], diametral play of the shank [m]
    double c_joint;              // axial damping of one closed joint [N.s/m]
    double centrifugal[ROWS];    // rows of bonded joints (half_path.h) under that load, per (rad/s)^2

    // relative motions of elastic halves (cage_substeps.c): inverse inertia as the joints feel it [1/kg, 1/(kg.m2)]; share of a relative
    // y/z displacement that moves the centres of mass; common tilt [rad] by unit of y or z at the joints
    double relative_inverse[RELATIVE_MOTIONS], relative_part, relative_tilt;

    // whole state
    double scale[SCALE_COUNT];  // error that tolerance 1 allows, by class of state
    double inertia[N_STATES];   // of balls and cage in each velocity, of orbital speeds / r^2; 0 elsewhere
} Derived;

// All members of the structs from here to Work are scalars, so that jacobian.h can give the derivative of
// each.

// ---- inputs over a communication step; written by input_trajectory_update ---------------------------------
typedef struct {
    scalar t_0;                  // communication point [s]
    Inputs u[INPUT_ORDERS + 1];  // inputs there, and their derivatives
    scalar pulse_r, pulse_a;     // radial and axial amplitude of the half-sine in progress [N]; 0 if none is
    scalar pulse_start, pulse_rate;  // its start [s], pi / duration [1/s]; rate 0: amplitudes are means
    scalar gravity[2], radius;       // parameters gravity.y, gravity.z [m/s2] and frame.radius [m]
    scalar angle[3];       // by which frame, inner ring, outer ring have turned from the start to t_0 [rad]
    scalar angles_matter;  // not 0 if a race is not perfect: else the rings' angles stay 0
} InputTrajectory;

// ---- loads and motions that the inputs impose on the bearing at one time; written by ring_load_at ---------
typedef struct {
    scalar F[3], M[2];   // load [N], moment about Y, Z [N.m]
    scalar omega;        // speed [rad/s]
    scalar beta, gamma;  // direction cosines of the shaft's tilt
    scalar omega_dot;    // rate of the speed [rad/s2]

    // motion of the inner ring where it is prescribed: position, velocity, acceleration; rates of the cosines
    scalar x[3], v[3], a[3];
    scalar beta_dot, gamma_dot, beta_ddot, gamma_ddot;

    // motion of the outer ring: position, velocity, direction cosines and their rates, speed [rad/s]
    scalar outer_x[3], outer_v[3];
    scalar outer_beta, outer_gamma, outer_beta_dot, outer_gamma_dot, outer_omega;
    scalar outer_moves;  // not 0 if any of these is not
    scalar outer_a[3];   // its acceleration
    scalar base[5],
        base_dot[5];  // inputs housing.*: x, y, z, cosines beta, gamma and their rates (housing.h)

    // the frame: gravity less the acceleration of the bearing's centre [m/s2], speed [rad/s] and its rate
    scalar field[3], frame_omega, frame_omega_dot;
    scalar frame_turns;  // not 0 if one of the last two is not

    scalar inner_angle,
        outer_angle;  // by which the rings have turned since the start [rad]; 0 of perfect races
} RingLoad;

// ---- how far balls with spalls have turned; written by the step (verlet.c) --------------------------------
typedef struct {
    scalar angle[Z];  // of the spall's middle from the ball's outer contact, about the rolling axis [rad]
    scalar rate[Z];   // [rad/s]
} BallTurn;

// ---- a rigid body with an axis: inner ring or cage half; written by rotor_axis, rotor_body_axes -----------
typedef struct {
    scalar x[3], v[3];      // geometric centre: position, velocity
    scalar a[3], a_dot[3];  // axis: unit vector (a_x, gamma, -beta) and its rate
    scalar Omega[3], s;     // angular velocity a x a_dot + s a, spin s
    scalar b_y[3], b_z[3];  // body axes across the axis (cage halves)
    scalar c[3];            // centre of mass - geometric centre (cage halves)
    scalar F[3], M[3];      // force and moment about the geometric centre, by all contacts
} Rotor;

// ---- rates of the film of one land, -dF/dv [N.s/m] and -dM/domega [N.m.s]; written by land_film_force --------
typedef struct {
    scalar yy, yz, zz, spin;
} LandFilm;

// ---- pressure on the rim of an elastic half, along the half's axes; written by land_film.c, velocities and forces again by
// land_bent.c at a step's end: eccentricity [m], pure squeeze velocity [m/s], load of the dry contact [N], part of the film's
// waves that load the rivets, change of the load by the gap [N/m], clearance [m], kappa C^3 [N.s.m2], velocity of the land [m/s], the rim's motion [m], its
// velocity and squeeze velocity [m/s], forces on the rim's shapes and, by the film alone, on land and rim [N]; change of
// the squeeze velocities by the spin against the outer ring [m], waves of the film's rates [N.s/m], squeeze velocities to
// which film and rates belong ----
typedef struct {
    scalar e[2], V[2], dry, felt, stiffness, C, kappa_C3, v[2], rim[RIM], rim_v[RIM], rim_V[RIM],
        rim_force[RIM], film[SQUEEZE];
    scalar by_spin[SQUEEZE], waves[BENT_WAVES], at[SQUEEZE];
} LandPressure;

// ---- the points of the film of one bent rim: shapes of land and rim, kappa C^3 dtheta/h^3 [N.s/m], depth behind the wall over the
// clearance times dtheta; written by land_film_force ----
typedef struct {
    scalar b[SQUEEZE][BENT_POINTS], stiff[BENT_POINTS], behind[BENT_POINTS];
} BentGrid;

// ---- harmonics Re and Im G_p of the radial load on one rim [N], p = 0...LAND_HIGHEST; written by land_film_force ----
typedef struct {
    scalar re[LAND_HARMONICS], im[LAND_HARMONICS];
} LandLoad;

// ---- the balls in the pockets of one half; written by cage_pockets, loads and forces again by pocket_films.c at a
// step's end, 0 for pockets without contact; push and radius are then those of the last contact ----
typedef struct {
    ball_array Q;               // contact load [N]
    ball_array F_x, F_r, F_t;   // force on the half in the pocket's frame [N]
    ball_array push_x, push_t;  // its normal part; on a ribbon its place from the sphere's centre [m]
    ball_array radius;          // of the place on a ribbon, from the bearing's axis [m]
    ball_array half_F_x, half_F_y, half_F_z;  // force on the half, global frame
    ball_array half_M_x, half_M_y, half_M_z;  // moment on the half about its geometric centre, global frame
} Pockets;

// ---- results of one evaluation of the right-hand side, in the order in which they are written -------------
typedef struct {
    // position and velocity of the balls: copies of y (ball_kinematics)
    ball_array x, r, theta, v_x, v_r, omega_m, omega_x, omega_r, omega_t;
    ball_array cos_theta, sin_theta, v_t;
    Rotor ring, half[2];

    // of the outer ring and of the frame, for the records over steps (evaluate in rhs.c)
    scalar outer_x[3], outer_gamma, outer_beta, frame_omega;

    // total force and moment on the ball about its centre (set by race_contact_force, then cage_pockets and
    // drag_force add theirs), power dissipated by contacts and drag [W]
    ball_array F_x, F_r, F_t, M_x, M_r, M_t;
    ball_array dissipated;

    // its parts [W]: races, of it the inlet's rolling friction and the spin about the normal
    // (race_contact_force), pockets (cleared there, added by cage_pockets), drag (drag_force)
    ball_array race_dissipated, inlet_dissipated, spin_dissipated, pocket_dissipated, drag_dissipated;

    // elastic energy of both race contacts [J], where a race is not perfect or a ball has a spall; rates of the
    // balls' turns [rad/s], where a ball has one (race_contact_force)
    ball_array race_stored, turn_rate;

    // stiff rates of the race contacts (race_contact_force): |traction|/|slip| [N.s/m], moment/spin about the
    // normal [N.m.s]
    ball_array g_i, g_e, g_spin_i, g_spin_e;

    // stiff rates of the ball's velocities by the pockets, -d(acceleration)/d(velocity) [1/s] (cleared by
    // race_contact_force, added by cage_pockets)
    ball_array D_x, D_r, D_t, D_omega_x, D_omega_r, D_omega_t;

    // wrench of the race contacts on the inner ring about its centre, global frame
    ball_array ring_F_x, ring_F_y, ring_F_z, ring_M_x, ring_M_y, ring_M_z;

    // contact results: approaches [m], loads [N], normals, mean surface speeds [m/s]
    ball_array delta_i, delta_e, Q_i, Q_e, n_ix, n_ir, n_it, n_ex, n_er, U_i, U_e;
    ball_array delta_c[2];  // approach of ball and pocket of each half
    Pockets pocket[2];      // of each half

    // joints, in the frame of half 0 (cage_joint.c): offset and velocity of half 1 against half 0 as rigid bodies; forces
    // on half 1 by plates (S), heads (H) and hole (B), and their sum in the plane; parts of the friction states' trial
    // deflections that friction holds; stiffness of the hole where the shank bears, else 0 [N/m]; power of the friction
    ball_array u_x, u_y, u_z, v_jx, v_jy, v_jz;
    ball_array S_y, S_z, H_y, H_z, B_y, B_z, joint_F_y, joint_F_z;
    ball_array plate_held, head_held, k_bearing;
    ball_array joint_dissipated;
    ball_array joint_rubbed;  // normal force times slip in the step that ends here [J] (halves_slide)

    // mixture (drag_mixture): density / that of the derived constants, angular speed about X [rad/s],
    // |shaft speed|^-0.25; power of its friction on the ring [W] (drag_ring)
    scalar filling, stream, wall;
    scalar ring_drag_dissipated;

    // rims of elastic halves at their lands (cage_elastic_kinematics): motion of the shapes and velocity [m, m/s]
    scalar rim[2][RIM], rim_v[2][RIM];

    // cage (land_film_force, drag_cage): power of lands and drag together, of the lands, of the drag [W]
    scalar cage_dissipated, land_dissipated, cage_drag_dissipated;

    // lands (land_film_force): elastic energy [J]; of each the energy that its growth adds per change of the half's speed [J.s];
    // films
    scalar land_elastic, land_growth[2];
    LandFilm film[2];
    LandPressure pressure[2];
    BentGrid bent[2];  // of rims that are bent
    // from a step's evaluation to its end, else 0: change of a film's squeeze velocities by its own force, per force [m/s/N]; its
    // forces at the step's start [N], which the predicted velocities have felt all the step
    scalar squeeze_by[2][SQUEEZE], squeeze_from[2][SQUEEZE];
    LandLoad land[2];  // of rigid halves

    CageWork cage;  // of the kind of cage that runs
} Work;

enum { HOUSING_DOF = 5 };  // x, y, z, beta, gamma

// A housing on springs (housing.h): position, velocity, acceleration, and the load at the start, which its springs carry.
typedef struct {
    double x[HOUSING_DOF], v[HOUSING_DOF], a[HOUSING_DOF], rest[HOUSING_DOF];
} Housing;

// Exchange with the shaft: its torque about its axis [N.m], its power [W] and the amount of that; the power that is lost; the
// jump of the net power with the inputs; or the integrals of all these over time.
typedef struct {
    double torque, power, exchanged, lost, jump;
} Exchange;

// All that the right-hand side needs beside time and state.
typedef struct {
    const Parameters *p;  // at the present temperatures (temperature.h)
    const Derived *d;
    const RingLoad *ring_load;          // load at present; used while there is no trajectory
    const InputTrajectory *trajectory;  // from which the load at any time follows; NULL: the load is held
    const ElasticHalf *modes;  // of the cage's halves, where they are elastic, else NULL (cage/cage.h)
    const Housing *housing;    // where it moves on springs; NULL: its motion is given
    const BallTurn *turn;      // of balls with spalls; NULL: that of the start
} Model;

// Derived constants of all elements; the parameters have been checked and have their present temperatures.
void model_derive(const Parameters *p, Derived *d);

// Moments of inertia of a cage half, J_t about its centre of mass; values left at their start follow the mass.
void cage_half_inertia(const Parameters *p, double *J_p, double *J_t);

// A Work whose padding lanes are harmless.
void work_init(const Derived *d, Work *w);
