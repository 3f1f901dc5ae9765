"""Remarks of a problem's author on results: `remarks: {Kv2: "The squares add up."}`, plain words."""

from __future__ import annotations

from dataclasses import dataclass

from dynsolve.problem.answer_names import answer_meant
from dynsolve.problem.fields import describe
from dynsolve.problem.source import Faults
from dynsolve.problem.specification import PROBLEM
from dynsolve.problem.yaml_nodes import FaultyNode, ListNode, MappingNode, ScalarNode, YamlNode
from dynsolve.quantities.index import Quantities

_HELP = PROBLEM["remarks"].help


@dataclass(frozen=True, slots=True)
class Remark:
    """What an author says of a result: its name, as an answer and as the file has it, and the words."""

    name: str
    key: str
    texts: tuple[str, ...]


def read_remarks(faults: Faults, node: YamlNode | None, names: Quantities | None) -> tuple[Remark, ...]:
    """The remarks of a file; `names` are None where the robot is faulty, and nothing is known of answers."""
    if node is None or isinstance(node, FaultyNode):
        return ()
    if not isinstance(node, MappingNode):
        faults.error(node.span, f"remarks is a mapping, not {describe(node)}", _HELP)
        return ()
    found: dict[str, Remark] = {}
    for key, value in node.entries:
        texts = _texts(faults, value, key.decoded)
        name = key.decoded if names is None else names.canonical(key.decoded)
        if name is None:
            meant = answer_meant(names, key.decoded) if names else ""
            message = f"`{key.decoded[:40]}` is no result of this problem"
            faults.error(key.span, message, meant or "results are P1, Kv1, K, L, tau1, D, d11, ...")
        elif name in found:
            faults.error(key.span, f"{name} has a remark already", "write both as a list of lines")
        elif texts:
            found[name] = Remark(name, key.decoded, texts)
    return tuple(found.values())


def _texts(faults: Faults, node: YamlNode, of: str) -> tuple[str, ...]:
    """The lines of text of a remark."""
    lines = node.items if isinstance(node, ListNode) else (node,)
    for line in lines:
        if not isinstance(line, FaultyNode) and not (isinstance(line, ScalarNode) and line.decoded.strip()):
            faults.error(line.span, f"the remark on {of} is words, not {describe(line)}", _HELP)
    return tuple(" ".join(line.decoded.split()) for line in lines if isinstance(line, ScalarNode))
