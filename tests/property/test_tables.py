"""Tables of the same arm in other frames are right; tables of another arm are wrong.

Other frames come of the identities of the elementary motions: with Rot_x(180°) between two rows z is
turned round, with Rot_z(180°) x is.
"""

from __future__ import annotations

from hypothesis import given, settings
from hypothesis import strategies as st
from msgspec.structs import replace

from dynsolve.answers.judging.mechanism.tables import Agreement, Table, TableComparer, TableRow, key_table
from dynsolve.notation.build import negated, total
from dynsolve.notation.tree import Degrees, Node, Symbol
from dynsolve.problem import read_problem
from tests.drawings import drawings
from tests.property.test_drawings import read

HALF_TURN, QUARTER = Degrees(180), Degrees(90)


def turned(row: TableRow, column: int, angle: Node) -> TableRow:
    return row.changed(column, total([row.constants[column], angle]))


def opposite(row: TableRow, *columns: int) -> TableRow:
    for column in columns:
        row = row.changed(column, negated(row.constants[column]))
    return row


def z_turned_round(table: Table, i: int) -> Table:
    """Rot_x(180°) after row i (from 0): α_i + 180°; in the next row -θ, -d, α + 180°."""
    rows = list(table)
    rows[i] = turned(rows[i], 3, HALF_TURN)
    if i + 1 < len(rows):
        following = turned(opposite(rows[i + 1], 0, 1), 3, HALF_TURN)
        rows[i + 1] = replace(following, rates=tuple((k, -rate) for k, rate in following.rates))
    return tuple(rows)


def x_turned_round(table: Table, i: int) -> Table:
    """Rot_z(180°) after row i: θ_i + 180°, -a_i, -α_i; in the next row θ + 180°."""
    rows = list(table)
    rows[i] = opposite(turned(rows[i], 0, HALF_TURN), 2, 3)
    if i + 1 < len(rows):
        rows[i + 1] = turned(rows[i + 1], 0, HALF_TURN)
    return tuple(rows)


def counted_the_other_way(table: Table, i: int) -> Table:
    rates = tuple((k, -rate) for k, rate in table[i].rates)
    return (*table[:i], replace(table[i], rates=rates), *table[i + 1 :])


def z_turned_round_in_craigs(table: Table, i: int) -> Table:
    """Rot_x(180°) after row i of a modified table: α + 180°, -θ, -d there; in the next row α + 180°."""
    rows = list(table)
    own = turned(opposite(rows[i], 0, 1), 3, HALF_TURN)
    rows[i] = replace(own, rates=tuple((k, -rate) for k, rate in own.rates))
    if i + 1 < len(rows):
        rows[i + 1] = turned(rows[i + 1], 3, HALF_TURN)
    return tuple(rows)


def arms(convention: str) -> st.SearchStrategy[str]:
    other = {"standard": "modified", "modified": "standard"}[convention]
    return drawings(max_joints=4).map(lambda text: text.replace(other, convention))


@settings(deadline=None, max_examples=15)
@given(arms("modified"), st.lists(st.integers(0, 3), max_size=4))
def test_a_modified_table_in_other_frames_is_right(text: str, turns: list[int]) -> None:
    problem = read(text)
    table = key_table(problem.robot)
    for i in turns:
        if i < len(table):
            table = z_turned_round_in_craigs(table, i)
    assert isinstance(TableComparer(problem)(table), Agreement)


@settings(deadline=None, max_examples=25)
@given(arms("standard"), st.data())
def test_a_table_in_other_frames_is_right(text: str, data: st.DataObject) -> None:
    problem = read(text)
    table = key_table(problem.robot)
    comparer = TableComparer(problem)
    plain = comparer(table)
    assert isinstance(plain, Agreement) and plain.is_strict
    last = len(table) - 1
    changes = st.tuples(st.sampled_from([z_turned_round, x_turned_round]), st.integers(0, last))
    for change, i in data.draw(st.lists(changes, max_size=4)):
        table = change(table, i)
    first = turned(table[0], 0, QUARTER).changed(1, total([table[0].constants[1], Symbol("s0")]))
    if table[0].variable == 0:
        table = (first, *table[1:])
        comparer.letters = tuple({**letters, "s0": 0.3} for letters in comparer.letters)
    found = comparer(table)
    assert isinstance(found, Agreement)
    which = data.draw(st.integers(0, last))
    assert isinstance(comparer(counted_the_other_way(table, which)), Agreement)


@settings(deadline=None, max_examples=40)
@given(st.integers(0, 2), st.sampled_from([2, 3]))
def test_a_table_with_a_slip_is_wrong(row: int, column: int) -> None:
    """Of an arm without a free length: a of a row and α of a row that turns an axis are never free."""
    text = (
        "dh: [{theta: q1*, d: A, a: B, alpha: 30deg}, {theta: q2*, d: C, a: D, alpha: 45deg}, "
        "{theta: q3*, d: E, a: F, alpha: 60deg}]"
    )
    problem = read_problem(text)
    comparer, table = TableComparer(problem), key_table(problem.robot)
    slipped = turned(table[row], column, QUARTER if column == 3 else Symbol("A"))
    assert not isinstance(comparer((*table[:row], slipped, *table[row + 1 :])), Agreement)
