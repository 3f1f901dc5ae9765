"""How long a printed result is: its operations."""

from __future__ import annotations

import ast
from typing import Any


def operations(entries: Any, inside_functions: bool = True) -> int:
    """Every `+ - * /`, power, sign and function call of the text, over all entries.

    Without `inside_functions`, as one counts the terms of a book: `+ - * /` and
    powers, and neither functions nor what stands in them.

    >>> operations("-m1*l1**2*cos(q1 + q2)/2"), operations("-m1*l1**2*cos(q1 + q2)/2", inside_functions=False)
    (7, 5)
    """
    if not isinstance(entries, str):
        return sum(operations(entry, inside_functions) for entry in entries)
    return _count(ast.parse(entries, mode="eval").body, inside_functions)


def _count(root: ast.AST, inside_functions: bool) -> int:
    count, stack = 0, [root]
    while stack:
        node = stack.pop()
        if isinstance(node, ast.Call):
            count += inside_functions
            stack += node.args if inside_functions else []
            continue
        count += isinstance(node, ast.BinOp | ast.UnaryOp)
        stack += ast.iter_child_nodes(node)
    return count
