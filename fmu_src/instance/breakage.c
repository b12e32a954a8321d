// Rivets that break by their damage: see breakage.h.
#include "instance/breakage.h"

bool rivet_holds(const Parameters *p, const Breakage *broken, int k)
{
    return rivet_broken(p, broken, k) == HOLDS;
}

int rivet_broken(const Parameters *p, const Breakage *broken, int k)
{
    if (broken->place[k] != HOLDS) return broken->place[k];
    return p->rivet.intact[k] ? HOLDS : BROKEN_BY_HOST;
}

void breakage_apply(const Breakage *broken, Parameters *p)
{
    for (int k = 0; k < Z; k++)
        if (broken->place[k] != HOLDS) p->rivet.intact[k] = 0;
}

bool breakage_update(const Parameters *p, double t, const double fit_eff[Z], const FatigueChannel head[Z],
                     const FatigueChannel mid[Z], Breakage *broken)
{
    broken->latest = 0;
    if (p->scene.breakage != SWITCH_ON) return false;
    for (int k = 0; k < Z; k++) {
        if (!rivet_holds(p, broken, k)) continue;
        const FatigueLaw law = fatigue_law(p, k), in_hole = fatigue_law_in_hole(&law, fit_eff[k]);
        const double at_head = fatigue_damage(&head[k], &law), in_middle = fatigue_damage(&mid[k], &in_hole);
        if (!(at_head >= 1.0 || in_middle >= 1.0)) continue;
        broken->place[k] = at_head >= in_middle ? BROKEN_HEAD : BROKEN_MIDDLE;
        broken->time[k] = t;
        broken->latest++;
    }
    return broken->latest > 0;
}

bool breakage_is_valid(const Breakage *broken, double t_start, double t)
{
    bool fine = broken->latest >= 0 && broken->latest <= Z;
    for (int k = 0; k < Z; k++) {
        const int place = broken->place[k];
        const double time = broken->time[k];
        fine &= place == HOLDS
                    ? time == 0.0
                    : (place == BROKEN_HEAD || place == BROKEN_MIDDLE) && time >= t_start && time <= t;
    }
    return fine;
}
