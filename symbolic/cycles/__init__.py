"""Limit cycles enclosed: a validated Taylor integrator in balls, the return map with its slope, interval Newton.

Knows an equation with numbers and nothing of perturbation theory; the proof is written down in docs/limit-cycles.md.
"""
