"""Slips on the way from the energies to D, C and g: a rule of calculus, a part left out, a frame."""

from __future__ import annotations

from dynsolve.answers.diagnosis.slips.record import IN3140, PLANAR_2R, Example, Slip

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
