"""What the recursions of Newton and Euler are called in reports: frames before a name, unit vectors."""

from __future__ import annotations

import pytest

from dynsolve.answers.reading.files import read_submission
from dynsolve.answers.verdict import Submission
from dynsolve.notation.unicode import to_unicode
from dynsolve.problem import read_problem

ARM = read_problem("""
gravity: [0, -g, 0]
dh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}]
masses:
  - {mass: m1, link: 1, center: {near: [lc1, 0, 0]}, inertia: {zz: I1}}
  - {mass: m2, link: 2, center: {near: [lc2, 0, 0]}, inertia: {zz: I2}}
find: [wl1, wdl1, al1, acl1, fl2, nl2, tau]
""")
COLUMN = r"\begin{bmatrix} 0 \\ 0 \\ \dot q_1 \end{bmatrix}"


def report(text: str) -> Submission:
    return read_submission(ARM, f"$${text}$$", "report.md")


@pytest.mark.parametrize(("name", "expected"), [
    (r"{}^1\omega_1", "wl1"),
    (r"^1\omega_1", "wl1"),
    (r"\omega_1^{(1)}", "wl1"),
    (r"\omega_1", "wl1"),
    (r"{}^{2}\dot\omega_{2}", "wdl2"),
    (r"\alpha_1", "wdl1"),
    (r"{}^1\dot v_1", "al1"),
    (r"a_{e,1}", "al1"),
    (r"{}^1\dot v_{C_1}", "acl1"),
    (r"a_{c,2}", "acl2"),
    (r"{}^2f_2", "fl2"),
    (r"f_2", "fl2"),
    (r"{}^2 n_2", "nl2"),
    (r"\mu_2", "nl2"),
])  # fmt: skip
def test_names_of_vectors_in_the_frames_of_links(name: str, expected: str) -> None:
    assert [answer.name for answer in report(f"{name} = {COLUMN}").answers] == [expected]


@pytest.mark.parametrize("name", [r"{}^1F_1", "F_1", r"{}^1N_1"])
def test_inertia_forces_of_links_are_no_answers(name: str) -> None:
    assert report(f"{name} = {COLUMN}").answers == ()


def test_unit_vectors_are_letters() -> None:
    (answer,) = report(r"a_{e,1} = -l_1 \dot q_1^2\,\mathbf{i} + l_1 \ddot q_1\, j").answers
    assert answer.node is not None
    assert to_unicode(answer.node) == "[[-l₁ q̇₁²], [l₁ q̈₁], [0]]"


def test_a_scalar_is_the_force_of_its_coordinate() -> None:
    assert [answer.name for answer in report(r"f_2 = m_2 g").answers] == ["tau2"]


@pytest.mark.parametrize("name", [r"{}^1\dot\omega_2", r"{}^1n_2"])
def test_a_vector_in_another_frame_is_none_of_the_recursions(name: str) -> None:
    assert report(f"{name} = {COLUMN}").answers == ()
