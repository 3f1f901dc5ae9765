"""A solution as JSON, `dynsolve-solution/1`.

Every expression is plain text that Python evaluates once `sin`, `cos`, `sqrt` and
the symbols have values.  A matrix is a list of rows, a vector a list of entries.
Numbers, in the sections `values` and `at`, are exact where no decimal goes in, else
decimals of 15 digits, or as many as were asked for.

What is found by a question that is no value (branches, sets, verdicts), and what stands beside it, is
written by its file `export`.

The Denavit-Hartenberg table as JSON has it: rows of texts, with the marks of joint variables.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from fractions import Fraction
from functools import cached_property
from typing import TYPE_CHECKING, Any

from dynsolve.derivation.graph import Skipped
from dynsolve.document import Inline, Prose, Reference, Verbatim
from dynsolve.document.books import by_itself
from dynsolve.explain.step import Line, Step
from dynsolve.notation.build import times
from dynsolve.notation.markup import LatexPrinter
from dynsolve.notation.python import PythonPrinter
from dynsolve.notation.rounding import marked, marked_among_words
from dynsolve.notation.tree import Degrees, Matrix, Node, Symbol, Words, mapped
from dynsolve.notation.unicode import UnicodePrinter
from dynsolve.quantities import families, letters
from dynsolve.quantities.families import FAMILIES
from dynsolve.quantities.family import FORMED, Family, Kind, Owner
from dynsolve.quantities.index import Quantity, quantities
from dynsolve.quantities.owners import derived_stages
from dynsolve.quantities.stages import ASKED_FOR, Stage
from dynsolve.questions.export import Export
from dynsolve.questions.held import as_derived
from dynsolve.robot.model import Robot
from dynsolve.solution.dynamics import Dynamics
from dynsolve.solution.numbers import given
from dynsolve.solution.numbers.given import Given, parameters
from dynsolve.solution.numbers.results import Numbers, State, Valued

if TYPE_CHECKING:
    from dynsolve.explain.abbreviations import Abbreviate, Abbreviated, Definition


# The Denavit-Hartenberg table as JSON has it


def table_results(solution: Dynamics, printer: PythonPrinter) -> Iterator[tuple[str, Any]]:
    """`DH` where it is asked for; of a drawing always, and `base` where frame 0 is not the world."""
    problem = solution.problem
    name = families.DH.name
    if problem.normals is None and name not in problem.find and name not in problem.marks:
        return
    joints = solution.robot.joints
    yield name, [[printer.text(_starred(cell)) for cell in joint.written] for joint in joints]
    if problem.normals is not None and letters.has_base(solution.robot):
        base = solution.forms("H0")
        yield "base", [[printer.text(entry) for entry in row] for row in base.rows]  # type: ignore[attr-defined]


def _starred(cell: Node) -> Node:
    """A cell with the stars in the names, and with degrees as parts of π."""

    def change(node: Node) -> Node:
        match node:
            case Symbol(name, 0, True):
                return Symbol(f"{name}*")
            case Degrees(p, q):
                return times(Fraction(p, 180 * q), [(Symbol("pi"), 1)])
        return node

    return mapped(cell, change)


FORMAT = "dynsolve-solution/1"

NUMBER_DIGITS = 15
"""The digits of decimals, unless a number of digits is asked for."""


def to_json(solution: Dynamics, abbreviate: Abbreviate | str = "never") -> dict[str, Any]:
    """Everything: the problem, the coordinates, the results, the steps and the verification.

    With `always` there is a section `abbreviated` of definitions, and of the forms in their names.
    """
    short = solution.abbreviated("always") if abbreviate == "always" else None
    problem, verification = solution.problem, solution.verification
    exporter, robot = _Exporter(solution), solution.robot
    forces = robot.inputs or [q.force for q in robot.coordinates]
    return {
        "format": FORMAT,
        "problem": {
            "title": problem.title,
            "source": problem.source,
            "convention": problem.convention.value,
            "file": problem.file,
        },
        "coordinates": [
            {
                "name": q.name,
                "type": q.type.value,
                "velocity": q.velocity,
                "acceleration": q.acceleration,
                "force": force,
            }
            for q, force in zip(robot.coordinates, forces, strict=True)
        ],
        "results": exporter.results(),
        "steps": [exporter.step(step) for step in solution.steps],
        "verified": {
            "method": verification.method,
            "states": verification.states,
            "max_relative_error": verification.max_relative_error,
        },
        **({} if short is None else {"abbreviated": exporter.abbreviated(short)}),
        **_with_target(
            {} if solution.numbers is None else _number_sections(solution, solution.numbers), exporter
        ),
    }


class _Exporter:
    """Keeps one printer of each notation, so that what trees share is printed once."""

    def __init__(
        self, solution: Dynamics, forms: Callable[[str], Node] | None = None, of: Valued | State | None = None
    ) -> None:
        self.solution, self.of = solution, of
        self.forms = forms or solution.forms
        self.python = PythonPrinter()
        self.latex = LatexPrinter(solution.style)
        self.unicode = UnicodePrinter(solution.style)

    def results(self) -> dict[str, Any]:
        """`results`, by the keys of the families; of a robot without masses it ends with the Jacobian."""
        robot = self.solution.robot
        bodies: list[dict[str, Any]] = [{"name": body.name} for body in robot.bodies]
        equations: list[dict[str, Any]] = [{} for _ in robot.coordinates]
        results: dict[str, Any] = {}
        for family in _exported(robot):
            values = [self.value(quantity) for quantity in quantities(robot).of_family(family)]
            match family.owner:
                case Owner.ROBOT:
                    (results[family.json],) = values
                case Owner.ROW:
                    results[family.json] = values
                case Owner.BODY:
                    _fill(results.setdefault("bodies", bodies), family.json, values)
                case Owner.COORDINATE:
                    _fill(results.setdefault("euler_lagrange", equations), family.json, values)
        results.setdefault("bodies", bodies)
        results |= {quantity.name: self.value(quantity) for quantity in self.asked()}
        asked = {quantity.family.stage for quantity in self.asked()}
        for stage in (stage for stage in ASKED_FOR if stage in asked):
            if hasattr(question := stage.part("export"), "beside"):
                results |= dict(question.beside(self.export))
        return results | dict(table_results(self.solution, self.python))

    def asked(self) -> Iterator[Quantity]:
        """What is exported only where it is asked for, under its own name."""
        problem = self.solution.problem
        of_robot, asked = quantities(self.solution.robot), self.solution.robot.questions.asked
        for name, quantity in of_robot.items():
            whole = of_robot.get(quantity.whole)
            is_told = quantity.family.json or (whole is not None and whole.family.json)
            if name in asked or (name in problem.find and not is_told and name != families.DH.name):
                yield quantity

    def value(self, quantity: Quantity) -> Any:
        """A scalar as text, a matrix as its rows, a vector as its entries; sets and spans as lists."""
        if quantity.family.kind not in FORMED:
            return quantity.family.stage.part("export").value(self.export, quantity.rule)
        form = self.forms(quantity.form)
        if isinstance(form, Words):  # in brackets, as it stands in a formula
            value = self.export.values[quantity.rule]
            if not isinstance(value, Skipped) or value.value is None:
                return {"skipped": form.text[1:-1]}
            form = as_derived(value.value)
        if not isinstance(form, Matrix):
            return self.python.text(form)
        rows = [[self.python.text(entry) for entry in row] for row in form.rows]
        if quantity.family.kind is Kind.SPAN:
            return [list(vector) for vector in zip(*rows, strict=True)]
        return [entry for (entry,) in rows] if quantity.family.is_vector else rows

    @cached_property
    def export(self) -> Export:
        """What a question exports from."""
        solution, here = self.solution, self.of or self.solution
        return Export(here.robot, here.values, solution.robot, solution.values, solution.forms,
                      self.python, self.unicode, self.prose)  # fmt: skip

    def abbreviated(self, short: Abbreviated) -> dict[str, Any]:
        """`abbreviated`; a definition uses those before it alone, and c_ijk is given for i ≤ j."""

        def rows(matrix: Matrix) -> list[list[str]]:
            return [[self.python.text(entry) for entry in row] for row in matrix.rows]

        def listed(definitions: Iterable[Definition]) -> list[dict[str, str]]:
            return [{"name": d.name.name, "value": self.python.text(d.meaning)} for d in definitions]

        return {
            "constants": listed(short.constants),
            "recurring": listed(short.sums),
            "D": rows(short.D),
            "C": rows(short.C),
            "g": [entry for (entry,) in rows(short.g)],
            "christoffel": [
                {"i": i + 1, "j": j + 1, "k": k + 1, "value": self.python.text(value)}
                for (i, j, k), value in short.christoffel.items()
            ],
        }

    def step(self, step: Step) -> dict[str, Any]:
        formulas = [*([step.formula] if step.formula else []), *step.further, *step.working, *step.result]
        return {
            "id": step.id,
            "stage": step.stage,
            "title": step.title,
            "why": self.prose(step.why),
            "source": by_itself(step.source),
            **self.formulas(formulas),
            "notes": [self.prose(note) for note in step.notes],
            **({"lines": list(map(self.line, step.lines))} if step.lines else {}),
            **({"concluding": self.prose(step.concluding)} if step.concluding else {}),
        }

    def line(self, line: Line) -> dict[str, str]:
        """A line between the formula and the result, with the operation that leads to it."""
        return {"by": self.prose(line.by), **self.formulas(line.formulas)}

    def formulas(self, formulas: Sequence[Node]) -> dict[str, str]:
        """Formulas in both notations, with ≈ where a number is rounded."""
        if self.solution.may_round:
            formulas = [marked(node, self.unicode.style) for node in formulas]
        return {
            "latex": "\n".join(map(self.latex.text, formulas)),
            "text": "\n".join(map(self.unicode.text, formulas)),
        }

    def prose(self, parts: Prose) -> str:
        return "".join(map(self.part, parts))

    def part(self, part: Inline) -> str:
        match part:
            case str():
                return part
            case Verbatim(text):
                return text
            case Reference():
                return ""  # equations have names here, and no numbers
        if self.solution.may_round:
            part = marked_among_words(part, self.unicode.style)
        return self.unicode.text(part)


def _exported(robot: Robot) -> Iterator[Family]:
    """The families that `results` has, in their order."""
    stages, has = derived_stages(robot), quantities(robot).owners.has
    return (family for family in FAMILIES if family.json and family.stage in stages and has(family))


def _fill(rows: list[dict[str, Any]], key: str, values: list[Any]) -> None:
    for row, value in zip(rows, values, strict=True):
        row[key] = value


# -- numbers ---------------------------------------------------------------------------------------


def _number_sections(solution: Dynamics, numbers: Numbers) -> dict[str, Any]:
    """`values` with what was given, and the results with it; `at` with the state, and the results there."""

    def results(of: Valued | State) -> dict[str, Any]:
        return _Exporter(solution, lambda name: of.shown(name, NUMBER_DIGITS), of).results()

    sections: dict[str, Any] = {}
    if numbers.given.entries:
        sections["values"] = {"given": _given(numbers.given)}
        if numbers.valued is not None:
            sections["values"]["results"] = results(numbers.valued)
    if numbers.state is not None:
        sections["at"] = {"given": _given(numbers.state.given), "results": results(numbers.state)}
    if sections:
        sections["units"] = {name: _plain(unit) for name, unit in _units(numbers.robot)}
    return sections


def _with_target(sections: dict[str, Any], exporter: _Exporter) -> dict[str, Any]:
    """The sections, `values` with what reaches the numbers of `reach`, which needs no others than its own."""
    solution = exporter.solution
    if "inverse" not in solution.robot.questions.asked:
        return sections
    found = Stage.INVERSE.part("export").targeted(exporter.export)
    if found is not None:
        values = sections.setdefault("values", {"given": _given(parameters(solution.problem, ()))})
        values.setdefault("results", {})["inverse"] = found
    return sections


def _given(given: Given) -> dict[str, dict[str, str]]:
    """The given values by name; an angle without a unit is in radians."""
    return {
        name + ("", "_dot", "_ddot")[dots]: {"value": entry.text, "unit": entry.unit or "rad"}
        for (name, dots), entry in given.entries.items()
    }


def _units(robot: Robot) -> Iterator[tuple[str, str | given.Units]]:
    """The units of the quantities that a robot has one of, but for the Jacobian."""
    for family in _exported(robot):
        if family.owner is Owner.ROBOT and family.stage.needs_masses:
            yield family.json, given.of_result(robot, family.name)


def _plain(unit: str | given.Units) -> Any:
    if isinstance(unit, str):
        return unit
    rows = [list(row) for row in unit]
    return [entry for (entry,) in rows] if all(len(row) == 1 for row in rows) else rows
