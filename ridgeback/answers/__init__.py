"""Results as text, CSV or JSON, as a verb prints them.

Knows options and the rooms' results; computes nothing.
"""
