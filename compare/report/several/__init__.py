"""Pages about more than one thing: the runs and channels of an experiment, the oscillators of a study.

Knows compare; draws nothing.
"""
