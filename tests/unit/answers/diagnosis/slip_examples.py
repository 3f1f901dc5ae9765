"""Hand-ins that show the slips: `name` of `problem` with a wrong value, other answers beside it."""

from __future__ import annotations

from dataclasses import dataclass, field


@dataclass(frozen=True)
class Example:
    problem: str
    name: str
    value: str | list[list[str]]
    beside: dict[str, str | list[list[str]]] = field(default_factory=dict)


IN3140 = "in3140-rp"
PLANAR_2R = "planar-2r"

NUMBERS = """
gravity: [0, -g, 0]
dh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}]
masses:
  - {mass: m1, link: 1, shape: point, center: midpoint}
  - {mass: m2, link: 2, shape: point, center: tip}
values: {l1: 0.6, l2: 0.5, m1: 4, m2: 2, g: 9.81}
find: [D, g, P]
"""

HELD = """
dh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}]
velocity: [v, 0]
forces: [{link: 2, force: [0, F, 0], moment: [0, 0, M]}]
find: [qd, Q, tau_static]
"""

_PENDULUM = """
dh: [{theta: q1*, a: l1}]
gravity: [0, -g, 0]
masses: [{mass: m1, link: 1, center: midpoint, inertia: {zz: I1}, about: joint}]
"""

_DRIVEN = """
dh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}]
gravity: [0, -g, 0]
masses: [{mass: m1, link: 1}, {mass: m2, link: 2}]
friction: {q1: {viscous: fv1, coulomb: fc1}, q2: fv2}
dampers: [{damping: b, of: q2 - q1}]
springs: [{stiffness: k, of: q2 - q1, rest: delta}]
motors: [{turns: q1, inertia: Im1, ratio: kr1}, {turns: q2, inertia: Im2, ratio: kr2, carrier: 1}]
"""
_WEIGHTS = "m1*g*l1*sin(q1) + m2*g*(l1*sin(q1) + l2*sin(q1+q2))"
_MASSES = ("m1*l1^2*q1_dot^2/2 + m2*(l1^2*q1_dot^2 + l2^2*(q1_dot+q2_dot)^2"
           " + 2*l1*l2*cos(q2)*q1_dot*(q1_dot+q2_dot))/2")  # fmt: skip
_TAU2 = ("m2*(l2^2+l1*l2*cos(q2))*q1_ddot + m2*l2^2*q2_ddot + m2*l1*l2*sin(q2)*q1_dot^2"
         " + m2*g*l2*cos(q1+q2) + k*(q2-q1-delta) + Im2*kr2*q1_ddot + Im2*kr2^2*q2_ddot")  # fmt: skip

_BLADE = """
gravity: none
model:
  coordinates: {x: prismatic, y: prismatic, phi: revolute}
  bodies: [{mass: m, at: [x, y, 0], turn: phi, about: [0, 0, 1], inertia: {zz: J}}]
constraints: [{rates: x'*sin(phi) - y'*cos(phi)}]
find: [tau, Ac, lambda]
"""

EXAMPLES: dict[str, Example] = {
    "sign": Example(IN3140, "tau1", "(I1zz + m2*L2^2)*theta1_ddot - 2*m2*L2*L2_dot*theta1_dot"),
    "sign_all": Example(
        PLANAR_2R,
        "L",
        "-I1*q1_dot^2/2 - I2*(q1_dot+q2_dot)^2/2"
        " - m1*lc1^2*q1_dot^2/2 - m2*(l1^2*q1_dot^2 + lc2^2*(q1_dot+q2_dot)^2"
        " + 2*l1*lc2*cos(q2)*q1_dot*(q1_dot+q2_dot))/2"
        " + m1*g*lc1*sin(q1) + m2*g*(l1*sin(q1)+lc2*sin(q1+q2))",
    ),
    "factor": Example(IN3140, "tau1", "(I1zz + m2*L2^2)*theta1_ddot + m2*L2*L2_dot*theta1_dot"),
    "rounded_all": Example(IN3140, "Kw1", "0.497*I1zz*theta1_dot^2"),
    "factor_all": Example(IN3140, "Kw1", "I1zz*theta1_dot^2"),
    "number": Example(
        NUMBERS, "D", [["2.66 + 1.2*cos(q2)", "0.5 + 0.6*cos(q2)"], ["0.5 + 0.6*cos(q2)", "0.5"]]
    ),
    "constant": Example(
        PLANAR_2R,
        "A1",
        [
            ["2", "-sin(q1)", "0", "l1*cos(q1)"],
            ["sin(q1)", "cos(q1)", "0", "l1*sin(q1)"],
            ["0", "0", "1", "0"],
            ["0", "0", "0", "1"],
        ],
    ),
    "missing_term": Example(PLANAR_2R, "d11", "m1*lc1^2 + m2*(l1^2 + lc2^2) + I1 + I2"),
    "terms_missing": Example(PLANAR_2R, "d11", "I1 + m2*l1^2"),
    "zero": Example(IN3140, "K", "0"),
    "extra_term": Example(IN3140, "f2", "m2*L2_ddot - m2*L2*theta1_dot^2 + m2*g"),
    "dropped_mass": Example(IN3140, "f2", "L2_ddot - m2*L2*theta1_dot^2"),
    "dropped_inertia": Example(IN3140, "dLdqd1", "theta1_dot + m2*L2^2*theta1_dot"),
    "dropped_square": Example(IN3140, "Kv2", "m2*(L2*theta1_dot^2 + L2_dot^2)/2"),
    "extra_square": Example(IN3140, "f2", "m2*L2_ddot - m2*L2^2*theta1_dot^2"),
    "dropped_dot": Example(IN3140, "K", "I1zz*theta1_dot^2/2 + m2*(L2^2*theta1_dot^2 + L2^2)/2"),
    "extra_dot": Example(IN3140, "ddt1", "I1zz*theta1_ddot + m2*L2^2*theta1_ddot + 2*m2*L2_dot^2*theta1_dot"),
    "dropped_velocity": Example(IN3140, "ddt1", "I1zz*theta1_ddot + m2*L2^2*theta1_ddot + 2*m2*L2*L2_dot"),
    "dropped_factor": Example(IN3140, "P2", "m2*g"),
    "extra_factor": Example(IN3140, "P2", "m2*g*L1*L2"),
    "symbol": Example(IN3140, "P2", "m1*g*L1"),
    "symbol_throughout": Example(PLANAR_2R, "d11", "m1*lc1^2 + m2*(l1^2 + l1^2 + 2*l1*l1*cos(q2)) + I1 + I2"),
    "number_for_letter": Example(PLANAR_2R, "g2", "m2*9.81*lc2*cos(q1+q2)"),
    "numbers_for_letters": Example(PLANAR_2R, "g2", "2*9.81*0.4*cos(q1+q2)"),
    "symbols_swapped": Example(PLANAR_2R, "P", "m2*g*lc1*sin(q1) + m1*g*(l1*sin(q1)+lc2*sin(q1+q2))"),
    "sin_for_cos": Example(PLANAR_2R, "P1", "m1*g*lc1*cos(q1)"),
    "double_angle": Example(IN3140, "Kv2", "m2*(cos(2*theta1)*L2^2*theta1_dot^2 + L2_dot^2)/2"),
    "angle": Example(PLANAR_2R, "P2", "m2*g*(l1*sin(q1) + lc2*sin(q2))"),
    "angle_product": Example(PLANAR_2R, "P2", "m2*g*(l1*sin(q1) + lc2*sin(q1*q2))"),
    "dimensions": Example(IN3140, "tau1", "theta1_ddot + m2*L2^2*theta1_ddot + 2*m2*L2*L2_dot*theta1_dot"),
    "odd_argument": Example(PLANAR_2R, "g2", "m2*lc2*g*cos(sin(q1))"),
    "unknown_symbol": Example(PLANAR_2R, "g2", "m3*lc2*g*cos(q1 + q2)"),
    "another_model": Example(PLANAR_2R, "g2", "(m2*lc2 + mL*l2)*g*cos(q1 + q2)"),
    "constant_term": Example(IN3140, "P", "m1*g*L1/2 + m2*g*L1 + m2*g*L1/3"),
    "transposed": Example(
        IN3140,
        "A1",
        [
            ["-sin(theta1)", "cos(theta1)", "0", "0"],
            ["0", "0", "1", "0"],
            ["cos(theta1)", "sin(theta1)", "0", "0"],
            ["0", "0", "L1", "1"],
        ],
    ),
    "rows_swapped": Example(
        IN3140,
        "tau",
        [["m2*L2_ddot - m2*L2*theta1_dot^2"], ["(I1zz + m2*L2^2)*theta1_ddot + 2*m2*L2*L2_dot*theta1_dot"]],
    ),
    "shape": Example(PLANAR_2R, "g", [["m2*lc2*g*cos(q1)"]]),
    "equation": Example(
        """
dh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}, {theta: q3*, a: l3}]
velocity: [vx, vy]
state: {q1: 0, q2: 90deg, q3: 0}
find: [qd]
""",
        "qd",
        [["vy/l1"], ["0"], ["0"]],
    ),
    "span": Example(
        """
dh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}, {theta: q3*, a: l3}]
state: {q2: 0, q3: 0}
find: [nullspace]
""",
        "nullspace",
        [["l2 + l3", "-l1", "0"], ["l3", "0", "-l1"]],
    ),
    "gravity_sign": Example(PLANAR_2R, "P", "-m1*g*lc1*sin(q1) - m2*g*(l1*sin(q1)+lc2*sin(q1+q2))"),
    "gravity_missing": Example(IN3140, "L", "I1zz*theta1_dot^2/2 + m2*(L2^2*theta1_dot^2 + L2_dot^2)/2"),
    "product_rule": Example(
        PLANAR_2R, "ddt2", "(m2*(lc2^2 + l1*lc2*cos(q2)) + I2)*q1_ddot + (m2*lc2^2+I2)*q2_ddot"
    ),
    "chain_rule": Example(
        PLANAR_2R,
        "ddt2",
        "(m2*(lc2^2 + l1*lc2*cos(q2)) + I2)*q1_ddot + (m2*lc2^2+I2)*q2_ddot - m2*l1*lc2*sin(q2)*q1_dot",
    ),
    "lagrangian_sum": Example(
        IN3140, "L", "I1zz*theta1_dot^2/2 + m2*(L2^2*theta1_dot^2 + L2_dot^2)/2 + m1*g*L1/2 + m2*g*L1"
    ),
    "slope_sign": Example(IN3140, "f2", "m2*L2_ddot + m2*L2*theta1_dot^2", {"dLdq2": "m2*L2*theta1_dot^2"}),
    "slope_missing": Example(IN3140, "f2", "m2*L2_ddot"),
    "body_missing": Example(IN3140, "P", "m2*g*L1", {"P1": "m1*g*L1/2"}),
    "rotation_missing": Example(
        PLANAR_2R,
        "K",
        "m1*lc1^2*q1_dot^2/2 + m2*(l1^2*q1_dot^2 + lc2^2*(q1_dot+q2_dot)^2"
        " + 2*l1*lc2*cos(q2)*q1_dot*(q1_dot+q2_dot))/2",
    ),
    "translation_missing": Example(PLANAR_2R, "K1", "I1*q1_dot^2/2"),
    "frame_origin": Example(PLANAR_2R, "P1", "m1*g*l1*sin(q1)"),
    "parallel_axis_missing": Example(_PENDULUM, "d11", "I1 + m1*l1^2/4"),
    "parallel_axis_twice": Example(
        PLANAR_2R,
        "D",
        [
            ["I1 + 2*m1*lc1^2 + m2*(l1^2+lc2^2+2*l1*lc2*cos(q2)) + I2", "m2*(lc2^2+l1*lc2*cos(q2))+I2"],
            ["m2*(lc2^2+l1*lc2*cos(q2))+I2", "m2*lc2^2+I2"],
        ],
    ),
    "christoffel_without_rates": Example(
        PLANAR_2R, "C", [["-m2*l1*lc2*sin(q2)", "-2*m2*l1*lc2*sin(q2)"], ["m2*l1*lc2*sin(q2)", "0"]]
    ),
    "christoffel_half": Example(
        PLANAR_2R,
        "C",
        [
            ["-2*m2*l1*lc2*sin(q2)*q2_dot", "-2*m2*l1*lc2*sin(q2)*(q1_dot+q2_dot)"],
            ["2*m2*l1*lc2*sin(q2)*q1_dot", "0"],
        ],
    ),
    "acceleration_in_C": Example(
        IN3140, "C", [["m2*L2*L2_dot", "m2*L2*theta1_dot"], ["-m2*L2*theta1_dot", "m2*L2_ddot"]]
    ),
    "C_not_polynomial": Example(
        PLANAR_2R,
        "C",
        [["-m2*l1*lc2*sin(q2)*(2*q2_dot + q2_dot^2/q1_dot)", "0"], ["m2*l1*lc2*sin(q2)*q1_dot", "0"]],
    ),
    "parameters": Example(
        """
dh: [{theta: q1*, a: l1}]
gravity: [0, -g, 0]
masses: [{mass: m1, link: 1, center: midpoint, inertia: {zz: I1}}]
parameters: {known: [l1, g]}
find: [Y, a]
""",
        "a",
        [["I1"]],
    ),
    "friction_missing": Example(_DRIVEN, "tau2", _TAU2),
    "friction_sign": Example(_DRIVEN, "tau2", _TAU2 + " - fv2*q2_dot - b*(q2_dot-q1_dot)"),
    "coulomb_missing": Example(
        _DRIVEN, "friction", [["fv1*q1_dot - b*(q2_dot-q1_dot)"], ["fv2*q2_dot + b*(q2_dot-q1_dot)"]]
    ),
    "dampers_missing": Example(_DRIVEN, "friction", [["fv1*q1_dot + fc1*sgn(q1_dot)"], ["fv2*q2_dot"]]),
    "springs_missing": Example(_DRIVEN, "P", _WEIGHTS),
    "spring_sign": Example(_DRIVEN, "P", _WEIGHTS + " - k*(q2-q1-delta)^2/2"),
    "spring_half": Example(_DRIVEN, "Ps", "k*(q2-q1-delta)^2"),
    "spring_rest": Example(_DRIVEN, "Ps", "k*(q2-q1)^2/2"),
    "spring_rest_sign": Example(_DRIVEN, "Ps", "k*(q2-q1+delta)^2/2"),
    "spring_square": Example(_DRIVEN, "Ps", "k*((q2-q1)^2-delta^2)/2"),
    "rotors_missing": Example(_DRIVEN, "K", _MASSES),
    "carried_spin": Example(_DRIVEN, "Km", "Im1*kr1^2*q1_dot^2/2 + Im2*kr2^2*q2_dot^2/2"),
    "gear_square": Example(
        _DRIVEN, "Km", "Im1*kr1*q1_dot^2/2 + Im2*(kr2*q2_dot^2 + 2*kr2*q1_dot*q2_dot + q1_dot^2)/2"
    ),
    "gear_missing": Example(_DRIVEN, "Km", "Im1*q1_dot^2/2 + Im2*(q2_dot + q1_dot)^2/2"),
    "load_sign": Example(
        HELD, "tau_static", [["l1*cos(q1)*F + l2*cos(q1 + q2)*F + M"], ["l2*cos(q1 + q2)*F + M"]]
    ),
    "moments_left_out": Example(HELD, "Q", [["l1*cos(q1)*F + l2*cos(q1 + q2)*F"], ["l2*cos(q1 + q2)*F"]]),
    "weight_left_out": Example(
        """
gravity: [0, -g, 0]
dh: [{theta: q1*, a: l1}]
masses: [{mass: m1, link: 1}]
forces: [{link: 1, force: [0, F, 0]}]
find: [tau_static]
""",
        "tau_static",
        [["-l1*cos(q1)*F"]],
    ),
    "constraint_forces": Example(
        _BLADE, "tau", [["m*x_ddot - lambda1*sin(phi)"], ["m*y_ddot - lambda1*cos(phi)"], ["J*phi_ddot"]]
    ),
    "multiplier_side": Example(
        _BLADE,
        "lambda",
        "(f1*sin(phi) - f2*cos(phi))*(-1) - m*phi_dot*(x_dot*cos(phi) + y_dot*sin(phi))",
        {"f1": "m*x_ddot + lambda1*sin(phi)", "f2": "m*y_ddot - lambda1*cos(phi)"},
    ),
    "state_order": Example(
        """
gravity: [0, -g, 0]
dh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}]
masses: [{mass: m1, link: 1}, {mass: m2, link: 2}]
linearize: {q1: -90deg, q2: 0}
find: [linear_A]
""",
        "linear_A",
        [["0", "1", "0", "0"], ["a", "0", "a", "0"], ["0", "0", "0", "1"], ["a", "0", "a", "0"]],
    ),
    "joint_columns": Example(IN3140, "Jv1", [["0", "cos(theta1)"], ["0", "sin(theta1)"], ["0", "0"]]),
    "prismatic_turns": Example(IN3140, "Jw", [["0", "cos(theta1)"], ["0", "sin(theta1)"], ["1", "0"]]),
    "order": Example(
        IN3140,
        "H2",
        [
            ["-sin(theta1)", "0", "cos(theta1)", "0"],
            ["cos(theta1)", "0", "sin(theta1)", "0"],
            ["0", "1", "0", "L1+L2"],
            ["0", "0", "0", "1"],
        ],
    ),
    "convention": Example(
        IN3140,
        "A1",
        [
            ["-sin(theta1)", "-cos(theta1)", "0", "0"],
            ["0", "0", "-1", "-L1"],
            ["cos(theta1)", "-sin(theta1)", "0", "0"],
            ["0", "0", "0", "1"],
        ],
    ),
    "offset": Example(
        IN3140,
        "A1",
        [
            ["cos(theta1)", "0", "sin(theta1)", "0"],
            ["sin(theta1)", "0", "-cos(theta1)", "0"],
            ["0", "1", "0", "L1"],
            ["0", "0", "0", "1"],
        ],
    ),
    "twist_sign": Example(
        IN3140,
        "A1",
        [
            ["-sin(theta1)", "0", "-cos(theta1)", "0"],
            ["cos(theta1)", "0", "-sin(theta1)", "0"],
            ["0", "-1", "0", "L1"],
            ["0", "0", "0", "1"],
        ],
    ),
    "tool_frame": Example(PLANAR_2R, "Jv", [["l1*sin(q2)", "0"], ["l1*cos(q2) + l2", "l2"], ["0", "0"]]),
    "transpose_for_inverse": Example(
        HELD, "qd", [["-l1*sin(q1)*v - l2*sin(q1 + q2)*v"], ["-l2*sin(q1 + q2)*v"]]
    ),
    "dh_cell": Example(PLANAR_2R, "DH", [["q1", "0", "l1", "90deg"], ["q2", "0", "l2", "0"]]),
    "dh_exchanged": Example(PLANAR_2R, "DH", [["q1", "l1", "0", "0"], ["q2", "0", "l2", "0"]]),
    "dh_joints": Example(PLANAR_2R, "DH", [["0", "q1", "l1", "0"], ["q2", "0", "l2", "0"]]),
    "dh_mechanism": Example(PLANAR_2R, "DH", [["q1", "0", "0", "45deg"], ["q2", "l1", "l1", "90deg"]]),
    "dh_convention": Example(
        """
convention: modified
dh: [{theta: q1*}, {theta: q2*, a: l1}, {a: l2}]
""",
        "DH",
        [["q1", "0", "l1", "0"], ["q2", "0", "l2", "0"]],
    ),
    "dh_shifted": Example(
        "elbow-3r",
        "DH",
        [["theta1", "L1", "0", "0"], ["theta2", "0", "0", "90deg"], ["theta3", "0", "L2", "0"]],
    ),
    "dh_sense": Example(
        """
strict: true
dh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}]
""",
        "DH",
        [["q1", "0", "l1", "0"], ["q2 + 90deg", "0", "l2", "0"]],
    ),
}
