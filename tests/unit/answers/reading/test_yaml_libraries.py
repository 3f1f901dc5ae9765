"""The same answers through every style of PyYAML and JSON, and by hand: what is read is the same."""

from __future__ import annotations

import json
from collections.abc import Iterator
from functools import cache
from itertools import cycle, product
from typing import Any

import pytest
import yaml

from dynsolve.answers.judging.answer_ring import AnswerRing
from dynsolve.answers.judging.graph import AnswerGraph
from dynsolve.answers.reading.files import FileReader
from dynsolve.answers.verdict import Submission
from dynsolve.explain.context import style_of
from dynsolve.explain.forms import Forms
from dynsolve.notation.markup import to_latex
from dynsolve.notation.python import to_python
from dynsolve.notation.tree import Matrix
from dynsolve.notation.unicode import to_unicode
from tests.unit.answers.hands import checker, key, problem

STEMS = ["in3140-rp", "planar-2r", "numeric-2r", "spherical-rrp", "elbow-3r"]
QUANTITIES = ("K", "P", "tau", "D", "C", "g", "Jv", "A1", "H1", "v1")
NOTATIONS = ("plain", "entries in latex", "latex", "lines", "unicode")
FURTHER = [(True, 2, False), (False, 4, False), (True, None, True), (False, None, False)]
"""allow_unicode, indent, sort_keys"""


@cache
def trees(stem: str) -> dict[str, Any]:
    robot = problem(stem).robot
    graph = AnswerGraph(AnswerRing(robot, key(stem)))
    forms = Forms(robot, key(stem))
    return {name: forms.of(graph.key(graph.node(name))) for name in QUANTITIES}


@cache
def answers(stem: str, notation: str) -> dict[str, Any]:
    """The right answers as values of a dictionary."""
    style = style_of(problem(stem).robot)
    found: dict[str, Any] = {}
    for name, tree in trees(stem).items():
        rows = tree.rows if isinstance(tree, Matrix) else ()
        column = bool(rows) and all(len(row) == 1 for row in rows)
        if notation == "latex" or (notation == "lines" and not rows):
            found[name] = to_latex(tree, style)
        elif notation == "lines":
            body = " \\\\\n".join(" & ".join(to_latex(entry, style) for entry in row) for row in rows)
            found[name] = f"\\begin{{bmatrix}}\n{body}\n\\end{{bmatrix}}"
        else:
            write = {"plain": to_python, "unicode": to_unicode}.get(notation) or (
                lambda node: to_latex(node, style)
            )
            table = [[write(entry) for entry in row] for row in rows]
            found[name] = [row[0] for row in table] if column else table if rows else write(tree)
    return found


@cache
def reader(stem: str) -> FileReader:
    return checker(stem).reader


def read(stem: str, text: str, file: str = "answers.yaml") -> Submission:
    return reader(stem)(text, file)


def meant(found: Submission) -> dict[str, Any]:
    assert not found.not_recognized
    assert not found.faults
    return {answer.name: (answer.node, answer.fault) for answer in found.answers}


def by_hand(given: dict[str, Any]) -> str:
    """As a student would write it: every scalar a literal block or a plain one, lists in flow style."""

    def value(item: Any) -> str:
        if isinstance(item, list):
            return "[" + ", ".join(value(inside) for inside in item) + "]"
        return "'" + str(item).replace("'", "''") + "'"

    lines = ["answers:"]
    for name, item in given.items():
        if isinstance(item, str):
            lines += [f"  {name}: |", *(f"    {line}" for line in item.split("\n"))]
        else:
            lines.append(f"  {name}: {value(item)}")
    return "\n".join(lines) + "\n"


def dumps(given: dict[str, Any]) -> Iterator[str]:
    """The file as libraries write it."""
    whole = {"problem": "x", "student": "s1", "answers": given}
    styles = product((None, "'", '"', "|", ">"), (True, False, None), (20, 80, 1000))
    for (style, flow, width), further in zip(styles, cycle(FURTHER), strict=False):
        unicode, indent, order = further
        yield yaml.safe_dump(
            whole,
            default_style=style,
            default_flow_style=flow,
            width=width,
            allow_unicode=unicode,
            indent=indent,
            sort_keys=order,
        )
    for indent, ascii in product((None, 1, 2, 4), (True, False)):
        yield json.dumps(whole, indent=indent, ensure_ascii=ascii)
        yield json.dumps(given, indent=indent, ensure_ascii=ascii).replace("/", "\\/")


@pytest.mark.parametrize("notation", NOTATIONS)
@pytest.mark.parametrize("stem", STEMS)
def test_right_answers_are_right_by_hand(stem: str, notation: str) -> None:
    found = checker(stem)(read(stem, by_hand(answers(stem, notation))))
    assert {a.name: str(a.verdict) for a in found.answers if a.given and a.verdict != "correct"} == {}
    assert sum(a.given for a in found.answers) >= len(QUANTITIES)


@pytest.mark.parametrize(
    ("stem", "notation"), [*product(["planar-2r"], NOTATIONS), ("numeric-2r", "plain")]
)  # where there are numbers, YAML has some of its own
def test_a_library_writes_the_same(stem: str, notation: str) -> None:
    given = answers(stem, notation)
    wanted = meant(read(stem, by_hand(given)))
    for number, text in enumerate(dumps(given)):
        assert meant(read(stem, text)) == wanted, (number, text)


@pytest.mark.parametrize(("stem", "notation"), [("planar-2r", "latex"), ("numeric-2r", "plain")])
def test_what_is_wrong_stays_wrong(stem: str, notation: str) -> None:
    given = {name: slipped(value) for name, value in answers(stem, notation).items() if name != "P"}
    wanted = meant(read(stem, by_hand(given)))
    for text in dumps(given):
        assert meant(read(stem, text)) == wanted
    found = checker(stem)(read(stem, by_hand(given)))
    assert [a.name for a in found.answers if a.given and a.verdict == "correct"] == []


def slipped(value: Any) -> Any:
    if isinstance(value, list):
        return [slipped(value[0]), *value[1:]]
    return f"{value} + 7"


BROKEN = [r"[[\frac{a}{b}, 0], [0, 0]]", "[", "{", "'", "@", "%", "`", "a: b", "- m1 +", r'"\frac{1}{2}']


@pytest.mark.parametrize("notation", NOTATIONS)
@pytest.mark.parametrize("style", [None, "'", '"', "|", ">"])
def test_a_line_that_yaml_refuses_spoils_itself_alone(style: str, notation: str) -> None:
    given = answers("planar-2r", notation)
    wanted = meant(read("planar-2r", by_hand(given)))
    text = yaml.safe_dump({"answers": given}, default_style=style, default_flow_style=False, sort_keys=False)
    for bad in BROKEN:
        found = read("planar-2r", f"{text}  L: {bad}\n")
        values = {answer.name: (answer.node, answer.fault) for answer in found.answers}
        assert values.pop("L", (None, ""))[0] is None, bad
        assert values == wanted, bad


@pytest.mark.parametrize("notation", NOTATIONS)
def test_json_with_a_fault_loses_one_answer(notation: str) -> None:
    given = answers("planar-2r", notation)
    wanted = meant(read("planar-2r", by_hand(given)))
    for bad in ('"L": [1, }', '"L": m1 "x"', '"L": "m1'):
        text = json.dumps({"answers": {**given, "L": "gone"}}, indent=2).replace('"L": "gone"', bad)
        found = read("planar-2r", text, "answers.json")
        values = {answer.name: (answer.node, answer.fault) for answer in found.answers}
        assert values.pop("L", (None, ""))[0] is None
        assert values == wanted
