"""An explanation never takes a result away: what fails in it is left out, and a warning says so."""

from __future__ import annotations

from collections.abc import Callable, Iterator

import pytest

import dynsolve
from dynsolve.algebra.compact.compactor import Compactor
from dynsolve.errors import ExplanationWarning
from dynsolve.explain import energy, vectorized
from dynsolve.explain.abbreviations import Abbreviate
from dynsolve.explain.step import Detail, Step
from dynsolve.notation.build import times
from dynsolve.notation.tree import Node
from dynsolve.render.files import Format
from dynsolve.solution import documents
from dynsolve.solution.reports import report
from tests.support import solved

Fails = Callable[..., object]

PENDULUM = """
gravity: [0, -g, 0]
dh: [{theta: q1*, a: l}, {theta: q2*, a: l}]
masses: [{mass: m, link: 1}, {mass: m, link: 2}]
"""


def fails(*_: object, **__: object) -> Iterator[Step]:
    raise LookupError("planted")


def page(abbreviate: str = "auto", detail: Detail = Detail.NORMAL) -> str:
    return report(dynsolve.solve(PENDULUM), Format.TEXT, detail=detail, abbreviate=abbreviate).decode()


def test_a_form_that_is_another_function_gives_way_to_the_plain_polynomial(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    collected = Compactor._collected

    def wrong(self: Compactor, expr: object) -> Node:
        return times(2, [(collected(self, expr), 1)])  # type: ignore[arg-type]

    monkeypatch.setattr(Compactor, "_collected", wrong)
    with pytest.warns(ExplanationWarning, match="compact form is left out: it is not equal"):
        found = dynsolve.solve(PENDULUM)
    monkeypatch.undo()
    state, numbers = [0.3, 2.0], {"m": 2, "l": 0.7}
    assert len(str(found.D)) > len(str(solved(PENDULUM).D))
    assert found.numeric("D")(state, **numbers) == pytest.approx(
        solved(PENDULUM).numeric("D")(state, **numbers)
    )


@pytest.mark.parametrize("stage", [energy, vectorized])
def test_a_stage_that_fails_shows_its_bare_results(stage: object, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(stage, "steps", fails)
    with pytest.warns(ExplanationWarning, match="LookupError at .*test_left_out"):
        text = page()
    assert "K₁" in text or "𝐃" in text
    assert "m l² θ̈" in text or "q̈₁" in text


def test_a_stage_that_fails_half_way_keeps_what_was_shown(monkeypatch: pytest.MonkeyPatch) -> None:
    steps = vectorized.steps

    def half(context: object) -> Iterator[Step]:
        yield next(steps(context))  # type: ignore[arg-type]
        raise LookupError("planted")

    monkeypatch.setattr(vectorized, "steps", half)
    with pytest.warns(ExplanationWarning, match="stage vectorized"):
        shown = list(dynsolve.solve(PENDULUM).explain(["vectorized"]))
    first = next(steps(dynsolve.solve(PENDULUM)._context))
    assert shown[0].id == first.id and shown[0].result == first.result
    assert {"C", "g"} <= {step.id for step in shown}


@pytest.mark.parametrize("part", ["summary_blocks", "notation", "statement"])
def test_a_part_of_the_document_that_fails_is_left_out(part: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(documents, part, fails)
    with pytest.warns(ExplanationWarning):
        assert "Verified" in page(detail=Detail.FULL)


def test_names_that_fail_leave_the_results_in_full(monkeypatch: pytest.MonkeyPatch) -> None:
    in_full = page("never")
    monkeypatch.setattr("dynsolve.explain.named_steps.in_names", fails)
    with pytest.warns(ExplanationWarning, match="names"):
        assert page(Abbreviate.ALWAYS) == in_full


CART = "gravity: none\nmodel: {coordinates: {x: prismatic}, bodies: [{mass: m, at: [x, 0, 0]}]}"


@pytest.mark.parametrize(("text", "maker"), [(PENDULUM, "scene.scene"), (CART, "placed_bodies.placed_scene")])
def test_a_picture_that_fails_is_left_out(monkeypatch: pytest.MonkeyPatch, text: str, maker: str) -> None:
    monkeypatch.setattr(f"dynsolve.draw.{maker}", fails)
    with pytest.warns(ExplanationWarning, match="the picture is left out: LookupError"):
        shown = report(dynsolve.solve(text), Format.LATEX).decode()
    assert r"\section" in shown and r"\begin{picture}" not in shown
