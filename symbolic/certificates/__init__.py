"""What is proved about an expansion: put back into its equation, held against the enclosure, at given amplitudes.

Knows every way to omega0; derives nothing itself.
"""
