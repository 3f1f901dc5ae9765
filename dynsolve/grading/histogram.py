"""A histogram of marks: inline SVG that is read without a script, and by a screen reader."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from fractions import Fraction
from html import escape
from math import floor

from dynsolve.answers.marking.policy import shown
from dynsolve.grading.files import decimal
from dynsolve.render.prose import visible

BINS = 10
_WIDTH, _HEIGHT, _FOOT = 44, 150, 170


def histogram(title: str, marks: Sequence[Fraction], of: Fraction) -> str:
    """A figure of how many earned which share of `of`, in ten bins; nothing where there is nothing."""
    if not of or not marks:
        return ""
    bins = Counter(min(floor(one / of * BINS), BINS - 1) for one in marks)
    top = max(bins.values())
    labels = [
        f"{decimal(of * i / BINS)} to {decimal(of * (i + 1) / BINS)} marks: {bins[i]}" for i in range(BINS)
    ]
    bars = "".join(_bar(i, bins[i], _HEIGHT * bins[i] / top, labels[i]) for i in range(BINS))
    mean = float(sum(marks, Fraction(0)) / len(marks))
    who = "1 student" if len(marks) == 1 else f"{len(marks)} students"
    caption = f"{title}: {who}, mean {mean:.2f} of {shown(of)}"
    said = escape(visible(caption))
    return (
        f'<figure><svg class="bars" viewBox="0 0 {_WIDTH * BINS + 10} 190" role="img" '
        f'aria-label="{said}. {"; ".join(labels)}">{bars}</svg>\n<figcaption>{said}</figcaption></figure>\n'
    )


def _bar(place: int, count: int, height: float, label: str) -> str:
    left, middle = place * _WIDTH + 4, place * _WIDTH + _WIDTH // 2
    return (
        f'<g><title>{label}</title><rect x="{left}" y="{_FOOT - height:.1f}" width="{_WIDTH - 8}" '
        f'height="{height:.1f}"/><text x="{middle}" y="{_FOOT - 5 - height:.1f}">{count or ""}</text>'
        f'<text x="{middle}" y="186">{100 * place // BINS} %</text></g>'
    )
