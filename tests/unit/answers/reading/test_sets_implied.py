"""Sets by what implies them, by products of sets, and with coordinates that are free, in three languages."""

from __future__ import annotations

import time

import pytest

from dynsolve.answers.judge import Checker
from dynsolve.answers.reading.files import read_submission
from dynsolve.problem import read_problem

PENDULUM = Checker(
    read_problem("""
gravity: [0, -g, 0]
model: {coordinates: {x: prismatic, phi: revolute}, bodies: [{mass: m, at: [x + l*sin(phi), -l*cos(phi), 0]}]}
find: [equilibria]
""")
)
DOUBLE = Checker(
    read_problem("""
gravity: [0, -g, 0]
dh: [{theta: q1* - 90deg, a: l1}, {theta: q2*, a: l2}]
masses: [{mass: m1, link: 1}, {mass: m2, link: 2}]
find: [equilibria]
""")
)
ARM = Checker(
    read_problem("""
gravity: none
dh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}]
reach: [x, y]
find: [det, singular]
""")
)


def verdict(checker: Checker, text: str) -> str:
    answers = checker(read_submission(checker.problem, text, "report.md")).answers
    return answers[-1].verdict.value  # the determinant stands before the set


OF_PENDULUM = [
    r"Gleichgewichtslagen: aus $\sin\phi=0$ folgt $\phi=0$ oder $\phi=\pi$",
    r"Gleichgewicht: $\sin\phi=0$, daraus folgt $\phi=0$ oder $\phi=\pi$.",
    r"Gleichgewicht: $\sin\phi=0$, woraus $\phi=0$ oder $\phi=\pi$ folgt.",
    r"Equilibria: from $\sin\phi=0$ follows $\phi=0$ or $\phi=\pi$",
    r"Equilibria: $\sin\phi=0$ gives $\phi=0$ or $\phi=\pi$",
    r"Equilibria: $\sin\phi=0$, so $\phi=0$ or $\phi=\pi$",
    r"Equilibria: $\sin\phi=0$ so that $\phi=0$ or $\phi=\pi$",
    r"Equilibria: $\sin\phi=0$ implies $\phi=0$ or $\phi=\pi$",
    r"Equilibria: $\sin\phi=0$ yields $\phi=0$ or $\phi=\pi$",
    r"Equilibria: $mgl\sin\phi=0$ and hence $\phi=0$ or $\phi=\pi$.",
    r"Likevekt: $\sin\phi=0$ gir $\phi=0$ eller $\phi=\pi$",
    r"Ved likevekt: $\sin\phi=0$, som gir $\phi=0$ eller $\phi=\pi$",
    r"Ved likevekt er $\sin\phi=0$, det gir $\phi=0$ eller $\phi=\pi$.",
    r"Likevekt: av $\sin\phi=0$ følger $\phi=0$ eller $\phi=\pi$",
    r"At equilibrium $\sin\phi=0$, which gives $\phi=0$ or $\phi=\pi$.",
    r"At equilibrium $\sin\phi=0$ and so $\phi=0$ or $\phi=\pi$.",
    r"In equilibrium, from $\sin\phi=0$ it follows that $\phi=0$ or $\phi=\pi$.",
    r"Im Gleichgewicht gilt $\sin\phi=0$ und damit $\phi=0$ oder $\phi=\pi$.",
    r"Ruhelagen: $x$ beliebig, $\phi\in\{0,\pi\}$",
    r"Ruhelagen: $\phi\in\{0,\pi\}$, $x\in\mathbb{R}$ beliebig",
    r"Likevekt: $\phi=k\pi$, $x$ er vilkårlig",
    r"Likevekt: $\phi=k\pi$ for alle $x$",
    r"Equilibria: $\phi=k\pi$ for all $x$",
    r"Equilibria: $\phi=k\pi$ for any value of $x$",
    r"Equilibria: $\phi=k\pi$ for every $x\in\mathbb R$",
    r"Gleichgewichte: $\phi=k\pi$, $k\in\mathbb Z$, für alle $x$",
    r"Gleichgewichte: $\phi=k\pi$ mit $k\in\mathbb Z$, $x$ ist frei",
    r"Gleichgewichte: $\phi=k\pi$ mit beliebigem $x$",
    r"Gleichgewichte: $\phi=k\pi$ bei beliebigem $x$",
    r"Gleichgewichte: $\phi=k\pi$, $k$ ganzzahlig",
    r"Equilibria: $\phi=k\pi$ ($k$ an integer), any $x$",
    r"Equilibria: $\phi=\pi n$, $n=0,\pm1,\dots$",
    r"Equilibria: $(x,\phi)\in\{(x,0),(x,\pi)\}$",
    r"Likevekt: $\phi=0$ og $\phi=\pi$ for vilkårlig $x$",
    r"Likevekt: $\phi=0$ og $\phi=\pi$ med vilkårlig $x$",
    r"The equilibria are $\phi=0$ and $\phi=\pi$, $x$ being arbitrary.",
    r"The equilibria are $\phi=0$ and $\phi=\pi$ with arbitrary $x$.",
]
OF_DOUBLE = [
    r"Equilibria: $q_1\in\{0,\pi\}$, $q_2\in\{0,\pi\}$",
    r"Equilibria: $q_1\in\{0,\pi\},\ q_2\in\{0,\pi\}$",
    r"Equilibria: $q_1\in\{0,\pi\}$ and $q_2\in\{0,\pi\}$",
    r"Gleichgewichte: $q_1,q_2\in\{0,\pi\}$",
    r"Equilibria: $(q_1,q_2)\in\{(0,0),(0,\pi),(\pi,0),(\pi,\pi)\}$",
    r"Equilibria: $(q_1,q_2)=(0,0),(0,\pi),(\pi,0),(\pi,\pi)$",
    r"Equilibria: $(q_1,q_2)\in\{0,\pi\}\times\{0,\pi\}$",
    r"Equilibria: $(q_1,q_2)\in\{0,\pi\}^2$",
    r"Equilibria: $q_1=k\pi,\ q_2=l\pi$",
    r"Equilibria: $q_1=k\pi,\ q_2=l\pi$ with $k,l\in\mathbb Z$",
    r"Equilibria: $q_1=k\pi$, $q_2=n\pi$, $k,n\in\mathbb{Z}$",
    r"Gleichgewichte: $q_1=k\pi$ und $q_2=n\pi$ mit $k,n\in\mathbb{Z}$",
    r"Likevekt: $q_1=n_1\pi$ og $q_2=n_2\pi$",
    r"Equilibria: $q_1=n\pi$, $q_2=m\pi$, $n,m\in\mathbb{Z}$",
    r"The equilibria are $q_1\in\{0,\pi\}$ and $q_2\in\{0,\pi\}$.",
    r"Im Gleichgewicht: $$q_1\in\{0,\pi\},\quad q_2\in\{0,\pi\}$$",
    r"Im Gleichgewicht: $$(q_1,q_2)\in\{(0,0),(0,\pi),(\pi,0),(\pi,\pi)\}$$",
    r"Im Gleichgewicht gilt $$q_1=k\pi,\quad q_2=l\pi,\quad k,l\in\mathbb Z$$",
    r"Equilibria: $q_1=0$ or $q_1=\pi$, and $q_2=0$ or $q_2=\pi$",
    r"Equilibria: $q_1 = 0$ or $\pi$ and $q_2 = 0$ or $\pi$",
    r"Equilibria: $\sin q_1=0$ and $\sin(q_1+q_2)=0$, so $q_1\in\{0,\pi\}$ and $q_2\in\{0,\pi\}$",
    "Equilibria:\n\n- $(0,0)$\n- $(0,\\pi)$\n- $(\\pi,0)$\n- $(\\pi,\\pi)$",
]
OF_ARM = [
    r"Singular: $q_2\in\{0,\pi\}$, $q_1\in[-\pi,\pi]$",
    r"Singular: $q_2\in\{0,\pi\}$, $q_1\in(-\pi,\pi]$",
    r"Singular: $q_2\in\{0,\pi\}$ for all $q_1$",
    r"Singular: $q_2\in\{0,\pi\}$, $q_1\in[0,2\pi)$",
    r"Singulär: $q_2=0$ oder $q_2=\pi$ ($q_1$ beliebig)",
    r"Singulær: $q_2=0$ eller $q_2=\pi$, uansett $q_1$",
    r"Singulær: $q_2=0$ eller $q_2=\pi$, uavhengig av $q_1$",
    r"Singular: $q_2=0$ or $q_2=\pi$, independent of $q_1$",
    r"Singulär: $q_2=0$ oder $q_2=\pi$, unabhängig von $q_1$",
    r"Singular for $q_2=0$ or $q_2=\pi$ and all $q_1$.",
    r"Der Arm ist singulär für $q_2=0$ und $q_2=\pi$, $q_1$ beliebig.",
    r"Der Arm ist singulär für $q_2=k\pi$, $k\in\mathbb Z$, und beliebiges $q_1$.",
    r"Singular: $\{(q_1,q_2)\mid q_2=k\pi\}$",
    r"From $\sin q_2=0$ it follows that the arm is singular for $q_2=0$ and $q_2=\pi$.",
    r"Aus $\det J=0$ folgt $\sin q_2=0$, also $q_2=0$ oder $q_2=\pi$.",
    r"$\det J=0$ gir $q_2=0$ eller $q_2=\pi$.",
    r"$\det J=0$ gives $q_2=0$ or $q_2=\pi$.",
    r"$\det J=0$ für $q_2=0$ oder $q_2=\pi$.",
    r"$\det J=l_1l_2\sin q_2=0$ yields $q_2=0$ or $q_2=\pi$.",
    r"$$\det J=l_1l_2\sin q_2=0\text{ gir }q_2=0\text{ eller }q_2=\pi$$",
    r"$$\det J=l_1l_2\sin q_2=0\quad\text{so}\quad q_2=0\text{ or }q_2=\pi$$",
    r"$$\det J=l_1l_2\sin q_2=0\quad\text{when}\quad q_2=0\text{ or }q_2=\pi$$",
]


FORMS = [
    *((PENDULUM, form) for form in OF_PENDULUM),
    *((DOUBLE, form) for form in OF_DOUBLE),
    *((ARM, form) for form in OF_ARM),
]


@pytest.mark.parametrize(("checker", "form"), FORMS)
def test_a_set_is_read(checker: Checker, form: str) -> None:
    assert verdict(checker, form) == "correct"
    assert verdict(checker, form.replace(r"\pi", r"\frac{\pi}{3}", 1)) == "wrong"


def test_a_part_of_the_circle_is_not_all_of_it() -> None:
    assert verdict(ARM, r"Singular: $q_2\in\{0,\pi\}$, $q_1\in[0,\pi]$") == "unreadable"


def test_a_coordinate_alone_is_no_set() -> None:
    assert verdict(ARM, "It is singular however $q_2$ is chosen.") == "missing"
    assert verdict(ARM, "It is singular if $\\sin q_2$ vanishes.") == "correct"


@pytest.mark.parametrize("text", [
    r"\phi=0," + " " * 20_000 + "(k", "a," * 5_000 + r"\phi\in\{0\}", r"\phi\in\{0\}," * 2_000,
    r"\phi=0, and " * 2_000, r"\phi=0" + " since" * 2_000, r"\phi\in" + r"\{0\}\times" * 2_000,
])  # fmt: skip
def test_long_text(text: str) -> None:
    start = time.process_time()
    verdict(PENDULUM, f"Equilibria: {text}")
    assert time.process_time() - start < 1
