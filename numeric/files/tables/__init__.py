"""Delimited text: encodings, lines, cells and the names of columns."""
