"""Trajectories, the pendulum model of Galleani and Cohen, distributions and frequency tracks.

Read the folders in this order: signal, harmonics, components, tracking, motion, model_fit, distributions, estimators,
orbits, files, recording, backbone.  Each may import those before it.  Sympy is unknown here.
"""
