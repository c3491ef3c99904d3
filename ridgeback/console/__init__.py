"""The terminal: output files, failures and exit codes, tables, processes.

Knows no oscillator.
"""
