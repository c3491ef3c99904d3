"""Formulas as MathML, numbers and tables as text.

Knows values, not figures.
"""
