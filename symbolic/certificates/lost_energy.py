"""The growth rate by losses that are not analytic at rest, enclosed at one amplitude, to hold averaging against."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import sympy
from flint import acb, arb, ctx

from ridgeback.common.errors import InputError
from ridgeback.symbolic.arithmetic.balls import number_ball, rational
from ridgeback.symbolic.enclosure.ball_functions import ball_function
from ridgeback.symbolic.enclosure.enclosure import enclose
from ridgeback.symbolic.enclosure.half_wells import MAX_EVALUATIONS, HalfWell, two_sided
from ridgeback.symbolic.flow.averaged_losses import averaged_losses, loss_names, losses_of, undamped
from ridgeback.symbolic.flow.loss_flow import LossFlow
from ridgeback.symbolic.systems.oscillator import Oscillator


def enclosed_growth_rate(oscillator: Oscillator, peak: sympy.Rational, bits: int) -> arb:
    """A'/A of the averaged motion at a peak amplitude, to first order in the losses: -omega0 loop(h du)/(2 pi A f(A)).

    Parameters
    ----------
    oscillator : Oscillator
        With numbers for its parameters.
    peak : sympy.Rational
        A, in the unit of u.
    bits : int
        Precision of the answer.

    Returns
    -------
    arb
        A ball around it, per time unit.

    Raises
    ------
    InputError
        For losses that are no whole power of u', and where the orbit has no enclosure.

    Examples
    --------
    >>> own = Oscillator.from_equation("u'' + u + abs(u')*u' = 0")
    >>> enclosed_growth_rate(own, sympy.Integer(3), 64).overlaps(-4 / arb.pi())
    True
    """
    rest = undamped(oscillator, ())
    orbit = enclose(rest, peak, bits=bits)
    sides = two_sided(rest)
    with ctx.workprec(bits + 80 + 2 * max(0, -int(sympy.log(peak, 2)))):
        total, A = arb(0), arb(rational(peak))
        wells = ((HalfWell(sides.near), orbit.peak), (HalfWell(sides.far), -orbit.trough))
        for loss in losses_of(oscillator.name, oscillator.substituted_force):
            if not loss.exponent.is_Integer:
                raise InputError(f"the loss goes with |u'|^({loss.exponent}), and whole powers only are enclosed")
            for (well, turn), shape in zip(wells, (loss.right, loss.left), strict=True):
                total += _lost(well, turn, shape, int(loss.exponent), bits)
        force = arb(ball_function(sides.near.force, ctx.prec)(A))
        return arb(-orbit.omega * 2 * total / (2 * arb.pi() * A * force))


def _lost(well: HalfWell, turn: arb, shape: sympy.Expr, exponent: int, bits: int) -> arb:
    """The integral of c(u) |u'|^r du from 0 to the turning point W, with u = W (1 - x^2), u'^2 = 2 W x^2 q."""
    q, c = well.quotient(turn), ball_function(shape, ctx.prec, complex_=True)

    def on_ball(x: acb, analytic: bool) -> acb:
        u = turn * (1 - x * x)
        square = 2 * turn * q(x, u)
        speed = square ** (exponent // 2) * (square.sqrt(analytic=analytic) if exponent % 2 else 1)
        return acb(c(u) * speed * x ** (exponent + 1) * 2 * turn)

    goal = arb(2) ** -bits
    typical = abs(on_ball(acb(1) / 2, analytic=False))
    found = acb.integral(on_ball, 0, acb(1), rel_tol=goal, abs_tol=goal * typical, eval_limit=MAX_EVALUATIONS)
    return arb(found.real)


def averaged_at(flow: LossFlow, amplitude: arb, values: Mapping[str, sympy.Rational]) -> arb:
    """The growth rate of a flow at an amplitude and values of its losses' parameters, in balls."""
    total = arb(0)
    for term in flow.growth_rate:
        part = number_ball(term.coefficient) * amplitude ** arb(rational(sympy.Rational(term.powers[0])))
        for name, power in zip(flow.losses, term.powers[1:], strict=True):
            part = part * arb(rational(values[name])) ** int(power)
        total = total + part
    return total


def _alone(oscillator: Oscillator, names: Sequence[str], alone: str) -> dict[str, sympy.Rational]:
    """1 for one loss and 0 for the others; 1 for all where it is none without them, as in c d abs(u') u'."""
    values = {name: sympy.Integer(int(name == alone)) for name in names}
    own = oscillator.with_parameters(values)
    return values if losses_of(own.name, own.substituted_force) else dict.fromkeys(names, sympy.S.One)


def worst_difference(oscillator: Oscillator, order: int, peak: sympy.Rational, bits: int) -> tuple[arb, arb, str]:
    """The largest difference of averaging from the quadrature, over the losses each alone, and whose it is.

    It comes over the first power of A that is left out, which it should be of the size of, and over the rate itself.
    """
    names = loss_names(oscillator.force)
    flow = averaged_losses(oscillator, order, amplitude="peak")
    found: list[tuple[arb, arb, str]] = []
    for alone in names or ("",):
        values = _alone(oscillator, names, alone)
        own = oscillator.with_parameters(values)
        lowest = min(loss.exponent for loss in losses_of(own.name, own.substituted_force))
        exact = enclosed_growth_rate(own, peak, bits)
        with ctx.workprec(bits + 80):
            A = arb(rational(peak))
            wrong = abs(averaged_at(flow, A, values) - exact)
            found.append((wrong / A ** arb(rational(lowest + order - 2)), wrong / abs(exact), alone))
    return max(found, key=lambda each: float(each[0].mid()))
