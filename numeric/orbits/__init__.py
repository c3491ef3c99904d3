"""Undamped orbits and slow decays: period, action, waveform, energy, the paper's model, averaging.

Knows motion; knows no signal.
"""
