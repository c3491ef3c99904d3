r"""What "amplitude" means, five ways, and each as an exact series in any other.

In units with k = 1, for a periodic orbit u(tau), tau = omega t:

    peak         u(tau_0) at u'(tau_0) = 0, tau_0 near 0: the positive turning point
    trough       -u(tau_1) at u'(tau_1) = 0, tau_1 near pi: the size of the negative turning point
    fundamental  the size of the first harmonic of u, cos and sin tau together
    action       sqrt(2 J),  J = (1/2 pi) * loop integral of u' du = omega * mean of (du/dtau)^2
    energy       sqrt(2 E),  E from dE = omega dJ

The last two need u' to be the momentum of u, so they exist for forces f(u) only: with terms in u' the area in the plane
of u and u' is no action, and what is conserved, such as u'^2/2 + u'^4/4 + u^2/2 for (1 + u'^2) u'' + u = 0, is fixed
only up to a function of itself.

All equal each other as they tend to zero and differ from the second order on, so the name travels with the number.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

from flint import fmpq

from ridgeback.common.errors import InputError
from ridgeback.symbolic.arithmetic import truncated
from ridgeback.symbolic.expansion.phase import of_first_harmonic, shifted, turning
from ridgeback.symbolic.grammar.parse import V
from ridgeback.symbolic.series.spaces import Scalar
from ridgeback.symbolic.series.trigonometric import Trig, constant, dot, harmonic

if TYPE_CHECKING:
    from ridgeback.symbolic.systems.oscillator import Oscillator

MEANINGS = {
    "peak": "the positive turning point of u",
    "trough": "the size of the negative turning point of u",
    "fundamental": "the size of the first harmonic of u",
    "action": "sqrt(2 J / k), with J the loop integral of u' du over 2 pi, for forces without u'",
    "energy": "sqrt(2 E) / k, with E = u'^2/2 + V(u) above the equilibrium, for forces without u'",
}
DEFINITIONS = tuple(MEANINGS)
CANONICAL = ("action", "energy")
"""Those that need u' to be the momentum of u."""


def check_definition(amplitude: str, allowed: Sequence[str] = DEFINITIONS) -> str:
    """Return the amplitude definition.

    Raises InputError when it is not one of those allowed here.

    >>> check_definition("peak")
    'peak'
    """
    if amplitude not in allowed:
        raise InputError(f"amplitude {amplitude!r} is not available here; use {' or '.join(allowed)}")
    return amplitude


def check_amplitude(oscillator: Oscillator, amplitude: str, allowed: Sequence[str] = DEFINITIONS) -> str:
    """Return the definition of the amplitude A that this oscillator is to be expanded in.

    Parameters
    ----------
    oscillator : Oscillator
        To be expanded.
    amplitude : str
        A definition, or another spelling of one.
    allowed : sequence of str, optional
        The definitions that the method has.

    Returns
    -------
    str
        The definition.

    Raises
    ------
    InputError
        For another definition, for ``action`` and ``energy`` where the force holds u', and where a parameter is called
        A.
    """
    check_definition(amplitude, allowed)
    check_name(oscillator, "A")
    if oscillator.substituted_force.has(V):
        check_velocity(oscillator.name, amplitude)
    return amplitude


def check_velocity(name: str, amplitude: str) -> None:
    """Raise InputError for a definition that a force with terms in u' does not have.

    >>> check_velocity("mine", "energy")
    Traceback (most recent call last):
        ...
    ridgeback.common.errors.InputError: mine has terms in u', for which amplitude 'energy' is not defined (u' is not ...
    """
    if amplitude in CANONICAL:
        raise InputError(
            f"{name} has terms in u', for which amplitude {amplitude!r} is not defined (u' is not the momentum of u "
            "then); use peak, trough or fundamental"
        )


def check_name(oscillator: Oscillator, variable: str) -> None:
    """Raise InputError where a parameter has the name that the amplitude is printed by.

    >>> from ridgeback.symbolic.systems.oscillator import Oscillator
    >>> check_name(Oscillator.from_equation("u'' + u + A*u**3", name="mine"), "A")
    Traceback (most recent call last):
        ...
    ridgeback.common.errors.InputError: mine: the parameter A has the name of the amplitude in the result; ...
    """
    if variable in oscillator.parameters:
        raise InputError(
            f"{oscillator.name}: the parameter {variable} has the name of the amplitude in the result; "
            f"rename it, e.g. {variable}1"
        )


def measured(definition: str, waveform: Sequence[Trig], omega: Sequence[Scalar]) -> list[Scalar]:
    """Return an amplitude of the orbit ``sum_n X^n u_n`` as a series in X, through the order of the waveform.

    Parameters
    ----------
    definition : str
        Of the amplitude to be measured.
    waveform : sequence of Trig
        u_0, u_1, ...; u_0 = 0 and u_1 = cos tau are taken for granted.
    omega : sequence of Scalar
        The frequency through one order less.

    Returns
    -------
    list of Scalar
        Its coefficients.
    """
    return _READERS[check_definition(definition)](waveform, omega)


def _peak(waveform: Sequence[Trig], omega: Sequence[Scalar]) -> list[Scalar]:  # noqa: ARG001 - one signature
    return turning(waveform, 0)[1]


def _trough(waveform: Sequence[Trig], omega: Sequence[Scalar]) -> list[Scalar]:  # noqa: ARG001
    return [-value for value in turning(waveform, 1)[1]]


def _fundamental(waveform: Sequence[Trig], omega: Sequence[Scalar]) -> list[Scalar]:  # noqa: ARG001
    return of_first_harmonic(waveform)[1]


def _action(waveform: Sequence[Trig], omega: Sequence[Scalar]) -> list[Scalar]:
    """X * sqrt(2 J / X^2)."""
    return [fmpq(0), *truncated.square_root(_twice_action(waveform, omega))]


def _energy(waveform: Sequence[Trig], omega: Sequence[Scalar]) -> list[Scalar]:
    """2E = integral of omega d(2J), with 2J = X^2 j(X): X^(n+2) of 2J brings (n + 2) X^(n+1) dX."""
    rate = [value * (n + 2) for n, value in enumerate(_twice_action(waveform, omega))]
    power = truncated.multiply(rate, list(omega))
    return [fmpq(0), *truncated.square_root([value * fmpq(1, n + 2) for n, value in enumerate(power)])]


def _twice_action(waveform: Sequence[Trig], omega: Sequence[Scalar]) -> list[Scalar]:
    """2 J / X^2 = 2 omega * mean((du/dtau)^2) / X^2, through the order of omega."""
    slope = [p.derivative() for p in waveform[1:]]
    zero = constant(waveform[0].space, fmpq(0))
    squares = [dot(zero.space, slope[: n + 1], slope[n::-1]) for n in range(len(slope))]
    return truncated.multiply([2 * harmonic(p, 0)[0] for p in squares], list(omega))


_READERS: dict[str, Callable[[Sequence[Trig], Sequence[Scalar]], list[Scalar]]] = {
    "peak": _peak,
    "trough": _trough,
    "fundamental": _fundamental,
    "action": _action,
    "energy": _energy,
}


def counted_from_its_own(definition: str, waveform: Sequence[Trig]) -> tuple[Trig, ...]:
    """Return the orbit with tau counted as the definition does: no sin tau for ``fundamental``, else u'(0) = 0.

    >>> from ridgeback.symbolic.expansion.lindstedt import lindstedt
    >>> from ridgeback.symbolic.systems.catalogue import find
    >>> orbit = lindstedt(find("duffing"), 2).waveform
    >>> counted_from_its_own("fundamental", orbit) == orbit
    True
    """
    phase, _ = of_first_harmonic(waveform) if definition == "fundamental" else turning(waveform, 0)
    return shifted(waveform, phase)


def same_definition(first: str, second: str) -> str:
    """Return the common definition of two amplitudes.

    Raises InputError when they differ: numbers in different definitions must be converted before they meet.

    >>> same_definition("peak", "peak")
    'peak'
    """
    if first != second:
        raise InputError(f"amplitude {first!r} meets amplitude {second!r}; convert one of them first")
    return first
