"""From a problem to its verified solution: what Python users hold in their hands."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, Any

from dynsolve.derivation.agreement import Agreement, agreement, given_axes_agree
from dynsolve.derivation.graph import Derivation
from dynsolve.derivation.inertia import turns_with_link
from dynsolve.derivation.rules import course_rules, derive
from dynsolve.derivation.verification import Verification, verify
from dynsolve.errors import Finding, ProblemError, UsageError, VerificationError
from dynsolve.explain.forms import Forms
from dynsolve.explain.step import Step
from dynsolve.explain.style import style_of
from dynsolve.notation.printing import Style
from dynsolve.notation.tree import Node
from dynsolve.problem import Problem, read_problem
from dynsolve.problem import load as load_file
from dynsolve.robot.model import Robot
from dynsolve.solution.numbers.given import Given

if TYPE_CHECKING:
    import sympy

    from dynsolve.document import Block, Document
    from dynsolve.explain.abbreviations import Abbreviate, Abbreviated
    from dynsolve.explain.step import Detail
    from dynsolve.solution.numbers.assignments import Assignment, Plain
    from dynsolve.solution.numbers.beside import Numbers
    from dynsolve.solution.numbers.state import State
    from dynsolve.solution.numeric import NumericFunction

CHECKED = ("J", "D", "C", "g", "tau", "K", "P")
"""The results that are held against the independent computation, besides the last H."""


def load(problem: str | os.PathLike[str]) -> Problem:
    """Read a problem: a path, or the stem of a bundled problem.

    Raises ProblemError with every fault of the file.

    >>> load("planar-2r").title
    'Planar elbow manipulator'
    """
    from dynsolve.problem.library import find

    return load_file(find(os.fspath(problem)))


def solve(
    problem: Problem | str | os.PathLike[str],
    *,
    states: int = 5,
    progress: Callable[[int, int], None] | None = None,
) -> Solution:
    """Derive the dynamics of a robot, and verify the result.

    `problem` is a `Problem`, a path, the stem of a bundled problem, or the text of
    a problem file (with line breaks).  `states` is the number of random states at
    which the result is held against recursive Newton-Euler; `progress(done, of)` is
    told how far the work is.

    Raises ProblemError for a faulty problem, VerificationError where the result
    disagrees with the independent computation.

    >>> solution = solve("planar-2r")
    >>> solution.D[1, 1]
    I2 + lc2**2*m2
    >>> solution.verification.max_relative_error < 1e-9
    True
    """
    if isinstance(problem, str) and "\n" in problem:
        problem = read_problem(problem)
    elif not isinstance(problem, Problem):
        problem = load(problem)
    values = derive(problem.robot)
    warnings = (*problem.warnings, *_given_axes(problem, values))
    forms = _forms(problem.robot, values, progress)
    held = None
    if problem.robot.bodies:
        held = agreement(problem.robot, values)
        if not held.holds:
            raise VerificationError(
                "what is read off from the forces differs from what is assembled directly"
            )
    verification = verify(problem.robot, _checked(problem.robot, forms), states)
    return Solution(problem, values, forms, verification, held, warnings)


def _forms(robot: Robot, values: Derivation, progress: Callable[[int, int], None] | None) -> Forms:
    """The compact forms; where somebody watches, all of them are made now."""
    forms = Forms(robot, values)
    if progress is not None:
        shown = [rule.name for rule in course_rules(robot) if rule.name != "christoffel"]
        for done, name in enumerate(shown):
            progress(done, len(shown))
            forms(name)
    return forms


def check_axes(problem: Problem) -> tuple[Finding, ...]:
    """What there is to say about given R_b that do not turn with their links.

    Raises ProblemError where the kinetic energy would come out wrong.
    """
    return tuple(_given_axes(problem, derive(problem.robot)))


def _checked(robot: Robot, forms: Forms) -> dict[str, Node]:
    names = CHECKED if robot.bodies else ("J",)
    return {"H": forms(f"H{len(robot.joints)}"), **{name: forms(name) for name in names}}


def _given_axes(problem: Problem, values: Derivation) -> Iterator[Finding]:
    """What there is to say about given R_b that do not turn with their links; raises where they are wrong."""
    robot = problem.robot
    faults = []
    for place, body in enumerate(robot.bodies):
        if turns_with_link(robot, body, values[f"H{body.link}"]):
            continue
        path = ("masses", place, "axes")
        what = f"the given rotation of body {body.name} does not turn with link {body.link}"
        if given_axes_agree(robot, body, values):
            message = f"{what}; it is used as given, since the kinetic energy comes out the same"
            yield problem.finding(path, message, "write `axes: base` for a frame that turns", "axes-fixed")
        else:
            message = f"{what}, and the kinetic energy would come out wrong"
            help = (
                "a body's frame turns with its link: `axes: base` is parallel to frame 0 at q = 0 and turns"
            )
            faults.append(problem.finding(path, message, help, "axes-fixed"))
    if faults:
        raise ProblemError(faults)


@dataclass(frozen=True)
class Solution:
    """A robot's dynamics, derived and verified.

    `values` are exact, by the names of the answer file (`H2`, `Jv1`, `K`, `D`);
    `forms` are the same as compact trees.  `D`, `C`, `g`, `tau` and the others are
    SymPy objects in real symbols, velocities `theta1_dot`, accelerations
    `theta1_ddot`.  A robot without masses has no more than `A`, `H`, `J`, `Jv`, `Jw`.
    """

    problem: Problem
    values: Derivation
    forms: Forms
    verification: Verification
    agreement: Agreement | None = None
    warnings: tuple[Finding, ...] = field(default=())
    given: Given = field(default_factory=Given)
    numbers: Numbers | None = None

    @property
    def robot(self) -> Robot:
        """The robot."""
        return self.problem.robot

    @cached_property
    def style(self) -> Style:
        """How the formulas look: s_1 for sin θ_1 where that is clear."""
        return style_of(self.robot)

    @cached_property
    def steps(self) -> tuple[Step, ...]:
        """The whole derivation, step by step."""
        return tuple(self.explain())

    def explain(
        self, stages: Iterable[str] | None = None, short: Abbreviated | None = None
    ) -> Iterator[Step]:
        """The steps of some stages, in the order of the course; with `short`, in its names."""
        from dynsolve.explain import explain
        from dynsolve.explain.course import Course
        from dynsolve.explain.named import in_names

        course = Course(self.robot, self.values, self.forms, self.agreement)
        steps = explain(course, stages)
        return steps if short is None else in_names(steps, course, short)

    def abbreviated(self, abbreviate: Abbreviate | str = "always") -> Abbreviated | None:
        """D, C and g with constants and recurring terms named; held against the independent computation.

        With `auto` None where they are short enough to be read, with `never` always None.

        >>> short = solve("planar-2r").abbreviated()
        >>> [definition.name.name for definition in short.definitions]
        ['h']
        """
        from dynsolve.explain.abbreviations import Abbreviate, is_long

        asked = Abbreviate(abbreviate)
        if not self.robot.bodies or asked is Abbreviate.NEVER:
            return None
        return self._abbreviated if asked is Abbreviate.ALWAYS or is_long(self.forms) else None

    @cached_property
    def _abbreviated(self) -> Abbreviated:
        from dynsolve.explain.abbreviations import abbreviate, expanded

        short = abbreviate(self.forms)
        D, C, g = expanded(short.definitions, [short.D, short.C, short.g])
        verify(self.robot, {"D": D, "C": C, "g": g}, self.verification.states)
        return short

    def hint(self, stage: str) -> Document:
        """What to do in a stage, as a document that holds no result of it or of a later one.

        Raises UsageError for a stage that this robot does not have.

        >>> solve("planar-2r").hint("lagrangian").blocks[1].text
        'Hint: the Lagrangian'
        """
        from dynsolve.explain.course import Course
        from dynsolve.explain.hint import hint_document

        return hint_document(self.problem.title, Course(self.robot, self.values, self.forms), stage)

    def to_json(self, abbreviate: Abbreviate | str = "never") -> dict[str, Any]:
        """The solution as JSON, `dynsolve-solution/1`; with `always` a section `abbreviated` too."""
        from dynsolve.solution.export import to_json

        return to_json(self, self.abbreviated("always") if abbreviate == "always" else None)

    def symbolic(self, name: str) -> Any:
        """A quantity as SymPy, by its name in an answer file: `H2`, `Jv1`, `Kw1`, `dLdqd1`, `D`.

        Raises UsageError for a name that this robot does not have.
        """
        from dynsolve.solution.symbolic import to_sympy

        if name not in self.values.rules or name == "christoffel":
            raise UsageError(f"{name} is no quantity of this robot")
        return to_sympy(self.forms(name))

    def christoffel(self, i: int, j: int, k: int) -> sympy.Expr:
        """c_ijk, indices from 1 as in the textbook."""
        from dynsolve.solution.symbolic import to_sympy

        return to_sympy(self.forms.christoffel(i - 1, j - 1, k - 1))

    def numeric(self, name: str) -> NumericFunction:
        """A quantity as a NumPy function of q, q̇, q̈ and the parameters; see `dynsolve.solution.numeric`.

        >>> D = solve("planar-2r").numeric("D")
        >>> D([0, 0], m1=1, m2=1, l1=1, lc1=0.5, lc2=0.5, I1=0, I2=0).round(3).tolist()
        [[2.5, 0.75], [0.75, 0.25]]
        """
        from dynsolve.solution.numeric import NumericFunction

        if name not in self.values.rules or name == "christoffel":
            raise UsageError(f"{name} is no quantity of this robot")
        return NumericFunction.of(name, self.forms(name), self.problem)

    # -- numbers -----------------------------------------------------------------------------------

    def with_values(self, /, **values: Plain) -> Solution:
        """The solution of the same robot with numbers for parameters, exact and verified again.

        Values are numbers or texts (`"1/3"`, `"sqrt(2)/2"`, `"30deg"`); a float stands for
        the decimal it is printed as.  The `values:` of the problem file count too, unless
        given here.  Raises InputError for a name that the robot does not have, or an angle
        without `deg`; UsageError where a formula has no meaning with them.

        >>> solution = solve("planar-2r").with_values(m2=2, lc2=0.25, I2="1/10")
        >>> solution.D[1, 1]
        9/40
        """
        from dynsolve.solution.numbered import with_values
        from dynsolve.solution.numbers.assignments import of_call
        from dynsolve.solution.numbers.given import parameters

        return with_values(self, parameters(self.problem, of_call(values)))

    def at(self, /, **state: Plain) -> State:
        """What holds at a state: every result with numbers for coordinates, velocities, accelerations.

        Every coordinate must be given (an angle as `"30deg"` or `"0.5rad"`); velocities
        (`theta1_dot`) and accelerations (`theta1_ddot`) that are not given are 0.
        Results are exact.  Raises InputError for a coordinate that is missing or unknown.

        >>> state = solve("planar-2r").at(q1="30deg", q2="90deg", q1_dot=2)
        >>> state.symbolic("v1").T
        Matrix([[-lc1, sqrt(3)*lc1, 0]])
        >>> solve("planar-2r").with_values(l1=1, lc1=0.5).at(q1="17deg", q2=0).number("H1")[0]
        [0.9563047559630354, -0.2923717047227367, 0.0, 0.9563047559630354]
        """
        from dynsolve.solution.numbered import at_state
        from dynsolve.solution.numbers.assignments import of_call
        from dynsolve.solution.numbers.given import state as read_state

        return at_state(self, read_state(self.problem, of_call(state)))

    def beside(
        self,
        values: Iterable[Assignment] = (),
        state: Iterable[Assignment] | None = None,
        digits: int | None = None,
    ) -> Solution:
        """The same solution with numeric results beside the symbolic ones in its documents and JSON.

        With `values`, or where the problem file has one for every parameter, come the
        results with these values; with `state` every result at that state, too.  Results
        are exact where no decimal goes in, else, or with `digits`, decimals.
        """
        from dynsolve.solution.numbered import beside

        return beside(self, values, state, digits)

    def number_blocks(self, detail: Detail, stages: Iterable[str] | None = None) -> Iterator[Block]:
        """What a document says in numbers: nothing unless `beside` gave them."""
        if self.numbers is not None:
            from dynsolve.solution.numbers.documents import blocks

            yield from blocks(self.numbers, detail, stages)

    # -- the results by name -----------------------------------------------------------------------

    @cached_property
    def A(self) -> tuple[sympy.Matrix, ...]:
        """A_1, A_2, ..., 4×4."""
        return tuple(self.symbolic(f"A{joint.index}") for joint in self.robot.joints)

    @cached_property
    def H(self) -> tuple[sympy.Matrix, ...]:
        """H_1, H_2, ..., 4×4, from the base (or the world)."""
        return tuple(self.symbolic(f"H{joint.index}") for joint in self.robot.joints)

    @cached_property
    def J(self) -> sympy.Matrix:
        """The Jacobian of the end of the arm, 6×n."""
        return self.symbolic("J")

    @cached_property
    def Jv(self) -> sympy.Matrix:
        """Its linear part, 3×n."""
        return self.symbolic("Jv")

    @cached_property
    def Jw(self) -> sympy.Matrix:
        """Its angular part, 3×n."""
        return self.symbolic("Jw")

    @cached_property
    def P(self) -> sympy.Expr:
        """The potential energy."""
        return self.symbolic("P")

    @cached_property
    def K(self) -> sympy.Expr:
        """The kinetic energy."""
        return self.symbolic("K")

    @cached_property
    def L(self) -> sympy.Expr:
        """The Lagrangian K - P."""
        return self.symbolic("L")

    @cached_property
    def tau(self) -> sympy.Matrix:
        """The generalized forces, n×1."""
        return self.symbolic("tau")

    @cached_property
    def D(self) -> sympy.Matrix:
        """The inertia matrix, n×n."""
        return self.symbolic("D")

    @cached_property
    def C(self) -> sympy.Matrix:
        """The Coriolis matrix by Christoffel symbols, n×n."""
        return self.symbolic("C")

    @cached_property
    def g(self) -> sympy.Matrix:
        """The gravity vector, n×1."""
        return self.symbolic("g")
