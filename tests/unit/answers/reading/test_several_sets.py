"""Several sets in one hand-in: each line belongs to the set that its words speak of, in every order."""

from __future__ import annotations

from itertools import permutations

import pytest

from dynsolve.answers.judge import Checker
from dynsolve.answers.reading.files import read_submission
from dynsolve.problem import read_problem

TWO_LINKS = Checker(
    read_problem("""
gravity: [0, -g, 0]
dh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}]
masses: [{mass: m1, link: 1}, {mass: m2, link: 2}]
reach: [x, y]
find: [det, singular, inverse, equilibria]
""")
)
POLAR = Checker(
    read_problem("""
gravity: none
dh: [{theta: phi* + 90deg, alpha: 90deg}, {d: rho* + h}]
reach: [x, y]
find: [det, singular, inverse]
""")
)
COS = r"\frac{x^2+y^2-l_1^2-l_2^2}{2l_1l_2}"
Q1 = r"q_1=\operatorname{atan2}(y,x)-\operatorname{atan2}(l_2\sin q_2,l_1+l_2\cos q_2)"
CHAIN = r"\det J=l_1l_2(\sin(q_1+q_2)\cos q_1-\cos(q_1+q_2)\sin q_1)=l_1l_2\sin q_2"
RHO = (r"\rho=\sqrt{x^2+y^2}-h,\ \phi=\operatorname{atan2}(y,x)",
       r"\rho=-\sqrt{x^2+y^2}-h,\ \phi=\operatorname{atan2}(-y,-x)")  # fmt: skip
DET, SINGULAR, INVERSE, EQUILIBRIA = "det", "singular", "inverse", "equilibria"

# every form of every part, in three languages
PARTS: dict[str, dict[str, list[str]]] = {
    "en": {
        DET: [f"$${CHAIN}$$", f"The determinant is\n$${CHAIN}.$$", f"${CHAIN}$"],
        SINGULAR: ["Singular when $q_2=0$ or $q_2=\\pi$.", "Singular: $q_2=0$, $q_2=\\pi$",
                   "The arm is singular for\n$$\\sin q_2=0.$$"],
        INVERSE: [f"Inverse: $q_2=\\pm\\arccos{COS}$, ${Q1}$",
                  f"Inverse kinematics:\n$$q_2=\\pm\\arccos{COS}$$\nand\n$${Q1}$$",
                  f"The solutions are $q_2=\\arccos{COS}$ and ${Q1}$ or $q_2=-\\arccos{COS}$ and ${Q1}$."],
        EQUILIBRIA: ["Equilibria: $\\cos q_1=0$ and $\\sin q_2=0$",
                     "At rest\n$$\\cos q_1=0,\\quad\\text{and}\\quad\\sin q_2=0.$$"],
    },
    "de": {
        DET: [f"$${CHAIN}$$", f"Die Determinante ist\n$${CHAIN}.$$"],
        SINGULAR: ["Singulär für $q_2=0$ oder $q_2=\\pi$.", "Singularitäten: $q_2=0$ und $q_2=\\pi$",
                   "Der Arm ist singulär, wenn $\\sin q_2=0$."],
        INVERSE: [f"Inverse: $q_2=\\pm\\arccos{COS}$, ${Q1}$",
                  f"Lösungen: $q_2=\\arccos{COS}$ und ${Q1}$ oder $q_2=-\\arccos{COS}$ und ${Q1}$."],
        EQUILIBRIA: ["Gleichgewichtslagen: $\\cos q_1=0$ und $\\sin q_2=0$",
                     "Im Gleichgewicht ist $\\cos q_1=0$ und $\\sin q_2=0$."],
    },
    "no": {
        DET: [f"$${CHAIN}$$", f"Determinanten er\n$${CHAIN}.$$"],
        SINGULAR: ["Singulær når $q_2=0$ eller $q_2=\\pi$.", "Singulariteter: $q_2=0$ og $q_2=\\pi$",
                   "Armen er singulær for $\\sin q_2=0$."],
        INVERSE: [f"Invers: $q_2=\\pm\\arccos{COS}$, ${Q1}$",
                  f"Løsningene er $q_2=\\arccos{COS}$ og ${Q1}$ eller $q_2=-\\arccos{COS}$ og ${Q1}$."],
        EQUILIBRIA: ["Likevekt: $\\cos q_1=0$ og $\\sin q_2=0$",
                     "Likevektspunktene er gitt ved $\\cos q_1=0$ og $\\sin q_2=0$."],
    },
}  # fmt: skip

WRONG = {
    DET: ("=l_1l_2", "=l_1"),
    SINGULAR: ("q_2", "q_1"),
    INVERSE: ("y,x", "x,y"),
    EQUILIBRIA: (r"\cos", r"\sin"),
}


def verdicts(checker: Checker, text: str) -> dict[str, str]:
    report = checker(read_submission(checker.problem, text, "report.md"))
    return {answer.name: answer.verdict.value for answer in report.answers}


@pytest.mark.parametrize("language", PARTS)
@pytest.mark.parametrize(("number", "order"), list(enumerate(permutations(WRONG))))
def test_every_order(language: str, number: int, order: tuple[str, ...]) -> None:
    """Each part is judged by itself; one of them, another in each hand-in, is wrong, or none."""
    parts = {name: forms[number % len(forms)] for name, forms in PARTS[language].items()}
    faulty = [*WRONG, ""][number % 5]
    if faulty:
        parts[faulty] = parts[faulty].replace(*WRONG[faulty])
    found = verdicts(TWO_LINKS, "\n\n".join(parts[name] for name in order))
    assert found == {name: "wrong" if name == faulty else "correct" for name in WRONG}


@pytest.mark.parametrize("word", ["or", "oder", "eller", "and", "und", "og"])
@pytest.mark.parametrize("order", list(permutations((DET, SINGULAR, INVERSE))))
def test_a_sliding_arm(word: str, order: tuple[str, ...]) -> None:
    parts = {
        DET: r"$$\det J=-(\rho+h)(\sin^2\phi+\cos^2\phi)=-(\rho+h)$$",
        SINGULAR: r"Singulær når $\rho=-h$.",
        INVERSE: f"Inverse: ${RHO[0]}$ {word} ${RHO[1]}$",
    }
    found = verdicts(POLAR, "\n\n".join(parts[name] for name in order))
    assert found == dict.fromkeys(parts, "correct")


def test_a_comma_before_the_word_joins_no_less() -> None:
    for text in ("Equilibria: $\\cos q_1=0$, and $\\sin q_2=0$", "Likevekt: $\\cos q_1=0$, og $\\sin q_2=0$"):
        assert verdicts(TWO_LINKS, text)[EQUILIBRIA] == "correct"
        assert verdicts(TWO_LINKS, text.replace("q_2", "q_1"))[EQUILIBRIA] == "wrong"
