"""An atlas: where the series of each oscillator converges, what stops it, and how well it does inside, proved."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Final

import sympy

from ridgeback.common.errors import InputError
from ridgeback.common.progress import Wanted, showing
from ridgeback.compare.study.certified import Known, references
from ridgeback.symbolic.certificates.accuracy import accuracy
from ridgeback.symbolic.expansion.each_side import energy_on_each_side
from ridgeback.symbolic.expansion.energy_integral import energy_integral
from ridgeback.symbolic.expansion.expansion import Expansion
from ridgeback.symbolic.expansion.lindstedt import lindstedt
from ridgeback.symbolic.expansion.power_expansion import PowerExpansion
from ridgeback.symbolic.singularities.limits import Limits, limits
from ridgeback.symbolic.systems.catalogue import find
from ridgeback.symbolic.systems.entries.every import known_frequency, listed
from ridgeback.symbolic.systems.oscillator import Oscillator, V

ORDERS: Final = (4, 8, 16, 32)
SHARES: Final = (Fraction(1, 2), Fraction(9, 10))
"""Of the radius of convergence."""
LONG: Final = 96
"""Order of the series by the energy from which the limits are read; a few milliseconds."""
SHORT: Final = 48
"""Likewise by Lindstedt-Poincaré."""


@dataclass(frozen=True)
class Inside:
    """The series at a share of its radius of convergence.

    Parameters
    ----------
    share : Fraction
        Of the radius.
    place : Fraction
        Peak amplitude, or value of the small parameter.
    errors : tuple of float or None
        Proved relative error of omega0 by order; None where there is no exact frequency.
    why : str
        Why there is none; empty where there is one.
    """

    share: Fraction
    place: Fraction
    errors: tuple[float | None, ...]
    why: str


@dataclass(frozen=True)
class Chart:
    """One oscillator of the atlas.

    Parameters
    ----------
    system, equation : str
        Its name, and its equation with numbers.
    exact : str or None
        omega0 in closed form, where one is known.
    orders : tuple of int
        Of the truncations.
    limits : Limits or None
        Where the series converges; None where there is no series.
    inside : tuple of Inside
        The series at shares of its radius.
    why : str
        Why there is no series.
    """

    system: str
    equation: str
    exact: str | None
    orders: tuple[int, ...]
    limits: Limits | None
    inside: tuple[Inside, ...]
    why: str = ""

    def to_dict(self) -> dict[str, object]:
        """The public JSON form; errors as a list by order."""
        found = None if self.limits is None else self.limits.to_dict()
        rows = [
            {
                "share": str(item.share),
                "place": float(item.place),
                "orders": list(self.orders),
                "relative_errors": list(item.errors),
                **({"refused": item.why} if item.why else {}),
            }
            for item in self.inside
        ]
        public: dict[str, object] = {"system": self.system, "equation": self.equation, "exact_frequency": self.exact}
        variable = None if self.limits is None else self.limits.variable
        return public | {
            "variable": variable,
            "limits": found,
            "inside": rows,
            **({"why": self.why} if self.why else {}),
        }


def atlas(
    systems: Sequence[str] | None = None, *, orders: Sequence[int] = ORDERS, progress: Wanted = None
) -> tuple[Chart, ...]:
    """Chart oscillators of the catalogue: convergence, nearest singularity, proved errors inside.

    Parameters
    ----------
    systems : sequence of str, optional
        Names in the catalogue; by default all that are not damped.
    orders : sequence of int, optional
        Of the truncated series.
    progress : bool or callable, optional
        ``True`` shows a bar; a function is told the share done and the oscillator.

    Returns
    -------
    tuple of Chart
        In the order of the names.

    Raises
    ------
    InputError
        For a name that is not in the catalogue.

    Examples
    --------
    >>> chart = atlas(["poschl-teller"], orders=(4, 8))[0]
    >>> chart.limits.circle, [f"{error:.0e}" for error in chart.inside[0].errors]
    ('1.570796327', ['-2e-02', '-1e-03'])
    """
    names = [row["name"] for row in listed() if row["kind"] != "damped"] if systems is None else systems
    kept = tuple(sorted(orders))
    with showing(progress) as told:
        charts = []
        for done, name in enumerate(names):
            told(done / len(names), name)
            charts.append(_chart(find(name), kept))
    return tuple(charts)


def _chart(oscillator: Oscillator, orders: tuple[int, ...]) -> Chart:
    values = ", ".join(f"{name} = {value}" for name, value in oscillator.parameters.items() if name != oscillator.small)
    equation = oscillator.equation + (f" with {values}" if values else "")
    exact = known_frequency(oscillator.name)
    try:
        series = _series(oscillator)
        if isinstance(series, PowerExpansion) and not any(series.coefficients[1:]):
            return Chart(oscillator.name, equation, exact, orders, None, (), _one_term(series))
        found = limits(over_power(series) if isinstance(series, PowerExpansion) else series)
    except InputError as refusal:
        return Chart(oscillator.name, equation, exact, orders, None, (), str(refusal))
    inside = () if found.radius is None else _inside(oscillator, orders, found.radius)
    return Chart(oscillator.name, equation, exact, orders, found, inside)


def _one_term(series: PowerExpansion) -> str:
    """Of a force that is a power of |u| the leading term is all there is."""
    value = f"{float(series.lead.evalf(20)):.10g}"
    power = "A" if series.growth == 1 else f"A^({series.growth})"
    return f"none: omega0 = {value} {power} exactly, at every amplitude"


def over_power(series: PowerExpansion) -> Expansion:
    """A series in powers of A about a power law, over its leading term: it converges where that does.

    Raises InputError for broken powers, whose radius would be that of another variable than A.
    """
    if series.root != 1:
        raise InputError(
            f"the series of {series.system} runs in powers of A^(1/{series.root}), for which no limits are read"
        )
    return Expansion(
        system=series.system,
        method=series.method,
        variable=series.variable,
        amplitude=series.amplitude,
        order=series.order,
        scale=sympy.S.One,
        scaled_variable=False,
        coefficients=series.coefficients,
        waveform=None,
        amplitude_coefficients=None,
        residual_of=None,
        names=series.names,
        constants=series.constants,
    )


def _series(oscillator: Oscillator) -> Expansion | PowerExpansion:
    if oscillator.by_sides:
        return energy_on_each_side(oscillator, LONG)
    if oscillator.kind == "conservative" and not oscillator.substituted_force.has(V):
        found = energy_integral(oscillator, LONG)
        if isinstance(found, Expansion):
            return found
    found = lindstedt(oscillator, SHORT)
    if not isinstance(found, Expansion):
        raise InputError(f"the series of {oscillator.name} runs in powers for which no limits are known")
    return found


def _inside(oscillator: Oscillator, orders: tuple[int, ...], radius: float) -> tuple[Inside, ...]:
    places = [Fraction(f"{float(share) * radius:.3g}") for share in SHARES]
    known = references(oscillator, places)
    errors = [_errors(oscillator, order, places, known) for order in orders]
    return tuple(
        Inside(share, place, tuple(row[n] for row in errors), known[n].why)
        for n, (share, place) in enumerate(zip(SHARES, places, strict=True))
    )


def _errors(oscillator: Oscillator, order: int, places: list[Fraction], known: tuple[Known, ...]) -> list[float | None]:
    """The error of the truncated series, the first of the formulas, at each place."""
    series = accuracy(oscillator, order, places, reference=[each.omega for each in known], resummed=False)[0]
    return [None if error is None else float(error.mid()) for error in series.errors]
