"""The Lagrangian and what the Euler-Lagrange equations take from it.

Spong, Hutchinson, Vidyasagar, section 7.1: L = K - P,
d/dt ∂L/∂q̇_k - ∂L/∂q_k = τ_k.
"""

from __future__ import annotations

from dynsolve.algebra.expr import Expr


def lagrangian(K: Expr, P: Expr) -> Expr:
    """L = K - P"""
    return K - P


def momentum(L: Expr, k: int) -> Expr:
    """∂L/∂q̇_k, k from 0."""
    return L.ring.diff_velocity(L, k)


def momentum_rate(p: Expr) -> Expr:
    """d/dt ∂L/∂q̇_k, the total derivative by the chain rule."""
    return p.ring.time_derivative(p)


def slope(L: Expr, k: int) -> Expr:
    """∂L/∂q_k, k from 0."""
    return L.ring.diff(L, k)
