"""Rules, and the evaluator of a graph of them.

A rule computes one quantity from others: `Rule("K1", ("Kv1", "Kw1"), lambda v, w: v + w)`.
The rules of the textbook are in `dynsolve.derivation.rules`; this module
evaluates the rules of any graph.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from typing import Any

from msgspec import Struct


class Rule(Struct, frozen=True):
    """name = compute(*inputs): `inputs` names quantities, `compute` is a pure function of their values."""

    name: str
    inputs: tuple[str, ...]
    compute: Callable[..., Any]


class Skipped(Struct, frozen=True):
    """What stands for a value whose work goes over a bound, and why.

    `value` is there where it is known, and only too long to be read: answers are compared with it.  So they
    are with `one` of many solutions, none of which is shown.
    """

    why: str
    value: Any = None
    one: Any = None


def known(value: Any) -> Any:
    """A value, though it is too long to be read."""
    return value.value if isinstance(value, Skipped) and value.value is not None else value


class Derivation(Mapping[str, Any]):
    """The values of a graph of rules by name, each computed when it is first asked for.

    Of two rules with one name the later counts.  A value that is `given` stands for its
    rule, and what depends on it follows from it.

    >>> derivation = Derivation([Rule("a", (), lambda: 2), Rule("b", ("a",), lambda a: a + 1)])
    >>> derivation["b"], Derivation(derivation.rules.values(), {"a": 5})["b"]
    (3, 6)
    """

    def __init__(self, rules: Iterable[Rule], given: Mapping[str, Any] | None = None) -> None:
        self.rules: dict[str, Rule] = {rule.name: rule for rule in rules}
        self._values: dict[str, Any] = dict(given or {})

    def __getitem__(self, name: str) -> Any:
        if name not in self._values:
            rule = self.rules[name]
            self._values[name] = rule.compute(*(self[i] for i in rule.inputs))
        return self._values[name]

    def leading_to(self, names: Iterable[str]) -> frozenset[str]:
        """These quantities, and all that they are computed from.

        >>> rules = [Rule("a", (), int), Rule("b", ("a",), int), Rule("c", ("a",), int)]
        >>> sorted(Derivation(rules).leading_to(["b"]))
        ['a', 'b']
        """
        found: set[str] = set()
        waiting = [name for name in names if name in self.rules]
        while waiting:
            name = waiting.pop()
            if name not in found:
                found.add(name)
                waiting += self.rules[name].inputs
        return frozenset(found)

    def __iter__(self) -> Iterator[str]:
        return iter(self.rules)

    def __len__(self) -> int:
        return len(self.rules)
