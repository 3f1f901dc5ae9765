"""A coordinate counted the other way, or from elsewhere: what belongs to it turns with it."""

from __future__ import annotations

import re

import pytest

from tests.unit.answers.hands import checker, verdicts

Q2 = "planar-2r"
D12 = "(m2*(lc2^2 + l1*lc2*cos(q2)) + I2)"
D11 = "(m1*lc1^2 + m2*(l1^2 + lc2^2 + 2*l1*lc2*cos(q2)) + I1 + I2)"
D22 = "(m2*lc2^2 + I2)"
H = "(m2*l1*lc2*sin(q2))"
G2 = "m2*g*lc2*cos(q1 + q2)"
RIGHT = {  # in the problem's coordinates, each with what becomes of its entries
    "tau1": (f"{D11}*q1_ddot + {D12}*q2_ddot - {H}*(2*q1_dot*q2_dot + q2_dot^2)"
             f" + (m1*lc1 + m2*l1)*g*cos(q1) + {G2}", 1),
    "tau2": (f"{D12}*q1_ddot + {D22}*q2_ddot + {H}*q1_dot^2 + {G2}", -1),
    "dLdqd2": (f"{D12}*q1_dot + {D22}*q2_dot", -1),
    "dLdq2": (f"-{H}*q1_dot*(q1_dot + q2_dot) - {G2}", -1),
    "ddt2": (f"{D12}*q1_ddot + {D22}*q2_ddot - {H}*q1_dot*q2_dot", -1),
    "g1": (f"(m1*lc1 + m2*l1)*g*cos(q1) + {G2}", 1),
    "g2": (G2, -1),
    "d12": (D12, -1),
    "d22": (D22, 1),
    "c121": (f"-{H}", -1),
    "c221": (f"-{H}", 1),
    "c112": (H, -1),
    "P2": ("m2*g*(l1*sin(q1) + lc2*sin(q1 + q2))", 1),
    "Kw2": ("I2*(q1_dot + q2_dot)^2/2", 1),
}  # fmt: skip


def turned(text: str, by: str, rate: str) -> str:
    """The text with the student's coordinate for q2."""
    text = re.sub(r"q2_(d+ot)", rf"({rate}_\1)".replace("--", ""), text)
    return re.sub(r"\bq2\b", f"({by})", text)


@pytest.mark.parametrize(
    ("meaning", "by", "rate", "sign"),
    [
        ("-q2", "-t2", "-t2", -1),
        ("pi/2 - q2", "pi/2 - t2", "-t2", -1),
        ("90deg - q2", "90deg - t2", "-t2", -1),
        ("q2 + pi/2", "t2 - pi/2", "t2", 1),
        ("q2", "t2", "t2", 1),
    ],
)
@pytest.mark.parametrize("name", RIGHT)
def test_every_quantity_turns_with_its_coordinate(
    name: str, meaning: str, by: str, rate: str, sign: int
) -> None:
    text, turns = RIGHT[name]
    mine = turned(text, by, rate)
    for factor, verdict in ((turns if sign < 0 else 1, "correct"), (-turns if sign < 0 else -1, "wrong")):
        file = f"symbols: {{t2: {meaning}}}\nanswers:\n  {name}: {factor}*({mine})\n"
        one = checker(Q2)
        assert verdicts(one(one.reader(file, "a.yaml")))[name] == verdict


MATRICES = [
    ("Jw", "[[0, 0], [0, 0], [1, -1]]", "correct"),
    ("Jw", "[[0, 0], [0, 0], [1, 1]]", "wrong"),
    ("D", "[[D11, -D12], [-D12, D22]]", "correct"),
    ("D", "[[D11, D12], [D12, D22]]", "wrong"),
    ("g", "[(m1*lc1 + m2*l1)*g*cos(q1) + m2*g*lc2*cos(q1 - t2), -m2*g*lc2*cos(q1 - t2)]", "correct"),
    ("g", "[(m1*lc1 + m2*l1)*g*cos(q1) + m2*g*lc2*cos(q1 - t2), m2*g*lc2*cos(q1 - t2)]", "wrong"),
    ("C", "[[-h*t2_dot, h*(t2_dot - q1_dot)], [h*q1_dot, 0]]", "correct"),
    ("C", "[[h*t2_dot, h*(t2_dot + q1_dot)], [h*q1_dot, 0]]", "wrong"),
    ("g2", "m2*g*lc2*cos(q1 + q2)", "correct"),  # plainly in the problem's own coordinate
    ("g2", "-m2*g*lc2*cos(q1 + q2)", "wrong"),
]


@pytest.mark.parametrize(("name", "text", "verdict"), MATRICES)
def test_matrices_turn_by_rows_and_columns(name: str, text: str, verdict: str) -> None:
    for short, long in (("D11", D11), ("D12", D12), ("D22", D22)):
        text = text.replace(short, turned(long, "-t2", "-t2"))
    text = text.replace("h*", "m2*l1*lc2*sin(t2)*")
    file = f"symbols: {{t2: -q2}}\nanswers:\n  {name}: {text}\n"
    one = checker(Q2)
    assert verdicts(one(one.reader(file, "a.yaml")))[name] == verdict


def test_own_answers_inside_a_value_are_in_its_coordinates() -> None:
    file = "symbols: {t2: -q2}\nanswers:\n" + "".join(
        f"  {name}: {text}\n"
        for name, text in {
            "d12": "-" + turned(D12, "-t2", "-t2"), "d22": D22, "g2": "-m2*g*lc2*cos(q1 - t2)",
            "tau2": "d12*q1_ddot + d22*t2_ddot + m2*l1*lc2*sin(t2)*q1_dot^2 + g2",
        }.items()
    )  # fmt: skip
    one = checker(Q2)
    found = verdicts(one(one.reader(file, "a.yaml")))
    assert [found[n] for n in ("d12", "d22", "g2", "tau2")] == ["correct"] * 4


def test_a_relative_angle_is_no_other_sense() -> None:
    file = "symbols: {t2: q2 - q1}\nanswers:\n  d22: m2*lc2^2 + I2\n  g2: m2*g*lc2*cos(2*q1 + t2)\n"
    one = checker(Q2)
    found = verdicts(one(one.reader(file, "a.yaml")))
    assert (found["d22"], found["g2"]) == ("correct", "correct")


def test_a_slide_from_elsewhere() -> None:
    one = checker("in3140-rp")
    file = (
        "symbols: {d: -L2}\nanswers:\n  f2: -(m2*(-d_ddot) - m2*(-d)*theta1_dot^2)\n"
        "  D: [[I1zz + m2*d^2, 0], [0, m2]]\n"
    )
    found = verdicts(one(one.reader(file, "a.yaml")))
    assert (found["f2"], found["D"]) == ("correct", "correct")
