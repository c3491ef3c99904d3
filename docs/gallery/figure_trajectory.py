"""
A motion
========

The paper's damped pendulum, from close to its upper equilibrium.
"""

import math

import ridgeback

case = {"k": "12.566370614359172", "mu": "0.01"}
run = ridgeback.simulate("damped_pendulum", (0.95 * math.pi, 0.0), duration=20.0, rate=64.0, parameters=case)
axes = run.plot()
