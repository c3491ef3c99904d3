"""
A pseudo-Wigner distribution
============================

Sharper than a spectrogram, with cross terms midway between the components.
"""

import math

import ridgeback

case = {"k": "12.566370614359172", "mu": "0.01"}
run = ridgeback.simulate("damped_pendulum", (0.95 * math.pi, 0.0), duration=20.0, rate=32.0, parameters=case)
axes = ridgeback.pseudo_wigner(run.u, 32.0, lag_seconds=2.5).plot()
axes.set_ylim(0, 60)
