"""Runs of letters, cut into the names of the problem."""

from __future__ import annotations

import pytest

from dynsolve.answers.reading.lexer import tokenize
from dynsolve.answers.reading.name_splitting import split_names
from dynsolve.answers.reading.vocabulary import vocabulary
from tests.unit.answers.reading.submissions import problem

RUNS = [
    ("m1", "m1"),
    ("m_2gl_1", "m_2 g l_1"),
    ("m1gsin(q1)", "m1 g sin ( q1 )"),
    ("m_{1}sgn(q1)", "m_{1} sgn ( q1 )"),
    ("gravity", "gravity"),
    ("x_{m1g}", "x_{m1g}"),
]


@pytest.mark.parametrize(("text", "names"), RUNS)
def test_a_run_of_letters_is_cut_where_it_holds_names_alone(text: str, names: str) -> None:
    tokens = split_names(tokenize(text)[:-1], vocabulary(problem("planar-2r")))
    assert " ".join(token.text for token in tokens) == names


def test_the_pieces_of_a_run_know_their_places() -> None:
    tokens = split_names(tokenize("m_2gl_1")[:-1], vocabulary(problem("planar-2r")))
    assert [(token.start, token.end) for token in tokens] == [(0, 3), (3, 4), (4, 7)]
