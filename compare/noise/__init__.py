"""Estimators in noise, trial by trial, against the Cramér-Rao bound, and which is best where.

Knows bound oscillators and estimators.
"""
