r"""Where in tau an orbit turns, and the same orbit counted from another phase, as exact series in X.

For an orbit u(tau) = sum X^n u_n(tau) with u_0 = 0, u_1 = cos tau:

    turning point near b (0 or pi)   u'(b + d) = 0,             d(X) by Newton's method, each step doubling the order
    phase of the first harmonic      c cos tau + s sin tau = a cos(tau - d),      d' = r'/(1 + r^2),  r = s/c

A force that is even in u' gives an orbit that is even in tau: d vanishes and the lower turning point is half a period
after the upper one.  In a reversible centre such as u'' + u u' + u = 0 neither is so.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Literal, TypeAlias

from flint import fmpq

from ridgeback.symbolic.arithmetic import truncated
from ridgeback.symbolic.series.spaces import Scalar
from ridgeback.symbolic.series.trigonometric import Trig, harmonic

Waveform: TypeAlias = Sequence[Trig]
Shift: TypeAlias = list[Scalar]
"""A phase as a series in X, through one order less than the waveform."""


def even_in_phase(waveform: Waveform) -> bool:
    """Whether the orbit holds no sine: each turning point is then at a multiple of pi."""
    return not any(p.coefficients(part) for p in waveform for part in (2, 3))


def at_multiple(p: Trig, half_turns: Literal[0, 1]) -> Scalar:
    """Return the value at tau = 0 or pi, where x = cos tau is 1 or -1 and sin tau is 0.

    >>> from ridgeback.symbolic.series.spaces import space_for
    >>> from ridgeback.symbolic.series.trigonometric import cosine
    >>> at_multiple(cosine(space_for(())), 1)
    -1
    """
    even, odd = (sum(p.coefficients(part), fmpq(0)) for part in (0, 1))
    return even - odd if half_turns else even + odd


def turning(waveform: Waveform, half_turns: Literal[0, 1]) -> tuple[Shift, list[Scalar]]:
    """Return the phase d of the turning point next to ``half_turns * pi``, counted from there, and u there.

    The phase is known through one order less than u.

    >>> from ridgeback.symbolic.expansion.lindstedt import lindstedt
    >>> from ridgeback.symbolic.systems.oscillator import Oscillator
    >>> orbit = lindstedt(Oscillator.from_equation("u'' + u*u' + u = 0"), 3).waveform
    >>> turning(orbit, 1)
    ([0, 2/3, 0, -13/1620], [0, -1, 0, 0, 0])
    """
    length = len(waveform)
    if even_in_phase(waveform):
        return [fmpq(0)] * (length - 1), [at_multiple(p, half_turns) for p in waveform]
    rows = _taylor(waveform, half_turns)
    slope, curve = (_derived(rows, k) for k in (1, 2))
    phase, known = [fmpq(0)] * (length - 1), 1
    while known < length - 1:
        known *= 2
        fall = truncated.multiply(_inserted(slope, phase), _unit_reciprocal(_inserted(curve, phase)))
        phase = [d - change for d, change in zip(phase, fall, strict=True)]
    return phase, [fmpq(0), *_inserted(_derived(rows, 0), phase)]


def of_first_harmonic(waveform: Waveform) -> tuple[Shift, list[Scalar]]:
    """Return the phase d of the first harmonic a cos(tau - d), and its size a.

    >>> from ridgeback.symbolic.expansion.lindstedt import lindstedt
    >>> from ridgeback.symbolic.systems.catalogue import find
    >>> of_first_harmonic(lindstedt(find("duffing"), 2).waveform)
    ([0, 0, 0], [0, 1, 0, -1/32])
    """
    cosine, sine = (list(part) for part in zip(*(harmonic(p, 1) for p in waveform[1:]), strict=True))
    if all(value == 0 for value in sine):
        return [fmpq(0)] * len(sine), [fmpq(0), *cosine]
    ratio = truncated.multiply(sine, truncated.reciprocal(cosine))
    below = [fmpq(1), *truncated.multiply(ratio, ratio)[1:]]
    rate = [value * (n + 1) for n, value in enumerate(ratio[1:])]
    slope = truncated.multiply(rate, truncated.reciprocal(below))
    size = truncated.multiply(cosine, truncated.square_root(below))
    return [fmpq(0), *(value * fmpq(1, n + 1) for n, value in enumerate(slope))], [fmpq(0), *size]


def shifted(waveform: Waveform, phase: Shift) -> tuple[Trig, ...]:
    """Return the orbit counted from ``phase``: u(tau + d) = sum over k of the k-th derivative times d^k / k!.

    >>> from ridgeback.symbolic.expansion.lindstedt import lindstedt
    >>> from ridgeback.symbolic.systems.oscillator import Oscillator
    >>> orbit = lindstedt(Oscillator.from_equation("u'' + u*u' + u = 0"), 3).waveform
    >>> of_first_harmonic(shifted(orbit, of_first_harmonic(orbit)[0]))[0]
    [0, 0, 0, 0]
    """
    if not any(value != 0 for value in phase):
        return tuple(waveform)
    length, result, power = len(waveform), list(waveform), [fmpq(1)] + [fmpq(0)] * (len(phase) - 1)
    derived = list(waveform)
    for k in range(1, length):
        power = [value * fmpq(1, k) for value in truncated.multiply(power, phase)]
        derived = [p.derivative() for p in derived]
        for n in range(1, length):
            for j in range(k, length - n):
                if power[j] != 0:
                    result[n + j] = result[n + j] + derived[n].scale(power[j])
    return tuple(result)


def _taylor(waveform: Waveform, half_turns: Literal[0, 1]) -> list[list[Scalar]]:
    """Row k: the k-th derivative at the place, over k!, of u/X as a series in X."""
    rows, derived = [], list(waveform[1:])
    for k in range(len(waveform) + 2):
        rows.append([at_multiple(p, half_turns) * fmpq(1, math.factorial(k)) for p in derived])
        derived = [p.derivative() for p in derived]
    return rows


def _derived(rows: list[list[Scalar]], times: int) -> list[list[Scalar]]:
    """The Taylor rows of a derivative."""
    return [[value * math.perm(k, times) for value in row] for k, row in enumerate(rows)][times:]


def _inserted(rows: list[list[Scalar]], phase: Shift) -> list[Scalar]:
    """The sum of row_k d^k, by Horner's rule; d has no constant term."""
    length = len(rows[0])
    inner, total = (phase + [fmpq(0)] * length)[:length], [fmpq(0)] * length
    for row in reversed(rows):
        total = [a + b for a, b in zip(truncated.multiply(total, inner), row, strict=True)]
    return total


def _unit_reciprocal(x: list[Scalar]) -> list[Scalar]:
    """1/x for x_0 = 1 or -1."""
    sign = x[0]
    return [sign * value for value in truncated.reciprocal([sign * value for value in x])]
