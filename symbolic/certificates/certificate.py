"""Independent checks of an expansion, each done again in exact arithmetic.

A residual alone misses the last homogeneous term, so the normalisation is a check of its own; the energy integral and
multiple scales share nothing with Lindstedt-Poincaré but the Taylor coefficients of the force.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import partial
from itertools import zip_longest
from typing import TypeAlias

import sympy
from flint import arb, ctx

from ridgeback.common.errors import InputError
from ridgeback.common.progress import Wanted, showing
from ridgeback.symbolic.arithmetic.balls import number_ball, rational
from ridgeback.symbolic.certificates.lost_energy import worst_difference
from ridgeback.symbolic.enclosure.enclosure import enclose, rounded_up
from ridgeback.symbolic.expansion.amplitude import measured
from ridgeback.symbolic.expansion.ball_expansion import BallExpansion
from ridgeback.symbolic.expansion.each_side import energy_on_each_side
from ridgeback.symbolic.expansion.energy_integral import energy_integral
from ridgeback.symbolic.expansion.expansion import Expansion
from ridgeback.symbolic.expansion.lindstedt import lindstedt
from ridgeback.symbolic.expansion.power_expansion import PowerExpansion
from ridgeback.symbolic.flow.averaged_losses import averaged_losses
from ridgeback.symbolic.flow.loss_flow import LossFlow
from ridgeback.symbolic.flow.multiple_scales import multiple_scales
from ridgeback.symbolic.flow.slow_flow import SlowFlow
from ridgeback.symbolic.series.trigonometric import at_zero, harmonic
from ridgeback.symbolic.systems.any_form import OscillatorLike, as_oscillator
from ridgeback.symbolic.systems.oscillator import Oscillator, V

SMALL = 40
"""The quadrature is held against a series at the amplitude 2^-SMALL."""

MOST_BITS = 4000

FLOW_ORDER = 24
"""Multiple scales is compared through this order at most; beyond it costs more than it tells."""

BALL_ORDER = 48
"""Balls are compared with exact coefficients through this order at most."""


@dataclass(frozen=True)
class Check:
    """One check: ``passed`` is None when it does not apply, and the statement says why."""

    name: str
    passed: bool | None
    statement: str

    def to_dict(self) -> dict[str, object]:
        """The public JSON form."""
        return {"check": self.name, "passed": self.passed, "statement": self.statement}


Checks: TypeAlias = dict[str, Callable[[], Check]]
"""Checks still to be run, by name."""


def certify(
    oscillator: OscillatorLike,
    result: Expansion | BallExpansion | PowerExpansion | SlowFlow | LossFlow,
    *,
    progress: Wanted = None,
) -> tuple[Check, ...]:
    """Run every independent check that applies to a result.

    Parameters
    ----------
    oscillator : Oscillator, str, path, sympy.Eq or sympy.Expr
        Any form of the oscillator whose result it is.
    result : Expansion, BallExpansion, PowerExpansion, SlowFlow or LossFlow
        To be checked.
    progress : bool or callable, optional
        ``True`` shows a bar; a function is told the share done and the check that begins.

    Returns
    -------
    tuple of Check
        Each with its name, whether it passed (None: does not apply) and a statement.

    Raises
    ------
    InputError
        For what is no oscillator.

    Examples
    --------
    >>> [c.name for c in certify("pendulum", lindstedt("pendulum", 6)) if c.passed]
    ['residual', 'normalisation', 'energy integral', 'multiple scales']
    """
    oscillator = as_oscillator(oscillator)
    if isinstance(result, BallExpansion):
        return certify_balls(oscillator, result)
    if isinstance(result, LossFlow):
        checks: Checks = {"quadrature": lambda: _guarded("quadrature", lambda: _losses_against(oscillator, result))}
    else:
        checks = _of_flow(oscillator, result) if isinstance(result, SlowFlow) else _of_series(oscillator, result)
    done: list[Check] = []
    with showing(progress) as told:
        for name, check in checks.items():
            told(len(done) / len(checks), name)
            done.append(check())
    return tuple(done)


def _of_flow(oscillator: Oscillator, flow: SlowFlow) -> Checks:
    """The checks of a slow flow, by name."""
    return {
        "residual": lambda: _flow_residual(flow),
        "lindstedt": lambda: _guarded("lindstedt", lambda: _flow_against_lindstedt(oscillator, flow)),
    }


def _of_series(oscillator: Oscillator, series: Expansion | PowerExpansion) -> Checks:
    """The checks of a series, by name."""
    if isinstance(series, PowerExpansion) or oscillator.by_sides:
        return {"quadrature": lambda: _guarded("quadrature", lambda: _against_quadrature(oscillator, series))}
    if series.waveform is None:
        return {"lindstedt": lambda: _guarded("lindstedt", lambda: _against_lindstedt(oscillator, series))}
    checks: Checks = {"residual": lambda: _residual(series), "normalisation": lambda: _normalisation(series)}
    if series.variable == "A":
        checks["energy integral"] = lambda: _guarded("energy integral", lambda: _against_energy(oscillator, series))
        checks["multiple scales"] = lambda: _guarded("multiple scales", lambda: _against_flow(oscillator, series))
    return checks


def certify_balls(oscillator: Oscillator, balls: BallExpansion) -> tuple[Check, ...]:
    """Compare balls with exact coefficients, by both exact routes there are, through a moderate order.

    Parameters
    ----------
    oscillator : Oscillator
        Whose expansion it is.
    balls : BallExpansion
        To be checked.

    Returns
    -------
    tuple of Check
        Each with its name, whether it passed and a statement.

    Examples
    --------
    >>> from ridgeback.symbolic.high_order.in_balls import lindstedt_in_balls
    >>> from ridgeback.symbolic.systems.catalogue import find
    >>> [c.passed for c in certify_balls(find("pendulum"), lindstedt_in_balls(find("pendulum"), 8))]
    [True, True]
    """
    order = min(balls.order, BALL_ORDER)
    checks = [("lindstedt", lambda: lindstedt(oscillator, order, amplitude=balls.amplitude))]
    if balls.variable == "A" and balls.amplitude == "peak":
        checks.append(("energy integral", lambda: energy_integral(oscillator, order)))
    return tuple(_guarded(name, partial(_held, name, balls, exact)) for name, exact in checks)


def _held(name: str, balls: BallExpansion, exact: Callable[[], Expansion]) -> Check:
    expansion = exact()
    wrong = balls.misses(expansion)
    if wrong:
        return Check(name, False, f"exact coefficients at orders {wrong} lie outside their balls")
    return Check(name, True, f"all {expansion.order + 1} exact coefficients through this order lie in their balls")


def _guarded(name: str, check: Callable[[], Check]) -> Check:
    """A check that the oscillator does not allow is reported, not hidden."""
    try:
        return check()
    except InputError as reason:
        return Check(name, None, f"does not apply: {reason}")


def _residual(expansion: Expansion) -> Check:
    left = expansion.residual()
    if left:
        return Check("residual", False, f"substituted into the equation, orders {left} do not cancel")
    text = f"u and omega0 substituted into the equation cancel identically through order {expansion.order}"
    return Check("residual", True, text)


def _normalisation(expansion: Expansion) -> Check:
    """The orbit's own amplitude, measured by its definition, must be the variable itself.

    tau = 0 must be the upper turning point, or for ``fundamental`` the phase of the first harmonic.
    """
    waveform = expansion.waveform or ()
    if expansion.variable == "A":
        size = measured(expansion.amplitude, waveform, expansion.coefficients)
        sizes_right = all(value == (n == 1) for n, value in enumerate(size))
    else:
        sizes_right = True
    if expansion.amplitude == "fundamental":
        phases = [harmonic(p, 1)[1] for p in waveform]
    else:
        phases = [at_zero(p.derivative()) for p in waveform]
    phase_right = all(value == 0 for value in phases)
    what = (
        f"the {expansion.amplitude} amplitude of u is A itself" if expansion.variable == "A" else "the phase is fixed"
    )
    if sizes_right and phase_right:
        return Check("normalisation", True, f"{what}, at every order")
    return Check("normalisation", False, f"{what} does not hold at every order")


def _against_energy(oscillator: Oscillator, expansion: Expansion) -> Check:
    if oscillator.normalised.bound.has(V):
        raise InputError("the force depends on u'")
    definition = "peak" if expansion.amplitude == "fundamental" else expansion.amplitude
    other = energy_integral(oscillator, expansion.order, amplitude=definition)
    return _same("energy integral", expansion.convert(definition), other, "series reversion, without oscillator theory")


def _against_quadrature(oscillator: Oscillator, series: Expansion | PowerExpansion) -> Check:
    """The series against an enclosed frequency at a small amplitude, where one wrong coefficient would show.

    One order more than asked for is compared, so that a wrong coefficient of the last one stands out by 1/A.
    Parameters without a value get one.
    """
    if series.symbolic_names:
        values = {name: sympy.Rational(n + 1, n + 2) for n, name in enumerate(series.symbolic_names)}
        oscillator = oscillator.with_parameters(values)
        given, series = series, energy_on_each_side(oscillator, series.order, amplitude=series.amplitude)
        if others := _others(given, values, series):
            said = ", ".join(f"{name} = {value}" for name, value in values.items())
            return Check("quadrature", False, f"derived again with {said}, the coefficients {others} are others")
    order = series.order + 1
    following = energy_on_each_side(oscillator, order, amplitude=series.amplitude)
    if following.coefficients[: len(series.coefficients)] != series.coefficients:
        return Check("quadrature", False, "derived again, the coefficients are others")
    place = sympy.Rational(1, 2**SMALL)
    bits = SMALL * (order + 3)
    if bits > MOST_BITS:
        raise InputError(f"order {series.order} takes more than {MOST_BITS} bits at A = 2^-{SMALL}")
    exact = enclose(oscillator, place, definition=series.amplitude, bits=bits)
    with ctx.workprec(bits + SMALL):
        wrong = abs(following.in_balls(arb(rational(place))) / exact.omega - 1)
        holds = bool(wrong < arb(2) ** (-SMALL * order))
        found = f"below {rounded_up(wrong):.1e}" if wrong.contains(0) else wrong.str(3, radius=False)
    less = "less" if holds else "not less"
    text = f"at A = 2^-{SMALL} the series through order {order} differs from the enclosed frequency by {found} of it"
    return Check("quadrature", holds, f"{text}, {less} than A^{order}")


def _others(
    given: Expansion | PowerExpansion, values: Mapping[str, sympy.Rational], series: Expansion | PowerExpansion
) -> list[int]:
    """The coefficients that are others than those of a series, once its parameters have these values; in balls."""
    with ctx.workprec(MOST_BITS):
        inserted = [number_ball(c.subs({s: values[s.name] for s in c.free_symbols})) for c in given.frequency]
        known = [number_ball(c) for c in series.frequency]
    pairs = enumerate(zip_longest(inserted, known, fillvalue=arb(0)))
    return [n for n, (one, other) in pairs if not one.overlaps(other)]


def _losses_against(oscillator: Oscillator, flow: LossFlow) -> Check:
    """The growth rate in the peak amplitude against the energy lost on the enclosed orbit, each loss alone."""
    order = flow.order - 1
    if order < 1:
        raise InputError(f"order {flow.order} holds no growth rate; use 2 or more")
    again = averaged_losses(oscillator, flow.order, amplitude=flow.amplitude)
    if (again.frequency, again.growth_rate) != (flow.frequency, flow.growth_rate):
        return Check("quadrature", False, "averaged again, the terms are others")
    names = {name for name, value in oscillator.parameters.items() if value is None} - set(flow.losses)
    values = {name: sympy.Rational(n + 1, n + 2) for n, name in enumerate(sorted(names))}
    own = oscillator.with_parameters(values) if values else oscillator
    place = sympy.Rational(1, 2**SMALL)
    size, wrong, whose = worst_difference(own, flow.order, place, SMALL * (order + 2))
    holds = bool(size < arb(2) ** (SMALL // 2))
    found = f"below {rounded_up(wrong):.1e}" if wrong.contains(0) else wrong.str(3, radius=False)
    of = f" of the loss {whose}" if whose else ""
    less = "less" if holds else "not less"
    text = f"at A = 2^-{SMALL} (peak) a'/a{of} differs from the enclosed loss of energy by {found} of it"
    return Check("quadrature", holds, f"{text}, {less} than a wrong term would make it")


def _against_lindstedt(oscillator: Oscillator, expansion: Expansion) -> Check:
    other = lindstedt(oscillator, expansion.order, amplitude=expansion.amplitude)
    return _same("lindstedt", expansion, other, "Lindstedt-Poincaré")


def _same(name: str, first: Expansion, second: Expansion, how: str) -> Check:
    wrong = [n for n, value in enumerate(first.difference(second)) if value != 0]
    if wrong:
        return Check(name, False, f"{how} gives other coefficients at orders {wrong}")
    count = min(first.order, second.order) + 1
    return Check(name, True, f"the same {count} coefficients ({first.amplitude} amplitude) by {how}")


def _against_flow(oscillator: Oscillator, expansion: Expansion) -> Check:
    order = min(expansion.order, FLOW_ORDER)
    flow = multiple_scales(oscillator, order)
    return _agreement("multiple scales", expansion.truncated(order).convert("fundamental"), flow)


def _flow_against_lindstedt(oscillator: Oscillator, flow: SlowFlow) -> Check:
    if oscillator.kind == "limit-cycle":
        raise InputError("the slow flow of a limit cycle holds for every amplitude, the expansion on the cycle only")
    undamped = oscillator.with_parameters(dict.fromkeys(flow.small_parameters, 0))
    return _agreement("lindstedt", lindstedt(undamped, flow.order, amplitude="fundamental"), flow)


def _agreement(name: str, expansion: Expansion, flow: SlowFlow) -> Check:
    """The slow flow without its small parameters against the series in the fundamental amplitude."""
    undamped = {t.powers[0]: t.coefficient for t in flow.frequency if not any(t.powers[1:])}
    wrong = [n for n, c in enumerate(expansion.frequency) if n <= flow.order and (undamped.get(n, 0) - c).expand() != 0]
    if wrong:
        return Check(name, False, f"the undamped slow flow differs at orders {wrong}")
    order = min(expansion.order, flow.order)
    return Check(name, True, f"in the fundamental amplitude both routes agree without damping through order {order}")


def _flow_residual(flow: SlowFlow) -> Check:
    left = flow.residual()
    if left:
        return Check("residual", False, f"substituted into the equation, weighted degrees {left} do not cancel")
    text = f"u, phi' and a' substituted into the equation cancel identically through weighted degree {flow.order}"
    return Check("residual", True, text)
