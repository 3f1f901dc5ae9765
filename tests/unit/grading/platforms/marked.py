"""Students with their marks in a record, and the files that the platforms import made of them."""

from __future__ import annotations

from fractions import Fraction
from pathlib import Path

from dynsolve.grading.hand_ins import Intake
from dynsolve.grading.platforms.registry import chosen_roster, export, keep_platform
from dynsolve.grading.record import Record
from dynsolve.grading.set_file import ProblemSet
from tests.support import ROOT

TEXT = (ROOT / "problems" / "in3140-rp.yaml").read_text(encoding="utf-8")
MARKS = {"K": Fraction(4), "g": Fraction(2)}
BLANK = dict.fromkeys(("label", "message", "read_as", "note", "loss", "form", "basis", "fault"), "")


def graded(record: Record, students: dict[str, tuple[str, str, str]]) -> None:
    """Students by name, each with the platform's id and the marks for K and g."""
    intake = Intake({name: id for name, (id, *_) in students.items()}, (), ())
    record.set_intake(intake.students, intake.waiting)
    for name, (_, *marks) in students.items():
        answers = [
            {
                **BLANK, "name": answer, "verdict": "correct" if given == str(of) else "wrong",
                "marks": given, "of": str(of), "line": 1, "diagnosis": [], "why": f"{given} of {of}",
            }
            for (answer, of), given in zip(MARKS.items(), marks, strict=True)
        ]  # fmt: skip
        row = {"answers": answers, "files": [], "left": [], "late": False, "reason": "", "notes": []}
        record.write((name, "in3140-rp"), "", "{}", {**row, "html": "", "markdown": ""})


def exported(
    tmp_path: Path, problems: ProblemSet, record: Record, platform: str, text: str | bytes = ""
) -> tuple[str, ...]:
    """Write what `platform` imports from the CSV that it gave; the warnings."""
    path = tmp_path / "roster.csv"
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    keep_platform(record, platform, chosen_roster(problems, platform, path))
    return tuple(line.replace(str(path), path.name) for line in export(tmp_path, problems, record))


STUDENTS = {
    "lovelaceada_101": ("101", "4", "2"),
    "babbagecharles_102": ("102", "0", "5/2"),
    "hoppergrace_103": ("103", "4", "2"),
}


ENGLISH = (
    "Identifier,Full name,Email address,Status,Grade,Maximum Grade,Grade can be changed,"
    "Last modified (submission),Last modified (grade),Feedback comments"
)


_FORMATS = {"enum": ["text", "html", "simple_format", "md", "ansi"]}
_SEEN = {"enum": ["hidden", "after_due_date", "after_published", "visible"]}
RESULTS = {
    "type": "object",
    "required": ["score"],
    "additionalProperties": False,
    "properties": {
        "score": {"type": "number"},
        "execution_time": {"type": "number"},
        "output": {"type": "string"},
        "output_format": _FORMATS,
        "test_output_format": _FORMATS,
        "test_name_format": _FORMATS,
        "visibility": _SEEN,
        "stdout_visibility": _SEEN,
        "extra_data": {"type": "object"},
        "leaderboard": {"type": "array"},
        "tests": {
            "type": "array",
            "items": {
                "type": "object",
                "additionalProperties": False,
                "properties": {
                    "score": {"type": "number"},
                    "max_score": {"type": "number"},
                    "status": {"enum": ["passed", "failed"]},
                    "name": {"type": "string"},
                    "name_format": _FORMATS,
                    "number": {"type": "string"},
                    "output": {"type": "string"},
                    "output_format": _FORMATS,
                    "tags": {"type": "array", "items": {"type": "string"}},
                    "visibility": _SEEN,
                    "extra_data": {"type": "object"},
                },
            },
        },
    },
}
"""The documented fields, and no others."""
