"""Steps of the inverse kinematics: what is asked, and one unknown after the other."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence
from math import inf

from msgspec.structs import replace

from dynsolve.algebra.matrix import Matrix as Values
from dynsolve.algebra.ring import Expr
from dynsolve.document import Prose
from dynsolve.document.books import craig, spong
from dynsolve.document.sentences import opened, say
from dynsolve.explain.context import Context
from dynsolve.explain.step import NOTED, RESUMED, Detail, Line, Step
from dynsolve.explain.step import Part as Shown
from dynsolve.explain.writing import agreeing, and_joined, listed, turns
from dynsolve.notation.build import power, split_sign, times, total
from dynsolve.notation.template import formula
from dynsolve.notation.tree import (
    ONE,
    Function,
    Letter,
    Matrix,
    Node,
    Number,
    Reference,
    Symbol,
    column,
    equation,
    names_in,
    with_formulas,
)
from dynsolve.notation.unicode import to_unicode
from dynsolve.quantities import letters
from dynsolve.questions.inverse.branches import Branches, id_of_branches
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
from dynsolve.questions.inverse.existence import Existence
from dynsolve.questions.inverse.figures import figure_of
from dynsolve.questions.inverse.forms import InverseForms, InverseFormulas
from dynsolve.questions.inverse.solving import FixedPoint, Part, Turn
from dynsolve.questions.inverse.subproblems import Length, OneLine, Remainder, RootLength, Solved, TwoLines
from dynsolve.questions.inverse.target import target_steps
from dynsolve.robot.model import Robot


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
            id=id_of_branches(forms),
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
        existence = Existence(forms, forms.solved.solving)
        yield from _unknowns(forms, existence)
        yield Branches(forms, existence).step()
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


# -- one unknown -----------------------------------------------------------------------------------


def _unknowns(forms: InverseForms, existence: Existence) -> Iterator[Step]:
    """The unknowns, one after the other."""
    before: tuple[Solved, ...] = ()
    general: list[Node | None] = []
    for number, part in enumerate(existence.solving.parts, 1):
        yield from _starting(forms.inverse_formulas, part, number, before)
        for solved in part.solved:
            notes = tuple(existence.notes(solved, part))
            found = _unknown(forms, solved, before, notes)
            told = found.formula in general
            yield replace(found, normal=found.normal & ~Shown.FORMULA) if told else found
            general.append(found.formula)
            before = (*before, solved)


def _unknown(forms: InverseForms, step: Solved, before: Sequence[Solved], notes: tuple[Prose, ...]) -> Step:
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
        notes=notes,
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
