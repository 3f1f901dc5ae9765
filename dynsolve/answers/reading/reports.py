"""Reports in Markdown, LaTeX and plain text: their displayed equations, in order."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from functools import partial
from itertools import islice
from operator import itemgetter

from msgspec import Struct
from msgspec.structs import replace

from dynsolve.answers.reading.answer_file import read_value
from dynsolve.answers.reading.asides import list_pictures, list_unread, read_aside, spoken_verdicts
from dynsolve.answers.reading.configurations import coordinate_named
from dynsolve.answers.reading.dh_tables import NAME, headed_columns, tables_of, with_equations, without
from dynsolve.answers.reading.displayed_sets import DisplayedSets, headed_sets, read_headed
from dynsolve.answers.reading.displays import Display, continued, is_label
from dynsolve.answers.reading.equation_reader import EquationReader
from dynsolve.answers.reading.grids import MAX_EQUATIONS, MAX_MACRO_LENGTH, MAX_MACROS
from dynsolve.answers.reading.lexer import Macro, Token, closing_brace, tokenize
from dynsolve.answers.reading.matrix_parts import said_zero, shown
from dynsolve.answers.reading.plain_text import AnswerNames, plain_lines
from dynsolve.answers.reading.prepare import prepared
from dynsolve.answers.reading.report_text import IN_SENTENCE, is_of_case, said_of, taken_from, visible
from dynsolve.answers.reading.sources import HIDDEN, Source, hidden
from dynsolve.answers.verdict import NotRecognized, VerdictAnswer
from dynsolve.errors import ReadError
from dynsolve.questions.equilibria import LINEAR_A

_ENVIRONMENT = (
    "equation|align|gather|multline|eqnarray|alignat|flalign|xalignat|displaymath|math|dmath|IEEEeqnarray"
    "|subequations|split|empheq"
)
_OPENING = re.compile(
    rf"(?P<dollars>\$\$)|(?P<bracket>(?<!\\)\\\[)|(?P<double>\\\\\[)|\\begin\{{(?P<environment>(?:{_ENVIRONMENT})\*?)\}}"
    rf"(?:(?:\[[^\[\]\n]{{0,60}}\])?\{{(?:[0-9]{{1,2}}|[rclsCRLS?.'\" ]{{1,20}}|(?:{_ENVIRONMENT})\*?)\}})?"
    r"|(?P<fence>^[ \t]{0,3}(?:```|~~~)[^\n]*$)|(?P<inline>(?<![\\$])(?<!,t)(?<!, t)\$(?![\s$])|(?<!\\)\\\()",
    re.MULTILINE,
)
_LABEL = re.compile(r"[ \t]*(?:\n[ \t]*){0,2}\(([0-9]{1,3}(?:\.[0-9]{1,3})?[a-z]?)\)[ \t]*(?=\n|$)")
_MACRO = re.compile(
    r"\\(?:(?:re)?newcommand|providecommand|DeclareMathOperator)\*?\s{0,20}(?:\{\s{0,9}\\(?P<name>[A-Za-z]{1,60})\s{0,9}\}"
    r"|\\(?P<bare>[A-Za-z]{1,60}))\s{0,20}(?:\[(?P<count>[0-9])\])?\s{0,20}(?=\{)"
    r"|\\def\s{0,20}\\(?P<defined>[A-Za-z]{1,60})(?P<hash>#1)?\s{0,20}(?=\{)"
)
_MAYBE_LABEL = re.compile(r"[\s~]*[(\\]")
_BLANK_LINE = re.compile(r"\n[ \t]*\n")
_SAYS = re.compile(
    r"(?<![\w$\\])(\$[^$\n=]{1,30}\$|(?!and |is |it |as )[^\W\d_]\w{0,9}(?:\{\w{1,6}\})?)[ \t\n}\]*]{0,4}"
    r"(?:[ \t\n](?:is|are|being|denotes|equals|means|stands for|(?:must|has to) be|er|ist)[ \t\n]{1,3}"
    r"|(?P<sign>:|:?=|&|\])[ \t\n}\]*]{0,5})\Z"
)
_HEADING = re.compile(
    r"(?m)^[ \t]*(?:#{1,6}[ \t]+|\*\*|\\(?:sub){0,2}section\*?\{|\\paragraph\{)"
    r"(\$[^$\n=]{1,30}\$|[^\W\d_]\w{0,9})[:*}#]{0,4}[ \t]*\n[ \t\n]{0,9}\Z"
)
_FOR = re.compile(
    r"\b(?:writ\w+|us(?:e|ing)|put\w*|denot\w+|schreib\w+|verwend\w+|setz\w+|skriv\w+|bruk\w+)\b[^.;\n=]{0,80}?"
    r"\$([^$=]{1,30})\$[ \t\n]+(?:for|für|instead of|in place of|statt|anstelle von|i stedet for)[ \t\n]+\Z",
    re.IGNORECASE,
)
"""What says that a letter is another: `we write $z$ for`."""

_EQUALS = re.compile(r"=|[≡≜≈]|\\(?:triangleq|equiv|coloneqq|doteq|approx)(?![A-Za-z])")
_ALONE = re.compile(r"[ \t>*+-]*(?:[0-9]+[.)][ \t]+)?\Z")
_AND = "(?:and|og|und|y)"
_BESIDE = re.compile(
    rf"(?:(?:^|[ \t,]){_AND}[ \t]+)?\$[^$\n]*=[^$\n]*\$[ \t]*[,;.]?[ \t]*(?:{_AND}[ \t])?"
    rf"|(?:^|[ \t,]){_AND}[ \t]*$"
)
"""Another equation on the same line, with the word between the two."""

_BRACE = re.compile(r"\\(?:under|over)brace[ \t]*\{")
_UNDER = re.compile(r"[ \t]*[_^][ \t]*\{?[ \t]*([KTPVU])[ \t]*(?:\}|(?![A-Za-z_]))")

_LEFT_EMPTY = re.compile(r"[^=]{1,60}=\s*")
"""A display in which nothing stands behind the sign: an answer of a template that was not filled in."""

_MARGIN = 400
"""So far from an equation it is seen whether it stands alone on its line."""


class MacroDefinition(Struct, frozen=True):
    """A macro with the offset from which it holds."""

    offset: int
    name: str
    macro: Macro


def read_report(reader: EquationReader, source: Source, latex: bool = False) -> None:
    """Read the displayed equations of a report, in order, with the macros that hold for each."""
    text, macros = _macros(visible(source.text, latex))
    names = [q.name for q in reader.vocabulary.coordinates]
    tables = tables_of(text, names) if NAME in reader.vocabulary.quantities else []
    text = without(text, tables)
    verdicts = list[VerdictAnswer]()
    if "definite" in reader.vocabulary.quantities:
        verdicts, text = spoken_verdicts(reader.vocabulary.candidates, source, text)
    headed = headed_sets(text, reader)
    text = hidden(text, ((one.start, one.end) for one in headed))
    names_answer = AnswerNames(reader.vocabulary)
    columns = list[tuple[int, Display]]()
    if not latex:
        text, columns = headed_columns(text, source, names_answer)
        text = with_equations(text, names_answer)
    spans = list(
        islice(_displays(text, source, names_answer, partial(_is_coordinate, reader)), 2 * MAX_EQUATIONS)
    )
    displays = _labelled([(start, display) for start, _, display in spans if display is not None])
    displays = sorted([*displays, *columns], key=itemgetter(0))
    is_plain = all(display.aside for _, display in displays)
    if is_plain or not latex:
        rest = hidden(text, ((start, end) for start, end, _ in spans), HIDDEN)
        lines = islice(_plain(rest, source, 0, len(text), names_answer, not is_plain), MAX_EQUATIONS)
        displays = sorted([*displays, *lines], key=itemgetter(0))
    read = [(start, start + len(display.text)) for start, display in displays]
    displays, unread = continued(displays[:MAX_EQUATIONS]), displays[MAX_EQUATIONS:]
    displays = [each for each in displays if not _LEFT_EMPTY.fullmatch(each[1].text)]
    while True:
        waiting = list(reversed(macros))
        sets = DisplayedSets(reader, source, text, {one.name for one in headed})
        for table in tables:
            read_value(reader, NAME, source.place(table.start, 1), table.value.display(source))
        read_headed(reader, source, headed)
        reader.found.verdicts += verdicts
        for offset, display in displays:
            while waiting and waiting[-1].offset <= offset:
                found = waiting.pop()
                reader.macros[found.name] = found.macro
            if display.aside:
                read_aside(reader, display)
            else:
                first = reader.equations
                sets.read_display(offset, display)
                for part in _under_braces(display):
                    read_aside(reader, part)
                if display.in_case:
                    numbers = range(first + 1, reader.equations + 1)
                    reader.found.in_case.update(dict.fromkeys(numbers, display.in_case))
        sets.settle()
        if not reader.begins_anew():
            break
    for _, display in unread[:1]:
        place = display.locate(0, 1)
        why = f"only the first {MAX_EQUATIONS} equations of a file are read"
        reader.found.not_recognized.append(NotRecognized(shown(display.text), display.label, place, why))
    reader.found.others_zero += said_zero(source, text)
    list_unread(reader, source, hidden(text, read, HIDDEN))
    list_pictures(reader, source, text)


def _is_coordinate(reader: EquationReader, text: str) -> bool:
    """Whether a text is a coordinate; of a model that is linear at a point none makes a special case."""
    return LINEAR_A.name not in reader.vocabulary.quantities and bool(
        coordinate_named(reader.vocabulary, text)
    )


def _macros(text: str) -> tuple[str, list[MacroDefinition]]:
    """The student's commands, and the text with blanks in their place."""
    found: list[MacroDefinition] = []
    pieces: list[str] = []
    done = tried = 0
    for match in _MACRO.finditer(text):
        if match.start() < done:
            continue
        tried += 1
        if tried > MAX_MACROS:
            break
        try:
            end = closing_brace(text, match.end(), MAX_MACRO_LENGTH)
            body = _body(text[match.end() + 1 : end - 1])
        except ReadError:
            continue
        name = match["name"] or match["bare"] or match["defined"]
        takes = 1 if match["count"] or match["hash"] else 0
        if not match["count"] or match["count"] == "1":
            found.append(MacroDefinition(match.start(), name, Macro(tuple(body), takes)))
        pieces += [text[done : match.start()], " " * (end - match.start())]
        done = end
    return "".join([*pieces, text[done:]]), found


def _body(text: str) -> list[Token]:
    tokens: list[Token] = []
    for number, piece in enumerate(text.split("#1")):
        if number:
            tokens.append(Token("argument", "#1", 0, 0))
        tokens += tokenize(piece)[:-1]
    return tokens


def _displays(
    text: str, source: Source, names_answer: AnswerNames, is_coordinate: Callable[[str], bool]
) -> Iterator[tuple[int, int, Display | None]]:
    """The displayed equations of a text with their spans; a span without one is a formula in a sentence."""
    position = 0
    exhausted: set[str] = set()
    while (opening := _OPENING.search(text, position)) is not None:
        kind = str(opening.lastgroup)
        start = opening.end()
        closing = _closing(kind, opening[kind])
        end = -1 if closing in exhausted else text.find(closing, start)
        if end < 0:
            exhausted.add(closing)
            position = start
            if kind in ("fence", "inline"):
                continue
            blank = _BLANK_LINE.search(text, start)
            end, closing = blank.start() if blank else len(text), ""
        position = end + len(closing)
        if kind == "fence":
            if any(word in opening.group() for word in ("math", "latex", "tex")):
                yield start, end, _display(text, source, start, end, "")
            else:
                for at, display in _plain(text, source, start, end, names_answer, False):
                    yield at, at + len(display.text), display
            yield opening.start(), position, None
            continue
        if kind == "inline":
            if end - start > 5_000 or "\n\n" in text[start:end]:
                position = start
                continue
            if not _EQUALS.search(text, start, end):
                said = _said_to_be(text, source, opening.start(), start, end, names_answer)
                yield opening.start() if said is None else end - len(said.text), position, said
                continue
            if not _stands_alone(text, opening.start(), position):
                why = said_of(text, opening.start(), position, is_coordinate)
                yield start, end, replace(_display(text, source, start, end, ""), aside=why)
                continue
        label = _LABEL.match(text, position)
        said = (
            None
            if _EQUALS.search(text, start, end)
            else _said_to_be(text, source, opening.start(), start, end, names_answer)
        )
        if said is not None:
            yield end - len(said.text), end, said
            continue
        why = "" if kind == "inline" else taken_from(text, opening.start(), position, is_coordinate)
        display = _display(text, source, start, end, f"({label[1]})" if label else "")
        in_case = why if is_of_case(why) else ""
        yield start, end, replace(display, aside="" if in_case else why, in_case=in_case)


def _said_to_be(
    text: str, source: Source, opening: int, start: int, end: int, names_answer: AnswerNames
) -> Display | None:
    """What a formula is said to be: `where h is $-m_2 l_1$` is h = -m_2 l_1, `P: $m g l$` is P = m g l.

    Below a heading that is a name it is that.
    """
    said = _FOR.search(text, max(opening - 120, 0), opening)
    said = said or _SAYS.search(text, max(opening - 60, 0), opening)
    said = said or _HEADING.search(text, max(opening - 60, 0), opening)
    if said is None:
        return None
    name = said[1].replace("$", " ")
    is_answer = said.re is _HEADING or (said.re is _SAYS and said["sign"])
    if is_answer and not names_answer(name.strip()):
        return None
    formula = text[start:end].rjust(end - said.end(1) - 1)
    display = _display(text, source, said.start(1), end, "")
    return replace(display, text=f"{name}={formula}", aside=IN_SENTENCE)


def _stands_alone(text: str, start: int, end: int) -> bool:
    """Whether a list's mark, other equations and a number are all that stands beside an equation."""
    _, line_end, before = text[max(start - _MARGIN, 0) : start].rpartition("\n")
    after = _BESIDE.sub("", text[end : end + _MARGIN].partition("\n")[0]).strip(" \t.,;()0123456789")
    is_line = bool(line_end) or start <= _MARGIN
    return is_line and not after and _ALONE.fullmatch(_BESIDE.sub("", before)) is not None


def _under_braces(display: Display) -> Iterator[Display]:
    r"""The energies that braces name in a Lagrangian: `L = \underbrace{...}_{T} - \underbrace{...}_{V}`."""
    for found in _BRACE.finditer(display.text):
        try:
            end = closing_brace(display.text, found.end() - 1)
        except ReadError:
            return
        if named := _UNDER.match(display.text, end):
            text = f"{named[1]}={display.text[found.end() : end - 1]}"
            yield replace(display.behind(found.end() - 2), text=text, aside=IN_SENTENCE)


def _closing(kind: str, opened: str) -> str:
    if kind == "environment":
        return f"\\end{{{opened}}}"
    if kind == "fence":
        return "\n" + opened.strip()[:3]
    return {"$$": "$$", "\\[": "\\]", "\\\\[": "\\\\]", "\\(": "\\)", "$": "$"}[opened]


def _display(text: str, source: Source, start: int, end: int, label: str, plain: bool = False) -> Display:
    return Display(text[start:end], label, source.behind(start, max(end - start - 1, 0)), plain)


def _plain(
    text: str, source: Source, start: int, end: int, names_answer: AnswerNames, among_others: bool
) -> Iterator[tuple[int, Display]]:
    """Equations in plain text; beside displayed ones a line that cannot be read may be a sentence."""
    for at, formula in plain_lines(text, start, end, names_answer):
        display = _display(text, source, at, at + len(formula), "", plain=True)
        yield at, replace(display, text=formula, among_prose=among_others)


def _labelled(displays: list[tuple[int, Display]]) -> list[tuple[int, Display]]:
    """A display that holds a number alone is the number of the one before it."""
    found: list[tuple[int, Display]] = []
    for offset, display in displays:
        label = _label_alone(display.text)
        if not label:
            found.append((offset, display))
        elif found and not found[-1][1].label:
            found[-1] = (found[-1][0], replace(found[-1][1], label=label))
    return found


def _label_alone(text: str) -> str:
    """The number of an equation, if the text of a display is nothing else."""
    if len(text) > 40 or not _MAYBE_LABEL.match(text):
        return ""
    try:
        return is_label(prepared(text))
    except ReadError:
        return ""
