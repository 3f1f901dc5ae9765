"""Mechanisms as strangers type them in: problem files drawn from a seed.

Every key of the problem file occurs, and keys meet as they do in exercises: `stranger(seed)` is the
file as YAML reads it, a dictionary, and `written` its text.  What is drawn is meant to be valid; the share
that is refused all the same is printed by `python -m tests.strangers`.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from random import Random
from typing import Any

import yaml

Problem = dict[str, Any]

ROTATIONS = [
    "Rx(90deg)",
    "Rz(90deg) Rx(90deg)",
    "Ry(90deg)",
    "Rx(-90deg)",
    "Rx(180deg)",
    "Rz(30deg)",
    "Ry(beta)",
]
COURSE = [
    "A",
    "H",
    "J",
    "Jv",
    "Jw",
    "rc",
    "v",
    "w",
    "I",
    "P",
    "Kv",
    "Kw",
    "K",
    "L",
    "dLdqd",
    "ddt",
    "dLdq",
    "tau",
    "D",
    "C",
    "g",
    "c",
    "Cqd",
]

FAMILIES = {"A", "H", "rc", "v", "w", "I", "Kv", "Kw", "dLdqd", "ddt", "dLdq", "c"}
"""Names in `find` that stand for several answers."""


def written(problem: Problem) -> str:
    """The text of a problem file."""
    return yaml.dump(
        problem, Dumper=_Plain, sort_keys=False, allow_unicode=True, default_flow_style=None, width=110
    )


class _Plain(yaml.SafeDumper):
    """YAML without anchors, for which a problem file has no use."""

    def ignore_aliases(self, data: object) -> bool:
        return True


def stranger(seed: int) -> Problem:
    """The mechanism of a seed; of one in seven the sections are those of the second edition.

    Parameters of one in six are called as the solution itself calls something.
    """
    problem = _Stranger(Random(seed)).problem()
    if seed % 6 == 4:
        problem = renamed(problem, Random(seed))[0]
    return problem | {"edition": "2"} if seed % 7 == 0 else problem


# -- parameters that are called as the solution calls something ----------------------------------------

SOLUTIONS_OWN = (
    "r1 r2 r3 r11 rd1 x y z xc zp f1 f2 F1 tau1 tau2 u1 u2 u11 lambda lambda1 mu1 eta1 eta2 h sigma1 sigma2 "
    "h1 A B D X Y psi chi s c t k i j n E F N Q1 Delta1 U V W G H w C S T rho Q q1r P1 K1 Kv1 d11 c12 c112 "
    "g1 n12 theta d a alpha A1 z1 o1 l m mi xtip V1 tauf1 e1 theta1 d1 a1"
).split()
"""What a solution calls something of its own."""

_WORD = re.compile(r"[A-Za-z]\w*")
_PARAMETER = re.compile(
    r"(?:L|a|l|h|m|b|I|J|M|R|k0?|fv|F|Fx|Fy|vx|ax|l0|g)\d*"
    r"|(?:lc|fc|rho|u|z|y|r|e|kr|Im|b|w)\d+"
    r"|I\d(?:xx|yy|zz)"
)
"""The parameters that are given others' names."""

_NAMING = ("title", "source", "find", "marks", "remarks", "reach", "candidates", "assume", "coordinates")
"""Keys in which no parameter stands, or one that is asked for by its name."""


def renamed(problem: Problem, random: Random) -> tuple[Problem, dict[str, str]]:
    """A problem with some of its parameters called otherwise, and their names."""
    parts = {key: value for key, value in problem.items() if key not in _NAMING}
    words = set(_WORD.findall(written(problem)))
    old = sorted({word for word in _words(parts) if _PARAMETER.fullmatch(word)})
    free = [name for name in SOLUTIONS_OWN if name not in words]
    chosen = random.sample(old, min(len(old), random.randint(1, 4)))
    names = dict(zip(chosen, random.sample(free, len(chosen)), strict=True))
    return problem | {key: _put(value, names) for key, value in parts.items()}, names


def _words(part: Any) -> set[str]:
    """The words in the formulas of a part of a problem."""
    if isinstance(part, dict):
        return set().union(*(_words(value) for key, value in part.items() if key not in ("name", "units")))
    if isinstance(part, list):
        return set().union(*map(_words, part))
    return set(_WORD.findall(part)) if isinstance(part, str) else set()


def _put(part: Any, names: dict[str, str]) -> Any:
    """A part of a problem with these names; of keys those under `values` and `units` are names."""
    if isinstance(part, dict):
        return {
            names.get(key, key) if isinstance(value, str) and _PARAMETER.fullmatch(key) else key: (
                value if key == "name" else _put(value, names)
            )
            for key, value in part.items()
        }
    if isinstance(part, list):
        return [_put(value, names) for value in part]
    return _WORD.sub(lambda match: names.get(match[0], match[0]), part) if isinstance(part, str) else part


class _Stranger:
    """One file in the making.  `joints` are the coordinates' names with their types, in order."""

    def __init__(self, random: Random) -> None:
        self.random = random
        self.file: Problem = {}
        self.joints: list[tuple[str, str]] = []
        self.rows: list[Problem] = []

    def chance(self, share: float) -> bool:
        return self.random.random() < share

    def one(self, choices: Sequence[Any]) -> Any:
        return self.random.choice(choices)

    def some(self, choices: Sequence[Any], most: int) -> list[Any]:
        return self.random.sample(list(choices), min(self.random.randint(1, most), len(choices)))

    def problem(self) -> Problem:
        kinds: list[tuple[float, Callable[[], None]]] = [
            (0.72, self.table),
            (0.09, self.drawing),
            (0.1, self.bodies_by_position),
            (0.06, self.by_energies),
            (0.03, self.candidates),
            (0.04, self.held_together),
        ]
        if self.chance(0.7):
            self.file["title"] = self.one(
                ["My arm", "Exercise 3: the robot", "RPR & friends, 50 % done", "Übung #2"]
            )
        if self.chance(0.2):
            self.file["source"] = self.one(["own notes", "Exam 2019, task 2 (a_b)", "p. 12 {second edition}"])
        (draw,) = self.random.choices([draw for _, draw in kinds], [weight for weight, _ in kinds])
        draw()
        self.respell()
        return self.file

    def respell(self) -> None:
        """Coordinates as keys are spelled otherwise than in the table now and then."""
        for key in ("friction", "limits", "state", "weights", "linearize", "steady"):
            if isinstance(self.file.get(key), dict) and self.chance(0.3):
                spelled = str.maketrans({"θ": "theta"}) if self.chance(0.5) else None
                self.file[key] = {
                    name.translate(spelled)
                    if spelled
                    else name.replace("theta", "θ").replace("phi", "φ"): value
                    for name, value in self.file[key].items()
                }

    # -- arms ----------------------------------------------------------------------------------------

    def table(self) -> None:
        if self.chance(0.3):
            self.file["convention"] = self.one(["modified", "modified", "standard"])
        self.place()
        self.draw_rows()
        self.file["dh"] = self.rows
        if len(self.joints) > 1 and self.chance(0.05):
            self.file["coordinates"] = [name for name, _ in reversed(self.joints)]
        if self.chance(0.85):
            self.draw_masses()
        if "masses" in self.file and self.chance(0.35):
            self.draw_actions()
        if self.chance(0.6):
            self.draw_questions()
        self.finish()

    def place(self) -> None:
        gravity = self.one(
            [
                None,
                None,
                None,
                [0, "-g", 0],
                [0, "-g", 0],
                ["g", 0, 0],
                [0, 0, "-9.81"],
                "none",
                ["g*sin(beta)", 0, "-g*cos(beta)"],
                [0, 0, "-g"],
            ]
        )
        if gravity is not None:
            self.file["gravity"] = gravity
        if self.chance(0.15):
            turned = self.one(ROTATIONS)
            self.file["base"] = {"rotate": turned, "move": [0, 0, "h"]} if self.chance(0.4) else turned

    def draw_rows(self) -> None:
        count = self.random.choices([1, 2, 3, 4, 5, 6, 7], [14, 30, 32, 17, 3, 2, 1])[0]
        style = self.one([("q", "q"), ("theta", "d"), ("θ", "d"), ("q", "d"), ("phi", "x")])
        lengths = self.one(
            [self.numbered, self.numbered, self.numbered, self.alike, self.numbers, self.mixed]
        )
        angles = self.one(
            [
                ["0", "90deg", "-90deg"],
                ["0"],
                ["0", "90deg"],
                ["0", "90deg", "-90deg", "180deg"],
                ["0", "90deg", "45deg"],
                ["0", "30deg", "beta"],
            ]
        )
        plain = self.chance(0.6)
        while len(self.joints) < count:
            place = len(self.rows) + 1
            row: Problem = {}
            kind = self.random.choices(["revolute", "prismatic", "fixed"], [70, 27, 3 if count < 5 else 0])[0]
            row["theta"] = "0" if plain or (kind == "revolute" and self.chance(0.7)) else self.one(angles)
            for column in ("d", "a"):
                row[column] = lengths(column, place) if self.chance(0.45 if column == "d" else 0.5) else "0"
            row["alpha"] = self.one(angles)
            if kind != "fixed":
                name = f"{style[kind == 'prismatic']}{len(self.joints) + 1}"
                column = "theta" if kind == "revolute" else "d"
                row[column] = self.variable(name, kind, row[column])
                self.joints.append((name, kind))
            if place > 1 and count < 5 and self.chance(0.04):
                row["from"] = self.random.randint(0, place - 2)
            self.rows.append({key: value for key, value in row.items() if value != "0" or self.chance(0.3)})

    def variable(self, name: str, kind: str, constant: str) -> str:
        """A joint variable with what is added to it, driven from afar now and then."""
        before = [other for other, its in self.joints if its == kind]
        text = f"{name}*"
        if before and self.chance(0.05):
            text += self.one([f" - {before[-1]}*", f" + {before[-1]}*", f" - {before[-1]}*/2"])
        return text if constant == "0" else f"{text} + {constant}".replace("+ -", "- ")

    @staticmethod
    def numbered(column: str, place: int) -> str:
        return f"{'L' if column == 'd' else 'a'}{place}"

    @staticmethod
    def alike(column: str, place: int) -> str:
        return "L"

    def numbers(self, column: str, place: int) -> str:
        return self.one(["0.4", "1/4", "0.35", "1", "2"])

    def mixed(self, column: str, place: int) -> str:
        return self.one([f"l{place}", f"-l{place}", f"l{place}/2", "0.3", "l", f"l{place} + h"])

    # -- what has mass -------------------------------------------------------------------------------

    def draw_masses(self) -> None:
        """All alike, as students write them, or all different, or some on some links."""
        links = [i for i, row in enumerate(self.rows, 1) if "*" in str(row)]
        each = self.one(["alike", "alike", "different", "some"])
        style = self.one([None, None, "m", "numbers"])
        body = self.body_kind()
        masses = []
        if each == "some":
            links = sorted(self.random.choices(links, k=self.random.randint(1, 3)))
        for place, link in enumerate(links, 1):
            kind = body if each == "alike" else self.body_kind()
            masses.append(self.body(place, link, kind, style))
        self.file["masses"] = masses

    def body_kind(self) -> Problem:
        """What bodies that are alike share: centre, shape or tensor, axes."""
        shapes = [
            "none",
            "none",
            "point",
            "box",
            "cylinder",
            "hollow_cylinder",
            "rod",
            "disk",
            "sphere",
            "shell",
            "zz",
            "xyz",
            "full",
        ]
        return {
            "center": self.one(
                ["midpoint", "midpoint", "tip", "tip", "near", "along", "origin", "vector", "drop"]
            ),
            "extent": self.one(shapes),
            "axes": self.one([None] * 6 + ["base", "Rx(90deg)", "Rz(90deg) Rx(30deg)"]),
            "about": self.one([None] * 6 + ["origin", "joint"]),
            "numbers": self.chance(0.2),
            "dense": self.chance(0.15),
        }

    def body(self, place: int, link: int, kind: Problem, style: str | None) -> Problem:
        slides, last = self.slides(link), link == len(self.rows)
        modified = self.file.get("convention") == "modified"
        far = not modified or (not last and "from" not in self.rows[link] and not self.slides(link + 1))
        near = modified or not slides
        center = kind["center"]
        if (
            (center in ("midpoint", "along") and not (near and far))
            or (center == "near" and not near)
            or (center == "tip" and not far)
        ):
            center = "origin"
        body: Problem = {
            "mass": {"m": "m", "numbers": self.one(["2", "1.5", "3/2"])}.get(style or "", f"m{place}"),
            "link": link,
            "center": {
                "near": {"near": [f"lc{place}", 0, 0]},
                "along": {"along": self.one(["1/3", "2/3"])},
                "vector": [f"u{place}", 0, f"z{place}"],
                "drop": [0, f"-y{place}", 0],
            }.get(center, center),
        }
        if self.chance(0.05):
            body["name"] = self.one(["p", "a"]) + str(place)
        body |= self.extent(kind, place)
        if isinstance(body.get("shape"), dict) and kind["dense"]:
            self.give_density(body, place, begins=near)
        if kind["extent"] not in ("none", "point"):
            if kind["axes"]:
                body["axes"] = kind["axes"]
            if kind["about"] and "inertia" in body and (kind["about"] == "origin" or near):
                body["about"] = kind["about"]
        return body

    def slides(self, link: int) -> bool:
        return "*" in str(self.rows[link - 1].get("d", ""))

    def give_density(self, body: Problem, place: int, begins: bool) -> None:
        """A density in place of the mass: a constant, or a polynomial along the axis."""
        ((kind, sizes),) = body["shape"].items()
        densities = [f"rho{place}", "rho0", "2"]
        if kind != "disk":
            densities += ["rho0*(1 + x)", "rho0*(1 + x/b)", "rho0*x^2", "1 + 2*x"]
        body["shape"] = {kind: {"axis": self.one("xyz"), **sizes, "density": self.one(densities)}}
        del body["mass"]
        if begins and self.chance(0.5):
            del body["center"]

    def extent(self, kind: Problem, place: int) -> Problem:
        size = (
            (lambda letter: self.one(["0.1", "1/5"]))
            if kind["numbers"]
            else (lambda letter: f"{letter}{place}")
        )
        axis = self.one("xyz")
        shapes: dict[str, Any] = {
            "point": "point",
            "box": {"box": {"x": size("b"), "y": size("b"), "z": size("e")}},
            "cylinder": {"cylinder": {"radius": size("r"), "length": size("b"), "axis": axis}},
            "hollow_cylinder": {
                "hollow_cylinder": {"outer": f"2*r{place}", "inner": f"r{place}", "length": "b", "axis": axis}
            },
            "rod": {"rod": {"length": size("b"), "axis": axis}},
            "disk": {"disk": {"radius": size("r"), "axis": axis}},
            "sphere": {"sphere": {"radius": size("r")}},
            "shell": {"shell": {"radius": size("r")}},
        }
        tensors: dict[str, Any] = {
            "zz": {"zz": f"I{place}"},
            "xyz": {"xx": f"I{place}xx", "yy": f"I{place}yy", "zz": f"I{place}zz"},
            "full": {"xx": f"I{place}", "yy": f"2*I{place}", "zz": f"I{place}", "xy": f"-I{place}/4"},
        }
        if kind["extent"] in shapes:
            return {"shape": shapes[kind["extent"]]}
        return {"inertia": tensors[kind["extent"]]} if kind["extent"] in tensors else {}

    # -- what acts on the joints ---------------------------------------------------------------------

    def draw_actions(self) -> None:
        names = [name for name, _ in self.joints]
        same = self.one(["fv", None])
        if self.chance(0.5):
            self.file["friction"] = {
                name: self.one(
                    [
                        same or f"fv{i}",
                        same or f"fv{i}",
                        {"viscous": f"fv{i}", "coulomb": f"fc{i}"},
                        {"coulomb": f"fc{i}"},
                        "0.2",
                    ]
                )
                for i, name in enumerate(names, 1)
                if self.chance(0.7)
            } or {names[0]: "fv"}
        if self.chance(0.45):
            self.file["springs"] = [self.spring(i, names) for i in range(1, self.random.randint(1, 2) + 1)]
        if self.chance(0.25):
            self.file["dampers"] = [{"damping": "cd", "of": self.linear(names)}]
        if self.chance(0.25):
            self.file["motors"] = [
                self.motor(i, name) for i, name in enumerate(names, 1) if self.chance(0.6)
            ] or [self.motor(1, names[0])]
        if len(names) > 1 and self.chance(0.25):
            self.file["passive"] = [self.one(names)]

    def linear(self, names: Sequence[str]) -> str:
        kinds = dict(self.joints)
        name = self.one(names)
        others = [other for other in names if other != name and kinds[other] == kinds[name]]
        return f"{name} - {self.one(others)}" if others and self.chance(0.3) else str(name)

    def spring(self, place: int, names: Sequence[str]) -> Problem:
        turning = [name for name, kind in self.joints if kind == "revolute"]
        if turning and self.chance(0.15):
            angle = self.one(turning)
            return {"energy": f"k{place}*(1 - cos({self.one([angle, f'{angle}/2', f'2*{angle}'])}))"}
        spring: Problem = {"stiffness": self.one([f"k{place}", "k", "40"]), "of": self.linear(names)}
        if self.chance(0.4):
            of_angle = dict(self.joints)[spring["of"].split()[0]] == "revolute"
            spring["rest"] = self.one(["30deg", "delta"] if of_angle else ["l0", "0.1"])
        return spring

    def motor(self, place: int, name: str) -> Problem:
        motor: Problem = {"turns": name, "inertia": self.one([f"Im{place}", "Im", "0.01"])}
        if dict(self.joints)[name] == "revolute" and self.chance(0.1) and self.rows:
            motor["turns"] = f"thm{place}*"
        if self.chance(0.6):
            motor["ratio"] = self.one([f"kr{place}", "50"])
        if place > 1 and self.rows and self.chance(0.3) and place - 1 <= len(self.rows):
            motor |= {"carrier": place - 1} | ({"axis": self.one("xyz")} if self.chance(0.5) else {})
        return motor

    # -- what is asked -------------------------------------------------------------------------------

    def draw_questions(self) -> None:
        """Some of the questions that apply, each with the keys that it needs."""
        dynamic = "masses" in self.file
        turned = any(
            "inertia" in body or body.get("shape", "point") != "point" for body in self.file.get("masses", [])
        )
        course = [name for name in COURSE if turned or name not in ("I", "Kw")]
        find = self.some(course if dynamic else COURSE[:5], 5) if self.chance(0.5) else []
        kinds: list[Callable[[], list[str]]] = [
            self.points,
            self.task,
            self.task,
            self.inverse,
            self.rates,
            self.statics,
        ]
        if dynamic:
            kinds += [
                self.parameters,
                self.equilibria,
                self.near,
                self.forward,
                self.constraints,
                self.recursions,
            ]
        for ask in self.random.sample(kinds, self.one([1, 1, 2, 3])):
            find += ask()
        names = [name for name in dict.fromkeys(find) if not ("v" in find and name == "vP")]
        whole = [name for name in names if name not in FAMILIES]
        if self.chance(0.15):
            names = whole or ["J"]
            self.file["marks"] = {name: self.random.randint(1, 6) for name in names}
        else:
            self.file["find"] = names
        if whole and self.chance(0.1):
            self.file["remarks"] = {
                whole[0]: self.one(["Mind the sign.", ["One line,", "and another: 50 % & more."]])
            }

    def points(self) -> list[str]:
        at = self.one([{"near": ["p", 0, 0]}, "tip", "origin", ["px", 0, "pz"]])
        link = self.random.randint(1, len(self.rows))
        if self.slides(link) or self.file.get("convention") == "modified":
            at = "origin"
        self.file["points"] = {"P": {"link": link, "at": at} | ({"in": "link"} if self.chance(0.2) else {})}
        return self.some(["pP", "vP", "JvP", "JwP"], 4)

    def coordinates_of_task(self) -> list[str]:
        kinds = dict(self.joints)
        turns = [name for name in kinds if kinds[name] == "revolute"]
        return [
            "tip.x",
            "tip.y",
            "tip.z",
            *(["P.x"] if "points" in self.file else []),
            " + ".join(turns) or "tip.x",
        ]

    def set_task(self) -> None:
        if "task" not in self.file and self.chance(0.6):
            self.file["task"] = "twist" if self.chance(0.15) else self.some(self.coordinates_of_task(), 3)

    def task(self) -> list[str]:
        self.set_task()
        known = ["Jr", "det", "singular", "Jr_dot"] + (["r"] if self.file.get("task") != "twist" else [])
        return self.some(known, 4)

    def inverse(self) -> list[str]:
        if self.file.get("task") == "twist":
            return ["Jr"]
        self.set_task()
        if self.file.get("task") == "twist":
            self.file["task"] = "pose"
        task = self.file.get("task")
        if isinstance(task, list) and self.chance(0.5):
            self.file["reach"] = self.random.sample(["px", "py", "phi", "w"], len(task))
        if self.chance(0.2):
            self.file["limits"] = {
                name: [0, 2] if kind == "prismatic" else ["-90deg", "90deg"] for name, kind in self.joints[:2]
            }
        if self.chance(0.2):
            self.file["branches"] = "all"
        return ["inverse"]

    def state(self) -> None:
        if self.chance(0.7):
            values = {"revolute": ["0", "90deg", "30deg", "-90deg"], "prismatic": ["1/2", "L", "1"]}
            self.file["state"] = {
                name: self.one(values[kind]) for name, kind in self.joints if self.chance(0.8)
            } or {self.joints[0][0]: "0" if self.joints[0][1] == "revolute" else "1"}

    def rates(self) -> list[str]:
        self.state()
        self.set_task()
        task = self.file.get("task")
        if not isinstance(task, list):
            return self.some(["nullspace", "rangespace", "lost"], 3)
        self.file["velocity"] = [self.one(["vx", "1", "0"]) for _ in task]
        self.file["acceleration"] = [self.one(["0", "ax"]) for _ in task]
        if self.chance(0.15):
            self.file["weights"] = {
                name: self.one(["2", f"w{i}"]) for i, (name, _) in enumerate(self.joints, 1)
            }
        return self.some(["qd", "qdd", "nullspace", "rangespace", "lost"], 3)

    def statics(self) -> list[str]:
        self.state()
        force: Problem = {
            "link": len(self.rows),
            "at": "origin",
            "force": self.one([["Fx", "Fy", 0], [0, 0, "-F"]]),
        }
        if self.chance(0.3):
            force["moment"] = [0, 0, "Mz"]
        if self.chance(0.3):
            force["in"] = self.one(["link", "Rz(45deg)", "Ry(90deg) Rx(-30deg)"])
        if self.chance(0.2):
            force["by"] = "robot"
        self.file["forces"] = [force]
        return ["Q", "tau_static"] if "masses" in self.file else ["Q"]

    def parameters(self) -> list[str]:
        if self.chance(0.5):
            known = self.letters()[:2] or (["g"] if self.weighs() else [])
            self.file["parameters"] = {"known": known} if known else {}
        return self.one([["Y", "a"], ["YM", "aM"], ["Yg", "ag"], ["Y", "a", "Yr"]])

    def weighs(self) -> bool:
        """Whether g is a letter of the file."""
        gravity = self.file.get("gravity", "none" if "model" in self.file else [0, 0, "-g"])
        return gravity != "none" and "g" in str(gravity)

    def letters(self) -> list[str]:
        """Letters of the table."""
        cells = [str(cell) for row in self.rows for cell in row.values()]
        return sorted({cell for cell in cells if cell.isalnum() and cell[0].isalpha() and cell != "beta"})

    def equilibria(self) -> list[str]:
        if "passive" in self.file and self.chance(0.5):
            self.file["inputs"] = "given"
        turning = [name for name, kind in self.joints if kind == "revolute"]
        if turning and self.chance(0.15):
            self.file["steady"] = {turning[0]: "W"}
        asked = self.one(["equilibria", "equilibria", "balance"])
        if asked == "balance" and self.chance(0.3):
            self.file["balance"] = {"g": ["g0"] + ["0"] * (len(self.joints) - 1)}
        return [asked]

    def near(self) -> list[str]:
        self.file["linearize"] = {
            name: self.one(["0", "90deg"]) if kind == "revolute" else self.one(["0", "1"])
            for name, kind in self.joints
        }
        return ["linear_A", "linear_B"]

    def forward(self) -> list[str]:
        if self.file.get("task") not in ("twist", "pose"):
            return self.one([["qdd_forward"], ["Lambda"], ["qdd_forward", "Lambda"]])
        return ["qdd_forward"]

    def constraints(self) -> list[str]:
        name, kind = self.one(self.joints)
        kinds = ["tip.x - k0", "tip.y", f"{name}" + (" - beta" if kind == "revolute" else " - k0")]
        self.file["constraints"] = [self.one([self.one(kinds), {"rates": f"{name}'*2"}])]
        return self.some(["Ac", "Ac_dot", "lambda", "reduced"], 3)

    def recursions(self) -> list[str]:
        links = [f"{name}{len(self.rows)}" for name in ("wl", "wdl", "fl", "nl")]
        bodies = [f"acl{body.get('name', place)}" for place, body in enumerate(self.file["masses"], 1)]
        return self.some(links + bodies, 3)

    # -- numbers, units, names -----------------------------------------------------------------------

    def finish(self) -> None:
        if self.chance(0.35) and self.letters():
            letters = self.letters()
            if self.chance(0.4):
                letters = letters[:1]
            self.file["values"] = {name: self.one(["0.4", "1/4", "2", "0.35"]) for name in letters}
            if "masses" in self.file and self.weighs():
                self.file["values"]["g"] = "9.81"
            if self.chance(0.3):
                self.file["units"] = {letters[0]: "m"}

    # -- drawings, mechanisms, matrices --------------------------------------------------------------

    def drawing(self) -> None:
        """Joint axes along those of the world, now and then aslant, each a link further than the last."""
        if self.chance(0.3):
            self.file["convention"] = "modified"
        directions = [[0, 0, 1], [0, 1, 0], [1, 0, 0], [0, -1, 0], ["cos(30deg)", 0, "sin(30deg)"]]
        place: list[list[str]] = [[], [], []]
        axes = []
        for i in range(1, self.one([1, 2, 2, 3, 3, 4]) + 1):
            through = [" + ".join(parts) or "0" for parts in place]
            direction = self.random.choices(directions, [4, 3, 2, 2, 0.5])[0]
            if self.chance(0.7):
                axes.append({"turn": f"theta{i}", "about": direction, "through": through})
                self.joints.append((f"theta{i}", "revolute"))
            else:
                axes.append({"slide": f"d{i}", "along": direction, "through": through})
                self.joints.append((f"d{i}", "prismatic"))
            place[self.one([0, 0, 2, 1])].append(self.one([f"L{i}", f"L{i}", f"{i}"]))
        self.file |= {"axes": axes, "tip": [" + ".join(parts) or "0" for parts in place]}
        if self.chance(0.5):
            self.file["zero"] = "drawn"
        self.rows = [{"theta": "*"} if kind == "revolute" else {"d": "*"} for _, kind in self.joints]
        if self.chance(0.5):
            count = len(self.joints)
            self.file["masses"] = [
                {"mass": f"m{i}", "link": i, "center": "origin"} for i in range(1, count + 1)
            ]
        find = self.one([["DH"], ["DH", "A", "H"], ["DH", "Jv", "J"], []])
        if find:
            self.file["find"] = find + (["D", "g"] if "masses" in self.file else [])
        if "masses" in self.file and self.chance(0.3):
            self.draw_actions()
            self.file.pop("motors", None)

    def bodies_by_position(self) -> None:
        """Masses by their positions, as mechanics courses give them."""
        self.file["gravity"] = self.one([[0, "-g", 0], [0, "-g", 0], "none", [0, 0, "-g"], ["g", 0, 0]])
        x, th = self.one(["x", "s"]), self.one(["theta", "phi"])
        ways: list[tuple[dict[str, str], list[Problem]]] = [
            (
                {x: "prismatic", th: "revolute"},
                [
                    {"mass": "M", "at": [x, 0, 0]},
                    {
                        "mass": "m",
                        "at": [f"{x} + l*sin({th})", f"-l*cos({th})", 0],
                        "turn": th,
                        "inertia": {"zz": "I"},
                    },
                ],
            ),
            ({th: "revolute"}, [{"mass": "m", "at": [f"l*sin({th})", f"-l*cos({th})", 0]}]),
            ({th: "revolute"}, [{"mass": "m", "at": [f"R*{th} - R*sin({th})", f"R*cos({th})", 0]}]),
            (
                {x: "prismatic"},
                [
                    {
                        "mass": "m",
                        "at": [f"{x}*cos(30deg)", f"-{x}*sin(30deg)", 0],
                        "turn": f"-{x}/R",
                        "about": [0, 0, 1],
                        "inertia": {"zz": "m*R^2/2"},
                    }
                ],
            ),
            (
                {"th1": "revolute", "th2": "revolute"},
                [
                    {"mass": "m1", "at": ["l1*sin(th1)", "-l1*cos(th1)", 0]},
                    {"mass": "m2", "at": ["l1*sin(th1) + l2*sin(th2)", "-l1*cos(th1) - l2*cos(th2)", 0]},
                ],
            ),
            (
                {"phi": "revolute", "theta": "revolute"},
                [
                    {
                        "mass": "m",
                        "at": ["l*sin(theta)*cos(phi)", "l*sin(theta)*sin(phi)", "-l*cos(theta)"],
                        "turn": [{"by": "phi", "about": [0, 0, 1]}, {"by": "theta", "about": [0, 1, 0]}],
                        "inertia": {"xx": "I", "yy": "I"},
                    }
                ],
            ),
            (
                {x: "prismatic", "y": "prismatic"},
                [
                    {"mass": "m1", "at": [x, 0, 0]},
                    {"mass": "m2", "at": [f"{x} + y", "h", 0]},
                    {"mass": "2", "at": [0, "y", 0]},
                ],
            ),
            (
                {"r": "prismatic", th: "revolute"},
                [
                    {"mass": "m", "at": [f"r*cos({th})", f"r*sin({th})", 0]},
                    {"mass": "M", "at": [0, 0, 0], "turn": th, "inertia": {"zz": "J"}},
                ],
            ),
        ]
        coordinates, bodies = self.one(ways)
        self.joints = list(coordinates.items())
        self.file["model"] = {"coordinates": coordinates, "bodies": bodies}
        if self.chance(0.6):
            self.draw_actions()
        self.ask_of_model()

    def held_together(self) -> None:
        """Equal arms or blocks under constraints that repeat, touch, square or hold whatever falls."""
        self.file["gravity"] = self.one([[0, "-g", 0], [0, "-g", 0], [0, "-9.81", 0], "none"])
        kind, masses = self.one(["revolute", "prismatic"]), self.one([["m", "m"], ["m", "m"], ["m1", "m2"]])
        alike = {
            "revolute": ["l*sin({q})", "-l*cos({q})", 0],
            "prismatic": self.one([[0, "{q}", 0], ["{q}", 0, 0]]),
        }[kind]
        places = [[str(x).format(q=q) if x else 0 for x in alike] for q in "ab"]
        constraints = {
            "revolute": [
                ["a - b"],
                ["a - b - 180deg"],
                ["a + b"],
                ["sin(a) - sin(b)", "cos(a) - cos(b)"],
                ["sin(a) + sin(b)", "cos(a) + cos(b)"],
                ["sin(a)*sin(b)"],
                ["cos(a) + cos(b) - 2"],
                ["cos(a - b) - cos(beta)"],
                ["(a - b)^2"],
            ],
            "prismatic": [
                ["b"],
                ["a + b"],
                ["a - b", "a - b"],
                ["(a - b)^2"],
                ["a^2 + b^2 - R^2"],
                ["a^2 + b^2"],
                ["a^2 + b^2 - R^2", "b - R"],
                [{"rates": "a' - R*b'"}],
            ],
        }
        self.joints = [("a", kind), ("b", kind)]
        self.file["model"] = {
            "coordinates": {"a": kind, "b": kind},
            "bodies": [{"mass": m, "at": at} for m, at in zip(masses, places, strict=True)],
        }
        self.file["constraints"] = self.one(constraints[kind])
        if self.chance(0.3):
            self.file["springs"] = [{"stiffness": "k", "of": "a"}]
        self.file["find"] = ["equilibria", *self.some(["Ac", "lambda", "reduced", "balance"], 3)]

    def ask_of_model(self) -> None:
        if self.chance(0.5):
            find = ["D", "C", "g"]
            kinds = [self.parameters, self.equilibria, self.near, self.forward_of_model, self.held_rate]
            for ask in self.random.sample(kinds, self.one([1, 2])):
                find += ask()
            self.file["find"] = list(dict.fromkeys(find))

    def forward_of_model(self) -> list[str]:
        return ["qdd_forward"]

    def held_rate(self) -> list[str]:
        name, _ = self.one(self.joints)
        self.file["constraints"] = [{"rates": f"{name}'"}]
        return ["Ac", "lambda"]

    def by_energies(self) -> None:
        """A model by D and P, by K and P, or by L."""
        coordinates = self.one([{"q1": "revolute", "q2": "revolute"}, {"q1": "prismatic", "q2": "revolute"}])
        self.joints = list(coordinates.items())
        D = self.one(
            [[["a1", "a2*cos(q2)"], ["a2*cos(q2)", "a3"]], [["a1 + 2*a2*cos(q2)", "a3"], ["a3", "a4"]]]
        )
        K = self.one(["a1*q1'^2/2 + a2*q1'*q2'*cos(q2) + a3*q2'^2/2", "m*(q1'^2 + q2'^2)/2"])
        P = self.one(["b1*cos(q2)", "b1*sin(q2) + b2*q2^2/2", "-m*g0*cos(q2)"])
        model: Problem = {"coordinates": coordinates}
        model |= self.one([{"D": D}, {"D": D, "P": P}, {"K": K, "P": P}, {"K": K}, {"L": f"{K} - ({P})"}])
        self.file["model"] = model
        if self.chance(0.5):
            self.draw_actions()
            self.file.pop("motors", None)
        self.ask_of_model()

    def candidates(self) -> None:
        self.file["coordinates"] = {"q1": self.one(["prismatic", "revolute"]), "q2": "revolute"}
        matrices = {
            "Ma": [["a1", "a2*cos(q2)"], ["a2*cos(q2)", "a3"]],
            "Mb": [["a1 + a2*sin(q2)", "a3"], ["a3", "a4"]],
            "Mc": [["a1", "a2"], ["a3", "a4"]],
            "Md": [["2", "cos(q2)"], ["cos(q2)", "1"]],
            "Me": [["a1", "a2*q2"], ["a2*q2", "a3"]],
            "Mf": [["2", "cos(q2) + sin(q2)"], ["cos(q2) + sin(q2)", "1"]],
            "Mg": [["1 + q1^2", "1 + q1"], ["1 + q1", "2"]],
            "Mh": [["a1 + a2*q1 + a3*q1^2", "0"], ["0", "a4"]],
            "Mi": [["a1*sin(q2)", "0"], ["0", "a2"]],
            "Mj": [["2 + cos(q2)", "sin(q2)"], ["sin(q2)", self.one(["1", "1/2", "a1"])]],
            "Mk": [["a1", "a2*q1"], ["a2*q1", "a2"]],
            "Ml": [["a1 + a2*cos(q2) + a3*cos(q2)^2", "0"], ["0", "a4"]],
        }
        self.file["candidates"] = {name: matrices[name] for name in sorted(self.some(list(matrices), 3))}
        if self.chance(0.5):
            self.file["assume"] = self.one([["a1 > 0"], ["a1 > a2", "a1 > 0"]])
        if self.chance(0.2):
            self.file["chain"] = "relative"
        self.file["find"] = ["definite"]
