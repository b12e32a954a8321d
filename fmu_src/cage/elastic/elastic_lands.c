// The films of the lands on the rivets of elastic halves: static loads.  They change the reported rivet loads only, not the
// motion.
//
// The films press on the rims and so pry at the joints: the load path (half_path.h) gives the loads Delta L, Delta V of
// bonded joints and Delta P, dm of their rivets.  The joints' state by the modes is (L, delta), its law over K, the
// stiffness of the residual beside the modes; a static load meets the whole half around the joint, K_0 (joint_law.h),
//
//     L_0 = L + K_0 delta,     delta = K^-1 (L_K - L)
//     L_0' = L_0 + Delta L - sum over other joints of K_(k-j) (delta' - delta)_j,
//     (delta', T', m')_k = law_0(L_0', P + Delta P)_k
//
// and the rivet's loads change by law_0(L_0', P + Delta P) - law_0(L_0, P), which is 0 without a film.  One sweep leaves
// 10 % of the change, two leave 1.3 %.  A film whose Delta L is less than 0.5 % of the joints' loads has one sweep, from
// 1 % on two, between them a smooth part of the second.  In the plane friction and play that the motion leaves over carry
// Delta V, as between rigid halves (joint_slip.c).
//
// The second and the third wave of the load bend the rims and so the film's own gap: they act on the modes (land_bent.h), which
// carry the bonded loads of the joints to 2 %, and leave only Delta P and dm here.  Faint films are left out.
// Smoothness: that of the law, C1.
#include "cage/elastic/elastic_lands.h"

#include "cage/elastic/elastic_half.h"
#include "physics/land_bent.h"
#include "physics/land_film.h"
#include "rivet/rivet_rom.h"

// Delta L over the loads of the joints, root mean square, that one sweep is for.
static const double LITTLE = 0.005;

// Loads L_0, moves of the pads and loads of the rivets by them.
typedef struct {
    ball_array load[3], move[3], rivet[3];
} Answers;

// Moves and rivet loads by the loads to->load; a broken joint carries nothing.
static void answer(const Derived *d, const ball_array P, Answers *to)
{
    const JointLaw *law = &rivet_table.half.law;
    LawPlaces at;
    for (int k = 0; k < PACKETS * LANE_WIDTH; k += LANE_WIDTH) {
        const wide L[3] = {wide_load(&to->load[0][k]), wide_load(&to->load[1][k]),
                           wide_load(&to->load[2][k])};
        law_places(law, L, wide_load(&P[k]), k, &at);
    }
    memset(to->move, 0, sizeof to->move);
    memset(to->rivet, 0, sizeof to->rivet);
    for (int k = 0; k < Z; k++) {
        scalar move[3], rivet[3] = {0.0, 0.0, 0.0}, energy;
        const scalar load[3] = {to->load[0][k], to->load[1][k], to->load[2][k]};
        if (d->intact[k] > 0.0)
            law_answer(law, &at, k, load[1], move, rivet, &energy);
        else
            law_free(law->K_0, load, move);
        for (int i = 0; i < 3; i++) to->move[i][k] = move[i], to->rivet[i][k] = rivet[i];
    }
}

// Part of the second sweep.
static scalar second_part(const Answers *before, const Answers *first, const ball_array P)
{
    const double length = rivet_table.half.law.length, per_moment = 1.0 / (length * length);
    ball_array by_film, all;
    for (int k = 0; k < PACKETS * LANE_WIDTH; k += LANE_WIDTH) {
        const wide preload = wide_load(&P[k]);
        wide film = wide_set(0.0), load = preload * preload;
        for (int i = 0; i < 3; i++) {
            const double square = i == 0 ? 1.0 : per_moment;
            const wide L_0 = wide_load(&before->load[i][k]), more = wide_load(&first->load[i][k]) - L_0;
            film += square * more * more;
            load += square * L_0 * L_0;
        }
        wide_store(&by_film[k], film);
        wide_store(&all[k], load);
    }
    const double little_2 = LITTLE * LITTLE;
    const scalar ratio_2 = ball_array_sum(by_film) / (ball_array_sum(all) + 1e-30);
    return smooth_part((ratio_2 - little_2) / (3.0 * little_2));
}

// L_0 of the joints by the modes.
static void find_start(const ElasticHalf *half, const ElasticJoints *joints, ball_array L_0[3])
{
    const JointLaw *law = &rivet_table.half.law;
    double part[3][3];  // K_0 K^-1
    for (int i = 0; i < 3; i++)
        for (int n = 0; n < 3; n++) {
            part[i][n] = 0.0;
            for (int m = 0; m < 3; m++) part[i][n] += law->K_0[i][m] * half->R[m][n];
        }
    for (int k = 0; k < PACKETS * LANE_WIDTH; k += LANE_WIDTH) {
        wide moved[3];
        for (int i = 0; i < 3; i++)
            moved[i] = wide_load(&joints->trial[i][k]) - wide_load(&joints->load[i][k]);
        for (int i = 0; i < 3; i++)
            wide_store(&L_0[i][k], wide_load(&joints->load[i][k]) + part[i][0] * moved[0] +
                                       part[i][1] * moved[1] + part[i][2] * moved[2]);
    }
}

// The second sweep, of which a part is added to the first.
static void sweep_again(const Derived *d, const Answers *before, scalar part, const ball_array P,
                        Answers *now)
{
    Answers first = *now;
    JointMoves change;
    wide trial[PACKETS][3];
    for (int i = 0; i < 3; i++)
        for (int turn = 0; turn < 2; turn++)
            for (int k = 0; k < Z; k++) change[i][turn * Z + k] = first.move[i][k] - before->move[i][k];
    law_trials(&rivet_table.half.law, first.load, change, trial);
    for (int p = 0; p < PACKETS; p++)
        for (int i = 0; i < 3; i++) wide_store(&now->load[i][p * LANE_WIDTH], trial[p][i]);
    answer(d, P, now);
    ball_array *const to[3] = {now->load, now->move, now->rivet};
    ball_array *const from[3] = {first.load, first.move, first.rivet};
    for (int kind = 0; kind < 3; kind++)
        for (int i = 0; i < 3; i++)
            for (int k = 0; k < PACKETS * LANE_WIDTH; k += LANE_WIDTH) {
                const wide one = wide_load(&from[kind][i][k]);
                wide_store(&to[kind][i][k], one + part * (wide_load(&to[kind][i][k]) - one));
            }
}

// Rows of the load path.
static void find_rows(const Model *model, const Work *w, ball_array rows[ROWS])
{
    LandLoad land[2];
    land_film_loads(w, land);
    const scalar *re[2] = {land[0].re, land[1].re}, *im[2] = {land[0].im, land[1].im};
    memset(rows, 0, ROWS * sizeof *rows);
    half_path_add_lands(&model->d->land_path, re, im, rows);
}

bool elastic_lands(const Model *model, const Work *w, const ball_array P, LandedJoints *joints,
                   JointShear *shear)
{
    if (!land_is_felt(w, 0) && !land_is_felt(w, 1)) return false;
    const Derived *d = model->d;
    const JointLaw *law = &rivet_table.half.law;
    const ElasticJoints *by_modes = &w->cage.elastic.joints;
    const int kind[3] = {ROW_N, ROW_M_R, ROW_M_T};
    const wide zero = wide_set(0.0);
    ball_array rows[ROWS], more_P, N_plate;
    Answers before, now;
    find_rows(model, w, rows);
    find_start(model->modes, by_modes, before.load);
    for (int k = 0; k < PACKETS * LANE_WIDTH; k += LANE_WIDTH) {
        wide_store(&more_P[k], wide_max(wide_load(&P[k]) + wide_load(&rows[ROW_DP][k]), zero));
        for (int i = 0; i < 3; i++)
            wide_store(&now.load[i][k], wide_load(&before.load[i][k]) + wide_load(&rows[kind[i]][k]));
    }
    const scalar part = second_part(&before, &now, P);
    answer(d, P, &before);
    answer(d, more_P, &now);
    if (scalar_value(part) > 0.0) sweep_again(d, &before, part, more_P, &now);

    for (int k = 0; k < PACKETS * LANE_WIDTH; k += LANE_WIDTH) {
        for (int i = 0; i < 3; i++) {
            wide load = wide_load(&now.load[i][k]) - wide_load(&before.load[i][k]);
            for (int n = 0; n < 3; n++)
                load -= law->K_0[i][n] * (wide_load(&now.move[n][k]) - wide_load(&before.move[n][k]));
            wide rivet = wide_load(&now.rivet[i][k]) - wide_load(&before.rivet[i][k]);
            if (i > 0) rivet += wide_load(&d->intact[k]) * wide_load(&rows[ROW_DP + i][k]);
            rivet += wide_load(&by_modes->rivet[i][k]);
            wide_store(&joints->load[i][k], wide_load(&by_modes->load[i][k]) + load);
            wide_store(&joints->rivet[i][k], i == 0 ? wide_max(rivet, zero) : rivet);
        }
        const wide T = wide_load(&joints->rivet[0][k]);
        wide_store(&N_plate[k], wide_max(T - wide_load(&joints->load[0][k]), zero));
    }
    const JointMotion at = {
        .u_y = by_modes->u_y, .u_z = by_modes->u_z, .T = joints->rivet[0], .N_plate = N_plate};
    joint_slip_add(model, w, &at, rows[ROW_V_R], rows[ROW_V_T], shear);
    return true;
}
