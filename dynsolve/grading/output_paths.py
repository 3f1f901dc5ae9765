"""Where the files of a run lie in OUT, and what is taken away there."""

from __future__ import annotations

import re
from hashlib import sha256
from pathlib import Path

from dynsolve.render.files import temporary_of, write_changed


def write(path: Path, text: str, *, durable: bool = True) -> None:
    """A text whole or not at all, and only where something changes."""
    write_changed(path, text.encode("utf-8", errors="replace"), durable=durable)


def folder_name(student: str) -> str:
    """The name of a student's folder: safe on every system, and of no two students the same.

    >>> folder_name("s123456"), folder_name("Ada Lovelace_12")
    ('s123456', 'Ada Lovelace_12')
    """
    plain = re.sub(r"[^\w .@+-]|^\.+|[. ]+$", "_", student)[:80]
    reserved = re.fullmatch(r"(?i)(con|prn|aux|nul|com\d|lpt\d)(\..*)?", plain)
    if plain == student and plain and not reserved:
        return plain
    return f"{plain or '_'}-{sha256(student.encode('utf-8', errors='replace')).hexdigest()[:8]}"


def remove_others(folder: Path, kept: set[Path], endings: tuple[str, ...]) -> None:
    """Remove what earlier runs wrote for students who are there no more, and what a killed one left."""
    own = (*endings, temporary_of(folder).suffix)
    for path in sorted(folder.glob("*/*")):
        if path not in kept and path.suffix in own:
            path.unlink()
    for place in sorted(folder.glob("*/")):
        if place.is_dir() and not any(place.iterdir()):
            place.rmdir()
