"""`solve --abbreviate`: long models in names, in every form that a person reads."""

from __future__ import annotations

import json
import math
from pathlib import Path

import pytest

from dynsolve.solution.reports import Format, report
from tests.cli.running import dynsolve, dynsolve_afresh
from tests.support import solved

pytestmark = pytest.mark.slow


def page(form: Format, abbreviate: str = "auto") -> str:
    """What a person reads of the model of a long arm."""
    return report(solved("stanford-6"), form, stages=["vectorized"], abbreviate=abbreviate).decode()


def test_a_long_model_is_written_in_names() -> None:
    ran = dynsolve("solve", "puma560")
    assert ran.code == 0
    lines = ran.out.splitlines()
    assert len(lines) < 1500
    assert "Abbreviations" in lines
    assert any(line.strip().startswith("κ₁ = ") for line in lines)
    assert "Verified" in ran.out


def test_never_writes_everything_out() -> None:
    shown = page(Format.TEXT, abbreviate="never")
    assert "Abbreviations" not in shown
    assert "κ" not in shown


def test_always_names_what_recurs_in_a_short_model() -> None:
    ran = dynsolve(
        "solve", "planar-2r", "--abbreviate", "always", "--stage", "vectorized", "--detail", "full"
    )
    assert "    h = -m₂ l₁ l_c2 s₂" in ran.out.splitlines()
    assert "    𝐂 𝐪̇ = ⎡h (2q̇₁ q̇₂ + q̇₂²)⎤" in ran.out
    assert "m₂ l₁ l_c2 s₂ q̇" not in ran.out
    assert "c₁₁₂ = -½ ∂d₁₁/∂q₂ = -h" in ran.out
    assert "Abbreviations" not in dynsolve("solve", "planar-2r").out


def test_a_robot_without_masses_has_nothing_to_name(tmp_path: Path) -> None:
    file = tmp_path / "arm.yaml"
    file.write_text("title: arm\ndh:\n  - {theta: q1*, a: l1}\n")
    assert dynsolve("solve", str(file), "--abbreviate", "always").code == 0


@pytest.mark.parametrize("form", [Format.LATEX, Format.HTML, Format.MARKDOWN])
def test_every_form_has_them(form: Format) -> None:
    shown = page(form)
    assert "Abbreviations" in shown
    assert ("\\kappa_{1} " in shown or "\\kappa_1 " in shown) if form is not Format.HTML else "κ" in shown


def test_json_carries_everything_and_the_names_where_they_are_asked_for() -> None:
    plain = json.loads(dynsolve("solve", "planar-2r", "--json").out)
    named = json.loads(dynsolve("solve", "planar-2r", "--json", "--abbreviate", "always").out)
    short = named.pop("abbreviated")
    assert named == plain
    values = {"m1": 2.0, "m2": 3.0, "l1": 0.4, "lc1": 0.1, "lc2": 0.7, "I1": 0.3, "I2": 0.2, "g": 9.81}
    values |= {"q1": 0.3, "q2": -0.8, "q1_dot": 1.1, "q2_dot": 0.6}
    space = {"__builtins__": {}, "sin": math.sin, "cos": math.cos, **values}
    for definition in [*short["constants"], *short["recurring"]]:
        space[definition["name"]] = eval(definition["value"], space)  # noqa: S307
    for row, other in zip(short["C"], plain["results"]["C"], strict=True):
        for ours, theirs in zip(row, other, strict=True):
            assert eval(ours, space) == pytest.approx(eval(theirs, space))  # noqa: S307


def test_the_same_every_time() -> None:
    first, second = (
        dynsolve_afresh("solve", "stanford-6", "--stage", "vectorized", PYTHONHASHSEED=seed).out
        for seed in ("1", "2")
    )
    assert first == second
