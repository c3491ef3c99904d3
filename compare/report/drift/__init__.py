"""Pages about a motion whose parameters drift.

Knows compare; draws nothing.
"""
