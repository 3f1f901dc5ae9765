"""Variants: each student another one, as hard as the others, and the same in every run."""

import csv
import sqlite3
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor
from contextlib import closing
from fractions import Fraction
from functools import cache
from pathlib import Path
from statistics import median

import pytest

from dynsolve.errors import ProblemError, UsageError
from dynsolve.exercise import plot, variants
from dynsolve.exercise.hardness import COUNTS, Hardness, equally_hard, hardness
from dynsolve.exercise.variants import MOST_STRUCTURES, Family, _measured, family_of, students_of, vary
from dynsolve.grading.public import grade
from dynsolve.grading.set_file import load_set
from dynsolve.problem.lint import lint_text
from dynsolve.problem.reader import read_problem
from dynsolve.problem.variation import Variation, read_variation, renamed
from tests.support import with_files
from tests.unit.exercise.test_template import key_in

ARM = """title: Two links
gravity: [0, -g, 0]   # in the plane
dh:
  - {theta: q1*, a: l1}
  - {theta: q2*, a: l2}
masses:
  - {mass: m1, link: 1, center: {near: [lc1, 0, 0]}}
  - {mass: m2, link: 2}
values: {l1: 0.4, l2: 0.3, m1: 2, m2: 1, lc1: 0.2, g: 9.81}
vary:
  gravity: [[0, -g, 0], [-g, 0, 0]]
  masses.1.center: [{near: [lc1, 0, 0]}, tip]
  friction: [absent, {q1: fv}]
  values.m1: {from: 1, to: 2, step: 0.5}
  letters: {l1: [l1, a1], q1: [q1, theta1]}
find: [D, g]
"""
SEED = "autumn"


@pytest.fixture(scope="module", autouse=True)
def measured_once() -> Iterator[None]:
    """Structures are measured once for all tests, and all is done in this process."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(variants, "_counted", cache(variants._counted))
        patch.setattr(variants, "ProcessPoolExecutor", lambda jobs, mp_context: ThreadPoolExecutor(jobs))
        yield


def variation(text: str) -> Variation:
    found = read_variation(text, "arm.yaml")
    assert found is not None
    return found


def test_a_choice_changes_its_part_of_the_file_alone() -> None:
    found = variation(ARM)
    chosen = {"gravity": "[-g, 0, 0]", "masses.1.center": "tip", "friction": "{q1: fv}", "values.m1": "1.5"}
    lines = found.choose(chosen, {"l1": "a1", "q1": "theta1"}).splitlines()
    assert "gravity: [-g, 0, 0]   # in the plane" in lines
    assert "  - {theta: theta1*, a: a1}" in lines
    assert "  - {mass: m1, link: 1, center: tip}" in lines
    assert "values: {a1: 0.4, l2: 0.3, m1: 1.5, m2: 1, lc1: 0.2, g: 9.81}" in lines
    assert "friction: {theta1: fv}" in lines
    assert not [line for line in lines if "vary" in line or "letters" in line]
    assert found.choose({}) == ARM[: ARM.index("vary:")] + "find: [D, g]\n"


def test_every_variant_is_a_problem_of_its_own() -> None:
    found = variation(ARM)
    assert found.structures == 8 and found.dressings == 12
    for number in range(found.structures):
        structure = found.structure_of(number)
        values, letters = found.dressing(number)
        problem = read_problem(found.choose({**structure, **values}, letters))
        assert problem.robot.n == 2
        assert problem.written["m1"] == values["values.m1"]


def test_letters_change_where_they_are_names() -> None:
    text = "title: a in l1\ndh: [{theta: q1*, a: a, alpha: 90deg}]\nstate: {q1: 1, q1': a}\nfind: [g]\n"
    assert renamed(text, {"a": "b", "q1": "g"}) == (
        "title: a in l1\ndh: [{theta: g*, a: b, alpha: 90deg}]\nstate: {g: 1, g': b}\nfind: [g]\n"
    )


@pytest.mark.parametrize(
    ("vary", "said"),
    [
        ("{dh.3.a: [l1, l2]}", "the file has no dh.3"),
        ("{springs.1: [absent, {stiffness: k}]}", "the file has no springs"),
        ("{dh.1: [{theta: q1*}, {d: q1*}], dh.1.a: [l1, l2]}", "dh.1.a is a part of dh.1"),
        ("{gravty: [none, [0, 0, -g]]}", "the file has no gravty"),
        ("{gravity: [[0, -g, 0]]}", "gravity needs at least two alternatives"),
        ("{values.m1: {from: 2, to: 1, step: 1}}", "this range is empty"),
        ("{letters: {l1: [a, b], l2: [b, c]}}", "b would be two things"),
        ("[gravity]", "vary is a mapping"),
        ("{dh.1.a: [l1, 'l1*']}", "with dh.1.a: 'l1*'"),
        ("{letters: {l1: [l1, m1]}}", "with l1: m1: m1 is"),
    ],
)
def test_a_fault_is_located(vary: str, said: str) -> None:
    text = ARM[: ARM.index("vary:")] + f"vary: {vary}\nfind: [D, g]\n"
    try:
        found = [*lint_text(text, "arm.yaml")]
    except ProblemError as error:
        found = [*error.findings]
    (finding,) = [one for one in found if said in one.message]
    assert finding.line == 10
    assert finding.help


def test_a_set_may_say_what_varies(tmp_path: Path) -> None:
    plain = ARM[: ARM.index("vary:")] + "find: [D, g]\n"
    files = {
        "arm.yaml": plain,
        "set.yaml": "vary:\n  arm: {dh.2.a: [l2, 2*l2], friction: [absent, {q1: fv}]}\n",
    }
    (item,) = load_set(str(with_files(tmp_path, files))).items
    assert item.variation is not None
    assert "{theta: q2*, a: 2*l2}" in item.variation.choose({"dh.2.a": "2*l2"})
    assert item.variation.choose({"friction": "{q1: fv}"}).endswith("friction: {q1: fv}\n")
    for text, said in (
        ("vary: {arm: {dh.3.a: [l1, l2]}}\n", "set.yaml:1:14: the file has no dh.3"),
        ("vary: {leg: {dh.2.a: [l1, l2]}}\n", "leg"),
    ):
        with_files(tmp_path, {"set.yaml": text})
        with pytest.raises(ProblemError, match=said):
            load_set(str(tmp_path))
    with_files(tmp_path, {"arm.yaml": ARM, "set.yaml": files["set.yaml"]})
    with pytest.raises(ProblemError, match="arm has a `vary` of its own"):
        load_set(str(tmp_path))


def test_of_more_structures_than_can_be_listed_some_are_chosen() -> None:
    assert list(_measured(8, SEED)) == list(range(8))
    chosen = list(_measured(10**30, SEED))
    assert len(set(chosen)) == MOST_STRUCTURES
    assert chosen == list(_measured(10**30, SEED)) != list(_measured(10**30, "spring"))


def test_what_is_counted_of_a_result() -> None:
    counted = hardness(read_problem(variation(ARM).choose({})), ["D", "g"])
    assert counted["g"].terms == 4  # m1 g lc1 c1 + m2 g l1 c1 + m2 g l2 c12, and the last of these
    assert counted["D"].identities == 1  # c2 of c1 c12 + s1 s12
    assert all(count > 0 for one in counted.values() for count in (one.steps, one.operations, one.slips))


def test_a_family_is_near_its_median_and_the_largest() -> None:
    def of(terms: int, identities: int = 1) -> dict[str, Hardness]:
        return {"D": Hardness(30, terms, 40, identities, 20)}

    found = {"a": of(20), "b": of(21), "c": of(22), "d": of(40), "e": of(41), "without": of(21, 0)}
    assert sorted(equally_hard(found, Fraction(1, 10))) == ["a", "b", "c"]


@pytest.fixture(scope="module")
def course(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Six students, a problem that varies and one that does not."""
    folder = tmp_path_factory.mktemp("course")
    with_files(folder, {"set/arm.yaml": ARM, "set/fixed.yaml": ARM[: ARM.index("vary:")] + "find: [g]\n"})
    names = [f"s{i}" for i in range(6)]
    with_files(folder, {"roster.csv": "\n".join(["student", *names])})
    vary(load_set(str(folder / "set")), students_of(folder / "roster.csv"), SEED, folder / "out", jobs=1)
    return folder


def test_progress_is_told_of_structures_and_of_students(course: Path) -> None:
    told: list[tuple[int, int]] = []

    def progress(done: int, of: int) -> None:
        told.append((done, of))

    students = students_of(course / "roster.csv")
    vary(load_set(str(course / "set")), students, SEED, course / "out", jobs=1, progress=progress)
    assert told == [(done, 8 + 1 + 6) for done in range(1, 8 + 1 + 6 + 1)]


def rows(folder: Path) -> list[dict[str, str]]:
    with (folder / "variants.csv").open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def test_each_student_has_a_variant_of_his_own(course: Path) -> None:
    out = course / "out"
    texts = [(out / "keys" / f"s{i}" / "arm.yaml").read_text("utf-8") for i in range(6)]
    assert len(set(texts)) == 6
    assert len({(out / "keys" / f"s{i}" / "fixed.yaml").read_text("utf-8") for i in range(6)}) == 1
    for i in range(6):
        assert (out / f"s{i}" / "sheet.html").is_file() and (out / f"s{i}" / "arm.yaml").is_file()
        assert (out / "keys" / f"s{i}" / "key.html").is_file()


def test_all_are_within_the_range_of_their_median(course: Path) -> None:
    for answer in ("D", "g"):
        own = [row for row in rows(course / "out") if row["problem"] == "arm" and row["answer"] == answer]
        assert len(own) == 6
        for count in COUNTS:
            counted = [int(row[count]) for row in own]
            middle = median(counted)
            assert all(abs(one - middle) <= max(middle / 10, 1) for one in counted)
            assert len({one == 0 for one in counted}) == 1


def test_each_variant_is_verified_and_as_hard_as_its_structure(course: Path) -> None:
    counted = {
        (row["student"], row["answer"]): tuple(int(row[count]) for count in COUNTS)
        for row in rows(course / "out")
        if row["problem"] == "arm"
    }
    for student in (f"s{i}" for i in range(6)):
        own = read_problem((course / "out" / "keys" / student / "arm.yaml").read_text("utf-8"))
        for name, found in hardness(own, ["D", "g"]).items():  # solves it, which verifies it
            assert found.counts == counted[student, name]


def test_the_same_seed_gives_the_same_bytes_and_a_late_student_changes_no_other(
    course: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(variants, "ProcessPoolExecutor", ProcessPoolExecutor)  # in processes of their own
    problems, again = load_set(str(course / "set")), course / "again"
    vary(problems, {**students_of(course / "roster.csv"), "late": "Late"}, SEED, again, jobs=1)
    first = {path.relative_to(course / "out"): path.read_bytes() for path in (course / "out").rglob("*.*")}
    second = {path.relative_to(again): path.read_bytes() for path in again.rglob("*.*")}
    for table in ("variants.csv", "variants.svg"):
        first.pop(Path(table), None)
    assert {path: second[path] for path in first} == first


def test_a_run_that_was_stopped_goes_on(course: Path) -> None:
    out = course / "out"
    kept, lost = out / "s1" / "sheet.html", out / "keys" / "s2" / "arm.yaml"
    before, text = kept.stat().st_mtime_ns, lost.read_text("utf-8")
    lost.unlink()
    vary(load_set(str(course / "set")), students_of(course / "roster.csv"), SEED, out, jobs=1)
    assert lost.read_text("utf-8") == text
    assert kept.stat().st_mtime_ns == before


def test_another_seed_does_not_replace_what_was_handed_out(course: Path) -> None:
    out = course / "out"
    before = {path: path.read_bytes() for path in out.rglob("*.*")}
    with pytest.raises(UsageError, match="is another variant"):
        vary(load_set(str(course / "set")), students_of(course / "roster.csv"), "spring", out, jobs=1)
    assert {path: path.read_bytes() for path in out.rglob("*.*")} == before


def test_a_faulty_variant_is_told_as_any_file_is(tmp_path: Path) -> None:
    text = ARM[: ARM.index("vary:")] + "vary: {dh.1.a: [l1, m1]}\nfind: [g]\n"
    file = with_files(tmp_path, {"arm.yaml": text}) / "arm.yaml"
    with pytest.raises(ProblemError, match="m1 is a mass here and a length"):
        vary(load_set(str(file)), {"a": ""}, SEED, tmp_path / "out", jobs=1)


def test_a_family_that_is_too_poor_says_how_many_it_has(tmp_path: Path) -> None:
    text = ARM[: ARM.index("vary:")] + "vary: {letters: {l1: [l1, a1]}}\n"
    file = with_files(tmp_path, {"arm.yaml": text}) / "arm.yaml"
    with pytest.raises(UsageError, match="arm has 2 variants that are equally hard, for 3 students"):
        vary(load_set(str(file)), dict.fromkeys("abc", ""), SEED, tmp_path / "out", jobs=1)
    assert not (tmp_path / "out").exists()


ASKED = """
gravity: [0, -g, 0]
model:
  coordinates: {x: prismatic, theta: revolute}
  bodies:
    - {mass: M, at: [x, 0, 0]}
    - {mass: m, at: [x + l*sin(theta), -l*cos(theta), 0]}
passive: [theta]
linearize: {x: 0, theta: 0}
values: {l: 0.4, M: 2, m: 1, g: 9.81}
vary:
  gravity: [[0, -g, 0], [0, g, 0]]
  model.bodies.2.at: ['[x + l*sin(theta), -l*cos(theta), 0]', '[x + l*cos(theta), l*sin(theta), 0]']
  values.M: {from: 1, to: 2, step: 0.5}
  letters: {M: [M, m0], l: [l, a], x: [x, s]}
find: [g, linear_A]
""".replace("'", "")


def family(text: str, file: Path) -> Family:
    (item,) = load_set(str(with_files(file.parent, {file.name: text}) / file.name)).items
    with ThreadPoolExecutor(1) as pool:
        return family_of(item, SEED, pool, lambda: None)


def test_a_variant_without_a_result_is_left_out(tmp_path: Path) -> None:
    found = family(ASKED, tmp_path / "cart.yaml")
    assert found.left_out == ("model.bodies.2.at: [x + l*cos(theta), l*sin(theta), 0]",)
    assert len(found.structures) == 2


def test_what_changes_no_answer_is_told(tmp_path: Path) -> None:
    assert family(ASKED.replace("linear_A", "P"), tmp_path / "cart.yaml").idle == ("values.M", "M", "x")
    assert family(ASKED.replace("g, linear_A", "D"), tmp_path / "cart.yaml").idle == ("gravity", "x")


def test_a_table_may_be_asked_for(tmp_path: Path) -> None:
    found = family(ARM.replace("find: [D, g]", "find: [DH, g]"), tmp_path / "arm.yaml")
    assert {one["DH"].counts for one in found.hardness} == {(2, 4, 4, 0, 0)}
    assert "friction" in found.idle


def test_each_is_graded_by_his_own_variant(course: Path, tmp_path: Path) -> None:
    keys = course / "out" / "keys"
    for student in ("s0", "s1", "stranger"):
        own = keys / ("s0" if student == "stranger" else student) / "arm.yaml"
        with_files(tmp_path / "in" / student, {"arm.yaml": key_in(own)})
    with_files(tmp_path / "in" / "s2", {"arm.yaml": key_in(keys / "s3" / "arm.yaml")})
    problems, out = course / "set", course / "out"
    totals = grade(problems, tmp_path / "in", tmp_path / "grades", variants=out, jobs=1).totals
    assert totals["s0"] == totals["s1"] == 2
    assert totals["s2"] < 2
    assert totals["stranger"] == 0


def test_the_same_wrong_expression_is_found_in_other_letters(course: Path, tmp_path: Path) -> None:
    keys = course / "out" / "keys"
    for student in ("s0", "s1", "s2", "s3", "s4", "s5"):
        arm = read_problem((keys / student / "arm.yaml").read_text("utf-8"))
        first, length = (
            arm.robot.coordinates[0].name,
            next(name for name in ("l1", "a1") if name in arm.written),
        )
        wrong = f"answers:\n  g: [m1*g*{length}*sin({first}), 0]\n"
        with_files(tmp_path / "in" / student, {"arm.yaml": wrong})
    grade(course / "set", tmp_path / "in", tmp_path / "grades", variants=course / "out", jobs=1)
    alike = {row[-1] for row in forms(tmp_path / "grades")}
    assert len(alike) == 1 and "" not in alike


def forms(folder: Path) -> list[tuple[str, ...]]:
    """The hashes of the wrong answers g, by student."""
    with closing(sqlite3.connect(folder / "grades.sqlite")) as db:
        return list(db.execute("SELECT student, form FROM answers WHERE answer = 'g' AND problem = 'arm'"))


def test_what_was_counted_is_drawn(course: Path) -> None:
    if plot.is_there():
        assert b"<svg" in (course / "out" / "variants.svg").read_bytes()


def test_a_roster_is_a_column_or_the_list_of_a_platform(tmp_path: Path) -> None:
    canvas = 'Student,ID,SIS Login ID,Section\n"Lovelace, Ada",41,ada,S\n'
    with_files(
        tmp_path, {"own.csv": "name,student\nAda,s1\nBob,s2\n", "canvas.csv": canvas, "no.csv": "a,b\n1,2\n"}
    )
    assert [*students_of(tmp_path / "own.csv")] == ["s1", "s2"]
    assert students_of(tmp_path / "canvas.csv") == {"lovelaceada_41": "Lovelace, Ada"}
    with pytest.raises(Exception, match="no students are found"):
        students_of(tmp_path / "no.csv")
