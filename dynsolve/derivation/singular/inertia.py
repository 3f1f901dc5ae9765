"""Where D has no inverse: where some rates move nothing that has an inertia.

q̇ᵀ D q̇ = 2 K is a sum of squares of velocities, with masses and moments of inertia in front, and 0 where
all of them are.  So D has no inverse exactly where the matrix that makes them of the rates loses rank.

Of given energies D is taken as it is.  Where its determinant is 0 nowhere, no eigenvalue changes its sign.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import suppress
from functools import reduce
from itertools import combinations

from dynsolve.algebra.factors import trig_factors
from dynsolve.algebra.inequality import Bound
from dynsolve.algebra.linear_systems import part
from dynsolve.algebra.matrix import Matrix, determinant, vstack
from dynsolve.algebra.ring import Expr
from dynsolve.algebra.sampling import Transfer
from dynsolve.derivation.actions import rotor_row
from dynsolve.derivation.elimination import ParameterSigns
from dynsolve.derivation.existence import at_quarters, conditions, is_seen
from dynsolve.derivation.graph import Derivation
from dynsolve.derivation.link_frame import LinkJacobian, axes_in_link
from dynsolve.derivation.mechanism import own_angular_jacobian
from dynsolve.derivation.search_ring import search_ring
from dynsolve.derivation.singular.sets import singular_set
from dynsolve.errors import AlgebraError
from dynsolve.robot.model import Body, Robot

Place = tuple[tuple[Expr, ...], tuple[Bound, ...]]
"""What is 0 together there, and what the parameters must satisfy for that to be somewhere."""

MOST_TERMS = 12
"""The terms of a factor of det D up to which a reader sees where it is 0."""


def without_inverse(robot: Robot, values: Derivation) -> list[Place] | None:
    """All places where D has no inverse, being positive definite elsewhere; None where these are not seen."""
    if robot.given is not None:
        return _of_given(robot, values["D"])
    ring, signs = search_ring(robot.ring, (), {}), ParameterSigns(robot.questions.model.assumed)
    there, back = Transfer(robot.ring, ring), Transfer(ring, robot.ring)
    parts = [each for body in robot.bodies for each in _of_body(robot, values, body, signs)]
    parts += [_of_rotor(robot, values, k, signs) for k in range(len(robot.actions.rotors))]
    known = [each.map(there) for each in parts if each is not None]
    found = singular_set(reduce(vstack, known)) if 0 < len(known) == len(parts) else None
    if found is None or found.rank < robot.n or found.special or found.may_be_others:
        return None
    sets = [tuple(condition.expr for condition in one) for one in found.alternatives]
    places = list(_possible(sets, signs.moved(there)))
    if all(is_seen(zeros, signs.moved(there)) for zeros, _ in places):
        with suppress(AlgebraError):  # the robot's ring, with sums of angles, has not every angle
            return [(tuple(map(back, zeros)), bounds) for zeros, bounds in places]
    return None


def some_without_inverse(robot: Robot, det: Expr) -> tuple[list[Place], bool]:
    """Places where a factor of det D is 0, and whether these are surely all."""
    signs = ParameterSigns(robot.questions.model.assumed)
    places = list(_possible(_moving(det), signs))
    seen = [
        (zeros, bounds) for zeros, bounds in places if len(zeros[0]) <= MOST_TERMS and is_seen(zeros, signs)
    ]
    return seen, len(seen) == len(places)


def _of_given(robot: Robot, D: Matrix) -> list[Place] | None:
    """The same of given energies, with which D is positive definite somewhere, or not."""
    signs = ParameterSigns(robot.questions.model.assumed)
    firsts = [tuple(range(k)) for k in range(1, robot.n + 1)]
    minors = [determinant(part(D, first, first)) for first in firsts]
    places = list(_possible(_moving(minors[-1]), signs))
    is_somewhere = any(all(map(signs.is_positive, at)) for _, at in at_quarters(minors))
    return places if is_somewhere and all(is_seen(zeros, signs) for zeros, _ in places) else None


def _moving(det: Expr) -> list[tuple[Expr]]:
    """The factors that are 0 at some poses."""
    return [(factor,) for factor, _ in trig_factors(det) if factor.ring.depends_on_coordinates(factor)]


def _possible(sets: Sequence[tuple[Expr, ...]], signs: ParameterSigns) -> Iterator[Place]:
    """The sets that are 0 together somewhere, if parameters satisfy something."""
    for zeros in sets:
        bounds = conditions(zeros, signs)
        if bounds is not None:
            yield zeros, bounds


def of_parameters(robot: Robot, det: Expr) -> list[Expr]:
    """The factors of det D that are 0 for some parameters, whatever the coordinates are: R - r, sin β."""
    signs = ParameterSigns(robot.questions.model.assumed)
    return [
        factor
        for factor, _ in trig_factors(det)
        if not robot.ring.depends_on_coordinates(factor)
        and (_has_both_signs(factor) or _is_turned(factor))
        and not signs.open_part(factor).is_number
    ]


def _has_both_signs(factor: Expr) -> bool:
    """Whether it is one parameter less another."""
    return len(factor) == 2 and len({size > 0 for size in factor.poly.coeffs()}) == 2


def _is_turned(factor: Expr) -> bool:
    """Whether it is the sine or the cosine of a constant angle."""
    kinds = {factor.ring.generators[k].kind for k, power in enumerate(factor.poly.degrees()) if power}
    return len(factor) == 1 and kinds <= {"sin", "cos"}


def is_of_a_body(values: Derivation, body: Body) -> bool:
    """Whether a tensor is seen to be one of a body, whatever positive numbers its parameters are."""
    rows = values[f"I_body{body.name}"].rows
    return all(
        all(factor >= 0 for factor in entry.poly.coeffs()) if i == j else entry.is_zero
        for i, row in enumerate(rows)
        for j, entry in enumerate(row)
    )


def is_of_no_body(values: Derivation, body: Body) -> bool:
    """Whether a tensor has a negative moment about the mass centre, as one given in part elsewhere may."""
    rows = values[f"I_body{body.name}"].rows
    moments = (rows[k][k].poly.coeffs() for k in range(3))
    return any(moment and all(factor < 0 for factor in moment) for moment in moments)


def _of_body(robot: Robot, values: Derivation, body: Body, signs: ParameterSigns) -> Iterator[Matrix | None]:
    """What makes the velocities of a body that have an inertia of the rates; None where that has no sign."""
    if robot.has_table:
        link: LinkJacobian = values["link_jacobians"][body.link - 1]
        linear, turning = link.at(body.center), axes_in_link(robot, body, values[f"H{body.link}"]).T
        angular = turning @ link.angular
    else:
        linear, angular = values[f"Jv{body.name}"], own_angular_jacobian(robot, body)
    yield linear if signs.is_positive(body.mass) else None
    tensor = values[f"I_body{body.name}"]
    if body.is_point or angular.is_zero or tensor.is_zero:
        return
    moments = [k for k in range(3) if not tensor[k, k].is_zero]
    is_known = all(signs.is_positive(tensor[k, k]) for k in moments)
    is_known &= all(tensor[i, j].is_zero for i, j in combinations(range(3), 2))
    yield Matrix(robot.ring, tuple(angular.rows[k] for k in moments)) if is_known else None


def _of_rotor(robot: Robot, values: Derivation, k: int, signs: ParameterSigns) -> Matrix | None:
    """The same of a rotor."""
    rotor = robot.actions.rotors[k]
    row = rotor_row(robot, rotor, values["link_jacobians"] if rotor.carrier else ())
    return row if signs.is_positive(rotor.inertia) else None
