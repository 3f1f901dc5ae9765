"""The problem file that `dynsolve new` writes: valid as it stands, with comments on what else there is."""

from __future__ import annotations

TEMPLATE = """\
title: RP manipulator
source: my course, exercise 1            # free text, shown in the solution

# standard (Spong) or modified (Craig); in a modified table a and alpha of row i are a_{i-1}, alpha_{i-1}
convention: standard

# The acceleration of gravity in base-frame coordinates. An arm in a vertical x-y plane: [0, -g, 0].
gravity: [0, 0, -g]

# The Denavit-Hartenberg table, a row a frame. The star marks the joint variable: in theta the joint
# is revolute, in d prismatic; a row without a star is a fixed frame. Angles: 90deg, pi/2, beta.
dh:
  - {theta: theta1* + 90deg, d: L1,  a: 0, alpha: 90deg}
  - {theta: 0,               d: L2*, a: 0, alpha: 0}

# Every body that has mass; a link without one is massless.
#   link     the row of the table that it moves with
#   center   tip, origin, midpoint, {along: 1/3}, {near: [lc1, 0, 0]} or [x, y, z] in the frame of its link
#   inertia  {xx: .., yy: .., zz: .., xy: .., xz: .., yz: ..} or a 3x3 list; without it:
#   shape    point, or {rod: {length: l1}}, {cylinder: {radius: r, length: l1}}, {box: {x: a, y: b, z: c}},
#            {hollow_cylinder: {outer: ro, inner: ri, length: l1}}, {disk: {radius: r}},
#            {sphere: {radius: r}}, {shell: {radius: r}}
#   axes     of the body-attached frame: those of the link's frame (default), Rx(30deg) relative to it, base
#            (parallel to frame 0 at q = 0), or {base: Rz(theta1)}
masses:
  - {mass: m1, link: 1, center: midpoint, inertia: {zz: I1zz}, axes: {base: Rz(theta1)}}
  - {mass: m2, link: 2, shape: point, center: tip}

# What the exercise asks for, and the points for it.
find: [tau, D, C, g]
# marks: {P: 2, K: 4, tau: 6}

# Numbers for numeric results and plots.
# values: {L1: 0.4, m1: 2, m2: 1, I1zz: 0.05, g: 9.81}
# units: {L1: m, m1: kg, m2: kg, I1zz: kg m^2}
"""
"""A commented, valid example: the manipulator of the README."""
