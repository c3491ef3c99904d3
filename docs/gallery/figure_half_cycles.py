"""
Half cycle by half cycle
========================

Frequency, amplitude and growth rate from located zero crossings and turning points.
"""

import ridgeback

axes = ridgeback.half_cycles(ridgeback.sample("pendulum").recording).plot()
