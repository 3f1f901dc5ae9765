r"""`\begin` and `\end`: those that only align are left out, with the arguments that are no formula."""

from __future__ import annotations

from dynsolve.answers.reading.tokens.groups import taken_group
from dynsolve.answers.reading.tokens.lexer import Token

_ENVIRONMENTS = frozenset(
    "equation align aligned split gather gathered multline multlined eqnarray "
    "alignat alignedat flalign xalignat displaymath math subequations dmath dgroup darray empheq "
    "IEEEeqnarray IEEEeqnarraybox lgathered rgathered".split()
)
"""Environments that only align."""
_SYSTEMS = frozenset({"cases", "dcases", "rcases", "drcases"})
"""Environments with a brace at their side: around equations, or around the entries of a column."""
_WITH_COLUMNS = ("array", "alignat", "alignedat", "xalignat", "IEEEeqnarray", "empheq")
"""Environments whose name is followed by an argument that is no formula."""


def simplify_environment(
    token: Token, tokens: list[Token], position: int, out: list[Token], systems: list[list[int]]
) -> int:
    r"""`\begin` or `\end`, left out where the environment only aligns; gives where to go on.

    `systems` are where the `cases` that are open begin, with 1 where they hold equations; a column
    holds none.
    """
    name = token.text.rstrip("*")
    if name in _SYSTEMS and token.kind == "begin":
        systems.append([len(out), 0])
    elif name in _SYSTEMS and systems:
        start, holds_equations = systems.pop()
        if systems:
            systems[-1][1] |= holds_equations
        if start and not holds_equations:
            out.insert(start, token._replace(kind="begin", text="matrix"))
            out.append(token._replace(text="matrix"))
    elif name not in _ENVIRONMENTS:
        out.append(token)
    return _skip_arguments(tokens, position, name) if token.kind == "begin" else position


def _skip_arguments(tokens: list[Token], position: int, environment: str) -> int:
    r"""Behind the `[t]` of `\begin{aligned}[t]`, the `[1.3]` of a matrix, the `{cc}` of an array."""
    option = tokens[position : position + 3]
    if [t.kind for t in option] == ["[", "name", "]"] and option[1].text in ("t", "b", "c"):
        position += 3
    elif option[0].kind == "[" and environment == "empheq":
        while tokens[position].kind not in ("]", "end"):
            position += 1
        position += tokens[position].kind == "]"
    elif (
        [t.kind for t in option] == ["[", "number", "]"] and "matrix" in environment and not option[0].spaced
    ):
        position += 3
    if environment.startswith(_WITH_COLUMNS) and tokens[position].kind == "{":
        _, position = taken_group(tokens, position)
    return position
