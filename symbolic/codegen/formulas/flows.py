"""A slow flow as functions: omega0, a'/a, a', amplitude and phase after a time, and the motion u of a and phi."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from flint import fmpq

from ridgeback.symbolic.codegen.formulas.frequency import Symbols
from ridgeback.symbolic.codegen.formulas.wording import (
    A_RATE,
    A_SMALL,
    GROWTH,
    OMEGA0,
    SCALING,
    SMALL,
    common_facts,
    limit_fact,
    titled,
)
from ridgeback.symbolic.codegen.motions.motion import flow_motion
from ridgeback.symbolic.codegen.motions.transient import transient_functions
from ridgeback.symbolic.codegen.number import Number
from ridgeback.symbolic.codegen.polynomial import polynomial_function
from ridgeback.symbolic.codegen.program import Argument, Domain, Form, Function, Terms
from ridgeback.symbolic.codegen.request import CodeRequest
from ridgeback.symbolic.expansion.amplitude import MEANINGS
from ridgeback.symbolic.flow.ordering import UNITS
from ridgeback.symbolic.flow.slow_flow import rows

if TYPE_CHECKING:
    from ridgeback.symbolic.flow.slow_flow import SlowFlow


def slow_flow_form(flow: SlowFlow, request: CodeRequest) -> Form:
    """Build the functions omega0, growth_rate, amplitude_rate, amplitude_after and phase_after; u on request.

    Every symbol is an argument.  A numerical natural frequency that does not scale out is in the coefficients.
    """
    made = _Flow(flow, request)
    omega = made.function("omega0", OMEGA0, flow.omega)
    rate = made.function("amplitude_rate", A_RATE, flow.delta, more=1)
    functions: tuple[Function, ...] = (omega, made.function("growth_rate", GROWTH, flow.delta), rate)
    functions += transient_functions(omega, rate, made.domain, request.real)
    if request.motion:
        functions += tuple(flow_motion(flow.waveform, made.wave, made.arguments, made.domain, request.real))
    facts = (
        *common_facts(flow.method, request.equation),
        f"Amplitude a: {MEANINGS['fundamental']}.",
        order_fact(flow),
        f"Natural frequency: {flow.scale}." if made.symbols.computed else SCALING,
        *limit_fact("a", request.limit),
        *request.more,
    )
    return Form(flow.system, f"Slow flow of {titled(flow.system)}", facts, functions)


def order_fact(flow: SlowFlow) -> str:
    """Which terms are kept.

    >>> from ridgeback.symbolic.flow.multiple_scales import multiple_scales
    >>> from ridgeback.symbolic.systems.catalogue import find
    >>> order_fact(multiple_scales(find("pendulum"), 4))
    'Order: terms a^p mu^q with p + 2 q up to 4.'
    """
    if not flow.weights:
        return f"Order: powers of a up to {flow.order}."
    letters = ["q", *(f"q_{n}" for n in range(2, len(flow.weights) + 1))]
    pairs = list(zip(flow.weights.items(), letters, strict=True))
    monomial = " ".join(f"{name}^{q}" for (name, _), q in pairs)
    degree = " + ".join(f"{w} {q}" for (_, w), q in pairs)
    return f"Order: terms a^p {monomial} with p + {degree} up to {flow.order}."


class _Flow:
    """What all functions of one slow flow share."""

    def __init__(self, flow: SlowFlow, request: CodeRequest) -> None:
        self.flow, self.real = flow, request.real
        self.domain: Domain = request.domain("a")
        names = tuple(name for name in flow.names if name not in UNITS)
        held = bool(flow.constants) or len(names) < len(flow.names)
        self.symbols = Symbols(flow.scale, names, flow.constants, held and flow.scale.is_number, request.real)
        small = dict.fromkeys(flow.weights, SMALL if len(flow.weights) == 1 else A_SMALL)
        self.arguments = (Argument("a", MEANINGS["fundamental"]), *self.symbols.arguments(small))

    def function(self, name: str, summary: str, by_degree: Sequence[Any], *, more: int = 0) -> Function:
        """One side of the slow flow, times a^more and k."""
        return self._made(name, summary, by_degree, more, self.symbols.k)

    def wave(self, name: str, summary: str, by_degree: Sequence[Any]) -> Function:
        """The coefficient of a harmonic of u."""
        return self._made(name, summary, by_degree, 0, "")

    def _made(self, name: str, summary: str, by_degree: Sequence[Any], more: int, factor: str) -> Function:
        """A polynomial in units where k = 1: each symbol enters over its power of k."""
        inner = self.symbols.inner
        units = {f"({s})" if s in UNITS else inner[s]: d for s, d in self.flow.dimensions.items()}
        kept = self._terms(by_degree, more) or {(0,) * (len(units) + 1): Number(fmpq(0), self.real)}
        return polynomial_function(
            name,
            summary,
            self.arguments,
            ("a", *units),
            kept,
            self.domain,
            factor=factor,
            units=units,
            real=self.real,
            before=self.symbols.prepared(),
            where=self.symbols.where,
            k=self.symbols.k,
        )

    def _terms(self, by_degree: Sequence[Any], more: int) -> Terms:
        flow, weights = self.flow, tuple(self.flow.weights.values())
        terms: Terms = {}
        for n, coefficient in enumerate(by_degree):
            for powers, value in rows(coefficient, len(flow.names)).items():
                if flow.highest is None or powers[0] <= flow.highest:
                    degree = sum(w * r for w, r in zip(weights, powers, strict=False))
                    terms[n - degree + more, *powers] = Number(value, self.real)
        return terms
