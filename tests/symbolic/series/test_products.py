"""Products of series on line, in blocks and packed, against the plain convolution; programs against SymPy's series."""

from __future__ import annotations

import itertools

import pytest
import sympy
from flint import arb, arb_poly, fmpq
from hypothesis import given, settings
from hypothesis import strategies as st

from ridgeback.common.errors import InputError
from ridgeback.common.recurrences import Input, Product
from ridgeback.symbolic.arithmetic.expression_series import Program, check_expandable
from ridgeback.symbolic.series.harmonic_basis import EMPTY, Balls, plus
from ridgeback.symbolic.series.laurent import products
from ridgeback.symbolic.series.relaxed_product import RelaxedProduct, blocks
from ridgeback.symbolic.series.ring import TrigRing
from ridgeback.symbolic.series.spaces import Parts, space_for
from ridgeback.symbolic.series.trigonometric import Trig

LAST = 11
rationals = st.fractions(-2, 2, max_denominator=9).map(lambda x: fmpq(x.numerator, x.denominator))
part = st.one_of(st.none(), st.lists(rationals, min_size=1, max_size=3))
orders = st.lists(st.tuples(part, part, part, part), min_size=LAST + 1, max_size=LAST + 1)


def parts(row: tuple[list[fmpq] | None, ...]) -> Parts:
    a, b, c, d = (None if values is None else arb_poly([arb(x) for x in values]) for values in row)
    return a, b, c, d


def overlap(p: Parts, q: Parts) -> bool:
    """Whether two enclosures of one polynomial can hold the same one; what is missing is zero."""
    for x, y in zip(p, q, strict=True):
        left, right = ([] if z is None else z.coeffs() for z in (x, y))
        pairs = itertools.zip_longest(left, right, fillvalue=arb(0))
        if not all(a.overlaps(b) and a.rad() < arb("1e-9") for a, b in pairs):
            return False
    return True


@settings(deadline=None, max_examples=5)
@given(left=orders, right=orders)
def test_a_relaxed_product_is_the_plain_one(left: list, right: list) -> None:
    space = Balls(LAST)
    ring = TrigRing(space)
    x, y = (Input(ring, [Trig(space, parts(row)) for row in rows]) for rows in (left, right))
    relaxed, plain = RelaxedProduct(ring, x, y, space), Product(ring, x, y)
    assert all(overlap(relaxed.get(n).parts, plain.get(n).parts) for n in range(LAST + 1))


def test_every_pair_of_orders_meets_once() -> None:
    """The blocks up to order n, with both ends, cover the pairs (j, k), j + k <= n, each once."""
    met: list[tuple[int, int]] = []
    for n in range(1, 33):
        met += dict.fromkeys(((0, n), (n, 0)))
        for length, alone in blocks(n) if n > 1 else ():
            low, high = range(length, 2 * length), range(n - length, n)
            met += itertools.product(low, high)
            met += [] if alone else itertools.product(high, low)
    reached = [(j, k) for j, k in met if j + k <= 32]
    assert len(reached) == len(set(reached))
    assert set(reached) == {(j, k) for j in range(33) for k in range(33 - j)} - {(0, 0)}


@settings(deadline=None, max_examples=5)
@given(left=orders, right=orders)
def test_packed_products_are_those_of_single_orders(left: list, right: list) -> None:
    x, y = ([parts(row) for row in rows[:5]] for rows in (left, right))
    packed = products(x, y)
    for r in range(9):
        single = EMPTY
        for a in range(max(0, r - 4), min(r, 4) + 1):
            single = plus(single, products([x[a]], [y[r - a]])[0])
        assert overlap(packed[r], single)


@pytest.mark.parametrize("kinds", [(0, 3, 0, 3, 0), (2, 1, 2, 1, 2), (0, 3, 3, 0, 3), (1, 2, 2, 1, 1)])
def test_cosines_and_sines_in_turn_or_nearly_so(kinds: tuple[int, ...]) -> None:
    """Where one order is out of turn, those round it are not taken for what they would be."""
    rows: list[Parts] = [
        parts(tuple([fmpq(n + 1), fmpq(n, 3)] if part == kind else None for part in range(4)))
        for n, kind in enumerate(kinds)
    ]
    packed = products(rows, rows)
    for r in range(9):
        single = EMPTY
        for a in range(max(0, r - 4), min(r, 4) + 1):
            single = plus(single, products([rows[a]], [rows[r - a]])[0])
        assert overlap(packed[r], single)


def test_orders_that_nothing_contributes_to_stay_absent() -> None:
    """Orders 0, 1 and 4 of both reach 0, 1, 2, 4, 5 and 8: the others are no rounding errors of zeros."""
    cosine = parts((None, [fmpq(1, 3)], None, None))
    rows = [cosine, cosine, EMPTY, EMPTY, cosine]
    assert [n for n, found in enumerate(products(rows, rows)) if found == EMPTY] == [3, 6, 7]


U, V = sympy.symbols("u v")


@pytest.mark.parametrize(
    "text", ["sin(u)", "u*cosh(u)", "u/(1 + u**2)", "tan(u)", "log(1 + u)", "sqrt(1 + u)", "atan(u)", "exp(u) - 1"]
)
def test_a_program_gives_the_series_that_sympy_gives(text: str) -> None:
    names = {name: getattr(sympy, name) for name in ("sin", "cosh", "tan", "log", "sqrt", "atan", "exp")}
    force = eval(text, {"__builtins__": {}}, {**names, "u": U})  # noqa: S307 - the eight texts above
    ring = TrigRing(space_for(()))
    program = Program(force, ring, {U: [ring.number(sympy.S.Zero)], V: [ring.number(sympy.S.Zero)]}, U, V)
    for n in range(1, 8):
        program.supply(U, ring.number(sympy.Integer(int(n == 1))))
    taylor = sympy.series(force, U, 0, 8).removeO()
    for n in range(8):
        value = (program.root.get(n).coefficients(0) or [fmpq(0)])[0]
        assert sympy.Rational(int(value.p), int(value.q)) == taylor.coeff(U, n)


def test_what_has_no_exact_series_is_refused_before_the_work() -> None:
    ring = TrigRing(space_for(()))
    start = {U: [ring.number(sympy.S.One)], V: [ring.number(sympy.S.Zero)]}
    with pytest.raises(InputError, match="irrational"):
        Program(sympy.sin(U), ring, start, U, V)
    with pytest.raises(InputError):
        check_expandable(sympy.Abs(U), [U])
