"""The figures of a page, one file for each of its parts.

Knows compare's results and the drawing.
"""
