"""
A spectrogram and its ridge
===========================

Fundamental and odd harmonics of the paper's pendulum rise as the swing decays.
"""

import math

import ridgeback

case = {"k": "12.566370614359172", "mu": "0.01"}
run = ridgeback.simulate("damped_pendulum", (0.95 * math.pi, 0.0), duration=20.0, rate=64.0, parameters=case)
plane = ridgeback.spectrogram(run.u, 64.0, window_seconds=2.5)
ridge = ridgeback.ridge(plane).inside()
axes = plane.plot()
axes.plot(ridge.time, ridge.omega, "k--")
axes.set_ylim(0, 80)
