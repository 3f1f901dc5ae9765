"""Slips on the way from the energies to D, C and g: a rule of calculus, a part left out, a frame.

Slips of what acts beside gravity: friction, springs, rotors, forces from outside and of constraints.

Slips in the transformations, the Jacobians and the rates.

Slips in a Denavit-Hartenberg table.

What a slip is, and the problems of the examples.
"""

from __future__ import annotations

from msgspec import Struct, field

from dynsolve.answers.verdict import Diagnosis

# What a slip is, and the problems of the examples


class Example(Struct, frozen=True):
    """A hand-in that shows a slip: `name` of `problem` with a wrong value, other answers beside it."""

    problem: str
    name: str
    value: str | list[list[str]]
    beside: dict[str, str | list[list[str]]] = field(default_factory=dict)


class Slip(Struct, frozen=True):
    """A slip: `code`, its class in a few words, the message, and what to look at.

    `omits`: a part of the derivation was left out, which is tried before what was done otherwise.
    """

    code: str
    kind: str
    message: str
    look: str
    example: Example | None = None
    omits: bool = False

    def told(self, **what: str) -> Diagnosis:
        """The slip as it happened."""
        return Diagnosis(self.code, self.message.format(**what), self.kind, self.look.format(**what))


IN3140 = "in3140-rp"
PLANAR_2R = "planar-2r"
"""Problems of the library."""

HELD = """
dh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}]
velocity: [v, 0]
forces: [{link: 2, force: [0, F, 0], moment: [0, 0, M]}]
find: [qd, Q, tau_static]
"""
"""An arm at rest, on which a force and a moment act."""

_PENDULUM = """
dh: [{theta: q1*, a: l1}]
gravity: [0, -g, 0]
masses: [{mass: m1, link: 1, center: midpoint, inertia: {zz: I1}, about: joint}]
"""

SLIPS = (
    Slip("gravity_sign", "the sign of gravity", "The terms with gravity have the wrong sign.",
         "P = m g h grows with the height; the vector of gravity points downwards, P = -m gᵀ r.",
         Example(PLANAR_2R, "P", "-m1*g*lc1*sin(q1) - m2*g*(l1*sin(q1)+lc2*sin(q1+q2))")),
    Slip("gravity_missing", "gravity left out", "Gravity is left out.",
         "L = K - P holds the potential energy too.",
         Example(IN3140, "L", "I1zz*theta1_dot^2/2 + m2*(L2^2*theta1_dot^2 + L2_dot^2)/2"),
         omits=True),
    Slip("product_rule", "the product rule",
         "When you derived with respect to time, {part} was treated as constant.",
         "Everything that moves is a function of time: derive every factor, and bring its velocity.",
         Example(PLANAR_2R, "ddt2", "(m2*(lc2^2 + l1*lc2*cos(q2)) + I2)*q1_ddot + (m2*lc2^2+I2)*q2_ddot")),
    Slip("chain_rule", "the chain rule",
         "When you derived with respect to time, the inner derivative {part} was left out.",
         "d/dt f(q) = ∂f/∂q · q̇.",
         Example(PLANAR_2R, "ddt2", "(m2*(lc2^2 + l1*lc2*cos(q2)) + I2)*q1_ddot"
                 " + (m2*lc2^2+I2)*q2_ddot - m2*l1*lc2*sin(q2)*q1_dot")),
    Slip("lagrangian_sum", "the Lagrangian", "You added P where it is subtracted: L = K - P.",
         "Look at the definition of the Lagrangian.",
         Example(IN3140, "L", "I1zz*theta1_dot^2/2 + m2*(L2^2*theta1_dot^2 + L2_dot^2)/2"
                 " + m1*g*L1/2 + m2*g*L1")),
    Slip("slope_sign", "the Euler-Lagrange equation",
         "∂L/∂q is added where it is subtracted: τ = d/dt ∂L/∂q̇ - ∂L/∂q.",
         "Look at the signs in the Euler-Lagrange equation.",
         Example(IN3140, "f2", "m2*L2_ddot + m2*L2*theta1_dot^2", {"dLdq2": "m2*L2*theta1_dot^2"})),
    Slip("slope_missing", "the Euler-Lagrange equation", "∂L/∂q is left out: τ = d/dt ∂L/∂q̇ - ∂L/∂q.",
         "The Euler-Lagrange equation has two parts.",
         Example(IN3140, "f2", "m2*L2_ddot"),
         omits=True),
    Slip("body_missing", "a body left out", "The contribution of body {part} to {other} is left out.",
         "Energies are sums over all bodies.",
         Example(IN3140, "P", "m2*g*L1", {"P1": "m1*g*L1/2"}),
         omits=True),
    Slip("rotation_missing", "the rotational energy left out",
         "The kinetic energy of rotation ½ ωᵀ I ω is left out.",
         "A body that is no point has energy of rotation too.",
         Example(PLANAR_2R, "K", "m1*lc1^2*q1_dot^2/2 + m2*(l1^2*q1_dot^2 + lc2^2*(q1_dot+q2_dot)^2"
                 " + 2*l1*lc2*cos(q2)*q1_dot*(q1_dot+q2_dot))/2"),
         omits=True),
    Slip("translation_missing", "the translational energy left out",
         "The kinetic energy of translation ½ m vᵀ v is left out.",
         "A moving mass centre has energy, whatever turns about it.",
         Example(PLANAR_2R, "K1", "I1*q1_dot^2/2"),
         omits=True),
    Slip("frame_origin", "the point that moves",
         "You took the origin of frame {part} for the mass centre of body {other}.",
         "Positions, Jacobians and velocities of a body are those of its mass centre.",
         Example(PLANAR_2R, "P1", "m1*g*l1*sin(q1)")),
    Slip("not_rotated", "the inertia tensor's frame",
         "The inertia tensor of body {part} was used in its own frame, not turned into the base frame.",
         "I_base = R I Rᵀ, with ω along the axes of the base too."),
    Slip("rotation_transposed", "a rotation the wrong way round",
         "The inertia tensor of body {part} was turned with Rᵀ I R in place of R I Rᵀ.",
         "R turns from the body's axes into the base's: I_base = R I Rᵀ."),
    Slip("frame_before", "the frame of the inertia tensor",
         "The inertia tensor of body {part} was turned with the frame before the mass, not the one after it.",
         "The frame that moves with the body is the one that comes after the mass."),
    Slip("spin_frame", "the frame of the angular velocity",
         "Body {part}'s angular velocity is along the base's axes, its inertia tensor along its own.",
         "ω and I must be given in one frame."),
    Slip("parallel_axis_missing", "the parallel-axis theorem",
         "The parallel-axis theorem was not applied to body {part}, whose tensor is about another point.",
         "Move the tensor to the mass centre before you use it beside ½ m vᵀ v.",
         Example(_PENDULUM, "d11", "I1 + m1*l1^2/4"),
         omits=True),
    Slip("parallel_axis_twice", "the parallel-axis theorem",
         "The parallel-axis term of body {part} is counted twice.",
         "½ m vᵀ v of the mass centre holds it already.",
         Example(PLANAR_2R, "D", [["I1 + 2*m1*lc1^2 + m2*(l1^2+lc2^2+2*l1*lc2*cos(q2)) + I2",
                 "m2*(lc2^2+l1*lc2*cos(q2))+I2"], ["m2*(lc2^2+l1*lc2*cos(q2))+I2", "m2*lc2^2+I2"]])),
    Slip("christoffel_without_rates", "the velocities of Christoffel's sum",
         "Christoffel's symbols are added without their velocities: c_kj = Σ_i c_ijk q̇_i.",
         "C q̇ is quadratic in the velocities, so C is linear in them.",
         Example(PLANAR_2R, "C", [["-m2*l1*lc2*sin(q2)", "-2*m2*l1*lc2*sin(q2)"],
                 ["m2*l1*lc2*sin(q2)", "0"]])),
    Slip("christoffel_half", "the ½ of Christoffel's formula", "The ½ of Christoffel's formula is left out.",
         "c_ijk = ½ (∂d_kj/∂q_i + ∂d_ki/∂q_j - ∂d_ij/∂q_k).",
         Example(PLANAR_2R, "C", [["-2*m2*l1*lc2*sin(q2)*q2_dot", "-2*m2*l1*lc2*sin(q2)*(q1_dot+q2_dot)"],
                 ["2*m2*l1*lc2*sin(q2)*q1_dot", "0"]])),
    Slip("acceleration_in_C", "a term in the wrong matrix",
         "Your C contains a joint acceleration; what is multiplied by q̈ belongs into D.",
         "C holds only coordinates and velocities.",
         Example(IN3140, "C", [["m2*L2*L2_dot", "m2*L2*theta1_dot"], ["-m2*L2*theta1_dot", "m2*L2_ddot"]])),
    Slip("C_not_polynomial", "the form of C", "Your C has a joint variable or a velocity in a denominator.",
         "C is linear in the velocities; nothing is divided by what may be 0.",
         Example(PLANAR_2R, "C", [["-m2*l1*lc2*sin(q2)*(2*q2_dot + q2_dot^2/q1_dot)", "0"],
                 ["m2*l1*lc2*sin(q2)*q1_dot", "0"]])),
    Slip("parameters", "parameters that are too few", "{yours}",
         "Multiply the forces out: what stands beside one function of the motion is one coefficient.",
         Example("""
dh: [{theta: q1*, a: l1}]
gravity: [0, -g, 0]
masses: [{mass: m1, link: 1, center: midpoint, inertia: {zz: I1}}]
parameters: {known: [l1, g]}
find: [Y, a]
""", "a", [["I1"]])),
)  # fmt: skip


# Slips of what acts beside gravity

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

ACTIONS_SLIPS = (
    Slip("friction_missing", "friction left out", "Friction is left out.",
         "Friction has no potential: it is added to the Euler-Lagrange equation.",
         Example(_DRIVEN, "tau2", _TAU2), omits=True),
    Slip("friction_sign", "the sign of friction", "Friction has the wrong sign.",
         "The motor has to overcome friction: it stands beside g, with the sign of the rate.",
         Example(_DRIVEN, "tau2", _TAU2 + " - fv2*q2_dot - b*(q2_dot-q1_dot)")),
    Slip("coulomb_missing", "Coulomb friction left out", "Coulomb friction is left out.",
         "Besides f_v q̇ there is f_c sgn(q̇).",
         Example(_DRIVEN, "friction", [["fv1*q1_dot - b*(q2_dot-q1_dot)"],
                 ["fv2*q2_dot + b*(q2_dot-q1_dot)"]])),
    Slip("dampers_missing", "dampers left out", "The dampers are left out.",
         "A damper acts on each coordinate that stretches it: b ẋ ∂x/∂q.",
         Example(_DRIVEN, "friction", [["fv1*q1_dot + fc1*sgn(q1_dot)"], ["fv2*q2_dot"]])),
    Slip("springs_missing", "springs left out", "The energy of the springs is left out.",
         "A spring stores energy: it belongs to P.", Example(_DRIVEN, "P", _WEIGHTS), omits=True),
    Slip("spring_sign", "the sign of a spring", "The energy of the springs has the wrong sign.",
         "A spring that is stretched has stored energy, whatever the direction.",
         Example(_DRIVEN, "P", _WEIGHTS + " - k*(q2-q1-delta)^2/2")),
    Slip("spring_half", "the ½ of a spring's energy", "The ½ of the energy of a spring is left out.",
         "½ k x²: its derivative is the force k x.", Example(_DRIVEN, "Ps", "k*(q2-q1-delta)^2")),
    Slip("spring_rest", "where a spring is relaxed", "The stretch is not counted from the spring's rest.",
         "x - rest is squared: at rest there is no energy.", Example(_DRIVEN, "Ps", "k*(q2-q1)^2/2")),
    Slip("spring_rest_sign", "where a spring is relaxed", "The rest of a spring is added, not subtracted.",
         "x - rest is squared: at rest there is no energy.", Example(_DRIVEN, "Ps", "k*(q2-q1+delta)^2/2")),
    Slip("spring_square", "the square of a difference", "x² - rest² stands where (x - rest)² belongs.",
         "Square the stretch as a whole.", Example(_DRIVEN, "Ps", "k*((q2-q1)^2-delta^2)/2")),
    Slip("rotors_missing", "rotors left out", "The kinetic energy of the rotors is left out.",
         "A rotor turns fast: its energy belongs to K.", Example(_DRIVEN, "K", _MASSES), omits=True),
    Slip("carried_spin", "a rotor on a link that turns", "A rotor turns with the link that carries it, too.",
         "Add zᵀω of the link to k_r q̇ before you square.",
         Example(_DRIVEN, "Km", "Im1*kr1^2*q1_dot^2/2 + Im2*kr2^2*q2_dot^2/2")),
    Slip("gear_square", "the square of a gear's ratio", "k_r stands where k_r² belongs.",
         "The rotor turns k_r times as fast, and the speed is squared.",
         Example(_DRIVEN, "Km", "Im1*kr1*q1_dot^2/2"
                 " + Im2*(kr2*q2_dot^2 + 2*kr2*q1_dot*q2_dot + q1_dot^2)/2")),
    Slip("gear_missing", "the ratio of a gear", "The ratios of the gears are left out.",
         "The rotor turns k_r times as fast as its joint.",
         Example(_DRIVEN, "Km", "Im1*q1_dot^2/2 + Im2*(q2_dot + q1_dot)^2/2")),
    Slip("load_sign", "the sign of the forces",
         "The forces from outside have the wrong sign: at rest the joints give g - Q.",
         "Ask who pushes: what acts on the arm is held by the opposite.",
         Example(HELD, "tau_static", [["l1*cos(q1)*F + l2*cos(q1 + q2)*F + M"], ["l2*cos(q1 + q2)*F + M"]])),
    Slip("moments_left_out", "a moment left out", "The moment that acts from outside is left out.",
         "A moment M gives J_ωᵀ M, beside J_vᵀ F of the force.",
         Example(HELD, "Q", [["l1*cos(q1)*F + l2*cos(q1 + q2)*F"], ["l2*cos(q1 + q2)*F"]])),
    Slip("weight_left_out", "the weight left out", "The weight of the arm is left out.",
         "At rest the joints hold the weight too: g - Q.",
         Example("""
gravity: [0, -g, 0]
dh: [{theta: q1*, a: l1}]
masses: [{mass: m1, link: 1}]
forces: [{link: 1, force: [0, F, 0]}]
find: [tau_static]
""", "tau_static", [["-l1*cos(q1)*F"]])),
    Slip("constraint_forces", "the forces of the constraint",
         "The forces of the constraint are not A_cᵀ λ; without them the equation is right.",
         "Beside λ stand the derivatives of its constraint with respect to the coordinates, with one sign "
         "everywhere.",
         Example(_BLADE, "tau", [["m*x_ddot - lambda1*sin(phi)"], ["m*y_ddot - lambda1*cos(phi)"],
                 ["J*phi_ddot"]])),
)  # fmt: skip


# Slips in the transformations, the Jacobians and the rates

KINEMATICS_SLIPS = (
    Slip("joint_columns", "a column of the Jacobian",
         "Body {part}'s Jacobian has a column for a joint after it.",
         "A body is moved only by the joints before it.",
         Example(IN3140, "Jv1", [["0", "cos(theta1)"], ["0", "sin(theta1)"], ["0", "0"]])),
    Slip("prismatic_turns", "a prismatic joint",
         "A prismatic joint was given a column in J_ω.", "A prismatic joint turns nothing: its column is 0.",
         Example(IN3140, "Jw", [["0", "cos(theta1)"], ["0", "sin(theta1)"], ["1", "0"]])),
    Slip("order", "the order of a product", "The matrices are multiplied in the wrong order.",
         "H_i = H_{{i-1}} A_i: each new frame stands on the right.",
         Example(IN3140, "H2", [["-sin(theta1)", "0", "cos(theta1)", "0"],
                 ["cos(theta1)", "0", "sin(theta1)", "0"],
                 ["0", "1", "0", "L1+L2"], ["0", "0", "0", "1"]])),
    Slip("convention", "the convention", "This is what the other Denavit-Hartenberg convention gives.",
         "Standard: Rot_z Trans_z Trans_x Rot_x; modified: Rot_x Trans_x Rot_z Trans_z.",
         Example(IN3140, "A1", [["-sin(theta1)", "-cos(theta1)", "0", "0"], ["0", "0", "-1", "-L1"],
                 ["cos(theta1)", "-sin(theta1)", "0", "0"], ["0", "0", "0", "1"]])),
    Slip("offset", "an offset of the joint variable", "The constant part of the joint angle is left out.",
         "Look at the table: the angle is the variable plus its offset.",
         Example(IN3140, "A1", [["cos(theta1)", "0", "sin(theta1)", "0"],
                 ["sin(theta1)", "0", "-cos(theta1)", "0"],
                 ["0", "1", "0", "L1"], ["0", "0", "0", "1"]])),
    Slip("twist_sign", "the sign of α", "The sign of α is wrong.", "α turns about x, from z to the next z.",
         Example(IN3140, "A1", [["-sin(theta1)", "0", "-cos(theta1)", "0"],
                 ["cos(theta1)", "0", "-sin(theta1)", "0"], ["0", "-1", "0", "L1"], ["0", "0", "0", "1"]])),
    Slip("tool_frame", "the frame of a vector",
         "Your matrix is seen from {part}; it is asked for along the axes of {asked}.",
         "Its columns are vectors: z and o belong in the same frame.",
         Example(PLANAR_2R, "Jv", [["l1*sin(q2)", "0"], ["l1*cos(q2) + l2", "l2"], ["0", "0"]])),
    Slip("transpose_for_inverse", "the transpose for the inverse",
         "The velocity is multiplied by the transpose of the Jacobian, which takes forces to torques.",
         "Solve J q̇ = ṙ for q̇, and put what you find into it.",
         Example(HELD, "qd", [["-l1*sin(q1)*v - l2*sin(q1 + q2)*v"], ["-l2*sin(q1 + q2)*v"]])),
)  # fmt: skip


# Slips in a Denavit-Hartenberg table

TABLES_SLIPS = (
    Slip("dh_cell", "one cell of the table", "Row {part}: {yours} where {other} is needed. {term}",
         "Follow the four motions of this row with the drawing: about z, along z, along x, about x.",
         Example(PLANAR_2R, "DH", [["q1", "0", "l1", "90deg"], ["q2", "0", "l2", "0"]])),
    Slip("dh_exchanged", "two columns", "Row {part}: d and a are exchanged.",
         "d is measured along z, the joint's axis, and a across it, along x.",
         Example(PLANAR_2R, "DH", [["q1", "l1", "0", "0"], ["q2", "0", "l2", "0"]])),
    Slip("dh_joints", "the joint variables", "{yours}.",
         "A revolute joint has its variable in θ, a prismatic one in d, one joint a row.",
         Example(PLANAR_2R, "DH", [["0", "q1", "l1", "0"], ["q2", "0", "l2", "0"]])),
    Slip("dh_mechanism", "several cells of the table",
         "The table describes another mechanism: {part}. More than a few cells are to blame.",
         "Go through the rows with the drawing: about z, along z, along x, about x.",
         Example(PLANAR_2R, "DH", [["q1", "0", "0", "45deg"], ["q2", "l1", "l1", "90deg"]])),
    Slip("dh_convention", "the convention",
         "The table is right in the {other} convention, and asked for in the {part} one.",
         "In Spong's table a row ends with a and α, in Craig's it begins with those of the row before.",
         Example("""
convention: modified
dh: [{theta: q1*}, {theta: q2*, a: l1}, {a: l2}]
""", "DH", [["q1", "0", "l1", "0"], ["q2", "0", "l2", "0"]])),
    Slip("dh_shifted", "the convention",
         "a and α stand one row too {yours}: the rows are those of the {other} convention, and the {part} "
         "one is asked for.",
         "In Spong's table a row ends with a and α, in Craig's it begins with those of the row before.",
         Example("elbow-3r", "DH", [["theta1", "L1", "0", "0"], ["theta2", "0", "0", "90deg"],
                                    ["theta3", "0", "L2", "0"]])),
    Slip("dh_sense", "the sense of a joint",
         "{yours}; here every coordinate has to be counted as it is given.",
         "Choose the direction of each z, and where each joint is at 0, as they are given.",
         Example("""
strict: true
dh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}]
""", "DH", [["q1", "0", "l1", "0"], ["q2 + 90deg", "0", "l2", "0"]])),
)  # fmt: skip
