"""
Energy along a motion
=====================

Kinetic and potential energy change to and fro; what damping takes is the third.
"""

import ridgeback

run = ridgeback.simulate("damped_duffing", (2.0, 0.0), duration=40.0, rate=16.0, parameters={"mu": "0.02"})
axes = ridgeback.energy_terms("damped_duffing", run, parameters={"mu": "0.02"}).plot()
