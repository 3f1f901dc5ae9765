"""Assignments, `L1=0.4`, as they are written on a command line or in a Python call, with their places."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from fractions import Fraction

from dynsolve.errors import Finding, InputError

Plain = int | float | Fraction | str
"""What a Python user may give as a value: a float stands for the decimal it is printed as."""


@dataclass(frozen=True, slots=True)
class Assignment:
    """`name=value` as it was written, and where: `file` with the line and the columns of both parts."""

    name: str
    value: str
    file: str = ""
    excerpt: str = ""
    line: int = 0
    name_column: int = 0
    value_column: int = 0

    def at_name(self, message: str, help: str = "", offset: int = 0, length: int = 0) -> Finding:
        """A finding at the name."""
        column = self.name_column + offset if self.name_column else 0
        return Finding(message, help, self.file, self.line, column, length or len(self.name), self.excerpt)

    def at_value(self, message: str, help: str = "", offset: int = 0, length: int = 0) -> Finding:
        """A finding at the value, or at a part of it."""
        column = self.value_column + offset if self.value_column else 0
        return Finding(message, help, self.file, self.line, column, length or len(self.value), self.excerpt)


def of_option(option: str, texts: Iterable[str]) -> Iterator[Assignment]:
    """The assignments of an option's values: `theta1=30deg,L2=0.2`.

    Raises InputError for a part that is none.
    """
    for text in texts:
        start = 0
        for part in text.split(","):
            name, equals, value = part.partition("=")
            lead = start + len(part) - len(part.lstrip())
            if not equals or not name.strip() or not value.strip():
                if part.strip() or text.count(",") == 0:
                    message = f"`{part.strip()}` is no assignment" if part.strip() else "nothing is assigned"
                    finding = Finding(
                        message, "write name=value: L1=0.4, theta1=30deg",
                        option, 0, lead + 1, max(len(part.strip()), 1), text,
                    )  # fmt: skip
                    raise InputError([finding])
            else:
                at = start + len(name) + 1 + len(value) - len(value.lstrip())
                yield Assignment(name.strip(), value.strip(), option, text, 0, lead + 1, at + 1)
            start += len(part) + 1


def of_call(values: Mapping[str, Plain]) -> Iterator[Assignment]:
    """The assignments of a Python call."""
    for name, value in values.items():
        text = value if isinstance(value, str) else str(value)
        yield Assignment(name, text.strip(), f"{name}={text.strip()}")
