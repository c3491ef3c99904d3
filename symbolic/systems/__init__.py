"""Oscillators: the frozen value, the catalogue, TOML descriptions, parameters, potentials, the structure of a force.

Knows the grammar; knows no expansion.
"""
