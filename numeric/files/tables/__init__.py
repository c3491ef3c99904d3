"""Delimited text: encodings, lines and cells, and the names of columns above them.

Knows nothing of what columns mean; every fault is named by its line.
"""
