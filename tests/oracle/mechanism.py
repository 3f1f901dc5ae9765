"""A model without a table by SymPy's Lagrange's equations; it shares no code with dynsolve."""

from __future__ import annotations

import re
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
import sympy
import yaml
from sympy.physics.mechanics import LagrangesMethod, dynamicsymbols

PRIME = re.compile(r"(\w)'")


def torques(path: Path, values: Mapping[str, float]) -> np.ndarray:
    """τ at a state: `values` are those of parameters, coordinates, `x_dot` and `x_ddot`."""
    data = yaml.safe_load(path.read_text(encoding="utf-8"))
    names = list(data["model"]["coordinates"])
    q = {name: dynamicsymbols(name) for name in names}
    rates = {f"{name}_dot": q[name].diff() for name in names}
    numbers = {name: sympy.Float(value) for name, value in values.items()}
    L = _Reader({**numbers, **q, **rates}).lagrangian(data)
    equations = LagrangesMethod(L, list(q.values())).form_lagranges_equations()
    state = [(x.diff(dynamicsymbols._t, dots) if dots else x, values[name + suffix])
             for dots, suffix in ((2, "_ddot"), (1, "_dot"), (0, "")) for name, x in q.items()]  # fmt: skip
    at_state = sympy.lambdify([symbol for symbol, _ in state], equations)
    return np.array(at_state(*(value for _, value in state)), dtype=float).ravel()


class _Reader:
    """Expressions of a file in SymPy; `names` are the coordinates and their rates."""

    def __init__(self, names: Mapping[str, sympy.Expr]) -> None:
        self.names = names

    def expr(self, text: Any) -> sympy.Expr:
        text = PRIME.sub(r"\1_dot", str(text)).replace("^", "**")
        free = {name: sympy.Symbol(name) for name in re.findall(r"[A-Za-z_]\w*", text)}
        known = {name: getattr(sympy, name) for name in ("sin", "cos", "sqrt")}
        return sympy.parse_expr(text, {**free, **known, **self.names, "Integer": sympy.Integer,
                                       "Float": sympy.Float, "Rational": sympy.Rational})  # fmt: skip

    def vector(self, entries: Any) -> sympy.Matrix:
        return sympy.Matrix([self.expr(entry) for entry in entries])

    def lagrangian(self, data: dict[str, Any]) -> sympy.Expr:
        model = data["model"]
        if "L" in model:
            return self.expr(model["L"])
        if "bodies" not in model:
            return self.kinetic(model) - self.expr(model.get("P", 0))
        gravity = data.get("gravity", [0, 0, "-g"])
        pull = sympy.zeros(3, 1) if gravity == "none" else self.vector(gravity)
        return sum((self.body(body, pull) for body in model["bodies"]), sympy.Integer(0))

    def kinetic(self, model: dict[str, Any]) -> sympy.Expr:
        if "K" in model:
            return self.expr(model["K"])
        rates = sympy.Matrix([self.names[f"{name}_dot"] for name in model["coordinates"]])
        D = sympy.Matrix([[self.expr(entry) for entry in row] for row in model["D"]])
        return (rates.T * D * rates)[0] / 2

    def body(self, body: dict[str, Any], pull: sympy.Matrix) -> sympy.Expr:
        """½ m v·v + ½ ω·I ω + m g·r, with ω from the rate of the rotation matrix, Rᵀ Ṙ = S(ω)."""
        t = dynamicsymbols._t
        mass, r = self.expr(body["mass"]), self.vector(body["at"])
        v, R = r.diff(t), self.rotation(body)
        S = R.T * R.diff(t)
        w = sympy.Matrix([S[2, 1], S[0, 2], S[1, 0]])
        return mass * (v.dot(v) / 2 + pull.dot(r)) + (w.T * self.tensor(body) * w)[0] / 2

    def rotation(self, body: dict[str, Any]) -> sympy.Matrix:
        turns = body.get("turn", [])
        if not isinstance(turns, list):
            turns = [{"by": turns, "about": body.get("about", [0, 0, 1])}]
        R = sympy.eye(3)
        for turn in turns:
            a, angle = self.vector(turn.get("about", [0, 0, 1])), self.expr(turn["by"])
            S = sympy.Matrix([[0, -a[2], a[1]], [a[2], 0, -a[0]], [-a[1], a[0], 0]])
            R = R * (sympy.eye(3) + S * sympy.sin(angle) + S * S * (1 - sympy.cos(angle)))
        return R

    def tensor(self, body: dict[str, Any]) -> sympy.Matrix:
        given = body.get("inertia", {})
        if isinstance(given, list):
            return sympy.Matrix([[self.expr(entry) for entry in row] for row in given])

        def entry(i: int, j: int) -> sympy.Expr:
            return self.expr(given.get("xyz"[min(i, j)] + "xyz"[max(i, j)], 0))

        return sympy.Matrix(3, 3, entry)
