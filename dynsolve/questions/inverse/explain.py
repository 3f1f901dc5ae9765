"""Steps of the inverse kinematics: one unknown after the other, and the branches."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from math import inf, prod

from msgspec.structs import replace

from dynsolve.algebra.factors import is_never_zero, trig_factors
from dynsolve.algebra.matrix import Matrix as Values
from dynsolve.algebra.ring import Expr
from dynsolve.algebra.sampling import Transfer
from dynsolve.derivation.configurations import Conditions
from dynsolve.derivation.elimination import ParameterSigns
from dynsolve.derivation.singular.sets import Special, TooLong, common_zeros, existence
from dynsolve.derivation.singular.zeros import never_hold
from dynsolve.document import Prose, Table
from dynsolve.document.books import craig, spong
from dynsolve.document.sentences import opened, paragraph, say
from dynsolve.errors import AlgebraError
from dynsolve.explain.context import Context
from dynsolve.explain.step import NOTED, RESUMED, Detail, Line, Step
from dynsolve.explain.step import Part as Shown
from dynsolve.explain.writing import agreeing, and_joined, listed, turns
from dynsolve.notation.build import cost, power, split_sign, times, total
from dynsolve.notation.template import formula
from dynsolve.notation.tree import (
    ONE,
    Function,
    Letter,
    Matrix,
    Node,
    Number,
    Reference,
    Relation,
    Symbol,
    column,
    equation,
    names_in,
    with_formulas,
)
from dynsolve.notation.unicode import to_unicode
from dynsolve.quantities import letters
from dynsolve.questions.inverse.derive import REDUNDANT, is_redundant
from dynsolve.questions.inverse.equations import (
    Combined,
    Direct,
    Equation,
    Given,
    OfPoint,
    OfTurn,
    Origin,
    Squared,
    Turned,
    lineage,
)
from dynsolve.questions.inverse.figures import figure_of
from dynsolve.questions.inverse.forms import InverseForms, InverseFormulas
from dynsolve.questions.inverse.solving import FixedPoint, Part, Solving, Turn
from dynsolve.questions.inverse.subproblems import Length, OneLine, Remainder, RootLength, Solved, TwoLines
from dynsolve.questions.inverse.target import target_steps, task_of
from dynsolve.robot.model import Robot

SHORT = 4
"""Formulas with more operations are not repeated in the table of the branches."""


def steps(context: Context) -> Iterator[Step]:
    """What is to be solved, the unknowns in the order in which they are found, and the branches."""
    if "inverse" not in context.wanted:
        return
    forms = InverseForms(context.robot, context.values)
    yield _task(context, forms)
    if forms.solved is None:
        r = context.values["pose" if _is_pose(context.robot) else "r"]
        is_free = is_redundant(r)
        yield Step(
            id=_id_of_branches(forms),
            title="Infinitely many configurations" if is_free else "No closed form was found",
            why=_spare(context, r)
            if is_free
            else (
                "The equations were turned into the frames of the joints, squared and added. That there is "
                "no closed form is not shown.",
            ),
            detail=Detail.BRIEF,
            notes=() if is_free else tuple(_of_pieper(context.robot)),
            normal=NOTED,
            uses=(),
        )
    else:
        yield from _unknowns(forms, forms.solved.solving)
        yield _branches(forms, forms.solved.solving)
    if forms.target is not None:
        yield from target_steps(forms.target)


def _spare(context: Context, r: Values) -> Prose:
    """That the arm can move and keep the task, and what must hold of components that no joint moves."""
    needed = [
        equation(Symbol(name), context.show(value))
        for name, value in zip(context.robot.questions.reached, r.entries, strict=True)
        if not r.ring.depends_on_coordinates(value)
    ]
    text = " What is asked must have {needed}: no joint moves this|these."
    only = agreeing(text, len(needed)) if needed else ""
    return say(f"{opened(REDUNDANT)}.{only}", needed=listed(needed))


def _task(context: Context, forms: InverseForms) -> Step:
    """The pose that is to be reached, or the components of the task."""
    names = [*map(Symbol, context.robot.questions.reached)]
    asked, frame = column(*names), len(context.robot.joints)
    step = Step(
        id="inverse_task",
        title="What is to be solved",
        why=say(
            "The {values} of the task, {names}, {are} given, and the joint variables that give {them} are "
            "looked for.",
            values="value" if len(names) == 1 else "values",
            names=listed(names),
            are="is" if len(names) == 1 else "are",
            them="it" if len(names) == 1 else "them",
        ),
        formula=equation(letters.TASK, asked),
        source=spong("3.3"),
        uses=("r",),
        is_task=False,
    )
    if not _is_pose(context.robot):
        given = () if forms.target is None else forms.target.given
        numbers = (equation(Symbol(name), value) for name, value in given)
        return replace(step, result=(equation(context.form("r"), asked), *numbers))
    rows = [(*names[3 * k + 3 : 3 * k + 6], names[k]) for k in range(3)]
    last = (Number(0), Number(0), Number(0), Number(1))
    few = (
        f"With {context.robot.n} joint{'s' * (context.robot.n > 1)} only some poses are reached: the "
        "equations give the joint variables, and the others hold where the pose is one of these."
    )
    return replace(
        step,
        why=(
            "The position and the rotation of the last frame are given, and the joint variables that give "
            "them are looked for.",
        ),
        formula=equation(letters.H(context.robot, frame), Matrix((*rows, last))),
        source=spong("3.3.1"),
        uses=(f"H{frame}",),
        notes=((few,),) if context.robot.n < 6 else (),
    )


def _is_pose(robot: Robot) -> bool:
    task = robot.questions.task
    return task is not None and task.is_pose


def _of_pieper(robot: Robot) -> Iterator[Prose]:
    """What is known of three joints that turn, though they are not solved for in a known form."""
    entries = robot.questions.task.entries if robot.questions.task else ()
    points = [entry.quantity for entry in entries if isinstance(entry, Reference)]
    if robot.n == 3 and all(map(turns, robot.coordinates)) and len(points) == 3 and len(set(points)) == 1:
        yield (
            "Brought to one angle, the equations of a point that three joints turn are of degree four in the "
            "tangent of half that angle (Pieper 1968; Craig, section 4.6): at most four configurations reach "
            "it, or infinitely many.",
        )


def _id_of_branches(forms: InverseForms) -> str:
    """Where the target is given in numbers, the answer comes after the branches."""
    return "inverse" if forms.target is None else "inverse_branches"


# -- one unknown -----------------------------------------------------------------------------------


def _unknowns(forms: InverseForms, solving: Solving) -> Iterator[Step]:
    """The unknowns, one after the other."""
    before: tuple[Solved, ...] = ()
    general: list[Node | None] = []
    for number, part in enumerate(solving.parts, 1):
        yield from _starting(forms.inverse_formulas, part, number, before)
        for solved in part.solved:
            found = _unknown(forms, solved, before, part)
            told = found.formula in general
            yield replace(found, normal=found.normal & ~Shown.FORMULA) if told else found
            general.append(found.formula)
            before = (*before, solved)


def _unknown(forms: InverseForms, step: Solved, before: Sequence[Solved], part: Part) -> Step:
    """How one unknown is found."""
    formulas = forms.inverse_formulas
    known = {e.expr for earlier in before for e in lineage(earlier.equations)}
    needed = {e.expr: e for e in _new(step.equations, known)}.values()
    first, made = list[Equation](), list[Equation]()
    for e in needed:
        (first if isinstance(e.origin, Direct) or e.expr in known else made).append(e)
    lines = tuple(_lines(formulas, step, made))
    first.sort(key=lambda e: e.origin.index if isinstance(e.origin, Given) else inf)  # as in the task
    working = tuple(_equation(formulas, e) for e in first)
    results = formulas.results(Symbol(step.coordinate), step)
    shown = names_in(*results, *(lines[-1].formulas if lines else working))
    starts_anew = any(e.expr not in known for e in first)
    if isinstance(step, Remainder):
        gives = "a combination of the angles; the others are known now" if step.others else "this angle"
        why: Prose = (f"The task gives {gives}.",)
    else:
        put_in = list(_sums_put_in(forms, step.equations, before))
        if put_in and not isinstance(step.equations[0].origin, Given):
            told = [node for earlier in before for node in _sums_put_in(forms, earlier.equations, before)]
            put_in = [node for node in put_in if node not in told]
        why = (
            *_origin(
                [e.origin for e in step.equations], put_in, turns=not isinstance(step, Length | RootLength)
            ),
            *say(_form(step), q=Symbol(step.coordinate)),
        )
    return Step(
        id=f"inverse_{step.coordinate}",
        title=f"Solving for {to_unicode(Symbol(step.coordinate))}",
        why=why,
        working=working,
        lines=lines,
        formula=_general(step),
        source=spong("3.3"),
        concluding=("So:",) if lines else (),
        result=results,
        figure=figure_of(forms.robot, formulas, step),
        notes=tuple(_notes(forms, step, part.turn, before)),
        normal=NOTED if starts_anew or not lines else RESUMED,
        uses=("inverse_task", *(f"inverse_{s.coordinate}" for s in before if s.coordinate in shown)),
    )


def _sums_put_in(
    forms: InverseForms, equations: Sequence[Equation], before: Sequence[Solved]
) -> Iterator[Node]:
    """The sums of angles that the task gives, put into the components from which equations are made."""
    assert forms.solved is not None
    r, known = forms.values[forms.task], {solved.coordinate for solved in before}
    used = [e.origin.index for e in lineage(equations) if isinstance(e.origin, Given)]
    for left in forms.solved.solving.solved:
        if isinstance(left, Remainder) and left.coordinate not in known:
            k = r.ring.names.index(left.coordinate)
            if any(not r.ring.diff(r.entries[index], k).is_zero for index in used):
                yield forms.inverse_formulas.sum_of(left)


def _origin(origins: Sequence[Origin], put_in: Sequence[Node], *, turns: bool) -> Prose:
    """How the equations of an angle, which `turns`, or of a length are made; `put_in` are known sums."""
    first = say("{sums} is put in. ", sums=listed(put_in)) if put_in else ()
    direct = [origin for origin in origins if isinstance(origin, Direct)]
    if 0 < len(direct) < len(origins):
        made = [origin for origin in origins if origin not in direct]
        return (*_origin(direct, put_in, turns=turns), *_origin(made, (), turns=turns))
    match origins[0]:
        case Squared():
            return (
                *first,
                "Turning a vector does not change its length: in the sum of the squares the other angles "
                f"drop out, and one joint gives it its length{' (Paden-Kahan subproblem 3)' * turns}. ",
            )
        case Turned(_, _, name):
            text = "Turned back by {q}, the components have that angle on the left side alone. "
            return (*first, *say(text, q=Symbol(name)))
        case Combined(_, _, name):
            return (
                *first,
                *say("{q} stands in two equations to the first power, and drops out. ", q=Symbol(name)),
            )
        case Given():
            text = "Component|Components {places} of the task"
        case OfPoint(_, joint):
            seen = f", seen from the frame before joint {joint}," if joint else ""
            text = f"Coordinate|Coordinates {{places}} of the point{seen}"
        case OfTurn():
            text = "Entry|Entries {places} of the rotation"
    places = []
    for origin in origins:
        match origin:
            case Given(index):
                places.append(str(index + 1))
            case OfPoint(index):
                places.append("xyz"[index])
            case OfTurn(row, column):
                places.append(f"({row + 1}, {column + 1})")
    places = [*dict.fromkeys(places)]
    has = agreeing(f"{text} has|have no other unknown", len(places))
    if put_in:
        return say(f"{has} where {{sums}} is put in. ", places=listed(places), sums=listed(put_in))
    return say(f"{has}. ", places=listed(places))


def _form(step: Solved) -> str:
    """What kind of equation it is."""
    match step:
        case TwoLines() if step.is_rotation:
            return (
                "Two equations in the sine and the cosine of {q} give the angle: one joint turns a vector to "
                "where it is to be (Paden-Kahan subproblem 1)."
            )
        case TwoLines():
            return "Two equations in the sine and the cosine of {q} give the angle."
        case OneLine() if step.value.is_zero:
            return "The ratio of sine and cosine gives {q} up to half a turn: two angles."
        case OneLine() if step.sine.is_zero:
            return "The cosine of {q} belongs to two angles, which differ by their sign."
        case OneLine() if step.cosine.is_zero:
            return "The sine of {q} belongs to two angles, whose sum is π."
        case OneLine():
            return "One equation in the cosine and the sine of {q} has two solutions."
        case Length() if len(step.equations) > 1:
            return "Both have {q} to the first power: added, each times the factor of {q}, they give it."
        case Length():
            return "The length {q} stands in it to the first power."
    return "The length {q} stands in it as a square: two lengths."


def _general(step: Solved) -> Node | None:
    """The form that an equation has, and its solution."""
    both = {**{name: Letter(name) for name in "ABXY"}, "psi": letters.PSI}
    match step:
        case TwoLines() if step.is_rotation and not (step.first[0].is_zero or step.first[1].is_zero):
            turned = formula(
                "{A} cos {psi} - {B} sin {psi} = {X}, {A} sin {psi} + {B} cos {psi} = {Y}", **both
            )
            return formula("{turned} ⇒ {psi} = atan2({Y}, {X}) - atan2({B}, {A})", turned=turned, **both)
        case OneLine() if step.value.is_zero:
            either = formula("atan2({A}, {B}), atan2(-{A}, -{B})", **both)
            return formula("{A} cos {psi} = {B} sin {psi} ⇒ {psi} = {either}", either=either, **both)
        case OneLine() if not (step.cosine.is_zero or step.sine.is_zero):
            either = formula("atan2({B}, {A}) ± atan2(sqrt({A}² + {B}² - {X}²), {X})", **both)
            return formula("{A} cos {psi} + {B} sin {psi} = {X} ⇒ {psi} = {either}", either=either, **both)
    return None


def _existence(formulas: InverseFormulas, step: Solved) -> Node | None:
    """The condition under which an unknown has its values; None where it always has."""
    match step:
        case OneLine(_, cosine, sine, value) if value.is_zero:
            return None
        case OneLine(_, cosine, sine, value) if cosine.is_zero or sine.is_zero:
            return formula("-1 ≤ {ratio} ≤ 1", ratio=formulas.ratio(value, cosine + sine))
        case OneLine():
            return formulas.boundary(step)
        case RootLength() if not step.always_exists:
            return formula("{radicand} ≥ 0", radicand=formulas.radicand(step))
    return None


def _notes(forms: InverseForms, step: Solved, turn: Turn | None, before: Sequence[Solved]) -> Iterator[Prose]:
    """When there is a solution, and when there are infinitely many."""
    if turn is not None and turn.is_wrist:
        yield from _wrist_notes(forms.inverse_formulas, turn, step)
        return
    formulas, q = forms.inverse_formulas, Symbol(step.coordinate)
    if needed := [*_needed(forms, step)]:
        yield say("This needs {needed}.", needed=listed(needed))
    if (there := _existence(formulas, step)) is not None:
        text = "This equation has solutions where {there}; on the boundary, with =, the two are one."
        yield say(text, there=there)
    if zeros := _where_free(forms, step, before):
        yield say("Where {zeros}, {q} is free: infinitely many solutions.", zeros=listed(zeros), q=q)


def _where_free(forms: InverseForms, step: Solved, before: Sequence[Solved]) -> list[Node]:
    """The equations that hold where an unknown is free; none where it never is."""
    factors: list[Expr] = []
    match step:
        case OneLine(_, cosine, sine, value) if value.is_zero:
            factors = [sine, cosine]
        case OneLine(_, cosine, sine, value) if not (cosine.is_zero or sine.is_zero):
            factors = [sine, cosine, value]
        case OneLine(_, cosine, sine, value) if _moves_nothing(forms, step, cosine + sine):
            factors = [cosine + sine, value]
        case Length(_, factor, value) if _moves_nothing(forms, step, factor):
            factors = [factor, value]
        case TwoLines(_, (cosine, sine, _), _) if step.is_rotation:
            factors = [factor for factor in (cosine, sine) if not factor.is_zero]
    divided = {factor for one in before for value in _divisors(one) for factor, _ in trig_factors(value)}
    left = [
        prod((f for f, _ in trig_factors(one) if f not in divided), start=one.ring.one) for one in factors
    ]
    if not factors or never_hold(left) or not _may_be_reached(forms, left):
        return []
    return [equation(forms.vanishing(factor), Number(0)) for factor in left]


def _is_free_somewhere(forms: InverseForms, solving: Solving) -> bool:
    """Whether there are tasks at which some coordinate is free."""
    before: list[Solved] = []
    for part in solving.parts:
        if part.turn is not None and part.turn.is_wrist:
            return True
        for step in part.solved:
            if _where_free(forms, step, before):
                return True
            before.append(step)
    return False


def _may_be_reached(forms: InverseForms, zeros: Sequence[Expr]) -> bool:
    """Whether a task at which these are 0 may be that of a configuration: x = y = 0 is not, if e > l."""
    assert forms.solved is not None
    solving = forms.solved.solving
    ring = solving.ring
    try:
        values = zip(
            solving.values, map(Transfer(solving.task.ring, ring), solving.task.entries), strict=True
        )
        images = {ring.symbol_indices[name, 0]: value.poly for name, value in values}
        special = Special(ParameterSigns())
        found = common_zeros([ring.put(one, images) for one in zeros], special)
    except (TooLong, AlgebraError):  # the ring has not every angle
        return True
    return not special.is_empty or any(existence(one) is not None for one in found)


def _moves_nothing(forms: InverseForms, step: Solved, divisor: Expr) -> bool:
    """Whether a coordinate does not move the task where what it is divided by is 0."""
    assert forms.solved is not None
    ring, components = divisor.ring, forms.solved.solving.components
    place = ring.names.index(step.coordinate)
    slopes = [ring.diff(one.right, place) for one in components]
    return not is_never_zero(divisor) and all(slope.quotient(divisor) is not None for slope in slopes)


def _needed(forms: InverseForms, step: Solved) -> Iterator[Node]:
    """That what is divided by is not 0, where it may be."""
    for divisor in _divisors(step):
        if not is_never_zero(divisor):
            yield formula("{divisor} ≠ 0", divisor=forms.vanishing(divisor))


def _divisors(step: Solved) -> Iterator[Expr]:
    """What a step divides by."""
    match step:
        case OneLine(_, cosine, sine, value) if not value.is_zero and (cosine.is_zero or sine.is_zero):
            yield cosine + sine
        case TwoLines() if not step.is_rotation:
            yield step.determinant
        case Length(_, divisor) | RootLength(_, divisor):
            yield divisor


# -- the way to an unknown: components turned, squared and added, then sorted ----------------------


def _new(equations: Sequence[Equation], known: Collection[Expr]) -> Iterator[Equation]:
    """Equations after those that they come from, as far as these are not known."""
    for e in equations:
        if e.expr not in known:
            match e.origin:
                case Turned(first, second) | Combined(first, second):
                    yield from _new((first, second), known)
                case Squared(parts):
                    yield from _new(parts, known)
        yield e


def _lines(formulas: InverseFormulas, step: Solved, made: Sequence[Equation]) -> Iterator[Line]:
    """How equations are made of others, and how the unknown is taken out."""
    form = formulas.form
    pairs: dict[tuple[Expr, Expr, str], dict[bool, Equation]] = {}
    for e in made:
        match e.origin:
            case Turned(first, second, name, is_second):
                pairs.setdefault((first.expr, second.expr, name), {})[is_second] = e
    for e in made:
        match e.origin:
            case Turned(first, second, name):
                both = sorted(pairs.pop((first.expr, second.expr, name), {}).items())
                if both:
                    shown = tuple(_equation(formulas, one) for _, one in both)
                    how = listed(
                        [_turned_by(formulas, (first, second), name, second_one) for second_one, _ in both]
                    )
                    yield Line(say("Turned back by {q} ({how}):", q=Symbol(name), how=how), shown)
            case Combined(first, second, name, factors):
                how = _combined_by(formulas, (first, second), factors)
                yield Line(say("{q} drops out ({how}):", q=Symbol(name), how=how), (_equation(formulas, e),))
            case Squared(parts):
                left = total([power(form(part.left), 2) for part in parts if not part.left.is_zero])
                right = total([power(form(part.right), 2) for part in parts])
                yield Line(("The squares of these equations, added:",), (equation(left, right),))
                yield Line(("Multiplied out, with sin² + cos² = 1:",), (_equation(formulas, e),))
    q = Symbol(step.coordinate)
    rows: list[tuple[Expr, Expr, Expr]] = []
    match step:
        case TwoLines(_, upper, lower):
            if max(map(len, (*upper[:2], *lower[:2]))) > 1:
                rows = [upper, lower]
        case OneLine(_, cosine, sine, value) if not value.is_zero:
            if cosine.is_zero or sine.is_zero:
                name, word = ("cos", "cosine") if sine.is_zero else ("sin", "sine")
                solved = equation(Function(name, q), formulas.ratio(value, cosine + sine))
                yield Line((f"Solved for the {word}:",), (solved,))
            else:
                rows = [(cosine, sine, value)]
        case OneLine(_, cosine, sine, value) if max(len(cosine), len(sine)) > 1:
            rows = [(cosine, sine, value)]

    def line(cosine: Expr, sine: Expr, value: Expr) -> Node:
        """A cos q + B sin q = X"""
        both = [(factor, name) for factor, name in ((cosine, "cos"), (sine, "sin")) if not factor.is_zero]
        terms = [times(1, [(form(factor), 1), (Function(name, q), 1)]) for factor, name in both]
        return equation(total(terms), form(value))

    if rows:
        by = say("Sorted by the cosine and the sine of {q}:", q=q)
        yield Line(by, tuple(line(*row) for row in rows))


def _turned_by(formulas: InverseFormulas, pair: Sequence[Equation], name: str, is_second: bool) -> Prose:
    """Two components turned back by an angle, as the sum that a hand writes."""
    one, other = (formulas.form(e.left) for e in (reversed(pair) if is_second else pair))
    return say(
        "$cos {q}$ times the equation of {one} {sign} $sin {q}$ times that of {other}",
        q=Symbol(name),
        one=one,
        sign="minus" if is_second else "plus",
        other=other,
    )


def _combined_by(formulas: InverseFormulas, pair: Sequence[Equation], factors: tuple[Expr, Expr]) -> Prose:
    """Two equations, each times a factor, as the sum that a hand writes."""
    sign, second = split_sign(formulas.form(factors[1]))
    one, other = (
        say(
            f"{{factor}}{which} of {{of}}",
            factor=say("{f} times ", f=f) if f != ONE else "",
            of=formulas.form(e.left),
        )
        for f, which, e in zip(
            (formulas.form(factors[0]), second), ("the equation", "that"), pair, strict=True
        )
    )
    return say("{one} {sign} {other}", one=one, sign="minus" if sign > 0 else "plus", other=other)


def _equation(formulas: InverseFormulas, e: Equation) -> Node:
    return equation(formulas.form(e.left), formulas.form(e.right))


# -- what the steps of a part start from: a rotation that is left, a point -------------------------


def _starting(forms: InverseFormulas, part: Part, number: int, before: Sequence[Solved]) -> Iterator[Step]:
    if part.turn is not None:
        yield _turn(forms, part.turn, number, before)
    if part.parallel:
        joints = and_joined([str(k) for k in part.parallel])
        yield Step(
            id=f"inverse_parallel_{number}",
            title="Parallel axes",
            why=(
                f"The axes of joints {joints} are parallel. In that direction these joints move nothing, and "
                "they turn nothing out of it: what is seen along it holds the others alone, and these come "
                "first.",
            ),
            source=craig("4.6"),
            uses=(),
        )
    if part.point is not None:
        title, why = _about(part.point)
        known = forms.matrix(part.point.known)
        meant = {d.name: forms.form(d.value) for d in part.point.definitions}
        defined = (equation(known, with_formulas(known, meant)),) if meant else ()
        yield Step(
            id=f"inverse_point_{number}",
            title=title,
            why=(why,),
            result=(*defined, equation(known, forms.matrix(part.point.made))),
            defines=defined,
            source=spong("3.3.2"),
            detail=Detail.NORMAL,
            uses=("inverse_task", *((f"inverse_turn_{number}",) if part.turn else ())),
        )


def _about(point: FixedPoint) -> tuple[str, str]:
    """What a point is called, and what it is good for."""
    count, joints = point.last - point.first + 1, _joints(point)
    seen = "fixed in the base, and the pose says where the hand sees it"
    if not point.from_hand:
        seen = "fixed in the hand, and the pose says where it is"
    alone = f"It is {seen}. Only the other joints move it"
    if count == 0:
        return "The origin of the last frame", "Every joint moves it."
    if count == 1:
        why = f"Joint {point.first} turns about its axis and does not move this point. {alone}."
        return f"A point on the axis of joint {point.first}", why
    why = f"The axes of joints {joints} meet in one point, which these joints do not move. {alone}"
    if count >= 3 and not point.from_hand:
        why += " to its place, and the wrist then turns the hand: position and rotation are decoupled."
    else:
        why += "."
    is_wrist = count == 3 and not point.from_hand
    return "The wrist centre" if is_wrist else f"The point where the axes of joints {joints} meet", why


def _joints(told: FixedPoint | Turn) -> str:
    return and_joined([str(k) for k in range(told.first, told.last + 1)])


_OF_A_WRIST = (
    " The last joint does not move its own axis: the first two turn that to where it is to be (Paden-Kahan "
    "subproblem 2), and the last turns the hand about it (subproblem 1)."
)


def _turn(formulas: InverseFormulas, turn: Turn, number: int, before: Sequence[Solved]) -> Step:
    """The rotation that is left for some joints."""
    is_one = turn.first == turn.last
    joints = f"joint {turn.first}" if is_one else f"joints {_joints(turn)}"
    known, made = (formulas.matrix(pose.block(0, 3, 0, 3)) for pose in (turn.known, turn.made))
    U = letters.bold(turn.definitions[0].name[0].upper() if turn.definitions else "U")
    rotation = formula("{U} = {known} = {made}", U=U, known=known, made=made)
    values = tuple(equation(Symbol(d.name), formulas.form(d.value)) for d in turn.definitions)
    return Step(
        id=f"inverse_turn_{number}",
        title="The rotation of the wrist" if turn.is_wrist else f"What is left for {joints}",
        why=say(
            "The other joints are known now. Taken off the given pose, they leave to {joints} the rotation "
            "{U}, which is also {product}.{subproblems}",
            joints=joints,
            U=U,
            product="the rotation of the joint itself"
            if is_one
            else "the product of the rotations of these joints",
            subproblems=_OF_A_WRIST if turn.is_wrist else "",
        ),
        working=(rotation,),
        source=spong("3.3.2"),
        concluding=("From the given pose and the joints that are known:",) if values else (),
        result=values or (rotation,),
        defines=values,
        listed=True,
        uses=("inverse_task", *(f"inverse_{step.coordinate}" for step in before)),
    )


def _wrist_notes(formulas: InverseFormulas, turn: Turn, step: Solved) -> Iterator[Prose]:
    """Where a spherical wrist is singular; said with its first angle that has two values."""
    if not isinstance(step, OneLine):
        return
    first, middle, last = map(Symbol, turn.names)
    where = formula("sin {middle} = 0", middle=middle)
    if len(turn.made[2, 2]) != 1:  # else it is ± the cosine of the angle between the outer axes
        where = Relation((formulas.form(turn.known[2, 2]), Number(1)), ("= ±",))
    text = (
        "Where {where} the first and the last axis of the wrist are one line: the wrist is singular. Only "
        "the sum of {first} and {last}, or their difference, is given then, and one of them is free: "
        "infinitely many solutions."
    )
    yield say(text, where=where, first=first, last=last)


# -- the branches ----------------------------------------------------------------------------------


def _branches(forms: InverseForms, solving: Solving) -> Step:
    """All of them, each put into r(q); a table where not every choice goes with every other."""
    names, count = [step.coordinate for step in solving.solved], len(forms.inverse)
    task = task_of(forms.robot)
    choices = _choices(forms, solving)
    is_free = forms.target is None and len(set(forms.when)) <= 1 and _is_every_choice(forms, choices)
    one, several = ("solution", "solutions") if forms.target is None else ("branch", "branches")  # of numbers
    tested = names_in(*(side for when in forms.when for one in when for side in one.sides))
    is_tested = not tested.isdisjoint(names)
    is_certain = not is_tested and _exist_together(forms.inverse_formulas, choices.values())
    number = f"there are {'' if is_certain else 'at most '}{count} {several}"
    number = number if count > 1 else f"there is one {one}"
    free = [Symbol(name) for name in solving.free]
    each_free = say(" for each value of {free}", free=listed(free)) if free else ()
    there = [_existence(forms.inverse_formulas, step) for step in choices.values() if forms.target is None]
    inside = [one for one in there if one is not None and is_certain]
    which = "which" if len(choices) == 1 else "some of which"
    where = say(
        " where {inside}, {which} coincide on the boundary, and none elsewhere{free}",
        inside=listed(inside),
        which=which,
        free=", and infinitely many where a coordinate is free"
        if inside and _is_free_somewhere(forms, solving)
        else "",
    )
    there_are = say(f"{number}{{each_free}}{{where}}", each_free=each_free, where=where if inside else ())
    notes = (*_conditions(forms, task), *_free_coordinates(solving))
    if is_free and choices:
        two = "{q} has two values: {there_are}."
        gives = f"every choice {'gives' if is_certain else 'that exists gives'} a solution"
        each = f"{{q}} have two values each{'' if is_tested else f', and {gives}'}: {{there_are}}."
        chosen = listed([Symbol(step.coordinate) for step in choices.values()])
        together = say(each if len(choices) > 1 else two, q=chosen, there_are=there_are)
    else:
        together = say(f"{opened(number)}{{each_free}}.", each_free=each_free)
    starts = tuple(f"inverse_{what}_{number}" for what, number in _defined(solving))
    table = None if is_free or not choices else _table(forms, choices)
    shown = [node for step in solving.solved for node in forms.inverse_formulas.solutions(step)]
    if table is not None:
        shown = [cell for row in table.rows for cell in row if isinstance(cell, Node)]
    same = f"A coordinate that stands in a formula is that of the same {'solution' if is_free else 'line'}."
    parts = [part for part in solving.parts if part.turn is None or not part.turn.is_wrist]
    needed = [node for part in parts for step in part.solved for node in _needed(forms, step)]
    said = ["{together}"] if is_free and choices else []
    said += [f"The {f'{several} need' if count > 1 else f'{one} needs'} {{needed}}."] if needed else []
    is_of_others = count > 1 and not names_in(*shown).isdisjoint(names)
    return Step(
        id=_id_of_branches(forms),
        title=f"The {one}" if count == 1 else f"The {count} {several}" if is_certain else f"The {several}",
        why=say(
            "{together} {each} is put into {task} to see that it gives what is asked. {same}",
            together=together,
            each="Each" if count > 1 else "It",
            task=task,
            same=same if is_of_others else "",
        ),
        table=table,
        notes=notes,
        outcome=paragraph((say(" ".join(said), together=together, needed=listed(needed)), *notes)),
        normal=NOTED,
        detail=Detail.BRIEF,
        uses=(*(f"inverse_{name}" for name in names), *starts),
        hint=say(
            "Put every choice among these into {task}: those that give what is asked are the solutions.",
            task=task,
        ),
        hint_title="The solutions",
    )


def _defined(solving: Solving) -> Iterator[tuple[str, int]]:
    """The steps that define names for what the unknowns are found from, by their kinds and numbers."""
    for number, part in enumerate(solving.parts, 1):
        if part.turn is not None and part.turn.definitions:
            yield "turn", number
        if part.point is not None and part.point.definitions:
            yield "point", number


def _choices(forms: InverseForms, solving: Solving) -> dict[int, Solved]:
    """The unknowns that have two values, by their places among all."""
    found = enumerate(solving.solved)
    return {k: step for k, step in found if len(forms.inverse_formulas.solutions(step)) > 1}


def _exist_together(formulas: InverseFormulas, choices: Collection[Solved]) -> bool:
    """Whether no choice decides whether another unknown has values at all."""
    conditions = [_existence(formulas, step) for step in choices]
    names = names_in(*(there for there in conditions if there is not None))
    return names.isdisjoint(step.coordinate for step in choices)


def _is_every_choice(forms: InverseForms, choices: Collection[int]) -> bool:
    """Whether every choice of a value goes with every other."""
    assert forms.solved is not None
    return len(forms.solved.branches) == prod(2 for _ in choices)


def _table(forms: InverseForms, choices: Mapping[int, Solved]) -> Table:
    """A branch a row: the values of the unknowns that have two, or which of them is meant."""
    assert forms.solved is not None
    rows = []
    for number, branch in enumerate(forms.solved.branches, 1):
        row: list[Node | str] = [str(number)]
        for k, step in choices.items():
            solutions, index = forms.inverse_formulas.solutions(step), branch.choice[k]
            signs = forms.inverse_formulas.has_signs(step)
            which = (("with +", "with -") if signs else ("the first", "the second"))[index]
            row.append(solutions[index] if cost(solutions[index]) <= SHORT else which)
        rows.append(tuple(row))
    return Table(("", *(Symbol(step.coordinate) for step in choices.values())), tuple(rows))


def _conditions(forms: InverseForms, task: Node) -> Iterator[Prose]:
    """Where the branches are solutions, those with the same conditions together."""
    lines: dict[Conditions, list[str]] = {}
    for number, when in enumerate(forms.when, 1):
        lines.setdefault(when, []).append(str(number))
    for when, numbers in lines.items():
        if when:
            which = "Line|Lines {numbers} holds|hold" if len(lines) > 1 else "This|They holds|hold"
            text = " where {conditions} alone: the joints give {task} no other values."
            conditions = listed([equation(*one.sides) for one in when])
            if len(when) == len(forms.robot.questions.reached):
                text = " only where {task} is then what is given: the joints give it no other values."
            which = agreeing(which, len(numbers))
            yield say(which + text, numbers=listed(numbers), conditions=conditions, task=task)


def _free_coordinates(solving: Solving) -> Iterator[Prose]:
    sums = [step for step in solving.solved if isinstance(step, Remainder)]
    bound = [name for name in solving.free if any(name in dict(step.others) for step in sums)]
    unused = [name for name in solving.free if name not in bound]
    if bound:
        yield say("{q} may be anything; the others follow.", q=listed([*map(Symbol, bound)]))
    if unused:
        text = agreeing("{q} does|do not change the task, and may be anything.", len(unused))
        yield say(text, q=listed([*map(Symbol, unused)]))


# -- hints -----------------------------------------------------------------------------------------

AT_HAND = "You have what is to be reached as a function of the joint variables:"

PITFALLS = """
    turning? A cosine or a sine alone leaves two angles, and each is a branch of its own.
    turning? atan2 takes y first, and knows all four quadrants; arctan(y/x) knows two.
    Put each solution into $𝐫(𝐪)$: what was squared on the way may have brought one too many.
"""


def inputs(context: Context) -> list[tuple[Node, str]]:
    """The results that it starts from, by letter and name."""
    robot = context.robot
    task, last = robot.questions.task, len(robot.joints)
    is_pose = task is not None and task.is_pose
    return [(letters.H(robot, last), f"H{last}") if is_pose else (letters.TASK, "r")]
