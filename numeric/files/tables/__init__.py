"""Delimited text: encodings, lines and cells, numbers and dates as people write them, and the names of columns above.

Of what columns mean it asks names alone; every fault is named by its line.
"""
