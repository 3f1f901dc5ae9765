"""Steps of the matrices that are to be judged: symmetric, of the coordinates as D is, positive definite."""

from __future__ import annotations

from collections.abc import Iterator

from dynsolve.algebra.angles import angle_node
from dynsolve.algebra.inequality import Bound
from dynsolve.derivation.definite import Answer, Definiteness, Refusal
from dynsolve.derivation.graph import Skipped
from dynsolve.derivation.smallest import Extreme
from dynsolve.document import Prose
from dynsolve.explain.context import Context
from dynsolve.explain.forms import Forms
from dynsolve.explain.step import NOTED, Detail, Step
from dynsolve.explain.writing import listed, spong
from dynsolve.notation.tree import Function, Letter, Node, Number, Relation, Symbol, equation
from dynsolve.quantities import letters
from dynsolve.quantities.stages import Stage
from dynsolve.robot.candidates import Candidate

STAGE = Stage.DEFINITE


def steps(context: Context) -> Iterator[Step]:
    """A step for each matrix: its leading minors, and whether they are positive for every q."""
    if "definite" not in context.wanted:
        return
    yield _general(any(candidate.is_relative for candidate in context.robot.questions.candidates))
    for candidate, found in zip(context.robot.questions.candidates, context.values["definite"], strict=True):
        yield _step(context, candidate, found)


def _step(context: Context, candidate: Candidate, found: Definiteness | Skipped) -> Step:
    name = Symbol(candidate.name) if context.robot.given is None else letters.D
    if isinstance(found, Skipped):
        return Step(
            id=f"definite_{candidate.name}",
            stage=STAGE,
            title=f"The matrix {candidate.name}",
            why=(f"{found.why[0].upper()}{found.why[1:]}.",),
            result=(equation(name, context.show(candidate.matrix)),),
            outcome=(name, f": {found.why}."),
            detail=Detail.BRIEF,
        )
    minors = [
        equation(Letter("Delta", Number(size)), context.show(minor))
        for size, minor in enumerate(found.minors, 1)
    ]
    notes: tuple[Prose, ...] = ()
    if found.moves_with_base and found.answer is not Answer.NO:
        first = Symbol(context.robot.coordinates[0].name)
        notes = (
            ("It depends on ", first, ", which no inertia matrix of a chain with relative coordinates does."),
        )
    return Step(
        id=f"definite_{candidate.name}",
        stage=STAGE,
        title=f"The matrix {candidate.name}",
        source=spong("7.5"),
        result=(equation(name, context.show(candidate.matrix)), *minors),
        why=(
            *_assumed(context.forms, candidate, found),
            *reason(context.forms, found),
            f" {_CONCLUSIONS[found.answer]}",
        ),
        notes=notes,
        outcome=(name, f": {_CONCLUSIONS[found.answer].removeprefix('So ')}"),
        normal=NOTED,
        hint=("Look at its entries first, then at its leading minors.",),
        detail=Detail.BRIEF,
    )


_CONCLUSIONS = {
    Answer.YES: "So it can be an inertia matrix.",
    Answer.IF: "So it can be an inertia matrix under these conditions.",
    Answer.NO: "So it can be no inertia matrix.",
}


def _assumed(forms: Forms, candidate: Candidate, found: Definiteness) -> Prose:
    """Under which inequalities of the parameters the minors are judged."""
    if not candidate.assumed or found.refusal not in (None, Refusal.INDEFINITE):
        return ()
    return ("Let ", *listed([inequality(forms, bound) for bound in candidate.assumed]), ". ")


def _general(is_relative: bool) -> Step:
    """What an inertia matrix must be."""
    chain = " The first of the relative coordinates of a chain does not occur." if is_relative else ""
    minor = Letter("Delta", Symbol("k"))
    return Step(
        id="definite",
        stage=STAGE,
        title="What an inertia matrix is",
        why=(
            "An inertia matrix is symmetric. It is made of sines and cosines of angles, and at most "
            f"quadratic in lengths.{chain} And it is positive definite in every configuration: its "
            "leading minors are positive.",
        ),
        formula=Relation((minor, Number(0)), (">",)),
        source=spong("7.5"),
    )


def reason(forms: Forms, found: Definiteness) -> Prose:
    """Why a matrix can be an inertia matrix, or cannot."""
    if found.refusal is Refusal.INDEFINITE:
        return _not_positive(forms, found)
    if found.refusal is not None:
        return _refused(found)
    all_positive = "Every leading minor is positive in every configuration"
    if found.answer is Answer.IF:
        return (f"{all_positive} exactly if ", *listed([inequality(forms, b) for b in found.conditions]), ".")
    return (f"{all_positive}.",)


def _refused(found: Definiteness) -> Prose:
    i, j = found.place
    entry = f"entry ({i + 1}, {j + 1})"
    match found.refusal:
        case Refusal.ASYMMETRIC:
            return (f"It is not symmetric: {entry} is not entry ({j + 1}, {i + 1}).",)
        case Refusal.NOT_PERIODIC:
            why = " is an angle, and stands outside of sines and cosines in "
            return (
                Symbol(found.coordinate),
                f"{why}{entry}: after a full turn the matrix would not be the same.",
            )
        case Refusal.LENGTH_IN_SINE:
            return (Symbol(found.coordinate), f" is a length, and stands in a sine or cosine in {entry}.")
        case Refusal.DEGREE:
            why = " is a length, and stands in a higher power than the second in "
            return (Symbol(found.coordinate), f"{why}{entry}.")
    return (Symbol(found.coordinate), f" is the coordinate of the base, and stands in {entry}.")


def _not_positive(forms: Forms, found: Definiteness) -> Prose:
    """Where which minor is not positive."""
    minor = Letter("Delta", Number(found.size))
    extreme = found.extreme
    assert extreme is not None
    where = _where(forms, extreme)
    value = extreme.bound.value
    if not where and found.minors[found.size - 1].is_number:
        return (equation(minor, forms.of(value)), " is not positive.")
    if not where:
        return (minor, " is not positive in every configuration.")
    known = equation(minor, forms.of(value)) if extreme.bound.is_strict else minor
    return ("Where ", *listed(where), ", ", known, ", which is not positive.")


def _where(forms: Forms, extreme: Extreme) -> list[Node]:
    """cos θ₂ = 0, d = 0: the place of an extreme value."""
    ring = forms.robot.ring
    found: list[Node] = []
    for index, value in extreme.where:
        g = ring.generators[index]
        sign: Node = Symbol(g.name)
        if g.kind in ("sin", "cos"):
            sign = Function(g.kind, angle_node(g.angle, ring.names))
        found.append(equation(sign, forms.of(ring.constant(value))))
    return found


def inequality(forms: Forms, bound: Bound) -> Relation:
    """a₁a₃ - a₂² > 0"""
    return Relation((forms.of(bound.value), Number(0)), (">" if bound.is_strict else "≥",))
