"""A root of an irreducible polynomial of degree three or more, as an exact number with a name.

Numbers of the field that it generates are written as polynomials in it of lower degree than its own polynomial has,
which makes them unique: a/b is a times the inverse of b modulo that polynomial (von zur Gathen and Gerhard, Modern
Computer Algebra, section 4.2).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, Final

import sympy
from flint import arb, ctx, fmpq, fmpq_poly

NAME: Final = "r"
"""What a root is called in a formula."""
DIGITS: Final = 20


class Root(sympy.CRootOf):  # type: ignore[misc]
    """A real root, called ``r`` where it is printed.

    >>> x = sympy.Symbol("x")
    >>> r = Root(x**3 + x - 1, 0)
    >>> sympy.sqrt(2 * r), sympy.N(r, 12)
    (sqrt(2)*sqrt(r), 0.682327803828)
    """

    __slots__ = ()

    def _sympystr(self, _: Any) -> str:
        return NAME

    def _latex(self, _: Any) -> str:
        return NAME

    @property
    def told(self) -> str:
        """Its value and its polynomial, for a reader.

        >>> x = sympy.Symbol("x")
        >>> Root(x**3 + x - 1, 0).told
        'r = 0.68232780382801932737, a root of r**3 + r - 1'
        """
        return f"{NAME} = {sympy.N(self, DIGITS)}, a root of {self.poly.as_expr(sympy.Symbol(NAME))}"

    def to_dict(self) -> dict[str, str]:
        """The public JSON form: name, value and polynomial."""
        polynomial = self.poly.as_expr(sympy.Symbol(NAME))
        return {"name": NAME, "decimal": str(sympy.N(self, DIGITS)), "polynomial": str(polynomial)}


def root_in(value: sympy.Expr) -> Root | None:
    """The root that a number holds, None where it holds none."""
    return next(iter(value.atoms(Root)), None)


def root_ball(root: Root) -> arb:
    """An enclosure of a root at the present precision, proved by a change of sign of its polynomial.

    >>> x = sympy.Symbol("x")
    >>> found = root_ball(Root(x**3 + x - 1, 0))
    >>> found**3 + found - 1 in arb(0, 1e-14), found.rad() < 1e-14
    (True, True)
    """
    digits = ctx.prec * 3 // 10 + 10
    middle, reach = sympy.Rational(str(sympy.N(root, digits + 5))), sympy.Rational(1, 10**digits)
    ends = [middle - reach, middle + reach]
    signs = {sympy.sign(root.poly.eval(end)) for end in ends}
    if signs != {-1, 1}:
        raise ArithmeticError(f"{root.told}: its polynomial does not change sign within {reach} of it")
    low, high = (arb(_fmpq(end)) for end in ends)
    return low.union(high)


def in_field(terms: Mapping[tuple[int, ...], fmpq], values: Sequence[sympy.Expr], root: Root) -> sympy.Expr:
    """A polynomial with rational coefficients at numbers of the field, of lowest degree in the root.

    Parameters
    ----------
    terms : mapping of tuple of int to fmpq
        Powers of the variables and their coefficient.
    values : sequence of sympy.Expr
        A number of the field for each variable.
    root : Root
        What generates the field.

    Returns
    -------
    sympy.Expr
        A polynomial in the root.

    Examples
    --------
    >>> x = sympy.Symbol("x")
    >>> r = Root(x**3 + x - 1, 0)
    >>> in_field({(2, 1): fmpq(3), (0, 0): fmpq(1, 2)}, [r, 1 / r], r)
    1/2 + 3*r
    """
    modulus = fmpq_poly([_fmpq(c) for c in reversed(root.poly.all_coeffs())])
    numbers = [_element(reduced(value, root), root) for value in values]
    known: list[list[fmpq_poly]] = [[fmpq_poly([1])] for _ in numbers]
    total = fmpq_poly([])
    for powers, coefficient in terms.items():
        product = fmpq_poly([coefficient])
        for number, own, power in zip(numbers, known, powers, strict=True):
            while len(own) <= power:
                own.append(own[-1] * number % modulus)
            product = product * own[power] % modulus if power else product
        total += product
    return sympy.Add(*(sympy.Rational(int(c.p), int(c.q)) * root**n for n, c in enumerate(total.coeffs())))


def _element(value: sympy.Expr, root: Root) -> fmpq_poly:
    x = sympy.Dummy("x")
    return fmpq_poly([_fmpq(c) for c in reversed(sympy.Poly(value.xreplace({root: x}), x).all_coeffs())])


def _fmpq(value: sympy.Rational) -> fmpq:
    return fmpq(int(value.p), int(value.q))


def reduced(value: sympy.Expr, root: Root) -> sympy.Expr:
    """A rational function of a root as a polynomial in it of lowest degree.

    Parameters
    ----------
    value : sympy.Expr
        Of rationals and the root, and of symbols that are polynomial in it.
    root : Root
        The root.

    Returns
    -------
    sympy.Expr
        The same number.

    Examples
    --------
    >>> x = sympy.Symbol("x")
    >>> r = Root(x**3 + x - 1, 0)
    >>> reduced(r**3, r), reduced(1 / r, r)
    (1 - r, r**2 + 1)
    """
    x = sympy.Dummy("x")
    above, below = sympy.fraction(sympy.together(value.xreplace({root: x})))
    modulus = root.poly.as_expr(x)
    inverse = sympy.invert(sympy.Poly(below, x), sympy.Poly(modulus, x)).as_expr()
    terms = sympy.rem(sympy.Poly(sympy.expand(above * inverse), x), sympy.Poly(modulus, x))
    return sympy.expand(terms.as_expr()).xreplace({x: root})
