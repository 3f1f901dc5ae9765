"""What students call an answer, and what stands before it: T_2, E_pot, (4.7) g_2; the value decides."""

from __future__ import annotations

import pytest

from tests.unit.answers.hands import checker, verdicts
from tests.unit.answers.reading.submissions import report

TORQUE = (
    r"(m_2l_{c2}^2+I_2)(\ddot q_1+\ddot q_2)+m_2l_1l_{c2}(\cos q_2\ddot q_1+\sin q_2\dot q_1^2)"
    r"+m_2gl_{c2}\cos(q_1+q_2)"
)
FORCES = (
    "T_2 M_2 \\Gamma_2 N_2 u_2 Q_2 F_2 U_2 V_2 W_2 T_{q_2} M_{q_2} \\tau_{\\theta_2} E_2 \\mu_2 "
    "T_2(t) M_{m,2} \\tau_{m2} M_{\\mathrm{Motor},2}"
).split()
WEIGHT = r"m_2gl_{c2}\cos(q_1+q_2)"
POTENTIAL = r"m_1gl_{c1}\sin q_1+m_2g(l_1\sin q_1+l_{c2}\sin(q_1+q_2))"


def judged(text: str, file: str = "report.md") -> dict[str, str]:
    return verdicts(checker("planar-2r")(report(text, file)))


@pytest.mark.parametrize("name", FORCES)
@pytest.mark.parametrize("chain", ["{name} = {value}", "{value} = {name}"])
def test_what_holds_accelerations_is_a_torque(name: str, chain: str) -> None:
    right = judged(f"$${chain.format(name=name, value=TORQUE)}$$")
    wrong = judged(f"$${chain.format(name=name, value=TORQUE.replace('+I_2', '-I_2'))}$$")
    assert (right["tau2"], wrong["tau2"]) == ("correct", "wrong")


def test_energies_keep_their_names() -> None:
    assert judged(r"$$T_1=\frac12(m_1l_{c1}^2+I_1)\dot q_1^2$$ $$P_1=m_1gl_{c1}\ddot q_1$$").items() >= {
        ("K1", "correct"), ("P1", "wrong")
    }  # fmt: skip


def test_an_abbreviation_beside_the_torque_is_none() -> None:
    parts = r"$$X_2=(m_2l_{c2}^2+I_2)(\ddot q_1+\ddot q_2)$$ $$N_2=m_2l_1l_{c2}\cos q_2\,\ddot q_1$$"
    rest = r"m_2l_1l_{c2}\sin q_2\dot q_1^2+m_2gl_{c2}\cos(q_1+q_2)"
    assert judged(rf"{parts} $$\tau_2=X_2+N_2+{rest}$$")["tau2"] == "correct"


@pytest.mark.parametrize(
    "name",
    r"W_{pot} W_p E_\text{pot} V_{ges} U_{tot} E_{\mathrm{potentiell}} E_{pot,ges} U".split(),
)
def test_what_the_potential_energy_is_called(name: str) -> None:
    right, wrong = judged(f"$${name}={POTENTIAL}$$"), judged(f"$${name}={POTENTIAL.replace('sin', 'cos')}$$")
    assert (right["P"], wrong["P"]) == ("correct", "wrong")


LEADS = ["(1) ", "(4.7) ", "a) ", "(1a) ", "1.2) ", "1.2 ", "ii) ", "- (3) ", "(A.3) ", "(1)", "Aufgabe 1a) "]


@pytest.mark.parametrize("lead", LEADS)
def test_a_number_stands_before_a_line(lead: str) -> None:
    assert judged(f"{lead}g2 = m2*g*lc2*cos(q1+q2)\n{lead}d22 = I2\n", "report.txt").items() >= {
        ("g2", "correct"), ("d22", "wrong")
    }  # fmt: skip


@pytest.mark.parametrize("lead", [r"(1)\ ", r"1)\ ", r"a)\; ", r"(4.7)\quad ", r"\text{a)}\ "])
def test_a_number_stands_before_a_display(lead: str) -> None:
    assert judged(f"$${lead}g_2 = {WEIGHT}$$")["g2"] == "correct"


LEVELS = [
    # what is added to the potential energy, and whether it may be
    *(
        (level, "correct")
        for level in ("(m_1+m_2)gh_0", "(m_1+m_2)gH", "gh_{ref}(m_1+m_2)", "-(m_1+m_2)gz_0")
    ),
    *((level, "correct") for level in ("P_0", "V_0", "E_{p,0}", "C", r"\text{const.}", r"\mathrm{konst}")),
    *((level, "wrong") for level in ("m_2gh_0", "h_0", "P_0^2", "m_1P_0", "P_0l_1", "m_1gl_1", "5")),
]


@pytest.mark.parametrize(("level", "verdict"), LEVELS)
def test_the_zero_of_height_under_any_name(level: str, verdict: str) -> None:
    assert judged(f"$$P = {POTENTIAL} + {level}$$")["P"] == verdict


@pytest.mark.parametrize(
    "entries",
    [
        "M[0,0] = I1 + I2 + m1*lc1**2 + m2*(l1**2 + lc2**2 + 2*l1*lc2*cos(q[1]))\nM[1, 1] = {0}\n",
        "M[0][0] = I1 + I2 + m1*lc1**2 + m2*(l1**2 + lc2**2 + 2*l1*lc2*cos(q2))\nM[1][1] = {0}\n",
        "M[2,2] = {0}\nM[1,1] = I[1] + I[2] + m[1]*lc1^2 + m2*(l[1]^2 + lc2^2 + 2*l1*lc2*cos(q[2]))\n",
    ],
)
def test_indices_from_0_and_from_1(entries: str) -> None:
    right = judged(entries.format("I2 + m2*lc2^2"), "report.txt")
    wrong = judged(entries.format("I2 + m1*lc2^2"), "report.txt")
    assert (right["d11"], right["d22"], wrong["d22"]) == ("correct", "correct", "wrong")


@pytest.mark.parametrize("name", [r"\hat I_2", r"\tilde{I}_2", r"\overline{I}_2", "I_2^*", "I_2'"])
def test_a_parameter_under_a_mark_is_another_name(name: str) -> None:
    assert judged(f"$${name} = I_2 + m_2l_{{c2}}^2$$ $$d_{{22}} = {name}$$")["d22"] == "correct"


def test_blanks_beside_a_diagonal_are_zeros() -> None:
    given = verdicts(
        checker("in3140-rp")(
            report(r"$$D=\begin{bmatrix} I_{1zz}+m_2L_2^2 & \\ & m_2\end{bmatrix}$$", stem="in3140-rp")
        )
    )
    missed = judged(r"$$D = \begin{bmatrix} I_2 & m_2l_{c2}^2 \\ & I_2 \end{bmatrix}$$")
    assert (given["D"], missed["d21"], missed["d22"]) == ("correct", "unreadable", "wrong")
