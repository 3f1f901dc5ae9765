"""Steps of the vectorized form: D, C and g read off from τ, assembled directly, and compared."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from dynsolve.algebra import matrix as algebra
from dynsolve.derivation.agreement import agreement
from dynsolve.document import Prose
from dynsolve.explain.course import Course, is_small, listed, shv
from dynsolve.explain.step import Detail, Step
from dynsolve.notation.tree import (
    BigSum,
    Letter,
    Negative,
    Node,
    Number,
    Parenthesized,
    Product,
    Row,
    Sum,
    Symbol,
    Transpose,
    column,
    equation,
)
from dynsolve.quantities import letters
from dynsolve.quantities.stages import Stage
from dynsolve.robot.model import Body

STAGE = Stage.VECTORIZED

LONGEST_IN_PARTS = 150
"""Up to this number of terms in D its parts are shown too."""

MOST_ZEROS = 20
"""Up to this number Christoffel symbols that are zero are named one by one."""

_I, _J, _K, _N = (Symbol(name) for name in "ijkn")
_SKEW = Sum((letters.bold("D", dots=1), Negative(Product((Number(2), letters.C)))))


def steps(course: Course) -> Iterator[Step]:
    """D, c_ijk, C and g; then the comparisons, and the whole model."""
    yield _inertia(course)
    yield _rest(course)
    yield _inertia_direct(course)
    if _is_short(course):
        for body in course.robot.bodies:
            yield _part(course, body)
    yield _christoffel(course)
    yield _coriolis(course)
    yield _gravity(course)
    yield _agreement(course)
    yield _skew(course)
    yield _model(course)


def _names(course: Course, letter: str) -> tuple[tuple[Node, ...], ...]:
    return letters.entries(letter, course.robot.n, course.robot.n)


def _inertia(course: Course) -> Step:
    return Step(
        id="D",
        stage=STAGE,
        title="D, read off from the forces",
        why=(
            "Entry (i, j) is the factor of the j-th acceleration in the i-th force. D is symmetric, "
            "and may depend on the coordinates, but on no rate.",
        ),
        formula=equation(_d(_I, _J), letters.slope(Letter("tau", _I), Letter("q", _J, dots=2))),
        source=shv("7.3"),
        result=(equation(letters.D, course.form("D")),),
        entries=_names(course, "d"),
        detail=Detail.BRIEF,
    )


def _rest(course: Course) -> Step:
    """What is left of the forces without accelerations: C q̇ and g."""
    values = course.values
    Cqd = Product((letters.C, letters.QD))
    why: Prose = ("What is left of the forces without the accelerations: the terms with rates are ",)
    why += (Cqd, "; the others, which remain when the arm is at rest, are ", letters.G, ".")
    if values["Cqd"].is_zero:
        why += (" No term has rates here.",)
    if values["g"].is_zero:
        why += (" Nothing remains at rest here.",)
    return Step(
        id="Cqd",
        stage=STAGE,
        title="C q̇ and g, read off from the forces",
        why=why,
        formula=equation(
            Sum((Cqd, letters.G)), Sum((letters.TAU, Negative(Product((letters.D, letters.QDD)))))
        ),
        source=shv("7.3"),
        result=(equation(Cqd, course.form("Cqd")), equation(letters.G, course.form("g"))),
    )


def _d(*indices: Node) -> Letter:
    return Letter("d", Row(indices))


def _inertia_direct(course: Course) -> Step:
    robot = course.robot
    i = Symbol("i")
    jv, jw = (letters.bold("J", Letter(part, i)) for part in ("v", "omega"))
    linear = Product((Letter("m", i), Transpose(jv), jv))
    angular = Product((Transpose(jw), Letter("I", i, style="script"), jw))
    total = Parenthesized(Sum((linear, angular)))
    same = course.values["D"] == course.values["D_direct"]
    terms: list[Node] = []
    for body in robot.bodies:
        Jv, Jw = letters.jv(body), letters.jw(body)
        terms.append(Product((course.mass(body), letters.transposed_product(Jv))))
        if not body.is_point:
            terms.append(letters.transposed_product(Jw, letters.of_body("I", body, "script")))
    working = equation(letters.D, terms[0] if len(terms) == 1 else Sum(tuple(terms)))
    name = Number(len(robot.bodies))
    return Step(
        id="D_direct",
        stage=STAGE,
        title="D, assembled from the Jacobians",
        why=(
            "Without the Lagrangian: ",
            equation(letters.K, Product((letters.HALF, letters.transposed_product(letters.QD, letters.D)))),
            ", so D is a sum over the bodies.",
            " A point mass has no second term." if any(body.is_point for body in robot.bodies) else "",
            " It gives the same D, entry by entry." if same else " It does not give the same D.",
        ),
        formula=equation(letters.D, BigSum(total, i, Number(1), name)),
        source=shv("7.3"),
        working=(working,),
    )


def _is_short(course: Course) -> bool:
    """Whether D is short enough for its parts to be of use to a reader."""
    return sum(len(entry) for entry in course.values["D"].entries) <= LONGEST_IN_PARTS


def _part(course: Course, body: Body) -> Step:
    """What one body adds to D."""
    b = body.name
    Jv, Jw = letters.jv(body), letters.jw(body)
    linear = Product((course.mass(body), letters.transposed_product(Jv)))
    angular = letters.transposed_product(Jw, letters.of_body("I", body, "script"))
    results = [equation(linear, course.form(f"Dv{b}"))]
    if not body.is_point:
        results.append(equation(angular, course.form(f"Dw{b}")))
    return Step(
        id=f"D_direct{b}",
        stage=STAGE,
        title=f"What body {b} adds to D",
        why=("Its linear part, and none of rotation: it is a point.",)
        if body.is_point
        else ("Its linear part and its rotational part.",),
        source=shv("7.3"),
        result=tuple(results),
        detail=Detail.FULL,
    )


# -- Christoffel symbols ---------------------------------------------------------------------------


def _christoffel(course: Course) -> Step:
    n = course.robot.n
    nonzero, zero = _sorted_symbols(course)
    general = equation(
        Letter("c", Row((_I, _J, _K))),
        Product((
            letters.HALF,
            Parenthesized(Sum((
                letters.slope(_d(_K, _J), Letter("q", _I)),
                letters.slope(_d(_K, _I), Letter("q", _J)),
                Negative(letters.slope(_d(_I, _J), Letter("q", _K))),
            ))),
        )),
    )  # fmt: skip
    results = tuple(_symbol(course, *indices) for indices in nonzero)
    return Step(
        id="christoffel",
        stage=STAGE,
        title="Christoffel symbols",
        why=_christoffel_why(n, len(nonzero)),
        formula=general,
        source=shv("7.3"),
        result=results or (),
        notes=tuple(_zero_note(zero)) if nonzero else (),
    )


def _christoffel_why(n: int, count: int) -> Prose:
    if not count:
        return ("D is constant, so every Christoffel symbol is zero.",)
    swapped = equation(Letter("c", Row((_I, _J, _K))), Letter("c", Row((_J, _I, _K))))
    why: Prose = ("They say how D changes as the arm moves. ",)
    if n > 1:
        why += ("The first two indices may be swapped: ", swapped, ". ")
    return (*why, "Partial derivatives that are zero are left out.")


def _sorted_symbols(course: Course) -> tuple[list[tuple[int, int, int]], list[tuple[int, int, int]]]:
    """The indices (from 0) of the distinct symbols, i ≤ j: those that are not zero, and those that are."""
    symbols = course.values["christoffel"]
    order = sorted(symbols, key=lambda ijk: (ijk[2], ijk[0], ijk[1]))
    nonzero = [ijk for ijk in order if not symbols[ijk].is_zero]
    return nonzero, [ijk for ijk in order if symbols[ijk].is_zero]


def _symbol(course: Course, i: int, j: int, k: int) -> Node:
    """c_ijk = c_jik = ½ (...) = its value; partial derivatives that are zero are left out."""
    ring, D = course.robot.ring, course.values["D"]
    value = course.forms.christoffel(i, j, k)
    names: list[Node] = [letters.entry("c", i + 1, j + 1, k + 1)]
    if i != j:
        names.append(letters.entry("c", j + 1, i + 1, k + 1))
    slopes = [(D[k, j], (k, j), i, 1), (D[k, i], (k, i), j, 1), (D[i, j], (i, j), k, -1)]
    weights: dict[tuple[tuple[int, int], int], int] = {}
    for entry, (row, col), by, sign in slopes:
        if not ring.diff(entry, by).is_zero:
            key = ((min(row, col), max(row, col)), by)
            weights[key] = weights.get(key, 0) + sign
    parts = [_weighted(course, key, weight) for key, weight in weights.items() if weight]
    return equation(*names, _halved(parts), value)


def _weighted(course: Course, key: tuple[tuple[int, int], int], weight: int) -> tuple[int, Node]:
    (row, col), by = key
    name = letters.entry("d", row + 1, col + 1)
    return weight, letters.slope(name, Symbol(course.robot.coordinates[by].name))


def _halved(parts: Sequence[tuple[int, Node]]) -> Node:
    """½ (Σ weight·slope), with weights 1, 2 and -1; a factor 2 that stands alone cancels."""
    if len(parts) == 1:
        weight, slope = parts[0]
        node = slope if abs(weight) == 2 else Product((letters.HALF, slope))
        return Negative(node) if weight < 0 else node
    terms = []
    for weight, slope in parts:
        term = Product((Number(2), slope)) if abs(weight) == 2 else slope
        terms.append(Negative(term) if weight < 0 else term)
    return Product((letters.HALF, Parenthesized(Sum(tuple(terms)))))


def _zero_note(zero: Sequence[tuple[int, int, int]]) -> Iterator[Prose]:
    if not zero:
        return
    if len(zero) > MOST_ZEROS:
        yield ("All the others are zero.",)
        return
    yield (
        *listed([letters.entry("c", i + 1, j + 1, k + 1) for i, j, k in zero]),
        " are zero." if len(zero) > 1 else " is zero.",
    )


# -- C and g ---------------------------------------------------------------------------------------


def _coriolis(course: Course) -> Step:
    entry = Letter("c", Row((_K, _J)))
    body = Product((Letter("c", Row((_I, _J, _K))), Letter("q", _I, dots=1)))
    Cqd = Product((letters.C, letters.QD))
    none = course.values["C"].is_zero
    why: Prose = ("Row k, column j. ", Cqd, " holds the centrifugal terms (a rate squared)")
    why += (" and the Coriolis terms (a product of two rates)",) if course.robot.n > 1 else ()
    why += (". There are none here.",) if none else (". Multiplied out, it is the one read off above.",)
    return Step(
        id="C",
        stage=STAGE,
        title="C, from the Christoffel symbols",
        why=why,
        formula=equation(entry, BigSum(body, _I, Number(1), _N)),
        source=shv("7.3"),
        result=(equation(letters.C, course.form("C")),),
        entries=_names(course, "c"),
        notes=()
        if none or course.robot.n == 1
        else (
            (
                "Other matrices C give the same ",
                Cqd,
                ", which is all that the equations of motion fix. This choice makes ",
                _SKEW,
                " skew-symmetric.",
            ),
        ),
        detail=Detail.BRIEF,
    )


def _gravity(course: Course) -> Step:
    still = course.values["g"].is_zero
    why: Prose = ("Directly, without τ: the partial derivatives of the potential energy.",)
    if still:
        why += (" It does not depend on any coordinate, so g is zero.",)
    return Step(
        id="g",
        stage=STAGE,
        title="g, from the potential energy",
        why=why,
        formula=equation(Letter("g", _K), letters.slope(letters.P, Letter("q", _K))),
        source=shv("7.3"),
        result=(equation(letters.G, course.form("g")),),
        entries=letters.entries("g", course.robot.n, 1),
        detail=Detail.BRIEF,
    )


# -- the checks ------------------------------------------------------------------------------------


def _agreement(course: Course) -> Step:
    held = course.agreement or agreement(course.robot, course.values)
    verdicts = {"D": held.inertia, "C q̇": held.coriolis, "g": held.gravity}
    same = [name for name, holds in verdicts.items() if holds]
    wrong = [name for name, holds in verdicts.items() if not holds]
    why = ""
    if same:
        verb = "is" if len(same) == 1 else "are"
        why = f"{_and(same)}, read off from the forces and assembled directly, {verb} equal, exactly."
    if wrong:
        why += f" The two ways differ in {_and(wrong)}."
    return Step(
        id="agreement",
        stage=STAGE,
        title="Both ways agree" if not wrong else "The two ways differ",
        why=(why.strip(),),
        source=shv("7.3"),
    )


def _and(names: Sequence[str]) -> str:
    return " and ".join([", ".join(names[:-1]), names[-1]] if len(names) > 1 else names)


def _skew(course: Course) -> Step:
    robot = course.robot
    ring = robot.ring
    D, C = course.values["D"], course.values["C"]
    result: tuple[Node, ...] = ()
    if is_small(course.form("D"), course.form("C")):
        N: algebra.Matrix = D.map(ring.time_derivative) - C.scale(ring.constant(2))
        result = (equation(letters.bold("N"), course.show(N)),)
    name = letters.bold("N")
    return Step(
        id="skew",
        stage=STAGE,
        title="Check: Ḋ - 2C is skew-symmetric",
        why=(
            "With C from the Christoffel symbols, N plus its transpose is zero, compared exactly, so that ",
            equation(letters.transposed_product(letters.QD, name), Number(0)),
            " whatever the rates. Passivity rests on that.",
        ),
        formula=equation(name, _SKEW),
        source=shv("7.5.1"),
        result=(*result, equation(Sum((name, Transpose(name))), Number(0))),
    )


def _model(course: Course) -> Step:
    robot = course.robot
    model = equation(
        Sum((
            Product((letters.D, letters.QDD)),
            Product((letters.C, letters.QD)),
            letters.G,
        )),
        letters.TAU,
    )  # fmt: skip
    parts = [course.form(name) for name in ("D", "C", "g")]
    qd = column(*(Symbol(q.name, 1) for q in robot.coordinates))
    qdd = column(*(Symbol(q.name, 2) for q in robot.coordinates))
    forces = column(*(letters.force(q) for q in robot.coordinates))
    result: tuple[Node, ...] = ()
    if is_small(*parts):
        result = (equation(Sum((Product((parts[0], qdd)), Product((parts[1], qd)), parts[2])), forces),)
    return Step(
        id="model",
        stage=STAGE,
        title="The dynamical model",
        why=(
            Product((letters.D, letters.QDD)),
            " are the inertial forces, ",
            Product((letters.C, letters.QD)),
            " the Coriolis and centrifugal ones, ",
            letters.G,
            " those of gravity.",
        ),
        formula=model,
        source=shv("7.3"),
        result=result,
        optional=True,
        detail=Detail.BRIEF,
    )
