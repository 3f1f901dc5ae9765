"""A file that was handed in -> a `Submission`, by its ending."""

from __future__ import annotations

import re
from pathlib import PurePath

from dynsolve.answers.reading.documents import FORMATS, as_report
from dynsolve.answers.reading.equation_reader import EquationReader
from dynsolve.answers.reading.limits import MAX_BYTES
from dynsolve.answers.reading.own_coordinates import with_own_coordinates
from dynsolve.answers.reading.reports import read_report
from dynsolve.answers.reading.sources import Source, decoded, plain_signs
from dynsolve.answers.reading.vocabulary import counted_from_zero, vocabulary
from dynsolve.answers.submission import Submission
from dynsolve.errors import Finding, ReadError
from dynsolve.explain.context import style_of
from dynsolve.notation.unicode import UnicodePrinter
from dynsolve.problem.model import Problem

ENDINGS = (".yaml", ".yml", ".json", ".md", ".markdown", ".tex", ".txt", ".ipynb", ".html", ".htm", *FORMATS)
"""The endings of files that are read."""


_REPORTS = (".md", ".markdown", ".tex", ".txt")
_ANSWERS = re.compile(r"""(?m)^[ \t]{0,9}\{?[ \t]{0,9}["']?answers["']?[ \t]*:|\A\s{0,99}\{\s{0,99}["']""")
_ANSWER_FILES = (".yaml", ".yml", ".json")

MOST_PRINTED = 8_000
"""So many parts of trees a printer remembers before it is begun anew."""


def _is_report(text: str) -> bool:
    """Whether a text without a telling name, from standard input say, is a report."""
    has_displays = any(sign in text for sign in ("$$", "\\[", "\\begin{"))
    return has_displays and _ANSWERS.search(text) is None


class FileReader:
    """Reads what is handed in for one problem; what all hand-ins share is made once."""

    def __init__(self, problem: Problem) -> None:
        self.vocabulary = vocabulary(problem)
        self.style = style_of(problem.robot)
        self.printer = UnicodePrinter(self.style)

    def __call__(self, content: bytes | str, file: str) -> Submission:
        """Read one file; what is wrong with it as a whole is in `faults`."""
        if len(content) > MAX_BYTES:
            message = f"the file is larger than {MAX_BYTES // 1_000_000} MB"
            return Submission("", "", file, (), (), (Finding(message, "hand in the text alone", file),))
        if self.printer.remembered > MOST_PRINTED:
            self.printer = UnicodePrinter(self.style)
        names = self.vocabulary.fresh()
        text = content if isinstance(content, str) else content.decode(errors="ignore")
        if file.endswith(".ipynb"):
            text = text.replace("\\n", "\n")  # the ends of lines within the strings of its JSON
        names.from_zero = counted_from_zero(text, len(names.coordinates))
        reader = EquationReader(names, self.printer)
        problem, student, faults = _read(reader, content, file)
        reader.found.settle()
        coordinates = [q.name for q in self.vocabulary.coordinates]
        answers = tuple(with_own_coordinates(reader.found.answers, reader.coordinates, coordinates))
        refused = tuple(reader.found.not_recognized)
        return Submission(
            problem,
            student,
            file,
            answers,
            refused,
            tuple(faults),
            tuple(reader.found.left_alone),
            tuple(reader.found.general),
            tuple(reader.found.configurations),
            tuple(reader.found.verdicts),
        )


def read_submission(problem: Problem, source: bytes | str, file: str) -> Submission:
    """Read what a student handed in: an answer file (.yaml, .json), or a report (.md, .tex, .ipynb, ...).

    The ending of `file` says which; nothing that stands in `source` raises.  For many
    files of one problem keep a `FileReader`.
    """
    return FileReader(problem)(source, file)


def _read(reader: EquationReader, content: bytes | str, file: str) -> tuple[str, str, list[Finding]]:
    """Read a file by its ending; gives the problem and the student that it names, and its faults."""
    ending = PurePath(file.replace("\0", "")).suffix.lower()
    if ending in FORMATS and isinstance(content, bytes):
        return "", "", _read_document(reader, content, file, ending)
    source = Source(decoded(content), file)
    if ending == ".ipynb":
        from dynsolve.answers.reading.notebooks import read_notebook

        return "", "", read_notebook(reader, source)
    if ending in (".html", ".htm"):
        from dynsolve.answers.reading.web import read_page

        read_page(reader, source)
    elif ending in _REPORTS or (ending not in _ANSWER_FILES and _is_report(source.text)):
        read_report(reader, source, latex=ending == ".tex")
    else:
        from dynsolve.answers.reading.answer_file import read_answer_file

        (problem, student), faults = read_answer_file(reader, source)
        return problem, student, faults
    return "", "", []


def _read_document(reader: EquationReader, content: bytes, file: str, ending: str) -> list[Finding]:
    """Read what pandoc makes a report of; gives its faults."""
    try:
        text, pictures = as_report(content, ending)
    except ReadError as error:
        return [Finding(error.message, error.help, file)]
    read_report(reader, Source(plain_signs(text), file))
    if pictures and not reader.found.answers:
        message = "no formula stands in this document, only pictures, which a human has to read"
        return [Finding(message, "write formulas with the editor for formulas", file)]
    return []
