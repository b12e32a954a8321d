// Events: conditions from the results of one evaluation, see events.h.
#include "instance/events.h"

#include "numbers/elementary.h"
#include "numbers/saved_numbers.h"
#include "physics/hertz.h"
#include "physics/land_film.h"
#include "physics/ring_fit.h"
#include "rivet/rivet_rom.h"

#include <stdio.h>

// Counts an element whose value is above its limit; the event keeps the one with the largest value/limit.
static void add(Event *event, int element, double value, double limit)
{
    if (!(value > limit)) return;
    if (event->count++ > 0 && value * event->limit <= event->value * limit) return;
    event->element = element;
    event->value = value;
    event->limit = limit;
}

static void lands(const Model *model, const Work *w, Event *event)
{
    for (int h = 0; h < 2; h++) {
        const Rotor *half = &w->half[h];
        const double x_land = h == 0 ? -model->p->cage.land_x : model->p->cage.land_x;
        const double along = half->x[0] + x_land * half->a[0] - w->outer_x[0];
        const double e_y = half->x[1] + x_land * half->a[1] - (w->outer_x[1] + along * w->outer_gamma);
        const double e_z = half->x[2] + x_land * half->a[2] - (w->outer_x[2] - along * w->outer_beta);
        add(event, h, sqrt(e_y * e_y + e_z * e_z), land_clearance(model->d, half->s + w->frame_omega));
    }
}

// Radial distance of a ball from the middle of the cage's section, in the frame of the half from which the
// ball is farther.
static void pockets(const Model *model, const Work *w, Event *event)
{
    const double middle = 0.25 * (model->p->cage.D_o + model->p->cage.D_i);
    const double reach = 0.25 * (model->p->cage.D_o - model->p->cage.D_i);
    for (int j = 0; j < Z; j++) {
        double max = 0.0;
        for (int h = 0; h < 2; h++) {
            const Rotor *half = &w->half[h];
            const double p[3] = {w->x[j] - half->x[0], w->r[j] * w->cos_theta[j] - half->x[1],
                                 w->r[j] * w->sin_theta[j] - half->x[2]};
            double radial = 0.0;
            for (int i = 0; i < 3; i++)
                radial +=
                    p[i] * (half->b_y[i] * model->d->pocket_cos[j] + half->b_z[i] * model->d->pocket_sin[j]);
            max = scalar_max(max, fabs(radial - middle));
        }
        add(event, j, max, reach);
    }
}

// |sin| of the contact angle against the ring's axis.
static double contact_along(const Work *w, bool outer, int j)
{
    if (outer) return fabs(w->n_ex[j]);
    const double *a = w->ring.a, c = w->cos_theta[j], s = w->sin_theta[j];
    return fabs(w->n_ix[j] * a[0] + w->n_ir[j] * (a[1] * c + a[2] * s) + w->n_it[j] * (a[2] * c - a[1] * s));
}

// Angle from the groove's bottom to the end of the contact ellipse [rad].
static double reach(const Race *race, double along, double Q)
{
    return asin(scalar_min(along, 1.0)) + race->hertz.a * portable_cbrt(Q) / race->R_m;
}

double ellipse_reach(const Model *model, const Work *w, bool outer, int j)
{
    const double Q = outer ? w->Q_e[j] : w->Q_i[j];
    return Q > 0.0 ? reach(outer ? &model->d->outer : &model->d->inner, contact_along(w, outer, j), Q) : 0.0;
}

static void races(const Model *model, const Work *w, Event *cut, Event *overpressure)
{
    const double D = model->p->bearing.D, p_limit = model->p->bearing.p_limit;
    for (int outer = 0; outer < 2; outer++) {
        const Race *race = outer ? &model->d->outer : &model->d->inner;
        const double *Q = outer ? w->Q_e : w->Q_i;
        const double height = outer ? model->p->bearing.h_e : model->p->bearing.h_i;
        const double edge = acos(1.0 - height * D / race->r_g);
        double along[Z], along_max = 0.0, Q_max = 0.0;
        for (int j = 0; j < Z; j++) {
            along[j] = contact_along(w, outer, j);
            along_max = scalar_max(along_max, along[j]);
            Q_max = scalar_max(Q_max, Q[j]);
        }
        if (reach(race, along_max, Q_max) <= edge && hertz_pressure(&race->hertz, Q_max) <= p_limit)
            continue;  // no ball can be beyond a limit
        for (int j = 0; j < Z; j++) {
            if (!(Q[j] > 0.0)) continue;
            add(cut, 2 * j + outer, reach(race, along[j], Q[j]), edge);
            add(overpressure, 2 * j + outer, hertz_pressure(&race->hertz, Q[j]), p_limit);
        }
    }
}

static void joints(const Model *model, const Work *w, Event *event)
{
    for (int k = 0; k < Z; k++) add(event, k, w->u_x[k], model->d->P[k] / model->d->k_plate);
}

static void clearance(const Model *model, Event *event)
{
    const double growth = ring_fit_growth(&model->d->fit, ring_fit_speed(model->ring_load));
    add(event, 0, 2.0 * growth - model->p->bearing.P_d, 0.0);
}

static void rivets(const Parameters *p, const double head_peak[Z], const double mid_peak[Z], Event *yield,
                   Event *overload)
{
    for (int k = 0; k < Z; k++) {
        add(yield, k, scalar_max(head_peak[k], mid_peak[k]), rivet_table.yield_rivet);
        add(overload, k, mid_peak[k], p->fatigue.sigma_m);
    }
}

// Mean error of equal steps from which on their results may be wrong (integrator.c).
static const double LARGEST_ERROR = 0.7;

void events_now(const Model *model, const Work *w, const MotionLag *lag, double error, double force_peak,
                const double head_peak[Z], const double mid_peak[Z], Event now[EVENT_COUNT])
{
    memset(now, 0, EVENT_COUNT * sizeof *now);
    if (model->d->guided) lands(model, w, &now[EVENT_LAND_CONTACT]);
    pockets(model, w, &now[EVENT_POCKET_EXIT]);
    races(model, w, &now[EVENT_ELLIPSE_CUT], &now[EVENT_OVERPRESSURE]);
    joints(model, w, &now[EVENT_JOINT_OPEN]);
    rivets(model->p, head_peak, mid_peak, &now[EVENT_RIVET_YIELD], &now[EVENT_RIVET_OVERLOAD]);
    clearance(model, &now[EVENT_NO_CLEARANCE]);
    add(&now[EVENT_STEP_TOO_LONG], 0, error, LARGEST_ERROR);
    if (rivet_table.half.yield_force > 0.0)
        add(&now[EVENT_CAGE_YIELD], 0, force_peak, rivet_table.half.yield_force);
    now[EVENT_MOTION_LAG] = (Event){lag->count, lag->motion, lag->x, lag->v};
}

Event event_of_energy(double residual, double held, double exchanged, double lost, double lost_now,
                      double jumped)
{
    const double OF_LOST = 0.02, OF_HELD = 0.01, OF_EXCHANGED = 0.004, off = fabs(residual);
    if (lost_now < 0.0) return (Event){1, 1, lost_now, 0.0};
    const double moved = scalar_max(OF_HELD * held, OF_EXCHANGED * exchanged);
    const double limit = scalar_max(OF_LOST * lost, moved) + jumped;
    return (Event){!(off <= limit), 0, off, limit};
}

bool event_onset(EventState *state, EventKind kind, const Event *now)
{
    const bool onset = now->count > 0 && !state->active[kind];
    state->active[kind] = now->count > 0;
    if (!onset) return false;
    state->onsets[kind] += 1.0;
    int exponent;
    return frexp(state->onsets[kind], &exponent) == 0.5;  // a power of two
}

bool event_state_is_valid(const EventState *state)
{
    bool fine = true;
    for (int kind = 0; kind < EVENT_COUNT; kind++) {
        const int active = state->active[kind];
        fine &= value_is_count(state->onsets[kind]) &&
                (active == 0 || (active == 1 && state->onsets[kind] > 0.0));
    }
    return fine;
}

// The input at a place in Inputs.
static const Variable *input_at(int place)
{
    const size_t offset = (size_t)place * sizeof(double);
    const Variable *v = VARIABLES;
    while (v->causality != CAUSALITY_INPUT || v->offset != offset) v++;
    return v;
}

static void motion_text(const Event *now, char *text, size_t size)
{
    const Variable *x = input_at(MOTION[now->element].position), *v = input_at(MOTION[now->element].velocity);
    snprintf(text, size,
             "%s and %s jumped or contradict each other: they are %.4g %s and %.4g %s off the motion before, "
             "which catches up over %g s or more",
             x->name, v->name, now->value, x->unit, now->limit, v->unit, CATCH_UP_TIME);
}

// Messages on events: of half, ball or rivet `element + 1`, value and limit.
static const char *const OF_ELEMENT[EVENT_COUNT] = {
    [EVENT_LAND_CONTACT] =
        "cage half %d touches the outer ring: its land is %.4g m off centre, cage.guide_clearance/2 = %.4g m",
    [EVENT_POCKET_EXIT] = "ball[%d] leaves its pocket: %.4g m off the middle of the cage's section, "
                          "(cage.D_o - cage.D_i)/4 = %.4g m",
    [EVENT_JOINT_OPEN] = "rivet[%d]: the joint opens by %.4g m; its preload holds it closed to %.4g m",
    [EVENT_RIVET_YIELD] =
        "rivet[%d] yields: %.4g Pa against a yield stress of %.4g Pa; the stress is that of an elastic rivet",
    [EVENT_RIVET_OVERLOAD] = "rivet[%d] would tear: %.4g Pa in its middle against a tensile strength "
                             "(fatigue.sigma_m) of %.4g Pa; the stress is that of an elastic rivet",
};

// Of value and limit alone.
static const char *const OF_ALL[EVENT_COUNT] = {
    [EVENT_CAGE_YIELD] =
        "the cage yields: a ball pushes its pocket with %.4g N, and a half of the ribbon begins to yield "
        "under %.4g N; its displacements are those of an elastic sheet",
    [EVENT_ENERGY_OFF] =
        "bearing.energy_residual of %.4g J passes %.4g J, 2 %% of the energy lost: the results may "
        "be wrong; a smaller solver.tol or solver.step may help",
};

void event_text(EventKind kind, const Event *now, char *text, size_t size)
{
    const int j = now->element / 2 + 1;
    const char race = now->element % 2 == 0 ? 'i' : 'e';
    switch (kind) {
    case EVENT_ELLIPSE_CUT:
        snprintf(text, size,
                 "ball[%d]: the contact ellipse reaches to %.4g rad, over the shoulder of bearing.h_%c at "
                 "%.4g rad",
                 j, now->value, race, now->limit);
        return;
    case EVENT_OVERPRESSURE:
        snprintf(text, size,
                 "ball[%d].p_%c = %.4g Pa exceeds bearing.p_limit = %.4g Pa: permanent deformation is not "
                 "modelled",
                 j, race, now->value, now->limit);
        return;
    case EVENT_NO_CLEARANCE:
        snprintf(text, size,
                 "the bearing has no clearance left: bearing.clearance = %.4g m at the present speed, "
                 "temperatures and fits",
                 -now->value);
        return;
    case EVENT_RIVET_BREAK:  // reported one by one, with its place (bearing.c)
    case EVENT_STEP_TOO_LONG:
        snprintf(text, size,
                 "solver.method = fixed: the steps' errors are %.3g of what the default method accepts, in "
                 "the mean "
                 "over 10 ms, above %g: the results may be wrong; set solver.step to %.2g of "
                 "solver.step_size or less",
                 now->value, now->limit, portable_cbrt(0.5 * now->limit / now->value));
        return;
    case EVENT_ENERGY_OFF:
        if (now->element != 1) break;
        snprintf(text, size,
                 "bearing.power_loss: %.4g J were lost in the last step, at least %.4g J is possible",
                 now->value, now->limit);
        return;
    case EVENT_MOTION_LAG: motion_text(now, text, size); return;
    default: break;
    }
    if (OF_ALL[kind])
        snprintf(text, size, OF_ALL[kind], now->value, now->limit);
    else
        snprintf(text, size, OF_ELEMENT[kind], now->element + 1, now->value, now->limit);
}
