"""The quantities of one robot: all of them by name, and the parts that each consists of."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from functools import cached_property, lru_cache
from itertools import groupby

from msgspec import Struct

from dynsolve.notation.tree import Node
from dynsolve.quantities.families import FAMILIES
from dynsolve.quantities.family import Family, Owner
from dynsolve.quantities.letters import key, open_index, other_names, subscripts
from dynsolve.quantities.owners import MOST_INDEXED, Owners
from dynsolve.quantities.stages import Stage
from dynsolve.robot.model import JointType, Robot
from dynsolve.robot.units import LENGTH, Dimension, times

Shape = tuple[int, int] | None
"""Rows and columns of a quantity; None for a scalar."""


class Quantity(Struct, frozen=True, eq=False):
    """One quantity of a robot.

    `name` is what answers and results call it (f2, d12, Kv1), `rule` the rule of the
    derivation that gives it (tau2, D, Kv1).  `index` says whose it is, from 1: the row's
    number, the place of the body or the coordinate, the indices of an entry.  `whole` is
    what it is part of, empty for most, and `entry` its place there, from 0, if that is a
    matrix, a vector or the Christoffel symbols (which are kept for i ≤ j).
    """

    name: str
    rule: str
    family: Family
    index: tuple[int, ...]
    shape: Shape
    whole: str = ""
    entry: tuple[int, ...] = ()

    @property
    def is_read_off(self) -> bool:
        """Whether it has no rule of its own: an entry of D, C, g, a Christoffel symbol."""
        return bool(self.entry) and self.rule == self.whole

    @property
    def form(self) -> str:
        """The name that its compact form and its numbers go by: that of its rule, where it has its own."""
        return self.name if self.is_read_off else self.rule

    def letter(self, robot: Robot) -> Node:
        """The letter that it is printed with."""
        return self.family.letter(robot, *self.index)


class Quantities(Mapping[str, Quantity]):
    """The quantities by name, in the order of the derivation.

    >>> from dynsolve.quantities.owners import Owners
    >>> from dynsolve.robot.model import Coordinate, JointType
    >>> theta, d = Coordinate("theta1", JointType.REVOLUTE, 1), Coordinate("d2", JointType.PRISMATIC, 2)
    >>> found = Quantities(Owners(2, (theta, d), ("1", "p"), frozenset("p")))
    >>> found["Kp"].family, found["f2"].rule, found["d21"].entry, found["D"].shape
    (<Family K{b}>, 'tau2', (1, 0), (2, 2))
    >>> found.canonical("M"), found.canonical("tau2"), found.stage("Kp"), found.parts("Kp")
    ('D', 'f2', <Stage.ENERGY: 'energy'>, ('Kvp',))
    """

    def __init__(self, owners: Owners) -> None:
        self.owners = owners
        self._by_name: dict[str, Quantity] = {}
        for owner, families in groupby(filter(owners.has, FAMILIES), key=lambda family: family.owner):
            group = tuple(families)
            for index in owners.indices(owner):
                values = owners.template_values(owner, index)
                for family in group:
                    quantity = self._made(family, index, values)
                    self._by_name.setdefault(quantity.name, quantity)

    def _made(self, family: Family, index: tuple[int, ...], values: dict[str, str]) -> Quantity:
        name, whole = family.name.format(**values), family.part_of.format(**values)
        shape = family.shape and (self.owners.size(family.shape[0]), self.owners.size(family.shape[1]))
        return Quantity(name, family.rule.format(**values) or name, family, index, shape, whole,
                        self._entry(family, index))  # fmt: skip

    def _entry(self, family: Family, index: tuple[int, ...]) -> tuple[int, ...]:
        if not family.part_of or family.owner in (Owner.ROBOT, Owner.BODY):
            return ()
        places = tuple(i - 1 for i in index)
        if family.owner is Owner.TRIPLE:
            return (*sorted(places[:2]), places[2])
        return places if family.owner is Owner.PAIR else (places[0], 0)

    def __getitem__(self, name: str) -> Quantity:
        return self._by_name[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._by_name)

    def __len__(self) -> int:
        return len(self._by_name)

    # -- names -------------------------------------------------------------------------------------

    def canonical(self, text: str) -> str | None:
        """The name of the answer that `find` or `marks` calls so, None for what is none."""
        text = text.strip()
        found = self._by_name.get(self._aliases.get(text, text))
        return found.name if found is not None and found.family.is_answer else None

    def members(self, text: str) -> tuple[str, ...]:
        """The answers that `find` calls so: one, or all of a family (`rc`, `Kv`, `c`); none for what is none.

        Symbols that are equal by their nature (c_121 and c_211) are asked for once.
        """
        found = {
            (quantity.whole, quantity.entry) if quantity.entry else quantity.name: quantity.name
            for quantity in reversed(self._families.get(text.strip(), ()))
            if quantity.family.is_answer and self.is_real(quantity)
        }
        name = None if found else self.canonical(text)
        return (name,) if name else tuple(sorted(found.values(), key=self.position))

    @cached_property
    def _families(self) -> dict[str, list[Quantity]]:
        """The quantities of each family that has a name of its own, which no single answer has."""
        found: dict[str, list[Quantity]] = {}
        for quantity in self.values():
            stem = quantity.family.stem
            if quantity.index and stem not in self._by_name:
                found.setdefault(stem, []).append(quantity)
        return found

    @cached_property
    def _aliases(self) -> dict[str, str]:
        found: dict[str, str] = {}
        for quantity in self.values():
            for alias in self.spelled(quantity, quantity.family.aliases):
                found.setdefault(alias, quantity.name)
        return found

    def answers(self) -> Iterator[Quantity]:
        """The quantities that an answer may be given for."""
        return (quantity for quantity in self.values() if quantity.family.is_answer)

    def examples(self) -> tuple[str, ...]:
        """The names of the answers but for the entries of matrices."""
        return tuple(quantity.name for quantity in self.answers() if len(quantity.index) < 2)

    def spelled(self, quantity: Quantity, templates: tuple[str, ...]) -> Iterator[str]:
        """Templates of its family, filled in; each once."""
        owner = quantity.family.owner
        values = self.owners.template_values(owner, quantity.index)
        names: list[dict[str, str]] = [{}]
        if owner is Owner.COORDINATE:
            names = self._coordinate_names[quantity.index[0] - 1]
        elif owner is Owner.TASK:
            names = [{"name": name} for name in self.owners.task_names[quantity.index[0] - 1]]
        return iter(dict.fromkeys(text.format(**values, **more) for text in templates for more in names))

    @cached_property
    def _coordinate_names(self) -> list[list[dict[str, str]]]:
        """The values of {q}, {name} and {s} for each coordinate, once for each of its names."""
        spoken = {q.name: subscript for subscript, q in subscripts(self.owners.coordinates).items()}
        return [
            [{"q": other, "name": other_names(q, spoken[q.name])[0], "s": spoken[q.name]}
             for other in other_names(q, spoken[q.name])]
            for q in self.owners.coordinates
        ]  # fmt: skip

    # -- wholes and parts --------------------------------------------------------------------------

    def stage(self, name: str) -> Stage:
        """The stage that the marks of an answer count in."""
        family = self[name].family
        return family.capped_in or family.stage

    def of_rule(self, rule: str) -> Quantity | None:
        """The quantity that a rule of the derivation gives: tau2 gives f2."""
        return self._by_rule.get(rule)

    @cached_property
    def _by_rule(self) -> dict[str, Quantity]:
        return {quantity.rule: quantity for quantity in self.values() if not quantity.is_read_off}

    def result(self, name: str) -> Quantity | None:
        """The quantity of a result, found by its name or by that of its rule."""
        return self.get(name) or self.of_rule(name)

    def of_family(self, family: Family) -> tuple[Quantity, ...]:
        """The members of a family, in their order."""
        return tuple(quantity for quantity in self.values() if quantity.family is family)

    def entry_of(self, name: str) -> tuple[str, tuple[int, ...]]:
        """The matrix or vector that an answer is an entry of, and its place there, from 0."""
        quantity = self.get(name)
        return (quantity.whole, quantity.entry) if quantity is not None and quantity.entry else ("", ())

    def parts(self, name: str) -> tuple[str, ...]:
        """The answers that a whole can be given by: its entries, or what it is added up from."""
        return tuple(self._parts.get(name, ()))

    def within(self, name: str) -> Iterator[str]:
        """An answer and all that it can be given by, part by part."""
        yield name
        for part in self.parts(name):
            yield from self.within(part)

    @cached_property
    def _parts(self) -> dict[str, list[str]]:
        found: dict[str, list[str]] = {}
        all_named = len(self.owners.coordinates) <= MOST_INDEXED
        for quantity in self.answers():
            if quantity.whole and self.is_real(quantity) and (all_named or len(quantity.index) < 2):
                found.setdefault(quantity.whole, []).append(quantity.name)
        return found

    def is_real(self, quantity: Quantity) -> bool:
        """Whether it exists: a point mass has no tensor and no energy of rotation."""
        if not quantity.family.needs_rotation:
            return True
        return self.owners.bodies[quantity.index[0] - 1] not in self.owners.points

    def mirrored(self, name: str) -> str:
        """The entry across the diagonal, which is equal: d21 for d12; the name itself for all others."""
        quantity = self.get(name)
        if quantity is None or not quantity.family.is_symmetric_entry:
            return name
        i, j = quantity.index
        return quantity.family.name.format(i=j, j=i)

    def position(self, name: str) -> int:
        """Where a name stands in the order of the derivation; others come last."""
        return self._positions.get(name, len(self))

    @cached_property
    def _positions(self) -> dict[str, int]:
        return {name: position for position, name in enumerate(self)}

    def dimension(self, quantity: Quantity, row: int = 0, column: int = 0) -> Dimension | None:
        """The dimension of an entry of a quantity, counted from 0; None where nothing is known of it."""
        family = quantity.family
        if family.dimension is None:
            return None
        found = family.dimension
        for which in family.per:
            k = {"row": row, "column": column, "owner": quantity.index[0] - 1 if quantity.index else 0}[which]
            if self.owners.coordinates[k].type is JointType.PRISMATIC:
                found = times(found, LENGTH, -1)
        return found

    # -- spellings ---------------------------------------------------------------------------------

    @cached_property
    def spellings(self) -> Mapping[str, tuple[str, ...]]:
        """The answers by what students write for them, without `_` and braces; several where that is shared.

        I1 may be the tensor along the body's axes and along those of the base, V is P or C q̇.
        What belongs to the only body may be written without its name: K_v.
        """
        found: dict[str, dict[str, None]] = {}
        for quantity in self.answers():
            family = quantity.family
            for text in (quantity.name, *self.spelled(quantity, family.spellings)):
                found.setdefault(key(text), {})[quantity.name] = None
            fallbacks = tuple(self.spelled(quantity, family.fallback_spellings))
            if fallbacks and fallbacks[0] not in found:
                for text in fallbacks:
                    found.setdefault(text, {})[quantity.name] = None
        if len(self.owners.bodies) == 1:
            for quantity in self.answers():
                if quantity.family.owner is Owner.BODY:
                    for text in (quantity.family.name, *quantity.family.spellings):
                        found.setdefault(key(text.replace("{b}", "")), {quantity.name: None})
        return {text: tuple(names) for text, names in found.items()}

    @cached_property
    def open_spellings(self) -> Mapping[str, tuple[str, ...]]:
        """The same for names whose index is out of range: `K#` are K1, K2, ..., `d##` entries of D."""
        found: dict[str, set[str]] = {}
        for text, names in self.spellings.items():
            stem = open_index(text)
            if stem:
                found.setdefault(stem, set()).update(name for name in names if self[name].index)
        return {stem: tuple(sorted(names, key=self.position)) for stem, names in found.items() if names}


@lru_cache(maxsize=64)  # asked for at every hand-in; 18 ms to make for a 7R arm, 0.01 ms to find
def _made(owners: Owners) -> Quantities:
    return Quantities(owners)


def quantities(robot: Robot) -> Quantities:
    """The quantities of a robot."""
    return _made(Owners.of(robot))
