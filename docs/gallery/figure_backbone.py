"""
A measured backbone, and theory
===============================

Frequency against amplitude of a decaying pendulum; the dashed line is the exact series of the
undamped one.
"""

import numpy as np

import ridgeback

sample = ridgeback.sample("pendulum")
axes = ridgeback.backbone(sample.recording).plot()
a = np.linspace(0.8, 2.0, 60)
k = sample.parameters["k"]
axes.plot(a, k * ridgeback.derive("pendulum", 20, amplitude="fundamental")(a), "k--", label="series, order 20")
