"""LaTeX: the formulas themselves, exact, term by term from the coefficients; and the steps of what is no polynomial."""

from __future__ import annotations

import re

from sympy import latex

from ridgeback.symbolic.codegen.languages.language import Language
from ridgeback.symbolic.codegen.number import Number
from ridgeback.symbolic.codegen.program import Form, Function, Horner, Operand, Operation, Polynomial, Step, Terms

LETTERS = """
alpha beta gamma delta epsilon zeta eta theta iota kappa lambda mu nu xi pi rho sigma tau phi chi psi omega
"""
GREEK = frozenset(LETTERS.split())
NAMES = {
    "omega0": r"\omega_0",
    "omega0_slope": r"\omega_0'",
    "growth_rate": r"\dot a/a",
    "motion": "u",
    "amplitude": "A",
}


class Latex(Language):
    """A LaTeX document; ``align*`` environments to be taken out of it."""

    name, suffix = "latex", "tex"
    comment, end = "%", ""

    def literal(self, value: float, form: Form) -> str:  # noqa: ARG002
        return repr(value)

    def assign(self, name: str, value: str, *, first: bool, form: Form) -> str:  # noqa: ARG002
        return f"{symbol(name)} &= {value}"

    def loop(self, horner: Horner, table: str, *, first: bool, form: Form) -> list[str]:  # noqa: ARG002
        return []

    def write(self, form: Form) -> str:
        parts = [
            "\n".join(map(self.remark, self.heading(form))),
            "\\documentclass{article}\n\\usepackage{amsmath}\n\\allowdisplaybreaks\n\\begin{document}",
            *(self._function(f) for f in form.functions),
            "\\end{document}",
        ]
        return "\n\n".join(parts) + "\n"

    def _function(self, function: Function) -> str:
        variables = ", ".join(symbol(a.name) for a in function.arguments)
        left = f"{NAMES.get(function.name, symbol(function.name))}({variables})"
        if function.polynomial is None:
            lines = [*steps_of(function), f"{left} &= {value_of(function.result)}"]
        else:
            first, *rest = terms_of(function.polynomial)
            factor = symbol(function.polynomial.factor) if function.polynomial.factor else ""
            opened = rf"{factor} \Bigl( {first}" if factor and rest else f"{factor} {first}"
            lines = [f"{left} &= {opened}", *(rf"&\quad {term}" for term in rest)]
            lines[-1] += r" \Bigr)" if factor and rest else ""
            lines = [*(f"{symbol(name)} &= {latex(value)}" for name, value in function.polynomial.where), *lines]
        comment = "\n".join(self.remark(line) for line in self.about(function))
        joined = " \\\\\n".join(lines)
        return f"{comment}\n\\begin{{align*}}\n{joined}\n\\end{{align*}}"

    def package(self, form: Form) -> dict[str, str]:
        return {f"{form.name}.tex": self.write(form)}


def symbol(name: str) -> str:
    r"""A name as LaTeX.

    >>> symbol("alpha3"), symbol("A"), symbol("half_angle")
    ('\\alpha_{3}', 'A', '\\mathit{half\\_angle}')
    """
    head, digits = re.fullmatch(r"(.*?)_?(\d*)_?", name).groups()  # type: ignore[union-attr]
    base = rf"\{head}" if head in GREEK else r"\varepsilon" if head == "eps" else head
    if base == head and len(head) != 1:
        base = rf"\mathit{{{head.replace('_', chr(92) + '_')}}}"
    return f"{base}_{{{digits}}}" if digits else base


def exact(number: Number) -> str:
    r"""An exact number as LaTeX.

    >>> from flint import fmpq
    >>> exact(Number(fmpq(-1, 16)))
    '-\\frac{1}{16}'
    """
    text = str(number)
    sign, size = ("-", text[1:]) if text.startswith("-") else ("", text)
    if not size.replace("/", "").isdigit():
        return str(latex(number.exact))
    above, _, below = size.partition("/")
    return rf"{sign}\frac{{{above}}}{{{below}}}" if below else text


def terms_of(polynomial: Polynomial) -> list[str]:
    """The terms in rising order, each with its sign."""
    found = []
    for powers, number in sorted(polynomial.terms.items()):
        pairs = [
            symbol(name.strip("()")) + (f"^{{{n}}}" if n != 1 else "")
            for name, n in zip(polynomial.variables, powers, strict=True)
            if n
        ]
        text, monomial = exact(number), " ".join(pairs)
        if monomial and text in ("1", "-1"):
            text = text[:-1]
        found.append(f"{text} {monomial}".strip())
    return [term if i == 0 or term.startswith("-") else f"+ {term}" for i, term in enumerate(found)] or ["0"]


def value_of(operand: Operand) -> str:
    """A name or an exact number."""
    return symbol(operand) if isinstance(operand, str) else exact(operand)


def steps_of(function: Function) -> list[str]:
    """Assignments, since a name may be given a value again; polynomials as sums."""
    lines = []
    for statement in function.body:
        if isinstance(statement, Horner):
            terms: Terms = {(n,): c for n, c in enumerate(statement.coefficients) if c is not None}
            lines.append(rf"{symbol(statement.name)} &\gets {' '.join(terms_of(Polynomial((statement.at,), terms)))}")
        else:
            lines.append(rf"{symbol(statement.name)} &\gets {_operation(statement)}")
    return lines


def _operation(step: Step) -> str:
    a, *others = (value_of(o) for o in step.operands)
    rest = [rf"\left({o}\right)" if o.startswith("-") else o for o in others]
    match step.operation:
        case Operation.ADD | Operation.TWO_SUM:
            return f"{a} + {rest[0]}"
        case Operation.SUBTRACT:
            return f"{a} - {rest[0]}"
        case Operation.MULTIPLY | Operation.TWO_PRODUCT:
            return rf"{a} \cdot {rest[0]}"
        case Operation.DIVIDE:
            return rf"\frac{{{a}}}{{{others[0]}}}"
        case Operation.MULTIPLY_ADD:
            return rf"{a} \cdot {rest[0]} + {rest[1]}"
        case Operation.SQUARE_ROOT:
            return rf"\sqrt{{{a}}}"
        case Operation.ROOT:
            return rf"\sqrt[{others[0]}]{{{a}}}"
        case Operation.ABSOLUTE:
            return rf"\left|{a}\right|"
    return rf"\left\lfloor {a} \right\rfloor"


language = Latex()
