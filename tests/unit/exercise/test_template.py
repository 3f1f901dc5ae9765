"""Templates: what is left empty is missing, and filled in with the key it is all correct."""

import json
import re
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any

import pytest

from dynsolve.answers.judge import Checker
from dynsolve.answers.reading.files import pandoc
from dynsolve.answers.verdict import Report, Verdict
from dynsolve.exercise.template import SUFFIXES, Template, TemplateFormat, template, template_of
from dynsolve.notation.markup import LatexPrinter
from dynsolve.notation.python import to_python
from dynsolve.notation.tree import Matrix, Node, Symbol
from dynsolve.problem.reader import bundled, load
from dynsolve.quantities.family import FORMED, Kind
from dynsolve.solution.solution import Solution
from tests.support import problem_file, solve_json, solved

FORMS = [form for form in SUFFIXES.values() if form is not TemplateFormat.DOCX]
TOO_LONG = {"puma560", "panda-7r"}
"""Robots with results that are longer than an answer may be."""

KINDS = [
    "planar-2r",  # matrices
    "planar-2r-friction",  # sgn
    "inf3480-rpr",  # a set, branches
    "inf3480-rprr-drawn",  # the table
    "inertia-candidates",  # verdicts
    "knife-edge",  # constraints
]
"""A problem for each kind of answer."""

CASES = [
    (name, form)
    for place, name in enumerate(sorted(bundled()))
    for form in (FORMS if name in KINDS else FORMS[place % len(FORMS) :][:1])
]
"""These in every form, and the others in one form each."""

SUFFIX = {form: suffix for suffix, form in SUFFIXES.items()}


@cache
def checker(problem: str) -> Checker:
    return Checker(load(problem_file(problem)))


def judged(problem: str, page: bytes | str, form: TemplateFormat) -> Report:
    """In this process, which derives the key of a problem once."""
    own = checker(problem)
    return own(own.reader(page, f"hand-in{SUFFIX[form]}"))


@pytest.mark.parametrize(("name", "form"), CASES)
def test_what_is_left_empty_is_missing(name: str, form: TemplateFormat) -> None:
    report = judged(name, template(checker(name).problem, form), form)
    assert {answer.verdict for answer in report.answers} == {Verdict.MISSING}
    assert not report.not_recognized


@pytest.mark.parametrize(("name", "form"), [case for case in CASES if case[0] not in TOO_LONG])
def test_filled_in_with_the_key_all_is_correct(name: str, form: TemplateFormat) -> None:
    report = judged(name, filled(name, form), form)
    assert {a.name: a.verdict for a in report.answers if a.verdict is not Verdict.CORRECT} == {}


@pytest.mark.parametrize("name", ["planar-2r", "crane", "spherical-rrp"])
@pytest.mark.parametrize("form", FORMS)
def test_one_slip_is_the_only_thing_that_is_wrong(name: str, form: TemplateFormat) -> None:
    report = judged(name, filled(name, form, wrong="g"), form)
    assert [a.name for a in report.answers if a.verdict is Verdict.WRONG] == ["g"]


@pytest.mark.parametrize("form", FORMS)
def test_what_an_answer_is_counted_by_is_told(form: TemplateFormat) -> None:
    page = template(checker("knife-edge").problem, form).decode()
    assert "Their sign is such that D q̈ + C q̇ + g equals τ + A_cᵀ λ." in page


@pytest.mark.skipif(pandoc() is None, reason="the extra `office` is not installed")
@pytest.mark.parametrize("name", KINDS)
def test_a_word_document_is_read_back(name: str) -> None:
    from dynsolve.exercise.sheet import to_docx

    empty = template(solved(name).problem, TemplateFormat.DOCX)
    report = judged(name, empty, TemplateFormat.DOCX)
    assert {answer.verdict for answer in report.answers} == {Verdict.MISSING}
    page = to_docx(filled(name, TemplateFormat.MARKDOWN))
    assert judged(name, page, TemplateFormat.DOCX).all_correct


# -- filled in with the key --------------------------------------------------------------------------


def filled(name: str, form: TemplateFormat, wrong: str = "") -> str:
    """The template with the key in its places; the answer `wrong` has the opposite sign."""
    solution = solved(name)
    made, page = template_of(solution.problem), template(solution.problem, form).decode()
    results = solve_json(next(path for stem, path in bundled().items() if stem == name))["results"]
    if form is TemplateFormat.NOTEBOOK:
        notebook = json.loads(page)
        for cell in notebook["cells"]:
            source = _reported("".join(cell["source"]), made, solution, results, wrong, latex=False)
            cell["source"] = source.splitlines(keepends=True)
        return json.dumps(notebook)
    if form is TemplateFormat.YAML:
        return _listed(page, made, solution, results, wrong)
    return _reported(page, made, solution, results, wrong, latex=form is TemplateFormat.LATEX)


def key_in(file: Path) -> str:
    """The key of a problem file as a hand-in."""
    solution = solved(file)
    made = template_of(solution.problem)
    page = template(solution.problem, TemplateFormat.YAML).decode()
    return _listed(page, made, solution, {}, "")


def _form(solution: Solution, name: str, write: Callable[[Any], str]) -> Any:
    node = solution.forms(name)
    return [[write(e) for e in row] for row in node.rows] if isinstance(node, Matrix) else write(node)


def _listed(page: str, made: Template, solution: Solution, results: Any, wrong: str) -> str:
    for blank in made.blanks:
        value = results.get(blank.name)
        if blank.kind in FORMED and blank.name != "DH":
            value = _form(solution, blank.name, _negated if blank.name == wrong else to_python)
        elif blank.kind is Kind.EQUATIONS:
            value = [f'"{" and ".join(alternative)}"' for alternative in value]
        elif blank.kind is Kind.VERDICTS:
            value = _verdicts(value)
        elif blank.kind is Kind.BRANCHES:
            value = [{q: v for q, v in branch.items() if q != "when"} for branch in value]
        written = _typed(value)
        page = re.sub(rf"(?m)^  {blank.name}:$", lambda _, w=written, b=blank: f"  {b.name}: {w}", page)
    return page


def _negated(node: Node) -> str:
    return f"-({to_python(node)})"


def _verdicts(value: Any) -> Any:
    if "verdict" in value:
        return f'"{value["verdict"]}"'
    return {name: f'"{said["verdict"]}"' for name, said in value.items()}


def _typed(value: Any) -> str:
    if isinstance(value, list):
        return f"[{', '.join(map(_typed, value))}]"
    if isinstance(value, dict):
        return "{" + ", ".join(f"{key}: {_typed(each)}" for key, each in value.items()) + "}"
    return str(value)


def _reported(page: str, made: Template, solution: Solution, results: Any, wrong: str, latex: bool) -> str:
    write = LatexPrinter().text
    for blank in made.blanks:
        value = results.get(blank.name)
        if blank.name == "DH":
            bar = "&" if latex else "|"
            for i, row in enumerate(value, 1):
                cells = f" {bar} ".join(f"${cell}$" if latex else cell for cell in row)
                page = re.sub(rf"(?m)^(\|?) {i} (?:[&|]  ){{4}}", rf"\1 {i} {bar} {cells} ", page)
        elif blank.kind in FORMED:
            shown = write(solution.forms(blank.name))
            sign = "-" if blank.name == wrong else ""
            page = page.replace(f"\n{blank.letter} =\n", f"\n{blank.letter} = {sign}{shown}\n", 1)
        elif blank.kind in (Kind.EQUATIONS, Kind.CONDITIONS):
            told = [" and ".join(each) if isinstance(each, list) else each for each in value]
            items = "".join(f"- {each}\n" for each in told)
            page = page.replace(f"{blank.name}:\n", f"{blank.name}:\n\n{items}", 1)
        elif blank.kind is Kind.VERDICTS:
            own = [one.name for one in solution.robot.questions.candidates]
            said = dict.fromkeys(own, value) if "verdict" in value else value
            for name, one in said.items():
                page = page.replace(f"{name}:\n", f"{name}: {one['verdict']}\n", 1)
        else:
            page = _branches(page, value, solution)
    return page


def _branches(page: str, value: Any, solution: Solution) -> str:
    """Each branch by a display a coordinate, in the places of the template and behind them."""
    write = LatexPrinter().text
    opens, closes = ("$$", "$$") if "$$\n" in page else ("\\[", "\\]")
    empty = [f"{opens}\n{write(Symbol(q.name))} =\n{closes}" for q in solution.robot.coordinates]
    shown = "\n\n".join(
        display.replace(" =\n", f" = {branch[q.name]}\n")
        for branch in value
        for display, q in zip(empty, solution.robot.coordinates, strict=True)
        if q.name in branch
    )
    page = page.replace(empty[0], shown, 1)
    for display in empty[1:]:
        page = page.replace(display, "", 1)
    return page
