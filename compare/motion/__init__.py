"""Everything along one integrated motion: model curves, expansions and estimates against the cycle frequency.

Knows studies and estimators; the paper's statements are checked here.
"""
