"""
Which oscillator made it?
=========================

The measured backbone of a decay and those of the fitted classes, with their 95 % bands.
"""

import ridgeback

recording = ridgeback.sample("pendulum").recording
axes = ridgeback.identify(recording, candidates=["linear", "pendulum", "duffing-softening"], damping="linear").plot()
