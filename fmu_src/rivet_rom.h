// Rivet stress and joint data from the reduced rivet model: one table, read here and in bearing_model/rivet_rom.py.
//
//      T ^  | m        +x half: the shank carries tension T, transverse load V, bending moment m
//     ___|__|_____     -x half: the opposite
//    |   |     ___|--> V
//    |   |rivet   |
//    |-- | -------|    split plane, x = 0, where V and m are taken
//    |___|________|
//
// The frictionless rivet in its holes (elastic bodies, unilateral contacts, gaps proportional to the fit) answers homogeneously of degree 1 in
// (T, V, m, fit), so one argument divides out:
//
//     sigma = s (w S_i(a, c, xi) + (1 - w) S_(i+1)(a, c, xi)),      s = T + V
//     a = V/s,  c = |m|/(L T) at most 1,  xi = fit_eff/s,  L = moment_length of the table
//     chi = |V_y m_z - V_z m_y|/(V |m|): 1 if m bends in the plane of V, 0 if across it
//     i: sheets S of chi = 1 (plane), 1/2 (oblique), 0 (across), the two around chi;  w = 2 chi - 1 above 1/2, below it 2 chi in the head,
//     (2 chi)^1.5 in the middle: the measured rule between the sheets, within 0.4 % and 1.3 % of the largest clearance stress
//
// The channels are the largest stress over both heads and all angles.  A half turn and the mirror of the halves change the sign of m against
// V, so the sign only says which head carries more, and the channel does not depend on it.
// xi: constant below its axis (contact in the hole is saturated: the size of the gap no longer matters), linear above (every contact of the
// hole closed).  S is a tensor product of quadratic B-splines, C1 in each argument; sigma is C0 where V, T or m passes through 0
// and where chi passes through 0 or 1/2.  Head friction adds head_friction F_head to the head channels and nothing in the middle.
#pragma once

#include "half_path.h"
#include "joint_law.h"
#include "lanes.h"

#include <stdbool.h>

// What one rivet carries [N, N.m]; y, z: two perpendicular directions in the plane of the joint, x, y, z right-handed.
typedef struct {
    scalar T;         // tension
    scalar V_y, V_z;  // transverse load of the shank, on the +x half
    scalar m_y, m_z;  // bending moment of the shank in the split plane, on the +x half
    scalar F_head;    // modulus of the friction force at the heads
} RivetLoad;

// The loads of all joints side by side, on the +x half in the frames (x, r, t) of the rivets.
typedef struct {
    ball_array N, M_r, M_t;       // external tension of the joint, moment that it transmits [N, N.m]
    ball_array V;                 // modulus of its whole transverse load [N]
    ball_array T, m_r, m_t;       // rivet: tension with preload and prying, bending of its shank
    ball_array V_r, V_t, F_head;  // transverse load of its shank, modulus of the friction at its heads
} JointLoads;

INLINE RivetLoad rivet_load_of(const JointLoads *all, int k)
{
    return (RivetLoad){all->T[k], all->V_r[k], all->V_t[k], all->m_r[k], all->m_t[k], all->F_head[k]};
}

enum { HEAD_P1, HEAD_VM, MID_VM, MID_P1, RIVET_CHANNELS };  // largest principal (P1) and von Mises (VM) stress in head fillet and middle

enum {
    RIVET_YIELDS = 1,   // a von Mises channel exceeds the rivet's yield stress
    FLANGE_YIELDS = 2,  // the fit exceeds the one at which the flange begins to yield
    RIVET_OUTSIDE = 8   // the fit exceeds the largest one of fit_eff's map, or a load is not finite; 4 meant a compressed joint
};

enum { RIVET_A, RIVET_C, RIVET_XI, RIVET_AXES };
enum { RIVET_PLANE, RIVET_OBLIQUE, RIVET_ACROSS, RIVET_SHEETS };

// One cell between knots t_i and t_(i+1), with the constants of its three splines
//   rise = 1/((t_(i+2) - t_i) (t_(i+1) - t_i)),  fall = 1/((t_(i+1) - t_(i-1)) (t_(i+1) - t_i)).
typedef struct {
    double start, end, rise, fall;
} RivetCell;

// One axis with clamped knots: `cells` cells, `cells` + 2 coefficients.  In RIVET_BINS equal bins: the cell in which each begins.
enum { RIVET_BINS = 256 };
typedef struct {
    int cells;
    double start, end, inv_bin;  // inv_bin = RIVET_BINS/(end - start)
    const RivetCell *cell;
    const unsigned char *bin;  // RIVET_BINS + 1
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
    double k_rivet;       // force per separation of the halves' bodies: of the open joint [N/m]
    double k_plate;       // what the closed split plane adds to it [N/m]
    double k_t_plate;     // tangential stiffness of the split plane before it slips [N/m]
    double k_t_head;      // of the two heads in series, through the rivet [N/m]
    double k_stack;       // preload per change of length of the rivet against the flanges [N/m]
    double alpha_rivet;   // thermal expansion [1/K]
    double alpha_flange;  // [1/K]
    double d;             // shank diameter [m]
    double T_0;           // temperature at which preload and fit are given [K]
    int hole_count;       // hole contact: tangent stiffness k_hole [N/m] of both holes in series over fit_a [m]
    const double *hole_fit, *k_hole;
} JointData;

// One half of the cage, with its half of the rivets, in SI.
typedef struct {
    double m;  // mass [kg]
    HalfPath path;
    double spin[ROWS];  // rows of all joints under the centrifugal load of both halves, per (rad/s)^2, at this mass
    JointLaw law;
} CageHalfData;

typedef struct {
    const char *kind;           // "closed_form" or "fe"
    const char *geometry_hash;  // of the rivet, flanges and cage that it was computed for
    const char *digest;         // of this table (SHA-256): its numbers decide over results
    int Z;
    double moment_length;  // L [m]
    RivetAxis axis[RIVET_AXES];
    const float *primary;     // spline coefficients [a][c][xi][sheet][HEAD_P1, MID_VM], in 1/m2
    const float *secondary;   // the same of [HEAD_VM, MID_P1], which only outputs ask for
    double head_friction;     // [1/m2]
    double head_friction_vm;  // [1/m2]
    double yield_rivet;       // [Pa]
    double fit_flange_yield;  // fit at which the flange begins to yield [m]
    FitMap j2;                // interference with plasticity
    JointData joint;
    CageHalfData half;
} RivetTable;

extern const RivetTable rivet_table;  // rivet_table.c, written by rivet_model/embed.py

// Effective fit [m]: fit_a itself, or with j2 the elastic fit that leaves the pressure of the yielded flange.
double rivet_rom_fit_eff(const RivetTable *t, double fit_a, bool j2);

// Flags of the fit alone.
unsigned rivet_rom_fit_flags(const RivetTable *t, double fit_a);

// All channels sigma [Pa]; returns the load's flags.  Never NaN for finite loads.
unsigned rivet_rom_stress(const RivetTable *t, const RivetLoad *load, double fit_eff, scalar sigma[RIVET_CHANNELS]);

double joint_preload(const JointData *j, double preload, double T);  // preload at temperature T [N], not below 0
double joint_fit(const JointData *j, double fit, double T);          // fit at temperature T [m]
double joint_hole_stiffness(const JointData *j, double fit_a);       // [N/m], constant outside its table
