"""A variant for each student: drawn by a hash, as hard as the others, each key verified.

    OUT/<student>/              sheet and templates, for the student
    OUT/keys/<student>/         the key, and <problem>.yaml, the variant as a problem file of its own
    OUT/variants.csv            a row an asked result: what was drawn, and how hard it is
    OUT/variants.svg            the same as a picture, with the extra `plot`

Structures are measured once, whatever letters and numbers they are dressed in.  No two students have the same
variant of a problem.  The problem files of a student are written last: what is there needs no second time.
"""

from __future__ import annotations

import csv
import io
import itertools
import os
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from concurrent.futures import Executor, ProcessPoolExecutor
from contextlib import suppress
from fractions import Fraction
from functools import partial
from hashlib import sha256
from multiprocessing import get_context
from pathlib import Path

from msgspec import Struct
from msgspec.structs import replace

from dynsolve.errors import InputError, UsageError
from dynsolve.exercise import plot
from dynsolve.exercise.hardness import COUNTS, Hardness, equally_hard, hardness
from dynsolve.exercise.sheet import SUFFIXES as SHEETS
from dynsolve.exercise.sheet import SheetFormat, key_documents, sheet_documents, written
from dynsolve.exercise.template import SUFFIXES as TEMPLATES
from dynsolve.exercise.template import TemplateFormat, template
from dynsolve.explain.step import Detail
from dynsolve.grading.files import folder_name
from dynsolve.grading.platforms.registry import PLATFORMS
from dynsolve.grading.platforms.roster import read_roster
from dynsolve.grading.set_file import VARIANT_KEYS, VARIANTS_TABLE, Item, ProblemSet
from dynsolve.problem.reader import read_problem
from dynsolve.problem.variation import Variation
from dynsolve.render.files import write_changed

MOST_STRUCTURES = 300
"""So many structures of a problem are measured; of more these are chosen by the seed."""

Progress = Callable[[int, int], None]


class Family(Struct, frozen=True):
    """The variants of a problem that are equally hard: its structures, each with what was counted."""

    item: Item
    variation: Variation | None
    structures: tuple[Mapping[str, str], ...]
    hardness: tuple[Mapping[str, Hardness], ...]

    @property
    def size(self) -> int:
        """How many variants there are."""
        return len(self.structures) * (self.variation.dressings if self.variation else 1)

    @property
    def left_out(self) -> tuple[str, ...]:
        """The alternatives that are in no variant, since with them it would not be as hard as the others."""
        parts = self.variation.structure if self.variation else ()
        return tuple(
            f"{part.path}: {text}"
            for part in parts
            for text in part.alternatives
            if all(structure[part.path] != text for structure in self.structures)
        )

    @property
    def idle(self) -> tuple[str, ...]:
        """What varies and changes no answer: parts of the structure, letters and numbers."""
        if self.variation is None:
            return ()
        results = [tuple(one.result for one in each.values()) for each in self.hardness]
        names = {name for each in self.hardness for one in each.values() for name in one.names}
        target = self.item.problem.robot.questions.target
        names |= {name for name, _ in target.numbers} if target else set()
        varied = [part.path for part in self.variation.structure if self._is_idle(part.path, results)]
        numbers = [part.path for part in self.variation.numbers]
        named = [*numbers, *(name for name, others in self.variation.letters.items() if len(others) > 1)]
        return (*varied, *(path for path in named if path.rpartition(".")[2] not in names))

    def _is_idle(self, path: str, results: Sequence[tuple[str, ...]]) -> bool:
        """Whether structures that differ in this part alone have the same results, where there are such."""
        alike: dict[tuple[tuple[str, str], ...], list[tuple[str, ...]]] = {}
        for structure, own in zip(self.structures, results, strict=True):
            others = tuple((other, text) for other, text in structure.items() if other != path)
            alike.setdefault(others, []).append(own)
        compared = [found for found in alike.values() if len(found) > 1]
        return bool(compared) and all(len(set(found)) == 1 for found in compared)

    def variant(self, number: int) -> Variant:
        """One of them, counted from 0."""
        place, dressing = number % len(self.structures), number // len(self.structures)
        structure = self.structures[place]
        if self.variation is None:
            return Variant(self.item.stem, number, {}, self.item.text, self.hardness[place])
        values, letters = self.variation.dressing(dressing)
        text = self.variation.choose({**structure, **values}, letters)
        return Variant(self.item.stem, number, {**structure, **values, **letters}, text, self.hardness[place])


class Variant(Struct, frozen=True):
    """A variant: its number in the family, what was drawn, its problem file, what was counted."""

    stem: str
    number: int
    drawn: Mapping[str, str]
    text: str
    hardness: Mapping[str, Hardness]


# -- the family --------------------------------------------------------------------------------------


def family_of(item: Item, seed: str, pool: Executor, step: Callable[[], None]) -> Family:
    """The family of a problem, with a `step` for each structure that was measured.

    Raises ProblemError for a variant that is no problem.
    """
    variation = item.variation
    structures = [variation.structure_of(k) if variation else {} for k in _measured(_structures(item), seed)]
    texts = [variation.choose(one) if variation else item.text for one in structures]
    counted: dict[int, Mapping[str, Hardness]] = {}
    for one in pool.map(partial(_counted, item.problem.file, tuple(item.problem.marks)), texts):
        counted[len(counted)] = one
        step()
    left = equally_hard(counted, variation.within) if variation else counted
    return Family(item, variation, tuple(structures[k] for k in left), tuple(left.values()))


def _structures(item: Item) -> int:
    """In how many ways the structure of a problem can be chosen."""
    return item.variation.structures if item.variation else 1


def _measured(count: int, seed: str) -> Collection[int]:
    """All of so many structures, or as many as are measured, chosen by the seed."""
    if count <= MOST_STRUCTURES:
        return range(count)
    return dict.fromkeys(_hash(seed, str(k)) % count for k in range(MOST_STRUCTURES))


def _counted(file: str, names: Sequence[str], text: str) -> Mapping[str, Hardness]:
    return hardness(read_problem(text, file), names)


def _hash(*words: str) -> int:
    return int.from_bytes(sha256("\0".join(words).encode()).digest()[:8])


# -- the draw ----------------------------------------------------------------------------------------


def students_of(roster: Path) -> dict[str, str]:
    """The names of students by what their hand-ins are called: a column `student`, or the list of a platform.

    Raises InputError for a table in which no students are found.
    """
    table = read_roster(roster)
    header = [cell.strip().lower() for cell in table.header]
    found: list[tuple[str, str]] = []
    if "student" in header and "id" not in header:
        place = header.index("student")
        found = [(row[place].strip(), row[place].strip()) for row in table.rows[1:] if len(row) > place]
    for platform in () if found else PLATFORMS.values():
        with suppress(InputError):
            found = found or [(person.student, person.name) for person in platform.people(table)]
    students = {student: name for student, name in found if student}
    if not students:
        raise table.fault("no students are found in it", "a column `student`, or a platform's own list")
    return students


def draw(family: Family, students: Sequence[str], seed: str) -> dict[str, Variant]:
    """A variant for each student, no two the same; a student who is added at the end changes no other's.

    Raises UsageError for a family that has too few.
    """
    stem = family.item.stem
    if family.variation is not None and family.size < len(students):
        message = f"{stem} has {family.size} variants that are equally hard, for {len(students)} students"
        raise UsageError(message, "let more vary, or widen `within`; nothing was written")
    taken: set[int] = set()
    found = {}
    for student in students:
        number = _hash(seed, stem, student) % family.size
        while number in taken and family.variation is not None:
            number = (number + 1) % family.size
        taken.add(number)
        found[student] = family.variant(number)
    return found


# -- the folder --------------------------------------------------------------------------------------


class Forms(Struct, frozen=True):
    """In which forms sheets, templates and keys are written."""

    sheet: SheetFormat = SheetFormat.HTML
    template: TemplateFormat = TemplateFormat.YAML
    key: Detail = Detail.RESULTS


def vary(
    problems: ProblemSet,
    students: Mapping[str, str],
    seed: str,
    folder: Path,
    forms: Forms | None = None,
    jobs: int = 0,
    progress: Progress | None = None,
) -> list[Family]:
    """Draw each student's variants, and write the folder; returns the families.  `students` have names.

    Raises UsageError for a family that is too poor or a folder with other variants, ProblemError for a
    faulty variant, before anything is written.  `progress` is told of structures and students together.
    """
    forms = forms or Forms()
    marks = {item.stem: dict(item.problem.marks) for item in problems.items}
    steps = itertools.count(1)
    of = sum(len(_measured(_structures(item), seed)) for item in problems.items) + len(students)

    def step() -> None:
        if progress is not None:
            progress(next(steps), of)

    with ProcessPoolExecutor(jobs or os.cpu_count() or 1, mp_context=get_context("spawn")) as pool:
        families = [family_of(item, seed, pool, step) for item in problems.items]
        drawn = [draw(family, list(students), seed) for family in families]
        own = {student: [each[student] for each in drawn] for student in students}
        _check_same(folder, own)
        (folder / VARIANT_KEYS).mkdir(parents=True, exist_ok=True)
        due = []
        for student in students:
            if _is_there(folder, student, own[student], forms):
                step()
            else:
                due.append(student)
        write = partial(_write, problems.title, marks, folder, forms)
        names, variants = [students[student] for student in due], [own[student] for student in due]
        for _ in pool.map(write, due, names, variants):
            step()
    write_changed(folder / VARIANTS_TABLE, _table(own).encode())
    if plot.is_there():
        write_changed(folder / "variants.svg", plot.to_svg(_counted_of(own)))
    return families


def _check_same(folder: Path, own: Mapping[str, Sequence[Variant]]) -> None:
    """Raise UsageError where a student has other variants there, which may have been handed out."""
    for student, variants in own.items():
        for one in variants:
            file = folder / VARIANT_KEYS / folder_name(student) / f"{one.stem}.yaml"
            if file.is_file() and file.read_text("utf-8") != one.text:
                message = f"{file} is another variant, of another seed or of a problem that was changed"
                raise UsageError(message, "give another folder, or delete this one")


def _is_there(folder: Path, student: str, variants: Sequence[Variant], forms: Forms) -> bool:
    """Whether everything of a student was written, of these variants."""
    keys = folder / VARIANT_KEYS / folder_name(student)
    files = [folder / folder_name(student) / f"sheet{_ending(forms.sheet)}"]
    files += [keys / f"key{_ending(forms.sheet)}"]
    try:
        same = all((keys / f"{one.stem}.yaml").read_text("utf-8") == one.text for one in variants)
    except OSError:
        return False
    return same and all(file.is_file() for file in files)


def _ending(form: SheetFormat) -> str:
    return next(suffix for suffix, named in SHEETS.items() if named is form)


def _write(
    title: str,
    marks: Mapping[str, dict[str, Fraction]],
    folder: Path,
    forms: Forms,
    student: str,
    name: str,
    variants: Sequence[Variant],
) -> None:
    """The files of one student, the problem files last."""
    items = []
    for variant in variants:
        problem = read_problem(variant.text, f"{variant.stem}.yaml")
        items.append(Item(replace(problem, marks=marks[variant.stem]), variant.text))
    own = ProblemSet(title, tuple(items))
    place, keys = folder / folder_name(student), folder / VARIANT_KEYS / folder_name(student)
    exercises = sheet_documents(own, name)
    with_key = [*exercises, *key_documents(own, forms.key)]
    write_changed(place / f"sheet{_ending(forms.sheet)}", written(exercises, forms.sheet))
    suffix = next(ending for ending, form in TEMPLATES.items() if form is forms.template)
    for item in items:
        write_changed(place / f"{item.stem}{suffix}", template(item.problem, forms.template, student))
    write_changed(keys / f"key{_ending(forms.sheet)}", written(with_key, forms.sheet))
    for variant in variants:
        write_changed(keys / f"{variant.stem}.yaml", variant.text.encode())


def _table(own: Mapping[str, Sequence[Variant]]) -> str:
    """`variants.csv`."""
    out = io.StringIO(newline="")
    write = csv.writer(out, lineterminator="\n")
    write.writerow(("student", "problem", "variant", "drawn", "answer", *COUNTS))
    write.writerows(_rows(own))
    return out.getvalue()


def _counted_of(own: Mapping[str, Sequence[Variant]]) -> dict[tuple[str, str], list[Hardness]]:
    """What was counted, by problem and answer."""
    found: dict[tuple[str, str], list[Hardness]] = {}
    for variants in own.values():
        for variant in variants:
            for name, counted in variant.hardness.items():
                found.setdefault((variant.stem, name), []).append(counted)
    return found


def _rows(own: Mapping[str, Sequence[Variant]]) -> Iterator[tuple[object, ...]]:
    for student, variants in own.items():
        for variant in variants:
            drawn = "; ".join(f"{path}: {text}" for path, text in variant.drawn.items())
            for name, counted in variant.hardness.items():
                yield (student, variant.stem, variant.number, drawn, name, *counted.counts)
