"""The manipulator as textbooks draw it, from its Denavit-Hartenberg table.

numbers   how long every symbol is drawn
skeleton  where frames, legs and mass centres are at a pose
pose      the pose and the view in which nothing hides anything
parts     where cylinders, boxes and links stand along the chain
solids    those as paths, from back to front
annotate  axes of frames, joint variables, lengths, mass centres, gravity
labels    where labels stand
scene     all of it; `svg`, `latex` and `convert` write it down
"""

from __future__ import annotations

from enum import StrEnum
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from dynsolve.document import Picture
    from dynsolve.problem.model import Problem


class PictureFormat(StrEnum):
    """The forms of a picture."""

    SVG = "svg"
    PDF = "pdf"
    PNG = "png"
    LATEX = "latex"


SUFFIXES = {
    ".svg": PictureFormat.SVG,
    ".pdf": PictureFormat.PDF,
    ".png": PictureFormat.PNG,
    ".tex": PictureFormat.LATEX,
}
"""What the suffix of a file says."""


def draw(problem: Problem, format: PictureFormat = PictureFormat.SVG, *, star: bool = True) -> bytes:
    """The picture of a problem's robot; `star` marks the joint variables.

    The same problem gives the same bytes.  Raises UsageError for PDF and PNG where the
    extra `pdf` is not installed.

    >>> import dynsolve
    >>> draw(dynsolve.load("planar-2r"))[:4]
    b'<svg'
    """
    from dynsolve.draw.scene import scene
    from dynsolve.draw.svg import to_svg

    drawn = scene(problem, star)
    if format is PictureFormat.LATEX:
        from dynsolve.draw.latex import to_latex_picture

        return f"{to_latex_picture(drawn)}\n".encode()
    svg = to_svg(drawn)
    if format is PictureFormat.SVG:
        return svg.encode()
    from dynsolve.draw.convert import to_pdf, to_png

    return to_pdf(svg, drawn.title, drawn.description) if format is PictureFormat.PDF else to_png(svg)


def picture(problem: Problem, *, star: bool = True) -> Picture:
    """The picture as a block of a document."""
    from dynsolve.document import Picture
    from dynsolve.draw.latex import to_latex_picture
    from dynsolve.draw.scene import scene
    from dynsolve.draw.svg import to_svg

    drawn = scene(problem, star)
    return Picture(to_svg(drawn), CAPTION, to_latex_picture(drawn))


CAPTION = "The manipulator with its frames; not to scale."
