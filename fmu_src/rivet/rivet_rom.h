// Rivet stress and joint data from the table of the reduced rivet model; bearing_model/rivet/rivet_rom.py reads the
// same table.
//
//      T ^  | m        +x half: the shank carries tension T, transverse load V, bending moment m
//     ___|__|_____     -x half: the opposite
//    |   |     ___|--> V
//    |   |rivet   |
//    |-- | -------|    split plane, x = 0, where V and m are taken
//    |___|________|
//
// The stress of a frictionless rivet in its holes (elastic bodies, unilateral contacts, gaps proportional to the
// fit) is homogeneous of degree 1 in (T, V, m, fit), so that one argument divides out:
//
//     sigma = s (w S_i(a, c, xi) + (1 - w) S_(i+1)(a, c, xi)),      s = T + V
//     a = V/s,  c = |m|/(L T), at most 1,  xi = fit_eff/s,  L = moment_length
//     chi = |V_r m_t - V_t m_r|/(V |m|): 1 if m bends in the plane of V, 0 if across it
//     S_i, S_(i+1): the two sheets around chi, of those for chi = 1 (plane), 1/2 (oblique) and 0 (across)
//     w = 2 chi - 1 above chi = 1/2;  below it 2 chi in the head and (2 chi)^1.5 in the middle
//
// The rule between the sheets was found by finite elements and is within 0.4 % (head) and 1.3 % (middle) of
// the largest stress in clearance.
//
// The channels are the largest stress over both heads and all angles.  A half turn and the mirror of the
// halves change the sign of m against V: the sign decides which head carries more, and the channels do not
// depend on it.
//
// a and c lie in [0, 1] for every load.  Below the axis of xi the stress does not depend on xi (the gap is so
// large that its size does not matter any more); above it the stress is linear in xi (every contact of the
// hole is closed).  S is a tensor product of quadratic B-splines, C1 in each argument; sigma is C0 where V, T
// or m passes through 0, where c reaches 1 and where chi passes through 0 or 1/2.  Head friction adds
// head_friction F_head to the head channels and nothing in the middle.
#pragma once

#include "cage/common/joint_law.h"
#include "cage/elastic/half_modes.h"
#include "cage/two_half/half_path.h"

// Loads of all joints and of their rivets [N, N.m], on the +x half in the frames (x, r, t) of the rivets.
typedef struct {
    ball_array N;         // external tension of the joint
    ball_array M_r, M_t;  // moment that the joint transmits
    ball_array V;         // modulus of the joint's whole transverse load
    ball_array T;         // tension of the rivet, with preload and prying
    ball_array m_r, m_t;  // bending moment of the rivet's shank at the split
    ball_array V_r, V_t;  // transverse load of the shank
    ball_array F_head;    // modulus of the friction force at the heads
} JointLoads;

// Channels: largest principal (P1) and von Mises (VM) stress in the head fillet and in the middle of the
// shank.
enum { HEAD_P1, HEAD_VM, MID_VM, MID_P1, RIVET_CHANNELS };

// 4 is retired.
enum {
    RIVET_YIELDS = 1,   // a von Mises channel exceeds the rivet's yield stress
    FLANGE_YIELDS = 2,  // the fit exceeds the one at which the flange begins to yield
    RIVET_OUTSIDE = 8   // the fit exceeds the largest one of fit_eff's map, or a load is not finite
};

enum { RIVET_A, RIVET_C, RIVET_XI, RIVET_AXES };

enum { RIVET_PLANE, RIVET_OBLIQUE, RIVET_ACROSS, RIVET_SHEETS };

// One cell between knots t_i and t_(i+1), with the constants of its three splines
//   rise = 1/((t_(i+2) - t_i) (t_(i+1) - t_i)),  fall = 1/((t_(i+1) - t_(i-1)) (t_(i+1) - t_i)).
typedef struct {
    double start, end, rise, fall;
} RivetCell;

// One axis with clamped knots: `cells` cells, `cells` + 2 coefficients.  For a quick search the axis is
// divided into RIVET_BINS equal bins, and `bin` holds the cell in which each of these begins.
enum { RIVET_BINS = 256 };

typedef struct {
    int cells;
    double start, end, inv_bin;  // inv_bin = RIVET_BINS/(end - start)
    const RivetCell *cell;
    const unsigned char *bin;  // [RIVET_BINS + 1]
} RivetAxis;

// Monotone map fit_a -> fit_eff: piecewise cubic Hermite with given slopes, continued linearly.
typedef struct {
    int count;
    const double *fit_a, *fit_eff, *slope;  // [m, m, 1]
} FitMap;

// One rivet joint for the dynamics, in SI.
typedef struct {
    double A;             // shank section [m2]
    double d_m;           // diameter of the circle of rivets [m]
    double grip;          // clamped length [m]
    double seat;          // diameter of the seat of the rivet's head [m]
    double k_rivet;       // force per separation of the halves' bodies, joint open [N/m]
    double k_plate;       // axial stiffness that the closed split plane adds [N/m]
    double k_t_plate;     // tangential stiffness of the split plane before it slips [N/m]
    double k_t_head;      // tangential stiffness of the two heads in series, through the rivet [N/m]
    double k_stack;       // preload per change of length of the rivet against the flanges [N/m]
    double alpha_rivet;   // thermal expansion [1/K]
    double alpha_flange;  // [1/K]
    double d;             // shank diameter [m]
    double T_0;           // temperature at which preload and fit are given [K]
    // hole contact: tangent stiffness k_hole [N/m] of both holes in series at hole_count fits [m]
    int hole_count;
    const double *hole_fit, *k_hole;
} JointData;

// One half of the cage, with its half of the rivets, in SI.
typedef struct {
    double m;    // mass [kg]
    double x_c;  // axial distance of the centre of mass from the split [m]
    HalfPath path;
    double spin[ROWS];  // rows of all joints under the centrifugal load, per (rad/s)^2, at this mass
    int spin_steps;     // of a ribbon: S at equal steps of tau (spin_preload.h); 0: none
    const double *spin_preload;
    double
        yield_force;  // of a ribbon: force of a ball on its pocket under which it begins to yield [N]; else 0
    const double *land;  // [LAND_WAVES][LAND_EACH][1 and x][ROWS] by a load on the rim (half_path.h)
    double growth[2];    // of its radius at the land x per (rad/s)^2, at this mass: by 1 [m.s2] and by x [s2]
    JointLaw law;
} CageHalfData;

typedef struct {
    int kind;            // 1 finite elements, 2 coarse finite elements, 3 closed forms
    const char *digest;  // SHA-256 of this table
    int Z;
    double moment_length;  // L [m]
    RivetAxis axis[RIVET_AXES];
    const float *primary;     // spline coefficients [a][c][xi][sheet][HEAD_P1, MID_VM], in 1/m2
    const float *secondary;   // the same of [HEAD_VM, MID_P1], which only outputs need
    double head_friction;     // [1/m2]
    double head_friction_vm;  // [1/m2]
    double yield_rivet;       // [Pa]
    double fit_flange_yield;  // fit at which the flange begins to yield [m]
    FitMap j2;                // interference with plasticity
    JointData joint;
    CageHalfData half;
    HalfModes modes;
} RivetTable;

extern const RivetTable rivet_table;  // rivet_table.c, written by rivet_model/embed.py

// Factor of the centrifugal loads of the half's rows and modes: its mass over that of the table, 0 without the load.
static inline double cage_centrifugal(const Parameters *p)
{
    return p->cage.centrifugal == SWITCH_ON ? p->cage.m / rivet_table.half.m : 0.0;
}

// Effective fit [m]: fit_a itself, or with j2 the elastic fit that gives the same pressure as the yielded
// flange.
double rivet_rom_fit_eff(const RivetTable *t, double fit_a, bool j2);

// Flags that follow from the fit alone: FLANGE_YIELDS, RIVET_OUTSIDE.
unsigned rivet_rom_fit_flags(const RivetTable *t, double fit_a);

// Sets the channels sigma of all rivets [Pa]: HEAD_P1 and MID_VM, and with `all` the other two as well.
// Finite loads give finite stresses.
typedef void RivetRomStress(const RivetTable *t, const JointLoads *load, const constants fit_eff, bool all,
                            scalar sigma[RIVET_CHANNELS][Z]);
RivetRomStress rivet_rom_stress;

// Flags that follow from the load of rivet k and its channels sigma.
INLINE unsigned rivet_rom_load_flags(const RivetTable *t, scalar sigma[RIVET_CHANNELS][Z], int k)
{
    const double head = scalar_value(sigma[HEAD_VM][k]), mid = scalar_value(sigma[MID_VM][k]);
    unsigned flags = 0;
    if (head > t->yield_rivet || mid > t->yield_rivet) flags |= RIVET_YIELDS;
    if (!isfinite(scalar_value(sigma[HEAD_P1][k]))) flags |= RIVET_OUTSIDE;
    return flags;
}

// Preload [N], not below 0, and fit [m] at temperature T; hole stiffness [N/m], constant outside its table.
double joint_preload(const JointData *j, double preload, double T);
double joint_fit(const JointData *j, double fit, double T);
double joint_hole_stiffness(const JointData *j, double fit_a);
