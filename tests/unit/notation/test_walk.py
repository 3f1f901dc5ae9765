"""`children`, `walk`, `with_children` and `mapped`, held against what every class of nodes declares."""

from __future__ import annotations

import inspect

import pytest
from hypothesis import given

from dynsolve.notation import tree
from dynsolve.notation.tree import Node, Power, Product, Sum, Symbol, children, mapped, walk, with_children
from tests.unit.notation.trees import ONE_OF_EACH, TWO, A, B, C, trees


def test_there_is_a_case_for_every_class_of_the_tree() -> None:
    declared = {kind for kind in vars(tree).values() if isinstance(kind, type) and issubclass(kind, Node)}
    assert declared - {Node} == {type(node) for node, _ in ONE_OF_EACH}


@pytest.mark.parametrize(("node", "parts"), ONE_OF_EACH, ids=lambda case: type(case).__name__)
def test_children(node: Node, parts: tuple[Node, ...]) -> None:
    assert children(node) == parts


@pytest.mark.parametrize(("node", "parts"), ONE_OF_EACH, ids=lambda case: type(case).__name__)
def test_with_children(node: Node, parts: tuple[Node, ...]) -> None:
    assert with_children(node, lambda part: part) is node
    others = with_children(node, lambda part: tree.Parenthesized(part))
    assert type(others) is type(node)
    assert children(others) == tuple(map(tree.Parenthesized, parts))
    annotations = inspect.get_annotations(type(node))
    for name in node.__struct_fields__:
        if "Node" not in annotations[name]:
            assert getattr(others, name) == getattr(node, name)


def test_walk_visits_every_class_of_nodes() -> None:
    whole = tree.Row(tuple(node for node, _ in ONE_OF_EACH))
    visited = list(walk(whole))
    assert {type(node) for node in visited} == {type(node) for node, _ in ONE_OF_EACH}
    assert len(visited) == 1 + sum(1 + len(parts) for _, parts in ONE_OF_EACH)


def test_walk_goes_from_left_to_right_and_from_the_whole_to_its_parts() -> None:
    product = Product((B, C))
    whole = Sum((A, product, TWO))
    assert list(walk(whole, A)) == [whole, A, product, B, C, TWO, A]


@given(trees)
def test_mapping_by_the_identity_gives_the_same_object(node: Node) -> None:
    assert mapped(node, lambda part: part) is node


@given(trees)
def test_mapping_changes_what_walking_finds(node: Node) -> None:
    changed = mapped(node, lambda part: Symbol("x") if isinstance(part, Symbol) else part)
    assert [type(part) for part in walk(changed)] == [type(part) for part in walk(node)]
    assert {part.name for part in walk(changed) if isinstance(part, Symbol)} <= {"x"}


def test_mapping_keeps_and_shares_what_does_not_change() -> None:
    kept, shared = Power(B, TWO), Product((A, C))
    calls: list[Node] = []

    def renamed(node: Node) -> Node:
        calls.append(node)
        return B if node is A else node

    changed = mapped(Sum((kept, shared, shared)), renamed)
    assert isinstance(changed, Sum)
    assert changed.terms[0] is kept
    assert changed.terms[1] == Product((B, C))
    assert changed.terms[1] is changed.terms[2]
    assert calls.count(A) == 1


def test_mapping_goes_from_the_leaves_upwards() -> None:
    met: list[str] = []
    mapped(tree.Negative(Power(A, TWO)), lambda node: (met.append(type(node).__name__), node)[1])
    assert met == ["Symbol", "Number", "Power", "Negative"]
