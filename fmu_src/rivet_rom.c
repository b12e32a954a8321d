// Rivet stress from the reduced model: see rivet_rom.h for the equations.
#include "rivet_rom.h"

#include <math.h>
#include <string.h>

// Three active splines of one axis: index of the first coefficient and their weights.
typedef struct {
    int first;
    number w[3];
} Splines;

// Cell of u: number of inner knots not above it.
static int axis_cell(const RivetAxis *axis, number u)
{
    int cell = 0;
    for (int i = 1; i < axis->cells; i++) cell += number_value(u) >= axis->knot[i];
    return cell;
}

// Quadratic B-splines (de Boor), u inside the axis.  Their sum is 1; C1 at the knots.
static Splines axis_splines(const RivetAxis *axis, number u)
{
    int i = axis_cell(axis, u);
    number up = u - axis->knot[i], down = axis->knot[i + 1] - u;
    Splines s = {.first = i};
    s.w[0] = down * down * axis->fall[i];
    s.w[2] = up * up * axis->rise[i];
    s.w[1] = 1.0 - s.w[0] - s.w[2];
    return s;
}

// s times the splines of xi = fit/s, without dividing where s may vanish.
static Splines axis_splines_xi(const RivetAxis *axis, number s, double fit)
{
    int last = axis->cells - 1;
    if (fit <= number_value(s) * axis->knot[0]) return (Splines){.first = 0, .w = {s, 0.0, 0.0}};
    number beyond = fit - s * axis->knot[axis->cells];
    if (number_value(beyond) >= 0.0) {  // end value and end slope, which is 2 h rise of the last spline
        number w = 2.0 * (axis->knot[last + 1] - axis->knot[last]) * axis->rise[last] * beyond;
        return (Splines){.first = last, .w = {0.0, -w, s + w}};
    }
    Splines splines = axis_splines(axis, fit / s);
    for (int i = 0; i < 3; i++) splines.w[i] *= s;
    return splines;
}

// A load's place in the table; the splines of xi carry the factor s.
typedef struct {
    Splines at[RIVET_AXES];
    int sheet;        // the first of the two sheets around chi
    number first[2];  // its weight in head and middle
} Place;

static Place load_place(const RivetTable *t, const RivetLoad *load, double fit_eff)
{
    number P = number_max(load->P, 0.0), N = number_max(load->N, 0.0);
    number V = number_sqrt(load->V_y * load->V_y + load->V_z * load->V_z), M = number_sqrt(load->M_y * load->M_y + load->M_z * load->M_z);
    number axial = P + N, force = axial + V, moment = M / t->moment_length, s = force + moment, VM = V * M;
    number across = load->V_y * load->M_z - load->V_z * load->M_y;
    Place place;
    number w = number_value(VM) > 0.0 ? 2.0 * number_min(number_max(across, -across) / VM, 1.0) : 0.0;
    place.sheet = number_value(w) >= 1.0 ? RIVET_PLANE : RIVET_OBLIQUE;
    if (place.sheet == RIVET_PLANE) w -= 1.0;
    place.first[0] = w;
    place.first[1] = place.sheet == RIVET_PLANE ? w : w * number_sqrt(w);
    place.at[RIVET_A] = axis_splines(&t->axis[RIVET_A], number_value(force) > 0.0 ? V / force : 0.0);
    place.at[RIVET_B] = axis_splines(&t->axis[RIVET_B], number_value(axial) > 0.0 ? N / axial : 0.0);
    place.at[RIVET_C] = axis_splines(&t->axis[RIVET_C], number_value(s) > 0.0 ? moment / s : 0.0);
    place.at[RIVET_XI] = axis_splines_xi(&t->axis[RIVET_XI], s, fit_eff);
    return place;
}

// Tensor product over 3^4 coefficients of two sheets for a pair of channels.  Order of sums: xi with chi, c, b, a.
#ifdef DUAL
static void contract(const RivetTable *t, const float *coefficients, const Place *place, number sigma[2])
{
    const Splines *A = &place->at[RIVET_A], *B = &place->at[RIVET_B], *C = &place->at[RIVET_C], *X = &place->at[RIVET_XI];
    int n_b = t->axis[RIVET_B].cells + 2, n_c = t->axis[RIVET_C].cells + 2, n_xi = t->axis[RIVET_XI].cells + 2;
    sigma[0] = sigma[1] = 0.0;
    for (int i = 0; i < 81; i++) {
        int a = i / 27, b = i / 9 % 3, c = i / 3 % 3, x = i % 3;
        int place_xi = (((A->first + a) * n_b + B->first + b) * n_c + C->first + c) * n_xi + X->first + x;
        const float *T = coefficients + 2 * (RIVET_SHEETS * place_xi + place->sheet);
        number weight = A->w[a] * B->w[b] * C->w[c] * X->w[x];
        for (int k = 0; k < 2; k++) sigma[k] += weight * (place->first[k] * T[k] + (1.0 - place->first[k]) * T[2 + k]);
    }
}
#else
// Two channels side by side.
typedef double pair __attribute__((vector_size(16)));

static inline pair fetch(const float *from)
{
    return (pair){from[0], from[1]};
}

static inline void contract(const RivetTable *t, const float *coefficients, const Place *place, double sigma[2])
{
    const Splines *A = &place->at[RIVET_A], *B = &place->at[RIVET_B], *C = &place->at[RIVET_C], *X = &place->at[RIVET_XI];
    int n_b = t->axis[RIVET_B].cells + 2, n_c = t->axis[RIVET_C].cells + 2, n_xi = t->axis[RIVET_XI].cells + 2;
    const int xi = 2 * RIVET_SHEETS, row = n_xi * xi;  // coefficients from one xi, one c to the next
    const pair w = {place->first[0], place->first[1]};
    pair first[3], second[3];
    for (int i = 0; i < 3; i++) {
        first[i] = X->w[i] * w;
        second[i] = X->w[i] * (1.0 - w);
    }
    pair sum = {0};
    for (int a = 0; a < 3; a++) {
        pair sum_a = {0};
        for (int b = 0; b < 3; b++) {
            const float *T = coefficients + row * (((A->first + a) * n_b + B->first + b) * n_c + C->first) + xi * X->first + 2 * place->sheet;
            pair part[3];
            for (int c = 0; c < 3; c++, T += row) {
                const float *U = T + 2;  // the second sheet
                pair one = first[0] * fetch(T) + first[1] * fetch(T + xi) + first[2] * fetch(T + 2 * xi);
                pair other = second[0] * fetch(U) + second[1] * fetch(U + xi) + second[2] * fetch(U + 2 * xi);
                part[c] = C->w[c] * (one + other);
            }
            sum_a += B->w[b] * (part[0] + part[1] + part[2]);
        }
        sum += A->w[a] * sum_a;
    }
    memcpy(sigma, &sum, sizeof sum);
}
#endif

void rivet_rom_primary(const RivetTable *t, const RivetLoad *load, double fit_eff, number *head_p1, number *mid_vm)
{
    Place place = load_place(t, load, fit_eff);
    number sigma[2];
    contract(t, t->primary, &place, sigma);
    *head_p1 = sigma[0] + t->head_friction * load->F_head;
    *mid_vm = sigma[1];
}

unsigned rivet_rom_stress(const RivetTable *t, const RivetLoad *load, double fit_eff, number sigma[RIVET_CHANNELS])
{
    Place place = load_place(t, load, fit_eff);
    number primary[2], secondary[2];
    contract(t, t->primary, &place, primary);
    contract(t, t->secondary, &place, secondary);
    sigma[HEAD_P1] = primary[0] + t->head_friction * load->F_head;
    sigma[MID_VM] = primary[1];
    sigma[HEAD_VM] = secondary[0] + t->head_friction_vm * load->F_head;
    sigma[MID_P1] = secondary[1];

    unsigned flags = 0;
    if (fmax(number_value(sigma[HEAD_VM]), number_value(sigma[MID_VM])) > t->yield_rivet) flags |= RIVET_YIELDS;
    if (fit_eff > t->fit_flange_yield) flags |= FLANGE_YIELDS;
    if (number_value(load->N) < 0.0) flags |= JOINT_COMPRESSED;
    if (fit_eff > t->j2.fit_a[t->j2.count - 1] || !isfinite(number_value(sigma[HEAD_P1]))) flags |= RIVET_OUTSIDE;
    return flags;
}

double rivet_rom_fit_eff(const RivetTable *t, double fit_a, bool j2)
{
    const FitMap *map = &t->j2;
    int last = map->count - 1;
    if (!j2 || fit_a <= map->fit_a[0]) return fit_a;
    if (fit_a >= map->fit_a[last]) return map->fit_eff[last] + map->slope[last] * (fit_a - map->fit_a[last]);
    int i = 0;
    while (fit_a >= map->fit_a[i + 1]) i++;
    double h = map->fit_a[i + 1] - map->fit_a[i], u = (fit_a - map->fit_a[i]) / h, v = 1.0 - u;
    return map->fit_eff[i] * v * v * (1.0 + 2.0 * u) + map->fit_eff[i + 1] * u * u * (1.0 + 2.0 * v) + h * u * v * (map->slope[i] * v - map->slope[i + 1] * u);
}

// The flanges outgrow the rivet: k_stack (alpha_flange - alpha_rivet) grip per kelvin.
double joint_preload(const JointData *j, double preload, double T)
{
    return fmax(0.0, preload + j->k_stack * (j->alpha_flange - j->alpha_rivet) * j->grip * (T - j->T_0));
}

double joint_fit(const JointData *j, double fit, double T)
{
    return fit - (j->alpha_flange - j->alpha_rivet) * j->d * (T - j->T_0);
}

double joint_hole_stiffness(const JointData *j, double fit_a)
{
    int last = j->hole_count - 1;
    if (fit_a <= j->hole_fit[0]) return j->k_hole[0];
    if (fit_a >= j->hole_fit[last]) return j->k_hole[last];
    int i = 0;
    while (fit_a >= j->hole_fit[i + 1]) i++;
    double u = (fit_a - j->hole_fit[i]) / (j->hole_fit[i + 1] - j->hole_fit[i]);
    return j->k_hole[i] + u * (j->k_hole[i + 1] - j->k_hole[i]);
}

void joint_prying(const JointData *j, RivetLoad *load)
{
    const number M = number_sqrt(load->M_y * load->M_y + load->M_z * load->M_z);
    const number M_0 = j->prying_lever * number_max(load->P - number_max(load->N, 0.0), 0.0);
    if (number_value(M) <= number_value(M_0)) return;
    const number part = (M_0 + j->prying_share * (M - M_0)) / M;
    load->M_y *= part;
    load->M_z *= part;
}
