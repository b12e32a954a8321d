// Peak channels of all rivets at once: of what rivet_rom_stress does for one of them (rivet_rom.c), up to rounding.
//
// Rivets side by side find their points in the table, the two channels on two sheets side by side their sums.
#include "rivet_primary.h"

#include "rivet_splines.h"

typedef struct {
    ball_array u[RIVET_AXES];     // a, c, xi
    ball_array s, first[2], chi;  // weights of the first of two sheets in head and middle; 2 chi
} TablePoints;

INLINE wide ratio(wide part, wide whole)
{
    return wide_select(wide_above(whole, 1e-300), part / whole, wide_set(0.0));  // 1/whole is finite
}

static void find_points(const RivetTable *t, const JointLoads *load, double fit_eff, TablePoints *points)
{
    const wide zero = wide_set(0.0), one = wide_set(1.0);
    for (int j = 0; j < PACKETS * LANE_WIDTH; j += LANE_WIDTH) {
        const wide v_r = wide_load(&load->V_r[j]), v_t = wide_load(&load->V_t[j]), m_r = wide_load(&load->m_r[j]), m_t = wide_load(&load->m_t[j]);
        const wide T = wide_max(wide_load(&load->T[j]), zero), V = wide_sqrt(v_r * v_r + v_t * v_t), m = wide_sqrt(m_r * m_r + m_t * m_t);
        const wide s = T + V, inv_s = ratio(one, s), across = v_r * m_t - v_t * m_r;
        const wide w = 2.0 * wide_min(ratio(wide_max(across, -across), V * m), one);
        const bits plane = wide_above(w, 1.0);
        wide_store(&points->u[RIVET_A][j], V * inv_s);
        wide_store(&points->u[RIVET_C][j], wide_min(ratio(m, t->moment_length * T), one));
        wide_store(&points->u[RIVET_XI][j], fit_eff * inv_s);
        wide_store(&points->s[j], s);
        wide_store(&points->first[0][j], wide_select(plane, w - 1.0, w));
        wide_store(&points->first[1][j], wide_select(plane, w - 1.0, w * wide_sqrt(w)));
        wide_store(&points->chi[j], w);
    }
}

void rivet_primary(const RivetTable *t, const JointLoads *load, double fit_eff, double head_p1[Z], double mid_vm[Z])
{
    TablePoints points;
    find_points(t, load, fit_eff, &points);
    for (int k = 0; k < Z; k++) {
        TablePoint point;  // without an initialiser, which would clear all of it first
        point.sheet = points.chi[k] > 1.0 ? RIVET_PLANE : RIVET_OBLIQUE;
        for (int i = 0; i < 2; i++) point.first[i] = points.first[i][k];
        for (int i = RIVET_A; i <= RIVET_C; i++) point.at[i] = axis_splines(&t->axis[i], points.u[i][k]);
        point.at[RIVET_XI] = axis_splines_xi(&t->axis[RIVET_XI], points.u[RIVET_XI][k], points.s[k], fit_eff);
        double sigma[2];
        contract(t, t->primary, &point, sigma);
        head_p1[k] = sigma[0] + t->head_friction * load->F_head[k];
        mid_vm[k] = sigma[1];
    }
}
