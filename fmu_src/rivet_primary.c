// Peak channels of all rivets at once: of what rivet_rom_stress does for one of them (rivet_rom.c), up to rounding.
//
// Rivets side by side find their places in the table, the two channels on two sheets side by side their sums.
#include "rivet_primary.h"

#include "rivet_splines.h"

typedef struct {
    lanes u[RIVET_AXES], cell[RIVET_AXES];  // a, b, c, xi and their cells
    lanes s, first[2], plane;               // weights of the first of two sheets in head and middle; 1: plane and oblique, 0: oblique and across
} Places;

INLINE real ratio(real part, real whole)
{
    return real_select(real_above(whole, 0.0), part / whole, real_set(0.0));
}

// Stores the coordinate of one axis and its cell, the number of inner knots below it.
INLINE void find_cell(const RivetTable *t, int axis, int j, real u, Places *places)
{
    const RivetAxis *along = &t->axis[axis];
    const real zero = real_set(0.0), one = real_set(1.0);
    real cell = zero;
    for (int i = 1; i < along->cells; i++) cell += real_select(real_above(u, along->knot[i]), one, zero);
    real_store(&places->u[axis][j], u);
    real_store(&places->cell[axis][j], cell);
}

static void find_places(const RivetTable *t, const RivetLoads *load, double fit_eff, Places *places)
{
    const real zero = real_set(0.0), one = real_set(1.0);
    for (int j = 0; j < BUNDLES * LANE_WIDTH; j += LANE_WIDTH) {
        const real v_y = real_load(&load->V_y[j]), v_z = real_load(&load->V_z[j]), m_y = real_load(&load->M_y[j]), m_z = real_load(&load->M_z[j]);
        const real p = real_max(real_load(&load->P[j]), zero), n = real_max(real_load(&load->N[j]), zero);
        const real V = real_sqrt(v_y * v_y + v_z * v_z), M = real_sqrt(m_y * m_y + m_z * m_z);
        const real axial = p + n, force = axial + V, moment = M / t->moment_length, s = force + moment, across = v_y * m_z - v_z * m_y;
        const real w = 2.0 * real_min(ratio(real_max(across, -across), V * M), one);
        const bits plane = real_above(w, 1.0);
        find_cell(t, RIVET_A, j, ratio(V, force), places);
        find_cell(t, RIVET_B, j, ratio(n, axial), places);
        find_cell(t, RIVET_C, j, ratio(moment, s), places);
        find_cell(t, RIVET_XI, j, ratio(real_set(fit_eff), s), places);
        real_store(&places->s[j], s);
        real_store(&places->first[0][j], real_select(plane, w - 1.0, w));
        real_store(&places->first[1][j], real_select(plane, w - 1.0, w * real_sqrt(w)));
        real_store(&places->plane[j], real_select(plane, one, zero));
    }
}

void rivet_primary(const RivetTable *t, const RivetLoads *load, double fit_eff, double head_p1[Z], double mid_vm[Z])
{
    Places places;
    find_places(t, load, fit_eff, &places);
    for (int k = 0; k < Z; k++) {
        Place place = {.sheet = places.plane[k] != 0.0 ? RIVET_PLANE : RIVET_OBLIQUE, .first = {places.first[0][k], places.first[1][k]}};
        for (int i = RIVET_A; i <= RIVET_C; i++) place.at[i] = axis_splines(&t->axis[i], (int)places.cell[i][k], places.u[i][k]);
        place.at[RIVET_XI] = axis_splines_xi(&t->axis[RIVET_XI], (int)places.cell[RIVET_XI][k], places.u[RIVET_XI][k], places.s[k], fit_eff);
        double sigma[2];
        contract(t, t->primary, &place, sigma);
        head_p1[k] = sigma[0] + t->head_friction * load->F_head[k];
        mid_vm[k] = sigma[1];
    }
}
