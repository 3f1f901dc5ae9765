"""The exact position of a point that is fixed in a link; one that would not be is reported."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

from dynsolve.algebra.matrix import Matrix
from dynsolve.problem.places import ParsedPlace
from dynsolve.problem.source import Faults
from dynsolve.problem.values import CellValues
from dynsolve.robot.geometry import Links

_TIP_ROW = (
    "add a fixed row for the tip, {theta: 0, d: 0, a: l, alpha: 0} with its length, "
    "or give the centre as [x, y, z]"
)


@dataclass(frozen=True, slots=True)
class PlaceBuilder:
    """The exact positions of points; `links` is None where the table has errors, and geometry waits."""

    faults: Faults
    values: CellValues
    links: Links | None

    def position(self, place: ParsedPlace, link: int | None, key: str, written: str) -> Matrix | None:
        """The point in frame `link`, 3×1; `key` is the one that says it, as `written`.

        None (reported) for a point that would not be fixed there.
        """
        given = self.values.column(place.cells) if place.kind in ("near", "at", "drawn") else None
        fraction = self.values.expr(place.cells[0]) if place.kind == "along" else None
        if place.kind == "at":
            return given
        if place.kind == "drawn":
            return self._drawn(place, given, link)
        if self.links is None or link is None:
            return None
        if place.kind == "origin":
            return self.links.origin()
        near, far = self.links.near_end(link), self.links.far_end(link)
        if place.kind == "near":
            point = near + given if given else None
        elif far is None:
            message = f"link {link} has no far end: the table has no row {link + 1}"
            self.faults.error(place.span, message, _TIP_ROW)
            return None
        elif place.kind == "tip":
            point = far
        else:
            half = self.values.ring.constant(Fraction(1, 2)) if place.kind == "midpoint" else fraction
            point = near + (far - near).scale(half) if half is not None else None
        if point is not None and not self.links.is_fixed(point):
            self._report_moving(self.links, place, link, key, written)
            return None
        return point

    def _drawn(self, place: ParsedPlace, given: Matrix | None, link: int | None) -> Matrix | None:
        """A point of the drawing, which must slide with what its link slides on."""
        if given is None or self.links is None or self.links.is_fixed(given):
            return given
        message = f"this point is not fixed in link {link}: it slides otherwise than the drawing of the link"
        help = "add the letters of the slides that come before the link, and no others"
        self.faults.error(place.span, message, help)
        return None

    def _report_moving(self, links: Links, place: ParsedPlace, link: int, key: str, written: str) -> None:
        shown = "tip" if place.kind == "tip" else written
        message = f"`{shown}` would not be fixed in link {link}: "
        if links.modified:
            message += f"its far end moves with the prismatic joint {link + 1}"
            help = f"add a fixed row for the tip before it, or give the centre in frame {link}: [x, y, z]"
        else:
            message += f"its near end slides along it, for joint {link} is prismatic"
            help = f"measure from the tip, in frame {link}: {key}: {self._back(links, link)}"
        self.faults.error(place.span, message, help)

    def _back(self, links: Links, link: int) -> str:
        """The point a length lc back from the tip of a prismatic link, as a list."""
        ring, joint = self.values.ring, links.joints[link - 1]
        entries = [ring.zero, -ring.sin(joint.alpha), -ring.cos(joint.alpha)]
        words = {0: "0", 1: f"lc{link}", -1: f"-lc{link}"}
        if all(entry.is_number and entry.number in words for entry in entries):
            return "[" + ", ".join(words[int(entry.number)] for entry in entries) + "]"
        return "[x, y, z]"
