"""The frozen result of averaging: phi' and a'/a in losses that need not be analytic at rest.

Terms may hold any power of the amplitude: Coulomb friction brings F/a, quadratic damping c a.  ``amplitude`` says which
amplitude it is; in a damped motion it is that of the undamped orbit with the same averaged energy.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum
from functools import cached_property
from typing import Any

import sympy

from ridgeback.common.errors import InputError
from ridgeback.symbolic.arithmetic.rendering import coefficient_row, long_integers, mathml, nearest, series_latex
from ridgeback.symbolic.flow.shown import ShownSlowFlow
from ridgeback.symbolic.flow.term import LossTerm, Power


class SecondOrder(Enum):
    """What phi' has of the second order in the losses; a'/a has none, since they change sign with time."""

    WHOLE = "whole"
    """All of it, through the order of the amplitude."""
    LINEAR = "linear"
    """The terms in which the restoring force is linear."""
    BELOW = "below"
    """None: it counts like a^4, which is above the order asked for."""
    UNKNOWN = "unknown"
    """None: of broken powers of u', and with another stiffness on each side of rest, no exact sum is known."""


@dataclass(frozen=True, repr=False)
class LossFlow(ShownSlowFlow):
    """phi' and a'/a along the undamped orbit, through an order of the amplitude.

    In the losses a'/a is of first order, and right to the second; ``second`` says what phi' has of that.

    Made by ``averaged_losses``.

    Parameters
    ----------
    system : str
        Name of the oscillator.
    order : int
        phi' is known through this power of the amplitude; a'/a of a loss c(u) |u'|^r through this many powers above
        r - 1, less 2.
    amplitude : str
        ``fundamental``, or ``peak`` where the force has a kink at u = 0.
    losses : tuple of str
        Parameters that the losses vanish with.
    undamped_terms : tuple of LossTerm
        Those of phi' without the losses, in rad per time unit.
    phase_terms, growth_terms : tuple of LossTerm
        Terms of phi' (rad per time unit) and of a'/a (per time unit), in the oscillator's own units, each power once.
    second : SecondOrder
        What phi', the rate of the first harmonic's phase, has of the second order in the losses.

    Examples
    --------
    >>> from ridgeback.symbolic.flow.averaged_losses import averaged_losses
    >>> flow = averaged_losses("u'' + c*abs(u')*u' + F*sign(u') + u = 0", 2)
    >>> flow.growth_rate_expression()
    -2*F/(pi*a) - 4*a*c/(3*pi)
    """

    system: str
    order: int
    amplitude: str
    losses: tuple[str, ...]
    undamped_terms: tuple[LossTerm, ...]
    phase_terms: tuple[LossTerm, ...]
    growth_terms: tuple[LossTerm, ...]
    second: SecondOrder
    method: str = "multiple-scales"

    @property
    def frequency(self) -> tuple[LossTerm, ...]:  # type: ignore[override]
        """The nonzero terms of phi', in rad per time unit."""
        return self.phase_terms

    @property
    def backbone(self) -> tuple[LossTerm, ...]:  # type: ignore[override]
        """The terms of phi' without the losses."""
        return self.undamped_terms

    @property
    def growth_rate(self) -> tuple[LossTerm, ...]:  # type: ignore[override]
        """The nonzero terms of a'/a, per time unit, by rising powers of the amplitude."""
        return self.growth_terms

    @property
    def variables(self) -> tuple[str, ...]:
        """Names of the variables: the amplitude, then the losses' parameters."""
        return ("a", *self.losses)

    def frequency_at(self, a: Any, *small: float) -> Any:
        """Evaluate phi' in rad per time unit; ``a`` may be an array, ``small`` are the losses' parameters in order."""
        return self._at(self._rounded[0], a, small)

    def growth_rate_at(self, a: Any, *small: float) -> Any:
        """Evaluate a'/a per time unit; arguments as for ``frequency_at``."""
        return self._at(self._rounded[1], a, small)

    @cached_property
    def _rounded(self) -> tuple[tuple[tuple[float, tuple[float, ...]], ...], ...]:
        return tuple(
            tuple((nearest(term.coefficient), tuple(float(p) for p in term.powers)) for term in terms)
            for terms in (self.frequency, self.growth_rate)
        )

    def _at(self, terms: tuple[tuple[float, tuple[float, ...]], ...], a: Any, small: tuple[float, ...]) -> Any:
        if len(small) != len(self.losses):
            raise InputError(
                f"{self.system}: {len(small)} values were given for the losses' parameters "
                f"({', '.join(self.losses) or 'none'}); give one for each, in this order"
            )
        total: Any = a * 0
        for coefficient, (power, *others) in terms:
            factor = coefficient
            for value, times in zip(small, others, strict=True):
                factor *= float(value) ** times
            total = total + factor * a**power
        return total

    def frequency_expression(self) -> sympy.Expr:
        """phi' as one SymPy expression."""
        return sympy.Add(*self.expressions(self.frequency))

    def growth_rate_expression(self) -> sympy.Expr:
        """a'/a as one SymPy expression."""
        return sympy.Add(*self.expressions(self.growth_rate))

    def expressions(self, terms: tuple[LossTerm, ...]) -> tuple[sympy.Expr, ...]:  # type: ignore[override]
        """Terms as SymPy expressions, in the order given."""
        symbols = [sympy.Symbol(name, real=True) for name in self.variables]
        return tuple(
            term.coefficient * sympy.Mul(*(s**p for s, p in zip(symbols, term.powers, strict=True))) for term in terms
        )

    def latex(self) -> tuple[str, str]:
        r"""LaTeX of the two relations, ``\dot\varphi = ...`` and ``\dot a/a = ...``."""
        return (
            r"\dot{\varphi} = " + series_latex(self.expressions(self.frequency)),
            r"\frac{\dot{a}}{a} = " + series_latex(self.expressions(self.growth_rate)),
        )

    def mathml(self) -> tuple[str, str]:
        """Presentation MathML of the two relations."""
        first, second = self.latex()
        return mathml(first), mathml(second)

    def to_dict(self) -> dict[str, object]:
        """The public JSON form of a slow flow; ``loss_order`` is that in the losses.

        2 where phi' has terms of it; ``second_order`` says which.
        """
        return {
            "system": self.system,
            "method": self.method,
            "amplitude": self.amplitude,
            "order": self.order,
            "loss_order": 2 if self._has_second else 1,
            "second_order": self.second.value,
            "variables": list(self.variables),
            "frequency": self._rows(self.frequency),
            "growth_rate": self._rows(self.growth_rate),
        }

    def _rows(self, terms: tuple[LossTerm, ...]) -> list[dict[str, object]]:
        with long_integers():
            return [
                {
                    "powers": {n: _public(p) for n, p in zip(self.variables, term.powers, strict=True)},
                    **coefficient_row(term.coefficient),
                }
                for term in terms
            ]

    def refusal(self) -> str:
        """Why no other formula is made of it, nor a transient."""
        return (
            f"{self.system}: the losses are not analytic at rest, and harmonics, resummations and transients are of "
            "power series only; generate writes the rates as code, simulate integrates the motion"
        )

    def harmonic_rows(self) -> list[dict[str, object]]:
        """Raise InputError: averaging gives the rates only."""
        raise InputError(self.refusal())

    def losses_to(self) -> str:
        """The order in the losses, in a few words."""
        return "to first order in the losses" + (", phi' to second" if self._has_second else "")

    @property
    def _has_second(self) -> bool:
        return self.second in (SecondOrder.WHOLE, SecondOrder.LINEAR)

    def sentence(self) -> str:
        """What is left out, in one line."""
        return f"{_SENTENCES[self.second]}."


_ALONG = "along the undamped orbit exactly through this order of the amplitude"
_HIGHER = "a'/a to first order in the losses, whose second order vanishes there, phi' to second"
_FIRST = (
    f"To first order in the losses, {_ALONG}; the losses' second order, and with it what they change of phi', is left "
    "out: it "
)
_SENTENCES = {
    SecondOrder.WHOLE: f"{_HIGHER}, {_ALONG}; the losses' third order is left out",
    SecondOrder.LINEAR: f"{_HIGHER}, of which it has the terms with a linear restoring force; {_ALONG} otherwise",
    SecondOrder.BELOW: f"{_FIRST}counts like a^4",
    SecondOrder.UNKNOWN: f"{_FIRST}has no exact sum for broken powers of u', nor for another stiffness on each side",
}


def _public(power: Power) -> int | str:
    return int(power) if isinstance(power, int) or power.is_Integer else str(power)
