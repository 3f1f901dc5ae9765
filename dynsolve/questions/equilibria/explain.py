"""Steps of equilibria: where nothing moves, and what balances gravity; `near` goes on from there."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from fractions import Fraction
from math import isclose

from msgspec.structs import replace

from dynsolve.algebra.angles import Angle, angle_node
from dynsolve.algebra.inequality import Bound
from dynsolve.algebra.linear_systems import quotient
from dynsolve.algebra.matrix import Matrix, determinant, vstack
from dynsolve.algebra.ring import Expr
from dynsolve.algebra.sampling import Transfer
from dynsolve.derivation.existence import coordinates_in, quadratic_of, zeros_at_quarters
from dynsolve.derivation.graph import Skipped
from dynsolve.derivation.singular.zeros import Condition
from dynsolve.document import Prose
from dynsolve.document.books import SLOTINE_LI, spong
from dynsolve.document.sentences import Value, paragraph, say
from dynsolve.explain.context import Context
from dynsolve.explain.forms import Forms
from dynsolve.explain.given import in_units
from dynsolve.explain.step import NOTED, Detail, Group, Line, Step, not_derived
from dynsolve.explain.writing import agreeing, and_joined, as_row, is_small, listed, scalar, side_by_side
from dynsolve.notation.template import formula
from dynsolve.notation.tree import (
    ONE,
    Node,
    Number,
    Relation,
    Symbol,
    equation,
    names_in,
)
from dynsolve.notation.tree import Matrix as MatrixTree
from dynsolve.quantities import letters
from dynsolve.questions.equilibria.balance import exclude_each_other, is_impossible, negative_in
from dynsolve.questions.equilibria.forms import EquilibriaForms
from dynsolve.questions.equilibria.near import (
    DG,
    SOURCE,
    ZERO,
    forces_in_balance,
    forces_of,
    held_by_friction,
    input_matrix,
    is_steady,
    linear_divisor,
    stability,
    state_matrix,
)
from dynsolve.questions.equilibria.numeric import all_zeros
from dynsolve.questions.equilibria.solving import (
    Equilibria,
    SpecialCase,
    held_elsewhere,
    multipliers,
    wanted_rows,
)
from dynsolve.questions.set_forms import SetForms, vanishing
from dynsolve.robot.model import JointType, Robot


def given(forms: Forms) -> Iterator[Prose]:
    """Where to linearize, which motion goes on, what motors hold."""
    robot, model = forms.robot, forms.robot.questions.model
    if not robot.questions.asked.isdisjoint(("linear_A", "linear_B")):
        yield ("To be linearized at ", in_units(robot, model.linearize), ".")
    if model.steady:
        yield ("The motion keeps ", in_units(robot, [(name, 1, value) for name, value in model.steady]), ".")
    if model.inputs_given:
        yield ("In equilibria motors hold the coordinates that they drive, by forces that stay as they are.",)


LETTERS = """
* {LINEAR_A}: matrix of the state; {LINEAR_B}: matrix of the inputs | of the motion near the equilibrium
* 𝐪_('e') | the equilibrium
* {STEADY_ENERGY} | potential energy less the kinetic energy of a steady motion | J
* {F_RATES} | factors of the rates in the friction
* 𝐒 | selects the inputs
"""
"""The lines of its letters in the list of notation."""


def steps(context: Context) -> Iterator[Step]:
    """The equilibria with their stability; A and B of the motion near one."""
    wanted = context.wanted
    if "equilibria" in wanted:
        else_ = " else" if context.robot.questions.model.steady else ""
        found = list(_equilibria(context))
        is_told = any(step.id == "equilibria_stability" and step.source for step in found)
        title = f"Where nothing{else_} moves" + ", and how stable that is" * is_told
        yield from (replace(step, group=Group("equilibria", title), normal=NOTED) for step in found)
    if "balance" in wanted:
        yield replace(_balance(context), normal=NOTED)
    if "linear_A" in wanted:
        shared = linear_divisor(context)
        yield replace(state_matrix(context, shared), normal=NOTED)
        if "linear_B" in wanted:
            yield input_matrix(context, shared)


# -- where nothing moves ---------------------------------------------------------------------------

_AT_REST = (
    "In an equilibrium rates and accelerations are 0{idle}: of the equations of motion {left} is left. "
    "{loads}"
)
MOSTZEROS = 8
"""More zeros of an equation in numbers are not told."""

_COULOMB = "Coulomb friction is left out: wherever it holds, there is rest, too."
_NEVER_HELD = "Where all of them are 0, the rows of $𝐀_c$ are dependent and there is no $𝛌$."
_NO_MULTIPLIERS = "there is no $𝛌$, and no equilibrium"
_MAY_BE_DEPENDENT = "the rows of $𝐀_c$ may be dependent; there need then be no $𝛌$, and no equilibrium."
_GIVEN = "Let all parameters be positive{these}. "


def _equilibria(context: Context) -> Iterator[Step]:
    robot, found = context.robot, context.values["equilibria"]
    if isinstance(found, Skipped):
        yield not_derived("equilibria", "Where nothing moves", found.why)
        return
    shown = EquilibriaForms(robot, context.values)
    cases, model = shown.equilibria, robot.questions.model
    steady = is_steady(robot)
    told = [shown.relations(*both) for both in zip(found.alternatives, cases, strict=True)]
    result: tuple[Node, ...] = tuple(as_row(listed(one)) for one in told if one)
    constrained, working, leaves_free = (
        _with_constraints(context) if robot.questions.constraints else ((), (), False)
    )
    where = _where(shown, found)
    combined = _combined(context, shown, found)
    lines = (Line(_combined_by(found, where, bool(constrained)), combined),) if combined else ()
    notes = [*_of_cases(shown, found, where), *_besides(context, shown, found)]
    left = forces = forces_of(robot)
    if constrained:
        left = formula("{forces} = 𝐀_cᵀ 𝛌", forces=forces)
    balance = (
        "Motors hold the others by forces that stay as they are; what has none must be in balance: "
        "{passive}. "
    )
    assumed = [*map(shown.inequality, model.assumed)]
    passive = listed([Symbol(robot.coordinates[k].name) for k in robot.actions.passive])
    yield Step(
        id="equilibria",
        title="Where nothing else moves" if steady else "Where nothing moves",
        why=say(
            "{which}{held}{constrained}{given}",
            which=_in_steady_motion(context, left) if steady else _at_rest(robot, left),
            held=say(balance, passive=passive) if model.inputs_given else "",
            constrained=constrained,
            given=say(_GIVEN, these=say(", and {these}", these=side_by_side(assumed)) if assumed else "")
            if robot.parameters
            else "",
        ),
        formula=left if constrained else _balance_of(robot, forces, _shown_forces(context)),
        task=left if constrained else equation(forces, ZERO),
        source=SOURCE if steady else SLOTINE_LI.section("3.1"),
        working=working,
        lines=lines,
        concluding=_lead(len(result), len(combined), found.is_whole)
        if len(result) > 1 or (result and combined)
        else (),
        result=result,
        listed=len(result) > 1,
        notes=(*_of_free(shown, found, where), *notes),
        outcome=paragraph(notes),
        uses=None if steady or found.singular else ("g", "Ac", "hc") if constrained else ("g",),
        detail=Detail.BRIEF,
    )
    if (leaves_free and cases) if constrained else any(found.points):
        yield stability(context, shown, found)


def _shown_forces(context: Context) -> Node:
    """These forces as they are printed."""
    return context.show(forces_in_balance(context)) if is_steady(context.robot) else context.form("g")


def _where(shown: EquilibriaForms, found: Equilibria) -> Prose:
    """For which parameters all is so that is said of general ones."""
    special = [shown.comparison(one.factor, "≠") for one in found.special if not one.is_of_rank]
    return say(" where {special}", special=listed(special)) if special else ()


def _is_never(found: Equilibria) -> bool:
    """Whether a combination is a number: it stands for the others, whatever they are."""
    return any(row.is_number for row in found.rows)


def _combined(context: Context, shown: EquilibriaForms, found: Equilibria) -> tuple[Node, ...]:
    """The combinations of forces that must be 0, unless they are forces themselves, or what the cases say."""
    robot = context.robot
    said = {equation(value, Number(0)) for one in shown.equilibria for value in one}
    own: set[Expr] = set()
    if not robot.questions.constraints:
        own = {sign * force for force in forces_in_balance(context).entries for sign in (1, -1)}
    rings = {robot.ring: None} | {one.expr.ring: None for case in found.alternatives for one in case}
    places = [Transfer(robot.ring, ring) for ring in rings]
    both = (
        [
            equation(shown.condition(Condition(sign * put(row))), Number(0))
            for put in places
            for sign in (1, -1)
        ]
        for row in found.rows
    )
    rows = tuple(next((one for one in ways if one in said), ways[0]) for ways in both)
    is_new = not said.issuperset(rows) and not own.issuperset(found.rows)
    return rows if is_new and not found.is_convex and not _is_never(found) else ()


def _combined_by(found: Equilibria, where: Prose, constrained: bool) -> Prose:
    """What leads to combinations, and what was multiplied by or divided out for them."""
    return say(
        "{what}, without factors {which}:",
        what="Combined with the constraints" if constrained else "Combined",
        which="of the parameters"
        if found.may_be_others
        else say("that are not 0{where}" if where else "that are never 0", where=where),
    )


def _of_free(shown: EquilibriaForms, found: Equilibria, where: Prose) -> Iterator[Prose]:
    """What is said beside the cases alone: what may have any value, and what leads to none."""
    cases = shown.equilibria
    if not cases:
        if not _is_never(found) and not found.singular:
            never = "No configuration makes all of them 0{where}." if found.is_whole else _NEVER_HELD
            yield say(never, where=where)
    elif not cases[0]:
        yield say("Nothing is left to be 0{where}.", where=where)
    else:
        yield from _never(shown, found)
        yield from _arbitrary(shown.robot, cases)


def _of_cases(shown: EquilibriaForms, found: Equilibria, where: Prose) -> Iterator[Prose]:
    """Whether there are equilibria, and for which parameters."""
    cases = shown.equilibria
    if not cases:
        but = " with $det 𝐃 ≠ 0$" * bool(found.singular)
        yield say(f"There is no equilibrium{but}{{where}}.", where=where)
    elif not cases[0]:
        yield say("Every configuration is an equilibrium{where}.", where=where)
    else:
        for value, zero, bounds in found.only:
            yield _only(shown, value, zero, bounds)
        if found.is_convex:
            yield (
                "In every configuration each entry on the diagonal of ",
                DG,
                " is more than the sizes of the others in its row together: the potential energy is convex, "
                "and has no other equilibrium.",
            )
        for value in dict.fromkeys(one.expr for case in found.alternatives for one in case):
            yield from _in_numbers(shown, value)
        if found.has_least:
            yield (
                "The potential energy grows beyond all bounds in every direction in which it is not "
                "periodic, so that it is least somewhere: this always has solutions.",
            )
        yield from shown.existence("equilibria", found.exist, found.is_seen)
        yield from _unseen(found)
        if where:
            yield say("These are the equilibria{where}.", where=where)


def _only(shown: EquilibriaForms, value: Expr, zero: Expr, bounds: Sequence[Bound]) -> Prose:
    """k φ - m g l sin φ is 0 at φ = 0 alone, as it grows with φ everywhere: where k ≥ m g l."""
    (name,) = coordinates_in(zero)
    (at,) = shown.relations((Condition(zero),), (Symbol(name),))
    growing = shown.compactor(value.ring).form(value)
    where = say("Where {bounds}, ", bounds=side_by_side([*map(shown.inequality, bounds)])) if bounds else ""
    text = "{where}{growing} grows with {name} everywhere: it is 0 at {at} alone."
    return say(text, where=where, growing=growing, name=Symbol(name), at=at)


def _in_numbers(shown: EquilibriaForms, value: Expr) -> Iterator[Prose]:
    """2 sin(q) - q is 0 at q = 0, q ≈ 108.6° and q ≈ -108.6° alone."""
    if (found := all_zeros(value)) is None or len(found[1]) > MOSTZEROS:
        return
    name, zeros = found
    exact = {float(pose.get(name, 0)) for pose in zeros_at_quarters([value])}
    at: list[Node] = []
    for size in sorted(zeros, key=lambda size: (round(abs(size), 6), size < 0)):
        is_exact = any(isclose(size, other, abs_tol=1e-9) for other in exact)
        shown_size = Fraction(round(size)) if is_exact else Fraction(f"{size:.1f}")
        at.append(Relation((Symbol(name), angle_node(Angle((), shown_size))), ("=" if is_exact else "≈",)))
    yield say("{zero} is 0 at {at} alone.", zero=shown.vanishing(value), at=listed(at))


def _besides(context: Context, shown: EquilibriaForms, found: Equilibria) -> Iterator[Prose]:
    """What is said of configurations and parameters that the cases leave out."""
    yield from _singular(shown, found)
    for one in found.special:
        yield from _special(shown, one)
    if found.may_be_others:
        yield ("For special values of the parameters there may be others.",)
    yield from _without_multipliers(shown, found)
    if (slid := held_by_friction(shown.robot)) and (rest := _rest(context, shown, slid)):
        yield rest


def _rest(context: Context, shown: EquilibriaForms, slid: Mapping[int, Expr]) -> Prose:
    """Where Coulomb friction holds: -μ ≤ m g l sin(q) ≤ μ; nothing where it holds against nothing."""
    robot, form = shown.robot, shown.compactor(shown.robot.ring).form
    if robot.questions.constraints:
        return (_COULOMB,)
    forces = forces_in_balance(context)
    balanced = {k: forces[k, 0] for k in wanted_rows(robot) if not forces[k, 0].is_zero}
    rest = [
        Relation((form(-slid[k]), form(force), form(slid[k])), ("≤", "≤"))
        if k in slid
        else equation(form(force) if (what := shown.vanishing(force)) == ONE else what, Number(0))
        for k, force in balanced.items()
    ]
    if not balanced.keys() & slid.keys():
        return ()
    if not is_small(*rest):
        return (_COULOMB,)
    return say("With Coulomb friction the equilibria are where {rest}.", rest=as_row(listed(rest)))


def _without_multipliers(shown: EquilibriaForms, found: Equilibria) -> Iterator[Prose]:
    """Where in the alternatives the rows of A_c are dependent, and do not hold the forces."""
    general = ", but for special values of the parameters" * found.may_be_others
    known = [shown.comparison(one.factor, "≠") for one in found.special if not one.is_known]
    for number, sets in enumerate(shown.excluded):
        place = f" in case {number + 1}" if len(shown.excluded) > 1 else ""
        for one, conditions in zip(sets, found.excluded[number], strict=True):
            zero = listed([*known, *shown.relations(conditions, one)])
            others = [str(k + 1) for k in held_elsewhere(found, number, conditions)]
            but = f" but in case{'s' * (len(others) > 1)} {and_joined(others)}" if others else ""
            yield say(f"Where{place} {{where}}, {_NO_MULTIPLIERS}{but}{general}.", where=as_row(zero))
    if found.may_be_dependent:
        yield say("Where the rows of $𝐀_c$ are dependent there need be no $𝛌$, and no equilibrium.")


def _singular(shown: EquilibriaForms, found: Equilibria) -> Iterator[Prose]:
    """Where coordinates move no body, so that no force has to be 0 for the bodies to stay."""
    robot, rows = shown.robot, wanted_rows(shown.robot)
    balance: Prose = (as_row(listed([equation(_force(robot, k), Number(0)) for k in rows])),)
    if robot.questions.constraints:
        balance = say("there may be a $𝛌$")
    elif len(rows) == robot.n:
        balance = (equation(letters.G, ZERO),)
    for case, idle in found.singular:
        zero = listed(shown.relations(case, tuple(map(shown.condition, case))))
        names = listed([Symbol(shown.robot.coordinates[k].name) for k in idle])
        zeros = listed([equation(letters.entry("d", k + 1, k + 1), Number(0)) for k in idle])
        more = " The same is so for special parameters." * bool(found.special)
        yield say(
            "Where {zero}, {balance}, too; but {names} {move} no body there, {zeros}, and the coordinates do "
            "not tell how the bodies move: it need not be an equilibrium.{more}",
            zero=zero,
            balance=balance,
            names=names,
            move=agreeing("moves|move", len(idle)),
            zeros=zeros,
            more=more,
        )


def _unseen(found: Equilibria) -> Iterator[Prose]:
    """Of which cases it is not known for which parameters they are there."""
    seen = zip(found.is_seen, found.exist, strict=False)
    places = [str(k) for k, (is_seen, exist) in enumerate(seen, 1) if not (is_seen or exist)]
    if places:
        cases = f"case{'s' * (len(places) > 1)} {and_joined(places)}"
        there = f"{cases} {'have' if len(places) > 1 else 'has'}" if len(found.is_seen) > 1 else "this has"
        yield (f"For which parameters {there} solutions is not told here.",)


def _never(shown: EquilibriaForms, found: Equilibria) -> Iterator[Prose]:
    """Why choices of factors are no case, where that is seen from more than a number."""
    for held, value in found.never:
        if held and not value.is_number:
            where, what = vanishing(tuple(map(shown.condition, held))), shown.vanishing(value)
            what = shown.condition(Condition(value)) if what == ONE else what
            yield say("Where {where}, {what} is not 0.", where=where, what=what)
        elif quadratic_of(value):
            yield say("{what} is not 0: its discriminant is negative.", what=shown.vanishing(value))


def _arbitrary(robot: Robot, cases: Sequence[tuple[Node, ...]]) -> Iterator[Prose]:
    """The coordinates that a case leaves free, told once where they are the same in all."""
    names = [q.name for q in robot.coordinates if q.name not in dict(robot.questions.model.steady)]
    free = [tuple(name for name in names if name not in names_in(*one)) for one in cases]
    places = (
        [("", free[0])] if len(set(free)) == 1 else [(f"In case {k}, ", one) for k, one in enumerate(free, 1)]
    )
    for place, found in places:
        if found:
            verb = "are" if len(found) > 1 else "is"
            yield say(f"{place}{{free}} {verb} arbitrary.", free=listed([*map(Symbol, found)]))


def _lead(cases: int, combinations: int, is_whole: bool) -> Prose:
    """What leads from forces, or from combinations of them, to where they are 0, or if not whole are held."""
    what = "All are 0" if combinations > 1 else "It is 0"
    what = what if is_whole else f"{what} and there is a $𝛌$"
    return say(f"{what} in these cases:" if cases > 1 else f"{what} where:")


def _at_rest(robot: Robot, left: Node) -> Prose:
    """What is left of the equations of motion where motors, if they hold nothing, and forces are idle."""
    return say(
        _AT_REST,
        idle="" if robot.questions.model.inputs_given else ", and no motor drives",
        left=left,
        loads="The forces from outside do not act. " * bool(robot.questions.loads),
    )


def _in_steady_motion(context: Context, left: Node) -> Prose:
    """Which rates are held, by what, and what is `left` of the equations of the others."""
    robot = context.robot
    rates = robot.questions.model.steady
    passive = {robot.coordinates[k].name for k in robot.actions.passive}
    free = listed([Symbol(name) for name, _ in rates if name in passive], "or")
    driven = listed([Symbol(name) for name, _ in rates if name not in passive])
    return say(
        "In this motion {held} all the time; the other rates and all accelerations are 0. {driven}{free}Of "
        "the equations of the others {left} is left. ",
        held=side_by_side([equation(Symbol(name, 1), value) for name, value in rates]),
        driven=say("Motors keep the rate of {names}, whatever that takes. ", names=driven) if driven else "",
        free=say("No motor drives {names}. ", names=free) if free else "",
        left=left,
    )


def _with_constraints(context: Context) -> tuple[Prose, tuple[Node, ...], bool]:
    """For which forces there are multipliers, the rows that are dependent there, and if anything is free."""
    robot = context.robot
    columns, letter = wanted_rows(robot), formula("{forces}ᵀ", forces=forces_of(robot))
    held = multipliers(robot, forces_in_balance(context), context.values["Ac"], context.values["hc"])
    order = held.rank + 1
    if order > len(columns):
        return ("The constraints leave nothing free: what they allow is an equilibrium. ",), (), False
    A, g = context.form("Ac"), _shown_forces(context)
    assert isinstance(A, MatrixTree) and isinstance(g, MatrixTree)
    forces = tuple(g.rows[k][0] for k in columns)
    together = MatrixTree((*(tuple(row[k] for k in columns) for row in A.rows), forces))
    others = listed([Symbol(q.name) for k, q in enumerate(robot.coordinates) if k not in columns])
    many = "s" * (robot.n - len(columns) > 1)
    free = say(f" without the column{many} of {{others}}", others=others) if others else ()
    dependent = formula("[𝐀_c; {letter}]", letter=letter)
    is_square = len(together.rows) == len(columns) == order
    there = say(f"Where the constraints hold the rank of $𝐀_c${{free}} is {held.rank}. ", free=free)
    zero = "their determinant is" if is_square else f"all their minors of order {order} are"
    shown: list[Node] = [equation(dependent, together)] if is_small(together) else []
    if is_square:
        product = SetForms(robot, context.values).product(determinant(vstack(held.A, held.g)))
        size = formula("det {rows} = {product}", rows=dependent, product=product)
        shown += [size] if is_small(product) else []
    return (
        say(
            f"{{there}}There is a $𝛌$ where {{g}} is a combination of the rows of $𝐀_c${{free}}: {zero} 0. ",
            there=there if held.allowed.is_less else (),
            g=letter,
            free=free,
        ),
        tuple(shown),
        True,
    )


def _balance_of(robot: Robot, forces: Node, values: Node) -> Node:
    """g = 0, or the rows of it that must be 0 where motors hold the others."""
    rows = wanted_rows(robot)
    if len(rows) == robot.n or not isinstance(values, MatrixTree):
        return equation(forces, *([values] if is_small(values) else []), ZERO)
    return side_by_side([equation(_force(robot, k), values.rows[k][0], Number(0)) for k in rows])


def _force(robot: Robot, k: int) -> Node:
    """g₁, or τ₁ in a motion that goes on, of a coordinate from 0."""
    return letters.force(robot.coordinates[k]) if is_steady(robot) else letters.entry("g", k + 1)


def _special(shown: EquilibriaForms, case: SpecialCase) -> Iterator[Prose]:
    """What is an equilibrium for parameters of which a factor is 0."""
    where = shown.comparison(case.factor, "=")
    if not case.is_of_rank:
        yield _of_special_forces(shown, case, where)
    elif not case.excluded:
        yield say(f"Where {{where}}, {_MAY_BE_DEPENDENT}", where=where)
    for one in shown.special_exceptions(case):
        zero = [equation(value, Number(0)) for value in one]
        yield say(f"Where {{where}}, {_NO_MULTIPLIERS}.", where=as_row(listed([where, *zero])))


def _of_special_forces(shown: EquilibriaForms, case: SpecialCase, where: Node) -> Prose:
    if case.cases is None:
        return say("Where {where}, there may be others.", where=where)
    if not case.cases:
        return say("Where {where}, there is no equilibrium.", where=where)
    sets = zip(case.cases, shown.special_cases(case), strict=True)
    told = [as_row(listed(shown.for_special.relations(*one))) for one in sets]
    needs = shown.special_needs(case)
    only = say(" if {needs}, and none is if not", needs=as_row(listed(needs))) if needs else ""
    if () in case.cases:
        return say("Where {where}, every configuration is an equilibrium{only}.", where=where, only=only)
    exist = side_by_side([*map(shown.inequality, case.exist)]) if case.exist else None
    zero = tuple(part for k, one in enumerate(told) for part in ([", or where "] * (k > 0) + [one]))
    text = "Where {where}, the equilibria are where {zero}{exist}{only}."
    there = say(", which has solutions where {exist}", exist=exist) if exist else ""
    only = say(" if {needs}, and there is none if not", needs=as_row(listed(needs))) if needs else ""
    return say(text, where=where, zero=zero, exist=there, only=only)


# -- nowhere to move -------------------------------------------------------------------------------

_UNBALANCED = "{never} cannot hold, as masses and lengths of the table are positive: no parameters will do."
_A_NUMBER = "A coefficient is a number other than 0: no parameters will do."
_EXCLUDING = "They exclude each other, as no mass and no length of the table is 0: no parameters will do."


def _balance(context: Context) -> Step:
    found, wanted = context.values["balance"], context.robot.questions.model.balanced
    if isinstance(found, Skipped):
        return not_derived("balance", "What balances gravity", found.why)
    shown = EquilibriaForms(context.robot, context.values).balance
    goal: Node = ZERO if wanted is None else context.show(wanted)
    g = equation(letters.G, context.form("g"))
    pairs = [(equation(form, Number(0)), value) for form, value in zip(shown, found, strict=True)]
    conditions = tuple(one for one, value in pairs if not value.is_number)
    never = [one for one, value in pairs if not value.is_number and is_impossible(context.robot, value)]
    outcome: Prose = ()
    if len(conditions) < len(found):
        outcome = (_A_NUMBER,)
    elif never:
        outcome = say(_UNBALANCED, never=listed(never))
    elif exclude_each_other(context.robot, found):
        outcome = (_EXCLUDING,)
    elif negative := [*_negative(context, found)]:
        outcome = say(
            "As masses and lengths of the table are positive, {negative}.", negative=listed(negative)
        )
    notes = () if shown else (("Gravity is what it should be for all values of the parameters.",),)
    return Step(
        id="balance",
        title="What balances gravity",
        why=say(
            "Multiplied out, $𝐠$ is a sum of what moves, each with a coefficient of parameters. It is what "
            "it should be in every configuration where all the coefficients are. Those that are combinations "
            "of others are left out, and so are factors that are positive, as masses and lengths of the "
            "table are."
        ),
        formula=equation(letters.G, goal),
        source=spong("7.5.3"),
        working=(g,) if is_small(context.form("g")) else (),
        result=conditions,
        listed=len(conditions) > 1,
        notes=(outcome,) if outcome else notes,
        outcome=outcome,
        detail=Detail.BRIEF,
    )


def _negative(context: Context, conditions: Sequence[Expr]) -> Iterator[Node]:
    """d₁ = -m₂ l₁/m₁ < 0"""
    for condition in conditions:
        if (solved := negative_in(context.robot, condition)) is not None:
            name, factor, rest = solved
            value = context.forms.of(quotient(Matrix.column(condition.ring, [-rest]), factor))
            yield Relation((Symbol(name), scalar(value), Number(0)), ("=", "<"))


# -- hints -----------------------------------------------------------------------------------------

AT_HAND = "Of the equations of motion you have:"

PITFALLS = """
    equilibria? A product is 0 where any of its factors is: every choice is a case of its own.
    turning_equilibria? A sine or a cosine has each of its values at two angles of a turn, but 1 and -1.
    steady? The rates that are constant stay in the equations of the others.
    linear? Differentiate first, then put the equilibrium in.
    linear? The inverse of $𝐃$ stands before the derivatives of $𝐠$, with a minus sign.
    linear_passive? What no motor drives has no column in B, but its row stays.
"""


def inputs(context: Context) -> list[tuple[Node, str]]:
    """The results that it starts from, by letter and name."""
    is_moving = bool(context.robot.questions.model.steady)
    is_linear = not context.wanted.isdisjoint(("linear_A", "linear_B"))
    D, C, g = (letters.D, "D"), (letters.C, "C"), (letters.G, "g")
    return [*([D] if is_linear or is_moving else []), *([C] if is_moving else []), g]


def facts(robot: Robot) -> dict[str, Value]:
    """What its pitfalls are about."""
    asked, has_equilibria = robot.questions.asked, "equilibria" in robot.questions.asked
    is_linear = not asked.isdisjoint(("linear_A", "linear_B"))
    return {
        "equilibria": has_equilibria,
        "turning_equilibria": has_equilibria and any(q.type is JointType.REVOLUTE for q in robot.coordinates),
        "steady": has_equilibria and bool(robot.questions.model.steady),
        "linear": is_linear,
        "linear_passive": is_linear and bool(robot.actions.passive),
    }
