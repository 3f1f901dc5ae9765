"""Hostile hand-ins: read as `unreadable` with a reason and a place, quickly, with nothing run or fetched."""

from __future__ import annotations

import time
from functools import cache

import pytest

from dynsolve.answers.reading.files import read_submission
from dynsolve.answers.verdict import Submission
from dynsolve.problem import Problem, load
from dynsolve.problem.reader import find

pytestmark = pytest.mark.slow

AT_ONCE = 1.0
"""Seconds of the processor that are few on any machine."""

LIMIT = 8
"""What takes longer may take so many times the count to three million, at the speed the machine has then:
2 s where that takes a quarter of one."""


@cache
def problem() -> Problem:
    return load(find("planar-2r"))


TRIES = 6
"""How often it may be read: beside other programs a processor is slow for a moment."""


def hand_in(content: str | bytes, file: str = "answer.yaml") -> Submission:
    for _ in range(TRIES):
        started = time.process_time()
        found = read_submission(problem(), content, file)
        spent = time.process_time() - started
        if spent < AT_ONCE or spent < LIMIT * counting():
            return found
    raise AssertionError(f"it took {spent:.2f} s of the processor to read this")


def counting() -> float:
    """Seconds of the processor for counting to three million."""
    started, total = time.process_time(), 0
    for number in range(3_000_000):
        total += number
    return time.process_time() - started


VALUES = {
    "code": "__import__('os').system('touch /tmp/hacked')",
    "code in a string": "sin(\"__import__('os').system('id')\")",
    "attributes": "m1.__class__.__bases__[0].__subclasses__()",
    "lambda": "(lambda: 1)()",
    "eval": "eval('1')",
    "exec": "exec(m1)",
    "open": "open('/etc/passwd')",
    "format string": "{m1.__class__}",
    "tower of powers": "9**9**9**9**9",
    "tower in LaTeX": "9^{9^{9^{9}}}",
    "power of powers": "((m1+m2+l1+l2)^20)^20",
    "large product": "*".join(["(m1+m2+l1+l2+g)"] * 40),
    "large exponent": "m1^1000000",
    "negative tower": "m1**-99999",
    "long number": "9" * 100_000,
    "long exponent": "1e999999999",
    "long decimal": "0." + "1" * 5_000,
    "nested parentheses": "(" * 50_000 + "m1" + ")" * 50_000,
    "unclosed parentheses": "(" * 20_000,
    "closing parentheses": ")" * 20_000,
    "nested braces": "{" * 20_000 + "m1 + m2" + "}" * 20_000,
    "nested fractions": r"\frac{1}{" * 5_000 + "m1" + "}" * 5_000,
    "nested roots": r"\sqrt{" * 5_000 + "m1" + "}" * 5_000,
    "nested sines": "sin(" * 5_000 + "m1" + ")" * 5_000,
    "nested brackets": "[" * 20_000 + "m1" + "]" * 20_000,
    "nested dots": r"\dot{" * 5_000 + "q_1" + "}" * 5_000,
    "nested faces": r"\mathcal{" * 5_000 + "q_1" + "}" * 5_000,
    "nested indices": "m_{" * 5_000 + "1" + "}" * 5_000,
    "nested exponents": "m1^{" * 5_000 + "1" + "}" * 5_000,
    "signs": "-" * 50_000 + "m1",
    "roots": "√" * 20_000 + "m1",
    "quotients": "m1" + "/m1" * 15_000,
    "long name": "m" * 1_000_000,
    "long name with digits": "m1" * 300_000,
    "long name with underscores": "m_1" * 15_000,
    "open index": "m_{" + "a" * 50_000,
    "open index of words": "m_{" + "a " * 25_000,
    "blanks": " " * 500_000 + "m1*",
    "NUL": "m1\0*g",
    "bidi override": "m1*\u202eg",
    "bidi isolate": "m1*\u2066g\u2069",
    "soft hyphen": "m\u00ad1",
    "Cyrillic letter": "\u0430*m1",
    "Greek capital Alpha": "\u0391*m1",
    "combining letters": "m" + "\u0301" * 10_000,
    "combining dots": "q" + "\u0307" * 10_000 + "1",
    "lone surrogate": "m1*\ud800",
    "input": r"\input{/etc/passwd}",
    "include": r"\include{secret}",
    "write18": r"\write18{rm -rf /}",
    "immediate": r"\immediate\write18{id}",
    "openin": r"\openin5=/etc/passwd",
    "csname": r"\csname input\endcsname",
    "catcode": r"\catcode`\%=12",
    "loop": r"\loop\iftrue\repeat",
    "href": r"\href{javascript:alert(1)}{m_1}",
    "spreadsheet formula": "=cmd|' /C calc'!A0",
    "spreadsheet at": "@SUM(1+1)*cmd|' /C calc'!A0",
    "hyperlink": '=HYPERLINK("http://evil","m1")',
    "terminal escape": "m1\x1b[2J\x1b]0;owned\x07",
    "bell": "m1\x07",
    "script": "<script>alert(1)</script>",
    "image": "<img src=x onerror=alert(1)>",
    "entity": "&lt;m1&gt;",
    "tag": "!!python/object/apply:os.system ['id']",
    "object tag": "!!python/name:os.system",
    "anchor": "&a [m1, m1]",
    "alias": "*a",
    "infinity": "inf",
    "not a number": "nan",
    "float infinity": "float('inf')",
    "comparison": "m1 < m2",
    "semicolons": "m1; import os",
    "backticks": "`id`",
    "dollar": "$(id)",
    "pipe": "m1 | m2",
    "percent": "%s%s%s%n",
    "nothing but operators": "*" * 10_000,
    "commas": "," * 50_000,
    "rows": "[" + "1," * 30_000 + "1]",
    "ampersands": r"\begin{bmatrix}" + "&" * 20_000 + r"\end{bmatrix}",
    "open environment": r"\begin{bmatrix} 1 & 2",
    "unknown environment": r"\begin{verbatim} 1 \end{verbatim}",
    "open command": "\\",
    "open text": r"\text{" + "a" * 10_000,
    "primes": "q1" + "'" * 50_000,
    "powers": "m1" + "^2" * 20_000,
    "equations": "m1 =" * 15_000,
    "emoji": "m1*\U0001f600",
    "private use": "\ue000",
    "mathematical alphabet": "\U0001d4b6" * 20_000,
    "diagonal": "diag(" + "m1, " * 2_000 + "m2)",
}


@pytest.mark.parametrize("text", VALUES.values(), ids=VALUES.keys())
def test_a_hostile_value_is_unreadable_and_spoils_no_other(text: str) -> None:
    found = hand_in(f"answers:\n  K: {text}\n  P: m1*g\n")
    last = {answer.name: answer for answer in found.answers}
    assert last["P"].node is not None
    hostile = last["K"]
    assert hostile.node is None
    assert hostile.fault
    assert hostile.expected
    assert hostile.place.line >= 2
    assert hostile.place.column >= 1
    assert len(hostile.fault) < 400
    assert (hostile.fault + hostile.place.excerpt + hostile.text).isprintable()


@pytest.mark.parametrize("text", VALUES.values(), ids=VALUES.keys())
@pytest.mark.parametrize("is_first", [True, False], ids=["md", "another"])
def test_a_hostile_equation_of_a_report_spoils_no_other(text: str, is_first: bool) -> None:
    """In Markdown, and in one of the other forms in turn."""
    others = ("report.tex", "report.txt", "report.html")
    file = "report.md" if is_first else others[list(VALUES.values()).index(text) % len(others)]
    found = hand_in(f"$$K = {text}$$\n\n$$P = m_1 g$$\n", file)
    last = {answer.name: answer for answer in found.answers}
    if "P" in last:
        assert last["P"].node is not None
    if file != "report.html" and "K" in last:
        assert last["K"].node is None


READ = {
    "zero-width space": ("m1\u200b*g", "m1*g"),
    "zero-width joiner": ("m\u200d1", "m1"),
    "byte order mark": ("m1*\ufeffg", "m1*g"),
    "fullwidth letter": ("\uff4d1", "m1"),
}


@pytest.mark.parametrize(("text", "plain"), READ.values(), ids=READ.keys())
@pytest.mark.parametrize(
    ("content", "file"),
    [
        ("answers:\n  K: {}\n  P: m1*g\n", "answer.yaml"),
        *(("$$K = {}$$\n\n$$P = m_1 g$$\n", f"report.{ending}") for ending in ("md", "tex", "txt", "html")),
    ],
)
def test_what_is_not_seen_or_looks_the_same_is_read_as_what_is_seen(
    content: str, file: str, text: str, plain: str
) -> None:
    read = [(a.name, a.node) for a in hand_in(content.format(text), file).answers]
    assert read == [(a.name, a.node) for a in hand_in(content.format(plain), file).answers]
    assert [name for name, node in read if node is not None] == ["K", "P"]


FILES = {
    "empty": "",
    "blank": "\n" * 100_000,
    "alias bomb": "a: &a [x, x]\n"
    + "".join(f"{chr(98 + i)}: &{chr(98 + i)} [*{chr(97 + i)}, *{chr(97 + i)}]\n" for i in range(20)),
    "tags": "!!python/object/apply:os.system ['id']\n",
    "keys": "".join(f"k{i}: 1\n" for i in range(50_000)),
    "answers": "answers:\n" + "".join(f"  P: m1*{i}\n" for i in range(20_000)),
    "doubling": "let:\n  a0: m1 + m2\n"
    + "".join(f"  a{i + 1}: a{i}*a{i}\n" for i in range(60))
    + "answers:\n  K: a60\n",
    "doubling sums": "let:\n  a0: m1\n"
    + "".join(f"  a{i + 1}: a{i} + a{i}\n" for i in range(60))
    + "answers:\n  K: a60\n",
    "self": "let: {a: a + 1}\nanswers: {K: a}\n",
    "binary": bytes(range(256)) * 400,
    "not UTF-8": b"answers:\n  K: m1*\xff\xfe\n",
    "colons": ":" * 100_000,
    "braces": "answers: " + "{" * 100_000,
    "quotes": "answers:\n  K: " + "'" * 100_001,
    "dashes": "- " * 100_000,
    "brackets": "answers:\n  K: " + "[\n" * 20_000,
    "hashes": "#" * 200_000,
    "too large": "x" * 30_000_000,
}


@pytest.mark.parametrize("content", FILES.values(), ids=FILES.keys())
def test_a_hostile_answer_file_is_read_quickly(content: str | bytes) -> None:
    found = hand_in(content)
    assert all(answer.node is None for answer in found.answers if answer.name == "K")


REPORTS = {
    "dollars": "$" * 200_000,
    "open displays": "$$ K = m_1 " * 10_000,
    "open brackets": r"\[ K = m_1 " * 20_000,
    "open environments": r"\begin{align} K = m_1 " * 20_000,
    "open inline": "$K = m_1 " * 30_000,
    "fences": "```\n" * 50_001,
    "many equations": "$$P_1 = m_1 g$$\n" * 20_000,
    "recursive macro": r"\newcommand{\a}{\a\a}" + "\n$$K = \\a$$\n",
    "mutual macros": r"\newcommand{\a}{\b\b}\newcommand{\b}{\a\a}" + "\n$$K = \\a$$\n",
    "macro bomb": "".join(
        f"\\newcommand{{\\x{chr(97 + i)}}}{{\\x{chr(98 + i)}\\x{chr(98 + i)}}}\n" for i in range(24)
    )
    + "$$K = \\xa$$",
    "macro with arguments": r"\newcommand{\a}[1]{#1#1}" + "\n$$K = " + r"\a{" * 30 + "m_1" + "}" * 30 + "$$",
    "many macros": "".join(r"\newcommand{\a}{m_1}" for _ in range(20_000)) + "\n$$K=\\b$$",
    "open macro": r"\newcommand{\a}{" * 10_000,
    "definitions": "$$h_0 = m_1$$\n"
    + "".join(f"$$x_{{{i + 1}}} = x_{{{i}}} x_{{{i}}}$$\n" for i in range(100))
    + "$$K = x_{100}$$",
    "lines": "K = \n" * 50_000,
    "formulas in a row": r"| \( a " * 9_000 + "|",
    "rows": "| P1 | m1 |\n" * 5_000,
    "columns": "g =\n\n a\n b\n\n" * 300,
    "nested cases": "$$g = " + r"\begin{cases}" * 2_000 + "m_1" + r"\end{cases}" * 2_000 + "$$",
    "nested lists": "g := " + "<" * 5_000 + "m1" + ">" * 5_000,
    "said to be": "h is $m_1$ " * 4_000,
    "open lines": "K = (\n" * 20_000,
    "percent signs": "%" * 300_000,
    "equations in a row": "$K=1$ " * 300_000,
    "equations below one another": "$K=1$\n" * 200_000,
    "brackets in a row": r"\(K=1\) " * 200_000,
}


@pytest.mark.parametrize("file", ["report.md", "report.tex", "report.txt", "report.html", "report.ipynb"])
@pytest.mark.parametrize("content", REPORTS.values(), ids=REPORTS.keys())
def test_a_hostile_report_is_read_quickly(content: str, file: str) -> None:
    found = hand_in(content, file)
    assert len(found.answers) <= 2_000


NOTEBOOKS = {
    "lines that are written otherwise in the file": '{"cells": [{"cell_type": "markdown", "source": "'
    + r"\u00E9\/ x\n" * 150_000
    + '"}]}',
    "nested": "[" * 100_000,
    "no cells": "{}",
    "cells of another kind": '{"cells": [1, null, {"cell_type": "markdown", "source": 5}, '
    '{"cell_type": "code", "source": "$$K=1$$"}]}',
    "a number": "1" * 100_000,
}


@pytest.mark.parametrize("content", NOTEBOOKS.values(), ids=NOTEBOOKS.keys())
def test_a_hostile_notebook_is_read_quickly(content: str) -> None:
    assert hand_in(content, "report.ipynb").answers == ()


@pytest.mark.parametrize(
    "content",
    [
        "<" * 100_000,
        "<div>" * 50_000,
        "<script>" * 20_000,
        "&" * 100_000,
        "<!--" * 20_000,
        "</p>" * 50_000,
        "<a " + "b=" * 50_000,
        "<a" * 500_000,
        "<a " * 500_000,
        "<a b=" * 300_000,
        '<a b="' * 300_000,
        "</a" * 500_000,
        "<!" * 500_000,
        "<![" * 500_000,
        "<?" * 500_000,
        "&#x" * 500_000,
        "<a" * 500_000 + ">",
        "<a b='c" * 200_000 + ">",
    ],
)
def test_a_hostile_page_is_read_quickly(content: str) -> None:
    assert hand_in(content, "report.html").answers == ()
