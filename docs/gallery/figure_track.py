"""
A frequency over time
=====================

The peak of a pseudo-Wigner distribution along a noisy recording, with its 95 % interval.
"""

import ridgeback

sample = ridgeback.sample("pendulum")
track = ridgeback.estimate(sample.recording, method="pseudo_wigner", remove_bias=True)
axes = track.inside().plot()
