r"""omega0 for a potential V = c u^n, n even: the one power law that dimensional analysis leaves, and its factor.

    T = 4 integral of du / sqrt(2 V(A) - 2 V(u)) over 0 < u < A,   u = A x:
    T = 4 A^(1 - n/2) / sqrt(2 c) * I,      I = integral of dx / sqrt(1 - x^n) over 0 < x < 1
                                              = sqrt(pi) Gamma(1 + 1/n) / Gamma(1/2 + 1/n)

(substitute x^n = t, Euler's beta function, DLMF 5.12.1), so that with omega0 = 2 pi / T

    omega0 = sqrt(pi c / 2) Gamma(1/2 + 1/n) / Gamma(1 + 1/n) * A^(n/2 - 1).
"""

from __future__ import annotations

from dataclasses import dataclass

from flint import arb, fmpq, fmpq_poly

from ridgeback.symbolic.arithmetic.balls import whole_power


@dataclass(frozen=True)
class PowerLaw:
    """V = coefficient u^exponent, with an even exponent and a positive coefficient."""

    coefficient: fmpq
    exponent: int

    @property
    def growth(self) -> int:
        """The power of the amplitude that omega0 follows, n/2 - 1.

        >>> PowerLaw(fmpq(1, 4), 4).growth
        1
        """
        return self.exponent // 2 - 1

    def factor(self) -> arb:
        """omega0 / A^growth at the present precision.

        >>> PowerLaw(fmpq(1, 4), 4).factor().str(12, radius=False)  # u'' + u^3 = 0
        '0.847213084794'
        """
        share = arb(fmpq(1, self.exponent))
        gammas = (arb(fmpq(1, 2)) + share).gamma() / (1 + share).gamma()
        return (arb.pi() * self.coefficient / 2).sqrt() * gammas

    def frequency(self, peak: arb) -> arb:
        """omega0 at an amplitude.

        >>> PowerLaw(fmpq(1, 2), 2).frequency(arb(7)).contains(1)  # u'' + u = 0
        True
        """
        return self.factor() * whole_power(peak, self.growth)


def power_law(potential: fmpq_poly) -> PowerLaw | None:
    """The law of a potential that is one even power with a positive coefficient, else None.

    >>> power_law(fmpq_poly([0, 0, 0, 0, fmpq(1, 4)])).exponent, power_law(fmpq_poly([0, 0, 1, 0, 1]))
    (4, None)
    """
    n = potential.degree()
    plain = n >= 2 and n % 2 == 0 and potential[n] > 0 and all(potential[j] == 0 for j in range(n))
    return PowerLaw(fmpq(potential[n]), n) if plain else None
