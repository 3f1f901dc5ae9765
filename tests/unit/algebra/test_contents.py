"""What formulas hold that a ring must hold for them."""

from __future__ import annotations

import pytest

from dynsolve.algebra.angles import Angle, Contents, ContentsCollector
from dynsolve.errors import AlgebraError
from dynsolve.notation.text import read


def contents(*texts: str) -> Contents:
    collector = ContentsCollector()
    collector.collect([read(text).tree for text in texts])
    return collector.contents


def test_each_is_noted_once_in_order_of_first_appearance() -> None:
    held = contents("m*l^2*cos(q1) + l*m*g*cos(q1)", "a/(m + l) + sqrt(3)*tan(beta)")
    assert held.symbols == ("m", "l", "q1", "g", "a", "beta")
    assert held.angles == (Angle.of("q1"), Angle.of("beta"))
    assert held.radicands == (3,)
    assert held.denominators == (read("m + l").tree, read("cos(beta)").tree)


def test_an_inner_root_stands_before_the_outer() -> None:
    assert contents("sqrt(1 + sqrt(a))").roots == (read("a").tree, read("1 + sqrt(a)").tree)


def test_what_occurs_in_either_occurs_in_both_joined() -> None:
    assert not Contents()
    assert contents("a", "b*c").joined(contents("c + d")).symbols == ("a", "b", "c", "d")


@pytest.mark.parametrize("text", ["sqrt(0 - 4)", "sin(90)"])
def test_what_no_ring_can_hold_is_refused(text: str) -> None:
    with pytest.raises(AlgebraError):
        contents(text)
