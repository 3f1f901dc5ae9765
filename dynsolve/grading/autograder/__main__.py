"""`python -m dynsolve.grading.autograder ROOT`: judges ROOT/submission, writes ROOT/results/results.json.

The submission is graded as if it stood alone in an export of Gradescope; what Gradescope says of it in
`submission_metadata.json` tells who handed it in and how late.  Whatever happens there is a result, which
the student reads: without one, Gradescope says only that the autograder failed.
"""

from __future__ import annotations

import json
import shutil
import sys
import tempfile
import traceback
from contextlib import suppress
from datetime import datetime, timedelta
from pathlib import Path
from typing import Any

from dynsolve.grading.autograder import COURSE
from dynsolve.grading.public import grade

SUBMISSION = "submission_1"
FAILED = "The program failed on this submission, which is no fault of yours: tell your teacher."
UNJUDGED = "Nothing was judged yet; the 0 is no mark. Your teacher reads it:"

Data = dict[str, Any]


def main(root: Path) -> None:
    """Write the results of the submission."""
    try:
        results = judged(root)
    except Exception:  # noqa: BLE001  # the student reads that it is not the student's fault
        traceback.print_exc()
        results = _without_marks(FAILED)
    (root / "results").mkdir(exist_ok=True)
    (root / "results" / "results.json").write_text(json.dumps(results, indent=1, ensure_ascii=False) + "\n")


def judged(root: Path) -> Data:
    """The results of the submission in `root`, as `results.json` has them."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        export, out = folder / "assignment_1_export", folder / "out"
        shutil.copytree(root / "submission", export / SUBMISSION)
        said = _metadata(root / "submission_metadata.json")
        (export / "submission_metadata.yml").write_text(_submitters(said), encoding="utf-8")
        (folder / "lateness.csv").write_text(f"Submission ID,Lateness (H:M:S)\n1,{lateness(said)}\n")
        grades = grade(
            root / "source" / COURSE, export, out, lms="gradescope", roster=folder / "lateness.csv", jobs=1
        )
        written = out / "gradescope" / SUBMISSION / "results.json"
        if written.is_file():
            results: Data = json.loads(written.read_text(encoding="utf-8"))
            return results
        why = (f"- {entry.what.rpartition(f'{SUBMISSION}/')[2]}: {entry.why}" for entry in grades.queue)
        waits = dict.fromkeys(why) or ["- nothing was handed in"]
        return _without_marks("\n".join([UNJUDGED, *waits]))


def _without_marks(output: str) -> Data:
    said = {"output": output, "output_format": "text", "stdout_visibility": "hidden"}
    return {"score": 0.0, **said, "tests": []}


# -- what Gradescope says of the submission --------------------------------------------------------


def _metadata(path: Path) -> Data:
    with suppress(OSError, ValueError):
        found = json.loads(path.read_text(encoding="utf-8"))
        if isinstance(found, dict):
            return found
    return {}


def _submitters(said: Data) -> str:
    """Who handed it in, as the list in an export says it."""
    import yaml

    users = [user for user in said.get("users", ()) if isinstance(user, dict)]
    people = [{f":{key}": str(user.get(key) or "") for key in ("name", "sid", "email")} for user in users]
    text: str = yaml.safe_dump({SUBMISSION: {":submitters": people}}, allow_unicode=True)
    return text


def lateness(said: Data) -> str:
    """How late it is, in hours, minutes and seconds; by a date of the student's own, where there is one.

    >>> due = {"due_date": "2026-05-01T22:00:00Z"}
    >>> lateness({"created_at": "2026-05-02T01:00:00+02:00", "assignment": due})
    '1:00:00'
    """
    dates = [said.get("assignment"), *(user.get("assignment") for user in said.get("users", ()))]
    due = [date for one in dates if isinstance(one, dict) and (date := _date(one.get("due_date")))]
    created = _date(said.get("created_at"))
    late = created - max(due) if created and due else timedelta()
    seconds = max(0, int(late.total_seconds()))
    return f"{seconds // 3600}:{seconds // 60 % 60:02}:{seconds % 60:02}"


def _date(text: object) -> datetime | None:
    with suppress(ValueError):
        found = datetime.fromisoformat(str(text))
        return found if found.tzinfo else None
    return None


if __name__ == "__main__":
    main(Path(sys.argv[1]))
