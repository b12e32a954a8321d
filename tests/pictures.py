"""What must not be seen in a picture: texts that lie on each other, texts that the edge cuts."""

from itertools import combinations

from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.text import Text

PIXEL = 1.0  # boxes that touch by less than this many pixels do not overlap


def drawn_texts(figure):
    """The texts that a figure shows, with their boxes in pixels; a tick's label only while its tick is in view."""
    renderer = figure.canvas.get_renderer()
    axes = [child for ax in figure.axes for child in (ax, *ax.child_axes)]
    ticks, shown = set(), []
    for ax in axes:
        for axis in (ax.xaxis, ax.yaxis):
            for tick in (*axis.get_major_ticks(), *axis.get_minor_ticks()):
                ticks |= {id(tick.label1), id(tick.label2)}
            if ax.get_visible() and ax.axison and axis.get_visible():
                shown += [label for tick in axis._update_ticks() for label in (tick.label1, tick.label2)]
    shown += [text for text in figure.findobj(Text) if id(text) not in ticks]
    shown = [text for text in dict.fromkeys(shown) if text.get_visible() and text.get_text().strip()]
    return [(text, Text.get_window_extent(text, renderer)) for text in shown]  # of an annotation without its arrow


def faults(figure):
    """Sentences about texts that overlap or stick out; none if the picture is in order."""
    FigureCanvasAgg(figure).draw()
    texts, edge = drawn_texts(figure), figure.bbox
    for (one, a), (other, b) in combinations(texts, 2):
        width, height = min(a.x1, b.x1) - max(a.x0, b.x0), min(a.y1, b.y1) - max(a.y0, b.y0)
        if width > PIXEL and height > PIXEL:
            yield f"{one.get_text()!r} and {other.get_text()!r} overlap by {width:.0f} x {height:.0f} pixels"
    for text, box in texts:
        if box.x0 < edge.x0 - PIXEL or box.y0 < edge.y0 - PIXEL or box.x1 > edge.x1 + PIXEL or box.y1 > edge.y1 + PIXEL:
            yield f"{text.get_text()!r} is cut"
        title = text.get_text().strip()
        if title.split("\n")[0].endswith((":", "·", ",")):
            yield f"{title!r} ends in a dangling sign"
