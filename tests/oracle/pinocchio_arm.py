"""An arm as Pinocchio sees it: one joint a row that moves, mapped to the coordinates by a constant matrix.

With q_rows = E q, the model in the coordinates is D = Eᵀ M E, tau = Eᵀ tau_rows.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
import pinocchio as pin

from tests.oracle.reading import Arm, Array


@dataclass(frozen=True)
class Dynamics:
    """Every quantity that is compared, at one state."""

    H: list[Array]
    r_c: list[Array]
    P: float
    K: float
    tau: Array
    D: Array
    Cqd: Array
    g: Array


def dynamics(arm: Arm, q: Array, qd: Array, qdd: Array) -> Dynamics:
    """What Pinocchio computes for `arm` at a state."""
    model, frames, E = model_of(arm)
    data = model.createData()
    rows, rates, accelerations = E @ q, E @ qd, E @ qdd
    pin.forwardKinematics(model, data, rows, rates)
    H = [(data.oMi[joint] * place).homogeneous for joint, place in frames]
    r_c = [(H[body.link - 1] @ np.append(body.center, 1))[:3] for body in arm.masses]
    on_ground = sum(
        -body.mass * float(arm.gravity @ point)
        for body, point in zip(arm.masses, r_c, strict=True)
        if frames[body.link - 1][0] == 0
    )
    M = np.array(pin.crba(model, data, rows))
    M = np.triu(M) + np.triu(M, 1).T
    gravity = pin.computeGeneralizedGravity(model, data, rows)
    bias = np.array(pin.nonLinearEffects(model, data, rows, rates))
    return Dynamics(
        H=H,
        r_c=r_c,
        P=pin.computePotentialEnergy(model, data, rows) + on_ground,
        K=pin.computeKineticEnergy(model, data, rows, rates),
        tau=E.T @ pin.rnea(model, data, rows, rates, accelerations),
        D=E.T @ M @ E,
        Cqd=E.T @ (bias - gravity),
        g=E.T @ gravity,
    )


def jacobians(arm: Arm, q: Array, qd: Array) -> tuple[Array, Array]:
    """J of the last frame along the axes of the world, and its time derivative, both 6×n."""
    model, frames, E = model_of(arm)
    joint, place = frames[-1]
    end = model.addFrame(pin.Frame("end", joint, 0, place, pin.FrameType.OP_FRAME))
    data = model.createData()
    pin.computeJointJacobiansTimeVariation(model, data, E @ q, E @ qd)
    pin.updateFramePlacements(model, data)
    along = pin.ReferenceFrame.LOCAL_WORLD_ALIGNED
    found = (
        pin.getFrameJacobian(model, data, end, along),
        pin.getFrameJacobianTimeVariation(model, data, end, along),
    )
    return found[0] @ E, found[1] @ E


def model_of(arm: Arm) -> tuple[pin.Model, list[tuple[int, pin.SE3]], Array]:
    """The model; for each frame of the table its joint and its place on it; and E."""
    model = pin.Model()
    model.gravity.linear = arm.gravity
    starts: dict[int, tuple[int, pin.SE3]] = {0: (0, pin.SE3(arm.base))}
    E = []
    for index in _depth_first(arm, 0):
        row = arm.rows[index]
        joint, place = starts[row.start]
        place = place * pin.SE3(row.before)
        if row.kind != "fixed":
            kind = pin.JointModelRZ() if row.kind == "revolute" else pin.JointModelPZ()
            joint = model.addJoint(joint, kind, place, f"row{index + 1}")
            place = pin.SE3.Identity()
            E.append(row.rates)
        place = place * pin.SE3(row.after)
        starts[index + 1] = (joint, place)
    frames = [starts[index + 1] for index in range(len(arm.rows))]
    for body in arm.masses:
        joint, place = frames[body.link - 1]
        if joint:
            inertia = pin.Inertia(body.mass, body.center, np.eye(3))
            inertia.inertia = (
                body.tensor
            )  # the constructor refuses a tensor that no real body has; exercises do not
            model.appendBodyToJoint(joint, inertia, place)
    return model, frames, np.array(E).reshape(-1, len(arm.coordinates))


def _depth_first(arm: Arm, frame: int) -> Iterator[int]:
    """The rows that start from a frame, from 0, each with what follows it: the order that Pinocchio wants."""
    for index, row in enumerate(arm.rows):
        if row.start == frame:
            yield index
            yield from _depth_first(arm, index + 1)
