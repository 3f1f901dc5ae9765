"""The books that steps and reports name: their sections, what a reference means, another edition.

A step has the reference of its formula, `spong("7.1")`; a report lists the books that its references name.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping

from msgspec import Struct

SIGN = "§"
"""What a section's number begins with: a bare 7.2 would read as the number of a step or an equation."""


class Book(Struct, frozen=True):
    """A book: what a step calls it (nothing for the course's own), the edition in full, its sections."""

    name: str
    full: str
    sections: Mapping[str, str]

    def section(self, number: str) -> str:
        """A reference to a section, as it stands beside a formula.

        Raises KeyError for a section that is not in the table.

        >>> spong("7.2.2"), craig("3.5"), siciliano("7.1.3"), mls("6.1.2")
        ('§7.2.2', 'Craig §3.5', 'Siciliano et al. §7.1.3', 'Murray, Li, Sastry §6.1.2')
        """
        if number not in self.sections:
            raise KeyError(f"{self.full}: section {number} is not in the table of citations")
        return f"{self.name} {SIGN}{number}".strip()


SPONG = Book(
    name="",
    full="M. W. Spong, S. Hutchinson, M. Vidyasagar, Robot Modeling and Control, 1st edition, Wiley, 2006",
    sections={
        "2.5.3": "Axis/Angle Representation",
        "2.6": "Rigid Motions",
        "2.7": "Homogeneous Transformations",
        "3.1": "Kinematic Chains",
        "3.2": "Forward Kinematics: The Denavit-Hartenberg Convention",
        "3.3": "Inverse Kinematics",
        "3.3.1": "The General Inverse Kinematics Problem",
        "3.3.2": "Kinematic Decoupling",
        "4.6": "Derivation of the Jacobian",
        "4.6.1": "Angular Velocity",
        "4.6.2": "Linear Velocity",
        "4.6.3": "Combining the Linear and Angular Velocity Jacobians",
        "4.8": "The Analytical Jacobian",
        "4.9": "Singularities",
        "4.10": "Static Force/Torque Relationships",
        "4.11": "Inverse Velocity and Acceleration",
        "4.12": "Manipulability",
        "7.1": "The Euler-Lagrange Equations",
        "7.2": "Kinetic and Potential Energy",
        "7.2.1": "The Inertia Tensor",
        "7.2.2": "Kinetic Energy for an n-Link Robot",
        "7.2.3": "Potential Energy for an n-Link Robot",
        "7.3": "Equations of Motion",
        "7.4": "Some Common Configurations",
        "7.5": "Properties of Robot Dynamic Equations",
        "7.5.1": "Skew Symmetry and Passivity",
        "7.5.2": "Bounds on the Inertia Matrix",
        "7.5.3": "Linearity in the Parameters",
        "7.6": "Newton-Euler Formulation",
    },
)

CRAIG = Book(
    name="Craig",
    full=(
        "J. J. Craig, Introduction to Robotics: Mechanics and Control, 3rd edition, "
        "Pearson Prentice Hall, 2005"
    ),
    sections={
        "3.4": "Convention for Affixing Frames to Links",
        "3.5": "Manipulator Kinematics",
        "4.6": "Pieper's Solution When Three Axes Intersect",
        "5.6": "Velocity Propagation from Link to Link",
        "5.7": "Jacobians",
        "6.5": "Iterative Newton-Euler Dynamic Formulation",
    },
)

SICILIANO = Book(
    name="Siciliano et al.",
    full=(
        "B. Siciliano, L. Sciavicco, L. Villani, G. Oriolo, Robotics: Modelling, Planning and Control, "
        "Springer, 2009"
    ),
    sections={
        "7.1.1": "Computation of Kinetic Energy",
        "7.1.2": "Computation of Potential Energy",
        "7.1.3": "Equations of Motion",
    },
)

LYNCH_PARK = Book(
    name="Lynch and Park",
    full="K. M. Lynch, F. C. Park, Modern Robotics, Cambridge University Press, 2017",
    sections={
        "8.2.1": "Classical Formulation",
        "8.5": "Forward Dynamics of Open Chains",
        "8.6": "Dynamics in the Task Space",
    },
)

MURRAY_LI_SASTRY = Book(
    name="Murray, Li, Sastry",
    full=(
        "R. M. Murray, Z. Li, S. S. Sastry, A Mathematical Introduction to Robotic Manipulation, "
        "CRC Press, 1994"
    ),
    sections={
        "6.1.1": "Pfaffian constraints",
        "6.1.2": "Lagrange multipliers",
        "6.1.3": "Lagrange-d'Alembert formulation",
    },
)

KHALIL_DOMBRE = Book(
    name="Khalil and Dombre",
    full="W. Khalil, E. Dombre, Modeling, Identification and Control of Robots, Hermes Penton, 2002",
    sections={"9.4": "Determination of the Base Inertial Parameters"},
)

GAUTIER_KHALIL = (
    "M. Gautier, W. Khalil, Direct calculation of minimum set of inertial parameters of serial robots, "
    "IEEE Transactions on Robotics and Automation 6, 1990"
)
"""How base parameters of serial arms are found; cited in full where they are told of."""

SLOTINE_LI = Book(
    name="Slotine and Li",
    full="J.-J. E. Slotine, W. Li, Applied Nonlinear Control, Prentice Hall, 1991",
    sections={
        "3.1": "Nonlinear Systems and Equilibrium Points",
        "3.3": "Linearization and Local Stability",
        "3.4": "Lyapunov's Direct Method",
        "9.2": "Adaptive Robot Trajectory Control",
    },
)

GOLDSTEIN = Book(
    name="Goldstein, Poole, Safko",
    full="H. Goldstein, C. Poole, J. Safko, Classical Mechanics, 3rd edition, Addison Wesley, 2002",
    sections={"2.7": "Energy Function and the Conservation of Energy"},
)

BOOKS = (SPONG, CRAIG, SICILIANO, LYNCH_PARK, MURRAY_LI_SASTRY, KHALIL_DOMBRE, SLOTINE_LI, GOLDSTEIN)

GIVEN, GEOMETRY = "given", "geometry"
"""What stands in the place of a section where a formula is the problem's own, or needs no book."""

_IN_A_LIST = "Spong et al."
"""What the course's own book is called where no report names it at its start."""


spong, craig, siciliano, mls = (book.section for book in (SPONG, CRAIG, SICILIANO, MURRAY_LI_SASTRY))
"""References to these books by the number of a section."""


def by_itself(source: str) -> str:
    """A reference that is understood without the beginning of a report.

    >>> by_itself("§7.1"), by_itself("Craig §3.5"), by_itself("by the integrals of §7.2.1")
    ('Spong et al. §7.1', 'Craig §3.5', 'by the integrals of Spong et al. §7.2.1')
    """
    named = any(book.name and book.name in source for book in BOOKS)
    return source if named else source.replace(SIGN, f"{_IN_A_LIST} {SIGN}")


_MOVED = {"3.3": "5", "3.3.1": "5.1", "3.3.2": "5.2"}
"""Inverse kinematics, a section of the first edition, is a chapter of the second."""


def in_second_edition(number: str) -> str:
    """Where the second edition of the course's book has a section of the first.

    Its chapter 5 is inverse kinematics and its chapter 6 dynamics, with the sections of chapter 7 before.

    >>> in_second_edition("7.2.3"), in_second_edition("3.3.2"), in_second_edition("4.6.3")
    ('6.2.3', '5.2', '4.6.3')
    """
    chapter, _, rest = number.partition(".")
    return _MOVED.get(number) or (f"6.{rest}" if chapter == "7" else number)


_REFERENCE = re.compile(
    f"({'|'.join(re.escape(book.name) for book in BOOKS if book.name)})? ?{SIGN}([0-9.]*[0-9])"
)


def of_second_edition(text: str) -> str:
    """Words in which the course's book and its sections are those of its second edition.

    >>> of_second_edition("§7.2.3 writes a plus; Siciliano et al. §7.1.2 does not")
    '§6.2.3 writes a plus; Siciliano et al. §7.1.2 does not'
    """

    def renumbered(match: re.Match[str]) -> str:
        return match[0] if match[1] else match[0].replace(match[2], in_second_edition(match[2]))

    return _REFERENCE.sub(renumbered, text).replace("1st edition, Wiley, 2006", "2nd edition, Wiley, 2020")


def titled(sources: Iterable[str]) -> Iterator[str]:
    """The sections of the course's book that references name, with their titles.

    >>> list(titled(["§7.1", "Craig §3.5", "from §7.3", "§7.1"]))
    ['§7.1 The Euler-Lagrange Equations', '§7.3 Equations of Motion']
    """
    told = {match[2] for source in sources for match in _REFERENCE.finditer(source) if not match[1]}
    return (f"{SIGN}{number} {title}" for number, title in SPONG.sections.items() if number in told)


def cited(sources: Iterable[str]) -> Iterator[Book]:
    """The books that references name, in the order of the table."""
    named = [book.name for book in BOOKS if book.name]
    told = [source for source in sources if SIGN in source]
    own = any(not any(name in source for name in named) for source in told)  # the course's has no name
    return (book for book in BOOKS if (any(book.name in source for source in told) if book.name else own))
