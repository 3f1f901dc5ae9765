"""What is held of every mechanism: it is solved in every form, and nothing that is printed is false.

`faults(problem)` gives the faults of one file; none where it is refused with its place and the remedy.
"""

from __future__ import annotations

import math
import re
import traceback
import warnings
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import product
from time import process_time

import dynsolve
from dynsolve import Solution
from dynsolve.document import Block, Document
from dynsolve.errors import InputError
from dynsolve.explain.abbreviations import Abbreviate
from dynsolve.explain.notation_list import COUNTING, notation
from dynsolve.explain.signs import TRANSPOSED, Kind, formulas_in, kind_of, kinds_in, shorthands
from dynsolve.explain.step import Detail
from dynsolve.notation.markup import LatexPrinter
from dynsolve.notation.printing import Style
from dynsolve.notation.tree import Derivative, Letter, Node, Number, Slashed, Symbol, children, walk
from dynsolve.notation.unicode import UnicodePrinter, to_unicode
from dynsolve.problem import read_problem
from dynsolve.render.files import Format
from dynsolve.solution.documents import solution_documents
from dynsolve.solution.reports import rendered, report
from tests.strangers.claims import Mechanism, untrue_sentences
from tests.strangers.fractions import reducible
from tests.strangers.oracle import Point, Unknown, random_point, relations, untrue
from tests.strangers.reading import Unreadable, value_of_latex, value_of_text
from tests.support import explained_once

SECONDS, FEW_JOINTS = 30, 4
"""Processor time of a mechanism of up to four joints in all its forms; a longer arm has four times it."""

READ = 1e-3
"""The relative difference that printed decimals, of four digits and more, may make."""

TOLD_IN_WORDS = {TRANSPOSED, *(("", "name", name) for name in COUNTING)}
TEXTS = (Format.LATEX, Format.HTML, Format.MARKDOWN)

PROGRAM_TEXT = re.compile(
    r"\b(?:Row|Letter|Symbol|Sum|Product|Number|Power|Quotient|Negative|Function|Words|Fraction|Expr|Matrix)\("
    r"|<[a-z]+(?:\.\w+)+ |object at 0x|\bNone\b|\bTrue\b|\bFalse\b|\bnan\b|\binf\b|\d\.\d{13,}"
)


@dataclass(frozen=True)
class Fault:
    """What is wrong: its kind in a word, and where."""

    kind: str
    text: str


class Refused(Exception):
    """The file is no problem that dynsolve takes; the message is what it says."""


def faults(text: str, which: int | None = None) -> list[Fault]:
    """The faults of a problem file; `which` chooses the form that is read as a page, None reads all as text.

    Raises Refused.
    """
    started = process_time()
    found: list[Fault] = []
    with warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("always")
        try:
            found += _faults(text, which)
        except Refused:
            raise
        except Exception as error:  # noqa: BLE001 - whatever it is, it is the fault that is looked for
            place = traceback.extract_tb(error.__traceback__)[-1]
            where = f"{place.filename.rsplit('dynsolve/', 1)[-1]}:{place.lineno}"
            found.append(Fault("crash", f"{type(error).__name__} at {where}: {error}"))
    found += [Fault("warning", str(warning.message)) for warning in told]
    bound = SECONDS * (1 if text.count("theta:") + text.count("{d:") <= FEW_JOINTS else 4)
    if (spent := process_time() - started) > bound:
        found.append(Fault("slow", f"{spent:.0f} s"))
    return found


def _faults(text: str, which: int | None) -> Iterator[Fault]:
    try:
        problem = read_problem(text)
    except InputError as error:
        if all(finding.line and finding.message for finding in error.findings):
            raise Refused(str(error)) from None
        yield Fault("refusal", f"without a place: {error}")
        return
    try:
        solution = explained_once(dynsolve.solve(problem))
    except InputError as error:
        raise Refused(str(error)) from None
    report(solution, Format.JSON)
    ways, seed = list(product(Abbreviate, Detail)), which or 0
    made: dict[int, tuple[Document, ...]] = {}
    documents: list[Document] = []
    for way in Abbreviate:
        names = id(solution.abbreviated(way))  # one object, or None, where two ways have the same names
        if names not in made:
            made[names] = solution_documents(solution, tuple(Detail), None, way)
        documents += made[names]
    point = random_point(solution, seed)
    written_out = [one for way, one in zip(ways, documents, strict=True) if way[0] is Abbreviate.NEVER]
    mechanism = Mechanism(solution, written_out[-1], seed)
    for sentence, why in untrue_sentences(mechanism, *(one.blocks for one in reversed(written_out))):
        yield Fault("claim", f"{sentence.where}: {why}: {sentence}")
    for name, quotient, factor in reducible(solution, seed):
        yield Fault("reducible", f"{name}: {to_unicode(quotient)}, where {to_unicode(factor)} = 0")
    for place, ((abbreviate, detail), document) in enumerate(zip(ways, documents, strict=True)):
        is_chosen = place == seed % len(ways)
        if is_chosen:
            yield from _misread(solution, document, point.again())
            format = TEXTS[seed % len(TEXTS)]
            if format is Format.HTML:  # every depth of it, and the picture
                page = report(solution, format, detail=detail, abbreviate=abbreviate)
            else:
                page = rendered(document, solution.style, format, fragment=False)
            yield from _program_text(page.decode(), format)
        if document in documents[:place]:  # nothing is long enough to be abbreviated
            continue
        for one in untrue(document.blocks, point.again()):
            yield Fault(
                "untrue", f"{one.where}: {to_unicode(one.left)} = {to_unicode(one.right)}: {one.numbers}"
            )
        if which is None or is_chosen or detail is Detail.FULL:  # which has all that the others have
            yield from _unknown_letters(solution, document, abbreviate)
            page = rendered(document, solution.style, Format.TEXT, fragment=False)
            yield from _program_text(page.decode(), Format.TEXT)


def _program_text(page: str, format: Format) -> Iterator[Fault]:
    words = _words(page, format)
    for match in PROGRAM_TEXT.finditer(words):
        yield Fault("program text", f"{format.value}: {_around(words, match)}")


def _misread(solution: Solution, document: Document, point: Point) -> Iterator[Fault]:
    """Formulas that read otherwise, as text or as LaTeX, than they are meant."""
    style = solution.style
    list(untrue(document.blocks, point))  # which defines the letters
    printed = {part for _, relation in relations(document.blocks) for part in walk(relation)}
    for printer, read in ((UnicodePrinter(style), value_of_text), (LatexPrinter(style), value_of_latex)):
        known = [node for node, value in point.known.items() if not value.is_matrix]
        starred = [Symbol(q.name, star=True) for q in solution.robot.coordinates]
        single = [node for node in (*known, *starred, *shorthands(solution.robot, style)) if node in printed]
        signs = {printer.text(node): point.value(node).value for node in single}
        slashed = [node for node in single if isinstance(node, Derivative)]
        signs |= {printer.text(Slashed(node)): point.value(node).value for node in slashed}
        for where, relation in relations(document.blocks):
            for part in relation.parts:
                try:
                    meant = point.value(part)
                except (Unknown, ZeroDivisionError, OverflowError):
                    continue
                if meant.is_matrix or isinstance(part, Symbol | Letter | Number):
                    continue
                text = printer.text(part)
                try:
                    found = read(text, signs)
                except (Unreadable, ZeroDivisionError, OverflowError, ValueError) as error:
                    yield Fault("unreadable", f"{where}: {error}")
                    continue
                if not math.isclose(found, meant.value, rel_tol=READ, abs_tol=READ * max(meant.size, 1e-3)):
                    yield Fault("misread", f"{where}: {text} is {found}, and meant is {meant.value}")


def _unknown_letters(solution: Solution, document: Document, abbreviate: Abbreviate) -> Iterator[Fault]:
    """Signs that are printed and not introduced, or have two meanings."""
    style, blocks = solution.style, document.blocks
    told = notation(solution.robot, style, blocks, solution.abbreviated(abbreviate))
    known = {kind for line in told.lines for kind in line.kinds} | TOLD_IN_WORDS
    for kind in kinds_in(formulas_in(blocks), style) - known:
        yield Fault("letter", f"{kind} is not in the list of notation")
    printer, meanings = UnicodePrinter(style), dict[str, set[Kind]]()
    for node in signs_in(blocks, style):
        kind = kind_of(node, style)
        assert kind is not None
        meanings.setdefault(printer.text(node), set()).add(kind)
    for text, kinds in meanings.items():
        if len(kinds) > 1:
            yield Fault("letter", f"{text} stands for {kinds}")


def signs_in(blocks: tuple[Block, ...], style: Style) -> set[Node]:
    """Every name, letter and shorthand of a report, without the letters inside indices."""
    found: set[Node] = set()
    pending = list(formulas_in(blocks))
    while pending:
        node = pending.pop()
        if kind_of(node, style):
            found.add(node)
        elif not isinstance(node, Letter):
            pending += children(node)
    return found


def _words(page: str, format: Format) -> str:
    """A page without what is no text of it: styles, scripts, drawings and tags of HTML."""
    if format is not Format.HTML:
        return page
    return re.sub(r"<(style|script|svg)\b.*?</\1>|<[^>]*>", " ", page, flags=re.S)


def _around(text: str, match: re.Match[str]) -> str:
    return " ".join(text[max(match.start() - 40, 0) : match.end() + 40].split())
