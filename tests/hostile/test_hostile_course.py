"""A course with every hostile file beside good hand-ins: each good one gets its marks."""

from __future__ import annotations

import csv
import json
import os
import random
import socket
import stat
import zipfile
from pathlib import Path

import pytest

import dynsolve
from dynsolve.errors import ProblemError
from tests.support import ROOT

pytestmark = pytest.mark.slow

RIGHT = "answers:\n  K: (I1zz*theta1'^2)/2 + m2*(L2'^2 + L2^2*theta1'^2)/2\n  g: [0, 0]\n"
REPORT = (
    r"$$K = \frac{1}{2} I_{1zz} \dot{\theta}_1^2 + \frac{m_2}{2} (\dot{L}_2^2 + L_2^2 \dot{\theta}_1^2)$$"
)
REPORT += "\n\n$$g = 0$$\n"
MARKDOWN = {"cell_type": "markdown", "source": REPORT}
PICTURE = {"image/png": "A" * 1_500_000}


def _notebook(*cells: object) -> str:
    return json.dumps({"cells": cells, "nbformat": 4})


GOOD: dict[str, bytes] = {
    "plain.yaml": RIGHT.encode(),
    "windows.yaml": b"\xef\xbb\xbf" + RIGHT.replace("\n", "\r\n").encode(),
    "mac.yaml": RIGHT.replace("\n", "\r").encode(),
    "wide.yaml": RIGHT.encode("utf-16"),
    "latin.yaml": "# Ærlig svart på\n".encode("latin-1") + RIGHT.encode(),
    "report.md": REPORT.encode(),
    "paper.tex": REPORT.encode(),
    "page.html": f"<p>{REPORT}</p>".encode(),
    "book.ipynb": _notebook(MARKDOWN).encode(),
    "pictures.ipynb": _notebook({"cell_type": "code", "outputs": [{"data": PICTURE}]}, MARKDOWN).encode(),
    "nested.html": ("<div>" * 100_000 + f"<p>{REPORT}</p>").encode(),
    "long.md": ("x" * 1_900_000 + "\n\n" + REPORT).encode(),
    "macros.md": (
        r"\newcommand{\a}{\a\a}\def\b{\c\c}\def\c{\b\b}" + "\n\n" + REPORT + "\n$$P = \\a\\b$$\n"
    ).encode(),
    "bomb.yaml": (RIGHT + "  P: &a [*a, *a]\n  L: !!python/object/apply:os.system ['false']\n").encode(),
    "tower.yaml": (RIGHT + "  P: 9^9^9^9^9\n  L: " + "(" * 100_000 + "\n").encode(),
    "nul.yaml": (RIGHT + "  P: m1\0*g\n").encode(),
    "anchors.yaml": (
        "a: &a [x, x]\n" + "".join(f"a{i}: &a{i} [*a, *a]\n" for i in range(1000)) + RIGHT
    ).encode(),
}
BAD: dict[str, bytes] = {
    "random.yaml": random.Random(1).randbytes(100_000),
    "zeros.yaml": b"\0" * 2_000_000,
    "empty.md": b"",
    "brackets.yaml": b"[" * 2_000_000,
    "brackets.ipynb": b"[" * 2_000_000,
    "blanks.md": b" " * 2_000_000,
    "tags.html": b"<a" * 1_000_000,
    "dollars.md": b"$" * 2_000_000,
    "fences.tex": b"\\begin{align}" * 150_000,
    "large.yaml": b"#" * 2_000_001,
    "program.exe": b"MZ",
    "archive.zip": b"PK",
}


def _folder(tmp_path: Path) -> Path:
    folder = tmp_path / "in"
    for name, content in {**GOOD, **BAD}.items():
        place = folder / name.replace(".", "-")
        place.mkdir(parents=True)
        (place / name).write_bytes(content)
    (folder / "link.yaml").symlink_to("/etc/passwd")
    (folder / "loop").symlink_to(folder)
    (folder / "out\x1b[31m.yaml").write_text(RIGHT)
    (folder / "moc.\u202elmay").write_text(RIGHT)
    os.mkfifo(folder / "pipe.yaml")
    (folder / os.fsdecode(b"bytes\xff.yaml")).write_text(RIGHT)
    with socket.socket(socket.AF_UNIX) as one, _inside(folder):
        one.bind("s.yaml")
    return folder


class _inside:
    """Within a folder: the path of a socket is short."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder

    def __enter__(self) -> None:
        self.before = Path.cwd()
        os.chdir(self.folder)

    def __exit__(self, *_: object) -> None:
        os.chdir(self.before)


def _archive(tmp_path: Path) -> Path:
    path = tmp_path / "in.zip"
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in {**GOOD, **BAD}.items():
            archive.writestr(zipfile.ZipInfo(f"{name.replace('.', '-')}/{name}"), content)
        for name in ("../out.yaml", "/etc/out.yaml", "a/../../out.yaml", "..\\out.yaml", "C:\\out.yaml"):
            archive.writestr(zipfile.ZipInfo(name), RIGHT)
        archive.writestr("bomb.yaml", b"\0" * 60_000_000)
        link = zipfile.ZipInfo("link.yaml")
        link.external_attr = (stat.S_IFLNK | 0o777) << 16
        archive.writestr(link, "/etc/passwd")
        archive.writestr("out\x1b[31m.yaml", RIGHT)
        archive.writestr("deep/" * 40 + "x.yaml", RIGHT)
    return path


@pytest.mark.parametrize("make", [_folder, _archive], ids=["folder", "zip"])
def test_every_good_hand_in_gets_its_marks(tmp_path: Path, make: object) -> None:
    problems = tmp_path / "set"
    problems.mkdir()
    (problems / "in3140-rp.yaml").write_text((ROOT / "problems" / "in3140-rp.yaml").read_text())
    (problems / "set.yaml").write_text("marks: {in3140-rp: {K: 4, g: 2}}\n")
    out = tmp_path / "out"
    grades = dynsolve.grade(problems, make(tmp_path), out, jobs=2)  # type: ignore[operator]
    rows = csv.DictReader((out / "grades.csv").read_text().splitlines())
    totals = {row["student"]: row["total"] for row in rows}
    for name in GOOD:
        assert (name, totals[name.replace(".", "-")]) == (name, "6")
    for name in BAD:
        assert (name, totals[name.replace(".", "-")]) == (name, "0")
    assert all(refused.name.isprintable() and refused.reason for refused in grades.refused)
    assert len(grades.refused) == (8 if make is _folder else 10)
    reasons = {waiting.student: waiting.reason for waiting in grades.waiting}
    assert reasons["archive-zip"] == "an archive: it is damaged, or no zip"
    assert reasons["large-yaml"] == "it is larger than 2 MB"
    assert not (tmp_path / "out.yaml").exists()
    for path in out.rglob("*.*"):
        as_handed_in = path.parent.name == "hand-ins" or path.name.startswith("grades.sqlite")
        assert as_handed_in or b"\x1b" not in path.read_bytes()
        assert path.resolve().is_relative_to(out)


FAULTY = {
    "brackets": "[" * 100_000,
    "braces": "marks: " + "{a: " * 40_000,
    "aliases": "a: &a [x, x]\n" + "".join(f"b{i}: &b{i} [*a, *a]\n" for i in range(1000)),
    "self": "marks: &a {in3140-rp: *a}\n",
    "tag": "marks: !!python/object/apply:os.system ['false']\n",
    "twice": "marks: {in3140-rp: {K: 1}}\nmarks: {in3140-rp: {K: 2}}\n",
    "large": "marks: {in3140-rp: {K: 1" + "0" * 100_000 + "}}\n",
    "power": "marks: {in3140-rp: {K: 9^9^9^9}}\n",
    "nan": "marks: {in3140-rp: {K: .nan}}\n",
    "infinite": "policy: {late: .inf}\n",
    "binary": "\0\1\2",
    "tab": "marks:\n\tin3140-rp: 1\n",
    "list": "policy: [1, 2]\n",
    "text": "policy: {caps: energy}\n",
    "entry": "marks: {in3140-rp: {d99: 1}}\n",
}


@pytest.mark.parametrize("text", FAULTY.values(), ids=FAULTY.keys())
def test_a_faulty_set_is_told_with_its_place_before_anything_is_written(tmp_path: Path, text: str) -> None:
    problems = tmp_path / "set"
    problems.mkdir()
    (problems / "in3140-rp.yaml").write_text((ROOT / "problems" / "in3140-rp.yaml").read_text())
    (problems / "set.yaml").write_text(text)
    (tmp_path / "in").mkdir()
    with pytest.raises(ProblemError) as caught:
        dynsolve.grade(problems, tmp_path / "in", tmp_path / "out", jobs=1)
    finding = caught.value.findings[0]
    assert finding.file.endswith("set.yaml") and finding.line >= 1 and finding.column >= 1
    assert all(len(found.message) < 500 for found in caught.value.findings)
    assert not (tmp_path / "out").exists()
