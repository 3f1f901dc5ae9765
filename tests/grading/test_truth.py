r"""Hand-ins whose truth is known, written in many notations: one judge for all of them, in any order.

A slip is made in one quantity and SymPy carries it through what comes after, so that nothing
that judges has a part in the truth.  Every hand-in gives the same few names (`h`, `x`, `\aa`)
a meaning of its own: what one student defines must never be seen in what another wrote.
"""

from __future__ import annotations

import random
import re
from collections.abc import Callable
from functools import cache
from typing import Any, NamedTuple

import pytest
import sympy

import dynsolve
from dynsolve.answers.judge import Checker
from dynsolve.answers.report import to_json
from dynsolve.solution.solution import Solution
from tests.grading.generate import latex_of

pytestmark = pytest.mark.slow

TWISTED = """
convention: modified
gravity: [0, -9.81, 0]
dh:
  - {theta: q1* + 90deg, d: 0, a: 0, alpha: 0}
  - {theta: 0, d: q2* + b2/2, a: a1, alpha: 30deg}
masses:
  - {mass: m1, link: 1, center: [x1, 0, 0], inertia: {zz: I1}}
  - {mass: 1.5, link: 2, center: [0, y2, 0], inertia: {xx: I2xx, yy: I2yy, zz: I2zz}}
"""
ROBOTS = {"in3140-rp": "in3140-rp", "planar-2r": "planar-2r", "crustcrawler-2r": "crustcrawler-2r",
          "twisted": TWISTED}  # fmt: skip
HAND_INS = 15


class HandIn(NamedTuple):
    """A file, what each of its answers is, and where it first goes wrong."""

    file: str
    text: str
    truth: dict[str, str]
    start: str


@cache
def _solution(robot: str) -> Solution:
    return dynsolve.solve(ROBOTS[robot], states=1)


class Course:
    """The key of one robot, and slips carried through it."""

    def __init__(self, robot: str) -> None:
        self.solution = solution = _solution(robot)
        coordinates = solution.to_json()["coordinates"]
        self.q = [sympy.Symbol(c["name"], real=True) for c in coordinates]
        self.v = [sympy.Symbol(c["velocity"], real=True) for c in coordinates]
        self.a = [sympy.Symbol(c["acceleration"], real=True) for c in coordinates]
        self.forces = [c["force"] for c in coordinates]
        self.bodies = [body.name for body in solution.robot.bodies]
        energies = [f"{letter}{b}" for letter in "PK" for b in self.bodies]
        self.key = {name: sympy.expand(solution.symbolic(name)) for name in energies}
        self.key = self.carried({})
        moving = {*self.q, *self.v, *self.a}
        self.parameters = {s for n in energies for s in self.key[n].free_symbols} - moving

    def carried(self, wrong: dict[str, Any]) -> dict[str, Any]:
        """Everything that the energies of the bodies lead to, with some of it replaced."""
        found = {**{n: self.key[n] for n in self.key if n[1:] in self.bodies}, **wrong}

        def put(name: str, value: Any) -> None:
            found.setdefault(name, sympy.expand(value))

        for letter in "PK":
            put(letter, sum(found[f"{letter}{b}"] for b in self.bodies))
        put("L", found["K"] - found["P"])
        for i, (q, v, force) in enumerate(zip(self.q, self.v, self.forces, strict=True), start=1):
            put(f"dLdqd{i}", found["L"].diff(v))
            put(f"ddt{i}", self._rate(found[f"dLdqd{i}"]))
            put(f"dLdq{i}", found["L"].diff(q))
            put(force, found[f"ddt{i}"] - found[f"dLdq{i}"])
        tau = sympy.Matrix([found[force] for force in self.forces])
        return found | {
            "tau": tau,
            "D": tau.jacobian(self.a),
            "g": tau.subs(dict.fromkeys([*self.v, *self.a], 0)),
        }

    def _rate(self, value: Any) -> Any:
        steps = zip(self.q, self.v, self.a, strict=True)
        return sum((value.diff(q) * v + value.diff(v) * a for q, v, a in steps), sympy.Integer(0))

    def slipped(self, value: Any, chance: random.Random) -> Any:
        """One term of another sign or number, left out, or with a symbol too many."""
        term = chance.choice(sympy.Add.make_args(value))
        extra = chance.choice([-2 * term, term, -term / 2, -term, term * sympy.Symbol("m1", real=True)])
        return sympy.expand(value + extra)

    def hand_in(self, number: int, chance: random.Random) -> HandIn:
        """A hand-in with a slip, or none, in a notation and with names of its own."""
        write, kind, form = chance.choice([(_answer_file, "yaml", ANYWHERE), (_report, "md", IN_REPORTS)])
        allowed = [n for n in self.key if form.fullmatch(n)]
        given, start = self.key, ""
        if chance.random() < 0.7:
            start = chance.choice([n for n in allowed if n not in ("tau", "D", "g") and self.key[n] != 0])
            value = self.slipped(self.key[start], chance)
            moving = (value - self.key[start]).free_symbols & {*self.q, *self.v, *self.a}
            if moving or start[0] not in "PL":  # else another zero level, which is free
                given = self.carried({start: value})
            else:
                start = ""
        names = [n for n in allowed if n == start or chance.random() < 0.6]
        truth = {n: "correct" if _same(given[n], self.key[n]) else "follows" for n in names}
        truth |= {start: "wrong"} if start else {}
        return HandIn(f"s{number}.{kind}", write(self, {n: given[n] for n in names}, chance), truth, start)


def _same(a: Any, b: Any) -> bool:
    return (a - b).expand() == (b - b)


# -- writing ---------------------------------------------------------------------------------------

NOTATIONS = {
    "dot": ("{}_dot", "{}_ddot"), "prime": ("{}'", "{}''"), "d": ("d{}", "dd{}"),
    "sympy": ("Derivative({}(t), t)", "Derivative({}(t), (t, 2))"),
    "matlab": ("diff({}(t), t)", "diff({}(t), t, t)"), "maxima": ("'diff({},t)", "'diff({},t,2)"),
}  # fmt: skip
ANYWHERE, IN_REPORTS = re.compile(".+"), re.compile(r"[PK]\d?|L|D|g|tau\d?|f\d")


def _form(value: Any, chance: random.Random) -> Any:
    """The same value as somebody else would write it."""
    factored = sympy.factor if value.count_ops() < 60 else sympy.expand
    return chance.choice([sympy.expand, factored, lambda e: sympy.expand(sympy.expand_trig(e))])(value)


def _text(value: Any, write: Callable[[Any], str], ends: tuple[str, str, str, str]) -> str:
    """A scalar or a matrix; `ends` are what opens and closes a matrix, and separates rows and entries."""
    if not isinstance(value, sympy.MatrixBase):
        return write(value)
    rows = (ends[3].join(map(write, value.row(i))) for i in range(value.rows))
    return ends[0] + ends[2].join(rows) + ends[1]


def _answer_file(course: Course, answers: dict[str, Any], chance: random.Random) -> str:
    """In plain text, a parameter renamed to x and an abbreviation h."""
    one, two = NOTATIONS[chance.choice(sorted(NOTATIONS))]
    renamed = chance.choice(sorted(course.parameters, key=str))
    short = chance.choice(sorted(course.parameters - {renamed}, key=str)) * 2

    def write(value: Any) -> str:
        value = _form(value, chance).subs(short / 2, sympy.Symbol("h") / 2).subs(renamed, sympy.Symbol("x"))
        text = str(value)
        for q, v, a in zip(course.q, course.v, course.a, strict=True):
            text = re.sub(rf"\b{a}\b", two.format(q), re.sub(rf"\b{v}\b", one.format(q), text))
        return text

    lines = [f"symbols: {{x: {renamed}}}", "let:", f"  h: {short}", "answers:"]
    lines += [
        f"  {name}: {_text(value, write, ('[[', ']]', '], [', ', '))}" for name, value in answers.items()
    ]
    return "\n".join(lines) + "\n"


def _report(course: Course, answers: dict[str, Any], chance: random.Random) -> str:
    """In LaTeX, a command for one parameter and a definition with another."""
    named = chance.choice(sorted(course.parameters, key=str))
    short = chance.choice(sorted(course.parameters - {named}, key=str)) * 2

    def write(value: Any) -> str:
        text = latex_of(str(_form(value, chance).subs(short / 2, sympy.Symbol("h") / 2)))
        return re.sub(rf"(?<![\w\\]){re.escape(latex_of(str(named)))}(?![\w^])", lambda _: r"\aa ", text)

    matrix = (r"\begin{pmatrix} ", r" \end{pmatrix}", r" \\ ", " & ")
    lines = [rf"$$\newcommand{{\aa}}{{{latex_of(str(named))}}}$$", f"$$\nh = {latex_of(str(short))}\n$$"]
    for name, value in answers.items():
        head = re.sub(r"(\D)(\d)", r"\1_\2", name.replace("tau", r"\tau"))
        lines.append(f"$$\n{head} = {_text(value, write, matrix)}\n$$")
    return "\n\n".join(lines) + "\n"


# -- judged ----------------------------------------------------------------------------------------


def _judged(checker: Checker, one: HandIn) -> dict[str, Any]:
    return to_json(checker(checker.reader(one.text.encode(), one.file)), level=3, teacher=True)


@pytest.mark.parametrize("robot", sorted(ROBOTS))
def test_verdicts_are_the_truth_whoever_was_judged_before(robot: str) -> None:
    chance = random.Random(robot)
    course, solution = Course(robot), _solution(robot)
    hand_ins = [course.hand_in(number, chance) for number in range(HAND_INS)]
    shared = Checker(solution.problem, solution.values)
    found = {one.file: _judged(shared, one) for one in hand_ins}
    for one in hand_ins:
        answers = {a["name"]: a for a in found[one.file]["answers"] if a["name"] in one.truth}
        said = {name: a["verdict"] for name, a in answers.items()}
        assert (said, one.text) == (one.truth, one.text)
        assert (found[one.file]["first_wrong"], one.text) == (one.start, one.text)
        for name, a in answers.items():
            sources = set(a["follows_from"])
            assert bool(sources) == (said[name] == "follows") and all(said[s] != "correct" for s in sources)
    for one in chance.sample(hand_ins, len(hand_ins)):
        assert _judged(shared, one) == found[one.file], one.text
    for one in hand_ins[::5]:
        assert _judged(Checker(solution.problem, solution.values), one) == found[one.file], one.text
