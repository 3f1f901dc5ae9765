"""Which places on paper are taken."""

from __future__ import annotations

from random import Random

from dynsolve.draw import paths
from dynsolve.draw.labels import CELL, Box, Taken


def test_the_cells_in_a_box_are_counted_as_lines_are_added() -> None:
    """Against every cell of the box asked for by itself."""
    random, taken = Random(7), Taken()
    assert taken.inside(Box(-9.0, -9.0, 9.0, 9.0)) == 0
    for _ in range(40):
        a, b, corner = (tuple(random.uniform(-40, 40) for _ in range(2)) for _ in range(3))
        taken.add_line(a, b)
        box = Box(corner[0], corner[1], corner[0] + random.uniform(0, 30), corner[1] + random.uniform(0, 30))
        columns = range(int(box.left // CELL), int(box.right // CELL) + 1)
        rows = range(int(box.top // CELL), int(box.bottom // CELL) + 1)
        middles = [((i + 0.5) * CELL, (j + 0.5) * CELL) for i in columns for j in rows]
        assert taken.inside(box) == sum(taken.inside(Box(*middle, *middle)) for middle in middles)
        assert taken.inside(Box(*a, *a)) == 1


def test_an_area_is_taken_with_its_inside() -> None:
    """A square of 10 by 10 cells."""
    taken = Taken()
    corners = [(0.5, 0.5), (0.5 + 9 * CELL, 0.5), (0.5 + 9 * CELL, 0.5 + 9 * CELL), (0.5, 0.5 + 9 * CELL)]
    taken.add([paths.Path(paths.polygon(corners), fill=paths.GREY)])
    assert taken.inside(Box(-100.0, -100.0, 100.0, 100.0)) == 100
