// The limits are those at the head of escape.h.
#include "solver/escape.h"

#include <math.h>
#include <stdio.h>

static double largest(const double *delta)
{
    double most = delta[0];
    for (int j = 1; j < Z; j++) most = delta[j] > most ? delta[j] : most;
    return most;
}

// Contacts; pressed: the deepest approach in a pocket.
static Escape contact_find(const Model *model, const Work *w, double *pressed)
{
    const double *delta[] = {w->delta_i, w->delta_e, w->delta_c[0], w->delta_c[1]};
    const double limit = 0.25 * model->p->bearing.D;
    double most[4];
    for (int i = 0; i < 4; i++) most[i] = largest(delta[i]);
    *pressed = most[2] > most[3] ? most[2] : most[3];
    for (int i = 0; i < 4; i++)
        for (int j = 0; most[i] > limit && j < Z; j++)
            if (delta[i][j] == most[i])
                return (Escape){ESCAPE_CONTACT, 4 * j + (i < 2 ? i : 2), most[i], limit};
    return (Escape){ESCAPE_NONE, 0, 0.0, limit};
}

static Escape cage_find(const Model *model, const Work *w)
{
    const Parameters *p = model->p;
    const double across = model->d->play + 0.25 * (p->cage.D_o - p->cage.D_i);
    for (int h = 0; h < 2; h++) {
        const double *x = w->half[h].x, at = x[0] - w->outer_x[0];
        const double e_y = x[1] - w->outer_x[1] - at * w->outer_gamma,
                     e_z = x[2] - w->outer_x[2] + at * w->outer_beta;
        const double e_2 = e_y * e_y + e_z * e_z;
        if (e_2 > across * across) return (Escape){ESCAPE_CAGE, h, sqrt(e_2), across};
    }
    return (Escape){ESCAPE_NONE, 0, 0.0, across};
}

static Escape balls_find(const Model *model, const Work *w)
{
    for (int j = 0; j < Z; j++) {
        const int k = (j + 1) % Z;
        const double x = w->x[j] - w->x[k], y = w->r[j] * w->cos_theta[j] - w->r[k] * w->cos_theta[k],
                     z = w->r[j] * w->sin_theta[j] - w->r[k] * w->sin_theta[k];
        const double distance_2 = x * x + y * y + z * z, limit = model->d->R[j] + model->d->R[k];
        if (distance_2 < limit * limit) return (Escape){ESCAPE_BALLS, j, sqrt(distance_2), limit};
    }
    return (Escape){ESCAPE_NONE, 0, 0.0, 0.0};
}

// Neighbours overlap only where a ball is deep in the bar between two pockets.
Escape escape_find(const Model *model, const Work *w)
{
    double pressed;
    Escape found = cage_find(model, w);
    if (found.kind != ESCAPE_NONE) return found;
    const Escape contact = contact_find(model, w, &pressed);
    if (pressed > 0.125 * model->d->bar) found = balls_find(model, w);
    return found.kind != ESCAPE_NONE ? found : contact;
}

void escape_text(const Escape *escape, char *text, size_t size)
{
    static const char *const WHERE[] = {"inner race", "outer race", "pocket"};
    const int j = escape->element + 1;
    switch (escape->kind) {
    case ESCAPE_BALLS:
        snprintf(text, size,
                 "ball[%d] and ball[%d] overlap: their centres are %.4g m apart, at least %.4g m is possible",
                 j, j % Z + 1, escape->value, escape->limit);
        return;
    case ESCAPE_CAGE:
        snprintf(text, size,
                 "cage half %d leaves the bearing: it is %.4g m off the outer ring's axis; its clearance and "
                 "(cage.D_o - cage.D_i)/4 allow %.4g m",
                 j, escape->value, escape->limit);
        return;
    case ESCAPE_CONTACT:
        snprintf(text, size,
                 "ball[%d] passes through its %s: it is %.4g m deep in it; bearing.D/4 = %.4g m is possible",
                 escape->element / 4 + 1, WHERE[escape->element % 4], escape->value, escape->limit);
        return;
    case ESCAPE_NONE: break;
    }
    *text = '\0';
}
