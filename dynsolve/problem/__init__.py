"""Problem files: YAML text -> `Problem` with its `Robot`, every fault located.

`load(path)` and `read_problem(text)` are the way in.  The way of a file:

    bytes            source         text, UTF-8 and visible; `Faults` collects what is wrong
      -> YAML nodes  yaml_nodes     lists, mappings and scalars that know their place
                     yaml_errors    what YAML's parser complains of, with a remedy
      -> parsed      fields         the keys of a mapping, and what kind of value each holds
                     cells          an expression where it stands
                     table, linear  `dh`: rows, stars, coordinates
                     drawing        `axes`, `tip`, `zero`: joint axes as they are drawn
                     framing        the table and the base of a drawing
                     drawn_places   points of a drawing, in the frames of their links
                     bodies         `masses`
                     density        `density` of a shape: its integrals
                     mechanism      `model`: bodies by their positions, or given energies
                     candidates     `candidates`, `assume`, `chain`
                     rate_cells     an expression in which rates may stand: x', x_dot
                     base           `gravity`, `base`
                     places         a point of a link: `center`, `at`
                     questions      what is asked around the model: `points`, `task`
                     reach          what the task is to be, joint ranges: `reach`, `limits`
                     model_questions
                                    what is asked of the equations of motion: `parameters`
                     constraints, rate_cells
                                    `constraints`; expressions in which rates stand
                     point_expressions
                                    expressions in which tip.x stands
                     loads          `forces`
                     state          `state`
                     weights        `weights`
                     actions        `friction`, `springs`, `dampers`, `motors`, `passive`
                     motor_coordinates
                                    the coordinates that motors bring: `turns: thm1*`
                     rotations      `Rz(90deg) Rx(30deg)`
                     accepted_tables
                                    `also`, `strict`
                     exercise       `find`, `marks`, `values`, `units`
                     answer_names   what the field calls the answers
                     remarks        `remarks`
                     parsed_file    all of them together
      -> checked     symbols        one name is one thing
      -> Robot       values         the ring that holds everything, and each cell in it
                     positions      where the points of links are
                     build          joints and bodies
                     body_values    the mass and the tensor of a body
                     candidates_build
                                    matrices that are to be judged
                     mechanism_build
                                    bodies by their positions, given energies
                     targets        `reach` and `limits` with numbers
                     questions_build
                                    points, the task, forces
                     actions_build  friction, springs, dampers, motors
      -> Problem     model          the robot, and what the exercise says about it

`reader` goes this way; each step reports what it finds and goes on with what is sound.
Which keys there are is said once, in `specification`, `action_keys`, `kinematic_keys`, `constraint_keys`,
`mechanism_keys`, `definite_keys` and `model_keys` (in terms of `kinds` and `value_kinds`); from there come
the reader's keys, the JSON Schema (`schema`), the file of `dynsolve new` and the tables of
the documentation (`documentation`).  `lint` and `lint_geometry` find what is no fault but deserves a look,
`library` the problems that come with dynsolve.

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
