"""Letters of the derivation that have no value for this robot: running indices, z_0, R_1, a zero level."""

from __future__ import annotations

import re

from dynsolve.answers.reading.grammar.forms import PSEUDO_INVERSE, Form
from dynsolve.answers.reading.grammar.rates import rate
from dynsolve.answers.reading.grammar.reader import Reader
from dynsolve.answers.reading.grammar.references import only_coordinates, placeholder, skip_arguments
from dynsolve.answers.reading.grammar.scripts import BAR
from dynsolve.answers.reading.grids import Abstract, Grid, Value, grid
from dynsolve.answers.reading.vocabulary import is_running
from dynsolve.notation.tree import (
    Number,
    Symbol,
)
from dynsolve.quantities.families import HOLD_FORCES
from dynsolve.robot.model_questions import reference

_ZERO_LEVELS = frozenset("h0 H0 z0 y0 h href hzero hb P0h zref".split())
_ANGLES = ("theta", "phi", "varphi", "th")
_POTENTIAL = re.compile(r"P.*|L")
_LETTERS = re.compile(r"(?:z|o|R|r|p|x|y|e|n|a|u|s)(?:[0-9a-z]*|[xyz]theta[0-9]*|[xyz],?[qt].*)")
_HOLDS_FORCES = re.compile(rf"(?:{'|'.join(sorted(HOLD_FORCES))})[0-9]*")
_UNIT_VECTORS = "ijk"
_HEIGHT = re.compile(r"h[1-9a-z][0-9]*")


def only_coordinate(reader: Reader, form: Form, name: str) -> Value | None:
    r"""The coordinate that `\dot\theta` is where there is only one θ: in a scalar, without a transpose."""
    if reader.naming or form.scripts.transposed or not (form.dots or form.scripts.mark or name in _ANGLES):
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


def letter(reader: Reader, form: Form, name: str) -> Value | None:
    """The vector of coordinates, a running index, z_0, o_2, R_1, a zero level of height."""
    vocabulary = reader.vocabulary
    lone = only_coordinate(reader, form, name)
    if lone is not None:
        return lone
    if _HOLDS_FORCES.fullmatch(reader.owner) and not reader.naming:
        forces = vocabulary.driving_force(name) or ("tau" if name == "u" else "")
        if forces:
            reader.references.setdefault(forces)
            return reader.with_scripts(placeholder(vocabulary, forces), form.scripts, form.start)
    if name in _UNIT_VECTORS and not form.dots and vocabulary.shape(reader.owner) == (3, 1):
        vector = grid([[Number(int(place == _UNIT_VECTORS.index(name)))] for place in range(3)])
        return reader.with_scripts(vector, form.scripts, form.start)
    if name.endswith((PSEUDO_INVERSE, BAR)) and not reader.naming:
        reader.names_used += 1
        vocabulary.missed.add(name)
        return Abstract(f"{form.text} is a name for another matrix")
    if vocabulary.is_vector(name) and form.dots <= 2:
        skip_arguments(reader)
        reader.names_used += 1
        value: Value = vocabulary.velocities(form.dots + form.scripts.primes)
        form.scripts.primes = 0
        return reader.with_scripts(value, form.scripts, form.start)
    if name == "qr" and vocabulary.has_references:
        reader.names_used += 1
        rates = tuple((Symbol(reference(q.name), form.dots),) for q in vocabulary.coordinates)
        return reader.with_scripts(Grid(rates, is_rates=form.dots), form.scripts, form.start)
    spelled = {"qdot": 1, "dq": 1, "qd": 1, "qddot": 2, "ddq": 2, "qdd": 2}.get(name)
    if spelled and not form.dots:
        reader.names_used += 1
        return reader.with_scripts(vocabulary.velocities(spelled), form.scripts, form.start)
    index = form.index or form.base_index
    if index and is_running(index):
        reader.names_used += 1
        return Abstract(f"{form.text} has a running index")
    if name in _ZERO_LEVELS and _POTENTIAL.fullmatch(reader.owner):
        reader.free.setdefault(name)
        return reader.with_scripts(Symbol(name), form.scripts, form.start)
    if (
        form.base[:1].isalpha()
        and _LETTERS.fullmatch(name)
        and not reader.naming
        and len(form.base.split("_")[0]) <= 2
    ):
        reader.names_used += 1
        reader.letters.append(form)
        vocabulary.missed.add(name + "'" * form.dots)
        return Abstract(f"{form.text} is a letter of the derivation")
    if _HEIGHT.fullmatch(name) and _POTENTIAL.fullmatch(reader.owner):
        reader.names_used += 1
        return Abstract(f"{form.text} is a height")
    if (
        name in ("Jv", "Jw", "Kv", "Kw", "Jomega", "Komega", "I", "omega", "v", "A", "H", "R")
        and not reader.naming
    ):
        reader.names_used += 1
        return Abstract(f"{form.text} has no index")
    return None
