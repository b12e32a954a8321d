"""Pictures of the pages as SVG."""

import io
import re

import matplotlib.pyplot as plt


def save_svg(figure, path):
    """Write a figure, its coordinates to 0.1 pt and its words as they are, and close it."""
    text = io.StringIO()
    with plt.rc_context({"svg.fonttype": "none", "svg.hashsalt": path.stem}):
        figure.savefig(text, format="svg", metadata={"Date": None})
    plt.close(figure)
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(
        re.sub(r">[^<]*<|(\d\.\d)\d+", lambda found: found[1] or found[0], text.getvalue()), encoding="utf-8"
    )
