"""The lexer: plain text and LaTeX become the same tokens, each with its place."""

from __future__ import annotations

import pytest

from dynsolve.answers.reading.lexer import tokenize
from dynsolve.errors import ReadError

TEXTS = [
    ("m_2*g", "m_2 * g"),
    (r"m_{2} \cdot g", r"m_{2} \cdot g"),
    (r"\left( a + b \right)^2", "( a + b ) ^ 2"),
    (r"\displaystyle a \, b", "a b"),
    ("2.5e-3 l_1", "2.5e-3 l_1"),
    ("½ m θ̇₁²", "1/2 m theta1 ²"),
    (r"a % said by the student", "a"),
    (r"a \\[2pt] b", r"a \\ b"),
    (r"\text{and so on} b", "and so on b"),
]


@pytest.mark.parametrize(("text", "tokens"), TEXTS)
def test_the_tokens_of_a_text(text: str, tokens: str) -> None:
    assert " ".join(token.text for token in tokenize(text)[:-1]) == tokens


def test_dots_blanks_and_line_ends_are_kept_with_the_token() -> None:
    first, second, end = tokenize("q̇_1\n q̈_2")
    assert (first.dots, second.dots) == (1, 2)
    assert (first.spaced, second.spaced, second.broken) == (False, True, True)
    assert (second.start, end.kind) == (6, "end")


@pytest.mark.parametrize("text", ["a ? b", "m" * 201, r"\text{never closed", r"a \( b"])
def test_what_is_no_formula_is_said_with_its_place(text: str) -> None:
    with pytest.raises(ReadError) as error:
        tokenize(text)
    assert error.value.message
    assert error.value.offset <= len(text)
