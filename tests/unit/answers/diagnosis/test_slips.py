"""Every slip of the table is recognized: in its example, and wherever its step is taken."""

from __future__ import annotations

from itertools import product

import pytest

from dynsolve.algebra.matrix import Matrix
from dynsolve.algebra.ring import Expr
from dynsolve.answers.diagnosis.slips import SLIPS
from dynsolve.answers.diagnosis.steps import variants
from dynsolve.answers.judging.graph import AnswerGraph
from dynsolve.answers.verdict import Answer, Place, Submission
from dynsolve.explain.forms import Forms
from tests.unit.answers.diagnosis.slip_examples import EXAMPLES
from tests.unit.answers.hands import checker, codes, judged, key, problem

STEMS = ["in3140-rp", "planar-2r", "elbow-3r", "scara-rrpr", "rp-vertical"]


@pytest.mark.parametrize("code", EXAMPLES)
def test_the_example_of_a_slip_shows_it(code: str) -> None:
    example = EXAMPLES[code]
    answer = judged(example.problem, example.name, example.value, **example.beside)
    assert answer.verdict == "wrong"
    assert code in codes(answer)


def graph(stem: str) -> AnswerGraph:
    return checker(stem).graph


def _equal(a: Expr | Matrix, b: Expr | Matrix) -> bool:
    if isinstance(a, Matrix) and isinstance(b, Matrix):
        return a.shape == b.shape and a.entries == b.entries
    return bool(a == b)


def _is_zero(value: Expr | Matrix) -> bool:
    return all(e.is_zero for e in (value.entries if isinstance(value, Matrix) else (value,)))


@pytest.mark.slow
@pytest.mark.parametrize("stem", STEMS)
def test_a_step_that_went_wrong_is_named(stem: str) -> None:
    """Of two slips with the same outcome either may be named; an answer 0 shows none."""
    g, forms = graph(stem), Forms(problem(stem).robot, key(stem))
    seen: set[str] = set()
    for node in g.answer_ring.rules:
        wrong = [(v, t) for v, t in variants(g.robot, node, g.key) if not _equal(v, g.key(node))]
        for value, told in wrong:
            answer = Answer(g.answer(node), "", forms.of(value), Place(1, 1), "")
            report = checker(stem)(Submission("", "", "", (answer,)))
            found = next(a for a in report.answers if a.given)
            alike = {t.code for v, t in wrong if _equal(v, value)}
            if found.verdict == "wrong" and not _is_zero(value):
                assert alike & set(codes(found)), (node, told.message, codes(found))
                seen.add(told.code)
    assert seen


def test_every_slip_has_an_example_or_a_step() -> None:
    steps = {told.code for stem in STEMS for node in graph(stem).answer_ring.rules
             for _, told in variants(graph(stem).robot, node, graph(stem).key)}  # fmt: skip
    told_elsewhere = {"trig_part", "terms_differ"}
    assert set(SLIPS) - EXAMPLES.keys() - steps == told_elsewhere


@pytest.mark.parametrize(
    ("answer", "told"),
    [
        ("D: [[I1zz + m2*L2^2, m2], [m2, m2]]", ["dimensions", "extra_term"]),  # no rows are exchanged
        ("C: [[0, 0], [0, 0]]", ["zero"]),  # and no step can be seen
        ("D: [[m2*L2^2, 0], [0, m2]]", ["rotation_missing"]),  # and no tensor was turned wrongly
    ],
)
def test_a_slip_is_not_read_into_what_has_none(answer: str, told: list[str]) -> None:
    import dynsolve

    report = dynsolve.check("in3140-rp", f"answers:\n  {answer}\n")
    assert sorted(codes(next(a for a in report.answers if a.given))) == told


@pytest.mark.parametrize(
    ("dLdqd2", "told"),
    [
        ("m2*l1*lc2*sin(q2)*q1_dot", "stands s₂ where c₂ belongs"),
        ("-m2*l1*lc2*sin(q2)*q1_dot", "stands s₂ where -c₂ belongs"),
        ("m2*l1*lc2*cos(q1)*q1_dot", "stands c₁ where c₂ belongs"),
    ],
)
def test_what_is_said_to_stand_in_an_answer_stands_there(dLdqd2: str, told: str) -> None:
    """The ring has θ₁ and θ₁ + θ₂: there c₂ and s₂ are the functions of a difference."""
    rest = "(m2*lc2^2 + I2)*(q1_dot + q2_dot)"
    found = judged("planar-2r", "dLdqd2", f"{dLdqd2} + {rest}")
    assert [told in d.message for d in found.diagnosis] == [True]
    square = "l1^2*q1_dot^2 + lc2^2*(q1_dot + q2_dot)^2 + 2*l1*lc2*cos(q1)*q1_dot*(q1_dot + q2_dot)"
    for said in judged("planar-2r", "Kv2", f"m2*({square})/2").diagnosis:
        assert "stands c₁ where c₂ belongs" in said.message


def test_a_body_left_out_of_one_energy_is_not_left_out_of_the_other() -> None:
    gravity = {"1": "m1*g*lc1*cos(q1)", "2": "m2*g*(l1*cos(q1) + lc2*cos(q1 + q2))"}
    turning = {"1": "(m1*lc1^2 + I1)*q1_ddot",
               "2": "(m2*(l1^2 + lc2^2 + 2*l1*lc2*cos(q2)) + I2)*q1_ddot"
                    " + (m2*(lc2^2 + l1*lc2*cos(q2)) + I2)*q2_ddot"
                    " - m2*l1*lc2*sin(q2)*(2*q1_dot*q2_dot + q2_dot^2)"}  # fmt: skip
    for energy, kept in (("P", (*turning.values(), gravity["1"])), ("K", (turning["1"], *gravity.values()))):
        (found,) = judged("planar-2r", "tau1", " + ".join(kept)).diagnosis
        assert found.message == f"The contribution of body 2 to {energy} is left out."


def test_an_entry_of_an_inertia_matrix_is_no_transposed_matrix() -> None:
    """A transposed A_1 would lead to it, but the message would speak of the student's D."""
    import dynsolve

    for answer in ("D: [[I1zz, 0], [0, m2]]", "d11: I1zz"):
        report = dynsolve.check("in3140-rp", f"answers:\n  {answer}\n")
        found = next(a for a in report.answers if a.given)
        assert codes(found) and "transposed" not in codes(found)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("stem", "node"), [*product(["in3140-rp", "planar-2r"], ["K", "tau", "D", "g"]), ("elbow-3r", "K")]
)
def test_a_slip_long_before_is_named(stem: str, node: str) -> None:
    """Only what comes out at the end is handed in; slips with the same outcome are one to us."""
    g, forms = graph(stem), Forms(problem(stem).robot, key(stem))
    slips = checker(stem).derivation_slips
    outcomes = [(v, t) for v, t, _ in slips.values(node) if not _equal(v, g.key(node))]
    for value, told in outcomes:
        answer = Answer(node, "", forms.of(value), Place(1, 1), "")
        report = checker(stem)(Submission("", "", "", (answer,)))
        found = next(a for a in report.answers if a.given)
        alike = {t.code for v, t in outcomes if _equal(v, value)}
        if found.verdict == "wrong":
            assert alike & set(codes(found)) or set(codes(found)) <= SIMPLER, (told.message, codes(found))


SIMPLER = {
    "sign", "sign_all", "factor", "factor_all", "symbol", "gravity_sign", "gravity_missing", "dropped_factor",
    "missing_term", "constant_term", "dropped_velocity", "dimensions", "slope_missing", "slope_sign",
    "rotation_missing", "body_missing", "extra_term", "angle",
}  # fmt: skip
"""What explains an answer in one place, where it explains it."""
