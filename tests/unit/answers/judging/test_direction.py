"""D, C, g and τ lead to each other, either way; what was written first is not explained by the rest."""

from __future__ import annotations

import random
from collections.abc import Mapping
from typing import Any

import pytest

from dynsolve.algebra.matrix import Matrix
from dynsolve.answers.answer_verdict import NOT_FROM_OWN
from dynsolve.answers.verdict import Answer, Place, Report, Submission
from dynsolve.derivation import euler_lagrange
from dynsolve.derivation.link_frame import velocities
from tests.unit.answers.hands import checker, key, problem, verdicts
from tests.unit.answers.test_generated import forms, graph, spoilt

STEMS = ["in3140-rp", "planar-2r", "rp-vertical", "elbow-3r", "spherical-rrp"]


def hand_in(stem: str, values: Mapping[str, Any]) -> Report:
    """The report on answers in this order; C is given as C q̇."""
    answers = tuple(
        Answer(graph(stem).answer(node), "", forms(stem).of(value), Place(i + 1, 1), "", occurrence=(i, 0))
        for i, (node, value) in enumerate(values.items())
    )
    return checker(stem)(Submission("", "", "", answers))


def assembled(stem: str, D: Matrix, Cqd: Matrix, g: Matrix) -> Matrix:
    """τ of D, C q̇ and g."""
    robot = problem(stem).robot
    return Matrix.column(robot.ring, [euler_lagrange.torque(robot, D, Cqd, g, k=k) for k in range(robot.n)])


def symmetric_slip(D: Matrix, draw: random.Random) -> Matrix:
    """D with a slip in one entry, and in the one that mirrors it."""
    place = draw.choice([(i, j) for i in range(len(D.rows)) for j in range(i + 1) if not D[i, j].is_zero])
    wrong = D[place] * draw.choice([2, -1, 3])
    rows = [list(row) for row in D.rows]
    rows[place[0]][place[1]] = rows[place[1]][place[0]] = wrong
    return Matrix.of(D.ring, rows)


@pytest.mark.parametrize("seed", range(12))
@pytest.mark.parametrize("stem", STEMS)
def test_tau_follows_from_a_slip_in_D(stem: str, seed: int) -> None:
    draw = random.Random(seed)
    g = graph(stem)
    D = symmetric_slip(g.key("D"), draw)
    Cqd, gravity = g.routes("Cqd")[1].compute(D), g.key("g")
    tau = assembled(stem, D, Cqd, gravity)
    torques: dict[str, Any] = (
        {"tau": tau} if seed % 2 else {f"tau{k + 1}": entry for k, entry in enumerate(tau.entries)}
    )
    found = verdicts(report := hand_in(stem, {"D": D, "Cqd": Cqd, "g": gravity, **torques}))
    assert (found["D"], found["g"], report.first_wrong) == ("wrong", "correct", "D")
    assert found["Cqd"] == ("correct" if Cqd.entries == g.key("Cqd").entries else "follows")
    for node, value in torques.items():
        right = g.key(node)
        same = value.entries == right.entries if isinstance(value, Matrix) else value == right
        assert found[g.answer(node)] == ("correct" if same else "follows")


@pytest.mark.parametrize("stem", STEMS)
@pytest.mark.parametrize("node", ["Cqd", "g"])
def test_tau_follows_from_a_slip_in_C_or_g(stem: str, node: str) -> None:
    g = graph(stem)
    values = {name: g.key(name) for name in ("D", "Cqd", "g")}
    wrong = spoilt(values[node], random.Random(1))
    if wrong is None:
        return
    values[node] = wrong
    found = verdicts(report := hand_in(stem, {**values, "tau": assembled(stem, **values)}))
    assert found == {
        **dict.fromkeys(("D", "Cqd", "g"), "correct"),
        node: "wrong",
        "tau": "follows",
        "C": found["C"],
    }
    assert next(a for a in report.answers if a.name == "tau").follows_from == (node,)


def invented(stem: str) -> dict[str, Any]:
    """D, C q̇ and g of nobody's robot, and the τ that they make."""
    ring, n = problem(stem).robot.ring, problem(stem).robot.n
    mass = ring.symbol(next(name for name in ring.parameters if name.startswith("m")))
    rates = [ring.symbol(name, 1) for name in ring.names]
    values = {
        "D": Matrix.of(ring, [[mass * 7 * (i == j) for j in range(n)] for i in range(n)]),
        "Cqd": Matrix.column(ring, [mass * 5 * rate * rate for rate in rates]),
        "g": Matrix.column(ring, [mass * 3 for _ in rates]),
    }
    return {**values, "tau": assembled(stem, **values)}


@pytest.mark.parametrize("stem", STEMS)
def test_what_was_invented_together_does_not_explain_itself(stem: str) -> None:
    values = invented(stem)
    found = verdicts(hand_in(stem, values))
    assert [found[name] for name in ("D", "Cqd", "g")] == ["wrong"] * 3
    found = verdicts(report := hand_in(stem, dict(reversed(values.items()))))
    assert (found["tau"], report.first_wrong) == ("wrong", "tau")


@pytest.mark.parametrize("stem", STEMS)
@pytest.mark.parametrize("missing", ["D", "Cqd", "g"])
def test_no_part_that_was_invented_explains_itself_through_the_others(stem: str, missing: str) -> None:
    values = {name: value for name, value in invented(stem).items() if name != missing}
    found = verdicts(hand_in(stem, values))
    assert {found[name] for name in values if name != "tau"} == {"wrong"}


def test_what_was_written_later_is_no_reason_for_a_note() -> None:
    """τ is right, and a slip is made in D afterwards."""
    g = graph("planar-2r")
    D = symmetric_slip(g.key("D"), random.Random(3))
    for order, note in ((("tau2", "D"), ()), (("D", "tau2"), (NOT_FROM_OWN,))):
        values = {"tau2": g.key("tau2"), "D": D}
        report = hand_in("planar-2r", {name: values[name] for name in order})
        assert next(a for a in report.answers if a.name == "tau2").notes == note


def test_one_wrong_line_of_tau_leaves_D_wrong_where_it_was_written_first() -> None:
    g = graph("planar-2r")
    D = symmetric_slip(g.key("D"), random.Random(3))
    Cqd = g.routes("Cqd")[1].compute(D)
    tau = assembled("planar-2r", D, Cqd, g.key("g"))
    worse = Matrix.column(tau.ring, [tau[0, 0] * 2, tau[1, 0]])
    found = verdicts(hand_in("planar-2r", {"D": D, "Cqd": Cqd, "g": g.key("g"), "tau": worse}))
    assert (found["D"], found["tau"]) == ("wrong", "wrong")


def test_what_goes_over_the_bound_of_work_leads_nowhere(monkeypatch: pytest.MonkeyPatch) -> None:
    """An input that nothing can be computed for leaves its route without values; no answer is lost for it."""
    monkeypatch.setattr("dynsolve.answers.judging.follow_through.MOST_WORK", 0)
    tau = key("planar-2r")["tau"]
    report = hand_in("planar-2r", {"P1": key("planar-2r")["P2"], "tau": tau.scale(tau.ring.constant(2))})
    assert verdicts(report) == {**verdicts(report), "P1": "wrong", "tau": "wrong"}


def sources(report: Report) -> dict[str, set[str]]:
    """What each answer, or any entry of it, follows from."""
    return {
        a.name: {*a.follows_from, *(name for entry in a.entries for name in entry.follows_from)}
        for a in report.answers
    }


@pytest.mark.parametrize("seed", range(12))
@pytest.mark.parametrize("stem", STEMS)
def test_nothing_follows_from_what_follows_from_it(stem: str, seed: int) -> None:
    """A slip in K or D, from which all the rest is derived, in any order and with τ in one or in parts."""
    draw = random.Random(seed)
    g = graph(stem)
    D = symmetric_slip(g.key("D"), draw)
    rates = velocities(problem(stem).robot)
    K = (rates.T @ D @ rates).entries[0] * euler_lagrange.HALF
    gravity = spoilt(g.key("g"), draw) if seed % 3 else g.key("g")
    Cqd = g.routes("Cqd")[1].compute(D)
    tau = assembled(stem, D, Cqd, gravity or g.key("g"))
    values = {"D": D, "Cqd": Cqd, "g": gravity or g.key("g")}
    values |= {"tau": tau} if seed % 2 else {f"tau{k + 1}": e for k, e in enumerate(tau.entries)}
    order = draw.sample(sorted(values), len(values)) if seed % 4 else list(values)
    report = hand_in(stem, {"K": K, **{name: values[name] for name in order}})
    assert verdicts(report)["D"] == "follows"
    left = sources(report)
    while left:
        grounded = [name for name, used in left.items() if not used & left.keys()]
        assert grounded, left
        for name in grounded:
            del left[name]


def test_what_follows_from_the_energy_is_not_said_to_follow_from_tau() -> None:
    """K is wrong, and D, C, g and τ are made of it and written in this order."""
    stem = "planar-2r"
    g = graph(stem)
    D = g.key("D").scale(g.key("D").ring.constant(2))
    Cqd = g.routes("Cqd")[1].compute(D)
    K = g.key("K") * 2
    report = hand_in(stem, {"K": K, "D": D, "Cqd": Cqd, "tau": assembled(stem, D, Cqd, g.key("g"))})
    assert [sources(report)[name] for name in ("D", "Cqd")] == [{"K"}, {"D"}]
