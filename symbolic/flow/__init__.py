"""Multiple scales: the slow flow of amplitude and phase, its fixed points, transient, and the motion behind it.

Knows systems, series and expansions.
"""
