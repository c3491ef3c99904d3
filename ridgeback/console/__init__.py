"""The terminal: output files, progress, failures and exit codes, tables, processes.

Knows no oscillator.
"""
