"""Order against amplitude: truncations held against an exact reference, proved errors, evaluation times.

Knows bound oscillators and expansions; knows no signal.
"""
