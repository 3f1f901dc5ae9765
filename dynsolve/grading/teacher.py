"""The teacher's page: the cohort at a glance, in one file that fetches nothing."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator
from fractions import Fraction
from html import escape
from importlib.resources import files
from math import floor
from urllib.parse import quote

from dynsolve.answers.diagnosis.slips import SLIPS
from dynsolve.answers.marking.policy import shown
from dynsolve.grading.cohort import VERDICTS, Cohort, counted, most
from dynsolve.grading.files import decimal, folder_name
from dynsolve.grading.problem_set import ProblemSet
from dynsolve.grading.record import Record
from dynsolve.render.prose import visible

BINS = 10
MOST_SLIPS = 40
MOST_ALIKE = 100
MOST_WAITING = 5000
MOST_NAMED = 20


def teachers_page(problems: ProblemSet, record: Record) -> str:
    """The page; every table can be sorted by its header's buttons."""
    cohort = counted(problems, record)
    title = _text(problems.title)
    sections = {
        "Marks": _distribution(problems, cohort),
        "For a human": _queue(cohort),
        "Answers": _verdicts(problems, cohort),
        "Commonest slips": _slips(cohort),
        "The same wrong expression": _alike(cohort),
        "Set by hand": _by_hand(cohort),
        "Students": _students(problems, cohort),
    }
    told = {name: body for name, body in sections.items() if body}
    links = " · ".join(f'<a href="#{_anchor(name)}">{name}</a>' for name in told)
    body = "".join(f'<h2 id="{_anchor(name)}">{name}</h2>\n{text}' for name, text in told.items())
    policy = (
        '<meta http-equiv="Content-Security-Policy" content="default-src \'none\'; '
        "style-src 'unsafe-inline'; script-src 'unsafe-inline'; img-src data:\">"
    )
    return (
        '<!DOCTYPE html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n'
        f'{policy}\n<meta name="viewport" content="width=device-width, initial-scale=1">\n'
        '<meta name="color-scheme" content="light dark">\n<link rel="icon" href="data:,">\n'
        f"<title>{title}</title>\n<style>\n{_own('report.css')}</style>\n</head>\n<body>\n<main>\n"
        f"<h1>{title}</h1>\n{_summary(problems, cohort)}<nav>{links}</nav>\n{body}</main>\n"
        f"<script>\n{_own('sort.js')}</script>\n</body>\n</html>\n"
    )


def _own(name: str) -> str:
    return (files("dynsolve.grading") / name).read_text(encoding="utf-8")


def _anchor(name: str) -> str:
    return name.lower().replace(" ", "-")


def _text(text: object) -> str:
    """Text that a student may have written, escaped."""
    return escape(visible(str(text)))


# -- tables ------------------------------------------------------------------------------------------


def _table(header: tuple[str, ...], rows: Iterable[str], note: str = "") -> str:
    body = "\n".join(rows)
    if not body:
        return ""
    head = "".join(f'<th scope="col"><button type="button">{_text(name)}</button></th>' for name in header)
    said = f"<p>{note}</p>\n" if note else ""
    return (
        f'{said}<div class="wide" tabindex="0"><table class="sortable"><thead><tr>{head}</tr></thead>'
        f"<tbody>\n{body}\n</tbody></table></div>\n"
    )


def _row(*cells: str) -> str:
    """A row of cells, whose text is safe already."""
    return "<tr>" + "".join(f"<td>{cell}</td>" for cell in cells) + "</tr>"


def _link(cohort: Cohort, student: str, problem: str, text: str = "") -> str:
    """A student, or another text, with the link to the page that the student reads."""
    text = _text(text or student)
    if (student, problem) not in cohort.pages:
        return text
    return f'<a href="feedback/{quote(folder_name(student))}/{quote(problem)}.html">{text}</a>'


def _short(text: str, most: int = 160) -> str:
    text = " ".join(text.split())
    return _text(text if len(text) <= most else text[: most - 1] + "…")


# -- the parts of the page ---------------------------------------------------------------------------


def _summary(problems: ProblemSet, cohort: Cohort) -> str:
    totals = sorted(total for _, _, total in cohort.marks)
    if not totals:
        return "<p>Nothing was handed in.</p>\n"
    of = sum(most(problems).values(), Fraction(0))
    n = len(totals)
    median = (totals[(n - 1) // 2] + totals[n // 2]) / 2
    mean = sum(totals, Fraction(0)) / n
    who = "1 student" if n == 1 else f"{n} students"
    waits = len(cohort.queue)
    waiting = "1 entry waits" if waits == 1 else f"{waits or 'No'} entries wait"
    return (
        f"<p>{who}; of {shown(of)} marks the mean is {float(mean):.2f}, the median "
        f"{decimal(median)}, from {decimal(totals[0])} to {decimal(totals[-1])}. "
        f"{waiting} for a human.</p>\n"
    )


def _distribution(problems: ProblemSet, cohort: Cohort) -> str:
    of = sum(most(problems).values(), Fraction(0))
    if not of or not cohort.marks:
        return ""
    bins = Counter(min(floor(total / of * BINS), BINS - 1) for _, _, total in cohort.marks)
    top = max(bins.values())
    bars = []
    told = []
    for i in range(BINS):
        height = 150 * bins[i] / top
        label = f"{decimal(of * i / BINS)} to {decimal(of * (i + 1) / BINS)} marks: {bins[i]}"
        told.append(label)
        bars.append(
            f'<g><title>{label}</title><rect x="{i * 44 + 4}" y="{170 - height:.1f}" width="36" '
            f'height="{height:.1f}"/><text x="{i * 44 + 22}" y="{165 - height:.1f}">{bins[i] or ""}</text>'
            f'<text x="{i * 44 + 22}" y="186">{100 * i // BINS} %</text></g>'
        )
    return (
        f'<svg class="bars" viewBox="0 0 450 190" role="img" aria-label="{"; ".join(told)}">'
        f"{''.join(bars)}</svg>\n"
    )


def _verdicts(problems: ProblemSet, cohort: Cohort) -> str:
    def rows() -> Iterator[str]:
        order = {stem: place for place, stem in enumerate(problems.stems)}
        for (problem, answer), counts in sorted(cohort.verdicts.items(), key=lambda kv: order[kv[0][0]]):
            total = sum(counts.values()) or 1
            heat = "".join(
                f'<td class="heat {v}" style="--share:{counts[v] / total:.3f}">{counts[v]}</td>'
                for v in VERDICTS
            )
            yield f"<tr><td>{_text(problem)}</td><td>{_text(answer)}</td>{heat}</tr>"

    return _table(("problem", "answer", *VERDICTS), rows())


def _slips(cohort: Cohort) -> str:
    found = sorted(cohort.slips.items(), key=lambda kv: (-kv[1], kv[0]))

    def rows() -> Iterator[str]:
        for (problem, answer, code), count in found[:MOST_SLIPS]:
            example = cohort.examples[problem, answer, code]
            kind = SLIPS[code].kind if code in SLIPS else code
            who = _link(cohort, example.student, problem)
            yield _row(
                _text(problem), _text(answer), _text(kind), str(count), who, _short(example.text)
            )  # fmt: skip

    header = ("problem", "answer", "slip", "times", "for example", "what is said of it")
    return _table(header, rows(), _of(MOST_SLIPS, len(found), "commonest"))


def _of(most: int, count: int, which: str) -> str:
    return f"The {most} {which} of {count}." if count > most else ""


def _alike(cohort: Cohort) -> str:
    found = [(key, same) for key, same in cohort.alike.items() if len(same.students) > 1]
    found.sort(key=lambda kv: (-len(kv[1].students), kv[0]))

    def rows() -> Iterator[str]:
        for (problem, answer, _), same in found[:MOST_ALIKE]:
            who = ", ".join(_link(cohort, student, problem) for student in same.students[:MOST_NAMED])
            more = " and others" if len(same.students) > MOST_NAMED else ""
            yield _row(
                _text(problem), _text(answer), str(len(same.students)), _short(same.text), who + more
            )  # fmt: skip

    hint = "A hint and no accusation: a common slip leads many to the same expression."
    note = f"{hint} {_of(MOST_ALIKE, len(found), 'most frequent')}".strip()
    return _table(("problem", "answer", "students", "expression", "who"), rows(), note)


def _queue(cohort: Cohort) -> str:
    rows = (
        _row(_link(cohort, e.student, e.problem), _text(e.problem), _text(e.what), _text(e.why))
        for e in cohort.queue[:MOST_WAITING]
    )
    more = len(cohort.queue) - MOST_WAITING
    note = f"{more} more are in grades.sqlite." if more > 0 else ""
    return _table(("student", "problem", "what", "why"), rows, note)


def _by_hand(cohort: Cohort) -> str:
    def rows() -> Iterator[str]:
        for a in cohort.by_hand:
            marks = f"{shown(Fraction(a.marks))} of {shown(Fraction(a.of))}"
            who = _link(cohort, a.student, a.problem)
            yield _row(who, _text(a.problem), _text(a.answer), marks, _text(a.why))

    return _table(("student", "problem", "answer", "marks", "why"), rows())


def _students(problems: ProblemSet, cohort: Cohort) -> str:
    def rows() -> Iterator[str]:
        for student, marks, total in cohort.marks:
            each = (
                _link(cohort, student, stem, decimal(marks.get(stem, Fraction(0)))) for stem in problems.stems
            )
            yield _row(_text(student), *each, decimal(total))

    return _table(("student", *problems.stems, "total"), rows())
