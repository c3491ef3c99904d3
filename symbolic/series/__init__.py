"""Trigonometric and polynomial series, coefficient by coefficient, over any exact or rigorous ring, and fast products.

Knows rings and bases; an expression becomes a series in ``arithmetic``, and the recurrences stand in ``common``.
"""
