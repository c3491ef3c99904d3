"""Seeded trials: how often an interval holds, noise passes for an oscillation, a class is recovered."""
