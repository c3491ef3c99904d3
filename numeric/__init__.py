"""Trajectories, the pendulum model of Galleani and Cohen, distributions and frequency tracks."""
