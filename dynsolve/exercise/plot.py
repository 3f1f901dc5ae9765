"""How hard the variants of a course are, as a picture: each count beside the median of its family."""

from __future__ import annotations

import io
from collections.abc import Mapping, Sequence
from importlib.util import find_spec
from statistics import median

from dynsolve.exercise.hardness import COUNTS, Hardness

Drawn = Mapping[tuple[str, str], Sequence[Hardness]]
"""What was counted, a value a student, by problem and answer."""


def is_there() -> bool:
    """Whether matplotlib is installed, which the extra `plot` brings."""
    return find_spec("matplotlib") is not None


def to_svg(drawn: Drawn) -> bytes:
    """A row an answer, a column a count: the share of the median that each student's variant has.

    The same values give the same bytes.
    """
    import matplotlib as mpl
    from matplotlib.figure import Figure

    with mpl.rc_context({"svg.hashsalt": "dynsolve", "font.size": 8}):
        figure = Figure(figsize=(9.0, 1.0 + 0.3 * len(drawn)), layout="constrained")
        for place, axes in enumerate(figure.subplots(1, len(COUNTS), sharey=True, squeeze=False)[0]):
            for row, counted in enumerate(drawn.values()):
                own = [each.counts[place] for each in counted]
                middle = median(own) or 1
                axes.plot([one / middle for one in own], [row] * len(own), "k|", markersize=8)
            axes.set_title(COUNTS[place])
            axes.axvspan(0.9, 1.1, color="0.92")
            axes.set_xlabel("share of the median")
            axes.set_yticks(range(len(drawn)), [f"{problem}: {answer}" for problem, answer in drawn])
            axes.invert_yaxis()
        out = io.BytesIO()
        figure.savefig(out, format="svg", metadata={"Date": None})
    return out.getvalue()
