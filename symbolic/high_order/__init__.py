"""Expansions of very high order: in balls with certain digits, with checkpoints.

Knows the recursions of expansion and runs them in other arithmetic.
"""
