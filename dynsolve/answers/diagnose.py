"""Naming the slip in an answer that is wrong."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from dynsolve.algebra.expr import Expr
from dynsolve.answers.compare import Written
from dynsolve.answers.dimensions import Dimensions
from dynsolve.answers.evaluate import as_expr
from dynsolve.answers.follow import Follow
from dynsolve.answers.graph import Graph
from dynsolve.answers.verdict import Diagnosis
from dynsolve.notation.tree import Node
from dynsolve.problem.model import Problem


@dataclass(frozen=True, slots=True)
class Question:
    """One scalar that is wrong: what was written, what its own inputs lead to, and the key."""

    name: str
    target: Any
    written: Written
    expected: Expr
    key: Expr
    row: int = 0
    column: int = 0

    @property
    def mine(self) -> Expr | None:
        """The answer as an element of the ring."""
        return as_expr(self.written.value)


class Diagnoser:
    """Names slips, the simplest that explains an answer."""

    def __init__(self, problem: Problem, graph: Graph, follow: Follow, dimensions: Dimensions) -> None:
        self.problem = problem
        self.graph = graph
        self.follow = follow
        self.dimensions = dimensions

    def __call__(self, question: Question) -> tuple[Diagnosis, ...]:
        """The slips in one scalar."""
        return ()

    def whole(self, question: Question, held: Any, found: tuple[Diagnosis, ...]) -> tuple[Diagnosis, ...]:
        """The slips of a matrix, given those of its entries."""
        return found

    def difference(self, question: Question) -> Node | None:
        """The answer minus what was expected, in compact form."""
        return None
