"""Exact numbers and balls: power series as lists, quotients of polynomials, rigorous rounding, printing.

Knows FLINT and SymPy's numbers; knows no equation.
"""
