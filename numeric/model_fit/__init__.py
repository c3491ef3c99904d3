"""An oscillator's own equation fitted to samples: sensitivities, start, least squares, the track of the fit.

Knows motion, harmonics and tracks.
"""
