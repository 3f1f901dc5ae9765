"""`set.yaml`: what it says, and where it is wrong."""

from __future__ import annotations

from fractions import Fraction
from pathlib import Path

import pytest

from dynsolve.errors import ProblemError
from dynsolve.grading.set_file import load_set
from dynsolve.problem.reader import find


def _folder(tmp_path: Path, text: str) -> str:
    for name in ("in3140-rp", "planar-2r"):
        (tmp_path / f"{name}.yaml").write_text(find(name).read_text())
    (tmp_path / "set.yaml").write_text(text)
    return str(tmp_path)


def test_everything_it_may_say(tmp_path: Path) -> None:
    found = load_set(
        _folder(
            tmp_path,
            "title: Assignment 2\nproblems: [planar-2r.yaml, in3140-rp.yaml]\n"
            "marks: {in3140-rp: {P: 2, M: 4, tau: 1/2}}\n"
            "policy: {follow: 1/2, caps: {energy: 5}, rounding: 0.5, late: 0.8, hints: 2}\n",
        )
    )
    assert (found.title, found.stems) == ("Assignment 2", ("planar-2r", "in3140-rp"))
    assert dict(found.item("in3140-rp").problem.marks) == {"P": 2, "D": 4, "tau": Fraction(1, 2)}
    assert dict(found.item("planar-2r").problem.marks) == dict.fromkeys(("D", "C", "g", "tau"), 1)
    policy = found.policy
    assert (policy.follow, policy.late, policy.rounding) == (Fraction(1, 2), Fraction(4, 5), Fraction(1, 2))
    assert (dict(policy.caps), policy.hints) == ({"energy": 5}, 2)


def test_a_folder_without_one_is_all_its_problems(tmp_path: Path) -> None:
    folder = _folder(tmp_path, "")
    (tmp_path / "set.yaml").unlink()
    assert load_set(folder).stems == ("in3140-rp", "planar-2r")


@pytest.mark.parametrize(
    ("text", "place", "message"),
    [
        ("titel: x", (1, 1), "unknown key `titel`"),
        ("problems: [rp.yaml]", (1, 12), "there is no problem file `rp.yaml`"),
        ("problems: [../x.yaml]", (1, 12), "there is no problem file"),
        ("marks: {rp: {P: 2}}", (1, 9), "unknown key `rp` in marks"),
        ("marks:\n  in3140-rp: {Z: 2}", (2, 15), "`Z` is no answer of in3140-rp"),
        ("marks:\n  in3140-rp: {P: x}", (2, 18), "`x` is not a number"),
        ("policy: {follow: 2}", (1, 18), "is a share, at most 1"),
        ("policy: {late: -1}", (1, 16), "late cannot be negative"),
        ("policy: {late: [0.9, 2]}", (1, 22), "is a share, at most 1"),
        ("policy: {late: 80%}", (1, 16), "`late` is a share, not a percentage"),
        ("policy: {hints: 4}", (1, 17), "hints are 1, 2 or 3"),
        ("policy: {rounding: 0}", (1, 20), "rounded to steps of 0"),
        ("policy: {caps: {kinetics: 2}}", (1, 17), "unknown key `kinetics` in caps"),
        ("- a", (1, 1), "not keys with values"),
    ],
)
def test_a_fault_is_reported_at_its_place(
    tmp_path: Path, text: str, place: tuple[int, int], message: str
) -> None:
    with pytest.raises(ProblemError) as caught:
        load_set(_folder(tmp_path, text + "\n"))
    finding = caught.value.findings[0]
    assert message in finding.message
    assert (finding.line, finding.column) == place


def test_late_by_the_day(tmp_path: Path) -> None:
    policy = load_set(_folder(tmp_path, "policy: {late: [0.9, 4/5, 0]}\n")).policy
    assert [policy.kept(days) for days in (0, 1, 2, 3, 9)] == [1, Fraction(9, 10), Fraction(4, 5), 0, 0]


@pytest.mark.parametrize(
    ("text", "help"),
    [
        ("policy: {late: 80%}", "write 0.8"),
        ("policy: {late: 80}", "write 1/2 or 0.8"),
        ("marks: {in3140-pr: {P: 2}}", "in3140-rp"),
        ("marks: {rp: {P: 2}}", "in3140-rp, planar-2r"),
        ("problems: [in3140-pr.yaml]", "in3140-rp.yaml"),
    ],
)
def test_a_fault_says_what_to_write(tmp_path: Path, text: str, help: str) -> None:
    with pytest.raises(ProblemError) as caught:
        load_set(_folder(tmp_path, text + "\n"))
    assert help in caught.value.findings[0].help


def test_faults_are_told_in_the_order_of_the_file(tmp_path: Path) -> None:
    text = "policy: {hints: 4}\nmarks:\n  in3140-rp: {Z: 2}\nproblems: [in3140-rp.yaml, rp.yaml]\ntitel: x\n"
    with pytest.raises(ProblemError) as caught:
        load_set(_folder(tmp_path, text))
    assert [finding.line for finding in caught.value.findings] == [1, 3, 4, 5]


def test_the_schema_knows_every_key_and_takes_what_the_reader_takes() -> None:
    import jsonschema

    from dynsolve.grading.set_file import POLICY, SET, set_schema

    schema = set_schema()
    jsonschema.Draft202012Validator.check_schema(schema)
    assert tuple(schema["properties"]) == SET.names
    assert tuple(schema["properties"]["policy"]["properties"]) == POLICY.names
    given = {"title": "A", "problems": ["a.yaml"], "marks": {"a": {"P": 2, "K": "1/2"}}}
    jsonschema.validate({**given, "policy": {"follow": "1/2", "caps": {"energy": 5}, "hints": 2}}, schema)
    with pytest.raises(jsonschema.ValidationError):
        jsonschema.validate({"policy": {"hints": 4}}, schema)
