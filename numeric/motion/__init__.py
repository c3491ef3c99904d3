"""Oscillators bound to numbers and their integrated solutions: DOP853, Taylor, bilinear, limit cycles, crossings.

Knows functions of floats; where they come from is not its business.
"""
