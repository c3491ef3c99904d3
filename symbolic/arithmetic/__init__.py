"""Exact numbers and balls, power series as lists and of expressions, quotients of polynomials, rigorous rounding.

Knows FLINT, SymPy's numbers and expressions; knows no equation.
"""
