"""The exact omega0(A) as a ball: turning points, well, analytic strip, quadrature with a proved error.

Knows systems and balls; owes nothing to any expansion, so that it can judge them.
"""
