"""Tracks of the fundamental: one file for each method, `auto`, which chooses, and `estimate`, which calls any of them.

Knows distributions, harmonic models and tracks.
"""
