"""Time-frequency distributions: the Wigner family, spectrogram, reassigned and synchrosqueezed, and their ridge.

Knows signals; one lag kernel serves the whole Wigner family.
"""
