"""Hand-ins made from the key: right ones and ones with a slip, in plain text and in LaTeX."""

from __future__ import annotations

import random
import re
from functools import cache, lru_cache
from pathlib import Path

from dynsolve.notation.markup import to_latex
from dynsolve.notation.printing import PLAIN
from dynsolve.notation.python import to_python
from dynsolve.notation.text import read
from dynsolve.notation.tree import Negative, Node, Parenthesized, Power, Product, Quotient, Sum
from dynsolve.solution.solution import solve

PROBLEMS = ("in3140-rp", "planar-2r", "elbow-3r")
SLIPS = 0.3


@cache
def key(problem: str) -> dict[str, str | list[list[str]]]:
    """Ten answers as `solve --json` prints them."""
    results = solve(problem).to_json()["results"]
    bodies = results["bodies"]
    found = {f"P{body['name']}": body["P"] for body in bodies[:2]}
    found |= {f"K{body['name']}": body["K"] for body in bodies[:2]}
    found |= {"P": results["P"], "K": results["K"], "D": results["D"], "C": results["C"]}
    return found | {"g": results["g"], "tau": results["tau"]}


def _slipped(text: str, chance: random.Random) -> str:
    """One sign turned, or a factor put before it."""
    places = [i for i in range(len(text) - 2) if text[i : i + 3] == " + "]
    if not places:
        return f"2*({text})"
    place = chance.choice(places)
    return f"{text[:place]} - {text[place + 3 :]}"


@lru_cache(maxsize=1000)
def latex_of(text: str) -> str:
    text = to_latex(read(text).tree, PLAIN)
    dotted = r"([A-Za-z]|\\[a-z]+)_\{(\w+),\\mathrm\{(d+)ot\}\}"
    return re.sub(dotted, lambda m: rf"\{m[3]}ot{{{m[1]}}}_{{{m[2]}}}", text)


def _shuffled(node: Node, chance: random.Random) -> Node:
    """The same value with its terms and factors in another order."""
    match node:
        case Sum(parts) | Product(parts):
            return type(node)(tuple(_shuffled(part, chance) for part in chance.sample(parts, len(parts))))
        case Quotient(above, below):
            return Quotient(_shuffled(above, chance), below)
        case Negative(argument):
            return Negative(_shuffled(argument, chance))
        case Power(base, exponent):
            return Power(_shuffled(base, chance), exponent)
        case Parenthesized(argument):
            return Parenthesized(_shuffled(argument, chance))
    return node


def reordered(value: str | list, chance: random.Random) -> str | list:
    """An answer as somebody else would write it."""
    if isinstance(value, list):
        return [reordered(entry, chance) for entry in value]
    return to_python(_shuffled(read(value).tree, chance))


def hand_in(problem: str, student: str, chance: random.Random, own_order: bool = False) -> tuple[str, str]:
    """The name and the text of a hand-in; in an order of its own, or as the key is printed."""
    answers = dict(key(problem))
    if own_order:
        answers = {name: reordered(value, chance) for name, value in answers.items()}
    if chance.random() < SLIPS:
        name = chance.choice(sorted(answers))
        value = answers[name]
        if isinstance(value, list):
            rows = [list(row) if isinstance(row, list) else [row] for row in value]
            i = chance.randrange(len(rows))
            rows[i][0] = _slipped(rows[i][0], chance) if rows[i][0] != "0" else "m1"
            answers[name] = rows
        else:
            answers[name] = _slipped(value, chance)
    if chance.random() < 0.5:
        return f"{student}_{problem}.md", _report(problem, answers)
    lines = [f"problem: {problem}", f"student: {student}", "answers:"]
    lines += [f"  {name}: {_plain(value)}" for name, value in answers.items()]
    return f"{student}_{problem}.yaml", "\n".join(lines) + "\n"


def _rows(value: list) -> list[list[str]]:
    return [row if isinstance(row, list) else [row] for row in value]


def _plain(value: str | list) -> str:
    if isinstance(value, str):
        return value
    return "[" + ", ".join("[" + ", ".join(row) + "]" for row in _rows(value)) + "]"


def _report(problem: str, answers: dict) -> str:
    lines = ["---", f"problem: {problem}", "---", "# Hand-in", ""]
    for name, value in answers.items():
        head = name if len(name) == 1 or name == "tau" else f"{name[0]}_{name[1:]}"
        head = r"\tau" if head == "tau" else head
        if isinstance(value, str):
            body = latex_of(value)
        else:
            rows = r" \\ ".join(" & ".join(map(latex_of, row)) for row in _rows(value))
            body = rf"\begin{{bmatrix}} {rows} \end{{bmatrix}}"
        lines += ["$$", f"{head} = {body}", "$$", ""]
    return "\n".join(lines)


def course(folder: Path, count: int, seed: int = 1, own_order: bool = False) -> None:
    """A folder a student, a third of them each of the three problems."""
    chance = random.Random(seed)
    for i in range(count):
        student = f"s{i:05d}"
        name, text = hand_in(PROBLEMS[i % len(PROBLEMS)], student, chance, own_order)
        place = folder / student
        place.mkdir(parents=True)
        (place / name).write_text(text)


def problem_set(folder: Path) -> None:
    """The three problems as a set."""
    from dynsolve.problem.reader import find

    folder.mkdir(parents=True, exist_ok=True)
    for name in PROBLEMS:
        (folder / f"{name}.yaml").write_text(find(name).read_text())
    marks = "{P: 2, K: 4, D: 4, C: 3, g: 2, tau: 6}"
    lines = ["title: Three robots", f"problems: [{', '.join(f'{p}.yaml' for p in PROBLEMS)}]", "marks:"]
    lines += [f"  {name}: {marks}" for name in PROBLEMS]
    (folder / "set.yaml").write_text("\n".join([*lines, "policy: {follow: 1/2, hints: 2}"]) + "\n")
