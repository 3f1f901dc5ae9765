"""Sentences with formulas and values in them."""

from __future__ import annotations

import pytest

from dynsolve.document import Reference
from dynsolve.document.sentences import say
from dynsolve.notation.tree import Symbol

X = Symbol("x")


def test_words_and_formulas_stand_in_their_order() -> None:
    assert say("Let $x$ be {what}, $x$.", what="a length") == ("Let ", X, " be a length, ", X, ".")


def test_values_may_be_formulas_numbers_references_and_sentences() -> None:
    reference = Reference(("D",))
    said = say("{x} is {n}{where}{more}", x=X, n=2, where=reference, more=(", not ", X))
    assert said == (X, " is 2", reference, ", not ", X)


def test_what_is_empty_leaves_no_trace() -> None:
    assert say("One{two}{three}.", two="", three=()) == ("One.",)


def test_a_value_that_is_missing_is_an_error() -> None:
    with pytest.raises(KeyError):
        say("{what}")
