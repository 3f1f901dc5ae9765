"""What the JSON of a solution says of the questions: what an export is given, and what several write."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence

from msgspec import Struct

from dynsolve.algebra.inequality import Bound
from dynsolve.derivation.graph import Derivation, Skipped
from dynsolve.document import Prose
from dynsolve.explain.forms import Forms
from dynsolve.notation.python import PythonPrinter
from dynsolve.notation.tree import Relation
from dynsolve.notation.unicode import UnicodePrinter
from dynsolve.questions.set_forms import SetForms
from dynsolve.robot.model import Robot


class Export(Struct, frozen=True):
    """What a question exports its results from.

    `robot` and `values` are those with the numbers that are put in, where there are any; the `general`
    ones are without.  `forms` are the compact forms of the general ones.  `python` writes formulas,
    `unicode` and `prose` what is told in words.
    """

    robot: Robot
    values: Derivation
    general_robot: Robot
    general_values: Derivation
    forms: Forms
    python: PythonPrinter
    unicode: UnicodePrinter
    prose: Callable[[Prose], str]

    @property
    def has_numbers(self) -> bool:
        """Whether numbers are put in."""
        return self.robot is not self.general_robot


def skipped(values: Derivation, name: str) -> dict[str, str] | None:
    """Why a result was not worked out, as JSON has it; None where it was."""
    found = values[name]
    return {"skipped": found.why} if isinstance(found, Skipped) else None


def alternatives(export: Export, shown: SetForms, name: str) -> list[list[str]] | dict[str, str]:
    """Equations that hold together, alternative by alternative."""
    found = shown.alternatives(name)
    return skipped(export.values, name) or [[f"{export.python.text(e)} = 0" for e in one] for one in found]


def plain_inequality(relation: Relation, printer: PythonPrinter) -> str:
    """a1 >= a2"""
    left, right = relation.parts
    sign = {"≥": ">=", "≤": "<=", "≠": "!="}.get(relation.signs[0], relation.signs[0])
    return f"{printer.text(left)} {sign} {printer.text(right)}"


def existence(
    name: str, shown: SetForms, printer: PythonPrinter, exist: Sequence[Sequence[Bound]]
) -> Iterator[tuple[str, list[list[str]]]]:
    """Beside a set of alternatives the inequalities under which each is there, if any is not always."""
    if any(exist):
        yield f"{name}_exist", [inequalities(shown, printer, bounds) for bounds in exist]


def inequalities(shown: SetForms, printer: PythonPrinter, bounds: Sequence[Bound]) -> list[str]:
    """Inequalities as text."""
    return [plain_inequality(shown.inequality(bound), printer) for bound in bounds]
