"""How the steps of a short model end in names: which sums have one, and where it is introduced.

Which:  a sum of masses and lengths that comes up again and again from the kinetic energy on, and what its
        derivatives are made of (`name_inertias`): σ₁, σ₂, ...
        what Christoffel symbols are, where C would fill half a page (`name_symbols`): σ₃, ...
        what all of them are but for sign: h.
Where:  in the first step from the kinetic energy on in whose result it stands, after that result, which is
        then written with the name; h beside the first symbol that it is, as in the book.  That is found
        before the first step is made (`in_names`).
After:  every result has the name in its place.  What a symbol is stands in forces beside products of rates,
        and is looked for there alone.

A name has one meaning in a report, and its line in the list of notation has the unit of that.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from itertools import pairwise

from msgspec import Struct
from msgspec.structs import replace

from dynsolve.document import DEFINITIONS, Prose, Reference
from dynsolve.document.sentences import opened, say
from dynsolve.explain.abbreviations import WITH_RATES, Abbreviated, Definition, InertiaNames
from dynsolve.explain.context import Context
from dynsolve.explain.step import Line, Step
from dynsolve.explain.working.identities import SILENT, Way, are_alike
from dynsolve.explain.writing import listed
from dynsolve.notation.tree import Entry, Letter, Matrix, Node, Relation, Symbol, equation, walk
from dynsolve.quantities.stages import Stage
from dynsolve.robot.model import Robot
from dynsolve.robot.questions import Method

DERIVATIVES = "derivatives-of-names"
"""The label of the derivatives of named sums."""

_COLLECTED = frozenset({"D_sum", "g"})
"""The steps that are worked out anew from what stands before the names, and end in these."""

_DIFFERENTIATED = re.compile(r"ddt\d+|christoffel")
"""The steps that differentiate what they are written in, by the time or by all coordinates."""

_BY_SYMBOLS = re.compile(r"ddt\d+|dLdq\d+|christoffel")
"""The steps that bring the names of symbols in, and so refer to them."""


def labels_of_names(steps: Iterable[Step], short: Abbreviated) -> tuple[str, ...]:
    """The labels of where names are introduced."""
    found = tuple(line.label for step in steps for line in step.lines if line.label.startswith(DEFINITIONS))
    return found if short.single is None else (*found, "christoffel")


# -- the plan: where each name is introduced --------------------------------------------------------


def in_names(context: Context, stages: Collection[Stage]) -> Context:
    """The context of the steps of some stages, which knows what each of them introduces."""
    names = context.names
    if names is None or not names.at_symbols:
        return context
    dropped = {"L", "Cqd", *of_forces(context.robot)} if context.by_energies else ()
    return replace(context, introduced=introduced(context.robot, names, stages, dropped))


def introduced(
    robot: Robot,
    names: Abbreviated,
    stages: Collection[Stage] = tuple(Stage),
    dropped: Collection[str] = (),
) -> dict[str, tuple[Definition, ...]]:
    """The names that each step introduces, in the order of the steps; h has its own place.

    Those of `dropped` are told no more.
    """
    known = set() if names.single is None else {names.single.name}
    found: dict[str, tuple[Definition, ...]] = {}
    for id, results in _results(robot, names, stages):
        if id in dropped:
            continue
        needed = set(_symbols(results)) - known
        for one in reversed(names.sums):
            if one.name in needed:
                slopes = (slope for slope in names.inertias.slopes if one.name in set(walk(slope)))
                needed.update(_symbols((one.meaning, *slopes)))
        met = tuple(one for one in names.sums if one.name in needed - known)
        if met:
            found[id] = met
            known.update(one.name for one in met)
    return found


def of_forces(robot: Robot) -> list[str]:
    """The ids of the steps of Lagrange's equations, in their order."""
    return [f"{stem}{q.index}" for q in robot.coordinates for stem in ("dLdqd", "ddt", "dLdq", "tau")]


def _results(robot: Robot, names: Abbreviated, stages: Collection[Stage]) -> Iterator[tuple[str, list[Node]]]:
    """The ids of the steps in whose results names may be, in their order, and these."""
    by_recursions = robot.questions.method is Method.NEWTON_EULER
    of_stages = {
        Stage.ENERGY: ["K"],
        Stage.LAGRANGIAN: ["L"],
        Stage.TORQUE: of_forces(robot),
        Stage.NEWTON_EULER: [f"tau{q.index}" for q in robot.coordinates if by_recursions],
        Stage.VECTORIZED: ["D", "Cqd"],
    }
    for stage, ids in of_stages.items():
        if stage in stages:
            yield from ((id, [names.forms[id]]) for id in ids if id in names.forms)
    if Stage.VECTORIZED in stages:
        yield "christoffel", list(names.christoffel.values())


def label_of(context: Context, name: Node) -> str:
    """The label of the equation that defines a name."""
    step = next((id for id, met in context.introduced.items() if any(one.name == name for one in met)), None)
    return "christoffel" if step is None else f"{DEFINITIONS}{step}"  # h stands beside the symbol


# -- how a step ends -------------------------------------------------------------------------------


class Ending(Struct, frozen=True):
    """The lines to a result, what is said before it, the result, and the labels of the names in it."""

    lines: tuple[Line, ...]
    concluding: Prose
    result: tuple[Node, ...]
    names: tuple[str, ...] = ()


def ending(context: Context, id: str, results: Mapping[str, Sequence[Node]], way: Way = SILENT) -> Ending:
    """How the step `id` ends, in the names that there are; those that it introduces after its plain result.

    `results` has what stands before = by the names of the quantities.
    """
    result = tuple(equation(*left, context.result(name)) for name, left in results.items())
    names = context.names
    if names is None or not names.at_symbols:
        return Ending(way.lines, way.concluding, result)
    plain_result = tuple(equation(*left, context.form(name)) for name, left in results.items())
    plain, sums = Ending(way.lines, way.concluding, plain_result), names.inertias
    in_sums = _in_sums(id, plain, sums)
    has_way = bool(in_sums.lines and in_sums.concluding)
    concluding = in_sums.concluding
    if has_way:
        if id.startswith("dLdq"):
            before = set(walk(*in_sums.lines[-1].formulas))
            new = (name for name in _symbols(in_sums.result) if name in sums.symbols and name not in before)
            concluding = _ending_in(context, id, concluding, new)
        added = set(walk(*result)) - set(walk(*in_sums.result))
        symbols = [one.name for one in names.of_symbols if one.name in added]
        concluding = _ending_in(context, id, concluding, symbols)
    ended = Ending(in_sums.lines, concluding, result, tuple(_used(context, names, id, result, has_way)))
    met = context.introduced.get(id, ())
    if not met:
        return ended
    return _introducing(context, names, id, in_sums if met[0] in names.of_symbols else plain, ended)


def _in_sums(id: str, plain: Ending, sums: InertiaNames) -> Ending:
    """The end in the names of sums; the last line is left out where only the order of the result differs."""
    lines = plain.lines
    if id != "K":  # its plain sum stands before the names are defined
        lines = _in_lines(lines, _last_put(sums) if id in _COLLECTED else sums.put)
    result = tuple(map(sums.put, plain.result))
    is_changed = (lines, result) != (plain.lines, plain.result)
    if is_changed and lines and are_alike(lines[-1].formulas[-1], result[0]):
        return Ending(lines[:-1], (), result)
    return Ending(lines, plain.concluding, result)


def _in_lines(lines: Iterable[Line], change: Callable[[Node], Node]) -> tuple[Line, ...]:
    """Lines of which every formula is written otherwise."""
    return tuple(replace(line, formulas=tuple(map(change, line.formulas))) for line in lines)


def _last_put(sums: InertiaNames) -> Callable[[Node], Node]:
    """Writes the last member of an equation in the names: beside the sum as it stands, or in its place."""

    def put(node: Node) -> Node:
        if not isinstance(node, Relation):
            return sums.put(node)
        *before, last = node.parts
        named = sums.put(last)
        in_letters = all(isinstance(part, Letter | Entry) for part in before)
        is_alone = named != last and not isinstance(last, Matrix) and in_letters
        return equation(*before, *([last] if is_alone else []), named)

    return put


def _symbols(nodes: Iterable[Node]) -> list[Symbol]:
    return [node for node in walk(*nodes) if isinstance(node, Symbol)]


def _ending_in(context: Context, id: str, concluding: Prose, names: Iterable[Symbol]) -> Prose:
    """What is said before a result: collected, written with σ₁ in (55)."""
    names = list(dict.fromkeys(names))
    if not names:
        return concluding
    *before, last = concluding
    assert isinstance(last, str)
    known = tuple(dict.fromkeys(label_of(context, name) for name in names if _is_known(context, id, name)))
    said = say(
        "{last}, written with {names}{known}:",
        last=last.removesuffix(":"),
        names=listed(list(names)),
        known=Reference(known, " in ") if known else "",
    )
    return (*before, *said)


def _is_known(context: Context, id: str, name: Node) -> bool:
    """Whether a name was introduced before the step `id`."""
    return all(one.name != name for one in context.introduced.get(id, ()))


def _introducing(context: Context, names: Abbreviated, id: str, plain: Ending, ended: Ending) -> Ending:
    """The end of a step that introduces names: its plain result stands before them, if it was collected."""
    met = context.introduced[id]
    abbreviations = "abbreviations" if len(met) > 1 else "abbreviation"
    meanings = tuple(equation(one.name, one.meaning) for one in met)
    lines = [Line((f"{opened(abbreviations)}:",), meanings, label=f"{DEFINITIONS}{id}")]
    slopes = tuple(s for s in names.inertias.slopes if not {one.name for one in met}.isdisjoint(walk(s)))
    if slopes:
        lines.append(Line(("Hence:",), slopes, label=DERIVATIVES))
    after = ended.concluding
    result = plain.result[0]
    is_matrix = isinstance(result, Relation) and isinstance(result.parts[-1], Matrix)
    if id == "christoffel":
        after = ("Put into the formula:",)
    elif plain.concluding or not (plain.lines or is_matrix):
        lines.insert(0, Line(plain.concluding, plain.result))
        after = (f"With the {abbreviations}:",)
    return Ending((*ended.lines, *lines), after, ended.result, ended.names)


def _used(
    context: Context, names: Abbreviated, id: str, result: Sequence[Node], has_way: bool
) -> Iterator[str]:
    """The labels of what a step needs to be written in the names, each once."""
    sums = names.inertias
    found: dict[str, None] = {}
    known = [name for name in _symbols(result) if name in names.symbols and _is_known(context, id, name)]
    of_sums = [name for name in known if name in sums.symbols]
    differentiated = sums.slopes and of_sums and _DIFFERENTIATED.fullmatch(id)
    if differentiated or id in {f"dLdq{k}" for k in sums.by}:
        found[DERIVATIVES] = None
    elif id in _COLLECTED:
        found |= dict.fromkeys(label_of(context, name) for name in of_sums)
    if _BY_SYMBOLS.fullmatch(id) and not (WITH_RATES.fullmatch(id) and has_way):
        own = {one.name for one in names.of_symbols if one != names.single}
        found |= dict.fromkeys(label_of(context, name) for name in known if name in own)
    yield from found


def ending_of_symbols(context: Context, results: Sequence[Node], way: Way) -> Ending:
    """The end of the step of the Christoffel symbols."""
    names = context.names
    if names is None or not names.at_symbols:
        return Ending(way.lines, way.concluding, tuple(results))
    used = _used(context, names, "christoffel", results, bool(way.lines and way.concluding))
    ended = Ending(_in_lines(way.lines, names.inertias.put), way.concluding, tuple(results), tuple(used))
    if "christoffel" not in context.introduced:
        return ended
    return _introducing(context, names, "christoffel", ended, ended)


def ending_of_several(context: Context, id: str, results: Sequence[Node]) -> Ending:
    """The end of a step that has several results in a row, the names in place of what they mean."""
    names = context.names
    if names is None or not names.at_symbols:
        return Ending((), (), tuple(results))
    result = tuple(map(_last_put(names.inertias), results))
    return Ending((), (), result, tuple(_used(context, names, id, result, has_way=False)))


# -- checks on a result in names -------------------------------------------------------------------


def looked_at(context: Context, name: str, seen: Iterable[Node]) -> tuple[str, ...]:
    """The labels of a result that is looked at, and of the names of sums in what is `seen` of it."""
    if context.names is None:
        return (name,)
    found = set(walk(*seen))
    defined = (one.name for one in context.names.inertias.definitions if one.name in found)
    return (name, *dict.fromkeys(label_of(context, each) for each in defined))


def put_in(nodes: Iterable[Node]) -> Iterator[Symbol]:
    """The names that are in one member of an equation, and no more in the next."""
    for relation in (node for node in walk(*nodes) if isinstance(node, Relation)):
        for before, after in pairwise(relation.parts):
            left = set(walk(after))
            yield from (name for name in _symbols([before]) if name not in left)
