"""The manipulator as textbooks draw it, from its Denavit-Hartenberg table or its bodies' positions.

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

Of a model by positions:

    ways          the straight pieces that lead to a body: rods, slides
    placed_pose   a pose and a view in which they stand apart
    placed_springs springs and dampers between the points that they act on
    placed_bodies the picture

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
    from dynsolve.draw.scene import Scene
    from dynsolve.problem.model import Problem
    from dynsolve.robot.model import Robot


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

    The same problem gives the same bytes.  Raises UsageError for a model by matrices or energies, and
    for PDF and PNG where the extra `pdf` is not installed.

    >>> import dynsolve
    >>> draw(dynsolve.load("planar-2r"))[:4]
    b'<svg'
    """
    from dynsolve.draw.svg import to_svg

    if not is_drawn(problem.robot):
        raise UsageError("there is no picture: neither a table nor positions say where anything is")
    drawn = _scene(problem, star)
    if format is PictureFormat.LATEX:
        from dynsolve.draw.latex import to_latex_picture

        return f"{to_latex_picture(drawn)}\n".encode()
    svg = to_svg(drawn)
    if format is PictureFormat.SVG:
        return svg.encode()
    from dynsolve.draw.convert import to_pdf, to_png

    return to_pdf(svg, drawn.title, drawn.description) if format is PictureFormat.PDF else to_png(svg)


def is_drawn(robot: Robot) -> bool:
    """Whether a file says where anything is: a table, or the positions of bodies."""
    return robot.has_table or bool(robot.bodies)


def _scene(problem: Problem, star: bool) -> Scene:
    from dynsolve.draw.placed_bodies import placed_scene
    from dynsolve.draw.scene import scene

    return (scene if problem.robot.has_table else placed_scene)(problem, star)


def picture(problem: Problem, *, star: bool = True) -> Picture:
    """The picture as a block of a document."""
    from dynsolve.document import Picture
    from dynsolve.draw.latex import to_latex_picture
    from dynsolve.draw.svg import to_svg

    drawn = _scene(problem, star)
    return Picture(to_svg(drawn), drawn.caption, to_latex_picture(drawn))
