"""Slips of what acts beside gravity: friction, springs, rotors, forces from outside and of constraints."""

from __future__ import annotations

from dynsolve.answers.diagnosis.slips.record import HELD, Example, Slip

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

SLIPS = (
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
