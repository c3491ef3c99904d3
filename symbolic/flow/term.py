"""One term of a slow flow, and those of averaged losses: by the losses' parameters, and summed by powers."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import TypeAlias

import sympy

from ridgeback.symbolic.systems.parameters import symbol_of

Power: TypeAlias = int | sympy.Rational


@dataclass(frozen=True)
class Term:
    """One term ``coefficient * a^powers[0] * m_1^powers[1] * m_2^powers[2] ...``."""

    powers: tuple[int, ...]
    coefficient: sympy.Expr


@dataclass(frozen=True)
class LossTerm:
    """One term ``coefficient * a^powers[0] * m_1^powers[1] ...``; a power that is no whole number is a Rational."""

    powers: tuple[Power, ...]
    coefficient: sympy.Expr


def by_losses(power: Power, total: sympy.Expr, names: Sequence[str]) -> list[LossTerm]:
    """The terms of ``total * a^power`` by the powers of the losses' parameters, in which the total is a polynomial.

    Parameters
    ----------
    power : int or sympy.Rational
        Of the amplitude.
    total : sympy.Expr
        Polynomial in the losses' parameters; of other names it may hold any function.
    names : sequence of str
        Parameters of the losses.

    Returns
    -------
    list of LossTerm
        Those that are not zero, each power once.

    Examples
    --------
    >>> F, b = (symbol_of(name) for name in "Fb")
    >>> [(term.powers, term.coefficient) for term in by_losses(-1, 2 * F + F**2 / (1 + b), ["F"])]
    [((-1, 1), 2), ((-1, 2), 1/(b + 1))]
    """
    rows = []
    for term in sympy.Add.make_args(sympy.expand(total)):
        rest, powers = term, []
        for name in names:
            rest, n = rest.as_coeff_exponent(symbol_of(name))
            powers.append(int(n))
        rows.append(LossTerm((power, *powers), rest))
    return list(merged(rows))


def merged(terms: Iterable[LossTerm]) -> tuple[LossTerm, ...]:
    """Terms with the same powers as one, without zeros, by rising powers of the amplitude.

    >>> [(term.powers, term.coefficient) for term in merged([LossTerm((2,), sympy.S(3)), LossTerm((2,), sympy.S(4))])]
    [((2,), 7)]
    """
    sums: dict[tuple[Power, ...], sympy.Expr] = {}
    for term in terms:
        sums[term.powers] = sums.get(term.powers, sympy.S.Zero) + term.coefficient
    found = (LossTerm(powers, _plain(total)) for powers, total in sums.items())
    return tuple(sorted((t for t in found if t.coefficient != 0), key=lambda t: (float(t.powers[0]), t.powers[1:])))


def _plain(total: sympy.Expr) -> sympy.Expr:
    """Multiplied out; over one bar where sums stand below it, which do not meet term by term."""
    opened = sympy.expand(total)
    below = any(p.base.is_Add and p.exp.is_negative for p in opened.atoms(sympy.Pow))
    return sympy.cancel(opened) if below else opened
