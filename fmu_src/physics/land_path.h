// Loads of bonded joints: their rows, and those by the load on a rim at the place of the land.  Equations in half_path.h.
#pragma once

#include "variables.h"

enum { ROW_N, ROW_V_R, ROW_V_T, ROW_M_R, ROW_M_T, ROW_DP, ROW_DM_R, ROW_DM_T, ROWS };

enum { LAND_HARMONICS = (3 * Z - 1) / 2 + 1, LAND_WAVES = Z / 2 + 1, LAND_EACH = 3 };  // of a wave

// Rows of the table at one place of the land; 0 for a repeated harmonic.
typedef struct {
    // even rows by loads on both halves, by loads that oppose each other; odd ones likewise
    double row[LAND_WAVES][LAND_EACH][4][ROWS];
    double wave[LAND_WAVES][2][Z];  // cos and sin of n theta_k
} LandPath;

// The harmonic p of wave n, number `each` of LAND_EACH, with its sign.
static inline int land_harmonic(int n, int each)
{
    const int p = each == 0 ? n : each == 1 ? n - Z : n + Z;
    return 2 * (p < 0 ? -p : p) < 3 * Z ? p : n;
}
