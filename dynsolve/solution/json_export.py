"""A solution as JSON, `dynsolve-solution/1`.

Every expression is plain text that Python evaluates once `sin`, `cos`, `sqrt` and
the symbols have values.  A matrix is a list of rows, a vector a list of entries.
Numbers, in the sections `values` and `at`, are exact where no decimal goes in, else
decimals of 15 digits, or as many as were asked for.

The branches of the inverse kinematics in the JSON of a solution.

Where equilibria are, and how stable, as data beside the equilibria themselves.

What is found of matrices, as JSON has it: the verdict, its conditions, and why.

The Denavit-Hartenberg table as JSON has it: rows of texts, with the marks of joint variables.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from fractions import Fraction
from functools import cached_property
from typing import TYPE_CHECKING, Any

from dynsolve.algebra.inequality import Bound
from dynsolve.algebra.surds import PI
from dynsolve.derivation.configurations import NO_CLOSED_FORM
from dynsolve.derivation.definite import Definiteness
from dynsolve.derivation.equilibria import Equilibria, Point, SpecialCase, Values
from dynsolve.derivation.graph import Skipped
from dynsolve.document import Inline, Prose, Reference, Verbatim
from dynsolve.explain.definite import inequality, reason
from dynsolve.explain.inverse_formulas import ConfigurationForms
from dynsolve.explain.step import Line, Step
from dynsolve.explain.writing import by_itself
from dynsolve.notation.build import times
from dynsolve.notation.latex import LatexPrinter
from dynsolve.notation.python import PythonPrinter
from dynsolve.notation.tree import Degrees, Matrix, Node, Number, Relation, Symbol, Words, mapped
from dynsolve.notation.unicode import UnicodePrinter
from dynsolve.quantities import families, letters
from dynsolve.quantities.families import FAMILIES
from dynsolve.quantities.family import Family, Kind, Owner
from dynsolve.quantities.index import Quantity, quantities
from dynsolve.quantities.owners import derived_stages
from dynsolve.robot.model import Robot
from dynsolve.solution.dynamics import Dynamics
from dynsolve.solution.numbers import given
from dynsolve.solution.numbers.given import Given, parameters
from dynsolve.solution.numbers.results import Numbers, State, Valued
from dynsolve.solution.numbers.substitution import DIGITS

if TYPE_CHECKING:
    from dynsolve.explain.abbreviations import Abbreviate, Abbreviated, Definition
    from dynsolve.explain.target import TargetForms


# The branches of the inverse kinematics in the JSON of a solution

_DIGITS = 15


def branch_results(forms: ConfigurationForms, python: PythonPrinter) -> list[dict[str, Any]]:
    """The branches in the names of the values of the task, each with the conditions under which it is one."""
    found: list[dict[str, Any]] = []
    for branch, when in zip(forms.inverse, forms.when, strict=True):
        found.append({name: _text(python, value) for name, value in branch.items()})
        if when:
            found[-1]["when"] = [" = ".join(_text(python, side) for side in one.sides) for one in when]
    return found


def configuration_results(target: TargetForms, python: PythonPrinter) -> list[dict[str, str]]:
    """The configurations that reach given numbers, their formulas exact where they come from a branch."""
    return [
        {name: _text(python, _exact(f) if one.branches else f) for name, f in one.formulas.items()}
        for one in target.configurations
    ]


def _exact(formula: Node) -> Node:
    """A formula with fractions for decimals."""
    return mapped(formula, lambda part: Number(part.p, part.q) if isinstance(part, Number) else part)


def _text(python: PythonPrinter, formula: Node) -> str:
    """A formula as text, its degrees as parts of π, so that no rounded number stands in it."""
    return python.text(mapped(formula, _in_radians))


def _in_radians(part: Node) -> Node:
    return times(Fraction(part.p, 180 * part.q), [(PI, 1)]) if isinstance(part, Degrees) else part


def beside_branches(forms: ConfigurationForms, write: Callable[[Prose], str]) -> Iterator[tuple[str, Any]]:
    """What stands beside `inverse` where the target is given in numbers.

    `inverse_decimals` are the same configurations in numbers (angles in radians), without the coordinates
    that are free, which `inverse_free` names for each; `inverse_outside` names those beyond their
    limits, where there are any limits; `inverse_why` says why there is none, or that they were found
    in numbers. `write` writes prose as text.
    """
    if forms.target is None:
        return
    from dynsolve.explain.target import told

    found = forms.target.configurations
    yield (
        "inverse_decimals",
        [{name: float(f"{one.numbers[name]:.{_DIGITS}g}") for name in one.formulas} for one in found],
    )
    if any(one.free for one in found):
        yield "inverse_free", [list(one.free) for one in found]
    if forms.robot.questions.limits:
        yield "inverse_outside", [list(one.outside) for one in found]
    yield "inverse_why", write(told(forms.target))


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


# What is found of matrices, as JSON has it: the verdict, its conditions, and why


def verdict_results(solution: Dynamics, printer: PythonPrinter, reader: UnicodePrinter) -> dict[str, Any]:
    """`definite`: of the D of a model, or of each candidate by its name."""
    candidates = solution.robot.questions.candidates
    found = {
        candidate.name: _result(solution, one, printer, reader)
        for candidate, one in zip(candidates, solution.values["definite"], strict=True)
    }
    return found["D"] if solution.robot.given is not None else found


def _result(
    solution: Dynamics, found: Definiteness | Skipped, printer: PythonPrinter, reader: UnicodePrinter
) -> dict[str, Any]:
    if isinstance(found, Skipped):
        return {"skipped": found.why}
    why = reason(solution.forms, found)
    said = (p for p in why if not isinstance(p, Reference))
    parts = (p if isinstance(p, str) else p.text if isinstance(p, Verbatim) else reader.text(p) for p in said)
    return {
        "verdict": found.answer.value,
        "conditions": [
            plain_inequality(inequality(solution.forms, bound), printer) for bound in found.conditions
        ],
        "why": "".join(parts),
    }


def plain_inequality(relation: Relation, printer: PythonPrinter) -> str:
    """a1 >= a2"""
    left, right = relation.parts
    sign = {"≥": ">="}.get(relation.signs[0], relation.signs[0])
    return f"{printer.text(left)} {sign} {printer.text(right)}"


FORMAT = "dynsolve-solution/1"

NUMBER_DIGITS = 15
"""The digits of decimals, unless a number of digits is asked for."""


def to_json(solution: Dynamics, abbreviate: Abbreviate | str = "never") -> dict[str, Any]:
    """Everything: the problem, the coordinates, the results, the steps and the verification.

    With `always` there is a section `abbreviated` of definitions, and of the forms in their names.
    """
    short = solution.abbreviated("always") if abbreviate == "always" else None
    problem, verification = solution.problem, solution.verification
    exporter = _Exporter(solution)
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
                "force": q.force,
            }
            for q in solution.robot.coordinates
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
        results |= {quantity.name: self.value(quantity) for quantity in _asked(robot)}
        if isinstance(results.get("equilibria"), list):
            results |= dict(beside_equilibria(self.sets, self.python))
        if isinstance(results.get("singular"), list):
            found = self.sets.values["singular"]
            results |= dict(existence("singular", self.sets, self.python, found.exist))
        if "inverse" in results and self.of is None:
            results |= dict(beside_branches(self.configurations, self.prose))
        return results | dict(table_results(self.solution, self.python))

    def value(self, quantity: Quantity) -> Any:
        """A scalar as text, a matrix as its rows, a vector as its entries; sets and spans as lists."""
        kind = quantity.family.kind
        if kind is Kind.BRANCHES and self.of is not None and self.configurations.target is not None:
            return configuration_results(self.configurations.target, self.python)
        if kind in (Kind.EQUATIONS, Kind.CONDITIONS, Kind.BRANCHES):
            shown = self.configurations if kind is Kind.CONDITIONS else self.sets
            if isinstance(found := shown.values[quantity.rule], Skipped):
                return {"skipped": found.why}
        match kind:
            case Kind.CONDITIONS:
                sides = self.configurations.conditions(quantity.rule)
                return [f"{self.python.text(left)} = {self.python.text(right)}" for left, right in sides]
            case Kind.EQUATIONS:
                alternatives = self.sets.alternatives(quantity.rule)
                return [[f"{self.python.text(e)} = 0" for e in one] for one in alternatives]
            case Kind.VERDICTS:
                return verdict_results(self.solution, self.python, self.unicode)
            case Kind.BRANCHES if self.sets.solved is None:
                return {"skipped": NO_CLOSED_FORM}
            case Kind.BRANCHES:
                return branch_results(self.sets, self.python)
        form = self.forms(quantity.rule)
        if isinstance(form, Words):
            return {"skipped": form.text}
        if not isinstance(form, Matrix):
            return self.python.text(form)
        rows = [[self.python.text(entry) for entry in row] for row in form.rows]
        if quantity.family.kind is Kind.SPAN:
            return [list(vector) for vector in zip(*rows, strict=True)]
        return [entry for (entry,) in rows] if quantity.family.is_vector else rows

    @cached_property
    def configurations(self) -> ConfigurationForms:
        """Singular configurations and the inverse kinematics, as formulas."""
        from dynsolve.explain.inverse_formulas import ConfigurationForms

        return ConfigurationForms(self.solution.robot, self.solution.values)

    @cached_property
    def sets(self) -> ConfigurationForms:
        """The same of the robot with the numbers that are put in, where there are any."""
        if self.of is None:
            return self.configurations
        from dynsolve.explain.inverse_formulas import ConfigurationForms

        return ConfigurationForms(self.of.robot, self.of.values)

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
            "latex": "\n".join(map(self.latex.text, formulas)),
            "text": "\n".join(map(self.unicode.text, formulas)),
            "notes": [self.prose(note) for note in step.notes],
            **({"lines": list(map(self.line, step.lines))} if step.lines else {}),
            **({"concluding": self.prose(step.concluding)} if step.concluding else {}),
        }

    def line(self, line: Line) -> dict[str, str]:
        """A line between the formula and the result, with the operation that leads to it."""
        return {
            "by": self.prose(line.by),
            "latex": "\n".join(map(self.latex.text, line.formulas)),
            "text": "\n".join(map(self.unicode.text, line.formulas)),
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
        return self.unicode.text(part)


def _exported(robot: Robot) -> Iterator[Family]:
    """The families that `results` has, in their order."""
    stages, has = derived_stages(robot), quantities(robot).owners.has
    return (family for family in FAMILIES if family.json and family.stage in stages and has(family))


def _asked(robot: Robot) -> Iterator[Quantity]:
    """What is exported only where it is asked for, under its own name."""
    asked = robot.questions.asked
    return (quantity for quantity in quantities(robot).values() if quantity.name in asked)


def _fill(rows: list[dict[str, Any]], key: str, values: list[Any]) -> None:
    for row, value in zip(rows, values, strict=True):
        row[key] = value


# -- numbers ---------------------------------------------------------------------------------------


def _number_sections(solution: Dynamics, numbers: Numbers) -> dict[str, Any]:
    """`values` with what was given, and the results with it; `at` with the state, and the results there."""

    def results(of: Valued | State) -> dict[str, Any]:
        digits = of.digits if of.digits != DIGITS else NUMBER_DIGITS
        return _Exporter(solution, lambda name: of.shown(name, digits), of).results()

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
    if "inverse" in solution.robot.questions.asked and (target := exporter.configurations.target) is not None:
        values = sections.setdefault("values", {"given": _given(parameters(solution.problem, ()))})
        values.setdefault("results", {})["inverse"] = configuration_results(target, exporter.python)
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


# Where equilibria are, and how stable, as data beside the equilibria themselves

QUARTERS = {(0, 1): "0", (1, 0): "pi/2", (0, -1): "pi", (-1, 0): "-pi/2"}
"""Quarter turns by their sine and cosine."""


def beside_equilibria(shown: ConfigurationForms, printer: PythonPrinter) -> Iterator[tuple[str, Any]]:
    """`equilibria_stability`, and for which parameters the equilibria are there, or are others."""
    found: Equilibria = shown.values["equilibria"]

    def written(bounds: Sequence[Bound]) -> list[str]:
        return inequalities(shown, printer, bounds)

    def told(point: Point) -> dict[str, Any]:
        conditions = {"stable_if": written(point.conditions)} if point.conditions else {}
        if point.falls:
            conditions["unstable_if"] = written([Bound(-bound.value) for bound in point.conditions])
        return {**angles(point.values), "stability": point.stability.value, **conditions}

    yield "equilibria_stability", [[told(point) for point in points] for points in found.points]
    yield from existence("equilibria", shown, printer, found.exist)
    if found.special:
        yield "equilibria_special", [_special(one, shown, printer) for one in found.special]
    if found.may_be_others:
        yield "equilibria_general", True


def _special(one: SpecialCase, shown: ConfigurationForms, printer: PythonPrinter) -> dict[str, Any]:
    """Parameters for which the equilibria are others, and what these are there, as `equilibria` has them."""
    forces = shown.special_forces(one)
    equations = [] if forces is None else [[f"{printer.text(force)} = 0" for force in forces]]
    return {
        "where": plain_inequality(shown.comparison(one.factor, "="), printer),
        "equilibria": equations,
    }


def existence(
    name: str, shown: ConfigurationForms, printer: PythonPrinter, exist: Sequence[Sequence[Bound]]
) -> Iterator[tuple[str, list[list[str]]]]:
    """Beside a set of alternatives the inequalities under which each is there, if any is not always."""
    if any(exist):
        yield f"{name}_exist", [inequalities(shown, printer, bounds) for bounds in exist]


def inequalities(shown: ConfigurationForms, printer: PythonPrinter, bounds: Sequence[Bound]) -> list[str]:
    """Inequalities as text."""
    return [plain_inequality(shown.inequality(bound), printer) for bound in bounds]


def angles(values: Values) -> dict[str, str]:
    """Quarter turns by the names of the coordinates."""
    return {pair.angle.terms[0][0][0][0]: QUARTERS[sine, cosine] for pair, sine, cosine in values}
