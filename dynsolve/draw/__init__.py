"""The manipulator as textbooks draw it, from its Denavit-Hartenberg table or its bodies' positions.

From the table to a pose:

    skeleton      how long every symbol is drawn; where frames and links are for given values of the
                  coordinates; which way is up, and whether the robot moves in a plane
    mass_centers  where the mass centres are; how large the uniform bodies on the links are, and how they
                  lie
    vectors       geometry, and how space is laid on paper
    poses         a pose seen from somewhere, and how good that is; axes of frames, mass centres, gravity,
                  springs
    pose_search   the pose and the view in which nothing hides anything, also where some formulas are 0 or a
                  linkage is closed

What is drawn of it:

    parts         where the joints stand along the chain, and the links between them
    solids        the joints as paths, the tubes between them and the bodies, with all else from back to
                  front; drums, blocks and balls
    joint_angles  the angles of the joints, from the line from which each is measured
    forces        forces from outside, each at its point
    drawn_points  the pose of a drawing that a table was found from, and the letters of its points
    closings      what constraints hold points to: walls, pivots, joints where ends meet
    lengths       lengths with their heads; the world where the base is moved in it or leans
    labels        where labels stand, and which places on paper are taken
    scene         all of it together, and how thick bodies are

Of a model by positions:

    placed_pose   a pose and a view in which the straight pieces that lead to bodies stand apart
    placed_bodies the picture, with springs and dampers between the points that they act on

`figure` has drawings beside a step, the arm in a pose, and how a picture is written down as SVG, LaTeX, PDF
and PNG.  `paths` are lines and areas with their colours, and how wide letters are.

To draw one more thing, make its paths in a file of the second list, and add them in
`scene`.  To add a file format, write it in `figure`, and add it to `PictureFormat`,
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
    from dynsolve.draw.figure import to_svg

    if not is_drawn(problem.robot):
        raise UsageError("there is no picture: neither a table nor positions say where anything is")
    drawn = _scene(problem, star)
    if format is PictureFormat.LATEX:
        from dynsolve.draw.figure import to_latex_picture

        return f"{to_latex_picture(drawn)}\n".encode()
    svg = to_svg(drawn)
    if format is PictureFormat.SVG:
        return svg.encode()
    from dynsolve.draw.figure import to_pdf, to_png

    return to_pdf(svg, drawn.title, drawn.description) if format is PictureFormat.PDF else to_png(svg)


def is_drawn(robot: Robot) -> bool:
    """Whether a file says where anything is: a table, or the positions of bodies."""
    return robot.has_table or bool(robot.bodies)


def _scene(problem: Problem, star: bool, frames: bool = True) -> Scene:
    from dynsolve.draw.placed_bodies import placed_scene
    from dynsolve.draw.scene import scene

    return scene(problem, star, frames) if problem.robot.has_table else placed_scene(problem, star)


def picture(problem: Problem, *, star: bool = True, frames: bool = True) -> Picture:
    """The picture as a block of a document, of an arm with its `frames` or without them."""
    from dynsolve.document import Picture
    from dynsolve.draw.figure import to_latex_picture, to_svg

    drawn = _scene(problem, star, frames)
    return Picture(to_svg(drawn), drawn.caption, to_latex_picture(drawn))
