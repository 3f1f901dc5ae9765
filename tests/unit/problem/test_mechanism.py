"""Faults of `model`: each at its place, with what is wrong and the remedy; see `test_faults`."""

from __future__ import annotations

import pytest

from dynsolve.problem import read_problem
from tests.unit.problem.marked import errors, places, unmarked


def model(parts: str, coordinates: str = "{x: prismatic, th: revolute}") -> str:
    return f"model:\n  coordinates: {coordinates}\n{parts}"


def body(parts: str) -> str:
    return model(f"  bodies:\n    - {parts}\n")


BALL = "{mass: m, at: [x, 0, 0]}"
D = "  D: [[a, b*sin(th)], [b*sin(th), c]]\n"

FAULTS = {
    "no mapping": ("model: «3»", "model is a mapping", "coordinates: {x: prismatic}"),
    "no coordinates": ("model: «{bodies: [{mass: m, at: [0, 0, 0]}]}»", "no `coordinates`", "{x: prismatic"),
    "an unknown type": (model(f"  bodies: [{BALL}]", "{x: «linear»}"), "the type of x is one of", "revolute"),
    "a list of names": (model(f"  bodies: [{BALL}]", "«[x]»"), "names with their types", "{x: prismatic"),
    "nothing": ("model: «{coordinates: {x: prismatic}}»", "neither bodies nor energies", "add `bodies`"),
    "beside a table": ("«dh»: [{theta: q*}]\n" + body(BALL), "stands beside `model`", "delete it"),
    "beside masses": (body(BALL) + "«masses»: []\n", "stands beside `model`", "delete it"),
    "bodies and D": (model(f"  bodies: [{BALL}]\n" + D.replace("D", "«D»")), "beside `bodies`", "keep one"),
    "P beside bodies": (
        model(f"  bodies: [{BALL}]\n  «P»: m*g*x\n"),
        "`P` stands beside `bodies`",
        "springs",
    ),
    "P beside L": (model("  L: x'^2\n  «P»: x\n"), "`P` stands beside `L`", "K - P"),
    "no position": (body("«{mass: m}»"), "body 1 has no `at`", "at: [x, y, z]"),
    "a coordinate in a mass": (body("{mass: «x», at: [0, 0, 0]}"), "contains the coordinate x", "`at` and"),
    "a square of a turn": (body("{mass: m, at: [x, 0, 0], turn: «x^2»}"), "not linear", "theta - x/R"),
    "a product in a turn": (body("{mass: m, at: [x, 0, 0], turn: «x*th»}"), "not linear", "theta - x/R"),
    "a number as a turn": (body("{mass: m, at: [x, 0, 0], turn: th + «90»}"), "bare number", "90deg"),
    "an axis without a turn": (body("{mass: m, at: [x, 0, 0], «about»: [0, 0, 1]}"), "no `turn`", "delete"),
    "an axis of no known length": (
        body("{mass: m, at: [x, 0, 0], turn: th, about: [«1», 1, 0], inertia: {zz: I}}"),
        "no length that is known",
        "1/sqrt(2)",
    ),
    "a tensor that is not symmetric": (
        body("{mass: m, at: [x, 0, 0], turn: th, inertia: [[a, b, 0], [«c», a, 0], [0, 0, a]]}"),
        "not symmetric",
        "same entry",
    ),
    "a denominator": (body("{mass: m, at: [«1/x», 0, 0]}"), "a denominator contains", "free of"),
    "two of one name": (
        model(
            "  bodies:\n    - {name: 2, mass: m, at: [x, 0, 0]}\n    - {mass: m, at: [x, 0, 0], name: «2»}\n"
        ),
        "has the name 2",
        "a name of its own",
    ),
    "D is not symmetric": (model("  D: [[a, b], [«b + c», a]]\n"), "d21 is not d12 = b", "same entry"),
    "D is too small": (model("  D: «[[a]]»\n"), "D has 1 rows, not 2", "a row and a column"),
    "a row of D is too short": (model("  D: [[a, b], «[b]»]\n"), "row 2 has 1 entries, not 2", "a row and"),
    "K is linear in the rates": (model("  K: «x'^2 + b*th'»\n"), "not quadratic in the rates", "two rates"),
    "K without rates": (model("  K: «x^2»\n"), "not quadratic in the rates", "two rates"),
    "P with rates": (model(D + "  P: «x'»\n"), "P holds rates", "coordinates"),
    "L is cubic in the rates": (model("  L: «x'^3»\n"), "L is no K - P", "linear in the rates"),
    "a rate of no coordinate": (model("  K: «y'»^2\n"), "y is no coordinate", "coordinates are x, th"),
    "an acceleration": (model("  K: «x''»^2\n"), "the acceleration of x", "coordinates and rates"),
    "a degree": (model("  K: «x^7*x'^2»\n"), "of degree 9", "to degree 8"),
    "an answer of frames": (body(BALL) + "find: [«H1»]\n", "no answer of this problem", "answers are"),
}


@pytest.mark.parametrize("name", FAULTS)
def test_a_fault_is_told_at_its_place(name: str) -> None:
    marked, message, remedy = FAULTS[name]
    text, wanted = unmarked(marked)
    found = errors(text)
    assert places(found) == wanted
    assert message in found[0].message
    assert remedy in found[0].help


def test_gravity_beside_given_energies_is_warned_of() -> None:
    (warning,) = read_problem("gravity: [0, 0, -g]\n" + model(D), "").warnings
    assert warning.code == "no-effect"


def test_rates_may_be_written_with_primes_or_spelled_out() -> None:
    primes, spelled = (read_problem(model(f"  K: {K}\n"), "").robot for K in ("m*x'^2", "m*x_dot^2"))
    assert primes.given is not None and spelled.given is not None
    assert str(primes.given.K) == str(spelled.given.K)


def test_a_turn_may_be_divided_by_a_length() -> None:
    (body_,) = read_problem(
        body("{mass: m, at: [x, 0, 0], turn: th - x/R, inertia: {zz: I}}"), ""
    ).robot.bodies
    by_x, by_th = body_.turns[0].rates.entries
    assert -by_x * by_x.ring.symbol("R") == by_th == by_x.ring.one


ONE = "candidates: {M: [[a]]}\ncoordinates: {x: prismatic}\n"
TWO = "coordinates: {x: prismatic, q: revolute}\n"

CANDIDATES = {
    "no coordinates": ("«candidates»: {M: [[a]]}", "no `coordinates`", "{q1: revolute"),
    "of another size": (f"{TWO}candidates: {{M: «[[a]]»}}", "1 rows, not 2", "Ma"),
    "beside a table": (f"{ONE}«dh»: [{{d: x*}}]", "beside `candidates`", "delete"),
    "no inequality": (f"{ONE}assume: [«a»]", "no inequality", "a1 > a2"),
    "of no candidate": (f"{ONE}assume: {{«N»: [a > 0]}}", "no candidate N", "by its name"),
    "of a coordinate": (f"{ONE}assume: [«x» > 0]", "the coordinate x", "parameters"),
    "another answer": (f"{ONE}find: [«D»]", "no answer of this problem", "answers"),
}


@pytest.mark.parametrize("name", CANDIDATES)
def test_a_fault_of_candidates_is_told_at_its_place(name: str) -> None:
    marked, message, remedy = CANDIDATES[name]
    text, wanted = unmarked(marked)
    found = errors(text)
    assert places(found) == wanted
    assert message in found[0].message
    assert remedy in found[0].help


def test_coordinates_of_a_table_may_be_given_with_their_types() -> None:
    text = "dh: [{theta: q1*, a: l1}, {d: d2*}]\ncoordinates: {d2: prismatic, q1: revolute}\n"
    assert [q.name for q in read_problem(text).robot.coordinates] == ["d2", "q1"]
    wrong, wanted = unmarked(text.replace("q1: revolute", "q1: «prismatic»"))
    assert places(errors(wrong)) == wanted


def test_of_what_was_refused_nothing_more_is_said() -> None:
    asked = "«task»: [x]\n«velocity»: [v]\n«weights»: D\nfind: [qd]\n"
    text, wanted = unmarked(f"gravity: none\n{body(BALL)}{asked}")
    assert places(errors(text)) == wanted
    text, wanted = unmarked(f"{TWO}candidates: {{M: «[[a]]»}}\nassume: {{M: [a > 0]}}\n")
    assert places(errors(text)) == wanted
