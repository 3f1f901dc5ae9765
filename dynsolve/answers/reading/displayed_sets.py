r"""Sets in the displays of a report, where no name stands before them.

    $$ \det J = l_1 l_2 \sin q_2 = 0 \Rightarrow q_2 = 0, \pi $$
    $$ q_2 = \pm\arccos\frac{x^2 + y^2 - l_1^2 - l_2^2}{2 l_1 l_2} $$

A display of equations that name coordinates alone on the left, with the values of the task on the right,
is part of a branch of the inverse kinematics.  One of equations in coordinates is an alternative of
`singular` or `equilibria` where the words before it speak of these.

Sets in the lines of a report that a head names, as `Equilibria: $\theta = 0$ or $\theta = \pi$`.

The head is a name of the set, with a colon behind it; what follows on its
line, or the items of the list below, are the alternatives.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence, Set
from functools import cached_property
from itertools import islice

from msgspec import Struct, field
from msgspec.structs import replace

from dynsolve.answers.reading.configurations import (
    are_motions,
    coordinate_named,
    function_named,
    is_set,
    names_within,
    read_configurations,
    read_equations,
)
from dynsolve.answers.reading.displays import Display
from dynsolve.answers.reading.equation_reader import EquationReader
from dynsolve.answers.reading.left_side import NamedAnswers, side_of
from dynsolve.answers.reading.report_text import QUOTED, REJECTED, SUPPOSED
from dynsolve.answers.reading.set_text import (
    ALL,
    AND,
    ANNOUNCED,
    ARBITRARY,
    CASE,
    DENIED,
    FOLLOWS,
    HEADS,
    OR,
    REGARDLESS,
    SAID,
    SO,
    STABLE,
    WITHOUT_MULTIPLIERS,
    held_together,
    in_signs,
    joined,
    space_named,
    span_text,
)
from dynsolve.answers.reading.sources import Source, placed
from dynsolve.answers.verdict import Place
from dynsolve.quantities.family import Kind
from dynsolve.quantities.letters import key
from dynsolve.questions.constraints import REDUCED

# Sets in the lines of a report that a head names, as `Equilibria

_MARK = (
    r"(?:[ \t>*_#+$|-]|\(?(?:[0-9]{1,2}|[A-Za-z])[.)](?=[* \t])|\\(?:item|noindent|par|quad|,|;|:|!|\[|\())*"
)
_FONT = r"(?:\\(?:text\w{0,2}|emph|underline|paragraph\*?|(?:sub){0,2}section\*?|math(?:rm|bf))[ \t]*\{)?"
_HEAD = r"(?P<head>[^\W\d_](?:[^\W\d_]|[ \t'-]){2,60}?)[*_ \t}]*"
_POINT = r"(?:[ \t]*\$?\([^()=\n]{1,60}\)\$?[ \t]*)?"
"""The coordinates in their order, behind a head: `$(q_1, q_2)$`."""

_LINE = re.compile(
    rf"(?m)^{_MARK}(?P<shown>{_FONT}[*_]*{_HEAD}"
    rf"(?:{_POINT}(?:[:=]|\.(?=[*_ \t}}]*\$))[*_ \t}}]*(?P<value>[^\n]*)|(?P<alone>)))$"
)
_ITEM = re.compile(
    r"\n(?:[ \t]*\n)?(?:[ \t]*\\begin\{(?:itemize|enumerate)\}[^\n]*\n)?"
    r"[ \t]*(?:[-*+•]|\(?[0-9a-z]{1,2}[.)]|\\item\b)[ \t]*(?P<value>[^\n]*)"
)
_EQUATION = re.compile(r"\n(?![ \t]*(?:\\begin|\\\[|\$\$))(?P<value>[^\n=:]+=[^\n=]+)")
_DISPLAY = re.compile(
    r"\$\$(?P<dollars>.+?)(?:\$\$|\Z)|\$(?P<inline>[^$\n]+)\$|\\\[(?P<bracket>.+?)(?:\\\]|\Z)"
    r"|\\begin\{(?P<name>(?:equation|align|gather|eqnarray|multline)\*?)\}(?P<rows>.+?)(?:\\end\{(?P=name)\}|\Z)",
    re.DOTALL,
)
_SENTENCE = re.compile(r"[.;!?](?=\s)|\n[ \t]*\n|\n(?=[ \t]*(?:#|\\(?:sub){0,2}section))")
_NEXT = re.compile(r"[ \t\n.,;]*(?:(?:and|und|og)[ \t\n]*)?")
"""What stands between displays that one sentence announces."""

_HEADED_SETS_REMARK = re.compile(
    r"(?<!\w)\((?=[^()=\\]*[^\W\d_]{4})[^()=\\*^_]*\)(?!\s*(?:=|∈|\\in))"
    rf"|,?[ \t]+(?:both |all |beide |begge )?(?:{STABLE})\b|^[ \t]*(?:{STABLE})[ \t]*:",
    re.IGNORECASE,
)
_NAME = r"\$?\\?[A-Za-z]\w{0,9}(?:_\{?\w{1,3}\}?)?\$?"
_TURN = r"(?:2[ \t]*(?:\\pi|π)|360(?:°|\^\{?\\circ\}?))"
_HALF = r"(?:\\pi|π|180(?:°|\^\{?\\circ\}?))"
_WHOLE_LINE = (
    rf"(?:(?:\\mathbb[ \t]*\{{?[ \t]*)?[Rℝ]\}}?(?![A-Za-z])|[\[(][ \t]*0[ \t]*,[ \t]*{_TURN}[ \t]*[\])\[]"
    rf"|[\[(\]][ \t]*[-−–][ \t]*{_HALF}[ \t]*,[ \t]*{_HALF}[ \t]*[\])\[])"
)
_ANY = (
    rf"\b(?:{ALL})[ \t]+(?:(?:values? of|Werte?|verdi(?:er)? av)[ \t]+)?{_NAME}"
    rf"(?:[ \t]*(?:∈|\\in\b)[ \t]*{_WHOLE_LINE}\$?)?"
    rf"|\b(?:{REGARDLESS})[ \t]+{_NAME}"
    rf"|{_NAME}[ \t]+(?:(?:is|are|being|may be|can be|ist|er)[ \t]+)?(?:{ARBITRARY})\b[,;]?"
    rf"|{_NAME}[ \t]*(?:∈|\\in\b)[ \t]*{_WHOLE_LINE}\$?(?:[ \t]*(?:{ARBITRARY})\b)?"
)
ANY = re.compile(
    rf"[ \t]{{0,9}}\((?:{_ANY})\)"
    rf"|[,;]?[ \t]{{0,9}}(?:\b(?:with|for|where|mit|bei|für|med|ved|{AND})[ \t]+)?(?:{_ANY})"
)
_DECORATION = re.compile(r"\\bar\b\s*|(?<=[\w}])(?:_\{?eq?\}?(?![A-Za-z0-9])|\^\{?\*\}?)")
_LEADING = re.compile(rf"\A(?:[\s,;]|(?:{AND}|with|for|mit|für|med|ved)\s)+")
_TUPLE = re.compile(r"\(([^()=]{1,80}(?:\([^()]{1,40}\)[^()=]{0,40})?)\)")
_BETWEEN = re.compile(rf"(?:\s|,|;|\b(?:{AND}|{OR})\b|=|∈|\\in\b|\\?[{{}}])*")
_TRAILING = re.compile(r"(?:[\s.,;]|\\\]|\\\)|\\\\|\$\$)+\Z")
_REST = re.compile(
    rf"(?<=\$)[ \t]*(?:\.[ \t]+|[,;][ \t]+(?!(?:.*[ \t])?(?:{AND}|{OR})[ \t]))[^\W\d_][^$=∈\\<>]*\Z"
)
"""What a sentence goes on with behind the last formula of a set."""

_RELATION = re.compile(r"=|∈|\\in\b|\bnone\b|\bno\b")
_MATHEMATICS = re.compile(r"\$|\\[()\[\]]")
_CLOSING = re.compile(r"(?:\\\]|\\\)|\$\$?)[ \t.,;]*\Z")
_PAIRS = (("\\[", "\\]"), ("\\(", "\\)"))
_BLANK = " \t$*_}"
_BLANKS = re.compile(r"[ \t]+")
_MOST = 200
"""So many lines are looked at."""


class HeadedSet(Struct, frozen=True):
    """What stands behind the head of a set, between two offsets of the report."""

    name: str
    start: int
    end: int
    text: str


def headed_sets(text: str, reader: EquationReader) -> list[HeadedSet]:
    """The sets that heads name in a report."""
    asked = [name for name in HEADS if name in reader.vocabulary.quantities]
    coordinates = [q.name for q in reader.vocabulary.coordinates]
    found: list[HeadedSet] = []
    for line in _LINE.finditer(text) if asked else ():
        name = next((name for name in asked if HEADS[name].fullmatch(line["head"])), "")
        if name and len(found) < _MOST and line.start() >= (found[-1].end if found else 0):
            end, values = _values(text, line, has_lines=name == REDUCED.name)
            value = _value(values, coordinates, is_joined=name != "singular")
            if value and _RELATION.search(value):
                start = line.start("shown")
                found.append(HeadedSet(name, start, _before_closing(text, start, end), value))
    if REDUCED.name in asked and REDUCED.name not in {one.name for one in found}:
        found += _announced_motions(text, reader)
    return found


def _announced_motions(text: str, reader: EquationReader) -> Iterator[HeadedSet]:
    """The equations of motion of which the sentence before them says that they are without multipliers."""
    start, end, values = 0, 0, list[str]()
    is_led = False
    for display in islice(_DISPLAY.finditer(text), _MOST):
        goes_on = _NEXT.fullmatch(text, end, display.start()) is not None
        if values and not goes_on:
            yield HeadedSet(REDUCED.name, start, end, " ; ".join(values))
            values = []
        sentence = _SENTENCE.split(text[max(end, display.start() - _BEFORE) : display.start()].rstrip())[-1]
        is_led = (is_led and goes_on) or WITHOUT_MULTIPLIERS.search(sentence) is not None
        rows = _rows(next(filter(None, display.group("dollars", "inline", "bracket", "rows"))))
        value = " ; ".join(held_together(_plain(row)) for row in rows)
        if is_led and "=" in value and len(value) < _LONGEST and are_motions(reader.vocabulary, value):
            start = start if values else display.start()
            values.append(value)
        if "=" in value:
            end = display.end()
    if values:
        yield HeadedSet(REDUCED.name, start, end, " ; ".join(values))


def _values(text: str, line: re.Match[str], has_lines: bool) -> tuple[int, list[str]]:
    """Where the values of a head end, and these: those of its line, else the items of the list below.

    Where it `has_lines`, these may be equations without the mark of a list.
    """
    if (line["value"] or "").strip(_BLANK):
        return line.end(), [line["value"]]
    end, values = line.end(), list[str]()
    while len(values) < _MOST and (item := _ITEM.match(text, end)) is not None:
        values.append(item["value"])
        end = item.end()
    while has_lines and len(values) < _MOST and (item := _EQUATION.match(text, end)) is not None:
        values.append(item["value"])
        end = item.end()
    return end, values


def _before_closing(text: str, start: int, end: int) -> int:
    """The end without the sign that closes a display which was opened before the start."""
    shown = text[start:end]
    closing = _CLOSING.search(shown)
    is_inside = shown.count("$") % 2 == 1 or any(shown.count(a) < shown.count(b) for a, b in _PAIRS)
    return start + closing.start() if closing is not None and is_inside else end


def _value(values: list[str], coordinates: Sequence[str], is_joined: bool) -> str:
    """The values as alternatives of one text, without dollars, and what is said of them beside.

    `is_joined` says that commas of a single value part what holds together.
    """
    plain = []
    for value in values:
        value = _REST.sub("", ANY.sub("", _BLANKS.sub(" ", value)))
        value = _MATHEMATICS.sub(" ", _DECORATION.sub("", ANY.sub("", _HEADED_SETS_REMARK.sub("", value))))
        plain.append(_points(_LEADING.sub("", _TRAILING.sub("", value)).strip(), coordinates))
    return held_together(plain[0]) if is_joined and len(plain) == 1 else " ; ".join(plain)


def _points(text: str, coordinates: Sequence[str]) -> str:
    """Points in parentheses as one set: `(q_1, q_2) = (0, 0), (pi, 0)`; any other text as it is."""
    tuples = [found[1] for found in _TUPLE.finditer(text)]
    rest = _TUPLE.sub("", text)
    sizes = {one.count(",") + 1 for one in tuples}
    if not tuples or _BETWEEN.fullmatch(rest) is None or sizes != {len(coordinates)}:
        return text
    names = ", ".join(coordinates)
    if "=" in rest or "∈" in rest or "\\in" in rest:
        names, *tuples = tuples
    return f"({names}) ∈ {{{', '.join(f'({one})' for one in tuples)}}}"


def read_headed(reader: EquationReader, source: Source, found: Iterable[HeadedSet]) -> None:
    """Read sets that were found, each as an answer file gives it."""
    for one in found:
        read_configurations(reader, one.name, source.place(one.start, 1), one.text, None)


_BEFORE = 600
"""So far before a display its words are looked for."""

_INLINE = r"\$[^$\n]{1,200}\$"
_SAID = r"(?:\s{0,9}\([^()$\n]{1,60}\))?"
_BORDER = re.compile(
    r"[.;!?](?=\s)|(?<![\s:,])[ \t]*\n[ \t]*\n|(?m:^[ \t]*(?:#|\\(?:sub){0,2}section)[^\n]*$)"
)
"""Where a sentence ends: a colon leads on to what stands below it."""

_JOINED = re.compile(rf"\W*(?:{AND}|{OR})\b", re.IGNORECASE)
_GOING_ON = re.compile(r"\A[$\s]+(?=[a-zæøåäöü])")
"""What parts a display from the sentence that it stands in."""

_FORMULAS = re.compile(
    rf"(?<![$\\]){_INLINE}(?:{_SAID}(?:\s{{0,9}},|(?:\s{{0,9}},)?\s{{1,9}}(?:{OR}|{AND}|{SO}))\s{{0,9}}{_INLINE}){{0,8}}"
)
"""Formulas in a sentence, one behind the other, with what is said of one in parentheses."""

_REMARK = re.compile(r"\$\s{0,9}\([^()$\n]{1,60}\)")

_MOST_FORMULAS = 500
_MOST_ROWS = 100
"""A display of more rows is read as a whole."""
_LONGEST = 20_000
"""A display of more characters is no set."""
_MOST_MEMBERS = 20
"""A longer chain defines no letter on its way."""

_LAYOUT = re.compile(
    r"\\(?:label|tag)\*?\{[^{}]*\}|\\(?:begin|end)\{(?:aligned|cases|split|array)\}(?:\{[lcr]*\})?"
)
_GOES_ON = re.compile(r"\s*&?\s*[-+=]")
_ROW = re.compile(r"\\\\(?:\[[^\[\]]{0,20}\])?")
_SIGN = re.compile(r":\s*=|=\s*:|\\coloneqq\b|\\eqqcolon\b")
_OWN = re.compile(r"\s*\\?[A-Za-z]{1,7}(?:_\{?\w{1,3}\}?)?\s*")
_ALIGN = re.compile(r"&\s*(?=:?\s*=)|(?<==)\s*&")
_ARROW = re.compile(rf"{FOLLOWS.pattern}|\\to\b|→")
_EITHER_SIGN = re.compile(rf"=\s*\+?\s*([^\s=;+-][^=;]{{0,200}}?)\s*,?\s+(?:{OR})\s+-\s*\1(?![\w(^])")
_VANISHES = re.compile(r"[^$.]{0,20}(?:vanish|zero|verschwind|null|forsvinn)")
_IS_STATEMENT = re.compile(r"=|\\in\b|∈")
_ZERO = re.compile(r"=\s*0(?:\s|\\[,;:! ]|\\q?quad|[.,;])*\Z")
_IS_ZERO = re.compile(r"=\s*0(?![\w.,]?\d)")
_DETERMINANT = re.compile(
    r"\s*(?:\\?det\b|\||\\lvert|\\left\s*\||\\mathrm\{det\}|\\operatorname\{det\})[^=]*="
)


class DisplayedSets(Struct, dict=True):
    """Gathers the sets of one report; `text` is the report, `told` are those that it gives behind a head."""

    reader: EquationReader
    source: Source
    text: str
    told: Set[str] = frozenset()
    found: dict[str, tuple[Place, list[str]]] = field(default_factory=dict)

    @cached_property
    def _asked(self) -> list[str]:
        """The sets that are asked for."""
        return [name for name in ANNOUNCED if name in self.reader.vocabulary.quantities]

    def read_display(self, offset: int, display: Display) -> None:
        """Read a display without the equations of a set, which are kept."""
        display = self._space(display) or display
        if len(display.text) > _LONGEST or not self._asked:
            self.reader.read_display(display)
            return
        rows = [self._without_own(display, row) for row in _rows(display.text)]
        words = self.text[max(offset - _BEFORE, 0) : offset] + _plain(display.text.partition("=")[0])
        spoken, end = self._spoken_of(words), offset + len(display.text)
        is_case = spoken in SAID and self._is_case(spoken, offset)
        texts = [self._text(words, row) for row in rows]
        is_other = is_case and not self._is_said_of_case(spoken, offset, end)
        if is_other or not any(self._may_be_one(words, text) for text in texts):
            self.reader.read_display(display)
            return
        for row, text in zip(rows, texts, strict=True):  # what one defines may stand in the next
            name = self._set_of(words, text)
            if name is not None:
                where = display.locate(0, len(display.text))
                self.found.setdefault(name, (where, []))[1].append(text)
            left = row if name is None else _determinant(row)
            if left:
                self.reader.read_display(replace(display, text=left))

    def _text(self, words: str, row: str) -> str:
        """The equations of a row; those of an equilibrium hold together."""
        text = _plain(row)
        return held_together(text) if self._spoken_of(words + text) == "equilibria" else text

    def _without_own(self, display: Display, row: str) -> str:
        r"""A row without what it defines beside a coordinate: `\cos q_2 = ... =: D`, `q_2 = ..., D = ...`."""
        equations = joined(_plain(row))
        if len(equations) > 1:
            own = [one for one in equations if "=" in one and self._is_own(one.partition("=")[0])]
            left = [one for one in equations if one not in own]
            if not (own and left) or not all(self._is_unknown(one.partition("=")[0]) for one in left):
                return row
            for one in own:
                self.reader.read_display(replace(display, text=one))
            return " and ".join(left)
        members = _plain(row).split("=")
        if not 3 <= len(members) <= _MOST_MEMBERS:
            return row
        unknown = [member for member in members if self._is_unknown(member)]
        own = [member for member in members if self._is_own(member)]
        if not unknown or len(own) != 1 or len(own) + len(unknown) == len(members):
            return row
        value = next(member for member in reversed(members) if member not in (*own, *unknown))
        self.reader.read_display(replace(display, text=f"{own[0]} = {value}"))
        return "=".join(member for member in members if member not in own)

    def _is_own(self, text: str) -> bool:
        """Whether a text is a name that means nothing in the problem."""
        is_known = key(text.strip().lstrip("\\")) in self.reader.vocabulary.symbols
        return bool(_OWN.fullmatch(text)) and not is_known and not self._is_unknown(text)

    def _space(self, display: Display) -> Display | None:
        r"""`\mathcal{N}(J) = span{...}` as the vectors of an answer; None for any other display."""
        left, sign, right = display.text.partition("=")
        name = space_named(left)
        if not sign or not name or not self.reader.vocabulary.named_of_kind(name, Kind.SPAN):
            return None

        def is_name(word: str) -> bool:
            return self.reader.vocabulary.symbol(key(word)) is not None

        return replace(display, text=f"{name} = {span_text(placed([(right, 0)]), is_name).text}")

    def settle(self) -> None:
        """Make the answers of what was gathered; where no display has a set, of what a sentence says."""
        for name in ("singular", "equilibria"):
            if name in self.reader.vocabulary.quantities and name not in {*self.told, *self.found}:
                self._read_sentence(name)
        if "inverse" in self.reader.vocabulary.quantities and "inverse" not in self.told:
            self._read_branches()
        for name, (place, texts) in self.found.items():
            read_equations(self.reader, name, texts, place)
            sets = self.reader.found.configurations
            if (unread := self._unread(name, place, texts)) and not sets[-1].fault:
                fault = f"a part of it could not be read: {unread}"
                sets[-1] = replace(sets[-1], alternatives=(), fault=fault)

    def _unread(self, name: str, place: Place, texts: Sequence[str]) -> str:
        """An equation that belongs to a set and was not read with it: the set is not judged by a part."""
        given = self._coordinates(texts) if name == "inverse" else set()
        for one in (*self.reader.found.not_recognized, *self.reader.found.left_alone):
            text = _plain(one.text)
            if name not in one.answers or any(text in other for other in texts):
                continue
            if name == "inverse":
                is_part = bool(given) and not self._coordinates([text]) <= given  # it gives one more
            else:
                words = one.place.excerpt[: one.place.column - 1].rpartition(".")[2]
                is_said = one.place.line == place.line and one.why not in (SUPPOSED, REJECTED, QUOTED)
                is_denied = DENIED.search(words) or CASE.search(words)
                is_part = is_said and not is_denied and is_set(self.reader.vocabulary, text)
            if is_part:
                return one.text
        return ""

    def _read_branches(self) -> None:
        r"""`Then $q_1 = \arctan\frac{y}{x}$.`: of the coordinates those that no display gives."""
        given = self._coordinates(self.found["inverse"][1] if "inverse" in self.found else ())
        for found in islice(_FORMULAS.finditer(self.text), _MOST_FORMULAS):
            formulas = _in_words(found[0])
            named = self._coordinates([formulas])
            is_new = bool(named) and given.isdisjoint(named)
            if not is_new or not self._are_branches(formulas, is_announced=False):
                continue
            given |= named
            where = self.source.place(found.start(), len(found[0]))
            self.found.setdefault("inverse", (where, []))[1].append(formulas)

    def _coordinates(self, texts: Iterable[str]) -> set[str]:
        """The coordinates for which a text has an equation."""
        lefts = (equation.partition("=")[0] for text in texts for equation in joined(text))
        return {coordinate_named(self.reader.vocabulary, left) for left in lefts} - {""}

    def _read_sentence(self, name: str) -> None:
        r"""`The arm is singular for $q_2 = 0$ and $q_2 = \pi$.`"""
        text = ANY.sub(lambda said: " " * len(said[0]), self.text)
        for found in islice(_FORMULAS.finditer(text), _MOST_FORMULAS):
            words = text[max(found.start() - _BEFORE, 0) : found.start()].rpartition(".")[2]
            is_case = self._is_case(name, found.start())
            if is_case:
                if name in self.found or not self._is_said_of_case(name, *found.span()):
                    continue
            elif not ANNOUNCED[name].search(words + found[0]) or DENIED.search(words.rpartition("\n\n")[2]):
                continue
            formulas = _in_words(found[0])
            if not _IS_STATEMENT.search(formulas) and not _VANISHES.match(text, found.end()):
                continue
            if is_set(self.reader.vocabulary, formulas):
                self.found[name] = (self.source.place(found.start(), len(found[0])), [formulas])
                if not is_case:
                    return

    def _is_case(self, name: str, start: int) -> bool:
        """Whether a sentence names a case, `For $q_2 = 90°$`, before it speaks of a set."""
        before = self._before(start)
        goes_on = _JOINED.match(before) or SAID[name].search(before)
        return CASE.search(before) is not None and not goes_on

    def _is_said_of_case(self, name: str, start: int, end: int) -> bool:
        """Whether the sentence says of its case, behind it, that it is one of a set."""
        after = _BORDER.split(_GOING_ON.sub("", self.text[end : end + _BEFORE]), 1)[0]
        return SAID[name].search(after) is not None and DENIED.search(self._before(start) + after) is None

    def _before(self, start: int) -> str:
        """What stands before an offset in its sentence."""
        return _BORDER.split(self.text[max(start - _BEFORE, 0) : start].rstrip("$ \t\n"))[-1]

    def _may_be_one(self, words: str, text: str) -> bool:
        """Whether a row is part of a set, or may be when those before it are read."""
        has_branches = "inverse" in self.reader.vocabulary.quantities
        is_formula = has_branches and self._is_unknown(text.partition("=")[0])
        return is_formula or self._set_of(words, text) is not None

    def _set_of(self, words: str, text: str) -> str | None:
        """The answer that the equations of a display belong to; `words` stand before them."""
        vocabulary, asked = self.reader.vocabulary, self._asked
        if self.told >= set(asked) or not _IS_STATEMENT.search(text) or self._gives_an_answer(text):
            return None
        spoken = self._spoken_of(words + text)
        has_begun = not spoken and "inverse" in self.found
        is_open = "inverse" in asked and "inverse" not in self.told
        if is_open and self._are_branches(text, has_begun or spoken == "inverse"):
            return "inverse"
        return spoken if spoken not in ("", "inverse", *self.told) and is_set(vocabulary, text) else None

    def _gives_an_answer(self, row: str) -> bool:
        """Whether a row gives an answer of its own, as `det J = l_1 l_2 s_2`, and no condition of it."""
        left = row.partition("=")[0]
        if _ARROW.search(row) or _IS_ZERO.search(row) or self._is_unknown(left):
            return False
        return isinstance(side_of(self.reader.vocabulary, left), NamedAnswers)

    def _are_branches(self, text: str, is_announced: bool) -> bool:
        """Whether every equation gives a coordinate, or its sine or cosine, by what is to be reached.

        Where the inverse kinematics `is_announced`, further ones may go on without that.
        """
        vocabulary = self.reader.vocabulary
        pairs = [equation.partition("=") for equation in joined(text)]
        if not all(sign and self._is_unknown(left) for left, sign, _ in pairs):
            return False
        within = {name for *_, right in pairs for name in names_within(vocabulary, right)}
        return is_announced or not within.isdisjoint(vocabulary.reached)

    def _is_unknown(self, text: str) -> bool:
        vocabulary = self.reader.vocabulary
        return bool(coordinate_named(vocabulary, text)) or function_named(vocabulary, text) is not None

    def _spoken_of(self, words: str) -> str:
        """Which of the sets that are asked for the words speak of last."""
        ends = {name: [found.end() for found in ANNOUNCED[name].finditer(words)] for name in self._asked}
        told = {name: found[-1] for name, found in ends.items() if found}
        return max(told, key=lambda name: told[name]) if told else ""


def _in_words(formulas: str) -> str:
    """Formulas of a sentence with the words between them, without what is said in parentheses."""
    return _plain(_REMARK.sub("$", formulas).replace("$", " "))


def _rows(text: str) -> list[str]:
    """The rows of a display that is no matrix; one that begins with a sign goes on with the row before."""
    bare = _LAYOUT.sub(" ", text)
    found: list[str] = []
    for row in [text] if "\\begin" in bare else _ROW.split(bare):
        if found and _GOES_ON.match(row):
            found[-1] += row
        elif row.strip():
            found.append(row)
    return found if len(found) <= _MOST_ROWS else [text]


def _plain(row: str) -> str:
    """A row without what only sets it; `+a or -a` is ±a."""
    row = _EITHER_SIGN.sub(r"= ±\1", " ".join(row.split()))
    return _SIGN.sub("=", _ALIGN.sub("", _LAYOUT.sub(" ", row))).strip().rstrip(".,;").strip()


def _determinant(row: str) -> str:
    """The `det J = l_1 l_2 s_2` of a row that goes on with `= 0`; empty for any other."""
    first = _ARROW.split(in_signs(row))[0]
    value = _ZERO.sub("", first) if _DETERMINANT.match(first) else ""
    return value if "=" in value else ""
