"""Figures, formulas and the one HTML page.

Order: text, drawing, figures, then sections and page.  Computes no result.
"""
