"""What programs print: Derivative(q1(t), t), diff(q1(t), t, 2), Matrix([[a, b], [c, d]]), Rational(1, 2)."""

from __future__ import annotations

from dynsolve.answers.reading.grammar import brackets, derivatives, references
from dynsolve.answers.reading.grammar.reader import Reader, rate
from dynsolve.answers.reading.grids import MAX_ENTRIES, Abstract, Grid, Value, divided, transposed
from dynsolve.answers.reading.tokens.lexer import Token
from dynsolve.errors import ReadError
from dynsolve.notation.tree import ZERO, Number

_MATRICES = frozenset(
    "Matrix matrix MutableDenseMatrix ImmutableMatrix ImmutableDenseMatrix array Vector vector".split()
)
_DERIVATIVES = frozenset({"Derivative", "diff", "Diff"})
_OTHERS = frozenset("Rational transpose Transpose Integer simplify expand trigsimp factor nsimplify".split())
_MADE = frozenset({"diag", "Diag", "zeros"})
_DOTS = {"dot": 1, "ddot": 2}


def is_call(reader: Reader) -> bool:
    """Whether a call of a function that programs print stands here."""
    token = reader.token
    if token.text in ("Derivative", "Hold") and reader.peek().kind == "[":
        return True
    if token.text == "D" and reader.peek().kind == "[":
        return _is_by_time(reader)
    if token.kind != "name" or reader.peek().kind != "(":
        return False
    if token.text in _MADE | _MATRICES | _DERIVATIVES | _OTHERS or token.text in _DOTS:
        return True
    if references.is_elsewhere(token) and references.name_of(token, reader.vocabulary) is None:
        raise token.fault(f"unknown function `{token.text}`", "functions are sin, cos, tan and sqrt")
    return False


def read(reader: Reader) -> Value:
    """The value of a call."""
    reader.enter()
    name = reader.take()
    opening = reader.take()
    if name.text == "Hold":
        found = reader.sum()
        reader.expect("]", opening)
    elif opening.kind == "[" and name.text == "Derivative":
        found = _mathematica_derivative(reader, opening)
    elif name.text == "D":
        found = _derivative(reader, opening, "]")
    elif name.text in _DERIVATIVES:
        found = _derivative(reader, opening)
    elif name.text in _MATRICES:
        found = _matrix(reader, opening)
    elif name.text in _MADE:
        found = _diagonal(reader, opening) if name.text != "zeros" else _zeros(reader, opening)
    else:
        first = reader.sum()
        if name.text in _DOTS:
            dotted = rate(first, reader.vocabulary, _DOTS[name.text])
            if dotted is None:
                raise opening.fault("this has no derivative here", "write dot(q1) of a coordinate", 1)
            first = dotted
        if name.text == "Rational" and reader.token.kind == ",":
            reader.take()
            first = reader.placed(opening.start, divided, first, reader.sum())
        found = transposed(first) if name.text.lower() == "transpose" else first
        reader.expect(")", opening)
    reader.nesting -= 1
    return found


def _matrix(reader: Reader, opening: Token) -> Value:
    rows: list[list[Value]] = []
    while True:
        value = reader.sum()
        rows.append([value])
        if reader.token.kind != "," or reader.peek(2).kind == "=":
            break
        reader.take()
    if reader.token.kind == ",":  # Maple's `storage = rectangular`
        reader.until(")", opening)
    else:
        reader.expect(")", opening)
    while len(rows) > 1 and isinstance(rows[0][0], Number) and isinstance(rows[-1][0], Grid):
        rows = rows[1:]  # Matrix(2, 2, [[a, b], [c, d]]) says its size first
    if len(rows) == 1:
        only = rows[0][0]
        if isinstance(only, Grid) and only.shape[0] == 1 and not _was_nested(reader, opening):
            return brackets.finished(reader, [[entry] for entry in only.rows[0]], opening)
        return only
    return brackets.finished(reader, rows, opening)


def _diagonal(reader: Reader, opening: Token) -> Value:
    """diag(a, b), diag([a, b])"""
    entries = [reader.sum()]
    while reader.token.kind == ",":
        reader.take()
        entries.append(reader.sum())
    reader.expect(")", opening)
    if len(entries) == 1 and isinstance(entries[0], Grid) and 1 in entries[0].shape:
        entries = [entry for row in entries[0].rows for entry in row]
    if len(entries) ** 2 > MAX_ENTRIES:
        raise opening.fault(f"a matrix of more than {MAX_ENTRIES} entries", "check the brackets", 1)
    rows: list[list[Value]] = [
        [entry if i == j else ZERO for j in range(len(entries))] for i, entry in enumerate(entries)
    ]
    return brackets.finished(reader, rows, opening)


def _zeros(reader: Reader, opening: Token) -> Value:
    """zeros(2, 1)"""
    numbers = [int(t.text) for t in reader.until(")", opening) if t.kind == "number" and t.text.isdecimal()]
    if not 0 < len(numbers) < 3 or max(numbers) > 9 or min(numbers) < 1:
        raise opening.fault("this size is not read", "write zeros(2, 1)", 1)
    return brackets.finished(reader, [[ZERO] * numbers[-1] for _ in range(numbers[0])], opening)


def _was_nested(reader: Reader, opening: Token) -> bool:
    """Whether the call holds a list of lists: Matrix([[a, b]]) is a row, Matrix([a, b]) a column."""
    at = next((i for i in range(reader.position) if reader.tokens[i].start == opening.start), 0)
    return reader.tokens[at + 2].kind == "[" if at + 2 < len(reader.tokens) else False


def _is_by_time(reader: Reader) -> bool:
    """Whether Mathematica's D[x, t] or D[x, {t, 2}] stands here, and no entry D[1, 2]."""
    level = 0
    for place in range(reader.position + 1, len(reader.tokens)):
        level += {"[": 1, "]": -1}.get(reader.tokens[place].kind, 0)
        if level == 0:
            ends = [token.text for token in reader.tokens[place - 5 : place]]
            return ends[-2:] == [",", "t"] or ends[:3] == ["{", "t", ","]
    return False


def _derivative(reader: Reader, opening: Token, closing: str = ")") -> Value:
    """diff(x, t), diff(x, t, 2), diff(x, t$2), Derivative(x, (t, 2)), diff(L, x), D[x, {t, 2}]."""
    of = reader.sum()
    tokens = reader.until(closing, opening)
    order, by_time, others = 0, False, []
    for token in tokens:
        if token.kind == "name" and token.text == "t":
            order, by_time = order + 1, True
        elif token.kind == "number" and token.text in ("1", "2", "3") and by_time:
            order += int(token.text) - 1
        elif token.kind not in (",", "(", ")", "[", "]", "{", "}", "$"):
            others.append(token)
    if others or not by_time:
        return _partial(reader, of, tokens, opening)
    return derivatives.total_rate(reader, of, order)


def _mathematica_derivative(reader: Reader, opening: Token) -> Value:
    """Derivative[1][q1][t]"""
    order = reader.until("]", opening)
    if len(order) != 1 or order[0].text not in ("1", "2") or reader.token.kind != "[":
        raise opening.fault("this derivative is not read", "write Derivative[1][q1][t]", 1)
    bracket = reader.take()
    of = reader.inner(reader.until("]", bracket))
    if reader.token.kind == "[" and reader.peek().text == "t":
        reader.until("]", reader.take())
    return derivatives.total_rate(reader, of, int(order[0].text))


def _partial(reader: Reader, of: Value, tokens: list[Token], opening: Token) -> Value:
    tokens = tokens[bool(tokens and tokens[0].kind == ",") :]
    if not tokens:
        raise opening.fault("this derivative says not by what", "write diff(q1(t), t)", 1)
    return derivatives.partial(reader, of, derivatives.variable_of(reader, tokens))


def running_sum(reader: Reader) -> Value:
    """A sum over an index: a formula for every robot, whose value is not taken."""
    reader.take()
    while reader.token.kind in ("_", "^"):
        reader.take()
        reader.group()
    reader.names_used += 1
    try:
        reader.term()
    except ReadError:
        reader.position = len(reader.tokens) - 1
        reader.token = reader.tokens[-1]
    return Abstract("a sum over an index")
