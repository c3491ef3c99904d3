"""Expansions of very high order: in balls with certain digits, or exactly by many primes, with checkpoints.

Knows the recursions of expansion and runs them in other arithmetic.
"""
