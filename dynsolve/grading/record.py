"""The record of a run: SQLite in OUT, written a hand-in at a time.

Every hand-in is one transaction of a write-ahead log, so that whatever ends the
process leaves the record as it was after some hand-in.  The connection holds the file
alone: a second run on the same OUT is told so.  Nothing in it depends on time.

Marks anew: the record keeps of each answer what its marks are made from (`Kept`).

So other points, or another policy, need no hand-in to be judged again (`rescored`).
"""

from __future__ import annotations

import base64
import json
import sqlite3
from collections.abc import Iterable, Iterator, Mapping
from fractions import Fraction
from itertools import groupby
from operator import itemgetter
from pathlib import Path
from typing import Any, NamedTuple

from msgspec import Struct

from dynsolve.answers.marks import Marked, Policy, deduction, mark, points
from dynsolve.answers.verdict import EntryVerdict, JudgedAnswer, Verdict
from dynsolve.errors import UsageError
from dynsolve.quantities.index import Quantities

# Marks anew: the record keeps of each answer what its marks are made from (`Kept`)


class Kept(NamedTuple):
    """What the record keeps of an answer for marking it again; `basis` is the text that `basis` made."""

    name: str
    verdict: str
    loss: str
    basis: str


def basis(answer: JudgedAnswer) -> str:
    """What the marks of an answer depend on besides its verdict and its loss, as text for the record.

    >>> basis(JudgedAnswer("K", Verdict.FOLLOWS, follows_from=("K1",)))
    '[["K1"], [], [], 0, 0]'
    """
    entries = [[*entry.index, *_piece(entry)] for entry in answer.entries]
    parts = [_piece(part) for part in answer.parts]
    return json.dumps([list(answer.follows_from), entries, parts, int(answer.zero), int(answer.empty)])


def _piece(piece: EntryVerdict | JudgedAnswer) -> list[str | int]:
    return [str(piece.verdict), int(piece.zero), int(piece.empty)]


def rescored(
    kept: Iterable[Kept],
    points: Mapping[str, Fraction],
    quantities: Quantities,
    policy: Policy,
) -> tuple[Marked, ...]:
    """The marks of a hand-in's answers as they are now.

    >>> from dynsolve.quantities.owners import Owners
    >>> quantities = Quantities(Owners(1, (), ("1",)))
    >>> kept = [Kept("K", "follows", "", '[["K1"], [], [], 0, 0]')]
    >>> policy = Policy(follow=Fraction(1, 2))
    >>> rescored(kept, {"K": Fraction(4)}, quantities, policy)[0].marks
    Fraction(2, 1)
    """
    answers = (_restored(one, points.get(one.name, Fraction(0))) for one in kept)
    return mark(answers, quantities, policy)


def _restored(kept: Kept, of: Fraction) -> JudgedAnswer:
    """The answer as far as its marks depend on it."""
    follows_from, entries, parts, zero, empty = json.loads(kept.basis)
    return JudgedAnswer(
        kept.name,
        Verdict(kept.verdict),
        follows_from=tuple(follows_from),
        entries=tuple(
            EntryVerdict(tuple(index), Verdict(verdict), zero=bool(zero), empty=bool(empty))
            for *index, verdict, zero, empty in entries
        ),
        of=of,
        zero=bool(zero),
        empty=bool(empty),
        loss=kept.loss,
        parts=tuple(JudgedAnswer("", Verdict(v), zero=bool(z), empty=bool(e)) for v, z, e in parts),
    )


Key = tuple[str, str]
"""A hand-in: the student and the problem."""

FILE = "grades.sqlite"
FORMAT = "dynsolve-grades/2"

_TABLES = """
CREATE TABLE IF NOT EXISTS run (name TEXT PRIMARY KEY, value TEXT NOT NULL) WITHOUT ROWID;
CREATE TABLE IF NOT EXISTS students (student TEXT PRIMARY KEY, id TEXT NOT NULL) WITHOUT ROWID;
CREATE TABLE IF NOT EXISTS hand_ins (
  student TEXT, problem TEXT, fingerprint TEXT NOT NULL, causes TEXT NOT NULL, files TEXT NOT NULL,
  left_aside TEXT NOT NULL, late INTEGER NOT NULL, reason TEXT NOT NULL, notes TEXT NOT NULL,
  html BLOB NOT NULL, markdown BLOB NOT NULL, PRIMARY KEY (student, problem)) WITHOUT ROWID;
CREATE TABLE IF NOT EXISTS answers (
  student TEXT, problem TEXT, place INTEGER, answer TEXT NOT NULL, label TEXT NOT NULL,
  verdict TEXT NOT NULL, marks TEXT NOT NULL, of TEXT NOT NULL, why TEXT NOT NULL, line INTEGER NOT NULL,
  diagnosis TEXT NOT NULL, message TEXT NOT NULL, read_as TEXT NOT NULL, note TEXT NOT NULL,
  fault TEXT NOT NULL, loss TEXT NOT NULL, form TEXT NOT NULL, basis TEXT NOT NULL,
  PRIMARY KEY (student, problem, place)) WITHOUT ROWID;
CREATE TABLE IF NOT EXISTS waiting (
  student TEXT, problem TEXT, file TEXT, reason TEXT,
  PRIMARY KEY (student, problem, file, reason)) WITHOUT ROWID;
CREATE TABLE IF NOT EXISTS groups (student TEXT PRIMARY KEY, name TEXT NOT NULL) WITHOUT ROWID;
CREATE TABLE IF NOT EXISTS uploads (
  student TEXT, problem TEXT, paths TEXT NOT NULL, PRIMARY KEY (student, problem)) WITHOUT ROWID;
CREATE TABLE IF NOT EXISTS overrides (
  student TEXT, problem TEXT, answer TEXT, marks TEXT NOT NULL, why TEXT NOT NULL,
  PRIMARY KEY (student, problem, answer)) WITHOUT ROWID;
CREATE TABLE IF NOT EXISTS overridden (
  student TEXT, problem TEXT, answer TEXT, hand_in TEXT NOT NULL,
  PRIMARY KEY (student, problem, answer)) WITHOUT ROWID;
CREATE TABLE IF NOT EXISTS finished (
  student TEXT, problem TEXT, causes TEXT NOT NULL, answers TEXT NOT NULL,
  PRIMARY KEY (student, problem)) WITHOUT ROWID;
"""
_ANSWER = "name label verdict marks of why line diagnosis message read_as note fault loss form basis".split()
_COLUMNS = itemgetter(*_ANSWER)
_CODES = _ANSWER.index("diagnosis")


class Waiting(Struct, frozen=True, order=True):
    """Something for a human to look at; `student` and `problem` as far as they are known."""

    student: str
    problem: str
    file: str
    reason: str


class RecordedAnswer(NamedTuple):
    """One answer as it stands in the record, with the teacher's marks where there are any.

    `message` has what is said of each slip of `diagnosis`, `basis` what the marks are made
    from; `said` is why the teacher has set the marks, empty where nobody has, `comment` what the
    teacher says without setting them.
    """

    student: str
    problem: str
    answer: str
    label: str
    verdict: str
    marks: str
    of: str
    why: str
    line: int
    diagnosis: tuple[str, ...]
    message: tuple[str, ...]
    read_as: str
    note: str
    fault: str
    loss: str
    form: str
    basis: str
    said: str = ""
    comment: str = ""


class RecordedHandIn(Struct, frozen=True):
    """One hand-in as it stands in the record."""

    student: str
    problem: str
    files: tuple[str, ...]
    left: tuple[str, ...]
    late: int
    reason: str
    html: bytes
    markdown: bytes


class Record:
    """The record in a folder; raises UsageError where another run uses it, or it cannot be read."""

    def __init__(self, folder: Path) -> None:
        self.path = folder / FILE
        try:
            self.db = sqlite3.connect(self.path, timeout=0.2, isolation_level=None)
            self.db.execute("PRAGMA locking_mode=EXCLUSIVE")
            self.db.execute("PRAGMA journal_mode=WAL")
            self.db.execute("PRAGMA synchronous=NORMAL")
            self.db.executescript("BEGIN EXCLUSIVE;" + _TABLES + "COMMIT;")
            found = dict(self.db.execute("SELECT name, value FROM run"))
            if found.setdefault("format", FORMAT) != FORMAT:
                message = f"{self.path} was written by another version of dynsolve ({found['format']})"
                raise UsageError(f"{message}; give another folder with -o")
            self.set_run("format", FORMAT)
        except sqlite3.OperationalError as error:
            if "locked" in str(error):
                message = f"another run is at work on {folder}: wait for it, or give another folder with -o"
                raise UsageError(message) from None
            raise UsageError(f"{self.path} cannot be written: {error}") from None
        except sqlite3.DatabaseError as error:
            raise UsageError(f"{self.path} is no record of grades: {error}") from None

    def close(self) -> None:
        """Close the file; what was written stays."""
        self.db.close()

    # -- writing -----------------------------------------------------------------------------------

    def set_run(self, name: str, value: str) -> None:
        """Keep something about the whole run."""
        if self.run(name) != value:
            self.db.execute("INSERT OR REPLACE INTO run VALUES (?, ?)", (name, value))

    def run(self, name: str) -> str:
        """What is kept about the whole run, or nothing."""
        found = self.db.execute("SELECT value FROM run WHERE name = ?", (name,)).fetchone()
        return found[0] if found else ""

    def write(self, key: Key, fingerprint: str, causes: str, row: Mapping[str, Any]) -> None:
        """Write one hand-in with its answers: all of it, or nothing."""
        self.write_all([(key, fingerprint, causes, row)])

    def write_all(self, rows: Iterable[tuple[Key, str, str, Mapping[str, Any]]]) -> None:
        """Write several hand-ins at once: all of them, or nothing."""
        with self.db:
            self.db.execute("BEGIN")
            for row in rows:
                self._insert(*row)

    def _insert(self, key: Key, fingerprint: str, causes: str, row: Mapping[str, Any]) -> None:
        self.db.execute("DELETE FROM answers WHERE student = ? AND problem = ?", key)
        self.db.execute(
            "INSERT OR REPLACE INTO hand_ins VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)",
            (
                *key, fingerprint, causes, _text(row["files"]), _text(row["left"]), int(row["late"]),
                row["reason"], _text(row["notes"]),
                base64.b64decode(row["html"]), base64.b64decode(row["markdown"]),
            ),
        )  # fmt: skip
        self.db.executemany(
            f"INSERT INTO answers VALUES ({', '.join('?' * (3 + len(_ANSWER)))})",  # noqa: S608
            [(*key, place, *_cells(answer)) for place, answer in enumerate(row["answers"])],
        )

    def rescore(self, key: Key, fingerprint: str, causes: str, marks: Iterable[Marked]) -> None:
        """Write the marks of a hand-in anew: all of them, or nothing."""
        with self.db:
            self.db.execute("BEGIN")
            place = "WHERE student = ? AND problem = ?"
            change = f"UPDATE hand_ins SET fingerprint = ?, causes = ? {place}"  # noqa: S608
            self.db.execute(change, (fingerprint, causes, *key))
            self.db.executemany(
                f"UPDATE answers SET marks = ?, of = ?, why = ? {place} AND answer = ?",  # noqa: S608
                [(str(m.marks), str(m.of), m.why, *key, m.name) for m in marks],
            )

    def set_intake(
        self,
        students: Mapping[str, str],
        waiting: tuple[Waiting, ...],
        groups: Mapping[str, str] | None = None,
    ) -> None:
        """Who there is, what waits for a human, and for which group the files of a student are."""
        with self.db:
            self.db.execute("BEGIN")
            for table in ("students", "waiting", "groups"):
                self.db.execute(f"DELETE FROM {table}")  # noqa: S608
            self.db.executemany("INSERT INTO students VALUES (?, ?)", students.items())
            self.db.executemany("INSERT INTO groups VALUES (?, ?)", (groups or {}).items())
            rows = [(w.student, w.problem, w.file, w.reason) for w in waiting]
            self.db.executemany("INSERT OR IGNORE INTO waiting VALUES (?, ?, ?, ?)", rows)

    def set_uploads(self, paths: Mapping[Key, tuple[str, ...]]) -> None:
        """Where the files of each hand-in lie in what was handed in."""
        with self.db:
            self.db.execute("BEGIN")
            self.db.execute("DELETE FROM uploads")
            rows = [(*key, _text(of_one)) for key, of_one in paths.items()]
            self.db.executemany("INSERT INTO uploads VALUES (?, ?, ?)", rows)

    def keep_only(self, keys: set[tuple[str, str]]) -> None:
        """Remove the hand-ins that are not among these."""
        gone = [key for key in self.fingerprints() if key not in keys]
        with self.db:
            self.db.execute("BEGIN")
            for table in ("hand_ins", "answers"):
                statement = f"DELETE FROM {table} WHERE student = ? AND problem = ?"  # noqa: S608
                self.db.executemany(statement, gone)

    def override(self, student: str, problem: str, answer: str, marks: str, why: str) -> None:
        """Keep the marks that a teacher gave for an answer, empty for none, and what is said of it."""
        row = (student, problem, answer, marks, why)
        self.db.execute("INSERT OR REPLACE INTO overrides VALUES (?, ?, ?, ?, ?)", row)
        of = (student, problem, answer, self._hand_in((student, problem)))
        self.db.execute("INSERT OR REPLACE INTO overridden VALUES (?, ?, ?, ?)", of)

    def overtaken(self) -> set[tuple[str, str, str]]:
        """The answers whose marks were set by hand for another hand-in than the one that counts now."""
        found = self.db.execute("SELECT * FROM overridden")
        return {(s, p, a) for s, p, a, hand_in in found if hand_in != self._hand_in((s, p))}

    def _hand_in(self, key: Key) -> str:
        return self.kept(key)[0].get("hand-in", "")

    def finish(self, policy: Policy) -> None:
        """Keep the current marks, which the next run is compared with."""
        with self.db:
            self.db.execute("BEGIN")
            for key, causes, answers in self.standing(policy):
                now = (causes, _text(answers))
                if self._finished(key) != now:
                    self.db.execute("INSERT OR REPLACE INTO finished VALUES (?, ?, ?, ?)", (*key, *now))
            self.db.executemany("DELETE FROM finished WHERE student = ? AND problem = ?", self.gone())

    # -- reading -----------------------------------------------------------------------------------

    def fingerprints(self) -> dict[tuple[str, str], str]:
        """What each hand-in of the record was made from."""
        found = self.db.execute("SELECT student, problem, fingerprint FROM hand_ins")
        return {(student, problem): fingerprint for student, problem, fingerprint in found}

    def kept(self, key: Key) -> tuple[dict[str, str], list[Kept]]:
        """What a hand-in was made from, and what the marks of its answers are made from."""
        place = "WHERE student = ? AND problem = ?"
        found = self.db.execute(f"SELECT causes FROM hand_ins {place}", key).fetchone()  # noqa: S608
        columns = f"SELECT answer, verdict, loss, basis FROM answers {place} ORDER BY place"  # noqa: S608
        return json.loads(found[0]) if found else {}, [Kept(*row) for row in self.db.execute(columns, key)]

    def students(self) -> dict[str, str]:
        """Every student, with the platform's id."""
        return dict(self.db.execute("SELECT student, id FROM students ORDER BY student"))

    def uploads(self) -> dict[Key, tuple[str, ...]]:
        """Where the files of each hand-in lie in what was handed in."""
        found = self.db.execute("SELECT student, problem, paths FROM uploads ORDER BY student, problem")
        return {(student, problem): tuple(json.loads(paths)) for student, problem, paths in found}

    def groups(self) -> dict[str, str]:
        """Of each student whose group handed in what the files call the group."""
        return dict(self.db.execute("SELECT student, name FROM groups ORDER BY student"))

    def waiting(self) -> tuple[Waiting, ...]:
        """What waits for a human."""
        order = "SELECT * FROM waiting ORDER BY student, problem, file, reason"
        return tuple(Waiting(*row) for row in self.db.execute(order))

    def overrides(self) -> dict[tuple[str, str, str], tuple[str, str]]:
        """The marks that a teacher gave, and why."""
        found = self.db.execute("SELECT * FROM overrides")
        return {(s, p, a): (marks, why) for s, p, a, marks, why in found}

    def unjudged(self) -> dict[str, dict[str, str]]:
        """By student the problems that nobody has judged, neither the program nor a teacher, and why."""
        found: dict[str, dict[str, str]] = {}
        without = (
            "SELECT student, problem, reason FROM hand_ins h WHERE reason != '' AND EXISTS ("
            "SELECT 1 FROM answers a LEFT JOIN overrides o USING (student, problem, answer) "
            "WHERE a.student = h.student AND a.problem = h.problem AND a.of != '0' "
            "AND COALESCE(o.marks, '') = '')"
        )
        for student, problem, reason in self.db.execute(without):
            found.setdefault(student, {})[problem] = reason
        return found

    def rows(self) -> Iterator[RecordedHandIn]:
        """The hand-ins, one after the other."""
        columns = "student, problem, files, left_aside, late, reason, html, markdown"
        order = f"SELECT {columns} FROM hand_ins ORDER BY student, problem"  # noqa: S608
        for s, p, files, left, late, reason, html, markdown in self.db.execute(order):
            names, others = (tuple(json.loads(text)) for text in (files, left))
            yield RecordedHandIn(s, p, names, others, late, reason, html, markdown)

    def answers(self, student: str | None = None) -> Iterator[RecordedAnswer]:
        """The answers with their marks, the teacher's where given; of one student, or of all."""
        overrides = self.overrides()
        where, values = ("WHERE student = ?", (student,)) if student is not None else ("", ())
        order = f"SELECT * FROM answers {where} ORDER BY student, problem, place"  # noqa: S608
        for s, p, _, name, label, verdict, marks, of, why, line, codes, message, *rest in self.db.execute(
            order, values
        ):
            diagnosis = tuple(filter(None, codes.split(";"))) if codes else ()
            told = tuple(message.split("\n")) if codes else ()
            graded = RecordedAnswer(s, p, name, label, verdict, marks, of, why, line, diagnosis, told, *rest)
            said = overrides.get((s, p, name)) if overrides else None
            if said is not None and not said[0]:
                graded = graded._replace(why=f"{why}; the teacher: {said[1]}", comment=said[1])
            elif said is not None:
                by_hand = f"set by the teacher: {said[1]} (the program: {why})"
                graded = graded._replace(marks=said[0], why=by_hand, said=said[1])
            yield graded

    def marks(self) -> Iterator[tuple[Key, tuple[str, ...]]]:
        """The marks of every hand-in's answers, the teacher's where given."""
        overrides = self.overrides()
        order = "SELECT student, problem, answer, marks FROM answers ORDER BY student, problem, place"
        for key, found in groupby(self.db.execute(order), key=itemgetter(0, 1)):
            marks = (overrides.get((s, p, a), ("", ""))[0] or m for s, p, a, m in found)
            yield key, tuple(marks)

    def late(self) -> dict[Key, int]:
        """The days that hand-ins are late."""
        found = self.db.execute("SELECT student, problem, late FROM hand_ins WHERE late")
        return {(student, problem): days for student, problem, days in found}

    def standing(self, policy: Policy) -> Iterator[tuple[Key, str, list[list[str]]]]:
        """Every hand-in with what it was made from, and its answers' verdict, marks and why.

        Last of a late one comes what that has deducted.
        """
        causes = {(s, p): c for s, p, c in self.db.execute("SELECT student, problem, causes FROM hand_ins")}
        days = self.late()
        for key, found in groupby(self.answers(), key=lambda a: (a.student, a.problem)):
            lines = [[a.answer, a.verdict, a.marks, a.why] for a in found]
            deducted = deduction(points(*(line[2] for line in lines)), days.get(key, 0), policy)
            lines += [[deducted.name, "", str(deducted.marks), deducted.why]] if deducted else []
            yield key, causes[key], lines

    def finished(self, key: Key) -> tuple[dict[str, str], dict[str, list[str]]]:
        """The causes and answers of a hand-in when the last run finished, or nothing."""
        found = self._finished(key)
        if found is None:
            return {}, {}
        return json.loads(found[0]), {name: rest for name, *rest in json.loads(found[1])}

    def compared(self) -> bool:
        """Whether a run has been finished before."""
        return self.db.execute("SELECT 1 FROM finished LIMIT 1").fetchone() is not None

    def gone(self) -> list[Key]:
        """The hand-ins of the last finished run that are there no more."""
        order = (
            "SELECT student, problem FROM finished EXCEPT SELECT student, problem FROM hand_ins ORDER BY 1, 2"
        )
        return list(self.db.execute(order))

    def _finished(self, key: Key) -> tuple[str, str] | None:
        where = "SELECT causes, answers FROM finished WHERE student = ? AND problem = ?"
        found: tuple[str, str] | None = self.db.execute(where, key).fetchone()
        return found


def _text(value: Any) -> str:
    return json.dumps(value, ensure_ascii=False)


def _cells(answer: Mapping[str, Any]) -> tuple[Any, ...]:
    """An answer in the order of its columns, the codes of its slips as one text."""
    cells = _COLUMNS(answer)
    return (*cells[:_CODES], ";".join(cells[_CODES]), *cells[_CODES + 1 :])
