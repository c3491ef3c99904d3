"""The exact side of a report: formulas term by term, the certificate, the generated code.

Formulas are printed in units where the natural frequency is 1 (``omega_0 / k``), so that their coefficients stay the
exact rationals they are, whatever decimal k was given.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace

import sympy

from ridgeback.common.numbers import number
from ridgeback.compare.study.derived import Derived
from ridgeback.compare.study.results import Checked, Derivation, Formula, HarmonicRow, HarmonicTable
from ridgeback.symbolic.certificates.certificate import Check, certify
from ridgeback.symbolic.codegen import form_of, written
from ridgeback.symbolic.expansion.expansion import Expansion
from ridgeback.symbolic.flow.slow_flow import SlowFlow
from ridgeback.symbolic.flow.term import Term
from ridgeback.symbolic.systems.oscillator import Oscillator

SHOWN = 8
"""Order to which formulas are printed; the code holds them all."""
COLUMNS = 5
"""Powers of the variable in the table of harmonics."""
SAID = {r"\varepsilon": "ε"}
_LATEX = {sympy.Symbol("eps", real=True): r"\varepsilon", sympy.Symbol("mu", real=True): r"\mu"}


def derivation(derived: Derived, *, order: int | None = None) -> Derivation:
    """Formulas, certificate and code of what was derived.

    Parameters
    ----------
    derived
        The series and the slow flow.
    order
        The order that formulas, certificate and code are about; by default that of the series.

    Examples
    --------
    >>> from ridgeback.compare.study.derived import derive
    >>> from ridgeback.symbolic.systems.catalogue import find
    >>> sorted(derivation(derive(find("pendulum"), 6), order=2).code)
    ['C', 'JavaScript', 'Python']
    """
    shown = derived if order is None else replace(derived, expansion=derived.expansion.truncated(order))
    return Derivation(
        system=shown.oscillator.name,
        formulas=tuple(_formulas(_printed(shown))),
        certificate=certificate(shown),
        code=_code(shown),
        harmonics=harmonic_table(_printed(shown).expansion),
        order=shown.expansion.order,
    )


def _printed(derived: Derived) -> Derived:
    """The same to the order that is printed."""
    expansion = derived.expansion
    return replace(derived, expansion=expansion.truncated(SHOWN)) if expansion.order > SHOWN else derived


def _formulas(derived: Derived) -> Iterator[Formula]:
    expansion = derived.expansion
    yield frequency_formula(expansion)
    if expansion.variable == "A" and expansion.amplitude == "peak" and expansion.waveform is not None:
        yield frequency_formula(expansion.convert("fundamental"))
    if expansion.amplitude_coefficients is not None:
        yield _amplitude_formula(expansion)
    if derived.flow is not None:
        yield from _flow_formulas(derived.flow)


def frequency_formula(expansion: Expansion) -> Formula:
    r"""Return omega_0 / k as a sum of exact terms.

    >>> from ridgeback.symbolic.expansion.lindstedt import lindstedt
    >>> from ridgeback.symbolic.systems.catalogue import find
    >>> frequency_formula(lindstedt(find("pendulum"), 2)).terms
    ('1', '- \\frac{A^{2}}{16}')
    """
    name = _variable_latex(expansion)
    return Formula(
        title=f"Fundamental frequency, {_meaning(expansion)}",
        left=rf"\frac{{\omega_0({name})}}{{k}}" if expansion.scale != 1 else rf"\omega_0({name})",
        terms=power_series(expansion, expansion.coefficients),
        note=f"Through the power {expansion.order} of {SAID.get(name, name)}.{_natural(expansion)}",
        python=f"omega0 = {float(expansion.scale)!r} * ({sympy.Add(*_powers(expansion, expansion.coefficients))})",
    )


def _natural(expansion: Expansion) -> str:
    """What k is, where it is not 1."""
    k = number(float(expansion.scale), 6)
    return "" if expansion.scale == 1 else f" k = {k}, the natural frequency."


def _meaning(expansion: Expansion) -> str:
    return "limit cycle in ε" if expansion.variable == "eps" else f"{expansion.amplitude} amplitude"


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


def harmonic_table(expansion: Expansion) -> HarmonicTable | None:
    """The exact coefficients of the motion, by harmonic and by power of the variable; None where there are none.

    >>> from ridgeback.symbolic.expansion.lindstedt import lindstedt
    >>> from ridgeback.symbolic.systems.catalogue import find
    >>> table = harmonic_table(lindstedt(find("pendulum"), 4))
    >>> table.powers, [(row.multiple, row.part) for row in table.rows]
    ((1, 3, 5), [(1, 'cos'), (3, 'cos'), (5, 'cos')])
    """
    if expansion.waveform is None:
        return None
    found = [
        (h.multiple, part if h.multiple else "", values)
        for h in expansion.harmonics
        for part, values in (("cos", h.cosine), ("sin", h.sine))
        if any(c != 0 for c in values)
    ]
    used = sorted({n for _, _, values in found for n, c in enumerate(values) if c != 0})[:COLUMNS]
    rows = [
        HarmonicRow(multiple, part, tuple(_coefficient(values, n) for n in used))
        for multiple, part, values in sorted(found, key=lambda row: (row[0], row[1]))
    ]
    kept = tuple(row for row in rows if any(row.cells))
    return HarmonicTable(_variable_latex(expansion), tuple(used), kept) if kept else None


def _coefficient(values: Sequence[sympy.Expr], power: int) -> str:
    value = values[power] if power < len(values) else 0
    return sympy.latex(value, symbol_names=_LATEX) if value != 0 else ""


def _flow_formulas(flow: SlowFlow) -> Iterator[Formula]:
    note = f"Weighted degree up to {flow.order}; a is the fundamental amplitude and counts 1"
    note += "".join(f", {name} counts {weight}" for name, weight in flow.weights.items()) + "."
    k = "" if flow.scale == 1 else r"/k"
    for title, left, terms in (
        ("Slow flow: phase", rf"\dot{{\varphi}}{k}", flow.frequency),
        ("Slow flow: amplitude", rf"\frac{{\dot{{a}}}}{{a}}{k}", flow.growth_rate),
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


def certificate(derived: Derived) -> tuple[Checked, ...]:
    """Independent checks, each done now and in exact arithmetic, of the series and of the slow flow."""
    checks = [_checked("", check) for check in certify(derived.undamped.oscillator, derived.expansion)]
    if derived.flow is not None:
        checks += [_checked("slow flow, ", check) for check in certify(derived.oscillator, derived.flow)]
    return tuple(checks)


def _checked(prefix: str, check: Check) -> Checked:
    return Checked(f"{prefix}{check.name}", check.statement, check.passed)


def described(oscillator: Oscillator) -> str:
    """The equation with its numbers; parameters left symbolic have none.

    >>> from ridgeback.symbolic.systems.catalogue import find
    >>> described(find("duffing"))
    "u'' + 2*mu*u' + k**2*u + eps*u**3 = 0 with mu = 0, k = 1, eps = 1"
    """
    values = ", ".join(f"{name} = {value}" for name, value in oscillator.parameters.items() if value is not None)
    return f"{oscillator.equation} with {values}" if values else oscillator.equation


def _code(derived: Derived) -> dict[str, str]:
    rest = derived.undamped
    equation = described(rest.oscillator)
    form = form_of(derived.expansion, equation=equation, limit=rest.limit)
    return {
        title: written(form, language)
        for title, language in (("C", "c"), ("Python", "python"), ("JavaScript", "javascript"))
    }
