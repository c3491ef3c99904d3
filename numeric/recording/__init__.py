"""A recording made fit to measure: gaps, uneven times, clipping, drift, each found, said and treated.

Knows files and signals.
"""
