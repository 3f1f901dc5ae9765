"""Derivatives as names and as operators: ∂L/∂q̇_1, d/dt(∂L/∂q̇_1), d²θ/dt², dL/dtheta1.

What programs print: Derivative(q1(t), t), diff(q1(t), t, 2), Matrix([[a, b], [c, d]]), Rational(1, 2).
"""

from __future__ import annotations

from dynsolve.answers.reading.grammar import brackets, references
from dynsolve.answers.reading.grammar.reader import Reader, Rule, by_symbol, by_time, derivative, rate
from dynsolve.answers.reading.grammar.scripts import Form
from dynsolve.answers.reading.grids import (
    MAX_ENTRIES,
    Abstract,
    Grid,
    Value,
    check_size,
    divided,
    grid,
    times,
    transposed,
)
from dynsolve.answers.reading.lexer import Token
from dynsolve.errors import ReadError
from dynsolve.notation.tree import ZERO, Node, Number, Reference, Symbol
from dynsolve.quantities.letters import key


class UnknownVariable(ReadError):
    """A derivative with respect to what is no coordinate; `family` are the answers of its kind."""

    def __init__(self, token: Token, shown: str, family: tuple[str, ...]) -> None:
        help = "derivatives are taken with respect to a coordinate or its velocity"
        length = max(token.end - token.start, 1)
        super().__init__(f"`{shown[:40]}` is no coordinate of the problem", token.start, length, help)
        self.family = family


def _is_d(token: Token) -> bool:
    """Whether a token is the sign of a derivative: d, ∂, δ."""
    return (
        (token.kind == "command" and token.text == "partial")
        or (token.kind == "name" and token.text == "d" and not token.dots)
        or (token.kind == "letter" and token.text in ("delta", "Delta"))
    )


def quotient(reader: Reader, above: list[Token], below: list[Token], start: int) -> Value | None:
    r"""The derivative that `\frac{above}{below}` is, None where it is a fraction."""
    top, bottom = _strip_d(above), _strip_d(below)
    if top is None or bottom is None:
        return None
    order, rest = _order(top)
    time = _is_time(bottom)
    if not time and _order(bottom)[0] != 1:
        return None
    of = _operand(reader, rest)
    if time:
        return total_rate(reader, of, order)
    if not bottom:
        help = "write \\frac{\\partial L}{\\partial q_1}"
        raise ReadError("this derivative says not by what", start, 1, help)
    return _by(reader, of, bottom)


def _strip_d(tokens: list[Token]) -> list[Token] | None:
    """The tokens behind the d of a derivative, None where there is none, as in d_11/Δ."""
    if not tokens or [token.kind for token in tokens[1:2]] == ["_"]:
        return None
    first = tokens[0]
    if first.kind == "letter" and len(tokens) == 1:
        return None
    if _is_d(first):
        return tokens[1:]
    if first.kind == "name" and first.text[0] == "d" and len(first.text) > 1 and not first.dots:
        rest = first.text[1:].lstrip("_")
        return [first._replace(text=rest, start=first.start + 1), *tokens[1:]] if rest else None
    return None


def _order(tokens: list[Token]) -> tuple[int, list[Token]]:
    """The order of a derivative, and what follows it: `^2 q` is (2, q)."""
    if tokens and tokens[0].kind == "raised":
        return (2 if tokens[0].text == "²" else 1), tokens[1:]
    if len(tokens) > 1 and tokens[0].kind == "^" and tokens[1].kind == "number":
        return (int(tokens[1].text) if tokens[1].text in ("1", "2") else 1), tokens[2:]
    return 1, tokens


def _is_time(tokens: list[Token]) -> bool:
    is_t = [(t.kind, t.text) for t in tokens[:1]] == [("name", "t")]
    return is_t and all(t.kind in ("^", "number", "raised", "{", "}") for t in tokens[1:])


def _operand(reader: Reader, written: list[Token]) -> Value:
    """What an operator is applied to: the tokens that are `written` in it, else what follows it.

    It is the name of an answer, in which these names win, or an expression of the student's own.
    """
    position, references = reader.position, dict(reader.references)
    named: Value | None = None
    try:
        named = reader.inner(written, naming=True) if written else _next_factor(reader, naming=True)
    except ReadError:
        if reader.naming:
            raise
    taken = written or reader.tokens[position : reader.position]
    name = key("".join(token.text for token in taken if token.kind in ("name", "letter", "number")))
    meaning = reader.vocabulary.symbol(name)
    is_coordinate = meaning is not None and reader.vocabulary.coordinate(meaning.value) is not None
    if named is not None and not is_coordinate and (reader.naming or isinstance(named, Reference)):
        return named
    after, its_references = reader.position, dict(reader.references)
    _go_back(reader, position, references)
    try:
        return reader.inner(written) if written else _next_factor(reader, naming=False)
    except ReadError:
        if not isinstance(named, Abstract | Grid):
            raise
        _go_back(reader, after, its_references)
        return named


def _go_back(reader: Reader, position: int, references: dict[str, None]) -> None:
    reader.position, reader.token = position, reader.tokens[position]
    reader.references.clear()
    reader.references.update(references)


def _next_factor(reader: Reader, naming: bool) -> Value:
    """What follows an operator: a bracket, the q(t) of a program, or the whole rest of the term."""
    before, reader.naming = reader.naming, naming
    reader.enter()
    try:
        start, is_bracket = reader.position, reader.token.kind in ("(", "[", "{", "begin")
        found = reader.factor()
        taken = reader.tokens[start : reader.position]
        is_closed = naming or is_bracket or any(token.text == "t" for token in taken)
        if isinstance(found, Node) and not is_closed and reader.follows():
            found = _rest_of_term(reader, found)
    finally:
        reader.naming = before
        reader.nesting -= 1
    return found


def _rest_of_term(reader: Reader, first: Node) -> Value:
    """A product behind an operator: d/dt m r² φ̇; not clear is whether the sine belongs to d/dt q sin q."""
    rule, position, start = by_time(reader.vocabulary), reader.position, reader.token.start
    rest = reader.term()
    if any(token.text in ("dt", "partial") for token in reader.tokens[position : reader.position]):
        reader.position, reader.token = position, reader.tokens[position]
        return first
    is_moving = isinstance(rest, Node) and derivative(rest, rule) != ZERO
    if is_moving and isinstance(first, Symbol) and derivative(first, rule) != ZERO:
        raise ReadError("it is not clear what this derivative is of", start, 1, "put that in brackets")
    return times(first, rest)


def _carried_out(of: Value, rule: Rule) -> Value | None:
    """The derivative of an expression, or of each entry of a matrix; None where it is not known."""
    if isinstance(of, Abstract):
        return of
    check_size(of.node if isinstance(of, Grid) else of)
    if not isinstance(of, Grid):
        return derivative(of, rule)
    rows = [[derivative(entry, rule) for entry in row] for row in of.rows]
    entries = [[entry for entry in row if entry is not None] for row in rows]
    return grid(entries) if rows == entries else None


def total_rate(reader: Reader, of: Value, order: int = 1) -> Value:
    """d/dt of an answer is one; of an expression it is taken."""
    if isinstance(of, Reference):
        if not of.quantity.startswith("dLdqd"):
            return _NOT_CARRIED_OUT
        name = "ddt" + of.quantity[5:]
        if of.quantity in reader.references:
            reader.references.pop(of.quantity)
            reader.references.setdefault(name)
        return Reference(name)
    found = rate(of, reader.vocabulary, order)
    if found is not None:
        return found
    for _ in range(order):
        of = _carried_out(of, by_time(reader.vocabulary)) or _NOT_CARRIED_OUT
    return of


def _by(reader: Reader, of: Value, variable: list[Token]) -> Value:
    """∂of/∂variable"""
    letter = of.quantity if isinstance(of, Reference) else ""
    try:
        by = variable_of(reader, variable)
    except ReadError:
        if letter in ("L", "K", "P"):
            shown = "".join(t.text for t in variable)
            dotted = any(t.text in ("dot", "ddot") or t.dots or "dot" in t.text for t in variable)
            kind = "dLdqd" if dotted else "dLdq"
            family = tuple(f"{kind}{q.index}" for q in reader.vocabulary.coordinates)
            raise UnknownVariable(variable[0], shown, family) from None
        return _NOT_CARRIED_OUT
    return partial(reader, of, by)


def variable_of(reader: Reader, tokens: list[Token]) -> Value:
    """What a derivative is taken by; it does not count as a symbol of the value."""
    before = dict(reader.symbols)
    found = reader.inner(tokens, naming=False)
    reader.symbols.clear()
    reader.symbols.update(before)
    return found


def partial(reader: Reader, of: Value, by: Value) -> Value:
    """The partial derivative of L (or K, or P) by a coordinate or its velocity, as an answer's name."""
    letter = of.quantity if isinstance(of, Reference) else ""
    if letter in ("L", "K", "P"):
        reader.references.pop(letter, None)
    if isinstance(by, Grid):
        return Abstract("a derivative by a vector")
    q = reader.vocabulary.coordinate(by)
    if q is None or not isinstance(by, Symbol):
        return _NOT_CARRIED_OUT
    if not isinstance(of, Reference):
        return _carried_out(of, by_symbol(by)) or _NOT_CARRIED_OUT
    name = _DERIVED.get((letter, by.dots))
    if name is None:
        return _NOT_CARRIED_OUT
    name = f"{name}{q.index}"
    reader.references.setdefault(name)
    reader.candidates = (name,)
    reader.names_used += 1
    return Reference(name)


_DERIVED = {("L", 1): "dLdqd", ("K", 1): "dLdqd", ("L", 0): "dLdq", ("P", 0): "g"}
"""What the derivatives of L, K and P by a velocity, or by a coordinate, are called."""

_NOT_CARRIED_OUT = Abstract("a derivative that is not carried out")


# In plain text: dL/dtheta1_dot, ∂L/∂q1, d/dt(dL/dq1')


def stands_here(reader: Reader) -> bool:
    """Whether a derivative in plain text begins here."""
    token = reader.token
    if (token.kind == "name" and token.text == "d") or token.text == "partial":
        return _slash(reader) is not None
    if token.kind == "name" and len(token.text) > 1 and token.text[0] == "d" and reader.peek().kind == "/":
        if reader.peek(2).text == "dt":
            meaning = reader.vocabulary.symbol(key(token.text[1:]))
            return meaning is not None and isinstance(meaning.value, Symbol)
        return _begins_with_d(reader.peek(2)) and key(token.text[1:]) in ("L", "K", "P", "T", "V", "U")
    return False


def _begins_with_d(token: Token) -> bool:
    return _is_d(token) or (token.kind == "name" and token.text[0] == "d")


def _slash(reader: Reader) -> int | None:
    """How far ahead the `/` of the derivative stands, None where there is none."""
    level = 0
    for ahead in range(1, 40):
        kind = reader.peek(ahead).kind
        level += _LEVELS.get(kind, 0)
        if level < 0 or kind in ("+", "-", "=", "end", ",", "*"):
            return None
        if kind == "/" and level == 0:
            return ahead if _begins_with_d(reader.peek(ahead + 1)) else None
    return None


def read(reader: Reader) -> Value:
    """The derivative in plain text that begins here."""
    reader.enter()
    above: list[Token] = []
    while reader.token.kind != "/" or sum(_LEVELS.get(token.kind, 0) for token in above) != 0:
        if reader.token.kind == "end":
            raise reader.unexpected()
        above.append(reader.take())
    reader.take()
    below = _variable(reader)
    found = quotient(reader, above, below, above[0].start)
    reader.nesting -= 1
    return found if found is not None else _NOT_CARRIED_OUT


_LEVELS = {"(": 1, "{": 1, ")": -1, "}": -1}


def _variable(reader: Reader) -> list[Token]:
    r"""The tokens of the variable: `dtheta1'`, `d(theta1_dot)`, `∂\dot q_1`."""
    first = reader.take()
    start = reader.position
    if _is_d(first):
        if reader.token.kind == "(":
            opening = reader.take()
            inner = reader.until(")", opening)
            return [first, *inner]
        reader.form()
        return [first, *reader.tokens[start : reader.position]]
    form = Form(first.text, first.start, first.end)
    reader.beside(form)
    return [first, *reader.tokens[start : reader.position]]


# What programs print

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


def read_call(reader: Reader) -> Value:
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
    return total_rate(reader, of, order)


def _mathematica_derivative(reader: Reader, opening: Token) -> Value:
    """Derivative[1][q1][t]"""
    order = reader.until("]", opening)
    if len(order) != 1 or order[0].text not in ("1", "2") or reader.token.kind != "[":
        raise opening.fault("this derivative is not read", "write Derivative[1][q1][t]", 1)
    bracket = reader.take()
    of = reader.inner(reader.until("]", bracket))
    if reader.token.kind == "[" and reader.peek().text == "t":
        reader.until("]", reader.take())
    return total_rate(reader, of, int(order[0].text))


def _partial(reader: Reader, of: Value, tokens: list[Token], opening: Token) -> Value:
    tokens = tokens[bool(tokens and tokens[0].kind == ",") :]
    if not tokens:
        raise opening.fault("this derivative says not by what", "write diff(q1(t), t)", 1)
    return partial(reader, of, variable_of(reader, tokens))


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
