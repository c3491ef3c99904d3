"""The exact side of a report: formulas term by term, the certificate, the generated code.

Formulas are printed in units where the natural frequency is 1 (``omega_0 / k``), so that their coefficients stay the
exact rationals they are, whatever decimal k was given.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from dataclasses import dataclass

import sympy

from ridgeback.compare.binding.bind import bind
from ridgeback.compare.study.results import Derivation, Formula
from ridgeback.numeric.orbits.potential import peak_limit
from ridgeback.symbolic.certificates.certificate import Check, certify
from ridgeback.symbolic.codegen import generate
from ridgeback.symbolic.expansion.expansion import Expansion
from ridgeback.symbolic.expansion.lindstedt import lindstedt
from ridgeback.symbolic.flow.multiple_scales import multiple_scales
from ridgeback.symbolic.flow.ordering import small_parameters, undamped
from ridgeback.symbolic.flow.slow_flow import SlowFlow, Term
from ridgeback.symbolic.systems.oscillator import Oscillator

MAX_HARMONICS = 3
"""Harmonics of u that are printed; all of them are in the expansion itself."""
_LATEX = {sympy.Symbol("eps", real=True): r"\varepsilon", sympy.Symbol("mu", real=True): r"\mu"}


@dataclass(frozen=True)
class Exact:
    """The derived series of one oscillator: the periodic family, and the slow flow where there is one."""

    oscillator: Oscillator
    expansion: Expansion
    flow: SlowFlow | None


def derive(oscillator: Oscillator, order: int, *, flow_order: int | None = None) -> Exact:
    """Derive the expansion of the undamped oscillator (or limit cycle), and the slow flow of the damped one.

    Raises InputError for an order below 0 and for an oscillator without a family of periodic orbits.
    """
    expansion = lindstedt(undamped(oscillator), order)
    flow = None
    if small_parameters(oscillator) or oscillator.kind != "damped":
        flow = multiple_scales(oscillator, min(order, 8) if flow_order is None else flow_order)
    return Exact(oscillator, expansion, flow)


def derivation(exact: Exact) -> Derivation:
    """Formulas, certificate and code of what was derived."""
    return Derivation(
        system=exact.oscillator.name,
        formulas=tuple(_formulas(exact)),
        certificate=certificate(exact),
        code=_code(exact),
    )


def _formulas(exact: Exact) -> Iterator[Formula]:
    expansion = exact.expansion
    yield frequency_formula(expansion)
    if expansion.variable == "A" and expansion.amplitude == "peak":
        yield frequency_formula(expansion.convert("fundamental"))
    if expansion.amplitude_coefficients is not None:
        yield _amplitude_formula(expansion)
    yield from _harmonic_formulas(expansion)
    if exact.flow is not None:
        yield from _flow_formulas(exact.flow)


def frequency_formula(expansion: Expansion) -> Formula:
    r"""Return omega_0 / k as a sum of exact terms.

    >>> from ridgeback.symbolic.systems.catalogue import find
    >>> frequency_formula(lindstedt(find("pendulum"), 2)).terms
    ('1', '- \\frac{A^{2}}{16}')
    """
    name = _variable_latex(expansion)
    return Formula(
        title=f"Fundamental frequency, {_meaning(expansion)}",
        left=rf"\frac{{\omega_0({name})}}{{k}}" if expansion.scale != 1 else rf"\omega_0({name})",
        terms=power_series(expansion, expansion.coefficients),
        note=f"Order {expansion.order}: powers of the variable kept.",
        python=f"omega0 = {float(expansion.scale)!r} * ({sympy.Add(*_powers(expansion, expansion.coefficients))})",
    )


def _meaning(expansion: Expansion) -> str:
    return "limit cycle in eps" if expansion.variable == "eps" else f"{expansion.amplitude} amplitude"


def _variable_latex(expansion: Expansion) -> str:
    if expansion.variable == "eps":
        return r"\varepsilon"
    return "a" if expansion.amplitude == "fundamental" else expansion.variable


def _powers(expansion: Expansion, coefficients: Iterable[object]) -> list[sympy.Expr]:
    name = "a" if expansion.amplitude == "fundamental" and expansion.variable == "A" else expansion.variable
    x = sympy.Symbol(name, real=True)
    step = 1 / expansion.scale if expansion.scaled_variable else sympy.S.One
    exact = (expansion.exact(c) for c in coefficients)
    return [c * (step * x) ** n for n, c in enumerate(exact) if c != 0]


def power_series(expansion: Expansion, coefficients: Iterable[object]) -> tuple[str, ...]:
    """LaTeX of each nonzero term of a power series in the variable of ``expansion``, with its sign."""
    return latex_terms(_powers(expansion, coefficients))


def latex_terms(terms: Iterable[sympy.Expr]) -> tuple[str, ...]:
    """Return LaTeX of each term; ``0`` when there is none."""
    return tuple(sympy.latex(term, symbol_names=_LATEX) for term in terms) or ("0",)


def _amplitude_formula(expansion: Expansion) -> Formula:
    coefficients = expansion.amplitude_coefficients or ()
    return Formula(
        title=f"Amplitude of the limit cycle ({expansion.amplitude})",
        left=r"A(\varepsilon)",
        terms=power_series(expansion, coefficients),
    )


def _harmonic_formulas(expansion: Expansion) -> Iterator[Formula]:
    """Yield the leading harmonics of u, cosine and sine parts apart."""
    x = sympy.Symbol(expansion.variable, real=True)
    for harmonic in expansion.harmonics[:MAX_HARMONICS]:
        for part, values in (("cos", harmonic.cosine), ("sin", harmonic.sine)):
            terms = [c * x**n for n, c in enumerate(values) if c != 0]
            if terms:
                yield Formula(
                    title=_harmonic_title(harmonic.multiple),
                    left=_harmonic_name(harmonic.multiple, part),
                    terms=latex_terms(terms),
                )


def _harmonic_title(multiple: int) -> str:
    return f"Harmonic {multiple} of the motion" if multiple else "Mean offset of the motion"


def _harmonic_name(multiple: int, part: str) -> str:
    """Return the coefficient of cos or sin of the multiple of omega_0 t in u; the mean of u for multiple 0."""
    number = "" if multiple == 1 else str(multiple)
    return rf"[\{part} {number}\omega_0 t]\; u" if multiple else r"\bar{u}"


def _flow_formulas(flow: SlowFlow) -> Iterator[Formula]:
    note = f"Weighted degree up to {flow.order}; a is the fundamental amplitude and counts 1"
    note += "".join(f", {name} counts {weight}" for name, weight in flow.weights.items()) + "."
    k = "" if flow.scale == 1 else r"/k"
    for title, left, terms in (
        ("Slow flow: phase", rf"\dot{{\varphi}}{k}", flow.frequency),
        ("Slow flow: amplitude", rf"\frac{{\dot{{a}}}}{{a}}{k}", flow.damping),
    ):
        yield Formula(title, left, latex_terms(_in_natural_units(flow, terms)), note)


def _in_natural_units(flow: SlowFlow, terms: Iterable[Term]) -> list[sympy.Expr]:
    """Terms of phi'/k and a'/(a k), with the small parameters over their powers of k."""
    a, k = (sympy.Symbol(name, real=True) for name in ("a", "k"))
    units = [
        sympy.Symbol(name, real=True) / (1 if flow.scale == 1 else k ** flow.dimensions[name]) for name in flow.weights
    ]
    return [
        sympy.Mul(
            term.coefficient / flow.unit(term.powers[1:]),
            a ** term.powers[0],
            *(unit**power for unit, power in zip(units, term.powers[1:], strict=True)),
        )
        for term in terms
    ]


def certificate(exact: Exact) -> tuple[str, ...]:
    """Independent checks, each done now and in exact arithmetic; a failed one says so."""
    checks = [("", check) for check in certify(undamped(exact.oscillator), exact.expansion)]
    if exact.flow is not None:
        checks += [("slow flow, ", check) for check in certify(exact.oscillator, exact.flow)]
    return tuple(_line(prefix, check) for prefix, check in checks)


def _line(prefix: str, check: Check) -> str:
    failed = "FAILED: " if check.passed is False else ""
    name = f"{prefix}{check.name}"
    return f"{failed}{name[0].upper()}{name[1:]}: {check.statement}."


def described(oscillator: Oscillator) -> str:
    """The equation with its numbers.

    >>> from ridgeback.symbolic.systems.catalogue import find
    >>> described(find("duffing"))
    "u'' + 2*mu*u' + k**2*u + eps*u**3 = 0 with mu = 0, k = 1, eps = 1"
    """
    values = ", ".join(f"{name} = {value}" for name, value in oscillator.parameters.items())
    return f"{oscillator.equation} with {values}" if values else oscillator.equation


def limit_of(oscillator: Oscillator) -> float | None:
    """The peak amplitude at which the oscillation itself ends, where there is one.

    >>> from ridgeback.symbolic.systems.catalogue import find
    >>> limit_of(find("pendulum")), limit_of(find("van-der-pol"))
    (3.141592653589793, None)
    """
    if oscillator.kind != "conservative" or oscillator.potential is None:
        return None
    limit = peak_limit(bind(oscillator))
    return limit if math.isfinite(limit) else None


def _code(exact: Exact) -> dict[str, str]:
    oscillator = undamped(exact.oscillator)
    equation, limit = described(oscillator), limit_of(oscillator)
    names = {"Python": "python", "C": "c"}
    return {
        title: generate(exact.expansion, language, equation=equation, limit=limit) for title, language in names.items()
    }
