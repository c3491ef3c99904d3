"""Tracks of the fundamental: one file for each method, `auto`, which chooses, and `estimate`, the one door.

Knows distributions, harmonic models and tracks.
"""
