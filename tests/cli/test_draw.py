"""`dynsolve draw` as a user meets it."""

from __future__ import annotations

import shutil
import subprocess
import xml.etree.ElementTree as ET
from pathlib import Path

import pytest

from tests.cli.running import dynsolve
from tests.support import ROOT

pytestmark = pytest.mark.slow


def test_svg_goes_to_standard_output() -> None:
    ran = dynsolve("draw", "in3140-rp")
    assert ran.code == 0 and not ran.err
    assert ET.fromstring(ran.out).tag.endswith("svg")  # noqa: S314 - our own
    assert "∗" in ran.out and "∗" not in dynsolve("draw", "in3140-rp", "--no-star").out


def test_standard_input_is_drawn() -> None:
    text = (ROOT / "problems" / "planar-2r.yaml").read_text()
    assert dynsolve("draw", "-", "--quiet", stdin=text) == dynsolve("draw", "planar-2r")


@pytest.mark.parametrize(("name", "start"), [("a.svg", b"<svg"), ("a.PDF", b"%PDF"), ("a.png", b"\x89PNG")])
def test_the_suffix_says_the_form(name: str, start: bytes, tmp_path: Path) -> None:
    if start != b"<svg":
        pytest.importorskip("typst")
    ran = dynsolve("draw", "planar-2r", "-o", str(tmp_path / name))
    assert ran.code == 0 and not ran.out
    assert (tmp_path / name).read_bytes().startswith(start)


def test_the_form_may_be_said(tmp_path: Path) -> None:
    place = tmp_path / "picture"
    assert dynsolve("draw", "planar-2r", "--format", "svg", "-o", str(place)).code == 0
    assert place.read_text().startswith("<svg")
    ran = dynsolve("draw", "planar-2r", "-o", str(place))
    assert ran.code == 2 and "--format" in ran.err
    ran = dynsolve("draw", "planar-2r", "--format", "png", "-o", str(tmp_path / "a.svg"))
    assert ran.code == 2 and "named as svg" in ran.err and not (tmp_path / "a.svg").exists()


def test_a_failure_leaves_the_old_file(tmp_path: Path) -> None:
    place = tmp_path / "a.svg"
    place.write_text("old")
    faulty = tmp_path / "faulty.yaml"
    faulty.write_text("dh: [{theta: theta1* + 90}]")
    assert dynsolve("draw", str(faulty), "-o", str(place)).code == 2
    assert dynsolve("draw", "no-such-problem", "-o", str(place)).code == 2
    assert place.read_text() == "old" and sorted(p.name for p in tmp_path.iterdir()) == [
        "a.svg",
        "faulty.yaml",
    ]
    missing = dynsolve("draw", "planar-2r", "-o", str(tmp_path / "no" / "a.svg"))
    assert missing.code == 2 and "no folder" in missing.err


@pytest.mark.latex
@pytest.mark.skipif(not shutil.which("pdflatex"), reason="needs pdflatex")
def test_the_picture_for_latex_compiles_without_packages(tmp_path: Path) -> None:
    for name in ("in3140-rp", "puma560"):
        assert dynsolve("draw", name, "-o", str(tmp_path / f"{name}.tex")).code == 0
    page = r"\documentclass{article}\begin{document}\noindent\input{in3140-rp}\par"
    page += r"\noindent\input{puma560}\end{document}"
    (tmp_path / "page.tex").write_text(page)
    done = subprocess.run(
        ["pdflatex", "-interaction=nonstopmode", "-halt-on-error", "page.tex"],
        cwd=tmp_path, capture_output=True, check=False,
    )  # fmt: skip
    log = (tmp_path / "page.log").read_text()
    assert done.returncode == 0 and "Overfull" not in log and "Warning" not in log, log[-2000:]
