"""
A backbone curve
================

Frequency against amplitude of a decaying pendulum, with the exact series beside it.
"""

import numpy as np

import ridgeback

run = ridgeback.simulate("damped_pendulum", (2.2, 0.0), duration=120.0, rate=8.0, parameters={"mu": "0.015"})
samples = run.u + 0.01 * np.random.default_rng(7).normal(size=run.u.size)
curve = ridgeback.backbone(samples, 8.0)
axes = curve.plot()
a = np.linspace(0.4, 2.0, 60)
axes.plot(a, ridgeback.derive("pendulum", 20, amplitude="fundamental")(a), "k--", label="series, order 20")
axes.legend()
