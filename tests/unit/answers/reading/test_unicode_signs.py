"""The signs of Unicode that people write formulas with, in text, in displays and as YAML values."""

from __future__ import annotations

import json

import pytest

from dynsolve.answers.verdict import Report
from tests.unit.answers.hands import checker

PENDULUM = """
gravity: [0, -g, 0]
dh: [{theta: q1*, a: l1}]
masses: [{mass: m1, link: 1, center: tip, inertia: {zz: I1}}]
find: [K, P, tau1]
"""
GREEK = """
gravity: [0, -g, 0]
dh: [{theta: theta*, a: epsilon}]
masses: [{mass: rho, link: 1, center: tip, inertia: {zz: phi}}]
find: [K, P]
"""
# what is replaced in K = ½ (m1 l1² + I1) q̇1², and by what
IN_K = [
    ("=", "≈ ≃ ≅ ≙ ≐ ≡ ≜ ≔ ≝ ＝ := ∶="),
    ("½", "1/2 ¹⁄₂ ¹/₂ 1⁄2 1∕2 1÷2 ¼·2 ⅓·3/2 ⅙·3 ⅔·¾ 2⁻¹ ０．５ 0.5 𝟏/𝟐 １／２"
     " 1·½ 1⋅½ 1∙½ 1•½ 1×½ 1∗½ 1⁎½ 1＊½"),
    ("+ I1", "−(−I1) –(–I1) —(—I1) ‐(‐I1) ‑(‑I1) －(－I1) ﹣(﹣I1)"
     " ＋I1 +𝐼1 +𝐈1 +𝖨1 +𝙸1 +𝑰1 +I₁ +I_1 +I_₁ +Ｉ１"),
    ("m1", "𝑚1 𝐦1 𝗆1 𝚖1 𝒎1 m₁ m_₁ 𝑚₁ 𝑚_1 ｍ１"
     " m\u200d1 m\u200b1 m1\u200c m1\u2060 \ufeffm1 m1\ufe0e"),
    ("l1²", "ℓ1² l1⁺² l₁² 𝑙₁² l1^2 l1**2 l1＾2 l1·l1 l1⋅l1 l1×l1"),
    (" (", "\u00a0( \u2009( \u202f( \u2003( \u205f( \u3000( \u2062( （"),
    ("q̇1", "q1′ q1’ q1ʹ q1＇ q˙1 q₁̇ 𝑞̇₁ 𝐪̇1 𝗊̇1 𝒒̇_1 q̇_1 q̇_₁ q\u0307\u200d1 (dq1∕dt) (ⅆq1/ⅆt)"),
    ("K", "𝐾 𝐊 𝒦 Ｋ K\u200b ⟹K ⇒K →K ⟶K ∴K ⇔K"),
]  # fmt: skip
OTHERS = [
    (PENDULUM, "P = m1 g l1 sin q1", "P=𝑚₁𝑔𝑙₁sin𝑞₁ P=m1·g·l1·sin\u2061q1 P=m1·g·l1·cos(q1−90°)"
     " P=m1·g·l1·cos(q1−90º) P=m1·g·l1·cos(q1−π∕2) P=m1·g·l1·cos(q1−𝜋/2) P=m1·g·l1·s₁"),
    (PENDULUM, "tau1", "τ₁=(m₁l₁²+I₁)q₁″+m₁g·l₁c₁ τ₁=(m₁l₁²+I₁)q₁′′+m₁g·l₁c₁ τ₁=(m₁l₁²+I₁)q₁ʺ+m₁g·l₁c₁"
     " τ₁=(m₁l₁²+I₁)q₁\"+m₁g·l₁c₁ τ₁=(m₁l₁²+I₁)q₁”+m₁g·l₁c₁ 𝜏₁=(m₁l₁²+I₁)q̈₁+m₁g·l₁c₁"
     " 𝛕₁=(m₁l₁²+I₁)q¨₁+m₁g·l₁c₁ τ₁=(m₁l₁²+I₁)q̇̇₁+m₁g·l₁c₁"),
    (GREEK, "K", "K=½(ρ·ε²+φ)θ̇² K=½(ϱ·ϵ²+ϕ)ϑ̇² K=½(𝜌·𝜀²+𝜑)𝜃̇² K=½(𝜌·𝜖²+𝜙)𝜗̇² K=½(𝞺·𝞮²+𝟇)𝞱̇²"),
]  # fmt: skip
UNREAD = [
    ("☃", "SNOWMAN"), ("І", "CYRILLIC"), ("\u20dd", "ENCLOSING CIRCLE"), ("∮", "CONTOUR"), ("😀", "GRINNING"),
    ("\ue000", "U+E000"), ("\u202e", "RIGHT-TO-LEFT OVERRIDE"), ("\u030c", "CARON"), ("ɡ", "SCRIPT G"),
    ("\u00ad", "SOFT HYPHEN"),
]  # fmt: skip
ASIDE = {"md": "$${}$$", "txt": "{}"}


def written() -> list[tuple[str, str]]:
    rows = {sign: others.split(" ") for sign, others in IN_K}
    found = []
    for number in range(max(map(len, rows.values()))):  # one of each row at a time
        text = "K = ½ (m1 l1² + I1) q̇1²"
        for sign, others in rows.items():
            text = text.replace(sign, others[number % len(others)], 1)
        found.append((PENDULUM, text))
    return found + [(problem, text) for problem, _, texts in OTHERS for text in texts.split()]


def handed_in(problem: str, text: str) -> dict[str, Report]:
    """The reports on one formula as a display, a line and a value."""
    judge = checker(problem)
    files = {ending: form.format(text) for ending, form in ASIDE.items()}
    name, sign, value = text.partition("=")
    if sign and (name := name.strip().replace("τ₁", "tau1")) in ("K", "P", "tau1"):
        files["yaml"] = f"answers:\n  {name}: {value.strip()}\n"
        files["json"] = json.dumps({"answers": {name: value.strip()}}, ensure_ascii=False)
    return {ending: judge(judge.reader(file, f"a.{ending}")) for ending, file in files.items()}


def test_every_sign_is_read() -> None:
    for problem, text in written():
        for ending, report in handed_in(problem, text).items():
            verdicts = [str(answer.verdict) for answer in report.answers if answer.given]
            assert verdicts == ["correct"], (ascii(text), ending, report.answers, report.not_recognized)


@pytest.mark.parametrize(("sign", "name"), UNREAD)
def test_a_line_waits_with_the_name_of_a_sign_that_cannot_be_read(sign: str, name: str) -> None:
    for ending, report in handed_in(PENDULUM, f"K = ½ (m1 l1² + I1) q{sign} q̇1²").items():
        answer = next(answer for answer in report.answers if answer.name == "K")
        assert (str(answer.verdict), name in answer.fault) == ("unreadable", True), (ending, answer)
