"""Whether a matrix can be an inertia matrix, and what of its parameters that needs."""

from __future__ import annotations

import pytest
from msgspec.structs import replace

import dynsolve
from dynsolve.algebra.inequality import Bound
from dynsolve.derivation.rules import derive
from dynsolve.errors import VerificationError
from dynsolve.problem import read_problem
from dynsolve.questions.definite.check import verify_definite
from dynsolve.questions.definite.derive import Answer, Definiteness, Refusal
from dynsolve.render.files import Format
from dynsolve.solution.reports import report
from tests.support import ROOT, solve_json

EXAM = ROOT / "problems" / "inertia-candidates.yaml"


def file(matrix: str, assume: str = "[]", more: str = "") -> str:
    types = "{q1: revolute, q2: revolute, d: prismatic}"
    return f"candidates: {{M: {matrix}}}\ncoordinates: {types}\nassume: {assume}\n{more}\n"


def found(text: str) -> Definiteness:
    (one,) = derive(read_problem(text).robot)["definite"]
    assert isinstance(one, Definiteness)
    return one


def of_three(first: str, off: str = "0", assume: str = "[]") -> str:
    return file(f"[[{first}, {off}, 0], [{off}, 1, 0], [0, 0, 1]]", assume)


def of_two(assume: str) -> str:
    """a + c + 2 b c₂ is seen to be positive by what is assumed of c and the determinant alone."""
    coupled = "[[a + c + 2*b*cos(q2), c + b*cos(q2)], [c + b*cos(q2), c]]"
    return f"candidates: {{M: {coupled}}}\ncoordinates: {{q1: revolute, q2: revolute}}\nassume: {assume}\n"


def test_the_exam_s_verdicts_come_out() -> None:
    """Sapienza Robotics 2, midterm 29 April 2019, exercise 1."""
    verdicts = solve_json(EXAM)["results"]["definite"]
    assert {name: one["verdict"] for name, one in verdicts.items()} == {
        "Ma": "no", "Mb": "yes", "Mc": "no", "Md": "yes",
    }  # fmt: skip


CONDITIONS = {
    "a constant": (of_three("a"), ["a > 0"]),
    "a cosine": (of_three("a + b*cos(q2)"), ["a + b > 0", "a - b > 0"]),
    "its square": (of_three("a + b*cos(q2)^2"), ["a > 0", "a + b > 0"]),
    "cosine and sine": (of_three("a + b*cos(q2) + c*sin(q2)"), ["a > 0", "a**2 - b**2 - c**2 > 0"]),
    "twice the angle": (of_three("a + b*sin(q2)*cos(q2)"), ["2*a + b > 0", "2*a - b > 0"]),
    "two angles": (
        of_three("a + b*cos(q1) + c*sin(q2)"),
        ["a + b + c > 0", "a + b - c > 0", "a - b + c > 0", "a - b - c > 0"],
    ),
    "a length": (of_three("a + b*d^2"), ["a > 0", "b >= 0"]),
    "a length from elsewhere": (of_three("a + b*d + c*d^2"), ["c > 0", "4*a*c - b**2 > 0"]),
    "a length that must not occur": (of_three("a + b*d"), ["b = 0", "a > 0"]),
    "a length twice on the diagonal": (
        file("[[a + b*d^2, 0, 0], [0, c + b*d^2, 0], [0, 0, b]]"),
        ["a > 0", "c > 0", "b > 0"],
    ),
    "off the diagonal": (of_three("a", "b*cos(q2)"), ["a - b**2 > 0"]),
    "a third power of what is assumed": (
        file("[[a + b*d + b*d^2, 0, 0], [0, b, 0], [0, 0, 1]]", "[b > 0]"),
        ["4*a - b > 0"],
    ),
    "a square": (of_three("m*a^2", "0", "[m > 0]"), ["a != 0"]),
    "a square beside a letter": (of_three("m*a^2", "m*a*cos(q2)*b"), ["m > 0", "a != 0", "1 - b**2*m > 0"]),
    "a square of a difference": (of_three("a^2 - 2*a*b + b^2"), ["a - b != 0"]),
    "a parabola in a square": (
        of_three("a - b*cos(q2)^2 + cos(q2)^4", "0", "[a > 0, b > 0]"),
        ["1 + a - b > 0", "4*a - b**2 > 0 or b - 2 >= 0"],
    ),
    "a square of a length off the diagonal": (
        file("[[a + c*d^2, b*d^2, 0], [b*d^2, 1, 0], [0, 0, 1]]"),
        ["a > 0", "b = 0", "c >= 0"],
    ),
    "a parabola in the square of a length": (
        file("[[1 + d^2, e*d, 0], [e*d, 1 + d^2, 0], [0, 0, 1]]", "[e^2 > 2]"),
        ["4 - e**2 > 0"],
    ),
    "a parabola in the square of a length that may grow everywhere": (
        file("[[1 + d^2, e*d, 0], [e*d, 1 + d^2, 0], [0, 0, 1]]"),
        ["4 - e**2 > 0"],
    ),
    "a vertex that may lie outside": (
        of_three("a + b*cos(q2) + c*cos(q2)^2", "0", "[b > 0, c > 0]"),
        ["a - b + c > 0", "4*a*c - b**2 > 0 or b - 2*c >= 0"],
    ),
    "a vertex on either side": (
        of_three("a + b*cos(q2) + c*cos(q2)^2"),
        ["a - b + c > 0", "a + b + c > 0", "4*a*c - b**2 > 0 or b - 2*c >= 0 or -b - 2*c >= 0"],
    ),
    "a vertex whose value decides outside, too": (
        file("[[a + b*cos(q2), b*sin(q2), 0], [b*sin(q2), a, 0], [0, 0, 1]]"),
        ["a + b > 0", "3*a**2 - 4*b**2 > 0"],
    ),
    "a vertex of a determinant": (
        of_three("a + 2*b*cos(q2) + c*cos(q2)^2", "b*cos(q2)", "[b > 0, c > 0]"),
        ["a - 2*b + c - b**2 > 0", "a*c - b**2*(1 + a) > 0 or b**2 + b - c >= 0"],
    ),
    "a product on the diagonal": (
        file("[[a, b*sin(q1), 0], [b*sin(q1), c, 0], [0, 0, 1]]"),
        ["a > 0", "a*c - b**2 > 0"],
    ),
}


@pytest.mark.parametrize("name", CONDITIONS)
def test_conditions(name: str) -> None:
    text, conditions = CONDITIONS[name]
    result = solve_json(text)["results"]["definite"]["M"]
    assert result["verdict"] == "if"
    assert {_sorted(one) for one in result["conditions"]} == {_sorted(one) for one in conditions}


def _sorted(inequality: str) -> str:
    import sympy

    parts = (one.rsplit(" ", 2) for one in inequality.split(" or "))
    return " or ".join(sorted(f"{sympy.expand(sympy.sympify(left))} {sign}" for left, sign, _ in parts))


YES = {
    "a square in what is assumed": of_three("a + b", "b*sin(q2)", "[a > 0, b > 0, b < 1]"),
    "a chain of inequalities": of_three("a + b*cos(q2)", "0", "[a > b > 0]"),
    "a bound from below": of_three("a + b*cos(q1)*cos(q2)", "0", "[a + b > 0, a - b > 0]"),
    "lowest between the ends": of_three("2 + cos(q2)", "sin(q2)"),
    "the minors from another entry on": of_two("[a > 0, a*c > b^2]"),
}


@pytest.mark.parametrize("name", YES)
def test_what_is_assumed_is_enough(name: str) -> None:
    assert found(YES[name]).answer is Answer.YES


def test_the_minors_are_those_that_decide() -> None:
    """c and a c - b² c₂², not a + c + 2 b c₂ first."""
    one, ring = found(YES["the minors from another entry on"]), read_problem(of_two("[]")).robot.ring
    assert one.order == (1, 0)
    assert str(one.minors[0]) == str(ring.symbol("c"))
    text = report(dynsolve.solve(read_problem(of_two("[]"))), Format.TEXT).decode()
    assert "in the order 2, 1; any order will do" in text
    assert "exactly if c > 0 and a c - b² > 0" in " ".join(text.split())


def test_no_if_is_said_where_nothing_is_seen_to_fail() -> None:
    """a³ > b³ is a > b, which no product of what is assumed shows."""
    result = solve_json(of_three("a - b", "0", "[a^3 > b^3]"))["results"]["definite"]["M"]
    assert result == {
        "skipped": "whether M is positive definite for all the parameters that are assumed is not found"
    }


def test_what_stands_beside_a_matrix_does_not_matter() -> None:
    """cos 2q is a polynomial in cos q where both stand in one ring, of a degree that is too high."""
    twice, once = (f"[[a, b*cos({k}*q2), 0], [b*cos({k}*q2), c, 0], [0, 0, 1]]" for k in (2, 1))
    beside = file(f"{twice}, N: {once}")
    alone, results = solve_json(file(twice))["results"]["definite"], solve_json(beside)["results"]["definite"]
    assert results["M"] == alone["M"]
    assert results["N"]["verdict"] == "if"
    model = (
        f"model:\n  coordinates: {{q1: revolute, q2: revolute, q3: revolute}}\n  D: {twice}\n  P: e*cos(q2)\n"
    )
    assert solve_json(f"{model}find: [definite, g]\n")["results"]["definite"] == alone["M"]


REFUSED = {
    "not symmetric": (file("[[1, 0, 0], [a, 1, 0], [0, 0, 1]]"), Refusal.ASYMMETRIC),
    "an angle in a power": (of_three("1 + q2^2"), Refusal.NOT_PERIODIC),
    "a length in a sine": (of_three("2 + sin(d)"), Refusal.LENGTH_IN_SINE),
    "a length to the fourth": (of_three("1 + d^4"), Refusal.DEGREE),
    "the coordinate of the base": (
        file("[[2 + cos(q1), 0, 0], [0, 1, 0], [0, 0, 1]]", more="chain: relative"), Refusal.BASE,
    ),
    "a negative determinant": (of_three("1", "2"), Refusal.INDEFINITE),
    "never positive": (of_three("-a", "0", "[a > 0]"), Refusal.INDEFINITE),
    "a length that grows": (of_three("1 + d"), Refusal.INDEFINITE),
    "a sine alone": (of_three("a*sin(q2)"), Refusal.INDEFINITE),
    "a factor that a length grows by": (of_three("m", "m*d"), Refusal.INDEFINITE),
    "below 0 between the ends": (of_three("1/8 + cos(q2) + 2*cos(q2)^2"), Refusal.INDEFINITE),
    "one of two minors": (file("[[a + b*d^2, 0, 0], [0, -1, 0], [0, 0, 1]]"), Refusal.INDEFINITE),
}  # fmt: skip


@pytest.mark.parametrize("name", REFUSED)
def test_a_refusal_has_its_reason(name: str) -> None:
    text, refusal = REFUSED[name]
    one = found(text)
    assert (one.answer, one.refusal) == (Answer.NO, refusal)
    assert solve_json(text)["results"]["definite"]["M"]["why"]


def test_conditions_that_exclude_each_other_are_told() -> None:
    why = solve_json(REFUSED["a factor that a length grows by"][0])["results"]["definite"]["M"]["why"]
    assert why.endswith("positive in every configuration only if m > 0 and -m ≥ 0, which exclude each other.")


def test_of_minors_that_share_a_factor_no_value_is_told() -> None:
    result = solve_json(REFUSED["one of two minors"][0])["results"]["definite"]["M"]
    assert result["why"] == "Δ₁ and Δ₂ are not both positive in every configuration."


@pytest.mark.parametrize(
    ("entry", "assume", "why"),
    [
        (
            "a + c*d*cos(q1)",
            "[a > 0, c > 0]",
            "Where c₁ = 1, Δ₁ = a + c d, which is not positive for some d.",
        ),
        (
            "a + c*d^2*cos(q1)",
            "[a > 0, c > 0]",
            "Where c₁ = -1, Δ₁ = a - c d², which is not positive for some d.",
        ),
        ("a + b*cos(q1)", "[b > a, a > 0]", "Where c₁ = -1, Δ₁ = a - b, which is not positive."),
        ("a + b*d*sin(q2)", "[b > 0]", "Where s₂ = 1, Δ₁ = a + b d, which is not positive for some d."),
        (
            "a + b*d*cos(q1) + c*d^2",
            "[c > 0, a > 0, b^2 > 4*a*c]",
            "Where c₁ = 1, Δ₁ = a + b d + c d², which is not positive for some d.",
        ),
    ],
)
def test_what_a_minor_is_at_the_place_is_told_with_what_is_left_open(
    entry: str, assume: str, why: str
) -> None:
    """It is 0 where c₁ = 1 and d = -a/c, say; where c₁ = 1 alone it is no more than a + c d."""
    result = solve_json(file(f"[[{entry}, 0, 0], [0, b, 0], [0, 0, 1]]", assume))["results"]["definite"]["M"]
    assert (result["verdict"], result["why"]) == ("no", why)


def test_a_model_s_matrix_is_judged_by_itself() -> None:
    text = (
        "model:\n  coordinates: {q: revolute}\n  D: [[a + b*cos(q)]]\nassume: [b > 0]\nfind: [definite, C]\n"
    )
    result = solve_json(text)["results"]["definite"]
    assert result["verdict"] == "if"
    assert result["conditions"] == ["a - b > 0"]


def test_a_wrong_verdict_is_found() -> None:
    robot = read_problem(of_three("a + b*cos(q2)", "0", "[a > b, b > 0]")).robot
    (candidate,) = robot.questions.candidates
    right = found(of_three("a + b*cos(q2)", "0", "[a > b, b > 0]"))
    verify_definite(robot, candidate, right, 5)
    wrong = replace(right, answer=Answer.NO, refusal=Refusal.INDEFINITE)
    with pytest.raises(VerificationError, match="comes out otherwise"):
        verify_definite(robot, candidate, wrong, 5)


def test_a_report_is_made_in_every_form() -> None:
    solution = dynsolve.solve(EXAM)
    for form in (Format.TEXT, Format.HTML, Format.LATEX, Format.MARKDOWN):
        assert b"positive definite" in report(solution, form)


@pytest.mark.parametrize(
    "matrix",
    [
        "[[2, cos(q2) + sin(q2), 0], [cos(q2) + sin(q2), 1, 0], [0, 0, 1]]",
        "[[1 + d^2, 1 + d, 0], [1 + d, 2, 0], [0, 0, 1]]",
    ],
)
def test_a_minor_that_touches_0_off_the_right_angles_is_not_positive(matrix: str) -> None:
    """1 - sin 2q2 and (d - 1)²"""
    result = solve_json(file(matrix))["results"]["definite"]["M"]
    assert (result["verdict"], result["why"]) == ("no", "Δ₂ is not positive in every configuration.")


@pytest.mark.parametrize(
    ("text", "word"),
    [
        # b = c = 0 will do as well
        (
            of_three("a + b*d + c*d^2"),
            "if c > 0 and 4a c - b² > 0; this is enough, but may be more than is needed",
        ),
        (of_three("2 + a*cos(q2) + cos(q2)^2", "0", "[a > 0]"), "exactly if 3 - a > 0"),
        (of_three("a + b*d + d^2"), "exactly if 4a - b² > 0"),
        (of_three("a", "b*cos(q2)"), "exactly if a - b² > 0"),
        (file("[[J + m*(d - h)^2, m*h, 0], [m*h, m, 0], [0, 0, 1]]"), "exactly if m > 0 and J - m h² > 0"),
    ],
)
def test_what_is_only_enough_is_not_said_to_be_needed(text: str, word: str) -> None:
    why = solve_json(text)["results"]["definite"]["M"]["why"]
    assert f"configuration {word}" in why


def test_conditions_that_are_not_needed_are_found() -> None:
    text = of_three("a + b*d + c*d^2")
    robot, right = read_problem(text).robot, found(text)
    (candidate,) = robot.questions.candidates
    verify_definite(robot, candidate, right, 5)
    more = replace(right, conditions=(*right.conditions, (Bound(robot.ring.symbol("b")),)), is_exact=True)
    with pytest.raises(VerificationError, match="comes out otherwise"):
        verify_definite(robot, candidate, more, 5)


def test_an_edge_at_which_it_is_definite_is_found() -> None:
    """b = c = 0: the conditions with c > 0 are enough, and not needed."""
    text = of_three("a + b*d + c*d^2")
    (candidate,) = read_problem(text).robot.questions.candidates
    with pytest.raises(VerificationError, match="comes out otherwise"):
        verify_definite(read_problem(text).robot, candidate, replace(found(text), is_exact=True), 5)


def test_a_product_of_factors_that_is_known_is_left_out() -> None:
    """(a - b)(a + b)(a² - 2b²) > 0 where 2a² > 3b²"""
    three = "[[a, b*cos(q2), 0], [b*cos(q2), a, b], [0, b, a]]"
    assert solve_json(file(three))["results"]["definite"]["M"]["conditions"] == ["a > 0", "a**2 - 2*b**2 > 0"]


@pytest.mark.parametrize("order", ["AB", "BA"])
def test_a_sum_of_one_matrix_is_not_looked_for_in_another(order: str) -> None:
    """(q₂ - d)² has a letter that the other matrix does not have."""
    matrices = {"A": "[[a + (q2 - d)^2, 0], [0, m]]", "B": "[[b, 0], [0, c]]"}
    text = "".join(f"  {name}: {matrices[name]}\n" for name in order)
    file = f"candidates:\n{text}coordinates: {{q1: revolute, q2: prismatic}}\nfind: [definite]\n"
    found = dynsolve.solve(file)
    assert found.to_json()["results"]["definite"]["A"]["conditions"] == ["a > 0", "m > 0"]
    assert "(q_{2} - d)^{2}" in found.to_markdown()
