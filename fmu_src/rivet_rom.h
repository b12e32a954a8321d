// Rivet stress and joint data from the reduced rivet model: one table, read here and in bearing_model/rivet_rom.py.
//
//      N ^  | M        +x half: force V, moment M, pull N from outside,
//     ___|__|_____     -x half: the opposite
//    |   |     ___|--> V
//    |   |rivet   |
//    |-- | -------|    split plane, x = 0, where V and M are taken
//    |___|________|
//
// The frictionless joint (elastic bodies, unilateral contacts, gaps proportional to the fit) answers homogeneously of degree 1 in
// (P, N, V, M, fit), so one argument divides out:
//
//     sigma = s (w T_i(a, b, c, xi) + (1 - w) T_(i+1)(a, b, c, xi)),      s = P + N + V + |M|/L,   L = moment_length of the table
//     a = V/(P + N + V),  b = N/(P + N),  c = |M|/(L s),  xi = fit_eff/s
//     chi = |V_y M_z - V_z M_y|/(V |M|): 1 if M bends in the plane of V, 0 if across it
//     i: sheets T of chi = 1 (plane), 1/2 (oblique), 0 (across), the two around chi;  w = 2 chi - 1 above 1/2, below it 2 chi in the head,
//     (2 chi)^1.5 in the middle: the measured rule between the sheets, within 0.4 % and 1.3 % of the largest clearance stress
//
// The channels are the largest stress over both heads and all angles.  A half turn and the mirror of the halves change the sign of M against
// V, so the sign only says which head carries more, and the channel does not depend on it.
// a, b, c lie in [0, 1] for every load, so no load lies outside the table.  xi: constant below its axis (contact in the hole is
// saturated: the size of the gap no longer matters), linear above (every contact of the hole closed).  T is a tensor product of
// quadratic B-splines, C1 in each argument; sigma is C0 where V, N + P or M passes through 0
// and where chi passes through 0 or 1/2.  Head friction adds head_friction F_head to
// the head channels and nothing in the middle.
#pragma once

#include "lanes.h"

#include <stdbool.h>

// Loads of one rivet [N, N.m]; y, z: two perpendicular directions in the plane of the joint, x, y, z right-handed.
typedef struct {
    scalar P;         // preload
    scalar N;         // external tension of the joint, before preload shielding; negative (compression) counts as 0
    scalar V_y, V_z;  // transverse load that the rivet carries, on the +x half
    scalar M_y, M_z;  // prying moment about the rivet's place in the split plane, on the +x half
    scalar F_head;    // modulus of the friction force at the heads
} RivetLoad;

// The loads of all rivets side by side.
typedef struct {
    ball_array P, N, V_y, V_z, M_y, M_z, F_head;
    ball_array V;  // modulus of the joint's whole transverse load, of which the rivet carries V_y, V_z [N]
} RivetLoads;

INLINE RivetLoad rivet_load_of(const RivetLoads *all, int k)
{
    return (RivetLoad){all->P[k], all->N[k], all->V_y[k], all->V_z[k], all->M_y[k], all->M_z[k], all->F_head[k]};
}

enum { HEAD_P1, HEAD_VM, MID_VM, MID_P1, RIVET_CHANNELS };  // largest principal (P1) and von Mises (VM) stress in head fillet and middle

enum {
    RIVET_YIELDS = 1,      // a von Mises channel exceeds the rivet's yield stress
    FLANGE_YIELDS = 2,     // the fit exceeds the one at which the flange begins to yield
    JOINT_COMPRESSED = 4,  // N < 0 counted as 0
    RIVET_OUTSIDE = 8      // the fit exceeds the largest one of fit_eff's map, or a load is not finite
};

enum { RIVET_A, RIVET_B, RIVET_C, RIVET_XI, RIVET_AXES };
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
    double k_rivet;       // axial stiffness of the open joint: rivet, heads and flanges in series [N/m]
    double k_plate;       // what the closed split plane adds to it [N/m]
    double k_t_plate;     // tangential stiffness of the split plane before it slips [N/m]
    double k_t_head;      // of the two heads in series, through the rivet [N/m]
    double k_stack;       // preload per change of length of the rivet against the flanges [N/m]
    double alpha_rivet;   // thermal expansion [1/K]
    double alpha_flange;  // [1/K]
    double d;             // shank diameter [m]
    double T_0;           // temperature at which preload and fit are given [K]
    double prying_lever;  // moment at which the joint opens per clamp force P - N [m]
    double prying_share;  // part of a further moment that the open joint still takes, 0...1
    int hole_count;       // hole contact: tangent stiffness k_hole [N/m] of both holes in series over fit_a [m]
    const double *hole_fit, *k_hole;
} JointData;

typedef struct {
    const char *kind;           // "closed_form" or "fe"
    const char *geometry_hash;  // of the rivet, flanges and cage that it was computed for
    const char *digest;         // of this table (SHA-256): its numbers decide over results
    int Z;
    double moment_length;  // L [m]
    RivetAxis axis[RIVET_AXES];
    const float *primary;     // spline coefficients [a][b][c][xi][sheet][HEAD_P1, MID_VM], in 1/m2
    const float *secondary;   // the same of [HEAD_VM, MID_P1], which only outputs ask for
    double head_friction;     // [1/m2]
    double head_friction_vm;  // [1/m2]
    double yield_rivet;       // [Pa]
    double fit_flange_yield;  // fit at which the flange begins to yield [m]
    FitMap j2;                // interference with plasticity
    JointData joint;
    const double *load_path;  // see load_path_flexible
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
