// A half's vibration modes in a scene: see elastic_half.h.
#include "cage/elastic/elastic_half.h"

#include "cage/common/spin_preload.h"
#include "numbers/elementary.h"
#include "numbers/elimination.h"
#include "rivet/rivet_rom.h"

// Angle by which the fastest vibration of closed joints turns in a substep: velocity Verlet is stable up to
// 2, and the law's rounding may make a joint stiffer by 30 %.
static const double SUBSTEP_TURN = 1.55;

// Substeps in the longest step: forces that are constant over it feed vibrations that turn by much more than pi.  They feed the light
// halves of a ribbon more: with five the 99.9 % pocket force of quiet ribbons, 2 N, was 14 to 37 % too large,
// with four the RMS force at 12,000 r/min by 7 %.
static const double LONGEST = 5.0, LONGEST_RIBBON = 3.5;

// Part of a wall's velocity that a film takes in the longest step, below which the film need not follow in the substeps.
static const double WEAK_FILM = 0.05;

enum { COORDINATES = N_MODES + 3 };  // modes and relative rigid motions

enum { WALL_NODE = 1 };  // of the walls' angle: impacts meet the wall at 7 degrees in the median

// Value that the real (0) or imaginary (1) part of an amplitude is multiplied by at the angle theta, for the coordinate
// a (0) or b (1).
static double wave_at(int n, int coordinate, int part, double theta)
{
    const double c = portable_cos(n * theta), s = portable_sin(n * theta);
    if (coordinate == 0) return part == 0 ? c : -s;
    return part == 0 ? s : c;
}

// Amplitudes of an entry at the walls [node][value, slope][x, r, t][U', U''].
static const double *wall_of(const HalfModes *table, const ElasticHalf *half, int entry)
{
    return table->pocket + 12 * entry * half->nodes * half->radii;
}

// Place e among the a (coordinate 0) or b (1), of an entry of the table.
static void take_mode(const HalfModes *table, int entry, int coordinate, double unit, ElasticHalf *half,
                      int e)
{
    const HalfMode *mode = &table->entry[entry];
    const double root = sqrt(2.0);
    const int i = coordinate * half->count[0] + e;
    half->entry[i] = entry;
    for (int k = 0; k < FIRST; k++) {
        const double theta = 2.0 * PI * (k + 0.5) / Z, part = k == Z - 1 - k ? 0.5 : 1.0;
        for (int c = 0; c < PAD_OUT; c++) {
            half->out[i][c * FIRST + k] = root * unit * mode->at[OUT_PADS[c]] *
                                          wave_at(mode->harmonic, coordinate, PAD_ODD[OUT_PADS[c]], theta);
            half->out_modes[coordinate * PAD_OUT + c][k][e] = part * half->out[i][c * FIRST + k];
        }
        for (int c = 0; c < PAD_IN; c++) {
            half->in[i][c * FIRST + k] = root * unit * mode->at[IN_PADS[c]] *
                                         wave_at(mode->harmonic, coordinate, PAD_ODD[IN_PADS[c]], theta);
            half->in_modes[coordinate * PAD_IN + c][k][e] = part * half->in[i][c * FIRST + k];
        }
    }
    for (int j = 0; j < Z; j++) {
        const double nu = 2.0 * PI * j / Z;
        half->turn[j][coordinate][e] = wave_at(mode->harmonic, 0, 0, nu);
        half->turn[j][2][e] = mode->parity == 0 ? wave_at(mode->harmonic, 1, 0, nu) : 0.0;
    }
    const double *from = wall_of(table, half, entry);
    for (int node = 0; node < half->radii * half->nodes; node++)
        for (int slope = 0; slope < 2; slope++)
            for (int c = 0; c < 3; c++, from += 2)
                half->wall[node][slope][c][coordinate][e] = unit * from[coordinate];
}

double elastic_half_pad(const ElasticHalf *half, bool out, int i, int motion, int k)
{
    const bool b = i >= half->count[0], mirrored = k >= FIRST;
    const double sign = mirrored && PAD_ODD[out ? OUT_PADS[motion] : IN_PADS[motion]] != b ? -1.0 : 1.0;
    const double *row = out ? half->out[i] : half->in[i];
    return sign * row[motion * FIRST + (mirrored ? Z - 1 - k : k)];
}

// Residual between the pads of a joint out of the plane, beside the modes: the law's stiffness and its inverse.
static void take_residual(const JointLaw *law, ElasticHalf *half)
{
    half->law = law;
    memcpy(half->K, law->K_0, sizeof half->K);
    for (int k = 0; k < PAD_OUT; k++) {
        double A[PAD_OUT][PAD_OUT], x[PAD_OUT] = {k == 0, k == 1, k == 2};
        memcpy(A, half->K, sizeof A);
        solve_3(A[0], x);
        for (int i = 0; i < PAD_OUT; i++) half->R[i][k] = x[i];
    }
}

// ---- vibrations of the pair -----------------------------------------------------------------------------------------
// Motion c of joint k by unit of a relative rigid motion: out of the plane (x, about r, about t) by v_x and
// rotations about y and z, in it (r, t) by v_y, v_z and the spin.
static double rigid_motion(bool out, int motion, int c, double theta)
{
    const double R = 0.5 * rivet_table.joint.d_m, cosine = portable_cos(theta), sine = portable_sin(theta);
    if (out) {
        const double about_y[PAD_OUT] = {R * sine, cosine, -sine},
                     about_z[PAD_OUT] = {-R * cosine, sine, cosine};
        if (motion == 0) return c == 0 ? 1.0 : 0.0;
        return motion == 1 ? about_y[c] : about_z[c];
    }
    if (motion == 2) return c == 1 ? R : 0.0;
    return motion == 0 ? (c == 0 ? cosine : -sine) : (c == 0 ? sine : cosine);
}

// Largest eigenvalue of a symmetric matrix without negative ones, by power iteration.
static double largest_eigenvalue(int n, double A[COORDINATES][COORDINATES])
{
    double x[COORDINATES], lambda = 0.0;
    for (int i = 0; i < n; i++) x[i] = 1.0 + 0.1 * i;
    for (int iteration = 0; iteration < 300; iteration++) {
        double to[COORDINATES], size_2 = 0.0;
        for (int i = 0; i < n; i++) {
            to[i] = 0.0;
            for (int k = 0; k < n; k++) to[i] += A[i][k] * x[k];
            size_2 += to[i] * to[i];
        }
        lambda = sqrt(size_2);
        for (int i = 0; i < n; i++) x[i] = to[i] / lambda;
    }
    return lambda;
}

// Square of the highest frequency of both halves with closed joints.  K: stiffness of a joint for relative
// motions out of the plane or in it; rigid: inertia of the relative rigid motions.
static double fastest(const Parameters *p, const ElasticHalf *half, bool out, double K[PAD_OUT][PAD_OUT],
                      const double rigid[3])
{
    enum { JOINTS = PAD_OUT * Z };

    const int count = out ? PAD_OUT : PAD_IN, modes = half->n, all = modes + 3;
    double B[COORDINATES][JOINTS],
        A[COORDINATES][COORDINATES];  // motions of the joints by coordinates of unit inertia
    for (int i = 0; i < all; i++) {
        const double root = sqrt(i < modes ? p->cage.m : rigid[i - modes]);
        for (int c = 0; c < count; c++)
            for (int k = 0; k < Z; k++) {
                const double by_mode = i < modes ? elastic_half_pad(half, out, i, c, k) : 0.0;
                const double by_rigid =
                    i < modes ? 0.0 : rigid_motion(out, i - modes, c, 2.0 * PI * (k + 0.5) / Z);
                B[i][c * Z + k] = (by_mode + by_rigid) / root;
            }
    }
    for (int i = 0; i < all; i++) {
        double load[JOINTS] = {0.0};
        for (int a = 0; a < count; a++)
            for (int k = 0; k < Z; k++)
                for (int b = 0; b < count; b++) load[a * Z + k] += K[a][b] * B[i][b * Z + k];
        for (int q = 0; q < all; q++) {
            A[q][i] = i == q && i < modes ? half->omega_2[i] : 0.0;
            for (int k = 0; k < count * Z; k++) A[q][i] += B[q][k] * load[k];
        }
    }
    return largest_eigenvalue(all, A);
}

// The longest substep: the fastest vibration, of closed joints and shanks that bear, turns by SUBSTEP_TURN.
static double longest_substep(const Parameters *p, const Derived *d, const ElasticHalf *half)
{
    double K[PAD_OUT][PAD_OUT], shear[PAD_OUT][PAD_OUT] = {{0.0}}, k_hole = 0.0;
    for (int a = 0; a < PAD_OUT; a++)  // both halves move, and both are loaded: 2 (1/2)^2
        for (int b = 0; b < PAD_OUT; b++) K[a][b] = 0.5 * half->K[a][b];
    for (int k = 0; k < Z; k++) k_hole = fmax(k_hole, half->k_hole[k]);
    for (int c = 0; c < PAD_IN; c++) shear[c][c] = half->series * d->k_plate_t + k_hole;
    const double out[3] = {0.5 * p->cage.m, 0.5 * d->J_t, 0.5 * d->J_t};
    const double in[3] = {0.5 * p->cage.m, 0.5 * p->cage.m, 0.5 * d->J_p};
    return SUBSTEP_TURN / sqrt(fmax(fastest(p, half, true, K, out), fastest(p, half, false, shear, in)));
}

// ---- all ------------------------------------------------------------------------------------------------------------
// Whether an entry has the coordinate a (0) or b (1).
static bool has(const HalfMode *mode, int coordinate)
{
    return coordinate == 0 ? mode->parity >= 0 : mode->parity <= 0;
}

// All modes of the table.
static void take_modes(const Parameters *p, ElasticHalf *half)
{
    const CageHalfData *data = &rivet_table.half;
    const HalfModes *table = &rivet_table.modes;
    const double unit = sqrt(data->m), denser = p->cage.m / data->m;
    for (int c = 0; c < 2; c++)
        for (int entry = 0; entry < table->entries; entry++) half->count[c] += has(&table->entry[entry], c);
    half->n = half->count[0] + half->count[1];

    for (int coordinate = 0; coordinate < 2; coordinate++) {
        int e = 0;
        for (int single = 0; single < 2; single++)
            for (int entry = 0; entry < table->entries; entry++) {
                const HalfMode *mode = &table->entry[entry];
                if (!has(mode, coordinate) || (mode->parity != 0) != single) continue;
                const int i = coordinate * half->count[0] + e;
                take_mode(table, entry, coordinate, unit, half, e++);
                half->pair[i] = mode->parity == 0;
                half->uniform[i] = mode->harmonic == 0 && coordinate == 0;
                if (half->uniform[i]) half->uniform_at[half->uniforms++] = i;
                half->omega_2[i] = mode->omega * mode->omega / denser;
                for (int wave = 0; wave < RIM / 2; wave++) {
                    const double *rim = mode->rim[coordinate][wave];
                    half->rim[2 * wave + coordinate][i] = unit * (rim[0] + p->cage.land_x * rim[1]);
                }
            }
    }
    for (int c = 0; c < RIM; c++)
        for (int i = 0; i < half->n; i++) half->mobility[c] += half->rim[c][i] * half->rim[c][i] / p->cage.m;
}

// Damping and centrifugal load of the modes, which may change in a run.  Damping ratio at omega^2: zeta at the lowest mode, zeta_high at
// the highest one, linear in ln omega between them.
static void take_forces(const Parameters *p, ElasticHalf *half)
{
    const double unit = sqrt(rivet_table.half.m), low = p->cage.modal_damping,
                 high = p->cage.modal_damping_high;
    double lowest = INFINITY, highest = 0.0;
    for (int i = 0; i < half->n; i++) {
        lowest = fmin(lowest, half->omega_2[i]);
        highest = fmax(highest, half->omega_2[i]);
    }
    for (int i = 0; i < half->n; i++) {
        double zeta = low;
        if (high != 0.0 && highest > lowest)
            zeta += (high - low) * (portable_log(half->omega_2[i] / lowest) / portable_log(highest / lowest));
        half->damping[i] = 2.0 * zeta * sqrt(half->omega_2[i]);
        if (i >= half->count[0]) continue;
        half->centrifugal[i] = cage_centrifugal(p) * unit * rivet_table.modes.entry[half->entry[i]].spin;
    }
}

// Motions at the nodes by the modes that move all pockets alike, by rows.
static void take_alike(ElasticHalf *half)
{
    for (int i = 0; i < half->uniforms; i++)
        for (int row = 0; row < half->radii * half->nodes; row++)
            for (int slope = 0; slope < 2; slope++)
                for (int c = 0; c < 3; c++)
                    half->alike[i][row][4 * slope + c] = half->wall[row][slope][c][0][half->uniform_at[i]];
}

// How far a wall can move, between the nodes a quarter farther at most, and how easily: modes of unit mass m.
static void find_reach(const Parameters *p, const Derived *d, bool ribbon, ElasticHalf *half)
{
    const double unit_2 = rivet_table.half.m, farther = 1.25, R = 0.5 * p->bearing.d_m;
    half->pairs = 0;
    half->wall_mobility = 1.0 / p->cage.m + R * R / d->J_t;
    for (int i = 0; i < half->n; i++) {
        double most = 0.0;
        for (int node = 0; node < half->radii * half->nodes; node++) {
            const double *U = wall_of(&rivet_table.modes, half, half->entry[i]) + 12 * node;
            double u_2 = U[0] * U[0] + U[1] * U[1] + U[4] * U[4] + U[5] * U[5];  // x and t
            if (ribbon) u_2 += U[2] * U[2] + U[3] * U[3];
            most = fmax(most, sqrt(unit_2 * u_2));
        }
        const bool is_a = i < half->count[0];
        if (half->pair[i] && is_a) half->pairs++;
        if (half->uniform[i])
            half->widest[i] = farther * most;
        else if (!half->pair[i] || is_a)
            half->widest_others[i] = farther * most;
        if (!half->pair[i] || is_a) half->wall_mobility += most * most / p->cage.m;
    }
}

// ---- rest under the centrifugal load -----------------------------------------------------------------------------------
// All joints are alike: N = 0, and their M_t balances S_i = sqrt 2 (spin_i omega^2 - Z phi_t,i M_t)/(m
// omega_i^2).  Sets S and the errors `off` for the distance x[0] and M_t = x[1]: N, and that of M_t over the law's length [N].
static void rest_off(const Parameters *p, const ElasticHalf *half, double omega_2, double P,
                     const double x[2], double *S, double off[2])
{
    const double root = sqrt(2.0);
    double e[PAD_OUT] = {0.5 * x[0], 0.0, 0.0}, L_K[PAD_OUT], load[PAD_OUT], rivet[3], U;
    for (int i = 0; i < half->n; i++) {
        const double moment = half->uniform[i] ? Z * half->out[i][2 * FIRST] * x[1] : 0.0;
        S[i] = (root * half->centrifugal[i] * omega_2 - moment) / (p->cage.m * half->omega_2[i]);
        e[0] += 0.5 * S[i] * half->out[i][0];
        e[2] += 0.5 * S[i] * half->out[i][2 * FIRST];
    }
    for (int a = 0; a < PAD_OUT; a++)
        L_K[a] = half->K[a][0] * e[0] + half->K[a][1] * e[1] + half->K[a][2] * e[2];
    LawPlaces at;
    const wide trial[PAD_OUT] = {wide_set(L_K[0]), wide_set(L_K[1]), wide_set(L_K[2])};
    law_places(half->law, trial, wide_set(P), 0, &at);
    law_answer(half->law, &at, 0, L_K[1], load, rivet, &U);
    off[0] = load[0];
    off[1] = (load[2] - x[1]) / half->law->length;
}

// Newton's method with differences; x: distance and M_t to begin with and as found.
static void find_rest(const Parameters *p, const ElasticHalf *half, double omega_2, double P, double x[2],
                      double *S)
{
    const double step[2] = {1e-10, 1e-7};
    double off[2], to[2], slope[2][2];
    memset(S, 0, MODES * sizeof *S);
    rest_off(p, half, omega_2, P, x, S, off);
    for (int iteration = 0; iteration < 60 && fmax(fabs(off[0]), fabs(off[1])) > 1e-11; iteration++) {
        for (int k = 0; k < 2; k++) {
            double trial[2] = {x[0], x[1]};
            trial[k] += step[k];
            rest_off(p, half, omega_2, P, trial, S, to);
            for (int i = 0; i < 2; i++) slope[i][k] = (to[i] - off[i]) / step[k];
        }
        const double det = slope[0][0] * slope[1][1] - slope[0][1] * slope[1][0];
        x[0] -= (slope[1][1] * off[0] - slope[0][1] * off[1]) / det;
        x[1] -= (slope[0][0] * off[1] - slope[1][0] * off[0]) / det;
        rest_off(p, half, omega_2, P, x, S, off);
    }
}

double elastic_half_rest(const Parameters *p, const Derived *d, const ElasticHalf *half, double omega,
                         double *S)
{
    double x[2] = {0.0, 0.0};
    const double w = d->centrifugal[ROW_DP] * omega * omega;
    double P = fmax(d->P_mean + w, 0.0);
    if (rivet_table.half.spin_steps > 0) P += spin_bending(&rivet_table.half, d->P_mean, w);
    find_rest(p, half, omega * omega, P, x, S);
    return x[0];
}

// Constants that follow from the body alone.
static void derive_body(const Parameters *p, const Derived *d, ElasticHalf *half)
{
    const HalfPath *path = &rivet_table.half.path;
    const HalfModes *table = &rivet_table.modes;
    memset(half, 0, sizeof *half);
    half->nodes = path->nodes;
    memcpy(half->chi, path->chi, (size_t)half->nodes * sizeof *half->chi);
    for (int node = 0; node + 1 < half->nodes; node++) {
        half->step[node] = half->chi[node + 1] - half->chi[node];
        half->inv_step[node] = 1.0 / half->step[node];
    }
    const bool ribbon = p->cage.shape == CAGE_SHAPE_RIBBON;
    half->radii = path->radii > 0 ? path->radii : 1;
    for (int a = 0; a < path->radii; a++) half->radius[a] = path->radius[a];
    for (int a = 0; half->radii == WALL_RADII && a < WALL_RADII; a++) {
        const double *at = half->radius;
        half->per_gaps[a] = 1.0 / ((at[a] - at[(a + 1) % WALL_RADII]) * (at[a] - at[(a + 2) % WALL_RADII]));
    }
    half->compliance = table->wall[WALL_NODE];
    if (ribbon) half->compliance = fmax(table->wall[half->radii / 2 * half->nodes + WALL_NODE], 0.0);
    take_modes(p, half);
    take_residual(&table->law, half);
    if (ribbon) take_alike(half);
    find_reach(p, d, ribbon, half);
    half->of_k_hole = -1.0;
}

void elastic_half_derive(const Parameters *p, const Derived *d, ElasticHalf *half)
{
    const HalfModes *table = &rivet_table.modes;
    const double body[] = {p->cage.shape, p->cage.m, p->cage.land_x, p->bearing.d_m,
                           d->J_p,        d->J_t,    d->k_plate_t};
    if (memcmp(half->of_body, body, sizeof body) != 0) derive_body(p, d, half);
    memcpy(half->of_body, body, sizeof body);
    take_forces(p, half);

    // mean over r and t, of both halves
    const double shear = table->pad[PAD_R][PAD_R] + table->pad[PAD_T][PAD_T];
    half->series = 1.0 / (1.0 + shear * d->k_plate_t);
    double k_hole = 0.0;
    for (int k = 0; k < LANES; k++) half->k_hole[k] = d->k_hole[k] / (1.0 + shear * d->k_hole[k]);
    for (int k = 0; k < Z; k++) k_hole = fmax(k_hole, half->k_hole[k]);
    if (half->of_k_hole == k_hole) return;
    half->substep = longest_substep(p, d, half);
    half->longest_step = (d->spheres.on ? LONGEST_RIBBON : LONGEST) * half->substep;
    half->weak_film = WEAK_FILM / (half->longest_step * half->wall_mobility);
    half->of_k_hole = k_hole;
}
