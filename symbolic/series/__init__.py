"""Truncated power series of an expression, coefficient by coefficient, over any exact or rigorous ring.

Knows expressions and rings; the recurrences of every elementary function stand here once.
"""
