"""Steps of the matrices that are to be judged: symmetric, of the coordinates as D is, positive definite."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from math import prod

from msgspec.structs import replace

from dynsolve.algebra.angles import angle_node
from dynsolve.algebra.inequality import Bound
from dynsolve.algebra.ring import Expr
from dynsolve.derivation.graph import Skipped
from dynsolve.document import Prose
from dynsolve.document.books import spong
from dynsolve.document.sentences import say
from dynsolve.explain.context import Context
from dynsolve.explain.forms import Forms
from dynsolve.explain.step import NOTED, Detail, Step
from dynsolve.explain.writing import listed
from dynsolve.notation.template import formula
from dynsolve.notation.tree import ZERO, Function, Letter, Node, Number, Relation, Symbol, equation
from dynsolve.quantities import letters
from dynsolve.questions.definite.derive import Alternatives, Answer, Definiteness, Refusal
from dynsolve.robot.questions import Candidate

_CONCLUSIONS = {
    Answer.YES: "it can be an inertia matrix.",
    Answer.IF: "it can be an inertia matrix under these conditions.",
    Answer.NO: "it can be no inertia matrix.",
}

_REFUSALS = {
    Refusal.ASYMMETRIC: "It is not symmetric: {entry} is not entry ({column}, {row}).",
    Refusal.NOT_PERIODIC: "{q} is an angle, and stands outside of sines and cosines in {entry}: after a full "
    "turn the matrix would not be the same.",
    Refusal.LENGTH_IN_SINE: "{q} is a length, and stands in a sine or cosine in {entry}.",
    Refusal.DEGREE: "{q} is a length, and stands in a higher power than the second in {entry}.",
    Refusal.BASE: "{q} is the coordinate of the base, and stands in {entry}.",
}


def steps(context: Context) -> Iterator[Step]:
    """A step for each matrix: its leading minors, and whether they are positive for every q."""
    if "definite" not in context.wanted:
        return
    candidates = context.robot.questions.candidates
    yield Step(
        id="definite",
        title="What an inertia matrix is",
        why=say(
            "An inertia matrix is symmetric. It is made of sines and cosines of angles, and at most "
            "quadratic in lengths.{chain} And it is positive definite in every configuration: its leading "
            "minors are positive.",
            chain=" The first of the relative coordinates of a chain does not occur."
            if any(candidate.is_relative for candidate in candidates)
            else "",
        ),
        formula=formula("Δ_k > 0"),
        source=spong("7.5"),
    )
    for candidate, found in zip(candidates, context.values["definite"], strict=True):
        yield _step(context, candidate, found)


def _step(context: Context, candidate: Candidate, found: Definiteness | Skipped) -> Step:
    name = Symbol(candidate.name) if context.robot.given is None else letters.D
    forms = context.forms.in_ring(candidate.matrix.ring)
    matrix = equation(name, forms.of(candidate.matrix))
    step = Step(
        id=f"definite_{candidate.name}",
        title=f"The matrix {candidate.name}",
        result=(matrix,),
        detail=Detail.BRIEF,
    )
    if isinstance(found, Skipped):
        why = (f"{found.why[0].upper()}{found.why[1:]}.",)
        return replace(step, why=why, outcome=(name, f": {found.why}."))
    assumed: Prose = ()
    if candidate.assumed and found.refusal in (None, Refusal.INDEFINITE):
        assumed = say("Let {these}. ", these=_all_of(forms, candidate.assumed))
    notes: tuple[Prose, ...] = ()
    if found.moves_with_base and found.answer is not Answer.NO:
        text = "It depends on the first coordinate, {q}; no inertia matrix of relative coordinates does."
        notes = (say(text, q=Symbol(context.robot.coordinates[0].name)),)
    minors = [formula("Δ_{k} = {value}", k=k, value=forms.of(m)) for k, m in enumerate(found.minors, 1)]
    conclusion = _CONCLUSIONS[found.answer]
    return replace(
        step,
        source=spong("7.5"),
        result=(matrix, *minors),
        why=(*assumed, *reason(forms, found), f" So {conclusion}"),
        notes=notes,
        outcome=_outcome(forms, name, found),
        normal=NOTED,
        hint=("Look at its entries first, then at its leading minors.",),
    )


def _outcome(forms: Forms, name: Node, found: Definiteness) -> Prose:
    """The verdict on a matrix, with its conditions."""
    if found.answer is not Answer.IF:
        return (name, f": {_CONCLUSIONS[found.answer]}")
    return say("{name}: it can be an inertia matrix {these}.", name=name, these=_if(forms, found))


def _if(forms: Forms, found: Definiteness) -> Prose:
    """Exactly if a > 0 and either b > 0 or c ≥ 0; or that no more is known than that it is enough."""
    these = listed([_either(forms, bounds) for bounds in found.conditions])
    if found.is_exact:
        return say("exactly if {these}", these=these)
    return say("if {these}; this is enough, but may be more than is needed", these=these)


def _either(forms: Forms, bounds: Alternatives) -> Prose:
    parts = listed([inequality(forms, bound) for bound in bounds], "or")
    return parts if len(bounds) == 1 else ("either ", *parts)


def reason(forms: Forms, found: Definiteness) -> Prose:
    """Why a matrix can be an inertia matrix, or cannot."""
    taken: Prose = ()
    if found.order != tuple(sorted(found.order)):
        order = ", ".join(str(k + 1) for k in found.order)
        taken = (f"Take the rows, and the columns, in the order {order}; any order will do. ",)
    if found.excluding:
        text = (
            "{taken}The leading minors are positive in every configuration only if {these}, which exclude "
            "each other."
        )
        return say(text, taken=taken, these=_all_of(forms, found.excluding))
    if found.refusal is Refusal.INDEFINITE:
        return (*taken, *_not_positive(forms, found))
    if found.refusal is not None:
        row, column = (k + 1 for k in found.place)
        q, entry = Symbol(found.coordinate), f"entry ({row}, {column})"
        return say(_REFUSALS[found.refusal], q=q, entry=entry, row=row, column=column)
    return say(
        "{taken}Every leading minor is positive in every configuration{conditions}.",
        taken=taken,
        conditions=(" ", *_if(forms, found)) if found.answer is Answer.IF else "",
    )


def _not_positive(forms: Forms, found: Definiteness) -> Prose:
    """Where which minor is not positive: where cos θ₂ = 0, d = 0; or where c₁ = 1, for some q₂, a + c q₂."""
    assert found.extreme is not None
    ring, placed = forms.robot.ring, found.extreme.where
    minor = Letter("Delta", Number(found.size))
    where: list[Node] = []
    for index, value in placed:
        g = ring.generators[index]
        sign: Node = Symbol(g.name)
        if g.kind in ("sin", "cos"):
            sign = Function(g.kind, angle_node(g.angle, ring.names))
        where.append(equation(sign, forms.of(ring.constant(value))))
    at = say("Where {where}, ", where=listed(where)) if where else ()
    somewhere = "" if where else " in every configuration"
    if not found.is_whole:
        minors = [Letter("Delta", Number(k)) for k in range(1, found.size + 1)]
        all_ = "both" if found.size == 2 else "all"
        return say(f"{{at}}{{minors}} are not {all_} positive{somewhere}.", at=at, minors=listed(minors))
    there = _at(found.minors[found.size - 1], placed)
    known = equation(minor, forms.of(there))
    if not where:
        one = known if there.is_number else minor
        return say(f"{{one}} is not positive{'' if there.is_number else somewhere}.", one=one)
    left = [Symbol(name) for k, name in enumerate(ring.names) if not there.ring.diff(there, k).is_zero]
    some = say(" for some {left}", left=listed(left)) if left else ()
    return say("{at}{minor}, which is not positive{some}.", at=at, minor=known, some=some)


def _at(minor: Expr, where: Iterable[tuple[int, int]]) -> Expr:
    """A minor where generators have values; beside a sine or cosine that is 1 or -1 the other is 0."""
    ring, images = minor.ring, {}
    for index, value in where:
        images[index] = ring.constant(value).poly
        for pair in ring.pairs:
            if index in (pair.sine, pair.cosine) and value:
                images[pair.sine + pair.cosine - index] = ring.zero.poly
    return ring.put(minor, images)


def _all_of(forms: Forms, bounds: tuple[Bound, ...]) -> Prose:
    return listed([inequality(forms, bound) for bound in bounds])


def inequality(forms: Forms, bound: Bound) -> Relation:
    """a₁a₃ - a₂² > 0; b = 0 for -b² ≥ 0, and b ≠ 0 for b² > 0."""
    content, factors = bound.value.poly.factor()
    if bound.is_strict == (content > 0) and all(int(times) % 2 == 0 for _, times in factors):
        one = prod((Expr(bound.value.ring, factor) for factor, _ in factors), start=bound.value.ring.one)
        return Relation((forms.of(one), ZERO), ("≠" if bound.is_strict else "=",))
    return Relation((forms.of(bound.value), ZERO), (">" if bound.is_strict else "≥",))


# -- hints -----------------------------------------------------------------------------------------

AT_HAND = "You have the matrices, and what is assumed of their parameters."

PITFALLS = """
    A positive determinant alone is not enough: every leading minor must be positive.
    Take each minor where it is smallest: its sines and cosines may be 0, 1 and -1 there.
"""
