"""Numbers on the command line: --set, --at, --digits and `values:`, in text, JSON and reports."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from tests.cli.running import dynsolve

pytestmark = pytest.mark.slow

SET = ("--set", "L1=0.4,m1=2", "--set", "m2=1,I1zz=0.05", "--set", "g=9.81")
AT = ("--at", "theta1=30deg,L2=0.2,theta1_dot=0.5,L2_dot=0.1")


def solved(*words: str) -> str:
    ran = dynsolve("solve", "in3140-rp", *words)
    assert ran.code == 0 and not ran.err, ran.err
    return ran.out


def test_results_with_values_stand_beside_the_symbolic_ones() -> None:
    out = solved(*SET)
    assert "    τ₁ = (m₂ L₂² + I_1zz) θ̈₁ + 2m₂ L₂ θ̇₁ L̇₂\n" in out
    assert "    τ₁ = (0.05 + L₂²) θ̈₁ + 2L₂ θ̇₁ L̇₂ in N m\n" in out
    assert "    f₂ = L̈₂ - L₂ θ̇₁² in N\n" in out
    assert "𝒫" not in out.partition("With numbers")[2]  # it is not asked for
    assert "    I_1zz    0.05    kg m²\n" in out


def test_a_state_shows_every_stage() -> None:
    out = solved(*SET, *AT).partition("At a state")[2]
    assert "L̈₂ are 0." in out and "θ̈₁" in out
    for line in (
        "    K_v2 = 0.01 J",  # (L2² θ̇1² + L̇2²)/2 = (0.01 + 0.01)/2
        "    K_ω1 = 0.00625 J",  # 0.05·0.5²/2
        "    𝒦 = 0.01625 J",
        "    ℒ ≈ -7.832 J",  # -7.83175
        "    ∂ℒ/∂θ̇₁ = 0.045 kg m²/s",  # (0.05 + 0.2²)·0.5
        "    τ₁ = 0.02 N m",  # 2·0.2·0.5·0.1
        "    f₂ = -0.05 N",  # -0.2·0.5²
    ):
        assert line + "\n" in out, line


def test_without_decimals_a_state_is_exact() -> None:
    out = solved("--at", "theta1=30deg,L2=1/5", "--stage", "kinematics")
    assert "√3/10" in out and "L₁" in out
    assert "Parameters without a value stay symbols: L₁, m₁, I_1zz, m₂, g." in out
    assert "0.1732" in solved("--at", "theta1=30deg,L2=1/5", "--stage", "kinematics", "--digits", "4")


@pytest.mark.parametrize(("digits", "shown"), [("2", "0.17\n"), ("6", "0.173205\n")])
def test_digits(digits: str, shown: str) -> None:
    out = solved("--at", "theta1=60deg,L2=0.2,L2_dot=0.2", "--stage", "energy", "--digits", digits)
    assert shown.strip() in out


@pytest.mark.parametrize(
    ("digits", "shown"),
    [  # m_p l₁ l₂ + … = 5177/6000 kg m² and 0.167 kg m² (problems/numeric-2r.yaml)
        ((), "⎡0.862833 + 0.48 c₂  0.167 + 0.24 c₂⎤"),
        (("--digits", "2"), "⎡0.86 + 0.48 c₂  0.17 + 0.24 c₂⎤"),
        (("--digits", "4"), "⎡0.8628 + 0.48 c₂  0.167 + 0.24 c₂⎤"),
    ],
)
def test_digits_of_a_model_in_numbers(digits: tuple[str, ...], shown: str) -> None:
    out = dynsolve("solve", "numeric-2r", "--stage", "vectorized", *digits).out
    said = " ".join(out.split())
    assert shown in out
    assert f"One with more than {digits[1] if digits else 6} significant digits is rounded" in said
    assert "A unit stands behind a result that is a number other than 0, and behind some matrices" in said


@pytest.mark.parametrize(
    ("stage", "digits", "rounds"),
    [("vectorized", "6", True), ("vectorized", "9", True), ("jacobian", "6", False)],
)
def test_that_numbers_are_rounded_is_said_where_one_is(stage: str, digits: str, rounds: bool) -> None:
    out = dynsolve("solve", "numeric-2r", "--stage", stage, "--digits", digits).out
    told = " ".join(out.split()).count("significant digits is rounded")
    assert told == rounds and (out.replace("≈ marks that", "").count("≈") > 0) == rounds


def test_stages_choose_numbers_too() -> None:
    out = solved(*SET, "--stage", "lagrangian")
    assert "ℒ = 0.5 ((0.05 + L₂²) θ̇₁² + L̇₂²) - 7.848 in J" in out and "τ₁" not in out


def test_json_has_sections_of_its_own() -> None:
    plain = json.loads(solved("--json"))
    assert not {"values", "at", "units"} & plain.keys()
    full = json.loads(solved(*SET, *AT, "--json"))
    assert {name: full[name] for name in plain} == plain
    assert full["values"]["given"]["L1"] == {"value": "0.4", "unit": "m"}
    assert full["values"]["results"]["P"] == "7.848"
    assert full["values"]["results"]["D"] == [["0.05 + L2**2", "0"], ["0", "1"]]
    assert full["at"]["given"]["theta1_dot"] == {"value": "0.5", "unit": "rad/s"}
    assert full["at"]["results"]["tau"] == ["0.02", "-0.05"]
    assert full["at"]["results"]["H"][1][0][3] == "0.173205080756888"
    assert full["at"]["results"].keys() == plain["results"].keys()
    assert full["units"]["tau"] == ["N m", "N"] and full["units"]["D"][0] == ["kg m^2", "kg m"]


def test_exact_states_are_exact_in_json() -> None:
    found = json.loads(solved("--json", "--at", "theta1=30deg,L2=1/5"))["at"]["results"]
    assert found["H"][1][0][3] == "sqrt(3)/10"


def test_values_of_a_file_count_where_they_are_complete(tmp_path: Path) -> None:
    text = "dh: [{theta: q1*, a: l1}]\nmasses: [{mass: m1, link: 1}]\n"
    text += "values: {l1: 500, m1: 2VALUES}\nunits: {l1: mm}\n"
    whole, partial = tmp_path / "whole.yaml", tmp_path / "partial.yaml"
    whole.write_text(text.replace("VALUES", ", g: 10"))
    partial.write_text(text.replace("VALUES", ""))
    out = dynsolve("solve", str(whole)).out
    assert "𝐃 = [½] kg m²\n" in out or "𝐃 = [0.5] kg m²\n" in out
    assert "With numbers" not in dynsolve("solve", str(partial)).out
    rest = dynsolve("solve", str(partial), "--set", "m1=4").out
    assert "Without a value, and so still a symbol: g." in rest


def test_reports_carry_the_numbers(tmp_path: Path) -> None:
    for form, shown in {"--latex": r"\text{N m}", "--html": "N\u00a0m", "--markdown": "With numbers"}.items():
        assert shown in solved(form, *SET, *AT)


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("--at", "theta1=30,L2=0.2"), "--at:8: the bare number 30 stands as an angle"),
        (("--at", "theta1=30deg"), "--at: the state lacks L2"),
        (("--set", "L3=1"), "did you mean `L1`?"),
        (("--digits", "3"), "--digits needs numbers"),
        (("--digits", "0", *SET), "is not in the range 1<=x<=15"),
    ],
)
def test_mistakes_are_said_with_their_remedy(words: tuple[str, ...], said: str) -> None:
    ran = dynsolve("solve", "in3140-rp", *words)
    assert ran.code == 2 and not ran.out and said in " ".join(ran.err.split()) and "Traceback" not in ran.err


def test_a_value_of_the_file_that_is_no_angle_has_its_place(tmp_path: Path) -> None:
    file = tmp_path / "p.yaml"
    file.write_text(
        "dh: [{theta: q1*, a: l1, alpha: beta}]\nmasses: [{mass: m1, link: 1}]\nvalues: {beta: 30}\n"
    )
    ran = dynsolve("solve", str(file), "--set", "m1=1")
    assert ran.code == 2 and ":3:16: the bare number 30 stands as an angle" in ran.err


def test_without_masses_gravity_is_not_asked_for() -> None:
    text = "dh: [{theta: q1*, a: l1}]\nvalues: {l1: 2}"
    out = dynsolve("solve", "-", "--at", "q1=45deg", stdin=text).out
    assert "With numbers" in out and "√2" in out and "still a symbol" not in out and "torques" not in out
    assert "All velocities and accelerations are 0." in out


def test_numbers_for_every_parameter_at_a_state_leave_nothing_in_the_ring() -> None:
    values = "l1=1,l2=1,lc1=1/2,lc2=1/2,m1=1,m2=1,I1=1,I2=1,g=10"
    ran = dynsolve("solve", "planar-2r", "--set", values, "--at", "q1=0,q2=0,q1_dot=1,q2_dot=1", "--json")
    assert not ran.err
    at = json.loads(ran.out)["at"]["results"]
    assert at["K"] == "37/8"  # no decimal goes in: ½ (d₁₁ + 2d₁₂ + d₂₂) = ½ (4.5 + 3.5 + 1.25)


def test_where_a_denominator_is_0_one_result_is_left_out_and_not_all(tmp_path: Path) -> None:
    file = tmp_path / "arm.yaml"
    file.write_text(
        "dh: [{theta: q1*, a: l1}, {theta: q2*, a: l2}]\nvelocity: [v, 0]\nfind: [qd, Jr]\n", encoding="utf-8"
    )
    ran = dynsolve("solve", str(file), "--at", "q1=0,q2=0", "--json")
    at = json.loads(ran.out)["at"]["results"]
    assert at["qd"] == {"skipped": "a denominator is 0 at this state"}
    assert at["Jr"] == [["0", "0"], ["l1 + l2", "l2"]]
    assert "𝐪̇ = (a denominator is 0 at this state)" in dynsolve("solve", str(file), "--at", "q1=0,q2=0").out


def test_values_beside_numbers_have_the_digits_of_the_page(tmp_path: Path) -> None:
    """m g l = 2 · 9.80665 · 0.7 = 13.72931 N m."""
    arm = "gravity: [0, -g, 0]\ndh: [{theta: q1*, a: 0.7}]\nmasses: [{mass: 2, link: 1}]\n"
    place = tmp_path / "pendulum.yaml"
    place.write_text(arm + "values: {g: 9.80665}\n")
    out = dynsolve("solve", str(place)).out
    assert "6 significant digits" in out and "13.7293 c₁ in N m" in out
    assert "13.73 c₁ in N m" in dynsolve("solve", str(place), "--digits", "4").out
