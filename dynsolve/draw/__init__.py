"""The manipulator as textbooks draw it, from its Denavit-Hartenberg table.

From the table to a pose:

    drawn_lengths how long every symbol is drawn
    orientation   which way is up, and whether the robot moves in a plane
    skeleton      where frames and links are for given values of the coordinates
    mass_centers  where the mass centres are
    clearance     how clear of all else a mass centre is on paper
    last_links    the link that no origin of a modified table ends
    loops         what closes a linkage that its table opens
    view          how space is laid on paper
    pose          a pose seen from somewhere, and how good that is
    pose_search   the pose and the view in which nothing hides anything
    held_pose     the same among the poses where some formulas are 0

What is drawn of it:

    parts         where the joints stand along the chain, and the links between them
    bodies        how large the uniform bodies on the links are, and how they lie
    solids        the joints as paths, with all else from back to front: `links` the tubes between them,
                  `body_solids` the bodies; `primitives` drums, blocks and balls
    annotate      axes of frames, mass centres, gravity
    world_frame   the world where the base is moved in it or leans
    joint_angles  the angles of the joints, from the line from which each is measured
    springs       springs at joints
    lengths       lengths with their heads
    thicknesses   how thick bodies are
    labels        where labels stand; `typography` how wide they are
    scene         all of it together

Beside a step:

    figure        drawings beside a step, of labelled lines and angles
    arm_figure    the arm in a pose, with arrows at its tip

How it is written down: `svg`, `latex`, and `convert` for PDF and PNG.  What all of it is
made of: `vectors` (geometry), `paths` (lines and areas with their colours), `occupied` (which
places on paper are taken).

To draw one more thing, make its paths in a file of the second list, and add them in
`scene`.  To add a file format, write its file beside `svg`, and add it to `PictureFormat`,
`SUFFIXES` and `draw` below.

Nothing but the reports and the command `draw` imports this package.
"""

from __future__ import annotations

from enum import StrEnum
from typing import TYPE_CHECKING

from dynsolve.errors import UsageError

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

    The same problem gives the same bytes.  Raises UsageError for a model without a table, and
    for PDF and PNG where the extra `pdf` is not installed.

    >>> import dynsolve
    >>> draw(dynsolve.load("planar-2r"))[:4]
    b'<svg'
    """
    from dynsolve.draw.scene import scene
    from dynsolve.draw.svg import to_svg

    if not problem.robot.has_table:
        raise UsageError(
            "there is no picture of a model without a table: it says nothing of links and joints"
        )
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
    return Picture(to_svg(drawn), drawn.caption, to_latex_picture(drawn))
