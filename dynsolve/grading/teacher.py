"""The teacher's page: the cohort at a glance, in one file that fetches nothing.

A histogram of marks: inline SVG that is read without a script, and by a screen reader.

Students' pages as they travel and are kept: packed, with a place for the marks.
"""

from __future__ import annotations

import base64
import zlib
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence, Set
from fractions import Fraction
from html import escape
from importlib.resources import files
from math import floor
from pathlib import PurePosixPath
from urllib.parse import quote

from dynsolve.answers.diagnosis.slips import SLIPS
from dynsolve.answers.feedback import FeedbackView, not_recognized, opening, readings, slips
from dynsolve.answers.marks import shown
from dynsolve.answers.verdict import Report
from dynsolve.document import Block, Document, Note, Text
from dynsolve.explain.context import style_of
from dynsolve.grading.cohort import VERDICTS, WAITS, Cohort, Entry, Item, counted, most
from dynsolve.grading.files import called, decimal, folder_name
from dynsolve.grading.files import text as _text
from dynsolve.grading.record import Record
from dynsolve.grading.set_file import ProblemSet
from dynsolve.grading.uploads import FOLDER, copy_name
from dynsolve.notation.printing import PLAIN, Style
from dynsolve.problem.model import Problem
from dynsolve.render.html import stylesheet, whole_page
from dynsolve.render.prose import visible

# A histogram of marks: inline SVG that is read without a script, and by a screen reader

BINS = 10
_WIDTH, _HEIGHT, _FOOT = 44, 150, 170


def histogram(title: str, marks: Sequence[Fraction], of: Fraction) -> str:
    """A figure of how many earned which share of `of`, in ten bins; nothing where there is nothing."""
    if not of or not marks:
        return ""
    bins = Counter(min(floor(one / of * BINS), BINS - 1) for one in marks)
    top = max(bins.values())
    labels = [
        f"{decimal(of * i / BINS)} to {decimal(of * (i + 1) / BINS)} marks: {bins[i]}" for i in range(BINS)
    ]
    bars = "".join(_bar(i, bins[i], _HEIGHT * bins[i] / top, labels[i]) for i in range(BINS))
    mean = float(sum(marks, Fraction(0)) / len(marks))
    who = "1 student" if len(marks) == 1 else f"{len(marks)} students"
    caption = f"{title}: {who}, mean {mean:.2f} of {shown(of)}"
    said = escape(visible(caption))
    return (
        f'<figure><svg class="bars" viewBox="0 0 {_WIDTH * BINS + 10} 190" role="img" '
        f'aria-label="{said}. {"; ".join(labels)}">{bars}</svg>\n<figcaption>{said}</figcaption></figure>\n'
    )


def _bar(place: int, count: int, height: float, label: str) -> str:
    left, middle = place * _WIDTH + 4, place * _WIDTH + _WIDTH // 2
    return (
        f'<g><title>{label}</title><rect x="{left}" y="{_FOOT - height:.1f}" width="{_WIDTH - 8}" '
        f'height="{height:.1f}"/><text x="{middle}" y="{_FOOT - 5 - height:.1f}">{count or ""}</text>'
        f'<text x="{middle}" y="186">{100 * place // BINS} %</text></g>'
    )


MOST_SLIPS = 40
MOST_ALIKE = 100
MOST_WAITING = 5000
MOST_NAMED = 20

ITEM_REST = (
    "A hand-in of which something waits for a human is counted under waits alone. Item-rest r is the "
    "correlation of the marks for this answer with all other marks of the same student (the corrected "
    "item-total correlation): near 1, it tells strong students from weak ones; near or below 0, look at the "
    "question and its key. It stands where 3 students or more wait for nothing, and not all have the same."
)


def teachers_page(
    problems: ProblemSet,
    record: Record,
    waits: Sequence[Entry],
    names: Mapping[str, str],
    copies: Set[str],
) -> str:
    """The page; every table can be sorted by its header's buttons.

    `waits` is what waits for a human, `names` are what students are called, where the platform's
    list says it, `copies` the files of what was handed in that the page can link to.
    """
    cohort = counted(problems, record, waits, names)
    title = _text(problems.title)
    sections = {
        "Marks": _distribution(problems, cohort),
        "For a human": _queue(cohort, copies),
        "Answers": _answers(problems, cohort),
        "Commonest slips": _slips(cohort),
        "The same wrong expression": _alike(cohort),
        "Set by hand": _by_hand(cohort, copies),
        "Students": _students(problems, cohort, copies),
    }
    told = {name: body for name, body in sections.items() if body}
    links = " · ".join(f'<a href="#{_anchor(name)}">{name}</a>' for name in told)
    body = "".join(f'<h2 id="{_anchor(name)}">{name}</h2>\n{text}' for name, text in told.items())
    main = f"<h1>{title}</h1>\n{_summary(problems, cohort)}<nav>{links}</nav>\n{body}"
    whole = f"<main>\n{main}</main>\n<script>\n{_own('sort.js')}</script>"
    return whole_page(title, "script-src 'unsafe-inline'; img-src data:", _own("report.css"), whole)


def _own(name: str) -> str:
    return (files("dynsolve.grading") / name).read_text(encoding="utf-8")


def _anchor(name: str) -> str:
    return name.lower().replace(" ", "-")


# -- tables ------------------------------------------------------------------------------------------


def _table(caption: str, header: tuple[str, ...], rows: Iterable[str], note: str = "") -> str:
    body = "\n".join(rows)
    if not body:
        return ""
    head = "".join(f'<th scope="col"><button type="button">{_text(name)}</button></th>' for name in header)
    said = f"<p>{note}</p>\n" if note else ""
    named = f"<caption>{_text(caption)}</caption>"
    return (
        f'{said}<div class="wide" tabindex="0"><table class="sortable">{named}<thead><tr>{head}</tr></thead>'
        f"<tbody>\n{body}\n</tbody></table></div>\n"
    )


def _row(*cells: str) -> str:
    """A row of cells, whose text is safe already."""
    return "<tr>" + "".join(f"<td>{cell}</td>" for cell in cells) + "</tr>"


def _link(cohort: Cohort, student: str, problem: str, text: str = "") -> str:
    """A student, or another text, with the link to the page that the student reads."""
    text = _text(text or called(student, cohort.names))
    if (student, problem) not in cohort.pages:
        return text
    return f'<a href="feedback/{quote(folder_name(student))}/{quote(problem)}.html">{text}</a>'


def _file(copies: Set[str], path: str, text: str) -> str:
    """A text with the link to the copy of a file that was handed in, where there is one."""
    name = copy_name(path)
    if name not in copies:
        return _text(text)
    return f'<a href="{FOLDER}/{quote(name)}">{_text(text)}</a>'


def _hand_in(cohort: Cohort, copies: Set[str], student: str, problem: str) -> str:
    """A problem with the links to what the student handed in for it."""
    first, *others = cohort.uploads.get((student, problem), ("",))
    if not first:
        return _text(problem)
    named = [(first, problem), *((path, PurePosixPath(path).name) for path in others)]
    return " ".join(_file(copies, path, name) for path, name in named)


def _short(text: str, most: int = 160) -> str:
    text = " ".join(text.split())
    return _text(text if len(text) <= most else text[: most - 1] + "…")


# -- the parts of the page ---------------------------------------------------------------------------


def _summary(problems: ProblemSet, cohort: Cohort) -> str:
    """Who there is and how they did, with the one number for what waits."""
    totals = sorted(standing.total for standing in cohort.settled)
    waits = f'<p class="waits">{_waiting(cohort)}.</p>\n'
    if not cohort.standings:
        return f"{waits}<p>Nothing was handed in.</p>\n"
    n, waiting = len(totals), len(cohort.standings) - len(totals)
    who = "1 student" if len(cohort.standings) == 1 else f"{len(cohort.standings)} students"
    if waiting:
        who += f", of whom {waiting} {'waits and is' if waiting == 1 else 'wait and are'} not counted"
    if not totals:
        return f"{waits}<p>{who}.</p>\n"
    of = sum(most(problems).values(), Fraction(0))
    median = (totals[(n - 1) // 2] + totals[n // 2]) / 2
    mean = sum(totals, Fraction(0)) / n
    return (
        f"{waits}<p>{who}; of {shown(of)} marks the mean is {float(mean):.2f}, the median "
        f"{decimal(median)}, from {decimal(totals[0])} to {decimal(totals[-1])}.</p>\n"
    )


def _distribution(problems: ProblemSet, cohort: Cohort) -> str:
    """A histogram of each problem, and of all together where they are several."""
    of = most(problems)
    earned = {
        stem: [s.marks[stem] for s in cohort.standings if (s.student, stem) in cohort.judged]
        for stem in problems.stems
    }
    figures = [histogram(stem, earned[stem], of[stem]) for stem in problems.stems]
    if len(problems.stems) > 1:
        totals = [standing.total for standing in cohort.settled]
        figures.insert(0, histogram("All problems", totals, sum(of.values(), Fraction(0))))
    drawn = "".join(figures)
    note = "Who waits for a human, with that problem or at all, is not counted."
    return f'<p>{note}</p>\n<div class="figures">{drawn}</div>\n' if drawn else ""


def _answers(problems: ProblemSet, cohort: Cohort) -> str:
    def rows() -> Iterator[str]:
        order = {stem: place for place, stem in enumerate(problems.stems)}
        for (problem, answer), counts in sorted(cohort.verdicts.items(), key=lambda kv: order[kv[0][0]]):
            total = sum(counts.values()) or 1
            heat = "".join(
                f'<td class="heat {v}" style="--share:{counts[v] / total:.3f}">{counts[v]}</td>'
                for v in (*VERDICTS, WAITS)
            )
            found = cohort.items.get((problem, answer))
            figures = "".join(f'<td class="number">{figure}</td>' for figure in _figures(found))
            yield f"<tr><td>{_text(problem)}</td><td>{_text(answer)}</td>{figures}{heat}</tr>"

    header = ("problem", "answer", "mean", "of", "% correct", "item-rest r", *VERDICTS, WAITS)
    return _table("How each answer did, and its verdicts", header, rows(), ITEM_REST)


def _figures(item: Item | None) -> tuple[str, str, str, str]:
    """The mean, the most, the share correct and the correlation of an answer; nothing where there is none."""
    if item is None or item.mean is None or item.share_correct is None:
        return ("", "", "", "")
    r = item.item_rest
    correlation = "" if r is None else f"{r:.2f}"
    return f"{item.mean:.2f}", f"{item.of:g}", f"{100 * item.share_correct:.0f}", correlation


def _slips(cohort: Cohort) -> str:
    found = sorted(cohort.slips.items(), key=lambda kv: (-kv[1], kv[0]))

    def rows() -> Iterator[str]:
        for (problem, answer, code), count in found[:MOST_SLIPS]:
            example = cohort.examples[problem, answer, code]
            kind = SLIPS[code].kind if code in SLIPS else code
            who = _link(cohort, example.student, problem)
            yield _row(*map(_text, (problem, answer, kind, count)), who, _short(example.text))

    header = ("problem", "answer", "slip", "times", "for example", "what is said of it")
    note = _of(MOST_SLIPS, len(found), "commonest")
    return _table("Slips that were found, the commonest first", header, rows(), note)


def _of(most: int, count: int, which: str) -> str:
    return f"The {most} {which} of {count}." if count > most else ""


def _alike(cohort: Cohort) -> str:
    found = [(key, same) for key, same in cohort.alike.items() if len(same.students) > 1]
    found.sort(key=lambda kv: (-len(kv[1].students), kv[0]))

    def rows() -> Iterator[str]:
        for (problem, answer, _), same in found[:MOST_ALIKE]:
            who = ", ".join(_link(cohort, student, problem) for student in same.students[:MOST_NAMED])
            more = " and others" if len(same.students) > MOST_NAMED else ""
            yield _row(*map(_text, (problem, answer, len(same.students))), _short(same.text), who + more)

    hint = "A hint and no accusation: a common slip leads many to the same expression."
    note = f"{hint} {_of(MOST_ALIKE, len(found), 'most frequent')}".strip()
    header = ("problem", "answer", "students", "expression", "who")
    return _table("Wrong answers of the same value, however they are written", header, rows(), note)


def _queue(cohort: Cohort, copies: Set[str]) -> str:
    def rows() -> Iterator[str]:
        for e in cohort.queue[:MOST_WAITING]:
            what = _file(copies, e.what, e.what)
            who = _link(cohort, e.student, e.problem)
            answer = _text(e.answer.answer) if e.answer else ""
            yield _row(who, _hand_in(cohort, copies, e.student, e.problem), answer, what, _text(e.why))

    more = len(cohort.queue) - MOST_WAITING
    note = 'Decide them on <a href="queue.html">the page of the queue</a>, or fill in queue.csv.'
    note += " The problem leads to what was handed in."
    note += f" {more} more are in queue.csv." if more > 0 else ""
    return _table(_waiting(cohort), ("student", "problem", "answer", "what", "why"), rows(), note)


def _waiting(cohort: Cohort) -> str:
    count = len(cohort.queue)
    return "1 entry waits for a human" if count == 1 else f"{count or 'No'} entries wait for a human"


def _by_hand(cohort: Cohort, copies: Set[str]) -> str:
    def rows() -> Iterator[str]:
        for a in cohort.by_hand:
            marks = f"{shown(Fraction(a.marks))} of {shown(Fraction(a.of))}"
            who = _link(cohort, a.student, a.problem)
            yield _row(
                who, _hand_in(cohort, copies, a.student, a.problem), _text(a.answer), marks, _text(a.why)
            )

    return _table("Marks that a teacher has set", ("student", "problem", "answer", "marks", "why"), rows())


def _students(problems: ProblemSet, cohort: Cohort, copies: Set[str]) -> str:
    is_any_late = any(s.late for s in cohort.standings)

    def rows() -> Iterator[str]:
        for s in cohort.standings:
            marks = {
                stem: "waits" if stem in s.unjudged else decimal(s.marks.get(stem, Fraction(0)))
                for stem in problems.stems
            }
            each = (_link(cohort, s.student, stem, text) for stem, text in marks.items())
            deducted = [decimal(s.deducted)] if is_any_late else []
            stems = [stem for stem in problems.stems if (s.student, stem) in cohort.uploads]
            handed_in = " ".join(_hand_in(cohort, copies, s.student, stem) for stem in stems)
            yield _row(_text(called(s.student, cohort.names)), *each, decimal(s.total), *deducted, handed_in)

    caption = "The marks of each student lead to the page that the student reads"
    late = ["for being late"] if is_any_late else []
    return _table(caption, ("student", *problems.stems, "total", *late, "handed in"), rows())


# Students' pages as they travel and are kept: packed, with a place for the marks

HEAD_HERE = "Whose it is, and the marks"
"""Where the page gets its head when it is written: names may be learnt, and marks set, later."""


STYLES_HERE = "/* The styles stand here */"
"""Where a page gets its styles when it is written, for they are the same in all of them."""


def pack(text: str) -> str:
    """A page compressed, for the way from the worker and for the record."""
    text = text.replace(stylesheet(), STYLES_HERE)
    return base64.b64encode(zlib.compress(text.encode("utf-8", errors="replace"), 6)).decode()


def unpack(packed: bytes) -> str:
    """A page out of the record."""
    return zlib.decompress(packed).decode().replace(STYLES_HERE, stylesheet(), 1)


def student_page(report: Report, problem: Problem, hints: int) -> tuple[str, str]:
    """A student's page in HTML and Markdown, packed, but for its head."""
    view = FeedbackView(hints, readings=True)
    blocks = (
        *(Note((fault.message,)) for fault in report.faults),
        *opening(report),
        *slips(report, view),
        *readings(report, view),
        *not_recognized(report),
    )
    return _packed(_rendered(blocks, style_of(problem.robot)))


def bare_page(reason: str) -> tuple[str, str]:
    """The page of a hand-in that could not be judged."""
    said = f"The program could not judge this hand-in: {reason}. It is on your teacher's list."
    return _packed(_only_said(said))


def absent_page() -> tuple[str, str]:
    """The page of what was not handed in, for which a teacher gives marks; as it is, not packed."""
    return _only_said("Nothing was handed in here that the program could judge.")


def _only_said(said: str) -> tuple[str, str]:
    return _rendered((Text((said,)),), PLAIN)


def _packed(pages: tuple[str, str]) -> tuple[str, str]:
    html, markdown = pages
    return pack(html), pack(markdown)


def _rendered(blocks: tuple[Block, ...], style: Style) -> tuple[str, str]:
    from dynsolve.notation.extent import Ruler
    from dynsolve.render.html import render as render_html
    from dynsolve.render.markdown import render as render_markdown

    document, ruler = Document((Text((HEAD_HERE,)), *blocks)), Ruler(style)
    return render_html(document, style, ruler), render_markdown(document, style, ruler)
