// What a scene takes of a half's vibration modes: see elastic_half.h.
#include "cage/elastic/elastic_half.h"

#include "cage/common/centrifugal.h"
#include "numbers/elementary.h"
#include "numbers/elimination.h"
#include "rivet/rivet_rom.h"

// Angle by which the fastest vibration of closed joints turns in a substep: velocity Verlet is stable up to
// 2, and the law's rounding may make a joint stiffer by 30 %.
static const double SUBSTEP_TURN = 1.6;

enum { RAY = 24 };

enum { COORDINATES = N_MODES + 3 };  // modes and relative rigid motions

enum { WALL_NODE = 1 };  // of the walls' angle: impacts meet the wall at 7 degrees in the median

size_t elastic_half_size(void)
{
    const int *cells = rivet_table.modes.law.cells;
    size_t count = LAW_WIDTH;
    for (int a = 0; a < LAW_AXES; a++) count *= (size_t)(cells[a] + 2);
    return sizeof(ElasticHalf) + count * sizeof(double);
}

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
    return table->pocket + 12 * entry * half->nodes;
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
    for (int node = 0; node < half->nodes; node++)
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

static void invert_3(const double *K, double inverse[3][3])
{
    for (int k = 0; k < 3; k++) {
        double A[3][3], x[3] = {k == 0, k == 1, k == 2};
        memcpy(A, K, sizeof A);
        solve_3(A[0], x);
        for (int i = 0; i < 3; i++) inverse[i][k] = x[i];
    }
}

// What the modes leave between the pads of a joint, of R: compliance [motion][load].
static void take_residual(double R[PADS][PADS], ElasticHalf *half)
{
    for (int a = 0; a < PAD_OUT; a++)
        for (int b = 0; b < PAD_OUT; b++) half->R[a][b] = R[OUT_PADS[a]][OUT_PADS[b]];
    invert_3(half->R[0], half->K);
}

// ---- the law over L^ ------------------------------------------------------------------------------------------------
static const JointLaw *table_law(void)
{
    return &rivet_table.modes.law;
}

// L + K delta - L^ in newtons where the joint carries L, under the load `at` of the table's law, at + (ratio
// - 1)(at - L) with ratio = K K_table^-1.
static void behind_residual(double ratio[3][3], const double at[3], double P, const double behind[3],
                            double rest[3])
{
    const JointLaw *law = table_law();
    double load[3], rivet[3], U;
    joint_law(law, at, P, load, rivet, &U);
    for (int i = 0; i < 3; i++) {
        rest[i] = load[i] - behind[i];
        for (int k = 0; k < 3; k++) rest[i] += ratio[i][k] * (at[k] - load[k]);
        if (i > 0) rest[i] /= law->length;
    }
}

static double size_of(const double rest[3])
{
    return fabs(rest[0]) + fabs(rest[1]) + fabs(rest[2]);
}

// The load `at` of the table's law for L^, by Newton's method with differences; a step is halved until the
// residual falls.
static void load_before(double ratio[3][3], const double behind[3], double P, double at[3])
{
    const double length = table_law()->length, unit[3] = {1.0, length, length};
    double rest[3];
    memcpy(at, behind, 3 * sizeof *at);
    behind_residual(ratio, at, P, behind, rest);
    for (int iteration = 0; iteration < 60 && size_of(rest) > 1e-13; iteration++) {
        double slope[3][3], change[3], trial[3], found[3];
        const double scale = P + fabs(at[0]) + (fabs(at[1]) + fabs(at[2])) / length;
        for (int k = 0; k < 3; k++) {
            const double step = 1e-6 * scale;
            memcpy(trial, at, sizeof trial);
            trial[k] += step * unit[k];
            behind_residual(ratio, trial, P, behind, found);
            for (int i = 0; i < 3; i++) slope[i][k] = (found[i] - rest[i]) / step;
        }

        for (int k = 0; k < 3; k++) change[k] = rest[k];
        solve_3(slope[0], change);
        for (int k = 0; k < 3; k++) change[k] *= -unit[k];
        double part = 1.0;
        for (int halving = 0; halving < 12; halving++, part *= 0.5) {
            for (int k = 0; k < 3; k++) trial[k] = at[k] + part * change[k];
            behind_residual(ratio, trial, P, behind, found);
            if (size_of(found) < size_of(rest)) break;
        }
        memcpy(at, trial, sizeof trial);
        memcpy(rest, found, sizeof found);
    }
}

// (N, M_r, M_t) and P of s = 1 N at the coordinates of the law, M_r >= 0.
static double law_load(double length, const double at[LAW_AXES], double load[3])
{
    const double m = 1.0 - fabs(at[AXIS_Q]), a = 1.0 - fabs(at[AXIS_PSI]), b = at[AXIS_PSI];
    const double W = at[AXIS_TAU] / sqrt(at[AXIS_Q] * at[AXIS_Q] + m * m), M = length / sqrt(a * a + b * b);
    load[0] = W * at[AXIS_Q], load[1] = W * m * M * a, load[2] = W * m * M * b;
    return 1.0 - at[AXIS_TAU];
}

// Place s of n + 2 on an axis of n cells, in cells: the ends and the middles.
static double site(int s, int cells)
{
    return s == 0 ? 0.0 : s == cells + 1 ? cells : s - 0.5;
}

// Coefficients of uniform quadratic splines from their values at the sites of one axis, in place: the first
// and the last equation give the outer coefficients, (c_0 + c_1)/2 = v_0, and the others are (c_i + 6 c_(i+1)
// + c_(i+2))/8 = v.
static void interpolate_axis(double *values, int cells, int stride)
{
    enum { MOST = 64 };

    double upper[MOST], right[MOST], c[MOST];
    const int count = cells + 2;
    for (int s = 0; s < count; s++) {
        const bool end = s == 0 || s == count - 1;
        const double lower = s == 0 ? 0.0
                             : end  ? 0.5
                                    : 0.125,
                     middle = end ? 0.5 : 0.75,
                     above = s == 0 ? 0.5
                             : end  ? 0.0
                                    : 0.125;
        const double pivot = middle - (s > 0 ? lower * upper[s - 1] : 0.0);
        upper[s] = above / pivot;
        right[s] = (values[s * stride] - (s > 0 ? lower * right[s - 1] : 0.0)) / pivot;
    }
    for (int s = count - 1; s >= 0; s--) c[s] = right[s] - (s < count - 1 ? upper[s] * c[s + 1] : 0.0);
    for (int s = 0; s < count; s++) values[s * stride] = c[s];
}

// The same for one of the numbers of the law, on all three axes.
static void interpolate(const int cells[LAW_AXES], double *values)
{
    const int count[LAW_AXES] = {cells[0] + 2, cells[1] + 2, cells[2] + 2};
    const int stride[LAW_AXES] = {count[1] * count[2] * LAW_WIDTH, count[2] * LAW_WIDTH, LAW_WIDTH};
    for (int axis = 0; axis < LAW_AXES; axis++) {
        const int second = (axis + 1) % LAW_AXES, third = (axis + 2) % LAW_AXES;
        for (int a = 0; a < count[second]; a++)
            for (int b = 0; b < count[third]; b++)
                interpolate_axis(values + a * stride[second] + b * stride[third], cells[axis], stride[axis]);
    }
}

// Values at a site of the law: loads of joint and rivet under L^ (first pass); U, the work of the moves along
// the ray from 0 to L^, by Simpson's rule (second pass).
static void site_values(const ElasticHalf *half, double ratio[3][3], const double behind[3], double P,
                        int pass, double *to)
{
    double at[3], load[3], rivet[3], U;
    if (pass == 0) {
        load_before(ratio, behind, P, at);
        joint_law(table_law(), at, P, to, to + 4, &U);
        return;
    }
    double sum = 0.0;
    for (int i = 1; i <= RAY; i++) {
        const double t = (double)i / RAY, weight = (i == RAY ? 1.0 : i % 2 == 1 ? 4.0 : 2.0) / (3.0 * RAY);
        for (int k = 0; k < 3; k++) at[k] = t * behind[k];
        joint_law(&half->law, at, P, load, rivet, &U);
        for (int i = 0; i < 3; i++)
            for (int k = 0; k < 3; k++) sum += weight * behind[i] * half->R[i][k] * (at[k] - load[k]);
    }
    to[LAW_ENERGY] = sum;
}

static void law_of(ElasticHalf *half)
{
    half->law = *table_law();
    half->law.coefficients = half->coefficients;
}

// The law over L^, on the same cells.
static void law_behind(ElasticHalf *half)
{
    const JointLaw *law = table_law();
    const int *cells = law->cells;
    double inverse[3][3], ratio[3][3] = {{0.0}};
    invert_3(law->K_0[0], inverse);
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++)
            for (int j = 0; j < 3; j++) ratio[i][k] += half->K[i][j] * inverse[j][k];
    memset(half->coefficients, 0, elastic_half_size() - sizeof *half);
    for (int pass = 0; pass < 2; pass++) {
        double *to = half->coefficients;
        for (int a = 0; a < cells[0] + 2; a++)
            for (int b = 0; b < cells[1] + 2; b++)
                for (int c = 0; c < cells[2] + 2; c++, to += LAW_WIDTH) {
                    const double at[LAW_AXES] = {site(a, cells[0]) / cells[0],
                                                 2.0 * site(b, cells[1]) / cells[1] - 1.0,
                                                 2.0 * site(c, cells[2]) / cells[2] - 1.0};
                    double behind[3];
                    const double P = law_load(law->length, at, behind);
                    site_values(half, ratio, behind, P, pass, to);
                }
        for (int number = 0; number < LAW_WIDTH; number++)
            if ((number == LAW_ENERGY) == (pass == 1)) interpolate(cells, half->coefficients + number);
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
    for (int c = 0; c < PAD_IN; c++) shear[c][c] = half->series * (d->k_plate_t + d->k_head) + k_hole;
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

// How many entries the scene takes, those of the lowest frequencies; counts their coordinates.
static int count_modes(const Parameters *p, const HalfModes *table, ElasticHalf *half)
{
    for (int entry = 0; entry < table->entries; entry++) {
        int count[2];
        for (int c = 0; c < 2; c++) count[c] = half->count[c] + has(&table->entry[entry], c);
        if (count[0] + count[1] > p->scene.modes || count[0] > ENTRIES || count[1] > ENTRIES) return entry;
        memcpy(half->count, count, sizeof count);
    }
    return table->entries;
}

// Adds the statics of an entry that is not taken to the residual between pads and at the wall.
static void leave_mode(const HalfModes *table, int entry, int coordinate, ElasticHalf *half,
                       double R[Z][PADS][PADS])
{
    const HalfMode *mode = &table->entry[entry];
    const double flexibility = 1.0 / (mode->omega * mode->omega), *at = mode->at;
    const double *wall = wall_of(table, half, entry) + 12 * WALL_NODE;
    const int n = mode->harmonic;
    for (int k = 0; k < Z; k++)
        for (int a = 0; a < PADS; a++)
            for (int b = 0; b < PADS; b++)
                R[k][a][b] += at[a] * wave_at(n, coordinate, PAD_ODD[a], 2.0 * PI * (k + 0.5) / Z) * at[b] *
                              wave_at(n, coordinate, PAD_ODD[b], PI / Z) * flexibility;
    const double c = portable_cos(half->chi[WALL_NODE]), s = portable_sin(half->chi[WALL_NODE]);
    const double u = s * wall[coordinate] + c * wall[4 + coordinate];  // on pocket 0, along the normal
    half->compliance += u * u * flexibility;
}

// The modes of the lowest frequencies; the statics of the others go to the residual.
static void take_modes(const Parameters *p, ElasticHalf *half, double R[Z][PADS][PADS])
{
    const CageHalfData *data = &rivet_table.half;
    const HalfModes *table = &rivet_table.modes;
    const double unit = sqrt(data->m), denser = p->cage.m / data->m;
    const int taken = count_modes(p, table, half);
    half->n = half->count[0] + half->count[1];
    half->blocks = (half->n + 7) / 8;
    half->octets = ((half->count[0] > half->count[1] ? half->count[0] : half->count[1]) + 7) / 8;

    for (int coordinate = 0; coordinate < 2; coordinate++) {
        int e = 0;
        for (int single = 0; single < 2; single++)
            for (int entry = 0; entry < taken; entry++) {
                const HalfMode *mode = &table->entry[entry];
                if (!has(mode, coordinate) || (mode->parity != 0) != single) continue;
                const int i = coordinate * half->count[0] + e;
                take_mode(table, entry, coordinate, unit, half, e++);
                half->pair[i] = mode->parity == 0;
                half->alike[i] = mode->harmonic == 0 && coordinate == 0;
                half->omega_2[i] = mode->omega * mode->omega / denser;
                half->damping[i] = 2.0 * p->cage.modal_damping * sqrt(half->omega_2[i]);
                if (coordinate == 0) half->centrifugal[i] = cage_centrifugal(p) * unit * mode->spin;
            }
        for (int entry = taken; entry < table->entries; entry++)
            if (has(&table->entry[entry], coordinate)) leave_mode(table, entry, coordinate, half, R);
    }
}

// How far a wall can move; between the nodes a quarter farther at most.
static void find_reach(ElasticHalf *half)
{
    const double unit_2 = rivet_table.half.m;
    for (int i = 0; i < half->n; i++) half->weight[i] = half->alike[i] ? 0.0 : half->omega_2[i];
    for (int node = 0; node < half->nodes; node++) {
        double sum = 0.0;
        for (int i = 0; i < half->n; i++) {
            const double *U = wall_of(&rivet_table.modes, half, half->entry[i]) + 12 * node;
            const double u_2 = unit_2 * (U[0] * U[0] + U[1] * U[1] + U[4] * U[4] + U[5] * U[5]);  // x and t
            if (half->alike[i])
                half->widest[i] = fmax(half->widest[i], 1.25 * sqrt(u_2));
            else
                sum += (half->pair[i] ? 0.5 : 1.0) * u_2 / half->omega_2[i];
        }
        half->reach_2 = fmax(half->reach_2, 1.5625 * sum);
    }
}

// ---- rest under the centrifugal load -----------------------------------------------------------------------------------
// All joints are alike: N = 0, and their M_t balances S_i = sqrt 2 (spin_i omega^2 - Z phi_t,i M_t)/(m
// omega_i^2).  Sets S and what is off for the distance x[0] and M_t = x[1]: N, and M_t over the law's length [N].
static void rest_off(const Parameters *p, const ElasticHalf *half, double omega_2, double P,
                     const double x[2], double *S, double off[2])
{
    const double root = sqrt(2.0);
    double e[PAD_OUT] = {0.5 * x[0], 0.0, 0.0}, behind[PAD_OUT], load[PAD_OUT], rivet[3], U;
    for (int i = 0; i < half->n; i++) {
        const double moment = half->alike[i] ? Z * half->out[i][2 * FIRST] * x[1] : 0.0;
        S[i] = (root * half->centrifugal[i] * omega_2 - moment) / (p->cage.m * half->omega_2[i]);
        e[0] += 0.5 * S[i] * half->out[i][0];
        e[2] += 0.5 * S[i] * half->out[i][2 * FIRST];
    }
    for (int a = 0; a < PAD_OUT; a++)
        behind[a] = half->K[a][0] * e[0] + half->K[a][1] * e[1] + half->K[a][2] * e[2];
    joint_law(&half->law, behind, P, load, rivet, &U);
    off[0] = load[0];
    off[1] = (load[2] - x[1]) / half->law.length;
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
    find_rest(p, half, omega * omega, fmax(d->P_mean + d->centrifugal[ROW_DP] * omega * omega, 0.0), x, S);
    return x[0];
}

void elastic_half_derive(const Parameters *p, const Derived *d, ElasticHalf *half)
{
    const HalfPath *path = &rivet_table.half.path;
    double R[Z][PADS][PADS];
    const int before = half->law_modes;  // the law over L^ follows from the number of modes alone and is kept
    memset(half, 0, sizeof *half);
    half->nodes = path->nodes;
    memcpy(half->chi, path->chi, (size_t)half->nodes * sizeof *half->chi);
    for (int node = 0; node + 1 < half->nodes; node++) {
        half->step[node] = half->chi[node + 1] - half->chi[node];
        half->inv_step[node] = 1.0 / half->step[node];
    }
    memcpy(R, rivet_table.modes.pad, sizeof R);
    half->compliance = rivet_table.modes.wall[2 * WALL_NODE];
    take_modes(p, half, R);
    take_residual(R[0], half);
    const double shear = R[0][PAD_R][PAD_R] + R[0][PAD_T][PAD_T];  // mean over r and t, of both halves
    half->series = 1.0 / (1.0 + shear * (d->k_plate_t + d->k_head));
    for (int k = 0; k < LANES; k++) half->k_hole[k] = d->k_hole[k] / (1.0 + shear * d->k_hole[k]);

    find_reach(half);
    law_of(half);
    if (before != p->scene.modes) law_behind(half);
    half->law_modes = p->scene.modes;
    half->substep = longest_substep(p, d, half);
}
