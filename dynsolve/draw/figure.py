r"""Drawings beside a step: a triangle, a projection; their lines, arcs and names on paper.

The arm in a pose beside a step: its body, and arrows at its tip.

A scene as LaTeX that needs no package: paths as PDF operators, labels set by LaTeX itself.

The paths go into the page as they are (`\pdfliteral` and what other engines call it),
in a `picture` environment that gives them and the labels their places.

A scene as SVG: paths, and text that stays text.

SVG as PDF and PNG, by typst, with its own fonts: the same bytes on every machine.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from html import escape
from typing import Literal

from msgspec.structs import replace

from dynsolve.document import Picture
from dynsolve.document.figures import ArmArrow, ArmFigure, Figure, FigureAngle, FigureLine, LineKind, Place
from dynsolve.draw import paths, poses
from dynsolve.draw.labels import Label, Taken, place
from dynsolve.draw.paths import SIZE, WHITE, Path, Run
from dynsolve.draw.pose_search import held_pose
from dynsolve.draw.poses import Notes, Pose
from dynsolve.draw.scene import Scene, framed, leads
from dynsolve.draw.skeleton import Leg, RobotNumbers, Skeleton, numbers, orientation, skeleton
from dynsolve.draw.solids import ground, solids
from dynsolve.draw.vectors import (
    NEAR,
    Point,
    Vector,
    along,
    cross,
    dot,
    from_to,
    length,
    moved,
    subtract,
    unit,
)
from dynsolve.errors import UsageError
from dynsolve.notation.markup import LatexPrinter, quoted
from dynsolve.notation.printing import Style
from dynsolve.notation.tree import Node, Number, Product, Quotient, Row, Sum, Words
from dynsolve.notation.tree_values import evaluate
from dynsolve.notation.unicode import printable
from dynsolve.problem.model import Problem
from dynsolve.quantities import letters
from dynsolve.robot.model import Convention, JointType, Robot

# A scene as SVG: paths, and text that stays text

FACES = (
    "'Libertinus Serif', 'STIX Two Text', STIX, STIXGeneral, Cambria, 'Times New Roman',"
    " 'Liberation Serif', 'DejaVu Serif', serif"
)


def to_svg(scene: Scene) -> str:
    """The picture as a document of SVG 1.1."""
    box = scene.frame
    wide, high = box.right - box.left, box.bottom - box.top
    width, height = number(wide), number(high)
    lines = [
        '<svg xmlns="http://www.w3.org/2000/svg"'
        f' width="{number(wide * scene.scale)}" height="{number(high * scene.scale)}"'
        f' viewBox="{number(box.left)} {number(box.top)} {width} {height}" role="img"'
        f' font-family="{FACES}" font-size="{number(SIZE)}">',
        f"<title>{text(scene.title)}</title>",
        f"<desc>{text(scene.description)}</desc>",
        f'<rect class="paper" x="{number(box.left)}" y="{number(box.top)}" width="{width}" height="{height}"'
        f' fill="{WHITE}"/>',
        '<g stroke-linecap="round" stroke-linejoin="round">',
        *map(_svg_path, scene.paths),
        "</g>",
        *map(_svg_label, scene.labels),
        "</svg>",
    ]
    return "\n".join(lines) + "\n"


def text(words: str) -> str:
    """Any words as text of XML; characters that cannot be printed are replaced."""
    return "\u00a0".join(escape(printable(part), quote=True) for part in words.split("\u00a0"))


def number(value: float) -> str:
    """A number in hundredths, without needless digits.

    >>> number(1.5), number(-0.001), number(12.0)
    ('1.5', '0', '12')
    """
    shown = f"{value:.2f}".rstrip("0").rstrip(".")
    return "0" if shown in ("-0", "") else shown


def _svg_path(path: Path) -> str:
    commands = "".join(
        letter + " ".join(f"{number(x)} {number(y)}" for x, y in points) for letter, points in path.commands
    )
    attributes = [f'd="{commands}"', f'fill="{path.fill or "none"}"']
    if path.stroke == WHITE:
        attributes.append('class="halo"')
    if path.stroke:
        attributes += [f'stroke="{path.stroke}"', f'stroke-width="{number(path.width)}"']
    if path.dashed:
        attributes.append('stroke-dasharray="4 3"')
    return f"<path {' '.join(attributes)}/>"


def _svg_label(label: Label) -> str:
    x, _ = label.box.center
    baseline = label.box.bottom - 0.34 * SIZE
    runs, shift = [], 0.0
    for run in label.line.runs:
        runs.append(_run(run, run.shift - shift))
        shift = run.shift
    return (
        f'<text x="{number(x)}" y="{number(baseline)}" text-anchor="middle" fill="{label.colour}">'
        f"{''.join(runs)}</text>"
    )


def _run(run: Run, drop: float) -> str:
    attributes = ' font-style="italic"' if run.italic else ' font-weight="bold"' if run.bold else ""
    if run.size != SIZE:
        attributes += f' font-size="{number(run.size)}"'
    if run.gap:
        attributes += f' dx="{number(run.gap)}"'
    if abs(drop) > 1e-6:
        attributes += f' dy="{number(drop)}"'
    return f"<tspan{attributes}>{text(run.text)}</tspan>"


# A scene as LaTeX that needs no package: paths as PDF operators, labels set by LaTeX itself

WIDEST = 345.0
"""The width of a page's text, in big points."""

_UNIT = 0.6
_BIG_POINT = 72.27 / 72  # in points
_OPERATORS = {"M": "m", "L": "l", "C": "c", "Z": "h"}
_SIZES = (10, 9, 8, 7, 6, 5)
"""The sizes in which TeX has its letters, in points."""

_LITERAL = r"""\ifx\dynsolveink\undefined
\def\dynsolveink#1{\special{pdf:content #1}}
\ifx\pdfextension\undefined\else\def\dynsolveink#1{\pdfextension literal{#1}}\fi
\ifx\pdfliteral\undefined\else\ifnum\pdfoutput>0 \def\dynsolveink#1{\pdfliteral{#1}}\fi\fi
\fi"""
"""pdfTeX, LuaTeX, and engines with a separate driver."""


def to_latex_picture(scene: Scene) -> str:
    """The picture as a group of LaTeX."""
    box = scene.frame
    wide, high = box.right - box.left, box.bottom - box.top
    unit = min(_UNIT * scene.scale, WIDEST / wide)
    lines = [
        rf"{{\fontsize{{{font_size(unit)}}}{{12}}\selectfont",
        _LITERAL,
        rf"\setlength{{\unitlength}}{{{unit:.3f}bp}}%",
        rf"\begin{{picture}}({number(wide)},{number(high)})%",
        rf"\put(0,0){{\dynsolveink{{q {unit:.3f} 0 0 {unit:.3f} 0 0 cm 1 j 1 J",
        *(operators for path in scene.paths for operators in _path(path, box.left, box.bottom)),
        "Q}}%",
        *(_label(label, scene) for label in scene.labels),
        r"\end{picture}}",
    ]
    return "\n".join(lines)


def font_size(unit: float) -> int:
    """The largest letters, in points, that are no larger than a picture with this unit has room for."""
    room = SIZE * unit * _BIG_POINT
    return next((size for size in _SIZES if size <= room), _SIZES[-1])


def _path(path: Path, left: float, bottom: float) -> Iterator[str]:
    """The operators of a path; y grows upwards on a page of PDF."""
    state = []
    if path.stroke:
        state.append(f"{_colour(path.stroke)} RG {number(path.width)} w")
    if path.fill:
        state.append(f"{_colour(path.fill)} rg")
    state.append("[4 3] 0 d" if path.dashed else "[] 0 d")
    yield " ".join(state)
    for letter, points in path.commands:
        places = " ".join(f"{number(x - left)} {number(bottom - y)}" for x, y in points)
        yield f"{places} {_OPERATORS[letter]}".strip()
    yield {(True, True): "B", (True, False): "S", (False, True): "f"}.get(
        (path.stroke is not None, path.fill is not None), "n"
    )


def _colour(colour: str) -> str:
    """`#ff0000` as 1 0 0."""
    return " ".join(f"{int(colour[k : k + 2], 16) / 255:.3f}" for k in (1, 3, 5))


class _Printer(LatexPrinter):
    """LaTeX that needs no package for a word, with fractions on the line, where their digits stay large."""

    def _words(self, node: Words) -> str:
        return rf"\mathrm{{{node.text}}}"

    def _quotient(self, node: Quotient) -> str:
        if isinstance(node.numerator, Sum) or isinstance(node.denominator, Sum | Product):
            return super()._quotient(node)
        return f"{self.text(node.numerator)}/{self.text(node.denominator)}"


def _formula(node: Node, style: Style) -> str:
    """A label's formula; a list of names needs no package for its commas."""
    if isinstance(node, Row):
        return r",\,".join(_formula(part, style) for part in node.parts if not isinstance(part, Words))
    return _Printer(style).text(node)


def _label(label: Label, scene: Scene) -> str:
    x, y = label.box.center
    place = f"{number(x - scene.frame.left)},{number(scene.frame.bottom - y)}"
    formula = _formula(label.node, scene.style)
    return (
        rf"\put({place}){{\makebox(0,0){{\dynsolveink{{{_colour(label.colour)} rg}}"
        rf"${formula}$\dynsolveink{{0 g}}}}}}%"
    )


UNIT = 54.0
"""Picture units for 1 of a figure."""

_ARC = 30.0
_POINT = 3.6


def drawn(figure: Figure, style: Style) -> Picture:
    """A figure as a block of a document.

    >>> from dynsolve.notation.tree import Symbol
    >>> line = FigureLine((0.0, 0.0), (2.0, 1.0), LineKind.LENGTH, Symbol("l1"))
    >>> drawn(Figure("A link.", (line,)), Style()).svg[:4]
    '<svg'
    """
    scene = figure_scene(figure, style)
    return Picture(to_svg(scene), figure.caption, to_latex_picture(scene))


def figure_scene(figure: Figure, style: Style) -> Scene:
    """The lines and arcs of a figure with their names in places of their own."""
    notes = Notes(style, Taken())
    for line in sorted(figure.lines, key=lambda line: line.kind is LineKind.LENGTH):
        notes.draw(*_line(line))
    for angle in figure.angles:
        notes.draw(*_angle(angle))
    for at in figure.points:
        notes.draw(Path(paths.circle(_on_paper(at), _POINT), None, fill=paths.BLACK))
    for line in figure.lines:
        _name_line(line, notes)
    for angle in figure.angles:
        _name_angle(angle, notes)
    return _with_labels(figure.caption, notes)


def _with_labels(caption: str, notes: Notes, under: tuple[Path, ...] = ()) -> Scene:
    labels = place(notes.wanted, notes.taken)
    lines = (*under, *notes.paths, *leads(labels))
    return Scene("", caption, caption, lines, labels, framed(lines, labels), notes.style)


_LOOKS = {
    LineKind.AXIS: (paths.FRAME, 1.4),
    LineKind.LENGTH: (paths.BLACK, 2.2),
    LineKind.HELP: (paths.GREY, 1.0),
}


def _line(line: FigureLine) -> Iterator[Path]:
    a, b = _on_paper(line.start), _on_paper(line.end)
    colour, width = _LOOKS[line.kind]
    yield Path(paths.line(a, b), colour, width, dashed=line.kind is LineKind.HELP)
    if line.kind is LineKind.AXIS:
        yield Path(paths.head(b, from_to(a, b)), None, fill=colour)


def _name_line(line: FigureLine, notes: Notes) -> None:
    if line.name is None:
        return
    a, b = _on_paper(line.start), _on_paper(line.end)
    colour, _ = _LOOKS[line.kind]
    along = from_to(a, b)
    if line.kind is LineKind.AXIS:
        notes.label(line.name, [b], along, colour, "axis")
        return
    anchors = [moved(a, along, part) for part in (0.5, 0.4, 0.6, 0.3, 0.7)]
    colour = paths.BLACK if line.kind is LineKind.HELP else colour
    notes.label(line.name, anchors, (along[1], -along[0]), colour, "length")


def _angle(angle: FigureAngle) -> Iterator[Path]:
    """An arc with a head at its end."""
    radius = _radius(angle)
    size = angle.end - angle.start
    short = angle.end - math.copysign(min(6.0 / radius, abs(size) / 2), size)
    tip, before = (_on_arc(angle, t) for t in (angle.end, short))
    center = _on_paper(angle.at)
    yield Path(paths.arc(center, (radius, 0.0), (0.0, -radius), angle.start, short), paths.VARIABLE, 1.4)
    yield Path(paths.head(tip, from_to(before, tip), 8.0), None, fill=paths.VARIABLE)


def _name_angle(angle: FigureAngle, notes: Notes) -> None:
    size = angle.end - angle.start
    anchors = [_on_arc(angle, angle.start + part * size) for part in (0.5, 0.35, 0.65)]
    toward = from_to(_on_paper(angle.at), anchors[0])
    notes.label(angle.name, anchors, toward, paths.VARIABLE, "variable")


def _radius(angle: FigureAngle) -> float:
    """The radius of an arc; of a small angle it is larger."""
    return _ARC if abs(angle.end - angle.start) > 0.6 else _ARC + 18.0


def _on_arc(angle: FigureAngle, t: float) -> Point:
    radius = _radius(angle)
    return paths.on_ellipse(_on_paper(angle.at), (radius, 0.0), (0.0, -radius), t)


def _on_paper(at: Place) -> Point:
    """On paper y grows downwards."""
    return UNIT * at[0], -UNIT * at[1]


# The arm in a pose beside a step: its body, and arrows at its tip

_ARROW = 62.0
_END_ON = 0.12
"""An arrow that is foreshortened more is drawn as one that is seen end on."""

TIP_ON = ("The tip lies on the dashed axis.", "The tip lies on the dashed axes.")
_ON_AXIS, _ELSEWHERE = 1e-4, 0.37
"""How near to an axis a point is on it, and the first coordinate of another pose."""

_TALLEST = 230.0
"""How high the picture of an arm beside a step is at most, in picture units of the usual size."""

_ALONG, _OFF = 0.95, 16.0
"""The cosine from which an arrow lies on the last link, and how far before the tip it ends then."""


def drawn_arm(figure: ArmFigure, problem: Problem, style: Style) -> Picture | None:
    """The arm of a figure as a block of a document; None where no such pose is found."""
    robot, values = problem.robot, numbers(problem)
    world = orientation(robot, values, problem.normals is not None)
    found = held_pose(robot, values, world, figure.zeros)
    if found is None:
        return None
    pose, at = found
    body = (*ground(pose.parts, pose.view), *solids(pose.parts, pose.view, world.up))
    notes = poses.Notes(style, Taken())
    notes.taken.add(body)
    axes = list(axes_through_tip(robot, values, pose))
    lines = tuple(_axis_line(name, leg, pose, notes) for name, leg in axes)
    for arrow in figure.arrows:
        _arrow(arrow, at, pose, notes)
    caption = " ".join((figure.caption, *TIP_ON[: len(axes)][-1:]))
    scene = _with_labels(caption, notes, (*lines, *body))
    scene = replace(scene, scale=min(1.0, _TALLEST / (scene.frame.bottom - scene.frame.top)))
    return Picture(to_svg(scene), caption, to_latex_picture(scene))


def axes_through_tip(robot: Robot, values: RobotNumbers, pose: Pose) -> Iterator[tuple[Node, Leg]]:
    """The axes of turning joints on which the tip lies in this pose, not in every one; with their names."""
    other = skeleton(robot, values, [_ELSEWHERE * (k + 1) for k in range(robot.n)])
    for joint, leg, elsewhere in zip(robot.joints, pose.skeleton.legs, other.legs, strict=True):
        is_seen = length((*pose.view.direction(leg.axis), 0.0)) > _END_ON
        if joint.type is not JointType.REVOLUTE or not is_seen:
            continue
        if _off(leg, pose.skeleton) < _ON_AXIS < _off(elsewhere, other):
            frame = joint.parent if robot.convention is Convention.STANDARD else joint.index
            yield letters.bold("z", Number(frame)), leg


def _off(leg: Leg, body: Skeleton) -> float:
    """How far the tip is from the axis of a row."""
    return length(cross(leg.axis, subtract(body.frames[-1].origin, leg.foot)))


def _axis_line(name: Node, leg: Leg, pose: Pose, notes: poses.Notes) -> Path:
    """The axis from its joint past the tip, with its name at that end."""
    reach = dot(subtract(pose.skeleton.frames[-1].origin, leg.foot), leg.axis)
    past = along(leg.foot, leg.axis, reach + math.copysign(pose.view.space(_ARROW), reach))
    a, b = pose.view.point(leg.foot), pose.view.point(past)
    line = Path(paths.line(a, b), paths.FRAME, 1.2, dashed=True)
    notes.taken.add([line])
    notes.label(name, [b], from_to(a, b), paths.FRAME, "axis")
    return line


def _arrow(arrow: ArmArrow, at: Mapping[str, float], pose: Pose, notes: poses.Notes) -> None:
    x, y, z = (float(evaluate(part, at)) for part in arrow.direction)
    direction: Vector = (x, y, z)
    if length(direction) < NEAR:
        return
    tip = pose.view.point(pose.skeleton.frames[-1].origin)
    dx, dy = pose.view.direction(unit(direction))
    if (dx**2 + dy**2) ** 0.5 < _END_ON:
        poses.seen_end_on(tip, poses.is_toward(direction, pose.view), notes, paths.VARIABLE, 7.0)
        notes.label(arrow.name, [tip], (1.0, -1.0), paths.VARIABLE, "axis", 8.0)
        return
    inwards = [from_to(tip, pose.view.point(point)) for point in pose.skeleton.path[-2:-1]]
    if any(x * dx + y * dy > _ALONG * math.hypot(x, y) * math.hypot(dx, dy) for x, y in inwards):
        start, named = moved(tip, (dx, dy), -_ARROW - _OFF), (-dx, -dy)  # from outside, clear of the link
    else:
        start, named = tip, (dx, dy)
    back, end = moved(start, (dx, dy), _ARROW - 7.0), moved(start, (dx, dy), _ARROW)
    notes.draw(*paths.arrow(start, back, end, (dx, dy), paths.VARIABLE, 2.4, halo=5.0, size=11.0))
    notes.label(arrow.name, [end if start == tip else start], named, paths.VARIABLE, "axis")


RESOLUTION = 192.0
"""Picture elements an inch, of a PNG."""

_PAGE = """#set document(title: {title}, date: none)
#set page(width: auto, height: auto, margin: 0pt)
#image(bytes({svg}), format: "svg", alt: {alt})
"""


def to_pdf(svg: str, title: str = "", alt: str = "") -> bytes:
    """A page of PDF, the same bytes for the same picture.

    Raises UsageError where the extra `pdf` is not installed.
    """
    return _compiled(svg, title, alt, "pdf")


def to_png(svg: str) -> bytes:
    """A PNG.  Raises UsageError where the extra `pdf` is not installed."""
    return _compiled(svg, "", "", "png")


def _compiled(svg: str, title: str, alt: str, format: Literal["pdf", "png"]) -> bytes:
    try:
        import typst
    except ImportError:
        raise UsageError(f"{format.upper()} needs the extra [pdf]: pip install 'dynsolve[pdf]'") from None
    page = _PAGE.format(title=quoted(title), svg=quoted(svg), alt=quoted(alt))
    made: bytes = typst.compile(
        page.encode(), format=format, ppi=RESOLUTION, ignore_system_fonts=True, timestamp=0
    )
    return made
