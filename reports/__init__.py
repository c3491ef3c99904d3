"""Figures, formulas and the one HTML page."""
