"""The teacher's page: the cohort at a glance, in one file that fetches nothing."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, field
from fractions import Fraction
from html import escape
from importlib.resources import files
from math import floor

from dynsolve.grading.ledger import most, standings
from dynsolve.grading.policy import shown
from dynsolve.grading.problem_set import ProblemSet
from dynsolve.grading.record import Graded, Record
from dynsolve.grading.tables import decimal

VERDICTS = ("correct", "follows", "wrong", "unreadable", "missing")
BINS = 10
MOST_SLIPS = 40
MOST_ALIKE = 100
MOST_WAITING = 5000

_Key = tuple[str, str]


@dataclass
class _Cohort:
    """What one pass over the record counts."""

    marks: list[tuple[str, dict[str, Fraction], Fraction]] = field(default_factory=list)
    verdicts: dict[_Key, Counter[str]] = field(default_factory=dict)
    slips: Counter[tuple[str, str, str]] = field(default_factory=Counter)
    examples: dict[tuple[str, str, str], Graded] = field(default_factory=dict)
    alike: dict[tuple[str, str, str], list[Graded]] = field(default_factory=dict)
    queue: list[tuple[str, str, str, str]] = field(default_factory=list)


def teachers_page(problems: ProblemSet, record: Record) -> str:
    """The page; every table can be sorted by a click on its header."""
    cohort = _count(problems, record)
    title = escape(problems.title)
    css = _own("report.css")
    body = "".join(
        (
            f"<h1>{title}</h1>\n",
            _summary(problems, cohort),
            _distribution(problems, cohort),
            _verdicts(problems, cohort),
            _slips(cohort),
            _alike(cohort),
            _queue(cohort),
            _students(problems, cohort),
        )
    )
    policy = (
        '<meta http-equiv="Content-Security-Policy" content="default-src \'none\'; '
        "style-src 'unsafe-inline'; script-src 'unsafe-inline'; img-src data:\">"
    )
    return (
        '<!DOCTYPE html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n'
        f'{policy}\n<meta name="viewport" content="width=device-width, initial-scale=1">\n'
        f'<meta name="color-scheme" content="light dark">\n<link rel="icon" href="data:,">\n'
        f"<title>{title}</title>\n"
        f"<style>\n{css}</style>\n</head>\n<body>\n<main>\n{body}</main>\n<script>\n{_own('sort.js')}</script>\n"
        "</body>\n</html>\n"
    )


def _own(name: str) -> str:
    return (files("dynsolve.grading") / name).read_text(encoding="utf-8")


def _count(problems: ProblemSet, record: Record) -> _Cohort:
    cohort = _Cohort()
    for item in problems.items:
        for name in item.problem.marks:
            cohort.verdicts[item.stem, name] = Counter()
    for w in record.waiting():
        cohort.queue.append((w.student, w.problem, w.file, w.reason))
    for row in record.rows():
        if row.left:
            cohort.queue.append(
                (row.student, row.problem, ", ".join(row.left), "left aside: a newer copy counts")
            )
    for standing in standings(record):
        cohort.marks.append((standing.student, standing.marks, standing.total))
        for answer in standing.answers:
            _count_answer(cohort, answer)
    return cohort


def _count_answer(cohort: _Cohort, a: Graded) -> None:
    cohort.verdicts.setdefault((a.problem, a.answer), Counter())[a.verdict] += 1
    for code in a.diagnosis if a.verdict == "wrong" else ():
        cohort.slips[a.problem, a.answer, code] += 1
        cohort.examples.setdefault((a.problem, a.answer, code), a)
    if a.form:
        cohort.alike.setdefault((a.problem, a.answer, a.form), []).append(a)
    reason = _for_a_human(a)
    if reason:
        cohort.queue.append((a.student, a.problem, f"{a.answer} {a.label}".strip(), reason))


def _for_a_human(a: Graded) -> str:
    if a.why.startswith("set by the teacher"):
        return ""
    if a.verdict == "unreadable":
        return a.fault or "it could not be read"
    if a.loss:
        return f"it follows, but {a.loss}"
    return (
        "it is wrong, and no slip was found that explains it"
        if a.verdict == "wrong" and not a.diagnosis
        else ""
    )


# -- the parts of the page ---------------------------------------------------------------------------


def _summary(problems: ProblemSet, cohort: _Cohort) -> str:
    totals = sorted(total for _, _, total in cohort.marks)
    if not totals:
        return "<p>Nothing was handed in.</p>\n"
    of = sum(most(problems).values())
    n = len(totals)
    median = (totals[(n - 1) // 2] + totals[n // 2]) / 2
    mean = sum(totals, Fraction(0)) / n
    who = "1 student" if n == 1 else f"{n} students"
    return (
        f"<p>{who}; of {shown(Fraction(of))} marks the mean is {float(mean):.2f}, the median "
        f"{decimal(median)}, from {decimal(totals[0])} to {decimal(totals[-1])}. "
        f"{len(cohort.queue)} entries wait for a human.</p>\n"
    )


def _distribution(problems: ProblemSet, cohort: _Cohort) -> str:
    of = Fraction(sum(most(problems).values()))
    if not of or not cohort.marks:
        return ""
    bins = Counter(min(floor(total / of * BINS), BINS - 1) for _, _, total in cohort.marks)
    top = max(bins.values())
    bars = []
    for i in range(BINS):
        height = 150 * bins[i] / top
        label = f"{decimal(of * i / BINS)} to {decimal(of * (i + 1) / BINS)}: {bins[i]}"
        bars.append(
            f'<g><title>{label}</title><rect x="{i * 44 + 4}" y="{170 - height:.1f}" width="36" '
            f'height="{height:.1f}"/><text x="{i * 44 + 22}" y="{165 - height:.1f}">{bins[i] or ""}</text>'
            f'<text x="{i * 44 + 22}" y="186">{100 * i // BINS} %</text></g>'
        )
    return (
        "<h2>Marks</h2>\n"
        '<svg class="bars" viewBox="0 0 450 190" role="img" aria-label="Distribution of marks">'
        f"{''.join(bars)}</svg>\n"
    )


def _table(header: tuple[str, ...], rows: Iterator[str], note: str = "") -> str:
    head = "".join(f'<th scope="col"><button type="button">{escape(name)}</button></th>' for name in header)
    body = "\n".join(rows)
    if not body:
        return "<p>None.</p>\n"
    said = f"<p>{note}</p>\n" if note else ""
    return (
        f'{said}<div class="wide"><table class="sortable"><thead><tr>{head}</tr></thead>'
        f"<tbody>\n{body}\n</tbody></table></div>\n"
    )


def _cells(*cells: object) -> str:
    return "<tr>" + "".join(f"<td>{escape(str(cell))}</td>" for cell in cells) + "</tr>"


def _verdicts(problems: ProblemSet, cohort: _Cohort) -> str:
    def rows() -> Iterator[str]:
        order = {stem: place for place, stem in enumerate(problems.stems)}
        for (problem, answer), counts in sorted(cohort.verdicts.items(), key=lambda kv: order[kv[0][0]]):
            total = sum(counts.values()) or 1
            heat = "".join(
                f'<td class="heat {v}" style="--share:{counts[v] / total:.3f}">{counts[v]}</td>'
                for v in VERDICTS
            )
            yield f"<tr><td>{escape(problem)}</td><td>{escape(answer)}</td>{heat}</tr>"

    return "<h2>Answers</h2>\n" + _table(("problem", "answer", *VERDICTS), rows())


def _slips(cohort: _Cohort) -> str:
    def rows() -> Iterator[str]:
        for key, count in sorted(cohort.slips.items(), key=lambda kv: (-kv[1], kv[0]))[:MOST_SLIPS]:
            example = cohort.examples[key]
            said = example.message or example.read_as
            yield _cells(*key, count, f"{example.student}: {_short(said)}")

    return "<h2>Commonest slips</h2>\n" + _table(
        ("problem", "answer", "slip", "times", "for example"), rows()
    )


def _alike(cohort: _Cohort) -> str:
    def rows() -> Iterator[str]:
        found = [(key, same) for key, same in cohort.alike.items() if len(same) > 1]
        for (problem, answer, _), same in sorted(found, key=lambda kv: (-len(kv[1]), kv[0]))[:MOST_ALIKE]:
            who = ", ".join(a.student for a in same[:20]) + (" and others" if len(same) > 20 else "")
            yield _cells(problem, answer, len(same), _short(same[0].read_as), who)

    note = "A hint and no accusation: a common slip leads many to the same expression."
    return "<h2>The same wrong expression</h2>\n" + _table(
        ("problem", "answer", "students", "expression", "who"), rows(), note
    )


def _queue(cohort: _Cohort) -> str:
    shown_rows = cohort.queue[:MOST_WAITING]
    more = len(cohort.queue) - len(shown_rows)
    note = f"{more} more are in grades.sqlite." if more > 0 else ""
    return "<h2>For a human</h2>\n" + _table(
        ("student", "problem", "what", "why"), (_cells(*row) for row in shown_rows), note
    )


def _students(problems: ProblemSet, cohort: _Cohort) -> str:
    def rows() -> Iterator[str]:
        for student, marks, total in cohort.marks:
            each = (decimal(marks.get(stem, Fraction(0))) for stem in problems.stems)
            yield _cells(student, *each, decimal(total))

    return "<h2>Students</h2>\n" + _table(("student", *problems.stems, "total"), rows())


def _short(text: str, most: int = 160) -> str:
    text = " ".join(text.split())
    return text if len(text) <= most else text[: most - 1] + "…"
