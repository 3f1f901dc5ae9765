"""What only some exercises ask, verified by computations that share no formula with it."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping

from dynsolve.derivation.balance_check import verify_balance
from dynsolve.derivation.configuration_check import Singular, verify_inverse, verify_singular, verify_target
from dynsolve.derivation.constraint_check import ACTING, verify_constraints
from dynsolve.derivation.definite_check import verify_definite
from dynsolve.derivation.equilibrium_check import Case, balanced_forces, verify_equilibria
from dynsolve.derivation.forward_check import COMPARED, verify_forward
from dynsolve.derivation.graph import Derivation, Skipped
from dynsolve.derivation.kinematic_check import checked_names, verify_kinematics
from dynsolve.derivation.linear_check import linear_names, verify_linear
from dynsolve.derivation.model_check import model_names, verify_model, verify_references
from dynsolve.derivation.rate_check import rate_names, verify_rates
from dynsolve.derivation.reached import angle_rows
from dynsolve.derivation.recursion_check import recursion_names, verify_recursions
from dynsolve.derivation.reduced_check import constrained_names, verify_reduced
from dynsolve.derivation.static_check import verify_statics
from dynsolve.explain.forms import Forms
from dynsolve.explain.inverse_formulas import ConfigurationForms
from dynsolve.notation.tree import Negative, Node, Sum
from dynsolve.quantities.robot_stages import asked_stages
from dynsolve.quantities.stages import Stage
from dynsolve.robot.model import Robot

Verify = Callable[[Robot, Mapping[str, Node], int], object]
"""Holds results, as they are printed, at some states."""


def verify_asked(robot: Robot, values: Derivation, forms: Forms, states: int) -> None:
    """Verify what is asked for beside the course's derivation, and what that is derived from.

    Raises VerificationError where a result is wrong.
    """
    left_out = {name for name, _ in skipped(robot, values)}
    wanted = values.leading_to(robot.questions.asked) - left_out

    def hold(verify: Verify, names: Iterable[str]) -> None:
        verify(robot, {name: forms(name) for name in names}, states)

    hold(verify_kinematics, checked_names(robot, wanted))
    hold(verify_rates, rate_names(robot, wanted))
    hold(verify_statics, (name for name in ("Q", "tau_static") if name in wanted))
    if robot.questions.constraints:
        acting = ("D", *ACTING) if "lambda" in wanted else ()
        kept = ("hc", "Ac", "Ac_dot", "lambda", *acting)
        hold(verify_constraints, (name for name in kept if name in wanted))
    if Stage.NEWTON_EULER in asked_stages(robot.questions):
        hold(verify_recursions, recursion_names(robot, wanted))
    hold(verify_model, (name for name in model_names(wanted) if name in values.rules))
    if "Yr" in wanted:
        hold(verify_references, ("Yr", "a", "D", "C", "g"))
    hold(verify_linear, (name for name in linear_names(wanted) if name in values.rules))
    if "qdd_forward" in wanted:
        forward = (name for name in COMPARED if name in values.rules)
        hold(verify_forward, (name for name in forward if name != "Q" or name in wanted))
    _verify_found(robot, values, forms, wanted)
    _verify_configurations(robot, values, forms, wanted)
    if "definite" in wanted:
        for candidate, found in zip(robot.questions.candidates, values["definite"], strict=True):
            if not isinstance(found, Skipped):
                verify_definite(robot, candidate, found, states)


def skipped(robot: Robot, values: Derivation) -> Iterator[tuple[str, str]]:
    """The names of what is asked for and was not worked out, with the reasons."""
    for name in sorted(robot.questions.asked & values.rules.keys()):
        value = values[name]
        if isinstance(value, Skipped):
            yield name, value.why
        elif name == "inverse" and robot.questions.target is not None:
            lacking = ConfigurationForms(robot, values).without_number
            if lacking:
                yield "inverse in numbers", f"{lacking} has none; give it one under values"


def _verify_found(robot: Robot, values: Derivation, forms: Forms, wanted: frozenset[str]) -> None:
    """Hold equations without multipliers, equilibria, and conditions that balance gravity, as printed."""
    shown = ConfigurationForms(robot, values)
    if "reduced" in wanted and robot.questions.constraints and not isinstance(values["reduced"], Skipped):
        residuals = [Sum((left, Negative(right))) for left, right in shown.reduced]
        verify_reduced(robot, {name: forms(name) for name in constrained_names(robot)}, residuals)
    if "balance" in wanted:
        verify_balance(robot, forms("g"), shown.balance)
    if "equilibria" in wanted:
        cases = [Case(*case) for case in zip(shown.equilibria, values["equilibria"].points, strict=True)]
        verify_equilibria(robot, forms(balanced_forces(robot)), cases)


def _verify_configurations(robot: Robot, values: Derivation, forms: Forms, wanted: frozenset[str]) -> None:
    """Hold the singular configurations and the branches of the inverse, as printed, in numbers."""
    shown = ConfigurationForms(robot, values)
    if "inverse" in wanted and shown.solved is not None:
        (task,) = values.rules["inverse"].inputs
        branches = list(zip(shown.inverse, shown.when, strict=True))
        verify_inverse(robot, forms(task), angle_rows(values[task]), branches)
    if "inverse" in wanted and shown.target is not None:
        target = shown.target
        configurations = [(c.formulas, c.free) for c in target.configurations]
        verify_target(robot, target.task, target.angles, target.numbers, configurations)
    found = shown.singular_set if "singular" in wanted else None
    if found is not None:
        (jacobian,) = values.rules["singular"].inputs
        ranks = [loss.rank for loss in found.losses]
        cases = [Singular(*case) for case in zip(shown.singular, ranks, shown.lost, strict=True)]
        verify_singular(robot, forms(jacobian), found.rank, cases)
