"""Symbolic oscillators as functions of numbers, generated code as a callable, other integrators.

The one place where a SymPy expression becomes arithmetic.
"""
