"""A report assembled: every number of the page, its summary, its tables, how to make it again.

Knows all of compare; draws nothing.
"""
