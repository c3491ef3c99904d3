"""Figures of recordings beside their backbone: samples against the fit with the residual's spectrum, several runs.

One file a figure.
"""
