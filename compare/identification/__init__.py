"""Which oscillator made a recording: candidates, fits along their slow flow, ranking, prediction.

Knows orbits and tracks; knows no page.
"""
