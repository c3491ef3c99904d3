"""Samples as they come in: checks, analytic signal, band limits, decimation, windows, the search band.

Knows arrays; knows no method.
"""
