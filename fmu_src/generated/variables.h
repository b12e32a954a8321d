// Written by fmus/generate.py from fmus/variables.toml: do not edit.
// clang-format off
// All variables of the model: what users set (Parameters, Inputs), what they read (Outputs), and the state vector.  SI units.
#pragma once

#include "numbers/scalar.h"

#include <stddef.h>

#define FMI2_FUNCTION_PREFIX RivetedBearing_  // of the functions of a source-code FMU
#define MODEL_IDENTIFIER "RivetedBearing"
#define MODEL_GUID "{4e74854a-0aa4-6ae4-675b-2f8acd089ac6}"  // digest of the table

enum { Z = 9 };  // number of balls

enum {  // TiltMode
    TILT_MODE_PRESCRIBED = 1,  // tilt follows shaft.tilt through a critically damped filter
    TILT_MODE_SUPPORTED = 2,  // elastic support: k_tilt (shaft.tilt - ring.tilt) + c_tilt (rates) + shaft.M
    TILT_MODE_FREE = 3,  // external moments shaft.M only
};
enum {  // RingMotion
    RING_MOTION_FREE = 1,  // loads move the inner ring: shaft.F, shaft.M, impacts
    RING_MOTION_PRESCRIBED = 2,  // the inner ring moves as shaft.x, y, z, tilt_y, tilt_z and their rates say
};
enum {  // HousingMotion
    HOUSING_MOTION_GIVEN = 1,  // the outer ring moves as housing.x, y, z, tilt_y, tilt_z and their rates say
    HOUSING_MOTION_SUPPORTED = 2,  // the outer ring sits in a housing of mass m on springs, whose base moves as these inputs say
};
enum {  // CageMaterial
    CAGE_MATERIAL_BRONZE = 1,  // CuSn8
    CAGE_MATERIAL_BRASS = 2,  // machined brass
    CAGE_MATERIAL_STEEL = 3,  // machined steel
    CAGE_MATERIAL_PA66_GF25 = 4,  // polyamide 66 with 25 % glass fibres
    CAGE_MATERIAL_PEEK = 5,  // polyether ether ketone
    CAGE_MATERIAL_OWN = 6,  // the constants of the bearing file
    CAGE_MATERIAL_DC04 = 7,  // pressed cold-rolled steel sheet
};
enum {  // CageShape
    CAGE_SHAPE_MACHINED = 1,  // solid halves with pockets drilled along their radius
    CAGE_SHAPE_RIBBON = 2,  // pressed halves with two spheres a pocket
};
enum {  // CageGuidance
    CAGE_GUIDANCE_OUTER = 1,  // the outer ring's land
    CAGE_GUIDANCE_BALLS = 2,  // the balls, by their pockets
};
enum {  // CageModel
    CAGE_MODEL_TWO_HALF = 1,  // two halves held by the rivets
    CAGE_MODEL_ELASTIC = 3,  // two elastic halves held by the rivets: vibration modes move the pockets' walls and load the joints
};
#define CAGE_MODEL_RIGID_RETIRED "one rigid cage is no longer computed: two_half (1) takes the same time and is truer"
enum {  // Traction
    TRACTION_POINT = 1,  // one slip for the whole contact
    TRACTION_SLICED = 2,  // slip, spin and curvature in 12 slices over the contact ellipse
};
enum {  // Lubrication
    LUBRICATION_FILM = 1,  // full film in races and pockets
    LUBRICATION_MIXED = 2,  // asperity share by the film ratio Lambda
};
enum {  // Stress
    STRESS_OFF = 1,  // no rivet stress
    STRESS_SAMPLED = 2,  // at communication points
    STRESS_PEAK = 3,  // and largest value over every accepted step
    STRESS_FATIGUE = 4,  // and rainflow counting with Miner's sum
};
enum {  // Switch
    SWITCH_OFF = 1,  // off
    SWITCH_ON = 2,  // on
};
enum {  // FitModel
    FIT_MODEL_ELASTIC = 1,  // interference stays elastic
    FIT_MODEL_J2 = 2,  // interference yields the flange: fit_eff of the rivet table
};
enum {  // MeanStress
    MEAN_STRESS_NONE = 1,  // no mean-stress correction
    MEAN_STRESS_GOODMAN = 2,  // Goodman
    MEAN_STRESS_SWT = 3,  // Smith-Watson-Topper
    MEAN_STRESS_MORROW = 4,  // Morrow
};
enum {  // Drag
    DRAG_ISOLATED = 1,  // each ball by itself in a mixture at rest
    DRAG_ROW = 2,  // balls in a row that carry the mixture along
};
enum {  // Method
    METHOD_VERLET = 1,  // velocity Verlet, linearly implicit in what is stiff
    METHOD_EXPLICIT = 2,  // classical Runge-Kutta 4(3)
    METHOD_FIXED = 3,  // the steps of verlet, all of one length: a fixed cost for real time
};

typedef struct {
    struct Parameters_bearing {
        double D;  // [m] Ball diameter
        double d_m;  // [m] Pitch diameter: mean of the groove-bottom diameters
        double f_i;  // [1] Inner groove radius / ball diameter
        double f_e;  // [1] Outer groove radius / ball diameter
        double P_d;  // [m] Diametral (radial internal) clearance, negative = preload
        double E;  // [Pa] Young's modulus of the rings, and of the balls unless ball.E says otherwise
        double nu;  // [1] Poisson's ratio of the rings, and of the balls unless ball.nu says otherwise
        double rho;  // [kg/m3] Density of the balls
        double lambda;  // [s/m] Hunt-Crossley damping of the race contacts: Q = K delta^1.5 (1 + lambda delta_dot)
        double h_i;  // [1] Height of the inner ring's shoulder above the groove's bottom / ball diameter: reported when the contact ellipse reaches over it
        double h_e;  // [1] Height of the outer ring's shoulder above the groove's bottom / ball diameter: reported when the contact ellipse reaches over it
        double p_limit;  // [Pa] Contact pressure of the races beyond which a warning is given
        double expansion;  // [1/K] Thermal expansion of the rings, and of the balls unless ball.expansion is set; dimensions are those at assembly
    } bearing;
    struct Parameters_ball {
        double E;  // [Pa] Young's modulus of the balls
        double nu;  // [1] Poisson's ratio of the balls
        double expansion;  // [1/K] Thermal expansion of the balls
        double dD[Z];  // [m] Excess of the ball's diameter over bearing.D
        double spall_angle[Z];  // [rad] Angle of the middle of the ball's spall at the start, about the rolling axis from the outer contact toward growing azimuth
        double spall_length[Z];  // [m] Length of the spall along the ball's track
        double spall_width[Z];  // [m] Width of the spall across the track, in the middle of the contacts
        double spall_depth[Z];  // [m] Depth of the spall
        double spall_edge[Z];  // [m] Length over which the path into the spall is rounded where the race meets the bottom or the other edge
    } ball;
    struct Parameters_outer {
        double spall_angle;  // [rad] Angle of the spall's middle on the outer ring at the start, from +Y toward +Z; it turns with the ring
        double spall_length;  // [m] Length of the spall along the track
        double spall_width;  // [m] Width of the spall across the track, in the middle of the contacts
        double spall_depth;  // [m] Depth of the spall
        double spall_edge;  // [m] Length over which the ball's path into the spall is rounded where the ball meets the bottom or the other edge
        double waviness[60];  // [m] Amplitude of n waves around the outer race, a height into the bearing's clearance: waviness[n] cos(n phi + waviness_phase[n])
        double waviness_phase[60];  // [rad] Phase of n waves around the outer race; phi from +Y toward +Z at the start, turning with the ring
    } outer;
    struct Parameters_inner {
        double spall_angle;  // [rad] Angle of the spall's middle on the inner ring at the start, from +Y toward +Z; it turns with the ring
        double spall_length;  // [m] Length of the spall along the track
        double spall_width;  // [m] Width of the spall across the track, in the middle of the contacts
        double spall_depth;  // [m] Depth of the spall
        double spall_edge;  // [m] Length over which the ball's path into the spall is rounded where the ball meets the bottom or the other edge
        double waviness[60];  // [m] Amplitude of n waves around the inner race, a height into the bearing's clearance: waviness[n] cos(n phi + waviness_phase[n])
        double waviness_phase[60];  // [rad] Phase of n waves around the inner race; phi from +Y toward +Z at the start, turning with the ring
    } inner;
    struct Parameters_cage {
        double pocket_clearance;  // [m] Pocket diameter - ball diameter
        double guide_clearance;  // [m] Outer ring land diameter - cage outer diameter
        double pocket_filling;  // [1] Oil in the pockets, layer of oil / mean gap: 0 dry, 1 flooded; oil.flow does not enter
        double D_o;  // [m] Cage outer diameter (guided by the outer ring)
        double D_i;  // [m] Cage bore diameter
        double m;  // [kg] Mass of one cage half
        double J_p;  // [kg.m2] Polar moment of inertia of one cage half
        double J_t;  // [kg.m2] Transverse moment of inertia of one cage half about its own centre of mass
        double x_c;  // [m] Axial distance of a half's centre of mass from the split plane
        double land_width;  // [m] Width of the guiding land of one half
        double land_x;  // [m] Axial distance of the land's middle from the split plane
        int material;  // CageMaterial: Material of the cage, from which its rivet table was made
        double E;  // [Pa] Young's modulus of the cage
        double nu;  // [1] Poisson's ratio of the cage
        double rho;  // [kg/m3] Density of the cage
        double mu;  // [1] Friction coefficient between ball and pocket with a full film
        double v_c;  // [m/s] Sliding speed at which pocket and land friction are 71 % of Coulomb's
        double lambda;  // [s/m] Hunt-Crossley damping of the pocket contacts
        double mu_land;  // [1] Dry friction coefficient between land and outer ring
        double K_land;  // [N/m1.5] Dry contact stiffness of the land: F = K_land (e - C)^1.5
        double g_0;  // [1] Floor of 1 - epsilon^2 in the land film
        double unbalance;  // [kg.m] Static unbalance of the whole cage, in the direction of pocket 1
        double width;  // [m] Axial width of the whole cage
        int shape;  // CageShape: Shape of the cage halves, from which the rivet table was made
        int guidance;  // CageGuidance: Guidance of the cage: outer, by the film between its lands and the outer ring; balls, by the pockets alone (ribbon cages)
        double sheet;  // [m] Sheet thickness of a ribbon half
        double pocket_depth;  // [m] Depth of a ribbon half's pocket, from the plane of the split to the sphere's bottom
        double pocket_radius;  // [m] Radius of the sphere of a ribbon half's pocket; 0 stands for (bearing.D + cage.pocket_clearance)/2, another value must agree with it
        double pocket_fillet;  // [m] Radius of the convex fillet between the sphere and the land of a ribbon half, on the balls' side
        double pocket_edge;  // [m] Radius of the edges of a ribbon half's pocket, at the cage's outer and inner diameter; 0 stands for cage.sheet/10
        int centrifugal;  // Switch: Centrifugal load of the cage halves: at the rivets, and their growth at the guiding land
        double modal_damping;  // [1] Damping ratio of each vibration mode of the halves, scene.cage = elastic
        double modal_damping_high;  // [1] Damping ratio of the highest mode; from that of the lowest, cage.modal_damping, linear over ln of the frequency
    } cage;
    struct Parameters_pocket {
        double dtheta[Z];  // [rad] Angle of the pocket beyond its place 2 pi (j - 1)/Z, in the sense of rotation
        double dD[Z];  // [m] Excess of the pocket's diameter
    } pocket;
    struct Parameters_joint {
        double preload;  // [N] Preload of each rivet at 293.15 K
        double fit;  // [m] Rivet diameter - hole diameter, negative = clearance
        double swell;  // [m] Growth of the rivet's diameter by riveting, added to the fit
        double mu;  // [1] Friction coefficient of plates and rivet heads
        double zeta;  // [1] Damping ratio of the closed joints in the axial direction
        double F_floor;  // [N] Friction capacity that remains in an open joint
        double wear;  // [1/Pa] Wear coefficient of plates and heads, volume / (normal force x slip): preload that the rivets lose
    } joint;
    struct Parameters_rivet {
        double preload_factor[Z];  // [1] Preload of this rivet / joint.preload
        double dfit[Z];  // [m] Fit of this rivet less joint.fit
        int intact[Z];  // 0: the rivet is broken and carries nothing; the plates still meet under pressure
        double strength_factor[Z];  // [1] Strength of this rivet: factor on fatigue.sigma_D, sigma_m and sigma_f
        int fit_model;  // FitModel: Interference: elastic, or with yield of the flange
    } rivet;
    struct Parameters_oil {
        double eta;  // [Pa.s] Dynamic viscosity of the oil at oil.T_0; left at its start value it follows from oil.nu_1, oil.nu_2; one set in a run is in force
        double alpha;  // [1/Pa] Pressure-viscosity coefficient at the temperature oil.T_0
        double A;  // [1] Traction law mu(s) = (A + B s) exp(-C s) - A
        double B;  // [1] Traction law: linear term
        double C;  // [1] Traction law: decay
        double v_0;  // [m/s] Slip speed below which traction is linear in any case
        double U_0;  // [m/s] Floor of the rolling speed in slide-roll ratio and film
        double rolling;  // [1] Factor on the inlet rolling friction F_R and the horizontal film force F_H
        double rho_mix;  // [kg/m3] Density of the oil-air mixture between the rings
        double C_d;  // [1] Drag coefficient of a ball in the mixture
        double mu_b;  // [1] Boundary friction coefficient of asperities (mixed lubrication)
        double s_0;  // [1] Slide-roll ratio at which asperity friction is 71 % of mu_b
        double sigma_race;  // [m] Composite RMS roughness of ball and race
        double sigma_pocket;  // [m] Composite RMS roughness of ball and pocket, floor of a film in the pocket
        double sigma_land;  // [m] Composite RMS roughness of cage and outer ring lands
        double rho;  // [kg/m3] Density of the oil at the temperature oil.T_0
        double flow;  // [m3/s] Flow of oil through the bearing, from which the density of the mixture follows (Parker, NASA TP-2275)
        double beta;  // [1/K] Fall of the viscosity's logarithm with temperature at oil.T_0; left at its start value it follows from oil.nu_1, oil.nu_2; one set in a run is in force
        double T_0;  // [K] Temperature at which oil.eta, oil.alpha, oil.rho and oil.beta are given
        double nu_1;  // [m2/s] Kinematic viscosity of the oil at the lower temperature oil.T_1
        double T_1;  // [K] Lower temperature of the viscosity's two points
        double nu_2;  // [m2/s] Kinematic viscosity of the oil at the higher temperature oil.T_2
        double T_2;  // [K] Higher temperature of the viscosity's two points
        double expansion;  // [1/K] Fall of the oil's density with temperature / oil.rho
        double alpha_T;  // [1/K] Fall of the pressure-viscosity coefficient's logarithm with temperature
        double k;  // [W/m.K] Thermal conductivity of the oil
        double K_rs;  // [1] Starvation of the race inlets
        double K_Z;  // [1] Starvation of the race inlets: factor of the bearing type
    } oil;
    struct Parameters_ring {
        double m;  // [kg] Mass of the inner ring with its share of the shaft
        double J_p;  // [kg.m2] Polar moment of inertia of the inner ring
        double J_t;  // [kg.m2] Transverse moment of inertia of the inner ring
        double c;  // [N.s/m] Damping of the inner ring's translation against the housing
        int tilt_mode;  // TiltMode: How the inner ring tilts
        double tilt_time;  // [s] Time constant of the critically damped filter of the prescribed tilt
        double k_tilt;  // [N.m/rad] Angular stiffness of the ring's support (supported tilt)
        double c_tilt;  // [N.m.s/rad] Angular damping of the ring's support (supported tilt)
        double bore;  // [m] Bore of the inner ring: its growth by rotation and fit
        double rho;  // [kg/m3] Density of the inner ring
        int motion;  // RingMotion: Whether the shaft's loads or its motion are given
        double outside;  // [m] Outside diameter of the outer ring: its fit in the housing
        double effective_i;  // [m] Outside diameter of the cylinder that the inner ring is for growth and fit
        double effective_e;  // [m] Inside diameter of the cylinder that the outer ring is for its fit
    } ring;
    struct Parameters_shaft {
        double interference;  // [m] Shaft diameter - bore of the inner ring before mounting, at assembly temperature; negative = clearance
        double bore;  // [m] Bore of the shaft
        double E;  // [Pa] Young's modulus of the shaft
        double nu;  // [1] Poisson's ratio of the shaft
        double rho;  // [kg/m3] Density of the shaft
        double expansion;  // [1/K] Thermal expansion of the shaft, whose seat has the inner ring's temperature
    } shaft;
    struct Parameters_housing {
        double interference;  // [m] Outside diameter of the outer ring - bore of the housing before mounting, at assembly temperature; negative = clearance
        double outside;  // [m] Outside diameter of the housing
        double E;  // [Pa] Young's modulus of the housing
        double nu;  // [1] Poisson's ratio of the housing
        double expansion;  // [1/K] Thermal expansion of the housing, whose seat has the outer ring's temperature
        int motion;  // HousingMotion: Whether the housing's motion is given or follows from springs
        double m;  // [kg] Mass of the housing with the outer ring
        double J;  // [kg.m2] Moment of inertia of the housing with the outer ring about Y and Z
        double k_x;  // [N/m] Stiffness of the housing's support along X
        double k_y;  // [N/m] Stiffness of the housing's support along Y
        double k_z;  // [N/m] Stiffness of the housing's support along Z
        double c_x;  // [N.s/m] Damping of the housing's support along X
        double c_y;  // [N.s/m] Damping of the housing's support along Y
        double c_z;  // [N.s/m] Damping of the housing's support along Z
        double k_tilt_y;  // [N.m/rad] Stiffness of the housing's support about Y
        double k_tilt_z;  // [N.m/rad] Stiffness of the housing's support about Z
        double c_tilt_y;  // [N.m.s/rad] Damping of the housing's support about Y
        double c_tilt_z;  // [N.m.s/rad] Damping of the housing's support about Z
    } housing;
    struct Parameters_gravity {
        double y;  // [m/s2] Gravity along Y of the fixed frame, to which the bearing's frame is parallel at the start
        double z;  // [m/s2] Gravity along Z of the fixed frame
    } gravity;
    struct Parameters_frame {
        double radius;  // [m] Distance of the bearing from the axis of frame.omega, which lies on -Y
    } frame;
    struct Parameters_pulse {
        double F_r;  // [N] Amplitude of the built-in half-sine impacts along the radial load
        double F_a;  // [N] Amplitude of the built-in half-sine impacts along +X
        double t_start;  // [s] Start of the first impact
        double duration;  // [s] Duration of one impact
        double interval;  // [s] Time from one impact's start to the next one's (not shorter than the duration)
        int count;  // Number of impacts
    } pulse;
    struct Parameters_fatigue {
        double sigma_D;  // [Pa] Stress amplitude at the knee of the S-N curve (R = -1)
        double N_D;  // [1] Cycles at the knee
        double k_1;  // [1] Slope above the knee: N = N_D (sigma_a/sigma_D)^-k_1
        double k_2;  // [1] Slope below the knee
        double sigma_m;  // [Pa] Tensile strength (Goodman)
        double sigma_f;  // [Pa] Fatigue strength coefficient (Morrow)
        double acceleration;  // [1] Factor on the damage of every cycle that is counted, by which a life passes in seconds; 1 for results
        double fretting;  // [1] Fretting strength reduction: divides the strength of the middle of a shank on which its hole presses
        int mean_stress;  // MeanStress: Mean-stress correction
    } fatigue;
    struct Parameters_scene {
        int cage;  // CageModel: Cage of two halves, rigid or elastic ones
        int traction;  // Traction: Traction at a point or over slices of the contact ellipse
        int lubrication;  // Lubrication: Full film or mixed lubrication
        int stress;  // Stress: When the rivet stress is computed
        int statistics;  // Switch: Running mean, RMS and histogram behind stat.*
        int drag;  // Drag: Drag of the balls in the mixture between the rings
        int churning;  // Switch: Drag moment of the mixture on the spinning balls
        int heating;  // Switch: Shear heating in the inlets of the races, in their films and in the films of the lands
        int growth;  // Switch: Growth of the inner ring by its rotation, which takes clearance
        int breakage;  // Switch: Whether a rivet breaks at the end of the communication step in which its damage reaches 1
    } scene;
    struct Parameters_solver {
        double tol;  // [1] Tolerance: local error / scale of each state class; a tolerance of fmi2SetupExperiment takes its place
        int method;  // Method: Integration method
        double step;  // [s] Longest internal step of solver.method = fixed, at least 1 ns (0: derived at the start; solver.step_size shows it)
        int clock;  // Switch: Measure solver.cpu_time
        int max_steps;  // Largest number of internal steps in one communication step; 0: 6000 for each 0.1 ms begun, 20000 with solver.method = fixed
    } solver;
    struct Parameters_start {
        int seed;  // Seed of the balls' initial spacing (splitmix64)
        double spacing;  // [1] Initial spacing error: uniform within +- this part of the pocket clearance
        double settle;  // [s] Time before which stat.* and damage do not count
    } start;
    struct {  // whether the host has given a value to a parameter whose start value stands for one that follows from others
        int oil_eta;
        int oil_beta;
    } given;
} Parameters;

typedef struct {
    struct Inputs_shaft {
        scalar F_x;  // [N] Axial load on the inner ring
        scalar F_y;  // [N] Radial load on the inner ring along Y
        scalar F_z;  // [N] Radial load on the inner ring along Z
        scalar M_y;  // [N.m] Moment about Y on the inner ring (supported or free tilt)
        scalar M_z;  // [N.m] Moment about Z on the inner ring (supported or free tilt)
        scalar omega;  // [rad/s] Speed of the inner ring about X
        scalar tilt_y;  // [rad] Tilt of the shaft about Y (+X turns toward -Z)
        scalar tilt_z;  // [rad] Tilt of the shaft about Z (+X turns toward +Y)
        scalar x;  // [m] Position of the inner ring along X (prescribed motion)
        scalar y;  // [m] Position of the inner ring along Y (prescribed motion)
        scalar z;  // [m] Position of the inner ring along Z (prescribed motion)
        scalar v_x;  // [m/s] Velocity of the inner ring along X (prescribed motion)
        scalar v_y;  // [m/s] Velocity of the inner ring along Y (prescribed motion)
        scalar v_z;  // [m/s] Velocity of the inner ring along Z (prescribed motion)
        scalar tilt_y_dot;  // [rad/s] Rate of shaft.tilt_y (prescribed motion)
        scalar tilt_z_dot;  // [rad/s] Rate of shaft.tilt_z (prescribed motion)
    } shaft;
    struct Inputs_impact {
        scalar F_r;  // [N] Impact load added along the present radial load (+Y if there is none)
        scalar F_a;  // [N] Impact load added along +X
    } impact;
    struct Inputs_housing {
        scalar x;  // [m] Position of the outer ring along X
        scalar y;  // [m] Position of the outer ring along Y
        scalar z;  // [m] Position of the outer ring along Z
        scalar v_x;  // [m/s] Velocity of the outer ring along X
        scalar v_y;  // [m/s] Velocity of the outer ring along Y
        scalar v_z;  // [m/s] Velocity of the outer ring along Z
        scalar tilt_y;  // [rad] Tilt of the outer ring about Y (+X turns toward -Z)
        scalar tilt_z;  // [rad] Tilt of the outer ring about Z (+X turns toward +Y)
        scalar tilt_y_dot;  // [rad/s] Rate of housing.tilt_y
        scalar tilt_z_dot;  // [rad/s] Rate of housing.tilt_z
        scalar omega;  // [rad/s] Speed of the outer ring about X
    } housing;
    struct Inputs_frame {
        scalar a_x;  // [m/s2] Acceleration of the frame's axis of rotation along X of the frame
        scalar a_y;  // [m/s2] Acceleration of the frame's axis of rotation along Y of the frame
        scalar a_z;  // [m/s2] Acceleration of the frame's axis of rotation along Z of the frame
        scalar omega;  // [rad/s] Speed of the frame about an axis parallel to X, frame.radius away on -Y
        scalar omega_dot;  // [rad/s2] Rate of frame.omega
    } frame;
    struct Inputs_oil {
        scalar T;  // [K] Temperature of the oil
    } oil;
    struct Inputs_ring {
        scalar T_i;  // [K] Temperature of the inner ring
        scalar T_e;  // [K] Temperature of the outer ring
    } ring;
    struct Inputs_ball {
        scalar T;  // [K] Temperature of the balls
    } ball;
    struct Inputs_cage {
        scalar T;  // [K] Temperature of cage and rivets
    } cage;
} Inputs;

typedef struct {
    struct Outputs_bearing {
        scalar Z;  // [1] Number of balls (build-time constant)
        scalar energy;  // [J] Kinetic energy of balls and cage in the frame, and elastic energy of all contacts
        scalar friction_torque;  // [N.m] Torque that the shaft must supply about X; mean over the communication step
        scalar power_loss;  // [W] Power dissipated in contacts, films, drag and joints
        scalar energy_residual;  // [J] Energy now - energy at start - bearing.energy_change - net work since: 0 but for the errors of the integration and of the work's own integral
        scalar energy_change;  // [J] Energy that changes of parameters have added to the bearing since the start; negative: released, as by a rivet that breaks
        scalar contacts;  // [1] Number of closed contacts (races and pockets)
        scalar penetration;  // [m] Largest elastic approach of all contacts
        scalar clearance;  // [m] Diametral clearance at the present speed, temperatures and fits
    } bearing;
    struct Outputs_ring {
        scalar x;  // [m] Displacement of the inner ring along X
        scalar y;  // [m] Displacement of the inner ring along Y
        scalar z;  // [m] Displacement of the inner ring along Z
        scalar v_x;  // [m/s] Velocity of the inner ring along X
        scalar v_y;  // [m/s] Velocity of the inner ring along Y
        scalar v_z;  // [m/s] Velocity of the inner ring along Z
        scalar a_x;  // [m/s2] Acceleration of the inner ring along X
        scalar a_y;  // [m/s2] Acceleration of the inner ring along Y
        scalar a_z;  // [m/s2] Acceleration of the inner ring along Z
        scalar tilt_y;  // [rad] Tilt of the inner ring about Y
        scalar tilt_z;  // [rad] Tilt of the inner ring about Z
        scalar beta;  // [1] Axis of the inner ring a = (a_x, gamma, -beta): direction cosine, the sine of a tilt about Y
        scalar gamma;  // [1] Axis of the inner ring: direction cosine, the sine of a tilt about Z
        scalar beta_dot;  // [1/s] Rate of ring.beta
        scalar gamma_dot;  // [1/s] Rate of ring.gamma
        scalar beta_ddot;  // [1/s2] Second derivative of ring.beta
        scalar gamma_ddot;  // [1/s2] Second derivative of ring.gamma
    } ring;
    struct Outputs_housing {
        scalar F_x;  // [N] Force on the housing along X (by balls and cage through the outer ring)
        scalar F_y;  // [N] Force on the housing along Y
        scalar F_z;  // [N] Force on the housing along Z
        scalar M_y;  // [N.m] Moment on the housing about Y, at the outer ring's centre
        scalar M_z;  // [N.m] Moment on the housing about Z, at the outer ring's centre
        scalar M_x;  // [N.m] Moment on the housing about X, at the outer ring's centre
        scalar u_x;  // [m] Displacement of the outer ring along X; on springs from its place at the start
        scalar u_y;  // [m] Displacement of the outer ring along Y; on springs from its place at the start
        scalar u_z;  // [m] Displacement of the outer ring along Z; on springs from its place at the start
        scalar u_tilt_y;  // [rad] Tilt of the outer ring about Y
        scalar u_tilt_z;  // [rad] Tilt of the outer ring about Z
        scalar a_x;  // [m/s2] Acceleration of the outer ring along X: what an accelerometer on the housing measures; at the last step
        scalar a_y;  // [m/s2] Acceleration of the outer ring along Y: what an accelerometer on the housing measures; at the last step
        scalar a_z;  // [m/s2] Acceleration of the outer ring along Z: what an accelerometer on the housing measures; at the last step
        scalar power;  // [W] Power of the housing into balls and cage
    } housing;
    struct Outputs_shaft {
        scalar R_x;  // [N] Force of the bearing's contacts and films on the shaft along X
        scalar R_y;  // [N] Force of the bearing's contacts and films on the shaft along Y
        scalar R_z;  // [N] Force of the bearing's contacts and films on the shaft along Z
        scalar R_My;  // [N.m] Moment of the bearing's contacts and films on the shaft about Y, at the inner ring's centre
        scalar R_Mz;  // [N.m] Moment of the bearing's contacts and films on the shaft about Z, at the inner ring's centre
        scalar power;  // [W] Power of the shaft into balls and cage: by torque, translation and tilting of the inner ring; mean over the communication step
    } shaft;
    struct Outputs_frame {
        scalar power;  // [W] Power of gravity and of the frame's inertia forces into balls and cage
    } frame;
    struct Outputs_ball {
        scalar Q_i[Z];  // [N] Contact load on the inner race
        scalar Q_e[Z];  // [N] Contact load on the outer race
        scalar alpha_i[Z];  // [rad] Contact angle at the inner race (0 without contact)
        scalar alpha_e[Z];  // [rad] Contact angle at the outer race (0 without contact)
        scalar Q_c[Z];  // [N] Contact load on the cage pocket, both halves together; at an instant of a chaotic motion: compare stat.*
        scalar omega_m[Z];  // [rad/s] Orbital speed
        scalar p_i[Z];  // [Pa] Largest contact pressure on the inner race
        scalar p_e[Z];  // [Pa] Largest contact pressure on the outer race
        scalar Lambda_i[Z];  // [1] Film thickness / roughness at the inner race (0 without contact)
        scalar Lambda_e[Z];  // [1] Film thickness / roughness at the outer race (0 without contact)
        scalar spin_roll[Z];  // [1] Spin-to-roll ratio at the inner race
        scalar Q_cx[Z];  // [N] Axial part of the ball's force on the cage pocket, both halves together
        scalar x[Z];  // [m] Axial position of the ball's centre
        scalar r[Z];  // [m] Distance of the ball's centre from the axis
        scalar psi[Z];  // [rad] Azimuth of the ball from Y toward Z, unbounded
    } ball;
    struct Outputs_half_0 {
        scalar x;  // [m] Displacement of the cage half on the -X side along X
        scalar y;  // [m] Displacement of the cage half on the -X side along Y
        scalar z;  // [m] Displacement of the cage half on the -X side along Z
        scalar tilt_y;  // [rad] Tilt of the cage half on the -X side about Y
        scalar tilt_z;  // [rad] Tilt of the cage half on the -X side about Z
        scalar psi;  // [rad] Rotation of the cage half on the -X side about its axis, unbounded: 0 has a pocket on Y
    } half_0;
    struct Outputs_half_1 {
        scalar x;  // [m] Displacement of the cage half on the +X side along X
        scalar y;  // [m] Displacement of the cage half on the +X side along Y
        scalar z;  // [m] Displacement of the cage half on the +X side along Z
        scalar tilt_y;  // [rad] Tilt of the cage half on the +X side about Y
        scalar tilt_z;  // [rad] Tilt of the cage half on the +X side about Z
        scalar psi;  // [rad] Rotation of the cage half on the +X side about its axis, unbounded: 0 has a pocket on Y
    } half_1;
    struct Outputs_cage {
        scalar dislocation;  // [m] Largest slip of one cage half against the other over the joints, in the plane; at an instant of a chaotic motion: compare stat.*
        scalar omega;  // [rad/s] Speed of the cage (mean of the halves)
        scalar slip_ratio;  // [1] 1 - cage speed / epicyclic speed (0 at standstill)
        scalar y;  // [m] Displacement of the cage's centre along Y (mean of the halves)
        scalar z;  // [m] Displacement of the cage's centre along Z (mean of the halves)
        scalar eccentricity;  // [1] Displacement of the cage's centre against the outer ring / radial guide clearance at rest (of a cage guided by balls: pocket clearance)
        scalar F_pocket_max;  // [N] Largest pocket contact load of all balls; at an instant of a chaotic motion: compare stat.*
        scalar F_pocket_peak;  // [N] Largest pocket contact load since the last communication point
    } cage;
    struct Outputs_rivet {
        scalar sigma_head[Z];  // [Pa] Largest principal stress in the head fillet; at an instant of a chaotic motion: compare stat.*
        scalar sigma_mid[Z];  // [Pa] von Mises stress of the shank at the split (|z| <= 0.1 mm); at an instant of a chaotic motion: compare stat.*
        scalar sigma_head_vm[Z];  // [Pa] von Mises stress in the head fillet
        scalar sigma_mid_p1[Z];  // [Pa] Largest principal stress of the shank at the split
        scalar sigma_head_peak[Z];  // [Pa] Largest sigma_head since the last communication point
        scalar sigma_mid_peak[Z];  // [Pa] Largest sigma_mid since the last communication point
        scalar sigma_head_max;  // [Pa] Largest sigma_head_peak of all rivets
        scalar sigma_mid_max;  // [Pa] Largest sigma_mid_peak of all rivets
        scalar table_kind;  // [1] What the rivets' stress table rests on: 1 finite elements, 2 coarse finite elements, 3 closed forms
        scalar damage_head[Z];  // [1] Miner's sum of sigma_head since start.settle
        scalar damage_mid[Z];  // [1] Miner's sum of sigma_mid since start.settle
        scalar broken[Z];  // [1] 0: the rivet holds; 1 broken in the head, 2 in the middle by its damage, 3 by rivet[k].intact = 0
        scalar break_time[Z];  // [s] Time at which the rivet broke by its damage; -1 if it did not
        scalar preload_loss[Z];  // [N] Preload lost by wear of plates and heads since the start (joint.wear)
        scalar N[Z];  // [N] External tension of the joint; at an instant of a chaotic motion: compare stat.*
        scalar V[Z];  // [N] Transverse load of the joint; at an instant of a chaotic motion: compare stat.*
        scalar T[Z];  // [N] Tension of the rivet, with preload and prying; at an instant of a chaotic motion: compare stat.*
        scalar M[Z];  // [N.m] Moment that the joint transmits; at an instant of a chaotic motion: compare stat.*
        scalar P[Z];  // [N] Preload at the present temperature
        scalar slip[Z];  // [m] Slip of one half against the other at the joint, in the plane; at an instant of a chaotic motion: compare stat.*
        scalar flag[Z];  // [1] Sum of 1 rivet yields, 2 flange yields, 8 fit beyond the stress table
        scalar V_y[Z];  // [N] Transverse load that the shank carries, on the +X half, along y of the cage's frame
        scalar V_z[Z];  // [N] Transverse load that the shank carries, on the +X half, along z of the cage's frame
        scalar M_y[Z];  // [N.m] Moment that the joint transmits, on the +X half about y of the cage's frame
        scalar M_z[Z];  // [N.m] Moment that the joint transmits, on the +X half about z of the cage's frame
        scalar F_head[Z];  // [N] Friction force at the heads
        scalar M_shank[Z];  // [N.m] Bending moment of the rivet's shank at the split
        scalar M_shank_y[Z];  // [N.m] Bending moment of the rivet's shank on the +X half about y of the cage's frame
        scalar M_shank_z[Z];  // [N.m] Bending moment of the rivet's shank on the +X half about z of the cage's frame
        scalar flex_0_x[Z];  // [m] Motion of the cage half on the -X side at the rivet along X by its vibration modes, against its rigid motion (0 unless scene.cage = elastic)
        scalar flex_0_r[Z];  // [m] Motion of the cage half on the -X side at the rivet away from the axis by its vibration modes, against its rigid motion (0 unless scene.cage = elastic)
        scalar flex_0_t[Z];  // [m] Motion of the cage half on the -X side at the rivet in the sense of psi by its vibration modes, against its rigid motion (0 unless scene.cage = elastic)
        scalar flex_1_x[Z];  // [m] Motion of the cage half on the +X side at the rivet along X by its vibration modes, against its rigid motion (0 unless scene.cage = elastic)
        scalar flex_1_r[Z];  // [m] Motion of the cage half on the +X side at the rivet away from the axis by its vibration modes, against its rigid motion (0 unless scene.cage = elastic)
        scalar flex_1_t[Z];  // [m] Motion of the cage half on the +X side at the rivet in the sense of psi by its vibration modes, against its rigid motion (0 unless scene.cage = elastic)
    } rivet;
    struct Outputs_loss {
        scalar races;  // [W] Power dissipated in the race contacts
        scalar inlet;  // [W] Part of loss.races: rolling friction of the inlets
        scalar spin;  // [W] Part of loss.races: spin of the balls about the contact normals (sliced traction)
        scalar ball_drag;  // [W] Power dissipated by drag and churning of the balls in the mixture
        scalar cage_drag;  // [W] Power dissipated by the drag of the cage in the mixture
        scalar ring_drag;  // [W] Power that the inner ring dissipates by its friction on the mixture
        scalar land;  // [W] Power dissipated between the lands and the outer ring
        scalar pockets;  // [W] Power dissipated in the pockets
        scalar joints;  // [W] Power dissipated in the joints of the cage
        scalar modes;  // [W] Power dissipated by the vibration of elastic cage halves
    } loss;
    struct Outputs_stat {
        scalar time;  // [s] Time that the statistics cover
        scalar Q_c_mean;  // [N] Pocket force of all balls pooled: mean, zeros included
        scalar Q_c_rms;  // [N] Pocket force of all balls pooled: RMS
        scalar Q_c_p999;  // [N] Pocket force of all balls pooled: 99.9 % quantile
        scalar Q_c_max;  // [N] Pocket force of all balls pooled: largest
        scalar contact_duty;  // [1] Part of the time that a ball presses on its pocket, or on the oil in it
        scalar cage_omega;  // [rad/s] Mean cage speed
        scalar eccentricity;  // [1] Mean eccentricity of the cage
        scalar dislocation_max;  // [m] Largest dislocation of the cage halves
        scalar sigma_head_mean;  // [Pa] Head stress of the worst rivet at each instant: mean
        scalar sigma_head_rms;  // [Pa] Head stress of the worst rivet at each instant: RMS
        scalar sigma_head_p999;  // [Pa] Head stress of the worst rivet at each instant: 99.9 % quantile
        scalar sigma_head_max;  // [Pa] Head stress of the worst rivet at each instant: largest
        scalar sigma_mid_mean;  // [Pa] Middle stress of the worst rivet at each instant: mean
        scalar sigma_mid_rms;  // [Pa] Middle stress of the worst rivet at each instant: RMS
        scalar sigma_mid_p999;  // [Pa] Middle stress of the worst rivet at each instant: 99.9 % quantile
        scalar sigma_mid_max;  // [Pa] Middle stress of the worst rivet at each instant: largest
        scalar rivet_head_mean[Z];  // [Pa] Head stress of each rivet: mean
        scalar rivet_head_rms[Z];  // [Pa] Head stress of each rivet: RMS
        scalar rivet_head_p999[Z];  // [Pa] Head stress of each rivet: 99.9 % quantile
        scalar rivet_head_max[Z];  // [Pa] Head stress of each rivet: largest
        scalar rivet_mid_mean[Z];  // [Pa] Middle stress of each rivet: mean
        scalar rivet_mid_rms[Z];  // [Pa] Middle stress of each rivet: RMS
        scalar rivet_mid_p999[Z];  // [Pa] Middle stress of each rivet: 99.9 % quantile
        scalar rivet_mid_max[Z];  // [Pa] Middle stress of each rivet: largest
    } stat;
    struct Outputs_solver {
        scalar steps;  // [1] Accepted internal steps
        scalar rhs_evals;  // [1] Evaluations of the right-hand side
        scalar step_size;  // [s] Internal step size that the next step starts with
        scalar error_tests_failed;  // [1] Internal steps beyond the error test: rejected, or with solver.method = fixed taken nevertheless
        scalar tolerance;  // [1] Tolerance in force
        scalar method_used;  // [1] Integration method in use: 1 velocity Verlet, 2 Runge-Kutta, 3 velocity Verlet with fixed steps
        scalar cpu_time;  // [s] Processor time of this instance inside fmi2DoStep, from its creation on, with solver.clock = on, else 0 (not part of the saved state)
    } solver;
    struct Outputs_event {
        scalar land_contact;  // [1] Cage halves whose land touches the outer ring
        scalar pocket_exit;  // [1] Balls whose centre has left the section of the cage: a real pocket ends there
        scalar ellipse_cut;  // [1] Race contacts whose ellipse reaches over the shoulder
        scalar overpressure;  // [1] Race contacts beyond bearing.p_limit
        scalar joint_open;  // [1] Joints whose plates are apart
        scalar rivet_yield;  // [1] Rivets whose sigma_head_peak or sigma_mid_peak exceeds the yield stress
        scalar rivet_overload;  // [1] Rivets whose sigma_mid_peak exceeds fatigue.sigma_m
        scalar no_clearance;  // [1] 1 if speed, temperatures and fits leave the bearing no clearance (bearing.clearance < 0)
        scalar rivet_break;  // [1] Rivets that broke by their damage in the last communication step
        scalar step_too_long;  // [1] 1 if the errors of the steps of solver.method = fixed are so large over 10 ms that the results may be wrong
        scalar motion_lag;  // [1] Given motions that jumped or contradicted their velocity and are caught up with over more than the last step
        scalar cage_yield;  // [1] 1 if cage.F_pocket_peak exceeds the force under which a half of a ribbon cage begins to yield
        scalar energy_off;  // [1] 1 if bearing.energy_residual passes 2 % of the energy lost
        scalar land_contact_onsets;  // [1] Onsets of land contact since the start
        scalar pocket_exit_onsets;  // [1] Onsets of a ball leaving its pocket since the start
        scalar ellipse_cut_onsets;  // [1] Onsets of a contact ellipse cut by the shoulder since the start
        scalar overpressure_onsets;  // [1] Onsets of a contact beyond bearing.p_limit since the start
        scalar joint_open_onsets;  // [1] Onsets of an open joint since the start
        scalar rivet_yield_onsets;  // [1] Onsets of yield of a rivet since the start
        scalar rivet_overload_onsets;  // [1] Onsets of event.rivet_overload since the start
        scalar step_too_long_onsets;  // [1] Onsets of steps that are too long since the start
        scalar no_clearance_onsets;  // [1] Onsets of a closed clearance since the start
        scalar rivet_break_onsets;  // [1] Communication steps since the start in which a rivet broke by its damage
        scalar motion_lag_onsets;  // [1] Onsets of catching up with a given motion since the start
        scalar energy_off_onsets;  // [1] Onsets of event.energy_off since the start
        scalar cage_yield_onsets;  // [1] Onsets of yield of a ribbon cage since the start
    } event;
} Outputs;

// What is evaluated together on first read after a step.
typedef enum {
    GROUP_CONSTANT,  // fixed when the FMU is built
    GROUP_STATE,  // states themselves
    GROUP_RING,  // forces and motion of the inner ring, housing reaction
    GROUP_POSE,  // where the balls and the cage halves are
    GROUP_BALL,  // contacts of the balls
    GROUP_CAGE,  // motion of the cage
    GROUP_RIVET,  // loads and slips of the joints
    GROUP_STRESS,  // rivet stress now
    GROUP_PEAK,  // largest values since the last communication point
    GROUP_FATIGUE,  // damage sums
    GROUP_ENERGY,  // power and energy balance
    GROUP_STAT,  // statistics since start.settle
    GROUP_SOLVER,  // solver health
    GROUP_EVENT,  // what happens in the model: now, at how many places; onsets since the start, seen at communication points
    GROUP_COUNT
} OutputGroup;

// The state vector y: offsets of its blocks.
enum {
    Y_BALL_X = 0,  // [Z] [m] Axial position of the ball
    Y_BALL_R = 9,  // [Z] [m] Radial position
    Y_BALL_THETA = 18,  // [Z] [rad] Azimuth from Y toward Z, unbounded
    Y_CAGE_X = 27,  // [2] [m] Position of a half's centre of mass along X
    Y_CAGE_Y = 29,  // [2] [m] along Y
    Y_CAGE_Z = 31,  // [2] [m] along Z
    Y_CAGE_BETA = 33,  // [2] [1] Axis of the half a = (a_x, gamma, -beta): direction cosine
    Y_CAGE_GAMMA = 35,  // [2] [1] Axis of the half: direction cosine
    Y_CAGE_PSI = 37,  // [2] [rad] Rotation of the half about its axis, unbounded
    Y_RING_X = 39,  // [1] [m] Inner ring: position along X
    Y_RING_Y = 40,  // [1] [m] along Y
    Y_RING_Z = 41,  // [1] [m] along Z
    Y_RING_BETA = 42,  // [1] [1] Axis of the ring a = (a_x, gamma, -beta): direction cosine
    Y_RING_GAMMA = 43,  // [1] [1] Axis of the ring: direction cosine
    Y_JOINT_PLATE_Y = 44,  // [Z] [m] Friction state of the plates, y of the cage frame
    Y_JOINT_PLATE_Z = 53,  // [Z] [m] Friction state of the plates, z of the cage frame
    Y_JOINT_HEAD_Y = 62,  // [Z] [m] Friction state of the rivet heads, y of the cage frame
    Y_JOINT_HEAD_Z = 71,  // [Z] [m] Friction state of the rivet heads, z of the cage frame
    Y_WORK = 80,  // [1] [J] Net work done on balls and cage since the start: supplied - dissipated
    Y_BALL_V_X = 81,  // [Z] [m/s] Axial velocity
    Y_BALL_V_R = 90,  // [Z] [m/s] Radial velocity
    Y_BALL_OMEGA_M = 99,  // [Z] [rad/s] Orbital speed
    Y_CAGE_V_X = 108,  // [2] [m/s] Velocity of the half's centre of mass along X
    Y_CAGE_V_Y = 110,  // [2] [m/s] along Y
    Y_CAGE_V_Z = 112,  // [2] [m/s] along Z
    Y_CAGE_BETA_DOT = 114,  // [2] [1/s] Rate of beta
    Y_CAGE_GAMMA_DOT = 116,  // [2] [1/s] Rate of gamma
    Y_CAGE_S = 118,  // [2] [rad/s] Spin: angular velocity along the half's axis
    Y_RING_V_X = 120,  // [1] [m/s] Inner ring: velocity along X
    Y_RING_V_Y = 121,  // [1] [m/s] along Y
    Y_RING_V_Z = 122,  // [1] [m/s] along Z
    Y_RING_BETA_DOT = 123,  // [1] [1/s] Rate of beta
    Y_RING_GAMMA_DOT = 124,  // [1] [1/s] Rate of gamma
    Y_BALL_OMEGA_X = 125,  // [Z] [rad/s] Angular velocity about X
    Y_BALL_OMEGA_R = 134,  // [Z] [rad/s] Angular velocity about the radial direction of the ball
    Y_BALL_OMEGA_T = 143,  // [Z] [rad/s] Angular velocity about the tangential direction of the ball
    N_STATES = 152,
    N_STATE_BLOCKS = 36,
    Y_MODE_S = 152,  // [40] [m] Mirrored motion of the halves: modal coordinates
    Y_MODE_D = 192,  // [40] [m] Opposed motion of the halves: modal coordinates
    Y_MODE_S_DOT = 232,  // [40] [m/s] Their rates, mirrored
    Y_MODE_D_DOT = 272,  // [40] [m/s] and opposed
    N_ALL_STATES = 312,  // with those of elastic cage halves
    N_ALL_BLOCKS = 40
};

typedef enum {
    SCALE_LENGTH,
    SCALE_ANGLE,
    SCALE_TILT,
    SCALE_PLATE,
    SCALE_HEAD,
    SCALE_ENERGY,
    SCALE_VELOCITY,
    SCALE_NORMAL,
    SCALE_ORBIT,
    SCALE_RATE,
    SCALE_SPIN,
    SCALE_MODE,
    SCALE_COUNT
} StateScale;

enum { N_INPUTS = 39 };  // all of them numbers
enum { N_VARIABLES = 411 };  // time is the first
