"""Letters of the derivation that have no value for this robot: running indices, z_0, R_1, a zero level."""

from __future__ import annotations

import re

from dynsolve.answers.reading.grammar.forms import PSEUDO_INVERSE, Form
from dynsolve.answers.reading.grammar.rates import rate
from dynsolve.answers.reading.grammar.reader import Reader
from dynsolve.answers.reading.grammar.references import only_coordinates, placeholder, skip_arguments
from dynsolve.answers.reading.grammar.scripts import MARKS
from dynsolve.answers.reading.grids import Abstract, Grid, Value, grid
from dynsolve.answers.reading.vocabulary import ZERO_LEVELS, is_running
from dynsolve.notation.tree import Number, Symbol
from dynsolve.quantities.families import HOLD_FORCES
from dynsolve.robot.model_questions import reference

_ANGLES = ("theta", "phi", "varphi", "th")
_POTENTIAL = re.compile(r"P.*|L")
_LETTERS = re.compile(r"(?:z|o|R|r|p|x|y|e|n|a|u|s)(?:[0-9a-z]*|[xyz]theta[0-9]*|[xyz],?[qt].*)")
_HOLDS_FORCES = re.compile(rf"(?:{'|'.join(sorted(HOLD_FORCES))})[0-9]*")
_UNIT_VECTORS = "ijk"
_HEIGHT = re.compile(r"h[1-9a-z][0-9]*")
_SPELLED_RATES = {"qdot": 1, "dq": 1, "qd": 1, "qddot": 2, "ddq": 2, "qdd": 2}
_NEED_AN_INDEX = frozenset("Jv Jw Kv Kw Jomega Komega I omega v A H R".split())


def only_coordinate(reader: Reader, form: Form, name: str) -> Value | None:
    r"""The coordinate that `\dot\theta` is where there is only one θ: in a scalar, without a transpose."""
    is_one = len(reader.vocabulary.coordinates) == 1 and reader.vocabulary.is_vector(name)
    is_marked = form.dots or form.scripts.mark or name in _ANGLES or is_one
    if reader.naming or form.scripts.transposed or not is_marked:
        return None
    is_matrix = reader.vocabulary.shape(reader.owner) not in (None, (1, 1))
    if is_matrix or any(t.text in ("T", "top") for t in reader.tokens):
        return None
    symbol = reader.vocabulary.only_coordinate(name)
    if name == "q" and reader.references:  # beside D and C it is the vector
        return None
    if symbol is None or (reader.token.kind == "(" and only_coordinates(reader, reader.position)):
        return None
    value = rate(symbol, reader.vocabulary, form.dots + form.scripts.primes)
    if value is None:
        return None
    form.scripts.primes = 0
    reader.symbols.setdefault(symbol.name)
    reader.notes.setdefault(f"{form.text} is read as {symbol.name}")
    skip_arguments(reader)
    return reader.with_scripts(value, form.scripts, form.start)


def zero_level(reader: Reader, form: Form, name: str) -> Value | None:
    """h₀, from which a student counts heights, or the potential energy P₀ that is there."""
    if name not in ZERO_LEVELS or form.dots or not _POTENTIAL.fullmatch(reader.owner):
        return None
    reader.free.setdefault(name)
    return reader.with_scripts(Symbol(name), form.scripts, form.start)


def letter(reader: Reader, form: Form, name: str) -> Value | None:
    """The vector of coordinates, a running index, z_0, o_2, R_1, a zero level: the first that it can be."""
    for read in _READINGS:
        value = read(reader, form, name)
        if value is not None:
            return value
    return None


def _held_forces(reader: Reader, form: Form, name: str) -> Value | None:
    """τ of the joints, in an answer that says which forces hold the arm."""
    if reader.naming or not _HOLDS_FORCES.fullmatch(reader.owner):
        return None
    forces = reader.vocabulary.driving_force(name) or ("tau" if name == "u" else "")
    if not forces:
        return None
    reader.references.setdefault(forces)
    return reader.with_scripts(placeholder(reader.vocabulary, forces), form.scripts, form.start)


def _unit_vector(reader: Reader, form: Form, name: str) -> Value | None:
    """i, j or k, in an answer that is a vector."""
    if name not in _UNIT_VECTORS or form.dots or reader.vocabulary.shape(reader.owner) != (3, 1):
        return None
    vector = grid([[Number(int(place == _UNIT_VECTORS.index(name)))] for place in range(3)])
    return reader.with_scripts(vector, form.scripts, form.start)


def _other_matrix(reader: Reader, form: Form, name: str) -> Value | None:
    """J⁺ or J̄: made of another matrix, by its name."""
    if reader.naming or not name.endswith((PSEUDO_INVERSE, *MARKS)):
        return None
    return _missed(reader, name, f"{form.text} is a name for another matrix")


def _coordinates(reader: Reader, form: Form, name: str) -> Value | None:
    """q, q̇ or q̈ as a column."""
    if not reader.vocabulary.is_vector(name) or form.dots > 2:
        return None
    skip_arguments(reader)
    reader.names_used += 1
    value = reader.vocabulary.velocities(form.dots + form.scripts.primes)
    form.scripts.primes = 0
    return reader.with_scripts(value, form.scripts, form.start)


def _references(reader: Reader, form: Form, name: str) -> Value | None:
    """q_r as a column, where the problem has references."""
    vocabulary = reader.vocabulary
    if name != "qr" or not vocabulary.has_references:
        return None
    reader.names_used += 1
    rates = tuple((Symbol(reference(q.name), form.dots),) for q in vocabulary.coordinates)
    return reader.with_scripts(Grid(rates, is_rates=form.dots), form.scripts, form.start)


def _spelled_rates(reader: Reader, form: Form, name: str) -> Value | None:
    """q̇ or q̈ in letters: dq, qddot."""
    order = _SPELLED_RATES.get(name)
    if order is None or form.dots:
        return None
    only = reader.vocabulary.only_coordinate("q")
    if len(reader.vocabulary.coordinates) == 1 and only and not reader.references:
        reader.symbols.setdefault(only.name)
        return reader.with_scripts(Symbol(only.name, order), form.scripts, form.start)
    reader.names_used += 1
    return reader.with_scripts(reader.vocabulary.velocities(order), form.scripts, form.start)


def _running(reader: Reader, form: Form, name: str) -> Value | None:
    """m_i, of any i."""
    index = form.index or form.base_index
    if not index or not is_running(index):
        return None
    return _abstract(reader, f"{form.text} has a running index")


def _of_derivation(reader: Reader, form: Form, name: str) -> Value | None:
    """z₀, o₂, R₁"""
    is_short = form.base[:1].isalpha() and len(form.base.split("_")[0]) <= 2
    if reader.naming or not is_short or not _LETTERS.fullmatch(name):
        return None
    reader.letters.append(form)
    return _missed(reader, name + "'" * form.dots, f"{form.text} is a letter of the derivation")


def _height(reader: Reader, form: Form, name: str) -> Value | None:
    """h₂ in a potential energy."""
    if not _HEIGHT.fullmatch(name) or not _POTENTIAL.fullmatch(reader.owner):
        return None
    return _abstract(reader, f"{form.text} is a height")


def _without_index(reader: Reader, form: Form, name: str) -> Value | None:
    """J_v of no body in particular."""
    if reader.naming or name not in _NEED_AN_INDEX:
        return None
    return _missed(reader, name, f"{form.text} has no index")


def _abstract(reader: Reader, why: str) -> Abstract:
    reader.names_used += 1
    return Abstract(why)


def _missed(reader: Reader, name: str, why: str) -> Abstract:
    """What has no value unless the student gives it one."""
    reader.vocabulary.missed.add(name)
    return _abstract(reader, why)


_READINGS = (
    only_coordinate,
    _held_forces,
    _unit_vector,
    _other_matrix,
    _coordinates,
    _references,
    _spelled_rates,
    _running,
    _of_derivation,
    _height,
    _without_index,
)
"""What a letter may be, in the order in which it is tried."""
