"""A scene as SVG: paths, and text that stays text."""

from __future__ import annotations

from html import escape

from dynsolve.draw.labels import Label
from dynsolve.draw.paths import WHITE, Commands, Path
from dynsolve.draw.scene import Scene
from dynsolve.draw.typography import SIZE, Run
from dynsolve.notation.unicode import printable

FACES = (
    "'Libertinus Serif', 'STIX Two Text', STIX, STIXGeneral, Cambria, 'Times New Roman',"
    " 'Liberation Serif', 'DejaVu Serif', serif"
)


def to_svg(scene: Scene) -> str:
    """The picture as a document of SVG 1.1."""
    box = scene.frame
    width, height = number(box.right - box.left), number(box.bottom - box.top)
    lines = [
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}"'
        f' viewBox="{number(box.left)} {number(box.top)} {width} {height}" role="img"'
        f' font-family="{FACES}" font-size="{number(SIZE)}">',
        f"<title>{text(scene.title)}</title>",
        f"<desc>{text(scene.description)}</desc>",
        f'<rect class="paper" x="{number(box.left)}" y="{number(box.top)}" width="{width}" height="{height}"'
        f' fill="{WHITE}"/>',
        '<g stroke-linecap="round" stroke-linejoin="round">',
        *map(_path, scene.paths),
        "</g>",
        *map(_label, scene.labels),
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


def _path(path: Path) -> str:
    attributes = [f'd="{_commands(path.commands)}"', f'fill="{path.fill or "none"}"']
    if path.stroke == WHITE:
        attributes.append('class="halo"')
    if path.stroke:
        attributes += [f'stroke="{path.stroke}"', f'stroke-width="{number(path.width)}"']
    if path.dashed:
        attributes.append('stroke-dasharray="4 3"')
    return f"<path {' '.join(attributes)}/>"


def _commands(commands: Commands) -> str:
    return "".join(
        letter + " ".join(f"{number(x)} {number(y)}" for x, y in points) for letter, points in commands
    )


def _label(label: Label) -> str:
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
