"""Time-frequency distributions: Wigner and its kin, spectrogram, reassigned and synchrosqueezed, and their ridge.

Knows signals; one lag kernel serves the whole Wigner family.
"""
