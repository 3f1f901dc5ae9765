"""What only some exercises ask, verified by computations that share no formula with it."""

from __future__ import annotations

from collections.abc import Iterator

from dynsolve.derivation.graph import Derivation, Skipped
from dynsolve.derivation.kinematic_check import checked_names, verify_kinematics
from dynsolve.derivation.linear_check import linear_names, verify_linear
from dynsolve.derivation.model_check import model_names, verify_model, verify_references
from dynsolve.derivation.rate_check import rate_names, verify_rates
from dynsolve.derivation.static_check import verify_statics
from dynsolve.explain.forms import Forms
from dynsolve.notation.tree import Negative, Sum
from dynsolve.quantities.robot_stages import asked_stages
from dynsolve.quantities.stages import Stage
from dynsolve.robot.model import Robot


def verify_asked(robot: Robot, values: Derivation, forms: Forms, states: int) -> None:
    """Verify what is asked for beside the course's derivation, and what that is derived from.

    Raises VerificationError where a result is wrong.
    """
    every = values.leading_to(robot.questions.asked)
    wanted = every - {name for name, _ in skipped(robot, values)}
    verify_kinematics(robot, {name: forms(name) for name in checked_names(robot, wanted)}, states)
    verify_rates(robot, {name: forms(name) for name in rate_names(robot, wanted)}, states)
    static = [name for name in ("Q", "tau_static") if name in wanted]
    verify_statics(robot, {name: forms(name) for name in static}, states)
    _verify_constraints(robot, values, forms, wanted, states)
    _verify_recursions(robot, forms, wanted, states)
    model = [name for name in model_names(wanted) if name in values.rules]
    verify_model(robot, {name: forms(name) for name in model}, states)
    if "Yr" in wanted:
        verify_references(robot, {name: forms(name) for name in ("Yr", "a", "D", "C", "g")}, states)
    linear = [name for name in linear_names(wanted) if name in values.rules]
    verify_linear(robot, {name: forms(name) for name in linear}, states)
    if "qdd_forward" in wanted:
        from dynsolve.derivation.forward_check import COMPARED, verify_forward

        forward = [name for name in COMPARED if name in values.rules and (name != "Q" or name in wanted)]
        verify_forward(robot, {name: forms(name) for name in forward}, states)
    _verify_equilibria(robot, values, forms, wanted)
    _verify_configurations(robot, values, forms, wanted)
    if "definite" in wanted:
        from dynsolve.derivation.definite_check import verify_definite

        for candidate, found in zip(robot.questions.candidates, values["definite"], strict=True):
            if not isinstance(found, Skipped):
                verify_definite(robot, candidate, found, states)


def _verify_constraints(
    robot: Robot, values: Derivation, forms: Forms, wanted: frozenset[str], states: int
) -> None:
    """Hold the constraints, where there are any."""
    if robot.questions.constraints:
        from dynsolve.derivation.constraint_check import ACTING, verify_constraints

        needed = ("D", *ACTING) if "lambda" in wanted else ()
        names = [name for name in ("hc", "Ac", "Ac_dot", "lambda", *needed) if name in wanted]
        verify_constraints(robot, {name: forms(name) for name in names}, states)
        if "reduced" in wanted and not isinstance(values["reduced"], Skipped):
            _verify_reduced(robot, values, forms)


def _verify_reduced(robot: Robot, values: Derivation, forms: Forms) -> None:
    """Hold the equations without multipliers, as printed."""
    from dynsolve.derivation.reduced_check import constrained_names, verify_reduced
    from dynsolve.explain.inverse_formulas import ConfigurationForms

    sides = ConfigurationForms(robot, values).reduced
    residuals = [Sum((left, Negative(right))) for left, right in sides]
    verify_reduced(robot, {name: forms(name) for name in constrained_names(robot)}, residuals)


def _verify_recursions(robot: Robot, forms: Forms, wanted: frozenset[str], states: int) -> None:
    """Hold the Newton-Euler recursions, where something of them is asked."""
    if Stage.NEWTON_EULER in asked_stages(robot.questions):
        from dynsolve.derivation.recursion_check import recursion_names, verify_recursions

        verify_recursions(robot, {name: forms(name) for name in recursion_names(robot, wanted)}, states)


def skipped(robot: Robot, values: Derivation) -> Iterator[tuple[str, str]]:
    """The names of what is asked for and was not worked out, with the reasons."""
    for name in sorted(robot.questions.asked & values.rules.keys()):
        value = values[name]
        if isinstance(value, Skipped):
            yield name, value.why
        elif name == "inverse" and robot.questions.target is not None:
            from dynsolve.explain.inverse_formulas import ConfigurationForms

            lacking = ConfigurationForms(robot, values).without_number
            if lacking:
                yield "inverse in numbers", f"{lacking} has none; give it one under values"


def _verify_equilibria(robot: Robot, values: Derivation, forms: Forms, wanted: frozenset[str]) -> None:
    """Hold the equilibria, and the conditions that balance gravity, as printed, in numbers."""
    if not {"equilibria", "balance"} & wanted:
        return
    from dynsolve.explain.inverse_formulas import ConfigurationForms

    if "balance" in wanted:
        from dynsolve.derivation.balance_check import verify_balance

        verify_balance(robot, forms("g"), ConfigurationForms(robot, values).balance)
    if "equilibria" not in wanted:
        return
    from dynsolve.derivation.equilibrium_check import Case, balanced_forces, verify_equilibria

    shown = ConfigurationForms(robot, values).equilibria
    cases = [Case(*case) for case in zip(shown, values["equilibria"].points, strict=True)]
    verify_equilibria(robot, forms(balanced_forces(robot)), cases)


def _verify_configurations(robot: Robot, values: Derivation, forms: Forms, wanted: frozenset[str]) -> None:
    """Hold the singular configurations and the branches of the inverse, as printed, in numbers."""
    if not {"inverse", "singular"} & wanted:
        return
    from dynsolve.derivation.configuration_check import (
        Singular,
        verify_inverse,
        verify_singular,
        verify_target,
    )
    from dynsolve.derivation.reached import angle_rows
    from dynsolve.explain.inverse_formulas import ConfigurationForms

    shown = ConfigurationForms(robot, values)
    if "inverse" in wanted and shown.solved is not None:
        (task,) = values.rules["inverse"].inputs
        branches = list(zip(shown.inverse, shown.when, strict=True))
        verify_inverse(robot, forms(task), angle_rows(values[task]), branches)
    if "inverse" in wanted and shown.target is not None:
        configurations = [(c.formulas, c.free) for c in shown.target.configurations]
        target = shown.target
        verify_target(robot, target.task, target.angles, target.numbers, configurations)
    found = shown.singular_set if "singular" in wanted else None
    if found is not None:
        (jacobian,) = values.rules["singular"].inputs
        ranks = [loss.rank for loss in found.losses]
        cases = [Singular(*case) for case in zip(shown.singular, ranks, shown.lost, strict=True)]
        verify_singular(robot, forms(jacobian), found.rank, cases)
