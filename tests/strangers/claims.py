"""What the sentences of a report say of this mechanism, each held by a computation in numbers.

A sentence with one of `WORDS` in it is a claim.  It is one of `GENERAL`, true of every mechanism, or it has a
pattern in `CLAIMS` with a function that holds it at random states, by the results of the JSON and by frames,
finite differences and ranks of its own.  In a pattern {} is a formula, {&} one or several, # a number or the
name of a body, ... any words, and what stands in [brackets] may be missing.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from itertools import combinations, islice, product
from typing import Any

import numpy as np

from dynsolve import document
from dynsolve.notation import tree
from dynsolve.notation.tree import Node, Symbol, names_in, walk
from dynsolve.notation.unicode import to_unicode
from dynsolve.questions.equilibria.solving import wanted_rows
from dynsolve.robot.model import Convention
from tests.strangers.mechanism import NEAR, Mechanism, names_of, near, plain, rank
from tests.strangers.oracle import Point, Unknown

WORDS = re.compile(
    r"\b(?:ranks?|stretched|bent|folded|constant|mov(?:es?|ing)|depends?|minim(?:um|a)|maxim(?:um|a)|saddle"
    r"|(?:un)?stable|along|negative|positive|conserved|parallel|perpendicular|always|never|zero|vanish(?:es)?"
    r"|independent|same|singular|occurs?|appears?|diagonal"
    r"|too few|all this holds where)\b",
    re.IGNORECASE,
)

# -- sentences ----------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Sentence:
    """Words with {} for formulas, these formulas, and where it stands: titles, and the blocks of its step.

    `words` are those that a pattern leaves open.
    """

    where: str
    text: str
    formulas: tuple[Node, ...]
    step: tuple[document.Block, ...]
    place: int
    words: tuple[str, ...] = ()

    def __str__(self) -> str:
        formulas = iter(self.formulas)
        return re.sub(r"\{\}", lambda _: to_unicode(next(formulas)), self.text)

    @property
    def body(self) -> str:
        """The name of the body that the title of the step speaks of."""
        found = re.findall(r"\bbody (\w+)", self.where)
        if not found:
            raise Unknown
        return str(found[-1])

    def matrix(self, point: Point) -> Any:
        """What stands in the matrix that the step shows."""
        shown = next(shown for shown in self.shown() if isinstance(shown.parts[-1], tree.Matrix))
        return point.value(shown.parts[-1]).value

    def jacobian(self, mechanism: Mechanism, point: Point) -> Any:
        """The Jacobian that the step shows, at its state; where it shows none, that of the task.

        In the summary that of the task at the state.
        """
        if self.where.startswith("Summary"):
            state = mechanism.solution.robot.questions.state.values
            given = {name: float(point.value(value).value) for name, dots, value in state if not dots}
            return mechanism.result(mechanism.jacobian, mechanism.point({**point.names, **given}))
        for shown in self.shown():
            if isinstance(shown.parts[-1], tree.Matrix) and plain(shown.parts[0]).startswith("J"):
                return point.value(shown.parts[-1]).value
        return mechanism.result(mechanism.jacobian, point)

    def display_before(self) -> tuple[Node, ...]:
        """The formulas of the display just before this sentence."""
        for block in reversed(self.step[: self.place]):
            if isinstance(block, document.Formula):
                return (block.node,)
            if isinstance(block, document.Equations):
                return block.nodes
        return ()

    def display_after(self) -> tuple[Node, ...]:
        return next(block.nodes for block in self.step[self.place :] if isinstance(block, document.Equations))

    def before(self) -> Iterator[tuple[str, tuple[Node, ...]]]:
        """The sentences of the paragraphs up to this one."""
        for block in self.step[: self.place + 1]:
            if isinstance(block, document.Text | document.Note):
                yield from _split(block.parts)

    def vectors(self) -> list[tree.Matrix]:
        """The columns of the space that is shown last, before this or in the step."""
        blocks = (*self.step[: self.place], *self.step)
        found = (one.node for one in reversed(blocks) if isinstance(one, document.Formula))
        space = next((node for node in found if "span" in to_unicode(node)), tree.ZERO)
        return [node for node in walk(space) if isinstance(node, tree.Matrix)]

    def shown(self) -> Iterator[tree.Relation]:
        """The equations in the displays of the step."""
        for block in self.step:
            nodes: tuple[Node, ...] = ()
            match block:
                case document.Formula(node):
                    nodes = (node,)
                case document.Equations(nodes):
                    pass
            yield from (node for node in walk(*nodes) if isinstance(node, tree.Relation))


def sentences(blocks: tuple[document.Block, ...], where: str = "") -> Iterator[Sentence]:
    """The sentences of a report, but for what is given and the list of notation; a row of a table is one."""
    fold = where
    for place, block in enumerate(blocks):
        match block:
            case document.Heading():
                where = block.text if block.level > 1 else ""
            case document.Fold():
                yield from sentences(block.blocks, f"{fold or where} > {block.title}")
                continue
        if where in ("", "Notation"):
            continue
        pieces: list[tuple[document.Inline, ...]] = []
        match block:
            case document.Text() | document.Note() | document.Uses():
                pieces = [block.parts]
            case document.List():
                pieces = list(block.items)
            case document.Table():
                pieces = [tuple(p for cell in row for p in (cell, "; "))[:-1] for row in block.rows]
        for parts in pieces:
            for text, formulas in _split(parts):
                yield Sentence(where, text, formulas, blocks, place)


def _split(parts: tuple[document.Inline, ...]) -> Iterator[tuple[str, tuple[Node, ...]]]:
    words = "".join(
        part if isinstance(part, str) else "{}" if isinstance(part, Node) else getattr(part, "text", "")
        for part in parts
    )
    formulas = iter([part for part in parts if isinstance(part, Node)])
    for text in re.split(r"(?<=[.?!]) +(?=[A-Z0-9{])", " ".join(words.split())):
        yield text, tuple(next(formulas) for _ in range(text.count("{}")))


# -- the claims ---------------------------------------------------------------------------------------

Claim = Callable[[Mechanism, Sentence], bool]
CLAIMS: dict[re.Pattern[str], Claim] = {}

SIGNS = {"{&}": r"\{\}(?:(?:, \{\})* (?:and|or) \{\})?", "{}": r"\{\}", "#&": r"(\w+(?:(?:, \w+)* and \w+)?)",
         "#": r"(\w+)", "...": ".*", "[": "(?:", "]": ")?", "<": "(", "|": "|", ">": ")"}  # fmt: skip


def pattern(words: str) -> re.Pattern[str]:
    parts = re.split(r"(\{&\}|\{\}|#&|#|\.\.\.|[\[\]<|>])", words)
    return re.compile("".join(SIGNS.get(part, re.escape(part)) for part in parts))


def says(*patterns: str) -> Callable[[Claim], Claim]:
    def put(claim: Claim) -> Claim:
        CLAIMS.update({pattern(words): claim for words in patterns})
        return claim

    return put


# kinematics, Jacobians, mass centres


@says("{} moves everything after it along the axis {}.")
def _slides(m: Mechanism, s: Sentence) -> bool:
    here, end = m.point(), len(m.solution.robot.joints)
    (name,), axis = names_of(s.formulas[:1]), m.value(s.formulas[1], here)
    change = m.frame(end, m.point({name: here.names[name] + 0.7})) - m.frame(end, here)
    return near(change[:3, 3:], 0.7 * axis) and near(change[:3, :3], 0)


@says(
    "{} moves the joint[s] of row[s] #&[ at ..., and so its column][ on the way to ...][; its column is ...]."
)
def _moves_rows(m: Mechanism, s: Sentence) -> bool:
    """Of the rows on the way to the last frame."""
    name, told = names_of(s.formulas[:1]), re.findall(r"\d+", s.words[0])
    rows = [joint.index for joint in m.solution.robot.path(len(m.solution.robot.joints))]
    return told == [str(i) for i in rows if m.changes(lambda p, i=i: m.result(f"A{i}", p), name)]


@says("{&} <does|do> not move the origin of frame #: <its column is|their columns are> zero.")
def _origin_stays(m: Mechanism, s: Sentence) -> bool:
    return not m.changes(lambda p: m.frame(int(s.words[1]), p)[:, 3], names_of(s.formulas))


@says("{&} turns a rotor alone and moves no link: its column is zero.")
def _rotor(m: Mechanism, s: Sentence) -> bool:
    rows = range(1, len(m.solution.robot.joints) + 1)
    return not any(m.changes(lambda p, i=i: m.result(f"H{i}", p), names_of(s.formulas)) for i in rows)


@says("The column of each <joint|coordinate>, taken at the mass centre; {&} <does|do> not move it.[ ...]")
def _columns_are_zero(m: Mechanism, s: Sentence) -> bool:
    rows = range(1, len(m.solution.robot.joints) + 1)
    moved = [q for i in rows for q in m.coordinates if m.changes(lambda p, i=i: m.result(f"A{i}", p), (q,))]
    if s.words[0] == "joint" and moved != list(m.coordinates):
        return False
    still = tuple(node for node in s.formulas if isinstance(node, tree.Symbol))
    return not m.changes(lambda p: m.pose(s.body, p), names_of(still)) and all(
        m.changes(lambda p: m.pose(s.body, p), (q,)) or not np.any(m.result(f"Jv{s.body}", m.point())[:, k])
        for k, q in enumerate(m.coordinates) if q not in names_of(still)
    )  # fmt: skip


@says("[...; ]{&} <does|do> not move its link.")
def _point_stays(m: Mechanism, s: Sentence) -> bool:
    point = re.findall(r"Jacobian of (\w+)", s.where)[-1]
    return not m.changes(lambda p: m.result(f"p{point}", p), names_of(s.formulas))


@says("# is fixed in link #: its coordinates in frame # are constant, and it moves with the frame.")
def _point_is_fixed(m: Mechanism, s: Sentence) -> bool:
    return not m.changes(
        lambda p: m.seen_from(int(s.words[2]), m.result(f"p{s.words[0]}", p), p), m.coordinates
    )


@says("{} is parallel to {}, so their cross product is zero.")
def _parallel(m: Mechanism, s: Sentence) -> bool:
    vectors = [[np.ravel(m.value(part, p)) for part in s.formulas] for p in m.points()]
    return all(near(np.cross(a, b), 0) for a, b in vectors)


@says(
    "[The position is given: it][The mass centre][Its rotational part alone: its mass centre] does not move."
)
def _center_stays(m: Mechanism, s: Sentence) -> bool:
    return not m.changes(lambda p: m.result(f"rc{s.body}", p), m.coordinates)


@says("The speed does not depend on {&}.")
def _speed(m: Mechanism, s: Sentence) -> bool:
    speed = lambda p: np.linalg.norm(m.result(f"v{s.body}", p))  # noqa: E731
    return all(not m.changes(speed, (name,)) for name in names_of(s.formulas))


@says("Body # does not turn, so its tensor does not enter[: what is not given is taken as 0].")
def _does_not_turn(m: Mechanism, s: Sentence) -> bool:
    return all(near(m.result(f"Jw{s.words[0]}", p), 0) for p in m.points())


@says("The angular velocity is the rate of the angle along its axis, which does not move.")
def _one_turn(m: Mechanism, s: Sentence) -> bool:
    return not m.changes(lambda p: m.result(f"Jw{s.body}", p), m.coordinates)


@says("{} is parallel to [{}][the body's axis #], so of the tensor the moment about this axis alone enters.")
def _turns_about_an_axis(m: Mechanism, s: Sentence) -> bool:
    """ω keeps to one axis of the body, the same in all states: the named one, where it is a frame's."""
    turned = [
        np.ravel(np.transpose(m.result(f"R{s.body}", p)) @ m.result(f"w{s.body}", p)) for p in m.points()
    ]
    if sum(not near([w[k] for w in turned], 0) for k in range(3)) != 1:
        return False
    named = [[np.ravel(m.value(part, p)) for part in s.formulas] for p in m.points()]
    return all(near(np.cross(both[0], both[-1]), 0) for both in named)


@says(
    "The angular velocity is parallel to that axis, so nothing else enters the energy, and ...",
    "The angular velocity has components along these axes alone, so nothing else enters the energy, and ...",
)
def _given_moments_suffice(m: Mechanism, s: Sentence) -> bool:
    """The entries that are not 0 are on the diagonal: along their axes alone the body turns."""
    for p in m.points():
        turned = np.transpose(m.result(f"R{s.body}", p)) @ m.result(f"w{s.body}", p)
        if not near(turned[np.diag(m.result(f"I_body{s.body}", p)) == 0], 0):
            return False
    return True


@says("The mass centre of body # is <half-way|{}[ of the way]> along link #, <between|from> {} <and|to> {}.")
def _part_of_the_way(m: Mechanism, s: Sentence) -> bool:
    def holds(p: Point) -> bool:
        start, end = (m.value(node, p) for node in s.formulas[-2:])
        part = 0.5 if s.words[1] == "half-way" else m.value(s.formulas[0], p)
        return near(m.result(f"rc{s.words[0]}", p), start + part * (end - start))

    return all(holds(p) for p in m.points())


@says(
    "The mass centre of body # is given by its coordinates in frame #, which are constant.",
    "The mass centre of body # is drawn at ({}, {}, {}); its constant coordinates in frame # are found ...",
    "The mass centre of body # ... from the near end of link #, {}, along the axes of frame #, ...",
)
def _fixed_in_frame(m: Mechanism, s: Sentence) -> bool:
    return not m.changes(
        lambda p: m.seen_from(int(s.words[-1]), m.result(f"rc{s.words[0]}", p), p), m.coordinates
    )


# tensors


@says("They are not ...: {} lies along the body's <...>, {} along its <...> and {} along its <...>, so ...")
def _axes(m: Mechanism, s: Sentence) -> bool:
    for p in m.points():
        turn = np.transpose(m.result(f"R{s.body}", p))
        for node, told in zip(s.formulas, s.words, strict=False):
            axis = (-1 if told.startswith("-") else 1) * np.eye(3)[:, ["xyz".index(told[-1])]]
            if not near(turn @ m.value(node, p), axis):
                return False
    return True


@says("The tensor of body # is given, about ..., along <its own axes|the axes of frame #>.")
def _tensor_in_frame(m: Mechanism, s: Sentence) -> bool:
    def there(p: Point) -> Any:
        turn = m.frame(int(s.words[2]), p)[:3, :3] if s.words[2] else m.result(f"R{s.words[0]}", p)
        return turn.T @ m.result(f"I{s.words[0]}", p) @ turn

    return not m.changes(there, m.coordinates)


@says(
    "Of the tensor of body # about ... the moment about the axis parallel to {}[, ...,] is given.",
)
def _moment_along(m: Mechanism, s: Sentence) -> bool:
    axis = lambda p: m.value(s.formulas[0], p)  # noqa: E731
    return not m.changes(lambda p: axis(p).T @ m.result(f"I{s.words[0]}", p) @ axis(p), m.coordinates)


@says("Body # is a uniform <...>, its own axis along <{}|... of the body's frame>.")
def _own_axis(m: Mechanism, s: Sentence) -> bool:
    """The axis is principal, and the moments across it are equal."""
    p = m.point()
    if s.formulas:
        axis = m.value(s.formulas[0], p)
    else:
        axis = m.result(f"R{s.words[0]}", p)[:, ["xyz".index(s.words[2][0])]]
    moments = np.linalg.eigvalsh(m.result(f"I{s.words[0]}", p))
    along = float((axis.T @ m.result(f"I{s.words[0]}", p) @ axis).item())
    across = (np.sum(moments) - along) / 2
    return near(m.result(f"I{s.words[0]}", p) @ axis, along * axis) and near(
        np.sort(moments), np.sort([along, across, across])
    )


@says("The body's axes are parallel to frame 0 at {} and turn with the link: ...")
def _parallel_at_zero(m: Mechanism, s: Sentence) -> bool:
    p = m.point(dict.fromkeys(m.coordinates, 0.0))
    return near(m.result(f"R{s.body}", p), m.frame(0, p)[:3, :3])


# energies and the matrix form


@says("[It does not depend on any coordinate, so {} is zero.]")
def _no_gravity_terms(m: Mechanism, s: Sentence) -> bool:
    return all(near(m.value(s.formulas[0], p), 0) for p in m.points())


@says("[...; ]{&} [itself ]do[es] not <occur|appear> in <...>[: [a ]cyclic coordinate[s]][, so {}]<.|:>")
def _does_not_occur(m: Mechanism, s: Sentence) -> bool:
    energy = {"ℒ": "L", "𝒦": "K", "𝒫": "P"}
    symbols = tuple(node for node in s.formulas if isinstance(node, tree.Symbol))
    behind = s.formulas[s.formulas.index(symbols[-1]) + 1 :]  # words before it may hold formulas, too
    letter = s.words[1][0] if s.words[1][0] in energy else to_unicode(behind[0])[0]
    return all(not m.changes(lambda p: m.result(energy[letter], p), (q,)) for q in names_of(symbols))


@says("No coordinate occurs in it: each rate becomes an acceleration, and nothing else changes.")
def _momentum_of_rates(m: Mechanism, s: Sentence) -> bool:
    k = re.findall(r"Coordinate (\w+)", s.where)[-1]
    return not m.changes(lambda p: m.result(f"dLdqd{k}", p), m.coordinates)


@says(
    "{} is constant, so every Christoffel symbol is zero.",
    "{} is constant, and {}: nothing is left to be checked.",
    "{} is constant: of all that joint # moves, it is the ....",
)
def _constant(m: Mechanism, s: Sentence) -> bool:
    return not m.changes(lambda p: m.value(s.formulas[0], p), m.coordinates)


@says("The rate of {} by the chain rule, entry by entry; <{&} ...|the other entries are> constant; then ...")
def _constant_entries(m: Mechanism, s: Sentence) -> bool:
    """Those that are named, or all whose rate is not shown."""
    rates = {plain(part) for shown in s.shown() for part in shown.parts}
    n = len(m.coordinates)
    named = [plain(node) for node in s.formulas[1 : -2 if "then {} with {}" in s.text else None]]
    others = [f"d{i}{j}" for i, j in product(range(1, n + 1), repeat=2) if f"ḋ{i}{j}" not in rates]
    return all(not m.changes(lambda p, d=d: m.result(d, p), m.coordinates) for d in named or others)


@says("{&} <is|are> zero.[ ...]")
def _are_zero(m: Mechanism, s: Sentence) -> bool:
    return all(near(m.value(node, p), 0) for node in s.formulas for p in m.points())


@says("All the others are zero.", "Partial derivatives that are zero are left out.",
      "The derivatives of {} that are not zero, term by term[...]:")  # fmt: skip
def _others_are_zero(m: Mechanism, s: Sentence) -> bool:
    """Christoffel symbols of which the step shows nothing."""
    told = "|".join([plain(part) for shown in s.shown() for part in shown.parts])
    told += "|".join(plain(node) for block in s.step for part in getattr(block, "parts", ())
                     if isinstance(part, Node) for node in walk(part))  # fmt: skip
    symbols = [f"c{i}{j}{k}" for i, j, k in product(range(1, len(m.coordinates) + 1), repeat=3) if i <= j]
    return all(near(m.result(c, p), 0) for c in symbols if c not in told for p in m.points())


@says("The sums, without what is zero:")
def _sums(m: Mechanism, s: Sentence) -> bool:
    """Entries of C of which the step shows nothing."""
    told = {plain(shown.parts[0]).lower() for shown in s.shown()}
    n = range(1, len(m.coordinates) + 1)
    return all(
        near(m.result(f"C{k}{j}", p), 0)
        for k, j in product(n, n)
        if f"c{k}{j}" not in told
        for p in m.points()
    )


@says("Here it is diagonal: no acceleration enters the force of another coordinate.")
@says(
    "The kinetic energy is {} with a symmetric {}: it has no product of two rates, so {} is diagonal, with "
    "twice the factor of {}."
)
def _diagonal(m: Mechanism, s: Sentence) -> bool:
    return all(near(D, np.diag(np.diag(D))) for D in (m.result("D", p) for p in m.points()))


@says(
    "[So {} at rest alone: ][So ]{} is positive definite"
    "[ for positive parameters[ and tensors of bodies][ with ...]]."
)
def _definite(m: Mechanism, s: Sentence) -> bool:
    return all(np.min(np.linalg.eigvalsh(m.result("D", p))) > 0 for p in m.points(5))


@says("For other parameters {} is positive definite.")
def _definite_elsewhere(m: Mechanism, s: Sentence) -> bool:
    """Where none of the inequalities holds with which it has no inverse somewhere."""
    told = [node for _, formulas in s.before() for node in formulas if isinstance(node, tree.Relation)]
    bounds = [node for node in told if "=" not in node.signs]
    apart = [p for p in m.points(20) if not any(m.holds(bound, p) for bound in bounds)]
    return bool(bounds) and all(np.min(np.linalg.eigvalsh(m.result("D", p))) > 0 for p in apart)


@says("{} is 0 in no configuration, so that no eigenvalue of {} changes its sign, and in some configuration "
      "all are positive.")  # fmt: skip
def _no_eigenvalue_changes_its_sign(m: Mechanism, s: Sentence) -> bool:
    return _definite(m, s)


@says("The velocities that have an inertia are all 0 only at rest: the matrix that makes them of the rates "
      "has rank # in every configuration.")  # fmt: skip
def _all_velocities(m: Mechanism, s: Sentence) -> bool:
    return all(rank(m.result("D", p)) == int(s.words[0]) for p in m.points(5))


@says(
    "In every pose [row # of {} is 0, so |rows # and # of {} are equal, so ]{}: some rates that are not 0 "
    "have no kinetic energy, and the forces do not determine all accelerations."
)
def _singular(m: Mechanism, s: Sentence) -> bool:
    return all(rank(D) < len(D) for D in (m.result("D", p) for p in m.points()))


@says("All other entries are zero, so {} is positive definite.")
def _diagonal_and_definite(m: Mechanism, s: Sentence) -> bool:
    return _diagonal(m, s) and _definite(m, s)


@says("In the last expression[ of each] no term is negative[, and {&}].")
def _no_term_is_negative(m: Mechanism, s: Sentence) -> bool:
    def negative(node: Node, p: Point) -> bool:
        match node:
            case tree.Sum(parts) | tree.Product(parts):
                return any(negative(part, p) for part in parts)
            case tree.Quotient(above, below):
                return negative(above, p) or negative(below, p)
            case tree.Parenthesized(inner):
                return negative(inner, p)
        return bool(m.value(node, p) < 0)

    last = [node for node in s.display_before() if isinstance(node, tree.Relation)]
    return bool(last) and all(
        not any(negative(relation.parts[-1], p) for relation in last)
        and all(m.holds(told, p) for told in s.formulas) for p in m.points()
    )  # fmt: skip


@says("{&} <is|are> positive: <body #|the rotors> add[s] ....")
def _adds(m: Mechanism, s: Sentence) -> bool:
    named = s.formulas[: len(s.formulas) // 3]
    parts, entries = s.formulas[len(named) :: 2], s.formulas[len(named) + 1 :: 2]
    return named == entries and all(
        m.value(d, p) >= m.value(part, p) * (1 - NEAR) > 0
        for p in m.points()
        for part, d in zip(parts, entries, strict=True)
    )


@says(
    "{&} <is|are> the moment[s] of inertia about {&} of <all|the bodies> that joint[s] <...> move[s],...",
    "{&} <is|are> the moment[s] of inertia of <all|the bodies> that joint[s] #& move[s][, ...][: in simple "
    "poses the ...].",
)
def _moments(m: Mechanism, s: Sentence) -> bool:
    entries = [node for node in s.formulas if plain(node).startswith("d")]
    axes = [int(plain(node)[1:]) for node in s.formulas[len(entries) :]]
    rows = [joint.index for joint in m.solution.robot.joints if joint.type]
    joints = [rows[int(joint) - 1] for joint in re.findall(r"\d+", " ".join(s.words))]
    for k, d in enumerate(entries):
        for p in m.points():
            z, o = (m.frame(axes[k], p)[:3, 2:] if axes else m.axis(joints[k], p)).T
            place = int(plain(d)[1:]) % 10 - 1
            moment = m.of_rotors(place, joints[k], z, p) if "rotor" in s.text else 0.0
            for body in m.moved_by(m.coordinates[place]):
                arm = np.cross(z, np.ravel(m.result(f"rc{body.name}", p)) - o)
                moment += m.mass(body, p) * arm @ arm + z @ m.result(f"I{body.name}", p) @ z
            if not near(moment, m.value(d, p)):
                return False
    return True


@says("So no {} depends on {} where {} and {}.")
def _lower_coordinates(m: Mechanism, s: Sentence) -> bool:
    return not any(
        m.changes(lambda p, i=i: m.result("D", p)[i:, i:], (q,)) for i, q in enumerate(m.coordinates)
    )


# what is conserved


@says("The energy changes by the power of {} alone: as long as {} it is conserved.")
def _energy(m: Mechanism, s: Sentence) -> bool:
    return m.is_conserved(s.formulas[1:2], lambda p: m.result("K", p) + m.result("P", p))


@says("What the constraints leave free moves no mass, so that the accelerations are not determined.")
def _moves_no_mass(m: Mechanism, s: Sentence) -> bool:
    for point in m.points():
        A, D = m.result("Ac", point), m.result("D", point)
        both = np.block([[D, -A.T], [A, np.zeros((len(A), len(A)))]])
        if rank(A) < len(A) or rank(both) == len(both):
            return False
    return True


@says("No motor drives: the energy is conserved.")
def _energy_stays(m: Mechanism, s: Sentence) -> bool:
    return m.is_conserved((), lambda p: m.result("K", p) + m.result("P", p))


@says("[As long as {&}, the ][The ]Euler-Lagrange equation[s] say[s] that the <...> conserved[:|.]")
def _momenta(m: Mechanism, s: Sentence) -> bool:
    conditions = tuple(node for node in s.formulas if isinstance(node, tree.Relation))
    told = re.findall(
        r"\{\}(?: \(the (angular|linear|total linear) momentum ?([^()]*)\))?", s.text.split("moment", 1)[1]
    )
    formulas = iter(s.formulas[len(conditions) :])
    for kind, what in told:
        momentum = next(formulas)
        axis, *_ = *(next(formulas) for _ in range(what.count("{}"))), None  # about 𝐳₀ of all that q₁ moves
        if not m.is_conserved(conditions, lambda p, node=momentum: m.value(node, p)):
            return False
        if kind and not all(
            near(m.value(momentum, p), m.momentum(momentum, kind, what, axis, p)) for p in m.points()
        ):
            return False
    return True


@says("[As ]{&}: sliding along a level axis changes no height.", "On the diagonal of {}, {&}.")
def _holds(m: Mechanism, s: Sentence) -> bool:
    return all(m.holds(node, p) for node in s.formulas for p in m.points())


# equilibria


@says("Where the constraints hold the rank of {}[ without the column[s] of {&}] is #.")
def _rank_where_held(m: Mechanism, s: Sentence) -> bool:
    columns = [k for k, q in enumerate(m.coordinates) if q not in names_of(s.formulas[1:])]
    found = [m.solved(lambda p: m.result("hc", p)[:, 0], m.coordinates, seed) for seed in range(8)]
    ranks = [np.linalg.matrix_rank(m.result("Ac", p)[:, columns], 1e-3) for p in found if p is not None]
    return max(ranks) == int(s.words[-1])


@says(
    "<At {&}|In the equilibrium {&}|In equilibrium[ at {&}]|In case #[ at {&}]|In every configuration|"
    "In every equilibrium>: <stable|not stable>"
    "[, but for {&}, <along which nothing changes|with any value of which it is an equilibrium>]."
)
def _stable(m: Mechanism, s: Sentence) -> bool:
    still = names_of(tuple(node for node in s.formulas if isinstance(node, tree.Symbol)))
    told = tuple(node for node in s.formulas if not isinstance(node, tree.Symbol))
    *_, kind, beside = s.words
    found = _stable_there(m, s, told, kind, ())
    if not found:
        raise Unknown
    if beside.startswith("with any value"):
        return all(found)
    return not any(m.changes(m.at_rest, (q,)) for q in still) and all(found)


def _equilibria(m: Mechanism, s: Sentence, told: tuple[Node, ...], seed: int = 0) -> Iterator[Point]:
    """Those that a sentence is about: at what is told, or in the case that it names."""
    cases = m.equilibria(told, seed)
    named = s.words[0].startswith("In case") and int(s.words[0].split()[2])
    yield from (point for number, point in cases if point is not None and (not named or number == named))


@says(
    "Every leading minor is positive in every configuration"
    "[ <exactly if|if> {&}[; this is enough, but may be more than is needed]]."
)
@says("Every leading minor is positive in every configuration <exactly if|if> ...either ....")
def _minors(m: Mechanism, s: Sentence) -> bool:
    """At parameters that meet the conditions; at others it fails in some pose, if they are exact."""
    let = [node for text, nodes in s.before() if text.startswith("Let ") for node in nodes]
    is_exact = "exactly if" in s.text
    seen = set()
    conditions: list[list[Node]] = []
    formulas = iter(s.formulas)
    for k, part in enumerate(s.text.split("either")):
        of_part = list(islice(formulas, part.count("{}")))
        conditions += [of_part] if k else [[node] for node in of_part]
    for here in m.points(30):
        met = all(any(m.holds(node, here) for node in nodes) for nodes in conditions)
        if not all(m.holds(node, here) for node in let) or not (met or is_exact):
            continue
        least = m.least(lambda p: float(np.min(np.linalg.eigvalsh(s.matrix(p)))), here.names)
        if (least > 0) != met:
            return False
        seen.add(met)
    return True in seen


@says("{} is not 0: its discriminant is negative.")
def _has_one_sign(m: Mechanism, s: Sentence) -> bool:
    let = [node for text, nodes in s.before() if text.startswith("Let ") for node in nodes]
    values = [m.value(s.formulas[0], p) for p in m.points(60) if all(m.holds(node, p) for node in let)]
    if not values:
        raise Unknown
    return min(values) * max(values) > 0


@says("... Of its two directions the one with a positive {} is taken.")
@says("Of its two directions the one with a positive {} is taken.")
def _turns_forwards(m: Mechanism, s: Sentence) -> bool:
    """sin α is an entry of the matrix of a row: of row i, or in the modified convention of the next one."""
    i, here = int(s.where.split()[-1]), m.point()
    first = i if m.solution.robot.convention is Convention.MODIFIED else i - 1
    row = np.linalg.inv(m.frame(first, here)) @ m.frame(first + 1, here)
    return bool((row[2, 1] if first < i else -row[1, 2]) > 0)


@says("[Where {}, ]{&} are not <both|all> positive[ in every configuration].")
def _minors_are_not_positive(m: Mechanism, s: Sentence) -> bool:
    """Whatever the parameters are that meet what is assumed, it fails in some pose."""
    let = [node for text, nodes in s.before() if text.startswith("Let ") for node in nodes]
    points = [here for here in m.points(30) if all(m.holds(node, here) for node in let)]
    lowest = (m.least(lambda p: float(np.min(np.linalg.eigvalsh(s.matrix(p)))), h.names) for h in points)
    return bool(points) and all(value < 1e-3 for value in lowest)


@says("The leading minors are positive in every configuration only if {&}, which exclude each other.")
def _conditions_exclude(m: Mechanism, s: Sentence) -> bool:
    return _minors_are_not_positive(m, s) and not any(
        all(m.holds(n, h) for n in s.formulas) for h in m.points(30)
    )


@says("{} is not positive in every configuration.")
def _minor_is_not_positive(m: Mechanism, s: Sentence) -> bool:
    (told,) = [shown for shown in s.shown() if shown.parts[0] == s.formulas[0]]
    return all(m.least(lambda p: float(p.value(told.parts[-1]).value), h.names) < 1e-3 for h in m.points())


@says("Where {}, {}, which is not positive[ for some {&}].")
def _minor_is_zero(m: Mechanism, s: Sentence) -> bool:
    (told,) = [shown for shown in s.shown() if shown.parts[0] == s.formulas[1].parts[0]]
    here, value = m.where(s.formulas[0]), s.formulas[1].parts[-1]
    least = m.least(lambda p: float(p.value(value).value), here.names)
    return near(m.value(told.parts[-1], here), m.value(value, here)) and least < 1e-3


@says("It depends on the first coordinate, {&}; no inertia matrix of relative coordinates does.")
def _matrix_depends(m: Mechanism, s: Sentence) -> bool:
    return m.changes(s.matrix, names_of(s.formulas))


@says("{} is an angle, and stands outside of sines and cosines in entry (#, #): ...")
def _full_turn(m: Mechanism, s: Sentence) -> bool:
    (q,), (i, j), here = names_of(s.formulas), map(int, s.words), m.point()
    turned = m.point({q: here.names[q] + 2 * np.pi})
    return not near(s.matrix(here)[i - 1, j - 1], s.matrix(turned)[i - 1, j - 1])


@says("The second derivatives of {} with respect to {&}[ (it depends on no other coordinate)]; det is ...:")
def _no_other(m: Mechanism, s: Sentence) -> bool:
    others = [q for q in m.coordinates if q not in names_of(s.formulas[1:])]
    return not m.changes(lambda p: m.result("P", p), tuple(others))


@says(
    "Without the moments of inertia ..., the sum of the linear parts[ (<that|those> of bod<y|ies> #& ...)]."
)
def _linear_parts(m: Mechanism, s: Sentence) -> bool:
    still = [body for body in m.solution.robot.bodies if body.name in re.findall(r"\w+", s.words[2])]
    return all(near(m.mass(body, p) * m.result(f"Jv{body.name}", p), 0) for body in still for p in m.points())


# tasks


@says("This is {}.")
def _same_jacobian(m: Mechanism, s: Sentence) -> bool:
    return all(near(m.value(s.formulas[0], p), m.result("Jr", p)) for p in m.points())


@says("This is {} without the row[s] of #&, zero in every configuration.")
def _row_is_zero(m: Mechanism, s: Sentence) -> bool:
    left_out = ["xyz".index(axis) for axis in re.findall(r"\b[xyz]\b", s.words[0])]
    whole = [(m.value(s.formulas[0], p), m.result("Jr", p)) for p in m.points()]
    return all(near(J[left_out], 0) and near(np.delete(J, left_out, 0), Jr) for J, Jr in whole)


@says("The task is the position of the tip[, {}], of which these are the coordinates that move.")
def _tip_moves(m: Mechanism, s: Sentence) -> bool:
    def tip(p: Point) -> Any:
        return m.value(s.formulas[0], p) if s.formulas else m.frame(len(m.solution.robot.joints), p)[:3, 3:]

    moving = [k for k in range(3) if m.changes(lambda p, k=k: tip(p)[k], m.coordinates)]
    return near(tip(m.point())[moving], m.result("r", m.point()))


@says(
    "Joint # turns about its axis and does not move this point.",
    "Only the other joints move it.",
    "The axes of joints #& meet in one point, which these joints do not move.",
)
def _point_on_axes(m: Mechanism, s: Sentence) -> bool:
    """What the pose tells of the point is where the other joints bring it."""
    *_, made = (shown.parts[-1] for shown in s.shown())
    numbers = re.findall(r"\d+", s.text) or re.findall(r"\d+", s.where.rpartition("joint")[2])
    joints = [m.solution.robot.joints[int(k) - 1] for k in numbers]
    moving = {name for joint in joints for name in names_in(joint.written[0])}
    return bool(joints) and not m.changes(
        lambda p: m.value(made, p), tuple(q for q in m.coordinates if q in moving)
    )


@says("The arm can move and keep the task: infinitely many configurations reach what is inside its reach.")
def _spare(m: Mechanism, s: Sentence) -> bool:
    return all(rank(m.result(m.jacobian, p)) < len(m.coordinates) for p in m.points())


@says("What is asked must have {&}: no joint moves <this|these>.")
def _kept(m: Mechanism, s: Sentence) -> bool:
    robot = m.solution.robot
    names = robot.questions.reached
    told = {names_of(one.parts[:1])[0]: one.parts[-1] for one in s.formulas if isinstance(one, tree.Relation)}

    def reached(p: Point) -> Any:
        if not robot.questions.task.is_pose:
            return m.result("r", p)
        last = m.frame(len(robot.joints), p)
        return np.hstack([last[:3, 3], last[:3, :3].ravel()])

    def value(k: int) -> Callable[[Point], Any]:
        return lambda p: reached(p)[k]

    here, fixed = m.point(), [k for k in range(len(names)) if not m.changes(value(k), m.coordinates)]
    return {*told} == {names[k] for k in fixed} and all(
        near(m.value(told[names[k]], here), value(k)(here)) for k in fixed
    )


@says("{} has many solutions, the rank being #: ...", "The rest has many solutions, the rank being #: ...")
def _many_solutions(m: Mechanism, s: Sentence) -> bool:
    J = s.jacobian(m, m.point())
    return rank(J) == int(s.words[0]) < len(J.T)


@says("<{}|The rest> has <no solution[ in general]|a solution only where {&}>, the rank being #.")
def _many_come_nearest(m: Mechanism, s: Sentence) -> bool:
    J = s.jacobian(m, m.point())
    return rank(J) == int(s.words[-1]) < min(J.shape)


@says("All this holds where the rank of {} is #[ and {}][ and these vectors are independent].")
def _holds_where_rank(m: Mechanism, s: Sentence) -> bool:
    """In general; where something may not be 0, the vectors that the step shows are dependent where it is."""
    if len(s.formulas) == 2:
        p = m.where(tree.equation(s.formulas[1].parts[0], tree.ZERO))
        if rank(np.hstack([m.value(node, p) for node in s.vectors()])) == len(s.vectors()):
            return False
    return rank(s.jacobian(m, m.point())) == int(s.words[0])


@says("All this holds where ....")
def _holds_where(m: Mechanism, s: Sentence) -> bool:
    """Where what is joined by or is 0 together, or another is, the rank is less, or vectors are dependent."""
    full, vectors = rank(s.jacobian(m, m.point())), s.vectors()
    for zeros in [s.formulas] if " or " in s.text else [(one,) for one in s.formulas]:
        p = m.where(tree.Row(tuple(tree.equation(one.parts[0], tree.ZERO) for one in zeros)))
        independent = rank(np.hstack([m.value(node, p) for node in vectors])) if vectors else 0
        if rank(s.jacobian(m, p)) == full and independent == len(vectors):
            return False
    return True


@says("The norm adds squares of lengths to squares of angles, so that it depends on the unit of length.")
def _mixed_norm(m: Mechanism, s: Sentence) -> bool:
    return len({q.type for q in m.solution.robot.coordinates}) == 2


# drawn axes


@says("The axes of joints #, # and # meet in one point, which these joints do not move.")
def _wrist(m: Mechanism, s: Sentence) -> bool:
    def meets(p: Point) -> Any:
        """The point next to the axes, and how far it is from them."""
        lines = [m.axis(int(i), p) for i in s.words]
        across = [np.eye(3) - np.outer(line[:, 0], line[:, 0]) for line in lines]
        feet = np.hstack([part @ line[:, 1] for part, line in zip(across, lines, strict=True)])
        point = np.linalg.lstsq(np.vstack(across), feet, rcond=None)[0]
        return np.hstack([point, np.vstack(across) @ point - feet])

    here = m.point()
    moved = m.point({q: here.names[q] + 1 for q in (m.coordinates[int(i) - 1] for i in s.words)})
    return near(meets(here)[3:], 0) and near(meets(here), meets(moved))


@says("Where {} the first and the last axis of the wrist are one line: the wrist is singular.")
def _wrist_is_singular(m: Mechanism, s: Sentence) -> bool:
    p, n = m.where(s.formulas[0]), len(m.coordinates)
    return near(np.cross(m.axis(n - 2, p)[:, 0], m.axis(n, p)[:, 0]), 0)


@says("The hand lies beside the axis of joint #: {} points from the axis across to it, and {} stays ...")
def _beside_the_axis(m: Mechanism, s: Sentence) -> bool:
    for p in m.points():
        (x, z), axis = (np.ravel(m.value(node, p)) for node in s.formulas), m.axis(int(s.words[0]), p)
        way = m.frame(len(m.solution.robot.joints), p)[:3, 3] - axis[:, 1]
        across = way - axis[:, 0] * (axis[:, 0] @ way)
        if not near(np.cross(z, axis[:, 0]), 0) or not near(across, x * np.linalg.norm(across)):
            return False
    return True


@says(
    "{} lies along it, from the first to the second[ where {}], and {} is where it meets the axis of joint #."
)
def _common_normal(m: Mechanism, s: Sentence) -> bool:
    """It is across both axes, and the origin is on the second; by Craig's convention on the first."""
    i = int(s.words[0])
    first = i if m.solution.robot.convention is Convention.MODIFIED else i - 1
    for p in m.points():
        x, o = (np.ravel(m.value(node, p)) for node in (s.formulas[0], s.formulas[-1]))
        towards = m.value(s.formulas[1].parts[0], p) if len(s.formulas) > 2 else 1
        a, b, own = m.axis(first, p), m.axis(first + 1, p), m.axis(i, p)
        across = x @ np.stack([a[:, 0], b[:, 0]], 1)
        if not near(across, 0) or not near(np.cross(o - own[:, 1], own[:, 0]), 0):
            return False
        if not near(np.cross(b[:, 0], a[:, 0]), 0) and x @ (b[:, 1] - a[:, 1]) * towards < -NEAR:
            return False
    return True


@says("The axis of joint # and the axis of joint # <meet|are parallel>[, ...][: ...].")
def _axes_meet(m: Mechanism, s: Sentence) -> bool:
    for p in m.points():
        a, b = (m.axis(int(i), p) for i in s.words[:2])
        parallel = near(np.cross(a[:, 0], b[:, 0]), 0)
        meet = near(np.cross(a[:, 0], b[:, 0]) @ (b[:, 1] - a[:, 1]), 0)
        if parallel != (s.words[2] == "are parallel") or not (parallel or meet):
            return False
        for node in s.formulas:
            if plain(node)[0] == "x" and not near(
                np.ravel(m.value(node, p)) @ np.stack([a[:, 0], b[:, 0]], 1), 0
            ):
                return False
    return True


# ranks


@says(
    "Where the matrix of <the|its> second derivatives[ of the <potential energy|energy {}, the ...>], "
    "without the row<|s> and column<|s> of {&}, which are 0 there,[ for every {&}] is positive definite, the "
    "<equilibrium|motion> is stable[...]."
)
def _rows_are_0(m: Mechanism, s: Sentence) -> bool:
    """At the equilibria that are told of behind it."""
    names = names_of(tuple(node for node in s.formulas if isinstance(node, Symbol)))
    still = [m.coordinates.index(q) for q in names]
    points = [point for _, point in m.equilibria(()) if point is not None]
    return bool(points) and all(
        near(m.stiffness(point)[still, :], 0) and near(m.stiffness(point)[:, still], 0) for point in points
    )


@says("The equations of the others change as # moves: it is not cyclic.")
def _not_cyclic(m: Mechanism, s: Sentence) -> bool:
    (q,) = [q for q in m.coordinates if to_unicode(Symbol(q)) == s.words[0]]
    others = [k for k, name in enumerate(m.coordinates) if name != q]
    return m.changes(lambda p: m.result("tau", p)[others], (q,))


@says("The constraints change as # moves: it stands in them.")
def _moves_constraints(m: Mechanism, s: Sentence) -> bool:
    k = [to_unicode(Symbol(q)) for q in m.coordinates].index(s.words[0])
    return not near(m.result("Ac", m.point())[:, k], 0) or m.changes(
        lambda p: m.result("Ac", p), (m.coordinates[k],)
    )


@says(
    "The given state is no equilibrium: <gravity|springs|gravity and springs|the potential energy|the given "
    "forces> move[s] #, ..."
)
def _unbalanced(m: Mechanism, s: Sentence) -> bool:
    at = {q: m.value(of, m.point()) for q, _, of in m.solution.robot.questions.model.linearize}
    rates = {f"{q}'": 0.0 for q in m.coordinates}
    p = m.point(at | rates)
    k = [to_unicode(Symbol(q)) for q in m.coordinates].index(s.words[-1])
    forces = m.result("g", p) - (m.result("Q", p) if m.solution.robot.questions.loads else 0)
    return k in m.solution.robot.actions.passive and not near(forces[k], 0)


@says("{&} cannot hold, as masses and lengths of the table are positive: no parameters will do.")
def _unbalanced_by_any(m: Mechanism, s: Sentence) -> bool:
    equations = [one for one in s.formulas if isinstance(one, tree.Relation)]
    sides = [[m.value(one.parts[0], p) - m.value(one.parts[-1], p) for p in m.points()] for one in equations]
    return all(min(one) > 0 or max(one) < 0 for one in sides)


@says(
    "The potential energy does not change along what the constraints leave free: every configuration that "
    "they allow is an equilibrium, and all are indifferent."
)
def _indifferent(m: Mechanism, s: Sentence) -> bool:
    """g is a combination of the rows of A_c, at random states."""
    pairs = [(m.result("Ac", p), m.result("g", p)) for p in m.points()]
    return all(rank(np.vstack([A, g.T])) == rank(A) for A, g in pairs)


@says("As masses and lengths of the table are positive, {&}.")
def _negative(m: Mechanism, s: Sentence) -> bool:
    solved = [one for one in s.formulas if isinstance(one, tree.Relation)]
    return all(one.signs == ("=", "<") and m.value(one.parts[1], p) < 0 for one in solved for p in m.points())


@says("In case #: <stable|not stable>.")
def _stable_in_a_case(m: Mechanism, s: Sentence) -> bool:
    step = next(told for told in sentences(m.document.blocks) if told.text == "It is 0 in these cases:")
    return m.is_stable(m.where(step.display_after()[int(s.words[0]) - 1]), s.words[1])


@says(
    "<At {}|In the equilibrium {}|In every configuration|In every equilibrium|In equilibrium[ at {}]|"
    "In case #[ at {}]>[, where {}]: "
    "<stable|not stable> where {}, <stable|not stable> where {}[, ...].",
)
def _stable_where(m: Mechanism, s: Sentence) -> bool:
    at = s.words[0].count("{}")
    kinds = [word for word in s.words[1:] if word.endswith("stable")]
    *inside, first, second = (node for node in s.formulas[at:] if not isinstance(node, Symbol))
    found = [
        _stable_there(m, s, s.formulas[:at], kind, (*inside, condition))
        for kind, condition in zip(kinds, (first, second), strict=True)
    ]
    return any(found) and all(map(all, found))


@says(
    "<At {}|In the equilibrium {}|In every configuration|In every equilibrium|In equilibrium[ at {}]|"
    "In case #[ at {}]>[, where {}]: "
    "<stable> where {&}[, not stable where one of these inequalities is reversed][, ...].",
)
def _stable_where_all(m: Mechanism, s: Sentence) -> bool:
    at, told = s.words[0].count("{}"), s.text.partition(", not stable where")[0].count("{}")
    conditions = tuple(node for node in s.formulas[at:told] if not isinstance(node, Symbol))
    found = _stable_there(m, s, s.formulas[:at], "stable", conditions)
    return bool(found) and all(found)


@says(
    "<At {}|In the equilibrium {}|In every configuration|In every equilibrium|In equilibrium[ at {}]|"
    "In case #[ at {}]>[, where {}]: "
    "<not stable> where <{}|{} or {}>.",
)
def _falls_where(m: Mechanism, s: Sentence) -> bool:
    at, several = s.words[0].count("{}"), s.words[-1].count("{}")
    *inside, _ = s.formulas[at : len(s.formulas) - several + 1]
    found = [
        _stable_there(m, s, s.formulas[:at], "not stable", (*inside, one)) for one in s.formulas[-several:]
    ]
    return any(found) and all(map(all, found))


@says(
    "Where {&}, <{}|there may be a {}>, too; but {&} move[s] no body there, {&}, and the coordinates do not "
    "tell how the bodies move: it need not be an equilibrium."
)
def _no_coordinates(m: Mechanism, s: Sentence) -> bool:
    names = names_of(tuple(node for node in s.formulas if isinstance(node, Symbol)))
    conditions = s.formulas[: next(k for k, node in enumerate(s.formulas) if isinstance(node, Symbol)) - 1]
    where = m.where(tree.Row(conditions))
    inertia = np.diag(m.result("D", where))
    still = [inertia[m.coordinates.index(name)] for name in names]
    rows = wanted_rows(m.solution.robot)
    left = m.at_rest(where)[rows]
    if m.solution.robot.questions.constraints:
        A = m.result("Ac", where)[:, rows]
        together = np.array([*A, left])
        left = np.append(m.result("hc", where), rank(together) > rank(A))
    return bool(names) and near(left, 0) and near(np.array(still), 0)


@says("<At {}|In every configuration|In equilibrium[ at {}]|In case #[ at {}]>, where {}: <not stable>.")
def _falls_inside(m: Mechanism, s: Sentence) -> bool:
    at = s.words[0].count("{}")
    found = _stable_there(m, s, s.formulas[:at], s.words[-1], s.formulas[at:])
    return bool(found) and all(found)


def _stable_there(
    m: Mechanism, s: Sentence, told: tuple[Node, ...], kind: str, conditions: tuple[Node, ...]
) -> list[bool]:
    """Of some equilibria at which the conditions hold, whether they are of this kind."""
    points = (point for seed in range(60) for point in _equilibria(m, s, told, seed))
    meeting = (point for point in points if all(m.holds(one, point) for one in conditions))
    still = names_of(tuple(node for node in s.formulas if isinstance(node, Symbol)))
    if {*still} & {*tree.names_in(*conditions)}:  # it moves to where they do not hold
        return [False]
    return [m.is_stable(point, kind, still) for point in islice(meeting, 3)]


@says("No motor drives {&}: in the equilibrium ... <does|do> not move <it|them>.")
def _stays_by_itself(m: Mechanism, s: Sentence) -> bool:
    point = m.posed(
        [node for text, nodes in s.before() if text.startswith("The matrices are taken at") for node in nodes]
    )
    return near(m.at_rest(point)[[m.coordinates.index(q) for q in names_of(s.formulas)]], 0)


@says("{} is diagonal; its inverse has the reciprocals:")
def _is_diagonal(m: Mechanism, s: Sentence) -> bool:
    matrices = [m.result("D", p) for p in m.points()]
    return all(near(matrix, np.diag(np.diag(matrix))) for matrix in matrices)


@says("Where {}, {} is diagonal in every configuration[, <and> the same in all, so that {}]: ...")
def _decoupled(m: Mechanism, s: Sentence) -> bool:
    point = m.where(s.formulas[0])
    D = [m.result("D", m.point(point.names | pose)) for pose in ({}, *m.right_angles())]
    is_diagonal = all(near(matrix, np.diag(np.diag(matrix))) for matrix in D)
    return is_diagonal and (not s.words[0] or all(near(matrix, D[0]) for matrix in D))


@says("Fewer than # entr<y|ies> <is|are> not enough: ...")
def _entries(m: Mechanism, s: Sentence) -> bool:
    """The forces at motions, one under another, other parameters in each column; so many do by τ = Y a."""
    count = {"one": 1, "two": 2}.get(s.words[0]) or int(s.words[0])
    known, moving = m.solution.robot.questions.model.known, set(m.coordinates)

    def force(p: Point) -> Any:
        if "inertia matrix" in s.where:
            return m.result("D", p) @ np.array([[p.names[f"{q}_ddot"]] for q in m.coordinates])
        return m.result("g" if "gravity" in s.where else "tau", p)

    for generator in m.solution.robot.ring.generators:  # angles from which joints turn count as motions do
        if generator.kind in ("sin", "cos"):
            names = {name for atom, _ in generator.angle.terms for name, _ in atom}
            moving |= names if names & set(m.coordinates) else set()

    def moves(name: str) -> bool:
        return name.removesuffix("_dot").removesuffix("_ddot") in moving

    fixed = {name: value for name, value in m.point().names.items() if name in known}
    motions = [
        {name: value for name, value in m.point(seed=k).names.items() if moves(name)}
        for k in range(count + 2)
    ]
    table = [[force(m.point(motion | fixed, seed)) for seed in range(count + 3)] for motion in motions]
    return rank(np.block(table)) >= count


@says("{} is #×#, and its rank is at most #[; <column|columns|row|rows> ... 0].")
def _rank(m: Mechanism, s: Sentence) -> bool:
    for p in m.points(5):
        J = m.value(s.formulas[0], p)
        if J.shape != (int(s.words[0]), int(s.words[1])) or rank(J) != int(s.words[2]):
            return False
    return True


@says(
    "The rank of {} is # in every configuration[, as <the minors are never all 0 at once|no factor of the "
    "minor becomes 0>]."
)
def _rank_everywhere(m: Mechanism, s: Sentence) -> bool:
    """At random states, and where the coordinates are right angles and 0."""
    at = [m.point(seed=seed) for seed in range(10)]
    at += [m.point(pose) for pose in m.right_angles()]
    return all(rank(m.result(m.singular, p)) == int(s.words[0]) for p in at)


def _ranks_where(m: Mechanism, condition: Node) -> set[int]:
    return {rank(m.result(m.singular, m.where(condition, seed))) for seed in range(5)}


@says("Where {}, the rank is # instead of #.")
def _rank_where(m: Mechanism, s: Sentence) -> bool:
    less, most = map(int, s.words)
    return _ranks_where(m, s.formulas[0]) == {less} and {
        rank(m.result(m.singular, p)) for p in m.points()
    } == {most}


@says("Where {}, the rank is in general # instead of #.")
def _rank_of_most(m: Mechanism, s: Sentence) -> bool:
    """A part of the set may have another."""
    less, most = map(int, s.words)
    return max(_ranks_where(m, s.formulas[0])) == less < most


@says("Where {}, the rank is #.")
def _rank_of_a_part(m: Mechanism, s: Sentence) -> bool:
    return _ranks_where(m, s.formulas[0]) == {int(s.words[0])}


@says("Where {&}, more is free than the columns of {} span, and the equations are too few.")
def _more_is_free(m: Mechanism, s: Sentence) -> bool:
    *where, letter = s.formulas
    for condition in where:
        p = m.where(condition)
        Z = next(m.value(one.parts[-1], p) for one in s.shown() if one.parts[0] == letter)
        if rank(Z) >= len(Z) - rank(m.result("Ac", p)):
            return False
    return True


@says("The rank of {} is <# more than|as great as> that of what is left.")
def _cleared(m: Mechanism, s: Sentence) -> bool:
    core = next(block.node for block in s.step[s.place :] if isinstance(block, document.Formula))
    pivots = int(s.words[1] or 0)
    return all(rank(s.jacobian(m, p)) == pivots + rank(m.value(core, p)) for p in m.points())


@says("The rank is #, and the dimension of this space #.")
def _dimension(m: Mechanism, s: Sentence) -> bool:
    J = s.jacobian(m, m.point())
    told, dimension = map(int, s.words)
    rows, columns = J.shape
    left = told if "possible" in s.where else (rows if "lost" in s.where else columns) - told
    return (
        rank(J) == told
        and dimension == left
        and all(_is_basis(m, s, told, m.point(p)) for p in m.right_angles())
    )


def _is_basis(m: Mechanism, s: Sentence, told: int, p: Point) -> bool:
    """Whether the vectors of a space are independent at a pose where the conditions are met."""
    said = [nodes for text, nodes in s.before() if text.startswith("All this holds where")]
    needed = [node for nodes in said for node in nodes if isinstance(node, tree.Relation)]
    vectors = s.vectors()
    if (
        not vectors
        or rank(s.jacobian(m, p)) < told
        or any(near(m.value(one.parts[0], p), 0) for one in needed)
    ):
        return True
    return rank(np.hstack([m.value(node, p) for node in vectors])) == len(vectors)


@says("All others are 0, or differ from <these|this> in sign alone:")
def _other_minors(m: Mechanism, s: Sentence) -> bool:
    """Of the matrix that the step shows, or the Jacobian: its minors as large as its rank."""
    blocks = (block.node for block in s.step[: s.place] if isinstance(block, document.Formula))
    core = next((node for node in blocks if isinstance(node, tree.Matrix)), None)
    shown = s.display_after()
    for p in m.points():
        J = s.jacobian(m, p) if core is None else m.value(core, p)
        size, told = rank(J), [abs(m.value(node.parts[-1], p)) for node in shown]
        parts = product(*(combinations(range(count), size) for count in J.shape))
        minors = [abs(np.linalg.det(J[np.ix_(rows, columns)])) for rows, columns in parts]
        if not all(any(near(minor, value) for value in (0, *told)) for minor in minors):
            return False
    return True


@says("<A force|A moment|A force and a moment|What acts> along <it|them>[, {},] need[s] no ....")
def _no_torque(m: Mechanism, s: Sentence) -> bool:
    """The vectors that the step shows, against the Jacobian that it shows, where it is singular."""
    where = [nodes[0] for text, nodes in s.before() if text.startswith("Where ") and nodes]
    point = m.where(where[0]) if where else m.point()
    J = s.jacobian(m, point)
    columns = [node for shown in s.shown() for node in walk(shown.parts[-1]) if isinstance(node, tree.Matrix)]
    vectors = [m.value(node, point) for node in columns if (len(node.rows), len(node.rows[0])) == (len(J), 1)]
    return bool(vectors) and all(near(J.T @ vector, 0) for vector in vectors if vector is not J)


@says("In general {&} are independent.", "Where {&} is 0 it tells nothing.")
def _independent(m: Mechanism, s: Sentence) -> bool:
    """Of the vectors that the step shows by these letters, at some pose where it is singular."""
    where = [nodes[0] for text, nodes in s.before() if text.startswith("Where ") and nodes]
    point = m.where(where[0]) if where else m.point()
    shown = [one.parts[-1] for one in s.shown() if one.parts[0] in s.formulas]
    columns = np.hstack([m.value(node, point) for node in shown])
    return len(shown) == len(s.formulas) and rank(columns) == len(shown)


GENERAL = """
Where a coordinate moves several joints, its column is the sum of theirs, each times the rate
  at which that joint moves with it.
Each {} leads one frame further along the arm, so it multiplies from the right.
Let all parameters be positive[, and the tensors those of bodies][, and {&}].
{} is symmetric, and may depend on the coordinates, but on no rate.
Read off[ from the forces] and assembled directly: the same {&}.
From the equations of Lagrange: the same {&}.
The tensor along the body's own axes put in:
By {&}[, and the numbers multiplied]; the second product multiplied out, with the same:
In the <standard|modified> convention ...
Other matrices {} give the same {}, which is all that the equations of motion fix.
With the square of a rate it is centrifugal: it remains where that coordinate alone moves.
With the product of two rates it is a Coriolis term: it needs both to move.
A point mass has no extent, so its tensor about its own mass centre is zero and it has no rotational energy.
Below the energy is worked out along the body's own axes, where the tensor is {}.
[Along the body's own axes[, multiplied out]][From there along the body's own axes, by {}][Along the axes
  of frame #][, with ...]:
Along the body's own axes it is {}, and the angular velocity is {}.
Verified: ...
The other results that are asked for agree with independent computations in numbers.
{}[ with {}] is the tensor along the axes of the <base|world>.
By Sylvester's criterion[, which may start from either end of the diagonal,] it remains to show that the
  determinant[s] below <is|are> positive.
The sum is the same {}, entry by entry.
{}, and no body[ and no rotor] has a negative kinetic energy: where their sum is 0, each of them is 0.
In each line the rates of the lines before are 0, so that it is 0 only where its own rate is:
No body adds anything negative to {}, which is {} where {} and the other rates are 0.
{} has a minimum where ..., a maximum where ...; at a minimum the equilibrium is stable[ in {&}], elsewhere
  it is not:
A rotation leaves the <length of {}|products of the columns> unchanged; along the axes of frame #[, with
  ...]:
About the mass centre, by the parallel-axis theorem:
A joint <turns about|slides along|turns about or slides along> the {} of <its own frame|the frame that its
  row starts from>.
Its parts; the others are zero:
In the results, how the base is turned matters to the potential energy and the gravity terms alone: a
  constant rotation leaves lengths unchanged, so it cancels in the kinetic energy.
Every vector of link i is written along the axes of its own frame i, in which the mass centre and the tensor
  are constant.
Entry by entry, by the chain rule: every joint variable in an entry moves.
Constant lengths are not 0[, so one case is left].
Frame # is the one to take: in the modified convention it is fixed in link #, and frame # moves with the
  next link.
And it is positive definite in every configuration: its leading minors are positive.
The ... is made of slices dx with the mass {}; {} runs along ... of its frame from the near end, 0, to the
  far one.
Multiplied out, {} is a sum of ...
Those that are combinations of others are left out, and so are factors that are positive, as masses and
  lengths of the table are.
A motor gives the component of what its joint holds along the joint's axis; the bearings hold the others.
A joint moves all links after it like one body.
The coefficients that occur[ with {&}], ...
{} lies along each joint axis in the direction that is given.
#; {}; slides along; {}; {}
Letters are positive and independent of each other: what vanishes for some of their values alone does not
  count as 0.
At random joint values this table moves the hand as the product of the exponentials of the drawn axes does.
<It exists|It is determined|They are determined|This is so> where the rows of {} are independent[: not where
  ...].
It exists where {}.
Each axis is carried along by the turns before it, so that its matrix stands on the right.
The angular velocity is the sum over the turns: the rate of each angle along its axis, as the turns before
  it have carried that.
What is seen from the world is then written along the axes of frame #.
A coordinate that stands in a formula is that of the same <solution|line>.
Its rows may be turned among each other, as by other axes, and multiples of rows and columns added to
  others: that leaves the rank as it is.
Where an entry is never 0, its row and column can so be cleared and count 1.
The singular configurations:
{} lies along the axis of joint #; the origin may be anywhere on it, and {} may point anywhere across it.
{} stays along it, and {} may point anywhere across: it is that of frame #, so that nothing is turned in the
  pose that is drawn.
Along <row|column> #, each entry times the determinant that is left, signs in turn[, with ...]:
#; {}; slides along; {}; anywhere
The axis of joint # may be anywhere along the direction, for a slide has no place.
Taken are {}, and the origin with which {} has no constant part.
Only the other joints move it to its place, and the wrist then turns the hand: position and rotation are
  decoupled.
The last joint does not move its own axis: the first two turn that to where it is to be ...
Combined, without factors that are never 0:
Combined with the constraints, without factors that are never 0:
The parameters are the same.
What is left of ℒ where nothing moves, with the opposite sign.
Along what the constraints leave free, the columns of {} with {}, <the energy|it> is curved as {} is, with
  the {} of the equilibrium.
Where that is positive definite, the <equilibrium|motion> is stable; where <the energy|{}> falls in some
  direction, it is not.
Where the energy is curved upwards along each of them, the equilibrium is stable; where it falls along one, it
  is not.
How stable <they|the others> are is not told here.
All this is where {} is positive definite.
All this is without Coulomb friction[, which can hold what is not stable].
The same is so for special parameters.
Along the axis of a joint the force, where it slides, or the moment, where it turns, is what drives it.
Section # has ....
Where nothing moves: not derived.
The singular configurations: not derived.
At given values of q the rank of the Jacobian shows whether the arm is singular.
The kinetic energy needs the <moment about the parallel axis through|tensor about> the mass centre.
The first of the relative coordinates of a chain does not occur.
The entries of {}, below, are chosen: independent ones of which all of these are combinations.
Other independent combinations serve as well:
It is given along axes of its link, and turned into the world.
Each motion is along or about an axis of the frame that those before it have led to.
Where the matrix of <the|its> second derivatives[ of the <potential energy|energy {}, the ...>] is positive
  definite, the <equilibrium|motion> is stable; where <the energy|{}> falls in some direction, it is not.
"""
"""What is true of every mechanism, or is a step of a proof whose end is held; indented lines go on."""

IS_GENERAL = re.compile(
    "|".join(pattern(words).pattern for words in GENERAL.replace("\n  ", " ").split("\n") if words)
)


def untrue_sentences(
    mechanism: Mechanism, *reports: tuple[document.Block, ...]
) -> Iterator[tuple[Sentence, str]]:
    """The claims that are not true, or that nothing holds, each with what is wrong.

    What the first report says, the fullest, is not held again in others, which show less of a step.
    """
    remarks = [text for remark in mechanism.solution.problem.remarks for text in remark.texts]
    held: set[tuple[str, tuple[Node, ...]]] = set()
    for blocks in reports:
        claims = [told for told in sentences(blocks) if WORDS.search(told.text)]
        for sentence in claims:
            is_held = (sentence.text, sentence.formulas) in held or IS_GENERAL.fullmatch(sentence.text)
            if is_held or any(sentence.text in remark for remark in remarks):
                continue
            if why := _wrong(mechanism, sentence):
                yield sentence, why
        held |= {(sentence.text, sentence.formulas) for sentence in claims}


def _wrong(mechanism: Mechanism, sentence: Sentence) -> str:
    """What is wrong with a claim; '' for nothing."""
    for form, claim in CLAIMS.items():
        if match := form.fullmatch(sentence.text):
            words = tuple(word or "" for word in match.groups())
            try:
                return "" if claim(mechanism, replace(sentence, words=words)) else "is not true"
            except Unknown:
                return "speaks of what has no value"
    return "a claim that nothing holds"
