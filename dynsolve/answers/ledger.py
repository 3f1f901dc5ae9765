"""What becomes of the equations of a hand-in that were not judged: they wait for a human, or are set aside.

An equation whose left side names what is asked for waits where nothing else answers that, so that no
mark is lost to what was not read; else it is set aside, with its reason.  A picture waits for all that is
missing.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import replace

from dynsolve.answers.submission import PICTURE, NotRecognized
from dynsolve.answers.verdict import JudgedAnswer, Verdict
from dynsolve.quantities.index import Quantities


class Ledger:
    """The equations that were not judged: `not_recognized`, some of which wait, and `set_aside`.

    `refused` could not be read as answers, `explained` are definitions, quotations and what a sentence says.
    """

    def __init__(
        self,
        quantities: Quantities,
        answers: Mapping[str, JudgedAnswer],
        refused: Iterable[NotRecognized],
        explained: Iterable[NotRecognized],
    ) -> None:
        self.quantities = quantities
        given = {name for name, answer in answers.items() if answer.verdict is not Verdict.MISSING}
        asked = {name: {quantities.entry_of(name)[0], *quantities.within(name)} for name in answers}
        absent = {name: names - given for name, names in asked.items() if name not in given}
        known = frozenset[str]().union(*asked.values())
        self.not_recognized = list[NotRecognized]()
        self.set_aside = list[NotRecognized]()
        for one, is_known in (*((r, False) for r in refused), *((e, True) for e in explained)):
            waits = tuple(sorted(n for n, names in absent.items() if not names.isdisjoint(one.answers)))
            of_others = bool(one.answers) and known.isdisjoint(one.answers)
            if one.why == PICTURE:
                self.not_recognized += [replace(one, answers=waits, waits=waits)] if waits else []
            elif waits or not (is_known or of_others or given & set(one.answers)):
                self.not_recognized.append(replace(one, waits=waits))
            else:
                self.set_aside.append(replace(one, answers=tuple(n for n in one.answers if n in known)))

    def waiting(self, answers: Mapping[str, JudgedAnswer]) -> dict[str, JudgedAnswer]:
        """The answers, the missing ones with the last equation, or part, that a human has to look at."""
        found = dict(answers)
        for name, answer in answers.items():
            parts = [answers[p] for p in self.quantities.within(name) if p in answers]
            unread = [part for part in parts if part.verdict is Verdict.UNREADABLE]
            if answer.verdict is Verdict.MISSING and unread:
                fault = f"{unread[0].name}: {unread[0].fault}"
                found[name] = replace(answer, place=unread[0].place, notes=(fault,), fault=fault)
        for one in self.not_recognized:
            for name in one.waits:
                if one.why == PICTURE and found[name].fault:
                    continue
                found[name] = replace(
                    found[name], label=one.label, place=one.place, notes=(one.why,), fault=one.why
                )
        return found
