"""What a Python user holds: `solve(problem)` gives a `Solution`.

`Solution` adds to the derived and verified `Dynamics` what a user asks of it: results as
SymPy, NumPy and JSON, numbers put in, hints.
"""

from __future__ import annotations

import os
from collections.abc import Iterable
from functools import cached_property
from typing import TYPE_CHECKING, Any

from msgspec.structs import replace

from dynsolve.errors import AlgebraError, UsageError
from dynsolve.explain.forms import Forms
from dynsolve.notation.tree import Node
from dynsolve.problem import Problem, read_problem
from dynsolve.problem import load as load_file
from dynsolve.robot.questions import Method
from dynsolve.solution.dynamics import Dynamics, Progress, by_method
from dynsolve.solution.numbers.given import Given, parameters
from dynsolve.solution.numbers.given import state as read_state

if TYPE_CHECKING:
    import sympy

    from dynsolve.document import Document
    from dynsolve.explain.abbreviations import Abbreviate
    from dynsolve.solution.numbers.given import Assignment, Plain
    from dynsolve.solution.numbers.results import State
    from dynsolve.solution.numeric import NumericFunction


def load(problem: str | os.PathLike[str]) -> Problem:
    """Read a problem: a path, or the stem of a bundled problem.

    Raises ProblemError with every fault of the file.

    >>> load("planar-2r").title
    'Planar elbow manipulator'
    """
    from dynsolve.problem.reader import find

    return load_file(find(os.fspath(problem)))


def solve(
    problem: Problem | str | os.PathLike[str],
    *,
    states: int = 5,
    method: Method | str = Method.LAGRANGE,
    progress: Progress | None = None,
) -> Solution:
    """Derive the dynamics of a robot, and verify the result.

    `problem` is a `Problem`, a path, the stem of a bundled problem, or the text of
    a problem file (with line breaks).  `states` is the number of random states at
    which the result is compared with recursive Newton-Euler; `method` is the way to the
    forces, `lagrange` or `newton-euler`; `progress(done, of)` is told how far the work is.

    Raises ProblemError for a faulty problem, UsageError for Newton-Euler without masses,
    VerificationError where the result disagrees with the independent computation.

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
    return Solution.of(by_method(problem, Method(method)), states, progress)


class Solution(Dynamics, frozen=True, dict=True):
    """A robot's dynamics, derived and verified, in the forms that a user asks for.

    `D`, `C`, `g`, `tau` and the others are SymPy objects in real symbols, velocities
    `theta1_dot`, accelerations `theta1_ddot`.  A robot without masses has no more than
    `A`, `H`, `J`, `Jv`, `Jw`.
    """

    def hint(self, stage: str) -> Document:
        """What to do in a stage, as a document that holds no result of it or of a later one.

        Raises UsageError for a stage that this robot does not have.

        >>> solve("planar-2r").hint("lagrangian").blocks[1].text
        'Hint: the Lagrangian'
        """
        from dynsolve.document import rewritten
        from dynsolve.document.books import of_second_edition
        from dynsolve.explain.context import Context
        from dynsolve.explain.hint import hint_document

        context = Context(self.robot, self.values, self.forms, normals=self.problem.normals)
        document = hint_document(self.problem.title, context, stage)
        return rewritten(document, words=of_second_edition) if self.problem.edition == 2 else document

    def to_json(self, abbreviate: Abbreviate | str = "never") -> dict[str, Any]:
        """The solution as JSON, `dynsolve-solution/1`; with `always` a section `abbreviated` too."""
        from dynsolve.solution.json_export import to_json

        return to_json(self, abbreviate)

    # -- as pages, and in a notebook -----------------------------------------------------------------

    def to_html(self, detail: str = "normal") -> str:
        """A page with the solution at each depth, opened at `detail`: results, brief, normal or full."""
        return self._report("html", detail).decode()

    def to_latex(self, detail: str = "normal") -> str:
        r"""A LaTeX document of the solution at a depth.

        >>> solve("planar-2r").to_latex("results").splitlines()[0]
        '\\documentclass[a4paper]{article}'
        """
        return self._report("latex", detail).decode()

    def to_markdown(self, detail: str = "normal") -> str:
        """The solution at a depth as Markdown, as GitHub and Jupyter show it."""
        return self._report("markdown", detail).decode()

    def to_pdf(self, detail: str = "normal") -> bytes:
        """The solution at a depth as PDF, without TeX; needs the extra [pdf]."""
        return self._report("pdf", detail)

    def _report(self, format: str, detail: str) -> bytes:
        from dynsolve.explain.step import Detail
        from dynsolve.render.files import Format
        from dynsolve.solution.reports import report

        names = [each.name.lower() for each in Detail]
        if detail not in names:
            raise UsageError(f"{detail} is no depth", f"take one of {', '.join(names)}")
        return report(self, Format(format), detail=Detail[detail.upper()])

    def __repr__(self) -> str:
        """The title and what was compared; the results are its attributes."""
        error = f"{self.verification.max_relative_error:.1e}"
        return f"<Solution of {self.problem.title}, verified (relative error {error})>"

    def _repr_html_(self) -> str:
        from dynsolve.solution.reports import notebook_html

        return notebook_html(self)

    def _repr_markdown_(self) -> str:
        from dynsolve.solution.reports import notebook_markdown

        return notebook_markdown(self)

    def _repr_latex_(self) -> str:
        from dynsolve.solution.reports import notebook_latex

        return notebook_latex(self)

    def symbolic(self, name: str) -> Any:
        """A quantity as SymPy, by its name in an answer file: `H2`, `Jv1`, `Kw1`, `dLdqd1`, `D`.

        Raises UsageError for a name that this robot does not have.
        """
        from dynsolve.solution.numeric import to_sympy

        return to_sympy(self._form(name))

    def christoffel(self, i: int, j: int, k: int) -> sympy.Expr:
        """c_ijk, indices from 1 as in the textbook."""
        from dynsolve.solution.numeric import to_sympy

        return to_sympy(self.forms.christoffel(i - 1, j - 1, k - 1))

    def numeric(self, name: str) -> NumericFunction:
        """A quantity as a NumPy function of q, q̇, q̈ and the parameters; see `dynsolve.solution.numeric`.

        >>> D = solve("planar-2r").numeric("D")
        >>> D([0, 0], m1=1, m2=1, l1=1, lc1=0.5, lc2=0.5, I1=0, I2=0).round(3).tolist()
        [[2.5, 0.75], [0.75, 0.25]]
        """
        from dynsolve.solution.numeric import NumericFunction

        return NumericFunction.of(name, self._form(name), self.problem)

    def _form(self, name: str) -> Node:
        if name not in self.values.rules or name == "christoffel":
            raise UsageError(f"{name} is no quantity of this robot")
        return self.forms(name)

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
        from dynsolve.solution.numbers.given import of_call

        return self._with(parameters(self.problem, of_call(values)))

    def _with(self, given: Given) -> Solution:
        """The solution of the robot with these values in it."""
        from dynsolve.solution.numbers.substitution import robot_with

        try:
            robot = robot_with(self.robot, given.values)
            robot = replace(robot, has_decimals=robot.has_decimals or given.decimal)
            # the table was held to the drawing with symbols, and has other ones now
            valued = solve(replace(self.problem, robot=robot, normals=None))
        except AlgebraError as error:
            raise UsageError(f"with these values the robot has no solution: {error.message}") from error
        return replace(valued, given=Given({**self.given.entries, **given.entries}, given.warnings))

    def _in_decimals(self, digits: int) -> Solution:
        """The solution of a model in numbers with so many significant digits."""
        robot = replace(self.robot, has_decimals=True)
        problem, forms = replace(self.problem, robot=robot), Forms(robot, self.values)
        return replace(self, problem=problem, forms=forms, digits=digits)

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
        from dynsolve.solution.numbers.given import of_call

        return self._at(read_state(self.problem, of_call(state)))

    def _at(self, state: Given, digits: int | None = None) -> State:
        from dynsolve.solution.numbers.results import State

        return State(
            robot=self.robot,
            values=self.values,
            given=state,
            decimal=self.given.decimal or digits is not None,
            digits=digits or 0,
        )

    def beside(
        self,
        values: Iterable[Assignment] = (),
        state: Iterable[Assignment] | None = None,
        digits: int | None = None,
    ) -> Solution:
        """The same solution with numeric results beside the symbolic ones in its documents and JSON.

        With `values`, or where the problem file has one for every parameter, come the
        results with these values; with `state` every result at that state, too.  Results
        are exact where no decimal goes in, else, or with `digits`, decimals.  A model in
        numbers is itself shown with so many `digits`.
        """
        from dynsolve.solution.numbers.results import Numbers, Valued, needed

        shown = self if digits is None or not self.robot.is_numeric else self._in_decimals(digits)
        values = tuple(values)
        all_parameters = set(needed(self.robot))
        with_values = bool(values) or (bool(all_parameters) and all_parameters <= self.problem.written.keys())
        if not with_values and state is None:
            return shown
        given = parameters(self.problem, values)
        at = None if state is None else read_state(self.problem, state)
        numeric = self._with(given) if given.entries else self
        decimal = given.decimal or digits is not None or self.robot.has_decimals
        valued = Valued(
            robot=numeric.robot,
            values=numeric.values,
            forms=Forms(numeric.robot, numeric.values, decimal=True) if decimal else numeric.forms,
            given=given,
            decimal=decimal,
            digits=digits or 0,
        )
        numbers = Numbers(
            robot=self.robot,
            given=given,
            valued=valued if given.entries and with_values else None,
            state=None if at is None else numeric._at(at, digits),
        )
        return replace(shown, numbers=numbers)

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
