"""Frequency and growth rate against amplitude: from tracks, from half cycles, from several runs.

Knows recordings' signals, tracks and estimators.
"""
