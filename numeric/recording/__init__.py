"""Recordings made ready to be measured: gaps, uneven times, clipping, drift, each found, reported and treated.

Knows files and signals.
"""
