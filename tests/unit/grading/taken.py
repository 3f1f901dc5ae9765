"""Hand-ins taken in from files."""

from __future__ import annotations

from pathlib import Path

from dynsolve.grading.hand_ins import Intake, take_in
from dynsolve.grading.set_file import ProblemSet
from dynsolve.grading.uploads import Uploads

ANSWER = "answers:\n  K: m1*g\n"


def taken_in(problems: ProblemSet, folder: Path, files: dict[str, str]) -> Intake:
    """What is taken in of a folder with these files."""
    for name, content in files.items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(content)
    return take_in(problems, Uploads(folder))
