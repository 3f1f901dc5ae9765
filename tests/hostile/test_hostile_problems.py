"""What a file may contain to do harm: it is refused in a moment, with a place, and nothing of it runs."""

from __future__ import annotations

import random
import time

import pytest

from dynsolve.errors import DynsolveError, ProblemError
from dynsolve.problem import load, read_problem
from tests.unit.problem.marked import PLANAR, errors, places, unmarked

SECONDS = 5.0
"""A generous bound, against what would take minutes; no measure of speed."""

LAUGHS = "a: &a [x, x, x, x, x, x, x, x, x]\n" + "".join(
    f"{new}: &{new} [{', '.join([f'*{old}'] * 9)}]\n" for old, new in zip("abcdefgh", "bcdefghi", strict=True)
)

REFUSED = {
    "an alias bomb": (LAUGHS, "anchor"),
    "10 MB": ("title: " + "x" * 10_000_000, "larger than 200 kB"),
    "open brackets": ("[" * 90_000, "levels of nesting"),
    "closed brackets": ("dh: " + "[" * 900 + "]" * 900, "levels of nesting"),
    "open braces": ("{a: " * 40_000, "levels of nesting"),
    "nested dashes": ("- " * 90_000, "levels of nesting"),
    "nested question marks": ("? " * 90_000, "levels of nesting"),
    "deep indentation": ("\n".join(" " * depth + "a:" for depth in range(500)), "levels of nesting"),
    "a long list": ("dh: [" + "1," * 90_000 + "]", "parts"),
    "an endless quote": ("title: '" + "\\" * 190_000, "never closed"),
    "an endless tag": ("!" * 190_000, "tag"),
    "an endless anchor": ("&" * 190_000, "cannot begin"),
    "python objects": ("title: !!python/object/apply:os.system [echo]\n" + PLANAR, "tag"),
    "a binary tag": ("title: !!binary aGVsbG8=\n" + PLANAR, "tag"),
    "a second document": (PLANAR + "---\ntitle: another\n", "second document"),
    "nested parentheses": (PLANAR + f"masses: [{{mass: {'(' * 500}m{')' * 500}, link: 1}}]", "levels of"),
    "a tower of powers": (PLANAR + "masses: [{mass: 9**9**9, link: 1}]", "exponent"),
    "a large power": (PLANAR + "masses: [{mass: (a+b+c+d)^20*(e+f+h+k)^20, link: 1}]", "too large"),
    "a long number": (PLANAR + f"masses: [{{mass: {'9' * 5000}, link: 1}}]", "digits"),
    "a large exponent": (PLANAR + "masses: [{mass: 1e999999999, link: 1}]", "digits"),
    "a long formula": (PLANAR + f"masses: [{{mass: {'m+' * 20_000}m, link: 1}}]", "characters"),
    "too many symbols": (
        PLANAR + f"masses: [{{mass: {'+'.join(f'm{i}' for i in range(600))}, link: 1}}]",
        "one symbol too many",
    ),
    "too many denominators": (
        PLANAR + f"masses: [{{mass: {'+'.join(f'1/(m+{i})' for i in range(70))}, link: 1}}]",
        "different denominators",
    ),
    "too many angles": (
        PLANAR + f"masses: [{{mass: {'+'.join(f'cos({i}deg/7)' for i in range(320))}, link: 1}}]",
        "different sines and cosines",
    ),
    "too many roots": (
        PLANAR + f"masses: [{{mass: {'+'.join(f'sqrt(m+{i})' for i in range(70))}, link: 1}}]",
        "different roots",
    ),
    "an import": (PLANAR + "masses: [{mass: __import__('os'), link: 1}]", "has no meaning"),
    "an attribute": (PLANAR + "masses: [{mass: m.__class__, link: 1}]", "has no meaning"),
    "too many rows": ("dh:\n" + "  - {theta: q1*, a: l}\n" * 31, "at most 30"),
    "too many bodies": (PLANAR + "masses:\n" + "  - {mass: m, link: 1}\n" * 101, "at most 100"),
    "too many rotations": ("base: " + "Rz(1deg) " * 20 + "\n" + PLANAR, "more than 12 rotations"),
    "a merge": ("<<: {title: x}\n" + PLANAR, "unknown key `<<`"),
    "thousands of faults": ("".join(f"k{i}: 1\n" for i in range(5000)) + PLANAR, "more"),
}


@pytest.mark.parametrize("name", REFUSED)
def test_a_hostile_text_is_refused_in_a_moment(name: str) -> None:
    text, message = REFUSED[name]
    start = time.process_time()
    found = errors(text)
    assert time.process_time() - start < SECONDS
    assert any(message in finding.message for finding in found), [finding.message for finding in found][:5]
    assert len(found) <= 101


UNSEEN = {
    "NUL": "title: a«\0»b\n",
    "an escape": "title: a«\x1b»[31m\n",
    "a bidirectional override": "title: a«\u202e»b\n",
    "one in a comment": "title: a # «\u2066»b\n",
    "a byte order mark inside": "title: a«\ufeff»b\n",
    "an invisible line end": "title: a«\u2028»b\n",
    "a lone surrogate": "title: a«\ud800»b\n",
}


@pytest.mark.parametrize("name", UNSEEN)
def test_a_character_that_cannot_be_seen_is_shown(name: str) -> None:
    text, expected = unmarked(UNSEEN[name] + PLANAR)
    found = errors(text)
    assert places(found) == expected
    assert "cannot be seen: U+" in found[0].message
    assert "\N{REPLACEMENT CHARACTER}" in found[0].excerpt


def test_bytes_that_are_not_utf_8_have_a_place() -> None:
    with pytest.raises(ProblemError, match="0xfc is not UTF-8") as caught:
        read_problem("source: Übung\n".encode() + b"title: \xfcbung\n")
    finding = caught.value.findings[0]
    assert (finding.line, finding.column) == (2, 8)


def test_utf_16_is_named() -> None:
    with pytest.raises(ProblemError, match="UTF-16"):
        read_problem(PLANAR.encode("utf-16"))


def test_a_byte_order_mark_and_windows_line_ends_do_no_harm() -> None:
    problem = read_problem(b"\xef\xbb\xbf" + PLANAR.replace("\n", "\r\n").encode())
    assert problem.robot.n == 2
    text = PLANAR.replace("\n", "\r\n") + "masses:\r\n  - {mass: m1 g, link: 1}\r\n"
    assert places(errors(text)) == [(6, 14, 1)]


def test_a_file_that_cannot_be_read(tmp_path) -> None:
    for path in (tmp_path / "nothing.yaml", tmp_path, "a\0b"):
        with pytest.raises(ProblemError):
            load(path)


def test_an_endless_file_is_not_read_to_its_end() -> None:
    with pytest.raises(ProblemError, match="larger than"):
        load("/dev/zero")


WHOLE = """
title: Everything
convention: standard
gravity: [0, 0, -g]
base: {rotate: Rz(90deg) Rx(90deg), move: [0, 0, h]}
dh:
  - {theta: theta1* + 90deg, d: L1, a: 0, alpha: 90deg}
  - {theta: 0, d: L2*, a: 0, alpha: 0}
masses:
  - {mass: m1, link: 1, center: midpoint, inertia: {zz: I1zz}, axes: {base: Rz(theta1)}}
  - {mass: m2, link: 2, shape: {cylinder: {radius: r, length: l}}, center: [0, 0, -lc2]}
values: {L1: 0.4, m1: 2, g: 9.81}
units: {L1: m}
marks: {P: 2, K: 4, tau: 6}
find: [tau, D]
"""
ALPHABET = "{}[]()*&!|>'\"%@`#,:-? \n\tabθ°1290.+^/_\\~<=$;\u0430\u200b\u202e\x00"


def damaged(seed: int) -> str:
    draw, text = random.Random(seed), WHOLE
    for _ in range(draw.randint(1, 6)):
        at = draw.randrange(len(text))
        end = at + draw.choice((0, 1, 1, 2, 10))
        text = text[:at] + "".join(draw.choices(ALPHABET, k=draw.randint(0, 3))) + text[end:]
    return text


@pytest.mark.parametrize("first", range(0, 400, 50))
def test_a_damaged_file_is_read_or_refused_and_nothing_else(first: int) -> None:
    for seed in range(first, first + 50):
        is_read_or_refused(damaged(seed))


def is_read_or_refused(text: str) -> None:
    try:
        read_problem(text, "damaged.yaml")
    except DynsolveError as error:
        assert isinstance(error, ProblemError), text
        for finding in error.findings:
            assert finding.message
            if finding.line:
                assert finding.column >= 1
                assert finding.line <= text.count("\n") + text.count("\r") + 2
