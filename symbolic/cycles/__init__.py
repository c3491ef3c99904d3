"""Limit cycles enclosed: a validated Taylor integrator in balls, the return map with its slope, interval Newton.

Knows an equation with numbers and nothing of perturbation theory; the proof stands in docs/explanation/limit-cycles.md.
"""
