"""A robot's dynamics, derived and verified: the source of documents, JSON and numbers.

The way to the forces that a user chooses: by the Lagrangian, or by the Newton-Euler recursions.

The remarks of a problem's author, as notes of the steps that they speak of.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Iterable, Iterator
from functools import cached_property
from typing import TYPE_CHECKING, Self

from msgspec import Struct, field
from msgspec.structs import replace

from dynsolve.derivation.euler_lagrange import Agreement, agreement
from dynsolve.derivation.graph import Derivation
from dynsolve.derivation.rules import course_rules, derive
from dynsolve.derivation.verification import Verification, verify
from dynsolve.document import Prose
from dynsolve.errors import Finding, ProblemError, UsageError, VerificationError
from dynsolve.explain.context import MOST_JOINTS
from dynsolve.explain.forms import Forms
from dynsolve.explain.signs import report_style
from dynsolve.explain.step import Step
from dynsolve.notation.printing import Style
from dynsolve.problem import Problem
from dynsolve.quantities.family import FORMED
from dynsolve.quantities.index import Quantities, quantities
from dynsolve.quantities.owners import stages_of
from dynsolve.quantities.stages import Stage
from dynsolve.robot.model import Robot
from dynsolve.robot.questions import Method
from dynsolve.solution.given_axes import check_axes
from dynsolve.solution.numbers.given import Given

if TYPE_CHECKING:
    from dynsolve.document import Picture
    from dynsolve.explain.abbreviations import Abbreviate, Abbreviated
    from dynsolve.explain.context import Context
    from dynsolve.solution.numbers.results import Numbers


# The way to the forces that a user chooses


def by_method(problem: Problem, method: Method) -> Problem:
    """The problem, to be solved by a method; by the recursions with all their quantities asked for.

    Of robots of more than three coordinates these would fill pages, and are only there where the file
    asks for them.  Raises UsageError for the recursions of a robot without masses or links.
    """
    if method is Method.LAGRANGE:
        return problem
    if not problem.robot.bodies:
        raise UsageError("no body has mass, so the Newton-Euler recursions have nothing to work out")
    if not problem.robot.has_table:
        raise UsageError("this model has no links, along which the Newton-Euler recursions go")
    robot = _with_method(problem.robot, method)
    if robot.n > MOST_JOINTS:
        return replace(problem, robot=robot)
    own = (q.name for q in quantities(robot).values() if q.family.stage is Stage.NEWTON_EULER)
    asked = robot.questions.asked.union(own)
    return replace(problem, robot=replace(robot, questions=replace(robot.questions, asked=asked)))


def verify_method(robot: Robot, values: Derivation) -> None:
    """Compare the forces of the recursions with those of the Lagrangian, exactly.

    Raises VerificationError where they differ.
    """
    if robot.questions.method is Method.NEWTON_EULER:
        by_lagrange = derive(_with_method(robot, Method.LAGRANGE))
        if values["tau"] != by_lagrange["tau"]:
            raise VerificationError("the forces of the recursions differ from those of the Lagrangian")


def _with_method(robot: Robot, method: Method) -> Robot:
    return replace(robot, questions=replace(robot.questions, method=method))


CHECKED = ("P", "g", "D", "J", "C", "friction", "tau", "K")
"""The results that are compared with the independent computation, besides the last H."""

Progress = Callable[[int, int], None]
"""progress(done, of)"""


class Dynamics(Struct, frozen=True, dict=True):
    """A robot's dynamics, derived and verified.

    `values` are exact, by the names of the answer file (`H2`, `Jv1`, `K`, `D`);
    `forms` are the same as compact trees.  `given` are numbers that were put for
    parameters, `numbers` the numeric results that are shown beside the symbolic ones,
    `digits` the significant digits that were asked for of a model in numbers.
    """

    problem: Problem
    values: Derivation
    forms: Forms
    verification: Verification
    agreement: Agreement | None = None
    warnings: tuple[Finding, ...] = ()
    given: Given = field(default_factory=Given)
    numbers: Numbers | None = None
    digits: int | None = None

    @classmethod
    def of(cls, problem: Problem, states: int = 5, progress: Progress | None = None) -> Self:
        """Derive a problem's dynamics, and verify them.

        Raises ProblemError for given rotations with which the energy would be wrong,
        VerificationError where two ways to a result differ.
        """
        if problem.robot.questions.state_is_open:
            from dynsolve.solution.asked_checks import with_reached_state

            problem = with_reached_state(problem)
        robot = problem.robot
        values = derive(robot)
        warnings = (*problem.warnings, *check_axes(problem, values))
        forms = Forms(robot, values)
        if progress is not None:
            _make_all(forms, progress)
        agreed = None
        if robot.has_dynamics:
            agreed = agreement(robot, values)
            if not agreed.holds:
                raise VerificationError(
                    "what is read off from the forces differs from what is assembled directly"
                )
            verify_method(robot, values)
        compared = {letter: forms(name) for letter, name in _checked(forms).items()}
        verification = verify(robot, compared, states)
        if problem.normals is not None:
            from dynsolve.derivation.drawn_motion import verify_drawing

            verify_drawing(problem.normals, forms(f"H{len(robot.joints)}"), states)
        if robot.questions.asked:
            from dynsolve.solution.asked_checks import skipped, verify_asked

            verified = verify_asked(robot, values, forms, states)
            if verified is not values:
                values, forms = verified, Forms(robot, verified)
            told = (f"{name} is left out: {why}" for name, why in skipped(robot, values))
            warnings = (*warnings, *(problem.finding(("find",), text) for text in told))
        return cls(problem, values, forms, verification, agreed, warnings)

    @property
    def robot(self) -> Robot:
        """The robot."""
        return self.problem.robot

    @cached_property
    def style(self) -> Style:
        """How the formulas of a report look: s_1 for sin θ_1, and no sign with two meanings."""
        return report_style(self.robot, self.digits)

    @property
    def may_round(self) -> bool:
        """Whether there can be decimals: in a model in numbers, with values, and of what reaches numbers."""
        is_numeric = self.style.digits or self.numbers is not None
        return bool(is_numeric) or self.robot.questions.target is not None

    def starred(self, star: bool) -> Style:
        """The style in which every joint variable carries its mark, where `star` asks for it."""
        return (
            replace(self.style, stars=frozenset(q.name for q in self.robot.coordinates))
            if star
            else self.style
        )

    def picture(self, star: bool = False) -> Picture:
        """The manipulator with its frames, drawn once however many reports show it.

        With `star` the joint variables carry their marks.
        """
        if star not in self._pictures:
            from dynsolve.draw import picture

            self._pictures[star] = picture(self.problem, star=star)
        return self._pictures[star]

    @cached_property
    def _pictures(self) -> dict[bool, Picture]:
        return {}

    @cached_property
    def steps(self) -> tuple[Step, ...]:
        """The whole derivation, step by step."""
        from dynsolve.explain import explain

        return self._remarked(explain(self._context), whole=True)

    def _remarked(self, steps: Iterable[Step], *, whole: bool) -> tuple[Step, ...]:
        if not self.problem.remarks:
            return tuple(steps)

        return tuple(with_remarks(steps, self.problem, whole=whole))

    @cached_property
    def _context(self) -> Context:
        from dynsolve.explain.context import Context

        problem, units = self.problem, self.problem.units
        lengths = {name: text for name, text in problem.written.items() if units.get(name, "m") == "m"}
        return Context(
            self.robot,
            self.values,
            self.forms,
            self.agreement,
            problem.normals,
            lengths,
            find=problem.find,
        )

    def explain(
        self,
        stages: Iterable[str] | None = None,
        short: Abbreviated | None = None,
        *,
        by_energies: bool = False,
    ) -> Iterator[Step]:
        """The steps of some stages, in the order of the course; with `short`, in its names.

        With `by_energies` 𝐃 is read off from 𝒦, and the forces are not told.
        """
        from dynsolve.explain import explain

        if stages is None and short is None and not by_energies:
            return iter(self.steps)
        context = replace(self._context, names=short, by_energies=by_energies)
        return iter(self._remarked(explain(context, stages), whole=stages is None))

    @property
    def is_short(self) -> bool:
        """Whether a report shows every line: of longer arms they would fill pages."""
        return self._context.is_short

    def abbreviated(self, abbreviate: Abbreviate | str = "always") -> Abbreviated | None:
        """D, C and g with constants and recurring terms named; compared with the independent computation.

        With `auto` None where they are short enough to be read, or with names for Christoffel symbols
        alone; with `never` always None.

        >>> import dynsolve
        >>> short = dynsolve.solve("planar-2r").abbreviated()
        >>> [definition.name.name for definition in short.definitions]
        ['h']
        """
        from dynsolve.explain.abbreviations import Abbreviate

        asked = Abbreviate(abbreviate)
        if not self.robot.has_dynamics or asked is Abbreviate.NEVER:
            return None
        if asked is Abbreviate.ALWAYS or self.forms.are_long:
            return self._abbreviated
        return self._with_symbols_named

    @cached_property
    def _abbreviated(self) -> Abbreviated:
        from dynsolve.explain.abbreviations import abbreviate

        return self._verified(abbreviate(self.forms))

    @cached_property
    def _with_symbols_named(self) -> Abbreviated | None:
        from dynsolve.explain.short_names import name_symbols

        short = name_symbols(self.forms)
        return None if short is None else self._verified(short)

    def _verified(self, short: Abbreviated) -> Abbreviated:
        """The model in names, compared with the independent computation."""
        from dynsolve.explain.recurring import expanded

        D, C, g = expanded(short.definitions, [short.D, short.C, short.g])
        verify(self.robot, {"D": D, "C": C, "g": g}, self.verification.states)
        return short


def _make_all(forms: Forms, progress: Progress) -> None:
    """Make every compact form that is shown; done only where somebody watches the progress."""
    known = quantities(forms.robot)
    made = [(rule.name, known.of_rule(rule.name)) for rule in course_rules(forms.robot)]
    shown = [name for name, q in made if name != "christoffel" and (q is None or q.family.kind in FORMED)]
    shown = list(dict.fromkeys([*_checked(forms).values(), *shown]))
    for done, name in enumerate(shown):
        progress(done, len(shown))
        forms(name)


def _checked(forms: Forms) -> dict[str, str]:
    """What is compared, by its letter: the first forms that are made, so that sums are spelled as there."""
    frame = {"H": f"H{len(forms.robot.joints)}"} if forms.robot.has_table else {}
    return {**frame, **{name: name for name in CHECKED if name in forms.values.rules}}


# The remarks of a problem's author, as notes of the steps that they speak of


def with_remarks(steps: Iterable[Step], problem: Problem, *, whole: bool) -> Iterator[Step]:
    """The steps, those of results with a remark with a note more.

    A remark on an entry (d12, c121) stands at the step of the whole, one on what has no step of
    its own (tau) at the last of its parts.  Raises ProblemError where the steps are the `whole`
    derivation, and none of them is what a remark speaks of, though its stage is there: the way from
    link to link has none of the energies.
    """
    steps, known = tuple(steps), quantities(problem.robot)
    owner = {name: step.id for step in steps for name in (step.id, *step.also)}
    stages = stages_of(problem.robot)
    notes: dict[str, list[Prose]] = defaultdict(list)
    lost = []
    for remark in problem.remarks:
        places = [owner[name] for name in _looked_up(known, remark.name) if name in owner]
        if places:
            notes[places[0]] += [(text,) for text in remark.texts]
        elif whole and known.stage(remark.name) in stages:
            message = f"the solution has no step of {remark.name}"
            lost.append(problem.finding(("remarks", remark.key), message, "remark on another result"))
    if lost:
        raise ProblemError(lost)
    for step in steps:
        yield replace(step, notes=(*step.notes, *notes[step.id])) if step.id in notes else step


def _looked_up(known: Quantities, name: str) -> Iterator[str]:
    """The names under which the step of a result may be found, the nearest first."""
    quantity = known[name]
    yield from (name, quantity.rule, quantity.whole, name.lower())
    yield from (known[part].rule for part in reversed(known.parts(name)))
    if quantity.rule == "Cqd":  # of a long model, which does not write it out
        yield "C"
