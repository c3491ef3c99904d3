"""The ways to omega0(t) that take part in a benchmark: formulas of the amplitude, slow flows, estimates, yardsticks.

Knows a motion and what each way gives along it, with its cost; nothing is judged here.
"""
