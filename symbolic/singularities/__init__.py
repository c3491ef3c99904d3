"""Where an expansion ends: its radius of convergence and the singularities that set it, with uncertainties.

Knows finished expansions, exact or in balls.
"""
