"""
A limit cycle and its series
============================

The frequency of van der Pol's oscillator in eps: exact by interval Newton, and by its series.
"""

import matplotlib.pyplot as plt
import numpy as np

import ridgeback

eps = np.linspace(0.0, 2.2, 60)
figure, axes = plt.subplots()
for order in (4, 12, 24):
    axes.plot(eps, ridgeback.derive("van_der_pol", order)(eps), label=f"order {order}")
for value in (0.5, 1.5):
    (cycle,) = ridgeback.limit_cycles(ridgeback.oscillator("van_der_pol", parameters={"eps": value}), bits=64)
    axes.plot(value, float(cycle.omega), "ko")
axes.set_ylim(0.7, 1.02)
axes.set_xlabel("eps")
axes.set_ylabel("omega0, rad per time unit")
axes.legend()
