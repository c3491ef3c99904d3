"""What is proved about an expansion: put back into its equation, compared with the enclosure, at given amplitudes.

Knows every way to omega0; derives nothing itself.
"""
