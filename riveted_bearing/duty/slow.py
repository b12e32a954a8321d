"""Points of a mission at which the shaft turns too few times to settle or to count."""

from ..base.errors import shortlist
from ..running.runner import turns
from ..running.summary import COUNTED, SETTLED, fewer

KINDS = {  # of turns(): revolutions wanted, what happens with fewer, and the key that makes more
    "settle_turns": (SETTLED, "damage begins to count after", "parameters.start.settle"),
    "count_turns": (COUNTED, "damage of a run rests on", "simulation.t_end"),
}


def slow_warnings(parts, model):
    """Sentences on simulated points with few revolutions, where the start or chance counts; not at rest."""
    found = {
        part.name: turns(model, part.scene, part.scene.t_end)
        for part in parts
        if part.scene is not None and not part.event
    }
    for kind, (wanted, words, key) in KINDS.items():
        slow = {name: of[kind] for name, of in found.items() if fewer(of[kind], wanted)}
        if slow:
            least = min(slow.values())
            yield (
                f"{'points' if len(slow) > 1 else 'point'} {shortlist(slow, 4)}: {words} {least:.2g} revolutions of the shaft"
                f"{' or more' if len(slow) > 1 else ''}; from {wanted:g} on it is steady enough to compare ({key})"
            )
