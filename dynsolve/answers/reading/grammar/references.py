r"""Names of answers inside a value: each is kept as a reference, or as the matrix of those to its entries.

Sines and cosines by their first letter: `c\theta_1`, `s(q_1 + q_2)`, `C_{\theta_1}`, `c_{1-2}`.

Sines, cosines and roots as people write them: `\sin 2\theta_1 L_2`, `cos^2(q1)`, `sin q_1`.
"""

from __future__ import annotations

from fractions import Fraction

from dynsolve.answers.reading.grammar.reader import Reader
from dynsolve.answers.reading.grammar.scripts import Form, Scripts, magnitude
from dynsolve.answers.reading.grids import Abstract, Grid, Value, negative
from dynsolve.answers.reading.lexer import Token
from dynsolve.answers.reading.vocabulary import Vocabulary
from dynsolve.errors import ReadError
from dynsolve.notation.tree import (
    Arguments,
    Function,
    Negative,
    Node,
    Number,
    Power,
    Product,
    Quotient,
    Reference,
    Sum,
    Symbol,
)
from dynsolve.quantities import families
from dynsolve.quantities.family import Owner
from dynsolve.quantities.index import Quantities
from dynsolve.quantities.letters import key
from dynsolve.questions import newton_euler
from dynsolve.questions.forward_dynamics import QDD_FORWARD
from dynsolve.questions.parameters import REFERENCE
from dynsolve.robot.model import JointType

OWN_LETTERS = frozenset({"h", "c"})
"""Letters that name an answer on the left alone: on the right the student's own, but for a last guess."""


def quantity(reader: Reader, form: Form, name: str) -> Value | None:
    """The answer that a name stands for, as placeholders; None where it is none."""
    vocabulary = reader.vocabulary
    names = vocabulary.named(name)
    if name in OWN_LETTERS and not reader.naming and "vectors" not in reader.options:
        return None
    if name == "tau" and "driving" in reader.options and families.holds_forces(reader.owner):
        names = (vocabulary.driving_force(name) or name,)
    if form.script and name.startswith("I"):
        names = tuple(n for n in names if vocabulary.quantities[n].family is families.I)
    if form.dots:
        if name.startswith("rc") and form.dots == 1:
            names = vocabulary.named("v" + name[2:])
        else:
            names = vocabulary.named(name + "d" * form.dots + "ot")
            if not names:
                return None
    if len(names) > 1 and not reader.naming and _has_rates(reader):
        names = tuple(n for n in names if vocabulary.shape(n) is not None) or names
    if names == ("Y",) and REFERENCE in vocabulary.quantities and _has_references(reader):
        names = (REFERENCE,)
    names, framed = _framed(vocabulary.quantities, form, names)
    if not names or (names == (QDD_FORWARD.name,) and not reader.naming):  # in a value q̈ is the column
        return None
    skip_arguments(reader)
    reader.names_used += 1
    reader.candidates = names
    reader.references.setdefault(names[0])
    value = placeholder(vocabulary, names[0])
    scripts = form.scripts
    if framed:
        scripts.powers = scripts.powers[1:]
    return reader.with_scripts(value, scripts, form.start)


def _framed(quantities: Quantities, form: Form, names: tuple[str, ...]) -> tuple[tuple[str, ...], bool]:
    """The quantity in view of the frame that stands as its exponent: H_1^0, H_2^1."""
    powers = form.scripts.powers
    in_link = tuple(n for n in names if quantities[n].family in newton_euler.FAMILIES)
    if in_link and not powers and form.key not in quantities:
        return tuple(dict.fromkeys((*in_link, *names))), False
    if not powers or not names:
        return names, False
    first, frame = quantities[names[0]], powers[0]
    if in_link and frame == quantities[in_link[0]].index[0]:
        return in_link, True
    if first.family in newton_euler.FAMILIES:  # in another frame than the recursions have it in
        return (), True
    if first.family is families.FORCE and frame == first.index[0]:  # Craig's F_i: the inertia force of a link
        return (), True
    if first.family.owner is Owner.ROW and frame.denominator == 1 and frame >= 0:
        i = first.index[0]
        if frame == 0 and (first.family is families.H or i == 1):
            return names, True
        if frame == i - 1:
            return (f"A{i}",), True
        return (f"H{i}",) if frame == 0 else (), True
    if frame == 0:
        if first.family is families.I_BODY:
            return tuple(n for n in names if quantities[n].family is not families.I_BODY) or names, True
        return names, True
    if first.family is families.I_BODY and frame == 1:
        return names[:1], True
    return names, False


def _has_rates(reader: Reader) -> bool:
    r"""Whether velocities stand among the arguments here: V(q, \dot q) is no potential energy."""
    if reader.token.kind != "(" or not only_coordinates(reader, reader.position):
        return False
    for token in reader.tokens[reader.position :]:
        if token.kind == ")":
            return False
        if token.kind == "'" or token.dots or token.text == "dot" or token.text in ("qdot", "dq", "qd"):
            return True
    return False


def _has_references(reader: Reader) -> bool:
    r"""Whether reference rates stand among the arguments here: Y(q, \dot q, \dot q_r, \ddot q_r)."""
    if reader.token.kind != "(" or not only_coordinates(reader, reader.position):
        return False
    end = next(i for i in range(reader.position, len(reader.tokens)) if reader.tokens[i].kind == ")")
    return any(token.text.rstrip("}").endswith("r") for token in reader.tokens[reader.position : end])


def placeholder(vocabulary: Vocabulary, name: str) -> Value:
    """What stands for an answer: a reference to it, or the matrix of those to its entries."""
    shape = vocabulary.shape(name)
    if shape is None or (shape == (1, 1) and vocabulary.are_multipliers([name])):
        return Reference(name)
    rows, columns = shape
    return Grid(
        tuple(tuple(Reference(name, i, j) for j in range(1, columns + 1)) for i in range(1, rows + 1)),
        quantity=name,
    )


def whole_of(vocabulary: Vocabulary, value: Grid) -> tuple[str, ...]:
    """The matrix whose entries are all names: [tau_1; f_2] is tau."""
    quantities = vocabulary.quantities
    written = [str(entry) if isinstance(entry, Reference) else "" for row in value.rows for entry in row]
    whole = quantities.get(quantities.entry_of(written[0])[0]) if written else None
    if whole is None or whole.shape != value.shape or quantities.parts(whole.name) != tuple(written):
        return ()
    return (whole.name,)


def vectors_for_letters(reader: Reader, terms: list[Value]) -> list[Value]:
    """Terms in which a bare letter beside matrices is the vector of that name: the g of D q̈ + C q̇ + g.

    Beside a matrix no scalar can stand, so it is not the acceleration of gravity.
    """
    shape = next((term.shape for term in terms if isinstance(term, Grid)), None)
    return terms if shape is None else [_vector(reader, term, shape) for term in terms]


def _vector(reader: Reader, term: Value, shape: tuple[int, int]) -> Value:
    letter = term.argument if isinstance(term, Negative) else term
    if not isinstance(letter, Symbol):
        return term
    vocabulary = reader.vocabulary
    name = next((n for n in vocabulary.named(key(letter.name)) if vocabulary.shape(n) == shape), "")
    if not name:
        return term
    reader.names_used += 1
    reader.symbols.pop(letter.name, None)
    reader.references.setdefault(name)
    found = placeholder(vocabulary, name)
    return negative(found) if isinstance(term, Negative) else found


_BEFORE_RATES = {1: "C", 2: "D"}
"""Which matrix stands before q̇, and which before q̈."""


def matrix_for_letter(reader: Reader, letter: Node, rates: Value) -> Value | None:
    """The matrix that a letter of the hand-in is before q̈ or q̇, though it is a mass elsewhere; else None."""
    whole = _BEFORE_RATES.get(rates.is_rates) if isinstance(rates, Grid) else None
    if whole is None or not isinstance(letter, Symbol) or letter.dots:
        return None
    name, vocabulary = key(letter.name), reader.vocabulary
    if whole not in vocabulary.named(name):
        return None
    if name not in vocabulary.own_entries:
        vocabulary.missed_entries.add(name)
        return None
    reader.names_used += 1
    reader.symbols.pop(letter.name, None)
    reader.references.setdefault(whole)
    return placeholder(vocabulary, whole)


def skip_arguments(reader: Reader) -> None:
    """Leave out the arguments of D(q) and C(q, q_dot)."""
    if reader.token.kind == "(" and only_coordinates(reader, reader.position):
        opening = reader.take()
        reader.until(")", opening)


def only_coordinates(reader: Reader, position: int) -> bool:
    """Whether the parenthesis there holds coordinates and commas alone: no factor, nor the 0 of M(q_1, 0)."""
    vocabulary = reader.vocabulary
    found = False
    before = "("
    for token in reader.tokens[position + 1 : position + 60]:
        kind = token.kind
        if kind == ")":
            return found
        if kind in ("name", "letter"):
            name = key(token.text)
            meaning = vocabulary.symbol(name)
            is_coordinate = meaning is not None and vocabulary.coordinate(meaning.value) is not None
            is_letter = name in _ARGUMENTS or (name in vocabulary.letters and meaning is None)
            if not (is_coordinate or is_letter or vocabulary.is_vector(name)):
                return False
            found = True
        elif not (kind in _BESIDE_ARGUMENTS or token.text in _ACCENTED):
            return False
        if kind == "number" and before in ("(", ","):
            return False
        before = kind
    return False


_ARGUMENTS = frozenset("t qdot dq qd theta L d qr r".split())
_BESIDE_ARGUMENTS = frozenset(", _ number { } ^ * '".split())
_ACCENTED = frozenset({"dot", "ddot", "star"})


# Sines and cosines by their first letter


def is_short_function(reader: Reader) -> bool:
    r"""Whether a bare c or s here is a cosine or a sine: `c\theta_1`, `s(q_1 + q_2)`."""
    token, after = reader.token, reader.peek()
    if token.kind != "name" or token.text not in ("c", "s", "C", "S") or token.dots:
        return False
    if reader.vocabulary.symbol(token.text) is not None or reader.naming:
        return False
    if after.kind == "(":
        if reader.peek(2).kind == "number" and reader.peek(3).kind == ")":
            return False
        if "vectors" in reader.options and only_coordinates(reader, reader.position + 1):
            return False
        return token.text in "cs" or not only_coordinates(reader, reader.position + 1)
    if after.kind == "letter":
        return after.text in ("theta", "phi", "alpha", "beta", "psi", "gamma")
    if after.kind != "name" or after.dots:
        return False
    meaning = reader.vocabulary.symbol(key(after.text))
    q = reader.vocabulary.coordinate(meaning.value) if meaning is not None else None
    return q is not None and q.type is JointType.REVOLUTE


def short_function(reader: Reader, form: Form) -> Function:
    """C_{theta_1}, s_{q_1 + q_2}, c_{1-2}: the sine or cosine of the angle in the index."""
    angle: Value | None = _digits_angle(reader.vocabulary, form)
    if angle is None:
        angle = reader.inner(form.angle, naming=False)
    if not isinstance(angle, Node):
        help = "write c_1, c_{12} or \\cos(\\theta_1)"
        raise ReadError("this index is no angle", form.start, form.end - form.start, help)
    return Function("sin" if form.base in "sS" else "cos", angle)


def _digits_angle(vocabulary: Vocabulary, form: Form) -> Node | None:
    """The angle of an index such as 1+2 or 2-1."""
    if not all(t.kind in ("number", "+", "-") for t in form.angle):
        return None
    terms: list[Node] = []
    sign = "+"
    for token in form.angle:
        if token.kind != "number":
            sign = token.kind
            continue
        part = vocabulary.angle_of(token.text)
        if part is None:
            return None
        terms.append(Negative(part) if sign == "-" else part)
    if not terms:
        return None
    return terms[0] if len(terms) == 1 else Sum(tuple(terms))


# Sines, cosines and roots as people write them

_USUAL = ("sin", "cos", "tan", "sqrt", "cot", "sec", "csc")
_NAMES = {spelled: name for name in _USUAL for spelled in (name, name.capitalize(), name.upper())}
_NAMES |= {"cosec": "csc", "sgn": "sgn", "sign": "sgn", "signum": "sgn", "abs": "abs", "Abs": "abs"}
_INVERSES = {name: name for name in ("asin", "acos", "atan", "atan2")}
_INVERSES |= {f"arc{name}": f"a{name}" for name in ("sin", "cos", "tan", "tan2")}
_INVERSES |= {name.capitalize(): meant for name, meant in _INVERSES.items()}
_RECIPROCALS = {"cot": ("cos", "sin"), "sec": ("", "cos"), "csc": ("", "sin")}
_ELSEWHERE = frozenset(
    "exp log ln asin acos atan atan2 arcsin arccos arctan sinh cosh tanh max min pow "
    "sind cosd root det inv simplify eval exec open input print import".split()
)


def name_of(token: Token, vocabulary: Vocabulary) -> str | None:
    """The function that a token names; arccos and its like where the inverse kinematics is asked for."""
    if token.kind not in ("name", "command") or token.dots:
        return None
    known = _NAMES.get(token.text)
    return _INVERSES.get(token.text) if known is None and vocabulary.has_inverse_functions else known


def is_elsewhere(token: Token) -> bool:
    """Whether a token is a function that no answer holds."""
    return token.kind in ("name", "command") and token.text in _ELSEWHERE


def read(reader: Reader, function: str) -> Value:
    """A function with its power and its argument."""
    reader.enter()
    name = reader.take()
    if function == "atan" and reader.token.text == "2" and reader.peek().kind == "(":
        reader.take()  # \\arctan2(y, x)
        function = "atan2"
    scripts = Scripts()
    if function == "sqrt" and reader.token.kind == "[":
        raise reader.token.fault("only square roots are read", "write \\sqrt{x}", 1)
    if function != "sqrt":
        while reader.script(scripts):
            pass
    if scripts.powers == [-1] and f"a{function}" in _INVERSES and reader.vocabulary.has_inverse_functions:
        function, scripts.powers = f"a{function}", []  # cos⁻¹ is never 1/cos beside arccos
    if scripts.transposed or scripts.primes or scripts.mark or any(power < 1 for power in scripts.powers):
        length = max(reader.token.start - name.start, 1)
        help = f"write {function}(x)^2 for a square"
        raise name.fault(f"this exponent of {function} cannot be read", help, length)
    if function == "atan2":
        found: Value = Function(function, _two_arguments(reader, name))
        reader.nesting -= 1
        return found
    argument, outer = _argument(reader, name)
    found = applied(reader, function, argument, name)
    for power in [*scripts.powers, *outer]:
        found = reader.raised(found, power, name.start)
    reader.nesting -= 1
    if not outer and _is_closed(reader):
        found = reader.scripted(found)
    return found


def _two_arguments(reader: Reader, name: Token) -> Arguments:
    """(y, x) of atan2, in braces too as SymPy prints it."""
    help = f"write {name.text}(y, x)"
    brace = reader.take() if reader.token.kind == "{" and reader.peek().kind == "(" else None
    if reader.token.kind != "(":
        raise name.fault(f"`{name.text}` has no arguments", help)
    opening = reader.take()
    parts = [reader.sum()]
    if reader.token.kind != ",":
        raise reader.unexpected(help)
    reader.take()
    parts.append(reader.sum())
    reader.expect(")", opening)
    if brace is not None:
        reader.expect("}", brace)
    y, x = parts
    if not isinstance(y, Node) or not isinstance(x, Node):
        raise name.fault(f"`{name.text}` of a matrix or a vector", help)
    return Arguments((y, x))


def _is_closed(reader: Reader) -> bool:
    before = reader.tokens[max(reader.position - 1, 0)]
    return before.kind in (")", "}", "]") or reader.token.kind not in ("'", "''")


def _argument(reader: Reader, name: Token) -> tuple[Value, list[Fraction]]:
    """The argument, and the powers that stand at its end and belong to the function."""
    token = reader.token
    if token.kind == "(" or token.kind == "{" or token.kind == "[":
        return _closed(reader), []
    if token.kind == "end":
        raise name.fault(f"`{name.text}` has no argument", f"write {name.text}(theta1)")
    is_negative = False
    while reader.token.kind in ("-", "+"):
        is_negative = (reader.take().kind == "-") != is_negative
    if name.text.lower() == "sqrt":
        return reader.atom(), []
    value, powers = _open(reader)
    return Negative(value) if is_negative and isinstance(value, Node) else value, powers


def _closed(reader: Reader) -> Value:
    """The argument in its brackets."""
    opening = reader.take()
    closing = {"(": ")", "{": "}", "[": "]"}[opening.kind]
    if reader.token.kind == closing:
        raise opening.fault("there is no argument here", "write what the function is of", 2)
    value = reader.sum()
    if reader.token.kind == ",":
        raise reader.unexpected("functions take one argument; a decimal is written with a point: 9.81")
    reader.expect(closing, opening)
    return value


def _open(reader: Reader) -> tuple[Value, list[Fraction]]:
    """An optional number and one factor."""
    parts: list[Node] = []
    is_fraction = reader.token.text == "frac" and reader.peek(1).kind == reader.peek(2).kind == "number"
    if is_fraction or reader.token.kind in ("number", "fraction"):
        number = reader.atom()
        if not isinstance(number, Node):
            return number, []
        parts.append(number)
        if reader.token.kind in ("*", "cdot") and reader.peek().kind in ("name", "letter"):
            reader.take()
        if reader.token.kind not in ("name", "letter", "(", "command", "{") or name_of(
            reader.token, reader.vocabulary
        ):
            return number, []
    factor = reader.atom()
    if not isinstance(factor, Node):
        return factor, []
    powers: list[Fraction] = []
    if isinstance(factor, Power) and isinstance(factor.exponent, Number):
        reader.notes.setdefault(_POWER_NOTE)
        powers, factor = [Fraction(factor.exponent.p)], factor.base
    parts.append(factor)
    return (parts[0] if len(parts) == 1 else Product(tuple(parts))), powers


_POWER_NOTE = "a power behind an angle without parentheses is read as the power of the function"


def _degrees_meant(argument: Node) -> str:
    """The number in an angle that was meant in degrees by its looks: the 90 of theta_1 + 90."""
    terms = argument.terms if isinstance(argument, Sum) else (argument,)
    for term in terms:
        number = term.argument if isinstance(term, Negative) else term
        if isinstance(number, Number) and number.q == 1 and number.p and number.p % 15 == 0:
            return str(number.p)
    return ""


def applied(reader: Reader, function: str, argument: Value, name: Token) -> Value:
    """The function of an argument."""
    if isinstance(argument, Abstract):
        return argument
    if isinstance(argument, Grid):
        raise name.fault(f"`{name.text}` of a matrix or a vector", "write it of one angle")
    reader.symbols.setdefault("")
    if (degrees := _degrees_meant(argument)) and function != "sqrt":
        reader.notes.setdefault(f"{degrees} is read as {degrees} rad; degrees are written {degrees}°")
    if function == "abs":
        return magnitude(argument)
    if function in _RECIPROCALS:
        above, below = _RECIPROCALS[function]
        return Quotient(Function(above, argument) if above else Number(1), Function(below, argument))
    return Function(function, argument)
