// Peak channels of all rivets at once: of what rivet_rom_stress does for one of them (rivet_rom.c), up to rounding.
//
// Rivets side by side find their places in the table, the two channels on two sheets side by side their sums.
#include "rivet_primary.h"

#include "rivet_splines.h"

typedef struct {
    lanes u[RIVET_AXES];     // a, b, c, xi
    lanes s, first[2], chi;  // weights of the first of two sheets in head and middle; 2 chi
} Places;

INLINE real ratio(real part, real whole)
{
    return real_select(real_above(whole, 1e-300), part / whole, real_set(0.0));  // 1/whole is finite
}

static void find_places(const RivetTable *t, const RivetLoads *load, double fit_eff, Places *places)
{
    const real zero = real_set(0.0), one = real_set(1.0), per_length = real_set(1.0 / t->moment_length);
    for (int j = 0; j < BUNDLES * LANE_WIDTH; j += LANE_WIDTH) {
        const real v_y = real_load(&load->V_y[j]), v_z = real_load(&load->V_z[j]), m_y = real_load(&load->M_y[j]), m_z = real_load(&load->M_z[j]);
        const real p = real_max(real_load(&load->P[j]), zero), n = real_max(real_load(&load->N[j]), zero);
        const real V = real_sqrt(v_y * v_y + v_z * v_z), M = real_sqrt(m_y * m_y + m_z * m_z);
        const real axial = p + n, force = axial + V, moment = M * per_length, s = force + moment, per_s = ratio(one, s), across = v_y * m_z - v_z * m_y;
        const real w = 2.0 * real_min(ratio(real_max(across, -across), V * M), one);
        const bits plane = real_above(w, 1.0);
        real_store(&places->u[RIVET_A][j], ratio(V, force));
        real_store(&places->u[RIVET_B][j], ratio(n, axial));
        real_store(&places->u[RIVET_C][j], moment * per_s);
        real_store(&places->u[RIVET_XI][j], fit_eff * per_s);
        real_store(&places->s[j], s);
        real_store(&places->first[0][j], real_select(plane, w - 1.0, w));
        real_store(&places->first[1][j], real_select(plane, w - 1.0, w * real_sqrt(w)));
        real_store(&places->chi[j], w);
    }
}

void rivet_primary(const RivetTable *t, const RivetLoads *load, double fit_eff, double head_p1[Z], double mid_vm[Z])
{
    Places places;
    find_places(t, load, fit_eff, &places);
    for (int k = 0; k < Z; k++) {
        Place place;  // without an initialiser, which would clear all of it first
        place.sheet = places.chi[k] > 1.0 ? RIVET_PLANE : RIVET_OBLIQUE;
        for (int i = 0; i < 2; i++) place.first[i] = places.first[i][k];
        for (int i = RIVET_A; i <= RIVET_C; i++) place.at[i] = axis_splines(&t->axis[i], places.u[i][k]);
        place.at[RIVET_XI] = axis_splines_xi(&t->axis[RIVET_XI], places.u[RIVET_XI][k], places.s[k], fit_eff);
        double sigma[2];
        contract(t, t->primary, &place, sigma);
        head_p1[k] = sigma[0] + t->head_friction * load->F_head[k];
        mid_vm[k] = sigma[1];
    }
}
