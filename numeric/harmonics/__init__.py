"""A signal as harmonics of one slowly varying phase: local and global least squares, noise level, Cramér-Rao bound.

Knows signals; the models made here are what estimators are corrected by and judged on.
"""
