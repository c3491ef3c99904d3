"""Columns of numbers from files: text tables, WAV, NPZ, MAT, HDF5; which column is the time.

Knows formats; nothing in a file is executed.
"""
