"""Polynomials fitted to the exact frequency instead of expanded: minimax, with representable coefficients.

The exact frequency is first enclosed over the whole range by a Chebyshev interpolant with a proved remainder
(``surrogate``); Remez's exchange fits it (``remez``), and the error of the rounded fit is proved against it (``fit``).
"""
