"""omega0 as a series in the amplitude or in eps: Lindstedt-Poincaré, the energy integral, amplitude definitions, cost.

Knows systems and series; nothing here is estimated.
"""
