"""Problem files: YAML text -> `Problem` with its `Robot`, every fault located.

`load(path)` and `read_problem(text)` are the way in.  The way of a file:

    bytes            yaml_nodes     text, UTF-8 and visible; `Faults` collects what is wrong
      -> YAML nodes                 lists, mappings and scalars that know their place; what YAML's parser
                                    complains of, with a remedy
      -> parsed      kinds          the keys of a mapping, and what kind of value each holds
                     cells          an expression where it stands; those in which rates (x', x_dot) or the
                                    places of points (tip.x) may stand
                     table          `dh`: rows, stars, coordinates, those that motors bring: `turns: thm1*`
                     drawing        `axes`, `tip`, `zero`: joint axes as they are drawn, and their table
                     bodies         `masses`; a point of a link: `center`, `at`, also as it is drawn
                     density        `density` of a shape: its integrals
                     mechanism      `model`: bodies by their positions, or given energies, up to the robot;
                                    `candidates`, `assume`, `chain`
                     base           `gravity`, `base`, rotations `Rz(90deg) Rx(30deg)`
                     questions      `points`, `task`, what each question reads in its folder, up to the robot
                     state          `state`
                     decoder        mappings and lists, by the kinds of their keys and items
                     acting         what acts, each kind by its own folder in `acts`, up to the robot
                     exercise       `find`, `marks`, `values`, `units`, `remarks`, `text`
                     variation      `vary`, and the text of the file with a choice made
      -> Robot       parsed         the whole file: one name is one thing; the ring that holds everything
                     values         each cell in the ring, points, masses and tensors
                     build          joints and bodies
      -> Problem     model          the robot, and what the exercise says about it: `also`, `strict`

`reader` goes this way; each step reports what it finds and goes on with what is sound.
Which keys there are is said once, in `specification`, `model_keys`, `kinematic_keys` and the folders of
`dynsolve.questions` and `dynsolve.acts` (in terms of `kinds`); from there come the reader's keys, and in
`schema` the JSON Schema, the file of `dynsolve new` and the tables of the documentation.  `lint` finds what
is no fault but deserves a look, `reader` goes the whole way, and finds the problems that come with dynsolve.

To add a key, write its record in `specification` and read it in the file of its part
above; to add a kind of value, write its class in `kinds`.

The names of this module are resolved lazily, so that the schema costs no more than it needs.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from dynsolve.problem.model import FilePlace, Problem
    from dynsolve.problem.reader import load, read_problem

__all__ = ["FilePlace", "Problem", "load", "read_problem"]

_HOMES = {"FilePlace": "model", "Problem": "model", "load": "reader", "read_problem": "reader"}


def __getattr__(name: str) -> Any:
    if name not in _HOMES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    from importlib import import_module

    return getattr(import_module(f"{__name__}.{_HOMES[name]}"), name)
