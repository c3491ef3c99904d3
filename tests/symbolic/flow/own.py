"""Oscillators that tests of slow flows write down."""

import sympy

from ridgeback.symbolic.systems.oscillator import Oscillator


def make(equation: str, **parameters: object) -> Oscillator:
    return Oscillator.from_equation(equation, parameters=parameters)  # type: ignore[arg-type]


def symbol(name: str) -> sympy.Symbol:
    return sympy.Symbol(name, real=True)


a, c, d, eps, g, mu = (symbol(name) for name in ("a", "c", "d", "eps", "g", "mu"))
R = sympy.Rational


def same(first: sympy.Expr, second: sympy.Expr) -> bool:
    return bool(sympy.expand(first - second) == 0)


def runge_kutta(force, state: tuple[float, float], end: float, count: int) -> tuple[float, float]:  # type: ignore[no-untyped-def]
    h, (u, v) = end / count, state
    for _ in range(count):
        k1 = v, -force(u, v)
        k2 = v + h / 2 * k1[1], -force(u + h / 2 * k1[0], v + h / 2 * k1[1])
        k3 = v + h / 2 * k2[1], -force(u + h / 2 * k2[0], v + h / 2 * k2[1])
        k4 = v + h * k3[1], -force(u + h * k3[0], v + h * k3[1])
        u, v = (x + h / 6 * (p + 2 * q + 2 * r + s) for x, p, q, r, s in zip((u, v), k1, k2, k3, k4, strict=True))
    return u, v
