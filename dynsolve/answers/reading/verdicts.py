"""Answers that are verdicts on matrices.

    definite: {Ma: "no", Mb: yes, Mc: if}
    definite: yes                              # where there is one matrix

YAML's `no` and `yes` are the words that they look like.
"""

from __future__ import annotations

from collections.abc import Iterator

from dynsolve.answers.reading import yaml_values
from dynsolve.answers.reading.equation_reader import EquationReader
from dynsolve.answers.reading.yaml_values import NotYaml, YamlNode
from dynsolve.answers.submission import Place, VerdictAnswer
from dynsolve.errors import ReadError

_WORDS = {
    "yes": ("yes", "y", "true", "ja", "possible", "can be", "definite", "positive definite"),
    "no": ("no", "n", "false", "nei", "nein", "impossible", "cannot be", "not", "not positive definite"),
    "if": ("if", "sometimes", "conditional", "conditionally", "depends", "under conditions"),
}
_MEANINGS = {word: meaning for meaning, words in _WORDS.items() for word in words}
_EXPECTED = 'write yes, no or if, of several matrices by their names: {Ma: "no", Mb: "yes"}'


def read_verdicts(reader: EquationReader, name: str, place: Place, text: str, node: YamlNode | None) -> None:
    """Read yes, no or if of each matrix; what cannot be read makes the answer unreadable, with its reason."""
    written = text.strip() if node is None else text[node.start : node.end].strip()
    try:
        root = _parsed(text) if node is None else node
        found = VerdictAnswer(name, place, written, tuple(_words(text, root)))
    except ReadError as error:
        found = VerdictAnswer(name, place, written, fault=error.message, expected=error.help)
    reader.found.verdicts.append(found)


def _parsed(text: str) -> YamlNode:
    """A value that stands in a file that YAML refuses, read by itself."""
    try:
        (root,) = yaml_values.documents(text)
    except (NotYaml, ValueError):
        raise ReadError("this is no verdict", 0, 1, _EXPECTED) from None
    return root


def _words(text: str, root: YamlNode) -> Iterator[tuple[str, str]]:
    """(name of the matrix, or nothing, and yes, no or if)"""
    pairs = list(root.entries())
    if not pairs:
        yield "", _meaning(yaml_values.word(text, root))
    for key, value in pairs:
        yield yaml_values.word(text, key), _meaning(yaml_values.word(text, value))


def _meaning(word: str) -> str:
    plain = word.strip().strip("\"'.").lower()
    if plain not in _MEANINGS:
        raise ReadError(f"`{word[:40]}` is neither yes nor no", 0, 1, _EXPECTED)
    return _MEANINGS[plain]
