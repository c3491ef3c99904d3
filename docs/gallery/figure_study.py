"""
Error over amplitude
====================

How the truncated series of the pendulum err, order by order.
"""

import numpy as np

import ridgeback

axes = ridgeback.study("pendulum", (2, 4, 8, 16), np.linspace(0.1, 3.0, 30)).plot()
