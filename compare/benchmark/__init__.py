"""Every way to omega0(t) of one motion on one scale: error and cost of expansions, series model and estimates.

Knows motions, studies and estimators; every contender is judged on one support against one reference, in one run.
"""
