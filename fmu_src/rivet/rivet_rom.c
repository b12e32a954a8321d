// Rivet stress from the reduced model: see rivet_rom.h for the equations.
//
// The points of the loads in the table are computed for a packet of rivets at once.  Then the splines of each
// rivet are summed for a pair of channels and two sheets side by side.
#include "rivet/rivet_rom.h"

#include "rivet/rivet_splines.h"

typedef struct {
    ball_array u[RIVET_AXES];  // a, c, xi
    ball_array s;              // T + V [N]
    ball_array first[2];       // weight of the first of two sheets in head and middle
    ball_array two_chi;        // 2 chi
} TablePoints;

// Points of the loads of all rivets in the table.
static void find_points(const RivetTable *t, const JointLoads *load, const constants fit_eff,
                        TablePoints *points)
{
    const wide zero = wide_set(0.0), one = wide_set(1.0);
    for (int j = 0; j < PACKETS * LANE_WIDTH; j += LANE_WIDTH) {
        const wide v_r = wide_load(&load->V_r[j]), v_t = wide_load(&load->V_t[j]);
        const wide m_r = wide_load(&load->m_r[j]), m_t = wide_load(&load->m_t[j]);
        const wide T = wide_max(wide_load(&load->T[j]), zero), V = wide_hypot(v_r, v_t),
                   m = wide_hypot(m_r, m_t);
        const wide s = T + V, inv_s = wide_ratio(one, s), across = v_r * m_t - v_t * m_r;
        const wide w = 2.0 * wide_min(wide_ratio(wide_max(across, -across), V * m), one);
        const bits plane = wide_above(w, 1.0);
        wide_store(&points->u[RIVET_A][j], V * inv_s);
        wide_store(&points->u[RIVET_C][j], wide_min(wide_ratio(m, t->moment_length * T), one));
        wide_store(&points->u[RIVET_XI][j], wide_load(&fit_eff[j]) * inv_s);
        wide_store(&points->s[j], s);
        wide_store(&points->first[0][j], wide_select(plane, w - 1.0, w));
        wide_store(&points->first[1][j], wide_select(plane, w - 1.0, w * wide_sqrt(w)));
        wide_store(&points->two_chi[j], w);
    }
}

void rivet_rom_stress(const RivetTable *t, const JointLoads *load, const constants fit_eff, bool all,
                      scalar sigma[RIVET_CHANNELS][Z])
{
    TablePoints points;
    find_points(t, load, fit_eff, &points);
    for (int k = 0; k < Z; k++) {
        TablePoint point;  // no initialiser: it would clear the whole struct first
        point.sheet = scalar_value(points.two_chi[k]) > 1.0 ? RIVET_PLANE : RIVET_OBLIQUE;
        for (int i = 0; i < 2; i++) point.first[i] = points.first[i][k];
        for (int i = RIVET_A; i <= RIVET_C; i++) axis_splines(&t->axis[i], points.u[i][k], &point.at[i]);
        axis_splines_xi(&t->axis[RIVET_XI], points.u[RIVET_XI][k], points.s[k], fit_eff[k],
                        &point.at[RIVET_XI]);
        scalar pair[2];
        contract(t, t->primary, &point, pair);
        sigma[HEAD_P1][k] = pair[0] + t->head_friction * load->F_head[k];
        sigma[MID_VM][k] = pair[1];
        if (!all) continue;
        contract(t, t->secondary, &point, pair);
        sigma[HEAD_VM][k] = pair[0] + t->head_friction_vm * load->F_head[k];
        sigma[MID_P1][k] = pair[1];
    }
}
