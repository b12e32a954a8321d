// Traction of all contacts, at their middle or over slices (race_spin.h), with the films and the inlet's rolling friction.
#pragma once

#include "physics/race_spin.h"

// Packets of balls without padding, balls in the last one, and packets of contacts (race_tractions).
enum {
    WHOLE = Z / LANE_WIDTH,
    REST = Z % LANE_WIDTH,
    JOINED = REST > 0 && 2 * REST <= LANE_WIDTH,
    CONTACT_PACKETS = 2 * PACKETS - JOINED
};

// Traction with the slip at the contact's middle.
INLINE Tangential point_traction(const Parameters *p, const Contact *c, const Film *film, bool mixed)
{
    const wide slip_2 = vec_dot(c->slip, c->slip) + p->oil.v_0 * p->oil.v_0;
    const wide inv_slip = 1.0 / wide_sqrt(slip_2), s = slip_2 * inv_slip * film->inv_U;
    wide mu;
    traction_mu(p, 1, &s, &film->f_a, mixed, &mu);
    Tangential out;
    out.g = mu * c->Q * inv_slip;
    out.F_s = vec_scale(-out.g, c->slip);
    out.M = vec_cross(vec_scale(c->R, c->n), out.F_s);
    out.dissipated = -vec_dot(out.F_s, c->slip);
    out.g_spin = out.spin_dissipated = wide_set(0.0);
    return out;
}

// Films of all packets of contacts, which go through each stage together.
INLINE void race_films(const Model *model, const RaceConstants *const race[CONTACT_PACKETS],
                       const Contact *const c[CONTACT_PACKETS], bool mixed, Film film[CONTACT_PACKETS])
{
    const double U_0 = model->p->oil.U_0;
    wide ln_U[CONTACT_PACKETS], ln_Q[CONTACT_PACKETS];
    for (int i = 0; i < CONTACT_PACKETS; i++) {
        const wide U_2 = vec_dot(c[i]->roll, c[i]->roll) + U_0 * U_0;
        film[i].inv_U = 1.0 / wide_sqrt(U_2);
        film[i].U = U_2 * film[i].inv_U;
    }
    for (int i = 0; i < CONTACT_PACKETS; i++) wide_log2(film[i].U, c[i]->Q + Q_FLOOR, &ln_U[i], &ln_Q[i]);
    for (int i = 0; i < CONTACT_PACKETS; i++)
        film[i].F_R = traction_race_inlet(model->d, race[i]->rolling, film[i].U, ln_U[i], c[i]->Q, ln_Q[i]);
    for (int i = 0; i < CONTACT_PACKETS; i++)
        film[i].f_a =
            mixed ? traction_asperity_share(traction_ln_film(race[i]->ln_Lambda, ln_U[i], ln_Q[i]) +
                                            traction_ln_thermal(wide_set(model->d->ln_thermal), ln_U[i]))
                  : wide_set(0.0);
}

// Traction and the inlet's rolling friction: -F_R U/|U| at the surface, and the film's horizontal pressure
// force +F_H U/|U| through the ball's centre.
INLINE Tangential race_traction(const Model *model, const RaceConstants *race, const Contact *c,
                                const Film *film, int contacts, int balls, bool mixed, bool sliced)
{
    const vec rolling = vec_scale(film->F_R * film->inv_U, c->roll);
    Tangential out = sliced ? sliced_traction(model->p, race, c, film, contacts, balls, mixed)
                            : point_traction(model->p, c, film, mixed);
    out.F_s = vec_sub(out.F_s, rolling);
    out.M = vec_sub(out.M, vec_cross(vec_scale(c->R, c->n), rolling));
    out.F_c = vec_scale(race->horizontal, rolling);
    out.U = film->U;
    out.inlet_dissipated = vec_dot(rolling, c->slip) - vec_dot(out.F_c, c->approach);
    out.dissipated += out.inlet_dissipated;
    return out;
}

INLINE RaceConstants race_constants(const Race *race)
{
    return (RaceConstants){wide_set(race->hertz.a_delta), wide_set(0.5 / race->R_m),
                           wide_set(race->ln_Lambda), wide_set(race->rolling), wide_set(race->horizontal)};
}

// Structs of packets: those at the inner race in the first half of each packet, those at the outer race in the last half; and back.
INLINE void join_halves(size_t size, const void *inner, const void *outer, void *both)
{
    for (size_t k = 0; k < size / sizeof(wide); k++)
        ((wide *)both)[k] = wide_join(((const wide *)inner)[k], ((const wide *)outer)[k]);
}

INLINE void last_half(size_t size, const void *both, void *outer)
{
    for (size_t k = 0; k < size / sizeof(wide); k++)
        ((wide *)outer)[k] = wide_last_half(((const wide *)both)[k]);
}

// Tractions of all balls at both races.  If the last packet is at most half full, its contacts at both races share one.
INLINE void race_tractions(const Model *model, const Contact inner[PACKETS], const Contact outer[PACKETS],
                           bool mixed, bool sliced, Tangential T_i[PACKETS], Tangential T_e[PACKETS])
{
    const RaceConstants inner_race = race_constants(&model->d->inner),
                        outer_race = race_constants(&model->d->outer);
    RaceConstants both_races;
    Contact both;
    const RaceConstants *race[CONTACT_PACKETS];
    const Contact *c[CONTACT_PACKETS];
    Film film[CONTACT_PACKETS];
    for (int b = 0; b < CONTACT_PACKETS / 2; b++) {
        race[2 * b] = &inner_race, c[2 * b] = &inner[b];
        race[2 * b + 1] = &outer_race, c[2 * b + 1] = &outer[b];
    }
    if (JOINED) {
        join_halves(sizeof both_races, &inner_race, &outer_race, &both_races);
        join_halves(sizeof both, &inner[WHOLE], &outer[WHOLE], &both);
        race[2 * WHOLE] = &both_races, c[2 * WHOLE] = &both;
    }
    race_films(model, race, c, mixed, film);
    for (int b = 0; b < WHOLE; b++) {
        T_i[b] =
            race_traction(model, &inner_race, &inner[b], &film[2 * b], LANE_WIDTH, LANE_WIDTH, mixed, sliced);
        T_e[b] = race_traction(model, &outer_race, &outer[b], &film[2 * b + 1], LANE_WIDTH, LANE_WIDTH, mixed,
                               sliced);
    }
    if (JOINED) {
        T_i[WHOLE] =
            race_traction(model, &both_races, &both, &film[2 * WHOLE], 2 * REST, REST, mixed, sliced);
        last_half(sizeof *T_e, &T_i[WHOLE], &T_e[WHOLE]);
    } else if (REST > 0) {
        T_i[WHOLE] =
            race_traction(model, &inner_race, &inner[WHOLE], &film[2 * WHOLE], REST, REST, mixed, sliced);
        T_e[WHOLE] =
            race_traction(model, &outer_race, &outer[WHOLE], &film[2 * WHOLE + 1], REST, REST, mixed, sliced);
    }
}
