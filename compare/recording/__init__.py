"""What is measured of a recording: tracks, backbone, growth rate, and their combination over runs.

Knows numeric's recordings and estimators.
"""
