"""Whether what is printed is true: every line of a report, evaluated as it stands in the formula tree.

The evaluator here shares no code with the program.  At a random state it gives every member of an equation a
number or a matrix of numbers; members of one equation must agree.  A letter (K₁, ∂L/∂q̇₁, σ₂) means what the
results in the JSON say; one that has no result there means what the first equation says that defines it.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from functools import lru_cache, partial
from itertools import pairwise
from random import Random
from types import CodeType
from typing import Any

import numpy as np

from dynsolve.notation import tree
from dynsolve.notation.python import python_name
from dynsolve.notation.tree import Node, walk

CONDITIONAL = (
    "conserved", "simple poses", "gravity is balanced", "positive definite",  # checks, at poses of their own
    "Checks", "Given", "What decouples", "equilibri", "configurations:", "conditions for balance:",
    "cannot hold", "inverse kinematics:", "equations without multipliers:",
    "Frames from the drawing", "has solutions where", "stable", "do not decide", ": not where",
    "depend on the configuration", "has no inverse", "Summary > At", " holds where", " hold where",
    "holds only where", "hold only where", "solution only where", "solutions",
    "Singular", "Inverse", "Rates ", "Statics", "Forces from outside", "Equilib", "Balance", "Linearization",
    "everywhere: it is 0 at", "Constraints", "Inertia matrices",  # stages, at a pose or a state of their own
)  # fmt: skip
"""In the titles of steps whose equations are conditions (q₂ = 0) or hold under some: they are passed over."""

NULL = tree.Letter("0", style="bold")
"""Zeros: of another shape in the next equation."""

STATE = (tree.Letter("q", style="bold", dots=1), tree.Letter("q", style="bold", dots=2))
"""What is asked for at a state of its own, and stands in the summary without a word."""

TOLERANCE = 1e-8
"""The relative difference that counts as rounding: of the sum of the sizes of what is added up."""


class Unknown(Exception):
    """A formula without a value: one with a running index, say."""


@dataclass(frozen=True)
class Value:
    """A number, or a matrix, with the size of what it was added up from."""

    value: Any
    size: Any

    @property
    def is_matrix(self) -> bool:
        return isinstance(self.value, np.ndarray)

    def close_to(self, other: Value) -> bool:
        mine, theirs = _plain(self.value), _plain(other.value)
        if np.shape(mine) != np.shape(theirs):
            return False
        size = np.maximum(_plain(self.size), _plain(other.size))
        return bool(np.all(np.abs(np.subtract(mine, theirs)) <= TOLERANCE * np.maximum(size, 1e-3)))


def _plain(value: Any) -> Any:
    """A matrix of one entry as that entry."""
    return value.item() if isinstance(value, np.ndarray) and value.size == 1 else value


Place = tuple[int, ...]
Placed = tuple[Node, Place]
"""The form of a result, and the place of an entry in it."""


@dataclass
class Point:
    """What symbols and letters are at a random state; those that are `free` are nothing there.

    `names` has the numbers of the symbols, and `results` the results by their names; each is evaluated
    when it is asked for, by its name or by its letter, which is that of a name in `letters`.

    The forces of motors are free where something acts from outside, or where there are passive coordinates:
    the `passive` ones are 0 in a motion and not in any state.
    """

    known: dict[Node, Value] = field(default_factory=dict)
    free: set[Node] = field(default_factory=set)
    names: dict[str, float] = field(default_factory=dict)
    results: Results = field(default_factory=lambda: Results({}, _nothing))
    letters: Mapping[Node, str] = field(default_factory=dict)
    passive: list[Callable[[], Value]] = field(default_factory=list)
    is_read: bool = False
    """Whether the letters of the steps are known, which the report defines."""

    def again(self) -> Point:
        """The same for another report, whose letters are its own."""
        return Point(dict(self.known), self.free, passive=self.passive)

    def value(self, node: Node) -> Value:
        """The value of a formula.  Raises Unknown."""
        found = self.known.get(node)
        if found is None and node in self.letters:
            found = self.known[node] = self.results[self.letters[node]]
        return self._of(node) if found is None else found

    def _of(self, node: Node) -> Value:
        match node:
            case tree.Number(p, q):
                return Value(p / q, abs(p / q))
            case tree.Degrees(p, q):
                return Value(math.radians(p / q), 1.0)
            case tree.Symbol("pi", 0):
                return Value(math.pi, math.pi)
            case tree.Symbol(name, dots, True):
                return self.value(tree.Symbol(name, dots))
            case tree.Sum(terms):
                return self._sum([self.value(term) for term in terms])
            case tree.Negative(argument):
                inner = self.value(argument)
                return Value(-inner.value, inner.size)
            case tree.Parenthesized(argument) | tree.Slashed(argument):
                return self.value(argument)
            case tree.Product(factors):
                return self._product([self.value(factor) for factor in factors])
            case tree.Quotient(numerator, denominator):
                above, below = self.value(numerator), self.value(denominator)
                if below.is_matrix or not below.value:
                    raise Unknown
                return Value(above.value / below.value, above.size / abs(below.value))
            case tree.Power(base, exponent):
                return self._power(base, exponent)
            case tree.Function():
                return self._function(node)
            case tree.Matrix(rows):
                entries = [[self.value(entry) for entry in row] for row in rows]
                if any(entry.is_matrix for row in entries for entry in row):
                    raise Unknown
                return Value(
                    np.array([[e.value for e in row] for row in entries]),
                    np.array([[e.size for e in row] for row in entries]),
                )
            case tree.Transpose(argument):
                inner = self.value(argument)
                return Value(np.transpose(inner.value), np.transpose(inner.size))
            case tree.Cross(left, right):
                a, b = self.value(left), self.value(right)
                if np.size(a.value) != 3 or np.size(b.value) != 3:
                    raise Unknown
                crossed = np.cross(np.ravel(a.value), np.ravel(b.value)).reshape(3, 1)
                return Value(crossed, np.full((3, 1), np.max(a.size) * np.max(b.size) * 2))
        raise Unknown

    @staticmethod
    def _sum(parts: list[Value]) -> Value:
        if len({np.shape(part.value) for part in parts}) > 1:
            raise Unknown
        return Value(sum(part.value for part in parts), sum(part.size for part in parts))

    @staticmethod
    def _product(parts: list[Value]) -> Value:
        value, size = 1.0, 1.0
        for part in parts:
            if isinstance(value, np.ndarray) and part.is_matrix:
                if value.shape[-1] != part.value.shape[0]:
                    raise Unknown
                value, size = value @ part.value, size @ part.size
            else:
                value, size = value * part.value, size * part.size
        return Value(value, size)

    def _power(self, base: Node, exponent: Node) -> Value:
        match exponent:
            case tree.Number(p, 1):
                inner = self.value(base)
                if inner.is_matrix:
                    raise Unknown
                return Value(inner.value**p, inner.size**p)
            case tree.Negative(tree.Number(1, 1)):
                inner = self.value(base)
                if not inner.is_matrix:
                    return Value(1 / inner.value, abs(1 / inner.value))
                if inner.value.shape[0] != inner.value.shape[1] or np.linalg.cond(inner.value) > 1e6:
                    raise Unknown
                inverse = np.linalg.inv(inner.value)
                return Value(inverse, np.abs(inverse) * np.linalg.cond(inner.value))
        raise Unknown

    def _function(self, node: tree.Function) -> Value:
        functions: Mapping[str, Any] = {"sin": math.sin, "cos": math.cos, "tan": math.tan, "abs": abs}
        if isinstance(node.argument, tree.Arguments):
            if node.name != "atan2":
                raise Unknown
            y, x = map(self.value, node.argument.parts)
            return Value(math.atan2(y.value, x.value), math.pi)
        inner = self.value(node.argument)
        if inner.is_matrix:
            raise Unknown
        if node.name == "sqrt":
            if inner.value < 0:
                raise Unknown
            return Value(math.sqrt(inner.value), math.sqrt(inner.size))
        if node.name == "sgn":
            return Value(math.copysign(1.0, inner.value), 1.0)
        if node.name not in functions:
            raise Unknown
        return Value(functions[node.name](inner.value), max(1.0, abs(inner.size)))


# -- a state of a robot, and a report held to it ----------------------------------------------------


@lru_cache(maxsize=10_000)
def _code(form: Node) -> CodeType:
    from dynsolve.notation.python import PythonPrinter

    return compile(PythonPrinter().text(form), "form", "eval")


def random_point(solution: Any, seed: int) -> Point:
    """The symbols at random or as the file gives them, and the letters of all results, each evaluated."""
    point = state(solution, seed, {})
    for _ in point.results.values():
        pass
    for letter in point.letters:
        point.value(letter)
    return point


class Results(Mapping[str, Value]):
    """The values of forms at a state, each evaluated when it is first asked for."""

    def __init__(self, forms: Mapping[str, Placed], evaluated: Callable[[Node, Place], Value]) -> None:
        self.forms, self.evaluated = forms, evaluated
        self.values_found: dict[str, Value] = {}

    def __getitem__(self, name: str) -> Value:
        if name not in self.values_found:
            self.values_found[name] = self.evaluated(*self.forms[name])
        return self.values_found[name]

    def __contains__(self, name: object) -> bool:
        return name in self.forms

    def __iter__(self) -> Iterator[str]:
        return iter(self.forms)

    def __len__(self) -> int:
        return len(self.forms)


def _nothing(form: Node, place: Place) -> Value:
    raise KeyError(form)


def _results(solution: Any) -> tuple[dict[str, Placed], dict[Node, str]]:
    """The form of each result and its place in that, and the names by their letters; once for all states."""
    if "results of the oracle" not in vars(solution):
        forms = list(_forms(solution))
        placed = {name: (form, place) for name, _, form, place in forms}
        vars(solution)["results of the oracle"] = placed, {letter: name for name, letter, _, _ in forms}
    found: tuple[dict[str, Placed], dict[Node, str]] = vars(solution)["results of the oracle"]
    return found


def _forms(solution: Any) -> Iterator[tuple[str, Node, Node, tuple[int, ...]]]:
    from dynsolve.quantities.index import quantities

    robot = solution.robot
    for quantity in quantities(robot).values():
        family = quantity.family
        if (
            not family.has_letter
            or quantity.rule not in solution.values.rules
            or family.kind.value != "value"
        ):
            continue
        place: tuple[int, ...] = ()
        if quantity.rule == "christoffel":
            i, j, k = quantity.index
            form = solution.forms.christoffel(i - 1, j - 1, k - 1)
        else:
            form = solution.forms(quantity.rule)
            if isinstance(form, tree.Words):
                continue
            if quantity.is_read_off:
                place = quantity.entry if len(quantity.entry) == 2 else (quantity.entry[0], 0)
        yield quantity.name, quantity.letter(robot), form, place


def state(solution: Any, seed: int, at: Mapping[str, float]) -> Point:
    """The same, where `at` says what some symbols are, a rate as q1_dot."""
    from dynsolve.quantities import letters

    random = Random(seed)
    robot, point = solution.robot, Point()
    names = point.names
    for g in robot.ring.generators:
        if g.kind == "symbol":
            text = g.name + ("", "_dot", "_ddot")[g.dots]
            names[text] = float(solution.problem.values.get(g.name, random.uniform(0.3, 2.7)))
            if g.name in robot.ring.names:
                names[text] = random.uniform(-3, 3)
            if g.name == "pi":
                names[text] = math.pi
            names[text] = at.get(text, names[text])
            point.known[tree.Symbol(g.name, g.dots)] = Value(names[text], abs(names[text]))
        elif g.kind in ("sin", "cos"):
            for atom, _ in g.angle.terms:
                for name, _ in atom:
                    names.setdefault(name, at.get(name, random.uniform(0.1, 1.4)))
                    point.known.setdefault(tree.Symbol(name), Value(names[name], abs(names[name])))
    functions = {"sin": math.sin, "cos": math.cos, "sqrt": math.sqrt, "pi": math.pi, "__builtins__": {}}
    functions["sgn"] = lambda x: math.copysign(1.0, x)
    in_python = {python_name(name): number for name, number in names.items()}

    def value(form: Node, place: tuple[int, ...]) -> Value:
        if isinstance(form, tree.Matrix):
            numbers = np.array([[eval(_code(e), functions, in_python) for e in row] for row in form.rows])  # noqa: S307
            return Value(numbers[place], np.abs(numbers[place]))
        number = eval(_code(form), functions, in_python)  # noqa: S307
        return Value(number, abs(number))

    forms, named = _results(solution)
    point.results = Results(forms, value)
    coordinates = [q.name for q in robot.coordinates]
    forces = [named.get(letters.force(q)) for q in robot.coordinates]
    passive = [forces[k] for k in robot.actions.passive]
    point.passive = [partial(point.results.__getitem__, force) for force in passive if force]
    if robot.questions.loads or robot.questions.constraints or robot.actions.passive:
        point.free = {letters.TAU, *map(letters.force, robot.coordinates)}
    point.letters = {letter: name for letter, name in named.items() if letter not in point.free}
    for dots in range(3):
        column = np.array([[point.known[tree.Symbol(name, dots)].value] for name in coordinates])
        point.known[letters.bold("q", dots=dots)] = Value(column, np.abs(column))
    return point


@dataclass(frozen=True)
class Untrue:
    """Two members of an equation that are not equal."""

    where: str
    left: Node
    right: Node
    numbers: str


def untrue(blocks: Any, point: Point, evaluated: list[int] | None = None) -> Iterator[Untrue]:
    """The false equations of a report, in its order; `evaluated` counts [equations that were held, all]."""
    count = [0, 0] if evaluated is None else evaluated
    fold, own = "", set[Node]()
    for where, relation in relations(blocks):
        if where != fold:  # a letter without an index, θ of a row, means what it does in its step
            for letter in own:
                del point.known[letter]
            fold, own = where, set()
        if any(word in where for word in CONDITIONAL) or (
            where.startswith("Summary") and relation.parts[0] in STATE
        ):
            continue
        if point.passive and _is_of_motion(relation):
            continue
        count[1] += 1
        letter, *_, value = relation.parts
        if point.passive and (letter == tree.ZERO or _is_from_outside(letter)):  # a row without a drive
            found, forces = point.value(value), [force() for force in point.passive]
            count[0] += 1
            if not any(found.close_to(one) for one in (point.value(letter), *forces)):
                yield Untrue(where, letter, value, f"{_plain(found.value)} is no passive force")
            continue
        if letter in own and not any(isinstance(part, tree.Letter) for part in walk(value)):
            own.discard(letter)  # r = r₂, of the next body
            del point.known[letter]
        members: list[tuple[Node, Value]] = []
        left_open: list[Node] = []
        for part, sign in zip(relation.parts, ("=", *relation.signs), strict=True):
            if sign not in ("=", "≈", tree.NAMED):
                members, left_open = [], []
            try:
                members.append((part, point.value(part)))
            except (Unknown, ZeroDivisionError, OverflowError):
                if part not in point.free and isinstance(part, tree.Letter | tree.Symbol | tree.Derivative):
                    left_open.append(part)
        count[0] += len(members) + len(left_open) > 1
        for part in set(left_open) - {NULL} if members else ():
            point.known[part] = members[-1][1]
            if _is_of_step(part):
                own.add(part)
        for (a, x), (b, y) in pairwise(members):
            if not x.close_to(y):
                yield Untrue(where, a, b, f"{_plain(x.value)} and {_plain(y.value)}")


def _is_of_motion(relation: tree.Relation) -> bool:
    """Whether it gives 𝐪̈, or balances it with 𝛌: with passive forces that holds in motions alone."""
    from dynsolve.quantities import letters

    inside = [*walk(*relation.parts)]
    is_balance = any(isinstance(part, tree.Symbol) and part.dots == 2 for part in inside)
    return relation.parts[0] == STATE[1] or (is_balance and letters.LAMBDA in inside)


def _is_from_outside(node: Node) -> bool:
    """Whether a letter is an entry of 𝐐, which a row without a drive has alone on its left."""
    return (
        isinstance(node, tree.Letter) and (node.base, node.style) == ("Q", "italic") and node.sub is not None
    )


def _is_of_step(node: Node) -> bool:
    """Whether a letter has no index, as θ of a row of the table; h is the name of a Christoffel symbol."""
    match node:
        case tree.Letter(_, sub):
            return sub is None or sub in (tree.Symbol("o"), tree.Symbol("i"))
        case tree.Symbol(name):
            return name != "h" and not any(map(str.isdigit, name))
    return False


def relations(blocks: Any, where: str = "") -> Iterator[tuple[str, tree.Relation]]:
    """Every equation of a report with the step that it stands in."""
    from dynsolve import document

    section = where
    for block in blocks:
        match block:
            case document.Heading():
                where = section = block.text if block.level > 1 else "Given"
            case document.Text() if section == "Summary":
                where = f"{section} > {''.join(part for part in block.parts if isinstance(part, str))}"
            case document.Note() if any(
                ": not where" in part for part in block.parts if isinstance(part, str)
            ):
                continue  # what it says is 0 is so there alone
            case document.Fold():
                yield from relations(block.blocks, f"{where} > {block.title}")
                continue
        nodes: list[Node] = []
        match block:
            case document.Formula():
                nodes = [block.node]
            case document.Equations():
                nodes = list(block.nodes)
            case document.Text() | document.Note() | document.Uses():
                nodes = [part for part in block.parts if isinstance(part, Node)]
            case document.List():
                nodes = [part for item in block.items for part in item if isinstance(part, Node)]
            case document.Table():
                nodes = [cell for row in block.rows for cell in row if isinstance(cell, Node)]
        yield from ((where, part) for part in walk(*nodes) if isinstance(part, tree.Relation))
