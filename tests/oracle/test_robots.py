"""Robots against Pinocchio: published, special and random ones, and their rates."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, note, settings

from tests.oracle.comparison import assert_agrees, random_state
from tests.oracle.pinocchio_arm import jacobians
from tests.oracle.reading import load, read
from tests.robots import robots
from tests.support import ACTING, LIBRARY, TEXTBOOKS, assert_close, numbers, problem_file, solve_json

# -- every robot of the library and of the textbooks against Pinocchio -------------------------------


PLAIN = [path for path in LIBRARY if path.stem not in ACTING]
"""What Pinocchio has no joints for, rotors and springs, is held in `test_rotors` and by power."""


@pytest.mark.slow
@pytest.mark.parametrize("path", PLAIN + TEXTBOOKS, ids=lambda path: path.stem)
def test_a_published_robot_agrees_with_pinocchio(path: Path) -> None:
    assert_agrees(load(path), solve_json(path))


# -- what random robots do not reach, each case one feature of the problem file, against Pinocchio ---


CASES = {
    "axes given from the base, turning with the link": """
dh:
  - {theta: theta1* + 90deg, d: L1, a: 0, alpha: 90deg}
  - {theta: theta2*, d: 0, a: L2, alpha: 0}
masses:
  - {mass: m1, link: 1, center: midpoint, inertia: {xx: Ix, yy: Iy, zz: Iz}, axes: {base: Rz(theta1)}}
  - {mass: m2, link: 2, center: midpoint, inertia: {yy: I2, zz: I2}}
""",
    "a given R that does not turn, about an axis of symmetry": """
dh:
  - {theta: theta1*, d: 0, a: l1, alpha: 0}
masses:
  - {mass: m1, link: 1, center: tip, inertia: {zz: I1}, axes: {base: [[1, 0, 0], [0, 1, 0], [0, 0, 1]]}}
""",
    "coordinates in another order": """
coordinates: [p2, p1]
gravity: [0, -g, 0]
dh:
  - {theta: p1*, d: 0, a: l1, alpha: 0}
  - {theta: p2* - p1*, d: 0, a: l2, alpha: 0}
masses:
  - {mass: m1, link: 1, center: {near: [lc1, 0, 0]}, inertia: {zz: I1}}
  - {mass: m2, link: 2, center: {near: [lc2, 0, 0]}, inertia: {zz: I2}}
""",
    "a base given as a list, and moved": """
base: {rotate: [[0, 0, 1], [1, 0, 0], [0, 1, 0]], move: [0, b, h]}
dh:
  - {theta: q1*, d: 0, a: l1, alpha: 90deg}
  - {theta: q2*, d: 0, a: l2, alpha: 0}
masses:
  - {mass: m1, link: 1}
  - {mass: m2, link: 2, center: midpoint, inertia: {xx: I2, zz: 2*I2}, axes: base}
""",
    "angles of 10 and 20 degrees": """
dh:
  - {theta: q1* + 20deg, d: 0, a: l1, alpha: 10deg}
  - {theta: q2* - 10deg, d: 0, a: l2, alpha: 60deg}
masses:
  - {mass: m1, link: 1}
  - {mass: m2, link: 2, center: tip, inertia: {xx: I2}, axes: Ry(30deg)}
""",
    "angles of 18, 36 and 22.5 degrees": """
dh:
  - {theta: q1* + 18deg, d: 0, a: l1, alpha: 36deg}
  - {theta: q2* + 22.5deg, d: 0, a: l2, alpha: -90°}
masses:
  - {mass: m2, link: 2, center: tip, inertia: {xx: I2, yy: I3, zz: I4}}
""",
    "symbolic angles with offsets and multiples": """
dh:
  - {theta: q1* + beta, d: 0, a: l1, alpha: beta + 30deg}
  - {theta: q2* - 2*beta, d: h, a: l2, alpha: gamma/2}
  - {theta: gamma, d: d3* + h, a: 0, alpha: 0}
masses:
  - {mass: m1, link: 1}
  - {mass: m2, link: 2, center: midpoint, inertia: {xx: I2}, axes: Rx(beta)}
  - {mass: m3, link: 3}
""",
    "roots, fractions and functions of constant angles": """
gravity: [0, -g*cos(phi), -g*sin(phi)]
dh:
  - {theta: q1*, d: h/2, a: sqrt(l1^2 + h^2), alpha: 45deg}
  - {theta: q2*, d: l2/(1 + k), a: l2*tan(phi), alpha: 0}
masses:
  - {mass: (m1 + m2)/2, link: 1, inertia: {zz: m1*l1**2/12}, center: {along: l1/(l1 + l2)}}
  - {mass: m2*(1 + 1e-3), link: 2, center: [-sqrt(3)/2*l2, 0, 0.25]}
""",
    "names that mean something elsewhere": """
dh:
  - {theta: q1*, d: L, a: A, alpha: lambda}
  - {theta: q2*, d: K, a: E, alpha: S}
masses:
  - {mass: C, link: 1}
  - {mass: D, link: 2, center: tip, inertia: {zz: N, yy: Q}}
""",
    "Greek letters and degree signs": """
dh:
  - {theta: θ1* + 45°, d: 0, a: l1, alpha: 30°}
  - {theta: θ2*, d: 0, a: l2, alpha: β}
masses:
  - {mass: m1, link: 1}
  - {mass: m2, link: 2}
""",
    "two coordinates in one row, and gears": """
dh:
  - {theta: q1* + q2*, d: 0, a: l1, alpha: 90deg}
  - {theta: 2*q2* - q1*/3, d: 0, a: l2, alpha: 0}
  - {theta: 0, d: d3*/2 + h, a: 0, alpha: 0}
masses:
  - {mass: m1, link: 1}
  - {mass: m2, link: 2, center: tip, inertia: {yy: I2, zz: I3}}
  - {mass: m3, link: 3}
""",
    "an inertia without a mass": """
dh:
  - {theta: q1*, d: 0, a: l1, alpha: 90deg}
  - {theta: q2*, d: 0, a: l2, alpha: 0}
masses:
  - {name: r, mass: 0, link: 2, center: origin, inertia: {xx: Ir, yy: 2*Ir, zz: Ir}}
  - {name: p, mass: m, link: 2}
""",
    "shapes that lie along their links, standard": """
dh:
  - {theta: q1*, d: h, a: 0, alpha: 90deg}
  - {theta: q2*, d: 0, a: l2, alpha: -90deg}
  - {theta: q3*, d: 0, a: l3, alpha: 0}
masses:
  - {mass: m1, link: 1, center: midpoint, shape: {hollow_cylinder: {outer: R, inner: r, length: h}}}
  - {mass: m2, link: 2, center: {along: 2/5}, shape: {rod: {length: l2}}, axes: Rz(90deg)}
  - {mass: m3, link: 3, center: midpoint, shape: {cylinder: {radius: r, length: l3}}, axes: base}
  - {mass: m4, link: 3, center: tip, shape: {disk: {radius: r}}}
""",
    "shapes that lie along their links, modified": """
convention: modified
dh:
  - {theta: q1*, d: 0, a: 0, alpha: 0}
  - {theta: q2*, d: 0, a: l1, alpha: 90deg}
  - {theta: 0, d: 0, a: l2, alpha: 0}
masses:
  - {mass: m1, link: 1, center: midpoint, shape: {rod: {length: l1}}}
  - {mass: m2, link: 2, center: {along: 1/4}, shape: {cylinder: {radius: r, length: l2}}}
  - {mass: m3, link: 2, shape: point}
""",
    "tensors about the joint and about the origin": """
dh:
  - {theta: q1*, d: h, a: l1, alpha: 90deg}
  - {theta: q2*, d: 0, a: l2, alpha: 30deg}
masses:
  - {mass: m1, link: 1, center: [x1, y1, z1], inertia: {xx: 3, yy: 4, xz: -1}, about: origin, axes: Rx(45deg)}
  - {mass: m2, link: 2, center: {near: [lc2, 0, 0]}, inertia: {yy: I2, zz: I2}, about: joint}
""",
    "bodies on the ground and on fixed rows": """
dh:
  - {theta: 90deg, d: h0, a: 0, alpha: 90deg}
  - {theta: q1*, d: 0, a: l1, alpha: 0}
  - {theta: 30deg, d: 0, a: l2, alpha: 90deg}
  - {theta: 0, d: q2*, a: 0, alpha: 0}
  - {theta: 0, d: 0, a: l3, alpha: 0}
masses:
  - {name: b, mass: mb, link: 1, center: midpoint, inertia: {xx: Ib}}
  - {mass: m1, link: 2, center: midpoint}
  - {mass: m2, link: 3, center: {near: [0, h, 0]}, inertia: {zz: I2}}
  - {mass: m3, link: 5}
""",
    "gravity none": """
gravity: none
dh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}]
masses: [{mass: m1, link: 1}, {mass: m2, link: 2}]
""",
    "gravity upwards, and in every direction": """
gravity: [gx, -2*gy, 9.81]
dh: [{theta: q1*, a: l1, alpha: 90deg}, {theta: q2*, a: l2}]
masses: [{mass: m1, link: 1}, {mass: m2, link: 2}]
""",
    "a prismatic joint first, modified": """
convention: modified
dh:
  - {d: d1*, alpha: -90deg, a: b}
  - {theta: theta2* - 90deg, alpha: 90deg}
  - {a: l2}
masses:
  - {mass: m1, link: 1, center: origin, inertia: {xx: I1}}
  - {mass: m2, link: 2, center: tip, inertia: {xx: I2, xy: I12, yy: I2, zz: I2}}
""",
    "a double pendulum that swings about x, its base turned": """
base: Rz(90deg) Rx(90deg)
dh: [{theta: q1* - 90deg, a: 1}, {theta: q2*, a: 0.5}]
masses:
  - {mass: 2, link: 1, center: midpoint, shape: {box: {x: 1, y: 0.1, z: 1/20}}}
  - {mass: 1.5, link: 2, center: midpoint, shape: {box: {x: 0.5, y: 0.1, z: 1/20}}}
""",
    "seven joints and many numbers": """
dh:
  - {theta: q1*, d: 0.34, a: 0, alpha: -90deg}
  - {theta: q2*, d: 0, a: 0, alpha: 90deg}
  - {theta: q3*, d: 0.4, a: 0, alpha: 90deg}
  - {theta: q4*, d: 0, a: 0, alpha: -90deg}
  - {theta: q5*, d: 0.4, a: 0, alpha: -90deg}
  - {theta: q6*, d: 0, a: 0, alpha: 90deg}
  - {theta: q7*, d: 0.126, a: 0, alpha: 0}
masses:
  - {mass: 3.45, link: 1, center: [0, -0.03, 0.12], inertia: {xx: 0.02, yy: 0.018, zz: 0.01}}
  - {mass: 3.48, link: 2, center: [0, 0.06, 0.03], inertia: {xx: 0.022, yy: 0.01, zz: 0.02}}
  - {mass: 4.05, link: 3, center: [0, 0.03, 0.13], inertia: {xx: 0.03, yy: 0.03, zz: 0.01, yz: -0.004}}
  - {mass: 3.48, link: 4, center: [0, 0.067, 0.034], inertia: {xx: 0.03, yy: 0.01, zz: 0.03}}
  - {mass: 2.16, link: 5, center: [0, 0.021, 0.14], inertia: {xx: 0.02, yy: 0.018, zz: 0.006}}
  - {mass: 2.35, link: 6, center: [0, 0.0006, 0.0004], inertia: {xx: 0.003, yy: 0.004, zz: 0.003}}
  - {mass: mp, link: 7, center: tip}
""",
}


@pytest.mark.slow
@pytest.mark.parametrize("name", CASES)
def test_a_special_robot_agrees_with_pinocchio(name: str) -> None:
    text = f"title: {name}\n{CASES[name].strip()}\n"
    assert_agrees(load(text), solve_json(text))


# -- robots that nobody chose, against Pinocchio -----------------------------------------------------


@pytest.mark.slow
@settings(max_examples=80)
@given(text=robots())
def test_random_robots_agree_with_pinocchio(text: str) -> None:
    note(text)
    assert_agrees(load(text), solve_json(text), states=2)


# -- jacobians and their time derivatives against Pinocchio, of every kind of table ------------------


ROBOTS = ("planar-2r-remote", "scara-rrpr", "spherical-rrp", "elbow-3r", "craig-6-5-rp")


@pytest.mark.parametrize("name", ROBOTS)
def test_j_and_its_rate(name: str) -> None:
    text = re.sub(
        r"^(find|marks):.*$", "", problem_file(name).read_text(encoding="utf-8"), flags=re.MULTILINE
    )
    results = solve_json(text + "\nfind: [J_dot, r, Jr, Jr_dot]\n")["results"]
    problem = load(text)
    for seed in range(3):
        values, q, qd, _ = random_state(problem, seed)
        J, J_dot = jacobians(read(problem, values), q, qd)
        ours = np.vstack([numbers(results["Jv"], values), numbers(results["Jw"], values)])
        assert_close(ours, J, "J")
        assert_close(numbers(results["J_dot"], values), J_dot, "J_dot")
        rows = [i for i in range(3) if any(entry != "0" for entry in results["Jv"][i])]
        assert_close(numbers(results["Jr"], values), J[rows], "J_r")
        assert_close(numbers(results["Jr_dot"], values), J_dot[rows], "J_r dot")
