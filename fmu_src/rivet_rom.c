// Rivet stress from the reduced model: see rivet_rom.h for the equations.
//
// The points of the loads in the table are computed for a packet of rivets at once.  Then the splines of each
// rivet are summed for a pair of channels and two sheets side by side.
#include "rivet_rom.h"

#include "rivet_splines.h"

typedef struct {
    ball_array u[RIVET_AXES];  // a, b, c, xi
    ball_array s;              // P + N + V + |M|/L [N]
    ball_array first[2];       // weight of the first of two sheets in head and middle
    ball_array two_chi;        // 2 chi
} TablePoints;

// part/whole; 0 where whole is so small that 1/whole is not finite.
INLINE wide ratio(wide part, wide whole)
{
    return wide_select(wide_above(whole, 1e-300), part / whole, wide_set(0.0));
}

// Points of the loads of all rivets in the table.
static void find_points(const RivetTable *t, const RivetLoads *load, double fit_eff, TablePoints *points)
{
    const wide zero = wide_set(0.0), one = wide_set(1.0), inv_length = wide_set(1.0 / t->moment_length);
    for (int j = 0; j < PACKETS * LANE_WIDTH; j += LANE_WIDTH) {
        const wide v_y = wide_load(&load->V_y[j]), v_z = wide_load(&load->V_z[j]);
        const wide m_y = wide_load(&load->M_y[j]), m_z = wide_load(&load->M_z[j]);
        const wide p = wide_max(wide_load(&load->P[j]), zero), n = wide_max(wide_load(&load->N[j]), zero);
        const wide V = wide_sqrt(v_y * v_y + v_z * v_z), M = wide_sqrt(m_y * m_y + m_z * m_z);
        const wide axial = p + n, force = axial + V, moment = M * inv_length, s = force + moment;
        const wide inv_s = ratio(one, s), across = v_y * m_z - v_z * m_y;
        const wide w = 2.0 * wide_min(ratio(wide_max(across, -across), V * M), one);
        const bits plane = wide_above(w, 1.0);
        wide_store(&points->u[RIVET_A][j], ratio(V, force));
        wide_store(&points->u[RIVET_B][j], ratio(n, axial));
        wide_store(&points->u[RIVET_C][j], moment * inv_s);
        wide_store(&points->u[RIVET_XI][j], fit_eff * inv_s);
        wide_store(&points->s[j], s);
        wide_store(&points->first[0][j], wide_select(plane, w - 1.0, w));
        wide_store(&points->first[1][j], wide_select(plane, w - 1.0, w * wide_sqrt(w)));
        wide_store(&points->two_chi[j], w);
    }
}

void rivet_rom_stress(const RivetTable *t, const RivetLoads *load, double fit_eff, bool all,
                      scalar sigma[RIVET_CHANNELS][Z])
{
    TablePoints points;
    find_points(t, load, fit_eff, &points);
    for (int k = 0; k < Z; k++) {
        TablePoint point;  // no initialiser: it would clear the whole struct first
        point.sheet = scalar_value(points.two_chi[k]) > 1.0 ? RIVET_PLANE : RIVET_OBLIQUE;
        for (int i = 0; i < 2; i++) point.first[i] = points.first[i][k];
        for (int i = RIVET_A; i <= RIVET_C; i++) point.at[i] = axis_splines(&t->axis[i], points.u[i][k]);
        point.at[RIVET_XI] = axis_splines_xi(&t->axis[RIVET_XI], points.u[RIVET_XI][k], points.s[k], fit_eff);
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
