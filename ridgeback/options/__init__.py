"""Command-line options that verbs share, each parsed and checked once.

Knows click and the console; imports heavy packages late.
"""
