r"""The frozen result of multiple scales: ``phi' = omega0(a, m)`` and ``a'/a = growth_rate(a, m)``, exact.

``a`` is the ``fundamental`` amplitude, ``m`` the small parameters (mu, eps, ...).  Internally k = 1 and a parameter m
of dimension d stands for m/k^d (d = 1 for linear damping and for eps of van der Pol's equation, -1 for cubic damping;
see ``ordering``); ``frequency``, ``growth_rate`` and ``harmonics`` are in the oscillator's own units.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from types import MappingProxyType
from typing import Any

import sympy
from flint import fmpq

from ridgeback.common.errors import InputError
from ridgeback.common.horner import polynomial_value
from ridgeback.symbolic.arithmetic.rendering import as_sympy, coefficient_row, mathml, nearest, series_latex
from ridgeback.symbolic.arithmetic.tidy import tidy
from ridgeback.symbolic.flow.ordering import ROOT, UNITS
from ridgeback.symbolic.flow.shown import ShownSlowFlow
from ridgeback.symbolic.flow.term import Term
from ridgeback.symbolic.series.spaces import Scalar
from ridgeback.symbolic.series.trigonometric import Trig


@dataclass(frozen=True, repr=False)
class SlowFlow(ShownSlowFlow):
    """phi' and a'/a as exact polynomials in the fundamental amplitude and the small parameters.

    Made by ``multiple_scales``.  ``frequency`` and ``growth_rate`` are the terms in the oscillator's own
    units, ``frequency_at`` and ``growth_rate_at`` their values, ``expression`` and ``latex`` their formulas,
    ``residual`` what is left of the equation.

    Parameters
    ----------
    system : str
        Name of the oscillator.
    order : int
        Highest weighted degree p + w.r kept.
    weights : mapping of str to int
        Weight of each small parameter, in the order of ``variables``.
    scale : sympy.Expr
        The natural frequency k, in rad per time unit.
    dimensions : mapping of str to int
        d of each parameter left symbolic, measured in k^d; the small ones first.
    omega, delta : tuple of Scalar
        omega0, and a'/a, by weighted degree in units with k = 1, as polynomials in (y*, small parameters, other
        parameters).
    waveform : tuple of Trig
        u by weighted degree.
    complete : int, optional
        Of one small parameter: the highest power of which no term is left out; None when its terms never end.
    residual_of : callable
        Substitutes the flow into the equation.
    constants : mapping of str to sympy.Expr
        Values of the symbols in ``dimensions`` that stand for what is not polynomial in the parameters.
    method : str
        Name of the derivation.
    amplitude : str
        Definition of the amplitude.
    highest : int, optional
        Terms with a higher power of the one small parameter than this are left out; None keeps all; see ``entire``.

    Examples
    --------
    >>> from ridgeback.symbolic.flow.multiple_scales import multiple_scales
    >>> flow = multiple_scales("pendulum", 4)
    >>> flow.frequency_at(1.0, 0.01)
    0.9384265625
    >>> flow.residual()
    []
    """

    system: str
    order: int
    weights: Mapping[str, int]
    scale: sympy.Expr
    dimensions: Mapping[str, int]
    omega: tuple[Scalar, ...]
    delta: tuple[Scalar, ...]
    waveform: tuple[Trig, ...]
    complete: int | None
    residual_of: Callable[[SlowFlow], list[int]]
    constants: Mapping[str, sympy.Expr] = field(default_factory=dict)
    method: str = "multiple-scales"
    amplitude: str = "fundamental"
    highest: int | None = None

    def __post_init__(self) -> None:
        for name in ("weights", "dimensions", "constants"):
            object.__setattr__(self, name, MappingProxyType(dict(getattr(self, name))))

    @property
    def names(self) -> tuple[str, ...]:
        """All parameters left symbolic, the small ones first."""
        return tuple(self.dimensions)

    @property
    def small_parameters(self) -> tuple[str, ...]:
        """Names of the small parameters."""
        return tuple(self.weights)

    @property
    def small(self) -> str:
        """Name of the one small parameter.

        Raises InputError when there are several, or none.
        """
        return self._only()[0]

    @property
    def weight(self) -> int:
        """Weight of the one small parameter; InputError as for ``small``."""
        return self._only()[1]

    def _only(self) -> tuple[str, int]:
        if len(self.weights) != 1:
            raise InputError(
                f"{self.system}: this needs a slow flow with one small parameter, and this one has "
                f"{', '.join(self.weights) or 'none'}; say which is small by its weight, 0 for those that are not"
            )
        return next(iter(self.weights.items()))

    @property
    def variables(self) -> tuple[str, ...]:
        """Names of the variables: the amplitude, then the small parameters."""
        return ("a", *self.weights)

    @cached_property
    def frequency(self) -> tuple[Term, ...]:
        """The nonzero terms of phi', in rad per time unit, by weighted degree."""
        return self.terms(self.omega, rate=1)

    @cached_property
    def growth_rate(self) -> tuple[Term, ...]:
        """The nonzero terms of a'/a, per time unit, by weighted degree."""
        return self.terms(self.delta, rate=1)

    def terms(self, degrees: tuple[Scalar, ...], *, rate: int) -> tuple[Term, ...]:
        """A series as terms in the oscillator's own units; ``rate`` is 1 for a quantity per time, 0 for one in u."""
        count, found = len(self.weights), []
        for n, known in enumerate(degrees):
            by_power: dict[tuple[int, ...], sympy.Expr] = {}
            for powers, value in rows(known, len(self.names)).items():
                small, others = powers[:count], powers[count:]
                part = as_sympy(value) * _monomial(self.names[count:], others) * self.unit(powers, rate=rate)
                by_power[small] = by_power.get(small, sympy.S.Zero) + part
            kept = [small for small in sorted(by_power) if self.highest is None or small[0] <= self.highest]
            valued = [(small, self._inserted(by_power[small])) for small in kept]
            found += [Term((n - self._degree(small), *small), value) for small, value in valued if value != 0]
        return tuple(found)

    def _inserted(self, coefficient: sympy.Expr) -> sympy.Expr:
        """A coefficient with the values of the constants, and k as often as it is in it, in its shortest form."""
        if not self.constants:
            return coefficient
        values = {sympy.Symbol(name, real=True): value for name, value in self.constants.items()}
        return sympy.Add(*(tidy(part, self.scale, power) for power, part in self._by_scale(coefficient.subs(values))))

    def _by_scale(self, coefficient: sympy.Expr) -> list[tuple[int, sympy.Expr]]:
        """The even and the odd part in k of a coefficient."""
        k = sympy.Symbol(ROOT, real=True)
        turned = sympy.expand(coefficient.subs(self.scale, k) if self.scale != 1 else coefficient)
        square, parts = sympy.expand(self.scale**2), {0: sympy.S.Zero, 1: sympy.S.Zero}
        for term in sympy.Add.make_args(turned):
            rest, power = term.as_coeff_exponent(k)
            parts[power % 2] += rest * square ** (power // 2)
        return [(power, part) for power, part in parts.items() if part != 0]

    def entire(self) -> SlowFlow:
        """The flow without the powers of the small parameter that lack terms; the flow itself where none ever ends.

        What is left is right for every amplitude, through that power: on a limit cycle a is not small, and terms of
        an incomplete power would add noise, not accuracy.

        >>> from ridgeback.symbolic.flow.multiple_scales import multiple_scales
        >>> from ridgeback.symbolic.systems.catalogue import find
        >>> flow = multiple_scales(find("van-der-pol"), 4, weight=2)
        >>> flow.frequency_expression(), flow.entire().frequency_expression()
        (1 - eps**2/8, 1)
        """
        return self if self.complete is None else replace(self, highest=self.complete)

    def unit(self, powers: tuple[int, ...], *, rate: int = 1) -> sympy.Expr:
        """The power of k that a coefficient carries: k^(rate - d.r), for powers r of the parameters (small first)."""
        spent = sum(d * r for d, r in zip(self.dimensions.values(), powers, strict=False))
        return self.scale ** (rate - spent)

    def _degree(self, small: tuple[int, ...]) -> int:
        return sum(w * r for w, r in zip(self.weights.values(), small, strict=True))

    def residual(self) -> list[int]:
        """Substitute u and the flow into the equation; return the weighted degrees that do not cancel (none: exact)."""
        return self.residual_of(self)

    def frequency_at(self, a: Any, *small: float) -> Any:
        """Evaluate phi' in rad per time unit; ``a`` may be an array.

        Raises InputError when there is not one value for each small parameter.
        """
        return evaluate(self._frequency_rows, a, self.checked(small))

    def growth_rate_at(self, a: Any, *small: float) -> Any:
        """Evaluate a'/a per time unit; ``a`` may be an array, errors as for ``frequency_at``."""
        return evaluate(self._growth_rate_rows, a, self.checked(small))

    @cached_property
    def _frequency_rows(self) -> tuple[tuple[float, tuple[int, ...]], ...]:
        return rounded(self.frequency)

    @cached_property
    def _growth_rate_rows(self) -> tuple[tuple[float, tuple[int, ...]], ...]:
        return rounded(self.growth_rate)

    def checked(self, small: tuple[Any, ...]) -> tuple[Any, ...]:
        """The values of the small parameters; InputError unless there is one for each."""
        if len(small) != len(self.weights):
            raise InputError(
                f"{self.system}: {len(small)} values were given for the small parameters "
                f"({', '.join(self.weights) or 'none'}); give one for each, in this order"
            )
        return small

    def values(self, parameters: Mapping[str, Any]) -> tuple[Any, ...]:
        """The values of the small parameters, picked by name from an oscillator's parameters.

        Raises InputError for one that is missing or has no value.

        >>> from ridgeback.symbolic.flow.multiple_scales import multiple_scales
        >>> from ridgeback.symbolic.systems.catalogue import find
        >>> multiple_scales(find("damped-pendulum"), 2).values(find("damped-pendulum").parameters)
        (1/100,)
        """
        missing = [name for name in self.weights if parameters.get(name) is None]
        if missing:
            raise InputError(f"{self.system}: {', '.join(missing)} has no value; give one, e.g. {missing[0]} = 1/100")
        return tuple(parameters[name] for name in self.weights)

    def frequency_expression(self) -> sympy.Expr:
        """phi' as one SymPy expression."""
        return sympy.Add(*self.expressions(self.frequency))

    def growth_rate_expression(self) -> sympy.Expr:
        """a'/a as one SymPy expression."""
        return sympy.Add(*self.expressions(self.growth_rate))

    def complex_expression(self) -> sympy.Expr:
        """h of z' = z h for z = (a/2) exp(i phi): h = a'/a + i phi' with a^2 = 4 z conj(z) (theory, section 3).

        >>> from ridgeback.symbolic.flow.multiple_scales import multiple_scales
        >>> from ridgeback.symbolic.systems.catalogue import find
        >>> multiple_scales(find("pendulum"), 2).complex_expression()
        -mu + I*(-z*conjugate(z)/4 + 1)
        """
        a, z = sympy.Symbol("a", real=True), sympy.Symbol("z")
        rates = (self.growth_rate_expression(), self.frequency_expression())
        growth, frequency = (rate.subs(a, 2 * sympy.sqrt(z * sympy.conjugate(z))) for rate in rates)
        return growth + sympy.I * frequency

    def expressions(self, terms: tuple[Term, ...]) -> tuple[sympy.Expr, ...]:
        """Terms as SymPy expressions, in the order given."""
        return tuple(t.coefficient * _monomial(self.variables, t.powers) for t in terms)

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
        """The public JSON form: exact coefficients as strings; ``weight`` of one small parameter, else ``weights``."""
        ordering = {"weight": self.weight} if len(self.weights) == 1 else {"weights": dict(self.weights)}
        return {
            "system": self.system,
            "method": self.method,
            "amplitude": self.amplitude,
            "order": self.order,
            **ordering,
            "variables": list(self.variables),
            "frequency": json_rows(self.variables, self.frequency),
            "growth_rate": json_rows(self.variables, self.growth_rate),
        }


def json_rows(variables: tuple[str, ...], terms: tuple[Term, ...]) -> list[dict[str, object]]:
    """Terms in the public JSON form.

    >>> json_rows(("a",), (Term((3,), sympy.Rational(1, 32)),))
    [{'powers': {'a': 3}, 'coefficient': '1/32'}]
    """
    return [
        {"powers": dict(zip(variables, term.powers, strict=True)), **coefficient_row(term.coefficient)}
        for term in terms
    ]


def _monomial(names: tuple[str, ...], powers: tuple[int, ...]) -> sympy.Expr:
    pairs = [(name, n) for name, n in zip(names, powers, strict=True) if name not in UNITS]  # powers of k, see ``unit``
    return sympy.Mul(*[sympy.Symbol(name, real=True) ** int(n) for name, n in pairs])


def rows(part: Scalar, count: int) -> dict[tuple[int, ...], fmpq]:
    """Rational coefficients by the powers of the parameters, ``count`` of them.

    >>> rows(fmpq(-1, 2), 1)
    {(0,): -1/2}
    """
    if isinstance(part, int | fmpq):
        return {(0,) * count: fmpq(part)} if part != 0 else {}
    return {tuple(int(p) for p in powers[1:]): value for powers, value in part.to_dict().items()}


def rounded(terms: tuple[Term, ...]) -> tuple[tuple[float, tuple[int, ...]], ...]:
    """Coefficients rounded once to the nearest float, each with its powers.

    >>> rounded((Term((2, 0), sympy.Rational(-1, 16)),))
    ((-0.0625, (2, 0)),)
    """
    return tuple((nearest(term.coefficient), term.powers) for term in terms)


def amplitude_powers(rows: tuple[tuple[Any, tuple[int, ...]], ...], small: tuple[Any, ...]) -> list[Any]:
    """Insert the small parameters: the coefficients of a^0, a^1, ...

    >>> amplitude_powers(((2.0, (1, 1)), (1.0, (0, 0))), (0.5,))
    [1.0, 1.0]
    """
    result: list[Any] = [0] * (max((powers[0] for _, powers in rows), default=-1) + 1)
    for coefficient, powers in rows:
        product = coefficient
        for value, power in zip(small, powers[1:], strict=True):
            product = product * value**power if power else product
        result[powers[0]] = result[powers[0]] + product
    return result


def evaluate(rows: tuple[tuple[float, tuple[int, ...]], ...], a: Any, small: tuple[Any, ...]) -> Any:
    """Sum terms by Horner's rule in a, with the small parameters inserted first.

    >>> evaluate(((-0.0625, (2, 0)), (1.0, (0, 0))), 2.0, (0.0,))
    0.75
    """
    return polynomial_value(amplitude_powers(rows, small), a)
