"""Samples at the door: checks, analytic signal, band limits, decimation, windows, where to look for the fundamental.

Knows arrays; knows no method.
"""
