"""Other formulas from the same coefficients: Padé approximants, changes of variable, the elliptic nome.

Knows expansions and where they are singular.
"""
