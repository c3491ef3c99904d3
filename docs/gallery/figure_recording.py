"""
A recording
===========

The ringdown of two modes after a blow, as it is read from a file.
"""

import ridgeback

axes = ridgeback.sample("hammer").recording.plot()
